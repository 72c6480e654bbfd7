//! Calls of the C functions, and which have been called.

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Names, one for each place of a call. Calls are noted where there may be no memory.
static CALLED: Mutex<([&str; 1024], usize)> = Mutex::new(([""; 1024], 0));

/// Notes that a function is called; `is_noted` belongs to the place of the call.
pub fn note(name: &'static str, is_noted: &AtomicBool) {
    if !is_noted.swap(true, Relaxed) {
        let (names, count) = &mut *CALLED.lock().expect("no panic");
        names[*count] = name;
        *count += 1;
    }
}

/// The functions that have been called since the process began.
pub fn names() -> BTreeSet<&'static str> {
    let (names, count) = &*CALLED.lock().expect("no panic");
    names[..*count].iter().copied().collect()
}

/// The functions that the headers declare, but for those defined in them.
pub fn names_of_headers() -> BTreeSet<&'static str> {
    let parts = [
        ("core", include_str!("../../../include/deldrift/core.h")),
        ("motion", include_str!("../../../include/deldrift/motion.h")),
        ("read", include_str!("../../../include/deldrift/read.h")),
        ("geometry", include_str!("../../../include/deldrift/geometry.h")),
        ("voronoi", include_str!("../../../include/deldrift/voronoi.h")),
        ("segments", include_str!("../../../include/deldrift/segments.h")),
        ("periodic", include_str!("../../../include/deldrift/periodic.h")),
        ("weights", include_str!("../../../include/deldrift/weights.h")),
        ("files", include_str!("../../../include/deldrift/files.h")),
    ];
    let includes = include_str!("../../../include/deldrift.h").lines();
    let included =
        includes.filter_map(|line| line.strip_prefix("#include \"deldrift/")?.strip_suffix(".h\""));
    assert!(included.eq(parts.map(|(name, _)| name)), "these are not the parts of deldrift.h");
    let headers = parts.map(|(_, text)| text).into_iter();
    let headers = headers.chain([include_str!("../../../include/deldrift/research.h")]);
    let is_declaration = |line: &&str| !line.starts_with(['/', ' ', '#', '*']) && !line.starts_with("static");
    let name = |line: &'static str| {
        let (before, _) = line.split_once('(')?;
        let name = before.rsplit([' ', '*']).next()?;
        name.starts_with("deldrift_").then_some(name)
    };
    headers.flat_map(str::lines).filter(is_declaration).filter_map(name).collect()
}

/// Calls a C function.
macro_rules! c {
    ($function:ident($($argument:expr),* $(,)?)) => {{
        static IS_NOTED: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);
        note(stringify!($function), &IS_NOTED);
        #[allow(unused_unsafe)] // Some take no pointers.
        // SAFETY: pointers are NULL, misaligned, or to as much as the call says, and the triangulation exists.
        let result = unsafe { deldrift::capi::$function($($argument),*) };
        result
    }};
}
pub(crate) use c;
