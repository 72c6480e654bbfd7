//! Runs the targets without any other tool: see README.md.

use deldrift_fuzz::driver::{
    Budget, Report, TARGETS, Target, corpus, counts, drive, failure, hearing, save_on_signal, shrunk,
};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

const USAGE: &str = "usage: drive TARGET [--seconds S | --executions N] [--seed K]
       drive TARGET --replay FILE...
       drive TARGET --shrink FILE
TARGET is predicates, calls or loaders.";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match work(&arguments) {
        Ok(code) => code,
        Err(message) => {
            eprintln!("{message}\n{USAGE}");
            ExitCode::FAILURE
        }
    }
}

fn work(arguments: &[String]) -> Result<ExitCode, String> {
    let name = arguments.first().ok_or("no target")?;
    let target = *TARGETS.iter().find(|target| target.name == name).ok_or("no such target")?;
    if arguments.get(1).is_some_and(|option| option == "--replay") {
        return replay(target, &arguments[2..]);
    }
    if let [_, option, path] = arguments
        && option == "--shrink"
    {
        let data = fs::read(path).map_err(|error| format!("{path}: {error}"))?;
        let small = shrunk(target, &data);
        let to = format!("{path}-small");
        fs::write(&to, &small).map_err(|error| format!("{to}: {error}"))?;
        println!("{} of {} bytes are left, in {to}", small.len(), data.len());
        return Ok(ExitCode::SUCCESS);
    }
    let (mut budget, mut seed) = (Budget::Seconds(60.0), 1);
    for pair in arguments[1..].chunks(2) {
        let [option, value] = pair else { return Err(format!("{} needs a value", pair[0])) };
        let bad = || format!("{option} cannot be {value}");
        match option.as_str() {
            "--seconds" => budget = Budget::Seconds(value.parse().map_err(|_| bad())?),
            "--executions" => budget = Budget::Executions(value.parse().map_err(|_| bad())?),
            "--seed" => seed = value.parse().map_err(|_| bad())?,
            _ => return Err(format!("no option {option}")),
        }
    }
    let folder = findings_folder();
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    save_on_signal(&folder.join(format!("{}-{seed}-signal", target.name)));
    let report = drive(target, budget, seed, &corpus_folder(target));
    tell(target, seed, &report, &folder)
}

fn tell(target: Target, seed: u64, report: &Report, folder: &Path) -> Result<ExitCode, String> {
    let seconds = report.elapsed.as_secs_f64();
    println!(
        "{}, seed {seed}: {} executions in {seconds:.1} s ({:.0} a second), {} of them of the corpus",
        target.name,
        report.executions,
        report.executions as f64 / seconds,
        report.replayed
    );
    println!("{}", counts());
    for (k, finding) in report.findings.iter().enumerate() {
        let path = folder.join(format!("{}-{seed}-{k}", target.name));
        fs::write(&path, &finding.data).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("finding: {}", finding.message);
        println!(
            "to replay it: cargo run --release --bin drive -- {} --replay {}",
            target.name,
            path.display()
        );
    }
    println!("{} findings", report.findings.len());
    Ok(if report.findings.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Runs files one by one, and says what is wrong. Without any, the corpus.
fn replay(target: Target, paths: &[String]) -> Result<ExitCode, String> {
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    for path in paths {
        let data = fs::read(path).map_err(|error| format!("{path}: {error}"))?;
        files.push((path.into(), data));
    }
    if files.is_empty() {
        files = corpus(&corpus_folder(target));
    }
    let mut code = ExitCode::SUCCESS;
    for (path, data) in files {
        match hearing(|| failure(target, &data)) {
            None => println!("{}: nothing", path.display()),
            Some(message) => {
                println!("{}: {message}", path.display());
                code = ExitCode::FAILURE;
            }
        }
    }
    println!("{}", counts());
    Ok(code)
}

fn corpus_folder(target: Target) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target.name)
}

fn findings_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("findings")
}
