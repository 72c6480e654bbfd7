//! What segments divide the plane into.
//!
//! | file | |
//! | --- | --- |
//! | `beside` | the segment at each edge of a cell, and the cells on both sides of a segment |
//! | `regions` | the cells that are reached without crossing a segment: by nesting level, or from seeds |
//! | `labels` | labels of cells that have come, from those around them |
//! | `sides` | labels of regions that the sides of their segments keep |
//! | `chains` | the boundary of some of the cells, in closed chains |
//!
//! A *region* is a set of cells that are connected by edges at which there is no segment. Regions are functions of the
//! cells and the segments alone, so none of this is kept, but for the labels at sides: each call is a pass over the cells,
//! but for that of `labels`.

mod beside;
mod chains;
mod labels;
mod regions;
mod sides;

pub use chains::ChainEdge;
