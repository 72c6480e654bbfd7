//! A value that several own, and that the last of them frees.

#![allow(unsafe_code)]

use std::ops::Deref;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicUsize, Ordering, fence};

use super::memory;
use crate::error::Result;

struct CountedValue<T> {
    n_owners: AtomicUsize,
    value: T,
}

/// An owner. Owners are counted as by [`Arc`](std::sync::Arc), but that there is no memory for the count is an error here,
/// and ends the program there.
#[derive(Debug)]
pub(crate) struct Counted<T>(NonNull<CountedValue<T>>);

// SAFETY: what owners on several threads have in common is read by all, and dropped by any of them.
unsafe impl<T: Send + Sync> Send for Counted<T> {}
// SAFETY: a reference to an owner gives references to the value, and other owners.
unsafe impl<T: Send + Sync> Sync for Counted<T> {}

impl<T> Counted<T> {
    /// The only owner so far.
    pub(crate) fn new(value: T) -> Result<Self> {
        let inner = memory::boxed(CountedValue { n_owners: AtomicUsize::new(1), value })?;
        Ok(Counted(NonNull::from(Box::leak(inner))))
    }

    fn inner(&self) -> &CountedValue<T> {
        // SAFETY: it is there as long as there is an owner.
        unsafe { self.0.as_ref() }
    }

    /// One more owner.
    pub(crate) fn another(&self) -> Self {
        self.inner().n_owners.fetch_add(1, Ordering::Relaxed);
        Counted(self.0)
    }

    /// The value, to be changed, if this is the only owner.
    pub(crate) fn get_mut(&mut self) -> Option<&mut T> {
        // Acquire: what others did with the value was before they gave it up.
        if self.inner().n_owners.load(Ordering::Acquire) != 1 {
            return None;
        }
        // SAFETY: there is no other owner, and this one is borrowed as long as the value.
        Some(unsafe { &mut self.0.as_mut().value })
    }
}

impl<T> Deref for Counted<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.inner().value
    }
}

impl<T> Drop for Counted<T> {
    fn drop(&mut self) {
        if self.inner().n_owners.fetch_sub(1, Ordering::Release) > 1 {
            return;
        }
        fence(Ordering::Acquire);
        // SAFETY: it was leaked when it was made, and this was the last owner.
        drop(unsafe { Box::from_raw(self.0.as_ptr()) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_owner_frees_the_value() {
        struct Tells<'t>(&'t AtomicUsize);
        impl Drop for Tells<'_> {
            fn drop(&mut self) {
                self.0.fetch_add(1, Ordering::Relaxed);
            }
        }
        let n_freed = AtomicUsize::new(0);
        let mut first = Counted::new(Tells(&n_freed)).expect("room");
        assert!(first.get_mut().is_some());
        let others: Vec<_> = (0..4).map(|_| first.another()).collect();
        assert!(first.get_mut().is_none());
        std::thread::scope(|scope| {
            for other in others {
                scope.spawn(move || assert_eq!((*other).0.load(Ordering::Relaxed), 0));
            }
        });
        assert_eq!(n_freed.load(Ordering::Relaxed), 0);
        assert!(first.get_mut().is_some());
        drop(first);
        assert_eq!(n_freed.load(Ordering::Relaxed), 1);
    }
}
