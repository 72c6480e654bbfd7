//! How often each thread has needed exact arithmetic. What [`join`](super::threads::join) has done on another thread
//! counts for the calling one.

use std::cell::Cell;

thread_local! {
    static EXACT: Cell<u64> = const { Cell::new(0) };
}

/// Signs of determinants that the current thread has had to take by exact arithmetic so far, ties included:
/// those that neither the static nor the semi-static stage decided. Differences of this number tell what
/// some work needed.
pub fn exact_calls() -> u64 {
    EXACT.get()
}

/// Counts a sign that takes exact arithmetic.
#[inline(always)]
pub(crate) fn count() {
    add(1);
}

/// Does work of which no sign counts for the current thread.
pub(crate) fn uncounted<T>(work: impl FnOnce() -> T) -> T {
    let before = EXACT.get();
    let done = work();
    forget_since(before);
    done
}

/// Has no sign count that the current thread has needed since there were so many.
pub(crate) fn forget_since(before: u64) {
    EXACT.set(before);
}

/// Counts signs that another thread has taken by exact arithmetic for the current one.
#[inline(always)]
pub(super) fn add(n: u64) {
    EXACT.set(EXACT.get() + n);
}
