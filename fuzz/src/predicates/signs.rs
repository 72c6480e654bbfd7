//! Orientations and in-sphere tests.

use super::super::exact_oracle::{Tally, bounding_box, exact_sign, is_inside_by_polynomial};
use super::super::source::Source;
use super::super::tally;
use super::points::points;
use deldrift::capi::{deldrift_in_power_sphere, deldrift_in_sphere, deldrift_orientation, deldrift_status};
use deldrift::internals::predicates::*;
use std::array::from_fn;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The sign by integers, counted.
pub fn exact<const D: usize, const N: usize>(points: &[[f64; D]; N]) -> Ordering {
    let mut counts = Tally::default();
    let sign = exact_sign(points, &mut counts);
    tally::SIGNS.add(1);
    tally::TIES.add(counts.zero as u64);
    tally::LONG.add(counts.big as u64);
    sign
}

fn sign(x: f64) -> Ordering {
    x.partial_cmp(&0.0).expect("not NaN")
}

/// The filter of the points' own box; one that holds for all coordinates; that of no box; and, for points of a lattice,
/// that of these.
fn filters<const D: usize>(
    of_box: fn([f64; D], [f64; D]) -> StaticFilter,
    points: &[[f64; D]],
) -> impl Iterator<Item = StaticFilter> {
    let [low, high] = bounding_box(points);
    let lattice = exact_filter(of_box, &low, &high, points.iter());
    let wide = of_box([-MAX_MAGNITUDE; D], [MAX_MAGNITUDE; D]);
    [of_box(low, high), wide, of_box([1.0; D], [-1.0; D])].into_iter().chain(lattice)
}

pub fn in_plane(s: &mut Source) {
    let p: [[f64; 2]; 4] = points(s);
    let [a, b, c, d] = &p;
    let (orientation, beyond) = (exact(&[*a, *b, *c]), exact(&[*b, *a, *d]));
    let side = exact(&p);
    let [u, v, w] = [a, b, c].map(|p| Lifted::new(p, d));
    let corners = [&u, &v, &w];
    let seen = side_of_seen_circle(corners, [u.cross(&v), v.cross(&w), w.cross(&u)]);
    if seen.abs() > seen_circle_bound(corners) {
        assert_eq!(sign(seen), side, "by lengths {p:?}");
    }
    for f in filters(StaticFilter::plane, &p) {
        assert_eq!(sign(orient2d(&f, a, b, c)), orientation, "orient2d {p:?} {f:?}");
        assert_eq!(sign(orient2d(&f, b, a, d)), beyond, "orient2d {p:?} {f:?}");
        assert_eq!(sign(incircle(&f, a, b, c, d)), side, "incircle {p:?} {f:?}");
        assert_eq!(sign(incircle(&f, a, c, b, d)), side.reverse(), "incircle, exchanged {p:?} {f:?}");
        for certain in [<[f64; 2]>::side(&circle(a, b, c), a, d), seen] {
            // On a lattice a value of zero is a tie.
            if certain.abs() > f.prepared {
                assert_eq!(sign(certain), side, "prepared {p:?} {f:?}");
            }
        }
        let bicell = [c, a, b, d];
        // That of a lattice is for builds, which look at no bi-cells.
        if !f.is_exact && holds(&f, &bicell) {
            assert_eq!([orientation, beyond, side], [Greater, Greater, Less], "bi-cell {p:?} {f:?}");
        }
    }
    if orientation == Greater
        && beyond == Greater
        && <[f64; 2]>::tolerance(&[c, a, b, d], f64::INFINITY) > 0.0
    {
        assert_eq!(side, Less, "tolerance {p:?}");
    }
    assert!(
        orientation == Greater || orientation_tolerance2d([a, b, c]) == 0.0,
        "orientation tolerance {p:?}"
    );
    let corner: [f64; 2] = points::<2, 1>(s)[0];
    let [low, high] = bounding_box(&[*d, corner]);
    if orientation == Greater && is_box_outside_circle([a, b, c], [&low, &high]) {
        let corners = s.byte();
        let other = from_fn(|axis| if corners >> axis & 1 == 0 { low[axis] } else { high[axis] });
        assert_eq!((side, exact(&[*a, *b, *c, other])), (Less, Less), "box {low:?} {high:?} {p:?}");
    }
}

pub fn in_space(s: &mut Source) {
    let p: [[f64; 3]; 5] = points(s);
    let [a, b, c, d, e] = &p;
    let (orientation, beyond) = (exact(&[*a, *b, *c, *d]), exact(&[*a, *c, *b, *e]));
    let side = exact(&p);
    let prepared = <[f64; 3]>::side(&sphere(a, b, c, d), a, e);
    if prepared.abs() > side_bound_by_length(edge_length(a, b, c, d) as f32, a, e) {
        assert_eq!(sign(prepared), side, "by lengths {p:?}");
    }
    let (half_space_by_length, length) = half_space_by_length(a, b, c);
    let beyond_plane = <[f64; 3]>::side(&half_space_by_length, a, d);
    if beyond_plane.abs() > side_bound_by_length(length, a, d) {
        assert_eq!(sign(beyond_plane), orientation, "half-space by lengths {p:?}");
    }
    for f in filters(StaticFilter::space, &p) {
        assert_eq!(sign(orient3d(&f, a, b, c, d)), orientation, "orient3d {p:?} {f:?}");
        assert_eq!(sign(orient3d(&f, a, c, b, e)), beyond, "orient3d {p:?} {f:?}");
        assert_eq!(sign(insphere(&f, a, b, c, d, e)), side, "insphere {p:?} {f:?}");
        assert_eq!(sign(insphere(&f, b, a, c, d, e)), side.reverse(), "insphere, exchanged {p:?} {f:?}");
        if prepared.abs() > f.prepared || <[f64; 3]>::is_side_certain(prepared, [a, b, c, d, e]) {
            assert_eq!(sign(prepared), side, "prepared {p:?} {f:?}");
        }
        let beyond_plane = <[f64; 3]>::side(&half_space(&f, a, b, c), a, d);
        if beyond_plane.abs() > f.prepared {
            assert_eq!(sign(beyond_plane), orientation, "half-space {p:?} {f:?}");
        }
        let bicell = [d, a, b, c, e];
        // That of a lattice is for builds, which look at no bi-cells.
        if !f.is_exact && holds(&f, &bicell) {
            assert_eq!([orientation, beyond, side], [Greater, Greater, Less], "bi-cell {p:?} {f:?}");
        }
    }
    let bicell = [d, a, b, c, e];
    if orientation == Greater && beyond == Greater && <[f64; 3]>::tolerance(&bicell, f64::INFINITY) > 0.0 {
        assert_eq!(side, Less, "tolerance {p:?}");
    }
    assert!(
        orientation == Greater || orientation_tolerance3d([a, b, c, d]) == 0.0,
        "orientation tolerance {p:?}"
    );
    let corner: [f64; 3] = points::<3, 1>(s)[0];
    let [low, high] = bounding_box(&[*e, corner]);
    if orientation == Greater && is_box_outside_sphere([a, b, c, d], [&low, &high]) {
        let corners = s.byte();
        let other = from_fn(|axis| if corners >> axis & 1 == 0 { low[axis] } else { high[axis] });
        assert_eq!((side, exact(&[*a, *b, *c, *d, other])), (Less, Less), "box {low:?} {high:?} {p:?}");
    }
}

/// Whether a bi-cell, in each lane, surely is as it should be.
fn holds<P: BiCellTolerances>(f: &StaticFilter, bicell: &[&P]) -> bool {
    let mut bicells = P::BiCells::default();
    (0..LANES).for_each(|lane| P::set_bicell(&mut bicells, lane, bicell));
    let holds = P::bicells_hold(f, &bicells);
    assert!(holds.iter().all(|&other| other == holds[0]), "lanes differ");
    holds[0]
}

/// Ids that differ.
fn ids<const N: usize>(s: &mut Source) -> [u32; N] {
    let mut ids: [u32; N] = from_fn(|i| (i * i) as u32 * 1000);
    for i in (1..N).rev() {
        ids.swap(i, s.below(i + 1));
    }
    ids
}

/// Distinct points of which the first ones are positively oriented.
fn positive<const D: usize, const N: usize>(
    s: &mut Source,
    orientation: impl Fn(&[[f64; D]; N]) -> Ordering,
) -> Option<[[f64; D]; N]> {
    let mut p: [[f64; D]; N] = points(s);
    if (0..N).any(|i| p[..i].contains(&p[i])) {
        return None;
    }
    match orientation(&p) {
        Equal => return None,
        Less => p.swap(0, 1),
        Greater => {}
    }
    Some(p)
}

fn inside<const D: usize, const N: usize>(p: &[[f64; D]; N], ids: &[u32; N]) -> bool {
    let mut counts = Tally::default();
    let inside = is_inside_by_polynomial(p, ids, &mut counts);
    tally::SIGNS.add(1);
    tally::TIES.add(counts.zero as u64);
    tally::LONG.add(counts.big as u64);
    inside
}

pub fn perturbed_in_plane(s: &mut Source) {
    let Some(p) = positive::<2, 4>(s, |[a, b, c, _]| exact(&[*a, *b, *c])) else { return };
    let ids = ids(s);
    let expected = inside(&p, &ids);
    for f in filters(StaticFilter::plane, &p) {
        let found = incircle_perturbed(&f, p.each_ref(), || ids);
        assert_eq!(found, expected, "incircle_perturbed {p:?} {ids:?} {f:?}");
    }
}

pub fn perturbed_in_space(s: &mut Source) {
    let Some(p) = positive::<3, 5>(s, |[a, b, c, d, _]| exact(&[*a, *b, *c, *d])) else { return };
    let (is_tie, ids) = (exact(&p) == Equal, ids(s));
    let expected = inside(&p, &ids);
    for f in filters(StaticFilter::space, &p) {
        let found = insphere_perturbed(&f, p.each_ref(), || ids);
        assert_eq!(found, expected, "insphere_perturbed {p:?} {ids:?} {f:?}");
        if f.is_exact && is_tie {
            let found = is_inside_cospherical_on_lattice(p.each_ref(), ids);
            assert_eq!(found, expected, "on a lattice {p:?} {ids:?}");
        }
    }
}

/// The functions of the header.
pub fn by_c(s: &mut Source) {
    fn check_in_sphere<const D: usize, const N: usize>(p: [[f64; D]; N]) {
        let mut found = 7;
        // SAFETY: as many numbers as the dimension says, and a place for the sign.
        let status = unsafe { deldrift_in_sphere(D as u32, p.as_ptr().cast(), &mut found) };
        assert_eq!(status, deldrift_status::DELDRIFT_OK, "{p:?}");
        assert_eq!(found.cmp(&0), exact(&p), "deldrift_in_sphere {p:?}");
        // Equal weights make no difference, and a heavier point is inside where a lighter one is.
        let (mut heavier, mut orientation) = (7, 7);
        let mut weights = [p[0][0]; N];
        // SAFETY: as many numbers as the dimension says, and a place for the sign.
        unsafe {
            let points = p.as_ptr().cast();
            let status = deldrift_in_power_sphere(D as u32, points, weights.as_ptr(), &mut found);
            assert_eq!(status, deldrift_status::DELDRIFT_OK, "{p:?}");
            weights[N - 1] = weights[N - 1].abs() * 2.0 + 1.0;
            let status = deldrift_in_power_sphere(D as u32, points, weights.as_ptr(), &mut heavier);
            assert_eq!(status, deldrift_status::DELDRIFT_OK, "{p:?}");
            assert_eq!(
                deldrift_orientation(D as u32, points, &mut orientation),
                deldrift_status::DELDRIFT_OK
            );
        }
        assert_eq!(found.cmp(&0), exact(&p), "deldrift_in_power_sphere {p:?}");
        assert!((heavier - found) * orientation >= 0, "{p:?}: {found} {heavier}");
    }
    fn check<const D: usize, const N: usize>(p: [[f64; D]; N]) {
        let mut found = 7;
        // SAFETY: as many numbers as the dimension says, and a place for the sign.
        let status = unsafe { deldrift_orientation(D as u32, p.as_ptr().cast(), &mut found) };
        assert_eq!(status, deldrift_status::DELDRIFT_OK, "{p:?}");
        assert_eq!(found.cmp(&0), exact(&p), "deldrift_orientation {p:?}");
    }
    if s.below(2) == 0 {
        check(points::<2, 3>(s));
        check_in_sphere(points::<2, 4>(s));
    } else {
        check(points::<3, 4>(s));
        check_in_sphere(points::<3, 5>(s));
    }
}
