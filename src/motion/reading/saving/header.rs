//! The first bytes: what the data are, and how much of each kind there is.

use crate::damage::Damage;
use crate::ids::{SegmentId, VertexId};
use crate::motion::report::CommitReport;
use crate::motion::state::density::Density;
use crate::motion::state::segments::{MAX_SEGMENTS, Segment};

/// What data begin with. A byte above 127, and ends of lines of either kind, tell a file that has been taken for text
/// on its way.
const MAGIC: [u8; 8] = *b"\x89DLD\r\n\x1a\n";

/// The version of the format, without segments and keys, with segments, with keys, and of what repeats; without keys and
/// with some where there is a [history](History); the two with it that list the segments in force, with the labels of
/// their sides; the two with it in which points have weights; and that of what repeats and has weights.
const VERSION: u32 = 1;
const WITH_SEGMENTS: u32 = 2;
const WITH_KEYS: u32 = 3;
const PERIODIC: u32 = 4;
const WITH_HISTORY: u32 = 5;
const WITH_KEYS_AND_HISTORY: u32 = 6;
const WITH_LIST: u32 = 7;
const WITH_KEYS_AND_LIST: u32 = 8;
const WITH_WEIGHTS: u32 = 9;
const WITH_KEYS_AND_WEIGHTS: u32 = 10;
const PERIODIC_WITH_WEIGHTS: u32 = 11;
const LATEST: u32 = PERIODIC_WITH_WEIGHTS;

/// Bytes of a key.
const KEY: usize = 8;

/// Bytes of a count.
const COUNT: usize = 8;

/// What stands for a staged segment that pieces are staged for: its second end is the id of no vertex, and not that of none,
/// which ends have that were removed before a compaction.
pub(super) const GIVEN_UP: Segment =
    Segment { ends: [VertexId::NONE, VertexId::new(u32::MAX - 1)], ..Segment::NOTHING };

/// Bytes of a vertex that refinement has made: its id, and the segment that it is on.
const MADE_VERTEX: usize = 8;

/// Bytes of a piece of a segment: its id, that of the segment, and the ends of that.
const PIECE: usize = 16;

/// Bytes of a history.
const HISTORY: usize = 96;

/// Sums that there are with weights alone: vertices that had another weight, that were hidden, and that were shown.
pub(crate) const N_SUMS_OF_WEIGHTS: usize = 3;

/// Bytes of the header.
pub(super) const SIZE: usize = 72 + 8 * N_SUMS;

/// Bytes of the checksum at the end.
const CHECKSUM: usize = 4;

const N_SUMS: usize = 12;

/// Sums above this are saved as this, and refused: no program reaches it, and so none that has been loaded overflows.
const GREATEST_SUM: u64 = (1 << 62) - 1;

/// What data of all versions begin with. The counts are of ids, of cells (of what repeats, of vertices inside), and of
/// staged moves, insertions and removals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beginning {
    pub(crate) version: u32,
    pub(crate) dimension: u32,
    /// Bytes of all data.
    pub(crate) size: u64,
    pub(crate) counts: [usize; 5],
}

impl Beginning {
    /// Bytes of it and of the statistics.
    pub(crate) const SIZE: usize = SIZE;

    /// Bytes of the checksum at the end of all data.
    pub(crate) const CHECKSUM: usize = CHECKSUM;

    /// The version of what repeats, with weights or without.
    pub(crate) const fn of_periodic(has_weights: bool) -> u32 {
        if has_weights { PERIODIC_WITH_WEIGHTS } else { PERIODIC }
    }

    /// Whether what repeats has weights; none for what does not repeat.
    pub(crate) fn is_periodic_with_weights(&self) -> Option<bool> {
        match self.version {
            PERIODIC => Some(false),
            PERIODIC_WITH_WEIGHTS => Some(true),
            _ => None,
        }
    }

    /// Its bytes, and those of the statistics.
    pub(crate) fn bytes(&self, statistics: &CommitReport) -> [u8; SIZE] {
        let mut bytes = [0; SIZE];
        bytes[..8].copy_from_slice(&MAGIC);
        bytes[8..12].copy_from_slice(&self.version.to_le_bytes());
        bytes[12..16].copy_from_slice(&self.dimension.to_le_bytes());
        let counts = self.counts.map(|n| n as u64);
        let numbers =
            std::iter::once(self.size).chain(counts).chain([statistics.timestamp.min(GREATEST_SUM)]);
        let numbers = numbers.chain(sums(statistics).map(|sum| sum.min(GREATEST_SUM)));
        for (place, number) in bytes[16..].chunks_exact_mut(8).zip(numbers) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes
    }

    /// Reads it, and checks that the data are as long as it says, of which `given` bytes are there, and these are the
    /// first.
    pub(crate) fn read(data: &[u8], given: u64) -> Result<Self, Damage> {
        let n_magic = MAGIC.len().min(data.len());
        if data[..n_magic] != MAGIC[..n_magic] {
            return Err(Damage::Foreign);
        }
        if data.len() < SIZE {
            return Err(Damage::NoHeader { given: data.len(), wanted: SIZE });
        }
        let version = word(data, 8);
        if !matches!(version, VERSION..=LATEST) {
            return Err(Damage::Version { given: version, latest: LATEST });
        }
        let size = number(data, 16);
        if size != given {
            return Err(Damage::Size { given: given as usize, wanted: size });
        }
        let dimension = word(data, 12);
        if !matches!(dimension, 2 | 3) {
            return Err(Damage::Dimension { given: dimension });
        }
        let mut counts = [0; 5];
        for (at, count) in (24..).step_by(8).zip(&mut counts) {
            *count = usize::try_from(number(data, at)).map_err(|_| Damage::Counts)?;
        }
        Ok(Beginning { version, dimension, size, counts })
    }

    /// Checks the checksum at the end of data that begin like this.
    pub(crate) fn check_sum(data: &[u8]) -> Result<(), Damage> {
        check_sum(data)
    }

    /// The timestamp and the sums that follow it.
    pub(crate) fn statistics_of(data: &[u8]) -> Result<CommitReport, Damage> {
        let mut numbers = [0; 1 + N_SUMS];
        for (at, place) in (64..).step_by(8).zip(&mut numbers) {
            *place = number(data, at);
            if *place > GREATEST_SUM {
                return Err(Damage::Sum { offset: at, value: *place });
            }
        }
        let [timestamp, sums @ ..] = numbers;
        Ok(of_sums(timestamp, sums))
    }
}

/// What was before insertions were staged, and is again when they are discarded; and what refinement compares with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct History {
    /// How many ids had been given, which are not given again.
    pub(super) n_known: usize,
    /// Whether vertices had keys.
    pub(super) had_keys: bool,
    pub(super) density: Density,
}

impl History {
    /// In the order in which they are saved.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u64> + use<> {
        [self.n_known as u64, u64::from(self.had_keys)].into_iter().chain(self.density.numbers())
    }

    /// The history that twelve numbers give.
    pub(super) fn of([n_known, had_keys, density @ ..]: [u64; 12]) -> Result<Self, Damage> {
        let n_known = usize::try_from(n_known).map_err(|_| Damage::Counts)?;
        let density = Density::of_numbers(density).ok_or(Damage::Counts)?;
        match had_keys {
            0 | 1 => Ok(History { n_known, had_keys: had_keys == 1, density }),
            _ => Err(Damage::Counts),
        }
    }
}

/// How much there is of everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) dimension: u32,
    pub(super) ids: usize,
    pub(super) cells: usize,
    pub(super) moves: usize,
    pub(super) insertions: usize,
    pub(super) removals: usize,
    /// Whether vertices have keys of the program's.
    pub(super) has_keys: bool,
    /// Whether points have weights.
    pub(super) has_weights: bool,
    /// Whether there is a history: where it does not follow from the rest, and always with a list of segments, or with
    /// weights.
    pub(super) has_history: bool,
    /// Whether the segments in force are listed.
    pub(super) has_list: bool,
    /// Bytes about segments, 0 without any.
    pub(super) segment_bytes: usize,
    /// All but the number of hidden vertices.
    pub(super) statistics: CommitReport,
}

impl Header {
    /// Bytes of all data, if they are not too many for a number.
    pub(super) fn size(&self) -> Option<u64> {
        let (d, places) = (u128::from(self.dimension), [self.ids, self.moves, self.insertions]);
        let weight = u128::from(self.has_weights);
        let numbers = [self.ids, self.moves, self.insertions, self.removals];
        let sum = |counts: &[usize]| counts.iter().map(|&n| n as u128).sum::<u128>();
        let bytes = SIZE as u128
            + 8 * (d + weight) * sum(&places)
            + weight * (4 * self.ids as u128 + 8 * N_SUMS_OF_WEIGHTS as u128)
            + 4 * (sum(&numbers) + 2 * (d + 1) * self.cells as u128)
            + if self.has_keys { KEY as u128 * self.ids as u128 } else { 0 }
            + if self.has_history { HISTORY as u128 } else { 0 }
            + self.segment_bytes as u128
            + CHECKSUM as u128;
        u64::try_from(bytes).ok()
    }

    /// Its bytes.
    pub(super) fn bytes(&self) -> [u8; SIZE] {
        let version = match (self.has_history, self.has_keys, self.segment_bytes > 0) {
            (_, true, _) if self.has_weights => WITH_KEYS_AND_WEIGHTS,
            (_, false, _) if self.has_weights => WITH_WEIGHTS,
            (true, true, _) if self.has_list => WITH_KEYS_AND_LIST,
            (true, false, _) if self.has_list => WITH_LIST,
            (true, true, _) => WITH_KEYS_AND_HISTORY,
            (true, false, _) => WITH_HISTORY,
            (false, true, _) => WITH_KEYS,
            (false, false, true) => WITH_SEGMENTS,
            (false, false, false) => VERSION,
        };
        let size = self.size().expect("what is in memory has a size");
        let counts = [self.ids, self.cells, self.moves, self.insertions, self.removals];
        Beginning { version, dimension: self.dimension, size, counts }.bytes(&self.statistics)
    }

    /// Reads it, and checks that the data are as long as it says, of which `given` bytes are there, and these are the
    /// first.
    pub(super) fn read(data: &[u8], given: u64) -> Result<Self, Damage> {
        let beginning = Beginning::read(data, given)?;
        if beginning.is_periodic_with_weights().is_some() {
            return Err(Damage::Periodic { is_periodic: true });
        }
        let Beginning { version, dimension, size, counts } = beginning;
        let [ids, cells, moves, insertions, removals] = counts;
        let has_keys =
            matches!(version, WITH_KEYS | WITH_KEYS_AND_HISTORY | WITH_KEYS_AND_LIST | WITH_KEYS_AND_WEIGHTS);
        let has_history = version >= WITH_HISTORY;
        let has_list = matches!(version, WITH_LIST | WITH_KEYS_AND_LIST);
        let has_weights = version >= WITH_WEIGHTS;
        let counts = Header { dimension, ids, cells, moves, insertions, removals, ..Header::default() };
        let mut header = Header { has_keys, has_weights, has_history, has_list, ..counts };
        if version != VERSION && !has_weights {
            // All that is left is about segments; how much that has to be is told there.
            let left = header.size().and_then(|known| size.checked_sub(known)).ok_or(Damage::Counts)?;
            header.segment_bytes = usize::try_from(left).map_err(|_| Damage::Counts)?;
        }
        let may_lack_segments = version != WITH_SEGMENTS && !has_list && header.segment_bytes == 0;
        let has_counts =
            may_lack_segments || header.segment_bytes >= COUNT * SegmentCounts::n_counts(has_list);
        if header.size() != Some(size) || !has_counts {
            return Err(Damage::Counts);
        }
        header.statistics = Beginning::statistics_of(data)?;
        Ok(header)
    }
}

/// How many segments there are in saved data: ids given, those that have been committed, which are the first, and removals
/// that are staged; vertices that refinement has made, and pieces; and, where they are listed, the segments in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SegmentCounts {
    pub(super) ids: usize,
    pub(super) enforced: usize,
    pub(super) removals: usize,
    pub(super) made_vertices: usize,
    pub(super) pieces: usize,
    pub(super) listed: Option<usize>,
}

impl SegmentCounts {
    /// How many counts there are.
    pub(super) fn n_counts(has_list: bool) -> usize {
        if has_list { 6 } else { 5 }
    }

    /// How many numbers a segment takes: its ends and its marker; in a list its id before, and the labels of its sides behind.
    pub(super) fn numbers_of_one(&self) -> usize {
        if self.listed.is_some() { 6 } else { 3 }
    }

    /// How many segments have a row: those of all ids, or those in force and those that are staged.
    pub(super) fn rows(&self) -> usize {
        self.listed.map_or(self.ids, |listed| listed + (self.ids - self.enforced))
    }

    /// The segment of the numbers of a row, and its id.
    pub(super) fn row(&self, k: usize, numbers: &[[u8; 4]]) -> (SegmentId, Segment) {
        let number = |k: usize| u32::from_le_bytes(numbers[k]);
        let of = |k: usize, sides: [u32; 2]| Segment {
            ends: [number(k), number(k + 1)].map(VertexId::new),
            marker: number(k + 2) as i32,
            sides: sides.map(|label| label as i32),
        };
        match self.listed {
            Some(_) => (SegmentId::new(number(0)), of(1, [number(4), number(5)])),
            None => (SegmentId::at(k), of(0, Segment::NOTHING.sides.map(|label| label as u32))),
        }
    }

    /// In the order in which they are saved.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u64> {
        let all = [self.ids, self.enforced, self.removals, self.made_vertices, self.pieces];
        all.into_iter().chain(self.listed).map(|n| n as u64)
    }

    /// Bytes of all that is about segments.
    pub(super) fn bytes(&self) -> u128 {
        let sizes = [
            (Self::n_counts(self.listed.is_some()), COUNT),
            (self.rows(), 4 * self.numbers_of_one()),
            (self.removals, 4),
            (self.made_vertices, MADE_VERTEX),
            (self.pieces, PIECE),
        ];
        sizes.iter().map(|&(n, size)| n as u128 * size as u128).sum()
    }

    /// The counts that five or six numbers give, if all takes as many bytes as the header says.
    pub(super) fn of(numbers: &[u64], header: &Header) -> Result<Self, Damage> {
        let number = |k: usize| usize::try_from(numbers[k]).map_err(|_| Damage::Counts);
        let counts = SegmentCounts {
            ids: number(0)?,
            enforced: number(1)?,
            removals: number(2)?,
            made_vertices: number(3)?,
            pieces: number(4)?,
            listed: (numbers.len() > 5).then(|| number(5)).transpose()?,
        };
        let SegmentCounts { ids, enforced, listed, .. } = counts;
        let are_in_order = listed.unwrap_or(0) <= enforced && enforced <= ids && ids <= MAX_SEGMENTS;
        if are_in_order && counts.bytes() == header.segment_bytes as u128 {
            Ok(counts)
        } else {
            Err(Damage::Counts)
        }
    }
}

/// The sums that there are with weights alone, in the order in which they are saved.
pub(crate) fn sums_of_weights(statistics: &CommitReport) -> [u64; N_SUMS_OF_WEIGHTS] {
    let sums = [statistics.reweighted, statistics.newly_hidden, statistics.newly_shown];
    sums.map(|sum| sum.min(GREATEST_SUM))
}

/// Enters these sums, which are at this place in the data.
pub(crate) fn enter_sums_of_weights(
    statistics: &mut CommitReport,
    sums: &[[u8; 8]],
    offset: usize,
) -> Result<(), Damage> {
    let places = [&mut statistics.reweighted, &mut statistics.newly_hidden, &mut statistics.newly_shown];
    for (k, (place, &bytes)) in places.into_iter().zip(sums).enumerate() {
        *place = u64::from_le_bytes(bytes);
        if *place > GREATEST_SUM {
            return Err(Damage::Sum { offset: offset + 8 * k, value: *place });
        }
    }
    Ok(())
}

/// The number of four bytes at a place.
fn word(data: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(data[at..at + 4].try_into().expect("four bytes"))
}

/// The number of eight bytes at a place.
fn number(data: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(data[at..at + 8].try_into().expect("eight bytes"))
}

/// Checks the checksum at the end of data whose header is right.
pub(super) fn check_sum(data: &[u8]) -> Result<(), Damage> {
    let end = data.len() - CHECKSUM;
    let (given, wanted) = (word(data, end), crc32fast::hash(&data[..end]));
    if given == wanted { Ok(()) } else { Err(Damage::Checksum { given, wanted }) }
}

/// The sums, in the order in which they are saved.
fn sums(statistics: &CommitReport) -> [u64; N_SUMS] {
    [
        statistics.moved,
        statistics.unchanged,
        statistics.placements,
        statistics.flips,
        statistics.rebuilds,
        statistics.within_tolerance,
        statistics.within_safe_region,
        statistics.tolerances,
        statistics.certificates,
        statistics.exact_calls,
        statistics.inserted,
        statistics.removed,
    ]
}

fn of_sums(timestamp: u64, sums: [u64; N_SUMS]) -> CommitReport {
    let [
        moved,
        unchanged,
        placements,
        flips,
        rebuilds,
        within_tolerance,
        within_safe_region,
        tolerances,
        certificates,
        exact_calls,
        inserted,
        removed,
    ] = sums;
    CommitReport {
        timestamp,
        moved,
        unchanged,
        placements,
        flips,
        rebuilds,
        within_tolerance,
        within_safe_region,
        tolerances,
        certificates,
        exact_calls,
        coincident: 0,
        inserted,
        removed,
        ..CommitReport::default()
    }
}
