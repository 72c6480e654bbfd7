//! Boxes that move, and a tree of them: which segments vertices may pass on their way.
//!
//! A box has a place before and one after, and each of its faces goes straight in between. What is in it at both times
//! and goes straight is in it all the way. So two things can meet only if at some time each box reaches the other along
//! both axes: four inequalities that are linear in time. Boxes that cover ways from end to end would do as well for short
//! steps, but in a motion that takes all along, as a long translation or a rotation, each of them would meet most others.
//!
//! # Rounding
//!
//! The gap d between two faces at either time is a rounded difference, and has the sign of the exact one. Where it is d₀
//! < 0 before and d₁ ≥ 0 after, the boxes cannot meet before the time d₀ / (d₀ − d₁): two differences off by at most a
//! share u of themselves each, a sum of magnitudes and a quotient. The exact quotient is off from the computed one by
//! less than 8 u of it, and by the least normal number where it underflows. That much is conceded.

use crate::error::{Passing, Result};
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::predicates::passes;

/// Boxes below one.
const FAN: usize = 4;

/// Levels of a tree of so many segments as there are ids.
const LEVELS: usize = 17;

/// A straight way.
#[derive(Clone, Copy, Debug)]
pub(super) struct StraightPath {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
}

impl StraightPath {
    fn places(&self) -> [&[f64; 2]; 2] {
        [&self.from, &self.to]
    }

    fn is_still(&self) -> bool {
        self.from == self.to
    }
}

/// A vertex on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walker {
    pub(super) vertex: VertexId,
    pub(super) path: StraightPath,
}

/// A segment on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swept {
    pub(super) id: SegmentId,
    pub(super) ends: [Walker; 2],
    /// What segments are sorted by, so that those after one another are near each other.
    pub(super) place: u32,
}

impl Swept {
    /// Whether it stays where it is.
    pub(super) fn is_still(&self) -> bool {
        self.ends.iter().all(|end| end.path.is_still())
    }

    fn moving_box(&self) -> MovingBox {
        MovingBox::of(&self.ends)
    }

    /// Whether a vertex passes it.
    fn is_passed_by(&self, walker: &Walker) -> bool {
        let [a, b] = &self.ends;
        walker.vertex != a.vertex
            && walker.vertex != b.vertex
            && passes(walker.path.places(), a.path.places(), b.path.places())
    }
}

/// Looks at each of some vertices with each of some segments.
pub(super) fn look_at_pairs(segments: &[Swept], walkers: &[Walker], found: &mut Vec<Passing>) -> Result<()> {
    for segment in segments {
        for walker in walkers.iter().filter(|walker| segment.is_passed_by(walker)) {
            memory::push(found, Passing { segment: segment.id, vertex: walker.vertex })?;
        }
    }
    Ok(())
}

/// A box before and after a step.
#[derive(Clone, Copy, Debug)]
struct MovingBox {
    low: [[f64; 2]; 2],
    high: [[f64; 2]; 2],
}

impl MovingBox {
    const EMPTY: MovingBox = MovingBox { low: [[f64::INFINITY; 2]; 2], high: [[f64::NEG_INFINITY; 2]; 2] };

    /// The one around vertices on their ways.
    fn of(walkers: &[Walker]) -> Self {
        walkers.iter().fold(Self::EMPTY, |grown, walker| {
            let places = [walker.path.from, walker.path.to];
            grown.with(&MovingBox { low: places, high: places })
        })
    }

    /// The one around both.
    #[inline(always)]
    fn with(mut self, other: &Self) -> Self {
        // Nothing is NaN, and an instruction each does without that.
        let lower = |x: f64, y: f64| if x < y { x } else { y };
        let higher = |x: f64, y: f64| if x > y { x } else { y };
        for time in 0..2 {
            for axis in 0..2 {
                self.low[time][axis] = lower(self.low[time][axis], other.low[time][axis]);
                self.high[time][axis] = higher(self.high[time][axis], other.high[time][axis]);
            }
        }
        self
    }

    /// Whether two may meet on their ways: false only if they certainly do not. Neither is empty.
    #[inline(always)]
    fn may_meet(&self, other: &Self) -> bool {
        let are_apart = |low: &Self, high: &Self, axis: usize| {
            (low.high[0][axis] < high.low[0][axis]) & (low.high[1][axis] < high.low[1][axis])
        };
        let are_apart_along = |axis: usize| are_apart(self, other, axis) | are_apart(other, self, axis);
        !are_apart_along(0) && !are_apart_along(1) && self.may_meet_between(other)
    }

    /// Whether two may meet that are not on one side of each other along an axis both before and after.
    fn may_meet_between(&self, other: &Self) -> bool {
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for axis in 0..2 {
            for (high, low) in [(&self.high, &other.low), (&other.high, &self.low)] {
                let [before, after] = [0, 1].map(|time| high[time][axis] - low[time][axis]);
                match (before < 0.0, after < 0.0) {
                    (false, false) | (true, true) => {}
                    (true, false) => from = from.max(crossing([before, after])[0]),
                    (false, true) => to = to.min(crossing([before, after])[1]),
                }
            }
        }
        from <= to
    }
}

/// Bounds of the time at which a gap of one sign before and another after is zero.
fn crossing([before, after]: [f64; 2]) -> [f64; 2] {
    let time = before / (before - after);
    let error = 4.0 * f64::EPSILON * time + f64::MIN_POSITIVE;
    [time - error, time + error]
}

/// Segments, with a box around each [`FAN`] of them, around each so many of these, and so on.
#[derive(Debug)]
pub(super) struct SegmentTree {
    segments: Vec<Swept>,
    /// The boxes of one level after the other, the lowest first.
    boxes: Vec<MovingBox>,
    /// Where in the boxes each level begins, and, after the last, where it ends.
    begins: [usize; LEVELS + 1],
    n_levels: usize,
}

impl SegmentTree {
    /// A tree of segments, of which there is one at least.
    pub(super) fn new(unsorted: Vec<Swept>) -> Result<Self> {
        let (mut order, mut segments) = (Vec::new(), Vec::new());
        memory::collect(&mut order, unsorted.iter().map(|segment| segment.place).zip(0u32..))?;
        order.sort_unstable();
        memory::collect(&mut segments, order.iter().map(|&(_, k)| unsorted[k as usize]))?;
        let mut boxes = Vec::new();
        // A geometric series, and one more box on each level at most.
        memory::reserve(&mut boxes, segments.len().div_ceil(FAN - 1) + LEVELS)?;
        boxes.extend(segments.chunks(FAN).map(|few| {
            few.iter().fold(MovingBox::EMPTY, |grown, segment| grown.with(&segment.moving_box()))
        }));
        let mut begins = [0; LEVELS + 1];
        begins[1] = boxes.len();
        let mut n_levels = 1;
        while begins[n_levels] - begins[n_levels - 1] > 1 {
            let (first, end) = (begins[n_levels - 1], begins[n_levels]);
            for k in (first..end).step_by(FAN) {
                let below = &boxes[k..end.min(k + FAN)];
                let around = below.iter().fold(MovingBox::EMPTY, |grown, below| grown.with(below));
                boxes.push(around);
            }
            n_levels += 1;
            begins[n_levels] = boxes.len();
        }
        Ok(SegmentTree { segments, boxes, begins, n_levels })
    }

    /// Looks for segments that some vertices pass.
    pub(super) fn look_at(&self, walkers: &[Walker], found: &mut Vec<Passing>) -> Result<()> {
        if walkers.is_empty() {
            return Ok(());
        }
        self.descend(self.n_levels - 1, 0, &MovingBox::of(walkers), walkers, found)
    }

    fn descend(
        &self,
        level: usize,
        index: usize,
        around: &MovingBox,
        walkers: &[Walker],
        found: &mut Vec<Passing>,
    ) -> Result<()> {
        if !self.boxes[self.begins[level] + index].may_meet(around) {
            return Ok(());
        }
        if level == 0 {
            let few = &self.segments[FAN * index..self.segments.len().min(FAN * (index + 1))];
            return few
                .iter()
                .filter(|segment| segment.moving_box().may_meet(around))
                .try_for_each(|segment| look_at_pairs(std::slice::from_ref(segment), walkers, found));
        }
        let n_below = self.begins[level] - self.begins[level - 1];
        (FAN * index..n_below.min(FAN * (index + 1)))
            .try_for_each(|below| self.descend(level - 1, below, around, walkers, found))
    }
}
