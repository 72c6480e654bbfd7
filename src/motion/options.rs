//! What the caller chooses, and what a commit reports.

use std::fmt;
use std::ops::ControlFlow;

use crate::delaunay::Moving;
pub use crate::machine::pace::Monitor;
use crate::motion::algorithms::Algorithm;
use crate::refine::Kept;

/// When *rebuilding + tolerance* swaps from the one to the other: by default as in the report. (`make calibrate`
/// measures other values.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwitchingRule {
    /// Vertices sampled each time, at most as many as there are.
    pub sample: u32,
    /// Commits from one sample to the next.
    pub period: u32,
    /// Share of the sample, from 0 to 1, that must be within tolerance; `None` for the report's: 0.75 in the plane,
    /// 0.55 in space.
    pub share: Option<f64>,
    /// Seed of the sample.
    pub seed: u64,
}

impl Default for SwitchingRule {
    fn default() -> Self {
        SwitchingRule { sample: 40, period: 4, share: None, seed: 0 }
    }
}

impl SwitchingRule {
    /// The share in force in a dimension.
    pub(super) fn share_for<G: Moving>(&self) -> f64 {
        self.share.unwrap_or(if G::D == 2 { 0.75 } else { 0.55 })
    }
}

/// What happens when vertices come to lie at the same place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoincidencePolicy {
    /// The lowest id represents the place, the others are hidden until they move apart.
    #[default]
    Merge,
    /// The call fails with [`Error::Coincident`](crate::Error::Coincident) and has no effect.
    Reject,
}

/// What happens when a vertex would *pass* a segment: when it comes from one side of it to the other on the way from its
/// old place to its new one, which is straight for it and for the ends of the segment.
/// [`check_passings`](super::MovingTriangulation::check_passings) says more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PassingPolicy {
    /// Nothing: it is not looked for.
    #[default]
    Ignore,
    /// The call goes on, and [`passings`](super::MovingTriangulation::passings) has those that pass.
    Tell,
    /// The call fails with [`Error::Passing`](crate::Error::Passing) and has no effect.
    Refuse,
}

/// Options of a triangulation.
///
/// ```
/// use deldrift::{Error, Plane, motion::{CoincidencePolicy, MovingTriangulation, Options}};
///
/// let options = Options { threads: 1, coincidence: CoincidencePolicy::Reject, ..Options::default() };
/// let twice = MovingTriangulation::<Plane>::new(&[[0.5, 0.5], [0.5, 0.5]], options);
/// assert!(matches!(twice, Err(Error::Coincident { .. })));
///
/// // A monitor is told how far a call is, and ends it when it returns `false`.
/// let options = Options { monitor: Some(Box::new(|_fraction| false)), ..Options::default() };
/// let many: Vec<_> = (0..20_000).map(|i| [i as f64, (i * i % 1_009) as f64]).collect();
/// assert_eq!(MovingTriangulation::<Plane>::new(&many, options).err(), Some(Error::Cancelled));
/// ```
#[derive(Default)]
pub struct Options {
    /// Algorithm of [`commit_timestamp`](super::MovingTriangulation::commit_timestamp).
    pub algorithm: Algorithm,
    /// Greatest number of threads for building, and for the moves, the sweep and the flips of [`Algorithm::Repair`];
    /// the rest of the work is done by the calling thread alone. 0, the default, is no limit. As many are used as pay,
    /// and no more than the system runs at the same time (asked once): one for each 5,000 vertices of a build in the
    /// plane or 2,500 in space, for each 16,384 cells of a sweep, and for each 500 facets from which to flip. All
    /// triangulations share them. They are kept, and sleep between calls.
    ///
    /// The cells do not depend on it. Their order does unless [`parts`](Self::parts) says otherwise, and so do the counts of
    /// flips, placements and exact signs, as those depend on the order.
    pub threads: u32,
    /// Greatest number of parts into which work is divided where that shows in the order of cells: builds, and flips of
    /// [`Algorithm::Repair`]. 0, the default, is one for each thread that is used. With any other number all answers are
    /// the same for any number of threads: the order of cells, every bit of rounded numbers, and reports. (A build for
    /// whose parts there is no memory is in one.) More threads than parts have nothing to do in this work, and a build takes
    /// longer in more parts than there are threads: for 100,000 vertices one thread takes 1.1 times as long in eight parts
    /// as in one in the plane; in space 1.06 times in two, 1.1 in four and 1.3 in eight; for 20,000 1.2 times in the plane,
    /// 1.15 to 1.6 times in space.
    pub parts: usize,
    /// Coincident vertices.
    pub coincidence: CoincidencePolicy,
    /// Vertices that pass segments.
    pub passing: PassingPolicy,
    /// Progress and cancellation, of creation, loading, commits, and immediate calls that take long.
    pub monitor: Option<Monitor>,
}

impl fmt::Debug for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Options")
            .field("algorithm", &self.algorithm)
            .field("threads", &self.threads)
            .field("parts", &self.parts)
            .field("coincidence", &self.coincidence)
            .field("passing", &self.passing)
            .field("monitor", &self.monitor.is_some())
            .finish()
    }
}

/// Says whether a cell with corners at these places is too large, or breaks the call off, which then has no effect.
pub type TooLarge<'a> = &'a dyn Fn([[f64; 2]; 3]) -> ControlFlow<(), bool>;

/// What [`refine`](super::MovingTriangulation::refine) and [`coarsen`](super::MovingTriangulation::coarsen) work towards.
///
/// ```
/// use deldrift::motion::Quality;
///
/// let quality = Quality { least_angle: 30.0, greatest_area: 0.01, ..Quality::default() };
/// assert!(quality.sizes.is_none());
/// ```
#[derive(Clone, Copy, Default)]
pub struct Quality<'a> {
    /// The least angle of a cell in degrees, up to [`MAX_LEAST_ANGLE`]; 0 for any.
    pub least_angle: f64,
    /// The greatest area of a cell; 0 for any.
    pub greatest_area: f64,
    /// A label for each cell, in the order of [`cells`](super::MovingTriangulation::cells).
    pub labels: Option<&'a [u32]>,
    /// The greatest area of cells by label, 0 for any; labels beyond may have any.
    pub areas: &'a [f64],
    /// By vertex id the greatest length of edges there: no edge of a cell is longer than the mean at its corners. New
    /// vertices have what is between.
    pub sizes: Option<&'a [f64]>,
    /// Another criterion, which has to be the same for the same corners. All cells have to be small enough at some size.
    pub is_too_large: Option<TooLarge<'a>>,
    /// Whether no corner of a cell is to be inside the circle around a segment at the cell: then all cells are Delaunay,
    /// segments or not. With angles up to 20.7 degrees that is proved to be reached; without it up to 26.5.
    pub is_conforming: bool,
}

/// Greatest [`least_angle`](Quality::least_angle): above, refinement often has no end.
pub const MAX_LEAST_ANGLE: f64 = 34.0;

impl fmt::Debug for Quality<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Quality")
            .field("least_angle", &self.least_angle)
            .field("greatest_area", &self.greatest_area)
            .field("labels", &self.labels.map(<[u32]>::len))
            .field("areas", &self.areas)
            .field("sizes", &self.sizes.map(<[f64]>::len))
            .field("is_too_large", &self.is_too_large.is_some())
            .field("is_conforming", &self.is_conforming)
            .finish()
    }
}

/// How [`refine`](super::MovingTriangulation::refine) may reach the quality.
#[derive(Clone, Copy, Debug)]
pub struct RefineOptions {
    /// Which segments stay whole. Cells at them may then stay bad.
    pub keeps: Kept,
    /// Greatest number of vertices added.
    pub limit: usize,
    /// Whether [`refined_weights`](super::MovingTriangulation::refined_weights) is to be known.
    pub has_weights: bool,
    /// Whether new vertices get free ids, as those of
    /// [`stage_insertions_at_free_ids`](super::MovingTriangulation::stage_insertions_at_free_ids). Then vertices have
    /// keys from the first insertion on: what is cocircular has cells that do not depend on which ids are free.
    pub reuses_ids: bool,
}

impl Default for RefineOptions {
    fn default() -> Self {
        RefineOptions { keeps: Kept::None, limit: usize::MAX, has_weights: false, reuses_ids: false }
    }
}

/// Which vertices [`coarsen`](super::MovingTriangulation::coarsen) may take away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoarsenOptions {
    /// By how many degrees the angles of the cells that come have to be above the least one.
    pub margin: f64,
    /// The share, up to 1, of the greatest areas and lengths that cells that come may have.
    pub share: f64,
    /// Two pieces of a segment are joined if the vertex between them is on the line through their other ends, or off it
    /// by no more than this share of the distance of these; above 0 it may be off by 64 last places of the greatest
    /// coordinate at least. The default, 1e-9, is above what the rounding of motions adds up to.
    pub joins: f64,
    /// How many times as many vertices as a mesh made anew the mesh may have, 1 or more. Where it has more, or may have, as
    /// another quality is asked for, the next refinement makes it anew, in its one commit, and takes that if it is so. Not
    /// with sizes. Infinite for never.
    pub growth: f64,
    /// Which segments refinement keeps whole: around cells that it would mend more vertices may go.
    pub keeps: Kept,
}

impl Default for CoarsenOptions {
    fn default() -> Self {
        CoarsenOptions { margin: 2.0, share: 0.9, joins: 1e-9, growth: 1.1, keeps: Kept::None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_shown_by_name() {
        let options = Options { monitor: Some(Box::new(|_| true)), ..Options::default() };
        let shown = format!("{options:?}");
        for part in ["algorithm: Auto", "threads: 0", "coincidence: Merge", "monitor: true"] {
            assert!(shown.contains(part), "{shown}");
        }
    }
}
