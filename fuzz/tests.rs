//! The fuzz targets, each on its corpus and on a fixed number of inputs: see README.md.
#![allow(unsafe_code)] // It is the C interface that is called.

#[allow(dead_code)] // The driver takes the rest.
#[path = "src/lib.rs"]
mod targets;

use std::path::Path;
use targets::calls::called;
use targets::driver::{Budget, TARGETS, corpus, counts, drive};

/// Random inputs of each target: some seconds each.
const EXECUTIONS: [u64; 3] = [400_000, 1_500, 8_000];

/// One test, as requests for memory that are refused would be refused to others, too.
#[test]
fn targets_find_nothing_and_call_every_function() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let mut bytes = 0;
    for (target, n) in TARGETS.into_iter().zip(EXECUTIONS) {
        let folder = folder.join(target.name);
        let entries = corpus(&folder);
        assert!(!entries.is_empty(), "no corpus in {}", folder.display());
        bytes += entries.iter().map(|(_, data)| data.len()).sum::<usize>();
        let report = drive(target, Budget::Executions(n), 2026, &folder);
        println!("{}: {} executions in {:.1?}; {}", target.name, report.executions, report.elapsed, counts());
        if let Some(finding) = report.findings.first() {
            panic!("{}: {}\nwith {:?}", target.name, finding.message, finding.data);
        }
    }
    assert!(bytes < 300_000, "the corpus has {bytes} bytes");
    let (declared, called) = (called::names_of_headers(), called::names());
    assert!(declared.len() > 60 && declared.contains("deldrift_create"), "{declared:?}");
    let missing: Vec<_> = declared.difference(&called).collect();
    assert!(missing.is_empty(), "no target calls {missing:?}");
}
