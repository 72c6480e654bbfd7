//! Reading bytes from the first to the last.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::Id;
use crate::machine::memory;

/// What has not been read.
pub(crate) struct Reader<'d>(pub(crate) &'d [u8]);

impl<'d> Reader<'d> {
    /// The next entries, of `N` bytes each; they are there, as the header has been checked.
    pub(crate) fn entries<const N: usize>(&mut self, n: usize) -> &'d [[u8; N]] {
        let (entries, rest) = self.0.split_at(n * N);
        self.0 = rest;
        entries.as_chunks().0
    }

    /// The next points, with their weights if they have some.
    pub(crate) fn points<G: Moving>(&mut self, n: usize) -> Result<Vec<G::Point>> {
        self.points_of::<G>(n, G::NUMBERS)
    }

    /// The next places, as points without weight.
    pub(crate) fn vectors<G: Moving>(&mut self, n: usize) -> Result<Vec<G::Point>> {
        self.points_of::<G>(n, G::D)
    }

    /// The next points of which so many numbers are there.
    fn points_of<G: Moving>(&mut self, n: usize, width: usize) -> Result<Vec<G::Point>> {
        let mut points = Vec::new();
        memory::reserve_exact(&mut points, n)?;
        points.extend(self.entries::<8>(n * width).chunks_exact(width).map(|bytes| {
            let mut point = G::Point::default();
            // The sum makes -0 into 0, so that equal places are equal bits.
            (0..width).for_each(|k| point[k] = f64::from_le_bytes(bytes[k]) + 0.0);
            point
        }));
        Ok(points)
    }

    /// The next ids.
    pub(crate) fn numbers<I: Id>(&mut self, n: usize) -> Result<Vec<I>> {
        let mut numbers = Vec::new();
        memory::reserve_exact(&mut numbers, n)?;
        numbers.extend(self.entries(n).iter().map(|&bytes| I::new(u32::from_le_bytes(bytes))));
        Ok(numbers)
    }
}
