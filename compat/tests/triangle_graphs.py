"""Planar straight-line graphs: every list of the output beside that of Triangle, as in triangle_original.py.

triangle_graphs.py LIBRARY [FIRST COUNT]: libdeldrift_triangle_tetgen.so, and which of the random inputs.

Numbers of points are compared but for those at crossings, which either library adds in an order of its own, and of
points at one place, of which either keeps one; with j its marker and attributes are those of one of them. Of points
that are in no triangle, markers are not compared. Where rounding decides what follows from a crossing,
triangle_rounding.py says what is compared. Triangle runs in a process of its own first: there are inputs with which
it fails or does not end; they are served here, and counted.
"""

import collections
import ctypes
import os
import signal
import sys

import numpy
import triangle.core
from triangle_original import COUNTS, LISTS, by_edge, by_triangle, call, rows
from triangle_rounding import TOLERANCE, Different, check, compare_rounded, have_same_areas, look

SECONDS = 5  # after which Triangle does not end


def integers(*lists):
    return numpy.array(lists, dtype=numpy.intc)


class Graph:
    """An input in the making."""

    def __init__(self, random):
        self.random, self.points, self.segments, self.holes, self.regions = random, [], [], [], []

    def add_points(self, points):
        first = sum(map(len, self.points))
        self.points.append(numpy.asarray(points, dtype=float))
        return first

    def add_segment(self, a, b):
        self.segments.append((a, b) if self.random.random() < 0.5 else (b, a))

    def add_loop(self, centre, least, most, n):
        """A star-shaped polygon, in steps that are not even."""
        angles = 2 * numpy.pi * (numpy.arange(n) + 0.7 * self.random.random(n)) / n
        radii = self.random.uniform(least, most, n)[:, None]
        first = self.add_points(centre + radii * numpy.stack([numpy.cos(angles), numpy.sin(angles)], 1))
        for i in range(n):
            self.add_segment(first + i, first + (i + 1) % n)
        return first

    def add_line(self, a, b):
        first = self.add_points([a, b])
        self.add_segment(first, first + 1)

    def finish(self, switches):
        """Shuffled, numbered, with markers and attributes."""
        random = self.random
        points = numpy.concatenate(self.points)
        order = random.permutation(len(points))
        segments = numpy.argsort(order)[numpy.array(self.segments, dtype=int).reshape(-1, 2)]
        segments = random.permutation(segments) + (0 if "z" in switches else 1)
        lists = {"segmentlist": segments.astype(numpy.intc)}
        if random.random() < 0.7:
            lists["segmentmarkerlist"] = random.integers(0, 4, len(segments)).astype(numpy.intc)
        if self.holes:
            lists["holelist"] = numpy.array(self.holes, dtype=float)
        if self.regions:
            rows_of = [[x, y, random.integers(1, 9), 0] for x, y in self.regions]
            lists["regionlist"] = numpy.array(rows_of, dtype=float)
        markers = random.integers(0, 2, len(points)) * random.integers(0, 9, len(points))
        attributes = random.random((len(points), int(random.integers(0, 3))))
        return points[order].copy(), attributes, markers.astype(numpy.intc), lists


def domain(graph):
    """A loop with loops inside, holes and regions in some of them, chords, and points everywhere."""
    random = graph.random
    graph.add_loop([0, 0], 0.6, 1, int(random.integers(3, 40)))
    for centre in ([-0.2, -0.2], [0.25, 0.2], [0, 0.01]):
        kind = random.integers(0, 4)
        if kind == 0:
            continue
        graph.add_loop(centre, 0.03, 0.12 if centre[1] != 0.01 else 0.03, int(random.integers(3, 15)))
        if kind == 1:
            graph.holes.append(centre)
        if kind == 2:
            graph.regions.append(centre)
    graph.add_points(random.uniform(-1, 1, (int(random.integers(0, 60)), 2)))
    if random.random() < 0.5:
        graph.regions.append([0.01, -0.13])
    if random.random() < 0.3:
        graph.holes.append([5.0, 5.0])
    if random.random() < 0.2:
        graph.holes.append([0.02, -0.14])


def slits(graph):
    """Segments that end in the inside, on their own or at others' ends; open chains."""
    domain(graph)
    for _ in range(int(graph.random.integers(1, 6))):
        first = graph.add_points(graph.random.uniform(-0.02, 0.02, (4, 2)) + graph.random.choice([0.42, -0.42], 2))
        for i in range(int(graph.random.integers(1, 4))):
            graph.add_segment(first + i, first + i + 1)


def touching(graph):
    """Points on segments, exactly: whole numbers, at eighths of the way. Ends on others, chains, overlaps."""
    random = graph.random
    graph.add_loop([0, 0], 0.9, 1, int(random.integers(3, 8)))
    graph.points[0] = numpy.round(graph.points[0] * 2**20) * 8
    points = graph.points[0]
    n = len(points)
    pairs = [(a, b) for a in range(n) for b in range(a)]
    for pair in random.permutation(len(pairs))[: int(random.integers(1, 12))]:
        # Between two points, on which there are further ones, of which some are joined with others.
        a, b = pairs[pair]
        eighths = numpy.sort(random.choice(7, int(random.integers(1, 4)), replace=False)) + 1
        new = points[a] + eighths[:, None] * ((points[b] - points[a]) / 8)
        first = graph.add_points(new)
        if random.random() < 0.5:
            graph.add_segment(a, b)
        if len(new) > 1 and random.random() < 0.5:
            graph.add_segment(first, first + 1)
        if random.random() < 0.3:
            graph.add_segment(a, first + len(new) - 1)
    graph.points.append(random.uniform(-2**22, 2**22, (int(random.integers(0, 40)), 2)))
    if random.random() < 0.5:
        graph.regions.append([1234.5, 777.25])


def crossing(graph):
    """Segments that cross each other and the boundary."""
    domain(graph)
    for _ in range(int(graph.random.integers(1, 12))):
        graph.add_line(*graph.random.uniform(-1.2, 1.2, (2, 2)))


def repeated(graph):
    """Segments given more than once, segments from a point to itself, and points at one place. Triangle crashes where a
    segment ends at such points."""
    slits(graph)
    random = graph.random
    for i in random.choice(len(graph.segments), int(random.integers(1, 6))):
        graph.add_segment(*graph.segments[i])
    graph.add_segment(0, 0)
    graph.add_points(random.uniform(-1, 1, (int(random.integers(1, 5)), 2)))
    graph.add_points(graph.points[-1][random.choice(len(graph.points[-1]), int(random.integers(1, 6)))])


def lattice(graph):
    """Small whole numbers: everything on lines and circles."""
    random = graph.random
    side = int(random.integers(3, 8))
    corners = [[0, 0], [side, 0], [side, side], [0, side]]
    inside = random.integers(0, side + 1, (int(random.integers(4, 40)), 2)).tolist()
    places = corners + [list(place) for place in {tuple(place) for place in inside if place not in corners}]
    graph.add_points(places)
    for _ in range(int(random.integers(1, 10))):
        graph.add_segment(*random.choice(len(places), 2, replace=False))
    for i in range(4):
        graph.add_segment(i, (i + 1) % 4)
    graph.regions.append([0.31, 0.13])  # on no line between points
    if random.random() < 0.3:
        graph.holes.append([side - 0.31, 0.13])


KINDS = [domain, slits, touching, crossing, repeated, lattice]
SWITCHES = ["zpenv", "pen", "zpcenv", "zpAenv", "zpcAen", "zpj", "zpjAenv", "zpOAe", "zpB", "zpPe", "zpEN", "pjcen",
            "zpS0Yen"]


def numbers_of(a, b, scale):
    """For each number of a point of a the first one at its place; for each of b that of the point of a at its place,
    or, for points added, next to it."""
    firsts = {}
    for i, place in enumerate(map(tuple, a.tolist())):
        firsts.setdefault(place, i)
    numbers = []
    for place in map(tuple, b.tolist()):
        distances = numpy.abs(a - place).max(axis=1) if place not in firsts else None
        check(distances is None or distances.min() <= TOLERANCE * scale, "places of points")
        numbers.append(firsts[place] if distances is None else int(distances.argmin()))
    return numpy.array(numbers), numpy.array([firsts[place] for place in map(tuple, a.tolist())])


def markers_by_segment(out, rename):
    ends = rename(rows(out.segmentlist, out.numberofsegments, 2)).tolist()
    markers = rows(out.segmentmarkerlist, out.numberofsegments, 1).tolist()
    return {tuple(sorted(row)): markers[i] if markers else None for i, row in enumerate(ends)}


def attributes_by_triangle(out, names):
    attributes = rows(out.triangleattributelist, out.numberoftriangles, 1).tolist()
    return dict(zip(names, attributes)) if out.numberoftriangleattributes > 0 else {}


def compare_points(own, other, renamings, places, arguments):
    a, b = own[0], other[0]
    points, attributes, markers, _ = arguments
    triangles = renamings[0](rows(a.trianglelist, a.numberoftriangles, 3))
    used = set(triangles.ravel().tolist())
    at_place = {}
    for i, place in enumerate(map(tuple, points.tolist())):
        at_place.setdefault(place, []).append(i)
    for name, given in (("pointmarkerlist", markers[:, None]), ("pointattributelist", attributes)):
        lists = [rows(getattr(each, name), each.numberofpoints, given.shape[1]) for each in (a, b)]
        check(len(lists[0]) == len(lists[1]), name)
        values = [{} for _ in lists]
        for each, renaming, found in zip(lists, renamings, values):
            numbers = renaming(numpy.arange(len(each)) + renaming.first)
            for number, row in zip(numbers.tolist(), each.tolist()):
                found.setdefault(number, []).append(row)
        for number in used if len(lists[0]) else ():
            pair = [found[number] for found in values]
            there = at_place.get(tuple(places[0][number - renamings[0].first].tolist()), ())
            if len(there) > 1:
                choice = [given[i].tolist() for i in there]
                choice += [[1] for row in choice if row == [0] and name == "pointmarkerlist"]
                check(all(row in choice for rows_of in pair for row in rows_of), f"{name} of points at {there}")
            else:
                check(numpy.allclose(*pair, rtol=1e-7, atol=1e-7), f"{name} of point {number}: {pair}")


class Renaming:
    def __init__(self, numbers, first):
        self.numbers, self.first = numbers, first

    def __call__(self, points):
        return self.numbers[points.astype(int) - self.first] + self.first if len(points) else points


def compare_counts(own, other, skipped=()):
    for kind, a, b in zip(("out", "vorout"), own, other):
        for name in COUNTS:
            check(name in skipped or getattr(a, name) == getattr(b, name),
                  f"{kind}.{name}: {getattr(a, name)}, {getattr(b, name)}")
        for name in LISTS:
            check(bool(getattr(a, name)) == bool(getattr(b, name)), f"whether there is {kind}.{name}")


def compare(own, other, switches, scale, has_ties, arguments):
    first = 0 if "z" in switches else 1
    (a, dual), (b, other_dual) = own, other
    compare_counts(own, other)
    if not a.pointlist:
        return
    places = [rows(each.pointlist, each.numberofpoints, 2) for each in (a, b)]
    numbers, own_numbers = numbers_of(*places, scale)
    renamings = [Renaming(own_numbers, first), Renaming(numbers, first)]
    if "P" not in switches:
        segments = [markers_by_segment(each, rename) for each, rename in zip((a, b), renamings)]
        check(segments[0] == segments[1], "segments")
    if has_ties:
        compare_areas(own, other, places, first)
        return
    compare_points(own, other, renamings, places, arguments)
    names, exact, rounded = by_triangle(a, dual, first, renamings[0])
    other_names, other_exact, other_rounded = by_triangle(b, other_dual, first, renamings[1])
    check(exact == other_exact, "triangles")
    # Attributes there follow from those of the corners, of which there is a choice where points share a place.
    width = 2 if len(numpy.unique(arguments[0], axis=0)) < len(arguments[0]) else None
    for name, row in rounded.items():
        is_close = numpy.allclose(row[:width], other_rounded[name][:width], rtol=1e-5, atol=1e-5 * scale)
        check(is_close, "Voronoi vertices")
    edges = by_edge(a, dual, names, first, renamings[0])
    other_edges = by_edge(b, other_dual, other_names, first, renamings[1])
    check(edges.keys() == other_edges.keys(), "edges")
    for ends, (marker, sides, norm) in edges.items():
        check((marker, sides) == other_edges[ends][:2], "edges")
        check(norm is None or numpy.allclose(norm, other_edges[ends][2], atol=TOLERANCE * scale), "rays")
    check(attributes_by_triangle(a, names) == attributes_by_triangle(b, other_names), "attributes of triangles")


def compare_areas(own, other, places, first):
    """With ties: the area of each region, and edges that are locally Delaunay."""
    sums = []
    for (out, _), points in zip((own, other), places):
        corners = points[rows(out.trianglelist, out.numberoftriangles, 3).astype(int) - first]
        (x, y), (other_x, other_y) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        areas = x * other_y - y * other_x
        check((areas > 0).all() or not len(areas), "orientation")
        attributes = rows(out.triangleattributelist, out.numberoftriangles, 1)
        check(len(attributes) in (0, len(areas)), "attributes")
        keys = attributes[:, 0] if len(attributes) else numpy.zeros(len(areas))
        sums.append({key: areas[keys == key].sum() for key in numpy.unique(keys)})
    check(sums[0].keys() == sums[1].keys(), "regions")
    check(all(numpy.isclose(area, sums[1][key]) for key, area in sums[0].items()), "areas of regions")
    check_delaunay(own[0], places[0], first)


def check_delaunay(out, points, first, opaque=None):
    """No corner opposite an edge that is not opaque, as segments are, is inside the circle at the other side."""
    segments = opaque
    if opaque is None:
        ends = rows(out.segmentlist, out.numberofsegments, 2).astype(int)
        segments = {tuple(sorted(row)) for row in ends.tolist()}
    corners = rows(out.trianglelist, out.numberoftriangles, 3).astype(int)
    opposite = {}
    for row in corners.tolist():
        for k in range(3):
            opposite.setdefault(tuple(sorted((row[k], row[k - 1]))), []).append((row, row[k - 2]))
    for ends, sides in opposite.items():
        check(len(sides) <= 2, "an edge of three triangles")
        if len(sides) == 1 or ends in segments:
            check(ends in segments, "an edge of one triangle that is no segment")
            continue
        (row, _), (_, corner) = sides
        relative = points[numpy.array(row) - first] - points[corner - first]
        matrix = numpy.concatenate([relative, (relative**2).sum(axis=1)[:, None]], 1)
        scale = numpy.abs(matrix).max(axis=0).prod()
        check(numpy.linalg.det(matrix) <= 1e-9 * scale, "locally Delaunay")


def does_end(function, arguments):
    """Whether it does within SECONDS and without an error, in a process of its own."""
    child = os.fork()
    if child == 0:
        signal.alarm(SECONDS)
        os.close(1)  # Triangle tells of its errors there
        try:
            call(function, *arguments)
        except AssertionError:
            os._exit(1)
        os._exit(0)
    return os.waitpid(child, 0)[1] == 0


# With rounding these may be different, see triangle_rounding.py.
ROUNDED = ("numberofpoints", "numberoftriangles", "numberofsegments", "numberofedges")


def compare_graph(functions, switches, arguments, kind, tally):
    """Adds to the tally what has been compared."""
    points, attributes, markers, lists = arguments
    if not does_end(functions[1], ("Q" + switches, *arguments)):
        call(functions[0], "Q" + switches, *arguments)
        tally["Triangle fails"] += 1
        return
    first, scale = int("z" not in switches), float(numpy.abs(points).max())
    outs = [call(function, "Q" + switches, *arguments) for function in functions]
    full = "Q" + "".join(each for each in switches if each not in "nevPNEB")
    full_outs = [call(function, full, *arguments)[0] for function in functions]
    places, found = look(full_outs, points, scale, first)
    if any(output.is_rounded for output in found):
        compare_counts(*outs, ROUNDED)
        compare_rounded(found, places, markers, lists, first)
        if not have_same_areas(full_outs, scale, first):
            pieces = rows(full_outs[0].segmentlist, full_outs[0].numberofsegments, 2)
            graph = {**lists, "segmentlist": pieces, "segmentmarkerlist": numpy.zeros(len(pieces), dtype=numpy.intc)}
            cut = rows(full_outs[0].pointlist, full_outs[0].numberofpoints, 2)
            none, unmarked = numpy.zeros((len(cut), 0)), numpy.zeros(len(cut), dtype=numpy.intc)
            again = call(functions[1], full, cut, none, unmarked, graph)[0]
            check(found[1].leads_past and have_same_areas((full_outs[0], again), scale, first), "areas of regions")
            tally["a region leaks in Triangle"] += 1
        tally["rounding decides"] += 1
    else:
        compare(*outs, switches, scale, kind is lattice, arguments)
        tally[kind.__name__] += 1


def main(library, first=0, count=300):
    functions = ctypes.CDLL(library).triangulate, ctypes.CDLL(triangle.core.__file__).triangulate
    tally, failures = collections.Counter(), 0
    for seed in range(int(first), int(first) + int(count)):
        random = numpy.random.default_rng(seed)
        kind = KINDS[seed % len(KINDS)]
        switches = SWITCHES[int(random.integers(len(SWITCHES)))]
        if kind is lattice:
            switches = switches.replace("v", "").replace("P", "").replace("EN", "")
        graph = Graph(random)
        kind(graph)
        try:
            compare_graph(functions, switches, graph.finish(switches), kind, tally)
        except Different as difference:
            failures += 1
            print(f"{kind.__name__} {seed}, {switches}: not the same: {difference}", file=sys.stderr)
    if failures:
        sys.exit(f"{failures} of {count} graphs differ")
    print(f"{count} graphs, no difference ({', '.join(f'{kind}: {n}' for kind, n in sorted(tally.items()))})")


if __name__ == "__main__":
    main(*sys.argv[1:])
