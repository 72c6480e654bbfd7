//! The cells of a set that repeats, one of each class of translations of each other.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use crate::complex::Corners;
use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{CellsView, NO_CELL};
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{HOME, Shift, minus, plus};

/// The cells, one of each class of translations of each other.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicView<'t, G: Moving> {
    /// Vertex ids of each cell, positively oriented. A vertex may be there more than once, in several periods.
    pub corners: &'t [G::Vertices],
    /// The class of the neighbour opposite each corner, [`NO_CELL`] on the hull.
    pub neighbours: &'t [G::Neighbours],
}

/// Cells, each with its least vertex at home: the one of the lowest id, and of several images of that the first in the order
/// of coordinates.
#[derive(Debug)]
pub(super) struct PeriodicCells<G: Moving> {
    pub(super) corners: Vec<G::Vertices>,
    /// By cell and corner, the shift of the vertex from home.
    pub(super) shifts: Shifts,
    pub(super) neighbours: Vec<G::Neighbours>,
    /// By cell and corner, the shift of the neighbour from where its least vertex is at home.
    pub(super) neighbour_shifts: Shifts,
    /// Which corner is the least.
    pub(super) least: Vec<u8>,
    /// By cell, the one inside that has its least vertex at home.
    pub(super) chosen: Vec<CellId>,
    /// By cell inside, which one it is a translation of, if it has a vertex at home; [`NO_CELL`] for others.
    pub(super) class_of: Vec<CellId>,
    /// By cell, the index that it had when changes were last taken; none where they never were.
    pub(super) origins: Vec<CellId>,
}

/// Shifts by cell and corner. Most cells are far from the sides, and have none.
#[derive(Debug, Default)]
pub(super) struct Shifts {
    /// By cell, which of the rows it has; [`Shifts::NOWHERE`] where all of it is nothing.
    row_of: Vec<u32>,
    /// Of a cell of the plane the last entry is nothing.
    rows: Vec<[Shift; 4]>,
}

impl Shifts {
    const NOWHERE: u32 = u32::MAX;

    /// The shifts of the corners of a cell.
    #[inline(always)]
    pub(super) fn of(&self, cell: usize) -> &[Shift; 4] {
        match self.row_of[cell] {
            Self::NOWHERE => &[HOME; 4],
            row => &self.rows[row as usize],
        }
    }

    /// Whether all of a cell are nothing.
    fn are_home(&self, cell: usize) -> bool {
        self.row_of[cell] == Self::NOWHERE
    }

    /// Makes room for so many cells.
    fn reserve(&mut self, n: usize) -> Result<()> {
        memory::reserve(&mut self.row_of, n)
    }

    /// The next cell has none.
    fn push_home(&mut self) -> Result<()> {
        memory::push(&mut self.row_of, Self::NOWHERE)
    }

    /// Enters those of the next cell.
    fn push(&mut self, row: [Shift; 4]) -> Result<()> {
        if row == [HOME; 4] {
            return self.push_home();
        }
        memory::push(&mut self.row_of, self.rows.len() as u32)?;
        memory::push(&mut self.rows, row)
    }

    /// The shifts of the cells in this order.
    pub(super) fn reordered(self, order: &[CellId]) -> Result<Self> {
        let mut row_of = Vec::new();
        memory::collect(&mut row_of, order.iter().map(|&cell| self.row_of[cell.index()]))?;
        Ok(Shifts { row_of, rows: self.rows })
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.row_of) + memory::bytes_of(&self.rows)
    }
}

/// The corners of a cell inside, in order.
type CornerRow = [u32; 4];

/// Rows have numbers that are as good as random in their low bits, once multiplied.
#[derive(Default)]
pub(super) struct RowHasher(u64);

impl Hasher for RowHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }

    fn write(&mut self, bytes: &[u8]) {
        for some in bytes.chunks(8) {
            let mut number = [0; 8];
            number[..some.len()].copy_from_slice(some);
            self.write_u64(u64::from_le_bytes(number));
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.write_u64(number.into());
    }

    fn write_usize(&mut self, number: usize) {
        self.write_u64(number as u64);
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = (self.0.rotate_left(5) ^ number).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}

/// The cells inside that have vertices at home and others, by their corners.
type Straddling = HashMap<[RowPart; 4], CellId, BuildHasherDefault<RowHasher>>;

/// A number of a row, which is hashed as such.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct RowPart(u32);

impl std::hash::Hash for RowPart {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        hasher.write_u32(self.0);
    }
}

fn key_of(mut row: CornerRow) -> [RowPart; 4] {
    row.sort_unstable();
    row.map(RowPart)
}

impl<G: Moving> PeriodicCells<G> {
    pub(super) fn none() -> Self {
        PeriodicCells {
            corners: Vec::new(),
            shifts: Shifts::default(),
            neighbours: Vec::new(),
            neighbour_shifts: Shifts::default(),
            least: Vec::new(),
            chosen: Vec::new(),
            class_of: Vec::new(),
            origins: Vec::new(),
        }
    }

    /// Reads all cells.
    pub(super) fn of(inside: &Inside<G>) -> Result<Self> {
        let mut read = Self::none();
        let cells = inside.t.cells()?;
        memory::lengthen(&mut read.class_of, cells.corners.len(), NO_CELL)?;
        // The cells that are translations of others that have been chosen, or will be, and by which shift.
        let mut others = Vec::new();
        let mut straddling = Straddling::default();
        for (cell, row) in cells.corners.iter().enumerate() {
            let n_home = row.as_ref().iter().filter(|v| inside.images.is_home(**v)).count();
            if n_home == 0 {
                continue;
            }
            let cell = CellId::at(cell);
            if n_home <= G::D {
                memory::reserve_map(&mut straddling, 1)?;
                straddling.insert(key_of(row_of(row)), cell);
            }
            let is_at_home = n_home > G::D;
            let least = if is_at_home { first_of(row.as_ref()) } else { inside.least(row)? };
            let shift = if is_at_home { HOME } else { inside.images.of(row.as_ref()[least]).shift };
            if shift == HOME {
                read.class_of[cell] = CellId::at(read.corners.len());
                read.push(inside, row, least, is_at_home)?;
                memory::push(&mut read.chosen, cell)?;
            } else {
                memory::push(&mut others, (cell, shift))?;
            }
        }
        let finder = Finder { inside, cells, straddling };
        memory::reserve_exact(&mut read.neighbours, read.chosen.len())?;
        read.neighbour_shifts.reserve(read.chosen.len())?;
        for (index, &cell) in read.chosen.iter().enumerate() {
            let is_at_home = read.shifts.are_home(index);
            let (mut row, mut shifts) = (G::Neighbours::filled(NO_CELL), None);
            for i in 0..=G::D {
                let beside = cells.neighbours[cell].as_ref()[i];
                // So far those that have been chosen alone have a class.
                let class = if is_at_home && beside != NO_CELL { read.class_of[beside] } else { NO_CELL };
                row[i] = class;
                if class == NO_CELL
                    && let Some((other, shift)) = finder.across(cell, i)?
                {
                    row[i] = read.class_of[other];
                    shifts.get_or_insert([HOME; 4])[i] = shift;
                }
            }
            read.neighbours.push(row);
            match shifts {
                None => read.neighbour_shifts.push_home()?,
                Some(shifts) => read.neighbour_shifts.push(shifts)?,
            }
        }
        for (cell, shift) in others {
            read.class_of[cell] = read.class_of[finder.translated(cell, shift)];
        }
        Ok(read)
    }

    fn push(&mut self, inside: &Inside<G>, row: &G::Vertices, least: usize, is_at_home: bool) -> Result<()> {
        let mut corners = *row;
        for i in 0..=G::D {
            corners[i] = inside.images.vertex(row.as_ref()[i]);
        }
        if is_at_home {
            self.shifts.push_home()?;
        } else {
            let mut shifts = [HOME; 4];
            let of_corners = row.as_ref().iter().map(|&inner| inside.images.of(inner).shift);
            shifts.iter_mut().zip(of_corners).for_each(|(entry, shift)| *entry = shift);
            self.shifts.push(shifts)?;
        }
        memory::push(&mut self.least, least as u8)?;
        memory::push(&mut self.corners, corners)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.corners)
            + self.shifts.memory_bytes()
            + memory::bytes_of(&self.neighbours)
            + self.neighbour_shifts.memory_bytes()
            + memory::bytes_of(&self.least)
            + memory::bytes_of(&self.chosen)
            + memory::bytes_of(&self.class_of)
            + memory::bytes_of(&self.origins)
    }
}

fn row_of<V: AsRef<[VertexId]>>(row: &V) -> CornerRow {
    let mut made = [u32::MAX; 4];
    made.iter_mut().zip(row.as_ref()).for_each(|(to, v)| *to = v.get());
    made
}

/// Finds translations of cells inside.
struct Finder<'t, G: Moving> {
    inside: &'t Inside<G>,
    cells: CellsView<'t, G>,
    straddling: Straddling,
}

impl<G: Moving> Finder<'_, G> {
    /// The cell that is the translation of one by less than nothing by a shift that takes one of its corners home; of two
    /// such cells one has a vertex at home and another one that is not.
    fn translated(&self, cell: CellId, shift: Shift) -> CellId {
        if shift == HOME {
            return cell;
        }
        let mut row = [u32::MAX; 4];
        for (to, &v) in row.iter_mut().zip(self.cells.corners[cell].as_ref()) {
            let image = self.inside.images.of(v);
            *to = self.inside.images.find(image.vertex, minus(image.shift, shift)).get();
        }
        self.straddling.get(&key_of(row)).copied().unwrap_or(NO_CELL)
    }

    /// The cell beyond the facet of one that is opposite a corner, with its least vertex at home, and by which shift that is
    /// to be translated to be there; none on the hull.
    fn across(&self, cell: CellId, corner: usize) -> Result<Option<(CellId, Shift)>> {
        let images = &self.inside.images;
        let row = self.cells.corners[cell];
        // What is beyond a facet is known if the facet has a vertex at home.
        let others = (0..=G::D).filter(|&i| i != corner).map(|i| images.of(row.as_ref()[i]).shift);
        let first = others.clone().find(|&shift| shift == HOME).or_else(|| others.clone().next());
        let shift = first.unwrap_or(HOME);
        let here = self.translated(cell, shift);
        let beyond = self.cells.neighbours[here].as_ref()[self.corner_like(cell, corner, here, shift)];
        if beyond == NO_CELL {
            return Ok(None);
        }
        let least = self.inside.least(&self.cells.corners[beyond])?;
        let home = images.of(self.cells.corners[beyond].as_ref()[least]).shift;
        let chosen = self.translated(beyond, home);
        Ok(Some((chosen, plus(home, shift))))
    }

    /// Which corner of a translation a corner is.
    fn corner_like(&self, cell: CellId, corner: usize, here: CellId, shift: Shift) -> usize {
        if here == cell {
            return corner;
        }
        let images = &self.inside.images;
        let image = images.of(self.cells.corners[cell].as_ref()[corner]);
        let wanted = images.find(image.vertex, minus(image.shift, shift));
        let row = self.cells.corners[here];
        row.as_ref().iter().position(|&v| v == wanted).expect("a translation has all corners")
    }
}

/// Which corner is the least of a cell with all at home, as vertices there are in the order of their ids inside.
#[inline(always)]
fn first_of(row: &[VertexId]) -> usize {
    (1..row.len()).fold(0, |least, i| if row[i] < row[least] { i } else { least })
}

impl<G: Moving> Inside<G> {
    /// Whether all corners of a cell are at home.
    fn is_at_home(&self, row: &G::Vertices) -> bool {
        row.as_ref().iter().all(|v| self.images.is_home(*v))
    }

    /// Which corner of a cell is the least: by vertex, and of several images of one, by position.
    pub(super) fn least(&self, row: &G::Vertices) -> Result<usize> {
        let (is_at_home, row) = (self.is_at_home(row), row.as_ref());
        if is_at_home {
            return Ok(first_of(row));
        }
        let mut least = 0;
        for i in 1..row.len() {
            let (u, w) = (self.images.of(row[i]).vertex, self.images.of(row[least]).vertex);
            let is_less = if u == w {
                let (p, q) = (self.t.position(row[i])?, self.t.position(row[least])?);
                p.as_ref().partial_cmp(q.as_ref()).is_some_and(std::cmp::Ordering::is_lt)
            } else {
                u < w
            };
            if is_less {
                least = i;
            }
        }
        Ok(least)
    }
}
