//! Work on several threads.
//!
//! All of it is divided by [`join`]: scoped threads, each with memory of its own or reading what none writes. The
//! compiler proves that there are no data races; no `unsafe` is involved but in the [pool](super::pool) of threads, to
//! take over what several threads have written side by side (here and in [`memory`](super::memory)), to give several
//! arrays a part each of the same memory ([`aligned`](super::aligned)), and to move sites of which no two threads have
//! the same one (`motion::moving`). Results are put together in the order of the work, so that they do not depend on
//! which thread was faster.
//!
//! How many threads there are follows the work: as many as pay, no more than the system runs at the same time, and no
//! more than the caller allows. Where the system has none to give, or all are at work, the calling thread does the work
//! of all.
//!
//! If the environment variable `DELDRIFT_ALL_THREADS` is set, to any value, as many are used as the caller allows,
//! however little the work is and however many the system runs at the same time. This is for tests, which thus need no
//! large inputs. The variable is read once.

#![allow(unsafe_code)]

use std::any::Any;
use std::cell::Cell;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering::Relaxed};
use std::thread;

#[cfg(not(unix))]
use super::environment;
#[cfg(unix)]
use super::pool::{self, beside};
use super::{processors, tally};
use crate::error::{Error, Result};

/// Ranges for each thread.
const RANGES: usize = 8;

/// How many threads a call may use, and how work is divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    most: usize,
    /// Most parts of work whose division shows in what comes of it; 0 for one a thread.
    parts: usize,
    /// Whether all are to be used.
    all: bool,
}

impl Threads {
    /// The calling thread alone.
    pub(crate) const ONE: Threads = Threads { most: 1, parts: 0, all: false };

    /// At most `given`, or with 0 no more than the system runs at the same time, which is the most that are used in any
    /// case. Work whose division shows is divided into at most so many `parts`, or with 0 into one for each thread.
    pub(crate) fn at_most(given: u32, parts: usize) -> Self {
        if given > 0 && are_all_used() {
            return Threads::exactly(given).in_parts(parts);
        }
        let available = available();
        let most = if given == 0 { available } else { available.min(given as usize) };
        if most > 1 {
            // More than one call may run at a time.
            allow_workers(available - 1);
        }
        Threads { most, parts, all: false }
    }

    /// `n` threads wherever the work can be divided, whether or not that pays.
    pub(crate) fn exactly(n: u32) -> Self {
        let most = n as usize;
        if most > 1 {
            allow_workers(most - 1);
        }
        Threads { most, parts: 0, all: true }
    }

    /// As many threads, which divide work whose division shows into at most so many parts.
    pub(crate) fn in_parts(self, parts: usize) -> Self {
        Threads { parts, ..self }
    }

    /// How many to use for work on `items` items: at most as many as leave each one `paying` items, below which a
    /// thread more costs as much as it saves, or `least` if all are to be used.
    pub(crate) fn for_work(self, items: usize, paying: usize, least: usize) -> usize {
        (items / if self.all { least } else { paying }).clamp(1, self.most)
    }

    /// Into how many parts to divide work on `items` items where the division shows in what comes of it: as many as
    /// threads would be used [for it](Self::for_work), but for how many there are if the number of parts is given.
    pub(crate) fn parts_of(self, items: usize, paying: usize, least: usize) -> usize {
        let most = if self.parts == 0 { self.most } else { self.parts };
        Threads { most, ..self }.for_work(items, paying, least)
    }

    /// The threads for work that is divided again and again, maybe into more parts than there are threads.
    pub(crate) fn crew(self) -> Crew {
        Crew(AtomicUsize::new(self.most - 1))
    }
}

/// How many threads may join in with those at work.
pub(crate) struct Crew(AtomicUsize);

impl Crew {
    /// Whether one more may join in; [`leave`](Self::leave) must follow if so.
    pub(crate) fn enter(&self) -> bool {
        self.0.fetch_update(Relaxed, Relaxed, |idle| idle.checked_sub(1)).is_ok()
    }

    /// Ends the work of a thread here: the thread may join in elsewhere.
    pub(crate) fn leave(&self) {
        self.0.fetch_add(1, Relaxed);
    }
}

/// How many threads the system runs at the same time; asked once.
fn available() -> usize {
    static AVAILABLE: AtomicUsize = AtomicUsize::new(0);
    if AVAILABLE.load(Relaxed) == 0 {
        AVAILABLE.store(processors::available(), Relaxed);
    }
    AVAILABLE.load(Relaxed)
}

/// Whether all threads are used that a caller allows: not known yet, no, or yes.
static ARE_ALL_USED: AtomicU8 = AtomicU8::new(UNKNOWN);
const UNKNOWN: u8 = 0;
const NO: u8 = 1;
const YES: u8 = 2;

#[cfg(any(unix, windows))]
fn is_variable_set() -> bool {
    // SAFETY: the name ends with a zero, and what the answer points to is not read.
    !unsafe { libc::getenv(c"DELDRIFT_ALL_THREADS".as_ptr()) }.is_null()
}

/// Where there is no system there are no variables.
#[cfg(not(any(unix, windows)))]
fn is_variable_set() -> bool {
    false
}

fn are_all_used() -> bool {
    if ARE_ALL_USED.load(Relaxed) == UNKNOWN {
        ARE_ALL_USED.store(if is_variable_set() { YES } else { NO }, Relaxed);
    }
    ARE_ALL_USED.load(Relaxed) == YES
}

/// Has all threads used that a caller allows, as if `DELDRIFT_ALL_THREADS` were set.
#[cfg(feature = "internals")]
pub fn use_all_threads() {
    ARE_ALL_USED.store(YES, Relaxed);
}

#[cfg(unix)]
fn allow_workers(n: usize) {
    pool::allow(n);
}

/// Threads are started for each piece of work.
#[cfg(not(unix))]
fn allow_workers(_: usize) {}

thread_local! {
    static IS_WORKER: Cell<bool> = const { Cell::new(false) };
}

/// Whether the current thread does work of another one, which raises its panics again.
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
    /// Does the work on another thread.
    fn run(&mut self) {
        IS_WORKER.set(true);
        let before = tally::exact_calls();
        self.done = self
            .work
            .take()
            .map(|work| catch_unwind(AssertUnwindSafe(|| (work(), tally::exact_calls() - before))));
    }
}

/// Does two pieces of work, the second on another thread if there is one to be had meanwhile.
pub(crate) fn join<A, B: Send>(a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    let mut task = Task { work: Some(b), done: None };
    let a = beside(&mut || task.run(), a);
    match (task.done, task.work) {
        (Some(Ok((b, exact_calls))), _) => {
            tally::add(exact_calls);
            (a, b)
        }
        (Some(Err(payload)), _) => panic!("on another thread: {}", message(&payload)),
        (None, work) => (a, work.expect("it is there or done")()),
    }
}

/// What a panic says.
fn message(payload: &Box<dyn Any + Send>) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

/// Calls `a` while another thread may do the work, if there is one to be had.
#[cfg(not(unix))]
fn beside<A>(work: &mut (dyn FnMut() + Send), a: impl FnOnce() -> A) -> A {
    thread::scope(|scope| {
        // What is not started is not done.
        let _ = thread::Builder::new().spawn_scoped(scope, || environment::in_default(work));
        a()
    })
}

/// Does each piece of work of a range, on as many threads as there are pieces.
pub(crate) fn for_each(range: Range<usize>, work: &(impl Fn(usize) + Sync)) {
    if range.len() <= 1 {
        range.for_each(work);
        return;
    }
    let middle = range.start.midpoint(range.end);
    join(|| for_each(range.start..middle, work), || for_each(middle..range.end, work));
}

/// Does `n` pieces of work on so many threads, which take the next one when they are done with one.
pub(crate) fn for_pieces(n: usize, n_threads: usize, work: &(impl Fn(usize) + Sync)) {
    let next = AtomicUsize::new(0);
    for_each(0..n_threads, &|_| {
        loop {
            let k = next.fetch_add(1, Relaxed);
            if k >= n {
                return;
            }
            work(k);
        }
    });
}

/// Makes each entry of an array by its index.
pub(crate) fn fill<R: Send>(results: &mut [R], n_threads: usize, work: &(impl Fn(usize) -> R + Sync)) {
    for_parts(results, 0, n_threads, &|first, part: &mut [R]| {
        (first..).zip(part).for_each(|(k, result)| *result = work(k));
    });
}

/// Works on as many parts of an array as there are threads; `first` is the index of its first entry.
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
    let no_room = |_| Error::OutOfMemory { bytes: n_ranges * size_of::<R>() };
    results.try_reserve_exact(n_ranges).map_err(no_room)?;
    let slots = Slots(results.as_mut_ptr());
    // SAFETY: there is room for that many, and each number is taken once.
    for_pieces(n_ranges, n_threads, &|k| unsafe { slots.write(k, work(share(n, k, n_ranges))) });
    // SAFETY: each thread has gone on until all numbers were taken, and has written what it took. (After a panic this
    // is not reached.)
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
    use std::sync::atomic::AtomicBool;

    #[test]
    fn all_work_is_done_in_order() {
        for n_ranges in 1..9 {
            let mut parts = vec![0..0; n_ranges];
            fill(&mut parts, n_ranges, &|k| share(1000, k, n_ranges));
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

    /// Does two pieces of work, the second certainly on another thread.
    fn join_surely<A, B: Send>(a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
        Threads::exactly(3);
        let has_begun = AtomicBool::new(false);
        let wait = || {
            while !has_begun.load(Relaxed) {
                thread::yield_now();
            }
            a()
        };
        join(wait, || {
            has_begun.store(true, Relaxed);
            b()
        })
    }

    #[test]
    fn exact_calls_of_all_threads_count() {
        let before = tally::exact_calls();
        for _ in 0..3 {
            join_surely(tally::count, tally::count);
        }
        for_each(0..5, &|_| tally::count());
        assert_eq!(tally::exact_calls() - before, 11);
    }

    #[test]
    #[should_panic(expected = "on another thread: cell 13 went missing")]
    fn panics_pass_on() {
        join_surely(|| (), || panic!("cell {} went missing", 13));
    }

    #[test]
    #[cfg(not(miri))]
    fn other_threads_are_in_the_default_environment() {
        use crate::machine::environment::tests::{IS_KNOWN, abroad, is_default_now};
        let (here, there) = abroad(|| join_surely(is_default_now, is_default_now));
        assert!(there && here != IS_KNOWN);
    }

    /// Threads are kept, and work is done as well when all have some: by those that have it.
    #[test]
    fn many_threads_have_work() {
        Threads::exactly(3);
        let sum = |n: usize| {
            let sum = AtomicUsize::new(0);
            for_each(0..n, &|k| {
                for_each(0..3, &|_| thread::yield_now());
                sum.fetch_add(k, Relaxed);
            });
            sum.into_inner()
        };
        thread::scope(|scope| {
            for n in 1..20 {
                scope.spawn(move || (0..100).for_each(|_| assert_eq!(sum(n), n * (n - 1) / 2)));
            }
        });
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
            join_surely(|| panic!("at once"), work)
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
        join_surely(|| (), || drop(shared.clone()));
        assert_eq!(std::sync::Arc::strong_count(&shared), 1);
    }

    /// Pieces and entries are more than threads, and each is done once.
    #[test]
    fn few_threads_do_many_pieces() {
        for n_threads in 1..5 {
            let done = [const { AtomicUsize::new(0) }; 9];
            for_pieces(9, n_threads, &|k| {
                done[k].fetch_add(1, Relaxed);
            });
            assert!(done.into_iter().all(|n| n.into_inner() == 1));
            let mut entries = [0; 9];
            fill(&mut entries, n_threads, &|k| k);
            assert!(entries.into_iter().eq(0..9));
        }
        let crew = Threads { most: 3, parts: 7, all: false }.crew();
        assert_eq!([(); 3].map(|()| crew.enter()), [true, true, false]);
        crew.leave();
        assert!(crew.enter() && !crew.enter() && !Threads::ONE.crew().enter());
    }

    #[test]
    fn numbers_of_threads() {
        let some = Threads { most: 4, parts: 0, all: false };
        assert_eq!([0, 99, 199, 200, 1000].map(|n| some.for_work(n, 100, 10)), [1, 1, 1, 2, 4]);
        let all = Threads::exactly(4);
        assert_eq!([0, 19, 20, 1000].map(|n| all.for_work(n, 100, 10)), [1, 1, 2, 4]);
        assert!(
            Threads::at_most(0, 0).most == available() && Threads::at_most(u32::MAX, 0).most == available()
        );
        assert_eq!(Threads::at_most(1, 0).for_work(1 << 30, 100, 10), 1);
        // Parts follow the threads, unless a number is given.
        assert_eq!([0, 199, 200, 1000].map(|n| some.parts_of(n, 100, 10)), [1, 1, 2, 4]);
        for most in 1..9 {
            let given = Threads { most, parts: 6, all: false };
            assert_eq!([0, 199, 200, 1000].map(|n| given.parts_of(n, 100, 10)), [1, 1, 2, 6]);
            assert_eq!(given.for_work(1000, 100, 10), most);
        }
        assert_eq!(Threads::ONE.for_work(1 << 30, 100, 10), 1);
    }
}
