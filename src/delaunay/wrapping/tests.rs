//! Fillings found in lanes beside those found by exact signs.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::random::Rng;

/// For each corner of a new cell, in ascending order, what is across the facet opposite it: the outer facet, or the
/// corners of the new cell there.
type Found = Vec<(SiteId, Option<Facet>, Vec<SiteId>)>;

/// The cells of a filling.
fn cells<G: Geometry>(hole: &Hole<G>) -> Vec<Found> {
    let ascending = |corners: &G::Corners| {
        let mut corners = corners.as_ref().to_vec();
        corners.sort_unstable();
        corners
    };
    let mut cells: Vec<_> = { hole.made.iter() }
        .map(|(corners, neighbours)| {
            let mut cell: Vec<_> = (0..G::Corners::N)
                .map(|i| {
                    let new = new_of(neighbours[i]);
                    let across = new.map_or(vec![], |new| ascending(&hole.made[new].0));
                    (corners[i], new.is_none().then_some(neighbours[i]), across)
                })
                .collect();
            cell.sort_unstable();
            cell
        })
        .collect();
    cells.sort_unstable();
    cells
}

/// For these points, in how many removals cells were found, how often they were not, and how often they were not looked
/// for. What is found is what exact signs find.
fn found<G: Geometry>(points: &[G::Point]) -> [usize; 3] {
    let mut t = Delaunay::<G>::default();
    t.add_sites(points).expect("room");
    t.rebuild(&mut |_| true).expect("room");
    let mut n = [0; 3];
    for s in t.live_sites().collect::<Vec<_>>() {
        t.gather_star(s).expect("room");
        let mut hole = memory::take_made(&mut t.hole).expect("room");
        t.label_link(&mut hole).expect("room");
        if hole.sites.len() <= MOST_SITES && !hole.sites.contains(&INFINITE) {
            if let Some(wrapping) = &mut t.wrapping {
                wrapping.skips = 0;
            }
            let is_found = t.wrap_in_lanes(s, &mut hole).expect("room");
            let found = is_found.then(|| cells(&hole));
            t.wrap(&mut hole).expect("room");
            assert!(found.is_none_or(|found| found == cells(&hole)), "site {s:?}");
            n[usize::from(!is_found)] += 1;
            // There is none without lanes.
            let open = t.wrapping.iter().flat_map(|wrapping| &wrapping.by_set);
            assert!({ open }.all(|&at| at == 0), "nothing is left for the next hole");
        } else {
            n[2] += 1;
        }
        t.restore_link_cells();
        t.hole = Some(hole);
    }
    n
}

fn points<G: Geometry>(n: usize, mut coordinate: impl FnMut() -> f64) -> Vec<G::Point> {
    let mut points = vec![G::Point::default(); n];
    points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = coordinate()));
    points
}

fn all_agree<G: Geometry>() {
    let rng = &mut Rng::new(1);
    let of_random = found::<G>(&points::<G>(3000, || rng.unit()));
    let scales = [1.0, 1e-3, 1e-6, 1e-9];
    let mut graded = points::<G>(3000, || 2.0 * rng.unit() - 1.0);
    for (k, p) in graded.iter_mut().enumerate() {
        (0..G::D).for_each(|axis| p[axis] *= scales[k % 4]);
    }
    let of_graded = found::<G>(&graded);
    let side = if G::D == 2 { 40.0 } else { 12.0 };
    let mut grid = points::<G>(2000, || (side * rng.unit()).floor());
    let of_grid = found::<G>(&grid);
    for p in &mut grid {
        (0..G::D).for_each(|axis| p[axis] += 1e-12 * rng.unit());
    }
    let of_near_ties = found::<G>(&grid);
    // Nearly all of what is random is found.
    for n in [of_random, of_graded] {
        assert!(n[0] > 2000 && 200 * n[1] < n[0], "{of_random:?} {of_graded:?}");
    }
    // Ties are not.
    assert!(of_grid[1] > 100 && of_near_ties[1] > 100, "{of_grid:?} {of_near_ties:?}");
}

#[test]
fn what_is_found_in_lanes_is_so() {
    all_agree::<Plane>();
    all_agree::<Space>();
}

/// Sets have a number each, and a permutation is odd if it exchanges two labels.
#[test]
fn sets_are_numbered() {
    let mut numbers = Vec::new();
    for c in 0..MOST_SITES as u8 {
        for b in 0..c {
            for a in 0..b {
                let (set, is_odd) = set_of::<Space>([a, b, c]);
                assert!(!is_odd && set_of::<Space>([b, c, a]) == (set, false));
                assert_eq!(set_of::<Space>([b, a, c]), (set, true));
                numbers.push(set);
            }
            let (set, is_odd) = set_of::<Plane>([b, c, 0]);
            assert!(!is_odd && set_of::<Plane>([c, b, 0]) == (set, true));
            assert!(set < SETS);
        }
    }
    numbers.sort_unstable();
    assert_eq!(numbers, (0..SETS).collect::<Vec<_>>());
}
