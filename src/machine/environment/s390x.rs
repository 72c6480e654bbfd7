//! The environment of s390x.

use std::arch::asm;

/// The register FPC.
pub(super) type Registers = u32;

/// No exception traps, to the nearest number.
pub(super) const DEFAULT: Registers = 0;

/// One for each exception, and the code of the latest one that was told.
const FLAGS: Registers = 0x00ff_ff00;

/// Without the flags.
#[inline(always)]
pub(super) fn control(registers: Registers) -> Registers {
    registers & !FLAGS
}

#[inline(always)]
pub(super) fn read() -> Registers {
    let registers: Registers;
    // SAFETY: any program may read this register.
    unsafe { asm!("efpc {}", out(reg) registers, options(nostack, preserves_flags)) };
    registers
}

#[inline(always)]
pub(super) fn write(registers: Registers) {
    // SAFETY: any program may write this register: the default, or what has been read. Arithmetic in another
    // environment than the default one is that of the program, which has put it in force.
    unsafe { asm!("sfpc {}", in(reg) registers, options(nostack)) };
}

/// Downwards, with the flag of a division by zero. Numbers near zero are always what they are.
#[cfg(test)]
pub(super) const FOREIGN: Registers = 0x3 | 0x0040_0000;

/// All flags; upwards.
#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [0x00f8_0000, 0x2];
