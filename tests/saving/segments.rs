//! Segments, what refinement has made of them, and labels of their sides, in saved data.

use super::load;
use crate::common::{cell_set, vertex};
use crate::saving_format::seal;
use deldrift::motion::{CoarsenOptions, MovingTriangulation, Options, Quality, RefineOptions, Segment};
use deldrift::{Damage, Error, LoadError, Plane, SegmentId, VertexId};

type Triangulation = MovingTriangulation<Plane>;

fn side(k: u32) -> Segment {
    Segment { ends: [k, (k + 1) % 4].map(VertexId::new), marker: k as i32, ..Segment::default() }
}

/// A rectangle with a vertex inside, whose sides are segments.
fn rectangle() -> Triangulation {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [1.0, 0.5]];
    let mut t = Triangulation::new(&corners, Options::default()).expect("a build");
    t.stage_segments((0..4).map(side)).expect("present");
    t.commit_timestamp().expect("no conflict");
    t
}

/// Stages the removal of all segments, and the sides anew; the first of their ids.
fn stage_others(t: &mut Triangulation) -> SegmentId {
    let gone: Vec<_> = t.segments().map(|(id, _)| id).collect();
    t.stage_segment_removals(&gone).expect("in force");
    t.stage_segments((0..4).map(side)).expect("present")
}

/// A rectangle of whose 16 ids of segments the last four are in force.
fn with_ids_that_are_gone() -> Triangulation {
    let mut t = rectangle();
    for _ in 0..3 {
        stage_others(&mut t);
        t.commit_timestamp().expect("no conflict");
    }
    t
}

/// The four bytes at a place, as a number.
fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"))
}

/// What is wrong with data in which one number is another, if anything is.
fn damage_of(bytes: &[u8], at: usize, value: u32) -> Option<Damage> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    seal(&mut bytes);
    match load::<Plane>(&bytes) {
        Err(LoadError::Data(damage)) => Some(damage),
        Err(error) => panic!("{error}"),
        Ok(_) => None,
    }
}

/// What refinement has made is saved: after loading, the same vertices leave, and pieces are joined.
#[test]
fn refined_domains_go_on_as_before() {
    let mut t = rectangle();
    let mask = |t: &Triangulation| vec![1; t.cell_count()];
    let fine = Quality { least_angle: 20.0, greatest_area: 0.01, ..Quality::default() };
    let inside = mask(&t);
    t.refine(&fine, &RefineOptions::default(), &inside).expect("a domain");
    // One that has been made is gone, and its id is not given again.
    let (gone, _) = t.made_vertices().find(|&(_, on)| on == SegmentId::NONE).expect("one within");
    t.remove_vertex(gone).expect("present");

    let bytes = t.saved().expect("room");
    let mut loaded = load::<Plane>(&bytes).expect("saved");
    assert!(loaded.saved().expect("room") == bytes);
    let mut copy = t.try_clone(None).expect("room");
    let made = |t: &Triangulation| t.made_vertices().collect::<Vec<_>>();
    let originals =
        |t: &Triangulation| t.segments().map(|(id, _)| t.original_segment(id)).collect::<Vec<_>>();
    let coarse = Quality { greatest_area: 0.2, ..fine };
    let (inside, options) = (mask(&t), CoarsenOptions::default());
    let report = t.coarsen(&coarse, &options, &inside).expect("a domain");
    assert!(report.removed > 50 && report.replaced_segments > report.new_segments, "{report:?}");
    for other in [&mut loaded, &mut copy] {
        assert!(other.made_vertices().count() > 100 && originals(other).iter().any(|&id| id.index() < 4));
        assert_eq!(other.coarsen(&coarse, &options, &inside).expect("a domain"), report);
        assert_eq!(cell_set(other), cell_set(&t));
        assert_eq!((made(other), originals(other)), (made(&t), originals(&t)));
    }

    // At the end of the data: pieces, of 16 bytes each, and the checksum; before them vertices, of 8 bytes.
    let n_pieces = originals(&load::<Plane>(&bytes).expect("saved")).len();
    let last_vertex = bytes.len() - 4 - 16 * n_pieces - 8;
    let number = |at: usize| number(&bytes, at);
    let damaged = |at: usize, value: u32| damage_of(&bytes, at, value).expect("damage");
    let last = number(last_vertex);
    for wrong in [u32::MAX, t.id_count() as u32, number(last_vertex - 8), gone.get()] {
        assert_eq!(damaged(last_vertex, wrong), Damage::Made { vertex: vertex(wrong) });
    }
    assert_eq!(damaged(last_vertex + 4, 100_000), Damage::Made { vertex: vertex(last) });
    let last_piece = bytes.len() - 4 - 16;
    let piece = SegmentId::new(number(last_piece));
    for wrong in [u32::MAX, 0, number(last_piece - 16)] {
        assert_eq!(damaged(last_piece, wrong), Damage::Segment { segment: SegmentId::new(wrong) });
    }
    for wrong in [u32::MAX, piece.get()] {
        assert_eq!(damaged(last_piece + 4, wrong), Damage::Segment { segment: piece });
    }
    assert_eq!(damaged(last_piece + 8, t.id_count() as u32), Damage::Segment { segment: piece });
    // Segments are before the vertices that have been made, 12 bytes each: one that has been replaced has no marker.
    let n_made = made(&load::<Plane>(&bytes).expect("saved")).len();
    let end = last_vertex + 8 - 8 * n_made;
    let mut rows = (1..).map(|k| end - 12 * k);
    let replaced = rows.find(|&at| number(at) == u32::MAX && number(at + 4) == u32::MAX).expect("one");
    assert_eq!(number(replaced + 8), 0);
    assert!(matches!(damaged(replaced + 8, 7), Damage::Segment { .. }));
}

/// Numbers in a row of the list of segments.
const ROW: usize = 6;

#[test]
fn data_of_segments_do_not_grow_with_those_that_are_gone() {
    let mut t = rectangle();
    let mut sizes = Vec::new();
    for round in 0..60_u32 {
        let first = stage_others(&mut t);
        assert_eq!(first.get(), 4 * (round + 1));
        let staged = t.saved().expect("room");
        t.commit_timestamp().expect("no conflict");
        let bytes = t.saved().expect("room");
        sizes.push(bytes.len());
        let mut loaded = load::<Plane>(&staged).expect("saved");
        assert!(loaded.saved().expect("room") == staged, "{round}");
        loaded.commit_timestamp().expect("no conflict");
        assert!(loaded.saved().expect("room") == bytes, "{round}");
        assert!(loaded.segments().eq(t.segments()));
        t = loaded;
    }
    // From the third round on they are listed.
    assert!(sizes[2..].iter().all(|&size| size == sizes[2]), "{sizes:?}");
}

#[test]
fn each_number_of_a_list_of_segments_is_checked() {
    let mut t = with_ids_that_are_gone();
    t.stage_segments([side(0), side(1)].into_iter()).expect("present");
    let bytes = t.saved().expect("room");
    // Six counts, rows of those with ids 12 to 15 in force, and of 16 and 17 that are staged; nothing else.
    let rows = bytes.len() - 4 - 6 * 4 * ROW;
    let counts = rows - 6 * 8;
    assert_eq!((number(&bytes, counts), number(&bytes, counts + 8)), (18, 16));
    assert_eq!(number(&bytes, counts + 5 * 8), 4);
    let at = |row: usize, k: usize| rows + 4 * (ROW * row + k);
    assert_eq!([0, 1, 2, 3, 4, 5].map(|row| number(&bytes, at(row, 0))), [12, 13, 14, 15, 16, 17]);

    // What may be otherwise is.
    assert_eq!(damage_of(&bytes, at(0, 0), 7), None);
    assert_eq!(damage_of(&bytes, at(0, 3), 99), None);
    assert_eq!(damage_of(&bytes, at(5, 4), 3), None);
    assert_eq!(damage_of(&bytes, at(5, 1), u32::MAX), None);
    let of = |id: u32| Some(Damage::Segment { segment: SegmentId::new(id) });
    for (row, wrong) in [(0, 13), (0, 16), (1, 12), (3, 16), (4, 15), (4, 17), (5, 16), (5, u32::MAX)] {
        let told = if (row, wrong) == (0, 13) { 13 } else { wrong };
        assert_eq!(damage_of(&bytes, at(row, 0), wrong), of(told), "{row} {wrong}");
    }
    for (row, id) in [(0, 12), (3, 15), (4, 16)] {
        assert_eq!(damage_of(&bytes, at(row, 1), 5), of(id));
        assert_eq!(damage_of(&bytes, at(row, 2), 5), of(id));
    }
    assert_eq!(damage_of(&bytes, at(0, 1), u32::MAX), of(12));
    // Counts that are in no order, that would take other bytes, and of a list that is not needed.
    for (k, wrong) in [(0, 15), (0, 19), (1, 19), (1, 3), (2, 1), (3, 1), (4, 1), (5, 3), (5, 5)] {
        assert_eq!(damage_of(&bytes, counts + 8 * k, wrong), Some(Damage::Counts), "{k} {wrong}");
    }
    let mut needless = rectangle();
    needless.set_sides(&[SegmentId::new(0)], &[[1, 2]]).expect("in force");
    let bytes = needless.saved().expect("room");
    let sides = bytes.len() - 4 - 4 * (4 * ROW) + 4 * 4;
    assert_eq!([number(&bytes, sides), number(&bytes, sides + 4)], [1, 2]);
    let mut bytes = bytes;
    for k in 0..2 {
        bytes[sides + 4 * k..][..4].copy_from_slice(&i32::MIN.to_le_bytes());
    }
    assert_eq!(damage_of(&bytes, sides, i32::MIN as u32), Some(Damage::Counts));
}

#[test]
fn ids_of_segments_end() {
    let t = with_ids_that_are_gone();
    let mut bytes = t.saved().expect("room");
    let counts = bytes.len() - 4 - 4 * 4 * ROW - 6 * 8;
    // As many ids but three have been given as there are.
    for k in 0..2 {
        bytes[counts + 8 * k..][..4].copy_from_slice(&(u32::MAX - 3).to_le_bytes());
    }
    seal(&mut bytes);
    let mut t = load::<Plane>(&bytes).expect("legal");
    let limit = u32::MAX as usize;
    let error = t.stage_segments((0..4).map(side));
    assert_eq!(error, Err(Error::TooManySegments { given: limit + 1, limit }));
    t.stage_segments((0..3).map(side)).expect("the last ids");
    t.commit_timestamp().expect("no conflict");
    let (last, _) = t.segments().last().expect("some");
    assert_eq!(last.get(), u32::MAX - 1);
    let saved = t.saved().expect("room");
    assert!(load::<Plane>(&saved).expect("saved").saved().expect("room") == saved);
    // A refinement needs new ids.
    let before = cell_set(&t);
    let fine = Quality { least_angle: 20.0, greatest_area: 0.01, ..Quality::default() };
    let inside = vec![1; t.cell_count()];
    let error = t.refine(&fine, &RefineOptions::default(), &inside).expect_err("no id is left");
    assert!(matches!(error, Error::TooManySegments { .. }), "{error}");
    assert!(cell_set(&t) == before && t.saved().expect("room") == saved);
}
