//! Coarsening: vertices that refinement has added, and is no longer in need of, are taken away.
//!
//! A vertex goes if all triangles that take the place of those around it fulfil the criteria with some room: then it is not
//! missed at once, and refinement does not add it again. Where triangles are bad before, they may be as bad after: that is
//! for refinement to mend, with fewer vertices. In narrow gaps they may be as refinement leaves them. Those at short edges
//! go first.

use super::criteria::{Tests, narrowest};
use super::gaps::NarrowGap;
use super::given::Given;
use super::mesh::Mesh;
use super::parts::{NONE, next, previous};
use super::refinement::Origins;
use super::removal::Hole;
use super::waking::{LeftBad, wakers};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{dot, minus};

/// Motions round a place off a line by less than this share of the distance from which vertices touch: 64 last places.
const ROUNDED: f64 = 1.0 / 16.0;

/// No squared cosine is greater.
const NO_ANGLE: f64 = 2.0;

/// A gap is narrow, whatever pieces are joined at it, if it is no wider than this share of what would be too wide, and
/// pieces are bent by no more than this share of its width.
const SURELY: f64 = 0.5;
const BENT: f64 = 1.0 / 64.0;

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
    /// Whether it is known that it may not go: then it is only looked at when its cells have become others.
    pub is_kept: bool,
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
    /// The candidates that could have gone first.
    pub able: Vec<VertexId>,
    /// Of the vertices that go, those without which refinement would do something for cells that it has left.
    pub wakers: Vec<VertexId>,
}

struct Coarsening<'a> {
    mesh: Mesh<'a>,
    tests: Tests<'a>,
    room: Room,
    squared_cosine: f64,
    hole: Hole,
    told: Coarsened,
    /// The piece that each segment is a part of.
    into: Vec<u32>,
    /// By vertex, whether triangles at it are others than when it was looked at.
    is_touched: Vec<bool>,
    /// By vertex, whether triangles at it may be bad.
    is_near_bad: Vec<bool>,
    /// Of the segments, if narrow gaps between them are looked for.
    origins: Option<Origins>,
    /// The triangles around the vertex that is looked at that are in narrow gaps, if what takes their place may be left
    /// as they are.
    in_gap: Vec<u32>,
}

/// Takes candidates away. `points` are the places of vertices, and `bad` the cells that refinement would mend. Origins
/// are needed where a bad cell is so thin that it may be in a narrow gap.
pub(crate) fn coarsen(
    given: Given,
    points: Vec<[f64; 2]>,
    (tests, room): (Tests, Room),
    (bad, origins): (&[u32], Option<Origins>),
    left: Option<LeftBad>,
    candidates: &[Candidate],
) -> Result<Coarsened> {
    let mut coarsening = Coarsening::new(given, points, tests, room)?;
    coarsening.origins = origins;
    for &cell in bad {
        given.corners[cell as usize].iter().for_each(|&v| coarsening.is_near_bad[v] = true);
    }
    let able = coarsening.take_away(candidates)?;
    coarsening.told.able = able;
    coarsening.tell(given)?;
    let Coarsening { mesh, tests, mut told, into, .. } = coarsening;
    if let Some(left) = left.filter(|_| !told.vertices.is_empty()) {
        let mut gone = Vec::new();
        let of = |candidate: &Candidate| candidate.between.map_or(NONE, |[before, _]| into[before as usize]);
        let has_gone = |candidate: &&Candidate| mesh.at[candidate.vertex] == NONE;
        memory::collect(&mut gone, candidates.iter().filter(has_gone).map(|c| (c.vertex, of(c))))?;
        told.wakers = wakers(mesh, tests, left, &gone)?;
    }
    Ok(told)
}

/// Takes all candidates away that can go, whatever comes in their place; returns what is left, the vertices taken, and by
/// segment the one of whose piece it is a part. Pieces are joined where the vertex between them is on a line by `offset`, as
/// in [`Room`].
pub(super) fn strip<'a>(
    given: Given<'a>,
    points: Vec<[f64; 2]>,
    no_tests: Tests<'a>,
    offset: f64,
    candidates: &[Candidate],
) -> Result<(Mesh<'a>, Vec<VertexId>, Vec<u32>)> {
    let room = Room { angle: 0.0, share: 1.0, offset };
    let mut coarsening = Coarsening::new(given, points, no_tests, room)?;
    coarsening.take_away(candidates)?;
    coarsening.find_current();
    Ok((coarsening.mesh, coarsening.told.vertices, coarsening.into))
}

impl<'a> Coarsening<'a> {
    fn new(given: Given<'a>, points: Vec<[f64; 2]>, tests: Tests<'a>, room: Room) -> Result<Self> {
        let squared_cosine = tests.squared_cosine_above(room.angle);
        let mut into = Vec::new();
        memory::collect(&mut into, 0..given.segments.len() as u32)?;
        let (mut is_touched, mut is_near_bad) = (Vec::new(), Vec::new());
        memory::lengthen(&mut is_touched, points.len(), false)?;
        memory::lengthen(&mut is_near_bad, points.len(), false)?;
        Ok(Coarsening {
            mesh: Mesh::new(given, points)?,
            tests,
            room,
            squared_cosine,
            hole: Hole::default(),
            told: Coarsened::default(),
            into,
            is_touched,
            is_near_bad,
            origins: None,
            in_gap: Vec::new(),
        })
    }

    /// Takes away what may go, until nothing does; returns those that could have gone first.
    fn take_away(&mut self, candidates: &[Candidate]) -> Result<Vec<VertexId>> {
        let mut first = Vec::new();
        let mut able = self.list_able(candidates)?;
        memory::collect(&mut first, able.iter().map(|&(_, c)| c.vertex))?;
        let mut waiting = self.pass(candidates, &mut able)?;
        while !waiting.is_empty() {
            able = self.list_able(&waiting)?;
            waiting = self.pass(candidates, &mut able)?;
        }
        Ok(first)
    }

    /// Lists those that may go, each with the square of its shortest edge.
    fn list_able(&mut self, candidates: &[Candidate]) -> Result<Vec<(f64, Candidate)>> {
        let mut able = Vec::new();
        for &candidate in candidates {
            let is_touched = std::mem::take(&mut self.is_touched[candidate.vertex]);
            if (is_touched || !candidate.is_kept) && self.may_go(candidate)? {
                memory::push(&mut able, (self.shortest_edge(candidate.vertex), candidate))?;
            }
            self.tests.check_stop()?;
        }
        Ok(able)
    }

    /// Takes away those that may go, those at short edges first; returns those of all candidates that stay and have other
    /// triangles than when they were looked at.
    fn pass(&mut self, candidates: &[Candidate], able: &mut [(f64, Candidate)]) -> Result<Vec<Candidate>> {
        able.sort_unstable_by(|(one, a), (other, b)| one.total_cmp(other).then(a.vertex.cmp(&b.vertex)));
        for &(_, candidate) in &*able {
            self.is_touched[candidate.vertex] = false;
            let may_go = self.may_go(candidate)?;
            self.tests.check_stop()?;
            if may_go {
                self.remove(candidate)?;
            }
        }
        let mut left = Vec::new();
        let is_left = |c: &&Candidate| self.mesh.at[c.vertex] != NONE && self.is_touched[c.vertex];
        memory::collect(&mut left, candidates.iter().filter(is_left).copied())?;
        Ok(left)
    }

    /// Takes a vertex away that [may go](Self::may_go), and was looked at last.
    fn remove(&mut self, Candidate { vertex, between, .. }: Candidate) -> Result<()> {
        match between {
            None => self.mesh.read_around(vertex)?,
            Some([before, behind]) => self.into[behind as usize] = self.current(before),
        }
        self.mesh.replace(vertex, &self.hole)?;
        memory::push(&mut self.told.vertices, vertex)?;
        let is_near_bad = self.is_near_bad[vertex];
        for side in &self.mesh.rim {
            for v in side.ends {
                self.is_touched[v] = true;
                self.is_near_bad[v] |= is_near_bad;
            }
        }
        Ok(())
    }

    /// Squared length of the shortest edge at a vertex that [may go](Self::may_go), and was looked at last: to the corners of
    /// what takes its place. The order of the cells does not matter to it, which copies do not keep.
    fn shortest_edge(&self, vertex: VertexId) -> f64 {
        let corners = self.hole.triangles.iter().flat_map(|&(corners, _)| corners);
        let squares = corners.map(|w| {
            let u = minus::<f64, 2>(self.mesh.point(w), self.mesh.point(vertex));
            dot(&u, &u)
        });
        squares.fold(f64::INFINITY, f64::min)
    }

    /// Whether a vertex may go: then the hole is what takes its place.
    fn may_go(&mut self, Candidate { vertex, between, .. }: Candidate) -> Result<bool> {
        if self.mesh.at[vertex] == NONE {
            return Ok(false);
        }
        let Some([before, behind]) = between else { return self.may_go_inside(vertex) };
        let before = self.current(before);
        let [a, b] = [self.mesh.pieces[before as usize].ends[0], self.mesh.pieces[behind as usize].ends[1]];
        if !self.is_on_line(vertex, [a, b]) || !self.mesh.look_around_joint([before, behind])? {
            return Ok(false);
        }
        let worst = self.worst(vertex, &self.mesh.cells);
        let offset = self.mesh.squared_offset(vertex, [a, b]).sqrt();
        self.list_in_gap(Some(a))?;
        let Coarsening { mesh, tests, room, hole, origins, in_gap, .. } = self;
        let is_filled = mesh.fill_joined([before, behind], hole, &|mesh, corners, label| {
            is_good(mesh, tests, room.share, worst, corners, label)
                || is_left(mesh, (tests, origins), room.share, (in_gap, offset), corners, label)
        })?;
        Ok(is_filled && !self.would_encroach(vertex, &self.mesh.cells, Some([a, b])))
    }

    fn may_go_inside(&mut self, vertex: VertexId) -> Result<bool> {
        let Some(label) = self.mesh.look_around(vertex, &mut self.hole)? else { return Ok(false) };
        let worst = self.worst(vertex, &self.hole.around);
        self.list_in_gap(None)?;
        let Coarsening { mesh, tests, room, hole, origins, in_gap, .. } = self;
        let is_filled = mesh.fill_polygon(hole, label, &|mesh, corners, label| {
            is_good(mesh, tests, room.share, worst, corners, label)
                || is_left(mesh, (tests, origins), room.share, (in_gap, 0.0), corners, label)
        })?;
        Ok(is_filled && !self.would_encroach(vertex, &self.hole.around, None))
    }

    /// Lists the triangles around a vertex that has been looked at in whose place some may be left in a gap: those on
    /// one side of its pieces, which meet in it from this end on, or all, if each is in a narrow gap, and one is bad.
    fn list_in_gap(&mut self, start: Option<VertexId>) -> Result<()> {
        let Coarsening { mesh, tests, hole, origins, in_gap, .. } = self;
        in_gap.clear();
        let Some(origins) = origins else { return Ok(()) };
        let (left, right) = match start {
            None => (&hole.around[..], &[][..]),
            Some(start) => mesh.cells.split_at(mesh.rim.iter().position(|s| s.ends[0] == start).unwrap_or(0)),
        };
        for side in [left, right] {
            let is_bad = |&t: &u32| {
                let (corners, label) = mesh.corners_of(t);
                Tests::is_selected(label) && tests.is_flawed(corners.map(|v| mesh.point(v)), label, &corners)
            };
            let is_in_gap = |&t: &u32| mesh.gap_around(t, tests, origins).is_some_and(is_surely_narrow);
            if side.iter().all(is_in_gap) && side.iter().any(is_bad) {
                memory::append(in_gap, side)?;
            }
        }
        Ok(())
    }

    /// Whether what has been found would encroach a piece: one at the triangles around the vertex, or the joined one. What
    /// is in a lens is of a small angle, so that only circles need be looked at, and lenses where any angle may be: what is
    /// on a piece, but for rounding, is in these.
    fn would_encroach(&self, vertex: VertexId, around: &[u32], joined: Option<[VertexId; 2]>) -> bool {
        let is_piece = |ends: [VertexId; 2]| {
            let is_joined = |[a, b]: [VertexId; 2]| ends == [a, b] || ends == [b, a];
            joined.is_some_and(is_joined)
                || around.iter().any(|&t| self.mesh.is_segment_opposite(t, vertex, ends))
        };
        let are_conforming = self.tests.are_conforming();
        (are_conforming || !self.tests.has_least_angle())
            && self.hole.triangles.iter().any(|&(corners, label)| {
                Tests::is_selected(label)
                    && (are_conforming || !self.tests.is_flat(corners.map(|v| self.mesh.point(v))))
                    && (0..3).any(|i| {
                        let ends = [corners[next(i)], corners[previous(i)]];
                        let places = ends.map(|v| self.mesh.point(v));
                        self.tests.is_encroached(places, self.mesh.point(corners[i])) && is_piece(ends)
                    })
            })
    }

    /// The piece that a segment is a part of by now.
    fn current(&self, mut segment: u32) -> u32 {
        while self.into[segment as usize] != segment {
            segment = self.into[segment as usize];
        }
        segment
    }

    /// Finds that of all.
    fn find_current(&mut self) {
        for segment in 0..self.into.len() as u32 {
            self.into[segment as usize] = self.current(segment);
        }
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
        let offset = self.room.offset * dot(&u, &u).sqrt();
        // Far from the origin the last places of short pieces are a large share of them.
        let most = if offset > 0.0 { offset.max(self.tests.resolution * ROUNDED) } else { 0.0 };
        self.mesh.squared_offset(vertex, [a, b]) <= most * most
    }

    /// The squared cosine of the least angle that triangles in the place of those around a vertex may have: it is that of
    /// the worst of them, if that is worse than wanted.
    fn worst(&self, vertex: VertexId, around: &[u32]) -> f64 {
        if !self.is_near_bad[vertex] {
            return self.squared_cosine;
        }
        around.iter().fold(self.squared_cosine, |worst, &t| {
            let (corners, label) = self.mesh.corners_of(t);
            if !Tests::is_selected(label) {
                return worst;
            }
            let points = corners.map(|v| self.mesh.point(v));
            let narrowest = narrowest(points);
            let square = squared_cosine(points, narrowest);
            let is_bad = square > self.tests.squared_cosine;
            // An angle between segments is not mended.
            let may_mend = is_bad && !self.mesh.is_between_segments(t, narrowest);
            if may_mend { worst.max(square) } else { worst }
        })
    }

    /// Tells what has become of the segments.
    fn tell(&mut self, given: Given) -> Result<()> {
        self.find_current();
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
        Ok(())
    }
}

/// Whether a triangle fulfils the criteria with areas and lengths of this share, and angles above one of this squared cosine.
fn is_good(
    mesh: &Mesh,
    tests: &Tests,
    share: f64,
    squared_cosine: f64,
    corners: [VertexId; 3],
    label: u32,
) -> bool {
    let points = corners.map(|v| mesh.point(v));
    let size = |i: usize| tests.given_sizes()[corners[i]];
    !Tests::is_selected(label)
        || tests.measure_with(points, label, size, share, squared_cosine).flaw.is_none()
}

/// Whether a triangle is one that refinement leaves as it is, in a narrow gap as those whose place it takes, and not
/// too large. Pieces that are joined by less than this offset change nothing of that.
fn is_left(
    mesh: &Mesh,
    (tests, origins): (&Tests, &Option<Origins>),
    share: f64,
    (in_gap, offset): (&[u32], f64),
    corners: [VertexId; 3],
    label: u32,
) -> bool {
    let Some(origins) = origins else { return false };
    let Some(k) = mesh.place_of_middle(corners, in_gap) else { return false };
    let points = corners.map(|v| mesh.point(v));
    let size = |i: usize| tests.given_sizes()[corners[i]];
    !tests.is_flat(points)
        && tests.measure_with(points, label, size, share, NO_ANGLE).flaw.is_none()
        && mesh
            .gap_of(corners, in_gap[k], tests, origins)
            .is_some_and(|gap| offset <= BENT * gap.width && is_surely_narrow(gap))
}

fn is_surely_narrow(gap: NarrowGap) -> bool {
    gap.width <= SURELY * gap.limit
}

/// Squared cosine of the angle at a corner.
fn squared_cosine(p: [&[f64; 2]; 3], corner: usize) -> f64 {
    let [u, v] = [next(corner), previous(corner)].map(|i| minus::<f64, 2>(p[i], p[corner]));
    dot(&u, &v).powi(2) / (dot(&u, &u) * dot(&v, &v))
}
