//! The headers: made from the sources, committed, and fit for every compiler that may read them.

use std::fs;

use deldrift::motion::{Algorithm, Purpose};

use crate::algorithms;
use crate::support::{compiler, fresh_folder, repository, succeed, text_of};

/// A header that is made.
struct Header {
    path: &'static str,
    configuration: &'static str,
    /// Files of src/capi, in the order in which the header shows them.
    sources: &'static [&'static str],
    /// The enumeration of its algorithms, and what these are there for.
    algorithms: &'static str,
    purpose: Purpose,
    /// The file of src/capi that says what the enumeration is, and the type of its numbers.
    documented_at: (&'static str, &'static str),
}

const MAIN: Header = Header {
    path: "include/deldrift.h",
    configuration: "cbindgen.toml",
    sources: &[
        "status",
        "options",
        "handle",
        "triangulation",
        "motion",
        "preparing",
        "immediate",
        "keys",
        "segments",
        "splitting",
        "changes",
        "transferring",
        "state",
        "query",
        "location",
        "near",
        "reach",
        "geometry",
        "domain",
        "regions",
        "refining",
        "incidence",
        "listed",
        "voronoi",
        "periodic",
        "interpolation",
        "saving",
        "predicates",
    ],
    algorithms: "deldrift_algorithm",
    purpose: Purpose::Use,
    documented_at: ("options", "AlgorithmCode"),
};

const RESEARCH: Header = Header {
    path: "include/deldrift/research.h",
    configuration: "ffi-tests/header/research.toml",
    sources: &["research"],
    algorithms: "deldrift_research_algorithm",
    purpose: Purpose::Comparison,
    documented_at: ("research", "ResearchAlgorithmCode"),
};

/// With `DELDRIFT_UPDATE_HEADER=1` the files are written instead.
#[test]
fn header_is_what_the_sources_say() {
    let headers = [MAIN, RESEARCH].map(|header| (header.path, header.text()));
    for (path, made) in headers.into_iter().chain([(algorithms::LIST, algorithms::list())]) {
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
        ("research.c", "deldrift/research.h", c),
        ("research.cpp", "deldrift/research.h", cpp17),
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

impl Header {
    fn text(&self) -> String {
        let path = repository(self.configuration);
        let mut config = cbindgen::Config::from_file(path).expect("the configuration is valid");
        let is_main = self.path == MAIN.path;
        let page =
            |page: String| page.trim().replace("@EXAMPLE@", &example()).replace("@INDEX@", &self.index());
        config.header = config.header.map(page);
        config.after_includes = is_main.then(version);
        let enumeration = fresh_folder(self.algorithms).join("algorithms.rs");
        fs::write(&enumeration, self.enumeration_of_algorithms()).expect("a source can be written");
        let mut builder = cbindgen::Builder::new().with_config(config).with_src(enumeration);
        for source in self.sources {
            builder = builder.with_src(repository(&format!("src/capi/{source}.rs")));
        }
        let mut header = Vec::new();
        builder.generate().expect("the sources are understood").write(&mut header);
        let header = enumerations_in_c(&String::from_utf8(header).expect("the sources are text"));
        let header: String = header.lines().map(|line| with_body(&without_tags(line)) + "\n").collect();
        self.with_headings(&header)
    }

    /// The heading of each file that has functions, which is its first line, and the first of these.
    fn headings(&self) -> impl Iterator<Item = (String, String)> {
        self.sources.iter().filter_map(|source| {
            let text = text_of(&format!("src/capi/{source}.rs"));
            let heading = text.lines().next().and_then(|line| line.strip_prefix("//! "));
            let (_, function) = text.split_once("extern \"C\" fn ")?;
            let (function, _) = function.split_once('(').expect("a function has parameters");
            Some((heading.expect("a file says what it is").to_string(), function.to_string()))
        })
    }

    /// The headings, each with the function that it is above.
    fn index(&self) -> String {
        let lines =
            self.headings().map(|(heading, function)| format!(" *     {heading}\n *         {function}"));
        lines.collect::<Vec<_>>().join("\n")
    }

    /// Puts each heading above the documentation of its first function.
    fn with_headings(&self, header: &str) -> String {
        let mut lines: Vec<String> = header.lines().map(str::to_string).collect();
        for (heading, function) in self.headings() {
            let call = format!(" {function}(");
            let is_declared =
                |line: &String| line.replace('*', " ").contains(&call) && !line.starts_with(['/', ' ']);
            let at = lines.iter().position(is_declared).unwrap_or_else(|| panic!("{function} is declared"));
            let start =
                lines[..at].iter().rposition(|line| !line.starts_with("///")).map_or(0, |line| line + 1);
            let rule = format!("// {}", "-".repeat(117));
            lines.splice(start..start, [rule.clone(), format!("// {heading}"), rule, String::new()]);
        }
        lines.join("\n") + "\n"
    }

    /// The algorithms, as a source. What the enumeration says of itself is said of the type of its numbers.
    fn enumeration_of_algorithms(&self) -> String {
        let (file, code) = self.documented_at;
        let text = text_of(&format!("src/capi/{file}.rs"));
        let (before, _) = text.split_once(&format!("pub type {code}")).expect("it is there");
        let (_, documentation) = before.rsplit_once("\n\n").expect("it is not the first item");
        let mut source = format!("{documentation}#[repr(u32)]\npub enum {} {{\n", self.algorithms);
        for algorithm in Algorithm::ALL.into_iter().filter(|one| one.row().purpose == self.purpose) {
            for line in algorithm.row().documentation.lines() {
                source += &format!("    ///{line}\n");
            }
            let name = algorithms::c_name(algorithm).expect("it has a name");
            source += &format!("    {name} = {},\n", algorithm.code());
        }
        source + "}\n"
    }
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

/// A function that sets options to their defaults is defined in the header, so that it fills the structure of that: all
/// is zero but the size.
fn with_body(line: &str) -> String {
    let Some((name, parameter)) = line.strip_prefix("void ").and_then(|line| line.split_once('(')) else {
        return line.to_string();
    };
    let Some((kind, options)) = parameter.trim_end_matches(");").split_once(" *") else {
        return line.to_string();
    };
    if !name.ends_with("_options_init") {
        return line.to_string();
    }
    format!(
        "static inline void {name}({kind} *{options}) {{
    static {kind} zeros;
    if ({options}) {{
        *{options} = zeros;
        {options}->struct_size = sizeof *{options};
    }}
}}"
    )
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
