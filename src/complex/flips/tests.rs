//! Flips of small complexes, and taking them back.

use super::*;
use crate::complex::INFINITE;
use crate::complex::free::WORD;
use crate::ids::{SiteId, Slot};
use std::collections::BTreeSet;

fn sites<const N: usize>(numbers: [u32; N]) -> [SiteId; N] {
    numbers.map(SiteId::new)
}

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
    let mut complex = Complex::<[SiteId; 3]>::default();
    complex.start(sites([1, 2, 3])).unwrap();
    complex.reserve(2).unwrap();
    let first = Slot::new(0);
    // Split the cell at 4 by hand: three cells around it.
    let outs: Vec<Facet> = (0..3).map(|i| complex.cell(first).neighbour(i)).collect();
    complex.retire(first);
    complex.put(first, sites([4, 2, 3]));
    let (b, c) = (complex.create(sites([1, 4, 3]), first), complex.create(sites([1, 2, 4]), first));
    let new = [first, b, c];
    for i in 0..3 {
        complex.glue(Facet::new(new[i], i), outs[i]);
        for j in 0..i {
            complex.glue(Facet::new(new[i], j), Facet::new(new[j], i));
        }
    }
    assert!(is_mutual(&complex));
    let before = cells(&complex);
    let edge = |complex: &Complex<[SiteId; 3]>| {
        let c = complex.finite().next().unwrap();
        (0..3)
            .map(|i| Facet::new(c, i))
            .find(|f| !complex.cell(complex.cell(c).neighbour(f.index()).cell()).is_ghost())
            .unwrap()
    };
    let f = edge(&complex);
    complex.whole().flip_2_2(f, &mut Vec::new()).expect("all cells are there");
    assert!(is_mutual(&complex));
    assert_ne!(cells(&complex), before);
    let i = (f.index() + 1) % 3;
    complex.whole().flip_2_2(Facet::new(f.cell(), i), &mut Vec::new()).expect("all cells are there");
    assert!(is_mutual(&complex));
    assert_eq!(cells(&complex), before);
}

/// The corners of facets.
fn boundary(complex: &Complex<[SiteId; 4]>, facets: [Facet; 6]) -> Vec<Vec<SiteId>> {
    let mut corners = facets.map(|f| {
        let mut corners: Vec<SiteId> = complex.cell(f.cell()).corners.to_vec();
        corners.remove(f.index());
        corners.sort_unstable();
        corners
    });
    corners.sort_unstable();
    corners.to_vec()
}

#[test]
fn flips_in_space_come_back() {
    let mut complex = Complex::<[SiteId; 4]>::default();
    complex.start(sites([1, 2, 3, 4])).unwrap();
    complex.reserve(3).unwrap();
    let first = Slot::new(0);
    // Split the cell at 5 by hand: four cells around it.
    let outs: Vec<Facet> = (0..4).map(|i| complex.cell(first).neighbour(i)).collect();
    let corners = complex.cell(first).corners;
    complex.put(first, corners.with(0, SiteId::new(5)));
    let new = [0, 1, 2, 3]
        .map(|i| if i == 0 { first } else { complex.create(corners.with(i, SiteId::new(5)), first) });
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
        let mut complex = complex.copied().unwrap();
        let [p, q] = [facet, complex.cell(c).neighbour(i)].map(|f| complex.apex(f));
        let mut undo = Vec::new();
        assert_eq!(complex.whole().flip_2_3(facet, &mut undo), Err(Obstacle::Full));
        assert!(undo.is_empty());
        assert_eq!(cells(&complex), before);
        complex.create_free(2).unwrap();
        let made = complex.whole().flip_2_3(facet, &mut undo).expect("all cells are there");
        assert!(is_mutual(&complex) && complex.n_finite() == 5);
        let boundary_of_flip = boundary(&complex, outer_of_three(made));
        assert!(made.iter().all(|&m| [p, q].iter().all(|s| complex.cell(m).corners.contains(s))));
        // The other way by the inverse flip, from each cell and each of its facets at the edge.
        for &m in &made {
            for apex in complex.cell(m).corners.into_iter().filter(|&s| s != p && s != q) {
                let at = complex.cell(m).index_of(apex);
                let k = (0..4).find(|&k| k != at && ![p, q].contains(&complex.cell(m).corners[k])).unwrap();
                let after = cells(&complex);
                let free: BTreeSet<_> = complex.free_cells().collect();
                let mut back = Vec::new();
                let two = complex.whole().flip_3_2(Facet::new(m, at), k, &mut back).expect("three cells");
                assert!(is_mutual(&complex));
                assert_eq!(boundary(&complex, outer_of_two(two)), boundary_of_flip);
                assert_eq!(cells(&complex), before);
                complex.undo_rows(back.into_iter().rev());
                assert_eq!(complex.free_cells().collect::<BTreeSet<_>>(), free);
                assert!(is_mutual(&complex));
                assert_eq!(cells(&complex), after);
            }
        }
        complex.undo_rows(undo.into_iter().rev());
        assert!(is_mutual(&complex));
        assert_eq!((cells(&complex), complex.n_free()), (before.clone(), 2));
    }
}

/// A cavity is filled with more cells than it had, as by a flip, with free cells that there are or that come; and
/// emptied again.
#[test]
fn cavities_get_more_cells_than_they_had() {
    let (mut flipped, facet) = two_tetrahedra();
    flipped.create_free(2).unwrap();
    let made = flipped.whole().flip_2_3(facet, &mut Vec::new()).expect("all cells are there");
    let new = made.map(|m| {
        let cell = flipped.cell(m);
        let (mut neighbours, mut inner) = (cell.neighbours, 0);
        for (i, to) in neighbours.iter_mut().enumerate() {
            if let Some(k) = made.iter().position(|&m| m == to.cell()) {
                *to = Facet::new(Slot::at(k), to.index());
                inner |= 1 << i;
            }
        }
        replacing::NewCell { corners: cell.corners, neighbours, inner }
    });
    for n_free in [0, 1, 4] {
        let (mut complex, facet) = two_tetrahedra();
        complex.create_free(n_free).unwrap();
        let before = cells(&complex);
        let mut slots = vec![facet.cell(), complex.cell(facet.cell()).neighbour(facet.index()).cell()];
        let mut journal = Vec::new();
        complex.prepare_replacing(3, &mut slots, &mut journal).unwrap();
        assert_eq!(slots.len(), 3);
        let n_left = complex.free.len();
        complex.replace(2, &new, &slots, &mut journal);
        assert!(is_mutual(&complex));
        assert_eq!((cells(&complex), complex.n_finite()), (cells(&flipped), 3));
        complex.undo_rows(journal.into_iter().rev());
        assert!(is_mutual(&complex));
        assert_eq!((cells(&complex), complex.free.len()), (before, n_left + 1));
    }
}

/// Two tetrahedra that share a facet, and the ghosts around, which come first.
fn two_tetrahedra() -> (Complex<[SiteId; 4]>, Facet) {
    let mut complex = Complex::<[SiteId; 4]>::default();
    complex.start(sites([1, 2, 3, 4])).unwrap();
    complex.reserve(3).unwrap();
    // A ghost becomes a finite cell with a new corner, by hand, with a ghost on each of its other facets.
    let ghost = Slot::new(1);
    let mut finite = complex.cell(ghost).corners;
    finite[3] = SiteId::new(5);
    let ridges: Vec<Facet> = (0..3).map(|i| complex.cell(ghost).neighbour(i)).collect();
    complex.retire(ghost);
    complex.put(ghost, finite);
    let new = [0, 1, 2].map(|i| {
        let mut corners = finite.with(i, INFINITE);
        corners.swap(i, 3);
        complex.create(corners, ghost)
    });
    for (i, &g) in new.iter().enumerate() {
        complex.glue(Facet::new(g, 3), Facet::new(ghost, i));
        complex.glue(Facet::new(g, i), ridges[i]);
        for (j, &h) in new.iter().enumerate().take(i) {
            complex.glue(Facet::new(g, j), Facet::new(h, i));
        }
    }
    assert!(is_mutual(&complex));
    complex.sort(6, usize::MAX).unwrap();
    assert!(is_mutual(&complex));
    let shared = complex
        .finite()
        .flat_map(|c| (0..4).map(move |i| Facet::new(c, i)))
        .find(|facet| !complex.cell(complex.cell(facet.cell()).neighbour(facet.index()).cell()).is_ghost())
        .expect("a facet between finite cells");
    (complex, shared)
}

/// A copy of a complex, each cell in the first slot of a word, with this number of free ones after the last.
fn spread(complex: &Complex<[SiteId; 4]>, n_free: usize) -> Complex<[SiteId; 4]> {
    let n = complex.n_slots();
    let moved = |c: Slot| Slot::at(WORD * c.index());
    let mut spread = complex.copied().unwrap();
    spread.create_free(WORD * (n - 1) + 1 + n_free - n).unwrap();
    spread.free.clear();
    for c in (0..n).rev().map(Slot::at) {
        let cell = complex.cell(c);
        *spread.cell_mut(c) = Cell::free();
        let neighbours = cell.neighbours.map(|out| Facet::new(moved(out.cell()), out.index()));
        *spread.cell_mut(moved(c)) = Cell { neighbours, ..*cell };
    }
    let last = moved(Slot::at(n - 1)).index();
    Slot::range(last + 1..last + 1 + n_free).for_each(|c| spread.free.set(c, true));
    spread
}

#[test]
fn flips_need_all_their_cells() {
    let (complex, _) = two_tetrahedra();
    let before = cells(&complex);
    let n = complex.n_slots();
    for n_free in [0, 3] {
        let mut complex = spread(&complex, n_free);
        assert!(is_mutual(&complex) && cells(&complex) == before);
        let facet = complex
            .finite()
            .flat_map(|c| (0..4).map(move |i| Facet::new(c, i)))
            .find(|f| !complex.cell(complex.cell(f.cell()).neighbour(f.index()).cell()).is_ghost())
            .expect("a facet between finite cells");
        // The six ghosts and two cells are all concerned.
        for start in (1..n).map(|c| Slot::at(WORD * c)) {
            let mut tried = [(0, None), (1, None)];
            complex
                .divided(&[Slot::new(0), start], &mut tried, 2, |range, (k, tried)| {
                    assert_eq!(*range.free.n, *k * n_free);
                    *tried = range.flip_2_3(facet, &mut Vec::new()).err();
                })
                .unwrap();
            assert_eq!(tried.map(|(_, tried)| tried), [Some(Obstacle::OtherRange); 2]);
            assert_eq!((cells(&complex), complex.n_free()), (before.clone(), n_free));
        }
        // The first range has all cells.
        let mut tried = [None];
        complex
            .divided(&[Slot::new(0)], &mut tried, 1, |range, tried| {
                *tried = range.flip_2_3(facet, &mut Vec::new()).err()
            })
            .unwrap();
        assert_eq!(tried[0], (n_free == 0).then_some(Obstacle::Full));
        assert!(is_mutual(&complex));
        let n_more = usize::from(n_free > 0);
        assert_eq!((complex.finite().count() - 2, n_free - complex.n_free()), (n_more, n_more));
    }
}
