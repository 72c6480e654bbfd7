//! Small triangulations against the definition, enumerated in exact integers (see `common/exact.rs`).

use crate::common::exact::{Grid, delaunay_cells, orientation, representatives, to_point};
use crate::common::{Rng, assert_same_cells, cell_set, check_adjacency, seeds};
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};

/// A point drawn by some rule.
type Draw = fn(&mut Rng, usize) -> Grid;

fn anywhere(rng: &mut Rng, d: usize) -> Grid {
    (0..d).map(|_| rng.within(-500, 500)).collect()
}

/// Mostly cocircular or cospherical, collinear or coplanar, often coincident.
fn on_tiny_grid(rng: &mut Rng, d: usize) -> Grid {
    (0..d).map(|_| rng.within(0, 2)).collect()
}

fn on_small_grid(rng: &mut Rng, d: usize) -> Grid {
    (0..d).map(|_| rng.within(0, 4)).collect()
}

/// On one circle (radius 5 or 65 in the plane) or sphere (radius 3), its centre now and then.
fn on_sphere(rng: &mut Rng, d: usize) -> Grid {
    if rng.one_in(10) {
        return vec![0; d];
    }
    let mut p = match d {
        2 => rng.pick(&[[3, 4, 0], [0, 5, 0], [5, 0, 0], [4, 3, 0]]).to_vec(),
        _ => rng.pick(&[[1, 2, 2], [2, 1, 2], [2, 2, 1], [3, 0, 0], [0, 3, 0], [0, 0, 3]]).to_vec(),
    };
    p.truncate(d);
    p.iter().map(|&x| if rng.one_in(2) { -x } else { x }).collect()
}

/// On a line, seldom off it.
fn on_line(rng: &mut Rng, d: usize) -> Grid {
    let x = rng.within(-4, 4);
    let off = rng.one_in(6);
    (0..d as i64).map(|k| (k + 1) * x + if off { rng.within(0, 1) } else { 0 }).collect()
}

/// In a plane of space (a line of the plane), seldom off it.
fn in_hyperplane(rng: &mut Rng, d: usize) -> Grid {
    let mut p: Grid = (0..d).map(|_| rng.within(0, 3)).collect();
    p[d - 1] = p[0] + if rng.one_in(7) { 1 } else { 0 };
    p
}

/// Two or three places in all.
fn on_few_places(rng: &mut Rng, d: usize) -> Grid {
    let n = rng.within(0, d as i64 + 1);
    (0..d as i64).map(|k| i64::from(k + 1 == n) * 7).collect()
}

const KINDS: [(&str, Draw); 7] = [
    ("anywhere", anywhere),
    ("on a tiny grid", on_tiny_grid),
    ("on a small grid", on_small_grid),
    ("on a sphere", on_sphere),
    ("on a line", on_line),
    ("in a hyperplane", in_hyperplane),
    ("on few places", on_few_places),
];

/// Compares a triangulation with the definition.
fn check<G: Dimension>(t: &MovingTriangulation<G>, positions: &[Option<Grid>], context: &dyn Fn() -> String) {
    if let Err(violation) = t.validate(Level::Delaunay) {
        panic!("{}: {violation}; {positions:?}", context());
    }
    assert_same_cells(&cell_set(t), &delaunay_cells(G::D, positions), || {
        format!("{}; {positions:?}", context())
    });
    check_adjacency(t, context);
    for corners in t.cells().expect("room").corners {
        let points: Vec<&Grid> =
            corners.as_ref().iter().map(|&v| positions[v].as_ref().expect("present")).collect();
        assert!(orientation(&points) > 0, "{}: cell {corners:?} is not positive", context());
    }
    for (v, representative) in representatives(positions).into_iter().enumerate() {
        assert_eq!(
            t.coincident_representative(VertexId::at(v)).ok(),
            representative,
            "{}: vertex {v}",
            context()
        );
    }
}

fn build<G: Dimension>(positions: &[Option<Grid>]) -> MovingTriangulation<G> {
    let points: Vec<G::Point> = positions.iter().flatten().map(to_point::<G>).collect();
    MovingTriangulation::new(&points, Options::default()).expect("a build")
}

fn draw_all(rng: &mut Rng, d: usize, draw: Draw, limit: usize) -> Vec<Option<Grid>> {
    let n = rng.below(limit + 1);
    (0..n).map(|_| Some(draw(rng, d))).collect()
}

fn builds_agree<G: Dimension>(n_seeds: u64, limit: usize) {
    for (kind, draw) in KINDS {
        for seed in seeds(n_seeds) {
            let positions = draw_all(&mut Rng::new(seed), G::D, draw, limit);
            check(&build::<G>(&positions), &positions, &|| format!("{kind}, seed {seed}"));
        }
    }
}

/// Immediate calls and commits, each followed by the comparison.
fn histories_agree<G: Dimension>(n_seeds: u64, limit: usize) {
    for (kind, draw) in KINDS {
        for seed in seeds(n_seeds) {
            let rng = &mut Rng::new(seed ^ 0xabcd_0000);
            let mut positions = draw_all(rng, G::D, draw, limit - 2);
            let mut t = build::<G>(&positions);
            let mut history = vec![format!("{kind}, seed {seed}, from {positions:?}")];
            for _ in 0..8 {
                let present: Vec<usize> = (0..positions.len()).filter(|&v| positions[v].is_some()).collect();
                let q = draw(rng, G::D);
                match rng.below(5) {
                    0 if present.len() < limit => {
                        history.push(format!("insert {q:?}"));
                        let id = t.insert_vertex(&to_point::<G>(&q)).expect("an insertion");
                        assert_eq!(id.index(), positions.len());
                        positions.push(Some(q));
                    }
                    1 if !present.is_empty() => {
                        let v = *rng.pick(&present);
                        history.push(format!("remove {v}"));
                        t.remove_vertex(VertexId::at(v)).expect("a removal");
                        positions[v] = None;
                    }
                    2 if !present.is_empty() => {
                        let v = *rng.pick(&present);
                        history.push(format!("relocate {v} to {q:?}"));
                        t.relocate_vertex(VertexId::at(v), &to_point::<G>(&q)).expect("a relocation");
                        positions[v] = Some(q);
                    }
                    _ => {
                        t.set_algorithm(*rng.pick(&Algorithm::ALL));
                        let mut moves = Vec::new();
                        for v in present {
                            if rng.one_in(3) {
                                continue;
                            }
                            let q = draw(rng, G::D);
                            moves.push((v, q.clone()));
                            t.move_vertices(&[VertexId::at(v)], &[to_point::<G>(&q)]).expect("a move");
                            positions[v] = Some(q);
                        }
                        history.push(format!("commit by {:?} {moves:?}", t.algorithm()));
                        t.commit_timestamp().expect("a commit");
                    }
                }
                check(&t, &positions, &|| history.join("\n  "));
            }
        }
    }
}

#[test]
fn builds_in_the_plane_are_delaunay_by_definition() {
    builds_agree::<Plane>(1000, 12);
}

#[test]
fn builds_in_space_are_delaunay_by_definition() {
    builds_agree::<Space>(600, 9);
}

#[test]
fn histories_in_the_plane_end_in_the_delaunay_triangulation_by_definition() {
    histories_agree::<Plane>(300, 12);
}

#[test]
fn histories_in_space_end_in_the_delaunay_triangulation_by_definition() {
    histories_agree::<Space>(200, 9);
}
