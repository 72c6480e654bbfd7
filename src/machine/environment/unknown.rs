//! No environment, on processors whose registers for it are not known here.

pub(super) type Registers = ();

pub(super) const DEFAULT: Registers = ();

pub(super) fn control((): Registers) -> Registers {}

pub(super) fn read() -> Registers {}

pub(super) fn write((): Registers) {}

#[cfg(test)]
pub(super) const FOREIGN: Registers = ();

#[cfg(test)]
pub(super) const OTHERS: [Registers; 2] = [(); 2];
