//! The exact check of everything, for tests and for programs that want proof.
//!
//! Positive cells and locally empty spheres do *not* prove a triangulation: a star may wind twice around its site,
//! the hull may fold. The chain of proof is this. (1) The complex is closed: neighbours are mutual and agree on
//! their facets. (2) Finite cells are positively oriented, the hull is convex across every ridge of it, every hull
//! facet has one fixed point *o*, strictly inside a cell, on its inner side, and a ray from *o* crosses exactly one
//! hull facet. By (2) the hull, and so the whole map of the complex into space completed by a point at infinity, has
//! degree one; a map of degree one whose cells are all positive covers every generic point exactly once: the cells
//! are a triangulation of the convex hull. (3) Empty spheres across every facet, ties broken by id, then make it
//! *the* Delaunay triangulation. (4) Every live site is a corner, or is above the cell that has its place, so nothing is left out.
//!
//! Cost: one orientation per cell, one in-sphere test per facet. Nothing of this needs memory but the message, which is
//! cut off where there is none.

use std::fmt;

use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet, INFINITE};
use crate::ids::Slot;
use crate::machine::memory;

/// How much is checked; each level includes the ones before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Indices and adjacency.
    Structure,
    /// Orientation of the cells, convexity and winding of the hull.
    Embedding,
    /// Empty spheres: the triangulation is the Delaunay triangulation.
    Delaunay,
}

/// The first thing found wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Which level it belongs to.
    pub level: Level,
    /// What is wrong, with the vertex ids concerned.
    pub message: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Violation {}

type Check = Result<(), Violation>;

/// A formatted text, cut off where there is no memory for all of it.
macro_rules! text {
    ($($argument:tt)*) => { memory::text(format_args!($($argument)*)) };
}

/// Vertex ids of a cell, to be written.
struct Description<'t, G: Geometry> {
    t: &'t Delaunay<G>,
    cell: Slot,
}

impl<G: Geometry> fmt::Display for Description<'_, G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, &s) in self.t.complex.cell(self.cell).corners.as_ref().iter().enumerate() {
            f.write_str(if k == 0 { "(" } else { ", " })?;
            match self.t.sites.get(s.index()) {
                _ if s == INFINITE => f.write_str("infinite")?,
                Some(site) => write!(f, "{}", site.id)?,
                None => f.write_str("?")?,
            }
        }
        f.write_str(")")
    }
}

fn ensure(holds: bool, level: Level, message: impl FnOnce() -> String) -> Check {
    if holds { Ok(()) } else { Err(Violation { level, message: message() }) }
}

impl<G: Geometry> Delaunay<G> {
    /// Checks the triangulation up to a level.
    pub fn validate(&self, level: Level) -> Check {
        self.check_structure()?;
        if level >= Level::Embedding {
            self.check_orientation()?;
            self.check_hull()?;
        }
        if level >= Level::Delaunay {
            self.check_spheres()?;
        }
        Ok(())
    }

    /// Vertex ids of a cell, for messages.
    fn describe(&self, cell: Slot) -> Description<'_, G> {
        Description { t: self, cell }
    }

    fn check_structure(&self) -> Check {
        let level = Level::Structure;
        for site in self.sites[1..].iter().filter(|site| site.is_live()) {
            ensure(self.is_covered(&site.point), level, || {
                text!("vertex {} is outside the box for which the filters hold", site.id)
            })?;
        }
        let n = G::Corners::N;
        for c in self.complex.live() {
            self.prefetch_neighbours_after(c);
            let cell = self.complex.cell(c);
            for i in 0..n {
                let s = cell.corners[i];
                ensure(s.index() < self.sites.len(), level, || {
                    text!("cell {} has no such site {s}", self.describe(c))
                })?;
                ensure(s == INFINITE || self.site(s).is_live(), level, || {
                    text!("cell {} has a removed corner", self.describe(c))
                })?;
                ensure(s != INFINITE || i == n - 1, level, || {
                    text!("the ghost corner of {} is not last", self.describe(c))
                })?;
                ensure((0..i).all(|j| cell.corners[j] != s), level, || {
                    text!("cell {} has a corner twice", self.describe(c))
                })?;
                let across = cell.neighbour(i);
                let exists = across.cell().index() < self.complex.n_slots()
                    && across.index() < n
                    && !self.complex.is_free(across.cell());
                ensure(exists, level, || {
                    text!("cell {} has no neighbour opposite corner {i}", self.describe(c))
                })?;
                let other = self.complex.cell(across.cell());
                let agree = (0..n).all(|j| {
                    j == i || (0..n).any(|k| k != across.index() && other.corners[k] == cell.corners[j])
                });
                ensure(agree && other.neighbour(across.index()) == Facet::new(c, i), level, || {
                    text!(
                        "cells {} and {} do not meet in a facet",
                        self.describe(c),
                        self.describe(across.cell())
                    )
                })?;
            }
        }
        let n_slots = self.complex.n_slots();
        for c in self.complex.free_cells() {
            let is_free = c.index() < n_slots && self.complex.is_free(c);
            ensure(is_free, level, || text!("cell {c} is listed as free, and is not"))?;
        }
        let n_free = Slot::range(0..n_slots).filter(|&c| self.complex.is_free(c)).count();
        let n_listed = self.complex.free_cells().count();
        ensure(n_free == n_listed, level, || text!("{n_free} cells are free, and {n_listed} are listed"))?;
        ensure(n_free == self.complex.n_free(), level, || text!("free cells are miscounted"))?;
        for s in self.live_sites() {
            let site = self.site(s);
            if !self.has_cells() {
                ensure(G::HAS_WEIGHTS || self.flat.site_at(&site.point) == Some(s), level, || {
                    text!("vertex {} is not at its place", site.id)
                })?;
                continue;
            }
            if self.is_hidden(s) {
                let is_above = self.complex.is_live(self.cell_below(s)) && self.is_listed(s);
                ensure(is_above, level, || text!("vertex {} is in no cell, and above none", site.id))?;
                continue;
            }
            // So it is a corner of some cell.
            let points_back =
                self.complex.is_live(site.cell) && self.complex.cell(site.cell).corners.as_ref().contains(&s);
            ensure(points_back, level, || text!("the cell of vertex {} does not have it", site.id))?;
        }
        let hull = self.site(INFINITE).cell;
        let has_hull = !self.has_cells() || self.complex.is_live(hull) && self.complex.cell(hull).is_ghost();
        ensure(has_hull, level, || text!("cell {hull} of the ghost vertex is no ghost"))?;
        let can_walk = !self.has_cells() || self.complex.is_live(self.recent);
        ensure(can_walk, level, || text!("cell {}, where walks begin, is gone", self.recent))
    }

    fn check_orientation(&self) -> Check {
        for c in self.complex.finite() {
            let positive = G::orientation(&self.filter, self.view(), &self.complex.cell(c).corners) > 0.0;
            ensure(positive, Level::Embedding, || {
                text!("cell {} is not positively oriented", self.describe(c))
            })?;
        }
        if self.has_cells() {
            return ensure(self.complex.n_finite() > 0, Level::Embedding, || {
                text!("there are only ghost cells")
            });
        }
        let basis = self.flat.basis.sites();
        let mut points = [G::Point::default(); 5];
        for (point, &s) in points.iter_mut().zip(basis) {
            *point = self.site(s).point;
        }
        for s in self.live_sites() {
            points[basis.len()] = self.site(s).point;
            let (more, points) = (&points[..=basis.len()], &points[..basis.len()]);
            let dependent = points.contains(&self.site(s).point) || G::is_dependent(&self.filter, more);
            ensure(dependent && basis.len() <= G::D, Level::Embedding, || {
                text!(
                    "there are no cells, but vertex {} is out of the hyperplane of the others",
                    self.site(s).id
                )
            })?;
        }
        Ok(())
    }

    fn check_hull(&self) -> Check {
        let level = Level::Embedding;
        if !self.has_cells() {
            return Ok(());
        }
        let inner = self.inner();
        let (mut ghosts, mut crossings) = (0, 0);
        for c in self.complex.live().filter(|&c| self.complex.cell(c).is_ghost()) {
            ghosts += 1;
            let cell = self.complex.cell(c);
            for i in 0..Self::LAST {
                let across = cell.neighbour(i);
                let apex = self.site(self.complex.cell(across.cell()).corners[across.index()]);
                let beyond =
                    G::orientation_with(&self.filter, self.view(), &cell.corners, Self::LAST, &apex.point);
                ensure(beyond <= 0.0, level, || {
                    text!(
                        "the hull is not convex between {} and {}",
                        self.describe(c),
                        self.describe(across.cell())
                    )
                })?;
            }
            if let Some(o) = &inner {
                ensure(self.is_inside(c, o), level, || {
                    text!("the hull facet {} turns its outer side inwards", self.describe(c))
                })?;
                crossings += usize::from(self.is_crossed(c, o));
            }
        }
        ensure(ghosts == self.complex.n_ghosts(), level, || {
            text!("{ghosts} hull facets, {} counted", self.complex.n_ghosts())
        })?;
        ensure(inner.is_none() || crossings == 1, level, || {
            text!("a ray from inside a cell crosses {crossings} hull facets, not one")
        })
    }

    /// Every hidden site is above a cell that has its place.
    fn check_hidden(&self) -> Check {
        for s in self.live_sites().filter(|&s| self.is_hidden(s)) {
            let (site, c) = (self.site(s), self.cell_below(s));
            let is_there = !self.complex.cell(c).is_ghost() && self.has_place(c, &site.point);
            ensure(is_there, Level::Delaunay, || {
                text!("vertex {} is not in cell {}, which it is above", site.id, self.describe(c))
            })?;
            let is_above = !self.is_in_conflict(c, &site.point, site.id);
            ensure(is_above, Level::Delaunay, || {
                text!("vertex {} is hidden, and below cell {}", site.id, self.describe(c))
            })?;
        }
        Ok(())
    }

    fn check_spheres(&self) -> Check {
        self.check_hidden()?;
        for c in self.complex.finite() {
            self.prefetch_around_cells_after(c);
            for i in 0..G::Corners::N {
                let facet = Facet::new(c, i);
                let holds = self.is_facet_required(c, i) || self.is_locally_delaunay(facet);
                ensure(holds, Level::Delaunay, || {
                    let across = self.complex.cell(c).neighbour(i);
                    let apex = self.complex.cell(across.cell()).corners[across.index()];
                    text!("vertex {} is inside the sphere of cell {}", self.site(apex).id, self.describe(c))
                })?;
            }
        }
        // In a flat part of the hull, the ghost cells have spheres too: those of the finite cells behind them.
        for c in self.complex.live().filter(|&c| self.complex.cell(c).is_ghost()) {
            for i in 0..Self::LAST {
                let across = self.complex.cell(c).neighbour(i);
                let apex = self.site(self.complex.cell(across.cell()).corners[across.index()]);
                ensure(
                    !self.is_in_conflict_with_ghost(&self.filter, c, &apex.point, apex.id),
                    Level::Delaunay,
                    || text!("vertex {} is in conflict with the hull facet {}", apex.id, self.describe(c)),
                )?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
