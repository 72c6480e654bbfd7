//! Random histories of a triangulation, each a function of its seed: everything that a program may do with moving
//! points, compared with fresh builds after every commit.

mod family;
mod fingerprint;
mod history;
mod mirror;
mod motion;
mod tally;

use deldrift::{Plane, Space};
pub use fingerprint::mixed;
use history::History;
pub use tally::Tally;

/// What a history has come to.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    pub tally: Tally,
    /// Of all cells after every commit.
    pub checksum: u64,
}

/// The checksums of the first histories: those of every build, on every processor.
pub const RECORDED: [u64; 0] = [];

/// The dimension of the history of a seed.
pub fn dimension_of(seed: u64) -> usize {
    2 + (seed % 2) as usize
}

/// Runs the history of a seed; panics at the first mismatch, with what there is to know about it. A loud one prints what
/// it does before it does it.
pub fn run(seed: u64, is_loud: bool) -> Outcome {
    deldrift::internals::use_all_threads();
    match dimension_of(seed) {
        2 => History::<Plane>::new(seed, is_loud).run(),
        _ => History::<Space>::new(seed, is_loud).run(),
    }
}
