//! Who is asked, now and then, whether to go on.
//!
//! Work is counted in cells that are looked at or made, some tens of nanoseconds each, so that it depends on neither
//! the machine nor the clock when that is.

use std::fmt;

use crate::error::{Error, Result};

/// Called now and then with the fraction of the work done, from 0 to 1; returning `false` cancels.
pub type Monitor = Box<dyn FnMut(f64) -> bool + Send + Sync>;

/// Work between two questions.
pub(crate) const ASKED_EVERY: u64 = 1 << 14;

/// A monitor, and the work since it was asked.
#[derive(Default)]
pub(crate) struct Pace {
    monitor: Option<Monitor>,
    work: u64,
    /// What it was told last.
    fraction: f64,
    /// Whether it is not asked before anything is done.
    skips_start: bool,
}

impl fmt::Debug for Pace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pace")
            .field("work", &self.work)
            .field("fraction", &self.fraction)
            .finish_non_exhaustive()
    }
}

impl Pace {
    /// Asks this monitor from now on.
    pub(crate) fn set_monitor(&mut self, monitor: Option<Monitor>) {
        self.monitor = monitor;
    }

    /// A call begins.
    #[inline(always)]
    pub(crate) fn begin(&mut self) {
        (self.work, self.fraction, self.skips_start) = (0, 0.0, false);
    }

    /// In the call that has begun, which mostly is a short one, nobody is asked before anything is done.
    pub(crate) fn skip_start(&mut self) {
        self.skips_start = true;
    }

    /// Counts work.
    #[inline(always)]
    pub(crate) fn count(&mut self, work: usize) {
        self.work += work as u64;
    }

    /// Whether it is time to ask.
    #[inline(always)]
    pub(crate) fn is_due(&self) -> bool {
        self.work >= ASKED_EVERY
    }

    /// Tells how far the work is; whether to go on.
    pub(crate) fn ask(&mut self, fraction: f64) -> bool {
        (self.work, self.fraction) = (0, fraction);
        if self.skips_start && fraction == 0.0 {
            return true;
        }
        self.monitor.as_mut().is_none_or(|monitor| monitor(fraction))
    }

    /// Asks where it is not known how far the work is: it is as far as it was.
    #[cold]
    pub(crate) fn ask_again(&mut self) -> Result<()> {
        if self.ask(self.fraction) { Ok(()) } else { Err(Error::Cancelled) }
    }

    /// Bytes held.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.monitor.as_ref().map_or(0, |monitor| size_of_val(&**monitor))
    }
}
