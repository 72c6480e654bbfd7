//! Gaps between segments that are much longer than wide: they are left, and all around them is refined.

use super::ids::assert_same;
use super::lives::{LIMIT, bytes, coarsen, domain_of, quality, refine, scaled, turned};
use super::{Domain, Triangulation, check_fresh, has_large_area, has_small_angle, rectangle};
use deldrift::VertexId;
use deldrift::motion::{CoarsenOptions, Kept, Options, Quality, RefineOptions, Saved};

/// A gap is left as it is below this share of the shorter segment's length.
const NARROW: f64 = 1.0 / 8192.0;

/// More vertices than any mesh here gets, but for those with a least angle of 33 degrees.
const MOST: usize = 1_600;
const MOST_AT_33: usize = 2_700;

/// Chains and vertices in a square.
fn in_square(chains: &[&[[f64; 2]]], points: &[[f64; 2]]) -> Domain {
    let mut domain = Domain::default().with_ring(&rectangle([-2.0, -2.0], [2.0, 2.0]));
    for chain in chains {
        domain = domain.with_chain(chain);
    }
    domain.points.extend(points);
    domain
}

/// Segments from one vertex in a square.
fn star(ends: &[[f64; 2]]) -> Domain {
    let mut domain = in_square(&[], &[[-1.0, 0.0]]);
    for &end in ends {
        domain.points.push(end);
        domain.edges.push([4, domain.points.len() - 1]);
    }
    domain
}

/// Domains with gaps between segments of length 1 to 2, each with its name.
fn domains() -> Vec<(String, Domain)> {
    let mut all = Vec::new();
    for w in [1e-5, 1e-6, 1e-7, 1e-9, 1e-12] {
        let along: [[f64; 2]; 2] = [[-1.0, 0.0], [1.0, 0.0]];
        let beside = |low: f64, high: f64, w: f64| [[low, w], [high, w]];
        all.push((format!("two, {w:e}"), in_square(&[&along, &beside(-1.0, 1.0, w)], &[])));
        all.push((format!("aside, {w:e}"), in_square(&[&along, &beside(-0.3, 1.7, w)], &[])));
        all.push((
            format!("three, {w:e}"),
            in_square(&[&along, &beside(-0.9, 0.8, w), &beside(-0.4, 1.2, -3.0 * w)], &[]),
        ));
        all.push((format!("slanted, {w:e}"), in_square(&[&along, &[[-1.0, w], [1.0, 4.0 * w]]], &[])));
        // A side of the square is one wall of the gap, and the other one ends freely.
        all.push((format!("at a side, {w:e}"), in_square(&[&[[-1.2, -2.0 + w], [0.7, -2.0 + w]]], &[])));
        all.push((
            format!("vertices within, {w:e}"),
            in_square(
                &[&along, &beside(-1.0, 1.0, w)],
                &[[0.1, 0.5 * w], [0.1 + 3.0 * w, 0.6 * w], [-0.7, 0.2 * w]],
            ),
        ));
        let slit: [[f64; 2]; 2] = [[-0.5, 0.5 * w], [0.4, 0.5 * w]];
        all.push((format!("slit, {w:e}"), in_square(&[&along, &slit, &beside(-1.0, 1.0, w)], &[])));
        all.push((format!("a vertex, {w:e}"), in_square(&[&along], &[[0.1, w]])));
        let rooms = [
            [-3.0, -1.0],
            [-1.0, -1.0],
            [-1.0, 0.0],
            [1.0, 0.0],
            [1.0, -1.0],
            [3.0, -1.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, w],
            [-1.0, w],
            [-1.0, 1.0],
            [-3.0, 1.0],
        ];
        all.push((format!("rooms, {w:e}"), Domain::default().with_ring(&rooms)));
        all.push((format!("closed, {w:e}"), Domain::default().with_ring(&rectangle([0.0; 2], [2.0, w]))));
    }
    for angle in [1e-5, 1e-7, 1e-9] {
        let end = |angle: f64, r: f64| [-1.0 + r * angle.cos(), r * angle.sin()];
        all.push((format!("wedge, {angle:e}"), star(&[end(0.0, 2.0), end(angle, 2.0)])));
        all.push((format!("wedge aside, {angle:e}"), star(&[end(0.0, 2.0), end(angle, 1.3)])));
        all.push((
            format!("three of a vertex, {angle:e}"),
            star(&[end(0.0, 2.0), end(angle, 1.7), end(2.5 * angle, 2.4), end(2.1, 0.8)]),
        ));
    }
    all
}

/// Those with the widest and the narrowest gaps.
fn few_domains() -> impl Iterator<Item = (String, Domain)> {
    domains().into_iter().filter(|(name, _)| !name.ends_with("1e-6") && !name.ends_with("1e-7"))
}

type Segment = [[f64; 2]; 2];

/// How far a place is from the line of a segment, if it is beside it.
fn beside([a, b]: Segment, p: [f64; 2]) -> Option<(f64, f64)> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = u[0].hypot(u[1]);
    let share = (u[0] * v[0] + u[1] * v[1]) / (length * length);
    (-1e-9..=1.0 + 1e-9).contains(&share).then_some((((u[0] * v[1] - u[1] * v[0]) / length).abs(), length))
}

/// Whether a place is between two segments that are so near to each other there.
fn is_between(segments: &[Segment], p: [f64; 2]) -> bool {
    let near: Vec<_> = segments.iter().filter_map(|&segment| beside(segment, p)).collect();
    (0..near.len()).any(|j| (0..j).any(|i| near[i].0 + near[j].0 <= 1.01 * NARROW * near[i].1.min(near[j].1)))
}

/// The bad cells of the domain that are in no gap, and do not touch a segment.
fn bad_beside_gaps(t: &Triangulation, segments: &[Segment], quality: &Quality) -> Vec<[[f64; 2]; 3]> {
    let (mask, cells) = (domain_of(t), t.cells().expect("room"));
    let greatest = segments.iter().flatten().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let rows = cells.corners.iter().zip(&mask).filter(|&(_, &selected)| selected != 0);
    rows.map(|(row, _)| row.map(|v| t.position(v).expect("present")))
        .filter(|p| {
            let places = p.each_ref();
            let is_large = quality.greatest_area > 0.0 && has_large_area(places, quality.greatest_area);
            let middle = [0, 1].map(|axis| (p[0][axis] + p[1][axis] + p[2][axis]) / 3.0);
            let u = |i: usize, j: usize| [p[j][0] - p[i][0], p[j][1] - p[i][1]];
            let longest =
                [u(0, 1), u(1, 2), u(2, 0)].map(|u| u[0].hypot(u[1])).into_iter().fold(0.0, f64::max);
            let (v, w) = (u(0, 1), u(0, 2));
            let is_flat = (v[0] * w[1] - v[1] * w[0]).abs() < 2048.0 * f64::EPSILON * greatest * longest;
            is_large
                || has_small_angle(places, quality.least_angle) && !is_flat && !is_between(segments, middle)
        })
        .collect()
}

/// Refinement ends with about as many vertices as if there were no gap, cells in gaps alone stay bad, and a second call
/// changes nothing.
#[test]
fn narrow_gaps_are_left() {
    println!("how many vertices refinement inserts, and how many cells it leaves bad:");
    println!("{:28}20°, 25°, 30° and 33° without a greatest area, and with one", "");
    for (name, domain) in domains() {
        let segments = segments_of(&domain);
        let mut row = Vec::new();
        for area in [0.0, 0.05] {
            for angle in [20.0, 25.0, 30.0, 33.0] {
                let asked = quality(angle, area);
                let mut t = domain.build();
                let report = refine(&mut t, &asked, LIMIT);
                let context = || format!("{name}, {angle}, {area}: {report:?}");
                let most = if angle < 33.0 { MOST } else { MOST_AT_33 };
                assert!(!report.is_cut_short && report.inserted <= most, "{}", context());
                let bad = bad_beside_gaps(&t, &segments, &asked);
                assert!(bad.is_empty(), "{}: {bad:?}", context());
                let before = bytes(&t);
                assert_eq!(refine(&mut t, &asked, LIMIT).bad_cells, report.bad_cells, "{}", context());
                assert!(bytes(&t) == before, "{}", context());
                if angle == 30.0 {
                    check_fresh(&t, &context);
                }
                row.push(format!("{}/{}", report.inserted, report.bad_cells));
            }
        }
        println!("{name:28}{}", row.join("  "));
    }
}

/// Nothing moves: no round changes a byte from the second one on. Clones and loaded copies go on alike, and so does a
/// mesh that has been cut short.
#[test]
fn meshes_with_gaps_live() {
    for (name, domain) in few_domains() {
        for asked in [quality(25.0, 0.05), quality(30.0, 0.0), quality(33.0, 0.05)] {
            let context = || format!("{name}, {asked:?}");
            let mut t = domain.build();
            refine(&mut t, &asked, LIMIT);
            let mut copies = vec![t.try_clone(None).expect("room"), loaded(&t)];
            coarsen(&mut t, &asked);
            refine(&mut t, &asked, LIMIT);
            let before = bytes(&t);
            for _ in 0..20 {
                let removed = coarsen(&mut t, &asked).removed;
                let inserted = refine(&mut t, &asked, LIMIT).inserted;
                assert_eq!((removed, inserted), (0, 0), "{}", context());
            }
            assert!(bytes(&t) == before, "{}", context());
            for copy in &mut copies {
                coarsen(copy, &asked);
                refine(copy, &asked, LIMIT);
                assert_same(copy, &t, &context);
            }
            for limit in [1, 3, 8, 40] {
                let mut t = domain.build();
                refine(&mut t, &asked, limit);
                let mut copy = loaded(&t);
                let report = refine(&mut t, &asked, LIMIT);
                // How many cells are in gaps depends on where segments have been split.
                assert!(!report.is_cut_short && report.inserted <= MOST_AT_33, "{}: {report:?}", context());
                assert!(bad_beside_gaps(&t, &segments_of(&domain), &asked).is_empty(), "{}", context());
                assert_eq!(refine(&mut copy, &asked, LIMIT), report, "{}", context());
                assert_same(&copy, &t, &context);
            }
        }
    }
}

fn segments_of(domain: &Domain) -> Vec<Segment> {
    domain.edges.iter().map(|edge| edge.map(|v| domain.points[v])).collect()
}

fn loaded(t: &Triangulation) -> Triangulation {
    Triangulation::load(&Saved::of(&bytes(t)).expect("saved"), Options::default()).expect("saved")
}

/// Lengths split the segments at a gap, and nothing between them.
#[test]
fn sizes_are_reached_at_gaps() {
    for (name, domain) in domains() {
        for (angle, size, slope) in [(0.0, 0.5, 0.0), (25.0, 0.3, 0.0), (30.0, 0.2, 0.2)] {
            let size_at = |p: &[f64; 2]| size + slope * p[0].abs();
            let mut sizes: Vec<f64> = domain.points.iter().map(size_at).collect();
            let mut t = domain.build();
            let asked = Quality { sizes: Some(&sizes), ..quality(angle, 0.0) };
            let report = refine(&mut t, &asked, LIMIT);
            let context = || format!("{name}, {angle}, {size}, {slope}: {report:?}");
            assert!(!report.is_cut_short && report.inserted <= 2_000, "{}", context());
            let more = t.refined_sizes().to_vec();
            sizes.extend(more);
            let cells = t.cells().expect("room").corners;
            for (row, _) in cells.iter().zip(domain_of(&t)).filter(|&(_, selected)| selected != 0) {
                let p = row.map(|v| t.position(v).expect("present"));
                let mean = row.iter().map(|v| sizes[v.index()]).sum::<f64>() / 3.0;
                let length = |i: usize, j: usize| (p[i][0] - p[j][0]).hypot(p[i][1] - p[j][1]);
                let longest = length(0, 1).max(length(1, 2)).max(length(2, 0));
                assert!(longest <= mean * (1.0 + 1e-9), "{}: {p:?}", context());
            }
            let before = bytes(&t);
            let asked = Quality { sizes: Some(&sizes), ..quality(angle, 0.0) };
            refine(&mut t, &asked, LIMIT);
            assert!(bytes(&t) == before, "{}", context());
        }
    }
}

/// Segments that stay whole, and those in whose circles no corner is to be: across a gap there are corners.
#[test]
fn gaps_beside_what_stays_whole_are_left() {
    for (name, domain) in domains() {
        for (keeps, is_conforming, angle, area) in [
            (Kept::All, false, 30.0, 0.0),
            (Kept::All, false, 25.0, 0.05),
            (Kept::Outer, false, 25.0, 0.05),
            (Kept::None, true, 20.0, 0.0),
            (Kept::None, true, 20.0, 0.05),
            (Kept::None, true, 0.0, 0.0),
        ] {
            let asked = Quality { is_conforming, ..quality(angle, area) };
            let options = RefineOptions { keeps, limit: LIMIT, ..RefineOptions::default() };
            let coarsening = CoarsenOptions { keeps, ..CoarsenOptions::default() };
            let mut t = domain.build();
            let report = t.refine(&asked, &options, &domain_of(&t)).expect("a domain");
            let context = || format!("{name}, {asked:?}, {keeps:?}: {report:?}");
            assert!(!report.is_cut_short && report.inserted <= MOST_AT_33, "{}", context());
            let mut before = Vec::new();
            for round in 0..4 {
                if round == 2 {
                    before = bytes(&t);
                }
                t.coarsen(&asked, &coarsening, &domain_of(&t)).expect("a domain");
                t.refine(&asked, &options, &domain_of(&t)).expect("a domain");
            }
            assert!(bytes(&t) == before, "{}", context());
        }
    }
}

/// Gaps are as narrow wherever they are, and however small and turned.
#[test]
fn gaps_are_left_at_any_scale() {
    for (name, domain) in few_domains() {
        for asked in [quality(20.0, 0.0), quality(30.0, 0.0)] {
            let plain = refine(&mut domain.build(), &asked, LIMIT);
            let by_power = scaled(domain.clone(), 2f64.powi(-400), [0.0; 2]);
            assert_eq!(refine(&mut by_power.build(), &asked, LIMIT), plain, "{name}, {asked:?}");
            let turned = Domain { points: turned(&domain.points, 0.3), ..domain.clone() };
            for other in [
                scaled(domain.clone(), 1e-120, [0.0; 2]),
                scaled(domain.clone(), 1.0, [1e6, 1e6]),
                scaled(domain.clone(), 1e50, [1e49, 0.0]),
                turned.clone(),
                scaled(turned, 1e-3, [1.0, -2.0]),
            ] {
                // Rounding may put a vertex on a segment, or segments across each other.
                let Some(mut t) = other.try_build() else { continue };
                let report = refine(&mut t, &asked, LIMIT);
                let context = || format!("{name}, {asked:?}, {:?}: {report:?}", other.points);
                assert!(!report.is_cut_short && report.inserted <= 2 * MOST, "{}", context());
                let before = bytes(&t);
                refine(&mut t, &asked, LIMIT);
                assert!(bytes(&t) == before, "{}", context());
            }
        }
    }
}

/// A gap closes and opens again: while it is narrow it is left, and the vertices that it had go.
#[test]
fn gaps_close_and_open() {
    let widths = [0.2, 0.03, 0.004, 1e-5, 1e-6, 1e-8, 1e-9, 1e-8, 1e-5, 0.004, 0.03, 0.2];
    for asked in [quality(25.0, 0.0), quality(30.0, 0.05), quality(33.0, 0.0)] {
        let domain = in_square(&[&[[-1.0, -0.2], [1.0, -0.2]], &[[-0.8, 0.2], [1.1, 0.2]]], &[]);
        let mut t = domain.build();
        let first = refine(&mut t, &asked, LIMIT).inserted;
        let mut told = Vec::new();
        for pair in widths.windows(2) {
            // What is in between is squeezed, and what is outside stretched.
            let y = |y: f64| match y.abs() {
                far if far <= pair[0] => (far * pair[1] / pair[0]).copysign(y),
                far => (2.0 - (2.0 - far) * (2.0 - pair[1]) / (2.0 - pair[0])).copysign(y),
            };
            let ids: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
            let goals: Vec<_> =
                ids.iter().map(|&v| t.position(v).expect("present")).map(|p| [p[0], y(p[1])]).collect();
            t.move_vertices(&ids, &goals).expect("present");
            t.commit_timestamp().expect("no conflict");
            coarsen(&mut t, &asked);
            let report = refine(&mut t, &asked, LIMIT);
            told.push((report.inserted, t.cell_count()));
            assert!(!report.is_cut_short, "{asked:?}, {pair:?}: {report:?}");
            assert!(pair[1] > 1e-4 || t.cell_count() <= 700, "{asked:?}, {pair:?}: {report:?}");
            let mut copy = loaded(&t);
            for _ in 0..2 {
                coarsen(&mut copy, &asked);
                refine(&mut copy, &asked, LIMIT);
            }
            let before = bytes(&copy);
            coarsen(&mut copy, &asked);
            refine(&mut copy, &asked, LIMIT);
            assert!(bytes(&copy) == before, "{asked:?}, {pair:?}");
        }
        println!("{asked:?}: {first} vertices come, then so many, and there are so many cells: {told:?}");
    }
}
