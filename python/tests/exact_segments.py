"""Constrained Delaunay triangulations and conflicts by their definitions, in rational numbers: an oracle for small sets."""

import itertools
from fractions import Fraction

import deldrift


def fractions_of(points):
    return [tuple(map(Fraction, row)) for row in points.tolist()]


def cross(a, b, c):
    """Twice the area of a triangle."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_circle(a, b, c, d):
    """Positive if d is in the circle of a counter-clockwise triangle."""
    rows = []
    for p in (a, b, c):
        x, y = p[0] - d[0], p[1] - d[1]
        rows.append((x, y, x * x + y * y))
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = rows
    return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)


def is_between(a, b, p):
    """Whether p is on the segment from a to b, and no end of it."""
    along = (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1])
    return cross(a, b, p) == 0 and along < 0


def do_cross(a, b, c, d):
    """Whether two segments have a point in common that is inside both."""
    return cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0


def conflicts_of(places, segments):
    """All conflicts of segments, a dictionary of ends by id; places are by id, None for removed vertices."""
    kind = deldrift.ConflictKind
    found, whole = [], {}
    for id, ends in segments.items():
        removed = [v for v in ends if places[v] is None]
        if removed:
            found += [(kind.END_REMOVED, id, v) for v in dict.fromkeys(removed)]
        elif places[ends[0]] == places[ends[1]]:
            found.append((kind.ENDS_MEET, id, -1))
        else:
            whole[id] = [places[v] for v in ends]
    lowest = {}
    for v, p in enumerate(places):
        if p is not None:
            lowest.setdefault(p, v)
    for id, (a, b) in whole.items():
        found += [(kind.ON_SEGMENT, id, v) for p, v in lowest.items() if is_between(a, b, p)]
    for (i, one), (j, other) in itertools.combinations(sorted(whole.items()), 2):
        if do_cross(*one, *other):
            found.append((kind.CROSSING, i, j))
    return sorted(found)


def entry_and_exit(origin, direction, corners):
    """Where a ray enters and leaves a counter-clockwise triangle; None if it misses the inside."""
    enter, leave = Fraction(0), None
    for k in range(3):
        a, b = corners[k], corners[(k + 1) % 3]
        here = cross(a, b, origin)
        change = (b[0] - a[0]) * direction[1] - (b[1] - a[1]) * direction[0]
        if change == 0:
            if here <= 0:
                return None
        elif change > 0:
            enter = max(enter, -here / change)
        else:
            leave = -here / change if leave is None else min(leave, -here / change)
    return None if leave is None or leave <= enter else (enter, leave)


def hit(origin, direction, a, b):
    """How far along a ray it meets a segment that it is not parallel to, None if it does not."""
    spanned = (b[0] - a[0]) * direction[1] - (b[1] - a[1]) * direction[0]
    if spanned == 0:
        return None
    t = -cross(a, b, origin) / spanned
    at = (origin[0] + t * direction[0], origin[1] + t * direction[1])
    axis = 0 if a[0] != b[0] else 1
    low, high = sorted((a[axis], b[axis]))
    return t if t > 0 and low <= at[axis] <= high else None


def is_visible(v, corners, ends):
    """Whether some place inside a triangle is seen from v, which is not in it, where segments are opaque.

    What is seen changes at directions of corners and ends alone, so one direction between each two of them is tried.
    """
    ways = [(p[0] - v[0], p[1] - v[1]) for p in corners]
    turn = lambda one, other: one[0] * other[1] - one[1] * other[0]
    right = next(one for one in ways if all(turn(one, other) >= 0 for other in ways))
    left = next(one for one in ways if all(turn(one, other) <= 0 for other in ways))
    parts = {Fraction(0), Fraction(1)}
    for p in [*corners, *itertools.chain.from_iterable(ends)]:
        way = (p[0] - v[0], p[1] - v[1])
        to_right, to_left = turn(way, left), turn(right, way)
        if to_right > 0 and to_left > 0:
            parts.add(to_left / (to_right + to_left))
    parts = sorted(parts)
    for low, high in zip(parts, parts[1:]):
        part = (low + high) / 2
        direction = tuple((1 - part) * right[k] + part * left[k] for k in range(2))
        span = entry_and_exit(v, direction, corners)
        hits = [hit(v, direction, a, b) for a, b in ends]
        if not any(t is not None and t <= span[0] for t in hits):
            return True
    return False


def triangles_of(places, segments):
    """All triangles that the definition admits: rows of sorted ids. Among cocircular vertices it admits several."""
    ends = [(places[i], places[j]) for i, j in segments]
    found = set()
    for triple in itertools.combinations(range(len(places)), 3):
        corners = [places[v] for v in triple]
        turn = cross(*corners)
        if turn == 0:
            continue
        if turn < 0:
            corners.reverse()
        sides = [(corners[k], corners[(k + 1) % 3]) for k in range(3)]
        others = [p for v, p in enumerate(places) if v not in triple]
        if any(all(cross(a, b, p) >= 0 for a, b in sides) for p in others):
            continue
        if any(do_cross(a, b, c, d) for a, b in sides for c, d in ends):
            continue
        if any(in_circle(*corners, p) > 0 and is_visible(p, corners, ends) for p in others):
            continue
        found.add(triple)
    return found
