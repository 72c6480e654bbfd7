//! Threads that are kept for later work, as waking one takes less time than starting and joining one.
//!
//! Work is *offered*: it lies on the stack of the thread that has it, and in a list of all offers. A worker takes the
//! oldest offer, does the work, and sleeps when there is none. A thread that needs work done that it has offered takes
//! it back and does it itself, unless a worker has taken it; only then it waits. So all work is done whether or not
//! there are workers, and there is no deadlock, however many threads of the program have work: a thread that waits
//! waits for one that runs.
//!
//! Nothing here needs memory of the process's: offers and what workers tell of themselves are on stacks, and the rest
//! is static. So nothing fails where there is none; the system's threads can be refused, unlike those of the standard
//! library.
//!
//! - *`fork`*: the new process has none of the workers, and starts its own. Where a callback has forked, the call that
//!   it belongs to panics in the new process if a worker had some of its work.
//! - *`dlclose`* and `exit`: workers that sleep are ended and joined before the code goes. One that works is left
//!   alone: a call runs then, and only `exit` may come in between.
//! - *Signals* to the process are left to the program's own threads.
//! - *The floating-point environment* of a worker is the default one, whatever that of the thread is that starts it.
//!
//! rayon-core would be the alternative. It allocates its threads and its queues of work, and ends the process where
//! there is no memory; and its threads are neither there in a process that was forked nor ever joined.

#![allow(unsafe_code)]

use std::cell::{Cell, UnsafeCell};
use std::ffi::c_void;
use std::mem::{MaybeUninit, transmute};
use std::ops::Deref;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::environment::Environment;

/// Bytes of stack of a worker, as the standard library has it. It takes few of them, but the variables that the
/// program has for each of its threads are there as well, and those that are not used are address space alone.
const STACK: usize = 2 << 20;

/// How many workers there may be.
static MOST: AtomicUsize = AtomicUsize::new(0);

/// From now on there may be `n` workers.
pub(super) fn allow(n: usize) {
    MOST.fetch_max(n, Relaxed);
}

/// Work that a worker may do.
struct OfferedWork {
    work: *mut (dyn FnMut() + Send),
    stage: Cell<Stage>,
    /// The next younger one.
    next: Cell<Option<&'static OfferedWork>>,
    /// Signalled when the work is done.
    done: Condition,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Offered,
    Taken,
    Done,
}

/// What a worker tells of itself.
struct Worker {
    thread: libc::pthread_t,
    next: Cell<Option<&'static Worker>>,
    works: Cell<bool>,
    /// Whether it is to end; it will be joined.
    ends: Cell<bool>,
}

/// All that threads share. Used by the one that has the lock.
struct PoolState {
    /// The oldest one.
    offers: Cell<Option<&'static OfferedWork>>,
    n_offers: Cell<usize>,
    /// The workers that are not to end.
    workers: Cell<Option<&'static Worker>>,
    n_workers: Cell<usize>,
    /// How many workers are started, and not among `workers` yet.
    n_starting: Cell<usize>,
    n_asleep: Cell<usize>,
    /// How often there was a fork on the way to this process.
    n_forks: Cell<u32>,
    /// Whether the handlers for `fork` and for the end are in place.
    has_handlers: Cell<bool>,
    /// Whether the code goes.
    is_closed: Cell<bool>,
    /// Signalled when there is an offer, and to all when workers are to end or have started.
    call: Condition,
}

struct Pool {
    lock: UnsafeCell<libc::pthread_mutex_t>,
    shared: PoolState,
}

// SAFETY: what is shared, and all that is reached from it, is used by the thread that has the lock.
unsafe impl Sync for Pool {}

static POOL: Pool = Pool {
    lock: UnsafeCell::new(libc::PTHREAD_MUTEX_INITIALIZER),
    shared: PoolState {
        offers: Cell::new(None),
        n_offers: Cell::new(0),
        workers: Cell::new(None),
        n_workers: Cell::new(0),
        n_starting: Cell::new(0),
        n_asleep: Cell::new(0),
        n_forks: Cell::new(0),
        has_handlers: Cell::new(false),
        is_closed: Cell::new(false),
        call: Condition::new(),
    },
};

/// The pool, for as long as this thread has the lock.
struct Locked(());

impl Locked {
    fn new() -> Self {
        // SAFETY: it is initialised, and no thread that has it comes here.
        let failure = unsafe { libc::pthread_mutex_lock(POOL.lock.get()) };
        debug_assert_eq!(failure, 0);
        Locked(())
    }
}

impl Deref for Locked {
    type Target = PoolState;

    fn deref(&self) -> &PoolState {
        &POOL.shared
    }
}

impl Drop for Locked {
    fn drop(&mut self) {
        // SAFETY: this thread has it.
        let failure = unsafe { libc::pthread_mutex_unlock(POOL.lock.get()) };
        debug_assert_eq!(failure, 0);
    }
}

/// What a thread may wait for. It holds nothing that would have to be given back.
struct Condition(UnsafeCell<libc::pthread_cond_t>);

impl Condition {
    const fn new() -> Self {
        Condition(UnsafeCell::new(libc::PTHREAD_COND_INITIALIZER))
    }

    /// Gives the lock up until this is signalled, or for no reason.
    fn wait(&self, _: &Locked) {
        // SAFETY: both are initialised, and this thread has the lock.
        let failure = unsafe { libc::pthread_cond_wait(self.0.get(), POOL.lock.get()) };
        debug_assert_eq!(failure, 0);
    }

    fn signal(&self) {
        // SAFETY: it is initialised.
        unsafe { libc::pthread_cond_signal(self.0.get()) };
    }

    fn signal_to_all(&self) {
        // SAFETY: it is initialised.
        unsafe { libc::pthread_cond_broadcast(self.0.get()) };
    }
}

/// Calls `a` while a worker may do the work. What no worker has begun by then is not done.
pub(super) fn beside<A>(work: &mut (dyn FnMut() + Send), a: impl FnOnce() -> A) -> A {
    if MOST.load(Relaxed) == 0 {
        return a();
    }
    // SAFETY: the two differ in a lifetime; this function ends when nobody uses it any more.
    let work = unsafe { transmute::<&mut (dyn FnMut() + Send), *mut (dyn FnMut() + Send + 'static)>(work) };
    let offer =
        OfferedWork { work, stage: Cell::new(Stage::Offered), next: Cell::new(None), done: Condition::new() };
    // SAFETY: the two differ in a lifetime; `offered` is dropped below, or by a panic of `a`, before the offer is.
    let offered = Offered::new(unsafe { transmute::<&OfferedWork, &'static OfferedWork>(&offer) });
    let a = a();
    drop(offered);
    a
}

/// An offer that has been made. When dropped, it is taken back or has been done.
struct Offered {
    offer: &'static OfferedWork,
    n_forks: u32,
}

impl Offered {
    fn new(offer: &'static OfferedWork) -> Self {
        let pool = Locked::new();
        pool.append(offer);
        if pool.n_offers.get() <= pool.n_asleep.get() {
            pool.call.signal();
        } else if pool.n_workers.get() < MOST.load(Relaxed) {
            pool.start();
        }
        Offered { offer, n_forks: pool.n_forks.get() }
    }
}

impl Drop for Offered {
    fn drop(&mut self) {
        let pool = Locked::new();
        if self.offer.stage.get() == Stage::Offered {
            pool.remove(self.offer);
        }
        while self.offer.stage.get() == Stage::Taken {
            if self.n_forks != pool.n_forks.get() {
                drop(pool);
                assert!(std::thread::panicking(), "a thread of another process has some of the work");
                return;
            }
            self.offer.done.wait(&pool);
        }
    }
}

impl PoolState {
    /// Puts an offer at the end of the list.
    fn append(&self, offer: &'static OfferedWork) {
        let mut last = &self.offers;
        while let Some(before) = last.get() {
            last = &before.next;
        }
        last.set(Some(offer));
        self.n_offers.set(self.n_offers.get() + 1);
    }

    /// Takes an offer from the list, if it is there.
    fn remove(&self, offer: &OfferedWork) {
        let mut at = &self.offers;
        while let Some(other) = at.get() {
            if std::ptr::eq(other, offer) {
                at.set(offer.next.get());
                self.n_offers.set(self.n_offers.get() - 1);
                return;
            }
            at = &other.next;
        }
    }

    /// Takes the oldest offer from the list, to do the work.
    fn take(&self) -> Option<&'static OfferedWork> {
        let offer = self.offers.get()?;
        self.remove(offer);
        offer.stage.set(Stage::Taken);
        Some(offer)
    }

    /// Starts a worker, if there is one to be had.
    fn start(&self) {
        if self.is_closed.get() || !self.has_handlers.get() && !self.place_handlers() {
            return;
        }
        if start_thread(work) {
            self.n_workers.set(self.n_workers.get() + 1);
            self.n_starting.set(self.n_starting.get() + 1);
        }
    }

    fn place_handlers(&self) -> bool {
        // SAFETY: the handlers may be called at any time, and the system forgets them when it unloads the library. To
        // close twice does no harm, should the second registration fail now and not the next time.
        self.has_handlers.set(unsafe {
            libc::atexit(close) == 0
                && libc::pthread_atfork(Some(before_fork), Some(after_fork), Some(in_new_process)) == 0
        });
        self.has_handlers.get()
    }

    /// Takes a worker that does nothing from the list.
    fn take_idle(&self) -> Option<&'static Worker> {
        let mut at = &self.workers;
        while let Some(worker) = at.get() {
            if !worker.works.get() {
                at.set(worker.next.get());
                return Some(worker);
            }
            at = &worker.next;
        }
        None
    }
}

/// What a worker does.
extern "C" fn work(_: *mut c_void) -> *mut c_void {
    // A thread has that of the one that starts it.
    Environment::leave();
    // SAFETY: a question without conditions.
    let thread = unsafe { libc::pthread_self() };
    let own = Worker { thread, next: Cell::new(None), works: Cell::new(false), ends: Cell::new(false) };
    // SAFETY: nobody uses it any more when it is to end, as it is then not in the list.
    let own = unsafe { transmute::<&Worker, &'static Worker>(&own) };
    let mut pool = Locked::new();
    own.next.set(pool.workers.replace(Some(own)));
    pool.n_starting.set(pool.n_starting.get() - 1);
    pool.call.signal_to_all();
    while !own.ends.get() {
        let Some(offer) = pool.take() else {
            pool.n_asleep.set(pool.n_asleep.get() + 1);
            pool.call.wait(&pool);
            pool.n_asleep.set(pool.n_asleep.get() - 1);
            continue;
        };
        own.works.set(true);
        drop(pool);
        // SAFETY: it is there until it is done, and this thread alone has taken it.
        unsafe { (*offer.work)() };
        pool = Locked::new();
        own.works.set(false);
        offer.stage.set(Stage::Done);
        offer.done.signal();
    }
    null_mut()
}

/// Starts a thread that handles none of the signals to the process. Whether there was one to be had.
fn start_thread(run: extern "C" fn(*mut c_void) -> *mut c_void) -> bool {
    let mut attributes = MaybeUninit::uninit();
    let mut thread = MaybeUninit::uninit();
    let (mut blocked, mut before) = (MaybeUninit::uninit(), MaybeUninit::uninit());
    // SAFETY: the attributes and the sets are initialised before they are used, and the attributes not used after they
    // are destroyed; a size of the stack that the system refuses leaves its own. `run` may be called at any time.
    unsafe {
        if libc::pthread_attr_init(attributes.as_mut_ptr()) != 0 {
            return false;
        }
        libc::pthread_attr_setstacksize(attributes.as_mut_ptr(), STACK);
        libc::sigfillset(blocked.as_mut_ptr());
        // Signals by which a thread learns of its own errors are not blocked.
        for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGILL, libc::SIGFPE, libc::SIGTRAP, libc::SIGABRT]
        {
            libc::sigdelset(blocked.as_mut_ptr(), signal);
        }
        let is_masked = libc::pthread_sigmask(libc::SIG_SETMASK, blocked.as_ptr(), before.as_mut_ptr()) == 0;
        let failure = libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), run, null_mut());
        if is_masked {
            libc::pthread_sigmask(libc::SIG_SETMASK, before.as_ptr(), null_mut());
        }
        libc::pthread_attr_destroy(attributes.as_mut_ptr());
        failure == 0
    }
}

/// No other thread is in the middle of something when the process is copied.
extern "C" fn before_fork() {
    std::mem::forget(Locked::new());
}

extern "C" fn after_fork() {
    drop(Locked(()));
}

/// Here are no workers, and no threads with offers but this one, which takes its own back.
extern "C" fn in_new_process() {
    let pool = Locked(());
    pool.offers.set(None);
    pool.n_offers.set(0);
    pool.workers.set(None);
    for count in [&pool.n_workers, &pool.n_starting, &pool.n_asleep] {
        count.set(0);
    }
    pool.n_forks.set(pool.n_forks.get() + 1);
    // SAFETY: no thread waits for it here. What it knows of threads that did in the other process is not for this one.
    unsafe { pool.call.0.get().write(libc::PTHREAD_COND_INITIALIZER) };
}

/// Ends the workers that do nothing, before their code goes.
extern "C" fn close() {
    let mut pool = Locked::new();
    pool.is_closed.set(true);
    loop {
        while pool.n_starting.get() > 0 {
            pool.call.wait(&pool);
        }
        let Some(worker) = pool.take_idle() else { return };
        let thread = worker.thread;
        worker.ends.set(true);
        pool.call.signal_to_all();
        drop(pool);
        // SAFETY: a worker of this process that nobody else joins.
        let failure = unsafe { libc::pthread_join(thread, null_mut()) };
        debug_assert_eq!(failure, 0);
        pool = Locked::new();
    }
}
