//! Untangling after motions, and undoing it.

use super::*;
use crate::delaunay::{Level, Plane, Space};
use crate::machine::threads::Threads;
use crate::random::Rng;

/// A lattice, in any order.
fn lattice<G: Geometry>(side: usize, rng: &mut Rng) -> Vec<G::Point> {
    let mut points: Vec<G::Point> = (0..side.pow(G::D as u32))
        .map(|i| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|k| p[k] = (i / side.pow(k as u32) % side) as f64);
            p
        })
        .collect();
    for k in (1..points.len()).rev() {
        points.swap(k, (rng.unit() * (k + 1) as f64) as usize);
    }
    points
}

fn built<G: Geometry>(points: &[G::Point]) -> Delaunay<G> {
    built_on(points, 1)
}

fn built_on<G: Geometry>(points: &[G::Point], threads: u32) -> Delaunay<G> {
    let mut t = Delaunay::<G>::on(Threads::exactly(threads)).expect("room for it");
    t.add_sites(points).expect("room for it");
    t.rebuild(&mut |_| true).expect("room for it");
    t
}

/// Moves all sites, and sweeps.
fn move_all<G: Geometry>(t: &mut Delaunay<G>, points: &[G::Point]) -> Failures {
    for s in t.live_sites().collect::<Vec<_>>() {
        let q = points[t.site(s).id.index()];
        t.cover(&q, &q);
        t.set_point(s, q);
    }
    let mut failures = Failures::default();
    assert!(t.sweep(&mut failures, usize::MAX, None).expect("room for it"));
    failures
}

/// What there is: how many ghosts, and of every cell its slot, corners and neighbours.
fn contents<G: Geometry>(t: &Delaunay<G>) -> Vec<u32> {
    let mut numbers = vec![t.complex.n_ghosts() as u32];
    for c in t.complex.live() {
        let cell = t.complex.cell(c);
        numbers.push(c.get());
        numbers.extend(cell.corners.as_ref().iter().map(|s| s.get()));
        numbers.extend((0..G::Corners::N).map(|i| cell.neighbour(i).code()));
    }
    numbers
}

fn n_ghosts_counted<G: Geometry>(t: &Delaunay<G>) -> usize {
    t.complex.live().filter(|&c| t.complex.cell(c).is_ghost()).count()
}

/// Whether all cells are positive and the hull is convex.
fn is_untangled<G: Geometry>(t: &Delaunay<G>) -> bool {
    let is_right = |c: Slot| {
        if t.is_ghost(c) { (0..G::D).all(|i| t.is_convex(Facet::new(c, i))) } else { t.is_positive(c) }
    };
    t.complex.live().all(is_right)
}

fn take_none_back<G: Geometry>(_: &mut Delaunay<G>, _: &[SiteId]) -> Result<Option<SiteId>> {
    Ok(None)
}

/// Untangles, undoes that, does it again, and flips; whether it could be done. If not, nothing has changed.
fn mends<G: Geometry>(t: &mut Delaunay<G>, failures: &mut Failures) -> bool {
    let before = contents(t);
    let mut suspects = Vec::new();
    let is_done = t.untangle(failures, &mut suspects, u64::MAX, &mut take_none_back).expect("room for it");
    if is_done {
        assert!(is_untangled(t));
        assert_eq!(t.complex.n_ghosts(), n_ghosts_counted(t));
        t.undo_flips();
    }
    assert!(contents(t) == before, "what is undone leaves a trace");
    if !is_done {
        return false;
    }
    suspects.clear();
    assert_eq!(t.untangle(failures, &mut suspects, u64::MAX, &mut take_none_back), Ok(true));
    suspects.extend_from_slice(&failures.facets);
    let mut stuck = Vec::new();
    t.flip_all(&mut suspects, &mut stuck, u64::MAX).expect("room for it").expect("no limit");
    assert_eq!(stuck, []);
    t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    true
}

/// The sides of a lattice that is sheared, again and again, are in a plane but for rounding. Returns how often cells
/// were not positive, and how often all of them were, but the hull was dented.
fn sheared_lattices<G: Geometry>(side: usize, n_steps: usize) -> [usize; 2] {
    let mut points = lattice::<G>(side, &mut Rng::new(1));
    let mut n_tangled = [0; 2];
    for _ in 0..n_steps {
        let mut t = built::<G>(&points);
        for p in &mut points {
            p[0] += 0.001 * p[1];
        }
        let mut failures = move_all(&mut t, &points);
        if is_untangled(&t) {
            continue;
        }
        n_tangled[usize::from(failures.cells.is_empty())] += 1;
        assert!(mends(&mut t, &mut failures), "not untangled");
    }
    n_tangled
}

#[test]
fn sheared_lattices_are_untangled() {
    let [cells, dents] = sheared_lattices::<Plane>(30, 40);
    assert!(cells > 10 && dents > 2, "{cells} and {dents}");
    let [cells, dents] = sheared_lattices::<Space>(9, 40);
    assert!(cells > 3 && dents > 3, "{cells} and {dents}");
}

/// Random points go farther and farther: at first nearly always all can be mended, in the end it is not even tried for
/// long.
fn random_points<G: Geometry>(n: usize, sizes: [f64; 2]) {
    let rng = &mut Rng::new(2);
    for (size, is_large) in sizes.into_iter().zip([false, true]) {
        let (mut n_tangled, mut n_mended) = (0, 0);
        for _ in 0..60 {
            let mut points = vec![G::Point::default(); n];
            points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] = rng.unit()));
            let mut t = built::<G>(&points);
            points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] += size * (rng.unit() - 0.5)));
            let mut failures = move_all(&mut t, &points);
            if !is_untangled(&t) {
                let before = t.certificates();
                n_tangled += 1;
                n_mended += usize::from(mends(&mut t, &mut failures));
                assert!(!is_large || t.certificates() - before < 20 * n as u64);
            }
        }
        assert!(n_tangled > 30, "{n_tangled}");
        assert!(
            if is_large { n_mended == 0 } else { 10 * n_mended > 7 * n_tangled },
            "{n_mended} of {n_tangled}"
        );
    }
}

#[test]
fn random_cells_are_untangled() {
    random_points::<Plane>(300, [0.003, 0.5]);
    random_points::<Space>(300, [0.003, 0.5]);
}

/// Where vertices of cells and ridges that cannot be exchanged are taken back, all can be untangled, though some only
/// from the start again; what is left where it cannot is the cells from before.
fn vertices_are_taken_back<G: Geometry>(n: usize, size: f64) {
    let rng = &mut Rng::new(4);
    let (mut n_tangled, mut n_mended, mut n_again, mut n_back) = (0, 0, 0, 0);
    for _ in 0..80 {
        let mut old = vec![G::Point::default(); n];
        old.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] = rng.unit()));
        let mut t = built::<G>(&old);
        let mut new = old.clone();
        new.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] += size * (rng.unit() - 0.5)));
        let mut failures = move_all(&mut t, &new);
        let mut suspects = Vec::new();
        if is_untangled(&t)
            || t.untangle(&mut failures, &mut suspects, u64::MAX, &mut take_none_back) == Ok(true)
        {
            continue;
        }
        n_tangled += 1;
        let before = contents(&t);
        let mut is_done = false;
        for attempt in 0..4 {
            let n_listed = failures.cells.len();
            let mut back = Vec::new();
            let mut take_back = |t: &mut Delaunay<G>, sites: &[SiteId]| {
                let is_new = |&&s: &&SiteId| t.site(s).point != old[t.site(s).id.index()];
                let s = sites.iter().find(is_new).copied();
                if let Some(s) = s {
                    back.push(s);
                    let place = old[t.site(s).id.index()];
                    t.set_point(s, place);
                }
                Ok(s)
            };
            is_done =
                t.untangle(&mut failures, &mut suspects, u64::MAX, &mut take_back).expect("room for it");
            assert_eq!(failures.cells.len(), n_listed);
            n_back += back.len();
            if is_done {
                n_again += usize::from(attempt > 0);
                break;
            }
            assert!(contents(&t) == before, "what is undone leaves a trace");
            for s in back {
                t.check_star(s, &mut failures).expect("room for it");
            }
        }
        if !is_done {
            continue;
        }
        n_mended += 1;
        assert!(is_untangled(&t));
        suspects.extend_from_slice(&failures.facets);
        let mut stuck = Vec::new();
        t.flip_all(&mut suspects, &mut stuck, u64::MAX).expect("room for it").expect("no limit");
        if stuck.is_empty() {
            t.validate(Level::Delaunay).expect("a Delaunay triangulation");
        } else {
            t.undo_flips();
            assert!(contents(&t) == before, "what is undone leaves a trace");
        }
    }
    assert!(
        n_tangled > 40 && n_mended == n_tangled && n_again > 0,
        "{n_mended} of {n_tangled}, {n_again} again"
    );
    assert!(n_back > n_tangled && n_back < n_tangled * n / 10, "{n_back} vertices");
}

#[test]
fn vertices_of_cells_are_taken_back() {
    vertices_are_taken_back::<Plane>(300, 0.02);
    vertices_are_taken_back::<Space>(300, 0.04);
}

/// Not more certificates are evaluated than allowed, but for those of one cell.
#[test]
fn untangling_ends_where_it_takes_too_much() {
    let mut points = lattice::<Space>(9, &mut Rng::new(1));
    let mut n_ended = 0;
    for _ in 0..8 {
        let mut t = built::<Space>(&points);
        points.iter_mut().for_each(|p| p[0] += 0.001 * p[1]);
        let mut failures = move_all(&mut t, &points);
        let before = (contents(&t), t.certificates());
        if !is_untangled(&t)
            && t.untangle(&mut failures, &mut Vec::new(), 50, &mut take_none_back) == Ok(false)
        {
            n_ended += 1;
            assert!(t.certificates() - before.1 < 150, "{}", t.certificates() - before.1);
            assert!(contents(&t) == before.0);
        } else {
            t.undo_flips();
        }
    }
    assert!(n_ended > 3, "{n_ended}");
}

/// What several threads have flipped before stays when untangling is undone.
#[test]
fn undoing_goes_back_to_before_untangling_only() {
    let rng = &mut Rng::new(3);
    let mut points = vec![[0.0; 3]; 3000];
    points.iter_mut().flatten().for_each(|x| *x = rng.unit());
    let mut t = built_on::<Space>(&points, 3);
    t.sort_cells(f64::INFINITY).expect("room for it");
    let mut n_after_several = 0;
    for _ in 0..30 {
        points.iter_mut().flatten().for_each(|x| *x += 4e-4 * rng.unit());
        let mut failures = move_all(&mut t, &points);
        if is_untangled(&t) {
            let (mut suspects, mut stuck) = (failures.facets, Vec::new());
            t.flip_all(&mut suspects, &mut stuck, u64::MAX).expect("room for it").expect("no limit");
            assert!(stuck.is_empty());
            continue;
        }
        let were_several =
            t.flips.as_ref().is_some_and(|flips| flips.parts.iter().any(|part| part.n_flips > 0));
        if mends(&mut t, &mut failures) {
            n_after_several += usize::from(were_several);
        } else {
            t = built_on(&points, 3);
            t.sort_cells(f64::INFINITY).expect("room for it");
        }
    }
    assert!(n_after_several > 3, "{n_after_several}");
}

/// Of these ten lattices three have dents that are stuck in the first order.
#[test]
fn dents_that_are_stuck_are_filled_in_another_order() {
    let mut n_mended = 0;
    for seed in 1..11 {
        let mut points = lattice::<Space>(20, &mut Rng::new(seed));
        let mut t = built::<Space>(&points);
        points.iter_mut().for_each(|p| p[0] += 0.001 * p[1]);
        let mut failures = move_all(&mut t, &points);
        n_mended += usize::from(mends(&mut t, &mut failures));
    }
    assert!(n_mended > 8, "{n_mended}");
}

/// Vertices just below the middle of a polygon that is flat but for rounding: flat cells share them, and taking one
/// away looks at a star of as many cells as there are corners. It ends within its budget and one such star all the
/// same.
#[test]
fn peeling_below_a_polygon_ends_in_time() {
    const CORNERS: usize = 1000;
    // Among two hundred seeds the two with which peeling goes on longest.
    for seed in [85, 119] {
        let rng = &mut Rng::new(seed);
        let angle = |i: usize| i as f64 * std::f64::consts::TAU / CORNERS as f64;
        let mut points: Vec<_> = (0..CORNERS).map(|i| [angle(i).cos(), angle(i).sin(), 1.0]).collect();
        let n_below = 1 + seed as usize % 8;
        for k in 1..=n_below {
            points.push([0.1 * rng.unit(), 0.1 * rng.unit(), 1.0 - 1e-11 * k as f64]);
        }
        points.extend((0..30).map(|_| [rng.unit() - 0.5, rng.unit() - 0.5, -1.0 - rng.unit()]));
        let mut t = built::<Space>(&points);
        for p in &mut points[..CORNERS] {
            p[2] += 1e-13 * (rng.unit() - 0.5);
            if rng.unit() * (CORNERS as f64) < 6.0 {
                p[2] += 1.5e-11 * (rng.unit() - 0.5);
            }
        }
        for p in &mut points[CORNERS..CORNERS + n_below - 1] {
            p[2] += 1e-11 * rng.unit().powi(3) * (rng.unit() - 0.5);
        }
        let mut failures = move_all(&mut t, &points);
        let (before, most) = (contents(&t), t.n_certificates() / 2);
        let start = t.certificates();
        let is_done =
            t.untangle(&mut failures, &mut Vec::new(), most, &mut take_none_back).expect("room for it");
        let spent = t.certificates() - start;
        assert!(spent < most + CORNERS as u64, "seed {seed}: {spent} of {most}");
        assert!(!is_done && spent > most, "seed {seed}: {spent} of {most}");
        assert!(contents(&t) == before, "what is undone leaves a trace");
    }
}
