//! *Repair*: everything moves at once, every certificate is checked, and what has failed is repaired.

mod commit;
mod foresight;
mod places;
mod scratch;
mod taking_back;

pub(super) use foresight::Budget;
pub(super) use scratch::Repair;
