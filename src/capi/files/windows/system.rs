//! Functions and numbers of Windows, in kernel32.

use std::ffi::c_void;

pub(super) type Handle = *mut c_void;

pub(super) const INVALID_HANDLE_VALUE: Handle = usize::MAX as Handle;
pub(super) const GENERIC_READ: u32 = 0x8000_0000;
pub(super) const GENERIC_WRITE: u32 = 0x4000_0000;
pub(super) const FILE_SHARE_READ: u32 = 1;
pub(super) const FILE_SHARE_WRITE: u32 = 2;
pub(super) const FILE_SHARE_DELETE: u32 = 4;
pub(super) const CREATE_NEW: u32 = 1;
pub(super) const OPEN_EXISTING: u32 = 3;
pub(super) const FILE_ATTRIBUTE_DIRECTORY: u32 = 0x10;
pub(super) const FILE_ATTRIBUTE_NORMAL: u32 = 0x80;
pub(super) const INVALID_FILE_ATTRIBUTES: u32 = u32::MAX;
pub(super) const FILE_TYPE_DISK: u32 = 1;
pub(super) const FILE_TYPE_PIPE: u32 = 3;
pub(super) const MOVEFILE_REPLACE_EXISTING: u32 = 1;
pub(super) const MOVEFILE_WRITE_THROUGH: u32 = 8;
pub(super) const FORMAT_MESSAGE_IGNORE_INSERTS: u32 = 0x200;
pub(super) const FORMAT_MESSAGE_FROM_SYSTEM: u32 = 0x1000;
pub(super) const FORMAT_MESSAGE_MAX_WIDTH_MASK: u32 = 0xff;
pub(super) const ERROR_ACCESS_DENIED: i32 = 5;
pub(super) const ERROR_WRITE_FAULT: i32 = 29;
pub(super) const ERROR_FILE_EXISTS: i32 = 80;
pub(super) const ERROR_INVALID_NAME: i32 = 123;

#[link(name = "kernel32")]
unsafe extern "system" {
    pub(super) fn CreateFileW(
        name: *const u16,
        access: u32,
        share: u32,
        security: *mut c_void,
        disposition: u32,
        attributes: u32,
        template: Handle,
    ) -> Handle;
    pub(super) fn CloseHandle(handle: Handle) -> i32;
    pub(super) fn DeleteFileW(name: *const u16) -> i32;
    pub(super) fn FlushFileBuffers(file: Handle) -> i32;
    pub(super) fn FormatMessageW(
        flags: u32,
        source: *const c_void,
        message: u32,
        language: u32,
        buffer: *mut u16,
        size: u32,
        arguments: *mut c_void,
    ) -> u32;
    pub(super) fn GetFileAttributesW(name: *const u16) -> u32;
    pub(super) fn GetFileSizeEx(file: Handle, size: *mut i64) -> i32;
    pub(super) fn GetFileType(file: Handle) -> u32;
    pub(super) fn GetFullPathNameW(name: *const u16, size: u32, buffer: *mut u16, file: *mut *mut u16)
    -> u32;
    pub(super) fn MoveFileExW(from: *const u16, to: *const u16, flags: u32) -> i32;
    pub(super) fn ReadFile(
        file: Handle,
        buffer: *mut c_void,
        size: u32,
        n_read: *mut u32,
        overlapped: *mut c_void,
    ) -> i32;
    pub(super) fn WriteFile(
        file: Handle,
        buffer: *const c_void,
        size: u32,
        n_written: *mut u32,
        overlapped: *mut c_void,
    ) -> i32;
}
