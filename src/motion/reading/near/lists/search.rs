//! The search of the lists of vertices that are near each other.
//!
//! The places in one box without halves are looked for together: those of the boxes in their reach are copied into rows of
//! [`LANES`], beside each other, translated where the set repeats. Each vertex of the box then looks at the rows of which the
//! box is in its own reach. Rounded squares of distances decide, but for those within their error of the square of the radius,
//! which are decided exactly.

use std::ops::Range;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::near::lists::tree::{BoxTree, NO_LIST, Node, PlacedVertex};
use crate::predicates::is_within_distance;
use crate::simd::{LANES, in_lanes};

/// By how much a rounded square of a distance may be off: a sum of three squares of differences, with some last bits each.
const MARGIN: f64 = 1e-14;

/// What squares may be off by underflow, and more.
const LEAST: f64 = 1e-300;

/// A vertex of a list, and which of the translations takes it there; ordered by both.
pub(crate) trait Entry: Copy + Ord + Send + Sync + Default {
    fn of(vertex: VertexId, translation: u32) -> Self;
    fn parts(self) -> (VertexId, usize);
}

/// Where there is no translation but that by nothing.
impl Entry for u32 {
    #[inline(always)]
    fn of(vertex: VertexId, _: u32) -> Self {
        vertex.get()
    }

    #[inline(always)]
    fn parts(self) -> (VertexId, usize) {
        (VertexId::new(self), 0)
    }
}

impl Entry for u64 {
    #[inline(always)]
    fn of(vertex: VertexId, translation: u32) -> Self {
        u64::from(vertex.get()) << 32 | u64::from(translation)
    }

    #[inline(always)]
    fn parts(self) -> (VertexId, usize) {
        (VertexId::new((self >> 32) as u32), self as u32 as usize)
    }
}

/// What is looked for, and among what.
pub(crate) struct Search<'s, G: Moving> {
    pub(crate) tree: BoxTree<G>,
    /// Ways by which places are translated without rounding, in an order of their own, and which of them is none.
    pub(crate) translations: &'s [G::Point],
    pub(crate) nowhere: usize,
    /// Whether each pair comes once.
    pub(crate) is_half: bool,
    /// Whether lists are wanted, or their lengths alone.
    pub(crate) is_kept: bool,
}

/// The lists of some vertices, one after the other.
pub(crate) struct Part<E> {
    pub(crate) entries: Vec<E>,
    /// The length of each.
    pub(crate) lengths: Vec<usize>,
}

/// Places beside each other.
#[derive(Clone, Copy)]
struct PlacesInLanes<E> {
    axes: [[f64; LANES]; 3],
    entries: [E; LANES],
    /// The squares of their own radii.
    squared_radii: [f64; LANES],
}

/// Rows of one box.
struct RowsOfBox<P> {
    low: P,
    high: P,
    greatest: f64,
    rows: Range<usize>,
}

/// The rows in reach of one box, kept as scratch from one to the next.
struct RowsInReach<G: Moving, E> {
    rows: Vec<PlacesInLanes<E>>,
    segments: Vec<RowsOfBox<G::Point>>,
    found: Vec<E>,
}

impl<G: Moving> Search<'_, G> {
    /// The lists of a range of places, in the order of the tree.
    pub(crate) fn lists<E: Entry>(&self, range: Range<usize>) -> Result<Part<E>> {
        let mut part = Part { entries: Vec::new(), lengths: Vec::new() };
        let mut beside = RowsInReach::<G, E> { rows: Vec::new(), segments: Vec::new(), found: Vec::new() };
        memory::reserve_exact(&mut part.lengths, range.len())?;
        let tree = &self.tree;
        let first =
            tree.leaves.partition_point(|&leaf| tree.nodes[leaf as usize].end as usize <= range.start);
        for &leaf in &tree.leaves[first..] {
            let node = &tree.nodes[leaf as usize];
            let own = range.start.max(node.first as usize)..range.end.min(node.end as usize);
            if own.is_empty() {
                break;
            }
            self.gather(node, &mut beside)?;
            for placed in &tree.placed[own] {
                let n_found = if placed.squared_radius < 0.0 {
                    0
                } else {
                    in_lanes!(_simd => self.list(placed, &mut beside))
                };
                if self.is_kept {
                    beside.found[..n_found].sort_unstable();
                    memory::append(&mut part.entries, &beside.found[..n_found])?;
                }
                part.lengths.push(n_found);
            }
        }
        Ok(part)
    }

    /// Makes rows of what is in reach of a box.
    fn gather<E: Entry>(&self, node: &Node<G::Point>, beside: &mut RowsInReach<G, E>) -> Result<()> {
        beside.rows.clear();
        beside.segments.clear();
        if node.greatest < 0.0 {
            return Ok(());
        }
        for (k, way) in self.translations.iter().enumerate() {
            let (mut low, mut high) = (node.low, node.high);
            for axis in 0..G::D {
                low[axis] -= way[axis];
                high[axis] -= way[axis];
            }
            let is_near = |other: &Node<G::Point>| {
                let reach = if self.is_half { node.greatest.max(other.greatest) } else { node.greatest };
                square_between::<G>([&low, &high], [&other.low, &other.high]) <= reach
            };
            self.tree.for_leaves(is_near, |other| {
                let first = beside.rows.len();
                let placed = &self.tree.placed[other.first as usize..other.end as usize];
                let rows = placed.chunks(LANES).map(|some| row_of::<G, E>(some, way, k));
                memory::collect(&mut beside.rows, rows)?;
                let (mut low, mut high) = (other.low, other.high);
                for axis in 0..G::D {
                    low[axis] += way[axis];
                    high[axis] += way[axis];
                }
                let rows = first..beside.rows.len();
                memory::push(&mut beside.segments, RowsOfBox { low, high, greatest: other.greatest, rows })
            })?;
        }
        let needed = LANES * (beside.rows.len() + 1);
        if beside.found.len() < needed {
            let more = needed - beside.found.len();
            memory::reserve(&mut beside.found, more)?;
            beside.found.resize(needed, E::default());
        }
        Ok(())
    }

    /// Finds what is near a vertex; how many there are.
    #[inline(always)]
    fn list<E: Entry>(&self, placed: &PlacedVertex<G::Point>, beside: &mut RowsInReach<G, E>) -> usize {
        if self.is_half {
            self.list_as::<E, true>(placed, beside)
        } else {
            self.list_as::<E, false>(placed, beside)
        }
    }

    #[inline(always)]
    fn list_as<E: Entry, const IS_HALF: bool>(
        &self,
        placed: &PlacedVertex<G::Point>,
        RowsInReach { rows, segments, found }: &mut RowsInReach<G, E>,
    ) -> usize {
        let q = &placed.place;
        let own = E::of(placed.vertex, self.nowhere as u32);
        let squared_radius = placed.squared_radius;
        let mut n = 0;
        for segment in segments.iter() {
            let reach = if IS_HALF { squared_radius.max(segment.greatest) } else { squared_radius };
            if square_between::<G>([q, q], [&segment.low, &segment.high]) > reach {
                continue;
            }
            for row in &rows[segment.rows.clone()] {
                let mut squares = [0.0; LANES];
                for axis in 0..G::D {
                    for (square, x) in squares.iter_mut().zip(row.axes[axis]) {
                        let way = q[axis] - x;
                        *square += way * way;
                    }
                }
                let limits = if IS_HALF {
                    row.squared_radii.map(|other| squared_radius.max(other))
                } else {
                    [squared_radius; LANES]
                };
                let is_wanted = |lane: usize| {
                    let entry = row.entries[lane];
                    if IS_HALF { entry > own || row.squared_radii[lane] < 0.0 } else { entry != own }
                };
                let into = &mut found[n..n + LANES];
                let (mut n_here, mut is_decided) = (0, true);
                for lane in 0..LANES {
                    let (square, limit) = (squares[lane], limits[lane]);
                    let error = limit * MARGIN + LEAST;
                    is_decided &= (square - limit).abs() > error;
                    into[n_here] = row.entries[lane];
                    n_here += usize::from(square <= limit && is_wanted(lane));
                }
                if !is_decided {
                    n_here = decide::<G, E>(q, row, &limits, is_wanted, into);
                }
                n += n_here;
            }
        }
        n
    }
}

/// Finds which places of a row are near a vertex, exactly; how many there are.
#[cold]
#[inline(never)]
fn decide<G: Moving, E: Entry>(
    q: &G::Point,
    row: &PlacesInLanes<E>,
    limits: &[f64; LANES],
    is_wanted: impl Fn(usize) -> bool,
    into: &mut [E],
) -> usize {
    let mut n = 0;
    for lane in (0..LANES).filter(|&lane| is_wanted(lane) && row.axes[0][lane] != f64::INFINITY) {
        let mut place = *q;
        (0..G::D).for_each(|axis| place[axis] = row.axes[axis][lane]);
        if is_within_distance(q, &place, limits[lane]) {
            into[n] = row.entries[lane];
            n += 1;
        }
    }
    n
}

/// A row of up to [`LANES`] places; those that are missing are nowhere.
#[inline(always)]
fn row_of<G: Moving, E: Entry>(
    some: &[PlacedVertex<G::Point>],
    way: &G::Point,
    translation: usize,
) -> PlacesInLanes<E> {
    let mut row = PlacesInLanes {
        axes: [[f64::INFINITY; LANES]; 3],
        entries: [E::default(); LANES],
        squared_radii: [NO_LIST; LANES],
    };
    for (lane, placed) in some.iter().enumerate() {
        for axis in 0..G::D {
            row.axes[axis][lane] = placed.place[axis] + way[axis];
        }
        row.entries[lane] = E::of(placed.vertex, translation as u32);
        row.squared_radii[lane] = placed.squared_radius;
    }
    row
}

/// The square of the distance between two boxes, rounded downwards.
#[inline(always)]
fn square_between<G: Moving>(one: [&G::Point; 2], other: [&G::Point; 2]) -> f64 {
    let mut square = 0.0;
    for axis in 0..G::D {
        let way = (one[0][axis] - other[1][axis]).max(other[0][axis] - one[1][axis]).max(0.0);
        square += way * way;
    }
    square * (1.0 - MARGIN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::Plane;

    /// How many places are looked at, or may be, and how many entries there are.
    fn counts(places: &[[f64; 2]], squared_radius: impl Fn(usize) -> f64) -> [usize; 2] {
        let placed = places.iter().enumerate().map(|(k, &place)| PlacedVertex {
            place,
            squared_radius: squared_radius(k),
            vertex: VertexId::at(k),
        });
        let search = Search::<Plane> {
            tree: BoxTree::new(placed.collect()).expect("memory"),
            translations: &[[0.0; 2]],
            nowhere: 0,
            is_half: false,
            is_kept: false,
        };
        let mut beside =
            RowsInReach::<Plane, u32> { rows: Vec::new(), segments: Vec::new(), found: Vec::new() };
        let mut n_looked_at = 0;
        for &leaf in &search.tree.leaves {
            let node = &search.tree.nodes[leaf as usize];
            search.gather(node, &mut beside).expect("memory");
            n_looked_at += LANES * beside.rows.len() * (node.end - node.first) as usize;
        }
        let part = search.lists::<u32>(0..places.len()).expect("memory");
        [n_looked_at, part.lengths.iter().sum()]
    }

    /// However unevenly places are spread, what is looked at is in proportion to their number and to what is found.
    #[test]
    fn no_set_takes_all_pairs() {
        let n = 4000;
        let of = |place: &dyn Fn(f64) -> [f64; 2]| -> Vec<[f64; 2]> {
            (0..n).map(|k| place(f64::from(k) / f64::from(n))).collect()
        };
        let noise = |x: f64, factor: f64| (x * factor).fract();
        let line = of(&|x| [x, 2.0 * x]);
        let along_axis = of(&|x| [x, 0.5]);
        let clusters = of(&|x| [(8.0 * x).floor() + 1e-9 * noise(x, 7919.3), 1e-9 * noise(x, 104_729.7)]);
        let powers = of(&|x| [(-600.0 * x).exp2(), (-500.0 * x).exp2()]);
        let comb = of(&|x| [(64.0 * x).floor() / 64.0, 1e-6 * noise(64.0 * x, 1.0)]);
        // Half of them around the middle, the others on a circle that is just beyond the radius of each of these.
        let circle = of(&|x| match x {
            x if x < 0.5 => [1e-7 * noise(x, 7919.3), 1e-7 * noise(x, 104_729.7)],
            x => [(13.0 * x).cos() * 1.000_001, (13.0 * x).sin() * 1.000_001],
        });
        for (name, places) in [
            ("line", &line),
            ("along_axis", &along_axis),
            ("clusters", &clusters),
            ("powers", &powers),
            ("comb", &comb),
            ("circle", &circle),
        ] {
            for radius in [1e-15, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 1.0] {
                let [n_looked_at, n_found] = counts(places, |_| radius * radius);
                assert!(
                    n_looked_at <= 60 * (places.len() + n_found),
                    "{name} {radius}: {n_looked_at} {n_found}"
                );
            }
            // Each its own, from far less than what is between them to far more.
            let [n_looked_at, n_found] = counts(places, |k| 4f64.powi(-((k * 7919 % 40) as i32)));
            assert!(n_looked_at <= 60 * (places.len() + n_found), "{name}: {n_looked_at} {n_found}");
        }
    }
}
