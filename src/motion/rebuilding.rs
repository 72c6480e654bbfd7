//! *Rebuilding* (report, section 1): triangulate all positions anew.
//!
//! The storage order of the sites is kept while it serves: motions are small, so what was near still is. When walks
//! have become half as long again as in sorted storage, the sites are sorted first.

use super::{CommitReport, MovingTriangulation};
use crate::delaunay::Dimension;
use crate::error::Result;

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
        if self.kernel.mean_walk() > 1.5 * self.sorted_walk + 0.5 || !self.kernel.has_even_parts() {
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
