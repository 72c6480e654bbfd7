//! Where vertices are put, and how they move.

use super::super::exact_oracle::nudged;
use super::super::source::{Source, admissible, power_of_two};
use super::model::Model;
use super::types::Place;
use std::array::from_fn;

/// What places of a history are like.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// The rule for most of them.
    rule: usize,
    scale: f64,
    offset: f64,
}

impl Style {
    pub fn new(s: &mut Source) -> Self {
        let rule = s.below(10);
        let (scale, offset) = match s.below(12) {
            0 => (power_of_two(-1000), 0.0),
            1 => (power_of_two(150), 0.0),
            2 => (1.0, 1e7),
            3 => (power_of_two(s.within(100) as i32), 0.0),
            _ => (1.0, 0.0),
        };
        Style { rule, scale, offset }
    }
}

/// A place for a vertex, or to ask about.
pub fn place(s: &mut Source, style: Style, model: &Model) -> Place {
    let choice = s.byte();
    let rule = if choice < 200 { style.rule } else { usize::from(choice) % 10 };
    let any = |s: &mut Source| -> Option<Place> {
        let n = model.positions.len();
        if n == 0 { None } else { model.positions[s.below(n)] }
    };
    let d = model.d;
    let p: Place = match rule {
        0 => from_fn(|_| s.unit()),
        1 => near_sphere(s, d),
        2 => {
            let [x, y] = [s.byte(), s.byte()];
            [x & 7, x >> 3 & 7, y & 7].map(f64::from)
        }
        3 => match any(s) {
            Some(p) => return p,
            None => [0.0; 3],
        },
        4 => match any(s) {
            Some(p) => {
                let steps = s.byte();
                let step = |k: usize| i64::from(steps >> (2 * k) & 3) - 1;
                return within_dimension(from_fn(|k| nudged(p[k], step(k))), d);
            }
            None => [1.0; 3],
        },
        5 => match (any(s), any(s)) {
            (Some(p), Some(q)) => {
                let t = s.pick(&[0.5, 2.0, -1.0, 0.25, 1e-3, 3.0]);
                return within_dimension(from_fn(|k| p[k] + t * (q[k] - p[k])), d);
            }
            _ => from_fn(|_| f64::from(s.byte())),
        },
        6 => on_sphere(s, d),
        7 => {
            let axis = s.below(d + 1);
            from_fn(|k| if k == axis { s.magnitude() } else { s.unit() })
        }
        // A lattice, and numbers far below its unit.
        9 => from_fn(|_| {
            let byte = s.byte();
            let n = f64::from(byte >> 2) % 5.0 - 2.0;
            [0.0, n * f64::from_bits(1), n * 16384.0, n * 16384.0][usize::from(byte & 3)]
        }),
        _ => {
            let x = s.within(4) as f64;
            from_fn(|k| x * (k as f64 + 1.0) + if s.byte() < 20 { 1.0 } else { 0.0 })
        }
    };
    within_dimension(p.map(|x| x * style.scale + style.offset), d)
}

/// An integer point of a circle or sphere.
fn on_sphere(s: &mut Source, d: usize) -> Place {
    const PLANE: [[u8; 3]; 4] = [[0, 65, 0], [16, 63, 0], [25, 60, 0], [33, 56, 0]];
    const SPACE: [[u8; 3]; 4] = [[1, 2, 2], [0, 0, 3], [2, 1, 2], [0, 3, 0]];
    let choice = s.byte();
    let mut p = [PLANE, SPACE][d - 2][usize::from(choice & 3)].map(f64::from);
    (0..3).filter(|k| choice >> (2 + k) & 1 == 1).for_each(|k| p[k] = -p[k]);
    p[..d].rotate_left(usize::from(choice >> 5) % d);
    p
}

/// A point of one of four circles or spheres within each other, but for rounding.
fn near_sphere(s: &mut Source, d: usize) -> Place {
    let p: Place = from_fn(|k| if k < d { s.unit() } else { 0.0 });
    let radius = 16.0 * (1.0 + (p[0].to_bits() & 3) as f64);
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x * (radius / length))
}

/// What the library keeps of a place: accepted numbers, and no negative zero.
fn within_dimension(p: Place, d: usize) -> Place {
    from_fn(|k| if k < d { admissible(p[k]) + 0.0 } else { 0.0 })
}

/// How several vertices move at once.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    rule: usize,
    size: f64,
    seed: u64,
    /// One vertex in so many moves.
    pub share: usize,
}

impl Motion {
    pub fn new(s: &mut Source, style: Style) -> Self {
        let size = style.scale * power_of_two(-s.pick(&[0, 1, 3, 6, 10, 20, 40]));
        Motion { rule: s.below(12), size, seed: u64::from(s.byte()), share: s.pick(&[1, 1, 1, 2, 5, 10]) }
    }

    /// Where a vertex goes that is at `p`; `other` is another one.
    pub fn of(&self, v: u32, p: Place, other: Place, d: usize) -> Place {
        let seed = self.seed ^ u64::from(v) << 8;
        let bytes = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).to_le_bytes();
        let random = &mut Source::new(&bytes);
        let to: Place = match self.rule {
            0..=3 => from_fn(|k| p[k] + self.size * random.unit()),
            4 => p.map(|x| x + self.size),
            5 => from_fn(|k| if k == 0 { p[0] + self.size * p[1] } else { p[k] }),
            6 => from_fn(|k| if k + 1 == d { 0.0 } else { p[k] }),
            7 => other,
            8 => from_fn(|k| nudged(p[k], random.within(1))),
            9 => [-p[0], p[1], p[2]],
            10 => p.map(|x| x * if self.seed & 1 == 0 { 2.0 } else { 0.5 }),
            _ => [p[1], -p[0], p[2]],
        };
        within_dimension(to, d)
    }
}

impl Style {
    /// Whether places are such that rounded sums are accurate.
    pub fn is_easy(&self) -> bool {
        self.rule == 0 && self.scale == 1.0 && self.offset == 0.0
    }
}
