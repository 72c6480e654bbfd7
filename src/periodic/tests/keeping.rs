//! What is cloned, or saved and loaded, is as it was and goes on like it; bytes that are not those of a triangulation are
//! refused.

use super::*;
use crate::damage::{Damage, LoadError};
use crate::motion::Saved;
use crate::periodic::images::{Image, Images};
use crate::periodic::inside::{Inside, InsideBefore};
use crate::periodic::lattice::{HOME, Lattice, Occupied};
use crate::periodic::needed::keys_of;

pub(super) type Loaded<G> = Result<PeriodicTriangulation<G>, LoadError>;

pub(super) fn load<G: Moving>(bytes: &[u8]) -> Loaded<G> {
    PeriodicTriangulation::load(&SavedPeriodic::of(bytes)?, Options::default())
}

/// All that is read of one is read of the other.
fn assert_same<G: Moving>(t: &PeriodicTriangulation<G>, other: &PeriodicTriangulation<G>, context: &str) {
    let read = |t: &PeriodicTriangulation<G>| {
        let cells = t.cells().unwrap();
        let ids = || VertexId::range(0..t.id_count());
        (
            (cells.corners.to_vec(), cells.neighbours.to_vec()),
            t.cell_shifts().unwrap().chain(t.neighbour_shifts().unwrap()).collect::<Vec<_>>(),
            ids().map(|v| t.position_or_goal(v)).collect::<Vec<_>>(),
            ids().map(|v| t.coincident_representative(v).ok()).collect::<Vec<_>>(),
            t.vectors().collect::<Vec<_>>(),
            (t.statistics(), t.staged_count(), t.image_count()),
        )
    };
    assert!(read(t) == read(other), "{context}");
    assert!(t.saved().unwrap() == other.saved().unwrap(), "{context}");
}

/// One step of a history: what is staged, some of it several times over.
fn stage<G: Moving>(t: &mut PeriodicTriangulation<G>, rng: &mut Rng, basis: &[G::Point]) {
    let present: Vec<_> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let size = [1e-3, 0.05, 3.0][rng.below(3)];
    let mut moving: Vec<_> = present.iter().copied().filter(|_| rng.one_in(2)).collect();
    rng.shuffle(&mut moving);
    let goals: Vec<G::Point> = moving
        .iter()
        .map(|&v| {
            let mut p = t.position(v).unwrap();
            (0..G::D).for_each(|axis| p[axis] += size * (rng.unit() - 0.5));
            p
        })
        .collect();
    t.move_vertices(&moving, &goals).unwrap();
    if rng.one_in(3) {
        let more = random_points::<G>(rng, 2, basis);
        t.stage_insertions(&more).unwrap();
    }
    if rng.one_in(3) && present.len() > 4 {
        t.stage_removals(&[present[rng.below(present.len())]]).unwrap();
    }
    if rng.one_in(4) {
        let mut other = basis.to_vec();
        other.iter_mut().for_each(|b| (0..G::D).for_each(|axis| b[axis] *= 1.0 + rng.unit() / 4.0));
        t.stage_vectors(&other).unwrap();
    }
}

/// A history, and others that go on from what it was, cloned and loaded with all that is staged.
fn history<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let points = random_points::<G>(rng, n, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    for step in 0..6 {
        let context = format!("seed {seed}, step {step}, {n} in {}D", G::D);
        stage(&mut t, rng, basis);
        let mut clone = t.try_clone(None).unwrap();
        let bytes = t.saved().unwrap();
        assert_eq!(bytes.len(), t.saved_size());
        let mut loaded = load::<G>(&bytes).unwrap_or_else(|error| panic!("{context}: {error}"));
        assert_same(&t, &clone, &context);
        assert_same(&t, &loaded, &context);
        t.commit_timestamp().unwrap();
        // What the others are does not follow.
        assert!(clone.saved().unwrap() == bytes && loaded.saved().unwrap() == bytes, "{context}");
        clone.commit_timestamp().unwrap();
        assert_same(&t, &clone, &context);
        loaded.commit_timestamp().unwrap();
        let ids = VertexId::range(0..t.id_count());
        let used: Vec<G::Point> = ids.clone().map(|v| t.position(v).unwrap_or_default()).collect();
        let vectors: Vec<G::Point> = t.vectors().collect();
        let others = ids.map(|v| loaded.position(v).unwrap_or_default());
        assert!(others.eq(used.iter().copied()), "{context}");
        assert_eq!(classes(&t, &used, &vectors), classes(&loaded, &used, &vectors), "{context}");
        if step % 2 == 0 {
            t = loaded;
        }
    }
}

#[test]
fn what_is_kept_goes_on() {
    for seed in 0..24 {
        let n = [1, 2, 5, 12, 60, 200][seed as usize % 6];
        history::<Plane>(seed, &[[1.0, 0.0], [0.0, 1.0]], n);
        history::<Plane>(seed, &[[1.0, 0.25], [5.0, 3.0]], n);
        history::<Plane>(seed, &[[1.0, 0.25]], n);
    }
    for seed in 0..6 {
        let n = [1, 5, 40][seed as usize % 3];
        history::<Space>(seed, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 0.75]], n);
        history::<Space>(seed, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]], n);
    }
}

/// With everything: vertices removed, at the same place, in far periods, and all kinds of edits staged.
fn with_everything<G: Moving>() -> PeriodicTriangulation<G> {
    let rng = &mut Rng::new(3);
    let mut basis = vec![G::Point::default(); G::D];
    (0..G::D).for_each(|k| (0..=k).for_each(|axis| basis[k][axis] = if axis == k { 1.0 } else { 0.25 }));
    let mut points = random_points::<G>(rng, 5, &basis);
    points[2] = points[0];
    points[3][0] += 100.0;
    let mut t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    t.stage_removals(&[VertexId::new(1)]).unwrap();
    t.commit_timestamp().unwrap();
    t.move_vertices(&[VertexId::new(4), VertexId::new(0)], &points[..2]).unwrap();
    t.stage_insertions(&points[3..]).unwrap();
    t.stage_removals(&[VertexId::new(4), VertexId::new(3)]).unwrap();
    basis[0][0] = 1.125;
    t.stage_vectors(&basis).unwrap();
    t
}

fn samples<G: Moving>() -> [PeriodicTriangulation<G>; 3] {
    let mut vector = G::Point::default();
    vector[0] = 1.0;
    let of = |n: usize| {
        PeriodicTriangulation::new(&vec![G::Point::default(); n], &[vector], Options::default()).unwrap()
    };
    [with_everything(), of(0), of(1)]
}

fn every_byte_is_protected<G: Moving>() {
    for t in samples::<G>() {
        let bytes = t.saved().unwrap();
        assert_same(&t, &load(&bytes).unwrap(), "a sample");
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            for change in [1, 2, 128, 255] {
                damaged[at] ^= change;
                assert!(matches!(load::<G>(&damaged), Err(LoadError::Data(_))), "byte {at}");
                damaged[at] ^= change;
            }
            assert!(matches!(load::<G>(&bytes[..at]), Err(LoadError::Data(_))), "{at} bytes");
        }
        assert!(load::<G>(&[&bytes[..], &[0]].concat()).is_err());
    }
}

#[test]
fn every_byte_is_protected_in_both_dimensions() {
    every_byte_is_protected::<Plane>();
    every_byte_is_protected::<Space>();
}

/// Makes the checksums right, of all and of what is inside.
pub(super) fn seal(bytes: &mut [u8]) {
    let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let (end, inside_bytes) = (bytes.len() - 4, number(184));
    let mut write = |range: std::ops::Range<usize>| {
        let checksum = crc32fast::hash(&bytes[range.clone()]);
        bytes[range.end..range.end + 4].copy_from_slice(&checksum.to_le_bytes());
    };
    if (8..end).contains(&inside_bytes) {
        write(end - inside_bytes..end - 4);
    }
    write(0..end);
}

/// The cells, by names for their vertices, each as a sorted list of corners with their shifts.
fn by_id<G: Moving>(
    t: &PeriodicTriangulation<G>,
    names: &dyn Fn(VertexId) -> VertexId,
) -> BTreeSet<Vec<(VertexId, [i64; 3])>> {
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let rows = t.cells().unwrap().corners.iter().zip(shifts.chunks(G::D + 1));
    let rows = rows.map(|(row, shifts)| {
        let mut row: Vec<_> = row.as_ref().iter().map(|&v| names(v)).zip(shifts.to_vec()).collect();
        row.sort();
        row
    });
    rows.collect()
}

/// What is loaded is what is made anew of its positions and vectors. Positions that are too far away to be read exactly, and
/// vectors that are, tell nothing.
fn check_loaded<G: Moving>(t: &PeriodicTriangulation<G>) {
    let ids = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v));
    let present: Vec<VertexId> = ids.collect();
    let points: Vec<G::Point> = present.iter().map(|&v| t.position(v).unwrap()).collect();
    let vectors: Vec<G::Point> = t.vectors().collect();
    if points.iter().chain(&vectors).any(|p| p.as_ref().iter().any(|x| x.abs() > 1e3)) {
        return;
    }
    let fresh = PeriodicTriangulation::<G>::new(&points, &vectors, Options::default()).unwrap();
    assert!(by_id(t, &|v| v) == by_id(&fresh, &|v| present[v.index()]));
}

fn forged_bytes_give_triangulations_or_nothing<G: Moving>() {
    let rng = &mut Rng::new(9);
    let (mut n_refused, mut n_loaded) = (0, 0);
    let mut check = |bytes: &[u8]| match load::<G>(bytes) {
        Err(LoadError::Data(damage)) => {
            assert!(!damage.to_string().is_empty());
            n_refused += 1;
        }
        Err(LoadError::Call(error)) => panic!("{error}"),
        Ok(mut t) => {
            check_loaded(&t);
            if t.commit_timestamp().is_ok() {
                check_loaded(&t);
            }
            n_loaded += 1;
        }
    };
    for t in samples::<G>() {
        let bytes = t.saved().unwrap();
        // Of a long list of images some.
        let n = bytes.len() - 4;
        let chosen =
            (0..n.min(600)).chain((0..n.saturating_sub(600).min(250)).map(|_| 600 + rng.below(n - 600)));
        for at in chosen.collect::<Vec<_>>() {
            for change in [1, 128, rng.within(1, 255) as u8] {
                let mut bytes = bytes.clone();
                bytes[at] ^= change;
                seal(&mut bytes);
                check(&bytes);
            }
        }
        for _ in 0..300 {
            let mut bytes = bytes.clone();
            for _ in 0..1 + rng.below(4) {
                let (at, from) = (rng.below(bytes.len() / 4 - 1) * 4, rng.below(bytes.len() / 4 - 1) * 4);
                bytes.copy_within(from..from + 4, at);
            }
            seal(&mut bytes);
            check(&bytes);
        }
    }
    assert!(n_refused > 1000 && n_loaded > 100, "{n_refused} refused, {n_loaded} loaded");
}

#[test]
fn forged_bytes_give_triangulations_or_nothing_in_both_dimensions() {
    forged_bytes_give_triangulations_or_nothing::<Plane>();
    forged_bytes_give_triangulations_or_nothing::<Space>();
}

/// What docs/FORMAT.md says is checked, where all else is right.
#[test]
fn what_is_wrong_in_data_is_told() {
    type Case = (&'static str, usize, &'static [u8], fn(&Damage) -> bool);
    let t = with_everything::<Plane>();
    let bytes = t.saved().unwrap();
    let n_points = 2 + 2 + t.staged_count() + t.staged_edits().0;
    // Where the periods of vertices begin, ids of moves, those of removals, and what is inside.
    let periods = 192 + 16 * n_points;
    let moves = periods + 16 * t.inside.images.n_vertices();
    let removals = moves + 4 * t.staged_count();
    let images = removals + 4 * t.staged_edits().1;
    let is_image = |image: &Image| image.shift != HOME && *image != Image::GONE;
    let far = images + 12 * t.inside.images.as_slice().iter().position(is_image).unwrap();
    let nan = &[0, 0, 0, 0, 0, 0, 0xf8, 0x7f];
    let cases: [Case; 16] = [
        ("version 4", 8, &[3], |d| matches!(d, Damage::Periodic { is_periodic: false })),
        ("all bytes", 23, &[1], |d| matches!(d, Damage::Size { .. })),
        ("ids", 24, &[77], |d| matches!(d, Damage::Counts)),
        ("timestamp", 71, &[0x40], |d| matches!(d, Damage::Sum { offset: 64, .. })),
        ("1 to d vectors", 168, &[3], |d| matches!(d, Damage::Counts)),
        ("r staged vectors, or 0", 176, &[1], |d| matches!(d, Damage::Counts)),
        ("finite vectors", 192, nan, |d| matches!(d, Damage::Vectors)),
        ("independent vectors", 192, &[0; 16], |d| matches!(d, Damage::Vectors)),
        ("finite staged vectors", 224, nan, |d| matches!(d, Damage::Vectors)),
        ("finite moves", 256, nan, |d| matches!(d, Damage::Position { axis: 0, .. })),
        ("0 for removed ones", periods + 16, &[1], |d| *d == Damage::Period { vertex: VertexId::new(1) }),
        ("in range", periods + 7, &[0x10], |d| *d == Damage::Period { vertex: VertexId::new(0) }),
        ("moves of vertices that are there", moves, &[1], |d| matches!(d, Damage::Staged { .. })),
        ("removals of different ones", removals, &[3], |d| matches!(d, Damage::Staged { .. })),
        ("ascending by id", images, &[4], |d| matches!(d, Damage::Image { .. })),
        ("an image that may be needed", far + 4, &[100, 0, 0, 0], |d| matches!(d, Damage::Image { .. })),
    ];
    for (what, at, change, is_told) in cases {
        let mut bytes = bytes.clone();
        bytes[at..at + change.len()].copy_from_slice(change);
        seal(&mut bytes);
        match load::<Plane>(&bytes).map(drop) {
            Err(LoadError::Data(damage)) => assert!(is_told(&damage), "{what}: {damage:?}"),
            other => panic!("{what}: {other:?}"),
        }
    }
}

/// One vertex with those images alone whose shifts these are, all right otherwise.
fn with_images(shifts: &[[i32; 2]]) -> PeriodicTriangulation<Plane> {
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let mut t = PeriodicTriangulation::<Plane>::new(&[[0.5, 0.5]], &square, Options::default()).unwrap();
    let lattice = Lattice::<Plane>::new(&square).unwrap();
    let (mut images, mut places, mut occupied) = (Images::default(), Vec::new(), Occupied::NOTHING);
    images.reserve(1, 1 + shifts.len()).unwrap();
    for shift in std::iter::once(HOME).chain(shifts.iter().map(|&[a, b]| [a, b, 0])) {
        images.push(Image { vertex: VertexId::new(0), shift });
        places.push(lattice.translated(&[0.5, 0.5], shift));
    }
    t.lattice.enter(&mut occupied, &[0.5, 0.5]);
    let keys = keys_of(images.as_slice()).unwrap();
    let inside = MovingTriangulation::with_keys(&places, &keys, Options::default()).unwrap();
    let (spacing, n_built) = (t.inside.spacing, 1);
    let (goals, since) = (Vec::new(), InsideBefore::default());
    t.inside = Inside { t: inside, images, n_built, places, goals, occupied, spacing, since };
    t
}

/// Images of every second period alone: each cell is there in all places, and the vertex is not at the hull.
#[test]
fn images_of_a_coarser_lattice_are_refused() {
    let every = |step: i32| {
        let rows = (-1..=1).flat_map(move |a| (-1..=1).map(move |b| [step * a, step * b]));
        rows.filter(|shift| *shift != [0; 2]).collect::<Vec<_>>()
    };
    let right = with_images(&every(1));
    assert!(load::<Plane>(&right.saved().unwrap()).is_ok());
    let refused = |t: PeriodicTriangulation<Plane>| load::<Plane>(&t.saved().unwrap()).err();
    for shifts in [&every(2)[..], &[], &every(1)[..4]] {
        assert_eq!(refused(with_images(shifts)), Some(LoadError::Data(Damage::NoImages)), "{shifts:?}");
    }
    let twice = [every(1), vec![[1, 0]]].concat();
    let (inside, vertex) = (VertexId::new(9), VertexId::new(0));
    assert_eq!(refused(with_images(&twice)), Some(LoadError::Data(Damage::Image { inside, vertex })));
}

#[test]
fn kinds_of_data_are_told_apart() {
    let t = with_everything::<Plane>();
    let bytes = t.saved().unwrap();
    assert_eq!(Saved::of(&bytes).err(), Some(Damage::Periodic { is_periodic: true }));
    let open = MovingTriangulation::<Plane>::new(&[[0.0; 2]], Options::default()).unwrap().saved().unwrap();
    assert_eq!(SavedPeriodic::of(&open).err(), Some(Damage::Periodic { is_periodic: false }));
    let wrong = load::<Space>(&bytes).err();
    assert_eq!(wrong, Some(LoadError::Data(Damage::Dimension { given: 2 })));
    assert!(
        SavedPeriodic::is_of(&bytes, bytes.len() as u64) && !SavedPeriodic::is_of(&open, open.len() as u64)
    );
}

/// Ids are closed up; cells, positions and what is staged stay.
fn check_compaction<G: Moving>(seed: u64, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let points = random_points::<G>(rng, 12, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let identity = VertexId::range(0..12).collect::<Vec<_>>();
    assert_eq!(t.compact().unwrap(), identity);
    t.stage_removals(&[2, 7, 3].map(VertexId::new)).unwrap();
    t.commit_timestamp().unwrap();
    stage(&mut t, rng, basis);
    let mut before = t.try_clone(None).unwrap();
    let new_ids = t.compact().unwrap();
    assert_eq!((new_ids.len(), t.id_count()), (before.id_count(), before.id_count() - 3));
    assert_eq!((t.staged_count(), t.staged_edits()), (before.staged_count(), before.staged_edits()));
    for _ in 0..2 {
        for (old, &new) in VertexId::range(0..before.id_count()).zip(&new_ids) {
            let position = (new != crate::motion::NO_VERTEX).then(|| t.position_or_goal(new));
            assert_eq!(position.flatten(), before.position_or_goal(old), "seed {seed}");
        }
        assert!(by_id(&t, &|v| v) == by_id(&before, &|v| new_ids[v.index()]), "seed {seed}");
        assert_eq!(
            (t.timestamp(), t.violation(crate::motion::Level::Delaunay)),
            (before.timestamp(), Ok(None))
        );
        t.commit_timestamp().unwrap();
        before.commit_timestamp().unwrap();
    }
}

#[test]
fn compactions_keep_all_but_ids() {
    for seed in 0..12 {
        check_compaction::<Plane>(seed, &[[1.0, 0.0], [0.25, 1.0]]);
        check_compaction::<Plane>(seed, &[[1.0, 0.25]]);
        check_compaction::<Space>(seed, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.0, 1.0]]);
    }
}

/// Single vertices at once, while edits of others are staged: cells are those of what is made anew, and the edits stay.
fn check_at_once<G: Moving>(seed: u64, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let mut points = random_points::<G>(rng, 8, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let more = random_points::<G>(rng, 3, basis);
    let [first, second, last] = [0, 1, 7].map(VertexId::new);
    t.move_vertices(&[first, last], &more[..2]).unwrap();
    t.stage_removals(&[second]).unwrap();
    let mut wider = basis.to_vec();
    wider[0][0] += 0.5;
    t.stage_vectors(&wider).unwrap();
    assert!(matches!(
        t.relocate_vertex(first, &more[2]),
        Err(Error::DuplicateMove { argument: "vertex", .. })
    ));
    t.relocate_vertex(VertexId::new(2), &more[2]).unwrap();
    points[2] = more[2];
    assert_eq!(t.insert_vertex(&more[1]), Ok(VertexId::new(8)));
    points.push(more[1]);
    assert_eq!((t.timestamp(), t.staged_count(), t.staged_edits()), (0, 2, (0, 1)));
    check_loaded(&t);
    t.remove_vertex(last).unwrap();
    assert_eq!((t.staged_count(), t.is_present(last)), (1, false));
    check_loaded(&t);
    t.commit_timestamp().unwrap();
    assert_eq!((t.timestamp(), t.position(first), t.is_present(second)), (1, Ok(more[0]), false));
    assert!(t.vectors().eq(wider));
    check_loaded(&t);
    t.stage_insertions(&more).unwrap();
    assert!(matches!(t.insert_vertex(&more[0]), Err(Error::StagedVertex { .. })));
    let removed = t.remove_vertex(last);
    assert!(matches!(removed, Err(Error::RemovedVertex { argument: "vertex", .. })));
    let mut nan = more[0];
    nan[1] = f64::NAN;
    let bad = t.relocate_vertex(first, &nan);
    assert!(matches!(bad, Err(Error::NotFinite { argument: "position", axis: 1, .. })), "{bad:?}");
    assert_eq!(t.staged_edits(), (3, 0));
}

#[test]
fn single_vertices_change_at_once() {
    for seed in 0..8 {
        check_at_once::<Plane>(seed, &[[1.0, 0.0], [0.25, 1.0]]);
        check_at_once::<Space>(seed, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.0, 1.0]]);
    }
}

/// How often the balls ask for images without which the cells are right.
#[test]
#[ignore = "prints how often"]
fn copies_to_check() {
    let rng = &mut Rng::new(1);
    for size in [1e-4, 1e-3, 1e-2] {
        let basis = [[1.0, 0.0], [0.0, 1.0]];
        let mut points = random_points::<Plane>(rng, 10_000, &basis);
        let mut t = PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
        let mut n = 0;
        for _ in 0..100 {
            points.iter_mut().flatten().for_each(|x| *x += size * (rng.unit() - 0.5));
            t.commit_positions(&points).unwrap();
            let needed = crate::periodic::needed::Needed::of_all(&t.inside, &t.lattice).unwrap();
            n += usize::from(!needed.images.is_empty());
        }
        println!("{size}: {n} of 100");
    }
}
