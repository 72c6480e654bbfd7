//! Options: a structure that can grow, read as far as the caller's header knows it.

use std::ffi::c_void;
use std::marker::PhantomData;
use std::mem::{MaybeUninit, offset_of};
use std::ptr;

use super::guard;
use super::pointers::{Array, Input, Output, given};
use super::status::Failure;
use crate::error::Error;
use crate::machine::memory;
use crate::machine::tally;
use crate::motion::{Algorithm, CoincidencePolicy, MAX_VERTICES, Monitor, Options, PassingPolicy, Purpose};

/// What happens when vertices come to lie at the same place.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_coincidence {
    /// The lowest id, or key, represents the place in the cells; the others are hidden until they move apart.
    DELDRIFT_COINCIDENCE_MERGE = 0,
    /// The call fails with DELDRIFT_COINCIDENT and has no effect.
    DELDRIFT_COINCIDENCE_REJECT = 1,
}

/// What happens when a vertex would pass a segment. deldrift_check_passings defines that.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_passing {
    /// Nothing. Only deldrift_check_passings looks for it.
    DELDRIFT_PASSING_IGNORE = 0,
    /// The call goes on, and deldrift_passings then tells which vertices have passed which segments.
    DELDRIFT_PASSING_TELL = 1,
    /// The call fails with DELDRIFT_PASSES_SEGMENT and has no effect; deldrift_passings then tells all of them.
    DELDRIFT_PASSING_REFUSE = 2,
}

/// How deldrift_commit_timestamp brings the triangulation to the staged positions. Every algorithm
/// gives exactly the same cells; they differ in what they cost.
///
/// DELDRIFT_AUTO is for most programs.
// An algorithm as it arrives from C, where any number may be passed. The header's enumeration has the rows of
// motion/algorithms.rs.
pub type AlgorithmCode = u32;
/// A coincidence policy as it arrives from C, where any number may be passed.
pub type CoincidenceCode = u32;
/// A passing policy as it arrives from C, where any number may be passed.
pub type PassingCode = u32;

/// Options of a triangulation. Initialise them with deldrift_options_init, then set what should differ
/// from the defaults, all of which are zero.
///
/// The structure may grow in later versions. struct_size says how much of it the program knows: fields beyond it have
/// their defaults. A greater size than that of the library is accepted if all bytes that the library does not know are
/// zero. A size that is 0, ends inside a field or is beyond 4096 is DELDRIFT_INVALID_OPTIONS. So is any value that has
/// no meaning.
///
/// The callbacks are called from inside every function that names DELDRIFT_CANCELLED among its errors, where the call
/// takes long, and from inside no other. They are called on the thread that makes the call, one at a time, and not
/// after deldrift_destroy. They must return normally (no exception, no longjmp). Where the call creates or changes a
/// triangulation, callbacks must not use that one: DELDRIFT_BUSY turns their calls away. Where the call takes it as
/// const, as deldrift_voronoi_cells does, they may read it, and DELDRIFT_BUSY turns away what would change it. Such
/// calls may run on several threads at once, and each calls the callbacks. Callbacks may use other triangulations. What
/// user_data points to must live as long as the triangulation and its copies.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct deldrift_options {
    /// sizeof(deldrift_options) as the program sees it.
    pub struct_size: usize,
    /// Algorithm of later commits; may be changed by deldrift_set_algorithm. Default DELDRIFT_AUTO.
    pub algorithm: AlgorithmCode,
    /// Greatest number of threads a call may use, the calling one included; 0, the default, is no limit. The library
    /// uses as many as make the call faster, at most one per processor. To build and rebuild that is one for each 5,000
    /// vertices in 2D or 2,500 in 3D, and likewise to move all, check all certificates and flip in repair. All
    /// triangulations of the process share these threads, which sleep between calls. The cells do not depend on the
    /// number. Their order, last bits of rounded numbers and the counts in reports may, unless parts is set. Callbacks
    /// come from the calling thread only.
    pub threads: u32,
    /// Default DELDRIFT_COINCIDENCE_MERGE.
    pub coincidence: CoincidenceCode,
    /// What commits, deldrift_check_staged and deldrift_relocate_vertex do when a vertex would pass a segment. Default
    /// DELDRIFT_PASSING_IGNORE.
    pub passing: PassingCode,
    /// Greatest number of parts into which work is divided where that shows in the order of cells: builds, and flips.
    /// 0, the default, is one for each thread that is used. With any other number the same calls give the same answers
    /// for any number of threads and on every processor. That includes the order of cells, every bit of rounded
    /// numbers, and reports. (A build for whose parts there is no memory is in one.) Take at most as many parts as the
    /// program will have threads: with fewer parts some threads have nothing to do in this work, and each further part
    /// costs something. For 100,000 vertices in 2D, a build on one thread takes 1.1 times as long in eight parts as in
    /// one. In 3D it takes 1.06 times as long in two, 1.1 in four and 1.3 in eight. For 20,000 vertices it takes 1.2
    /// times as long in 2D, 1.15 to 1.6 times in 3D.
    pub parts: usize,
    /// Called now and then during long calls: at least once for some ten thousand cells that are made, or looked at
    /// around single vertices. Passes over all vertices or cells, each of which takes a part of a build, are not
    /// interrupted. When it returns true, the call ends in DELDRIFT_CANCELLED and has had no effect. NULL, the default,
    /// never cancels.
    pub cancel: Option<unsafe extern "C" fn(user_data: *mut c_void) -> Answer>,
    /// Called just before cancel would be, with the part of the work that is done, from 0 to 1, as far as that is
    /// known. The part need not change from one call to the next, and begins again where a commit goes on by
    /// rebuilding. NULL is the default.
    pub progress: Option<unsafe extern "C" fn(user_data: *mut c_void, fraction: f64)>,
    /// Handed to the callbacks as it is.
    pub user_data: *mut c_void,
}

/// Sets struct_size and the default of every other option. NULL is legal and does nothing.
///
/// C and C++ programs have it from this header. So it fills the structure of the header, whichever later version they
/// run with. Other languages have a function of this name in the library. In every version that function fills the
/// structure as it is here, and says so in struct_size. A program that knows more fields sets them to zero, the default
/// of all, and struct_size to the size of its structure.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_options_init(options: *mut deldrift_options) {
    given!(options: Output);
    if let Ok(Some(place)) = options.if_any() {
        place.write(deldrift_options::DEFAULT);
    }
}

/// The last field that `deldrift_options_init` fills. Once there are more fields it must go on to fill these alone: the
/// structure of a program that calls it may end here.
const _: () = assert!(
    offset_of!(deldrift_options, user_data) + size_of::<*mut c_void>() == size_of::<deldrift_options>()
);

/// Greatest `struct_size` that is taken for a size: anything above it is more likely to be garbage, and
/// would have its tail looked at far beyond any structure.
const GREATEST_SIZE: usize = 4096;

impl deldrift_options {
    const DEFAULT: deldrift_options = deldrift_options {
        struct_size: size_of::<deldrift_options>(),
        algorithm: 0,
        threads: 0,
        coincidence: 0,
        passing: 0,
        parts: 0,
        cancel: None,
        progress: None,
        user_data: ptr::null_mut(),
    };

    /// Where a `struct_size` may end: behind any field.
    const ENDS: [usize; 9] = [
        size_of::<usize>(),
        offset_of!(deldrift_options, threads),
        offset_of!(deldrift_options, coincidence),
        offset_of!(deldrift_options, passing),
        offset_of!(deldrift_options, parts),
        offset_of!(deldrift_options, cancel),
        offset_of!(deldrift_options, progress),
        offset_of!(deldrift_options, user_data),
        size_of::<deldrift_options>(),
    ];

    /// These options in the library's own terms.
    pub(super) fn convert(self) -> Result<Options, Failure> {
        let coincidence = match self.coincidence {
            0 => CoincidencePolicy::Merge,
            1 => CoincidencePolicy::Reject,
            other => return Err(invalid("options.coincidence", other, "a deldrift_coincidence")),
        };
        let passing = match self.passing {
            0 => PassingPolicy::Ignore,
            1 => PassingPolicy::Tell,
            2 => PassingPolicy::Refuse,
            other => return Err(invalid("options.passing", other, "a deldrift_passing")),
        };
        let algorithm = algorithm("options.algorithm", self.algorithm)?;
        let monitor = self.callbacks().monitor()?;
        Ok(Options { algorithm, threads: self.threads, parts: self.parts, coincidence, passing, monitor })
    }

    /// The callbacks that the options name.
    pub(super) fn callbacks(&self) -> Callbacks {
        Callbacks { cancel: self.cancel, progress: self.progress, user_data: self.user_data }
    }
}

/// A structure that may grow: the program's header may know less of it, or more.
pub(super) trait Growing: Copy {
    /// All fields at their defaults, the size at the library's own.
    const DEFAULT: Self;
    /// Where a `struct_size` may end: behind any field.
    const ENDS: &'static [usize];
    /// The name of the size, for messages, and what it should be.
    const SIZE: &'static str;
    const SIZE_OF: &'static str;
}

impl Growing for deldrift_options {
    const DEFAULT: Self = deldrift_options::DEFAULT;
    const ENDS: &'static [usize] = &deldrift_options::ENDS;
    const SIZE: &'static str = "options.struct_size";
    const SIZE_OF: &'static str = "sizeof(deldrift_options)";
}

/// Options as a call is given them.
pub(super) type GivenOptions<'a> = Given<'a, deldrift_options>;

impl GivenOptions<'_> {
    /// The callbacks and the options of a creation of so many vertices in a dimension, if there is that dimension, and they
    /// are not too many. The count is looked at here as well, lest an absurd one becomes the length of a slice.
    pub(super) fn of_creation(self, dimension: u32, count: usize) -> Result<(Callbacks, Options), Failure> {
        if dimension != 2 && dimension != 3 {
            return Err(Error::InvalidDimension { given: dimension }.into());
        }
        let options = self.read()?;
        let (callbacks, options) = (options.callbacks(), options.convert()?);
        if count > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: count, limit: MAX_VERTICES }.into());
        }
        Ok((callbacks, options))
    }
}

/// A structure as a call is given it: as much of it as the program's header knows. Its size comes first.
#[derive(Clone, Copy)]
pub(super) struct Given<'a, T> {
    argument: &'static str,
    size: Input<'a, usize>,
    bytes: *const u8,
    whole: PhantomData<T>,
}

impl<'a, T: Growing> Given<'a, T> {
    /// # Safety
    /// `structure` is NULL, misaligned, or points to as many bytes as its first field says.
    pub(super) unsafe fn new(argument: &'static str, structure: *const T) -> Self {
        // SAFETY: the caller's promise: the size comes first, with the alignment of the whole.
        let size = unsafe { Input::new(argument, structure.cast()) };
        Given { argument, size, bytes: structure.cast(), whole: PhantomData }
    }

    /// Reads what is there, which must not be NULL.
    pub(super) fn get(self) -> Result<T, Failure> {
        self.size.get()?;
        self.read()
    }

    /// The bytes of the structure, if there is one and its size may be right.
    fn bytes(&self) -> Result<Option<&'a [u8]>, Failure> {
        let Some(&size) = self.size.if_any()? else { return Ok(None) };
        if size > GREATEST_SIZE || (size < size_of::<T>() && !T::ENDS.contains(&size)) {
            return Err(misfit::<T>(size, T::SIZE_OF));
        }
        // SAFETY: so many bytes were promised to `new`.
        unsafe { Array::new(self.argument, self.bytes, size) }.get().map(Some)
    }

    /// Reads the part that the library knows, and checks that beyond it there is nothing but zeros. The defaults if it
    /// is NULL.
    pub(super) fn read(self) -> Result<T, Failure> {
        let mut read = MaybeUninit::new(T::DEFAULT);
        let Some(given) = self.bytes()? else { return Ok(T::DEFAULT) };
        let (known, beyond) = given.split_at(given.len().min(size_of::<T>()));
        if beyond.iter().any(|&byte| byte != 0) {
            return Err(misfit::<T>(
                given.len(),
                "no more than this version's sizeof, or all zero beyond it",
            ));
        }
        // SAFETY: `known` is no longer than the structure and ends behind a field, so that what is
        // assembled has whole fields from either side; numbers and nullable pointers allow any bits.
        unsafe {
            ptr::copy_nonoverlapping(known.as_ptr(), read.as_mut_ptr().cast::<u8>(), known.len());
            Ok(read.assume_init())
        }
    }
}

fn misfit<T: Growing>(size: usize, wanted: &'static str) -> Failure {
    Failure::Option { field: T::SIZE, value: size as u64, wanted }
}

/// A bool of C as a function of the program's returns it: a byte, of which any but 0 means true. A program in another
/// language may leave one that is neither 0 nor 1, and Rust's own bool may not be one.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Answer(u8);

impl From<bool> for Answer {
    fn from(answer: bool) -> Self {
        Answer(answer.into())
    }
}

impl Answer {
    fn is_yes(self) -> bool {
        self.0 != 0
    }
}

/// The callbacks of one triangulation.
#[derive(Clone, Copy)]
pub(super) struct Callbacks {
    cancel: Option<unsafe extern "C" fn(*mut c_void) -> Answer>,
    progress: Option<unsafe extern "C" fn(*mut c_void, f64)>,
    user_data: *mut c_void,
}

// SAFETY: only the caller knows what user_data is. It is used by nothing but the caller's own callbacks,
// one at a time, on the thread that makes the call; the header says so.
unsafe impl Send for Callbacks {}
// SAFETY: as above.
unsafe impl Sync for Callbacks {}

impl Callbacks {
    /// What calls them, if there are any.
    pub(super) fn monitor(self) -> Result<Option<Monitor>, Error> {
        if self.cancel.is_none() && self.progress.is_none() {
            return Ok(None);
        }
        // The closure has all of it, not its fields alone, which could not be sent.
        let callbacks = self;
        let monitor = memory::boxed(move |fraction| callbacks.go_on(fraction))?;
        Ok(Some(monitor))
    }

    /// Reports progress and asks whether to go on. What the callbacks do with other triangulations is no part of the
    /// call that they are called from.
    pub(super) fn go_on(&self, fraction: f64) -> bool {
        tally::uncounted(|| guard::call_back(|| self.ask(fraction)))
    }

    fn ask(&self, fraction: f64) -> bool {
        if let Some(progress) = self.progress {
            // SAFETY: the caller set both, the one for the other.
            unsafe { progress(self.user_data, fraction) };
        }
        // SAFETY: as above.
        !self.cancel.is_some_and(|cancel| unsafe { cancel(self.user_data) }.is_yes())
    }
}

/// The algorithm of a number: one that is for use.
pub(super) fn algorithm(field: &'static str, code: AlgorithmCode) -> Result<Algorithm, Failure> {
    let found = Algorithm::from_code(code).filter(|algorithm| algorithm.row().purpose == Purpose::Use);
    found.ok_or_else(|| invalid(field, code, "a deldrift_algorithm"))
}

pub(super) fn invalid(field: &'static str, value: u32, wanted: &'static str) -> Failure {
    Failure::Option { field, value: value.into(), wanted }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_end_behind_a_field() {
        for size in 0..=deldrift_options::DEFAULT.struct_size {
            let options = deldrift_options { struct_size: size, ..deldrift_options::DEFAULT };
            // SAFETY: `size` bytes are there.
            let read = unsafe { GivenOptions::new("options", &options) }.read();
            assert_eq!(read.is_ok(), deldrift_options::ENDS.contains(&size), "{size}");
        }
    }

    /// The answer of a program that writes its bools by itself.
    unsafe extern "C" fn given(answer: *mut c_void) -> Answer {
        // SAFETY: the test hands over a byte.
        Answer(unsafe { *answer.cast::<u8>() })
    }

    #[test]
    fn any_byte_but_0_cancels() {
        for byte in 0..=u8::MAX {
            let user_data = ptr::from_ref(&byte).cast_mut().cast();
            let callbacks = Callbacks { cancel: Some(given), progress: None, user_data };
            assert_eq!(callbacks.go_on(0.5), byte == 0, "{byte}");
        }
    }
}
