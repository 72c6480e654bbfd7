//! What a history has done, to be told with a mismatch.

use std::collections::VecDeque;

/// How many lines are told.
const TOLD: usize = 24;

/// The last lines of a history.
pub struct Log {
    seed: u64,
    name: String,
    lines: VecDeque<String>,
    /// Whether all are printed at once.
    is_loud: bool,
}

impl Log {
    /// That of a history, the name of which it begins with.
    pub fn new(seed: u64, name: String, is_loud: bool) -> Self {
        if is_loud {
            println!("{name}");
        }
        Log { seed, name, lines: VecDeque::new(), is_loud }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Enters what is to be done after so many commits.
    pub fn note(&mut self, commits: u64, what: String) {
        let line = format!("commit {commits}: {what}");
        if self.is_loud {
            println!("{line}");
        }
        self.lines.push_back(line);
        if self.lines.len() > TOLD {
            self.lines.pop_front();
        }
    }

    /// What to tell of a mismatch; `settings` follow the name.
    pub fn context(&self, settings: &str, what: &str) -> String {
        let lines: Vec<&str> = self.lines.iter().map(String::as_str).collect();
        let Log { seed, name, .. } = self;
        let told = lines.join("\n  ... ");
        format!("{name}{settings}\n  ... {told}\n  {what}\n  replay: make soak ARGS=\"--seed {seed}\"")
    }
}
