//! Delaunay refinement and coarsening of constrained triangulations in the plane.
//!
//! Cells of a domain are to have no small angles, and not to be large. Vertices are added until that is so: in the middle of
//! a bad triangle's circle, or nearer to its shortest edge, and in the middle of segments that are in the way (Ruppert,
//! 10.1006/jagm.1995.1021; Chew, 10.1145/160985.161150; off-centres: Üngör, 10.1016/j.comgeo.2008.06.002; small angles of the
//! input: Shewchuk, 10.1016/S0925-7721(01)00047-5).
//!
//! ```text
//! while a piece of a segment is encroached: split it
//! take the bad triangle with the shortest edge; find its centre, walking straight
//!     a segment is in between: split it; the triangle waits again
//!     it would encroach pieces: split them; the triangle waits again
//!     otherwise: insert it
//! ```
//!
//! A piece is *encroached* by a vertex in its diametral lens, that sees its ends under more than 180 degrees less twice the
//! least angle. Before it is split, vertices of this call in its diametral circle are taken away. Where every triangle is to
//! be Delaunay, segments or not, a piece is encroached by what is strictly inside its diametral circle: of two triangles at
//! a segment the corners opposite then see it under 90 degrees at most, so neither is inside the other's circle.
//!
//! | file | what |
//! |---|---|
//! | `given` | the cells of a triangulation, and what is selected of them |
//! | `parts` | sides, triangles, pieces of segments |
//! | `mesh` | triangles of their own, copied from the cells as they are entered |
//! | `walking`, `insertion` | where a place is; a vertex there |
//! | `around` | what is around a vertex, before anything is copied |
//! | `removal` | removal of a vertex, from within or between two pieces |
//! | `criteria` | what is bad, what is encroached |
//! | `flat` | vertices that touch a piece: a few last places beside it |
//! | `gaps` | narrow gaps between segments |
//! | `queue` | bad triangles in order |
//! | `refinement` | what refinement knows, and what waits |
//! | `examining`, `splitting`, `refining` | what is wanted; where pieces are split; what is done for bad triangles |
//! | `telling` | the calls, and what they tell |
//! | `coarsening`, `staying` | vertices that are not needed any more leave; those that surely stay |
//! | `waking` | vertices that stay, as refinement would put them back |
//!
//! # What is exact
//!
//! All signs are ([`predicates`](crate::predicates)), ties are broken by vertex id. So at any time the triangles that
//! are refined are those of a fresh constrained build of all vertices and pieces; the caller builds them by its own means.
//! Places of new vertices are rounded. One in a triangle may be anywhere in it. One on a segment need not be exactly on
//! it: then its pieces are straight between their own ends, and the segment bends by a last bit. A place is refused where a
//! piece would touch or cross anything else, and another one near it is taken: outside of a domain, a side that has bent
//! has slivers beside it, and no place is legal that is not in one of the two triangles at the piece. So the pieces are the
//! boundary, exactly as they are stored, and no two are taken for collinear.
//!
//! # Why it ends
//!
//! Vertices and pieces *touch* that are nearer to each other than r, 1,024 last places of the greatest coordinate. No edge of
//! less than 2r is refined, no piece is split less than r from its ends, and what touches a piece does not encroach it
//! (`flat`). An off-centre is no nearer to any vertex than the shortest edge of its triangle is long, a circumcentre no nearer
//! than that length by the square root of 3. So no vertex comes within r of another one, and there can only be so many: that
//! is proved, with rounding, for all angles, sizes and domains. It is no number that a program could wait for.
//!
//! How many there are in fact follows from the *local feature size* of the input, as long as it is above r. Without input
//! angles below 60 degrees between segments, and for a least angle up to 26.5 degrees, Chew's second algorithm ends by
//! Shewchuk's proof: no edge becomes shorter than the *local feature size* of the input there allows. The order of
//! the queue and off-centres keep that: an off-centre is no nearer to other vertices than the shortest edge of its
//! triangle is long. Above, it ends in practice up to some 34 degrees, which is why more is refused.
//!
//! With circles in the place of lenses this is Ruppert's algorithm, and ends for a least angle up to 20.7 degrees, by
//! Shewchuk's proof too. A vertex that is taken away from a circle makes no difference: each time a piece is split, of
//! which there can only be so many, as none becomes shorter than that feature size allows. Vertices on one circle are told
//! apart exactly, so that a right angle, as in a square with its diagonal, is no cause for splitting. Both proofs take the
//! pieces of a segment for straight. Stored pieces are not, by a last bit at each vertex, and the angle between two of one
//! segment is 180 degrees to that: no triangle of the quality notices, as its edges are longer than 2r.
//!
//! At an apex of segments with a smaller angle, segments are split at powers of two from it, and a triangle across the angle
//! stays as it is if its shortest edge is between two vertices on one shell and the angle is below 30 degrees: that edge is
//! as long as the angle makes it, and what would come of it is smaller by the same factor each time. From 30 degrees on it
//! is no shorter than the pieces at the shell. Other triangles have angles that refinement mends.
//! Vertices on common shells are in no circles of each other's pieces: from distance d at an angle w, the piece from d to
//! 2d is seen under 90 degrees at most, since 2d² - 3d² cos w + d² is not negative. Places are rounded, and w² has to be
//! above that: at angles below 1e-8 or so vertices on two segments are in each other's circles until the last bits. Such
//! angles are narrow gaps.
//!
//! A bad triangle waits again only after a piece has been split, and vertices on pieces stay. Pieces that cannot be split,
//! since they are kept whole or there is no room, are left, and so are triangles that need it. But one of too large an area
//! gets its centroid where pieces that are kept whole are in the way of its centre. With area A and longest edge L that is
//! 2A / 3L away from its sides, so there can only be so many. When nothing waits, all that was left is looked at again, until
//! a pass over all of it changes nothing. So a second call has nothing to do.
//!
//! # Narrow gaps
//!
//! Between two segments that are nearly parallel, by 0.2 degrees, cells without small angles are as small as the gap is
//! wide, so that there are as many as it is longer than wide. Where it is narrower than 1 / 8,192 of the shorter segment,
//! and of the distance from a common end, that is left (`gaps`): a triangle whose middle is there is not mended for its
//! angle, and its corners encroach no piece. For its size it is mended by splits of pieces: it gets no off-centre, which
//! would be at its shortest edge. A vertex beside a segment is no gap, nor is what is around the end of a gap: there
//! triangles get larger with the distance, and are as many as its logarithm says.
//!
//! Widths are compared with segments, not with pieces, and straight ways lead across a gap whatever vertices are in it: so
//! no vertex makes a gap a wide one, but for last places by which it bends a piece, and what has been left is looked at
//! again. What is in a gap depends on the triangulation alone, not on what has been done to it. No number of vertices is
//! proved by this beyond what is said above. In practice it is narrow gaps in which refinement does not end, and a gap that
//! is hardly not narrow gets some 10,000 vertices.
//!
//! # At rest
//!
//! Coarsening takes a vertex away if all triangles that come are good, by a margin. Only around triangles that refinement
//! would mend may they be as bad as those there: whether it would is found by its own rules ([`mendable`]). After a
//! refinement there are none, so what coarsening then leaves is good, or was left by refinement too, and neither of the
//! two finds anything to do. In a gap of half the width that is narrow a vertex goes if all triangles around it, or on one
//! side of its pieces, are there, one of them is bad, and those that come are there as well, and not too large:
//! refinement leaves these. Where refinement has left bad triangles, it is found on what coarsening leaves whether it would
//! still do nothing for them: if pieces that have been joined are in their way, too, the vertices stay that were between
//! these (`waking`), and all else is coarsened again. Without a least angle what is good may encroach a piece, being on it
//! but for rounding: such a vertex stays, too. Both calls know of flat triangles before they look at any other.
//!
//! # Made anew
//!
//! A mesh that is refined and coarsened again and again gets denser than one that is made at once: vertices stay that no
//! single removal can spare. [`remesh`] takes all vertices away that refinement has made, by the removals of coarsening
//! without its criteria, and refines what is left. What cannot be removed, as a vertex on a side that has been bent, stays a
//! vertex as those given.

mod around;
mod coarsening;
mod criteria;
mod examining;
mod flat;
mod gaps;
mod given;
mod insertion;
mod mesh;
mod parts;
mod queue;
mod refinement;
mod refining;
mod removal;
mod splitting;
mod staying;
mod telling;
mod waking;
mod walking;

pub(crate) use coarsening::{Candidate, Room, coarsen};
pub(crate) use criteria::{Criteria, Tests, distance, power_of_two_below};
pub(crate) use given::Given;
pub(crate) use parts::NONE;
pub use refinement::Kept;
pub(crate) use refinement::Origins;
pub(crate) use staying::keep;
pub(crate) use telling::{Refined, mendable, refine, remesh};
pub(crate) use waking::LeftBad;
