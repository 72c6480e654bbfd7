//! What the pages show can be done as it stands there: programs compile alone, links lead to something, commands name
//! files and targets of make that are there after a clone.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{compiler, fresh_folder, repository, sources, succeed, text_of};

/// Pages for people.
fn pages() -> Vec<String> {
    let root = repository("");
    let paths = ["", "docs", "compat", "cpp-bench", "cpp-bench/report", "fuzz"]
        .into_iter()
        .flat_map(|folder| sources(folder, "md"));
    let name =
        |path: PathBuf| path.strip_prefix(&root).expect("it is in the repository").display().to_string();
    let pages: Vec<String> = paths.map(name).collect();
    assert!(pages.len() > 10, "{pages:?}");
    pages
}

/// The blocks of a page in one of the languages: the number of the first line, and the text.
fn blocks(page: &str, languages: &[&str]) -> Vec<(usize, String)> {
    let text = text_of(page);
    let mut blocks: Vec<(usize, String)> = Vec::new();
    let mut is_inside = false;
    for (number, line) in text.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if is_inside => is_inside = false,
            Some(language) if languages.contains(&language) => {
                is_inside = true;
                blocks.push((number + 2, String::new()));
            }
            _ if is_inside => {
                *blocks.last_mut().map(|(_, text)| text).expect("one is open") += &format!("{line}\n")
            }
            _ => {}
        }
    }
    blocks
}

#[test]
fn programs_on_pages_compile_alone() {
    assert!(compile_blocks("pages", |text| !text.contains("#include <CGAL/")) >= 4);
}

#[test]
#[ignore = "needs CGAL"]
fn programs_on_pages_compile_with_cgal() {
    assert!(compile_blocks("pages_with_cgal", |text| text.contains("#include <CGAL/")) >= 1);
}

/// Compiles the blocks that are chosen; how many.
fn compile_blocks(name: &str, is_chosen: impl Fn(&str) -> bool) -> usize {
    let folder = fresh_folder(name);
    let mut n_compiled = 0;
    for page in pages() {
        for (language, extension) in [("c", "c"), ("cpp", "cpp")] {
            for (line, text) in blocks(&page, &[language]) {
                if is_chosen(&text) {
                    let source = folder.join(format!("{}_{line}.{extension}", page.replace(['/', '.'], "_")));
                    fs::write(&source, &text).expect("a source can be written");
                    // CGAL's headers have warnings of their own.
                    let warnings = if text.contains("#include <CGAL/") { "-w" } else { "-Wall" };
                    succeed(compiler(&source).args([warnings, "-fsyntax-only"]).arg(&source));
                    n_compiled += 1;
                }
            }
        }
    }
    n_compiled
}

#[test]
fn links_lead_to_files_and_headings() {
    let (mut n_links, mut wrong) = (0, Vec::new());
    for page in pages() {
        let text = text_of(&page);
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.contains("://") || link.contains(' ') {
                continue;
            }
            n_links += 1;
            let (path, heading) = link.split_once('#').unwrap_or((link, ""));
            let folder = Path::new(&page).parent().expect("a page is in a folder");
            let target = if path.is_empty() { page.clone().into() } else { folder.join(path) };
            let target = repository(target.to_str().expect("paths are UTF-8"));
            let is_there = target.exists() && (heading.is_empty() || has_heading(&target, heading));
            if !is_there {
                wrong.push(format!("{page}: {link}"));
            }
        }
    }
    assert!(n_links > 100 && wrong.is_empty(), "{n_links} links; these lead nowhere: {wrong:#?}");
}

fn has_heading(page: &Path, anchor: &str) -> bool {
    let text = fs::read_to_string(page).expect("a page can be read");
    let is_kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let anchor_of = |line: &str| {
        line.trim_start_matches('#')
            .trim()
            .to_lowercase()
            .chars()
            .filter(is_kept)
            .collect::<String>()
            .replace(' ', "-")
    };
    text.lines().any(|line| line.starts_with('#') && anchor_of(line) == anchor)
}

/// Commands within sentences.
#[test]
fn targets_of_make_are_there() {
    let makefile = text_of("Makefile");
    let mut n_targets = 0;
    for page in pages().iter().filter(|page| *page != "CHANGELOG.md") {
        let text = text_of(page);
        for command in text.split('`').skip(1).step_by(2).filter(|span| span.starts_with("make ")) {
            let targets = command.split_whitespace().skip(1).take_while(|word| !word.contains('='));
            for target in targets {
                n_targets += 1;
                assert!(makefile.contains(&format!("\n{target}:")), "{page}: {command}");
            }
        }
    }
    assert!(n_targets > 30, "{n_targets}");
}

/// Words with a slash are files of the repository, unless they are made by a command before, or are elsewhere.
#[test]
fn commands_name_what_is_there() {
    let makefile = text_of("Makefile");
    let (mut n_targets, mut n_paths, mut wrong) = (0, 0, Vec::new());
    for page in pages() {
        for (line, block) in blocks(&page, &["sh"]) {
            let mut folder = String::from(".");
            for command in block.lines().map(|line| line.split(" #").next().unwrap_or(line)) {
                let words: Vec<&str> = command.split_whitespace().collect();
                match words[..] {
                    ["cd", to] => folder = to.to_string(),
                    ["make", target, ..] => {
                        n_targets += 1;
                        if !makefile.contains(&format!("\n{target}:")) {
                            wrong.push(format!("{page}:{line}: make {target}"));
                        }
                    }
                    _ => {}
                }
                for word in words.iter().filter(|word| is_path(word)) {
                    n_paths += 1;
                    if !repository(&folder).join(word).exists() {
                        wrong.push(format!("{page}:{line}: {word}"));
                    }
                }
            }
        }
    }
    assert!(n_targets > 5 && n_paths > 10 && wrong.is_empty(), "{n_targets}, {n_paths}; missing: {wrong:#?}");
}

fn is_path(word: &str) -> bool {
    let made = ["build/", "cpp-bench/build", "target/", "./"];
    word.contains('/')
        && !word.contains(['$', '=', ':', '<'])
        && !word.starts_with(['-', '/'])
        && !made.iter().any(|prefix| word.starts_with(prefix))
}
