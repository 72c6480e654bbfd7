//! Flips on one or several threads, and taking them back.

use super::*;
use crate::delaunay::{Failures, Level, Plane, Space};
use crate::machine::threads::Threads;
use crate::random::Rng;

/// A triangulation whose sites have moved by up to `size` along each axis, and the facets that fail; no cell is
/// inverted.
fn moved<G: Geometry>(n: usize, threads: u32, size: f64) -> (Delaunay<G>, Vec<Facet>) {
    let rng = &mut Rng::new(5);
    let mut points = vec![G::Point::default(); n];
    points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] = rng.unit()));
    let mut t = Delaunay::<G>::on(Threads::exactly(threads)).expect("room for it");
    t.add_sites(&points).expect("room for it");
    t.rebuild(&mut |_| true).expect("room for it");
    t.sort_cells(f64::INFINITY).expect("room for it");
    let facets = move_sites(&mut t, |old| {
        let mut q = *old;
        (0..G::D).for_each(|k| q[k] += size * (2.0 * rng.unit() - 1.0));
        Some(q)
    });
    (t, facets)
}

/// Moves the sites for which there is a place, but those that would invert a cell; returns the facets that fail.
fn move_sites<G: Geometry>(
    t: &mut Delaunay<G>,
    mut place: impl FnMut(&G::Point) -> Option<G::Point>,
) -> Vec<Facet> {
    let mut failures = Failures::default();
    for s in t.live_sites().collect::<Vec<_>>() {
        let old = t.site(s).point;
        let Some(q) = place(&old) else { continue };
        t.cover(&q, &q);
        t.set_point(s, q);
        failures.clear();
        t.check_star(s, &mut failures).expect("room for it");
        t.check_ridges(&mut failures, |_| None).expect("room for it");
        if !failures.cells.is_empty() || !failures.ridges.is_empty() {
            t.set_point(s, old);
        }
    }
    assert!(t.sweep(&mut failures, usize::MAX, None).expect("room for it") && failures.cells.is_empty());
    failures.facets
}

/// Flips on several threads lead to a Delaunay triangulation, and most of them are done side by side.
fn threads_flip<G: Geometry>(size: f64) {
    for threads in [2, 3, 7] {
        let (mut t, mut suspects) = moved::<G>(4000, threads, size);
        assert!(suspects.len() > 300, "{}", suspects.len());
        t.record_changes(Vec::new());
        let mut stuck = Vec::new();
        let n_flips =
            t.flip_all(&mut suspects, &mut stuck, u64::MAX).expect("room for it").expect("no limit");
        assert_eq!(stuck, []);
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
        let flips = t.flips.as_ref().expect("there were some");
        let parts: Vec<u64> = flips.parts.iter().map(|part| part.n_flips).collect();
        assert_eq!(parts.len(), threads as usize);
        assert!(parts.iter().all(|&n| n > 0), "{parts:?}");
        assert!(2 * parts.iter().sum::<u64>() > n_flips, "{parts:?} of {n_flips}");
        // All cells that are new are in the record.
        let changed = t.take_changes().expect("a record");
        let (old, _) = moved::<G>(4000, threads, size);
        for c in t.complex.live().filter(|c| !changed.contains(c)) {
            assert_eq!(t.complex.cell(c).corners, old.complex.cell(c).corners);
        }
    }
}

#[test]
fn threads_flip_in_both_dimensions() {
    threads_flip::<Plane>(2e-3);
    threads_flip::<Space>(2e-3);
}

/// The four cells around the shorter diagonal of a square become those around the other one when it is the shorter,
/// also where those on one side are ghosts.
#[test]
fn diagonals_change_in_space() {
    let square = |a: f64| [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, a, 0.0], [0.0, -a, 0.0]];
    let sides = [[0.1, 0.2, 2.0], [0.1, -0.1, -2.0]];
    for sides in [&sides[..], &sides[..1], &sides[1..]] {
        let mut t = Delaunay::<Space>::default();
        t.add_sites(&[&square(0.9)[..], sides].concat()).expect("room for it");
        t.rebuild(&mut |_| true).expect("room for it");
        assert_eq!(t.complex.n_finite(), 2 * sides.len());
        let before: Vec<_> = t.complex.cells().iter().map(|cell| cell.corners).collect();
        for s in t.live_sites().collect::<Vec<_>>() {
            if let Some(place) = square(1.1).get(t.site(s).id.index()) {
                t.cover(place, place);
                t.set_point(s, *place);
            }
        }
        let mut failures = Failures::default();
        assert!(t.sweep(&mut failures, usize::MAX, None).expect("room for it") && failures.cells.is_empty());
        t.check_ridges(&mut failures, |_| None).expect("room for it");
        assert_eq!((failures.facets.len(), &failures.ridges[..]), (sides.len(), &[][..]));
        let mut flips = Box::new(AllFlips::default());
        flips.own.suspects.clone_from(&failures.facets);
        t.flip_as_far_as_possible(&mut flips, 1, u64::MAX, WhenStuck::Leave).expect("room for it");
        t.flips = Some(flips);
        t.undo_flips();
        t.validate(Level::Embedding).expect("cells as they were");
        assert!(t.complex.cells().iter().map(|cell| cell.corners).take(before.len()).eq(before));
        let mut stuck = Vec::new();
        t.record_changes(Vec::new());
        assert_eq!(t.flip_all(&mut failures.facets, &mut stuck, u64::MAX), Ok(Some(1)));
        assert_eq!(stuck, []);
        // All four cells are new, and recorded.
        let changed = t.take_changes().expect("a record");
        assert_eq!(t.complex.live().filter(|c| changed.contains(c)).count(), 4);
        assert_eq!(t.complex.n_finite(), 2 * sides.len());
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }
}

/// Flips on one or several threads are taken back: corners, gluings and free cells are as they were.
#[test]
fn flips_come_back() {
    for threads in [1, 3] {
        let (mut t, mut suspects) = moved::<Space>(2000, threads, 3e-3);
        let places = |t: &Delaunay<Space>| {
            let corners = t.complex.cells().iter().map(|cell| cell.corners);
            let neighbours = t.complex.live().map(|c| [0, 1, 2, 3].map(|i| t.complex.cell(c).neighbour(i)));
            (corners.collect::<Vec<_>>(), neighbours.collect::<Vec<_>>())
        };
        let (before, n_free) = (places(&t), t.complex.n_free());
        let mut flips = memory::take_made(&mut t.flips).expect("room for it");
        flips.own.suspects.append(&mut suspects);
        t.flip_as_far_as_possible(&mut flips, threads as usize, u64::MAX, WhenStuck::Leave)
            .expect("room for it");
        let n_flips =
            flips.own.journal.len() + flips.parts.iter().map(|part| part.journal.len()).sum::<usize>();
        assert!(n_flips > 100, "{n_flips}");
        t.flips = Some(flips);
        assert_ne!(places(&t), before);
        // One thread has had to make room.
        assert!(threads > 1 || t.complex.n_slots() > before.0.len());
        t.undo_flips();
        let after = places(&t);
        assert_eq!(after.0[..before.0.len()], before.0);
        assert_eq!(after.1, before.1);
        assert_eq!(t.complex.n_free() - n_free, t.complex.n_slots() - before.0.len());
        t.validate(Level::Structure).expect("cells as they were");
    }
}

/// Thin layers, of which a tenth of the sites have left their places, and the facets that fail.
fn disturbed_layers(seed: u64) -> (Delaunay<Space>, Vec<Facet>) {
    let rng = &mut Rng::new(seed);
    let place = |i: usize| [(i % 18) as f64, (i / 18 % 18) as f64, 1e-3 * (i / 324) as f64];
    let mut t = Delaunay::<Space>::default();
    t.add_sites(&(0..5832).map(place).collect::<Vec<_>>()).expect("room for it");
    t.rebuild(&mut |_| true).expect("room for it");
    let facets = move_sites(&mut t, |old| {
        let q = old.map(|x| x + 1e-4 * (rng.unit() - 0.5));
        (rng.below(10) == 0).then_some(q)
    });
    (t, facets)
}

/// Around facets that are stuck all is triangulated again; that comes back like flips, and is recorded like them.
#[test]
fn islands_are_filled() {
    // About every fifth has facets that are stuck; which depends on the order of the flips, so on the processor.
    let mut n_filled = 0;
    for seed in 0.. {
        assert!(seed < 60, "{n_filled} filled");
        let (mut t, mut suspects) = disturbed_layers(seed);
        let rows =
            |t: &Delaunay<Space>| t.complex.cells().iter().map(|cell| cell.corners).collect::<Vec<_>>();
        let (before, n_free) = (rows(&t), t.complex.n_free());
        let flip = |t: &mut Delaunay<Space>, when_stuck| {
            let mut flips = AllFlips::default();
            flips.own.suspects.clone_from(&suspects);
            t.flip_as_far_as_possible(&mut flips, 1, u64::MAX, when_stuck).expect("room for it");
            let is_stuck = !flips.own.stuck.is_empty();
            t.take_back(&mut flips);
            assert_eq!(rows(t)[..before.len()], before);
            assert_eq!(t.complex.n_free() - n_free, t.complex.n_slots() - before.len());
            t.validate(Level::Structure).expect("cells as they were");
            is_stuck
        };
        if !flip(&mut t, WhenStuck::Leave) {
            continue;
        }
        if flip(&mut t, WhenStuck::Fill) {
            continue;
        }
        n_filled += 1;
        let mut stuck = Vec::new();
        t.record_changes(Vec::new());
        assert!(t.flip_all(&mut suspects, &mut stuck, u64::MAX).expect("room for it").is_some());
        assert_eq!(stuck, []);
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
        let changed = t.take_changes().expect("a record");
        let is_new = |&c: &Slot| before.get(c.index()) != Some(&t.complex.cell(c).corners);
        assert!(t.complex.live().filter(is_new).all(|c| changed.contains(&c)));
        if n_filled == 2 {
            break;
        }
    }
}

/// What is stuck on one of several threads is a suspect for the last one.
#[test]
fn stuck_facets_of_a_thread_are_suspects_again() {
    let (mut t, _) = moved::<Plane>(2000, 2, 0.0);
    let finite: Vec<Slot> = t.complex.live().filter(|&c| !t.complex.cell(c).is_ghost()).collect();
    let stuck = [finite[10], finite[finite.len() - 10]].map(|c| Facet::new(c, 1));
    let mut flips = AllFlips::<Plane>::default();
    flips.own.suspects.extend(finite.iter().map(|&c| Facet::new(c, 0)));
    for facet in stuck {
        flips.parts.push(Flips { stuck: vec![facet], ..Flips::default() });
    }
    t.flip_side_by_side(&mut flips, 2).expect("room for it");
    assert!(stuck.iter().all(|facet| flips.own.suspects.contains(facet)));
    assert!(flips.parts.iter().all(|part| part.n_flips == 0 && part.stuck.is_empty()));
}

/// A random place on the unit sphere, as near as numbers come, within some `step` of where it comes from.
fn on_sphere(rng: &mut Rng, from: [f64; 3], step: f64) -> [f64; 3] {
    let p = from.map(|x| x + step * (2.0 * rng.unit() - 1.0));
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / length)
}

/// The relocation of a site whose flips are stuck, as they sometimes are on a sphere, leaves the cells as they were.
#[test]
fn stuck_relocations_come_back() {
    let rng = &mut Rng::new(7);
    let (mut n_stuck, mut n_flipped) = (0, 0);
    let corners = |t: &Delaunay<Space>| t.complex.cells().iter().map(|cell| cell.corners).collect::<Vec<_>>();
    for _ in 0..12 {
        let mut t = Delaunay::<Space>::default();
        t.add_sites(&[(); 150].map(|()| on_sphere(rng, [0.0; 3], 1.0))).expect("room for it");
        t.rebuild(&mut |_| true).expect("room for it");
        for s in (0..3).flat_map(|_| t.live_sites().collect::<Vec<_>>()).collect::<Vec<_>>() {
            let (old, before) = (t.site(s).point, corners(&t));
            let q = on_sphere(rng, old, 0.02);
            t.cover(&q, &q);
            t.set_point(s, q);
            let mut failures = Failures::default();
            t.check_star(s, &mut failures).expect("room for it");
            t.check_ridges(&mut failures, |_| None).expect("room for it");
            if !failures.cells.is_empty() || !failures.ridges.is_empty() {
                t.set_point(s, old);
                continue;
            }
            t.gather_star(s).expect("room for it");
            if t.flip_star().expect("room for it").is_some() {
                n_flipped += 1;
                continue;
            }
            n_stuck += 1;
            t.set_point(s, old);
            assert!(corners(&t).starts_with(&before));
            t.validate(Level::Delaunay).expect("cells as they were");
        }
    }
    assert!(n_stuck > 3 && n_flipped > 1000, "{n_stuck} stuck, {n_flipped} not");
}
