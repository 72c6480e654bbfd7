"""Points that move, triangulated at every step by the package triangle of PyPI.

pypi_triangle.py POINTS STEPS
"""

import sys

import numpy
import triangle

n_points, n_steps = map(int, sys.argv[1:3])
random = numpy.random.default_rng(1)
points = random.random((n_points, 2))
velocities = random.normal(scale=0.01 / n_points**0.5, size=points.shape)
for step in range(n_steps):
    result = triangle.triangulate({"vertices": points}, "n")
    assert len(result["triangles"]) == len(result["neighbors"]) > n_points
    points += velocities
print(n_points, n_steps)
