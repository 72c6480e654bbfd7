"""Periodic triangulations, beside scipy's of copies."""

import copy
import itertools
import pickle

import deldrift
import numpy as np
import pytest
from scipy.spatial import Delaunay as OfScipy

BOXES = {
    "square": np.eye(2),
    "skewed": np.array([[1.0, 0.0], [5.25, 0.75]]),
    "cube": np.eye(3),
    "triclinic": np.array([[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]]),
    "flat": np.diag([1.0, 3.0, 0.7]),
}


def reduced(vectors):
    """The copies of a skewed box are near each other only in a reduced basis."""
    rows = vectors.copy()
    for k in range(1, len(rows)):
        rows[k] -= np.round(rows[k] @ rows[0] / (rows[0] @ rows[0])) * rows[0]
    return rows


def classes(simplices, shifts, vectors):
    """The cells as sets of corners, relative to that of the lowest id, and of several of this the first by coordinates."""
    found = set()
    for row, shift in zip(simplices.tolist(), np.asarray(shifts)):
        places = (shift @ vectors).tolist()
        first = shift[min(range(len(row)), key=lambda i: (row[i], places[i]))]
        found.add(frozenset((v, *(s - first)) for v, s in zip(row, shift.tolist())))
    return found


def of_copies(points, vectors):
    """What scipy finds around the middle one of copies."""
    basis = reduced(vectors)
    multiples = np.round(np.linalg.solve(vectors.T, basis.T)).astype(int).T
    homes = np.floor(points @ np.linalg.inv(basis)).astype(int)
    counts = list(itertools.product(range(-2, 3), repeat=len(basis)))
    places = np.concatenate([points + (np.array(c) - homes) @ basis for c in counts])
    shifts = np.concatenate([(np.array(c) - homes) @ multiples for c in counts])
    middle = np.concatenate([np.full(len(points), not any(c)) for c in counts])
    simplices = OfScipy(places).simplices
    simplices = simplices[middle[simplices].any(axis=1)]
    return classes(simplices % len(points), shifts[simplices], vectors)


@pytest.mark.parametrize("name", ["square", "triclinic"])
def test_what_is_kept_by_the_changes_is_what_there_is(name):
    vectors, rng = BOXES[name], np.random.default_rng(3)
    points = rng.random((30, len(vectors))) @ vectors
    tri = deldrift.PeriodicDelaunay(points, vectors)
    kept = {}
    for step in range(6):
        changes = tri.changes()
        for cell, row in zip(changes.removed.tolist(), changes.removed_simplices.tolist()):
            assert sorted(row) == sorted(kept.pop(cell))
        moved = [kept.pop(cell) for cell in changes.renumbered_from.tolist()]
        kept.update(zip(changes.renumbered_to.tolist(), moved))
        for cell in changes.created.tolist():
            assert cell not in kept
            kept[cell] = tri.simplices[cell].tolist()
        assert len(kept) == tri.nsimplex
        assert all(sorted(kept[cell]) == sorted(row) for cell, row in enumerate(tri.simplices.tolist()))
        assert step == 0 or 0 < len(changes.created) < tri.nsimplex
        points += rng.normal(scale=0.01, size=points.shape)
        if step == 3:
            tri.remove([4])
        tri.move(points)


@pytest.mark.parametrize("name", BOXES)
def test_points_are_taken_into_the_box(name):
    vectors, rng = BOXES[name], np.random.default_rng(3)
    tri = deldrift.PeriodicDelaunay(np.empty((0, len(vectors))), vectors)
    shortest, multiples = tri.reduced_vectors()
    assert (shortest == multiples @ tri.vectors).all() and abs(round(np.linalg.det(multiples))) == 1
    points = rng.normal(scale=9, size=(50, len(vectors)))
    places, shifts = tri.wrap(points)
    assert np.abs(places + shifts @ vectors - points).max() < 1e-12
    inside = places @ np.linalg.inv(shortest)
    assert inside.min() > -1e-9 and inside.max() < 1 + 1e-9
    # Near a side vertices stay where they have been.
    moved, shifts = tri.wrap(places + 0.1 * shortest[0], previous=places)
    assert not shifts.any() and np.abs(moved - places - 0.1 * shortest[0]).max() < 1e-12
    with pytest.raises(deldrift.WrongCount, match="1 rows of previous for 50 points"):
        tri.wrap(points, previous=points[:1])


@pytest.mark.parametrize("name", BOXES)
def test_cells_are_those_of_copies_when_points_move(name):
    vectors, rng, n = BOXES[name], np.random.default_rng(7), 25
    points = rng.random((n, len(vectors))) @ vectors + rng.integers(-3, 4, (n, len(vectors))) @ vectors
    tri = deldrift.PeriodicDelaunay(points, vectors)
    for step in range(4):
        assert np.abs(tri.points - points).max() < 1e-12
        assert classes(tri.simplices, tri.shifts, vectors) == of_copies(points, vectors)
        assert tri.voronoi_volumes().sum() == pytest.approx(abs(np.linalg.det(vectors)), rel=1e-12)
        edges = tri.corners[:, 1:] - tri.corners[:, :1]
        assert (np.linalg.det(edges) > 0).all()
        if step == 2:
            points = points @ np.linalg.solve(vectors, 1.125 * vectors)
            vectors = 1.125 * vectors
            tri.move(points, vectors=vectors)
        else:
            points = points + rng.normal(scale=0.05, size=points.shape)
            points -= np.floor(points @ np.linalg.inv(vectors)) @ vectors
            assert tri.move(points).moved == n
    assert tri.timestamp == 4


def test_neighbours_share_facets_across_the_box(rng):
    tri = deldrift.PeriodicDelaunay(rng.random((30, 2)), [1, 1])
    n = tri.ndim + 1
    for cell, corner in itertools.product(range(tri.nsimplex), range(n)):
        other = tri.neighbors[cell, corner]
        here = {(tri.simplices[cell, i], *tri.shifts[cell, i]) for i in range(n) if i != corner}
        moved = tri.shifts[other] + tri.neighbor_shifts[cell, corner]
        assert here < {(v, *s) for v, s in zip(tri.simplices[other], moved)}
    edges, shifts = tri.edges()
    assert len(edges) == tri.nvertices + tri.nsimplex == 90 and shifts.shape == (90, 2)


@pytest.mark.parametrize("name", BOXES)
def test_voronoi_cells_are_those_of_copies(name):
    vectors, rng, n = BOXES[name], np.random.default_rng(11), 12
    basis = reduced(vectors)
    points = rng.random((n, len(vectors))) @ basis
    tri = deldrift.PeriodicDelaunay(points, vectors)
    counts = list(itertools.product(range(-2, 3), repeat=len(basis)))
    copies = deldrift.Delaunay(np.concatenate([points + np.array(c) @ basis for c in counts]))
    reach = np.abs(basis).sum(axis=0) * 4
    middle = slice(n * (len(counts) // 2), n * (len(counts) // 2 + 1))
    cells, expected = tri.voronoi_cells(), copies.voronoi_cells((-reach, reach))
    for found, wanted in zip(cells, expected):
        assert np.abs(found - wanted[middle]).max() < 1e-11
    assert (cells.volumes == tri.voronoi_volumes()).all()
    far = deldrift.PeriodicDelaunay(points + [9, -4, 2][: len(basis)] @ vectors, vectors)
    assert np.abs(far.voronoi_cells().centroids - far.points - cells.centroids + points).max() < 1e-11


def test_facets_close_cells_and_derivatives_are_those_of_differences(rng):
    vectors, n = BOXES["triclinic"], 5
    points = rng.random((n, 3)) @ vectors
    tri = deldrift.PeriodicDelaunay(points, vectors)
    (edges, shifts), facets, cells = tri.edges(), tri.voronoi_derivatives(), tri.voronoi_cells()
    assert (facets.measures == tri.voronoi_facets()).all()
    ways = points[edges[:, 1]] + shifts @ vectors - points[edges[:, 0]]
    lengths = np.linalg.norm(ways, axis=1)
    areas, volumes = np.zeros(n), np.zeros(n)
    for end in edges.T:
        np.add.at(areas, end, facets.measures)
        np.add.at(volumes, end, facets.measures * lengths / 6)
    assert np.abs(areas - cells.areas).max() < 1e-11 and np.abs(volumes - cells.volumes).max() < 1e-12
    # Between the two ends of an edge, as far from one as from the other.
    some = facets.measures > 1e-9
    middles = facets.centroids - points[edges[:, 0]] - ways / 2
    assert np.abs((middles * ways).sum(axis=1)[some]).max() < 1e-11
    by = np.zeros((n, n, 3))
    for (i, j), (of_i, of_j) in zip(edges.tolist(), facets.derivatives):
        if i != j:
            by[i, j] += of_i
            by[j, j] -= of_i
            by[j, i] += of_j
            by[i, i] -= of_j
    step = 1e-5
    for j, axis in itertools.product(range(n), range(3)):
        moved = []
        for sign in (-1, 1):
            there = points.copy()
            there[j, axis] += sign * step
            moved.append(deldrift.PeriodicDelaunay(there, vectors).voronoi_volumes())
        assert np.abs((moved[1] - moved[0]) / (2 * step) - by[:, j, axis]).max() < 1e-4
    mask = np.arange(n) == 2
    for some in (None, mask):
        both = tri.voronoi_cells_and_facets(some)
        for told, wanted in zip(both, (tri.voronoi_cells(some), tri.voronoi_derivatives(some))):
            assert all(np.array_equal(a, b, equal_nan=True) for a, b in zip(told, wanted))
    masked = tri.voronoi_derivatives(mask)
    assert (np.isfinite(masked.measures) == (edges == 2).any(axis=1)).all()
    assert (np.isnan(tri.voronoi_cells(mask).volumes) == ~mask).all()
    with pytest.raises(deldrift.WrongCount, match="mask has 4 entries"):
        tri.voronoi_cells(mask[1:])


@pytest.mark.parametrize("name", BOXES)
def test_simplices_have_the_sizes_and_balls_of_their_corners(name, rng):
    vectors = BOXES[name]
    points = (3 * rng.random((15, len(vectors))) - 1) @ vectors
    tri = deldrift.PeriodicDelaunay(points, vectors)
    ways = tri.corners[:, 1:] - tri.corners[:, :1]
    volumes, (centres, squared) = tri.volumes(), tri.circumcentres()
    factor = 2 if tri.ndim == 2 else 6
    assert np.abs(volumes - np.linalg.det(ways) / factor).max() < 1e-12
    assert volumes.sum() == pytest.approx(abs(np.linalg.det(vectors)), rel=1e-12)
    expected = np.linalg.solve(2 * ways, (ways**2).sum(axis=2)[..., None])[..., 0]
    assert np.abs(centres - tri.corners[:, 0] - expected).max() < 1e-9
    assert np.abs(squared - (expected**2).sum(axis=1)).max() < 1e-9 * squared.max()
    limit = float(np.sort(squared)[len(squared) // 2 - 1 :][:2].mean())
    mask = tri.alpha_mask(limit)
    assert (mask == (squared <= limit)).all() and 0 < mask.sum() < len(mask)
    found = tri.boundary(mask)
    around = [(c, k) for c in np.flatnonzero(mask) for k in range(tri.ndim + 1) if not mask[tri.neighbors[c, k]]]
    assert list(zip(found.simplices.tolist(), found.corners.tolist())) == around
    assert len(tri.boundary().simplices) == 0
    kept = [volumes.copy(), centres.copy(), squared.copy(), mask.copy()]
    for array in kept:
        array[3] = 0
    tri.update_volumes([3], kept[0])
    tri.update_circumcentres([3], kept[1], kept[2])
    tri.update_alpha_mask([3], limit, kept[3])
    assert all((now == before).all() for now, before in zip(kept, [volumes, centres, squared, mask]))


@pytest.mark.parametrize("name", BOXES)
def test_places_are_in_the_cells_where_they_are_told_to_be(name, rng):
    vectors = BOXES[name]
    tri = deldrift.PeriodicDelaunay(rng.random((20, len(vectors))) @ vectors, vectors)
    xi = rng.random((3, 10, tri.ndim)) @ vectors + rng.integers(-3, 4, (3, 10, tri.ndim)) @ vectors
    kinds, cells, shifts = tri.locate(xi)
    assert (kinds == 1).all() and kinds.shape == cells.shape == (3, 10) and shifts.shape == (3, 10, tri.ndim)
    corners = tri.corners[cells] + (shifts @ tri.vectors)[..., None, :]
    weights = tri.barycentric(xi, cells)
    assert (weights >= 0).all() and np.abs(np.einsum("...i,...ik->...k", weights, corners) - xi).max() < 1e-12
    assert (tri.barycentric(xi) == weights).all()
    values = rng.random((20, 2))
    wanted = np.einsum("...i,...ik->...k", weights, values[tri.simplices[cells]])
    assert np.abs(tri.interpolate(values, xi) - wanted).max() < 1e-9
    # Beside the nearest of all images.
    multiples = np.array(list(itertools.product(range(-8, 9), repeat=tri.ndim)))
    multiples = multiples[np.linalg.norm(multiples @ vectors, axis=1) < 4 * np.linalg.norm(vectors, axis=1).max()]
    ways = (xi.reshape(-1, 1, tri.ndim) - tri.points) @ np.linalg.inv(vectors)
    ways = (ways - np.round(ways)) @ vectors
    squares = np.min([((ways + k @ vectors) ** 2).sum(axis=-1) for k in multiples], axis=0)
    assert (tri.nearest_vertices(xi.reshape(-1, tri.ndim), k=20) == np.argsort(squares, axis=1)).all()
    assert (tri.nearest_vertices(xi).ravel() == np.argmin(squares, axis=1)).all()
    for place, row, way in zip(xi.reshape(-1, tri.ndim), squares, ways):
        assert tri.vertices_in_ball(place, 0.2).tolist() == np.flatnonzero(row <= 0.2).tolist()
        there = way + (multiples @ vectors)[:, None]
        among = ((there >= -0.2) & (there <= 0.3)).all(axis=-1).any(axis=0)
        assert tri.vertices_in_box(place - 0.3, place + 0.2).tolist() == np.flatnonzero(among).tolist()


def test_neighbor_lists():
    rng = np.random.default_rng(5)
    vectors = np.array([[1, 0, 0], [0.5, 1, 0], [0.25, -0.25, 1]])
    tri = deldrift.PeriodicDelaunay(rng.random((12, 3)), vectors)
    points = tri.points
    multiples = np.array(list(itertools.product(range(-4, 5), repeat=3)))
    for limit in (0.05, 1.5):
        indptr, indices, shifts = tri.neighbor_lists(limit)
        half = tri.neighbor_lists(limit, half=True)
        assert 2 * len(half[1]) == len(indices)
        for k in range(12):
            ways = points[:, None] + multiples @ vectors - points[k]
            near = (ways**2).sum(axis=2) <= limit
            near[k, len(multiples) // 2] = False
            wanted = {(w, *multiples[m]) for w, m in zip(*np.nonzero(near))}
            row = slice(indptr[k], indptr[k + 1])
            assert sorted(wanted) == [(w, *s) for w, s in zip(indices[row], shifts[row])]
    with pytest.raises(deldrift.InvalidValue, match="squared_radius"):
        tri.neighbor_lists(np.inf)


def test_places_at_vertices_and_outside():
    tri = deldrift.PeriodicDelaunay([[0.25, 0.5], [0.5, 0.75], [0.75, 0.5]], [[1.0, 0.0]])
    kinds, indices, shifts = tri.locate([[-2.75, 0.5], [7.5, 0.75], [0.5, 2.0]])
    assert (kinds.tolist(), indices[:2].tolist(), shifts[:2].tolist()) == ([0, 0, 2], [0, 1], [[-3], [7]])
    assert np.isnan(tri.barycentric([0.5, 2.0])).all() and np.isnan(tri.interpolate([1, 2, 3], [0.5, 2.0]))
    assert tri.interpolate([1, 2, 3], [7.5, 0.75]) == 2 and tri.barycentric([7.5, 0.75]).max() == 1
    with pytest.raises(deldrift.NotFinite, match=r"xi\[0\], coordinate 1, is NaN"):
        tri.locate([0.5, np.nan])
    assert tri.interpolate([1, 2, 3], [7.5, 0.75], method="natural") == 2
    assert np.isnan(tri.interpolate([1, 2, 3], [0.5, 2.0], method="natural"))
    with pytest.raises(deldrift.Error, match="point is outside the convex hull of a triangulation that is periodic"):
        tri.conflicts([0.5, 2.0])
    assert tri.conflicts([7.5, 0.75]).tolist() == []


def test_natural_neighbours_and_conflicts():
    rng = np.random.default_rng(9)
    vectors = np.array([[1.0, 0.0], [0.25, 1.0]])
    points = rng.random((40, 2)) @ vectors
    values = rng.random(40)
    tri = deldrift.PeriodicDelaunay(points, vectors)
    shifts = np.array([[i, j] for i in range(-2, 3) for j in range(-2, 3)])
    copies = deldrift.Delaunay((points[None] + (shifts @ vectors)[:, None]).reshape(-1, 2))
    xi = rng.random((30, 2)) @ vectors
    expected = copies.interpolate(np.tile(values, len(shifts)), xi, method="natural")
    assert np.allclose(tri.interpolate(values, xi + [3.25, 1.0], method="natural"), expected, rtol=0, atol=1e-11)
    for place in xi:
        found = tri.simplices[tri.conflicts(place - vectors[0])] % 40
        there = copies.simplices[copies.conflicts(place)] % 40
        assert sorted(map(sorted, found.tolist())) == sorted(map(sorted, there.tolist()))
    tri.changes()
    before = tri.voronoi_cells()
    tri.move([points[7] + 0.001], ids=[7])
    tri.changes()
    changed, after = tri.voronoi_changed([7]), tri.voronoi_cells()
    assert changed[7] and not changed.all() and np.allclose(before.volumes[~changed], after.volumes[~changed], rtol=0, atol=1e-14)


def test_walls():
    inf, rng = np.inf, np.random.default_rng(5)
    points = rng.random((200, 3)) * [1, 1, 0.5]
    slab = deldrift.PeriodicDelaunay(points, [[1, 0, 0], [0.25, 1, 0]])
    box = ([-inf, -inf, -0.125], [inf, inf, 0.25])
    cells = slab.voronoi_cells(box=box)
    assert abs(cells.volumes.sum() - 0.375) < 1e-12 and (cells.volumes == slab.voronoi_volumes(box)).all()
    inside = cells.volumes > 0
    assert (np.abs(cells.centroids[inside, 2] - 0.0625) <= 0.1875).all() and np.isnan(cells.centroids[~inside]).all()
    planes = [[0, 0, 2, 0.5], [0, 0, -1, 0.125]]
    assert np.allclose(slab.voronoi_cells(half_spaces=planes).volumes, cells.volumes, rtol=0, atol=1e-12)
    facets = slab.voronoi_derivatives(box=box)
    assert (facets.measures == slab.voronoi_facets(box)).all()
    assert np.allclose(slab.voronoi_derivatives(half_spaces=planes).derivatives, facets.derivatives, rtol=0, atol=1e-10)
    edges, shifts = slab.edges()
    lengths = np.linalg.norm(points[edges[:, 1]] + shifts @ slab.vectors - points[edges[:, 0]], axis=1)
    # Pyramids over facets, and over what cells have of the walls.
    of_walls = cells.areas.sum() - 2 * facets.measures.sum()
    assert abs(of_walls - 2) < 1e-10 and (facets.measures * lengths).sum() / 3 < 0.375
    with pytest.raises(deldrift.InvalidValue, match=r"low\[0\] is 0, but must be -infinity"):
        slab.voronoi_volumes(([0, -inf, 0], [inf, inf, 1]))
    with pytest.raises(deldrift.InvalidValue, match=r"half_spaces\[1\] is 0.5, but must be 0"):
        slab.voronoi_cells(box=box, half_spaces=[[0, 0, 1, 1], [0.5, 0, 1, 1]])


def test_one_point_and_a_slab():
    tri = deldrift.PeriodicDelaunay([[0.5, 0.5]], [1, 1])
    assert tri.nsimplex == 2 and tri.voronoi_volumes() == [1]
    slab = deldrift.PeriodicDelaunay([[0.5, 0.5], [0.25, 0.75], [0.0, 0.5]], [[1.0, 0.0]])
    assert slab.vectors.shape == (1, 2) and slab.shifts.shape[2] == 1 and (slab.neighbors == -1).any()
    assert np.isinf(slab.voronoi_volumes()).all()
    cells, facets = slab.voronoi_cells(), slab.voronoi_derivatives()
    assert np.isinf(cells.areas).all() and np.isnan(cells.centroids).all()
    assert len(slab.boundary().simplices) == (slab.neighbors == -1).sum()
    ends = np.isinf(facets.measures)
    assert ends.any() and np.isnan(facets.derivatives[ends]).all() and np.isfinite(facets.derivatives[~ends]).all()


def test_points_come_and_go():
    tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7]], [1, 1])
    assert tri.insert([[2.5, 0.25], [0.25, 0.5]]).tolist() == [2, 3]
    assert (tri.nvertices, tri.nsimplex) == (4, 8)
    tri.remove([0])
    assert (tri.nvertices, tri.nsimplex) == (3, 6) and np.isnan(tri.points[0]).all()
    assert tri.move([[0.5, 0.5]], ids=[3]).moved == 1
    assert "3 points in 2D" in repr(tri) and tri.nbytes > 0 and tri.report.timestamp == 3
    points = tri.points
    assert tri.compact().tolist() == [-1, 0, 1, 2] and (tri.points == points[1:]).all() and tri.nsimplex == 6


def test_what_is_wrong_is_told_and_changes_nothing():
    tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7]], [1, 1])
    with pytest.raises(deldrift.InvalidValue, match=r"vectors\[1\] is not independent"):
        deldrift.PeriodicDelaunay([[0.1, 0.1]], [[1, 2], [2, 4]])
    with pytest.raises(deldrift.NotFinite, match=r"points\[1\], coordinate 0, is NaN"):
        tri.move([[0.1, 0.1], [np.nan, 0.7]])
    with pytest.raises(deldrift.WrongCount):
        tri.move([[0.1, 0.1]])
    with pytest.raises(deldrift.WrongCount, match="vector_count is 1, but must be 2"):
        tri.move(vectors=[[1, 0]])
    with pytest.raises(deldrift.NoSuchVertex, match=r"ids\[0\] is 7"):
        tri.move([[0.1, 0.1]], ids=[7])
    assert tri.timestamp == 0 and tri.move([[0.2, 0.1], [0.6, 0.7]]).timestamp == 1


def same(tri, other):
    """Whether all that is read of one is read of the other."""
    names = "simplices", "neighbors", "shifts", "neighbor_shifts", "points", "vectors", "timestamp", "nvertices"
    return all(np.array_equal(getattr(tri, n), getattr(other, n), equal_nan=n == "points") for n in names)


def saved(tri, tmp_path):
    tri.save(tmp_path / "box")
    return deldrift.PeriodicDelaunay.load(tmp_path / "box")


AGAIN = {
    "copy": lambda t, _: copy.copy(t),
    "deepcopy": lambda t, _: copy.deepcopy(t),
    "pickle": lambda t, _: pickle.loads(pickle.dumps(t)),
    "bytes": lambda t, _: deldrift.PeriodicDelaunay.frombytes(t.tobytes()),
    "file": saved,
}


@pytest.mark.parametrize("name", AGAIN)
def test_what_is_kept_goes_on(name, rng, tmp_path):
    vectors = BOXES["triclinic"]
    tri = deldrift.PeriodicDelaunay(rng.random((20, 3)) @ vectors, vectors, algorithm="repair")
    tri.remove([3])
    tri.move(tri.points + rng.normal(scale=0.1, size=(20, 3)))
    other = AGAIN[name](tri, tmp_path)
    assert type(other) is deldrift.PeriodicDelaunay and same(tri, other)
    points = tri.points + rng.normal(scale=0.1, size=(20, 3))
    before = tri.points
    other.move(points, vectors=1.25 * vectors)
    assert np.array_equal(tri.points, before, equal_nan=True) and tri.timestamp == 2
    tri.move(points, vectors=1.25 * vectors)
    assert classes(tri.simplices, tri.shifts, tri.vectors) == classes(other.simplices, other.shifts, other.vectors)
    other.validate()


def test_kinds_of_files_are_told_apart(rng, tmp_path):
    tri, flat = deldrift.PeriodicDelaunay(rng.random((5, 2)), [1, 1]), deldrift.Delaunay(rng.random((5, 2)))
    with pytest.raises(deldrift.InvalidData, match="PeriodicDelaunay.frombytes"):
        deldrift.frombytes(tri.tobytes())
    with pytest.raises(deldrift.InvalidData, match="deldrift.load"):
        deldrift.PeriodicDelaunay.frombytes(flat.tobytes())
    data = bytearray(tri.tobytes())
    data[200] ^= 1
    with pytest.raises(deldrift.InvalidData, match="checksum"):
        deldrift.PeriodicDelaunay.frombytes(data)


def test_what_meets(rng):
    points = rng.random((12, 2))
    points[7] = points[2] + [1, -2]
    tri = deldrift.PeriodicDelaunay(points, [1, 1])
    assert tri.coplanar[:, [0, 2]].tolist() == [[7, 2]]
    edges, _ = tri.edges()
    indptr, indices = tri.vertex_neighbor_vertices
    offsets, cells = tri.vertex_simplices()
    for v in range(12):
        ends = np.concatenate([edges[edges[:, 0] == v, 1], edges[edges[:, 1] == v, 0]])
        assert indices[indptr[v] : indptr[v + 1]].tolist() == sorted(ends.tolist())
        row = np.repeat(np.arange(tri.nsimplex), (tri.simplices == v).sum(axis=1)).tolist()
        assert cells[offsets[v] : offsets[v + 1]].tolist() == row == (row if v == 7 else tri.star(v).tolist())
        assert tri.simplices_around([v]).tolist() == sorted(set(row))
        assert tri.vertex_to_simplex[v] == tri.star(v)[0]
    assert tri.star(7).tolist() == tri.star(2).tolist()
    mirrors = tri.mirror_indices()
    for cell, corner in itertools.product(range(tri.nsimplex), range(3)):
        assert tri.neighbors[tri.neighbors[cell, corner], mirrors[cell, corner]] == cell
    tri.validate()


def test_files_of_other_programs(rng, tmp_path):
    meshio = pytest.importorskip("meshio")
    tri = deldrift.PeriodicDelaunay(rng.random((10, 2)), [1, 1])
    heat = np.arange(10.0)
    tri.write_vtu(tmp_path / "a.vtu", {"heat": heat}, {"number": np.arange(tri.nsimplex)})
    tri.write_medit(tmp_path / "a.mesh", np.arange(tri.nsimplex))
    for name in "a.vtu", "a.mesh":
        mesh = meshio.read(tmp_path / name)
        assert (mesh.points[:, :2][mesh.cells[0].data] == tri.corners).all()
        ids = mesh.point_data["vertex" if name == "a.vtu" else "medit:ref"].ravel()
        assert (ids[mesh.cells[0].data] == tri.simplices).all() and len(ids) > 10
    mesh = meshio.read(tmp_path / "a.vtu")
    assert (mesh.point_data["heat"].ravel() == heat[mesh.point_data["vertex"].ravel()]).all()
    with pytest.raises(deldrift.WrongCount):
        tri.write_vtu(tmp_path / "a.vtu", {"heat": heat[1:]})


def test_steps_are_tried():
    """What a trial withdraws has never been; what it keeps is one timestamp."""
    points = np.random.default_rng(3).random((60, 2))
    tri = deldrift.PeriodicDelaunay(points, [1, 1])
    before = tri.tobytes()
    with pytest.raises(RuntimeError):
        with tri.trial():
            tri.move(points + 0.01)
            tri.insert([[0.5, 0.5]])
            assert tri.nvertices == 61 and tri.timestamp == 0
            raise RuntimeError
    assert tri.tobytes() == before
    with tri.trial() as trial:
        tri.move(points[:5] + 0.02, ids=range(5), vectors=[[1, 0], [0.25, 1]])
        trial.withdraw()
        assert tri.nvertices == 60 and tri.vectors[1, 0] == 0
        tri.move(points + 0.03)
        with pytest.raises(deldrift.Prepared):
            tri.changes()
        with pytest.raises(deldrift.WrongCount):
            tri.move(points[:7])
        with pytest.raises(deldrift.NotFinite):
            tri.insert([[np.nan, 0]])
        tri.remove([7])
    assert tri.timestamp == 1 and tri.nvertices == 59 and np.allclose(tri.points[:7], points[:7] + 0.03)
    kept = np.delete(points, 7, axis=0) + 0.03
    assert tri.nsimplex == deldrift.PeriodicDelaunay(kept, [1, 1]).nsimplex
    assert np.isclose(np.nansum(tri.voronoi_volumes()), 1)


def test_tolerances_and_flat_cells(rng):
    points = rng.random((40, 2))
    t = deldrift.PeriodicDelaunay(points, np.eye(2))
    least = min(t.tolerance(v) for v in range(40))
    before = t.simplices.tolist()
    t.move(points + rng.uniform(-0.7, 0.7, points.shape) * least)
    assert sorted(map(sorted, t.simplices.tolist())) == sorted(map(sorted, before))
    assert t.mask_without_flat(1e-9).all()
    edges = np.array([[t.simplices[0][0], t.simplices[0][1]], [0, 1]])
    for edge, simplex in zip(edges, t.simplices_with(edges)):
        assert (simplex >= 0) == any(set(edge) <= set(row) for row in t.simplices.tolist())
    strip = deldrift.PeriodicDelaunay([[0, 0], [0.3, 1e-13], [0.6, 0], [0.5, 1]], [[1, 0]])
    assert not strip.mask_without_flat(1e-9).all() and strip.mask_without_flat(0).all()
