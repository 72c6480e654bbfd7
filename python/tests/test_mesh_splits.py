"""Meshes of segments that cross, overlap, have no length or are repeated: against fractions, polygons and Triangle."""

import pickle
from fractions import Fraction

import numpy as np
import pytest

import deldrift
import exact_segments as exact
import polygons

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]
SIDES = [[0, 1], [1, 2], [2, 3], [3, 0]]


def places_of(seed):
    """Some points, on a grid that has them twice as well, or anywhere."""
    rng = np.random.default_rng(seed)
    return rng, rng.integers(0, 5, (12, 2)).astype(float) if seed % 2 else rng.random((12, 2))


def not_degenerate(points, ends):
    """Indices of the segments that have a length, and are the first ones between their places."""
    places, seen, kept = exact.fractions_of(points), set(), []
    for k, row in enumerate(ends.tolist()):
        pair = frozenset(places[v] for v in row)
        if len(pair) == 2 and pair not in seen:
            seen.add(pair)
            kept.append(k)
    return kept


def crossing_of(a, b, c, d):
    """Where two segments cross, rounded correctly."""
    part = exact.cross(c, d, a) / (exact.cross(c, d, a) - exact.cross(c, d, b))
    return tuple(float(a[k] + part * (b[k] - a[k])) for k in range(2))


@pytest.mark.parametrize("seed", range(40))
def test_segments_are_split_and_degenerate_ones_dropped(seed):
    rng, points = places_of(seed)
    ends = rng.integers(0, len(points), (10, 2))
    ends = np.concatenate([ends, ends[:2, ::-1], ends[3:4]])
    kept = not_degenerate(points, ends)
    mesh = deldrift.Mesh(points, ends, np.arange(len(ends)), split=True, degenerate="drop")
    places = exact.fractions_of(mesh.points)
    laid = dict(zip(mesh.segments.ids.tolist(), map(tuple, mesh.segments.ends.tolist())))
    assert exact.conflicts_of(places, laid) == [] and set(mesh.segments.markers.tolist()) == set(kept)
    assert (mesh.points[: len(points)] == points).all()
    mesh.delaunay.validate(3)
    # Pieces go along what was given, from end to end.
    along = {k: [] for k in kept}
    for row, marker in zip(mesh.segments.ends.tolist(), mesh.segments.markers.tolist()):
        along[marker].append(row)
    for k, rows in along.items():
        chain = [rows[0][0], *(row[1] for row in rows)]
        assert [row[0] for row in rows] == chain[:-1] and [chain[0], chain[-1]] == ends[k].tolist()
        along[k] = [places[v] for v in chain]
    # The same as with steps, and one round has all crossings at their places.
    tri = deldrift.Delaunay(points)
    with tri.step() as step:
        step.add_segments(ends[kept])
        rounds = step.split().rounds
    assert (tri.points == mesh.points).all() and (tri.segments.ends == mesh.segments.ends).all()
    for i, k in enumerate(kept if rounds == 1 else []):
        one = [places[v] for v in ends[k].tolist()]
        for j in kept[:i]:
            other = [places[v] for v in ends[j].tolist()]
            if exact.do_cross(*one, *other):
                crossing = tuple(map(Fraction, crossing_of(*one, *other)))
                assert crossing in along[k] and crossing in along[j]


@pytest.mark.parametrize("seed", range(12))
def test_the_domain_of_a_polygon_that_crosses_itself(seed):
    rng = np.random.default_rng(seed)
    corners = rng.random((4 + seed, 2))
    sides = [[k, (k + 1) % len(corners)] for k in range(len(corners))]
    mesh = deldrift.Mesh(corners, sides, keep="even-odd", split=True)
    inside = polygons.around([corners], mesh.points, mesh.delaunay.simplices)[:, 0]
    # Rounding of crossings has slivers beside segments, of which the centroid may be on either side.
    area = mesh.delaunay.volumes()
    assert (mesh.mask == inside)[area > 1e-13].all() and inside.sum() > 0


def marked(mesh, seeds):
    """The labels that seeds give simplices, 0 for none."""
    return mesh.delaunay.label_cells(seeds, np.arange(1, len(seeds) + 1))[mesh.mask]


@pytest.mark.parametrize("copied", [lambda mesh: mesh, deldrift.Mesh.copy, lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_regions_between_lines_that_cross_follow(copied):
    """All four regions are at pieces of the same two segments."""
    lines = [[0, 2], [1, 3]]
    seeds = np.array([[2.0, 1], [3, 2], [2, 3], [1, 2]])
    regions = np.column_stack([seeds, [1, 2, 3, 4]])
    mesh = copied(deldrift.Mesh(SQUARE, SIDES + lines, regions=regions, split=True))
    assert mesh.points.tolist()[4:] == [[2, 2]] and sorted(mesh.labels.tolist()) == [1, 2, 3, 4]
    rng, turn = np.random.default_rng(3), np.array([[0.5, 1.5], [-2, 1]])
    for k in range(6):
        mesh.refine(least_angle=25, greatest_area=[0.1, 0.5, 0.02][k % 3])
        mesh = copied(mesh)
        assert (mesh.labels == marked(mesh, seeds)).all() and set(mesh.labels.tolist()) == {1, 2, 3, 4}
        shift = rng.integers(-8, 8, 2)
        seeds = seeds @ turn + shift
        mesh.move(mesh.points @ turn + shift)
        assert (mesh.labels == marked(mesh, seeds)).all()
        mesh.coarsen(least_angle=20, greatest_area=1)
        assert (mesh.labels == marked(mesh, seeds)).all() and set(mesh.labels.tolist()) == {1, 2, 3, 4}
    again = deldrift.Mesh.from_triangle(mesh.to_dict())
    assert len(again.triangles) == len(mesh.triangles)


def test_a_hole_at_a_vertex_that_hides_others():
    """The piece beside a hole is found again where its first end is at the place of another vertex, and refined."""
    inner = [[1, 1], [3, 1], [3, 3], [1, 3], [1, 1]]
    around = [[8, 5], [5, 6], [6, 7], [7, 8]]
    mesh = deldrift.Mesh(SQUARE + inner, SIDES + around, holes=[[2, 2]], split=True)
    sides = mesh.delaunay.segments.ends.tolist()
    assert [8, 5] in sides and len(mesh.mask) - mesh.mask.sum() == 2
    mesh.refine(greatest_area=0.01)
    assert len(mesh.segments.ids) > 100
    hole = deldrift.Mesh(mesh.points, mesh.segments.ends, holes=[[2, 2]])
    triangles = [{frozenset(row) for row in one.triangles.tolist()} for one in (hole, mesh)]
    assert triangles[0] == triangles[1] and not mesh.mask.all()


def test_moves_split_nothing():
    mesh = deldrift.Mesh([*SQUARE, [1, 1], [2, 2]], [*SIDES, [0, 2], [1, 3]], split=True)
    assert len(mesh.points) == 6 and len(mesh.segments.ids) == 4 + 3 + 2
    before = mesh.delaunay.tobytes()
    with pytest.raises(deldrift.ConflictError):
        mesh.move([[3, 3]], ids=[4])
    assert mesh.delaunay.tobytes() == before
    with mesh.delaunay.step() as step:
        step.move([[3, 3]], ids=[4])
        step.split()
    assert len(mesh.triangles) == len(mesh.delaunay.simplices)


@pytest.mark.parametrize("markers", [None, 7, [7, 1, 2, 3, 4, 5, 6, 7, 8]])
def test_what_is_dropped(markers):
    points = [*SQUARE, [-0.0, 0.0], [4, 0]]
    ends = [[0, 1], [1, 1], [1, 2], [2, 1], [2, 3], [3, 0], [3, 4], [5, 1], [0, 4]]
    mesh = deldrift.Mesh(points, ends, markers, degenerate="drop")
    assert mesh.segments.ids.tolist() == [0, 1, 2, 3]
    assert mesh.segments.ends.tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert mesh.segments.markers.tolist() == ([7, 2, 4, 5] if markers and markers != 7 else [markers or 0] * 4)
    for wrong in [1, 1], [0, 4]:
        with pytest.raises(deldrift.ConflictError) as caught:
            deldrift.Mesh(points, [*SIDES, wrong], split=True)
        assert caught.value.kind is deldrift.ConflictKind.ENDS_MEET
    assert len(deldrift.Mesh(points, [*SIDES, [1, 0]]).segments.ids) == 5
    assert len(deldrift.Mesh(points, [[0, 0]], degenerate="drop").segments.ids) == 0
    assert len(deldrift.Mesh(points, [], degenerate="drop", split=True).triangles) == 0


@pytest.mark.parametrize("seed", range(6))
def test_lines_that_cross_as_in_triangle(seed):
    triangle = pytest.importorskip("triangle", reason="triangle is not installed")
    rng = np.random.default_rng(seed)
    ends = np.arange(4, 16).reshape(-1, 2)
    data = {"vertices": np.concatenate([SQUARE, rng.uniform(0, 4, (12, 2))]), "segments": np.concatenate([SIDES, ends])}
    theirs, ours = triangle.triangulate(data, "p"), deldrift.Mesh.from_triangle(data, split=True)
    assert len(ours.triangles) == len(theirs["triangles"]) and len(ours.points) == len(theirs["vertices"]) > 16
    assert len(ours.segments.ids) == len(theirs["segments"])
    order = [rows[np.lexsort(rows.round(9).T)] for rows in (ours.points, theirs["vertices"])]
    np.testing.assert_allclose(*order, rtol=0, atol=1e-14)
