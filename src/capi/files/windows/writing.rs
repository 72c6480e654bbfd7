//! Files that are written beside the one whose place they take.

use std::ffi::CStr;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::super::{FileError, failure, refusal, temporary_name};
use super::system::*;
use super::{MOST, OpenFile, WholePath};
use crate::error::Result;
use crate::machine::memory;

/// A file that takes the place of the one at a path when it is complete: whatever happens before, that one stays.
pub(in crate::capi) struct NewFile<'p> {
    path: &'p CStr,
    whole: WholePath,
    /// Closed before it is renamed or removed.
    file: Option<OpenFile>,
    /// Where it is until then; none for a device or pipe, which is written at once.
    temporary: Option<WholePath>,
}

/// A path beside another one.
fn path_beside(whole: &WholePath, number: u32) -> Result<WholePath> {
    let folder = whole.0.iter().rposition(|&unit| unit == u16::from(b'\\')).map_or(0, |at| at + 1);
    let mut room = [0; 64];
    let name = temporary_name(number, &mut room);
    let mut beside = Vec::new();
    memory::reserve_exact(&mut beside, folder + name.len())?;
    beside.extend_from_slice(&whole.0[..folder]);
    beside.extend(name.iter().map(|&byte| u16::from(byte)));
    Ok(WholePath(beside))
}

impl<'p> NewFile<'p> {
    pub(in crate::capi) fn create(path: &'p CStr) -> Result<Self, FileError> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let whole = WholePath::new(path, "write")?;
        if whole.is_device() {
            let Some(file) = OpenFile::open(&whole, GENERIC_WRITE, OPEN_EXISTING) else {
                return Err(failure("open", path));
            };
            return Ok(NewFile { path, whole, file: Some(file), temporary: None });
        }
        if whole.is_directory() {
            return Err(refusal("write", path, ERROR_ACCESS_DENIED));
        }
        loop {
            let temporary = path_beside(&whole, NUMBER.fetch_add(1, Relaxed))?;
            if let Some(file) = OpenFile::open(&temporary, GENERIC_WRITE, CREATE_NEW) {
                return Ok(NewFile { path, whole, file: Some(file), temporary: Some(temporary) });
            }
            match failure("create", path) {
                // Left behind by a process of the same number.
                FileError::System { code: ERROR_FILE_EXISTS, .. } => {}
                error => return Err(error),
            }
        }
    }

    /// Writes more bytes.
    pub(in crate::capi) fn put(&mut self, mut bytes: &[u8]) -> Result<(), FileError> {
        while let (Some(file), false) = (&self.file, bytes.is_empty()) {
            let mut n = 0;
            // SAFETY: the file is open, and that many bytes are there.
            let is_written = unsafe {
                WriteFile(file.0, bytes.as_ptr().cast(), bytes.len().min(MOST) as u32, &mut n, null_mut())
            };
            if is_written == 0 {
                return Err(failure("write", self.path));
            }
            if n == 0 {
                return Err(refusal("write", self.path, ERROR_WRITE_FAULT));
            }
            bytes = &bytes[n as usize..];
        }
        Ok(())
    }

    /// Everything is written: the file takes its place.
    pub(in crate::capi) fn finish(mut self) -> Result<(), FileError> {
        let (Some(temporary), Some(file)) = (&self.temporary, self.file.take()) else { return Ok(()) };
        // SAFETY: it is open.
        if unsafe { FlushFileBuffers(file.0) } == 0 {
            return Err(failure("write", self.path));
        }
        drop(file);
        let flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
        // SAFETY: both paths end in a zero.
        if unsafe { MoveFileExW(temporary.as_ptr(), self.whole.as_ptr(), flags) } == 0 {
            return Err(failure("replace", self.path));
        }
        self.temporary = None;
        Ok(())
    }
}

impl Drop for NewFile<'_> {
    fn drop(&mut self) {
        self.file = None;
        if let Some(temporary) = &self.temporary {
            // SAFETY: the path ends in a zero.
            unsafe { DeleteFileW(temporary.as_ptr()) };
        }
    }
}
