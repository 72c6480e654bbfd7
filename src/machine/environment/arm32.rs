//! The environment of 32-bit ARM with registers for numbers.

use std::arch::asm;

/// FPSCR, without the results of the latest comparison, which calls need not keep.
pub(super) type Registers = u32;

/// No exception traps, to the nearest number.
pub(super) const DEFAULT: Registers = 0;

/// One for each exception, and for saturation.
const FLAGS: Registers = 0x0800_009f;

const COMPARISON: Registers = 0xf000_0000;

/// Without the flags.
#[inline(always)]
pub(super) fn control(registers: Registers) -> Registers {
    registers & !FLAGS
}

#[inline(always)]
pub(super) fn read() -> Registers {
    let registers: Registers;
    // SAFETY: any program may read this register.
    unsafe { asm!("vmrs {}, fpscr", out(reg) registers, options(nostack, preserves_flags)) };
    registers & !COMPARISON
}

#[inline(always)]
pub(super) fn write(registers: Registers) {
    // SAFETY: any program may write this register: the default, or what has been read. Arithmetic in another
    // environment than the default one is that of the program, which has put it in force.
    unsafe { asm!("vmsr fpscr, {}", in(reg) registers, options(nostack)) };
}

/// Downwards, numbers near zero are zero, with the flag of a division by zero.
#[cfg(test)]
pub(super) const FOREIGN: Registers = 0b10 << 22 | 1 << 24 | 0x2;

/// All flags of exceptions; upwards. Most processors cannot trap.
#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [0x9f, 0b01 << 22];
