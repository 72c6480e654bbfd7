"""A disc with a hole, an ellipse, that turns in it and stirs a dye: the mesh of what is between, at each step.

What is between shears. Then vertices that are not needed any more go, and others come where triangles have become too
narrow or too large, with the dye of what is around them. Nothing tells the mesh where the hole is but a seed at the
beginning. `python turning_hole.py docs/python_mesh.png` draws it.
"""

import sys

import numpy as np

import deldrift

OUTER, HOLE = 1, 2
"""Markers of segments."""


def ellipse(count, semi_axes, angle=0.0):
    turns = 2 * np.pi * np.arange(count) / count
    x, y = semi_axes[0] * np.cos(turns), semi_axes[1] * np.sin(turns)
    return np.stack([np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y], axis=1)


def sheared(points, turn):
    """Points that turn around the origin: with the hole near it, not at all at the outer boundary."""
    angles = turn * np.clip((0.98 - np.hypot(*points.T)) / (0.98 - 0.75), 0, 1)
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]], axis=1)


class Stirrer:
    """The mesh, the dye at each vertex, and what moves them."""

    def __init__(self, n_outer=72, n_hole=56, greatest_area=0.003):
        self.angle, self.n_outer, self.n_hole, self.n_cut = 0.0, n_outer, n_hole, 0
        self.quality = dict(least_angle=25, greatest_area=greatest_area)
        outer, hole = np.arange(n_outer), np.arange(n_hole) + n_outer
        segments = np.concatenate([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in (outer, hole)])
        markers = np.repeat([OUTER, HOLE], [n_outer, n_hole])
        vertices = np.concatenate([ellipse(n_outer, (1, 1)), self.hole_at(0)])
        self.mesh = deldrift.Mesh(vertices, segments, markers, holes=[[0, 0]])
        self.mesh.refine(**self.quality)
        self.dye = (self.mesh.points[:, 1] > 0).astype(float)

    def hole_at(self, angle):
        return ellipse(self.n_hole, (0.72, 0.22), angle)

    def step(self, turn):
        """Turns the hole by an angle, or by a part of it where a vertex would come to be on a segment."""
        goals = sheared(self.mesh.points, turn)
        goals[self.n_outer :][: self.n_hole] = self.hole_at(self.angle + turn)
        part = self.mesh.advance(goals)
        self.angle += part * turn
        self.n_cut += part < 1
        self.improve()

    def improve(self):
        """Vertices go and come. Dye stays with its vertices; those that come have what is between others."""
        self.mesh.coarsen(**self.quality)
        dye = self.mesh.refine(**self.quality, values=self.dye).values
        # Where there are too many vertices refinement has taken some away, too.
        self.dye = self.mesh.delaunay.compact(dye)[1]


def run(angles, turn=0.02):
    """Meshes at some angles, as near as steps come to them."""
    stirrer, kept = Stirrer(), []
    for angle in angles:
        while stirrer.angle < angle - turn / 2:
            stirrer.step(turn)
        kept.append((stirrer.angle, stirrer.mesh.copy(), stirrer.dye))
    return stirrer, kept


def draw(path, kept):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(kept), figsize=(5 * len(kept), 5.4))
    for ax, (angle, mesh, dye) in zip(axes, kept):
        ax.tripcolor(*mesh.points.T, mesh.triangles, dye, vmin=0, vmax=1, cmap="coolwarm", shading="gouraud")
        ax.triplot(*mesh.points.T, mesh.triangles, color="white", linewidth=0.3)
        for loop in mesh.boundary.loops():
            ax.plot(*mesh.points[np.append(loop, loop[0])].T, color="black", linewidth=1.5)
        said = f"{len(mesh.triangles)} triangles, least angle {least_angle(mesh):.1f}°"
        ax.set_title(f"{np.degrees(angle):.0f}°, {said}")
        ax.set_aspect("equal")
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(path, dpi=60)


def least_angle(mesh):
    """In degrees, of all triangles of the domain."""
    corners = mesh.points[mesh.triangles]
    u, v = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    return np.degrees(np.arctan2(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0], (u * v).sum(axis=-1))).min()


if __name__ == "__main__":
    last, meshes = run([0.0, np.pi / 2, np.pi])
    report = last.mesh.delaunay.statistics
    steps = last.mesh.delaunay.timestamp
    print(f"{last.mesh}, {steps} steps, {last.n_cut} of them cut, {report.flips} flips, {report.rebuilds} rebuilt")
    if len(sys.argv) > 1:
        draw(sys.argv[1], meshes)
