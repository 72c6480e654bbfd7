//! How many vertices refinement has made, beside what it would make anew.
//!
//! A mesh whose vertices move is refined and coarsened again and again, and may get denser than one that is made anew. How
//! many vertices that would have is known from the last time that it was made so, or is the least number since. When
//! coarsening leaves more by a factor, or has been asked for larger cells, the next refinement compares; otherwise it does if it
//! would itself have more. Without a coarsening before it takes nothing away.

/// A change of bounds that changes the number of vertices by less than this share is none: a program may change them a bit in
/// each step.
const CHANGE: f64 = 0.1;

/// From these on cells are much larger: by so many degrees, or by this factor of the areas.
const LESS_ANGLE: f64 = 1.0;
const MORE_AREA: f64 = 1.5;

/// After so many insertions and removals for each vertex refinement compares as well: fewer vertices may do by now.
const CHURN: u64 = 4;

/// So few vertices are always compared: that takes no time, and a vertex more or less is a large share.
const FEW: usize = 64;

/// Bounds that have been asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::motion) struct Asked {
    /// The least angle, in degrees.
    pub(in crate::motion) angle: f64,
    /// The sum of the greatest areas, of all and by label.
    pub(in crate::motion) area: f64,
}

impl Asked {
    /// Whether it asks for much larger cells than this.
    fn is_coarser_than(&self, other: &Self) -> bool {
        self.angle < other.angle - LESS_ANGLE || self.area > other.area * MORE_AREA
    }
}

/// What is known of a mesh made anew.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::motion) struct Density {
    /// How many vertices it had; 0 if that is not known.
    n_fresh: u64,
    /// Insertions and removals since that was known.
    churn: u64,
    /// What refinement and coarsening have been asked for last.
    refined: Asked,
    coarsened: Asked,
    /// The timestamp that the last refinement reached.
    refined_at: u64,
    due: Option<Due>,
}

/// On which terms the next refinement may take vertices away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::motion) struct Due {
    /// The factor by which there may be more vertices: 1 or more.
    pub(in crate::motion) growth: f64,
    /// By which share of a distance vertices between pieces that are joined may be off.
    pub(in crate::motion) joins: f64,
    /// Whether it is to compare in any case.
    pub(in crate::motion) is_certain: bool,
}

impl Density {
    /// The timestamp that the last refinement reached.
    pub(in crate::motion) fn refined_at(&self) -> u64 {
        self.refined_at
    }

    /// Whether so many vertices are too many, as far as is known.
    pub(in crate::motion) fn is_grown(&self, n: usize, growth: f64) -> bool {
        n as f64 > growth * self.n_fresh as f64
    }

    /// What is due, if anything.
    pub(in crate::motion) fn due(&self) -> Option<Due> {
        self.due
    }

    /// Whether `n_changed` vertices of `n` have changed as other bounds are asked for.
    fn has_changed(&self, asked: Asked, n_changed: usize, n: usize) -> bool {
        asked != self.refined && asked != self.coarsened && n_changed as f64 > CHANGE * n as f64
    }

    /// Coarsening has ended with `n` vertices, at a timestamp. `due` tells the numbers.
    pub(in crate::motion) fn set_coarsened(
        &mut self,
        [n, n_removed]: [usize; 2],
        asked: Asked,
        timestamp: u64,
        due: Due,
    ) {
        if n == 0 {
            *self = Density::default();
            return;
        }
        self.churn += n_removed as u64;
        let is_other = self.has_changed(asked, n_removed, n + n_removed)
            || asked.is_coarser_than(&self.refined) && asked.is_coarser_than(&self.coarsened);
        let is_grown = self.is_grown(n, due.growth) || self.churn > CHURN * n as u64;
        let may_have_grown = (is_grown || n <= FEW) && timestamp != self.refined_at;
        // What one call has found another one, of which it is no news, does not take back.
        let was_certain = self.due.is_some_and(|due| due.is_certain);
        let due = Due { is_certain: was_certain || is_other || may_have_grown, ..due };
        self.due = (due.growth < f64::INFINITY).then_some(due);
        self.n_fresh = self.n_fresh.min(n as u64);
        self.coarsened = asked;
    }

    /// Refinement has ended with `n` vertices, at a timestamp; `n_fresh` if it has compared with a mesh made anew.
    pub(in crate::motion) fn set_refined(
        &mut self,
        [n, n_inserted]: [usize; 2],
        n_fresh: Option<usize>,
        asked: Asked,
        timestamp: u64,
    ) {
        // Nothing is known of vertices that are no more.
        if n_inserted == n {
            *self = Density::default();
        }
        let has_changed = self.has_changed(asked, n_inserted, n);
        self.churn += n_inserted as u64;
        if let Some(fresh) = n_fresh.or((has_changed || n_inserted == n).then_some(n)) {
            (self.n_fresh, self.churn) = (fresh as u64, 0);
        }
        self.n_fresh = self.n_fresh.min(n as u64);
        if n > 0 {
            (self.refined, self.refined_at) = (asked, timestamp);
        }
        self.due = None;
    }

    /// As it is saved.
    pub(in crate::motion) fn numbers(&self) -> [u64; 10] {
        let Density { n_fresh, churn, refined, coarsened, refined_at, due } = self;
        let [growth, joins] = due.map_or([0.0; 2], |due| [due.growth, due.joins]);
        let [a, b, c, d, e, f] =
            [refined.angle, refined.area, coarsened.angle, coarsened.area, growth, joins].map(f64::to_bits);
        let is_certain = due.is_some_and(|due| due.is_certain);
        [u64::from(is_certain), *n_fresh, *churn, *refined_at, a, b, c, d, e, f]
    }

    /// As it was saved; none if the numbers have no meaning.
    pub(in crate::motion) fn of_numbers(
        [is_certain, n_fresh, churn, refined_at, numbers @ ..]: [u64; 10],
    ) -> Option<Self> {
        let [a, b, c, d, growth, joins] = numbers.map(f64::from_bits);
        let are_bounds = [a, b, c, d].iter().all(|&x| x >= 0.0 && x.is_sign_positive());
        let is_due = (1.0..f64::INFINITY).contains(&growth) && (0.0..=1.0).contains(&joins);
        let is_none = numbers[4] == 0 && numbers[5] == 0 && is_certain == 0;
        let (refined, coarsened) = (Asked { angle: a, area: b }, Asked { angle: c, area: d });
        let due = is_due.then_some(Due { growth, joins, is_certain: is_certain == 1 });
        let are_counts = n_fresh <= u64::from(u32::MAX) && churn.max(refined_at) < 1 << 62 && is_certain <= 1;
        (are_bounds && (is_due || is_none) && are_counts).then_some(Density {
            n_fresh,
            churn,
            refined,
            coarsened,
            refined_at,
            due,
        })
    }
}
