"""Times of Voronoi volumes in a periodic cube, beside pyvoro2 and peclet-voro, and of power cells beside pyvoro2.

    python python/bench/boxes.py [--csv FILE] [--write-page FILE] [--sizes 1000 10000 100000]

Random points at unit density, so that a spacing is 1 and so is the volume of a cell on average. All of them go a step in
random directions, and come back on the other side of the cube. The three libraries get the same positions in turn, on one
thread, and are asked for the volumes of all cells; seconds are those of the processor, and medians are shown.
Weights are drawn up to one square of a spacing, which hides some 9 % of the points, and change by the length of the step.
python/bench/run_boxes installs what is needed below build/, and calls this.
"""

import argparse
import csv
import pathlib
import statistics
import sys
import time

import numpy as np
import peclet.voro
import pyvoro2

import deldrift
import pages

LENGTHS = 1e-4, 1e-3, 1e-2
N_TIMED = 5
# Steps that are not timed: a library may find out in them what pays.
N_BEFORE = 2

COLUMNS = ["pyvoro2", "peclet-voro", "deldrift move", "deldrift volumes", "deldrift edges"]
CHECKS = ["sum off by", "off pyvoro2", "off peclet-voro", "cells off", "other numbers of faces", "rebuilds"]

# Volumes farther than this from those of peclet-voro are counted.
FAR = 1e-6


POWER_COLUMNS = ["pyvoro2", "deldrift move", "deldrift volumes"]
POWER_CHECKS = ["sum off by", "off pyvoro2", "hidden"]


def without_faces(points, domain, **kind):
    """Volumes of cells by pyvoro2, which is asked for no more."""
    parts = dict.fromkeys(("return_vertices", "return_adjacency", "return_faces"), False)
    return pyvoro2.compute(points, domain=domain, **kind, **parts).cell_measures


class Peers:
    """What each library does with the points of a cube, and how long it takes."""

    def __init__(self, side):
        self.side, self.seconds = side, {name: [] for name in COLUMNS}
        self.domain = pyvoro2.OrthorhombicCell(((0, side),) * 3, periodic=(True,) * 3)
        self.tri, self.theirs, self.n_rebuilt = None, None, 0

    def timed(self, name, call, *arguments):
        start = time.process_time()
        result = call(*arguments)
        self.seconds[name].append(time.process_time() - start)
        return result

    def pyvoro2(self, points):
        return without_faces(points, self.domain)

    def peclet_voro(self, points):
        if self.theirs is None:
            self.theirs = peclet.voro.Tessellation()
            self.theirs.set_domain(extent=(self.side,) * 3)
            self.theirs.build(points)
        else:
            done = self.theirs.step(points)
            self.n_rebuilt += bool(done["rebuilt"] or done["fell_back"])
        return self.theirs.get_volumes()

    def move(self, points):
        if self.tri is None:
            self.tri = deldrift.PeriodicDelaunay(points, [self.side] * 3, threads=1)
        else:
            self.tri.move(points)

    def forget(self):
        """The next positions are triangulated from nothing."""
        self.tri = self.theirs = None

    def take(self, points):
        """Volumes of all cells by all three, timed, and what they are off by."""
        of_pyvoro2 = self.timed("pyvoro2", self.pyvoro2, points)
        of_peclet = self.timed("peclet-voro", self.peclet_voro, points)
        self.timed("deldrift move", self.move, points)
        ours = self.timed("deldrift volumes", self.tri.voronoi_volumes)
        edges, _ = self.timed("deldrift edges", self.tri.edges)
        faces = np.bincount(edges.ravel(), minlength=len(points))
        sum_off, off = abs(ours.sum() / self.side**3 - 1), abs(ours - of_pyvoro2).max()
        if sum_off > 1e-12 or off > 1e-10:
            sys.exit(f"the sum of volumes is off by {sum_off}, and volumes from those of pyvoro2 by {off}")
        n_off, n_faces = (abs(ours - of_peclet) > FAR).sum(), (faces != self.theirs.get_neighbor_counts()).sum()
        return sum_off, off, abs(ours - of_peclet).max(), n_off, n_faces

    def row(self, checks):
        """Medians of seconds, and of all positions timed the largest differences."""
        times = [statistics.median(each[-N_TIMED:]) for each in self.seconds.values()]
        return times, [*np.array(checks[-N_TIMED:]).max(axis=0).tolist(), self.n_rebuilt]


def measure(n):
    """The rows of one number of points: from nothing, and after steps of each length."""
    side, random = n ** (1 / 3), np.random.default_rng(n)
    begin, peers, checks = random.uniform(0, side, (n, 3)), Peers(side), []
    for _ in range(N_TIMED):
        peers.forget()
        checks.append(peers.take(begin))
        begin = random.uniform(0, side, (n, 3))
    yield n, 0.0, *peers.row(checks)
    for length in LENGTHS:
        peers, points, checks = Peers(side), begin, []
        peers.take(points)
        for _ in range(N_BEFORE + N_TIMED):
            directions = random.normal(size=(n, 3))
            points = (points + length * directions / np.linalg.norm(directions, axis=1)[:, None]) % side
            checks.append(peers.take(points))
        yield n, length, *peers.row(checks)


def measure_power(n):
    """The rows of power cells: pyvoro2 computes all anew, and deldrift moves."""
    side, random = n ** (1 / 3), np.random.default_rng(n)
    domain = pyvoro2.OrthorhombicCell(((0, side),) * 3, periodic=(True,) * 3)
    for length in 0.0, *LENGTHS:
        points, weights, tri = random.uniform(0, side, (n, 3)), random.uniform(0, 1, n), None
        seconds, checks = [], []
        for _ in range(N_BEFORE + N_TIMED):
            if length:
                directions = random.normal(size=(n, 3))
                points = (points + length * directions / np.linalg.norm(directions, axis=1)[:, None]) % side
                weights = weights + length * random.uniform(-1, 1, n)
            begin = time.process_time()
            theirs = without_faces(points, domain, mode="power", weights=weights, include_empty=True)
            after = time.process_time()
            if tri is None or not length:
                tri = deldrift.PeriodicRegular(points, [side] * 3, weights=weights, threads=1)
            else:
                tri.move(points, weights=weights)
            moved = time.process_time()
            volumes = tri.voronoi_volumes()
            seconds.append((after - begin, moved - after, time.process_time() - moved))
            sum_off, off = abs(volumes.sum() / side**3 - 1), abs(volumes - theirs).max()
            if sum_off > 1e-12 or off > 1e-10:
                sys.exit(f"the sum of volumes is off by {sum_off}, and volumes from those of pyvoro2 by {off}")
            checks.append((sum_off, off, (volumes == 0).sum()))
        yield n, length, np.median(seconds[-N_TIMED:], axis=0).tolist(), np.max(checks[-N_TIMED:], axis=0).tolist()


def power_head():
    return ["| points | | pyvoro2 | deldrift | beside pyvoro2 | off pyvoro2 | hidden |", "|--:|---|" + "--:|" * 5]


def power_line(n, length, times, checks):
    theirs, move, volumes = (1e6 * each / n for each in times)
    how = f"a step of {length:.0e}" if length else "from nothing"
    cells = [f"{n:,}", how, f"{theirs:.2f}", f"{move + volumes:.2f}", f"**{theirs / (move + volumes):.1f}×**"]
    return "| " + " | ".join([*cells, f"{checks[1]:.0e}", f"{int(checks[2]):,}"]) + " |"


def head():
    lines = ["| points | | pyvoro2 | peclet-voro | deldrift | beside pyvoro2 | beside peclet-voro | edges"]
    lines[0] += " | off pyvoro2 | off peclet-voro | other faces |"
    return [*lines, "|--:|---|" + "--:|" * 9]


def line(n, length, times, checks):
    pyvoro2_, peclet_, move, volumes, edges = (1e6 * each / n for each in times)
    ours = move + volumes
    how = f"a step of {length:.0e}" if length else "from nothing"
    cells = [f"{n:,}", how, f"{pyvoro2_:.2f}", f"{peclet_:.2f}", f"{ours:.2f}"]
    cells += [f"**{pyvoro2_ / ours:.1f}×**", f"**{peclet_ / ours:.1f}×**", f"{edges:.2f}"]
    cells += [f"{checks[1]:.0e}", f"{checks[2]:.0e}"]
    return "| " + " | ".join([*cells, f"{int(checks[4]):,}"]) + " |"


def write_csv(path, columns, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["points", "spacings", *columns])
        writer.writerows((n, length, *times, *checks) for n, length, times, checks in rows)


def measured(sizes, measure_one, line_of, path, columns):
    """Lines of a table, which are printed as they come; their numbers go to a file."""
    rows = []
    for n in sizes:
        for row in measure_one(n):
            rows.append(row)
            print(line_of(*row), flush=True)
            if path:
                write_csv(path, columns, rows)
    return [line_of(*row) for row in rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="*", default=[1000, 10_000, 100_000])
    parser.add_argument("--csv", type=pathlib.Path, help="writes all numbers to a file, and those of power cells beside it")
    parser.add_argument("--write-page", type=pathlib.Path, help="replaces what is between the marks of a page")
    given = parser.parse_args()
    beside = given.csv and given.csv.with_stem(given.csv.stem + "_power")
    columns = [f"{name} s" for name in COLUMNS] + CHECKS
    lines = measured(given.sizes, measure, line, given.csv, columns)
    power_columns = [f"{name} s" for name in POWER_COLUMNS] + POWER_CHECKS
    power_lines = measured(given.sizes, measure_power, power_line, beside, power_columns)
    if given.write_page:
        pages.replace(given.write_page, "boxes", [*head(), *lines])
        pages.replace(given.write_page, "power boxes", [*power_head(), *power_lines])


if __name__ == "__main__":
    main()
