//! Files, by the system's own calls: those of the standard library ask for memory that cannot be refused, for long
//! paths and for messages.

mod signals;
mod writing;

use std::ffi::{CStr, c_int};
use std::fmt;
use std::mem::MaybeUninit;

use crate::error::{Error, Result};
use crate::machine::memory;
pub(super) use writing::NewFile;

/// Why a file cannot be read or written.
#[derive(Debug)]
pub(super) enum FileError {
    /// There is no memory.
    Call(Error),
    /// The system refuses.
    System {
        /// What it was asked to do.
        action: &'static str,
        /// Of what, as much as there was memory for.
        path: String,
        /// The number of its error.
        code: c_int,
    },
    /// What is at a path is nothing that can be read to its end.
    Special {
        /// Where, as much as there was memory for.
        path: String,
        /// What it is.
        kind: &'static str,
    },
}

impl From<Error> for FileError {
    fn from(error: Error) -> Self {
        FileError::Call(error)
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileError::Call(error) => write!(f, "{error}"),
            FileError::Special { path, kind } => {
                write!(f, "cannot read \"{path}\": it is {kind}, and only regular files are read")
            }
            FileError::System { action, path, code } => {
                let mut text = [0; 128];
                // SAFETY: the buffer is as long as that, and the message ends in it.
                let has_text = unsafe { libc::strerror_r(*code, text.as_mut_ptr().cast(), text.len()) == 0 };
                let text = CStr::from_bytes_until_nul(&text).ok().and_then(|text| text.to_str().ok());
                write!(f, "cannot {action} \"{path}\": ")?;
                match text.filter(|_| has_text) {
                    Some(text) => write!(f, "{text}"),
                    None => write!(f, "error {code}"),
                }
            }
        }
    }
}

/// The error of the latest call of the system.
fn failure(action: &'static str, path: &CStr) -> FileError {
    let code = std::io::Error::last_os_error().raw_os_error().unwrap_or(0);
    refusal(action, path, code)
}

fn refusal(action: &'static str, path: &CStr, code: c_int) -> FileError {
    FileError::System { action, path: shown(path), code }
}

/// Bytes of a path that a message has room for.
const SHOWN: usize = 200;

/// A path in a message: the end of a long one, which tells more than its beginning.
fn shown(path: &CStr) -> String {
    // In place of what is no text come marks.
    struct Path<'p>(&'p [u8]);
    impl fmt::Display for Path<'_> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.utf8_chunks().try_for_each(|chunk| {
                let mark = if chunk.invalid().is_empty() { "" } else { "\u{fffd}" };
                write!(f, "{}{mark}", chunk.valid())
            })
        }
    }
    let path = path.to_bytes();
    let Some(n_left_out) = path.len().checked_sub(SHOWN).filter(|&n| n > 0) else {
        return memory::text(format_args!("{}", Path(path)));
    };
    let end = &path[n_left_out..];
    // Not from within a character.
    let start = end.iter().take(4).take_while(|&&byte| byte >> 6 == 0b10).count();
    memory::text(format_args!("...{}", Path(&end[start..])))
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
        let opened = again(|| unsafe { libc::open(path.as_ptr(), flags | libc::O_CLOEXEC, mode) as isize });
        opened.map(|number| Descriptor(number as c_int)).ok_or_else(|| failure(action, named))
    }

    /// What the system knows of it.
    fn status(&self) -> Option<libc::stat> {
        let mut status = MaybeUninit::uninit();
        // SAFETY: the file is open, and there is room for the answer.
        let is_known = unsafe { libc::fstat(self.0, status.as_mut_ptr()) } == 0;
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
fn status_of(path: &CStr) -> Option<libc::stat> {
    let mut status = MaybeUninit::uninit();
    // SAFETY: the path ends in a NUL, and there is room for the answer.
    let is_there = unsafe { libc::stat(path.as_ptr(), status.as_mut_ptr()) } == 0;
    // SAFETY: it has been written.
    is_there.then(|| unsafe { status.assume_init() })
}

/// What a file is that is none with an end.
fn special_kind(status: &libc::stat) -> Option<&'static str> {
    match status.st_mode & libc::S_IFMT {
        libc::S_IFREG => None,
        libc::S_IFDIR => Some("a directory"),
        libc::S_IFIFO => Some("a pipe"),
        libc::S_IFSOCK => Some("a socket"),
        _ => Some("a device"),
    }
}

/// A regular file to be read.
pub(super) struct OldFile<'p> {
    path: &'p CStr,
    file: Descriptor,
    size: u64,
}

impl<'p> OldFile<'p> {
    /// Opens a file, unless it is a pipe, device, socket or directory.
    pub(super) fn open(path: &'p CStr) -> Result<Self, FileError> {
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
    pub(super) fn size(&self) -> u64 {
        self.size
    }

    /// Appends the next bytes, `n` unless it ends before.
    pub(super) fn read(&self, bytes: &mut Vec<u8>, n: usize) -> Result<(), FileError> {
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
