//! Replays a corpus, then runs mutations of it and random bytes, from a seed. It is not guided by coverage: libFuzzer is.

use super::exact_oracle::Random;
use super::{allocator, calls, loaders, predicates, tally};
use std::cell::RefCell;
use std::fs;
use std::panic::{catch_unwind, set_hook, take_hook};
use std::path::{Path, PathBuf};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicPtr, AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// A function to be called with bytes of any length.
#[derive(Clone, Copy)]
pub struct Target {
    pub name: &'static str,
    pub run: fn(&[u8]),
    /// More bytes than this change nothing, or take long.
    longest: usize,
    /// Executions between two looks at the clock.
    batch: u64,
}

pub const TARGETS: [Target; 3] = [
    Target { name: "predicates", run: predicates::run, longest: 160, batch: 1024 },
    Target { name: "calls", run: calls::run, longest: 500, batch: 4 },
    Target { name: "loaders", run: loaders::run, longest: 600, batch: 16 },
];

/// When to stop.
#[derive(Clone, Copy)]
pub enum Budget {
    Seconds(f64),
    Executions(u64),
}

/// Bytes with which a target failed, and what it said.
pub struct Finding {
    pub data: Vec<u8>,
    pub message: String,
}

/// What came of it.
pub struct Report {
    pub executions: u64,
    pub replayed: usize,
    pub elapsed: Duration,
    pub findings: Vec<Finding>,
}

/// After so many there is nothing new to be learned.
const MOST_FINDINGS: usize = 10;

thread_local! {
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// What the target says against the bytes, if anything.
pub fn failure(target: Target, data: &[u8]) -> Option<String> {
    RUNNING.store(data.as_ptr().cast_mut(), Relaxed);
    LENGTH.store(data.len(), Relaxed);
    let outcome = catch_unwind(|| (target.run)(data));
    LENGTH.store(0, Relaxed);
    outcome.err().map(|_| {
        allocator::disarm();
        MESSAGE.take()
    })
}

/// Keeps what panics say for `failure`, while it works.
pub fn hearing<R>(work: impl FnOnce() -> R) -> R {
    let hook = take_hook();
    set_hook(Box::new(|info| {
        allocator::disarm();
        MESSAGE.set(info.to_string().chars().take(1500).collect());
    }));
    let result = work();
    set_hook(hook);
    result
}

/// The files of a folder, by name.
pub fn corpus(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(&path).expect("a file"))).collect()
}

/// Runs a target: on its corpus, and then by the budget.
pub fn drive(target: Target, budget: Budget, seed: u64, folder: &Path) -> Report {
    let corpus: Vec<Vec<u8>> = corpus(folder).into_iter().map(|(_, data)| data).collect();
    hearing(|| {
        let begin = Instant::now();
        let mut report =
            Report { executions: 0, replayed: corpus.len(), elapsed: Duration::ZERO, findings: Vec::new() };
        let run = |report: &mut Report, data: &[u8]| {
            report.executions += 1;
            if let Some(message) = failure(target, data) {
                report.findings.push(Finding { data: data.to_vec(), message });
            }
        };
        corpus.iter().for_each(|data| run(&mut report, data));
        let random = &mut Random::new(seed);
        let mut data = Vec::new();
        while report.findings.len() < MOST_FINDINGS {
            let is_over = match budget {
                Budget::Seconds(seconds) => begin.elapsed().as_secs_f64() >= seconds,
                Budget::Executions(n) => report.executions >= n + corpus.len() as u64,
            };
            if is_over {
                break;
            }
            for _ in 0..target.batch {
                make(&mut data, &corpus, target.longest, random);
                run(&mut report, &data);
            }
        }
        report.elapsed = begin.elapsed();
        report
    })
}

/// Random bytes, or an entry of the corpus with changes.
fn make(data: &mut Vec<u8>, corpus: &[Vec<u8>], longest: usize, random: &mut Random) {
    data.clear();
    if corpus.is_empty() || random.below(3) == 0 {
        let length = 1 + random.below(longest);
        while data.len() < length {
            data.extend(random.next().to_le_bytes());
        }
        return;
    }
    data.extend(&corpus[random.below(corpus.len())]);
    for _ in 0..1 << random.below(5) {
        let n = data.len().max(1);
        let (at, other) = (random.below(n), random.below(n));
        let length = (1 + random.below(8)).min(data.len().saturating_sub(at.max(other)));
        match random.below(8) {
            _ if data.is_empty() => data.push(random.next() as u8),
            0 => data[at] ^= 1 << random.below(8),
            1 | 2 => data[at] = random.next() as u8,
            3 => data.insert(at, random.next() as u8),
            4 => drop(data.drain(at..at + length)),
            5 => data.copy_within(other..other + length, at),
            6 => {
                let from = &corpus[random.below(corpus.len())];
                let start = random.below(from.len().max(1));
                data.truncate(at);
                data.extend(from.get(start..).unwrap_or_default());
            }
            _ => data.extend((0..1 + random.below(32)).map(|_| random.next() as u8)),
        }
    }
    data.truncate(4 * longest);
}

/// Fewer and smaller bytes with which the target fails still.
pub fn shrunk(target: Target, data: &[u8]) -> Vec<u8> {
    hearing(|| {
        let mut best = data.to_vec();
        let mut length = best.len().next_power_of_two();
        while length > 0 {
            let mut at = 0;
            while at < best.len() {
                let mut shorter = best.clone();
                shorter.drain(at..(at + length).min(best.len()));
                if failure(target, &shorter).is_some() {
                    best = shorter;
                } else {
                    at += length;
                }
            }
            length /= 2;
        }
        for at in 0..best.len() {
            let byte = best[at];
            for smaller in [0, 1, byte / 2] {
                best[at] = smaller;
                if smaller < byte && failure(target, &best).is_some() {
                    break;
                }
                best[at] = byte;
            }
        }
        best
    })
}

/// What has been counted since the process began.
pub fn counts() -> String {
    let counted = tally::ALL.iter().filter(|count| count.get() > 0);
    counted.map(|count| format!("{} {}", count.get(), count.0)).collect::<Vec<_>>().join(", ")
}

// ------------------------------------------------------------------------------------------------ ends of the process

/// The bytes that a target is at work on.
static RUNNING: AtomicPtr<u8> = AtomicPtr::new(null_mut());
static LENGTH: AtomicUsize = AtomicUsize::new(0);
/// Where to write them, with a NUL at the end.
static PATH: AtomicPtr<libc::c_char> = AtomicPtr::new(null_mut());

/// Has the bytes written to a file if a signal ends the process.
pub fn save_on_signal(path: &Path) {
    let path = std::ffi::CString::new(path.to_str().expect("UTF-8")).expect("no NUL");
    PATH.store(path.into_raw(), Relaxed);
    for signal in [libc::SIGSEGV, libc::SIGABRT, libc::SIGBUS, libc::SIGILL, libc::SIGFPE] {
        // SAFETY: all zero is a valid action; the handler calls only what is safe in handlers.
        unsafe {
            let mut action: libc::sigaction = std::mem::zeroed();
            action.sa_sigaction = save as extern "C" fn(i32) as usize;
            action.sa_flags = libc::SA_ONSTACK | libc::SA_RESETHAND;
            libc::sigaction(signal, &action, null_mut());
        }
    }
}

extern "C" fn save(signal: i32) {
    let text = c"a signal ended the process; its bytes are in the file of findings that ends in -signal\n";
    // SAFETY: these calls are safe in handlers, and the bytes are there while a target is at work.
    unsafe {
        let file = libc::open(PATH.load(Relaxed), libc::O_CREAT | libc::O_WRONLY | libc::O_TRUNC, 0o644);
        libc::write(file, RUNNING.load(Relaxed).cast(), LENGTH.load(Relaxed));
        libc::write(2, text.as_ptr().cast(), text.count_bytes());
        libc::raise(signal);
    }
}
