//! Cut cells and facets beside those of copies in the open, which are cut as well, measures of containers, and differences of
//! volumes.

use std::collections::BTreeMap;

use crate::delaunay::{Moving, Plane, Space};
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::{MovingTriangulation, Options, VoronoiCell, VoronoiFacet};
use crate::periodic::PeriodicTriangulation;
use crate::random::Rng;

const INFINITE: f64 = f64::INFINITY;

/// A box that repeats, and what cuts its cells: the corners of a box, and half-spaces; with the measure of what is left of one period.
struct Case<G: Moving> {
    basis: Vec<G::Point>,
    clip: Option<[G::Point; 2]>,
    half_spaces: Vec<f64>,
    measure: f64,
}

fn translated<G: Moving>(p: &G::Point, basis: &[G::Point], shift: [i64; 3]) -> G::Point {
    let mut place = *p;
    for (vector, n) in basis.iter().zip(shift) {
        (0..G::D).for_each(|axis| place[axis] += n as f64 * vector[axis]);
    }
    place
}

fn cells<G: Moving>(t: &PeriodicTriangulation<G>, case: &Case<G>) -> Vec<VoronoiCell<G::Point>> {
    let mut told = vec![None; t.id_count()];
    let clip = case.clip.as_ref().map(|clip| clip.each_ref());
    let tell =
        &mut |v: VertexId, cell| assert!(told[v.index()].replace(cell).is_none(), "{v:?} is told once");
    t.for_voronoi(clip, &case.half_spaces, None, &mut |_| true, Some(tell), None).unwrap();
    told.into_iter().map(Option::unwrap).collect()
}

fn facets<G: Moving>(t: &PeriodicTriangulation<G>, case: &Case<G>) -> Vec<VoronoiFacet<G::Point>> {
    let mut told = vec![None; t.edge_count().unwrap()];
    let clip = case.clip.as_ref().map(|clip| clip.each_ref());
    let tell = &mut |k: usize, facet| assert!(told[k].replace(facet).is_none(), "{k} is told once");
    t.for_voronoi(clip, &case.half_spaces, None, &mut |_| true, None, Some(tell)).unwrap();
    told.into_iter().map(Option::unwrap).collect()
}

fn volumes_within<G: Moving>(
    t: &PeriodicTriangulation<G>,
    clip: Option<[&G::Point; 2]>,
    rows: &[f64],
) -> Result<Vec<f64>, Error> {
    let mut volumes = vec![f64::NAN; t.id_count()];
    let tell = &mut |v: VertexId, cell: VoronoiCell<G::Point>| volumes[v.index()] = cell.volume;
    t.for_voronoi(clip, rows, None, &mut |_| true, Some(tell), None)?;
    Ok(volumes)
}

fn is_close(x: f64, y: f64, scale: f64) -> bool {
    (x - y).abs() <= 1e-11 * scale || x.is_nan() && y.is_nan()
}

/// Compares all numbers with those of copies in the open, of points from 0 to 1 along axes, of which coordinates are multiples
/// of a step.
fn check<G: Moving>(seed: u64, n: usize, step: f64, case: &Case<G>) {
    let context = format!("seed {seed}, {n} points, {step}, {:?}, {:?}", case.basis, case.clip);
    let rng = &mut Rng::new(seed);
    let far = |v: usize| if v % 3 == 1 { [2, -5, 1] } else { [0; 3] };
    let mut here = Vec::new();
    for _ in 0..n {
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| {
            p[axis] = (rng.below(1 << 20) as f64 / f64::from(1 << 20) / step).round() * step
        });
        here.push(p);
    }
    let given: Vec<_> = (0..n).map(|v| translated::<G>(&here[v], &case.basis, far(v))).collect();
    let t = PeriodicTriangulation::<G>::new(&given, &case.basis, Options::default()).unwrap();
    let found = cells(&t, case);
    let total: f64 = found.iter().map(|cell| cell.volume).sum();
    assert!((total - case.measure).abs() < 1e-12 * case.measure.max(1.0), "{context}: {total}");

    // Cells of an open triangulation of the images, with faces of the box that are far away in place of none.
    let (mut places, mut of) = (Vec::new(), Vec::new());
    let range = |j: usize| if j < case.basis.len() { -4..=4 } else { 0..=0 };
    for x in range(0) {
        for y in range(1) {
            for (v, p) in here.iter().enumerate() {
                of.push((v, [x, y, 0]));
                places.push(translated::<G>(p, &case.basis, [x, y, 0]));
            }
        }
    }
    let keys: Vec<u64> = of.iter().map(|&(v, _)| v as u64).collect();
    let open = MovingTriangulation::<G>::with_keys(&places, &keys, Options::default()).unwrap();
    let mut corners = case.clip.unwrap_or_default();
    for (corner, side) in corners.iter_mut().zip([-8.0, 8.0]) {
        for axis in 0..G::D {
            let is_given = case.clip.is_some() && corner[axis].is_finite();
            corner[axis] = if is_given { corner[axis] } else { side };
        }
    }
    let there =
        open.voronoi_cells_within(corners.each_ref(), &case.half_spaces, None, &mut |_| true).unwrap();
    let middle = of.iter().position(|&(v, shift)| (v, shift) == (0, [0; 3])).unwrap();
    for (v, cell) in found.iter().enumerate() {
        let k = middle + v;
        assert!(
            is_close(cell.volume, there.volumes[k], 1.0),
            "{context}: {v}: {cell:?} {}",
            there.volumes[k]
        );
        assert!(is_close(cell.area, there.areas[k], 1.0), "{context}: {v}: {cell:?} {}", there.areas[k]);
        for axis in 0..G::D {
            let (x, y) = (cell.centroid[axis] - given[v][axis], there.centroids[k][axis] - here[v][axis]);
            assert!(cell.volume < 1e-6 || is_close(x, y, 1e3), "{context}: {v}: {x} {y}");
        }
    }
    if t.cell_count() == Ok(0) {
        return;
    }
    let mut of_edges = BTreeMap::new();
    let edges = open.edges().unwrap();
    let mut tell = |k: usize, facet: VoronoiFacet<G::Point>| {
        let [v, w] = edges[k].map(|v| of[v.index()]);
        for (first, second, is_turned) in [(v, w, false), (w, v, true)] {
            let mut facet = facet;
            if is_turned {
                facet.derivatives.swap(0, 1);
            }
            of_edges.insert((first, second), facet);
        }
    };
    open.for_voronoi(Some(corners.each_ref()), &case.half_spaces, None, &mut |_| true, None, Some(&mut tell))
        .unwrap();
    for (([v, w], shift), facet) in t.edges().unwrap().zip(facets(&t, case)) {
        let (v, w) = (v.index(), w.index());
        let shift =
            [0, 1, 2].map(|j| if j < case.basis.len() { shift[j] + far(w)[j] - far(v)[j] } else { 0 });
        let Some(expected) = of_edges.get(&((v, [0; 3]), (w, shift))) else {
            // In a slab copies at the hull have other edges beyond the walls, where both cells have nothing.
            assert!(facet.area < 1e-11, "{context}: {v} {w} {shift:?} {facet:?}");
            continue;
        };
        assert!(is_close(facet.area, expected.area, 1.0), "{context}: {facet:?} {expected:?}");
        for axis in 0..G::D {
            let (x, y) = (facet.centroid[axis] - given[v][axis], expected.centroid[axis] - here[v][axis]);
            assert!(facet.area < 1e-6 || is_close(x, y, 1e4), "{context}: {facet:?} {expected:?}");
            for (found, expected) in facet.derivatives.iter().zip(&expected.derivatives) {
                assert!(is_close(found[axis], expected[axis], 1e4), "{context}: {facet:?}");
            }
        }
    }
}

fn slabs() -> Vec<Case<Space>> {
    let between = |axes: &[usize], low: f64, high: f64| {
        let mut corners = [[-INFINITE; 3], [INFINITE; 3]];
        axes.iter().for_each(|&axis| (corners[0][axis], corners[1][axis]) = (low, high));
        Some(corners)
    };
    // A column with eight walls, and one with four of the same at the same places twice.
    let octagon: Vec<f64> = (0..8)
        .flat_map(|k| {
            let (x, y) = [(1.0, 0.0), (3.0, 3.0), (0.0, 0.5), (-1.0, 1.0)][k % 4];
            let sign = if k < 4 { 1.0 } else { -1.0 };
            let (x, y) = (sign * x, sign * y);
            [x, y, 0.0, 0.5 * (x + y) + 0.75 * f64::hypot(x, y)]
        })
        .collect();
    let of_octagon = 8.0 * (2f64.sqrt() - 1.0) * 0.75 * 0.75;
    let two_planes = [[-1.0, 1.0, 0.0, 0.75], [1.0, -1.0, 0.0, 0.75]];
    vec![
        Case {
            basis: vec![[1.0, 0.0, 0.0], [0.25, 1.0, 0.0]],
            clip: between(&[2], -0.25, 1.25),
            half_spaces: vec![],
            measure: 1.5,
        },
        // Walls inside of what vertices occupy.
        Case {
            basis: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            clip: between(&[2], 0.375, 0.5),
            half_spaces: vec![],
            measure: 0.125,
        },
        Case {
            basis: vec![[1.0, 0.0, 0.0], [0.25, 1.0, 0.0]],
            clip: None,
            half_spaces: vec![0.0, 0.0, 3.0, 3.0, 0.0, 0.0, -0.5, 0.25],
            measure: 1.5,
        },
        Case {
            basis: vec![[0.0, 0.0, 1.0]],
            clip: between(&[0, 1], -0.125, 1.25),
            half_spaces: vec![],
            measure: 1.375 * 1.375,
        },
        Case { basis: vec![[0.0, 0.0, 1.0]], clip: None, half_spaces: octagon.clone(), measure: of_octagon },
        Case {
            basis: vec![[0.0, 0.0, -1.0]],
            clip: between(&[0, 1], -9.0, 9.0),
            half_spaces: [&octagon[..], &octagon[..]].concat(),
            measure: of_octagon,
        },
        // Along no axis: what a vector goes along has walls along it alone.
        Case {
            basis: vec![[1.0, 1.0, 0.0]],
            clip: between(&[2], 0.0, 1.0),
            half_spaces: two_planes.concat(),
            measure: 1.5,
        },
        Case {
            basis: vec![[1.0, 1.0, 0.0], [0.0, 0.0, 1.25]],
            clip: None,
            half_spaces: two_planes.concat(),
            measure: 1.5 * 1.25,
        },
    ]
}

fn strips() -> Vec<Case<Plane>> {
    vec![
        Case {
            basis: vec![[1.0, 0.0]],
            clip: Some([[-INFINITE, 0.0], [INFINITE, 1.0]]),
            half_spaces: vec![],
            measure: 1.0,
        },
        Case {
            basis: vec![[0.0, -1.0]],
            clip: Some([[-1.0, -INFINITE], [0.25, INFINITE]]),
            half_spaces: vec![],
            measure: 1.25,
        },
        Case {
            basis: vec![[1.0, 0.25]],
            clip: None,
            half_spaces: vec![-0.25, 1.0, 1.25, 1.0, -4.0, 1.0],
            measure: 1.5,
        },
    ]
}

#[test]
fn cut_cells_and_facets_are_those_of_copies() {
    for seed in 0..12 {
        let n = [1, 2, 3, 5, 20, 60][seed as usize % 6];
        // Heights of few steps have vertices on lines and planes, all of them on one, and ties.
        for step in [1.0 / f64::from(1 << 20), 0.125, 2.0] {
            strips().iter().for_each(|case| check(seed, n, step, case));
            if seed < 5 {
                slabs().iter().for_each(|case| check(seed, n.min(20), step, case));
            }
        }
    }
}

/// Volumes of a set change by the position of a vertex, together with all of its images, as derivatives say.
#[test]
fn derivatives_are_those_of_differences() {
    let case = &slabs()[4];
    let points = [[0.25, 0.5, 0.125], [0.75, 0.625, 0.5], [0.5, 0.25, 0.75]];
    let with = |points: &[[f64; 3]]| {
        PeriodicTriangulation::<Space>::new(points, &case.basis, Options::default()).unwrap()
    };
    let t = with(&points);
    let mut derivatives = [[[0.0; 3]; 3]; 3];
    for (([v, w], _), facet) in t.edges().unwrap().zip(facets(&t, case)) {
        let (v, w) = (v.index(), w.index());
        for axis in (0..3).filter(|_| v != w) {
            let [of_v, of_w] = facet.derivatives.map(|of| of[axis]);
            derivatives[v][w][axis] += of_v;
            derivatives[w][v][axis] += of_w;
            derivatives[w][w][axis] -= of_v;
            derivatives[v][v][axis] -= of_w;
        }
    }
    let step = 1.0 / f64::from(1 << 14);
    for moved in 0..3 {
        for axis in 0..3 {
            let [before, after] = [-step, step].map(|way| {
                let mut there = points;
                there[moved][axis] += way;
                cells(&with(&there), case)
            });
            for v in 0..3 {
                let quotient = (after[v].volume - before[v].volume) / (2.0 * step);
                let found = derivatives[v][moved][axis];
                assert!((quotient - found).abs() < 1e-3, "{moved} {axis} {v}: {quotient} {found}");
            }
        }
    }
}

/// A mask leaves numbers as they are to the last bit; removed vertices have none.
#[test]
fn masks_change_no_bit() {
    let rng = &mut Rng::new(5);
    let points: Vec<[f64; 3]> = (0..300).map(|_| [0; 3].map(|_| rng.below(1 << 20) as f64 / 1e6)).collect();
    for case in &slabs()[3..5] {
        let mut t = PeriodicTriangulation::<Space>::new(&points, &case.basis, Options::default()).unwrap();
        t.stage_removals(&[VertexId::new(5)]).unwrap();
        t.commit_timestamp().unwrap();
        let (all, at_edges) = (cells(&t, case), facets(&t, case));
        assert!(all[5].volume.is_nan() && all[5].centroid[1].is_nan());
        let clip = case.clip.as_ref().map(|clip| clip.each_ref());
        let mask: Vec<u8> = (0..300).map(|v| u8::from(v % 7 == 5)).collect();
        let mut n_told = 0;
        let tell = &mut |v: VertexId, cell| {
            assert!(mask[v.index()] != 0 && format!("{cell:?}") == format!("{:?}", all[v.index()]));
            n_told += 1;
        };
        t.for_voronoi(clip, &case.half_spaces, Some(&mask), &mut |_| true, Some(tell), None).unwrap();
        assert_eq!(n_told, mask.iter().filter(|&&x| x != 0).count());
        let edges: Vec<_> = t.edges().unwrap().collect();
        let mut n_told = 0;
        let tell = &mut |k: usize, facet| {
            assert_eq!(format!("{facet:?}"), format!("{:?}", at_edges[k]));
            n_told += 1;
        };
        t.for_voronoi(clip, &case.half_spaces, Some(&mask), &mut |_| true, None, Some(tell)).unwrap();
        let is_told = |([v, w], _): &&([VertexId; 2], [i64; 3])| mask[v.index()] + mask[w.index()] != 0;
        assert_eq!(n_told, edges.iter().filter(is_told).count());
    }
}

/// What does not repeat with the set, or is not bounded, is refused, by the last bit; what leaves nothing is not.
#[test]
fn containers_that_do_not_repeat_are_refused() {
    let t = PeriodicTriangulation::<Space>::new(&[[0.0; 3]], &[[1.0, 0.1, 0.0]], Options::default()).unwrap();
    let [x, y] = [0, 1].map(|axis| t.vectors().next().unwrap()[axis]);
    let volumes = |clip: Option<[[f64; 3]; 2]>, rows: &[[f64; 4]]| {
        let clip = clip.as_ref().map(|clip| clip.each_ref());
        volumes_within(&t, clip, rows.as_flattened())
    };
    let high = Some([[-INFINITE, -INFINITE, 0.0], [INFINITE, INFINITE, 1.0]]);
    let walls = [[-y, x, 0.0, 1.0], [y, -x, 0.0, 1.0]];
    let found = volumes(high, &walls).unwrap()[0];
    assert!((found - 2.0).abs() < 1e-12, "{found}");
    let more = f64::from_bits(x.to_bits() + 1);
    match volumes(high, &[walls[0], [y, -more, 0.0, 1.0]]).unwrap_err() {
        Error::InvalidValue { argument: "half_spaces", index: 1, value, .. } => {
            assert!((value.abs() - y * (more - x)).abs() < 1e-25, "{value}");
        }
        other => panic!("{other}"),
    }
    for clip in [None, Some([[-INFINITE; 3], [INFINITE, INFINITE, 1.0]])] {
        let refused = volumes(clip, &walls).unwrap_err();
        assert!(matches!(refused, Error::InvalidValue { argument: "low", index: 2, .. }), "{refused}");
    }
    let refused = volumes(high, &walls[..1]).unwrap_err();
    assert!(matches!(refused, Error::InvalidValue { argument: "low", .. }), "{refused}");
    let refused = volumes(Some([[0.0; 3], [1.0; 3]]), &walls).unwrap_err();
    assert!(
        matches!(refused, Error::InvalidValue { argument: "low", index: 0, value: 0.0, .. }),
        "{refused}"
    );
    let refused = volumes(Some([[-INFINITE, -INFINITE, 1.0], [INFINITE, INFINITE, 1.0]]), &walls);
    assert!(matches!(refused, Err(Error::InvalidValue { argument: "high", index: 2, .. })));
    let refused = volumes(Some([[-INFINITE, -INFINITE, f64::NAN], [INFINITE; 3]]), &walls);
    assert!(matches!(refused, Err(Error::NotFinite { argument: "low", axis: 2, .. })));
    assert_eq!(volumes(high, &[walls[0], [y, -x, 0.0, -2.0]]), Ok(vec![0.0]));
    assert_eq!(volumes(high, &[walls[0], walls[1], [0.0, 0.0, -1.0, -1e60]]), Ok(vec![0.0]));
    assert!(volumes(None, &[]).unwrap()[0].is_infinite());
    assert!(volumes(Some([[-INFINITE; 3], [INFINITE; 3]]), &[]).unwrap()[0].is_infinite());
    // A box that repeats in all directions has nothing that cuts.
    let full =
        PeriodicTriangulation::<Plane>::new(&[[0.0; 2]], &[[1.0, 0.0], [0.5, 1.0]], Options::default());
    let full = full.unwrap();
    let all = Some([&[-INFINITE; 2], &[INFINITE; 2]]);
    assert_eq!(volumes_within(&full, all, &[]), Ok(vec![1.0]));
    let refused = volumes_within(&full, None, &[0.0, 1.0, 3.0]).unwrap_err();
    assert!(matches!(refused, Error::InvalidValue { argument: "half_spaces", index: 0, .. }), "{refused}");
}
