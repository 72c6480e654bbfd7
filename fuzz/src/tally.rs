//! How much has been done.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

pub struct Count(pub &'static str, AtomicU64);

impl Count {
    const fn new(name: &'static str) -> Self {
        Count(name, AtomicU64::new(0))
    }

    pub fn add(&self, n: u64) {
        self.1.fetch_add(n, Relaxed);
    }

    pub fn get(&self) -> u64 {
        self.1.load(Relaxed)
    }
}

pub static SIGNS: Count = Count::new("signs compared");
pub static TIES: Count = Count::new("ties");
pub static LONG: Count = Count::new("in long integers");
pub static HISTORIES: Count = Count::new("histories");
pub static OPERATIONS: Count = Count::new("operations");
pub static COMMITS: Count = Count::new("commits");
pub static COMPARISONS: Count = Count::new("comparisons with a fresh build");
pub static PROOFS: Count = Count::new("comparisons with the definition");
pub static FAULTS: Count = Count::new("calls without memory");
pub static CANCELLED: Count = Count::new("calls cancelled");
pub static REFUSED: Count = Count::new("bad calls refused");
pub static REFINED: Count = Count::new("vertices added by refinement");
pub static COARSENED: Count = Count::new("taken away by coarsening");
pub static REACHED: Count = Count::new("qualities reached");
pub static TRANSFERS: Count = Count::new("transfers");
pub static LOADED: Count = Count::new("data loaded");
pub static DAMAGED: Count = Count::new("data refused");

/// All of them.
pub static ALL: [&Count; 17] = [
    &SIGNS,
    &TIES,
    &LONG,
    &HISTORIES,
    &OPERATIONS,
    &COMMITS,
    &COMPARISONS,
    &PROOFS,
    &FAULTS,
    &CANCELLED,
    &REFUSED,
    &REFINED,
    &COARSENED,
    &REACHED,
    &TRANSFERS,
    &LOADED,
    &DAMAGED,
];
