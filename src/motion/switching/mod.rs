//! *Rebuilding + tolerance* (report, section 5.2).

mod commit;
mod state;

pub(super) use state::Switching;
