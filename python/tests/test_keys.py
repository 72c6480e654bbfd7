"""Keys: simplices are those of a triangulation without keys of the vertices in the order of key, position and id."""

import numpy as np
import pytest

import deldrift

ALGORITHMS = ["auto", "rebuilding", "placement_flips", "tolerance", "repair"]


def by_rank(points, keys):
    """The ids of the rows in the order that counts, without those of removed vertices."""
    ids = np.flatnonzero(~np.isnan(points).any(axis=1))
    columns = [ids, *points[ids].T[::-1], keys[ids]]
    return ids[np.lexsort(columns)]


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def check(tri):
    """Compares with a fresh triangulation without keys."""
    order = by_rank(tri.points, tri.keys)
    fresh = deldrift.Delaunay(tri.points[order])
    assert as_sets(tri.simplices) == as_sets(order[fresh.simplices])
    assert [tri.representative(v) for v in order] == [order[fresh.representative(k)] for k in range(len(order))]
    tri.validate()


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_keys_rank_vertices(rng, ndim, algorithm):
    points = rng.integers(0, 5, (80, ndim)).astype(float)
    keys = rng.integers(0, 4, 80)
    tri = deldrift.Delaunay(points, algorithm=algorithm, keys=keys)
    np.testing.assert_array_equal(tri.keys, keys)
    check(tri)
    for _ in range(4):
        points = points + rng.integers(0, 2, points.shape)
        tri.move(points)
        check(tri)
    with tri.step() as step:
        step.remove([3, 9])
        assert step.insert(points[:2], keys=[1, 2]).tolist() == [80, 81]
    check(tri)
    with tri.step() as step:
        assert step.insert(points[2:5], keys=[2**64 - 1, 0, 3], reuse_ids=True).tolist() == [3, 9, 82]
    check(tri)
    assert tri.keys[[3, 9, 82]].tolist() == [2**64 - 1, 0, 3]
    assert tri.insert(points[7], 2) == 83
    assert tri.insert(points[8] + 0.5) == 84
    assert tri.keys[[83, 84]].tolist() == [2, 84]
    check(tri)
    for other in tri.copy(), deldrift.frombytes(tri.tobytes()):
        np.testing.assert_array_equal(other.keys, tri.keys)
        check(other)


def test_ids_are_keys_by_default(rng, ndim):
    tri = deldrift.Delaunay(rng.random((20, ndim)))
    tri.remove(4)
    expected = np.arange(20)
    expected[4] = 0
    np.testing.assert_array_equal(tri.keys, expected)
    with tri.step() as step:
        assert step.insert(rng.random((1, ndim)), reuse_ids=True).tolist() == [4]
    assert tri.npoints == 20 and tri.keys[4] == 4


def test_any_order_of_points_gives_the_same_simplices(rng, ndim):
    points = rng.integers(0, 4, (60, ndim)).astype(float)
    keys = rng.permutation(60)
    order = rng.permutation(60)
    first, second = deldrift.Delaunay(points, keys=keys), deldrift.Delaunay(points[order], keys=keys[order])
    assert as_sets(keys[first.simplices]) == as_sets(keys[order][second.simplices])


@pytest.mark.parametrize(
    ("keys", "error"),
    [
        ([1, 2], deldrift.WrongCount),
        ([1, 2, -1], deldrift.InvalidValue),
        ([1, 2, 2**64], deldrift.InvalidValue),
        ([1, 2, 0.5], TypeError),
        ([[1, 2, 3]], deldrift.InvalidShape),
        (np.ma.masked_all(3, int), deldrift.InvalidShape),
    ],
)
def test_keys_that_are_wrong_are_refused(keys, error):
    points = [[0, 0], [1, 0], [0, 1]]
    with pytest.raises(error, match="keys"):
        deldrift.Delaunay(points, keys=keys)
    tri = deldrift.Delaunay(points)
    with pytest.raises(error, match="keys"):
        with tri.step() as step:
            step.insert(points, keys=keys)
    assert tri.npoints == 3 and tri.timestamp == 0


def test_a_key_that_is_wrong_is_refused():
    tri = deldrift.Delaunay([[0, 0], [1, 0], [0, 1]])
    for key, error in (-1, deldrift.InvalidValue), (2**64, deldrift.InvalidValue), (0.5, TypeError):
        with pytest.raises(error, match="key is"):
            tri.insert([0.5, 0.5], key)
    assert tri.npoints == 3
