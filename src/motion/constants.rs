//! The numbers that decide between two ways to the same cells.
//!
//! `make calibrate` measures every one of them: what the parts of a commit cost, and for a threshold what recorded
//! motions take with it and with other values. It prints each beside the measured one, and by how much the one here is
//! slower. Change one where that is clearly more than the noise printed next to it, twice.

use crate::delaunay::Dimension;
use crate::motion::report::Evaluations;

/// What the parts of a commit cost, in nanoseconds; only the ratios matter.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// A watched bi-cell.
    pub watched: f64,
    /// A vertex beyond its tolerance.
    pub beyond: f64,
    /// Per vertex, what a sweep costs that is spared.
    pub sweep: f64,
    /// Per vertex, checking the slack of all cells; none if that never pays.
    pub slack: Option<f64>,
    /// A bi-cell that has used up its slack.
    pub used_up: f64,
    /// Per vertex, to compute all tolerances.
    pub computed: f64,
    /// A vertex rebuilt, exact evaluations apart; also one of the link of a vertex of high degree.
    pub rebuilt: f64,
    /// A vertex placed.
    pub placed: f64,
    /// A certificate that is evaluated by itself, as flips and placements do, with its share of these.
    pub certified: f64,
    /// An exact evaluation.
    pub exact: f64,
}

impl Costs {
    /// What placements and evaluations have cost.
    pub(super) fn of(&self, placements: u64, evaluations: Evaluations) -> f64 {
        placements as f64 * self.placed
            + evaluations.link_sites as f64 * self.rebuilt
            + evaluations.exact as f64 * self.exact
    }
}

/// The constants of one dimension.
#[derive(Clone, Copy, Debug)]
pub struct Constants {
    /// The costs by which auto weighs what a commit has counted.
    pub costs: Costs,

    // Auto: which certificates a commit checks.
    /// Shortest wait for another try of a cheaper way, in commits.
    pub min_wait_commits: u32,
    /// Longest wait for another try of a cheaper way, in commits.
    pub max_wait_commits: u32,
    /// Each wait is so many times as long as the one before, and the shortest wait more.
    pub wait_growth: u32,
    /// Weight of the last commit in the mean number of changes of a commit.
    pub weight_of_last: f64,
    /// The cheaper way is tried after commits with at most one flip or placement per this number of vertices.
    pub vertices_per_change: f64,
    /// Watching is tried without slack before it after commits with at most one flip or placement per this number of
    /// vertices.
    pub vertices_per_change_to_watch: f64,
    /// The wait ends early when changes are that many times rarer than when the cheaper way was given up.
    pub rarer_changes: f64,
    /// Watching is tried when less than one bi-cell per this number of vertices uses up its slack.
    pub vertices_per_used_up_to_watch: u64,
    /// The cheaper way is given up when it has cost more than the other by this share of computing all tolerances.
    pub max_excess: f64,
    /// All tolerances are computed again when watched bi-cells have cost more or less than vertices beyond by this
    /// share of that.
    pub max_imbalance: f64,
    /// Watching pays only while less than this share of the vertices is beyond its tolerance.
    pub max_share_beyond: f64,
    /// While vertices are watched, one that is placed counts as so many more beyond: the bi-cells around two places are
    /// computed again, which no cache holds.
    pub beyond_per_placed: f64,
    /// Vertices sampled before all tolerances are computed.
    pub sampled_vertices: u32,
    /// Tolerances are computed only if this share of the sampled vertices is within its own.
    pub min_share_within: f64,

    // Auto: other algorithms.
    /// Vertices that are swept in the time of a placement: where fewer than one in this number is staged, or has moved,
    /// these are placed.
    pub swept_per_placement: usize,
    /// Most commits rebuilt without trying to repair.
    pub max_rebuilds: u32,
    /// After one more repair that was too expensive, so many times as many commits are rebuilt as after the last one,
    /// and one more.
    pub rebuilds_growth: u32,
    /// After a repair that was too expensive, commits with more than this share of its failures are rebuilt. How many
    /// such commits follows from `max_rebuilds` and `rebuilds_growth`.
    pub share_too_many: f64,
    /// Vertices that move one at a time, at once or few in a commit, are counted in rounds of as many as there are.
    /// Tolerances are kept for them after a round of which this share changed no cell, and while this share is within.
    pub min_share_of_round: f64,
    /// While tolerances are kept, rounds are shorter by this factor: where they are of no use, every move is the more
    /// expensive for them.
    pub shorter_rounds: f64,

    // Repair.
    /// Rebuild when more than one vertex in this number would have to be placed after a sweep.
    pub rebuilt_per_placement: usize,
    /// A vertex taken back mends about this number of failures: where a sweep finds more than all that may be taken
    /// back mend, it ends at once.
    pub failures_per_placement: usize,
    /// Place all vertices that have moved, where these are few enough for that to cost less than a rebuild, when more
    /// facets and cells fail for each of them than this number. (Where they leave a lattice all of their facets fail.)
    pub failures_per_moved: f64,
    /// Rebuild when flips have evaluated this number of certificates per vertex, which takes as long, and what a
    /// rebuild would evaluate exactly. (Where nearly all cells change at once flips may be quadratic in their number:
    /// points on a sphere that becomes an ellipsoid.)
    pub certified_per_vertex: u64,
    /// Times that flips may be stuck before the triangulation is rebuilt.
    pub max_rounds: usize,
    /// Times that cells are untangled, each time with more vertices taken back before.
    pub max_untanglings: usize,

    /// Rebuild when more facets fail than this number for each finite cell, where the clusters of cells that hang
    /// together by what fails are small. Measured with lattices, face-centred ones, layers and grids with noise,
    /// sheared and back. In the plane flips are as fast on lattices; on a circle, where half a facet for each cell
    /// fails, they are not.
    pub max_failing: f64,
    /// Rebuild when more facets fail than this number for each finite cell, where the clusters of cells that hang
    /// together by what fails are large. Measured with spheres, spheres within each other and cylinders.
    pub max_failing_of_large: f64,
    /// A cluster of this number of cells is large.
    pub cells_of_large: f64,
    /// Rebuild when more facets fail than this number for each finite cell once leaping vertices are back, cells that
    /// are inverted still counted as well, unless there are ties: most are untangled, and for the others a vertex is
    /// placed.
    pub max_failing_with_inverted: f64,
    /// An inverted cell counts as this number of failing facets.
    pub failing_for_inverted: f64,
    /// There are ties where a sweep evaluates more than this number of signs exactly for each finite cell. (Random
    /// points need none, those of a sheared lattice about one.)
    pub exact_of_ties: f64,
    /// How many times the limit a sample has to find to be believed: about the error of a small one.
    pub sample_margin: f64,
    /// Exact evaluations of a rebuild for each one of a sweep, measured with sheared lattices.
    pub exact_per_swept: f64,
    /// With each doubling of what sites and cells take beyond `near_bytes` repair and placement take longer by this
    /// share of what they do where caches hold all, beside rebuilding, which reads them in order.
    pub slower_per_doubling: f64,
    /// Bytes of sites and cells below which that makes no difference.
    pub near_bytes: usize,
    /// Share of a build in parts that one thread does alone.
    pub built_alone: f64,
    /// Share of a repair that one thread does alone.
    pub repaired_alone: f64,
    /// Placing vertices is given up where, by what is counted, those left would cost more than this number of rebuilds.
    /// (Among ties in space placing takes several times as long as the counts tell.)
    pub max_placing: f64,
    /// Whether to give up placing is asked once this share of what a rebuild costs has been spent.
    pub min_share_spent: f64,

    // Watching, slack, and what regions have in common.
    /// With more than this share of the vertices beyond their tolerance, watching, where it is not chosen by auto,
    /// leaves the commit to repair.
    pub max_share_beyond_alone: f64,
    /// The fourth power of the tolerance below which a bi-cell is watched, in units of the squares of its vertices'
    /// steps and of its size.
    pub watched_share: f64,
    /// With more than this share of the cells past their deadlines, a sweep of everything is cheaper.
    pub max_share_expired: f64,
    /// With more than this share of the cells changed, all bi-cells are computed again.
    pub max_share_followed: f64,
    /// How far the static filter reaches beyond the vertices, as a share of their least extent: no tolerance is
    /// greater.
    pub margin: f64,
    /// The static filter's box only grows as vertices move. After this number of moves per vertex it is fitted again,
    /// which takes as long as a small part of one commit.
    pub moves_per_fit: u64,

    // Rebuilding, placement, edits.
    /// Sites are sorted when the mean distance of those next to each other has become so much greater: with less, they
    /// are sorted without need; with more the walks take longer than to sort.
    pub max_stride_ratio: f64,
    /// After a repair, cells are sorted again if this many times as many as there are have been replaced.
    pub replaced_to_sort: f64,
    /// Before the tolerances of all bi-cells are computed, cells are sorted again if this many times as many as there
    /// are have been replaced: the computation takes several times as long as sorting, and less where cells are sorted.
    pub replaced_to_sort_first: f64,
    /// Relocations between two calls of the monitor.
    pub relocations_per_call: usize,
    /// Vertices that are rebuilt in the time of a removal and an insertion: where more than one in this number is
    /// inserted or removed, all are rebuilt.
    pub rebuilt_per_edit: usize,
}

impl Constants {
    /// Whether so few of `n` vertices are staged, or have moved, that they are placed one by one.
    pub(super) fn are_few(&self, some: usize, n: usize) -> bool {
        some * self.swept_per_placement < n
    }
}

/// The constants of reading cells, the same in both dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// When more than this share of the slots has changed, all are compared.
    pub max_share_listed: f64,
    /// Scanning the bits of this number of numbers takes as long as sorting one.
    pub scanned_per_sorted: usize,
    /// From this number on, lost cells are listed by their lowest corner.
    pub min_cells_listed: usize,
    /// Lost cells are not listed by their lowest corner if ids are more than this many times as many.
    pub max_ids_per_cell: usize,
    /// Lost cells are not listed by their lowest corner if more than this number have the same one: a search goes
    /// through all of these.
    pub max_cells_per_corner: u32,
}

/// The constants of both dimensions, and of reading cells.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// In the plane.
    pub plane: Constants,
    /// In space.
    pub space: Constants,
    /// Of reading cells, in both dimensions.
    pub reading: Reading,
}

const PLANE: Constants = Constants {
    costs: Costs {
        watched: 5.0,
        beyond: 1000.0,
        sweep: 11.0,
        slack: None,
        used_up: 0.0,
        computed: 90.0,
        rebuilt: 150.0,
        placed: 1050.0,
        certified: 20.0,
        exact: 80.0,
    },
    min_wait_commits: 16,
    max_wait_commits: 256,
    wait_growth: 2,
    weight_of_last: 0.25,
    vertices_per_change: 1500.0,
    vertices_per_change_to_watch: 4000.0,
    rarer_changes: 3.0,
    vertices_per_used_up_to_watch: 60,
    max_excess: 0.25,
    max_imbalance: 2.0,
    max_share_beyond: 0.125,
    beyond_per_placed: 3.0,
    sampled_vertices: 64,
    min_share_within: 0.8,
    swept_per_placement: 15,
    max_rebuilds: 15,
    rebuilds_growth: 2,
    share_too_many: 0.5,
    min_share_of_round: 0.85,
    shorter_rounds: 8.0,
    rebuilt_per_placement: 12,
    failures_per_placement: 3,
    failures_per_moved: 3.5,
    certified_per_vertex: 8,
    max_rounds: 8,
    max_untanglings: 4,
    max_failing: 0.3,
    max_failing_of_large: 0.3,
    cells_of_large: 7.0,
    max_failing_with_inverted: 0.37,
    failing_for_inverted: 3.0,
    exact_of_ties: 0.1,
    sample_margin: 1.25,
    exact_per_swept: 4.0,
    slower_per_doubling: 0.11,
    near_bytes: 4 << 20,
    built_alone: 0.12,
    repaired_alone: 0.3,
    max_placing: 2.0,
    min_share_spent: 1.0 / 16.0,
    max_share_beyond_alone: 0.25,
    watched_share: 1.0,
    max_share_expired: 1.0 / 3.0,
    max_share_followed: 1.0 / 3.0,
    margin: 1.0 / 16.0,
    moves_per_fit: 64,
    max_stride_ratio: 1.7,
    replaced_to_sort: 2.0,
    replaced_to_sort_first: 0.5,
    relocations_per_call: 256,
    rebuilt_per_edit: 8,
};

const SPACE: Constants = Constants {
    costs: Costs {
        watched: 20.0,
        beyond: 7000.0,
        sweep: 60.0,
        slack: Some(18.0),
        used_up: 100.0,
        computed: 500.0,
        rebuilt: 1200.0,
        placed: 9500.0,
        certified: 30.0,
        exact: 135.0,
    },
    vertices_per_change: 250.0,
    vertices_per_change_to_watch: 8000.0,
    max_imbalance: 4.0,
    rebuilt_per_placement: 13,
    failures_per_placement: 12,
    failures_per_moved: 5.0,
    certified_per_vertex: 80,
    max_failing: 0.7,
    max_failing_with_inverted: 0.72,
    failing_for_inverted: 22.0,
    max_failing_of_large: 0.03,
    exact_per_swept: 2.0,
    max_placing: 1.0,
    watched_share: 0.1,
    ..PLANE
};

/// The constants as they are.
pub static TABLE: Table = Table {
    plane: PLANE,
    space: SPACE,
    reading: Reading {
        max_share_listed: 0.5,
        scanned_per_sorted: 256,
        min_cells_listed: 1 << 12,
        max_ids_per_cell: 8,
        max_cells_per_corner: 256,
    },
};

/// The constants of a dimension.
#[inline(always)]
pub(super) fn constants<G: Dimension>() -> &'static Constants {
    if G::D == 2 { &in_force().plane } else { &in_force().space }
}

/// The constants of reading cells.
#[inline(always)]
pub(super) fn reading() -> &'static Reading {
    &in_force().reading
}

#[cfg(not(feature = "internals"))]
#[inline(always)]
fn in_force() -> &'static Table {
    &TABLE
}

#[cfg(feature = "internals")]
#[inline(always)]
fn in_force() -> &'static Table {
    trial::IN_FORCE.get()
}

/// Other values, to be measured.
#[cfg(feature = "internals")]
pub mod trial {
    use std::cell::Cell;

    use super::{TABLE, Table};

    thread_local! {
        pub(super) static IN_FORCE: Cell<&'static Table> = const { Cell::new(&TABLE) };
    }

    /// From now on the calling thread decides by these.
    pub fn put_in_force(table: &'static Table) {
        IN_FORCE.set(table);
    }
}
