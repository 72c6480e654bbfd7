"""What one call through ctypes costs, beside cffi where that is installed: `python python/bench/calls.py`."""

import timeit

import numpy as np

import deldrift
from deldrift import _core, _library

CALLS = 200_000


def microseconds(run):
    return 1e6 * min(timeit.repeat(run, number=CALLS, repeat=5)) / CALLS


def of_cffi(handle):
    import cffi

    ffi = cffi.FFI()
    ffi.cdef("uint32_t deldrift_id_count(const void *t, size_t *count);")
    library = ffi.dlopen(_library._find())
    count, pointer = ffi.new("size_t *"), ffi.cast("void *", handle)
    return microseconds(lambda: library.deldrift_id_count(pointer, count))


tri = deldrift.Delaunay(np.random.default_rng(1).random((10, 2)))
handle = tri._handle.pointer
print(f"ctypes: {microseconds(lambda: _core.id_count(handle)):.2f} µs for deldrift_id_count")
try:
    print(f"cffi:   {of_cffi(handle):.2f} µs")
except ImportError:
    print("SKIPPED cffi is not installed")
print(f"npoints: {microseconds(lambda: tri.npoints):.2f} µs")
positions = tri.points.copy()
print(f"a step of 10 points: {microseconds(lambda: (tri.move(positions), tri.simplices, tri.neighbors)):.2f} µs")
