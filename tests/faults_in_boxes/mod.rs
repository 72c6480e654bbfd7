//! Calls on boxes that repeat, without memory.

use super::common::{ids, point};
use super::{Faults, Outcome, Page, REQUESTS, TRACES, arm, cloud, disarm, forked, nudge};
use crate::common::Rng;
use deldrift::motion::{Interpolation, Options, TransferOrder, VertexValues};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{Dimension, Error, Plane, Result, Space, VertexId};
use std::sync::atomic::Ordering::Relaxed;

/// A call on a box.
#[derive(Clone, Copy, Debug)]
enum Call {
    New,
    MoveVertices,
    StageInsertions,
    StageRemovals,
    StageVectors,
    CommitMoves,
    CommitPositions,
    /// So many that all is built.
    CommitEdits,
    CommitFewEdits,
    CommitVectors,
    Prepare,
    PrepareAgain,
    /// Removals, other vectors, and then moves.
    PrepareAfterEdits,
    /// Of so many edits that all is built.
    PrepareBuild,
    Publish,
    Withdraw,
    /// Where a round has built all.
    WithdrawBuild,
    Cells,
    Edges,
    VoronoiVolumes,
    VoronoiCellsWithin,
    VoronoiFacetsWithin,
    VoronoiChanged,
    NaturalNeighbours,
    Conflicts,
    VerticesInBox,
    TakeChanges,
    TransferCells,
}

const CALLS: [Call; 28] = [
    Call::New,
    Call::MoveVertices,
    Call::StageInsertions,
    Call::StageRemovals,
    Call::StageVectors,
    Call::CommitMoves,
    Call::CommitPositions,
    Call::CommitEdits,
    Call::CommitFewEdits,
    Call::CommitVectors,
    Call::Prepare,
    Call::PrepareAgain,
    Call::PrepareAfterEdits,
    Call::PrepareBuild,
    Call::Publish,
    Call::Withdraw,
    Call::WithdrawBuild,
    Call::Cells,
    Call::Edges,
    Call::VoronoiVolumes,
    Call::VoronoiCellsWithin,
    Call::VoronoiFacetsWithin,
    Call::VoronoiChanged,
    Call::NaturalNeighbours,
    Call::Conflicts,
    Call::VerticesInBox,
    Call::TakeChanges,
    Call::TransferCells,
];

/// A box before a call.
struct Scene<G: Dimension> {
    t: PeriodicTriangulation<G>,
    goals: Vec<G::Point>,
    vectors: Vec<G::Point>,
    /// A number for each vertex, and more.
    heights: Vec<f64>,
}

/// All that there is to be seen: positions and vectors in bits, numbers, and cells with their indices, each as a set
/// of vertices with shifts.
#[derive(Debug, PartialEq)]
struct State {
    positions: Vec<Option<Vec<u64>>>,
    vectors: Vec<Vec<u64>>,
    numbers: [u64; 4],
    cells: Vec<Vec<(VertexId, [i64; 3])>>,
}

fn bits<P: AsRef<[f64]>>(p: &P) -> Vec<u64> {
    p.as_ref().iter().map(|x| x.to_bits()).collect()
}

impl<G: Dimension> Scene<G> {
    fn new(call: Call, is_read: bool) -> Self {
        let rng = &mut Rng::new(5);
        let mut points = cloud::<G>(60, rng);
        if !matches!(call, Call::CommitFewEdits) {
            (points[20], points[30]) = (points[10], points[11]);
        }
        let mut vectors: Vec<G::Point> =
            (0..G::D).map(|j| point::<G>(|k| f64::from(u8::from(j == k)) + 0.125 * k as f64)).collect();
        if matches!(call, Call::VoronoiCellsWithin | Call::VoronoiFacetsWithin) {
            // Open across the last axis, between walls there.
            vectors.pop();
            vectors.iter_mut().for_each(|vector| vector[G::D - 1] = 0.0);
        }
        let options = Options { threads: 1, ..Options::default() };
        let mut t = PeriodicTriangulation::new(&points, &vectors, options).expect("a build");
        nudge::<G>(&mut points, 0.02, rng);
        t.commit_positions(&points).expect("a commit");
        if is_read {
            // A later read is in the order of what was taken.
            t.take_changes().expect("room");
        }
        let mut heights: Vec<f64> = (0..100).map(f64::from).collect();
        let mut goals = points;
        nudge::<G>(&mut goals, 0.3, rng);
        vectors[0][0] += 0.01;
        match call {
            Call::CommitMoves => t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves"),
            Call::CommitEdits => {
                t.stage_insertions(&goals[..5]).expect("insertions");
                t.stage_removals(&ids([7, 10, 12])).expect("removals");
            }
            Call::CommitFewEdits => {
                t.stage_insertions(&goals[..3]).expect("insertions");
                t.stage_removals(&ids([7, 12])).expect("removals");
                t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves");
            }
            Call::CommitVectors => t.stage_vectors(&vectors).expect("vectors"),
            Call::TransferCells => {
                t.take_changes().expect("room");
                heights = vec![0.25; t.cell_count().expect("room")];
                t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves");
                t.commit_timestamp().expect("a commit");
                t.take_changes().expect("room");
            }
            Call::Prepare => t.move_first(&goals).expect("moves"),
            Call::PrepareAgain | Call::Publish | Call::Withdraw => {
                t.stage_insertions(&goals[..5]).expect("insertions");
                t.prepare_timestamp().expect("a round");
                t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves");
            }
            Call::PrepareAfterEdits => {
                t.stage_removals(&ids([7, 12])).expect("removals");
                t.prepare_timestamp().expect("a round");
                t.stage_vectors(&vectors).expect("vectors");
                t.stage_insertions(&goals[..2]).expect("insertions");
                t.prepare_timestamp().expect("a second round");
                t.stage_removals(&ids([8])).expect("removals");
                t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves");
            }
            Call::PrepareBuild | Call::WithdrawBuild => {
                t.move_vertices(&ids([3, 4, 5]), &goals[3..6]).expect("moves");
                t.prepare_timestamp().expect("a round");
                t.stage_insertions(&goals[..30]).expect("insertions");
                if let Call::WithdrawBuild = call {
                    t.prepare_timestamp().expect("a second round");
                    t.move_vertices(&ids([3, 4, 5]), &goals[4..7]).expect("moves");
                    t.prepare_timestamp().expect("a third round");
                }
            }
            _ => {}
        }
        Scene { t, goals, vectors, heights }
    }

    /// Makes the call, and disarms as soon as it is back; what it gives, as far as that is a number.
    fn call(&mut self, call: Call) -> Result<u64> {
        let Scene { t, goals, vectors, heights } = self;
        fn given<T>(result: Result<T>) -> Result<T> {
            disarm();
            result
        }
        Ok(match call {
            Call::New => {
                let options = Options { threads: 1, ..Options::default() };
                given(PeriodicTriangulation::<G>::new(goals, vectors, options))?.cell_count()? as u64
            }
            Call::MoveVertices => given(t.move_vertices(&ids([3, 4, 5]), &goals[3..6])).map(|()| 0)?,
            Call::StageInsertions => given(t.stage_insertions(&goals[..5]))?.get().into(),
            Call::StageRemovals => given(t.stage_removals(&ids([7, 10, 12]))).map(|()| 0)?,
            Call::StageVectors => given(t.stage_vectors(vectors)).map(|()| 0)?,
            Call::CommitPositions => given(t.commit_positions(goals))?.moved,
            Call::CommitMoves | Call::CommitEdits | Call::CommitFewEdits | Call::CommitVectors => {
                let report = given(t.commit_timestamp())?;
                report.moved + 100 * report.inserted + 10_000 * report.removed
            }
            Call::Prepare | Call::PrepareAgain | Call::PrepareAfterEdits | Call::PrepareBuild => {
                let report = given(t.prepare_timestamp())?;
                report.moved + 100 * report.inserted + 10_000 * report.timestamp
            }
            Call::Publish => given(t.publish_timestamp())?,
            Call::Withdraw | Call::WithdrawBuild => {
                t.withdraw_timestamp();
                disarm();
                t.timestamp()
            }
            Call::TransferCells => {
                let made = t.transfer_cells(None, TransferOrder::Second, 1, heights, &mut |_| true);
                disarm();
                assert!(heights.iter().all(|&mean| mean == 0.25), "a constant is another one");
                made?;
                heights.len() as u64
            }
            Call::TakeChanges => {
                let changes = given(t.take_changes())?;
                (changes.created.len() + 10_000 * changes.removed.len()) as u64
            }
            Call::Cells => given(t.cell_count())? as u64,
            Call::Edges => given(t.edges())?.len() as u64,
            Call::VoronoiVolumes => given(t.voronoi_volumes(&mut |_| true))?.len() as u64,
            Call::VoronoiCellsWithin | Call::VoronoiFacetsWithin => {
                let at_wall = |axis: usize, x: f64, y: f64| if axis + 1 == G::D { x } else { y };
                let low = point::<G>(|axis| at_wall(axis, -0.5, f64::NEG_INFINITY));
                let high = point::<G>(|axis| at_wall(axis, 2.0, f64::INFINITY));
                let rows = [&[0.0, 2.0, 1.5][..], &[0.0, 0.0, 2.0, 1.5]];
                let (clip, row, mut n) = (Some([&low, &high]), rows[G::D - 2], 0);
                given(if let Call::VoronoiCellsWithin = call {
                    t.for_voronoi(clip, row, None, &mut |_| true, Some(&mut |_, _| n += 1), None)
                } else {
                    t.for_voronoi(clip, row, None, &mut |_| true, None, Some(&mut |_, _| n += 1))
                })?;
                n
            }
            Call::VoronoiChanged => {
                given(t.voronoi_changed(&ids([3, 4, 5])))?.iter().map(|&mark| u64::from(mark)).sum()
            }
            Call::NaturalNeighbours => {
                let values = VertexValues { values: &heights[..t.id_count()], n_values: 1 };
                let (method, mut n) = (Interpolation::NaturalNeighbour, 0);
                given(t.interpolate(method, values, &goals[..4], None, |row| n += u64::from(row.is_some())))?;
                n
            }
            Call::Conflicts => given(t.conflicts(&goals[0], None))?.len() as u64,
            Call::VerticesInBox => {
                let (low, high) = (point::<G>(|_| 0.25), point::<G>(|_| 0.75));
                given(t.vertices_in_box(&low, &high))?.len() as u64
            }
        })
    }

    fn state(&self) -> State {
        let t = &self.t;
        let positions =
            VertexId::range(0..t.id_count()).map(|v| t.position(v).ok().map(|p| bits(&p))).collect();
        let shifts: Vec<_> = t.cell_shifts().expect("room").collect();
        let mut cells = Vec::new();
        for (row, shifts) in t.cells().expect("room").corners.iter().zip(shifts.chunks_exact(G::D + 1)) {
            let mut corners: Vec<_> = row.as_ref().iter().copied().zip(shifts.iter().copied()).collect();
            corners.sort_unstable();
            cells.push(corners);
        }
        let counts = [t.id_count(), t.vertex_count(), t.staged_count()].map(|n| n as u64);
        State {
            positions,
            vectors: t.vectors().map(|v| bits(&v)).collect(),
            numbers: [t.timestamp(), counts[0], counts[1], counts[2]],
            cells,
        }
    }

    /// What is to be seen, and after what is staged as well, in whatever order cells are: that is of a history.
    fn finish(&mut self) -> [State; 2] {
        let now = self.state();
        match self.t.publish_timestamp() {
            Ok(_) | Err(Error::NotPrepared) => {}
            Err(error) => panic!("{error}"),
        }
        self.t.commit_timestamp().expect("a commit");
        let mut both = [now, self.state()];
        both.iter_mut().for_each(|state| state.cells.sort_unstable());
        both
    }
}

fn faults_of<G: Dimension>(faults: &mut Faults<'_>, call: Call, is_read: bool) {
    let name = format!("{}D box, {call:?}, read: {is_read}", G::D);
    let mut reference = Scene::<G>::new(call, is_read);
    let Ok(given) = reference.call(call) else { panic!("{name}: it fails") };
    let finished = reference.finish();
    let state = Scene::<G>::new(call, is_read).state();
    let mut before = Scene::<G>::new(call, is_read);
    forked(faults.page, |page| {
        arm(usize::MAX, false);
        let _ = before.call(call);
        disarm();
        page.requests = REQUESTS.load(Relaxed);
        page.outcome = Outcome::Untouched;
    });
    if matches!(call, Call::Withdraw | Call::WithdrawBuild) {
        assert_eq!(faults.page.requests, 0, "{name}: it asks for memory");
    }
    let stride = faults.page.requests.div_ceil(faults.most).max(1);
    for (round, k) in (0..).step_by(stride).enumerate().take(4 * faults.most) {
        let goes_on = round % 3 == 2;
        let mut attempt = |page: &mut Page, traces: bool| {
            forked(page, |page| {
                TRACES.store(traces, Relaxed);
                arm(k, goes_on);
                let done = before.call(call);
                disarm();
                let has_failed = page.has_failed;
                let second = match &done {
                    Ok(given) => *given,
                    Err(error) => {
                        let is_memory = matches!(error, Error::OutOfMemory { .. });
                        assert!(is_memory && has_failed, "another error: {error}");
                        assert!(before.state() == state, "another state");
                        before.call(call).expect("no fault")
                    }
                };
                assert_eq!(second, given, "another result");
                assert!(before.finish() == finished, "another end");
                page.outcome = match done {
                    Err(_) => Outcome::Clean,
                    Ok(_) if has_failed => Outcome::Absorbed,
                    Ok(_) => Outcome::Untouched,
                };
            });
        };
        attempt(faults.page, false);
        if faults.page.outcome == Outcome::Untouched {
            break;
        }
        faults.enter(&format!("{call:?} in a box"), &name, (k, goes_on), |page| attempt(page, true));
    }
}

/// Faults in all calls.
pub fn all(faults: &mut Faults<'_>) {
    for call in CALLS {
        for is_read in [false, true] {
            faults_of::<Plane>(faults, call, is_read);
            faults_of::<Space>(faults, call, is_read);
        }
    }
}
