"""Refinement: areas in fractions, angles, values that are carried over, regions that stay what they are."""

import pickle

import numpy as np
import pytest

import deldrift
import exact_segments as exact

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]
HOLE = [[1, 1], [2, 1], [2, 2], [1, 2]]
SIDES = [[k - k % 4 + i, k - k % 4 + (i + 1) % 4] for k in (0, 4) for i in range(4)]


def doubled_areas(points, triangles):
    places = exact.fractions_of(points)
    return [exact.cross(*(places[v] for v in row)) for row in triangles.tolist()]


def least_angle(points, triangles):
    corners = points[triangles]
    least = 180.0
    for i in range(3):
        u, w = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        angles = np.arctan2(u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0], (u * w).sum(axis=1))
        least = min(least, np.degrees(angles.min()))
    return least


@pytest.mark.parametrize("copied", [lambda mesh: mesh, deldrift.Mesh.copy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_a_mesh_has_the_quality_and_keeps_its_regions(copied):
    mesh = deldrift.Mesh(SQUARE + HOLE, SIDES, range(8), holes=[], regions=[[1.5, 1.5, 5], [3, 3, 7]])
    linear = mesh.points @ [2.0, -1.0] + 3
    report = mesh.refine(least_angle=30, areas={5: 0.01, 7: 0.1}, values={"f": linear, "x": mesh.points})
    assert report.inserted == len(mesh.points) - 8 > 100 and report.bad_cells == 0
    mesh = copied(mesh)
    doubled = np.array(doubled_areas(mesh.points, mesh.triangles))
    for label, most, whole in (5, 0.01, 1), (7, 0.1, 15):
        assert max(doubled[mesh.labels == label]) <= 2 * most and sum(doubled[mesh.labels == label]) == 2 * whole
    assert least_angle(mesh.points, mesh.triangles) >= 30 - 1e-9
    np.testing.assert_allclose(report.values["f"], mesh.points @ [2.0, -1.0] + 3, rtol=0, atol=1e-12)
    np.testing.assert_allclose(report.values["x"], mesh.points, rtol=0, atol=1e-12)
    markers = mesh.segments.markers
    assert len(mesh.delaunay.made_vertices().vertices) == report.inserted
    assert (mesh.delaunay.original_segments() == markers).all()
    assert mesh.coarsen(least_angle=20, areas={5: 0.1, 7: 0.5}).removed > 50
    assert set(mesh.labels) == {5, 7}


def deepest_in_circles(tri):
    """The most that a corner of the domain is inside the circle around a segment beside it."""
    inside = tri.nesting_levels() % 2 == 1
    corners, at = tri.points[tri.simplices[inside]], tri.segments_of_cells()[inside] >= 0
    dots = [((corners[:, k - 1] - corners[:, k]) * (corners[:, k - 2] - corners[:, k])).sum(axis=1) for k in range(3)]
    return max(-dots[k][at[:, k]].min() for k in range(3))


def test_all_triangles_are_delaunay_on_request():
    tri = deldrift.Delaunay(SQUARE + HOLE, segments=SIDES)
    assert deepest_in_circles(tri) > 0
    report = tri.refine(is_conforming=True)
    assert report.inserted == report.on_segments > 0 and deepest_in_circles(tri) <= 0
    assert tri.refine(is_conforming=True, greatest_area=0.1).inserted > 50 and deepest_in_circles(tri) <= 0
    assert tri.coarsen(is_conforming=True, greatest_area=2).removed > 50 and deepest_in_circles(tri) <= 0
    mesh = deldrift.Mesh.from_triangle({"vertices": SQUARE + HOLE, "segments": SIDES}, "pq20D")
    assert len(mesh.points) > 8 and deepest_in_circles(mesh.delaunay) <= 0


def test_an_exception_leaves_all_as_it_was():
    tri = deldrift.Delaunay(SQUARE + HOLE, segments=SIDES)
    before, left, handle = tri.tobytes(), [20], tri._handle

    def is_too_large(corners):
        left[0] -= 1
        return bool(1 / left[0])

    with pytest.raises(ZeroDivisionError):
        tri.refine(is_too_large=is_too_large, greatest_area=0.1)
    assert tri.tobytes() == before and tri.npoints == 8 and tri._handle is handle
    report = tri.refine(is_too_large=lambda corners: np.ptp(corners[:, 0]) > 0.5, sizes=2.0)
    inside = tri.nesting_levels() % 2 == 1
    assert report.inserted > 10 and np.ptp(tri.points[tri.simplices[inside]][..., 0], axis=1).max() <= 0.5


def test_switches_of_triangle():
    data = {"vertices": SQUARE + HOLE, "segments": SIDES, "holes": [[1.5, 1.5]], "regions": [[3, 3, 7, 0.05]]}
    whole = deldrift.Mesh.from_triangle(data, "pq30a0.1")
    assert max(doubled_areas(whole.points, whole.triangles)) <= 0.2
    assert sum(doubled_areas(whole.points, whole.triangles)) == 30
    by_region = deldrift.Mesh.from_triangle(data, "paYY")
    assert len(by_region.segments.ids) == 8 and len(by_region.triangles) > 100
    assert len(deldrift.Mesh.from_triangle(data, "pq30a0.1S5").points) == 13


def test_ids_are_given_again_and_values_follow():
    tri = deldrift.Delaunay(SQUARE + HOLE, segments=SIDES)
    values = {"f": tri.points @ [2.0, -1.0] + 3, "x": tri.points}
    most = 0
    for turn in range(5):
        before = tri.npoints
        report = tri.refine(greatest_area=0.05, reuse_ids=True, sizes=5.0, values=values)
        values, ids, there = report.values, tri.refined_vertices(), ~np.isnan(tri.points[:, 0])
        assert len(ids) == report.inserted > 50 and len(values["f"]) == len(report.sizes) == tri.npoints
        assert (ids == tri.refined_weights().ids).all() and (ids[0] < before) == (turn > 0)
        np.testing.assert_allclose(values["f"][there], (tri.points @ [2.0, -1.0] + 3)[there], rtol=0, atol=1e-12)
        np.testing.assert_allclose(values["x"][there], tri.points[there], rtol=0, atol=1e-12)
        np.testing.assert_allclose(report.sizes, 5, rtol=1e-12)
        most = max(most, tri.nvertices)
        assert tri.coarsen(greatest_area=0.5).removed > 50 and len(tri.refined_vertices()) == 0
        # Values from before both, whether the mesh is made anew or not.
        values = tri.refine(greatest_area=0.5, reuse_ids=True, values=values).values
        there = ~np.isnan(tri.points[:, 0])
        np.testing.assert_allclose(values["x"][there], tri.points[there], rtol=0, atol=1e-12)
    assert tri.npoints <= 1.25 * most
    new_ids, kept = tri.compact(values={**values, "id": np.arange(tri.npoints)})
    assert tri.npoints == tri.nvertices == len(kept["x"]) and kept["id"].dtype == np.arange(1).dtype
    assert (new_ids[kept["id"]] == np.arange(tri.npoints)).all()
    np.testing.assert_allclose(kept["x"], tri.points, rtol=0, atol=1e-12)
    mesh = deldrift.Mesh(SQUARE, SIDES[:4])
    assert mesh.refine(greatest_area=0.5, reuse_ids=True).inserted > 10
