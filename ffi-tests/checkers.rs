//! The checkers find what they are there for: each is given programs with one fault, under the flags that the other
//! programs run under, and has to name it; and one without a fault, which it has to let pass.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

use crate::coverage::exported_functions;
use crate::installation::exported_symbols;
use crate::memory::{SANITIZERS, under_drd, under_memcheck, under_sanitizers};
use crate::support::{Linkage, build, command, fresh_folder, headers, library_folder, repository, succeed};

/// Faults, and what a checker says of each.
type Faults = [(&'static str, &'static str)];

const FOR_SANITIZERS: &Faults = &[
    ("heap_overflow", "heap-buffer-overflow"),
    ("use_after_free", "heap-use-after-free"),
    ("leak", "detected memory leaks"),
    ("signed_overflow", "signed integer overflow"),
    ("misaligned_read", "misaligned address"),
    ("view_after_destruction", "heap-use-after-free"),
    ("view_too_far", "heap-buffer-overflow"),
    ("triangulation_not_destroyed", "detected memory leaks"),
];

const FOR_MEMCHECK: &Faults = &[
    ("heap_overflow", "Invalid write"),
    ("use_after_free", "Invalid read"),
    ("leak", "definitely lost"),
    ("uninitialised_read", "Conditional jump or move depends on uninitialised value"),
    ("view_after_destruction", "Invalid read"),
    ("triangulation_not_destroyed", "definitely lost"),
    ("buffer_shorter_than_its_capacity", "Invalid write"),
    ("positions_never_set", "Conditional jump or move depends on uninitialised value"),
];

const FOR_DRD: &Faults = &[("data_race", "Conflicting"), ("changes_at_the_same_time", "Conflicting")];

#[test]
#[ignore = "needs the sanitizers of the C compiler"]
fn sanitizers_find_planted_faults() {
    let program = build(&planted(), &fresh_folder("planted_sanitizers"), Linkage::Static, &SANITIZERS);
    all_are_found(FOR_SANITIZERS, || under_sanitizers(&program));
}

#[test]
#[ignore = "needs valgrind"]
fn memcheck_finds_planted_faults() {
    let program = build(&planted(), &fresh_folder("planted_memcheck"), Linkage::Shared, &[]);
    all_are_found(FOR_MEMCHECK, || under_memcheck(&program));
}

#[test]
#[ignore = "needs valgrind"]
fn drd_finds_planted_races() {
    let program = build(&planted(), &fresh_folder("planted_drd"), Linkage::Shared, &[]);
    all_are_found(FOR_DRD, || under_drd(&program));
}

#[test]
fn shared_library_exports_the_header_and_nothing_else() {
    let header = headers();
    let declared: BTreeSet<String> = exported_functions(&header).into_iter().map(str::to_string).collect();
    assert!(declared.len() > 40, "{declared:?}");
    let library = library_folder().join("libdeldrift.so");
    assert_eq!(exported_symbols(&library, Some("-D")), declared);

    // One that has a function more shows it.
    let planted = fresh_folder("planted_symbol").join("libplanted.so");
    let flags = ["-shared", "-fPIC", "-x", "c", "-", "-o"];
    let mut shell = command("sh");
    let compile =
        format!("echo 'int deldrift_planted(void) {{ return 1; }}' | cc {} \"$0\"", flags.join(" "));
    succeed(shell.args(["-ec", &compile]).arg(&planted));
    assert!(exported_symbols(&planted, Some("-D")).contains("deldrift_planted"));
}

#[test]
#[ignore = "needs Python 3.11"]
fn dependencies_are_accepted_and_planted_ones_are_not() {
    let said = succeed(command(repository(".ci/dependencies")).arg("--prove"));
    assert!(said.ends_with("9 faults planted, 0 missed\n"), "{said}");
}

#[test]
#[ignore = "needs Python 3.11, git and cargo"]
fn the_bill_of_materials_has_what_is_linked() {
    let bill = succeed(&mut command(repository("release/sbom")));
    for linked in ["deldrift", "crc32fast", "cfg-if", "libc", "robust"] {
        assert!(bill.contains(&format!("\"purl\": \"pkg:cargo/{linked}@")), "{linked} is not in {bill}");
    }
    // Each is told in the list and in the relations of the whole.
    assert_eq!(bill.matches("\"purl\"").count(), 5, "{bill}");
    assert_eq!(bill, succeed(&mut command(repository("release/sbom"))));
}

#[test]
#[ignore = "needs Python 3.11"]
fn sentences_say_what_the_records_say() {
    let said = succeed(&mut command(repository(".ci/figures")));
    assert!(said.ends_with(" sentences, 0 wrong\n"), "{said}");
}

#[test]
#[ignore = "needs Python 3.11 and git"]
fn records_say_where_they_come_from() {
    let said = succeed(command(repository(".ci/records")).arg("--prove"));
    assert!(said.ends_with("4 faults planted, 0 missed\n"), "{said}");
}

fn planted() -> PathBuf {
    repository("ffi-tests/planted/planted.c")
}

fn all_are_found(faults: &Faults, checker: impl Fn() -> Command) {
    succeed(checker().arg("none"));
    for (fault, wanted) in faults {
        let outcome = checker().arg(fault).output().expect("a checker runs");
        let said = String::from_utf8_lossy(&outcome.stderr);
        assert!(!outcome.status.success() && said.contains(wanted), "{fault}, {}: {said}", outcome.status);
    }
}
