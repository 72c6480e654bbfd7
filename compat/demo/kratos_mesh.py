"""Nodes that move, meshed with triangles at every step by KratosMultiphysics.

Prints at every step the number of elements, and a number that the elements determine, whatever their order.

kratos_mesh.py NODES STEPS
"""

import sys
import zlib

import KratosMultiphysics
import numpy


def elements_of(points):
    model = KratosMultiphysics.Model()
    part = model.CreateModelPart("nodes")
    for i, (x, y) in enumerate(points.tolist()):
        part.CreateNewNode(i + 1, x, y, 0.0)
    KratosMultiphysics.CreateTriangleMeshFromNodes.CreateTriangleMeshFromNodes(part)
    return numpy.array([[node.Id for node in element.GetNodes()] for element in part.Elements])


def main(n_nodes, n_steps):
    random = numpy.random.default_rng(1)
    points = random.random((n_nodes, 2))
    velocities = random.normal(scale=0.01 / n_nodes**0.5, size=points.shape)
    for step in range(n_steps):
        corners = numpy.sort(elements_of(points), axis=1)
        rows = corners[numpy.lexsort(corners.T[::-1])]
        print(step, len(rows), zlib.crc32(rows.tobytes()))
        points += velocities


main(int(sys.argv[1]), int(sys.argv[2]))
