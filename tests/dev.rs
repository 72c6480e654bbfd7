//! Temporary.
mod common;
mod transferring;
