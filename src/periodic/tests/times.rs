//! What commits, edits and reading cost: `cargo test --lib -- --ignored --nocapture periodic::tests::times`.

use super::*;
use std::time::Instant;

/// What a build and a commit take, beside those of as many vertices in the open.
#[test]
#[ignore = "prints times"]
fn of_commits() {
    fn go<G: Moving>(n: usize, basis: &[G::Point]) {
        let rng = &mut Rng::new(1);
        let mut points = random_points::<G>(rng, n, basis);
        let start = Instant::now();
        let mut open = MovingTriangulation::<G>::new(&points, Options::default()).unwrap();
        open.cells().unwrap();
        let open_build = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
        let build = start.elapsed().as_secs_f64();
        let start = Instant::now();
        t.cell_count().unwrap();
        let cells = start.elapsed().as_secs_f64();
        println!(
            "{}D, {n}: build {:.1} ms, open {:.1} ms, cells {:.1} ms, {} images, {} cells, open {}",
            G::D,
            1e3 * build,
            1e3 * open_build,
            1e3 * cells,
            t.image_count(),
            t.cell_count().unwrap(),
            open.cell_count()
        );
        let spacing = (n as f64).powf(-1.0 / G::D as f64);
        for share in [1e-4, 1e-3, 1e-2] {
            for _ in 0..3 {
                for p in &mut points {
                    for axis in 0..G::D {
                        p[axis] += share * spacing * (rng.below(2001) as f64 / 1000.0 - 1.0);
                    }
                }
                let start = Instant::now();
                open.commit_positions(&points).unwrap();
                let open_commit = start.elapsed().as_secs_f64();
                let start = Instant::now();
                t.commit_positions(&points).unwrap();
                println!(
                    "  {share}: {:.2} ms, open {:.2} ms, {} images",
                    1e3 * start.elapsed().as_secs_f64(),
                    1e3 * open_commit,
                    t.image_count()
                );
            }
        }
    }
    go::<Plane>(100_000, &[[1.0, 0.0], [0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.0]]);
}

/// What reading costs after a commit, and what a round costs that changes nothing.
#[test]
#[ignore = "prints times"]
fn of_reading() {
    fn go<G: Moving>(n: usize, basis: &[G::Point]) {
        let rng = &mut Rng::new(1);
        let mut points = random_points::<G>(rng, n, basis);
        let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
        let spacing = (n as f64).powf(-1.0 / G::D as f64);
        for _ in 0..8 {
            for p in &mut points {
                (0..G::D)
                    .for_each(|axis| p[axis] += 1e-3 * spacing * (rng.below(2001) as f64 / 1000.0 - 1.0));
            }
            let timed = |read: &mut dyn FnMut()| {
                let start = Instant::now();
                read();
                1e3 * start.elapsed().as_secs_f64()
            };
            let commit = timed(&mut || _ = t.commit_positions(&points).unwrap());
            let cells = timed(&mut || _ = t.cell_count().unwrap());
            let edges = timed(&mut || _ = t.edge_count().unwrap());
            let prepared = timed(&mut || _ = t.prepare_timestamp().unwrap());
            let withdrawn = timed(&mut || t.withdraw_timestamp());
            println!(
                "{}D: commit {commit:.1} ms, cells {cells:.1}, edges {edges:.1}, an empty round {prepared:.1}, withdrawn {withdrawn:.1}",
                G::D
            );
        }
    }
    go::<Plane>(100_000, &[[1.0, 0.0], [0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

/// What edits cost, and commits with edits and moves of all.
#[test]
#[ignore = "prints times"]
fn of_edits() {
    fn go<G: Moving>(n: usize, basis: &[G::Point]) {
        let rng = &mut Rng::new(1);
        let mut points = random_points::<G>(rng, n, basis);
        let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
        let mut open = MovingTriangulation::<G>::new(&points, Options::default()).unwrap();
        for count in [1, 1, 10, 100, 1000, n / 25, n / 12] {
            let (coming, n_ids) = (random_points::<G>(rng, count, basis), points.len());
            points.extend(&coming);
            // Ids of none may be among these, but no vertex twice.
            let going: Vec<VertexId> =
                (0..count).map(|k| VertexId::at(k * (n_ids / count))).filter(|&v| t.is_present(v)).collect();
            let timed = |commit: &mut dyn FnMut()| {
                let start = Instant::now();
                commit();
                1e3 * start.elapsed().as_secs_f64()
            };
            t.stage_insertions(&coming).unwrap();
            t.stage_removals(&going).unwrap();
            open.stage_insertions(&coming).unwrap();
            open.stage_removals(&going).unwrap();
            let mut report = None;
            let here = timed(&mut || report = Some(t.commit_timestamp().unwrap()));
            let there = timed(&mut || _ = open.commit_timestamp().unwrap());
            let builds = report.unwrap().rebuilds;
            println!("{}D, {count} come and go: {here:.2} ms, {builds} builds, open {there:.2} ms", G::D);
        }
    }
    go::<Plane>(100_000, &[[1.0, 0.0], [0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

/// What a round costs that is published, and one that is withdrawn, beside a commit of the same moves: by the median
/// of each.
#[test]
#[ignore = "prints times"]
fn of_rounds() {
    fn go<G: Moving>(n: usize, n_moved: usize, basis: &[G::Point]) {
        let rng = &mut Rng::new(1);
        let mut points = random_points::<G>(rng, n, basis);
        let mut boxes =
            [0; 3].map(|_| PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap());
        let spacing = (n as f64).powf(-1.0 / G::D as f64);
        let mut times = [0; 3].map(|_| Vec::new());
        for step in 0..60 {
            let first = rng.below(n - n_moved + 1);
            let moved = first..first + n_moved;
            for p in &mut points[moved.clone()] {
                (0..G::D)
                    .for_each(|axis| p[axis] += 1e-3 * spacing * (rng.below(2001) as f64 / 1000.0 - 1.0));
            }
            for ((t, times), ending) in boxes.iter_mut().zip(&mut times).zip(0..) {
                let vertices: Vec<VertexId> = VertexId::range(moved.clone()).collect();
                t.move_vertices(&vertices, &points[moved.clone()]).unwrap();
                let start = Instant::now();
                match ending {
                    0 => _ = t.commit_timestamp().unwrap(),
                    1 => {
                        t.prepare_timestamp().unwrap();
                        t.publish_timestamp().unwrap();
                    }
                    _ => {
                        t.prepare_timestamp().unwrap();
                        t.withdraw_timestamp();
                    }
                }
                if step >= 20 {
                    times.push(1e3 * start.elapsed().as_secs_f64());
                }
            }
        }
        let [commit, published, withdrawn] = times.map(|mut times| {
            times.sort_by(f64::total_cmp);
            times[times.len() / 2]
        });
        println!(
            "{}D, {n_moved} of {n}: commit {commit:.3} ms, published {:.2} times, withdrawn {:.2} times",
            G::D,
            published / commit,
            withdrawn / commit
        );
    }
    for n in [10_000, 100_000] {
        for n_moved in [1, 100, n] {
            go::<Plane>(n, n_moved, &[[1.0, 0.0], [0.0, 1.0]]);
            go::<Space>(n, n_moved, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        }
    }
}
