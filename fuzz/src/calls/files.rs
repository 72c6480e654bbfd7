//! Calls that write files.

use super::called::{c, note};
use super::{History, message};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::ffi::{CStr, CString};
use std::path::Path;
use std::ptr::null;
use std::sync::OnceLock;

/// A file of this process, where the system keeps files in memory if it does.
pub fn path() -> CString {
    static FOLDER: OnceLock<String> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let memory = Path::new("/dev/shm");
        let folder = if memory.is_dir() { memory.to_path_buf() } else { std::env::temp_dir() };
        folder.to_str().expect("UTF-8").to_owned()
    });
    CString::new(format!("{folder}/deldrift-fuzz-{}", std::process::id())).expect("no NUL")
}

/// Takes a file away; whether it was there.
pub fn remove(path: &CStr) -> bool {
    std::fs::remove_file(path.to_str().expect("UTF-8")).is_ok()
}

impl History<'_> {
    pub(super) fn save_to_file(&mut self) -> CString {
        let (t, file) = (self.t, path());
        self.ok(|| c!(deldrift_save_file(t, file.as_ptr())));
        file
    }

    pub(super) fn write_files(&mut self) {
        let (t, file) = (self.t, path());
        let choice = self.s.below(8);
        match choice {
            0 | 1 => {
                let n = self.m.positions.len();
                let numbers = vec![1.5; n];
                let field =
                    deldrift_field { name: c"load".as_ptr(), values: numbers.as_ptr(), components: 1 };
                let (fields, count) = if choice == 0 { (null(), 0) } else { (&raw const field, 1) };
                self.ok(|| c!(deldrift_write_vtu(t, file.as_ptr(), fields, count, null(), 0)));
            }
            2 | 3 => self.ok(|| c!(deldrift_write_medit(t, file.as_ptr(), null(), 0))),
            4 => {
                let nowhere = c"/nowhere/of/all/places";
                self.expect(DELDRIFT_IO_ERROR, || c!(deldrift_save_file(t, nowhere.as_ptr())));
                self.expect(DELDRIFT_IO_ERROR, || c!(deldrift_write_medit(t, nowhere.as_ptr(), null(), 0)));
                assert!(message().contains("nowhere"));
                return;
            }
            5 => {
                let name = [null(), c"\xff".as_ptr(), c"load".as_ptr()][self.s.below(3)];
                let bad = deldrift_field { name, values: &1.0, components: 0 };
                self.expect(DELDRIFT_INVALID_FIELD, || {
                    c!(deldrift_write_vtu(t, file.as_ptr(), &bad, 1, null(), 0))
                });
                assert!(!remove(&file), "a file of a call that failed");
                return;
            }
            _ => {
                self.save_to_file();
                let data = std::fs::read(file.to_str().expect("UTF-8")).expect("the file");
                assert_eq!(data, self.saved(), "what is saved to a file");
            }
        }
        let text = std::fs::read(file.to_str().expect("UTF-8")).expect("the file");
        assert!(text.len() > 20);
        if choice < 2 {
            // Behind the text are numbers.
            let text = String::from_utf8_lossy(&text[..text.len().min(400)]).into_owned();
            // Segments are edges of files, and cells there.
            let n = self.cells().0.len() + self.m.segments.laid().count();
            assert!(text.contains(&format!("NumberOfCells=\"{n}\"")), "no {n} cells");
        }
        assert!(remove(&file));
    }
}
