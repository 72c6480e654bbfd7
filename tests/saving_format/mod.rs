//! The bytes of a saved triangulation as docs/FORMAT.md describes them, read and written without the library.

pub mod forged;

/// What they hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Parts {
    pub dimension: usize,
    /// The timestamp, and twelve sums.
    pub sums: [u64; 13],
    pub positions: Vec<f64>,
    pub moved: Vec<f64>,
    pub coming: Vec<f64>,
    pub representatives: Vec<u32>,
    pub cells: Vec<u32>,
    pub neighbours: Vec<u32>,
    pub moves: Vec<u32>,
    pub insertions: Vec<u32>,
    pub removals: Vec<u32>,
}

/// The checksum of zlib, PNG and others, by its definition.
pub fn crc32(bytes: &[u8]) -> u32 {
    let mut rest = u32::MAX;
    for &byte in bytes {
        rest ^= u32::from(byte);
        for _ in 0..8 {
            rest = rest >> 1 ^ if rest & 1 == 1 { 0xedb8_8320 } else { 0 };
        }
    }
    !rest
}

/// Puts the right checksum at the end.
pub fn seal(bytes: &mut [u8]) {
    let end = bytes.len() - 4;
    let checksum = crc32(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
}

impl Parts {
    pub fn read(bytes: &[u8]) -> Self {
        assert_eq!(bytes[..8], [0x89, b'D', b'L', b'D', 13, 10, 26, 10]);
        let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((word(8), number(16)), (1, bytes.len() as u64));
        let dimension = word(12) as usize;
        let counts: Vec<usize> = (24..64).step_by(8).map(|at| number(at) as usize).collect();
        let mut at = 168;
        let mut doubles = |n: usize| {
            at += 8 * n * dimension;
            (at - 8 * n * dimension..at).step_by(8).map(|at| f64::from_bits(number(at))).collect::<Vec<_>>()
        };
        let (positions, moved, coming) = (doubles(counts[0]), doubles(counts[2]), doubles(counts[3]));
        let mut words = |n: usize| {
            at += 4 * n;
            (at - 4 * n..at).step_by(4).map(word).collect::<Vec<_>>()
        };
        let parts = Parts {
            dimension,
            sums: std::array::from_fn(|k| number(64 + 8 * k)),
            positions,
            moved,
            coming,
            representatives: words(counts[0]),
            cells: words(counts[1] * (dimension + 1)),
            neighbours: words(counts[1] * (dimension + 1)),
            moves: words(counts[2]),
            insertions: words(counts[3]),
            removals: words(counts[4]),
        };
        assert_eq!(word(at), crc32(&bytes[..at]));
        assert_eq!(at + 4, bytes.len());
        parts
    }

    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = vec![0x89, b'D', b'L', b'D', 13, 10, 26, 10];
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend((self.dimension as u32).to_le_bytes());
        let n_cells = self.cells.len() / (self.dimension + 1);
        let counts = [
            self.representatives.len(),
            n_cells,
            self.moves.len(),
            self.insertions.len(),
            self.removals.len(),
        ];
        bytes.extend([0; 8]);
        bytes.extend(counts.iter().flat_map(|&n| (n as u64).to_le_bytes()));
        bytes.extend(self.sums.iter().flat_map(|sum| sum.to_le_bytes()));
        for numbers in [&self.positions, &self.moved, &self.coming] {
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        let lists = [&self.representatives, &self.cells, &self.neighbours, &self.moves, &self.insertions];
        for numbers in lists.into_iter().chain([&self.removals]) {
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend([0; 4]);
        let size = bytes.len() as u64;
        bytes[16..24].copy_from_slice(&size.to_le_bytes());
        seal(&mut bytes);
        bytes
    }

    /// Neighbours as they follow from the cells, where no facet is in more than two.
    pub fn glue(&mut self) {
        let n = self.dimension + 1;
        let facet = |c: usize, i: usize| {
            let mut facet = self.cells[c * n..(c + 1) * n].to_vec();
            facet.remove(i);
            facet.sort_unstable();
            facet
        };
        let n_cells = self.cells.len() / n;
        let all: Vec<_> = (0..n_cells * n).map(|k| facet(k / n, k % n)).collect();
        let across = |k: usize| (0..all.len()).find(|&l| l != k && all[l] == all[k]);
        self.neighbours = (0..all.len()).map(|k| across(k).map_or(u32::MAX, |l| (l / n) as u32)).collect();
    }
}
