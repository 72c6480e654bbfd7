//! docs/ABUSE.md: what has been tried, and what came of it.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::Trial;
use super::declarations::Declaration;

/// The kinds of abuse: as the program calls them, as the page does, and what they are.
const COLUMNS: [(&str, &str, &str); 15] = [
    ("null", "NULL", "a pointer is NULL"),
    ("misaligned", "misaligned", "a pointer is an odd address"),
    ("dimension", "dimension", "a dimension other than 2 and 3, or not one of the function"),
    ("id", "id", "an id, a cell or a corner that does not exist"),
    (
        "removed",
        "removed",
        "the id of a vertex that has been removed, or is to be, or is only to be inserted",
    ),
    ("nan", "NaN", "a number is NaN"),
    ("infinite", "infinite", "a number is infinite"),
    ("range", "range", "a coordinate is 2e57 or -2e57"),
    ("zero", "zero", "a count, a capacity or a size is 0"),
    ("huge", "huge", "a count, a capacity or a size is SIZE_MAX"),
    (
        "value",
        "value",
        "another value without a meaning: an option, a count that is not the right one, a path, data",
    ),
    (
        "overlap",
        "overlap",
        "an array that is written is at the place of another one, which is a duty of the program",
    ),
    (
        "callback",
        "callback",
        "called from the callback of a commit: on the same triangulation if it takes one",
    ),
    ("thread", "thread", "called from another thread, between calls and during a commit"),
    ("poisoned", "poisoned", "after an internal error (the flag that this sets is set by the test)"),
];

const UNCHECKED: &str = "\
## What the library cannot check

The last column has the pointers that are trusted. One that is neither NULL nor misaligned is taken to lead to what the
[header](../include/deldrift.h) says. These are duties of the program, and to neglect them is undefined behaviour:

- Arrays have as many entries as the counts and capacities say, in the dimension of the triangulation; positions in the
  plane are not enough for a triangulation in space.
- Handles come from the library and have not been destroyed. Views are not used after the next call that changes the
  triangulation. Strings end in a NUL, and `user_data` outlives the triangulation.
- Calls that take a triangulation as non-const run alone on it. A call during another one is refused where the library
  sees it, which is always so from a callback, and from another thread only if the first call has begun for certain.
- Callbacks return: no exception, no `longjmp`.
- Arrays that are written do not overlap with others of the same call. (The calls that try this leave the triangulation
  as it was, but nothing is said of what the arrays hold then.)
";

pub fn page(functions: &[Declaration], trials: &[Trial]) -> String {
    let (n_trials, n_functions) = (trials.len(), functions.len());
    let n_legal = trials.iter().filter(|trial| trial.status == "DELDRIFT_OK").count();
    let n_refused = n_trials - n_legal;
    let mut text = format!(
        "# Abuse\n\nWhat comes of wrong calls. The tests make {n_trials} calls of the {n_functions} functions of the \
         [header](../include/deldrift.h), in 2D\nand in 3D: {n_refused} wrong ones and {n_legal} that are legal, beside \
         them. A call that is refused gives a status that the header \
         names for the function and a message with the argument,\nthe index and the value, writes no output (but the \
         count of a buffer that is too small), and leaves the triangulation as\nit was: positions, cells in their \
         order, what is staged, sums, and all bytes of `deldrift_save`. The program is made from\nthe header by \
         [ffi-tests/abuse.rs](../ffi-tests/abuse.rs), so a new function without a row fails; it also runs under \
         valgrind\nand sanitizers. `make header` writes this page.\n\n## Kinds\n\n\
         | | what is wrong | calls | status, and a message |\n|---|---|--:|---|\n"
    );
    for (column, title, meaning) in COLUMNS {
        let of_kind: Vec<&Trial> = trials.iter().filter(|trial| trial.column == column).collect();
        let statuses: BTreeSet<&str> = of_kind.iter().map(|trial| trial.status.as_str()).collect();
        let shown = statuses.into_iter().map(|status| {
            let first = of_kind.iter().find(|trial| trial.status == status).expect("it has been given");
            match status {
                "DELDRIFT_OK" => format!("`{status}`, where the header allows it"),
                _ => format!("`{status}`: {}", shown(&first.message)),
            }
        });
        let shown = shown.collect::<Vec<_>>().join("<br>");
        let _ = writeln!(text, "| {title} | {meaning} | {} | {shown} |", of_kind.len());
    }
    text += "\n## Functions\n\nHow many calls were refused; after a plus sign, how many did what the header says, as \
             the argument is legal there.\n\n| function |";
    COLUMNS.iter().for_each(|(_, title, _)| text += &format!(" {title} |"));
    text += " trusted |\n|---|";
    text += &"--:|".repeat(COLUMNS.len());
    text += "---|\n";
    for function in functions {
        let _ = write!(text, "| `{}` |", function.name);
        for (column, _, _) in COLUMNS {
            let _ = write!(text, " {} |", counts(function, column, trials));
        }
        let pointers = function.parameters.iter().filter(|parameter| parameter.c_type.ends_with('*'));
        let pointers: Vec<String> = pointers.map(|parameter| format!("`{}`", parameter.name)).collect();
        let _ = writeln!(text, " {} |", pointers.join(", "));
    }
    text + "\n" + UNCHECKED
}

/// How many calls of a kind were refused, and how many were not.
fn counts(function: &Declaration, column: &str, trials: &[Trial]) -> String {
    let of_cell = |trial: &&Trial| trial.function == function.name && trial.column == column;
    let of_cell: Vec<&Trial> = trials.iter().filter(of_cell).collect();
    let n_legal = of_cell.iter().filter(|trial| trial.status == "DELDRIFT_OK").count();
    match (of_cell.len() - n_legal, n_legal) {
        (0, 0) => "".to_string(),
        (refused, 0) => refused.to_string(),
        (0, legal) => format!("+{legal}"),
        (refused, legal) => format!("{refused} +{legal}"),
    }
}

/// A message without the addresses in it, which are others in every run.
fn shown(message: &str) -> String {
    let mut parts = message.split("0x");
    let mut text = parts.next().unwrap_or_default().to_string();
    for part in parts {
        text += "0x...";
        text += part.trim_start_matches(|c: char| c.is_ascii_hexdigit());
    }
    format!("\"{}\"", text.replace('|', "\\|"))
}
