"""Saving, loading, pickling, copying, and other programs' formats."""

import copy
import os
import pickle
import xml.etree.ElementTree

import numpy as np
import pytest

import deldrift


@pytest.fixture
def tri(rng, ndim):
    tri = deldrift.Delaunay(rng.random((70, ndim)), algorithm="tolerance", threads=1)
    tri.move(rng.random((70, ndim)))
    tri.remove(5)
    return tri


def assert_same(a, b):
    for name in "points simplices neighbors coplanar timestamp ndim npoints nvertices".split():
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name)


def test_save_and_load(tri, tmp_path):
    tri.save(tmp_path / "saved")
    loaded = deldrift.load(os.fsencode(tmp_path / "saved"), algorithm="repair")
    assert_same(tri, loaded)
    assert loaded.algorithm == "repair"
    assert_same(deldrift.frombytes(tri.tobytes()), tri)
    assert_same(deldrift.frombytes(memoryview(tri.tobytes())), tri)


class Special(deldrift.Delaunay):
    pass


@pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda t: t.copy(), lambda t: pickle.loads(pickle.dumps(t))]
)
def test_copies_are_independent(tri, rng, again):
    other = again(tri)
    assert_same(tri, other)
    assert (other.algorithm, other._division) == ("tolerance", (1, 0))
    before = tri.points.copy()
    other.move(rng.random(tri.points.shape))
    np.testing.assert_array_equal(tri.points, before)
    other.move(before)
    np.testing.assert_array_equal(np.sort(other.simplices.ravel()), np.sort(tri.simplices.ravel()))


def test_copies_have_the_class_of_their_original(rng):
    tri = Special(rng.random((9, 2)))
    assert type(tri.copy()) is Special
    assert type(pickle.loads(pickle.dumps(tri))) is Special


def test_copies_in_a_step_have_nothing_staged(tri, rng):
    with tri.step() as step:
        step.insert(rng.random((3, tri.ndim)))
        others = [tri.copy(), pickle.loads(pickle.dumps(tri))]
    for other in others:
        assert other.npoints == 70
        other.move(other.points)
        assert other.nvertices == 69
    assert tri.npoints == 73


def test_damaged_data_are_refused(tri, tmp_path):
    data = bytearray(tri.tobytes())
    data[len(data) // 2] ^= 1
    with pytest.raises(deldrift.InvalidData):
        deldrift.frombytes(data)
    (tmp_path / "damaged").write_bytes(data)
    with pytest.raises(deldrift.InvalidData):
        deldrift.load(tmp_path / "damaged")
    with pytest.raises(OSError, match="nowhere"):
        deldrift.load(tmp_path / "nowhere")
    with pytest.raises(deldrift.FileError, match="nowhere"):
        tri.save(tmp_path / "nowhere" / "file")


def test_vtu(tri, tmp_path):
    fields = {"speed": np.arange(70.0), "velocity": np.ones((70, 3))}
    tri.write_vtu(tmp_path / "a.vtu", fields, {"volume": tri.volumes()})
    head = (tmp_path / "a.vtu").read_bytes().split(b"<AppendedData")[0] + b"</VTKFile>"
    root = xml.etree.ElementTree.fromstring(head)
    names = {array.get("Name") for array in root.iter("DataArray")}
    assert names >= {"speed", "velocity", "volume", "vertex", "connectivity"}
    piece = next(root.iter("Piece"))
    assert (int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))) == (69, tri.nsimplex)
    with pytest.raises(deldrift.InvalidField):
        tri.write_vtu(tmp_path / "a.vtu", {"vertex": np.arange(70.0)})
    with pytest.raises(deldrift.WrongCount, match="there are 70 ids"):
        tri.write_vtu(tmp_path / "a.vtu", {"speed": np.arange(69.0)})


def test_vtu_is_read_by_meshio(tri, tmp_path, rng):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    velocity, heat = rng.random((70, 3)), rng.random((tri.nsimplex, 2))[:, 1]
    tri.write_vtu(tmp_path / "a.vtu", {"velocity": velocity}, {"heat": heat})
    mesh = meshio.read(tmp_path / "a.vtu")
    ids = mesh.point_data["vertex"].ravel()
    np.testing.assert_array_equal(mesh.points[:, : tri.ndim], tri.points[ids])
    np.testing.assert_array_equal(mesh.point_data["velocity"], velocity[ids])
    np.testing.assert_array_equal(ids[mesh.cells[0].data], tri.simplices)
    np.testing.assert_array_equal(mesh.cell_data["heat"][0].ravel(), heat)


def test_medit(tri, tmp_path):
    tri.write_medit(tmp_path / "a.mesh")
    words = (tmp_path / "a.mesh").read_text().split()
    assert int(words[words.index("Vertices") + 1]) == 69


def test_references_of_medit_are_read_by_meshio(tri, tmp_path):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed")
    own = np.arange(tri.nsimplex) - 5
    for given, expected in ((None, 1), (own, own), (-9, -9)):
        tri.write_medit(tmp_path / "a.mesh", given)
        mesh = meshio.read(tmp_path / "a.mesh")
        assert len(mesh.cells) == 1 and (mesh.cell_data["medit:ref"][0] == expected).all()
    with pytest.raises(deldrift.WrongCount, match="references has 2 entries"):
        tri.write_medit(tmp_path / "a.mesh", [1, 2])


def test_meshio(tri):
    pytest.importorskip("meshio", reason="meshio is not installed")
    mesh = tri.to_meshio()
    assert len(mesh.points) == 69
    np.testing.assert_array_equal(mesh.point_data["vertex"][mesh.cells[0].data], tri.simplices)


def test_plot(rng):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    tri = deldrift.Delaunay(rng.random((70, 2)))
    tri.remove(5)
    figure, ax = plt.subplots()
    assert tri.plot(ax, color="black") is ax
    drawn = np.concatenate([line.get_xydata() for line in ax.lines])
    drawn = {tuple(point) for point in drawn.tolist() if np.isfinite(point).all()}
    assert drawn == {tuple(point) for i, point in enumerate(tri.points.tolist()) if i != 5}
    assert deldrift.Delaunay([[0, 0], [1, 1]]).plot() is not None
    plt.close("all")
    with pytest.raises(deldrift.InvalidDimension):
        deldrift.Delaunay(rng.random((9, 3))).plot()
