//! Sites in order of distance, by cells: for triangulations that are not Delaunay, where a vertex may have no neighbour
//! that is nearer to a place. Those are constrained ones, and those with weights, where some vertices are corners of no
//! cell but above the one that has their place.
//!
//! The cells that meet a ball are connected by facets, as what it shares with the hull is convex. They are looked at in
//! order of the distance of their bounding boxes, which is rounded downwards, until that is beyond what is wanted.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::motion::triangulation::MovingTriangulation;

/// By how much a rounded square of a distance may be too large: three squares of differences, with some last bits each.
const MARGIN: f64 = 1e-14;

/// A cell that waits, of which nothing is nearer than the square root of this.
struct WaitingCell {
    least: f64,
    cell: Slot,
}

impl Ord for WaitingCell {
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least).then(other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for WaitingCell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for WaitingCell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for WaitingCell {}

impl<G: Moving> MovingTriangulation<G> {
    /// Tells sites until all have been told that are as near to a place as `told` says: it returns a square of a distance
    /// beyond which nothing is wanted any more. `near` is where to begin to look for the place; returns a slot near it.
    pub(super) fn for_sites_by_cells(
        &self,
        q: &G::Point,
        near: Slot,
        mut told: impl FnMut(SiteId) -> Result<f64>,
    ) -> Result<Slot> {
        let kernel = &self.mesh.kernel;
        let start = self.slot_at(kernel.locate(q, near));
        let cell = kernel.complex().cell(start);
        let first = if cell.is_ghost() { cell.neighbour(G::D).cell() } else { start };
        let (mut seen, mut sites, mut waiting) = (IndexSet::new(), IndexSet::new(), BinaryHeap::new());
        let mut most = f64::INFINITY;
        seen.insert(first)?;
        memory::enter(&mut waiting, WaitingCell { least: 0.0, cell: first })?;
        while let Some(next) = waiting.pop().filter(|next| next.least <= most) {
            let cell = kernel.complex().cell(next.cell);
            for &s in cell.corners.as_ref() {
                if sites.insert(s)? {
                    most = told(s)?;
                }
            }
            if G::HAS_WEIGHTS {
                for s in kernel.sites_above(next.cell) {
                    most = told(s)?;
                }
            }
            for i in 0..=G::D {
                let across = cell.neighbour(i).cell();
                if !kernel.complex().cell(across).is_ghost() && seen.insert(across)? {
                    let least = self.square_to_box(q, across);
                    memory::enter(&mut waiting, WaitingCell { least, cell: across })?;
                }
            }
        }
        Ok(start)
    }

    /// The square of the distance from a place to the bounding box of a finite cell, rounded downwards.
    fn square_to_box(&self, q: &G::Point, cell: Slot) -> f64 {
        let places = self.mesh.kernel.places(cell);
        let mut square = 0.0;
        for axis in 0..G::D {
            let along = || places[..=G::D].iter().map(|p| p[axis]);
            let (low, high) =
                along().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            let beyond = (low - q[axis]).max(q[axis] - high).max(0.0);
            square += beyond * beyond;
        }
        square * (1.0 - MARGIN)
    }
}
