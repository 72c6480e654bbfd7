"""Outputs of planar straight-line graphs in which rounding decides what follows from a crossing.

Where several segments cross at one place, or a crossing is beside a point or another segment, a library may have one
point or several there, and pieces that lead through a point or past it. Equal then are the places at which points
are, the pieces between places, the markers of both, and the areas of regions. A place is what is nearer than
TOLERANCE of the extent. Own markers are those that the input determines: the point's own, else that of the first
segment there that has one, else 1 on the boundary.
"""

import collections

import numpy

TOLERANCE = 1e-9


class Different(Exception):
    """What is not the same."""


def check(condition, what):
    if not condition:
        raise Different(what)


def rows(pointer, count, width):
    return numpy.ctypeslib.as_array(pointer, (count, width)) if pointer and count > 0 else numpy.zeros((0, width))


class Places:
    """Those of the points of several lists, which have the number of the first point there."""

    def __init__(self, lists, scale):
        self.limit = TOLERANCE * scale
        self.points = numpy.concatenate(lists)
        distances = numpy.abs(self.points[:, None] - self.points[None]).max(axis=2)
        numbers = (distances <= self.limit).argmax(axis=1)
        self.of_lists = numpy.split(numbers[numbers], numpy.cumsum([len(each) for each in lists])[:-1])

    def chain(self, start, end, candidates):
        """The candidates on a segment, ends included, from start to end."""
        along = self.points[end] - self.points[start]
        length = numpy.hypot(*along)
        relative = self.points[candidates] - self.points[start]
        distance = relative @ along / length
        across = numpy.abs(relative @ (along[1], -along[0])) / length
        is_on = (across <= self.limit) & (distance >= -self.limit) & (distance <= length + self.limit)
        order = numpy.argsort(distance[is_on])
        between = [each for each in candidates[is_on][order].tolist() if each not in (start, end)]
        return [start, *between, end]

    def pieces(self, start, end, candidates):
        if start == end:
            return []
        chain = self.chain(start, end, candidates)
        return [tuple(sorted(pair)) for pair in zip(chain, chain[1:])]


class Output:
    """Of one library, by places: those of the candidates, which are the points of both."""

    def __init__(self, out, places, numbers, candidates, first):
        self.leads_past = False
        corners = rows(out.trianglelist, out.numberoftriangles, 3).astype(int) - first
        self.is_doubled = len(numpy.unique(corners)) > len(numpy.unique(numbers[corners]))
        sides = self.count_sides(numbers[corners].tolist())
        self.used = {number for side in sides for number in side}
        self.boundary = {side for side, count in sides.items() if count == 1}
        self.pieces, self.markers = {}, {}
        ends = numbers[rows(out.segmentlist, out.numberofsegments, 2).astype(int) - first].tolist()
        markers = rows(out.segmentmarkerlist, out.numberofsegments, 1).ravel().tolist() or [None] * len(ends)
        for (start, end), marker in zip(ends, markers):
            if (min(start, end), max(start, end)) not in sides:
                continue
            pieces = places.pieces(start, end, candidates)
            self.leads_past |= len(pieces) != 1
            for piece in pieces:
                self.pieces.setdefault(piece, set()).add(marker)
                self.used.update(piece)
        of_points = rows(out.pointmarkerlist, out.numberofpoints, 1).ravel().tolist()
        for number, marker in zip(numbers.tolist(), of_points):
            self.markers.setdefault(number, set()).add(marker)

    @property
    def is_rounded(self):
        """Whether two corners share a place, or a piece leads past a point."""
        return self.is_doubled or self.leads_past

    @staticmethod
    def count_sides(corners):
        sides = collections.Counter()
        for row in corners:
            if len(set(row)) == 3:
                sides.update(tuple(sorted((row[k], row[k - 1]))) for k in range(3))
        return sides


class Input:
    """What the input says of markers, by places."""

    def __init__(self, places, numbers, markers, lists, first, candidates):
        ends = lists["segmentlist"].astype(int) - first
        of_segments = lists.get("segmentmarkerlist", numpy.zeros(len(ends), dtype=int)).tolist()
        self.of_pieces, self.of_points = {}, {}
        self.repeated = {}  # of further points at a place
        for number, marker in zip(numbers.tolist(), markers.tolist()):
            there = self.repeated if number in self.of_points else self.of_points
            there.setdefault(number, []).append(marker)
        for (start, end), marker in zip(numbers[ends].tolist(), of_segments):
            for piece in places.pieces(start, end, candidates):
                self.of_pieces.setdefault(piece, []).append(marker)
                for number in piece:
                    self.of_points.setdefault(number, []).append(marker)

    @staticmethod
    def first_of(markers):
        return next((marker for marker in markers if marker != 0), 0)


def look(outs, points, scale, first):
    """Both outputs by places."""
    lists = [rows(out.pointlist, out.numberofpoints, 2) for out in outs]
    places = Places([points, *lists], scale)
    candidates = numpy.unique(numpy.concatenate(places.of_lists[1:]))
    return places, [Output(out, places, numbers, candidates, first) for out, numbers in zip(outs, places.of_lists[1:])]


def compare_rounded(found, places, markers, lists, first):
    own, other = found
    check(own.used == other.used, "places")
    check(own.pieces.keys() == other.pieces.keys(), "pieces between places")
    given = Input(places, places.of_lists[0], markers, lists, first, numpy.unique(numpy.concatenate(places.of_lists)))
    for pair, own_markers in own.pieces.items():
        if None in own_markers:
            continue
        expected = given.first_of(given.of_pieces.get(pair, ())) or int(pair in own.boundary)
        check(own_markers in ({expected}, {expected or 1}), f"marker of piece {pair}: {own_markers}, not {expected}")
        possible = {0, 1, *given.of_pieces.get(pair, ())}
        check(other.pieces[pair] <= possible, f"markers of piece {pair} in Triangle: {other.pieces[pair]}")
    for number in own.used & own.markers.keys():
        expected = given.first_of(given.of_points.get(number, ()))
        check(own.markers[number] & ({expected} if expected else {0, 1}), f"marker of place {number}")
        possible = {0, 1, *given.of_points.get(number, ()), *given.repeated.get(number, ())}
        check(other.markers[number] <= possible, f"markers of place {number} in Triangle")


def have_same_areas(outs, scale, first):
    """Whether there is the same area of each attribute."""
    sums = [areas(out, first) for out in outs]
    limit = 8 * TOLERANCE * scale**2
    return sums[0].keys() == sums[1].keys() and all(abs(area - sums[1][key]) <= limit for key, area in sums[0].items())


def areas(out, first):
    """Twice that of the triangles of each attribute."""
    numbers = rows(out.trianglelist, out.numberoftriangles, 3).astype(int) - first
    corners = rows(out.pointlist, out.numberofpoints, 2)[numbers]
    (x, y), (other_x, other_y) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    each = x * other_y - y * other_x
    attributes = rows(out.triangleattributelist, out.numberoftriangles, 1)
    keys = attributes[:, 0] if len(attributes) else numpy.zeros(len(each))
    return {key: each[keys == key].sum() for key in numpy.unique(keys)}
