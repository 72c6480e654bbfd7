//! The sources of a crate: what each file defines, imports and calls.

use super::calls::{self, Method, Methods};
use super::graph::Arrows;
use super::tokens::{Tokens, before_tests, behind, is_name, tokens};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// A module's path below the crate.
pub type Module = Vec<String>;

/// What a file has.
#[derive(Default)]
pub struct Source {
    /// Paths of items that it imports, from the crate's root on, by their names here.
    pub names: BTreeMap<String, Module>,
    /// Paths that are written out where they are used, and of imports without a name.
    paths: Vec<Module>,
    /// The methods that it calls.
    called: BTreeSet<Method>,
}

/// Every module of a crate that has a file of its own.
#[derive(Default)]
pub struct Sources {
    pub files: BTreeMap<Module, Source>,
    /// The files that define methods of a type, by the method.
    methods: Methods,
}

impl Sources {
    /// Reads the crate whose root is this folder.
    pub fn read(folder: &str) -> Self {
        let mut texts = BTreeMap::new();
        read_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &Module::new(), &mut texts);
        Self::of(&texts)
    }

    /// The sources of these texts.
    pub fn of(texts: &BTreeMap<Module, String>) -> Self {
        let tokens: BTreeMap<&Module, Tokens> =
            texts.iter().map(|(module, text)| (module, tokens(before_tests(text)))).collect();
        let mut sources = Sources::default();
        for (&module, tokens) in &tokens {
            sources.files.insert(module.clone(), Source::of(tokens, module));
        }
        let (methods, called) = calls::of(&tokens, &sources);
        sources.methods = methods;
        for (module, called) in called {
            sources.files.get_mut(module).expect("it has been read").called = called;
        }
        sources
    }

    /// The types with methods in more than this number of files: the path of each, how many methods, in how many files.
    pub fn spread(&self, n_files: usize) -> impl Iterator<Item = (String, usize, usize)> {
        let all = self.methods.iter().map(|((module, name), methods)| {
            let path = [module.as_slice(), std::slice::from_ref(name)].concat().join("::");
            (path, methods.len(), calls::n_files(methods))
        });
        all.filter(move |&(_, _, n)| n > n_files)
    }

    pub fn n_files(&self) -> usize {
        self.files.len()
    }

    /// The module with a file that defines what a path names, and the rest of the path.
    pub fn definer(&self, path: &[String]) -> Option<(Module, Module)> {
        let mut path = path.to_vec();
        // As many steps as there are doors, at most.
        for _ in 0..10 {
            let module =
                (0..=path.len()).rev().map(|n| path[..n].to_vec()).find(|m| self.files.contains_key(m))?;
            let rest = path[module.len()..].to_vec();
            let Some(name) = rest.first() else { return Some((module, rest)) };
            match self.files[&module].names.get(name) {
                // A macro is handed on by its own name.
                Some(next) if *next != path[..=module.len()] => path = [next.as_slice(), &rest[1..]].concat(),
                _ => return Some((module, rest)),
            }
        }
        panic!("{path:?} is handed on in a circle");
    }

    /// The arrows between the rooms of a folder, each with the files at its ends and the method, if it is a call.
    pub fn arrows(&self, folder: &[String]) -> Arrows {
        let mut arrows = Arrows::new();
        let n = folder.len();
        let is_inside = |m: &Module| m.starts_with(folder) && m.len() > n;
        for (from, source) in self.files.iter().filter(|(m, _)| is_inside(m)) {
            let imports = source.names.values().chain(&source.paths).filter_map(|path| self.definer(path));
            let imports = imports.map(|(to, _)| (to, String::new()));
            let called = source.called.iter().flat_map(|(ty, method)| {
                self.methods[ty][method].iter().map(move |to| (to.clone(), format!(": {}::{method}", ty.1)))
            });
            for (to, how) in imports.chain(called).filter(|(to, _)| is_inside(to) && to[n] != from[n]) {
                let ends = format!("{} -> {}{how}", from[n..].join("/"), to[n..].join("/"));
                arrows.entry((from[n].clone(), to[n].clone())).or_default().insert(ends);
            }
        }
        arrows
    }

    /// Every folder that has rooms.
    pub fn folders(&self) -> BTreeSet<Module> {
        self.files.keys().filter(|m| !m.is_empty()).map(|m| m[..m.len() - 1].to_vec()).collect()
    }
}

fn read_folder(folder: &Path, module: &Module, texts: &mut BTreeMap<Module, String>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_str().expect("UTF-8").to_owned();
        let inner = [module.as_slice(), std::slice::from_ref(&name)].concat();
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            read_folder(&path, &inner, texts);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let module = if name == "mod" { module.clone() } else { inner };
            texts.insert(module, fs::read_to_string(&path).expect("a source file"));
        }
    }
}

impl Source {
    fn of(tokens: &[&str], module: &Module) -> Self {
        let mut source = Source::default();
        let mut at = 0;
        while at < tokens.len() {
            if tokens[at] == "use" && tokens[at + 1] != "<" {
                let end = at + tokens[at..].iter().position(|&t| t == ";").expect("a declaration ends");
                for (name, path) in leaves(&tokens[at + 1..end]) {
                    match (absolute(&path, module), is_name(&name) && name != "_") {
                        (Some(path), true) => drop(source.names.insert(name, path)),
                        (Some(path), false) => source.paths.push(path),
                        (None, _) => {}
                    }
                }
                at = end;
            } else if is_start_of_path(tokens, at) {
                let path = path_at(tokens, &mut at);
                source.paths.extend(absolute(&path, module));
            }
            at += 1;
        }
        source
    }
}

/// Whether a path from the root or a module above begins at a token, and is not that for which something is visible.
fn is_start_of_path(tokens: &[&str], at: usize) -> bool {
    ["crate", "super", "self"].contains(&tokens[at])
        && tokens.get(at + 1) == Some(&"::")
        && tokens[at.saturating_sub(2)..at] != ["(", "in"]
}

/// The path that begins at a token; `at` becomes the last one of it.
fn path_at(tokens: &[&str], at: &mut usize) -> Module {
    let mut path = vec![tokens[*at].to_owned()];
    while tokens.get(*at + 1) == Some(&"::") && tokens.get(*at + 2).is_some_and(|t| is_name(t)) {
        *at += 2;
        path.push(tokens[*at].to_owned());
    }
    path
}

/// The paths of a tree of imports, and the name of each here.
fn leaves(tree: &[&str]) -> Vec<(String, Module)> {
    let mut at = 0;
    let mut prefix = Module::new();
    while at < tree.len() && tree[at] != "{" {
        match tree[at] {
            "as" => return vec![(tree[at + 1].to_owned(), prefix)],
            "::" => {}
            name => prefix.push(name.to_owned()),
        }
        at += 1;
    }
    if at == tree.len() {
        if prefix.len() > 1 && prefix.last().is_some_and(|last| last == "self") {
            prefix.pop();
        }
        return prefix.last().cloned().map(|name| (name, prefix)).into_iter().collect();
    }
    let end = behind(tree, at) - 1;
    let mut paths = Vec::new();
    let mut start = at + 1;
    while start < end {
        let mut stop = start;
        while stop < end && tree[stop] != "," {
            stop = if tree[stop] == "{" { behind(tree, stop) } else { stop + 1 };
        }
        let inner = leaves(
            &[prefix.iter().map(String::as_str).collect::<Vec<_>>().as_slice(), &tree[start..stop]].concat(),
        );
        paths.extend(inner);
        start = stop + 1;
    }
    paths
}

/// A path from the crate's root on; `None` for one of another crate. One with no such beginning is of a module inside.
pub fn absolute(path: &[String], module: &[String]) -> Option<Module> {
    match path[0].as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([module, &path[1..]].concat()),
        "super" => {
            let n_up = path.iter().take_while(|part| *part == "super").count();
            Some([&module[..module.len() - n_up], &path[n_up..]].concat())
        }
        "std" | "libc" | "robust" | "crc32fast" | "core" => None,
        _ => Some([module, path].concat()),
    }
}
