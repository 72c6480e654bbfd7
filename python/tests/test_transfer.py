"""Means in simplices that are brought over."""

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
