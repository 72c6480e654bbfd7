//! What the data are, and how much of each kind there is.

use crate::damage::Damage;
use crate::motion::{Beginning, CommitReport, N_SUMS_OF_WEIGHTS};

/// Bytes up to the first entry: of what all data begin with, and of three more counts.
pub(super) const SIZE: usize = Beginning::SIZE + 24;

/// How much there is of everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PeriodicHeader {
    pub(super) dimension: u32,
    pub(super) has_weights: bool,
    /// Ids that vertices have been given, without those of staged insertions.
    pub(super) ids: usize,
    /// Vertices inside: those at home, and images.
    pub(super) images: usize,
    pub(super) moves: usize,
    pub(super) insertions: usize,
    pub(super) removals: usize,
    pub(super) vectors: usize,
    /// As many, or none.
    pub(super) staged_vectors: usize,
    /// Bytes of what is inside.
    pub(super) inside_bytes: usize,
    /// All but the number of hidden vertices.
    pub(super) statistics: CommitReport,
}

impl PeriodicHeader {
    /// Bytes of all data, if they are not too many for a number.
    pub(super) fn size(&self) -> Option<u64> {
        let (d, r) = (u128::from(self.dimension), self.vectors as u128);
        let weight = u128::from(self.has_weights);
        let sum = |counts: &[usize]| counts.iter().map(|&n| n as u128).sum::<u128>();
        let bytes = (SIZE + Beginning::CHECKSUM) as u128
            + 8 * d * sum(&[self.vectors, self.staged_vectors])
            + 8 * (d + weight) * sum(&[self.moves, self.insertions])
            + 8 * weight * N_SUMS_OF_WEIGHTS as u128
            + 8 * r * self.ids as u128
            + 4 * sum(&[self.moves, self.removals])
            + (4 + 4 * r) * self.images as u128
            + self.inside_bytes as u128;
        u64::try_from(bytes).ok()
    }

    /// Its bytes.
    pub(super) fn bytes(&self) -> [u8; SIZE] {
        let beginning = Beginning {
            version: Beginning::of_periodic(self.has_weights),
            dimension: self.dimension,
            size: self.size().expect("what is in memory has a size"),
            counts: [self.ids, self.images, self.moves, self.insertions, self.removals],
        };
        let mut bytes = [0; SIZE];
        bytes[..Beginning::SIZE].copy_from_slice(&beginning.bytes(&self.statistics));
        let counts = [self.vectors, self.staged_vectors, self.inside_bytes];
        for (place, count) in bytes[Beginning::SIZE..].chunks_exact_mut(8).zip(counts) {
            place.copy_from_slice(&(count as u64).to_le_bytes());
        }
        bytes
    }

    /// Reads it, and checks that the data are as long as it says.
    pub(super) fn read(data: &[u8]) -> Result<Self, Damage> {
        let beginning = Beginning::read(data, data.len() as u64)?;
        let Some(has_weights) = beginning.is_periodic_with_weights() else {
            return Err(Damage::Periodic { is_periodic: false });
        };
        let Beginning { dimension, size, counts, .. } = beginning;
        if data.len() < SIZE {
            return Err(Damage::NoHeader { given: data.len(), wanted: SIZE });
        }
        let mut more = [0; 3];
        for (bytes, count) in data[Beginning::SIZE..].as_chunks().0.iter().zip(&mut more) {
            *count = usize::try_from(u64::from_le_bytes(*bytes)).map_err(|_| Damage::Counts)?;
        }
        let [ids, images, moves, insertions, removals] = counts;
        let [vectors, staged_vectors, inside_bytes] = more;
        let statistics = Beginning::statistics_of(data)?;
        let header = PeriodicHeader {
            dimension,
            has_weights,
            ids,
            images,
            moves,
            insertions,
            removals,
            vectors,
            staged_vectors,
            inside_bytes,
            statistics,
        };
        let has_vectors = (1..=dimension as usize).contains(&vectors);
        let is_as_many = staged_vectors == 0 || staged_vectors == vectors;
        if !has_vectors || !is_as_many || header.size() != Some(size) {
            return Err(Damage::Counts);
        }
        Ok(header)
    }
}
