//! Sets of cells as a few numbers.

use deldrift::VertexId;

/// A number that looks as if drawn at random for each `x`: the last steps of SplitMix64 (10.1145/2714064.2660195).
pub fn mixed(x: u64) -> u64 {
    let z = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

/// Of a set of cells, whatever their order and that of their corners: two sums over the cells, of 64 bits each. That
/// two different sets have the same ones is as improbable as that 128 tossed coins fall alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fingerprint {
    pub cells: u64,
    sums: [u64; 2],
}

impl Fingerprint {
    /// Of cells with their vertices renamed.
    pub fn of<C: AsRef<[VertexId]>>(rows: &[C], name: impl Fn(VertexId) -> VertexId) -> Self {
        let mut sums = [0u64; 2];
        for row in rows {
            let mut ids = [u64::MAX; 4];
            for (id, &v) in ids.iter_mut().zip(row.as_ref()) {
                *id = u64::from(name(v).get());
            }
            ids.sort_unstable();
            let low = mixed(ids[0] << 32 | ids[1]);
            let cell = mixed(low ^ (ids[2].wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ ids[3].rotate_left(31)));
            sums[0] = sums[0].wrapping_add(cell);
            sums[1] = sums[1].wrapping_add(mixed(cell ^ low.rotate_left(17)));
        }
        Fingerprint { cells: rows.len() as u64, sums }
    }

    /// A checksum goes on with these cells.
    pub fn enter(&self, checksum: &mut u64) {
        *checksum = mixed(checksum.rotate_left(9) ^ self.sums[0] ^ mixed(self.cells));
    }
}
