//! Voronoi cells that a program keeps from step to step, by masks of what has changed, and those that several threads
//! compute: a full pass of one thread gives the same bits.

use crate::common::inputs::{KINDS, draw, draw_one};
use crate::common::{Rng, point, seeds};
use deldrift::motion::{MovingTriangulation, Options, VoronoiCells};
use deldrift::{Dimension, Plane, Space, VertexId};

/// The bits of numbers.
fn bits<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> Vec<u64> {
    numbers.into_iter().map(|x| x.to_bits()).collect()
}

/// All numbers of a vertex.
fn numbers<G: Dimension>(cells: &VoronoiCells<G::Point>, v: usize) -> Vec<u64> {
    let mut numbers = vec![cells.volumes[v], cells.areas[v]];
    numbers.extend((0..G::D).map(|axis| cells.centroids[v][axis]));
    bits(&numbers)
}

fn all<G: Dimension>(t: &MovingTriangulation<G>, clip: [&G::Point; 2]) -> VoronoiCells<G::Point> {
    t.voronoi_cells(clip, None, &mut |_| true).expect("room")
}

/// Follows a triangulation by masks; how many entries were computed, and how many there were.
fn follow<G: Dimension>(
    points: &[G::Point],
    draw_goal: impl Fn(&mut Rng) -> G::Point,
    seed: u64,
) -> [usize; 2] {
    let rng = &mut Rng::new(seed);
    let mut t = MovingTriangulation::<G>::new(points, Options::default()).expect("good points");
    let spread = points.iter().map(|p| (0..G::D).map(|axis| p[axis].abs()).fold(0.0, f64::max));
    let spread = 1.0 + spread.fold(0.0, f64::max);
    let (low, high) = (point::<G>(|_| -0.6 * spread), point::<G>(|axis| spread * (0.5 + 0.1 * axis as f64)));
    let clip = [&low, &high];
    t.take_changes().expect("room");
    let mut kept = all(&t, clip);
    let (mut n_computed, mut n_all) = (0, 0);
    for _ in 0..8 {
        let mut moved = Vec::new();
        for _ in 0..rng.below(4) {
            let v = VertexId::at(rng.below(t.id_count()));
            if t.is_present(v) && !moved.contains(&v) {
                let near = t.position(v).expect("present");
                let goal = if rng.one_in(2) {
                    draw_goal(rng)
                } else {
                    point::<G>(|axis| near[axis] + 1e-3 * spread * (rng.unit() - 0.5))
                };
                t.move_vertices(&[v], &[goal]).expect("a good place");
                moved.push(v);
            }
        }
        t.commit_timestamp().expect("room");
        if rng.one_in(3) {
            t.insert_vertex(&draw_goal(rng)).expect("a good place");
        }
        let v = VertexId::at(rng.below(t.id_count()));
        if rng.one_in(3) && t.is_present(v) && t.vertex_count() > 1 {
            t.remove_vertex(v).expect("present");
            moved.retain(|&w| w != v);
        }
        t.take_changes().expect("room");
        let mask = t.voronoi_changed(&moved).expect("room");
        let part = t.voronoi_cells(clip, Some(&mask), &mut |_| true).expect("room");
        kept.volumes.resize(mask.len(), f64::NAN);
        kept.areas.resize(mask.len(), f64::NAN);
        kept.centroids.resize(mask.len(), G::Point::default());
        for v in (0..mask.len()).filter(|&v| mask[v] != 0) {
            kept.volumes[v] = part.volumes[v];
            kept.areas[v] = part.areas[v];
            kept.centroids[v] = part.centroids[v];
        }
        let wanted = all(&t, clip);
        for (v, &is_marked) in mask.iter().enumerate() {
            let (found, wanted) = (numbers::<G>(&kept, v), numbers::<G>(&wanted, v));
            assert_eq!(found, wanted, "{v}, seed {seed}, mask {is_marked}");
            if is_marked == 0 {
                assert!(part.volumes[v].is_nan() && part.areas[v].is_nan());
            }
        }
        n_computed += mask.iter().filter(|&&is_changed| is_changed != 0).count();
        n_all += mask.len();
    }
    [n_computed, n_all]
}

fn follow_all_kinds<G: Dimension>() {
    for seed in seeds(3) {
        for kind in KINDS {
            let rng = &mut Rng::new(seed);
            let points = draw::<G>(kind, 60, rng);
            follow::<G>(&points, |rng| draw_one::<G>(kind, 60, rng), seed);
        }
        let rng = &mut Rng::new(seed + 7);
        let points: Vec<G::Point> = (0..900).map(|_| point::<G>(|_| rng.unit())).collect();
        let [n_computed, n_all] = follow::<G>(&points, |rng| point::<G>(|_| rng.unit()), seed);
        assert!(8 * n_computed < n_all, "{n_computed} of {n_all}");
    }
}

#[test]
fn cells_kept_by_masks_of_changes_are_those_of_a_full_pass() {
    follow_all_kinds::<Plane>();
    follow_all_kinds::<Space>();
}

/// What is not known of single cells is marked: changes that are not taken, vertices in one hyperplane.
#[test]
fn all_cells_are_marked_where_changes_are_not_known() {
    let rng = &mut Rng::new(5);
    let points: Vec<[f64; 2]> = (0..40).map(|_| [rng.unit(), rng.unit()]).collect();
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
    let are_all =
        |t: &MovingTriangulation<Plane>| t.voronoi_changed(&[]).expect("room").iter().all(|&x| x == 1);
    assert!(are_all(&t), "none have been taken");
    t.take_changes().expect("room");
    t.take_changes().expect("room");
    assert_eq!(t.voronoi_changed(&[]).expect("room"), [0; 40]);
    t.insert_vertex(&[0.5, 0.5]).expect("a good place");
    assert!(are_all(&t), "some have not been taken");
    t.take_changes().expect("room");
    assert!(!are_all(&t));
    t.take_changes().expect("room");
    t.compact().expect("room");
    assert!(are_all(&t), "ids are others");
    let line: Vec<[f64; 2]> = (0..9).map(|k| [f64::from(k), 0.0]).collect();
    let mut t = MovingTriangulation::<Plane>::new(&line, Options::default()).expect("good points");
    t.take_changes().expect("room");
    t.take_changes().expect("room");
    assert!(are_all(&t), "there are no cells");
    assert!(t.voronoi_changed(&[VertexId::new(9)]).is_err());
}

fn threads_agree<G: Dimension>(n: usize) {
    let rng = &mut Rng::new(11);
    let points: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let (low, high) = (point::<G>(|_| 0.01), point::<G>(|_| 1.01));
    let mask: Vec<u8> = (0..n).map(|k| u8::from(k % 3 == 0)).collect();
    let made: Vec<_> = [1, 2, 3, 7]
        .map(|threads| {
            let options = Options { threads, ..Options::default() };
            let t = MovingTriangulation::<G>::new(&points, options).expect("good points");
            let cells = all(&t, [&low, &high]);
            let facets = t.voronoi_derivatives([&low, &high], None, &mut |_| true).expect("room");
            let some = t.voronoi_cells([&low, &high], Some(&mask), &mut |_| true).expect("room");
            let some_facets = t.voronoi_derivatives([&low, &high], Some(&mask), &mut |_| true).expect("room");
            for v in (0..n).filter(|&v| mask[v] != 0) {
                assert_eq!(numbers::<G>(&cells, v), numbers::<G>(&some, v), "{v}");
            }
            for (k, edge) in facets.edges.iter().enumerate() {
                if edge.iter().any(|v| mask[v.index()] != 0) {
                    assert_eq!(bits([&facets.areas[k]]), bits([&some_facets.areas[k]]), "{edge:?}");
                } else {
                    assert!(some_facets.areas[k].is_nan());
                }
            }
            let rows = facets.centroids.iter().chain(facets.derivatives.iter().flatten());
            let rows = rows.flat_map(|p| (0..G::D).map(|axis| p[axis].to_bits())).collect::<Vec<_>>();
            let cells: Vec<_> = (0..n).map(|v| numbers::<G>(&cells, v)).collect();
            (cells, bits(&facets.areas), rows)
        })
        .into();
    assert!(made.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn several_threads_give_what_one_does() {
    threads_agree::<Plane>(9_000);
    threads_agree::<Space>(3_000);
}
