//! Refinement and coarsening of domains: against fresh builds, and against their criteria in exact integers.

use crate::common::{Rng, assert_same_cells, cell_set, check_adjacency, seeds};
use deldrift::motion::{
    CoarsenOptions, Kept, Level, MovingTriangulation, NO_CELL, Options, Quality, QualityReport, RefineOptions, Segment,
};
use deldrift::{CellId, Error, Plane, SegmentId, VertexId};
use num_bigint::BigInt;
use std::collections::{BTreeMap, BTreeSet};

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
        let mut t = Triangulation::new(&self.points, Options::default()).expect("good points");
        let segments: Vec<_> = (0..)
            .zip(&self.edges)
            .map(|(marker, edge)| Segment { ends: edge.map(VertexId::at), marker })
            .collect();
        t.stage_segments(segments.into_iter()).expect("present");
        t.commit_timestamp().expect("no conflict");
        t
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
    let letter = [[0.0, 0.0], [0.2, 0.0], [0.5, 0.8], [0.52, 0.8], [0.8, 0.0], [1.0, 0.0], [0.55, 1.0], [0.45, 1.0]];
    vec![
        ("square", square()),
        ("hole", square().with_ring(&rectangle([0.4, 0.4], [0.6, 0.6]))),
        ("letter", Domain::default().with_ring(&letter).with_chain(&[[0.45, 0.9], [0.55, 0.95]])),
        ("slit", square().with_chain(&[[0.3, 0.5], [0.7, 0.5]])),
        (
            "L",
            Domain::default().with_ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]]),
        ),
        ("ring", Domain::default().with_ring(&circle([0.0; 2], 1.0, 64)).with_ring(&circle([0.0; 2], 0.4, 32))),
    ]
}

/// The cells that an odd number of loops is around: from outside, each closed loop changes it. Slits have one domain on both
/// sides, so loops are segments of `is_loop`.
fn mask(t: &Triangulation, is_loop: impl Fn(i32) -> bool) -> Vec<u8> {
    let cells = t.cells().expect("room");
    let sides: Vec<_> = t.segments_of_cells().expect("room").collect();
    let markers: BTreeMap<SegmentId, i32> = t.segments().map(|(id, segment)| (id, segment.marker)).collect();
    let is_wall = |id: SegmentId| id != SegmentId::NONE && is_loop(markers[&id]);
    let mut parity = vec![u8::MAX; cells.corners.len()];
    let mut waiting = Vec::new();
    for c in CellId::range(0..cells.corners.len()) {
        for i in 0..3 {
            if cells.neighbours[c][i] == NO_CELL && parity[c.index()] == u8::MAX {
                parity[c.index()] = u8::from(is_wall(sides[c.index()][i]));
                waiting.push(c);
            }
        }
    }
    while let Some(c) = waiting.pop() {
        for i in 0..3 {
            let beyond = cells.neighbours[c][i];
            if beyond != NO_CELL && parity[beyond.index()] == u8::MAX {
                parity[beyond.index()] = parity[c.index()] ^ u8::from(is_wall(sides[c.index()][i]));
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
        cosine > BigInt::from(0) && (&cosine * &cosine << 60) > least * dot(&u, &u) * dot(&v, &v)
    })
}

/// Whether the area of a triangle is above a bound.
fn has_large_area(p: [&[f64; 2]; 3], bound: f64) -> bool {
    let (u, v) = (minus(p[1], p[0]), minus(p[2], p[0]));
    let twice = &u[0] * &v[1] - &u[1] * &v[0];
    // Of coordinates by 2^-200, the area is by 2^-400.
    twice > (integer(bound) * 2 << 200)
}

/// Checks the cells against those of a fresh build with the same ids, positions and segments.
fn check_fresh(t: &Triangulation, context: &dyn Fn() -> String) {
    check_adjacency(t, context);
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{}: {violation:?}", context()));
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
        for (least_angle, greatest_area) in [(20.0, 0.0), (30.0, 0.0), (0.0, 0.01), (30.0, 0.01), (33.0, 0.001)] {
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
            println!("{}: {} cells, {report:?}, {} bad", context(), mask.iter().filter(|&&c| c == 1).count(), bad.len());
            assert!(bad.len() <= report.bad_cells, "{}", context());
            assert_eq!(report.unsplit, 0, "{}", context());
            if name != "letter" {
                assert_eq!(report.bad_cells, 0, "{}", context());
            }
            for row in bad {
                // Only what small angles of the input bring about.
                let points = row.map(|v| t.position(v).expect("present"));
                assert!(!has_large_area(points.each_ref(), greatest_area.max(1e-300)) || greatest_area == 0.0);
            }
            // Good already.
            let again = refine(&mut t, &quality, &RefineOptions::default(), &mask);
            assert_eq!((again.inserted, again.bad_cells), (0, report.bad_cells), "{}", context());
        }
    }
}
