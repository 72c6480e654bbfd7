//! A tree over the boxes of cells, which finds those that meet a box.
//!
//! Each node halves its cells at the middle one along the longest side of their box. Cost: n log n, and for each
//! search, where boxes are no longer than is usual, log n and what is found.

use crate::error::Result;
use crate::machine::memory;
use crate::predicates::PlaceInSpace;

/// A box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) low: PlaceInSpace,
    pub(crate) high: PlaceInSpace,
}

impl Extent {
    const NOTHING: Self = Extent { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    pub(crate) fn of(places: &[PlaceInSpace]) -> Self {
        let mut all = Self::NOTHING;
        places.iter().for_each(|place| all.enter(&Extent { low: *place, high: *place }));
        all
    }

    pub(super) fn enter(&mut self, other: &Self) {
        for j in 0..3 {
            self.low[j] = self.low[j].min(other.low[j]);
            self.high[j] = self.high[j].max(other.high[j]);
        }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|j| self.low[j] <= other.high[j] && other.low[j] <= self.high[j])
    }

    fn middle(&self, j: usize) -> f64 {
        self.low[j] / 2.0 + self.high[j] / 2.0
    }

    fn longest_side(&self) -> usize {
        let length = |j: &usize| self.high[*j] - self.low[*j];
        (0..3).max_by(|i, j| length(i).total_cmp(&length(j))).unwrap_or(0)
    }
}

/// How many boxes a leaf has at most.
const LEAF: usize = 4;

/// The tree. Node k has 2 k + 1 and 2 k + 2 below it.
#[derive(Debug)]
pub(super) struct Boxes {
    extents: Vec<Extent>,
    order: Vec<u32>,
    nodes: Vec<Extent>,
}

impl Boxes {
    pub(super) fn new(extents: Vec<Extent>) -> Result<Self> {
        let n = extents.len();
        let mut order = Vec::new();
        memory::collect(&mut order, 0..n as u32)?;
        let n_leaves = n.div_ceil(LEAF).next_power_of_two();
        let mut nodes = Vec::new();
        memory::lengthen(&mut nodes, 2 * n_leaves - 1, Extent::NOTHING)?;
        let mut tree = Boxes { extents, order, nodes };
        tree.divide(0, 0, n);
        Ok(tree)
    }

    fn divide(&mut self, node: usize, from: usize, to: usize) {
        let Boxes { extents, order, nodes } = self;
        let mut all = Extent::NOTHING;
        order[from..to].iter().for_each(|&k| all.enter(&extents[k as usize]));
        nodes[node] = all;
        if 2 * node + 2 >= nodes.len() {
            return;
        }
        let (half, j) = ((to - from) / 2, all.longest_side());
        let middle = |k: &u32| extents[*k as usize].middle(j);
        if to > from {
            order[from..to]
                .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        }
        self.divide(2 * node + 1, from, from + half);
        self.divide(2 * node + 2, from + half, to);
    }

    /// Whether any is as it is wanted of those that meet a box.
    pub(super) fn has_one(&self, wanted: &Extent, is: &impl Fn(u32) -> bool) -> bool {
        self.has_one_from(0, 0, self.order.len(), wanted, is)
    }

    fn has_one_from(
        &self,
        node: usize,
        from: usize,
        to: usize,
        wanted: &Extent,
        is: &impl Fn(u32) -> bool,
    ) -> bool {
        if !self.nodes[node].meets(wanted) {
            return false;
        }
        if 2 * node + 2 >= self.nodes.len() {
            return self.order[from..to].iter().any(|&k| self.extents[k as usize].meets(wanted) && is(k));
        }
        let half = (to - from) / 2;
        self.has_one_from(2 * node + 1, from, from + half, wanted, is)
            || self.has_one_from(2 * node + 2, from + half, to, wanted, is)
    }

    /// Tells the numbers of those that meet a box.
    pub(super) fn meeting(&self, wanted: &Extent, tell: &mut impl FnMut(u32) -> Result<()>) -> Result<()> {
        self.search(0, 0, self.order.len(), wanted, tell)
    }

    fn search(
        &self,
        node: usize,
        from: usize,
        to: usize,
        wanted: &Extent,
        tell: &mut impl FnMut(u32) -> Result<()>,
    ) -> Result<()> {
        if !self.nodes[node].meets(wanted) {
            return Ok(());
        }
        if 2 * node + 2 >= self.nodes.len() {
            let here = self.order[from..to].iter();
            return here.copied().filter(|&k| self.extents[k as usize].meets(wanted)).try_for_each(tell);
        }
        let half = (to - from) / 2;
        self.search(2 * node + 1, from, from + half, wanted, tell)?;
        self.search(2 * node + 2, from + half, to, wanted, tell)
    }
}
