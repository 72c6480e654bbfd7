//! Domains of random histories, without sines: what they are is a function of the seed on every processor.

use crate::common::Rng;

/// Places, and loops and chains of edges between them.
#[derive(Clone, Debug, Default)]
pub struct Domain {
    pub points: Vec<[f64; 2]>,
    pub edges: Vec<[usize; 2]>,
    /// So many edges are of loops; the others are of slits.
    pub n_loops: usize,
}

/// The direction of a share of a full turn, nearly.
pub fn direction(share: f64) -> [f64; 2] {
    let quarters = 4.0 * share.rem_euclid(1.0);
    let t = quarters.fract();
    let square = 1.0 + t * t;
    let [x, y] = [(1.0 - t * t) / square, 2.0 * t / square];
    match quarters as u8 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    }
}

/// Turned by a direction.
pub fn turned([x, y]: [f64; 2], [cosine, sine]: [f64; 2]) -> [f64; 2] {
    [x * cosine - y * sine, x * sine + y * cosine]
}

impl Domain {
    /// Around the origin, about as large as 1, before it is turned, scaled and shifted.
    pub fn new(rng: &mut Rng) -> Self {
        let mut domain = Domain::default();
        match rng.below(4) {
            0 => domain.ring(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]),
            1 => domain.ring(&[[-2.0, -0.5], [2.0, -0.5], [2.0, 0.5], [0.5, 0.5], [0.5, 1.0], [-2.0, 1.0]]),
            _ => {
                let n = 3 + rng.below(10);
                let roughness = 0.6 * rng.unit();
                let ring: Vec<_> = (0..n)
                    .map(|k| {
                        let [x, y] = direction((k as f64 + 0.6 * rng.unit()) / n as f64);
                        let radius = 1.0 - roughness * rng.unit();
                        [radius * x, radius * y]
                    })
                    .collect();
                domain.ring(&ring);
            }
        }
        for _ in 0..rng.below(3) {
            let (centre, radius, n) = (inside(rng), 0.05 + 0.15 * rng.unit(), 3 + rng.below(7));
            let turn = rng.unit();
            let ring = |radius: f64| -> Vec<[f64; 2]> {
                let corner = |k: usize| direction(turn + k as f64 / n as f64);
                (0..n).map(|k| [0, 1].map(|axis| centre[axis] + radius * corner(k)[axis])).collect()
            };
            domain.ring(&ring(radius));
            if rng.one_in(3) {
                domain.ring(&ring(0.4 * radius));
            }
        }
        domain.n_loops = domain.edges.len();
        for _ in 0..rng.below(4) {
            let (first, n) = (domain.points.len(), 2 + rng.below(3));
            // Some begin at a corner, so that there are small angles.
            let from = if rng.one_in(3) { rng.below(first) } else { first };
            domain.points.extend((0..n).map(|_| inside(rng)));
            domain.edges.extend((1..n).map(|k| [first + k - 1, first + k]));
            if from < first {
                domain.edges.push([from, first]);
            }
        }
        domain.points.extend((0..rng.below(8)).map(|_| inside(rng)));
        domain
    }

    fn ring(&mut self, ring: &[[f64; 2]]) {
        let (first, n) = (self.points.len(), ring.len());
        self.points.extend(ring);
        self.edges.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
    }
}

/// A place that is inside of most domains.
fn inside(rng: &mut Rng) -> [f64; 2] {
    [0, 1].map(|_| rng.within(-40, 40) as f64 / 80.0)
}
