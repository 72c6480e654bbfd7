//! The order of sites in memory and the order of insertion.
//!
//! Sites are stored along a Hilbert curve, so that what is near in space is near in memory; they are inserted in
//! rounds of growing size, each along the curve (a biased randomised insertion order: Amenta, Choi and Rote,
//! 10.1145/777792.777824). The rounds make the expected cost linear in the output, the curve makes walks short.
//! Rounds are drawn by a fixed hash of the position in the order: the same input gives the same order.
//!
//! Hilbert keys have only as many bits as the number of points warrants. Runs of points with one key, which only
//! uneven densities have, are sorted again in their own bounding box, so that clusters within clusters are still
//! visited along a curve.

use crate::delaunay::Geometry;
use crate::error::Result;
use crate::ids::SiteId;
use crate::machine::memory;

/// Lower and upper corner of the bounding box.
pub fn bounding_box<'p, G: Geometry>(
    points: impl Iterator<Item = &'p G::Point>,
) -> Option<(G::Point, G::Point)>
where
    G::Point: 'p,
{
    let mut corners: Option<(G::Point, G::Point)> = None;
    for p in points {
        let (lower, upper) = corners.get_or_insert((*p, *p));
        for k in 0..G::NUMBERS {
            // The minimum and the maximum of finite numbers, in an operation each.
            lower[k] = if p[k] < lower[k] { p[k] } else { lower[k] };
            upper[k] = if upper[k] < p[k] { p[k] } else { upper[k] };
        }
    }
    corners
}

/// An item and its position along the curve, in the upper half.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Keyed(u64);

impl Keyed {
    /// An item at the start of the curve.
    pub fn new(item: u32) -> Self {
        Keyed(u64::from(item))
    }

    /// The item.
    pub fn item(self) -> u32 {
        self.0 as u32
    }

    fn key(self) -> u32 {
        (self.0 >> 32) as u32
    }
}

/// Sorts items, ascending as given, along the Hilbert curve of their points.
pub fn hilbert_order<'p, G: Geometry>(
    mut items: Vec<Keyed>,
    point: impl Fn(u32) -> &'p G::Point + Copy,
) -> Result<Vec<Keyed>> {
    if items.len() <= SHORT_RUN {
        return Ok(items);
    }
    let mut spare = Vec::new();
    if items.len() > MAX_COMPARED {
        memory::reserve_exact(&mut spare, items.len())?;
        spare.resize(items.len(), Keyed::default());
    }
    sort_in_box::<G>(point, &mut items, &mut spare);
    Ok(items)
}

/// This number of items, and runs of one key up to this length, stay unsorted: a walk through them is short anyway.
const SHORT_RUN: usize = 8;

/// Extents below this are [scaled up](UP) first.
const SMALL: f64 = 1e-100;
/// A power of two that makes any number a normal one, and none below [`SMALL`] great.
const UP: f64 = f64::from_bits((1023 + 600) << 52);

/// The items have the same key and are ascending; `spare` is as long, or there are [`MAX_COMPARED`] of them.
fn sort_in_box<'p, G: Geometry>(
    point: impl Fn(u32) -> &'p G::Point + Copy,
    keyed: &mut [Keyed],
    spare: &mut [Keyed],
) {
    let Some((lower, upper)) = bounding_box::<G>(keyed.iter().map(|k| point(k.item()))) else {
        return;
    };
    let extent = (0..G::D).map(|k| upper[k] - lower[k]).fold(0.0, f64::max);
    if extent == 0.0 {
        return;
    }
    // Several boxes of the grid to a point of a uniform set, and keys of 32 bits at most.
    let per_axis = ((keyed.len() as f64).log2() / G::D as f64).ceil() as u32 + 2;
    let bits = if G::D == 2 { per_axis.next_multiple_of(4).min(16) } else { per_axis.min(10) };
    // Of small extents the scale would be infinite.
    let up = if extent < SMALL { UP } else { 1.0 };
    let scale = ((1u64 << bits) - 1) as f64 / (extent * up);
    for k in keyed.iter_mut() {
        let p = point(k.item());
        let mut cell = [0u32; 3];
        for axis in 0..G::D {
            cell[axis] = ((p[axis] - lower[axis]) * up * scale) as u32;
        }
        let key = if G::D == 2 { hilbert_key_2(cell[0], cell[1], bits) } else { hilbert_key_3(cell, bits) };
        k.0 = u64::from(key) << 32 | u64::from(k.item());
    }
    sort_by_key(keyed, spare, bits * G::D as u32);
    for run in keyed.chunk_by_mut(|a, b| a.key() == b.key()) {
        if run.len() > SHORT_RUN {
            let n = run.len().min(spare.len());
            sort_in_box::<G>(point, run, &mut spare[..n]);
        }
    }
}

/// Up to this number, items are sorted by comparisons: about as fast as by digits, and without spare memory.
const MAX_COMPARED: usize = 256;

/// Sorts items by their keys, which have `bits` bits; items of the same key keep their order.
///
/// By digits from the lowest on, with `spare` to write to, as a sort that makes its own room could not tell that there
/// is none.
fn sort_by_key(keyed: &mut [Keyed], spare: &mut [Keyed], bits: u32) {
    if keyed.len() <= MAX_COMPARED {
        keyed.sort_unstable_by_key(|k| k.0);
    } else {
        sort_by_digits(keyed, spare, bits);
    }
}

/// Sorts items by their keys, which have `bits` bits, by digits.
fn sort_by_digits(keyed: &mut [Keyed], spare: &mut [Keyed], bits: u32) {
    /// Values of a digit: more would be more places to write to than the processor keeps at hand.
    const PLACES: usize = 1 << 11;
    /// Digits that make up 32 bits.
    const DIGITS: usize = 3;
    let n_digits = bits.div_ceil(PLACES.ilog2());
    // Digits of like lengths.
    let digit = bits.div_ceil(n_digits);
    let mask = (1 << digit) - 1;
    let at = |k: &Keyed, d: u32| (k.key() >> (d * digit) & mask) as usize % PLACES;
    let mut counts = [[0u32; PLACES]; DIGITS];
    for k in keyed.iter() {
        for (d, counts) in (0..n_digits).zip(&mut counts) {
            counts[at(k, d)] += 1;
        }
    }
    let n = keyed.len();
    let (mut from, mut to) = (&mut *keyed, &mut spare[..n]);
    let mut is_in_spare = false;
    for (d, counts) in (0..n_digits).zip(&mut counts) {
        let mut start = 0;
        for count in counts[..=mask as usize].iter_mut() {
            (*count, start) = (start, start + *count);
        }
        for k in from.iter() {
            let next = &mut counts[at(k, d)];
            to[*next as usize] = *k;
            *next += 1;
        }
        (from, to) = (to, from);
        is_in_spare = !is_in_spare;
    }
    if is_in_spare {
        to.copy_from_slice(from);
    }
}

/// One entry for each state of the plane's curve and four bits of each coordinate: eight bits of the key, and the next
/// state above them.
///
/// The state is the transformation that the quadrants passed so far have put on the curve: whether both axes are
/// mirrored (bit 0) and whether they are exchanged (bit 1). A quadrant with `y = 0` exchanges them for the curve
/// within, and one with `x = 1` as well mirrors them first.
static CURVE: [[u16; 256]; 4] = {
    let mut table = [[0; 256]; 4];
    let mut start = 0;
    while start < 4 {
        let mut bits = 0;
        while bits < 256 {
            let (mut state, mut key) = (start, 0);
            let mut b = 4;
            while b > 0 {
                b -= 1;
                let (x, y) = ((bits >> (4 + b)) & 1, (bits >> b) & 1);
                let (x, y) = if state & 2 == 0 { (x, y) } else { (y, x) };
                let (x, y) = (x ^ (state & 1), y ^ (state & 1));
                key = key << 2 | ((3 * x) ^ y);
                if y == 0 {
                    state = (state ^ 2) ^ x;
                }
            }
            table[start][bits] = (key | state << 8) as u16;
            bits += 1;
        }
        start += 1;
    }
    table
};

/// Position along the plane's Hilbert curve of the cell `(x, y)` of a grid of `2^bits` cells a side; `bits` is a
/// multiple of 4.
fn hilbert_key_2(x: u32, y: u32, bits: u32) -> u32 {
    let (mut key, mut state) = (0, 0);
    let mut shift = bits;
    while shift > 0 {
        shift -= 4;
        let entry = CURVE[state & 3][((x >> shift & 15) << 4 | y >> shift & 15) as usize];
        key = key << 8 | u32::from(entry & 255);
        state = usize::from(entry >> 8);
    }
    key
}

/// The space's Hilbert curve (Skilling's transform, 10.1063/1.1751381): for each state and octant (three bits, x first)
/// the position along the curve (bits 0 to 2) and the state after it.
///
/// The state is what the octants passed so far do to those within: which coordinates are mirrored (bits 0 to 2, x
/// last), in which order they are (as in [`ORDERS`], times 8), and whether the curve is passed backwards (48).
static CURVE_3: [[u16; 8]; 96] = {
    let mut table = [[0; 8]; 96];
    let mut state = 0;
    while state < 96 {
        let mut octant = 0;
        while octant < 8 {
            table[state][octant] = step_of_curve_3(state, octant);
            octant += 1;
        }
        state += 1;
    }
    table
};

/// All orders of three coordinates.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]];

/// An entry of [`CURVE_3`].
const fn step_of_curve_3(state: usize, octant: usize) -> u16 {
    let (order, is_backwards) = (ORDERS[state / 8 % 6], state / 48);
    let mut mirrored = [state >> 2 & 1, state >> 1 & 1, state & 1];
    let given = [octant >> 2 & 1, octant >> 1 & 1, octant & 1];
    let x = [given[order[0]] ^ mirrored[0], given[order[1]] ^ mirrored[1], given[order[2]] ^ mirrored[2]];
    let mut after = order;
    let mut i = 0;
    while i < 3 {
        if x[i] == 1 {
            mirrored[0] ^= 1;
        } else {
            (after[0], after[i]) = (after[i], after[0]);
            (mirrored[0], mirrored[i]) = (mirrored[i], mirrored[0]);
        }
        i += 1;
    }
    let gray = [x[0], x[0] ^ x[1], x[0] ^ x[1] ^ x[2]];
    let [a, b, c] = [gray[0] ^ is_backwards, gray[1] ^ is_backwards, gray[2] ^ is_backwards];
    let mut k = 0;
    while !(ORDERS[k][0] == after[0] && ORDERS[k][1] == after[1] && ORDERS[k][2] == after[2]) {
        k += 1;
    }
    let next = mirrored[0] << 2 | mirrored[1] << 1 | mirrored[2] | k << 3;
    ((next + 48 * (is_backwards ^ gray[2])) << 3 | a << 2 | b << 1 | c) as u16
}

/// Position along the space's Hilbert curve of the cell `x` of a grid of `2^bits` cells a side.
fn hilbert_key_3(x: [u32; 3], bits: u32) -> u32 {
    let octants = spread_3(x[0]) << 2 | spread_3(x[1]) << 1 | spread_3(x[2]);
    let (mut key, mut state) = (0, 0);
    let mut shift = 3 * bits;
    while shift > 0 {
        shift -= 3;
        let entry = CURVE_3[state][(octants >> shift & 7) as usize];
        key = key << 3 | u32::from(entry & 7);
        state = usize::from(entry >> 3);
    }
    key
}

/// The low 10 bits, three places apart.
fn spread_3(x: u32) -> u32 {
    let mut x = x & 0x3ff;
    x = (x | x << 16) & 0x0300_00ff;
    x = (x | x << 8) & 0x0300_f00f;
    x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

/// Splits `sites`, which is in storage order, into rounds, each `2^D` times as large as the one before in the mean;
/// the order within a round stays. A [short run](SHORT_RUN) is a single round.
pub fn in_rounds<G: Geometry>(sites: impl Iterator<Item = SiteId> + Clone) -> Result<Vec<SiteId>> {
    const ROUNDS: usize = 16;
    let mut order = Vec::new();
    if sites.clone().nth(SHORT_RUN).is_none() {
        memory::collect(&mut order, sites)?;
        return Ok(order);
    }
    let round = |s: SiteId| {
        let hash = u64::from(s.get()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let hash = (hash ^ hash >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let level = (hash >> 32 | 1 << 31).trailing_zeros() as usize / G::D;
        ROUNDS - 1 - level.min(ROUNDS - 1)
    };
    let mut starts = [0usize; ROUNDS + 1];
    for s in sites.clone() {
        starts[round(s) + 1] += 1;
    }
    for r in 0..ROUNDS {
        starts[r + 1] += starts[r];
    }
    memory::reserve_exact(&mut order, starts[ROUNDS])?;
    order.resize(starts[ROUNDS], SiteId::NONE);
    for s in sites {
        let at = &mut starts[round(s)];
        order[*at] = s;
        *at += 1;
    }
    Ok(order)
}

#[cfg(test)]
mod tests;
