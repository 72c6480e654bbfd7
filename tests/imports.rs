//! Which file of src uses which, read from its `use` lines.
mod calls;
mod crates;
mod graph;
mod others;
mod tokens;

use crates::Sources;
use graph::circles;
use std::path::Path;

fn src() -> Sources {
    Sources::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")))
}

#[test]
fn others() {
    let c = circles("mpi/src", &others::in_c(&others::files("mpi/src", "c")));
    let d = circles("python/deldrift", &others::in_python(&others::files("python/deldrift", "py")));
    assert!(c.is_empty() && d.is_empty(), "{}\n{}", c.join("\n"), d.join("\n"));
}

#[test]
fn fuzz() {
    let sources = Sources::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/fuzz/src")));
    let c: Vec<_> = sources
        .folders()
        .iter()
        .flat_map(|f| circles(&format!("fuzz/{}", f.join("/")), &sources.arrows(f)))
        .collect();
    assert!(c.is_empty(), "{}", c.join("\n"));
}

#[test]
fn no_folder_has_a_circle() {
    let sources = src();
    for (ty, m, n) in sources.spread(3) {
        println!("{}::{} {m} methods in {n} files", ty.0.join("::"), ty.1);
    }
    let circles: Vec<_> = sources
        .folders()
        .iter()
        .flat_map(|folder| {
            let name = if folder.is_empty() { "src".to_owned() } else { folder.join("/") };
            circles(&name, &sources.arrows(folder))
        })
        .collect();
    assert!(circles.is_empty(), "circles among the rooms of\n{}", circles.join("\n"));
}
