//! Meshes that are refined again: with other numbers, at rest, after a limit, with vertices that rounding has put beside sides.

use super::{Domain, Triangulation, circle, has_large_area, has_small_angle, rectangle};
use deldrift::VertexId;
use deldrift::motion::{CoarsenOptions, NO_CELL, Options, Quality, QualityReport, RefineOptions};

/// More than any mesh here has.
pub(super) const LIMIT: usize = 30_000;

pub(super) fn turned(points: &[[f64; 2]], angle: f64) -> Vec<[f64; 2]> {
    let (sine, cosine) = angle.sin_cos();
    points.iter().map(|p| [p[0] * cosine - p[1] * sine, p[0] * sine + p[1] * cosine]).collect()
}

pub(super) fn scaled(domain: Domain, scale: f64, shift: [f64; 2]) -> Domain {
    let points = domain.points.iter().map(|p| [0, 1].map(|axis| p[axis] * scale + shift[axis])).collect();
    Domain { points, ..domain }
}

fn with_points(mut domain: Domain, points: &[[f64; 2]]) -> Domain {
    domain.points.extend(points);
    domain
}

/// A set with the facets of its hull as segments.
fn hull(points: Vec<[f64; 2]>) -> Domain {
    let t = Triangulation::new(&points, Options::default()).expect("good points");
    let cells = t.cells().expect("room");
    let mut edges = Vec::new();
    for (corners, neighbours) in cells.corners.iter().zip(cells.neighbours) {
        for i in (0..3).filter(|&i| neighbours[i] == NO_CELL) {
            edges.push([1, 2].map(|k| corners[(i + k) % 3].index()));
        }
    }
    Domain { points, edges }
}

/// A regular polygon with this many points on each side, as rounding puts them.
fn polygon(n_corners: usize, n_on_side: usize, turn: f64) -> Domain {
    let corners = turned(&circle([0.0; 2], 1.0, n_corners), turn);
    let mut points = Vec::new();
    for k in 0..n_corners {
        let (a, b) = (corners[k], corners[(k + 1) % n_corners]);
        for j in 0..n_on_side {
            let share = j as f64 / n_on_side as f64;
            points.push([0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis])));
        }
    }
    hull(points)
}

/// Five vertices, one of which is inside of a side by rounding alone.
fn five() -> Domain {
    hull(
        [
            [0xBFD16F96308DB2A8, 0xBFE349884D4AB484],
            [0x3FEF1FFD660C25C9, 0xBFCDBA8564E6584C],
            [0x3FE50FECD8F40928, 0x3FB0BFCFD8652510],
            [0x3FD5FFB897B7D90C, 0x3FD73D2A9EA5BEAE],
            [0x3F9DF977D879FCA0, 0x3FE52530A3991A0C],
        ]
        .map(|bits| bits.map(f64::from_bits))
        .to_vec(),
    )
}

/// Koch's curve around a triangle, divided twice: corners of 60 and 240 degrees.
fn snowflake() -> Vec<[f64; 2]> {
    let mut corners = circle([0.0; 2], 1.0, 3);
    for _ in 0..2 {
        let ends: Vec<_> =
            (0..corners.len()).map(|k| [corners[k], corners[(k + 1) % corners.len()]]).collect();
        corners = ends
            .into_iter()
            .flat_map(|[a, b]| {
                let third = [0, 1].map(|axis| (b[axis] - a[axis]) / 3.0);
                let at = |n: f64, p: [f64; 2]| [0, 1].map(|axis| p[axis] + n * third[axis]);
                let [side, height] = [0.5, 0.75f64.sqrt()];
                let out = [side * third[0] + height * third[1], side * third[1] - height * third[0]];
                let first = at(1.0, a);
                [a, first, [first[0] + out[0], first[1] + out[1]], at(2.0, a)]
            })
            .collect();
    }
    corners
}

/// Domains, each with its name and its size.
pub(super) fn domains() -> Vec<(&'static str, f64, Domain)> {
    let ring = |points: &[[f64; 2]]| Domain::default().with_ring(points);
    let triangle = || ring(&[[0.1, 0.0], [1.0, 0.3], [0.4, 0.9]]);
    let square = || rectangle([0.0; 2], [1.0; 2]);
    let gear: Vec<_> = (0..24).map(|k| circle([0.0; 2], if k % 4 < 2 { 1.0 } else { 0.8 }, 24)[k]).collect();
    let mut cross = ring(&square()).with_chain(&[[0.3, 0.3], [0.5, 0.5], [0.7, 0.3]]);
    cross.points.push([0.5, 0.8]);
    cross.edges.push([5, 7]);
    let angle = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
    let letter =
        [[0.0, 0.0], [0.2, 0.0], [0.5, 0.8], [0.52, 0.8], [0.8, 0.0], [1.0, 0.0], [0.55, 1.0], [0.45, 1.0]];
    vec![
        ("triangle", 1.0, triangle()),
        ("square", 1.0, ring(&square())),
        ("square, turned", 1.0, ring(&turned(&square(), 0.3))),
        ("hole", 1.0, ring(&square()).with_ring(&turned(&circle([0.5; 2], 0.2, 7), 0.1))),
        (
            "annulus",
            1.0,
            ring(&turned(&circle([0.0; 2], 1.0, 12), 0.05))
                .with_ring(&turned(&circle([0.0; 2], 0.4, 8), 0.3)),
        ),
        ("slit", 1.0, ring(&square()).with_chain(&[[0.3, 0.5], [0.71, 0.53]])),
        (
            "points",
            1.0,
            with_points(
                ring(&turned(&circle([0.0; 2], 1.0, 9), 0.2)),
                &[[0.1, 0.2], [0.15, 0.21], [-0.4, 0.3]],
            ),
        ),
        ("sharp", 1.0, ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 1.0]])),
        ("letter", 1.0, ring(&letter)),
        ("angle, turned", 1.0, ring(&turned(&angle, 0.7))),
        ("channel", 1.0, ring(&[[0.0, 0.0], [3.0, 0.1], [3.0, 0.15], [0.0, 0.05]])),
        ("far", 1.0, scaled(triangle(), 1.0, [1e6, -1e6])),
        ("small", 1e-9, scaled(triangle(), 1e-9, [0.0; 2])),
        ("tiny", 1e-120, scaled(triangle(), 1e-120, [0.0; 2])),
        ("five", 1.0, five()),
        ("pentagon", 1.0, polygon(5, 3, 0.1)),
        ("hexagon", 1.0, polygon(6, 2, 0.4)),
        ("heptagon", 1.0, polygon(7, 4, 1.3)),
        ("gear", 1.0, ring(&gear)),
        ("snowflake", 1.0, ring(&turned(&snowflake(), 0.39))),
        (
            "nested",
            1.0,
            ring(&square()).with_ring(&circle([0.5; 2], 0.3, 9)).with_ring(&circle([0.5; 2], 0.1, 5)),
        ),
        ("duplicates", 1.0, with_points(ring(&square()), &[[0.0, 0.0], [0.25, 0.5], [0.25, 0.5]])),
        ("cross", 1.0, cross),
        ("far and small", 1e-3, scaled(ring(&turned(&square(), 0.2)), 1e-3, [1e4, 2e4])),
        (
            "narrow",
            1.0,
            ring(&square()).with_chain(&[[0.2, 0.2], [0.8, 0.2]]).with_chain(&[[0.2, 0.2001], [0.8, 0.21]]),
        ),
    ]
}

pub(super) fn quality(least_angle: f64, greatest_area: f64) -> Quality<'static> {
    Quality { least_angle, greatest_area, ..Quality::default() }
}

pub(super) fn domain_of(t: &Triangulation) -> Vec<u8> {
    t.nesting_levels().expect("room").into_iter().map(|level| (level % 2) as u8).collect()
}

pub(super) fn refine(t: &mut Triangulation, quality: &Quality, limit: usize) -> QualityReport {
    let mask = domain_of(t);
    t.refine(quality, &RefineOptions { limit, ..RefineOptions::default() }, &mask).expect("a domain")
}

pub(super) fn coarsen(t: &mut Triangulation, quality: &Quality) -> QualityReport {
    let mask = domain_of(t);
    t.coarsen(quality, &CoarsenOptions::default(), &mask).expect("a domain")
}

/// The cells of the domain that are not of a quality, counted in exact integers.
pub(super) fn count_bad(t: &Triangulation, quality: &Quality) -> usize {
    let (mask, cells) = (domain_of(t), t.cells().expect("room"));
    let is_bad = |&(row, _): &(&[VertexId; 3], &u8)| {
        let places = row.map(|v| t.position(v).expect("present"));
        let places = [&places[0], &places[1], &places[2]];
        has_small_angle(places, quality.least_angle)
            || quality.greatest_area > 0.0 && has_large_area(places, quality.greatest_area)
    };
    cells.corners.iter().zip(&mask).filter(|&(_, &selected)| selected != 0).filter(is_bad).count()
}

/// What is saved.
pub(super) fn bytes(t: &Triangulation) -> Vec<u8> {
    t.saved().expect("room")
}

/// Refined with greater numbers first, a domain has no more bad cells than if it is refined at once, and a second call with
/// equal numbers changes nothing.
#[test]
fn a_second_refinement_is_as_good_as_the_first() {
    let pairs = [
        [(25.0, 0.01), (25.0, 0.001)],
        [(0.0, 0.01), (0.0, 0.001)],
        [(20.0, 0.0), (30.0, 0.0)],
        [(30.0, 0.02), (30.0, 0.005)],
        [(33.0, 0.02), (33.0, 0.005)],
    ];
    for (name, size, domain) in domains() {
        for pair in pairs {
            let [first, second] = pair.map(|(angle, area)| quality(angle, area * size * size));
            let context = || format!("{name}, {first:?}, {second:?}");
            let mut once = domain.build();
            let at_once = refine(&mut once, &second, LIMIT);
            let mut twice = domain.build();
            refine(&mut twice, &first, LIMIT);
            let after = refine(&mut twice, &second, LIMIT);
            assert!(!at_once.is_cut_short && !after.is_cut_short, "{}", context());
            assert!(after.bad_cells <= at_once.bad_cells, "{}: {at_once:?}, {after:?}", context());
            for (t, report) in [(&mut once, at_once), (&mut twice, after)] {
                if size > 1e-50 {
                    assert!(count_bad(t, &second) <= report.bad_cells, "{}", context());
                }
                let before = bytes(t);
                assert_eq!(refine(t, &second, LIMIT).inserted, 0, "{}", context());
                assert!(bytes(t) == before, "{}", context());
            }
        }
    }
}

/// Cut short by a limit and called again, refinement ends as well as without one.
#[test]
fn a_limit_leaves_what_can_be_refined() {
    for (name, size, domain) in domains() {
        let asked = quality(25.0, 0.004 * size * size);
        let n_bad = refine(&mut domain.build(), &asked, LIMIT).bad_cells;
        for limit in 1..40 {
            let mut t = domain.build();
            refine(&mut t, &asked, limit);
            let report = refine(&mut t, &asked, LIMIT);
            assert!(report.bad_cells <= n_bad, "{name}, {limit}: {report:?}, at once {n_bad}");
        }
    }
}

/// Vertices that are inside of a side by a last place do not draw others towards them.
#[test]
fn refinement_ends_beside_vertices_on_sides() {
    for angle in [19.5, 20.0, 20.5, 24.0, 25.0, 30.0, 33.0] {
        let mut t = five().build();
        let report = refine(&mut t, &quality(angle, 0.0), LIMIT);
        assert!(report.inserted < 20 && report.bad_cells <= 1, "{angle}: {report:?}");
        // The cell that is flat, and what stays whole for it, is told.
        assert_eq!(report.unsplit, report.bad_cells, "{angle}: {report:?}");
    }
    for n_corners in 3..=9 {
        for n_on_side in 2..=4 {
            for turn in 0..6 {
                let mut t = polygon(n_corners, n_on_side, 0.1 + 0.37 * f64::from(turn)).build();
                let report = refine(&mut t, &quality(25.0, 0.0), LIMIT);
                let context = || format!("{n_corners} corners, {n_on_side}, turn {turn}: {report:?}");
                assert!(
                    !report.is_cut_short && report.bad_cells <= n_corners * (n_on_side - 1),
                    "{}",
                    context()
                );
                assert_eq!(refine(&mut t, &quality(25.0, 0.0), LIMIT).inserted, 0, "{}", context());
            }
        }
    }
}

/// Nothing moves: after a first round of coarsening and refinement no round changes a byte.
#[test]
fn rounds_at_rest_change_nothing() {
    let mut all = domains();
    for angle in [5e-6f64, 1e-3, 0.1] {
        let mut domain = Domain::default().with_ring(&rectangle([-20.0; 2], [20.0; 2]));
        domain.points.extend([[0.0, 0.0], [1.0, 0.0], [1.37 * angle.cos(), 1.37 * angle.sin()]]);
        domain.edges.extend([[4, 5], [4, 6]]);
        all.push(("needle", 1.0, domain));
    }
    for (name, size, domain) in all {
        for (angle, area) in [(25.0, 0.0), (25.0, 0.1), (20.0, 0.01), (30.0, 0.05), (33.0, 0.02)] {
            if name == "needle" && area > 0.0 {
                continue;
            }
            let asked = quality(angle, area * size * size);
            let mut t = domain.build();
            refine(&mut t, &asked, LIMIT);
            coarsen(&mut t, &asked);
            refine(&mut t, &asked, LIMIT);
            let before = bytes(&t);
            for round in 0..3 {
                let removed = coarsen(&mut t, &asked).removed;
                let inserted = refine(&mut t, &asked, LIMIT).inserted;
                assert_eq!((removed, inserted), (0, 0), "{name}, {angle}, {area}, round {round}");
            }
            assert!(bytes(&t) == before, "{name}, {angle}, {area}");
        }
    }
}

/// Sizes that refinement has used at its vertices are those of which nothing is too long.
#[test]
fn a_second_call_with_the_sizes_of_the_first_changes_nothing() {
    for (name, size, domain) in domains() {
        let centre = domain.points[0];
        let mut sizes: Vec<f64> = domain
            .points
            .iter()
            .map(|p| 1e-2 * size + 0.3 * (p[0] - centre[0]).hypot(p[1] - centre[1]))
            .collect();
        let mut t = domain.build();
        let mask = domain_of(&t);
        let asked = Quality { sizes: Some(&sizes), ..quality(25.0, 0.0) };
        let report = t.refine(&asked, &RefineOptions { limit: LIMIT, ..RefineOptions::default() }, &mask);
        let report = report.expect("a domain");
        let more = t.refined_sizes().to_vec();
        assert_eq!(more.len(), report.inserted, "{name}");
        assert!(report.inserted > 20, "{name}: {report:?}");
        sizes.extend(more);
        let mask = domain_of(&t);
        let before = bytes(&t);
        let again = t.refine(
            &Quality { sizes: Some(&sizes), ..quality(25.0, 0.0) },
            &RefineOptions::default(),
            &mask,
        );
        assert_eq!(again.expect("a domain").inserted, 0, "{name}");
        assert!(bytes(&t) == before && t.refined_sizes().is_empty(), "{name}");
    }
}

/// A domain is refined at any scale, down to the least numbers.
#[test]
fn the_least_coordinates_are_refined() {
    for exponent in [-30, -120, -400, -1000, -1020, -1030] {
        let scale = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        for (name, _, domain) in domains().into_iter().take(6) {
            let mut t = scaled(domain.clone(), scale, [0.0; 2]).build();
            let report = refine(&mut t, &quality(25.0, 0.0), LIMIT);
            let context = || format!("{name}, 2^{exponent}: {report:?}");
            assert_eq!(report.bad_cells, 0, "{}", context());
            assert_eq!(refine(&mut t, &quality(25.0, 0.0), LIMIT).inserted, 0, "{}", context());
            // Multiplied by a power of two, places that are normal numbers give the same mesh.
            if exponent >= -960 {
                let plain = refine(&mut domain.build(), &quality(25.0, 0.0), LIMIT);
                assert_eq!(report.inserted, plain.inserted, "{}", context());
            }
        }
    }
}
