use crate::delaunay::Plane;
use crate::ids::VertexId;
use crate::motion::options::{CoarsenOptions, Options, Quality, RefineOptions};
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
use crate::random::Rng;

type Triangulation = MovingTriangulation<Plane>;

/// Regular polygons around the origin by radius and corners, each in the one before, and a slit between the first two.
fn nested() -> Triangulation {
    let (mut points, mut segments) = (Vec::new(), Vec::new());
    for (radius, n) in [(1.0, 12), (0.6, 9), (0.3, 5)] {
        let first = points.len();
        for k in 0..n {
            let (sine, cosine) = (std::f64::consts::TAU * k as f64 / n as f64 + 0.1).sin_cos();
            points.push([radius * cosine, radius * sine]);
            segments.push([first + k, first + (k + 1) % n]);
        }
    }
    segments.push([points.len(), points.len() + 1]);
    points.extend([[0.0, 0.7], [0.1, 0.8]]);
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let segments =
        segments.into_iter().map(|ends| Segment { ends: ends.map(VertexId::at), ..Segment::default() });
    t.stage_segments(segments).expect("present");
    t.commit_timestamp().expect("no conflict");
    t
}

/// All within a radius turn, the less the farther out they are.
fn turn(t: &mut Triangulation, angle: f64) {
    for v in VertexId::range(0..t.id_count()) {
        let Ok([x, y]) = t.position(v) else { continue };
        let (sine, cosine) = (angle * ((0.95 - x.hypot(y)) / 0.5).clamp(0.0, 1.0)).sin_cos();
        t.move_vertices(&[v], &[[cosine * x - sine * y, sine * x + cosine * y]]).expect("present");
    }
    t.commit_timestamp().expect("no conflict");
}

fn fresh(t: &Triangulation, domain: u32) -> Vec<u8> {
    let levels = |is_in: fn(u32) -> bool, levels: Vec<u32>| -> Vec<u8> {
        levels.into_iter().map(|level| u8::from(is_in(level))).collect()
    };
    match domain {
        0 => levels(|level| level % 2 == 1, t.nesting_levels().expect("room")),
        1 => levels(|level| level % 2 == 1, t.crossing_numbers().expect("room")),
        _ => levels(|level| level > 0, t.nesting_levels().expect("room")),
    }
}

/// The mask that is carried over what a call has changed is that of the cells by now, and after other changes there is
/// none.
#[test]
fn masks_are_those_of_the_cells() {
    let mut n_known = 0;
    for seed in 0..20 {
        let rng = &mut Rng::new(seed);
        let mut t = nested();
        let areas = [0.02, 0.01, 0.005];
        for k in 0..40 {
            let domain = rng.below(3) as u32;
            let quality = Quality {
                least_angle: 25.0,
                greatest_area: if rng.below(8) == 0 { *rng.pick(&areas) } else { 0.01 },
                ..Quality::default()
            };
            if rng.below(3) > 0 {
                turn(&mut t, 0.03);
                assert!((0..3).all(|domain| t.mask_since(domain).expect("room").is_none()));
            }
            for refines in [false, true] {
                // Another mask in between, of which no domain is named.
                let is_named = rng.below(4) > 0;
                let mask = fresh(&t, if is_named { domain } else { rng.below(3) as u32 });
                let done = match refines {
                    true => t.refine(&quality, &RefineOptions::default(), &mask),
                    false => t.coarsen(&quality, &CoarsenOptions::default(), &mask),
                };
                done.expect("a domain");
                if is_named {
                    t.set_domain(domain, &mask);
                }
                for domain in 0..3 {
                    let Some(known) = t.mask_since(domain).expect("room") else { continue };
                    assert_eq!(known, fresh(&t, domain), "seed {seed}, round {k}");
                    n_known += 1;
                }
            }
        }
    }
    assert!(n_known > 500, "{n_known}");
}
