//! Geometry that programs compute from the cells: read from the arrays of
//! [`cells`](crate::motion::MovingTriangulation::cells) and the positions, without any change to the triangulation.
//!
//! | file | what |
//! |---|---|
//! | `around` | the cells around some of the vertices |
//! | `measures` | circumspheres and volumes of cells, masks by circumradius |
//! | `flat_sides` | a mask without the flat cells that rounding makes along the hull |
//! | `boundary` | facets around a mask of cells, the convex hull |
//! | `incidence` | edges, neighbours and cells of vertices, mirror indices |
//! | `simplices` | cells that have given vertices as corners |
//! | `star` | stars in circulation order |
//! | `rings` | what is around an edge, in order |
//! | `voronoi_cells`, `voronoi_lists`, `pass`, `voronoi` | Voronoi cells and facets: what programs ask, what is computed together |
//! | `voronoi_changes` | which Voronoi cells have changed |
//! | `centres` | circumcentres for these, of all cells or of chosen ones |
//! | `dual`, `dual_cells`, `dual_facets`, `sums` | volumes, boundaries and centroids of Voronoi cells; their facets, with derivatives |
//! | `whole_cells`, `whole_facets` | those that no box cuts |
//! | `clipping`, `cut_facets`, `facet_measures`, `cut_cells` | those that are cut by a box |
//! | `half_spaces`, `polytopes`, `cells_within` | those that are cut by half-spaces besides |
//! | `flat_cells` | Voronoi cells of vertices in one hyperplane |
//! | `interpolation`, `linear`, `natural` | values between vertices: linear, or of natural neighbours |
//! | `weights` | barycentric coordinates of places |
//!
//! What depends on signs (masks, facets, neighbours) is exact. Numbers are rounded, and alike on every
//! processor; each function says by how much.

mod around;
mod boundary;
mod cells_within;
mod centres;
mod clipping;
mod cut_cells;
mod cut_facets;
mod dual;
mod dual_cells;
mod dual_facets;
mod facet_measures;
mod flat_cells;
mod flat_sides;
mod half_spaces;
mod incidence;
mod interpolation;
mod linear;
mod measures;
mod natural;
mod pass;
mod polytopes;
mod rings;
mod simplices;
mod star;
mod sums;
mod voronoi;
mod voronoi_cells;
mod voronoi_changes;
mod voronoi_lists;
mod weights;
mod whole_cells;
mod whole_facets;

pub use boundary::BoundaryFacet;
pub(crate) use boundary::list_boundary;
pub(crate) use dual_cells::nowhere;
pub use dual_cells::{VoronoiCell, VoronoiCells};
pub use dual_facets::{VoronoiFacet, VoronoiFacets};
pub(crate) use flat_sides::without_flat_cells;
pub(crate) use incidence::EdgeWithCell;
pub use incidence::Rows;
pub(crate) use incidence::first_cells;
pub use interpolation::{Interpolation, VertexValues};
pub(crate) use measures::tell_all;
pub(crate) use natural::Ridges;
pub(crate) use pass::VoronoiAsked;
pub(crate) use simplices::{are_many, check_corners, check_simplices, find_in_stars};
pub(crate) use star::ordered_star;
pub use voronoi_cells::{TellCell, TellFacet};
