//! Which file of src uses which, read from its `use` lines: arrows run one way, from floor to floor and within each.
//!
//! The rooms of a folder are its files and folders; a file `x.rs` and the folder `x` are one room. An arrow from one
//! room to another says that a file of the first imports an item that a file of the second defines, directly or through
//! a `pub use`. A folder's `mod.rs` is its door and no room: it declares what is inside, and its own items belong to no
//! room. Tests are not read.
//!
//! Methods of the two types that have them in many files, the triangulation and its mesh, are called without an import:
//! such calls are arrows, too. `cargo test --test library imports:: -- --nocapture` prints the graph.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The layers of src, from the top: each uses only those after it.
const LAYERS: [&str; 14] = [
    "lib",
    "capi",
    "either",
    "periodic",
    "motion",
    "refine",
    "delaunay",
    "complex",
    "predicates",
    "machine",
    "simd",
    "damage",
    "error",
    "ids",
];

/// The floors of motion, from the top.
const FLOORS: [&str; 12] = [
    "reading",
    "calls",
    "ways",
    "triangulation",
    "plan",
    "filters",
    "state",
    "options",
    "constants",
    "algorithms",
    "region_kind",
    "report",
];

/// A module's path below the crate.
type Module = Vec<String>;

/// Types with methods in many files, and how other code gets at one.
const SPREAD: [(&str, &[&str]); 2] =
    [("MovingTriangulation", &["self.", "Self::"]), ("Mesh", &["self.", "self.mesh."])];

/// What a file imports.
#[derive(Default)]
struct Source {
    /// Paths of items from the crate's root on.
    imports: Vec<Module>,
    /// Names that it hands on, and from where.
    handed_on: BTreeMap<String, Module>,
    /// Methods of the types of [`SPREAD`] that it defines, and those that it calls, each with the type.
    defined: BTreeSet<(&'static str, String)>,
    called: BTreeSet<(&'static str, String)>,
}

/// Every module that has a file of its own.
struct Sources(BTreeMap<Module, Source>);

impl Sources {
    fn read() -> Self {
        let mut sources = Sources(BTreeMap::new());
        sources.read_folder(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &Vec::new());
        sources
    }

    fn read_folder(&mut self, folder: &Path, module: &Module) {
        for entry in fs::read_dir(folder).expect("a folder of src") {
            let path = entry.expect("an entry").path();
            let name = path.file_stem().expect("a name").to_str().expect("UTF-8").to_owned();
            let inner = [module.as_slice(), std::slice::from_ref(&name)].concat();
            if path.is_dir() {
                self.read_folder(&path, &inner);
            } else if name != "tests" && path.extension().is_some_and(|extension| extension == "rs") {
                let module = if name == "mod" { module.clone() } else { inner };
                let text = fs::read_to_string(&path).expect("a source file");
                self.0.insert(module.clone(), Source::of(&text, &module));
            }
        }
    }

    /// The module with a file that defines what a path names.
    fn definer(&self, path: &Module) -> Option<Module> {
        let mut path = path.clone();
        // As many steps as there are doors, at most.
        for _ in 0..10 {
            let module =
                (0..=path.len()).rev().map(|n| path[..n].to_vec()).find(|m| self.0.contains_key(m))?;
            let Some(name) = path.get(module.len()) else { return Some(module) };
            match self.0[&module].handed_on.get(name) {
                Some(next) => path = [next.as_slice(), &path[module.len() + 1..]].concat(),
                None => return Some(module),
            }
        }
        panic!("{path:?} is handed on in a circle");
    }

    /// The arrows between the rooms of a folder, each with the files at its ends.
    fn arrows(&self, folder: &[String]) -> BTreeMap<(String, String), BTreeSet<String>> {
        let mut arrows: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        let n = folder.len();
        for (from, source) in self.0.iter().filter(|(m, _)| m.starts_with(folder) && m.len() > n) {
            let used = source.imports.iter().filter_map(|path| self.definer(path));
            for to in used.filter(|to| to.starts_with(folder) && to.len() > n && to[n] != from[n]) {
                let ends = format!("{} -> {}", from[n..].join("/"), to[n..].join("/"));
                arrows.entry((from[n].clone(), to[n].clone())).or_default().insert(ends);
            }
        }
        arrows
    }

    /// The arrows between the rooms of a folder that calls of methods are, each with the files and the method.
    fn calls(&self, folder: &[String]) -> BTreeMap<(String, String), BTreeSet<String>> {
        let mut definers = BTreeMap::new();
        for (module, source) in &self.0 {
            for method in &source.defined {
                assert_eq!(definers.insert(method, module), None, "{method:?} is defined twice");
            }
        }
        let mut arrows: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        let n = folder.len();
        for (from, source) in self.0.iter().filter(|(m, _)| m.starts_with(folder) && m.len() > n) {
            for method in &source.called {
                let Some(to) = definers.get(method).filter(|to| to.starts_with(folder) && to.len() > n)
                else {
                    continue;
                };
                if to[n] != from[n] {
                    let ends = format!("{} -> {}: {}", from[n..].join("/"), to[n..].join("/"), method.1);
                    arrows.entry((from[n].clone(), to[n].clone())).or_default().insert(ends);
                }
            }
        }
        arrows
    }

    /// Every folder that has rooms.
    fn folders(&self) -> BTreeSet<Module> {
        self.0.keys().filter(|m| !m.is_empty()).map(|m| m[..m.len() - 1].to_vec()).collect()
    }
}

impl Source {
    fn of(text: &str, module: &Module) -> Self {
        let mut source = Source::default();
        let code = code_of(text);
        for (name, ways) in SPREAD {
            let head = format!("\nimpl<G: Dimension> {name}<G> {{");
            for block in code.split(&head).skip(1).map(|rest| rest.split("\n}").next().unwrap_or_default()) {
                source.defined.extend(names_after(block, "fn ").map(|method| (name, method)));
                // Within a method `self` is of this type; by another way it is the other one's part.
                source.called.extend(names_after(block, ways[0]).map(|method| (name, method)));
                for (other, ways) in SPREAD {
                    source.called.extend(names_after(block, ways[1]).map(|method| (other, method)));
                }
            }
        }
        for (is_handed_on, tree) in use_trees(&code) {
            for path in leaves(&tree) {
                let Some(absolute) = absolute(&path, module) else { continue };
                let name = path.last().expect("a path has a name").clone();
                if is_handed_on {
                    source.handed_on.insert(name, absolute.clone());
                }
                source.imports.push(absolute);
            }
        }
        source
    }
}

/// A source without comments and without its tests, which are last.
fn code_of(text: &str) -> String {
    let code = text.split("\n#[cfg(test)]\nmod tests").next().expect("there is a first part");
    code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The names that follow a text, and are called or declared.
fn names_after<'c>(code: &'c str, text: &'c str) -> impl Iterator<Item = String> + 'c {
    code.split(text).skip(1).filter_map(|rest| {
        let n = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
        let is_called =
            rest[n..].starts_with('(') || rest[n..].starts_with("::<") || rest[n..].starts_with('<');
        is_called.then(|| rest[..n].to_owned())
    })
}

/// The trees of the `use` declarations, and whether they are handed on.
fn use_trees(code: &str) -> Vec<(bool, String)> {
    let mut trees = Vec::new();
    for declaration in code.split(';').filter_map(|part| part.split("\n\n").last()) {
        let words: Vec<&str> = declaration.split_whitespace().collect();
        if let Some(at) = words.iter().position(|&word| word == "use")
            && words[..at]
                .iter()
                .all(|word| word.starts_with("pub") || word.ends_with(')') || word.starts_with("#["))
        {
            trees
                .push((at > 0 && words[..at].iter().any(|w| w.starts_with("pub")), words[at + 1..].concat()));
        }
    }
    trees
}

/// The paths of a tree.
fn leaves(tree: &str) -> Vec<Module> {
    let Some(brace) = tree.find('{') else {
        return vec![tree.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect()];
    };
    let prefix = leaves(&tree[..brace]).remove(0);
    let inner = &tree[brace + 1..tree.rfind('}').expect("braces close")];
    let mut paths = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (k, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                if start < k {
                    paths.extend(
                        leaves(&inner[start..k]).into_iter().map(|path| [prefix.clone(), path].concat()),
                    );
                }
                start = k + 1;
            }
            _ => {}
        }
    }
    paths
}

/// A path from the crate's root on; `None` for one of another crate. One with no such beginning is of a module inside.
fn absolute(path: &Module, module: &Module) -> Option<Module> {
    match path[0].as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([module.as_slice(), &path[1..]].concat()),
        "super" => {
            let n_up = path.iter().take_while(|part| *part == "super").count();
            Some([&module[..module.len() - n_up], &path[n_up..]].concat())
        }
        "std" | "libc" | "robust" | "crc32fast" | "core" => None,
        _ => Some([module.as_slice(), path].concat()),
    }
}

/// Names of rooms such that each has arrows only to later ones, or the rooms of which each is on a circle.
fn in_order(rooms: BTreeSet<&str>, arrows: &BTreeSet<(&str, &str)>) -> Result<Vec<String>, Vec<String>> {
    let mut left = rooms;
    let mut order = Vec::new();
    while !left.is_empty() {
        let is_used =
            |room: &str| arrows.iter().any(|&(from, to)| to == room && from != room && left.contains(from));
        let Some(next) = left.iter().copied().find(|room| !is_used(room)) else {
            // Those that are only used from a circle are on none.
            while let Some(end) = left.iter().copied().find(|&room| !uses(room, arrows, &left)) {
                left.remove(end);
            }
            return Err(left.into_iter().map(str::to_owned).collect());
        };
        left.remove(next);
        order.push(next.to_owned());
    }
    Ok(order)
}

/// Whether a room has an arrow to one that is left.
fn uses(room: &str, arrows: &BTreeSet<(&str, &str)>, left: &BTreeSet<&str>) -> bool {
    arrows.iter().any(|&(from, to)| from == room && to != room && left.contains(to))
}

/// Arrows that run to an earlier one of these rooms; every room with an arrow is among them.
fn upward(arrows: &BTreeMap<(String, String), BTreeSet<String>>, rooms: &[&str]) -> Vec<String> {
    let at = |room: &str| {
        let at = rooms.iter().position(|r| *r == room);
        at.unwrap_or_else(|| panic!("there is no floor for {room}"))
    };
    arrows.iter().filter(|((from, to), _)| at(from) > at(to)).flat_map(|(_, ends)| ends.clone()).collect()
}

#[test]
fn layers_and_floors_use_only_those_below() {
    let sources = Sources::read();
    assert!(sources.0.len() > 100, "there are {} files", sources.0.len());
    let motion = ["motion".to_owned()];
    assert_eq!(upward(&sources.arrows(&[]), &LAYERS), Vec::<String>::new());
    assert_eq!(upward(&sources.arrows(&motion), &FLOORS), Vec::<String>::new());
    let calls = sources.calls(&motion);
    assert!(calls.len() > 3, "calls are found");
    assert_eq!(upward(&calls, &FLOORS), Vec::<String>::new());
}

#[test]
fn no_folder_has_a_circle() {
    let sources = Sources::read();
    let mut circles = Vec::new();
    for folder in sources.folders() {
        let mut arrows = sources.arrows(&folder);
        for (pair, ends) in sources.calls(&folder) {
            arrows.entry(pair).or_default().extend(ends);
        }
        let pairs: BTreeSet<_> = arrows.keys().map(|(from, to)| (from.as_str(), to.as_str())).collect();
        let rooms = pairs.iter().flat_map(|&(from, to)| [from, to]).collect();
        let name = if folder.is_empty() { "src".to_owned() } else { folder.join("/") };
        match in_order(rooms, &pairs) {
            Ok(order) => println!("{name}: {} arrows; {}", pairs.len(), order.join(" > ")),
            Err(rooms) => {
                let between =
                    |(pair, _): &(&(String, String), _)| rooms.contains(&pair.0) && rooms.contains(&pair.1);
                let ends = arrows.iter().filter(between).flat_map(|(_, ends)| ends.iter().cloned());
                circles.push(format!("{name}:\n  {}", ends.collect::<Vec<_>>().join("\n  ")));
            }
        }
    }
    assert!(circles.is_empty(), "circles among the rooms of\n{}", circles.join("\n"));
}

/// The parser sees every form of import that src has, and the check finds a circle.
#[test]
fn imports_are_read_as_they_are_meant() {
    let text = "//! use no::comment;\npub(in crate::motion) use slack::{Slacks, pass::Pass};\n\nuse super::a::B;\nuse \
                crate::{x, y::{self, Z}};\nuse std::fs;\nfn f() { let x = 1; }\n\n#[cfg(test)]\nmod tests { use q::r; }";
    let module = vec!["motion".to_owned(), "filters".to_owned()];
    let source = Source::of(text, &module);
    let imports: Vec<String> = source.imports.iter().map(|path| path.join("::")).collect();
    let expected = [
        "motion::filters::slack::Slacks",
        "motion::filters::slack::pass::Pass",
        "motion::a::B",
        "x",
        "y::self",
        "y::Z",
    ];
    assert_eq!(imports, expected);
    assert_eq!(source.handed_on.keys().collect::<Vec<_>>(), ["Pass", "Slacks"]);
    let text = "\nimpl<G: Dimension> MovingTriangulation<G> {\n    fn f(&self) {\n        self.g::<2>(self.mesh.h(), self.n);\n \
                   }\n}\n\nfn apart() { self.i() }\n";
    let source = Source::of(text, &module);
    assert_eq!(source.defined, BTreeSet::from([("MovingTriangulation", "f".to_owned())]));
    let called =
        [("MovingTriangulation", "g"), ("Mesh", "h")].map(|(name, method)| (name, method.to_owned()));
    assert_eq!(source.called, BTreeSet::from(called));
    let rooms = || BTreeSet::from(["a", "b", "c"]);
    assert_eq!(
        in_order(rooms(), &BTreeSet::from([("a", "b"), ("b", "c")])),
        Ok(["a", "b", "c"].map(Into::into).to_vec())
    );
    assert!(in_order(rooms(), &BTreeSet::from([("a", "b"), ("b", "c"), ("c", "b")])).is_err());
}
