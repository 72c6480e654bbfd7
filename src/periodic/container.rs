//! Boxes and half-spaces that cut the Voronoi cells of a set that repeats.
//!
//! What they leave repeats as the set does if no vector of the lattice leads out of it: faces of the box are across axes along
//! which no vector goes, and normals of half-spaces are perpendicular to all vectors. Both is decided exactly, of the vectors on
//! the grid. So the container is the sum of what the vectors span and of its *section*, which is across them: a segment or a polygon,
//! and has to be bounded.
//!
//! Inside, cells of vertices at home are cut as those of an open triangulation, by the half-spaces and by a box that has faces
//! of its own where none were given. No cell gets there: it is in the slabs |(x − u) · v| ≤ v² / 2 around its vertex u, for
//! each vector v, so that it is not more than some multiples of them away, and across them it is in the section. What is
//! beyond the container is cut off by half-spaces, wherever the box ends.
//!
//! Bounds of a polygon are those of its sides, each of which is what the other lines leave of a line. That takes the square of
//! their number; these bounds are rounded, and widened by more than that.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::check_position;
use crate::periodic::grid::ROOM;
use crate::periodic::lattice::Lattice;
use crate::periodic::reduction::{SLACK, dot};
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::predicates::MAX_MAGNITUDE;

/// A vector of space; in the plane at height 0.
type SpaceVector = [f64; 3];

/// By how much of its extent a bound is widened, at least.
const MARGIN: f64 = 1.0 / 64.0;

/// Lines of a section at a smaller angle, and faces of it, are parallel.
const PARALLEL: f64 = 1e-9;

/// The places x with normal · x at most the offset. The normal has length 1.
#[derive(Clone, Copy, Debug)]
struct Wall {
    normal: SpaceVector,
    offset: f64,
}

impl Wall {
    fn new(normal: SpaceVector, offset: f64) -> Self {
        let greatest = normal.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let scaled = normal.map(|x| x / greatest);
        let length = dot(&scaled, &scaled).sqrt();
        Wall { normal: scaled.map(|x| x / length), offset: offset / greatest / length }
    }
}

/// The least box around some places.
#[derive(Clone, Copy, Debug)]
struct LeastBox {
    low: SpaceVector,
    high: SpaceVector,
}

impl LeastBox {
    const NOTHING: Self = LeastBox { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Makes room for a place that is so far from another one in a direction, maybe infinitely far.
    fn enter(&mut self, from: &SpaceVector, along: &SpaceVector, way: f64) {
        for axis in 0..3 {
            let x = if along[axis] == 0.0 { from[axis] } else { from[axis] + way * along[axis] };
            self.low[axis] = self.low[axis].min(x);
            self.high[axis] = self.high[axis].max(x);
        }
    }
}

/// What cells of vertices at home are cut by inside: a box, and half-spaces as they were given.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Container<'h, G: Moving> {
    pub(super) corners: [G::Point; 2],
    pub(super) half_spaces: &'h [f64],
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// What cuts the cells; none if nothing does.
    ///
    /// Cost: the number of half-spaces, and its square where the set is open in two directions.
    ///
    /// `clip`: the corners of the box that is given, if any, infinite where it has no face. `half_spaces`: rows of an outward
    /// normal and an offset.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::OutOfRange`] for a corner, a normal or an offset; [`Error::InvalidValue`] for a face of the
    /// box across an axis along which a vector goes, one that is not above its opposite, a normal that is zero or not
    /// perpendicular to all vectors, or if what is left is not bounded across the vectors; [`Error::WrongCount`] if the
    /// numbers do not make up rows, [`Error::OutOfMemory`].
    pub(crate) fn container<'h>(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &'h [f64],
    ) -> Result<Option<Container<'h, G>>> {
        let lattice = &self.lattice;
        let [low, high] = checked_corners(lattice, clip)?;
        self.inside.t.check_half_spaces(half_spaces)?;
        for (index, row) in half_spaces.chunks(G::D + 1).enumerate() {
            if let Some(product) = lattice.product_with_vectors(&row[..G::D]) {
                let wanted = "0, which is the product of the normal and each vector of the box";
                return Err(Error::InvalidValue { argument: "half_spaces", index, value: product, wanted });
            }
        }
        let mut walls = Vec::new();
        memory::reserve_exact(&mut walls, half_spaces.len() / (G::D + 1) + 2 * G::D)?;
        let of_rows = half_spaces.chunks(G::D + 1).map(|row| {
            let normal = [row[0], row[1], if G::D == 3 { row[2] } else { 0.0 }];
            Wall::new(normal, row[G::D])
        });
        // Farther away, they bound nothing that is in range.
        walls.extend(of_rows.filter(|wall| wall.offset.abs() <= MAX_MAGNITUDE));
        for axis in 0..G::D {
            let mut normal = [0.0; 3];
            for (bound, outward) in [(low[axis], -1.0), (high[axis], 1.0)] {
                if bound.is_finite() {
                    normal[axis] = outward;
                    walls.push(Wall { normal, offset: outward * bound });
                }
            }
        }
        if walls.is_empty() && half_spaces.is_empty() {
            return Ok(None);
        }
        let across = lattice.across();
        let section = match G::D - lattice.rank() {
            1 => ends_of(&walls, &across[0]),
            _ => sides_of(&walls, &across),
        };
        let boxed = lattice.box_around(section, [&low, &high]);
        let is_far = |x: f64| x.is_nan() || x.abs() > MAX_MAGNITUDE;
        // What the caller can bound by the box comes first.
        for is_spanned in [false, true] {
            let axes = || (0..G::D).filter(|&axis| lattice.is_spanned(axis) == is_spanned);
            for ((argument, given), corner) in [("low", &low), ("high", &high)].into_iter().zip(&boxed) {
                if let Some(index) = axes().find(|&axis| is_far(corner[axis])) {
                    let wanted = "finite, or half-spaces must bound what is across the vectors of the box";
                    return Err(Error::InvalidValue { argument, index, value: given[index], wanted });
                }
            }
        }
        Ok(Some(Container { corners: boxed, half_spaces }))
    }
}

/// The corners of a box that may be cut by, infinite where it has no face.
fn checked_corners<G: Moving>(lattice: &Lattice<G>, clip: Option<[&G::Point; 2]>) -> Result<[G::Point; 2]> {
    let mut corners = [f64::NEG_INFINITY, f64::INFINITY].map(|x| {
        let mut corner = G::Point::default();
        (0..G::D).for_each(|axis| corner[axis] = x);
        corner
    });
    let Some(given) = clip else { return Ok(corners) };
    let of_each = [
        ("low", "-infinity along an axis that a vector of the box goes along"),
        ("high", "infinity along an axis that a vector of the box goes along"),
    ];
    for ((corner, given), (argument, wanted)) in corners.iter_mut().zip(given).zip(of_each) {
        for axis in 0..G::D {
            let value = given[axis];
            if value == corner[axis] {
                continue;
            }
            if !value.is_nan() && lattice.is_spanned(axis) {
                return Err(Error::InvalidValue { argument, index: axis, value, wanted });
            }
            let mut only = G::Point::default();
            only[axis] = value;
            corner[axis] = check_position::<G>(argument, 0, &only)?[axis];
        }
    }
    let [low, high] = &corners;
    match (0..G::D).find(|&axis| low[axis] >= high[axis]) {
        Some(index) => {
            let (value, wanted) = (high[index], "above low");
            Err(Error::InvalidValue { argument: "high", index, value, wanted })
        }
        None => Ok(corners),
    }
}

/// The ends of what walls leave of a line in a direction to which all are perpendicular; none if that is nothing.
fn ends_of(walls: &[Wall], along: &SpaceVector) -> Option<LeastBox> {
    let [from, to] = interval(walls, None, &[0.0; 3], along);
    if from > to {
        return None;
    }
    let mut extent = LeastBox::NOTHING;
    [from, to].into_iter().for_each(|end| extent.enter(&[0.0; 3], along, end));
    Some(extent)
}

/// The extent of the sides of the polygon that walls, of which there are some, leave of a plane that is spanned by two vectors
/// of length 1 at a right angle; none if there are no sides.
fn sides_of(walls: &[Wall], [one, other]: &[SpaceVector; 2]) -> Option<LeastBox> {
    let (mut extent, mut has_sides) = (LeastBox::NOTHING, false);
    for (k, wall) in walls.iter().enumerate() {
        let [x, y] = [dot(&wall.normal, one), dot(&wall.normal, other)];
        let along = [0, 1, 2].map(|axis| x * other[axis] - y * one[axis]);
        let foot = wall.normal.map(|x| wall.offset * x);
        let [from, to] = interval(walls, Some(k), &foot, &along);
        if from <= to {
            has_sides = true;
            [from, to].into_iter().for_each(|end| extent.enter(&foot, &along, end));
        }
    }
    has_sides.then_some(extent)
}

/// The parameters between which walls but one leave a line by a place on it and its direction, of length 1, and a bit more.
fn interval(walls: &[Wall], but: Option<usize>, at: &SpaceVector, along: &SpaceVector) -> [f64; 2] {
    let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
    for (k, wall) in walls.iter().enumerate() {
        let (slope, room) = (dot(&wall.normal, along), wall.offset - dot(&wall.normal, at));
        let slack = SLACK * (wall.offset.abs() + dot(at, at).sqrt());
        if Some(k) == but {
            continue;
        }
        if slope.abs() <= PARALLEL {
            if room < -slack {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
        } else if slope > 0.0 {
            ends[1] = ends[1].min((room + slack) / slope);
        } else {
            ends[0] = ends[0].max((room + slack) / slope);
        }
    }
    ends
}

impl<G: Moving> Lattice<G> {
    /// A product of a normal with a vector that is not exactly 0, rounded, if there is one.
    fn product_with_vectors(&self, normal: &[f64]) -> Option<f64> {
        self.reduced().iter().find_map(|vector| {
            let mut terms = [(0i128, 0i32); 3];
            for axis in (0..G::D).filter(|&axis| self.is_spanned(axis)) {
                let ((x, of_x), (y, of_y)) = (dyadic(normal[axis]), dyadic(vector[axis]));
                terms[axis] = (i128::from(x) * i128::from(y), of_x + of_y);
            }
            (!is_zero(terms)).then(|| {
                let products =
                    [0, 1, 2].map(|axis| if axis < G::D { normal[axis] * vector[axis] } else { 0.0 });
                // With what the products are off by: their sum may be much less than these.
                let off = |axis: usize| normal[axis].mul_add(vector[axis], -products[axis]);
                products.iter().sum::<f64>() + (0..G::D).map(off).sum::<f64>()
            })
        })
    }

    /// Vectors of length 1, at right angles to each other, which span what is perpendicular to the vectors of the lattice, as many
    /// as that has dimensions; along axes, where that is possible.
    fn across(&self) -> [SpaceVector; 2] {
        let widened = |p: &G::Point| [p[0], p[1], if G::D == 3 { p[2] } else { 0.0 }];
        let mut basis: [SpaceVector; 3] = Default::default();
        let mut n = 0;
        for vector in self.reduced() {
            if let Some(part) = part_across(&basis[..n], &widened(vector)) {
                basis[n] = part;
                n += 1;
            }
        }
        let first = n;
        while n < G::D {
            // Of the axes the one that is farthest from what is spanned already.
            let unit = |axis: usize| [0, 1, 2].map(|other| if other == axis { 1.0 } else { 0.0 });
            let left = |axis: usize| 1.0 - basis[..n].iter().map(|v| v[axis] * v[axis]).sum::<f64>();
            let axis = (0..G::D).fold(0, |best, axis| if left(axis) > left(best) { axis } else { best });
            basis[n] = part_across(&basis[..n], &unit(axis)).expect("some axis is across");
            n += 1;
        }
        [basis[first], basis[(first + 1).min(2)]]
    }

    /// A box around the cells of vertices at home in a container of this section, with the faces that are given.
    fn box_around(&self, section: Option<LeastBox>, [low, high]: [&G::Point; 2]) -> [G::Point; 2] {
        let section = section.unwrap_or(LeastBox { low: [0.0; 3], high: [0.0; 3] });
        let reach = self.reach_of_voronoi_cells();
        let (mut from, mut to) = (*low, *high);
        for axis in 0..G::D {
            let (mut least, mut most) = (section.low[axis], section.high[axis]);
            for (vector, reach) in self.reduced().iter().zip(reach) {
                let ends = [-ROOM - reach, 1.0 + ROOM + reach].map(|n| n * vector[axis]);
                least += ends[0].min(ends[1]);
                most += ends[0].max(ends[1]);
            }
            let margin = MARGIN * (most - least) + SLACK * (least.abs() + most.abs() + self.short_way());
            // Of few digits, so that no number is rounded more than the caller's are.
            let step = f64::from_bits(margin.to_bits() & !((1 << 52) - 1));
            if from[axis].is_infinite() {
                let bound = (least - margin).min(to[axis] - margin - SLACK * to[axis].abs());
                from[axis] = (bound / step).floor() * step;
            }
            if to[axis].is_infinite() {
                let bound = (most + margin).max(from[axis] + margin + SLACK * from[axis].abs());
                to[axis] = (bound / step).ceil() * step;
            }
        }
        [from, to]
    }
}

/// What a vector has across others, which have length 1 and are at right angles, with length 1; none if that is but rounding.
fn part_across(others: &[SpaceVector], vector: &SpaceVector) -> Option<SpaceVector> {
    let greatest = vector.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let mut part = vector.map(|x| x / greatest);
    // Once more, for what the first time has left by rounding.
    for _ in 0..2 {
        for other in others {
            let along = dot(&part, other);
            (0..3).for_each(|axis| part[axis] -= along * other[axis]);
        }
    }
    let length = dot(&part, &part).sqrt();
    (length > SLACK).then(|| part.map(|x| x / length))
}

/// A number as a product of an integer and a power of two, by the exponent of that.
fn dyadic(x: f64) -> (i64, i32) {
    let bits = x.abs().to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32, (bits & ((1 << 52) - 1)) as i64);
    let (mantissa, exponent) =
        if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    (if x < 0.0 { -mantissa } else { mantissa }, exponent)
}

/// Whether a sum of products of integers of fewer than 107 bits and powers of two is 0.
fn is_zero(mut terms: [(i128, i32); 3]) -> bool {
    loop {
        for (factor, exponent) in &mut terms {
            let zeros = if *factor == 0 { 0 } else { factor.trailing_zeros() };
            (*factor, *exponent) = (*factor >> zeros, *exponent + zeros as i32);
        }
        // Zeros come last; the others by their exponents, all being odd.
        terms.sort_unstable_by_key(|&(factor, exponent)| (factor == 0, exponent));
        let [(first, lowest), (second, next), _] = terms;
        if first == 0 {
            return true;
        }
        if second == 0 || lowest != next {
            return false;
        }
        terms[0].0 = first + second;
        terms[1].0 = 0;
    }
}
