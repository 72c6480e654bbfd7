//! Places, and rows of vertices.

pub const NONE: u32 = u32::MAX;

/// A position; the third coordinate is 0 in the plane.
pub type Place = [f64; 3];
/// The corners of a cell; the fourth is NONE in the plane.
pub type Row = [u32; 4];

/// A row in ascending order.
pub fn sorted(mut row: Row) -> Row {
    row.sort_unstable();
    row
}
