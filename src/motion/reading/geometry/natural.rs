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
//! With weights facets are those of power cells, and a place has one as well: all of this is true where a vertex of
//! that weight would be shown. Where it would be hidden, the corners of the cell that has the place are its neighbours,
//! as they are when its cell vanishes.
//!
//! Circumcentres that are far away, as for places near the hull, make the weights inaccurate. By what they do not
//! reproduce the place, the linear interpolation of the cell that holds it is added. Where a circumcentre is out of
//! reach, as for places on the hull, that is all.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, IndexSet, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Vector, cross, dot, in_space, minus};
use crate::motion::reading::geometry::linear::{Weights, barycentric, linear, list_linear};
use crate::predicates::Measures;

/// A ridge of a facet around the place, with the circumcentre of the cell that would join both.
#[derive(Clone, Copy, Debug)]
struct RidgeAround<K> {
    /// Its vertices, the lower key first; in the plane the only one twice.
    ends: [K; 2],
    /// Whether the facet, seen from outside, passes the ridge from the second to the first.
    is_reversed: bool,
    centre: Vector,
}

/// The ridges of the facets around a place, by keys that tell vertices apart.
#[derive(Debug)]
pub(crate) struct Ridges<K> {
    list: Vec<RidgeAround<K>>,
}

impl<K> Default for Ridges<K> {
    fn default() -> Self {
        Ridges { list: Vec::new() }
    }
}

impl<K: Copy + Ord> Ridges<K> {
    pub(crate) fn clear(&mut self) {
        self.list.clear();
    }

    /// Adds those of a facet around a place: as many vertices as there are dimensions, all facets seen from one side.
    pub(crate) fn add_facet<G: Moving>(&mut self, facet: [(K, &G::Point); 3], q: &G::Point) -> Result<()> {
        let mut points = [q; 4];
        (0..G::D).for_each(|i| points[i] = facet[i].1);
        let (centre, _) = G::Point::circumsphere(&points[..=G::D]);
        let centre = in_space::<G>(&centre);
        for i in 0..G::D {
            let from = facet[i].0;
            let to = if G::D == 2 { from } else { facet[(i + 1) % 3].0 };
            // In the plane a facet comes to its second vertex, and leaves its first.
            let is_reversed = if G::D == 2 { i == 1 } else { to < from };
            let ends = if to < from { [to, from] } else { [from, to] };
            memory::push(&mut self.list, RidgeAround { ends, is_reversed, centre })?;
        }
        Ok(())
    }

    /// The weights of the natural neighbours of a place, around which all facets have been added, in a cell with these corners.
    pub(crate) fn weights<G: Moving>(
        &mut self,
        cell: &[(K, &G::Point)],
        q: &G::Point,
        place: impl Fn(K) -> G::Point,
        weights: &mut Vec<(K, f64)>,
    ) -> Result<()> {
        weights.clear();
        self.weigh::<G>(q, &place, weights)?;
        let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
        let mut points = [q; 4];
        points.iter_mut().zip(cell).for_each(|(point, corner)| *point = corner.1);
        if !(sum.is_finite() && sum > 0.0) {
            weights.clear();
            let of_corners = linear::<G>(&points[..=G::D], q);
            return memory::collect(weights, cell.iter().map(|&(key, _)| key).zip(of_corners));
        }
        weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
        // What makes them reproduce the place.
        let mut reproduced = *q;
        for axis in 0..G::D {
            let off = weights.iter().map(|&(key, weight)| weight * (place(key)[axis] - q[axis]));
            reproduced[axis] += off.sum::<f64>();
        }
        let points = &points[..=G::D];
        let both = barycentric::<G>(points, q).zip(barycentric::<G>(points, &reproduced));
        let Some((wanted, given)) = both else { return Ok(()) };
        for (i, &(key, _)) in cell.iter().enumerate() {
            memory::push(weights, (key, wanted[i] - given[i]))?;
        }
        Ok(())
    }

    /// Lists the natural neighbours with the measures of Voronoi facets over distances.
    fn weigh<G: Moving>(
        &mut self,
        q: &G::Point,
        place: impl Fn(K) -> G::Point,
        weights: &mut Vec<(K, f64)>,
    ) -> Result<()> {
        self.list.sort_unstable_by_key(|ridge| (ridge.ends, ridge.is_reversed));
        let at = in_space::<G>(q);
        for pair in self.list.chunks_exact(2) {
            let [forth, back] = [&pair[0], &pair[1]];
            debug_assert!(forth.ends == back.ends && !forth.is_reversed && back.is_reversed);
            if G::D == 2 {
                let place = in_space::<G>(&place(forth.ends[0]));
                let (along, to) = (minus(&back.centre, &forth.centre), minus(&place, &at));
                let weight = (dot(&along, &along) / dot(&to, &to)).sqrt();
                memory::push(weights, (forth.ends[0], weight))?;
                continue;
            }
            for (key, [left, right]) in forth.ends.into_iter().zip([[forth, back], [back, forth]]) {
                let place = in_space::<G>(&place(key));
                let (left, right) = (minus(&left.centre, &place), minus(&right.centre, &place));
                let to = minus(&place, &at);
                // Twice the area, signed, times the distance, over its square.
                memory::push(weights, (key, dot(&cross(&left, &right), &to) / dot(&to, &to)))?;
            }
        }
        weights.sort_unstable_by_key(|&(key, _)| key);
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

/// Lists of one place after the other.
#[derive(Debug, Default)]
pub(super) struct Natural {
    zone: IndexSet<Slot>,
    ridges: Ridges<SiteId>,
}

impl Natural {
    /// The weights at a place in a cell, at no site.
    pub(super) fn list<G: Moving>(
        &mut self,
        kernel: &Delaunay<G>,
        cell: Slot,
        q: &G::Point,
        weights: &mut Weights,
    ) -> Result<()> {
        // With weights the place may be that of a vertex which would be hidden: in the limit its natural neighbours are
        // the corners.
        if G::HAS_WEIGHTS && !kernel.is_in_conflict(cell, q, VertexId::NONE) {
            return list_linear(kernel, cell, q, weights);
        }
        self.list_ridges(kernel, cell, q)?;
        let corners = kernel.complex().cell(cell).corners;
        let mut with_places = [(corners[0], q); 4];
        for (entry, &s) in with_places.iter_mut().zip(corners.as_ref()) {
            *entry = (s, kernel.place(s));
        }
        self.ridges.weights::<G>(&with_places[..=G::D], q, |s| *kernel.place(s), weights)
    }

    /// Lists the ridges of the facets around the cells whose sphere holds a place.
    fn list_ridges<G: Moving>(&mut self, kernel: &Delaunay<G>, cell: Slot, q: &G::Point) -> Result<()> {
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
                    continue;
                }
                let turned = corners.rotated_to_last(i);
                let facet = [0, 1, G::D - 1].map(|k| (turned[k], kernel.place(turned[k])));
                self.ridges.add_facet::<G>(facet, q)?;
            }
        }
        Ok(())
    }
}
