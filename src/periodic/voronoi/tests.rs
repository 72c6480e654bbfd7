//! Voronoi cells and facets beside those of copies in the open, those of lattices, and differences of volumes.

use crate::delaunay::{Moving, Plane, Space};
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::{MovingTriangulation, Options, VoronoiCell, VoronoiFacet};
use crate::periodic::PeriodicTriangulation;
use crate::random::Rng;
use std::collections::BTreeMap;

type Periodic<G> = PeriodicTriangulation<G>;

/// By vertex, another one and the shift of that: measures of whole facets, and what of them is in a box.
type FacetsByEdge<P> = BTreeMap<(usize, usize, [i64; 3]), (f64, VoronoiFacet<P>)>;

fn cells<G: Moving>(t: &Periodic<G>) -> Vec<VoronoiCell<G::Point>> {
    let mut told = vec![None; t.id_count()];
    t.for_voronoi_cells(None, &mut |_| true, &mut |v, cell| {
        assert!(told[v.index()].replace(cell).is_none(), "{v:?} is told once");
    })
    .unwrap();
    told.into_iter().map(Option::unwrap).collect()
}

fn facets<G: Moving>(t: &Periodic<G>) -> Vec<VoronoiFacet<G::Point>> {
    let mut told = vec![None; t.edge_count().unwrap()];
    t.for_voronoi_facets(None, &mut |_| true, &mut |edge, facet| {
        assert!(told[edge].replace(facet).is_none(), "{edge} is told once");
    })
    .unwrap();
    told.into_iter().map(Option::unwrap).collect()
}

fn translated<G: Moving>(p: &G::Point, basis: &[G::Point], shift: [i64; 3]) -> G::Point {
    let mut place = *p;
    for (vector, n) in basis.iter().zip(shift) {
        (0..G::D).for_each(|axis| place[axis] += n as f64 * vector[axis]);
    }
    place
}

/// Points of a box, along open axes from 0 to 1; some of them in other periods.
fn points_of<G: Moving>(rng: &mut Rng, n: usize, basis: &[G::Point]) -> Vec<G::Point> {
    let mut number = || rng.below(1 << 20) as f64 / f64::from(1 << 20);
    let mut points = Vec::new();
    for k in 0..n {
        let mut p = G::Point::default();
        for axis in 0..G::D {
            let along = number();
            match basis.get(axis) {
                Some(vector) => (0..G::D).for_each(|other| p[other] += along * vector[other]),
                None => p[axis] += along,
            }
        }
        let far = if k % 3 == 1 { [2, -5, 1] } else { [0; 3] };
        points.push(translated::<G>(&p, basis, far));
    }
    points
}

fn is_close(x: f64, y: f64, scale: f64) -> bool {
    x == y || (x - y).abs() <= 1e-11 * scale && scale.is_finite() || x.is_nan() && y.is_nan()
}

/// An open triangulation of the copies of a set of which multiples are up to `n` in magnitude, and which copy each of its
/// vertices is.
struct Copies<G: Moving> {
    t: MovingTriangulation<G>,
    of: Vec<(usize, [i64; 3])>,
}

impl<G: Moving> Copies<G> {
    /// Of points taken back into the box.
    fn new(points: &[G::Point], basis: &[G::Point], n: i64) -> Self {
        let (mut places, mut of) = (Vec::new(), Vec::new());
        let range = |j: usize| if j < basis.len() { -n..=n } else { 0..=0 };
        for x in range(0) {
            for y in range(1) {
                for z in range(2) {
                    for (v, p) in points.iter().enumerate() {
                        of.push((v, [x, y, z]));
                        places.push(translated::<G>(p, basis, [x, y, z]));
                    }
                }
            }
        }
        let keys: Vec<u64> = of.iter().map(|&(v, _)| v as u64).collect();
        Copies { t: MovingTriangulation::with_keys(&places, &keys, Options::default()).unwrap(), of }
    }

    /// By vertex and shift of the other one, facets at vertices of the middle copy: of the whole, and in a large box.
    fn facets(&self) -> FacetsByEdge<G::Point> {
        let whole = self.t.voronoi_facets(None).unwrap();
        let (low, high) = far_corners::<G>();
        let edges = self.t.edges().unwrap();
        let mut found = BTreeMap::new();
        let tell = &mut |k: usize, facet: VoronoiFacet<G::Point>| {
            let [v, w] = edges[k].map(|v| self.of[v.index()]);
            for (first, second, is_turned) in [(v, w, false), (w, v, true)] {
                if first.1 == [0; 3] {
                    let mut facet = facet;
                    if is_turned {
                        facet.derivatives.swap(0, 1);
                    }
                    found.insert((first.0, second.0, second.1), (whole[k], facet));
                }
            }
        };
        self.t.for_voronoi(Some([&low, &high]), &[], None, &mut |_| true, None, Some(tell)).unwrap();
        found
    }
}

/// Of a box that cuts no cell of the middle copy, unless it is long.
fn far_corners<G: Moving>() -> (G::Point, G::Point) {
    let (mut low, mut high) = (G::Point::default(), G::Point::default());
    (0..G::D).for_each(|axis| (low[axis], high[axis]) = (-64.0, 64.0));
    (low, high)
}

/// All numbers are those of copies.
fn check<G: Moving>(seed: u64, n: usize, basis: &[G::Point], n_copies: i64) {
    let rng = &mut Rng::new(seed);
    let t = Periodic::<G>::new(&points_of::<G>(rng, n, basis), basis, Options::default()).unwrap();
    let used: Vec<G::Point> = (0..n).map(|v| t.position(VertexId::at(v)).unwrap()).collect();
    // Where points are in the box, the copies are around all of them.
    let far = |v: usize| if v % 3 == 1 { [2, -5, 1] } else { [0; 3] };
    let at_home: Vec<G::Point> =
        (0..n).map(|v| translated::<G>(&used[v], basis, far(v).map(|k| -k))).collect();
    let copies = Copies::<G>::new(&at_home, basis, n_copies);
    let context = format!("seed {seed}, {n} points, {basis:?}");
    check_cells(&t, &copies, &used, &at_home, &context);
    check_facets(&t, &copies, &used, &at_home, far, &context);
}

fn check_cells<G: Moving>(
    t: &Periodic<G>,
    copies: &Copies<G>,
    used: &[G::Point],
    at_home: &[G::Point],
    context: &str,
) {
    let (low, high) = far_corners::<G>();
    let whole = copies.t.voronoi_volumes(None).unwrap();
    let boxed = copies.t.voronoi_cells([&low, &high], None, &mut |_| true).unwrap();
    let found = cells(t);
    let middle = copies.of.iter().position(|&(v, shift)| (v, shift) == (0, [0; 3])).unwrap();
    for (v, cell) in found.iter().enumerate() {
        let k = middle + v;
        assert!(is_close(cell.volume, whole[k], whole[k]), "{context}: {v}: {cell:?} {}", whole[k]);
        assert_eq!(cell.volume.is_infinite(), cell.area.is_infinite(), "{context}: {v}");
        assert_eq!(cell.volume.is_finite(), cell.centroid[0].is_finite(), "{context}: {v}");
        if !is_close(boxed.volumes[k], whole[k], whole[k]) {
            // The cell reaches out of the box, in which it is compared.
            continue;
        }
        assert!(is_close(cell.area, boxed.areas[k], boxed.areas[k]), "{context}: {v}");
        for axis in 0..G::D {
            let (there, here) =
                (boxed.centroids[k][axis] - at_home[v][axis], cell.centroid[axis] - used[v][axis]);
            assert!(is_close(there, here, 64.0), "{context}: {v}: {here} {there}");
        }
    }
}

fn check_facets<G: Moving>(
    t: &Periodic<G>,
    copies: &Copies<G>,
    used: &[G::Point],
    at_home: &[G::Point],
    far: impl Fn(usize) -> [i64; 3],
    context: &str,
) {
    let mut expected = copies.facets();
    for (([v, w], shift), facet) in t.edges().unwrap().zip(facets(t)) {
        let (v, w) = (v.index(), w.index());
        let shift =
            [0, 1, 2].map(|j| if j < t.vector_count() { shift[j] + far(w)[j] - far(v)[j] } else { 0 });
        let (whole, boxed) =
            expected.remove(&(v, w, shift)).unwrap_or_else(|| panic!("{context}: {v} {w} {shift:?}"));
        expected.remove(&(w, v, shift.map(|k| -k))).expect("seen from the other end");
        assert!(is_close(facet.area, whole, whole.max(1.0)), "{context}: {facet:?} {whole}");
        if facet.area.is_infinite() {
            assert!(facet.centroid[0].is_nan() && facet.derivatives[1][0].is_nan());
        } else if is_close(boxed.area, whole, whole) {
            let is_there = facet.area > 0.0 && boxed.area > 1e-7;
            for axis in 0..G::D {
                let (there, here) =
                    (boxed.centroid[axis] - at_home[v][axis], facet.centroid[axis] - used[v][axis]);
                assert!(!is_there || is_close(there, here, 1e3), "{context}: {facet:?} {boxed:?}");
                for (found, expected) in facet.derivatives.iter().zip(&boxed.derivatives) {
                    assert!(is_close(found[axis], expected[axis], 1e3), "{context}: {facet:?} {boxed:?}");
                }
            }
        }
    }
    // The copies of a slab may not all be listed, as an edge of it may have its first end in another copy.
    assert!(expected.is_empty(), "{context}: {:?}", expected.keys().next());
}

#[test]
fn cells_and_facets_are_those_of_copies() {
    for seed in 0..30 {
        let n = [1, 2, 3, 5, 20, 60][seed as usize % 6];
        check::<Plane>(seed, n, &[[1.0, 0.0], [0.0, 1.0]], 3);
        check::<Plane>(seed, n, &[[1.0, 0.0], [0.375, 1.0]], 3);
        check::<Plane>(seed, n, &[[1.0, 0.25], [-0.125, 3.0]], 6);
        check::<Plane>(seed, n, &[[1.0, 0.0]], 5);
    }
    for seed in 0..8 {
        let n = [1, 2, 5, 20][seed as usize % 4];
        check::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 3);
        check::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.5]], 3);
        check::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0]], 3);
    }
}

/// Of one vertex: the lattice's own cell.
#[test]
fn cells_of_lattices_are_known() {
    let of_one = |basis: &[[f64; 3]]| {
        let t = Periodic::<Space>::new(&[[0.375, 7.25, -100.5]], basis, Options::default()).unwrap();
        let (cell, facets) = (cells(&t)[0], facets(&t));
        assert!(is_close(2.0 * facets.iter().map(|f| f.area).sum::<f64>(), cell.area, cell.area));
        for (x, expected) in cell.centroid.iter().zip([0.375, 7.25, -100.5]) {
            assert!((x - expected).abs() < 1e-13, "{:?}", cell.centroid);
        }
        (cell.volume, cell.area, facets)
    };
    let (volume, area, facets) = of_one(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!((volume, area, facets.len()), (1.0, 6.0, 7));
    let squares: Vec<_> = facets.iter().filter(|facet| facet.area > 0.0).collect();
    assert_eq!(squares.len(), 3);
    for facet in squares {
        let [one, other] = facet.derivatives;
        assert_eq!((facet.area, one.iter().map(|x| x.abs()).sum::<f64>()), (1.0, 0.5));
        assert_eq!(one.map(|x| -x), other);
    }
    // Bodies of Kelvin: eight hexagons and six squares with sides of the square root of 1/8.
    let (volume, area, _) = of_one(&[[-0.5, 0.5, 0.5], [0.5, -0.5, 0.5], [0.5, 0.5, -0.5]]);
    assert!(is_close(volume, 0.5, 1.0) && is_close(area, (6.0 + 12.0 * 3f64.sqrt()) / 8.0, 1.0));
    // Rhombic dodecahedra: the twelve faces have diagonals of 1/2 and the square root of 1/2.
    let (volume, area, _) = of_one(&[[0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]]);
    assert!(is_close(volume, 0.25, 1.0) && is_close(area, 3.0 * 0.5f64.sqrt(), 1.0), "{area}");
}

/// What a vertex changes is what differences of volumes tell, for all periods of it together; small boxes have edges from a
/// vertex to itself, and several between two.
fn check_derivatives<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let points = points_of::<G>(rng, n, basis);
    let t = Periodic::<G>::new(&points, basis, Options::default()).unwrap();
    let mut derivatives = vec![vec![G::Point::default(); n]; n];
    for (([v, w], _), facet) in t.edges().unwrap().zip(facets(&t)) {
        let (v, w) = (v.index(), w.index());
        for axis in (0..G::D).filter(|_| v != w) {
            let [of_v, of_w] = facet.derivatives.map(|of| of[axis]);
            derivatives[v][w][axis] += of_v;
            derivatives[w][v][axis] += of_w;
            derivatives[w][w][axis] -= of_v;
            derivatives[v][v][axis] -= of_w;
        }
    }
    let step = f64::from(2.0f32).powi(-14);
    for moved in 0..n {
        for axis in 0..G::D {
            let volumes = [-1.0, 1.0].map(|sign| {
                let mut there = points.clone();
                there[moved][axis] += sign * step;
                let t = Periodic::<G>::new(&there, basis, Options::default()).unwrap();
                t.voronoi_volumes(&mut |_| true).unwrap()
            });
            for v in 0..n {
                let quotient = (volumes[1][v] - volumes[0][v]) / (2.0 * step);
                let found = derivatives[v][moved][axis];
                assert!((quotient - found).abs() < 2e-3, "{seed}, {n}, {basis:?}: {quotient} {found}");
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    for seed in 0..8 {
        let n = 1 + seed as usize % 6;
        check_derivatives::<Plane>(seed, n, &[[1.0, 0.0], [0.375, 1.0]]);
        check_derivatives::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.25]]);
    }
}

/// A mask leaves numbers as they are to the last bit, and what is not in it is not told.
#[test]
fn masks_change_no_bit() {
    let rng = &mut Rng::new(3);
    let basis = [[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.25]];
    let mut t =
        Periodic::<Space>::new(&points_of::<Space>(rng, 400, &basis), &basis, Options::default()).unwrap();
    t.stage_removals(&[VertexId::new(5)]).unwrap();
    t.commit_timestamp().unwrap();
    let (all, at_edges) = (cells(&t), facets(&t));
    assert!(all[5].volume.is_nan() && all[5].area.is_nan() && all[5].centroid[2].is_nan());
    let total: f64 = all.iter().map(|cell| cell.volume).filter(|x| !x.is_nan()).sum();
    assert!((total - 1.25).abs() < 1e-13, "{total}");
    let mask: Vec<u8> = (0..400).map(|v| u8::from(v % 7 == 5)).collect();
    let mut n_told = 0;
    t.for_voronoi_cells(Some(&mask), &mut |_| true, &mut |v, cell| {
        assert!(mask[v.index()] != 0 && format!("{cell:?}") == format!("{:?}", all[v]));
        n_told += 1;
    })
    .unwrap();
    assert_eq!(n_told, mask.iter().filter(|&&x| x != 0).count());
    let edges: Vec<_> = t.edges().unwrap().collect();
    let mut n_told = 0;
    t.for_voronoi_facets(Some(&mask), &mut |_| true, &mut |k, facet| {
        assert!(facet == at_edges[k]);
        n_told += 1;
    })
    .unwrap();
    assert_eq!(n_told, edges.iter().filter(|(edge, _)| edge.iter().any(|v| mask[v.index()] != 0)).count());
    let short = t.for_voronoi_cells(Some(&mask[1..]), &mut |_| true, &mut |_, _| ());
    let wanted = Error::WrongCount { argument: "mask_count", given: 399, wanted: 400, coming: 0 };
    assert_eq!(short, Err(wanted.clone()));
    assert_eq!(t.for_voronoi_facets(Some(&mask[1..]), &mut |_| true, &mut |_, _| ()), Err(wanted));
}

/// Lengths across a slab that are nothing beside those along it, or all there is, are in the range of numbers.
#[test]
fn slabs_of_any_width_have_numbers() {
    for width in [1e-200, 1e-120, 1e-30, 1e30, 1e45] {
        // Between two rows of vertices there is one more, at the middle of the box.
        let points = [[0.25, 0.0], [0.75, 0.0], [0.25, width], [0.75, width], [0.5, 0.5 * width]];
        let t = Periodic::<Plane>::new(&points, &[[1.0, 0.0]], Options::default()).unwrap();
        let cells = cells(&t);
        for cell in &cells[..4] {
            assert!(
                cell.volume.is_infinite() && cell.area.is_infinite() && cell.centroid[0].is_nan(),
                "{width}"
            );
        }
        // Far away, rows are as good as lines; copies would have to be as many as it is wide.
        let expected = if width > 1.0 {
            0.5 * width
        } else {
            let copies = Copies::<Plane>::new(&points, &[[1.0, 0.0]], 3);
            copies.t.voronoi_volumes(None).unwrap()[3 * 5 + 4]
        };
        assert!(is_close(cells[4].volume, expected, expected), "{width}: {:?} {expected}", cells[4]);
        let facets = facets(&t);
        assert!(facets.iter().all(|facet| facet.area >= 0.0), "{width}: {facets:?}");
        if cells[4].volume.is_finite() {
            assert!(is_close(cells[4].centroid[1], 0.5 * width, width), "{width}: {:?}", cells[4]);
        }
    }
    // On one line there are no cells, and all is infinite.
    let line = Periodic::<Plane>::new(&[[0.0, 0.5], [0.25, 0.5]], &[[1.0, 0.0]], Options::default()).unwrap();
    assert!(cells(&line).iter().all(|cell| cell.volume.is_infinite() && cell.centroid[1].is_nan()));
    assert_eq!(line.edge_count(), Ok(0));
}

/// What cells and facets take for a vertex, beside the open.
#[test]
#[ignore = "prints times"]
fn times() {
    use std::time::Instant;
    let rng = &mut Rng::new(1);
    let n = 100_000;
    let cube = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let points = points_of::<Space>(rng, n, &cube);
    let t = Periodic::<Space>::new(&points, &cube, Options::default()).unwrap();
    let inside: Vec<[f64; 3]> = points.iter().map(|p| p.map(|x| x - x.floor())).collect();
    let open = MovingTriangulation::<Space>::new(&inside, Options::default()).unwrap();
    let time = |what: &str, run: &dyn Fn()| {
        run();
        let start = Instant::now();
        run();
        println!("{what}: {:.3} us a vertex", 1e6 * start.elapsed().as_secs_f64() / n as f64);
    };
    time("cells", &|| t.for_voronoi_cells(None, &mut |_| true, &mut |_, _| ()).unwrap());
    let clip = [&[0.0; 3], &[1.0; 3]];
    time("open cells", &|| drop(open.voronoi_cells(clip, None, &mut |_| true).unwrap()));
    let home: Vec<u8> = (0..t.image_count()).map(|v| u8::from(v < n)).collect();
    let far = [&[-9.0; 3], &[9.0; 3]];
    time("inside, masked", &|| drop(t.inside.t.voronoi_cells(far, Some(&home), &mut |_| true).unwrap()));
    time("edges", &|| assert!(super::super::edges::PeriodicEdges::of(&t.inside).unwrap().list.len() > n));
    time("edges again", &|| assert!(t.edges().unwrap().all(|(edge, _)| edge[0] <= edge[1])));
    time("open edges", &|| assert!(open.edges().unwrap().len() > n));
    time("facets", &|| t.for_voronoi_facets(None, &mut |_| true, &mut |_, _| ()).unwrap());
    time("open facets", &|| drop(open.voronoi_derivatives(clip, None, &mut |_| true).unwrap()));
}
