//! How often filters have left a sign to exact arithmetic.

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

/// Counts one.
#[inline(always)]
pub(super) fn count() {
    EXACT.set(EXACT.get() + 1);
}

/// Counts those that another thread has evaluated for the current one.
pub(crate) fn add_exact_calls(n: u64) {
    EXACT.set(EXACT.get() + n);
}
