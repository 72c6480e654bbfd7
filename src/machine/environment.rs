//! The floating-point environment of a thread: how numbers are rounded, which exceptions trap, whether numbers near
//! zero count as zero, and the flags of exceptions that stay set.
//!
//! Arithmetic here, and all that the compiler makes of it, is meant for the *default* environment: to the nearest
//! number, without traps, with numbers near zero as they are. A program may have another one, which a thread that it
//! starts inherits. [`in_default`] puts the default one in force for a piece of work, and what was there back.
//!
//! Known are those of x86-64 (MXCSR, by which all arithmetic of Rust goes; nothing uses the x87 unit, whose environment
//! is thus left alone) and of 64-bit ARM (FPCR and FPSR). On other processors an [`Environment`] tells nothing and
//! changes nothing.

#![allow(unsafe_code)]

/// An environment, flags included.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Environment(Registers);

impl Environment {
    /// Without any flag.
    pub(crate) const DEFAULT: Environment = Environment(DEFAULT);

    /// The one in force.
    #[inline(always)]
    pub(crate) fn current() -> Self {
        Environment(read())
    }

    /// From now on the default one is in force, with any flags. The one that was.
    #[inline(always)]
    pub(crate) fn leave() -> Self {
        let left = Self::current();
        if !is_default(left.0) {
            write(DEFAULT);
        }
        left
    }

    /// From now on it is in force.
    #[inline(always)]
    pub(crate) fn enter(self) {
        // Reading takes less time than writing.
        if read() != self.0 {
            write(self.0);
        }
    }
}

/// Puts an environment in force when dropped.
struct Left(Environment);

impl Drop for Left {
    #[inline(always)]
    fn drop(&mut self) {
        self.0.enter();
    }
}

/// Does work in the default environment, and puts back the one that was there, with its flags.
#[inline(always)]
pub(crate) fn in_default<R>(work: impl FnOnce() -> R) -> R {
    let _left = Left(Environment::leave());
    apart(work)
}

/// Does work in a function of its own. To the compiler arithmetic has nothing to do with the environment: within one
/// function it may do it before the environment is changed, or after.
#[inline(never)]
pub(crate) fn apart<R>(work: impl FnOnce() -> R) -> R {
    work()
}

#[cfg(target_arch = "x86_64")]
use x86::{DEFAULT, Registers, is_default, read, write};

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::asm;

    /// MXCSR.
    pub(super) type Registers = u32;

    /// All exceptions masked, to the nearest number.
    pub(super) const DEFAULT: Registers = 0x1f80;

    /// One for each exception.
    const FLAGS: Registers = 0x3f;

    #[inline(always)]
    pub(super) fn is_default(registers: Registers) -> bool {
        registers & !FLAGS == DEFAULT
    }

    #[inline(always)]
    pub(super) fn read() -> Registers {
        let mut registers: Registers = 0;
        // SAFETY: it writes 4 bytes, which are there.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut registers, options(nostack, preserves_flags)) };
        registers
    }

    #[inline(always)]
    pub(super) fn write(registers: Registers) {
        // SAFETY: it reads 4 bytes, which are there: the default, or what has been read, so that no bit is set that the
        // processor does not know. Arithmetic in another environment than the default one is that of the program, which
        // has put it in force.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const registers, options(nostack)) };
    }
}

#[cfg(target_arch = "aarch64")]
use arm::{DEFAULT, Registers, is_default, read, write};

#[cfg(target_arch = "aarch64")]
mod arm {
    use std::arch::asm;

    /// FPCR, by which arithmetic goes, and FPSR, which has the flags.
    pub(super) type Registers = [u64; 2];

    pub(super) const DEFAULT: Registers = [0; 2];

    #[inline(always)]
    pub(super) fn is_default(registers: Registers) -> bool {
        registers[0] == DEFAULT[0]
    }

    #[inline(always)]
    pub(super) fn read() -> Registers {
        let (control, status): (u64, u64);
        // SAFETY: any program may read these registers.
        unsafe {
            asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) status, options(nostack, preserves_flags));
        }
        [control, status]
    }

    #[inline(always)]
    pub(super) fn write([control, status]: Registers) {
        // SAFETY: any program may write these registers: the default, or what has been read. Arithmetic in another
        // environment than the default one is that of the program, which has put it in force.
        unsafe {
            asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) status, options(nostack));
        }
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
use unknown::{DEFAULT, Registers, is_default, read, write};

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod unknown {
    pub(super) type Registers = ();

    pub(super) const DEFAULT: Registers = ();

    pub(super) fn is_default((): Registers) -> bool {
        true
    }

    pub(super) fn read() -> Registers {}

    pub(super) fn write((): Registers) {}
}

#[cfg(all(test, target_arch = "x86_64", not(miri)))]
pub(crate) mod tests {
    use std::hint::black_box;
    use std::panic::catch_unwind;

    use super::*;

    /// Downwards, numbers near zero are zero, with the flag of a division by zero.
    pub(crate) const FOREIGN: Environment = Environment(0x1f80 | 0x2000 | 0x8040 | 0x4);

    /// Does work in a foreign environment, and leaves it.
    pub(crate) fn abroad<R>(work: impl FnOnce() -> R) -> R {
        let own = Environment::current();
        FOREIGN.enter();
        let outcome = apart(work);
        own.enter();
        outcome
    }

    /// Whether it is the default one but for flags.
    pub(crate) fn is_default_now() -> bool {
        is_default(read())
    }

    /// Numbers that depend on the environment.
    fn numbers() -> [f64; 3] {
        let [one, three, least] = black_box([1.0, 3.0, f64::MIN_POSITIVE]);
        [one / three, (-one) / three, least / three]
    }

    #[test]
    fn work_is_done_in_the_default_environment() {
        let expected = in_default(numbers);
        let (found, there, after) = abroad(|| {
            let found = in_default(|| (numbers(), is_default_now()));
            (found, apart(numbers), Environment::current())
        });
        assert_eq!(found.0, expected);
        assert!(found.1 && is_default_now());
        assert!(there[1] < expected[1] && there[2] == 0.0, "the other one is foreign");
        assert_eq!(after.0 & !0x3f, FOREIGN.0 & !0x3f);
    }

    #[test]
    fn flags_and_the_rest_are_put_back_by_panics_too() {
        for environment in [FOREIGN, Environment::DEFAULT, Environment(0x1f80 | 0x3f), Environment(0x1000)] {
            let own = Environment::leave();
            environment.enter();
            in_default(|| black_box(numbers()));
            let after = Environment::current();
            let panicked = catch_unwind(|| in_default(|| panic!("{:?}", numbers()))).is_err();
            let after_panic = Environment::current();
            own.enter();
            assert!(panicked);
            assert_eq!((after, after_panic), (environment, environment));
        }
    }
}
