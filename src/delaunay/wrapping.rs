//! Gift wrapping in lanes: the cells that fill the hole of a removed site, found in doubles and made sure of
//! afterwards.
//!
//! Lift the sites of the link, seen from the removed one, to the paraboloid `w = |x|²`. The Delaunay triangulation of
//! the hole is below them: each of its cells has a hyperplane `w = u·x + e`, the *floor* of the cell, and no lifted
//! site is under it (Edelsbrunner and Seidel, 10.1007/BF02187681). All hyperplanes through a facet of the frontier are
//!
//! ```text
//! w = u·x + e + t h(x)        h: how far x is on the inner side of the facet, up to a factor
//! ```
//!
//! so the apex on the inner side is the site with the least `t = (|x|² − u·x − e) / h(x)` of those with `h(x) > 0`,
//! whatever floor through the facet one begins with: that of the cell of the star there, and later that of the new cell
//! whose facet it is, which is known from its own `t`. That is one pass over the link in lanes, without an error bound.
//!
//! **Certificates.** What is found may be wrong. It is taken only if each facet has been glued once, to one of the
//! opposite orientation, every new cell surely is positively oriented, and for each of its facets the site beyond
//! surely is outside its sphere. All cells together then are a closed, oriented pseudo-manifold of positive cells and
//! the ghosts that there were, so they cover every point as often as a point far away, once; and a triangulation in
//! which every facet passes is the Delaunay triangulation. Otherwise, where there are ties, nearly so, or ghosts around
//! the site, the frontier is wrapped by exact signs.
//!
//! Cost: for `k` sites of the link `2k` passes over `k / 4` lanes in space, and `k` in the plane, and the certificates
//! that a sweep evaluates for as many cells. (`examples/tolerance_share` times removals with insertions.)

use super::hole::{Hole, NEW, new_of};
use super::site::Sites;
use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::{cross, dot, minus};
use crate::simd::{ALL, LANES, Lanes, Real, Simd, in_lanes};

/// Most sites of a link.
const MOST_SITES: usize = 32;
/// Most new cells.
const MOST_CELLS: usize = 64;
/// Most facets of the frontier at a time: a byte holds the number of one, or that there is none.
const MOST_OPEN: usize = 255;
/// Sets of three sites, of which facets have two or three.
const SETS: usize = MOST_SITES * (MOST_SITES - 1) * (MOST_SITES - 2) / 6;
/// Removals after one that failed in which it is not tried, at most.
const MOST_SKIPPED: u8 = 15;

/// A facet of the frontier. Followed by a site on its inner side the labels are those of a positive cell.
#[derive(Clone, Copy, Debug)]
struct Open {
    /// The positions of the facet's sites among those of the link; in the plane two.
    labels: [u8; 3],
    /// Whether the labels are an odd permutation of those in ascending order.
    is_odd: bool,
    /// Which set of labels that is; [`CLOSED`] once there is a cell on the inner side.
    set: u16,
    /// The facet seen from the cell on the outer side.
    out: Facet,
}

const CLOSED: u16 = u16::MAX;

/// Scratch memory.
#[derive(Debug)]
pub(super) struct Wrapping {
    /// The sites of the link as seen from the one removed; and that by axis, followed by the squares of their
    /// distances.
    seen: [[f64; 3]; MOST_SITES],
    by_axis: [[f64; MOST_SITES]; 4],
    /// The floor of each new cell: `u` and then `e`.
    floors: [[f64; 4]; MOST_CELLS],
    open: [Open; MOST_OPEN],
    n_open: usize,
    /// For each set of labels one more than the number of the open facet that has these, or 0.
    by_set: [u8; SETS],
    /// In how many removals not to try, and in how many it was after the last failure.
    skips: u8,
    last_skips: u8,
}

impl Default for Wrapping {
    fn default() -> Self {
        let none = Open { labels: [0; 3], is_odd: false, set: CLOSED, out: Facet::NONE };
        Wrapping {
            seen: [[0.0; 3]; MOST_SITES],
            by_axis: [[0.0; MOST_SITES]; 4],
            floors: [[0.0; 4]; MOST_CELLS],
            open: [none; MOST_OPEN],
            n_open: 0,
            by_set: [0; SETS],
            skips: 0,
            last_skips: 0,
        }
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Finds the cells that fill the hole of the gathered star of `s`, whose link's sites are labelled; whether it has.
    #[inline(always)]
    pub(super) fn wrap_in_lanes(&mut self, s: SiteId, hole: &mut Hole<G>) -> Result<bool> {
        if hole.sites.len() > MOST_SITES || hole.sites.contains(&INFINITE) {
            return Ok(false);
        }
        let mut wrapping = memory::take_made(&mut self.wrapping)?;
        let reserved = memory::reserve(&mut hole.made, MOST_CELLS);
        let is_found = reserved.is_ok()
            && wrapping.is_due()
            && {
                let is_found = in_lanes!(simd, self as &Self, (hole, &mut *wrapping), s => |t, (hole, wrapping), s| {
                    wrapping.find(simd, t, hole, s)
                });
                wrapping.follow(is_found);
                is_found
            };
        self.wrapping = Some(wrapping);
        reserved.map(|()| is_found)
    }
}

impl Wrapping {
    fn is_due(&mut self) -> bool {
        let is_due = self.skips == 0;
        self.skips = self.skips.saturating_sub(1);
        is_due
    }

    /// Among ties it fails again and again.
    fn follow(&mut self, found: bool) {
        self.last_skips = if found { 0 } else { MOST_SKIPPED.min(2 * self.last_skips + 1) };
        self.skips = self.last_skips;
    }

    /// Finds the cells that fill the hole of `s`, whose link has no more than [`MOST_SITES`] sites, none of them the
    /// ghost vertex; there is room for [`MOST_CELLS`] cells. Whether it has.
    #[inline(always)]
    fn find<S: Simd, G: Geometry>(
        &mut self,
        simd: S,
        t: &Delaunay<G>,
        hole: &mut Hole<G>,
        s: SiteId,
    ) -> bool {
        hole.made.clear();
        self.see(t.view(), &hole.sites, s);
        let is_found = self.open_link(t, hole) && self.wrap(simd, hole);
        if !is_found {
            for open in &self.open[..self.n_open] {
                if open.set != CLOSED {
                    self.by_set[usize::from(open.set)] = 0;
                }
            }
        }
        is_found && are_certain(simd, t, hole)
    }

    #[inline(always)]
    fn see<G: Geometry>(&mut self, sites: Sites<G>, link: &[SiteId], s: SiteId) {
        let origin = sites.point(s);
        for (label, &site) in link.iter().enumerate().take(MOST_SITES) {
            let p = sites.point(site);
            let mut seen = [0.0; 3];
            for axis in 0..G::D {
                seen[axis] = p[axis] - origin[axis];
                self.by_axis[axis][label] = seen[axis];
            }
            self.seen[label] = seen;
            let square = dot(&seen, &seen);
            let weight = if G::HAS_WEIGHTS { p[G::D] - origin[G::D] } else { 0.0 };
            self.by_axis[3][label] = if G::HAS_WEIGHTS { square - weight } else { square };
        }
    }

    /// The frontier at first.
    #[inline(always)]
    fn open_link<G: Geometry>(&mut self, t: &Delaunay<G>, hole: &Hole<G>) -> bool {
        self.n_open = 0;
        for gap in &hole.link {
            let corners = gap.corners.rotated_to_last(gap.at);
            let mut labels = [0; 3];
            for i in 0..G::D {
                labels[i] = t.site(corners[i]).cell.get() as u8;
            }
            let (set, is_odd) = set_of::<G>(labels);
            if self.by_set[set] != 0 || !self.open(Open { labels, is_odd, set: set as u16, out: gap.out }) {
                return false;
            }
        }
        true
    }

    /// Adds a facet to the frontier, if there is room for it.
    #[inline(always)]
    fn open(&mut self, open: Open) -> bool {
        let Some(place) = self.open.get_mut(self.n_open) else { return false };
        *place = open;
        self.n_open += 1;
        self.by_set[usize::from(open.set)] = self.n_open as u8;
        true
    }

    /// Puts a cell on the inner side of every facet of the frontier; whether that can be done.
    #[inline(always)]
    fn wrap<S: Simd, G: Geometry>(&mut self, simd: S, hole: &mut Hole<G>) -> bool {
        while let Some(last) = self.n_open.checked_sub(1) {
            self.n_open = last;
            let open = self.open[last];
            if open.set == CLOSED {
                continue;
            }
            self.by_set[usize::from(open.set)] = 0;
            if !self.put_cell(simd, hole, &open) {
                return false;
            }
        }
        true
    }

    /// Puts a cell on the inner side of a facet.
    #[inline(always)]
    fn put_cell<S: Simd, G: Geometry>(&mut self, simd: S, hole: &mut Hole<G>, open: &Open) -> bool {
        let n = hole.made.len();
        if n == MOST_CELLS {
            return false;
        }
        let Some(apex) = self.apex::<_, G>(simd, open, hole.sites.len(), n) else { return false };
        let cell = Slot::at(NEW + n);
        let [a, b, c] = open.labels;
        let mut corners = G::Corners::filled(hole.sites[usize::from(apex)]);
        let mut neighbours = <G::Corners as Corners>::Of::<Facet>::filled(open.out);
        for i in 0..G::D {
            corners[i] = hole.sites[usize::from(open.labels[i])];
        }
        if let Some(out) = new_of(open.out) {
            hole.made[out].1[open.out.index()] = Facet::new(cell, G::D);
        }
        // Opposite each of the others, as seen from the cell that is to come there.
        let behind = if G::D == 2 {
            [[apex, b, 0], [a, apex, 0], [0; 3]]
        } else {
            [[b, c, apex], [c, a, apex], [a, b, apex]]
        };
        for i in 0..G::D {
            let labels = behind[i];
            let (set, is_odd) = set_of::<G>(labels);
            let out = Facet::new(cell, i);
            let Some(at) = self.by_set[set].checked_sub(1) else {
                if !self.open(Open { labels, is_odd, set: set as u16, out }) {
                    return false;
                }
                continue;
            };
            let met = &mut self.open[usize::from(at)];
            if met.is_odd == is_odd {
                return false;
            }
            met.set = CLOSED;
            self.by_set[set] = 0;
            neighbours[i] = met.out;
            if let Some(new) = new_of(met.out) {
                hole.made[new].1[met.out.index()] = out;
            }
        }
        hole.made.push((corners, neighbours));
        true
    }

    /// The label of the apex of the cell on the inner side of a facet, if there seems to be one; the floor of the cell,
    /// number `n` of the new ones, is entered.
    #[inline(always)]
    fn apex<S: Simd, G: Geometry>(&mut self, simd: S, open: &Open, n_sites: usize, n: usize) -> Option<u8> {
        let [a, b, c] = [open.labels[0], open.labels[1], open.labels[2]];
        let seen = |label: u8| &self.seen[usize::from(label) % MOST_SITES];
        // The plane of the facet, on which `normal · (x, y, z) + offset` is zero.
        let [a_seen, b_seen] = [seen(a), seen(b)];
        let normal = if G::D == 2 {
            [a_seen[1] - b_seen[1], b_seen[0] - a_seen[0], 0.0]
        } else {
            cross(&minus(b_seen, a_seen), &minus(seen(c), a_seen))
        };
        let offset = -dot(&normal, a_seen);
        let floor = match new_of(open.out) {
            Some(outer) => self.floors[outer % MOST_CELLS],
            None => {
                let square = |label: u8| self.by_axis[3][usize::from(label) % MOST_SITES];
                if G::D == 2 {
                    floor_of_edge(a_seen, b_seen, [square(a), square(b)], offset)
                } else {
                    floor_of_triangle(a_seen, b_seen, seen(c), [square(a), square(b), square(c)], offset)
                }
            }
        };
        let mut left = !0 >> (MOST_SITES - n_sites);
        left &= !(1 << a | 1 << b);
        if G::D == 3 {
            left &= !(1 << c);
        }
        let splat = |x: f64| simd.splat(x);
        let (mut least, mut of_least) = (splat(f64::INFINITY), splat(0.0));
        let mut labels = simd.load(&[0.0, 1.0, 2.0, 3.0]);
        let (normals, floors) = (
            [splat(normal[0]), splat(normal[1]), splat(normal[2])],
            [splat(floor[0]), splat(floor[1]), splat(floor[2]), splat(floor[3])],
        );
        let (zero, four, offsets) = (splat(0.0), splat(LANES as f64), splat(offset));
        for k in 0..n_sites.div_ceil(LANES) {
            let chunk = |axis: usize| simd.load(&self.by_axis[axis].as_chunks::<LANES>().0[k]);
            let (mut height, mut above) = (offsets, chunk(3) - floors[3]);
            for axis in 0..G::D {
                let x = chunk(axis);
                height = height + x * normals[axis];
                above = above - x * floors[axis];
            }
            let t = above / height;
            let is_less = zero.is_less(height) & t.is_less(least) & simd.mask(left & ALL);
            left >>= LANES;
            least = Real::select(is_less, t, least);
            of_least = Real::select(is_less, labels, of_least);
            labels = labels + four;
        }
        let (each, of_each) = (least.store(), of_least.store());
        let (mut t, mut apex) = (each[0], of_each[0]);
        for lane in 1..LANES {
            apex = if each[lane] < t { of_each[lane] } else { apex };
            t = if each[lane] < t { each[lane] } else { t };
        }
        let plane = [normal[0], normal[1], normal[2], offset];
        (simd.load(&plane) * splat(t) + simd.load(&floor)).store_to(&mut self.floors[n]);
        (t < f64::INFINITY).then_some(apex as u8)
    }
}

/// The hyperplane through the lifted ends of an edge, at these squares of their distances, and through the origin,
/// which is `offset` off the edge along its normal.
#[inline(always)]
fn floor_of_edge(a: &[f64; 3], b: &[f64; 3], [aa, bb]: [f64; 2], offset: f64) -> [f64; 4] {
    let factor = 1.0 / offset;
    [factor * (aa * b[1] - bb * a[1]), factor * (bb * a[0] - aa * b[0]), 0.0, 0.0]
}

/// The hyperplane through the lifted corners of a triangle, at these squares of their distances, and through the
/// origin, which is `offset` off the triangle along its normal.
#[inline(always)]
fn floor_of_triangle(
    a: &[f64; 3],
    b: &[f64; 3],
    c: &[f64; 3],
    [aa, bb, cc]: [f64; 3],
    offset: f64,
) -> [f64; 4] {
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let factor = -1.0 / offset;
    let mut floor = [0.0; 4];
    for axis in 0..3 {
        floor[axis] = factor * (aa * bc[axis] + bb * ca[axis] + cc * ab[axis]);
    }
    floor
}

/// The number of a set of labels, and whether these are an odd permutation of those in ascending order.
#[inline(always)]
fn set_of<G: Geometry>([a, b, c]: [u8; 3]) -> (usize, bool) {
    let ordered = |x: u8, y: u8| (x.min(y), x.max(y), x > y);
    let pairs = |x: u8| usize::from(PAIRS[usize::from(x) % MOST_SITES]);
    let (a, b, first) = ordered(a, b);
    if G::D == 2 {
        return (pairs(b) + usize::from(a), first);
    }
    let (b, c, second) = ordered(b, c);
    let (a, b, third) = ordered(a, b);
    let triples = usize::from(TRIPLES[usize::from(c) % MOST_SITES]);
    (triples + pairs(b) + usize::from(a), first ^ second ^ third)
}

/// Pairs, and triples, of labels below each.
const PAIRS: [u16; MOST_SITES] = below(2);
const TRIPLES: [u16; MOST_SITES] = below(3);

const fn below(of: usize) -> [u16; MOST_SITES] {
    let mut sets = [0; MOST_SITES];
    let mut n = 0;
    while n < MOST_SITES {
        let pairs = n * n.saturating_sub(1) / 2;
        sets[n] = (if of == 2 { pairs } else { pairs * n.saturating_sub(2) / 3 }) as u16;
        n += 1;
    }
    sets
}

/// Whether all certificates of the new cells surely hold.
#[inline(always)]
fn are_certain<S: Simd, G: Geometry>(simd: S, t: &Delaunay<G>, hole: &Hole<G>) -> bool {
    let (filter, sites) = (&t.filter, t.view());
    let last = hole.made.len() - 1;
    let mut first = 0;
    while first <= last {
        // The last one fills the last lanes.
        let at = |lane: usize| &hole.made[last.min(first + lane)];
        let cells = [at(0), at(1), at(2), at(3)];
        first += LANES;
        let mut apexes = [[INFINITE; LANES]; 4];
        for (i, apexes) in apexes[..G::Corners::N].iter_mut().enumerate() {
            for (apex, (_, neighbours)) in apexes.iter_mut().zip(cells) {
                *apex = match new_of(neighbours[i]) {
                    Some(new) => hole.made[new].0[neighbours[i].index()],
                    None => t.complex.apex(neighbours[i]),
                };
            }
        }
        let corners = [&cells[0].0, &cells[1].0, &cells[2].0, &cells[3].0];
        let apexes = [&apexes[0], &apexes[1], &apexes[2], &apexes[3]];
        if G::cells_hold::<_, false>(simd, filter, sites, corners, apexes).all::<G>() != ALL
            && G::cells_hold::<_, true>(simd, filter, sites, corners, apexes).all::<G>() != ALL
        {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests;
