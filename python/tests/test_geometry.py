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


def test_places_and_nearest_vertices(tri, rng):
    x = rng.random((40, tri.ndim)) * 1.4 - 0.2
    kinds, indices = tri.locate(x)
    np.testing.assert_array_equal(kinds == 1, tri.find_simplex(x) >= 0)
    np.testing.assert_array_equal(tri.locate(tri.points)[0], np.zeros(tri.npoints))
    np.testing.assert_array_equal(tri.locate(tri.points)[1], np.arange(tri.npoints))
    for place in x:
        assert tri.nearest_vertex(place) == np.argmin(((tri.points - place) ** 2).sum(axis=1))
    assert deldrift.Delaunay(np.empty((0, tri.ndim))).nearest_vertex(x[0]) == -1


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
