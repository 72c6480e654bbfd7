//! What a triangulation should say, by the simplest means.

use super::super::exact_oracle::{Tally, exact_sign, is_inside_by_polynomial};
use super::segments::Segments;
use super::types::{NONE, Place, Row};
use std::array::from_fn;
use std::cmp::Ordering::{Equal, Greater, Less};
use std::collections::{BTreeMap, BTreeSet};
#[derive(Clone, Debug, Default)]
pub struct Model {
    pub d: usize,
    /// By id; none where the vertex is not present.
    pub positions: Vec<Option<Place>>,
    pub staged: BTreeMap<u32, Place>,
    pub coming: Vec<(u32, Place)>,
    /// How many ids those that are staged do not give back.
    pub n_known: usize,
    pub leaving: BTreeSet<u32>,
    pub segments: Segments,
    /// Vertices that refinement has inserted, of those present.
    pub made: BTreeSet<u32>,
    pub timestamp: u64,
}

impl Model {
    pub fn present(&self) -> impl Iterator<Item = u32> {
        let ids = 0..self.positions.len() as u32;
        ids.filter(|&v| self.positions[v as usize].is_some())
    }

    pub fn at(&self, v: u32) -> Option<Place> {
        self.positions.get(v as usize).copied().flatten()
    }

    /// Where a vertex will be inserted, if that is staged.
    pub fn goal(&self, v: u32) -> Option<Place> {
        self.coming.iter().find(|&&(id, _)| id == v).map(|&(_, p)| p)
    }

    pub fn is_coming(&self, v: u32) -> bool {
        self.goal(v).is_some()
    }

    /// The lowest id at a place.
    pub fn first_at(&self, p: &Place) -> Option<u32> {
        self.positions.iter().position(|q| q.as_ref() == Some(p)).map(|v| v as u32)
    }

    /// For each id the lowest one at its place, NONE for those not present.
    pub fn representatives(&self) -> Vec<u32> {
        let mut first = BTreeMap::new();
        let bits = |p: &Place| p.map(f64::to_bits);
        let ids = self.positions.iter().enumerate();
        ids.map(|(v, p)| p.as_ref().map_or(NONE, |p| *first.entry(bits(p)).or_insert(v as u32))).collect()
    }

    pub fn hidden(&self) -> BTreeSet<u32> {
        let all = self.representatives();
        (0..).zip(all).filter(|&(v, r)| r != NONE && r != v).map(|(v, _)| v).collect()
    }

    /// The positions after a commit.
    pub fn committed(&self) -> Vec<Option<Place>> {
        let mut positions = self.positions.clone();
        self.staged.iter().for_each(|(&v, &p)| positions[v as usize] = Some(p));
        self.leaving.iter().for_each(|&v| positions[v as usize] = None);
        self.coming.iter().for_each(|&(v, p)| positions[v as usize] = Some(p));
        positions
    }

    pub fn forget_staged(&mut self) {
        self.staged.clear();
        self.leaving.clear();
        self.coming.clear();
        self.segments.forget_staged();
    }

    /// Whether vertices of which moves are not staged, or anything else, share a place.
    pub fn has_coincidence(positions: &[Option<Place>]) -> bool {
        let mut places: Vec<_> = positions.iter().flatten().map(|p| p.map(f64::to_bits)).collect();
        places.sort_unstable();
        places.windows(2).any(|pair| pair[0] == pair[1])
    }

    /// Proves from the definition, by integers, that these are the cells of the Delaunay triangulation: each is positive,
    /// has no vertex in its sphere, ties being decided by id, and facets that no other cell has are on the hull.
    pub fn prove(&self, rows: &[Row], neighbours: &[Row]) {
        if self.d == 2 {
            self.prove_in::<2, 3, 4>(rows, neighbours)
        } else {
            self.prove_in::<3, 4, 5>(rows, neighbours)
        }
    }

    fn prove_in<const D: usize, const N: usize, const M: usize>(&self, rows: &[Row], neighbours: &[Row]) {
        let at = |v: u32| -> [f64; D] {
            let p = self.at(v).expect("a corner is present");
            from_fn(|k| p[k])
        };
        let representatives = self.representatives();
        let places: Vec<u32> =
            (0..).zip(&representatives).filter(|&(v, &r)| r == v).map(|(v, _)| v).collect();
        let tally = &mut Tally::default();
        for (row, across) in rows.iter().zip(neighbours) {
            let corners: [[f64; D]; N] = from_fn(|i| at(row[i]));
            assert_eq!(exact_sign(&corners, tally), Greater, "cell {row:?} is not positive");
            for &v in places.iter().filter(|v| !row.contains(v)) {
                let points: [[f64; D]; M] = from_fn(|i| if i < N { corners[i] } else { at(v) });
                let ids: [u32; M] = from_fn(|i| if i < N { row[i] } else { v });
                assert!(
                    !is_inside_by_polynomial(&points, &ids, tally),
                    "vertex {v} is in the sphere of {row:?}"
                );
            }
            for i in (0..N).filter(|&i| across[i] == NONE) {
                for &v in &places {
                    let seen = from_fn(|k| if k == i { at(v) } else { corners[k] });
                    assert_ne!(
                        exact_sign::<D, N>(&seen, tally),
                        Less,
                        "{v} is beyond the hull at {row:?}, {i}"
                    );
                }
            }
        }
        if rows.is_empty() {
            self.prove_flat::<D, N>(&places, &at, tally);
        }
    }

    /// No `N` of the places span the dimension.
    fn prove_flat<const D: usize, const N: usize>(
        &self,
        places: &[u32],
        at: &dyn Fn(u32) -> [f64; D],
        tally: &mut Tally,
    ) {
        let Some((&first, rest)) = places.split_first() else { return };
        let others = &rest[..rest.len().min(12)];
        for (i, &a) in others.iter().enumerate() {
            for (j, &b) in others[..i].iter().enumerate() {
                if D == 2 {
                    let points: [[f64; D]; N] = from_fn(|k| at([first, a, b, b][k]));
                    assert_eq!(exact_sign(&points, tally), Equal, "{first}, {a} and {b} span the plane");
                    continue;
                }
                for &c in &others[..j] {
                    let points: [[f64; D]; N] = from_fn(|k| at([first, a, b, c][k]));
                    assert_eq!(exact_sign(&points, tally), Equal, "{first}, {a}, {b} and {c} span the space");
                }
            }
        }
    }
}
