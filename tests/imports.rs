//! Which file uses which, read from imports and calls: arrows run one way, from floor to floor and within each, in src
//! and in what stands on the library.
//!
//! The rooms of a folder are its files and folders; a file `x.rs` and the folder `x` are one room. An arrow from one
//! room to another says that a file of the first imports an item that a file of the second defines, directly or through
//! a `pub use`, or writes its path out, or calls a method that is defined there, which needs no import. A folder's
//! `mod.rs` is its door and no room: it declares what is inside, and its own items belong to no room. Tests are not read.
//!
//! `cargo test --test library imports:: -- --nocapture` prints the graph, and the types with methods in many files.

mod bodies;
mod calls;
mod crates;
mod graph;
mod others;
mod tokens;

use crates::Sources;
use graph::{circles, upward};

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

/// The floors of the kernel, from the top, each of several rooms.
const KERNEL: [&str; 11] = [
    "build parallel unite restoring copying successor validate cone",
    "relocate remove high_degree wrapping hole segments",
    "flip",
    "sample certify uncertain winding",
    "inserting",
    "cavity settling",
    "star locate straight landmarks covering",
    "plane space cavity_plane cavity_space cavity_marked",
    "around undo changes flat parts order above",
    "geometry exchange flipper lane_tests signs spheres meetings flips",
    "site keys shape facets failures set in_space",
];

/// A type is spread if it has methods in more than this number of files: nobody sees what calls what by opening one.
const FEW: usize = 3;

fn src() -> Sources {
    Sources::read("src")
}

#[test]
fn layers_and_floors_use_only_those_below() {
    let sources = src();
    assert!(sources.n_files() > 100, "there are {} files", sources.n_files());
    let of = |folder: &[&str]| sources.arrows(&folder.iter().map(ToString::to_string).collect::<Vec<_>>());
    let none = Vec::<String>::new();
    assert_eq!(upward(&of(&[]), &LAYERS), none);
    assert_eq!(upward(&of(&["motion"]), &FLOORS), none);
    assert_eq!(upward(&of(&["delaunay"]), &KERNEL), none);
    let text = include_str!("../docs/ARCHITECTURE.md");
    for floor in KERNEL {
        assert!(
            text.lines().any(|line| line.starts_with(&format!("{floor}  "))),
            "no {floor} in ARCHITECTURE.md"
        );
    }
}

#[test]
fn no_folder_of_a_crate_has_a_circle() {
    for root in ["src", "fuzz/src"] {
        let sources = Sources::read(root);
        for (name, n_methods, n_files) in sources.spread(FEW) {
            println!("{root}: {name} has {n_methods} methods in {n_files} files");
        }
        let of = |folder: &Vec<String>| {
            circles(
                &[root].into_iter().chain(folder.iter().map(String::as_str)).collect::<Vec<_>>().join("/"),
                &sources.arrows(folder),
            )
        };
        let found: Vec<String> = sources.folders().iter().flat_map(of).collect();
        assert!(found.is_empty(), "circles in\n{}", found.join("\n"));
    }
}

#[test]
fn no_file_of_mpi_or_the_python_package_is_in_a_circle() {
    for (folder, arrows) in [
        ("mpi/src", others::in_c(&others::read("mpi/src", "c"))),
        ("python/deldrift", others::in_python(&others::read("python/deldrift", "py"))),
    ] {
        assert!(arrows.len() > 50, "{folder}: {} arrows", arrows.len());
        let found = circles(folder, &arrows);
        assert!(found.is_empty(), "circles in\n{}", found.join("\n"));
    }
}

/// The files of a crate, each behind its name.
const FILES: &str = r#"
--- a
use crate::u::U;
pub struct T<G> { pub part: Box<U> }
impl<G> T<G> { fn one(&self) -> Option<&U> {} fn two() -> Self {} }
--- b
use crate::a::T;
impl<'t, G: D<2>> T<G> { fn of_self(&self) { self.two_b::<3>(); Self::two(); } }
--- c
use super::a::T;
impl<G> T<G> { pub fn two_b(&self) { let Self { part, .. } = self; part.first(); } }
--- d
pub use crate::u::U;
use crate::a::*;
fn f(t: &mut crate::a::T<P>) { t.two_b(); t.part.second(); }
--- e
use crate::{a::T, d::{self, U as V}};
pub(in crate::u) fn f() { let t = T::<P>::two(); t.one()?.first(); V::second(); }
--- u
pub struct U;
impl U { fn first(&self) {} }
impl Clone for U { fn no(&self) { "fn no_text("; 'x'; } }
--- v
use crate::u::U;
use std::fs;
// fn no_comment() {}
impl U { fn second() {} }

#[cfg(test)]
mod tests { use crate::e; }
"#;

/// The types whose methods are in many files are found, and calls that a reader finds: by `self`, by a field, by a
/// parameter, by a local value, by what a function returns, and by a type.
#[test]
fn calls_are_those_of_the_types_that_have_the_methods() {
    let sources = src();
    let spread: Vec<String> = sources.spread(FEW).map(|(name, ..)| name).collect();
    for name in
        ["delaunay::Delaunay", "motion::triangulation::MovingTriangulation", "motion::state::mesh::Mesh"]
    {
        assert!(spread.iter().any(|found| found == name), "{name} is not among {spread:?}");
    }
    let texts = FILES.split("--- ").skip(1).filter_map(|file| file.split_once('\n'));
    let texts = texts.map(|(module, text)| (vec![module.to_owned()], text.to_owned()));
    let arrows = Sources::of(&texts.collect()).arrows(&[]);
    let found: Vec<&str> = arrows.values().flatten().map(String::as_str).collect();
    let expected = [
        "a -> u",
        "b -> a",
        "b -> a: T::two",
        "b -> c: T::two_b",
        "c -> a",
        "c -> u: U::first",
        "d -> a",
        "d -> c: T::two_b",
        "d -> u",
        "d -> v: U::second",
        "e -> a",
        "e -> a: T::one",
        "e -> a: T::two",
        "e -> d",
        "e -> u",
        "e -> u: U::first",
        "e -> v: U::second",
        "v -> u",
    ];
    assert_eq!(found, expected);
}
