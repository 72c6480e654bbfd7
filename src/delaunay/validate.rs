//! The exact check of everything, for tests and for callers who want proof.
//!
//! Positive cells and locally empty spheres do *not* prove a triangulation: a star may wind twice around its site,
//! the hull may fold. The chain of proof is this. (1) The complex is closed: neighbours are mutual and agree on
//! their facets. (2) Finite cells are positively oriented, the hull is convex across every ridge of it, every hull
//! facet has one fixed point *o*, strictly inside a cell, on its inner side, and a ray from *o* crosses exactly one
//! hull facet. By (2) the hull, and so the whole map of the complex into space completed by a point at infinity, has
//! degree one; a map of degree one whose cells are all positive covers every generic point exactly once: the cells
//! are a triangulation of the convex hull. (3) Empty spheres across every facet, ties broken by id, then make it
//! *the* Delaunay triangulation. (4) Every live site is a corner, so nothing is left out.
//!
//! Cost: one orientation per cell, one in-sphere test per facet.

use std::fmt;

use super::{Delaunay, Dimension};
use crate::complex::{Corners, Facet, INFINITE, NONE};

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

fn ensure(holds: bool, level: Level, message: impl FnOnce() -> String) -> Check {
    if holds { Ok(()) } else { Err(Violation { level, message: message() }) }
}

impl<G: Dimension> Delaunay<G> {
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
    fn describe(&self, cell: u32) -> String {
        let name = |s: &u32| match *s {
            INFINITE => "infinite".to_string(),
            s => self.sites.get(s as usize).map_or("?".to_string(), |site| site.id.to_string()),
        };
        let names: Vec<String> = self.complex.cell(cell).corners.as_ref().iter().map(name).collect();
        format!("({})", names.join(", "))
    }

    fn check_structure(&self) -> Check {
        let level = Level::Structure;
        let n = G::Corners::N;
        let mut is_corner = vec![false; self.sites.len()];
        for c in self.complex.live() {
            let cell = self.complex.cell(c);
            for i in 0..n {
                let s = cell.corners[i];
                ensure((s as usize) < self.sites.len(), level, || {
                    format!("cell {} has no such site {s}", self.describe(c))
                })?;
                ensure(s == INFINITE || self.site(s).is_live(), level, || {
                    format!("cell {} has a removed corner", self.describe(c))
                })?;
                ensure(s != INFINITE || i == n - 1, level, || {
                    format!("the ghost corner of {} is not last", self.describe(c))
                })?;
                ensure((0..i).all(|j| cell.corners[j] != s), level, || {
                    format!("cell {} has a corner twice", self.describe(c))
                })?;
                is_corner[s as usize] = true;
                let across = cell.neighbour(i);
                let exists = (across.cell() as usize) < self.complex.n_slots()
                    && across.index() < n
                    && !self.complex.is_free(across.cell());
                ensure(exists, level, || {
                    format!("cell {} has no neighbour opposite corner {i}", self.describe(c))
                })?;
                let other = self.complex.cell(across.cell());
                let agree = (0..n).all(|j| {
                    j == i || (0..n).any(|k| k != across.index() && other.corners[k] == cell.corners[j])
                });
                ensure(agree && other.neighbour(across.index()) == Facet::new(c, i), level, || {
                    format!(
                        "cells {} and {} do not meet in a facet",
                        self.describe(c),
                        self.describe(across.cell())
                    )
                })?;
            }
        }
        let mut are_listed = vec![false; self.complex.n_slots()];
        for &c in self.complex.free_cells() {
            let is_new = !std::mem::replace(&mut are_listed[c as usize], true);
            ensure(is_new && self.complex.is_free(c), level, || {
                format!("cell {c} is not free, or listed twice")
            })?;
        }
        let n_free = (0..self.complex.n_slots() as u32).filter(|&c| self.complex.is_free(c)).count();
        ensure(n_free == self.complex.free_cells().len(), level, || "a free cell is not listed".into())?;
        for s in self.live_sites() {
            let site = self.site(s);
            if !self.has_cells() {
                ensure(self.flat.site_at(&site.point) == Some(s), level, || {
                    format!("vertex {} is not at its place", site.id)
                })?;
                continue;
            }
            ensure(is_corner[s as usize], level, || format!("vertex {} is a corner of no cell", site.id))?;
            let points_back = site.cell != NONE
                && (site.cell as usize) < self.complex.n_slots()
                && self.complex.cell(site.cell).corners.as_ref().contains(&s);
            ensure(points_back, level, || format!("the cell of vertex {} does not have it", site.id))?;
        }
        let hull = self.site(INFINITE).cell;
        let has_hull = !self.has_cells() || self.complex.is_live(hull) && self.complex.cell(hull).is_ghost();
        ensure(has_hull, level, || format!("cell {hull} of the ghost vertex is no ghost"))?;
        let can_walk = !self.has_cells() || self.complex.is_live(self.recent);
        ensure(can_walk, level, || format!("cell {}, where walks begin, is gone", self.recent))
    }

    fn check_orientation(&self) -> Check {
        for c in self.complex.finite() {
            let positive = G::orientation(&self.filter, self.view(), &self.complex.cell(c).corners) > 0.0;
            ensure(positive, Level::Embedding, || {
                format!("cell {} is not positively oriented", self.describe(c))
            })?;
        }
        if self.has_cells() {
            return ensure(self.complex.n_finite() > 0, Level::Embedding, || {
                "there are only ghost cells".to_string()
            });
        }
        let points: Vec<G::Point> = self.flat.basis.iter().map(|&s| self.site(s).point).collect();
        for s in self.live_sites() {
            let mut more = points.clone();
            more.push(self.site(s).point);
            let dependent = points.contains(&self.site(s).point) || G::is_dependent(&self.filter, &more);
            ensure(dependent && points.len() <= G::D, Level::Embedding, || {
                format!(
                    "there are no cells, but vertex {} is out of the hyperplane of the others",
                    self.site(s).id
                )
            })?;
        }
        Ok(())
    }

    /// A point strictly inside a finite cell.
    fn inner_point(&self) -> Option<G::Point> {
        self.complex.finite().find_map(|c| {
            let corners = &self.complex.cell(c).corners;
            let mut o = G::Point::default();
            for k in 0..G::D {
                o[k] =
                    (0..G::Corners::N).map(|i| self.site(corners[i]).point[k] / G::Corners::N as f64).sum();
            }
            let inside = (0..G::D).all(|k| crate::predicates::is_in_range(o[k]))
                && (0..G::Corners::N)
                    .all(|i| G::orientation_with(&self.filter, self.view(), corners, i, &o) > 0.0);
            inside.then_some(o)
        })
    }

    fn check_hull(&self) -> Check {
        let level = Level::Embedding;
        if !self.has_cells() {
            return Ok(());
        }
        // If every cell is so thin that no double lies inside, only convexity is checked.
        let inner = self.inner_point();
        let mut ghosts = 0usize;
        for c in self.complex.live().filter(|&c| self.complex.cell(c).is_ghost()) {
            ghosts += 1;
            let cell = self.complex.cell(c);
            for i in 0..Self::LAST {
                let across = cell.neighbour(i);
                let apex = self.site(self.complex.cell(across.cell()).corners[across.index()]);
                let beyond =
                    G::orientation_with(&self.filter, self.view(), &cell.corners, Self::LAST, &apex.point);
                ensure(beyond <= 0.0, level, || {
                    format!(
                        "the hull is not convex between {} and {}",
                        self.describe(c),
                        self.describe(across.cell())
                    )
                })?;
            }
            if let Some(o) = &inner {
                let inside =
                    G::orientation_with(&self.filter, self.view(), &cell.corners, Self::LAST, o) < 0.0;
                ensure(inside, level, || {
                    format!("the hull facet {} turns its outer side inwards", self.describe(c))
                })?;
            }
        }
        ensure(ghosts == self.complex.n_ghosts(), level, || {
            format!("{ghosts} hull facets, {} counted", self.complex.n_ghosts())
        })?;
        match &inner {
            Some(o) => self.check_winding(o),
            None => Ok(()),
        }
    }

    /// Whether the hull, of which these are all ghost cells and which is convex at every ridge, winds once around a point
    /// inside a cell; `false` also if every cell is so thin that no double lies inside.
    pub(crate) fn winds_once(&self, ghosts: &[u32]) -> bool {
        self.inner_point().is_some_and(|o| {
            let is_inside = |&g: &u32| {
                let corners = &self.complex.cell(g).corners;
                G::orientation_with(&self.filter, self.view(), corners, Self::LAST, &o) < 0.0
            };
            ghosts.iter().all(is_inside) && self.crossings_of(ghosts, &o).0 == 1
        })
    }

    /// A ray from `o` crosses exactly one hull facet.
    fn check_winding(&self, o: &G::Point) -> Check {
        let ghosts: Vec<u32> = self.complex.live().filter(|&c| self.complex.cell(c).is_ghost()).collect();
        let (crossings, aim) = self.crossings_of(&ghosts, o);
        ensure(crossings == 1, Level::Embedding, || {
            format!("the ray from {o:?} towards {aim:?} crosses {crossings} hull facets, not one")
        })
    }

    /// How many of the ghosts' facets a ray from `o` that meets no ridge crosses, and a point on it.
    fn crossings_of(&self, ghosts: &[u32], o: &G::Point) -> (usize, G::Point) {
        (0..1024).find_map(|attempt| self.crossings(ghosts, o, attempt)).unwrap_or((0, *o))
    }

    /// How many facets the ray from `o` through a far point crosses, and that point; `None` if it meets a ridge.
    fn crossings(&self, ghosts: &[u32], o: &G::Point, attempt: u32) -> Option<(usize, G::Point)> {
        // The aim is a point near the box's surface, drawn by a fixed rule: any direction serves as well.
        let mut aim = G::Point::default();
        for k in 0..G::D {
            let hash = (u64::from(attempt) * 3 + k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
            let share = hash as f64 / (1u64 << 53) as f64;
            aim[k] = self.lower[k] + share * (self.upper[k] - self.lower[k]);
        }
        if (0..G::D).any(|k| !crate::predicates::is_in_range(aim[k])) || aim == *o {
            return None;
        }
        let mut crossings = 0;
        for &c in ghosts {
            match G::is_crossed(&self.filter, self.view(), &self.complex.cell(c).corners, o, &aim) {
                Some(true) => crossings += 1,
                Some(false) => {}
                None => return None,
            }
        }
        Some((crossings, aim))
    }

    fn check_spheres(&self) -> Check {
        for c in self.complex.finite() {
            for i in 0..G::Corners::N {
                let facet = Facet::new(c, i);
                ensure(self.is_locally_delaunay(facet), Level::Delaunay, || {
                    let across = self.complex.cell(c).neighbour(i);
                    let apex = self.complex.cell(across.cell()).corners[across.index()];
                    format!("vertex {} is inside the sphere of cell {}", self.site(apex).id, self.describe(c))
                })?;
            }
        }
        // In a flat part of the hull, the ghost cells have spheres too: those of the finite cells behind them.
        for c in self.complex.live().filter(|&c| self.complex.cell(c).is_ghost()) {
            for i in 0..Self::LAST {
                let across = self.complex.cell(c).neighbour(i);
                let apex = self.site(self.complex.cell(across.cell()).corners[across.index()]);
                ensure(!self.is_in_conflict_with_ghost(c, &apex.point, apex.id), Level::Delaunay, || {
                    format!("vertex {} is in conflict with the hull facet {}", apex.id, self.describe(c))
                })?;
            }
        }
        Ok(())
    }
}
