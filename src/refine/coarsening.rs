//! Coarsening: vertices that refinement has added, and is no longer in need of, are taken away.
//!
//! A vertex goes if all triangles that take the place of those around it fulfil the criteria with some room: then it is not
//! missed at once, and refinement does not add it again. Where triangles are bad before, they may be as bad after: that is
//! for refinement to mend, with fewer vertices. Those at short edges go first.

use super::criteria::{Tests, narrowest};
use super::mesh::{Given, Mesh, NONE, Triangle, next, previous};
use super::removal::Hole;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{dot, minus};

/// How much room the triangles must have that take the place of others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Room {
    /// In degrees, above the least angle.
    pub angle: f64,
    /// The share of the greatest areas and lengths that they may have.
    pub share: f64,
    /// A vertex between two pieces goes if it is off the line through their other ends by no more than this share of the
    /// distance of these: 0 for those on it alone.
    pub offset: f64,
}

/// A vertex that may go.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub vertex: VertexId,
    /// The segments before and behind it, if it is between two of one origin, in their direction.
    pub between: Option<[u32; 2]>,
}

/// What a coarsening has done.
#[derive(Debug, Default)]
pub(crate) struct Coarsened {
    /// The vertices that go, in the order in which they were taken.
    pub vertices: Vec<VertexId>,
    /// The segments that other ones take the place of, ascending.
    pub replaced: Vec<u32>,
    /// Those that do, with a segment that is of one origin.
    pub joined: Vec<(u32, [VertexId; 2])>,
}

struct Coarsening<'a> {
    mesh: Mesh,
    tests: Tests<'a>,
    room: Room,
    squared_cosine: f64,
    hole: Hole,
    told: Coarsened,
    /// The piece that each segment is a part of.
    into: Vec<u32>,
}

/// Takes candidates away.
pub(crate) fn coarsen(
    given: &Given,
    tests: Tests,
    room: Room,
    candidates: &[Candidate],
) -> Result<Coarsened> {
    let squared_cosine = tests.squared_cosine_above(room.angle);
    let mut into = Vec::new();
    memory::collect(&mut into, 0..given.segments.len() as u32)?;
    let mut coarsening = Coarsening {
        mesh: Mesh::new(given)?,
        tests,
        room,
        squared_cosine,
        hole: Hole::default(),
        told: Coarsened::default(),
        into,
    };
    let mut waiting = Vec::new();
    memory::collect(&mut waiting, candidates.iter().copied())?;
    let mut is_touched = Vec::new();
    memory::lengthen(&mut is_touched, given.points.len(), true)?;
    while !waiting.is_empty() {
        waiting = coarsening.pass(&waiting, &mut is_touched)?;
    }
    coarsening.tell(given)
}

impl Coarsening<'_> {
    /// Looks at candidates once, those at short edges first; returns those that stay and have other triangles than when they
    /// were looked at.
    fn pass(&mut self, candidates: &[Candidate], is_touched: &mut [bool]) -> Result<Vec<Candidate>> {
        let mut ordered = Vec::new();
        memory::collect(
            &mut ordered,
            candidates.iter().map(|&c| (self.shortest_edge(c.vertex).to_bits(), c)),
        )?;
        ordered.sort_unstable_by_key(|&(square, c)| (square, c.vertex));
        for &(_, candidate) in &ordered {
            is_touched[candidate.vertex] = false;
            if self.may_go(candidate)? {
                self.mesh.replace(candidate.vertex, &self.hole)?;
                memory::push(&mut self.told.vertices, candidate.vertex)?;
                self.mesh.rim.iter().for_each(|side| is_touched[side.ends[0]] = true);
            }
        }
        let mut left = Vec::new();
        let is_left = |c: &Candidate| self.mesh.at[c.vertex] != NONE && is_touched[c.vertex];
        memory::collect(&mut left, ordered.into_iter().map(|(_, c)| c).filter(is_left))?;
        Ok(left)
    }

    /// Squared length of a short edge at a vertex: one of those of a triangle at it.
    fn shortest_edge(&self, v: VertexId) -> f64 {
        let t = self.mesh.at[v];
        if t == NONE {
            return 0.0;
        }
        let others = self.mesh.triangle(t).corners.into_iter().filter(|&w| w != v);
        let squares = others.map(|w| {
            let u = minus::<f64, 2>(self.mesh.point(w), self.mesh.point(v));
            dot(&u, &u)
        });
        squares.fold(f64::INFINITY, f64::min)
    }

    /// Whether a vertex may go: then the hole is what takes its place.
    fn may_go(&mut self, Candidate { vertex, between }: Candidate) -> Result<bool> {
        if self.mesh.at[vertex] == NONE {
            return Ok(false);
        }
        let is_found = match between {
            None => self.mesh.find_hole(vertex, &mut self.hole)?,
            Some([before, behind]) => {
                let before = self.current(before);
                let [a, b] =
                    [self.mesh.pieces[before as usize].ends[0], self.mesh.pieces[behind as usize].ends[1]];
                if !self.is_on_line(vertex, [a, b]) {
                    return Ok(false);
                }
                let found = self.mesh.find_joined_hole([before, behind], &mut self.hole)?;
                if found && self.are_good() {
                    self.into[behind as usize] = before;
                    return Ok(true);
                }
                return Ok(false);
            }
        };
        Ok(is_found && self.are_good())
    }

    /// The piece that a segment is a part of by now.
    fn current(&self, mut segment: u32) -> u32 {
        while self.into[segment as usize] != segment {
            segment = self.into[segment as usize];
        }
        segment
    }

    fn is_on_line(&self, vertex: VertexId, [a, b]: [VertexId; 2]) -> bool {
        if a == b {
            return false;
        }
        let [p, q, o] = [a, b, vertex].map(|v| self.mesh.point(v));
        if self.mesh.turn([a, b], o) == 0.0 {
            return true;
        }
        let u = minus::<f64, 2>(q, p);
        self.mesh.squared_offset(vertex, [a, b]) <= self.room.offset * self.room.offset * dot(&u, &u)
    }

    /// Whether the triangles of the hole are good, or no worse than those that are there.
    fn are_good(&self) -> bool {
        let worst = self.mesh.cells.iter().fold(self.squared_cosine, |worst, &t| {
            let triangle = self.mesh.triangle(t);
            let points = triangle.corners.map(|v| self.mesh.point(v));
            if !triangle.is_selected() {
                return worst;
            }
            let narrowest = narrowest(points);
            let square = squared_cosine(points, narrowest);
            let may_mend =
                square > self.tests.squared_cosine && !self.is_between_segments(triangle, narrowest);
            if may_mend { worst.max(square) } else { worst }
        });
        let sizes = self.tests.given_sizes();
        self.hole.triangles.iter().all(|&(corners, label)| {
            let points = corners.map(|v| self.mesh.point(v));
            let size = |i: usize| sizes[corners[i]];
            !Tests::is_selected(label)
                || self.tests.measure_with(points, label, size, self.room.share, worst).flaw.is_none()
        })
    }

    fn is_between_segments(&self, triangle: &Triangle, narrowest: usize) -> bool {
        [next(narrowest), previous(narrowest)].iter().all(|&i| triangle.pieces[i] != NONE)
    }

    fn tell(mut self, given: &Given) -> Result<Coarsened> {
        for segment in 0..given.segments.len() as u32 {
            let piece = &self.mesh.pieces[segment as usize];
            if piece.ends == given.segments[segment as usize] {
                continue;
            }
            memory::push(&mut self.told.replaced, segment)?;
            if self.into[segment as usize] == segment {
                memory::push(&mut self.told.joined, (segment, piece.ends))?;
            }
        }
        Ok(self.told)
    }
}

/// Squared cosine of the angle at a corner.
fn squared_cosine(p: [&[f64; 2]; 3], corner: usize) -> f64 {
    let [u, v] = [next(corner), previous(corner)].map(|i| minus::<f64, 2>(p[i], p[corner]));
    dot(&u, &v).powi(2) / (dot(&u, &u) * dot(&v, &v))
}
