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
