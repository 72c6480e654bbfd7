//! The vertices of which an image is in a box.
//!
//! Whether some translation of a place is in a box is decided in whole numbers, in units of the grid. Axes and vectors fall apart in
//! *groups*, so that no vector of one goes along an axis of another: each asks for multiples of its own vectors. A box along its
//! axes has as many groups as vectors, and each is one division.
//!
//! In a group of several vectors, as many as axes, a box that is as wide along each axis as all vectors together has a translation of the
//! parallelepiped of the vectors, and with it one of any place. Otherwise multiples of all vectors but one are tried, of as many as
//! the box may meet; those of the last one are an interval again. Where all axes but one are without bounds, sums of multiples
//! along that are the multiples of a greatest common divisor.
//!
//! Of a box that is short beside the period only the vertices in a ball around it are looked at.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::periodic::lattice::Lattice;
use crate::periodic::reduction::SLACK;
use crate::periodic::triangulation::PeriodicTriangulation;

/// Stands for a bound that is infinite, or farther away than this: in units of the grid.
const FAR: i128 = 1 << 120;

/// So many sums of multiples of vectors are tried for a vertex at most.
const MOST_TRIED: f64 = 4096.0;

/// Vectors and axes that belong together, by bits.
#[derive(Clone, Copy, Debug)]
struct Group {
    vectors: usize,
    axes: usize,
}

/// How the translations of a place in a group are found.
#[derive(Clone, Copy, Debug)]
enum TranslationSearch {
    /// There is one wherever the place is.
    Always,
    /// Along this axis they are apart by so many units; other axes have no bounds.
    Multiples(usize, i128),
    /// Of the vectors, with this one last.
    Tried(usize),
}

impl Group {
    fn has_vector(self, j: usize) -> bool {
        self.vectors >> j & 1 == 1
    }

    fn has_axis(self, axis: usize) -> bool {
        self.axes >> axis & 1 == 1
    }
}

/// A closed box, in units of the grid along axes along which vectors go.
struct BoxOnGrid<'l, G: Moving> {
    lattice: &'l Lattice<G>,
    corners: [G::Point; 2],
    low: [i128; 3],
    high: [i128; 3],
    /// By vector and axis.
    rows: [[i128; 3]; 3],
    groups: [Option<(Group, TranslationSearch)>; 3],
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// The vertices of which an image is in a closed box: each coordinate is at least that of `low` and at most that of `high`. Ascending,
    /// each once, hidden ones included. The box may be larger than the period, and its coordinates infinite; it is empty if one of
    /// `low` is above that of `high`.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.125, 0.5], [0.5, 0.5]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// assert_eq!(t.vertices_in_box(&[7.0, -3.75], &[7.25, -2.5])?, [VertexId::new(0)]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for NaN, for a box that is 10²⁰ periods away, and where vectors go along several axes, for a box that is thousands of periods long, or
    /// infinite along two axes fewer than these, but not as wide as all vectors of these axes together along each;
    /// [`Error::OutOfMemory`].
    pub fn vertices_in_box(&self, low: &G::Point, high: &G::Point) -> Result<Vec<VertexId>> {
        let bounds = BoxOnGrid::new(&self.lattice, low, high)?;
        let mut found = Vec::new();
        let is_empty = |axis: usize| {
            low[axis] > high[axis] || low[axis] == f64::INFINITY || high[axis] == f64::NEG_INFINITY
        };
        if (0..G::D).any(is_empty) {
            return Ok(found);
        }
        let mut enter = |vertex: VertexId| {
            let home = self.inside.images.home(vertex);
            let is_in = home != VertexId::NONE && bounds.has_image(&self.inside.places[home]);
            if is_in { memory::push(&mut found, vertex) } else { Ok(()) }
        };
        match self.ball_around(low, high) {
            Some((centre, square)) => {
                self.vertices_in_ball(&centre, square)?.into_iter().try_for_each(&mut enter)?;
            }
            None => VertexId::range(0..self.inside.images.n_vertices()).try_for_each(&mut enter)?,
        }
        Ok(found)
    }

    /// A ball that certainly has all of a box, whose centre goes to the grid, by the square of its radius; none if the box is so long that
    /// most vertices may have images in there.
    fn ball_around(&self, low: &G::Point, high: &G::Point) -> Option<(G::Point, f64)> {
        let (mut centre, mut square, mut off) = (*low, 0.0, 0.0);
        for axis in 0..G::D {
            let half = 0.5 * high[axis] - 0.5 * low[axis];
            centre[axis] = low[axis] + half;
            square += half * half;
            off += self.lattice.unit[axis] + 4.0 * f64::EPSILON * (low[axis].abs() + high[axis].abs());
        }
        let radius = square.sqrt() * (1.0 + SLACK) + 2.0 * off;
        let is_short = radius <= self.lattice.short_way() && self.lattice.wrapped("low", 0, &centre).is_ok();
        is_short.then_some((centre, radius * radius * (1.0 + SLACK)))
    }
}

impl<'l, G: Moving> BoxOnGrid<'l, G> {
    fn new(lattice: &'l Lattice<G>, low: &G::Point, high: &G::Point) -> Result<Self> {
        for (argument, corner) in [("low", low), ("high", high)] {
            if let Some(index) = (0..G::D).find(|&axis| corner[axis].is_nan()) {
                let (value, wanted) = (corner[index], "a number or infinite");
                return Err(Error::InvalidValue { argument, index, value, wanted });
            }
        }
        let mut bounds = BoxOnGrid {
            lattice,
            corners: [*low, *high],
            low: [-FAR; 3],
            high: [FAR; 3],
            rows: [[0; 3]; 3],
            groups: [None; 3],
        };
        for axis in (0..G::D).filter(|&axis| lattice.is_spanned(axis)) {
            let unit = lattice.unit[axis];
            for (argument, corner, sign) in [("low", low, 1.0), ("high", high, -1.0)] {
                let (value, is_wrong) = (corner[axis], sign * corner[axis] / unit >= FAR as f64);
                if is_wrong && value.is_finite() {
                    let wanted = "fewer than 2^120 steps of the grid of positions away";
                    return Err(Error::InvalidValue { argument, index: axis, value, wanted });
                }
            }
            // Quotients by a power of two are exact. A box that reaches so far has what one without end has: along a line
            // across the other axes translations repeat sooner.
            bounds.low[axis] = ((low[axis] / unit).ceil() as i128).clamp(-FAR, FAR);
            bounds.high[axis] = ((high[axis] / unit).floor() as i128).clamp(-FAR, FAR);
            for (row, vector) in bounds.rows.iter_mut().zip(lattice.reduced()) {
                row[axis] = (vector[axis] / unit) as i128;
            }
        }
        if (0..G::D).all(|axis| low[axis] <= high[axis]) {
            bounds.divide()?;
        }
        Ok(bounds)
    }

    /// Finds the groups.
    fn divide(&mut self) -> Result<()> {
        let mut left = (1usize << self.lattice.rank()) - 1;
        for k in 0..self.lattice.rank() {
            if left == 0 {
                break;
            }
            let mut group = Group { vectors: left & left.wrapping_neg(), axes: 0 };
            for _ in 0..3 {
                for (j, row) in self.rows.iter().enumerate().take(self.lattice.rank()) {
                    let along =
                        (0..G::D).filter(|&axis| row[axis] != 0).fold(0, |bits, axis| bits | 1 << axis);
                    if group.has_vector(j) || along & group.axes != 0 {
                        group.vectors |= 1 << j;
                        group.axes |= along;
                    }
                }
            }
            left &= !group.vectors;
            self.groups[k] = Some((group, self.search(group)?));
        }
        Ok(())
    }

    fn vectors_of(&self, group: Group) -> impl Iterator<Item = usize> + '_ {
        (0..self.lattice.rank()).filter(move |&j| group.has_vector(j))
    }

    /// How translations in a group are to be found.
    fn search(&self, group: Group) -> Result<TranslationSearch> {
        let axes = || (0..G::D).filter(|&axis| group.has_axis(axis));
        let is_bounded = |axis: &usize| self.low[*axis] > -FAR || self.high[*axis] < FAR;
        let width = |axis: usize| self.high[axis] - self.low[axis];
        let is_wide = |axis: usize| {
            width(axis) >= self.vectors_of(group).map(|j| self.rows[j][axis].abs()).sum::<i128>()
        };
        let (n_vectors, n_axes) = (group.vectors.count_ones(), group.axes.count_ones());
        if axes().filter(is_bounded).count() == 0 || n_vectors == n_axes && axes().all(is_wide) {
            return Ok(TranslationSearch::Always);
        }
        let mut bounded = axes().filter(is_bounded);
        if let (Some(axis), None) = (bounded.next(), bounded.next()) {
            let of_all = self.vectors_of(group).map(|j| self.rows[j][axis]).fold(0, divisor);
            return Ok(TranslationSearch::Multiples(axis, of_all));
        }
        let n_multiples = |j: usize| {
            let [from, to] = self.multiples(group, j, &[0; 3]);
            to - from + 1.0
        };
        let longest = |best: usize, j: usize| if n_multiples(j) > n_multiples(best) { j } else { best };
        let last = self.vectors_of(group).reduce(longest).expect("a group has a vector");
        let n_tried: f64 = self.vectors_of(group).filter(|&j| j != last).map(n_multiples).product();
        if n_tried <= MOST_TRIED {
            return Ok(TranslationSearch::Tried(last));
        }
        let index = axes().find(|&axis| !is_wide(axis)).or_else(|| axes().next()).unwrap_or(0);
        let wanted = "near low, or so far from it that the box is as wide as all vectors together along each of their axes";
        Err(Error::InvalidValue { argument: "high", index, value: self.corners[1][index], wanted })
    }

    /// Between which multiples of a vector a place, in units of the grid, is translated that comes to the box.
    fn multiples(&self, group: Group, j: usize, place: &[i128; 3]) -> [f64; 2] {
        let form = self.lattice.form(j);
        let (mut range, mut size) = ([0.0f64; 2], 0.0);
        for axis in (0..G::D).filter(|&axis| group.has_axis(axis)) {
            let ends = [self.low[axis] - place[axis], self.high[axis] - place[axis]]
                .map(|units| units as f64 * self.lattice.unit[axis] * form[axis]);
            range[0] += ends[0].min(ends[1]);
            range[1] += ends[0].max(ends[1]);
            size += ends[0].abs() + ends[1].abs();
        }
        let slack = SLACK * (1.0 + size);
        [(range[0] - slack).ceil(), (range[1] + slack).floor()]
    }

    /// Whether a translation of a place at home is in the box.
    fn has_image(&self, home: &G::Point) -> bool {
        let mut place = [0i128; 3];
        for axis in 0..G::D {
            if self.lattice.is_spanned(axis) {
                place[axis] = (home[axis] / self.lattice.unit[axis]) as i128;
            } else if !(self.corners[0][axis] <= home[axis] && home[axis] <= self.corners[1][axis]) {
                return false;
            }
        }
        self.groups.iter().flatten().all(|&(group, search)| match search {
            TranslationSearch::Always => true,
            TranslationSearch::Multiples(axis, step) => {
                let [from, to] = [self.low[axis] - place[axis], self.high[axis] - place[axis]];
                to.div_euclid(step) * step >= from
            }
            TranslationSearch::Tried(last) => self.is_found(group, last, 0, place),
        })
    }

    /// Whether a place comes to the box by multiples of the vectors of a group from one on.
    fn is_found(&self, group: Group, last: usize, from: usize, place: [i128; 3]) -> bool {
        let Some(j) = self.vectors_of(group).find(|&j| j >= from && j != last) else {
            return self.comes_along(group, last, &place);
        };
        let [least, most] = self.multiples(group, j, &place).map(|n| n as i128);
        (least..=most).any(|n| {
            let moved = [0, 1, 2].map(|axis| place[axis] + n * self.rows[j][axis]);
            self.is_found(group, last, j + 1, moved)
        })
    }

    /// Whether some multiple of a vector takes a place into the box along the axes of a group.
    fn comes_along(&self, group: Group, j: usize, place: &[i128; 3]) -> bool {
        let (mut least, mut most) = (-FAR, FAR);
        for axis in (0..G::D).filter(|&axis| group.has_axis(axis)) {
            let [from, to] = [self.low[axis] - place[axis], self.high[axis] - place[axis]];
            let step = self.rows[j][axis];
            let [from, to] = if step < 0 { [-to, -from] } else { [from, to] };
            if step == 0 {
                if from > 0 || to < 0 {
                    return false;
                }
                continue;
            }
            // The least multiple that is not below, and the greatest that is not above.
            least = least.max(-(-from).div_euclid(step.abs()));
            most = most.min(to.div_euclid(step.abs()));
        }
        least <= most
    }
}

/// The greatest common divisor.
fn divisor(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
