//! The programs under memory checkers: slow, and the checkers are no part of Rust, so these tests run
//! only where they are asked for (`cargo test --test ffi -- --include-ignored`).

use std::path::PathBuf;

use crate::support::{Linkage, build, command, fresh_folder, sources, succeed};

#[test]
#[ignore = "needs valgrind"]
fn programs_are_clean_under_valgrind() {
    let folder = fresh_folder("valgrind");
    for source in programs() {
        let program = build(&source, &folder, Linkage::Shared, &[]);
        let checks = [
            "--quiet",
            "--error-exitcode=99",
            "--leak-check=full",
            "--errors-for-leak-kinds=definite,possible",
        ];
        succeed(command("valgrind").args(checks).arg(program));
    }
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
