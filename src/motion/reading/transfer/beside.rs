//! Which of the cells that were is beside which, and the gradients of their means.
//!
//! Facets tell: each of a cell that is gone is that of another one, or of a cell that has come, across which is one
//! that lives. A gradient is the least-squares fit to the means of these, by the inverse squares of their distances,
//! and where they do not span all directions, to those beside them as well; where these do not either, there is none.
//! A linear function has its own gradient, wherever centroids are.

use super::overlap::{centroid, dot, minus, plus};
use super::{Arrived, BeyondFacet, Gone};
use crate::error::Result;
use crate::machine::memory;
use crate::predicates::PlaceInSpace;

/// A cell that is, as one that was sees it.
#[derive(Clone, Copy, Debug)]
struct Neighbour {
    /// From centroid to centroid.
    way: PlaceInSpace,
    /// Where its values are.
    before: u32,
    /// Which of those that are gone it is, [`LIVES`] for none.
    gone: u32,
}

/// In place of the number of a cell that is gone.
const LIVES: u32 = u32::MAX;

/// Determinants of sums of directions below this tell nothing of one of them.
const LEAST: f64 = 1e-6;

/// The neighbours of each cell that is gone.
pub(super) struct Besides {
    /// Where those of each begin.
    first: Vec<u32>,
    list: Vec<Neighbour>,
}

/// A facet as the cell on one side of it sees it.
#[derive(Clone, Copy)]
struct FacetBeside {
    name: u128,
    /// From a corner of the facet, the same for both sides, to the centroid of the cell.
    way: PlaceInSpace,
    before: u32,
    gone: u32,
}

impl Besides {
    pub(super) fn of<const D: usize>(gone: &[Gone], arrived: &[Arrived]) -> Result<Self> {
        let mut sides = Vec::new();
        memory::reserve_exact(&mut sides, (D + 1) * (gone.len() + arrived.len()))?;
        for (k, cell) in (0..).zip(gone) {
            let centre = plus(&cell.corners[0], &centroid::<D>(&cell.corners));
            for facet in &cell.facets[..=D] {
                let way = minus(&centre, &cell.corners[facet.anchor as usize]);
                sides.push(FacetBeside { name: facet.name, way, before: cell.before, gone: k });
            }
        }
        for cell in arrived {
            for (facet, beyond) in cell.facets.iter().zip(&cell.beyond).take(D + 1) {
                if let BeyondFacet::Living { before, centre } = beyond {
                    let way = minus(centre, &cell.corners[facet.anchor as usize]);
                    sides.push(FacetBeside { name: facet.name, way, before: *before, gone: LIVES });
                }
            }
        }
        sides.sort_unstable_by_key(|side| (side.name, side.gone));
        let mut pairs = Vec::new();
        memory::reserve_exact(&mut pairs, sides.len())?;
        // Where vertices coincide, or a cell is its own neighbour, more than two may have a facet's name; two of them
        // will do.
        let mut at = 0;
        while at + 1 < sides.len() {
            let (a, b) = (sides[at], sides[at + 1]);
            if a.name != b.name {
                at += 1;
                continue;
            }
            for (here, there) in [(a, b), (b, a)] {
                if here.gone != LIVES {
                    let way = minus(&there.way, &here.way);
                    pairs.push((here.gone, Neighbour { way, before: there.before, gone: there.gone }));
                }
            }
            at += 2;
        }
        pairs.sort_unstable_by_key(|&(k, neighbour)| (k, neighbour.before, neighbour.gone));
        let mut first = Vec::new();
        memory::lengthen(&mut first, gone.len() + 1, 0)?;
        pairs.iter().for_each(|&(k, _)| first[k as usize + 1] += 1);
        (1..first.len()).for_each(|k| first[k] += first[k - 1]);
        let mut list = Vec::new();
        memory::collect(&mut list, pairs.iter().map(|&(_, neighbour)| neighbour))?;
        Ok(Besides { first, list })
    }

    fn of_one(&self, k: u32) -> &[Neighbour] {
        &self.list[self.first[k as usize] as usize..self.first[k as usize + 1] as usize]
    }

    /// Tells where the values of the neighbours of a cell are, and of theirs.
    pub(super) fn for_values(&self, k: u32, mut tell: impl FnMut(u32)) {
        self.for_each(k, true, |_, before| tell(before));
    }

    /// Neighbours whose means a gradient is fitted to: those of a cell, and where `are_more`, those of these.
    fn for_each(&self, k: u32, are_more: bool, mut tell: impl FnMut(&PlaceInSpace, u32)) {
        for near in self.of_one(k) {
            tell(&near.way, near.before);
            if are_more && near.gone != LIVES {
                let others = self.of_one(near.gone).iter().filter(|far| far.gone != k);
                others.for_each(|far| tell(&plus(&near.way, &far.way), far.before));
            }
        }
    }

    /// How the gradient in a cell follows from means.
    pub(super) fn fit<const D: usize>(&self, k: usize) -> Option<Fit> {
        [false, true].into_iter().find_map(|are_more| {
            let mut sums = [[0.0; 3]; 3];
            self.for_each(k as u32, are_more, |way, _| {
                let (direction, _) = direction_of(way);
                for (row, x) in sums.iter_mut().zip(direction) {
                    *row = plus(row, &direction.map(|y| x * y));
                }
            });
            inverse::<D>(&sums).map(|inverse| Fit { inverse, are_more })
        })
    }

    /// The gradient in a cell; `difference` tells by how much more than the cell's own a value is.
    pub(super) fn gradient(&self, k: usize, fit: &Fit, difference: impl Fn(u32) -> f64) -> PlaceInSpace {
        let mut sum = [0.0; 3];
        self.for_each(k as u32, fit.are_more, |way, before| {
            let (direction, length) = direction_of(way);
            if length > 0.0 {
                let slope = difference(before) / length;
                sum = plus(&sum, &direction.map(|x| x * slope));
            }
        });
        fit.inverse.map(|row| dot(&row, &sum))
    }
}

/// The inverse of the sum of products of directions, and which neighbours these are to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    inverse: [PlaceInSpace; 3],
    are_more: bool,
}

/// The direction and length of a way; nothing for none.
fn direction_of(way: &PlaceInSpace) -> (PlaceInSpace, f64) {
    let greatest = way.iter().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
    if greatest == 0.0 {
        return ([0.0; 3], 0.0);
    }
    let scaled = way.map(|x| x / greatest);
    let length = dot(&scaled, &scaled).sqrt();
    (scaled.map(|x| x / length), length * greatest)
}

/// The inverse of a symmetric matrix, if it has one that tells anything.
fn inverse<const D: usize>(m: &[PlaceInSpace; 3]) -> Option<[PlaceInSpace; 3]> {
    let mut m = *m;
    if D == 2 {
        m[2][2] = 1.0;
    }
    let minor = |i: usize, j: usize| {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant = (0..3).map(|j| m[0][j] * minor(0, j)).sum::<f64>();
    let is_sound = determinant > LEAST;
    is_sound.then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i) / determinant)))
}
