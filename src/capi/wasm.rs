//! What a program in JavaScript needs besides the C functions, as it has no allocator: memory for arguments and
//! results, in the memory that both see.
//!
//! js/src/library.js calls these; no header has them.

use std::alloc::{Layout, alloc, dealloc};

use super::guard;
use super::status::deldrift_status;

/// More than any type of the header asks for.
const ALIGNMENT: usize = 16;

fn layout(bytes: usize) -> Option<Layout> {
    Layout::from_size_align(bytes.max(1), ALIGNMENT).ok()
}

/// So many bytes, which [`deldrift_js_free`] takes back; NULL if there is no memory.
#[unsafe(no_mangle)]
pub extern "C" fn deldrift_js_allocate(bytes: usize) -> *mut u8 {
    // SAFETY: it is one byte at least.
    layout(bytes).map_or(std::ptr::null_mut(), |layout| unsafe { alloc(layout) })
}

/// Frees what [`deldrift_js_allocate`] has given for so many bytes, once. NULL is legal.
///
/// # Safety
/// Nobody uses it after this.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_js_free(start: *mut u8, bytes: usize) {
    if let Some(layout) = layout(bytes).filter(|_| !start.is_null()) {
        // SAFETY: it has been made by this layout, and nobody uses it.
        unsafe { dealloc(start, layout) };
    }
}

/// Panics, as only a defect can: js/test/unpacked.test.js sees what comes of that. It is in no package.
#[unsafe(no_mangle)]
pub extern "C" fn deldrift_js_panic() -> deldrift_status {
    guard::enter(|| panic!("cell {} went missing", 13))
}
