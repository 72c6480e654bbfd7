"""A disc with a hole, an ellipse, that turns in it: the mesh of what is between, at each step.

What is between shears, vertices there then go to the middle of their neighbours, and triangles are those of the new
places. Nothing tells the mesh where the hole is but a seed at the beginning. `python turning_hole.py
docs/python_mesh.png` draws it.
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
    """The mesh, and what moves it."""

    def __init__(self, n_free=700, n_outer=72, n_hole=56, seed=1):
        self.angle, self.n_outer, self.n_hole, self.n_cut = 0.0, n_outer, n_hole, 0
        places = np.random.default_rng(seed).uniform(-1, 1, (8 * n_free, 2))
        is_between = (np.hypot(*places.T) < 0.97) & (np.hypot(places[:, 0] / 0.75, places[:, 1] / 0.25) > 1.05)
        vertices = np.concatenate([ellipse(n_outer, (1, 1)), self.hole_at(0), places[is_between][:n_free]])
        outer, hole = np.arange(n_outer), np.arange(n_hole) + n_outer
        segments = np.concatenate([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in (outer, hole)])
        markers = np.repeat([OUTER, HOLE], [n_outer, n_hole])
        self.mesh = deldrift.Mesh(vertices, segments, markers, holes=[[0, 0]])
        for _ in range(30):
            self.smooth()

    def hole_at(self, angle):
        return ellipse(self.n_hole, (0.72, 0.22), angle)

    def step(self, turn):
        """Turns the hole by an angle, or by a part of it where a vertex would come to be on a segment."""
        goals = sheared(self.mesh.points, turn)
        goals[self.n_outer :][: self.n_hole] = self.hole_at(self.angle + turn)
        part = self.mesh.advance(goals)
        self.angle += part * turn
        self.n_cut += part < 1
        self.smooth()

    def smooth(self):
        """Moves vertices to the middle of their neighbours, those that stay in the domain."""
        mesh = self.mesh
        free = np.arange(self.n_outer + self.n_hole, len(mesh.points))
        goals = 0.5 * (mesh.points + middles(mesh))[free]
        at = mesh.delaunay.find_simplex(goals)
        stays = (at >= 0) & mesh.mask[at]
        mesh.advance(goals[stays], free[stays])


def middles(mesh):
    """For each vertex the mean of those that it shares a triangle of the domain with."""
    sums, counts = np.zeros_like(mesh.points), np.zeros(len(mesh.points))
    triangles = mesh.triangles
    for k in range(3):
        for beside in (triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]):
            np.add.at(sums, triangles[:, k], mesh.points[beside])
            np.add.at(counts, triangles[:, k], 1)
    return sums / np.maximum(counts, 1)[:, None]


def run(angles, turn=0.02):
    """Meshes at some angles, as near as steps come to them."""
    stirrer, kept = Stirrer(), []
    for angle in angles:
        while stirrer.angle < angle - turn / 2:
            stirrer.step(turn)
        kept.append((stirrer.angle, stirrer.mesh.copy()))
    return stirrer, kept


def draw(path, kept):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from distmesh import qualities

    figure, axes = plt.subplots(1, len(kept), figsize=(5 * len(kept), 5.4))
    for ax, (angle, mesh) in zip(axes, kept):
        quality = qualities(mesh.points, mesh.triangles)
        style = dict(vmin=0, vmax=1, cmap="viridis", edgecolor="white", linewidth=0.3)
        ax.tripcolor(*mesh.points.T, mesh.triangles, quality, **style)
        for loop in mesh.boundary.loops():
            ax.plot(*mesh.points[np.append(loop, loop[0])].T, color="black", linewidth=1.5)
        ax.set_title(f"{np.degrees(angle):.0f}°, {len(mesh.triangles)} triangles, mean quality {quality.mean():.2f}")
        ax.set_aspect("equal")
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(path, dpi=60)


if __name__ == "__main__":
    last, meshes = run([0.0, np.pi / 4, np.pi / 2])
    report = last.mesh.delaunay.statistics
    steps = last.mesh.delaunay.timestamp
    print(f"{last.mesh}, {steps} steps, {last.n_cut} of them cut, {report.flips} flips, {report.rebuilds} rebuilt")
    if len(sys.argv) > 1:
        draw(sys.argv[1], meshes)
