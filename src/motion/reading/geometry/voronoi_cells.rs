//! What programs ask of Voronoi cells and facets: all or some of their measures, in a box and half-spaces or as a whole.
//!
//! While all vertices are in one hyperplane there are no cells, but in a box there still are Voronoi cells
//! ([`flat_cells`](super::flat_cells)).

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::clipping::Clip;
use crate::motion::reading::geometry::dual_cells::{VoronoiCell, nowhere};
use crate::motion::reading::geometry::dual_facets::{VoronoiFacet, of_space};
use crate::motion::reading::geometry::half_spaces::HalfSpaces;
use crate::motion::reading::geometry::incidence::{EdgeWithCell, Neighbours};
use crate::motion::reading::geometry::pass::VoronoiAsked;
use crate::motion::reading::progress::Progress;
use crate::motion::state::checking::check_position;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;

/// Who is told Voronoi cells, by the ids of their vertices; if nobody is, none are computed.
pub type TellCell<'a, P> = Option<&'a mut dyn FnMut(VertexId, VoronoiCell<P>)>;

/// Who is told Voronoi facets, by the numbers of their edges; if nobody is, none are computed.
pub type TellFacet<'a, P> = Option<&'a mut dyn FnMut(usize, VoronoiFacet<P>)>;

impl<G: Moving> MovingTriangulation<G> {
    /// Areas or volumes of the Voronoi cells of all ids, within the box from `low` to `high` if these are given: those of
    /// [`for_voronoi`](Self::for_voronoi).
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let (low, high) = ([0.0, 0.0], [1.0, 1.0]);
    /// let areas = t.voronoi_volumes(Some([&low, &high]))?;
    /// assert!(areas.iter().all(|area| (area - 0.25).abs() < 1e-6));
    /// assert!(t.voronoi_volumes(None)?.iter().all(|area| area.is_infinite())); // all are on the hull
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`] and [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_volumes(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        let mut volumes = Vec::new();
        memory::lengthen(&mut volumes, self.id_count(), f64::NAN)?;
        let tell = &mut |v: VertexId, cell: VoronoiCell<G::Point>| volumes[v.index()] = cell.volume;
        self.for_voronoi(clip, &[], None, &mut |_| true, Some(tell), None)?;
        Ok(volumes)
    }

    /// Lengths or areas of the Voronoi facets between the ends of all edges, in the order of [`edges`](Self::edges),
    /// within the box from `low` to `high` if these are given: those of [`for_voronoi`](Self::for_voronoi).
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`] and [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_facets(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        let mut measures = Vec::new();
        memory::lengthen(&mut measures, self.edge_count(), f64::NAN)?;
        let tell = &mut |edge: usize, facet: VoronoiFacet<G::Point>| measures[edge] = facet.area;
        self.for_voronoi(clip, &[], None, &mut |_| true, None, Some(tell))?;
        Ok(measures)
    }

    /// Tells Voronoi cells, facets, or both, of all ids and edges, or of ids of which `mask` has an entry that is not 0 and of
    /// edges that have such an end, when all are computed: cells by [`voronoi_cells_within`](Self::voronoi_cells_within), in
    /// ascending order, and facets by [`voronoi_derivatives_within`](Self::voronoi_derivatives_within), in any order, by
    /// their numbers in the order of [`edges`](Self::edges). The numbers are the same, to the last bit, whatever else is
    /// told.
    ///
    /// Without a box, `half_spaces` must be empty, and nothing is cut. Then cells of vertices on the convex hull, and facets of
    /// edges there, are infinite and have NaN for the rest; all cells are while there are none of the triangulation. Removed
    /// vertices have NaN, hidden ones 0.
    ///
    /// With weights cells are power cells: the places that have less power in respect of the vertex than of any other
    /// one. Those of vertices that weights hide are empty.
    ///
    /// Rounded: in a box as these say. Without one, let h be 10⁻⁸ times the greatest circumradius around the vertex, or
    /// the edge, with weights the greatest of the distances of power centres from corners there and of the roots of
    /// differences of weights, and 10⁻¹⁵ times the greatest magnitude of coordinates of the circumcentres; in place of
    /// 10⁻⁸ some last bits, unless there are cells that are nearly flat. With that h errors are those in a box. In a
    /// box no corner is left out and none is too many.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let places = [[0.0, 0.0], [2.0, 0.0], [-2.0, 0.0], [0.0, 2.0], [0.0, -2.0]];
    /// let t = MovingTriangulation::<Plane>::new(&places, Options::default())?;
    /// let (mut area, mut lengths) = (0.0, Vec::new());
    /// let cells = &mut |v: deldrift::VertexId, cell: deldrift::motion::VoronoiCell<_>| {
    ///     area += if v.index() == 0 { cell.volume } else { 0.0 };
    /// };
    /// let facets = &mut |_, facet: deldrift::motion::VoronoiFacet<_>| lengths.push(facet.area);
    /// t.for_voronoi(None, &[], None, &mut |_| true, Some(cells), Some(facets))?;
    /// assert_eq!(area, 4.0);
    /// assert_eq!(lengths.iter().filter(|&&length| length == 2.0).count(), 4);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`voronoi_cells_within`](Self::voronoi_cells_within), also [`Error::WrongCount`] for half-spaces
    /// without a box; then nothing has been told.
    pub fn for_voronoi(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell_cell: TellCell<'_, G::Point>,
        tell_facet: TellFacet<'_, G::Point>,
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        if self.mesh.kernel.is_constrained() {
            return self.voronoi_of_segments(clip, half_spaces, mask, monitor, tell_cell, tell_facet);
        }
        let region = self.region(clip, half_spaces)?;
        let progress = &mut Progress::new(monitor, 1);
        let (mut vertices, mut edges, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        if tell_facet.is_some() {
            (edges, numbers) = self.wanted_edges(mask, progress)?;
        }
        match mask {
            Some(mask) => vertices = self.shown_in(mask)?,
            None if tell_cell.is_some() => {
                memory::reserve_exact(&mut vertices, self.vertex_count())?;
                vertices.extend(self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id));
            }
            None => {}
        }
        let asked = VoronoiAsked {
            around: mask.map(|_| &vertices[..]),
            vertices: tell_cell.as_ref().map(|_| &vertices[..]),
            edges: tell_facet.as_ref().map(|_| &edges[..]),
        };
        let found = self.find_voronoi(region.as_ref(), self.extent(), &asked, progress)?;
        let placed = |v: VertexId, mut centroid: G::Point| {
            if region.is_none()
                && let Standing::Shown(s) = self.mesh.standing(v)
            {
                let place = self.mesh.kernel.place(s);
                (0..G::D).for_each(|axis| centroid[axis] += place[axis]);
            }
            centroid
        };
        if let Some(tell) = tell_cell {
            let is_wanted = |v: &VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
            for v in VertexId::range(0..self.id_count()).filter(is_wanted) {
                let cell = self.found_cell(&found, region.as_ref(), v);
                tell(v, VoronoiCell { centroid: placed(v, cell.centroid), ..cell });
            }
        }
        if let Some(tell) = tell_facet {
            for (k, (number, ([v, _], _))) in numbers.into_iter().zip(edges).enumerate() {
                let facet = found.facet::<G>(k);
                tell(number as usize, VoronoiFacet { centroid: placed(v, facet.centroid), ..facet });
            }
        }
        Ok(())
    }

    /// Tells the cells of a constrained triangulation, which are those without segments, and the facets of its own edges:
    /// there is none where the Voronoi cells of the ends do not meet.
    fn voronoi_of_segments(
        &self,
        clip: Option<[&G::Point; 2]>,
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell_cell: TellCell<'_, G::Point>,
        tell_facet: TellFacet<'_, G::Point>,
    ) -> Result<()> {
        let plain = self.without_segments()?;
        let Some(tell_facet) = tell_facet else {
            return plain.for_voronoi(clip, half_spaces, mask, monitor, tell_cell, None);
        };
        let nothing = |x| {
            let row = of_space::<G>(&[x; 3]);
            VoronoiFacet { area: x, centroid: nowhere::<G>(), derivatives: [row; 2], weight_derivative: 0.0 }
        };
        let (there, own) = (plain.edges()?, self.edges()?);
        let mut facets = Vec::new();
        memory::lengthen(&mut facets, there.len(), nothing(f64::NAN))?;
        let keep = &mut |edge: usize, facet| facets[edge] = facet;
        plain.for_voronoi(clip, half_spaces, mask, monitor, tell_cell, Some(keep))?;
        for (k, edge) in own.iter().enumerate() {
            if mask.is_none_or(|mask| edge.iter().any(|v| mask[v.index()] != 0)) {
                tell_facet(k, there.binary_search(edge).map_or(nothing(0.0), |at| facets[at]));
            }
        }
        Ok(())
    }

    /// The edges that have an end in a mask, if there is one, in the order of storage of the vertices, and their numbers in
    /// the order of [`edges`](Self::edges).
    fn wanted_edges(
        &self,
        mask: Option<&[u8]>,
        progress: &mut Progress,
    ) -> Result<(Vec<EdgeWithCell>, Vec<u32>)> {
        let (mut wanted, mut numbers, mut offsets) = (Vec::new(), Vec::new(), Vec::new());
        let room = if mask.is_none() { self.edge_count() } else { 0 };
        memory::reserve_exact(&mut wanted, room)?;
        memory::reserve_exact(&mut numbers, room)?;
        // How many edges have a vertex of lower id as their first one, by id; until then, how many each one begins.
        memory::lengthen(&mut offsets, self.id_count() + 1, 0)?;
        progress.expect_more(self.edge_count());
        let vertices = self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id);
        self.for_edges(vertices, |edge, first| {
            progress.advance(1)?;
            let n = &mut offsets[edge[0].index() + 1];
            *n += 1;
            if mask.is_some_and(|mask| edge.iter().all(|v| mask[v.index()] == 0)) {
                return Ok(());
            }
            memory::push(&mut numbers, *n - 1)?;
            memory::push(&mut wanted, (edge, first))
        })?;
        for k in 1..offsets.len() {
            offsets[k] += offsets[k - 1];
        }
        numbers.iter_mut().zip(&wanted).for_each(|(number, ([v, _], _))| *number += offsets[v.index()]);
        Ok((wanted, numbers))
    }

    /// The greatest extent of the vertices along an axis.
    fn extent(&self) -> f64 {
        let places = || self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.place(s));
        let along = |axis: usize| {
            let range = places().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
                [low.min(p[axis]), high.max(p[axis])]
            });
            range[1] - range[0]
        };
        (0..G::D).fold(0.0, |most, axis| most.max(along(axis)))
    }

    /// What cells are clipped by, if anything, and if it is good.
    pub(crate) fn region(&self, clip: Option<[&G::Point; 2]>, half_spaces: &[f64]) -> Result<Option<Region>> {
        let Some(clip) = clip else {
            let none =
                Error::WrongCount { argument: "half_spaces", given: half_spaces.len(), wanted: 0, coming: 0 };
            return if half_spaces.is_empty() { Ok(None) } else { Err(none) };
        };
        let clip = checked::<G>(clip)?;
        self.check_half_spaces(half_spaces)?;
        let half_spaces = HalfSpaces::new::<G>(half_spaces, &clip, self.cell_count())?;
        Ok(Some(Region { clip, half_spaces }))
    }

    /// Whether `high` is above `low` in every coordinate, and both are good.
    pub(crate) fn check_clip(&self, clip: [&G::Point; 2]) -> Result<()> {
        checked::<G>(clip).map(drop)
    }

    /// Visits the edges of each of these vertices to vertices of higher ids, with a cell of each; those of one vertex in the
    /// order of ids.
    #[inline(always)]
    pub(crate) fn for_edges(
        &self,
        vertices: impl Iterator<Item = VertexId>,
        mut visit: impl FnMut([VertexId; 2], CellId) -> Result<()>,
    ) -> Result<()> {
        let mut neighbours = Neighbours::new(self.cell_arrays()?, self.id_count())?;
        let mut list = Vec::new();
        for v in vertices {
            neighbours.list(v, v, &mut list, |w, cell| (w, cell))?;
            for &(w, cell) in &list {
                visit([v, w], cell)?;
            }
        }
        Ok(())
    }
}

/// A box that is one.
fn checked<G: Moving>([low, high]: [&G::Point; 2]) -> Result<Clip> {
    let (low, high) = (check_position::<G>("low", 0, low)?, check_position::<G>("high", 0, high)?);
    for axis in 0..G::D {
        if low[axis] >= high[axis] {
            let wanted = "above low";
            return Err(Error::InvalidValue { argument: "high", index: axis, value: high[axis], wanted });
        }
    }
    Ok(Clip::new::<G>(&low, &high))
}
