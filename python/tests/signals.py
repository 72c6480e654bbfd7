"""Signals at random times in every long call of the package: none is lost, and each call has been made or has not been.

`python signals.py [ROUNDS] [NAME...]` sends so many to each call, with and without callbacks: SIGALRM by a timer of the
system, and SIGINT by another process, in turn. Their handlers raise. It prints a line for each call: how many exceptions
came out of the call itself, how many after it, how many not at all, and how often a call had been made in part.

The last two must be none with CPython from 3.10 on. Before, and with PyPy, Python looks for signals between almost all
instructions: also between the last one of a `with` block and its end, which is then left out, in finalizers, and where NumPy
calls back, which drop what is raised there. So they are only counted.
"""

import gc
import os
import pickle
import platform
import random
import signal
import subprocess
import sys
import tempfile
import time
import traceback

import numpy as np

import deldrift

SENDER = """
import os, signal, sys, time
pid = int(sys.argv[1])
for line in sys.stdin:
    time.sleep(float(line))
    os.kill(pid, signal.SIGINT)
"""

CALLBACKS = {
    "none": lambda: {},
    "cancel": lambda: {"cancel": lambda: False},
    "progress": lambda: {"progress": lambda part: None},
    "both": lambda: {"cancel": lambda: False, "progress": lambda part: None},
}


IS_EXACT = sys.implementation.name == "cpython" and sys.version_info >= (3, 10)


class Alarm(Exception):
    """What the handler of SIGALRM raises."""


class Signals:
    """What sends signals, and what has been raised for them."""

    def __init__(self):
        self.raised, self.ignored = 0, []
        command = [sys.executable, "-c", SENDER, str(os.getpid())]
        self.sender = subprocess.Popen(command, stdin=subprocess.PIPE, text=True, bufsize=1)
        self.before = {kind: signal.signal(kind, self.handle) for kind in (signal.SIGALRM, signal.SIGINT)}
        self.hook = getattr(sys, "unraisablehook", None)
        sys.unraisablehook = lambda ignored: self.ignored.append(
            (ignored.err_msg, ignored.object, traceback.format_exception(None, ignored.exc_value, ignored.exc_traceback))
        )

    def handle(self, kind, _frame):
        self.raised += 1
        raise Alarm if kind == signal.SIGALRM else KeyboardInterrupt

    def send(self, after, by_timer):
        if by_timer:
            signal.setitimer(signal.ITIMER_REAL, after)
        else:
            self.sender.stdin.write(f"{after}\n")

    def close(self):
        for kind, handler in self.before.items():
            signal.signal(kind, handler)
        sys.unraisablehook = self.hook
        self.sender.stdin.close()
        self.sender.wait()


def points_and_size(tri):
    return tri.points.tobytes(), tri.nsimplex, tri.nvertices


def in_plane(mesh):
    return points_and_size(mesh.delaunay)


def nothing(_made):
    return None


def cases(callbacks, size=1):
    """Long calls: by name what makes their argument, the call, and what tells whether it has been made."""
    rng = np.random.default_rng(1)
    plane, space = rng.random((1500 * size, 2)), rng.random((1000 * size, 3))
    ring = np.column_stack([np.cos(np.arange(40) * np.pi / 20), np.sin(np.arange(40) * np.pi / 20)])
    sides = np.column_stack([np.arange(40), (np.arange(40) + 1) % 40])
    crossing = rng.integers(0, len(plane), (30, 2))
    crossing = crossing[crossing[:, 0] != crossing[:, 1]]

    def pristine(make):
        made = make()
        return lambda: made.copy()

    flat = pristine(lambda: deldrift.Delaunay(plane, algorithm="rebuilding", **callbacks()))
    solid = pristine(lambda: deldrift.Delaunay(space, **callbacks()))
    box = pristine(lambda: deldrift.PeriodicDelaunay(space[:300], [1, 1, 1], **callbacks()))
    disc = pristine(lambda: deldrift.Mesh(ring, sides, **callbacks()))
    fine = disc()
    fine.refine(greatest_area=0.005)
    saved = solid().tobytes()
    path = os.path.join(tempfile.mkdtemp(), "saved")
    solid().save(path)
    kept, kept_box = solid(), box()
    walls = [0, 0, 0], [1, 1, 1]
    around = rng.random((3000, 3))

    def step(tri):
        with tri.step() as step:
            step.move(space[:500] + 0.01, np.arange(500))
            step.insert(space[:50] + 0.001)
            step.remove([600, 601])

    def trial(tri):
        with tri.trial():
            tri.move(space + 0.01)
            tri.move(space[:50] + 0.02, np.arange(50))

    def withdrawn(tri):
        with tri.trial() as trial:
            tri.move(space + 0.01)
            trial.withdraw()
            tri.move(space[:50] + 0.02, np.arange(50))

    def trial_of_box(tri):
        with tri.trial():
            tri.move(space[:300] + 0.01)

    def split(tri):
        with tri.step() as step:
            step.add_segments(crossing)
            step.split()

    def read(tri):
        fresh = tri.copy()
        held = fresh.simplices, fresh.neighbors
        fresh.relocate(0, [0.5, 0.5, 0.5])
        return held, fresh.simplices, fresh.changes()

    return {
        "Delaunay, 2D": (lambda: plane, lambda rows: deldrift.Delaunay(rows, **callbacks()), nothing),
        "Delaunay, 3D": (lambda: space, lambda rows: deldrift.Delaunay(rows, **callbacks()), nothing),
        "PeriodicDelaunay": (lambda: space[:300], lambda rows: deldrift.PeriodicDelaunay(rows, [1] * 3, **callbacks()), nothing),
        "Mesh": (lambda: ring, lambda rows: deldrift.Mesh(rows, sides, **callbacks()), nothing),
        "frombytes": (lambda: saved, lambda data: deldrift.frombytes(data, **callbacks()), nothing),
        "load": (lambda: path, lambda name: deldrift.load(name, **callbacks()), nothing),
        "move, rebuilding": (flat, lambda tri: tri.move(plane[::-1]), points_and_size),
        "move": (solid, lambda tri: tri.move(space + 1e-3 * around[: len(space)]), points_and_size),
        "step": (solid, step, points_and_size),
        "split": (flat, split, points_and_size),
        "trial": (solid, trial, points_and_size),
        "trial, withdrawn": (solid, withdrawn, points_and_size),
        "add_points": (solid, lambda tri: tri.add_points(space[:200] + 0.001), points_and_size),
        "insert": (solid, lambda tri: [tri.insert(place) for place in around[:1]], points_and_size),
        "compact": (solid, lambda tri: tri.compact(), points_and_size),
        "box, move": (box, lambda tri: tri.move(space[:300] + 0.01, vectors=[1, 1, 1.1]), points_and_size),
        "box, insert": (box, lambda tri: tri.insert(around[:30]), points_and_size),
        "box, remove": (box, lambda tri: tri.remove([1, 2, 3]), points_and_size),
        "box, trial": (box, trial_of_box, points_and_size),
        "refine": (disc, lambda mesh: mesh.refine(greatest_area=0.005), in_plane),
        "refine, is_too_large": (disc, lambda mesh: mesh.refine(is_too_large=lambda _rows: mesh is None), in_plane),
        "coarsen": (fine.copy, lambda mesh: mesh.coarsen(), in_plane),
        "voronoi_volumes": (lambda: kept, lambda tri: tri.voronoi_volumes(walls), nothing),
        "voronoi_facets": (lambda: kept, lambda tri: tri.voronoi_facets(walls), nothing),
        "voronoi_cells": (lambda: kept, lambda tri: tri.voronoi_cells(walls), nothing),
        "voronoi_derivatives": (lambda: kept, lambda tri: tri.voronoi_derivatives(walls), nothing),
        "box, voronoi_volumes": (lambda: kept_box, lambda tri: tri.voronoi_volumes(), nothing),
        "box, edges": (lambda: kept_box, lambda tri: tri.edges(), nothing),
        "locate": (lambda: kept, lambda tri: tri.locate(around), nothing),
        "interpolate": (lambda: kept, lambda tri: tri.interpolate(space[:, 0], around, "natural"), nothing),
        "validate": (lambda: kept, lambda tri: tri.validate(), nothing),
        "tobytes": (lambda: kept, lambda tri: tri.tobytes(), nothing),
        "pickle": (lambda: kept, lambda tri: pickle.loads(pickle.dumps(tri)), nothing),
        "held arrays": (lambda: kept, read, nothing),
    }


def bring(signals, case, rounds, seed):
    """Calls and signals, so many; how many exceptions came in the call, after it, and not at all."""
    make, call, key = case
    chance, counts = random.Random(seed), [0, 0, 0, 0]
    made = make()
    before = key(made)
    start = time.perf_counter()
    call(made)
    duration = time.perf_counter() - start
    expected = before, key(made)
    for number in range(rounds):
        made, handled, is_made = make(), signals.raised, False
        try:
            signals.send(max(chance.random() * duration, 1e-6), number % 2 == 0)
            call(made)
            is_made = True
            for _ in range(100_000):
                if signals.raised != handled:
                    break
                time.sleep(1e-4)
            # A handler has run, and what it raised is not here.
            counts[2] += 1
        except (Alarm, KeyboardInterrupt):
            counts[is_made] += 1
        try:
            if key(made) not in expected:
                counts[3] += 1
            elif key is not nothing and number % 50 == 0:
                getattr(made, "delaunay", made).validate()
        except deldrift.Busy:
            counts[3] += 1
    if IS_EXACT and key is nothing and hasattr(made, "timestamp"):
        # Nothing is in use any more.
        made.move(made.points)
        made.validate()
    return counts


def main(rounds, names=(), kinds=tuple(CALLBACKS), write=print):
    signals = Signals()
    total = [0, 0, 0, 0]
    try:
        write(f"{platform.python_implementation()} {platform.python_version()}, {rounds} signals to each call")
        for kind in kinds:
            for number, (name, case) in enumerate(cases(CALLBACKS[kind]).items()):
                if names and name not in names:
                    continue
                # What is raised where garbage is collected is lost, whoever made it.
                gc.collect()
                counts = bring(signals, case, rounds, number)
                total = [a + b for a, b in zip(total, counts)]
                write(f"{name}; callbacks: {kind}: " + told(counts))
                if IS_EXACT:
                    assert counts[2:] == [0, 0] and not signals.ignored, (name, kind, counts, signals.ignored)
    finally:
        signals.close()
    write(f"{sum(total[:3])} signals: " + told(total))
    return total


def told(counts):
    return "{} in the call, {} after it, {} lost, {} in part".format(*counts)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000, sys.argv[2:])
