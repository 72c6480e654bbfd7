//! The headers under the warnings that programs compile with, beside macros of others, and without exceptions: by gcc,
//! and by clang where it is installed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{command, fresh_folder, repository, skipped, sources, succeed};

/// Beyond what `support::compiler` always asks for.
const GCC: [&str; 12] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Wundef",
    "-Wcast-qual",
    "-Wcast-align",
    "-Wdouble-promotion",
    "-Wredundant-decls",
    "-Wfloat-equal",
];
const GCC_OF_C: [&str; 4] =
    ["-Wc++-compat", "-Wstrict-prototypes", "-Wold-style-definition", "-Wmissing-prototypes"];
const GCC_OF_CPP: [&str; 11] = [
    "-Weffc++",
    "-Wold-style-cast",
    "-Wuseless-cast",
    "-Wzero-as-null-pointer-constant",
    "-Wsuggest-override",
    "-Wnon-virtual-dtor",
    "-Woverloaded-virtual",
    "-Wextra-semi",
    "-Wduplicated-branches",
    "-Wlogical-op",
    "-Wswitch-enum",
];

/// All that clang knows, but for what says only: how structures are laid out; what older standards lack; that there
/// are pointers; that a declaration follows a statement; that all enumerators have a case, so that there is no default.
const CLANG: [&str; 9] = [
    "-Weverything",
    "-Wno-unknown-warning-option",
    "-Wno-padded",
    "-Wno-c++98-compat",
    "-Wno-c++98-compat-pedantic",
    "-Wno-pre-c11-compat",
    "-Wno-unsafe-buffer-usage",
    "-Wno-declaration-after-statement",
    "-Wno-switch-default",
];

const C: [&str; 2] = ["c11", "c17"];
const CPP: [&str; 2] = ["c++17", "c++20"];

#[test]
fn headers_give_no_warnings() {
    let folder = fresh_folder("warnings");
    let c = write(&folder, "c.c", "#include <deldrift/research.h>\nint main(void) { return 0; }\n");
    let cpp = write(&folder, "c.cpp", "#include <deldrift/research.h>\nint main() { return 0; }\n");
    let uses = repository("ffi-tests/header/uses.cpp");
    for (standard, source) in [for_all(&C, &[&c]), for_all(&CPP, &[&cpp, &uses])].concat() {
        let is_c = standard.starts_with("c1");
        for is_clang in [false, true] {
            let Some(mut compiler) = compiler(is_clang, is_c) else { continue };
            compiler.arg(format!("-std={standard}"));
            match (is_clang, is_c) {
                (true, _) => compiler.args(CLANG),
                (false, true) => compiler.args(GCC).args(GCC_OF_C),
                (false, false) => compiler.args(GCC).args(GCC_OF_CPP),
            };
            succeed(compiler.arg("-Werror").arg(source));
        }
    }
}

/// Only a program's own names may be macros: none that the headers have for parameters, members or themselves.
#[test]
fn headers_have_no_names_that_are_macros_of_others() {
    let folder = fresh_folder("macros");
    let macros = repository("ffi-tests/header/macros.h");
    let program = |headers: &str, uses: &str| {
        format!("{headers}\n#include \"{}\"\n{uses}\nint main(void) {{ return 0; }}\n", macros.display())
    };
    let c = program(
        &headers_of_the_system(&["include", "include/deldrift"], "h"),
        "#include <deldrift/research.h>",
    );
    let folders = ["include", "include/deldrift", "include/deldrift/cgal"];
    let names = [
        "Delaunay_triangulation_2",
        "Constrained_Delaunay_triangulation_2",
        "Delaunay_triangulation_3",
        "Regular_triangulation_2",
        "Regular_triangulation_3",
    ];
    let triangulations =
        names.map(|name| format!("template class deldrift::cgal::{name}<deldrift::cgal::Kernel, int>;"));
    let uses = format!("#include <deldrift/cgal.hpp>\n{}", triangulations.join("\n"));
    let cpp = headers_of_the_system(&["include", "include/deldrift"], "h")
        + &headers_of_the_system(&folders, "hpp");
    let (c, cpp) = (write(&folder, "c.c", &c), write(&folder, "cpp.cpp", &program(&cpp, &uses)));
    for (standard, source) in [for_all(&C, &[&c]), for_all(&CPP, &[&cpp])].concat() {
        for is_clang in [false, true] {
            let Some(mut compiler) = compiler(is_clang, standard.starts_with("c1")) else { continue };
            succeed(compiler.arg(format!("-std={standard}")).arg(source));
        }
    }
}

#[test]
fn without_exceptions_one_line_says_what_to_use() {
    let folder = fresh_folder("without_exceptions");
    for is_clang in [false, true] {
        for header in ["deldrift.hpp", "deldrift/cgal.hpp"] {
            let source = write(&folder, "thrown.cpp", &format!("#include <{header}>\n"));
            let Some(mut compiler) = compiler(is_clang, false) else { continue };
            let outcome = compiler.args(["-std=c++17", "-fno-exceptions"]).arg(source).output();
            let said = outcome.expect("a compiler runs").stderr;
            let said = String::from_utf8_lossy(&said);
            let errors: Vec<&str> = said.lines().filter(|line| line.contains("error:")).collect();
            assert!(errors.len() == 1 && errors[0].contains("use deldrift.h, whose functions"), "{said}");
        }
        let source = write(&folder, "returned.cpp", "#include <deldrift.h>\n");
        let Some(mut compiler) = compiler(is_clang, false) else { continue };
        succeed(compiler.args(["-std=c++17", "-fno-exceptions", "-Werror"]).arg(source));
    }
}

/// A compiler that only looks at a source; says so if it is not installed.
fn compiler(is_clang: bool, is_c: bool) -> Option<Command> {
    let name = match (is_clang, is_c) {
        (true, true) => "clang",
        (true, false) => "clang++",
        (false, true) => "gcc",
        (false, false) => "g++",
    };
    if command(name).arg("--version").output().is_err() {
        skipped(&format!("warnings, by {name}"), "it is not installed");
        return None;
    }
    let mut compiler = command(name);
    compiler.args(["-fsyntax-only", "-I"]).arg(repository("include"));
    Some(compiler)
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("a source can be written");
    path
}

fn for_all<'a>(standards: &[&'a str], sources: &[&'a PathBuf]) -> Vec<(&'a str, &'a PathBuf)> {
    standards.iter().flat_map(|standard| sources.iter().map(move |source| (*standard, *source))).collect()
}

/// What the headers in the folders include of the compiler's own, where that is there.
fn headers_of_the_system(folders: &[&str], extension: &str) -> String {
    let files = folders.iter().flat_map(|folder| sources(folder, extension));
    let text: String = files.map(|file| fs::read_to_string(file).expect("a header is text")).collect();
    let included = text.lines().filter_map(|line| line.strip_prefix("#include <")?.strip_suffix('>'));
    included
        .filter(|name| !name.starts_with("deldrift"))
        .map(|name| format!("#if __has_include(<{name}>)\n#include <{name}>\n#endif\n"))
        .collect()
}
