//! Exact signs, and filters that answer, against integers.

mod distances;
mod measures;
mod points;
mod signs;

use super::source::Source;

/// Some points, and what the library tells of them.
pub fn run(data: &[u8]) {
    let s = &mut Source::new(data);
    match s.below(16) {
        0..=2 => signs::in_plane(s),
        3..=6 => signs::in_space(s),
        7 => signs::perturbed_in_plane(s),
        8 | 9 => signs::perturbed_in_space(s),
        10 => distances::orders(s),
        11 => distances::paths(s),
        12 => distances::delimiters(s),
        13 => measures::in_plane(s),
        14 => measures::in_space(s),
        _ => signs::by_c(s),
    }
}
