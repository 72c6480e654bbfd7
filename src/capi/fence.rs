//! What stands between C and the library: failures and panics become a status and a message.
//!
//! The message is kept for each thread in a buffer of fixed size, so that reporting needs no memory,
//! which may be just what has run out.
//!
//! Rust announces a panic on the standard error stream before it unwinds. A library must not, so the first entry puts a
//! hook in front of the one in place: inside an entry it writes the announcement to the message of the thread, on a
//! thread of the library's own it leaves that to the entry that has work done there, where the panic is raised again,
//! and elsewhere it hands it on unchanged. The shared and the static library bring a standard library of their own,
//! where no panics but deldrift's arise.
//!
//! Inside an entry the floating-point environment is the default one. The caller's is kept, put back in the end with the
//! flags that it had, and in force while a callback runs. What a callback makes of it is the caller's, too.

use std::cell::{Cell, RefCell};
use std::ffi::c_char;
use std::fmt::{self, Write};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Once, OnceLock};

use super::pointers;
use super::status::{Failure, deldrift_status};
use super::triangulation::{Kernel, deldrift_triangulation};
use crate::machine::environment::{self, Environment};
use crate::machine::threads;

/// Runs the body of an entry.
pub(super) fn enter(body: impl FnOnce() -> Result<(), Failure>) -> deldrift_status {
    hear_panics();
    HERE.with(|here| {
        let _visit = Visit::new(here);
        environment::apart(|| match panic::catch_unwind(AssertUnwindSafe(body)) {
            Ok(Ok(())) => deldrift_status::DELDRIFT_OK,
            Ok(Err(failure)) => report(&failure),
            Err(payload) => {
                // Its message has been recorded by the hook; to drop an unknown payload might panic again.
                std::mem::forget(payload);
                deldrift_status::DELDRIFT_INTERNAL_ERROR
            }
        })
    })
}

/// Calls a function of the program's, in the floating-point environment of the caller.
pub(super) fn call_back<R>(callback: impl FnOnce() -> R) -> R {
    HERE.with(|here| {
        here.callers.get().enter();
        let answer = environment::apart(callback);
        here.callers.set(Environment::leave());
        answer
    })
}

/// The status of a failure, whose message is recorded.
#[cold]
#[inline(never)]
fn report(failure: &Failure) -> deldrift_status {
    record(format_args!("{failure}"));
    failure.status()
}

/// Runs the body of an entry that looks at a triangulation.
///
/// # Safety
/// `t` is NULL, misaligned, or the triangulation of a successful creation, and no other thread changes it.
pub(super) unsafe fn read(
    t: *const deldrift_triangulation,
    body: impl FnOnce(&Kernel) -> Result<(), Failure>,
) -> deldrift_status {
    enter(|| {
        // SAFETY: the caller's promise.
        let handle = unsafe { pointers::reference("t", t) }?;
        handle.check_ready()?;
        // SAFETY: it is ready, so no call below this one on the stack is changing it, and none of
        // another thread by the caller's promise.
        body(unsafe { &*handle.kernel() })
    })
}

/// Runs the body of an entry that looks at a triangulation for long, with a monitor that calls its callbacks. These may
/// look at it as well; calls that change it are turned away.
///
/// # Safety
/// As for [`read`].
pub(super) unsafe fn read_watched(
    t: *const deldrift_triangulation,
    body: impl FnOnce(&Kernel, &mut dyn FnMut(f64) -> bool) -> Result<(), Failure>,
) -> deldrift_status {
    enter(|| {
        // SAFETY: the caller's promise.
        let handle = unsafe { pointers::reference("t", t) }?;
        handle.check_ready()?;
        let _watched = handle.watch();
        let callbacks = handle.callbacks();
        // SAFETY: as in `read`; callbacks do not change it while it is watched.
        body(unsafe { &*handle.kernel() }, &mut |fraction| callbacks.go_on(fraction))
    })
}

/// Runs the body of an entry that tells one thing about a triangulation, and writes what it tells.
///
/// # Safety
/// As for [`read`], and `out` is NULL, misaligned, or a place for a `T`.
pub(super) unsafe fn tell<T>(
    t: *const deldrift_triangulation,
    argument: &'static str,
    out: *mut T,
    body: impl FnOnce(&Kernel) -> Result<T, Failure>,
) -> deldrift_status {
    // SAFETY: the caller's promise.
    unsafe {
        read(t, |kernel| {
            let out = pointers::output(argument, out)?;
            out.write(body(kernel)?);
            Ok(())
        })
    }
}

/// Runs the body of an entry that changes a triangulation, and poisons it if the body panics.
///
/// # Safety
/// As for [`read`], and no other thread reads it.
pub(super) unsafe fn change(
    t: *mut deldrift_triangulation,
    body: impl FnOnce(&mut Kernel) -> Result<(), Failure>,
) -> deldrift_status {
    enter(|| {
        // SAFETY: the caller's promise.
        let handle = unsafe { pointers::reference("t", t.cast_const()) }?;
        let claim = handle.claim()?;
        // SAFETY: the claim excludes calls below this one on the stack, the caller those of other threads.
        let outcome = body(unsafe { &mut *handle.kernel() });
        claim.release();
        outcome
    })
}

/// Makes a change so short that the fence would cost as much: the body cannot panic, and calls nothing of the
/// caller's. Whether it was made; if not, nothing has happened.
///
/// # Safety
/// As for [`change`].
#[inline(always)]
pub(super) unsafe fn change_shortly(
    t: *mut deldrift_triangulation,
    body: impl FnOnce(&mut Kernel) -> bool,
) -> bool {
    environment::in_default(|| {
        // SAFETY: the caller's promise.
        let handle = unsafe { pointers::reference("t", t.cast_const()) };
        handle.is_ok_and(|handle| {
            let is_free = handle.check_ready().is_ok() && handle.check_unused().is_ok();
            // SAFETY: as in `change`.
            is_free && body(unsafe { &mut *handle.kernel() })
        })
    })
}

/// The message of the last failure on this thread.
pub(super) fn last_message() -> *const c_char {
    MESSAGE.with(|message| message.as_ptr().cast_const().cast())
}

thread_local! {
    static HERE: Here = const { Here { is_inside: Cell::new(false), callers: Cell::new(Environment::DEFAULT) } };
    static MESSAGE: RefCell<Message> = const { RefCell::new(Message { bytes: [0; CAPACITY], length: 0 }) };
}

/// What a thread is in the midst of.
struct Here {
    /// Whether it is inside an entry.
    is_inside: Cell<bool>,
    /// The floating-point environment that the innermost entry has been called in, or that its callbacks have left.
    callers: Cell<Environment>,
}

/// A thread's being inside an entry, and before, perhaps, inside another one, a callback of which has called this one.
struct Visit<'h> {
    here: &'h Here,
    was_inside: bool,
    callers_before: Environment,
}

impl<'h> Visit<'h> {
    #[inline(always)]
    fn new(here: &'h Here) -> Self {
        let callers_before = here.callers.replace(Environment::leave());
        Visit { here, was_inside: here.is_inside.replace(true), callers_before }
    }
}

impl Drop for Visit<'_> {
    #[inline(always)]
    fn drop(&mut self) {
        self.here.is_inside.set(self.was_inside);
        self.here.callers.replace(self.callers_before).enter();
    }
}

const CAPACITY: usize = 512;

/// Text that is cut where it no longer fits and always ends in a NUL. The bytes come first: the message
/// and its text have the same address.
#[repr(C)]
struct Message {
    bytes: [u8; CAPACITY],
    length: usize,
}

impl Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = (CAPACITY - 1 - self.length).min(text.len());
        let cut = (0..=room).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        let text = &text.as_bytes()[..cut];
        let end = self.length + text.len();
        for (byte, &given) in self.bytes[self.length..end].iter_mut().zip(text) {
            *byte = if given == 0 { b'?' } else { given };
        }
        self.bytes[end] = 0;
        self.length = end;
        Ok(())
    }
}

/// Makes `text` the message of this thread.
#[cold]
#[inline(never)]
pub(super) fn record(text: fmt::Arguments<'_>) {
    MESSAGE.with(|message| {
        // Taken only if writing the text itself panics; the outer text is then the better one.
        if let Ok(mut message) = message.try_borrow_mut() {
            message.length = 0;
            message.bytes[0] = 0;
            // Writing to a Message never fails, and a Display that does leaves its beginning.
            let _ = message.write_fmt(text);
        }
    });
}

/// Puts the hook in place, once.
#[inline(always)]
fn hear_panics() {
    if !PLACED.is_completed() {
        place_hook();
    }
}

/// Whether the hook is in place.
static PLACED: Once = Once::new();

#[cold]
#[inline(never)]
fn place_hook() {
    // The hook cannot be exchanged while a panic of the host unwinds through its destructors.
    if std::thread::panicking() {
        return;
    }
    PLACED.call_once(|| {
        BEFORE.get_or_init(panic::take_hook);
        // A function keeps nothing, so its box needs no memory, which here could not be refused.
        panic::set_hook(Box::new(hear));
    });
}

type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync>;

/// The hook that was in place.
static BEFORE: OnceLock<Hook> = OnceLock::new();

fn hear(panic: &PanicHookInfo<'_>) {
    if HERE.with(|here| here.is_inside.get()) {
        record(format_args!("{panic}"));
    } else if !threads::is_worker()
        && let Some(before) = BEFORE.get()
    {
        before(panic);
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;
    use std::ptr::null_mut;

    use super::super::*;
    use super::*;

    fn message() -> String {
        // SAFETY: the message always ends in a NUL.
        unsafe { CStr::from_ptr(last_message()) }.to_str().expect("messages are UTF-8").to_string()
    }

    fn square() -> *mut deldrift_triangulation {
        let (positions, mut t) = ([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.1, 1.1], null_mut());
        // SAFETY: four points are there, and a place for the result.
        let status = unsafe { deldrift_create(2, positions.as_ptr(), 4, std::ptr::null(), &mut t) };
        assert_eq!(status, deldrift_status::DELDRIFT_OK);
        t
    }

    #[test]
    fn panic_in_a_change_poisons_the_triangulation() {
        let (t, mut count) = (square(), 77);
        // SAFETY: `t` lives until its destruction at the end.
        unsafe {
            let status = change(t, |_| panic!("cell {} went missing", 13));
            assert_eq!(status, deldrift_status::DELDRIFT_INTERNAL_ERROR);
            assert!(
                message().contains("cell 13 went missing") && message().contains("fence.rs"),
                "{}",
                message()
            );

            assert_eq!(deldrift_cell_count(t, &mut count), deldrift_status::DELDRIFT_POISONED);
            assert_eq!(deldrift_commit_timestamp(t, null_mut()), deldrift_status::DELDRIFT_POISONED);
            assert_eq!(deldrift_validate(t, 1), deldrift_status::DELDRIFT_POISONED);
            assert!(message().contains("unusable"), "{}", message());
            assert_eq!(count, 77);
            deldrift_destroy(t);
        }
    }

    #[test]
    fn panic_in_a_query_is_an_internal_error_and_no_more() {
        let (t, mut count) = (square(), 0);
        // SAFETY: `t` lives until its destruction at the end.
        unsafe {
            assert_eq!(read(t, |_| panic!("oh")), deldrift_status::DELDRIFT_INTERNAL_ERROR);
            assert_eq!(deldrift_cell_count(t, &mut count), deldrift_status::DELDRIFT_OK);
            assert_eq!(count, 2);
            deldrift_destroy(t);
        }
    }

    #[test]
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    fn panic_leaves_the_environment_of_the_caller() {
        use crate::machine::environment::tests::{FOREIGN, abroad, is_default_now};
        let t = square();
        // SAFETY: `t` lives until its destruction at the end.
        unsafe {
            let (status, after) = abroad(|| {
                let status = change(t, |_| {
                    assert!(is_default_now());
                    assert!(call_back(Environment::current) == FOREIGN && is_default_now());
                    panic!("{} of {}", 1.0 / 3.0, f64::NAN)
                });
                (status, Environment::current())
            });
            assert_eq!((status, after), (deldrift_status::DELDRIFT_INTERNAL_ERROR, FOREIGN));
            assert!(message().contains("0.333333333333") && message().contains("of NaN"), "{}", message());
            deldrift_destroy(t);
        }
    }

    #[test]
    fn panic_on_another_thread_is_one_here() {
        let t = square();
        // SAFETY: `t` lives until its destruction at the end.
        unsafe {
            let status = change(t, |_| {
                threads::join(|| (), || panic!("cell {} went missing", 14));
                Ok(())
            });
            assert_eq!(status, deldrift_status::DELDRIFT_INTERNAL_ERROR);
            assert!(message().contains("cell 14 went missing"), "{}", message());
            assert_eq!(deldrift_validate(t, 1), deldrift_status::DELDRIFT_POISONED);
            deldrift_destroy(t);
        }
    }

    #[test]
    fn long_messages_are_cut_between_characters() {
        record(format_args!("a{}", "é".repeat(CAPACITY)));
        assert_eq!(message(), format!("a{}", "é".repeat((CAPACITY - 2) / 2)));
        record(format_args!("nul \0 within"));
        assert_eq!(message(), "nul ? within");
    }
}
