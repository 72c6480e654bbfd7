//! What makes a triangle bad, and a piece of a segment *encroached*.
//!
//! Tests are rounded to the safe side: what passes fulfils the criteria in exact arithmetic. Lengths are scaled by a power
//! of two so that their fourth powers neither overflow nor, where they matter, underflow.

use super::parts::NOT_SELECTED;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::predicates::{dot, is_in_diametral_circle, minus};
use std::cell::Cell;
use std::ops::ControlFlow;

/// Rounded cosines are off by less than this, squared ones by less than twice as much: products of differences that are
/// off by half a last bit each.
const ROUNDING: f64 = 1e-14;

/// What passes by this share passes whatever the order of operations.
const SURE: f64 = 1e-9;

/// Products of squared lengths above it have all their digits.
const UNDERFLOW: f64 = 1e-280;

/// An off-centre is this much nearer than where the new triangle would just have the least angle, so that it has it after
/// rounding, and its neighbours have room (Üngör, 10.1016/j.comgeo.2008.06.002, leaves the factor open).
const OFF_CENTRE: f64 = 0.475;

/// Vertices and pieces that are nearer to each other than so many last places of the greatest coordinate are taken for
/// touching: no vertex comes between them. Angles of triangles with longer edges and greater heights are off by less than a
/// tenth of a degree.
const TOUCHING: f64 = 1024.0;

/// A gap between two segments is narrow if its width is below this share of the shorter one's length. It is no round
/// number, as widths and lengths often are.
pub(super) const NARROW: f64 = 1.0 / 8192.0;

/// All coordinates are multiples of it.
const LEAST_POSITIVE: f64 = f64::from_bits(1);

/// Says whether a triangle is too large, or that nothing more is to be done.
pub(crate) type TooLarge<'a> = &'a dyn Fn([[f64; 2]; 3]) -> ControlFlow<(), bool>;

/// What triangles must fulfil.
#[derive(Clone, Copy)]
pub(crate) struct Criteria<'a> {
    /// In degrees; 0 for none.
    pub least_angle: f64,
    /// Infinite for none.
    pub greatest_area: f64,
    /// By label, infinite for none; labels beyond have none.
    pub areas: &'a [f64],
    /// The greatest length of an edge at each vertex; empty for none.
    pub sizes: &'a [f64],
    pub is_too_large: Option<TooLarge<'a>>,
    /// Whether pieces are encroached by what is in their diametral circles, and not only in the lenses.
    pub is_conforming: bool,
    /// What places have been multiplied by, a power of two.
    pub scale: f64,
}

/// Why a triangle is bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flaw {
    Size,
    Angle,
}

/// What is computed from criteria once.
pub(crate) struct Tests<'a> {
    criteria: Criteria<'a>,
    /// Squared cosine of the least angle, or a bit less.
    pub(super) squared_cosine: f64,
    /// Tangent of the least angle.
    tangent: f64,
    /// Squared cosine of twice the least angle.
    lens: f64,
    /// Distance of an off-centre from its edge, by the edge's length.
    pub(super) off: f64,
    /// A power of two by which lengths are multiplied.
    scale: f64,
    /// What is nearer touches.
    pub(super) resolution: f64,
    /// No narrow gap is wider.
    pub(super) widest_gap: f64,
    /// Whether the function of the criteria has said to stop: it is not asked any more.
    is_stopped: Cell<bool>,
}

/// What has been measured of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    /// The corner opposite the shortest edge.
    pub(super) narrowest: usize,
    /// Squared length of the shortest edge.
    pub(super) shortest: f64,
    pub(crate) flaw: Option<Flaw>,
}

impl<'a> Tests<'a> {
    /// For places in a box.
    pub(crate) fn new(criteria: Criteria<'a>, lower: [f64; 2], upper: [f64; 2]) -> Self {
        let angle = criteria.least_angle.to_radians();
        let cosine = angle.cos();
        let extent = (upper[0] - lower[0]).max(upper[1] - lower[1]);
        let greatest = lower.iter().chain(&upper).fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
        Tests {
            criteria,
            squared_cosine: if angle > 0.0 { cosine * cosine - ROUNDING } else { 2.0 },
            tangent: angle.tan(),
            lens: (2.0 * cosine * cosine - 1.0).powi(2),
            off: OFF_CENTRE * ((1.0 + cosine) / (1.0 - cosine)).sqrt(),
            // The inverse of a subnormal number may be infinite.
            scale: if extent > 0.0 { power_of_two_below((1.0 / extent).min(f64::MAX)) } else { 1.0 },
            resolution: TOUCHING
                * (f64::EPSILON * power_of_two_below(greatest)).max(LEAST_POSITIVE * criteria.scale),
            widest_gap: 2.0 * NARROW * extent,
            is_stopped: Cell::new(false),
        }
    }

    /// An error if the function of the criteria has said to stop.
    #[inline(always)]
    pub(crate) fn check_stop(&self) -> Result<()> {
        if self.is_stopped.get() { Err(Error::Cancelled) } else { Ok(()) }
    }

    pub(super) fn has_sizes(&self) -> bool {
        !self.criteria.sizes.is_empty()
    }

    pub(super) fn has_least_angle(&self) -> bool {
        self.criteria.least_angle > 0.0
    }

    /// Whether areas are bounded.
    pub(super) fn has_areas(&self) -> bool {
        let Criteria { greatest_area, areas, .. } = &self.criteria;
        *greatest_area < f64::INFINITY || areas.iter().any(|&area| area < f64::INFINITY)
    }

    /// Measures a triangle, of which the label says how large it may be. `size` is that at a corner.
    #[inline(always)]
    pub(crate) fn measure(&self, p: [&[f64; 2]; 3], label: u32, size: impl Fn(usize) -> f64) -> Measured {
        self.measure_with(p, label, size, 1.0, self.squared_cosine)
    }

    /// Measures a triangle by areas and lengths that are `share` as large, and this squared cosine.
    #[inline(always)]
    pub(super) fn measure_with(
        &self,
        p: [&[f64; 2]; 3],
        label: u32,
        size: impl Fn(usize) -> f64,
        share: f64,
        squared_cosine: f64,
    ) -> Measured {
        let edge = |i: usize, j: usize| minus::<f64, 2>(p[j], p[i]).map(|x| x * self.scale);
        // Opposite each corner.
        let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
        let squares = edges.map(|u| dot(&u, &u));
        let narrowest = least(squares);
        let [j, k] = [(narrowest + 1) % 3, (narrowest + 2) % 3];
        let cosine = -dot(&edges[j], &edges[k]);
        let mut flaw = None;
        if cosine * cosine > squared_cosine * (squares[j] * squares[k]) && cosine > 0.0 {
            flaw = Some(Flaw::Angle);
        }
        if self.is_large(p, &edges, squares[j].max(squares[k]), label, size, share) {
            flaw = Some(Flaw::Size);
        }
        Measured { narrowest, shortest: squares[narrowest], flaw }
    }

    #[inline(always)]
    fn is_large(
        &self,
        p: [&[f64; 2]; 3],
        edges: &[[f64; 2]; 3],
        longest: f64,
        label: u32,
        size: impl Fn(usize) -> f64,
        share: f64,
    ) -> bool {
        let Criteria { sizes, is_too_large, .. } = &self.criteria;
        let bound = self.greatest_area(label);
        if bound < f64::INFINITY {
            let [u, v, _] = edges;
            let (one, other) = (u[0] * v[1], u[1] * v[0]);
            let area = 0.5 * ((one - other).abs() + ROUNDING * (one.abs() + other.abs()));
            if area > bound * share * self.scale * self.scale {
                return true;
            }
        }
        if !sizes.is_empty() {
            let mean = (size(0) + size(1) + size(2)) / 3.0 * self.scale * share;
            if longest * (1.0 + ROUNDING) > mean * mean {
                return true;
            }
        }
        is_too_large.is_some_and(|is_too_large| {
            !self.is_stopped.get()
                && is_too_large(p.map(|p| p.map(|x| x / self.criteria.scale)))
                    .continue_value()
                    .unwrap_or_else(|| {
                        self.is_stopped.set(true);
                        false
                    })
        })
    }

    /// Whether an edge is surely longer than one of a triangle may be that has this sum of sizes at its corners, where
    /// lengths are to be `share` as large.
    #[inline(always)]
    pub(super) fn is_longer_than(&self, ends: [&[f64; 2]; 2], sum: f64, share: f64) -> bool {
        let u = minus::<f64, 2>(ends[1], ends[0]).map(|x| x * self.scale);
        let mean = sum * (self.scale * share / 3.0);
        dot(&u, &u) > mean * mean * (1.0 + SURE)
    }

    /// Whether a triangle is surely good: by fewer operations than it takes to measure it, and none that depend on
    /// which edge is the shortest.
    #[inline(always)]
    pub(crate) fn is_surely_good(&self, p: [&[f64; 2]; 3], label: u32, corners: &[VertexId; 3]) -> bool {
        let Criteria { sizes, is_too_large, .. } = &self.criteria;
        let edge = |i: usize, j: usize| minus::<f64, 2>(p[j], p[i]).map(|x| x * self.scale);
        let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
        let [a, b, c] = edges.map(|u| dot(&u, &u));
        let (shortest, longest) = (a.min(b).min(c), a.max(b).max(c));
        // The product of the squares of the two edges at the smallest angle, and that of these.
        let product = longest * (a + b + c - shortest - longest);
        let cosine = 0.5 * (a + b + c) - shortest;
        let is_wide = cosine * cosine * (1.0 + SURE) <= self.squared_cosine * product && product > UNDERFLOW;
        let bound = self.greatest_area(label) * self.scale * self.scale;
        let (one, other) = (edges[0][0] * edges[1][1], edges[0][1] * edges[1][0]);
        let is_small = 0.5 * ((one - other).abs() + SURE * (one.abs() + other.abs())) <= bound;
        let is_short = sizes.is_empty() || {
            let mean = (sizes[corners[0]] + sizes[corners[1]] + sizes[corners[2]]) * (self.scale / 3.0);
            longest * (1.0 + SURE) <= mean * mean
        };
        is_wide && is_small && is_short && is_too_large.is_none()
    }

    /// Whether a triangle is bad.
    #[inline(always)]
    pub(crate) fn is_flawed(&self, p: [&[f64; 2]; 3], label: u32, corners: &[VertexId; 3]) -> bool {
        self.measure(p, label, |i| self.criteria.sizes[corners[i]]).flaw.is_some()
    }

    /// The share that a triangle has of the greatest area for its label, or a bit less; 0 if there is none.
    #[inline(always)]
    pub(crate) fn share_of_area(&self, p: [&[f64; 2]; 3], label: u32) -> f64 {
        let bound = self.greatest_area(label);
        if bound == f64::INFINITY {
            return 0.0;
        }
        let [u, v] = [p[1], p[2]].map(|q| minus::<f64, 2>(q, p[0]).map(|x| x * self.scale));
        let (one, other) = (u[0] * v[1], u[1] * v[0]);
        let area = 0.5 * ((one - other).abs() - ROUNDING * (one.abs() + other.abs()));
        area / (bound * self.scale * self.scale)
    }

    /// The squared cosine of an angle above the least one by a margin, in degrees.
    pub(super) fn squared_cosine_above(&self, margin: f64) -> f64 {
        let angle = self.criteria.least_angle;
        if angle > 0.0 { (angle + margin).to_radians().cos().powi(2) - ROUNDING } else { 2.0 }
    }

    /// Whether a vertex sees the two ends of a piece under so large an angle that the piece has to be split: in its
    /// diametral lens, or circle.
    #[inline(always)]
    pub(crate) fn is_encroached(&self, ends: [&[f64; 2]; 2], p: &[f64; 2]) -> bool {
        if self.criteria.is_conforming {
            return is_in_diametral_circle(ends, p);
        }
        let [u, v] = ends.map(|end| minus::<f64, 2>(end, p).map(|x| x * self.scale));
        let cosine = dot(&u, &v);
        cosine < 0.0 && cosine * cosine > self.lens * (dot(&u, &u) * dot(&v, &v))
    }

    /// Takes the number that is nearest among those that a coordinate can be.
    #[inline(always)]
    pub(super) fn rounding(&self) -> impl Fn(f64) -> f64 + use<> {
        let scale = self.criteria.scale;
        move |x| x / scale * scale + 0.0
    }

    /// Whether a triangle is so flat that its corners touch its longest edge.
    #[inline(always)]
    pub(super) fn is_flat(&self, p: [&[f64; 2]; 3]) -> bool {
        self.has_height_below(self.resolution, p)
    }

    /// Whether a triangle is so flat that its middle may be in a narrow gap.
    #[inline(always)]
    pub(crate) fn is_thin(&self, p: [&[f64; 2]; 3]) -> bool {
        self.has_height_below(2.0 * self.widest_gap, p)
    }

    #[inline(always)]
    fn has_height_below(&self, height: f64, p: [&[f64; 2]; 3]) -> bool {
        let [u, v, w] =
            [[0, 1], [0, 2], [1, 2]].map(|[i, j]| minus::<f64, 2>(p[j], p[i]).map(|x| x * self.scale));
        let longest = [u, v, w].map(|u| dot(&u, &u)).into_iter().fold(0.0, f64::max);
        (u[0] * v[1] - u[1] * v[0]).abs() < height * self.scale * longest.sqrt()
    }

    /// Whether an edge, of this squared length by [`measure`](Self::measure), is so short that its ends touch.
    #[inline(always)]
    pub(super) fn is_short(&self, squared_length: f64) -> bool {
        let least = 2.0 * self.resolution * self.scale;
        squared_length < least * least
    }

    /// Whether a piece is so long that each triangle at it with the least angle is too large, even one with that angle at
    /// both ends: L² tan(angle) / 4. Such pieces are split before anything else is looked at, as triangles beside them
    /// would be made in vain.
    #[inline(always)]
    pub(super) fn is_too_long(&self, ends: [&[f64; 2]; 2], label: u32) -> bool {
        let bound = self.greatest_area(label);
        if self.tangent == 0.0 || bound == f64::INFINITY {
            return false;
        }
        let u = minus::<f64, 2>(ends[0], ends[1]);
        0.25 * self.tangent * dot(&u, &u) > bound
    }

    #[inline(always)]
    fn greatest_area(&self, label: u32) -> f64 {
        let Criteria { greatest_area, areas, .. } = &self.criteria;
        greatest_area.min(areas.get(label as usize).copied().unwrap_or(f64::INFINITY))
    }

    /// Whether there is no criterion.
    pub(crate) fn are_none(&self) -> bool {
        let Criteria { least_angle, greatest_area, areas, sizes, is_too_large, is_conforming, scale: _ } =
            &self.criteria;
        *least_angle == 0.0
            && !is_conforming
            && *greatest_area == f64::INFINITY
            && areas.iter().all(|&area| area == f64::INFINITY)
            && sizes.is_empty()
            && is_too_large.is_none()
    }

    /// Whether cells of a label are to be refined.
    pub(crate) fn is_selected(label: u32) -> bool {
        label != NOT_SELECTED
    }

    /// Whether every triangle is to be Delaunay, segments or not.
    pub(super) fn are_conforming(&self) -> bool {
        self.criteria.is_conforming
    }

    /// The size given at a vertex.
    pub(super) fn given_sizes(&self) -> &'a [f64] {
        self.criteria.sizes
    }
}

#[inline(always)]
fn least(squares: [f64; 3]) -> usize {
    let of_two = if squares[1] < squares[0] { 1 } else { 0 };
    if squares[2] < squares[of_two] { 2 } else { of_two }
}

/// The corner opposite the shortest edge.
pub(super) fn narrowest(p: [&[f64; 2]; 3]) -> usize {
    least([[1, 2], [2, 0], [0, 1]].map(|[i, j]| {
        let u = minus::<f64, 2>(p[j], p[i]);
        dot(&u, &u)
    }))
}

pub(crate) fn distance(p: &[f64; 2], q: &[f64; 2]) -> f64 {
    let u = minus::<f64, 2>(p, q);
    dot(&u, &u).sqrt()
}

/// The greatest power of two that is not above `x`, which is a normal number.
pub(crate) fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7FF0_0000_0000_0000)
}

/// A vertex is added: its size, between those of others.
pub(super) fn size_between(sizes: &[f64], corners: [VertexId; 3], weights: [f64; 3]) -> f64 {
    let sum: f64 = weights.iter().sum();
    let mixed: f64 = corners.iter().zip(weights).map(|(&v, weight)| sizes[v] * weight).sum();
    // A triangle without area to rounding has weights of nothing.
    if sum > 0.0 && mixed > 0.0 {
        mixed / sum
    } else {
        corners.iter().map(|&v| sizes[v]).fold(f64::INFINITY, f64::min)
    }
}
