//! What is near a place and what has given corners, compared with all vertices and cells, in integers.

use super::super::exact_oracle::reach::{ball_meets_box, is_box_beyond};
use super::super::exact_oracle::{
    Tally, exact_distance_order, exact_order_to_square, exact_sign, is_inside_by_polynomial, nudged,
};
use super::called::{c, note};
use super::types::{NONE, Place, Row};
use super::{History, flattened};
use deldrift::capi::deldrift_location_kind::*;
use deldrift::capi::*;
use std::array::from_fn;
use std::cmp::Ordering::{self, Greater, Less};
use std::ptr::{null, null_mut};

/// The first coordinates of a place.
fn short<const D: usize>(p: &Place) -> [f64; D] {
    from_fn(|k| p[k])
}

fn order(a: &Place, b: &Place, q: &Place, d: usize) -> Ordering {
    let tally = &mut Tally::default();
    if d == 2 {
        exact_distance_order::<2>(&[a, b, q].map(short), tally)
    } else {
        exact_distance_order::<3>(&[a, b, q].map(short), tally)
    }
}

fn is_within(p: &Place, q: &Place, squared: f64, d: usize) -> bool {
    let tally = &mut Tally::default();
    let order = if d == 2 {
        exact_order_to_square::<2>(&[p, q].map(short), squared, tally)
    } else {
        exact_order_to_square::<3>(&[p, q].map(short), squared, tally)
    };
    order != Greater
}

impl History<'_> {
    pub(super) fn read_near(&mut self) {
        match self.s.below(12) {
            0 => self.nearest_vertices(),
            1 => self.ball(),
            2 => self.vertices_in_box(),
            3 => self.conflicts(),
            4 => self.simplices(),
            5 => self.cell_of_each(),
            6 => self.hidden_vertices(),
            7 => self.weights(),
            8 => self.flat_cells(),
            9 => self.reach(),
            10 => self.lists(),
            _ => self.in_sphere(),
        }
    }

    fn nearest_vertices(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (count, k) = (self.s.below(4), self.s.pick(&[1, 2, 7, 0, 40]));
        let places: Vec<Place> = (0..count).map(|_| self.place()).collect();
        let numbers = flattened(&places, d);
        let mut found = vec![77; count * k];
        let to = found.as_mut_ptr();
        self.ok(|| c!(deldrift_nearest_vertices(t, numbers.as_ptr(), count, k, to)));
        let at = |v: u32| self.m.at(v).expect("present");
        for (i, q) in places.iter().enumerate() {
            let mut wanted: Vec<u32> = self.m.present().collect();
            // Vertices are in the order of ids, which a stable sort keeps.
            wanted.sort_by(|&v, &w| order(&at(v), &at(w), q, d));
            wanted.resize(wanted.len().max(k), NONE);
            assert_eq!(found[i * k..(i + 1) * k], wanted[..k], "nearest to {q:?}");
        }
    }

    /// The ball reaches a vertex, or just does not, or is any.
    fn ball(&mut self) {
        let (t, d, centre) = (self.t, self.m.d, self.place());
        let squared = match (self.s.below(5), self.some()) {
            (0, _) => self.s.pick(&[0.0, f64::INFINITY, f64::MAX, f64::from_bits(1)]),
            (1, _) => self.s.magnitude().abs(),
            (_, None) => 1.0,
            (_, Some(v)) => {
                let p = self.m.at(v).expect("present");
                let near = (0..d).map(|k| (p[k] - centre[k]) * (p[k] - centre[k])).sum::<f64>();
                nudged(near, self.s.within(2))
            }
        };
        let found = self.copied(77, 1, |to, room, count| {
            c!(deldrift_vertices_in_ball(t, centre.as_ptr(), squared, to, room, count))
        });
        let is_in = |v: &u32| is_within(&self.m.at(*v).expect("present"), &centre, squared, d);
        let wanted: Vec<u32> = self.m.present().filter(is_in).collect();
        assert_eq!(found, wanted, "within {squared:e} of {centre:?}");
    }

    /// Lists of all vertices, or of some, each pair both ways or once: with one radius, or each its own.
    fn lists(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let mut n_ids = 0;
        self.ok(|| c!(deldrift_id_count(t, &mut n_ids)));
        let present: Vec<(u32, Place)> =
            self.m.present().map(|v| (v, self.m.at(v).expect("present"))).collect();
        let n_radii = if self.s.below(2) == 0 { 1 } else { n_ids };
        let mut radii = Vec::new();
        for _ in 0..n_radii {
            let (v, w) = (self.some(), self.some());
            radii.push(match (self.s.below(5), v.zip(w)) {
                (0, _) => self.s.pick(&[0.0, f64::INFINITY, f64::MAX, f64::from_bits(1)]),
                (_, None) => 1.0,
                (_, Some((v, w))) => {
                    let [p, q] = [v, w].map(|v| self.m.at(v).expect("present"));
                    let square = (0..d).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>();
                    nudged(square, self.s.within(2)).max(0.0)
                }
            });
        }
        let mask: Vec<u8> = (0..n_ids).map(|_| u8::from(self.s.below(3) != 0)).collect();
        let is_masked = self.s.below(2) == 0;
        let (of, n_of) = if is_masked { (mask.as_ptr(), n_ids) } else { (null(), 0) };
        let of_list = |v: u32| {
            (!is_masked || mask[v as usize] != 0).then(|| radii[if n_radii == 1 { 0 } else { v as usize }])
        };
        for pairs in [0, 1] {
            let mut offsets = vec![77; n_ids + 1];
            let starts = offsets.as_mut_ptr();
            let found = self.copied(77, 1, |to, room, count| {
                let radii = radii.as_ptr();
                c!(deldrift_neighbour_lists(
                    t,
                    radii,
                    n_radii,
                    of,
                    n_of,
                    pairs,
                    starts,
                    n_ids + 1,
                    to,
                    null_mut(),
                    room,
                    count
                ))
            });
            let mut wanted = Vec::new();
            for v in 0..n_ids as u32 {
                assert_eq!(offsets[v as usize], wanted.len(), "where the list of {v} begins");
                let Some((_, p)) = present.iter().find(|&&(w, _)| w == v) else { continue };
                let Some(own) = of_list(v) else { continue };
                wanted.extend(
                    present
                        .iter()
                        .filter(|&&(w, q)| {
                            let is_near = |squared| is_within(&q, p, squared, d);
                            w != v
                                && match of_list(w) {
                                    Some(other) if pairs == 1 => v < w && (is_near(own) || is_near(other)),
                                    _ => is_near(own),
                                }
                        })
                        .map(|&(w, _)| w),
                );
            }
            assert_eq!(offsets[n_ids], wanted.len());
            assert_eq!(found, wanted, "within {radii:?}");
        }
    }

    /// A box whose corners are places, so that vertices are on its faces, or infinite.
    fn a_box(&mut self) -> (Place, Place) {
        let d = self.m.d;
        let (p, q) = (self.place(), self.place());
        let (mut low, mut high) = (p, q);
        for k in 0..d {
            match self.s.below(8) {
                0 => low[k] = f64::NEG_INFINITY,
                1 => high[k] = f64::INFINITY,
                2 => high[k] = low[k],
                3 => low[k] = low[k].next_up(),
                4 => {}
                _ => (low[k], high[k]) = (p[k].min(q[k]), p[k].max(q[k])),
            }
        }
        (low, high)
    }

    fn vertices_in_box(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (low, high) = self.a_box();
        let found = self.copied(77, 1, |to, room, count| {
            c!(deldrift_vertices_in_box(t, low.as_ptr(), high.as_ptr(), to, room, count))
        });
        let is_in = |v: &u32| {
            let p = self.m.at(*v).expect("present");
            (0..d).all(|k| low[k] <= p[k] && p[k] <= high[k])
        };
        let wanted: Vec<u32> = self.m.present().filter(is_in).collect();
        assert_eq!(found, wanted, "from {low:?} to {high:?}");
    }

    /// Whether the closed ball of a cell meets a box that is not empty, and which of its facets on the hull a place of
    /// the box is beyond.
    fn those_of_box(&self, row: &Row, across: &Row, [low, high]: [&[f64]; 2]) -> (bool, Vec<u8>) {
        let d = self.m.d;
        let places: Vec<Place> = row[..=d].iter().map(|&v| self.m.at(v).expect("present")).collect();
        let corners: Vec<&[f64]> = places.iter().map(|p| &p[..d]).collect();
        let is_beyond = |corner: usize| {
            let facet: Vec<&[f64]> = (0..=d).filter(|&k| k != corner).map(|k| corners[k]).collect();
            across[corner] == NONE && is_box_beyond(&facet, corners[corner], low, high)
        };
        let facets = (0..=d).filter(|&corner| is_beyond(corner)).map(|corner| corner as u8).collect();
        (ball_meets_box(&corners, low, high), facets)
    }

    /// What is in reach of a box.
    fn reach(&mut self) {
        const LIMIT: f64 = 1e57;
        let (t, d) = (self.t, self.m.d);
        let (low, high) = self.a_box();
        let mut n_ids = 0;
        self.ok(|| c!(deldrift_id_count(t, &mut n_ids)));
        let mask: Vec<u8> = (0..n_ids).map(|_| u8::from(self.s.below(4) == 0)).collect();
        let (l, h) = (low.as_ptr(), high.as_ptr());
        let found = self.copied(77, 1, |to, room, count| {
            c!(deldrift_cells_in_reach(t, l, h, 1, null(), 0, to, null_mut(), null_mut(), room, count))
        });
        let seen = self.copied(77, 1, |to, room, count| {
            c!(deldrift_hull_facets_in_reach(t, l, h, 1, null(), 0, to, null_mut(), room, count))
        });
        let listed = self.copied(77, 1, |to, room, count| {
            c!(deldrift_vertices_in_reach(t, l, h, 1, mask.as_ptr(), mask.len(), to, null_mut(), room, count))
        });
        let is_empty = (0..d).any(|k| low[k] > high[k] || low[k] > LIMIT || high[k] < -LIMIT);
        let [low, high] = [low, high].map(|p| p.map(|x| x.clamp(-LIMIT, LIMIT)));
        let (rows, across) = self.cells();
        let (mut cells, mut facets, mut corners) = (Vec::new(), Vec::new(), Vec::new());
        for (cell, (row, across)) in (0..).zip(rows.iter().zip(&across)).filter(|_| !is_empty) {
            let (is_in, beyond) = self.those_of_box(row, across, [&low[..d], &high[..d]]);
            // Constrained cells need a way to the box; those that are told have been found to have one.
            if is_in && (found.contains(&cell) || self.m.segments.laid().next().is_none()) {
                cells.push(cell);
                corners.extend_from_slice(&row[..=d]);
            }
            for corner in beyond {
                facets.push(cell);
                corners.extend((0..=d).filter(|&k| k != usize::from(corner)).map(|k| row[k]));
            }
        }
        assert_eq!(found, cells, "cells in reach of {low:?} to {high:?}");
        assert_eq!(seen, facets, "facets in reach of {low:?} to {high:?}");
        let representatives = self.m.representatives();
        let is_listed = |v: &u32| {
            mask[*v as usize] != 0
                && !is_empty
                && (rows.is_empty() || corners.contains(&representatives[*v as usize]))
        };
        let wanted: Vec<u32> = self.m.present().filter(is_listed).collect();
        assert_eq!(listed, wanted, "vertices in reach of {low:?} to {high:?}");
    }

    /// Whether the circle or sphere of a cell has a place inside, as that of a vertex of the highest id.
    fn has_inside<const D: usize, const N: usize>(&self, row: &Row, q: &Place) -> bool {
        let at = |i: usize| self.m.at(row[i]).expect("present");
        let points: [[f64; D]; N] = from_fn(|i| if i < N - 1 { short(&at(i)) } else { short(q) });
        let ids: [u32; N] = from_fn(|i| if i < N - 1 { row[i] } else { NONE });
        is_inside_by_polynomial(&points, &ids, &mut Tally::default())
    }

    fn conflicts(&mut self) {
        let (t, d, q) = (self.t, self.m.d, self.place());
        let hint = deldrift_location {
            kind: self.s.pick(&[DELDRIFT_LOCATION_VERTEX, DELDRIFT_LOCATION_CELL, DELDRIFT_LOCATION_OUTSIDE]),
            index: u32::from(self.s.byte()),
        };
        let hint = if self.s.below(2) == 0 { null() } else { &raw const hint };
        let mut found = self
            .copied(77, 1, |to, room, count| c!(deldrift_conflicts(t, q.as_ptr(), hint, to, room, count)));
        found.sort_unstable();
        let is_taken = self.m.first_at(&q).is_some();
        let is_in = |row: &Row| {
            !is_taken
                && if d == 2 { self.has_inside::<2, 4>(row, &q) } else { self.has_inside::<3, 5>(row, &q) }
        };
        let (rows, _) = self.cells();
        let wanted: Vec<u32> = (0..).zip(&rows).filter(|(_, row)| is_in(row)).map(|(cell, _)| cell).collect();
        // Segments hide the place from some of them.
        let is_hidden = self.m.segments.laid().next().is_some();
        let is_right =
            if is_hidden { found.iter().all(|cell| wanted.contains(cell)) } else { found == wanted };
        assert!(is_right, "{found:?}, not {wanted:?}, in conflict with {q:?}");
    }

    /// Corners of cells in any order, and vertices of no cell.
    fn simplices(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (rows, _) = self.cells();
        let representatives = self.m.representatives();
        let n_corners = 1 + self.s.below(d + 1);
        let present: Vec<u32> = self.m.present().collect();
        let count = if present.is_empty() { 0 } else { self.s.pick(&[1, 2, 5, 40]) };
        let mut ids = Vec::new();
        for _ in 0..count {
            let (first, is_of_cell) = (self.s.below(d + 1), self.s.below(3) > 0 && !rows.is_empty());
            if is_of_cell {
                let row = rows[self.s.below(rows.len())];
                ids.extend((0..n_corners).map(|i| row[(first + i) % (d + 1)]));
            } else {
                ids.extend((0..n_corners).map(|_| present[self.s.below(present.len())]));
            }
        }
        let mut found = vec![77; count];
        let to = found.as_mut_ptr();
        self.ok(|| c!(deldrift_find_simplices(t, n_corners as u32, ids.as_ptr(), count, to)));
        for (simplex, &cell) in ids.chunks(n_corners).zip(&found) {
            let shown: Vec<u32> = simplex.iter().map(|&v| representatives[v as usize]).collect();
            let is_proper = (1..n_corners).all(|i| !shown[..i].contains(&shown[i]));
            let has_all = |row: &Row| is_proper && shown.iter().all(|v| row.contains(v));
            let is_right =
                if cell == NONE { !rows.iter().any(has_all) } else { has_all(&rows[cell as usize]) };
            assert!(is_right, "{simplex:?} is not in {cell}");
        }
    }

    fn cell_of_each(&mut self) {
        let t = self.t;
        let found =
            self.copied(77, 1, |to, room, count| c!(deldrift_cell_of_each_vertex(t, to, room, count)));
        let (rows, _) = self.cells();
        assert_eq!(found.len(), self.m.positions.len());
        let representatives = self.m.representatives();
        for (v, &cell) in (0..).zip(&found) {
            let is_right = if rows.is_empty() || representatives[v as usize] != v {
                cell == NONE
            } else {
                rows[cell as usize].contains(&v)
            };
            assert!(is_right, "vertex {v} is no corner of {cell}");
        }
    }

    fn hidden_vertices(&mut self) {
        let t = self.t;
        let vertices = self
            .copied(77, 1, |to, room, count| c!(deldrift_hidden_vertices(t, to, null_mut(), room, count)));
        let shown = self
            .copied(77, 1, |to, room, count| c!(deldrift_hidden_vertices(t, null_mut(), to, room, count)));
        let wanted = self.m.hidden();
        assert!(vertices.iter().eq(&wanted), "hidden {vertices:?}, not {wanted:?}");
        let representatives = self.m.representatives();
        assert!(vertices.iter().map(|&v| representatives[v as usize]).eq(shown));
    }

    /// The sign of the orientation of a cell with a place for a corner.
    fn side<const D: usize, const N: usize>(&self, row: &Row, i: usize, q: &Place) -> Ordering {
        let at = |k: usize| self.m.at(row[k]).expect("present");
        let points: [[f64; D]; N] = from_fn(|k| if k == i { short(q) } else { short(&at(k)) });
        exact_sign(&points, &mut Tally::default())
    }

    /// Signs are exact; a row adds up to 1 where nothing underflows.
    fn weights(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (rows, _) = self.cells();
        let count = self.s.below(4);
        let places: Vec<Place> = (0..count).map(|_| self.place()).collect();
        let draw = |s: &mut super::Source| if s.below(4) == 0 { NONE } else { s.below(rows.len()) as u32 };
        let cells: Vec<u32> =
            places.iter().map(|_| if rows.is_empty() { NONE } else { draw(&mut self.s) }).collect();
        let numbers = flattened(&places, d);
        let mut found = vec![77.0; count * (d + 1)];
        let to = found.as_mut_ptr();
        self.ok(|| c!(deldrift_barycentric(t, numbers.as_ptr(), cells.as_ptr(), count, to)));
        let is_moderate = self.style.is_easy() && self.is_moderate();
        for ((q, &cell), weights) in places.iter().zip(&cells).zip(found.chunks(d + 1)) {
            if cell == NONE {
                assert!(weights.iter().all(|weight| weight.is_nan()));
                continue;
            }
            let row = &rows[cell as usize];
            let is_easy = is_moderate && q.iter().all(|&x| x == 0.0 || (1e-20..1e20).contains(&x.abs()));
            for (i, &weight) in weights.iter().enumerate() {
                let wanted = if d == 2 { self.side::<2, 3>(row, i, q) } else { self.side::<3, 4>(row, i, q) };
                let found = weight.partial_cmp(&0.0).expect("a number");
                // A quotient of volumes may underflow, or both of them.
                let is_right = if is_easy { found == wanted } else { found == wanted || weight == 0.0 };
                assert!(is_right, "weight {weight} of corner {i} of cell {cell} at {q:?}");
            }
            let sum: f64 = weights.iter().sum();
            let most = weights.iter().fold(1.0f64, |most, weight| most.max(weight.abs()));
            assert!(!is_easy || (sum - 1.0).abs() < 1e-8 * most, "weights {weights:?} at {q:?}");
        }
    }

    /// Cells that are left out are on the hull or beside others that are, and no flat cell there is kept.
    fn flat_cells(&mut self) {
        let t = self.t;
        let tolerance = self.s.pick(&[0.1, 0.5, 1e-3, 1e-9, 0.0, f64::INFINITY, 0.02]);
        let mask = self.copied(77, 1, |to, room, count| {
            c!(deldrift_mask_without_flat_cells(t, tolerance, to, room, count))
        });
        let (rows, neighbours) = self.cells();
        assert_eq!(mask.len(), rows.len());
        let mut volumes = vec![0.0; rows.len()];
        let mut n = 0;
        self.is_ok(c!(deldrift_volumes(t, volumes.as_mut_ptr(), volumes.len(), &mut n)));
        let is_moderate = self.is_moderate();
        for (cell, row) in rows.iter().enumerate() {
            assert!(mask[cell] <= 1);
            let is_out = |&other: &u32| other == NONE || mask[other as usize] == 0;
            let is_reached = neighbours[cell][..=self.m.d].iter().any(is_out);
            assert!(mask[cell] == 1 || is_reached, "cell {cell} is left out within others");
            assert!(mask[cell] == 1 || tolerance > 0.0, "cell {cell} is left out");
            assert!(mask[cell] == 0 || tolerance < f64::INFINITY, "cell {cell} is kept");
            if is_moderate && tolerance > 0.0 && tolerance < f64::INFINITY {
                let flatness = self.flatness(row, volumes[cell]);
                let is_flat = flatness < tolerance * (1.0 - 1e-5);
                assert!(mask[cell] == 0 || !is_reached || !is_flat, "cell {cell} is kept: {flatness:e}");
                assert!(mask[cell] == 1 || flatness < tolerance * (1.0 + 1e-5), "cell {cell}: {flatness:e}");
            }
        }
    }

    /// The least height of a cell over its longest edge, or the greatest area of a facet over half the square of that, if
    /// it is less.
    fn flatness(&self, row: &Row, volume: f64) -> f64 {
        let d = self.m.d;
        let at = |i: usize| self.m.at(row[i]).expect("present");
        let edge = |i: usize, k: usize| -> Place { from_fn(|axis| at(i)[axis] - at(k)[axis]) };
        let square = |x: &Place| x.iter().map(|x| x * x).sum::<f64>();
        let (mut longest, mut largest) = (0.0f64, 0.0f64);
        for i in 0..=d {
            for k in 0..i {
                longest = longest.max(square(&edge(i, k)));
                for l in 0..k {
                    let (u, v) = (edge(i, k), edge(l, k));
                    let across: Place = from_fn(|axis| {
                        let (y, z) = ((axis + 1) % 3, (axis + 2) % 3);
                        u[y] * v[z] - u[z] * v[y]
                    });
                    largest = largest.max(square(&across));
                }
            }
        }
        if d == 2 {
            return 2.0 * volume / longest;
        }
        let largest = largest.sqrt();
        (largest / longest).min(6.0 * volume / (largest * longest.sqrt()))
    }

    fn in_sphere(&mut self) {
        let d = self.m.d;
        let places: [Place; 5] = from_fn(|_| self.place());
        let numbers = flattened(&places[..d + 2], d);
        let mut sign = 77;
        self.ok(|| c!(deldrift_in_sphere(d as u32, numbers.as_ptr(), &mut sign)));
        let tally = &mut Tally::default();
        let wanted = if d == 2 {
            exact_sign::<2, 4>(&from_fn(|i| short(&places[i])), tally)
        } else {
            exact_sign::<3, 5>(&from_fn(|i| short(&places[i])), tally)
        };
        assert_eq!(sign.cmp(&0), wanted, "in-sphere sign of {places:?}");
        assert!(sign.abs() <= 1 && (wanted != Less || sign == -1));
        // Weights that are equal make no difference.
        let (weights, mut weighted) = ([numbers[0]; 5], 77);
        self.ok(|| c!(deldrift_in_power_sphere(d as u32, numbers.as_ptr(), weights.as_ptr(), &mut weighted)));
        assert_eq!(weighted, sign, "with one weight for all of {places:?}");
    }
}
