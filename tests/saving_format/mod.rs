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
    /// In version 9.
    pub weighted: Option<Weighted>,
}

/// What is there with weights alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weighted {
    /// By vertex, by staged move, and by staged insertion.
    pub weights: Vec<f64>,
    pub moved: Vec<f64>,
    pub coming: Vec<f64>,
    /// The cell below each vertex that weights hide.
    pub below: Vec<u32>,
    pub history: [u64; 12],
    /// Vertices that had another weight, that were hidden, and that were shown.
    pub sums: [u64; 3],
}

/// Numbers of `stride` for each of some points: the last of each, if that is a weight, apart from the others.
fn split(numbers: &[f64], dimension: usize, stride: usize) -> (Vec<f64>, Vec<f64>) {
    let rows = || numbers.chunks_exact(stride);
    (
        rows().flat_map(|row| &row[..dimension]).copied().collect(),
        rows().flat_map(|row| &row[dimension..]).copied().collect(),
    )
}

/// Places, each with its weight behind it, if there are weights.
fn joined(places: &[f64], weights: Option<&[f64]>, dimension: usize) -> Vec<f64> {
    let rows = places.chunks_exact(dimension).enumerate();
    rows.flat_map(|(k, row)| row.iter().copied().chain(weights.map(|weights| weights[k]))).collect()
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
        let is_weighted = word(8) == 9;
        assert!(is_weighted || word(8) == 1);
        assert_eq!(number(16), bytes.len() as u64);
        let dimension = word(12) as usize;
        let stride = dimension + usize::from(is_weighted);
        let counts: Vec<usize> = (24..64).step_by(8).map(|at| number(at) as usize).collect();
        let mut at = 168;
        let mut doubles = |n: usize| {
            at += 8 * n * stride;
            let numbers = (at - 8 * n * stride..at).step_by(8).map(|at| f64::from_bits(number(at)));
            split(&numbers.collect::<Vec<_>>(), dimension, stride)
        };
        let [(positions, weights), (moved, moved_weights), (coming, coming_weights)] =
            [counts[0], counts[2], counts[3]].map(&mut doubles);
        let mut words = |n: usize| {
            at += 4 * n;
            (at - 4 * n..at).step_by(4).map(word).collect::<Vec<_>>()
        };
        let representatives = words(counts[0]);
        let below = words(if is_weighted { counts[0] } else { 0 });
        let mut parts = Parts {
            dimension,
            sums: std::array::from_fn(|k| number(64 + 8 * k)),
            positions,
            moved,
            coming,
            representatives,
            cells: words(counts[1] * (dimension + 1)),
            neighbours: words(counts[1] * (dimension + 1)),
            moves: words(counts[2]),
            insertions: words(counts[3]),
            removals: words(counts[4]),
            weighted: None,
        };
        if is_weighted {
            let history = std::array::from_fn(|k| number(at + 8 * k));
            let sums = std::array::from_fn(|k| number(at + 96 + 8 * k));
            at += 120;
            let (moved, coming) = (moved_weights, coming_weights);
            parts.weighted = Some(Weighted { weights, moved, coming, below, history, sums });
        }
        assert_eq!(word(at), crc32(&bytes[..at]));
        assert_eq!(at + 4, bytes.len());
        parts
    }

    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = vec![0x89, b'D', b'L', b'D', 13, 10, 26, 10];
        let weighted = self.weighted.as_ref();
        bytes.extend(if weighted.is_some() { 9_u32 } else { 1 }.to_le_bytes());
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
        let points = [
            joined(&self.positions, weighted.map(|w| &w.weights[..]), self.dimension),
            joined(&self.moved, weighted.map(|w| &w.moved[..]), self.dimension),
            joined(&self.coming, weighted.map(|w| &w.coming[..]), self.dimension),
        ];
        for numbers in points {
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        let (none, below) = (Vec::new(), weighted.map(|w| &w.below));
        let lists = [&self.representatives, below.unwrap_or(&none), &self.cells, &self.neighbours];
        for numbers in lists.into_iter().chain([&self.moves, &self.insertions, &self.removals]) {
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        let numbers = weighted.iter().flat_map(|w| w.history.into_iter().chain(w.sums));
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
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
