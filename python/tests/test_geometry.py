"""Geometry in bulk, beside straightforward arithmetic of NumPy and brute force."""

import math
from fractions import Fraction

import numpy as np
import pytest

import deldrift


@pytest.fixture
def tri(rng, ndim):
    return deldrift.Delaunay(rng.random((150, ndim)))


def test_volumes(tri):
    corners = tri.points[tri.simplices]
    expected = np.linalg.det(corners[:, 1:] - corners[:, :1]) / math.factorial(tri.ndim)
    np.testing.assert_allclose(tri.volumes(), expected, rtol=1e-6)
    assert (tri.volumes() > 0).all()


def test_circumcentres(tri):
    centres, squared_radii = tri.circumcentres()
    corners = tri.points[tri.simplices]
    squared = ((corners - centres[:, None]) ** 2).sum(axis=2)
    scale = squared_radii[:, None] + 1
    np.testing.assert_allclose(squared / scale, squared_radii[:, None] / scale + 0 * squared, rtol=1e-7)


def exact_squared_radius(corners):
    """Of a triangle with rational corners: the product of the squared sides over 16 squared areas."""
    (ax, ay), (bx, by), (cx, cy) = [[Fraction(x) for x in row] for row in corners.tolist()]
    doubled = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    sides = (bx - ax) ** 2 + (by - ay) ** 2, (cx - bx) ** 2 + (cy - by) ** 2, (ax - cx) ** 2 + (ay - cy) ** 2
    return sides[0] * sides[1] * sides[2] / (4 * doubled**2)


def test_alpha_mask_is_exact(rng):
    tri = deldrift.Delaunay(rng.random((60, 2)))
    exact = [exact_squared_radius(tri.points[row]) for row in tri.simplices]
    for limit in sorted(float(r) for r in exact)[::7]:
        assert tri.alpha_mask(limit).tolist() == [r <= Fraction(limit) for r in exact]
    assert tri.alpha_mask(np.inf).all() and tri.alpha_mask(0.0).dtype == bool


def test_boundary(tri, rng):
    mask = rng.random(tri.nsimplex) < 0.5
    boundary = tri.boundary(mask)
    expected = [
        (k, corner)
        for k in range(tri.nsimplex)
        for corner in range(tri.ndim + 1)
        if mask[k] and (tri.neighbors[k, corner] < 0 or not mask[tri.neighbors[k, corner]])
    ]
    assert list(zip(boundary.simplices.tolist(), boundary.corners.tolist())) == expected
    for facet, k, corner in zip(*boundary):
        assert set(facet) == set(np.delete(tri.simplices[k], corner))
        apex = tri.points[tri.simplices[k, corner]]
        at = tri.points[facet]
        side = np.linalg.det(np.vstack([at[1:] - at[0], apex - at[0]]))
        assert side > 0 if tri.ndim == 2 else side < 0
    np.testing.assert_array_equal(tri.boundary(np.ones(tri.nsimplex, bool)).facets, tri.convex_hull)
    np.testing.assert_array_equal(tri.boundary().facets, tri.convex_hull)


def test_edges_and_lists(tri):
    expected = sorted({(a, b) for row in tri.simplices.tolist() for a in row for b in row if a < b})
    assert list(map(tuple, tri.edges().tolist())) == expected
    indptr, indices = tri.vertex_simplices()
    for v in range(tri.npoints):
        around = np.flatnonzero((tri.simplices == v).any(axis=1))
        np.testing.assert_array_equal(indices[indptr[v] : indptr[v + 1]], around)
        assert sorted(tri.star(v)) == around.tolist()


def test_stars_in_order(rng):
    tri = deldrift.Delaunay(rng.random((50, 2)))
    for v in range(50):
        star = tri.star(v, ordered=True).tolist()
        assert sorted(star) == sorted(tri.star(v))
        for first, second in zip(star, star[1:]):
            assert second in tri.neighbors[first]


def test_mirrors(tri):
    mirrors = tri.mirror_indices()
    for (k, corner), beside in np.ndenumerate(tri.neighbors):
        if beside < 0:
            assert mirrors[k, corner] == 255
        else:
            assert tri.neighbors[beside, mirrors[k, corner]] == k


def test_updates_are_those_of_a_full_pass(tri, rng):
    volumes, mask = tri.volumes(), tri.alpha_mask(0.01)
    centres, squared_radii = tri.circumcentres()
    tri.changes()
    moved = [3, 77, 149]
    tri.move(tri.points[moved] + 1e-9, moved)
    changes = tri.changes()
    assert not len(changes.created)
    around = tri.simplices_around(moved)
    np.testing.assert_array_equal(around, np.flatnonzero(np.isin(tri.simplices, moved).any(axis=1)))
    tri.update_volumes(around, volumes)
    tri.update_circumcentres(around, centres, squared_radii)
    tri.update_alpha_mask(around, 0.01, mask)
    np.testing.assert_array_equal(volumes, tri.volumes())
    np.testing.assert_array_equal(centres, tri.circumcentres()[0])
    np.testing.assert_array_equal(squared_radii, tri.circumcentres()[1])
    np.testing.assert_array_equal(mask, tri.alpha_mask(0.01))


def test_voronoi_cells_fill_the_box(tri):
    low, high = np.full(tri.ndim, -0.5), np.full(tri.ndim, 1.25)
    volumes = tri.voronoi_volumes((low, high))
    assert volumes.sum() == pytest.approx(np.prod(high - low), rel=1e-9)
    assert np.isinf(tri.voronoi_volumes()[tri.convex_hull.ravel()]).all()
    measures = tri.voronoi_facets((low, high))
    assert len(measures) == len(tri.edges()) and (measures >= 0).all()


def test_facets_and_volumes_agree(tri):
    inside = np.setdiff1d(np.arange(tri.npoints), tri.convex_hull)
    volumes, measures, edges = tri.voronoi_volumes(), tri.voronoi_facets(), tri.edges()
    lengths = np.linalg.norm(tri.points[edges[:, 0]] - tri.points[edges[:, 1]], axis=1)
    of_vertex = np.zeros(tri.npoints)
    for column in edges.T:
        np.add.at(of_vertex, column, measures * lengths / (2 * tri.ndim))
    np.testing.assert_allclose(of_vertex[inside], volumes[inside], rtol=1e-6)


def test_voronoi_derivatives_are_those_of_volumes(tri, rng):
    low, high = np.full(tri.ndim, -0.5), np.full(tri.ndim, 1.25)
    cells, facets, edges = tri.voronoi_cells((low, high)), tri.voronoi_derivatives((low, high)), tri.edges()
    np.testing.assert_allclose(cells.volumes, tri.voronoi_volumes((low, high)), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(facets.measures, tri.voronoi_facets((low, high)), rtol=1e-6, atol=1e-9)
    total = (cells.volumes[:, None] * cells.centroids).sum(axis=0)
    np.testing.assert_allclose(total, np.prod(high - low) * (low + high) / 2, rtol=1e-9)
    step = 1e-7 * rng.standard_normal(tri.points.shape)
    change = np.zeros(tri.npoints)
    for (i, j), (of_i, of_j) in zip(edges, facets.derivatives, strict=True):
        change[i] += of_i @ step[j] - of_j @ step[i]
        change[j] += of_j @ step[i] - of_i @ step[j]
    moved = type(tri)(tri.points + step)
    back = type(tri)(tri.points - step)
    found = (moved.voronoi_cells((low, high)).volumes - back.voronoi_cells((low, high)).volumes) / 2
    np.testing.assert_allclose(found, change, atol=1e-3 * np.abs(change).max())
    mask = np.arange(tri.npoints) % 3 == 0
    some = tri.voronoi_cells((low, high), mask)
    np.testing.assert_array_equal(some.volumes[mask], cells.volumes[mask])
    assert np.isnan(some.volumes[~mask]).all()
    of_some = tri.voronoi_derivatives((low, high), mask)
    np.testing.assert_array_equal(np.isnan(of_some.measures), ~mask[edges].any(axis=1))


def test_voronoi_cells_and_facets_come_together(tri):
    low, high = tri.points.min(axis=0), tri.points.max(axis=0)
    row = np.append(np.ones(tri.ndim), 0.5 * (low + high).sum())
    mask = np.arange(len(tri.points)) % 3 == 0
    for box, planes, some in [((low, high), None, None), ((low, high), [row], mask), (None, None, None), (None, None, mask)]:
        cells, facets = tri.voronoi_cells_and_facets(box, some, half_spaces=planes)
        for told, wanted in [(cells, tri.voronoi_cells(box, some, half_spaces=planes)),
                             (facets, tri.voronoi_derivatives(box, some, half_spaces=planes))]:
            assert all(np.array_equal(a, b, equal_nan=True) for a, b in zip(told, wanted))
    whole = tri.voronoi_cells()
    assert np.array_equal(whole.volumes, tri.voronoi_volumes(), equal_nan=True)
    assert np.isinf(whole.volumes).any() and np.isnan(whole.centroids[np.isinf(whole.volumes)]).all()
    with pytest.raises(deldrift.Error):
        tri.voronoi_cells(half_spaces=[row])


def test_half_spaces_clip_voronoi_cells(tri):
    low, high = np.full(tri.ndim, -0.5), np.full(tri.ndim, 1.5)
    wholes = tri.voronoi_cells((low, high))
    normal = np.arange(1.0, tri.ndim + 1)
    row = np.append(normal, normal.sum() / 2)  # through the middle of the box
    below, above = (tri.voronoi_cells((low, high), half_spaces=[sign * row]) for sign in (1, -1))
    assert below.volumes.sum() == pytest.approx(2.0**tri.ndim / 2, rel=1e-9)
    np.testing.assert_allclose(below.volumes + above.volumes, wholes.volumes, rtol=1e-9, atol=1e-12)
    assert (below.centroids[below.volumes > 0] @ normal <= row[-1] + 1e-9).all()
    assert np.isnan(below.centroids[below.volumes == 0]).all()
    mask = np.arange(tri.npoints) % 3 == 0
    some = tri.voronoi_cells((low, high), mask, half_spaces=[row])
    np.testing.assert_array_equal(some.volumes[mask], below.volumes[mask])
    whole_facets = tri.voronoi_derivatives((low, high))
    facets, others = (tri.voronoi_derivatives((low, high), half_spaces=[sign * row]) for sign in (1, -1))
    np.testing.assert_allclose(facets.measures + others.measures, whole_facets.measures, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(
        facets.derivatives + others.derivatives, whole_facets.derivatives, rtol=1e-6, atol=1e-6
    )
    assert (facets.centroids[facets.measures > 0] @ normal <= row[-1] + 1e-9).all()
    empty = tri.voronoi_cells((low, high), half_spaces=[row, -row - np.append(np.zeros(tri.ndim), 1)])
    assert (empty.volumes == 0).all() and (empty.areas == 0).all()


@pytest.mark.parametrize("method", ["linear", "natural"])
def test_interpolation_reproduces_linear_functions(tri, rng, method):
    slopes = rng.standard_normal((tri.ndim, 2))
    values = tri.points @ slopes + 3
    x = rng.random((40, 5, tri.ndim))
    results = tri.interpolate(values, x, method=method, fill_value=[-1, -2])
    inside = tri.find_simplex(x) >= 0
    assert results.shape == (40, 5, 2)
    np.testing.assert_allclose(results[inside], (x @ slopes + 3)[inside], rtol=1e-9)
    assert (results[~inside] == [-1, -2]).all()
    one = tri.interpolate(values[:, 0], x, method=method)
    assert one.shape == (40, 5) and np.isnan(one[~inside]).all()
    np.testing.assert_array_equal(one[inside], results[inside][:, 0])


def test_places_and_near_vertices(tri, rng):
    x = rng.random((40, tri.ndim)) * 1.4 - 0.2
    kinds, indices = tri.locate(x)
    np.testing.assert_array_equal(kinds == 1, tri.find_simplex(x) >= 0)
    np.testing.assert_array_equal(tri.locate(tri.points)[0], np.zeros(tri.npoints))
    np.testing.assert_array_equal(tri.locate(tri.points)[1], np.arange(tri.npoints))
    distances = ((tri.points - x[:, None]) ** 2).sum(axis=2)
    by_distance = np.argsort(distances, axis=1, kind="stable")
    np.testing.assert_array_equal(tri.nearest_vertices(x), by_distance[:, 0])
    np.testing.assert_array_equal(tri.nearest_vertices(x.reshape(8, 5, -1), k=7), by_distance[:, :7].reshape(8, 5, 7))
    assert deldrift.Delaunay(np.empty((0, tri.ndim))).nearest_vertices(x[0]) == -1
    for place, row in zip(x, distances):
        np.testing.assert_array_equal(tri.vertices_in_ball(place, 0.1), np.flatnonzero(row <= 0.1))
        is_in = ((tri.points >= place) & (tri.points <= place + 0.5)).all(axis=1)
        np.testing.assert_array_equal(tri.vertices_in_box(place, place + 0.5), np.flatnonzero(is_in))


def test_neighbor_lists(tri, rng):
    squares = ((tri.points - tri.points[:, None]) ** 2).sum(axis=2)
    n = len(squares)
    # Between two distances, as squares are rounded here.
    limit = np.sort(squares[0])[n // 3 : n // 3 + 2].mean()
    near = squares <= limit
    np.fill_diagonal(near, False)
    indptr, indices = tri.neighbor_lists(limit)
    for k in range(n):
        np.testing.assert_array_equal(indices[indptr[k] : indptr[k + 1]], np.flatnonzero(near[k]))
    # Each its own radius, for some, once.
    radii, mask = rng.random(n) * limit, rng.random(n) < 0.7
    own = (squares <= radii[:, None]) & mask[:, None]
    np.fill_diagonal(own, False)
    pairs = own | own.T
    in_row = np.where(mask[:, None] & mask, np.triu(pairs), own & ~mask)
    indptr, indices = tri.neighbor_lists(radii, half=True, mask=mask)
    np.testing.assert_array_equal(np.diff(indptr), in_row.sum(axis=1))
    np.testing.assert_array_equal(indices, np.nonzero(in_row)[1])
    # More than there is room for at first.
    indptr, indices = tri.neighbor_lists(np.inf)
    assert len(indices) == n * (n - 1) == indptr[-1]
    with pytest.raises(deldrift.InvalidValue, match="squared_radius"):
        tri.neighbor_lists(-1)
    with pytest.raises(deldrift.WrongCount, match="squared_radius"):
        tri.neighbor_lists([1.0, 2.0])
    with pytest.raises(deldrift.WrongCount, match="mask"):
        tri.neighbor_lists(1, mask=[True])


def test_what_is_in_reach_of_boxes(tri, rng):
    low = rng.random((12, tri.ndim)) * 1.6 - 0.3
    high = low + rng.random((12, 1)) * 0.5
    high[0], low[1] = np.inf, -np.inf
    centres, squared_radii = tri.circumcentres()
    boundary = tri.boundary()
    mask = rng.random(tri.npoints) < 0.3
    offsets, vertices = tri.vertices_in_reach(low, high, mask)
    everywhere = set()
    for k in range(len(low)):
        # The places of all are random: none is at a distance of a last bit.
        apart = np.maximum(np.maximum(low[k] - centres, centres - high[k]), 0)
        simplices = np.flatnonzero((apart**2).sum(axis=1) <= squared_radii)
        reach = tri.simplices_in_reach(low[k], high[k])
        np.testing.assert_array_equal(reach.simplices, simplices)
        np.testing.assert_allclose(reach.centres, centres[simplices], rtol=1e-8)
        assert (reach.radii >= np.sqrt(squared_radii[simplices])).all()
        np.testing.assert_allclose(reach.radii, np.sqrt(squared_radii[simplices]), rtol=1e-7)
        corners = set(np.asarray(tri.simplices[simplices]).ravel())
        pairs = set(zip(reach.hull_simplices, reach.hull_corners))
        assert pairs <= set(zip(boundary.simplices, boundary.corners))
        for cell, corner in pairs:
            corners |= set(np.delete(tri.simplices[cell], corner))
        assert list(vertices[offsets[k] : offsets[k + 1]]) == sorted(v for v in corners if mask[v])
        everywhere |= set(simplices)
    together = tri.simplices_in_reach(low, high, mask)
    is_masked = mask[np.asarray(tri.simplices)].any(axis=1)
    assert list(together.simplices) == sorted(c for c in everywhere if is_masked[c])
    assert len(tri.simplices_in_reach(high[2], low[2]).simplices) == 0


def test_conflicts_are_what_an_insertion_removes(tri, rng):
    tri.changes()
    for place in rng.random((10, tri.ndim)):
        conflicts = tri.conflicts(place)
        centres, squared_radii = tri.circumcentres()
        is_in = ((centres - place) ** 2).sum(axis=1) < squared_radii
        np.testing.assert_array_equal(np.sort(conflicts), np.flatnonzero(is_in))
        rows = {tuple(sorted(row)) for row in tri.simplices[conflicts].tolist()}
        tri.insert(place)
        assert {tuple(sorted(row)) for row in tri.changes().removed_simplices.tolist()} == rows


def test_simplices_with_vertices(tri, rng):
    for width in range(1, tri.ndim + 2):
        chosen = rng.integers(0, 150, (300, width))
        chosen[:100] = rng.permuted(tri.simplices[rng.integers(0, tri.nsimplex, 100)], axis=1)[:, :width]
        found = tri.simplices_with(chosen)
        for row, cell in zip(chosen, found):
            there_are = np.isin(tri.simplices, row).sum(axis=1) == width
            is_proper = len(set(row.tolist())) == width
            assert (cell >= 0) == (is_proper and there_are.any())
            if cell >= 0:
                assert set(row) <= set(tri.simplices[cell])


def test_barycentric_coordinates(tri, rng):
    x = rng.random((20, 3, tri.ndim)) * 1.2
    weights, simplices = tri.barycentric(x), tri.find_simplex(x)
    inside = simplices >= 0
    assert weights.shape == (20, 3, tri.ndim + 1) and np.isnan(weights[~inside]).all()
    assert (weights[inside] >= 0).all()
    corners = tri.points[tri.simplices[simplices[inside]]]
    np.testing.assert_allclose((weights[inside][..., None] * corners).sum(axis=1), x[inside], rtol=1e-9)
    np.testing.assert_array_equal(tri.barycentric(x, simplices), weights)
    assert (tri.barycentric(x[~inside], np.zeros((~inside).sum(), int)) < 0).any(axis=1).all()


def test_flat_simplices_along_the_hull():
    side = np.linspace(0, 1, 30)
    points = np.concatenate([np.c_[side, 0.3 * side], np.c_[side, 0.3 * side + 1]])
    tri = deldrift.Delaunay(points)
    mask = tri.mask_without_flat(1e-9)
    assert tri.mask_without_flat(0).all() and not mask.all()
    assert tri.volumes()[mask].min() > 1e-3 > tri.volumes()[~mask].max()
    assert len(tri.boundary(mask).facets) == 60


def test_signs():
    assert [deldrift.orientation(p) for p in ([[0, 0], [1, 0], [0, 1]], [[0, 0], [0, 1], [1, 0]])] == [1, -1]
    assert deldrift.orientation(np.vstack([np.zeros(3), np.eye(3)])) == 1
    line = [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]
    exact = [[Fraction(x) for x in row] for row in line]
    (ax, ay), (bx, by), (cx, cy) = exact
    determinant = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    assert deldrift.orientation(line) == (determinant > 0) - (determinant < 0)
    circle = [[5, 0], [3, 4], [-3, 4]]
    assert [deldrift.in_sphere(circle + [p]) for p in ([-5, 0], [-5, 1e-300], [0, 0], [-5.0000001, 0])] == [
        0,
        -1,
        1,
        -1,
    ]


def test_tolerances_are_kept(tri, rng):
    tolerances = np.array([tri.tolerance(v) for v in range(tri.npoints)])
    before = tri.simplices.copy()
    steps = rng.standard_normal(tri.points.shape)
    steps *= 0.99 * tolerances.min() / np.linalg.norm(steps, axis=1)[:, None]
    tri.move(tri.points + steps)
    np.testing.assert_array_equal(tri.simplices, before)


def test_sizes(tri):
    assert tri.nvertices == 150
    assert tri.nbytes > 150 * tri.ndim * 8
    assert repr(tri) == f"<deldrift.Delaunay of 150 points in {tri.ndim}D, {tri.nsimplex} simplices>"


def test_everything_of_no_points(ndim, tmp_path):
    tri = deldrift.Delaunay(np.empty((0, ndim)))
    low, high = np.zeros(ndim), np.ones(ndim)
    for empty in (
        *(
            tri.volumes(),
            tri.edges(),
            *tri.boundary(),
            *tri.circumcentres(),
            tri.transform,
            tri.equations,
            tri.coplanar,
        ),
        *(tri.vertices_in_box(low, high), tri.vertices_in_ball(low, np.inf), tri.mask_without_flat(0), *tri.changes()),
        *(*tri.voronoi_cells((low, high)), *tri.voronoi_derivatives((low, high))),
        *(tri.alpha_mask(1), tri.mirror_indices(), tri.voronoi_volumes((low, high)), tri.voronoi_facets((low, high))),
        *(
            tri.simplices_with(np.empty((0, 2), int)),
            tri.simplices_around([]),
            tri.conflicts(low),
            tri.vertex_to_simplex,
        ),
    ):
        assert len(empty) == 0
    assert tri.vertex_neighbor_vertices[0].tolist() == tri.vertex_simplices()[0].tolist() == [0]
    assert tri.find_simplex(low) == tri.find_simplex(low, tol=1) == -1
    assert np.isnan(tri.interpolate([], [low])) and np.isnan(tri.barycentric([low])).all()
    assert tri.locate(low) == (3, -1)
    assert tri.nearest_vertices([low], k=2).tolist() == [[-1, -1]]
    assert tri.plane_distance(low).shape == (0,)
    tri.save(tmp_path / "nothing")
    assert deldrift.load(tmp_path / "nothing").ndim == ndim
    tri.validate()
    assert tri.move(np.empty((0, ndim))).moved == 0
