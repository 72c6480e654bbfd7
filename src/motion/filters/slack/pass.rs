//! One pass over bi-cells: they are checked, if that is to be, and their tolerances computed, several at a time.

use crate::complex::Facet;
use crate::delaunay::{Delaunay, Failures, Moving};
use crate::error::Result;
use crate::predicates::{BiCellTolerances, LANES};

/// A tolerance of this share of what there is will do: to look for spheres where planes leave as much takes longer
/// than to compute the bi-cell again sooner.
const SHARE: f64 = 0.25;

/// Whether bi-cells that are computed are checked before.
pub(super) enum CheckFirst<'c, G: Moving> {
    /// All are known to hold.
    Not,
    /// All are checked after a motion. In turn: where the vertices were before, by id; a distance that none has
    /// exceeded; where failures are listed; and the error, if the check fails.
    Moved(&'c [G::Point], f64, &'c mut Failures, &'c mut Result<()>),
}

/// One pass over bi-cells, some of which wait to be computed together.
pub(super) struct Pass<'c, G: Moving> {
    check: CheckFirst<'c, G>,
    bicells: <G::Point as BiCellTolerances>::BiCells,
    facets: [[Facet; 2]; LANES],
    n: usize,
}

impl<'c, G: Moving> Pass<'c, G> {
    pub(super) fn new(check: CheckFirst<'c, G>) -> Self {
        Pass { check, bicells: Default::default(), facets: [[Facet::NONE; 2]; LANES], n: 0 }
    }

    /// Adds an interior bi-cell: its facet from both sides, and the places of its vertices. Whether the batch is full.
    #[inline(always)]
    pub(super) fn push(&mut self, sides: [Facet; 2], points: &[&G::Point]) -> bool {
        G::Point::set_bicell(&mut self.bicells, self.n, points);
        self.facets[self.n] = sides;
        self.n += 1;
        self.n == LANES
    }

    /// Checks the bi-cells of the batch, if they are to be checked, and hands each on with its tolerance, none if it
    /// has failed. Tolerances need not be sharp if they are `enough`. The batch is empty then.
    #[inline(always)]
    pub(super) fn empty(
        &mut self,
        kernel: &Delaunay<G>,
        enough: f64,
        mut hand_on: impl FnMut([Facet; 2], Option<f64>),
    ) {
        let n = std::mem::take(&mut self.n);
        if n == 0 {
            return;
        }
        let hold = match &self.check {
            CheckFirst::Moved(..) => G::Point::bicells_hold(kernel.filter(), &self.bicells),
            CheckFirst::Not => [true; LANES],
        };
        let tolerances = G::Point::tolerances(&self.bicells, [enough; LANES], SHARE);
        for k in 0..n {
            let sides = self.facets[k];
            let holds = hold[k] || self.holds(kernel, sides[0]);
            hand_on(sides, holds.then_some(tolerances[k]));
        }
    }

    /// Whether a bi-cell at the hull, of this tolerance, holds.
    pub(super) fn holds_at_hull(&mut self, kernel: &Delaunay<G>, facet: Facet, tolerance: f64) -> bool {
        // What tolerates the way back was positive all the way.
        let tolerates = matches!(&self.check, CheckFirst::Moved(_, greatest, ..) if tolerance > *greatest);
        tolerates || self.holds(kernel, facet)
    }

    #[cold]
    #[inline(never)]
    fn holds(&mut self, kernel: &Delaunay<G>, facet: Facet) -> bool {
        match &mut self.check {
            CheckFirst::Not => true,
            CheckFirst::Moved(before, _, failures, checked) => {
                let holds = kernel.check_bicell(facet, before, failures);
                holds.unwrap_or_else(|error| {
                    **checked = Err(error);
                    false
                })
            }
        }
    }
}
