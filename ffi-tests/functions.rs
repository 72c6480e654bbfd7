//! docs/FUNCTIONS.md, docs/COSTS.md and docs/ERRORS.md: they name everything that the header has, and what they say is so.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use crate::abuse;
use crate::abuse::declarations::refused_by_boxes;
use crate::coverage::{declarations, function_name};
use crate::support::{Linkage, build, command, fresh_folder, headers, repository, succeed, text_of};

const TABLE: &str = "docs/FUNCTIONS.md";

/// A function of the headers, the first sentence of its documentation, and all of it in one line.
pub struct Function {
    pub name: String,
    pub summary: String,
    documentation: String,
}

/// With `DELDRIFT_UPDATE_HEADER=1` the table is written instead.
#[test]
fn table_of_functions_is_what_the_header_says() {
    let functions = functions();
    assert!(functions.len() > 40, "{}", functions.len());
    if std::env::var_os("DELDRIFT_UPDATE_HEADER").is_some_and(|value| value == "1") {
        fs::write(repository(TABLE), table(&functions)).expect("a file can be written");
    }
    let text = text_of(TABLE);
    let rows: Vec<Vec<&str>> =
        text.lines().filter(|line| line.starts_with("| `deldrift_")).map(cells).collect();
    assert_eq!(rows.len(), functions.len(), "{TABLE} is stale: run make header and commit it");
    for (function, row) in functions.iter().zip(rows) {
        let [name, summary, test, example] = row[..] else { panic!("{row:?}") };
        assert_eq!(name, format!("`{}`", function.name), "{TABLE} is stale: run make header and commit it");
        assert_eq!(summary, escaped(&function.summary), "{TABLE} is stale: run make header and commit it");
        assert!(calls(linked(test), function) > 0, "{test} does not call {name}");
        assert!(calls(linked(example), function) > 0, "{example} does not call {name}");
    }
}

/// What each costs is said in the header, and measured: by a row of the program that `make costs` runs, and in the table
/// that it has written.
#[test]
fn every_function_says_what_it_costs_and_is_measured() {
    let rows: String = ["changing", "reading", "geometry", "segments", "files"]
        .map(|part| text_of(&format!("benches/costs/{part}.cpp")))
        .concat();
    let page = text_of("docs/COSTS.md");
    let (_, tables) = page.split_once("## Exponents in the plane").expect("the page has tables");
    for Function { name, documentation, .. } in functions() {
        assert!(documentation.contains(" Cost: "), "{name} does not say what it costs");
        assert!(rows.contains(&format!("{{\"{name}\", ")), "no row of benches/costs is about {name}");
        assert!(tables.contains(&format!("| `{name}` |")), "docs/COSTS.md is stale: run make costs");
    }
}

/// Calls that are short on the sets of a tour, and have their callbacks called where they are long.
const SHORT: [&str; 8] = [
    "deldrift_check_staged",
    "deldrift_coarsen",
    "deldrift_insert_vertex",
    "deldrift_insert_vertex_with_key",
    "deldrift_insert_vertex_with_weight",
    "deldrift_remove_vertex",
    "deldrift_set_weight",
    "deldrift_stage_splits",
];

/// The header has a rule for it: who may be cancelled says so among its errors. What a tour finds is what follows from that.
#[test]
fn callbacks_are_called_from_where_the_header_says() {
    let folder = fresh_folder("callbacks");
    let program = build(&repository("ffi-tests/c/callbacks.c"), &folder, Linkage::Shared, &[]);
    let said = succeed(&mut command(program));
    let calling: BTreeSet<&str> = said.lines().collect();
    let functions = functions();
    let may_cancel = |function: &&Function| {
        let (_, errors) = function.documentation.split_once("Errors:").unwrap_or_default();
        errors.contains("DELDRIFT_CANCELLED")
    };
    let documented: BTreeSet<&str> =
        functions.iter().filter(may_cancel).map(|function| function.name.as_str()).collect();
    let silent: Vec<_> = calling.difference(&documented).collect();
    assert!(silent.is_empty(), "these call callbacks, and the header does not say so: {silent:?}");
    let missing: Vec<_> = documented.difference(&calling).copied().collect();
    assert_eq!(missing, SHORT, "these may be cancelled, the header says, and no callback is called");
}

/// docs/PERIODIC.md has in a table what the header names, some of it as ranges in the order of the headers. That boxes
/// refuse these and no others is tried by ffi-tests/abuse.rs.
#[test]
fn page_on_boxes_has_what_the_header_says_that_they_refuse() {
    let functions = functions();
    let at = |name: &str| {
        functions.iter().position(|function| function.name == name).unwrap_or_else(|| panic!("{name}"))
    };
    let refused = refused_by_boxes(&abuse::declarations::declarations());
    let listed: BTreeSet<&str> = refused.iter().map(String::as_str).collect();
    let page = text_of("docs/PERIODIC.md");
    let (_, table) = page.split_once("refused with `DELDRIFT_PERIODIC`").expect("the page has a table");
    let rows =
        table.lines().skip_while(|line| !line.starts_with('|')).take_while(|line| line.starts_with('|'));
    let mut on_page = BTreeSet::new();
    for name_or_range in rows.filter_map(|row| cells(row).get(1).copied()).flat_map(|names| names.split(", "))
    {
        let mut ends = name_or_range.split('`').filter(|word| word.starts_with("deldrift_")).map(at);
        let Some(first) = ends.next() else { continue };
        on_page.extend(
            functions[first..=ends.next().unwrap_or(first)].iter().map(|function| function.name.as_str()),
        );
    }
    // That one serves boxes, but for some places.
    assert!(on_page.remove("deldrift_conflicts"));
    assert_eq!(on_page, listed);
}

/// The first page has rules that hold for all functions, so that the documentation of a function has what is its own.
#[test]
fn what_holds_for_all_functions_is_said_once() {
    let rules = [
        "DELDRIFT_MISALIGNED_ARGUMENT",
        "DELDRIFT_BUFFER_TOO_SMALL",
        "asks for the count",
        "also written when the buffer",
        "same time as any other call",
        "from any number of threads",
        "read during the call",
        "After a change the first call",
        "Ends all views",
    ];
    let mut repeated = Vec::new();
    for Function { name, documentation, .. } in functions() {
        repeated.extend(
            rules.iter().filter(|rule| documentation.contains(**rule)).map(|rule| (name.clone(), *rule)),
        );
    }
    assert!(repeated.is_empty(), "the first page says this of all functions: {repeated:?}");
}

#[test]
fn every_status_has_a_cause_and_a_remedy() {
    let header = text_of("include/deldrift/core.h");
    let (_, from) = header.split_once("deldrift_status : uint32_t").expect("there are statuses");
    let (statuses, _) = from.split_once("};").expect("an enumeration ends");
    let statuses: BTreeSet<&str> =
        declarations(statuses).filter_map(|line| line.split_once(" = ")).map(|(name, _)| name).collect();
    let errors = text_of("docs/ERRORS.md");
    let rows: Vec<Vec<&str>> = errors.lines().filter(|line| line.starts_with("| `")).map(cells).collect();
    let named: BTreeSet<&str> = rows.iter().map(|row| row[0].trim_matches('`')).collect();
    assert_eq!(named, statuses, "the rows of docs/ERRORS.md are not the statuses");
    assert!(rows.iter().all(|row| row.len() == 3 && row.iter().all(|cell| !cell.is_empty())));
}

/// In the order of the headers.
fn functions() -> Vec<Function> {
    functions_of(&headers())
}

/// The functions that a header declares.
pub fn functions_of(header: &str) -> Vec<Function> {
    let (mut functions, mut documentation) = (Vec::new(), String::new());
    for line in header.lines() {
        if let Some(text) = line.strip_prefix("///") {
            documentation += text;
        } else if let Some(name) = declarations(line).find_map(function_name) {
            let mut stops = documentation.match_indices(". ").map(|(at, _)| at);
            let end = stops
                .find(|&at| !documentation[..at].ends_with('.'))
                .map_or(documentation.len(), |at| at + 1);
            functions.push(Function {
                name: name.to_string(),
                summary: documentation[..end].trim().to_string(),
                documentation: documentation.clone(),
            });
        }
        if line.is_empty() {
            documentation.clear();
        }
    }
    functions
}

/// For each function the test and the example that call it most often.
fn table(functions: &[Function]) -> String {
    let mut text = String::from(
        "# Functions\n\nEvery function of [deldrift.h](../include/deldrift.h), with a test and an example \
         that\ncall it; \
         those that begin with `deldrift_research_` are in [deldrift/research.h](../include/deldrift/research.h), for \
         comparisons.\nTests compare this table with the headers and with the programs; `make header` writes it.\n\n\
         | function | what it does | test | example |\n|---|---|---|---|\n",
    );
    let (tests, examples) =
        (paths(&["ffi-tests/c"]), paths(&["examples", "ffi-tests/consumers", "cpp-bench"]));
    // Programs for comparisons are no examples of what others need.
    let is_of_research = |path: &String| text_of(path).contains("#include <deldrift/research.h>");
    let (of_research, examples): (Vec<String>, Vec<String>) = examples.into_iter().partition(is_of_research);
    for function in functions {
        let is_for_use = !function.name.starts_with("deldrift_research_");
        let examples = if is_for_use { &examples } else { &of_research };
        let test = most_calls(&tests, function).map_or("-".into(), |path| link(&path));
        let example = most_calls(examples, function).map_or("-".into(), |path| link(&path));
        let summary = escaped(&function.summary);
        let _ = writeln!(text, "| `{}` | {summary} | {test} | {example} |", function.name);
    }
    text
}

/// A sentence in a table of Markdown.
fn escaped(sentence: &str) -> String {
    sentence.replace('*', "\\*").replace('|', "\\|")
}

/// Programs in C and C++.
fn paths(folders: &[&str]) -> Vec<String> {
    let programs = |folder: &&str| {
        let files = fs::read_dir(repository(folder)).expect("the folder is there");
        let is_program =
            |path: &PathBuf| ["c", "cpp", "hpp"].iter().any(|kind| path.extension() == Some(kind.as_ref()));
        let paths = files.map(|file| file.expect("a folder can be listed").path()).filter(is_program);
        paths
            .map(|path| format!("{folder}/{}", path.file_name().expect("a name").display()))
            .collect::<Vec<_>>()
    };
    let mut paths: Vec<String> = folders.iter().flat_map(programs).collect();
    paths.sort();
    paths
}

fn most_calls(paths: &[String], function: &Function) -> Option<String> {
    let counted = paths.iter().map(|path| (calls(path, function), path));
    // Of several with as many calls the first one.
    let most = counted.rev().max_by_key(|&(n, _)| n).filter(|&(n, _)| n > 0);
    most.map(|(_, path)| path.clone())
}

/// How often a program calls a function, or the member of the wrapper with its name.
fn calls(path: &str, function: &Function) -> usize {
    let program = text_of(path);
    let by_name = program.matches(&format!("{}(", function.name)).count();
    let member = function.name.trim_start_matches("deldrift_");
    if !program.contains("#include <deldrift.hpp>") {
        return by_name;
    }
    let is_created = member == "create" || member == "destroy";
    let by_member = if is_created { "deldrift::Triangulation t" } else { &format!("t.{member}(") };
    by_name + program.matches(by_member).count() + program.matches(&format!("t_.{member}(")).count()
}

fn link(path: &str) -> String {
    let name = Path::new(path).file_name().expect("a path ends in a name").display();
    format!("[{name}](../{path})")
}

/// The file that a link leads to.
fn linked(cell: &str) -> &str {
    let (_, path) = cell.split_once("](../").unwrap_or_else(|| panic!("{cell} is no link"));
    path.trim_end_matches(')')
}

fn cells(row: &str) -> Vec<&str> {
    row.trim_matches('|').split(" | ").map(str::trim).collect()
}
