//! What a predicate costs, by the stage that decides it, beside the crate that is our exact stage.
//!
//! - *static*: random points of the unit box, nearly all decided by the static filter;
//! - *semi-static*: the same points with the filter of a box too large to decide anything;
//! - *tie*: points of a small lattice, degenerate and decided exactly; their differences have some fifty bits;
//! - *short tie*: those of a lattice whose differences have one bit.
//!
//! Times are per call, over inputs that fit the first-level cache.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use deldrift::internals::predicates::*;
use robust::{Coord, Coord3D};
use std::array::from_fn;
use std::hint::black_box;

const N_CASES: usize = 128;

/// `N_CASES` sets of `N` points with coordinates made from pseudo-random bits.
fn cases<const D: usize, const N: usize>(coordinate: impl Fn(u64) -> f64) -> Vec<[[f64; D]; N]> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        coordinate(state)
    };
    (0..N_CASES).map(|_| from_fn(|_| from_fn(|_| next()))).collect()
}

fn uniform(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

/// Corners of the unit box.
fn binary(bits: u64) -> f64 {
    (bits >> 63) as f64
}

/// Corners of the unit box, off the binary grid by the same amount, so that sums are rounded.
fn corner(bits: u64) -> f64 {
    (bits >> 63) as f64 + 0.1
}

fn bench<T, R>(group: &mut BenchmarkGroup<WallTime>, name: &str, cases: &[T], call: impl Fn(&T) -> R) {
    group.throughput(Throughput::Elements(cases.len() as u64));
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for case in black_box(cases) {
                black_box(call(case));
            }
        });
    });
}

/// One predicate on its kinds of input, ours and robust's.
fn bench_stages<const D: usize, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
    ours: impl Fn(&StaticFilter, &[[f64; D]; N]) -> f64,
    robust: impl Fn(&[[f64; D]; N]) -> f64,
) {
    let tight = filter([0.0; D], [1.25; D]);
    let wide = filter([0.0; D], [MAX_MAGNITUDE; D]);
    let (random, ties, short_ties) = (cases(uniform), cases(corner), cases(binary));
    let mut group = criterion.benchmark_group(name);
    bench(&mut group, "static", &random, |p| ours(&tight, p));
    bench(&mut group, "semi-static", &random, |p| ours(&wide, p));
    bench(&mut group, "tie", &ties, |p| ours(&tight, p));
    bench(&mut group, "short tie", &short_ties, |p| ours(&tight, p));
    bench(&mut group, "robust", &random, &robust);
    bench(&mut group, "robust, tie", &ties, &robust);
    group.finish();
}

fn plane(criterion: &mut Criterion) {
    let coord = |&[x, y]: &[f64; 2]| Coord { x, y };
    bench_stages(
        criterion,
        "orient2d",
        StaticFilter::plane,
        |f, [a, b, c]| orient2d(f, a, b, c),
        |p| {
            let [a, b, c] = p.each_ref().map(coord);
            robust::orient2d(a, b, c)
        },
    );
    bench_stages(
        criterion,
        "incircle",
        StaticFilter::plane,
        |f, [a, b, c, d]| incircle(f, a, b, c, d),
        |p| {
            let [a, b, c, d] = p.each_ref().map(coord);
            robust::incircle(a, b, c, d)
        },
    );
}

fn space(criterion: &mut Criterion) {
    let coord = |&[x, y, z]: &[f64; 3]| Coord3D { x, y, z };
    bench_stages(
        criterion,
        "orient3d",
        StaticFilter::space,
        |f, [a, b, c, d]| orient3d(f, a, b, c, d),
        |p| {
            let [a, b, c, d] = p.each_ref().map(coord);
            robust::orient3d(a, b, c, d)
        },
    );
    bench_stages(
        criterion,
        "insphere",
        StaticFilter::space,
        |f, [a, b, c, d, e]| insphere(f, a, b, c, d, e),
        |p| {
            let [a, b, c, d, e] = p.each_ref().map(coord);
            robust::insphere(a, b, c, d, e)
        },
    );
}

fn ties_and_distances(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("decided by id");
    let f = StaticFilter::plane([0.0; 2], [1.25; 2]);
    let square = [[0.1, 0.1], [1.1, 0.1], [1.1, 1.1], [0.1, 1.1]];
    let circles = vec![square; N_CASES];
    bench(&mut group, "incircle_perturbed", &circles, |p| {
        incircle_perturbed(&f, p.each_ref(), || [3, 1, 4, 2])
    });
    let f = StaticFilter::space([0.0; 3], [1.25; 3]);
    let cube = [[0.1, 0.1, 0.1], [1.1, 0.1, 0.1], [0.1, 1.1, 0.1], [0.1, 0.1, 1.1], [1.1, 1.1, 1.1]];
    let spheres = vec![cube; N_CASES];
    bench(&mut group, "insphere_perturbed", &spheres, |p| {
        insphere_perturbed(&f, p.each_ref(), || [3, 1, 4, 2, 0])
    });
    group.finish();

    let mut group = criterion.benchmark_group("distance and line");
    let (random, ties) = (cases::<3, 3>(uniform), cases::<3, 3>(corner));
    bench(&mut group, "compare_distance", &random, |[q, a, b]| compare_distance(q, a, b));
    bench(&mut group, "compare_distance, tie", &ties, |[q, a, b]| compare_distance(q, a, b));
    bench(&mut group, "is_collinear3", &random, |[a, b, c]| is_collinear3(a, b, c));
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(50);
    targets = plane, space, ties_and_distances
}
criterion_main!(benches);
