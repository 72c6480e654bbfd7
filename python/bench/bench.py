"""Times of the Python package: beside scipy's Delaunay, beside C, and of the import.

    python python/bench/bench.py [--csv FILE] [--write-page FILE] [--sizes 10000 100000]

Runs of both sides are in turn, so that load on the machine meets both, and medians are shown. The steps in C need a C
compiler, the header of the repository, and the library that the package uses.
"""

import argparse
import csv
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy import spatial

import deldrift
import pages
from deldrift import _library
from step import step

HERE = pathlib.Path(__file__).resolve().parent
SPACINGS = 1e-3
BLOCK = 7


def seconds(run):
    start = time.perf_counter()
    result = run()
    return time.perf_counter() - start, result


def points_of(count, ndim, seed=1):
    return np.random.default_rng(seed).random((count, ndim))


def frames_of(count, ndim, amplitude, number):
    """Positions that wander by a part of the mean spacing of the points in each step."""
    rng = np.random.default_rng(2)
    frames = [points_of(count, ndim)]
    scale = amplitude * count ** (-1 / ndim) / ndim**0.5
    for _ in range(number):
        frames.append(frames[-1] + scale * rng.standard_normal((count, ndim)))
    return np.array(frames)


def beside_scipy(count, ndim, rounds):
    """Median seconds of scipy's Delaunay, of this one, and of a step, in turn."""
    frames = frames_of(count, ndim, SPACINGS, 5 * rounds)
    of_scipy, of_build, of_step = [], [], []
    tri = deldrift.Delaunay(frames[0])
    step(tri, frames[0])
    for k in range(rounds):
        taken, theirs = seconds(lambda: spatial.Delaunay(frames[5 * k]))
        of_scipy.append(taken)
        taken, ours = seconds(lambda: built(frames[5 * k]))
        of_build.append(taken)
        assert abs(ours.nsimplex - theirs.nsimplex) <= 1e-5 * ours.nsimplex
        for positions in frames[5 * k + 1 : 5 * k + 6]:
            of_step.append(seconds(lambda: step(tri, positions))[0])
    return statistics.median(of_scipy), statistics.median(of_build), statistics.median(of_step)


def built(positions):
    tri = deldrift.Delaunay(positions)
    return tri if len(tri.simplices) and len(tri.neighbors) else None


def beside_c(ndim, amplitude, scratch, rounds=5):
    """Medians over some rounds, as how fast a step is also depends on where the system has put the arrays."""
    return tuple(np.median([one_beside_c(ndim, amplitude, scratch) for _ in range(rounds)], axis=0))


def one_beside_c(ndim, amplitude, scratch, number=50):
    """Median seconds of a step of 100,000 points in C and in Python, on one thread, and the median ratio of blocks.

    The seconds are those of the processor, which load on the machine hardly changes. Blocks of steps are in turn.
    """
    frames = frames_of(100_000, ndim, amplitude, number)
    data = scratch / "frames"
    with open(data, "wb") as file:
        np.array([ndim, 100_000, len(frames)], np.uint64).tofile(file)
        frames.tofile(file)
    commands = [scratch / "step", data], [sys.executable, HERE / "step.py", data]
    processes = [subprocess.Popen(each, stdin=subprocess.PIPE, stdout=subprocess.PIPE) for each in commands]
    blocks = [[[asked(process) for _ in range(BLOCK)] for process in processes] for _ in range(number // BLOCK)]
    for process in processes:
        process.communicate()
    # The first block finds out which algorithm pays, and the first step of each finds caches with what is the other's.
    medians = np.median(np.array(blocks)[1:, :, 1:], axis=2)
    return *np.median(medians, axis=0), np.median(medians[:, 1] / medians[:, 0])


def asked(process):
    """How long the next step of a process takes."""
    process.stdin.write(b"\n")
    process.stdin.flush()
    return float(process.stdout.readline())


def compile_step(scratch):
    library = pathlib.Path(_library._find()).resolve()
    # As the build of the repository names it, and as that of the wheel does.
    for name in "libdeldrift.so.0.1", "libdeldrift.so":
        shutil.copy(library, scratch / name)
    command = ["cc", "-O2", f"-I{HERE.parent.parent / 'include'}", HERE / "step.c", "-o", scratch / "step"]
    subprocess.run(command + [scratch / "libdeldrift.so", f"-Wl,-rpath,{scratch}"], check=True)


def import_times(rounds=11):
    """Milliseconds of `import deldrift` after NumPy, least and median; bytecode is there, as pip leaves it."""
    script = (
        "import time, numpy; start = time.perf_counter(); import deldrift; print(1e3 * (time.perf_counter() - start))"
    )
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    times = [
        float(subprocess.check_output([sys.executable, "-c", script], env=environment, text=True))
        for _ in range(rounds + 1)
    ][1:]
    return min(times), statistics.median(times)


def milliseconds(seconds):
    """With three digits."""
    value = 1e3 * seconds
    return f"{value:,.0f} ms" if value >= 100 else f"{value:#.3g} ms"


def table_of_scipy(rows):
    lines = ["| points | | scipy's Delaunay | `Delaunay(points)` | | a step | |", "|--:|---|--:|--:|--:|--:|--:|"]
    for count, ndim, *times in rows:
        of_scipy, of_build, of_step = map(milliseconds, times)
        to_build, to_step = times[0] / times[1], times[0] / times[2]
        lines.append(
            f"| {count:,} | {ndim}D | {of_scipy} | {of_build} | **{to_build:.1f}×** | {of_step} | **{to_step:.0f}×** |"
        )
    return lines


def table_of_c(rows):
    lines = ["| 100,000 points move by | | in C | in Python | |", "|--:|---|--:|--:|--:|"]
    for ndim, amplitude, in_c, in_python, ratio in rows:
        part = 100 * (ratio - 1)
        lines.append(
            f"| {amplitude:g} spacings | {ndim}D | {1e3 * in_c:.3f} ms | {1e3 * in_python:.3f} ms | {part:+.1f} % |"
        )
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="*", default=[10_000, 100_000, 1_000_000])
    parser.add_argument("--csv", type=pathlib.Path, help="writes all numbers to a file")
    parser.add_argument("--write-page", type=pathlib.Path, help="replaces what is between the marks of a page")
    given = parser.parse_args()

    records, scipy_rows, c_rows = [], [], []
    for count in given.sizes:
        for ndim in 2, 3:
            row = beside_scipy(count, ndim, 5 if count <= 10_000 else 3 if count <= 100_000 else 1)
            scipy_rows.append((count, ndim, *row))
            records += zip(["scipy", "build", "step"], [ndim] * 3, [count] * 3, [SPACINGS] * 3, row)
            print(table_of_scipy(scipy_rows)[-1], flush=True)
    if shutil.which("cc"):
        with tempfile.TemporaryDirectory() as folder:
            compile_step(pathlib.Path(folder))
            for ndim in 2, 3:
                for amplitude in 0, 1e-5, 1e-3, 1e-2:
                    row = beside_c(ndim, amplitude, pathlib.Path(folder))
                    c_rows.append((ndim, amplitude, *row))
                    names = "step in C", "step in Python", "ratio of steps"
                    records += zip(names, [ndim] * 3, [100_000] * 3, [amplitude] * 3, row)
                    print(table_of_c(c_rows)[-1], flush=True)
    else:
        print("SKIPPED steps in C: there is no C compiler")
    least, median = import_times()
    records.append(("import", "", "", "", median / 1e3))
    sentence = f"`import deldrift` takes {least:.1f} ms after NumPy (the least of 11; the median is {median:.1f})."
    print(sentence)

    text = "\n".join([*table_of_scipy(scipy_rows), "", *table_of_c(c_rows), "", sentence, ""])
    if given.csv:
        with open(given.csv, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["what", "dimension", "points", "spacings", "seconds or ratio"])
            writer.writerows(records)
    if given.write_page:
        pages.replace(given.write_page, "bench", [text])


if __name__ == "__main__":
    main()
