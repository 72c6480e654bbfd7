//! The same calls give the same answers, to the last bit and in the same order, on every processor, and, where the number of
//! parts is given or work is too little to be divided, on any number of threads: checksums of all that programs read, over
//! histories, compared with those recorded in `results/same`.
//!
//! Each history runs with the lanes of the processor and in a second process with those of numbers (`DELDRIFT_SCALAR`).
//! Those in parts run on one thread, two and three. `DELDRIFT_RECORD` writes the files again. A line of them is a history, a
//! step and a quantity.

use crate::common::inputs::{Kind, draw};
use crate::common::{Rng, point};
use deldrift::internals::use_all_threads;
use deldrift::motion::{
    Algorithm, Interpolation, MovingTriangulation, Options, Purpose, Quality, RefineOptions, Segment,
    VertexValues,
};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{CellId, Dimension, Plane, Space, VertexId};
use std::fmt::{Debug, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Says that a process is the second one.
const SECOND: &str = "DELDRIFT_SAME_SECOND";

/// Checksums by history, step and quantity, of histories with these options.
struct Sums {
    rows: Vec<(String, u64)>,
    threads: u32,
    parts: usize,
}

/// FNV-1a of what is written.
struct Sum(u64);

impl Write for Sum {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        for &byte in text.as_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        Ok(())
    }
}

impl Sums {
    /// Numbers are written such that those that differ in a bit do so.
    fn enter(&mut self, step: &str, quantity: &str, value: impl Debug) {
        let mut sum = Sum(0xcbf2_9ce4_8422_2325);
        write!(sum, "{value:?}").expect("nothing fails");
        self.rows.push((format!("{step} {quantity}"), sum.0));
    }

    fn options(&self, algorithm: Algorithm) -> Options {
        Options { algorithm, threads: self.threads, parts: self.parts, ..Options::default() }
    }
}

/// What programs read of cells: their order, and what is computed of them. `much` is for what takes long.
fn read<G: Dimension>(
    sums: &mut Sums,
    step: &str,
    t: &mut MovingTriangulation<G>,
    much: bool,
    rng: &mut Rng,
) {
    let mut enter = |quantity: &str, value: &dyn Debug| sums.enter(step, quantity, value);
    enter("statistics", &t.statistics());
    let changes = t.take_changes().expect("room");
    enter("changes", &changes);
    let cells = t.cells().expect("room");
    enter("corners", &cells.corners);
    enter("neighbours", &cells.neighbours);
    let (lower, upper) = (point::<G>(|_| -1e4), point::<G>(|_| 1e4));
    let places: Vec<G::Point> = (0..20)
        .map(|_| {
            let v = VertexId::new(rng.below(t.id_count()) as u32);
            let p = if t.is_present(v) { t.position(v).expect("present") } else { G::Point::default() };
            point::<G>(|k| p[k] + 0.3 * (rng.unit() - 0.5))
        })
        .collect();
    let located: Vec<_> = places.iter().map(|p| t.locate(p).expect("a place")).collect();
    enter("located", &located);
    let stars: Vec<Vec<CellId>> = VertexId::range(0..t.id_count())
        .filter(|&v| t.is_present(v))
        .take(40)
        .map(|v| {
            let mut star = Vec::new();
            t.star(v, &mut star).expect("present");
            star
        })
        .collect();
    enter("stars", &stars);
    enter("volumes", &t.volumes().expect("room").collect::<Vec<_>>());
    enter("circumspheres", &t.circumspheres().expect("room").collect::<Vec<_>>());
    if !much {
        return;
    }
    enter("voronoi volumes", &t.voronoi_volumes(Some([&lower, &upper])).expect("room"));
    enter("voronoi facets", &t.voronoi_facets(Some([&lower, &upper])).expect("room"));
    let cells = t.voronoi_cells([&lower, &upper], None, &mut |_| true).expect("room");
    enter("voronoi cells", &(cells.volumes, cells.areas, cells.centroids));
    let facets = t.voronoi_derivatives([&lower, &upper], None, &mut |_| true).expect("room");
    enter("derivatives", &(facets.edges, facets.areas, facets.centroids, facets.derivatives));
    enter("annulus widths", &t.annulus_widths().expect("room"));
    let values: Vec<f64> = (0..t.id_count()).map(|v| (v * v % 97) as f64 / 7.0).collect();
    for method in [Interpolation::Linear, Interpolation::NaturalNeighbour] {
        let given = VertexValues { values: &values, n_values: 1 };
        let mut found = Vec::new();
        t.interpolate(method, given, &places, None, |values| found.push(values.map(<[f64]>::to_vec)))
            .expect("values");
        enter(&format!("interpolated {method:?}"), &found);
    }
    let (mut near, mut around, mut in_conflict) = (Vec::new(), Vec::new(), Vec::new());
    t.nearest_vertices(&places, 6, |v| near.push(v)).expect("room");
    for p in &places {
        around.push(t.vertices_in_ball(p, 0.5).expect("room"));
        in_conflict.push(t.conflicts(p, None).expect("room"));
    }
    enter("nearest", &near);
    enter("in balls", &around);
    enter("conflicts", &in_conflict);
    enter("saved", &t.saved().expect("room"));
}

/// A history of commits and edits.
fn open<G: Dimension>(sums: &mut Sums, name: &str, points: &[G::Point], algorithm: Algorithm, steps: usize) {
    let (mut now, rng, options) = (points.to_vec(), &mut Rng::new(5), sums.options(algorithm));
    let mut t = MovingTriangulation::<G>::new(points, options).expect("points");
    read(sums, &format!("{name} built"), &mut t, steps < 3, rng);
    // Every vertex stays, or trembles, or a few go far.
    let sizes = [1e-6, 0.02, 0.0, 0.3, 0.01, 1.0, 0.03, 0.001];
    for (step, &size) in sizes.iter().enumerate().take(steps) {
        let few = step % 3 == 2;
        for p in &mut now {
            if !few || rng.one_in(20) {
                *p = point::<G>(|k| p[k] + size * (rng.unit() - 0.5));
            }
        }
        let report = t.commit_positions(&now).expect("a commit");
        sums.enter(&format!("{name} {step}"), "report", report);
        read(sums, &format!("{name} {step}"), &mut t, step % 4 == 3, rng);
    }
    for edit in 0..3 * steps {
        let v = VertexId::new(rng.below(now.len()) as u32);
        if !t.is_present(v) {
            continue;
        }
        let p = point::<G>(|k| now[v][k] + 0.1 * (rng.unit() - 0.5));
        match edit % 3 {
            0 => t.relocate_vertex(v, &p).expect("a place"),
            1 => t.remove_vertex(v).expect("a vertex"),
            _ => drop(t.insert_vertex(&p).expect("a place")),
        }
    }
    read(sums, &format!("{name} edited"), &mut t, true, rng);
    let mut t = t.try_clone(None).expect("room");
    t.compact().expect("room");
    read(sums, &format!("{name} compacted"), &mut t, false, rng);
}

/// Segments that move with a mesh, and refinement.
fn segments(sums: &mut Sums, name: &str, algorithm: Algorithm) {
    let (rng, options) = (&mut Rng::new(9), sums.options(algorithm));
    let mut now: Vec<[f64; 2]> = [[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]].to_vec();
    now.extend([[3.0, 3.0], [5.0, 3.0], [5.0, 5.0], [3.0, 5.5]]);
    now.extend((0..600).map(|_| [0.5 + 2.0 * rng.unit(), 0.5 + 7.0 * rng.unit()]));
    let mut t = MovingTriangulation::<Plane>::new(&now, options).expect("points");
    let chain = |first: u32, k: u32| [first + k, first + (k + 1) % 4].map(VertexId::new);
    let ends = (0..4).map(|k| chain(0, k)).chain((0..4).map(|k| chain(4, k)));
    let rows: Vec<Segment> = ends.map(|ends| Segment { ends, marker: 1, ..Segment::default() }).collect();
    t.stage_segments(rows.into_iter()).expect("present");
    t.commit_timestamp().expect("segments that do not cross");
    read(sums, &format!("{name} laid"), &mut t, true, rng);
    for step in 0..4 {
        for p in &mut now[4..] {
            *p = std::array::from_fn(|k| p[k] + 0.05 * (rng.unit() - 0.5));
        }
        let moved = t.commit_positions(&now);
        sums.enter(&format!("{name} {step}"), "report", &moved);
        sums.enter(&format!("{name} {step}"), "conflicts", t.conflicts_of_segments());
        read(sums, &format!("{name} {step}"), &mut t, false, rng);
    }
    let levels = t.nesting_levels().expect("room");
    let mask: Vec<u8> = levels.iter().map(|level| (level % 2) as u8).collect();
    let quality = Quality { least_angle: 25.0, greatest_area: 0.05, ..Quality::default() };
    let refined = t.refine(&quality, &RefineOptions { has_weights: true, ..RefineOptions::default() }, &mask);
    sums.enter(name, "refined", &refined);
    sums.enter(name, "weights", t.refined_weights());
    sums.enter(name, "sizes", t.refined_sizes());
    read(sums, &format!("{name} refined"), &mut t, true, rng);
    let now: Vec<[f64; 2]> = VertexId::range(0..t.id_count())
        .map(|v| t.position(v).expect("present"))
        .map(|[x, y]| [x + 0.01 * y * (8.0 - y), y])
        .collect();
    sums.enter(name, "sheared", t.commit_positions(&now));
    read(sums, &format!("{name} sheared"), &mut t, true, rng);
}

/// Vertices in a box that repeats.
fn in_box<G: Dimension>(sums: &mut Sums, n: usize) {
    let (name, rng, options) = (&format!("box of {n}"), &mut Rng::new(11), sums.options(Algorithm::Auto));
    let mut now: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let vectors: Vec<G::Point> = (0..G::D)
        .map(|i| {
            point::<G>(|k| {
                if k == i {
                    1.0
                } else if k < i {
                    0.25
                } else {
                    0.0
                }
            })
        })
        .collect();
    let mut t = PeriodicTriangulation::<G>::new(&now, &vectors, options).expect("points");
    for (step, size) in [0.0, 1e-4, 0.01, 0.0, 0.3, 0.002].into_iter().enumerate() {
        let step = format!("{name} {step}");
        if size > 0.0 {
            for p in &mut now {
                *p = point::<G>(|k| p[k] + size * (rng.unit() - 0.5));
            }
            sums.enter(&step, "report", t.commit_positions(&now));
        }
        sums.enter(&step, "changes", t.take_changes().expect("room"));
        let cells = t.cells().expect("room");
        sums.enter(&step, "cells", (cells.corners, cells.neighbours));
        sums.enter(&step, "shifts", t.cell_shifts().expect("room").collect::<Vec<_>>());
        sums.enter(&step, "edges", t.edges().expect("room").collect::<Vec<_>>());
        let mut volumes = Vec::new();
        t.for_volumes(None, |c, volume| volumes.push((c, volume))).expect("room");
        sums.enter(&step, "volumes", volumes);
        let mut spheres = Vec::new();
        t.for_circumspheres(None, |c, sphere| spheres.push((c, sphere))).expect("room");
        sums.enter(&step, "circumspheres", spheres);
        let mut cells = Vec::new();
        t.for_voronoi_cells(None, &mut |_| true, &mut |v, cell| {
            cells.push((v, cell.volume, cell.area, cell.centroid))
        })
        .expect("room");
        sums.enter(&step, "voronoi cells", cells);
        sums.enter(&step, "voronoi volumes", t.voronoi_volumes(&mut |_| true).expect("room"));
        let mut facets = Vec::new();
        t.for_voronoi_facets(None, &mut |_| true, &mut |e, facet| {
            facets.push((e, facet.area, facet.centroid, facet.derivatives))
        })
        .expect("room");
        sums.enter(&step, "derivatives", facets);
        sums.enter(&step, "saved", t.saved().expect("room"));
    }
    for k in 0..6 {
        let p = point::<G>(|_| rng.unit());
        if k % 2 == 0 {
            t.insert_vertex(&p).expect("a place");
        } else {
            t.remove_vertex(VertexId::new(rng.below(n) as u32)).ok();
        }
    }
    let cells = t.cells().expect("room");
    sums.enter(&format!("{name} edited"), "cells", (cells.corners, cells.neighbours));
    sums.enter(&format!("{name} edited"), "statistics", t.statistics());
}

/// The algorithms for use.
fn algorithms() -> impl Iterator<Item = Algorithm> {
    Algorithm::ALL.into_iter().filter(|algorithm| algorithm.row().purpose == Purpose::Use)
}

/// All histories of a dimension, on so many threads and with so many parts. In parts each algorithm has one kind of points.
fn histories<G: Dimension>(threads: u32, parts: usize) -> Sums {
    let mut sums = Sums { rows: Vec::new(), threads, parts };
    let kinds = [Kind::Random, Kind::Lattice, Kind::RoundedSphere, Kind::Clusters, Kind::Duplicates];
    for (k, algorithm) in algorithms().enumerate() {
        let own = if parts == 0 { 0..kinds.len() } else { k..k + 1 };
        for kind in &kinds[own] {
            let points = draw::<G>(*kind, 700, &mut Rng::new(1));
            open::<G>(&mut sums, &format!("{kind:?} {algorithm:?}"), &points, algorithm, 8);
        }
        if G::D == 2 {
            segments(&mut sums, &format!("segments {algorithm:?}"), algorithm);
        }
    }
    for n in if parts == 0 { &[3, 60, 500][..] } else { &[500] } {
        in_box::<G>(&mut sums, *n);
    }
    // So many that arrays are large, and sorted.
    let n = if G::D == 2 { 24_000 } else { 7_000 };
    let points = draw::<G>(Kind::Random, n, &mut Rng::new(2));
    open::<G>(&mut sums, "many", &points, Algorithm::Auto, if parts == 0 { 2 } else { 4 });
    sums
}

/// Which of the checksums are not those expected.
fn differences(found: &Sums, expected: &[(String, u64)]) -> Vec<String> {
    assert!(found.rows.iter().map(|(step, _)| step).eq(expected.iter().map(|(step, _)| step)));
    let pairs = found.rows.iter().zip(expected);
    pairs.filter(|(row, other)| row != other).map(|(_, (step, _))| step.clone()).collect()
}

/// Makes sure that checksums are those expected, and says which are not.
fn assert_same(found: &Sums, expected: &[(String, u64)]) {
    let differ = differences(found, expected);
    let first = &differ[..differ.len().min(12)];
    let (n, threads) = (expected.len(), found.threads);
    assert!(differ.is_empty(), "on {threads} threads {} of {n} differ, first {first:#?}", differ.len());
}

/// Compares histories in so many parts, on as many threads as are listed, with those recorded.
fn same<G: Dimension>(name: &str, parts: usize, threads: &[u32]) {
    let file = if parts == 0 { format!("{}d.csv", G::D) } else { format!("{}d_in_parts.csv", G::D) };
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/results/same").join(file);
    let is_second = std::env::var_os(SECOND).is_some();
    for &threads in threads {
        let found = histories::<G>(threads, parts);
        if std::env::var_os("DELDRIFT_RECORD").is_some() && !is_second && threads == 1 {
            let lines: String = found.rows.iter().map(|(step, sum)| format!("{step},{sum:016x}\n")).collect();
            std::fs::write(&path, format!("history,checksum\n{lines}")).expect("to be written");
        }
        assert_same(&found, &recorded_in(&path));
    }
    if is_second {
        return;
    }
    in_second_process(name, |second| match std::env::var_os("DELDRIFT_SCALAR") {
        Some(_) => second.env_remove("DELDRIFT_SCALAR"),
        None => second.env("DELDRIFT_SCALAR", "1"),
    });
}

/// Runs a test alone in a process of its own, in another environment.
fn in_second_process(name: &str, change: impl FnOnce(&mut Command) -> &mut Command) {
    let mut second = Command::new(std::env::current_exe().expect("this program"));
    second.args(["--exact", name]).env(SECOND, "1");
    let output = change(&mut second).output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && said.contains("1 passed"), "in a second process: {said}");
}

fn recorded_in(path: &Path) -> Vec<(String, u64)> {
    let lines = std::fs::read_to_string(path).expect("recorded");
    let row = |line: &str| {
        let (step, sum) = line.split_once(',').expect("two columns");
        (step.to_string(), u64::from_str_radix(sum, 16).expect("a checksum"))
    };
    lines.lines().skip(1).map(row).collect()
}

/// How many parts there are in the tests: more than most numbers of threads.
const PARTS: usize = 3;

#[test]
fn answers_in_the_plane_are_the_same_everywhere() {
    same::<Plane>("same::answers_in_the_plane_are_the_same_everywhere", 0, &[1]);
}

#[test]
fn answers_in_space_are_the_same_everywhere() {
    same::<Space>("same::answers_in_space_are_the_same_everywhere", 0, &[1]);
}

#[test]
fn answers_in_the_plane_in_parts_are_the_same_on_any_number_of_threads() {
    use_all_threads();
    let name = "same::answers_in_the_plane_in_parts_are_the_same_on_any_number_of_threads";
    same::<Plane>(name, PARTS, &[1, 2, 3, 5]);
}

#[test]
fn answers_in_space_in_parts_are_the_same_on_any_number_of_threads() {
    use_all_threads();
    let name = "same::answers_in_space_in_parts_are_the_same_on_any_number_of_threads";
    same::<Space>(name, PARTS, &[1, 2, 3, 5]);
}

/// Sets that are not quite large enough to be divided have one order on any number of threads, without a number of parts.
/// In a second process, as no other test may have asked for all threads there.
#[test]
fn small_sets_are_the_same_on_any_number_of_threads() {
    fn check<G: Dimension>(n: usize) {
        let on = |threads| {
            let mut sums = Sums { rows: Vec::new(), threads, parts: 0 };
            let points = draw::<G>(Kind::Random, n, &mut Rng::new(2));
            open::<G>(&mut sums, "small", &points, Algorithm::Auto, 3);
            in_box::<G>(&mut sums, 500);
            sums
        };
        let one = on(1);
        for threads in [2, 3] {
            assert_same(&on(threads), &one.rows);
        }
    }
    if std::env::var_os(SECOND).is_none() {
        let name = "same::small_sets_are_the_same_on_any_number_of_threads";
        return in_second_process(name, |second| second.env_remove("DELDRIFT_ALL_THREADS"));
    }
    check::<Plane>(9_900);
    check::<Space>(4_500);
}

/// What is compared tells orders and last bits apart: what is not divided shows in each kind of history.
#[test]
fn another_division_is_found() {
    fn check<G: Dimension>() {
        use_all_threads();
        let differ = differences(&histories::<G>(2, 1), &histories::<G>(2, PARTS).rows);
        let quantities =
            ["changes", "corners", "neighbours", "stars", "volumes", "circumspheres", "voronoi cells"];
        for quantity in quantities {
            assert!(differ.iter().any(|row| row.ends_with(quantity)), "{quantity} in {}D", G::D);
        }
        for history in ["Random", "many", "box of 500"] {
            assert!(differ.iter().any(|row| row.starts_with(history)), "{history} in {}D", G::D);
        }
        assert!(G::D == 3 || differ.iter().any(|row| row.starts_with("segments")));
    }
    check::<Plane>();
    check::<Space>();
}
