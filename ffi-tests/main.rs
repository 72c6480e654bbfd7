//! The C boundary, used from C and C++: programs are compiled against `include/`, linked with the
//! library that cargo has just built, and run.
//!
//! | file | what |
//! |---|---|
//! | `header.rs` | the committed header is what the sources say, and compiles as C11 and C++17 |
//! | `abuse.rs` | every function with wrong arguments, from callbacks and other threads, poisoned: docs/ABUSE.md |
//! | `pairs.rs` | every two calls, one after the other, in many states, and every two that read at the same time |
//! | `algorithms.rs` | what is said of algorithms elsewhere is what their rows say |
//! | `programs.rs` | every program under `c/` and `cpp/`, with the shared and with the static library |
//! | `cgal/both.cpp`, `constrained.cpp`, `regular.cpp` | programs for CGAL that write the same with deldrift (ignored) |
//! | `cgal/meshing.cpp` | meshes of domains beside those of CGAL's mesher (`--include-ignored`) |
//! | `cgal/conforming.cpp` | conforming triangulations beside those of CGAL's conformer (`--include-ignored`) |
//! | `cgal/examples` | a script that runs CGAL's own examples with deldrift in its place (`make cgal-examples`) |
//! | `c/faults.c`, `c/limits.c`, `c/memory_bytes.c` | calls for which there is no memory, and how much is held |
//! | `c/environment.c`, `c/stack.c` | calls from foreign floating-point environments, and on little stack |
//! | `checkers.rs` | each checker finds the faults that are planted for it |
//! | `coverage.rs` | every function and every status of the header is used by some program |
//! | `examples.rs` | the examples, with few steps (`--include-ignored`) |
//! | `functions.rs` | docs/FUNCTIONS.md and docs/ERRORS.md name everything in the header |
//! | `pages.rs` | programs, links and commands on the pages |
//! | `warnings.rs` | the headers under many warnings, beside macros of others, without exceptions |
//! | `memory.rs` | the programs under valgrind and under sanitizers (`--include-ignored`) |
//! | `beside.rs` | the installed static library, linked with another one in Rust (`--include-ignored`) |
//! | `installation.rs` | programs that find the library or have it as a part; packages (`--include-ignored`) |

mod abuse;
mod algorithms;
mod beside;
mod bindings;
mod checkers;
mod coverage;
mod examples;
mod files;
mod functions;
mod header;
mod installation;
mod memory;
mod pages;
mod pairs;
mod programs;
mod support;
mod warnings;
