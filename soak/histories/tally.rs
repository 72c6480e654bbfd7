//! What has been done.

macro_rules! tally {
    ($($(#[doc = $line:literal])* $name:ident,)+) => {
        /// Sums over histories of one dimension.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Tally {
            $($(#[doc = $line])* pub $name: u64,)+
        }

        impl Tally {
            /// All sums by name.
            pub fn entries(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($name), self.$name)),+]
            }

            pub fn add(&mut self, other: &Tally) {
                $(self.$name += other.$name;)+
            }
        }
    };
}

tally! {
    histories,
    commits,
    /// Vertices that were somewhere else after a commit, or have been relocated at once.
    moves,
    /// Commits after which the cells were compared with a fresh build's, and what had been carried along by the change
    /// list with the cells.
    comparisons,
    cells_compared,
    /// Commits after which every certificate was evaluated exactly, and every neighbour was looked at.
    validations,
    mismatches,
    insertions,
    removals,
    relocations,
    loads,
    clones,
    compactions,
    algorithm_changes,
    /// Calls that segments were in the way of.
    refusals,
    /// Vertices that refinement has made.
    refined,
    /// Refinements that have not ended before the limit of those without one.
    cut_short,
    /// Refinements that have made the mesh anew.
    made_anew,
    /// Times that a mesh was coarsened and refined again at rest, and how many of these had something to do.
    rests,
    changed_at_rest,
    /// What commits have reported, from here on.
    flips,
    placements,
    rebuilds,
    within_tolerance,
    /// Hidden vertices after commits.
    hidden,
    /// Commits after which there were no cells.
    without_cells,
}
