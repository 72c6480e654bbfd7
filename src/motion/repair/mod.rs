//! *Repair*: everything moves at once, every certificate is checked, and what has failed is repaired.

mod commit;
mod foresight;
mod places;
mod scratch;

pub(super) use foresight::Budget;
pub(super) use scratch::Repair;
