//! The environment of 32-bit x86 with SSE2.

use std::arch::asm;

// Without SSE2 numbers would be kept with more bits than they have, and rounded twice.
#[cfg(not(target_feature = "sse2"))]
compile_error!(
    "deldrift needs SSE2 on x86: the x87 unit rounds numbers twice, so that exact answers would be wrong"
);

/// MXCSR, by which arithmetic goes, and of the x87 unit, which makes numbers of integers of 64 bits, the control word and
/// the flags.
pub(super) type Registers = [u32; 3];

/// All exceptions masked, to the nearest number, the x87 unit with all bits that it has.
pub(super) const DEFAULT: Registers = [0x1f80, 0x037f, 0];

/// One for each exception, and for the stack of the x87 unit, which tells a fault by it.
const FLAGS: u32 = 0x3f;
const X87_FLAGS: u32 = 0x7f;

/// Without the flags.
#[inline(always)]
pub(super) fn control([mxcsr, x87, _]: Registers) -> Registers {
    [mxcsr & !FLAGS, x87, 0]
}

#[inline(always)]
pub(super) fn read() -> Registers {
    let (mut mxcsr, mut x87, mut status) = (0_u32, 0_u16, 0_u16);
    // SAFETY: they write 4 bytes and twice 2, which are there.
    unsafe {
        asm!(
            "stmxcsr [{}]", "fnstcw [{}]", "fnstsw [{}]",
            in(reg) &raw mut mxcsr, in(reg) &raw mut x87, in(reg) &raw mut status,
            options(nostack, preserves_flags)
        );
    }
    [mxcsr, x87.into(), u32::from(status) & X87_FLAGS]
}

#[inline(always)]
pub(super) fn write([mxcsr, x87, flags]: Registers) {
    // The words of the x87 unit: control, status, and five that stay as they are.
    let mut words = [0_u32; 7];
    // SAFETY: it writes 28 bytes, which are there. It masks all exceptions, until the words are read again.
    unsafe { asm!("fnstenv [{}]", in(reg) words.as_mut_ptr(), options(nostack, preserves_flags)) };
    words[0] = words[0] & 0xffff_0000 | x87;
    words[1] = words[1] & !0xff | flags;
    // SAFETY: they read 28 bytes and 4, which are there: the default, or what has been read, so that no bit is set that
    // the processor does not know. Arithmetic in another environment than the default one is that of the program, which
    // has put it in force.
    unsafe {
        asm!(
            "fldenv [{}]", "ldmxcsr [{}]",
            in(reg) words.as_ptr(), in(reg) &raw const mxcsr,
            options(nostack, preserves_flags)
        );
    }
}

/// Downwards, numbers near zero are zero, with the flag of a division by zero.
#[cfg(test)]
pub(super) const FOREIGN: Registers = [0x1f80 | 0x2000 | 0x8040 | 0x4, 0x037f | 0x0400, 0];

/// All flags; two exceptions that trap.
#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [[0x1f80 | FLAGS, 0x037f, FLAGS], [0x1000, 0x027f, 0]];
