//! Compiling and running programs.

use std::ffi::OsStr;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::{env, fs};

pub use crate::files::{repository, text_of};
use crate::{algorithms, header};

/// What the static library needs of the system, as `rustc --print native-static-libs` says.
pub const SYSTEM_LIBRARIES: [&str; 5] = ["-lutil", "-lrt", "-lpthread", "-lm", "-ldl"];

/// Functions of the system in whose place `c/requests.h` has its own.
const REPLACED: [&str; 9] = [
    "malloc",
    "calloc",
    "realloc",
    "posix_memalign",
    "aligned_alloc",
    "free",
    "pthread_create",
    "write",
    "writev",
];

/// The texts of the headers that declare functions for C, one after the other.
pub fn headers() -> String {
    header::paths().map(text_of).collect()
}

/// The programs in a folder, by file name, in alphabetical order.
pub fn sources(folder: &str, extension: &str) -> Vec<PathBuf> {
    let mut sources: Vec<PathBuf> = fs::read_dir(repository(folder))
        .unwrap_or_else(|error| panic!("{folder}: {error}"))
        .map(|entry| entry.expect("a folder can be listed to its end").path())
        .filter(|path| path.extension().is_some_and(|given| given == extension))
        .collect();
    assert!(!sources.is_empty(), "{folder} has no program");
    sources.sort();
    sources
}

/// An empty folder for what a test makes.
pub fn fresh_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    folder
}

/// The folder with the libraries: the one of this executable, or the one above it, wherever cargo has
/// put them along with the test.
pub fn library_folder() -> PathBuf {
    let executable = env::current_exe().expect("a test knows its own path");
    let folders: Vec<&Path> = executable.ancestors().skip(1).take(2).collect();
    let found = folders.iter().find(|folder| {
        ["libdeldrift.so", "libdeldrift.a"].iter().all(|library| folder.join(library).exists())
    });
    found.unwrap_or_else(|| panic!("no libdeldrift.so with libdeldrift.a in {folders:?}")).to_path_buf()
}

/// Which library a program is linked with.
#[derive(Clone, Copy)]
pub enum Linkage {
    Shared,
    Static,
}

impl Linkage {
    pub fn name(self) -> &'static str {
        match self {
            Linkage::Shared => "shared",
            Linkage::Static => "static",
        }
    }
}

/// Whether a program sees what the library asks the system for. It must be linked with the static one.
pub fn sees_requests(source: &Path) -> bool {
    ["faults.c", "memory_bytes.c"].iter().any(|name| source.ends_with(name))
}

/// Whether a program loads the library itself. It knows its path as `LIBRARY`, and is linked with neither.
fn loads_the_library(source: &Path) -> bool {
    source.ends_with("dlclose.c")
}

/// The compiler for a source, with the project's warnings as errors and the headers in reach.
pub fn compiler(source: &Path) -> Command {
    static HOST: OnceLock<String> = OnceLock::new();
    let host = HOST.get_or_init(host_triple);
    let is_cpp = source.extension().is_some_and(|extension| extension == "cpp");
    let tool = cc::Build::new()
        .cargo_metadata(false)
        .cpp(is_cpp)
        .host(host)
        .target(host)
        .opt_level(1)
        .debug(true)
        .out_dir(env!("CARGO_TARGET_TMPDIR"))
        .get_compiler();
    let mut command = tool.to_command();
    command.arg(if is_cpp { "-std=c++17" } else { "-std=c11" });
    command.args(["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-pthread", "-I"]).arg(repository("include"));
    command.args(algorithms::definitions());
    command
}

fn stem(source: &Path) -> &str {
    source.file_stem().and_then(OsStr::to_str).expect("a source has a name")
}

/// The object file of a program, compiled with further flags: once for all tests that link it, in whatever process, as long as what
/// the compiler reads is the same.
fn object(source: &Path, flags: &[&str]) -> PathBuf {
    let mut preprocess = compiler(source);
    preprocess.args(flags).arg("-E").arg(source);
    let outcome = preprocess.output().unwrap_or_else(|error| panic!("{preprocess:?}: {error}"));
    assert!(outcome.status.success(), "{preprocess:?}: {}", all_of(&outcome));
    let mut hasher = DefaultHasher::new();
    (&outcome.stdout, format!("{preprocess:?}")).hash(&mut hasher);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("objects");
    let object = folder.join(format!("{}-{:016x}.o", stem(source), hasher.finish()));
    if !object.exists() {
        fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        // Whole when it gets its name: two tests may make it at the same time.
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let unfinished = folder.join(format!("{}-{}-{number}.o", stem(source), std::process::id()));
        succeed(compiler(source).args(flags).arg("-c").arg(source).arg("-o").arg(&unfinished));
        fs::rename(&unfinished, &object).unwrap_or_else(|error| panic!("{}: {error}", object.display()));
    }
    object
}

/// Compiles and links one program with further flags; its path.
pub fn build(source: &Path, folder: &Path, linkage: Linkage, flags: &[&str]) -> PathBuf {
    let program = folder.join(stem(source));
    let libraries = library_folder();
    let mut command = compiler(source);
    let is_for_linker = |flag: &&str| flag.starts_with("-l") || flag.starts_with("-Wl,");
    let is_object_enough = !loads_the_library(source) && !flags.iter().any(is_for_linker);
    let input = if is_object_enough { object(source, flags) } else { source.to_path_buf() };
    command.args(flags).arg(input).arg("-o").arg(&program);
    if sees_requests(source) {
        assert!(matches!(linkage, Linkage::Static), "a shared library has requests of its own");
        command.args(REPLACED.map(|name| format!("-Wl,--wrap={name}")));
    }
    match linkage {
        _ if loads_the_library(source) => {
            let path = libraries.join("libdeldrift.so");
            command.arg(format!("-DLIBRARY=\"{}\"", path.display())).arg("-ldl");
        }
        Linkage::Shared => {
            let run_path = format!("-Wl,-rpath,{}", libraries.display());
            command.arg(libraries.join("libdeldrift.so")).arg(run_path).arg("-lm");
        }
        Linkage::Static => {
            command.arg(libraries.join("libdeldrift.a")).args(SYSTEM_LIBRARIES);
        }
    }
    succeed(&mut command);
    program
}

/// A command that finds libraries as it would outside of cargo, which for its tests puts folders first
/// where an older build of the library may lie. Where the library is asked for several threads it uses them all.
pub fn command(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    command.env_remove("LD_LIBRARY_PATH").env("DELDRIFT_ALL_THREADS", "1");
    command
}

/// Says what cannot be tested here, and why: `make test` repeats such lines at its end. Not by a macro, whose text is not
/// shown where the test passes.
pub fn skipped(what: &str, reason: &str) {
    let text = format!("SKIPPED {what}: {reason}\n");
    io::stderr().write_all(text.as_bytes()).expect("it can be told");
}

/// Runs a command that must end with exit code 0; its standard output. Everything it says is shown
/// when it fails.
pub fn succeed(command: &mut Command) -> String {
    let outcome = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(outcome.status.success(), "{command:?}: {}\n{}", outcome.status, all_of(&outcome));
    String::from_utf8_lossy(&outcome.stdout).into_owned()
}

fn all_of(outcome: &Output) -> String {
    String::from_utf8_lossy(&[outcome.stdout.as_slice(), outcome.stderr.as_slice()].concat()).into_owned()
}

fn host_triple() -> String {
    let version = succeed(Command::new(env::var_os("RUSTC").unwrap_or("rustc".into())).arg("-vV"));
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    host.expect("rustc names its host").to_string()
}
