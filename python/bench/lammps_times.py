"""Times of Voronoi volumes in LAMMPS: of its own compute, of freud, and of a triangulation that lives through the run.

    python python/bench/lammps_times.py [--csv FILE] [--write-page FILE] [--atoms 4000 16000 32000]

Seconds are those of the processor, on one thread. All three are called in turn at each output, so that load on the
machine meets all, and medians are shown. python/bench/run_lammps installs what is needed below build/, and calls this.
"""

import argparse
import csv
import itertools
import pathlib
import statistics
import sys
import time

import freud
import numpy as np

import pages

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "examples"))
import lammps_voronoi as example  # noqa: E402

EVERY = {1: 5, 10: 5, 100: 3}
"""Steps from one output to the next, and how many such outputs are timed."""

PARTS = "hand over", "move", "volumes", "edges"
COLUMNS = ["LAMMPS", "freud", "first", *(f"{every} {part}" for every in EVERY for part in PARTS)]
CHECKS = ["sum off by", "off LAMMPS", "off freud", "other numbers of faces", "rebuilds"]


class Timed:
    """Times of what is called, by name."""

    def __init__(self):
        self.seconds = {name: [] for name in COLUMNS}

    def __call__(self, name, call, *arguments):
        start = time.process_time()
        result = call(*arguments)
        self.seconds[name].append(time.process_time() - start)
        return result

    def medians(self):
        return [statistics.median(each) if each else None for each in self.seconds.values()]


def first(frame):
    """What the first output of a run takes."""
    return example.Cells(threads=1).move(frame).volumes(frame)


def ends_inside(tri, frame):
    """The atoms with cells that end before the walls: a wall is a face of those that it cuts."""
    is_whole = np.isfinite(tri.voronoi_volumes())
    # A cell has its corners at the circumcentres of the simplices of its atom.
    centres, _ = tri.circumcentres()
    is_inside = (centres >= frame.low) & (centres <= frame.high) | ~frame.is_open
    is_whole[tri.simplices[~is_inside.all(axis=1)]] = False
    return is_whole


def measure(box, n_atoms):
    """Medians of seconds, and what the volumes are off by at most, of all outputs."""
    timed, sums, off_lammps, off_freud = Timed(), [], [], []
    rebuilds, other_faces = {every: 0 for every in EVERY}, 0
    lmp, cells = example.liquid(box, n_atoms), example.Cells(threads=1)
    lmp.command("run 1 post no")
    frame = example.Frame(lmp)
    for _ in range(3):
        timed("first", first, frame)
    cells.move(frame)
    for every, outputs in EVERY.items():
        for output in range(outputs + 1):
            lmp.command(f"run {every} post no")
            # The first output after a change of the interval finds out which algorithm pays.
            take = timed if output else lambda _, call, *arguments: call(*arguments)
            frame = take(f"{every} hand over", example.Frame, lmp)
            take(f"{every} move", cells.move, frame)
            ours = take(f"{every} volumes", cells.volumes, frame)
            edges = take(f"{every} edges", cells.tri.edges)
            rebuilds[every] += cells.tri.report.rebuilds
            lmp.command(example.RENEW)
            theirs, faces = take("LAMMPS", example.lammps_cells, lmp).T
            off_lammps.append(abs(theirs - ours).max())
            sums.append(abs(ours.sum() / frame.volume - 1))
            if not frame.is_open.all():
                neighbours = np.bincount(edges[0].ravel(), minlength=len(faces))
                other_faces += np.count_nonzero((neighbours != faces)[ends_inside(cells.tri, frame)])
            if not frame.is_open.any():
                off_freud.append(abs(take("freud", example.freud_volumes, frame) - ours).max())
    of_intervals = "/".join(map(str, rebuilds.values()))
    faces_off = None if frame.is_open.all() else other_faces
    checks = max(sums), max(off_lammps), max(off_freud, default=None), faces_off, of_intervals
    return len(ours), timed.medians(), checks


def table(rows):
    spans = " | ".join(f"after {every} step{'s' * (every > 1)}" for every in EVERY)
    head = f"| box | atoms | LAMMPS | freud | deldrift, first | {spans} | edges"
    lines = [f"{head} | sum off by | off LAMMPS | off freud | other faces |"]
    lines.append("|---|--:|--:|--:|--:|" + "--:|" * (len(EVERY) + 5))
    for box, n, times, (*off, other_faces, _) in rows:
        micros = {name: 1e6 * each / n for name, each in zip(COLUMNS, times) if each is not None}
        cells = [f"{micros[name]:.2f}" if name in micros else "" for name in COLUMNS[:3]]
        for every in EVERY:
            later = sum(micros[f"{every} {part}"] for part in PARTS[:3])
            cells.append(f"{later:.2f}, **{micros['LAMMPS'] / later:.1f}×**")
        cells.append(f"{statistics.median(micros[f'{every} edges'] for every in EVERY):.2f}")
        cells += [f"{each:.0e}" if each is not None else "" for each in off]
        cells.append("" if other_faces is None else str(other_faces))
        lines.append(f"| {box} | {n:,} | " + " | ".join(cells) + " |")
    return lines


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["box", "atoms", *(f"{name} s" for name in COLUMNS), *CHECKS])
        writer.writerows((box, n, *times, *checks) for box, n, times, checks in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--atoms", type=int, nargs="*", default=[4000, 16000, 32000])
    parser.add_argument("--csv", type=pathlib.Path, help="writes all numbers to a file")
    parser.add_argument("--write-page", type=pathlib.Path, help="replaces what is between the marks of a page")
    given = parser.parse_args()
    freud.parallel.set_num_threads(1)
    rows = []
    for box, n_atoms in itertools.product(example.BOXES, given.atoms):
        rows.append((box, *measure(box, n_atoms)))
        print(table(rows)[-1], flush=True)
        if given.csv:
            write_csv(given.csv, rows)
    if given.write_page:
        pages.replace(given.write_page, "lammps", table(rows))


if __name__ == "__main__":
    main()
