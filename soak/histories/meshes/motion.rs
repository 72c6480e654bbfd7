//! How the vertices of a mesh move.

use super::MeshHistory;
use super::domain::{direction, turned};
use crate::common::Rng;
use deldrift::VertexId;

/// Of one commit, by shares of the size of the domain.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Each on its own, and ends of segments not.
    Inside { by: f64, seed: u64 },
    /// Each on its own.
    All { by: f64, seed: u64 },
    /// One alone.
    One { by: f64, seed: u64 },
    /// Around a place, the less the farther away.
    Turn { by: f64, around: [f64; 2], reach: f64 },
    /// A map that keeps lines straight, but for rounding.
    Affine { rows: [[f64; 2]; 2], by: [f64; 2] },
}

impl Motion {
    pub fn new(rng: &mut Rng) -> Self {
        let seed = rng.next();
        match rng.below(8) {
            0..3 => Motion::Inside { by: *rng.pick(&[0.03, 0.01, 0.001, 1e-6]), seed },
            3 => Motion::All { by: *rng.pick(&[0.003, 1e-4, 1e-9]), seed },
            4 => Motion::One { by: 0.1, seed },
            5 | 6 => {
                let around = [0, 1].map(|_| rng.within(-40, 40) as f64 / 80.0);
                Motion::Turn { by: 0.05 * rng.unit(), around, reach: 0.1 + 0.5 * rng.unit() }
            }
            _ => {
                let mut number = || 0.05 * (rng.unit() - 0.5);
                let rows = [[number(), number()], [number(), number()]];
                Motion::Affine { rows, by: [number(), number()] }
            }
        }
    }
}

impl MeshHistory {
    /// Which vertices move, and where to: by so much of the motion.
    pub(super) fn goals(&self, motion: &Motion, factor: f64) -> (Vec<VertexId>, Vec<[f64; 2]>) {
        let mut present = self.present();
        match motion {
            Motion::Inside { .. } => {
                let mut is_end = vec![false; self.t.id_count()];
                let ends = self.t.segments().flat_map(|(_, segment)| segment.ends);
                ends.for_each(|v| is_end[v.index()] = true);
                present.retain(|v| !is_end[v.index()]);
            }
            Motion::One { seed, .. } => {
                let own: Vec<_> = present.iter().copied().filter(|v| self.is_own[v.index()]).collect();
                present = vec![*Rng::new(*seed).pick(&own)];
            }
            _ => {}
        }
        let (centre, size) = (self.centre, self.size);
        let goals = present.iter().map(|&v| {
            let p = self.t.position(v).expect("present");
            let share = [0, 1].map(|axis| (p[axis] - centre[axis]) / size);
            let way = match *motion {
                Motion::Inside { by, seed } | Motion::All { by, seed } | Motion::One { by, seed } => {
                    let mut rng = Rng::new(seed ^ u64::from(v.get()));
                    [0, 1].map(|_| by * (2.0 * rng.unit() - 1.0))
                }
                Motion::Turn { by, around, reach } => {
                    let [x, y] = [share[0] - around[0], share[1] - around[1]];
                    let rest = (1.0 - (x * x + y * y).sqrt() / (2.0 * reach)).clamp(0.0, 0.5);
                    let to = turned([x, y], direction(2.0 * by * rest * factor));
                    // The angle has been made smaller already.
                    [(to[0] - x) / factor, (to[1] - y) / factor]
                }
                Motion::Affine { rows, by } => {
                    [0, 1].map(|axis| rows[axis][0] * share[0] + rows[axis][1] * share[1] + by[axis])
                }
            };
            [0, 1].map(|axis| p[axis] + size * way[axis] * factor)
        });
        let goals = goals.collect();
        (present, goals)
    }
}
