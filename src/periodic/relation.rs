//! How shifts of one lattice are told by those of another that takes its place.

/// By vector of one lattice, the multiples of the vectors of another one that are nearest to it: each shift of one is told as one
/// of the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    pub(super) rows: [[i64; 3]; 3],
}

impl Relation {
    /// What a shift of the first lattice is in the second one; none of numbers that are too large.
    pub(super) fn of(&self, shift: [i64; 3]) -> Option<[i64; 3]> {
        let mut sum = [0i64; 3];
        for (n, row) in shift.into_iter().zip(&self.rows) {
            for j in 0..3 {
                sum[j] = sum[j].checked_add(n.checked_mul(row[j])?)?;
            }
        }
        Some(sum)
    }

    pub(super) fn determinant(&self) -> i64 {
        let [a, b, c] = self.rows;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
}
