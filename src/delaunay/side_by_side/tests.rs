//! Placements on several threads beside builds of the same sites.

use super::*;
use crate::complex::Facet;
use crate::delaunay::{Level, Plane, Shortcut, Space};
use crate::machine::threads::Threads;
use crate::random::Rng;
use std::collections::BTreeSet;

/// A random place, in a box or on a lattice in it.
fn place<G: Dimension>(rng: &mut Rng, lattice: Option<f64>) -> G::Point {
    let mut p = G::Point::default();
    for axis in 0..G::D {
        let x = rng.unit();
        p[axis] = lattice.map_or(x, |n| (n * x).floor());
    }
    p
}

fn triangulation<G: Dimension>(places: &[G::Point], threads: u32) -> Delaunay<G> {
    let mut t = Delaunay::<G>::on(Threads::exactly(threads)).expect("room");
    t.add_sites(places).expect("room");
    t.rebuild(&mut |_| true).expect("room");
    t.sort_cells(f64::INFINITY).expect("room");
    t
}

/// Distinct places, so that each has a site.
fn distinct<G: Dimension>(n: usize, rng: &mut Rng, lattice: Option<f64>) -> Vec<G::Point> {
    let mut taken = BTreeSet::new();
    let mut places = Vec::new();
    while places.len() < n {
        let p = place::<G>(rng, lattice);
        if taken.insert((0..G::D).map(|axis| p[axis].to_bits()).collect::<Vec<_>>()) {
            places.push(p);
        }
    }
    places
}

/// The cells by the ids of their corners, each in ascending order.
fn cells<G: Dimension>(t: &Delaunay<G>) -> BTreeSet<Vec<u32>> {
    let ids = |c: Slot| {
        let mut ids: Vec<_> =
            t.complex.cell(c).corners.as_ref().iter().map(|&s| t.sites[s].id.get()).collect();
        ids.sort_unstable();
        ids
    };
    t.complex.finite().map(ids).collect()
}

/// What is in each slot.
fn slots<G: Dimension>(t: &Delaunay<G>) -> Vec<(G::Corners, Vec<Facet>)> {
    let of = |c: Slot| {
        let cell = t.complex.cell(c);
        let neighbours = (0..G::Corners::N).map(|i| cell.neighbour(i)).collect();
        (cell.corners, if cell.is_free() { vec![] } else { neighbours })
    };
    Slot::range(0..t.complex.n_slots()).map(of).collect()
}

/// Every `nth` site to a random place; on a lattice some of these are those of other sites.
fn goals<G: Dimension>(t: &Delaunay<G>, nth: usize, rng: &mut Rng, lattice: Option<f64>) -> Vec<Goal<G>> {
    let goals = t.live_sites().step_by(nth).map(|site| Goal { site, place: place::<G>(rng, lattice) });
    goals.filter(|goal| t.is_away(goal.site, &goal.place)).collect()
}

/// Leaps on several threads, again and again; returns how many of all were done side by side, and how many met others.
fn leaps<G: Dimension>(n: usize, threads: u32, lattice: Option<f64>) -> (f64, usize) {
    let rng = &mut Rng::new(u64::from(threads));
    let mut t = triangulation::<G>(&distinct::<G>(n, rng, lattice), threads);
    let (mut n_placed, mut n_goals, mut n_met) = (0, 0, 0);
    for round in 0..6 {
        let before = (slots(&t), cells(&t));
        let mut goals = goals(&t, 10, rng, lattice);
        let wanted: Vec<_> = goals.iter().map(|goal| goal.place).collect();
        let old: Vec<_> = goals.iter().map(|goal| t.sites[goal.site].point).collect();
        t.begin().expect("room");
        let mut placed = Vec::new();
        t.place_side_by_side(&mut goals, &mut placed).expect("room");
        let numbers: BTreeSet<_> = placed.iter().map(|&(goal, _)| goal as usize).collect();
        assert_eq!(numbers.len(), placed.len());
        for (k, goal) in goals.iter().enumerate() {
            let is_placed = numbers.contains(&k);
            assert_eq!(goal.place, if is_placed { old[k] } else { wanted[k] });
        }
        for &(k, other) in &placed {
            let goal = &goals[k as usize];
            match other {
                None => assert_eq!(t.sites[goal.site].point, wanted[k as usize]),
                Some(other) => {
                    assert_eq!(t.sites[other].point, wanted[k as usize]);
                    assert!(!t.sites[goal.site].is_live());
                    n_met += 1;
                }
            }
        }
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
        if round % 3 == 2 {
            // The places of sites are the caller's concern; those that were removed have theirs back.
            t.undo();
            for (k, goal) in goals.iter().enumerate() {
                t.sites[goal.site].point = old[k];
            }
            t.validate(Level::Delaunay).expect("a Delaunay triangulation");
            assert_eq!(cells(&t), before.1);
            assert_eq!(slots(&t), before.0);
            continue;
        }
        t.end();
        n_placed += placed.len();
        n_goals += goals.len();
        for k in (0..goals.len()).filter(|k| !numbers.contains(k)) {
            let id = t.sites[goals[k].site].id;
            t.relocate_site(goals[k].site, &wanted[k], id, Shortcut::Flips).expect("room");
        }
        let live: Vec<_> = t.live_sites().map(|s| (t.sites[s].point, t.sites[s].id)).collect();
        let mut again = Delaunay::<G>::on(Threads::ONE).expect("room");
        for (point, id) in live {
            again.add_site(point, id).expect("room");
        }
        again.rebuild(&mut |_| true).expect("room");
        assert_eq!(cells(&t), cells(&again));
    }
    (n_placed as f64 / n_goals as f64, n_met)
}

/// There is nothing to do without lanes.
fn most_are_placed<G: Dimension>(n: usize) {
    for threads in [2, 3, 4] {
        let (placed, met) = leaps::<G>(n, threads, None);
        assert_eq!(met, 0);
        assert!(Avx2::new().is_none() && placed == 0.0 || placed > 0.4, "{threads} threads: {placed}");
    }
}

#[test]
fn most_are_placed_in_the_plane() {
    most_are_placed::<Plane>(6000);
}

#[test]
fn most_are_placed_in_space() {
    most_are_placed::<Space>(4000);
}

#[test]
fn ties_and_meetings_are_those_of_a_build() {
    let (_, met) = leaps::<Plane>(3000, 3, Some(64.0));
    let (_, met_in_space) = leaps::<Space>(2000, 2, Some(14.0));
    assert!(Avx2::new().is_none() || met + met_in_space > 0);
}

/// Ranges stay what they are for, as cells come into slots near those that they replace: until each has been replaced
/// twice, after which they are sorted again, most leaps are done side by side.
#[test]
fn most_are_placed_later_on() {
    let rng = &mut Rng::new(8);
    let mut t = triangulation::<Space>(&distinct::<Space>(8000, rng, None), 2);
    let mut shares = Vec::new();
    for _ in 0..12 {
        let mut goals = goals(&t, 30, rng, None);
        let mut placed = Vec::new();
        t.place_side_by_side(&mut goals, &mut placed).expect("room");
        shares.push(placed.len() as f64 / goals.len() as f64);
        let left = (0..goals.len() as u32).filter(|k| placed.iter().all(|(placed, _)| placed != k));
        for Goal { site, place } in left.map(|k| goals[k as usize]) {
            let id = t.sites[site].id;
            t.relocate_site(site, &place, id, Shortcut::Flips).expect("room");
        }
    }
    t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    let later = shares[8..].iter().sum::<f64>() / 4.0;
    assert!(Avx2::new().is_none() || later > 0.7, "{shares:?}");
}
