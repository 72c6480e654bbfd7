"""GetFEM generates a mesh of a disc or a ball, of elements of a given size.

Prints the dimension, the numbers of points and elements, the volume, and the least and the mean quality of elements.

getfem_mesh.py DIMENSION SIZE
"""

import sys

import getfem
import numpy

dimension, size = int(sys.argv[1]), float(sys.argv[2])
getfem.util("trace level", 0)
mesh = getfem.Mesh("generate", getfem.MesherObject("ball", [0.0] * dimension, 1.0), size)
corners = numpy.reshape(mesh.pid_from_cvid()[0], (-1, dimension + 1))
places = mesh.pts().T[corners]
volumes = abs(numpy.linalg.det(places[:, 1:] - places[:, :1])) / (2 if dimension == 2 else 6)
# The order of elements is free, that of the sum is not.
volume = float(numpy.sort(volumes).sum())
quality = mesh.quality()
print(dimension, mesh.pts().shape[1], len(corners), repr(volume), quality.min(), quality.mean())
