"""What scipy.spatial.Delaunay has, compared with scipy on points in general position, and with the definition."""

import collections
import itertools
import sys

import numpy as np
import pytest

import deldrift

spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def cells_by_vertices(tri):
    return {tuple(sorted(row)): k for k, row in enumerate(tri.simplices.tolist())}


@pytest.fixture
def both(rng, ndim):
    points = rng.standard_normal((300, ndim))
    return deldrift.Delaunay(points), spatial.Delaunay(points)


def test_simplices_are_those_of_scipy(both):
    ours, theirs = both
    assert as_sets(ours.simplices) == as_sets(theirs.simplices)
    assert ours.simplices.dtype == ours.neighbors.dtype == theirs.simplices.dtype
    assert (ours.ndim, ours.npoints, ours.nsimplex) == (theirs.ndim, theirs.npoints, theirs.nsimplex)
    np.testing.assert_array_equal(ours.points, theirs.points)
    np.testing.assert_array_equal(ours.min_bound, theirs.min_bound)
    np.testing.assert_array_equal(ours.max_bound, theirs.max_bound)


def test_every_public_name_of_scipy_is_there(both):
    ours, theirs = both
    assert [name for name in dir(theirs) if name[0] != "_" and not hasattr(ours, name)] in ([], ["vertices"])
    assert ours.furthest_site == theirs.furthest_site


def test_neighbours_are_opposite_corners(both):
    ours, theirs = both
    by_vertices = cells_by_vertices(theirs)
    for row, beside in zip(ours.simplices.tolist(), ours.neighbors.tolist()):
        k = by_vertices[tuple(sorted(row))]
        of_scipy = dict(zip(theirs.simplices[k].tolist(), theirs.neighbors[k].tolist()))
        for corner, neighbour in zip(row, beside):
            expected = of_scipy[corner]
            if expected < 0:
                assert neighbour == -1
            else:
                assert sorted(ours.simplices[neighbour]) == sorted(theirs.simplices[expected])


def test_orientation(both):
    ours, _ = both
    corners = ours.points[ours.simplices]
    assert (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0).all()


def test_convex_hull_is_that_of_scipy(both):
    ours, theirs = both
    assert as_sets(ours.convex_hull) == as_sets(theirs.convex_hull)
    assert ours.convex_hull.dtype == theirs.convex_hull.dtype


def test_neighbour_lists_are_those_of_scipy(both):
    ours, theirs = both
    (indptr, indices), (their_indptr, their_indices) = ours.vertex_neighbor_vertices, theirs.vertex_neighbor_vertices
    np.testing.assert_array_equal(indptr, their_indptr)
    for k in range(len(indptr) - 1):
        assert indices[indptr[k] : indptr[k + 1]].tolist() == sorted(their_indices[indptr[k] : indptr[k + 1]])


def test_transforms_are_those_of_scipy(both):
    ours, theirs = both
    assert ours.transform.shape == theirs.transform.shape
    x = ours.points.mean(axis=0)
    by_vertices = cells_by_vertices(theirs)
    for k, row in enumerate(ours.simplices.tolist()):
        other = by_vertices[tuple(sorted(row))]
        np.testing.assert_allclose(
            dict_of_weights(ours, k, x),
            dict_of_weights(theirs, other, x),
            rtol=1e-6,
            atol=1e-6 * weight_scale(ours, k, x),
        )


def dict_of_weights(tri, k, x):
    first = tri.transform[k, :-1] @ (x - tri.transform[k, -1])
    weights = np.append(first, 1 - first.sum())
    return weights[np.argsort(tri.simplices[k])]


def weight_scale(tri, k, x):
    return np.abs(tri.transform[k, :-1] @ (x - tri.transform[k, -1])).max()


def test_hyperplanes_and_the_paraboloid_are_those_of_scipy(both, rng):
    ours, theirs = both
    x = rng.standard_normal((4, 5, ours.ndim))
    assert ours.paraboloid_scale == pytest.approx(theirs.paraboloid_scale, rel=1e-12)
    assert ours.paraboloid_shift == pytest.approx(theirs.paraboloid_shift, rel=1e-12)
    np.testing.assert_allclose(ours.lift_points(x), theirs.lift_points(x), rtol=1e-12, atol=1e-12)
    by_vertices = cells_by_vertices(theirs)
    order = [by_vertices[tuple(sorted(row))] for row in ours.simplices.tolist()]
    assert ours.equations.shape == theirs.equations.shape
    np.testing.assert_allclose(ours.equations, theirs.equations[order], rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(ours.plane_distance(x), theirs.plane_distance(x)[..., order], rtol=1e-5, atol=1e-6)


def test_places_are_found_where_scipy_finds_them(both, rng):
    ours, theirs = both
    x = 2 * rng.standard_normal((50, 4, ours.ndim))
    found, expected = ours.find_simplex(x), theirs.find_simplex(x)
    assert found.shape == expected.shape and found.dtype == expected.dtype
    np.testing.assert_array_equal(found < 0, expected < 0)
    inside = found >= 0
    np.testing.assert_array_equal(np.sort(ours.simplices[found[inside]]), np.sort(theirs.simplices[expected[inside]]))
    np.testing.assert_array_equal(deldrift.tsearch(ours, x), found)
    np.testing.assert_array_equal(ours.find_simplex(x, bruteforce=True), found)
    assert ours.find_simplex(x[0, 0]).shape == theirs.find_simplex(x[0, 0]).shape == ()


def test_vertices_are_found_in_a_simplex_of_theirs(both):
    ours, _ = both
    found = ours.find_simplex(ours.points)
    assert (ours.simplices[found] == np.arange(ours.npoints)[:, None]).any(axis=1).all()


def test_tolerance_of_find_simplex_takes_what_is_just_outside():
    tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
    outside = [2, -1e-9]
    assert tri.find_simplex(outside) == -1
    assert tri.find_simplex(outside, tol=0) == -1
    assert set(tri.simplices[tri.find_simplex(outside, tol=1e-6)]) >= {0, 1}
    assert tri.find_simplex([2, -1], tol=1e-6) == -1


def test_simplex_of_each_vertex(both):
    ours, _ = both
    assert ours.vertex_to_simplex.dtype == np.int32
    assert (ours.simplices[ours.vertex_to_simplex] == np.arange(ours.npoints)[:, None]).any(axis=1).all()


def test_points_at_one_place_are_coplanar(rng, ndim):
    points = rng.random((20, ndim))
    ours = deldrift.Delaunay(np.concatenate([points, points[5:]]))
    theirs = spatial.Delaunay(np.concatenate([points, points[5:]]))
    assert ours.coplanar.dtype == theirs.coplanar.dtype
    np.testing.assert_array_equal(ours.coplanar[:, 0], np.arange(20, 35))
    np.testing.assert_array_equal(ours.coplanar[:, 2], np.arange(5, 20))
    assert (ours.simplices[ours.coplanar[:, 1]] == ours.coplanar[:, 2:]).any(axis=1).all()
    assert len(theirs.coplanar) == len(ours.coplanar)
    assert (ours.vertex_to_simplex >= 0).all()
    assert ours.find_simplex(points).min() >= 0


def test_square_as_sets():
    # scipy's test_2d_square, test_find_simplex and test_convex_hull, without its order of rows and its diagonal.
    tri = deldrift.Delaunay([(0, 0), (0, 1), (1, 1), (1, 0)])
    assert as_sets(tri.simplices) in ({(1, 2, 3), (0, 1, 3)}, {(0, 1, 2), (0, 2, 3)})
    assert sorted(tri.neighbors.ravel()) == [-1, -1, -1, -1, 0, 1]
    assert as_sets(tri.convex_hull) == {(2, 3), (1, 2), (0, 1), (0, 3)}
    for p in [(0.25, 0.5), (0.75, 0.25), (0.3, 0.2)]:
        corners = tri.points[tri.simplices[tri.find_simplex(p)]]
        weights = np.linalg.solve(np.vstack([corners.T, np.ones(3)]), [*p, 1])
        assert (weights >= 0).all()


def test_add_points_as_scipy_does(rng, ndim):
    points = rng.random((80, ndim))
    ours = deldrift.Delaunay(points[:40], incremental=True)
    ours.add_points(points[40:60])
    ours.add_points(points[60:], restart=True)
    assert as_sets(ours.simplices) == as_sets(spatial.Delaunay(points).simplices)
    ours.close()
    with pytest.raises(deldrift.Closed):
        ours.add_points(points)
    with pytest.raises(RuntimeError):
        ours.move(points)
    assert len(ours.simplices) == ours.nsimplex


def test_flat_points_have_no_simplices(ndim):
    tri = deldrift.Delaunay(np.repeat([[0.0], [1.0], [2.0], [3.0], [3.0]], ndim, axis=1))
    assert tri.simplices.shape == (0, ndim + 1) and tri.neighbors.shape == (0, ndim + 1)
    assert tri.transform.shape == (0, ndim + 1, ndim)
    assert tri.equations.shape == (0, ndim + 2)
    assert tri.convex_hull.shape == (0, ndim)
    np.testing.assert_array_equal(tri.coplanar, [[4, -1, 3]])
    assert tri.find_simplex(np.zeros(ndim)) == -1


def test_no_points_at_all(ndim):
    tri = deldrift.Delaunay(np.empty((0, ndim)))
    assert (tri.npoints, tri.nsimplex, len(tri.coplanar)) == (0, 0, 0)
    assert np.isnan(tri.min_bound).all()
    tri.add_points(np.vstack([np.zeros(ndim), np.eye(ndim)]))
    assert tri.nsimplex == 1


def facets_in_order(rows):
    return [facet for row in rows.tolist() for facet in itertools.combinations(row, len(row) - 1)]


def test_sorted_simplices_have_facets_in_one_order(rng, ndim):
    """What programs rely on that compare facets as tuples, as with scipy's rows in space."""
    tri = deldrift.Delaunay(rng.random((300, ndim)))
    rows = tri.simplices_sorted
    assert rows.dtype == np.int32 and not rows.flags.writeable and rows is tri.simplices_sorted
    np.testing.assert_array_equal(rows, np.sort(tri.simplices, axis=1))
    facets = collections.Counter(facets_in_order(rows))
    assert set(facets.values()) == {1, 2}
    once = {facet for facet, count in facets.items() if count == 1}
    assert once == {tuple(sorted(facet)) for facet in tri.convex_hull.tolist()}
    tri.move(tri.points[::-1])
    np.testing.assert_array_equal(tri.simplices_sorted, np.sort(tri.simplices, axis=1))


def test_scipys_rows_of_tetrahedra_are_in_one_order(rng):
    """What the page says of scipy: there is an order of vertices that all rows have, and so facets are in one order."""
    spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")
    rows = spatial.Delaunay(rng.random((300, 3))).simplices
    before = {(a, b) for row in rows.tolist() for a, b in itertools.combinations(row, 2)}
    assert not any((b, a) in before for a, b in before)
    ours = deldrift.Delaunay(rng.random((300, 3))).simplices
    before = {(a, b) for row in ours.tolist() for a, b in itertools.combinations(row, 2)}
    assert any((b, a) in before for a, b in before)


def surface(rows, points, alpha):
    """The facets of an alpha shape as PyPI's alphashape finds them: those that have been seen once, as tuples."""
    seen, once = set(), set()
    for row in rows.tolist():
        corners = points[row]
        spans = corners[1:] - corners[0]
        centre = np.linalg.solve(2 * spans, (spans**2).sum(axis=1))
        if np.sqrt((centre**2).sum()) < 1 / alpha:
            for facet in itertools.combinations(row, 3):
                once ^= {facet} if facet not in seen else once & {facet}
                seen.add(facet)
    return once


def test_alpha_shapes_of_sorted_simplices(rng):
    points, alpha = rng.random((300, 3)), 3.0
    tri = deldrift.Delaunay(points)
    wanted = {tuple(sorted(facet)) for facet in tri.boundary(tri.alpha_mask(1 / alpha**2)).facets.tolist()}
    assert surface(tri.simplices_sorted, points, alpha) == wanted
    assert len(surface(tri.simplices, points, alpha)) > 5 * len(wanted)
    module = pytest.importorskip("alphashape.alphashape", reason="alphashape is not installed")
    pytest.importorskip("trimesh", reason="trimesh is not installed")
    module = sys.modules["alphashape.alphashape"]

    class Sorted(deldrift.Delaunay):
        simplices = deldrift.Delaunay.simplices_sorted

    before = module.alphashape(points, alpha)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "Delaunay", Sorted)
        after = module.alphashape(points, alpha)
    assert len(after.faces) == len(before.faces) == len(wanted)
    assert {tuple(sorted(face)) for face in after.faces.tolist()} == {tuple(sorted(face)) for face in before.faces.tolist()}
