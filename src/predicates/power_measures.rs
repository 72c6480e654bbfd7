//! Power spheres of cells of points with weights, and exact comparisons of their radii.
//!
//! The centre of the power sphere has one power to all corners, the squared radius, which may be negative: with the offset x
//! of the centre from corner `a` of weight w it is |x|² − w. The offset is n / 2V as without weights (`measures.rs`), of the lifts of
//! `located.rs`.
//!
//! # Accuracy
//!
//! Let e₁ ≥ e₂ be the two greatest magnitudes of differences along an axis, in the plane 1 for e₂, and q² the greater
//! one of e₁² and the greatest difference of a weight from that of `a`. A component of n is off by at most β e₁ e₂ q²,
//! with β of `filter.rs`. Where V > 2³¹ β e₁ e₂ q, that is q / 2³² in n / 2V, and V adds less than 2⁻³² of the offset's
//! length, as without weights: the offset is within 2⁻³⁰ m, for the greater one m of q and its length, and its square
//! within 2⁻²⁸ m². Elsewhere n and V are computed from integers, and quotients are off by a few last bits. Of underflow
//! the same is true as in `measures.rs`, with q for e₁. Of equal weights the centre is the circumcentre, to the last
//! bit, and within 2⁻³⁰ of its distance from corners.

use super::big::{Integer, LimbRoom, POWER_RADIUS_LIMBS, in_square_of_unit, lifted, square};
use super::filter::{POWER_CIRCLE_VECTOR, POWER_SPHERE_VECTOR};
use super::measures::{
    LEAST_EXTENT, LEAST_VOLUME, MARGIN, Measures, SHARP, lifted_circle, lifted_sphere, others, scaled,
};
use super::points::{PlanePoint, SpacePoint};
use super::vectors::{dot, greatest_along_axes, minus, plus};
use super::weighted::WeightedPoint;
use std::cmp::Ordering;

/// What a rounded difference of numbers is off by, relative to these, and more.
const ROUNDED: f64 = 1e-15;

/// The offset of the centre from the first corner, from rounded numbers.
struct Offset<const D: usize> {
    x: [f64; D],
    /// Whether it is as accurate as the module's documentation says.
    is_sharp: bool,
    /// The square of q.
    square: f64,
}

impl<const D: usize> Offset<D> {
    /// From the vector and the volume, the square of q, and β e₁ e₂.
    fn new(n: [f64; D], volume: f64, square: f64, bound: f64) -> Self {
        let q = square.sqrt();
        let amplified = if q > 1.0 { q * q * q } else { 1.0 };
        let is_sharp = q > LEAST_EXTENT && volume > 2.0 * SHARP * bound * q + LEAST_VOLUME * amplified;
        Offset { x: n.map(|x| x / (2.0 * volume)), is_sharp, square }
    }

    fn length_squared(&self) -> f64 {
        dot(&self.x, &self.x)
    }

    /// Whether the squared radius is at most `squared`, given the weight of the first corner, if that is certain.
    fn is_within(&self, weight: f64, squared: f64) -> Option<bool> {
        let own = self.length_squared();
        let apart = own - weight - squared;
        let margin = MARGIN * (own + self.square) + ROUNDED * (weight.abs() + squared.abs());
        (self.is_sharp && apart.abs() > margin).then_some(apart < 0.0)
    }
}

fn offset2d([a, b, c]: [&WeightedPoint<2>; 3]) -> Offset<2> {
    let [x, y, volume] = WeightedPoint::<2>::circle::<f64>(a, b, c);
    let [e, f] = greatest_along_axes([&minus(&b.place, &a.place), &minus(&c.place, &a.place)]);
    let (extent, square) = (e.max(f), square_of_q([e, f], a, [b, c]));
    Offset::new([x, y], volume, square, POWER_CIRCLE_VECTOR * extent)
}

fn offset3d([a, b, c, d]: [&WeightedPoint<3>; 4]) -> Offset<3> {
    let [x, y, z, volume] = WeightedPoint::<3>::sphere::<f64>(a, b, c, d);
    let differences = [b, c, d].map(|p| minus(&p.place, &a.place));
    let mut extents = greatest_along_axes(differences.each_ref());
    let square = square_of_q(extents, a, [b, c, d]);
    extents.sort_unstable_by(f64::total_cmp);
    Offset::new([x, y, z], volume, square, POWER_SPHERE_VECTOR * (extents[2] * extents[1]))
}

/// A power centre.
struct PowerCentre<const D: usize> {
    place: [f64; D],
    /// The square of the distance from the first corner.
    square: f64,
    /// The square of a length m: a coordinate is off by at most 10⁻⁹ m and its own rounding.
    bound: f64,
}

impl<const D: usize> PowerCentre<D> {
    /// From what is known of the offset from the first corner, and the exact one if that is not sharp.
    fn new(a: &WeightedPoint<D>, offset: &Offset<D>, exactly: impl FnOnce() -> [f64; D]) -> Self {
        let x = if offset.is_sharp { offset.x } else { exactly() };
        let square = dot(&x, &x);
        PowerCentre { place: plus(&a.place, &x), square, bound: square.max(offset.square) }
    }

    /// From a circumsphere.
    fn of_equal((place, square): ([f64; D], f64)) -> Self {
        PowerCentre { place, square, bound: square }
    }

    fn at(&self) -> WeightedPoint<D> {
        WeightedPoint { place: self.place, weight: 0.0 }
    }
}

/// Whether all weights are the same.
fn are_equal<const D: usize>(cell: &[&WeightedPoint<D>]) -> bool {
    cell.iter().all(|p| p.weight == cell[0].weight)
}

fn centre2d(cell: &[&WeightedPoint<2>]) -> PowerCentre<2> {
    let &[a, b, c] = cell else { unreachable!("a triangle") };
    if are_equal(cell) {
        return PowerCentre::of_equal(<[f64; 2]>::circumsphere(&[&a.place, &b.place, &c.place]));
    }
    PowerCentre::new(a, &offset2d([a, b, c]), || exact_offset([a, b, c], |p, lifts| lifted_circle(p, lifts)))
}

fn centre3d(cell: &[&WeightedPoint<3>]) -> PowerCentre<3> {
    let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
    if are_equal(cell) {
        return PowerCentre::of_equal(<[f64; 3]>::circumsphere(&[&a.place, &b.place, &c.place, &d.place]));
    }
    let exactly = || exact_offset([a, b, c, d], |p, lifts| lifted_sphere(p, lifts));
    PowerCentre::new(a, &offset3d([a, b, c, d]), exactly)
}

fn square_of_q<const D: usize, const N: usize>(
    extents: [f64; D],
    a: &WeightedPoint<D>,
    others: [&WeightedPoint<D>; N],
) -> f64 {
    let extent = extents.into_iter().fold(0.0, f64::max);
    others.iter().fold(extent * extent, |most, p| most.max((p.weight - a.weight).abs()))
}

/// An integer of what is compared here.
type Long<'r> = Integer<'r, POWER_RADIUS_LIMBS>;

/// The weights of a cell, that of the first corner after the others, and then another number.
fn weights_of<const D: usize, const N: usize>(cell: [&WeightedPoint<D>; N], other: f64) -> [f64; 5] {
    let mut weights = [other; 5];
    for (weight, p) in weights.iter_mut().zip(&cell[1..]) {
        *weight = p.weight;
    }
    weights[N - 1] = cell[0].weight;
    weights
}

/// From the first corner to the centre, rounded.
#[cold]
#[inline(never)]
fn exact_offset<const D: usize, const M: usize, const N: usize>(
    cell: [&WeightedPoint<D>; N],
    sphere: impl for<'r> FnOnce(&[[Long<'r>; D]; M], [Long<'r>; M]) -> ([Long<'r>; D], Long<'r>),
) -> [f64; D] {
    let room = LimbRoom::of_any_size();
    let points: [&[f64; D]; M] = others(cell.map(|p| &p.place));
    let (unit, differences, lifts) = lifted(&room, &cell[0].place, points, &weights_of(cell, 0.0));
    let (n, volume) = sphere(&differences, lifts);
    let (divisor, shift) = volume.rounded();
    n.map(|n| {
        let (mantissa, exponent) = n.rounded();
        scaled(mantissa / divisor, exponent - shift - 1 + unit)
    })
}

/// Whether |n|² ≤ 4 V² (`squared` + w).
#[cold]
#[inline(never)]
fn is_exactly_within<const D: usize, const M: usize, const N: usize>(
    cell: [&WeightedPoint<D>; N],
    squared: f64,
    sphere: impl for<'r> FnOnce(&[[Long<'r>; D]; M], [Long<'r>; M]) -> ([Long<'r>; D], Long<'r>),
) -> bool {
    if squared.is_infinite() {
        return squared > 0.0;
    }
    let room = LimbRoom::of_any_size();
    let points: [&[f64; D]; M] = others(cell.map(|p| &p.place));
    let (unit, differences, lifts) = lifted(&room, &cell[0].place, points, &weights_of(cell, squared));
    let (n, volume) = sphere(&differences, lifts);
    let [squared, weight] = [squared, cell[0].weight].map(|x| in_square_of_unit(&room, x, unit));
    let twice = volume + volume;
    (square(&n) - twice * twice * (squared + weight)).sign() != Ordering::Greater
}

impl Measures for WeightedPoint<2> {
    fn volume_by(cell: &[&Self], sharp: f64) -> f64 {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        <[f64; 2]>::volume_by(&[&a.place, &b.place, &c.place], sharp)
    }

    fn circumsphere(cell: &[&Self]) -> (Self, f64) {
        let centre = centre2d(cell);
        (centre.at(), centre.square - cell[0].weight)
    }

    fn centre(cell: &[&Self]) -> (Self, f64) {
        let centre = centre2d(cell);
        (centre.at(), centre.bound)
    }

    fn is_circumradius_within(cell: &[&Self], squared: f64) -> bool {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        let is_within = offset2d([a, b, c]).is_within(a.weight, squared);
        is_within.unwrap_or_else(|| is_exactly_within([a, b, c], squared, |p, lifts| lifted_circle(p, lifts)))
    }
}

impl Measures for WeightedPoint<3> {
    fn volume_by(cell: &[&Self], sharp: f64) -> f64 {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        <[f64; 3]>::volume_by(&[&a.place, &b.place, &c.place, &d.place], sharp)
    }

    fn circumsphere(cell: &[&Self]) -> (Self, f64) {
        let centre = centre3d(cell);
        (centre.at(), centre.square - cell[0].weight)
    }

    fn centre(cell: &[&Self]) -> (Self, f64) {
        let centre = centre3d(cell);
        (centre.at(), centre.bound)
    }

    fn is_circumradius_within(cell: &[&Self], squared: f64) -> bool {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        let is_within = offset3d([a, b, c, d]).is_within(a.weight, squared);
        is_within
            .unwrap_or_else(|| is_exactly_within([a, b, c, d], squared, |p, lifts| lifted_sphere(p, lifts)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Rng;

    /// Cells whose power centre and squared radius are known integers: the square is found to a few last bits whatever the scale,
    /// and compared exactly, one last bit off.
    fn check<const D: usize, const N: usize>(
        orientation: impl Fn([&[f64; D]; N]) -> f64,
        circumsphere: impl Fn([&WeightedPoint<D>; N]) -> (WeightedPoint<D>, f64),
        is_within: impl Fn([&WeightedPoint<D>; N], f64) -> bool,
    ) {
        let rng = &mut Rng::new(3);
        let (mut n_cells, mut n_negative) = (0, 0);
        while n_cells < 4_000 {
            let size = [4, 100, 1 << 20][rng.below(3)];
            let exponent = rng.within(-200, 60) as i32;
            let unit = 2f64.powi(exponent);
            let whole = |rng: &mut Rng| -> [i64; D] { std::array::from_fn(|_| rng.within(-size, size)) };
            let centre = whole(rng);
            let corners: [[i64; D]; N] = std::array::from_fn(|_| whole(rng));
            let squared = rng.within(-3 * size * size, 3 * size * size);
            let cell = corners.map(|p| {
                let apart: i64 = (0..D).map(|k| (p[k] - centre[k]) * (p[k] - centre[k])).sum();
                let place = p.map(|x| x as f64 * unit);
                WeightedPoint { place, weight: (apart - squared) as f64 * unit * unit }
            });
            if orientation(cell.each_ref().map(|p| &p.place)) <= 0.0 {
                continue;
            }
            n_cells += 1;
            n_negative += usize::from(squared < 0);
            let (found, radius) = circumsphere(cell.each_ref());
            let square = squared as f64 * unit * unit;
            let scale = (3 * size) as f64 * unit;
            for (x, centre) in found.place.into_iter().zip(centre) {
                let apart = (x - centre as f64 * unit).abs();
                assert!(apart < 1e-7 * scale, "{cell:?}: {apart}");
            }
            assert!((radius - square).abs() < 1e-7 * scale * scale, "{cell:?}: {radius}, {square}");
            assert!(is_within(cell.each_ref(), square), "{cell:?}");
            assert!(
                is_within(cell.each_ref(), square.next_up())
                    && !is_within(cell.each_ref(), square.next_down())
            );
        }
        assert!(n_negative > 1_000);
    }

    #[test]
    fn power_spheres_are_known_to_the_last_bit() {
        check::<2, 3>(
            |[a, b, c]| super::super::area(a, b, c),
            |cell| WeightedPoint::<2>::circumsphere(&cell),
            |cell, squared| WeightedPoint::<2>::is_circumradius_within(&cell, squared),
        );
        check::<3, 4>(
            |[a, b, c, d]| super::super::volumes_over([a, b, c], [*d; 3])[0],
            |cell| WeightedPoint::<3>::circumsphere(&cell),
            |cell, squared| WeightedPoint::<3>::is_circumradius_within(&cell, squared),
        );
    }
}
