"""Meshes of six domains by PyPI's triangle, beside those of `cargo bench --bench refine -- FOLDER`.

    python python/bench/refine.py FOLDER

FOLDER has the domains as .poly files, and the table refine.csv, which are read and not changed. Prints a row for each
domain and quality: cells of both, and times of both in nanoseconds a cell. The module triangle is not free software for
all purposes: it is not a part of this repository and only used where it is installed.
"""

import csv
import pathlib
import sys
import time

import numpy as np
import triangle

RUNS = 5


def rows_of(lines, n, columns):
    return [[float(word) for word in next(lines).split()[1 : 1 + columns]] for _ in range(n)]


def read_poly(path):
    lines = iter(path.read_text().splitlines())
    points = rows_of(lines, int(next(lines).split()[0]), 2)
    segments = rows_of(lines, int(next(lines).split()[0]), 2)
    holes = rows_of(lines, int(next(lines).split()[0]), 2)
    domain = {"vertices": np.array(points), "segments": np.array(segments, dtype=int)}
    if holes:
        domain["holes"] = np.array(holes)
    return domain


def mesh(domain, angle, area):
    """Cells, and the best time."""
    switches = f"pq{angle:g}" + (f"a{area:.12f}" if area else "") + "Q"
    best = float("inf")
    for _ in range(RUNS):
        start = time.perf_counter()
        made = triangle.triangulate(domain, switches)
        best = min(best, time.perf_counter() - start)
    return len(made["triangles"]), best


def main():
    folder = pathlib.Path(sys.argv[1])
    print("domain angle area cells triangle's share ns triangle's share")
    with open(folder / "refine.csv", newline="") as table:
        for row in csv.DictReader(table):
            domain = read_poly(folder / (row["domain"] + ".poly"))
            cells, seconds = mesh(domain, float(row["angle"]), float(row["area"]))
            own, own_seconds = int(row["cells"]), float(row["seconds"])
            times = [1e9 * own_seconds / own, 1e9 * seconds / cells]
            print(
                f"{row['domain']:8} {row['angle']} {row['area']:>5} {own:7} {cells:7} {own / cells:.3f}"
                f" {times[0]:7.0f} {times[1]:7.0f} {times[0] / times[1]:.2f}"
            )


if __name__ == "__main__":
    main()
