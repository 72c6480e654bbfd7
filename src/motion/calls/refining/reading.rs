//! What refinement and coarsening read: vertices, segments, and which cells are bad.

use crate::delaunay::{Keys, Plane};
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::state::looked::{Looked, Looking, Question, ScaledPlaces};
use crate::motion::state::views::CellsView;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::{Candidate, Given, NONE, Tests, power_of_two_below};

/// Vertices, segments, and which cells are bad.
#[derive(Default)]
pub(super) struct Read {
    pub(super) places: ScaledPlaces,
    /// Whether vertices may be at other places than at the last look.
    has_moved: bool,
    /// Segments by edge, the lower end first; sorted.
    by_edge: Vec<([VertexId; 2], SegmentId)>,
    /// Where those of each edge begin, and in the end how many there are.
    starts: Vec<usize>,
    /// The ends of each edge, in the direction of its segment of the lowest id.
    pub(super) edges: Vec<[VertexId; 2]>,
    /// The cells at edges, ascending, with the edge opposite each corner.
    sides: Vec<(u32, [u32; 3])>,
    /// By vertex, a cell; empty unless it has been [read](Self::read_cells_of_vertices).
    at: Vec<u32>,
    /// The selected cells, ascending, that are bad or have an edge that is encroached.
    pub(super) bad: Vec<u32>,
}

/// Where no coordinate is greater, places are multiplied: fourth powers of lengths are far from underflow above.
const SMALL: f64 = 1e-30;

impl Read {
    /// The segments at an edge.
    pub(super) fn segments_at(&self, edge: usize) -> &[([VertexId; 2], SegmentId)] {
        &self.by_edge[self.starts[edge]..self.starts[edge + 1]]
    }

    /// A cell of a vertex, [`NONE`] if it is in none.
    pub(super) fn cell_at(&self, vertex: VertexId) -> u32 {
        self.at[vertex]
    }

    pub(super) fn given<'a>(
        &'a self,
        cells: CellsView<'a, Plane>,
        mask: &'a [u8],
        labels: Option<&'a [u32]>,
        keys: &'a Keys,
    ) -> Given<'a> {
        Given {
            lower: self.places.lower,
            upper: self.places.upper,
            corners: cells.corners,
            neighbours: cells.neighbours,
            at: &self.at,
            mask,
            labels,
            sides: &self.sides,
            segments: &self.edges,
            keys,
        }
    }

    /// Puts the candidates first that are not kept, and those near each other soon after each other.
    pub(super) fn put_first(&self, candidates: &mut [Candidate]) {
        let mut n = 0;
        for k in 0..candidates.len() {
            if !candidates[k].is_kept {
                candidates.swap(k, n);
                n += 1;
            }
        }
        candidates[..n].sort_unstable_by_key(|candidate| self.cell_at(candidate.vertex));
    }

    /// The corners of cells at segments.
    pub(super) fn corners_at_sides(&self, corners: &[[VertexId; 3]]) -> impl Iterator<Item = VertexId> {
        self.sides.iter().flat_map(move |&(cell, _)| corners[cell as usize])
    }

    /// Finds a cell for each vertex, if that has not been done.
    pub(super) fn read_cells_of_vertices(&mut self, corners: &[[VertexId; 3]]) -> Result<()> {
        if self.at.is_empty() {
            memory::lengthen(&mut self.at, self.places.points.len(), NONE)?;
            for (cell, row) in (0..).zip(corners) {
                row.iter().for_each(|&v| self.at[v] = cell);
            }
        }
        Ok(())
    }
}

impl ScaledPlaces {
    /// Multiplies places by a power of two, which is exact, where their coordinates are very small.
    fn scale_up(&mut self) {
        let greatest = self.lower.iter().chain(&self.upper).fold(0.0, |most: f64, x| most.max(x.abs()));
        if greatest == 0.0 || greatest >= SMALL {
            return;
        }
        // The inverse of a subnormal number may be infinite.
        self.scale = power_of_two_below((1.0 / greatest).min(f64::MAX));
        let places = self.points.iter_mut().chain([&mut self.lower, &mut self.upper]);
        places.flatten().for_each(|x| *x *= self.scale);
    }

    /// Whether a vertex is on the boundary of the box.
    pub(super) fn bound(&self, vertex: VertexId) -> bool {
        let p = &self.points[vertex];
        (0..2).any(|axis| p[axis] == self.lower[axis] || p[axis] == self.upper[axis])
    }
}

impl MovingTriangulation<Plane> {
    /// Reads vertices and segments; where the places of vertices are known, they are taken.
    pub(super) fn read_vertices(&self, looked: &mut Looked) -> Result<Read> {
        let mut read = Read::default();
        match looked.take_places(self.mesh.n_changes, self.id_count()) {
            Some(places) => read.places = places,
            None => {
                read.has_moved = true;
                self.read_places(&mut read.places)?;
            }
        }
        self.list_edges(&mut read)?;
        Ok(read)
    }

    fn read_places(&self, places: &mut ScaledPlaces) -> Result<()> {
        memory::lengthen(&mut places.points, self.id_count(), [0.0; 2])?;
        let kernel = &self.mesh.kernel;
        for s in kernel.live_sites() {
            let site = kernel.site(s);
            for (axis, x) in site.point.into_iter().enumerate() {
                places.lower[axis] = places.lower[axis].min(x);
                places.upper[axis] = places.upper[axis].max(x);
            }
            places.points[site.id] = site.point;
        }
        places.scale_up();
        Ok(())
    }

    /// Lists the segments by edge, and the cells at these.
    fn list_edges(&self, read: &mut Read) -> Result<()> {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let Read { by_edge, starts, edges, sides, .. } = read;
        memory::collect(
            by_edge,
            self.segments().map(|(id, segment)| {
                let [v, w] = segment.ends.map(shown);
                ([v.min(w), v.max(w)], id)
            }),
        )?;
        by_edge.sort_unstable();
        for k in 0..by_edge.len() {
            if k == 0 || by_edge[k - 1].0 != by_edge[k].0 {
                memory::push(starts, k)?;
                memory::push(edges, self.segment_in_force(by_edge[k].1).ends.map(shown))?;
            }
        }
        memory::push(starts, by_edge.len())?;
        let (kernel, cells) = (&self.mesh.kernel, self.cell_arrays()?);
        if !kernel.has_cells() {
            return Ok(());
        }
        memory::reserve(sides, 2 * edges.len())?;
        for (edge, ends) in (0..).zip(&*edges) {
            let facets = kernel.cells_beside(ends.map(|v| self.mesh.site_of[v]))?;
            for facet in facets.into_iter().flatten() {
                let (cell, corner) = cells.shown(facet);
                let mut row = [NONE; 3];
                row[corner] = edge;
                sides.push((cell.get(), row));
            }
        }
        sides.sort_unstable();
        sides.dedup_by(|(next, row), (cell, edges)| {
            if next == cell {
                (0..3).for_each(|i| edges[i] = edges[i].min(row[i]));
            }
            next == cell
        });
        Ok(())
    }

    /// Reads the cells, those alone that are others than at the last look: finds those that are bad. Checks that those
    /// selected end at segments.
    pub(super) fn read_cells(
        &self,
        read: &mut Read,
        looked: &mut Looked,
        tests: &Tests,
        question: Question,
    ) -> Result<()> {
        let cells = self.cells()?;
        let Question { mask, labels, .. } = question;
        let points = &read.places.points[..];
        let now = Looking { question, points, corners: cells.corners };
        let others = looked.begin(now, read.has_moved)?;
        let labels = (!labels.is_empty()).then_some(labels);
        let given = read.given(cells, mask, labels, self.mesh.kernel.keys());
        let mut bad = Vec::new();
        let mut sides = read.sides.iter().peekable();
        for (c, (row, neighbours)) in cells.corners.iter().zip(cells.neighbours).enumerate() {
            let side = sides.next_if(|side| side.0 == c as u32);
            let is_open = |i: usize| neighbours[i] == CellId::NONE || mask[neighbours[i].index()] == 0;
            if mask[c] != 0 && (is_open(0) || is_open(1) || is_open(2)) {
                let edges = side.map_or([NONE; 3], |side| side.1);
                if (0..3).any(|i| edges[i] == NONE && is_open(i)) {
                    let wanted =
                        "0, as the cell has an edge that is no segment and beyond which no cell is selected";
                    let value = f64::from(mask[c]);
                    return Err(Error::InvalidValue { argument: "mask", index: c, value, wanted });
                }
            }
            let is_flawed = looked.look_at(&now, &others, c, || {
                let label = given.label(c as u32);
                let p = row.map(|v| &points[v]);
                mask[c] != 0 && !tests.is_surely_good(p, label, row) && {
                    let corners = given.row(c as u32);
                    tests.is_flawed(corners.map(|v| &points[v]), label, &corners)
                }
            });
            let is_encroached = |&(_, edges): &(u32, [u32; 3])| {
                let p = row.map(|v| &points[v]);
                OTHERS
                    .iter()
                    .enumerate()
                    .any(|(i, &[j, k])| edges[i] != NONE && tests.is_encroached([p[j], p[k]], p[i]))
            };
            if is_flawed || mask[c] != 0 && side.is_some_and(is_encroached) {
                memory::push(&mut bad, c as u32)?;
            }
        }
        read.bad = bad;
        Ok(())
    }
}

/// The corners beside each one.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
