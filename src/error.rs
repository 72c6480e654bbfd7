//! Why a call can fail. Every variant names the argument, the index in it and the offending value,
//! because the caller's arrays are large and the message is often all that reaches a log.

use std::fmt;

use crate::ids::{CellId, SegmentId, VertexId};

/// The reason for which a call had no effect.
///
/// `argument` is the name of the parameter at fault as the C header spells it; `index` counts the
/// entries (vertices, not coordinates) of that argument, and is 0 where it holds a single one.
///
/// ```
/// use deldrift::{Error, Plane, motion::{MovingTriangulation, Options}};
///
/// let points = [[0.0, 0.0], [1.0, f64::NAN]];
/// let error = MovingTriangulation::<Plane>::new(&points, Options::default()).unwrap_err();
/// assert!(matches!(error, Error::NotFinite { index: 1, axis: 1, .. }));
/// assert_eq!(error.to_string(), "positions[1], coordinate 1, is NaN, which is not finite");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// There are triangulations of 2 and of 3 dimensions only.
    InvalidDimension {
        /// What was given.
        given: u32,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Parameter at fault.
        argument: &'static str,
        /// Which point of it.
        index: usize,
        /// Which coordinate of the point: 0 for x, 1 for y, 2 for z, or [`AXIS_OF_WEIGHT`].
        axis: usize,
        /// What was given.
        value: f64,
    },
    /// The magnitude of a coordinate is too large.
    OutOfRange {
        /// Parameter at fault.
        argument: &'static str,
        /// Which point of it.
        index: usize,
        /// Which coordinate of the point, or [`AXIS_OF_WEIGHT`].
        axis: usize,
        /// What was given.
        value: f64,
        /// Greatest magnitude possible.
        limit: f64,
    },
    /// The id was never given to a vertex of this triangulation.
    NoSuchVertex {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        vertex: VertexId,
        /// How many ids have been given: valid ones are below it.
        ids: usize,
    },
    /// The vertex has been removed.
    RemovedVertex {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        vertex: VertexId,
    },
    /// The insertion of the vertex is staged, so that it is not there before the next commit; or its removal is, so
    /// that it is not there after it.
    StagedVertex {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        vertex: VertexId,
        /// What is staged.
        staged: StagedEdit,
    },
    /// There is no segment of this id, or its removal is staged.
    NoSuchSegment {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        segment: SegmentId,
        /// How many ids have been given: valid ones are below it.
        ids: usize,
    },
    /// A seed is on the boundary of several regions.
    AmbiguousSeed {
        /// Which entry of `seeds`.
        index: usize,
    },
    /// The sides of a region have no label, or several.
    UndecidedRegions {
        /// How many cells are in such regions.
        cells: usize,
    },
    /// A position is outside the convex hull of a set that repeats and is open somewhere, where the call does not serve it.
    OutsideOfPeriodic {
        /// Parameter at fault.
        argument: &'static str,
    },
    /// There is no cell of this index.
    NoSuchCell {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        cell: CellId,
        /// How many cells there are: valid indices are below it.
        cells: usize,
    },
    /// A move is already staged for the vertex since the last commit.
    DuplicateMove {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        vertex: VertexId,
    },
    /// An array that must have one entry per vertex has another length.
    WrongCount {
        /// Parameter at fault.
        argument: &'static str,
        /// Length given.
        given: usize,
        /// Length wanted.
        wanted: usize,
        /// How many of these are for vertices whose insertion is staged.
        coming: usize,
    },
    /// Something is staged, and the call commits what it makes by itself.
    Staged {
        /// Number of staged moves.
        moves: usize,
        /// Number of staged insertions and removals.
        edits: usize,
        /// Number of segments whose coming or going is staged.
        segments: usize,
    },
    /// Vectors of a periodic box depend on each other, or nearly so, or are more than there are axes.
    DependentVectors {
        /// Number of vectors.
        count: usize,
    },
    /// A timestamp is prepared, and the call is not one of those that may be made before it is published or withdrawn.
    Prepared {
        /// The timestamp.
        timestamp: u64,
        /// In how many rounds it has been prepared.
        rounds: usize,
    },
    /// No timestamp is prepared that could be published.
    NotPrepared,
    /// The call needs the lists of the changes that were taken last, and cells have changed since, or ids are not
    /// those of then.
    ChangesNotTaken,
    /// A number that has no meaning for its argument.
    InvalidValue {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What was given.
        value: f64,
        /// What is wanted.
        wanted: &'static str,
    },
    /// A field to be written cannot be called so.
    InvalidName {
        /// Parameter at fault.
        argument: &'static str,
        /// Which entry of it.
        index: usize,
        /// What is wanted.
        wanted: &'static str,
    },
    /// Two vertices would be at the same place while
    /// [`CoincidencePolicy::Reject`](crate::motion::CoincidencePolicy::Reject) is in force.
    Coincident {
        /// The lower id of the two.
        vertex: VertexId,
        /// The higher id of the two.
        other: VertexId,
    },
    /// Something is in the way of a segment, or it has not two ends.
    Conflict {
        /// The first that was found.
        conflict: Conflict,
        /// How many others there are.
        others: usize,
    },
    /// A vertex would pass a segment while
    /// [`PassingPolicy::Refuse`](crate::motion::PassingPolicy::Refuse) is in force, or it was asked whether one would.
    Passing {
        /// The first that was found.
        passing: Passing,
        /// How many others there are.
        others: usize,
    },
    /// More vertices than ids of 32 bits can name.
    TooManyVertices {
        /// Number asked for.
        given: usize,
        /// Greatest number possible.
        limit: usize,
    },
    /// More segments, those removed included, than ids of 32 bits can name.
    TooManySegments {
        /// Number asked for.
        given: usize,
        /// Greatest number possible.
        limit: usize,
    },
    /// More cells than 32-bit links can join (2^30).
    TooManyCells {
        /// Greatest number possible.
        limit: usize,
    },
    /// Memory could not be had.
    OutOfMemory {
        /// Bytes of the request that failed.
        bytes: usize,
    },
    /// A callback asked to stop.
    Cancelled,
}

/// What is staged for a vertex beside a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StagedEdit {
    /// The vertex is inserted by the next commit.
    Insertion,
    /// The vertex is removed by the next commit.
    Removal,
}

/// Why a segment cannot be an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Conflict {
    /// Two segments cross at a place that is an end of neither.
    Crossing {
        /// Their ids, ascending.
        segments: [SegmentId; 2],
    },
    /// A vertex is on a segment, and not one of its ends.
    OnSegment {
        /// The segment.
        segment: SegmentId,
        /// The vertex that represents the place.
        vertex: VertexId,
    },
    /// An end of a segment is not there, or is removed.
    EndRemoved {
        /// The segment.
        segment: SegmentId,
        /// The end.
        vertex: VertexId,
    },
    /// Both ends of a segment are at the same place.
    EndsMeet {
        /// The segment.
        segment: SegmentId,
    },
}

/// A vertex that passes a segment: that comes from one side of it to the other on the straight way of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Passing {
    /// The segment.
    pub segment: SegmentId,
    /// The vertex.
    pub vertex: VertexId,
}

impl Conflict {
    /// Two segments that cross.
    pub(crate) fn crossing(one: SegmentId, other: SegmentId) -> Self {
        Conflict::Crossing { segments: [one.min(other), one.max(other)] }
    }

    /// The segment, or the first of two.
    pub(crate) fn segment(&self) -> SegmentId {
        match *self {
            Conflict::Crossing { segments: [segment, _] }
            | Conflict::OnSegment { segment, .. }
            | Conflict::EndRemoved { segment, .. }
            | Conflict::EndsMeet { segment } => segment,
        }
    }
}

impl fmt::Display for Conflict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Conflict::Crossing { segments: [one, other] } => write!(f, "segments {one} and {other} cross"),
            Conflict::OnSegment { segment, vertex } => write!(f, "vertex {vertex} is on segment {segment}"),
            Conflict::EndRemoved { segment, vertex } => {
                write!(f, "vertex {vertex}, an end of segment {segment}, is removed")
            }
            Conflict::EndsMeet { segment } => {
                write!(f, "both ends of segment {segment} are at the same place")
            }
        }
    }
}

impl fmt::Display for Passing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "vertex {} passes segment {}", self.vertex, self.segment)
    }
}

/// In place of the number of a coordinate: it is the weight of a point that is no good.
pub const AXIS_OF_WEIGHT: usize = usize::MAX;

/// What a number of a point is called.
struct Axis(usize);

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            AXIS_OF_WEIGHT => write!(f, "a weight"),
            axis => write!(f, "coordinate {axis}"),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::InvalidDimension { given } => write!(f, "dimension is {given}, but must be 2 or 3"),
            Error::NotFinite { argument, index, axis, value } => {
                write!(f, "{argument}[{index}], {}, is {value}, which is not finite", Axis(*axis))
            }
            Error::OutOfRange { argument, index, axis, value, limit } => write!(
                f,
                "{argument}[{index}], {}, is {value:e}, and its magnitude may not exceed {limit:e}",
                Axis(*axis)
            ),
            Error::NoSuchVertex { argument, index, vertex, ids } => {
                write!(f, "{argument}[{index}] is {vertex}, but only ids below {ids} have been given")
            }
            Error::RemovedVertex { argument, index, vertex } => {
                write!(f, "{argument}[{index}] is {vertex}, a vertex that has been removed")
            }
            Error::StagedVertex { argument, index, vertex, staged } => {
                let (staged, until) = match staged {
                    StagedEdit::Insertion => ("insertion", "it is not there before the next commit"),
                    StagedEdit::Removal => ("removal", "it goes at the next commit"),
                };
                write!(f, "{argument}[{index}] is {vertex}, a vertex whose {staged} is staged: {until}")
            }
            Error::NoSuchSegment { argument, index, segment, ids } => {
                write!(
                    f,
                    "{argument}[{index}] is {segment}, which is no segment, or one whose removal is staged; {ids} ids have been given"
                )
            }
            Error::AmbiguousSeed { index } => {
                write!(f, "seeds[{index}] is on the boundary of several regions, so it names none of them")
            }
            Error::UndecidedRegions { cells } => {
                write!(f, "{cells} cells are in regions whose sides have no label, or several")
            }
            Error::NoSuchCell { argument, index, cell, cells } => {
                write!(f, "{argument}[{index}] is {cell}, but there are {cells} cells")
            }
            Error::DuplicateMove { argument, index, vertex } => {
                write!(f, "{argument}[{index}] is {vertex}, a vertex whose move is already staged")
            }
            Error::WrongCount { argument, given, wanted, coming } => {
                write!(f, "{argument} is {given}, but must be {wanted}")?;
                match coming {
                    0 => Ok(()),
                    1 => write!(f, ", with one vertex whose insertion is staged"),
                    n => write!(f, ", with {n} vertices whose insertion is staged"),
                }
            }
            Error::Staged { moves, edits, segments } => write!(
                f,
                "{moves} moves, {edits} insertions and removals and {segments} changes of segments are staged, but nothing may be"
            ),
            Error::DependentVectors { count } => write!(
                f,
                "vectors[{}] is not independent of the others, or there are more vectors than axes: {count}",
                count.saturating_sub(1)
            ),
            Error::Prepared { timestamp, rounds: 1 } => {
                write!(
                    f,
                    "timestamp {timestamp} is prepared, in 1 round: it has to be published or withdrawn first"
                )
            }
            Error::Prepared { timestamp, rounds } => write!(
                f,
                "timestamp {timestamp} is prepared, in {rounds} rounds: it has to be published or withdrawn first"
            ),
            Error::ChangesNotTaken => write!(f, "changes have not been taken since the last one"),
            Error::NotPrepared => write!(f, "no timestamp is prepared"),
            Error::OutsideOfPeriodic { argument } => {
                write!(f, "{argument} is outside the convex hull of a triangulation that is periodic")
            }
            Error::InvalidValue { argument, index, value, wanted } => {
                write!(f, "{argument}[{index}] is {value}, but must be {wanted}")
            }
            Error::InvalidName { argument, index, wanted } => {
                write!(f, "name of {argument}[{index}] must be {wanted}")
            }
            Error::Coincident { vertex, other } => {
                write!(f, "vertices {vertex} and {other} are at the same place, which the options reject")
            }
            Error::Conflict { conflict, others: 0 } => write!(f, "{conflict}"),
            Error::Conflict { conflict, others: 1 } => {
                write!(f, "{conflict}, and there is one more conflict")
            }
            Error::Conflict { conflict, others } => {
                write!(f, "{conflict}, and there are {others} more conflicts")
            }
            Error::Passing { passing, others: 0 } => write!(f, "{passing}"),
            Error::Passing { passing, others: 1 } => {
                write!(f, "{passing}, and there is one more such pair")
            }
            Error::Passing { passing, others } => {
                write!(f, "{passing}, and there are {others} more such pairs")
            }
            Error::TooManyVertices { given, limit } => {
                write!(f, "{given} vertices are asked for, and {limit} is the limit")
            }
            Error::TooManySegments { given, limit } => {
                write!(f, "{given} ids of segments are asked for, and {limit} is the limit")
            }
            Error::TooManyCells { limit } => write!(f, "the triangulation needs more than {limit} cells"),
            Error::OutOfMemory { bytes } => write!(f, "no memory for {bytes} more bytes"),
            Error::Cancelled => write!(f, "a callback asked to stop"),
        }
    }
}

impl std::error::Error for Error {}

/// The result of a call that has no effect when it fails.
pub type Result<T, E = Error> = std::result::Result<T, E>;
