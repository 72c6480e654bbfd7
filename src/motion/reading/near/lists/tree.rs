//! A tree of boxes over places.
//!
//! A box is the least one that has its places, and is halved across its longest side until few places are left, or all are at
//! one. So a side of a box that is parted is at least half as long as that of the box it was made from, or nothing is
//! there, and few boxes that are longer than a ball meet it. Halving ends, however unevenly places are spread: a coordinate can
//! be told from another after as many halvings as numbers have bits.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// A box of at most so many places is not parted.
const MOST_IN_LEAF: usize = 12;

/// A vertex and its place, with the square of the radius of its list; one without a list has [`NO_LIST`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedVertex<P> {
    pub(crate) place: P,
    pub(crate) squared_radius: f64,
    pub(crate) vertex: VertexId,
}

/// What a vertex without a list has for the square of its radius.
pub(crate) const NO_LIST: f64 = -1.0;

/// A box of the tree; its halves, if it has any, come after it, and the first at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<P> {
    pub(super) low: P,
    pub(super) high: P,
    /// The greatest square of a radius.
    pub(super) greatest: f64,
    /// The places in it, in the order of the tree.
    pub(super) first: u32,
    pub(super) end: u32,
    /// The first box behind all those that are parts of this one.
    pub(super) next: u32,
}

/// Places in boxes.
#[derive(Debug)]
pub(crate) struct BoxTree<G: Moving> {
    pub(super) placed: Vec<PlacedVertex<G::Point>>,
    pub(super) nodes: Vec<Node<G::Point>>,
    /// The boxes that have no halves, in the order of their places.
    pub(super) leaves: Vec<u32>,
}

impl<G: Moving> BoxTree<G> {
    pub(crate) fn new(mut placed: Vec<PlacedVertex<G::Point>>) -> Result<Self> {
        let (mut nodes, mut leaves, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
        memory::push(&mut waiting, (0, placed.len()))?;
        while let Some((first, end)) = waiting.pop().filter(|_| !placed.is_empty()) {
            let node = bounds::<G>(&placed[first..end], first);
            let middle =
                (end - first > MOST_IN_LEAF).then(|| halve::<G>(&mut placed[first..end], &node)).flatten();
            if let Some(n_below) = middle {
                memory::push(&mut waiting, (first + n_below, end))?;
                memory::push(&mut waiting, (first, first + n_below))?;
            } else {
                memory::push(&mut leaves, nodes.len() as u32)?;
            }
            memory::push(&mut nodes, node)?;
        }
        for k in (0..nodes.len()).rev() {
            let behind_first = nodes.get(k + 1).map_or(k + 1, |first: &Node<G::Point>| first.next as usize);
            let has_halves = nodes.get(k + 1).is_some_and(|first| first.first == nodes[k].first);
            nodes[k].next = if has_halves { nodes[behind_first].next } else { k as u32 + 1 };
        }
        Ok(BoxTree { placed, nodes, leaves })
    }

    /// Visits the boxes without halves of which the box, and each that it is a part of, meets a condition.
    pub(super) fn for_leaves(
        &self,
        mut is_wanted: impl FnMut(&Node<G::Point>) -> bool,
        mut visit: impl FnMut(&Node<G::Point>) -> Result<()>,
    ) -> Result<()> {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if !is_wanted(node) {
                at = node.next as usize;
                continue;
            }
            at += 1;
            if node.next as usize == at {
                visit(node)?;
            }
        }
        Ok(())
    }
}

/// The box of some places.
fn bounds<G: Moving>(placed: &[PlacedVertex<G::Point>], first: usize) -> Node<G::Point> {
    let (mut low, mut high, mut greatest) = (placed[0].place, placed[0].place, NO_LIST);
    for p in placed {
        for axis in 0..G::D {
            low[axis] = low[axis].min(p.place[axis]);
            high[axis] = high[axis].max(p.place[axis]);
        }
        greatest = greatest.max(p.squared_radius);
    }
    Node { low, high, greatest, first: first as u32, end: (first + placed.len()) as u32, next: 0 }
}

/// Brings the places in the lower half of their box to the front, and counts these; `None` if all are at one place.
fn halve<G: Moving>(placed: &mut [PlacedVertex<G::Point>], node: &Node<G::Point>) -> Option<usize> {
    let length = |axis: usize| node.high[axis] - node.low[axis];
    let axis = (1..G::D).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest });
    let (low, high) = (node.low[axis], node.high[axis]);
    if low == high {
        return None;
    }
    // Of neighbouring numbers the middle is rounded to one of the two.
    let middle = Some(f64::midpoint(low, high)).filter(|&middle| middle < high).unwrap_or(low);
    let mut n_below = 0;
    for k in 0..placed.len() {
        let is_below = placed[k].place[axis] <= middle;
        placed.swap(k, n_below);
        n_below += usize::from(is_below);
    }
    Some(n_below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Plane, Space};

    fn check<G: Moving>(places: &[G::Point]) {
        let placed = places.iter().enumerate().map(|(k, &place)| PlacedVertex {
            place,
            squared_radius: k as f64,
            vertex: VertexId::at(k),
        });
        let tree = BoxTree::<G>::new(placed.collect()).expect("memory");
        let mut seen = vec![false; places.len()];
        let mut next = 0;
        for &leaf in &tree.leaves {
            let node = &tree.nodes[leaf as usize];
            assert_eq!(node.first, next);
            next = node.end;
            let those = &tree.placed[node.first as usize..node.end as usize];
            assert!(those.len() <= MOST_IN_LEAF || node.low.as_ref() == node.high.as_ref());
            for p in those {
                assert!(
                    (0..G::D).all(|axis| node.low[axis] <= p.place[axis] && p.place[axis] <= node.high[axis])
                );
                assert!(!std::mem::replace(&mut seen[p.vertex.index()], true));
                assert_eq!(p.place.as_ref(), places[p.vertex.index()].as_ref());
            }
        }
        assert!(seen.iter().all(|&is_there| is_there) && next as usize == places.len());
        // Each box ends the visit of its parts where the next one begins.
        for node in &tree.nodes {
            let behind =
                tree.nodes.get(node.next as usize).map_or(places.len() as u32, |behind| behind.first);
            assert_eq!(node.end, behind);
        }
    }

    #[test]
    fn places_are_in_boxes() {
        check::<Plane>(&[]);
        check::<Plane>(&[[1.0, 2.0]]);
        check::<Plane>(&[[1.0, 2.0]; 100]);
        let powers: Vec<[f64; 2]> = (0..900).map(|k| [2f64.powi(-k), -(2f64.powi(-k / 2))]).collect();
        check::<Plane>(&powers);
        let beside: Vec<[f64; 3]> =
            (0..90).map(|k| [1.0, f64::from_bits(1f64.to_bits() + k % 2), 3.0]).collect();
        check::<Space>(&beside);
        let grid: Vec<[f64; 3]> =
            (0..1000).map(|k| [k % 10, k / 10 % 10, k / 100].map(|x: i32| f64::from(x * 7 % 10))).collect();
        check::<Space>(&grid);
    }
}
