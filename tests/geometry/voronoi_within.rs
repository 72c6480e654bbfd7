//! Voronoi cells in half-spaces, against exact rationals, boxes and themselves: with planes through corners and along
//! faces, equal, opposite and nearly parallel ones, and many.

use super::exact_cells::{ExactCell, ExactFace, exact_cell};
use crate::common::{Rng, point, seeds};
use deldrift::motion::{MovingTriangulation, Options, Saved, VoronoiCells};
use deldrift::{Dimension, Error, Plane, Space};

/// Points of either dimension as the oracle takes them.
trait Exact: Dimension {
    /// A cell in a box.
    fn whole(places: &[Self::Point], of: usize, clip: [&Self::Point; 2]) -> ExactCell;

    /// Cuts a cell by half-spaces, which are numbered from `n` on.
    fn cut(cell: &mut ExactCell, n: usize, rows: &[f64]);
}

impl Exact for Plane {
    fn whole(places: &[[f64; 2]], of: usize, clip: [&[f64; 2]; 2]) -> ExactCell {
        exact_cell(places, of, clip)
    }

    fn cut(cell: &mut ExactCell, n: usize, rows: &[f64]) {
        rows.chunks(3).enumerate().for_each(|(k, row)| cell.cut_by::<2>(row, n + k));
    }
}

impl Exact for Space {
    fn whole(places: &[[f64; 3]], of: usize, clip: [&[f64; 3]; 2]) -> ExactCell {
        exact_cell(places, of, clip)
    }

    fn cut(cell: &mut ExactCell, n: usize, rows: &[f64]) {
        rows.chunks(4).enumerate().for_each(|(k, row)| cell.cut_by::<3>(row, n + k));
    }
}

/// What half-spaces leave of a box.
fn region<G: Exact>(clip: [&G::Point; 2], rows: &[f64]) -> ExactCell {
    let mut region = G::whole(&[*clip[0]], 0, clip);
    G::cut(&mut region, 1, rows);
    region
}

/// What a corner may be off by, as documented.
fn most_off<G: Dimension>([low, high]: [&G::Point; 2]) -> f64 {
    let size = (0..G::D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let reach = (0..G::D).map(|axis| high[axis].abs().max(low[axis].abs())).fold(0.0, f64::max);
    1e-8 * size + 3e-15 * reach
}

fn within<G: Dimension>(
    t: &MovingTriangulation<G>,
    clip: [&G::Point; 2],
    rows: &[f64],
) -> VoronoiCells<G::Point> {
    t.voronoi_cells_within(clip, rows, None, &mut |_| true).expect("room")
}

/// Compares all cells in a box and half-spaces with exact ones. Errors may be `share` of those documented.
fn check<G: Exact>(places: &[G::Point], clip: [&G::Point; 2], rows: &[f64], share: f64) {
    let t = MovingTriangulation::<G>::new(places, Options::default()).expect("good points");
    let cells = within(&t, clip, rows);
    let off = share * most_off::<G>(clip);
    let (mut sum, mut of_surfaces) = (0.0, 0.0);
    let mut exact: Vec<Option<ExactCell>> = places.iter().map(|_| None).collect();
    for of in 0..places.len() {
        if places[..of].contains(&places[of]) {
            assert!((cells.volumes[of], cells.areas[of]) == (0.0, 0.0));
            continue;
        }
        let is_near = |found: f64, wanted: f64, most: f64, what: &str| {
            let most = most + 4.0 * f64::EPSILON * wanted.abs() + 1e-300;
            assert!(
                (found - wanted).abs() <= most,
                "{what} {found}, not {wanted}: {of} of {places:?} in {clip:?} and {rows:?}"
            );
        };
        let mut cell = G::whole(places, of, clip);
        let most: f64 = cell.faces.iter().map(|face| cell.area(face)).sum();
        G::cut(&mut cell, places.len(), rows);
        let is_side = |face: &&ExactFace| G::D == 3 || face.is_upright();
        let surface: f64 = cell.faces.iter().map(|face| cell.area(face)).sum();
        let perimeters: f64 = cell.faces.iter().map(|face| cell.perimeter(face)).sum();
        let area: f64 = cell.faces.iter().filter(is_side).map(|face| cell.area(face)).sum();
        let volume = cell.volume(G::D as i32);
        // Something as thin as corners are off may be gone, or there may be as much where nothing should be.
        let is_thin = volume <= 2.0 * off * most;
        let surface = if is_thin { most } else { surface };
        is_near(cells.volumes[of], volume, off * surface, "volume");
        if is_thin {
            assert!(cells.areas[of] <= most * (1.0 + 1e-6));
        } else {
            is_near(cells.areas[of], area, off * perimeters, "area");
        }
        if let Some((centroid, diameter)) = cell.centroid_and_diameter().filter(|_| !is_thin) {
            let reach =
                (0..G::D).map(|axis| clip[1][axis].abs().max(clip[0][axis].abs())).fold(0.0, f64::max);
            for (axis, &wanted) in centroid.iter().enumerate().take(G::D) {
                let most = off * surface * diameter / volume + 1e-15 * reach;
                is_near(cells.centroids[of][axis], wanted, most, "centroid");
            }
        }
        let is_there = cells.volumes[of] > 0.0;
        let is_in_box = |axis: usize| {
            let at = cells.centroids[of][axis];
            if is_there { clip[0][axis] <= at && at <= clip[1][axis] } else { at.is_nan() }
        };
        assert!((0..G::D).all(is_in_box));
        sum += cells.volumes[of];
        of_surfaces += surface;
        exact[of] = Some(cell);
    }
    check_facets::<G>(&t, places, clip, rows, off, &exact);
    let region = region::<G>(clip, rows).volume(G::D as i32);
    assert!(
        (sum - region).abs() <= off * of_surfaces + 1e-14 * region,
        "{sum}, not {region}: {places:?} in {clip:?} and {rows:?}"
    );
}

/// By how much more than its corners a facet of two places may be off, as a plane is nearly parallel to it: one over the
/// sine of the angle; none if it may be in the plane.
fn stretch<G: Dimension>(p: &G::Point, q: &G::Point, rows: &[f64], near: f64) -> Option<f64> {
    let length = |x: &[f64]| {
        let most = x.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let scaled = |x: &f64| if most > 0.0 { x / most } else { 0.0 };
        most * x.iter().map(|x| scaled(x).powi(2)).sum::<f64>().sqrt()
    };
    let way: Vec<f64> = (0..G::D).map(|axis| q[axis] - p[axis]).collect();
    let mut stretch = 1.0f64;
    for row in rows.chunks(G::D + 1) {
        let unit = |x: &[f64]| -> Vec<f64> { x.iter().map(|y| y / length(x)).collect() };
        let (normal, along) = (unit(&row[..G::D]), unit(&way));
        let cosine: f64 = (0..G::D).map(|axis| normal[axis] * along[axis]).sum();
        // As differences of unit vectors, which are accurate.
        let across: Vec<f64> = (0..G::D).map(|axis| along[axis] - cosine.signum() * normal[axis]).collect();
        let sine = if cosine.abs() > 0.5 { length(&across) } else { 0.5 };
        let middle: f64 = (0..G::D).map(|axis| normal[axis] * (0.5 * (p[axis] + q[axis]))).sum();
        let distance = (middle - row[G::D] / length(&row[..G::D])).abs();
        if sine <= 1e-6 && distance < near {
            return None;
        }
        stretch = stretch.max(1.0 / sine.max(1e-6));
    }
    Some(stretch)
}

/// Compares facets, their centroids and derivatives with exact ones.
fn check_facets<G: Exact>(
    t: &MovingTriangulation<G>,
    places: &[G::Point],
    clip: [&G::Point; 2],
    rows: &[f64],
    off: f64,
    exact: &[Option<ExactCell>],
) {
    let facets = t.voronoi_derivatives_within(clip, rows, None, &mut |_| true).expect("room");
    let size = (0..G::D).map(|axis| clip[1][axis] - clip[0][axis]).fold(0.0, f64::max);
    let reach = (0..G::D).map(|axis| clip[1][axis].abs().max(clip[0][axis].abs())).fold(0.0, f64::max);
    let mut n_compared = 0;
    for (k, edge) in facets.edges.iter().enumerate() {
        let [of, other] = edge.map(|v| v.index());
        let [p, q] = [places[of], places[other]];
        let context = || format!("{of} {other} of {places:?} in {clip:?} and {rows:?}");
        // Faces of the box are planes, too.
        let mut planes = rows.to_vec();
        for axis in 0..G::D {
            for side in clip {
                planes.extend((0..G::D).map(|k| f64::from(k == axis)));
                planes.push(side[axis]);
            }
        }
        let Some(stretch) = stretch::<G>(&p, &q, &planes, 4.0 * most_off::<G>(clip) + 1e-5 * size) else {
            continue;
        };
        n_compared += 1;
        assert_eq!(facets.areas[k] == 0.0, facets.centroids[k][0].is_nan(), "{}", context());
        let cell = exact[of].as_ref().expect("a vertex that is not hidden");
        let Some(face) = cell.faces.iter().find(|face| face.other == Some(other)) else {
            // Something as thin as corners are off may be there.
            assert!(
                facets.areas[k] <= stretch * off * size.powi(G::D as i32 - 2) * 4.0 + 1e-300,
                "{}",
                context()
            );
            continue;
        };
        let (area, perimeter) = (cell.area(face), cell.perimeter(face));
        let most = stretch * off * perimeter + 4.0 * f64::EPSILON * area + 1e-300;
        let found = facets.areas[k];
        assert!((found - area).abs() <= most, "facet {found}, not {area}: {}", context());
        let (centroid, diameter) = cell.face_centroid_and_diameter(face);
        let length = (0..G::D).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>().sqrt();
        if area <= 8.0 * most || length == 0.0 {
            continue;
        }
        for axis in 0..G::D {
            let at = facets.centroids[k][axis];
            let near = most * diameter / area + 1e-15 * reach;
            assert!((at - centroid[axis]).abs() <= near, "{at}, not {centroid:?}: {}", context());
            for (derivative, by) in facets.derivatives[k].iter().zip([q, p]) {
                let from_centroid = (0..G::D).map(|k| (by[k] - centroid[k]).powi(2)).sum::<f64>().sqrt();
                let wanted = area * ((by[axis] - centroid[axis]) / length);
                let near = (most * (from_centroid + diameter) + area * 1e-15 * reach) / length;
                let error = (derivative[axis] - wanted).abs();
                assert!(error <= near + 1e-15 * wanted.abs(), "derivative {derivative:?}: {}", context());
            }
        }
    }
    assert!(n_compared > 0 || facets.edges.len() < 60);
}

fn cube<G: Dimension>(low: f64, high: f64) -> [G::Point; 2] {
    [point::<G>(|_| low), point::<G>(|_| high)]
}

/// A half-space with a random normal of some length, whose plane goes through a place.
fn through<G: Dimension>(p: &G::Point, rng: &mut Rng) -> Vec<f64> {
    let length = 10f64.powi(rng.below(7) as i32 - 3);
    let mut row: Vec<f64> = (0..G::D).map(|_| length * (rng.unit() - 0.5)).collect();
    row.push((0..G::D).map(|axis| row[axis] * p[axis]).sum());
    row
}

fn random<G: Exact>() {
    for seed in seeds(8) {
        let rng = &mut Rng::new(seed);
        for n_rows in [1, 2, 3, 5, 9] {
            let n = 1 + rng.below(12);
            let places: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
            let rows: Vec<f64> =
                (0..n_rows).flat_map(|_| through::<G>(&point::<G>(|_| rng.unit()), rng)).collect();
            let [low, high] = cube::<G>(-0.25, 1.125);
            check::<G>(&places, [&low, &high], &rows, 1e-4);
            let [low, high] = cube::<G>(0.25, 0.625);
            check::<G>(&places, [&low, &high], &rows, 1e-4);
        }
    }
}

#[test]
fn cells_in_random_half_spaces_are_exact_but_for_rounding() {
    random::<Plane>();
    random::<Space>();
}

/// Normals along axes, edges and diagonals.
fn steps<G: Dimension>() -> Vec<Vec<f64>> {
    let all = (0..3usize.pow(G::D as u32))
        .map(|k| (0..G::D).map(|axis| (k / 3usize.pow(axis as u32) % 3) as f64 - 1.0).collect::<Vec<f64>>());
    all.filter(|normal| normal.iter().any(|&x| x != 0.0)).collect()
}

/// Lattices with planes through lattice planes and through corners of cells, with what is nearly so, and pairs of planes
/// that are equal, opposite, or nearly parallel.
fn degenerate<G: Exact>() {
    let rng = &mut Rng::new(2);
    let n_side = if G::D == 2 { 4usize } else { 3 };
    let lattice: Vec<G::Point> = (0..n_side.pow(G::D as u32))
        .map(|k| point::<G>(|axis| (k / n_side.pow(axis as u32) % n_side) as f64))
        .collect();
    let steps = steps::<G>();
    let [low, high] = cube::<G>(-0.5, n_side as f64 - 0.25);
    for jitter in [0.0, 1e-15, 1e-12, 1e-9] {
        for _ in 0..if G::D == 2 { 8 } else { 2 } {
            let mut shaken = lattice.clone();
            for p in &mut shaken {
                (0..G::D).for_each(|axis| p[axis] += jitter * (rng.unit() - 0.5));
            }
            let normal = &steps[rng.below(steps.len())];
            let offset = rng.below(9) as f64 / 2.0 - 1.0;
            let row = [normal.clone(), vec![offset]].concat();
            let nearly: Vec<f64> = row.iter().map(|x| x + jitter * (rng.unit() - 0.5)).collect();
            let opposite: Vec<f64> = row.iter().map(|x| -x).collect();
            let nearly_opposite: Vec<f64> = nearly.iter().map(|x| -3.0 * x).collect();
            let other = [steps[rng.below(steps.len())].clone(), vec![rng.below(9) as f64 / 2.0]].concat();
            for rows in [
                row.clone(),
                [row.clone(), row.clone()].concat(),
                [row.clone(), nearly].concat(),
                [row.clone(), other.clone()].concat(),
                [row.clone(), opposite].concat(),
                [row, nearly_opposite, other].concat(),
            ] {
                let share = if jitter == 0.0 { 1e-4 } else { 1.0 };
                check::<G>(&shaken, [&low, &high], &rows, share);
            }
        }
    }
}

#[test]
fn planes_may_go_through_corners_and_along_faces() {
    degenerate::<Plane>();
    degenerate::<Space>();
}

/// Vertices on a circle or sphere, exactly and nearly so, with planes through its centre; and in one hyperplane.
fn special<G: Exact>() {
    let rng = &mut Rng::new(3);
    let [low, high] = cube::<G>(-1.5, 1.25);
    let steps = steps::<G>();
    for jitter in [0.0, 1e-16, 1e-13, 1e-9] {
        let mut sets: Vec<Vec<G::Point>> = Vec::new();
        sets.push((0..1 << G::D).map(|k| point::<G>(|axis| f64::from(k >> axis & 1) * 2.0 - 1.0)).collect());
        sets.push((0..9).map(|k| point::<G>(|axis| 0.25 * (k * (axis + 1)) as f64 - 1.0)).collect());
        sets.push(
            (0..7)
                .map(|_| {
                    let p = point::<G>(|_| rng.unit() - 0.5);
                    let length = (0..G::D).map(|axis| p[axis] * p[axis]).sum::<f64>().sqrt();
                    point::<G>(|axis| p[axis] / length)
                })
                .collect(),
        );
        sets.push(vec![point::<G>(|_| 0.5)]);
        sets.push((0..5).map(|k| point::<G>(|axis| if axis == 0 { k as f64 } else { 0.125 })).collect());
        if G::D == 3 {
            sets.push((0..8).map(|k| point::<G>(|axis| [k * k % 5, k % 3, 0][axis] as f64 / 3.0)).collect());
        }
        for mut set in sets {
            let is_flat = set.len() < 6;
            for p in set.iter_mut().filter(|_| !is_flat) {
                (0..G::D).for_each(|axis| p[axis] += jitter * (rng.unit() - 0.5));
            }
            for normal in steps.iter().step_by(if G::D == 2 { 1 } else { 5 }) {
                let through_middle = [normal.clone(), vec![0.0]].concat();
                let elsewhere = through::<G>(&point::<G>(|_| rng.unit() - 0.5), rng);
                let both = [through_middle.clone(), elsewhere].concat();
                check::<G>(&set, [&low, &high], &through_middle, 1.0);
                check::<G>(&set, [&low, &high], &both, 1.0);
            }
        }
    }
}

#[test]
fn special_sets_have_cells_in_half_spaces() {
    special::<Plane>();
    special::<Space>();
}

/// Vertices near each other and far away, and planes that are nearly one.
fn hard<G: Exact>() {
    for seed in seeds(2) {
        let rng = &mut Rng::new(seed + 9);
        for separation in [1e-2, 1e-6, 1e-9, 1e-12] {
            let mut places: Vec<G::Point> = (0..4).map(|_| point::<G>(|_| rng.unit())).collect();
            let near = places[0];
            places.extend((0..4).map(|_| point::<G>(|axis| near[axis] + separation * rng.unit())));
            places.push(point::<G>(|axis| if axis == 0 { 1e12 } else { 0.5 }));
            places.push(point::<G>(|axis| if axis == 0 { 0.25 } else { -1e5 }));
            let row = through::<G>(&near, rng);
            let nearly: Vec<f64> = row.iter().map(|x| x * (1.0 + separation * rng.unit())).collect();
            let [low, high] = cube::<G>(-0.125, 1.5);
            check::<G>(&places, [&low, &high], &row, 1.0);
            check::<G>(&places, [&low, &high], &[row, nearly].concat(), 1.0);
        }
    }
    // A box that is far from the origin, and sizes of all kinds.
    for (at, size) in [(1e6, 1.0), (-3.0, 1e-6), (0.0, 1e-150), (0.0, 1e40)] {
        let rng = &mut Rng::new(5);
        let places: Vec<G::Point> = (0..7).map(|_| point::<G>(|_| at + size * rng.unit())).collect();
        let [low, high] = cube::<G>(at, at + size);
        let rows = through::<G>(&point::<G>(|_| at + 0.5 * size), rng);
        check::<G>(&places, [&low, &high], &rows, 1.0);
    }
}

#[test]
fn hard_sets_have_cells_in_half_spaces() {
    hard::<Plane>();
    hard::<Space>();
}

/// Half-spaces that are the faces of another box give what that box gives, and those that contain everything, what there is
/// without them.
fn boxes<G: Dimension>(n: usize) {
    let rng = &mut Rng::new(6);
    let places: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good points");
    let (low, high) = (point::<G>(|axis| 0.125 * axis as f64 - 0.0625), point::<G>(|_| 0.875));
    let [wide_low, wide_high] = cube::<G>(-0.5, 1.75);
    let faces = |low: &G::Point, high: &G::Point| -> Vec<f64> {
        let along = |axis: usize, x: f64| (0..G::D).map(move |k| if k == axis { x } else { 0.0 });
        (0..G::D)
            .flat_map(|axis| {
                along(axis, 2.0).chain([2.0 * high[axis]]).chain(along(axis, -0.5)).chain([-0.5 * low[axis]])
            })
            .collect()
    };
    let agree = |found: VoronoiCells<G::Point>, wanted: VoronoiCells<G::Point>| {
        for v in 0..n {
            assert!((found.volumes[v] - wanted.volumes[v]).abs() < 1e-13);
            assert!((found.areas[v] - wanted.areas[v]).abs() < 1e-12);
            let is_near = |axis: usize| {
                let (a, b) = (found.centroids[v][axis], wanted.centroids[v][axis]);
                (a - b).abs() < 1e-11 || wanted.volumes[v] < 1e-9
            };
            assert!((0..G::D).all(is_near));
        }
    };
    let clip = [&wide_low, &wide_high];
    let of_box = t.voronoi_cells([&low, &high], None, &mut |_| true).expect("room");
    assert!(of_box.volumes.contains(&0.0));
    agree(within(&t, clip, &faces(&low, &high)), of_box);
    let of_wide = t.voronoi_cells(clip, None, &mut |_| true).expect("room");
    agree(within(&t, clip, &faces(&point::<G>(|_| -1.0), &point::<G>(|_| 2.0))), of_wide.clone());
    assert!(within(&t, clip, &[]).volumes == of_wide.volumes);
}

#[test]
fn half_spaces_may_be_those_of_a_box() {
    boxes::<Plane>(3_000);
    boxes::<Space>(2_000);
}

/// A regular polygon of many sides, upright in space.
fn cylinder(n: usize, d: usize) -> Vec<f64> {
    let row = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let upright = if d == 3 { Some(0.0) } else { None };
        let offset = 0.4 + 0.5 * (angle.cos() + angle.sin());
        [angle.cos(), angle.sin()].into_iter().chain(upright).chain([offset])
    };
    (0..n).flat_map(row).collect()
}

fn many<G: Exact>(n: usize) {
    let rng = &mut Rng::new(7);
    let places: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good points");
    let rows = cylinder(300, G::D);
    let [low, high] = cube::<G>(0.0, 1.0);
    let cells = within(&t, [&low, &high], &rows);
    let region = region::<G>([&low, &high], &rows);
    let sum: f64 = cells.volumes.iter().sum();
    assert!((sum - region.volume(G::D as i32)).abs() < 1e-12, "{sum}");
    let (centroid, _) = region.centroid_and_diameter().expect("a region");
    for (axis, wanted) in centroid.iter().enumerate().take(G::D) {
        let moment: f64 = (0..n)
            .filter(|&v| cells.volumes[v] > 0.0)
            .map(|v| cells.volumes[v] * cells.centroids[v][axis])
            .sum();
        assert!((moment / sum - wanted).abs() < 1e-12);
    }
    // Each facet between two cells counts twice, and what is left is the boundary of the region.
    let is_side = |face: &&ExactFace| G::D == 3 || face.is_upright();
    let area: f64 = region.faces.iter().filter(is_side).map(|face| region.area(face)).sum();
    assert!(cells.areas.iter().sum::<f64>() > area);
    check::<G>(&places[..6], [&low, &high], &cylinder(40, G::D), 1e-4);
}

#[test]
fn many_half_spaces_make_a_cylinder() {
    many::<Plane>(2_000);
    many::<Space>(2_000);
}

/// All numbers of a vertex.
fn bits<G: Dimension>(cells: &VoronoiCells<G::Point>, v: usize) -> Vec<u64> {
    let mut numbers = vec![cells.volumes[v].to_bits(), cells.areas[v].to_bits()];
    numbers.extend((0..G::D).map(|axis| cells.centroids[v][axis].to_bits()));
    numbers
}

fn threads_and_masks_agree<G: Dimension>(n: usize) {
    let rng = &mut Rng::new(11);
    let points: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let [low, high] = cube::<G>(0.01, 1.01);
    let rows: Vec<f64> = [cylinder(70, G::D), through::<G>(&point::<G>(|_| 0.5), rng)].concat();
    let built = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
    let bytes = built.saved().expect("room");
    let made: Vec<Vec<_>> = [1, 2, 3, 7]
        .map(|threads| {
            let options = Options { threads, ..Options::default() };
            let saved = Saved::of(&bytes).expect("its own bytes");
            let t = MovingTriangulation::<G>::load(&saved, options).expect("its own bytes");
            let cells = within(&t, [&low, &high], &rows);
            let facets = t.voronoi_derivatives_within([&low, &high], &rows, None, &mut |_| true);
            let facets = facets.expect("room");
            for share in [2, 30, n] {
                let mask: Vec<u8> = (0..n).map(|k| u8::from(k % share == 0)).collect();
                let some = t.voronoi_cells_within([&low, &high], &rows, Some(&mask), &mut |_| true);
                let some = some.expect("room");
                let some_facets = t
                    .voronoi_derivatives_within([&low, &high], &rows, Some(&mask), &mut |_| true)
                    .expect("room");
                for (k, edge) in facets.edges.iter().enumerate() {
                    let is_wanted = edge.iter().any(|v| mask[v.index()] != 0);
                    let [area, other] = [facets.areas[k], some_facets.areas[k]].map(f64::to_bits);
                    assert!(area == other || !is_wanted, "{edge:?}");
                }
                for (v, &is_wanted) in mask.iter().enumerate() {
                    let is_right = bits::<G>(&cells, v) == bits::<G>(&some, v);
                    assert!(if is_wanted != 0 { is_right } else { some.volumes[v].is_nan() }, "{v}");
                }
            }
            let mut all: Vec<Vec<u64>> = (0..n).map(|v| bits::<G>(&cells, v)).collect();
            let row = |k: usize| {
                let points = facets.derivatives[k].iter().chain([&facets.centroids[k]]);
                points.flat_map(|p| (0..G::D).map(|axis| p[axis].to_bits())).collect()
            };
            all.extend((0..facets.edges.len()).map(row));
            all
        })
        .into();
    assert!(made.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn neither_threads_nor_masks_change_a_bit() {
    deldrift::internals::use_all_threads();
    threads_and_masks_agree::<Plane>(9_000);
    threads_and_masks_agree::<Space>(3_000);
}

/// Cells that are kept by masks of what has changed are those of a full pass.
#[test]
fn cells_in_half_spaces_can_be_kept() {
    let rng = &mut Rng::new(12);
    let points: Vec<[f64; 3]> = (0..500).map(|_| point::<Space>(|_| rng.unit())).collect();
    let mut t = MovingTriangulation::<Space>::new(&points, Options::default()).expect("good points");
    let rows = cylinder(17, 3);
    let [low, high] = cube::<Space>(-0.1, 0.9);
    t.take_changes().expect("room");
    t.take_changes().expect("room");
    let mut kept = within(&t, [&low, &high], &rows);
    for _ in 0..10 {
        let v = deldrift::VertexId::at(rng.below(500));
        t.move_vertices(&[v], &[point::<Space>(|_| rng.unit())]).expect("a good place");
        t.commit_timestamp().expect("room");
        t.take_changes().expect("room");
        let mask = t.voronoi_changed(&[v]).expect("room");
        assert!(mask.iter().filter(|&&m| m != 0).count() < 250);
        let part = t.voronoi_cells_within([&low, &high], &rows, Some(&mask), &mut |_| true).expect("room");
        let all = within(&t, [&low, &high], &rows);
        for (v, &is_marked) in mask.iter().enumerate() {
            if is_marked != 0 {
                kept.volumes[v] = part.volumes[v];
                kept.areas[v] = part.areas[v];
                kept.centroids[v] = part.centroids[v];
            }
            assert_eq!(bits::<Space>(&kept, v), bits::<Space>(&all, v));
        }
    }
}

#[test]
fn bad_half_spaces_are_refused_by_name() {
    let t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0]], Options::default());
    let t = t.expect("good points");
    let message = |rows: &[f64]| {
        let clip: [&[f64; 2]; 2] = [&[0.0, 0.0], &[1.0, 1.0]];
        t.voronoi_cells_within(clip, rows, None, &mut |_| true).expect_err("bad rows").to_string()
    };
    assert_eq!(
        message(&[1.0, 0.0, 3.0, 0.0, -0.0, 1.0]),
        "half_spaces[1] is 0, but must be a normal that is not zero"
    );
    assert!(message(&[1.0, f64::NAN, 3.0]).contains("half_spaces[0], coordinate 1, is NaN"));
    assert!(message(&[1.0, 0.0, f64::INFINITY]).contains("half_spaces[0], coordinate 2, is inf"));
    let clip: [&[f64; 2]; 2] = [&[0.0, 0.0], &[1.0, 1.0]];
    let uneven = t.voronoi_cells_within(clip, &[1.0; 4], None, &mut |_| true);
    assert!(matches!(uneven, Err(Error::WrongCount { argument: "half_spaces", given: 4, wanted: 6, .. })));
    // Normals of all lengths, and planes beyond the range of numbers.
    for scale in [1e-320, 1e-200, 1e200, 1e307] {
        let cells =
            t.voronoi_cells_within(clip, &[scale, scale, scale], None, &mut |_| true).expect("good rows");
        assert!((cells.volumes[0] - 0.375).abs() < 1e-2 && (cells.volumes[1] - 0.125).abs() < 1e-2);
    }
    for (offset, volume) in [(1e300, 0.5), (-1e300, 0.0)] {
        let cells =
            t.voronoi_cells_within(clip, &[1e-300, 0.0, offset], None, &mut |_| true).expect("good rows");
        assert_eq!(cells.volumes, [volume; 2]);
    }
}
