//! *Rebuilding* (report, section 1): triangulate all positions anew.
//!
//! The storage order of the sites is kept while it serves: motions are small, so what was near still is. Where sites next
//! to each other in storage have gone apart, they are sorted first.

use super::{CommitReport, MovingTriangulation};
use crate::delaunay::Dimension;
use crate::error::Result;

/// Sites are sorted when the mean distance of those next to each other has become so much greater. Measured with
/// displacements of up to ten spacings (`make targets` keeps two, `leap_1` and `leap_10`): less sorts in vain, with more
/// the walks take longer than to sort.
const STRAYED: f64 = 1.7;

impl<G: Dimension> MovingTriangulation<G> {
    /// Brings all staged vertices to their new positions and rebuilds.
    pub(super) fn rebuild_staged(&mut self, report: &mut CommitReport) -> Result<()> {
        self.staging.list()?;
        self.commit_by_rebuilding(0, report)
    }

    /// Brings all listed vertices from `first` on to their new positions and rebuilds.
    pub(super) fn commit_by_rebuilding(&mut self, first: usize, report: &mut CommitReport) -> Result<()> {
        self.spread_hidden()?;
        for k in first..self.staging.vertices.len() {
            let v = self.staging.vertices[k];
            if self.exchange_position(v) {
                report.moved += 1;
            }
            self.staging.applied = k + 1;
        }
        report.rebuilds += 1;
        if self.kernel.mean_stride() > STRAYED * self.sorted_stride || !self.kernel.has_even_parts() {
            self.sort_and_rebuild()
        } else {
            self.rebuild()
        }
    }

    /// Exchanges the position of a vertex that has a site of its own with the staged one; whether they differ.
    pub(super) fn exchange_position(&mut self, vertex: u32) -> bool {
        let s = self.site_of[vertex as usize];
        let staged = &mut self.staging.positions[vertex as usize];
        let old = self.kernel.site(s).point;
        let new = std::mem::replace(staged, old);
        self.kernel.set_point(s, new);
        old != new
    }

    /// Triangulates the sites where they are; every vertex has one of its own. The monitor may cancel.
    pub(super) fn rebuild(&mut self) -> Result<()> {
        self.regions.invalidate();
        self.kernel.take_changes();
        let site_of = &mut self.site_of;
        self.kernel.restore_parts(|id, s| site_of[id as usize] = s);
        let mut quiet = |_| true;
        let merges = match &mut self.options.monitor {
            Some(monitor) => self.kernel.rebuild(monitor)?,
            None => self.kernel.rebuild(&mut quiet)?,
        };
        for merge in merges {
            self.site_of[merge.hidden as usize] = merge.site;
            self.site_of[self.kernel.site(merge.site).id as usize] = merge.site;
            self.hidden.add(merge.site, merge.hidden);
        }
        Ok(())
    }

    /// As [`rebuild`](Self::rebuild), but not to be cancelled: the way back after a failure.
    pub(super) fn rebuild_quietly(&mut self) -> Result<()> {
        let monitor = self.options.monitor.take();
        let rebuilt = self.rebuild();
        self.options.monitor = monitor;
        rebuilt
    }
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Dimension, Plane, Space};
    use crate::motion::{Algorithm, MovingTriangulation, Options};

    /// The mean distance in storage after each of a few commits of vertices that go anywhere, next to that at first.
    fn strides<G: Dimension>() -> Vec<f64> {
        let mut state = 1_u64;
        let mut points = || {
            let mut points = vec![G::Point::default(); 2_000];
            for p in &mut points {
                for axis in 0..G::D {
                    state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
                    p[axis] = (state >> 40) as f64;
                }
            }
            points
        };
        let options = Options { algorithm: Algorithm::Rebuilding, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points(), options).expect("room");
        let first = t.kernel.mean_stride();
        let commit = |_| {
            t.move_all(&points()).expect("good places");
            t.commit_timestamp().expect("room");
            t.kernel.mean_stride() / first
        };
        (0..4).map(commit).collect()
    }

    /// Storage follows vertices that have gone far away at once, not after a slow build.
    #[test]
    fn storage_is_in_order_after_every_leap() {
        for strides in [strides::<Plane>(), strides::<Space>()] {
            assert!(strides.iter().all(|stride| (0.8..1.2).contains(stride)), "{strides:?}");
        }
    }
}
