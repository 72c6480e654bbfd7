//! The numbers that decide between two ways to the same cells, and were measured.
//!
//! `make calibrate` measures every one of them: what the parts of a commit cost, and for a threshold what recorded
//! motions take with it and with other values. It prints each beside the measured one, and by how much the one here is
//! slower. Change one where that is clearly more than the noise printed next to it, twice.
//!
//! A triangulation has a reference to those by which it decides. Numbers with which another value, a few times as large
//! or small, makes no recorded motion slower by more than 1 % are not here, but beside the code that they are for.

use crate::delaunay::Moving;
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
    /// Weight of the last commit in the mean number of changes of a commit.
    pub weight_of_last: f64,
    /// The cheaper way is tried after commits with at most one flip or placement per this number of vertices.
    pub vertices_per_change: f64,
    /// Watching is tried without slack before it after commits with at most one flip or placement per this number of
    /// vertices.
    pub vertices_per_change_to_watch: f64,
    /// The cheaper way is given up when it has cost more than the other by this share of computing all tolerances.
    pub max_excess: f64,
    /// All tolerances are computed again when watched bi-cells have cost more or less than vertices beyond by this
    /// share of that.
    pub max_imbalance: f64,

    // Auto: other algorithms.
    /// Vertices that are swept in the time of a placement: where fewer than one in this number is staged, or has moved,
    /// these are placed.
    pub swept_per_placement: usize,

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
    /// Exact evaluations of a rebuild for each one of a sweep, measured with sheared lattices.
    pub exact_per_swept: f64,
    /// Placing vertices is given up where, by what is counted, those left would cost more than this number of rebuilds.
    /// (Among ties in space placing takes several times as long as the counts tell.)
    pub max_placing: f64,

    // Watching, slack, and what regions have in common.
    /// The fourth power of the tolerance below which a bi-cell is watched, in units of the squares of its vertices'
    /// steps and of its size.
    pub watched_share: f64,

    // Rebuilding, placement, edits.
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

/// The constants of both dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// In the plane.
    pub plane: Constants,
    /// In space.
    pub space: Constants,
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
    weight_of_last: 0.25,
    vertices_per_change: 1500.0,
    vertices_per_change_to_watch: 4000.0,
    max_excess: 0.25,
    max_imbalance: 2.0,
    swept_per_placement: 15,
    rebuilt_per_placement: 12,
    failures_per_placement: 3,
    failures_per_moved: 3.5,
    certified_per_vertex: 8,
    max_failing: 0.3,
    max_failing_of_large: 0.3,
    cells_of_large: 7.0,
    max_failing_with_inverted: 0.37,
    failing_for_inverted: 3.0,
    exact_per_swept: 4.0,
    max_placing: 2.0,
    watched_share: 1.0,
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
pub static TABLE: Table = Table { plane: PLANE, space: SPACE };

impl Table {
    /// The constants of a dimension.
    pub fn of<G: Moving>(&self) -> &Constants {
        if G::D == 2 { &self.plane } else { &self.space }
    }
}
