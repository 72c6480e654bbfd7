//! Volumes, boundaries and centroids of the Voronoi cells of ids, in a box and half-spaces.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::{All, Centres, Numbering, Ranks};
use crate::motion::reading::geometry::clipping::{Clip, in_space};
use crate::motion::reading::geometry::dual::{Target, Targets};
use crate::motion::reading::geometry::half_spaces::{HalfSpaces, checked_row};
use crate::motion::reading::geometry::progress::Progress;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::voronoi_cells::checked;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;

/// What there is of the Voronoi cells of all ids in a box. A removed vertex, and one that is left out, has NaN in all
/// three; a hidden one has no volume.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiCells<P> {
    /// Areas or volumes.
    pub volumes: Vec<f64>,
    /// Lengths or areas of the boundaries, with what they have of the box's.
    pub areas: Vec<f64>,
    /// Centroids; NaN where the volume is 0.
    pub centroids: Vec<P>,
}

/// What there is of one Voronoi cell in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoronoiCell<P> {
    /// Area or volume.
    pub volume: f64,
    /// Length or area of the boundary, with what it has of the box's.
    pub area: f64,
    /// Centroid; NaN where the volume is 0.
    pub centroid: P,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes, boundaries and centroids of the Voronoi cells of all ids within the box from `low` to `high`,
    /// or of those of which `mask` has an entry that is not 0.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates. To first order in h, a volume is off by at most h times the area of the cell's surface or two
    /// thirds of that of the triangles that the vertex makes with its edges, whichever is more (an area, by h times the
    /// length of the boundary), an area by h times the sum of the perimeters of its facets, and a centroid by the error
    /// of the volume times d / V, where d is the diameter of the cell and V its volume.
    /// In place of 10⁻⁸ it is some last bits unless cells are nearly flat. The volumes of all ids add up to that of the
    /// box.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let cells = t.voronoi_cells([&[0.0, 0.0], &[1.0, 1.0]], None, &mut |_| true)?;
    /// assert_eq!(cells.volumes, [0.25; 4]);
    /// assert_eq!(cells.areas, [2.0; 4]);
    /// assert_eq!(cells.centroids[3], [0.75, 0.75]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`](crate::Error::Cancelled) if `monitor`, which is told the fraction done now and then, returns
    /// `false`; [`NotFinite`](crate::Error::NotFinite), [`OutOfRange`](crate::Error::OutOfRange) and
    /// [`InvalidValue`](crate::Error::InvalidValue) for the box; [`WrongCount`](crate::Error::WrongCount) if the mask has
    /// not an entry for each id; [`OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_cells(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiCells<G::Point>> {
        self.voronoi_cells_within(clip, &[], mask, monitor)
    }

    /// The [`voronoi_cells`](Self::voronoi_cells) within a box and half-spaces, of which there is a row each of an
    /// outward normal n, of any length but zero, and an offset: the places x with n · x at most the offset. There may be
    /// hundreds.
    ///
    /// Where half-spaces leave nothing of a cell, or of the box, volume and area are 0. Planes are not exact: where
    /// distances of corners from them are less than h, with 3·10⁻¹⁵ in place of 10⁻¹⁵ in it, a corner may be taken as
    /// inside or as beyond. With that h, errors are those of [`voronoi_cells`](Self::voronoi_cells), and an area may be
    /// off by twice a section of the cell that is no thicker than 2 h. The volumes of all ids add up to that of the box
    /// in the half-spaces.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let below = [1.0, 1.0, 1.0]; // x + y is at most 1
    /// let cells = t.voronoi_cells_within([&[0.0, 0.0], &[1.0, 1.0]], &below, None, &mut |_| true)?;
    /// assert_eq!(cells.volumes, [0.25, 0.125, 0.125, 0.0]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`voronoi_cells`](Self::voronoi_cells), also [`NotFinite`](crate::Error::NotFinite) and
    /// [`InvalidValue`](crate::Error::InvalidValue) for a normal that is zero, and
    /// [`WrongCount`](crate::Error::WrongCount) if the numbers do not make up rows.
    pub fn voronoi_cells_within(
        &self,
        clip: [&G::Point; 2],
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiCells<G::Point>> {
        let (mut volumes, mut areas, mut centroids) = (Vec::new(), Vec::new(), Vec::new());
        let n_ids = self.id_count();
        memory::lengthen(&mut volumes, n_ids, f64::NAN)?;
        memory::lengthen(&mut areas, n_ids, f64::NAN)?;
        memory::lengthen(&mut centroids, n_ids, nowhere::<G>())?;
        self.for_voronoi_cells(clip, half_spaces, mask, monitor, &mut |v, cell| {
            volumes[v.index()] = cell.volume;
            areas[v.index()] = cell.area;
            centroids[v.index()] = cell.centroid;
        })?;
        Ok(VoronoiCells { volumes, areas, centroids })
    }

    /// Tells the [`voronoi_cells_within`](Self::voronoi_cells_within) of all ids, or of those of which `mask` has an entry that is not
    /// 0, one after the other in ascending order, when all are computed.
    ///
    /// # Errors
    /// Those of [`voronoi_cells_within`](Self::voronoi_cells_within); then nothing has been told.
    pub fn for_voronoi_cells(
        &self,
        clip: [&G::Point; 2],
        half_spaces: &[f64],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        if self.mesh.kernel.is_constrained() {
            return self.without_segments()?.for_voronoi_cells(clip, half_spaces, mask, monitor, tell);
        }
        let region = self.region(clip, half_spaces)?;
        let is_wanted = |v: &VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
        let wanted = VertexId::range(0..self.id_count()).filter(is_wanted);
        if self.cell_count() == 0 {
            let targets = self.flat_targets(&region, monitor)?;
            self.tell_cells(&region.clip, wanted, targets, tell);
            return Ok(());
        }
        let (cells, n_sites) = (self.cell_arrays()?, self.mesh.kernel.sites().len());
        let Some(mask) = mask else {
            let mut vertices = Vec::new();
            memory::reserve_exact(&mut vertices, self.vertex_count())?;
            vertices.extend(self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id));
            let mut centres = Centres::new(self, cells, Some(&region.clip), None)?;
            region.mark(self, &mut centres);
            let targets = Targets::new(All, n_sites)?;
            let targets = self.targets_of(&region, (&centres, All), &vertices, targets, monitor)?;
            self.tell_cells(&region.clip, wanted, targets, tell);
            return Ok(());
        };
        let vertices = self.shown_in(mask)?;
        let chosen = self.cells_around(&vertices)?;
        let mut centres = Centres::new(self, cells, Some(&region.clip), Some(&chosen))?;
        region.mark(self, &mut centres);
        let (_, ranks) = centres.chosen.as_ref().expect("cells are chosen");
        let numbers = Ranks::of(n_sites, vertices.iter().map(|&v| self.mesh.site_of[v].index()))?;
        let targets = Targets::new(&numbers, vertices.len())?;
        let targets = self.targets_of(&region, (&centres, ranks), &vertices, targets, monitor)?;
        self.tell_cells(&region.clip, wanted, targets, tell);
        Ok(())
    }

    /// Whether numbers are rows of normals and offsets.
    pub(crate) fn check_half_spaces(&self, rows: &[f64]) -> Result<()> {
        if !rows.len().is_multiple_of(G::D + 1) {
            let (given, wanted) = (rows.len(), rows.len().next_multiple_of(G::D + 1));
            return Err(Error::WrongCount { argument: "half_spaces", given, wanted, coming: 0 });
        }
        rows.chunks(G::D + 1).enumerate().try_for_each(|(index, row)| checked_row::<G>(index, row))
    }

    /// What cells are clipped by, if it is good.
    pub(super) fn region(&self, clip: [&G::Point; 2], half_spaces: &[f64]) -> Result<Region> {
        let clip = checked::<G>(clip)?;
        self.check_half_spaces(half_spaces)?;
        let half_spaces = HalfSpaces::new::<G>(half_spaces, &clip, self.cell_count())?;
        Ok(Region { clip, half_spaces })
    }

    /// Sums for vertices in one hyperplane.
    fn flat_targets(&self, region: &Region, monitor: &mut dyn FnMut(f64) -> bool) -> Result<Targets<All>> {
        let mut targets = Targets::new(All, self.mesh.kernel.sites().len())?;
        targets.list.iter_mut().for_each(|target| target.is_cut = true);
        self.flat_cells(region, &mut Progress::new(monitor, 1), |v, part| {
            targets.of(self.mesh.site_of[v]).sums.join(part);
        })?;
        Ok(targets)
    }

    /// Sums for some vertices, which have targets, by the centres of all cells around these, which are numbered.
    fn targets_of<S: Numbering>(
        &self,
        region: &Region,
        (centres, numbers): (&Centres<G::Point>, impl Numbering),
        vertices: &[VertexId],
        mut targets: Targets<S>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Targets<S>> {
        let mut voronoi = Voronoi::new(self, self.cell_arrays()?, centres);
        let progress = &mut Progress::new(monitor, 2 * centres.list.len());
        voronoi.add_all(region.clip.unit, numbers, progress, &mut targets)?;
        voronoi.cut_all(region, vertices, progress, &mut targets)?;
        Ok(targets)
    }

    /// Tells what is known of vertices.
    fn tell_cells(
        &self,
        clip: &Clip,
        wanted: impl Iterator<Item = VertexId>,
        mut targets: Targets<impl Numbering>,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) {
        for v in wanted {
            let none = |x| VoronoiCell { volume: x, area: x, centroid: nowhere::<G>() };
            let cell = match self.mesh.standing(v) {
                Standing::Gone => none(f64::NAN),
                Standing::Hidden(_) => none(0.0),
                Standing::Shown(s) => cell_of::<G>(clip, self.mesh.kernel.place(s), targets.of(s)),
            };
            tell(v, cell);
        }
    }
}

/// No place.
pub(crate) fn nowhere<G: Dimension>() -> G::Point {
    let mut nowhere = G::Point::default();
    (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
    nowhere
}

/// What the sums of a vertex at this place say.
fn cell_of<G: Dimension>(clip: &Clip, place: &G::Point, target: &Target) -> VoronoiCell<G::Point> {
    let sums = &target.sums;
    let [of_volume, of_facets, of_moment] = target.factors::<G>();
    let volume = of_volume * sums.volume;
    // What is left of negative parts by rounding may be negative.
    let measured = clip.measure_in(G::D, volume).max(0.0);
    let mut centroid = nowhere::<G>();
    if measured > 0.0 {
        let apex = clip.offset_within(&in_space::<G>(place));
        for axis in 0..G::D {
            let way = of_moment * sums.moment[axis] / volume / clip.unit;
            let at = clip.low()[axis] + (apex[axis] + way);
            centroid[axis] = at.clamp(clip.low()[axis], clip.high()[axis]);
        }
    }
    VoronoiCell {
        volume: measured,
        area: clip.measure_in(G::D - 1, of_facets * sums.facets + sums.wall).max(0.0),
        centroid,
    }
}
