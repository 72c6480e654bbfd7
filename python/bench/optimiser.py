"""Times of a training loop that needs tetrahedra, as of radiance meshes: Adam moves all points, in single precision.

    python python/bench/optimiser.py [--points 100000] [--updates 30] [--write-page FILE]

The loss is the sum of squared volumes, with a learning rate that falls. Each update is measured three ways on the same
positions, in turn: the triangulation moves; it is made from nothing; scipy makes it (every tenth update).
"""

import argparse
import pathlib
import statistics
import time

import numpy as np
from scipy import spatial

import deldrift
import pages

RATES = 1e-1, 1e-3  # of the spacing of points: of the first update and of the last


def gradient(points, cells):
    """Of the sum of squared volumes."""
    corners = points[cells].astype(np.float64)
    edges = corners[:, 1:] - corners[:, :1]
    normals = np.stack([np.cross(edges[:, (k + 1) % 3], edges[:, (k + 2) % 3]) for k in range(3)], axis=1)
    volumes = (edges[:, 0] * normals[:, 0]).sum(axis=1) / 6
    of_corners = volumes[:, None, None] * np.concatenate([-normals.sum(axis=1, keepdims=True), normals], axis=1) / 3
    flat = cells.ravel()
    return np.stack([np.bincount(flat, of_corners[..., k].ravel(), len(points)) for k in range(3)], axis=1)


class Adam:
    def __init__(self, shape):
        self.mean, self.square, self.number = np.zeros(shape), np.zeros(shape), 0

    def step(self, gradient, rate):
        self.number += 1
        self.mean = 0.9 * self.mean + 0.1 * gradient
        self.square = 0.99 * self.square + 0.01 * gradient**2
        scale = np.sqrt(self.square / (1 - 0.99**self.number)) + 1e-30
        return rate * self.mean / (1 - 0.9**self.number) / scale


def seconds(run):
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def train(count, updates):
    """Seconds of moving, of a build, and of scipy, of each update, with the mean step in spacings."""
    points = np.random.default_rng(1).random((count, 3)).astype(np.float32)
    spacing = count ** (-1 / 3)
    tri, adam, rows = deldrift.Delaunay(points), Adam(points.shape), []
    for number in range(updates):
        rate = spacing * RATES[0] * (RATES[1] / RATES[0]) ** (number / (updates - 1))
        step = adam.step(gradient(points, tri.simplices), rate)
        points = np.clip(points - step, 0, 1).astype(np.float32)
        row = [np.linalg.norm(step, axis=1).mean() / spacing]
        row.append(seconds(lambda: (tri.move(points), tri.simplices)))
        row.append(seconds(lambda: deldrift.Delaunay(points).simplices))
        row.append(seconds(lambda: spatial.Delaunay(points)) if number % 10 == 9 else None)
        rows.append(row)
    assert tri.nsimplex == deldrift.Delaunay(points).nsimplex
    return rows


def table(count, rows):
    lines = [f"| updates of {count:,} points | step, spacings | move | from nothing | | scipy | |"]
    lines.append("|---|--:|--:|--:|--:|--:|--:|")
    for first in range(0, len(rows), 10):
        part = rows[first : first + 10]
        step, move, build = (statistics.median(row[k] for row in part) for k in range(3))
        of_scipy = next((row[3] for row in part if row[3]), float("nan"))
        lines.append(
            f"| {first + 1} to {first + len(part)} | {step:.2g} | {1e3 * move:.3g} ms | {1e3 * build:.3g} ms "
            f"| {build / move:.1f}× | {1e3 * of_scipy:,.4g} ms | {of_scipy / move:.0f}× |"
        )
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--updates", type=int, default=30)
    parser.add_argument("--write-page", type=pathlib.Path)
    given = parser.parse_args()
    text = table(given.points, train(given.points, given.updates))
    print(text)
    if given.write_page:
        pages.replace(given.write_page, "optimiser", [text])


if __name__ == "__main__":
    main()
