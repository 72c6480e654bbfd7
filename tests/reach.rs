//! What a vertex in a box could change, against a pass over all cells and hull facets, in which rationals decide what is
//! near.

use crate::common::inputs::on_unit_sphere;
use crate::common::{Rng, point, seeds, vertex};
use crate::exact_oracle::reach::{ball_meets_box, is_box_beyond};
use deldrift::internals::predicates::exact_calls;
use deldrift::motion::{BoundaryFacet, MovingTriangulation, Options};
use deldrift::{CellId, Dimension, Error, Plane, Space, VertexId};
use std::collections::BTreeSet;

/// The greatest magnitude of a coordinate.
const LIMIT: f64 = 1e57;

type Sides<G> = [<G as deldrift::Shape>::Point; 2];

/// All cells and hull facets with what is needed to decide.
struct All<'t, G: Dimension> {
    t: &'t MovingTriangulation<G>,
    places: Vec<G::Point>,
    spheres: Vec<(G::Point, f64)>,
    hull: Vec<(BoundaryFacet<G::Vertices>, VertexId)>,
}

impl<'t, G: Dimension> All<'t, G> {
    fn new(t: &'t MovingTriangulation<G>) -> Self {
        let places = VertexId::range(0..t.id_count()).map(|v| t.position(v).unwrap_or_default()).collect();
        let corners = t.cells().expect("room").corners;
        let mut hull = Vec::new();
        t.hull_facets(|facet| hull.push((facet, corners[facet.cell][facet.corner]))).expect("room");
        All { t, places, spheres: t.circumspheres().expect("room").collect(), hull }
    }

    fn place(&self, v: VertexId) -> &[f64] {
        self.places[v.index()].as_ref()
    }

    /// In the range of coordinates, `None` if it is empty.
    fn clamped([low, high]: &Sides<G>) -> Option<Sides<G>> {
        let (l, h) = (point::<G>(|k| low[k].max(-LIMIT)), point::<G>(|k| high[k].min(LIMIT)));
        (0..G::D).all(|k| l[k] <= h[k]).then_some([l, h])
    }

    fn is_cell_in_reach(&self, cell: CellId, [low, high]: &Sides<G>, n_exact: &mut usize) -> bool {
        let (centre, squared) = self.spheres[cell.index()];
        let radius = squared.sqrt();
        let mut apart = 0.0f64;
        let mut largest = 0.0f64;
        for k in 0..G::D {
            let off = (low[k] - centre[k]).max(centre[k] - high[k]).max(0.0);
            (apart, largest) = (apart.hypot(off), largest.max(centre[k].abs()));
        }
        // The error of the centre, its rounding, and that of this.
        let margin = 1e-7 * radius + 1e-14 * largest + 1e-14 * apart;
        if (apart - radius).abs() > margin && radius < 1e100 && radius > 1e-100 {
            return apart < radius;
        }
        *n_exact += 1;
        let corners = self.t.cells().expect("room").corners[cell];
        let cell: Vec<&[f64]> = corners.as_ref().iter().map(|&v| self.place(v)).collect();
        ball_meets_box(&cell, low.as_ref(), high.as_ref())
    }

    /// What is in reach of a box, and how many were decided by rationals.
    fn in_reach(&self, within: &Sides<G>) -> (BTreeSet<CellId>, BTreeSet<(CellId, usize)>, usize) {
        let (mut cells, mut hull, mut n_exact) = (BTreeSet::new(), BTreeSet::new(), 0);
        let Some(within) = Self::clamped(within) else { return (cells, hull, 0) };
        let all = CellId::range(0..self.spheres.len());
        cells.extend(all.filter(|&cell| self.is_cell_in_reach(cell, &within, &mut n_exact)));
        for (facet, behind) in &self.hull {
            let places: Vec<&[f64]> = facet.vertices().iter().map(|&v| self.place(v)).collect();
            if is_box_beyond(&places, self.place(*behind), within[0].as_ref(), within[1].as_ref()) {
                hull.insert((facet.cell, facet.corner));
            }
        }
        (cells, hull, n_exact)
    }
}

#[derive(Clone, Copy, Debug)]
enum Set {
    Random,
    Lattice,
    RoundedLattice,
    Sphere,
    Clusters,
    Layers,
}

const SETS: [Set; 6] =
    [Set::Random, Set::Lattice, Set::RoundedLattice, Set::Sphere, Set::Clusters, Set::Layers];

fn draw<G: Dimension>(set: Set, n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let side = (n as f64).powf(1.0 / G::D as f64).ceil() as usize;
    let on_lattice = |v: usize, step: f64| {
        let mut rest = v;
        point::<G>(|_| {
            let x = (rest % side) as f64 * step;
            rest /= side;
            x
        })
    };
    match set {
        Set::Random => (0..n).map(|_| point::<G>(|_| rng.unit())).collect(),
        Set::Lattice => (0..n).map(|v| on_lattice(v, 1.0)).collect(),
        Set::RoundedLattice => (0..n).map(|v| on_lattice(v, 0.1)).collect(),
        Set::Sphere if G::D == 3 => on_unit_sphere(n, rng).iter().map(|p| point::<G>(|k| p[k])).collect(),
        Set::Sphere => (0..n)
            .map(|_| {
                let angle = rng.unit() * std::f64::consts::TAU;
                point::<G>(|k| if k == 0 { angle.cos() } else { angle.sin() })
            })
            .collect(),
        Set::Clusters => {
            let middles: Vec<G::Point> = (0..5).map(|_| point::<G>(|_| rng.unit())).collect();
            (0..n)
                .map(|v| {
                    let size = 10f64.powi(-(rng.below(6) as i32));
                    point::<G>(|k| middles[v % 5][k] + size * (rng.unit() - 0.5))
                })
                .collect()
        }
        Set::Layers => (0..n)
            .map(|_| point::<G>(|k| if k + 1 == G::D { rng.below(4) as f64 } else { 10.0 * rng.unit() }))
            .collect(),
    }
}

/// A number, or one of those next to it.
fn nearby(x: f64, rng: &mut Rng) -> f64 {
    [x, x.next_up(), x.next_down(), x][rng.below(4)]
}

/// From tiny to unbounded, far outside, places, flat ones, with sides at vertices or at balls.
fn draw_box<G: Dimension>(all: &All<G>, kind: usize, rng: &mut Rng) -> Sides<G> {
    let any = |rng: &mut Rng| all.places[rng.below(all.places.len())];
    let (p, q) = (any(rng), any(rng));
    let mut low = p;
    let mut high = p;
    let sizes = [1e-300, 1e-12, 1e-6, 1e-3, 1e-2, 0.05, 0.1, 0.3, 1.0];
    match kind % 10 {
        0 => low = point::<G>(|k| nearby(p[k], rng)),
        1 => (low, high) = (point::<G>(|k| p[k].min(q[k])), point::<G>(|k| p[k].max(q[k]))),
        2 | 3 => {
            let size = sizes[rng.below(sizes.len())];
            let middle = point::<G>(|k| p[k] + (q[k] - p[k]) * rng.unit());
            low = point::<G>(|k| middle[k] - size * rng.unit());
            high = point::<G>(|k| middle[k] + size * rng.unit());
        }
        // At a side of a ball along an axis, open on the other side or thin.
        4 | 5 => {
            let (centre, squared) = all.spheres[rng.below(all.spheres.len())];
            (low, high) = (point::<G>(|_| f64::NEG_INFINITY), point::<G>(|_| f64::INFINITY));
            let axis = rng.below(G::D);
            let radius = squared.sqrt();
            if rng.one_in(2) {
                low[axis] = nearby(centre[axis] + radius, rng);
            } else {
                high[axis] = nearby(centre[axis] - radius, rng);
            }
            if kind % 10 == 5 {
                (0..G::D).filter(|&k| k != axis).for_each(|k| {
                    (low[k], high[k]) = (nearby(centre[k], rng), centre[k].next_up().next_up());
                });
            }
        }
        // Half-spaces, slabs and quadrants with sides at vertices.
        6 | 7 => {
            for k in 0..G::D {
                (low[k], high[k]) = match rng.below(4) {
                    0 => (f64::NEG_INFINITY, nearby(p[k], rng)),
                    1 => (nearby(p[k], rng), f64::INFINITY),
                    2 => (f64::NEG_INFINITY, f64::INFINITY),
                    _ => (p[k].min(q[k]), p[k].max(q[k])),
                };
            }
        }
        // Outside, near and far.
        8 => {
            let far = [0.5, 3.0, 1e3, 1e20, 1e56][rng.below(5)];
            low = point::<G>(|_| far * (rng.unit() - 0.5) * 4.0);
            high = point::<G>(|k| low[k] + [0.0, 0.1, far][rng.below(3)]);
        }
        // Flat, and sometimes empty.
        _ => {
            (low, high) = (point::<G>(|k| p[k].min(q[k])), point::<G>(|k| p[k].max(q[k])));
            let axis = rng.below(G::D);
            low[axis] = if rng.one_in(8) { high[axis].next_up() } else { high[axis] };
        }
    }
    if rng.one_in(40) {
        low = point::<G>(|_| f64::NEG_INFINITY);
        high = point::<G>(|_| f64::INFINITY);
    }
    [low, high]
}

/// What has been compared.
#[derive(Default)]
struct Compared {
    cells: usize,
    reached: usize,
    facets: usize,
    exact: usize,
}

fn check_set<G: Dimension>(set: Set, n: usize, n_boxes: usize, rng: &mut Rng, compared: &mut Compared) {
    let t = MovingTriangulation::<G>::new(&draw::<G>(set, n, rng), Options::default()).expect("good places");
    let all = All::new(&t);
    for kind in 0..n_boxes {
        let within = draw_box(&all, kind, rng);
        let context = || format!("{set:?}, {n}, {within:?}");
        let found = t.cells_in_reach(&within[..1], &within[1..], None).expect("a good box");
        let (cells, hull, n_exact) = all.in_reach(&within);
        assert_eq!(found.cells, cells.iter().copied().collect::<Vec<_>>(), "{}", context());
        assert_eq!(found.hull, hull.iter().copied().collect::<Vec<_>>(), "{}", context());
        compared.cells += all.spheres.len();
        compared.reached += found.cells.len();
        compared.facets += found.hull.len();
        compared.exact += n_exact;
    }
}

fn check_sets<G: Dimension>() {
    let mut compared = Compared::default();
    for seed in seeds(1) {
        for set in SETS {
            let rng = &mut Rng::new(seed);
            for (n, n_boxes) in [(6, 40), (60, 60), (500, 40)] {
                check_set::<G>(set, n, n_boxes, rng, &mut compared);
            }
        }
    }
    let Compared { cells, reached, facets, exact } = compared;
    println!(
        "{}D: {cells} cells compared, {reached} and {facets} hull facets in reach, {exact} by rationals",
        G::D
    );
    assert!(reached > 10_000 && facets > 1_000 && exact > 1_000);
}

/// With `DELDRIFT_SOAK` set, so many times as much.
#[test]
fn a_flood_finds_what_a_pass_over_all_cells_finds() {
    check_sets::<Plane>();
    check_sets::<Space>();
}

/// The vertices of cells and hull facets by definition, with the hidden ones and the mask.
fn check_lists<G: Dimension>(seed: u64) {
    let rng = &mut Rng::new(seed);
    let mut points = draw::<G>(Set::Lattice, 80, rng);
    // Some are hidden, with other ids than what they are behind.
    points.extend_from_within(10..30);
    let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("good places");
    t.remove_vertex(vertex(7)).expect("present");
    let all = All::new(&t);
    for round in 0..30 {
        let mask: Vec<u8> = (0..t.id_count()).map(|_| u8::from(rng.one_in(4)) * 3).collect();
        let mask = (round % 3 > 0).then_some(mask.as_slice());
        let boxes: Vec<Sides<G>> = (0..rng.below(4)).map(|k| draw_box(&all, round + k, rng)).collect();
        let (low, high): (Vec<_>, Vec<_>) = boxes.iter().map(|&[low, high]| (low, high)).unzip();
        let representative = |v: VertexId| t.coincident_representative(v).expect("present");
        let present = || VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v));
        let is_in = |v: VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
        // Whether a corner has a vertex of the mask at its place.
        let has_masked =
            |corners: &[VertexId]| present().any(|v| is_in(v) && corners.contains(&representative(v)));
        let rows = t.cells().expect("room").corners;
        let (mut cells, mut hull) = (BTreeSet::new(), BTreeSet::new());
        let mut lists = Vec::new();
        for within in &boxes {
            let (those, facets, _) = all.in_reach(within);
            let mut corners: BTreeSet<VertexId> = BTreeSet::new();
            corners.extend(those.iter().flat_map(|&cell| rows[cell].as_ref().iter().copied()));
            let facet_corners = |&(cell, corner): &(CellId, usize)| {
                let row = rows[cell];
                (0..=G::D).filter(move |&k| k != corner).map(move |k| row.as_ref()[k]).collect::<Vec<_>>()
            };
            corners.extend(facets.iter().flat_map(facet_corners));
            lists.push(
                present().filter(|&v| is_in(v) && corners.contains(&representative(v))).collect::<Vec<_>>(),
            );
            cells.extend(those.into_iter().filter(|&cell| has_masked(rows[cell].as_ref())));
            hull.extend(facets.into_iter().filter(|facet| has_masked(&facet_corners(facet))));
        }
        let found = t.cells_in_reach(&low, &high, mask).expect("good boxes");
        assert_eq!(found.cells, cells.into_iter().collect::<Vec<_>>(), "{boxes:?}");
        assert_eq!(found.hull, hull.into_iter().collect::<Vec<_>>(), "{boxes:?}");
        let found = t.vertices_in_reach(&low, &high, mask).expect("good boxes");
        assert_eq!(found.offsets.len(), boxes.len() + 1);
        for (k, list) in lists.iter().enumerate() {
            assert_eq!(found.vertices[found.offsets[k]..found.offsets[k + 1]], list[..], "{boxes:?}");
        }
    }
}

#[test]
fn vertices_in_reach_are_those_of_cells_in_reach() {
    for seed in seeds(2) {
        check_lists::<Plane>(seed);
        check_lists::<Space>(seed);
    }
}

/// What an insertion does remove, with any id, was in reach of its place.
fn check_insertions<G: Dimension>(set: Set, rng: &mut Rng) {
    let t =
        MovingTriangulation::<G>::new(&draw::<G>(set, 100, rng), Options::default()).expect("good places");
    let all = All::new(&t);
    for kind in 0..30 {
        let [low, high] = draw_box(&all, kind, rng);
        let within = [low, high];
        let Some([least, most]) = All::<G>::clamped(&within) else { continue };
        let found = t.cells_in_reach(&[low], &[high], None).expect("a good box").cells;
        for _ in 0..4 {
            let q = point::<G>(|k| match rng.below(4) {
                0 => least[k],
                1 => most[k],
                _ => (least[k] + (most[k] - least[k]) * rng.unit()).clamp(least[k], most[k]),
            });
            let mut changed = t.try_clone(None).expect("room");
            changed.take_changes().expect("room");
            let before: Vec<G::Vertices> = t.cells().expect("room").corners.to_vec();
            changed.insert_vertex(&q).expect("a good place");
            let after: BTreeSet<Vec<VertexId>> = changed
                .cells()
                .expect("room")
                .corners
                .iter()
                .map(|c| crate::common::sorted(c.as_ref()))
                .collect();
            for (cell, row) in CellId::range(0..before.len()).zip(&before) {
                let is_gone = !after.contains(&crate::common::sorted(row.as_ref()));
                assert!(!is_gone || found.binary_search(&cell).is_ok(), "{set:?} {within:?} {q:?} {row:?}");
            }
        }
    }
}

#[test]
fn insertions_remove_what_was_in_reach() {
    for seed in seeds(1) {
        for set in SETS {
            check_insertions::<Plane>(set, &mut Rng::new(seed));
            check_insertions::<Space>(set, &mut Rng::new(seed));
        }
    }
}

/// Among constrained cells: all that an insertion would remove, and none whose disc does not meet the box.
#[test]
fn constrained_cells_that_insertions_remove_are_in_reach() {
    for seed in seeds(3) {
        let rng = &mut Rng::new(seed);
        let points = draw::<Plane>(if seed % 2 == 0 { Set::Random } else { Set::Lattice }, 100, rng);
        let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good places");
        let mut n = 0;
        for _ in 0..200 {
            let ends = [rng.below(100), rng.below(100)].map(VertexId::at);
            let segment = deldrift::motion::Segment { ends, marker: 0, ..Default::default() };
            if ends[0] != ends[1] && t.stage_segments([segment].into_iter()).is_ok() {
                if t.commit_timestamp().is_ok() { n += 1 } else { _ = t.discard_moves() }
            }
        }
        assert!(n > 10);
        let all = All::new(&t);
        for kind in 0..200 {
            let [low, high] = draw_box(&all, kind, rng);
            let Some([least, most]) = All::<Plane>::clamped(&[low, high]) else { continue };
            let found = t.cells_in_reach(&[low], &[high], None).expect("a good box").cells;
            let (cells, _, _) = all.in_reach(&[low, high]);
            assert!(found.iter().all(|cell| cells.contains(cell)));
            for _ in 0..10 {
                let q = point::<Plane>(|k| least[k] + (most[k] - least[k]) * rng.unit())
                    .map(|x| x.clamp(-LIMIT, LIMIT));
                let q = point::<Plane>(|k| q[k].clamp(least[k], most[k]));
                let gone = t.conflicts(&q, None).expect("a good place");
                assert!(gone.iter().all(|cell| found.binary_search(cell).is_ok()), "{low:?} {high:?} {q:?}");
            }
        }
    }
}

#[test]
fn without_cells_all_vertices_are_in_reach() {
    let line: Vec<[f64; 3]> = (0..5).map(|k| [k as f64; 3]).collect();
    for n in 0..5 {
        let t = MovingTriangulation::<Space>::new(&line[..n], Options::default()).expect("good places");
        let (low, high) = ([[9.0; 3], [1.0; 3]], [[10.0; 3], [0.0; 3]]);
        assert_eq!(t.cells_in_reach(&low, &high, None), Ok(Default::default()));
        let mask: Vec<u8> = (0..n).map(|v| (v % 2) as u8).collect();
        let found = t.vertices_in_reach(&low, &high, Some(&mask)).expect("good boxes");
        assert_eq!(found.vertices, (0..n).filter(|v| v % 2 == 1).map(VertexId::at).collect::<Vec<_>>());
        assert_eq!(found.offsets, [0, n / 2, n / 2]);
    }
}

#[test]
fn bad_boxes_and_masks_are_refused() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good places");
    let (good, bad) = ([[0.0; 2]; 2], [[0.0; 2], [1.0, f64::NAN]]);
    for (low, high, name) in [(&bad, &good, "low"), (&good, &bad, "high")] {
        for error in [t.cells_in_reach(low, high, None).err(), t.vertices_in_reach(low, high, None).err()] {
            assert!(
                matches!(error, Some(Error::InvalidValue { argument, index: 3, .. }) if argument == name)
            );
        }
    }
    let error = t.cells_in_reach(&good, &good[..1], None).err();
    assert!(matches!(error, Some(Error::WrongCount { given: 1, wanted: 2, .. })));
    let error = t.vertices_in_reach(&good, &good, Some(&[1; 4])).err();
    assert!(matches!(error, Some(Error::WrongCount { argument: "mask_count", given: 4, wanted: 3, .. })));
}

/// Points on the diagonal of a box, but for the last bit, and their images nearby: nearly all cells are flat. What takes
/// integers of any length is done once for a cell, however many boxes are asked about, and not for each box.
#[test]
fn flat_cells_take_long_integers_once_for_many_boxes() {
    let sides = [1.0, 1.1, 1.3];
    let at = |k: usize, shift: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|axis| sides[axis] * ((k as f64 + 0.5) / 20.0 + shift[axis]))
    };
    let shifts = |most: i32| {
        let steps = move || (-most..=most).map(f64::from);
        steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| [x, y, z])))
    };
    let images = |most: i32| shifts(most).flat_map(|shift| (0..20).map(move |k| at(k, shift)));
    let t = MovingTriangulation::<Space>::new(&images(1).collect::<Vec<_>>(), Options::default());
    let t = t.expect("good places");
    let places: Vec<[f64; 3]> = images(2).collect();
    let calls = |places: &[[f64; 3]]| {
        let before = exact_calls();
        let found = t.vertices_in_reach(places, places, None).expect("good boxes");
        assert!(!found.vertices.is_empty());
        (exact_calls() - before) as usize
    };
    let (few, all, n_cells) = (calls(&places[..20]), calls(&places), t.cell_count());
    println!("{n_cells} cells; {few} calls for 20 boxes, {all} for {}", places.len());
    // A centre for each cell, and for each box a few signs of hull facets and near ties, and to locate it.
    assert!(all < n_cells + 12 * places.len());
}
