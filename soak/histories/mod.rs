//! Random histories of a triangulation, each a function of its seed: everything that a program may do with moving
//! points, compared with fresh builds after every commit.
#![allow(dead_code, unused_imports)] // The soak uses all, a test a part.

mod family;
mod fingerprint;
mod history;
mod mirror;
mod motion;
mod tally;

use deldrift::{Plane, Space};
pub use fingerprint::mixed;
use history::History;
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
    0xf58e_f678_f2be_767a,
    0xeeff_e23d_7a5b_c73d,
    0x356a_904f_c16a_368b,
    0x3256_4778_9740_6624,
    0x9198_c8b3_1639_849a,
    0xc3f1_4463_7089_4b32,
    0xfec3_7268_bea5_51e8,
    0x1b9a_b2b6_ce91_c8e6,
    0xc997_0970_e4a6_c333,
    0xb39f_ba5d_93bc_33aa,
    0xc288_c5e9_ce07_9fef,
    0xc0d9_ebb2_bf6b_a75e,
    0x8418_2965_25cf_0ad0,
    0x5fda_0b10_4477_ab63,
    0x44eb_d3dc_6b1a_be2f,
    0xa945_25a1_0c62_e243,
    0x6a5f_eedc_cb01_38cd,
    0x96fe_806d_9648_f547,
    0x4f4a_150b_8ea6_9f09,
    0xb7e9_ef8d_435e_977b,
    0xc02a_2aa0_45a9_12bb,
    0x0621_3700_ea11_3645,
    0xd8a7_9948_e0f0_675c,
    0xf07b_f4f8_0585_6f8c,
    0xbe22_6219_d967_d744,
    0xedc1_14bd_8ed9_f100,
    0x3cd9_e48e_e16d_9509,
    0x7325_0633_baff_d4de,
    0xd8f6_2c27_0e9d_0be7,
    0xbab6_9ed9_87bc_7608,
    0xa507_15be_e8a7_7a48,
    0x3705_6973_91d2_d472,
    0xb1aa_8521_fd45_868b,
    0x56d2_9fd1_984d_65cd,
    0x2219_7b1d_8741_adbe,
    0xc3ca_3718_3cf5_b75c,
    0x19de_943c_9e25_d3e7,
    0xaad7_7412_9fe8_6473,
    0xbb69_3ae1_c9c4_85cf,
    0x766f_2eb5_38d2_4258,
];

/// The dimension of the history of a seed.
pub fn dimension_of(seed: u64) -> usize {
    2 + (seed % 2) as usize
}

/// Runs the history of a seed; panics at the first mismatch, with what there is to know about it. A loud one prints
/// what it does before it does it.
pub fn run(seed: u64, is_loud: bool) -> Outcome {
    deldrift::internals::use_all_threads();
    match dimension_of(seed) {
        2 => History::<Plane>::new(seed, is_loud).run(),
        _ => History::<Space>::new(seed, is_loud).run(),
    }
}
