//! The functions of the headers with their parameters.

use std::collections::BTreeSet;

use crate::coverage::declarations as lines_of_code;
use crate::header;
use crate::support::text_of;

/// A parameter: its type, with one space before the stars, and its name.
#[derive(Clone)]
pub struct Parameter {
    pub c_type: String,
    pub name: String,
}

pub struct Declaration {
    /// The path of the header that declares it.
    pub header: &'static str,
    pub name: String,
    pub returns: String,
    pub parameters: Vec<Parameter>,
    documentation: String,
}

impl Declaration {
    pub fn takes_t(&self) -> bool {
        self.parameters
            .first()
            .is_some_and(|parameter| parameter.c_type.ends_with("deldrift_triangulation *"))
    }

    pub fn has(&self, name: &str) -> bool {
        self.parameters.iter().any(|parameter| parameter.name == name)
    }

    pub fn changes_t(&self) -> bool {
        self.takes_t() && !self.parameters[0].c_type.starts_with("const")
    }

    /// Whether the caller learns how many entries there are, also when its buffer has no room for them.
    pub fn tells_count(&self) -> bool {
        let tells = |parameter: &Parameter| parameter.name == "count" && parameter.c_type == "size_t *";
        self.parameters.iter().any(tells)
    }

    /// What the documentation says after "Errors:".
    pub fn errors(&self) -> &str {
        self.documentation.split_once("Errors:").map_or("", |(_, errors)| errors)
    }

    /// The functions that give DELDRIFT_PREPARED, if the documentation lists them.
    pub fn refused_while_prepared(&self) -> Option<&str> {
        let (_, list) = self.documentation.split_once("these calls give DELDRIFT_PREPARED")?;
        list.split_once("All others").map(|(list, _)| list)
    }

    /// The statuses after "Errors:", and those that the first page names for all functions of its kind.
    pub fn documented_statuses(&self) -> BTreeSet<String> {
        let is_pointer = |parameter: &Parameter| parameter.c_type.ends_with('*');
        let rules: [(bool, &[&str]); 3] = [
            (self.parameters.iter().any(is_pointer), &["NULL_ARGUMENT", "MISALIGNED_ARGUMENT"]),
            (self.has("capacity"), &["BUFFER_TOO_SMALL"]),
            (self.takes_t(), &["BUSY", "POISONED", "INTERNAL_ERROR", "PERIODIC", "WEIGHTED"]),
        ];
        let common = rules.iter().filter(|(holds, _)| *holds).flat_map(|(_, names)| *names);
        let common = common.map(|name| format!("DELDRIFT_{name}"));
        let known = statuses();
        let named = self.errors().split(|c: char| !c.is_ascii_alphanumeric() && c != '_').map(str::to_string);
        named.filter(|word| known.contains(word)).chain(common).collect()
    }
}

/// The functions that do not serve a periodic triangulation.
pub fn refused_by_boxes(functions: &[Declaration]) -> BTreeSet<String> {
    refused_as(functions, "deldrift_create_periodic", "DELDRIFT_PERIODIC")
}

/// The functions that do not serve weights.
pub fn refused_by_weights(functions: &[Declaration]) -> BTreeSet<String> {
    refused_as(functions, "deldrift_create_weighted", "DELDRIFT_WEIGHTED")
}

/// The functions that give a status where a triangulation comes of this function, which names them: one header as a whole, and
/// others one by one.
fn refused_as(functions: &[Declaration], creation: &str, status: &str) -> BTreeSet<String> {
    let create = functions.iter().find(|function| function.name == creation);
    let documentation = &create.expect("it is declared").documentation;
    let (_, refused) = documentation.split_once("but those of deldrift/").expect("a header is named");
    let (header, list) =
        refused.split_once(&format!(" and the following, which return {status}: ")).expect("they are listed");
    let header = format!("include/deldrift/{header}");
    let (list, _) = list.split_once(". ").expect("a sentence ends");
    let listed: BTreeSet<String> =
        list.split([',', ' ']).filter(|word| word.starts_with("deldrift_")).map(str::to_string).collect();
    let declared = |name: &&String| functions.iter().all(|function| function.name != **name);
    assert_eq!(listed.iter().find(declared), None, "it is no function");
    let of_header = functions.iter().filter(|function| function.header == header && function.takes_t());
    let of_header: Vec<String> = of_header.map(|function| function.name.clone()).collect();
    assert!(!of_header.is_empty(), "{header} has no function");
    listed.into_iter().chain(of_header).collect()
}

/// The names of the statuses, in the order of their numbers.
pub fn statuses() -> Vec<String> {
    let header = text_of("include/deldrift/core.h");
    let (_, from) = header.split_once("deldrift_status : uint32_t").expect("there are statuses");
    let (statuses, _) = from.split_once("};").expect("an enumeration ends");
    let names = lines_of_code(statuses).filter_map(|line| line.split_once(" = "));
    names.map(|(name, _)| name.to_string()).collect()
}

/// In the order of the headers.
pub fn declarations() -> Vec<Declaration> {
    header::paths().flat_map(declarations_in).collect()
}

fn declarations_in(header: &'static str) -> Vec<Declaration> {
    let text = text_of(header);
    let (_, functions) = text.split_once("extern \"C\" {").expect("functions come after the types");
    let (mut found, mut documentation, mut code) = (Vec::new(), String::new(), String::new());
    let mut is_body = false;
    for line in functions.lines() {
        if let Some(text) = line.strip_prefix("///") {
            documentation += text;
        } else if line == "}" {
            is_body = false;
        } else if !line.starts_with(['#', '}']) && !line.starts_with("// ") && !is_body {
            code = code + line.trim() + " ";
            is_body = line.ends_with('{');
        }
        if code.ends_with("; ") || is_body && !code.is_empty() {
            found.push(declaration(header, &code, &documentation));
            (documentation, code) = Default::default();
        }
    }
    found
}

fn declaration(header: &'static str, code: &str, documentation: &str) -> Declaration {
    let (head, rest) = code.split_once('(').unwrap_or_else(|| panic!("{code} is no function"));
    let (parameters, _) = rest.rsplit_once(')').unwrap_or_else(|| panic!("{code} has no end"));
    let (returns, name) = head.rsplit_once([' ', '*']).unwrap_or_else(|| panic!("{head} has no type"));
    let parameters = parameters.split(',').map(str::trim).filter(|&text| text != "void");
    let parameters = parameters.map(|text| {
        let start = text.rfind([' ', '*']).unwrap_or_else(|| panic!("{text} has no type")) + 1;
        let (c_type, name) = text.split_at(start);
        Parameter { c_type: c_type.trim().to_string(), name: name.to_string() }
    });
    Declaration {
        header,
        name: name.to_string(),
        returns: returns.trim().to_string(),
        parameters: parameters.collect(),
        documentation: documentation.to_string(),
    }
}
