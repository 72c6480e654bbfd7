"""Means in simplices that are brought over."""

import pickle

import numpy as np
import pytest

import deldrift


def content(tri, values):
    return values.T @ tri.volumes()


@pytest.mark.parametrize("ndim", [2, 3])
@pytest.mark.parametrize("order", [1, 2])
def test_content_stays_while_vertices_come_and_go(rng, ndim, order):
    corners = np.array(np.meshgrid(*[[0.0, 1.0]] * ndim)).reshape(ndim, -1).T
    tri = deldrift.Delaunay(np.concatenate([corners, 0.1 + 0.8 * rng.random((60, ndim))]))
    tri.changes()
    values = np.column_stack([np.full(tri.nsimplex, 0.1), rng.random(tri.nsimplex)])
    for _ in range(8):
        points = np.array(tri.points)
        points[len(corners) :] += 1e-3 * (rng.random((len(points) - len(corners), ndim)) - 0.5)
        tri.move(np.where(np.isnan(points), 0.5, points))
        was, before = content(tri, values) if not tri.changes().created.size else None, np.array(tri.points)
        if was is None:
            values = np.column_stack([np.full(tri.nsimplex, 0.1), rng.random(tri.nsimplex)])
            was = content(tri, values)
        tri.remove(int(rng.choice([v for v in range(len(corners), len(before)) if not np.isnan(before[v, 0])])))
        tri.insert(0.1 + 0.8 * rng.random(ndim))
        tri.changes()
        transfer = tri.transfer_cells(values, before, order=order)
        least, greatest = values[:, 1].min(), values[:, 1].max()
        values = transfer.values
        assert values.shape == (tri.nsimplex, 2) and (values[:, 0] == 0.1).all()
        assert least <= values[:, 1].min() <= values[:, 1].max() <= greatest
        assert content(tri, values) == pytest.approx(was, abs=1e-12)
        assert np.abs([transfer.lost, transfer.gained]).max() < 1e-12 and not transfer.turned_over


def test_rows_of_numbers_keep_their_shape(rng):
    tri = deldrift.Delaunay(rng.random((30, 2)))
    tri.changes()
    flow = rng.random((tri.nsimplex, 2, 3))
    before = tri.points
    tri.remove(4)
    with pytest.raises(deldrift.ChangesNotTaken):
        tri.transfer_cells(flow, before)
    tri.changes()
    transfer = tri.transfer_cells(flow, before)
    assert transfer.values.shape == (tri.nsimplex, 2, 3) and transfer.lost.shape == (2, 3)
    one = tri.transfer_cells(flow[:, 1, 2], before)
    assert (one.values == transfer.values[:, 1, 2]).all() and one.lost.shape == ()
    with pytest.raises(deldrift.RemovedVertex):
        tri.transfer_cells(flow)
    with pytest.raises(deldrift.WrongCount):
        tri.transfer_cells(flow[1:], before)


def test_nothing_is_lost_in_boxes(rng):
    box = deldrift.PeriodicDelaunay(rng.random((40, 2)), vectors=[1, 1])
    box.changes()
    dye = rng.random(box.nsimplex)
    was = np.array(box.points) + 0.3 * rng.random((40, 2))
    box.move(was)
    box.changes()
    transfer = box.transfer_cells(dye)
    assert abs(transfer.lost_volume) <= transfer.volume_error and abs(transfer.gained_volume) <= transfer.volume_error
    assert (box.transfer_cells(np.full(len(dye), 0.1), was).values == 0.1).all()


def stirred(points, angle):
    """Points that turn around the middle of a square with a side of 2, the less the nearer they are to its sides."""
    x, y = points.T
    angles = angle * np.clip(2 * (0.9 - np.maximum(abs(x), abs(y))), 0, 1)
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([c * x - s * y, s * x + c * y], axis=1)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("has_hole", [False, True])
@pytest.mark.parametrize("reuse_ids", [False, True])
def test_a_mesh_carries_means_through_its_steps(rng, order, has_hole, reuse_ids):
    ring = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
    square = np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])
    holes = {"holes": [[0, 0]]} if has_hole else {}
    quality = dict(least_angle=25, greatest_area=0.02)
    vertices, segments = square, ring
    if has_hole:
        vertices, segments = np.concatenate([square, 0.3 * square]), np.concatenate([ring, ring + 4])
    mesh = deldrift.Mesh(vertices, segments, **holes)
    with pytest.raises(deldrift.ChangesNotTaken):
        mesh.transfer_cells(np.ones(len(mesh.triangles)))
    mesh.refine(**quality)
    mesh.changes()
    with pytest.raises(deldrift.ChangesNotTaken):
        mesh.transfer_cells(np.ones(len(mesh.triangles)))
    values = np.column_stack([np.full(len(mesh.triangles), 0.1), rng.random(len(mesh.triangles))])
    n_changed = 0
    for step in range(20):
        goals, least, greatest = stirred(mesh.points, 0.03), values.min(), values.max()
        content = values[:, 1] @ areas_of(goals, mesh.triangles)
        mesh.move(goals)
        mesh.coarsen(**quality)
        if reuse_ids:
            n_changed += len(mesh.changes().created)
            values, goals = mesh.transfer_cells(values, goals, order=order).values, mesh.points
        mesh.refine(**quality, reuse_ids=reuse_ids)
        n_changed += len(mesh.changes().created)
        with pytest.raises(deldrift.WrongCount):
            mesh.transfer_cells(values[1:], goals)
        transfer = mesh.transfer_cells(values, goals, order=order)
        assert transfer.values.shape == (len(mesh.triangles), 2) and (transfer.values[:, 0] == 0.1).all()
        values = transfer.values
        assert least <= values.min() <= values.max() <= greatest or transfer.turned_over
        assert values[:, 1] @ areas_of(mesh.points, mesh.triangles) == pytest.approx(content, abs=1e-8)
        assert max(abs(transfer.lost).max(), abs(transfer.gained).max(), transfer.lost_volume) < 1e-8
        one = mesh.transfer_cells(np.full(len(mesh._before.triangles), 0.1), goals).values
        assert one.shape == (len(mesh.triangles),) and (one == 0.1).all()
    assert n_changed > 200
    # What has been taken is the triangulation's own.
    for copy in mesh.copy(), pickle.loads(pickle.dumps(mesh)):
        copy.changes()
        with pytest.raises(deldrift.ChangesNotTaken):
            copy.transfer_cells(values)
        copy.coarsen(greatest_area=0.05)
        was = values[:, 1] @ areas_of(mesh.points, mesh.triangles)
        copy.changes()
        made = copy.transfer_cells(values, mesh.points).values
        assert len(made) < len(values) and made[:, 1] @ areas_of(copy.points, copy.triangles) == pytest.approx(was, abs=1e-8)


def areas_of(points, triangles):
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    (x, y), (z, w) = (b - a).T, (c - a).T
    return (x * w - y * z) / 2
