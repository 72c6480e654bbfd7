//! Machines without files, as a page in a browser is one: every path is refused.

use std::ffi::CStr;

use super::{FileError, MESSAGE, refusal};
use crate::error::Result;

/// The text of the only error that there is.
pub(super) fn message(_: i32, _: &mut [u8; MESSAGE]) -> Option<&str> {
    Some("there are no files here")
}

/// A file to be read or made, of which there is none.
pub(in crate::capi) enum NoFile<'p> {
    #[expect(dead_code, reason = "nothing makes one")]
    At(&'p CStr),
}

impl<'p> NoFile<'p> {
    pub(in crate::capi) fn open(path: &'p CStr) -> Result<Self, FileError> {
        Err(refusal("open", path, 0))
    }

    pub(in crate::capi) fn create(path: &'p CStr) -> Result<Self, FileError> {
        Err(refusal("create", path, 0))
    }

    pub(in crate::capi) fn size(&self) -> u64 {
        0
    }

    pub(in crate::capi) fn read(&self, _: &mut Vec<u8>, _: usize) -> Result<(), FileError> {
        Ok(())
    }

    pub(in crate::capi) fn put(&mut self, _: &[u8]) -> Result<(), FileError> {
        Ok(())
    }

    pub(in crate::capi) fn finish(self) -> Result<(), FileError> {
        Ok(())
    }
}
