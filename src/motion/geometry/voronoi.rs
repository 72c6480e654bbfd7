//! Voronoi cells and facets, clipped by a box.
//!
//! The Voronoi facet of an edge is between the circumcentres of the cells around the edge. If all of them are in the
//! box it is their polygon (in the plane a segment); otherwise it is the section of the box with the bisector of the
//! edge, cut by the bisectors of one end of the edge and the vertices of its link.
//!
//! A Voronoi cell in the box consists of the pyramids from its vertex to its facets. Any other is cut out of the box,
//! by the bisectors of its vertex and the neighbours of that: a polyhedron that stays closed however planes coincide,
//! so that its volume, like those of the others, is right but for rounding, and all add up to that of the box.

use super::clipping::{Clip, Section, cross, dot, in_space, middle, minus};
use super::incidence::Neighbours;
use super::polyhedron::Polyhedron;
use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::memory;
use crate::motion::staging::check_position;
use crate::motion::{MovingTriangulation, NO_CELL};

/// The cells around an edge, in order, and the vertices of its link. Of a ring that is open, at the hull, only some
/// cells are listed: nobody reads them.
#[derive(Debug, Default)]
struct Ring {
    cells: Vec<CellId>,
    link: Vec<VertexId>,
    is_closed: bool,
}

/// Computes Voronoi facets.
struct Voronoi<'t, G: Dimension> {
    t: &'t MovingTriangulation<G>,
    corners: &'t [G::Vertices],
    across: &'t [G::Neighbours],
    centres: Vec<G::Point>,
    clip: Option<Clip<G>>,
    ring: Ring,
    section: Section,
    polyhedron: Polyhedron,
}

/// A Voronoi facet.
struct VoronoiFacet {
    /// Length or area within the box.
    measure: f64,
    /// Whether it is in the box as a whole.
    is_inside: bool,
}

impl<'t, G: Dimension> Voronoi<'t, G> {
    fn new(t: &'t MovingTriangulation<G>, clip: Option<Clip<G>>) -> Result<Self> {
        let cells = t.cell_arrays()?;
        let mut centres = Vec::new();
        memory::reserve_exact(&mut centres, cells.corners().len())?;
        centres.extend(t.circumspheres()?.map(|(centre, _)| centre));
        Ok(Voronoi {
            t,
            corners: cells.corners(),
            across: cells.neighbours(),
            centres,
            clip,
            ring: Ring::default(),
            section: Section::default(),
            polyhedron: Polyhedron::default(),
        })
    }

    fn place(&self, v: VertexId) -> [f64; 3] {
        in_space::<G>(&self.t.kernel.site(self.t.site_of[v]).point)
    }

    /// The cell across the facet opposite a corner.
    #[inline(always)]
    fn beyond(&self, cell: CellId, corner: VertexId) -> CellId {
        let row = self.corners[cell].as_ref();
        let at = row.iter().position(|&v| v == corner).expect("a corner of the cell");
        self.across[cell][at]
    }

    /// The corner of a cell besides those of an edge and, in space, another one.
    #[inline(always)]
    fn other(&self, cell: CellId, [v, w]: [VertexId; 2], but: VertexId) -> VertexId {
        let row = self.corners[cell].as_ref();
        *row.iter().find(|&&x| x != v && x != w && x != but).expect("one more corner")
    }

    /// Goes around an edge, of which `first` is a cell.
    fn go_around(&mut self, edge: [VertexId; 2], first: CellId) -> Result<()> {
        let Ring { mut cells, mut link, .. } = std::mem::take(&mut self.ring);
        cells.clear();
        link.clear();
        let last = self.other(first, edge, VertexId::NONE);
        memory::push(&mut cells, first)?;
        memory::push(&mut link, last)?;
        if G::D == 2 {
            let across = self.beyond(first, last);
            if across != NO_CELL {
                memory::push(&mut cells, across)?;
                memory::push(&mut link, self.other(across, edge, VertexId::NONE))?;
            }
            self.ring = Ring { is_closed: cells.len() == 2, cells, link };
            return Ok(());
        }
        // Out of each cell by the facet of the edge and the vertex that has been met last.
        let start = self.other(first, edge, last);
        let (mut left, mut met, mut cell) = (last, start, first);
        memory::push(&mut link, start)?;
        let is_closed = loop {
            cell = self.beyond(cell, left);
            if cell == NO_CELL {
                break false;
            }
            if cell == first {
                // The vertex met last has been the first.
                link.pop();
                break true;
            }
            (left, met) = (met, self.other(cell, edge, met));
            memory::push(&mut cells, cell)?;
            memory::push(&mut link, met)?;
        };
        if !is_closed {
            // The other way around; such a ring is never read in order.
            (left, met, cell) = (start, last, first);
            loop {
                cell = self.beyond(cell, left);
                if cell == NO_CELL {
                    break;
                }
                (left, met) = (met, self.other(cell, edge, met));
                memory::push(&mut link, met)?;
            }
        }
        self.ring = Ring { cells, link, is_closed };
        Ok(())
    }

    /// The Voronoi facet of an edge, of which `first` is a cell.
    fn facet(&mut self, edge: [VertexId; 2], first: CellId) -> Result<VoronoiFacet> {
        self.go_around(edge, first)?;
        let Some(clip) = self.clip else {
            let measure = if self.ring.is_closed { self.polygon(edge) } else { f64::INFINITY };
            return Ok(VoronoiFacet { measure, is_inside: true });
        };
        let is_inside = self.ring.is_closed
            && self.ring.cells.iter().all(|&cell| clip.holds(&self.centres[cell.index()]));
        let measure = if is_inside { self.polygon(edge) } else { self.clipped(&clip, edge)? };
        Ok(VoronoiFacet { measure, is_inside })
    }

    /// Length or area of the polygon of the circumcentres around an edge.
    #[inline(always)]
    fn polygon(&self, [v, w]: [VertexId; 2]) -> f64 {
        let centre = |cell: CellId| in_space::<G>(&self.centres[cell.index()]);
        let (first, others) = self.ring.cells.split_first().expect("a cell at the edge");
        let first = centre(*first);
        if G::D == 2 {
            let along = minus(&centre(others[0]), &first);
            return dot(&along, &along).sqrt();
        }
        let along = minus(&self.place(w), &self.place(v));
        let mut doubled = 0.0;
        let mut before = minus(&centre(others[0]), &first);
        for &cell in &others[1..] {
            let next = minus(&centre(cell), &first);
            doubled += dot(&cross(&before, &next), &along);
            before = next;
        }
        0.5 * doubled.abs() / dot(&along, &along).sqrt()
    }

    /// Length or area of the part of a facet that is in the box.
    #[cold]
    fn clipped(&mut self, clip: &Clip<G>, [v, w]: [VertexId; 2]) -> Result<f64> {
        let (at, to) = (self.place(v), self.place(w));
        let n_cuts = self.ring.link.len();
        self.section.start(clip, &minus(&to, &at), &middle(&at, &to), n_cuts)?;
        for &z in &self.ring.link {
            let other = in_space::<G>(&self.t.kernel.site(self.t.site_of[z]).point);
            self.section.keep_behind(&minus(&other, &at), &middle(&at, &other));
        }
        Ok(self.section.area())
    }

    /// Area or volume of the part of the Voronoi cell of a vertex that is in the box.
    fn clipped_volume(&mut self, clip: &Clip<G>, v: VertexId, neighbours: &[VertexId]) -> Result<f64> {
        let at = self.place(v);
        self.polyhedron.start(clip)?;
        for &w in neighbours {
            let other = self.place(w);
            self.polyhedron.keep_behind(&minus(&other, &at), &middle(&at, &other))?;
        }
        Ok(self.polyhedron.volume())
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes of the Voronoi cells of all ids, within the box from `low` to `high` if these are given.
    /// Without a box that of a vertex of the convex hull is infinite. NaN for removed vertices, 0 for hidden ones; NaN
    /// for all while there are no cells.
    ///
    /// Rounded: relatively to the box, or without one to the square or cube of the distance to the farthest
    /// circumcentre around the vertex, the error is a small multiple of that of [`circumspheres`](Self::circumspheres).
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`] and [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_volumes(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        let clip = clip.map(checked::<G>).transpose()?;
        let mut volumes = Vec::new();
        memory::reserve_exact(&mut volumes, self.id_count())?;
        let has_cells = self.cell_count() > 0;
        let is_known = |&s: &SiteId| has_cells && s != SiteId::NONE;
        volumes.extend(self.site_of.iter().map(|s| if is_known(s) { 0.0 } else { f64::NAN }));
        let mut voronoi = Voronoi::new(self, clip)?;
        let mut is_cut = Vec::new();
        memory::reserve_exact(&mut is_cut, self.id_count())?;
        is_cut.resize(self.id_count(), false);
        // In the order of storage, as their sums have none.
        let vertices = self.kernel.live_sites().map(|s| self.kernel.site(s).id);
        let neighbours = self.for_voronoi_facets(vertices, &mut voronoi, |voronoi, edge, facet| {
            let along = minus(&voronoi.place(edge[1]), &voronoi.place(edge[0]));
            let pyramid = 0.5 * dot(&along, &along).sqrt() * facet.measure / G::D as f64;
            for v in edge {
                volumes[v.index()] += pyramid;
                is_cut[v.index()] |= !facet.is_inside;
            }
        })?;
        let Some(clip) = clip else { return Ok(volumes) };
        let mut list = Vec::new();
        let mut neighbours = neighbours;
        for v in VertexId::range(0..self.id_count()).filter(|v| is_cut[v.index()]) {
            neighbours.list(v, VertexId::new(0), &mut list, |w, _| w)?;
            volumes[v.index()] = voronoi.clipped_volume(&clip, v, &list)?;
        }
        Ok(volumes)
    }

    /// Lengths or areas of the Voronoi facets between the ends of all edges, in the order of [`edges`](Self::edges),
    /// within the box from `low` to `high` if these are given. Without a box that of an edge on the convex hull is
    /// infinite.
    ///
    /// # Errors
    /// As [`voronoi_volumes`](Self::voronoi_volumes).
    pub fn voronoi_facets(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        let clip = clip.map(checked::<G>).transpose()?;
        let mut measures = Vec::new();
        memory::reserve_exact(&mut measures, self.edge_count())?;
        let mut voronoi = Voronoi::new(self, clip)?;
        let vertices = VertexId::range(0..self.id_count());
        self.for_voronoi_facets(vertices, &mut voronoi, |_, _, facet| measures.push(facet.measure))?;
        Ok(measures)
    }

    /// Whether `high` is above `low` in every coordinate, and both are good.
    pub(crate) fn check_clip(&self, clip: [&G::Point; 2]) -> Result<()> {
        checked::<G>(clip).map(drop)
    }

    /// Visits the Voronoi facets of all edges, in the order of their lower ids in `vertices`.
    fn for_voronoi_facets<'t>(
        &'t self,
        vertices: impl Iterator<Item = VertexId>,
        voronoi: &mut Voronoi<'t, G>,
        mut visit: impl FnMut(&Voronoi<'t, G>, [VertexId; 2], VoronoiFacet),
    ) -> Result<Neighbours<'t, G>> {
        let mut neighbours = Neighbours::new(self.cell_arrays()?, self.id_count())?;
        let mut list = Vec::new();
        for v in vertices {
            neighbours.list(v, v, &mut list, |w, cell| (w, cell))?;
            for &(w, cell) in &list {
                let facet = voronoi.facet([v, w], cell)?;
                visit(voronoi, [v, w], facet);
            }
        }
        Ok(neighbours)
    }
}

/// A box that is one.
fn checked<G: Dimension>([low, high]: [&G::Point; 2]) -> Result<Clip<G>> {
    let (low, high) = (check_position::<G>("low", 0, low)?, check_position::<G>("high", 0, high)?);
    for axis in 0..G::D {
        if low[axis] >= high[axis] {
            let wanted = "above low";
            return Err(Error::InvalidValue { argument: "high", index: axis, value: high[axis], wanted });
        }
    }
    Ok(Clip { low, high })
}
