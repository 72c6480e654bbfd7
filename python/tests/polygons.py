"""Polygons with holes and islands for tests, and which of them have a point inside, in rational numbers."""

from fractions import Fraction

import numpy as np

from exact_segments import cross, fractions_of


def ring(rng, centre, radius, count):
    """A polygon around a place, star-shaped and uneven, counter-clockwise."""
    angles = 2 * np.pi * (np.arange(count) + 0.3 * rng.random(count)) / count + rng.random()
    radii = radius * rng.uniform(0.7, 1, count)
    return centre + radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def nested(rng):
    """A domain with two holes, an island in one of them, a hole in that, and a second domain beside."""
    return [
        ring(rng, [0, 0], 4, 24),
        ring(rng, [-1.2, 0], 1.1, 11),
        ring(rng, [1.2, 0.2], 0.9, 9),
        ring(rng, [-1.2, 0], 0.6, 7),
        ring(rng, [-1.2, 0], 0.3, 5),
        ring(rng, [9, 1], 1.5, 8),
    ]


def joined(rings):
    """Vertices, segments around each ring, and the number of the ring as their markers."""
    starts = np.cumsum([0] + [len(one) for one in rings])
    segments = [
        (start + k, start + (k + 1) % len(one)) for start, one in zip(starts, rings) for k in range(len(one))
    ]
    markers = np.repeat(np.arange(1, len(rings) + 1), [len(one) for one in rings])
    return np.concatenate(rings), np.array(segments, np.int32), markers.astype(np.int32)


def sprinkled(rng, rings, count=40):
    """Points in the box of some rings."""
    vertices = np.concatenate(rings)
    return rng.uniform(vertices.min(axis=0) - 1, vertices.max(axis=0) + 1, (count, 2))


def is_inside(corners, p):
    """Whether a point is in a polygon, on no side of which it is, by the parity of sides to its right."""
    count = 0
    for k, a in enumerate(corners):
        b = corners[(k + 1) % len(corners)]
        if (a[1] > p[1]) != (b[1] > p[1]):
            low, high = (a, b) if a[1] < b[1] else (b, a)
            count += cross(low, high, p) > 0
    return count % 2 == 1


def around(rings, points, simplices):
    """For each simplex which rings are around it: rows of true and false."""
    corners, places = [fractions_of(one) for one in rings], fractions_of(points)
    rows = []
    for triangle in simplices.tolist():
        centre = tuple(sum((places[v][k] for v in triangle), Fraction(0)) / 3 for k in range(2))
        rows.append([is_inside(one, centre) for one in corners])
    return np.array(rows, bool).reshape(-1, len(rings))
