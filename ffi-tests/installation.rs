//! An installed deldrift, found by programs of someone else's through CMake and through pkg-config. Needs
//! both, so it runs only where it is asked for (`cargo test --test ffi -- --include-ignored`).

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{command, compiler, fresh_folder, library_folder, repository, succeed};

#[test]
#[ignore = "needs CMake and pkg-config"]
fn installed_library_is_found() {
    let folder = fresh_folder("installation");
    let prefix = install(&folder);
    let libraries = library_files(&prefix);
    programs_find_it_through_cmake(&folder, &prefix);
    shared_program_finds_it_through_pkg_config(&folder, &libraries);
    static_program_finds_it_through_pkg_config(&folder, &libraries);
}

/// What `make install` does, with the libraries that this test was built with; the prefix.
fn install(folder: &Path) -> PathBuf {
    let (prefix, build) = (folder.join("prefix"), folder.join("build"));
    let given = format!("-DDELDRIFT_LIBRARY_DIR={}", library_folder().display());
    succeed(cmake_configure(&repository("."), &build, &prefix).arg(given));
    succeed(command("cmake").arg("--build").arg(&build));
    succeed(command("cmake").arg("--install").arg(&build));
    prefix
}

fn cmake_configure(source: &Path, build: &Path, prefix: &Path) -> Command {
    let mut configure = command("cmake");
    configure.arg("-S").arg(source).arg("-B").arg(build);
    configure.arg(format!("-DCMAKE_INSTALL_PREFIX={}", prefix.display()));
    configure
}

/// The folder of the libraries, under all the names that they should have.
fn library_files(prefix: &Path) -> PathBuf {
    let mut folders = ["lib", "lib64"].iter().map(|name| prefix.join(name));
    let folder = folders.find(|folder| folder.is_dir()).expect("libraries are installed");
    let file = folder.join(format!("libdeldrift.so.{}", env!("CARGO_PKG_VERSION")));
    assert!(file.is_file() && !file.is_symlink() && folder.join("libdeldrift.a").is_file());
    let link = fs::read_link(folder.join("libdeldrift.so")).expect("the name for the linker is a link");
    assert_eq!(folder.join(link), file);
    folder
}

fn programs_find_it_through_cmake(folder: &Path, prefix: &Path) {
    let build = folder.join("consumers");
    let found = format!("-DCMAKE_PREFIX_PATH={}", prefix.display());
    succeed(cmake_configure(&repository("ffi-tests/consumers"), &build, prefix).arg(found));
    succeed(command("cmake").arg("--build").arg(&build));
    for program in ["c_program", "cpp_program", "static_program"] {
        assert!(succeed(&mut command(build.join(program))).contains("triangle"));
    }
}

fn shared_program_finds_it_through_pkg_config(folder: &Path, libraries: &Path) {
    let flags = succeed(pkg_config(libraries).args(["--cflags", "--libs"]));
    let program = build_consumer(folder, &flags);
    succeed(command(program).env("LD_LIBRARY_PATH", libraries));
}

fn static_program_finds_it_through_pkg_config(folder: &Path, libraries: &Path) {
    let flags = succeed(pkg_config(libraries).args(["--cflags", "--libs", "--static"]));
    // Of two libraries with the same name the linker takes the shared one, unless it is told the file.
    let program = build_consumer(folder, &flags.replace("-ldeldrift", "-l:libdeldrift.a"));
    succeed(&mut command(program));
}

fn pkg_config(libraries: &Path) -> Command {
    let mut question = command("pkg-config");
    question.env("PKG_CONFIG_PATH", libraries.join("pkgconfig")).arg("deldrift");
    question
}

fn build_consumer(folder: &Path, flags: &str) -> PathBuf {
    let source = repository("ffi-tests/consumers/lloyd.cpp");
    let program = folder.join("pkg_config_program");
    succeed(compiler(&source).arg(&source).arg("-o").arg(&program).args(flags.split_whitespace()));
    program
}
