//! Bytes and text on their way out, handed on in chunks.

use std::fmt::{self, Write};

use crate::delaunay::Moving;
use crate::error::Result;

/// Bytes that are handed on at a time, at most.
const CHUNK: usize = 1 << 14;

/// What waits to be handed on to `put`.
pub(crate) struct Chunks<P> {
    put: P,
    n: usize,
    bytes: [u8; CHUNK],
}

impl<E, P: FnMut(&[u8]) -> Result<(), E>> Chunks<P> {
    pub(crate) fn new(put: P) -> Self {
        Chunks { put, n: 0, bytes: [0; CHUNK] }
    }

    fn flush(&mut self) -> Result<(), E> {
        let n = std::mem::take(&mut self.n);
        (self.put)(&self.bytes[..n])
    }

    /// Writes a few bytes.
    #[inline(always)]
    pub(crate) fn write<const N: usize>(&mut self, bytes: [u8; N]) -> Result<(), E> {
        const { assert!(N <= CHUNK) };
        if self.n + N > CHUNK {
            self.flush()?;
        }
        self.bytes[self.n..self.n + N].copy_from_slice(&bytes);
        self.n += N;
        Ok(())
    }

    pub(crate) fn point<G: Moving>(&mut self, point: &G::Point) -> Result<(), E> {
        self.first_numbers::<G>(point, G::D)
    }

    /// Writes all numbers of a point: its coordinates, and its weight if it has one.
    pub(crate) fn whole_point<G: Moving>(&mut self, point: &G::Point) -> Result<(), E> {
        self.first_numbers::<G>(point, G::NUMBERS)
    }

    fn first_numbers<G: Moving>(&mut self, point: &G::Point, n: usize) -> Result<(), E> {
        (0..n).try_for_each(|k| self.write(point[k].to_le_bytes()))
    }

    pub(crate) fn numbers(&mut self, numbers: &[u32]) -> Result<(), E> {
        numbers.iter().try_for_each(|number| self.write(number.to_le_bytes()))
    }

    /// Writes bytes, as many as there are.
    pub(crate) fn append(&mut self, mut more: &[u8]) -> Result<(), E> {
        while !more.is_empty() {
            if self.n == CHUNK {
                self.flush()?;
            }
            let (now, later) = more.split_at(more.len().min(CHUNK - self.n));
            self.bytes[self.n..self.n + now.len()].copy_from_slice(now);
            self.n += now.len();
            more = later;
        }
        Ok(())
    }

    /// Writes a text.
    pub(crate) fn text(&mut self, text: fmt::Arguments<'_>) -> Result<(), E> {
        let mut writer = TextChunks { chunks: self, failed: Ok(()) };
        // Writing fails where a chunk cannot be handed on.
        let _ = writer.write_fmt(text);
        writer.failed
    }

    /// Hands on the rest.
    pub(crate) fn end(mut self) -> Result<(), E> {
        self.flush()
    }
}

struct TextChunks<'c, E, P> {
    chunks: &'c mut Chunks<P>,
    failed: Result<(), E>,
}

impl<E, P: FnMut(&[u8]) -> Result<(), E>> Write for TextChunks<'_, E, P> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.failed = self.chunks.append(text.as_bytes());
        if self.failed.is_ok() { Ok(()) } else { Err(fmt::Error) }
    }
}
