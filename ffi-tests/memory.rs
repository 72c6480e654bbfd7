//! The programs under checkers of memory and of threads: slow, and the checkers are no part of Rust, so these tests run
//! only where they are asked for (`cargo test --test ffi -- --include-ignored`).

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::abuse;
use crate::support::{Linkage, build, command, fresh_folder, repository, sees_requests, sources, succeed};

/// What a program is compiled with for the sanitizers.
pub const SANITIZERS: [&str; 3] =
    ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"];

/// A program under the checker of memory, which ends with exit code 99 where it finds a fault.
pub fn under_memcheck(program: impl AsRef<OsStr>) -> Command {
    let suppressed = format!("--suppressions={}", repository("ffi-tests/valgrind.supp").display());
    let checks =
        ["--quiet", "--error-exitcode=99", "--leak-check=full", "--errors-for-leak-kinds=definite,possible"];
    let mut valgrind = command("valgrind");
    valgrind.args(checks).arg(&suppressed).arg(program);
    valgrind
}

/// A program under the checker of threads, which ends likewise.
pub fn under_drd(program: impl AsRef<OsStr>) -> Command {
    let mut valgrind = command("valgrind");
    valgrind.args(["--quiet", "--tool=drd", "--error-exitcode=99"]).arg(program);
    valgrind
}

/// A program compiled with the sanitizers.
pub fn under_sanitizers(program: impl AsRef<OsStr>) -> Command {
    let mut program = command(program);
    program.env("ASAN_OPTIONS", "detect_leaks=1:detect_stack_use_after_return=1");
    program
}

/// Programs in which the library uses several threads. Not threads.c: its own threads read one triangulation, through
/// the standard library's locks, of which drd knows nothing.
const WITH_THREADS: [&str; 3] = ["changes.c", "options.c", "parallel.c"];

#[test]
#[ignore = "needs valgrind"]
fn programs_are_clean_under_valgrind() {
    let folder = fresh_folder("valgrind");
    for source in programs() {
        // It knows no environment but the default one. Programs with CGAL's names call what others call; what is the header's in
        // these the sanitizers look at.
        let is_for_cgal = source.file_name().is_some_and(|name| name.to_string_lossy().starts_with("cgal"));
        if source.ends_with("environment.c") || is_for_cgal {
            continue;
        }
        let linkage = if sees_requests(&source) { Linkage::Static } else { Linkage::Shared };
        let program = build(&source, &folder, linkage, &[]);
        succeed(with_share_of_faults(&mut under_memcheck(program), "0.03"));
    }
    succeed(&mut under_memcheck(abuse::build_program(&folder, Linkage::Shared, &[])));
}

#[test]
#[ignore = "needs valgrind"]
fn threads_of_the_library_do_not_race() {
    let folder = fresh_folder("races");
    for source in WITH_THREADS.map(|name| repository(&format!("ffi-tests/c/{name}"))) {
        succeed(&mut under_drd(build(&source, &folder, Linkage::Shared, &[])));
    }
}

#[test]
#[ignore = "needs the sanitizers of the C compiler"]
fn programs_are_clean_under_address_and_undefined_behaviour_sanitizers() {
    let folder = fresh_folder("sanitizers");
    for source in programs() {
        let program = build(&source, &folder, Linkage::Static, &SANITIZERS);
        succeed(with_share_of_faults(&mut under_sanitizers(program), "0.5"));
    }
    succeed(&mut under_sanitizers(abuse::build_program(&folder, Linkage::Static, &SANITIZERS)));
}

/// All but those that limit their own memory, or their stack, which the checkers do not survive.
fn programs() -> Vec<PathBuf> {
    let all = [sources("ffi-tests/c", "c"), sources("ffi-tests/cpp", "cpp")].concat();
    let limits =
        |source: &Path| ["limits.c", "out_of_memory.c", "stack.c"].iter().any(|name| source.ends_with(name));
    all.into_iter().filter(|source| !limits(source)).collect()
}

/// Under a checker a program takes many times as long: one that has calls fail has so many fewer of them fail.
fn with_share_of_faults<'c>(program: &'c mut Command, share: &str) -> &'c mut Command {
    program.env("DELDRIFT_SOAK", share)
}
