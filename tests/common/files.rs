//! Readers for the real inputs that may lie beside this package: JSON and NumPy arrays.

use super::skipped;
use std::fs;
use std::path::PathBuf;

/// A file of the data folder; `None`, with a note, where it is absent.
fn path_of(name: &str) -> Option<PathBuf> {
    let shared = std::env::var_os("DELDRIFT_SHARED")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared")), PathBuf::from);
    let path = shared.join("data").join(name);
    if !path.is_file() {
        skipped(name, &format!("there is no {}", path.display()));
        return None;
    }
    Some(path)
}

pub fn text(name: &str) -> Option<String> {
    path_of(name).map(|path| fs::read_to_string(path).expect(name))
}

/// A two-dimensional array of doubles.
pub fn npy(name: &str) -> Option<Vec<Vec<f64>>> {
    let bytes = path_of(name).map(|path| fs::read(path).expect(name))?;
    let n_header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (header, data) = bytes[10..].split_at(n_header);
    let header = std::str::from_utf8(header).expect("a header");
    assert!(header.contains("'<f8'") && header.contains("'fortran_order': False"), "{header}");
    let shape = header.split(['(', ')']).nth(1).expect("a shape");
    let columns: usize = shape.split(',').nth(1).expect("two dimensions").trim().parse().expect("a number");
    let values: Vec<f64> =
        data.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes"))).collect();
    Some(values.chunks_exact(columns).map(<[f64]>::to_vec).collect())
}

/// A JSON value; object entries in order.
#[derive(Debug)]
pub enum Json {
    Number(f64),
    Text(String),
    Truth(bool),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

impl Json {
    /// Reads a value; escapes in strings are kept as they are.
    pub fn parse(text: &str) -> Json {
        let mut rest = text;
        let value = parse(&mut rest);
        assert!(rest.trim().is_empty(), "{rest:.50}");
        value
    }

    pub fn get(&self, key: &str) -> Option<&Json> {
        match self {
            Json::Object(entries) => entries.iter().find(|(k, _)| k == key).map(|(_, value)| value),
            _ => None,
        }
    }

    pub fn list(&self) -> &[Json] {
        match self {
            Json::List(items) => items,
            other => panic!("not a list: {other:?}"),
        }
    }

    pub fn number(&self) -> f64 {
        match self {
            Json::Number(x) => *x,
            other => panic!("not a number: {other:?}"),
        }
    }

    pub fn text(&self) -> &str {
        match self {
            Json::Text(text) => text,
            other => panic!("not a string: {other:?}"),
        }
    }

    /// A list of lists of numbers.
    pub fn table(&self) -> Vec<Vec<f64>> {
        self.list().iter().map(|row| row.list().iter().map(Json::number).collect()).collect()
    }
}

fn is_next(rest: &mut &str, token: &str) -> bool {
    *rest = rest.trim_start();
    match rest.strip_prefix(token) {
        Some(after) => {
            *rest = after;
            true
        }
        None => false,
    }
}

fn parse(rest: &mut &str) -> Json {
    if is_next(rest, "[") {
        let mut items = Vec::new();
        while !is_next(rest, "]") {
            items.push(parse(rest));
            is_next(rest, ",");
        }
        return Json::List(items);
    }
    if is_next(rest, "{") {
        let mut entries = Vec::new();
        while !is_next(rest, "}") {
            let Json::Text(key) = parse(rest) else { panic!("no key: {rest:.50}") };
            assert!(is_next(rest, ":"), "{rest:.50}");
            entries.push((key, parse(rest)));
            is_next(rest, ",");
        }
        return Json::Object(entries);
    }
    if is_next(rest, "\"") {
        let mut is_escaped = false;
        let is_end = |c: char| {
            let ends = c == '"' && !is_escaped;
            is_escaped = c == '\\' && !is_escaped;
            ends
        };
        let end = rest.find(is_end).expect("the end of a string");
        let text = rest[..end].to_string();
        *rest = &rest[end + 1..];
        return Json::Text(text);
    }
    for (token, truth) in [("true", true), ("false", false)] {
        if is_next(rest, token) {
            return Json::Truth(truth);
        }
    }
    let end = rest.find([',', ']', '}', ' ', '\n', '\r', '\t']).unwrap_or(rest.len());
    let number = rest[..end].parse().unwrap_or_else(|_| panic!("not a value: {rest:.50}"));
    *rest = &rest[end..];
    Json::Number(number)
}
