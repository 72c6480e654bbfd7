//! *Repair*: everything moves at once, every certificate is checked, and what has failed is repaired.

mod commit;
mod foresight;
mod taking_back;

/// What has become of the cells of vertices that have been moved.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Mending {
    /// The cells are the triangulation of the vertices where these are now. Vertices taken back are queued.
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
    /// The cells can be mended; what has to be is listed.
    Mendable,
    /// To take all vertices back that have moved, and place them, would take less time.
    Placeable,
    /// To mend them, or to place vertices, would take longer than to build all cells again.
    TooMuch,
}
