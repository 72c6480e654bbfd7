//! Voronoi cells of some vertices that no box cuts: areas or volumes, boundaries and centroids. With weights those are
//! sums of signed parts, as a vertex may be outside of its own cell.
//!
//! Measures are sums of pieces, as `dual` says, in a unit that the caller chooses. Where pieces do not suffice, as on the
//! hull, where an edge is too short for products in the unit, or numbers too large, a cell is put together from its
//! facets, each in a unit of its own (`whole_facets`).

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::geometry::centres::Numbering;
use crate::motion::reading::geometry::clipping::{Vector, dot, length_by, minus, without_unit};
use crate::motion::reading::geometry::dual::{Target, Targets};
use crate::motion::reading::geometry::dual_cells::{VoronoiCell, nowhere};
use crate::motion::reading::geometry::dual_facets::of_space;
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::whole_facets::FacetMeasures;
use crate::motion::reading::progress::Progress;

impl<G: Moving> Voronoi<'_, G> {
    /// Puts the cells of those of some vertices together from facets of which pieces do not tell all. Their sums are the
    /// numbers themselves, with the centroid for the moment.
    pub(super) fn by_facets(
        &mut self,
        vertices: &[VertexId],
        progress: &mut Progress,
        targets: &mut Targets<impl Numbering>,
    ) -> Result<()> {
        let t = self.t;
        let mut cut = Vec::new();
        for &v in vertices {
            let target = targets.of(t.mesh.site_of[v]);
            let sums = &target.sums;
            let parts = sums.moment.iter().chain([&sums.volume, &sums.facets]);
            target.is_cut |= !parts.fold(true, |all, x| all & x.is_finite());
            if target.is_cut {
                memory::push(&mut cut, v)?;
            }
        }
        if cut.is_empty() {
            return Ok(());
        }
        let around = t.cells_around(&cut)?;
        let mut neighbours = Neighbours::of(self.cells, t.id_count(), around.iter().copied())?;
        let (mut list, mut pyramids) = (Vec::new(), Vec::new());
        for v in cut {
            neighbours.list(v, VertexId::new(0), &mut list, |w, cell| (w, cell))?;
            let mut sums = Sums::default();
            pyramids.clear();
            for &(w, cell) in &list {
                let FacetMeasures { measure, centroid, .. } = self.facet_without_box([v, w], cell)?;
                progress.advance(self.ring.cells.len())?;
                if measure == f64::INFINITY {
                    // Whatever there is besides.
                    (sums.volume, sums.facets) = (measure, measure);
                    break;
                }
                let way = minus(&self.place(w), &self.place(v));
                let length = length_by(dot(&way, &way), &way);
                // Half of the least length is zero, and the foot on a facet without extent may be beyond the range of
                // numbers.
                let twice = if G::HAS_WEIGHTS && measure > 0.0 {
                    length + (t.weight(v) - t.weight(w)) / length
                } else {
                    length
                };
                let volume = 0.5 * twice * measure / G::D as f64;
                sums.volume += volume;
                sums.facets += measure;
                memory::push(&mut pyramids, (volume, centroid))?;
            }
            if G::HAS_WEIGHTS && !sums.volume.is_finite() {
                // Of signed parts that are beyond the range of numbers.
                sums.volume = f64::INFINITY;
            }
            sums.moment = mean_of::<G>(&pyramids, sums.volume);
            targets.of(t.mesh.site_of[v]).sums = sums;
        }
        Ok(())
    }
}

/// The centroid of pyramids of some volume in all, by the centroids of their bases as seen from the apex.
fn mean_of<G: Moving>(pyramids: &[(f64, Vector)], total: f64) -> Vector {
    let mut mean = [0.0; 3];
    for (volume, centroid) in pyramids.iter().filter(|(volume, _)| *volume != 0.0) {
        let share = volume / total * (G::D as f64 / (G::D + 1) as f64);
        (0..3).for_each(|axis| mean[axis] += share * centroid[axis]);
    }
    mean
}

/// What the sums of a vertex say.
pub(super) fn whole_cell<G: Moving>(unit: f64, target: &Target) -> VoronoiCell<G::Point> {
    let (sums, [of_volume, of_facets, of_moment]) = (&target.sums, target.factors::<G>());
    if target.is_cut {
        let centroid = if sums.volume > 0.0 && sums.volume < f64::INFINITY {
            of_space::<G>(&sums.moment)
        } else {
            nowhere::<G>()
        };
        return VoronoiCell { volume: sums.volume.max(0.0), area: sums.facets, centroid };
    }
    let volume = of_volume * sums.volume;
    let told = without_unit(unit, G::D, volume).max(0.0);
    let mut centroid = nowhere::<G>();
    if volume > 0.0 && told > 0.0 && told < f64::INFINITY {
        (0..G::D).for_each(|axis| centroid[axis] = of_moment * sums.moment[axis] / volume / unit);
    }
    VoronoiCell {
        volume: told,
        area: without_unit(unit, G::D - 1, of_facets * sums.facets).max(0.0),
        centroid,
    }
}
