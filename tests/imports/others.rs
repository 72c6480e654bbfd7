//! Which file of the MPI library and of the Python package uses which.

use super::graph::Arrows;
use super::tokens::tokens;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The texts of files, by their names without the ending.
pub type Files = BTreeMap<String, String>;

/// The files of a folder that have an ending.
pub fn read(folder: &str, ending: &str) -> Files {
    let mut files = Files::new();
    for entry in
        fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).expect("a folder of sources")
    {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == ending) {
            let name = path.file_stem().expect("a name").to_str().expect("UTF-8").to_owned();
            files.insert(name, fs::read_to_string(&path).expect("a source file"));
        }
    }
    files
}

/// Between files in C: a function is defined where its name is in a line that begins with its type, and that is no
/// declaration.
pub fn in_c(files: &Files) -> Arrows {
    let is_own = |name: &&str| name.starts_with("dm_") || name.starts_with("deldrift_mpi_");
    let defined = |line: &'_ str| {
        let is_head = line.starts_with(|c: char| c.is_alphabetic()) && !line.ends_with(';');
        let (before, _) = line.split_once('(').filter(|_| is_head)?;
        tokens(before).last().filter(|name| is_own(name)).map(|name| (*name).to_owned())
    };
    let heads = files.iter().flat_map(|(file, text)| text.lines().map(move |line| (file, line)));
    let definers = definers(heads.filter_map(|(file, line)| Some((defined(line)?, file))));
    let mut arrows = Arrows::new();
    for (from, text) in files {
        enter(&mut arrows, from, &definers, tokens(text).into_iter().filter(is_own));
    }
    arrows
}

/// Between modules of a package: by imports, wherever they are, and by calls of methods of `self` that only one module
/// has.
pub fn in_python(files: &Files) -> Arrows {
    let heads =
        files.iter().flat_map(|(file, text)| text.split("\n    def ").skip(1).map(move |rest| (file, rest)));
    let methods = definers(heads.filter_map(|(file, rest)| Some((called(rest)?, file))));
    let mut arrows = Arrows::new();
    for (from, text) in files {
        for line in text.lines().map(str::trim_start) {
            let Some((module, names)) =
                line.strip_prefix("from .").and_then(|rest| rest.split_once(" import "))
            else {
                continue;
            };
            let modules = if module.is_empty() { names.split(", ").collect() } else { vec![module] };
            let own = modules.into_iter().filter(|to| files.contains_key(*to));
            let own: BTreeMap<String, &String> =
                own.map(|to| (to.to_owned(), files.get_key_value(to).expect("it is there").0)).collect();
            enter(&mut arrows, from, &own, own.keys().map(String::as_str));
        }
        let all: Vec<String> = text.split("self.").skip(1).filter_map(called).collect();
        enter(&mut arrows, from, &methods, all.iter().map(String::as_str));
    }
    arrows
}

/// The name before the bracket of arguments that a text begins with.
fn called(text: &str) -> Option<String> {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    text[end..].starts_with('(').then(|| text[..end].to_owned())
}

/// The file that defines each name, of names that only one file defines.
fn definers<'f>(defined: impl Iterator<Item = (String, &'f String)>) -> BTreeMap<String, &'f String> {
    let mut all: BTreeMap<String, BTreeSet<&String>> = BTreeMap::new();
    for (name, file) in defined {
        all.entry(name).or_default().insert(file);
    }
    let only = |(name, files): (String, BTreeSet<&'f String>)| match files.len() {
        1 => files.first().map(|file| (name, *file)),
        _ => None,
    };
    all.into_iter().filter_map(only).collect()
}

/// Enters an arrow for each of these names that another file defines.
fn enter<'n>(
    arrows: &mut Arrows,
    from: &str,
    definers: &BTreeMap<String, &String>,
    names: impl Iterator<Item = &'n str>,
) {
    for name in names {
        if let Some(to) = definers.get(name).filter(|to| **to != from) {
            arrows
                .entry((from.to_owned(), (*to).clone()))
                .or_default()
                .insert(format!("{from} -> {to}: {name}"));
        }
    }
}

#[test]
fn calls_in_c_and_imports_in_python_are_seen() {
    let files =
        |texts: [(&str, &str); 2]| texts.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    let shown = |arrows: Arrows| arrows.into_values().flatten().collect::<Vec<_>>();
    let one = "bool dm_declared(int a);\nbool dm_one(int a) {\n    return dm_two();\n}\n// dm_comment()\n";
    let two = "void dm_two(void) {\n    dm_three(dm_declared);\n}\nstatic int dm_three(void) {}\n";
    assert_eq!(shown(in_c(&files([("one", one), ("two", two)]))), ["one -> two: dm_two"]);
    let one = "from . import _two\nclass One:\n    def first(self): self.second()\n";
    let two = "import os\nclass Two:\n    def second(self):\n        from ._one import One\n        self.second()\n";
    let expected = ["_one -> _two: _two", "_one -> _two: second", "_two -> _one: _one"];
    assert_eq!(shown(in_python(&files([("_one", one), ("_two", two)]))), expected);
}
