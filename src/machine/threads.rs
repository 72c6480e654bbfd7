//! Work on several threads.
//!
//! All of it is divided by [`join`]: scoped threads, each with memory of its own or reading what none writes.
//! The compiler proves that there are no data races; no `unsafe` is involved but to start a thread, to take over what
//! several threads have written side by side (here and in [`memory`]), and to move sites of which
//! no two threads have the same one (`motion::moving`). Results are put together in the order of the work, so that they
//! do not depend on which thread was faster.
//!
//! Threads are started where they are needed, for some 20 µs each. Where the system has none to give, the
//! calling thread does the work of all. The standard library's would need memory that cannot be refused; the system's
//! own need none of the process's, as the work and its result are on the stack of the thread that waits for them.

#![allow(unsafe_code)]

use std::any::Any;
use std::cell::Cell;
#[cfg(unix)]
use std::ffi::c_void;
#[cfg(unix)]
use std::mem::MaybeUninit;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use super::{memory, processors, tally};
use crate::error::Result;

/// Ranges for each thread.
const RANGES: usize = 8;

/// How many threads a call may use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    most: usize,
    is_given: bool,
}

impl Threads {
    /// The calling thread alone.
    pub(crate) const ONE: Threads = Threads { most: 1, is_given: true };

    /// At most `given`, or with 0 as many as the system runs at the same time where that pays.
    pub(crate) fn at_most(given: u32) -> Self {
        static AVAILABLE: OnceLock<usize> = OnceLock::new();
        let available = || *AVAILABLE.get_or_init(processors::available);
        let most = if given == 0 { available() } else { given as usize };
        Threads { most, is_given: given != 0 }
    }

    /// How many to use for work on `items` items: at most as many as leave each one `paying` items, below which a
    /// thread more costs as much as it saves, or `least` if the number is the caller's choice.
    pub(crate) fn for_work(self, items: usize, paying: usize, least: usize) -> usize {
        (items / if self.is_given { least } else { paying }).clamp(1, self.most)
    }
}

thread_local! {
    static IS_WORKER: Cell<bool> = const { Cell::new(false) };
}

/// Whether the current thread is one of those started here. Its panics are raised again by the calling
/// thread.
pub(crate) fn is_worker() -> bool {
    IS_WORKER.get()
}

/// Work for another thread, then what has come of it.
struct Task<F, B> {
    work: Option<F>,
    /// The result and how often exact arithmetic was needed, or why the work panicked.
    done: Option<thread::Result<(B, u64)>>,
}

impl<F: FnOnce() -> B, B> Task<F, B> {
    /// Does the work on a thread that has done nothing else.
    fn run(&mut self) {
        IS_WORKER.set(true);
        self.done =
            self.work.take().map(|work| catch_unwind(AssertUnwindSafe(|| (work(), tally::exact_calls()))));
    }
}

/// Does both, the second on a thread of its own.
pub(crate) fn join<A, B: Send>(a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    let mut task = Task { work: Some(b), done: None };
    let a = beside(&mut task, a);
    match (task.done, task.work) {
        (Some(Ok((b, exact_calls))), _) => {
            tally::add(exact_calls);
            (a, b)
        }
        (Some(Err(payload)), _) => panic!("on another thread: {}", message(&payload)),
        (None, work) => (a, work.expect("the thread was not started")()),
    }
}

/// What a panic says.
fn message(payload: &Box<dyn Any + Send>) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

/// Calls `a` while a task is run on a thread of its own, or not at all if there is none to be had.
#[cfg(unix)]
fn beside<A, B: Send, F: FnOnce() -> B + Send>(task: &mut Task<F, B>, a: impl FnOnce() -> A) -> A {
    extern "C" fn run<B, F: FnOnce() -> B>(task: *mut c_void) -> *mut c_void {
        // SAFETY: it is the task of `beside`, which touches it again after this thread has ended, and not before.
        unsafe { &mut *task.cast::<Task<F, B>>() }.run();
        std::ptr::null_mut()
    }
    // SAFETY: `run` takes a task of this type; what that owns and borrows may be sent to another thread; and it stays
    // there until the thread has ended, as the thread is joined when this is dropped, also by a panic of `a`.
    let worker = unsafe { Worker::start(run::<B, F>, std::ptr::from_mut(task).cast()) };
    let a = a();
    drop(worker);
    a
}

/// Likewise.
#[cfg(not(unix))]
fn beside<A, B: Send, F: FnOnce() -> B + Send>(task: &mut Task<F, B>, a: impl FnOnce() -> A) -> A {
    thread::scope(|scope| {
        // One that is not started leaves the task as it was.
        let _ = thread::Builder::new().spawn_scoped(scope, || task.run());
        a()
    })
}

/// Bytes of stack of a thread started here, as the standard library has it.
#[cfg(unix)]
const STACK: usize = 2 << 20;

/// A thread that runs; joined when dropped.
#[cfg(unix)]
struct Worker(libc::pthread_t);

#[cfg(unix)]
impl Worker {
    /// A thread that calls `run` with `task`; `None` if there is none to be had.
    ///
    /// # Safety
    /// `run` may be called with `task`, once, on another thread, at any time until the worker is dropped, which it must
    /// be.
    unsafe fn start(run: extern "C" fn(*mut c_void) -> *mut c_void, task: *mut c_void) -> Option<Self> {
        let mut attributes = MaybeUninit::uninit();
        let mut thread = MaybeUninit::uninit();
        // SAFETY: the attributes are initialised before they are used, and not used after they are destroyed; a size of
        // the stack that the system refuses leaves its own. The caller allows the call of `run`.
        unsafe {
            if libc::pthread_attr_init(attributes.as_mut_ptr()) != 0 {
                return None;
            }
            libc::pthread_attr_setstacksize(attributes.as_mut_ptr(), STACK);
            let failure = libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), run, task);
            libc::pthread_attr_destroy(attributes.as_mut_ptr());
            // It is initialised if there is no failure.
            (failure == 0).then(|| Worker(thread.assume_init()))
        }
    }
}

#[cfg(unix)]
impl Drop for Worker {
    fn drop(&mut self) {
        // SAFETY: a thread started above, which is joined but here.
        let failure = unsafe { libc::pthread_join(self.0, std::ptr::null_mut()) };
        debug_assert_eq!(failure, 0);
    }
}

/// Does each piece of work of a range on a thread of its own.
pub(crate) fn for_each(range: Range<usize>, work: &(impl Fn(usize) + Sync)) {
    if range.len() <= 1 {
        range.for_each(work);
        return;
    }
    let middle = range.start.midpoint(range.end);
    join(|| for_each(range.start..middle, work), || for_each(middle..range.end, work));
}

/// Makes each entry of an array on a thread of its own, by its index.
pub(crate) fn fill<R: Send>(results: &mut [R], work: &(impl Fn(usize) -> R + Sync)) {
    fill_from(0, results, work);
}

fn fill_from<R: Send>(first: usize, results: &mut [R], work: &(impl Fn(usize) -> R + Sync)) {
    if let [result] = results {
        *result = work(first);
        return;
    }
    if !results.is_empty() {
        let middle = results.len() / 2;
        let (results, more) = results.split_at_mut(middle);
        join(|| fill_from(first, results, work), || fill_from(first + middle, more, work));
    }
}

/// Works on parts of an array, each on a thread of its own; `first` is the index of its first entry.
pub(crate) fn for_parts<R: Send>(
    entries: &mut [R],
    first: usize,
    n_threads: usize,
    work: &(impl Fn(usize, &mut [R]) + Sync),
) {
    if n_threads < 2 {
        return work(first, entries);
    }
    let middle = entries.len() / n_threads * (n_threads / 2);
    let (entries, more) = entries.split_at_mut(middle);
    join(
        || for_parts(entries, first, n_threads / 2, work),
        || for_parts(more, first + middle, n_threads - n_threads / 2, work),
    );
}

/// Where several threads write results, each at indices of its own.
struct Slots<R>(*mut R);

// SAFETY: results are moved to other threads through it, no more.
unsafe impl<R: Send> Sync for Slots<R> {}

impl<R> Slots<R> {
    /// # Safety
    /// There is room at this index, for this result alone.
    unsafe fn write(&self, at: usize, result: R) {
        // SAFETY: the caller's promise.
        unsafe { self.0.add(at).write(result) };
    }
}

/// Does the work on `0..n` in ranges, several for each thread, which take the next one when they are done
/// with one: what else the system does may slow one of them. Results in the order of the ranges.
pub(crate) fn for_ranges<R: Send>(
    n: usize,
    n_threads: usize,
    work: impl Fn(Range<usize>) -> R + Sync,
) -> Result<Vec<R>> {
    let n_ranges = RANGES * n_threads;
    let mut results = Vec::new();
    memory::reserve_exact(&mut results, n_ranges)?;
    let slots = Slots(results.as_mut_ptr());
    let next = AtomicUsize::new(0);
    for_each(0..n_threads, &|_| {
        loop {
            let k = next.fetch_add(1, Relaxed);
            if k >= n_ranges {
                return;
            }
            // SAFETY: there is room for that many, and each number is taken once.
            unsafe { slots.write(k, work(share(n, k, n_ranges))) };
        }
    });
    // SAFETY: each thread has gone on until all numbers were taken, and has written what it took. (After a panic this is
    // not reached.)
    unsafe { results.set_len(n_ranges) };
    Ok(results)
}

/// Range `k` of `n_ranges` of nearly equal lengths that make up `0..n`.
pub(crate) fn share(n: usize, k: usize, n_ranges: usize) -> Range<usize> {
    let end = |k: usize| (n as u64 * k as u64 / n_ranges as u64) as usize;
    end(k)..end(k + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_work_is_done_in_order() {
        for n_ranges in 1..9 {
            let mut parts = vec![0..0; n_ranges];
            fill(&mut parts, &|k| share(1000, k, n_ranges));
            assert!(parts.into_iter().flatten().eq(0..1000));
            let ranges = for_ranges(1000, n_ranges, |range| range).expect("room for them");
            assert!(ranges.into_iter().flatten().eq(0..1000));
            let mut entries = vec![0; 1000];
            for_parts(&mut entries, 0, n_ranges, &|first, part| {
                part.iter_mut().zip(first..).for_each(|(entry, index)| *entry = index);
            });
            assert!(entries.into_iter().eq(0..1000));
        }
    }

    #[test]
    fn exact_calls_of_all_threads_count() {
        let before = tally::exact_calls();
        for_each(0..5, &|_| tally::count());
        assert_eq!(tally::exact_calls() - before, 5);
    }

    #[test]
    #[should_panic(expected = "on another thread: cell 13 went missing")]
    fn panics_pass_on() {
        join(|| (), || panic!("cell {} went missing", 13));
    }

    /// The other thread is waited for, as it may use what the panic is about to drop.
    #[test]
    fn panics_wait() {
        let is_done = Cell::new(false);
        struct IsDone<'c>(&'c Cell<bool>);
        // SAFETY: in this test, the cell is read when the other thread has ended.
        unsafe impl Send for IsDone<'_> {}
        let seen = IsDone(&is_done);
        let joined = catch_unwind(AssertUnwindSafe(|| {
            let work = move || {
                let seen = seen;
                thread::sleep(std::time::Duration::from_millis(20));
                seen.0.set(true);
            };
            join(|| panic!("at once"), work)
        }));
        assert!(joined.is_err() && is_done.get());
    }

    #[test]
    fn results_are_dropped() {
        let shared = std::sync::Arc::new(());
        let results = for_ranges(100, 3, |_| shared.clone()).expect("room for them");
        assert_eq!(std::sync::Arc::strong_count(&shared), 1 + results.len());
        drop(results);
        join(|| (), || drop(shared.clone()));
        assert_eq!(std::sync::Arc::strong_count(&shared), 1);
    }

    #[test]
    fn numbers_of_threads() {
        let chosen = Threads { most: 4, is_given: false };
        assert_eq!([0, 99, 199, 200, 1000].map(|n| chosen.for_work(n, 100, 10)), [1, 1, 1, 2, 4]);
        let given = Threads { most: 4, is_given: true };
        assert_eq!([0, 19, 20, 1000].map(|n| given.for_work(n, 100, 10)), [1, 1, 2, 4]);
        assert_eq!(Threads::ONE.for_work(1 << 30, 100, 10), 1);
    }
}
