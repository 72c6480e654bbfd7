//! How a header is made of the files of src/capi.

use std::fs;

use deldrift::motion::Algorithm;

use super::parts::{Algorithms, CORE, HEADERS, Header};
use crate::algorithms;
use crate::functions::{Function, functions_of};
use crate::support::{fresh_folder, repository, text_of};

/// deldrift.h: the first page, and the parts.
pub fn first_page() -> String {
    let parts = || HEADERS.iter().filter_map(|header| header.subject.map(|subject| (header, subject)));
    let mut index = Vec::new();
    for (header, subject) in parts() {
        index.extend(hanging(5, 5, &format!("{}: {subject}", header.name())));
        index.extend(header.headings().flat_map(|(heading, _)| hanging(9, 13, &heading)));
    }
    let includes: Vec<String> =
        parts().map(|(header, _)| format!("#include \"{}\"", header.name())).collect();
    text_of("ffi-tests/header/first_page.h")
        .replace("@EXAMPLE@", &example())
        .replace("@INDEX@", &index.join("\n"))
        .replace("@INCLUDES@", &includes.join("\n"))
}

impl Header {
    pub fn text(&self) -> String {
        let path = repository(self.configuration);
        let mut config = cbindgen::Config::from_file(path).expect("the configuration is valid");
        let is_core = self.name().ends_with(CORE);
        match self.subject {
            Some(_) if is_core => {
                config.sys_includes = ["stdbool.h", "stddef.h", "stdint.h"].map(String::from).into();
                config.after_includes = Some(version());
            }
            Some(_) => config.includes = [CORE].into_iter().chain(self.also).map(String::from).collect(),
            None => config.header = config.header.map(|page| page.trim().to_string()),
        }
        let mut builder = cbindgen::Builder::new().with_config(config);
        if let Some(algorithms) = &self.algorithms {
            let source = fresh_folder(algorithms.name).join("algorithms.rs");
            fs::write(&source, algorithms.enumeration()).expect("a source can be written");
            builder = builder.with_src(source);
        }
        for source in self.sources {
            builder = builder.with_src(repository(&format!("src/capi/{source}.rs")));
        }
        let mut header = Vec::new();
        builder.generate().expect("the sources are understood").write(&mut header);
        let header = enumerations_in_c(&String::from_utf8(header).expect("the sources are text"));
        let header: String = header.lines().map(|line| with_body(&without_tags(line)) + "\n").collect();
        let header = self.with_headings(&header);
        match self.subject {
            Some(subject) => self.with_banner(subject, &header),
            None => header,
        }
    }

    /// What a program includes.
    fn name(&self) -> &'static str {
        self.path.trim_start_matches("include/")
    }

    /// The heading of each file that has functions, which is its first line, and the names of these.
    fn headings(&self) -> impl Iterator<Item = (String, Vec<String>)> {
        self.sources.iter().filter_map(|source| {
            let text = text_of(&format!("src/capi/{source}.rs"));
            let heading = text.lines().next().and_then(|line| line.strip_prefix("//! "));
            let functions = text.split("extern \"C\" fn ").filter(|text| text.starts_with("deldrift_"));
            let name = |text: &str| text.split_once('(').expect("a function has parameters").0.to_string();
            let functions: Vec<String> = functions.map(name).collect();
            (!functions.is_empty()).then(|| (heading.expect("a file says what it is").to_string(), functions))
        })
    }

    /// Puts what the header is in front of it, an index of its functions, and a guard around it.
    fn with_banner(&self, subject: &str, header: &str) -> String {
        let functions = functions_of(header);
        let mut index = Vec::new();
        for (heading, names) in self.headings() {
            index.push(String::from(" *"));
            index.extend(hanging(1, 1, &heading));
            index.push(String::from(" *"));
            for name in names {
                let is_it = |function: &&Function| function.name == name;
                let function = functions.iter().find(is_it).unwrap_or_else(|| panic!("{name} is declared"));
                index.extend(hanging(5, 9, &format!("{name}: {}", function.summary)));
            }
        }
        let from = self.sources.join(".rs, ");
        let of_algorithms =
            self.algorithms.as_ref().map_or("", |_| " and, for the algorithms, src/motion/algorithms.rs");
        let made = format!(
            "Made by `make header` from these files of src/capi{of_algorithms}: {from}.rs. Change it there."
        );
        let guard = self.name().to_uppercase().replace(['/', '.'], "_");
        format!(
            "/*\n * {}: {}\n *\n * A part of deldrift.h, the first page of which has the rules that hold for all \
             functions.\n *\n{}\n{}\n */\n\n\
             #ifndef {guard}\n#define {guard}\n\n{}\n\n#endif // {guard}\n",
            self.name(),
            subject,
            hanging(1, 1, &made).join("\n"),
            index.join("\n"),
            header.trim(),
        )
    }

    /// Puts each heading above the documentation of its first function.
    fn with_headings(&self, header: &str) -> String {
        let mut lines: Vec<String> = header.lines().map(str::to_string).collect();
        for (heading, functions) in self.headings() {
            let call = format!(" {}(", functions[0]);
            let is_declared =
                |line: &String| line.replace('*', " ").contains(&call) && !line.starts_with(['/', ' ']);
            let at = lines.iter().position(is_declared).unwrap_or_else(|| panic!("{call} is declared"));
            let start =
                lines[..at].iter().rposition(|line| !line.starts_with("///")).map_or(0, |line| line + 1);
            let rule = format!("// {}", "-".repeat(117));
            let heading = [rule.clone(), format!("// {heading}"), rule, String::new()];
            lines.splice(start..start, heading);
        }
        lines.join("\n") + "\n"
    }
}

impl Algorithms {
    /// The algorithms, as a source. What the enumeration says of itself is said of the type of its numbers.
    fn enumeration(&self) -> String {
        let (file, code) = self.documented_at;
        let text = text_of(&format!("src/capi/{file}.rs"));
        let (before, _) = text.split_once(&format!("pub type {code}")).expect("it is there");
        let (_, documentation) = before.rsplit_once("\n\n").expect("it is not the first item");
        let mut source = format!("{documentation}#[repr(u32)]\npub enum {} {{\n", self.name);
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

/// Lines of a comment, the first one indented by fewer columns than the others.
fn hanging(first: usize, others: usize, text: &str) -> Vec<String> {
    let mut lines = vec![format!(" *{}", " ".repeat(first))];
    let mut is_empty = true;
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is one");
        if !is_empty && line.len() + 1 + word.len() > 120 {
            lines.push(format!(" *{}{word}", " ".repeat(others)));
        } else {
            *line += if is_empty { "" } else { " " };
            *line += word;
        }
        is_empty = false;
    }
    lines
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
