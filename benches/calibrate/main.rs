//! Measures the constants of `motion::constants`: `make calibrate`.
//!
//! 1. What the parts of a commit cost ([`costs`]), by runs that differ in one count.
//! 2. What thresholds, waits and shares should be ([`constants`]): recorded motions ([`inputs`]) are replayed with each
//!    as it is, and at a quarter, half, twice and four times of that ([`trials`]). Where all commits count the same
//!    there is nothing to time: the constant has decided nothing.
//!
//! Every run is timed commit by commit, all values in turn, several times; for each commit the least counts. The
//! constant as it is takes part twice, and how far these two differ is the noise. The measured value is the one of the
//! least geometric mean of the times of all inputs, and the regret of the present one what that would save; of costs,
//! what has been measured by itself. A regret is negative where the present value is better.
//!
//! ```text
//! cargo bench --bench calibrate [-- [--csv FILE] [NAME...]]
//! ```
//!
//! With names only constants are measured whose names contain one of them. As a test (`cargo test`) everything is run
//! once, on a few points, and nothing is said about it.

#[path = "../../examples/common/mod.rs"]
mod common;
mod constants;
mod costs;
mod inputs;
mod recording;
mod trial;
mod trials;

use constants::Constant;
use deldrift::{Plane, Space};
use inputs::{Input, Size};
use std::fmt::Write;
use trial::Trial;
use trials::Measured;

/// What the command line asks for.
struct Arguments {
    names: Vec<String>,
    csv: Option<String>,
    size: Size,
}

impl Arguments {
    fn read() -> Self {
        let mut arguments = Arguments { names: Vec::new(), csv: None, size: Size::SMALL };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            match word.as_str() {
                // What cargo gives to a benchmark that is to be run.
                "--bench" => arguments.size = Size::FULL,
                "--csv" => arguments.csv = Some(words.next().expect("the name of a file")),
                _ => arguments.names.push(word),
            }
        }
        arguments
    }

    fn wants(&self, constant: &Constant) -> bool {
        self.names.is_empty() || self.names.iter().any(|name| constant.name.contains(name.as_str()))
    }
}

/// Measures the constants that are wanted, and prints a row for each; returns the rows of the file.
fn measure(arguments: &Arguments, constants: &[Constant], inputs: &[Input]) -> String {
    let mut csv = String::new();
    for constant in constants.iter().filter(|constant| arguments.wants(constant)) {
        let measured = Measured::of(constant, inputs, arguments.size.rounds, arguments.size.factors);
        print!("{measured}");
        writeln!(csv, "{}", measured.row()).expect("a string takes all");
    }
    csv
}

/// The constants that the record has no row of. The list of all is made of the fields themselves, so none is missing there.
fn not_on_record(constants: &[Constant]) -> Vec<&'static str> {
    let record = concat!(env!("CARGO_MANIFEST_DIR"), "/cpp-bench/results/calibrate.csv");
    let record = std::fs::read_to_string(record).unwrap_or_default();
    let recorded: Vec<&str> = record.lines().filter_map(|line| line.split(',').nth(1)).collect();
    constants.iter().map(|constant| constant.name).filter(|name| !recorded.contains(name)).collect()
}

fn main() {
    let arguments = Arguments::read();
    let mut csv = format!("{}\n", Measured::COLUMNS);
    println!("{}", Measured::HEADING);
    let (plane, space) = (costs::measure::<Plane>(&arguments.size), costs::measure::<Space>(&arguments.size));
    let not_recorded = not_on_record(&constants::of_dimension(2, &plane));
    if !not_recorded.is_empty() {
        // `make test` repeats it among its last lines.
        eprintln!("SKIPPED calibrate: make calibrate has not measured {}", not_recorded.join(", "));
    }
    let inputs = inputs::of::<Plane>(&arguments.size);
    csv += &measure(&arguments, &constants::of_dimension(2, &plane), &inputs);
    let inputs = inputs::of::<Space>(&arguments.size);
    csv += &measure(&arguments, &constants::of_dimension(3, &space), &inputs);
    Trial::as_is().put_in_force();
    if let Some(path) = &arguments.csv {
        std::fs::write(path, csv).expect("a file to write to");
    }
}
