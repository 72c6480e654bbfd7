//! The abuse table: every function of the header with wrong arguments of every kind, from callbacks, from other threads
//! and on a poisoned triangulation. What must come of it is the status that the header names, a message with the
//! argument, the index and the value, no output, and the triangulation as it was.
//!
//! The functions and their parameters are those of the header, and `abuse/roles.rs` tells what each parameter is for;
//! `abuse/rows.rs` has a call of each function that is all right. From these `abuse/cases.rs` makes the wrong calls, a
//! program in C; `abuse/harness.h` is what that is made around.
//! docs/ABUSE.md shows what has been tried.

#[path = "abuse/cases.rs"]
pub mod cases;
#[path = "abuse/declarations.rs"]
pub mod declarations;
#[path = "abuse/page.rs"]
mod page;
#[path = "abuse/roles.rs"]
mod roles;
#[path = "abuse/rows.rs"]
pub mod rows;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{Linkage, build, command, fresh_folder, repository, succeed, text_of};
use declarations::{Declaration, declarations, statuses};

const PAGE: &str = "docs/ABUSE.md";

/// One call that has been made, as the program tells.
struct Trial {
    function: String,
    column: String,
    status: String,
    message: String,
}

#[test]
fn every_function_has_a_row() {
    let declared: BTreeSet<String> = declarations().into_iter().map(|function| function.name).collect();
    let rows: BTreeSet<String> = rows::ROWS.iter().map(|row| row.function.to_string()).collect();
    assert!(declared.len() > 60, "{declared:?}");
    assert_eq!(rows, declared, "the rows in ffi-tests/abuse/rows.rs are not the functions of the header");
}

/// With `DELDRIFT_UPDATE_HEADER=1` the page is written instead.
#[test]
fn abuse_does_what_the_header_says() {
    let folder = fresh_folder("abuse");
    let program = build_program(&folder, Linkage::Shared, &[]);
    let trials = trials_of(&succeed(&mut command(&program)));
    let functions = declarations();
    assert!(trials.len() > 1000, "{}", trials.len());
    statuses_are_documented(&functions, &trials);
    let made = page::page(&functions, &trials);
    if std::env::var_os("DELDRIFT_UPDATE_HEADER").is_some_and(|value| value == "1") {
        fs::write(repository(PAGE), &made).expect("a file can be written");
    }
    assert!(made == text_of(PAGE), "{PAGE} is stale: run make header and commit it");
}

/// The program, for checkers of memory too.
pub fn build_program(folder: &Path, linkage: Linkage, flags: &[&str]) -> PathBuf {
    let source = folder.join("abuse.c");
    fs::write(&source, cases::program(&declarations())).expect("a source can be written");
    let includes = ["ffi-tests/abuse", "ffi-tests/c"].map(|path| format!("-I{}", repository(path).display()));
    let flags: Vec<&str> = includes.iter().map(String::as_str).chain(flags.iter().copied()).collect();
    build(&source, folder, linkage, &flags)
}

fn trials_of(said: &str) -> Vec<Trial> {
    let trial = |line: &str| {
        let parts: Vec<String> = line.split('\t').map(str::to_string).collect();
        let parts: [String; 7] = parts.try_into().unwrap_or_else(|_| panic!("{line}"));
        let [_dimension, function, _argument, column, _given, status, message] = parts;
        Trial { function, column, status, message }
    };
    said.lines().map(trial).collect()
}

/// Every status that a function has given is one that its documentation names.
fn statuses_are_documented(functions: &[Declaration], trials: &[Trial]) {
    let by_name: BTreeMap<&str, BTreeSet<String>> =
        functions.iter().map(|function| (function.name.as_str(), function.documented_statuses())).collect();
    let undocumented: BTreeSet<(&str, &str)> = trials
        .iter()
        .filter(|trial| trial.status != "DELDRIFT_OK")
        .map(|trial| (trial.function.as_str(), trial.status.as_str()))
        .filter(|(function, status)| !by_name[function].contains(*status))
        .collect();
    // deldrift_destroy gives no status: what would be one is said by deldrift_last_error.
    let undocumented: Vec<_> =
        undocumented.into_iter().filter(|(name, _)| *name != "deldrift_destroy").collect();
    assert!(undocumented.is_empty(), "statuses that the header does not name: {undocumented:?}");
    assert!(trials.iter().all(|trial| statuses().contains(&trial.status)));
}
