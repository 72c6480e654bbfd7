//! What refinement and coarsening read, in one pass over the vertices and one over the cells.

use crate::delaunay::{Keys, Plane};
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::state::mesh::Standing;
use crate::motion::state::views::CellsView;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::{Given, NONE, Tests, power_of_two_below};

/// Vertices, segments, and which cells are bad.
pub(super) struct Read {
    /// By vertex, its place, multiplied by the scale.
    pub(super) points: Vec<[f64; 2]>,
    /// A power of two: more than 1 where all coordinates are so small that the squares of lengths might underflow.
    pub(super) scale: f64,
    /// The box of all places, as multiplied.
    lower: [f64; 2],
    upper: [f64; 2],
    /// Segments by edge, the lower end first; sorted.
    by_edge: Vec<([VertexId; 2], SegmentId)>,
    /// Where those of each edge begin, and in the end how many there are.
    starts: Vec<usize>,
    /// The ends of each edge, in the direction of its segment of the lowest id.
    pub(super) edges: Vec<[VertexId; 2]>,
    /// By vertex, whether it is an end of an edge.
    is_end: Vec<bool>,
    /// The cells at edges, ascending, with the edge opposite each corner.
    sides: Vec<(u32, [u32; 3])>,
    /// By vertex, a cell.
    at: Vec<u32>,
    /// The selected cells, ascending, that are bad or have an edge that is encroached.
    pub(super) bad: Vec<u32>,
    /// By vertex, what is around it; only for coarsening.
    around: Vec<Around>,
    /// The vertices in the order in which cells have them first: those near each other are mostly soon after each other.
    order: Vec<VertexId>,
}

/// The selected cells around a vertex.
#[derive(Clone, Copy, Debug, Default)]
struct Around {
    /// The sum of the shares that they have of the greatest areas for them, or a bit less.
    share: f64,
    n: u32,
}

/// Where no coordinate is greater, places are multiplied: fourth powers of lengths are far from underflow above.
const SMALL: f64 = 1e-30;

/// Sums of so many shares are off by less than this share.
const ROUNDING: f64 = 1e-12;

impl Read {
    /// The segments at an edge.
    pub(super) fn segments_at(&self, edge: usize) -> &[([VertexId; 2], SegmentId)] {
        &self.by_edge[self.starts[edge]..self.starts[edge + 1]]
    }

    /// A cell of a vertex, [`NONE`] if it is in none.
    pub(super) fn cell_at(&self, vertex: VertexId) -> u32 {
        self.at[vertex]
    }

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

    /// The box of all places, as they have been multiplied.
    pub(super) fn extent(&self) -> [[f64; 2]; 2] {
        [self.lower, self.upper]
    }

    pub(super) fn given<'a>(
        &'a self,
        cells: CellsView<'a, Plane>,
        mask: &'a [u8],
        labels: Option<&'a [u32]>,
        keys: &'a Keys,
    ) -> Given<'a> {
        Given {
            lower: self.lower,
            upper: self.upper,
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

    /// Whether cells that take the place of those around a vertex could all have this share of the greatest areas: two
    /// fewer, or one where all are on one side of a segment.
    pub(super) fn has_room(&self, vertex: VertexId, share: f64, is_inside: bool) -> bool {
        let Around { share: sum, n } = self.around[vertex];
        let n_coming = f64::from(n) - if is_inside { 2.0 } else { 1.0 };
        sum <= n_coming * share * (1.0 + ROUNDING)
    }

    /// Puts the entries of a list, which has one at most for each vertex, in the order of the cells.
    pub(super) fn sort_by_cell<T: Copy>(
        &self,
        list: &mut Vec<T>,
        vertex: impl Fn(&T) -> VertexId,
    ) -> Result<()> {
        let mut place = Vec::new();
        memory::lengthen(&mut place, self.at.len(), NONE)?;
        for (k, entry) in (0..).zip(&*list) {
            place[vertex(entry)] = k;
        }
        let mut sorted = Vec::new();
        memory::reserve_exact(&mut sorted, list.len())?;
        let places = self.order.iter().map(|&v| place[v]).filter(|&k| k != NONE);
        sorted.extend(places.map(|k| list[k as usize]));
        *list = sorted;
        Ok(())
    }

    /// The corners of cells at segments.
    pub(super) fn corners_at_sides(&self, corners: &[[VertexId; 3]]) -> impl Iterator<Item = VertexId> {
        self.sides.iter().flat_map(move |&(cell, _)| corners[cell as usize])
    }

    /// The edge between two corners that are ends.
    fn edge_between(&self, v: VertexId, w: VertexId) -> u32 {
        let edge = [v.min(w), v.max(w)];
        let starts = &self.starts[..self.edges.len()];
        starts.binary_search_by_key(&edge, |&start| self.by_edge[start].0).map_or(NONE, |at| at as u32)
    }
}

impl MovingTriangulation<Plane> {
    /// Reads vertices and segments.
    pub(super) fn read_vertices(&self) -> Result<Read> {
        let n = self.id_count();
        let mut read = Read {
            points: Vec::new(),
            scale: 1.0,
            lower: [f64::INFINITY; 2],
            upper: [f64::NEG_INFINITY; 2],
            by_edge: Vec::new(),
            starts: Vec::new(),
            edges: Vec::new(),
            is_end: Vec::new(),
            sides: Vec::new(),
            at: Vec::new(),
            bad: Vec::new(),
            around: Vec::new(),
            order: Vec::new(),
        };
        memory::lengthen(&mut read.points, n, [0.0; 2])?;
        memory::lengthen(&mut read.at, n, NONE)?;
        memory::lengthen(&mut read.is_end, n, false)?;
        for (v, standing) in self.mesh.standings() {
            let (Standing::Shown(s) | Standing::Hidden(s)) = standing else { continue };
            let p = self.mesh.kernel.site(s).point;
            for (axis, x) in p.into_iter().enumerate() {
                read.lower[axis] = read.lower[axis].min(x);
                read.upper[axis] = read.upper[axis].max(x);
            }
            read.points[v] = p;
        }
        read.scale_up();
        self.list_edges(&mut read)?;
        Ok(read)
    }

    /// Lists the segments by edge.
    fn list_edges(&self, read: &mut Read) -> Result<()> {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let Read { by_edge, starts, edges, is_end, .. } = read;
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
        edges.iter().flatten().for_each(|&v| is_end[v] = true);
        Ok(())
    }

    /// Reads the cells: finds those that are bad, the segments at their edges, and, if that is wanted, what is around
    /// vertices. Checks that those selected end at segments.
    pub(super) fn read_cells(
        &self,
        read: &mut Read,
        tests: &Tests,
        mask: &[u8],
        labels: Option<&[u32]>,
        wants_around: bool,
    ) -> Result<()> {
        let cells = self.cells()?;
        let mut at = std::mem::take(&mut read.at);
        let (mut bad, mut sides, mut around, mut order) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        if wants_around {
            memory::lengthen(&mut around, at.len(), Around::default())?;
            memory::reserve_exact(&mut order, at.len())?;
        }
        let given = read.given(cells, mask, labels, self.mesh.kernel.keys());
        for (c, (row, neighbours)) in cells.corners.iter().zip(cells.neighbours).enumerate() {
            let cell = c as u32;
            for &v in row {
                if at[v] == NONE {
                    at[v] = cell;
                    if wants_around {
                        order.push(v);
                    }
                }
            }
            let is_end = row.map(|v| read.is_end[v]);
            let has_edge = is_end[0] as u8 + is_end[1] as u8 + is_end[2] as u8 >= 2;
            let mut edges = [NONE; 3];
            if has_edge {
                for (i, [j, k]) in OTHERS.into_iter().enumerate() {
                    if is_end[j] && is_end[k] {
                        edges[i] = read.edge_between(row[j], row[k]);
                    }
                }
                if edges != [NONE; 3] {
                    memory::push(&mut sides, (cell, edges))?;
                }
            }
            if mask[c] == 0 {
                continue;
            }
            let is_open = |i: usize| neighbours[i] == CellId::NONE || mask[neighbours[i].index()] == 0;
            if (0..3).any(|i| edges[i] == NONE && is_open(i)) {
                let wanted =
                    "0, as the cell has an edge that is no segment and beyond which no cell is selected";
                let value = f64::from(mask[c]);
                return Err(Error::InvalidValue { argument: "mask", index: c, value, wanted });
            }
            let points = row.map(|v| &read.points[v]);
            let label = given.label(cell);
            let is_encroached = |(i, &[j, k]): (usize, &[usize; 2])| {
                edges[i] != NONE && tests.is_encroached([points[j], points[k]], points[i])
            };
            let corners = given.row(cell);
            if tests.is_flawed(corners.map(|v| &read.points[v]), label, &corners)
                || edges != [NONE; 3] && OTHERS.iter().enumerate().any(is_encroached)
            {
                memory::push(&mut bad, cell)?;
            }
            if wants_around {
                let share = tests.share_of_area(points, label);
                for v in row {
                    let around = &mut around[*v];
                    around.share += share;
                    around.n += 1;
                }
            }
        }
        (read.at, read.bad, read.sides) = (at, bad, sides);
        (read.around, read.order) = (around, order);
        Ok(())
    }
}

/// The corners beside each one.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
