//! Files of Windows, by the functions for UTF-16. Paths of C are UTF-8; they are made whole, so that they may have more
//! characters than those that the system takes otherwise.

mod system;
mod writing;

use std::ffi::CStr;
use std::ptr::null_mut;

use super::{FileError, MESSAGE, failure, refusal, shown};
use crate::error::Result;
use crate::machine::memory;
use system::*;
pub(in crate::capi) use writing::NewFile;

/// The system's text for an error, if it has one.
pub(super) fn message(code: i32, text: &mut [u8; MESSAGE]) -> Option<&str> {
    let mut wide = [0u16; MESSAGE];
    let flags = FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS | FORMAT_MESSAGE_MAX_WIDTH_MASK;
    // SAFETY: the buffer has room for that many characters.
    let n = unsafe {
        FormatMessageW(flags, null_mut(), code as u32, 0, wide.as_mut_ptr(), MESSAGE as u32, null_mut())
    };
    let mut end = 0;
    for c in char::decode_utf16(wide.iter().take(n as usize).copied()) {
        let c = c.unwrap_or(char::REPLACEMENT_CHARACTER);
        let Some(room) = text.get_mut(end..end + c.len_utf8()) else { break };
        c.encode_utf8(room);
        end += c.len_utf8();
    }
    let text = std::str::from_utf8(&text[..end]).ok()?.trim_end_matches([' ', '.']);
    (!text.is_empty()).then_some(text)
}

/// What all names of the system's own begin with, and those of devices.
const VERBATIM: [u16; 4] = [b'\\' as u16, b'\\' as u16, b'?' as u16, b'\\' as u16];
const DEVICE: [u16; 4] = [b'\\' as u16, b'\\' as u16, b'.' as u16, b'\\' as u16];

/// A path from the root on, which ends in a zero.
struct WholePath(Vec<u16>);

impl WholePath {
    fn new(path: &CStr, action: &'static str) -> Result<Self, FileError> {
        let Ok(text) = path.to_str() else { return Err(refusal(action, path, ERROR_INVALID_NAME)) };
        let mut given = Vec::new();
        memory::reserve_exact(&mut given, text.len() + 1)?;
        given.extend(text.encode_utf16().chain([0]));
        // SAFETY: the path ends in a zero, and nothing is written.
        let n = unsafe { GetFullPathNameW(given.as_ptr(), 0, null_mut(), null_mut()) } as usize;
        // With room for the longest beginning, which takes the place of two characters.
        const SHARE: [u16; 8] = [
            b'\\' as u16,
            b'\\' as u16,
            b'?' as u16,
            b'\\' as u16,
            b'U' as u16,
            b'N' as u16,
            b'C' as u16,
            b'\\' as u16,
        ];
        let mut whole = Vec::new();
        memory::reserve_exact(&mut whole, SHARE.len() + n)?;
        whole.resize(SHARE.len() + n, 0);
        // SAFETY: the path ends in a zero, and there is room for that many characters.
        let written = unsafe {
            GetFullPathNameW(given.as_ptr(), n as u32, whole[SHARE.len()..].as_mut_ptr(), null_mut())
        };
        if written == 0 || written as usize >= n {
            return Err(failure(action, path));
        }
        let full = &whole[SHARE.len()..];
        let start = if full.starts_with(&VERBATIM) || full.starts_with(&DEVICE) {
            SHARE.len()
        } else if full.starts_with(&VERBATIM[..2]) {
            whole[2..2 + SHARE.len()].copy_from_slice(&SHARE);
            2
        } else {
            let start = SHARE.len() - VERBATIM.len();
            whole[start..SHARE.len()].copy_from_slice(&VERBATIM);
            start
        };
        whole.drain(..start);
        whole.truncate(whole.iter().position(|&unit| unit == 0).map_or(whole.len(), |end| end + 1));
        Ok(WholePath(whole))
    }

    fn as_ptr(&self) -> *const u16 {
        self.0.as_ptr()
    }

    /// Whether it names a device or pipe.
    fn is_device(&self) -> bool {
        self.0.starts_with(&DEVICE)
    }

    fn is_directory(&self) -> bool {
        // SAFETY: the path ends in a zero.
        let attributes = unsafe { GetFileAttributesW(self.as_ptr()) };
        attributes != INVALID_FILE_ATTRIBUTES && attributes & FILE_ATTRIBUTE_DIRECTORY != 0
    }
}

/// An open file.
struct OpenFile(Handle);

impl OpenFile {
    fn open(path: &WholePath, access: u32, disposition: u32) -> Option<Self> {
        let share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
        // SAFETY: the path ends in a zero.
        let handle = unsafe {
            CreateFileW(
                path.as_ptr(),
                access,
                share,
                null_mut(),
                disposition,
                FILE_ATTRIBUTE_NORMAL,
                null_mut(),
            )
        };
        (handle != INVALID_HANDLE_VALUE).then_some(OpenFile(handle))
    }

    /// What it is, if that is none with an end.
    fn special_kind(&self) -> Option<&'static str> {
        // SAFETY: the file is open.
        match unsafe { GetFileType(self.0) } {
            FILE_TYPE_DISK => None,
            FILE_TYPE_PIPE => Some("a pipe"),
            _ => Some("a device"),
        }
    }
}

impl Drop for OpenFile {
    fn drop(&mut self) {
        // SAFETY: it is open, and nobody uses it any more.
        unsafe { CloseHandle(self.0) };
    }
}

/// The most bytes that are read or written in one call.
const MOST: usize = 1 << 30;

/// A regular file to be read.
pub(in crate::capi) struct OldFile<'p> {
    path: &'p CStr,
    file: OpenFile,
    size: u64,
}

impl<'p> OldFile<'p> {
    /// Opens a file, unless it is a pipe, device or directory.
    pub(in crate::capi) fn open(path: &'p CStr) -> Result<Self, FileError> {
        let special = |kind| FileError::Special { path: shown(path), kind };
        let whole = WholePath::new(path, "open")?;
        // To open a device may do something.
        if whole.is_device() {
            return Err(special("a device"));
        }
        if whole.is_directory() {
            return Err(special("a directory"));
        }
        let Some(file) = OpenFile::open(&whole, GENERIC_READ, OPEN_EXISTING) else {
            return Err(failure("open", path));
        };
        if let Some(kind) = file.special_kind() {
            return Err(special(kind));
        }
        let mut size = 0;
        // SAFETY: the file is open, and there is room for the answer.
        if unsafe { GetFileSizeEx(file.0, &mut size) } == 0 {
            return Err(failure("read", path));
        }
        Ok(OldFile { path, file, size: u64::try_from(size).unwrap_or(0) })
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
            let (left, room) = ((end - bytes.len()).min(MOST), bytes.spare_capacity_mut());
            let mut n_read = 0;
            // SAFETY: the file is open, and there is room for that many bytes.
            let is_read = unsafe {
                ReadFile(self.file.0, room.as_mut_ptr().cast(), left as u32, &mut n_read, null_mut())
            };
            if is_read == 0 {
                return Err(failure("read", self.path));
            }
            if n_read == 0 {
                break;
            }
            // SAFETY: that many have just been written behind the last one.
            unsafe { bytes.set_len(bytes.len() + n_read as usize) };
        }
        Ok(())
    }
}
