"""Arrays of the library's memory: read-only, and never anything but what they showed when they were made."""

import copy
import gc
import sys
import weakref

import numpy as np
import pytest

import deldrift

counted = pytest.mark.skipif(
    sys.implementation.name != "cpython", reason="arrays are always copies without counted references"
)


def test_arrays_cannot_be_written(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    for name in "simplices neighbors points coplanar convex_hull transform equations vertex_to_simplex".split():
        array = getattr(tri, name)
        with pytest.raises(ValueError):
            array[...] = 0
        assert getattr(tri, name) is array, name
    for name in "simplices", "neighbors":
        with pytest.raises(ValueError):
            getattr(tri, name).flags.writeable = True


@counted
def test_no_copy_is_made(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    start = tri.simplices.__array_interface__["data"][0]
    tri.move(tri.points)
    assert tri.simplices.__array_interface__["data"][0] == start


@counted
def test_handle_is_kept_as_long_as_arrays(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    part = tri.simplices[3:9, 1:][::2]
    expected = part.copy()
    del tri
    gc.collect()
    junk = [deldrift.Delaunay(rng.random((50, ndim))) for _ in range(20)]
    np.testing.assert_array_equal(part, expected)
    assert deldrift.is_current(part)
    del junk


@counted
def test_memory_is_freed_with_the_last_reference(rng, ndim):
    gc.disable()
    try:
        tri = deldrift.Delaunay(rng.random((50, ndim)))
        with tri.step() as step:
            step.move(rng.random((50, ndim)))
        handle = sys.getrefcount(tri._handle)
        held = tri.simplices, tri.transform, tri.changes()
        assert sys.getrefcount(tri._handle) > handle
        seen = weakref.ref(tri)
        del tri, step
        assert seen() is None
        del held
    finally:
        gc.enable()


def test_an_array_keeps_what_it_showed(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    for _ in range(4):
        held, before = tri.simplices, tri.simplices.copy()
        assert deldrift.is_current(held)
        tri.move(rng.random((50, ndim)))
        np.testing.assert_array_equal(held, before)
        assert not deldrift.is_current(held)
        assert deldrift.is_current(tri.simplices)
        assert not np.array_equal(tri.simplices, before)


@counted
def test_arrays_of_segments_keep_what_they_showed(rng):
    tri = deldrift.Delaunay(rng.random((50, 2)), segments=[[0, 1], [0, 2], [0, 3]], segment_markers=[1, 2, 3])
    rows, ends, markers = tri.simplices, tri.segments.ends, tri.segments.markers
    copies = [array.copy() for array in (rows, ends, markers)]
    for change in (
        lambda: tri.check(rng.random((50, 2))),
        lambda: tri.remove_segments([1]),
        lambda: tri.remove_segments([0, 2]),
        lambda: tri.move(rng.random((50, 2))),
        lambda: tri.add_segments([[4, 5]]),
    ):
        change()
        assert not deldrift.is_current(rows)
        for array, expected in zip((rows, ends, markers), copies):
            np.testing.assert_array_equal(array, expected)
    del tri
    gc.collect()
    for array, expected in zip((rows, ends, markers), copies):
        np.testing.assert_array_equal(array, expected)


def test_copies_do_not_know_their_triangulation(rng, ndim):
    tri = deldrift.Delaunay(rng.random((50, ndim)))
    with pytest.raises(deldrift.InvalidValue, match="array is no array of a triangulation"):
        deldrift.is_current(tri.simplices.copy())


def change(tri, rng):
    """One change of a random kind, some of which fail."""
    kind = rng.integers(12 if tri.ndim == 2 else 9)
    if kind == 0:
        tri.move(np.nan_to_num(tri.points) + 0.1 * rng.standard_normal(tri.points.shape))
    elif kind == 1:
        tri.insert(rng.random(tri.ndim))
    elif kind == 2:
        try:
            tri.remove(int(rng.integers(tri.npoints)))
        except deldrift.RemovedVertex:
            pass
    elif kind == 3:
        tri.changes()
    elif kind == 4:
        try:
            with tri.step() as step:
                step.insert(rng.random((3, tri.ndim)))
                if rng.random() < 0.5:
                    raise KeyError
        except KeyError:
            pass
    elif kind == 5:
        tri.compact()
    elif kind == 6:
        with pytest.raises(deldrift.NotFinite):
            tri.insert(np.full(tri.ndim, np.nan))
    elif kind == 7:
        tri.algorithm = str(rng.choice(["auto", "tolerance", "repair"]))
    elif kind == 8:
        tri.add_points(rng.random((2, tri.ndim)))
    else:
        change_segments(tri, rng, kind)


def change_segments(tri, rng, kind):
    """Segments come and go, or are asked about."""
    if kind == 9:
        tri.add_segments(rng.choice(tri.npoints, (2, 2)))
    elif kind == 10:
        tri.remove_segments(tri.segments.ids[::2])
    else:
        tri.check(np.nan_to_num(tri.points) + 0.3 * rng.standard_normal(tri.points.shape))


def look(tri, rng):
    """An array that may show the library's memory, in one of the forms in which programs keep it."""
    array = (tri.simplices, tri.neighbors, tri.segments.ends)[rng.integers(3)]
    form = rng.integers(6)
    if form == 0:
        return array
    if form == 1:
        return array[::-2]
    if form == 2:
        return memoryview(array)
    if form == 3:
        return array.reshape(-1)[5:]
    if form == 4:
        return np.asarray(memoryview(array.T))
    return array.view(np.uint32)


@pytest.mark.parametrize("seed", range(10))
def test_random_interleavings(seed):
    """100 for each seed: held arrays are compared with copies that were made at once. test_under_valgrind runs some."""
    rng = np.random.default_rng(seed)
    for _ in range(100):
        tri = deldrift.Delaunay(rng.random((int(rng.integers(1, 25)), int(rng.integers(2, 4)))))
        held = []
        for _ in range(int(rng.integers(2, 8))):
            if rng.random() < 0.6:
                array = look(tri, rng)
                held.append((array, np.array(array)))
            if held and rng.random() < 0.3:
                held.pop(int(rng.integers(len(held))))
            if rng.random() < 0.1:
                tri = copy.copy(tri)
            try:
                change(tri, rng)
            except (deldrift.ConflictError, deldrift.RemovedVertex):
                pass
            for array, expected in held:
                np.testing.assert_array_equal(np.asarray(array), expected)
        del tri
        for array, expected in held:
            np.testing.assert_array_equal(np.asarray(array), expected)
