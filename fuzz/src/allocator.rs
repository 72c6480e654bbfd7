//! An allocator that has no memory left when a target says so.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

struct Failing;

#[global_allocator]
static ALLOCATOR: Failing = Failing;

static IS_ARMED: AtomicBool = AtomicBool::new(false);
static FAILS_ON: AtomicBool = AtomicBool::new(false);
static FIRST: AtomicUsize = AtomicUsize::new(0);
static REQUESTS: AtomicUsize = AtomicUsize::new(0);

/// Which requests are refused.
#[derive(Clone, Copy, Debug)]
pub struct Fault {
    /// The first one.
    pub first: usize,
    /// And all later ones.
    pub goes_on: bool,
}

impl Fault {
    /// Does the work, on this thread and any others that take part, while the requests are refused. Whether any was is
    /// the second result. Nothing else may run meanwhile.
    pub fn during<R>(self, work: impl FnOnce() -> R) -> (R, bool) {
        REQUESTS.store(0, Relaxed);
        FIRST.store(self.first, Relaxed);
        FAILS_ON.store(self.goes_on, Relaxed);
        IS_ARMED.store(true, Relaxed);
        let result = work();
        IS_ARMED.store(false, Relaxed);
        (result, REQUESTS.load(Relaxed) > self.first)
    }
}

/// From now on there is memory, whatever has happened.
pub fn disarm() {
    IS_ARMED.store(false, Relaxed);
}

fn fails() -> bool {
    if !IS_ARMED.load(Relaxed) {
        return false;
    }
    let k = REQUESTS.fetch_add(1, Relaxed);
    let first = FIRST.load(Relaxed);
    k == first || k > first && FAILS_ON.load(Relaxed)
}

// SAFETY: all is handed on to the system's allocator, or there is no memory.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails() { null_mut() } else { unsafe { System.realloc(pointer, layout, size) } }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}
