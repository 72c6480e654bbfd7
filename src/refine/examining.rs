//! What is wanted of triangles and pieces, which are examined as they are made.

use super::criteria::{Flaw, Measured, distance, size_between};
use super::parts::{NONE, Side, next, previous, turn_of, turned};
use super::queue::Waiting;
use super::refinement::{Kept, Refinement, Wanted};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{dot, minus};

/// Squared cosine of 30 degrees. At input angles from there on an edge across a shell is no shorter than half its distance
/// from the apex, and so than the pieces at the shell: a vertex may come beside it.
const NARROW: f64 = 0.75;

/// Two vertices are on one shell around the apex of an input angle if their distances from it differ by no more than this
/// share: rounded powers of two do, and those that vertices of an earlier call have after they have moved.
const SHELL: f64 = 0.001;
const MOVED_SHELL: f64 = 0.2;

impl Refinement<'_> {
    /// Examines all triangles that have been copied or made, in the order of their corners.
    pub(super) fn examine_all(&mut self) -> Result<()> {
        let row = |t: u32| {
            let corners = self.mesh.triangle(t).corners;
            turned(corners, turn_of(&corners))
        };
        let mut by_corners = Vec::new();
        memory::collect(&mut by_corners, (0..self.mesh.triangles.len() as u32).map(|t| (row(t), t)))?;
        by_corners.sort_unstable();
        by_corners.into_iter().try_for_each(|(_, t)| self.examine(t))
    }

    /// Copies bad cells, and notes whether any is flat: what is wanted of the others does not depend on their order then.
    pub(super) fn see_flat(&mut self, cells: impl Iterator<Item = u32>) -> Result<()> {
        for cell in cells {
            let t = self.mesh.copy(cell)?;
            self.has_flat |= self.is_flat(t) && self.measure(t).flaw.is_some();
        }
        Ok(())
    }

    pub(super) fn measure(&self, t: u32) -> Measured {
        let triangle = self.mesh.triangle(t);
        let corners = triangle.corners;
        let points = corners.map(|v| self.mesh.point(v));
        self.tests.measure(points, triangle.label, |i| self.sizes[corners[i]])
    }

    /// Enters a triangle if it is bad, and the pieces at its sides that its corners encroach.
    pub(super) fn examine(&mut self, t: u32) -> Result<()> {
        let triangle = *self.mesh.triangle(t);
        if !triangle.is_live() || !triangle.is_selected() {
            return Ok(());
        }
        let measured = self.measure(t);
        self.has_flat |= measured.flaw.is_some() && self.is_flat(t);
        for i in 0..3 {
            if triangle.pieces[i] == NONE && !self.has_flat {
                continue;
            }
            if let Some((piece, cause)) = self.wanted_at(Side::new(t, i))?
                && self.may_split(piece)
            {
                self.enter(piece, cause)?;
            }
        }
        if !self.may_mend(t, measured) {
            return Ok(());
        }
        let waiting = Waiting { triangle: t, corners: triangle.corners };
        self.queues.enter(waiting, measured.shortest)
    }

    /// The piece at a side of a triangle, or behind flat triangles there, if it has to be split for that triangle.
    pub(super) fn wanted_at(&mut self, side: Side) -> Result<Option<(u32, Option<[f64; 2]>)>> {
        let triangle = *self.mesh.triangle(side.triangle());
        let piece = triangle.pieces[side.index()];
        if piece == NONE {
            let is_wanted = self.has_flat && self.is_encroached_from(side);
            let apex = *self.mesh.point(self.mesh.apex(side));
            return match is_wanted {
                true => Ok(self.piece_behind(side)?.map(|piece| (piece, Some(apex)))),
                false => Ok(None),
            };
        }
        let ends = triangle.ends(side.index()).map(|v| self.mesh.point(v));
        if self.tests.is_too_long(ends, triangle.label) && !self.is_in_gap(side.triangle()) {
            return Ok(Some((piece, Some([0, 1].map(|axis| 0.5 * (ends[0][axis] + ends[1][axis]))))));
        }
        Ok(self.is_encroached_from(side).then_some((piece, None)))
    }

    /// Whether a triangle is bad, and not for a reason that stays.
    pub(super) fn may_mend(&self, t: u32, measured: Measured) -> bool {
        match measured.flaw {
            None => false,
            Some(Flaw::Angle) => {
                !self.tests.is_short(measured.shortest)
                    && !self.is_flat(t)
                    && !self.is_hopeless(t, measured.narrowest)
                    && !self.is_in_gap(t)
            }
            Some(Flaw::Size) => true,
        }
    }

    /// Enters a piece that has to be split.
    pub(super) fn enter(&mut self, piece: u32, cause: Option<[f64; 2]>) -> Result<()> {
        let ends = self.mesh.pieces[piece as usize].ends;
        memory::push(&mut self.encroached, Wanted { piece, ends, cause })
    }

    /// Whether a piece at a side would have to be split for the corner opposite it.
    pub(super) fn is_encroached_from(&self, side: Side) -> bool {
        let t = side.triangle();
        self.is_seen_wide(side) && !self.is_flat(t) && !self.is_in_gap(t)
    }

    /// Whether the corner opposite a side is in the lens or circle of that, even if it touches it.
    pub(super) fn is_seen_wide(&self, side: Side) -> bool {
        let triangle = self.mesh.triangle(side.triangle());
        let ends = triangle.ends(side.index()).map(|v| self.mesh.point(v));
        self.tests.is_encroached(ends, self.mesh.point(triangle.corners[side.index()]))
    }

    /// Whether a triangle is in a narrow gap between segments.
    pub(super) fn is_in_gap(&self, t: u32) -> bool {
        let is_in_gap = self.mesh.gap_around(t, &self.tests, &self.origins).is_some();
        if is_in_gap {
            self.has_gaps.set(true);
        }
        is_in_gap
    }

    pub(super) fn is_encroached(&self, piece: u32) -> bool {
        self.selected_sides(piece).any(|side| self.is_encroached_from(side))
    }

    /// The sides of a piece on which triangles are to be refined.
    pub(super) fn selected_sides(&self, piece: u32) -> impl Iterator<Item = Side> {
        let sides = self.mesh.sides_of(piece);
        sides
            .into_iter()
            .filter(|&side| side != Side::NONE && self.mesh.triangle(side.triangle()).is_selected())
    }

    pub(super) fn may_split(&self, piece: u32) -> bool {
        !self.mesh.pieces[piece as usize].is_fixed
            && match self.kept {
                Kept::None => true,
                Kept::Outer => self.selected_sides(piece).count() == 2,
                Kept::All => false,
            }
    }

    /// Whether a small angle is one between two segments, or one that these bring about: the edge opposite it is between
    /// vertices on one shell.
    fn is_hopeless(&self, t: u32, narrowest: usize) -> bool {
        let triangle = self.mesh.triangle(t);
        if [next(narrowest), previous(narrowest)].iter().all(|&i| triangle.pieces[i] != NONE) {
            return true;
        }
        let ends = triangle.ends(narrowest);
        let [one, other] = ends.map(|v| self.on[v]);
        if one == NONE || other == NONE || one == other {
            return false;
        }
        let Some(apex) = self.common_end(one, other) else { return false };
        let [d, e] = ends.map(|v| {
            let u = minus::<f64, 2>(self.mesh.point(v), self.mesh.point(apex));
            dot(&u, &u)
        });
        let are_new = ends.iter().all(|v| v.index() >= self.n_given);
        let tolerance = 2.0 * if are_new { SHELL } else { MOVED_SHELL };
        (d - e).abs() <= tolerance * d.max(e) && self.is_seen_below(apex, ends, NARROW)
    }

    /// The vertex at which two originals meet.
    pub(super) fn common_end(&self, one: u32, other: u32) -> Option<VertexId> {
        let [one, other] = [one, other].map(|original| self.origins.ends[original as usize]);
        let is_there = |v: &VertexId| self.mesh.at.get(v.index()).is_some_and(|&t| t != NONE);
        one.into_iter().find(|v| other.contains(v)).filter(is_there)
    }

    /// Whether two vertices are seen from a third one under less than the angle of this squared cosine.
    pub(super) fn is_seen_below(&self, apex: VertexId, others: [VertexId; 2], squared_cosine: f64) -> bool {
        let [u, v] = others.map(|v| minus::<f64, 2>(self.mesh.point(v), self.mesh.point(apex)));
        let cosine = dot(&u, &v);
        cosine > 0.0 && cosine * cosine > squared_cosine * (dot(&u, &u) * dot(&v, &v))
    }

    /// Fills the cavity around a new vertex, which is in a triangle, or on a piece.
    pub(super) fn add(&mut self, p: [f64; 2], at: u32, piece: Option<u32>) -> Result<()> {
        memory::reserve(&mut self.on, 1)?;
        memory::reserve(&mut self.sizes, 1)?;
        if self.tests.has_sizes() {
            let size = match piece {
                Some(piece) => {
                    let [a, b] = self.mesh.pieces[piece as usize].ends;
                    let [to_a, to_b] = [a, b].map(|v| distance(self.mesh.point(v), &p));
                    size_between(&self.sizes, [a, b, b], [to_b, to_a, 0.0])
                }
                None => {
                    let corners = self.mesh.triangle(at).corners;
                    let weights =
                        [0, 1, 2].map(|i| self.mesh.turn(self.mesh.triangle(at).ends(i), &p).max(0.0));
                    size_between(&self.sizes, corners, weights)
                }
            };
            self.sizes.push(size);
        }
        let original = piece.map_or(NONE, |piece| {
            let segment = self.mesh.pieces[piece as usize].segment;
            self.origins.of_segments[segment as usize]
        });
        self.mesh.fill(p, piece)?;
        self.on.push(original);
        self.n_added += 1;
        self.examine_made()
    }

    pub(super) fn examine_made(&mut self) -> Result<()> {
        for k in 0..self.mesh.made.len() {
            self.examine(self.mesh.made[k])?;
        }
        Ok(())
    }
}
