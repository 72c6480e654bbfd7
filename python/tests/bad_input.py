"""Calls with wrong arguments, and the table of what comes of them: `python tests/bad_input.py` writes BAD_INPUT.md.

Each call is evaluated with a triangulation `tri` of the plane that has the ids 0 to 6: vertex 5 is hidden by vertex 4,
and vertex 6 has been removed. `bound` has segments around a square and one inside, and `mesh` is the mesh of the square.
"""

import pathlib

import numpy as np

import deldrift

PAGE = pathlib.Path(__file__).resolve().parent.parent / "BAD_INPUT.md"

CALLS = (
    """
Delaunay([1, 2, 3])
Delaunay([[0], [1]])
Delaunay(np.zeros((5, 4)))
Delaunay([[0, 0], [1, nan]])
Delaunay([[0, 0], [inf, 1]])
Delaunay([[0, 0], [1, 2e57]])
Delaunay(np.ma.masked_all((3, 2)))
Delaunay([["a", "b"]])
Delaunay([[0, 1j]])
Delaunay([[0, 0], [1, None]])
Delaunay(None)
Delaunay(POINTS, furthest_site=True)
Delaunay(POINTS, qhull_options="QJ Pp")
Delaunay(POINTS, qhull_options="Qu")
Delaunay(POINTS, algorithm="fast")
Delaunay(POINTS, threads=-1)
Delaunay(POINTS, threads=1.5)
Delaunay(POINTS, coincidence="ignore")
Delaunay(POINTS, passing="merge")
Delaunay([[0, 0], [1, 0], [0, 0]], coincidence="reject")
Delaunay(POINTS, progress=3)
Delaunay(POINTS, cancel=3)
Delaunay(POINTS, segments=[0, 1])
Delaunay(POINTS, segments=[[0, 1, 2]])
Delaunay(POINTS, segments=[[0, 3]])
Delaunay(POINTS, segments=[[0, -1]])
Delaunay(POINTS, segments=[[0, 0.5]])
Delaunay(POINTS, segments=np.ma.masked_all((1, 2), int))
Delaunay(POINTS, segments=[[0, 0]])
Delaunay(POINTS, segments=3)
Delaunay(POINTS, segments=[[0, 1]], segment_markers=[1, 2])
Delaunay(POINTS, segments=[[0, 1]], segment_markers=[1 << 31])
Delaunay(POINTS, segments=[[0, 1]], segment_markers=[0.5])
Delaunay(POINTS, segments=[[0, 1]], segment_markers=np.ma.masked_all(1, int))
Delaunay(POINTS, segments=[[0, 1]], segment_markers=[[1]])
Delaunay(POINTS, segment_markers=[1])
Delaunay(np.eye(3), segments=[[0, 1]])
load("nowhere/file")
load("a\\0b")
load(POINTS)
load("nowhere/file", algorithm="fast")
frombytes(b"deldrift")
frombytes(b"")
frombytes("deldrift")
frombytes(3)
tsearch(tri, [1, 2, 3])
orientation([[0, 0], [1, 0]])
orientation([[0, 0], [1, 0], [0, nan]])
in_sphere([[0, 0], [1, 0], [0, 1]])
in_sphere(np.zeros((6, 4)))
is_current(np.zeros(3))
tri.move(POINTS)
tri.move(np.zeros((7, 3)))
tri.move([[nan, 0]], ids=[3])
tri.move([[0, 0], [1, inf]], ids=[3, 2])
tri.move([[0, 0]], ids=[7])
tri.move([[0, 0]], ids=[-1])
tri.move([[0, 0]], ids=[1 << 40])
tri.move([[0, 0]], ids=[6])
tri.move([[0, 0], [1, 1]], ids=[3, 3])
tri.move([[0, 0], [1, 1]], ids=[3])
tri.move([[0, 0]], ids=[0.5])
tri.move([[0, 0]], ids=3)
tri.move([[0, 0]], ids=np.ma.masked_all(1, int))
in_step(tri, lambda step: step.move(POINTS))
in_step(tri, lambda step: step.move([[0, 0]], ids=[9]))
in_step(tri, lambda step: (step.move([[0, 0]], [1]), step.move([[0, 0]], [1])))
in_step(tri, lambda step: (step.remove([1]), step.move([[0, 0]], [1])))
in_step(tri, lambda step: step.insert([[0, nan]]))
in_step(tri, lambda step: step.insert([0, 1]))
in_step(tri, lambda step: step.remove([6]))
in_step(tri, lambda step: step.remove([1, 1]))
in_step(tri, lambda step: step.remove([99]))
in_step(tri, lambda step: tri.relocate(1, [0, 0]))
in_step(tri, lambda step: (step.insert([[2, 2]]), tri.star(7)))
in_step(tri, lambda step: step.add_segments([[0, 9]]))
in_step(tri, lambda step: step.add_segments([[0, 1], [6, 2]]))
in_step(tri, lambda step: step.add_segments([[0, 1]], markers=[1, 2]))
in_step(bound, lambda step: step.remove_segments([9]))
in_step(bound, lambda step: step.remove_segments([3, 3]))
in_step(bound, lambda step: step.remove_segments([-1]))
in_step(bound, lambda step: step.add_segments([[1, 3]]))
in_step(bound, lambda step: step.remove([0]))
in_step(bound, lambda step: bound.check(SQUARE))
tri.step().move([[0, 0]], [1])
tri.step().add_segments([[0, 1]])
tri.step().remove_segments([0])
tri.step().check()
tri.step().split()
in_step(tri, lambda step: step.split(limit=-1))
in_step(tri, lambda step: step.split(limit=0.5))
in_step(space, lambda step: step.split())
in_step(tri, lambda step: (step.add_segments([[0, 2], [1, 3]]), step.split(limit=0)))
tri.add_segments([[0, 2], [1, 3]])
tri.add_segments([[0, 7]])
tri.add_segments([[0, 1]], markers=[1 << 40])
tri.add_segments([[4, 5]])
space.add_segments([[0, 1]])
tri.remove_segments([0])
tri.remove_segments([0.5])
bound.remove_segments([[0]])
space.remove_segments([0])
tri.check(POINTS)
tri.check([[nan, 0]], ids=[3])
tri.check([[0, 0], [1, 1]], ids=[3, 3])
bound.move([[2, 0]], ids=[4])
bound.move([[4, 0]], ids=[0])
bound.relocate(4, [2, 0])
bound.remove(0)
tri.relocate(7, [0, 0])
tri.relocate(-1, [0, 0])
tri.relocate(6, [0, 0])
tri.relocate(1.5, [0, 0])
tri.relocate(1, [0, nan])
tri.relocate(1, [0, 0, 0])
tri.insert([0, 2e57])
tri.insert([[0, 0]])
tri.remove(7)
tri.remove(6)
tri.remove("1")
tri.add_points([[0, inf]])
tri.add_points([0, 1])
setattr(tri, "algorithm", "fast")
setattr(tri, "algorithm", 3)
tri.is_present(0.5)
tri.representative(6)
tri.tolerance(7)
tri.star(7)
tri.star(6)
space.star(0, ordered=True)
tri.validate(4)
tri.validate("all")
tri.find_simplex([[nan, 0]])
tri.find_simplex([1, 2, 3])
tri.find_simplex([1, 2], tol=-1)
tri.find_simplex([1, 2], tol=nan)
tri.locate([[0, 0], [0, inf]])
tri.locate(3)
tri.nearest_vertices([[0, nan]])
tri.nearest_vertices([0, 1], k=-1)
tri.vertices_in_ball([0, 0], -1)
tri.vertices_in_ball([0, nan], 1)
tri.vertices_in_ball([0, 0], "1 m")
tri.vertices_in_box([0, nan], [1, 1])
tri.vertices_in_box([0, 0, 0], [1, 1])
tri.conflicts([nan, 1])
tri.simplices_with([0, 1])
tri.simplices_with([[0, 99]])
tri.simplices_with([[0, 1], [6, 0]])
tri.simplices_with([[0, 1, 2, 3]])
tri.simplices_with(np.empty((2, 0), int))
tri.barycentric([[0, nan]])
tri.barycentric([[0, 0]], simplices=[99])
tri.barycentric([[0, 0]], simplices=[-2])
tri.barycentric([[0, 0]], simplices=[0, 1])
tri.lift_points([1, 2, 3])
tri.plane_distance([1, 2, 3])
tri.alpha_mask(-1)
tri.alpha_mask(nan)
tri.alpha_mask("all")
tri.mask_without_flat(-1)
tri.boundary([True])
tri.boundary(np.zeros(TRIANGLES, float))
tri.boundary(True)
tri.boundary_chains([True])
tri.boundary_chains(np.zeros(TRIANGLES, float))
space.boundary_chains()
bound.label_cells([[2, 0.5], [1, 1], [2, nan]], [1, 2, 3])
bound.label_cells([[2, 0.5], [1, 1]], [1, 2])
bound.label_cells([2, 1], [1])
tri.label_cells([[2, 1]], [1, 2])
tri.label_cells([[2, 1]], ["a"])
tri.label_cells([[2, 1]], [1], other=0.5)
tri.label_cells([[2, 1]], [1], other=1 << 31)
space.label_cells([[0, 0, 0]], [1])
space.nesting_levels()
space.segments_of_cells()
space.cells_of_segments()
bound.refine(least_angle=35)
bound.refine(greatest_area=-1)
bound.refine(greatest_area="small")
bound.refine(areas=[0, -1])
bound.refine(areas=3)
bound.refine(labels=[1, 2])
bound.refine(sizes=[1, 2])
bound.refine(sizes=0)
bound.refine(sizes=[1, 1, 1, nan, 1])
bound.refine(is_too_large=3)
bound.refine(is_too_large=lambda corners: float("wide"))
bound.refine(mask=[True])
tri.refine(greatest_area=1, mask=np.ones(TRIANGLES, bool))
bound.refine(keep="some")
bound.refine(limit=-1)
bound.refine(values=[1, 2])
bound.refine(values={"heat": 3})
space.refine(greatest_area=1)
bound.coarsen(margin=31)
bound.coarsen(share=0)
bound.coarsen(joins=2)
space.coarsen()
tri.simplices_around([99])
tri.simplices_around([6])
tri.update_volumes([99], np.zeros(TRIANGLES))
tri.update_volumes([-1], np.zeros(TRIANGLES))
tri.update_volumes([0], np.zeros(1))
tri.update_volumes([0], [0.0] * TRIANGLES)
tri.update_circumcentres([99], np.zeros((TRIANGLES, 2)), np.zeros(TRIANGLES))
tri.update_circumcentres([0], np.zeros((TRIANGLES, 3)), np.zeros(TRIANGLES))
tri.update_alpha_mask([99], 1, np.zeros(TRIANGLES, bool))
tri.update_alpha_mask([0], -1, np.zeros(TRIANGLES, bool))
tri.voronoi_volumes(([0, 0], [0, 1]))
tri.voronoi_volumes(3)
tri.voronoi_volumes(([0, 0], [1, nan]))
tri.voronoi_facets(([0, 0], [-1, 1]))
tri.voronoi_cells(([0, 0], [1, 1]), mask=[True])
tri.voronoi_derivatives(([0, 0], [0, 1]))
tri.interpolate([1, 2], [[0, 0]])
tri.interpolate(np.zeros(7), [[0, nan]])
tri.interpolate(np.zeros(7), [[0, 0]], method="cubic")
tri.interpolate(np.zeros(7), [[0, 0]], fill_value=[1, 2])
tri.interpolate(3, [[0, 0]])
tri.save("nowhere/file")
tri.save(3)
tri.write_vtu("nowhere/file")
tri.write_vtu("file", {"speed": [1, 2]})
tri.write_vtu("file", {"vertex": np.zeros(7)})
tri.write_vtu("file", {"a\\0b": np.zeros(7)})
tri.write_vtu("file", None, {"speed": np.zeros(1)})
tri.write_medit("nowhere/file")
tri.write_medit("file", [1, 2])
tri.write_medit("file", 1 << 31)
tri.write_medit("file", [[1]])
tri.write_medit("file", "a")
bound.write_vtu("file", None, {"marker": np.zeros(bound.nsimplex)})
space.plot()
Mesh([[0, 0, 0]], [[0, 1]])
Mesh([[0, 0], [1, nan]], [[0, 1]])
Mesh(SQUARE, [[0, 9]])
Mesh(SQUARE, [[0, 1, 2]])
Mesh(SQUARE, None)
Mesh(SQUARE, [[0, 2], [1, 3]])
Mesh(SQUARE, AROUND, markers=[1])
Mesh(SQUARE, AROUND, holes=[1, 2])
Mesh(SQUARE, AROUND, holes=[[nan, 2]])
Mesh(SQUARE, AROUND, holes=[[1, 2], ["a", 2]])
Mesh(SQUARE, AROUND + [[0, 2]], holes=[[1, 2], [2, 2]])
Mesh(SQUARE, AROUND, regions=[[1, 2]])
Mesh(SQUARE, AROUND + [[0, 2]], regions=[[2, 2, 1]])
Mesh(SQUARE, AROUND, algorithm="fast")
Mesh.from_triangle(SQUARE)
Mesh.from_triangle({"vertices": SQUARE})
Mesh.from_triangle({"vertices": SQUARE, "segments": AROUND, "regions": [[1, 1, 1]]})
Mesh.from_triangle({"vertices": SQUARE, "segments": AROUND, "segment_markers": [[1, 2]]})
mesh.move(POINTS)
mesh.move([[9, 9]], ids=[7])
mesh.move([[2, 0]], ids=[4])
mesh.advance([[2, inf]], ids=[4])
mesh.advance([[2, 0]], ids=[4], cut=1)
mesh.advance([[2, 0]], ids=[4], cut="a half")
mesh.advance([[2, 0]], ids=[4], least=0)
mesh.advance([[2, 0]], ids=[4], least=1)
Mesh.from_triangle({"vertices": SQUARE, "segments": AROUND}, "pq30D")
Mesh.from_triangle({"vertices": SQUARE, "segments": AROUND}, 3)
mesh.refine(areas=[1])
mesh.refine(areas={7: 1})
mesh.refine(areas={0: -1})
mesh.refine(least_angle=nan)
mesh.coarsen(share=2)
closed(tri).move(np.zeros((7, 2)))
closed(tri).add_segments([[0, 1]])
closed(tri).add_points([[0, 0]])
""".strip()
    .replace("\\\\", "\\")
    .splitlines()
)


SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [2, 1]]
AROUND = [[0, 1], [1, 2], [2, 3], [3, 0]]


def make():
    """What calls are made with, by name."""
    space = deldrift.Delaunay(np.vstack([np.zeros(3), np.eye(3)]))
    bound = deldrift.Delaunay(SQUARE, segments=AROUND + [[0, 2]])
    return {"tri": make_tri(), "space": space, "bound": bound, "mesh": deldrift.Mesh(SQUARE, AROUND)}


def make_tri():
    tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1], [1, 1], [2, 2]])
    tri.remove(6)
    return tri


def in_step(tri, use):
    with tri.step() as step:
        use(step)


def closed(tri):
    tri.close()
    return tri


def call(text, made):
    """The exception that a call raises with what `make` has made."""
    names = {name: getattr(deldrift, name) for name in deldrift.__all__}
    names.update(made, np=np, nan=np.nan, inf=np.inf, in_step=in_step, closed=closed)
    names.update(SQUARE=SQUARE, AROUND=AROUND)
    names.update(POINTS=[[0, 0], [1, 0], [0, 1]], TRIANGLES=made["tri"].nsimplex)
    try:
        eval(text, names)
    except Exception as error:
        return error
    raise AssertionError(f"{text} raises nothing")


def row(text):
    error = call(text, make())
    base = next(kind.__name__ for kind in type(error).__mro__ if kind.__module__ == "builtins")
    kind = type(error).__name__ if base == type(error).__name__ else f"{type(error).__name__} ({base})"
    place = ""
    if isinstance(error, deldrift.Error) and error.argument is not None:
        place = ", ".join(str(part) for part in (error.argument, error.index, error.value) if part is not None)
    cells = f"`{text}`", kind, str(error), place
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def page():
    lines = [
        "# What comes of wrong input",
        "",
        f"{len(CALLS)} wrong calls, each with the exception, the builtin one that it is as well, its message, and its",
        "attributes `argument`, `index` and `value`. Every function and method with an argument is among them. None",
        "changes the triangulation. [tests/bad_input.py](tests/bad_input.py) writes this page, and a test compares it.",
        "",
        "`tri` has the ids 0 to 6: vertex 5 is at the place of vertex 4, and vertex 6 has been removed. `space` is a",
        "tetrahedron. `bound` is a square `SQUARE` with the vertex 4 inside, segments `AROUND` it, and one from corner 0",
        "to corner 2; `mesh` is the mesh of the square.",
        "",
        "| call | exception | message | argument, index, value |",
        "|---|---|---|---|",
    ]
    return "\n".join(lines + [row(text) for text in CALLS]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page())
