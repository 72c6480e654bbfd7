//! Words of src: comments that can be read alone, and names of types that stand for one thing.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// How a comment does not begin: the noun is in another place then.
const POINTING: [&str; 8] = ["Those", "These", "It", "They", "That", "This", "The same", "Such"];

/// Where comments still begin so, as paths in src.
const POINTING_IN: [&str; 4] = ["capi", "delaunay", "refine", "motion/calls/refining"];

/// How many names stand for several types: fewer is better.
const MOST_SHARED: usize = 16;

/// Reads the sources below a folder: the text of each, by its path in src.
fn read(folder: &Path, path: &str, sources: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let entry = entry.expect("an entry").path();
        let name = entry.file_name().expect("a name").to_str().expect("UTF-8");
        let path = format!("{path}{}{name}", if path.is_empty() { "" } else { "/" });
        if entry.is_dir() {
            read(&entry, &path, sources);
        } else if name.ends_with(".rs") {
            sources.insert(path, fs::read_to_string(&entry).expect("a source file"));
        }
    }
}

fn sources() -> BTreeMap<String, String> {
    let mut sources = BTreeMap::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "", &mut sources);
    assert!(sources.len() > 300, "there are {} files", sources.len());
    sources
}

/// A line of a comment: how it is marked, and its text.
fn comment(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    ["///", "//!", "//"].into_iter().find_map(|mark| line.strip_prefix(mark).map(|text| (mark, text.trim())))
}

/// The first lines of comments, and of their paragraphs, that point to what is elsewhere.
fn pointing(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut before = None;
    for line in text.lines() {
        let now = comment(line);
        let goes_on = before.zip(now).is_some_and(|((mark, text), now): ((_, &str), (_, _))| {
            mark == now.0 && !text.is_empty() && text != "# Errors"
        });
        if let Some((_, text)) = now.filter(|_| !goes_on)
            && POINTING.iter().any(|word| {
                text.strip_prefix(word).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
            })
        {
            found.push(line);
        }
        before = now;
    }
    found
}

/// The name of the type or trait that a line defines. Associated types are named by their traits.
fn defined(line: &str) -> Option<&str> {
    let code = line.trim_start();
    let public = code.strip_prefix("pub").filter(|rest| rest.starts_with([' ', '(']));
    let code = public.map_or(code, |rest| {
        if rest.starts_with('(') { rest.split_once(')').map_or("", |(_, rest)| rest) } else { rest }
    });
    let (kind, rest) = code.trim_start().split_once(' ')?;
    let is_definition =
        ["struct", "enum", "trait", "union"].contains(&kind) || kind == "type" && !line.starts_with(' ');
    rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().filter(|_| is_definition)
}

#[test]
fn comments_can_be_read_alone() {
    let text =
        "/// Those.\n/// That.\n\n// It is.\n/// Items.\n///\n/// The same.\n/// # Errors\n/// Those of x.\n";
    assert_eq!(pointing(text), ["/// Those.", "// It is.", "/// The same.", "/// Those of x."]);
    let found: Vec<String> = sources()
        .iter()
        .filter(|(path, _)| !POINTING_IN.iter().any(|part| path.starts_with(part)))
        .flat_map(|(path, text)| pointing(text).into_iter().map(move |line| format!("src/{path}: {line}")))
        .collect();
    assert!(found.is_empty(), "say what it is about:\n{}", found.join("\n"));
}

/// A file without the machine that it is for.
fn of_any_machine(path: &str) -> String {
    let machines = [
        "/unix", "/windows", "/avx2", "/neon", "/arm32", "/arm64", "/i686", "/s390x", "/unknown", "/wasm",
        "/x86_64",
    ];
    machines.into_iter().fold(path.to_owned(), |path, machine| path.replace(machine, ""))
}

#[test]
fn names_of_types_stand_for_one_thing() {
    let lines =
        ["pub(in crate::motion) struct A<T>(T);", "type A = u8;", "    type B = u8;", "enum A {", "a struct"];
    assert_eq!(lines.map(defined), [Some("A"), Some("A"), None, Some("A"), None]);
    let sources = sources();
    // Files of tests: their names say so, or the file that declares them.
    let is_of_tests = |path: &str| {
        let (folder, file) = path.rsplit_once('/').unwrap_or(("", path));
        let door = sources.get(&format!("{folder}/mod.rs")).or_else(|| sources.get(&format!("{folder}.rs")));
        let declared = format!("#[cfg(test)]\nmod {};", file.trim_end_matches(".rs"));
        path.contains("tests") || door.is_some_and(|door| door.contains(&declared))
    };
    let mut files_of = BTreeMap::<&str, Vec<&str>>::new();
    for (path, text) in sources.iter().filter(|(path, _)| !is_of_tests(path)) {
        let before_tests = text.split("\n#[cfg(test)]\nmod tests").next().expect("there is a first part");
        before_tests
            .lines()
            .filter_map(defined)
            .for_each(|name| files_of.entry(name).or_default().push(path));
    }
    assert!(files_of.len() > 300, "there are {} types", files_of.len());
    // Of files for one machine each, the name stands for what each machine has.
    files_of.values_mut().for_each(|files| files.dedup_by_key(|path| of_any_machine(path)));
    files_of.retain(|_, files| files.len() > 1);
    let shared: Vec<String> =
        files_of.iter().map(|(name, files)| format!("{name}: {}", files.join(" "))).collect();
    assert!(shared.len() <= MOST_SHARED, "{} names for several types:\n{}", shared.len(), shared.join("\n"));
}
