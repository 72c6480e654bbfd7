//! What exact rational numbers say of means in boxes: each cell of now has all of its content from translations of
//! those that were. Coordinates are on a grid on which nothing is rounded.

use super::exact::{Ratio, common, place, volume};
use crate::common::{Rng, point, seeds, vertex};
use deldrift::motion::{Options, TransferOrder};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{Dimension, Plane, Space, VertexId};

/// The inverse of the unit of coordinates.
const GRID: f64 = 4096.0;

/// Through how many periods cells of before are looked for on each side.
const PERIODS: i64 = 4;

type Corners = Vec<Vec<Ratio>>;

/// A cell by its corners and by which multiples of the vectors each is translated.
type Named = Vec<(VertexId, [i64; 3])>;

/// What all histories have met.
#[derive(Debug, Default)]
struct Counts {
    cells: usize,
    turned_over: usize,
    /// Cells with more than one translation of one that was.
    wrapped: usize,
}

fn on_grid<G: Dimension>(p: &G::Point) -> G::Point {
    point::<G>(|k| (p[k] * GRID).round() / GRID)
}

fn cells_of<G: Dimension>(t: &PeriodicTriangulation<G>) -> Vec<Named> {
    let mut shifts = t.cell_shifts().expect("room");
    let rows = t.cells().expect("room").corners;
    rows.iter()
        .map(|row| row.as_ref().iter().map(|&v| (v, shifts.next().expect("one each"))).collect())
        .collect()
}

/// Where a vertex is that is translated; exactly, as all is on the grid.
fn translated<G: Dimension>(p: &G::Point, shift: [i64; 3], vectors: &[G::Point]) -> G::Point {
    point::<G>(|k| p[k] + vectors.iter().zip(shift).map(|(vector, n)| n as f64 * vector[k]).sum::<f64>())
}

/// The extents of some places.
fn extents<G: Dimension>(places: &[G::Point]) -> Vec<[f64; 2]> {
    let along = |k: usize| {
        let all = || places.iter().map(|p| p[k]);
        [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)]
    };
    (0..G::D).map(along).collect()
}

fn history<G: Dimension>(seed: u64, n: usize, counts: &mut Counts) {
    let mut rng = Rng::new(seed);
    let skew = f64::from(u8::from(rng.one_in(2))) * 0.375;
    let way = *rng.pick(&[0.1, 0.5, 1.0]);
    let vectors = |strain: f64| -> Vec<G::Point> {
        let entry = |j: usize, k: usize| {
            if j == k { 1.0 + (strain * GRID).round() / GRID } else { f64::from(u8::from(j > k)) * skew }
        };
        (0..G::D).map(|j| point::<G>(|k| entry(j, k))).collect()
    };
    let mut basis = vectors(0.0);
    let mut places: Vec<G::Point> = (0..n).map(|_| on_grid::<G>(&point::<G>(|_| rng.unit()))).collect();
    let mut t = PeriodicTriangulation::<G>::new(&places, &basis, Options::default()).expect("a box");
    t.take_changes().expect("room");
    for step in 0..2 {
        let (before, n_before) = (cells_of(&t), places.len());
        let given: Vec<f64> = before.iter().map(|_| rng.unit() - 0.3).collect();
        for v in VertexId::range(0..places.len()) {
            if t.is_present(v) && !rng.one_in(3) {
                let place = &mut places[v.index()];
                *place = on_grid::<G>(&point::<G>(|k| place[k] + way * (rng.unit() - 0.5)));
                t.move_vertices(&[v], &[*place]).expect("a move");
            }
        }
        if rng.one_in(3) {
            basis = vectors(0.2 * rng.unit());
            t.stage_vectors(&basis).expect("vectors");
        }
        t.commit_timestamp().expect("a commit");
        let v = vertex(rng.below(places.len()) as u32);
        if rng.one_in(2) && t.is_present(v) && t.vertex_count() > 1 {
            t.remove_vertex(v).expect("a removal");
        } else {
            places.push(on_grid::<G>(&point::<G>(|_| 2.0 * rng.unit() - 0.5)));
            t.insert_vertex(&places[places.len() - 1]).expect("an insertion");
        }
        t.take_changes().expect("room");
        let mut values = given.clone();
        let report = t
            .transfer_cells(Some(&places[..n_before]), TransferOrder::First, 1, &mut values, &mut |_| true)
            .expect("a transfer");
        counts.turned_over += report.turned_over;
        let name = format!("{}D, seed {seed}, step {step}, skew {skew}, way {way}", G::D);
        let at = |cell: &Named| -> Vec<G::Point> {
            cell.iter().map(|&(v, shift)| translated::<G>(&places[v.index()], shift, &basis)).collect()
        };
        let exact = |corners: &[G::Point]| -> Corners { corners.iter().map(|p| place(p.as_ref())).collect() };
        let old: Vec<_> = before.iter().map(at).collect();
        let range = |j: usize| if j < G::D { -PERIODS..=PERIODS } else { 0..=0 };
        for (index, cell) in cells_of(&t).iter().enumerate() {
            let own = at(cell);
            let (corners, extent) = (exact(&own), extents::<G>(&own));
            let whole = volume(&corners);
            let (mut content, mut cover) = (Ratio::of(0.0), Ratio::of(0.0));
            for (other, &value) in old.iter().zip(&given) {
                let (there, mut n_met) = (extents::<G>(other), 0);
                for shift in range(0).flat_map(|x| range(1).map(move |y| [x, y, 0])) {
                    for shift in range(2).map(|z| [shift[0], shift[1], z]) {
                        let by = translated::<G>(&G::Point::default(), shift, &basis);
                        let is_apart = (0..G::D).any(|k| {
                            extent[k][1] <= there[k][0] + by[k] || there[k][1] + by[k] <= extent[k][0]
                        });
                        if is_apart {
                            continue;
                        }
                        let copy: Vec<_> = other.iter().map(|p| translated::<G>(p, shift, &basis)).collect();
                        let part = common(&corners, &exact(&copy));
                        n_met += usize::from(part.sign() != 0);
                        cover = &cover + &part;
                        content = &content + &(&part * &Ratio::of(value));
                    }
                }
                counts.wrapped += usize::from(n_met > 1);
            }
            assert_eq!((&cover - &whole).sign(), 0, "{name}: cell {index} is covered otherwise: {report:?}");
            let unit = if G::D == 2 { 2.0 } else { 6.0 };
            let (is, should) = (values[index] * whole.value() / unit, content.value() / unit);
            let room = 3.0 * report.volume_error + 1e-15;
            assert!((is - should).abs() <= room, "{name}: cell {index} has {is}, not {should}: {report:?}");
            counts.cells += 1;
        }
    }
}

#[test]
fn exact_rational_numbers_say_the_same_in_boxes_of_the_plane() {
    let mut counts = Counts::default();
    seeds(40).for_each(|seed| history::<Plane>(seed, 1 + seed as usize % 7, &mut counts));
    println!("{counts:?}");
    assert!(counts.cells > 300 && counts.turned_over > 30 && counts.wrapped > 30, "{counts:?}");
}

#[test]
fn exact_rational_numbers_say_the_same_in_boxes_of_space() {
    let mut counts = Counts::default();
    seeds(6).for_each(|seed| history::<Space>(seed, 1 + seed as usize % 4, &mut counts));
    println!("{counts:?}");
    assert!(counts.cells > 50 && counts.turned_over > 10 && counts.wrapped > 10, "{counts:?}");
}
