//! The installed static library beside another one that is written in Rust, by every linker that is there, in either
//! order: each has a standard library inside, and what they have in common must not be mistaken for one another's.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use crate::installation::{install, library_files};
use crate::support::{SYSTEM_LIBRARIES, command, compiler, fresh_folder, repository, skipped, succeed};

const LINKERS: [&str; 4] = ["bfd", "gold", "lld", "mold"];

/// Flags by which the other library is made: one object for each part of the standard library, or one for all.
const OTHERS: [(&str, &[&str]); 2] =
    [("plain", &["-O"]), ("whole", &["-O", "-Clto=fat", "-Cembed-bitcode=yes"])];

/// What the two are linked to, and by which flags.
const KINDS: [(&str, &[&str]); 4] = [
    ("pie", &["-fPIE", "-pie"]),
    ("no-pie", &["-fno-pie", "-no-pie"]),
    ("swept", &["-fPIE", "-pie", "-Wl,--gc-sections"]),
    ("shared", &["-fPIC", "-shared"]),
];

#[test]
#[ignore = "needs CMake"]
fn static_library_is_linked_beside_another_one_in_rust() {
    let folder = fresh_folder("beside");
    let deldrift = library_files(&install(&folder)).join("libdeldrift.a");
    let linkers = LINKERS.into_iter().filter(|linker| is_there(linker)).collect::<Vec<_>>();
    assert!(linkers.contains(&"bfd"), "{linkers:?}");
    let others = OTHERS.map(|(name, flags)| make_other(&folder, name, flags));
    // Each linker links each kind, and each of both is linked in either order and beside either library.
    for (i, linker) in linkers.iter().enumerate() {
        for (j, (kind, flags)) in KINDS.into_iter().enumerate() {
            let other = &others[(i + j) / 2 % 2];
            let libraries = if (i + j) % 2 == 0 { [&deldrift, other] } else { [other, &deldrift] };
            println!("{linker}, {kind}, {libraries:?}");
            let linker = format!("-fuse-ld={linker}");
            let flags = [flags, &[linker.as_str()]].concat();
            let program = link(&folder, kind == "shared", &flags, &libraries.map(PathBuf::as_path));
            succeed(&mut command(program));
        }
    }
}

/// Whether a linker is installed; says so if it is not.
fn is_there(linker: &str) -> bool {
    let path = env::var_os("PATH").expect("there is a search path");
    let found = env::split_paths(&path).any(|folder| folder.join(format!("ld.{linker}")).exists());
    if !found {
        skipped(&format!("beside, with {linker}"), &format!("ld.{linker} is not installed"));
    }
    found
}

fn make_other(folder: &Path, name: &str, flags: &[&str]) -> PathBuf {
    let library = folder.join(format!("libother_{name}.a"));
    let mut rustc = Command::new(env::var_os("RUSTC").unwrap_or("rustc".into()));
    rustc.args(["--edition=2024", "--crate-type=staticlib"]).args(flags);
    succeed(rustc.arg(repository("ffi-tests/beside/other.rs")).arg("-o").arg(&library));
    library
}

/// A program with both libraries in it, or in a shared library of its own.
fn link(folder: &Path, is_shared: bool, flags: &[&str], libraries: &[&Path; 2]) -> PathBuf {
    let (source, main) = (repository("ffi-tests/beside/program.c"), repository("ffi-tests/beside/main.c"));
    let (program, shared) = (folder.join("program"), folder.join("libboth.so"));
    for file in [&program, &shared] {
        let _ = fs::remove_file(file);
    }
    let mut both = compiler(&source);
    both.args(flags).arg(source);
    if !is_shared {
        both.arg(&main);
    }
    both.args(libraries).args(SYSTEM_LIBRARIES).arg("-o");
    succeed(both.arg(if is_shared { &shared } else { &program }));
    if is_shared {
        let run_path = format!("-Wl,-rpath,{}", folder.display());
        succeed(compiler(&main).arg(&main).arg(&shared).arg(run_path).arg("-o").arg(&program));
    }
    program
}
