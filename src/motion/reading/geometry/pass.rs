//! One pass over Voronoi cells and facets, of all vertices or some, whatever cuts them. With weights they are power
//! cells, and those of vertices that weights hide are empty.
//!
//! Circumcentres are computed and compared with the box and the half-spaces once, whatever is asked for. Cells are then sums of
//! pieces of these ([`dual`](super::dual)), and facets are polygons of them ([`dual_facets`](super::dual_facets)); what is cut, or
//! too short or too large for products, is put together by itself. Cells are not made of facets, though these have all that
//! cells add up: so the numbers of a cell are the same to the last bit, whatever else is asked for.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::{All, Centres, Numbering, Ranks};
use crate::motion::reading::geometry::clipping::unit_of;
use crate::motion::reading::geometry::dual::{Target, Targets};
use crate::motion::reading::geometry::dual_cells::{VoronoiCell, cell_of, nowhere};
use crate::motion::reading::geometry::dual_facets::{VoronoiFacet, of_space};
use crate::motion::reading::geometry::incidence::EdgeWithCell;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::whole_cells::whole_cell;
use crate::motion::reading::geometry::whole_facets::FacetMeasures;
use crate::motion::reading::progress::Progress;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;

/// Which Voronoi cells and facets are asked for.
pub(crate) struct VoronoiAsked<'a> {
    /// Vertices that have all cells at those below; none if all cells may be looked at.
    pub(crate) around: Option<&'a [VertexId]>,
    /// The vertices whose cells are asked for, if any are. All of them are in cells, unless there are none.
    pub(crate) vertices: Option<&'a [VertexId]>,
    /// The edges whose facets are asked for, if any are.
    pub(crate) edges: Option<&'a [EdgeWithCell]>,
}

/// What has been computed.
pub(crate) struct VoronoiFound {
    /// By what lengths are multiplied in sums.
    unit: f64,
    targets: Vec<Target>,
    /// The numbers of sites, if they are not their own.
    sites: Option<Ranks>,
    facets: Vec<FacetMeasures>,
}

impl VoronoiFound {
    fn target(&self, s: SiteId) -> &Target {
        let number = self.sites.as_ref().map_or(Some(s.index()), |ranks| ranks.number(s.index()));
        &self.targets[number.expect("a site of the pass")]
    }

    /// The facet of an edge, by its number among those that were asked for. Without a box its centroid is as seen from the
    /// edge's first vertex.
    pub(crate) fn facet<G: Moving>(&self, number: usize) -> VoronoiFacet<G::Point> {
        let FacetMeasures { measure, centroid, derivatives, weight_derivative } = &self.facets[number];
        VoronoiFacet {
            area: *measure,
            centroid: of_space::<G>(centroid),
            derivatives: derivatives.each_ref().map(of_space::<G>),
            weight_derivative: if G::HAS_WEIGHTS { *weight_derivative } else { 0.0 },
        }
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// Computes Voronoi cells and facets in a region, or without one. Then `size` is about the size of cells, or some thousand
    /// times as much. The triangulation has no segments.
    ///
    /// # Errors
    /// [`Cancelled`](crate::Error::Cancelled), [`OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn find_voronoi(
        &self,
        region: Option<&Region>,
        size: f64,
        asked: &VoronoiAsked<'_>,
        progress: &mut Progress,
    ) -> Result<VoronoiFound> {
        let unit = region.map_or_else(|| unit_of(size), |region| region.clip.unit);
        let mut found = VoronoiFound { unit, targets: Vec::new(), sites: None, facets: Vec::new() };
        if self.cell_count() == 0 {
            if asked.vertices.is_some() {
                found.targets = self.targets_without_cells(region, progress)?;
            }
            return Ok(found);
        }
        let (cells, n_sites) = (self.cell_arrays()?, self.mesh.kernel.sites().len());
        let chosen = asked.around.map(|vertices| self.cells_around(vertices)).transpose()?;
        let mut centres = Centres::new(self, cells, region.map(|region| &region.clip), chosen.as_deref())?;
        if let Some(region) = region {
            region.mark(self, &mut centres);
        }
        let of_cells = if asked.vertices.is_some() { 2 * centres.list.len() } else { 0 };
        progress.expect_more(of_cells + asked.edges.map_or(0, <[EdgeWithCell]>::len));
        if let Some(vertices) = asked.vertices {
            let mut voronoi = Voronoi::new(self, cells, &centres);
            match &centres.chosen {
                None => {
                    let targets = Targets::new(All, n_sites)?;
                    found.targets = voronoi.fill(region, unit, All, vertices, targets, progress)?;
                }
                Some((_, ranks)) => {
                    let sites = Ranks::of(n_sites, vertices.iter().map(|&v| self.mesh.site_of[v].index()))?;
                    let targets = Targets::new(&sites, vertices.len())?;
                    found.targets = voronoi.fill(region, unit, ranks, vertices, targets, progress)?;
                    found.sites = Some(sites);
                }
            }
        }
        if let Some(edges) = asked.edges {
            found.facets = self.facets_of(edges, region, &centres, progress)?;
        }
        Ok(found)
    }

    /// Sums for vertices in one hyperplane, whose cells have no end where nothing cuts them.
    fn targets_without_cells(&self, region: Option<&Region>, progress: &mut Progress) -> Result<Vec<Target>> {
        let Some(region) = region else {
            let mut targets = Vec::new();
            memory::lengthen(&mut targets, self.mesh.kernel.sites().len(), Target::ENDLESS)?;
            for s in self.mesh.kernel.hidden_without_cells()? {
                targets[s.index()] = Target::default();
            }
            return Ok(targets);
        };
        let mut targets = Targets::new(All, self.mesh.kernel.sites().len())?;
        targets.list.iter_mut().for_each(|target| target.is_cut = true);
        self.flat_cells(region, progress, |v, part: &Sums| {
            targets.of(self.mesh.site_of[v]).sums.join(part);
        })?;
        Ok(targets.list)
    }

    /// The cell of a vertex that is asked for, or is hidden or removed. Without a region its centroid is as seen from the vertex.
    pub(crate) fn found_cell(
        &self,
        found: &VoronoiFound,
        region: Option<&Region>,
        v: VertexId,
    ) -> VoronoiCell<G::Point> {
        let none = |x| VoronoiCell { volume: x, area: x, centroid: nowhere::<G>() };
        match (self.mesh.standing(v), region) {
            (Standing::Gone, _) => none(f64::NAN),
            (Standing::Hidden(_) | Standing::Above(_), _) => none(0.0),
            (Standing::Shown(s), None) => whole_cell::<G>(found.unit, found.target(s)),
            (Standing::Shown(s), Some(region)) => {
                cell_of::<G>(&region.clip, self.mesh.kernel.place(s), found.target(s))
            }
        }
    }
}

impl<G: Moving> Voronoi<'_, G> {
    /// Sums for some vertices, which have targets, by the centres of all cells around these, which are numbered.
    fn fill<S: Numbering>(
        &mut self,
        region: Option<&Region>,
        unit: f64,
        cells: impl Numbering,
        vertices: &[VertexId],
        mut targets: Targets<S>,
        progress: &mut Progress,
    ) -> Result<Vec<Target>> {
        self.add_all(unit, cells, progress, &mut targets)?;
        match region {
            Some(region) => self.cut_all(region, vertices, progress, &mut targets)?,
            None => self.by_facets(vertices, progress, &mut targets)?,
        }
        Ok(targets.list)
    }
}
