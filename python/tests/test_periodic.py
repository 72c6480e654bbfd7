"""Periodic triangulations, beside scipy's of copies."""

import copy
import itertools
import pickle

import deldrift
import numpy as np
import pytest
from scipy.spatial import Delaunay as OfScipy

BOXES = {
    "square": np.eye(2),
    "skewed": np.array([[1.0, 0.0], [5.25, 0.75]]),
    "cube": np.eye(3),
    "triclinic": np.array([[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]]),
    "flat": np.diag([1.0, 3.0, 0.7]),
}


def reduced(vectors):
    """The copies of a skewed box are near each other only in a reduced basis."""
    rows = vectors.copy()
    for k in range(1, len(rows)):
        rows[k] -= np.round(rows[k] @ rows[0] / (rows[0] @ rows[0])) * rows[0]
    return rows


def classes(simplices, shifts, vectors):
    """The cells as sets of corners, relative to that of the lowest id, and of several of this the first by coordinates."""
    found = set()
    for row, shift in zip(simplices.tolist(), np.asarray(shifts)):
        places = (shift @ vectors).tolist()
        first = shift[min(range(len(row)), key=lambda i: (row[i], places[i]))]
        found.add(frozenset((v, *(s - first)) for v, s in zip(row, shift.tolist())))
    return found


def of_copies(points, vectors):
    """What scipy finds around the middle one of copies."""
    basis = reduced(vectors)
    multiples = np.round(np.linalg.solve(vectors.T, basis.T)).astype(int).T
    homes = np.floor(points @ np.linalg.inv(basis)).astype(int)
    counts = list(itertools.product(range(-2, 3), repeat=len(basis)))
    places = np.concatenate([points + (np.array(c) - homes) @ basis for c in counts])
    shifts = np.concatenate([(np.array(c) - homes) @ multiples for c in counts])
    middle = np.concatenate([np.full(len(points), not any(c)) for c in counts])
    simplices = OfScipy(places).simplices
    simplices = simplices[middle[simplices].any(axis=1)]
    return classes(simplices % len(points), shifts[simplices], vectors)


@pytest.mark.parametrize("name", BOXES)
def test_points_are_taken_into_the_box(name):
    vectors, rng = BOXES[name], np.random.default_rng(3)
    tri = deldrift.PeriodicDelaunay(np.empty((0, len(vectors))), vectors)
    shortest, multiples = tri.reduced_vectors()
    assert (shortest == multiples @ tri.vectors).all() and abs(round(np.linalg.det(multiples))) == 1
    points = rng.normal(scale=9, size=(50, len(vectors)))
    places, shifts = tri.wrap(points)
    assert np.abs(places + shifts @ vectors - points).max() < 1e-12
    inside = places @ np.linalg.inv(shortest)
    assert inside.min() > -1e-9 and inside.max() < 1 + 1e-9
    # Near a side vertices stay where they have been.
    moved, shifts = tri.wrap(places + 0.1 * shortest[0], previous=places)
    assert not shifts.any() and np.abs(moved - places - 0.1 * shortest[0]).max() < 1e-12
    with pytest.raises(deldrift.WrongCount, match="1 rows of previous for 50 points"):
        tri.wrap(points, previous=points[:1])


@pytest.mark.parametrize("name", BOXES)
def test_cells_are_those_of_copies_when_points_move(name):
    vectors, rng, n = BOXES[name], np.random.default_rng(7), 25
    points = rng.random((n, len(vectors))) @ vectors + rng.integers(-3, 4, (n, len(vectors))) @ vectors
    tri = deldrift.PeriodicDelaunay(points, vectors)
    for step in range(4):
        assert np.abs(tri.points - points).max() < 1e-12
        assert classes(tri.simplices, tri.shifts, vectors) == of_copies(points, vectors)
        assert tri.voronoi_volumes().sum() == pytest.approx(abs(np.linalg.det(vectors)), rel=1e-12)
        edges = tri.corners[:, 1:] - tri.corners[:, :1]
        assert (np.linalg.det(edges) > 0).all()
        if step == 2:
            points = points @ np.linalg.solve(vectors, 1.125 * vectors)
            vectors = 1.125 * vectors
            tri.move(points, vectors=vectors)
        else:
            points = points + rng.normal(scale=0.05, size=points.shape)
            points -= np.floor(points @ np.linalg.inv(vectors)) @ vectors
            assert tri.move(points).moved == n
    assert tri.timestamp == 4


def test_neighbours_share_facets_across_the_box(rng):
    tri = deldrift.PeriodicDelaunay(rng.random((30, 2)), [1, 1])
    n = tri.ndim + 1
    for cell, corner in itertools.product(range(tri.nsimplex), range(n)):
        other = tri.neighbors[cell, corner]
        here = {(tri.simplices[cell, i], *tri.shifts[cell, i]) for i in range(n) if i != corner}
        moved = tri.shifts[other] + tri.neighbor_shifts[cell, corner]
        assert here < {(v, *s) for v, s in zip(tri.simplices[other], moved)}
    edges, shifts = tri.edges()
    assert len(edges) == tri.nvertices + tri.nsimplex == 90 and shifts.shape == (90, 2)


def test_one_point_and_a_slab():
    tri = deldrift.PeriodicDelaunay([[0.5, 0.5]], [1, 1])
    assert tri.nsimplex == 2 and tri.voronoi_volumes() == [1]
    slab = deldrift.PeriodicDelaunay([[0.5, 0.5], [0.25, 0.75], [0.0, 0.5]], [[1.0, 0.0]])
    assert slab.vectors.shape == (1, 2) and slab.shifts.shape[2] == 1 and (slab.neighbors == -1).any()
    assert np.isinf(slab.voronoi_volumes()).all()


def test_points_come_and_go():
    tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7]], [1, 1])
    assert tri.insert([[2.5, 0.25], [0.25, 0.5]]).tolist() == [2, 3]
    assert (tri.nvertices, tri.nsimplex) == (4, 8)
    tri.remove([0])
    assert (tri.nvertices, tri.nsimplex) == (3, 6) and np.isnan(tri.points[0]).all()
    assert tri.move([[0.5, 0.5]], ids=[3]).moved == 1
    assert "3 points in 2D" in repr(tri) and tri.nbytes > 0 and tri.report.timestamp == 3


def test_what_is_wrong_is_told_and_changes_nothing():
    tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7]], [1, 1])
    with pytest.raises(deldrift.InvalidValue, match=r"vectors\[1\] is not independent"):
        deldrift.PeriodicDelaunay([[0.1, 0.1]], [[1, 2], [2, 4]])
    with pytest.raises(deldrift.NotFinite, match=r"points\[1\], coordinate 0, is NaN"):
        tri.move([[0.1, 0.1], [np.nan, 0.7]])
    with pytest.raises(deldrift.WrongCount):
        tri.move([[0.1, 0.1]])
    with pytest.raises(deldrift.WrongCount, match="vector_count is 1, but must be 2"):
        tri.move(vectors=[[1, 0]])
    with pytest.raises(deldrift.NoSuchVertex, match=r"ids\[0\] is 7"):
        tri.move([[0.1, 0.1]], ids=[7])
    assert tri.timestamp == 0 and tri.move([[0.2, 0.1], [0.6, 0.7]]).timestamp == 1


@pytest.mark.parametrize("make", [copy.copy, copy.deepcopy, pickle.dumps])
def test_a_copy_is_refused_and_harms_nothing(make, rng):
    tri = deldrift.PeriodicDelaunay(rng.random((20, 2)), [1, 1])
    with pytest.raises(TypeError, match="neither copied nor pickled"):
        make(tri)
    assert tri.move(rng.random((20, 2))).timestamp == 1
    assert tri.voronoi_volumes().sum() == pytest.approx(1, rel=1e-12)
