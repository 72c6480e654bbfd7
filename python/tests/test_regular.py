"""Weights: each state is the regular triangulation by its definition, that of a fresh one, and scipy's lower hull."""

import copy
import pickle

import numpy as np
import pytest

import deldrift

ALGORITHMS = ["auto", "rebuilding", "placement_flips", "tolerance", "repair"]


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def above(points, weights, simplices, vertex):
    """For each simplex the sign of the height of a vertex above its lifted plane: exact for small whole numbers."""
    heights = (points**2).sum(axis=1) - weights
    lifted = np.column_stack([points, heights])
    # Determinants of whole numbers, which rounding leaves as they are.
    determinants = np.rint(np.linalg.det(lifted[simplices] - lifted[vertex]))
    return -np.sign(determinants) * (-1) ** points.shape[1]


def check(tri):
    """Checks a triangulation of whole numbers by the definition, and beside a fresh one."""
    tri.validate()
    points, weights = tri.points, tri.weights
    present = np.flatnonzero(~np.isnan(weights))
    np.testing.assert_array_equal(np.isnan(points).any(axis=1), np.isnan(weights))
    for vertex in present:
        assert (above(points, weights, tri.simplices, vertex) >= 0).all()
    # The simplices fill the convex hull, and who is not a corner is hidden.
    hull = deldrift.Delaunay(points[present])
    assert tri.volumes().sum() == pytest.approx(hull.volumes().sum(), rel=1e-12)
    by_weight, by_place = tri.hidden_by_weight, tri.coplanar
    hidden = np.concatenate([by_weight.vertices, by_place[:, 0]])
    np.testing.assert_array_equal(np.sort(hidden), np.setdiff1d(present, tri.simplices))
    for vertex, representative in by_place[:, [0, 2]]:
        ranks = [(-weights[v], v) for v in present if (points[v] == points[vertex]).all()]
        assert representative == tri.representative(vertex) == min(ranks)[1]
    for vertex, simplex in zip(*by_weight):
        assert above(points, weights, tri.simplices[[simplex]], vertex)[0] >= 0
        barycentric = tri.barycentric(points[vertex], [simplex])
        assert (barycentric >= 0).all()
    assert tri.statistics.hidden_by_weight == len(by_weight.vertices)
    assert tri.statistics.coincident == len(by_place)
    fresh = deldrift.Regular(points[present], weights[present])
    assert as_sets(tri.simplices) == as_sets(present[fresh.simplices])
    np.testing.assert_array_equal(by_weight.vertices, present[fresh.hidden_by_weight.vertices])


def drawn(rng, count, ndim):
    return rng.integers(0, 7, (count, ndim)).astype(float), rng.integers(-6, 15, count).astype(float)


def check_report(tri, before, hidden_before):
    hidden = {*tri.hidden_by_weight.vertices.tolist(), *tri.coplanar[:, 0].tolist()}
    report = tri.report
    assert report.hidden_by_weight == len(tri.hidden_by_weight.vertices)
    assert report.coincident == len(tri.coplanar)
    shared = min(len(before), tri.npoints)
    assert report.reweighted == (before[:shared] != tri.weights[:shared]).sum()
    assert report.newly_hidden == len(hidden - hidden_before)
    assert report.newly_shown == len(hidden_before - hidden)
    return hidden


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_histories_are_regular(rng, ndim, algorithm):
    points, weights = drawn(rng, 40, ndim)
    tri = deldrift.Regular(points, weights, algorithm=algorithm)
    np.testing.assert_array_equal(tri.weights, weights)
    check(tri)
    hidden = {*tri.hidden_by_weight.vertices.tolist(), *tri.coplanar[:, 0].tolist()}
    assert len(tri.hidden_by_weight.vertices) > 0
    for _ in range(3):
        points, weights = drawn(rng, 40, ndim)
        before = tri.weights
        assert tri.move(weights=weights).moved == 0
        hidden = check_report(tri, before, hidden)
        check(tri)
        before = tri.weights
        tri.move(points)
        hidden = check_report(tri, before, hidden)
        check(tri)
        points, weights = drawn(rng, 40, ndim)
        before = tri.weights
        report = tri.move(points, weights=weights)
        assert report is tri.report
        hidden = check_report(tri, before, hidden)
        check(tri)
        some = rng.permutation(40)[:9]
        before = tri.weights
        tri.move(points[::-1][:9], some, weights=weights[::-1][:9])
        hidden = check_report(tri, before, hidden)
        check(tri)
        before = tri.weights
        tri.move(ids=some[:3], weights=[5, 0, -5])
        assert tri.weights[some[:3]].tolist() == [5, 0, -5]
        hidden = check_report(tri, before, hidden)
        check(tri)
        assert tri.move(weights=tri.weights).reweighted == 0 and tri.report.newly_hidden == 0


def test_vertices_come_and_go_with_weights(rng, ndim):
    points, weights = drawn(rng, 30, ndim)
    tri = deldrift.Regular(points, weights)
    with tri.step() as step:
        new = step.insert(points[:2], weights=[20, -20])
        assert tri.weights[new].tolist() == [20, -20]
        step.move(ids=[new[1]], weights=[7])
        step.move(ids=[3], weights=[4])
        step.move(points[5:6], ids=[4], weights=[1])
        step.remove([0, 9])
    assert new.tolist() == [30, 31] and tri.weights[[30, 31, 3, 4]].tolist() == [20, 7, 4, 1]
    assert np.isnan(tri.weights[[0, 9]]).all()
    check(tri)
    with tri.step() as step:
        assert step.insert(points[2:5], weights=[1, 2, 3], reuse_ids=True).tolist() == [0, 9, 32]
        assert step.insert(points[6:7]).tolist() == [33]
    assert tri.weights[[0, 9, 32, 33]].tolist() == [1, 2, 3, 0]
    check(tri)
    tri.add_points(points[7:9], weights=[8, 9])
    tri.add_points(points[9:10])
    assert tri.weights[34:].tolist() == [8, 9, 0]
    check(tri)
    tri.changes()
    was_hidden = {*tri.hidden_by_weight.vertices.tolist(), *tri.coplanar[:, 0].tolist()}
    assert tri.insert(points[3] + 1, weight=25) == 37 and tri.weights[37] == 25
    check(tri)
    hidden = {*tri.hidden_by_weight.vertices.tolist(), *tri.coplanar[:, 0].tolist()}
    changes = tri.changes()
    assert {*changes.hidden.tolist()} == hidden - was_hidden and {*changes.shown.tolist()} == was_hidden - hidden
    assert len(changes.hidden) > 0
    tri.set_weight(37, 0)
    tri.set_weight(37, 6)
    tri.relocate(37, points[4])
    assert tri.weights[37] == 6
    check(tri)
    tri.remove(36)
    check(tri)
    values = tri.weights
    ids, kept = tri.compact(values=values)
    np.testing.assert_array_equal(tri.weights, kept)
    assert ids[36] == -1 and len(kept) == 37
    check(tri)


def test_radii_are_roots_of_weights(rng, ndim):
    points, radii = rng.integers(0, 7, (40, ndim)).astype(float), rng.random(40) * 4
    tri, squared = deldrift.Regular(points, radii=radii), deldrift.Regular(points, radii**2)
    np.testing.assert_array_equal(tri.weights, radii * radii)
    assert as_sets(tri.simplices) == as_sets(squared.simplices)
    # Of single precision, whose squares are exact; of whole numbers.
    for single in radii[::-1].astype(np.float32), np.arange(40):
        tri.move(radii=single)
        np.testing.assert_array_equal(tri.weights, single.astype(float) ** 2)
        squared.move(weights=single.astype(float) ** 2)
        assert as_sets(tri.simplices) == as_sets(squared.simplices)
        np.testing.assert_array_equal(tri.hidden_by_weight.vertices, squared.hidden_by_weight.vertices)
    tri.move(points[:2], ids=[3, 4], radii=[2, 3])
    tri.set_weight(5, radius=1.5)
    vertex = tri.insert(points[7] + 0.5, radius=0.25)
    with tri.step() as step:
        step.move(ids=[6], radii=[0.5])
        step.insert(points[8:9] + 0.25, radii=[4])
    tri.add_points(points[9:10] + 0.125, radii=[0])
    assert tri.weights[[3, 4, 5, 6, vertex, vertex + 1, vertex + 2]].tolist() == [4, 9, 2.25, 0.25, 0.0625, 16, 0]
    tri.validate()
    single = deldrift.Regular(points.astype(np.float32), (radii**2).astype(np.float32))
    np.testing.assert_array_equal(single.weights, (radii**2).astype(np.float32))


def test_trials_take_weights_back(rng, ndim):
    points, weights = drawn(rng, 30, ndim)
    tri = deldrift.Regular(points, weights)
    simplices, hidden = as_sets(tri.simplices), tri.hidden_by_weight.vertices
    with tri.trial() as trial:
        tri.move(points[::-1], weights=weights[::-1])
        assert (tri.weights == weights[::-1]).all()
        trial.withdraw()
        assert (tri.weights == weights).all() and as_sets(tri.simplices) == simplices
        np.testing.assert_array_equal(tri.hidden_by_weight.vertices, hidden)
        tri.move(weights=weights + 1)
    assert tri.timestamp == 1 and (tri.weights == weights + 1).all()
    assert as_sets(tri.simplices) == simplices
    check(tri)


def test_simplices_are_the_lower_hull_of_scipy(rng, ndim):
    spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")
    points = rng.random((150, ndim))
    tri = deldrift.Regular(points, np.zeros(150))
    for spread in (0.0, 0.01, 0.05, 0.2):
        weights = spread * rng.random(150)
        tri.move(weights=weights)
        hull = spatial.ConvexHull(np.column_stack([points, (points**2).sum(axis=1) - weights]))
        lower = hull.simplices[hull.equations[:, ndim] < 0]
        assert as_sets(tri.simplices) == as_sets(lower)
        np.testing.assert_array_equal(tri.hidden_by_weight.vertices, np.setdiff1d(np.arange(150), lower))


def test_equal_weights_are_none(rng, ndim):
    points = rng.integers(0, 5, (60, ndim)).astype(float)
    plain = deldrift.Delaunay(points)
    for weights in None, np.full(60, 7.5):
        tri = deldrift.Regular(points, weights)
        assert as_sets(tri.simplices) == as_sets(plain.simplices) and len(tri.hidden_by_weight.vertices) == 0
        np.testing.assert_array_equal(tri.coplanar[:, [0, 2]], plain.coplanar[:, [0, 2]])
    assert tri.is_weighted and not plain.is_weighted and isinstance(tri, deldrift.Delaunay)


def test_what_is_asked_heeds_weights(rng, ndim):
    points, weights = rng.random((80, ndim)), 0.1 * rng.random(80)
    tri = deldrift.Regular(points, weights)
    centres, squared_radii = tri.circumcentres()
    corners = tri.simplices
    powers = ((points[corners] - centres[:, None]) ** 2).sum(axis=2) - weights[corners]
    np.testing.assert_allclose(powers, squared_radii[:, None] + np.zeros(ndim + 1), atol=1e-9)
    np.testing.assert_array_equal(tri.alpha_mask(0.01), squared_radii <= 0.01)
    # Lifted corners are on the planes of their simplices, and others above them.
    lifted = tri.lift_points(points)
    lifted[:, -1] -= tri.paraboloid_scale * weights
    distances = lifted @ tri.equations[:, :-1].T + tri.equations[:, -1]
    assert np.abs(np.take_along_axis(distances, corners.T, axis=0)).max() < 1e-9
    assert distances.max() < 1e-9
    xi = rng.random((50, ndim))
    found = tri.find_simplex(xi)
    inside = found >= 0
    assert (tri.barycentric(xi[inside], found[inside]) >= 0).all()
    np.testing.assert_allclose(tri.interpolate(points[:, 0], xi[inside]), xi[inside, 0])
    hidden = tri.hidden_by_weight
    np.testing.assert_array_equal(tri.find_simplex(points[hidden.vertices]), hidden.simplices)
    assert (tri.vertex_to_simplex[hidden.vertices] == -1).all() and len(tri.star(hidden.vertices[0])) == 0
    assert ndim == 3 or len(tri.star(hidden.vertices[0], ordered=True)) == 0
    assert len(tri.segments.ids) == len(tri.segments.ends) == len(tri.segments.markers) == 0


def test_voronoi_cells_are_power_cells(rng, ndim):
    points, weights = rng.random((40, ndim)), (0.05 if ndim == 2 else 0.3) * rng.random(40)
    tri = deldrift.Regular(points, weights)
    box = np.zeros(ndim), np.ones(ndim)
    made = tri.voronoi_weight_derivatives(box)
    volumes = tri.voronoi_volumes(box)
    np.testing.assert_array_equal(made.volumes, volumes)
    np.testing.assert_array_equal(tri.voronoi_cells(box).volumes, volumes)
    assert volumes.sum() == pytest.approx(1, abs=1e-12)
    assert len(tri.hidden_by_weight.vertices) > 0 and (volumes[tri.hidden_by_weight.vertices] == 0).all()
    # Beside places that are counted for the vertex of least power distance.
    axis = (np.arange(24) + 0.5) / 24
    places = np.stack(np.meshgrid(*ndim * [axis]), axis=-1).reshape(-1, ndim)
    powers = ((places[:, None] - points) ** 2).sum(axis=2) - weights
    counted = np.bincount(powers.argmin(axis=1), minlength=40) / len(places)
    np.testing.assert_allclose(volumes, counted, atol=0.01)
    # Derivatives beside differences of volumes.
    step, edges = 1e-7, tri.edges()
    for vertex in tri.simplices[0]:
        tri.set_weight(vertex, weights[vertex] + step)
        slopes = (tri.voronoi_volumes(box) - volumes) / step
        tri.set_weight(vertex, weights[vertex])
        expected = np.zeros(40)
        for (i, j), derivative in zip(edges, made.derivatives):
            if vertex in (i, j):
                expected[i + j - vertex] += derivative
                expected[vertex] -= derivative
        np.testing.assert_allclose(slopes, expected, atol=1e-4)
    some = tri.voronoi_weight_derivatives(box, np.arange(40) < 20)
    np.testing.assert_array_equal(some.volumes, np.where(np.arange(40) < 20, volumes, np.nan))
    is_asked = (edges < 20).any(axis=1)
    np.testing.assert_array_equal(some.derivatives, np.where(is_asked, made.derivatives, np.nan))


def test_newton_finds_weights_of_equal_cells(rng):
    points = rng.random((30, 2))
    tri, box, goal = deldrift.Regular(points), ([0, 0], [1, 1]), np.full(30, 1 / 30)
    for _ in range(60):
        volumes, derivatives = tri.voronoi_weight_derivatives(box)
        if abs(volumes - goal).max() < 1e-12:
            break
        matrix = np.zeros((30, 30))
        i, j = tri.edges().T
        matrix[i, j] = matrix[j, i] = derivatives
        matrix -= np.diag(matrix.sum(axis=1))
        way = np.linalg.lstsq(matrix, goal - volumes, rcond=None)[0]
        # Half of it, and so on, until no cell is lost, which keeps the matrix regular.
        weights, part = tri.weights, 1.0
        while True:
            tri.move(weights=weights + part * way)
            if tri.voronoi_volumes(box).min() > volumes.min() / 2:
                break
            part /= 2
    np.testing.assert_allclose(tri.voronoi_volumes(box), goal, atol=1e-12)


def test_what_is_near_is_so_by_distance(rng, ndim):
    points, weights = drawn(rng, 60, ndim)
    tri, plain = deldrift.Regular(points, weights), deldrift.Delaunay(points)
    xi = 6 * rng.random((20, ndim))
    np.testing.assert_array_equal(tri.nearest_vertices(xi, k=5), plain.nearest_vertices(xi, k=5))
    for place in xi:
        np.testing.assert_array_equal(tri.vertices_in_ball(place, 4), plain.vertices_in_ball(place, 4))
        np.testing.assert_array_equal(tri.vertices_in_box(place - 1, place), plain.vertices_in_box(place - 1, place))
    for told, wanted in zip(tri.neighbor_lists(4), plain.neighbor_lists(4)):
        np.testing.assert_array_equal(told, wanted)
    # The simplices that a vertex of weight 0 would remove.
    gone = tri.conflicts(xi[0])
    before = tri.copy()
    before.insert(xi[0])
    assert as_sets(tri.simplices[gone]) == as_sets(tri.simplices) - as_sets(before.simplices)
    # Natural neighbours are those of power cells, and keep what is linear.
    inner = points.mean(axis=0) + 0.3 * rng.random((9, ndim))
    natural = tri.interpolate(points @ np.ones(ndim), inner, "natural")
    np.testing.assert_allclose(natural, inner @ np.ones(ndim), atol=1e-9)


def test_points_that_span_less_hide_too():
    tri = deldrift.Regular([[0, 0], [1, 1], [2, 2]], [0, -1, 0])
    assert len(tri.simplices) == 0
    assert [array.tolist() for array in tri.hidden_by_weight] == [[], []]
    tri.set_weight(1, -3)
    assert [array.tolist() for array in tri.hidden_by_weight] == [[1], [-1]]
    assert deldrift.Regular(np.empty((0, 3)), []).hidden_by_weight.vertices.shape == (0,)


def test_keys_break_ties(rng, ndim):
    points, weights = drawn(rng, 50, ndim)
    order = rng.permutation(50)
    keys = np.arange(50)
    first = deldrift.Regular(points, weights, keys=keys)
    second = deldrift.Regular(points[order], weights[order], keys=keys[order])
    assert as_sets(first.simplices) == as_sets(order[second.simplices])
    hidden = np.sort(order[second.hidden_by_weight.vertices])
    np.testing.assert_array_equal(first.hidden_by_weight.vertices, hidden)


class Special(deldrift.Regular):
    pass


@pytest.mark.parametrize("kind", [deldrift.Regular, Special])
def test_copies_have_weights(rng, ndim, tmp_path, kind):
    points, weights = drawn(rng, 30, ndim)
    tri = kind(points, weights, algorithm="tolerance")
    tri.remove(4)
    tri.save(tmp_path / "file")
    same = [tri.copy(), copy.deepcopy(tri), pickle.loads(pickle.dumps(tri))]
    loaded = [deldrift.load(tmp_path / "file"), deldrift.frombytes(tri.tobytes())]
    assert all(type(one) is kind for one in same) and all(type(one) is deldrift.Regular for one in loaded)
    for other in same + loaded:
        np.testing.assert_array_equal(other.simplices, tri.simplices)
        np.testing.assert_array_equal(other.weights, tri.weights)
        np.testing.assert_array_equal(other.hidden_by_weight.vertices, tri.hidden_by_weight.vertices)
        other.move(weights=weights[::-1])
        check(other)
    assert (tri.weights[5:] == weights[5:]).all()
    assert type(deldrift.frombytes(deldrift.Delaunay(points).tobytes())) is deldrift.Delaunay


def test_arrays_keep_what_they_show(rng):
    points, weights = drawn(rng, 30, 2)
    tri = deldrift.Regular(points, weights)
    before, hidden, simplices = tri.weights, tri.hidden_by_weight.vertices, tri.simplices
    assert tri.weights is before and not before.flags.writeable and not hidden.flags.writeable
    held = before.copy(), hidden.copy(), simplices.copy()
    tri.move(weights=weights[::-1])
    for array, copied in zip((before, hidden, simplices), held):
        np.testing.assert_array_equal(array, copied)
    assert tri.weights is not before


def test_steps_that_fail_in_part_are_taken_back(rng):
    points, weights = drawn(rng, 20, 2)
    tri = deldrift.Regular(points, weights)
    data = tri.tobytes()
    with pytest.raises(deldrift.NotFinite, match=r"weights\[1\] is NaN"):
        with tri.step() as step:
            try:
                step.insert(points[:2], weights=[0, np.nan])
            except deldrift.NotFinite:
                pass
    with pytest.raises(deldrift.NotFinite, match=r"points\[0\], coordinate 1, is NaN"):
        with tri.step() as step:
            try:
                step.move([[0, np.nan]], ids=[3], weights=[1])
            except deldrift.NotFinite:
                pass
    assert tri.tobytes() == data
    # A call that has staged nothing leaves the step as it was.
    with tri.step() as step:
        with pytest.raises(deldrift.NotFinite):
            step.move(ids=[3], weights=[np.nan])
        step.move(ids=[3], weights=[2])
    assert tri.weights[3] == 2 and tri.timestamp == 1


def test_refused_moves_change_nothing(rng):
    points, weights = drawn(rng, 20, 2)
    tri = deldrift.Regular(points, weights)
    data = tri.tobytes()
    for call in (
        lambda: tri.move(points, weights=[np.inf] * 20),
        lambda: tri.move([[0, np.nan]], ids=[3], weights=[1]),
        lambda: tri.move(points[:3], weights=weights[:3]),
        lambda: tri.move(ids=[3, 3], weights=[1, 2]),
        lambda: tri.move(weights=[1e115] * 20),
    ):
        with pytest.raises(deldrift.Error):
            call()
        assert tri.tobytes() == data
    tri.move(points, weights=weights[::-1])
    check(tri)


REFUSED = """
add_segments([[0, 1]])
check(tri.points)
nesting_levels()
refine()
coarsen()
""".split("\n")[1:-1]


@pytest.mark.parametrize("call", REFUSED)
def test_what_has_no_weights_is_refused(rng, call):
    tri = deldrift.Regular(*drawn(rng, 30, 2))
    tri.changes()
    before = tri.tobytes()
    with pytest.raises(deldrift.Weighted, match="have weights, and this is for points without alone"):
        eval(f"tri.{call}")
    assert tri.tobytes() == before
