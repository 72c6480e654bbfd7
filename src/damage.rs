//! What is wrong with data that should be those of a saved triangulation.

use std::fmt;

use crate::error::Error;
use crate::ids::{CellId, SegmentId, VertexId};

/// The first thing found wrong. Cells and their corners are numbered as in the data, from 0 on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Damage {
    /// The data end within the header.
    NoHeader {
        /// Bytes given.
        given: usize,
        /// Bytes of a header.
        wanted: usize,
    },
    /// The data do not begin like a saved triangulation.
    Foreign,
    /// A later version has written them.
    Version {
        /// Version of the format that they are in.
        given: u32,
        /// The latest one that is known.
        latest: u32,
    },
    /// The data are shorter or longer than their header says.
    Size {
        /// Bytes given.
        given: usize,
        /// Bytes by the header.
        wanted: u64,
    },
    /// The checksum at the end is not that of what comes before.
    Checksum {
        /// The one at the end.
        given: u32,
        /// The right one.
        wanted: u32,
    },
    /// The dimension is not 2 or 3, or another one than is asked for.
    Dimension {
        /// What the header says.
        given: u32,
    },
    /// The data are those of a triangulation that is periodic, where one that is not is asked for, or the other way.
    Periodic {
        /// Whether the data are of one that is.
        is_periodic: bool,
    },
    /// The data are those of a triangulation of vertices with weights, where one without is asked for, or the other way.
    Weighted {
        /// Whether the data are of one with weights.
        is_weighted: bool,
    },
    /// The vectors of a periodic triangulation are not finite, out of range, or depend on each other.
    Vectors,
    /// A vertex of a periodic triangulation is in a period that is too far away, or in which its position is not a double, or one
    /// that is not there is in any.
    Period {
        /// The vertex.
        vertex: VertexId,
    },
    /// What is inside of a periodic triangulation is not a vertex at home, each once and in order, nor an image of one, each
    /// once and where the vectors take it.
    Image {
        /// The id inside.
        inside: VertexId,
        /// The vertex that it should be, or be an image of.
        vertex: VertexId,
    },
    /// The cells inside of a periodic triangulation are not those of the set that repeats: images are missing.
    NoImages,
    /// A segment has not two different ends that are present, or something is on it, or it is no edge.
    Segment {
        /// The segment.
        segment: SegmentId,
    },
    /// The counts in the header do not add up to the size.
    Counts,
    /// The timestamp, or a sum of the statistics, is out of range.
    Sum {
        /// Where in the data.
        offset: usize,
        /// What is there.
        value: u64,
    },
    /// A coordinate is NaN, infinite, or of too great a magnitude.
    Position {
        /// The vertex.
        vertex: VertexId,
        /// Which coordinate.
        axis: usize,
        /// What is there.
        value: f64,
    },
    /// A weight is NaN, infinite, or of too great a magnitude, or that of an id that is not present.
    Weight {
        /// The vertex.
        vertex: VertexId,
        /// What is there.
        value: f64,
    },
    /// An id that is not present has a coordinate.
    Absent {
        /// The id.
        vertex: VertexId,
        /// Which coordinate.
        axis: usize,
        /// What is there, in place of NaN.
        value: f64,
    },
    /// The vertex that stands for the place of another has a higher key, or an equal one and a higher id, is not there, or does not stand for its own.
    Representative {
        /// The other.
        vertex: VertexId,
        /// What should stand for it.
        given: VertexId,
    },
    /// A vertex is hidden by one that is at another place.
    Apart {
        /// The hidden vertex.
        vertex: VertexId,
        /// The one that is said to be at its place.
        representative: VertexId,
    },
    /// Two vertices that are not hidden are at the same place.
    SamePlace {
        /// One.
        vertex: VertexId,
        /// The other.
        other: VertexId,
    },
    /// There are no cells, although the vertices do not lie in one line or plane.
    NoCells {
        /// A vertex that is out of the line or plane of others.
        vertex: VertexId,
    },
    /// A vertex that is not hidden is in no cell.
    InNoCell {
        /// The vertex.
        vertex: VertexId,
    },
    /// A vertex that is said to be hidden above a cell is not at its place, or below it, or is no hidden vertex.
    Above {
        /// The vertex.
        vertex: VertexId,
        /// The cell.
        cell: CellId,
    },
    /// A corner of a cell is no vertex, or a hidden one.
    Corner {
        /// The cell.
        cell: CellId,
        /// Which corner.
        corner: usize,
        /// What is there.
        given: VertexId,
    },
    /// A cell has a vertex twice.
    CornerTwice {
        /// The cell.
        cell: CellId,
        /// The vertex.
        vertex: VertexId,
    },
    /// A cell and its neighbour do not meet in a facet, each on its own side.
    Neighbour {
        /// The cell.
        cell: CellId,
        /// The corner opposite the facet.
        corner: usize,
        /// The neighbour.
        given: CellId,
    },
    /// A cell is not positively oriented.
    NotPositive {
        /// The cell.
        cell: CellId,
    },
    /// The vertex beyond a facet of a cell is inside the cell's sphere.
    NotDelaunay {
        /// The cell.
        cell: CellId,
        /// The corner opposite the facet.
        corner: usize,
    },
    /// The hull is not convex at a facet of a cell.
    NotConvex {
        /// The cell.
        cell: CellId,
    },
    /// The hull is in several parts, winds more than once, or turns its outer side inwards.
    NotATriangulation,
    /// A vertex that refinement is said to have made is not there, or not in order, or on a segment that there never was.
    Made {
        /// The id.
        vertex: VertexId,
    },
    /// An id that is not present, and not that of a staged insertion, has a key.
    Key {
        /// The id.
        vertex: VertexId,
        /// What is there, in place of 0.
        given: u64,
    },
    /// A staged insertion has an id that is taken, or not above that of the insertion before.
    Insertion {
        /// The id.
        vertex: VertexId,
    },
    /// A staged move or removal is of a vertex that is not there, or the second one of the vertex.
    Staged {
        /// The id.
        vertex: VertexId,
    },
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use Damage::*;
        match *self {
            NoHeader { given, wanted } => {
                write!(f, "there are {given} bytes, and the header alone has {wanted}")
            }
            Foreign => write!(f, "the first 8 bytes are not those of a saved triangulation"),
            Version { given, latest } => {
                write!(f, "the format is version {given}, and the latest known here is {latest}")
            }
            Periodic { is_periodic } => {
                let not = if is_periodic { "" } else { "not " };
                write!(f, "the triangulation is {not}periodic, and one of the other kind is asked for")
            }
            Weighted { is_weighted } => {
                let [given, wanted] = if is_weighted { ["", "out"] } else { ["out", ""] };
                write!(
                    f,
                    "the vertices are with{given} weights, and a triangulation with{wanted} them is asked for"
                )
            }
            Vectors => write!(f, "the vectors are out of range, or depend on each other"),
            Period { vertex } => {
                write!(f, "the period of vertex {vertex} is out of range, or its position there is no double")
            }
            Image { inside, vertex } => {
                write!(f, "vertex {inside} inside is neither vertex {vertex} at home nor its image")
            }
            NoImages => write!(f, "the cells inside are not those of the set that repeats"),
            Segment { segment } => write!(
                f,
                "segment {segment} has not two ends that are present and apart, is no edge, or has something on it"
            ),
            Size { given, wanted } => write!(f, "there are {given} bytes, and the header says {wanted}"),
            Checksum { given, wanted } => {
                write!(f, "the checksum is {given:#010x}, and that of the data is {wanted:#010x}")
            }
            Dimension { given } => write!(f, "the dimension, at byte 12, is {given}"),
            Counts => write!(f, "the counts at bytes 24 to 63 do not fit the size at byte 16"),
            Sum { offset, value } => {
                write!(f, "the number at byte {offset} is {value}, which is out of range")
            }
            Position { vertex, axis, value } => {
                write!(f, "vertex {vertex}, coordinate {axis}, is {value:e}, which is out of range")
            }
            Weight { vertex, value } => {
                write!(
                    f,
                    "the weight of vertex {vertex} is {value:e}, which is out of range, or it is not present"
                )
            }
            Absent { vertex, axis, value } => {
                write!(f, "id {vertex} is not present, but coordinate {axis} is {value:e}, not NaN")
            }
            Representative { vertex, given } => {
                write!(f, "vertex {given} cannot stand for the place of vertex {vertex}")
            }
            Made { vertex } => {
                write!(
                    f,
                    "vertex {vertex}, which refinement is said to have made, is not there, out of order, or on no segment"
                )
            }
            Apart { vertex, representative } => {
                write!(f, "vertex {vertex} is not at the place of vertex {representative}, which hides it")
            }
            SamePlace { vertex, other } => {
                write!(f, "vertices {vertex} and {other} are at the same place, and neither is hidden")
            }
            NoCells { vertex } => {
                write!(f, "there are no cells, but vertex {vertex} is out of the line or plane of others")
            }
            InNoCell { vertex } => write!(f, "vertex {vertex} is in no cell"),
            Above { vertex, cell } => write!(f, "vertex {vertex} is not hidden above cell {cell}"),
            Corner { cell, corner, given } => {
                write!(f, "cell {cell}, corner {corner}, is {given}, which is no vertex of cells")
            }
            CornerTwice { cell, vertex } => write!(f, "cell {cell} has vertex {vertex} twice"),
            Neighbour { cell, corner, given } => {
                write!(f, "cell {cell} does not meet cell {given} in the facet opposite corner {corner}")
            }
            NotPositive { cell } => write!(f, "cell {cell} is not positively oriented"),
            NotDelaunay { cell, corner } => write!(
                f,
                "the vertex beyond the facet of cell {cell} opposite corner {corner} is inside the cell's sphere"
            ),
            NotConvex { cell } => write!(f, "the hull is not convex at cell {cell}"),
            NotATriangulation => {
                write!(f, "the hull of the cells is in several parts, or winds more than once")
            }
            Key { vertex, given } => {
                write!(f, "id {vertex} is not that of a vertex, but its key is {given}, not 0")
            }
            Insertion { vertex } => {
                write!(f, "the id {vertex} of a staged insertion is taken, or out of order")
            }
            Staged { vertex } => {
                write!(f, "a move or removal of vertex {vertex} cannot be staged, or is staged twice")
            }
        }
    }
}

/// Why a triangulation cannot be loaded.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LoadError {
    /// The call fails, as any other may: there is no memory, or the options reject what is loaded.
    Call(Error),
    /// The data are not those of a triangulation.
    Data(Damage),
}

impl From<Error> for LoadError {
    fn from(error: Error) -> Self {
        LoadError::Call(error)
    }
}

impl From<Damage> for LoadError {
    fn from(damage: Damage) -> Self {
        LoadError::Data(damage)
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadError::Call(error) => write!(f, "{error}"),
            LoadError::Data(damage) => write!(f, "{damage}"),
        }
    }
}

impl std::error::Error for LoadError {}
