//! What segments divide: the cells beside them, regions, and chains of edges.

use super::called::{c, note};
use super::segments::turn;
use super::types::{NONE, Place, Row};
use super::{History, flattened, message};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::cmp::Ordering::{Equal, Less};
use std::collections::BTreeSet;
use std::ptr::null_mut;

impl History<'_> {
    /// For each cell the segments at its edges, looked for among all.
    pub(super) fn wanted_sides(&self) -> (Vec<Row>, Vec<Row>, Vec<[u32; 3]>) {
        let (rows, neighbours) = self.cells();
        let shown = self.m.representatives();
        let edges: Vec<(u32, [u32; 2])> =
            self.m.segments.laid().map(|(id, ends)| (id, ends.map(|v| shown[v as usize]))).collect();
        let at = |row: &Row, i: usize| {
            let edge = [row[(i + 1) % 3], row[(i + 2) % 3]];
            let is_there = |ends: &[u32; 2]| *ends == edge || [ends[1], ends[0]] == edge;
            edges.iter().find(|(_, ends)| is_there(ends)).map_or(NONE, |&(id, _)| id)
        };
        let sides = rows.iter().map(|row| [0, 1, 2].map(|i| at(row, i))).collect();
        (rows, neighbours, sides)
    }

    pub(super) fn read_sides(&mut self) {
        let t = self.t;
        let found = self.copied(77, 3, |to, room, count| c!(deldrift_segments_of_cells(t, to, room, count)));
        let beside = self.copied(77, 2, |to, room, count| c!(deldrift_cells_of_segments(t, to, room, count)));
        let (rows, _, sides) = self.wanted_sides();
        assert_eq!(found, sides.concat(), "segments of cells");
        let shown = self.m.representatives();
        for ((id, ends), found) in self.m.segments.laid().zip(beside.chunks(2)) {
            let [a, b] = ends.map(|v| shown[v as usize]);
            let left_of = |a: u32, b: u32| {
                let has = |row: &Row| (0..3).any(|i| row[(i + 1) % 3] == a && row[(i + 2) % 3] == b);
                rows.iter().position(has).map_or(NONE, |cell| cell as u32)
            };
            assert_eq!(found, [left_of(a, b), left_of(b, a)], "cells beside segment {id}");
        }
    }

    /// Levels are the least that agree with those of the neighbours; cells without a segment between them have one label.
    pub(super) fn read_regions(&mut self) {
        let (t, n_seeds) = (self.t, self.s.below(4));
        let levels = self.copied(77, 1, |to, room, count| c!(deldrift_nesting_levels(t, to, room, count)));
        let (rows, neighbours, sides) = self.wanted_sides();
        let (mut wanted, mut region) = (vec![NONE; sides.len()], (0..sides.len()).collect::<Vec<_>>());
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for (cell, (across, at)) in neighbours.iter().zip(&sides).enumerate() {
                for i in 0..3 {
                    let (other, is_crossed) = (across[i], at[i] != NONE);
                    let from = if other == NONE { 0 } else { wanted[other as usize] };
                    let level = from.saturating_add(u32::from(is_crossed));
                    if level < wanted[cell] {
                        (wanted[cell], has_changed) = (level, true);
                    }
                    if other != NONE && !is_crossed && region[other as usize] < region[cell] {
                        (region[cell], has_changed) = (region[other as usize], true);
                    }
                }
            }
        }
        assert_eq!(levels, wanted, "levels");
        // Each segment is crossed at an edge, and each edge crossed has one.
        let numbers = self.copied(77, 1, |to, room, count| c!(deldrift_crossing_numbers(t, to, room, count)));
        let agrees = |(&number, &level): (&u32, &u32)| number >= level && (number == 0) == (level == 0);
        assert!(numbers.len() == levels.len() && numbers.iter().zip(&levels).all(agrees), "crossing numbers");
        let seeds: Vec<Place> = (0..n_seeds).map(|_| self.place()).collect();
        let (numbers, labels) = (flattened(&seeds, 2), [5, -5, i32::MAX]);
        let mut told = vec![77; sides.len()];
        let (start, to, n) = (numbers.as_ptr(), told.as_mut_ptr(), sides.len());
        let mut count = 0;
        let status =
            self.call(|| c!(deldrift_label_cells(t, start, labels.as_ptr(), n_seeds, 9, to, n, &mut count)));
        let touched =
            |q: &Place| -> BTreeSet<usize> { self.touching(q).iter().map(|&cell| region[cell]).collect() };
        let regions: Vec<BTreeSet<usize>> = seeds.iter().map(touched).collect();
        // The outside is a region, too, and one with those that have an edge there without a segment.
        let edges = || (0..sides.len()).flat_map(|cell| (0..3).map(move |i| (cell, i)));
        let outer: Vec<(usize, usize)> = edges().filter(|&(cell, i)| neighbours[cell][i] == NONE).collect();
        let open: BTreeSet<usize> = outer
            .iter()
            .filter(|&&(cell, i)| sides[cell][i] == NONE)
            .map(|&(cell, _)| region[cell])
            .collect();
        let at = |v: u32| self.m.at(v).expect("present");
        let is_on_hull = |q: &Place| {
            outer.iter().any(|&(cell, i)| {
                let [v, w] = [1, 2].map(|k| at(rows[cell][(i + k) % 3]));
                turn(&v, &w, q) == Equal
            })
        };
        let is_ambiguous = |(q, regions): (&Place, &BTreeSet<usize>)| {
            regions.len() > 1 || (regions.len() == 1 && is_on_hull(q) && regions.is_disjoint(&open))
        };
        if seeds.iter().zip(&regions).any(is_ambiguous) {
            assert_eq!((status, count), (DELDRIFT_AMBIGUOUS_SEED, 0), "{}", message());
            return;
        }
        assert_eq!((status, count), (DELDRIFT_OK, n), "{}", message());
        for (cell, &label) in told.iter().enumerate() {
            let seed = regions.iter().position(|regions| regions.contains(&region[cell]));
            assert_eq!(label, seed.map_or(9, |k| labels[k]), "label of cell {cell}");
        }
        self.update_labels(&told, &neighbours, &sides);
        self.label_regions(&rows, &region);
    }

    /// Regions get labels, as a rule of the lowest vertex in each, and have them; but not the other cells of a region.
    fn label_regions(&mut self, rows: &[Row], region: &[usize]) {
        let (t, n) = (self.t, rows.len());
        let rule = 1 + self.s.below(5) as i32;
        let mut lowest = vec![NONE; n + 1];
        for (row, &region) in rows.iter().zip(region) {
            lowest[region] = lowest[region].min(row[0]).min(row[1]).min(row[2]);
        }
        let labels: Vec<i32> = region.iter().map(|&region| lowest[region] as i32 % rule - 1).collect();
        if self.s.below(3) == 0 {
            self.ok(|| c!(deldrift_set_regions(t, std::ptr::null(), 0)));
        }
        let wrong: Vec<i32> = (0..n as i32).collect();
        let has_two = (0..n).any(|cell| region[..cell].contains(&region[cell]));
        let status = if has_two { DELDRIFT_INVALID_VALUE } else { DELDRIFT_OK };
        if n > 0 {
            self.expect(status, || c!(deldrift_set_regions(t, wrong.as_ptr(), n)));
            self.ok(|| c!(deldrift_set_regions(t, labels.as_ptr(), n)));
        }
        let mut undecided = 77;
        let told = self.copied(77, 1, |to: *mut i32, room, count| {
            c!(deldrift_regions(t, 9, to, room, count, &mut undecided))
        });
        // Cells from which the outside is reached, and no others.
        let levels = self.copied(77, 1, |to, room, count| c!(deldrift_nesting_levels(t, to, room, count)));
        for (cell, &label) in told.iter().enumerate() {
            let wanted = if levels[cell] == 0 { 9 } else { labels[cell] };
            assert_eq!(label, wanted, "label of cell {cell}");
        }
        let laid = self.m.segments.laid().map(|(id, _)| id).next();
        if let Some(id) = laid {
            let sides = [self.s.pick(&[DELDRIFT_NO_LABEL, 4]), 5];
            self.ok(|| c!(deldrift_set_segment_sides(t, &id, sides.as_ptr(), 1)));
        }
    }

    /// Some of the cells get their labels from others of their regions, if there are any, or else from the outside.
    fn update_labels(&mut self, told: &[i32], neighbours: &[Row], sides: &[[u32; 3]]) {
        let (t, n, share) = (self.t, told.len(), 1 + self.s.below(4));
        let mut listed: Vec<u32> = (0..n as u32).filter(|_| self.s.below(4) < share).collect();
        let is_listed: BTreeSet<u32> = listed.iter().copied().collect();
        listed.extend(is_listed.first());
        let (mut wanted, mut wanted_undecided) = (told.to_vec(), 0);
        let mut left = is_listed.clone();
        while let Some(first) = left.pop_first() {
            let (mut found, mut has_label, mut is_outer) = (vec![first], false, false);
            let mut k = 0;
            while k < found.len() {
                let cell = found[k] as usize;
                k += 1;
                for i in (0..3).filter(|&i| sides[cell][i] == NONE) {
                    let other = neighbours[cell][i];
                    is_outer |= other == NONE;
                    has_label |= other != NONE && !is_listed.contains(&other);
                    if left.remove(&other) {
                        found.push(other);
                    }
                }
            }
            if !has_label {
                found.iter().for_each(|&cell| wanted[cell as usize] = 8);
                wanted_undecided += if is_outer { 0 } else { found.len() };
            }
        }
        let mut labels = told.to_vec();
        is_listed.iter().for_each(|&cell| labels[cell as usize] = i32::MIN);
        let (cells, n_listed, to, mut undecided) = (listed.as_ptr(), listed.len(), labels.as_mut_ptr(), 77);
        self.ok(|| c!(deldrift_update_labels(t, cells, n_listed, 8, to, n, &mut undecided)));
        assert_eq!((labels, undecided), (wanted, wanted_undecided), "labels again of {listed:?}");
    }

    /// The cells that have a place inside or on their boundary.
    fn touching(&self, q: &Place) -> Vec<usize> {
        let (rows, _) = self.cells();
        let at = |v: u32| self.m.at(v).expect("present");
        let has = |row: &Row| (0..3).all(|i| turn(&at(row[i]), &at(row[(i + 1) % 3]), q) != Less);
        rows.iter().enumerate().filter(|(_, row)| has(row)).map(|(cell, _)| cell).collect()
    }

    /// Chains are closed, have the edges of the boundary, and begin in order.
    pub(super) fn read_chains(&mut self) {
        let t = self.t;
        let (rows, neighbours, sides) = self.wanted_sides();
        let n = rows.len();
        let mask: Vec<u8> = (0..n).map(|_| self.s.byte() & 1).collect();
        let none = null_mut::<u32>;
        let vertices = self.copied(77, 1, |to, room, count| {
            c!(deldrift_boundary_chains(
                t,
                mask.as_ptr(),
                n,
                to,
                none(),
                none(),
                none(),
                null_mut(),
                room,
                count
            ))
        });
        let e = vertices.len();
        let [mut chains, mut segments, mut cells] = [0; 3].map(|_| vec![77; e]);
        let (mut corners, mut count) = (vec![77; e], 0);
        let [to_chains, to_segments, to_cells] =
            [&mut chains, &mut segments, &mut cells].map(|list| list.as_mut_ptr());
        let to_corners = corners.as_mut_ptr();
        self.ok(|| {
            let (start, none) = (mask.as_ptr(), none());
            c!(deldrift_boundary_chains(
                t,
                start,
                n,
                none,
                to_chains,
                to_segments,
                to_cells,
                to_corners,
                e,
                &mut count
            ))
        });
        let is_out = |cell: u32| cell == NONE || mask[cell as usize] == 0;
        let mut wanted = BTreeSet::new();
        for (cell, across) in neighbours.iter().enumerate().filter(|(cell, _)| mask[*cell] != 0) {
            wanted.extend((0..3).filter(|&i| is_out(across[i])).map(|i| (cell, i)));
        }
        let mut last_start = None;
        for k in 0..e {
            let (cell, i) = (cells[k] as usize, usize::from(corners[k]));
            assert!(wanted.remove(&(cell, i)), "edge {i} of cell {cell} in a chain");
            assert_eq!(segments[k], sides[cell][i], "the segment of an edge");
            let edge = [rows[cell][(i + 1) % 3], rows[cell][(i + 2) % 3]];
            let is_first = k == 0 || chains[k] != chains[k - 1];
            let is_last = k + 1 == e || chains[k + 1] != chains[k];
            let first = chains.partition_point(|&chain| chain < chains[k]);
            assert_eq!(edge, [vertices[k], vertices[if is_last { first } else { k + 1 }]], "edge {k}");
            if is_first {
                assert!(last_start < Some(edge) && chains[k] == if k == 0 { 0 } else { chains[k - 1] + 1 });
                last_start = Some(edge);
            }
            assert!(last_start <= Some(edge), "a chain begins with its least edge");
        }
        assert!(wanted.is_empty() && count == e, "edges in no chain: {wanted:?}");
    }
}
