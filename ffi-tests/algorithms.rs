//! What is said of algorithms elsewhere: it follows from their rows in src/motion/algorithms.rs, or is compared with
//! them.

use std::collections::BTreeMap;

use deldrift::motion::{Algorithm, Commits, Purpose};

use crate::files::{repository, text_of};

/// The list of the algorithms for the benchmark, and for its page of the report.
pub const LIST: &str = "cpp-bench/src/algorithms.inc";

/// The page with the algorithms of research.
const COMPARISON: &str = "docs/WHICH_ALGORITHM.md";

/// The name of an algorithm in C.
pub fn c_name(algorithm: Algorithm) -> Option<String> {
    let name = algorithm.name().to_uppercase();
    match algorithm.row().purpose {
        Purpose::Use => Some(format!("DELDRIFT_{name}")),
        Purpose::Comparison => Some(format!("DELDRIFT_RESEARCH_{name}")),
        Purpose::Internal => None,
    }
}

/// The text of [`LIST`].
pub fn list() -> String {
    let mut text = String::from(
        "// Made by `make header` from src/motion/algorithms.rs: change it there.
// Name, number, what it is there for, whether it relocates vertices one after the other, whether it keeps anything.
",
    );
    for algorithm in Algorithm::ALL {
        let row = algorithm.row();
        let (name, code) = (row.name, algorithm.code());
        let purpose = match row.purpose {
            Purpose::Use => "for_use",
            Purpose::Comparison => "for_comparison",
            Purpose::Internal => "internal",
        };
        let (one_by_one, keeps) = (row.commits == Commits::OneByOne, !row.keeps.is_empty());
        text += &format!("ALGORITHM({name}, {code}, {purpose}, {one_by_one}, {keeps})\n");
    }
    text
}

/// For the preprocessor: the numbers of all algorithms, and one by one those without a name in C.
pub fn definitions() -> Vec<String> {
    let codes: Vec<String> = Algorithm::ALL.iter().map(|algorithm| algorithm.code().to_string()).collect();
    let mut definitions = vec![format!("-DALL_ALGORITHMS={{{}}}", codes.join(","))];
    for algorithm in Algorithm::ALL.into_iter().filter(|&algorithm| c_name(algorithm).is_none()) {
        definitions.push(format!("-DBY_{}={}", algorithm.name().to_uppercase(), algorithm.code()));
    }
    definitions
}

/// As in prose.
fn title(algorithm: Algorithm) -> String {
    algorithm.name().replace('_', " ").replace("placement flips", "placement with flips")
}

/// The cells of the rows of the tables in a part of a text.
fn rows(text: &str) -> Vec<Vec<&str>> {
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.map(|row| row.split(" | ").collect()).collect()
}

/// What is below a heading.
fn section<'a>(text: &'a str, heading: &str) -> &'a str {
    let (_, below) = text.split_once(&format!("\n## {heading}\n")).expect("the heading is there");
    below.split("\n## ").next().expect("a text has a beginning")
}

#[test]
fn pages_have_a_row_for_every_algorithm_with_a_name_in_c() {
    for (page, heading, purpose) in
        [(COMPARISON, "Algorithms", Purpose::Use), (COMPARISON, "For comparison", Purpose::Comparison)]
    {
        let text = text_of(page);
        let rows = rows(section(&text, heading));
        let first =
            rows.iter().filter_map(|row| row[0].split('`').nth(1)).filter(|name| !name.contains("..."));
        let listed: Vec<String> = first.map(|name| format!("DELDRIFT_{name}")).collect();
        let of_page = Algorithm::ALL.into_iter().filter(|algorithm| algorithm.row().purpose == purpose);
        let named: Vec<String> = of_page.filter_map(c_name).collect();
        assert_eq!(listed, named, "the algorithms in {page}");
    }
}

#[test]
fn changelog_lists_every_algorithm_with_a_name_in_c() {
    let changelog = text_of("CHANGELOG.md");
    for name in Algorithm::ALL.into_iter().filter_map(c_name) {
        assert!(changelog.contains(&format!("`{name}`")), "{name} is missing in CHANGELOG.md");
    }
}

#[test]
fn architecture_tells_where_every_algorithm_is_and_what_it_keeps() {
    let architecture = text_of("docs/ARCHITECTURE.md");
    let rows = rows(section(&architecture, "Where the algorithms are"));
    for algorithm in Algorithm::ALL {
        let title = title(algorithm);
        let row = rows.iter().find(|row| row[0] == title);
        let row = row.unwrap_or_else(|| panic!("docs/ARCHITECTURE.md has no row for {title}"));
        let keeps = algorithm.row().keeps;
        assert_eq!(row[2], if keeps.is_empty() { "-" } else { keeps }, "what {title} keeps");
        let file = row[1].split([',', ':', ';']).next().expect("a file");
        assert!(repository(&format!("src/motion/{file}")).exists(), "{title} is not in {file}");
    }
}

/// How often one algorithm is slower than another in the recorded report, and of how many rows.
fn slower_rows(slow: Algorithm, fast: Algorithm) -> (usize, usize) {
    let report = text_of("cpp-bench/results/report.csv");
    let mut lines = report.lines();
    let columns: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let column = |name| columns.iter().position(|&column| column == name).expect("a column");
    let [engine, algorithm, time] = ["engine", "algorithm", "ns_per_vertex_timestamp"].map(column);
    let input = ["scenario", "first_timestamp", "last_timestamp"].map(column);
    let mut times: BTreeMap<[&str; 3], BTreeMap<&str, f64>> = BTreeMap::new();
    for line in lines {
        let line: Vec<&str> = line.split(',').collect();
        if line[engine] == "deldrift" {
            let taken = line[time].parse().expect("a time");
            times.entry(input.map(|column| line[column])).or_default().insert(line[algorithm], taken);
        }
    }
    let both: Vec<(f64, f64)> =
        times.values().filter_map(|row| Some((*row.get(slow.name())?, *row.get(fast.name())?))).collect();
    (both.iter().filter(|(slow, fast)| slow > fast).count(), both.len())
}

#[test]
fn what_is_said_of_the_recorded_report_is_so() {
    let page = text_of(COMPARISON);
    let page = rows(section(&page, "For comparison"));
    let said = [
        (Algorithm::Placement, Algorithm::PlacementFlips),
        (Algorithm::SafeRegion, Algorithm::Tolerance),
        (Algorithm::SafeRegionTolerance, Algorithm::Tolerance),
        (Algorithm::RebuildingTolerance, Algorithm::Auto),
    ];
    for (slow, fast) in said {
        let (slower, n_rows) = slower_rows(slow, fast);
        let claim = format!("{slower} of {n_rows} rows");
        // Lines are broken anywhere.
        let header = slow.row().documentation.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            header.contains(&claim),
            "{slow:?} is slower than {fast:?} in {claim}: src/motion/algorithms.rs"
        );
        let name = format!("`RESEARCH_{}`", slow.name().to_uppercase());
        let row = page.iter().find(|row| row[0] == name).expect("a row");
        let names_it =
            row.iter().any(|cell| cell.contains(&claim) && cell.contains(&fast.name().to_uppercase()));
        assert!(names_it, "{slow:?} is slower than {fast:?} in {claim}: {COMPARISON}");
    }
    let compared: Vec<Algorithm> =
        Algorithm::ALL.into_iter().filter(|a| a.row().purpose == Purpose::Comparison).collect();
    assert_eq!(compared, said.map(|(slow, _)| slow), "algorithms to compare with");
}
