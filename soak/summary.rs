//! What all histories together have come to.

use crate::histories::{Outcome, RECORDED, Tally, dimension_of, mixed};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// Sums, by dimension.
pub struct Summary {
    from: u64,
    step: u64,
    workers: usize,
    /// Workers that have not ended.
    pub working: usize,
    tallies: [Tally; 2],
    /// Sums over histories, so their order does not matter.
    checksums: [u64; 2],
    /// Histories with mismatches.
    pub wrong: Vec<u64>,
    running: Vec<(u64, Instant)>,
    slowest: (Duration, u64),
}

impl Summary {
    pub fn new(from: u64, step: u64, workers: usize) -> Self {
        Summary {
            from,
            step,
            workers,
            working: workers,
            tallies: [Tally::default(); 2],
            checksums: [0; 2],
            wrong: Vec::new(),
            running: Vec::new(),
            slowest: (Duration::ZERO, 0),
        }
    }

    pub fn begin(&mut self, seed: u64) {
        self.running.push((seed, Instant::now()));
    }

    /// A history has ended, with a mismatch if there is no outcome.
    pub fn end(&mut self, seed: u64, outcome: Option<Outcome>) {
        let at = self.running.iter().position(|&(running, _)| running == seed).expect("it was running");
        let (_, start) = self.running.swap_remove(at);
        self.slowest = self.slowest.max((start.elapsed(), seed));
        let k = dimension_of(seed) - 2;
        let recorded = usize::try_from(seed).ok().and_then(|seed| RECORDED.get(seed));
        match outcome {
            Some(Outcome { tally, checksum }) => {
                self.tallies[k].add(&tally);
                self.checksums[k] = self.checksums[k].wrapping_add(mixed(checksum ^ mixed(seed)));
                if recorded.is_none_or(|&recorded| recorded == checksum) {
                    return;
                }
                eprintln!("seed {seed}: the checksum {checksum:#018x} is not the recorded one");
            }
            None => self.tallies[k].histories += 1,
        }
        self.tallies[k].mismatches += 1;
        self.wrong.push(seed);
    }

    fn done(&self) -> u64 {
        self.tallies.iter().map(|tally| tally.histories).sum()
    }

    /// Of now, in one line.
    pub fn line(&self, elapsed: Duration) -> String {
        let mut line = format!("{:6.1} min", elapsed.as_secs_f64() / 60.0);
        for (k, Tally { histories, commits, moves, comparisons, mismatches, .. }) in
            self.tallies.iter().enumerate()
        {
            let d = k + 2;
            write!(
                line,
                " | {d}D: {histories} histories, {commits} commits, {:.2e} moves, {comparisons} comparisons, \
                 {mismatches} mismatches",
                *moves as f64
            )
            .expect("a string takes all");
        }
        write!(line, " | {} MB", resident_megabytes()).expect("a string takes all");
        for &(seed, start) in &self.running {
            write!(line, ", seed {seed} for {:.0} s", start.elapsed().as_secs_f64())
                .expect("a string takes all");
        }
        line
    }

    /// In the end.
    pub fn report(&self, elapsed: Duration) -> String {
        let [plane, space] = self.tallies.map(|tally| tally.entries());
        let mut text = format!("{:28}{:>20}{:>20}\n", "", "2D", "3D");
        for ((name, in_plane), (_, in_space)) in plane.into_iter().zip(space) {
            text += &format!("{:28}{in_plane:>20}{in_space:>20}\n", name.replace('_', " "));
        }
        let per_hour = self.tallies.map(|tally| tally.moves as f64 * 3600.0 / elapsed.as_secs_f64());
        text += &format!("{:28}{:>20.3e}{:>20.3e}\n", "moves per hour", per_hour[0], per_hour[1]);
        let [plane, space] = self.checksums;
        text += &format!("{:28}{:>20}{:>20}\n", "checksum", format!("{plane:016x}"), format!("{space:016x}"));
        text += &format!(
            "seeds {} to {}, {} workers, {:.1} s, {} MB; the slowest was seed {} with {:.1} s\n",
            self.from,
            self.from + self.step * self.done().saturating_sub(1),
            self.workers,
            elapsed.as_secs_f64(),
            resident_megabytes(),
            self.slowest.1,
            self.slowest.0.as_secs_f64()
        );
        let (from, step, done) = (self.from, self.step, self.done());
        text += &format!("again: make soak ARGS=\"--from {from} --step {step} --histories {done}\"\n");
        if self.wrong.is_empty() {
            text += "no mismatch\n";
        }
        for seed in &self.wrong {
            text += &format!("mismatch: make soak ARGS=\"--seed {seed}\"\n");
        }
        text
    }

    /// A row for each dimension.
    pub fn csv(&self, elapsed: Duration) -> String {
        let mut csv = "dimension,from_seed,workers,seconds,checksum".to_string();
        self.tallies[0].entries().iter().for_each(|(name, _)| csv += &format!(",{name}"));
        for (k, tally) in self.tallies.iter().enumerate() {
            let (d, from, workers) = (k + 2, self.from, self.workers);
            csv += &format!("\n{d},{from},{workers},{:.0},{:016x}", elapsed.as_secs_f64(), self.checksums[k]);
            tally.entries().iter().for_each(|(_, value)| csv += &format!(",{value}"));
        }
        csv + "\n"
    }
}

/// Memory of the process, where the system says.
fn resident_megabytes() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm")
        .ok()
        .and_then(|text| text.split(' ').nth(1).and_then(|pages| pages.parse::<u64>().ok()));
    pages.map_or(0, |pages| pages / 256)
}
