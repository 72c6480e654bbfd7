"""A tissue without borders: Voronoi cells of points in a periodic box, which is sheared; then the cells crawl.

The self-propelled Voronoi model of D. Bi, X. Yang, M. C. Marchetti and M. L. Manning (Phys. Rev. X 6, 021011, 2016): a
cell would have an area of 1 and a perimeter of p0, and crawls in a direction that diffuses. The tissue is solid where
p0 and the speed are small, and else fluid. `python tissue.py docs/tissue.svg` draws one of each.
"""

import pathlib
import sys

import numpy as np

import deldrift


class Shapes:
    """Voronoi cells. Their corners are the circumcentres of the triangles, in the period in which the triangle is."""

    def __init__(self, tri):
        self.simplices, self.sites = tri.simplices, tri.corners
        self.sides = sides = self.sites[:, 1:] - self.sites[:, :1]
        self.corners = self.sites[:, 0] + np.linalg.solve(sides, (sides**2).sum(axis=2, keepdims=True) / 2)[..., 0]
        # Counter-clockwise around the site of corner k of a triangle, the next triangle is opposite corner k + 1.
        self.others = self.corners[tri.neighbors] + tri.neighbor_shifts @ tri.vectors
        self.lengths = np.linalg.norm(self.others - self.corners[:, None], axis=2)
        self.around, ahead = self.corners[:, None] - self.sites, self.others[:, [1, 2, 0]] - self.sites
        self.areas = self.by_cell(self.around[..., 0] * ahead[..., 1] - self.around[..., 1] * ahead[..., 0]) / 2
        self.perimeters = self.by_cell(self.lengths[:, [1, 2, 0]])

    def by_cell(self, values):
        return np.bincount(self.simplices.ravel(), values.ravel())

    def gradient(self, of_areas, of_perimeters):
        """Derivatives by the sites of what has these derivatives by areas and perimeters."""
        turned = (self.others[:, [1, 2, 0]] - self.others[:, [2, 0, 1]])[..., ::-1] * [0.5, -0.5]
        pulls = (self.corners[:, None] - self.others) / np.maximum(self.lengths, 1e-300)[..., None]
        of_edges = of_perimeters[self.simplices].sum(axis=1, keepdims=True) - of_perimeters[self.simplices]
        by_corner = (of_areas[self.simplices, None] * turned + of_edges[..., None] * pulls).sum(axis=1)
        # The corner stays as far from site k as from site 0: with f as weights of these two conditions,
        # by_corner · d corner is the sum of f_k (site k - corner) · d site k - f_k (site 0 - corner) · d site 0.
        f = np.linalg.solve(self.sides.transpose(0, 2, 1), by_corner[..., None])[..., 0]
        by_site = -self.around * np.stack([-f.sum(axis=1), *f.T], axis=1)[..., None]
        return np.stack([self.by_cell(by_site[..., k]) for k in (0, 1)], axis=1)


class Tissue:
    """Cells in a square box, or in what it has been sheared to. One triangulation lives as long as they do."""

    def __init__(self, n, p0, seed=1):
        self.p0, self.rng = p0, np.random.default_rng(seed)
        self.headings, points = self.rng.uniform(0, 2 * np.pi, n), self.rng.random((n, 2)) * np.sqrt(n)
        self.tri = deldrift.PeriodicDelaunay(points, [np.sqrt(n)] * 2)
        self.shapes = Shapes(self.tri)

    @property
    def energy(self):
        return ((self.shapes.areas - 1) ** 2 + (self.shapes.perimeters - self.p0) ** 2).sum()

    def forces(self):
        return -self.shapes.gradient(2 * (self.shapes.areas - 1), 2 * (self.shapes.perimeters - self.p0))

    def move(self, points, vectors=None):
        self.tri.move(points, vectors=vectors)
        self.shapes = Shapes(self.tri)

    def crawl(self, steps, v0, dt=0.05, turning=1.0):
        """Cells go where forces and headings take them. Returns where they were at each step."""
        path = [self.tri.points]
        for _ in range(steps):
            crawling = v0 * np.stack([np.cos(self.headings), np.sin(self.headings)], axis=1)
            self.move(path[-1] + dt * (self.forces() + crawling))
            self.headings += self.rng.normal(0, np.sqrt(2 * turning * dt), len(crawling))
            path.append(self.tri.points)
        return np.array(path)

    def relax(self, steps, longest=0.1):
        """Cells go where forces take them; where that would raise the energy, half as far. Returns all energies."""
        energies, dt = [self.energy], longest
        for _ in range(steps):
            points, forces, dt = self.tri.points, self.forces(), min(1.25 * dt, longest)
            self.move(points + dt * forces)
            while self.energy > energies[-1] and dt > 1e-6:
                dt /= 2
                self.move(points + dt * forces)
            energies.append(self.energy)
        return energies

    def shear(self, strain):
        """The box and all that is in it lean to the right, by a part of the height."""
        lean = np.array([[1, 0], [strain, 1]])
        self.move(self.tri.points @ lean, self.tri.vectors @ lean)

    def errors(self, cells=8, h=1e-5):
        """Of areas, to those of the library; of their sum, to the box; of some forces, to differences of the energy."""
        points, forces, energies = self.tri.points, self.forces(), np.empty((cells, 2, 2))
        of_areas = np.abs(self.shapes.areas - self.tri.voronoi_volumes()).max()
        of_sum = abs(self.shapes.areas.sum() / np.linalg.det(self.tri.vectors) - 1)
        for cell, axis, side in np.ndindex(energies.shape):
            moved = points.copy()
            moved[cell, axis] += h * (2 * side - 1)
            self.move(moved)
            energies[cell, axis, side] = self.energy
        self.move(points)
        return of_areas, of_sum, np.abs(forces[:cells] + (energies[..., 1] - energies[..., 0]) / (2 * h)).max()


def run(p0, n=400, strains=30, steps=1000):
    """A tissue that relaxes, is sheared slowly, and then crawls; its energies at each strain, and its ways."""
    tissue = Tissue(n, p0)
    energies = tissue.relax(steps)[-1:]
    for _ in range(strains):
        tissue.shear(0.01)
        energies.append(tissue.relax(steps // 20)[-1])
    return tissue, energies, tissue.crawl(steps, v0=0.5)


def outlines(tissue, ways):
    """What to draw, each once: cells, darker with a longer perimeter, ways that cells have come, and the box."""
    vectors, home = tissue.tri.vectors, tissue.tri.points
    home = home - np.floor(home @ np.linalg.inv(vectors)) @ vectors
    around, cell = tissue.shapes.around.reshape(-1, 2), tissue.shapes.simplices.ravel()
    order = np.lexsort([np.arctan2(around[:, 1], around[:, 0]), cell])
    polygons = np.split((around + home[cell])[order], np.cumsum(np.bincount(cell))[:-1])
    shades = np.clip((tissue.shapes.perimeters[:, None] - 3.5) / 0.8, 0, 1) * [-190, -100, -60] + 235
    for polygon, shade in zip(polygons, shades.astype(int)):
        yield "polygon stroke='white' fill='#%02x%02x%02x'" % tuple(shade), polygon
    for way in (ways - ways[-1] + home)[::20, :24].swapaxes(0, 1):
        yield "polyline stroke='crimson' fill='none'", way
    yield "polygon stroke='black' fill='none'", np.array([[0, 0], vectors[0], vectors[0] + vectors[1], vectors[1]])


def draw(path, runs):
    side = runs[0][0].tri.vectors[0, 0]
    svg = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1 {-side - 1} {1.4 * side * len(runs)} {side + 2}'><g>"]
    for number, (tissue, _, ways) in enumerate(runs):
        svg.append(f"</g><g transform='matrix(1 0 0 -1 {1.4 * side * number} 0)' stroke-width='0.06'>")
        for style, corners in outlines(tissue, ways):
            svg.append(f"<{style} points='{' '.join(f'{x:.2f},{y:.2f}' for x, y in corners)}'/>")
    pathlib.Path(path).write_text("\n".join(svg) + "</g></svg>\n")


if __name__ == "__main__":
    runs = [run(p0) for p0 in (3.4, 3.9)]
    for tissue, energies, ways in runs:
        far = np.linalg.norm(ways[-1] - ways[0], axis=1).mean()
        print(f"p0 = {tissue.p0}: energy {energies[0]:.2f}, sheared {energies[-1]:.2f}; crawling leads {far:.1f} away")
        print("{} moves, areas within {:.0e}, sum {:.0e}, forces {:.0e}".format(tissue.tri.timestamp, *tissue.errors()))
    if len(sys.argv) > 1:
        draw(sys.argv[1], runs)
