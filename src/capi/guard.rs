//! What stands between C and the library: failures and panics become a status and a message.
//!
//! Rust announces a panic on the standard error stream before it unwinds. A library must not, so the first entry puts a
//! hook in front of the one in place: inside an entry it writes the announcement to the message of the thread, on a
//! thread of the library's own it leaves that to the entry that has work done there, where the panic is raised again,
//! and elsewhere it hands it on unchanged. The shared and the static library bring a standard library of their own,
//! where no panics but deldrift's arise.
//!
//! Inside an entry the floating-point environment is the default one. The caller's is kept, put back in the end with
//! the flags that it had, and in force while a callback runs. What a callback makes of it is the caller's, too.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Once, OnceLock};

use super::message;
use super::status::{Failure, deldrift_status};
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
    message::record(format_args!("{failure}"));
    failure.status()
}

thread_local! {
    static HERE: Here = const { Here { is_inside: Cell::new(false), callers: Cell::new(Environment::DEFAULT) } };
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
        message::record(format_args!("{panic}"));
    } else if !threads::is_worker()
        && let Some(before) = BEFORE.get()
    {
        before(panic);
    }
}
