//! Pointers from C, checked as far as they can be and turned into references.
//!
//! Each of these trusts that a pointer which is neither NULL nor misaligned points to `T`, or to as many
//! of them as it is told, for as long as the call lasts; outputs may be uninitialised.

use std::mem::MaybeUninit;
use std::{ptr, slice};

use super::status::{Failure, Wrong};

/// A value that must be there.
pub(super) unsafe fn reference<'a, T>(argument: &'static str, pointer: *const T) -> Result<&'a T, Failure> {
    check(argument, pointer)?;
    // SAFETY: neither NULL nor misaligned, and the caller vouches for the rest.
    Ok(unsafe { &*pointer })
}

/// A place to write a result to.
pub(super) unsafe fn output<'a, T>(
    argument: &'static str,
    pointer: *mut T,
) -> Result<&'a mut MaybeUninit<T>, Failure> {
    check(argument, pointer)?;
    // SAFETY: as in `reference`; uninitialised memory is what the type allows.
    Ok(unsafe { &mut *pointer.cast() })
}

/// An array of `count`; NULL if that is 0.
pub(super) unsafe fn array<'a, T>(
    argument: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(argument, pointer)?;
    check_size::<T>(argument, count)?;
    // SAFETY: neither NULL, misaligned nor larger than an object may be; the caller vouches for the rest.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// A buffer to write `count` entries to.
pub(super) unsafe fn buffer<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(argument, pointer)?;
    check_size::<T>(argument, count)?;
    // SAFETY: as in `array`; uninitialised memory is what the type allows.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// As [`buffer`], but no entries if the pointer is NULL.
pub(super) unsafe fn buffer_if_any<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [MaybeUninit<T>], Failure> {
    // SAFETY: the caller's promise.
    unsafe { buffer(argument, pointer, if pointer.is_null() { 0 } else { count }) }
}

/// Writes `values` to a buffer that has room for them.
pub(super) unsafe fn fill<T: Copy>(
    argument: &'static str,
    pointer: *mut T,
    values: &[T],
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for the room.
    unsafe { fill_from(argument, pointer, values.iter().copied()) }
}

/// As [`fill`], of values that are made one by one.
#[inline(always)]
pub(super) unsafe fn fill_from<T>(
    argument: &'static str,
    pointer: *mut T,
    values: impl ExactSizeIterator<Item = T>,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for the room.
    let places = unsafe { buffer(argument, pointer, values.len()) }?;
    for (place, value) in places.iter_mut().zip(values) {
        place.write(value);
    }
    Ok(())
}

/// Where a list begins, NULL if it is empty: an empty slice of Rust begins at an address that means
/// nothing to C.
pub(super) fn start_of<T>(list: &[T]) -> *const T {
    if list.is_empty() { ptr::null() } else { list.as_ptr() }
}

/// What the caller has provided for a copy.
pub(super) struct Room {
    pub(super) capacity: usize,
    pub(super) count: *mut usize,
}

/// Copies `needed` entries to the buffers that are not NULL, if they are large enough, and tells the count.
///
/// # Safety
/// `room.count` is NULL, misaligned or a place for a count.
pub(super) unsafe fn copy_out(
    room: Room,
    needed: usize,
    buffers: &[(&'static str, *mut u8)],
    copy: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    // SAFETY: the caller's promise.
    let count = unsafe { output("count", room.count) }?;
    if buffers.iter().all(|(_, buffer)| buffer.is_null()) {
        if room.capacity > 0 {
            return Err(Wrong::Null.in_argument(buffers[0].0));
        }
    } else if room.capacity < needed {
        count.write(needed);
        return Err(Failure::BufferTooSmall { argument: "capacity", capacity: room.capacity, needed });
    } else {
        copy()?;
    }
    count.write(needed);
    Ok(())
}

fn check<T>(argument: &'static str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Wrong::Null.in_argument(argument));
    }
    if !pointer.is_aligned() {
        let (address, alignment) = (pointer.addr(), align_of::<T>());
        return Err(Wrong::Misaligned { address, alignment }.in_argument(argument));
    }
    Ok(())
}

fn check_size<T>(argument: &'static str, count: usize) -> Result<(), Failure> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Wrong::TooLarge { count, size: size_of::<T>() }.in_argument(argument)),
    }
}
