//! Refinement: vertices are added until no triangle is bad and no piece of a segment encroached.

use super::criteria::{Flaw, Measured, Tests, distance, size_between};
use super::mesh::Mesh;
use super::parts::{NONE, Rim, Side, next, previous, turn_of, turned};
use super::queue::{Queues, Waiting};
use super::removal::Hole;
use super::walking::Place;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{dot, is_in_range, minus};

/// Which segments stay whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kept {
    /// None.
    #[default]
    None,
    /// Those with cells that are to be refined on one side only.
    Outer,
    /// All.
    All,
}

/// Where segments come from.
#[derive(Debug, Default)]
pub(crate) struct Origins {
    /// Ends of each original segment.
    pub ends: Vec<[VertexId; 2]>,
    /// The original of each segment.
    pub of_segments: Vec<u32>,
    /// Vertices that earlier calls have added, with the original that they are on.
    pub of_vertices: Vec<(VertexId, u32)>,
}

/// Squared cosine of 30 degrees. At input angles from there on an edge across a shell is no shorter than half its distance
/// from the apex, and so than the pieces at the shell: a vertex may come beside it.
const NARROW: f64 = 0.75;

/// Two vertices are on one shell around the apex of an input angle if their distances from it differ by no more than this
/// share: rounded powers of two do, and those that vertices of an earlier call have after they have moved.
const SHELL: f64 = 0.001;
const MOVED_SHELL: f64 = 0.2;

/// Of the greatest area: what a triangle has that is too large for that, to rounding.
const NEARLY_ALL: f64 = 0.999;

/// Vertices that are added between two questions whether to go on: each takes some ten cells.
const ADDED_BETWEEN: usize = 1000;

pub(super) struct Refinement<'a> {
    pub(super) mesh: Mesh<'a>,
    pub(super) tests: Tests<'a>,
    pub(super) origins: Origins,
    kept: Kept,
    queues: Queues,
    /// Pieces to be split.
    encroached: Vec<Wanted>,
    /// The original that each vertex is on, [`NONE`] if there is none.
    pub(super) on: Vec<u32>,
    /// The greatest length of edges at each vertex, if that is given.
    pub(super) sizes: Vec<f64>,
    pub(super) n_given: usize,
    pub(super) n_added: usize,
    /// Pieces that have been split, and vertices that have been taken out of circles.
    pub(super) n_split: usize,
    pub(super) n_cleared: usize,
    /// Whether something that is wanted has been left, as there was no room for it.
    pub(super) has_left: bool,
    pub(super) hole: Hole,
    /// Pieces in the way of a vertex, each with where it is in the way.
    in_the_way: Vec<(u32, [f64; 2])>,
    /// Whether flat triangles have been seen.
    pub(super) has_flat: bool,
    /// Where vertices touch a piece.
    pub(super) touching: Vec<f64>,
}

/// A piece that is to be split.
#[derive(Clone, Copy, Debug)]
struct Wanted {
    piece: u32,
    /// Its ends when it was entered.
    ends: [VertexId; 2],
    /// What it is to be split for, if that is not only the corner opposite it.
    cause: Option<[f64; 2]>,
}

/// What there is to do for a bad triangle.
enum Remedy {
    /// Nothing.
    None,
    /// To split what is in the way.
    Split,
    /// To insert a vertex in a triangle, of which the cavity has been found.
    Insert([f64; 2], u32),
}

impl<'a> Refinement<'a> {
    pub(super) fn new(mesh: Mesh<'a>, tests: Tests<'a>, origins: Origins, kept: Kept) -> Result<Self> {
        let mut on = Vec::new();
        let n_given = mesh.points.len();
        memory::lengthen(&mut on, n_given, NONE)?;
        origins.of_vertices.iter().for_each(|&(v, original)| on[v] = original);
        let sizes = memory::copy_of(tests.given_sizes())?;
        Ok(Refinement {
            mesh,
            tests,
            origins,
            kept,
            queues: Queues::new()?,
            encroached: Vec::new(),
            on,
            sizes,
            n_given,
            n_added: 0,
            n_split: 0,
            n_cleared: 0,
            has_left: false,
            hole: Hole::default(),
            in_the_way: Vec::new(),
            has_flat: false,
            touching: Vec::new(),
        })
    }

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
            if !self.has_left || !has_changed || is_going_round {
                return Ok(false);
            }
            self.has_left = false;
            self.mesh.pieces.iter_mut().for_each(|piece| piece.is_fixed = false);
            self.examine_all()?;
        }
    }

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

    /// Whether a triangle is bad, and not for a reason that stays.
    fn may_mend(&self, t: u32, measured: Measured) -> bool {
        match measured.flaw {
            None => false,
            Some(Flaw::Angle) => {
                !self.tests.is_short(measured.shortest)
                    && !self.is_flat(t)
                    && !self.is_hopeless(t, measured.narrowest)
            }
            Some(Flaw::Size) => true,
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

    /// Enters a piece that has to be split.
    fn enter(&mut self, piece: u32, cause: Option<[f64; 2]>) -> Result<()> {
        let ends = self.mesh.pieces[piece as usize].ends;
        memory::push(&mut self.encroached, Wanted { piece, ends, cause })
    }

    /// Whether a piece at a side would have to be split for the corner opposite it.
    pub(super) fn is_encroached_from(&self, side: Side) -> bool {
        self.is_seen_wide(side) && !self.is_flat(side.triangle())
    }

    /// Whether the corner opposite a side is in the lens or circle of that, even if it touches it.
    pub(super) fn is_seen_wide(&self, side: Side) -> bool {
        let triangle = self.mesh.triangle(side.triangle());
        let ends = triangle.ends(side.index()).map(|v| self.mesh.point(v));
        self.tests.is_encroached(ends, self.mesh.point(triangle.corners[side.index()]))
    }

    fn is_encroached(&self, piece: u32) -> bool {
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

    /// Whether two vertices are seen from a third one under less than the angle of this squared cosine.
    pub(super) fn is_seen_below(&self, apex: VertexId, others: [VertexId; 2], squared_cosine: f64) -> bool {
        let [u, v] = others.map(|v| minus::<f64, 2>(self.mesh.point(v), self.mesh.point(apex)));
        let cosine = dot(&u, &v);
        cosine > 0.0 && cosine * cosine > squared_cosine * (dot(&u, &u) * dot(&v, &v))
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
    fn remedy(&mut self, t: u32, measured: Measured) -> Result<Remedy> {
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
        let is_nearer = dot(&off, &off) < dot(&w, &w) && !self.tests.is_short(measured.shortest);
        if is_nearer || !dot(&w, &w).is_finite() {
            w = off;
        }
        let p = [0, 1].map(|axis| self.tests.rounding()(o[axis] + w[axis]));
        // The longest edge is one of the two at the narrowest corner: the other end of each is opposite.
        let x = minus::<f64, 2>(a, d);
        let longest = if dot(&x, &x) > vv { next(narrowest) } else { previous(narrowest) };
        p.iter().all(|&x| is_in_range(x)).then_some((p, Side::new(t, longest)))
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

/// Where a straight way crosses the line through two ends, but for rounding.
fn crossing([from, to]: [&[f64; 2]; 2], [p, q]: [&[f64; 2]; 2]) -> [f64; 2] {
    let (u, v) = (minus::<f64, 2>(to, from), minus::<f64, 2>(q, p));
    let w = minus::<f64, 2>(p, from);
    let turn = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let share = turn(w, v) / turn(u, v);
    [0, 1].map(|axis| from[axis] + share * u[axis])
}
