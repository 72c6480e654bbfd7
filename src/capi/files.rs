//! Files, by the system's own calls: those of the standard library ask for memory that cannot be refused, for long
//! paths and for messages.

#[cfg(not(any(unix, windows)))]
mod absent;
#[cfg(unix)]
mod unix;
#[cfg(windows)]
mod windows;

use std::ffi::CStr;
use std::fmt;
#[cfg(any(unix, windows))]
use std::io::Write;

use crate::error::Error;
use crate::machine::memory;
#[cfg(not(any(unix, windows)))]
use absent::message;
#[cfg(not(any(unix, windows)))]
pub(super) use absent::{NoFile as NewFile, NoFile as OldFile};
#[cfg(unix)]
use unix::message;
#[cfg(unix)]
pub(super) use unix::{NewFile, OldFile};
#[cfg(windows)]
use windows::message;
#[cfg(windows)]
pub(super) use windows::{NewFile, OldFile};

/// The name of a file beside another one that is to take its place, which ends in a NUL: as much of the room as it takes.
#[cfg(any(unix, windows))]
fn temporary_name(number: u32, room: &mut [u8; 64]) -> &[u8] {
    let mut rest = &mut room[..];
    // There is room, so it does not fail.
    let _ = write!(rest, ".deldrift-{}-{number}.tmp\0", std::process::id());
    let left = rest.len();
    &room[..room.len() - left]
}

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
        code: i32,
    },
    /// What is at a path is nothing that can be read to its end.
    #[cfg(any(unix, windows))]
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
            #[cfg(any(unix, windows))]
            FileError::Special { path, kind } => {
                write!(f, "cannot read \"{path}\": it is {kind}, and only regular files are read")
            }
            FileError::System { action, path, code } => {
                let mut text = [0; MESSAGE];
                write!(f, "cannot {action} \"{path}\": ")?;
                match message(*code, &mut text) {
                    Some(text) => write!(f, "{text}"),
                    None => write!(f, "error {code}"),
                }
            }
        }
    }
}

/// The error of the latest call of the system.
#[cfg(any(unix, windows))]
fn failure(action: &'static str, path: &CStr) -> FileError {
    let code = std::io::Error::last_os_error().raw_os_error().unwrap_or(0);
    refusal(action, path, code)
}

fn refusal(action: &'static str, path: &CStr, code: i32) -> FileError {
    FileError::System { action, path: shown(path), code }
}

/// Bytes that the system's text for an error has room for.
const MESSAGE: usize = 128;

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
