//! Signals by which the system ends a process that writes where it cannot: to a pipe that nobody reads any more
//! (SIGPIPE), or beyond the greatest size of a file (SIGXFSZ).
//!
//! The call that writes fails as well, which says all that there is to say. So the thread blocks them while it writes,
//! and takes away what its own call has raised. How the process handles them is left alone: handlers are shared by all
//! threads.

use std::ffi::c_int;
use std::marker::PhantomData;
use std::mem::MaybeUninit;
use std::ptr;

/// While this exists, the two signals are blocked in the thread that has made it.
pub(super) struct Quiet {
    /// What was blocked before.
    before: libc::sigset_t,
    /// Which of the two had been raised before.
    pending: libc::sigset_t,
    // Each thread has its own mask.
    of_thread: PhantomData<*const ()>,
}

/// A set of signals.
fn set_of(signals: &[c_int]) -> libc::sigset_t {
    let mut set = MaybeUninit::uninit();
    // SAFETY: the first call makes the set, to which the others add signals that exist.
    unsafe {
        libc::sigemptyset(set.as_mut_ptr());
        for &signal in signals {
            libc::sigaddset(set.as_mut_ptr(), signal);
        }
        set.assume_init()
    }
}

impl Quiet {
    pub(super) fn new() -> Self {
        let (blocked, mut before, mut pending) =
            (set_of(&[libc::SIGPIPE, libc::SIGXFSZ]), set_of(&[]), set_of(&[]));
        // SAFETY: the sets are there, and these calls cannot fail with such arguments.
        unsafe {
            libc::pthread_sigmask(libc::SIG_BLOCK, &blocked, &mut before);
            libc::sigpending(&mut pending);
        }
        Quiet { before, pending, of_thread: PhantomData }
    }

    /// Takes away the signal that has been raised by a write that failed with an error.
    pub(super) fn take_raised(&self, error: c_int) {
        let signal = match error {
            libc::EPIPE => libc::SIGPIPE,
            libc::EFBIG => libc::SIGXFSZ,
            _ => return,
        };
        // SAFETY: the set is there.
        if unsafe { libc::sigismember(&self.pending, signal) } == 0 {
            take(signal);
        }
    }
}

impl Drop for Quiet {
    fn drop(&mut self) {
        // SAFETY: the set is there; nothing is wanted of the mask until now.
        unsafe { libc::pthread_sigmask(libc::SIG_SETMASK, &self.before, ptr::null_mut()) };
    }
}

/// Takes a blocked signal away, if it has been raised: it has not where the process ignores it.
#[cfg(target_os = "linux")]
fn take(signal: c_int) {
    let (set, now) = (set_of(&[signal]), libc::timespec { tv_sec: 0, tv_nsec: 0 });
    // SAFETY: the set and the time are there, and nothing is wanted of the signal.
    while unsafe { libc::sigtimedwait(&set, ptr::null_mut(), &now) } < 0
        && std::io::Error::last_os_error().raw_os_error() == Some(libc::EINTR)
    {}
}

#[cfg(not(target_os = "linux"))]
fn take(signal: c_int) {
    let (set, mut pending, mut taken) = (set_of(&[signal]), set_of(&[]), 0);
    // SAFETY: the sets are there. What waits is the thread's own, so that no other can take it before.
    unsafe {
        libc::sigpending(&mut pending);
        if libc::sigismember(&pending, signal) == 1 {
            libc::sigwait(&set, &mut taken);
        }
    }
}
