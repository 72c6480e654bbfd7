//! Power cells and facets, with derivatives by positions and by weights: against exact rationals, against differences,
//! against cells without weights, and after histories.

use super::exact_cells::{ExactCell, ExactFace, exact_power_cell};
use crate::common::{Rng, seeds};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{MovingTriangulation, Options, VoronoiCells, VoronoiFacets};
use deldrift::{Moving, Plane, Space, VertexId};

/// Points with weights as the oracle takes them.
pub trait Weighted: Moving {
    /// The same without weights.
    type Plain: Moving;
    fn cell(points: &[Self::Point], of: usize, clip: [&Self::Point; 2]) -> ExactCell;
}

fn exact<const D: usize, P: AsRef<[f64]>>(
    points: &[P],
    weights: &[f64],
    of: usize,
    clip: [&P; 2],
) -> ExactCell {
    let place = |p: &P| -> [f64; D] { p.as_ref().try_into().expect("as many coordinates") };
    let places: Vec<[f64; D]> = points.iter().map(place).collect();
    let [low, high] = clip.map(place);
    exact_power_cell(&places, weights, of, [&low, &high])
}

impl Weighted for PowerPlane {
    type Plain = Plane;
    fn cell(points: &[Self::Point], of: usize, clip: [&Self::Point; 2]) -> ExactCell {
        let weights: Vec<f64> = points.iter().map(|p| p[2]).collect();
        exact::<2, _>(points, &weights, of, clip)
    }
}

impl Weighted for PowerSpace {
    type Plain = Space;
    fn cell(points: &[Self::Point], of: usize, clip: [&Self::Point; 2]) -> ExactCell {
        let weights: Vec<f64> = points.iter().map(|p| p[3]).collect();
        exact::<3, _>(points, &weights, of, clip)
    }
}

pub fn weighted<G: Moving>(weight: f64, coordinate: impl FnMut(usize) -> f64) -> G::Point {
    let mut p = crate::common::point::<G>(coordinate);
    p[G::D] = weight;
    p
}

pub fn cube<G: Moving>(low: f64, high: f64) -> [G::Point; 2] {
    [low, high].map(|x| weighted::<G>(0.0, |_| x))
}

pub fn build<G: Moving>(points: &[G::Point]) -> MovingTriangulation<G> {
    MovingTriangulation::new(points, Options::default()).expect("good points")
}

fn distance<G: Moving>(p: &G::Point, q: &[f64]) -> f64 {
    let most = (0..G::D).map(|axis| (p[axis] - q[axis]).abs()).fold(f64::MIN_POSITIVE, f64::max);
    most * (0..G::D).map(|axis| ((p[axis] - q[axis]) / most).powi(2)).sum::<f64>().sqrt()
}

/// What a corner may be off by, as documented.
fn most_off<G: Moving>([low, high]: [&G::Point; 2]) -> f64 {
    let size = (0..G::D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let reach = (0..G::D).map(|axis| high[axis].abs().max(low[axis].abs())).fold(0.0, f64::max);
    1e-8 * size + 1e-15 * reach
}

/// Cells, and facets if there are cells of the triangulation.
pub type Numbers<P> = (VoronoiCells<P>, VoronoiFacets<P>);

pub fn numbers<G: Moving>(t: &MovingTriangulation<G>, clip: [&G::Point; 2]) -> Numbers<G::Point> {
    let cells = t.voronoi_cells(clip, None, &mut |_| true).expect("room");
    (cells, t.voronoi_derivatives(clip, None, &mut |_| true).expect("room"))
}

/// Compares all cells and facets in a box with exact ones. Errors may be `share` of those documented. Where several
/// vertices tie no facets are compared: an exact face is that of several.
fn check<G: Weighted>(points: &[G::Point], clip: [&G::Point; 2], share: f64, has_ties: bool) {
    let t = build::<G>(points);
    check_of::<G>(&t, points, clip, share, has_ties);
}

pub fn check_of<G: Weighted>(
    t: &MovingTriangulation<G>,
    points: &[G::Point],
    clip: [&G::Point; 2],
    share: f64,
    has_ties: bool,
) {
    let context = |of: usize| format!("{of} of {points:?} in {clip:?}");
    let (cells, facets) = numbers(t, clip);
    assert_eq!(facets.edges, t.edges().expect("room"));
    let hidden = t.vertices_hidden_by_weight().expect("room");
    let reach = (0..G::D).map(|axis| clip[1][axis].abs().max(clip[0][axis].abs())).fold(0.0, f64::max);
    let (off, last_bits) = (share * most_off::<G>(clip), 1e-15 * reach);
    let is_near = |found: f64, wanted: f64, most: f64, what: &str, of: usize| {
        let most = most + 4.0 * f64::EPSILON * wanted.abs() + 1e-300;
        let is_near = found == wanted || (found - wanted).abs() <= most;
        assert!(is_near, "{what}: {found}, not {wanted} but for {most}: {}", context(of));
    };
    let mut sum = 0.0;
    for (of, point) in points.iter().enumerate() {
        let cell = G::cell(points, of, clip);
        sum += cells.volumes[of];
        if hidden.contains(&VertexId::at(of)) {
            assert!((cells.volumes[of], cells.areas[of]) == (0.0, 0.0), "{}", context(of));
            assert!(cells.centroids[of].as_ref().iter().all(|x| x.is_nan()), "{}", context(of));
            assert_eq!(cell.volume(G::D as i32), 0.0, "{}", context(of));
            continue;
        }
        let is_side = |face: &&ExactFace| G::D == 3 || face.is_upright();
        let surface: f64 = cell.faces.iter().map(|face| cell.area(face)).sum();
        let perimeters: f64 = cell.faces.iter().map(|face| cell.perimeter(face)).sum();
        let area: f64 = cell.faces.iter().filter(is_side).map(|face| cell.area(face)).sum();
        let volume = cell.volume(G::D as i32);
        let Some((centroid, diameter)) = cell.centroid_and_diameter() else {
            assert!(cells.volumes[of] <= off * off, "{}", context(of));
            continue;
        };
        // From the vertex to a corner of its cell.
        let far = distance::<G>(point, &centroid[..G::D]) + diameter;
        let of_volume =
            off * if G::D == 2 { surface.max(4.0 * far) } else { surface.max(far * perimeters / 6.0) };
        is_near(cells.volumes[of], volume, of_volume, "volume", of);
        if volume > 0.0 {
            is_near(cells.areas[of], area, off * perimeters, "area", of);
        }
        if volume > 0.0 && cells.volumes[of] > 0.0 {
            let most = of_volume * far / volume + last_bits;
            for (axis, &wanted) in centroid.iter().enumerate().take(G::D) {
                is_near(cells.centroids[of][axis], wanted, most, "centroid", of);
            }
        }
        if has_ties {
            continue;
        }
        for (k, edge) in facets.edges.iter().enumerate().filter(|(_, edge)| edge[0].index() == of) {
            let other = edge[1].index();
            let face = cell.faces.iter().find(|face| face.other == Some(other));
            let Some(face) = face else {
                assert!(facets.areas[k] <= 1e-300, "{}: {}", context(of), facets.areas[k]);
                assert!(facets.weight_derivatives[k].abs() <= 1e-300);
                continue;
            };
            let (area, perimeter) = (cell.area(face), cell.perimeter(face));
            let (centroid, diameter) = cell.face_centroid_and_diameter(face);
            is_near(facets.areas[k], area, off * perimeter, "facet", of);
            let length = distance::<G>(&points[of], points[other].as_ref());
            is_near(
                facets.weight_derivatives[k],
                -area / (2.0 * length),
                off * perimeter / (2.0 * length),
                "by a weight",
                of,
            );
            for axis in 0..G::D {
                if facets.areas[k] > 0.0 {
                    let is_narrow = area <= 4.0 * most_off::<G>(clip) * perimeter;
                    let most = if is_narrow { diameter + off } else { off * perimeter * diameter / area };
                    is_near(
                        facets.centroids[k][axis],
                        centroid[axis],
                        most + last_bits,
                        "facet's centroid",
                        of,
                    );
                }
                for (derivative, by) in facets.derivatives[k].iter().zip([other, of]) {
                    let way = points[by][axis] - centroid[axis];
                    let from_centroid = distance::<G>(&points[by], &centroid[..G::D]);
                    let most = (off * perimeter * (from_centroid + diameter) + area * last_bits) / length;
                    is_near(derivative[axis], area * (way / length), most, "derivative", of);
                }
            }
        }
    }
    let size: f64 = (0..G::D).map(|axis| clip[1][axis] - clip[0][axis]).product();
    assert!(size == 0.0 || (sum / size - 1.0).abs() < 1e-7, "{sum} of {size}: {}", context(0));
}

/// Random vertices, with weights that hide none, some or most, in boxes that have all, some or none of them.
fn random<G: Weighted>(n_seeds: u64) {
    let (mut n_hidden, mut n_outside) = (0, 0);
    for seed in seeds(n_seeds) {
        let rng = &mut Rng::new(seed);
        for a in [0.01, 3.0, 60.0, 600.0, -200.0] {
            let n = G::D + 2 + rng.below(11);
            let points: Vec<G::Point> = (0..n)
                .map(|_| {
                    let weight = a * rng.unit();
                    weighted::<G>(weight, |_| 10.0 * rng.unit())
                })
                .collect();
            let t = build::<G>(&points);
            n_hidden += t.vertices_hidden_by_weight().expect("room").len();
            for (low, high) in [(0.0, 10.0), (2.5, 6.0), (-300.0, 400.0), (9.0, 12.0)] {
                let [low, high] = cube::<G>(low, high);
                check_of::<G>(&t, &points, [&low, &high], 0.1, false);
            }
            // A vertex is out of its own cell if another one has less power at its place.
            n_outside += (0..n)
                .filter(|&k| {
                    let nearest = t.nearest_vertex(&points[k]).expect("room").expect("some");
                    nearest.index() != k
                })
                .count();
        }
    }
    let n_outside = n_outside - n_hidden;
    assert!(n_hidden > 10 && n_outside > 20, "{n_hidden} {n_outside}");
}

#[test]
fn cells_in_the_plane_are_exact_but_for_rounding() {
    random::<PowerPlane>(12);
}

#[test]
fn cells_in_space_are_exact_but_for_rounding() {
    random::<PowerSpace>(6);
}

/// Lattices with weights of few values: corners in faces of the box, lifted places on the hull, several vertices at one
/// place.
fn ties<G: Weighted>() {
    let rng = &mut Rng::new(3);
    for most in [0, 1, 2, 5] {
        for _ in 0..6 {
            let points: Vec<G::Point> = (0..12)
                .map(|_| {
                    let weight = rng.within(0, most) as f64;
                    weighted::<G>(weight, |_| rng.within(0, 3) as f64)
                })
                .collect();
            for (low, high) in [(0.0, 3.0), (-1.0, 1.0), (0.5, 1.5), (1.0, 2.0)] {
                let [low, high] = cube::<G>(low, high);
                check::<G>(&points, [&low, &high], 1e-4, true);
            }
        }
    }
}

#[test]
fn cells_with_ties_are_exact_but_for_rounding() {
    ties::<PowerPlane>();
    ties::<PowerSpace>();
}

/// Without a box a cell is the one in a box that has it inside, or it has no end.
fn whole<G: Weighted>() {
    let (mut n_whole, mut n_hidden) = (0, 0);
    for seed in seeds(4) {
        let rng = &mut Rng::new(seed);
        for a in [0.1, 2.0, 8.0] {
            let points: Vec<G::Point> = (0..26)
                .map(|_| {
                    let weight = a * rng.unit();
                    weighted::<G>(weight, |_| 4.0 * rng.unit())
                })
                .collect();
            let t = build::<G>(&points);
            let hidden = t.vertices_hidden_by_weight().expect("room");
            n_hidden += hidden.len();
            let (mut cells, mut facets) = (Vec::new(), Vec::new());
            let tell = &mut |_, cell| cells.push(cell);
            let tell_facet = &mut |k, facet| facets.push((k, facet));
            t.for_voronoi(None, &[], None, &mut |_| true, Some(tell), Some(tell_facet)).expect("room");
            facets.sort_by_key(|(k, _)| *k);
            let [low, high] = cube::<G>(-1e4, 1e4);
            let boxed = t.voronoi_derivatives([&low, &high], None, &mut |_| true).expect("room");
            for ((_, facet), k) in facets.iter().zip(0..) {
                let is_near = |x: f64, y: f64| x == f64::INFINITY || (x - y).abs() < 1e-6 * (1.0 + y.abs());
                if facet.area < f64::INFINITY && facet.area > 100.0 {
                    // Of corners that are far away.
                    continue;
                }
                assert!(is_near(facet.area, boxed.areas[k]));
                if facet.area == f64::INFINITY {
                    assert!(facet.weight_derivative.is_nan());
                    continue;
                }
                assert!(is_near(facet.weight_derivative, boxed.weight_derivatives[k]));
                for axis in 0..G::D {
                    assert!(is_near(facet.derivatives[0][axis], boxed.derivatives[k][0][axis]));
                    assert!(is_near(facet.derivatives[1][axis], boxed.derivatives[k][1][axis]));
                }
            }
            for (of, found) in cells.iter().enumerate() {
                let cell = G::cell(&points, of, [&low, &high]);
                if hidden.contains(&VertexId::at(of)) {
                    assert!(found.volume == 0.0 && found.area == 0.0 && found.centroid[0].is_nan());
                } else if cell
                    .faces
                    .iter()
                    .any(|face| face.other.is_none() && (G::D == 3 || face.is_upright()))
                {
                    // It has no end, or one that is beyond the box.
                    assert!(found.volume > 100.0 && found.area > 100.0, "{found:?}");
                } else {
                    n_whole += 1;
                    let wanted = cell.volume(G::D as i32);
                    assert!((found.volume - wanted).abs() < 1e-6 * (1.0 + wanted), "{found:?}, not {wanted}");
                    let Some((centroid, diameter)) = cell.centroid_and_diameter() else { continue };
                    if wanted > 1e-3 && diameter < 100.0 {
                        assert!(
                            distance::<G>(&found.centroid, &centroid[..G::D]) < 1e-4,
                            "{found:?}, {centroid:?}"
                        );
                    }
                }
            }
        }
    }
    assert!(n_whole > 60 && n_hidden > 10, "{n_whole} {n_hidden}");
}

#[test]
fn whole_cells_are_those_in_large_boxes() {
    whole::<PowerPlane>();
    whole::<PowerSpace>();
}

/// Half-spaces besides a box.
fn within<G: Weighted>() {
    let rng = &mut Rng::new(7);
    for a in [1.0, 60.0, 400.0] {
        let points: Vec<G::Point> = (0..14)
            .map(|_| {
                let weight = a * rng.unit();
                weighted::<G>(weight, |_| 10.0 * rng.unit())
            })
            .collect();
        let t = build::<G>(&points);
        let mut rows = Vec::new();
        for _ in 0..5 {
            let normal: Vec<f64> = (0..G::D).map(|_| rng.unit() - 0.5).collect();
            let offset = normal.iter().map(|x| x * 5.0).sum::<f64>() + 0.8 * rng.unit();
            rows.extend(normal.into_iter().chain([offset]));
        }
        let [low, high] = cube::<G>(0.0, 10.0);
        let cells = t.voronoi_cells_within([&low, &high], &rows, None, &mut |_| true).expect("room");
        let facets = t.voronoi_derivatives_within([&low, &high], &rows, None, &mut |_| true).expect("room");
        for of in 0..points.len() {
            let mut cell = G::cell(&points, of, [&low, &high]);
            for (k, row) in rows.chunks(G::D + 1).enumerate() {
                if G::D == 2 {
                    cell.cut_by::<2>(row, 1000 + k);
                } else {
                    cell.cut_by::<3>(row, 1000 + k);
                }
            }
            let wanted = cell.volume(G::D as i32);
            assert!((cells.volumes[of] - wanted).abs() < 1e-6, "{}, not {wanted}", cells.volumes[of]);
            for (k, edge) in facets.edges.iter().enumerate().filter(|(_, edge)| edge[0].index() == of) {
                let face = cell.faces.iter().find(|face| face.other == Some(edge[1].index()));
                let wanted = face.map_or(0.0, |face| cell.area(face));
                let length = distance::<G>(&points[of], points[edge[1].index()].as_ref());
                assert!((facets.areas[k] - wanted).abs() < 1e-6);
                assert!((facets.weight_derivatives[k] + facets.areas[k] / (2.0 * length)).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn half_spaces_cut_power_cells() {
    within::<PowerPlane>();
    within::<PowerSpace>();
}

/// Bits, in which NaN is itself, of what is known without weights.
fn bits<P: AsRef<[f64]>>((cells, facets): &Numbers<P>) -> Vec<u64> {
    let numbers = cells.volumes.iter().chain(&cells.areas).chain(&facets.areas);
    let places = cells.centroids.iter().chain(&facets.centroids).chain(facets.derivatives.iter().flatten());
    numbers.chain(places.flat_map(AsRef::as_ref)).map(|x| x.to_bits()).collect()
}

/// Equal weights are as good as none.
fn equal<G: Weighted>() {
    let rng = &mut Rng::new(11);
    for case in 0..40 {
        let n = 1 + rng.below(120);
        let on_lattice = case % 2 == 0;
        let weight = [0.0, 1.0, -3.5, 1e9][case % 4];
        let mut coordinate = || if on_lattice { rng.within(0, 3) as f64 } else { rng.unit() };
        let points: Vec<G::Point> = (0..n).map(|_| weighted::<G>(weight, |_| coordinate())).collect();
        let plain = |p: &G::Point| crate::common::point::<G::Plain>(|k| p[k]);
        let places: Vec<_> = points.iter().map(plain).collect();
        let (t, other) = (build::<G>(&points), build::<G::Plain>(&places));
        if t.cells().expect("room").corners.len() != other.cell_count() {
            panic!("other cells");
        }
        for (low, high) in [(0.0, 3.0), (-1.0, 0.5), (0.25, 0.75)] {
            let [low, high] = cube::<G>(low, high);
            let [from, to] = [&low, &high].map(plain);
            let found = numbers(&t, [&low, &high]);
            let wanted = numbers(&other, [&from, &to]);
            let is_same_order = format!("{:?}", t.cells().expect("room").corners)
                == format!("{:?}", other.cells().expect("room").corners);
            if is_same_order {
                assert_eq!(bits(&found), bits(&wanted), "{points:?}");
            }
            let pairs = found.0.volumes.iter().zip(&wanted.0.volumes);
            assert!(pairs.clone().all(|(x, y)| (x - y).abs() < 1e-9), "{points:?}");
        }
    }
}

#[test]
fn equal_weights_are_as_good_as_none() {
    equal::<PowerPlane>();
    equal::<PowerSpace>();
}

/// Derivatives against differences of volumes, and their sums.
fn differences<G: Weighted>() {
    let rng = &mut Rng::new(13);
    let [low, high] = cube::<G>(0.0, 10.0);
    for a in [1.0, 20.0] {
        let points: Vec<G::Point> = (0..15)
            .map(|_| {
                let weight = a * rng.unit();
                weighted::<G>(weight, |_| 10.0 * rng.unit())
            })
            .collect();
        let (_, facets) = numbers(&build::<G>(&points), [&low, &high]);
        for by in 0..points.len() {
            for axis in 0..=G::D {
                let step = 1e-5;
                let [less, more] = [-step, step].map(|step| {
                    let mut points = points.clone();
                    points[by][axis] += step;
                    build::<G>(&points).voronoi_volumes(Some([&low, &high])).expect("room")
                });
                let mut own = 0.0;
                for (k, edge) in facets.edges.iter().enumerate() {
                    let Some(at) = edge.iter().position(|v| v.index() == by) else { continue };
                    let of = edge[1 - at].index();
                    let found = if axis == G::D {
                        facets.weight_derivatives[k]
                    } else {
                        facets.derivatives[k][1 - at][axis]
                    };
                    own -= found;
                    let wanted = (more[of] - less[of]) / (2.0 * step);
                    assert!((found - wanted).abs() < 1e-3 * (1.0 + wanted.abs()), "{found}, not {wanted}");
                }
                let wanted = (more[by] - less[by]) / (2.0 * step);
                assert!((own - wanted).abs() < 1e-3 * (1.0 + wanted.abs()), "{own}, not {wanted}");
            }
        }
    }
}

#[test]
fn derivatives_are_differences() {
    differences::<PowerPlane>();
    differences::<PowerSpace>();
}
