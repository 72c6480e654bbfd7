//! The headers: made from the sources, committed, and fit for every compiler that may read them.

mod making;
mod parts;

use std::fs;

use crate::algorithms;
use crate::support::{compiler, fresh_folder, repository, sources, succeed, text_of};
pub use parts::paths;
use parts::{HEADERS, MAIN};

/// With `DELDRIFT_UPDATE_HEADER=1` the files are written instead.
#[test]
fn header_is_what_the_sources_say() {
    let parts = HEADERS.iter().map(|header| (header.path, header.text()));
    let others = [(MAIN, making::first_page()), (algorithms::LIST, algorithms::list())];
    for (path, made) in parts.chain(others) {
        if std::env::var_os("DELDRIFT_UPDATE_HEADER").is_some_and(|value| value == "1") {
            fs::write(repository(path), made).expect("a file can be written");
        } else {
            assert!(made == text_of(path), "{path} is stale: run make header and commit it");
        }
    }
}

/// A file of src/capi that is in no header would have its functions nowhere. Those of WebAssembly are called by
/// JavaScript alone.
#[test]
fn every_file_with_functions_is_in_one_header() {
    for source in sources("src/capi", "rs") {
        let text = fs::read_to_string(&source).expect("a source is text");
        let name = source.file_stem().and_then(|name| name.to_str()).expect("paths are UTF-8");
        let n_headers = HEADERS.iter().filter(|header| header.sources.contains(&name)).count();
        let has_functions =
            text.contains("\npub unsafe extern \"C\" fn ") || text.contains("\npub extern \"C\" fn ");
        let may_be_in_none = !has_functions || name == "wasm";
        assert!(n_headers == 1 || n_headers == 0 && may_be_in_none, "{name} is in {n_headers} headers");
    }
}

#[test]
fn headers_compile_alone_as_c11_cpp17_and_cpp20() {
    let folder = fresh_folder("header");
    let (c99, c11, cpp17, cpp20) = ("-std=c99", "-std=c11", "-std=c++17", "-std=c++20");
    let for_c = paths().chain([MAIN]).map(|path| path.trim_start_matches("include/"));
    let for_c = for_c.flat_map(|header| [("c", header, c99), ("c", header, c11), ("cpp", header, cpp17)]);
    let for_cpp = ["deldrift.hpp", "deldrift/cgal.hpp"];
    let for_cpp = for_cpp.into_iter().flat_map(|header| [("cpp", header, cpp17), ("cpp", header, cpp20)]);
    for (extension, include, standard) in for_c.chain(for_cpp) {
        let source = folder.join(format!("alone.{extension}"));
        let text = format!("#include <{include}>\n#include <{include}>\nint main(void) {{ return 0; }}\n");
        fs::write(&source, text).expect("a source can be written");
        let strict = ["-Wconversion", "-Wshadow", "-Wundef", "-fsyntax-only", standard];
        succeed(compiler(&source).args(strict).arg(&source));
    }
}

/// Some compilers have C++14 by default. What is wrong is said once.
#[test]
fn headers_ask_for_cpp17() {
    let folder = fresh_folder("cpp14");
    for header in ["deldrift.hpp", "deldrift/cgal.hpp"] {
        let source = folder.join("cpp14.cpp");
        let text = format!("#include <{header}>\nint main() {{ return 0; }}\n");
        fs::write(&source, text).expect("a source can be written");
        let mut compile = compiler(&source);
        let outcome = compile.args(["-fsyntax-only", "-std=c++14"]).arg(&source).output().expect("it runs");
        let said = String::from_utf8_lossy(&outcome.stderr);
        let errors: Vec<&str> = said.lines().filter(|line| line.contains("error: ")).collect();
        assert!(!outcome.status.success() && errors.len() == 1 && errors[0].contains("C++17"), "{said}");
    }
}

#[test]
fn readme_shows_the_example_that_is_compiled() {
    assert!(text_of("README.md").contains(&text_of("ffi-tests/c/readme_example.c")));
}
