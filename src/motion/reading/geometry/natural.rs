//! Interpolation by natural neighbours, with the weights of Laplace's (non-Sibsonian) interpolant.
//!
//! The natural neighbours of a place are the vertices that would share an edge with it if it were a vertex. The weight
//! of each is the measure of the Voronoi facet between the two over their distance, normed (Christ, Friedberg and Lee
//! 1982; Belikov et al. 1997; see Sukumar et al. 2001, 10.1002/1097-0207(20010110)50:1<1::AID-NME14>3.0.CO;2-P). These
//! facets enclose a convex polytope, the outward areas of which add up to nothing: so linear functions are reproduced,
//! as with Sibson's weights, which are ratios of volumes and would take more.
//!
//! The cells whose sphere holds the place are found from the one that holds it, by exact signs. A new cell would join
//! the place and each facet around them; the Voronoi facet to a natural neighbour is between the circumcentres of those
//! at it. In space these are never put in a row: their area is a sum over ridges, each of which two facets share, once
//! in each direction.
//!
//! Circumcentres that are far away, as for places near the hull, make the weights inaccurate. By what they do not
//! reproduce the place, the linear interpolation of the cell that holds it is added. Where a circumcentre is out of
//! reach, as for places on the hull, that is all.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, Dimension, IndexSet};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Vector, cross, dot, in_space, minus};
use crate::motion::reading::geometry::linear::{Weights, barycentric, list_linear};
use crate::predicates::Measures;

/// A ridge of a facet around the place, with the circumcentre of the cell that would join both.
#[derive(Clone, Copy, Debug)]
struct Ridge {
    /// Its vertices, the lower index first; in the plane one and the ghost vertex.
    ends: [SiteId; 2],
    /// Whether the facet, seen from outside, passes the ridge from the second to the first.
    is_reversed: bool,
    centre: Vector,
}

/// Lists of one place after the other.
#[derive(Debug, Default)]
pub(super) struct Natural {
    zone: IndexSet<Slot>,
    ridges: Vec<Ridge>,
}

impl Natural {
    /// The weights at a place in a cell, at no site.
    pub(super) fn list<G: Dimension>(
        &mut self,
        kernel: &Delaunay<G>,
        cell: Slot,
        q: &G::Point,
        weights: &mut Weights,
    ) -> Result<()> {
        self.list_ridges(kernel, cell, q)?;
        self.weigh(kernel, q, weights)?;
        let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
        if !(sum.is_finite() && sum > 0.0) {
            weights.clear();
            return list_linear(kernel, cell, q, weights);
        }
        weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
        correct(kernel, cell, q, weights)
    }

    /// Lists the ridges of the facets around the cells whose sphere holds a place.
    fn list_ridges<G: Dimension>(&mut self, kernel: &Delaunay<G>, cell: Slot, q: &G::Point) -> Result<()> {
        self.zone.clear();
        self.ridges.clear();
        self.zone.insert(cell)?;
        let mut next = 0;
        while let Some(&inside) = self.zone.as_slice().get(next) {
            next += 1;
            let corners = kernel.complex().cell(inside).corners;
            for i in 0..G::Corners::N {
                let across = kernel.complex().cell(inside).neighbour(i).cell();
                let is_hull = kernel.complex().cell(across).is_ghost() || kernel.is_facet_required(inside, i);
                // Ties are broken as for a vertex of the highest id.
                if !is_hull && kernel.is_in_conflict(across, q, VertexId::NONE) {
                    self.zone.insert(across)?;
                } else {
                    self.list_facet(kernel, corners.rotated_to_last(i), q)?;
                }
            }
        }
        Ok(())
    }

    /// Lists the ridges of the facet of all corners but the last.
    fn list_facet<G: Dimension>(
        &mut self,
        kernel: &Delaunay<G>,
        corners: G::Corners,
        q: &G::Point,
    ) -> Result<()> {
        let mut points = [q; 4];
        (0..G::D).for_each(|i| points[i] = kernel.place(corners[i]));
        let (centre, _) = G::Point::circumsphere(&points[..=G::D]);
        let centre = in_space::<G>(&centre);
        for i in 0..G::D {
            let (from, to) = (corners[i], if G::D == 2 { SiteId::new(0) } else { corners[(i + 1) % 3] });
            // In the plane a facet comes to its second vertex, and leaves its first.
            let is_reversed = if G::D == 2 { i == 1 } else { to < from };
            let ends = if to < from && G::D == 3 { [to, from] } else { [from, to] };
            memory::push(&mut self.ridges, Ridge { ends, is_reversed, centre })?;
        }
        Ok(())
    }

    /// Lists the natural neighbours with the measures of Voronoi facets over distances.
    fn weigh<G: Dimension>(
        &mut self,
        kernel: &Delaunay<G>,
        q: &G::Point,
        weights: &mut Weights,
    ) -> Result<()> {
        self.ridges.sort_unstable_by_key(|ridge| (ridge.ends, ridge.is_reversed));
        let at = in_space::<G>(q);
        for pair in self.ridges.chunks_exact(2) {
            let [forth, back] = [&pair[0], &pair[1]];
            debug_assert!(forth.ends == back.ends && !forth.is_reversed && back.is_reversed);
            if G::D == 2 {
                let place = in_space::<G>(kernel.place(forth.ends[0]));
                let (along, to) = (minus(&back.centre, &forth.centre), minus(&place, &at));
                let weight = (dot(&along, &along) / dot(&to, &to)).sqrt();
                memory::push(weights, (forth.ends[0], weight))?;
                continue;
            }
            for (s, [left, right]) in forth.ends.into_iter().zip([[forth, back], [back, forth]]) {
                let place = in_space::<G>(kernel.place(s));
                let (left, right) = (minus(&left.centre, &place), minus(&right.centre, &place));
                let to = minus(&place, &at);
                // Twice the area, signed, times the distance, over its square.
                memory::push(weights, (s, dot(&cross(&left, &right), &to) / dot(&to, &to)))?;
            }
        }
        weights.sort_unstable_by_key(|&(s, _)| s);
        weights.dedup_by(|next, kept| {
            let is_same = next.0 == kept.0;
            kept.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
        // All have the same sign but for rounding.
        weights.iter_mut().for_each(|(_, weight)| *weight = weight.abs());
        Ok(())
    }
}

/// Adds to weights what makes them reproduce a place in a cell.
fn correct<G: Dimension>(
    kernel: &Delaunay<G>,
    cell: Slot,
    q: &G::Point,
    weights: &mut Weights,
) -> Result<()> {
    let mut reproduced = *q;
    for axis in 0..G::D {
        let off = weights.iter().map(|&(s, weight)| weight * (kernel.place(s)[axis] - q[axis]));
        reproduced[axis] += off.sum::<f64>();
    }
    let points = &kernel.places(cell)[..G::D + 1];
    let both = barycentric::<G>(points, q).zip(barycentric::<G>(points, &reproduced));
    let Some((wanted, given)) = both else { return Ok(()) };
    let corners = kernel.complex().cell(cell).corners;
    for (i, &s) in corners.as_ref().iter().enumerate() {
        memory::push(weights, (s, wanted[i] - given[i]))?;
    }
    Ok(())
}
