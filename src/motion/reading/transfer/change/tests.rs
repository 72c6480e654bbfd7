//! What is found near by, beside what a look at all cells finds.

use super::*;
use crate::delaunay::{Moving, Plane, Space};
use crate::ids::VertexId;
use crate::motion::{MovingTriangulation, Options, Segment, TransferOrder};
use crate::random::Rng;
use std::time::Instant;

/// Whether the cells that those that are turned over meet are found near by, which must be all; none where no cell is
/// turned over.
pub(crate) fn finds_as_by_a_look_at_all<T: Now>(now: &T, gone: &[Gone]) -> Option<bool> {
    if T::D == 2 { compare::<2, T>(now, gone, &[]) } else { compare::<3, T>(now, gone, &[]) }
}

/// As above, but for the cells of now that have `arrived`.
fn compare<const D: usize, T: Now>(now: &T, gone: &[Gone], arrived: &[CellId]) -> Option<bool> {
    let turned_over: Vec<_> =
        gone.iter().copied().filter(|cell| is_turned_over::<D>(&cell.corners)).collect();
    let mut arrived = arrived.to_vec();
    arrived.sort_unstable();
    let change = Change { now, gone: Vec::new(), arrived };
    let monitor = &mut |_| true;
    let progress = &mut Progress::new(monitor, 1);
    if turned_over.is_empty() {
        return None;
    }
    let near = near::<D, T>(now, &turned_over, progress).expect("room");
    if let Some(near) = &near {
        let found = change.met::<D>(&turned_over, near, progress).expect("room");
        let expected = change.met_of_all::<D>(&turned_over, progress).expect("room");
        assert_eq!(found, expected, "{} cells are near", near.len());
    }
    Some(near.is_some())
}

#[derive(Debug, Default)]
struct Counts {
    near: usize,
    all: usize,
}

impl Counts {
    fn enter(&mut self, is_near: Option<bool>) {
        self.near += usize::from(is_near == Some(true));
        self.all += usize::from(is_near == Some(false));
    }
}

/// What gives a triangulation segments.
type Constrain<G> = fn(&mut MovingTriangulation<G>, &mut Rng);

/// Vertices move, come and go, those of the hull as well, some far away and some to the places of others.
fn history<G: Moving>(seed: u64, constrain: Constrain<G>, counts: &mut Counts) {
    let rng = &mut Rng::new(seed);
    // Far from the origin for their size, and of little and great magnitude.
    let (scale, away) =
        *rng.pick(&[(1.0, 0.0), (1.0, 0.0), (1.0, 1e9), (1e-200, 0.0), (1e-300, 0.0), (1e40, 0.0)]);
    let (way, is_lattice) = (*rng.pick(&[0.03, 0.1, 0.3, 3.0]), rng.one_in(3));
    let draw = |rng: &mut Rng, near: Option<G::Point>| {
        let mut place = G::Point::default();
        for axis in 0..G::D {
            let x = match near {
                Some(near) => (near[axis] - away) / scale + way * (rng.unit() - 0.5),
                None => rng.unit(),
            };
            place[axis] = away + scale * if is_lattice { (5.0 * x).round() / 5.0 } else { x };
        }
        place
    };
    let n = 8 + rng.below(150);
    let mut places: Vec<_> = (0..n).map(|_| draw(rng, None)).collect();
    let mut t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good places");
    if rng.one_in(3) {
        constrain(&mut t, rng);
    }
    t.take_changes().expect("room");
    for _ in 0..4 {
        let n_before = places.len();
        for _ in 0..1 + rng.below(2) {
            let movers = [1, 2, 20, places.len()][rng.below(4)];
            for _ in 0..movers {
                let v = VertexId::new(rng.below(places.len()) as u32);
                if t.is_present(v) {
                    let goal = if rng.one_in(40) { places[0] } else { draw(rng, Some(places[v.index()])) };
                    // A segment may be in the way.
                    if t.relocate_vertex(v, &goal).is_ok() {
                        places[v.index()] = goal;
                    }
                }
            }
            let v = VertexId::new(rng.below(places.len()) as u32);
            if rng.one_in(2) && t.is_present(v) {
                _ = t.remove_vertex(v);
            }
            if rng.one_in(2) {
                let place = draw(rng, None);
                if t.insert_vertex(&place).is_ok() {
                    places.push(place);
                }
            }
        }
        t.take_changes().expect("room");
        let now = t.now().expect("changes are taken");
        let (gone, _) = now.gone_and_arrived(Some(&places[..n_before])).expect("all places are known");
        counts.enter(finds_as_by_a_look_at_all(&now, &gone));
        // Places that are not those of now, as a program may give them.
        let others: Vec<_> = places.iter().map(|&place| draw(rng, Some(place))).collect();
        let (gone, _) = now.gone_and_arrived(Some(&others)).expect("all places are known");
        counts.enter(finds_as_by_a_look_at_all(&now, &gone));
    }
}

fn cells_near_by_are_those_of_a_look_at_all<G: Moving>(n_seeds: u64, constrain: Constrain<G>) {
    let mut counts = Counts::default();
    (0..n_seeds).for_each(|seed| history::<G>(seed, constrain, &mut counts));
    println!("{}D: {counts:?}", G::D);
    assert!(counts.near > 150 && counts.all > 50, "{counts:?}");
}

#[test]
fn cells_near_by_are_those_of_a_look_at_all_in_the_plane() {
    cells_near_by_are_those_of_a_look_at_all::<Plane>(150, |t, rng| {
        for _ in 0..4 {
            let ends = [0; 2].map(|_| VertexId::at(rng.below(t.id_count())));
            // Two may be one, or a vertex may be between.
            _ = t
                .stage_segments([Segment { ends, marker: 0, ..Segment::default() }].into_iter())
                .and_then(|_| t.commit_timestamp());
            t.discard_moves();
        }
    });
}

#[test]
fn cells_near_by_are_those_of_a_look_at_all_in_space() {
    cells_near_by_are_those_of_a_look_at_all::<Space>(80, |_, _| {});
}

/// What a transfer costs beside the commit before it, and what it costs to look for cells near by and at all.
fn times<G: Moving, const D: usize>(n: usize) {
    let rng = &mut Rng::new(1);
    let mut places = vec![G::Point::default(); n];
    places.iter_mut().for_each(|place| (0..G::D).for_each(|axis| place[axis] = rng.unit()));
    let mut t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good places");
    t.take_changes().expect("room");
    let spacing = (n as f64).powf(-1.0 / G::D as f64);
    for share in [1e-3, 3e-3, 1e-2, 3e-2, 1e-1] {
        let mut values = vec![1.0; t.cell_count()];
        for place in &mut places {
            (0..G::D).for_each(|axis| place[axis] += share * spacing * (2.0 * rng.unit() - 1.0));
        }
        let start = Instant::now();
        t.commit_positions(&places).expect("good places");
        let of_commit = start.elapsed().as_secs_f64();
        t.cells().expect("room");
        t.take_changes().expect("room");
        let start = Instant::now();
        let report = t
            .transfer_cells(Some(&places), TransferOrder::Second, 1, &mut values, &mut |_| true)
            .expect("a transfer");
        let of_transfer = start.elapsed().as_secs_f64();
        let now = t.now().expect("changes are taken");
        let (gone, _) = now.gone_and_arrived(Some(&places)).expect("all places are known");
        let change = Change { now: &now, gone: Vec::new(), arrived: Vec::new() };
        let all = gone.iter().copied();
        let turned_over: Vec<_> = all.filter(|cell| is_turned_over::<D>(&cell.corners)).collect();
        let monitor = &mut |_| true;
        let progress = &mut Progress::new(monitor, 1);
        let start = Instant::now();
        let near = near::<D, _>(&now, &turned_over, progress).expect("room");
        let n_near = near.as_ref().map_or(t.cell_count(), Vec::len);
        let met = near.map(|near| change.met::<D>(&turned_over, &near, progress));
        let of_near = start.elapsed().as_secs_f64();
        let start = Instant::now();
        _ = change.met_of_all::<D>(&turned_over, progress).expect("room");
        let of_all = start.elapsed().as_secs_f64();
        println!(
            "{D}D, {n}, share {share}: {} cells gone, {} turned over, {n_near} near, {} met; transfer {:.3} of a \
             commit, near by {:.4}, all {:.3}",
            report.gone,
            report.turned_over,
            met.map_or(0, |met| met.expect("room").len()),
            of_transfer / of_commit,
            of_near / of_commit,
            of_all / of_commit,
        );
    }
}

#[test]
#[ignore = "prints times"]
fn of_transfers() {
    times::<Plane, 2>(100_000);
    times::<Space, 3>(100_000);
}
