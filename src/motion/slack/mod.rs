//! *Slack*: a tolerance for each bi-cell.

mod commit;
mod entries;
mod pass;
mod slacks;

pub(super) use slacks::Slacks;
