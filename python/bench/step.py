"""The steps of bench.py in Python: what step.c does, in the same form."""

import sys
import time

import numpy as np

import deldrift


def step(tri, positions):
    tri.move(positions)
    return tri.simplices, tri.neighbors, tri.changes()


def main():
    with open(sys.argv[1], "rb") as file:
        ndim, count, number = np.fromfile(file, np.uint64, 3).astype(int)
        frames = np.fromfile(file, np.float64).reshape(number, count, ndim)
    tri = deldrift.Delaunay(frames[0], threads=1)
    step(tri, frames[0])
    for positions, line in zip(frames[1:], sys.stdin):
        assert line == "\n"
        start = time.thread_time()
        step(tri, positions)
        print(time.thread_time() - start, flush=True)


if __name__ == "__main__":
    main()
