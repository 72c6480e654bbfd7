//! The points of tests that others have written for their regular triangulations, rebuilt as integers: coordinates,
//! and then the weight.

use crate::common::Rng;

/// Points in space.
pub type Set = Vec<Vec<i64>>;

/// The generator by which CGAL draws the points that it removes: that of Park and Miller with the factor 48271.
fn minstd(seed: u64) -> impl FnMut() -> i64 {
    let mut state = seed;
    move || {
        state = state * 48_271 % 2_147_483_647;
        state as i64
    }
}

/// Points on a grid of ten along each of so many axes, with weights from 0 to 9.
pub fn on_grid(n_axes: usize, n: usize, seed: u64) -> Set {
    let mut next = minstd(seed);
    (0..n)
        .map(|_| {
            let mut p = vec![0; 4];
            (0..n_axes).for_each(|k| p[k] = next() % 10);
            p[3] = next() % 10;
            p
        })
        .collect()
}

pub fn listed(rows: &[[i64; 4]]) -> Set {
    rows.iter().map(|p| p.to_vec()).collect()
}

/// Sets on which CGAL's removal once failed.
fn sets_that_were_hard_to_empty() -> Vec<Set> {
    vec![
        listed(&[[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 0, 0], [0, 0, 1, 1]]),
        listed(&[[0, 0, 0, 1], [1, 0, 0, 0], [0, 0, 0, 1], [0, 1, 0, 1]]),
        listed(&[[0, 0, 0, 1], [0, 0, 0, 0], [1, 0, 0, 0]]),
        listed(&[[9, 8, 1, 6], [3, 9, 4, 8], [1, 4, 0, 2], [0, 3, 0, 9], [0, 3, 0, 5]]),
        listed(&[[0, 3, 0, 5], [6, 9, 6, 1], [0, 8, 0, 1], [2, 1, 9, 5], [0, 3, 0, 9], [3, 5, 1, 9]]),
        listed(&[[7, 9, 9, 4], [7, 9, 9, 1]]),
        listed(&[
            [0, 6, 5, 1],
            [6, 0, 3, 2],
            [7, 1, 3, 2],
            [3, 8, 5, 7],
            [7, 7, 1, 0],
            [7, 1, 4, 3],
            [1, 7, 7, 3],
            [9, 2, 1, 7],
            [8, 8, 5, 6],
            [7, 7, 0, 6],
            [1, 8, 5, 2],
            [0, 9, 4, 9],
            [9, 2, 5, 7],
        ]),
        listed(&[[3, 2, 0, 0], [1, 4, 7, 5], [4, 4, 1, 5], [3, 3, 0, 1], [4, 0, 1, 5]]),
        listed(&[[0, 1, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0, 2, 0, 2]]),
        listed(&[[6, 0, 0, 0], [1, 0, 0, 1], [2, 0, 0, 8], [1, 0, 0, 0], [5, 0, 0, 3]]),
        listed(&[[4, 2, 0, 9], [1, 2, 0, 8], [0, 0, 0, 9], [2, 0, 0, 3], [2, 0, 0, 4]]),
        listed(&[[0, 3, 0, 5], [0, 3, 0, 9]]),
    ]
}

/// Points of a line that come in three groups, of weights 2, 5 and 1.
fn on_a_line() -> Set {
    let at = |m: i64, even: i64, odd: i64| if m % 2 == 0 { even } else { odd };
    let first = (0..5).map(|m| [at(m, 2 * m, 1 - 2 * m), 0, 0, 2]);
    let second = (0..5).map(|m| [at(m, 2 * m + 1, 1 - 2 * m), 0, 0, 5]);
    let third = (0..10).map(|m| [at(m, m, -m), 0, 0, 1]);
    first.chain(second).chain(third).map(|p| p.to_vec()).collect()
}

/// A sheared grid of a side of `n`, with a weight for each quarter.
pub fn sheared_grid(n: i64, weights: [i64; 4]) -> Set {
    let quarters = [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().zip(weights);
    let half = (n + 1) / 2;
    quarters
        .flat_map(|((i, j), w)| {
            let of = move |i: i64| if i == 0 { 0..half } else { half..n };
            of(i).flat_map(move |k| of(j).map(move |l| vec![k - l, k + 2 * l, 0, w]))
        })
        .collect()
}

/// Quadratic forms of three small numbers, so that many have a plane or a power sphere in common.
pub fn of_quadratic_forms() -> Set {
    let numbers = (0..10).flat_map(|a| (0..5).flat_map(move |b| (0..5).map(move |d| (a, b, d))));
    numbers
        .map(|(a, b, d): (i64, i64, i64)| {
            vec![a * b - d * a + (a - b) * 10 + a, a - b + d + 5 * b, a * a - d * d + b, a * b - a * d]
        })
        .collect()
}

/// A prism over an L in hundredths, where a corner comes once more with a weight of three tenths.
fn prism() -> Set {
    let outline = [[-7, 4], [9, 4], [9, -5], [5, -5], [5, 0], [-7, 0]];
    let mut set: Set = [4, -4].into_iter().flat_map(|z| outline.map(|[x, y]| vec![x, y, z, 0])).collect();
    set.insert(3, vec![9, -5, 4, 3_000]);
    set
}

/// Corners of tetrahedra and cubes, and what alpha complexes are made of.
pub fn of_alpha_complexes() -> Vec<Set> {
    let corner = [[1, -1, -1, 4], [-1, 1, -1, 4], [-1, -1, 1, 4], [1, 1, 1, 4], [2, 2, 2, 1]];
    // In hundredths, with weights in ten-thousandths.
    let six = [
        [0, 0, 0, 100],
        [0, 0, 20, 50],
        [20, 0, 20, 60],
        [60, 60, 0, 100],
        [80, 80, 20, 90],
        [20, 80, 60, 10],
    ];
    let cube = [
        [0, 0, 0, 1],
        [1, 0, 0, 2],
        [0, 1, 0, 1],
        [0, 0, 1, 4],
        [1, 1, 0, 1],
        [0, 1, 1, 1],
        [1, 0, 1, 1],
        [1, 1, 1, 8],
    ];
    let tetrahedron = [[0, 0, 0, 0], [2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 2]];
    let heavy_end = [[0, 0, 0, 0], [2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 5]];
    vec![listed(&corner), listed(&six), listed(&cube), listed(&tetrahedron), listed(&heavy_end)]
}

/// Coordinates from -10 to 10, weights from -1/2 to 1/2, in units of 1/1000 and of its square.
fn in_general_position(seed: u64) -> Set {
    let rng = &mut Rng::new(seed);
    let mut point = |_| {
        let mut p: Vec<i64> = (0..3).map(|_| rng.within(-10_000, 10_000)).collect();
        p.push(rng.within(-500_000, 500_000));
        p
    };
    (0..20).map(&mut point).collect()
}

/// A point of CGAL's test in the plane, by its number there, in sixteenths.
pub fn numbered(i: usize, weight_by_four: i64) -> Vec<i64> {
    let places = [
        (80, 96),
        (16, 144),
        (96, 224),
        (64, 192),
        (48, 464),
        (96, 112),
        (96, 624),
        (128, 144),
        (160, 288),
        (121, 249),
        (80, 400),
        (48, 120),
        (48, 128),
    ];
    let (x, y) = places[i];
    vec![x, y, 0, 64 * weight_by_four]
}

/// Those that it makes a line of: the third is hidden as it comes, the fourth by the fifth; then two at places that
/// are taken.
pub fn line_in_plane() -> Set {
    let rows = [(1, 80), (2, 80), (3, 4), (9, 4), (8, 80), (2, 4), (3, 80)];
    rows.map(|(i, w)| numbered(i, w)).to_vec()
}

/// Those of its triangles, on the line first, and what comes afterwards: three that are hidden, and three that hide.
pub fn in_plane() -> Set {
    let rows = [(1, 80), (3, 4), (9, 4), (8, 80), (2, 80), (4, 4), (6, 4), (0, 4), (5, 32), (7, 4), (10, 8)];
    let hidden = [(2, 4), (9, 2), (12, 8)];
    let hiding = [(3, 80), (9, 88), (12, 1_200)];
    rows.into_iter().chain(hidden).chain(hiding).map(|(i, w)| numbered(i, w)).collect()
}

pub fn sets() -> Vec<(String, Set)> {
    let mut sets: Vec<(String, Set)> = vec![
        ("nothing".into(), Vec::new()),
        ("one".into(), listed(&[[5, 6, 0, 1]])),
        ("one place".into(), listed(&[[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, -1]])),
        ("line".into(), on_a_line()),
        ("heavy on a line".into(), (-3..=3).map(|x| vec![x, 0, 0, if x == 0 { 10 } else { 0 }]).collect()),
        ("prism".into(), prism()),
        ("sheared grid of 9".into(), sheared_grid(3, [1; 4])),
        ("line in the plane".into(), line_in_plane()),
        ("in the plane".into(), in_plane()),
        ("grid of no axis".into(), on_grid(0, 10, 42)),
        ("grid of one axis".into(), on_grid(1, 20, 43)),
        ("grid of two axes".into(), on_grid(2, 30, 42)),
        ("grid of three axes".into(), on_grid(3, 40, 42)),
    ];
    let numbered = |name: &str, sets: Vec<Set>| {
        sets.into_iter().enumerate().map(|(i, set)| (format!("{name} {i}"), set)).collect::<Vec<_>>()
    };
    sets.extend(numbered("hard to empty", sets_that_were_hard_to_empty()));
    sets.extend(numbered("alpha complex", of_alpha_complexes()));
    sets.extend(numbered("general position", (0..3).map(in_general_position).collect()));
    sets
}

/// Points of a plane across the third axis, in that plane.
pub fn without_third_axis(set: &[Vec<i64>]) -> Set {
    set.iter().map(|p| vec![p[0], p[1], p[3]]).collect()
}

/// Those sets that are in a plane across the third axis, in that plane.
pub fn sets_in_plane() -> Vec<(String, Set)> {
    let flat = sets().into_iter().filter(|(_, set)| set.iter().all(|p| p[2] == 0));
    flat.map(|(name, set)| (name, without_third_axis(&set))).collect()
}
