"""The mesh of a domain: against Triangle, polygons, and meshes from nothing."""

import copy
import pickle

import numpy as np
import pytest

import deldrift
import exact_segments as exact
import polygons


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def machine(rng, number=60):
    """A disc with a hole that can turn in it, an island in the hole, and points between: rings and free points."""
    rings = [
        polygons.ring(rng, [0, 0], 3, 20),
        polygons.ring(rng, [0.2, 0], 1.2, 9),
        polygons.ring(rng, [0.2, 0], 0.5, 6),
    ]
    return rings, polygons.sprinkled(rng, rings, number)


def turned(points, angle, centre=(0.2, 0.0)):
    c, s = np.cos(angle), np.sin(angle)
    return (points - centre) @ np.array([[c, s], [-s, c]]) + centre


def with_free(rng, rings, free, **options):
    """A mesh of rings, and of those of some points that are on none of its segments."""
    vertices, segments, markers = polygons.joined(rings)
    return deldrift.Mesh(np.concatenate([vertices, free]), segments, markers, **options), len(vertices)


@pytest.mark.parametrize("seed", range(8))
def test_a_turning_hole_as_in_triangle(seed):
    """Holes and regions are given once; Triangle is told at each step where they are."""
    triangle = pytest.importorskip("triangle", reason="triangle is not installed")
    rng = np.random.default_rng(seed)
    rings, free = machine(rng)
    hole, island = beside(rings[2]), np.array([0.2, 0.1])
    regions = [[*beside(rings[1]), 5], [*island, 7.5]]
    mesh, _ = with_free(rng, rings, free, holes=[hole], regions=regions)
    vertices, segments, markers = polygons.joined(rings)
    inner = np.arange(len(rings[0]), len(vertices))
    for k in range(12):
        data = {
            "vertices": mesh.points.copy(),
            "segments": segments,
            "segment_markers": markers.reshape(-1, 1),
            "holes": turned(hole[None], 0.11 * k),
            "regions": [[*regions[0][:2], 5, 0], [*turned(island[None], 0.11 * k)[0], 7.5, 0]],
        }
        theirs = triangle.triangulate(data, "pA")
        assert as_sets(mesh.triangles) == as_sets(theirs["triangles"])
        ours = dict(zip(map(tuple, np.sort(mesh.triangles, axis=1).tolist()), mesh.labels))
        for row, label in zip(np.sort(theirs["triangles"], axis=1).tolist(), theirs["triangle_attributes"]):
            assert ours[tuple(row)] == label[0]
        assert set(mesh.labels) == {5, 7.5}
        again = deldrift.Mesh.from_triangle(data)
        assert as_sets(again.triangles) == as_sets(mesh.triangles)
        goals = turned(vertices, 0.11 * (k + 1))[inner]
        sweep(rng, mesh, goals)
        mesh.move(goals, inner)


def beside(ring):
    """A place outside of a ring around (0.2, 0): beside the corner that is furthest out."""
    corner = ring[np.argmax(np.hypot(*(ring - [0.2, 0]).T))]
    away = corner - [0.2, 0]
    return corner + 0.05 * away / np.hypot(*away)


def sweep(rng, mesh, goals):
    """Moves free points a little, and those away with which the step of the rings would conflict."""
    ids = np.arange(mesh.delaunay.npoints - 60, mesh.delaunay.npoints)
    inner = np.arange(20, 35)
    for _ in range(200):
        points = mesh.points.copy()
        points[ids] += 0.01 * rng.standard_normal((60, 2))
        if not len(mesh.delaunay.check(points)):
            mesh.move(points)
        conflicts = mesh.delaunay.check(goals, inner)
        if not len(conflicts):
            return
        assert set(conflicts["kind"]) <= {0, 1}
    raise AssertionError("no way was found")


@pytest.mark.parametrize("seed", range(6))
def test_odd_levels_without_holes(seed):
    rng = np.random.default_rng(seed)
    rings = polygons.nested(rng)
    mesh, count = with_free(rng, rings, polygons.sprinkled(rng, rings))
    for k in range(6):
        tri = mesh.delaunay
        inside = polygons.around(rings, tri.points, tri.simplices).sum(axis=1) % 2 == 1
        np.testing.assert_array_equal(mesh.mask, inside)
        np.testing.assert_array_equal(mesh.triangles, tri.simplices[inside])
        assert not mesh.labels.any() and len(mesh.labels) == len(mesh.triangles)
        area = sum(exact.cross(*corners) for corners in corners_of(mesh.points, mesh.triangles))
        signed = [shoelace(exact.fractions_of(ring)) for ring in rings]
        assert area == signed[0] - signed[1] - signed[2] + signed[3] - signed[4] + signed[5]
        chains = mesh.boundary
        assert sorted(map(len, chains.loops())) == sorted(map(len, rings))
        for number, loop in enumerate(chains.loops()):
            ring = set(chains.markers[chains.chains == number])
            assert len(ring) == 1
            turns_left = shoelace(exact.fractions_of(mesh.points[loop])) > 0
            assert turns_left == (ring & {1, 4, 6} != set())
        if k < 5:
            mesh.advance(mesh.points + 0.03 * rng.standard_normal(mesh.points.shape))
            rings = np.split(mesh.points[:count], np.cumsum([len(one) for one in rings])[:-1])


def test_shared_sides_count_each_by_even_odd():
    square = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 0], [3, 0], [3, 2], [1, 2]]
    sides, notch = [[0, 4], [4, 5], [5, 1], [1, 2], [2, 3], [3, 0]], [[4, 5], [5, 6], [6, 7], [7, 4]]
    hole = [[6, 7], [7, 4], [4, 6]]
    for more, nested, filled in (notch, 16, 12), (sides, 16, 0), (sides + sides, 16, 16), (hole, 14, 14):
        areas = []
        for keep in "nesting", "even-odd":
            mesh = deldrift.Mesh(square, sides + more, keep=keep)
            for made in mesh, mesh.copy():
                areas.append(made.delaunay.volumes()[made.mask].sum())
        assert areas == [nested, nested, filled, filled]
    assert len(deldrift.Mesh(square, sides + notch).triangles) > 0
    with pytest.raises(deldrift.InvalidValue, match="keep is 'odd', and must be one of 'nesting', 'even-odd'"):
        deldrift.Mesh(square, sides, keep="odd")
    mesh = deldrift.Mesh(square, sides + notch, keep="even-odd")
    mesh.refine(greatest_area=0.25)
    assert abs(mesh.delaunay.volumes()[mesh.mask].sum() - 12) < 1e-12


def corners_of(points, triangles):
    places = exact.fractions_of(points)
    return [[places[v] for v in row] for row in triangles.tolist()]


def shoelace(corners):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))


@pytest.mark.parametrize("seed", range(6))
def test_dictionaries_go_round(seed):
    """What `to_dict` gives makes the mesh again, here and in Triangle."""
    rng = np.random.default_rng(seed)
    rings = polygons.nested(rng)
    free = polygons.sprinkled(rng, rings)
    vertices, segments, markers = polygons.joined(rings)
    mesh, _ = with_free(rng, rings, free, regions=[[9, 1, 4]] if seed % 2 else None)
    mesh.delaunay.remove(len(vertices) + 3)
    mesh.advance(mesh.points + 0.02 * rng.standard_normal(mesh.points.shape))
    data = mesh.to_dict()
    again = deldrift.Mesh.from_triangle(data)
    names = np.flatnonzero(~np.isnan(mesh.points[:, 0]))
    assert as_sets(names[again.triangles]) == as_sets(mesh.triangles) == as_sets(names[data["triangles"]])
    np.testing.assert_array_equal(again.segments.markers, markers)
    np.testing.assert_array_equal(names[again.segments.ends], segments)
    assert len(data["holes"]) == 3
    if seed % 2:
        labels = dict(zip(map(tuple, np.sort(names[again.triangles], axis=1).tolist()), again.labels))
        assert [labels[row] for row in map(tuple, np.sort(mesh.triangles, axis=1).tolist())] == mesh.labels.tolist()
        assert set(mesh.labels) == {0, 4} and data["triangle_attributes"].shape == (len(mesh.triangles), 1)
    else:
        assert "regions" not in data and "triangle_attributes" not in data
    triangle = pytest.importorskip("triangle", reason="triangle is not installed")
    theirs = triangle.triangulate(data, "p")
    assert as_sets(theirs["triangles"]) == as_sets(data["triangles"])
    with pytest.warns(UserWarning, match="leaves out what a mesh does not have: vertex_markers$"):
        back = deldrift.Mesh.from_triangle({**theirs, "holes": data["holes"]})
    assert as_sets(back.triangles) == as_sets(data["triangles"])


def test_what_a_mesh_does_not_have_is_told():
    square = {"vertices": [[0, 0], [4, 0], [4, 4], [0, 4]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
    with pytest.warns(UserWarning, match="vertex_attributes"):
        mesh = deldrift.Mesh.from_triangle({**square, "vertex_attributes": [[1], [2], [3], [4]]})
    assert len(mesh.triangles) == 2 and mesh.segments.markers.tolist() == [0, 0, 0, 0]
    with pytest.raises(deldrift.InvalidValue, match="data has no 'segments'"):
        deldrift.Mesh.from_triangle({"vertices": square["vertices"]})


def test_concavities_are_outside():
    vertices = [[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]
    with pytest.warns(UserWarning, match="outside of all closed chains"):
        mesh = deldrift.Mesh(vertices, [[k, (k + 1) % 5] for k in range(5)], holes=[[2, 3], [99, 0]])
    assert as_sets(mesh.triangles) == {(0, 1, 3), (1, 2, 3), (0, 3, 4)}
    assert mesh.boundary.loops()[0].tolist() == [0, 1, 2, 3, 4] and "holes" not in mesh.to_dict()
    # Without a closed chain there is no domain.
    assert len(deldrift.Mesh(vertices, [[0, 1], [1, 2]]).triangles) == 0


def test_regions_are_known_by_their_outer_boundary(rng):
    """A region with an island: the island leaves it by a jump, and the label stays."""
    square = [[0, 0], [4, 0], [4, 4], [0, 4]]
    island = [[1, 1], [2, 1], [1, 2]]
    other = [[10, 0], [14, 0], [14, 4], [10, 4]]
    rings = [np.array(one, float) for one in (island, square, other)]
    vertices, segments, markers = polygons.joined(rings)
    mesh = deldrift.Mesh(vertices, segments, markers, holes=[], regions=[[3, 3, 1], [1.2, 1.2, 2], [11, 1, 3]])
    sizes = {label: count_of(mesh, label) for label in (1, 2, 3)}
    assert sizes == {1: 7, 2: 1, 3: 2}
    mesh.move(rings[0] + [10, 0], ids=[0, 1, 2])
    assert {label: count_of(mesh, label) for label in (1, 2, 3)} == {1: 2, 2: 1, 3: 7}
    mesh.move(rings[0] + [20, 0], ids=[0, 1, 2])
    assert {label: count_of(mesh, label) for label in (1, 2, 3)} == {1: 2, 2: 1, 3: 2}


def count_of(mesh, label):
    return int((mesh.labels == label).sum())


def test_advance_goes_as_far_as_it_may(rng):
    rings, free = machine(rng)
    mesh, _ = with_free(rng, rings, free[:0])
    inner = np.arange(20, 35)
    start = mesh.points[inner].copy()
    for cut in 0.5, 0.8:
        parted = mesh.copy()
        part = parted.advance(start + [2.5, 0], ids=inner, cut=cut)
        assert 0 < part < 1
        np.testing.assert_array_equal(parted.points[inner], start + part * (start + [2.5, 0] - start))
        assert len(mesh.delaunay.check(start + part / cut * (start + [2.5, 0] - start), inner))
        np.testing.assert_array_equal(parted.points[:20], mesh.points[:20])
    assert mesh.advance(start + 0.001, ids=inner) == 1.0
    np.testing.assert_array_equal(mesh.points[inner], start + 0.001)
    before = mesh.delaunay.tobytes()
    with pytest.raises(deldrift.ConflictError):
        mesh.advance(mesh.points[[1]], ids=[0], least=1)
    with pytest.raises(deldrift.ConflictError):
        mesh.move(start + [2.5, 0], ids=inner)
    assert mesh.delaunay.tobytes() == before


def test_steps_of_the_triangulation_change_the_mesh(rng):
    rings, free = machine(rng, 10)
    mesh, _ = with_free(rng, rings, free, holes=[beside(rings[2])])
    triangles, mask = mesh.triangles, mesh.mask
    assert mesh.triangles is triangles and mesh.boundary is mesh.boundary
    with pytest.raises(ValueError):
        triangles[...] = 0
    before = triangles.copy()
    with mesh.delaunay.step() as step:
        step.insert([[0.2, 0.01]])
    assert len(mesh.triangles) == len(before) + 2 and len(mesh.mask) == len(mask) + 2
    np.testing.assert_array_equal(triangles, before)
    # A hole that is opened is one with what is around it, and it is closed again.
    n = len(mesh.triangles)
    k = len(rings[0])
    ends = mesh.segments.ends[k].tolist()
    mesh.delaunay.remove_segments([mesh.segments.ids[k]])
    assert len(mesh.triangles) > n
    mesh.delaunay.add_segments([ends])
    assert len(mesh.triangles) == n


def pickled(mesh):
    return pickle.loads(pickle.dumps(mesh))


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, deldrift.Mesh.copy, pickled])
def test_copies(rng, copied):
    rings, free = machine(rng)
    mesh, _ = with_free(rng, rings, free, holes=[beside(rings[2])], regions=[[0.2, 0, 7]])
    other = copied(mesh)
    for name in "triangles", "labels", "mask":
        np.testing.assert_array_equal(getattr(mesh, name), getattr(other, name))
    before = mesh.triangles.copy()
    other.advance(other.points + 0.05 * rng.standard_normal(other.points.shape))
    assert as_sets(other.triangles) != as_sets(before) and set(other.labels) == {0, 7}
    np.testing.assert_array_equal(mesh.triangles, before)


SQUARE, SIDES = [[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1], [1, 2], [2, 3], [3, 0]]


@pytest.mark.parametrize("argument", ["holes", "regions"])
@pytest.mark.parametrize("place", [(4, 2), (4, 4), (0, 0), (2, 0), (0, 3.5), (1, 1), (2, 2), (1.5, 1)])
def test_seeds_on_outlines_are_told(argument, place):
    """On the outline, at a corner, on the outline of a hole, or at a corner of it: between two regions."""
    vertices = SQUARE + [[1, 1], [2, 1], [2, 2], [1, 2]]
    segments = SIDES + [[4, 5], [5, 6], [6, 7], [7, 4]]
    seeds = [(3, 3), place]
    given = seeds if argument == "holes" else [(*seed, 7) for seed in seeds]
    with pytest.raises(deldrift.AmbiguousSeed, match=rf"{argument}\[1\] is on the boundary of several regions") as caught:
        deldrift.Mesh(vertices, segments, **{argument: given})
    assert (caught.value.argument, caught.value.index) == (argument, 1)


def test_seeds_on_the_hull_where_it_is_open(rng):
    """Where no segment is between a place and the outside, there is one region; as C tells it and by the definition."""
    tri = deldrift.Delaunay(SQUARE, segments=SIDES[:3])
    for place in (4, 2), (4, 4), (0, 2), (0, 0), (2, 2):
        assert tri.label_cells([place], [5]).tolist() == [5, 5]
    tri = deldrift.Delaunay(SQUARE, segments=SIDES + [[0, 2]])
    assert sorted(tri.label_cells([(3, 1)], [5]).tolist()) == [0, 5]
    for place in (4, 2), (4, 0), (0, 4), (2, 2), (4, 4):
        with pytest.raises(deldrift.AmbiguousSeed):
            tri.label_cells([place], [5])
    # One half is open: its sides have the same region on both of theirs.
    tri = deldrift.Delaunay(SQUARE, segments=[SIDES[0], SIDES[2], SIDES[3], [0, 2]])
    closed = tri.label_cells([(1, 3)], [5])
    for place in (2, 0), (4, 2), (4, 0):
        assert (tri.label_cells([place], [5]) == 5 - closed).all()
    for place in (0, 2), (0, 4), (2, 4), (1, 1), (0, 0), (4, 4):
        with pytest.raises(deldrift.AmbiguousSeed):
            tri.label_cells([place], [5])


@pytest.mark.parametrize("seed", range(8))
def test_seeds_by_the_definition(seed):
    """Places on a lattice, on and off segments: ambiguous if cells at it, or cells and the outside, are apart."""
    rng = np.random.default_rng(seed)
    lattice = np.stack(np.meshgrid(np.arange(4.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
    edges = np.unique(np.sort(deldrift.Delaunay(lattice).edges(), axis=1), axis=0)
    tri = deldrift.Delaunay(lattice, segments=edges[rng.random(len(edges)) < 0.6])
    at_edges, outside = tri.segments_of_cells(), tri.nsimplex
    region = np.arange(outside + 1)
    for cell in range(outside):
        for corner in range(3):
            if at_edges[cell, corner] < 0:
                region[region == region[cell]] = region[tri.neighbors[cell, corner]]
    for place in np.stack(np.meshgrid(np.arange(0, 3.5, 0.5), np.arange(0, 3.5, 0.5)), axis=-1).reshape(-1, 2):
        touching = {
            cell
            for cell, row in enumerate(tri.simplices)
            if all(deldrift.orientation([tri.points[row[k - 2]], tri.points[row[k - 1]], place]) >= 0 for k in range(3))
        }
        regions = {int(region[cell]) for cell in touching} | ({int(region[outside])} if place.min() == 0 or place.max() == 3 else set())
        # Of two regions that are one by way of the outside, cells tell.
        parts = {frozenset(part_of(tri, at_edges, cell)) for cell in touching}
        if len(regions) > 1 or len(parts) > 1:
            with pytest.raises(deldrift.AmbiguousSeed):
                tri.label_cells([place], [5])
        else:
            labels = tri.label_cells([place], [5])
            assert set(np.flatnonzero(labels == 5).tolist()) == parts.pop()


def part_of(tri, at_edges, cell):
    """The simplices that are reached from one without crossing a segment or leaving the hull."""
    part, waiting = {cell}, [cell]
    while waiting:
        here = waiting.pop()
        for across, segment in zip(tri.neighbors[here].tolist(), at_edges[here].tolist()):
            if across >= 0 and segment < 0 and across not in part:
                part.add(across)
                waiting.append(across)
    return part


def test_seeds_outside_are_told():
    with pytest.warns(UserWarning) as told:
        mesh = deldrift.Mesh(SQUARE, SIDES, holes=[(5, 5), (-1, 2)], regions=[(1, 1, 7), (4.5, 2, 8)])
    assert [str(one.message) for one in told] == [
        f"{name} is outside of all closed chains of segments, and has no effect"
        for name in ("holes[0]", "holes[1]", "regions[1]")
    ]
    assert len(mesh.triangles) == 2 and mesh.labels.tolist() == [7, 7]
