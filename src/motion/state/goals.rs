//! Where vertices are to go: what a commit is asked for.
//!
//! One type for a commit of positions that the caller lends, of all staged vertices, and of some: [`Moves`]. The array
//! is the caller's or the staging's, it is by vertex id, and nothing writes to it. Positions that are lent may be bad:
//! [`Goals`], from which they are read, are had by a check alone. The loops that move all vertices check on the way
//! ([`moving`](crate::motion::ways::moving)), and note that they have.
//!
//! Where the vertices were that have gone there is in [`origins`](super::origins).

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::prefetch::prefetch;
use crate::motion::state::checking::{are_good, check_position, first_bad};

/// Which vertices a commit moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Movers<'p> {
    /// Every vertex; none has been removed.
    All,
    /// The vertices of a list.
    Listed(&'p [VertexId]),
}

/// The moves of a commit.
#[derive(Debug)]
pub(in crate::motion) struct Moves<'p, G: Moving> {
    goals: &'p [G::Point],
    movers: Movers<'p>,
    are_checked: bool,
}

impl<'p, G: Moving> Moves<'p, G> {
    /// Of all vertices, to positions that have not been looked at.
    pub(in crate::motion) fn lent(positions: &'p [G::Point]) -> Self {
        Moves { goals: positions, movers: Movers::All, are_checked: false }
    }

    /// To positions that were checked when they were staged.
    pub(in crate::motion) fn staged(goals: &'p [G::Point], movers: Movers<'p>) -> Self {
        Moves { goals, movers, are_checked: true }
    }

    /// Which vertices they move.
    pub(in crate::motion) fn movers(&self) -> Movers<'p> {
        self.movers
    }

    /// Whether they move every vertex.
    pub(in crate::motion) fn are_of_all(&self) -> bool {
        self.movers == Movers::All
    }

    /// How many vertices they move.
    pub(in crate::motion) fn count(&self) -> usize {
        match self.movers {
            Movers::All => self.goals.len(),
            Movers::Listed(vertices) => vertices.len(),
        }
    }

    /// By vertex id, where they go that move: as they are, some perhaps bad.
    pub(in crate::motion) fn unchecked(&self) -> &'p [G::Point] {
        self.goals
    }

    /// Where they go that move. An error if a position is bad.
    pub(in crate::motion) fn checked(&mut self) -> Result<Goals<'p, G>> {
        let are_good = self.are_checked || are_good::<G>(self.goals);
        self.end_check(are_good)
    }

    /// Every position has been looked at, and they are good or not.
    pub(in crate::motion) fn end_check(&mut self, are_good: bool) -> Result<Goals<'p, G>> {
        if !are_good {
            return Err(first_bad::<G>(self.goals));
        }
        self.are_checked = true;
        Ok(Goals { positions: self.goals, n_movers: self.count() })
    }
}

/// Where the vertices of a commit go, each at a good place.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Goals<'p, G: Moving> {
    positions: &'p [G::Point],
    n_movers: usize,
}

impl<'p, G: Moving> Goals<'p, G> {
    /// Where a vertex goes, with the sign of zeros made positive.
    #[inline(always)]
    pub(in crate::motion) fn of(self, vertex: VertexId) -> G::Point {
        let mut goal = self.positions[vertex];
        (0..G::D).for_each(|axis| goal[axis] += 0.0);
        goal
    }

    /// Where a vertex goes, looked at once more: where the array is lent, a callback of the program may have written to it
    /// since the check.
    #[inline(always)]
    pub(in crate::motion) fn read(self, vertex: VertexId) -> Result<G::Point> {
        check_position::<G>("positions", vertex.index(), &self.positions[vertex])
    }

    /// By vertex id, where they go that move. Zeros may be negative.
    pub(in crate::motion) fn positions(self) -> &'p [G::Point] {
        self.positions
    }

    /// How many vertices the commit moves.
    pub(in crate::motion) fn n_movers(self) -> usize {
        self.n_movers
    }

    /// Asks for where a vertex goes.
    #[inline(always)]
    pub(in crate::motion) fn prefetch(self, vertex: VertexId) {
        prefetch(self.positions, vertex.index());
    }
}
