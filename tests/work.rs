//! How much work the algorithms take, in counts: files in `results/work`, one for each kind of input, with a row for
//! each algorithm, summed over a fixed history. They are the same on every processor.
//!
//! A change of the library that is for speed, or against it, changes counts. What has changed is printed, as a table; it
//! is a report, and no test fails for it. A test fails where one of the sums that users feel has grown by more than a
//! tenth: [`GATED`]. `make counts` prints the report, and `make counts RECORD=1` writes the files again.

use crate::common::inputs::{Kind, draw, on_spheres_within_each_other};
use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, point};
use deldrift::motion::{Algorithm, MovingTriangulation, Options, Purpose};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::{env, fs};

const HEADER: &str = "timestamp,moved,unchanged,placements,flips,rebuilds,within_tolerance,within_safe_region,\
    tolerances,certificates,exact_calls,coincident,inserted,removed";

/// The counts that cost time, each summed over the algorithms for use on one input; and how many more of it than recorded
/// are accepted whatever their share is, where the sum is small.
const GATED: [(&str, u64); 5] =
    [("certificates", 500), ("exact_calls", 50), ("flips", 50), ("placements", 50), ("rebuilds", 1)];

/// The counts of one input: by algorithm, and by the name of the count.
type Counts = BTreeMap<String, BTreeMap<String, u64>>;

/// A triangulation and its positions, none for what has been removed.
struct History<G: Dimension> {
    t: MovingTriangulation<G>,
    positions: Vec<Option<G::Point>>,
    rng: Rng,
}

impl<G: Dimension> History<G> {
    fn new(points: &[G::Point], algorithm: Algorithm) -> Self {
        let t =
            MovingTriangulation::new(points, Options { algorithm, ..Options::default() }).expect("a build");
        History { t, positions: points.iter().copied().map(Some).collect(), rng: Rng::new(3) }
    }

    /// Moves every `stride`-th vertex, and commits.
    fn commit(&mut self, stride: usize, mut motion: impl FnMut(&G::Point, &mut Rng) -> G::Point) {
        for (v, place) in VertexId::range(0..self.positions.len()).zip(&mut self.positions).step_by(stride) {
            if let Some(p) = place {
                *p = motion(p, &mut self.rng);
                self.t.move_vertices(&[v], &[*p]).expect("a place");
            }
        }
        self.t.commit_timestamp().expect("a commit");
    }

    fn tremble(&mut self, stride: usize, size: f64) {
        self.commit(stride, |p, rng| point::<G>(|k| p[k] + size * (rng.unit() - 0.5)));
    }

    fn random_present(&mut self) -> (usize, VertexId, G::Point) {
        loop {
            let v = self.rng.below(self.positions.len());
            if let Some(p) = self.positions[v] {
                return (v, VertexId::new(v as u32), p);
            }
        }
    }

    /// As [`tremble`](Self::tremble), of all vertices at once while none has been removed.
    fn tremble_all(&mut self, size: f64) {
        let mut places: Vec<G::Point> = self.positions.iter().copied().flatten().collect();
        for p in &mut places {
            *p = point::<G>(|k| p[k] + size * (self.rng.unit() - 0.5));
        }
        self.t.commit_positions(&places).expect("a commit");
        self.positions = places.into_iter().map(Some).collect();
    }

    /// Relocates, inserts and removes vertices one at a time.
    fn edit(&mut self, n: usize, size: f64) {
        for _ in 0..n {
            let (v, id, p) = self.random_present();
            let q = point::<G>(|k| p[k] + size * (self.rng.unit() - 0.5));
            self.t.relocate_vertex(id, &q).expect("a place");
            self.positions[v] = Some(q);
            let (_, _, p) = self.random_present();
            let q = point::<G>(|k| p[k] + size * self.rng.unit());
            self.t.insert_vertex(&q).expect("a place");
            self.positions.push(Some(q));
            let (v, id, _) = self.random_present();
            self.t.remove_vertex(id).expect("a vertex");
            self.positions[v] = None;
        }
    }

    /// Stages insertions and removals along with moves, and commits.
    fn replace(&mut self, n: usize, size: f64) {
        let mut places = Vec::new();
        for _ in 0..n {
            let (v, id, p) = self.random_present();
            self.t.stage_removals(&[id]).expect("a vertex");
            self.positions[v] = None;
            places.push(point::<G>(|k| p[k] + size * self.rng.unit()));
        }
        self.t.stage_insertions(&places).expect("places");
        self.positions.extend(places.into_iter().map(Some));
        self.t.commit_timestamp().expect("a commit");
    }

    fn run(&mut self, size: f64) -> String {
        self.commit(1, |p, _| *p);
        self.tremble(1, 1e-6 * size);
        self.tremble(1, 0.02 * size);
        self.commit(1, |p, _| *p);
        self.tremble_all(0.001 * size);
        self.tremble_all(0.02 * size);
        self.tremble(17, 0.4 * size);
        self.commit(1, |p, _| point::<G>(|k| p[k] + 0.25));
        self.commit(1, |p, _| point::<G>(|k| if k == 0 { p[0] + p[1] / 1024.0 } else { p[k] }));
        self.edit(12, 0.3 * size);
        self.replace(5, 0.3 * size);
        self.replace(60, 0.3 * size);
        self.tremble(1, 0.01 * size);
        assert_same_cells(&cell_set(&self.t), &fresh_cells::<G>(&self.positions), || "at the end".into());
        let r = self.t.statistics();
        let counts = [
            r.timestamp,
            r.moved,
            r.unchanged,
            r.placements,
            r.flips,
            r.rebuilds,
            r.within_tolerance,
            r.within_safe_region,
            r.tolerances,
            r.certificates,
            r.exact_calls,
            r.coincident,
            r.inserted,
            r.removed,
        ];
        counts.map(|count| count.to_string()).join(",")
    }
}

/// Compares the rows of an input in the file with those measured.
fn check<G: Dimension>(name: &str, points: &[G::Point]) {
    let widths = (0..G::D).map(|k| {
        let along = points.iter().map(|p| p[k]);
        along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
    });
    // A power of two, which any mathematical library computes.
    let volume = widths.product::<f64>() / points.len() as f64;
    let size = 2f64.powi((volume.log2() / G::D as f64).round() as i32);
    let name = format!("{}d_{name}", G::D);
    let mut found = String::new();
    for algorithm in Algorithm::ALL {
        let counts = History::<G>::new(points, algorithm).run(size);
        writeln!(found, "{algorithm:?},{counts}").expect("room");
    }
    let found = format!("algorithm,{HEADER}\n{found}");
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/results/work/{name}.csv"));
    let recorded = counts_of(&fs::read_to_string(&path).unwrap_or_default());
    if env::var_os("DELDRIFT_RECORD").is_some() {
        fs::write(&path, &found).expect("to be written");
    }
    let found = counts_of(&found);
    print!("{}", report(&name, &recorded, &found));
    let (sums, too_much) = compare_sums(&name, &recorded, &found);
    // What macros print is shown only where a test fails.
    io::stderr().write_all(sums.as_bytes()).expect("it can be told");
    assert!(too_much.is_empty() || env::var_os("DELDRIFT_RECORD").is_some(), "{too_much:#?}");
}

/// The counts of a file.
fn counts_of(file: &str) -> Counts {
    let mut lines = file.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().into_iter().flatten().skip(1).collect();
    let row = |mut line: std::str::Split<'_, char>| {
        let algorithm = line.next().expect("an algorithm").to_string();
        let counts = line.map(|count| count.parse().expect("a count"));
        (algorithm, names.iter().map(|name| name.to_string()).zip(counts).collect())
    };
    lines.map(row).collect()
}

fn percent(before: u64, now: u64) -> String {
    if before == 0 { "new".into() } else { format!("{:+.1} %", 100.0 * (now as f64 / before as f64 - 1.0)) }
}

/// A line for each count that is another than recorded: input, algorithm, count, before, now.
fn report(input: &str, recorded: &Counts, found: &Counts) -> String {
    let mut table = String::new();
    for (algorithm, counts) in found {
        for (count, &now) in counts {
            let before = recorded.get(algorithm).and_then(|row| row.get(count)).copied().unwrap_or(0);
            if before != now {
                let percent = percent(before, now);
                writeln!(table, "{input:28} {algorithm:20} {count:18} {before:9} {now:9} {percent:>9}")
                    .expect("room");
            }
        }
    }
    table
}

/// The sums of the gated counts: a line for each that is another than recorded, and those that have grown too much.
fn compare_sums(input: &str, recorded: &Counts, found: &Counts) -> (String, Vec<String>) {
    let (mut lines, mut too_much) = (String::new(), Vec::new());
    for (count, few) in GATED {
        let sum = |counts: &Counts| -> u64 {
            let for_use =
                Algorithm::ALL.into_iter().filter(|algorithm| algorithm.row().purpose == Purpose::Use);
            let row = |algorithm: Algorithm| counts.get(&format!("{algorithm:?}"))?.get(count).copied();
            for_use.filter_map(row).sum()
        };
        let (before, now) = (sum(recorded), sum(found));
        let line = format!("COUNTS {input}, {count}: {before}, now {now} ({})", percent(before, now));
        if before != now {
            lines += &format!("{line}\n");
        }
        if now > before + few.max(before / 10) {
            too_much.push(line);
        }
    }
    (lines, too_much)
}

#[test]
fn sums_may_grow_by_a_tenth_and_no_more() {
    let with = |flips: u64, rebuilds: u64, tolerances: u64| {
        counts_of(&format!("algorithm,flips,rebuilds,tolerances\nAuto,{flips},{rebuilds},{tolerances}\n"))
    };
    let too_much = |now: &Counts| compare_sums("planted", &with(1000, 3, 10), now).1.len();
    assert_eq!(too_much(&with(1100, 4, 10)), 0);
    assert_eq!(too_much(&with(1101, 4, 10)), 1);
    assert_eq!(too_much(&with(1101, 5, 10)), 2);
    assert_eq!(too_much(&with(0, 0, 99)), 0);
    assert_eq!(report("planted", &with(1000, 3, 10), &with(900, 3, 11)).lines().count(), 2);
    assert_eq!(report("planted", &with(1000, 3, 10), &with(1000, 3, 10)), "");
}

macro_rules! kinds {
    ($($name:ident: $kind:ident,)+) => {$(
        #[test]
        fn $name() {
            check::<Plane>(stringify!($name), &draw::<Plane>(Kind::$kind, 700, &mut Rng::new(1)));
            check::<Space>(stringify!($name), &draw::<Space>(Kind::$kind, 400, &mut Rng::new(1)));
        }
    )+};
}

kinds! {
    random: Random,
    lattices: Lattice,
    integer_spheres: Sphere,
    rounded_spheres: RoundedSphere,
    hyperplanes: Hyperplane,
    clusters: Clusters,
    duplicates: Duplicates,
}

/// All places of a lattice, the last coordinate scaled.
fn lattice<G: Dimension>(side: usize, last: f64) -> Vec<G::Point> {
    let place = |i: usize| {
        point::<G>(|k| (i / side.pow(k as u32) % side) as f64 * if k + 1 == G::D { last } else { 1.0 })
    };
    (0..side.pow(G::D as u32)).map(place).collect()
}

#[test]
fn whole_lattices() {
    check::<Plane>("whole_lattices", &lattice::<Plane>(24, 1.0));
    check::<Space>("whole_lattices", &lattice::<Space>(9, 1.0));
}

#[test]
fn layers() {
    check::<Plane>("layers", &lattice::<Plane>(24, 1.0 / 1024.0));
    check::<Space>("layers", &lattice::<Space>(9, 1.0 / 1024.0));
}

/// Where flips are stuck, and islands are filled or given up.
#[test]
fn spheres_within_each_other() {
    let points = on_spheres_within_each_other(600, &mut Rng::new(5));
    check::<Space>("spheres_within_each_other", &points);
}
