//! Refinement: vertices are added until no triangle is bad and no piece of a segment encroached.

use super::criteria::{Flaw, Measured};
use super::parts::{NONE, Rim, Side, next, previous};
use super::queue::Waiting;
use super::refinement::{Kept, Refinement, Wanted};
use super::walking::Place;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{dot, is_in_range, minus};
/// Of the greatest area: what a triangle has that is too large for that, to rounding.
const NEARLY_ALL: f64 = 0.999;

/// Vertices that are added between two questions whether to go on: each takes some ten cells.
const ADDED_BETWEEN: usize = 1000;

/// What there is to do for a bad triangle.
pub(super) enum Remedy {
    /// Nothing.
    None,
    /// To split what is in the way.
    Split,
    /// To insert a vertex in a triangle, of which the cavity has been found.
    Insert([f64; 2], u32),
}

impl Refinement<'_> {
    /// Adds vertices until there is nothing left to do; whether there would be more than the limit.
    pub(super) fn go_on(&mut self, limit: usize, ask: &mut dyn FnMut() -> Result<()>) -> Result<bool> {
        loop {
            let (n_added, n_split, n_cleared) = (self.n_added, self.n_split, self.n_cleared);
            if self.go_through(limit, ask)? {
                return Ok(true);
            }
            // What has been left may have room by now, unless nothing has changed since. Where no piece is split, and vertices
            // come where others go, it would not end.
            let has_changed = self.n_added != n_added || self.n_split > n_split;
            let is_going_round = self.n_split == n_split && self.n_cleared > n_cleared;
            let has_left = self.has_left || self.has_gaps.get();
            if !has_left || !has_changed || is_going_round {
                return Ok(false);
            }
            self.has_left = false;
            self.has_gaps.set(false);
            self.mesh.pieces.iter_mut().for_each(|piece| piece.is_fixed = false);
            self.examine_all()?;
        }
    }

    /// Adds vertices for what waits; whether there would be more than the limit.
    fn go_through(&mut self, limit: usize, ask: &mut dyn FnMut() -> Result<()>) -> Result<bool> {
        let mut n_asked = 0;
        loop {
            if self.n_added >= n_asked {
                n_asked = self.n_added + ADDED_BETWEEN;
                ask()?;
            }
            let mut k = 0;
            while k < self.encroached.len() {
                if self.n_added >= limit {
                    return Ok(true);
                }
                self.tests.check_stop()?;
                let Wanted { piece, ends, cause } = self.encroached[k];
                k += 1;
                let is_wanted = cause.is_some() || self.is_encroached(piece);
                if self.mesh.pieces[piece as usize].ends == ends && is_wanted {
                    self.split(piece, cause)?;
                }
            }
            self.encroached.clear();
            self.tests.check_stop()?;
            let Some(waiting) = self.queues.pop() else { return Ok(false) };
            if self.mesh.triangle(waiting.triangle).corners != waiting.corners {
                continue;
            }
            if self.n_added >= limit {
                return Ok(true);
            }
            self.improve(waiting)?;
        }
    }

    /// Whether something would be done for a triangle now.
    pub(super) fn would_change(&mut self, t: u32) -> Result<bool> {
        let measured = self.measure(t);
        self.has_flat |= measured.flaw.is_some() && self.is_flat(t);
        for i in 0..3 {
            if let Some((piece, cause)) = self.wanted_at(Side::new(t, i))?
                && self.can_split(piece, cause)?
            {
                return Ok(true);
            }
        }
        if !self.may_mend(t, measured) {
            return Ok(false);
        }
        match self.remedy(t, measured)? {
            Remedy::None => Ok(false),
            Remedy::Insert(..) => Ok(true),
            Remedy::Split => {
                for k in 0..self.in_the_way.len() {
                    let (piece, cause) = self.in_the_way[k];
                    if self.can_split(piece, Some(cause))? {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
        }
    }

    /// Adds a vertex in the place of a bad triangle, or enters the pieces that are in the way.
    fn improve(&mut self, waiting: Waiting) -> Result<()> {
        let t = waiting.triangle;
        let measured = self.measure(t);
        match self.remedy(t, measured)? {
            Remedy::Insert(p, at) => self.add(p, at, None),
            Remedy::None => {
                self.has_left = true;
                Ok(())
            }
            Remedy::Split => {
                let mut may_split = false;
                for k in 0..self.in_the_way.len() {
                    let (piece, cause) = self.in_the_way[k];
                    if self.may_split(piece) {
                        may_split = true;
                        self.enter(piece, Some(cause))?;
                    }
                }
                if may_split {
                    return self.queues.enter(waiting, measured.shortest);
                }
                // What cannot be split is not asked again.
                self.has_left = true;
                Ok(())
            }
        }
    }

    /// What there is to do for a bad triangle; the pieces in the way are listed. One of too large an area gets its centroid
    /// where all pieces in the way of its centre are kept whole.
    pub(super) fn remedy(&mut self, t: u32, measured: Measured) -> Result<Remedy> {
        let remedy = self.remedy_at_centre(t, measured)?;
        let triangle = *self.mesh.triangle(t);
        let corners = triangle.corners.map(|v| *self.mesh.point(v));
        if self.kept == Kept::None
            || measured.flaw != Some(Flaw::Size)
            || !matches!(remedy, Remedy::Split)
            || self.in_the_way.iter().any(|&(piece, _)| self.may_split(piece))
            || self.tests.share_of_area(corners.each_ref(), triangle.label) < NEARLY_ALL
        {
            return Ok(remedy);
        }
        let p = [0, 1].map(|axis| self.tests.rounding()(corners.iter().map(|p| p[axis] / 3.0).sum()));
        if (0..3).any(|i| self.mesh.turn(triangle.ends(i), &p) <= 0.0) {
            return Ok(Remedy::None);
        }
        self.mesh.dig(t, &p, VertexId::at(self.mesh.points.len()))?;
        Ok(Remedy::Insert(p, t))
    }

    /// What there is to do at the centre of a bad triangle.
    fn remedy_at_centre(&mut self, t: u32, measured: Measured) -> Result<Remedy> {
        let Some((p, from)) = self.centre(t, measured) else { return Ok(Remedy::None) };
        let id = VertexId::at(self.mesh.points.len());
        self.in_the_way.clear();
        match self.mesh.walk(from, &p)? {
            Place::Nowhere => Ok(Remedy::None),
            Place::Behind(piece) => {
                let ends = self.mesh.pieces[piece as usize].ends.map(|v| self.mesh.point(v));
                let cause = crossing([self.mesh.point(self.mesh.apex(from)), &p], ends);
                memory::push(&mut self.in_the_way, (piece, cause))?;
                Ok(Remedy::Split)
            }
            Place::Inside(at) => {
                self.mesh.dig(at, &p, id)?;
                for k in 0..self.mesh.rim.len() {
                    let Rim { ends, across, piece, .. } = self.mesh.rim[k];
                    if piece == NONE && !self.has_flat
                        || !self.tests.is_encroached(ends.map(|v| self.mesh.point(v)), &p)
                    {
                        continue;
                    }
                    let piece = match piece {
                        NONE => self.piece_beyond(across)?,
                        piece => Some(piece),
                    };
                    if let Some(piece) = piece {
                        memory::push(&mut self.in_the_way, (piece, p))?;
                    }
                }
                Ok(if self.in_the_way.is_empty() { Remedy::Insert(p, at) } else { Remedy::Split })
            }
        }
    }

    /// Where a bad triangle gets a vertex: its circumcentre, or the off-centre of its shortest edge if that is nearer; and
    /// the side by which a straight way there leaves the triangle, if it does.
    fn centre(&self, t: u32, measured: Measured) -> Option<([f64; 2], Side)> {
        let narrowest = measured.narrowest;
        let corners = self.mesh.triangle(t).corners;
        let [o, d, a] =
            [next(narrowest), previous(narrowest), narrowest].map(|i| self.mesh.point(corners[i]));
        let (u, v) = (minus::<f64, 2>(d, o), minus::<f64, 2>(a, o));
        let (uu, vv) = (dot(&u, &u), dot(&v, &v));
        let half = 0.5 / self.mesh.turn([corners[next(narrowest)], corners[previous(narrowest)]], a);
        let mut w = [(v[1] * uu - u[1] * vv) * half, (u[0] * vv - v[0] * uu) * half];
        let off = [0.5 * u[0] - self.tests.off * u[1], 0.5 * u[1] + self.tests.off * u[0]];
        // One at an edge whose ends touch would touch them, too.
        let is_nearer = dot(&off, &off) < dot(&w, &w)
            && !self.tests.is_short(measured.shortest)
            && !(measured.flaw == Some(Flaw::Size) && self.is_in_gap(t));
        if is_nearer || !dot(&w, &w).is_finite() {
            w = off;
        }
        let p = [0, 1].map(|axis| self.tests.rounding()(o[axis] + w[axis]));
        // The longest edge is one of the two at the narrowest corner: the other end of each is opposite.
        let x = minus::<f64, 2>(a, d);
        let longest = if dot(&x, &x) > vv { next(narrowest) } else { previous(narrowest) };
        p.iter().all(|&x| is_in_range(x)).then_some((p, Side::new(t, longest)))
    }
}

/// Where a straight way crosses the line through two ends, but for rounding.
fn crossing([from, to]: [&[f64; 2]; 2], [p, q]: [&[f64; 2]; 2]) -> [f64; 2] {
    let (u, v) = (minus::<f64, 2>(to, from), minus::<f64, 2>(q, p));
    let w = minus::<f64, 2>(p, from);
    let turn = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let share = turn(w, v) / turn(u, v);
    [0, 1].map(|axis| from[axis] + share * u[axis])
}
