//! The same with weights: what is loaded is the regular triangulation of its vertices.

use super::super::calls::model::Model;
use super::super::calls::places::{Motion, Style, place};
use super::super::calls::types::Place;
use super::super::source::Source;
use super::super::tally;
use super::{damage, forged, seal};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Level, MovingTriangulation, Options, Saved};
use deldrift::{LoadError, Moving, VertexId};

/// A saved triangulation with weights and some damage; with the right checksum in most cases.
pub fn run(s: &mut Source, flags: u8, d: usize) {
    if d == 2 { run_in::<PowerPlane>(s, flags) } else { run_in::<PowerSpace>(s, flags) }
}

fn run_in<G: Moving>(s: &mut Source, flags: u8) {
    let style = Style::new(s);
    let mut bytes = match s.below(16) {
        0 => forged::covered(G::D, G::D + 1 + s.below(60)).bytes(),
        _ => saved::<G>(s, style),
    };
    let is_damaged = damage(s, &mut bytes);
    if flags & 0x30 != 0 && bytes.len() >= 28 {
        let size = bytes.len() as u64;
        bytes[16..24].copy_from_slice(&size.to_le_bytes());
        seal(&mut bytes);
    }
    match load::<G>(&bytes) {
        Ok(t) => {
            tally::LOADED.add(1);
            check_loaded(s, style, t);
        }
        Err(LoadError::Data(damage)) => {
            tally::DAMAGED.add(1);
            assert!(is_damaged && !damage.to_string().is_empty(), "what was saved is refused: {damage}");
        }
        Err(error) => panic!("{error}"),
    }
}

fn load<G: Moving>(bytes: &[u8]) -> Result<MovingTriangulation<G>, LoadError> {
    MovingTriangulation::load(&Saved::of(bytes)?, Options::default())
}

/// A place, and a weight that hides some others, none, or all.
fn weighted<G: Moving>(s: &mut Source, p: Place) -> G::Point {
    let mut point = G::Point::default();
    (0..G::D).for_each(|k| point[k] = p[k]);
    point[G::D] = match s.below(8) {
        0 => 0.0,
        1 => s.pick(&[5e-324, 1.0, -1.0, 1e114, -1e114]),
        2 | 3 => s.within(9) as f64,
        _ => {
            let scale = p[0] * p[0] + p[1] * p[1];
            (s.unit() * if scale > 0.0 { scale } else { 1.0 }).clamp(-1e114, 1e114)
        }
    };
    point
}

/// A triangulation with a history of a few calls, saved.
fn saved<G: Moving>(s: &mut Source, style: Style) -> Vec<u8> {
    let mut m = Model { d: G::D, positions: Vec::new(), ..Model::default() };
    let mut points = Vec::new();
    for _ in 0..s.below(14) {
        let p = place(s, style, &m);
        m.positions.push(Some(p));
        points.push(weighted::<G>(s, p));
    }
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good places");
    let steps = s.byte();
    let any = |s: &mut Source| VertexId::new(u32::from(s.byte()) % points.len() as u32);
    if steps & 1 != 0 && points.len() > 2 {
        t.remove_vertex(any(s)).expect("it is there");
    }
    let p = place(s, style, &m);
    let q = weighted::<G>(s, p);
    if steps & 2 != 0 {
        t.insert_vertex(&q).expect("a good place");
    }
    if steps & 4 != 0 && points.len() > 2 {
        // They fail where the vertex has just been removed.
        let _ = t.move_vertices(&[any(s)], &[q]);
        let _ = t.stage_removals(&[any(s)]);
    }
    if steps & 8 != 0 {
        t.stage_insertions(&[q]).expect("a good place");
    }
    t.saved().expect("room")
}

/// What has been loaded is a fresh build's, is saved as it was loaded, and goes on.
fn check_loaded<G: Moving>(s: &mut Source, style: Style, mut t: MovingTriangulation<G>) {
    compare(&t);
    let bytes = t.saved().expect("room");
    let again = load::<G>(&bytes).expect("it has been saved");
    assert!(again.saved().expect("room") == bytes, "saved twice");
    let motion = Motion::new(s, style);
    for v in VertexId::range(0..t.id_count()) {
        let Ok(p) = t.position(v) else { continue };
        let from: Place = std::array::from_fn(|k| if k < G::D { p[k] } else { 0.0 });
        let to = motion.of(v.get(), from, from, G::D);
        let mut q = p;
        (0..G::D).for_each(|k| q[k] = to[k]);
        if s.below(2) == 0 {
            q[G::D] = weighted::<G>(s, to)[G::D];
        }
        // It fails where a move is staged, or a removal.
        let _ = t.move_vertices(&[v], &[q]);
    }
    t.commit_timestamp().expect("room");
    compare(&t);
}

/// Sets of the ids of cells' corners, and the vertices that weights hide.
fn shown<G: Moving>(
    t: &MovingTriangulation<G>,
    id: impl Fn(VertexId) -> VertexId,
) -> (Vec<Vec<VertexId>>, Vec<VertexId>) {
    let row = |row: &G::Vertices| {
        let mut row: Vec<_> = row.as_ref().iter().map(|&v| id(v)).collect();
        row.sort_unstable();
        row
    };
    let mut cells: Vec<_> = t.cells().expect("room").corners.iter().map(row).collect();
    cells.sort_unstable();
    (cells, t.vertices_hidden_by_weight().expect("room").into_iter().map(id).collect())
}

/// Compares with a fresh build.
fn compare<G: Moving>(t: &MovingTriangulation<G>) {
    tally::COMPARISONS.add(1);
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{violation}"));
    let present: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.position(v).is_ok()).collect();
    let points: Vec<_> = present.iter().map(|&v| t.position(v).expect("present")).collect();
    let keys: Vec<_> = present.iter().map(|&v| t.key(v).expect("present")).collect();
    let fresh = if t.has_keys() {
        MovingTriangulation::<G>::with_keys(&points, &keys, Options::default())
    } else {
        MovingTriangulation::<G>::new(&points, Options::default())
    };
    let fresh = fresh.expect("good places");
    assert_eq!(shown(t, |v| v), shown(&fresh, |v| present[v.index()]), "not those of a fresh build");
}
