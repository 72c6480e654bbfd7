//! Point location: answers against exact arithmetic over all cells and vertices, on clouds large enough for landmarks,
//! while points move, come and go.

use crate::common::{Rng, point};
use deldrift::motion::{Level, Location, MovingTriangulation, NO_CELL, Options};
use deldrift::{CellId, Dimension, Plane, Space, VertexId};

/// Coordinates are integers of at most this magnitude, so that determinants fit into 128 bits.
const MOST: i64 = 1 << 20;

/// Uniform, or in tight clusters.
fn somewhere<G: Dimension>(rng: &mut Rng, clustered: bool) -> G::Point {
    let cluster = rng.within(0, 7);
    point::<G>(|axis| {
        if clustered {
            let centre = (cluster * (axis as i64 + 3) % 8) * (MOST / 8);
            (centre + rng.within(0, 300)) as f64
        } else {
            rng.within(0, MOST) as f64
        }
    })
}

/// Sign of the determinant of the differences from the first point.
fn orientation<G: Dimension>(points: &[G::Point]) -> i128 {
    let difference = |i: usize, axis: usize| points[i][axis] as i128 - points[0][axis] as i128;
    let minor = |i: usize, j: usize, a: usize, b: usize| {
        difference(i, a) * difference(j, b) - difference(i, b) * difference(j, a)
    };
    if G::D == 2 {
        minor(1, 2, 0, 1)
    } else {
        minor(1, 2, 0, 1) * difference(3, 2) - minor(1, 3, 0, 1) * difference(2, 2)
            + minor(2, 3, 0, 1) * difference(1, 2)
    }
}

/// The signs of `q` in place of each corner of a cell, by that of the cell.
fn signs<G: Dimension>(t: &MovingTriangulation<G>, cell: CellId, q: &G::Point) -> Vec<i128> {
    let view = t.cells().expect("room");
    let corners = view.corners[cell].as_ref().to_vec();
    let points: Vec<G::Point> = corners.iter().map(|&v| t.position(v).expect("present")).collect();
    let whole = orientation::<G>(&points).signum();
    (0..=G::D)
        .map(|i| {
            let mut replaced = points.clone();
            replaced[i] = *q;
            orientation::<G>(&replaced).signum() * whole
        })
        .collect()
}

fn check<G: Dimension>(t: &MovingTriangulation<G>, q: &G::Point, location: Location) {
    match location {
        Location::Vertex(v) => assert_eq!(t.position(v).expect("present"), *q),
        Location::Cell(c) => assert!(signs(t, c, q).iter().all(|&sign| sign >= 0)),
        Location::Outside(c) => {
            let view = t.cells().expect("room");
            let neighbours = view.neighbours[c].as_ref();
            let beyond = signs(t, c, q);
            assert!(beyond.iter().zip(neighbours).any(|(&sign, &n)| sign < 0 && n == NO_CELL));
        }
        Location::NoCells => panic!("there are cells"),
    }
    // A place at a vertex is told as that.
    if !matches!(location, Location::Vertex(_)) {
        let nearest = t.nearest_vertex(q).expect("room").expect("vertices");
        assert_ne!(t.position(nearest).expect("present"), *q);
    }
}

fn square_distance<G: Dimension>(p: &G::Point, q: &G::Point) -> i128 {
    (0..G::D).map(|axis| (p[axis] as i128 - q[axis] as i128).pow(2)).sum()
}

fn check_nearest<G: Dimension>(t: &MovingTriangulation<G>, q: &G::Point) {
    let present = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v));
    let expected = present.min_by_key(|&v| (square_distance::<G>(&t.position(v).expect("present"), q), v));
    assert_eq!(t.nearest_vertex(q).expect("room"), expected);
}

fn queries<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng, n: usize, clustered: bool) {
    let mut places: Vec<G::Point> = (0..n).map(|_| somewhere::<G>(rng, clustered)).collect();
    // Some outside, some at vertices.
    places.push(point::<G>(|_| -3.0));
    places.push(point::<G>(|axis| if axis == 0 { (2 * MOST) as f64 } else { 5.0 }));
    places.extend(
        VertexId::range(0..t.id_count())
            .filter(|&v| t.is_present(v))
            .take(5)
            .map(|v| t.position(v).expect("present")),
    );
    let mut found = Vec::new();
    let cell = |c: u32| Some(Location::Cell(CellId::new(c)));
    let near = [None, cell(3), Some(Location::Vertex(VertexId::new(7))), cell(u32::MAX - 1)];
    t.locate_points(&places, *rng.pick(&near), |location| found.push(location)).expect("room");
    assert_eq!(found.len(), places.len());
    for (q, bulk) in places.iter().zip(found) {
        let alone = t.locate(q).expect("good places");
        check(t, q, alone);
        check(t, q, bulk);
    }
    for q in places.iter().step_by(50) {
        check_nearest(t, q);
    }
}

fn histories<G: Dimension>(seed: u64, clustered: bool) {
    let rng = &mut Rng::new(seed);
    let points: Vec<G::Point> = (0..3000).map(|_| somewhere::<G>(rng, clustered)).collect();
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
    for round in 0..8 {
        queries(&t, rng, 400, clustered);
        match round % 4 {
            // Far from where the landmarks were.
            0 => {
                let moved: Vec<G::Point> =
                    (0..t.id_count()).map(|_| somewhere::<G>(rng, clustered)).collect();
                t.commit_positions(&moved).expect("good places");
            }
            1 => {
                for v in VertexId::range(0..t.id_count()).filter(|v| v.get() % 3 == round) {
                    if t.is_present(v) {
                        t.remove_vertex(v).expect("present");
                    }
                }
            }
            2 => {
                for _ in 0..800 {
                    let q = somewhere::<G>(rng, clustered);
                    t.insert_vertex(&q).expect("good place");
                }
                t.validate(Level::Delaunay).expect("valid");
            }
            _ => {
                t.compact().expect("room");
            }
        }
    }
}

#[test]
fn places_are_found_in_the_plane() {
    for seed in 0..4 {
        histories::<Plane>(seed, seed % 2 == 1);
    }
}

#[test]
fn places_are_found_in_space() {
    for seed in 0..4 {
        histories::<Space>(seed, seed % 2 == 1);
    }
}
