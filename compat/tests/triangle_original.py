"""Every list of the output beside that of Triangle, from the package triangle of PyPI, whose module has it inside.

triangle_original.py LIBRARY: libdeldrift_triangle_tetgen.so. The function of either is called by its address in its own
file. Rows of triangles and edges have no order; points and segments have.
"""

import ctypes
import sys

import numpy
import triangle.core

REALS, INTS = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_int)


class TriangulateIO(ctypes.Structure):
    _fields_ = [
        ("pointlist", REALS), ("pointattributelist", REALS), ("pointmarkerlist", INTS),
        ("numberofpoints", ctypes.c_int), ("numberofpointattributes", ctypes.c_int),
        ("trianglelist", INTS), ("triangleattributelist", REALS), ("trianglearealist", REALS), ("neighborlist", INTS),
        ("numberoftriangles", ctypes.c_int), ("numberofcorners", ctypes.c_int),
        ("numberoftriangleattributes", ctypes.c_int),
        ("segmentlist", INTS), ("segmentmarkerlist", INTS), ("numberofsegments", ctypes.c_int),
        ("holelist", REALS), ("numberofholes", ctypes.c_int), ("regionlist", REALS), ("numberofregions", ctypes.c_int),
        ("edgelist", INTS), ("edgemarkerlist", INTS), ("normlist", REALS), ("numberofedges", ctypes.c_int)]


COUNTS = [name for name, kind in TriangulateIO._fields_ if kind is ctypes.c_int]
LISTS = [name for name, kind in TriangulateIO._fields_ if kind is not ctypes.c_int]


def call(function, switches, points, attributes, markers, graph=None):
    """out and vorout. What the function leaves alone stays 77. graph: further lists of the input, by name."""
    given, out, vorout = TriangulateIO(), TriangulateIO(), TriangulateIO()
    for name, array in (graph or {}).items():
        setattr(given, name, array.ctypes.data_as(INTS if array.dtype == numpy.intc else REALS))
    given.numberofcorners = 3
    for name, count in (("segmentlist", "numberofsegments"), ("holelist", "numberofholes"),
                        ("regionlist", "numberofregions"), ("trianglelist", "numberoftriangles")):
        setattr(given, count, len((graph or {}).get(name, ())))
    given.pointlist = points.ctypes.data_as(REALS)
    given.pointattributelist = attributes.ctypes.data_as(REALS)
    given.pointmarkerlist = markers.ctypes.data_as(INTS)
    given.numberofpoints, given.numberofpointattributes = len(points), attributes.shape[1]
    for name in COUNTS:
        setattr(out, name, 77)
        setattr(vorout, name, 77)
    assert function(switches.encode(), ctypes.byref(given), ctypes.byref(out), ctypes.byref(vorout)) == 0
    return out, vorout


def rows(pointer, count, width):
    return numpy.ctypeslib.as_array(pointer, (count, width)) if pointer and count > 0 else numpy.zeros((0, width))


def by_triangle(out, vorout, first, rename=lambda points: points):
    """For each triangle its orientation, neighbours by the corner opposite, and circumcentre with attributes."""
    corners = rename(rows(out.trianglelist, out.numberoftriangles, 3))
    names = [tuple(sorted(row)) for row in corners.tolist()]
    neighbours = rows(out.neighborlist, out.numberoftriangles, 3).tolist()
    exact, rounded = {}, {}
    centres = rows(vorout.pointlist, vorout.numberofpoints, 2)
    attributes = rows(vorout.pointattributelist, vorout.numberofpoints, vorout.numberofpointattributes)
    for i, name in enumerate(names):
        row = corners[i].tolist()
        turn = row.index(min(row))
        opposite = {}
        if neighbours:
            opposite = {row[k]: names[n - first] if n != -1 else None for k, n in enumerate(neighbours[i])}
        exact[name] = (row[turn:] + row[:turn], opposite)
        if len(centres):
            rounded[name] = numpy.concatenate([centres[i], attributes[i]])
    return names, exact, rounded


def by_edge(out, vorout, names, first, rename=lambda points: points):
    """For each edge its marker, the triangles at its sides, and the ray. Triangle's edges go either way."""
    edges = rename(rows(out.edgelist, out.numberofedges, 2)).tolist()
    markers = rows(out.edgemarkerlist, out.numberofedges, 1).tolist()
    ends = rows(vorout.edgelist, vorout.numberofedges, 2).tolist()
    norms = rows(vorout.normlist, vorout.numberofedges, 2).tolist()
    result = {}
    for i, edge in enumerate(edges):
        sides = {names[t - first] if t != -1 else None for t in ends[i]} if ends and names else None
        result[tuple(sorted(edge))] = (markers[i] if markers else None, sides, norms[i] if norms else None)
    return result


def check(condition, what, switches):
    if not condition:
        sys.exit(f"{switches}: not the same: {what}")


def same_rows(a, b, name, width):
    pairs = [rows(getattr(each, name), each.numberofpoints, width) for each in (a, b)]
    return numpy.array_equal(*pairs)


def compare(own, other, switches):
    first = 0 if "z" in switches else 1
    for kind, a, b in zip(("out", "vorout"), own, other):
        for name in COUNTS:
            check(getattr(a, name) == getattr(b, name), f"{kind}.{name}", switches)
        for name in LISTS:
            check(bool(getattr(a, name)) == bool(getattr(b, name)), f"whether there is {kind}.{name}", switches)
    (a, dual), (b, other_dual) = own, other
    for name, width in (("pointlist", 2), ("pointattributelist", a.numberofpointattributes), ("pointmarkerlist", 1)):
        check(same_rows(a, b, name, width), f"out.{name}", switches)
    if a.segmentlist:
        for name, width in (("segmentlist", 2), ("segmentmarkerlist", 1)):
            pair = [rows(getattr(each, name), each.numberofsegments, width) for each in (a, b)]
            check(numpy.array_equal(*pair), f"out.{name}", switches)
    names, exact, rounded = by_triangle(a, dual, first)
    other_names, other_exact, other_rounded = by_triangle(b, other_dual, first)
    check(exact == other_exact, "triangles", switches)
    for name, row in rounded.items():
        check(numpy.allclose(row, other_rounded[name], rtol=1e-6, atol=1e-6), "Voronoi vertices", switches)
    check(by_edge(a, dual, names, first) == by_edge(b, other_dual, other_names, first), "edges", switches)


def check_points_at_one_place(own, other):
    """Which of them stays is not the same, but the places are."""
    points = numpy.random.default_rng(2).random((80, 2))
    points[[70, 71, 75]] = points[[3, 3, 20]]
    none, markers = numpy.zeros((80, 0)), numpy.zeros(80, dtype=numpy.intc)
    for switches in ("Qzj", "Qzjc", "Qzjpc", "Qzjp"):
        outs = [call(function, switches, points, none, markers)[0] for function in (own, other)]
        for name in COUNTS:
            check(getattr(outs[0], name) == getattr(outs[1], name), f"out.{name}", switches)
        places = [numpy.unique(rows(out.pointlist, out.numberofpoints, 2), axis=0) for out in outs]
        check(numpy.array_equal(*places), "places", switches)
        triangles = []
        for out in outs:
            numbers = rows(out.trianglelist, out.numberoftriangles, 3).astype(int)
            corners = rows(out.pointlist, out.numberofpoints, 2)[numbers]
            triangles.append(sorted(sorted(map(tuple, row)) for row in corners.tolist()))
        check(triangles[0] == triangles[1], "triangles", switches)


def main(library):
    own = ctypes.CDLL(library).triangulate
    other = ctypes.CDLL(triangle.core.__file__).triangulate
    random = numpy.random.default_rng(1)
    n_calls = 0
    for n in (3, 4, 40, 500):
        points, attributes = random.random((n, 2)), random.random((n, 2))
        markers = random.integers(0, 3, n).astype(numpy.intc)
        for switches in ("", "z", "ne", "nev", "zB", "zNe", "zEe", "zA", "zYYS3sOC", "c", "zc", "cenv", "zcB", "zcP",
                         "zcN", "pc", "zpcnev", "zpcAB", "zpcP", "p", "zpnev", "zpP", "zpj", "zj", "zjc", "jnev",
                         "zpcjA"):
            compare(call(own, "Q" + switches, points, attributes, markers),
                    call(other, "Q" + switches, points, attributes, markers), "Q" + switches)
            n_calls += 1
    check_points_at_one_place(own, other)
    print(f"{n_calls} calls, of every list no difference")


if __name__ == "__main__":
    main(sys.argv[1])
