//! What is near a place, and what has given corners, against brute force over all vertices and cells in exact integers.

use super::*;
use deldrift::motion::Location;

/// The square of a distance between places, in units of the quantum.
pub(super) fn square(p: &Grid, q: &Grid) -> i128 {
    p.iter().zip(q).map(|(&x, &y)| (i128::from(x) - i128::from(y)).pow(2)).sum()
}

/// All vertices that are present, with their places.
pub(super) fn present<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<(VertexId, Grid)> {
    VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).map(|v| (v, grid(t, v))).collect()
}

/// Places to ask about: anywhere, at vertices, in the middle between two (where distances tie), and far away.
fn places<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) -> Vec<G::Point> {
    let vertices = present(t);
    let mut places: Vec<G::Point> = (0..4).map(|_| draw_one::<G>(Kind::Random, 100, rng)).collect();
    for _ in 0..4 {
        if let Some((v, _)) = vertices.get(rng.below(vertices.len().max(1))) {
            let (w, _) = vertices[rng.below(vertices.len())];
            let (p, q) = (t.position(*v).expect("present"), t.position(w).expect("present"));
            places.push(p);
            // To the quantum, which is that of all positions.
            places.push(point::<G>(|k| ((p[k] + q[k]) / QUANTUM / 2.0).floor() * QUANTUM));
        }
    }
    places.push(point::<G>(|k| 30000.0 - k as f64));
    places
}

fn check_nearest<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let vertices = present(t);
    let places = places(t, rng);
    for k in [0, 1, 2, 7, vertices.len() + 2] {
        let mut found = Vec::new();
        t.nearest_vertices(&places, k, |v| found.push(v)).expect("good places");
        assert_eq!(found.len(), k * places.len());
        for (row, q) in found.chunks(k.max(1)).zip(&places) {
            let q = to_grid::<G>(q);
            let mut expected: Vec<_> = vertices.iter().map(|(v, p)| (square(p, &q), *v)).collect();
            expected.sort();
            let ids = expected.into_iter().map(|(_, v)| v).chain(std::iter::repeat(VertexId::NONE));
            assert_eq!(row, ids.take(k).collect::<Vec<_>>(), "{k} nearest to {q:?}");
        }
    }
    for q in &places {
        let mut first = Vec::new();
        t.nearest_vertices(&[*q], 1, |v| first.push(v)).expect("a good place");
        assert_eq!(t.nearest_vertex(q).expect("room").unwrap_or(VertexId::NONE), first[0]);
    }
}

#[test]
fn nearest_vertices_are_those_of_all() {
    on_all_kinds::<Plane>(check_nearest);
    on_all_kinds::<Space>(check_nearest);
}

/// Squares of radii that just reach the vertices, or just do not, and others.
fn radii(vertices: &[(VertexId, Grid)], q: &Grid, rng: &mut Rng) -> Vec<f64> {
    let mut radii = vec![0.0, f64::from_bits(1), f64::MAX, f64::INFINITY, 1e6 * rng.unit()];
    for _ in 0..6 {
        if let Some((_, p)) = vertices.get(rng.below(vertices.len().max(1))) {
            let near = square(p, q) as f64 * QUANTUM * QUANTUM;
            radii.extend([near, near.next_up(), near.next_down()].into_iter().filter(|&s| s >= 0.0));
        }
    }
    radii
}

/// Whether a square in units of the quantum is at most a number.
pub(super) fn is_at_most(square: i128, number: f64) -> bool {
    let quanta = number / QUANTUM / QUANTUM;
    quanta >= 2f64.powi(120) || square <= quanta.floor() as i128
}

fn check_balls<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let vertices = present(t);
    for centre in places(t, rng) {
        let q = to_grid::<G>(&centre);
        for squared in radii(&vertices, &q, rng) {
            let found = t.vertices_in_ball(&centre, squared).expect("a good ball");
            let is_in = |(_, p): &&(VertexId, Grid)| is_at_most(square(p, &q), squared);
            let expected: Vec<_> = vertices.iter().filter(is_in).map(|&(v, _)| v).collect();
            assert_eq!(found, expected, "{centre:?} {squared:e}");
        }
    }
    for bad in [-1.0, f64::NAN, -f64::from_bits(1)] {
        let refused = t.vertices_in_ball(&G::Point::default(), bad);
        assert!(matches!(refused, Err(Error::InvalidValue { argument: "squared_radius", .. })));
    }
}

#[test]
fn vertices_in_balls_are_those_of_all() {
    on_all_kinds::<Plane>(check_balls);
    on_all_kinds::<Space>(check_balls);
}

/// A ball around the least places that there are, where squares of differences are less than any number.
#[test]
fn balls_of_the_least_radii_are_exact() {
    let least = f64::from_bits(1);
    let t = MovingTriangulation::<Plane>::new(
        &[[0.0, 0.0], [least, 0.0], [0.0, 1e-170], [1e57, 1.0]],
        Options::default(),
    );
    let t = t.expect("good points");
    let within = |squared| t.vertices_in_ball(&[0.0, 0.0], squared).expect("a good ball").len();
    // The square of 1e-170 is below the least number, and that of `least` far below.
    assert_eq!([0.0, least, 1e-320, 1e114].map(within), [1, 3, 3, 3]);
    assert_eq!(within(f64::INFINITY), 4);
}

fn check_boxes<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let vertices = present(t);
    let places = places(t, rng);
    for _ in 0..30 {
        // Corners are places, mostly of vertices, so that vertices are on the faces.
        let (p, q) = (places[rng.below(places.len())], places[rng.below(places.len())]);
        let mut low = point::<G>(|k| p[k].min(q[k]));
        let mut high = point::<G>(|k| p[k].max(q[k]));
        for axis in 0..G::D {
            match rng.below(10) {
                0 => low[axis] = f64::NEG_INFINITY,
                1 => high[axis] = f64::INFINITY,
                2 => high[axis] = low[axis],
                3 => low[axis] = low[axis].next_up(),
                4 => high[axis] = 1e60,
                5 if rng.one_in(4) => low[axis] = high[axis].next_up(),
                _ => {}
            }
        }
        let found = t.vertices_in_box(&low, &high).expect("numbers");
        let is_in = |v: VertexId| {
            let p = t.position(v).expect("present");
            (0..G::D).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis])
        };
        let expected: Vec<_> = vertices.iter().map(|&(v, _)| v).filter(|&v| is_in(v)).collect();
        assert_eq!(found, expected, "{low:?} {high:?}");
    }
    let nan = point::<G>(|k| if k == 1 { f64::NAN } else { 0.0 });
    let refused = t.vertices_in_box(&G::Point::default(), &nan);
    assert!(matches!(refused, Err(Error::InvalidValue { argument: "high", index: 1, .. })));
}

#[test]
fn vertices_in_boxes_are_those_of_all() {
    on_all_kinds::<Plane>(check_boxes);
    on_all_kinds::<Space>(check_boxes);
}

/// Boxes beside, through and around a cloud large enough for floods to end before they are given up: thin ones, small
/// ones, and ones outside the hull that meet it at one side.
fn check_large_boxes<G: Dimension>() {
    let rng = &mut Rng::new(7);
    let points = draw::<G>(Kind::Random, 4000, rng);
    let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
    let mut n_found = 0;
    for round in 0..200 {
        let middle = point::<G>(|_| 2400.0 * rng.unit() - 1200.0);
        let half = point::<G>(|_| [1e-3, 30.0, 300.0][rng.below(3)]);
        let (low, high) = (point::<G>(|k| middle[k] - half[k]), point::<G>(|k| middle[k] + half[k]));
        let is_in = |p: &&G::Point| (0..G::D).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis]);
        let found = t.vertices_in_box(&low, &high).expect("numbers");
        assert_eq!(found.len(), points.iter().filter(is_in).count(), "{round}");
        assert!(found.iter().all(|&v| is_in(&&t.position(v).expect("present"))));
        n_found += found.len();
    }
    assert!(n_found > 500, "{n_found}");
}

#[test]
fn vertices_in_boxes_are_those_of_a_large_set() {
    check_large_boxes::<Plane>();
    check_large_boxes::<Space>();
}

/// Small balls and boxes in sets that are large enough for floods to come to an end: lattices as well, with ties and
/// flat sides, and after commits that have moved, inserted and removed vertices.
fn check_floods<G: Dimension>() {
    let rng = &mut Rng::new(8);
    let (mut n_in_balls, mut n_in_boxes) = (0, 0);
    for kind in [Kind::Random, Kind::Lattice, Kind::RoundedSphere, Kind::Clusters, Kind::Duplicates] {
        let n = if kind == Kind::Duplicates { 3000 } else { 6000 };
        let mut t =
            MovingTriangulation::<G>::new(&draw::<G>(kind, n, rng), Options::default()).expect("good points");
        for _ in 0..3 {
            for round in 0..30 {
                let around = places(&t, rng);
                let centre = *rng.pick(&around);
                let (q, vertices) = (to_grid::<G>(&centre), present(&t));
                let mut squares: Vec<_> = vertices.iter().map(|(_, p)| square(p, &q)).collect();
                squares.sort_unstable();
                // Up to some ten vertices are in it, of which some are on its boundary.
                let squared = squares[round / 3] as f64 * QUANTUM * QUANTUM;
                let found = t.vertices_in_ball(&centre, squared).expect("a good ball");
                let is_in = |(_, p): &&(VertexId, Grid)| is_at_most(square(p, &q), squared);
                let expected: Vec<_> = vertices.iter().filter(is_in).map(|&(v, _)| v).collect();
                assert_eq!(found, expected, "{kind:?} {centre:?} {squared:e}");
                n_in_balls += found.len();
                let half = squared.sqrt();
                let (low, high) = (point::<G>(|k| centre[k] - half), point::<G>(|k| centre[k] + half));
                let is_in = |v: VertexId| {
                    let p = t.position(v).expect("present");
                    (0..G::D).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis])
                };
                let expected: Vec<_> = vertices.iter().map(|&(v, _)| v).filter(|&v| is_in(v)).collect();
                assert_eq!(t.vertices_in_box(&low, &high).expect("numbers"), expected, "{kind:?}");
                n_in_boxes += expected.len();
            }
            let goals: Vec<_> = VertexId::range(0..t.id_count())
                .map(|v| {
                    if rng.one_in(4) {
                        draw_one::<G>(kind, n, rng)
                    } else {
                        t.position(v).unwrap_or_default()
                    }
                })
                .collect();
            t.move_all(&goals).expect("good places");
            t.stage_insertions(&[draw_one::<G>(kind, n, rng)]).expect("a good place");
            t.commit_timestamp().expect("room");
        }
    }
    assert!(n_in_balls > 1000 && n_in_boxes > 1000, "{n_in_balls} {n_in_boxes}");
}

#[test]
fn floods_of_large_sets_find_all() {
    check_floods::<Plane>();
    check_floods::<Space>();
}

fn check_conflicts<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    for q in places(t, rng) {
        let near = if rng.one_in(2) { Some(Location::Cell(CellId::at(rng.below(9)))) } else { None };
        let found = t.conflicts(&q, near).expect("a good place");
        let rows = t.cells().expect("room").corners;
        let mut found: Vec<_> =
            found.iter().map(|&cell| crate::common::sorted(rows[cell].as_ref())).collect();
        found.sort();
        let mut grown = t.try_clone(None).expect("room");
        grown.take_changes().expect("room");
        grown.insert_vertex(&q).expect("a good place");
        let changes = grown.take_changes().expect("room");
        let removed = changes.removed_corners.iter().map(|row| crate::common::sorted(row.as_ref()));
        let mut removed: Vec<_> = removed.collect();
        removed.sort();
        assert_eq!(found, removed, "{q:?}");
    }
}

#[test]
fn conflicts_are_the_cells_that_an_insertion_removes() {
    on_all_kinds::<Plane>(check_conflicts);
    on_all_kinds::<Space>(check_conflicts);
}

/// The ascending corners of each simplex of so many corners that is in a cell.
fn faces<G: Dimension>(t: &MovingTriangulation<G>, n_corners: usize) -> BTreeSet<Vec<VertexId>> {
    let mut faces = BTreeSet::new();
    for row in t.cells().expect("room").corners {
        let row = row.as_ref();
        for bits in 0..1usize << row.len() {
            let face: Vec<_> = (0..row.len()).filter(|i| bits >> i & 1 == 1).map(|i| row[i]).collect();
            if face.len() == n_corners {
                faces.insert(crate::common::sorted(&face));
            }
        }
    }
    faces
}

fn check_simplices<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let vertices = present(t);
    if vertices.is_empty() {
        return;
    }
    let rows = t.cells().expect("room").corners;
    for n_corners in 1..=G::D + 1 {
        let faces = faces(t, n_corners);
        // Few, so that stars are looked through, and many.
        for n in [1, 2 * vertices.len()] {
            let mut asked: Vec<VertexId> = Vec::new();
            for _ in 0..n {
                if rng.one_in(2) && !rows.is_empty() {
                    let mut row = rows[CellId::at(rng.below(rows.len()))].as_ref().to_vec();
                    rng.shuffle(&mut row);
                    asked.extend(&row[..n_corners]);
                } else {
                    asked.extend((0..n_corners).map(|_| vertices[rng.below(vertices.len())].0));
                }
            }
            let mut found = Vec::new();
            t.find_simplices(&asked, n_corners, |cell| found.push(cell)).expect("present");
            assert_eq!(found.len(), n);
            for (simplex, cell) in asked.chunks(n_corners).zip(found) {
                let shown: Vec<_> =
                    simplex.iter().map(|&v| t.coincident_representative(v).expect("present")).collect();
                let is_there = faces.contains(&crate::common::sorted(&shown));
                assert_eq!(cell.is_some(), is_there, "{simplex:?}");
                assert!(cell.is_none_or(|cell| shown.iter().all(|v| rows[cell].as_ref().contains(v))));
            }
        }
    }
    for bad in [0, G::D + 2] {
        let refused = t.find_simplices(&[], bad, |_| {});
        assert!(matches!(refused, Err(Error::InvalidValue { argument: "corners_per_simplex", .. })));
    }
    let refused = t.find_simplices(&[vertices[0].0], 2, |_| {});
    assert!(matches!(refused, Err(Error::WrongCount { given: 1, wanted: 2, .. })));
    let refused = t.find_simplices(&[vertices[0].0, VertexId::at(t.id_count())], 2, |_| {});
    assert!(matches!(refused, Err(Error::NoSuchVertex { index: 1, .. })));
}

#[test]
fn simplices_are_found_where_a_cell_has_them() {
    on_all_kinds::<Plane>(check_simplices);
    on_all_kinds::<Space>(check_simplices);
}

/// A vertex that thousands of cells have, and others with few: each is asked about with it.
#[test]
fn an_edge_of_a_hub_is_found_by_its_other_end() {
    let n = 3000;
    let mut points = vec![[0.0, 0.0]];
    points.extend((0..n).map(|k| (k as f64 * 1e-3).sin_cos()).map(|(x, y)| [100.0 * x, 100.0 * y]));
    let t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
    let there = faces(&t, 2);
    for other in VertexId::range(1..n + 1).step_by(17) {
        let mut found = None;
        t.find_simplices(&[VertexId::new(0), other], 2, |cell| found = cell).expect("present");
        assert_eq!(found.is_some(), there.contains(&vec![VertexId::new(0), other]));
    }
}

/// Two vertices of thousands of cells each: where they share an edge, and where they do not.
#[test]
fn an_edge_between_two_hubs_is_found() {
    for middle in [false, true] {
        let ring = (0..1500).map(|k| (k as f64 / 1500.0 * std::f64::consts::TAU).sin_cos());
        let mut points: Vec<[f64; 3]> = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
        points.extend(ring.map(|(x, y)| [100.0 * x, 100.0 * y, 0.0]));
        if middle {
            points.push([0.0; 3]);
        }
        let t = MovingTriangulation::<Space>::new(&points, Options::default()).expect("good points");
        let hubs = [0, 1].map(VertexId::new);
        assert!(hubs.map(|v| t.vertex_cells().expect("room").row(v).len()).iter().all(|&n| n > 1000));
        let mut found = None;
        t.find_simplices(&hubs, 2, |cell| found = cell).expect("present");
        assert_eq!(found.is_some(), !middle);
    }
}

fn check_lists<G: Dimension>(t: &MovingTriangulation<G>, _: &mut Rng) {
    let hidden: Vec<_> = t.hidden_vertices().collect();
    let all = present(t).into_iter().map(|(v, _)| (v, t.coincident_representative(v).expect("present")));
    assert_eq!(hidden, all.filter(|(v, shown)| v != shown).collect::<Vec<_>>());
    assert_eq!(t.hidden_count(), hidden.len());
    let lists = t.vertex_cells().expect("room");
    let cells = t.cell_of_each_vertex().expect("room");
    assert_eq!(cells.len(), t.id_count());
    for (v, cell) in VertexId::range(0..t.id_count()).zip(cells) {
        let list = lists.row(v);
        assert_eq!(cell, list.first().copied().unwrap_or(CellId::NONE));
    }
}

#[test]
fn hidden_vertices_and_a_cell_of_each() {
    on_all_kinds::<Plane>(check_lists);
    on_all_kinds::<Space>(check_lists);
}

/// The determinant of the edges from the first corner.
fn determinant(corners: &[Grid]) -> BigInt {
    circumsphere(corners).1
}

fn check_weights<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let cells = cells_of(t);
    let positions = places(t, rng);
    let asked: Vec<CellId> = positions
        .iter()
        .map(|_| {
            if cells.is_empty() || rng.one_in(8) { CellId::NONE } else { CellId::at(rng.below(cells.len())) }
        })
        .collect();
    let mut rows = Vec::new();
    t.barycentric(&positions, &asked, |row| rows.push(row.map(<[f64]>::to_vec))).expect("good places");
    assert_eq!(rows.len(), positions.len());
    for ((q, cell), row) in positions.iter().zip(asked).zip(rows) {
        let Some(row) = row else {
            assert_eq!(cell, CellId::NONE);
            continue;
        };
        let corners = &cells[cell.index()];
        let whole = determinant(corners);
        for (i, weight) in row.iter().enumerate() {
            let mut replaced = corners.clone();
            replaced[i] = to_grid::<G>(q);
            let part = determinant(&replaced);
            if part == BigInt::ZERO {
                assert_eq!(*weight, 0.0);
                continue;
            }
            let wanted = quotient(&part, &whole, 0);
            assert!((weight - wanted).abs() <= 2.5e-13 * wanted.abs(), "{weight}, not {wanted}");
        }
    }
    let refused = t.barycentric(&[G::Point::default()], &[], |_| {});
    assert!(matches!(refused, Err(Error::WrongCount { given: 0, wanted: 1, .. })));
    let bad = CellId::at(t.cell_count());
    let refused = t.barycentric(&[G::Point::default()], &[bad], |_| {});
    assert!(matches!(refused, Err(Error::NoSuchCell { argument: "cells", index: 0, .. })));
}

#[test]
fn weights_are_quotients_of_determinants() {
    on_all_kinds::<Plane>(check_weights);
    on_all_kinds::<Space>(check_weights);
}

/// Quotients that are below the least number or above the greatest one keep their signs.
#[test]
fn weights_out_of_the_range_of_numbers_have_signs() {
    let weights_of = |corners: [[f64; 2]; 3], place: [f64; 2]| {
        let t = MovingTriangulation::<Plane>::new(&corners, Options::default()).expect("good points");
        let mut by_vertex = [0.0; 3];
        let row = t.cells().expect("room").corners[CellId::new(0)];
        t.barycentric(&[place], &[CellId::new(0)], |weights| {
            row.iter().zip(weights.expect("a cell")).for_each(|(v, &w)| by_vertex[v.index()] = w);
        })
        .expect("a good place");
        by_vertex
    };
    let large = [[-1e57, 0.0], [1e57, 0.0], [0.0, 1e57]];
    assert_eq!(weights_of(large, [0.0, 1e-300]), [0.5, 0.5, f64::from_bits(1)]);
    assert_eq!(weights_of(large, [0.0, -1e-300]), [0.5, 0.5, -f64::from_bits(1)]);
    assert_eq!(weights_of(large, [0.0, 0.0])[2], 0.0);
    let flat = [[-1e57, 0.0], [1e57, 0.0], [0.0, 1e-260]];
    assert_eq!(weights_of(flat, [0.0, 1e57]), [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY]);
}
