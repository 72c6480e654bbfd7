//! The shortest vectors of a lattice, or nearly so: pairs are reduced as by Gauss, and the third vector by the nearest sums of
//! the others (I. Semaev: *A 3-dimensional lattice reduction algorithm*. CaLC 2001, 10.1007/3-540-44670-2_13).

#![expect(clippy::needless_range_loop, reason = "axes and vectors are indices of several arrays at a time")]

/// By how much bounds on rounded numbers are widened, relatively.
pub(super) const SLACK: f64 = 1e-9;

/// Caller's vectors are read with so many bits.
const LONG_BITS: i32 = 96;

/// A basis of integers while it is reduced.
pub(super) struct Reduced {
    rank: usize,
    /// By vector and axis, in units of that axis.
    rows: [[i128; 3]; 3],
    /// By axis, the unit.
    units: [f64; 3],
    pub(super) of_caller: [[i64; 3]; 3],
}

impl Reduced {
    /// A reduced basis; none if the vectors depend on each other, or nearly so.
    pub(super) fn new<P: AsRef<[f64]>>(basis: &[P]) -> Option<Self> {
        let mut reduced = Reduced {
            rank: basis.len(),
            rows: [[0; 3]; 3],
            units: [1.0; 3],
            of_caller: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        };
        let n_axes = basis.first().map_or(0, |vector| vector.as_ref().len());
        for axis in 0..n_axes {
            let greatest = basis.iter().map(|vector| vector.as_ref()[axis].abs()).fold(0.0, f64::max);
            if greatest > 0.0 {
                reduced.units[axis] = 2f64.powi(exponent_above(greatest) - LONG_BITS);
            }
        }
        for (row, vector) in reduced.rows.iter_mut().zip(basis) {
            for (axis, &x) in vector.as_ref().iter().enumerate() {
                row[axis] = (x / reduced.units[axis]).round_ties_even() as i128;
            }
        }
        for _ in 0..MAX_STEPS {
            if !reduced.step()? {
                return reduced.is_independent().then_some(reduced);
            }
        }
        None
    }

    pub(super) fn vectors(&self) -> [[f64; 3]; 3] {
        self.rows.map(|row| [0, 1, 2].map(|axis| row[axis] as f64 * self.units[axis]))
    }

    /// Makes one vector shorter by multiples of others; whether that was possible. The vectors are in the order of their
    /// lengths then. None if numbers are too large.
    fn step(&mut self) -> Option<bool> {
        let vectors = self.vectors();
        let squares = vectors.map(|v| dot(&v, &v));
        for j in 1..self.rank {
            if squares[j] < squares[j - 1] {
                self.rows.swap(j, j - 1);
                self.of_caller.swap(j, j - 1);
                return Some(true);
            }
        }
        for j in 1..self.rank {
            let mut best = (squares[j] * (1.0 - SLACK), [0i64; 2]);
            for multiples in self.near(&vectors, j) {
                let candidate = self.minus(j, multiples)?;
                let v = [0, 1, 2].map(|axis| candidate[axis] as f64 * self.units[axis]);
                let square = dot(&v, &v);
                if square < best.0 {
                    best = (square, multiples);
                }
            }
            if best.1 != [0; 2] {
                self.rows[j] = self.minus(j, best.1)?;
                for (i, n) in best.1.into_iter().enumerate() {
                    for axis in 0..3 {
                        let product = n.checked_mul(self.of_caller[i][axis])?;
                        self.of_caller[j][axis] = self.of_caller[j][axis].checked_sub(product)?;
                    }
                }
                return Some(true);
            }
        }
        Some(false)
    }

    /// Multiples of the vectors before one whose sums are near it.
    fn near(&self, vectors: &[[f64; 3]; 3], j: usize) -> impl Iterator<Item = [i64; 2]> + use<> {
        let dual = dual_of(vectors, j);
        let middle = [0, 1].map(|i| if i < j { dot(&dual[i], &vectors[j]).round() as i64 } else { 0 });
        let width = [0, 1].map(|i| i64::from(i < j));
        (-width[0]..=width[0]).flat_map(move |a| {
            (-width[1]..=width[1]).map(move |b| [middle[0].saturating_add(a), middle[1].saturating_add(b)])
        })
    }

    /// A vector less multiples of those before it.
    fn minus(&self, j: usize, multiples: [i64; 2]) -> Option<[i128; 3]> {
        let mut row = self.rows[j];
        for (i, n) in multiples.into_iter().enumerate().take(j) {
            for axis in 0..3 {
                let product = self.rows[i][axis].checked_mul(i128::from(n))?;
                row[axis] = row[axis].checked_sub(product)?;
            }
        }
        Some(row)
    }

    fn is_independent(&self) -> bool {
        let vectors = self.vectors();
        let dual = dual_of(&vectors, self.rank);
        (0..self.rank).all(|j| {
            let product = dot(&dual[j], &dual[j]).sqrt() * dot(&vectors[j], &vectors[j]).sqrt();
            product < GREATEST_DEFECT
        })
    }
}

/// Steps of a reduction: each but a swap makes a vector shorter, mostly by half and more.
const MAX_STEPS: usize = 2_000;

/// The vectors of a reduced basis are that far from orthogonal at most; rounded, those that depend on each other are farther.
const GREATEST_DEFECT: f64 = 4.0;

/// Linear forms that are 1 on one vector and 0 on the others, and on what is orthogonal to all.
pub(super) fn dual_of(vectors: &[[f64; 3]; 3], rank: usize) -> [[f64; 3]; 3] {
    let mut dual = [[0.0; 3]; 3];
    for j in 0..rank {
        // What a vector has orthogonal to the others.
        let [one, other] =
            match [(j + 1) % 3, (j + 2) % 3].map(|i| if i < rank { vectors[i] } else { [0.0; 3] }) {
                [one, other] if one == [0.0; 3] => [other, one],
                pair => pair,
            };
        let v = vectors[j];
        let part = if other != [0.0; 3] {
            let normal = cross(&one, &other);
            scaled(&normal, dot(&v, &normal) / dot(&normal, &normal))
        } else if one != [0.0; 3] {
            let along = dot(&v, &one) / dot(&one, &one);
            [0, 1, 2].map(|axis| v[axis] - along * one[axis])
        } else {
            v
        };
        dual[j] = scaled(&part, 1.0 / dot(&part, &part));
    }
    dual
}

pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn scaled(a: &[f64; 3], factor: f64) -> [f64; 3] {
    a.map(|x| x * factor)
}

/// The least exponent of a power of two that is not below a positive number; exact, so that grids are those of any machine.
pub(super) fn exponent_above(x: f64) -> i32 {
    let bits = x.to_bits();
    (bits >> 52) as i32 - 1023 + i32::from(bits << 12 != 0)
}
