//! Put into the copy of the library: which mutant is alive, or which are reached.
#![allow(missing_docs, unsafe_code)]

use std::sync::atomic::{AtomicU8, AtomicU32, Ordering};

/// Above all ids: the environment was not asked yet.
const UNKNOWN: u32 = 1 << 31;
/// Above all ids: none is alive, and those reached are written to the file DELDRIFT_REACHED at the end.
const RECORDING: u32 = 1 << 30;
const N_MUTANTS: usize = 1 << 17;

pub static ALIVE: AtomicU32 = AtomicU32::new(UNKNOWN);
static REACHED: [AtomicU8; N_MUTANTS] = [const { AtomicU8::new(0) }; N_MUTANTS];

/// One comparison where `id` is not alive, so that the tests are hardly slower.
#[inline(always)]
pub fn on(id: u32) -> bool {
    let difference = ALIVE.load(Ordering::Relaxed) ^ id;
    difference.wrapping_sub(1) >= RECORDING - 1 && decide(id)
}

#[cold]
#[inline(never)]
pub fn decide(id: u32) -> bool {
    let alive = match ALIVE.load(Ordering::Relaxed) {
        UNKNOWN => ask(),
        known => known,
    };
    if alive == RECORDING {
        REACHED[id as usize].store(1, Ordering::Relaxed);
    }
    alive == id
}

/// Reads the environment without allocating: tests count allocations.
fn ask() -> u32 {
    // SAFETY: the names end with a zero, and no test writes to the environment meanwhile.
    let alive = unsafe {
        let number = libc::getenv(c"DELDRIFT_MUTANT".as_ptr());
        if number.is_null() { RECORDING } else { libc::strtoul(number, std::ptr::null_mut(), 10) as u32 }
    };
    if ALIVE.swap(alive, Ordering::Relaxed) == UNKNOWN && alive == RECORDING {
        // SAFETY: `write_reached` may be called when the program ends.
        unsafe { libc::atexit(write_reached) };
    }
    alive
}

extern "C" fn write_reached() {
    if let Some(file) = std::env::var_os("DELDRIFT_REACHED") {
        let bytes: Vec<u8> = REACHED.iter().map(|reached| reached.load(Ordering::Relaxed)).collect();
        let _ = std::fs::write(file, bytes);
    }
}
