//! Circumcentres as Voronoi cells need them: of all cells, or of those around some vertices. With weights they are
//! power centres.
//!
//! Corners are taken in the order of a cell's row, which does not depend on its slot: as long as a cell has its index
//! and its corners have not moved, its centre is the same to the last bit.

use std::ops::Range;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::CellId;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::machine::{memory, threads};
use crate::motion::reading::geometry::clipping::Clip;
use crate::motion::state::cells::Cells;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::Measures;

/// A circumcentre is used where its radius, or with weights the length that says what it is off by, is at most so many
/// times the size of the box; a circumcentre in the box, of a cell of which a vertex is there, too, has less than half
/// of that.
const LARGEST_RADIUS: f64 = 4.0;

/// To compute this number of centres takes a few times as long as a thread takes to wake up.
pub(super) const SHARED_AT_LEAST: usize = 1 << 12;

/// Some of the indices from 0 on, numbered in ascending order.
pub(super) trait Numbering: Copy + Sync {
    /// The number of an index, if it is one of them.
    fn number(self, index: usize) -> Option<usize>;
}

/// Every index has its own number.
#[derive(Clone, Copy)]
pub(super) struct All;

impl Numbering for All {
    #[inline(always)]
    fn number(self, index: usize) -> Option<usize> {
        Some(index)
    }
}

/// Some of the indices below a bound.
#[derive(Debug)]
pub(super) struct Ranks {
    /// A bit for each index, and how many bits are set in the words before.
    words: Vec<(u64, u32)>,
}

impl Ranks {
    /// Of indices below `n`.
    pub(super) fn of(n: usize, chosen: impl Iterator<Item = usize>) -> Result<Self> {
        let mut words = Vec::new();
        memory::lengthen(&mut words, n.div_ceil(64), (0u64, 0))?;
        for index in chosen {
            words[index / 64].0 |= 1 << (index % 64);
        }
        let mut before = 0;
        for (bits, first) in &mut words {
            *first = before;
            before += bits.count_ones();
        }
        Ok(Ranks { words })
    }
}

impl Numbering for &Ranks {
    #[inline(always)]
    fn number(self, index: usize) -> Option<usize> {
        let (bits, first) = self.words[index / 64];
        let bit = 1u64 << (index % 64);
        (bits & bit != 0).then(|| first as usize + (bits & (bit - 1)).count_ones() as usize)
    }
}

/// What is known of the circumcentre of a cell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Centre<P> {
    /// Infinite where it is not accurate for the box. In the place of a weight is the length that says what it is off
    /// by.
    pub(super) place: P,
    /// The faces of the box that it is beyond, by their bits; none without a box. [`BEYOND`] if it is beyond a
    /// half-space.
    pub(super) sides: u8,
}

/// The bit of all half-spaces.
pub(super) const BEYOND: u8 = 1 << 7;

impl<P> Centre<P> {
    /// The faces of the box that it is beyond, by their bits.
    #[inline(always)]
    pub(super) fn faces(&self) -> u8 {
        self.sides & !BEYOND
    }
}

impl<P: AsRef<[f64]>> Centre<P> {
    /// Whether it is in the box, and in the half-spaces.
    #[inline(always)]
    pub(super) fn fits(&self) -> bool {
        self.sides == 0 && self.place.as_ref()[0].is_finite()
    }
}

/// The circumcentres of all cells, or of chosen ones.
#[derive(Debug)]
pub(super) struct Centres<'c, P> {
    pub(super) list: Vec<Centre<P>>,
    /// The chosen cells, ascending, and their numbers.
    pub(super) chosen: Option<(&'c [CellId], Ranks)>,
}

impl<P> Centres<'_, P> {
    /// There are none.
    pub(super) const NONE: Self = Centres { list: Vec::new(), chosen: None };

    /// The circumcentre of a cell, which is one of the chosen ones.
    #[inline(always)]
    pub(super) fn of(&self, cell: CellId) -> &Centre<P> {
        match &self.chosen {
            None => &self.list[cell.index()],
            Some((_, ranks)) => &self.list[ranks.number(cell.index()).expect("a chosen cell")],
        }
    }

    /// The cell that has a number.
    #[inline(always)]
    pub(super) fn cell(&self, number: usize) -> CellId {
        match &self.chosen {
            None => CellId::new(number as u32),
            Some((cells, _)) => cells[number],
        }
    }
}

impl<'c, P: Copy + Default + Send + Sync> Centres<'c, P> {
    /// Of all cells, or of `chosen` ones, which are ascending.
    pub(super) fn new<G: Moving<Point = P>>(
        t: &MovingTriangulation<G>,
        cells: &Cells<G>,
        clip: Option<&Clip>,
        chosen: Option<&'c [CellId]>,
    ) -> Result<Self> {
        let n_cells = cells.corners().len();
        let with_ranks =
            |chosen: &'c [CellId]| Ok((chosen, Ranks::of(n_cells, chosen.iter().map(|cell| cell.index()))?));
        let mut centres = Centres { list: Vec::new(), chosen: chosen.map(with_ranks).transpose()? };
        let n = chosen.map_or(n_cells, <[CellId]>::len);
        let mut list = Vec::new();
        memory::lengthen(&mut list, n, Centre::default())?;
        let n_threads = t.mesh.kernel.threads().for_work(n, SHARED_AT_LEAST, 64);
        threads::for_parts(&mut list, 0, n_threads, &|first, part: &mut [Centre<P>]| {
            for (number, centre) in (first..).zip(part) {
                ask_for(t, cells, number + AHEAD..n, |number| centres.cell(number));
                *centre = centre_of(t, cells, clip, centres.cell(number));
            }
        });
        centres.list = list;
        Ok(centres)
    }
}

/// Asks for what a cell is read from that comes later, and for the corners of one that comes sooner.
#[inline(always)]
pub(super) fn ask_for<G: Moving>(
    t: &MovingTriangulation<G>,
    cells: &Cells<G>,
    later: Range<usize>,
    cell: impl Fn(usize) -> CellId,
) {
    let kernel = &t.mesh.kernel;
    if later.is_empty() {
        return;
    }
    prefetch(kernel.complex().cells(), cells.slots()[cell(later.start)].index());
    let sooner = cells.slots()[cell(later.start - AHEAD / 2)];
    for s in kernel.complex().cell(sooner).corners.as_ref() {
        prefetch(kernel.sites(), s.index());
    }
}

#[inline(always)]
fn centre_of<G: Moving>(
    t: &MovingTriangulation<G>,
    cells: &Cells<G>,
    clip: Option<&Clip>,
    cell: CellId,
) -> Centre<G::Point> {
    let kernel = &t.mesh.kernel;
    let sites = cells.sites(kernel, cell);
    let at = |k: usize| kernel.place(sites[k.min(G::D)]);
    let places = [at(0), at(1), at(2), at(3)];
    let (mut place, squared) = G::Point::centre(&places[..=G::D]);
    if G::HAS_WEIGHTS {
        place[G::D] = squared.sqrt();
    }
    let Some(clip) = clip else { return Centre { place, sides: 0 } };
    let sides = clip.sides::<G>(&place, squared, &places[..=G::D]);
    let most = LARGEST_RADIUS * clip.size;
    if squared > most * most {
        place[0] = f64::INFINITY;
    }
    Centre { place, sides }
}
