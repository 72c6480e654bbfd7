//! Beside the definition: a place is in the cell, or at the vertex, that is told, where it is told to be.

use super::*;
use crate::ids::CellId;
use crate::motion::Location;

/// Boxes of all kinds: square, skewed, thin and skewed by more than five of their lengths, slabs and rods.
pub(super) const OF_PLANE: [&[[f64; 2]]; 6] = [
    &[[1.0, 0.0], [0.0, 1.0]],
    &[[1.0, 0.25], [-0.125, 3.0]],
    &[[1.0, 0.0], [5.25, 1.0]],
    &[[1.0, 0.0], [0.375, 16.0]],
    &[[1.0, 0.0]],
    &[[0.75, 0.25]],
];
pub(super) const OF_SPACE: [&[[f64; 3]]; 6] = [
    &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.5]],
    &[[1.0, 0.0, 0.0], [5.25, 3.0, 0.0], [0.5, 5.25, 0.6875]],
    &[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.5, 5.0]],
    &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]],
    &[[0.75, 0.25, 0.0]],
];

/// A lattice of points of a box, where much ties, or random ones on a fine grid.
pub(super) fn points_of_kind<G: Moving>(rng: &mut Rng, n: usize, basis: &[G::Point]) -> Vec<G::Point> {
    let mut points = random_points::<G>(rng, n, basis);
    if rng.one_in(2) {
        for p in &mut points {
            (0..G::D).for_each(|axis| p[axis] = (p[axis] * 4.0).round() / 4.0);
        }
    }
    points
}

/// A position, maybe many periods away, maybe at a vertex or in the middle of two.
pub(super) fn position<G: Moving>(rng: &mut Rng, points: &[G::Point], basis: &[G::Point]) -> G::Point {
    let mut p = random_points::<G>(rng, 1, basis)[0];
    match rng.below(4) {
        0 => p = points[rng.below(points.len())],
        1 => {
            let [q, r] = [0, 1].map(|_| points[rng.below(points.len())]);
            (0..G::D).for_each(|axis| p[axis] = (q[axis] + r[axis]) / 2.0);
        }
        2 => (0..G::D).for_each(|axis| p[axis] = (p[axis] * 8.0).round() / 8.0),
        _ => (0..G::D).for_each(|axis| p[axis] = 3.0 * p[axis] - 1.0),
    }
    let most = [1, 3, 1 << 20][rng.below(3)];
    let shift = [0, 1, 2].map(|_| rng.below(2 * most + 1) as i64 - most as i64);
    place::<G>(&[p], basis, 0, shift)
}

/// Whether a place is on the inner side of the facet of a cell that is opposite a corner, or in its plane.
fn side<G: Moving>(corners: &[G::Point], i: usize, p: &G::Point) -> f64 {
    let (mut low, mut high) = (*p, *p);
    for q in corners {
        for axis in 0..G::D {
            (low[axis], high[axis]) = (low[axis].min(q[axis]), high[axis].max(q[axis]));
        }
    }
    let mut points: Vec<&G::Point> = corners.iter().collect();
    points[i] = p;
    G::orient(&G::filter(&low, &high), &points)
}

/// The corners of a cell after a translation from where its shifts have it.
pub(super) fn corners<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
    cell: CellId,
    shift: [i64; 3],
) -> Vec<G::Point> {
    let row = t.cells().unwrap().corners[cell];
    let shifts: Vec<_> = t.cell_shifts().unwrap().skip(cell.index() * (G::D + 1)).take(G::D + 1).collect();
    let by = |i: usize| [0, 1, 2].map(|j| shifts[i][j] + shift[j]);
    (0..=G::D).map(|i| place::<G>(points, basis, row.as_ref()[i].get(), by(i))).collect()
}

/// What a triangulation says of where positions are.
struct Found<'t, G: Moving> {
    t: &'t PeriodicTriangulation<G>,
    points: &'t [G::Point],
    basis: &'t [G::Point],
}

impl<G: Moving> Found<'_, G> {
    fn check(&self, p: &G::Point, location: Location, shift: [i64; 3]) {
        match location {
            Location::Vertex(v) => {
                let at = place::<G>(self.points, self.basis, v.get(), shift);
                assert_eq!(at.as_ref(), p.as_ref());
                assert_eq!(self.t.coincident_representative(v), Ok(v));
            }
            Location::Cell(cell) => {
                let corners = corners(self.t, self.points, self.basis, cell, shift);
                assert!((0..=G::D).all(|i| side::<G>(&corners, i, p) >= 0.0), "{p:?} {corners:?}");
                assert!(corners.iter().all(|q| q.as_ref() != p.as_ref()));
            }
            Location::Outside(cell) => {
                let corners = corners(self.t, self.points, self.basis, cell, shift);
                let hull = self.t.cells().unwrap().neighbours[cell];
                let is_before = |i: usize| hull.as_ref()[i] == NO_CELL && side::<G>(&corners, i, p) < 0.0;
                assert!((0..=G::D).any(is_before), "{p:?} {corners:?}");
            }
            Location::NoCells => {
                assert_eq!((self.t.cell_count(), shift), (Ok(0), [0; 3]));
                let mut way = |v: u32| {
                    let q = self.points[v as usize];
                    let mut way = *p;
                    (0..G::D).for_each(|axis| way[axis] -= q[axis]);
                    let k = self.t.lattice.multiples(&way).map(f64::round);
                    (0..G::D).all(|axis| {
                        let by = (0..self.basis.len()).map(|j| {
                            k[j] * self
                                .t
                                .lattice
                                .translated(&G::Point::default(), [0, 1, 2].map(|i| i32::from(i == j)))[axis]
                        });
                        way[axis] == by.sum::<f64>()
                    })
                };
                assert!(!(0..self.points.len() as u32).any(&mut way), "{p:?} is at a vertex");
            }
        }
    }
}

fn check_located<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
    rng: &mut Rng,
) {
    let found = Found { t, points, basis };
    let positions: Vec<G::Point> = (0..40).map(|_| position::<G>(rng, points, basis)).collect();
    let mut told = positions.iter();
    t.locate_in_period(&positions, None, |location, shift| {
        found.check(told.next().unwrap(), location, shift);
        // Alone it may be in another cell that has it on its boundary.
        let p = &positions[positions.len() - told.len() - 1];
        let alone = t.locate(p).unwrap();
        assert!(
            match (alone, location) {
                (Location::Vertex(v), Location::Vertex(w)) => v == w,
                (Location::Cell(_), Location::Cell(_)) | (Location::Outside(_), Location::Outside(_)) => true,
                (one, other) => one == other,
            },
            "{alone:?} {location:?}"
        );
        let mut n_told = 0;
        t.locate_in_period(&[*p], Some(location), |location, shift| {
            found.check(p, location, shift);
            n_told += 1;
        })
        .unwrap();
        assert_eq!(n_told, 1);
    })
    .unwrap();
    assert!(told.next().is_none());
}

fn check_all<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let mut points = points_of_kind::<G>(rng, n, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    check_located(&t, &points, basis, rng);
    for _ in 0..3 {
        // Vertices drift out of the unit cell, and some are taken back in.
        for p in &mut points {
            for axis in 0..G::D {
                p[axis] += (rng.below(64) as f64 - 31.0) / 512.0;
            }
            if rng.one_in(4) {
                let shift = [0, 1, 2].map(|_| rng.below(5) as i64 - 2);
                *p = place::<G>(&[*p], basis, 0, shift);
            }
        }
        t.commit_positions(&points).unwrap();
        check_located(&t, &points, basis, rng);
    }
}

#[test]
fn places_are_where_they_are_told_to_be() {
    for seed in 0..48 {
        let n = [1, 2, 3, 4, 7, 20, 60, 300][seed as usize / 6];
        check_all::<Plane>(seed, OF_PLANE[seed as usize % 6], n);
        check_all::<Space>(seed, OF_SPACE[seed as usize % 6], n.min(100));
    }
}

/// Places are rounded as vertices are.
#[test]
fn a_place_is_at_a_vertex_that_would_be_put_there() {
    let rng = &mut Rng::new(3);
    let basis = [[0.3, 0.1], [0.7, 1.9]];
    for _ in 0..200 {
        let p = [0, 1].map(|_| rng.within(0, (1 << 40) - 1) as f64 / 3e11 - 1.0);
        let t = PeriodicTriangulation::<Plane>::new(&[[0.1, 0.2], p], &basis, Options::default()).unwrap();
        let used = t.position(VertexId::new(1)).unwrap();
        for p in [p, used] {
            t.locate_in_period(&[p], None, |location, shift| {
                assert_eq!((location, shift), (Location::Vertex(VertexId::new(1)), [0; 3]));
            })
            .unwrap();
        }
    }
}

#[test]
fn where_nothing_is_there_are_no_cells() {
    let basis = [[1.0, 0.0], [0.0, 1.0]];
    let t = PeriodicTriangulation::<Plane>::new(&[], &basis, Options::default()).unwrap();
    assert_eq!(t.locate(&[0.5, 0.5]), Ok(Location::NoCells));
    let t = PeriodicTriangulation::<Plane>::new(&[[0.0, 0.5], [0.5, 0.5]], &basis[..1], Options::default())
        .unwrap();
    assert_eq!(t.locate(&[7.25, 0.5]), Ok(Location::NoCells));
    assert_eq!(t.locate(&[7.5, 0.5]), Ok(Location::Vertex(VertexId::new(1))));
    let bad = t.locate(&[f64::NAN, 0.0]);
    assert!(matches!(bad, Err(Error::NotFinite { argument: "position", axis: 0, .. })));
    let bad = t.locate_in_period(&[[0.0; 2], [1e99, 0.0]], None, |_, _| panic!("nothing is told"));
    assert!(matches!(bad, Err(Error::OutOfRange { argument: "positions", index: 1, axis: 0, .. })));
}

/// What locating takes, beside an open triangulation of as many vertices.
#[test]
#[ignore = "prints times"]
fn times_of_locating() {
    use std::time::Instant;
    let rng = &mut Rng::new(1);
    let basis = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let points = random_points::<Space>(rng, 100_000, &basis);
    let positions = random_points::<Space>(rng, 100_000, &basis);
    let open = MovingTriangulation::<Space>::new(&points, Options::default()).unwrap();
    let t = PeriodicTriangulation::<Space>::new(&points, &basis, Options::default()).unwrap();
    open.cells().unwrap();
    t.cells().unwrap();
    for _ in 0..3 {
        let (mut n, start) = (0, Instant::now());
        open.locate_points(&positions, None, |location| n += usize::from(location != Location::NoCells))
            .unwrap();
        let of_open = start.elapsed().as_secs_f64();
        let start = Instant::now();
        t.locate_in_period(&positions, None, |location, _| n += usize::from(location != Location::NoCells))
            .unwrap();
        println!("{:.1} ms, open {:.1} ms, {n}", 1e3 * start.elapsed().as_secs_f64(), 1e3 * of_open);
    }
    let asked = t.asked(&positions).unwrap();
    let (cells, mut n_searched) = (t.read_cells().unwrap(), 0);
    t.inside
        .t
        .locate_points(&asked.places, None, |location| {
            n_searched += usize::from(!matches!(location, Location::Cell(c) if cells.class_of[c] != NO_CELL));
        })
        .unwrap();
    println!("{n_searched} searched for beyond what is inside");
}
