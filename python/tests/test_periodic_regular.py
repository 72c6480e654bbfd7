"""Points with weights that repeat, beside copies of them."""

import pickle

import deldrift
import numpy as np
import pytest

BOX = np.array([[1.0, 0.0], [0.25, 1.0]])


def made(seed, n=60, spread=1.0):
    rng = np.random.default_rng(seed)
    points = np.round(rng.random((n, 2)) * 2**20) / 2**20 @ BOX
    return points, spread / n * rng.random(n)


def copies(points, weights, reach=3):
    """A triangulation of the points and their copies: of ours, in order, who is hidden by weight, and the areas."""
    shifts = [(a, b) for a in range(-reach, reach + 1) for b in range(-reach, reach + 1)]
    shifts.sort(key=lambda shift: shift != (0, 0))
    everything = np.concatenate([points + np.array(shift) @ BOX for shift in shifts])
    keys = np.tile(np.arange(len(points)), len(shifts))
    tri = deldrift.Regular(everything, np.tile(weights, len(shifts)), keys=keys)
    hidden = tri.hidden_by_weight.vertices
    return hidden[hidden < len(points)], tri.voronoi_volumes()[: len(points)]


def beside_copies(tri, points, weights):
    hidden, areas = copies(points, weights)
    assert tri.hidden_by_weight.vertices.tolist() == hidden.tolist()
    assert np.allclose(tri.voronoi_volumes(), areas, atol=1e-12)
    assert np.array_equal(tri.weights, weights)
    assert tri.report is None or tri.report.hidden_by_weight == len(hidden)


@pytest.mark.parametrize("seed, spread", [(0, 0.1), (1, 1.0), (2, 4.0), (3, 100.0)])
def test_moves_and_weights_are_those_of_copies(seed, spread):
    points, weights = made(seed, spread=spread)
    tri = deldrift.PeriodicRegular(points, BOX, weights)
    beside_copies(tri, points, weights)
    others, lighter = made(seed + 10, spread=spread)
    tri.move(weights=lighter)
    beside_copies(tri, points, lighter)
    report = tri.move(others, weights=weights)
    assert (report.moved, report.reweighted) == (60, 60)
    beside_copies(tri, others, weights)
    weights[[3, 5]] = 0.5, -1
    others[3] = points[3]
    tri.move(others[[3, 5]], [3, 5], weights=weights[[3, 5]])
    beside_copies(tri, others, weights)
    tri.set_weight(3, 0.01)
    weights[3] = 0.01
    assert tri.timestamp == 3
    loaded = pickle.loads(pickle.dumps(tri))
    assert isinstance(loaded, deldrift.PeriodicRegular) and isinstance(tri.copy(), deldrift.PeriodicRegular)
    for other in (tri, loaded, tri.copy(), deldrift.PeriodicDelaunay.frombytes(tri.tobytes())):
        hidden, areas = copies(others, weights)
        assert other.hidden_by_weight.vertices.tolist() == hidden.tolist()
        assert np.allclose(other.voronoi_volumes(), areas, atol=1e-12)


def test_equal_weights_are_none():
    points, _ = made(4)
    tri, plain = deldrift.PeriodicRegular(points, BOX), deldrift.PeriodicDelaunay(points, BOX)
    rows = lambda of: sorted(map(sorted, of.simplices.tolist()))
    assert rows(tri) == rows(plain)
    tri.move(weights=np.full(60, 7.0))
    assert rows(tri) == rows(plain) and tri.report.reweighted == 60


def test_a_trial_is_taken_back():
    points, weights = made(5)
    tri = deldrift.PeriodicRegular(points, BOX, weights)
    areas = tri.voronoi_volumes()
    with tri.trial() as trial:
        tri.move(weights=np.where(np.arange(60) == 7, 9, weights))
        assert tri.report.hidden_by_weight == 59
        trial.withdraw()
        assert np.array_equal(tri.voronoi_volumes(), areas)
        tri.move(vectors=BOX * 1.5, weights=weights)
    assert np.isclose(tri.voronoi_volumes().sum(), 2.25) and tri.timestamp == 1


def test_bad_weights_change_nothing():
    points, weights = made(6)
    tri = deldrift.PeriodicRegular(points, BOX, weights)
    before = tri.tobytes()
    bad = np.where(np.arange(60) == 3, np.nan, weights)
    for wrong in (bad, bad[:5], np.zeros((60, 2)), weights * 1e120):
        with pytest.raises(deldrift.Error):
            tri.move(weights=wrong)
        with pytest.raises(deldrift.Error):
            deldrift.PeriodicRegular(points, BOX, wrong)
    with pytest.raises(deldrift.Error):
        tri.move(ids=[3, 3], weights=[1, 2])
    with pytest.raises(deldrift.Error):
        tri.move(ids=[3])
    with pytest.raises(deldrift.NotWeighted):
        deldrift.PeriodicRegular.frombytes(deldrift.PeriodicDelaunay(points, BOX).tobytes()).weights
    assert tri.tobytes() == before


def test_points_come_with_weights_and_radii():
    points, weights = made(4)
    radii = np.sqrt(weights)
    tri = deldrift.PeriodicRegular(points[:50], BOX, radii=radii[:50])
    beside_copies(tri, points[:50], radii[:50] ** 2)
    assert tri.insert(points[50:], radii=radii[50:]).tolist() == list(range(50, 60))
    beside_copies(tri, points, radii**2)
    tri.move(radii=radii[::-1])
    beside_copies(tri, points, radii[::-1] ** 2)
    tri.changes()
    were_hidden = tri.hidden_by_weight.vertices
    tri.insert([[0.5, 0.5]], weights=[10])
    hidden = tri.hidden_by_weight.vertices
    assert len(hidden) == 60 and tri.changes().hidden.tolist() == np.setdiff1d(hidden, were_hidden).tolist()
    for error, call in (
        (TypeError, lambda: tri.insert([[0, 0]], weights=[1], radii=[1])),
        (deldrift.WrongCount, lambda: tri.insert([[0, 0]], radii=[1, 2])),
        (deldrift.InvalidValue, lambda: tri.insert([[0, 0]], radii=[-1])),
        (deldrift.NotFinite, lambda: tri.insert([[0, 0]], weights=[np.nan])),
    ):
        with pytest.raises(error):
            call()
    assert len(tri.weights) == 61
