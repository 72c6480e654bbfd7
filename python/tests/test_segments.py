"""Segments: against the definition, against Triangle, and against triangulations from nothing."""

import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest

import deldrift
import exact_segments as exact
import polygons


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def draw_segments(rng, points, number):
    """Segments without a conflict, chosen by exact tests."""
    places, chosen = exact.fractions_of(points), []
    for _ in range(number):
        ends = tuple(map(int, rng.choice(len(points), 2, replace=False)))
        a, b = (places[v] for v in ends)
        is_free = not any(exact.is_between(a, b, p) for p in places)
        if is_free and not any(exact.do_cross(a, b, places[c], places[d]) for c, d in chosen):
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


@pytest.mark.parametrize("seed", range(20))
def test_triangle_has_the_same_triangles(seed):
    triangle = pytest.importorskip("triangle", reason="triangle is not installed")
    rng = np.random.default_rng(seed)
    points, segments = scene(rng, int(rng.integers(3, 150)), 60)
    tri = deldrift.Delaunay(points, segments=segments, segment_markers=np.arange(len(segments)) + 2)
    for _ in range(4):
        # With c nothing of the convex hull is cut away.
        theirs = triangle.triangulate({"vertices": tri.points.copy(), "segments": segments}, "pc")
        assert len(theirs["vertices"]) == len(points)
        assert as_sets(tri.simplices) == as_sets(theirs["triangles"])
        step = 0.05 * rng.standard_normal(points.shape) / len(points) ** 0.5
        while len(tri.check(tri.points + step)):
            step *= 0.5
        tri.move(tri.points + step)
    plain = deldrift.Delaunay(tri.points).edges()
    assert len(points) < 20 or not as_sets(segments) <= as_sets(plain)


@pytest.mark.parametrize("algorithm", ["auto", "rebuilding", "placement_flips", "tolerance", "repair"])
def test_histories_end_as_from_nothing(rng, algorithm):
    points, segments = scene(rng, 200, 120)
    tri = deldrift.Delaunay(points, segments=segments, algorithm=algorithm)
    n_refused = n_constrained = 0
    for k in range(25):
        goals = tri.points + (1e-5, 1e-3, 1e-2)[k % 3] * rng.standard_normal(points.shape)
        before = state(tri)
        try:
            tri.move(goals)
        except deldrift.ConflictError:
            n_refused += 1
            assert state(tri) == before
        check_fresh(tri)
        n_constrained += as_sets(tri.simplices) != as_sets(deldrift.Delaunay(tri.points).simplices)
    assert n_refused and n_constrained > 10 and tri.timestamp == 26 - n_refused


def test_immediate_changes_mind_segments(rng):
    points, segments = scene(rng, 30, 12)
    tri = deldrift.Delaunay(points, segments=segments)
    before = state(tri)
    a, b = segments[0]
    middle = (points[a] + points[b]) / 2
    other = next(v for v in range(30) if v not in segments)
    for change in (
        lambda: tri.remove(int(a)),
        lambda: tri.relocate(int(a), points[b]),
        lambda: tri.relocate(int(a), [9.0, 9.0]),
    ):
        with pytest.raises(deldrift.ConflictError) as refused:
            change()
        assert len(refused.value.conflicts) and state(tri) == before
    with pytest.raises(deldrift.ConflictError) as refused:
        tri.move([points[b]], [a])
    assert refused.value.kind is deldrift.ConflictKind.ENDS_MEET
    tri.relocate(other, middle + 1e-3)
    check_fresh(tri)
    tri.insert(middle - 1e-3)
    check_fresh(tri)
    tri.remove(other)
    check_fresh(tri)


def test_markers_and_ids(rng):
    tri = deldrift.Delaunay(rng.random((9, 2)), segments=[[0, 1]], segment_markers=-5)
    assert tri.timestamp == 1 and tri.report.timestamp == 1
    assert tri.segments.markers.tolist() == [-5]
    with tri.step() as step:
        new = step.insert([[3, 3], [4, 3]])
        first = step.add_segments([new, new[::-1]], [2**31 - 1, -(2**31)])
        none = step.add_segments([])
        assert tri.segments.ids.tolist() == [0]
    assert first.tolist() == [1, 2] and none.tolist() == [] and none.dtype == np.int32
    assert tri.segments.ends.tolist() == [[0, 1], new.tolist(), new[::-1].tolist()]
    tri.remove_segments([1])
    assert tri.segments.ids.tolist() == [0, 2]
    assert tri.segments.markers.tolist() == [-5, -(2**31)]
    assert tri.add_segments([[1, 0]]).tolist() == [3]
    for array in tri.segments:
        with pytest.raises(ValueError):
            array[...] = 0
    assert tri.segments is tri.segments
    try:
        with tri.step() as step:
            assert step.add_segments([[2, 3]]).tolist() == [4]
            raise KeyError
    except KeyError:
        pass
    assert len(tri.check(tri.points)) == 0
    assert tri.add_segments(np.empty((0, 2), int)).tolist() == [] and len(tri.segments.ids) == 3


@pytest.mark.parametrize("seed", range(25))
def test_steps_are_split(seed):
    """No pair is in conflict, in fractions; pieces go from end to end of what was given."""
    rng = np.random.default_rng(seed)
    points = rng.random((12, 2)) if seed % 2 else grid_of(rng, 12)
    ends = rng.choice(len(points), (8, 2))
    ends = ends[ends[:, 0] != ends[:, 1]]
    tri = deldrift.Delaunay(points)
    with tri.step() as step:
        given = step.add_segments(ends, markers=np.arange(len(ends)))
        conflicts = step.check()
        splits = step.split()
        assert len(step.check()) == 0 and (splits.rounds > 0) == (len(conflicts) > 0)
    assert tri.nvertices == 12 + len(splits.vertices)
    assert set(splits.pieces.tolist()) == set(tri.segments.ids.tolist()) - set(given.tolist())
    rows = {k: [] for k in range(len(ends))}
    for id_, row, marker in zip(*(array.tolist() for array in tri.segments)):
        rows[marker].append((id_, *row))
    for k, (start, end) in enumerate(ends.tolist()):
        chain = sorted(rows[k])
        assert [chain[0][1], *(row[2] for row in chain)] == [*(row[1] for row in chain), end] and chain[0][1] == start
    laid = dict(zip(tri.segments.ids.tolist(), map(tuple, tri.segments.ends.tolist())))
    assert exact.conflicts_of(exact.fractions_of(tri.points), laid) == []


def test_what_cannot_be_split_stays_staged():
    square = [[0, 0], [4, 0], [4, 3], [0, 3]]
    tri = deldrift.Delaunay(square)
    with tri.step() as step:
        step.add_segments([[0, 2], [1, 3]])
        with pytest.raises(deldrift.ConflictError) as caught:
            step.split(limit=0)
        assert caught.value.kind is deldrift.ConflictKind.CROSSING and len(step.check()) == 1
        assert step.split(limit=1).vertices.tolist() == [4]
    assert tri.segments.ids.tolist() == [2, 3, 4, 5]
    with pytest.raises(deldrift.ConflictError), tri.step() as step:
        step.remove([0])
        step.split()
    assert tri.nvertices == 5


def test_checks_change_nothing(rng):
    points, segments = scene(rng, 60, 30)
    tri = deldrift.Delaunay(points, segments=segments)
    before, rows = state(tri), tri.simplices
    copied = rows.copy()
    assert len(tri.check(points + 1e-9)) == 0
    assert len(tri.check(rng.random(points.shape)))
    assert state(tri) == before
    np.testing.assert_array_equal(rows, copied)
    np.testing.assert_array_equal(tri.simplices, copied)
    assert len(tri.check(points[:1], ids=[0])) == 0
    tri.move(points + 1e-9)
    space = deldrift.Delaunay(rng.random((9, 3)))
    assert len(space.check(space.points)) == 0 and len(space.segments.ids) == 0
    with space.step() as step:
        assert len(step.check()) == 0


def test_a_step_goes_on_after_a_check(rng):
    points, segments = scene(rng, 40, 20)
    tri = deldrift.Delaunay(points, segments=segments)
    with tri.step() as step:
        step.move(1 - points[rng.permutation(40)])
        assert len(step.check())
        step.remove_segments(tri.segments.ids)
        assert len(step.check()) == 0
        step.insert([[5, 5]])
    assert tri.nvertices == 41 and len(tri.segments.ids) == 0
    assert not np.array_equal(tri.points[:40], points)


@pytest.mark.parametrize("copied", ["copy", "copy.copy", "copy.deepcopy", "pickle", "bytes", "file", "compact"])
def test_copies_have_the_segments(rng, tmp_path, copied):
    points, segments = scene(rng, 80, 40)
    tri = deldrift.Delaunay(points, segments=segments, segment_markers=np.arange(len(segments)))
    tri.remove_segments([1, 4])
    other = {
        "copy": lambda: tri.copy(),
        "copy.copy": lambda: copy.copy(tri),
        "copy.deepcopy": lambda: copy.deepcopy(tri),
        "pickle": lambda: pickle.loads(pickle.dumps(tri)),
        "bytes": lambda: deldrift.frombytes(tri.tobytes()),
        "file": lambda: (tri.save(tmp_path / "saved"), deldrift.load(tmp_path / "saved"))[1],
        "compact": lambda: tri.copy(),
    }[copied]()
    if copied == "compact":
        free = [v for v in range(80) if v not in segments][:5]
        for one in tri, other:
            for v in free:
                one.remove(v)
        names = other.compact()
        np.testing.assert_array_equal(names[tri.segments.ends], other.segments.ends)
        assert as_sets(names[tri.simplices]) == as_sets(other.simplices)
    else:
        np.testing.assert_array_equal(other.simplices, tri.simplices)
        np.testing.assert_array_equal(other.segments.ends, tri.segments.ends)
        assert other.tobytes() == tri.tobytes()
    np.testing.assert_array_equal(other.segments.ids, tri.segments.ids)
    np.testing.assert_array_equal(other.segments.markers, tri.segments.markers)
    before = as_sets(tri.simplices)
    other.move(other.points + 1e-3)
    check_fresh(other)
    with pytest.raises(deldrift.ConflictError):
        other.move(rng.random(other.points.shape))
    other.remove_segments(other.segments.ids)
    assert as_sets(other.simplices) == as_sets(deldrift.Delaunay(other.points).simplices)
    assert as_sets(tri.simplices) == before and len(tri.segments.ids)
    assert tri.add_segments([segments[0]]) == [len(segments)]


@pytest.mark.parametrize("seed", range(6))
def test_simplices_beside_segments(seed):
    rng = np.random.default_rng(seed)
    points, segments = scene(rng, 50, 40)
    # Some twice, the other way round; and one along the hull.
    hull = deldrift.Delaunay(points).convex_hull[:1]
    segments = np.concatenate([segments, segments[:5, ::-1], hull])
    tri = deldrift.Delaunay(points, segments=segments)
    tri.remove_segments([2])
    rows, beside = tri.segments_of_cells(), tri.cells_of_segments()
    lowest = {}
    for id, ends in zip(tri.segments.ids.tolist(), tri.segments.ends.tolist()):
        lowest.setdefault(frozenset(ends), id)
    directed = {}
    for cell, triangle in enumerate(tri.simplices.tolist()):
        for k in range(3):
            a, b = triangle[(k + 1) % 3], triangle[(k + 2) % 3]
            directed[a, b] = cell
            assert rows[cell, k] == lowest.get(frozenset((a, b)), -1)
    expected = [[directed.get((a, b), -1), directed.get((b, a), -1)] for a, b in tri.segments.ends.tolist()]
    assert beside.tolist() == expected


@pytest.mark.parametrize("seed", range(6))
def test_levels_and_labels_by_polygons(seed):
    rng = np.random.default_rng(seed)
    rings = polygons.nested(rng)
    vertices, segments, markers = polygons.joined(rings)
    tri = deldrift.Delaunay(vertices, segments=segments, segment_markers=markers)
    tri.add_points(polygons.sprinkled(rng, rings))
    for _ in range(3):
        inside = polygons.around(rings, tri.points, tri.simplices)
        levels = tri.nesting_levels()
        np.testing.assert_array_equal(levels, inside.sum(axis=1))
        assert set(levels) == {0, 1, 2, 3, 4}
        seeds = [tri.points[tri.simplices[np.flatnonzero(levels == k)[0]]].mean(axis=0) for k in (0, 4, 3, 3)]
        labels = tri.label_cells([*seeds, [99, 99]], [-7, 44, 33, 34, 5], other=11)
        # What is outside may be several regions, between the domains and the convex hull.
        is_domain = levels > 0
        np.testing.assert_array_equal(labels[is_domain], np.array([-7, 11, 11, 33, 44])[levels[is_domain]])
        assert set(labels[~is_domain]) <= {-7, 11} and -7 in labels
        shift = 0.01 * rng.standard_normal(2)
        # Rings move together with what is in them, each to another place.
        goals = tri.points + shift
        turned = goals - goals[0]
        if not len(tri.check(turned)):
            tri.move(turned)
        rings = np.split(tri.points[: len(vertices)], np.cumsum([len(one) for one in rings])[:-1])


@pytest.mark.parametrize("seed", range(8))
def test_labels_follow_what_changes(seed):
    """While no vertex passes a segment, as if labelled anew: also vertices that come and go, and pieces of segments."""
    rng = np.random.default_rng(seed)
    rings = polygons.nested(rng)
    vertices, segments, _ = polygons.joined(rings)
    free = polygons.sprinkled(rng, rings)
    tri = deldrift.Delaunay(np.concatenate([vertices, free]), segments=segments, passing="refuse")
    names = np.array([9, -4, 1 << 30, 0, 77, -3], np.int32)
    levels, labels = tri.nesting_levels(), names[tri.nesting_levels()]
    tri.changes()
    n_told = n_steps = 0
    for n_steps in range(1, 31):
        rows = tri.simplices.copy()
        change(rng, tri, n_steps)
        changes = tri.changes()
        levels, labels = (followed(tri, changes, before) for before in (levels, labels))
        listed = np.union1d(changes.created, turned_over(tri, followed(tri, changes, rows)))
        undecided = tri.update_labels(listed, levels)
        assert tri.update_labels(listed, labels, int(names[0])) == undecided
        np.testing.assert_array_equal(labels, names[levels])
        expected = tri.nesting_levels()
        # In a region whose simplices are all listed nothing tells the label.
        is_other = levels != expected
        assert is_other.sum() == undecided and not levels[is_other].any()
        assert set(np.flatnonzero(is_other)) <= set(listed)
        n_told += undecided == 0
        levels, labels = expected, names[expected]
    assert n_told > n_steps / 2
    # From nothing that is not listed nothing can be told, but outside.
    everything = np.full(tri.nsimplex + 3, 5, np.int32)
    inside = int((levels > 0).sum())
    assert tri.update_labels(np.arange(tri.nsimplex), everything, 8) == inside
    assert set(everything[: tri.nsimplex]) == {8} and set(everything[tri.nsimplex :]) == {5}


def change(rng, tri, k):
    """A step of all vertices, or of one that comes or goes, or many that come."""
    if k % 3 == 0:
        tri.insert(rng.uniform(-1, 1, 2))
    elif k % 3 == 1:
        free = np.setdiff1d(np.flatnonzero(~np.isnan(tri.points[:, 0])), tri.segments.ends)
        tri.remove(int(rng.choice(free)))
    else:
        size = 0.05
        while True:
            try:
                tri.move(tri.points + size * rng.standard_normal(tri.points.shape))
                break
            except (deldrift.PassingError, deldrift.ConflictError):
                size /= 2
        if k == 20:
            tri.refine(least_angle=15)


def followed(tri, changes, before):
    """An array for all simplices, which follows those that have another index."""
    after = np.zeros((tri.nsimplex, *before.shape[1:]), before.dtype)
    same = min(len(before), len(after))
    after[:same] = before[:same]
    after[changes.renumbered_to] = before[changes.renumbered_from]
    return after


def turned_over(tri, before):
    """The simplices whose corners were in the other order around, which are no changes, and may be beyond a segment."""
    rows = np.sort(before, axis=1) == np.sort(tri.simplices, axis=1)
    steps = np.argmax(tri.simplices == before[:, :1], axis=1)
    second = tri.simplices[np.arange(tri.nsimplex), (steps + 1) % 3]
    return np.flatnonzero(rows.all(axis=1) & (second != before[:, 1]))


def test_slits_divide_nothing(rng):
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 3], [2, 3.5]])
    tri = deldrift.Delaunay(square, segments=[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6]])
    assert set(tri.nesting_levels()) == {1}
    assert set(tri.label_cells([[0.1, 0.2]], [3])) == {3}
    # On a segment with one region on both sides a seed is not ambiguous.
    assert set(tri.label_cells([[2, 2], [1, 1]], [3, 4])) == {3}
    with pytest.raises(deldrift.AmbiguousSeed) as refused:
        tri.add_segments([[4, 0], [5, 2]])
        tri.label_cells([[1, 1.5], [2, 2]], [1, 2])
    assert (refused.value.argument, refused.value.index) == ("seeds", 1)


def test_regions_follow(rng):
    """Labels that are given once are those of seeds after moves, refinement, a copy and saved data."""
    square, ring = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [2, 1], [2, 2], [1, 2]]
    tri = deldrift.Delaunay(square + ring, segments=[[k, (k + 1) % 4] for k in range(4)] + [[4 + k, 4 + (k + 1) % 4] for k in range(4)])
    assert (tri.regions(7).labels == 7).all() and tri.regions().undecided == tri.nsimplex
    seeds = np.array([[0.5, 0.5], [1.5, 1.5]])
    tri.set_regions(tri.label_cells(seeds, [1, 2]))
    for step in range(5):
        tri.move(np.array(ring) + 0.1 * (step + 1), ids=[4, 5, 6, 7]) if step < 1 else None
        report = tri.refine(greatest_area=0.5, areas=[0, 0.3, 0.01][: 3 if step else 2], domain="regions")
        assert report.bad_cells == 0
        for other in tri, tri.copy(), deldrift.frombytes(tri.tobytes()):
            labels, undecided = other.regions()
            assert undecided == 0
            np.testing.assert_array_equal(labels, other.label_cells(seeds + [[0, 0], [0.1, 0.1]], [1, 2]))
    assert report.inserted == 0 and np.sum(labels == 2) > 4 * np.sum(labels == 1) / 15
    areas = tri.volumes()
    assert areas[labels == 2].max() <= 0.01 and areas[labels == 1].max() <= 0.3
    inner = tri.segments.ids[: 1]
    tri.set_segment_sides(inner, [[5, 5]])
    assert tri.regions().undecided > 0
    with pytest.raises(deldrift.UndecidedRegions, match="sides have no label, or several"):
        tri.refine(greatest_area=0.5, domain="regions")
    tri.set_regions(None)
    assert tri.refine(greatest_area=0.5, domain="regions").inserted == 0
    for wrong, error, name in (
        (lambda: tri.set_regions([1, 2]), deldrift.WrongCount, "labels"),
        (lambda: tri.set_regions(np.arange(tri.nsimplex)), deldrift.InvalidValue, "labels"),
        (lambda: tri.set_segment_sides([0], [1, 2]), deldrift.InvalidShape, "sides"),
        (lambda: tri.set_segment_sides([10**6], [[1, 2]]), deldrift.NoSuchSegment, "segments"),
        (lambda: tri.refine(domain="all"), deldrift.InvalidValue, "domain"),
    ):
        with pytest.raises(error) as refused:
            wrong()
        assert refused.value.argument == name


@pytest.mark.parametrize("seed", range(10))
def test_boundary_chains_of_masks(seed):
    rng = np.random.default_rng(seed)
    points, segments = scene(rng, 60, 30)
    tri = deldrift.Delaunay(points, segments=segments, segment_markers=np.arange(len(segments)) + 5)
    mask = rng.random(tri.nsimplex) < (0.3, 0.7)[seed % 2]
    chains = tri.boundary_chains(mask)
    directed = {
        (row[(k + 1) % 3], row[(k + 2) % 3]): (cell, k)
        for cell, row in enumerate(tri.simplices.tolist())
        for k in range(3)
        if mask[cell]
    }
    expected = {edge: beside for edge, beside in directed.items() if edge[::-1] not in directed}
    found, total = {}, Fraction(0)
    places = exact.fractions_of(points)
    at = 0
    for number, loop in enumerate(chains.loops()):
        assert set(chains.chains[at : at + len(loop)]) == {number}
        for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist()):
            found[a, b] = (int(chains.simplices[at]), int(chains.corners[at]))
            total += places[a][0] * places[b][1] - places[a][1] * places[b][0]
            at += 1
    assert found == expected and len(chains.vertices) == len(found) == at
    assert total == sum(exact.cross(*(places[v] for v in row)) for row in tri.simplices[mask].tolist())
    rows = tri.segments_of_cells()
    np.testing.assert_array_equal(chains.segments, rows[chains.simplices, chains.corners])
    np.testing.assert_array_equal(chains.markers, np.where(chains.segments < 0, 0, chains.segments + 5))
    assert (chains.segments >= 0).any()
    assert tri.boundary_chains(np.zeros(tri.nsimplex, bool)).loops() == []
    hull = tri.boundary_chains()
    assert {tuple(e) for e in tri.convex_hull[:, ::-1].tolist()} in (
        set(zip(hull.vertices.tolist(), np.roll(hull.vertices, -1).tolist())),
        set(zip(np.roll(hull.vertices, -1).tolist(), hull.vertices.tolist())),
    )


def test_segments_on_a_line_and_of_hidden_vertices():
    tri = deldrift.Delaunay([[0, 0], [1, 1], [2, 2], [1, 1]], segments=[[0, 1], [3, 2]])
    assert tri.nsimplex == 0 and tri.cells_of_segments().tolist() == [[-1, -1]] * 2
    assert len(tri.nesting_levels()) == len(tri.label_cells([[0, 0]], [1])) == len(tri.boundary_chains().vertices) == 0
    with pytest.raises(deldrift.ConflictError) as refused:
        tri.add_segments([[0, 2]])
    assert refused.value.conflicts.tolist() == [(1, 2, 1)]
    tri.insert([2, 0])
    assert as_sets([[0, 1], [1, 2]]) <= as_sets(tri.edges())
    tri.move([[1.5, 1]], [3])
    assert as_sets([[0, 1], [3, 2]]) <= as_sets(tri.edges())


def test_lines_go_to_meshio_with_markers(rng, tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    points, segments = scene(rng, 30, 10)
    tri = deldrift.Delaunay(points, segments=segments, segment_markers=np.arange(len(segments)) + 1)
    free = next(v for v in range(30) if v not in segments)
    tri.remove(free)
    tri.to_meshio().write(tmp_path / "mesh.vtu")
    mesh = meshio.read(tmp_path / "mesh.vtu")
    assert [block.type for block in mesh.cells] == ["triangle", "line"]
    names = mesh.point_data["vertex"]
    np.testing.assert_array_equal(names[mesh.cells[1].data], segments)
    np.testing.assert_array_equal(names[mesh.cells[0].data], tri.simplices)
    np.testing.assert_array_equal(mesh.cell_data["marker"][1], tri.segments.markers)
    assert not mesh.cell_data["marker"][0].any()


def test_lines_of_files_are_read_by_meshio(rng, tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    points, segments = scene(rng, 30, 10)
    tri = deldrift.Delaunay(points, segments=segments, segment_markers=np.arange(len(segments)) - 4)
    tri.remove(next(v for v in range(30) if v not in segments))
    heat, labels = rng.random(tri.nsimplex), tri.label_cells(points[:1] + 1e-3, [7], -2)
    tri.write_vtu(tmp_path / "a.vtu", None, {"heat": heat})
    tri.write_medit(tmp_path / "a.mesh", labels)
    for path, ids, name in (("a.vtu", "vertex", "marker"), ("a.mesh", "medit:ref", "medit:ref")):
        mesh = meshio.read(tmp_path / path)
        assert [block.type for block in mesh.cells] == ["triangle", "line"]
        names = mesh.point_data[ids].ravel().astype(int)
        np.testing.assert_array_equal(names[mesh.cells[0].data], tri.simplices)
        np.testing.assert_array_equal(names[mesh.cells[1].data], segments)
        np.testing.assert_array_equal(mesh.cell_data[name][1].ravel(), tri.segments.markers)
        np.testing.assert_array_equal(mesh.cell_data[name][0].ravel(), 0 if path == "a.vtu" else labels)
        if path == "a.vtu":
            np.testing.assert_array_equal(mesh.cell_data["heat"][0].ravel(), heat)
            assert np.isnan(mesh.cell_data["heat"][1]).all()
    with pytest.raises(deldrift.InvalidField, match="marker"):
        tri.write_vtu(tmp_path / "a.vtu", None, {"marker": heat})


def test_segments_are_drawn(rng):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("Agg")
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

    points, segments = scene(rng, 30, 10)
    ax = deldrift.Delaunay(points, segments=segments).plot(Figure().add_subplot())
    (drawn,) = [artist for artist in ax.collections if isinstance(artist, LineCollection)]
    np.testing.assert_array_equal(drawn.get_segments(), points[segments])


def passes_still(places, ends, start, goal):
    """Whether a vertex passes a segment that stays: by the way of the vertex, which is a segment as well."""
    a, b = (places[v] for v in ends)
    if {start, goal} & {a, b}:
        return False
    is_through_an_end = exact.is_between(start, goal, a) or exact.is_between(start, goal, b)
    return is_through_an_end or exact.is_between(a, b, goal) or exact.do_cross(start, goal, a, b)


@pytest.mark.parametrize("seed", range(30))
def test_passings_are_told_and_refused(seed):
    """One vertex jumps, while all others stay, or go along with it by a way that is exact."""
    rng = np.random.default_rng(seed)
    steps = 16 if seed % 2 else 1 << 20
    points = np.unique(rng.integers(0, steps, (30, 2)), axis=0) / steps
    segments = draw_segments(rng, points, 12)
    telling, refusing, ignoring = (
        deldrift.Delaunay(points, segments=segments, passing=passing) for passing in ("tell", "refuse", "ignore")
    )
    n_passed = 0
    for _ in range(25):
        shift = rng.integers(-3, 4, 2).astype(float)
        v, goal = int(rng.integers(len(points))), rng.integers(-steps, 2 * steps, 2) / steps
        if v in segments:
            continue
        places, to = exact.fractions_of(points), exact.fractions_of(goal[None])[0]
        expected = [(k, v) for k, ends in enumerate(segments) if passes_still(places, ends, places[v], to)]
        after = points.copy()
        after[v] = goal
        for tri in telling, refusing, ignoring:
            with pytest.raises(KeyboardInterrupt), tri.step() as step:
                step.move(after + shift)
                assert step.passings().tolist() == tri.passings.tolist() == expected
                raise KeyboardInterrupt
        before = state(refusing)
        if expected:
            with pytest.raises(deldrift.PassingError) as refused:
                refusing.move(after + shift)
            assert refused.value.passings.tolist() == refusing.passings.tolist() == expected
            again = pickle.loads(pickle.dumps(refused.value))
            assert str(again) == str(refused.value) and (again.passings == refused.value.passings).all()
            assert state(refusing) == before
            n_passed += 1
        try:
            telling.move(after + shift)
        except deldrift.ConflictError:
            assert telling.passings.tolist() == expected
            continue
        assert telling.passings.tolist() == expected
        copied = copy.copy(telling)
        ignoring.move(after + shift)
        assert len(ignoring.passings) == len(copied.passings) == 0
        np.testing.assert_array_equal(np.sort(ignoring.simplices), np.sort(telling.simplices))
        points = after
        for tri in telling, ignoring:
            tri.move(points)
        if not expected:
            refusing.move(points)
        else:
            refusing = deldrift.Delaunay(points, segments=segments, passing="refuse")
    assert n_passed > 2


def test_passing_is_kept_with_a_triangulation(tmp_path):
    square = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]]
    tri = deldrift.Delaunay(square, segments=[[0, 2]], passing="refuse")
    tri.save(tmp_path / "square")
    for other in copy.deepcopy(tri), pickle.loads(pickle.dumps(tri)), deldrift.load(tmp_path / "square", passing="refuse"):
        with pytest.raises(deldrift.PassingError, match="vertex 4 passes segment 0"):
            other.move([[2, 1]], ids=[4])
    assert deldrift.load(tmp_path / "square").move([[2, 1]], ids=[4]).moved == 1
    solid = deldrift.Delaunay(np.eye(4, 3))
    assert len(solid.passings) == 0
    with pytest.raises(deldrift.InvalidDimension), solid.step() as step:
        step.passings()


def test_a_mesh_advances_to_where_nothing_passes():
    triangle = [[0, 1], [1, 2], [2, 0]]
    mesh = deldrift.Mesh([[0, 0], [4, 0], [0, 4], [1, 1]], triangle, passing="refuse")
    with pytest.raises(deldrift.PassingError):
        mesh.move([[4, 4]], ids=[3])
    assert mesh.advance([[4, 4]], ids=[3]) == 0.25
    mesh = deldrift.Mesh([[0, 0], [4, 0], [0, 4], [1, 1]], triangle, passing="tell")
    mesh.move([[4, 4]], ids=[3])
    assert mesh.passings.tolist() == [(1, 3)]
