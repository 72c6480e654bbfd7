//! The programs under checkers of memory and of threads: slow, and the checkers are no part of Rust, so these tests run
//! only where they are asked for (`cargo test --test ffi -- --include-ignored`).

use std::path::PathBuf;

use crate::support::{Linkage, build, command, fresh_folder, repository, sources, succeed};

#[test]
#[ignore = "needs valgrind"]
fn programs_are_clean_under_valgrind() {
    let folder = fresh_folder("valgrind");
    let suppressed = format!("--suppressions={}", repository("ffi-tests/valgrind.supp").display());
    for source in programs() {
        let program = build(&source, &folder, Linkage::Shared, &[]);
        let checks = [
            "--quiet",
            "--error-exitcode=99",
            "--leak-check=full",
            "--errors-for-leak-kinds=definite,possible",
        ];
        succeed(command("valgrind").args(checks).arg(&suppressed).arg(program));
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
        succeed(command(program).env("ASAN_OPTIONS", "detect_leaks=1:detect_stack_use_after_return=1"));
    }
}

/// All but the one that limits its own memory, which the checkers do not survive.
fn programs() -> Vec<PathBuf> {
    let all = [sources("ffi-tests/c", "c"), sources("ffi-tests/cpp", "cpp")].concat();
    all.into_iter().filter(|source| !source.ends_with("out_of_memory.c")).collect()
}
