//! Tests of the library from outside, in one program: each program compiles the generic parts of the library again.
//! Only those that need an allocator of their own are apart.

mod asking;
mod at_rest;
mod brute_force;
mod changes;
mod common;
mod editing;
mod even_odd;
mod exact_oracle;
mod exporting;
mod format;
mod geometry;
#[path = "../soak/histories/mod.rs"]
mod histories;
mod imports;
mod keys;
mod last_found;
mod lasting;
mod location;
mod long_runs;
mod maintenance;
mod metamorphic;
mod oracle;
mod passings;
mod predicates;
mod predicates_range;
mod predicates_suites;
mod preparing;
mod reach;
mod refining;
mod regions;
mod repair;
mod same;
mod saving;
mod saving_format;
mod segments;
mod small;
mod splitting;
mod suites;
mod threads;
mod tolerances;
mod transferring;
mod weights;
mod words;
mod work;
