//! What the caller chooses, and what a commit reports.

use std::fmt;

use crate::delaunay::Dimension;
pub use crate::machine::pace::Monitor;
use crate::motion::algorithms::Algorithm;

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
    pub(super) fn share_for<G: Dimension>(&self) -> f64 {
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
    /// The cells do not depend on it. Their order does, and so do the counts of flips, placements and exact
    /// signs, as those depend on the order.
    pub threads: u32,
    /// Coincident vertices.
    pub coincidence: CoincidencePolicy,
    /// Progress and cancellation, of creation, loading, commits, and immediate calls that take long.
    pub monitor: Option<Monitor>,
}

impl fmt::Debug for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Options")
            .field("algorithm", &self.algorithm)
            .field("threads", &self.threads)
            .field("coincidence", &self.coincidence)
            .field("monitor", &self.monitor.is_some())
            .finish()
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
