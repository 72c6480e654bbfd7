//! Flips: the smallest exchanges of cells that keep the boundary of their union.
//!
//! ```text
//!        p                 p
//!       /|\               / \
//!      / | \    2-2      / c \
//!     a c|d b' -->      a-----b'     (in the plane the diagonal changes ends)
//!      \ | /             \ d /
//!       \|/               \ /
//! ```
//!
//! In space a 2-3 flip replaces the facet between two cells by the edge between their opposing vertices,
//! and a 3-2 flip the other way round.

use super::{Complex, Corners, Facet};

impl Complex<[u32; 3]> {
    /// Replaces the edge between two finite cells by the one between its opposing vertices; the two cells keep
    /// their indices. With `p` at index `i` of `facet`'s cell `c`, then `b`, then `a`, and `q` across: `c`
    /// becomes `p b q` and its neighbour `q a p`.
    pub(crate) fn flip(&mut self, facet: Facet) {
        let (c, i) = (facet.cell(), facet.index());
        let across = self.cell(c).neighbour(i);
        let (d, j) = (across.cell(), across.index());
        debug_assert!(!self.cell(c).is_ghost() && !self.cell(d).is_ghost());
        let next = |k: usize| (k + 1) % 3;
        let (p, q) = (self.cell(c).corners[i], self.cell(d).corners[j]);
        let (beyond_bq, beyond_ap) = (self.cell(d).neighbour(next(j)), self.cell(c).neighbour(next(i)));
        self.cell_mut(c).corners[next(next(i))] = q;
        self.cell_mut(d).corners[next(next(j))] = p;
        self.glue(Facet::new(c, i), beyond_bq);
        self.glue(Facet::new(d, j), beyond_ap);
        self.glue(Facet::new(c, next(i)), Facet::new(d, next(j)));
    }
}

impl Complex<[u32; 4]> {
    /// Replaces the two cells of a facet by three around the edge between their opposing vertices; returns
    /// them. The caller has reserved a cell and knows that the exchange is geometrically valid.
    pub fn flip_2_3(&mut self, facet: Facet) -> [u32; 3] {
        assert!(self.is_live(facet.cell()) && facet.index() < 4);
        let (c, i) = (facet.cell(), facet.index());
        let across = self.cell(c).neighbour(i);
        let q = self.cell(across.cell()).corners[across.index()];
        let corners = self.cell(c).corners;
        let others = [(i + 1) % 4, (i + 2) % 4, (i + 3) % 4];
        self.exchange([c, across.cell()], others.map(|k| corners.with(k, q)))
    }

    /// Replaces the three cells around the edge from corner `i` to corner `j` of `cell` by two that share the
    /// triangle around it; returns them, the one that keeps corner `i` first. `None`, and no change, if the edge
    /// has not exactly three cells.
    pub fn flip_3_2(&mut self, cell: u32, i: usize, j: usize) -> Option<[u32; 2]> {
        assert!(self.is_live(cell) && i < 4 && j < 4 && i != j);
        let corners = self.cell(cell).corners;
        let (p, q) = (corners[i], corners[j]);
        let k = (0..4).find(|&k| k != i && k != j)?;
        let l = 6 - i - j - k;
        let (beyond_k, beyond_l) = (self.cell(cell).neighbour(k), self.cell(cell).neighbour(l));
        let third = self.cell(beyond_k.cell()).corners[beyond_k.index()];
        if self.cell(beyond_l.cell()).corners[beyond_l.index()] != third || beyond_k.cell() == beyond_l.cell()
        {
            return None;
        }
        let meet = |d: u32| {
            let d = self.cell(d);
            d.corners.as_ref().contains(&p) && d.corners.as_ref().contains(&q)
        };
        debug_assert!(meet(beyond_k.cell()) && meet(beyond_l.cell()));
        let dead = [cell, beyond_k.cell(), beyond_l.cell()];
        Some(self.exchange(dead, [corners.with(j, third), corners.with(i, third)]))
    }

    /// Replaces cells by others with the same boundary and glues them.
    fn exchange<const A: usize, const B: usize>(
        &mut self,
        dead: [u32; A],
        corners: [[u32; 4]; B],
    ) -> [u32; B] {
        let mut rim: Vec<([u32; 3], Facet)> = Vec::with_capacity(2 * (A + B));
        for &c in &dead {
            for i in 0..4 {
                let out = self.cell(c).neighbour(i);
                if !dead.contains(&out.cell()) {
                    rim.push((sorted_facet(&self.cell(c).corners, i), out));
                }
            }
        }
        for &c in &dead {
            self.retire(c);
            self.release(c);
        }
        corners.map(|v| {
            let last = v.iter().position(|&s| s == super::INFINITE).unwrap_or(3);
            let v = v.rotated_to_last(last);
            let c = self.create(v);
            for i in 0..4 {
                let key = sorted_facet(&v, i);
                match rim.iter().position(|(k, _)| *k == key) {
                    Some(at) => self.glue(Facet::new(c, i), rim.swap_remove(at).1),
                    None => rim.push((key, Facet::new(c, i))),
                }
            }
            c
        })
    }
}

fn sorted_facet(corners: &[u32; 4], i: usize) -> [u32; 3] {
    let mut facet = [corners[(i + 1) % 4], corners[(i + 2) % 4], corners[(i + 3) % 4]];
    facet.sort_unstable();
    facet
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of all cells, each rotated to a normal form that keeps its orientation.
    fn cells<C: Corners>(complex: &Complex<C>) -> Vec<C> {
        let mut all: Vec<C> = complex
            .live()
            .map(|c| {
                let mut v = complex.cell(c).corners;
                let mut odd = false;
                for i in 0..C::N {
                    for j in i + 1..C::N {
                        if v[j] < v[i] {
                            v.as_mut().swap(i, j);
                            odd = !odd;
                        }
                    }
                }
                if odd { v.reflected(0) } else { v }
            })
            .collect();
        all.sort_unstable();
        all
    }

    fn is_mutual<C: Corners>(complex: &Complex<C>) -> bool {
        complex.live().all(|c| {
            (0..C::N).all(|i| {
                let n = complex.cell(c).neighbour(i);
                let same = (0..C::N)
                    .filter(|&k| k != i)
                    .all(|k| complex.cell(n.cell()).corners.as_ref().contains(&complex.cell(c).corners[k]));
                same && complex.cell(n.cell()).neighbour(n.index()) == Facet::new(c, i)
            })
        })
    }

    #[test]
    fn a_2_2_flip_done_twice_more_swaps_back() {
        let mut complex = Complex::<[u32; 3]>::default();
        complex.start([1, 2, 3]).unwrap();
        // Split the cell at 4 by hand: three cells around it.
        let outs: Vec<Facet> = (0..3).map(|i| complex.cell(0).neighbour(i)).collect();
        complex.retire(0);
        complex.put(0, [4, 2, 3]);
        let (b, c) = (complex.create([1, 4, 3]), complex.create([1, 2, 4]));
        let new = [0, b, c];
        for i in 0..3 {
            complex.glue(Facet::new(new[i], i), outs[i]);
            for j in 0..i {
                complex.glue(Facet::new(new[i], j), Facet::new(new[j], i));
            }
        }
        assert!(is_mutual(&complex));
        let before = cells(&complex);
        let edge = |complex: &Complex<[u32; 3]>| {
            let c = complex.finite().next().unwrap();
            (0..3)
                .map(|i| Facet::new(c, i))
                .find(|f| !complex.cell(complex.cell(c).neighbour(f.index()).cell()).is_ghost())
                .unwrap()
        };
        let f = edge(&complex);
        complex.flip(f);
        assert!(is_mutual(&complex));
        assert_ne!(cells(&complex), before);
        let i = (f.index() + 1) % 3;
        complex.flip(Facet::new(f.cell(), i));
        assert!(is_mutual(&complex));
        assert_eq!(cells(&complex), before);
    }

    #[test]
    fn a_3_2_flip_undoes_a_2_3_flip() {
        let mut complex = Complex::<[u32; 4]>::default();
        complex.start([1, 2, 3, 4]).unwrap();
        let before = cells(&complex);
        // The facet to a ghost cell is one like any other: combinatorially its opposing vertex is the ghost.
        let new = complex.flip_2_3(Facet::new(0, 1));
        assert!(is_mutual(&complex));
        assert_eq!(complex.live().count(), 6);
        let c = new[0];
        let at = |s: u32| complex.cell(c).corners.as_ref().iter().position(|&x| x == s).unwrap();
        let (i, j) = (at(2), at(super::super::INFINITE));
        assert!(complex.flip_3_2(c, i, j).is_some());
        assert!(is_mutual(&complex));
        assert_eq!(cells(&complex), before);
    }
}
