//! Files on Windows: src/capi/files with its own `main`, which platforms/run builds with mingw and runs under wine.

// What the files use of the library.
mod error {
    #[derive(Debug)]
    pub struct Error;

    impl std::fmt::Display for Error {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "there is no memory")
        }
    }

    pub type Result<T, E = Error> = std::result::Result<T, E>;
}

mod machine {
    pub mod memory {
        pub fn reserve_exact<T>(list: &mut Vec<T>, n: usize) -> crate::error::Result<()> {
            list.try_reserve_exact(n).map_err(|_| crate::error::Error)
        }

        pub fn text(arguments: std::fmt::Arguments) -> String {
            arguments.to_string()
        }
    }
}

mod capi {
    pub mod files;

    pub mod tests {
        use std::ffi::CString;
        use std::fs;

        use super::files::{FileError, NewFile, OldFile};

        fn write(path: &str, parts: &[&str]) -> Result<(), FileError> {
            let path = CString::new(path).expect("no NUL");
            let mut file = NewFile::create(&path)?;
            for part in parts {
                file.put(part.as_bytes())?;
            }
            file.finish()
        }

        fn read(path: &str) -> Result<String, FileError> {
            let path = CString::new(path).expect("no NUL");
            let file = OldFile::open(&path)?;
            let mut bytes = Vec::new();
            file.read(&mut bytes, file.size() as usize)?;
            assert_eq!(bytes.len() as u64, file.size());
            Ok(String::from_utf8(bytes).expect("text"))
        }

        fn listed(folder: &str) -> Vec<String> {
            let entries = fs::read_dir(folder).expect("a folder");
            let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
            let mut names: Vec<String> = entries.map(|entry| name(entry).into_string().expect("text")).collect();
            names.sort();
            names
        }

        #[track_caller]
        fn assert_refused<T>(outcome: Result<T, FileError>, part: &str) {
            let said = outcome.err().expect("it is refused").to_string();
            assert!(said.contains(part), "{said}");
        }

        /// How many questions have been answered.
        pub fn run() -> usize {
            let folder = std::env::temp_dir().join("deldrift_files");
            let _ = fs::remove_dir_all(&folder);
            fs::create_dir_all(&folder).expect("a folder");
            let folder = folder.to_str().expect("text");
            let mut n = 0;
            let mut test = |work: &dyn Fn()| {
                work();
                n += 1;
            };

            let path = &format!("{folder}\\a.bin");
            test(&|| {
                write(path, &["one", "two"]).expect("a new file");
                assert_eq!(read(path).expect("a file"), "onetwo");
            });
            test(&|| {
                write(path, &["three"]).expect("in its place");
                assert_eq!((read(path).expect("a file"), listed(folder).len()), ("three".to_owned(), 1));
            });
            // One that is not finished leaves the old one, and nothing beside it.
            test(&|| {
                let given = CString::new(path.as_str()).expect("no NUL");
                let mut file = NewFile::create(&given).expect("room");
                file.put(b"half").expect("room");
                assert_eq!(listed(folder).len(), 2);
                drop(file);
                assert_eq!((read(path).expect("a file"), listed(folder).len()), ("three".to_owned(), 1));
            });
            test(&|| {
                let name = "p\u{e4}\u{20ac}\u{1f600}.bin";
                write(&format!("{folder}\\{name}"), &["text"]).expect("any name");
                assert!(listed(folder).iter().any(|other| other == name));
                assert_eq!(read(&format!("{folder}/{name}")).expect("a file"), "text");
            });
            test(&|| {
                let long = format!("{folder}{}", format!("\\{}", "x".repeat(60)).repeat(6));
                fs::create_dir_all(format!("\\\\?\\{long}")).expect("a folder");
                let path = format!("{long}\\deep.bin");
                assert!(path.len() > 300);
                write(&path, &["deep"]).expect("a long path");
                assert_eq!(read(&path).expect("a file"), "deep");
            });
            test(&|| {
                std::env::set_current_dir(folder).expect("a folder");
                write("relative.bin", &["near"]).expect("a file here");
                assert_eq!(read("relative.bin").expect("a file"), "near");
                assert!(listed(folder).iter().any(|name| name == "relative.bin"));
            });
            test(&|| write("NUL", &["nothing"]).expect("a device takes it"));
            test(&|| assert_refused(read("NUL"), "it is a device"));
            test(&|| assert_refused(read(folder), "it is a directory"));
            test(&|| assert_refused(write(folder, &["x"]), "cannot write"));
            test(&|| assert_refused(read("missing.bin"), "cannot open \"missing.bin\""));
            test(&|| assert_refused(write("no\\such\\folder.bin", &["x"]), "cannot create"));
            test(&|| {
                let path = CString::new([b'a', 0xff]).expect("no NUL");
                assert_refused(OldFile::open(&path), "cannot open \"a\u{fffd}\"");
            });
            assert!(!listed(folder).iter().any(|name| name.contains(".tmp")), "something is left behind");
            n
        }
    }
}

fn main() {
    println!("{} passed", capi::tests::run());
}
