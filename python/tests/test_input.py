"""Points and ids of any type, order, stride and library."""

import numpy as np
import pytest

import deldrift


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


@pytest.mark.parametrize("dtype", "f2 f4 >f4 f8 >f8 g i1 u1 i2 >i4 u4 i8 ?".split())
def test_types(rng, ndim, dtype):
    points = (rng.random((40, ndim)) * 100).astype(dtype)
    tri = deldrift.Delaunay(points)
    assert tri.points.dtype == np.float64
    np.testing.assert_array_equal(tri.points, points.astype(np.float64))


def test_float32_is_converted_exactly(rng, ndim):
    points = rng.random((100, ndim)).astype(np.float32)
    tri = deldrift.Delaunay(points)
    assert (tri.points.astype(np.float32) == points).all() and (tri.points == points).all()


def layouts(points):
    wide = np.zeros((2 * len(points), 3 * points.shape[1] + 1))
    wide[::2, 1::3] = points
    record = np.zeros(len(points), [("tag", "u1"), ("at", "f8", (points.shape[1],))])
    record["at"] = points
    read_only = points.copy()
    read_only.flags.writeable = False
    shifted = np.frombuffer(b"\0" + points.tobytes(), np.float64, offset=1).reshape(points.shape)
    return {
        "fortran": np.asfortranarray(points),
        "strided": wide[::2, 1::3],
        "reversed": points[::-1].copy()[::-1],
        "misaligned in records": record["at"],
        "misaligned": shifted,
        "read-only": read_only,
        "list": points.tolist(),
        "tuples": [tuple(row) for row in points],
        "objects": points.astype(object),
        "matrix": points.view(np.ndarray).copy().view(np.matrix),
        "__array__": HasArray(points),
        "DLPack": HasDlpack(points),
        "memoryview": memoryview(points),
    }


class HasArray:
    def __init__(self, points):
        self.points = points

    def __array__(self, dtype=None, copy=None):
        return self.points


class HasDlpack:
    def __init__(self, points):
        self.points = points

    def __dlpack__(self, **arguments):
        return self.points.__dlpack__(**arguments)

    def __dlpack_device__(self):
        return self.points.__dlpack_device__()


@pytest.mark.parametrize("layout", list(layouts(np.zeros((3, 2)))))
def test_layouts(rng, ndim, layout):
    points = rng.random((60, ndim))
    moved = points + 0.05 * rng.standard_normal(points.shape)
    tri = deldrift.Delaunay(layouts(points)[layout])
    np.testing.assert_array_equal(tri.points, points)
    tri.move(layouts(moved)[layout])
    np.testing.assert_array_equal(tri.points, moved)
    assert as_sets(tri.simplices) == as_sets(deldrift.Delaunay(moved).simplices)


def test_torch_tensors(rng, ndim):
    torch = pytest.importorskip("torch", reason="torch is not installed")
    points = rng.random((60, ndim))
    tri = deldrift.Delaunay(torch.tensor(points))
    np.testing.assert_array_equal(tri.points, points)
    tri.move(torch.tensor(points.astype(np.float32)))
    np.testing.assert_array_equal(tri.points, points.astype(np.float32))
    with pytest.raises(RuntimeError, match="grad"):
        tri.move(torch.tensor(points, requires_grad=True))


def test_what_is_given_is_not_changed_and_not_kept(rng, ndim):
    points = rng.random((60, ndim))
    given = points.copy()
    tri = deldrift.Delaunay(given)
    np.testing.assert_array_equal(given, points)
    given[:] = 0
    np.testing.assert_array_equal(tri.points, points)


@pytest.mark.parametrize("dtype", "i1 u1 >i2 i4 u4 >i8 u8".split())
def test_types_of_ids(rng, dtype):
    tri = deldrift.Delaunay(rng.random((60, 2)))
    tri.move([[0.1, 0.2], [0.3, 0.4]], np.array([5, 50], dtype))
    np.testing.assert_array_equal(tri.points[[5, 50]], [[0.1, 0.2], [0.3, 0.4]])


def test_no_ids_at_all(rng):
    tri = deldrift.Delaunay(rng.random((60, 2)))
    assert tri.move(np.empty((0, 2)), []).moved == 0
    with tri.step() as step:
        step.remove([])
        assert len(step.insert(np.empty((0, 2)))) == 0


def test_numpy_integers_are_ids(rng):
    tri = deldrift.Delaunay(rng.random((60, 2)))
    tri.remove(np.int64(3))
    assert not tri.is_present(np.uint8(3))


SQUARE = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4], [1, 2]])
SIDES = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
WALLS = [[-1, -1], [5, 5]]


def stepped(tri, change):
    with tri.step() as step:
        change(step)
    return tri.points


def refined(tri, **options):
    tri.refine(greatest_area=2, **options)
    return tri.points


def updated(tri, given):
    volumes = np.zeros(tri.nsimplex)
    tri.update_volumes(given, volumes)
    return volumes


# A value for each argument that takes an array, and the call with it; `tri` has segments around it, `box` is periodic.
ARGUMENTS = {
    "Delaunay.points": (SQUARE, lambda tri, box, a: deldrift.Delaunay(a).simplices),
    "Delaunay.segments": (SIDES, lambda tri, box, a: deldrift.Delaunay(SQUARE, segments=a).segments.ends),
    "Delaunay.segment_markers": (SIDES[:, 0], lambda tri, box, a: deldrift.Delaunay(SQUARE, segments=SIDES, segment_markers=a).segments.markers),
    "Delaunay.keys": (np.arange(5), lambda tri, box, a: deldrift.Delaunay(SQUARE, keys=a).keys),
    "PeriodicDelaunay.points": (SQUARE, lambda tri, box, a: deldrift.PeriodicDelaunay(a, [8, 8]).simplices),
    "PeriodicDelaunay.vectors, rows": (np.diag([8.0, 8]), lambda tri, box, a: deldrift.PeriodicDelaunay(SQUARE, a).vectors),
    "PeriodicDelaunay.vectors, lengths": (np.array([8.0, 8]), lambda tri, box, a: deldrift.PeriodicDelaunay(SQUARE, a).vectors),
    "PeriodicDelaunay.move.vectors": (np.array([8.0, 9]), lambda tri, box, a: (box.move(vectors=a), box.vectors)[1]),
    "PeriodicDelaunay.move.ids": (np.array([1]), lambda tri, box, a: (box.move([[1, 1]], a), box.points)[1]),
    "PeriodicDelaunay.remove": (np.array([1]), lambda tri, box, a: (box.remove(a), box.points)[1]),
    "PeriodicDelaunay.insert": (np.array([[3.0, 3]]), lambda tri, box, a: (box.insert(a), box.points)[1]),
    "PeriodicDelaunay.wrap.points": (SQUARE, lambda tri, box, a: box.wrap(a)[0]),
    "PeriodicDelaunay.wrap.previous": (SQUARE, lambda tri, box, a: box.wrap(SQUARE, a)[0]),
    "PeriodicDelaunay.locate": (SQUARE, lambda tri, box, a: box.locate(a).indices),
    "PeriodicDelaunay.voronoi_cells.mask": (np.arange(5) < 3, lambda tri, box, a: box.voronoi_cells(a).volumes),
    "PeriodicDelaunay.voronoi_derivatives.mask": (np.arange(5) < 3, lambda tri, box, a: box.voronoi_derivatives(a).measures),
    "move.points": (SQUARE + [0.5, 0.25], lambda tri, box, a: (tri.move(a), tri.points)[1]),
    "move.ids": (np.array([4]), lambda tri, box, a: (tri.move([[3, 2]], a), tri.points)[1]),
    "relocate": (np.array([3.0, 1]), lambda tri, box, a: (tri.relocate(4, a), tri.points)[1]),
    "insert": (np.array([3.0, 1]), lambda tri, box, a: (tri.insert(a), tri.points)[1]),
    "add_points": (np.array([[3.0, 1]]), lambda tri, box, a: (tri.add_points(a), tri.points)[1]),
    "step.insert.keys": (np.array([9]), lambda tri, box, a: stepped(tri, lambda step: step.insert([[3, 1]], a))),
    "step.remove": (np.array([4]), lambda tri, box, a: stepped(tri, lambda step: step.remove(a))),
    "add_segments": (np.array([[0, 4], [4, 2]]), lambda tri, box, a: (tri.add_segments(a), tri.segments.ends)[1]),
    "remove_segments": (np.array([1, 2]), lambda tri, box, a: (tri.remove_segments(a), tri.segments.ends)[1]),
    "check": (SQUARE, lambda tri, box, a: tri.check(a)),
    "find_simplex": (SQUARE + 0.1, lambda tri, box, a: tri.find_simplex(a)),
    "tsearch": (SQUARE + 0.1, lambda tri, box, a: deldrift.tsearch(tri, a)),
    "locate": (SQUARE + 0.1, lambda tri, box, a: tri.locate(a).indices),
    "nearest_vertices": (SQUARE + 0.1, lambda tri, box, a: tri.nearest_vertices(a, 2)),
    "vertices_in_ball": (np.array([1.0, 1]), lambda tri, box, a: tri.vertices_in_ball(a, 4)),
    "vertices_in_box": (np.array([0.0, 0]), lambda tri, box, a: tri.vertices_in_box(a, [2, 2])),
    "conflicts": (np.array([1.0, 1]), lambda tri, box, a: tri.conflicts(a)),
    "barycentric.xi": (SQUARE * 0.9, lambda tri, box, a: tri.barycentric(a)),
    "barycentric.simplices": (np.array([0, 1, -1, 1, 0]), lambda tri, box, a: tri.barycentric(SQUARE, a)),
    "interpolate.values": (SQUARE, lambda tri, box, a: tri.interpolate(a, SQUARE)),
    "interpolate.xi": (SQUARE, lambda tri, box, a: tri.interpolate(SQUARE, a)),
    "interpolate.fill_value": (np.array([7.0, 8]), lambda tri, box, a: tri.interpolate(SQUARE, [[9, 9]], fill_value=a)),
    "lift_points": (SQUARE, lambda tri, box, a: tri.lift_points(a)),
    "plane_distance": (SQUARE, lambda tri, box, a: tri.plane_distance(a)),
    "simplices_in_reach.low": (np.array([1.0, 1]), lambda tri, box, a: tri.simplices_in_reach(a, [2, 2]).simplices),
    "simplices_in_reach.mask": (np.arange(5) < 3, lambda tri, box, a: tri.simplices_in_reach([1, 1], [2, 2], a).simplices),
    "vertices_in_reach.mask": (np.arange(5) < 3, lambda tri, box, a: tri.vertices_in_reach([1, 1], [2, 2], a)[1]),
    "simplices_with": (np.array([[0, 4], [1, 3]]), lambda tri, box, a: tri.simplices_with(a)),
    "simplices_around": (np.array([0, 4]), lambda tri, box, a: tri.simplices_around(a)),
    "voronoi_changed": (np.array([0, 4]), lambda tri, box, a: (tri.changes(), tri.voronoi_changed(a))[1]),
    "boundary": (np.arange(4) < 2, lambda tri, box, a: tri.boundary(a).facets),
    "boundary_chains": (np.arange(4) < 2, lambda tri, box, a: tri.boundary_chains(a).vertices),
    "voronoi_volumes.box": (np.array(WALLS, float), lambda tri, box, a: tri.voronoi_volumes(a)),
    "voronoi_cells.mask": (np.arange(5) < 3, lambda tri, box, a: tri.voronoi_cells(WALLS, a).volumes),
    "voronoi_cells.half_spaces": (np.array([[1.0, 1, 4]]), lambda tri, box, a: tri.voronoi_cells(WALLS, half_spaces=a).volumes),
    "voronoi_derivatives.mask": (np.arange(5) < 3, lambda tri, box, a: tri.voronoi_derivatives(WALLS, a).measures),
    "update_volumes.simplices": (np.array([1, 2]), lambda tri, box, a: updated(tri, a)),
    "label_cells.seeds": (np.array([[1.0, 1]]), lambda tri, box, a: tri.label_cells(a, [5])),
    "label_cells.labels": (np.array([5]), lambda tri, box, a: tri.label_cells([[1, 1]], a)),
    "refine.mask": (np.arange(4) < 4, lambda tri, box, a: refined(tri, mask=a)),
    "refine.labels": (np.arange(4), lambda tri, box, a: refined(tri, labels=a, areas=[1, 1, 1, 1])),
    "refine.areas": (np.array([1.0, 0.5]), lambda tri, box, a: refined(tri, areas=a)),
    "refine.sizes": (np.full(5, 1.0), lambda tri, box, a: refined(tri, sizes=a)),
    "refine.values": (np.arange(5.0), lambda tri, box, a: tri.refine(greatest_area=2, values=a).values),
    "Mesh.vertices": (SQUARE, lambda tri, box, a: deldrift.Mesh(a, SIDES).triangles),
    "Mesh.markers": (np.arange(4), lambda tri, box, a: deldrift.Mesh(SQUARE, SIDES, a).boundary.markers),
    "Mesh.regions": (np.array([[1.0, 1, 7]]), lambda tri, box, a: deldrift.Mesh(SQUARE, SIDES, regions=a).labels),
    "Mesh.holes": (np.array([[1.0, 1]]), lambda tri, box, a: deldrift.Mesh(SQUARE, SIDES, holes=a).mask),
    "orientation": (SQUARE[:3], lambda tri, box, a: np.array(deldrift.orientation(a))),
    "from_triangle.segment_markers": (
        np.arange(4),
        lambda tri, box, a: deldrift.Mesh.from_triangle(
            {"vertices": SQUARE, "segments": SIDES, "segment_markers": a}
        ).segments.markers,
    ),
}


def both_kinds():
    return deldrift.Delaunay(SQUARE, segments=SIDES), deldrift.PeriodicDelaunay(SQUARE, [8, 8])


def masked(value):
    mask = np.zeros(value.shape, bool)
    mask.flat[0] = True
    return np.ma.array(value, mask=mask)


@pytest.mark.parametrize("name", list(ARGUMENTS))
def test_masks_are_refused(name):
    """A mask says that entries are not to be used, and NumPy drops it."""
    value, call = ARGUMENTS[name]
    for given in [masked(value)] + ([list(masked(value))] if value.ndim == 2 else [[np.ma.masked, *value[1:]]]):
        tri, box = both_kinds()
        before = tri.tobytes(), box.tobytes()
        with pytest.raises(deldrift.InvalidShape, match="masked"):
            call(tri, box, given)
        assert before == (tri.tobytes(), box.tobytes())


@pytest.mark.parametrize("name", list(ARGUMENTS))
def test_whatever_numpy_or_dlpack_makes_an_array_of_is_taken(name):
    value, call = ARGUMENTS[name]
    expected = call(*both_kinds(), value)
    given = [value.tolist(), HasArray(value), value[::-1].copy()[::-1]]
    # NumPy has no DLPack for booleans of old.
    if value.dtype != bool or np.lib.NumpyVersion(np.__version__) >= "1.25.0":
        given.append(HasDlpack(value))
    if value.dtype == bool:
        given.append(HasDlpack(value.astype(np.uint8)))
    for one in given:
        np.testing.assert_array_equal(call(*both_kinds(), one), expected)


def test_outputs_with_masks_are_refused():
    tri, _ = both_kinds()
    with pytest.raises(TypeError, match="volumes"):
        tri.update_volumes([0], np.ma.zeros(tri.nsimplex))


@pytest.mark.parametrize(
    "call, told, argument, index, value",
    [
        (lambda tri: deldrift.Delaunay(SQUARE, segments=[[0, 1], [2, 99]]), "segments[1, 1] is 99", "segments", (1, 1), 99),
        (lambda tri: deldrift.Delaunay(SQUARE, segments=[[0, 1], [-1, 2]]), "segments[1, 0] is -1", "segments", (1, 0), -1),
        (lambda tri: tri.add_segments([[0, 4], [99, 2]]), "ends[1, 0] is 99", "ends", (1, 0), 99),
        (lambda tri: deldrift.Mesh(SQUARE, [[0, 1], [1, 77]]), "segments[1, 1] is 77", "segments", (1, 1), 77),
        (lambda tri: tri.simplices_with([[0, 1], [2, 99]]), "vertices[1, 1] is 99", "vertices", (1, 1), 99),
        (lambda tri: tri.simplices_with([[0, 1], [2, -7]]), "vertices[1, 1] is -7", "vertices", (1, 1), -7),
        (lambda tri: tri.find_simplex([[[0, 0], [1, 1]], [[2, np.nan], [3, 3]]]), "xi[1, 0], coordinate 1, is NaN", "xi", (1, 0), None),
        (lambda tri: tri.locate([[[0, 0], [1, 2e57]]]), "xi[0, 1], coordinate 1, is 2", "xi", (0, 1), 2e57),
        (lambda tri: tri.nearest_vertices(np.full((2, 2, 2), np.inf)), "xi[0, 0], coordinate 0, is inf", "xi", (0, 0), np.inf),
        (lambda tri: tri.interpolate(np.arange(5), [[[0, 0]], [[0, np.nan]]]), "xi[1, 0], coordinate 1", "xi", (1, 0), None),
        (lambda tri: tri.barycentric(np.ones((2, 1, 2)), [[0], [99]]), "simplices[1, 0] is 99", "simplices", (1, 0), 99),
        (lambda tri: tri.barycentric(np.ones((2, 1, 2)), [[0], [-9]]), "simplices[1, 0] is -9", "simplices", (1, 0), -9),
        (lambda tri: tri.find_simplex([[0, 0], [1, np.nan]]), "xi[1], coordinate 1, is NaN", "xi", 1, None),
        (lambda tri: tri.label_cells([[1, 1]], 1 << 40), "labels is 1099511627776", "labels", None, 1 << 40),
        (lambda tri: tri.label_cells([[1, 1]], [1 << 40]), "labels[0] is 1099511627776", "labels", 0, 1 << 40),
    ],
)
def test_messages_name_the_entry(call, told, argument, index, value):
    with pytest.raises(deldrift.Error) as caught:
        call(both_kinds()[0])
    error = caught.value
    assert str(error).startswith(told), str(error)
    assert (error.argument, error.index) == (argument, index)
    assert error.value == value or (value is None and np.isnan(error.value))


NOWHERE = [np.nan, np.inf, -np.inf]


@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("wrong", NOWHERE)
def test_places_that_are_not_finite_are_left_out(rng, kind, wrong):
    """With nan_policy="omit" the others are answered as without them; by default the call is refused."""
    tri = both_kinds()[kind]
    places = rng.random((3, 4, 2)) * 3 + 0.5
    is_wrong = rng.random((3, 4)) < 0.4
    is_wrong[1, 2] = True
    asked = places.copy()
    asked[is_wrong, rng.integers(0, 2, is_wrong.sum())] = wrong
    values = tri.points[:, 0] ** 2
    calls = {
        "locate": lambda xi, **o: np.stack([np.asarray(part) for part in tri.locate(xi, **o)[:2]], axis=-1),
        "nearest_vertices": lambda xi, **o: tri.nearest_vertices(xi, 2, **o),
        "interpolate": lambda xi, **o: tri.interpolate(values, xi, fill_value=7, **o),
        "natural": lambda xi, **o: tri.interpolate(values, xi, "natural", fill_value=7, **o),
        "barycentric": lambda xi, **o: tri.barycentric(xi, **o),
    }
    if kind == 0:
        calls["find_simplex"] = lambda xi, **o: tri.find_simplex(xi, **o)
        calls["tol"] = lambda xi, **o: tri.find_simplex(xi, tol=1e-9, **o)
        calls["tsearch"] = lambda xi, **o: deldrift.tsearch(tri, xi, **o)
        simplices = tri.find_simplex(places)
        calls["in simplices"] = lambda xi, **o: tri.barycentric(xi, simplices, **o)
    for name, call in calls.items():
        with pytest.raises(deldrift.NotFinite, match=r"xi\[\d, \d\], coordinate"):
            call(asked)
        with pytest.raises(deldrift.InvalidValue, match="nan_policy"):
            call(asked, nan_policy="propagate")
        expected, found = call(places), call(asked, nan_policy="omit")
        np.testing.assert_array_equal(found[~is_wrong], expected[~is_wrong], err_msg=name)
        none = found[is_wrong]
        assert np.isnan(none).all() if none.dtype.kind == "f" else (none == -1).all(), name
        np.testing.assert_array_equal(call(places, nan_policy="omit"), expected)
        # What is out of range is no number that is missing, and is named by its place.
        asked[2, 3] = 0, 2e57
        with pytest.raises(deldrift.OutOfRange, match=r"xi\[2, 3\]"):
            call(asked, nan_policy="omit")
        asked[2, 3] = places[2, 3]
        is_wrong[2, 3] = False


def test_a_number_in_place_of_coordinates():
    tri, _ = both_kinds()
    for wrong in 1, np.float64(2), tri:
        for kind in IndexError, ValueError, deldrift.InvalidShape:
            with pytest.raises(kind, match=r"xi has the shape \(\)"):
                tri.find_simplex(wrong)
