//! The header: made from the sources, committed, and fit for every compiler that may read it.

use std::fs;

use crate::support::{compiler, fresh_folder, repository, succeed, text_of};

const HEADER: &str = "include/deldrift.h";

/// The sources of the header, in the order in which it shows them.
const SOURCES: [&str; 6] = ["status", "options", "triangulation", "motion", "changes", "query"];

/// With `DELDRIFT_UPDATE_HEADER=1` the header is written instead.
#[test]
fn header_is_what_the_sources_say() {
    let made = make_header();
    if std::env::var_os("DELDRIFT_UPDATE_HEADER").is_some_and(|value| value == "1") {
        fs::write(repository(HEADER), made).expect("the header can be written");
        return;
    }
    assert!(
        made == text_of(HEADER),
        "{HEADER} is stale: run DELDRIFT_UPDATE_HEADER=1 cargo test --test ffi header and commit it"
    );
}

#[test]
fn header_compiles_alone_as_c11_and_cpp17() {
    let folder = fresh_folder("header");
    for (name, include) in [("c.c", "deldrift.h"), ("c.cpp", "deldrift.h"), ("cpp.cpp", "deldrift.hpp")] {
        let source = folder.join(name);
        let text = format!("#include <{include}>\n#include <{include}>\nint main(void) {{ return 0; }}\n");
        fs::write(&source, text).expect("a source can be written");
        let strict = ["-Wconversion", "-Wshadow", "-Wundef", "-fsyntax-only"];
        succeed(compiler(&source).args(strict).arg(&source));
    }
}

#[test]
fn readme_shows_the_example_that_is_compiled() {
    assert!(text_of("README.md").contains(&text_of("ffi-tests/c/readme_example.c")));
}

fn make_header() -> String {
    let mut config =
        cbindgen::Config::from_file(repository("cbindgen.toml")).expect("cbindgen.toml is valid");
    config.header = config.header.map(|page| page.trim().replace("@EXAMPLE@", &example()));
    config.after_includes = Some(version());
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(repository(&format!("src/capi/{source}.rs")));
    }
    let mut header = Vec::new();
    builder.generate().expect("the sources are understood").write(&mut header);
    let header = String::from_utf8(header).expect("the sources are text");
    header.lines().map(|line| without_tags(line) + "\n").collect()
}

/// Every structure has a typedef of the same name, so that uses need no `struct`.
fn without_tags(line: &str) -> String {
    if line.starts_with("typedef struct") {
        line.to_string()
    } else {
        line.replace("struct deldrift_", "deldrift_")
    }
}

/// The example of the README, for the first page.
fn example() -> String {
    let lines = text_of("ffi-tests/c/readme_example.c");
    lines.lines().map(|line| format!(" *     {line}").trim_end().to_string()).collect::<Vec<_>>().join("\n")
}

/// The version in `Cargo.toml`, for the preprocessor.
fn version() -> String {
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "
/// Version of this header, that of the library it came with: see deldrift_version.
#define DELDRIFT_VERSION_MAJOR {}
#define DELDRIFT_VERSION_MINOR {}
#define DELDRIFT_VERSION_PATCH {}
#define DELDRIFT_VERSION_STRING \"{version}\"",
        env!("CARGO_PKG_VERSION_MAJOR"),
        env!("CARGO_PKG_VERSION_MINOR"),
        env!("CARGO_PKG_VERSION_PATCH"),
    )
}
