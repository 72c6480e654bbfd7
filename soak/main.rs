//! Random histories of moving points for as long as one likes: `make soak HOURS=1`.
//!
//! ```text
//! cargo bench --bench soak -- [--hours H | --histories N | --seed K] [--from K] [--step K] [--workers N] [--csv FILE]
//! ```
//!
//! Histories of seeds 0, 1, 2, ... (or from another one on), in the plane and in space by turns, are run on two threads
//! for some hours, or so many of them; `--seed` runs one, says what it does, and stops at the first mismatch. Without
//! any of these it is those whose checksum is recorded.
//!
//! A history is a function of its seed: of 5 to some 10,000s of points of one of [several kinds](histories), which move
//! in all manners, by every algorithm, while vertices come and go. After every commit
//!
//! - positions, cells, and which vertices are hidden are those of a fresh build on one thread. Cells are compared by
//!   two sums of 64 bits over all of them, and cell by cell after the last commit;
//! - what has been carried along by the change list is what there is.
//!
//! After every commit of up to 100 points, and one in eight of more, all certificates are evaluated exactly
//! (`Level::Delaunay`), and all neighbours are looked at. The checksum is of all cells after every commit: it depends
//! on the seeds alone, not on the time, the threads, the build or the processor.
//!
//! One history in five behind those that are recorded is of a box that repeats, whose cells are compared with those of what
//! is made anew, in other periods and by other vectors, and of copies: `--from 44 --step 5` runs these alone. One in
//! ten is of a domain that is coarsened and refined while it moves (histories/meshes): `--from 42 --step 10`.
//!
//! A process that dies has printed the seeds that were running up to a minute before; `--from` goes on from there.

#[path = "../tests/common/mod.rs"]
mod common;
mod histories;
mod summary;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
use std::sync::{Condvar, Mutex};
use std::time::{Duration, Instant};
use summary::Summary;

/// After so many mismatches it is enough.
const ENOUGH: usize = 10;

/// What the command line asks for.
struct Arguments {
    /// How long; for ever if not said.
    time: Option<Duration>,
    from: u64,
    /// From one seed to the next.
    step: u64,
    /// How many histories; as many as there is time for if not said.
    histories: Option<u64>,
    one: Option<u64>,
    workers: usize,
    csv: Option<String>,
}

impl Arguments {
    fn read() -> Self {
        let mut arguments =
            Arguments { time: None, from: 0, step: 1, histories: None, one: None, workers: 2, csv: None };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            let mut number = || words.next().and_then(|word| word.parse::<f64>().ok()).expect("a number");
            match word.as_str() {
                // What cargo gives to every benchmark.
                "--bench" => {}
                "--hours" => arguments.time = Some(Duration::from_secs_f64(3600.0 * number())),
                "--histories" => arguments.histories = Some(number() as u64),
                "--from" => arguments.from = number() as u64,
                "--seed" => arguments.one = Some(number() as u64),
                "--step" => arguments.step = (number() as u64).max(1),
                "--workers" => arguments.workers = number() as usize,
                "--csv" => arguments.csv = Some(words.next().expect("the name of a file")),
                _ => panic!("unknown argument {word}"),
            }
        }
        if arguments.time.is_none() && arguments.histories.is_none() {
            arguments.histories = Some(histories::RECORDED.len() as u64);
        }
        arguments
    }
}

/// What the workers share.
struct Shared {
    start: Instant,
    next: AtomicU64,
    summary: Mutex<Summary>,
    /// A worker has ended.
    ended: Condvar,
}

/// Runs history after history.
fn work(arguments: &Arguments, shared: &Shared) {
    let is_wanted = |seed: u64| {
        arguments.time.is_none_or(|time| shared.start.elapsed() < time)
            && arguments.histories.is_none_or(|n| (seed - arguments.from) / arguments.step < n)
            && shared.summary.lock().expect("no panic").wrong.len() < ENOUGH
    };
    // Every seed that is taken is run to its end, so they are consecutive.
    while is_wanted(shared.next.load(SeqCst)) {
        let seed = shared.next.fetch_add(arguments.step, SeqCst);
        if arguments.histories.is_some_and(|n| (seed - arguments.from) / arguments.step >= n) {
            break;
        }
        shared.summary.lock().expect("no panic").begin(seed);
        let outcome = catch_unwind(AssertUnwindSafe(|| histories::run(seed, false))).ok();
        if outcome.is_none() {
            // Where the library has panicked, what has been printed by then does not tell.
            eprintln!("seed {seed} has failed");
        }
        shared.summary.lock().expect("no panic").end(seed, outcome);
    }
    shared.summary.lock().expect("no panic").working -= 1;
    shared.ended.notify_all();
}

/// Prints a line every minute, and waits for the workers.
fn watch(shared: &Shared) {
    let mut summary = shared.summary.lock().expect("no panic");
    let mut minute = 1;
    while summary.working > 0 {
        let wait =
            (shared.start + Duration::from_secs(60 * minute)).saturating_duration_since(Instant::now());
        (summary, _) = shared.ended.wait_timeout(summary, wait).expect("no panic");
        if shared.start.elapsed() >= Duration::from_secs(60 * minute) {
            println!("{}", summary.line(shared.start.elapsed()));
            minute += 1;
        }
    }
}

fn main() {
    let arguments = Arguments::read();
    if let Some(seed) = arguments.one {
        let outcome = histories::run(seed, true);
        println!("no mismatch; checksum {:016x}", outcome.checksum);
        return;
    }
    let shared = Shared {
        start: Instant::now(),
        next: AtomicU64::new(arguments.from),
        summary: Mutex::new(Summary::new(arguments.from, arguments.step, arguments.workers)),
        ended: Condvar::new(),
    };
    std::thread::scope(|scope| {
        for _ in 0..arguments.workers {
            scope.spawn(|| work(&arguments, &shared));
        }
        watch(&shared);
    });
    let elapsed = shared.start.elapsed();
    let summary = shared.summary.into_inner().expect("no panic");
    print!("{}", summary.report(elapsed));
    if let Some(path) = &arguments.csv {
        std::fs::write(path, summary.csv(elapsed)).expect("a file to write to");
    }
    std::process::exit(i32::from(!summary.wrong.is_empty()));
}
