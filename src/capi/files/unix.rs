//! Files of Unix.

mod signals;
mod writing;

use std::ffi::{CStr, c_int};
use std::mem::MaybeUninit;

// With addresses of 32 bits, those for files whose sizes and numbers have 64: the system tells of no others than small ones
// otherwise.
#[cfg(not(all(target_os = "linux", target_pointer_width = "32")))]
use libc::{fstat, open, stat};
#[cfg(all(target_os = "linux", target_pointer_width = "32"))]
use libc::{fstat64 as fstat, open64 as open, stat64 as stat};

use super::{FileError, MESSAGE, failure, refusal, shown};
use crate::error::Result;
use crate::machine::memory;
pub(in crate::capi) use writing::NewFile;

/// The system's text for an error, if it has one.
pub(super) fn message(code: i32, text: &mut [u8; MESSAGE]) -> Option<&str> {
    // SAFETY: the buffer is as long as that, and the message ends in it.
    let has_text = unsafe { libc::strerror_r(code, text.as_mut_ptr().cast(), text.len()) == 0 };
    CStr::from_bytes_until_nul(text).ok().and_then(|text| text.to_str().ok()).filter(|_| has_text)
}

/// Calls the system again while a signal interrupts it; nothing if it refuses.
fn again(mut call: impl FnMut() -> isize) -> Option<usize> {
    loop {
        if let Ok(done) = usize::try_from(call()) {
            return Some(done);
        }
        if std::io::Error::last_os_error().raw_os_error() != Some(libc::EINTR) {
            return None;
        }
    }
}

/// An open file.
struct Descriptor(c_int);

impl Descriptor {
    /// Opens a file; `named` is the path that the caller knows.
    fn open(path: &CStr, flags: c_int, action: &'static str, named: &CStr) -> Result<Self, FileError> {
        Self::open_with(path, flags, 0o666, action, named)
    }

    /// Opens a file, which gets a mode, as far as the process allows it, if it is new.
    fn open_with(
        path: &CStr,
        flags: c_int,
        mode: libc::c_uint,
        action: &'static str,
        named: &CStr,
    ) -> Result<Self, FileError> {
        // SAFETY: the path ends in a NUL.
        let opened = again(|| unsafe { open(path.as_ptr(), flags | libc::O_CLOEXEC, mode) as isize });
        opened.map(|number| Descriptor(number as c_int)).ok_or_else(|| failure(action, named))
    }

    /// What the system knows of it.
    fn status(&self) -> Option<stat> {
        let mut status = MaybeUninit::uninit();
        // SAFETY: the file is open, and there is room for the answer.
        let is_known = unsafe { fstat(self.0, status.as_mut_ptr()) } == 0;
        // SAFETY: it has been written.
        is_known.then(|| unsafe { status.assume_init() })
    }
}

impl Drop for Descriptor {
    fn drop(&mut self) {
        // SAFETY: it is open, and nobody uses it any more.
        unsafe { libc::close(self.0) };
    }
}

/// What the system knows of the file at a path, to which symbolic links lead, if there is one.
fn status_of(path: &CStr) -> Option<stat> {
    let mut status = MaybeUninit::uninit();
    // SAFETY: the path ends in a NUL, and there is room for the answer.
    let is_there = unsafe { stat(path.as_ptr(), status.as_mut_ptr()) } == 0;
    // SAFETY: it has been written.
    is_there.then(|| unsafe { status.assume_init() })
}

/// What a file is that is none with an end.
fn special_kind(status: &stat) -> Option<&'static str> {
    match status.st_mode & libc::S_IFMT {
        libc::S_IFREG => None,
        libc::S_IFDIR => Some("a directory"),
        libc::S_IFIFO => Some("a pipe"),
        libc::S_IFSOCK => Some("a socket"),
        _ => Some("a device"),
    }
}

/// A regular file to be read.
pub(in crate::capi) struct OldFile<'p> {
    path: &'p CStr,
    file: Descriptor,
    size: u64,
}

impl<'p> OldFile<'p> {
    /// Opens a file, unless it is a pipe, device, socket or directory.
    pub(in crate::capi) fn open(path: &'p CStr) -> Result<Self, FileError> {
        let special = |kind| FileError::Special { path: shown(path), kind };
        // To open a device may do something.
        if let Some(kind) = status_of(path).and_then(|status| special_kind(&status)) {
            return Err(special(kind));
        }
        // What is there may have changed: a pipe would be waited for.
        let flags = libc::O_RDONLY | libc::O_NOCTTY | libc::O_NONBLOCK;
        let file = Descriptor::open(path, flags, "open", path)?;
        let Some(status) = file.status() else { return Err(failure("read", path)) };
        match special_kind(&status) {
            Some(kind) => Err(special(kind)),
            None => Ok(OldFile { path, file, size: u64::try_from(status.st_size).unwrap_or(0) }),
        }
    }

    /// How many bytes it has.
    pub(in crate::capi) fn size(&self) -> u64 {
        self.size
    }

    /// Appends the next bytes, `n` unless it ends before.
    pub(in crate::capi) fn read(&self, bytes: &mut Vec<u8>, n: usize) -> Result<(), FileError> {
        memory::reserve_exact(bytes, n)?;
        let end = bytes.len() + n;
        while bytes.len() < end {
            let (left, room) = (end - bytes.len(), bytes.spare_capacity_mut());
            // SAFETY: there is room for that many bytes.
            match again(|| unsafe { libc::read(self.file.0, room.as_mut_ptr().cast(), left) }) {
                Some(0) => break,
                // SAFETY: that many have just been written behind the last one.
                Some(n) => unsafe { bytes.set_len(bytes.len() + n) },
                None => return Err(failure("read", self.path)),
            }
        }
        Ok(())
    }
}
