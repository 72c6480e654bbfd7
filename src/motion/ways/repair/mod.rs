//! *Repair*: everything moves at once, every certificate is checked, and what has failed is repaired.

mod commit;
mod foresight;
mod taking_back;
