"""Points that move, triangulated at every step by the package triangle of PyPI.

pypi_triangle.py STEPS POINTS...: a set of each number of points.
"""

import sys

import numpy
import triangle


def check(result, n_points):
    """Euler's formula, with an edge of the hull for each neighbour that is missing."""
    n_triangles, n_hull = len(result["triangles"]), numpy.count_nonzero(result["neighbors"] == -1)
    assert len(result["neighbors"]) == n_triangles == 2 * n_points - 2 - n_hull


n_steps, *sizes = map(int, sys.argv[1:])
random = numpy.random.default_rng(1)
for n in sizes:
    points = random.random((n, 2))
    velocities = random.normal(scale=0.01 / n**0.5, size=points.shape)
    for step in range(n_steps):
        check(triangle.triangulate({"vertices": points}, "n"), n)
        points += velocities
    print(n, n_steps)
