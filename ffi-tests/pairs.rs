//! The walker: every call that takes a triangulation before every other one, on triangulations in many states; and every two
//! calls that only read at the same time.
//!
//! The calls are those of `abuse/rows.rs`, of which each function of the header must have one, and those of `pairs/rows.rs`;
//! `pairs/states.h` has the states. From these two programs in C are made. `pairs/walker.h` is the walk: call A, then call B, on
//! the triangulation itself, on clones and on copies that have been saved and loaded, before A and between the two. What must
//! come of it: statuses that the header names, the same answers, the same bytes; after a refusal, and after what only reads, not
//! a byte that differs; and the cells of a fresh build. `pairs/meeting.h` has threads call at the same time.

#[path = "pairs/rows.rs"]
mod rows;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::abuse::cases::call;
use crate::abuse::declarations::{Declaration, declarations, statuses};
use crate::abuse::rows::ROWS;
use crate::support::{Linkage, build, command, fresh_folder, repository, succeed, text_of};

/// Functions of which a call is one of a triangulation, and what is called, of all rows.
fn calls(functions: &[Declaration]) -> Vec<(&Declaration, Vec<&'static str>)> {
    let rows = ROWS.iter().map(|row| (row.function, row.arguments)).chain(rows::MORE.iter().copied());
    let declared = |name| functions.iter().find(|function| function.name == name).expect("it is declared");
    let all = rows.map(|(name, arguments)| (declared(name), arguments.to_vec()));
    all.filter(|(function, _)| function.takes_t()).collect()
}

/// The statuses that the header names for a function: also where it names another function, or all that give one while a timestamp
/// is prepared.
fn documented_statuses(function: &Declaration, all: &[Declaration]) -> BTreeSet<String> {
    let others = all.iter().filter(|other| function.errors().contains(&format!("those of {}", other.name)));
    let mut found: BTreeSet<String> = others.flat_map(Declaration::documented_statuses).collect();
    found.extend(function.documented_statuses());
    let prepared = all.iter().filter_map(Declaration::refused_while_prepared);
    if prepared.into_iter().any(|list| list.split([' ', ',', '.']).any(|word| word == function.name)) {
        found.insert("DELDRIFT_PREPARED".to_string());
    }
    found
}

/// The source of a program around one of the headers of `pairs`.
fn program(header: &str) -> String {
    let names = statuses();
    assert!(names.len() <= 64, "statuses are bits of a number");
    let listed = names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let mut text =
        format!("#define STATUS_NAMES {listed}\n#include \"{header}\"\n\nconst call calls[] = {{\n");
    let mut cases = String::from("deldrift_status do_call(size_t k) {\n    switch (k) {\n");
    let functions = declarations();
    for (k, (function, arguments)) in calls(&functions).iter().enumerate() {
        let documented = documented_statuses(function, &functions);
        let bit = |at: usize| u64::from(at == 0 || documented.contains(&names[at])) << at;
        let bits: u64 = (0..names.len()).map(bit).sum();
        let changes = function.changes_t() && function.name != "deldrift_destroy";
        let writes = arguments.contains(&"path");
        let code = call(function, arguments);
        let said = code.replace('"', "'").replace("deldrift_", "");
        let _ = writeln!(text, "    {{\"{said}\", \"{}\", {changes}, {writes}, {bits:#x}u}},", function.name);
        let _ = writeln!(cases, "        case {k}: return {code};");
    }
    text + "};\nconst size_t n_calls = sizeof calls / sizeof *calls;\n\n"
        + &cases
        + "        default: return DELDRIFT_INTERNAL_ERROR;\n    }\n}\n"
}

/// The program of a header of `pairs`, for a test of this name.
fn built(header: &str, test: &str) -> PathBuf {
    let folder = fresh_folder(&format!("pairs-{test}"));
    let source = folder.join(format!("{header}.c"));
    fs::write(&source, program(&format!("{header}.h"))).expect("a source can be written");
    let includes = ["ffi-tests/pairs", "ffi-tests/abuse", "ffi-tests/c"]
        .map(|path| format!("-I{}", repository(path).display()));
    let flags: Vec<&str> = includes.iter().map(String::as_str).collect();
    build(&source, &folder, Linkage::Shared, &flags)
}

/// How many states, calls and pairs a walk has been.
fn walked(mut command: Command) -> [usize; 3] {
    let said = succeed(&mut command);
    let numbers: Vec<usize> = said.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    numbers.try_into().unwrap_or_else(|_| panic!("{said}"))
}

fn in_dimension(program: &Path, dimension: &str) -> Command {
    let mut command = command(program);
    command.arg(dimension);
    command
}

/// Both dimensions at the same time; the sums of what both say.
fn in_both(program: &Path, prepare: impl Fn(&mut Command) + Sync) -> [[usize; 3]; 2] {
    std::thread::scope(|scope| {
        let walks = ["2", "3"].map(|dimension| {
            let mut command = in_dimension(program, dimension);
            prepare(&mut command);
            scope.spawn(move || walked(command))
        });
        walks.map(|walk| walk.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

/// With separators of thousands, as pages have numbers.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|group| std::str::from_utf8(group).unwrap()).collect();
    groups.join(",")
}

#[test]
fn every_function_of_a_triangulation_is_walked() {
    let functions = declarations();
    let walked: BTreeSet<&str> =
        calls(&functions).iter().map(|(function, _)| function.name.as_str()).collect();
    let all: BTreeSet<&str> = functions
        .iter()
        .filter(|function| function.takes_t())
        .map(|function| function.name.as_str())
        .collect();
    assert_eq!(walked, all);
}

/// docs/GUARANTEES.md says how much has been walked.
#[test]
fn every_two_calls_do_what_they_do_alone() {
    let program = built("walker", "walker");
    let [[in_plane, n_calls, n_in_plane], [in_space, _, n_in_space]] = in_both(&program, |_| ());
    let said = format!(
        "all ordered pairs of {n_calls} calls in {in_plane} states of the plane and {in_space} in space, {} in all",
        grouped(n_in_plane + n_in_space)
    );
    assert!(text_of("docs/GUARANTEES.md").contains(&said), "docs/GUARANTEES.md does not say: {said}");
}

#[test]
fn every_two_calls_do_so_in_scalar_code() {
    let program = built("walker", "scalar");
    let [[n_states, ..], _] = in_both(&program, |command| {
        command.env("DELDRIFT_SCALAR", "1").arg("12");
    });
    assert!(n_states > 3);
}

#[test]
fn calls_that_read_give_the_same_at_the_same_time() {
    let [[in_plane, ..], [in_space, ..]] = in_both(&built("meeting", "meeting"), |_| ());
    assert!(in_plane > 3 && in_space > 0);
}
