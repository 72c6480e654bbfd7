"""Whether threads that work on triangulations of their own hinder each other: `python bench/threads.py [THREADS]`.

Threads are compared with as many processes that do the same, in turn, so that other load on the machine meets both. 1.0
is as fast as processes, which have no lock in common.
"""

import multiprocessing
import statistics
import sys
import threading
import time

import numpy as np

import deldrift

STEPS = 30


def work(frames):
    tri = deldrift.Delaunay(frames[0], threads=1)
    for k in range(STEPS):
        tri.move(frames[k % 2])
        assert len(tri.simplices)


def seconds(kind, count, frames):
    workers = [kind(target=work, args=(frames,)) for _ in range(count)]
    start = time.perf_counter()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return time.perf_counter() - start


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    process = multiprocessing.get_context("fork").Process
    rng = np.random.default_rng(1)
    for points, ndim in (1_000, 2), (20_000, 2), (20_000, 3):
        start = rng.random((points, ndim))
        frames = [start, start + 1e-3 * points ** (-1 / ndim) * rng.standard_normal(start.shape)]
        ratios = []
        for _ in range(9):
            of_processes = seconds(process, count, frames)
            ratios.append(seconds(threading.Thread, count, frames) / of_processes)
        print(
            f"{count} threads, {points:,} points in {ndim}D: {statistics.median(ratios):.2f} times as long as processes"
        )


if __name__ == "__main__":
    main()
