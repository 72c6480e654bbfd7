//! Calls that stage, change and discard, in every order and from every state: beside a model of what each call does, and sets
//! made anew.

use super::keeping::load;
use super::*;
use crate::error::StagedEdit;

/// What a program may do.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Call {
    Insert,
    Relocate,
    Remove,
    MoveLast,
    MoveFirst,
    MoveAll,
    StageInsertions,
    StageRemoval,
    StageVectors,
    Commit,
    CommitPositions,
    Withdraw,
    Publish,
    Discard,
    Compact,
    Clone,
    Load,
}

const CALLS: [Call; 17] = [
    Call::Insert,
    Call::Relocate,
    Call::Remove,
    Call::MoveLast,
    Call::MoveFirst,
    Call::MoveAll,
    Call::StageInsertions,
    Call::StageRemoval,
    Call::StageVectors,
    Call::Commit,
    Call::CommitPositions,
    Call::Withdraw,
    Call::Publish,
    Call::Discard,
    Call::Compact,
    Call::Clone,
    Call::Load,
];

/// What a triangulation should be, and what should wait in it.
#[derive(Clone)]
struct Model<G: Moving> {
    /// By id, where a vertex is; none for removed ones.
    positions: Vec<Option<G::Point>>,
    moves: Vec<(usize, G::Point)>,
    insertions: Vec<G::Point>,
    removals: Vec<usize>,
    basis: Vec<G::Point>,
    coming: Option<Vec<G::Point>>,
    timestamp: u64,
}

/// What a call is expected to tell.
type Told = Result<(), &'static str>;

fn kind(error: &Error) -> &'static str {
    match error {
        Error::StagedVertex { staged: StagedEdit::Insertion, .. } => "insertion staged",
        Error::StagedVertex { staged: StagedEdit::Removal, .. } => "removal staged",
        Error::RemovedVertex { .. } => "removed",
        Error::NoSuchVertex { .. } => "no such vertex",
        Error::DuplicateMove { .. } => "moved twice",
        _ => "something else",
    }
}

impl<G: Moving> Model<G> {
    fn id_count(&self) -> usize {
        self.positions.len() + self.insertions.len()
    }

    /// The last vertex that has been committed.
    fn last(&self) -> usize {
        self.positions.len().saturating_sub(1)
    }

    fn is_there(&self, vertex: usize) -> Told {
        match self.positions.get(vertex) {
            Some(Some(_)) => Ok(()),
            Some(None) => Err("removed"),
            None if vertex < self.id_count() => Err("insertion staged"),
            None => Err("no such vertex"),
        }
    }

    fn stage_move(&mut self, vertex: usize, goal: G::Point) -> Told {
        self.is_there(vertex)?;
        if self.removals.contains(&vertex) {
            return Err("removal staged");
        }
        if self.moves.iter().any(|&(moving, _)| moving == vertex) {
            return Err("moved twice");
        }
        self.moves.push((vertex, goal));
        Ok(())
    }

    fn discard(&mut self) {
        self.moves.clear();
        self.insertions.clear();
        self.removals.clear();
        self.coming = None;
    }

    fn commit(&mut self) {
        for &(vertex, goal) in &self.moves {
            self.positions[vertex] = Some(goal);
        }
        self.removals.iter().for_each(|&vertex| self.positions[vertex] = None);
        self.positions.extend(self.insertions.iter().copied().map(Some));
        if let Some(basis) = self.coming.take() {
            self.basis = basis;
        }
        self.discard();
        self.timestamp += 1;
    }

    /// Makes a call on the model; `goals` are where it puts vertices.
    fn make(&mut self, call: Call, goals: &[G::Point]) -> Told {
        let (last, n_ids) = (self.last(), self.id_count());
        match call {
            Call::Insert => {
                if !self.insertions.is_empty() {
                    return Err("insertion staged");
                }
                self.positions.push(Some(goals[0]));
            }
            Call::Relocate => {
                self.is_there(last)?;
                if self.moves.iter().any(|&(moving, _)| moving == last) {
                    return Err("moved twice");
                }
                self.positions[last] = Some(goals[0]);
            }
            Call::Remove => {
                self.is_there(last)?;
                self.positions[last] = None;
                self.moves.retain(|&(moving, _)| moving != last);
                self.removals.retain(|&going| going != last);
            }
            Call::MoveLast => self.stage_move(last, goals[0])?,
            Call::MoveFirst => self.stage_move(0, goals[1])?,
            Call::MoveAll => {
                let mut next = self.clone();
                for (vertex, position) in self.positions.iter().enumerate() {
                    if position.is_some() && !self.removals.contains(&vertex) {
                        next.stage_move(vertex, goals[vertex])?;
                    }
                }
                let first = self.positions.len();
                for (index, position) in next.insertions.iter_mut().enumerate() {
                    *position = goals[first + index];
                }
                *self = next;
            }
            Call::StageInsertions => self.insertions.push(goals[2]),
            Call::StageRemoval => {
                self.is_there(last)?;
                if self.removals.contains(&last) {
                    return Err("removal staged");
                }
                self.removals.push(last);
            }
            Call::StageVectors => {
                let mut basis = self.basis.clone();
                basis[0][0] = if basis[0][0] == 1.0 { 1.125 } else { 1.0 };
                self.coming = Some(basis);
            }
            Call::Commit | Call::Publish => self.commit(),
            Call::CommitPositions => {
                if !self.moves.is_empty() {
                    return Err("moved twice");
                }
                let there = (0..self.positions.len()).filter(|&v| self.positions[v].is_some());
                self.moves = there.map(|v| (v, goals[v])).collect();
                let first = self.positions.len();
                (first..n_ids).for_each(|v| self.insertions[v - first] = goals[v]);
                self.commit();
            }
            Call::Withdraw | Call::Discard => self.discard(),
            Call::Compact => {
                let mut new_ids = vec![usize::MAX; self.positions.len()];
                let there = (0..self.positions.len()).filter(|&v| self.positions[v].is_some());
                there.enumerate().for_each(|(new, old)| new_ids[old] = new);
                self.positions.retain(Option::is_some);
                self.moves.iter_mut().for_each(|(vertex, _)| *vertex = new_ids[*vertex]);
                self.removals.iter_mut().for_each(|vertex| *vertex = new_ids[*vertex]);
            }
            Call::Clone | Call::Load => {}
        }
        Ok(())
    }
}

/// Makes a call on a triangulation that is as the model.
fn make<G: Moving>(
    t: &mut PeriodicTriangulation<G>,
    model: &Model<G>,
    call: Call,
    goals: &[G::Point],
) -> Result<(), Error> {
    let last = VertexId::at(model.last());
    match call {
        Call::Insert => t.insert_vertex(&goals[0]).map(|v| assert_eq!(v.index(), model.positions.len())),
        Call::Relocate => t.relocate_vertex(last, &goals[0]),
        Call::Remove => t.remove_vertex(last),
        Call::MoveLast => t.move_vertices(&[last], &goals[..1]),
        Call::MoveFirst => t.move_vertices(&[VertexId::new(0)], &goals[1..2]),
        Call::MoveAll => t.move_first(&goals[..t.id_count()]),
        Call::StageInsertions => {
            t.stage_insertions(&goals[2..3]).map(|v| assert_eq!(v.index(), model.id_count()))
        }
        Call::StageRemoval => t.stage_removals(&[last]),
        Call::StageVectors => {
            let mut basis = model.basis.clone();
            basis[0][0] = if basis[0][0] == 1.0 { 1.125 } else { 1.0 };
            t.stage_vectors(&basis)
        }
        Call::Commit => t.commit_timestamp().map(drop),
        Call::CommitPositions => t.commit_positions(&goals[..t.id_count()]).map(drop),
        Call::Withdraw => {
            t.prepare_timestamp()?;
            t.withdraw_timestamp();
            Ok(())
        }
        Call::Publish => {
            t.prepare_timestamp()?;
            t.publish_timestamp().map(drop)
        }
        Call::Discard => {
            assert_eq!(t.discard_moves(), model.moves.len());
            Ok(())
        }
        Call::Compact => t.compact().map(|ids| assert_eq!(ids.len(), model.id_count())),
        Call::Clone => t.try_clone(None).map(|copy| *t = copy),
        Call::Load => t.saved().map(|bytes| *t = load(&bytes).unwrap()),
    }
}

fn assert_as_model<G: Moving>(t: &PeriodicTriangulation<G>, model: &Model<G>, context: &dyn Fn() -> String) {
    assert_eq!(t.id_count(), model.id_count(), "{}", context());
    assert_eq!(t.staged_count(), model.moves.len(), "{}", context());
    assert_eq!(t.staged_edits(), (model.insertions.len(), model.removals.len()), "{}", context());
    assert_eq!(t.timestamp(), model.timestamp, "{}", context());
    for v in 0..model.id_count() {
        let place = model
            .positions
            .get(v)
            .copied()
            .unwrap_or_else(|| Some(model.insertions[v - model.positions.len()]));
        assert_eq!(t.position_or_goal(VertexId::at(v)), place, "{}", context());
    }
}

/// Cells by the ids of the vertices that are there, with their shifts.
fn cells_of<G: Moving>(t: &PeriodicTriangulation<G>, names: &[usize]) -> BTreeSet<Vec<(usize, [i64; 3])>> {
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let rows = t.cells().unwrap().corners.iter().zip(shifts.chunks(G::D + 1));
    let rows = rows.map(|(row, shifts)| {
        let mut row: Vec<_> = row.as_ref().iter().map(|v| names[v.index()]).zip(shifts.to_vec()).collect();
        row.sort_unstable();
        row
    });
    rows.collect()
}

fn assert_as_fresh<G: Moving>(t: &PeriodicTriangulation<G>, model: &Model<G>, context: &dyn Fn() -> String) {
    let there: Vec<usize> = (0..model.positions.len()).filter(|&v| model.positions[v].is_some()).collect();
    let points: Vec<G::Point> = there.iter().filter_map(|&v| model.positions[v]).collect();
    let fresh = PeriodicTriangulation::<G>::new(&points, &model.basis, Options::default()).unwrap();
    let mut names = vec![usize::MAX; model.positions.len()];
    there.iter().enumerate().for_each(|(new, &old)| names[old] = new);
    let identity: Vec<usize> = (0..points.len()).collect();
    assert!(cells_of(t, &names) == cells_of(&fresh, &identity), "{}", context());
}

/// All sequences of so many calls, from a state.
fn walk<G: Moving>(
    t: &PeriodicTriangulation<G>,
    model: &Model<G>,
    goals: &[G::Point],
    made: &mut Vec<Call>,
    n_calls: usize,
    n_walks: &mut usize,
) {
    for call in CALLS {
        let (mut t, mut next) = (t.try_clone(None).unwrap(), model.clone());
        made.push(call);
        // Each call has goals of its own.
        let goals = &goals[made.len()..];
        let told = make(&mut t, model, call, goals);
        let expected = next.make(call, goals);
        if expected.is_err() {
            next = model.clone();
        }
        let made_now = made.clone();
        let context = || format!("{made_now:?}");
        assert_eq!(told.as_ref().map_err(kind).copied(), expected, "{}", context());
        assert_as_model(&t, &next, &context);
        if made.len() < n_calls {
            walk(&t, &next, goals, made, n_calls, n_walks);
        } else {
            assert_as_fresh(&t, &next, &context);
            // What waits is what has been staged.
            t.commit_timestamp().unwrap();
            next.commit();
            assert_as_model(&t, &next, &context);
            assert_as_fresh(&t, &next, &context);
            *n_walks += 1;
        }
        made.pop();
    }
}

/// From a set that has just been made, and in a copy of which vertices share places.
fn walk_from<G: Moving>(n_calls: usize, shares_places: bool) {
    let mut basis = vec![G::Point::default(); G::D];
    (0..G::D).for_each(|axis| basis[axis][axis] = 1.0);
    let mut goals = random_points::<G>(&mut Rng::new(5), 16, &basis);
    let mut points = random_points::<G>(&mut Rng::new(6), 3, &basis);
    if shares_places {
        points[2] = place::<G>(&points, &basis, 0, [1, 0, 0]);
        goals[3] = points[1];
        goals[6] = place::<G>(&goals, &basis, 4, [0, -1, 0]);
    }
    let t = PeriodicTriangulation::<G>::new(&points, &basis, Options::default()).unwrap();
    let model = Model {
        positions: points.into_iter().map(Some).collect(),
        moves: Vec::new(),
        insertions: Vec::new(),
        removals: Vec::new(),
        basis,
        coming: None,
        timestamp: 0,
    };
    let mut n_walks = 0;
    walk(&t, &model, &goals, &mut Vec::new(), n_calls, &mut n_walks);
    assert_eq!(n_walks, CALLS.len().pow(n_calls as u32));
}

#[test]
fn all_calls_in_every_order_do_what_a_model_does() {
    walk_from::<Plane>(3, false);
    walk_from::<Plane>(3, true);
    walk_from::<Space>(2, false);
    walk_from::<Space>(2, true);
}

/// A vertex that has been inserted can be staged at once, whatever was before.
#[test]
fn an_inserted_vertex_can_be_staged() {
    fn check<G: Moving>() {
        let mut basis = vec![G::Point::default(); G::D];
        (0..G::D).for_each(|axis| basis[axis][axis] = 1.0);
        let points = random_points::<G>(&mut Rng::new(7), 6, &basis);
        let made = || PeriodicTriangulation::<G>::new(&points[..4], &basis, Options::default()).unwrap();
        let mut compacted = made();
        compacted.remove_vertex(VertexId::new(1)).unwrap();
        compacted.compact().unwrap();
        let mut moved = made();
        moved.move_vertices(&[VertexId::new(0)], &points[4..5]).unwrap();
        let mut staged = made();
        staged.stage_removals(&[VertexId::new(0)]).unwrap();
        for mut t in [load(&made().saved().unwrap()).unwrap(), compacted, moved, staged] {
            let vertex = t.insert_vertex(&points[5]).unwrap();
            t.move_vertices(&[vertex], &points[4..5]).unwrap();
            let mut other = t.try_clone(None).unwrap();
            other.stage_removals(&[vertex]).unwrap();
            other.commit_timestamp().unwrap();
            assert!(!other.is_present(vertex));
            t.commit_timestamp().unwrap();
            assert_eq!(t.position(vertex), Ok(points[4]));
        }
    }
    check::<Plane>();
    check::<Space>();
}
