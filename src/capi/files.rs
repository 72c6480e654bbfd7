//! Files, by the system's own calls: those of the standard library ask for memory that cannot be refused, for long
//! paths and for messages.

use std::ffi::{CStr, c_int};
use std::fmt;
use std::io::Write;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::error::{Error, Result};
use crate::machine::memory;

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
    // In place of what is no text come marks.
    struct Path<'p>(&'p CStr);
    impl fmt::Display for Path<'_> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.to_bytes().utf8_chunks().try_for_each(|chunk| {
                let mark = if chunk.invalid().is_empty() { "" } else { "\u{fffd}" };
                write!(f, "{}{mark}", chunk.valid())
            })
        }
    }
    FileError::System { action, path: memory::text(format_args!("{}", Path(path))), code }
}

/// Calls the system again while a signal interrupts it.
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
        const MODE: libc::c_uint = 0o666;
        // SAFETY: the path ends in a NUL.
        let opened = again(|| unsafe { libc::open(path.as_ptr(), flags | libc::O_CLOEXEC, MODE) as isize });
        opened.map(|number| Descriptor(number as c_int)).ok_or_else(|| failure(action, named))
    }

    fn write(&self, mut bytes: &[u8], path: &CStr) -> Result<(), FileError> {
        while !bytes.is_empty() {
            // SAFETY: that many bytes are there.
            match again(|| unsafe { libc::write(self.0, bytes.as_ptr().cast(), bytes.len()) }) {
                Some(0) => return Err(refusal("write", path, libc::EIO)),
                Some(n) => bytes = &bytes[n..],
                None => return Err(failure("write", path)),
            }
        }
        Ok(())
    }
}

impl Drop for Descriptor {
    fn drop(&mut self) {
        // SAFETY: it is open, and nobody uses it any more.
        unsafe { libc::close(self.0) };
    }
}

/// A file that takes the place of the one at a path when it is complete: whatever happens before, that one stays.
pub(super) struct NewFile<'p> {
    path: &'p CStr,
    file: Descriptor,
    /// Where it is until then, a path that ends in a NUL; none for a device or pipe, which is written at once.
    temporary: Option<Vec<u8>>,
}

/// A path beside another one.
fn path_beside(path: &CStr, number: u32) -> Result<Vec<u8>> {
    let path = path.to_bytes();
    let folder = path.iter().rposition(|&byte| byte == b'/').map_or(0, |at| at + 1);
    let mut name = [0; 64];
    let mut rest = &mut name[..];
    // There is room, so it does not fail.
    let _ = write!(rest, ".deldrift-{}-{number}.tmp\0", std::process::id());
    let left = rest.len();
    let mut beside = Vec::new();
    memory::reserve_exact(&mut beside, folder + name.len() - left)?;
    beside.extend_from_slice(&path[..folder]);
    beside.extend_from_slice(&name[..name.len() - left]);
    Ok(beside)
}

fn c_str(path: &[u8]) -> &CStr {
    CStr::from_bytes_until_nul(path).expect("it ends in a NUL")
}

/// What the system knows of the file at a path, if there is one.
fn kind_of(path: &CStr) -> Option<libc::mode_t> {
    let mut status = std::mem::MaybeUninit::<libc::stat>::uninit();
    // SAFETY: the path ends in a NUL, and there is room for the answer.
    let is_there = unsafe { libc::stat(path.as_ptr(), status.as_mut_ptr()) } == 0;
    // SAFETY: it has been written.
    is_there.then(|| unsafe { status.assume_init() }.st_mode & libc::S_IFMT)
}

impl<'p> NewFile<'p> {
    pub(super) fn create(path: &'p CStr) -> Result<Self, FileError> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let kind = kind_of(path);
        if kind == Some(libc::S_IFDIR) {
            return Err(refusal("write", path, libc::EISDIR));
        }
        if kind.is_some_and(|kind| kind != libc::S_IFREG) {
            let file = Descriptor::open(path, libc::O_WRONLY | libc::O_NOCTTY, "open", path)?;
            return Ok(NewFile { path, file, temporary: None });
        }
        loop {
            let temporary = path_beside(path, NUMBER.fetch_add(1, Relaxed))?;
            let flags = libc::O_WRONLY | libc::O_CREAT | libc::O_EXCL;
            match Descriptor::open(c_str(&temporary), flags, "create", path) {
                Ok(file) => return Ok(NewFile { path, file, temporary: Some(temporary) }),
                // Left behind by a process of the same number.
                Err(FileError::System { code: libc::EEXIST, .. }) => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Writes more bytes.
    pub(super) fn put(&mut self, bytes: &[u8]) -> Result<(), FileError> {
        self.file.write(bytes, self.path)
    }

    /// Everything is written: the file takes its place.
    pub(super) fn finish(mut self) -> Result<(), FileError> {
        let Some(temporary) = &self.temporary else { return Ok(()) };
        // SAFETY: it is open.
        if again(|| unsafe { libc::fsync(self.file.0) as isize }).is_none() {
            return Err(failure("write", self.path));
        }
        // SAFETY: both paths end in a NUL.
        if unsafe { libc::rename(temporary.as_ptr().cast(), self.path.as_ptr()) } != 0 {
            return Err(failure("replace", self.path));
        }
        self.temporary = None;
        Ok(())
    }
}

impl Drop for NewFile<'_> {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            // SAFETY: the path ends in a NUL.
            unsafe { libc::unlink(temporary.as_ptr().cast()) };
        }
    }
}

/// All bytes of a file.
pub(super) fn read(path: &CStr) -> Result<Vec<u8>, FileError> {
    let file = Descriptor::open(path, libc::O_RDONLY | libc::O_NOCTTY, "open", path)?;
    let mut status = std::mem::MaybeUninit::<libc::stat>::uninit();
    // SAFETY: the file is open, and there is room for the answer.
    let is_known = unsafe { libc::fstat(file.0, status.as_mut_ptr()) } == 0;
    // SAFETY: it has been written.
    let size = if is_known { unsafe { status.assume_init() }.st_size } else { 0 };
    let mut bytes = Vec::new();
    // One more, so that its end is found without more room.
    memory::reserve_exact(&mut bytes, usize::try_from(size).unwrap_or(0).saturating_add(1))?;
    loop {
        memory::reserve(&mut bytes, 1)?;
        let room = bytes.spare_capacity_mut();
        // SAFETY: there is room for that many bytes.
        match again(|| unsafe { libc::read(file.0, room.as_mut_ptr().cast(), room.len()) }) {
            Some(0) => return Ok(bytes),
            // SAFETY: that many have just been written behind the last one.
            Some(n) => unsafe { bytes.set_len(bytes.len() + n) },
            None => return Err(failure("read", path)),
        }
    }
}
