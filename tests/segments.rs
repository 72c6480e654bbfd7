//! Constrained Delaunay triangulations of moving vertices: against the definition in exact integers, and against fresh
//! builds, by every algorithm.

use crate::common::exact::{Grid, is_inside, orientation, squared_distance};
use crate::common::inputs::{KINDS, Kind, QUANTUM, draw, draw_one, to_grid};
use crate::common::{Rng, assert_same_cells, cell_set, check_adjacency, seeds, sorted};
use deldrift::motion::{
    Algorithm, CoincidencePolicy, Location, MovingTriangulation, NO_CELL, Options, Saved, Segment,
};
use deldrift::{CellId, Conflict, Error, Plane, SegmentId, VertexId};
use std::collections::{BTreeMap, BTreeSet};

type Triangulation = MovingTriangulation<Plane>;

fn grid(t: &Triangulation, v: VertexId) -> Grid {
    to_grid::<Plane>(&t.position(v).expect("present"))
}

/// The segments in force, by the vertices that represent their ends.
fn edges_wanted(t: &Triangulation) -> BTreeSet<[VertexId; 2]> {
    let shown = |v| t.coincident_representative(v).expect("present");
    t.segments()
        .map(|(_, segment)| {
            let mut ends = segment.ends.map(shown);
            ends.sort();
            ends
        })
        .collect()
}

/// Checks the definition: all segments are edges, and all other edges between two cells are locally Delaunay, ties
/// broken.
fn check_definition(t: &Triangulation, context: &dyn Fn() -> String) {
    check_adjacency(t, context);
    let wanted = edges_wanted(t);
    let view = t.cells().expect("room");
    let mut edges = BTreeSet::new();
    for (cell, (row, neighbours)) in
        CellId::range(0..view.corners.len()).zip(view.corners.iter().zip(view.neighbours))
    {
        let points = row.map(|v| grid(t, v));
        assert!(orientation(&[&points[0], &points[1], &points[2]]) > 0, "{}: {row:?}", context());
        for i in 0..3 {
            let mut edge = [row[(i + 1) % 3], row[(i + 2) % 3]];
            edge.sort();
            edges.insert(edge);
            let across = neighbours[i];
            if across == NO_CELL || across < cell || wanted.contains(&edge) {
                continue;
            }
            let apex = view.corners[across].into_iter().find(|v| !row.contains(v)).expect("an apex");
            let q = grid(t, apex);
            let ids = [row[0], row[1], row[2], apex];
            let inside = is_inside(&[&points[0], &points[1], &points[2], &q], &ids);
            assert!(!inside, "{}: edge {edge:?} is not Delaunay", context());
        }
    }
    if !view.corners.is_empty() {
        for edge in wanted {
            assert!(edges.contains(&edge), "{}: segment {edge:?} is no edge", context());
        }
    }
}

/// Checks what is asked about places: against brute force, and an insertion.
fn check_places(t: &Triangulation, rng: &mut Rng, context: &dyn Fn() -> String) {
    t.validate(deldrift::motion::Level::Delaunay)
        .unwrap_or_else(|violation| panic!("{}: {violation:?}", context()));
    let vertices: Vec<_> =
        VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).map(|v| (v, grid(t, v))).collect();
    for _ in 0..3 {
        let q = draw_one::<Plane>(*rng.pick(&KINDS), 100, rng);
        let at = to_grid::<Plane>(&q);
        let mut order: Vec<_> = vertices.iter().map(|(v, p)| (squared_distance(p, &at), *v)).collect();
        order.sort();
        let mut found = Vec::new();
        t.nearest_vertices(&[q], 5, |v| found.push(v)).expect("a good place");
        let expected: Vec<_> = order.iter().map(|&(_, v)| v).chain([VertexId::NONE; 5]).take(5).collect();
        assert_eq!(found, expected, "{}", context());
        assert_eq!(
            t.nearest_vertex(&q).expect("room").unwrap_or(VertexId::NONE),
            expected[0],
            "{}",
            context()
        );
        let radius = order.get(order.len() / 3).map_or(0, |&(square, _)| square) as f64
            * QUANTUM
            * QUANTUM
            * (1.0 + 1e-9);
        let mut near: Vec<_> =
            order.iter().filter(|&&(s, _)| s as f64 * QUANTUM * QUANTUM <= radius).map(|&(_, v)| v).collect();
        near.sort();
        assert_eq!(
            t.vertices_in_ball(&q, radius).expect("a good ball"),
            near,
            "{} {q:?} {radius:e} {} {} {:?}",
            context(),
            t.is_constrained(),
            t.cell_count(),
            order[0]
        );
        match t.locate(&q).expect("room") {
            Location::Vertex(v) => assert_eq!(grid(t, v), at, "{}", context()),
            Location::Cell(cell) => {
                let corners = t.cells().expect("room").corners[cell].map(|v| grid(t, v));
                for i in 0..3 {
                    assert!(orientation(&[&corners[i], &corners[(i + 1) % 3], &at]) >= 0, "{}", context());
                }
            }
            Location::Outside(cell) => {
                let view = t.cells().expect("room");
                let corners = view.corners[cell].map(|v| grid(t, v));
                let sees = |i: usize| orientation(&[&corners[(i + 1) % 3], &corners[(i + 2) % 3], &at]) < 0;
                assert!((0..3).any(|i| view.neighbours[cell][i] == NO_CELL && sees(i)), "{}", context());
            }
            Location::NoCells => assert_eq!(t.cell_count(), 0, "{}", context()),
        }
        let rows = t.cells().expect("room").corners;
        let mut conflicts: Vec<_> =
            t.conflicts(&q, None).expect("a good place").iter().map(|&cell| sorted(&rows[cell])).collect();
        conflicts.sort();
        let mut grown = t.try_clone(None).expect("room");
        grown.take_changes().expect("room");
        if grown.insert_vertex(&q).is_ok() {
            let changes = grown.take_changes().expect("room");
            let mut removed: Vec<_> = changes.removed_corners.iter().map(|row| sorted(row)).collect();
            removed.sort();
            assert_eq!(conflicts, removed, "{}", context());
        }
    }
}

/// A copy, a compaction and Voronoi cells.
fn check_others(t: &Triangulation, context: &dyn Fn() -> String) {
    let mut copy = t.try_clone(None).expect("room");
    let ids = copy.compact().expect("room");
    let renamed = cell_set(t)
        .iter()
        .map(|cell| sorted(&cell.iter().map(|&v| ids[v.index()]).collect::<Vec<_>>()))
        .collect();
    assert_same_cells(&cell_set(&copy), &renamed, context);
    assert_eq!(copy.is_constrained(), t.is_constrained(), "{}", context());
    copy.validate(deldrift::motion::Level::Delaunay).expect("a valid copy");
    // The next commit puts back the cells of the Delaunay triangulation, and lays the segments again.
    if copy.id_count() > 0 {
        let v = VertexId::new(0);
        copy.move_vertices(&[v], &[copy.position(v).expect("present")]).expect("a good place");
    }
    copy.commit_timestamp().expect("no conflict");
    assert_same_cells(&cell_set(&copy), &renamed, context);
    let bytes = t.saved().expect("room");
    let saved = Saved::of(&bytes).unwrap_or_else(|damage| panic!("{}: {damage}", context()));
    let loaded = Triangulation::load(&saved, Options::default());
    let mut loaded = loaded.unwrap_or_else(|error| panic!("{}: {error}", context()));
    assert_eq!(loaded.saved().expect("room"), bytes, "{}", context());
    assert_eq!(loaded.is_constrained(), t.is_constrained(), "{}", context());
    for v in VertexId::range(0..loaded.id_count()) {
        if loaded.is_present(v) {
            let p = loaded.position(v).expect("present");
            loaded.move_vertices(&[v], &[p]).expect("a good place");
        }
    }
    loaded.commit_timestamp().expect("no conflict");
    assert_same_cells(&cell_set(&loaded), &cell_set(t), context);
    let points: Vec<_> =
        VertexId::range(0..copy.id_count()).map(|v| copy.position(v).expect("present")).collect();
    let plain = Triangulation::new(&points, Options::default()).expect("good points");
    let clip = Some([&[-100.0, -90.0], &[80.0, 110.0]]);
    let volumes = copy.voronoi_volumes(clip).expect("a box");
    for (one, other) in volumes.iter().zip(plain.voronoi_volumes(clip).expect("a box")) {
        assert!((one - other).abs() <= 1e-6 * other.abs() + 1e-6, "{}: {one}, {other}", context());
    }
    let facets = copy.voronoi_facets(clip).expect("a box");
    let edges = plain.edges().expect("room");
    let wanted = plain.voronoi_facets(clip).expect("a box");
    assert_eq!(facets.len(), copy.edge_count());
    for (edge, measure) in copy.edges().expect("room").iter().zip(facets) {
        let wanted = edges.binary_search(edge).map_or(0.0, |k| wanted[k]);
        assert!((measure - wanted).abs() <= 1e-6 * wanted + 1e-6, "{}", context());
    }
}

/// Checks the cells against those of a fresh build with the same ids.
fn check_fresh(t: &Triangulation, context: &dyn Fn() -> String) {
    let ids = VertexId::range(0..t.id_count());
    let points: Vec<_> = ids.clone().map(|v| t.position(v).unwrap_or([9e4, 9e4])).collect();
    let mut fresh = Triangulation::new(&points, Options::default()).expect("good points");
    for v in ids.filter(|&v| !t.is_present(v)) {
        fresh.remove_vertex(v).expect("present");
    }
    let segments: Vec<_> = t.segments().map(|(_, segment)| segment).collect();
    fresh.stage_segments(segments.into_iter()).expect("present");
    fresh.commit_timestamp().expect("no conflict");
    assert_same_cells(&cell_set(t), &cell_set(&fresh), context);
}

fn cross(a: &Grid, b: &Grid, c: &Grid) -> i128 {
    orientation(&[a, b, c])
}

/// Whether `p` is on the line from `a` to `b` and between them.
fn is_between(a: &Grid, b: &Grid, p: &Grid) -> bool {
    let dot = (0..2).map(|k| i128::from(a[k] - p[k]) * i128::from(b[k] - p[k])).sum::<i128>();
    cross(a, b, p) == 0 && dot < 0
}

/// All conflicts, by all pairs.
fn all_conflicts(
    ids: usize,
    place: impl Fn(VertexId) -> Option<Grid>,
    segments: &[(SegmentId, Segment)],
) -> Vec<Conflict> {
    let mut conflicts = Vec::new();
    // Vertices at one place are told by the lowest id.
    let mut lowest = BTreeMap::new();
    for v in VertexId::range(0..ids) {
        if let Some(p) = place(v) {
            lowest.entry(p).or_insert(v);
        }
    }
    let mut whole: Vec<(SegmentId, [Grid; 2])> = Vec::new();
    for &(segment, Segment { ends, .. }) in segments {
        let gone = ends.into_iter().filter(|&v| place(v).is_none());
        let n_before = conflicts.len();
        conflicts.extend(gone.map(|vertex| Conflict::EndRemoved { segment, vertex }));
        if conflicts.len() > n_before {
            continue;
        }
        let [a, b] = ends.map(|v| place(v).expect("present"));
        if a == b {
            conflicts.push(Conflict::EndsMeet { segment });
            continue;
        }
        for (p, &vertex) in &lowest {
            if is_between(&a, &b, p) {
                conflicts.push(Conflict::OnSegment { segment, vertex });
            }
        }
        for (other, [c, d]) in &whole {
            let apart = |x: i128, y: i128| x.signum() * y.signum() < 0;
            if apart(cross(&a, &b, c), cross(&a, &b, d)) && apart(cross(c, d, &a), cross(c, d, &b)) {
                conflicts.push(Conflict::Crossing { segments: [segment.min(*other), segment.max(*other)] });
            }
        }
        whole.push((segment, [a, b]));
    }
    conflicts.sort();
    conflicts.dedup();
    conflicts
}

/// Levels, labels, chains and the cells beside segments: against an index of the edges.
fn check_domain(t: &Triangulation, rng: &mut Rng, context: &dyn Fn() -> String) {
    let view = t.cells().expect("room");
    let m = view.corners.len();
    let shown = |v| t.coincident_representative(v).expect("present");
    // By directed edge: the cell on its left. By undirected edge: the lowest segment.
    let (mut left, mut at_edge) = (BTreeMap::new(), BTreeMap::new());
    for (cell, row) in CellId::range(0..m).zip(view.corners) {
        (0..3).for_each(|i| _ = left.insert([row[(i + 1) % 3], row[(i + 2) % 3]], (cell, i)));
    }
    for (id, segment) in t.segments() {
        let [v, w] = segment.ends.map(shown);
        at_edge.entry([v.min(w), v.max(w)]).or_insert(id);
    }
    let segment_at = |[v, w]: [VertexId; 2]| at_edge.get(&[v.min(w), v.max(w)]).copied();
    let beside = t.cells_of_segments().expect("room");
    for ((_, segment), sides) in t.segments().zip(beside) {
        let [v, w] = segment.ends.map(shown);
        let wanted = [[v, w], [w, v]].map(|edge| left.get(&edge).map_or(NO_CELL, |&(cell, _)| cell));
        assert_eq!(sides, wanted, "{}", context());
    }
    // Levels and regions by relaxation until nothing changes.
    let mut levels = vec![u32::MAX; m];
    let mut regions: Vec<usize> = (0..m).collect();
    loop {
        let before = (levels.clone(), regions.clone());
        for (&[v, w], &(cell, _)) in &left {
            let segment = segment_at([v, w]);
            let across = left.get(&[w, v]).map(|&(cell, _)| cell.index());
            let beyond = across.map_or(0, |cell| levels[cell]).saturating_add(u32::from(segment.is_some()));
            levels[cell.index()] = levels[cell.index()].min(beyond);
            if let (Some(across), None) = (across, segment) {
                regions[cell.index()] = regions[cell.index()].min(regions[across]);
            }
        }
        if before == (levels.clone(), regions.clone()) {
            break;
        }
    }
    assert_eq!(t.nesting_levels().expect("room"), levels, "{}", context());
    let rows = t.segments_of_cells().expect("room");
    for (&edge, &(cell, i)) in &left {
        assert_eq!(rows[cell.index()][i], segment_at(edge).unwrap_or(SegmentId::NONE), "{}", context());
    }
    if m == 0 {
        return;
    }
    let hull: Vec<[VertexId; 2]> =
        left.keys().copied().filter(|&[v, w]| !left.contains_key(&[w, v])).collect();
    let is_open = |edge: &&[VertexId; 2]| segment_at(**edge).is_none();
    let open: BTreeSet<usize> =
        hull.iter().filter(is_open).map(|edge| regions[left[edge].0.index()]).collect();
    check_labels(t, &regions, (&hull[..], &open), rng, context);
    let mask: Vec<u8> = (0..m).map(|_| u8::from(rng.one_in(2))).collect();
    let chains = t.boundary_chains(&mask).expect("a mask");
    let mut bounds = BTreeSet::new();
    for (&[v, w], &(cell, _)) in &left {
        let is_in = |cell: CellId| mask[cell.index()] != 0;
        if is_in(cell) && !left.get(&[w, v]).is_some_and(|&(across, _)| is_in(across)) {
            bounds.insert([v, w]);
        }
    }
    assert_eq!(chains.len(), bounds.len(), "{}", context());
    let mut first_edges = Vec::new();
    for chain in chains.chunk_by(|one, next| one.chain == next.chain) {
        assert_eq!(chain[0].chain as usize, first_edges.len(), "{}", context());
        let edges: Vec<_> =
            (0..chain.len()).map(|k| [chain[k].vertex, chain[(k + 1) % chain.len()].vertex]).collect();
        for (edge, told) in edges.iter().zip(chain) {
            assert!(bounds.remove(edge), "{}: {edge:?}", context());
            assert_eq!(left[edge], (told.cell, told.corner), "{}", context());
            assert_eq!(told.segment, segment_at(*edge).unwrap_or(SegmentId::NONE), "{}", context());
        }
        assert_eq!(edges.iter().min(), edges.first(), "{}", context());
        first_edges.push(edges[0]);
    }
    assert!(first_edges.is_sorted(), "{}", context());
}

/// Seeds in some cells, on edges and at vertices. There come the edges of the hull, and the regions that are one with the
/// outside, as some edge of theirs there has no segment.
fn check_labels(
    t: &Triangulation,
    regions: &[usize],
    (hull, open): (&[[VertexId; 2]], &BTreeSet<usize>),
    rng: &mut Rng,
    context: &dyn Fn() -> String,
) {
    let view = t.cells().expect("room");
    let (mut seeds, mut labels, mut expected) = (Vec::new(), Vec::new(), vec![-1; regions.len()]);
    for label in 0..3 {
        // Twice the quantum leaves room for a middle.
        let cell = rng.below(regions.len());
        let at = view.corners[CellId::at(cell)].map(|v| t.position(v).expect("present"));
        let middle = |a: [f64; 2], b: [f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
        let seed = match rng.below(4) {
            0 => at[0],
            1 => middle(at[0], at[1]),
            _ => middle(at[0], middle(at[1], at[2])),
        };
        // All cells that have the seed inside or on the boundary, in units that hold the middles.
        let unit = QUANTUM / 4.0;
        let scaled = |p: [f64; 2]| p.map(|x| (x / unit) as i64);
        let turn = |v: VertexId, w: VertexId| {
            let [[a, b], [c, d]] = [v, w].map(|v| scaled(t.position(v).expect("present")));
            let [e, f] = scaled(seed);
            i128::from(c - a) * i128::from(f - b) - i128::from(d - b) * i128::from(e - a)
        };
        let touching: BTreeSet<usize> = (0..regions.len())
            .filter(|&other| {
                let row = view.corners[CellId::at(other)];
                (0..3).all(|i| turn(row[i], row[(i + 1) % 3]) >= 0)
            })
            .collect();
        let around: BTreeSet<usize> = touching.iter().map(|&other| regions[other]).collect();
        let is_on_hull = hull.iter().any(|&[v, w]| turn(v, w) == 0);
        seeds.push(seed);
        labels.push(label);
        let told = t.label_cells(&seeds, &labels, -1);
        if around.len() > 1 || (is_on_hull && around.is_disjoint(open)) {
            assert_eq!(told, Err(Error::AmbiguousSeed { index: seeds.len() - 1 }), "{}", context());
            seeds.pop();
            labels.pop();
            continue;
        }
        for (entry, region) in expected.iter_mut().zip(regions) {
            if *entry == -1 && around.contains(region) {
                *entry = label;
            }
        }
        assert_eq!(told.expect("good seeds"), expected, "{}", context());
    }
    assert_eq!(t.label_cells(&[[9e5, 9e5]], &[4], -1).expect("a good seed"), vec![-1; regions.len()]);
}

/// A random history: segments come and go, vertices move by little or far, come and go; what conflicts is refused.
fn run(kind: Kind, algorithm: Algorithm, seed: u64) -> [usize; 3] {
    let rng = &mut Rng::new(seed);
    let n = [4, 12, 40, 120][rng.below(4)];
    let options = Options { algorithm, ..Options::default() };
    let mut t = Triangulation::new(&draw::<Plane>(kind, n, rng), options).expect("good points");
    let [mut n_laid, mut n_refused, mut n_constrained] = [0; 3];
    for step in 0..12 {
        let context = || format!("{kind:?}, {algorithm:?}, seed {seed}, step {step}");
        let before = (cell_set(&t), t.segments().collect::<Vec<_>>());
        let mut goals: Vec<Option<[f64; 2]>> =
            VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect();
        let mut segments: Vec<(SegmentId, Segment)> = t.segments().collect();
        match rng.below(3) {
            0 => {}
            how => {
                for v in VertexId::range(0..t.id_count()) {
                    if (how == 1 || rng.one_in(8)) && t.is_present(v) {
                        let p = t.position(v).expect("present");
                        let far = draw_one::<Plane>(kind, n, rng);
                        let near = if matches!(kind, Kind::Random | Kind::RoundedSphere | Kind::Clusters) {
                            crate::common::inputs::quantized::<Plane>(
                                p.map(|x| x + 1e-2 * (rng.unit() - 0.5)),
                            )
                        } else {
                            p
                        };
                        let goal = if rng.one_in(20) { far } else { near };
                        goals[v.index()] = Some(goal);
                        t.move_vertices(&[v], &[goal]).expect("good places");
                    }
                }
            }
        }
        if rng.one_in(3) {
            let goal = draw_one::<Plane>(kind, n, rng);
            t.stage_insertions(&[goal]).expect("a good place");
            goals.push(Some(goal));
        }
        if rng.one_in(4) {
            let v = VertexId::at(rng.below(before.0.len().max(1)).min(t.id_count() - 1));
            if t.is_present(v) && t.stage_removals(&[v]).is_ok() {
                goals[v.index()] = None;
            }
        }
        for _ in 0..rng.below(4) {
            let ends = [0; 2].map(|_| VertexId::at(rng.below(goals.len())));
            if ends.iter().all(|v| goals[v.index()].is_some()) {
                let segment = Segment { ends, marker: step, ..Segment::default() };
                let id = t.stage_segments([segment].into_iter()).expect("present");
                segments.push((id, segment));
            }
        }
        if rng.one_in(3)
            && let Some(&(id, _)) = before.1.get(rng.below(before.1.len().max(1)))
        {
            t.stage_segment_removals(&[id]).expect("in force");
            segments.retain(|&(other, _)| other != id);
        }
        let place = |v: VertexId| goals[v.index()].as_ref().map(to_grid::<Plane>);
        let expected = all_conflicts(goals.len(), place, &segments);
        if rng.one_in(2) {
            let checked = t.check_staged();
            assert_eq!(checked.is_ok(), expected.is_empty(), "{}: {checked:?}", context());
            assert_eq!(t.conflicts_of_segments(), expected, "{}", context());
            assert_eq!(before, (cell_set(&t), t.segments().collect::<Vec<_>>()), "{}", context());
        }
        match t.commit_timestamp() {
            Ok(_) => {
                n_laid += t.segments().count();
                n_constrained += usize::from(t.is_constrained());
            }
            Err(Error::Conflict { .. }) => n_refused += 1,
            Err(error) => panic!("{}: {error}", context()),
        }
        assert_eq!(t.conflicts_of_segments(), expected, "{}", context());
        if !expected.is_empty() {
            t.discard_moves();
            assert_eq!(before, (cell_set(&t), t.segments().collect::<Vec<_>>()), "{}", context());
        }
        check_definition(&t, &context);
        check_fresh(&t, &context);
        check_places(&t, rng, &context);
        check_domain(&t, rng, &context);
        check_others(&t, &context);
    }
    [n_laid, n_refused, n_constrained]
}

#[test]
fn segments_are_kept_through_random_histories() {
    let mut sums = [0; 3];
    for seed in seeds(6) {
        for kind in KINDS {
            for algorithm in [
                Algorithm::Auto,
                Algorithm::Rebuilding,
                Algorithm::PlacementFlips,
                Algorithm::Tolerance,
                Algorithm::Repair,
            ] {
                let counts = run(kind, algorithm, 1000 * seed + kind as u64);
                sums.iter_mut().zip(counts).for_each(|(sum, n)| *sum += n);
            }
        }
    }
    println!("{sums:?} laid, refused, constrained");
    assert!(sums.iter().all(|&n| n > 100), "{sums:?}");
}

/// A long segment through a lattice, beside which vertices are in cells that it crosses twice.
#[test]
fn conflicts_name_what_is_in_the_way() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0], [1.0, 3.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let ids = |ends: [u32; 2]| Segment { ends: ends.map(VertexId::new), marker: 7, ..Segment::default() };
    t.stage_segments([ids([0, 2]), ids([3, 1]), ids([5, 1])].into_iter()).expect("present");
    let refused = t.commit_timestamp().expect_err("there are conflicts");
    let [first, second, third] = [0, 1, 2].map(SegmentId::new);
    let middle = VertexId::new(4);
    for conflict in [
        Conflict::OnSegment { segment: first, vertex: middle },
        Conflict::OnSegment { segment: second, vertex: middle },
    ] {
        assert!(t.conflicts_of_segments().contains(&conflict), "{refused}");
    }
    let _ = third;
    t.discard_moves();
    assert_eq!(t.segments().count(), 0);
}

/// A vertex that is hidden, and goes from the place of one vertex to that of another, changes no cell.
#[test]
fn segments_go_with_hidden_vertices() {
    let points = [[0.0, 0.0], [5.0, -1.0], [10.0, 0.0], [5.0, 1.0], [5.0, -1.0]];
    for algorithm in [
        Algorithm::Auto,
        Algorithm::Rebuilding,
        Algorithm::PlacementFlips,
        Algorithm::Tolerance,
        Algorithm::Repair,
    ] {
        let context = || format!("{algorithm:?}");
        let mut t =
            Triangulation::new(&points, Options { algorithm, ..Options::default() }).expect("good points");
        let [left, _, right, _, hidden] = [0, 1, 2, 3, 4].map(VertexId::new);
        t.stage_segments([Segment { ends: [hidden, right], marker: 0, ..Segment::default() }].into_iter())
            .expect("present");
        t.commit_timestamp().expect("an edge of the outline");
        t.move_vertices(&[hidden], &[points[0]]).expect("a good place");
        t.commit_timestamp().expect("nothing is in the way");
        let is_long = |t: &Triangulation| {
            t.cells().expect("room").corners.iter().any(|row| row.contains(&left) && row.contains(&right))
        };
        assert!(is_long(&t), "{}", context());
        check_definition(&t, &context);
        t.move_vertices(&[hidden], &[points[2]]).expect("a good place");
        t.commit_timestamp().expect_err("the ends meet");
        assert_eq!(
            t.conflicts_of_segments(),
            [Conflict::EndsMeet { segment: SegmentId::new(0) }],
            "{}",
            context()
        );
        assert!(is_long(&t), "{}", context());
        t.discard_moves();
        t.move_vertices(&[hidden], &[points[1]]).expect("a good place");
        t.commit_timestamp().expect("nothing is in the way");
        assert!(!is_long(&t), "{}", context());
    }
}

/// Vertices at random, and segments between them of which none conflicts.
fn random_domain(n: usize, n_segments: usize, rng: &mut Rng) -> Triangulation {
    let points: Vec<[f64; 2]> = (0..n).map(|_| [rng.unit(), rng.unit()]).collect();
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    for _ in 0..n_segments {
        let ends = [rng.below(n), rng.below(n)];
        if ends[0] != ends[1] {
            t.stage_segments(
                [Segment { ends: ends.map(VertexId::at), marker: 0, ..Segment::default() }].into_iter(),
            )
            .expect("present");
            if t.commit_timestamp().is_err() {
                t.discard_moves();
            }
        }
    }
    t
}

/// While all vertices stay within their tolerances no cell changes: moved by just less, each towards or away from the line
/// through the middle of some cell, which flattens that one the most.
#[test]
fn cells_at_segments_survive_what_is_within_tolerance() {
    let (mut n_wide, mut n_at_segments) = (0, 0);
    for seed in seeds(300) {
        let rng = &mut Rng::new(seed);
        let t = random_domain(5 + rng.below(30), 12, rng);
        let context = || format!("seed {seed}");
        let ids: Vec<_> = VertexId::range(0..t.id_count()).collect();
        let places: Vec<[f64; 2]> = ids.iter().map(|&v| t.position(v).expect("present")).collect();
        let tolerances: Vec<f64> = ids.iter().map(|&v| t.tolerance(v).expect("present")).collect();
        let ends: BTreeSet<VertexId> = t.segments().flat_map(|(_, segment)| segment.ends).collect();
        n_at_segments += ends.len();
        n_wide += ends.iter().filter(|&&v| tolerances[v.index()] > 0.0).count();
        let cells = t.cells().expect("room").corners.to_vec();
        for _ in 0..20 {
            let row = rng.pick(&cells).map(|v| places[v.index()]);
            let k = rng.below(3);
            let [a, b, c] = [row[k], row[(k + 1) % 3], row[(k + 2) % 3]];
            let length = ((c[0] - b[0]).powi(2) + (c[1] - b[1]).powi(2)).sqrt();
            let normal = [(b[1] - c[1]) / length, (c[0] - b[0]) / length];
            let height = |p: &[f64; 2]| (p[0] - b[0]) * normal[0] + (p[1] - b[1]) * normal[1];
            let middle = 0.5 * height(&a);
            let sign = if rng.one_in(2) { 1.0 } else { -1.0 };
            let goals: Vec<[f64; 2]> = places
                .iter()
                .zip(&tolerances)
                .map(|(p, tolerance)| {
                    let step = 0.999 * tolerance * sign * if height(p) < middle { 1.0 } else { -1.0 };
                    [p[0] + step * normal[0], p[1] + step * normal[1]]
                })
                .collect();
            let mut fresh = Triangulation::new(&goals, Options::default()).expect("good points");
            let segments: Vec<_> = t.segments().map(|(_, segment)| segment).collect();
            fresh.stage_segments(segments.into_iter()).expect("present");
            fresh.commit_timestamp().unwrap_or_else(|error| panic!("{}: {error}", context()));
            assert_same_cells(&cell_set(&t), &cell_set(&fresh), context);
        }
    }
    assert!(n_at_segments > 2_000 && n_wide > n_at_segments * 99 / 100, "{n_wide} of {n_at_segments}");
}

/// A triangle whose sides are segments may move until it is flat, whatever is beyond: by half its least height.
#[test]
fn a_cell_between_segments_has_the_tolerance_of_its_orientation() {
    let points = [
        [0.0, 0.0],
        [8.0, 0.0],
        [4.0, 2.0],
        [4.0, -1e-3],
        [4.0, 9.0],
        [30.0, 0.0],
        [-30.0, 0.0],
        [4.0, -40.0],
    ];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let ends = [[0, 1], [1, 2], [2, 0], [0, 4], [1, 4], [2, 4]];
    let sides = ends.map(|ends| Segment { ends: ends.map(VertexId::new), marker: 0, ..Segment::default() });
    t.stage_segments(sides.into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    // The two other cells of vertex 2 have heights of more than 2.
    let tolerance = t.tolerance(VertexId::new(2)).expect("present");
    assert!(tolerance <= 1.0 && tolerance > 1.0 - 1e-12, "{tolerance}");
    // Vertex 3 is just below the side between 0 and 1.
    let below = t.tolerance(VertexId::new(3)).expect("present");
    assert!(below <= 5e-4 && below > 4.9e-4, "{below}");
}

/// Brings labels up to date by the changes since they were right; returns how many cells have come, and are undecided.
fn update_labels(t: &mut Triangulation, labels: &mut Vec<i32>) -> [usize; 2] {
    let changes = t.take_changes().expect("room");
    let created = changes.created.to_vec();
    let old = labels.clone();
    let renumbered: Vec<_> =
        changes.renumbered_from.iter().copied().zip(changes.renumbered_to.iter().copied()).collect();
    labels.resize(t.cell_count(), -99);
    for (from, to) in renumbered {
        labels[to.index()] = old[from.index()];
    }
    // Entries of cells that have come are not read.
    created.iter().for_each(|&cell| labels[cell.index()] = -98);
    let twice: Vec<_> = created.iter().chain(&created).copied().collect();
    let (found, n_undecided) = t.labels_of(&twice, |cell| labels[cell.index()], -1).expect("cells");
    assert_eq!(found.len(), created.len());
    found.into_iter().for_each(|(cell, label)| labels[cell.index()] = label);
    [created.len(), n_undecided]
}

/// Whether a place is to the left of a closed chain, by its crossings of a ray to the right.
fn is_within(ring: &[[f64; 2]], p: [f64; 2]) -> bool {
    let sides = (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]));
    let crossings = sides.filter(|&(a, b)| {
        (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossings.count() % 2 == 1
}

/// Labels that go with the changes are those of the loops that cells are in: two loops that turn and wander in a square, with
/// vertices all around; and nesting levels likewise.
#[test]
fn labels_go_with_their_regions() {
    let (mut n_created, mut n_undecided) = (0, 0);
    for seed in seeds(20) {
        let rng = &mut Rng::new(seed);
        let ring = |centre: [f64; 2], turn: f64| {
            (0..7).map(move |k| {
                let angle = turn + std::f64::consts::TAU * f64::from(k) / 7.0;
                // Not on one circle, of which all cells would be new in each step.
                let radius = 0.1 + 0.03 * f64::from(k * k % 3);
                [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
            })
        };
        let rings = |step: usize| -> Vec<[f64; 2]> {
            let s = step as f64 * 0.03;
            ring([0.3 + 0.01 * s.sin(), 0.3], s).chain(ring([0.7, 0.7 - 0.01 * s.sin()], -2.0 * s)).collect()
        };
        let mut points = rings(0);
        // Where no segment comes by: labels go with regions while no vertex passes a segment.
        let is_free = |p: &[f64; 2]| {
            [0.3, 0.7]
                .iter()
                .all(|c| !(0.06..0.2).contains(&((p[0] - c).powi(2) + (p[1] - c).powi(2)).sqrt()))
        };
        points.extend((0..600).map(|_| [rng.unit(), rng.unit()]).filter(is_free));
        let mut t = Triangulation::new(&points, Options::default()).expect("good points");
        let side = |k: u32| Segment {
            ends: [k, k / 7 * 7 + (k + 1) % 7].map(VertexId::new),
            marker: 0,
            ..Segment::default()
        };
        t.stage_segments((0..14).map(side)).expect("present");
        t.commit_timestamp().expect("no vertex is exactly on a segment");
        t.take_changes().expect("room");
        let mut labels = t.label_cells(&[[0.3, 0.3], [0.7, 0.7]], &[5, 6], 0).expect("within");
        let mut levels: Vec<i32> =
            t.nesting_levels().expect("room").into_iter().map(|level| level as i32).collect();
        for step in 1..60 {
            let context = || format!("seed {seed}, step {step}");
            let goals: Vec<[f64; 2]> = rings(step)
                .into_iter()
                .chain(points[14..].iter().map(|p| p.map(|x| x + 0.002 * (rng.unit() - 0.5))))
                .collect();
            t.move_all(&goals).expect("good places");
            t.commit_timestamp().expect("no vertex is exactly on a segment");
            points = goals;
            let mut twin = t.try_clone(None).expect("room");
            let counts = update_labels(&mut t, &mut labels);
            assert_eq!(update_labels(&mut twin, &mut levels), counts, "{}", context());
            n_created += counts[0];
            n_undecided += counts[1];
            let view = t.cells().expect("room");
            let wanted_levels = t.nesting_levels().expect("room");
            for (c, row) in view.corners.iter().enumerate() {
                let corners = row.map(|v| points[v.index()]);
                let centre = [0, 1].map(|axis| corners.iter().map(|p| p[axis]).sum::<f64>() / 3.0);
                let loops = rings(step);
                let wanted = match (is_within(&loops[..7], centre), is_within(&loops[7..], centre)) {
                    (true, _) => 5,
                    (_, true) => 6,
                    _ => 0,
                };
                assert_eq!(labels[c], wanted, "{}: cell {c}", context());
                assert_eq!(levels[c], wanted_levels[c] as i32, "{}: cell {c}", context());
            }
        }
    }
    assert!(n_created > 20_000 && n_undecided == 0, "{n_created} {n_undecided}");
}

/// Where a region has only new cells, or two have become one, labels are undecided.
#[test]
fn labels_that_nothing_tells_are_undecided() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.5, 2.5], [2.5, 1.5]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let wall = [[0, 2], [0, 1], [1, 2]].map(|ends| Segment {
        ends: ends.map(VertexId::new),
        marker: 0,
        ..Segment::default()
    });
    t.stage_segments(wall.into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    t.take_changes().expect("room");
    let mut labels = t.label_cells(&[[0.5, 2.0], [3.5, 2.0]], &[1, 2], 0).expect("within");
    assert!(labels.contains(&1) && labels.contains(&2) && !labels.contains(&0));
    // Without the wall there are two cells between both sides.
    let mut twin = t.try_clone(None).expect("room");
    twin.take_changes().expect("room");
    twin.stage_segment_removals(&[SegmentId::new(0)]).expect("in force");
    twin.commit_timestamp().expect("no conflict");
    let mut of_twin = twin.label_cells(&[[0.1, 2.0]], &[1], 0).expect("within");
    assert_eq!(of_twin, [1; 6]);
    of_twin = labels.clone();
    assert_eq!(update_labels(&mut twin, &mut of_twin), [2, 2]);
    of_twin.sort();
    assert_eq!(of_twin, [-1, -1, 1, 1, 2, 2]);
    // All cells to the right are new: their only inner vertex goes.
    t.remove_vertex(VertexId::new(5)).expect("no end");
    assert_eq!(update_labels(&mut t, &mut labels), [1, 1]);
    assert_eq!(labels.iter().filter(|&&label| label == -1).count(), 1);
    let error = t.labels_of(&[CellId::new(99)], |_| 0, 0).expect_err("no cell");
    assert!(matches!(error, Error::NoSuchCell { index: 0, .. }), "{error}");
}

/// Vertices on a line have no cells: a call at once that segments refuse has no effect on them either.
#[test]
fn calls_at_once_are_refused_on_a_line() {
    let points = [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [2.0, 0.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let [left, middle, right, hidden] = [0, 1, 2, 3].map(VertexId::new);
    t.stage_segments([Segment { ends: [left, middle], marker: 0, ..Segment::default() }].into_iter())
        .expect("present");
    t.commit_timestamp().expect("nothing is in the way");
    let before = t.saved().expect("room");
    let check = |t: &Triangulation, refused: deldrift::Result<()>| {
        assert!(matches!(refused, Err(Error::Conflict { .. })), "{refused:?}");
        t.validate(deldrift::motion::Level::Delaunay).expect("valid");
        assert!(t.saved().expect("room") == before);
    };
    let refused = t.remove_vertex(left);
    check(&t, refused);
    let refused = t.insert_vertex(&[1.0, 0.0]).map(drop);
    check(&t, refused);
    let refused = t.relocate_vertex(right, &[1.0, 0.0]);
    check(&t, refused);
    let refused = t.relocate_vertex(left, &[2.0, 0.0]);
    check(&t, refused);
    let refused = t.relocate_vertex(hidden, &[1.0, 0.0]);
    check(&t, refused);
    let refused = t.relocate_vertex(middle, &[6.0, 0.0]);
    check(&t, refused);
    // One beside the line makes cells, and would be accepted; then it goes.
    let beside = t.insert_vertex(&[1.0, 1.0]).expect("nothing is in the way");
    t.remove_vertex(beside).expect("no end");
    t.validate(deldrift::motion::Level::Delaunay).expect("valid");
}

/// Conflicts are those of the latest change that was refused, and one that is refused for another reason has none.
#[test]
fn conflicts_are_those_of_the_latest_refusal() {
    let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]];
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let mut t = Triangulation::new(&points, options).expect("good points");
    let segment = Segment { ends: [VertexId::new(1); 2], marker: 0, ..Segment::default() };
    for call in 0..2 {
        t.stage_segments([segment].into_iter()).expect("present");
        t.commit_timestamp().expect_err("the ends meet");
        t.discard_moves();
        assert_eq!(t.conflicts_of_segments().len(), 1);
        let refused = match call {
            0 => t.insert_vertex(&points[2]).map(drop),
            _ => t.relocate_vertex(VertexId::new(0), &points[2]),
        };
        assert!(matches!(refused, Err(Error::Coincident { .. })), "{refused:?}");
        assert_eq!((t.conflicts_of_segments(), t.id_count()), (&[][..], 3));
    }
}

/// A staged segment whose end has been removed stays staged, through any number of compactions, and is refused then.
#[test]
fn staged_segments_without_an_end_go_through_compactions() {
    let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    t.stage_segments(
        [Segment { ends: [1, 2].map(VertexId::new), marker: 5, ..Segment::default() }].into_iter(),
    )
    .expect("present");
    t.remove_vertex(VertexId::new(1)).expect("present");
    for _ in 0..3 {
        t.compact().expect("room");
        let bytes = t.saved().expect("room");
        t = Triangulation::load(&Saved::of(&bytes).expect("good data"), Options::default())
            .expect("good data");
        let refused = t.stage_splits(9).expect_err("an end is gone");
        let conflict = Conflict::EndRemoved { segment: SegmentId::new(0), vertex: VertexId::NONE };
        assert_eq!(refused, Error::Conflict { conflict, others: 0 });
    }
}

/// A refused commit takes back what it has done to cells that are named by their slots, so none of its ways may sort the cells of a
/// large set after it has begun.
#[test]
fn a_refused_commit_of_a_large_set_leaves_all_as_it_was() {
    let rng = &mut Rng::new(1);
    let mut points: Vec<[f64; 2]> = (0..17_000).map(|_| [rng.unit(), 0.05 + 0.9 * rng.unit()]).collect();
    // Vertices on both sides of the segment, and far enough from it.
    points.iter_mut().filter(|p| (p[1] - 0.5).abs() < 0.01).for_each(|p| p[1] += 0.02);
    points.extend([[-0.01, 0.5], [1.01, 0.5]]);
    let ends = [17_000, 17_001].map(VertexId::new);
    let shaken = |points: &[[f64; 2]], by: f64, rng: &mut Rng| -> Vec<[f64; 2]> {
        points.iter().map(|p| p.map(|x| x + by * (2.0 * rng.unit() - 1.0))).collect()
    };
    for algorithm in Algorithm::ALL {
        let options = Options { algorithm: Algorithm::Repair, ..Options::default() };
        let mut t = Triangulation::new(&points, options).expect("a build");
        t.stage_segments([Segment { ends, ..Segment::default() }].into_iter()).expect("present");
        t.commit_timestamp().expect("no conflict");
        // Flips replace about as many cells as there are, which is not enough to sort them when the commit ends.
        t.commit_positions(&shaken(&points, 0.003, rng)).expect("no conflict");
        t.set_algorithm(algorithm);
        let before = t.saved().expect("room");
        let mut goals: Vec<_> =
            (0..points.len()).map(|v| t.position(VertexId::at(v)).expect("present")).collect();
        goals = shaken(&goals, 1e-6, rng);
        // A vertex comes to be on the segment.
        (goals[17_000], goals[17_001], goals[0]) = ([0.0, 0.5], [1.0, 0.5], [0.5, 0.5]);
        assert!(matches!(t.commit_positions(&goals), Err(Error::Conflict { .. })), "{algorithm:?}");
        assert!(t.saved().expect("room") == before, "{algorithm:?}");
        t.validate(deldrift::motion::Level::Delaunay).expect("as it was");
    }
}
