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

use super::{Cell, Complex, Facet};

impl Complex<[u32; 3]> {
    /// Replaces the edge between two finite cells by the one between its opposing vertices; the two cells
    /// keep their indices. With `p` at index `i` of `facet`'s cell `c`, then `b`, then `a`, and `q` across:
    /// `c` becomes `p b q` and its neighbour `q a p`.
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

/// What a flip in space replaced, for the way back.
#[derive(Clone, Copy, Debug)]
pub struct Undo {
    dead: [(u32, Cell<[u32; 4]>); 3],
    /// The cell that was not there before, of a 2-3 flip.
    made: Option<u32>,
}

impl Undo {
    /// The cells that the flip has changed, made or freed; some are listed more than once.
    pub(crate) fn cells(&self) -> impl Iterator<Item = u32> + use<> {
        self.brought_back().into_iter().chain(self.made)
    }

    /// The cells that [`undo`](Complex::undo) brings back.
    pub(crate) fn brought_back(&self) -> [u32; 3] {
        self.dead.map(|(c, _)| c)
    }
}

impl Complex<[u32; 4]> {
    /// Replaces the two finite cells of a facet by three around the edge between their opposing
    /// vertices, and returns the facets on the boundary of both. The caller has reserved a cell and
    /// knows that the exchange is geometrically valid.
    pub(crate) fn flip_2_3(&mut self, facet: Facet) -> ([Facet; 6], Undo) {
        let c = facet.cell();
        let (old, across) = (*self.cell(c), self.cell(c).neighbour(facet.index()));
        let (d, q) = (across.cell(), self.apex(across));
        let beyond = *self.cell(d);
        debug_assert!(!old.is_ghost() && !beyond.is_ghost());
        let around = AROUND[facet.index()];
        let [p, x, y, z] = [facet.index(), around[0], around[1], around[2]].map(|i| old.corners[i]);
        let e = self.create_blank();
        let [cx, cy, cz] = around.map(|i| old.neighbours[i]);
        let [dx, dy, dz] = [x, y, z].map(|s| beyond.neighbours[beyond.index_of(s)]);
        let code = |cell, i| Facet::new(cell, i).0;
        self.put_whole(c, [p, q, y, z], [dx, cx, code(d, 1), code(e, 1)]);
        self.put_whole(d, [p, x, q, z], [dy, code(c, 2), cy, code(e, 2)]);
        self.put_whole(e, [p, x, y, q], [dz, code(c, 3), code(d, 3), cz]);
        let outer = [(c, 0), (c, 1), (d, 0), (d, 2), (e, 0), (e, 3)].map(|(cell, i)| Facet::new(cell, i));
        (outer, Undo { dead: [(c, old), (d, beyond), (d, beyond)], made: Some(e) })
    }

    /// Replaces the three finite cells around an edge by two that share the triangle around it, and returns
    /// the facets on the boundary of both. The edge is opposite the two corners `k` and that of `facet` in
    /// the cell of `facet`; `None`, and no change, if it has not exactly three cells.
    pub(crate) fn flip_3_2(&mut self, facet: Facet, k: usize) -> Option<([Facet; 6], Undo)> {
        let c = facet.cell();
        let old = *self.cell(c);
        let (across, third) = (old.neighbour(facet.index()), old.neighbour(k));
        let (d, e, q) = (across.cell(), third.cell(), self.apex(across));
        if self.apex(third) != q {
            return None;
        }
        let (beyond, behind) = (*self.cell(d), *self.cell(e));
        debug_assert!(!old.is_ghost() && !beyond.is_ghost() && !behind.is_ghost());
        // The corners of the facet in even order, k first.
        let around = AROUND[facet.index()];
        let turn = around.iter().position(|&i| i == k)?;
        let [l, m] = [around[(turn + 1) % 3], around[(turn + 2) % 3]];
        let [cl, cm] = [l, m].map(|i| old.neighbours[i]);
        let [p, k, l, m] = [facet.index(), k, l, m].map(|i| old.corners[i]);
        let [dl, dm] = [l, m].map(|s| beyond.neighbours[beyond.index_of(s)]);
        let [el, em] = [l, m].map(|s| behind.neighbours[behind.index_of(s)]);
        self.put_whole(c, [p, k, l, q], [dm, em, Facet::new(d, 3).0, cm]);
        self.put_whole(d, [p, k, q, m], [dl, el, cl, Facet::new(c, 2).0]);
        self.release(e);
        let outer = [(c, 0), (c, 1), (c, 3), (d, 0), (d, 1), (d, 2)].map(|(cell, i)| Facet::new(cell, i));
        Some((outer, Undo { dead: [(c, old), (d, beyond), (e, behind)], made: None }))
    }

    /// Takes the latest flip back that has not been.
    pub(crate) fn undo(&mut self, undo: &Undo) {
        match undo.made {
            Some(cell) => self.release(cell),
            None => {
                let freed = self.free.pop();
                debug_assert_eq!(freed, Some(undo.dead[2].0));
            }
        }
        for &(c, cell) in &undo.dead {
            self.put_whole(c, cell.corners, cell.neighbours);
        }
    }

    /// Puts a finite cell, and both sides of all gluings.
    #[inline(always)]
    fn put_whole(&mut self, cell: u32, corners: [u32; 4], neighbours: [u32; 4]) {
        *self.cell_mut(cell) = Cell { alignment: [], corners, neighbours };
        for (i, &code) in neighbours.iter().enumerate() {
            let out = Facet(code);
            self.cell_mut(out.cell()).neighbours[out.index()] = Facet::new(cell, i).0;
        }
    }
}

/// The indices other than each, so that it and they are an even permutation.
const AROUND: [[usize; 3]; 4] = [[1, 2, 3], [2, 0, 3], [0, 1, 3], [2, 1, 0]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::Corners;

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

    /// The corners of facets.
    fn boundary(complex: &Complex<[u32; 4]>, facets: [Facet; 6]) -> Vec<Vec<u32>> {
        let mut corners = facets.map(|f| {
            let mut corners: Vec<u32> = complex.cell(f.cell()).corners.to_vec();
            corners.remove(f.index());
            corners.sort_unstable();
            corners
        });
        corners.sort_unstable();
        corners.to_vec()
    }

    #[test]
    fn flips_in_space_come_back() {
        let mut complex = Complex::<[u32; 4]>::default();
        complex.start([1, 2, 3, 4]).unwrap();
        // Split the cell at 5 by hand: four cells around it.
        let outs: Vec<Facet> = (0..4).map(|i| complex.cell(0).neighbour(i)).collect();
        let corners = complex.cell(0).corners;
        complex.reserve(8).unwrap();
        complex.put(0, corners.with(0, 5));
        let new = [0, 1, 2, 3].map(|i| if i == 0 { 0 } else { complex.create(corners.with(i, 5)) });
        for i in 0..4 {
            complex.glue(Facet::new(new[i], i), outs[i]);
            for j in 0..i {
                complex.glue(Facet::new(new[i], j), Facet::new(new[j], i));
            }
        }
        assert!(is_mutual(&complex));
        let before = cells(&complex);
        for (c, i) in new.into_iter().flat_map(|c| (0..4).map(move |i| (c, i))) {
            let facet = Facet::new(c, i);
            if complex.cell(complex.cell(c).neighbour(i).cell()).is_ghost() {
                continue;
            }
            let [p, q] = [facet, complex.cell(c).neighbour(i)].map(|f| complex.apex(f));
            let (outer, undo) = complex.flip_2_3(facet);
            let made = [outer[0], outer[2], outer[4]].map(Facet::cell);
            assert!(is_mutual(&complex) && complex.n_finite() == 5);
            let boundary_of_flip = boundary(&complex, outer);
            assert!(made.iter().all(|&m| [p, q].iter().all(|s| complex.cell(m).corners.contains(s))));
            // The other way by the inverse flip, from each cell and each of its facets at the edge.
            for &m in &made {
                for apex in complex.cell(m).corners.into_iter().filter(|&s| s != p && s != q) {
                    let at = complex.cell(m).index_of(apex);
                    let k =
                        (0..4).find(|&k| k != at && ![p, q].contains(&complex.cell(m).corners[k])).unwrap();
                    let after = cells(&complex);
                    let (rim, back) = complex.flip_3_2(Facet::new(m, at), k).expect("three cells");
                    assert!(is_mutual(&complex));
                    assert_eq!(boundary(&complex, rim), boundary_of_flip);
                    assert_eq!(cells(&complex), before);
                    complex.undo(&back);
                    assert!(is_mutual(&complex));
                    assert_eq!(cells(&complex), after);
                }
            }
            complex.undo(&undo);
            assert!(is_mutual(&complex));
            assert_eq!(cells(&complex), before);
        }
    }
}
