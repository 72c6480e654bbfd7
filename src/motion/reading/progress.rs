//! How far reading that takes long is, for the monitor that a program gives it.

use crate::error::{Error, Result};

/// How much is done between two calls of a monitor, in cells or pairs of cells visited.
const WORK: usize = 1 << 15;

/// Tells a monitor how far the work is.
pub(crate) struct Progress<'m> {
    monitor: &'m mut dyn FnMut(f64) -> bool,
    done: usize,
    asked_at: usize,
    expected: usize,
    /// The fraction that has been told, which does not go back when more is expected.
    told: f64,
}

impl<'m> Progress<'m> {
    pub(crate) fn new(monitor: &'m mut dyn FnMut(f64) -> bool, expected: usize) -> Self {
        Progress { monitor, done: 0, asked_at: 0, expected, told: 0.0 }
    }

    /// Expects so much work besides what is done.
    pub(crate) fn expect_more(&mut self, more: usize) {
        self.expected = (self.done + more).max(1);
    }

    /// Some more has been done.
    #[inline(always)]
    pub(crate) fn advance(&mut self, n: usize) -> Result<()> {
        self.done += n;
        if self.done - self.asked_at < WORK { Ok(()) } else { self.ask() }
    }

    #[cold]
    fn ask(&mut self) -> Result<()> {
        self.asked_at = self.done;
        self.told = self.told.max((self.done as f64 / self.expected as f64).min(1.0));
        if (self.monitor)(self.told) { Ok(()) } else { Err(Error::Cancelled) }
    }
}
