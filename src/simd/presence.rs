//! Whether there are the processor's own lanes: asked once, and remembered.

use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Whether there is a token: not known yet, no, or yes.
pub struct Presence(AtomicU8);

const UNKNOWN: u8 = 0;
const NO: u8 = 1;
const YES: u8 = 2;

impl Presence {
    /// Of a token that nobody has asked for.
    pub const fn unknown() -> Self {
        Presence(AtomicU8::new(UNKNOWN))
    }

    /// The answer; `detect` is asked for it first, and notes it.
    #[inline(always)]
    pub fn is_there(&self, detect: impl FnOnce() -> bool) -> bool {
        match self.0.load(Relaxed) {
            YES => true,
            UNKNOWN => detect(),
            _ => false,
        }
    }

    /// Remembers the answer, and gives it.
    pub fn note(&self, is_there: bool) -> bool {
        self.0.store(if is_there { YES } else { NO }, Relaxed);
        is_there
    }
}

/// Whether `DELDRIFT_SCALAR` is set. Does not allocate, unlike the function of the standard library.
pub fn is_scalar_path_forced() -> bool {
    // SAFETY: the name ends with a zero, and what the answer points to is not read.
    !unsafe { libc::getenv(c"DELDRIFT_SCALAR".as_ptr()) }.is_null()
}
