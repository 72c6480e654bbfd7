//! Refinement and coarsening of domains: against fresh builds, and against their criteria in exact integers.

mod coarsening;
mod conforming;
mod gaps;
mod ids;
mod lives;
mod loops;
mod remembered;
mod resting;

use crate::common::{Rng, assert_same_cells, cell_set, check_adjacency, seeds};
use deldrift::motion::{
    CoarsenOptions, Kept, Level, MovingTriangulation, NO_CELL, Options, Quality, QualityReport,
    RefineOptions, Segment,
};
use deldrift::{CellId, Error, Plane, SegmentId, VertexId};
use num_bigint::BigInt;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

type Triangulation = MovingTriangulation<Plane>;

/// A domain: places, and edges between them.
#[derive(Clone, Debug, Default)]
struct Domain {
    points: Vec<[f64; 2]>,
    edges: Vec<[usize; 2]>,
}

impl Domain {
    fn with_ring(mut self, ring: &[[f64; 2]]) -> Self {
        let (first, n) = (self.points.len(), ring.len());
        self.points.extend(ring);
        self.edges.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        self
    }

    fn with_chain(mut self, chain: &[[f64; 2]]) -> Self {
        let first = self.points.len();
        self.points.extend(chain);
        self.edges.extend((1..chain.len()).map(|k| [first + k - 1, first + k]));
        self
    }

    fn build(&self) -> Triangulation {
        self.try_build().expect("no conflict")
    }

    /// Nothing where segments are in the way of each other.
    fn try_build(&self) -> Option<Triangulation> {
        let mut t = Triangulation::new(&self.points, Options::default()).expect("good points");
        let segments: Vec<_> = (0..)
            .zip(&self.edges)
            .map(|(marker, edge)| Segment { ends: edge.map(VertexId::at), marker, ..Segment::default() })
            .collect();
        t.stage_segments(segments.into_iter()).expect("present");
        t.commit_timestamp().ok().map(|_| t)
    }
}

fn circle(centre: [f64; 2], radius: f64, n: usize) -> Vec<[f64; 2]> {
    (0..n)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / n as f64;
            [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
        })
        .collect()
}

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// Square, square with a hole, a letter with small angles, slit, L, ring.
fn domains() -> Vec<(&'static str, Domain)> {
    let square = || Domain::default().with_ring(&rectangle([0.0, 0.0], [1.0, 1.0]));
    let letter =
        [[0.0, 0.0], [0.2, 0.0], [0.5, 0.8], [0.52, 0.8], [0.8, 0.0], [1.0, 0.0], [0.55, 1.0], [0.45, 1.0]];
    vec![
        ("square", square()),
        ("hole", square().with_ring(&rectangle([0.4, 0.4], [0.6, 0.6]))),
        ("letter", Domain::default().with_ring(&letter).with_chain(&[[0.45, 0.9], [0.55, 0.95]])),
        ("slit", square().with_chain(&[[0.3, 0.5], [0.7, 0.5]])),
        (
            "L",
            Domain::default().with_ring(&[
                [0.0, 0.0],
                [1.0, 0.0],
                [1.0, 0.5],
                [0.5, 0.5],
                [0.5, 1.0],
                [0.0, 1.0],
            ]),
        ),
        (
            "ring",
            Domain::default().with_ring(&circle([0.0; 2], 1.0, 64)).with_ring(&circle([0.0; 2], 0.4, 32)),
        ),
    ]
}

/// The cells that an odd number of loops is around: from outside, each closed loop changes it. Slits have one domain on both
/// sides, so loops are segments of `is_loop`.
fn mask(t: &Triangulation, is_loop: impl Fn(i32) -> bool) -> Vec<u8> {
    let cells = t.cells().expect("room");
    let sides: Vec<_> = t.segments_of_cells().expect("room");
    let markers: BTreeMap<SegmentId, i32> = t.segments().map(|(id, segment)| (id, segment.marker)).collect();
    let is_wall = |id: SegmentId| id != SegmentId::NONE && is_loop(markers[&id]);
    let mut parity = vec![u8::MAX; cells.corners.len()];
    let mut waiting = Vec::new();
    for c in CellId::range(0..cells.corners.len()) {
        for (&beyond, &side) in cells.neighbours[c].iter().zip(&sides[c.index()]) {
            if beyond == NO_CELL && parity[c.index()] == u8::MAX {
                parity[c.index()] = u8::from(is_wall(side));
                waiting.push(c);
            }
        }
    }
    while let Some(c) = waiting.pop() {
        for (&beyond, &side) in cells.neighbours[c].iter().zip(&sides[c.index()]) {
            if beyond != NO_CELL && parity[beyond.index()] == u8::MAX {
                parity[beyond.index()] = parity[c.index()] ^ u8::from(is_wall(side));
                waiting.push(beyond);
            }
        }
    }
    parity
}

/// Integers of which coordinates are multiples, by 2^-1074 at worst; those of tests are by 2^-200.
fn integer(x: f64) -> BigInt {
    let (bits, sign) = (x.abs().to_bits(), if x < 0.0 { -1 } else { 1 });
    let (exponent, fraction) = ((bits >> 52) as i64, bits & ((1 << 52) - 1));
    if exponent == 0 {
        assert_eq!(fraction, 0, "a normal number");
        return BigInt::from(0);
    }
    let shift = exponent - 1075 + 200;
    assert!(shift >= 0, "{x} is too small");
    (BigInt::from(fraction | 1 << 52) << shift) * sign
}

fn minus(p: &[f64; 2], q: &[f64; 2]) -> [BigInt; 2] {
    [integer(p[0]) - integer(q[0]), integer(p[1]) - integer(q[1])]
}

fn dot(u: &[BigInt; 2], v: &[BigInt; 2]) -> BigInt {
    &u[0] * &v[0] + &u[1] * &v[1]
}

/// Whether an angle of a triangle is below this one, of which the squared cosine is taken as a number of 53 bits.
fn has_small_angle(p: [&[f64; 2]; 3], degrees: f64) -> bool {
    let square = degrees.to_radians().cos().powi(2);
    (0..3).any(|i| {
        let (u, v) = (minus(p[(i + 1) % 3], p[i]), minus(p[(i + 2) % 3], p[i]));
        let cosine = dot(&u, &v);
        let least = BigInt::from((square * 2f64.powi(60)) as u64);
        cosine > BigInt::from(0) && ((&cosine * &cosine) << 60) > least * dot(&u, &u) * dot(&v, &v)
    })
}

/// Whether the area of a triangle is above a bound.
fn has_large_area(p: [&[f64; 2]; 3], bound: f64) -> bool {
    let (u, v) = (minus(p[1], p[0]), minus(p[2], p[0]));
    let twice = &u[0] * &v[1] - &u[1] * &v[0];
    // Of coordinates by 2^-200, the area is by 2^-400.
    twice > ((integer(bound) * 2) << 200)
}

/// Checks the cells against those of a fresh build with the same ids, keys, positions and segments.
fn check_fresh(t: &Triangulation, context: &dyn Fn() -> String) {
    check_adjacency(t, context);
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{}: {violation:?}", context()));
    let ids = VertexId::range(0..t.id_count());
    let points: Vec<_> = ids.clone().map(|v| t.position(v).unwrap_or([9e4, 9e4])).collect();
    let keys: Vec<_> = ids.clone().map(|v| t.key_of_id(v)).collect();
    let fresh = match t.has_keys() {
        true => Triangulation::with_keys(&points, &keys, Options::default()),
        false => Triangulation::new(&points, Options::default()),
    };
    let mut fresh = fresh.expect("good points");
    for v in ids.filter(|&v| !t.is_present(v)) {
        fresh.remove_vertex(v).expect("present");
    }
    let segments: Vec<_> = t.segments().map(|(_, segment)| segment).collect();
    fresh.stage_segments(segments.into_iter()).expect("present");
    fresh.commit_timestamp().expect("no conflict");
    assert_same_cells(&cell_set(t), &cell_set(&fresh), context);
}

/// Checks that the pieces of each of the first segments are a chain from end to end, in order, with its marker.
fn check_chains(t: &Triangulation, domain: &Domain, context: &dyn Fn() -> String) {
    let mut next: BTreeMap<(SegmentId, VertexId), VertexId> = BTreeMap::new();
    for (id, segment) in t.segments() {
        let original = t.original_segment(id);
        assert_eq!(segment.marker as usize, original.index(), "{}", context());
        assert_eq!(next.insert((original, segment.ends[0]), segment.ends[1]), None, "{}", context());
    }
    let on: BTreeMap<_, _> = t.made_vertices().collect();
    let mut n = 0;
    for (edge, original) in domain.edges.iter().zip(SegmentId::range(0..domain.edges.len())) {
        let [mut v, end] = edge.map(VertexId::at);
        while v != end {
            let w = next[&(original, v)];
            n += 1;
            if w != end {
                assert_eq!(on[&w], original, "{}", context());
                // In order along the segment, and on it but for rounding.
                let [p, q, a, b] = [v, w, edge[0].into_id(), end].map(|v| t.position(v).expect("present"));
                let u = [b[0] - a[0], b[1] - a[1]];
                assert!((q[0] - p[0]) * u[0] + (q[1] - p[1]) * u[1] > 0.0, "{}", context());
                let off = (q[0] - a[0]) * u[1] - (q[1] - a[1]) * u[0];
                assert!(off.abs() <= 1e-13 * (u[0] * u[0] + u[1] * u[1]).sqrt(), "{}: {off:e}", context());
            }
            v = w;
        }
    }
    assert_eq!(n, next.len(), "{}", context());
}

trait IntoId {
    fn into_id(self) -> VertexId;
}

impl IntoId for usize {
    fn into_id(self) -> VertexId {
        VertexId::at(self)
    }
}

/// The selected cells that are bad, of those of a mask.
fn bad_cells(t: &Triangulation, mask: &[u8], quality: &Quality) -> Vec<[VertexId; 3]> {
    let cells = t.cells().expect("room").corners;
    let of_mask = cells.iter().zip(mask).filter(|&(_, &selected)| selected != 0).map(|(&row, _)| row);
    of_mask
        .filter(|row| {
            let points = row.map(|v| t.position(v).expect("present"));
            let points = points.each_ref();
            has_small_angle(points, quality.least_angle)
                || (quality.greatest_area > 0.0 && has_large_area(points, quality.greatest_area))
        })
        .collect()
}

fn refine(t: &mut Triangulation, quality: &Quality, options: &RefineOptions, mask: &[u8]) -> QualityReport {
    t.refine(quality, options, mask).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn domains_get_what_is_asked_for() {
    for (name, domain) in domains() {
        for (least_angle, greatest_area) in
            [(20.0, 0.0), (30.0, 0.0), (0.0, 0.01), (30.0, 0.01), (33.0, 0.001)]
        {
            let context = || format!("{name}, {least_angle} degrees, {greatest_area}");
            let is_loop = |marker: i32| name != "slit" || marker < 4;
            let is_loop = |marker: i32| is_loop(marker) && (name != "letter" || marker < 8);
            let mut t = domain.build();
            let quality = Quality { least_angle, greatest_area, ..Quality::default() };
            let before = mask(&t, is_loop);
            let report = refine(&mut t, &quality, &RefineOptions::default(), &before);
            check_fresh(&t, &context);
            check_chains(&t, &domain, &context);
            let mask = mask(&t, is_loop);
            let bad = bad_cells(&t, &mask, &quality);
            println!(
                "{}: {} cells, {report:?}, {} bad",
                context(),
                mask.iter().filter(|&&c| c == 1).count(),
                bad.len()
            );
            assert!(bad.len() <= report.bad_cells, "{}", context());
            assert_eq!(report.unsplit, 0, "{}", context());
            if name != "letter" {
                assert_eq!(report.bad_cells, 0, "{}", context());
            }
            for row in bad {
                // Only what small angles of the input bring about.
                let points = row.map(|v| t.position(v).expect("present"));
                assert!(
                    !has_large_area(points.each_ref(), greatest_area.max(1e-300)) || greatest_area == 0.0
                );
            }
            // Good already.
            let again = refine(&mut t, &quality, &RefineOptions::default(), &mask);
            assert_eq!((again.inserted, again.bad_cells), (0, report.bad_cells), "{}", context());
        }
    }
}

/// A random domain: a polygon around the origin, loops within, chains in between; angles of any size.
fn random_domain(rng: &mut Rng) -> (Domain, usize) {
    let n = 3 + rng.below(12);
    let mut angles: Vec<f64> =
        (0..n).map(|k| (k as f64 + 0.9 * rng.unit()) / n as f64 * std::f64::consts::TAU).collect();
    angles.sort_by(f64::total_cmp);
    let ring: Vec<[f64; 2]> = angles
        .iter()
        .map(|angle| {
            let radius = 1.0 + rng.unit();
            [radius * angle.cos(), radius * angle.sin()]
        })
        .collect();
    let mut domain = Domain::default().with_ring(&ring);
    if rng.one_in(2) {
        let n = 3 + rng.below(6);
        domain = domain.with_ring(&circle([0.1 * rng.unit(), 0.1 * rng.unit()], 0.05 + 0.1 * rng.unit(), n));
    }
    let n_loops = domain.edges.len();
    // Spokes from a corner towards the middle, which make small angles with its edges.
    for _ in 0..rng.below(3) {
        let corner = rng.below(n);
        let [x, y] = domain.points[corner];
        let share = 0.9 + 0.05 * rng.unit();
        domain.points.push([x * share, y * share]);
        domain.edges.push([corner, domain.points.len() - 1]);
    }
    (domain, n_loops)
}

/// Random domains, qualities and options; each is checked, is refined again without effect, and by the same calls gets the
/// same cells.
#[test]
fn random_domains_are_refined() {
    let mut counts = [0; 4];
    for seed in seeds(150) {
        let rng = &mut Rng::new(seed);
        let (domain, n_loops) = random_domain(rng);
        let context = || format!("seed {seed}, {domain:?}");
        let mut t = Triangulation::new(&domain.points, Options::default()).expect("good points");
        let segment = |k: usize| Segment {
            ends: domain.edges[k].map(VertexId::at),
            marker: k as i32,
            ..Segment::default()
        };
        t.stage_segments((0..domain.edges.len()).map(segment)).expect("present");
        if t.commit_timestamp().is_err() {
            continue;
        }
        let is_loop = |marker: i32| (marker as usize) < n_loops;
        let selected = mask(&t, is_loop);
        let quality = Quality {
            least_angle: *rng.pick(&[0.0, 20.0, 25.0, 30.0]),
            greatest_area: *rng.pick(&[0.0, 0.1, 0.01]),
            ..Quality::default()
        };
        let keeps = *rng.pick(&[Kept::None, Kept::None, Kept::Outer, Kept::All]);
        let limit = if rng.one_in(4) { rng.below(60) } else { 100_000 };
        let options = RefineOptions { keeps, limit, has_weights: rng.one_in(2), reuses_ids: rng.one_in(2) };
        let before: BTreeSet<Vec<VertexId>> = cells_of(&t, &selected, 0);
        let ends: BTreeSet<SegmentId> = t.segments().map(|(id, _)| id).collect();
        let mut twin = t.try_clone(None).expect("room");
        let report = refine(&mut t, &quality, &options, &selected);
        assert_eq!(refine(&mut twin, &quality, &options, &selected), report, "{}", context());
        assert_eq!(cell_set(&twin), cell_set(&t), "{}", context());
        check_fresh(&t, &context);
        check_chains(&t, &domain, &context);
        assert!(report.inserted <= options.limit, "{}", context());
        let after = mask(&t, is_loop);
        assert!(bad_cells(&t, &after, &quality).len() <= report.bad_cells, "{}", context());
        if keeps == Kept::All {
            assert_eq!(ends, t.segments().map(|(id, _)| id).collect(), "{}", context());
            assert_eq!(before, cells_of(&t, &after, 0), "{}: cells that are not selected", context());
        }
        if keeps == Kept::Outer {
            let of_loops = |id: &SegmentId| id.index() < n_loops;
            let kept = t.segments().map(|(id, _)| id).filter(of_loops).count();
            assert_eq!(kept, n_loops, "{}", context());
            assert_eq!(before, cells_of(&t, &after, 0), "{}: cells that are not selected", context());
        }
        if !report.is_cut_short {
            let again = refine(&mut t, &quality, &options, &after);
            if keeps != Kept::None || report.bad_cells == 0 {
                assert_eq!(again.inserted, 0, "{}", context());
            }
            if keeps != Kept::None {
                let areas = Quality { least_angle: 0.0, ..quality };
                assert!(bad_cells(&t, &after, &areas).is_empty(), "{}", context());
            }
            counts[0] += 1;
        } else {
            assert_eq!(report.inserted, options.limit, "{}", context());
            counts[1] += 1;
        }
        counts[2] += usize::from(report.bad_cells > 0);
        counts[3] += report.inserted;
        if report.inserted >= 2_000 {
            println!("seed {seed}: {quality:?}, {keeps:?}, {report:?}");
        }
    }
    println!("{counts:?} finished, cut short, with bad cells; inserted");
    assert!(counts[3] < 400 * (counts[0] + counts[1]), "{counts:?}");
    assert!(counts[0] > 60 && counts[1] > 5 && counts[3] > 5_000, "{counts:?}");
}

/// Beside sides that stay whole cells have no larger areas either, however far away those of the vertices are that they get.
#[test]
fn areas_are_reached_beside_sides_that_stay_whole() {
    let sharp = [[0.0, 0.0], [10.0, 0.0], [10.0, 1.0]];
    let corner = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];
    let square = [[-2.0, -2.0], [6.0, -2.0], [6.0, 6.0], [-2.0, 6.0]];
    for domain in [
        Domain::default().with_ring(&square),
        Domain::default().with_ring(&square).with_ring(&corner),
        Domain::default().with_ring(&sharp),
    ] {
        for (keeps, least_angle) in [(Kept::Outer, 0.0), (Kept::Outer, 25.0), (Kept::All, 30.0)] {
            let quality = Quality { least_angle, greatest_area: 0.05, ..Quality::default() };
            let options = RefineOptions { keeps, limit: 20_000, ..RefineOptions::default() };
            let context = || format!("{keeps:?}, {least_angle}, {domain:?}");
            let mut t = domain.build();
            let selected = mask(&t, |_| true);
            let report = refine(&mut t, &quality, &options, &selected);
            assert!(
                !report.is_cut_short && report.inserted > 100 && report.on_segments == 0,
                "{}",
                context()
            );
            check_fresh(&t, &context);
            check_chains(&t, &domain, &context);
            let selected = mask(&t, |_| true);
            let large = Quality { least_angle: 0.0, ..quality };
            assert!(bad_cells(&t, &selected, &large).is_empty(), "{}", context());
            assert_eq!(refine(&mut t, &quality, &options, &selected).inserted, 0, "{}", context());
        }
    }
}

/// Where sides stay whole, rounds change nothing from the second on either.
#[test]
fn rounds_at_rest_change_nothing_beside_sides_that_stay_whole() {
    for domain in [
        Domain::default().with_ring(&circle([0.0; 2], 1.0, 30)),
        Domain::default().with_ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
    ] {
        for (keeps, least_angle, greatest_area) in [
            (Kept::Outer, 20.0, 0.01),
            (Kept::All, 30.0, 0.01),
            (Kept::Outer, 33.0, 0.01),
            (Kept::Outer, 33.0, 0.001),
        ] {
            let quality = Quality { least_angle, greatest_area, ..Quality::default() };
            let options = RefineOptions { keeps, ..RefineOptions::default() };
            let coarsening = CoarsenOptions { keeps, ..CoarsenOptions::default() };
            let mut t = domain.build();
            for round in 0..6 {
                let selected = mask(&t, |_| true);
                let removed = t.coarsen(&quality, &coarsening, &selected).expect("a domain").removed;
                let selected = mask(&t, |_| true);
                let report = t.refine(&quality, &options, &selected).expect("a domain");
                assert_eq!(report.on_segments, 0);
                if round > 1 {
                    assert_eq!(
                        (removed, report.inserted),
                        (0, 0),
                        "{keeps:?} {least_angle} {greatest_area}, round {round}"
                    );
                }
            }
        }
    }
}

/// The cells of a mask with this number.
fn cells_of(t: &Triangulation, mask: &[u8], number: u8) -> BTreeSet<Vec<VertexId>> {
    let rows = t.cells().expect("room").corners.iter().zip(mask).filter(|&(_, &m)| m == number);
    rows.map(|(row, _)| crate::common::sorted(row)).collect()
}

/// Areas by label, lengths by vertex, and what a callback says.
#[test]
fn sizes_are_those_asked_for() {
    let middle = [[0.5, 0.0], [0.5, 1.0]];
    let mut domain =
        Domain::default().with_ring(&[[0.0, 0.0], middle[0], [1.0, 0.0], [1.0, 1.0], middle[1], [0.0, 1.0]]);
    domain.edges.push([1, 4]);
    let context = || "two halves".to_owned();
    let is_left = |points: [[f64; 2]; 3]| points.iter().map(|p| p[0]).sum::<f64>() < 1.5;
    let places = |t: &Triangulation| -> Vec<[[f64; 2]; 3]> {
        let rows = t.cells().expect("room").corners.iter();
        rows.map(|row| row.map(|v| t.position(v).expect("present"))).collect()
    };
    let mut t = domain.build();
    let labels: Vec<u32> = places(&t).into_iter().map(|points| u32::from(is_left(points))).collect();
    let areas = [0.1, 0.001];
    let quality = Quality { least_angle: 25.0, labels: Some(&labels), areas: &areas, ..Quality::default() };
    let all = vec![1; t.cell_count()];
    refine(&mut t, &quality, &RefineOptions::default(), &all);
    check_fresh(&t, &context);
    check_chains(&t, &domain, &context);
    let mut n = [0; 2];
    for points in places(&t) {
        let label = usize::from(is_left(points));
        assert!(!has_large_area(points.each_ref(), areas[label]), "{points:?}");
        n[label] += 1;
    }
    assert!(n[1] > 500 && n[0] < n[1] / 2, "{n:?}");

    // One label and no other cell.
    let mut t = domain.build();
    let left: Vec<u8> = places(&t).into_iter().map(|points| u8::from(is_left(points))).collect();
    let quality = Quality { least_angle: 25.0, greatest_area: 0.001, ..Quality::default() };
    refine(&mut t, &quality, &RefineOptions::default(), &left);
    let right = places(&t).into_iter().filter(|&points| !is_left(points)).count();
    check_fresh(&t, &context);
    assert!(t.cell_count() > 500 && right < 60, "{right} of {}", t.cell_count());

    // Lengths at vertices.
    let mut t = domain.build();
    let sizes: Vec<f64> = domain.points.iter().map(|p| 0.02 + 0.1 * p[0]).collect();
    let quality = Quality { least_angle: 28.0, sizes: Some(&sizes), ..Quality::default() };
    let all = vec![1; t.cell_count()];
    let report = refine(&mut t, &quality, &RefineOptions::default(), &all);
    assert_eq!(report.bad_cells, 0);
    check_fresh(&t, &context);
    for points in places(&t) {
        let longest = (0..3).map(|i| {
            let (p, q) = (points[i], points[(i + 1) % 3]);
            ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt()
        });
        // The sizes given are linear, and so are those between.
        let mean = points.iter().map(|p| 0.02 + 0.1 * p[0]).sum::<f64>() / 3.0;
        let longest = longest.fold(0.0, f64::max);
        assert!(longest <= mean * (1.0 + 1e-9), "{points:?}: {longest}, {mean}");
    }

    // A callback.
    let mut t = domain.build();
    let is_large = |points: [[f64; 2]; 3]| {
        let x = points.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
        let width = points.iter().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max) - x;
        width > 0.05 + 0.2 * x
    };
    let is_too_large = |points| ControlFlow::Continue(is_large(points));
    let quality = Quality { least_angle: 28.0, is_too_large: Some(&is_too_large), ..Quality::default() };
    let all = vec![1; t.cell_count()];
    refine(&mut t, &quality, &RefineOptions::default(), &all);
    check_fresh(&t, &context);
    assert!(t.cell_count() > 50 && places(&t).into_iter().all(|points| !is_large(points)));
}

/// Segments that have hardly any numbers between their ends are not split where nothing fits, and a mask that does not end
/// at segments, bad numbers and staged edits are refused without effect.
#[test]
fn what_cannot_be_is_told() {
    let (_, domain) = domains().swap_remove(1);
    let mut t = domain.build();
    let before = (cell_set(&t), t.timestamp());
    let selected = mask(&t, |_| true);
    let all = vec![1; t.cell_count()];
    let good = Quality { least_angle: 25.0, greatest_area: 0.01, ..Quality::default() };
    let refused = |t: &mut Triangulation, quality: &Quality, mask: &[u8]| {
        let error = t.refine(quality, &RefineOptions::default(), mask).expect_err("it is refused");
        assert_eq!(
            t.coarsen(quality, &CoarsenOptions::default(), mask).is_err(),
            !matches!(error, Error::InvalidValue { argument: "mask", .. })
        );
        error.to_string()
    };
    for least_angle in [f64::NAN, -1.0, 34.5, 90.0] {
        let error = refused(&mut t, &Quality { least_angle, ..good }, &selected);
        assert!(error.contains("least_angle[0] is"), "{error}");
    }
    for greatest_area in [f64::NAN, -1.0] {
        let error = refused(&mut t, &Quality { greatest_area, ..good }, &selected);
        assert!(error.contains("greatest_area[0] is"), "{error}");
    }
    let error = refused(&mut t, &Quality { areas: &[1.0, -2.0], ..good }, &selected);
    assert!(error.contains("areas[1] is -2"), "{error}");
    let mut sizes = vec![0.1; t.id_count()];
    sizes[3] = 0.0;
    let error = refused(&mut t, &Quality { sizes: Some(&sizes), ..good }, &selected);
    assert!(error.contains("sizes[3] is 0"), "{error}");
    let error = refused(&mut t, &Quality { sizes: Some(&sizes[1..]), ..good }, &selected);
    assert!(error.contains("sizes is 7, but must be 8"), "{error}");
    let error = refused(&mut t, &good, &selected[1..]);
    assert!(error.contains("mask is"), "{error}");
    // One cell of the domain alone ends at an edge that is no segment.
    let mut one = vec![0; all.len()];
    one[selected.iter().position(|&m| m == 1).expect("a cell")] = 1;
    let error = refused(&mut t, &good, &one);
    assert!(error.contains("mask[") && error.contains("no segment"), "{error}");
    t.stage_removals(&[VertexId::new(0)]).expect("present");
    let error = refused(&mut t, &good, &selected);
    assert!(error.contains("1 insertions and removals"), "{error}");
    t.discard_moves();
    assert_eq!((cell_set(&t), t.timestamp()), before);
    refine(&mut t, &good, &RefineOptions::default(), &selected);

    // A square of four last bits.
    let ulp = f64::EPSILON;
    let small = Domain::default().with_ring(&rectangle([1.0, 1.0], [1.0 + 4.0 * ulp, 1.0 + 4.0 * ulp]));
    let mut t = small.build();
    let quality = Quality { greatest_area: 0.1 * ulp * ulp, ..Quality::default() };
    let report = refine(&mut t, &quality, &RefineOptions::default(), &[1, 1]);
    check_fresh(&t, &|| "four bits".to_owned());
    assert!(report.bad_cells > 0 && report.inserted <= 21, "{report:?}");
}

/// A rectangle with a hole is stretched and squeezed: vertices come and go, and their number stays near that of a mesh made anew.
#[test]
fn a_domain_that_is_squeezed_keeps_its_number_of_vertices() {
    let domain = Domain::default()
        .with_ring(&rectangle([-1.0, -0.5], [1.0, 0.5]))
        .with_ring(&circle([0.0; 2], 0.2, 12));
    let quality = Quality { least_angle: 25.0, greatest_area: 0.01, ..Quality::default() };
    let mut t = domain.build();
    let (mut shares, mut most) = (Vec::new(), [0, 0]);
    let (mut n_removed, mut n_inserted) = (0, 0);
    let width = |step: usize| 2f64.powf((step as f64 * 0.05).sin());
    for step in 0..2_000 {
        let context = || format!("step {step}");
        let factor = width(step + 1) / width(step);
        let ids: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
        let places = ids.iter().map(|&v| t.position(v).expect("present"));
        let goals: Vec<_> = places.map(|p| [p[0] * factor, p[1]]).collect();
        t.move_vertices(&ids, &goals).expect("good places");
        t.commit_timestamp().expect("no conflict");
        let selected = mask(&t, |_| true);
        n_removed += t.coarsen(&quality, &CoarsenOptions::default(), &selected).expect("a domain").removed;
        let selected = mask(&t, |_| true);
        let report = refine(&mut t, &quality, &RefineOptions::default(), &selected);
        n_inserted += report.inserted;
        assert_eq!(report.bad_cells, 0, "{}", context());
        let half = usize::from(step >= 1_000);
        most[half] = most[half].max(t.vertex_count());
        if step % 100 == 99 {
            check_fresh(&t, &context);
            let selected = mask(&t, |_| true);
            assert_eq!(bad_cells(&t, &selected, &quality), Vec::<[VertexId; 3]>::new(), "{}", context());
            shares.push(t.vertex_count() as f64 / vertices_anew(&domain, &t, &quality) as f64);
            t.compact().expect("room");
        }
    }
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    println!("{n_inserted} inserted, {n_removed} removed, {mean} x anew: {shares:?}; at most {most:?}");
    assert!(n_removed > 500 && n_inserted > 500);
    assert!(most[1] as f64 <= 1.1 * most[0] as f64, "{most:?}");
    assert!(mean < 1.15, "{shares:?}");
}

/// The number of vertices of a mesh made anew, of a domain with its corners where they are by now.
fn vertices_anew(domain: &Domain, t: &Triangulation, quality: &Quality) -> usize {
    let mut anew = domain.clone();
    anew.points.iter_mut().enumerate().for_each(|(v, p)| *p = t.position(VertexId::at(v)).expect("present"));
    let mut anew = anew.build();
    let selected = mask(&anew, |_| true);
    refine(&mut anew, quality, &RefineOptions::default(), &selected);
    anew.vertex_count()
}

/// A square of a few least numbers: its inverse is beyond the range of numbers, and there is hardly room for vertices.
#[test]
fn a_square_of_subnormal_numbers_is_refined() {
    for side in [1.0, 4.0, 16.0, 1e10] {
        let side = side * f64::from_bits(1);
        let domain = Domain::default().with_ring(&rectangle([0.0; 2], [side, side]));
        let mut t = domain.build();
        let quality = Quality {
            least_angle: 20.0,
            is_too_large: Some(&|_| ControlFlow::Continue(true)),
            ..Quality::default()
        };
        let options = RefineOptions { limit: 50, ..RefineOptions::default() };
        let inside = mask(&t, |_| true);
        let report = refine(&mut t, &quality, &options, &inside);
        assert!(report.bad_cells > 0, "{side}: {report:?}");
        check_fresh(&t, &|| format!("{side}"));
    }
}
