//! The small oracles alone, for `make quick`: against fresh builds and against the definition; and the way that imports
//! run. tests/main.rs has them, too.

mod brute_force;
mod common;
mod imports;
mod small;
