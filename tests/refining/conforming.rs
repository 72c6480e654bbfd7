//! Segments that are split until all cells are Delaunay; callbacks that break a call off.

use super::{
    Triangulation, check_chains, check_fresh, domains, dot, mask, minus, random_domain, rectangle, refine,
};
use crate::common::{Rng, cell_set, seeds};
use deldrift::motion::{CoarsenOptions, Kept, Options, Quality, RefineOptions, Segment};
use deldrift::{CellId, Error, SegmentId, VertexId};
use num_bigint::BigInt;
use std::cell::Cell;
use std::ops::ControlFlow;

/// Segments in whose circle the corner of a selected cell beside them is, in exact integers.
fn encroached(t: &Triangulation, selected: &[u8]) -> Vec<(SegmentId, VertexId)> {
    let corners = t.cells().expect("room").corners;
    let mut found = Vec::new();
    for ((row, sides), _) in
        corners.iter().zip(t.segments_of_cells().expect("room")).zip(selected).filter(|(_, s)| **s != 0)
    {
        let [a, b, c] = row.map(|v| t.position(v).expect("present"));
        for (i, [p, u, w]) in [[a, b, c], [b, c, a], [c, a, b]].iter().enumerate() {
            if sides[i] != SegmentId::NONE && dot(&minus(u, p), &minus(w, p)) < BigInt::from(0) {
                found.push((sides[i], row[i]));
            }
        }
    }
    found
}

/// Whether two segments meet at an angle below 1e-6. There rounding puts vertices that should be on one shell so far from it
/// that they are in each other's circles, down to the last bits.
fn has_tiny_angle(domain: &super::Domain) -> bool {
    let directions: Vec<_> = domain
        .edges
        .iter()
        .flat_map(|&[v, w]| [(v, w), (w, v)])
        .map(|(v, w)| (v, [0, 1].map(|axis| domain.points[w][axis] - domain.points[v][axis])))
        .collect();
    directions.iter().enumerate().any(|(k, &(v, a))| {
        directions[..k].iter().filter(|&&(other, _)| other == v).any(|&(_, b)| {
            let (cross, dot) = (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
            cross.atan2(dot).abs() < 1e-6
        })
    })
}

/// Checks that no corner of a selected cell is inside the circle of the selected cell beside it, segment or not.
fn check_delaunay(t: &Triangulation, selected: &[u8], context: &dyn Fn() -> String) {
    let cells = t.cells().expect("room");
    for (c, row) in (0..).zip(cells.corners) {
        for &beyond in &cells.neighbours[CellId::new(c)] {
            if selected[c as usize] == 0 || beyond == CellId::NONE || selected[beyond.index()] == 0 {
                continue;
            }
            let q =
                *cells.corners[beyond.index()].iter().find(|v| !row.contains(v)).expect("one is not common");
            let q = t.position(q).expect("present");
            let rows = row.map(|v| {
                let u = minus(&t.position(v).expect("present"), &q);
                let square = dot(&u, &u);
                let [x, y] = u;
                [x, y, square]
            });
            let [u, v, w] = &rows;
            let minor = |i: usize, j: usize| &v[i] * &w[j] - &v[j] * &w[i];
            let circle = &u[0] * minor(1, 2) - &u[1] * minor(0, 2) + &u[2] * minor(0, 1);
            assert!(circle <= BigInt::from(0), "{}: {row:?}", context());
        }
    }
}

/// No corner is in the circle around a segment, at any angle between segments and any least angle; also after coarsening,
/// which makes nothing that refinement would have to split again.
#[test]
fn no_corner_is_in_the_circle_around_a_segment() {
    let (mut n_before, mut n_made, mut n_removed) = (0, 0, 0);
    let named = domains().into_iter().map(|(name, domain)| {
        let n = domain.edges.len();
        (
            domain,
            match name {
                "slit" => 4,
                "letter" => 8,
                _ => n,
            },
        )
    });
    let random = seeds(80).map(|seed| random_domain(&mut Rng::new(seed)));
    for (k, (domain, n_loops)) in named.chain(random).enumerate() {
        let rng = &mut Rng::new(k as u64);
        let context = || format!("domain {k}: {domain:?}");
        let mut t = Triangulation::new(&domain.points, Options::default()).expect("good points");
        let segment = |k: usize| Segment {
            ends: domain.edges[k].map(VertexId::at),
            marker: k as i32,
            ..Segment::default()
        };
        t.stage_segments((0..domain.edges.len()).map(segment)).expect("present");
        if t.commit_timestamp().is_err() || has_tiny_angle(&domain) {
            continue;
        }
        let is_loop = |marker: i32| (marker as usize) < n_loops;
        let quality = Quality {
            least_angle: *rng.pick(&[0.0, 0.0, 20.0, 28.0]),
            greatest_area: *rng.pick(&[0.0, 0.05]),
            is_conforming: true,
            ..Quality::default()
        };
        let selected = mask(&t, is_loop);
        n_before += encroached(&t, &selected).len();
        let report =
            refine(&mut t, &quality, &RefineOptions { limit: 100_000, ..Default::default() }, &selected);
        assert!(!report.is_cut_short && report.unsplit == 0, "{}: {report:?}", context());
        n_made += report.inserted;
        check_fresh(&t, &context);
        check_chains(&t, &domain, &context);
        let selected = mask(&t, is_loop);
        assert_eq!(encroached(&t, &selected), [], "{}", context());
        check_delaunay(&t, &selected, &context);
        assert_eq!(
            refine(&mut t, &quality, &RefineOptions::default(), &selected).inserted,
            0,
            "{}",
            context()
        );
        let coarser = Quality { greatest_area: 0.0, ..quality };
        n_removed += t.coarsen(&coarser, &CoarsenOptions::default(), &selected).expect("a domain").removed;
        let selected = mask(&t, is_loop);
        assert_eq!(encroached(&t, &selected), [], "{}: coarsened", context());
        check_delaunay(&t, &selected, &context);
    }
    println!("{n_before} encroached before, {n_made} made, {n_removed} removed");
    assert!(n_before > 50 && n_made > 1_000 && n_removed > 50, "{n_before}, {n_made}, {n_removed}");
}

/// What is kept whole stays, whatever is in its circle.
#[test]
fn segments_that_are_kept_are_not_split_for_their_circles() {
    let domain = super::Domain::default()
        .with_ring(&rectangle([0.0, 0.0], [8.0, 1.0]))
        .with_ring(&rectangle([2.0, 0.25], [6.0, 0.5]));
    for keeps in [Kept::Outer, Kept::All] {
        let mut t = domain.build();
        let selected = mask(&t, |_| true);
        let quality = Quality { is_conforming: true, ..Quality::default() };
        assert!(!encroached(&t, &selected).is_empty());
        let options = RefineOptions { keeps, ..RefineOptions::default() };
        assert_eq!(refine(&mut t, &quality, &options, &selected).inserted, 0);
        assert!(refine(&mut t, &quality, &RefineOptions::default(), &selected).inserted > 0);
    }
}

/// A function that breaks the call off, at any time, is not asked again, and nothing has changed.
#[test]
fn a_function_may_break_the_call_off() {
    let domain = super::Domain::default().with_ring(&rectangle([0.0, 0.0], [4.0, 4.0]));
    let refined = |t: &mut Triangulation, quality: &Quality| {
        t.refine(quality, &RefineOptions::default(), &mask(t, |_| true))
    };
    let coarsened = |t: &mut Triangulation, quality: &Quality| {
        t.coarsen(quality, &CoarsenOptions::default(), &mask(t, |_| true))
    };
    let mut fine = domain.build();
    refined(&mut fine, &Quality { greatest_area: 0.02, ..Quality::default() }).expect("a domain");
    for (base, does_refine) in [(&domain.build(), true), (&fine, false)] {
        let call = |t: &mut Triangulation, quality: &Quality| {
            if does_refine { refined(t, quality) } else { coarsened(t, quality) }
        };
        let n_asked = Cell::new(0);
        let last = Cell::new(usize::MAX);
        let is_too_large = |[a, b, c]: [[f64; 2]; 3]| {
            assert!(n_asked.get() <= last.get(), "it is asked again");
            n_asked.set(n_asked.get() + 1);
            if n_asked.get() > last.get() {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 1.0)
        };
        let quality = Quality { is_too_large: Some(&is_too_large), ..Quality::default() };
        let mut whole = base.try_clone(None).expect("room");
        let report = call(&mut whole, &quality).expect("it is not broken off");
        assert!(report.inserted + report.removed > 20);
        let n = n_asked.get();
        for k in (0..40).map(|k| k * (n - 1) / 39) {
            let mut t = base.try_clone(None).expect("room");
            let before = t.saved().expect("room");
            n_asked.set(0);
            last.set(k);
            assert_eq!(call(&mut t, &quality).err(), Some(Error::Cancelled), "{k} of {n}");
            assert_eq!((n_asked.get(), t.saved().expect("room")), (k + 1, before), "{k} of {n}");
            n_asked.set(0);
            last.set(usize::MAX);
            assert_eq!(call(&mut t, &quality).expect("it is not broken off"), report, "{k} of {n}");
            assert_eq!(cell_set(&t), cell_set(&whole), "{k} of {n}");
        }
    }
}
