//! Arrays of which several threads fill a part each.
//!
//! An array may be [divided](Aligned::divide): its room at the end becomes another array's, which another thread can
//! fill where the entries are going to be, and which is then [taken back](Aligned::rejoin). The memory is gone when the
//! last of both is.

#![allow(unsafe_code)]

use std::alloc::{Layout, alloc, dealloc, realloc};
use std::fmt::{self, Debug};
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};
use std::ptr::{self, NonNull};
use std::slice;

use super::memory;
use super::shared::Share;
use crate::error::{Error, Result};

/// A growing array.
pub(crate) struct Aligned<T: Copy> {
    start: NonNull<T>,
    n: usize,
    capacity: usize,
    /// If the memory is not its own alone.
    share: Option<Share>,
    entries: PhantomData<T>,
}

// SAFETY: an array owns its entries.
unsafe impl<T: Copy + Send> Send for Aligned<T> {}
// SAFETY: an array owns its entries, and shared it lets them be read alone.
unsafe impl<T: Copy + Sync> Sync for Aligned<T> {}

impl<T: Copy> Aligned<T> {
    /// An empty array.
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Aligned { start: NonNull::dangling(), n: 0, capacity: 0, share: None, entries: PhantomData }
    }

    /// For how many entries there is memory.
    #[inline(always)]
    pub(crate) fn capacity(&self) -> usize {
        self.capacity
    }

    /// Bytes of its memory, those behind the last entry included.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.capacity * size_of::<T>()
    }

    /// Makes room for exactly `more` more entries, unless there is.
    #[inline(never)]
    pub(crate) fn reserve_exact(&mut self, more: usize) -> Result<()> {
        if self.capacity - self.n >= more {
            return Ok(());
        }
        let no_room = Error::OutOfMemory { bytes: more.saturating_mul(size_of::<T>()) };
        let Some(capacity) = self.n.checked_add(more) else { return Err(no_room) };
        let Ok(layout) = Layout::array::<T>(capacity) else { return Err(no_room) };
        let own =
            Layout::array::<T>(self.capacity).ok().filter(|_| self.capacity > 0 && self.share.is_none());
        // SAFETY: the layout is not empty, as neither `more` nor an entry is; what there is was asked for like that.
        let memory = unsafe {
            match own {
                Some(old) => realloc(self.start.as_ptr().cast(), old, layout.size()),
                None => alloc(layout),
            }
        };
        let Some(start) = NonNull::new(memory.cast::<T>()) else { return Err(no_room) };
        if own.is_none() {
            // SAFETY: there is room for all entries there are, which are elsewhere.
            unsafe { ptr::copy_nonoverlapping(self.start.as_ptr(), start.as_ptr(), self.n) };
        }
        (self.start, self.capacity, self.share) = (start, capacity, None);
        memory::advise_if_large(memory, capacity * size_of::<T>());
        Ok(())
    }

    /// Appends an entry, for which there must be room.
    #[inline(always)]
    pub(crate) fn push(&mut self, entry: T) {
        assert!(self.n < self.capacity, "room is made before");
        // SAFETY: there is room for it.
        unsafe { self.start.add(self.n).write(entry) };
        self.n += 1;
    }

    /// Appends entries until there are `n`, for which there must be room.
    pub(crate) fn lengthen(&mut self, n: usize, entry: T) {
        let more = n.saturating_sub(self.n);
        assert!(more <= self.capacity - self.n, "room is made before");
        for k in 0..more {
            // SAFETY: there is room for that many.
            unsafe { self.start.add(self.n + k).write(entry) };
        }
        self.n += more;
    }

    /// Drops all but the first `n` entries.
    pub(crate) fn truncate(&mut self, n: usize) {
        self.n = self.n.min(n);
    }

    /// Keeps room for `kept` entries, and makes the room for the `room` entries behind them that of another array.
    pub(crate) fn divide(&mut self, kept: usize, room: usize) -> Result<Self> {
        assert!(self.n <= kept && room > 0 && kept + room <= self.capacity, "room is made before");
        let share = match &self.share {
            Some(share) => share.another(),
            None => {
                let layout = Layout::array::<T>(self.capacity).expect("it was asked for like that");
                // SAFETY: this was allocated like that, and an array with a share frees nothing itself.
                let own = unsafe { Share::new(self.start.as_ptr().cast(), layout, self.capacity)? };
                let share = own.another();
                self.share = Some(own);
                share
            }
        };
        self.capacity = kept;
        // SAFETY: this is in the same memory.
        let start = unsafe { self.start.add(kept) };
        Ok(Aligned { start, n: 0, capacity: room, share: Some(share), entries: PhantomData })
    }

    /// Whether another array has the room behind the end of this one's.
    pub(crate) fn is_followed_by(&self, other: &Self) -> bool {
        let (Some(own), Some(its)) = (&self.share, &other.share) else { return false };
        own.is_beside(its) && self.start.as_ptr().wrapping_add(self.capacity) == other.start.as_ptr()
    }

    /// Takes back the entries and the room of the array that [follows](Self::is_followed_by). All entries between there
    /// are `between`.
    pub(crate) fn rejoin(&mut self, other: Self, between: T) {
        assert!(self.is_followed_by(&other));
        self.lengthen(self.capacity, between);
        self.n += other.n;
        self.capacity += other.capacity;
    }

    /// Has all room that it had before it was divided, if the other arrays are gone.
    pub(crate) fn reclaim(&mut self) {
        let start = self.start.as_ptr().cast();
        if let Some(share) = self.share.take_if(|share| share.is_last_of(start)) {
            self.capacity = share.keep();
        }
    }

    /// A copy without room for more.
    pub(crate) fn copied(&self) -> Result<Self> {
        let mut copy = Self::new();
        copy.reserve_exact(self.n)?;
        // SAFETY: there is room for that many, elsewhere.
        unsafe { ptr::copy_nonoverlapping(self.start.as_ptr(), copy.start.as_ptr(), self.n) };
        copy.n = self.n;
        Ok(copy)
    }
}

impl<T: Copy + Sync + Send> Aligned<T> {
    /// Appends what `make` makes of each entry of `from`, each of several threads a stretch of it.
    pub(crate) fn extend(
        &mut self,
        from: &[T],
        n_threads: usize,
        make: impl Fn(&T) -> T + Sync,
    ) -> Result<()> {
        self.reserve_exact(from.len())?;
        // SAFETY: there is room for that many behind the entries; they are written before they are counted.
        unsafe {
            let room = slice::from_raw_parts_mut(self.start.add(self.n).as_ptr().cast(), from.len());
            memory::write(from, room, n_threads, &make);
        }
        self.n += from.len();
        Ok(())
    }
}

impl<T: Copy> Drop for Aligned<T> {
    #[inline(always)]
    fn drop(&mut self) {
        if self.capacity > 0
            && self.share.is_none()
            && let Ok(layout) = Layout::array::<T>(self.capacity)
        {
            // SAFETY: this is where the memory begins, and its layout.
            unsafe { dealloc(self.start.as_ptr().cast(), layout) };
        }
    }
}

impl<T: Copy> Deref for Aligned<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        // SAFETY: these entries have been written.
        unsafe { slice::from_raw_parts(self.start.as_ptr(), self.n) }
    }
}

impl<T: Copy> DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: these entries have been written, and are borrowed for the caller alone.
        unsafe { slice::from_raw_parts_mut(self.start.as_ptr(), self.n) }
    }
}

impl<T: Copy + Debug> Debug for Aligned<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[repr(align(32))]
    struct Wide(u64);

    fn grow<T: Copy + Debug + PartialEq + Send + Sync>(entry: fn(u64) -> T) {
        let (mut array, mut expected) = (Aligned::<T>::new(), Vec::new());
        for k in 0..1000 {
            if array.len() == array.capacity() {
                array.reserve_exact(1 + k as usize / 8).expect("room");
                assert!(array.as_ptr().addr().is_multiple_of(align_of::<T>()));
            }
            array.push(entry(k));
            expected.push(entry(k));
            assert_eq!(array[..], expected[..]);
        }
        let mut copy = array.copied().expect("room");
        assert_eq!((copy.capacity(), &copy[..]), (1000, &array[..]));
        copy.truncate(10);
        copy.extend(&array, 1, |&x| x).expect("room");
        assert_eq!((&copy[..10], &copy[10..]), (&array[..10], &array[..]));
        copy[0] = entry(7);
        assert_eq!(copy[0], array[7]);
        copy.reserve_exact(3).expect("room");
        copy.lengthen(1012, entry(1));
        assert_eq!((copy.len(), copy[1011]), (1012, entry(1)));
        let half_of_all = usize::MAX / 2 / size_of::<T>();
        assert!(copy.reserve_exact(usize::MAX).is_err() && copy.reserve_exact(half_of_all).is_err());
        assert_eq!(copy.len(), 1012);
    }

    /// An array with room for 100 entries and ten of them, and two that have been divided from it and filled on other
    /// threads.
    fn divided() -> [Aligned<Wide>; 3] {
        let mut first = Aligned::new();
        first.reserve_exact(100).expect("room");
        let mut last = first.divide(60, 30).expect("room");
        let mut middle = first.divide(40, 20).expect("room");
        assert_eq!([&first, &middle, &last].map(Aligned::capacity), [40, 20, 30]);
        first.lengthen(10, Wide(1));
        std::thread::scope(|scope| {
            scope.spawn(|| middle.lengthen(20, Wide(2)));
            scope.spawn(|| last.lengthen(5, Wide(3)));
        });
        [first, middle, last]
    }

    #[test]
    fn divided_arrays_are_rejoined() {
        let [mut first, mut middle, last] = divided();
        assert!(
            first.is_followed_by(&middle) && middle.is_followed_by(&last) && !first.is_followed_by(&last)
        );
        middle.rejoin(last, Wide(0));
        first.rejoin(middle, Wide(0));
        let expected = [(10, 1), (30, 0), (20, 2), (5, 3)].map(|(n, k)| vec![Wide(k); n]).concat();
        assert_eq!((&first[..], first.capacity()), (&expected[..], 90));
        first.reclaim();
        assert_eq!(first.capacity(), 100);
        first.reserve_exact(1000).expect("room");
        assert_eq!((&first[..], first.capacity()), (&expected[..], 1065));
    }

    #[test]
    fn divided_arrays_grow_elsewhere() {
        let [mut first, mut middle, mut last] = divided();
        last.reserve_exact(26).expect("room");
        assert_eq!((&last[..], last.capacity()), (&[Wide(3); 5][..], 31));
        assert!(!middle.is_followed_by(&last));
        middle.reserve_exact(1).expect("room");
        assert!(!first.is_followed_by(&middle) && middle[..] == [Wide(2); 20]);
        // No other array has a part any more.
        first.reclaim();
        assert_eq!((&first[..], first.capacity()), (&[Wide(1); 10][..], 100));
    }

    #[test]
    fn memory_is_there_as_long_as_some_array_is() {
        let [mut first, mut middle, last] = divided();
        drop(last);
        first.reclaim();
        assert_eq!(first.capacity(), 40, "the middle is not gone");
        first.reserve_exact(50).expect("room");
        assert!(!first.is_followed_by(&middle));
        drop(first);
        // The middle part is not the first, and has no more than its share.
        middle.reclaim();
        assert_eq!((&middle[..], middle.capacity()), (&[Wide(2); 20][..], 20));
    }

    #[test]
    fn arrays_grow() {
        grow(Wide);
        grow(|k| k as u8);
        grow(|k| [k as u32; 6]);
        assert!(Aligned::<Wide>::new().copied().expect("nothing").is_empty());
    }
}
