//! How the parts of a commit end: each may give up where too much would have to be done, and says what it leaves
//! behind.

/// Where vertices are of which the cells have not been changed yet.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Start {
    /// None has moved.
    AtOrigins,
    /// All are at their goals, which for this number of them is another place than before.
    AtGoals { n_moved: u64 },
}

/// How far a commit that checks only some certificates has come.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Attempt {
    /// The vertices are at their goals, and the cells are theirs.
    Committed,
    /// The attempt has given up, and no cell has changed: another algorithm can start from what it leaves.
    GivenUp(Start),
}
