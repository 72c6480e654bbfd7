//! What a build and commits take in a periodic box, beside those of as many vertices in the open: on one thread, in time on a
//! processor.
//!
//!     cargo run --release --example periodic_speed [VERTICES]

use std::sync::OnceLock;
use std::time::Instant;

use deldrift::motion::{MovingTriangulation, Options};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{Dimension, Plane, Result, Space};

/// Numbers from 0 to 1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// So many that the system, which counts time in ticks of some milliseconds, tells enough of them.
const STEPS: usize = 20;

/// Of this thread on a processor, which other programs do not add to, where the system tells that.
fn seconds() -> f64 {
    static BEGIN: OnceLock<Instant> = OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| BEGIN.get_or_init(Instant::now).elapsed().as_secs_f64(), |n| 1e-9 * n)
}

fn milliseconds(work: impl FnOnce() -> Result<()>) -> Result<f64> {
    let start = seconds();
    work()?;
    Ok(1e3 * (seconds() - start))
}

fn compare<G: Dimension>(name: &str, n: usize, vectors: &[G::Point]) -> Result<()> {
    let mut random = Random(1);
    let mut points = vec![G::Point::default(); n];
    for p in &mut points {
        for vector in vectors {
            let multiple = random.next();
            (0..G::D).for_each(|axis| p[axis] += multiple * vector[axis]);
        }
    }
    let options = || Options { threads: 1, ..Options::default() };
    let (mut open, mut periodic) = (None, None);
    let of_open = milliseconds(|| {
        open = Some(MovingTriangulation::<G>::new(&points, options())?);
        Ok(())
    })?;
    let of_periodic = milliseconds(|| {
        periodic = Some(PeriodicTriangulation::<G>::new(&points, vectors, options())?);
        Ok(())
    })?;
    let (Some(mut open), Some(mut periodic)) = (open, periodic) else { unreachable!("both are made") };
    println!("{name}, {n} vertices, {} with images", periodic.image_count());
    println!("  build: {of_open:.1} ms in the open, {of_periodic:.1} periodic: {:.2}", of_periodic / of_open);
    let spacing = (n as f64).powf(-1.0 / G::D as f64);
    for share in [1e-4, 1e-3, 1e-2, 1e-1] {
        let (mut of_open, mut of_periodic) = (0.0, 0.0);
        for _ in 0..STEPS {
            for p in &mut points {
                (0..G::D).for_each(|axis| p[axis] += share * spacing * (2.0 * random.next() - 1.0));
            }
            of_open += milliseconds(|| open.commit_positions(&points).map(drop))? / STEPS as f64;
            of_periodic += milliseconds(|| periodic.commit_positions(&points).map(drop))? / STEPS as f64;
        }
        println!(
            "  moves by {share} spacings: {of_open:.2} ms in the open, {of_periodic:.2} periodic: {:.2}",
            of_periodic / of_open
        );
    }
    Ok(())
}

fn main() -> Result<()> {
    let n = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(100_000);
    compare::<Plane>("square", n, &[[1.0, 0.0], [0.0, 1.0]])?;
    compare::<Plane>("skewed box in the plane", n, &[[1.0, 0.0], [0.375, 1.0]])?;
    compare::<Space>("cube", n, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])?;
    compare::<Space>("triclinic box", n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.0]])
}
