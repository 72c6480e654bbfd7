//! The object itself: creation, destruction, and what is chosen for its whole life.

use std::cell::UnsafeCell;
use std::mem::{self, MaybeUninit};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

use super::fence;
use super::options::{self, AlgorithmCode, Callbacks, deldrift_options};
use super::pointers;
use super::status::{Failure, deldrift_status};
use crate::delaunay::{Dimension, Plane, Space};
use crate::error::Error;
use crate::machine::memory;
use crate::motion::{MAX_VERTICES, MovingTriangulation};

/// A triangulation: opaque, made by deldrift_create, unmade by deldrift_destroy.
pub struct deldrift_triangulation {
    kernel: UnsafeCell<Kernel>,
    // What the kernel calls, for those that are made from it.
    callbacks: Callbacks,
    // Written only by calls that change the triangulation, which exclude all others by contract. They are
    // atomic so that a caller who breaks the contract reads a flag and not garbage; nothing is ordered.
    is_changing: AtomicBool,
    is_poisoned: AtomicBool,
    // How many calls that only read it may be calling its callbacks.
    n_watched: AtomicU32,
}

/// The library's triangulation, in its dimension.
pub(super) enum Kernel {
    Plane(MovingTriangulation<Plane>),
    Space(MovingTriangulation<Space>),
}

/// Evaluates an expression on a [`Kernel`]'s triangulation, once for each dimension.
macro_rules! in_its_dimension {
    ($kernel:expr, $t:ident => $body:expr) => {
        match $kernel {
            $crate::capi::triangulation::Kernel::Plane($t) => $body,
            $crate::capi::triangulation::Kernel::Space($t) => $body,
        }
    };
}
pub(super) use in_its_dimension;

/// Evaluates an expression on a triangulation, in its dimension, and writes the result to an argument: what
/// [`fence::tell`] says goes for this too.
macro_rules! tell {
    ($handle:expr, $argument:ident, $t:ident => $body:expr) => {
        $crate::capi::fence::tell($handle, stringify!($argument), $argument, |kernel| {
            $crate::capi::triangulation::in_its_dimension!(kernel, $t => Ok($body))
        })
    };
}
pub(super) use tell;

impl deldrift_triangulation {
    #[inline(always)]
    fn new(kernel: Kernel, callbacks: Callbacks) -> Self {
        Self {
            kernel: UnsafeCell::new(kernel),
            callbacks,
            is_changing: AtomicBool::new(false),
            is_poisoned: AtomicBool::new(false),
            n_watched: AtomicU32::new(0),
        }
    }

    /// One that is to be built: in memory of its own, and made there.
    #[inline(always)]
    fn unbuilt(kernel: impl FnOnce() -> Kernel, callbacks: Callbacks) -> Result<Box<Self>, Error> {
        memory::boxed_by(
            #[inline(always)]
            || Self::new(kernel(), callbacks),
        )
    }

    pub(super) fn kernel(&self) -> *mut Kernel {
        self.kernel.get()
    }

    pub(super) fn callbacks(&self) -> Callbacks {
        self.callbacks
    }

    pub(super) fn check_idle(&self) -> Result<(), Failure> {
        if self.is_changing.load(Relaxed) { Err(Failure::Busy) } else { Ok(()) }
    }

    pub(super) fn check_ready(&self) -> Result<(), Failure> {
        self.check_idle()?;
        if self.is_poisoned.load(Relaxed) { Err(Failure::Poisoned) } else { Ok(()) }
    }

    /// Whether no call below this one on the stack uses it.
    pub(super) fn check_unused(&self) -> Result<(), Failure> {
        self.check_idle()?;
        if self.n_watched.load(Relaxed) > 0 { Err(Failure::Busy) } else { Ok(()) }
    }

    /// Keeps callbacks that are called while it is read from changing it.
    pub(super) fn watch(&self) -> Watched<'_> {
        self.n_watched.fetch_add(1, Relaxed);
        Watched(self)
    }

    /// Claims the triangulation for a call that changes it.
    #[inline(always)]
    pub(super) fn claim(&self) -> Result<Claim<'_>, Failure> {
        self.check_ready()?;
        self.check_unused()?;
        self.is_changing.store(true, Relaxed);
        Ok(Claim(self))
    }
}

/// The right to change a triangulation. Dropped without release, by a panic, it leaves it poisoned.
pub(super) struct Claim<'t>(&'t deldrift_triangulation);

impl Claim<'_> {
    /// The change has come to its end, with or without success.
    pub(super) fn release(self) {
        self.0.is_changing.store(false, Relaxed);
        mem::forget(self);
    }
}

impl Drop for Claim<'_> {
    fn drop(&mut self) {
        self.0.is_poisoned.store(true, Relaxed);
        self.0.is_changing.store(false, Relaxed);
    }
}

/// A call that reads a triangulation and calls its callbacks.
pub(super) struct Watched<'t>(&'t deldrift_triangulation);

impl Drop for Watched<'_> {
    fn drop(&mut self) {
        self.0.n_watched.fetch_sub(1, Relaxed);
    }
}

/// The points that an array from C holds, in the dimension of the triangulation.
///
/// # Safety
/// As for [`pointers::array`], with `count` times the dimension numbers.
pub(super) unsafe fn points<'a, G: Dimension>(
    argument: &'static str,
    positions: *const f64,
    count: usize,
) -> Result<&'a [G::Point], Failure> {
    // SAFETY: a point is an array of as many numbers as the dimension says.
    unsafe { pointers::array(argument, positions.cast::<G::Point>(), count) }
}

/// Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
///
/// dimension: 2 or 3. positions: count points one after the other, dimension numbers each (x, y or
/// x, y, z), in any unit; read during the call only; may be NULL if count is 0. Vertex i is the i-th of
/// them until the triangulation is destroyed, or deldrift_compact gives new ids. Any set is legal, the empty one, coincident points and points
/// on one line or plane included; where the points do not span the dimension there are no cells. Every
/// finite coordinate from -1e57 to 1e57 is accepted, however close to zero. options: NULL for the
/// defaults; read during the call only.
///
/// out: receives the triangulation, which the caller has to hand to deldrift_destroy. It is written on
/// success only.
///
/// Cost: on all sets of docs/COSTS.md n log n and m. No set takes more than n² in 2D, or n m in 3D, where m is the most
/// cells of any subset.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_NULL_ARGUMENT,
/// DELDRIFT_MISALIGNED_ARGUMENT, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. May be called from any number of threads at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create(
    dimension: u32,
    positions: *const f64,
    count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::enter(|| {
            let out = pointers::output("out", out)?;
            let is_plane = match dimension {
                2 => true,
                3 => false,
                given => return Err(Failure::Dimension { given }),
            };
            let options = deldrift_options::read(options)?;
            let callbacks = options.callbacks();
            let options = options.convert()?;
            // Looked at here as well, lest an absurd count becomes the length of a slice.
            if count > MAX_VERTICES {
                return Err(Error::TooManyVertices { given: count, limit: MAX_VERTICES }.into());
            }
            let mut made = if is_plane {
                deldrift_triangulation::unbuilt(
                    #[inline(always)]
                    || Kernel::Plane(MovingTriangulation::unbuilt(options)),
                    callbacks,
                )?
            } else {
                deldrift_triangulation::unbuilt(
                    #[inline(always)]
                    || Kernel::Space(MovingTriangulation::unbuilt(options)),
                    callbacks,
                )?
            };
            match made.kernel.get_mut() {
                Kernel::Plane(t) => t.build_first(points::<Plane>("positions", positions, count)?)?,
                Kernel::Space(t) => t.build_first(points::<Space>("positions", positions, count)?)?,
            }
            out.write(Box::into_raw(made));
            Ok(())
        })
    }
}

/// Gives a triangulation to the caller.
pub(super) fn hand_out(
    out: &mut MaybeUninit<*mut deldrift_triangulation>,
    kernel: Kernel,
    callbacks: Callbacks,
) -> Result<(), Failure> {
    out.write(Box::into_raw(memory::boxed(deldrift_triangulation::new(kernel, callbacks))?));
    Ok(())
}

/// Destroys a triangulation: its memory is freed and its views end. NULL is legal and does nothing.
/// A poisoned triangulation is destroyed like any other. From inside a callback of a call on the same
/// triangulation this does nothing but set deldrift_last_error.
///
/// Cost: n + m at most.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_destroy(t: *mut deldrift_triangulation) {
    if t.is_null() {
        return;
    }
    // There is no one to give the status to; the message is there for who looks for it.
    let _ = fence::enter(|| {
        // SAFETY: made by deldrift_create and, by the header's contract, not used by another thread.
        let handle = unsafe { pointers::reference("t", t.cast_const()) }?;
        handle.check_unused()?;
        // SAFETY: it came from a Box, and no call below this one on the stack is using it.
        drop(unsafe { Box::from_raw(t) });
        Ok(())
    });
}

/// The dimension of the triangulation, 2 or 3, to *dimension.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_dimension(
    t: *const deldrift_triangulation,
    dimension: *mut u32,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe { tell!(t, dimension, t => dimension_of(t) as u32) }
}

/// The number of coordinates of a point of `t`.
pub(super) fn dimension_of<G: Dimension>(_t: &MovingTriangulation<G>) -> usize {
    G::D
}

/// Changes the algorithm of later commits. Staged moves stay. Tolerances and delimiters that the new
/// algorithm needs and the old one did not keep are computed by the next commit.
///
/// Cost: n + m at most, to free what the old one keeps.
///
/// Errors: DELDRIFT_NULL_ARGUMENT, DELDRIFT_INVALID_OPTIONS for a number that is no algorithm of this
/// version. Not to be called at the same time as any other call on t.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_set_algorithm(
    t: *mut deldrift_triangulation,
    algorithm: AlgorithmCode,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe {
        fence::change(t, |kernel| {
            let algorithm = options::algorithm("algorithm", algorithm)?;
            in_its_dimension!(kernel, t => t.set_algorithm(algorithm));
            Ok(())
        })
    }
}

/// The algorithm in force, to *algorithm: the one chosen, thus DELDRIFT_AUTO where the library chooses.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NULL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_get_algorithm(
    t: *const deldrift_triangulation,
    algorithm: *mut AlgorithmCode,
) -> deldrift_status {
    // SAFETY: the header's conditions on pointers.
    unsafe { tell!(t, algorithm, t => t.algorithm().code()) }
}
