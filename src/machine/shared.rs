//! Memory of which several arrays have a part each, and which the last of them frees.

#![allow(unsafe_code)]

use std::alloc::{Layout, dealloc};
use std::ptr::NonNull;
use std::sync::atomic::{AtomicUsize, Ordering, fence};

use super::memory;
use crate::error::Result;

/// The memory, and how many have a share in it.
struct Shared {
    n_shares: AtomicUsize,
    memory: *mut u8,
    layout: Layout,
    capacity: usize,
}

/// A share. They are counted as by [`Arc`](std::sync::Arc), but that there is no memory for the count is an error here,
/// and ends the program there.
pub(super) struct Share(NonNull<Shared>);

impl Share {
    /// The only share so far of memory that was allocated with this layout, and has room for `capacity` entries.
    ///
    /// # Safety
    /// The memory is freed with the last share, unless it is [kept](Self::keep), and in no other way.
    pub(super) unsafe fn new(memory: *mut u8, layout: Layout, capacity: usize) -> Result<Self> {
        let shared = memory::boxed(Shared { n_shares: AtomicUsize::new(1), memory, layout, capacity })?;
        Ok(Share(NonNull::from(Box::leak(shared))))
    }

    fn shared(&self) -> &Shared {
        // SAFETY: it is there as long as there is a share.
        unsafe { self.0.as_ref() }
    }

    /// One more share.
    pub(super) fn another(&self) -> Self {
        self.shared().n_shares.fetch_add(1, Ordering::Relaxed);
        Share(self.0)
    }

    /// Whether it is a share of the same memory.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    /// Whether this is the only share left of memory that begins there.
    pub(super) fn is_last_of(&self, memory: *mut u8) -> bool {
        // Acquire: what others did with the memory was before they gave up their shares.
        self.shared().n_shares.load(Ordering::Acquire) == 1 && self.shared().memory == memory
    }

    /// Gives up the last share, and leaves it to the caller to free the memory: how many entries it has room for.
    pub(super) fn keep(self) -> usize {
        let capacity = self.shared().capacity;
        assert!(self.is_last_of(self.shared().memory));
        // SAFETY: it was leaked when it was made, and there is no other share: this one is forgotten.
        drop(unsafe { Box::from_raw(self.0.as_ptr()) });
        std::mem::forget(self);
        capacity
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        if self.shared().n_shares.fetch_sub(1, Ordering::Release) > 1 {
            return;
        }
        fence(Ordering::Acquire);
        // SAFETY: it was leaked when it was made, and this was the last share; the memory has this layout, and is ours
        // to free.
        unsafe {
            let shared = Box::from_raw(self.0.as_ptr());
            dealloc(shared.memory, shared.layout);
        }
    }
}
