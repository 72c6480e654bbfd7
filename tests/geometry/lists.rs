//! Lists of what is near each vertex, against all pairs of vertices in exact integers, and against balls one by one.

use super::near::{is_at_most, present, square};
use super::*;
use deldrift::motion::ListsOf;

/// By id the list of each vertex, by the definition: full lists by the radius of each, and half lists of the pairs in these.
fn by_definition(
    vertices: &[(VertexId, Grid)],
    id_count: usize,
    squared_radius: impl Fn(VertexId) -> Option<f64>,
    is_half: bool,
) -> Vec<Vec<VertexId>> {
    let mut lists = vec![Vec::new(); id_count];
    for (v, p) in vertices {
        for (w, q) in vertices.iter().filter(|(w, _)| w != v) {
            let is_near =
                |from| squared_radius(from).is_some_and(|squared| is_at_most(square(p, q), squared));
            let is_in = if !is_half {
                is_near(*v)
            } else if squared_radius(*v).is_some() && squared_radius(*w).is_some() {
                v < w && (is_near(*v) || is_near(*w))
            } else {
                is_near(*v)
            };
            if is_in {
                lists[v.index()].push(*w);
            }
        }
        lists[v.index()].sort();
    }
    lists
}

/// Squares of radii that are those of distances between vertices, or one last place beside, and others.
fn a_radius(vertices: &[(VertexId, Grid)], rng: &mut Rng) -> f64 {
    let Some((_, p)) = vertices.get(rng.below(vertices.len().max(1))) else { return rng.unit() };
    let (_, q) = &vertices[rng.below(vertices.len())];
    let near = square(p, q) as f64 * QUANTUM * QUANTUM;
    let bits = f64::from_bits(1);
    let all = [near, near.next_up(), near.next_down().max(0.0), 0.0, bits, 1e4 * rng.unit(), f64::INFINITY];
    let n_kinds = if rng.one_in(4) { 7 } else { 3 };
    all[rng.below(n_kinds)]
}

fn check_lists<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let (vertices, n_ids) = (present(t), t.id_count());
    for _ in 0..4 {
        let n_radii = if rng.one_in(2) { 1 } else { n_ids };
        let radii: Vec<f64> = (0..n_radii).map(|_| a_radius(&vertices, rng)).collect();
        let one_in = 1 + rng.below(3);
        let mask: Vec<u8> = (0..n_ids).map(|_| u8::from(rng.one_in(one_in)) * 3).collect();
        for mask in [None, Some(&mask[..])] {
            let of = |v: VertexId| radii[if radii.len() == 1 { 0 } else { v.index() }];
            let listed = |v: VertexId| mask.is_none_or(|mask| mask[v.index()] != 0).then(|| of(v));
            for is_half in [false, true] {
                let wanted = ListsOf { squared_radii: &radii, mask, is_half };
                let found = t.neighbour_lists(&wanted).expect("good radii");
                let expected = by_definition(&vertices, n_ids, listed, is_half);
                assert_eq!(found.offsets.len(), n_ids + 1);
                for (v, expected) in VertexId::range(0..n_ids).zip(&expected) {
                    let list = &found.neighbours[found.offsets[v.index()]..found.offsets[v.index() + 1]];
                    assert_eq!(list, expected, "of {v:?} within {:e}, half {is_half}", of(v));
                }
                assert_eq!(found.neighbours.len(), expected.iter().map(Vec::len).sum::<usize>());
                assert!(found.offsets[0] == 0 && found.shifts.is_empty());
            }
            for &(v, _) in vertices.iter().take(5).filter(|(v, _)| listed(*v).is_some()) {
                let place = t.position(v).expect("present");
                let mut ball = t.vertices_in_ball(&place, of(v)).expect("a good ball");
                ball.retain(|&w| w != v);
                let full = ListsOf { squared_radii: &radii, mask, is_half: false };
                let found = t.neighbour_lists(&full).expect("good radii");
                assert_eq!(ball, found.neighbours[found.offsets[v.index()]..found.offsets[v.index() + 1]]);
            }
        }
    }
}

#[test]
fn neighbour_lists_are_those_of_all_pairs() {
    on_all_kinds::<Plane>(check_lists);
    on_all_kinds::<Space>(check_lists);
}

/// Places on a line, in a plane, in one place, and in clusters that are a thousandth of a millionth of their distance.
fn uneven<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<Vec<G::Point>> {
    let line = |k: usize| point::<G>(|axis| (k * (axis + 1)) as f64 / 64.0);
    let plane = |k: usize| point::<G>(|axis| if axis == 2 { 0.5 } else { (k >> (5 * axis) & 31) as f64 });
    let mut sets: Vec<Vec<G::Point>> = vec![(0..n).map(line).collect(), (0..n).map(plane).collect()];
    sets.push(vec![point::<G>(|_| 0.25); n / 4]);
    let mut clusters = Vec::new();
    for k in 0..n {
        let middle = (k % 7) as f64;
        let size = 2f64.powi(-30);
        clusters.push(point::<G>(|_| middle + size * (rng.below(64) as f64)));
    }
    sets.push(clusters);
    sets
}

fn check_uneven<G: Dimension>() {
    let rng = &mut Rng::new(12);
    for points in uneven::<G>(300, rng) {
        let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good points");
        for squared in [0.0, 2f64.powi(-60), 49.0 * 2f64.powi(-60), 2f64.powi(-12), 1.0, 3.0, 1e9] {
            let wanted = ListsOf { squared_radii: &[squared], mask: None, is_half: false };
            let found = t.neighbour_lists(&wanted).expect("a good radius");
            for (v, p) in points.iter().enumerate() {
                let mut ball = t.vertices_in_ball(p, squared).expect("a good ball");
                ball.retain(|w| w.index() != v);
                assert_eq!(ball, found.neighbours[found.offsets[v]..found.offsets[v + 1]], "{squared:e}");
            }
        }
    }
}

#[test]
fn neighbour_lists_of_uneven_sets_are_balls() {
    check_uneven::<Plane>();
    check_uneven::<Space>();
}

/// Squares that underflow.
#[test]
fn neighbour_lists_of_the_least_radii_are_exact() {
    let least = f64::from_bits(1);
    let points = [[0.0, 0.0], [least, 0.0], [0.0, 1e-170], [1e57, 1.0]];
    let t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
    let of_first = |squared| {
        let wanted = ListsOf { squared_radii: &[squared], mask: None, is_half: false };
        t.neighbour_lists(&wanted).expect("a good radius").offsets[1]
    };
    assert_eq!([0.0, least, 1e-320, 1e114, f64::INFINITY].map(of_first), [0, 2, 2, 2, 3]);
}

#[test]
fn neighbour_lists_do_not_depend_on_threads_or_history() {
    let rng = &mut Rng::new(5);
    let points: Vec<[f64; 3]> = (0..3000).map(|_| draw_one::<Space>(Kind::Random, 3000, rng)).collect();
    let wanted = ListsOf { squared_radii: &[4e6], mask: None, is_half: false };
    let lists = |threads, is_moved: bool| {
        let options = Options { threads, ..Options::default() };
        let mut t = MovingTriangulation::<Space>::new(&points, options).expect("good points");
        if is_moved {
            let away: Vec<[f64; 3]> = points.iter().rev().copied().collect();
            t.commit_positions(&away).expect("good points");
            t.commit_positions(&points).expect("good points");
        }
        t.neighbour_lists(&wanted).expect("a good radius")
    };
    let one = lists(1, false);
    assert!(one.neighbours.len() > 3000);
    assert_eq!(one, lists(3, false));
    assert_eq!(one, lists(2, true));
}

#[test]
fn bad_radii_and_masks_of_lists_are_refused() {
    let t = MovingTriangulation::<Plane>::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]], Options::default());
    let t = t.expect("good points");
    let asked = |squared_radii: &[f64], mask| {
        t.neighbour_lists(&ListsOf { squared_radii, mask, is_half: false })
            .map(|found| found.neighbours.len())
    };
    for bad in [-1.0, f64::NAN, -f64::from_bits(1)] {
        let refused = Err(0);
        let index_of = |asked: Result<usize, Error>| match asked {
            Err(Error::InvalidValue { argument: "squared_radii", index, .. }) => Ok::<_, i32>(index),
            _ => Err(0),
        };
        assert_eq!(index_of(asked(&[bad], None)), Ok(0));
        assert_eq!(index_of(asked(&[bad], Some(&[0, 0, 0]))), Ok(0));
        assert_eq!(index_of(asked(&[1.0, bad, bad], None)), Ok(1));
        assert_eq!(index_of(asked(&[1.0, bad, bad], Some(&[1, 0, 1]))), Ok(2));
        assert_eq!(index_of(asked(&[1.0, bad, bad], Some(&[1, 0, 0]))), refused);
        assert_eq!(asked(&[1.0, bad, bad], Some(&[1, 0, 0])), Ok(1));
    }
    assert!(matches!(asked(&[1.0; 2], None), Err(Error::WrongCount { given: 2, wanted: 3, .. })));
    assert!(matches!(asked(&[], None), Err(Error::WrongCount { given: 0, wanted: 3, .. })));
    assert!(matches!(asked(&[1.0], Some(&[1; 2])), Err(Error::WrongCount { given: 2, wanted: 3, .. })));
    let none = MovingTriangulation::<Plane>::new(&[], Options::default()).expect("no points");
    let lists = none.neighbour_lists(&ListsOf { squared_radii: &[], mask: None, is_half: true });
    assert_eq!(lists.expect("nothing is asked").offsets, [0]);
}
