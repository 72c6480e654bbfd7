//! Room for large arrays.
//!
//! An array of many megabytes that is written once in storage order costs a page fault every few kilobytes: a fifth of
//! a 2D build of a million sites; one that is read out of order, a search for the page at most of the reads. Where the
//! system has large pages on request, they are asked for.

#![allow(unsafe_code)]

use std::collections::{BinaryHeap, HashMap};
use std::fmt::{self, Write};
use std::hash::{BuildHasher, Hash};
use std::mem::MaybeUninit;

use super::threads;
use crate::error::{Error, Result};

/// Arrays below this size stay on ordinary pages.
const LARGE: usize = 4 << 20;

/// Makes room for exactly `more` more entries.
#[inline(never)]
pub(crate) fn reserve_exact<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    array.try_reserve_exact(more).map_err(|_| Error::OutOfMemory { bytes: more * size_of::<T>() })?;
    advise_if_large(array.as_mut_ptr().cast(), bytes_of(array));
    Ok(())
}

/// Asks for large pages where an array is large.
#[inline(always)]
pub(super) fn advise_if_large(start: *mut u8, bytes: usize) {
    if bytes >= LARGE {
        advise_large_pages(start, bytes);
    }
}

/// Makes room for `more` more entries at least; where more follow, in constant time each.
#[inline(always)]
pub(crate) fn reserve<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    if array.capacity() - array.len() >= more { Ok(()) } else { grow(array, more) }
}

#[cold]
#[inline(never)]
fn grow<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    array.try_reserve(more).map_err(|_| Error::OutOfMemory { bytes: more * size_of::<T>() })?;
    advise_if_large(array.as_mut_ptr().cast(), bytes_of(array));
    Ok(())
}

/// Makes room for `more` more entries at least, growing by an eighth: for large arrays, of which half must not stay
/// empty.
pub(crate) fn reserve_sparingly<T>(array: &mut Vec<T>, more: usize) -> Result<()> {
    if array.capacity() - array.len() >= more {
        return Ok(());
    }
    let eighth = array.len() / 8;
    reserve_exact(array, more.max(eighth))
}

/// Makes room for `more` more entries at least of a map from which none has been removed, so that they can be inserted
/// without a failure.
pub(crate) fn reserve_map<K: Eq + Hash, V, S: BuildHasher>(
    map: &mut HashMap<K, V, S>,
    more: usize,
) -> Result<()> {
    map.try_reserve(more).map_err(|_| Error::OutOfMemory { bytes: more * size_of::<(K, V)>() })
}

/// Appends one entry.
#[inline(always)]
pub(crate) fn push<T>(array: &mut Vec<T>, entry: T) -> Result<()> {
    reserve(array, 1)?;
    array.push(entry);
    Ok(())
}

/// Enters one entry into a heap.
pub(crate) fn enter<T: Ord>(heap: &mut BinaryHeap<T>, entry: T) -> Result<()> {
    heap.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes: size_of::<T>() })?;
    heap.push(entry);
    Ok(())
}

/// A value in memory of its own.
pub(crate) fn boxed<T>(value: T) -> Result<Box<T>> {
    boxed_by(|| value)
}

/// A value in memory of its own, which is made once there is the memory, and there if the compiler can.
#[inline(always)]
pub(crate) fn boxed_by<T>(make: impl FnOnce() -> T) -> Result<Box<T>> {
    let layout = std::alloc::Layout::new::<T>();
    assert!(layout.size() > 0);
    // SAFETY: the layout is not empty; the memory is written before it becomes a box, which frees it as it was
    // allocated.
    unsafe {
        let place = std::alloc::alloc(layout).cast::<T>();
        if place.is_null() {
            return Err(Error::OutOfMemory { bytes: layout.size() });
        }
        place.write(make());
        Ok(Box::from_raw(place))
    }
}

/// A value that has its memory from when it is first asked for.
#[inline(always)]
pub(crate) fn made<T: Default>(place: &mut Option<Box<T>>) -> Result<&mut T> {
    let made = take_made(place)?;
    Ok(place.insert(made))
}

/// A value that has its memory from when it is first asked for, out of its place: to be put back there.
#[inline(always)]
pub(crate) fn take_made<T: Default>(place: &mut Option<Box<T>>) -> Result<Box<T>> {
    match place.take() {
        Some(made) => Ok(made),
        None => boxed_by(T::default),
    }
}

/// Bytes of a value that may not be [`made`] yet, with those that it holds.
pub(crate) fn bytes_of_made<T>(place: &Option<Box<T>>, held: impl FnOnce(&T) -> usize) -> usize {
    place.as_deref().map_or(0, |made| size_of::<T>() + held(made))
}

/// Bytes of an array's memory.
pub(crate) fn bytes_of<T>(array: &Vec<T>) -> usize {
    array.capacity() * size_of::<T>()
}

/// A copy of an array.
#[inline(never)]
pub(crate) fn copy_of<T: Copy>(array: &[T]) -> Result<Vec<T>> {
    let mut copy = Vec::new();
    reserve_exact(&mut copy, array.len())?;
    copy.extend_from_slice(array);
    Ok(copy)
}

/// A copy of an array, with room for so many entries in all.
pub(crate) fn copy_with_room<T: Copy>(array: &[T], room: usize) -> Result<Vec<T>> {
    let mut copy = Vec::new();
    reserve_exact(&mut copy, room.max(array.len()))?;
    copy.extend_from_slice(array);
    Ok(copy)
}

/// Appends copies of entries.
pub(crate) fn append<T: Copy>(array: &mut Vec<T>, entries: &[T]) -> Result<()> {
    reserve(array, entries.len())?;
    array.extend_from_slice(entries);
    Ok(())
}

/// Appends entries, one after the other, as many as come.
pub(crate) fn collect<T>(array: &mut Vec<T>, entries: impl Iterator<Item = T>) -> Result<()> {
    reserve(array, entries.size_hint().0)?;
    for entry in entries {
        push(array, entry)?;
    }
    Ok(())
}

/// Makes it as long as that, at least, with `entry` in what is new.
pub(crate) fn lengthen<T: Clone>(array: &mut Vec<T>, n: usize, entry: T) -> Result<()> {
    if n > array.len() {
        reserve(array, n - array.len())?;
        array.resize(n, entry);
    }
    Ok(())
}

/// A text; cut off where there is no memory for more of it.
pub(crate) fn text(arguments: fmt::Arguments) -> String {
    struct CutText(String);
    impl Write for CutText {
        fn write_str(&mut self, more: &str) -> fmt::Result {
            self.0.try_reserve(more.len()).map_err(|_| fmt::Error)?;
            self.0.push_str(more);
            Ok(())
        }
    }
    let mut text = CutText(String::new());
    // What has been written so far is all that there is room for.
    let _ = text.write_fmt(arguments);
    text.0
}

/// Appends what `make` makes of each entry of `from`, each of several threads a stretch of it.
pub(crate) fn extend<T: Sync, U: Copy + Send>(
    array: &mut Vec<U>,
    from: &[T],
    n_threads: usize,
    make: impl Fn(&T) -> U + Sync,
) -> Result<()> {
    let missing = from.len().saturating_sub(array.capacity() - array.len());
    if missing > 0 {
        reserve_exact(array, from.len())?;
    }
    write(from, &mut array.spare_capacity_mut()[..from.len()], n_threads, &make);
    // SAFETY: that many entries have just been written behind the last one.
    unsafe { array.set_len(array.len() + from.len()) };
    Ok(())
}

/// Writes what `make` makes of each entry of `from` over as many entries that there are, each of several threads a
/// stretch of it.
pub(crate) fn overwrite<T: Sync, U: Copy + Send>(
    to: &mut [U],
    from: &[T],
    n_threads: usize,
    make: &(impl Fn(&T) -> U + Sync),
) {
    // SAFETY: what can be written to can be written to as if it were not initialised, with what is; `write` does no
    // more.
    let to = unsafe { &mut *(std::ptr::from_mut(to) as *mut [MaybeUninit<U>]) };
    write(from, to, n_threads, make);
}

/// Writes every entry of `to`, which is as long as `from`.
pub(super) fn write<T: Sync, U: Copy + Send>(
    from: &[T],
    to: &mut [MaybeUninit<U>],
    n_threads: usize,
    make: &(impl Fn(&T) -> U + Sync),
) {
    assert_eq!(from.len(), to.len());
    if n_threads <= 1 {
        for (from, to) in from.iter().zip(to) {
            to.write(make(from));
        }
        return;
    }
    let (threads, middle) = halved(n_threads, from.len());
    let ((from_a, from_b), (to_a, to_b)) = (from.split_at(middle), to.split_at_mut(middle));
    threads::join(|| write(from_a, to_a, threads, make), || write(from_b, to_b, n_threads - threads, make));
}

/// Half of the threads, and how many of `n` entries are for them.
fn halved(n_threads: usize, n: usize) -> (usize, usize) {
    let threads = n_threads / 2;
    (threads, (n as u64 * threads as u64 / n_threads as u64) as usize)
}

/// Changes every entry, each of several threads a stretch of them.
pub(crate) fn change<T: Send>(entries: &mut [T], n_threads: usize, change_one: &(impl Fn(&mut T) + Sync)) {
    if n_threads <= 1 {
        entries.iter_mut().for_each(change_one);
        return;
    }
    let (threads, middle) = halved(n_threads, entries.len());
    let (a, b) = entries.split_at_mut(middle);
    threads::join(|| change(a, threads, change_one), || change(b, n_threads - threads, change_one));
}

#[cfg(target_os = "linux")]
#[cold]
#[inline(never)]
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
