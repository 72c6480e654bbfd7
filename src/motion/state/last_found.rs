//! What the latest call has found to be in the way of segments.

use crate::error::{Conflict, Error, Passing, Result};
use crate::machine::memory;

/// Conflicts and passings, both of one call: each call that may find some [begins](Self::begin), so that what an earlier
/// one has found is never told of a later one. Calls that stage, discard, publish, withdraw or ask keep them.
#[derive(Debug, Default)]
pub(in crate::motion) struct LastFound {
    /// The conflicts for which the call was refused, sorted.
    conflicts: Vec<Conflict>,
    /// The vertices that pass segments in the step that the call has looked at.
    passings: Vec<Passing>,
}

impl LastFound {
    /// A call begins that may find something.
    pub(in crate::motion) fn begin(&mut self) {
        self.conflicts.clear();
        self.passings.clear();
    }

    pub(in crate::motion) fn conflicts(&self) -> &[Conflict] {
        &self.conflicts
    }

    pub(in crate::motion) fn passings(&self) -> &[Passing] {
        &self.passings
    }

    /// Segments are about to be enforced, maybe once more in the same call: to be filled with what is in their way.
    pub(in crate::motion) fn conflicts_to_fill(&mut self) -> &mut Vec<Conflict> {
        self.conflicts.clear();
        &mut self.conflicts
    }

    /// The call is refused for these, in place of those that were found last.
    pub(in crate::motion) fn report_conflicts(&mut self, conflicts: Vec<Conflict>) {
        self.conflicts = conflicts;
    }

    /// The call has looked at a step.
    pub(in crate::motion) fn report_passings(&mut self, passings: Vec<Passing>) {
        self.passings = passings;
    }

    /// Refuses what has passings, by the first.
    pub(in crate::motion) fn refuse_passings(&self) -> Result<()> {
        match &self.passings[..] {
            [] => Ok(()),
            [passing, others @ ..] => Err(Error::Passing { passing: *passing, others: others.len() }),
        }
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.conflicts) + memory::bytes_of(&self.passings)
    }
}

/// Sorts what has been found, and refuses it, by the first. Ends that have lost their ids, and an end that is both of a
/// segment, are told once.
pub(in crate::motion) fn refuse_conflicts(conflicts: &mut Vec<Conflict>) -> Result<()> {
    conflicts.sort_unstable();
    conflicts.dedup();
    match conflicts[..] {
        [] => Ok(()),
        [conflict, ref others @ ..] => Err(Error::Conflict { conflict, others: others.len() }),
    }
}
