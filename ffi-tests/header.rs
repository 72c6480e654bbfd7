//! The header: made from the sources, committed, and fit for every compiler that may read it.

use std::fs;

use deldrift::motion::Algorithm;

use crate::algorithms;
use crate::support::{compiler, fresh_folder, repository, succeed, text_of};

const HEADER: &str = "include/deldrift.h";

/// The sources of the header, in the order in which it shows them.
const SOURCES: [&str; 17] = [
    "status",
    "options",
    "handle",
    "triangulation",
    "motion",
    "immediate",
    "changes",
    "state",
    "query",
    "location",
    "geometry",
    "incidence",
    "listed",
    "voronoi",
    "interpolation",
    "saving",
    "predicates",
];

/// With `DELDRIFT_UPDATE_HEADER=1` the files are written instead.
#[test]
fn header_is_what_the_sources_say() {
    for (path, made) in [(HEADER, make_header()), (algorithms::LIST, algorithms::list())] {
        if std::env::var_os("DELDRIFT_UPDATE_HEADER").is_some_and(|value| value == "1") {
            fs::write(repository(path), made).expect("a file can be written");
        } else {
            assert!(made == text_of(path), "{path} is stale: run make header and commit it");
        }
    }
}

#[test]
fn headers_compile_alone_as_c11_cpp17_and_cpp20() {
    let folder = fresh_folder("header");
    let (c, cpp17, cpp20) = ("-std=c11", "-std=c++17", "-std=c++20");
    for (name, include, standard) in [
        ("c.c", "deldrift.h", c),
        ("c.cpp", "deldrift.h", cpp17),
        ("cpp.cpp", "deldrift.hpp", cpp17),
        ("cpp.cpp", "deldrift.hpp", cpp20),
        ("cgal.cpp", "deldrift/cgal.hpp", cpp17),
        ("cgal.cpp", "deldrift/cgal.hpp", cpp20),
    ] {
        let source = folder.join(name);
        let text = format!("#include <{include}>\n#include <{include}>\nint main(void) {{ return 0; }}\n");
        fs::write(&source, text).expect("a source can be written");
        let strict = ["-Wconversion", "-Wshadow", "-Wundef", "-fsyntax-only", standard];
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
    let enumeration = fresh_folder("enumeration").join("algorithms.rs");
    fs::write(&enumeration, enumeration_of_algorithms()).expect("a source can be written");
    let mut builder = cbindgen::Builder::new().with_config(config).with_src(enumeration);
    for source in SOURCES {
        builder = builder.with_src(repository(&format!("src/capi/{source}.rs")));
    }
    let mut header = Vec::new();
    builder.generate().expect("the sources are understood").write(&mut header);
    let header = enumerations_in_c(&String::from_utf8(header).expect("the sources are text"));
    header.lines().map(|line| without_tags(line) + "\n").collect()
}

/// The algorithms that have a name in C, as a source. What the enumeration says of itself is said of the type of its
/// numbers.
fn enumeration_of_algorithms() -> String {
    let options = text_of("src/capi/options.rs");
    let (before, _) = options.split_once("pub type AlgorithmCode").expect("it is there");
    let (_, documentation) = before.rsplit_once("\n\n").expect("it is not the first item");
    let mut source = format!("{documentation}#[repr(u32)]\npub enum deldrift_algorithm {{\n");
    for algorithm in Algorithm::ALL {
        if let Some(name) = algorithms::c_name(algorithm) {
            for line in algorithm.row().documentation.lines() {
                source += &format!("    ///{line}\n");
            }
            source += &format!("    {name} = {},\n", algorithm.code());
        }
    }
    source + "}\n"
}

/// Enumerations have a tag only where they have a type, too: in older C a type of numbers has that name, which would
/// have two meanings.
fn enumerations_in_c(header: &str) -> String {
    let mut made = String::new();
    let mut tag = None;
    for line in header.lines() {
        if let Some(name) = line.strip_prefix("enum deldrift_") {
            tag = Some(name);
            made += "enum\n";
        } else if let (Some(name), "  : uint32_t") = (tag, line) {
            made += &format!("  deldrift_{name} : uint32_t\n");
            tag = None;
        } else {
            made = made + line + "\n";
        }
    }
    assert_eq!(tag, None, "an enumeration without a type");
    made
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
