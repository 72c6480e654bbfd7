//! Writing all bytes, from the first to the last.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{Chunks, sums_of_weights};
use crate::periodic::images::Image;
use crate::periodic::lattice::HOME;
use crate::periodic::saving::header::PeriodicHeader;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    fn header(&self) -> PeriodicHeader {
        PeriodicHeader {
            dimension: G::D as u32,
            has_weights: G::HAS_WEIGHTS,
            ids: self.inside.images.n_vertices(),
            images: self.inside.images.len(),
            moves: self.staged.moves().len(),
            insertions: self.staged.insertions().len(),
            removals: self.staged.removals().len(),
            vectors: self.lattice.rank(),
            staged_vectors: self.coming.as_ref().map_or(0, |lattice| lattice.rank()),
            inside_bytes: self.inside.t.saved_size(),
            statistics: self.statistics,
        }
    }

    /// How many bytes [`save`](Self::save) writes.
    pub fn saved_size(&self) -> usize {
        self.header().size().and_then(|size| usize::try_from(size).ok()).expect("it fits in memory")
    }

    /// Hands on all bytes from which [`load`](Self::load) makes a triangulation like this one, a few thousand at a time.
    ///
    /// Cost: a pass over what is saved, images included.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] and [`Error::Prepared`], before the first byte; and those of `put`, with which it ends.
    pub fn save<E: From<Error>>(&self, mut put: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        self.reject_prepared()?;
        // What is inside needs memory for its cells when it is written, unless that has been asked for.
        self.inside.t.cells()?;
        let mut checksum = crc32fast::Hasher::new();
        let mut chunks = Chunks::new(|bytes: &[u8]| {
            checksum.update(bytes);
            put(bytes)
        });
        chunks.write(self.header().bytes())?;
        let vectors = self.lattice.given().iter();
        let staged = self.coming.iter().flat_map(|lattice| lattice.given());
        vectors.chain(staged).try_for_each(|vector| chunks.point::<G>(vector))?;
        let goals = self.staged.moves().iter().map(|(vertex, goal)| self.staged_parts_of(*vertex, goal));
        for point in goals.chain(self.staged.insertions().iter().copied()) {
            chunks.whole_point::<G>(&point)?;
        }
        let rank = self.lattice.rank();
        for wrap in &self.wraps {
            wrap[..rank].iter().try_for_each(|n| chunks.write(n.to_le_bytes()))?;
        }
        self.staged.moves().iter().try_for_each(|(v, _)| chunks.numbers(&[v.get()]))?;
        chunks.numbers(VertexId::numbers_of(self.staged.removals()))?;
        for image in self.inside.images.as_slice() {
            chunks.numbers(&[image.vertex.get()])?;
            let shift = if *image == Image::GONE { HOME } else { image.shift };
            shift[..rank].iter().try_for_each(|n| chunks.write(n.to_le_bytes()))?;
        }
        if G::HAS_WEIGHTS {
            sums_of_weights(&self.statistics).iter().try_for_each(|sum| chunks.write(sum.to_le_bytes()))?;
        }
        self.inside.t.save(|bytes| chunks.append(bytes))?;
        chunks.end()?;
        put(&checksum.finalize().to_le_bytes())
    }

    /// All bytes that [`save`](Self::save) writes.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn saved(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        memory::reserve_exact(&mut bytes, self.saved_size())?;
        self.save(|more| memory::append(&mut bytes, more))?;
        debug_assert_eq!(bytes.len(), self.saved_size());
        Ok(bytes)
    }
}
