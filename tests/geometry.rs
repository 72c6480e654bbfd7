//! Geometry computed from the cells, against exact integers and against brute force over all cells.

mod exact_cells;
mod flat_sides;
mod listed;
mod lists;
mod near;
mod power_cells;
mod power_near;
mod power_steps;
mod voronoi;
mod voronoi_exact;
mod voronoi_steps;
mod voronoi_within;

use crate::common::exact::{Grid, orientation, representatives};
use crate::common::inputs::{KINDS, Kind, QUANTUM, draw, draw_one, to_grid};
use crate::common::{Rng, point, seeds};
use deldrift::motion::{BoundaryFacet, MovingTriangulation, NO_CELL, NO_CORNER, Options};
use deldrift::{CellId, Dimension, Error, Plane, Space, VertexId};
use num_bigint::BigInt;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// A triangulation with a past: vertices have moved, come and gone.
fn with_a_past<G: Dimension>(kind: Kind, n: usize, rng: &mut Rng) -> MovingTriangulation<G> {
    let points = draw::<G>(kind, n, rng);
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
    t.cells().expect("room");
    for _ in 0..rng.below(3) {
        for v in VertexId::range(0..t.id_count()) {
            if rng.one_in(3) && t.is_present(v) {
                t.move_vertices(&[v], &[draw_one::<G>(kind, n, rng)]).expect("a good place");
            }
        }
        t.commit_timestamp().expect("room");
        let v = VertexId::at(rng.below(t.id_count() + 1));
        if t.is_present(v) {
            t.remove_vertex(v).expect("present");
        }
        t.insert_vertex(&draw_one::<G>(kind, n, rng)).expect("a good place");
    }
    t
}

/// Runs a check on triangulations of every kind.
fn on_all_kinds<G: Dimension>(check: impl Fn(&MovingTriangulation<G>, &mut Rng)) {
    for seed in seeds(3) {
        for kind in KINDS {
            let rng = &mut Rng::new(seed);
            let n = [0, 1, 5, 12, 60, 150][(seed as usize + kind as usize) % 6];
            check(&with_a_past::<G>(kind, n, rng), rng);
        }
        check(&with_a_past::<G>(Kind::Lattice, 200, &mut Rng::new(seed)), &mut Rng::new(seed));
    }
}

fn grid<G: Dimension>(t: &MovingTriangulation<G>, v: VertexId) -> Grid {
    to_grid::<G>(&t.position(v).expect("present"))
}

/// Vector n and determinant V of the circumsphere of integer points: the centre is at n / 2V from the first.
fn circumsphere(points: &[Grid]) -> (Vec<BigInt>, BigInt) {
    let difference = |p: &Grid| -> Vec<BigInt> {
        p.iter().zip(&points[0]).map(|(&x, &o)| BigInt::from(x) - BigInt::from(o)).collect()
    };
    let rows: Vec<Vec<BigInt>> = points[1..].iter().map(difference).collect();
    let det = |rows: &[Vec<BigInt>]| -> BigInt {
        let minor =
            |i: usize, j: usize, a: usize, b: usize| &rows[i][a] * &rows[j][b] - &rows[i][b] * &rows[j][a];
        if rows.len() == 2 {
            minor(0, 1, 0, 1)
        } else {
            &rows[0][0] * minor(1, 2, 1, 2) - &rows[0][1] * minor(1, 2, 0, 2)
                + &rows[0][2] * minor(1, 2, 0, 1)
        }
    };
    // Cramer's rule for 2 u·c = |u|².
    let squares: Vec<BigInt> = rows.iter().map(|u| u.iter().map(|x| x * x).sum()).collect();
    let n = (0..rows.len()).map(|axis| {
        let mut replaced = rows.clone();
        replaced.iter_mut().zip(&squares).for_each(|(row, square)| row[axis] = square.clone());
        det(&replaced)
    });
    (n.collect(), det(&rows))
}

fn shifted(x: &BigInt, by: i64) -> BigInt {
    if by >= 0 { x << by as u64 } else { x >> (-by) as u64 }
}

/// a · 2ᵉ / b as a number, off by a few last bits.
fn quotient(a: &BigInt, b: &BigInt, exponent: i64) -> f64 {
    let few_bits = |x: &BigInt| {
        let shift = x.bits() as i64 - 100;
        (i128::try_from(shifted(x, -shift)).expect("100 bits") as f64, shift)
    };
    let ((a, s), (b, r)) = (few_bits(a), few_bits(b));
    let (mut value, mut exponent) = (a / b, exponent + s - r);
    while exponent != 0 && value != 0.0 && value.is_finite() {
        let step = exponent.clamp(-900, 900);
        value *= 2f64.powi(step as i32);
        exponent -= step;
    }
    value
}

/// The sign of |n|² 2²ᵏ − 4 V² `squared`.
fn compare_radius(n: &[BigInt], volume: &BigInt, k: i64, squared: f64) -> Ordering {
    let bits = squared.to_bits();
    let (exponent, mantissa) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
    let (exponent, mantissa) =
        if exponent == 0 { (-1074, mantissa) } else { (exponent - 1075, mantissa | 1 << 52) };
    let left: BigInt = n.iter().map(|x| x * x).sum();
    let right = volume * volume * 4 * BigInt::from(mantissa);
    let least = exponent.min(2 * k);
    shifted(&left, 2 * k - least).cmp(&shifted(&right, exponent - least))
}

/// Cells with their corners in units of the quantum.
fn cells_of<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<Vec<Grid>> {
    let rows = t.cells().expect("room").corners;
    rows.iter().map(|row| row.as_ref().iter().map(|&v| grid(t, v)).collect()).collect()
}

/// Numbers of the cells of a triangulation whose positions are those of integers, times 2ᵏ.
fn check_measures<G: Dimension>(t: &MovingTriangulation<G>, cells: &[Vec<Grid>], k: i64, rng: &mut Rng) {
    let spheres: Vec<_> = t.circumspheres().expect("room").collect();
    let volumes: Vec<f64> = t.volumes().expect("room").collect();
    assert_eq!((spheres.len(), volumes.len()), (cells.len(), cells.len()));
    let mut bounds = vec![0.0, f64::from_bits(1), f64::MAX, f64::INFINITY];
    for ((corners, (centre, squared)), volume) in cells.iter().zip(&spheres).zip(&volumes) {
        let (n, det) = circumsphere(corners);
        assert_ne!(det, BigInt::ZERO, "a cell without volume");
        let factor = if G::D == 2 { 2 } else { 6 };
        let expected =
            quotient(&BigInt::from(det.magnitude().clone()), &BigInt::from(factor), G::D as i64 * k);
        assert!(*volume > 0.0);
        assert!((volume - expected).abs() <= 1e-9 * expected + 1e-323, "{volume}, not {expected}");
        let square: BigInt = n.iter().map(|x| x * x).sum();
        let wanted = quotient(&square, &(&det * &det * 4), 2 * k);
        let is_near = (squared - wanted).abs() <= 4e-9 * wanted + 1e-322;
        assert!(is_near || *squared == wanted, "{squared}, not {wanted}");
        for axis in 0..G::D {
            let doubled: BigInt = &n[axis] + 2 * &det * BigInt::from(corners[0][axis]);
            let wanted = quotient(&doubled, &(&det * 2), k);
            let error = (centre[axis] - wanted).abs();
            let scale = wanted.abs() + (corners[0][axis] as f64) * 2f64.powi(k as i32);
            assert!(error <= 1e-9 * squared.sqrt() + 1e-15 * scale || centre[axis] == wanted);
        }
        if rng.one_in(4) {
            bounds.extend([*squared, squared.next_up(), squared.next_down(), wanted, squared * rng.unit()]);
        }
    }
    rng.shuffle(&mut bounds);
    for bound in bounds.into_iter().filter(|&bound| bound >= 0.0).take(40) {
        let mask: Vec<bool> = t.mask_by_circumradius(bound).expect("room").collect();
        assert_eq!(mask.len(), cells.len());
        for (corners, is_in) in cells.iter().zip(mask) {
            let (n, det) = circumsphere(corners);
            let expected = bound.is_infinite() || compare_radius(&n, &det, k, bound) != Ordering::Greater;
            assert_eq!(is_in, expected, "{corners:?} 2^{k}, {bound:e}");
        }
    }
}

fn measures_are_those_of_integers<G: Dimension>() {
    let quantum = QUANTUM.log2() as i64;
    on_all_kinds::<G>(|t, rng| check_measures(t, &cells_of(t), quantum, rng));
    // At both ends of the range, where squares and products overflow or underflow.
    for k in [-1020, -500, -250, -60, 100, 153] {
        let rng = &mut Rng::new(7);
        let far = if k < 0 { 1 << 40 } else { 1 << 36 };
        for flatness in [1, 20, 1 << 30] {
            let points: Vec<Grid> = (0..40)
                .map(|_| {
                    (0..G::D)
                        .map(|axis| rng.within(0, if axis == 0 { far } else { far / flatness }))
                        .collect()
                })
                .collect();
            let scale = 2f64.powi(k);
            let scaled: Vec<G::Point> =
                points.iter().map(|p| point::<G>(|axis| p[axis] as f64 * scale)).collect();
            let t = MovingTriangulation::<G>::new(&scaled, Options::default()).expect("good points");
            let rows = t.cells().expect("room").corners;
            let cells: Vec<Vec<Grid>> =
                rows.iter().map(|row| row.as_ref().iter().map(|&v| points[v].clone()).collect()).collect();
            check_measures(&t, &cells, i64::from(k), rng);
        }
    }
}

#[test]
fn measures_in_the_plane() {
    measures_are_those_of_integers::<Plane>();
}

#[test]
fn measures_in_space() {
    measures_are_those_of_integers::<Space>();
}

/// Cells that are flat but for last bits, as those between the points of a lattice: rounded numbers know nothing of
/// their volumes.
#[test]
fn slivers_have_volumes_and_spheres() {
    const UNIT: i32 = 48;
    // Odd and long: a product of two has to be rounded.
    const SPACING: i64 = 0x1_2345_6789_abcd;
    let rng = &mut Rng::new(3);
    let points: Vec<Grid> = (0..216)
        .map(|k| [k % 6, k / 6 % 6, k / 36].map(|x| x * SPACING + rng.within(-4, 4)).to_vec())
        .collect();
    let scaled: Vec<[f64; 3]> =
        points.iter().map(|p| point::<Space>(|axis| p[axis] as f64 * 2f64.powi(-UNIT))).collect();
    let t = MovingTriangulation::<Space>::new(&scaled, Options::default()).expect("good points");
    assert!(t.volumes().expect("room").any(|volume| volume < 1e-13));
    let rows = t.cells().expect("room").corners;
    let cells: Vec<Vec<Grid>> =
        rows.iter().map(|row| row.iter().map(|&v| points[v].clone()).collect()).collect();
    check_measures(&t, &cells, i64::from(-UNIT), rng);
}

#[test]
fn radii_without_a_meaning_are_refused() {
    let t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Options::default());
    let t = t.expect("good points");
    for value in [-1.0, f64::NAN, f64::NEG_INFINITY, -f64::from_bits(1)] {
        assert!(matches!(t.mask_by_circumradius(value).map(drop), Err(Error::InvalidValue { .. })));
    }
    assert!(t.mask_by_circumradius(-0.0).expect("room").eq([false]));
    assert!(t.mask_by_circumradius(0.5).expect("room").eq([true]));
    assert!(t.mask_by_circumradius(0.5f64.next_down()).expect("room").eq([false]));
}

/// Facets of one or two cells, as sets of vertices, with who has them.
type Owners = BTreeMap<BTreeSet<VertexId>, Vec<(CellId, usize)>>;

fn owners_of<G: Dimension>(t: &MovingTriangulation<G>) -> Owners {
    let rows = t.cells().expect("room").corners;
    let mut owners = Owners::new();
    for (cell, row) in CellId::range(0..rows.len()).zip(rows) {
        for corner in 0..=G::D {
            let facet =
                row.as_ref().iter().enumerate().filter(|&(i, _)| i != corner).map(|(_, &v)| v).collect();
            owners.entry(facet).or_default().push((cell, corner));
        }
    }
    owners
}

fn check_boundary<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let owners = owners_of(t);
    let rows = t.cells().expect("room").corners;
    let density = 1 + rng.below(4);
    let random: Vec<u8> =
        rows.iter().map(|_| if rng.one_in(density) { rng.below(256) as u8 } else { 0 }).collect();
    for mask in [random, vec![1; rows.len()], vec![0; rows.len()]] {
        let mut found: Vec<BoundaryFacet<G::Vertices>> = Vec::new();
        t.mask_boundary(&mask, |facet| found.push(facet)).expect("room");
        assert!(found.is_sorted_by_key(|facet| (facet.cell, facet.corner)));
        let expected: BTreeSet<(CellId, usize)> = owners
            .values()
            .filter_map(|owners| {
                let mut inside = owners.iter().filter(|(cell, _)| mask[cell.index()] != 0);
                let first = inside.next().copied();
                if inside.next().is_none() { first } else { None }
            })
            .collect();
        assert!(found.iter().map(|facet| (facet.cell, facet.corner)).eq(expected));
        for facet in &found {
            let opposite = rows[facet.cell][facet.corner];
            let mut corners: Vec<Grid> = facet.vertices().iter().map(|&v| grid(t, v)).collect();
            corners.push(grid(t, opposite));
            let sign = orientation(&corners.iter().collect::<Vec<_>>());
            // Seen from the opposite corner, a facet of space turns the other way around.
            assert!(if G::D == 2 { sign > 0 } else { sign < 0 });
            let all: BTreeSet<VertexId> = facet.vertices().iter().copied().chain([opposite]).collect();
            assert!(all.iter().eq(&rows[facet.cell].as_ref().iter().copied().collect::<BTreeSet<_>>()));
        }
        if mask.iter().all(|&byte| byte != 0) {
            let mut hull = Vec::new();
            t.hull_facets(|facet| hull.push(facet)).expect("room");
            assert_eq!((hull.len(), &hull), (t.hull_facet_count(), &found));
        }
    }
    let wrong = t.mask_boundary(&vec![0; rows.len() + 1], |_| ());
    assert!(matches!(wrong, Err(Error::WrongCount { argument: "mask_count", .. })));
}

#[test]
fn boundaries_are_those_of_all_facets() {
    on_all_kinds::<Plane>(check_boundary);
    on_all_kinds::<Space>(check_boundary);
}

fn check_incidence<G: Dimension>(t: &MovingTriangulation<G>, _: &mut Rng) {
    let rows = t.cells().expect("room").corners;
    let ids = || VertexId::range(0..t.id_count());
    let mut edges = BTreeSet::new();
    let mut cells: BTreeMap<VertexId, Vec<CellId>> = ids().map(|v| (v, Vec::new())).collect();
    for (cell, row) in CellId::range(0..rows.len()).zip(rows) {
        for &v in row.as_ref() {
            cells.get_mut(&v).expect("an id").push(cell);
            edges.extend(row.as_ref().iter().filter(|&&w| v < w).map(|&w| [v, w]));
        }
    }
    assert!(t.edges().expect("room").iter().eq(&edges));
    assert_eq!(t.edge_count(), edges.len());
    let stars = t.vertex_cells().expect("room");
    let neighbours = t.vertex_neighbours().expect("room");
    assert_eq!((stars.offsets.len(), neighbours.offsets.len()), (t.id_count() + 1, t.id_count() + 1));
    assert_eq!(stars.entries.len(), rows.len() * (G::D + 1));
    assert_eq!(neighbours.entries.len(), 2 * edges.len());
    let positions: Vec<Option<G::Point>> = ids().map(|v| t.position(v).ok()).collect();
    let representatives = representatives(&positions);
    for v in ids() {
        assert_eq!(stars.row(v), cells[&v]);
        let expected: BTreeSet<VertexId> =
            edges.iter().filter_map(|&[a, b]| if a == v { Some(b) } else { (b == v).then_some(a) }).collect();
        assert!(neighbours.row(v).iter().eq(&expected));
        assert!(representatives[v] == Some(v) || stars.row(v).is_empty());
    }
}

#[test]
fn incidence_is_that_of_all_cells() {
    on_all_kinds::<Plane>(check_incidence);
    on_all_kinds::<Space>(check_incidence);
}

fn check_mirrors<G: Dimension>(t: &MovingTriangulation<G>, _: &mut Rng) {
    let owners = owners_of(t);
    let view = t.cells().expect("room");
    let mirrors: Vec<[u8; 4]> = t.mirror_indices().expect("room").collect();
    assert_eq!(mirrors.len(), view.corners.len());
    for owners in owners.values() {
        for &(cell, corner) in owners {
            let other = owners.iter().find(|&&owner| owner != (cell, corner));
            let expected = other.map_or(NO_CORNER, |&(_, mirror)| mirror as u8);
            assert_eq!(mirrors[cell.index()][corner], expected);
            assert_eq!(other.map_or(NO_CELL, |&(cell, _)| cell), view.neighbours[cell][corner]);
            assert_eq!(t.mirror_index(cell, corner).expect("room"), other.map(|&(_, mirror)| mirror));
        }
    }
    assert_eq!(t.mirror_index(CellId::at(mirrors.len()), 0).expect("room"), None);
    assert!(mirrors.iter().flat_map(|row| &row[G::D + 1..]).all(|&mirror| mirror == NO_CORNER));
}

#[test]
fn mirrors_are_opposite_the_same_facet() {
    on_all_kinds::<Plane>(check_mirrors);
    on_all_kinds::<Space>(check_mirrors);
}

fn check_ordered_stars(t: &MovingTriangulation<Plane>, _: &mut Rng) {
    let rows = t.cells().expect("room").corners;
    let mut edges: Vec<[VertexId; 2]> =
        rows.iter().flat_map(|row| (0..3).map(|i| [row[i], row[(i + 1) % 3]])).collect();
    edges.sort_unstable();
    for v in VertexId::range(0..t.id_count()) {
        let Ok(star) = t.ordered_star(v) else {
            assert!(!t.is_present(v));
            continue;
        };
        let star: Vec<CellId> = star.collect();
        let v = t.coincident_representative(v).expect("present");
        let mut unordered = Vec::new();
        t.star(v, &mut unordered).expect("room");
        assert_eq!(star.iter().collect::<BTreeSet<_>>(), unordered.iter().collect());
        assert_eq!(star.len(), unordered.len());
        // The vertices after v in each cell.
        let next = |cell: CellId, by: usize| {
            let row = rows[cell];
            row[(row.iter().position(|&w| w == v).expect("a corner") + by) % 3]
        };
        assert!(star.windows(2).all(|pair| next(pair[0], 2) == next(pair[1], 1)));
        let (Some(&first), Some(&last)) = (star.first(), star.last()) else { continue };
        if next(last, 2) == next(first, 1) {
            assert_eq!(Some(&first), star.iter().min());
        } else {
            assert!(edges.binary_search(&[next(first, 1), v]).is_err(), "an edge of the hull");
        }
    }
}

#[test]
fn ordered_stars_go_around() {
    on_all_kinds::<Plane>(check_ordered_stars);
}
