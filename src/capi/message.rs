//! The message of the last failure, kept for each thread in a buffer of fixed size: reporting needs no memory, which
//! may be just what has run out.

use std::cell::RefCell;
use std::ffi::c_char;
use std::fmt::{self, Write};

/// Bytes of a message, the NUL at its end included.
pub(super) const CAPACITY: usize = 512;

thread_local! {
    static MESSAGE: RefCell<Message> = const { RefCell::new(Message { bytes: [0; CAPACITY], length: 0 }) };
}

/// Text that is cut where it no longer fits and always ends in a NUL. The bytes come first: the message
/// and its text have the same address.
#[repr(C)]
struct Message {
    bytes: [u8; CAPACITY],
    length: usize,
}

impl Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let room = (CAPACITY - 1 - self.length).min(text.len());
        let cut = (0..=room).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        let text = &text.as_bytes()[..cut];
        let end = self.length + text.len();
        for (byte, &given) in self.bytes[self.length..end].iter_mut().zip(text) {
            *byte = if given == 0 { b'?' } else { given };
        }
        self.bytes[end] = 0;
        self.length = end;
        Ok(())
    }
}

/// Makes `text` the message of this thread.
#[cold]
#[inline(never)]
pub(super) fn record(text: fmt::Arguments<'_>) {
    MESSAGE.with(|message| {
        // Taken only if writing the text itself panics; the outer text is then the better one.
        if let Ok(mut message) = message.try_borrow_mut() {
            message.length = 0;
            message.bytes[0] = 0;
            // Writing to a Message never fails, and a Display that does leaves its beginning.
            let _ = message.write_fmt(text);
        }
    });
}

/// The message of the last failure on this thread.
pub(super) fn last() -> *const c_char {
    MESSAGE.with(|message| message.as_ptr().cast_const().cast())
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;

    #[test]
    fn long_messages_are_cut_between_characters() {
        // SAFETY: the message always ends in a NUL.
        let message = || unsafe { CStr::from_ptr(last()) }.to_str().expect("messages are UTF-8").to_string();
        record(format_args!("a{}", "é".repeat(CAPACITY)));
        assert_eq!(message(), format!("a{}", "é".repeat((CAPACITY - 2) / 2)));
        record(format_args!("nul \0 within"));
        assert_eq!(message(), "nul ? within");
    }
}
