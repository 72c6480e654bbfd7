"""Points that move, triangulated at every step by a package of PyPI that has Triangle or TetGen inside.

Prints at every step the number of cells, and a number that the cells determine, whatever their order.

pypi_points.py PACKAGE POINTS STEPS
"""

import importlib
import sys
import zlib

import numpy


def cytriangle(points):
    """Triangle, switches Qzc."""
    triangulation = importlib.import_module("cytriangle").CyTriangle({"vertices": points})
    triangulation.convex_hull()
    return triangulation.output_dict()["triangles"]


def pygimli(points):
    """Triangle, switches -zeY."""
    meshtools = importlib.import_module("pygimli.meshtools")
    position = importlib.import_module("pygimli").Pos
    mesh = meshtools.createMesh([position(x, y) for x, y in points.tolist()])
    return [[node.id() for node in cell.nodes()] for cell in mesh.cells()]


def trianglelite(points):
    """Triangle compiled as C++, which keeps the hull, and does not refine where no angle is asked for."""
    package = importlib.import_module("trianglelite")
    engine, config = package.Engine(), package.Config()
    config.convex_hull, config.min_angle, config.verbose_level = True, 0, 0
    engine.in_points = points
    engine.run(config)
    return numpy.array(engine.out_triangles)  # what the engine shows is its own


def tetgenpy(points):
    """TetGen 1.6, switches Qfe."""
    package = importlib.import_module("tetgenpy")
    given = package.TetgenIO()
    given.setup_points(points)
    return package.tetrahedralize("Qfe", given).tetrahedra()


PACKAGES = {function.__name__: function for function in (cytriangle, pygimli, trianglelite, tetgenpy)}


def main(package, n_points, n_steps):
    dimension = 3 if package == "tetgenpy" else 2
    random = numpy.random.default_rng(1)
    points = random.random((n_points, dimension))
    velocities = random.normal(scale=0.01 / n_points ** (1 / dimension), size=points.shape)
    for step in range(n_steps):
        corners = numpy.sort(numpy.asarray(PACKAGES[package](points), dtype=numpy.int64), axis=1)
        rows = corners[numpy.lexsort(corners.T[::-1])]
        print(step, len(rows), zlib.crc32(rows.tobytes()))
        points = points + velocities


main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
