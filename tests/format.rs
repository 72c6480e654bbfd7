//! What docs/FORMAT.md says of data is checked when they are loaded: for each sentence a file that is wrong in this alone.

use crate::saving_format::{Parts, Weighted, seal};
use deldrift::internals::PowerPlane;
use deldrift::internals::predicates::WeightedPoint;
use deldrift::motion::{MovingTriangulation, Options, Saved};
use deldrift::{Damage, LoadError, Moving, Plane};

/// What is wrong with some bytes.
fn damage_of<G: Moving>(bytes: &[u8]) -> Option<Damage> {
    let loaded = Saved::of(bytes)
        .map_err(LoadError::Data)
        .and_then(|saved| MovingTriangulation::<G>::load(&saved, Options::default()));
    match loaded {
        Ok(_) => None,
        Err(LoadError::Data(damage)) => Some(damage),
        Err(error) => panic!("{error}"),
    }
}

/// Two triangles, of a square: vertex 4 is hidden by vertex 1, id 5 has been removed, 6 and 7 are of insertions. Moves of
/// vertices 0 and 2 and a removal of vertex 3 are staged.
fn whole() -> Parts {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [2.0, 0.0], [9.0, 9.0]];
    let mut t = MovingTriangulation::<Plane>::new(&square, Options::default()).expect("a build");
    let vertex = deldrift::VertexId::new;
    t.remove_vertex(vertex(5)).expect("a removal");
    t.stage_insertions(&[[0.5, 0.25], [0.25, 0.5]]).expect("room");
    t.stage_removals(&[vertex(3)]).expect("a removal");
    t.move_vertices(&[vertex(0), vertex(2)], &[[0.0, -1.0], [3.0, 3.0]]).expect("moves");
    Parts::read(&t.saved().expect("room"))
}

/// A sentence, a change that makes it wrong, and what is told of it.
type Case = (&'static str, &'static dyn Fn(&mut Parts), &'static dyn Fn(&Damage) -> bool);

/// A row of the header, a byte of it, and what is told where that is changed.
type HeaderCase = (&'static str, usize, &'static dyn Fn(&Damage) -> bool);

/// Whether it is of this kind.
macro_rules! told {
    ($kind:ident) => {
        &|damage: &Damage| matches!(damage, Damage::$kind { .. })
    };
}

const CASES: [Case; 33] = [
    ("NaN for ids that are not present", &|p| p.positions[10] = 9.0, told!(Absent)),
    ("NaN for ids that are not present", &|p| p.positions[15] = 0.0, told!(Absent)),
    ("positions, by vertex id", &|p| p.positions.swap(0, 4), told!(NotPositive)),
    ("the lowest id at the same place", &|p| p.representatives[4] = 7, told!(Representative)),
    (
        "the lowest id at the same place",
        &|p| (p.representatives[1], p.representatives[4]) = (4, 4),
        told!(Representative),
    ),
    ("the vertex itself unless it is hidden", &|p| p.representatives[4] = 4, told!(InNoCell)),
    ("2³² − 1 for ids that are not present", &|p| p.representatives[5] = 5, told!(Position)),
    ("vertices of the cells", &|p| p.cells[0] = 99, told!(Corner)),
    ("vertices of the cells", &|p| p.cells[0] = p.cells[1], told!(CornerTwice)),
    ("entry i of a row is the cell opposite vertex i", &|p| p.neighbours.rotate_left(1), told!(Neighbour)),
    ("2³² − 1 on the hull", &|p| p.neighbours.fill(u32::MAX), told!(NotATriangulation)),
    ("2³² − 1 on the hull", &|p| p.neighbours[..3].fill(u32::MAX), told!(Neighbour)),
    ("2³² − 1 on the hull", &|p| p.neighbours.fill(7), told!(Neighbour)),
    ("ids of the staged insertions, ascending", &|p| p.insertions.reverse(), told!(Insertion)),
    ("ids of the staged insertions, ascending", &|p| p.insertions[1] = 6, told!(Insertion)),
    ("has the position of the one that stands for its place", &|p| p.positions[8] = 1.0, told!(Apart)),
    ("is in no cell", &|p| p.cells.iter_mut().filter(|v| **v == 1).for_each(|v| *v = 4), told!(Corner)),
    ("Positions are finite", &|p| p.positions[0] = f64::NEG_INFINITY, told!(Position)),
    ("Positions are finite", &|p| p.moved[1] = f64::NAN, told!(Position)),
    ("of magnitude 1e57 at most", &|p| p.coming[1] = 1.001e57, told!(Position)),
    ("Staged moves are of different vertices", &|p| p.moves[1] = 0, told!(Staged)),
    ("that are present and not staged for removal", &|p| p.moves[1] = 5, told!(Staged)),
    ("that are present and not staged for removal", &|p| p.moves[1] = 3, told!(Staged)),
    ("Staged insertions have ids that are not present", &|p| p.insertions[0] = 2, told!(Insertion)),
    ("Staged insertions have ids that are not present", &|p| p.insertions[1] = 8, told!(Insertion)),
    ("Staged removals are of different vertices", &|p| p.removals.push(3), told!(Staged)),
    ("Staged removals are of different vertices that are present", &|p| p.removals.push(6), told!(Staged)),
    ("The timestamp and the sums are 2⁶² − 1 at most", &|p| p.sums[0] = 1 << 62, told!(Sum)),
    ("The timestamp and the sums are 2⁶² − 1 at most", &|p| p.sums[12] = u64::MAX, told!(Sum)),
    ("positively oriented", &|p| p.positions[1] = 5.0, told!(NotPositive)),
    ("with ties broken by id", &other_diagonal, told!(NotDelaunay)),
    ("each facet in two cells or on the hull", &one_more_cell, told!(NotATriangulation)),
    ("If the positions do not span the dimension there are none", &no_cells, told!(NoCells)),
];

fn other_diagonal(p: &mut Parts) {
    let is_of_0_and_2 = p.cells[..3].contains(&0) && p.cells[..3].contains(&2);
    p.cells = if is_of_0_and_2 { vec![0, 1, 3, 1, 2, 3] } else { vec![0, 1, 2, 0, 2, 3] };
    p.glue();
}

/// The first one again, apart from the others.
fn one_more_cell(p: &mut Parts) {
    p.cells.extend_from_within(..3);
    p.neighbours.extend([u32::MAX; 3]);
}

fn no_cells(p: &mut Parts) {
    (p.cells, p.neighbours) = (Vec::new(), Vec::new());
}

fn check_cases<G: Moving>(cases: &[Case], whole: fn() -> Parts) {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = words(include_str!("../docs/FORMAT.md"));
    assert_eq!(damage_of::<G>(&whole().bytes()), None);
    for (k, &(sentence, change, is_told)) in cases.iter().enumerate() {
        assert!(text.contains(sentence), "{sentence}");
        let mut parts = whole();
        change(&mut parts);
        let damage = damage_of::<G>(&parts.bytes());
        assert!(damage.as_ref().is_some_and(is_told), "{k}, {sentence}: {damage:?}");
    }
}

#[test]
fn each_sentence_of_the_format_is_checked() {
    check_cases::<Plane>(&CASES, whole);
}

/// The same with weights: vertex 4 is hidden above one of two cells, id 5 has been removed, 6 is of an insertion.
fn whole_with_weights() -> Parts {
    let numbers = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 1.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.5, 1.0, -9.0],
        [0.5, 1.5, 0.0],
    ];
    let points = numbers.map(|[x, y, weight]| WeightedPoint { place: [x, y], weight });
    let mut t = MovingTriangulation::<PowerPlane>::new(&points, Options::default()).expect("a build");
    let vertex = deldrift::VertexId::new;
    t.remove_vertex(vertex(5)).expect("a removal");
    t.stage_insertions(&points[5..]).expect("room");
    t.move_vertices(&[vertex(0)], &points[1..2]).expect("a move");
    assert_eq!(t.vertices_hidden_by_weight(), Ok(vec![vertex(4)]));
    Parts::read(&t.saved().expect("room"))
}

fn weighted(parts: &mut Parts) -> &mut Weighted {
    parts.weighted.as_mut().expect("there are weights")
}

const CASES_WITH_WEIGHTS: [Case; 13] = [
    ("each with its weight behind it", &|p| weighted(p).weights.swap(1, 4), told!(NotDelaunay)),
    ("NaN for ids that are not present", &|p| weighted(p).weights[5] = 0.0, told!(Weight)),
    ("In versions 9 and 10 the vertex itself", &|p| p.representatives[4] = 1, told!(Representative)),
    ("Weights are finite", &|p| weighted(p).weights[2] = f64::NAN, told!(Weight)),
    ("Weights are finite", &|p| weighted(p).moved[0] = f64::INFINITY, told!(Weight)),
    ("of magnitude 1e114 at most", &|p| weighted(p).coming[0] = -1.001e114, told!(Weight)),
    ("A vertex that is hidden by weight is in no cell", &|p| weighted(p).below[1] = 0, told!(Above)),
    ("2³² − 1 for all others", &|p| weighted(p).below[5] = 0, told!(Above)),
    ("its place is in the closure of the cell", &|p| weighted(p).below[4] ^= 1, told!(Above)),
    ("is above what it is on the cell", &|p| weighted(p).weights[4] = 9.0, told!(Above)),
    ("Where there are no cells none is said to be above one", &no_cells_but_below, told!(Above)),
    ("If the positions do not span the dimension there are none", &no_cells_nor_below, told!(NoCells)),
    ("5 and 6 are not used, while 9 and 10 are", &|p| weighted(p).history[1] = 1, told!(Counts)),
];

fn no_cells_but_below(p: &mut Parts) {
    no_cells(p);
    weighted(p).below[4] = 0;
}

fn no_cells_nor_below(p: &mut Parts) {
    no_cells(p);
    weighted(p).below.fill(u32::MAX);
}

#[test]
fn each_sentence_of_the_format_about_weights_is_checked() {
    check_cases::<PowerPlane>(&CASES_WITH_WEIGHTS, whole_with_weights);
}

#[test]
fn each_row_of_the_header_is_checked() {
    let text = include_str!("../docs/FORMAT.md");
    let cases: [HeaderCase; 12] = [
        ("| 0 | 8 bytes |", 0, told!(Foreign)),
        ("| 0 | 8 bytes |", 7, told!(Foreign)),
        ("| 8 | `u32` | version", 8, told!(Version)),
        ("| 12 | `u32` | d: 2 or 3 |", 12, told!(Dimension)),
        ("| 16 | `u64` | number of bytes in all", 16, told!(Size)),
        ("| 24 | `u64` | n:", 24, told!(Counts)),
        ("| 32 | `u64` | m:", 32, told!(Counts)),
        ("| 40 | `u64` | number of staged moves", 40, told!(Counts)),
        ("| 48 | `u64` | number of staged insertions", 48, told!(Counts)),
        ("| 56 | `u64` | number of staged removals", 63, told!(Counts)),
        ("| 64 | `u64` | timestamp |", 71, told!(Sum)),
        ("| 72 | 12 `u64` | sums", 167, told!(Sum)),
    ];
    let bytes = whole().bytes();
    for (row, at, is_told) in cases {
        assert!(text.contains(row), "{row}");
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x40;
        seal(&mut bytes);
        let damage = damage_of::<Plane>(&bytes);
        assert!(damage.as_ref().is_some_and(is_told), "{row}: {damage:?}");
    }
    assert!(text.contains("| end − 4 | `u32` | CRC-32 of all bytes before it"));
    for at in [170, bytes.len() - 1] {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x40;
        assert!(damage_of::<Plane>(&bytes).as_ref().is_some_and(told!(Checksum)), "{at}");
    }
    assert!(damage_of::<Plane>(&bytes[..167]).as_ref().is_some_and(told!(NoHeader)));
}
