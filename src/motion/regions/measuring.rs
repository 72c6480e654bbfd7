//! Tolerances and delimiters of bi-cells, and what vertices get of them.

use super::{Filter, Regions};
use crate::complex::Facet;
use crate::delaunay::{Delaunay, Dimension};
use crate::motion::bicell::BiCell;
use crate::predicates::{LANES, Tolerances, squared_distance};

/// The fourth power of the tolerance below which a bi-cell is watched, in units of the squares of its vertices' steps
/// and of its size. Found by measurement (Lloyd's iterations); half and double are hardly slower.
const fn watched_share<G: Dimension>() -> f64 {
    if G::D == 2 { 1.0 } else { 0.1 }
}

/// Bi-cells whose tolerances are to be computed together.
#[derive(Debug, Default)]
pub(super) struct Batch<G: Dimension> {
    bicells: <G::Point as Tolerances>::BiCells,
    facets: [[u32; 2]; LANES],
    vertices: [[u32; 5]; LANES],
    pub(super) n: usize,
}

impl<G: Dimension> Batch<G> {
    #[inline(always)]
    fn push(&mut self, facets: [Facet; 2], vertices: [u32; 5], points: &[&G::Point]) {
        G::Point::set_bicell(&mut self.bicells, self.n, points);
        self.facets[self.n] = facets.map(Facet::code);
        self.vertices[self.n] = vertices;
        self.n += 1;
    }
}

impl<G: Dimension> Regions<G> {
    /// Computes a bi-cell: lets it lower the tolerances of its vertices, and keeps its delimiter. `ANEW`
    /// unless all sites are fixed where they are.
    #[inline(always)]
    pub(super) fn measure<const ANEW: bool>(
        &mut self,
        kernel: &Delaunay<G>,
        filter: Filter,
        facet: Facet,
        elsewhere: &[G::Point],
        batch: &mut Batch<G>,
    ) {
        let bicell = BiCell::of(kernel, facet);
        if ANEW {
            for &s in bicell.sites() {
                self.fix_anew(kernel.site(s), filter);
            }
        }
        let vertices = bicell.vertices(kernel);
        let finite = &vertices[..bicell.sites().len()];
        if !filter.keeps_delimiters() {
            let across = kernel.complex().cell(facet.cell()).neighbour(facet.index());
            match bicell.interior() {
                Some(points) => {
                    batch.push([facet, across], vertices, points);
                    if batch.n == LANES {
                        self.lower_batch(filter, elsewhere, batch);
                    }
                }
                None => {
                    let tolerance = bicell.hull_tolerance();
                    self.lower_or_watch(filter, [facet, across], finite, tolerance, elsewhere);
                }
            }
            return;
        }
        let (tolerance, reach) = match bicell.delimiter() {
            Some(delimiter) => {
                let across = kernel.complex().cell(facet.cell()).neighbour(facet.index());
                self.delimiters[facet.code().min(across.code()) as usize] =
                    (delimiter.centre, delimiter.radius);
                (delimiter.tolerance, delimiter.reach)
            }
            None => {
                let width = bicell.hull_tolerance();
                (width, width)
            }
        };
        self.lower(finite, tolerance);
        for &v in finite {
            let least = &mut self.reach[v as usize];
            *least = least.min(reach);
        }
    }

    #[inline(always)]
    fn lower(&mut self, vertices: &[u32], tolerance: f64) {
        for &v in vertices {
            let fixed = &mut self.fixed[v as usize];
            fixed.tolerance = fixed.tolerance.min(tolerance);
        }
    }

    /// Computes the tolerances of a batch, which is empty then.
    pub(super) fn lower_batch(&mut self, filter: Filter, elsewhere: &[G::Point], batch: &mut Batch<G>) {
        let mut enough = [0.0; LANES];
        for (enough, vertices) in enough.iter_mut().zip(&batch.vertices[..batch.n]) {
            for &v in &vertices[..G::D + 2] {
                *enough = self.fixed[v as usize].tolerance.max(*enough);
            }
        }
        let tolerances = G::Point::tolerances(&batch.bicells, enough);
        for (k, tolerance) in tolerances.into_iter().enumerate().take(batch.n) {
            let facets = batch.facets[k].map(Facet::from_code);
            self.lower_or_watch(filter, facets, &batch.vertices[k][..G::D + 2], tolerance, elsewhere);
        }
        batch.n = 0;
    }

    /// Lets a bi-cell, given by its facet from both sides and its vertices, lower tolerances unless it is watched
    /// instead.
    #[inline(always)]
    fn lower_or_watch(
        &mut self,
        filter: Filter,
        [facet, across]: [Facet; 2],
        vertices: &[u32],
        tolerance: f64,
        elsewhere: &[G::Point],
    ) {
        if filter == Filter::Watch {
            let is_member = self.is_soon_beyond(vertices, tolerance, elsewhere);
            if self.watched.set(facet, across, is_member) {
                return;
            }
        }
        self.lower(vertices, tolerance);
    }

    /// Whether a bi-cell's tolerance is so small, next to its size h and the displacement u of its vertices from one
    /// timestamp to the next, that watching it is cheaper than recomputing stars now and then. Watching those
    /// below θ costs in proportion to θ / h, what is recomputed in proportion to u / θ; so the best θ² is in
    /// proportion to u h.
    fn is_soon_beyond(&self, vertices: &[u32], tolerance: f64, elsewhere: &[G::Point]) -> bool {
        let here = |v: u32| &self.fixed[v as usize].point;
        let step = |&v: &u32| elsewhere.get(v as usize).map_or(0.0, |p| squared_distance(here(v), p));
        let steps = vertices.iter().map(step).fold(0.0, f64::max);
        let square = squared_distance(here(vertices[1]), here(vertices[2]));
        let t = tolerance * tolerance;
        t * t <= watched_share::<G>() * steps * square
    }
}
