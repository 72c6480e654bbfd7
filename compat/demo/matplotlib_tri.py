"""matplotlib triangulates the points of an animation at every frame, and interpolates between them.

They are in a square that is turned, with fixed points on its sides, which are straight but for rounding. Prints for
each frame its number, the count of triangles and the sum of the values that are interpolated at the places of a grid.

matplotlib_tri.py POINTS FRAMES
matplotlib_tri.py POINTS FRAMES grid    the points are a square grid, which turns on
"""

import sys

import matplotlib.tri
import numpy

n_points, n_frames = map(int, sys.argv[1:3])
side = round(n_points**0.5)
line = numpy.linspace(-1, 1, side)
if sys.argv[3:] == ["grid"]:
    points = numpy.array(numpy.meshgrid(line, line)).reshape(2, -1)
    velocities, angular_velocity = 0, 0.1
else:
    random = numpy.random.default_rng(1)
    sides = [[line, line * 0 + end][::order] for end in (-1, 1) for order in (1, -1)]
    points = numpy.hstack([*sides, 0.99 * random.uniform(-1, 1, (2, n_points - 4 * side))])
    velocities = random.normal(scale=0.01 / side, size=points.shape)
    velocities[:, :4 * side] = 0
    angular_velocity = 0
places = numpy.meshgrid(numpy.linspace(-0.6, 0.6, 50), numpy.linspace(-0.6, 0.6, 50))
for frame in range(n_frames):
    angle = 0.3 + frame * angular_velocity
    turn = numpy.array([[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]])
    x, y = turn @ points
    triangulation = matplotlib.tri.Triangulation(x, y)
    values = matplotlib.tri.LinearTriInterpolator(triangulation, 3 * x - 2 * y + 1)(*places)
    assert not numpy.ma.is_masked(values)
    print(frame, len(triangulation.triangles), repr(float(values.sum())))
    points += velocities
