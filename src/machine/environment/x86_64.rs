//! The environment of x86-64.

use std::arch::asm;

/// MXCSR.
pub(super) type Registers = u32;

/// All exceptions masked, to the nearest number.
pub(super) const DEFAULT: Registers = 0x1f80;

/// One for each exception.
const FLAGS: Registers = 0x3f;

/// Without the flags.
#[inline(always)]
pub(super) fn control(registers: Registers) -> Registers {
    registers & !FLAGS
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

/// Downwards, numbers near zero are zero, with the flag of a division by zero.
#[cfg(test)]
pub(super) const FOREIGN: Registers = 0x1f80 | 0x2000 | 0x8040 | 0x4;

/// All flags; two exceptions that trap.
#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [0x1f80 | FLAGS, 0x1000];
