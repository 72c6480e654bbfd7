//! Point sets that broke other codes, and a peer: published suites and real inputs, where they are at hand
//! (see `common/files.rs`), and the plane's triangulations by spade.

use crate::common::files::{Json, npy, text};
use crate::common::{
    CellSet, Rng, assert_same_cells, cell_set, check_adjacency, fresh_cells, point, sorted, vertex, vertices,
};
use deldrift::Error;
use deldrift::motion::{Algorithm, CoincidencePolicy, Level, MovingTriangulation, NO_CELL, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use spade::Triangulation;
use std::collections::{BTreeMap, HashSet, VecDeque};

fn points_of<G: Dimension>(rows: &[Vec<f64>]) -> Vec<G::Point> {
    rows.iter().map(|row| point::<G>(|k| row[k])).collect()
}

fn build<G: Dimension>(points: &[G::Point], name: &str) -> MovingTriangulation<G> {
    let t =
        MovingTriangulation::<G>::new(points, Options::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    if let Err(violation) = t.validate(Level::Delaunay) {
        panic!("{name}: {violation}");
    }
    check_adjacency(&t, &|| name.to_string());
    let bits = |p: &G::Point| p.as_ref().iter().map(|x| (x + 0.0).to_bits()).collect::<Vec<u64>>();
    let distinct = points.iter().map(bits).collect::<HashSet<_>>().len();
    assert_eq!(t.statistics().coincident as usize, points.len() - distinct, "{name}");
    let facets_on_hull = t
        .cells()
        .expect("room")
        .neighbours
        .iter()
        .map(|n| n.as_ref().iter().filter(|&&n| n == NO_CELL).count())
        .sum::<usize>();
    if G::D == 2 && t.cell_count() > 0 {
        assert_eq!(t.cell_count() + 2 + facets_on_hull, 2 * distinct, "{name}: Euler's formula");
    }
    t
}

/// Small balls at random places.
fn clusters<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let centres: Vec<G::Point> = (0..20).map(|_| point::<G>(|_| rng.unit())).collect();
    (0..n).map(|i| point::<G>(|k| centres[i % 20][k] + 1e-4 * (rng.unit() - 0.5))).collect()
}

/// Denser and denser towards the origin.
fn graded<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let place = |rng: &mut Rng| {
        let radius = 10f64.powf(-6.0 * rng.unit());
        point::<G>(|_| radius * (rng.unit() - 0.5))
    };
    (0..n).map(|_| place(rng)).collect()
}

/// A lattice, each coordinate off by up to this.
fn noisy_lattice<G: Dimension>(n: usize, noise: f64, rng: &mut Rng) -> Vec<G::Point> {
    let side = (n as f64).powf(1.0 / G::D as f64) as usize;
    let steps = |i: usize, k: usize| i / side.pow(k as u32) % side;
    (0..side.pow(G::D as u32))
        .map(|i| point::<G>(|k| steps(i, k) as f64 + noise * (rng.unit() - 0.5)))
        .collect()
}

/// Builds large enough to find out that the static bound decides little, at sizes where the bounds of cells by lengths
/// hold, and where these are too small and too large for them.
fn many_scales_are_triangulated<G: Dimension>() {
    let rng = &mut Rng::new(1);
    let sets = [
        ("clusters", clusters::<G>(3_000, rng)),
        ("graded", graded::<G>(3_000, rng)),
        ("noise of 1e-12", noisy_lattice::<G>(3_500, 1e-12, rng)),
        ("noise of 1e-15", noisy_lattice::<G>(3_500, 1e-15, rng)),
    ];
    for (name, points) in sets {
        for exponent in [0, -90, -110, -300, 40, 140] {
            let size = 2f64.powi(exponent);
            let scaled: Vec<G::Point> = points.iter().map(|p| point::<G>(|k| size * p[k])).collect();
            build::<G>(&scaled, &format!("{name}, 2^{exponent}"));
        }
    }
}

#[test]
fn many_scales_are_triangulated_in_the_plane() {
    many_scales_are_triangulated::<Plane>();
}

#[test]
fn many_scales_are_triangulated_in_space() {
    many_scales_are_triangulated::<Space>();
}

/// Every vertex moves to the place of the next one and back, by each algorithm; the cells follow exactly.
fn goes_around<G: Dimension>(points: &[G::Point], name: &str) {
    let mut t = build::<G>(points, name);
    let cells = cell_set(&t);
    let mut shifted = points.to_vec();
    shifted.rotate_left(1);
    let shifted_cells = fresh_cells::<G>(&shifted.iter().copied().map(Some).collect::<Vec<_>>());
    for algorithm in Algorithm::ALL {
        t.set_algorithm(algorithm);
        for (to, expected) in [(&shifted[..], &shifted_cells), (points, &cells)] {
            t.move_all(to).expect("moves");
            t.commit_timestamp().expect("a commit");
            assert_same_cells(&cell_set(&t), expected, || format!("{name}, {algorithm:?}"));
        }
    }
    if let Err(violation) = t.validate(Level::Delaunay) {
        panic!("{name}: {violation}");
    }
}

#[test]
fn delaunator_fixtures() {
    for name in [
        "ukraine",
        "issue13",
        "issue43",
        "issue44",
        "robustness1",
        "robustness2",
        "robustness3",
        "robustness4",
    ] {
        let Some(json) = text(&format!("suites/delaunator/{name}.json")) else { return };
        goes_around::<Plane>(&points_of::<Plane>(&Json::parse(&json).table()), name);
    }
}

#[test]
fn ukraine_has_as_many_triangles_as_published() {
    let Some(json) = text("suites/delaunator/ukraine.json") else { return };
    let mut t = build::<Plane>(&points_of::<Plane>(&Json::parse(&json).table()), "ukraine");
    assert_eq!(t.cell_count(), 1711);
    for algorithm in Algorithm::ALL {
        let home = t.position(vertex(0)).expect("present");
        for (place, count) in [([80.0, 220.0], 1713), (home, 1711)] {
            t.set_algorithm(algorithm);
            t.move_vertices(&[vertex(0)], &[place]).expect("a move");
            t.commit_timestamp().expect("a commit");
            assert_eq!(t.cell_count(), count, "{algorithm:?}");
        }
    }
}

#[test]
fn inline_cases_of_other_codes() {
    let Some(json) = text("suites/inline_cases_2d.json") else { return };
    let cases = Json::parse(&json);
    assert_eq!(cases.list().len(), 37);
    for case in cases.list() {
        let name = case.get("name").expect("a name").text();
        let points = points_of::<Plane>(&case.get("points").expect("points").table());
        let t = build::<Plane>(&points, name);
        let distinct = case.get("distinct").expect("a count").number();
        assert_eq!((points.len() - t.statistics().coincident as usize) as f64, distinct, "{name}");
        if let Some(dimension) = case.get("expect_dim") {
            assert_eq!(t.cell_count() > 0, dimension.number() == 2.0, "{name}");
        }
        if let (Some(triangles), Some(Json::Truth(true))) = (case.get("exact_triangles"), case.get("unique"))
        {
            let ids =
                |row: &Vec<f64>| sorted(&row.iter().map(|&x| VertexId::new(x as u32)).collect::<Vec<_>>());
            let expected: CellSet = triangles.table().iter().map(ids).collect();
            assert_same_cells(&cell_set(&t), &expected, || name.to_string());
        }
        goes_around::<Plane>(&points, name);
    }
}

#[test]
fn issue_cases_of_other_codes() {
    let Some(json) = text("suites/issue_cases.json") else { return };
    for case in Json::parse(&json).list() {
        let Some(points) = case.get("points") else { continue };
        let (name, rows) = (case.get("name").expect("a name").text(), points.table());
        let dimension = case.get("dim").expect("a dimension").number();
        let n_cells = if dimension == 2.0 {
            goes_around::<Plane>(&points_of::<Plane>(&rows), name);
            build::<Plane>(&points_of::<Plane>(&rows), name).cell_count()
        } else {
            goes_around::<Space>(&points_of::<Space>(&rows), name);
            build::<Space>(&points_of::<Space>(&rows), name).cell_count()
        };
        let expected = case.get("expect_dim").map_or(dimension, Json::number);
        assert_eq!(n_cells > 0, expected == dimension, "{name}");
    }
}

/// geotrellis 1755: points (v, v), collinear whatever the rounding of v.
#[test]
fn decimal_points_on_the_diagonal_are_collinear() {
    let points: Vec<[f64; 2]> = (0..=100).map(|k| f64::from(k) / 100.0).map(|v| [v, v]).collect();
    assert_eq!(build::<Plane>(&points, "diagonal").cell_count(), 0);
    goes_around::<Plane>(&points, "diagonal");
}

/// delaunator 61: the unit squares of a rotated grid are halved, and only slivers of the hull are not.
#[test]
fn a_rotated_grid_keeps_its_squares() {
    for degree in 0..360 {
        let (sin, cos) = f64::from(degree).to_radians().sin_cos();
        let grid: Vec<[f64; 2]> = (0..64).map(|i| [f64::from(i % 8), f64::from(i / 8)]).collect();
        let points: Vec<[f64; 2]> =
            grid.iter().map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect();
        let t = build::<Plane>(&points, "rotated grid");
        let mut halves = 0;
        for corners in t.cells().expect("room").corners {
            let [a, b, c] = corners.map(|v| grid[v]);
            let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            halves += usize::from(area == 0.5);
            let is_along_a_side = (0..2).any(|k| [0.0, 7.0].contains(&a[k]) && a[k] == b[k] && a[k] == c[k]);
            assert!(area == 0.5 || is_along_a_side, "{degree} degrees: {corners:?}");
        }
        assert_eq!(halves, 98, "{degree} degrees");
    }
}

/// CGAL 9601: a hexagonal lattice in doubles has flat and nearly flat cells.
#[test]
fn a_hexagonal_lattice_in_space() {
    let mut points = Vec::new();
    for (i, j, k) in (0..343).map(|n| (f64::from(n % 7 - 3), f64::from(n / 7 % 7 - 3), f64::from(n / 49 - 3)))
    {
        points.push([i + 0.5 * j, 0.75f64.sqrt() * j, 1.6 * k]);
    }
    goes_around::<Space>(&points, "hexagonal lattice");
}

/// Geogram 108: cubes and octahedra, with and without a point in the middle.
#[test]
fn octahedra_and_cubes() {
    let cube: Vec<[f64; 3]> =
        (0..8).map(|i| std::array::from_fn(|k| if i >> k & 1 == 0 { -1.0 } else { 1.0 })).collect();
    let octahedron: Vec<[f64; 3]> = (0..6)
        .map(|i| std::array::from_fn(|k| if i / 2 != k { 0.0 } else { f64::from(i as u32 % 2) * 2.0 - 1.0 }))
        .collect();
    for middle in [[0.0; 3], [0.25, 0.0, 0.0], [1.0, 1.0, 0.0], [3.0, 3.0, 3.0]] {
        for shape in [&cube, &octahedron] {
            goes_around::<Space>(&[&shape[..], &[middle]].concat(), "a shape and a point");
        }
        goes_around::<Space>(&[&octahedron[..], &cube[..], &[middle]].concat(), "both and a point");
    }
}

/// CGAL 8347: insert, insert, remove either, insert.
#[test]
fn one_of_two_points_is_replaced() {
    for removed in [0, 1] {
        let mut t = build::<Plane>(&[[2.0, 3.0], [6.0, 3.0]], "two points");
        t.remove_vertex(VertexId::new(removed)).expect("present");
        t.insert_vertex(&[0.0, 4.0]).expect("an insertion");
        assert_eq!((t.vertex_count(), t.cell_count()), (2, 0));
        t.validate(Level::Delaunay).expect("valid");
    }
}

/// CGAL's moves through states of every dimension. A move onto an occupied place must name the vertex there.
fn cgal_moves<G: Dimension>(name: &str) {
    let Some(operations) = text(name) else { return };
    // Immediate, then as timestamps by each algorithm.
    for algorithm in [None].into_iter().chain(Algorithm::ALL.map(Some)) {
        let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&[], options).expect("an empty triangulation");
        t.set_algorithm(algorithm.unwrap_or_default());
        let mut ids: BTreeMap<String, VertexId> = BTreeMap::new();
        let mut positions: Vec<Option<G::Point>> = Vec::new();
        let mut count = 0;
        for line in operations.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty()) {
            let words: Vec<&str> = line.split_whitespace().collect();
            let (verb, vertex, dimension) = (words[0], words[1], words[2 + G::D]);
            let q = point::<G>(|k| words[2 + k].parse().expect("a coordinate"));
            let context = || format!("{name}, {algorithm:?}: {line}");
            let mut go = |id: VertexId| match algorithm {
                None => t.relocate_vertex(id, &q),
                Some(_) => {
                    t.move_vertices(&[id], &[q]).expect("a move");
                    t.commit_timestamp().map(|_| ()).inspect_err(|_| assert_eq!(t.discard_moves(), 1))
                }
            };
            match verb {
                "insert" => {
                    let id = t.insert_vertex(&q).unwrap_or_else(|e| panic!("{}: {e}", context()));
                    ids.insert(vertex.to_string(), id);
                    positions.push(Some(q));
                }
                "move" => {
                    let id = ids[vertex];
                    go(id).unwrap_or_else(|e| panic!("{}: {e}", context()));
                    positions[id] = Some(q);
                }
                "moveblocked" => {
                    let id = ids[vertex];
                    let there =
                        positions.iter().position(|p| *p == Some(q)).map(VertexId::at).expect("a vertex");
                    let expected = Err(Error::Coincident { vertex: id.min(there), other: id.max(there) });
                    assert_eq!(go(id), expected, "{}", context());
                }
                other => panic!("{other}: {}", context()),
            }
            if let Err(violation) = t.validate(Level::Delaunay) {
                panic!("{}: {violation}", context());
            }
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), context);
            if dimension != "-" {
                assert_eq!(t.cell_count() > 0, dimension == G::D.to_string(), "{}", context());
            }
            count += 1;
        }
        assert!(count >= 26, "{name}: {count} operations");
    }
}

#[test]
fn cgal_moves_in_the_plane() {
    cgal_moves::<Plane>("suites/cgal_move_2d.ops");
}

#[test]
fn cgal_moves_in_space() {
    cgal_moves::<Space>("suites/cgal_move_3d.ops");
}

/// Inserted one by one, then removed one by one, checked throughout.
fn comes_and_goes<G: Dimension>(points: &[G::Point], name: &str) {
    let mut t = MovingTriangulation::<G>::new(&[], Options::default()).expect("an empty triangulation");
    let mut positions = Vec::new();
    let every = points.len() / 30 + 1;
    for (i, q) in points.iter().enumerate() {
        t.insert_vertex(q).expect("an insertion");
        positions.push(Some(*q));
        if i % every == 0 {
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), || {
                format!("{name}: {i} inserted")
            });
        }
    }
    for i in 0..points.len() {
        t.remove_vertex(VertexId::at(i)).expect("present");
        positions[i] = None;
        if i % every == 0 {
            t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{name}: {i} removed: {v}"));
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), || {
                format!("{name}: {i} removed")
            });
        }
    }
}

#[test]
fn cgal_point_sets() {
    let Some(json) = text("suites/cgal_points.json") else { return };
    let sets = Json::parse(&json);
    for name in ["q22", "lp500", "lp2_64", "ten_points_delete_all"] {
        let points = points_of::<Space>(&sets.get(name).expect(name).table());
        goes_around::<Space>(&points, name);
        comes_and_goes::<Space>(&points, name);
    }
    let circle = points_of::<Plane>(&sets.get("circle325_2d").expect("a circle").table());
    goes_around::<Plane>(&circle, "circle325_2d");
    comes_and_goes::<Plane>(&circle, "circle325_2d");
}

/// CGAL's script: the first vertex of a queue moves to one of 22 places; where one is already, the two merge
/// into one, otherwise it goes to the end of the queue.
#[test]
fn cgal_moves_among_22_places() {
    let Some(json) = text("suites/cgal_points.json") else { return };
    let places = points_of::<Space>(&Json::parse(&json).get("q22").expect("q22").table());
    let mut t = build::<Space>(&places, "q22");
    let mut positions: Vec<_> = places.iter().copied().map(Some).collect();
    let mut queue: VecDeque<VertexId> = VertexId::range(0..places.len()).collect();
    for i in 0..100 {
        let v = queue.pop_front().expect("a vertex");
        let q = places[3 * i % places.len()];
        t.relocate_vertex(v, &q).expect("a relocation");
        let other = vertices().zip(&positions).find(|&(w, p)| w != v && *p == Some(q)).map(|(w, _)| w);
        positions[v] = Some(q);
        if let Some(other) = other {
            assert_eq!(t.coincident_representative(v), Ok(v.min(other)), "move {i}");
            t.remove_vertex(v).expect("present");
            positions[v] = None;
        } else {
            queue.push_back(v);
        }
        assert_eq!(t.vertex_count(), queue.len(), "move {i}");
        t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("move {i}: {violation}"));
        assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || format!("move {i}"));
    }
}

#[test]
fn gravity_stations_with_duplicates_and_lines() {
    let Some(rows) = npy("static/gravity_stations_3d.npy") else { return };
    let points = points_of::<Space>(&rows);
    assert_eq!(points.len(), 2194);
    let t = build::<Space>(&points, "gravity stations");
    assert_eq!(t.statistics().coincident, 10);
    goes_around::<Space>(&points, "gravity stations");
    goes_around::<Plane>(&points_of::<Plane>(&rows), "gravity stations, seen from above");
}

#[test]
fn terrain_on_an_almost_regular_grid() {
    let Some(rows) = npy("static/terrain_grid_3d.npy") else { return };
    assert_eq!(rows.len(), 18240);
    let t = build::<Space>(&points_of::<Space>(&rows), "terrain");
    assert!(t.cell_count() > 50_000);
    goes_around::<Plane>(&points_of::<Plane>(&rows), "terrain, seen from above");
}

/// spade is another code: of points in general position it has the same triangles.
#[test]
fn spade_has_the_same_triangles() {
    for (seed, n) in [3, 4, 5, 10, 100, 1000, 10_000].into_iter().enumerate() {
        for scale in [1.0, 1e-6, 1e6] {
            let rng = &mut Rng::new(seed as u64);
            let points: Vec<[f64; 2]> =
                (0..n).map(|_| [scale * rng.unit(), scale * (rng.unit() - 0.5)]).collect();
            let mut peer = spade::DelaunayTriangulation::<spade::Point2<f64>>::new();
            let mut id_of = BTreeMap::new();
            for (id, &[x, y]) in vertices().zip(&points) {
                id_of.insert(peer.insert(spade::Point2::new(x, y)).expect("a fine point").index(), id);
            }
            let ids = |f: spade::handles::FaceHandle<'_, spade::handles::InnerTag, _, _, _, _>| {
                sorted(&f.vertices().map(|v| id_of[&v.fix().index()]))
            };
            let expected: CellSet = peer.inner_faces().map(ids).collect();
            let t = build::<Plane>(&points, "random");
            assert_same_cells(&cell_set(&t), &expected, || format!("spade, {n} points, scale {scale}"));
        }
    }
}
