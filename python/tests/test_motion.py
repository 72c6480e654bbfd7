"""Motion: every state is compared with a fresh triangulation of the positions."""

import numpy as np
import pytest

import deldrift

ALGORITHMS = ["auto", "rebuilding", "placement_flips", "tolerance", "repair"]


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def check(tri):
    """Compares with a fresh triangulation of the vertices that are present, in the order of their ids."""
    present = np.flatnonzero([tri.is_present(i) for i in range(tri.npoints)])
    fresh = deldrift.Delaunay(tri.points[present])
    assert as_sets(tri.simplices) == as_sets(present[fresh.simplices])
    np.testing.assert_array_equal(np.isnan(tri.points).any(axis=1), ~np.isin(np.arange(tri.npoints), present))
    tri.validate()


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("amplitude", [0.0, 1e-3, 0.3])
def test_all_move(rng, ndim, algorithm, amplitude):
    points = rng.random((200, ndim))
    tri = deldrift.Delaunay(points, algorithm=algorithm)
    assert tri.algorithm == algorithm
    for number in range(1, 5):
        points = points + amplitude * rng.standard_normal(points.shape)
        report = tri.move(points)
        assert report is tri.report
        assert (report.timestamp, tri.timestamp) == (number, number)
        assert report.moved == (len(points) if amplitude else 0)
        np.testing.assert_array_equal(tri.points, points)
        check(tri)


def test_some_move(rng, ndim):
    tri = deldrift.Delaunay(rng.random((200, ndim)))
    expected = tri.points.copy()
    for _ in range(5):
        chosen = rng.choice(200, 20, replace=False)
        places = rng.random((20, ndim))
        expected[chosen] = places
        assert tri.move(places, chosen).moved == 20
        np.testing.assert_array_equal(tri.points, expected)
        check(tri)


def test_a_step_is_one_timestamp(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)))
    with tri.step() as step:
        step.move(rng.random((10, ndim)), np.arange(10))
        first = step.insert(rng.random((5, ndim)))
        second = step.insert(rng.random((2, ndim)))
        step.remove([20, 30])
        assert tri.timestamp == 0
    np.testing.assert_array_equal(np.concatenate([first, second]), np.arange(100, 107))
    assert (tri.timestamp, tri.nvertices, tri.npoints) == (1, 105, 107)
    assert (tri.report.inserted, tri.report.removed, tri.report.moved) == (7, 2, 10)
    check(tri)


def test_a_step_moves_all_without_ids(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    moved = rng.random((50, ndim))
    with tri.step() as step:
        step.move(moved)
    np.testing.assert_array_equal(tri.points, moved)
    with pytest.raises(deldrift.WrongCount, match="points has 49 rows, and there are 50 ids"):
        with tri.step() as step:
            step.move(moved[:49])


def test_an_exception_rolls_a_step_back(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)))
    before, points = tri.simplices.copy(), tri.points.copy()
    with pytest.raises(ZeroDivisionError):
        with tri.step() as step:
            step.move(rng.random((100, ndim)))
            step.insert(rng.random((3, ndim)))
            step.remove([7])
            1 / 0
    assert (tri.timestamp, tri.npoints, tri.nvertices) == (0, 100, 100)
    np.testing.assert_array_equal(tri.simplices, before)
    np.testing.assert_array_equal(tri.points, points)
    tri.move(points)
    np.testing.assert_array_equal(tri.simplices, before)


def test_a_commit_that_fails_rolls_a_step_back(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)), coincidence="reject")
    points = tri.points.copy()
    with pytest.raises(deldrift.Coincident):
        with tri.step() as step:
            step.insert(points[:1])
    assert (tri.timestamp, tri.npoints) == (0, 100)
    with tri.step() as step:
        step.move(points[1:] + 1e-3, np.arange(1, 100))
    check(tri)


def test_nothing_else_changes_a_triangulation_in_a_step(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)))
    with tri.step() as step:
        with pytest.raises(deldrift.Busy, match="step"):
            tri.move(tri.points)
        with pytest.raises(deldrift.Busy, match="step"):
            with tri.step():
                pass
        step.move(rng.random((1, ndim)), [3])
    assert tri.report.moved == 1
    with pytest.raises(deldrift.Busy, match="not open"):
        step.move(rng.random((1, ndim)), [3])


def test_one_vertex_at_a_time(rng, ndim):
    tri = deldrift.Delaunay(rng.random((60, ndim)))
    for _ in range(20):
        tri.relocate(int(rng.integers(60)), rng.random(ndim))
        check(tri)
    assert tri.insert(rng.random(ndim)) == 60
    tri.remove(0)
    assert not tri.is_present(0) and not tri.is_present(61)
    check(tri)
    assert tri.timestamp == 0
    new_ids = tri.compact()
    np.testing.assert_array_equal(new_ids, np.arange(-1, 60))
    assert tri.npoints == 60
    check(tri)


def test_arrays_kept_by_changes_are_those_of_a_full_reading(rng, ndim):
    """What the docstring of Changes says: rows set aside, written to new indices, made."""
    tri = deldrift.Delaunay(rng.random((80, ndim)))
    kept = {}
    for number in range(40):
        changes = tri.changes()
        removed = {k: kept.pop(k) for k in changes.removed.tolist()}
        for k, row in zip(changes.removed.tolist(), changes.removed_simplices.tolist()):
            assert removed[k] == sorted(row)
        renumbered = [kept.pop(k) for k in changes.renumbered_from.tolist()]
        kept.update(zip(changes.renumbered_to.tolist(), renumbered))
        for k in changes.created.tolist():
            assert k not in kept
            kept[k] = sorted(tri.simplices[k].tolist())
        assert kept == {k: sorted(row) for k, row in enumerate(tri.simplices.tolist())}
        touched = {v for k in changes.created.tolist() for v in kept[k]}
        touched |= {v for row in changes.removed_simplices.tolist() for v in row}
        assert changes.stars.tolist() == sorted(touched)
        if number % 3 == 0:
            tri.insert(rng.random(ndim))
        elif number % 3 == 1:
            present = [i for i in range(tri.npoints) if tri.is_present(i)]
            tri.remove(int(rng.choice(present)))
        else:
            tri.move(tri.points + 0.01 * rng.standard_normal(tri.points.shape))


def test_hidden_and_shown(ndim):
    points = np.vstack([np.zeros(ndim), np.eye(ndim), np.full(ndim, 0.25)])
    tri = deldrift.Delaunay(points)
    tri.changes()
    tri.relocate(ndim + 1, points[0])
    assert tri.changes().hidden.tolist() == [ndim + 1]
    assert tri.representative(ndim + 1) == 0
    tri.relocate(ndim + 1, points[-1])
    assert tri.changes().shown.tolist() == [ndim + 1]


def test_statistics_are_sums(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)))
    for _ in range(3):
        tri.move(rng.random((100, ndim)))
    assert tri.statistics.moved == 300
    assert tri.statistics.as_dict()["timestamp"] == 3
    assert "moved=300" in repr(tri.statistics)


def test_algorithm_may_be_changed(rng, ndim):
    tri = deldrift.Delaunay(rng.random((100, ndim)))
    for name in ALGORITHMS:
        tri.algorithm = name
        assert tri.algorithm == name
        tri.move(tri.points + 1e-3 * rng.standard_normal(tri.points.shape))
        check(tri)
    with pytest.raises(deldrift.InvalidOption, match="algorithm is 'fast', and must be one of 'auto'"):
        tri.algorithm = "fast"


def test_a_trial_is_one_timestamp(rng, ndim):
    points = rng.random((100, ndim))
    tri = deldrift.Delaunay(points)
    with tri.trial():
        tri.move(rng.random((100, ndim)))
        check(tri)
        with tri.step() as step:
            step.insert(rng.random((5, ndim)))
            step.remove([3])
        check(tri)
        assert (tri.timestamp, tri.npoints) == (0, 105)
    assert tri.timestamp == 1
    check(tri)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_what_is_withdrawn_has_never_been(rng, ndim, algorithm):
    tri = deldrift.Delaunay(rng.random((150, ndim)), algorithm=algorithm)
    tri.changes()
    before, points, neighbors = tri.tobytes(), tri.points.copy(), tri.neighbors.copy()
    with tri.trial() as trial:
        for amplitude in (1e-3, 0.3):
            tri.move(points + amplitude * rng.standard_normal(points.shape))
            check(tri)
            with tri.step() as step:
                step.insert(rng.random((3, ndim)))
            trial.withdraw()
            assert tri.tobytes() == before
    assert tri.timestamp == 0
    with pytest.raises(ZeroDivisionError):
        with tri.trial():
            tri.move(points + 1)
            1 / 0
    assert tri.tobytes() == before
    np.testing.assert_array_equal(tri.neighbors, neighbors)
    assert all(len(listed) == 0 for listed in tri.changes())


def test_a_step_that_fails_in_a_trial_is_taken_back_alone(ndim):
    points = np.vstack([np.zeros(ndim), np.eye(ndim), np.full(ndim, 0.1)])
    tri = deldrift.Delaunay(points, coincidence="reject")
    with tri.trial():
        tri.move([np.full(ndim, 0.2)], ids=[ndim + 1])
        with pytest.raises(deldrift.Coincident):
            tri.move([points[0]], ids=[ndim + 1])
        np.testing.assert_array_equal(tri.points[ndim + 1], np.full(ndim, 0.2))
    assert tri.timestamp == 1
    check(tri)


def test_what_a_trial_could_not_take_back_is_refused(ndim):
    tri = deldrift.Delaunay(np.vstack([np.zeros(ndim), np.eye(ndim)]))
    with tri.trial() as trial:
        tri.move(tri.points + 1)
        calls = [
            lambda: tri.insert(np.full(ndim, 0.1)),
            lambda: tri.remove(0),
            lambda: tri.relocate(0, np.full(ndim, 0.1)),
            tri.compact,
            tri.changes,
            tri.copy,
            tri.tobytes,
        ]
        for call in calls:
            with pytest.raises(deldrift.Prepared, match="timestamp 1 is prepared, in 1 round"):
                call()
        with pytest.raises(deldrift.Busy, match="a trial of the triangulation is open"):
            with tri.trial():
                pass
        trial.withdraw()
        tri.insert(np.full(ndim, 0.1))
    with pytest.raises(deldrift.Busy, match="the trial is not open"):
        trial.withdraw()
    assert tri.timestamp == 0
