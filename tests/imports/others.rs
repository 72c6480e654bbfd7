//! Which file of mpi and of the Python package uses which: functions of other files that are called, and imports.

use super::graph::Arrows;
use super::tokens::tokens;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The files of a folder with an ending, by their names without it.
pub fn files(folder: &str, ending: &str) -> BTreeMap<String, String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|extension| extension == ending) {
            let name = path.file_stem().expect("a name").to_str().expect("UTF-8").to_owned();
            files.insert(name, fs::read_to_string(&path).expect("a source file"));
        }
    }
    files
}

/// What each file defines that no other one does.
type Definers<'t> = BTreeMap<&'t str, &'t str>;

fn definers<'t>(defined: impl Iterator<Item = (&'t str, &'t str)>) -> Definers<'t> {
    let mut all: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    defined.for_each(|(name, file)| drop(all.entry(name).or_default().insert(file)));
    all.into_iter()
        .filter(|(_, files)| files.len() == 1)
        .map(|(name, files)| (name, *files.first().unwrap()))
        .collect()
}

/// An arrow for each name that a file uses and another one defines.
fn add<'t>(arrows: &mut Arrows, definers: &Definers, from: &str, used: impl Iterator<Item = &'t str>) {
    for name in used {
        if let Some(to) = definers.get(name).filter(|to| **to != from) {
            let ends = arrows.entry((from.to_owned(), (*to).to_owned())).or_default();
            ends.insert(format!("{from} -> {to}: {name}"));
        }
    }
}

/// The arrows between files in C: a function is defined where its name is in a line that begins with its type.
pub fn in_c(files: &BTreeMap<String, String>) -> Arrows {
    let is_own = |name: &&str| name.starts_with("dm_") || name.starts_with("deldrift_mpi_");
    let defined = |text: &'static str| text;
    let _ = defined;
    let definers = definers(files.iter().flat_map(|(file, text)| {
        let heads =
            text.lines().filter(|line| line.starts_with(|c: char| c.is_alphabetic()) && !line.ends_with(';'));
        let names = heads.filter_map(|line| tokens(line.split('(').next()?).last().copied());
        names.filter(is_own).map(move |name| (name, file.as_str()))
    }));
    let mut arrows = Arrows::new();
    for (file, text) in files {
        add(&mut arrows, &definers, file, tokens(text).into_iter().filter(is_own));
    }
    arrows
}

/// The arrows between the modules of a package: imports, wherever they are, and calls of methods that a single module has.
pub fn in_python(files: &BTreeMap<String, String>) -> Arrows {
    let methods = definers(files.iter().flat_map(|(file, text)| {
        text.split("    def ")
            .skip(1)
            .map(move |rest| (rest.split('(').next().unwrap_or_default(), file.as_str()))
    }));
    let mut arrows = Arrows::new();
    for (from, text) in files {
        for line in text.lines().map(str::trim_start) {
            let Some((module, names)) =
                line.strip_prefix("from .").and_then(|rest| rest.split_once(" import "))
            else {
                continue;
            };
            let modules = if module.is_empty() { names.split(", ").collect() } else { vec![module] };
            for to in modules.into_iter().filter(|to| files.contains_key(*to)) {
                let ends = arrows.entry((from.clone(), to.to_owned())).or_default();
                ends.insert(format!("{from} -> {to}"));
            }
        }
        let called = text.split("self.").skip(1).filter_map(|rest| {
            let n = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
            rest[n..].starts_with('(').then_some(&rest[..n])
        });
        add(&mut arrows, &methods, from, called);
    }
    arrows
}
