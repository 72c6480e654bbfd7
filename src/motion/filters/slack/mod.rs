//! *Slack*: a tolerance for each bi-cell.

mod entries;
mod pass;
mod slacks;

pub(in crate::motion) use slacks::{Expired, Slacks};
