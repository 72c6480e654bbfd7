//! Regular triangulations by definition, in exact integers: small ones enumerated, larger ones looked at cell by cell.

use crate::common::exact::{Grid, determinant, is_inside_lifted, orientation, subsets};
use crate::common::{CellSet, assert_same_cells, cell_set, check_adjacency, sorted};
use deldrift::internals::PowerPlane;
use deldrift::motion::{Level, MovingTriangulation, NO_CELL, Options};
use deldrift::{CellId, Moving, VertexId};

/// Sets of at most so many places are enumerated.
const ENUMERATED: usize = 14;

/// Vertices by id, as integers: coordinates, and then the weight; `None` where one has been removed.
pub type Points = Vec<Option<Vec<i64>>>;

pub fn to_point<G: Moving>(numbers: &[i64]) -> G::Point {
    let mut p = G::Point::default();
    (0..=G::D).for_each(|k| p[k] = numbers[k] as f64);
    p
}

/// Those that are hidden by weight, and not by place.
pub fn by_weight<G: Moving>(t: &MovingTriangulation<G>) -> Vec<VertexId> {
    t.hidden_by_weight().expect("room").into_iter().map(|(v, _)| v).collect()
}

/// Places with the heights above them, of those vertices that represent their place.
struct Lifted {
    ids: Vec<VertexId>,
    /// By the place in `ids`.
    places: Vec<Grid>,
    lifts: Vec<i128>,
}

impl Lifted {
    fn of(d: usize, points: &Points) -> (Self, Vec<(VertexId, VertexId)>) {
        let numbers = |v: VertexId| points[v.index()].as_ref().expect("present");
        let present: Vec<VertexId> =
            VertexId::range(0..points.len()).filter(|&v| points[v.index()].is_some()).collect();
        let representative = |v: VertexId| {
            let there = present.iter().copied().filter(|&w| numbers(w)[..d] == numbers(v)[..d]);
            there.min_by_key(|&w| (-numbers(w)[d], w)).expect("itself")
        };
        let by_place = present.iter().map(|&v| (v, representative(v))).filter(|&(v, w)| v != w).collect();
        let ids: Vec<VertexId> = present.iter().copied().filter(|&v| representative(v) == v).collect();
        let places: Vec<Grid> = ids.iter().map(|&v| numbers(v)[..d].to_vec()).collect();
        let square = |p: &Grid| p.iter().map(|&x| i128::from(x).pow(2)).sum::<i128>();
        let lifts = ids.iter().zip(&places).map(|(&v, p)| square(p) - i128::from(numbers(v)[d])).collect();
        (Lifted { ids, places, lifts }, by_place)
    }

    /// These places in as many of their coordinates as they span dimensions.
    fn spanned(&self, d: usize) -> Vec<Grid> {
        let axes: Vec<VertexId> = VertexId::range(0..d).collect();
        let along = |axes: &[VertexId]| -> Vec<Grid> {
            self.places.iter().map(|p| axes.iter().map(|k| p[k.index()]).collect()).collect()
        };
        let spans = |places: &[Grid]| {
            let k = places.first().map_or(0, Vec::len);
            // A simplex is found corner by corner, each off the flat of those before.
            let mut chosen: Vec<usize> = (0..places.len().min(1)).collect();
            for i in 1..places.len() {
                let rank = chosen.len();
                let is_off = subsets(&VertexId::range(0..k).collect::<Vec<_>>(), rank).iter().any(|axes| {
                    let on = |i: usize| axes.iter().map(|a| places[i][a.index()]).collect::<Grid>();
                    let all: Vec<Grid> = chosen.iter().copied().chain([i]).map(on).collect();
                    orientation(&all.iter().collect::<Vec<_>>()) != 0
                });
                if rank <= k && is_off {
                    chosen.push(i);
                }
            }
            chosen.len() == k + 1
        };
        let by_size = (0..=d).rev().flat_map(|k| subsets(&axes, k));
        by_size.map(|axes| along(&axes)).find(|places| spans(places)).unwrap_or_default()
    }

    /// All simplices of the places that no other one is below, in the dimension that they span.
    fn lower_hull(&self, places: &[Grid]) -> CellSet {
        let k = places.first().map_or(0, Vec::len);
        let all: Vec<VertexId> = VertexId::range(0..places.len()).collect();
        let is_cell = |cell: &Vec<VertexId>| {
            let corners: Vec<usize> = cell.iter().map(|i| i.index()).collect();
            orientation(&corners.iter().map(|&i| &places[i]).collect::<Vec<_>>()) != 0
                && (0..places.len())
                    .filter(|i| !corners.contains(i))
                    .all(|i| !self.is_below(&corners, i, places))
        };
        let cells = subsets(&all, k + 1).into_iter().filter(is_cell);
        cells.map(|cell| sorted(&cell.iter().map(|i| self.ids[i.index()]).collect::<Vec<_>>())).collect()
    }

    /// The cells of a plane in which all of many places are, across an axis of space.
    fn cells_in_plane(&self, spanned: &[Grid], name: &str) -> CellSet {
        let off = self.lifts[0] - self.places[0].iter().map(|&x| i128::from(x).pow(2)).sum::<i128>();
        let numbers = |(p, &lift): (&Grid, &i128)| -> Option<Vec<i64>> {
            let square: i128 = p.iter().map(|&x| i128::from(x).pow(2)).sum();
            let weight = i64::try_from(square - lift - off).expect("a small weight");
            Some(p.iter().copied().chain([weight]).collect())
        };
        let points: Points = spanned.iter().zip(&self.lifts).map(numbers).collect();
        let places: Vec<_> = points.iter().flatten().map(|p| to_point::<PowerPlane>(p)).collect();
        let t = MovingTriangulation::<PowerPlane>::new(&places, Options::default()).expect("a build");
        check(&t, &points, name);
        let named = |cell: &Vec<VertexId>| cell.iter().map(|v| self.ids[v.index()]).collect();
        cell_set(&t).iter().map(named).collect()
    }

    fn is_below(&self, corners: &[usize], i: usize, places: &[Grid]) -> bool {
        let all: Vec<usize> = corners.iter().copied().chain([i]).collect();
        let points: Vec<&Grid> = all.iter().map(|&i| &places[i]).collect();
        let lifts: Vec<i128> = all.iter().map(|&i| self.lifts[i]).collect();
        is_inside_lifted(&points, &lifts, &all.iter().map(|&i| self.ids[i]).collect::<Vec<_>>())
    }

    /// The cell that a hidden vertex is told to be above is the first one that has its place.
    fn check_below<G: Moving>(&self, t: &MovingTriangulation<G>, name: &str) {
        let corners = t.cells().expect("room").corners;
        let place = |v: VertexId| &self.places[self.ids.binary_search(&v).expect("a representative")];
        let has = |cell: &G::Vertices, v: VertexId| {
            (0..=G::D).all(|j| {
                let mut points: Vec<&Grid> = cell.as_ref().iter().map(|&w| place(w)).collect();
                points[j] = place(v);
                orientation(&points) >= 0
            })
        };
        for (v, cell) in t.hidden_by_weight().expect("room") {
            let first = corners.iter().position(|cell| has(cell, v)).map_or(CellId::NONE, CellId::at);
            assert_eq!(cell, first, "{name}: {v} is above it");
        }
    }

    /// Looks at all cells: no place is within the power sphere of one, and facets of one cell have all places on one
    /// side.
    fn check_cells<G: Moving>(&self, t: &MovingTriangulation<G>, name: &str) {
        let view = t.cells().expect("room");
        let at = |v: VertexId| self.ids.binary_search(&v).unwrap_or_else(|_| panic!("{name}: {v} in a cell"));
        for c in CellId::range(0..view.corners.len()) {
            let corners: Vec<usize> = view.corners[c].as_ref().iter().map(|&v| at(v)).collect();
            let from_first = |i: usize| -> Vec<i128> {
                let (p, o) = (&self.places[i], &self.places[corners[0]]);
                let along = p.iter().zip(o).map(|(x, y)| i128::from(x - y));
                along.chain([self.lifts[i] - self.lifts[corners[0]]]).collect()
            };
            let rows: Vec<Vec<i128>> = corners[1..].iter().map(|&i| from_first(i)).collect();
            // The hyperplane through the lifted corners, its last coefficient being the orientation.
            let coefficient = |k: usize| {
                let without = |row: &Vec<i128>| (0..=G::D).filter(|&j| j != k).map(|j| row[j]).collect();
                let minor = determinant(&rows.iter().map(without).collect::<Vec<_>>());
                if (k + G::D).is_multiple_of(2) { minor } else { -minor }
            };
            let plane: Vec<i128> = (0..=G::D).map(coefficient).collect();
            assert!(plane[G::D] > 0, "{name}: cell {c} is not positive");
            for i in (0..self.places.len()).filter(|i| !corners.contains(i)) {
                let above: i128 = from_first(i).iter().zip(&plane).map(|(x, a)| x * a).sum();
                let is_inside = above < 0 || above == 0 && self.is_below(&corners, i, &self.places);
                assert!(!is_inside, "{name}: {} is below cell {c}", self.ids[i]);
            }
            for j in (0..=G::D).filter(|&j| view.neighbours[c][j] == NO_CELL) {
                for i in 0..self.places.len() {
                    let mut points: Vec<&Grid> = corners.iter().map(|&k| &self.places[k]).collect();
                    points[j] = &self.places[i];
                    assert!(orientation(&points) >= 0, "{name}: {} is beyond the hull", self.ids[i]);
                }
            }
        }
    }
}

/// Whether cells and who is hidden, by place and by weight, are those of the definition.
pub fn check<G: Moving>(t: &MovingTriangulation<G>, points: &Points, name: &str) {
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{name}: {violation}"));
    let (lifted, by_place) = Lifted::of(G::D, points);
    assert_eq!(t.hidden_by_place().expect("room"), by_place, "{name}");
    let by_weight = by_weight(t);
    let mut in_no_cell: Vec<VertexId> =
        by_place.iter().map(|&(v, _)| v).chain(by_weight.iter().copied()).collect();
    in_no_cell.sort_unstable();
    assert_eq!(t.vertices_hidden_by_weight(), Ok(in_no_cell), "{name}");
    let sums = t.statistics_of_now().expect("room");
    assert_eq!(
        (sums.coincident as usize, sums.hidden_by_weight as usize),
        (by_place.len(), by_weight.len()),
        "{name}"
    );
    let found = cell_set(t);
    let spanned = lifted.spanned(G::D);
    let dimension = spanned.first().map_or(0, Vec::len);
    assert_eq!(found.is_empty(), dimension < G::D || spanned.is_empty(), "{name}");
    lifted.check_cells(t, name);
    lifted.check_below(t, name);
    check_adjacency(t, &|| name.to_string());
    let shown: CellSet = if dimension == 2 && dimension < G::D && spanned.len() > ENUMERATED {
        lifted.cells_in_plane(&spanned, name)
    } else if spanned.len() <= ENUMERATED || dimension < G::D {
        let hull = lifted.lower_hull(&spanned);
        if dimension == G::D {
            assert_same_cells(&found, &hull, || name.to_string());
        }
        hull
    } else {
        found
    };
    let is_corner = |v: &&VertexId| shown.iter().any(|cell| cell.contains(*v));
    let hidden: Vec<VertexId> = lifted.ids.iter().filter(|v| !is_corner(v)).copied().collect();
    assert_eq!(by_weight, hidden, "{name}");
    for v in VertexId::range(0..points.len()) {
        assert_eq!(t.is_present(v), points[v.index()].is_some(), "{name}: {v}");
    }
}
