//! The grid of a lattice depends on nothing but the lattice; what is told is what is used, and given again it is kept.

use super::keeping::{load, seal};
use super::*;
use crate::damage::{Damage, LoadError};

/// A number in units of 2⁻¹⁶⁰, which all numbers here are multiples of.
struct Whole(num_bigint::BigInt);

impl Whole {
    fn of(x: f64) -> Self {
        let bits = x.abs().to_bits();
        let (mantissa, exponent) = ((bits & ((1 << 52) - 1)) | 1 << 52, (bits >> 52) as i32 - 1075);
        if x == 0.0 {
            return Whole(0.into());
        }
        let shift = usize::try_from(exponent + 160).expect("it is not so small");
        let magnitude = num_bigint::BigInt::from(mantissa) << shift;
        Whole(if x < 0.0 { -magnitude } else { magnitude })
    }

    fn is_number(&self) -> bool {
        let bits = self.0.bits();
        bits <= 53 || self.0.trailing_zeros().unwrap_or(0) + 53 >= bits
    }
}

/// A sum of multiples of vectors, and a place.
fn sum_of<G: Moving>(place: &G::Point, multiples: &[i64], vectors: &[G::Point]) -> Vec<num_bigint::BigInt> {
    let along = |axis: usize| {
        let of = |(n, v): (&i64, &G::Point)| Whole::of(v[axis]).0 * *n;
        Whole::of(place[axis]).0 + multiples.iter().zip(vectors).map(of).sum::<num_bigint::BigInt>()
    };
    (0..G::D).map(along).collect()
}

fn wholes<G: Moving>(place: &G::Point) -> Vec<num_bigint::BigInt> {
    (0..G::D).map(|axis| Whole::of(place[axis]).0).collect()
}

type Matrix = [[i64; 3]; 3];

/// A matrix of whole numbers with the determinant 1 or -1.
fn unimodular(rng: &mut Rng, rank: usize, steps: usize) -> Matrix {
    let mut m = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for _ in 0..steps {
        let (i, j) = (rng.below(rank), rng.below(rank));
        if i == j {
            m[i] = m[i].map(|x| -x);
        } else if rng.one_in(3) {
            m.swap(i, j);
        } else {
            let n = rng.within(-2, 2);
            m[i] = [0, 1, 2].map(|k| m[i][k] + n * m[j][k]);
        }
    }
    m
}

/// The basis of these multiples, if its numbers are doubles.
fn of_multiples<G: Moving>(m: &Matrix, basis: &[G::Point]) -> Option<Vec<G::Point>> {
    let zero = G::Point::default();
    let vector = |row: &[i64; 3]| {
        let mut vector = zero;
        for axis in 0..G::D {
            vector[axis] = basis.iter().zip(row).map(|(v, &n)| v[axis] * n as f64).sum();
        }
        (sum_of::<G>(&zero, row, basis) == wholes::<G>(&vector)).then_some(vector)
    };
    m[..basis.len()].iter().map(vector).collect()
}

/// The classes of cells, told by multiples of another basis, of which the vectors in force are these multiples.
fn classes_by<G: Moving>(
    t: &PeriodicTriangulation<G>,
    m: &Matrix,
    points: &[G::Point],
    basis: &[G::Point],
) -> BTreeSet<Class> {
    let at = |v: u32, s: [i64; 3]| place::<G>(points, basis, v, s).as_ref().to_vec();
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let mut set = BTreeSet::new();
    for (row, shifts) in t.cells().unwrap().corners.iter().zip(shifts.chunks(G::D + 1)) {
        let corners = row
            .as_ref()
            .iter()
            .zip(shifts)
            .map(|(v, s)| (v.get(), [0, 1, 2].map(|k| (0..3).map(|j| s[j] * m[j][k]).sum::<i64>())));
        assert!(set.insert(class(corners.collect(), &at)));
    }
    set
}

/// What is told, given afresh and staged, is kept as it is.
fn assert_kept<G: Moving>(t: &PeriodicTriangulation<G>, context: &str) {
    let used: Vec<G::Point> = VertexId::range(0..t.id_count()).map(|v| t.position(v).unwrap()).collect();
    let vectors: Vec<G::Point> = t.vectors().collect();
    let mut again = PeriodicTriangulation::<G>::new(&used, &vectors, Options::default()).unwrap();
    assert!(again.vectors().eq(vectors.iter().copied()), "{context}");
    assert!(again.lattice.is_equal(&t.lattice), "{context}");
    assert!(VertexId::range(0..used.len()).all(|v| again.position(v) == Ok(used[v])), "{context}");
    assert!(classes(&again, &used, &vectors) == classes(t, &used, &vectors), "{context}");
    again.stage_vectors(&vectors).unwrap();
    assert!(again.coming.is_none(), "{context}: nothing is other");
    let report = again.commit_positions(&used).unwrap();
    assert_eq!((report.moved, report.rebuilds, report.flips), (0, 0, 0), "{context}");
}

/// By thirds or halves of the vectors, where very much is tied; one of them twice.
fn tied_points<G: Moving>(rng: &mut Rng, basis: &[G::Point]) -> Vec<G::Point> {
    let n = if G::D == 2 { 3 } else { 2 };
    let mut points = Vec::new();
    let third = if G::D == 2 { 0..=0 } else { 0..=n - 1 };
    for (x, y, z) in crate::periodic::inside::all(0..=n - 1, 0..=n - 1, third) {
        let mut p = G::Point::default();
        for axis in 0..G::D {
            let along = |(k, j): (i32, usize)| {
                f64::from(k) / f64::from(n) * basis.get(j).map_or(f64::from(u8::from(axis == j)), |b| b[axis])
            };
            p[axis] = [x, y, z].into_iter().zip(0..3).map(along).sum();
        }
        points.push(p);
    }
    rng.shuffle(&mut points);
    points.push(points[0]);
    points
}

fn check_bases<G: Moving>(name: &str, basis: &[G::Point]) {
    let rng = &mut Rng::new(name.len() as u64);
    let points = tied_points::<G>(rng, basis);
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    assert_kept(&t, name);
    let identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    let (used, vectors): (Vec<_>, Vec<_>) =
        (VertexId::range(0..points.len()).map(|v| t.position(v).unwrap()).collect(), t.vectors().collect());
    let expected = classes_by(&t, &identity, &used, &vectors);
    let mut n_bases = 0;
    for seed in 0..60 {
        let m = unimodular(rng, basis.len(), 1 + seed % 7);
        if n_bases == if G::D == 2 { 10 } else { 4 } {
            break;
        }
        let Some(other) = of_multiples::<G>(&m, basis) else { continue };
        let context = format!("{name}: {m:?}");
        let mut made = PeriodicTriangulation::<G>::new(&points, &other, Options::default()).unwrap();
        assert_eq!(made.lattice.unit, t.lattice.unit, "{context}");
        for (v, &at) in used.iter().enumerate() {
            assert_eq!(made.position(VertexId::at(v)), Ok(at), "{context}");
        }
        for (row, told) in m.iter().zip(made.vectors()) {
            assert_eq!(sum_of::<G>(&G::Point::default(), row, &vectors), wholes::<G>(&told), "{context}");
        }
        assert!(classes_by(&made, &m, &used, &vectors) == expected, "{context}");
        assert_kept(&made, &context);
        // From one basis to the other in a commit.
        made.stage_vectors(basis).unwrap();
        made.commit_timestamp().unwrap();
        assert!(made.vectors().eq(vectors.iter().copied()), "{context}");
        assert!(classes_by(&made, &identity, &used, &vectors) == expected, "{context}");
        n_bases += 1;
    }
    assert!(n_bases >= 3, "{name}: {n_bases} bases");
}

/// A basis, and others like it of numbers that are not on the grid, and strained.
fn check_scaled<G: Moving>(name: &str, basis: &[G::Point]) {
    for (scale, strain) in [(1.0, 0.0), (0.7, 0.0), (0.7, 2f64.powi(-35)), (3.0, 1e-3)] {
        let mut scaled = basis.to_vec();
        for v in &mut scaled {
            (0..G::D).for_each(|axis| v[axis] *= scale);
            v[0] *= 1.0 + strain;
        }
        check_bases::<G>(&format!("{name} times {scale}, {strain}"), &scaled);
    }
}

const HEIGHT: f64 = 0.866_025_403_784_438_6;

#[test]
fn the_grid_and_the_cells_do_not_depend_on_the_basis() {
    let in_plane: [(&str, &[[f64; 2]]); 4] = [
        ("square", &[[1.0, 0.0], [0.0, 1.0]]),
        ("hexagonal", &[[1.0, 0.0], [0.5, HEIGHT]]),
        ("centred", &[[1.0, 0.0], [0.5, 1.25]]),
        ("diagonal", &[[0.5, 0.5], [0.5, -0.5]]),
    ];
    for (name, basis) in in_plane {
        check_scaled::<Plane>(name, basis);
    }
    let in_space: [(&str, &[[f64; 3]]); 8] = [
        ("cubic", &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        ("fcc", &[[0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]]),
        ("bcc", &[[-0.5, 0.5, 0.5], [0.5, -0.5, 0.5], [0.5, 0.5, -0.5]]),
        ("hexagonal prism", &[[1.0, 0.0, 0.0], [0.5, HEIGHT, 0.0], [0.0, 0.0, 1.5]]),
        ("triclinic", &[[1.0, 0.0, 0.0], [0.375, 1.0, 0.0], [0.25, -0.375, 1.25]]),
        ("square slab", &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        ("hexagonal slab", &[[1.0, 0.0, 0.0], [0.5, HEIGHT, 0.0]]),
        ("oblique hexagonal slab", &[[1.0, -1.0, 0.0], [0.0, 1.0, -1.0]]),
    ];
    for (name, basis) in in_space {
        check_scaled::<Space>(name, basis);
    }
}

/// One direction alone has no other bases than the opposite one.
#[test]
fn one_vector_and_its_opposite_have_one_grid() {
    for vector in [[0.7, 0.0], [0.75, 0.25], [0.7, -0.1]] {
        let points = [[0.1, 0.2], [0.3, 0.4], [0.7, 0.9]];
        let of = |v| PeriodicTriangulation::<Plane>::new(&points, &[v], Options::default()).unwrap();
        let (t, opposite) = (of(vector), of(vector.map(|x| -x)));
        assert_eq!(t.lattice.unit, opposite.lattice.unit);
        assert!(t.vectors().map(|v| v.map(|x| -x)).eq(opposite.vectors()));
        assert_kept(&t, "one vector");
        assert_kept(&opposite, "its opposite");
    }
}

/// Vectors of a box that is skewed by up to 2 to the `bits` of its lengths.
fn skewed<G: Moving>(rng: &mut Rng, rank: usize, bits: i64) -> Vec<G::Point> {
    let mut basis = vec![G::Point::default(); rank];
    for (j, vector) in basis.iter_mut().enumerate() {
        (0..G::D)
            .for_each(|axis| vector[axis] = 0.3 * (rng.unit() - 0.5) + if axis == j { 1.0 } else { 0.0 });
    }
    for j in 1..rank {
        for i in 0..j {
            let n = (2f64.powi(rng.within(0, bits) as i32) * (rng.unit() - 0.5)).round();
            (0..G::D).for_each(|axis| basis[j][axis] += n * basis[i][axis]);
        }
    }
    basis
}

/// Sums of the told vectors are the reduced ones, to the last bit, and positions differ from their places by sums of the told
/// ones.
fn check_identities<G: Moving>(seed: u64, rank: usize, bits: i64) {
    let rng = &mut Rng::new(seed);
    let basis = skewed::<G>(rng, rank, bits);
    let context = format!("seed {seed}: {basis:?}");
    let points: Vec<G::Point> = (0..4)
        .map(|_| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = 4.0 * rng.unit());
            p
        })
        .collect();
    let t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default())
        .unwrap_or_else(|error| panic!("{context}: {error}"));
    let told: Vec<G::Point> = t.vectors().collect();
    for (reduced, multiples, _) in t.reduced_vectors() {
        assert_eq!(sum_of::<G>(&G::Point::default(), &multiples, &told), wholes::<G>(&reduced), "{context}");
    }
    for (v, (at, shift)) in t.wrap_positions(&points, None).unwrap().iter().enumerate() {
        let position = t.position(VertexId::at(v)).unwrap();
        assert_eq!(sum_of::<G>(at, shift, &told), wholes::<G>(&position), "{context}");
    }
    // As far as the numbers that are given have digits.
    for (told, given) in told.iter().zip(&basis) {
        let way = (0..G::D).map(|axis| (told[axis] - given[axis]).abs()).fold(0.0, f64::max);
        let size = (0..G::D).map(|axis| given[axis].abs()).fold(1.0, f64::max);
        assert!(way <= size * 2f64.powi(if rank < G::D { -36 } else { -46 }), "{context}: {told:?}");
    }
    if rank == G::D {
        let volumes = t.voronoi_volumes(&mut |_| true).unwrap();
        let (sum, size) = (volumes.iter().sum::<f64>(), t.lattice.measure());
        assert!((sum - size).abs() < 1e-12 * size, "{context}: {sum} {size}");
    }
    assert_kept(&t, &context);
}

#[test]
fn told_vectors_are_those_that_are_used() {
    for seed in 0..200 {
        check_identities::<Plane>(seed, 2, 11);
        check_identities::<Space>(seed, 3, 9);
    }
    for seed in 0..40 {
        check_identities::<Plane>(seed, 2, 30);
        check_identities::<Space>(seed, 2, 9);
    }
    let basis = [[0.955_543_669_281_183_7, 0.0], [16.213_499_340_688_09, 1.085_168_619_378_701_6]];
    let t = PeriodicTriangulation::<Plane>::new(&[[0.5; 2]], &basis, Options::default()).unwrap();
    assert_kept(&t, "an identity that has failed");
    // No number of 64 bits has the multiples, or there is nothing left of the shorter vector on the grid.
    for vectors in [[[0.7, 0.1], [1e25, 1.0]], [[1e50, 1e50], [1e-50, -1e-50]]] {
        let refused = PeriodicTriangulation::<Plane>::new(&[], &vectors, Options::default()).err();
        assert_eq!(refused, Some(Error::DependentVectors { count: 2 }));
    }
}

/// Vertices that are many periods away, in boxes that are skewed by many lengths: exact, or out of range.
#[test]
fn far_positions_in_skewed_boxes_are_exact_or_refused() {
    let (mut n_right, mut n_refused) = (0, 0);
    for seed in 0..240 {
        let rng = &mut Rng::new(seed);
        let basis = skewed::<Plane>(rng, 2, (seed % 4) as i64 * 11);
        let far = 2f64.powi(rng.within(0, 70) as i32);
        let points: Vec<[f64; 2]> =
            (0..3).map(|_| [far * (rng.unit() - 0.5), far * (rng.unit() - 0.5)]).collect();
        match PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()) {
            Err(Error::OutOfRange { argument: "positions", index, axis, value, limit }) => {
                assert!(value == points[index][axis] && value.abs() > limit && limit > 1e3);
                n_refused += 1;
            }
            Err(error) => panic!("seed {seed}: {error}"),
            Ok(t) => {
                let (told, used): (Vec<[f64; 2]>, Vec<[f64; 2]>) =
                    (t.vectors().collect(), (0..3).map(|v| t.position(VertexId::new(v)).unwrap()).collect());
                for ((at, shift), position) in t.wrap_positions(&used, None).unwrap().iter().zip(&used) {
                    let sum = sum_of::<Plane>(at, shift, &told);
                    assert_eq!(sum, wholes::<Plane>(position), "seed {seed}");
                }
                // Both ends of an edge are no farther from each other than reduced vectors allow, exactly.
                for ([from, to], shift) in t.edges().unwrap() {
                    let end = sum_of::<Plane>(&used[to.index()], &shift, &told);
                    let way = end.iter().zip(wholes::<Plane>(&used[from.index()])).map(|(x, y)| x - y);
                    let limit = Whole::of(1e3).0;
                    assert!(way.into_iter().all(|x| x < limit && -x < Whole::of(1e3).0), "seed {seed}");
                }
                n_right += 1;
            }
        }
    }
    assert!(n_right > 100 && n_refused > 20, "{n_right} right, {n_refused} refused");
}

/// What is told, committed, moves nothing: however far away vertices are, and however they have come there.
fn check_told<G: Moving>(seed: u64, rank: usize) {
    let rng = &mut Rng::new(seed);
    let basis = skewed::<G>(rng, rank, 3);
    let any = |rng: &mut Rng| {
        let far = 2f64.powi(rng.within(0, if rank < G::D { 8 } else { 44 }) as i32);
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| p[axis] = far * (rng.unit() - 0.5));
        p
    };
    let points: Vec<G::Point> = (0..6).map(|_| any(rng)).collect();
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    for step in 0..8 {
        let first = VertexId::new(0);
        match step {
            1 => t.move_vertices(&[first], &[any(rng)]).unwrap(),
            2 => t.stage_insertions(&[any(rng), any(rng)]).map(drop).unwrap(),
            3 => {
                let mut other = basis.clone();
                other[0][0] *= 1.0 + 0.1 * rng.unit();
                t.stage_vectors(&other).unwrap();
            }
            4 => t.relocate_vertex(first, &any(rng)).unwrap(),
            5 => t.insert_vertex(&any(rng)).map(drop).unwrap(),
            6 => t.stage_vectors(&skewed::<G>(rng, rank, 3)).unwrap(),
            7 => t = load(&t.saved().unwrap()).unwrap(),
            _ => {}
        }
        t.commit_timestamp().unwrap();
        let ids = || VertexId::range(0..t.id_count());
        let told: Vec<G::Point> = ids().map(|v| t.position(v).unwrap()).collect();
        let mut copy = t.try_clone(None).unwrap();
        let report = copy.commit_positions(&told).unwrap();
        assert_eq!(report.moved, 0, "seed {seed}, step {step}");
        assert!(ids().all(|v| copy.position(v) == Ok(told[v])), "seed {seed}, step {step}");
    }
}

#[test]
fn told_positions_move_nothing() {
    for seed in 0..60 {
        check_told::<Plane>(seed, 2);
        check_told::<Plane>(seed, 1);
        check_told::<Space>(seed, 3);
        check_told::<Space>(seed, 2);
    }
}

/// Data with a vertex in a far period are those of a triangulation only if its position there is a number.
fn check_far_data<G: Moving>() {
    let mut basis = vec![G::Point::default(); G::D];
    (0..G::D).for_each(|axis| basis[axis][axis] = 1.0);
    let (mut n_right, mut n_refused) = (0, 0);
    for start in [0.099_999_999_999_999_64, 0.5, 0.1, 0.625] {
        let mut first = G::Point::default();
        (0..G::D).for_each(|axis| first[axis] = start);
        let t = PeriodicTriangulation::<G>::new(&[first, G::Point::default()], &basis, Options::default())
            .unwrap();
        let position = t.position(VertexId::new(0)).unwrap();
        let bytes = t.saved().unwrap();
        for k in 0..63 {
            for n in [1i64 << k, -(1i64 << k), (1i64 << k) + 1] {
                let mut bytes = bytes.clone();
                let at = 192 + 8 * G::D * G::D;
                bytes[at..at + 8].copy_from_slice(&n.to_le_bytes());
                seal(&mut bytes);
                let there = Whole::of(position[0]).0 + Whole::of(1.0).0 * n;
                match load::<G>(&bytes) {
                    Err(error) => {
                        let vertex = VertexId::new(0);
                        assert_eq!(error, LoadError::Data(Damage::Period { vertex }), "{start} and {n}");
                        assert!(!Whole(there).is_number() || k > 40, "{start} and {n}");
                        n_refused += 1;
                    }
                    Ok(mut loaded) => {
                        let told: Vec<G::Point> =
                            (0..2).map(|v| loaded.position(VertexId::new(v)).unwrap()).collect();
                        assert_eq!(Whole::of(told[0][0]).0, there, "{start} and {n}");
                        assert_eq!(loaded.commit_positions(&told).unwrap().moved, 0, "{start} and {n}");
                        n_right += 1;
                    }
                }
            }
        }
    }
    assert!(n_right > 100 && n_refused > 100, "{n_right} right, {n_refused} refused");
}

#[test]
fn data_with_positions_that_are_no_numbers_are_refused() {
    check_far_data::<Plane>();
    check_far_data::<Space>();
}
