//! Voronoi cells against half-spaces cut one after the other, by all vertices; and interpolation against exact
//! coordinates and against triangulations that have the place for a vertex.

use crate::common::exact::{Grid, orientation, to_point};
use crate::common::{Rng, point, seeds};
use deldrift::motion::{
    Interpolation, Location, MovingTriangulation, Options, VertexValues, VoronoiCell, VoronoiFacet,
};
use deldrift::{Dimension, Error, Plane, Space, VertexId};

type Vector = [f64; 3];

fn minus(p: &Vector, q: &Vector) -> Vector {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

fn dot(p: &Vector, q: &Vector) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: &Vector, q: &Vector) -> Vector {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// A polyhedron: its faces, each with the vertex whose bisector it is on, if any, and its corners in order.
type Polyhedron = Vec<(Option<VertexId>, Vec<Vector>)>;

fn of_box(low: &Vector, high: &Vector) -> Polyhedron {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .map(|face| (None, face.map(corner).to_vec()))
        .to_vec()
}

/// What is left of a polyhedron behind a plane; the section becomes a face.
fn cut(polyhedron: &Polyhedron, normal: &Vector, through: &Vector, name: VertexId) -> Polyhedron {
    let height = |p: &Vector| dot(normal, &minus(p, through));
    let mut left = Polyhedron::new();
    let mut section: Vec<Vector> = Vec::new();
    for (owner, face) in polyhedron {
        let mut kept = Vec::new();
        for (k, p) in face.iter().enumerate() {
            let q = &face[(k + 1) % face.len()];
            let (a, b) = (height(p), height(q));
            if a <= 0.0 {
                kept.push(*p);
            }
            if (a <= 0.0) != (b <= 0.0) {
                let x = [0, 1, 2].map(|axis| p[axis] + a / (a - b) * (q[axis] - p[axis]));
                kept.push(x);
                section.push(x);
            }
        }
        if kept.len() > 2 {
            left.push((*owner, kept));
        }
    }
    if section.len() > 2 {
        // Around the middle, by angle.
        let middle =
            [0, 1, 2].map(|axis| section.iter().map(|p| p[axis]).sum::<f64>() / section.len() as f64);
        let far = |p: &&Vector| dot(&minus(p, &middle), &minus(p, &middle));
        let first = minus(section.iter().max_by(|p, q| far(p).total_cmp(&far(q))).expect("some"), &middle);
        let second = cross(normal, &first);
        let scale = dot(normal, normal).sqrt();
        let angle =
            |p: &Vector| (dot(&minus(p, &middle), &second) / scale).atan2(dot(&minus(p, &middle), &first));
        section.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
        left.push((Some(name), section));
    }
    left
}

fn area_vector(face: &[Vector]) -> Vector {
    let mut doubled = [0.0; 3];
    for pair in face[1..].windows(2) {
        let more = cross(&minus(&pair[0], &face[0]), &minus(&pair[1], &face[0]));
        (0..3).for_each(|axis| doubled[axis] += more[axis]);
    }
    doubled.map(|x| 0.5 * x)
}

fn volume(polyhedron: &Polyhedron) -> f64 {
    let Some((_, first)) = polyhedron.first() else { return 0.0 };
    let apex = first[0];
    let pyramid = |(_, face): &(Option<VertexId>, Vec<Vector>)| {
        dot(&area_vector(face), &minus(&face[0], &apex)).abs() / 3.0
    };
    polyhedron.iter().map(pyramid).sum()
}

fn in_space<G: Dimension>(p: &G::Point) -> Vector {
    [0, 1, 2].map(|axis| if axis < G::D { p[axis] } else { 0.0 })
}

/// Boxes of several positions to the unit box.
fn boxes<G: Dimension>() -> Vec<[G::Point; 2]> {
    let of = |low: f64, high: f64| [point::<G>(|_| low), point::<G>(|_| high)];
    vec![
        of(0.0, 1.0),
        of(-0.5, 1.5),
        of(0.25, 0.5),
        of(-50.0, 3.0),
        of(2.0, 3.0),
        [point::<G>(|axis| axis as f64 - 0.7), point::<G>(|axis| axis as f64 - 0.1)],
    ]
}

fn box_volume<G: Dimension>([low, high]: &[G::Point; 2]) -> f64 {
    (0..G::D).map(|axis| high[axis] - low[axis]).product()
}

/// Clouds, lattices (all cells of which are cospherical), spheres (all vertices on the hull), clusters.
fn clouds<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<Vec<G::Point>> {
    let side = (n as f64).powf(1.0 / G::D as f64).ceil() as usize;
    let on_sphere = |rng: &mut Rng| {
        let p = point::<G>(|_| rng.unit() - 0.5);
        let length = (0..G::D).map(|axis| p[axis] * p[axis]).sum::<f64>().sqrt();
        point::<G>(|axis| 0.5 + 0.5 * p[axis] / length)
    };
    vec![
        (0..n).map(|_| point::<G>(|_| rng.unit())).collect(),
        (0..n).map(|k| point::<G>(|axis| (k / side.pow(axis as u32) % side) as f64 / side as f64)).collect(),
        (0..n).map(|_| on_sphere(rng)).collect(),
        (0..n).map(|k| point::<G>(|_| 0.3 + rng.unit() * [0.5, 1e-3, 1e-6][k % 3])).collect(),
    ]
}

/// With a removed vertex, and one that is hidden.
fn triangulation<G: Dimension>(points: &[G::Point]) -> MovingTriangulation<G> {
    let mut t = MovingTriangulation::<G>::new(points, Options::default()).expect("good points");
    t.insert_vertex(&points[2]).expect("a good place");
    t.remove_vertex(VertexId::new(1)).expect("present");
    t
}

fn cells_fill_the_box<G: Dimension>(n: usize) {
    for seed in seeds(2) {
        let rng = &mut Rng::new(seed);
        for points in clouds::<G>(n, rng) {
            let t = triangulation::<G>(&points);
            for clip in boxes::<G>() {
                let volumes = t.voronoi_volumes(Some([&clip[0], &clip[1]])).expect("room");
                assert_eq!(volumes.len(), n + 1);
                assert!(volumes[1].is_nan() && volumes[n] == 0.0);
                let present = volumes.iter().enumerate().filter(|&(v, _)| v != 1);
                let (sum, whole) = (present.map(|(_, x)| x).sum::<f64>(), box_volume::<G>(&clip));
                assert!((sum - whole).abs() < 1e-12 * whole, "{sum}, not {whole}, in {clip:?}");
            }
        }
    }
}

#[test]
fn voronoi_cells_fill_the_box() {
    cells_fill_the_box::<Plane>(900);
    cells_fill_the_box::<Space>(700);
}

fn cells_are_those_of_half_spaces<G: Dimension>() {
    let rng = &mut Rng::new(5);
    for points in clouds::<G>(40, rng) {
        let t = triangulation::<G>(&points);
        let edges = t.edges().expect("room");
        let ids = || VertexId::range(0..points.len()).filter(|v| v.get() != 1);
        for clip in boxes::<G>() {
            let whole = box_volume::<G>(&clip);
            let volumes = t.voronoi_volumes(Some([&clip[0], &clip[1]])).expect("room");
            let facets = t.voronoi_facets(Some([&clip[0], &clip[1]])).expect("room");
            assert_eq!(facets.len(), edges.len());
            let (low, mut high) = (in_space::<G>(&clip[0]), in_space::<G>(&clip[1]));
            if G::D == 2 {
                high[2] = 1.0;
            }
            for v in ids() {
                let at = in_space::<G>(&points[v]);
                let mut cell = of_box(&low, &high);
                for w in ids().filter(|&w| w != v) {
                    let to = in_space::<G>(&points[w]);
                    let middle = [0, 1, 2].map(|axis| 0.5 * (at[axis] + to[axis]));
                    cell = cut(&cell, &minus(&to, &at), &middle, w);
                }
                let expected = volume(&cell);
                assert!(
                    (volumes[v.index()] - expected).abs() < 1e-9 * whole,
                    "{} {expected}",
                    volumes[v.index()]
                );
                for w in ids().filter(|&w| v < w) {
                    let faces = cell.iter().filter(|(owner, _)| *owner == Some(w));
                    let area: f64 =
                        faces.map(|(_, face)| area_vector(face)).map(|a| dot(&a, &a).sqrt()).sum();
                    let found = edges.binary_search(&[v, w]).map_or(0.0, |k| facets[k]);
                    // One in a face of the box may count or not.
                    let is_in_face = |axis: usize| {
                        let middle = 0.5 * (at[axis] + in_space::<G>(&points[w])[axis]);
                        [low, high].iter().any(|corner| (corner[axis] - middle).abs() < 1e-9)
                    };
                    if (0..G::D).any(is_in_face) {
                        continue;
                    }
                    assert!(
                        (found - area).abs() < 1e-8 * whole.max(1.0),
                        "{v} {w} in {clip:?}: {found} {area}"
                    );
                }
            }
        }
    }
}

#[test]
fn voronoi_cells_are_those_of_half_spaces() {
    cells_are_those_of_half_spaces::<Plane>();
    cells_are_those_of_half_spaces::<Space>();
}

/// Few vertices in a plane that is parallel to an axis, or on a line in it, up to a hundred boxes away: their cells have
/// facets that are planes, half-planes and strips as a whole, and beyond faces of the box in part or altogether.
#[test]
fn voronoi_cells_of_few_vertices_in_a_plane_are_those_of_half_spaces() {
    let rng = &mut Rng::new(31);
    let (low, high): (Vector, Vector) = ([-3.0, -3.0, -2.0], [4.0, 4.0, 3.0]);
    let whole = box_volume::<Space>(&[low, high]);
    let mut n_parted = 0;
    for round in 0..4000 {
        let (n, axis, size) = (2 + rng.below(4), rng.below(3), [1.0, 10.0, 100.0][rng.below(3)]);
        let draw = |rng: &mut Rng| {
            point::<Space>(|_| {
                let x = size * 10.0 * (rng.unit() - 0.5);
                // Some are whole numbers, so that bisectors are parallel to axes, or meet edges of the box.
                if rng.one_in(3) { x.round().clamp(-5.0, 5.0) } else { x }
            })
        };
        let (first, second) = (draw(rng), draw(rng));
        let is_line = rng.one_in(4);
        let points: Vec<Vector> = (0..n)
            .map(|k| {
                let mut p = if is_line {
                    let along = k as f64 * 0.5;
                    point::<Space>(|k| first[k] + along * (second[k] - first[k]))
                } else {
                    draw(rng)
                };
                p[axis] = first[axis];
                p
            })
            .collect();
        let is_twice = (1..n).any(|k| points[..k].contains(&points[k]));
        let t = MovingTriangulation::<Space>::new(&points, Options::default()).expect("good points");
        if is_twice || t.cell_count() > 0 {
            continue;
        }
        let volumes = t.voronoi_volumes(Some([&low, &high])).expect("room");
        for v in 0..n {
            let mut cell = of_box(&low, &high);
            for w in (0..n).filter(|&w| w != v) {
                let middle = [0, 1, 2].map(|axis| 0.5 * (points[v][axis] + points[w][axis]));
                cell = cut(&cell, &minus(&points[w], &points[v]), &middle, VertexId::at(w));
            }
            let expected = volume(&cell);
            assert!(
                (volumes[v] - expected).abs() < 1e-8 * whole,
                "{round}: {}, not {expected}, of {v} in {points:?}",
                volumes[v]
            );
            n_parted += usize::from(expected > 1e-8 && expected < whole - 1e-8);
        }
    }
    assert!(n_parted > 1000, "{n_parted}");
}

/// Cells by id and facets by edge, as far as they are told.
type Told<P> = (Vec<Option<VoronoiCell<P>>>, Vec<Option<VoronoiFacet<P>>>);

/// What one call tells of cells and of facets, if each is asked for.
fn numbers<G: Dimension>(
    t: &MovingTriangulation<G>,
    clip: Option<&[G::Point; 2]>,
    mask: Option<&[u8]>,
    [of_cells, of_facets]: [bool; 2],
) -> Told<G::Point> {
    let n_cells = if of_cells { t.id_count() } else { 0 };
    let n_facets = if of_facets { t.edge_count() } else { 0 };
    let (mut cells, mut facets) = (vec![None; n_cells], vec![None; n_facets]);
    let mut tell_cell = |v: VertexId, cell: VoronoiCell<G::Point>| {
        assert!(cells[v.index()].replace(cell).is_none(), "{v:?} is told once");
    };
    let mut tell_facet = |k: usize, facet: VoronoiFacet<G::Point>| {
        assert!(facets[k].replace(facet).is_none(), "{k} is told once");
    };
    t.for_voronoi(
        clip.map(|clip| clip.each_ref()),
        &[],
        mask,
        &mut |_| true,
        if of_cells { Some(&mut tell_cell) } else { None },
        if of_facets { Some(&mut tell_facet) } else { None },
    )
    .expect("room");
    (cells, facets)
}

fn cells_without_a_box<G: Dimension>() {
    let rng = &mut Rng::new(7);
    let points = clouds::<G>(300, rng).swap_remove(0);
    let t = triangulation::<G>(&points);
    let mut is_on_hull = vec![false; points.len() + 1];
    t.hull_facets(|facet| facet.vertices().iter().for_each(|v| is_on_hull[v.index()] = true)).expect("room");
    let far = [point::<G>(|_| -1e6), point::<G>(|_| 1e6)];
    let (all, clipped) =
        (t.voronoi_volumes(None).expect("room"), t.voronoi_volumes(Some([&far[0], &far[1]])));
    let clipped = clipped.expect("room");
    for v in (0..=points.len()).filter(|&v| v != 1) {
        assert_eq!(all[v].is_infinite(), is_on_hull[v]);
        assert!(is_on_hull[v] || (all[v] - clipped[v]).abs() <= 1e-9 * all[v]);
    }
    let facets = t.voronoi_facets(None).expect("room");
    let edges = t.edges().expect("room");
    assert!(
        facets
            .iter()
            .zip(&edges)
            .all(|(measure, edge)| { measure.is_finite() || edge.iter().all(|v| is_on_hull[v.index()]) })
    );
    let mask: Vec<u8> = (0..t.id_count()).map(|v| u8::from(v % 3 == 0)).collect();
    let (whole, boxed) = (numbers(&t, None, None, [true; 2]), numbers(&t, Some(&far), None, [true; 2]));
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-7 * (1.0 + x.abs());
    for (v, cell) in whole.0.iter().enumerate() {
        let Some(cell) = cell.as_ref().filter(|cell| cell.volume > 1e-6 && cell.volume < 1e6) else {
            assert!(all[v].is_nan() || all[v] <= 1e-6 || all[v] >= 1e6);
            continue;
        };
        let there = boxed.0[v].as_ref().expect("all are told");
        assert!(cell.volume.to_bits() == all[v].to_bits() && near(cell.area, there.area));
        assert!((0..G::D).all(|axis| near(cell.centroid[axis], there.centroid[axis])), "{v}");
    }
    for (k, facet) in whole.1.iter().enumerate() {
        let (facet, there) = (facet.as_ref().expect("told"), boxed.1[k].as_ref().expect("told"));
        assert_eq!(facet.area.to_bits(), facets[k].to_bits());
        // A facet of an inner vertex is in the large box.
        let is_inner = edges[k].iter().any(|v| !is_on_hull[v.index()]);
        for axis in (0..G::D).filter(|_| is_inner && facet.area > 1e-6) {
            assert!(near(facet.centroid[axis], there.centroid[axis]), "{k}");
            let pairs = facet.derivatives.iter().zip(&there.derivatives);
            assert!(pairs.into_iter().all(|(one, other)| near(one[axis], other[axis])), "{k}");
        }
    }
    // Neither what else is told nor a mask changes a bit.
    for clip in [None, Some(&far)] {
        let both = numbers(&t, clip, None, [true; 2]);
        let (cells, sides) =
            (numbers(&t, clip, None, [true, false]).0, numbers(&t, clip, None, [false, true]).1);
        assert_eq!(format!("{both:?}"), format!("{:?}", (cells, sides)));
        let some = numbers(&t, clip, Some(&mask), [true; 2]);
        for (v, cell) in some.0.iter().enumerate() {
            assert_eq!(cell.is_some(), mask[v] != 0);
            assert!(cell.is_none() || format!("{cell:?}") == format!("{:?}", both.0[v]));
        }
        for (k, facet) in some.1.iter().enumerate() {
            assert_eq!(facet.is_some(), edges[k].iter().any(|v| mask[v.index()] != 0));
            assert!(facet.is_none() || format!("{facet:?}") == format!("{:?}", both.1[k]));
        }
    }
    assert!(t.for_voronoi(None, &vec![1.0; G::D + 1], None, &mut |_| true, None, None).is_err());
    let n_infinite = facets.iter().filter(|measure| measure.is_infinite()).count();
    // All edges of the hull, by Euler's formula.
    assert_eq!(n_infinite, if G::D == 2 { t.hull_facet_count() } else { t.hull_facet_count() * 3 / 2 });
}

#[test]
fn voronoi_cells_of_the_hull_are_infinite() {
    cells_without_a_box::<Plane>();
    cells_without_a_box::<Space>();
    let none =
        MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 1.0]], Options::default()).expect("good");
    assert_eq!(none.voronoi_volumes(None).expect("room"), [f64::INFINITY; 2]);
    assert!(none.voronoi_facets(None).expect("room").is_empty());
    for (low, high) in [([0.0, 0.0], [1.0, 0.0]), ([0.0, 0.0], [1.0, -1.0])] {
        let refused = none.voronoi_volumes(Some([&low, &high]));
        assert!(matches!(refused, Err(Error::InvalidValue { argument: "high", index: 1, .. })));
    }
    let refused = none.voronoi_facets(Some([&[f64::NAN, 0.0], &[1.0, 1.0]]));
    assert!(matches!(refused, Err(Error::NotFinite { argument: "low", .. })));
    let refused = none.voronoi_facets(Some([&[0.0, 0.0], &[1e58, 1.0]]));
    assert!(matches!(refused, Err(Error::OutOfRange { argument: "high", .. })));
}

const METHODS: [Interpolation; 2] = [Interpolation::Linear, Interpolation::NaturalNeighbour];

/// Places inside, outside, on edges and hull facets, and at vertices.
fn places<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) -> Vec<G::Point> {
    let mut places: Vec<G::Point> = (0..300).map(|_| point::<G>(|_| 1.2 * rng.unit() - 0.1)).collect();
    let at = |v: VertexId| t.position(v).expect("present");
    for [v, w] in t.edges().expect("room") {
        places.push(point::<G>(|axis| 0.5 * (at(v)[axis] + at(w)[axis])));
    }
    t.hull_facets(|facet| {
        let vertices = facet.vertices();
        let mean = |axis: usize| vertices.iter().map(|&v| at(v)[axis]).sum::<f64>() / vertices.len() as f64;
        places.push(point::<G>(mean));
        // Just inside.
        places.push(point::<G>(|axis| mean(axis) + 1e-9 * (0.5 - mean(axis))));
    })
    .expect("room");
    places.extend(VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).map(at));
    places
}

fn linear_functions_are_reproduced<G: Dimension>() {
    let rng = &mut Rng::new(11);
    let slopes = [[0.7, -1.1, 0.4], [1e3, 2e3, -3e3]];
    let function =
        |p: &G::Point, k: usize| 5.0 + (0..G::D).map(|axis| slopes[k][axis] * p[axis]).sum::<f64>();
    for points in clouds::<G>(150, rng) {
        let t = triangulation::<G>(&points);
        let mut values: Vec<f64> = points.iter().flat_map(|p| [function(p, 0), function(p, 1)]).collect();
        // Neither the removed nor the hidden vertex counts.
        (values[2], values[3]) = (f64::NAN, f64::INFINITY);
        values.extend([f64::NAN, 1e300]);
        let places = places::<G>(&t, rng);
        for method in METHODS {
            let given = VertexValues { values: &values, n_values: 2 };
            let (mut at, mut n_outside) = (places.iter(), 0);
            t.interpolate(method, given, &places, None, |result| {
                let p = at.next().expect("a place");
                let location = t.locate(p).expect("a good place");
                assert_eq!(result.is_none(), matches!(location, Location::Outside(_)));
                let Some(result) = result else {
                    n_outside += 1;
                    return;
                };
                for (k, value) in result.iter().enumerate() {
                    let wanted = function(p, k);
                    let scale = 5.0 + slopes[k].iter().map(|x| x.abs()).sum::<f64>();
                    assert!(
                        (value - wanted).abs() < 1e-13 * scale,
                        "{method:?} {p:?}: {value}, not {wanted}"
                    );
                }
                if let Location::Vertex(v) = location {
                    assert_eq!(result, &values[2 * v.index()..][..2]);
                }
            })
            .expect("room");
            assert!(at.next().is_none() && n_outside > 10);
        }
    }
}

#[test]
fn interpolation_reproduces_linear_functions() {
    linear_functions_are_reproduced::<Plane>();
    linear_functions_are_reproduced::<Space>();
}

/// Against barycentric coordinates in integers.
fn linear_is_exact_but_for_rounding<G: Dimension>() {
    let rng = &mut Rng::new(13);
    for flatness in [1, 1 << 18] {
        let somewhere = |rng: &mut Rng| -> Grid {
            (0..G::D)
                .map(|axis| rng.within(0, if axis == 0 { 1 << 20 } else { (1 << 20) / flatness }))
                .collect()
        };
        let grid: Vec<Grid> = (0..60).map(|_| somewhere(rng)).collect();
        let points: Vec<G::Point> = grid.iter().map(to_point::<G>).collect();
        let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
        let rows = t.cells().expect("room").corners;
        let values: Vec<f64> = points.iter().map(|_| rng.unit()).collect();
        for _ in 0..500 {
            let q = somewhere(rng);
            let place = to_point::<G>(&q);
            let Location::Cell(cell) = t.locate(&place).expect("a good place") else { continue };
            let corners: Vec<&Grid> = rows[cell].as_ref().iter().map(|&v| &grid[v]).collect();
            let wanted: f64 = rows[cell]
                .as_ref()
                .iter()
                .enumerate()
                .map(|(i, &v)| {
                    let mut replaced = corners.clone();
                    replaced[i] = &q;
                    values[v.index()] * (orientation(&replaced) as f64 / orientation(&corners) as f64)
                })
                .sum();
            let given = VertexValues { values: &values, n_values: 1 };
            t.interpolate(Interpolation::Linear, given, &[place], None, |result| {
                let found = result.expect("inside")[0];
                assert!((found - wanted).abs() < 1e-9, "{found}, not {wanted}");
            })
            .expect("room");
        }
    }
}

#[test]
fn linear_interpolation_is_that_of_exact_coordinates() {
    linear_is_exact_but_for_rounding::<Plane>();
    linear_is_exact_but_for_rounding::<Space>();
}

/// The weights are those of the Voronoi facets that a vertex at the place has.
fn natural_neighbours_are_those_of_a_vertex<G: Dimension>() {
    let rng = &mut Rng::new(17);
    for points in [clouds::<G>(200, rng).swap_remove(0), clouds::<G>(200, rng).swap_remove(1)] {
        let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
        let values: Vec<f64> = points.iter().map(|_| rng.unit()).collect();
        let mut n_compared = 0;
        for _ in 0..60 {
            let place = point::<G>(|_| 0.2 + 0.6 * rng.unit());
            let mut with = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
            let vertex = with.insert_vertex(&place).expect("a good place");
            let (edges, facets) = (with.edges().expect("room"), with.voronoi_facets(None).expect("room"));
            let (mut sum, mut weighted) = (0.0, 0.0);
            for ([v, w], measure) in edges.iter().zip(facets) {
                if *w == vertex {
                    let distance =
                        (0..G::D).map(|axis| (points[*v][axis] - place[axis]).powi(2)).sum::<f64>().sqrt();
                    sum += measure / distance;
                    weighted += values[v.index()] * measure / distance;
                }
            }
            if !sum.is_finite() {
                continue;
            }
            n_compared += 1;
            let given = VertexValues { values: &values, n_values: 1 };
            t.interpolate(Interpolation::NaturalNeighbour, given, &[place], None, |result| {
                let found = result.expect("inside")[0];
                assert!((found - weighted / sum).abs() < 1e-9, "{place:?}: {found}, not {}", weighted / sum);
            })
            .expect("room");
        }
        assert!(n_compared > 40);
    }
}

#[test]
fn natural_neighbours_weigh_as_those_of_a_vertex() {
    natural_neighbours_are_those_of_a_vertex::<Plane>();
    natural_neighbours_are_those_of_a_vertex::<Space>();
}

#[test]
fn interpolation_refuses_bad_arguments() {
    let t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Options::default());
    let t = t.expect("good points");
    let given = VertexValues { values: &[1.0, 2.0], n_values: 1 };
    let refused = t.interpolate(Interpolation::Linear, given, &[[0.1, 0.1]], None, |_| panic!("told"));
    assert!(matches!(refused, Err(Error::WrongCount { .. })));
    let given = VertexValues { values: &[1.0, 2.0, 3.0], n_values: 1 };
    let refused =
        t.interpolate(Interpolation::Linear, given, &[[0.1, 0.1], [0.1, f64::NAN]], None, |_| panic!("told"));
    assert!(matches!(refused, Err(Error::NotFinite { index: 1, .. })));
}
