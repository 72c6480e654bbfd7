//! Candidates of coarsening that surely stay, found in one pass over the cells: in a fraction of the time of a look
//! around each.
//!
//! What takes the place of a vertex is a triangulation of the polygon around it. It has two triangles fewer than there
//! were, or one where all are on one side of a segment: their areas tell whether all could be small enough. And if the
//! polygon has four corners or more, two of the triangles are ears: a corner with those before and behind it. So where
//! all ears but one would have an edge that is too long, the vertex stays. The corners opposite an edge are the ends
//! of the edge that an ear has in the polygon around either end of it, so that all are found by a look at each edge.

use super::coarsening::{Candidate, Room};
use super::criteria::Tests;
use super::given::Given;
use super::parts::{next, previous};
use crate::error::Result;
use crate::ids::CellId;
use crate::machine::memory;

/// Sums of so many shares are off by less than this share.
const ROUNDING: f64 = 1e-12;

/// The selected cells around a candidate that has to be looked at.
#[derive(Clone, Copy, Debug, Default)]
struct Around {
    is_asked: bool,
    /// How many there are.
    n: u32,
    /// Of the edges between them, those that no ear has to be too long for.
    n_short: u32,
    /// The sum of the shares that they have of the greatest areas for them, or a bit less.
    share: f64,
}

/// Marks the candidates as kept that surely stay, those in no selected cell among them.
pub(crate) fn keep(
    given: Given,
    points: &[[f64; 2]],
    tests: &Tests,
    room: Room,
    candidates: &mut [Candidate],
) -> Result<()> {
    let mut around = Vec::new();
    memory::lengthen(&mut around, points.len(), Around::default())?;
    for candidate in candidates.iter().filter(|candidate| !candidate.is_kept) {
        around[candidate.vertex].is_asked = true;
    }
    let has_areas = tests.has_areas();
    for (c, row) in given.corners.iter().enumerate() {
        let is_asked = row.map(|v| around[v].is_asked);
        if given.mask[c] == 0 || is_asked == [false; 3] {
            continue;
        }
        let share = match has_areas {
            true => tests.share_of_area(row.map(|v| &points[v]), given.label(c as u32)),
            false => 0.0,
        };
        for &v in row {
            around[v].n += 1;
            around[v].share += share;
        }
        if tests.has_sizes() {
            look_at_edges(&given, points, tests, room.share, c, &mut around);
        }
    }
    for candidate in candidates.iter_mut().filter(|candidate| !candidate.is_kept) {
        let is_inside = candidate.between.is_none();
        let around = &around[candidate.vertex];
        let has_short_ears = !is_inside || !tests.has_sizes() || around.n < 4 || around.n_short >= 2;
        candidate.is_kept = !(has_short_ears && around.has_room(room.share, is_inside));
    }
    Ok(())
}

impl Around {
    /// Whether the cells that come could all have this share of the greatest areas.
    fn has_room(&self, share: f64, is_inside: bool) -> bool {
        let n_coming = f64::from(self.n) - if is_inside { 2.0 } else { 1.0 };
        self.share <= n_coming * share * (1.0 + ROUNDING)
    }
}

/// Counts the ears that are not too long, for the first end of each edge of a cell: for the other one, that is done
/// from the cell across.
#[inline(always)]
fn look_at_edges(
    given: &Given,
    points: &[[f64; 2]],
    tests: &Tests,
    share: f64,
    cell: usize,
    around: &mut [Around],
) {
    let sizes = tests.given_sizes();
    let (row, neighbours) = (given.corners[cell], given.neighbours[cell]);
    for i in 0..3 {
        if neighbours[i] == CellId::NONE {
            continue;
        }
        let across = neighbours[i].index();
        let beyond = given.neighbours[across];
        let j = usize::from(beyond[1].index() == cell) + 2 * usize::from(beyond[2].index() == cell);
        let [first, other] = [row[next(i)], row[previous(i)]];
        // The ear in the polygon around the one end is at the other.
        let [p, q] = [row[i], given.corners[across][j]];
        let is_long =
            tests.is_longer_than([&points[p], &points[q]], sizes[p] + sizes[q] + sizes[other], share);
        around[first].n_short += u32::from(!is_long);
    }
}
