//! Counts of the work of an algorithm on recorded positions, as `make report` leaves them in
//! `cpp-bench/results/series`: a NumPy file of timestamps × vertices × coordinates.
//!
//! ```text
//! cargo run --release --example report_work -- FILE.npy safe_region_tolerance [one-by-one] [check]
//! valgrind --tool=callgrind --toggle-collect='*replay*' target/release/examples/report_work FILE.npy slack
//! ```
//!
//! The second command counts the instructions of the commits alone. With `one-by-one` vertices are relocated at once,
//! in the order of their ids; with `check` the cells of each timestamp are compared with those of a fresh build.
use std::error::Error;
use std::{env, fs};

use deldrift::motion::{Algorithm, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};

/// What is recorded: the lengths of the three axes, and the numbers.
struct Recording {
    shape: [usize; 3],
    numbers: Vec<f64>,
}

impl Recording {
    fn load(path: &str) -> Result<Self, Box<dyn Error>> {
        let bytes = fs::read(path)?;
        let length = bytes.get(8..10).ok_or("the file is too short")?;
        let start = 10 + usize::from(u16::from_le_bytes(length.try_into()?));
        let header =
            String::from_utf8_lossy(bytes.get(10..start).ok_or("the file is too short")?).into_owned();
        if !bytes.starts_with(b"\x93NUMPY\x01") || !header.contains("'<f8'") || !header.contains("False") {
            return Err("this is no NumPy file, version 1, of numbers of 8 bytes in C order".into());
        }
        let shape = header.split(['(', ')']).nth(1).ok_or("no shape")?;
        let shape: Result<Vec<usize>, _> =
            shape.split(',').map(str::trim).filter(|axis| !axis.is_empty()).map(str::parse).collect();
        let shape: [usize; 3] = shape?.try_into().map_err(|_| "not of three axes")?;
        let numbers: Vec<f64> = bytes[start..]
            .chunks_exact(8)
            .map(|n| f64::from_le_bytes(n.try_into().expect("8 bytes")))
            .collect();
        let is_whole = shape[0] > 0 && shape.iter().product::<usize>() == numbers.len();
        if is_whole { Ok(Recording { shape, numbers }) } else { Err("the file is not whole".into()) }
    }

    fn timestamps<G: Dimension>(&self) -> Vec<Vec<G::Point>> {
        let point = |numbers: &[f64]| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = numbers[axis]);
            p
        };
        let of_one = |numbers: &[f64]| numbers.chunks_exact(G::D).map(point).collect();
        self.numbers.chunks_exact(self.shape[1] * G::D).map(of_one).collect()
    }
}

/// The corners of all cells, in an order that does not depend on history.
fn cells<G: Dimension>(t: &mut MovingTriangulation<G>) -> Result<Vec<Vec<VertexId>>, Box<dyn Error>> {
    let mut cells: Vec<_> = t.cells()?.corners.iter().map(|corners| corners.as_ref().to_vec()).collect();
    cells.iter_mut().for_each(|corners| corners.sort_unstable());
    cells.sort_unstable();
    Ok(cells)
}

/// Takes the vertices from one timestamp to the next.
#[inline(never)]
fn replay<G: Dimension>(
    t: &mut MovingTriangulation<G>,
    positions: &[G::Point],
    is_one_by_one: bool,
) -> Result<(), Box<dyn Error>> {
    if is_one_by_one {
        for (v, p) in VertexId::range(0..positions.len()).zip(positions) {
            t.relocate_vertex(v, p)?;
        }
    } else {
        t.commit_positions(positions)?;
    }
    Ok(())
}

fn run<G: Dimension>(
    recording: &Recording,
    algorithm: Algorithm,
    options: &[String],
) -> Result<(), Box<dyn Error>> {
    let is = |option: &str| options.iter().any(|given| given == option);
    let timestamps = recording.timestamps::<G>();
    let one_thread = Options { algorithm, threads: 1, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&timestamps[0], one_thread)?;
    for positions in &timestamps[1..] {
        replay(&mut t, positions, is("one-by-one"))?;
        if is("check") {
            let mut fresh = MovingTriangulation::<G>::new(positions, Options::default())?;
            assert!(cells(&mut t)? == cells(&mut fresh)?, "the cells are those of a fresh build");
        }
    }
    println!("{:#?}", t.statistics());
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [file, name, options @ ..] = &arguments[..] else {
        return Err("give a file and the name of an algorithm".into());
    };
    let algorithm = Algorithm::ALL.into_iter().find(|algorithm| algorithm.name() == name);
    let algorithm = algorithm.ok_or("no algorithm has this name")?;
    let recording = Recording::load(file)?;
    match recording.shape[2] {
        2 => run::<Plane>(&recording, algorithm, options),
        3 => run::<Space>(&recording, algorithm, options),
        _ => Err("positions have two or three coordinates".into()),
    }
}
