//! Bad triangles that wait, those with the shortest edge first, to half an octave; equal ones in the order in which they came.
//!
//! Short edges first: what a triangle gets beside them is small as well, and large triangles beside it often become good
//! by that (Shewchuk, 10.1016/S0925-7721(01)00047-5).

use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// Bits of a squared length that tell two queues apart: its exponent.
const SHIFT: u32 = 52;
const N_QUEUES: usize = 1 << (63 - SHIFT);
const N_WORDS: usize = N_QUEUES / 64;
const END: u32 = u32::MAX;

/// A triangle that waits. It is the one meant if it still has these corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    pub(super) triangle: u32,
    pub(super) corners: [VertexId; 3],
}

/// The queues.
#[derive(Debug)]
pub(super) struct Queues {
    entries: Vec<(Waiting, u32)>,
    free: u32,
    /// First and last entry of each queue.
    ends: Vec<[u32; 2]>,
    /// Which queues have entries.
    words: [u64; N_WORDS],
}

impl Queues {
    pub(super) fn new() -> Result<Self> {
        let mut ends = Vec::new();
        memory::lengthen(&mut ends, N_QUEUES, [END; 2])?;
        Ok(Queues { entries: Vec::new(), free: END, ends, words: [0; N_WORDS] })
    }

    /// Enters a triangle with a shortest edge of this squared length, not negative.
    pub(super) fn enter(&mut self, waiting: Waiting, shortest: f64) -> Result<()> {
        let queue = (shortest.to_bits() >> SHIFT) as usize;
        let entry = if self.free == END {
            memory::push(&mut self.entries, (waiting, END))?;
            (self.entries.len() - 1) as u32
        } else {
            let entry = self.free;
            self.free = self.entries[entry as usize].1;
            self.entries[entry as usize] = (waiting, END);
            entry
        };
        let ends = &mut self.ends[queue];
        if ends[0] == END {
            ends[0] = entry;
            self.words[queue / 64] |= 1 << (queue % 64);
        } else {
            self.entries[ends[1] as usize].1 = entry;
        }
        ends[1] = entry;
        Ok(())
    }

    /// The next one.
    pub(super) fn pop(&mut self) -> Option<Waiting> {
        let word = self.words.iter().position(|&word| word != 0)?;
        let queue = 64 * word + self.words[word].trailing_zeros() as usize;
        let entry = self.ends[queue][0];
        let (waiting, next) = self.entries[entry as usize];
        self.ends[queue][0] = next;
        if next == END {
            self.words[word] &= !(1 << (queue % 64));
        }
        self.entries[entry as usize].1 = self.free;
        self.free = entry;
        Some(waiting)
    }
}
