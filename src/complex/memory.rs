//! Room for large arrays.
//!
//! An array of many megabytes that is written once in storage order costs a page fault every few kilobytes: a
//! fifth of a 2D build of a million sites. Where the system has large pages for those who ask, ask.

#![allow(unsafe_code)]

use crate::error::{Error, Result};

/// Arrays below this size stay on ordinary pages.
const LARGE: usize = 4 << 20;

/// Makes room for exactly `more` more entries.
pub(crate) fn reserve_exact<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    array.try_reserve_exact(more).map_err(|_| Error::OutOfMemory { bytes: more * size_of::<T>() })?;
    if array.capacity() * size_of::<T>() >= LARGE {
        advise_large_pages(array.as_mut_ptr().cast(), array.capacity() * size_of::<T>());
    }
    Ok(())
}

/// Makes room for `more` more entries at least; where more follow, in constant time each.
pub(crate) fn reserve<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    array.try_reserve(more).map_err(|_| Error::OutOfMemory { bytes: more * size_of::<T>() })
}

/// Makes sure that an array of so many entries could be had: for those who take one
/// without a way to say that there is none.
pub(crate) fn make_sure_of<T>(count: usize) -> Result<()> {
    let mut array = Vec::<T>::new();
    let reserved = array.try_reserve_exact(count);
    std::hint::black_box(&array);
    reserved.map_err(|_| Error::OutOfMemory { bytes: count * size_of::<T>() })
}

#[cfg(target_os = "linux")]
fn advise_large_pages(start: *mut u8, bytes: usize) {
    const PAGE: usize = 4096;
    let skipped = start.align_offset(PAGE);
    if skipped < bytes {
        // SAFETY: the range is whole pages of an allocation of ours; the advice changes no content. Whether
        // it is taken is a matter of speed alone, so the result is not needed.
        unsafe {
            libc::madvise(start.add(skipped).cast(), (bytes - skipped) / PAGE * PAGE, libc::MADV_HUGEPAGE)
        };
    }
}

#[cfg(not(target_os = "linux"))]
fn advise_large_pages(_: *mut u8, _: usize) {}
