//! Fuzz targets with oracles. Each is a plain function of some bytes, which panics where the library is wrong:
//! libFuzzer calls it (`fuzz_targets`), and so does the driver, which needs no other tool (`driver`).
#![allow(unsafe_code)] // It is the C interface that is called.

pub mod allocator;
pub mod calls;
pub mod driver;
#[path = "../../tests/exact_oracle/mod.rs"]
mod exact_oracle;
pub mod loaders;
#[path = "../../tests/common/passing_by_roots.rs"]
mod passing_by_roots;
pub mod predicates;
pub mod source;
pub mod tally;
