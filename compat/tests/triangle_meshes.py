"""Refined meshes of random domains: what the switches promise, and how many triangles Triangle has.

triangle_meshes.py LIBRARY [FIRST COUNT]: libdeldrift_triangle_tetgen.so, and which of the random domains.

The domain without refinement, which triangle_graphs.py compares with Triangle, is what a mesh is checked against:
areas of regions, chains that cover segments, their markers. Attributes are linear functions of places, so those of
new points are known. Triangle's mesh of the same domain has the same areas of regions, and says how many triangles
there may be, and how small angles may be that segments at a small angle bring about.
"""

import collections
import ctypes
import re
import sys

import numpy
import triangle.core
from triangle_graphs import KINDS, Graph, check_delaunay, does_end
from triangle_original import call
from triangle_rounding import Different, check, have_same_areas, rows

TOLERANCE = 1e-9
MOST = 1.1  # times as many triangles as Triangle, over all
SWITCHES = ["pq", "pqa", "pq30a0.01", "pa0.01", "pqa0.004D", "pD", "pq28D", "pqa0.01Y", "pq25YY", "pqa0.001S40",
            "pcqa0.02", "pAaq", "pAqa0.005", "qa0.01", "pq33", "pAqaD"]


def corners_of(out, first):
    numbers = rows(out.trianglelist, out.numberoftriangles, 3).astype(int) - first
    return numbers, rows(out.pointlist, out.numberofpoints, 2)[numbers]


def areas_of(corners):
    (x, y), (other_x, other_y) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return (x * other_y - y * other_x) / 2


def least_angles(corners):
    """In degrees, of each triangle."""
    sides = [corners[:, (k + 2) % 3] - corners[:, (k + 1) % 3] for k in range(3)]
    angles = []
    for k in range(3):
        a, b = sides[(k + 1) % 3], -sides[(k + 2) % 3]
        cross = numpy.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        angles.append(numpy.degrees(numpy.arctan2(cross, (a * b).sum(axis=1))))
    return numpy.min(angles, axis=0)


def number_behind(switch, switches, default):
    found = re.search(switch + r"([0-9.]*)", switches)
    return None if not found else float(found[1]) if found[1] else default


def segments_of(out, first):
    ends = rows(out.segmentlist, out.numberofsegments, 2).astype(int) - first
    markers = rows(out.segmentmarkerlist, out.numberofsegments, 1).ravel().tolist()
    return {tuple(sorted(row)): marker for row, marker in zip(ends.tolist(), markers)}


def check_chains(plain, out, first, scale):
    """Each segment is a chain of pieces with its marker, and each piece is in one chain. The pieces of each segment."""
    points = rows(out.pointlist, out.numberofpoints, 2)
    n_given = plain.numberofpoints
    pieces, markers = segments_of(out, first), rows(out.pointmarkerlist, out.numberofpoints, 1).ravel()
    at = collections.defaultdict(set)
    for a, b in pieces:
        at[a].add(b)
        at[b].add(a)
    used, chains = set(), {}
    for (start, end), marker in segments_of(plain, first).items():
        along = (points[end] - points[start]) / numpy.hypot(*(points[end] - points[start]))
        chain = [start]
        while chain[-1] != end:
            def distance(other):
                relative = points[other] - points[start]
                is_on = abs(relative[0] * along[1] - relative[1] * along[0]) <= TOLERANCE * scale
                ahead = (points[other] - points[chain[-1]]) @ along
                return ahead if is_on and ahead > 0 and (other == end or other >= n_given) else numpy.inf
            following = min(at[chain[-1]], key=distance)
            check(distance(following) < numpy.inf, f"a chain from {start} to {end}")
            piece = tuple(sorted((chain[-1], following)))
            check(pieces[piece] == marker, f"marker of piece {piece}")
            used.add(piece)
            chain.append(following)
        check(all(markers[point] == marker for point in chain[1:-1]), "markers of points on segments")
        chains[start, end] = chain
    check(used == set(pieces), "pieces of no segment")
    on_segments = {point for chain in chains.values() for point in chain}
    inside = [i for i in range(n_given, out.numberofpoints) if i not in on_segments]
    check((markers[inside] == 0).all(), "markers of points inside")
    return chains


def boundary_of(numbers):
    counts = collections.Counter(tuple(sorted((row[k], row[k - 1]))) for row in numbers.tolist() for k in range(3))
    return {pair for pair, count in counts.items() if count == 1}


def check_lists(out, dual, first, numbers, corners):
    """Neighbours, edges with markers, and circumcentres."""
    neighbours = rows(out.neighborlist, out.numberoftriangles, 3).astype(int)
    pieces, edges = segments_of(out, first), {}
    for c, row in enumerate(numbers.tolist()):
        for k in range(3):
            edges.setdefault(tuple(sorted((row[k - 1], row[k - 2]))), []).append(c)
            other = neighbours[c, k]
            check(other == -1 or {row[k - 1], row[k - 2]} <= set(numbers[other - first].tolist()), "neighbours")
    check(all(len(cells) <= 2 for cells in edges.values()), "an edge of three triangles")
    check((neighbours == -1).sum() == sum(len(cells) == 1 for cells in edges.values()), "sides without neighbour")
    ends = rows(out.edgelist, out.numberofedges, 2).astype(int) - first
    names = [tuple(sorted(row)) for row in ends.tolist()]
    check(len(names) == len(set(names)) and set(names) == set(edges), "edges")
    markers = rows(out.edgemarkerlist, len(names), 1).ravel().tolist()
    check([pieces.get(name, 0) for name in names] == markers, "markers of edges")
    centres = rows(dual.pointlist, dual.numberofpoints, 2)
    distances = numpy.hypot(*(corners - centres[:, None]).transpose(2, 0, 1))
    check(numpy.allclose(distances, distances[:, :1], rtol=1e-6), "circumcentres")


def check_limits(switches, out, numbers, corners, attributes, regions, chains, n_before):
    areas, added = areas_of(corners), out.numberofpoints - n_before
    check((areas > 0).all(), "orientation")
    limit = number_behind("S", switches, 0)
    check(limit is None or added <= limit, f"{added} points added")
    if limit is not None:
        return
    greatest = number_behind("a", switches, numpy.inf)
    is_kept = "Y" in switches
    if greatest is not None and not is_kept:
        check(areas.max(initial=0) <= greatest * (1 + TOLERANCE), "greatest area")
        if "A" in switches and "a" in re.sub(r"a[0-9.]+", "", switches):
            bounds = {}  # of regions with one attribute the largest
            for _, _, key, bound in regions.tolist():
                bounds[key] = max(bounds.get(key, 0), bound if bound > 0 else numpy.inf)
            greatest_areas = {key: areas[attributes == key].max(initial=0) for key in bounds}
            check(all(greatest_areas[key] <= bound * (1 + TOLERANCE) for key, bound in bounds.items()),
                  "greatest area of a region")
    boundary = boundary_of(numbers)
    for chain in chains.values() if is_kept else ():
        is_outer = tuple(sorted(chain[:2])) in boundary
        check(len(chain) == 2 or ("YY" not in switches and not is_outer), "a segment that is to be whole")


def check_conforming(out, numbers, first, tally):
    """All edges but the boundary's are Delaunay, segments or not, and no corner is in the circle around a segment."""
    points = rows(out.pointlist, out.numberofpoints, 2)
    pieces, encroached = segments_of(out, first), set()
    for row in numbers.tolist():
        for k in range(3):
            piece = tuple(sorted((row[k - 1], row[k - 2])))
            if piece in pieces:
                a, b = points[row[k - 1]] - points[row[k]], points[row[k - 2]] - points[row[k]]
                if a @ b < -1e-9 * (numpy.hypot(*a) * numpy.hypot(*b)):
                    encroached.add(piece)
    tally["segments with D"] += len(pieces)
    check(not encroached, f"points in the circles of {len(encroached)} segments")
    check_delaunay(out, points, first, {(a + first, b + first) for a, b in boundary_of(numbers)})


def check_mesh(functions, switches, arguments, tally):
    points, _, markers, lists = arguments
    first, scale = 1, float(numpy.abs(points).max())
    attributes = numpy.stack([points @ (1, 2), 3 - points @ (0.5, 1)], 1)
    arguments = points, attributes, markers, lists
    unrefined = "Q" + re.sub(r"[qaDS][0-9.]*|Y", "", switches) + ("c" if "p" not in switches else "")
    plain, _ = call(functions[0], unrefined, *arguments)
    (out, dual), (other, _) = (call(function, "Qnev" + switches, *arguments) for function in functions)
    if "p" not in switches:  # there are no lists of segments, but the edges of the hull have markers
        out, dual = call(functions[0], "Qnevc" + switches, *arguments)
    n_before = plain.numberofpoints
    check((rows(out.pointlist, out.numberofpoints, 2)[:n_before] == rows(plain.pointlist, n_before, 2)).all(), "places")
    check(have_same_areas((plain, out), scale, first), "areas of regions")
    check(have_same_areas((other, out), scale, first), "areas of regions in Triangle")
    numbers, corners = corners_of(out, first)
    chains = check_chains(plain, out, first, scale)
    all_points = rows(out.pointlist, out.numberofpoints, 2)
    linear = numpy.stack([all_points @ (1, 2), 3 - all_points @ (0.5, 1)], 1)
    of_points = rows(out.pointattributelist, out.numberofpoints, 2)
    check(numpy.allclose(of_points, linear, atol=1e-9), "attributes of points")
    of_triangles = rows(out.triangleattributelist, out.numberoftriangles, 1).ravel()
    check_lists(out, dual, first, numbers, corners)
    regions = lists.get("regionlist", numpy.zeros((0, 4)))
    check_limits(switches, out, numbers, corners, of_triangles, regions, chains, n_before)
    if "D" in switches:
        check_conforming(out, numbers, first, tally)
    check_delaunay(out, all_points, first)
    if len(numbers):
        compare_angles(switches, corners, corners_of(other, first)[1], tally)
    if "p" in switches and 0 < other.numberoftriangles < 300:
        check_given(functions, other, scale, first, tally)


def check_given(functions, mesh, scale, first, tally):
    """Triangle's mesh, refined by both: points and what is covered stay, and areas are those given for triangles."""
    numbers, corners = corners_of(mesh, first)
    areas = areas_of(corners)
    greatest = numpy.where(numpy.arange(len(areas)) % 3 == 0, -1, areas / 3)
    points = rows(mesh.pointlist, mesh.numberofpoints, 2).copy()
    lists = {"trianglelist": (numbers + first).astype(numpy.intc), "trianglearealist": greatest}
    if mesh.numberofsegments > 0 and mesh.segmentlist:
        lists["segmentlist"] = rows(mesh.segmentlist, mesh.numberofsegments, 2).astype(numpy.intc)
        lists["segmentmarkerlist"] = rows(mesh.segmentmarkerlist, mesh.numberofsegments, 1).astype(numpy.intc)
    arguments = points, numpy.zeros((len(points), 0)), numpy.zeros(len(points), numpy.intc), lists
    if not does_end(functions[1], ("Qrpneqa", *arguments)):
        tally["Triangle fails at r"] += 1
        return
    (out, _), (other, _) = (call(function, "Qrpneqa", *arguments) for function in functions)
    check((rows(out.pointlist, out.numberofpoints, 2)[: len(points)] == points).all(), "places with r")
    fine, other_fine = areas_of(corners_of(out, first)[1]), areas_of(corners_of(other, first)[1])
    check(fine.min() > 0 and abs(fine.sum() - areas.sum()) <= TOLERANCE * scale**2, "the area with r")
    centres = corners_of(out, first)[1].mean(axis=1)
    for triangle, most in zip(corners, greatest):
        sides = [numpy.stack([triangle[k], triangle[(k + 1) % 3]]) for k in range(3)]
        signs = [(b - a)[0] * (centres - a)[:, 1] - (b - a)[1] * (centres - a)[:, 0] for a, b in sides]
        inside = (numpy.min(signs, axis=0) > TOLERANCE * scale**2)
        check(most < 0 or (fine[inside] <= most * (1 + TOLERANCE)).all(), "an area with r")
    pieces, other_pieces = segments_of(out, first), segments_of(other, first)
    check(set(pieces.values()) == set(other_pieces.values()), "markers with r")
    check_delaunay(out, rows(out.pointlist, out.numberofpoints, 2), first)
    tally["own with r"] += len(fine)
    tally["Triangle's with r"] += len(other_fine)


def compare_angles(switches, corners, other_corners, tally):
    angle = number_behind("q", switches, 20.0)
    if angle is not None and "Y" not in switches and "S" not in switches:
        least, other_least = least_angles(corners), least_angles(other_corners)
        tally["own below q"] += int((least < angle - 1e-6).sum())
        tally["Triangle's below q"] += int((other_least < angle - 1e-6).sum())
        bound = min(angle - 1e-6, 0.5 * other_least.min())
        check(least.min() >= bound, f"least angle {least.min()}, {other_least.min()}")
    tally["own"] += len(corners)
    tally["Triangle's"] += len(other_corners)


def main(library, first=0, count=150):
    functions = ctypes.CDLL(library).triangulate, ctypes.CDLL(triangle.core.__file__).triangulate
    tally, failures = collections.Counter(), 0
    for seed in range(int(first), int(first) + int(count)):
        random = numpy.random.default_rng(seed)
        kind = KINDS[seed % 2]  # domains, with slits or without
        switches = SWITCHES[int(random.integers(len(SWITCHES)))]
        graph = Graph(random)
        kind(graph)
        arguments = graph.finish(switches)
        if "regionlist" in arguments[3]:
            arguments[3]["regionlist"][:, 3] = random.choice([0, 0.01, 0.001], len(graph.regions))
        if not does_end(functions[1], ("Q" + switches, *arguments)):
            tally["Triangle fails"] += 1
            continue
        try:
            check_mesh(functions, switches, arguments, tally)
        except Different as difference:
            failures += 1
            print(f"{kind.__name__} {seed}, {switches}: {difference}", file=sys.stderr)
    print(f"{count} domains: {', '.join(f'{name}: {n}' for name, n in sorted(tally.items()))}")
    check_sums(tally)
    if failures:
        sys.exit(f"{failures} of {count} meshes are wrong")


def check_sums(tally):
    if tally["own"] > MOST * tally["Triangle's"]:
        sys.exit("more triangles than Triangle has")


if __name__ == "__main__":
    main(*sys.argv[1:])
