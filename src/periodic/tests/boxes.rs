//! Vertices in boxes beside all translations of them, and marks of Voronoi cells that change.

use super::*;
use crate::motion::VoronoiCell;

/// The vertices of which a translation by multiples up to some number is in a box: coordinates are few digits long, so that sums are exact.
fn among_translations<G: Moving>(
    points: &[G::Point],
    basis: &[G::Point],
    [low, high]: [&G::Point; 2],
    most: i64,
) -> Vec<VertexId> {
    let range = |j: usize| if j < basis.len() { -most..=most } else { 0..=0 };
    let is_in = |p: &G::Point| {
        range(0).any(|x| {
            range(1).any(|y| {
                range(2).any(|z| {
                    (0..G::D).all(|axis| {
                        let along = basis.iter().zip([x, y, z]).map(|(v, n)| n as f64 * v[axis]).sum::<f64>();
                        low[axis] <= p[axis] + along && p[axis] + along <= high[axis]
                    })
                })
            })
        })
    };
    VertexId::range(0..points.len()).filter(|&v| is_in(&points[v])).collect()
}

fn check<G: Moving>(seed: u64, basis: &[G::Point], most: i64) {
    let rng = &mut Rng::new(seed);
    let mut coordinate =
        |least: f64, extent: f64| least + extent * rng.below(1 << 6) as f64 / f64::from(1 << 6);
    let points: Vec<G::Point> = (0..12)
        .map(|_| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = coordinate(0.0, 1.0));
            p
        })
        .collect();
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    for round in 0..24 {
        let (mut low, mut high) = (G::Point::default(), G::Point::default());
        for axis in 0..G::D {
            low[axis] = coordinate(-1.5, 3.0);
            high[axis] = low[axis] + coordinate(-0.015625, [0.125, 0.5, 1.5][round % 3]);
        }
        let found = t.vertices_in_box(&low, &high).unwrap();
        let expected = among_translations::<G>(&points, basis, [&low, &high], most);
        assert_eq!(found, expected, "{seed} {basis:?} {low:?} {high:?}");
    }
}

#[test]
fn vertices_in_boxes_are_those_of_all_translations() {
    for seed in 0..20 {
        check::<Plane>(seed, &[[1.0, 0.0], [0.0, 1.0]], 6);
        check::<Plane>(seed, &[[1.0, 0.25], [0.375, 1.0]], 6);
        check::<Plane>(seed, &[[1.0, 0.25]], 6);
        check::<Plane>(seed, &[[0.0, -0.5]], 8);
        check::<Plane>(seed, &[[1.0, 0.0], [7.25, 0.5]], 40);
        check::<Space>(seed, &[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 0.75]], 4);
        check::<Space>(seed, &[[0.5, 0.0, 0.5], [0.0, 0.5, 0.5], [0.5, 0.5, 0.0]], 7);
        check::<Space>(seed, &[[1.0, 0.0, 0.5], [0.25, 1.0, 0.0]], 5);
    }
}

/// Boxes without end, and those that are longer than all translations that could be tried.
#[test]
fn boxes_may_be_longer_than_periods() {
    let infinite = f64::INFINITY;
    let points = [[0.125, 0.5], [0.5, 0.25], [0.75, 0.6875]];
    let with =
        |basis: &[[f64; 2]]| PeriodicTriangulation::<Plane>::new(&points, basis, Options::default()).unwrap();
    let ids = |list: &[u32]| list.iter().map(|&v| VertexId::new(v)).collect::<Vec<_>>();
    let t = with(&[[1.0, 0.0], [0.0, 1.0]]);
    let among = |low, high| t.vertices_in_box(&low, &high).unwrap();
    assert_eq!(among([-infinite; 2], [infinite; 2]), ids(&[0, 1, 2]));
    assert_eq!(among([-infinite, 7.25], [infinite, 7.5]), ids(&[0, 1]));
    assert_eq!(among([1e18, -0.5], [1e18 + 256.0, -0.375]), ids(&[0]));
    assert_eq!(among([0.5, -1e30], [0.6, 1e30]), ids(&[1]));
    assert_eq!(among([3.0, 0.0], [2.0, infinite]), ids(&[]));
    // Heights of translations are multiples of 1/8 apart in a skewed lattice.
    let skewed = with(&[[1.0, 0.375], [0.0, 1.0]]);
    let strip = |low: f64, high: f64| skewed.vertices_in_box(&[-infinite, low], &[infinite, high]).unwrap();
    assert_eq!(strip(0.01, 0.1), ids(&[2]));
    assert_eq!(strip(0.125, 0.125), ids(&[0, 1]));
    assert_eq!(strip(0.01, 0.02), ids(&[]));
    let all = skewed.vertices_in_box(&[0.0, 5.0], &[1e12, 6.375]).unwrap();
    assert_eq!(all, ids(&[0, 1, 2]));
    match skewed.vertices_in_box(&[0.0, 0.0], &[1e12, 0.5]) {
        Err(Error::InvalidValue { argument: "high", .. }) => {}
        other => panic!("{other:?}"),
    }
    match skewed.vertices_in_box(&[0.0, f64::NAN], &[1e12, 0.5]) {
        Err(Error::InvalidValue { argument: "low", index: 1, .. }) => {}
        other => panic!("{other:?}"),
    }
    // Far away, where the middle of the box is rounded, and out of the range of positions.
    let far = f64::from(1 << 30) * f64::from(1 << 18);
    assert_eq!(among([far + 0.125, far + 0.5], [far + 0.125, far + 0.5]), ids(&[0]));
    assert_eq!(among([far + 0.5, 0.25], [far + 0.625, 0.25]), ids(&[1]));
    match t.vertices_in_box(&[1e60, 0.0], &[1e61, 1.0]) {
        Err(Error::InvalidValue { argument: "low", index: 0, .. }) => {}
        other => panic!("{other:?}"),
    }
    let at_zero =
        PeriodicTriangulation::<Plane>::new(&[[0.0; 2]], &[[1.0, 0.0], [0.0, 1.0]], Options::default());
    assert_eq!(at_zero.unwrap().vertices_in_box(&[infinite; 2], &[infinite; 2]), Ok(ids(&[])));
    let strip = with(&[[1.0, 0.0]]);
    assert_eq!(strip.vertices_in_box(&[0.0, 1e40], &[0.25, 1e40]), Ok(ids(&[])));
    assert_eq!(strip.vertices_in_box(&[-infinite, 0.25], &[infinite, 0.5]), Ok(ids(&[0, 1])));
    assert_eq!(strip.vertices_in_box(&[9.5, 0.0], &[9.75, 0.625]), Ok(ids(&[1])));
}

/// Cells that are not marked are what they were.
#[test]
fn cells_that_change_are_marked() {
    let rng = &mut Rng::new(7);
    let basis = [[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let n = 400;
    let place = |rng: &mut Rng| [0; 3].map(|_| rng.below(1 << 20) as f64 / f64::from(1 << 20));
    let points: Vec<[f64; 3]> = (0..n).map(|_| place(rng)).collect();
    let mut t = PeriodicTriangulation::<Space>::new(&points, &basis, Options::default()).unwrap();
    let cells = |t: &PeriodicTriangulation<Space>| {
        let mut cells: Vec<Option<VoronoiCell<[f64; 3]>>> = vec![None; t.id_count()];
        t.for_voronoi_cells(None, &mut |_| true, &mut |v, cell| cells[v.index()] = Some(cell)).unwrap();
        cells
    };
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 1), "nothing has been taken");
    t.take_changes().unwrap();
    let mut before = cells(&t);
    for step in 0..12 {
        let moved: Vec<VertexId> = (0..4).map(|k| VertexId::at((31 * step + 97 * k) % n)).collect();
        let goals: Vec<[f64; 3]> = moved
            .iter()
            .map(|&v| {
                let from = t.position(v).unwrap();
                // Some go to another period, one to anywhere.
                [0, 1, 2].map(|axis| from[axis] + f64::from(u8::from(step % 3 == 1)) * basis[1][axis] + 0.01)
            })
            .collect();
        t.move_vertices(&moved, &goals).unwrap();
        if step == 5 {
            t.stage_removals(&[VertexId::new(390)]).unwrap();
        }
        if step == 9 {
            t.stage_vectors(&[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 1.0625]]).unwrap();
        }
        t.commit_timestamp().unwrap();
        assert!(t.voronoi_changed(&moved).unwrap().iter().all(|&mark| mark == 1), "not taken yet");
        t.take_changes().unwrap();
        let (mask, after) = (t.voronoi_changed(&moved).unwrap(), cells(&t));
        let n_marked = mask.iter().filter(|&&mark| mark == 1).count();
        assert!(moved.iter().all(|v| mask[v.index()] == 1) && (step < 5 || mask[390] == 1));
        assert_eq!(n_marked == n, step == 9, "step {step}: {n_marked}");
        for v in (0..n).filter(|&v| mask[v] == 0) {
            let (was, is) = (before[v].unwrap(), after[v].unwrap());
            assert!(
                (was.volume - is.volume).abs() < 1e-14 && (was.area - is.area).abs() < 1e-12,
                "{step}: {v}"
            );
            assert!((0..3).all(|axis| (was.centroid[axis] - is.centroid[axis]).abs() < 1e-12), "{step}: {v}");
        }
        before = after;
    }
    t.compact().unwrap();
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 1), "ids are others");
    t.take_changes().unwrap();
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 0), "nothing has happened");
    t.stage_removals(&[VertexId::new(17)]).unwrap();
    t.prepare_timestamp().unwrap();
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 1), "a timestamp is prepared");
    t.withdraw_timestamp();
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 0), "nothing has happened");
    t.remove_vertex(VertexId::new(398)).unwrap();
    assert!(t.voronoi_changed(&[]).unwrap().iter().all(|&mark| mark == 1), "one has been removed at once");
    let refused = t.voronoi_changed(&[VertexId::new(399)]);
    assert!(matches!(refused, Err(Error::NoSuchVertex { index: 0, .. })), "{refused:?}");
}
