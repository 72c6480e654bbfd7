//! Refinement: vertices are added until no triangle is bad and no piece of a segment encroached.

use super::criteria::{Flaw, Measured, Tests, distance, size_between};
use super::given::Given;
use super::mesh::Mesh;
use super::parts::{NONE, Side, next, previous};
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

/// What a refinement has done.
#[derive(Debug, Default)]
pub(crate) struct Refined {
    /// The new vertices in the order of their numbers, the first of which is the number of those given; each with the
    /// segment that it is on, or [`NONE`].
    pub vertices: Vec<([f64; 2], u32)>,
    /// The segments that have been split, ascending, each with where its vertices end in `chain`.
    pub split: Vec<(u32, usize)>,
    /// The vertices of the split segments, from end to end.
    pub chain: Vec<VertexId>,
    /// Pieces that had to be split and could not, as there is no room for a vertex on them.
    pub n_unsplit: usize,
    /// Selected triangles that are bad.
    pub n_bad: usize,
    /// Whether the limit was reached.
    pub is_cut_short: bool,
}

/// Two vertices are on one shell around the apex of an input angle if their distances from it differ by no more than this
/// share: rounded powers of two do, and those that vertices of an earlier call have after they have moved.
const SHELL: f64 = 0.001;
const MOVED_SHELL: f64 = 0.2;

/// Vertices that are added between two questions whether to go on: each takes some ten cells.
const ADDED_BETWEEN: usize = 1000;

pub(super) struct Refinement<'a> {
    pub(super) mesh: Mesh<'a>,
    tests: Tests<'a>,
    pub(super) origins: Origins,
    kept: Kept,
    queues: Queues,
    /// Pieces to be split, each with its ends when it was entered, and whether something was behind it.
    encroached: Vec<(u32, [VertexId; 2], bool)>,
    /// The original that each vertex is on, [`NONE`] if there is none.
    pub(super) on: Vec<u32>,
    /// The greatest length of edges at each vertex, if that is given.
    sizes: Vec<f64>,
    pub(super) n_given: usize,
    pub(super) n_added: usize,
    pub(super) n_unsplit: usize,
    pub(super) hole: Hole,
}

/// Refines the cells that are selected. `points` are the places of vertices, and `bad` the cells, ascending, that are bad or
/// have segments that are encroached.
pub(crate) fn refine(
    given: Given,
    points: Vec<[f64; 2]>,
    bad: &[u32],
    tests: Tests,
    origins: Origins,
    (kept, limit): (Kept, usize),
    ask: &mut dyn FnMut() -> Result<()>,
) -> Result<Refined> {
    let mut on = Vec::new();
    let n_given = points.len();
    memory::lengthen(&mut on, n_given, NONE)?;
    origins.of_vertices.iter().for_each(|&(v, original)| on[v] = original);
    let sizes = memory::copy_of(tests.given_sizes())?;
    let mut refinement = Refinement {
        mesh: Mesh::new(given, points)?,
        tests,
        origins,
        kept,
        queues: Queues::new()?,
        encroached: Vec::new(),
        on,
        sizes,
        n_given,
        n_added: 0,
        n_unsplit: 0,
        hole: Hole::default(),
    };
    for &cell in bad {
        let t = refinement.mesh.copy(cell)?;
        refinement.examine(t)?;
    }
    let is_cut_short = refinement.go_on(limit, ask)?;
    refinement.tell(given, is_cut_short)
}

impl Refinement<'_> {
    /// Adds vertices; whether there would be more than the limit.
    fn go_on(&mut self, limit: usize, ask: &mut dyn FnMut() -> Result<()>) -> Result<bool> {
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
                let (piece, ends, is_forced) = self.encroached[k];
                k += 1;
                if self.mesh.pieces[piece as usize].ends == ends && (is_forced || self.is_encroached(piece)) {
                    self.split(piece)?;
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

    fn measure(&self, t: u32) -> Measured {
        let triangle = self.mesh.triangle(t);
        let corners = triangle.corners;
        let points = corners.map(|v| self.mesh.point(v));
        self.tests.measure(points, triangle.label, |i| self.sizes[corners[i]])
    }

    /// Enters a triangle if it is bad, and the pieces at its sides that its corners encroach.
    fn examine(&mut self, t: u32) -> Result<()> {
        let triangle = *self.mesh.triangle(t);
        if !triangle.is_live() || !triangle.is_selected() {
            return Ok(());
        }
        for i in 0..3 {
            let piece = triangle.pieces[i];
            if piece == NONE {
                continue;
            }
            let is_too_long =
                self.tests.is_too_long(triangle.ends(i).map(|v| self.mesh.point(v)), triangle.label);
            if (is_too_long || self.is_encroached_from(Side::new(t, i))) && self.may_split(piece) {
                self.enter(piece, is_too_long)?;
            }
        }
        let measured = self.measure(t);
        match measured.flaw {
            None => Ok(()),
            Some(Flaw::Angle) if self.is_hopeless(t, measured.narrowest) => Ok(()),
            Some(_) => {
                let waiting = Waiting { triangle: t, corners: triangle.corners };
                self.queues.enter(waiting, measured.shortest)
            }
        }
    }

    /// Enters a piece that has to be split.
    fn enter(&mut self, piece: u32, is_forced: bool) -> Result<()> {
        let ends = self.mesh.pieces[piece as usize].ends;
        memory::push(&mut self.encroached, (piece, ends, is_forced))
    }

    /// Whether a piece at a side would have to be split for the corner opposite it.
    pub(super) fn is_encroached_from(&self, side: Side) -> bool {
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
        (d - e).abs() <= tolerance * d.max(e)
    }

    /// Adds a vertex in the place of a bad triangle, or enters the pieces that are in the way.
    fn improve(&mut self, waiting: Waiting) -> Result<()> {
        let t = waiting.triangle;
        let measured = self.measure(t);
        let Some((p, from)) = self.centre(t, measured.narrowest) else { return Ok(()) };
        let id = VertexId::at(self.mesh.points.len());
        let n_before = self.encroached.len();
        match self.mesh.walk(from, &p)? {
            Place::Nowhere => return Ok(()),
            Place::Behind(piece) => {
                if self.may_split(piece) {
                    self.enter(piece, true)?;
                }
            }
            Place::Inside(at) => {
                self.mesh.dig(at, &p, id)?;
                let mut is_free = true;
                for k in 0..self.mesh.rim.len() {
                    let side = self.mesh.rim[k];
                    if side.piece != NONE
                        && self.tests.is_encroached(side.ends.map(|v| self.mesh.point(v)), &p)
                    {
                        is_free = false;
                        if self.may_split(side.piece) {
                            self.enter(side.piece, true)?;
                        }
                    }
                }
                if is_free {
                    return self.add(p, at, None);
                }
            }
        }
        // What cannot be split is not asked again.
        if self.encroached.len() > n_before { self.queues.enter(waiting, measured.shortest) } else { Ok(()) }
    }

    /// Where a bad triangle gets a vertex: its circumcentre, or the off-centre of its shortest edge if that is nearer; and
    /// the side by which a straight way there leaves the triangle, if it does.
    fn centre(&self, t: u32, narrowest: usize) -> Option<([f64; 2], Side)> {
        let corners = self.mesh.triangle(t).corners;
        let [o, d, a] =
            [next(narrowest), previous(narrowest), narrowest].map(|i| self.mesh.point(corners[i]));
        let (u, v) = (minus::<f64, 2>(d, o), minus::<f64, 2>(a, o));
        let (uu, vv) = (dot(&u, &u), dot(&v, &v));
        let half = 0.5 / self.mesh.turn([corners[next(narrowest)], corners[previous(narrowest)]], a);
        let mut w = [(v[1] * uu - u[1] * vv) * half, (u[0] * vv - v[0] * uu) * half];
        let off = [0.5 * u[0] - self.tests.off * u[1], 0.5 * u[1] + self.tests.off * u[0]];
        if dot(&off, &off) < dot(&w, &w) || !dot(&w, &w).is_finite() {
            w = off;
        }
        let p = [o[0] + w[0] + 0.0, o[1] + w[1] + 0.0];
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

    /// Numbers the vertices that have stayed, and lists what has become of the segments.
    fn tell(self, given: Given, is_cut_short: bool) -> Result<Refined> {
        let n = self.mesh.triangles.len() as u32;
        let n_bad =
            (0..n).filter(|&t| self.mesh.triangle(t).is_selected() && self.measure(t).flaw.is_some()).count();
        self.tests.check_stop()?;
        let mut told = Refined { is_cut_short, n_bad, n_unsplit: self.n_unsplit, ..Refined::default() };
        let mut segment_of = Vec::new();
        memory::lengthen(&mut segment_of, self.mesh.points.len() - self.n_given, NONE)?;
        for piece in &self.mesh.pieces {
            for v in piece.ends.into_iter().filter(|v| v.index() >= self.n_given) {
                segment_of[v.index() - self.n_given] = piece.segment;
            }
        }
        let mut number = Vec::new();
        memory::lengthen(&mut number, segment_of.len(), VertexId::NONE)?;
        memory::reserve(&mut told.vertices, self.n_added)?;
        for (k, &segment) in segment_of.iter().enumerate() {
            if self.mesh.at[self.n_given + k] != NONE {
                number[k] = VertexId::at(self.n_given + told.vertices.len());
                told.vertices.push((self.mesh.points[self.n_given + k], segment));
            }
        }
        let renamed =
            |v: VertexId| if v.index() < self.n_given { v } else { number[v.index() - self.n_given] };
        for segment in 0..given.segments.len() as u32 {
            let mut piece = &self.mesh.pieces[segment as usize];
            if piece.next == NONE {
                continue;
            }
            memory::push(&mut told.chain, renamed(piece.ends[0]))?;
            loop {
                memory::push(&mut told.chain, renamed(piece.ends[1]))?;
                match piece.next {
                    NONE => break,
                    next => piece = &self.mesh.pieces[next as usize],
                }
            }
            memory::push(&mut told.split, (segment, told.chain.len()))?;
        }
        Ok(told)
    }
}
