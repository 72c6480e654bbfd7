//! Files that are written beside the one whose place they take.

use std::ffi::CStr;
use std::io;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::super::temporary_name;
use super::signals::Quiet;
use super::{Descriptor, FileError, again, failure, refusal, stat, status_of};
use crate::error::Result;
use crate::machine::memory;

/// A file that takes the place of the one at a path when it is complete: whatever happens before, that one stays.
pub(in crate::capi) struct NewFile<'p> {
    path: &'p CStr,
    file: Descriptor,
    /// Where it is until then, a path that ends in a NUL; none for a device or pipe, which is written at once.
    temporary: Option<Vec<u8>>,
    quiet: Quiet,
}

/// A path beside another one.
fn path_beside(path: &CStr, number: u32) -> Result<Vec<u8>> {
    let path = path.to_bytes();
    let folder = path.iter().rposition(|&byte| byte == b'/').map_or(0, |at| at + 1);
    let mut room = [0; 64];
    let name = temporary_name(number, &mut room);
    let mut beside = Vec::new();
    memory::reserve_exact(&mut beside, folder + name.len())?;
    beside.extend_from_slice(&path[..folder]);
    beside.extend_from_slice(name);
    Ok(beside)
}

fn c_str(path: &[u8]) -> &CStr {
    CStr::from_bytes_until_nul(path).expect("it ends in a NUL")
}

/// The access control list of a file, where the system has them.
#[cfg(target_os = "linux")]
const ACCESS_LIST: &CStr = c"system.posix_acl_access";

/// Whether the latest call of the system has failed since a file has no access control list, or no file there has.
#[cfg(target_os = "linux")]
fn has_no_list() -> bool {
    let code = io::Error::last_os_error().raw_os_error();
    code == Some(libc::ENODATA) || code == Some(libc::EOPNOTSUPP)
}

/// Gives a new file the access control list of the one at a path; whether it is as that one in this respect.
#[cfg(target_os = "linux")]
fn copy_access_list(path: &CStr, file: &Descriptor) -> bool {
    let mut list = [0; 4096];
    // SAFETY: both texts end in a NUL, and there is room for that many bytes.
    let n =
        unsafe { libc::getxattr(path.as_ptr(), ACCESS_LIST.as_ptr(), list.as_mut_ptr().cast(), list.len()) };
    let is_done = match usize::try_from(n) {
        // SAFETY: that many bytes have been written.
        Ok(n) => unsafe { libc::fsetxattr(file.0, ACCESS_LIST.as_ptr(), list.as_ptr().cast(), n, 0) == 0 },
        // It may have got one from its folder.
        // SAFETY: the text ends in a NUL.
        Err(_) if has_no_list() => unsafe { libc::fremovexattr(file.0, ACCESS_LIST.as_ptr()) == 0 },
        Err(_) => false,
    };
    is_done || n < 0 && has_no_list()
}

#[cfg(not(target_os = "linux"))]
fn copy_access_list(_path: &CStr, _file: &Descriptor) -> bool {
    true
}

/// Gives a new file owner, group, access control list and mode of the one at a path, as far as the system allows.
/// Nobody is allowed more than before: if the group or the list cannot be kept, the group is allowed what others are.
fn copy_access(path: &CStr, old: &stat, file: &Descriptor) -> bool {
    let Some(new) = file.status() else { return false };
    let keeps = |uid, gid| {
        // SAFETY: the file is open.
        unsafe { libc::fchown(file.0, uid, gid) == 0 }
    };
    const LEAVE: libc::uid_t = !0;
    if new.st_uid != old.st_uid {
        // Only the superuser may.
        let _ = keeps(old.st_uid, LEAVE);
    }
    let has_group = new.st_gid == old.st_gid || keeps(LEAVE, old.st_gid);
    let has_list = copy_access_list(path, file);
    let mut mode = old.st_mode & 0o777;
    if !(has_group && has_list) {
        mode = mode & !0o070 | mode & (mode << 3) & 0o070;
    }
    // SAFETY: the file is open.
    unsafe { libc::fchmod(file.0, mode) == 0 }
}

/// Opens a pipe or device that is written at once; a pipe that nobody reads is refused, not waited for.
fn open_special(path: &CStr) -> Result<Descriptor, FileError> {
    let flags = libc::O_WRONLY | libc::O_NOCTTY;
    let file = Descriptor::open(path, flags | libc::O_NONBLOCK, "open", path)?;
    // What is full is waited for.
    // SAFETY: the file is open.
    let is_set = unsafe { libc::fcntl(file.0, libc::F_SETFL, flags) } == 0;
    if is_set { Ok(file) } else { Err(failure("open", path)) }
}

impl<'p> NewFile<'p> {
    pub(in crate::capi) fn create(path: &'p CStr) -> Result<Self, FileError> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let old = status_of(path);
        let quiet = Quiet::new();
        match old.map(|status| status.st_mode & libc::S_IFMT) {
            Some(libc::S_IFDIR) => return Err(refusal("write", path, libc::EISDIR)),
            None | Some(libc::S_IFREG) => {}
            Some(_) => return Ok(NewFile { path, file: open_special(path)?, temporary: None, quiet }),
        }
        loop {
            let temporary = path_beside(path, NUMBER.fetch_add(1, Relaxed))?;
            let flags = libc::O_WRONLY | libc::O_CREAT | libc::O_EXCL;
            // What is to be read by some alone is so from the start.
            let mode = if old.is_some() { 0o600 } else { 0o666 };
            match Descriptor::open_with(c_str(&temporary), flags, mode, "create", path) {
                Ok(file) => {
                    let new = NewFile { path, file, temporary: Some(temporary), quiet };
                    return match old {
                        Some(old) if !copy_access(path, &old, &new.file) => Err(failure("write", path)),
                        _ => Ok(new),
                    };
                }
                // Left behind by a process of the same number.
                Err(FileError::System { code: libc::EEXIST, .. }) => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Writes more bytes.
    pub(in crate::capi) fn put(&mut self, mut bytes: &[u8]) -> Result<(), FileError> {
        while !bytes.is_empty() {
            // SAFETY: that many bytes are there.
            match again(|| unsafe { libc::write(self.file.0, bytes.as_ptr().cast(), bytes.len()) }) {
                Some(0) => return Err(refusal("write", self.path, libc::EIO)),
                Some(n) => bytes = &bytes[n..],
                None => {
                    let code = io::Error::last_os_error().raw_os_error().unwrap_or(0);
                    self.quiet.take_raised(code);
                    return Err(refusal("write", self.path, code));
                }
            }
        }
        Ok(())
    }

    /// Everything is written: the file takes its place.
    pub(in crate::capi) fn finish(mut self) -> Result<(), FileError> {
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
