"""scipy's own tests of Delaunay, run from where scipy is installed against this package.

Loops over dimensions end at 3. What is waived is listed with the reason; test_scipy_names.py has the same questions for
each, as sets where qhull's order of rows was asked for.
"""

import builtins
import importlib.util
import os
import types

import numpy as np
import pytest

import deldrift

pytest.importorskip("scipy.spatial", reason="scipy is not installed")

# By the beginning of a test's name.
WAIVED = {
    "test_2d_square": "qhull's order of rows, and its diagonal of a square",
    "test_find_simplex": "qhull's order of rows, and its diagonal of a square",
    "test_convex_hull": "qhull's order of rows, and of the vertices in them",
    "test_joggle": "QJ, which is refused",
    "test_furthest_site": "furthest_site, which is refused",
    "test_degenerate_barycentric_transforms": "qhull's number of flat simplices; run below without it",
    "test_vertices_deprecation": "the attribute vertices, which scipy has removed since",
    "test_incremental[random-4d": "above three dimensions",
    "test_incremental[random-5d": "above three dimensions",
    "test_incremental[random-6d": "above three dimensions",
    "test_incremental[random-7d": "above three dimensions",
    "test_incremental[random-8d": "above three dimensions",
}


class WithSimplicesOfItsOwn(deldrift.Delaunay):
    """For a test that sorts `simplices` in place, which here are read-only."""

    @property
    def simplices(self):
        if not hasattr(self, "_sorted"):
            self._sorted = super().simplices.copy()
        return self._sorted


def range_to_three_dimensions(*bounds):
    return builtins.range(2, 4) if bounds in ((2, 8), (2, 6)) else builtins.range(*bounds)


def load():
    spec = importlib.util.find_spec("scipy.spatial.tests.test_qhull")
    if spec is None:
        pytest.skip("scipy is installed without its tests", allow_module_level=True)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.qhull = types.SimpleNamespace(Delaunay=deldrift.Delaunay, tsearch=deldrift.tsearch)
    module.range = range_to_three_dimensions
    for name, (chunks, options) in list(module.INCREMENTAL_DATASETS.items()):
        # Joggled in scipy, as qhull has no point at infinity in incremental mode; that is refused here, and not needed.
        if options is not None:
            module.INCREMENTAL_DATASETS[name] = chunks, None
    return module


suite = load()
TestDelaunay = suite.TestDelaunay
TestUtilities = suite.TestUtilities
TestVertexNeighborVertices = suite.TestVertexNeighborVertices


@pytest.fixture(autouse=True)
def waive(request, monkeypatch):
    name = request.node.name
    for beginning, reason in WAIVED.items():
        if name.startswith(beginning):
            pytest.skip(f"WAIVED {reason}")
    if name == "test_nd_simplex":
        monkeypatch.setattr(suite.qhull, "Delaunay", WithSimplicesOfItsOwn)
    if "volume_area" in name:
        pytest.skip("WAIVED of ConvexHull, not of Delaunay")


def free_function(name):
    found = getattr(suite, name, None)
    return found or pytest.skip(f"{name} is in later versions of scipy")


def test_gh_20623():
    free_function("test_gh_20623")(deldrift.Delaunay)


def test_gh_21286():
    free_function("test_gh_21286")()


def test_ndim_err_of_find_simplex():
    free_function("test_find_simplex_ndim_err")()


def test_degenerate_points_without_the_count():
    data = os.path.join(os.path.dirname(suite.__file__), "data", "degenerate_pointset.npz")
    with np.load(data) as arrays:
        tri = deldrift.Delaunay(arrays["c"])
    tri.validate()
    suite.TestUtilities()._check_barycentric_transforms(tri)
