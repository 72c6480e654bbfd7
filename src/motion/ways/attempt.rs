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

/// What has become of all vertices when those beyond their tolerance are queued.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Advance {
    /// They have moved, this number of them to another position; those beyond are queued.
    Moved(u64),
    /// Too many are beyond; none has moved, and none is queued.
    TooManyBeyond,
}

/// What has become of the cells of vertices that have been moved.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Mending {
    /// They are the triangulation of the vertices where these are now. Vertices taken back are queued, to be placed.
    Mended,
    /// Too many vertices would have to be placed, or flips took too long: they have to be built again. They are neither
    /// the cells from before nor those of the vertices where these are now; vertices taken back are queued all the
    /// same.
    TooMuch,
}

/// What a sweep, or taking vertices back, has shown of cells that are to be mended.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Prospect {
    /// They can be mended; what has to be is listed.
    Mendable,
    /// To take all vertices back that have moved, and place them, would take less time.
    Placeable,
    /// To mend them, or to place vertices, would take longer than to build all cells again.
    TooMuch,
}

/// What has become of the staged insertions and removals.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Edited {
    /// There were none, or they have been made one by one; no vertex has moved.
    WithoutMoves,
    /// A kernel has been built with them, and with all vertices at their goals.
    WithMoves,
}

/// What has become of edits that are made one by one.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum SingleEdits {
    /// All have been made.
    Made,
    /// A vertex has left the hyperplane of all others, or more takes longer than a build: a kernel has to be built. Some
    /// have been made, and have to be undone.
    NeedBuild,
}
