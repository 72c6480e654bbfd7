//! Balls of cells and half-spaces beyond facets against boxes, by rationals.

use super::decode;
use num_bigint::BigInt;

/// Places as integers in a unit of their own.
fn integers(points: &[&[f64]]) -> Vec<Vec<BigInt>> {
    let decoded =
        || points.iter().flat_map(|p| p.iter()).map(|&x| decode(x)).filter(|&(mantissa, _)| mantissa != 0);
    let unit = decoded().map(|(_, exponent)| exponent).min().unwrap_or(0);
    let integer = |&x: &f64| match decode(x) {
        (0, _) => BigInt::ZERO,
        (mantissa, exponent) => BigInt::from(mantissa) << (exponent - unit) as usize,
    };
    points.iter().map(|p| p.iter().map(integer).collect()).collect()
}

fn difference(p: &[BigInt], q: &[BigInt]) -> Vec<BigInt> {
    p.iter().zip(q).map(|(x, y)| x - y).collect()
}

fn determinant(rows: &[Vec<BigInt>]) -> BigInt {
    let minor =
        |i: usize, j: usize, a: usize, b: usize| &rows[i][a] * &rows[j][b] - &rows[i][b] * &rows[j][a];
    if rows.len() == 2 {
        return minor(0, 1, 0, 1);
    }
    &rows[0][0] * minor(1, 2, 1, 2) - &rows[0][1] * minor(1, 2, 0, 2) + &rows[0][2] * minor(1, 2, 0, 1)
}

/// Whether the closed ball of a cell meets a closed box, by rationals: the place of the box next to the centre is no
/// further from it than a corner.
pub fn ball_meets_box(cell: &[&[f64]], low: &[f64], high: &[f64]) -> bool {
    let all: Vec<&[f64]> = cell.iter().copied().chain([low, high]).collect();
    let mut places = integers(&all);
    let (high, low) = (places.pop().expect("it is there"), places.pop().expect("it is there"));
    let a = &places[0];
    let rows: Vec<Vec<BigInt>> = places[1..].iter().map(|p| difference(p, a)).collect();
    // Cramer's rule for 2 u·c = |u|², the centre being a + c.
    let squares: Vec<BigInt> = rows.iter().map(|u| u.iter().map(|x| x * x).sum()).collect();
    let mut twice: BigInt = determinant(&rows) * 2;
    let mut centre: Vec<BigInt> = (0..rows.len())
        .map(|axis| {
            let mut replaced = rows.clone();
            replaced.iter_mut().zip(&squares).for_each(|(row, square)| row[axis] = square.clone());
            determinant(&replaced)
        })
        .collect();
    if twice < BigInt::ZERO {
        twice = -twice;
        centre.iter_mut().for_each(|x| *x = -x.clone());
    }
    let mut left: BigInt = centre.iter().map(|x| x * x).sum();
    for axis in 0..centre.len() {
        let at = |side: &[BigInt]| (&side[axis] - &a[axis]) * &twice - &centre[axis];
        let (below, above) = (at(&low), at(&high));
        if below > BigInt::ZERO {
            left -= &below * &below;
        } else if above < BigInt::ZERO {
            left -= &above * &above;
        }
    }
    left >= BigInt::ZERO
}

/// Whether a box has a place strictly on the other side of a facet than a corner behind it.
pub fn is_box_beyond(facet: &[&[f64]], behind: &[f64], low: &[f64], high: &[f64]) -> bool {
    let all: Vec<&[f64]> = facet.iter().copied().chain([behind, low, high]).collect();
    let mut places = integers(&all);
    let (high, low) = (places.pop().expect("it is there"), places.pop().expect("it is there"));
    let side = |q: &[BigInt]| {
        let others = places[1..facet.len()].iter().map(|p| p.as_slice()).chain([q]);
        determinant(&others.map(|p| difference(p, &places[0])).collect::<Vec<_>>())
    };
    let inside = side(&places[facet.len()]);
    (0..1 << low.len()).any(|bits: usize| {
        let corner: Vec<BigInt> = (0..low.len())
            .map(|k| if bits >> k & 1 == 1 { high[k].clone() } else { low[k].clone() })
            .collect();
        let here = side(&corner);
        if inside > BigInt::ZERO { here < BigInt::ZERO } else { here > BigInt::ZERO }
    })
}
