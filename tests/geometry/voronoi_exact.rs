//! Voronoi cells and facets against exact rationals: at separations from one last bit to the box, near ties, where
//! squares underflow, and of vertices in one hyperplane.

use super::exact_cells::exact_cell;
use crate::common::{Rng, point, seeds};
use deldrift::motion::{MovingTriangulation, Options, VoronoiCell};
use deldrift::{Dimension, Error, Plane, Space, VertexId};

/// Points of either dimension as the oracle takes them.
trait Exact: Dimension {
    fn cell(places: &[Self::Point], of: usize, clip: [&Self::Point; 2]) -> super::exact_cells::ExactCell;
}

impl Exact for Plane {
    fn cell(places: &[[f64; 2]], of: usize, clip: [&[f64; 2]; 2]) -> super::exact_cells::ExactCell {
        exact_cell(places, of, clip)
    }
}

impl Exact for Space {
    fn cell(places: &[[f64; 3]], of: usize, clip: [&[f64; 3]; 2]) -> super::exact_cells::ExactCell {
        exact_cell(places, of, clip)
    }
}

/// What a corner may be off by, as documented.
fn most_off<G: Dimension>([low, high]: [&G::Point; 2]) -> f64 {
    let size = (0..G::D).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let reach = (0..G::D).map(|axis| high[axis].abs().max(low[axis].abs())).fold(0.0, f64::max);
    1e-8 * size + 1e-15 * reach
}

/// Compares all cells and facets in a box with exact ones. Errors may be `share` of those documented.
fn check<G: Exact>(places: &[G::Point], clip: [&G::Point; 2], share: f64) {
    let context = || format!("{places:?} in {clip:?}");
    let t = MovingTriangulation::<G>::new(places, Options::default()).expect("good points");
    let (volumes, facets) = (t.voronoi_volumes(Some(clip)), t.voronoi_facets(Some(clip)));
    let (volumes, facets) = (volumes.expect("room"), facets.expect("room"));
    let edges = t.edges().expect("room");
    assert_eq!(edges.len(), facets.len());
    let off = share * most_off::<G>(clip);
    let has_cells = t.cell_count() > 0;
    let mut n_found = 0;
    for of in 0..places.len() {
        if places[..of].contains(&places[of]) {
            assert_eq!(volumes[of], 0.0, "hidden");
            continue;
        }
        let cell = G::cell(places, of, clip);
        let surface: f64 = cell.faces.iter().map(|face| cell.area(face)).sum();
        let (found, wanted) = (volumes[of], cell.volume(G::D as i32));
        assert!(
            (found - wanted).abs() <= off * surface + 1e-300,
            "{of}: {found}, not {wanted}: {}",
            context()
        );
        for other in (of + 1..places.len()).filter(|_| has_cells) {
            let face = cell.faces.iter().find(|face| face.other == Some(other));
            let wanted = face.map_or(0.0, |face| cell.area(face));
            let perimeter = face.map_or(0.0, |face| cell.perimeter(face));
            let at = edges.binary_search(&[of, other].map(VertexId::at));
            let found = at.map_or(0.0, |k| facets[k]);
            n_found += usize::from(at.is_ok());
            // A face of the box is in the box; of vertices that are its mirror images it may be the exact one's.
            if wanted == 0.0 && found > 0.0 && is_face::<G>(&places[of], &places[other], clip) {
                continue;
            }
            let most = off * perimeter + 1e-300;
            assert!((found - wanted).abs() <= most, "{of} {other}: {found}, not {wanted}: {}", context());
        }
    }
    assert!(n_found == facets.len());
    check_cells::<G>(&t, places, clip, share);
}

/// Compares volumes, boundaries, centroids, facets and derivatives with those of exact cells.
fn check_cells<G: Exact>(t: &MovingTriangulation<G>, places: &[G::Point], clip: [&G::Point; 2], share: f64) {
    let context = |of: usize| format!("{of} of {places:?} in {clip:?}");
    let cells = t.voronoi_cells(clip, None, &mut |_| true).expect("room");
    let facets = t.voronoi_derivatives(clip, None, &mut |_| true).expect("room");
    assert_eq!(facets.edges, t.edges().expect("room"));
    let reach = (0..G::D).map(|axis| clip[1][axis].abs().max(clip[0][axis].abs())).fold(0.0, f64::max);
    let (off, last_bits) = (share * most_off::<G>(clip), 1e-15 * reach);
    let is_near = |found: f64, wanted: f64, most: f64, what: &str, of: usize| {
        let most = most + 4.0 * f64::EPSILON * wanted.abs() + 1e-300;
        let is_near = found == wanted || (found - wanted).abs() <= most;
        assert!(is_near, "{what}: {found}, not {wanted}: {}", context(of));
    };
    for of in 0..places.len() {
        if places[..of].contains(&places[of]) {
            assert!((cells.volumes[of], cells.areas[of]) == (0.0, 0.0));
            continue;
        }
        let cell = G::cell(places, of, clip);
        // In the plane, but for what is above and below.
        let is_side = |face: &&super::exact_cells::ExactFace| G::D == 3 || face.is_upright();
        let surface: f64 = cell.faces.iter().map(|face| cell.area(face)).sum();
        let perimeters: f64 = cell.faces.iter().map(|face| cell.perimeter(face)).sum();
        let area: f64 = cell.faces.iter().filter(is_side).map(|face| cell.area(face)).sum();
        let volume = cell.volume(G::D as i32);
        is_near(cells.volumes[of], volume, off * surface, "volume", of);
        is_near(cells.areas[of], area, off * perimeters, "area", of);
        if let Some((centroid, diameter)) = cell.centroid_and_diameter()
            && cells.volumes[of] > 0.0
        {
            let most = off * surface * diameter / volume + last_bits;
            for (axis, &wanted) in centroid.iter().enumerate().take(G::D) {
                is_near(cells.centroids[of][axis], wanted, most, "centroid", of);
            }
        }
        for (k, edge) in facets.edges.iter().enumerate().filter(|(_, edge)| edge[0].index() == of) {
            let other = edge[1].index();
            let face = cell.faces.iter().find(|face| face.other == Some(other));
            let Some(face) = face else {
                let is_face = is_face::<G>(&places[of], &places[other], clip);
                assert!(is_face || facets.areas[k] <= 1e-300, "{}", context(of));
                continue;
            };
            let (area, perimeter) = (cell.area(face), cell.perimeter(face));
            let (centroid, diameter) = cell.face_centroid_and_diameter(face);
            is_near(facets.areas[k], area, off * perimeter, "facet", of);
            let length = distance::<G>(&places[of], &places[other]);
            for axis in 0..G::D {
                if facets.areas[k] > 0.0 {
                    // The centroid of a facet that is narrower than corners are off is near its corners.
                    let is_narrow = area <= 4.0 * most_off::<G>(clip) * perimeter;
                    let most = if is_narrow { diameter + off } else { off * perimeter * diameter / area };
                    let most = most + last_bits;
                    is_near(facets.centroids[k][axis], centroid[axis], most, "facet's centroid", of);
                }
                for (derivative, by) in facets.derivatives[k].iter().zip([other, of]) {
                    let way = places[by][axis] - centroid[axis];
                    let from_centroid =
                        (0..G::D).map(|k| (places[by][k] - centroid[k]).powi(2)).sum::<f64>().sqrt();
                    let most = (off * perimeter * (from_centroid + diameter) + area * last_bits) / length;
                    is_near(derivative[axis], area * (way / length), most, "derivative", of);
                }
            }
        }
    }
}

fn distance<G: Dimension>(p: &G::Point, q: &G::Point) -> f64 {
    let most = (0..G::D).map(|axis| (p[axis] - q[axis]).abs()).fold(0.0, f64::max);
    most * (0..G::D).map(|axis| ((p[axis] - q[axis]) / most).powi(2)).sum::<f64>().sqrt()
}

/// Whether two places are mirror images at a face of a box.
fn is_face<G: Dimension>(p: &G::Point, q: &G::Point, [low, high]: [&G::Point; 2]) -> bool {
    let differ: Vec<usize> = (0..G::D).filter(|&axis| p[axis] != q[axis]).collect();
    matches!(differ[..], [axis] if [low[axis], high[axis]].contains(&(0.5 * (p[axis] + q[axis]))))
}

fn cube<G: Dimension>(low: f64, high: f64) -> [G::Point; 2] {
    [point::<G>(|_| low), point::<G>(|_| high)]
}

fn up(x: f64, n: u64) -> f64 {
    f64::from_bits(x.to_bits() + n)
}

/// Vertices near each other, and others far from them.
fn near_pairs<G: Exact>() {
    for seed in seeds(2) {
        let rng = &mut Rng::new(seed);
        for separation in [1e-2, 1e-5, 1e-8, 1e-10, 1e-12, 1e-14, 0.0] {
            let mut places: Vec<G::Point> = (0..5).map(|_| point::<G>(|_| 10.0 * rng.unit())).collect();
            for k in 0..3 {
                let near = places[k % 2];
                let step = if separation > 0.0 { separation } else { f64::EPSILON * 4.0 };
                places.push(point::<G>(|axis| near[axis] + step * (rng.unit() * 2.0 - 1.0)));
            }
            let [low, high] = cube::<G>(0.0, 10.0);
            check::<G>(&places, [&low, &high], 0.1);
            let [low, high] = cube::<G>(2.5, 6.0);
            check::<G>(&places, [&low, &high], 0.1);
        }
        // Neighbouring numbers along one axis.
        for n in 1..4 {
            let mut places: Vec<G::Point> = (0..4).map(|_| point::<G>(|_| 10.0 * rng.unit())).collect();
            let near = places[0];
            places.push(point::<G>(|axis| up(near[axis], if axis == 0 { n } else { 0 })));
            places.push(point::<G>(|axis| up(near[axis], if axis == 1 { n } else { 0 })));
            let [low, high] = cube::<G>(0.0, 10.0);
            check::<G>(&places, [&low, &high], 0.1);
        }
    }
}

#[test]
fn cells_of_vertices_near_each_other_are_exact_but_for_rounding() {
    near_pairs::<Plane>();
    near_pairs::<Space>();
}

/// Spheres, exact and nearly so, and lattices, with corners and centres in faces of the box.
fn near_ties<G: Exact>() {
    let boxes = [(0.0, 1.0), (0.5, 1.5), (-0.25, 0.75), (0.25, 0.3), (-3.0, 8.0), (1.0, 2.0)];
    let rng = &mut Rng::new(3);
    for jitter in [0.0, 1e-16, 1e-13, 1e-9, 1e-5] {
        let mut lattice: Vec<G::Point> =
            (0..1 << G::D).map(|k| point::<G>(|axis| f64::from(k >> axis & 1))).collect();
        lattice.extend([point::<G>(|axis| if axis == 0 { 2.0 } else { 0.0 }), point::<G>(|_| -1.0)]);
        let sphere: Vec<G::Point> = (0..7)
            .map(|_| {
                let p = point::<G>(|_| rng.unit() - 0.5);
                let length = (0..G::D).map(|axis| p[axis] * p[axis]).sum::<f64>().sqrt();
                point::<G>(|axis| 0.5 + 0.5 * p[axis] / length)
            })
            .collect();
        for set in [lattice, sphere] {
            let shaken: Vec<G::Point> =
                set.iter().map(|p| point::<G>(|axis| p[axis] + jitter * (rng.unit() - 0.5))).collect();
            for (low, high) in boxes {
                let [low, high] = cube::<G>(low, high);
                check::<G>(&shaken, [&low, &high], 1.0);
            }
        }
    }
}

#[test]
fn cells_near_ties_are_exact_but_for_rounding() {
    near_ties::<Plane>();
    near_ties::<Space>();
}

/// Vertices far from the box, and a box that is far from the origin.
fn far_away<G: Exact>() {
    let rng = &mut Rng::new(4);
    for size in [1.0, 1e-3, 1e-9, 1e-20] {
        let mut places: Vec<G::Point> = (0..7).map(|_| point::<G>(|_| rng.unit())).collect();
        let middle = places[0];
        places.push(point::<G>(|_| 1e6));
        places.push(point::<G>(|axis| if axis == 0 { -1e30 } else { 0.0 }));
        places.push(point::<G>(|axis| if axis == 0 { 1e30 } else { 1.0 }));
        let at = |side: f64| point::<G>(|axis| 0.5 * (middle[axis] + places[1][axis]) + side * size);
        let clip = [at(-1.0), at(1.0)];
        if (0..G::D).all(|axis| clip[0][axis] < clip[1][axis]) {
            check::<G>(&places, [&clip[0], &clip[1]], 1.0);
        }
    }
    let places: Vec<G::Point> = (0..7).map(|_| point::<G>(|_| 1e9 + rng.unit())).collect();
    let [low, high] = cube::<G>(1e9, 1e9 + 1.0);
    check::<G>(&places, [&low, &high], 1.0);
}

#[test]
fn cells_of_far_vertices_are_exact_but_for_rounding() {
    far_away::<Plane>();
    far_away::<Space>();
}

/// Squares of such differences are zero.
#[test]
fn differences_may_be_as_small_as_numbers_are() {
    for tiny in [1e-150, 1e-162, 1e-200, 1e-320] {
        let places = [[0.0, 0.0], [tiny, 0.0], [0.0, tiny]];
        let t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("good points");
        assert_eq!(t.voronoi_volumes(None).expect("room"), [f64::INFINITY; 3]);
        check::<Plane>(&places, [&[-1.0, -1.0], &[2.0, 1.0]], 1e-4);
        let around = [[0.0, 0.0], [tiny, 0.0], [-tiny, tiny], [0.0, -tiny], [tiny, tiny], [3.0, 1.0]];
        check::<Plane>(&around, [&[-1.0, -1.0], &[2.0, 1.0]], 1e-4);
        let t = MovingTriangulation::<Plane>::new(&around, Options::default()).expect("good points");
        assert!(!t.voronoi_volumes(None).expect("room").iter().any(|x| x.is_nan()));
        assert!(!t.voronoi_facets(None).expect("room").iter().any(|x| x.is_nan()));
        let places =
            [[0.0, 0.0, 0.0], [tiny, 0.0, 0.0], [0.0, 0.7, -0.5], [0.4, -0.2, 0.6], [0.7, -0.5, -0.3]];
        check::<Space>(&places, [&[-2.0; 3], &[2.0; 3]], 1e-4);
        let t = MovingTriangulation::<Space>::new(&places, Options::default()).expect("good points");
        let volumes = t.voronoi_volumes(Some([&[-2.0; 3], &[2.0; 3]])).expect("room");
        assert!((volumes[1] - 0.474361799339301).abs() < 1e-12, "{volumes:?}");
    }
}

/// Half of the distance between two vertices is zero, and what they share has corners beyond the range of numbers.
#[test]
fn no_volume_is_a_product_of_zero_and_infinity() {
    let least = f64::from_bits(1);
    let places = [[0.0, 0.0], [least, 0.0], [-1e57, 1.0], [1e57, 1.0], [-1e57, -1.0], [1e57, -2.0]];
    let t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("good points");
    assert!(!t.voronoi_volumes(None).expect("room").iter().any(|x| x.is_nan()));
    assert!(!t.voronoi_facets(None).expect("room").iter().any(|x| x.is_nan()));
    let places = [[0.0; 3], [least, 0.0, 0.0], [0.0, least, 0.0], [0.0, 0.0, least], [1e57, 1e57, 1.0]];
    let t = MovingTriangulation::<Space>::new(&places, Options::default()).expect("good points");
    assert!(!t.voronoi_volumes(None).expect("room").iter().any(|x| x.is_nan()));
}

/// Vertices in one hyperplane have cells in a box, and the rest of them is infinite.
fn flat<G: Exact>() {
    let rng = &mut Rng::new(5);
    let directions = [point::<G>(|axis| f64::from(axis as u32 == 0)), point::<G>(|axis| 1.0 + axis as f64)];
    for direction in directions {
        for n in [1, 2, 3, 6] {
            let places: Vec<G::Point> = (0..n)
                .map(|k| point::<G>(|axis| 0.25 + direction[axis] * f64::from(k * k) * 0.0625))
                .collect();
            check_flat::<G>(&places);
        }
    }
    if G::D == 3 {
        let spans: [[[f64; 3]; 2]; 3] = [
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [[1.0, 0.5, 0.25], [-0.5, 1.0, 0.75]],
        ];
        for span in spans {
            for n in [3, 4, 9] {
                let mut places = Vec::new();
                for _ in 0..n {
                    let [a, b] = [0, 1].map(|_| rng.below(16) as f64 / 16.0);
                    places.push(point::<G>(|axis| a * span[0][axis] + b * span[1][axis]));
                }
                check_flat::<G>(&places);
            }
        }
    }
}

fn check_flat<G: Exact>(places: &[G::Point]) {
    let t = MovingTriangulation::<G>::new(places, Options::default()).expect("good points");
    assert_eq!(t.cell_count(), 0);
    for (low, high) in [(0.0, 1.0), (-1.0, 3.0), (0.25, 0.5), (2.0, 2.5)] {
        let [low, high] = cube::<G>(low, high);
        check::<G>(places, [&low, &high], 1e-4);
        assert!(t.voronoi_facets(Some([&low, &high])).expect("room").is_empty());
    }
    let is_first = |k: usize| !places[..k].contains(&places[k]);
    for (k, volume) in t.voronoi_volumes(None).expect("room").into_iter().enumerate() {
        assert_eq!(volume, if is_first(k) { f64::INFINITY } else { 0.0 });
    }
}

#[test]
fn vertices_in_a_hyperplane_have_cells_in_a_box() {
    flat::<Plane>();
    flat::<Space>();
    let none = MovingTriangulation::<Space>::new(&[], Options::default()).expect("nothing");
    assert!(none.voronoi_volumes(Some([&[0.0; 3], &[1.0; 3]])).expect("room").is_empty());
}

/// A cell in the box consists of the pyramids from its vertex to its facets.
fn facets_make_cells<G: Exact>() {
    let rng = &mut Rng::new(6);
    for separation in [1.0, 1e-4, 1e-8, 1e-11, 1e-14] {
        let mut places: Vec<G::Point> = (0..40).map(|_| point::<G>(|_| rng.unit())).collect();
        for k in 0..10 {
            let near = places[k];
            places.push(point::<G>(|axis| near[axis] + separation * (rng.unit() - 0.5)));
        }
        let t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good points");
        let [low, high] = cube::<G>(-0.5, 1.5);
        let volumes = t.voronoi_volumes(Some([&low, &high])).expect("room");
        let facets = t.voronoi_facets(Some([&low, &high])).expect("room");
        let [wide_low, wide_high] = cube::<G>(-0.75, 1.75);
        let wide = t.voronoi_volumes(Some([&wide_low, &wide_high])).expect("room");
        let mut sums = vec![0.0; places.len()];
        for (edge, measure) in t.edges().expect("room").iter().zip(&facets) {
            let [p, q] = edge.map(|v| places[v]);
            let length = (0..G::D).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>().sqrt();
            edge.iter().for_each(|v| sums[v.index()] += measure * length / (2 * G::D) as f64);
        }
        let mut n_whole = 0;
        for v in 0..places.len() {
            // One that a wider box does not make larger.
            if (volumes[v] - wide[v]).abs() < 1e-13 {
                n_whole += 1;
                assert!((volumes[v] - sums[v]).abs() < 1e-12, "{v}: {} {}", volumes[v], sums[v]);
            }
        }
        assert!(n_whole > 3);
    }
}

#[test]
fn facets_give_the_volumes_of_cells() {
    facets_make_cells::<Plane>();
    facets_make_cells::<Space>();
}

/// Ladders of vertices near a line, whose bisectors nearly coincide: a few of each, and as many as once took for ever.
#[test]
fn nearly_equal_bisectors_take_no_more_than_others() {
    let ladders = |n_ladders: usize, n_steps: usize| {
        let rng = &mut Rng::new(7);
        let mut places = vec![[0.0; 3]];
        for ladder in 0..n_ladders {
            let angle = ladder as f64;
            let turn = [angle.cos(), angle.sin(), 0.3 * rng.unit()];
            for step in 0..n_steps {
                let size = 10f64.powf(-60.0 * step as f64 / n_steps as f64);
                places.push([0, 1, 2].map(|axis| size * (turn[axis] + 1e-9 * rng.unit())));
            }
        }
        places
    };
    let [low, high] = cube::<Space>(-2.0, 2.0);
    check::<Space>(&ladders(3, 4), [&low, &high], 1e-4);
    let mut places = ladders(10, 60);
    places.push([1e-61; 3]);
    let t = MovingTriangulation::<Space>::new(&places, Options::default()).expect("good points");
    let volumes = t.voronoi_volumes(Some([&low, &high])).expect("room");
    assert!((volumes.iter().sum::<f64>() - 64.0).abs() < 1e-9, "{}", volumes.iter().sum::<f64>());
}

fn circle(n: usize, height: f64) -> Vec<[f64; 3]> {
    let at = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    let mut places: Vec<[f64; 3]> =
        (0..n).map(|k| [at(k).cos(), at(k).sin(), height * (7.0 * at(k)).sin()]).collect();
    places.push([0.0; 3]);
    places
}

/// A cell with as many facets as there are other vertices takes time in proportion to these, and can be stopped.
#[test]
fn cells_of_high_degree_can_be_cancelled() {
    let [low, high] = cube::<Space>(-0.3, 0.3);
    for height in [0.0, 0.25] {
        check::<Space>(&circle(12, height), [&low, &high], 1e-4);
        let t = MovingTriangulation::<Space>::new(&circle(20_000, height), Options::default());
        let t = t.expect("good points");
        let mut fractions = Vec::new();
        let mut sum = 0.0;
        let mut watch = |fraction| {
            fractions.push(fraction);
            true
        };
        let add = &mut |_, cell: VoronoiCell<_>| sum += cell.volume;
        t.for_voronoi(Some([&low, &high]), &[], None, &mut watch, Some(add), None).expect("room");
        assert!((sum - 0.216).abs() < 1e-9);
        assert!(!fractions.is_empty() && fractions.is_sorted() && fractions.iter().all(|x| *x <= 1.0));
        let clip = Some([&low, &high]);
        let stopped = t.for_voronoi(clip, &[], None, &mut |_| false, Some(&mut |_, _| ()), None);
        assert!(matches!(stopped, Err(Error::Cancelled)));
        if height > 0.0 {
            let stopped = t.for_voronoi(None, &[], None, &mut |_| false, None, Some(&mut |_, _| ()));
            assert!(matches!(stopped, Err(Error::Cancelled)));
        }
    }
}
