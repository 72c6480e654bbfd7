//! `deldrift-mutants SOURCES TARGET PLAN FOLDER...` rewrites the modules FOLDER of the crate in SOURCES, in place of
//! those in TARGET. An expression that a mutant changes becomes `if on(ID) { changed } else { expression }`, so that
//! one build has all mutants, and a number in the environment says which of them is alive.
//!
//! PLAN names the ids to leave out, one a line (`-` for none). Printed are the mutants, one a line: id, file, line,
//! function and change, separated by tabs, and last how many were skipped because they are in constant expressions,
//! where nothing can be decided at run time.

mod edits;
mod mutators;

use std::collections::HashSet;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use mutators::Mutators;
use syn::visit::Visit;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = env::args().collect();
    let [_, sources, target, plan, folders @ ..] = &arguments[..] else {
        return Err("usage: deldrift-mutants SOURCES TARGET PLAN FOLDER...".into());
    };
    let mut run = Run { sources: sources.into(), target: target.into(), ..Run::default() };
    if plan != "-" {
        run.left_out = fs::read_to_string(plan)?.lines().map(str::parse).collect::<Result<_, _>>()?;
    }
    for folder in folders {
        run.file(&PathBuf::from(format!("src/{folder}/mod.rs")))?;
    }
    println!("skipped in constant expressions\t{}", run.skipped);
    Ok(())
}

#[derive(Default)]
struct Run {
    sources: PathBuf,
    target: PathBuf,
    left_out: HashSet<u32>,
    n_mutants: u32,
    skipped: usize,
}

impl Run {
    /// Rewrites one file and the modules that it declares.
    fn file(&mut self, name: &Path) -> Outcome<()> {
        let text = fs::read_to_string(self.sources.join(name))?;
        let parsed = syn::parse_file(&text)?;
        let mut mutators = Mutators::new(&text, self.n_mutants);
        mutators.visit_file(&parsed);
        for mutant in &mutators.mutants {
            let (line, function, change) = (mutant.line, &mutant.function, &mutant.change);
            println!("{}\t{}\t{line}\t{function}\t{change}", mutant.id, name.display());
        }
        self.n_mutants += u32::try_from(mutators.mutants.len())?;
        self.skipped += mutators.skipped;
        fs::write(self.target.join(name), mutators.edits.applied_to(&text, &self.left_out))?;
        for module in modules(&parsed) {
            self.file(&path_of(&self.sources, name, &module)?)?;
        }
        Ok(())
    }
}

/// The modules in files of their own, without those for tests.
fn modules(file: &syn::File) -> Vec<String> {
    let in_a_file = |item: &syn::Item| match item {
        syn::Item::Mod(module) if module.content.is_none() && !mutators::is_for_tests(&module.attrs) => {
            Some(module.ident.to_string())
        }
        _ => None,
    };
    file.items.iter().filter_map(in_a_file).collect()
}

fn path_of(sources: &Path, parent: &Path, module: &str) -> Outcome<PathBuf> {
    let folder =
        if parent.ends_with("mod.rs") { parent.with_file_name("") } else { parent.with_extension("") };
    let candidates = [folder.join(format!("{module}.rs")), folder.join(module).join("mod.rs")];
    let found = candidates.into_iter().find(|candidate| sources.join(candidate).is_file());
    found.ok_or_else(|| format!("no file for module {module} of {}", parent.display()).into())
}
