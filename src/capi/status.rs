//! What a call says when it ends: status codes, the message of the last failure, the version.

use std::ffi::{CStr, c_char};
use std::fmt;

use super::files::FileError;
use super::message;
use crate::damage::Damage;
use crate::error::{Conflict, Error};
use crate::motion::Violation;

/// Outcome of a call. DELDRIFT_OK is 0, and a call that gives any other status has had no effect.
///
/// deldrift_last_error says which argument was wrong, at which index, and its value.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(clippy::enum_variant_names)]
pub enum deldrift_status {
    /// The call did what it was asked to do.
    DELDRIFT_OK = 0,
    /// A pointer that must not be NULL is.
    DELDRIFT_NULL_ARGUMENT = 1,
    /// A pointer is not aligned for what it should point to.
    DELDRIFT_MISALIGNED_ARGUMENT = 2,
    /// An array with the given count would not fit in the address space.
    DELDRIFT_SIZE_OVERFLOW = 3,
    /// The dimension is neither 2 nor 3, or not one for which there is the function.
    DELDRIFT_INVALID_DIMENSION = 4,
    /// An option has a value that this version does not know; the message names the field.
    DELDRIFT_INVALID_OPTIONS = 5,
    /// The level of deldrift_validate is not 1, 2 or 3.
    DELDRIFT_INVALID_LEVEL = 6,
    /// A buffer has room for fewer entries than there are. Their number is in the message, and in the count if the
    /// function has one.
    DELDRIFT_BUFFER_TOO_SMALL = 7,
    /// A coordinate or a weight is NaN or infinite.
    DELDRIFT_NOT_FINITE = 8,
    /// A coordinate is of a magnitude above 1e57, or a weight above 1e114: signs could not be exact.
    DELDRIFT_OUT_OF_RANGE = 9,
    /// No vertex ever had this id.
    DELDRIFT_NO_SUCH_VERTEX = 10,
    /// The vertex of this id has been removed.
    DELDRIFT_REMOVED_VERTEX = 11,
    /// A move of this vertex is already staged for the next timestamp.
    DELDRIFT_DUPLICATE_MOVE = 12,
    /// An array does not have the number of entries that it must have: one for each id, cell or component. Or, without
    /// a list of ids, it has more entries than there are ids.
    DELDRIFT_WRONG_COUNT = 13,
    /// Two vertices would be at the same place, and the options reject that.
    DELDRIFT_COINCIDENT = 14,
    /// There would be more vertices than 32-bit ids can name, or more segments have been given ids.
    DELDRIFT_TOO_MANY_VERTICES = 15,
    /// There would be more cells than the library can link to each other.
    DELDRIFT_TOO_MANY_CELLS = 16,
    /// Not enough memory.
    DELDRIFT_OUT_OF_MEMORY = 17,
    /// The cancel callback returned true.
    DELDRIFT_CANCELLED = 18,
    /// deldrift_validate found something wrong; the message says what.
    DELDRIFT_INVALID = 19,
    /// A callback, or another thread, used a triangulation while a call was changing it.
    DELDRIFT_BUSY = 20,
    /// An earlier call on this triangulation ended in DELDRIFT_INTERNAL_ERROR while changing it. It can only
    /// be destroyed.
    DELDRIFT_POISONED = 21,
    /// A defect of the library; please report the message.
    DELDRIFT_INTERNAL_ERROR = 22,
    /// There is no cell of this index, or cells have no corner of this number.
    DELDRIFT_NO_SUCH_FACET = 23,
    /// A number has no meaning for its argument, as a negative squared radius.
    DELDRIFT_INVALID_VALUE = 24,
    /// Data are not those of a saved triangulation. They are damaged, incomplete, of another kind, or from a later
    /// version. The message says what is wrong, and where.
    DELDRIFT_INVALID_DATA = 25,
    /// The system cannot read or write a file; the message has the path, and what the system says.
    DELDRIFT_IO_ERROR = 26,
    /// A field has no name, one that is not UTF-8, or no components; the message has its index.
    DELDRIFT_INVALID_FIELD = 27,
    /// The insertion of the vertex is staged: it is not there before the next commit. Or its removal is staged: it can
    /// be neither moved by that commit nor removed twice. The message says which.
    DELDRIFT_STAGED_VERTEX = 28,
    /// There is no segment of this id, or its removal is staged.
    DELDRIFT_NO_SUCH_SEGMENT = 29,
    /// Two segments would cross, at a place that is an end of neither; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_CROSSING = 30,
    /// A vertex would be on a segment, and not be one of its ends; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_ON_SEGMENT = 31,
    /// An end of a segment would be removed; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_END_REMOVED = 32,
    /// Both ends of a segment would be at the same place; deldrift_segment_conflicts tells all conflicts.
    DELDRIFT_ENDS_MEET = 33,
    /// A seed is on the boundary of several regions.
    DELDRIFT_AMBIGUOUS_SEED = 34,
    /// A vertex would pass a segment; deldrift_passings tells all that would.
    DELDRIFT_PASSES_SEGMENT = 35,
    /// A timestamp is prepared, and the call has to wait for deldrift_publish_timestamp or deldrift_withdraw_timestamp.
    /// The message has the timestamp and the number of rounds.
    DELDRIFT_PREPARED = 36,
    /// No timestamp is prepared that could be published.
    DELDRIFT_NOT_PREPARED = 37,
    /// The triangulation is periodic, and the function does not serve such.
    DELDRIFT_PERIODIC = 38,
    /// The vectors of a periodic box depend on each other, or nearly so, or are more than there are axes.
    DELDRIFT_DEPENDENT_VECTORS = 39,
    /// The call needs the lists of the latest deldrift_take_changes, and cells or ids have changed since.
    DELDRIFT_CHANGES_NOT_TAKEN = 40,
    /// The call works on regions by their labels, and the sides of a region have no label, or several. deldrift_regions
    /// counts its cells.
    DELDRIFT_UNDECIDED_REGIONS = 41,
    /// The triangulation has weights, and the function does not serve such.
    DELDRIFT_WEIGHTED = 42,
    /// The triangulation has no weights, and the function is for those that have.
    DELDRIFT_NOT_WEIGHTED = 43,
}

use deldrift_status::*;

/// A status as it arrives from C, where any number may be passed.
pub type StatusCode = u32;

impl deldrift_status {
    /// Every status, in the order of their values.
    const ALL: [deldrift_status; 44] = [
        DELDRIFT_OK,
        DELDRIFT_NULL_ARGUMENT,
        DELDRIFT_MISALIGNED_ARGUMENT,
        DELDRIFT_SIZE_OVERFLOW,
        DELDRIFT_INVALID_DIMENSION,
        DELDRIFT_INVALID_OPTIONS,
        DELDRIFT_INVALID_LEVEL,
        DELDRIFT_BUFFER_TOO_SMALL,
        DELDRIFT_NOT_FINITE,
        DELDRIFT_OUT_OF_RANGE,
        DELDRIFT_NO_SUCH_VERTEX,
        DELDRIFT_REMOVED_VERTEX,
        DELDRIFT_DUPLICATE_MOVE,
        DELDRIFT_WRONG_COUNT,
        DELDRIFT_COINCIDENT,
        DELDRIFT_TOO_MANY_VERTICES,
        DELDRIFT_TOO_MANY_CELLS,
        DELDRIFT_OUT_OF_MEMORY,
        DELDRIFT_CANCELLED,
        DELDRIFT_INVALID,
        DELDRIFT_BUSY,
        DELDRIFT_POISONED,
        DELDRIFT_INTERNAL_ERROR,
        DELDRIFT_NO_SUCH_FACET,
        DELDRIFT_INVALID_VALUE,
        DELDRIFT_INVALID_DATA,
        DELDRIFT_IO_ERROR,
        DELDRIFT_INVALID_FIELD,
        DELDRIFT_STAGED_VERTEX,
        DELDRIFT_NO_SUCH_SEGMENT,
        DELDRIFT_CROSSING,
        DELDRIFT_ON_SEGMENT,
        DELDRIFT_END_REMOVED,
        DELDRIFT_ENDS_MEET,
        DELDRIFT_AMBIGUOUS_SEED,
        DELDRIFT_PASSES_SEGMENT,
        DELDRIFT_PREPARED,
        DELDRIFT_NOT_PREPARED,
        DELDRIFT_PERIODIC,
        DELDRIFT_DEPENDENT_VECTORS,
        DELDRIFT_CHANGES_NOT_TAKEN,
        DELDRIFT_UNDECIDED_REGIONS,
        DELDRIFT_WEIGHTED,
        DELDRIFT_NOT_WEIGHTED,
    ];

    fn text(self) -> &'static CStr {
        match self {
            DELDRIFT_OK => c"success",
            DELDRIFT_NULL_ARGUMENT => c"a pointer is NULL",
            DELDRIFT_MISALIGNED_ARGUMENT => c"a pointer is misaligned",
            DELDRIFT_SIZE_OVERFLOW => c"a count is too large for the address space",
            DELDRIFT_INVALID_DIMENSION => c"the dimension is neither 2 nor 3, or not one for this function",
            DELDRIFT_INVALID_OPTIONS => c"an option is invalid",
            DELDRIFT_INVALID_LEVEL => c"the level of validation is not 1, 2 or 3",
            DELDRIFT_BUFFER_TOO_SMALL => c"a buffer is too small",
            DELDRIFT_NOT_FINITE => c"a coordinate or weight is not finite",
            DELDRIFT_OUT_OF_RANGE => c"a coordinate or weight is out of range",
            DELDRIFT_NO_SUCH_VERTEX => c"no vertex has this id",
            DELDRIFT_REMOVED_VERTEX => c"the vertex has been removed",
            DELDRIFT_DUPLICATE_MOVE => c"a move of the vertex is already staged",
            DELDRIFT_WRONG_COUNT => c"an array has the wrong number of entries",
            DELDRIFT_COINCIDENT => c"two vertices would be at the same place",
            DELDRIFT_TOO_MANY_VERTICES => c"too many vertices",
            DELDRIFT_TOO_MANY_CELLS => c"too many cells",
            DELDRIFT_OUT_OF_MEMORY => c"out of memory",
            DELDRIFT_CANCELLED => c"cancelled by the callback",
            DELDRIFT_INVALID => c"the triangulation violates an invariant",
            DELDRIFT_BUSY => c"the triangulation is being changed",
            DELDRIFT_POISONED => c"an internal error has made the triangulation unusable",
            DELDRIFT_INTERNAL_ERROR => c"internal error",
            DELDRIFT_NO_SUCH_FACET => c"there is no such cell or facet",
            DELDRIFT_INVALID_VALUE => c"a number has no meaning for its argument",
            DELDRIFT_INVALID_DATA => c"the data are not those of a saved triangulation",
            DELDRIFT_IO_ERROR => c"a file cannot be read or written",
            DELDRIFT_INVALID_FIELD => c"a field is invalid",
            DELDRIFT_STAGED_VERTEX => c"the insertion or removal of the vertex is staged",
            DELDRIFT_NO_SUCH_SEGMENT => c"no segment has this id",
            DELDRIFT_CROSSING => c"two segments would cross",
            DELDRIFT_ON_SEGMENT => c"a vertex would be on a segment",
            DELDRIFT_END_REMOVED => c"an end of a segment would be removed",
            DELDRIFT_ENDS_MEET => c"both ends of a segment would be at the same place",
            DELDRIFT_AMBIGUOUS_SEED => c"a seed is on the boundary of several regions",
            DELDRIFT_PASSES_SEGMENT => c"a vertex would pass a segment",
            DELDRIFT_PREPARED => c"a timestamp is prepared",
            DELDRIFT_CHANGES_NOT_TAKEN => c"changes have not been taken since the last one",
            DELDRIFT_UNDECIDED_REGIONS => c"a region has no label, or several",
            DELDRIFT_NOT_PREPARED => c"no timestamp is prepared",
            DELDRIFT_PERIODIC => c"the function does not serve periodic triangulations",
            DELDRIFT_WEIGHTED => c"the function does not serve triangulations with weights",
            DELDRIFT_NOT_WEIGHTED => c"the triangulation has no weights",
            DELDRIFT_DEPENDENT_VECTORS => c"the vectors of a box depend on each other",
        }
    }
}

/// What is wrong with a pointer.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wrong {
    Null,
    Misaligned { address: usize, alignment: usize },
    TooLarge { count: usize, size: usize },
}

impl Wrong {
    /// With this argument.
    pub(super) fn in_argument(self, argument: &'static str) -> Failure {
        Failure::Pointer { argument, wrong: self }
    }

    fn status(self) -> deldrift_status {
        match self {
            Wrong::Null => DELDRIFT_NULL_ARGUMENT,
            Wrong::Misaligned { .. } => DELDRIFT_MISALIGNED_ARGUMENT,
            Wrong::TooLarge { .. } => DELDRIFT_SIZE_OVERFLOW,
        }
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Wrong::Null => write!(f, "is NULL"),
            Wrong::Misaligned { address, alignment } => {
                write!(f, "is {address:#x}, which is not a multiple of {alignment}")
            }
            Wrong::TooLarge { count, size } => {
                write!(f, "cannot have {count} entries of {size} bytes each")
            }
        }
    }
}

/// Why a call fails, seen from the boundary.
#[derive(Debug)]
pub(super) enum Failure {
    Pointer { argument: &'static str, wrong: Wrong },
    ValuesOfField { argument: &'static str, index: usize, wrong: Wrong },
    NotOfThePlane,
    Periodic,
    Weighted,
    NotWeighted,
    Option { field: &'static str, value: u64, wanted: &'static str },
    Share { field: &'static str, value: f64 },
    Field { argument: &'static str, index: usize, part: &'static str, wanted: &'static str },
    Level { given: u32 },
    BufferTooSmall { argument: &'static str, capacity: usize, needed: usize },
    NoSuchFacet { cell: u32, corner: u32, cells: usize, corners: usize },
    Invalid(Violation),
    Data { argument: &'static str, damage: Damage },
    File(FileError),
    Busy,
    Poisoned,
    Call(Error),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Call(error)
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        match error {
            FileError::Call(error) => error.into(),
            error => Failure::File(error),
        }
    }
}

impl Failure {
    pub(super) fn status(&self) -> deldrift_status {
        match self {
            Failure::Pointer { wrong, .. } | Failure::ValuesOfField { wrong, .. } => wrong.status(),
            Failure::NotOfThePlane => DELDRIFT_INVALID_DIMENSION,
            Failure::Periodic => DELDRIFT_PERIODIC,
            Failure::Weighted => DELDRIFT_WEIGHTED,
            Failure::NotWeighted => DELDRIFT_NOT_WEIGHTED,
            Failure::Option { .. } | Failure::Share { .. } => DELDRIFT_INVALID_OPTIONS,
            Failure::Field { .. } => DELDRIFT_INVALID_FIELD,
            Failure::Level { .. } => DELDRIFT_INVALID_LEVEL,
            Failure::BufferTooSmall { .. } => DELDRIFT_BUFFER_TOO_SMALL,
            Failure::NoSuchFacet { .. } => DELDRIFT_NO_SUCH_FACET,
            Failure::Invalid(_) => DELDRIFT_INVALID,
            Failure::Data { .. } => DELDRIFT_INVALID_DATA,
            Failure::File(_) => DELDRIFT_IO_ERROR,
            Failure::Busy => DELDRIFT_BUSY,
            Failure::Poisoned => DELDRIFT_POISONED,
            Failure::Call(error) => match error {
                Error::InvalidDimension { .. } => DELDRIFT_INVALID_DIMENSION,
                Error::NotFinite { .. } => DELDRIFT_NOT_FINITE,
                Error::OutOfRange { .. } => DELDRIFT_OUT_OF_RANGE,
                Error::NoSuchVertex { .. } => DELDRIFT_NO_SUCH_VERTEX,
                Error::RemovedVertex { .. } => DELDRIFT_REMOVED_VERTEX,
                Error::StagedVertex { .. } | Error::Staged { .. } => DELDRIFT_STAGED_VERTEX,
                Error::NoSuchCell { .. } => DELDRIFT_NO_SUCH_FACET,
                Error::AmbiguousSeed { .. } => DELDRIFT_AMBIGUOUS_SEED,
                Error::NoSuchSegment { .. } => DELDRIFT_NO_SUCH_SEGMENT,
                Error::Conflict { conflict, .. } => match conflict {
                    Conflict::Crossing { .. } => DELDRIFT_CROSSING,
                    Conflict::OnSegment { .. } => DELDRIFT_ON_SEGMENT,
                    Conflict::EndRemoved { .. } => DELDRIFT_END_REMOVED,
                    Conflict::EndsMeet { .. } => DELDRIFT_ENDS_MEET,
                },
                Error::Passing { .. } => DELDRIFT_PASSES_SEGMENT,
                Error::Prepared { .. } => DELDRIFT_PREPARED,
                Error::UndecidedRegions { .. } => DELDRIFT_UNDECIDED_REGIONS,
                Error::ChangesNotTaken => DELDRIFT_CHANGES_NOT_TAKEN,
                Error::NotPrepared => DELDRIFT_NOT_PREPARED,
                Error::DuplicateMove { .. } => DELDRIFT_DUPLICATE_MOVE,
                Error::WrongCount { .. } => DELDRIFT_WRONG_COUNT,
                Error::InvalidValue { .. } => DELDRIFT_INVALID_VALUE,
                Error::DependentVectors { .. } => DELDRIFT_DEPENDENT_VECTORS,
                Error::OutsideOfPeriodic { .. } => DELDRIFT_PERIODIC,
                Error::InvalidName { .. } => DELDRIFT_INVALID_FIELD,
                Error::Coincident { .. } => DELDRIFT_COINCIDENT,
                Error::TooManyVertices { .. } | Error::TooManySegments { .. } => DELDRIFT_TOO_MANY_VERTICES,
                Error::TooManyCells { .. } => DELDRIFT_TOO_MANY_CELLS,
                Error::OutOfMemory { .. } => DELDRIFT_OUT_OF_MEMORY,
                Error::Cancelled => DELDRIFT_CANCELLED,
            },
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Pointer { argument, wrong } => write!(f, "{argument} {wrong}"),
            Failure::ValuesOfField { argument, index, wrong } => {
                write!(f, "values of {argument}[{index}] {wrong}")
            }
            Failure::NotOfThePlane => write!(f, "the dimension of t is 3, but must be 2"),
            Failure::Periodic => write!(f, "t is periodic, and this function does not serve such"),
            Failure::Weighted => write!(f, "t has weights, and this function does not serve such"),
            Failure::NotWeighted => write!(f, "t has no weights, and this function is for those that have"),
            Failure::Option { field, value, wanted } => write!(f, "{field} is {value}, but must be {wanted}"),
            Failure::Share { field, value } => {
                write!(f, "{field} is {value:?}, but must be 0, or above 0 and at most 1")
            }
            Failure::Field { argument, index, part, wanted } => {
                write!(f, "{part} of {argument}[{index}] must be {wanted}")
            }
            Failure::Level { given } => write!(f, "level is {given}, but must be 1, 2 or 3"),
            Failure::BufferTooSmall { argument, capacity, needed } => {
                write!(f, "{argument} is {capacity}, but there are {needed} entries")
            }
            Failure::NoSuchFacet { cell, corner, cells, corners } => write!(
                f,
                "cell is {cell} and corner is {corner}, but there are {cells} cells of {corners} corners"
            ),
            Failure::Invalid(violation) => write!(f, "{}", violation.message),
            Failure::Data { argument, damage } => write!(f, "{argument}: {damage}"),
            Failure::File(error) => write!(f, "{error}"),
            Failure::Busy => write!(f, "t is in use by a call that is changing it"),
            Failure::Poisoned => write!(f, "t is unusable since a call on it ended in an internal error"),
            Failure::Call(error) => write!(f, "{error}"),
        }
    }
}

/// A status in a few words, in English, without a full stop. For a number that is no status of this version the text
/// says so. The string is static.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub extern "C" fn deldrift_status_string(status: StatusCode) -> *const c_char {
    deldrift_status::ALL.get(status as usize).map_or(c"unknown status", |s| s.text()).as_ptr()
}

/// The message of the last call on this thread that failed. It says which argument was wrong, at which index, and its
/// value. It is an empty string if no call has failed. Calls that succeed leave it as it is, so look at it only after a
/// failure.
///
/// The string is never NULL, belongs to the library, and stays until the next failure on the same
/// thread. It is at most 511 bytes long and valid UTF-8.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub extern "C" fn deldrift_last_error() -> *const c_char {
    message::last()
}

/// The version of the library that is running, as "major.minor.patch". The string is static. The
/// version of the header that a program was compiled with is in DELDRIFT_VERSION_STRING.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub extern "C" fn deldrift_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statuses_are_numbered_in_order_and_have_distinct_texts() {
        for (value, status) in deldrift_status::ALL.into_iter().enumerate() {
            assert_eq!(status as usize, value);
            assert!(deldrift_status::ALL[..value].iter().all(|earlier| earlier.text() != status.text()));
        }
    }

    #[test]
    fn failures_that_no_small_program_can_provoke_have_their_status() {
        let memory = Failure::from(Error::OutOfMemory { bytes: 64 });
        assert_eq!((memory.status(), memory.to_string().contains("64")), (DELDRIFT_OUT_OF_MEMORY, true));
        let cells = Failure::from(Error::TooManyCells { limit: 1 << 30 });
        assert_eq!(
            (cells.status(), cells.to_string().contains("1073741824")),
            (DELDRIFT_TOO_MANY_CELLS, true)
        );
        let violation = Violation {
            level: crate::motion::Level::Structure,
            message: "cell 7 is its own neighbour".into(),
        };
        let invalid = Failure::Invalid(violation);
        assert_eq!((invalid.status(), invalid.to_string().contains("cell 7")), (DELDRIFT_INVALID, true));
    }
}
