"""Segments: against the definition, against Triangle, and against triangulations from nothing."""

import copy
import itertools
import pickle
from fractions import Fraction

import numpy as np
import pytest

import deldrift
import exact_segments as exact


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def draw_segments(rng, points, number):
    """Segments without a conflict, chosen by exact tests of all pairs."""
    places, chosen = exact.fractions_of(points), []
    for _ in range(number):
        ends = tuple(map(int, rng.choice(len(points), 2, replace=False)))
        if not exact.conflicts_of(places, dict(enumerate([*chosen, ends]))):
            chosen.append(ends)
    return np.array(chosen, np.int32).reshape(-1, 2)


def scene(rng, count=60, number=25):
    points = rng.random((count, 2))
    return points, draw_segments(rng, points, number)


def state(tri):
    return tri.tobytes(), tri.statistics.as_dict(), tri.timestamp, tri.npoints


def grid_of(rng, count):
    """Points of a small grid, no two at one place: many on lines and circles."""
    spots = rng.choice(25, count, replace=False)
    return np.stack([spots % 5, spots // 5], axis=1).astype(float)


@pytest.mark.parametrize("seed", range(25))
def test_the_definition_in_general_position(seed):
    rng = np.random.default_rng(seed)
    points, segments = scene(rng, int(rng.integers(3, 11)), 12)
    tri = deldrift.Delaunay(points, segments=segments)
    assert as_sets(tri.simplices) == exact.triangles_of(exact.fractions_of(points), segments)


@pytest.mark.parametrize("seed", range(25))
def test_the_definition_on_a_grid(seed):
    """Of triangles that ties admit there are so many that they cover the hull; each segment is an edge."""
    rng = np.random.default_rng(seed)
    points = grid_of(rng, int(rng.integers(4, 11)))
    segments = draw_segments(rng, points, 12)
    tri = deldrift.Delaunay(points, segments=segments)
    places = exact.fractions_of(points)
    assert as_sets(tri.simplices) <= exact.triangles_of(places, segments)
    hull = [places[v] for v in deldrift.Delaunay(points).boundary_chains().vertices]
    area = sum(exact.cross(hull[0], hull[k], hull[k + 1]) for k in range(1, len(hull) - 1)) if hull else 0
    areas = [exact.cross(*(places[v] for v in row)) for row in tri.simplices.tolist()]
    assert all(part > 0 for part in areas) and sum(areas) == area
    if len(areas):
        assert as_sets(segments) <= as_sets(tri.edges())


def test_the_definition_tells_other_triangles():
    """The oracle itself: a square with a segment along the longer way, and without."""
    places = exact.fractions_of(np.array([[0.0, 0], [4, 0], [4, 3.5], [0.5, 3]]))
    plain, forced = exact.triangles_of(places, []), exact.triangles_of(places, [(0, 2)])
    assert plain != forced and forced == {(0, 1, 2), (0, 2, 3)} and len(plain) == 2


def arrays_of(tri):
    return [tri.simplices, tri.neighbors, tri.points, *tri.segments, list(tri.statistics.as_dict().values())]


@pytest.mark.parametrize("seed", range(60))
def test_all_conflicts_are_told(seed):
    """Of segments and of moves, in general position and on a grid with two vertices at one place."""
    rng = np.random.default_rng(seed)
    points = rng.random((12, 2)) if seed % 2 else grid_of(rng, 12)
    points = np.concatenate([points, points[:2]])
    ends = rng.choice(len(points), (int(rng.integers(1, 8)), 2))
    expected = exact.conflicts_of(exact.fractions_of(points), dict(enumerate(map(tuple, ends.tolist()))))
    tri = deldrift.Delaunay(points)
    before = [array.copy() for array in map(np.asarray, arrays_of(tri))]
    try:
        tri.add_segments(ends)
        found = np.empty(0, object)
    except deldrift.ConflictError as error:
        found = error.conflicts
        assert error.kind == found["kind"][0]
        again = pickle.loads(pickle.dumps(error))
        assert str(again) == str(error) and again.kind is error.kind and (again.conflicts == found).all()
    assert [tuple(row) for row in found.tolist()] == expected
    if expected:
        for was, is_now in zip(before, arrays_of(tri)):
            np.testing.assert_array_equal(was, is_now)
    else:
        np.testing.assert_array_equal(tri.segments.ends, ends)


@pytest.mark.parametrize("seed", range(40))
def test_moves_that_conflict_are_told_and_refused(seed):
    """A step of everything at once: moves, insertions, removals, segments that come and go."""
    rng = np.random.default_rng(seed)
    points, segments = scene(rng, 14, 10)
    tri = deldrift.Delaunay(points, segments=segments, algorithm=str(rng.choice(["auto", "repair", "rebuilding"])))
    n_refused = 0
    for _ in range(8):
        before, places = state(tri), exact.fractions_of(np.nan_to_num(tri.points))
        here = [v for v in range(tri.npoints) if tri.is_present(v)]
        places = [p if tri.is_present(v) else None for v, p in enumerate(places)]
        in_force = dict(zip(tri.segments.ids.tolist(), map(tuple, tri.segments.ends.tolist())))
        step = tri.step()
        try:
            with step:
                moved = rng.choice(here, int(rng.integers(0, len(here))), replace=False)
                goals = tri.points[moved] + 0.1 * rng.standard_normal((len(moved), 2))
                step.move(goals, moved)
                for v, p in zip(moved, exact.fractions_of(goals)):
                    places[v] = p
                new = rng.random((int(rng.integers(0, 2)), 2))
                inserted = step.insert(new).tolist()
                here += inserted
                places += exact.fractions_of(new)
                if rng.random() < 0.3:
                    gone = int(rng.choice([v for v in here if v not in moved and v not in inserted]))
                    step.remove([gone])
                    places[gone] = None
                if in_force and rng.random() < 0.5:
                    left = int(rng.choice(list(in_force)))
                    step.remove_segments([left])
                    del in_force[left]
                if rng.random() < 0.5:
                    # An end whose removal is staged is legal to give, and a conflict.
                    ends = rng.choice(here, (1, 2), replace=False)
                    in_force[step.add_segments(ends)[0]] = tuple(ends[0])
                expected = exact.conflicts_of(places, in_force)
                assert [tuple(row) for row in step.check().tolist()] == expected
        except deldrift.ConflictError as error:
            assert [tuple(row) for row in error.conflicts.tolist()] == expected != []
            assert state(tri) == before
            n_refused += 1
        else:
            assert expected == []
            assert dict(zip(tri.segments.ids, map(tuple, tri.segments.ends.tolist()))) == in_force
        tri.validate()
        check_fresh(tri)
    assert n_refused < 8


def check_fresh(tri):
    """The triangles are those of a triangulation from nothing."""
    fresh = deldrift.Delaunay(np.nan_to_num(tri.points, nan=1e9))
    with fresh.step() as step:
        step.remove(np.flatnonzero(np.isnan(tri.points[:, 0])))
        step.add_segments(tri.segments.ends, tri.segments.markers)
    assert as_sets(tri.simplices) == as_sets(fresh.simplices)
