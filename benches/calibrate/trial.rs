//! Values of the constants, to be put in force.

use deldrift::internals::constants::{TABLE, Table};
use deldrift::motion::SwitchingRule;
use std::cell::Cell;

thread_local! {
    static IN_FORCE: Cell<&'static Table> = const { Cell::new(&TABLE) };
}

/// The constants by which triangulations are to decide that are made now.
pub fn in_force() -> &'static Table {
    IN_FORCE.get()
}

/// Values of all constants.
#[derive(Clone, Copy)]
pub struct Trial {
    pub table: Table,
    pub rule: SwitchingRule,
}

impl Trial {
    /// The values as they are.
    pub fn as_is() -> Self {
        Trial { table: TABLE, rule: SwitchingRule::default() }
    }

    /// From now on triangulations are made that decide by these.
    pub fn put_in_force(&self) {
        // There are a few thousand of them, of less than a kilobyte.
        IN_FORCE.set(Box::leak(Box::new(self.table)));
    }
}
