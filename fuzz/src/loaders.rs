//! Damaged bytes of saved triangulations: they are refused, or those of a triangulation.

#[path = "../../tests/saving_format/mod.rs"]
mod saving_format;
mod weighted;

use super::allocator::Fault;
use super::calls::asking::cells_of;
use super::calls::called::{c, note};
use super::calls::check::{check_adjacency, fresh_cells};
use super::calls::files;
use super::calls::model::Model;
use super::calls::places::{Motion, Style, place};
use super::calls::types::{NONE, Place, Row, sorted};
use super::calls::{flattened, message};
use super::source::Source;
use super::tally;
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use saving_format::{Parts, forged, seal};
use std::ptr::{null, null_mut};

/// A saved triangulation with some damage, or any bytes at all; with the right checksum in most cases.
pub fn run(data: &[u8]) {
    let s = &mut Source::new(data);
    let flags = s.byte();
    let d = 2 + usize::from(flags >> 3 & 1);
    if flags & 0xc0 == 0x40 {
        return weighted::run(s, flags, d);
    }
    let (mut bytes, is_whole) = match flags & 7 {
        0 => (raw(s), false),
        7 => forged(s, d),
        _ => (saved(s, d), true),
    };
    let is_damaged = flags & 7 == 0 || damage(s, &mut bytes) || !is_whole;
    if flags & 0x30 != 0 && bytes.len() >= 28 {
        let size = bytes.len() as u64;
        bytes[16..24].copy_from_slice(&size.to_le_bytes());
        seal(&mut bytes);
    }
    let mut options = deldrift_options { coincidence: u32::from(flags & 0xc0 == 0xc0), ..default_options() };
    let algorithm = s.pick(&[0, 1, 2, 3, 4, 17]);
    let is_of_research = algorithm == 17;
    options.algorithm = if is_of_research { 0 } else { algorithm };
    if s.below(8) == 0 {
        let fault = Fault { first: s.below(40), goes_on: s.below(2) == 0 };
        let (status, refused, t) = fault_while_loading(fault, &bytes, &options);
        assert!(status != DELDRIFT_OUT_OF_MEMORY || refused && t.is_null());
        c!(deldrift_destroy(t));
    }
    let mut t = null_mut();
    let status = c!(deldrift_load(bytes.as_ptr().cast(), bytes.len(), &options, &mut t));
    if s.below(16) == 0 {
        check_file(&bytes, &options, status);
    }
    if status != DELDRIFT_OK {
        tally::DAMAGED.add(1);
        let is_expected =
            status == DELDRIFT_INVALID_DATA || status == DELDRIFT_COINCIDENT && options.coincidence == 1;
        assert!(is_expected && t.is_null() && !message().is_empty(), "{status:?}: {}", message());
        assert!(is_damaged || status == DELDRIFT_COINCIDENT, "what was saved is refused: {}", message());
        return;
    }
    tally::LOADED.add(1);
    if is_of_research {
        assert_eq!(c!(deldrift_research_set_algorithm(t, algorithm, null())), DELDRIFT_OK);
    }
    check_loaded(s, t, &options);
    c!(deldrift_destroy(t));
}

fn default_options() -> deldrift_options {
    deldrift_options {
        struct_size: size_of::<deldrift_options>(),
        algorithm: 0,
        threads: 1,
        coincidence: 0,
        passing: 0,
        parts: 0,
        cancel: None,
        progress: None,
        user_data: null_mut(),
    }
}

fn fault_while_loading(
    fault: Fault,
    bytes: &[u8],
    options: &deldrift_options,
) -> (deldrift_status, bool, *mut deldrift_triangulation) {
    let mut t = null_mut();
    let (status, refused) =
        fault.during(|| c!(deldrift_load(bytes.as_ptr().cast(), bytes.len(), options, &mut t)));
    tally::FAULTS.add(u64::from(status == DELDRIFT_OUT_OF_MEMORY));
    (status, refused, t)
}

/// From a file the same comes of it.
fn check_file(bytes: &[u8], options: &deldrift_options, wanted: deldrift_status) {
    let (file, mut t) = (files::path(), null_mut());
    std::fs::write(file.to_str().expect("UTF-8"), bytes).expect("room for a file");
    let status = c!(deldrift_load_file(file.as_ptr(), options, &mut t));
    assert_eq!(status, wanted, "from a file: {}", message());
    files::remove(&file);
    c!(deldrift_destroy(t));
}

/// Bytes behind a head that is right.
fn raw(s: &mut Source) -> Vec<u8> {
    let mut bytes = s.rest().to_vec();
    let head = [0x89, b'D', b'L', b'D', 13, 10, 26, 10, 1, 0, 0, 0];
    if bytes.len() > 12 {
        bytes[..12].copy_from_slice(&head);
    }
    bytes
}

/// Data of which every cell, facet and ridge passes, or that might take long; whether they are those of a triangulation.
fn forged(s: &mut Source, d: usize) -> (Vec<u8>, bool) {
    let (n, k) = (2 * (d + 1) + s.below(60), s.below(8));
    let legal = forged::legal(d, n);
    let mut wrong = forged::of_wrong_hulls(d, n);
    match legal.get(k) {
        Some((_, parts)) => (parts.bytes(), true),
        None => (wrong.swap_remove((k - legal.len()) % wrong.len()).1.bytes(), false),
    }
}

/// A triangulation with a history of a few calls, saved.
fn saved(s: &mut Source, d: usize) -> Vec<u8> {
    let style = Style::new(s);
    let mut m = Model { d, positions: Vec::new(), ..Model::default() };
    for _ in 0..s.below(14) {
        let p = place(s, style, &m);
        m.positions.push(Some(p));
    }
    let places: Vec<Place> = m.positions.iter().flatten().copied().collect();
    let numbers = flattened(&places, d);
    let mut t = null_mut();
    let ok = |status| assert_eq!(status, DELDRIFT_OK, "{}", message());
    ok(c!(deldrift_create(d as u32, numbers.as_ptr(), places.len(), null(), &mut t)));
    let steps = s.byte();
    let n = places.len() as u32;
    if steps & 1 != 0 && n > 2 {
        ok(c!(deldrift_remove_vertex(t, u32::from(s.byte()) % n)));
    }
    if steps & 2 != 0 {
        ok(c!(deldrift_commit_timestamp(t, null_mut())));
    }
    let q = place(s, style, &m);
    if steps & 4 != 0 && n > 2 {
        // It fails where the vertex has just been removed.
        c!(deldrift_move_vertex(t, u32::from(s.byte()) % n, q.as_ptr()));
        c!(deldrift_stage_removals(t, &(u32::from(s.byte()) % n), 1));
    }
    if steps & 8 != 0 {
        ok(c!(deldrift_stage_insertions(t, q.as_ptr(), 1, &mut 0)));
    }
    if steps & 0x30 == 0x30 && d == 2 && n > 2 {
        lay_segments(s, t, n);
    }
    let mut count = 0;
    ok(c!(deldrift_save(t, null_mut(), 0, &mut count)));
    let mut bytes = vec![0u8; count];
    ok(c!(deldrift_save(t, bytes.as_mut_ptr().cast(), count, &mut count)));
    c!(deldrift_destroy(t));
    bytes
}

/// Some segments in force, one that is to go, and some that are staged.
fn lay_segments(s: &mut Source, t: *mut deldrift_triangulation, n: u32) {
    let mut id = 0;
    for _ in 0..3 {
        let ends = [0; 2].map(|_| u32::from(s.byte()) % n);
        // These fail where a vertex has been removed, and where something conflicts.
        c!(deldrift_stage_segments(t, ends.as_ptr(), &7, 1, &mut id));
        if c!(deldrift_commit_timestamp(t, null_mut())) != DELDRIFT_OK && s.below(2) == 0 {
            c!(deldrift_discard_moves(t));
        }
    }
    c!(deldrift_stage_segment_removals(t, &0, 1));
}

/// Some changes, of bytes, of numbers, or of cells; whether there were any.
fn damage(s: &mut Source, bytes: &mut Vec<u8>) -> bool {
    let before = bytes.clone();
    // What cells are forged in has no segments: that is the first version of the format, or the first with weights.
    let mut is_readable = matches!(bytes.get(8), Some(1 | 9));
    for _ in 0..s.below(4) {
        let words = bytes.len() / 4;
        let (word, other) = (s.below(words.max(2) - 1), s.below(words.max(2) - 1));
        let way = s.below(9);
        is_readable &= way > 5;
        match way {
            0 => bytes[word * 4] ^= 1 << s.below(8),
            1 => bytes.copy_within(other * 4..other * 4 + 4, word * 4),
            2 => {
                let value = s.pick(&[0, 1, 2, 3, 5, NONE, NONE - 1, 0x7fff_ffff, 0x8000_0000]);
                bytes[word * 4..word * 4 + 4].copy_from_slice(&value.to_le_bytes());
            }
            3 => {
                let at = 24 + 8 * s.below(18);
                let value = s.pick(&[0, 1, 2, 4, 1 << 30, 1 << 32, 1 << 61, u64::MAX]);
                bytes[at..at + 8].copy_from_slice(&value.to_le_bytes());
            }
            4 => bytes.truncate(bytes.len() - s.below(40).min(bytes.len() - 200.min(bytes.len()))),
            5 => bytes.extend([0; 4]),
            _ if is_readable => forge(s, bytes),
            _ => {}
        }
    }
    *bytes != before
}

/// Changes cells or vertices, such that all else fits.
fn forge(s: &mut Source, bytes: &mut Vec<u8>) {
    let mut parts = Parts::read(bytes);
    let n = parts.dimension + 1;
    let (cells, ids) = (parts.cells.len() / n, parts.representatives.len());
    if ids == 0 {
        return;
    }
    let (cell, corner, vertex) = (s.below(cells.max(1)), s.below(n), s.below(ids));
    match s.below(7) {
        0 if cells > 0 => parts.cells[cell * n + corner] = vertex as u32,
        1 if cells > 0 => parts.cells.swap(cell * n, cell * n + corner),
        2 if cells > 0 => {
            parts.cells.drain(cell * n..(cell + 1) * n);
        }
        3 if cells > 0 => {
            let row = parts.cells[cell * n..(cell + 1) * n].to_vec();
            parts.cells.extend(row);
        }
        4 => {
            let x = &mut parts.positions[vertex * parts.dimension];
            *x = f64::from_bits(x.to_bits().wrapping_add_signed(s.within(2)));
        }
        5 => match &mut parts.weighted {
            None => parts.representatives[vertex] = s.below(ids) as u32,
            Some(w) if s.below(2) == 0 => w.below[vertex] = s.below(cells + 1) as u32,
            Some(w) => w.weights.swap(vertex, s.below(ids)),
        },
        _ => {
            let p: Vec<f64> = (0..parts.dimension).map(|_| s.unit()).collect();
            parts.positions[vertex * parts.dimension..][..parts.dimension].copy_from_slice(&p);
        }
    }
    parts.glue();
    *bytes = parts.bytes();
}

/// What has been loaded is a triangulation, is saved as it was loaded, and goes on.
fn check_loaded(s: &mut Source, t: *mut deldrift_triangulation, options: &deldrift_options) {
    let ok = |status| assert_eq!(status, DELDRIFT_OK, "{}", message());
    let d = compare(t);
    let (mut count, mut again) = (0, null_mut());
    ok(c!(deldrift_save(t, null_mut(), 0, &mut count)));
    let mut bytes = vec![0u8; count];
    ok(c!(deldrift_save(t, bytes.as_mut_ptr().cast(), count, &mut count)));
    ok(c!(deldrift_load(bytes.as_ptr().cast(), count, options, &mut again)));
    assert_eq!(cells_of(again), cells_of(t), "cells that are saved and loaded");
    let mut copy = vec![0u8; count];
    ok(c!(deldrift_save(again, copy.as_mut_ptr().cast(), count, &mut count)));
    assert!(copy == bytes, "saved twice");
    c!(deldrift_destroy(again));
    let positions = positions_of(t, d);
    let style = Style::new(s);
    let motion = Motion::new(s, style);
    for (v, p) in (0..).zip(&positions).filter_map(|(v, p)| Some((v, (*p)?))) {
        let q = motion.of(v, p, p, d);
        // It fails where a move is staged, or a removal.
        c!(deldrift_move_vertex(t, v, q.as_ptr()));
    }
    let status = c!(deldrift_commit_timestamp(t, null_mut()));
    let is_conflict =
        matches!(status, DELDRIFT_CROSSING | DELDRIFT_ON_SEGMENT | DELDRIFT_END_REMOVED | DELDRIFT_ENDS_MEET);
    assert!(
        status == DELDRIFT_OK || is_conflict || status == DELDRIFT_COINCIDENT && options.coincidence == 1,
        "{}",
        message()
    );
    compare(t);
}

fn positions_of(t: *const deldrift_triangulation, d: usize) -> Vec<Option<Place>> {
    let mut n = 0;
    assert_eq!(c!(deldrift_id_count(t, &mut n)), DELDRIFT_OK);
    let mut numbers = vec![0.0; n * d];
    assert_eq!(c!(deldrift_copy_positions(t, numbers.as_mut_ptr(), n, &mut n)), DELDRIFT_OK);
    // Vertices whose insertion is staged have places, too.
    let place = |(v, p): (u32, &[f64])| {
        let mut is_present = false;
        assert_eq!(c!(deldrift_is_present(t, v, &mut is_present)), DELDRIFT_OK);
        is_present.then(|| std::array::from_fn(|k| p.get(k).copied().unwrap_or(0.0)))
    };
    (0..).zip(numbers.chunks_exact(d)).map(place).collect()
}

/// The ends of the segments in force; in space there are none.
fn segments_of(t: *const deldrift_triangulation, d: usize) -> Vec<[u32; 2]> {
    let (mut n, none) = (0, null_mut::<u32>());
    if d != 2 {
        return Vec::new();
    }
    assert_eq!(c!(deldrift_segments(t, none, none, null_mut(), 0, &mut n)), DELDRIFT_OK);
    let mut ends = vec![[77; 2]; n];
    let to = ends.as_mut_ptr().cast();
    assert_eq!(c!(deldrift_segments(t, none, to, null_mut(), n, &mut n)), DELDRIFT_OK);
    ends
}

/// Compares with a fresh build; the dimension.
fn compare(t: *const deldrift_triangulation) -> usize {
    tally::COMPARISONS.add(1);
    let mut dimension = 0;
    assert_eq!(c!(deldrift_dimension(t, &mut dimension)), DELDRIFT_OK);
    let d = dimension as usize;
    assert_eq!(c!(deldrift_validate(t, 3)), DELDRIFT_OK, "{}", message());
    let (rows, neighbours) = cells_of(t);
    check_adjacency(&rows, &neighbours, d);
    let mut found: Vec<Row> = rows.iter().map(|&row| sorted(row)).collect();
    found.sort_unstable();
    let segments = segments_of(t, d);
    assert_eq!(found, fresh_cells(&positions_of(t, d), &segments, d), "not the cells of a fresh build");
    d
}
