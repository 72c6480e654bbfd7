//! Landmarks: sites, a sample of all, near one of which a walk begins if nothing else is known of its goal (*jump and
//! walk*: Mücke, Saias, Zhu, 10.1016/S0925-7721(98)00035-2).
//!
//! They are the leaves of a tree of half-spaces, some six sites to a leaf wherever these are dense, so that a walk is
//! as short in a cluster as elsewhere. All of it is hints: half-spaces are never checked, and a leaf may hold any site.
//! So points may move, come and go without a word to the tree. A walk that was long leaves a site near its goal behind,
//! for the next one that comes to this leaf. When walks together have been longer than that explains, there is a new
//! tree.
//!
//! Invariant: a tree is used only to choose where to begin; what a walk finds does not depend on it.
//!
//! Cost: none before walks have crossed a cell for every [`SITES_PER_STEP`] sites. Then some 15 ns a site to make the
//! tree and 2 bytes a site to keep it. A goal costs one path down, in an array that stays in a cache near the
//! processor, and a walk through a few cells, however many there are. (Not so in space from the surface of a cluster:
//! there half of the cells around a site reach other clusters, and a walk that begins in one of them first goes around
//! the bundle.)

use std::sync::RwLock;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering::Relaxed};

use super::site::Sites;
use super::{Delaunay, Geometry, Site};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::squared_distance;

/// A tree is made once walks have crossed one cell for this number of sites, beyond [`LONG_WALK`] each: that takes
/// about as long as making it.
const SITES_PER_STEP: usize = 8;

/// After more steps a site near the goal becomes the landmark.
const SHORT_WALK: u64 = 12;

/// More steps than a walk from a good landmark has, but for one in a thousand.
const LONG_WALK: u64 = 40;

/// A goal no farther than this number of edges is reached in a few steps.
const SHORT_IN_EDGES: f64 = 2.0;

/// A goal is reached in a few steps only if it is no farther than this number of shortest edges of the cell, too: where
/// cells are long and thin, any number of them may be in between.
const SHORT_IN_SHORTEST_EDGES: f64 = 16.0;

/// A place more than this number of edges from a site is away from it: some fifty sites are nearer in the plane.
const AWAY_IN_EDGES: f64 = 4.0;

/// Fewer sites need no landmarks.
const MIN_SITES: usize = 256;

/// Where walks begin.
#[derive(Debug, Default)]
pub(super) struct Landmarks {
    /// `None` before the first is made.
    tree: RwLock<Option<Tree>>,
    /// Cells crossed since the tree was made, or tried to.
    steps: AtomicUsize,
}

/// A complete binary tree: below node `k` are `2 k` and `2 k + 1`, and the root is 1.
#[derive(Debug)]
struct Tree {
    /// Of each inner node, what is between the halves of the sites below it, with the axis in the lowest two bits.
    splits: Vec<f64>,
    /// A site of each leaf.
    leaves: Vec<AtomicU32>,
}

fn is_in_cells<G: Geometry>(site: &Site<G>) -> bool {
    site.is_live() && site.cell != Slot::NONE
}

/// A coordinate with an axis in its lowest two bits.
fn split(x: f64, axis: usize) -> f64 {
    f64::from_bits(x.to_bits() & !3 | axis as u64)
}

impl Tree {
    /// A tree of about one site in six.
    fn new<G: Geometry>(sites: &[Site<G>]) -> Result<Option<Self>> {
        let n = sites.len();
        if n < MIN_SITES {
            return Ok(None);
        }
        let depth = (n / 4).ilog2();
        let n_leaves = 1 << depth;
        // Sites are stored in the order of their places along a curve, so every k-th is a sample as dense as they are.
        let mut items = Vec::new();
        memory::reserve_exact(&mut items, n_leaves)?;
        let picked = (0..n_leaves).map(|k| 1 + (k as u64 * (n - 1) as u64 / n_leaves as u64) as usize);
        items.extend(picked.filter(|&s| is_in_cells(&sites[s])).map(|s| (sites[s].point, SiteId::at(s))));
        let Some(&last) = items.last() else {
            return Ok(None);
        };
        items.resize(n_leaves, last);
        let mut splits = Vec::new();
        memory::reserve_exact(&mut splits, n_leaves)?;
        splits.push(0.0);
        // Where the items of each node of a level begin, and where the last ones end.
        let mut bounds = Vec::new();
        memory::collect(&mut bounds, [0, n_leaves].into_iter())?;
        for _ in 0..depth {
            let mut below = Vec::new();
            memory::reserve_exact(&mut below, 2 * bounds.len() - 1)?;
            below.push(0);
            for part in bounds.windows(2) {
                let (n_first, at) = halve::<G>(&mut items[part[0]..part[1]]);
                splits.push(at);
                below.extend([part[0] + n_first, part[1]]);
            }
            bounds = below;
        }
        // A leaf without items has one of those beside it.
        let mut leaves = Vec::new();
        let item = |&k: &usize| AtomicU32::new(items[k.min(n_leaves - 1)].1.get());
        memory::collect(&mut leaves, bounds[..n_leaves].iter().map(item))?;
        Ok(Some(Tree { splits, leaves }))
    }

    /// The leaf of a place.
    #[inline(always)]
    fn leaf<G: Geometry>(&self, q: &G::Point) -> usize {
        let n = self.splits.len();
        let mut node = 1;
        while node < n {
            let split = self.splits[node];
            // The remainder spares a check of the bounds.
            let axis = (split.to_bits() & 3) as usize % G::D;
            node = 2 * node + usize::from(q[axis] >= split);
        }
        node - n
    }
}

/// Parts items along the axis along which they extend farthest, and never two with one coordinate there: how many are
/// the first ones, about half, and the split, in the middle between both, so that a goal goes to the nearer one.
fn halve<G: Geometry>(items: &mut [(G::Point, SiteId)]) -> (usize, f64) {
    let (n, middle) = (items.len(), items.len() / 2);
    if n == 0 {
        return (0, 0.0);
    }
    let axis = widest::<G>(items);
    let coordinate = |item: &(G::Point, SiteId)| item.0[axis];
    let upper = coordinate(items.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis])).1);
    let lower = items[..middle].iter().map(coordinate).fold(f64::NEG_INFINITY, f64::max);
    if lower < upper && middle > 0 {
        return (middle, split(f64::midpoint(lower, upper), axis));
    }
    let n_less = partition(&mut items[..middle], |item| coordinate(item) < upper);
    let n_up_to = middle + partition(&mut items[middle..], |item| coordinate(item) <= upper);
    let is_nearer = middle - n_less <= n_up_to - middle;
    let n_first = if n_up_to == n || n_less > 0 && is_nearer { n_less } else { n_up_to };
    let (first, second) = items.split_at(n_first);
    let last = first.iter().map(coordinate).reduce(f64::max).unwrap_or(upper);
    let next = second.iter().map(coordinate).reduce(f64::min).unwrap_or(upper);
    (n_first, split(f64::midpoint(last, next), axis))
}

/// Brings the items of which this holds to the front; how many there are.
fn partition<T>(items: &mut [T], is_first: impl Fn(&T) -> bool) -> usize {
    let mut n = 0;
    for k in 0..items.len() {
        if is_first(&items[k]) {
            items.swap(n, k);
            n += 1;
        }
    }
    n
}

/// The axis along which these places extend farthest.
fn widest<G: Geometry>(items: &[(G::Point, SiteId)]) -> usize {
    let (mut lower, mut upper) = (items[0].0, items[0].0);
    for (p, _) in items {
        for axis in 0..G::D {
            lower[axis] = lower[axis].min(p[axis]);
            upper[axis] = upper[axis].max(p[axis]);
        }
    }
    let extent = |&axis: &usize| upper[axis] - lower[axis];
    (0..G::D).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or_default()
}

/// Of the corners of a cell the one that is nearest to `q`: from another one, where the cell is long, walks to goals
/// beside `q` would not be short.
fn nearest<G: Geometry>(sites: Sites<'_, G>, corners: &[SiteId], q: &G::Point) -> SiteId {
    let distance = |&s: &SiteId| squared_distance(sites.point(s), q);
    corners.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(SiteId::NONE)
}

impl Landmarks {
    pub(super) fn memory_bytes(&self) -> usize {
        let tree = self.tree.read().ok();
        let tree = tree.as_ref().and_then(|tree| tree.as_ref());
        tree.map_or(0, |tree| memory::bytes_of(&tree.splits) + memory::bytes_of(&tree.leaves))
    }

    /// A site that was near `q` once; [`SiteId::NONE`] if no tree has been made, or one is being made.
    #[inline(always)]
    fn near<G: Geometry>(&self, q: &G::Point) -> SiteId {
        let Ok(tree) = self.tree.try_read() else { return SiteId::NONE };
        tree.as_ref().map_or(SiteId::NONE, |tree| SiteId::new(tree.leaves[tree.leaf::<G>(q)].load(Relaxed)))
    }

    /// The site `s` is the landmark near `q` from now on.
    fn replace<G: Geometry>(&self, q: &G::Point, s: SiteId) {
        if let Ok(tree) = self.tree.try_read()
            && let Some(tree) = tree.as_ref()
        {
            tree.leaves[tree.leaf::<G>(q)].store(s.get(), Relaxed);
        }
    }

    /// Enters a long walk of `steps` steps to `q`, near the site `s`.
    fn follow_long<G: Geometry>(&self, sites: &[Site<G>], q: &G::Point, s: SiteId, steps: u64) {
        self.replace::<G>(q, s);
        let beyond = steps.saturating_sub(LONG_WALK) as usize;
        let all = self.steps.fetch_add(beyond, Relaxed) + beyond;
        if beyond > 0
            && all * SITES_PER_STEP >= sites.len()
            && let Ok(mut tree) = self.tree.try_write()
        {
            self.steps.store(0, Relaxed);
            // Without the memory for it, walks go on as they did.
            if let Ok(made) = Tree::new(sites) {
                *tree = made;
            }
        }
    }
}

impl<G: Geometry> Delaunay<G> {
    /// A cell from which a walk to `q` is short: `near`, or one at a landmark if that is nearer.
    #[inline(always)]
    pub(super) fn cell_towards(&self, q: &G::Point, near: Slot) -> Slot {
        // The last corner of a ghost cell is the ghost vertex.
        let [p, other] = [0, 1].map(|i| self.place(self.complex.cell(near).corners[i]));
        let to_near = squared_distance(p, q);
        // Then the walk is shorter than the way down the tree.
        if to_near <= SHORT_IN_EDGES * SHORT_IN_EDGES * squared_distance(p, other)
            && to_near <= SHORT_IN_SHORTEST_EDGES * SHORT_IN_SHORTEST_EDGES * self.shortest_edge(near)
        {
            return near;
        }
        let s = self.landmarks.near::<G>(q);
        match self.sites.get(s.index()) {
            Some(site) if is_in_cells(site) && squared_distance(&site.point, q) < to_near => site.cell,
            _ => near,
        }
    }

    /// A site in cells that is near `q`, if one is known that was.
    pub(crate) fn landmark(&self, q: &G::Point) -> Option<SiteId> {
        let s = self.landmarks.near::<G>(q);
        self.sites.get(s.index()).filter(|site| is_in_cells(site)).map(|_| s)
    }

    /// The square of the shortest edge of a cell, or of the facet of a ghost cell, at its first corner or its second
    /// one. In space there is another one, but a cell that is much longer than wide has a short edge among these.
    #[inline(always)]
    fn shortest_edge(&self, cell: Slot) -> f64 {
        let corners = &self.complex.cell(cell).corners;
        let n = G::D + usize::from(!self.complex.cell(cell).is_ghost());
        let edge = |i: usize, j: usize| squared_distance(self.place(corners[i]), self.place(corners[j]));
        let shortest = (1..n).map(|i| edge(0, i)).fold(f64::INFINITY, f64::min);
        if n > 2 { shortest.min(edge(1, 2)) } else { shortest }
    }

    /// The next walk to `q` begins at a site, which may have gone, if that is nearer than `near`, where it would begin.
    #[inline(always)]
    pub(super) fn begin_at_nearer(&mut self, q: &G::Point, near: &G::Point, s: SiteId) {
        if let Some(site) = self.sites.get(s.index()).filter(|site| is_in_cells(site))
            && squared_distance(&site.point, q) < squared_distance(near, q)
        {
            self.recent = site.cell;
        }
    }

    /// Whether a site is in cells, and a place so far from it that others are between them.
    pub(crate) fn is_away(&self, s: SiteId, q: &G::Point) -> bool {
        let site = self.site(s);
        if !is_in_cells(site) || self.complex.is_free(site.cell) {
            return false;
        }
        // The last corner of a ghost cell is the ghost vertex.
        let [p, other] = [0, 1].map(|i| self.place(self.complex.cell(site.cell).corners[i]));
        squared_distance(&site.point, q) > AWAY_IN_EDGES * AWAY_IN_EDGES * squared_distance(p, other)
    }

    /// Enters a walk to `q` that has ended in `cell` after `steps` steps.
    #[inline(always)]
    pub(super) fn note_walk(&self, q: &G::Point, cell: Slot, steps: u64) {
        if steps > SHORT_WALK {
            self.note_long_walk(q, cell, steps);
        }
    }

    #[cold]
    #[inline(never)]
    fn note_long_walk(&self, q: &G::Point, cell: Slot, steps: u64) {
        let cell = self.complex.cell(cell);
        // The last corner of a ghost cell is the ghost vertex.
        let n = G::D + usize::from(!cell.is_ghost());
        let s = nearest::<G>(self.view(), &cell.corners.as_ref()[..n], q);
        self.landmarks.follow_long(&self.sites, q, s, steps);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Plane, Shortcut, Space};
    use crate::machine::threads::Threads;
    use crate::random::Rng;

    /// How places lie.
    #[derive(Clone, Copy, Debug)]
    enum Kind {
        Even,
        Clustered,
        /// On two parallel lines: all cells are long.
        OnLines,
    }

    fn place<G: Geometry>(rng: &mut Rng, kind: Kind) -> G::Point {
        let mut p = G::Point::default();
        let centre = rng.within(0, 9) as f64;
        for axis in 0..G::D {
            p[axis] = match kind {
                Kind::Even => rng.unit(),
                Kind::Clustered => (centre * (axis + 3) as f64) % 10.0 + 1e-4 * rng.unit(),
                Kind::OnLines if axis == 0 => rng.unit(),
                Kind::OnLines => rng.within(0, 1) as f64,
            };
        }
        p
    }

    /// Cells crossed, in the mean, by walks to random places.
    fn mean_steps<G: Geometry>(t: &Delaunay<G>, rng: &mut Rng, kind: Kind) -> f64 {
        let n = 500;
        let mut steps = 0;
        for _ in 0..n {
            let q = place::<G>(rng, kind);
            let start = t.cell_towards(&q, t.recent);
            t.walk(&G::filter(&t.lower, &t.upper), &q, start, &mut steps);
        }
        steps as f64 / f64::from(n)
    }

    /// Walks become short by themselves.
    fn walks_become_short<G: Geometry>(kinds: &[Kind]) {
        for &kind in kinds {
            let rng = &mut Rng::new(1);
            let mut t = Delaunay::<G>::on(Threads::ONE).expect("room");
            let n = 20_000;
            let places = std::iter::repeat_with(|| place::<G>(rng, kind)).take(n).collect::<Vec<_>>();
            t.add_sites(&places).expect("room");
            t.rebuild(&mut |_| true).expect("room");
            let without = mean_steps(&t, rng, kind);
            for _ in 0..2000 {
                t.locate(&place::<G>(rng, kind), Slot::NONE);
            }
            let with = mean_steps(&t, rng, kind);
            assert!(without > 20.0 && with < 12.0, "{kind:?}: {without} steps, then {with}");
        }
    }

    /// Walks of sites that are relocated anywhere become short by themselves.
    fn relocations_become_short<G: Geometry>() {
        let rng = &mut Rng::new(2);
        let n = 5_000;
        let places = std::iter::repeat_with(|| place::<G>(rng, Kind::Even)).take(n).collect::<Vec<_>>();
        let mut t = Delaunay::<G>::on(Threads::ONE).expect("room");
        t.add_sites(&places).expect("room");
        t.rebuild(&mut |_| true).expect("room");
        let mut mean_steps = |n: usize| {
            let before = t.cavity.steps;
            for s in SiteId::range(1..n + 1) {
                let (q, id) = (place::<G>(rng, Kind::Even), t.site(s).id);
                t.relocate_site(s, &q, id, Shortcut::Flips).expect("room");
            }
            (t.cavity.steps - before) as f64 / n as f64
        };
        mean_steps(1000);
        let steps = mean_steps(1000);
        assert!(steps < 12.0, "{steps} steps");
    }

    #[test]
    fn relocations_become_short_in_both_dimensions() {
        relocations_become_short::<Plane>();
        relocations_become_short::<Space>();
    }

    #[test]
    fn walks_become_short_in_both_dimensions() {
        walks_become_short::<Plane>(&[Kind::Even, Kind::Clustered, Kind::OnLines]);
        walks_become_short::<Space>(&[Kind::Even]);
    }
}
