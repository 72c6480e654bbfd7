//! Random histories of a triangulation, each a function of its seed: everything that a program may do with moving
//! points, compared with fresh builds after every commit.
#![allow(dead_code, unused_imports)] // The soak uses all, a test a part.

mod boxes;
mod family;
mod fingerprint;
mod history;
mod log;
mod meshes;
mod mirror;
mod motion;
mod tally;

use boxes::BoxHistory;
use deldrift::{Plane, Space};
pub use fingerprint::mixed;
use history::History;
use meshes::MeshHistory;
pub use tally::Tally;

/// What a history has come to.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    pub tally: Tally,
    /// Of all cells after every commit.
    pub checksum: u64,
}

/// The checksums of the first histories: those of every build, on every processor.
pub const RECORDED: [u64; 40] = [
    0x7cba_23f1_7dd8_7500,
    0xee33_1205_c6f0_7471,
    0x679f_2e25_b316_2e54,
    0xe436_b245_42ba_866c,
    0x5704_0fd7_bd38_5b19,
    0x6f9f_b3c9_825a_b5cf,
    0x50f6_d808_ab8d_6b21,
    0xce6e_0a47_804c_c1fd,
    0xa514_acbc_dd58_6cd6,
    0x2422_75b3_765b_3ca3,
    0x3ead_044c_0a9e_0e3c,
    0xcb76_83d9_1aee_9c2e,
    0x3bd5_4ca0_f184_376b,
    0x9039_2cc2_767c_2b4a,
    0xe565_31e6_773a_3f27,
    0xfa38_5d53_05a1_80ee,
    0x99cf_adec_ffc4_521c,
    0x61f6_80e9_57f3_ffa0,
    0xb9af_5abb_7f30_026d,
    0xac6d_1b9f_027f_ab39,
    0x3cd1_463d_6345_7261,
    0x0621_3700_ea11_3645,
    0x919a_9908_474e_7811,
    0xc376_fb5b_052e_04cb,
    0xf57d_b789_b350_cd04,
    0x3c23_d33d_aba7_4ee5,
    0x87d4_9067_9bef_489c,
    0x94bf_1050_8da2_693d,
    0x023e_c559_982d_bfa4,
    0x11a6_569e_b833_0378,
    0xac25_c71e_8108_e8cc,
    0x7ce4_445d_9344_5b33,
    0xeed2_8a32_5147_e36f,
    0x56d2_9fd1_984d_65cd,
    0x1885_4755_d8be_dde8,
    0x2734_15c8_8372_cf9d,
    0x140e_5fd0_dcb6_1a0a,
    0x3ad0_30fc_176a_370a,
    0xd372_eca3_7f8a_54a8,
    0x2f7a_a99a_a2bc_a67b,
];

/// The dimension of the history of a seed.
pub fn dimension_of(seed: u64) -> usize {
    2 + (seed % 2) as usize
}

/// Whether the history of a seed is one of a box that repeats: one in five behind the recorded ones.
fn is_in_a_box(seed: u64) -> bool {
    seed >= RECORDED.len() as u64 && seed % 5 == 4
}

/// Whether the history of a seed is one of a mesh that lives: one in ten behind the recorded ones, in the plane.
fn is_of_a_mesh(seed: u64) -> bool {
    seed >= RECORDED.len() as u64 && seed % 10 == 2
}

/// Runs the history of a seed; panics at the first mismatch, with what there is to know about it. A loud one prints
/// what it does before it does it.
pub fn run(seed: u64, is_loud: bool) -> Outcome {
    deldrift::internals::use_all_threads();
    match dimension_of(seed) {
        2 if is_in_a_box(seed) => BoxHistory::<Plane>::new(seed, is_loud).run(),
        _ if is_in_a_box(seed) => BoxHistory::<Space>::new(seed, is_loud).run(),
        _ if is_of_a_mesh(seed) => MeshHistory::new(seed, is_loud).run(),
        2 => History::<Plane>::new(seed, is_loud).run(),
        _ => History::<Space>::new(seed, is_loud).run(),
    }
}
