//! Metamorphic tests: a scenario that is changed in what must not matter gives the same cells, always.
//!
//! The cells are those of the lower hull of the points (p, |p|² + ε), ε being larger for higher ids. So scaling,
//! translations, rotations and reflections change nothing, as long as they are exact, and only the order of ids counts.
//! Such relations need no oracle: they hold or fail whatever a fresh build says, and so also find what would be wrong
//! with fresh builds. Each is tested with every algorithm, on inputs in general position and on degenerate ones, with
//! motions of all sizes.
//!
//! `DELDRIFT_SOAK` multiplies the number of seeds.

mod recorded;
mod scenario;

use crate::common::inputs::{QUANTUM, draw_one};
use crate::common::{CellSet, Rng, assert_same_cells, cell_set, point, seeds, sorted};
use deldrift::motion::{Algorithm, MovingTriangulation, NO_VERTEX, Options, Saved};
use deldrift::{Dimension, Plane, Space, VertexId};
use scenario::{FAMILIES, Moves, Scenario};

fn options(algorithm: Algorithm) -> Options {
    Options { algorithm, ..Options::default() }
}

/// Cells with their vertices renamed.
fn renamed(cells: &CellSet, name: impl Fn(VertexId) -> VertexId) -> CellSet {
    cells.iter().map(|cell| sorted(&cell.iter().map(|&v| name(v)).collect::<Vec<_>>())).collect()
}

/// Calls `check` with scenarios of every family, the cells of each after every commit, and every algorithm.
fn for_all<G: Dimension>(n_seeds: u64, check: impl Fn(&Scenario<G>, &[CellSet], Algorithm, &mut Rng)) {
    for family in FAMILIES {
        for seed in seeds(n_seeds) {
            let scenario = Scenario::<G>::new(family, seed);
            let expected = scenario.run(options(Algorithm::Rebuilding));
            for algorithm in Algorithm::ALL {
                check(&scenario, &expected, algorithm, &mut Rng::new(seed ^ 0x3e7a));
            }
        }
    }
}

/// Runs a changed scenario, and compares the cells after every commit.
fn expect_same<G: Dimension>(
    changed: &Scenario<G>,
    expected: &[CellSet],
    algorithm: Algorithm,
    change: &dyn Fn() -> String,
) {
    let found = changed.run(options(algorithm));
    for (step, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_same_cells(found, expected, || {
            format!("{}, {algorithm:?}, {}, commit {step}", changed.name, change())
        });
    }
}

/// The powers of two take the coordinates, 36 bits of which the last is 2^-20, from the least number that there is to
/// the largest coordinates.
fn scaling<G: Dimension>() {
    for_all::<G>(1, |scenario, expected, algorithm, rng| {
        let factors = [-1054, *rng.pick(&[-900, -540, -500, -360]), -40, 1, 100, 174];
        for exponent in factors {
            // The reciprocal of the greatest one would not be the least.
            let factor = if exponent < 0 { 0.5f64.powi(-exponent) } else { 2f64.powi(exponent) };
            let scaled =
                scenario.mapped(|p| point::<G>(|k| p[k] * factor), |p| point::<G>(|k| p[k] / factor));
            expect_same(&scaled, expected, algorithm, &|| format!("times 2^{exponent}"));
        }
    });
}

#[test]
fn scaling_by_powers_of_two_changes_nothing() {
    scaling::<Plane>();
    scaling::<Space>();
}

/// By vectors of the same grid, so long that sums have up to 53 bits.
fn translation<G: Dimension>() {
    for_all::<G>(1, |scenario, expected, algorithm, rng| {
        for bits in [4, 24, 44, 52] {
            let by = point::<G>(|_| rng.within(-(1 << bits), 1 << bits) as f64 * QUANTUM);
            let moved = scenario.mapped(|p| point::<G>(|k| p[k] + by[k]), |p| point::<G>(|k| p[k] - by[k]));
            expect_same(&moved, expected, algorithm, &|| format!("moved by {by:?}"));
        }
    });
}

#[test]
fn exact_translations_change_nothing() {
    translation::<Plane>();
    translation::<Space>();
}

/// Axes exchanged and reversed, and a rotation: in the plane by an angle of cosine 3/5, times 5, in space by a sixth
/// of a turn about (1, 1, 1), times 3.
fn similarity<G: Dimension>() {
    for_all::<G>(1, |scenario, expected, algorithm, rng| {
        let mut axes: Vec<usize> = (0..G::D).collect();
        rng.shuffle(&mut axes);
        let signs: Vec<f64> = axes.iter().map(|_| *rng.pick(&[1.0, -1.0])).collect();
        let reflected = scenario.mapped(
            |p| point::<G>(|k| signs[k] * p[axes[k]]),
            |p| point::<G>(|k| (0..G::D).filter(|&i| axes[i] == k).map(|i| signs[i] * p[i]).sum()),
        );
        expect_same(&reflected, expected, algorithm, &|| format!("axes {axes:?}, signs {signs:?}"));

        let (rows, square): ([[f64; 3]; 3], f64) = if G::D == 2 {
            ([[3.0, -4.0, 0.0], [4.0, 3.0, 0.0], [0.0; 3]], 25.0)
        } else {
            ([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]], 9.0)
        };
        let turned = scenario.mapped(
            |p| point::<G>(|k| (0..G::D).map(|i| rows[k][i] * p[i]).sum()),
            |p| point::<G>(|k| (0..G::D).map(|i| rows[i][k] * p[i]).sum::<f64>() / square),
        );
        expect_same(&turned, expected, algorithm, &|| "turned".to_string());
    });
}

#[test]
fn isometries_change_nothing() {
    similarity::<Plane>();
    similarity::<Space>();
}

/// A triangulation whose vertices have other ids, in the same order: between them are those of removed vertices.
struct Gaps<G: Dimension> {
    t: MovingTriangulation<G>,
    /// Of the vertices of the scenario.
    ids: Vec<VertexId>,
    /// Vertices that are not in the scenario.
    others: Vec<VertexId>,
}

impl<G: Dimension> Gaps<G> {
    /// With some vertices that are not in the scenario among the others.
    fn new(scenario: &Scenario<G>, algorithm: Algorithm, rng: &mut Rng) -> Self {
        let (mut points, mut ids, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for p in &scenario.points {
            while rng.one_in(3) {
                others.push(VertexId::at(points.len()));
                points.push(draw_one::<G>(scenario.kind, scenario.points.len(), rng));
            }
            ids.push(VertexId::at(points.len()));
            points.push(*p);
        }
        let t = MovingTriangulation::new(&points, options(algorithm)).expect("a build");
        Gaps { t, ids, others }
    }

    /// Takes the others out, now or, with the moves, at the next commit.
    fn remove_others(&mut self, rng: &mut Rng) {
        let others = std::mem::take(&mut self.others);
        if rng.one_in(2) {
            self.t.stage_removals(&others).expect("they are present");
        } else {
            others.iter().for_each(|&v| self.t.remove_vertex(v).expect("it is present"));
        }
    }

    fn stage(&mut self, moves: &Moves<G>) {
        let ids: Vec<VertexId> = moves.vertices.iter().map(|&v| self.ids[v]).collect();
        self.t.move_vertices(&ids, &moves.targets).expect("good moves");
    }

    /// Numbers the vertices without gaps.
    fn compact(&mut self) {
        let new = self.t.compact().expect("room");
        assert_eq!(new.iter().filter(|&&v| v != NO_VERTEX).count(), self.t.id_count());
        self.ids.iter_mut().chain(&mut self.others).for_each(|v| *v = new[*v]);
    }

    /// The cells, under the ids of the scenario.
    fn cells(&self) -> CellSet {
        let rank = |v| VertexId::at(self.ids.binary_search(&v).expect("a vertex of the scenario"));
        renamed(&cell_set(&self.t), rank)
    }
}

fn gaps<G: Dimension>() {
    for_all::<G>(2, |scenario, expected, algorithm, rng| {
        let mut gaps = Gaps::new(scenario, algorithm, rng);
        let compacted_after = rng.below(scenario.steps.len());
        for (step, moves) in scenario.steps.iter().enumerate() {
            gaps.remove_others(rng);
            gaps.stage(moves);
            gaps.t.commit_timestamp().expect("a commit");
            let context = || format!("{}, {algorithm:?}, gaps, commit {step}", scenario.name);
            assert_same_cells(&gaps.cells(), &expected[step + 1], context);
            if step == compacted_after {
                gaps.compact();
                assert_same_cells(&gaps.cells(), &expected[step + 1], || format!("{}, compacted", context()));
            }
            // They come last; what matters is that they are gone by the next commit.
            let passing = scenario.points[rng.below(scenario.points.len())];
            gaps.others.push(gaps.t.insert_vertex(&passing).expect("an insertion"));
        }
    });
}

#[test]
fn gaps_between_ids_change_nothing() {
    gaps::<Plane>();
    gaps::<Space>();
}

/// In general position ids do not matter at all.
fn permutation<G: Dimension>() {
    for seed in seeds(3) {
        let scenario = Scenario::<G>::in_general_position(seed);
        let expected = scenario.run(options(Algorithm::Rebuilding));
        for algorithm in Algorithm::ALL {
            let mut order: Vec<VertexId> = VertexId::range(0..scenario.points.len()).collect();
            Rng::new(seed).shuffle(&mut order);
            let found = scenario.reordered(&order).run(options(algorithm));
            for (step, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let found = renamed(found, |v| order[v]);
                assert_same_cells(&found, expected, || {
                    format!("{}, {algorithm:?}, permuted, {step}", scenario.name)
                });
            }
        }
    }
}

#[test]
fn permuted_ids_change_nothing_in_general_position() {
    permutation::<Plane>();
    permutation::<Space>();
}

/// Every commit is undone by moving back, and then done again.
fn back<G: Dimension>() {
    for_all::<G>(2, |scenario, expected, algorithm, _| {
        let mut t = MovingTriangulation::<G>::new(&scenario.points, options(algorithm)).expect("a build");
        let mut now = scenario.points.clone();
        for (step, moves) in scenario.steps.iter().enumerate() {
            let there = moves.applied(&now);
            for (positions, cells, way) in [
                (&there, &expected[step + 1], "there"),
                (&now, &expected[step], "back"),
                (&there, &expected[step + 1], "there again"),
            ] {
                let targets: Vec<G::Point> = moves.vertices.iter().map(|&v| positions[v]).collect();
                t.move_vertices(&moves.vertices, &targets).expect("good moves");
                t.commit_timestamp().expect("a commit");
                assert_same_cells(&cell_set(&t), cells, || {
                    format!("{}, {algorithm:?}, commit {step} {way}", scenario.name)
                });
            }
            now = there;
        }
    });
}

#[test]
fn moving_back_brings_the_cells_back() {
    back::<Plane>();
    back::<Space>();
}

/// One half of the moves and then the other, the second perhaps by another algorithm or one by one; and all of them
/// staged by several calls, in any order.
fn split<G: Dimension>() {
    for_all::<G>(2, |scenario, expected, algorithm, rng| {
        let new = || MovingTriangulation::<G>::new(&scenario.points, options(algorithm)).expect("a build");
        let (mut halves, mut shuffled) = (new(), new());
        for (step, moves) in scenario.steps.iter().enumerate() {
            let (first, second) = moves.halves(rng);
            halves.set_algorithm(algorithm);
            halves.move_vertices(&first.vertices, &first.targets).expect("good moves");
            halves.commit_timestamp().expect("a commit");
            if rng.one_in(4) {
                for (&v, q) in second.vertices.iter().zip(&second.targets) {
                    halves.relocate_vertex(v, q).expect("a good place");
                }
            } else {
                halves.set_algorithm(*rng.pick(&[algorithm, algorithm, Algorithm::Auto, Algorithm::Repair]));
                halves.move_vertices(&second.vertices, &second.targets).expect("good moves");
                halves.commit_timestamp().expect("a commit");
            }
            shuffled.move_vertices(&second.vertices, &second.targets).expect("good moves");
            shuffled.move_vertices(&first.vertices, &first.targets).expect("good moves");
            shuffled.commit_timestamp().expect("a commit");
            for (t, how) in [(&halves, "in halves"), (&shuffled, "in another order")] {
                assert_same_cells(&cell_set(t), &expected[step + 1], || {
                    format!("{}, {algorithm:?}, commit {step} {how}", scenario.name)
                });
            }
        }
    });
}

#[test]
fn split_commits_come_to_the_same() {
    split::<Plane>();
    split::<Space>();
}

/// Between commits, and with moves staged, it is saved and loaded, or cloned.
fn copies<G: Dimension>() {
    for_all::<G>(2, |scenario, expected, algorithm, rng| {
        let mut t = MovingTriangulation::<G>::new(&scenario.points, options(algorithm)).expect("a build");
        for (step, moves) in scenario.steps.iter().enumerate() {
            let is_staged_first = rng.one_in(2);
            if is_staged_first {
                t.move_vertices(&moves.vertices, &moves.targets).expect("good moves");
            }
            let saves = rng.one_in(2);
            t = if saves {
                let bytes = t.saved().expect("room");
                let saved = Saved::of(&bytes).expect("what has been saved");
                MovingTriangulation::load(&saved, options(algorithm)).expect("what has been saved")
            } else {
                t.try_clone(None).expect("room")
            };
            if !is_staged_first {
                t.move_vertices(&moves.vertices, &moves.targets).expect("good moves");
            }
            t.commit_timestamp().expect("a commit");
            assert_same_cells(&cell_set(&t), &expected[step + 1], || {
                format!("{}, {algorithm:?}, commit {step}, saved: {saves}", scenario.name)
            });
        }
    });
}

#[test]
fn saving_and_cloning_change_nothing() {
    copies::<Plane>();
    copies::<Space>();
}
