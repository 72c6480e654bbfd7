//! Delaunay triangulation by definition, in exact integers: slow, small, and independent of the library.
//!
//! A cell is a set of `D + 1` vertices, not in one hyperplane, whose sphere holds no other vertex. Ties are
//! broken by raising the lift of the vertex of id i by εᵢ, the highest id dominating: the in-sphere
//! determinant is linear in every lift, so its sign is that of the unperturbed determinant or, if that
//! vanishes, of the first cofactor of a lift that does not, from the highest id down.

use super::{CellSet, sorted};
use deldrift::{Moving, VertexId};

/// A point of integers.
pub type Grid = Vec<i64>;

/// As coordinates.
pub fn to_point<G: Moving>(p: &Grid) -> G::Point {
    super::point::<G>(|k| p[k] as f64)
}

/// Determinant by expansion along the first row.
pub fn determinant(rows: &[Vec<i128>]) -> i128 {
    if rows.is_empty() {
        return 1;
    }
    let minor = |skip: usize| -> Vec<Vec<i128>> {
        let without = |row: &Vec<i128>| (0..row.len()).filter(|&j| j != skip).map(|j| row[j]).collect();
        rows[1..].iter().map(without).collect()
    };
    (0..rows.len())
        .filter(|&j| rows[0][j] != 0)
        .map(|j| if j % 2 == 0 { 1 } else { -1 } * rows[0][j] * determinant(&minor(j)))
        .sum()
}

/// Orientation of `D + 1` points: the determinant of the differences to the first one.
pub fn orientation(points: &[&Grid]) -> i128 {
    let difference = |p: &&Grid| p.iter().zip(points[0]).map(|(x, o)| i128::from(x - o)).collect();
    determinant(&points[1..].iter().map(difference).collect::<Vec<Vec<i128>>>())
}

pub fn squared_distance(p: &Grid, q: &Grid) -> i128 {
    p.iter().zip(q).map(|(x, y)| i128::from(x - y).pow(2)).sum()
}

/// The sum of the squares of the coordinates.
fn lift(p: &Grid) -> i128 {
    p.iter().map(|&x| i128::from(x).pow(2)).sum()
}

/// Whether the last point is inside the sphere of the others, ties broken by id. The others are not in one
/// hyperplane; their order does not matter.
pub fn is_inside(points: &[&Grid], ids: &[VertexId]) -> bool {
    is_inside_lifted(points, &points.iter().map(|p| lift(p)).collect::<Vec<_>>(), ids)
}

/// Whether the last point is below the hyperplane of the others, each at a height of its own, ties broken by id: inside
/// their power sphere if heights are squares less weights.
pub fn is_inside_lifted(points: &[&Grid], lifts: &[i128], ids: &[VertexId]) -> bool {
    let last = points.len() - 1;
    let row = |(p, &lift): (&&Grid, &i128)| -> Vec<i128> {
        p.iter().map(|&x| i128::from(x)).chain([1, lift]).collect()
    };
    let rows: Vec<Vec<i128>> = points.iter().zip(lifts).map(row).collect();
    // The lift is the last column: cofactor of row i is the
    // determinant without row i and that column, signed.
    let cofactor = |i: usize| {
        let rows: Vec<Vec<i128>> =
            (0..rows.len()).filter(|&k| k != i).map(|k| rows[k][..rows.len() - 1].to_vec()).collect();
        if (i + last).is_multiple_of(2) { determinant(&rows) } else { -determinant(&rows) }
    };
    let mut by_id: Vec<usize> = (0..points.len()).collect();
    by_id.sort_by_key(|&i| std::cmp::Reverse(ids[i]));
    let value = std::iter::once(determinant(&rows)).chain(by_id.into_iter().map(cofactor)).find(|&x| x != 0);
    // Raising the last point far enough takes it outside: outside is the sign of its own cofactor.
    let outside = cofactor(last);
    assert_ne!(outside, 0, "a cell without volume");
    value.expect("some cofactor") > 0 && outside < 0 || value.expect("some cofactor") < 0 && outside > 0
}

/// For each vertex the lowest id at its place; `None` for removed vertices.
pub fn representatives<P: PartialEq>(positions: &[Option<P>]) -> Vec<Option<VertexId>> {
    let first = |p: &P| positions.iter().position(|q| q.as_ref() == Some(p)).expect("itself");
    positions.iter().map(|p| p.as_ref().map(first).map(VertexId::at)).collect()
}

/// All subsets of `k` of `items`.
pub fn subsets(items: &[VertexId], k: usize) -> Vec<Vec<VertexId>> {
    if k == 0 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for (i, &x) in items.iter().enumerate() {
        for mut rest in subsets(&items[i + 1..], k - 1) {
            rest.insert(0, x);
            all.push(rest);
        }
    }
    all
}

/// The cells of the Delaunay triangulation of the present vertices.
pub fn delaunay_cells(dimension: usize, positions: &[Option<Grid>]) -> CellSet {
    let at = |v: VertexId| positions[v].as_ref().expect("present");
    let representatives = representatives(positions);
    let places: Vec<VertexId> =
        VertexId::range(0..positions.len()).filter(|&v| representatives[v] == Some(v)).collect();
    let is_cell = |cell: &Vec<VertexId>| {
        orientation(&cell.iter().map(|&v| at(v)).collect::<Vec<_>>()) != 0
            && places.iter().filter(|v| !cell.contains(v)).all(|&v| {
                let ids: Vec<VertexId> = cell.iter().copied().chain([v]).collect();
                !is_inside(&ids.iter().map(|&v| at(v)).collect::<Vec<_>>(), &ids)
            })
    };
    subsets(&places, dimension + 1).into_iter().filter(is_cell).map(|c| sorted(&c)).collect()
}
