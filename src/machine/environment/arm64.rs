//! The environment of 64-bit ARM.

use std::arch::asm;

/// FPCR, by which arithmetic goes, and FPSR, which has the flags.
pub(super) type Registers = [u64; 2];

/// No exception traps, to the nearest number.
pub(super) const DEFAULT: Registers = [0; 2];

/// Without the flags.
#[inline(always)]
pub(super) fn control([control, _]: Registers) -> Registers {
    [control, 0]
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

/// Downwards, numbers near zero are zero, with the flag of a division by zero.
#[cfg(test)]
pub(super) const FOREIGN: Registers = [0b10 << 22 | 1 << 24, 0x2];

/// All flags; upwards. Most processors cannot trap.
#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [[0, 0x9f], [0b01 << 22, 0]];
