//! What programs ask of Voronoi cells: areas or volumes, and measures of facets, in a box or as a whole.
//!
//! While all vertices are in one hyperplane there are no cells, but in a box there still are Voronoi cells
//! ([`flat_cells`](super::flat_cells)).

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::Centres;
use crate::motion::reading::geometry::clipping::Clip;
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::progress::Progress;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::geometry::voronoi::{Part, Voronoi, pyramid};
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes of the Voronoi cells of all ids, within the box from `low` to `high` if these are given.
    /// Without a box that of a vertex of the convex hull is infinite, and so are all while there are no cells. NaN for
    /// removed vertices, 0 for hidden ones.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates; without a box, 10⁻⁸ times the greatest circumradius around the vertex and 10⁻¹⁵ times the greatest
    /// magnitude of coordinates of the circumcentres. A corner of a cell is off by at most h, and so, to first order, an
    /// area by h times the length of the boundary, and a volume by h times the area of the surface or two thirds of that
    /// of the triangles that the vertex makes with the edges of its cell, whichever is more; by a few last bits in place
    /// of 10⁻⁸, unless there are cells that are nearly flat. In the box, no corner is left out and none is too many.
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
        self.voronoi_volumes_monitored(clip, &mut |_| true)
    }

    /// The [`voronoi_volumes`](Self::voronoi_volumes), with a call of `monitor` now and then, which is told the
    /// fraction done.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if `monitor` returns `false`; [`Error::NotFinite`], [`Error::OutOfRange`] and
    /// [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_volumes_monitored(
        &self,
        clip: Option<[&G::Point; 2]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        if self.mesh.kernel.is_constrained() {
            return self.without_segments()?.voronoi_volumes_monitored(clip, monitor);
        }
        let clip = clip.map(checked::<G>).transpose()?;
        let mut volumes = Vec::new();
        memory::reserve_exact(&mut volumes, self.id_count())?;
        volumes.extend(self.mesh.sites_of_ids().map(|(_, s)| if s.is_some() { 0.0 } else { f64::NAN }));
        let progress = &mut Progress::new(monitor, self.expected_work(clip.is_some()));
        match clip {
            None if self.cell_count() == 0 => {
                self.mesh
                    .kernel
                    .live_sites()
                    .for_each(|s| volumes[self.mesh.kernel.site(s).id.index()] = f64::INFINITY);
            }
            None => self.whole_volumes(&mut volumes, progress)?,
            Some(clip) if self.cell_count() == 0 => {
                self.flat_cells(&Region::of(clip), progress, |v, sums| {
                    volumes[v.index()] += clip.measure_in(G::D, sums.volume);
                })?;
                // Parts may be negative, and what is left of them by rounding.
                volumes.iter_mut().for_each(|volume| *volume = if *volume < 0.0 { 0.0 } else { *volume });
            }
            Some(clip) => self.volumes_in(&clip, &mut volumes, progress)?,
        }
        Ok(volumes)
    }

    /// The number of cells around edges that are visited, at most.
    fn expected_work(&self, is_cut: bool) -> usize {
        let once = self.cell_count() * if G::D == 2 { 3 } else { 6 };
        if is_cut { 3 * once } else { once }
    }

    fn whole_volumes(&self, volumes: &mut [f64], progress: &mut Progress) -> Result<()> {
        let cells = self.cell_arrays()?;
        let centres = Centres::new(self, cells, None, None)?;
        let mut voronoi = Voronoi::new(self, cells, &centres);
        // In the order of storage, as their sums have none.
        let vertices = self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id);
        self.for_edges(vertices, |edge, first| {
            voronoi.ring.go_around(voronoi.cells, edge, first)?;
            let pyramid =
                if voronoi.ring.is_closed { pyramid::<G>(voronoi.polygon(edge)) } else { f64::INFINITY };
            edge.into_iter().for_each(|v| volumes[v.index()] += pyramid);
            progress.advance(voronoi.ring.cells.len())
        })
        .map(drop)
    }

    fn volumes_in(&self, clip: &Clip, volumes: &mut [f64], progress: &mut Progress) -> Result<()> {
        let cells = self.cell_arrays()?;
        let centres = Centres::new(self, cells, Some(clip), None)?;
        let mut voronoi = Voronoi::new(self, cells, &centres);
        let mut is_cut = Vec::new();
        memory::lengthen(&mut is_cut, self.id_count(), false)?;
        let vertices = self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id);
        let neighbours = self.for_edges(vertices, |edge, first| {
            if edge.into_iter().all(|v| is_cut[v.index()]) {
                return progress.advance(1);
            }
            voronoi.ring.go_around(voronoi.cells, edge, first)?;
            if let Part::All = voronoi.part() {
                let pyramid = pyramid::<G>(voronoi.polygon(edge));
                edge.into_iter().for_each(|v| volumes[v.index()] += pyramid);
            } else {
                edge.into_iter().for_each(|v| is_cut[v.index()] = true);
            }
            progress.advance(voronoi.ring.cells.len())
        })?;
        let cut = VertexId::range(0..self.id_count()).filter(|v| is_cut[v.index()]);
        cut.clone().for_each(|v| volumes[v.index()] = 0.0);
        let mut add = |v: VertexId, sums: &Sums| volumes[v.index()] += clip.measure_in(G::D, sums.volume);
        voronoi.cut_cells(clip, neighbours, cut, progress, &mut add)?;
        voronoi.corner_parts(clip, |_| true, add)?;
        // Parts may be negative, and what is left of them by rounding.
        volumes.iter_mut().for_each(|volume| *volume = if *volume < 0.0 { 0.0 } else { *volume });
        Ok(())
    }

    /// Lengths or areas of the Voronoi facets between the ends of all edges, in the order of [`edges`](Self::edges),
    /// within the box from `low` to `high` if these are given. Without a box that of an edge on the convex hull is
    /// infinite.
    ///
    /// Rounded: with h as for [`voronoi_volumes`](Self::voronoi_volumes), a length is off by at most 2 h, an area by h
    /// times the perimeter of the facet.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`] and [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_facets(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        self.voronoi_facets_monitored(clip, &mut |_| true)
    }

    /// For each edge the measure that it has in a list of edges with measures, in lexicographic order; 0 if it is not one
    /// of them: the Voronoi cells of its ends do not meet.
    fn at_own_edges(&self, edges: &[[VertexId; 2]], measures: &[f64]) -> Result<Vec<f64>> {
        let own = self.edges()?;
        let mut found = Vec::new();
        memory::collect(
            &mut found,
            own.iter().map(|edge| edges.binary_search(edge).map_or(0.0, |k| measures[k])),
        )?;
        Ok(found)
    }

    /// The [`voronoi_facets`](Self::voronoi_facets), with a call of `monitor` now and then, which is told the fraction
    /// done.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if `monitor` returns `false`; [`Error::NotFinite`], [`Error::OutOfRange`] and
    /// [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_facets_monitored(
        &self,
        clip: Option<[&G::Point; 2]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        if self.mesh.kernel.is_constrained() {
            let plain = self.without_segments()?;
            let measures = plain.voronoi_facets_monitored(clip, monitor)?;
            return self.at_own_edges(&plain.edges()?, &measures);
        }
        let clip = clip.map(checked::<G>).transpose()?;
        let mut measures = Vec::new();
        memory::reserve_exact(&mut measures, self.edge_count())?;
        let progress = &mut Progress::new(monitor, self.expected_work(false));
        let cells = self.cell_arrays()?;
        let centres = Centres::new(self, cells, clip.as_ref(), None)?;
        let mut voronoi = Voronoi::new(self, cells, &centres);
        self.for_edges(VertexId::range(0..self.id_count()), |edge, first| {
            measures.push(voronoi.measure(edge, first, clip.as_ref())?);
            progress.advance(voronoi.ring.cells.len())
        })?;
        Ok(measures)
    }

    /// Whether `high` is above `low` in every coordinate, and both are good.
    pub(crate) fn check_clip(&self, clip: [&G::Point; 2]) -> Result<()> {
        checked::<G>(clip).map(drop)
    }

    /// Visits all edges with a cell of each, in the order of their lower ids in `vertices`.
    #[inline(always)]
    pub(super) fn for_edges(
        &self,
        vertices: impl Iterator<Item = VertexId>,
        mut visit: impl FnMut([VertexId; 2], CellId) -> Result<()>,
    ) -> Result<Neighbours<'_, G>> {
        let mut neighbours = Neighbours::new(self.cell_arrays()?, self.id_count())?;
        let mut list = Vec::new();
        for v in vertices {
            neighbours.list(v, v, &mut list, |w, cell| (w, cell))?;
            for &(w, cell) in &list {
                visit([v, w], cell)?;
            }
        }
        Ok(neighbours)
    }
}

/// A box that is one.
pub(super) fn checked<G: Dimension>([low, high]: [&G::Point; 2]) -> Result<Clip> {
    let (low, high) = (check_position::<G>("low", 0, low)?, check_position::<G>("high", 0, high)?);
    for axis in 0..G::D {
        if low[axis] >= high[axis] {
            let wanted = "above low";
            return Err(Error::InvalidValue { argument: "high", index: axis, value: high[axis], wanted });
        }
    }
    Ok(Clip::new::<G>(&low, &high))
}
