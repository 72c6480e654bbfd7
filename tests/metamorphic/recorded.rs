//! Checksums of cells, recorded: the same in every build, on every machine, with AVX2 or without.

use super::{FAMILIES, Scenario, options};
use crate::common::CellSet;
use deldrift::motion::Algorithm;
use deldrift::{Dimension, Plane, Space};
use std::process::Command;

/// Of all cells of the scenarios of seeds 0 and 1, in the plane and in space.
const RECORDED: [u64; 2] = [0x0df2_185c_5a55_2384, 0xe05d_2f15_0d12_bbad];

/// Says that a process is the second one.
const SECOND: &str = "DELDRIFT_METAMORPHIC_SECOND";

/// FNV-1a over the numbers of the vertices of all cells in order.
fn add(sum: &mut u64, cells: &CellSet) {
    let mut enter = |number: u32| {
        for byte in number.to_le_bytes() {
            *sum = (*sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    enter(cells.len() as u32);
    cells.iter().flatten().for_each(|v| enter(v.get()));
}

fn checksum<G: Dimension>(algorithm: Algorithm) -> u64 {
    let mut sum = 0xcbf2_9ce4_8422_2325;
    for family in FAMILIES {
        for seed in 0..2 {
            let scenario = Scenario::<G>::new(family, seed);
            scenario.run(options(algorithm)).iter().for_each(|cells| add(&mut sum, cells));
        }
    }
    sum
}

/// Runs twice, the second time without AVX2, or with it if it has been forbidden for this test.
#[test]
fn cells_are_those_of_every_build_with_avx2_and_without() {
    for algorithm in Algorithm::ALL {
        let found = [checksum::<Plane>(algorithm), checksum::<Space>(algorithm)];
        assert_eq!(found, RECORDED, "{algorithm:?}: {found:#018x?}");
    }
    if std::env::var_os(SECOND).is_some() {
        return;
    }
    let name = "metamorphic::recorded::cells_are_those_of_every_build_with_avx2_and_without";
    let mut second = Command::new(std::env::current_exe().expect("this program"));
    second.args(["--exact", name]).env(SECOND, "1");
    match std::env::var_os("DELDRIFT_SCALAR") {
        Some(_) => second.env_remove("DELDRIFT_SCALAR"),
        None => second.env("DELDRIFT_SCALAR", "1"),
    };
    let output = second.output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "{said}");
}
