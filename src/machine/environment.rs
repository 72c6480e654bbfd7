//! The floating-point environment of a thread: how numbers are rounded, which exceptions trap, whether numbers near
//! zero count as zero, and the flags of exceptions that stay set.
//!
//! Arithmetic here, and all that the compiler makes of it, is meant for the *default* environment: to the nearest
//! number, without traps, with numbers near zero as they are. A program may have another one, which a thread that it
//! starts inherits. [`in_default`] puts the default one in force for a piece of work, and what was there back.
//!
//! Known are those of x86-64 (MXCSR, by which all arithmetic of Rust goes; nothing uses the x87 unit, whose environment
//! is thus left alone), of x86 with SSE2 (MXCSR, and the x87 unit's, which makes numbers of integers of 64 bits there), of
//! 64-bit ARM (FPCR and FPSR), of 32-bit ARM with registers for numbers (FPSCR), and of s390x (FPC). On other processors
//! an [`Environment`] tells nothing and changes nothing.

#![allow(unsafe_code)]

#[cfg_attr(target_arch = "x86_64", path = "environment/x86_64.rs")]
#[cfg_attr(target_arch = "x86", path = "environment/i686.rs")]
#[cfg_attr(target_arch = "aarch64", path = "environment/arm64.rs")]
#[cfg_attr(all(target_arch = "arm", target_abi = "eabihf"), path = "environment/arm32.rs")]
#[cfg_attr(target_arch = "s390x", path = "environment/s390x.rs")]
#[cfg_attr(
    not(any(
        target_arch = "x86_64",
        target_arch = "x86",
        target_arch = "aarch64",
        all(target_arch = "arm", target_abi = "eabihf"),
        target_arch = "s390x"
    )),
    path = "environment/unknown.rs"
)]
mod processor;

use processor::{DEFAULT, Registers, control, read, write};

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
        if control(left.0) != DEFAULT {
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

#[cfg(all(test, not(miri)))]
pub(crate) mod tests {
    use std::hint::black_box;
    use std::panic::catch_unwind;

    use super::*;

    /// Whether there is anything to test.
    pub(crate) const IS_KNOWN: bool = size_of::<Registers>() > 0;

    /// Another one than the default.
    pub(crate) const FOREIGN: Environment = Environment(processor::FOREIGN);

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
        control(read()) == DEFAULT
    }

    /// Numbers that depend on the environment.
    fn numbers() -> [f64; 3] {
        let [one, three, least] = black_box([1.0, 3.0, f64::MIN_POSITIVE]);
        [one / three, (-one) / three, least / three]
    }

    #[test]
    fn work_is_done_in_the_default_environment() {
        if !IS_KNOWN {
            return;
        }
        let expected = in_default(numbers);
        let (found, there, after) = abroad(|| {
            let found = in_default(|| (numbers(), is_default_now()));
            (found, apart(numbers), Environment::current())
        });
        assert_eq!(found.0, expected);
        assert!(found.1 && is_default_now());
        assert!(there[1] < expected[1], "the other one is foreign");
        // s390x has none in which numbers near zero are zero.
        assert!(there[2] == 0.0 || cfg!(target_arch = "s390x"), "{there:?}");
        assert_eq!(control(after.0), control(FOREIGN.0));
    }

    #[test]
    fn flags_and_the_rest_are_put_back_by_panics_too() {
        let [flagged, other] = processor::OTHERS.map(Environment);
        for environment in [FOREIGN, Environment::DEFAULT, flagged, other] {
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
