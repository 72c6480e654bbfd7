//! What a commit has come to that gives up where too much would have to be done.

/// How far it has come. Where it has given up, all that is kept is as it was but for the positions.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Attempt {
    /// The vertices are at their new positions, and the cells are theirs.
    Committed,
    /// It has given up; no vertex has moved.
    NotBegun,
    /// It has given up; all vertices are at their new positions, and no cell has changed.
    OnlyMoved,
}
