//! What the geometry of 100,000 random points costs, beside straightforward loops over the view: nanoseconds per cell,
//! or per vertex, or per place. Another number of points may be given. Also what circumspheres cost where few vertices
//! move: in one pass over all cells, and for those cells alone that are new or have a vertex that has moved.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::{Interpolation, MovingTriangulation, NO_CELL, Options, VertexValues};
use deldrift::{CellId, Dimension, Plane, Shape, Space, VertexId};
use std::hint::black_box;
use std::time::Instant;

/// The least time of some rounds, for each of `n`.
fn time<T>(n: usize, mut work: impl FnMut() -> T) -> f64 {
    let mut best = f64::MAX;
    for _ in 0..7 {
        let start = Instant::now();
        black_box(work());
        best = best.min(start.elapsed().as_secs_f64());
    }
    best * 1e9 / n as f64
}

fn show(name: &str, own: f64, loops: Option<f64>) {
    match loops {
        Some(loops) => println!("  {name:<34}{own:>9.1} ns{loops:>9.1} ns{:>7.2}x", loops / own),
        None => println!("  {name:<34}{own:>9.1} ns"),
    }
}

/// By Cramer's rule: the offset of the centre, and the determinant.
fn cramer<G: Dimension>(corners: &[G::Point]) -> ([f64; 3], f64) {
    let mut rows = [[0.0; 4]; 3];
    for (row, p) in rows.iter_mut().zip(&corners[1..]) {
        for axis in 0..G::D {
            row[axis] = p[axis] - corners[0][axis];
            row[3] += row[axis] * row[axis];
        }
    }
    let det = |a: usize, b: usize, c: usize| {
        if G::D == 2 {
            return rows[0][a] * rows[1][b] - rows[0][b] * rows[1][a];
        }
        let minor = |i: usize, j: usize| rows[i][b] * rows[j][c] - rows[i][c] * rows[j][b];
        rows[0][a] * minor(1, 2) - rows[1][a] * minor(0, 2) + rows[2][a] * minor(0, 1)
    };
    let whole = det(0, 1, 2);
    let centre = [det(3, 1, 2), det(0, 3, 2), if G::D == 2 { 0.0 } else { det(0, 1, 3) }];
    (centre.map(|x| x / (2.0 * whole)), whole)
}

fn of_cells<G: Dimension>(t: &MovingTriangulation<G>, positions: &[G::Point]) -> Vec<u8> {
    let view = t.cells().expect("room");
    let n = view.corners.len();
    let corners_of = |row: &G::Vertices| {
        let mut corners = [G::Point::default(); 4];
        corners.iter_mut().zip(row.as_ref()).for_each(|(p, &v)| *p = positions[v]);
        corners
    };
    let radius = |row: &G::Vertices| {
        let (offset, _) = cramer::<G>(&corners_of(row)[..=G::D]);
        offset.iter().map(|x| x * x).sum::<f64>()
    };
    let own = time(n, || t.circumspheres().expect("room").collect::<Vec<_>>());
    let loops = time(n, || {
        let sphere = |row| {
            let corners = corners_of(row);
            let (offset, _) = cramer::<G>(&corners[..=G::D]);
            let mut centre = corners[0];
            (0..G::D).for_each(|axis| centre[axis] += offset[axis]);
            (centre, offset.iter().map(|x| x * x).sum::<f64>())
        };
        view.corners.iter().map(sphere).collect::<Vec<_>>()
    });
    show("circumspheres, a cell", own, Some(loops));
    let own = time(n, || t.volumes().expect("room").collect::<Vec<_>>());
    let loops = time(n, || {
        view.corners.iter().map(|row| cramer::<G>(&corners_of(row)[..=G::D]).1).collect::<Vec<_>>()
    });
    show("volumes, a cell", own, Some(loops));
    let mut radii: Vec<f64> = t.circumspheres().expect("room").map(|(_, squared)| squared).collect();
    let (_, &mut median, _) = radii.select_nth_unstable_by(n / 2, f64::total_cmp);
    let own = time(n, || t.mask_by_circumradius(median).expect("room").map(u8::from).collect::<Vec<u8>>());
    let loops =
        time(n, || view.corners.iter().map(|row| u8::from(radius(row) <= median)).collect::<Vec<_>>());
    show("mask_by_circumradius, a cell", own, Some(loops));
    let mask: Vec<u8> = t.mask_by_circumradius(median).expect("room").map(u8::from).collect();
    let own = time(n, || {
        let mut facets = Vec::new();
        t.mask_boundary(&mask, |facet| facets.push(facet)).expect("room");
        facets
    });
    let loops = time(n, || {
        let mut facets = Vec::new();
        for (cell, row) in view.neighbours.iter().enumerate().filter(|&(cell, _)| mask[cell] != 0) {
            for (corner, &across) in row.as_ref().iter().enumerate() {
                if across == NO_CELL || mask[across.index()] == 0 {
                    let mut facet = view.corners[cell].as_ref().to_vec();
                    facet.remove(corner);
                    facets.push((facet, cell, corner));
                }
            }
        }
        facets
    });
    show("mask_boundary of half, a cell", own, Some(loops));
    let own = time(n, || t.mirror_indices().expect("room").collect::<Vec<_>>());
    let loops = time(n, || {
        let mut mirrors = Vec::new();
        for (cell, row) in view.neighbours.iter().enumerate() {
            for &across in row.as_ref() {
                let back = || view.neighbours[across].as_ref().iter().position(|c| c.index() == cell);
                mirrors.push(if across == NO_CELL { None } else { back() });
            }
        }
        mirrors
    });
    show("mirror_indices, a cell", own, Some(loops));
    mask
}

fn of_vertices<G: Dimension>(t: &MovingTriangulation<G>) {
    let (view, n) = (t.cells().expect("room"), t.id_count());
    let own = time(n, || t.vertex_cells().expect("room"));
    let loops = time(n, || {
        let mut lists = vec![Vec::new(); n];
        for (cell, row) in view.corners.iter().enumerate() {
            row.as_ref().iter().for_each(|v| lists[v.index()].push(cell));
        }
        lists
    });
    show("vertex_cells, a vertex", own, Some(loops));
    let own = time(n, || t.vertex_neighbours().expect("room"));
    let loops = time(n, || {
        let mut lists = vec![Vec::new(); n];
        for row in view.corners {
            for &v in row.as_ref() {
                lists[v.index()].extend(row.as_ref().iter().copied().filter(|&w| w != v));
            }
        }
        for list in &mut lists {
            list.sort_unstable();
            list.dedup();
        }
        lists
    });
    show("vertex_neighbours, a vertex", own, Some(loops));
    let own = time(n, || t.edges().expect("room"));
    let loops = time(n, || {
        let mut edges = Vec::new();
        for row in view.corners {
            for &v in row.as_ref() {
                edges.extend(row.as_ref().iter().filter(|&&w| v < w).map(|&w| [v, w]));
            }
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    });
    show("edges, a vertex", own, Some(loops));
    let clip = [&[0.0; 3], &[1.0; 3]].map(|corner| {
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| p[axis] = corner[axis]);
        p
    });
    let clip = || Some([&clip[0], &clip[1]]);
    show("voronoi_volumes, a vertex", time(n, || t.voronoi_volumes(None).expect("room")), None);
    show("voronoi_volumes in a box, a vertex", time(n, || t.voronoi_volumes(clip()).expect("room")), None);
    show("voronoi_facets in a box, a vertex", time(n, || t.voronoi_facets(clip()).expect("room")), None);
}

/// Values from one set of vertices to places along a path.
fn of_places<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let values: Vec<f64> = (0..t.id_count()).map(|v| v as f64).collect();
    let places: Vec<G::Point> = VertexId::range(0..t.id_count())
        .map(|v| {
            let mut p = t.position(v).expect("present");
            (0..G::D).for_each(|axis| p[axis] += 1e-3 * (rng.unit() - 0.5));
            p
        })
        .collect();
    let given = VertexValues { values: &values, n_values: 1 };
    let mut sum = 0.0;
    for (name, method) in [
        ("interpolate, linear, a place", Interpolation::Linear),
        ("interpolate, natural, a place", Interpolation::NaturalNeighbour),
    ] {
        let own = time(places.len(), || {
            t.interpolate(method, given, &places, None, |row| sum += row.map_or(0.0, |row| row[0]))
        });
        show(name, own, None);
    }
    let own = time(places.len(), || {
        let mut found = Vec::new();
        t.locate_points(&places, None, |location| found.push(location)).expect("room");
        found
    });
    show("locate_points alone, a place", own, None);
    black_box(sum);
}

/// Circumcentre and squared circumradius.
type Sphere<G> = (<G as Shape>::Point, f64);

/// Circumspheres kept beside the cells.
struct Kept<G: Dimension> {
    spheres: Vec<Sphere<G>>,
    created: Vec<CellId>,
    set_aside: Vec<Sphere<G>>,
}

impl<G: Dimension> Kept<G> {
    /// Brings them up to date after a commit that has moved these vertices.
    fn update(&mut self, t: &mut MovingTriangulation<G>, moved: &[VertexId]) {
        let n = t.cell_count();
        let changes = t.take_changes().expect("room");
        self.set_aside.clear();
        self.set_aside.extend(changes.renumbered_from.iter().map(|&c| self.spheres[c]));
        self.spheres.resize(n, (G::Point::default(), 0.0));
        for (&c, &sphere) in changes.renumbered_to.iter().zip(&self.set_aside) {
            self.spheres[c] = sphere;
        }
        self.created.clear();
        self.created.extend_from_slice(changes.created);
        let around = t.cells_around(moved).expect("present");
        for list in [&self.created, &around] {
            for (&c, sphere) in list.iter().zip(t.circumspheres_of(list).expect("cells")) {
                self.spheres[c] = sphere;
            }
        }
    }

    fn is_up_to_date(&self, t: &MovingTriangulation<G>) -> bool {
        let is_near = |((centre, squared), (kept_centre, kept)): (Sphere<G>, &Sphere<G>)| {
            let most = 2e-9 * squared.sqrt() + 1e-15;
            let is_near = |axis| f64::abs(centre[axis] - kept_centre[axis]) <= most;
            (0..G::D).all(is_near) && (squared - kept).abs() <= 1e-8 * squared
        };
        let all = t.circumspheres().expect("room");
        all.len() == self.spheres.len() && all.zip(&self.spheres).all(is_near)
    }
}

/// Steps in which some vertices move: those near a corner of the cube, or here and there.
fn of_changes<G: Dimension>(mut positions: Vec<G::Point>, rng: &mut Rng) {
    let n = positions.len();
    let far = |p: &G::Point| p.as_ref().iter().map(|x| x * x).sum::<f64>();
    let mut nearest: Vec<VertexId> = VertexId::range(0..n).collect();
    nearest.sort_unstable_by(|&a, &b| far(&positions[a]).total_cmp(&far(&positions[b])));
    let mut scattered = nearest.clone();
    (1..n).for_each(|k| scattered.swap(k, (rng.unit() * (k + 1) as f64) as usize));
    let step = 0.1 / (n as f64).powf(1.0 / G::D as f64);
    println!("  circumspheres where a share of the vertices moves: a step, in microseconds");
    println!("  {:<20}{:>9}{:>9}{:>9}{:>9}{:>9}", "share", "commit", "pass", "update", "", "around");
    for (name, order) in [("together", &nearest), ("scattered", &scattered)] {
        for share in [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0] {
            let moved = &order[..(n as f64 * share) as usize];
            let mut t = MovingTriangulation::<G>::new(&positions, Options::default()).expect("good points");
            let spheres = t.circumspheres().expect("room").collect();
            let mut kept = Kept { spheres, created: vec![], set_aside: vec![] };
            let mut times = [f64::MAX; 4];
            t.take_changes().expect("room");
            for _ in 0..9 {
                for &v in moved {
                    (0..G::D).for_each(|axis| positions[v][axis] += step * (rng.unit() - 0.5));
                }
                let places: Vec<G::Point> = moved.iter().map(|&v| positions[v]).collect();
                let mut clock = Instant::now();
                let mut lap = |place: &mut f64| {
                    *place = place.min(clock.elapsed().as_secs_f64());
                    clock = Instant::now();
                };
                t.move_vertices(moved, &places).expect("good places");
                t.commit_timestamp().expect("room");
                t.cells().expect("room");
                lap(&mut times[0]);
                kept.update(&mut t, moved);
                lap(&mut times[2]);
                black_box(t.cells_around(moved).expect("present"));
                lap(&mut times[3]);
                let mut spheres = Vec::with_capacity(t.cell_count());
                spheres.extend(t.circumspheres().expect("room"));
                black_box(spheres);
                lap(&mut times[1]);
                assert!(kept.is_up_to_date(&t), "none is out of date");
            }
            let [commit, pass, update, around] = times.map(|seconds| seconds * 1e6);
            let times = pass / update;
            println!(
                "  {name:<10}{share:<10}{commit:>9.0}{pass:>9.0}{update:>9.0}{times:>8.2}x{around:>9.0}"
            );
        }
    }
}

fn run<G: Dimension>(n: usize) {
    let rng = &mut Rng::new(7);
    let positions: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(rng, 1.0)).collect();
    let t = MovingTriangulation::<G>::new(&positions, Options::default()).expect("good points");
    let n_cells = t.cells().expect("room").corners.len();
    println!("{}D, {n} points, {n_cells} cells{:>23}{:>12}", G::D, "library", "loop");
    of_cells(&t, &positions);
    of_vertices(&t);
    of_places(&t, rng);
    drop(t);
    of_changes::<G>(positions, rng);
}

fn main() {
    let n = std::env::args().nth(1).map_or(100_000, |n| n.parse().expect("a number of points"));
    run::<Plane>(n);
    run::<Space>(n);
}
