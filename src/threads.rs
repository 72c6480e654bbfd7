//! Work on several threads.
//!
//! All of it is divided by [`join`]: scoped threads, each with memory of its own or reading what none writes.
//! The compiler proves that there are no data races; no `unsafe` is involved but to take over what several
//! threads have written side by side ([`memory`](crate::complex::memory)), and to move sites of which no two threads
//! have the same one (`motion::moving`). Results are put together in the order of the work, so that they do not depend
//! on which thread was faster.
//!
//! Threads are started where they are needed, for some 20 µs each. Where the system has none to give, the
//! calling thread does the work of all.

use std::cell::Cell;
use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use crate::predicates;

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

    /// So many at most, or with 0 as many as the system runs at the same time where that pays.
    pub(crate) fn at_most(given: u32) -> Self {
        static AVAILABLE: OnceLock<usize> = OnceLock::new();
        let available =
            || *AVAILABLE.get_or_init(|| thread::available_parallelism().map_or(1, |threads| threads.get()));
        let most = if given == 0 { available() } else { given as usize };
        Threads { most, is_given: given != 0 }
    }

    /// How many to use for work on so many items: no more than leave each one `paying` items, below which a
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

/// Does both, the second on a thread of its own.
pub(crate) fn join<A, B: Send>(a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    let mut b = Some(b);
    let (a, done) = thread::scope(|scope| {
        let work = || {
            IS_WORKER.set(true);
            let b = b.take().expect("work is done once")();
            (b, predicates::exact_calls())
        };
        let worker = thread::Builder::new().spawn_scoped(scope, work);
        (a(), worker.ok().map(|worker| worker.join()))
    });
    match done {
        Some(Ok((b, exact_calls))) => {
            predicates::add_exact_calls(exact_calls);
            (a, b)
        }
        Some(Err(payload)) => {
            let text = payload.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
            panic!("on another thread: {}", text.unwrap_or("no message"))
        }
        None => (a, b.take().expect("the thread was not started")()),
    }
}

/// Does each piece of work of a range on a thread of its own; results in the order of the range.
pub(crate) fn for_each<R: Send>(range: Range<usize>, work: &(impl Fn(usize) -> R + Sync)) -> Vec<R> {
    if range.len() <= 1 {
        return range.map(work).collect();
    }
    let middle = range.start.midpoint(range.end);
    let (mut results, rest) =
        join(|| for_each(range.start..middle, work), || for_each(middle..range.end, work));
    results.extend(rest);
    results
}

/// Does the work on `0..n` in ranges, several for each thread, which take the next one when they are done
/// with one: what else the system does may slow one of them. Results in the order of the ranges.
pub(crate) fn for_ranges<R: Send>(
    n: usize,
    n_threads: usize,
    work: impl Fn(Range<usize>) -> R + Sync,
) -> Vec<R> {
    let n_ranges = RANGES * n_threads;
    let next = AtomicUsize::new(0);
    let results = for_each(0..n_threads, &|_| {
        let taken = std::iter::from_fn(|| Some(next.fetch_add(1, Relaxed)).filter(|&k| k < n_ranges));
        taken.map(|k| (k, work(share(n, k, n_ranges)))).collect::<Vec<_>>()
    });
    let mut results: Vec<(usize, R)> = results.into_iter().flatten().collect();
    results.sort_by_key(|&(k, _)| k);
    results.into_iter().map(|(_, result)| result).collect()
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
            let parts = for_each(0..n_ranges, &|k| share(1000, k, n_ranges));
            assert!(parts.into_iter().flatten().eq(0..1000));
            assert!(for_ranges(1000, n_ranges, |range| range).into_iter().flatten().eq(0..1000));
        }
    }

    #[test]
    fn exact_calls_of_all_threads_count() {
        let before = predicates::exact_calls();
        let f = predicates::StaticFilter::plane([0.0; 2], [2.0; 2]);
        let tie = |_| predicates::orient2d(&f, &[0.1, 0.1], &[0.2, 0.2], &[0.3, 0.3]);
        for_each(0..5, &tie);
        assert_eq!(predicates::exact_calls() - before, 5);
    }

    #[test]
    #[should_panic(expected = "on another thread: cell 13 went missing")]
    fn panics_pass_on() {
        join(|| (), || panic!("cell {} went missing", 13));
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
