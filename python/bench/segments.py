"""Times of a mesh with a hole that turns, step by step, beside PyPI's triangle with its switch p.

    python python/bench/segments.py [--vertices 1000 10000 100000] [--steps 20] [--write-page docs/PYTHON.md]

At each step all vertices but those of the outer circle move, and both give the triangles of the same positions: `move`
and `triangles` of a mesh, a mesh from nothing, and `triangle.triangulate`, in turn, so that load on the machine meets
all. Medians are shown. At the end the triangles are compared.
"""

import argparse
import pathlib
import statistics
import sys
import time

import numpy as np
import triangle

import deldrift
import pages

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "examples"))

from turning_hole import ellipse, sheared  # noqa: E402

AMPLITUDES = 1e-3, 1e-2, 1e-1
"""How far vertices beside the hole move in a step, in mean spacings."""


def seconds(run):
    start = time.perf_counter()
    result = run()
    return time.perf_counter() - start, result


def scene(count, seed=1):
    """Vertices, the outer circle and the hole first, and segments; as many on these as the spacing asks for."""
    spacing = (np.pi * (1 - 0.72 * 0.22) / count) ** 0.5
    rings = [ellipse(int(2 * np.pi / spacing), (1, 1)), ellipse(int(3.2 / spacing), (0.72, 0.22))]
    n_free = count - sum(map(len, rings))
    places = np.random.default_rng(seed).uniform(-1, 1, (2 * count, 2))
    radii, in_hole = np.hypot(*places.T), np.hypot(places[:, 0] / 0.72, places[:, 1] / 0.22)
    free = places[(radii < 1 - spacing) & (in_hole > 1 + 2 * spacing)][:n_free]
    starts = np.cumsum([0, len(rings[0])])
    around = [start + np.arange(len(ring)) for start, ring in zip(starts, rings)]
    segments = np.concatenate([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in around])
    return np.concatenate([*rings, free]), segments.astype(np.int32), spacing


def measure(count, amplitude, steps):
    """How many vertices and segments there are, and median seconds: of `move`, of the domain's triangles, of a mesh from
    nothing, and of triangle. Raises where the triangles are not the same.
    """
    points, segments, spacing = scene(count)
    turn, hole = amplitude * spacing / 0.72, [[0.0, 0.0]]
    mesh, times = deldrift.Mesh(points, segments, holes=hole), []
    for _ in range(steps):
        points = sheared(points, turn)
        data = {"vertices": points, "segments": segments, "holes": np.array(hole)}
        of_move, _ = seconds(lambda: mesh.move(points))
        of_domain, ours = seconds(lambda: mesh.triangles)
        of_build, _ = seconds(lambda: deldrift.Mesh(points, segments, holes=hole).triangles)
        of_triangle, theirs = seconds(lambda: triangle.triangulate(data, "p")["triangles"])
        times.append((of_move, of_domain, of_build, of_triangle))
    assert as_sets(ours) == as_sets(theirs), "the triangles are not the same"
    return len(points), len(segments), *map(statistics.median, zip(*times))


def as_sets(triangles):
    return set(map(tuple, np.sort(triangles, axis=1).tolist()))


def milliseconds(seconds):
    value = 1e3 * seconds
    return f"{value:,.0f} ms" if value >= 100 else f"{value:#.3g} ms"


def table(rows):
    lines = ["| vertices | segments | a step, spacings | `move` | `triangles` | from nothing | triangle's `p` | |"]
    lines.append("|--:|--:|--:|--:|--:|--:|--:|--:|")
    for amplitude, count, n_segments, *times in rows:
        ratio = times[3] / (times[0] + times[1])
        cells = [f"{count:,}", f"{n_segments:,}", f"{amplitude:g}", *map(milliseconds, times), f"**{ratio:.1f}×**"]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vertices", type=int, nargs="*", default=[1_000, 10_000, 100_000])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--write-page", type=pathlib.Path, help="replaces what is between the marks of a page")
    given = parser.parse_args()
    rows = []
    for count in given.vertices:
        for amplitude in AMPLITUDES:
            rows.append((amplitude, *measure(count, amplitude, given.steps)))
            print(table(rows)[-1], flush=True)
    if given.write_page:
        pages.replace(given.write_page, "segments", table(rows))


if __name__ == "__main__":
    main()
