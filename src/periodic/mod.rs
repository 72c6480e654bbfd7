//! Triangulations of sets that repeat: each vertex is in all places to which a lattice takes it.
//!
//! Inside is a triangulation of the plane or of space that has each vertex once, *at home*, in a cell of the lattice or
//! near it, and the *images* of vertices that have a common cell with one at home, or may have one. Each cell of the
//! repeating set is there, with all of its neighbours, for each vertex of it that is at home.
//!
//! # Which images are needed
//!
//! Let H be a convex set that has all vertices at home. An image of u by −s is needed if the ball of a cell at u, or the
//! half-space beyond a facet of the hull there, meets H translated by s. They are inserted until none is missing. Then all
//! cells at vertices at home are those of the repeating set: suppose that C, a cell at u, has another vertex in its ball. Of the
//! cells at u in the repeating set, take the one where a way from u into C begins. It has a vertex y in the ball of C, as at u
//! the lifted planes of both agree, and along the way that of the set is lower. y is at home by a translation s, so H
//! translated by s meets the ball of C, and u by −s is there, and −s takes y home. The edge from u to y is one of any
//! triangulation that has both, and the ball of a cell at it touches u. So −s takes home what takes y to its image, which
//! is there, and would be a corner. (A process that sends its vertices to others by this rule is the origin of this proof: here
//! all processes are translations of one.)
//!
//! What is farther than the lattice allows for vertices of one cell is not inserted (lattice.rs).
//!
//! # With weights
//!
//! Let W be the greatest weight, and the *reach* of a cell the ball around its power centre with the square of the radius of its
//! power sphere plus W. Whatever would change the cell is in its reach, as are its corners, so reaches take the place of
//! balls. The proof is the same for a vertex u that the repeating set shows: inside shows it as well, as what is inside is a part of
//! the set. So all cells of the set at vertices at home that it shows are there.
//!
//! What is left is to prove that u at home is hidden inside if the set hides it. Then some cell F of the set has the place of u in its
//! closure. There the power of the place in respect of F is the mean of the corners' weights less the mean of their squared
//! distances from it, with its barycentric coordinates: at most W. So the place is in the reach of F. Translate F so that any
//! of its corners is at home: it is a cell at a vertex that is shown, and so inside, and its reach has a place of H translated. So
//! the image that takes this corner back to where F has it is there. All corners of F are there, and with them F, as it is a
//! cell of the set, and it hides u.
//!
//! How far away images can be is bounded as without weights: in a power cell each place is at least as near to its vertex as to the
//! translations of that, which have its weight.
//!
//! # A commit
//!
//! Vertices and their images move, come and go, then images that are missing are inserted, in rounds of the same timestamp; cells
//! that have changed tell whether any is missing (following.rs). If the lattice changes, too, shifts by its vectors become shifts
//! by those of the next one that are nearest: cells that were translations of each other stay so. Where a vertex
//! would be too far from the unit cell, many vertices come or go (editing.rs), or the lattices are too different, another
//! triangulation is built beside the present one, and takes its place when it is complete.

mod boxes;
mod cells;
mod changes;
mod cloning;
mod commit;
mod compaction;
mod completeness;
mod container;
mod cut_voronoi;
mod edges;
mod editing;
mod either;
mod exporting;
mod following;
mod geometry;
mod grid;
mod hidden;
mod hidden_vertices;
mod homes;
mod images;
mod immediate;
mod incidence;
mod inside;
mod interpolating;
mod kept;
mod lattice;
mod lists;
mod locating;
mod near;
mod needed;
mod parts;
mod preparing;
mod reading;
mod reduction;
mod relation;
mod rounds;
mod saving;
mod staged;
mod staging;
mod taking;
#[cfg(test)]
mod tests;
mod transferring;
mod triangulation;
mod validate;
mod voronoi;
#[cfg(test)]
mod wrapping;
mod zone;

pub use cells::PeriodicView;
pub use either::AnyPeriodic;
pub use saving::SavedPeriodic;
pub use triangulation::PeriodicTriangulation;
