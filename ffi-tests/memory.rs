//! The programs under checkers of memory and of threads: slow, and the checkers are no part of Rust, so these tests run
//! only where they are asked for (`cargo test --test ffi -- --include-ignored`).

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{Linkage, build, command, fresh_folder, repository, sees_requests, sources, succeed};

#[test]
#[ignore = "needs valgrind"]
fn programs_are_clean_under_valgrind() {
    let folder = fresh_folder("valgrind");
    let suppressed = format!("--suppressions={}", repository("ffi-tests/valgrind.supp").display());
    for source in programs() {
        let linkage = if sees_requests(&source) { Linkage::Static } else { Linkage::Shared };
        let program = build(&source, &folder, linkage, &[]);
        let checks = [
            "--quiet",
            "--error-exitcode=99",
            "--leak-check=full",
            "--errors-for-leak-kinds=definite,possible",
        ];
        let mut valgrind = command("valgrind");
        valgrind.args(checks).arg(&suppressed).arg(program);
        succeed(with_share_of_faults(&mut valgrind, "0.03"));
    }
}

#[test]
#[ignore = "needs valgrind"]
fn threads_of_the_library_do_not_race() {
    let folder = fresh_folder("races");
    let source = repository("ffi-tests/c/parallel.c");
    let program = build(&source, &folder, Linkage::Shared, &[]);
    succeed(command("valgrind").args(["--quiet", "--tool=drd", "--error-exitcode=99"]).arg(program));
}

#[test]
#[ignore = "needs the sanitizers of the C compiler"]
fn programs_are_clean_under_address_and_undefined_behaviour_sanitizers() {
    let folder = fresh_folder("sanitizers");
    for source in programs() {
        let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"];
        let program = build(&source, &folder, Linkage::Static, &flags);
        let mut program = command(program);
        program.env("ASAN_OPTIONS", "detect_leaks=1:detect_stack_use_after_return=1");
        succeed(with_share_of_faults(&mut program, "0.5"));
    }
}

/// All but those that limit their own memory, which the checkers do not survive.
fn programs() -> Vec<PathBuf> {
    let all = [sources("ffi-tests/c", "c"), sources("ffi-tests/cpp", "cpp")].concat();
    let limits = |source: &Path| ["limits.c", "out_of_memory.c"].iter().any(|name| source.ends_with(name));
    all.into_iter().filter(|source| !limits(source)).collect()
}

/// Under a checker a program takes many times as long: one that has calls fail has so many fewer of them fail.
fn with_share_of_faults<'c>(program: &'c mut Command, share: &str) -> &'c mut Command {
    program.env("DELDRIFT_SOAK", share)
}
