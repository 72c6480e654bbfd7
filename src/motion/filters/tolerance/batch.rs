//! Bi-cells whose tolerances are computed together.

use crate::complex::Facet;
use crate::delaunay::Moving;
use crate::ids::VertexId;
use crate::predicates::{BiCellTolerances, LANES};

/// A few bi-cells.
#[derive(Debug)]
pub(super) struct Batch<G: Moving> {
    bicells: <G::Point as BiCellTolerances>::BiCells,
    facets: [[Facet; 2]; LANES],
    vertices: [[VertexId; 5]; LANES],
    n: usize,
}

impl<G: Moving> Default for Batch<G> {
    fn default() -> Self {
        Batch {
            bicells: Default::default(),
            facets: [[Facet::NONE; 2]; LANES],
            vertices: [[VertexId::NONE; 5]; LANES],
            n: 0,
        }
    }
}

impl<G: Moving> Batch<G> {
    /// Adds a bi-cell: its facet from both sides, its vertices, and their places.
    #[inline(always)]
    pub(super) fn push(
        &mut self,
        facets: [Facet; 2],
        vertices: impl Iterator<Item = VertexId>,
        points: &[&G::Point],
    ) {
        G::Point::set_bicell(&mut self.bicells, self.n, points);
        self.facets[self.n] = facets;
        // One by one: an array of them would be read as a whole right after it was written in parts, which waits.
        std::iter::zip(&mut self.vertices[self.n], vertices).for_each(|(to, v)| *to = v);
        self.n += 1;
    }

    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.n == LANES
    }

    /// The vertices of each bi-cell.
    #[inline(always)]
    pub(super) fn vertices(&self) -> impl Iterator<Item = &[VertexId]> {
        self.vertices[..self.n].iter().map(|vertices| &vertices[..G::D + 2])
    }

    /// Computes the tolerances, which need not be sharp if they are `enough`, and hands each on with the facet and the
    /// vertices. The batch is empty then.
    #[inline(always)]
    pub(super) fn empty(
        &mut self,
        enough: &[f64; LANES],
        mut hand_on: impl FnMut([Facet; 2], &[VertexId], f64),
    ) {
        let tolerances = G::Point::tolerances(&self.bicells, *enough, 1.0);
        for (k, tolerance) in tolerances.into_iter().enumerate().take(self.n) {
            hand_on(self.facets[k], &self.vertices[k][..G::D + 2], tolerance);
        }
        self.n = 0;
    }
}
