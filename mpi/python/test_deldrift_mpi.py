"""Run by mpiexec on some processes: what they have together is what one process has of all points."""

import ctypes
import sys

import numpy as np
from mpi4py import MPI

import deldrift_mpi
from deldrift_mpi import Delaunay, DeldriftMpiError

comm = MPI.COMM_WORLD


def serial_cells(points, ids):
    """Cells of one triangulation of all points, as a set of sorted rows of ids."""
    library = deldrift_mpi._library
    handle, count, dimension = ctypes.c_void_p(), ctypes.c_size_t(), points.shape[1]
    points, ids = np.ascontiguousarray(points), np.ascontiguousarray(ids)
    create = library.deldrift_create_with_keys
    pointer = ctypes.c_void_p
    create.argtypes = [ctypes.c_uint32, pointer, pointer, ctypes.c_size_t, pointer, pointer]
    assert create(dimension, points.ctypes.data, ids.ctypes.data, len(ids), None, ctypes.byref(handle)) == 0
    library.deldrift_copy_cells(handle, None, None, 0, ctypes.byref(count))
    cells = np.empty((count.value, dimension + 1), np.uint32)
    library.deldrift_copy_cells(handle, cells.ctypes.data, None, len(cells), ctypes.byref(count))
    library.deldrift_destroy.argtypes = [ctypes.c_void_p]
    library.deldrift_destroy(handle)
    return sorted(tuple(sorted(row)) for row in ids[cells].tolist())


def is_serial(tri):
    points, ids = np.concatenate(comm.allgather(tri.points)), np.concatenate(comm.allgather(tri.ids))
    rows = [tuple(sorted(row)) for part in comm.allgather(tri.cells().tolist()) for row in part]
    return sorted(rows) == serial_cells(points, ids)


def refusal(call, *arguments):
    try:
        call(*arguments)
    except DeldriftMpiError as error:
        return error
    raise AssertionError("the call has not failed")


def history(dimension):
    rng = np.random.default_rng(comm.rank + 10 * dimension)
    points = rng.integers(0, 6, (150, dimension)) if dimension == 2 else rng.random((150, dimension))
    tri = Delaunay(comm, points)
    assert is_serial(tri) and tri.timestamp == 0 and len(tri) == 150
    known = {tuple(sorted(row)) for row in tri.take_changes()[0].tolist()}
    for step in range(4):
        tri.stage_insertions(rng.random((3, dimension)), 10**6 + 1000 * comm.rank + 3 * step + np.arange(3))
        tri.stage_removals([step, step + 5])
        report = tri.commit(tri.points + 0.01 * rng.random((len(tri), dimension)))
        assert report.timestamp == step + 1 == tri.timestamp and is_serial(tri) and report.is_spanning == 1
        created, removed, is_anew, *shifts = tri.take_changes()
        assert not is_anew and shifts == [None, None]
        known -= {tuple(sorted(row)) for row in removed.tolist()}
        known |= {tuple(sorted(row)) for row in created.tolist()}
        assert known == {tuple(sorted(row)) for row in tri.cells().tolist()}
    marks = tri.ids * np.uint64(3)
    moved = tri.migrate(tri.partition(), np.stack([marks, marks], axis=1))
    assert (moved == np.stack([tri.ids * np.uint64(3)] * 2, axis=1)).all() and is_serial(tri)
    sizes = comm.allgather(len(tri))
    assert max(sizes) - min(sizes) <= max(sizes) // 3, sizes
    values = np.where((tri.owners == comm.rank)[:, None], tri.local_points, -1.0)
    exchanged, present = tri.exchange(values), tri.owners >= 0
    assert (exchanged[present] == tri.local_points[present]).all()
    facets = comm.allreduce(len(tri.hull_facets()))
    assert facets >= dimension + 1
    assert (tri.local_ids[tri.local_cells[tri.own_cells]] == tri.cells()).all()
    before = tri.points
    wrong = before.copy()
    if comm.rank == comm.size - 1:
        wrong[0] = np.nan
    error = refusal(tri.commit, wrong)
    assert error.process == comm.size - 1 and f"process {comm.size - 1}: positions" in str(error)
    assert (tri.points == before).all() and is_serial(tri)
    assert refusal(tri.commit, before[:, :1] if comm.rank == 0 else before).process == 0
    tri.destroy()


def named(ids, shifts):
    """Cells by their corners in the order of ids and shifts, the first in period 0."""
    names = set()
    for row, multiples in zip(ids.tolist(), shifts.tolist()):
        corners = sorted(zip(row, map(tuple, multiples)))
        first = corners[0][1]
        names.add(tuple((v, tuple(n - m for n, m in zip(shift, first))) for v, shift in corners))
    assert len(names) == len(ids)
    return names


def follow(tri, known, is_anew):
    """Own cells before, without those that have gone, and with those that have come, are those now."""
    changes = tri.take_changes()
    created, removed = named(changes.created, changes.created_shifts), named(changes.removed, changes.removed_shifts)
    known = set() if is_anew else known
    assert changes.is_anew == is_anew and removed <= known and not created & known
    known = known - removed | created
    assert known == named(tri.cells(), tri.cell_shifts())
    return known


def in_a_box(dimension):
    """Cells fill the box, as the sum of their volumes says, while vertices leave it."""
    rng = np.random.default_rng(comm.rank)
    vectors = np.eye(dimension) + np.tri(dimension, k=-1) / 4
    given = rng.random((30, dimension)) @ vectors
    tri = Delaunay(comm, given, vectors=vectors)
    assert tri.report.is_rebuilt == 1
    known = follow(tri, set(), True)
    for step in range(4):
        given += 0.2 * rng.random(given.shape)
        if step == 1:
            vectors = vectors * 1.25 ** (1 / dimension)
            assert tri.report.is_rebuilt == 0 and tri.commit(given, vectors=vectors).timestamp == step + 1
        tri.commit(given)
        if step == 2:
            given = tri.migrate(tri.partition(), given)
        known = follow(tri, known, step == 2)
        positions = {i: x for part in comm.allgather(list(zip(tri.ids.tolist(), given))) for i, x in part}
        cells, shifts = tri.cells(), tri.cell_shifts()
        corners = np.array([[positions[i] for i in row] for row in cells.tolist()]).reshape(shifts.shape)
        corners = corners + shifts @ vectors
        volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() if len(cells) else 0.0
        volume = comm.allreduce(volume) / (2 if dimension == 2 else 6)
        assert abs(volume - abs(np.linalg.det(vectors))) < 1e-9, volume
        n_cells = comm.allreduce(len(cells))
        assert dimension == 3 or n_cells == 2 * len(positions), n_cells
        values = np.zeros(tri.local_points.shape)
        values[tri.vertices] = given
        values = tri.exchange(values) + tri.periods() @ vectors
        assert np.abs((values - tri.local_points)[tri.owners >= 0]).max() < 1e-9
    tri.destroy()
    assert refusal(lambda: Delaunay(comm, given, vectors=np.ones((2, dimension)))).process == 0


def has_hidden(places, weights, vectors=None):
    """Which of some points one process hides by weight."""
    tri = deldrift_mpi.Delaunay(MPI.COMM_SELF, places, weights=weights, vectors=vectors)
    hidden = set(tri.hidden_by_weight.tolist())
    tri.destroy()
    return hidden


def with_weights(dimension, vectors):
    """What processes hide together is what one process hides, while weights and places change."""
    rng = np.random.default_rng(comm.rank + 3)
    points, weights = rng.random((60, dimension)), 0.1 * rng.random(60)
    tri = Delaunay(comm, points, weights=weights, vectors=vectors)
    for step in range(6):
        assert (tri.weights == weights).all()
        hidden = np.zeros(len(tri), bool)
        hidden[tri.hidden_by_weight] = True
        everywhere = [np.concatenate(comm.allgather(part)) for part in (points, weights, tri.ids, hidden)]
        order = np.argsort(everywhere[2])
        places, of_all, _, are_hidden = (part[order] for part in everywhere)
        assert set(np.flatnonzero(are_hidden)) == has_hidden(places, of_all, vectors) and 0 < are_hidden.sum() < len(order)
        if step % 3 == 0:
            weights = weights + 0.002 * rng.random(len(tri))
            tri.commit(weights=weights)
        elif step % 3 == 1:
            points = points + 0.02 * rng.random(points.shape)
            tri.stage_insertions(rng.random((2, dimension)), 10**6 + 10 * step + 100 * comm.rank + np.arange(2), [0.01, 0.02])
            tri.commit(points, weights=weights)
            weights, points = tri.weights, np.concatenate([points, tri.points[-2:]])
            assert weights[-2:].tolist() == [0.01, 0.02]
        else:
            both = tri.migrate(tri.partition(), np.column_stack([points, weights]))
            points, weights = both[:, :dimension], both[:, dimension]
    wrong = weights.copy()
    if comm.rank == comm.size - 1:
        wrong[0] = np.inf
    error = refusal(lambda: tri.commit(weights=wrong))
    assert error.process == comm.size - 1 and "weights: entry 0 is inf" in str(error)
    assert refusal(lambda: tri.commit(points, weights=weights[1:])).status == refusal(tri.commit, points[1:]).status
    tri.destroy()


history(2)
history(3)
for dimension in (2, 3):
    with_weights(dimension, None)
    with_weights(dimension, np.eye(dimension))
in_a_box(2)
in_a_box(3)
empty = Delaunay(comm, np.random.default_rng(1).random((40, 2)) if comm.rank == 0 else np.empty((0, 2)))
assert is_serial(empty)
assert refusal(Delaunay, comm, np.zeros(3)).process == 0
empty.destroy()
print(f"process {comm.rank} of {comm.size}: passed")
sys.stdout.flush()
