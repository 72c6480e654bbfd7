//! A program in Rust that has deldrift among its dependencies.

use deldrift::motion::{Level, MovingTriangulation, Options};
use deldrift::{AnyTriangulation, Plane, in_its_dimension};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    for _ in 0..3 {
        points[3][0] += 0.25;
        t.commit_positions(&points)?;
    }
    t.validate(Level::Delaunay).map_err(|violation| violation.message)?;
    let t = AnyTriangulation::from(t);
    let (n, timestamp) = in_its_dimension!(&t => (t.cell_count(), t.timestamp()));
    println!("{n} triangles after {timestamp} timestamps");
    Ok(())
}
