//! A copy of a kernel: sites and cells keep their names.

use super::{Delaunay, Geometry};
use crate::error::Result;
use crate::machine::memory;

impl<G: Geometry> Delaunay<G> {
    /// A copy, without scratch memory and landmarks. No change must be under way.
    pub(crate) fn copied(&self) -> Result<Self> {
        Ok(Delaunay {
            sites: memory::copy_of(&self.sites)?,
            keys: self.keys.copied()?,
            free_sites: memory::copy_of(&self.free_sites)?,
            parts: self.parts.copy()?,
            complex: self.complex.copied()?,
            required: memory::copy_of(&self.required)?,
            is_constrained: self.is_constrained,
            filter: self.filter,
            lower: self.lower,
            upper: self.upper,
            flat: self.flat.copied()?,
            above: self.above.copied()?,
            is_sorted: self.is_sorted,
            n_replaced: self.n_replaced,
            recent: self.recent,
            relocated: self.relocated,
            certificates: self.certificates,
            link_sites: self.link_sites,
            ..Delaunay::empty_on(self.threads)
        })
    }
}
