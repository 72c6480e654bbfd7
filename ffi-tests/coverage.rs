//! What the programs use of the headers: everything.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::support::{headers, repository, sources, text_of};

/// Statuses that no C program can bring about on purpose, and the unit tests in `src/capi` that stand in:
/// a program would need 2^30 cells for the first, and a defect of the library for the others.
const TESTED_IN_RUST: [(&str, &str); 4] = [
    ("DELDRIFT_TOO_MANY_CELLS", "src/capi/status.rs"),
    ("DELDRIFT_INVALID", "src/capi/status.rs"),
    ("DELDRIFT_POISONED", "src/capi/panics.rs"),
    ("DELDRIFT_INTERNAL_ERROR", "src/capi/panics.rs"),
];

#[test]
fn every_function_is_called_by_a_c_program() {
    let header = headers();
    let functions: BTreeSet<&str> = declarations(&header).filter_map(function_name).collect();
    assert!(functions.len() > 30, "{functions:?}");
    let programs = programs("c");
    let missing: Vec<&&str> =
        functions.iter().filter(|name| !programs.contains(&format!("{name}("))).collect();
    assert!(missing.is_empty(), "no C program calls {missing:?}");
}

/// Those that may give `DELDRIFT_OUT_OF_MEMORY`, and say so, have their requests refused; the others have none.
#[test]
fn every_function_is_called_without_memory() {
    let (header, faults) = (headers(), text_of("ffi-tests/c/faults.c"));
    let (_, calls) = faults.split_once("other_functions_ask_for_nothing(").expect("it is there");
    let (without_requests, _) = calls.split_once("\n}\n").expect("a function ends");
    let with_requests = text_of("ffi-tests/c/scenes.h");
    let mut documentation = String::new();
    let mut n_functions = 0;
    for line in header.lines() {
        if line.starts_with("///") {
            documentation += line;
        } else if let Some(name) = declarations(line).find_map(function_name) {
            let may_fail = documentation.contains("DELDRIFT_OUT_OF_MEMORY");
            let call = format!("{name}(");
            let program = if may_fail { &with_requests } else { without_requests };
            assert!(program.contains(&call), "{name}, which may lack memory: {may_fail}");
            assert!(!may_fail || !without_requests.contains(&call), "{name} may lack memory");
            n_functions += 1;
        }
        if line.is_empty() {
            documentation.clear();
        }
    }
    assert!(n_functions > 40, "{n_functions}");
}

/// A tour is made from foreign floating-point environments, and on little stack.
#[test]
fn every_function_is_called_on_a_tour() {
    let (header, tour) = (headers(), text_of("ffi-tests/c/tour.h"));
    let functions = declarations(&header).filter_map(function_name);
    let missing: Vec<&str> = functions.filter(|name| !tour.contains(&format!("{name}("))).collect();
    assert!(missing.is_empty(), "no tour calls {missing:?}");
}

#[test]
fn every_status_is_asserted() {
    let header = text_of("include/deldrift/core.h");
    let (_, from) = header.split_once("deldrift_status : uint32_t").expect("there are statuses");
    let (statuses, _) = from.split_once("};").expect("an enumeration ends");
    let statuses: Vec<&str> =
        declarations(statuses).filter_map(|line| line.split_once(" = ")).map(|(name, _)| name).collect();
    assert!(statuses.len() > 20, "{statuses:?}");
    let programs = programs("c");
    for status in statuses {
        let in_rust = TESTED_IN_RUST.iter().find(|(name, _)| *name == status);
        let is_asserted = match in_rust {
            Some((_, source)) => unit_tests_of(source).contains(status),
            None if status == "DELDRIFT_OK" => programs.contains("OK("),
            None => programs.contains(&format!(", {status})")) || programs.contains(&format!(" {status})")),
        };
        assert!(is_asserted, "no test brings about {status}");
    }
}

/// The unit tests of a file of `src/capi`: its last module, or all of it if it is compiled for tests alone.
fn unit_tests_of(source: &str) -> String {
    let text = text_of(source);
    let module = Path::new(source).file_stem().and_then(|stem| stem.to_str()).expect("a module has a name");
    if text_of("src/capi/mod.rs").contains(&format!("#[cfg(test)]\nmod {module};")) {
        return text;
    }
    text.split_once("mod tests").map(|(_, tests)| tests.to_owned()).unwrap_or_default()
}

#[test]
fn every_member_of_the_cpp_headers_is_used() {
    let folders =
        [repository("include"), repository("include/deldrift"), repository("include/deldrift/cgal")];
    let headers: Vec<String> = folders.iter().flat_map(|folder| headers_in(folder)).collect();
    let for_cgal = ["both", "constrained", "regular"].map(|name| format!("ffi-tests/cgal/{name}.cpp"));
    let shared = ["check", "regular"].map(|name| format!("ffi-tests/cpp/{name}.hpp"));
    let others = for_cgal.iter().chain(&shared).map(|path| text_of(path));
    let programs = programs("cpp") + &others.collect::<String>();
    let members: BTreeSet<&str> = headers.iter().flat_map(|header| public_members(header)).collect();
    assert!(members.len() > 130, "{members:?}");
    let missing: Vec<&&str> = members.iter().filter(|name| !programs.contains(&format!("{name}("))).collect();
    assert!(missing.is_empty(), "no C++ program uses {missing:?}");
}

/// The functions of a header, all of which are in the library, too: those that are defined in the header are there for
/// other languages.
pub fn exported_functions(header: &str) -> BTreeSet<&str> {
    declarations(header).filter_map(function_name).collect()
}

/// Lines that are no comments, without their indentation.
pub fn declarations(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| !line.starts_with(['/', '*', '#']))
}

/// The function that a line declares.
pub fn function_name(line: &str) -> Option<&str> {
    let start = line.match_indices("deldrift_").map(|(at, _)| at).find(|&at| {
        let name_end = line[at..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        name_end.is_some_and(|end| line[at + end..].starts_with('(')) && at > 0
    })?;
    line[start..].split('(').next()
}

/// The members that a program may call, of all classes of a header.
fn public_members(header: &str) -> Vec<&str> {
    let (mut class, mut is_public, mut members) = ("", false, Vec::new());
    for line in header.lines() {
        if let Some((kind, name)) =
            line.split_once(' ').filter(|&(kind, _)| kind == "class" || kind == "struct")
        {
            (class, is_public) = (name.split([' ', '<', ';']).next().unwrap_or(name), kind == "struct");
        } else if line == "};" || line == "private:" || line == "protected:" {
            is_public = false;
        } else if line == "public:" {
            is_public = true;
        } else if is_public {
            // Constructors are used wherever there is an object.
            members.extend(member_name(line).filter(|&name| name != class));
        }
    }
    members
}

/// The function that a line of a class declares.
fn member_name(line: &str) -> Option<&str> {
    let declaration = line.strip_prefix("    ").filter(|line| !line.starts_with([' ', '/', '}', ':']))?;
    let (head, _) = declaration.split_once('(')?;
    let (before, name) = head.rsplit_once([' ', '*', '&'])?;
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_ascii_lowercase() || c == '_');
    // Operators are no names, and `selects` is for iterators to call.
    let is_operator = name == "operator" || before.ends_with("operator");
    (is_name && !is_operator && name != "selects" && !before.starts_with("template")).then_some(name)
}

/// The texts of the C++ headers in a folder, but those that programs see nothing of.
fn headers_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let paths = entries.map(|entry| entry.expect("a folder can be listed to its end").path());
    let headers = paths.filter(|path| path.extension().is_some_and(|extension| extension == "hpp"));
    let inner = ["hidden", "mesh", "points", "reading", "record"].map(|name| format!("cgal/{name}.hpp"));
    let headers = headers.filter(|path| !inner.iter().any(|name| path.ends_with(name)));
    headers.map(|path| fs::read_to_string(path).expect("a header can be read")).collect()
}

/// All programs of a language, one after the other.
fn programs(language: &str) -> String {
    let read = |source| fs::read_to_string(source).expect("a program can be read");
    sources(&format!("ffi-tests/{language}"), language).iter().map(read).collect()
}
