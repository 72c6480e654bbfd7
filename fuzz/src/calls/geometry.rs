//! What is computed of all cells, compared with what follows from them.

use super::called::{c, note};
use super::types::{NONE, Place, Row, sorted};
use super::{History, flattened};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::collections::BTreeSet;
use std::ptr::{null, null_mut};

impl History<'_> {
    pub(super) fn read_geometry(&mut self) {
        match self.s.below(14) {
            0 => self.spheres(),
            1 => self.volumes(),
            2 => self.mask(),
            3 => self.boundary(),
            4 => self.hull(),
            5 => self.edges(),
            6 => self.vertex_neighbours(),
            7 => self.vertex_cells(),
            8 => self.mirrors(),
            9 => self.ordered_star(),
            10 => self.voronoi(),
            11 => self.interpolate(),
            12 => self.cells_around(),
            _ => self.update(),
        }
    }

    fn spheres(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let squares = self
            .copied(-1.0, 1, |to, room, count| c!(deldrift_circumcentres(t, null_mut(), to, room, count)));
        let centres = self.copied(f64::NAN, d, |to, room, count| {
            c!(deldrift_circumcentres(t, to, null_mut(), room, count))
        });
        assert_eq!(squares.len(), self.cells().0.len());
        assert!(squares.iter().all(|&square| square >= 0.0) && centres.iter().all(|x| !x.is_nan()));
    }

    fn volumes(&mut self) {
        let t = self.t;
        let volumes = self.copied(-1.0, 1, |to, room, count| c!(deldrift_volumes(t, to, room, count)));
        assert_eq!(volumes.len(), self.cells().0.len());
        assert!(volumes.iter().all(|&volume| volume >= 0.0 && volume.is_finite()));
    }

    /// The squared circumradii are near those of the mask.
    fn mask(&mut self) {
        let t = self.t;
        let mut n = 0;
        self.is_ok(c!(deldrift_cell_count(t, &mut n)));
        let mut squares = vec![0.0; n];
        self.is_ok(c!(deldrift_circumcentres(t, null_mut(), squares.as_mut_ptr(), n, &mut n)));
        let choice = self.s.below(4);
        let limit = match choice {
            0 => f64::INFINITY,
            1 => self.s.magnitude().abs(),
            _ if n > 0 => squares[self.s.below(n)] * if choice == 2 { 1.0 } else { 1.0 + 1e-8 },
            _ => 1.0,
        };
        let mask = self
            .copied(77, 1, |to, room, count| c!(deldrift_mask_by_circumradius(t, limit, to, room, count)));
        for (square, is_in) in squares.into_iter().zip(mask) {
            assert!(is_in <= 1);
            if square < f64::INFINITY && square > 1e-300 && square * (1.0 + 1e-8) < limit {
                assert_eq!(is_in, 1, "{square} within {limit}");
            }
            if square * (1.0 - 1e-8) > limit && square > 1e-300 && square < f64::INFINITY {
                assert_eq!(is_in, 0, "{square} within {limit}");
            }
            assert!(is_in == 1 || limit < f64::INFINITY);
        }
    }

    /// The facets between cells in the mask and others: their corners, cells and corners opposite.
    fn wanted_boundary(&self, mask: &[u8]) -> Vec<(Row, u32, u8)> {
        let (rows, neighbours) = self.cells();
        let mut facets = Vec::new();
        for (cell, (row, across)) in
            rows.iter().zip(&neighbours).enumerate().filter(|(cell, _)| mask[*cell] != 0)
        {
            for i in 0..=self.m.d {
                if across[i] == NONE || mask[across[i] as usize] == 0 {
                    let mut facet = *row;
                    facet[i] = NONE;
                    facets.push((sorted(facet), cell as u32, i as u8));
                }
            }
        }
        facets
    }

    fn check_boundary(
        &mut self,
        mask: &[u8],
        call: impl Fn(*mut u32, *mut u32, *mut u8, usize, *mut usize) -> deldrift_status,
    ) {
        let d = self.m.d;
        let facets = self.copied(77, d, |to, room, count| call(to, null_mut(), null_mut(), room, count));
        let cells = self.copied(77, 1, |to, room, count| call(null_mut(), to, null_mut(), room, count));
        let corners = self.copied(77, 1, |to, room, count| call(null_mut(), null_mut(), to, room, count));
        let rows = super::asking::rows(&facets, d);
        let found: Vec<(Row, u32, u8)> = rows
            .into_iter()
            .zip(cells)
            .zip(corners)
            .map(|((row, cell), corner)| (sorted(row), cell, corner))
            .collect();
        assert_eq!(found, self.wanted_boundary(mask), "boundary");
    }

    fn boundary(&mut self) {
        let t = self.t;
        let n = self.cells().0.len();
        let mask: Vec<u8> = (0..n).map(|_| self.s.byte() & 1).collect();
        self.check_boundary(&mask, |facets, cells, corners, room, count| {
            c!(deldrift_mask_boundary(t, mask.as_ptr(), n, facets, cells, corners, room, count))
        });
    }

    fn hull(&mut self) {
        let t = self.t;
        let mask = vec![1; self.cells().0.len()];
        self.check_boundary(&mask, |facets, cells, corners, room, count| {
            c!(deldrift_hull_facets(t, facets, cells, corners, room, count))
        });
    }

    fn wanted_edges(&self) -> Vec<[u32; 2]> {
        let n = self.m.d + 1;
        let (rows, _) = self.cells();
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |k| (i, k)));
        let edges =
            rows.iter().flat_map(|row| pairs.clone().map(|(i, k)| [row[i].min(row[k]), row[i].max(row[k])]));
        edges.collect::<BTreeSet<_>>().into_iter().collect()
    }

    fn edges(&mut self) {
        let t = self.t;
        let found = self.copied(77, 2, |to, room, count| c!(deldrift_edges(t, to, room, count)));
        assert_eq!(found, self.wanted_edges().concat(), "edges");
    }

    /// Compares lists by vertex with those wanted.
    fn check_lists(
        &mut self,
        wanted: &[Vec<u32>],
        call: impl Fn(*mut u32, usize, *mut u32, usize, *mut usize) -> deldrift_status,
    ) {
        let n = wanted.len() + 1;
        let mut offsets = vec![77; n];
        let (mut count, start) = (0, offsets.as_mut_ptr());
        let entries = self.copied(77, 1, |to, room, count| {
            let start = if to.is_null() { null_mut() } else { start };
            call(start, n, to, room, count)
        });
        self.ok(|| call(start, n, null_mut(), 0, &mut count));
        let list = |v: usize| entries[offsets[v] as usize..offsets[v + 1] as usize].to_vec();
        let found: Vec<Vec<u32>> = (0..wanted.len()).map(list).collect();
        assert_eq!((found.as_slice(), count), (wanted, entries.len()), "lists by vertex");
    }

    fn vertex_neighbours(&mut self) {
        let t = self.t;
        let mut wanted = vec![Vec::new(); self.m.positions.len()];
        for [a, b] in self.wanted_edges() {
            wanted[a as usize].push(b);
            wanted[b as usize].push(a);
        }
        wanted.iter_mut().for_each(|list| list.sort_unstable());
        self.check_lists(&wanted, |offsets, n, to, room, count| {
            c!(deldrift_vertex_neighbours(t, offsets, n, to, room, count))
        });
    }

    fn vertex_cells(&mut self) {
        let t = self.t;
        let mut wanted = vec![Vec::new(); self.m.positions.len()];
        for (cell, row) in (0..).zip(self.cells().0) {
            row[..=self.m.d].iter().for_each(|&v| wanted[v as usize].push(cell));
        }
        self.check_lists(&wanted, |offsets, n, to, room, count| {
            c!(deldrift_vertex_cells(t, offsets, n, to, room, count))
        });
    }

    /// Some vertices that are present, maybe more than once.
    fn some_vertices(&mut self) -> Vec<u32> {
        let present: Vec<u32> = self.m.present().collect();
        let n = if present.is_empty() { 0 } else { self.s.below(6) };
        (0..n).map(|_| present[self.s.below(present.len())]).collect()
    }

    fn cells_around(&mut self) {
        let t = self.t;
        let vertices = self.some_vertices();
        let (start, n) = (vertices.as_ptr(), vertices.len());
        let found =
            self.copied(77, 1, |to, room, count| c!(deldrift_cells_around(t, start, n, to, room, count)));
        let (rows, _) = self.cells();
        let is_around = |row: &Row| row.iter().any(|v| vertices.contains(v));
        let cells = (0..).zip(&rows).filter(|(_, row)| is_around(row));
        let wanted: Vec<u32> = cells.map(|(cell, _)| cell).collect();
        assert_eq!(found, wanted, "cells around {vertices:?}");
        // Whatever has been taken, what vertices that move have in common with others is marked.
        let mask =
            self.copied(77, 1, |to, room, count| c!(deldrift_voronoi_changed(t, start, n, to, room, count)));
        assert_eq!(mask.len(), self.m.positions.len());
        let beside = rows.iter().filter(|row| is_around(row)).flatten();
        assert!(beside.chain(&vertices).all(|&v| mask.get(v as usize).is_none_or(|&x| x == 1)));
    }

    /// Entries of listed cells become those of a pass over all, and others stay.
    fn update(&mut self) {
        let (t, d, n) = (self.t, self.m.d, self.cells().0.len());
        let n_listed = if n == 0 { 0 } else { self.s.below(8) };
        let mut cells: Vec<u32> = (0..n_listed).map(|_| self.s.below(n) as u32).collect();
        let limit = self.s.magnitude().abs();
        // As entries that no pass gives.
        let (mut centres, mut squares) = (vec![f64::NAN; n * d], vec![-1.0; n]);
        let (mut volumes, mut mask) = (vec![-1.0; n], vec![77; n]);
        let is_wrong = self.s.below(4) == 0;
        let wanted = if is_wrong {
            cells.push(n as u32);
            DELDRIFT_NO_SUCH_FACET
        } else {
            DELDRIFT_OK
        };
        let (start, count) = (cells.as_ptr(), cells.len());
        let [to_centres, to_squares, to_volumes] =
            [&mut centres, &mut squares, &mut volumes].map(|v| v.as_mut_ptr());
        let to_mask = mask.as_mut_ptr();
        self.expect(wanted, || c!(deldrift_update_circumcentres(t, start, count, to_centres, to_squares, n)));
        self.expect(wanted, || c!(deldrift_update_volumes(t, start, count, to_volumes, n)));
        self.expect(wanted, || c!(deldrift_update_mask_by_circumradius(t, start, count, limit, to_mask, n)));
        let (mut all_centres, mut all_squares) = (vec![f64::NAN; n * d], vec![-1.0; n]);
        let (mut all_volumes, mut all_mask, mut n_all) = (vec![-1.0; n], vec![77; n], 0);
        let (to_centres, to_squares) = (all_centres.as_mut_ptr(), all_squares.as_mut_ptr());
        self.is_ok(c!(deldrift_circumcentres(t, to_centres, to_squares, n, &mut n_all)));
        self.is_ok(c!(deldrift_volumes(t, all_volumes.as_mut_ptr(), n, &mut n_all)));
        self.is_ok(c!(deldrift_mask_by_circumradius(t, limit, all_mask.as_mut_ptr(), n, &mut n_all)));
        for cell in 0..n {
            if is_wrong || !cells.contains(&(cell as u32)) {
                let entries = (squares[cell], volumes[cell], mask[cell]);
                assert_eq!(entries, (-1.0, -1.0, 77), "entries of cell {cell}, which is not listed");
                assert!(centres[cell * d..][..d].iter().all(|x| x.is_nan()), "centre of cell {cell}");
                continue;
            }
            let found = (&centres[cell * d..][..d], squares[cell], volumes[cell], mask[cell]);
            let all = (&all_centres[cell * d..][..d], all_squares[cell], all_volumes[cell], all_mask[cell]);
            assert_eq!(found, all, "entries of cell {cell}");
        }
        if n > 0 {
            let small = DELDRIFT_BUFFER_TOO_SMALL;
            self.expect(small, || c!(deldrift_update_volumes(t, start, count, to_volumes, n - 1)));
        }
    }

    fn mirrors(&mut self) {
        let (t, corners) = (self.t, self.m.d + 1);
        let found =
            self.copied(77, corners, |to, room, count| c!(deldrift_mirror_indices(t, to, room, count)));
        let (rows, neighbours) = self.cells();
        let wanted = |cell: usize, i: usize| match neighbours[cell][i] {
            NONE => u8::MAX,
            other => {
                let opposite = |&k: &usize| !rows[cell].contains(&rows[other as usize][k]);
                (0..corners).find(opposite).expect("one corner is opposite") as u8
            }
        };
        for (k, &mirror) in found.iter().enumerate() {
            assert_eq!(mirror, wanted(k / corners, k % corners), "mirror index {k}");
        }
        if found.is_empty() {
            return;
        }
        let k = self.s.below(found.len());
        let (cell, corner, mut one) = ((k / corners) as u32, (k % corners) as u32, 77);
        self.ok(|| c!(deldrift_mirror_index(t, cell, corner, &mut one)));
        assert_eq!(one, if found[k] == u8::MAX { NONE } else { u32::from(found[k]) });
    }

    fn ordered_star(&mut self) {
        let t = self.t;
        let Some((v, centre, wanted, rows)) = self.some_star() else { return };
        if self.m.d == 3 {
            let mut count = 77;
            self.expect(DELDRIFT_INVALID_DIMENSION, || {
                c!(deldrift_ordered_star(t, v, null_mut(), 0, &mut count))
            });
            return;
        }
        let found = self.copied(77, 1, |to, room, count| c!(deldrift_ordered_star(t, v, to, room, count)));
        let set: BTreeSet<u32> = found.iter().copied().collect();
        assert!(set.iter().eq(&wanted) && set.len() == found.len(), "star of {v}: {found:?}, not {wanted:?}");
        // The corners that follow the centre, counter-clockwise.
        let next = |cell: u32, steps: usize| {
            let row = rows[cell as usize];
            let at = row.iter().position(|&w| w == centre).expect("in the star");
            row[(at + steps) % 3]
        };
        let meets = |pair: &[u32]| next(pair[0], 2) == next(pair[1], 1);
        assert!(found.windows(2).all(meets), "star of {v} is not in order: {found:?}");
        if let [first, .., last] = found[..] {
            let is_closed = meets(&[last, first]);
            assert!(
                !is_closed || found.len() == 2 || Some(&first) == found.iter().min(),
                "star of {v}: {found:?}"
            );
        }
    }

    /// Whether sums of squares and products are far from the ends of the range.
    pub(super) fn is_moderate(&self) -> bool {
        self.m.positions.iter().flatten().flatten().all(|&x| x == 0.0 || (1e-20..1e20).contains(&x.abs()))
    }

    fn voronoi(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (low, high) = ([-3.0; 3], [4.0; 3]);
        let is_boxed = self.s.below(3) != 0;
        let [low, high] = if is_boxed { [low.as_ptr(), high.as_ptr()] } else { [null(); 2] };
        let volumes = self
            .copied(-7.0, 1, |to, room, count| c!(deldrift_voronoi_volumes(t, low, high, to, room, count)));
        assert_eq!(volumes.len(), self.m.positions.len());
        let has_cells = !self.cells().0.is_empty();
        let representatives = self.m.representatives();
        for (v, &volume) in volumes.iter().enumerate() {
            let is_right = match representatives[v] {
                NONE => volume.is_nan(),
                first if first as usize != v => volume == 0.0,
                _ if !has_cells && !is_boxed => volume == f64::INFINITY,
                _ => volume >= 0.0,
            };
            assert!(is_right, "Voronoi volume of {v}: {volume}");
        }
        let is_easy = self.style.is_easy() && self.is_moderate();
        let is_easy = is_easy && self.m.positions.iter().flatten().flatten().all(|x| x.abs() < 10.0);
        if self.m.positions.iter().any(Option::is_some) && is_boxed && is_easy {
            let sum: f64 = volumes.iter().filter(|volume| !volume.is_nan()).sum();
            let wanted = 7f64.powi(d as i32);
            assert!((sum - wanted).abs() < 1e-6 * wanted, "Voronoi volumes add up to {sum}, not {wanted}");
        }
        let facets = self
            .copied(-7.0, 1, |to, room, count| c!(deldrift_voronoi_facets(t, low, high, to, room, count)));
        assert_eq!(facets.len(), self.wanted_edges().len());
        assert!(facets.iter().all(|&measure| measure >= 0.0), "{facets:?}");
        let (none, nowhere) = (null(), null_mut());
        let again = self.copied(-7.0, 1, |to, room, count| {
            c!(deldrift_voronoi_cells(t, low, high, none, 0, to, nowhere, nowhere, room, count))
        });
        let measures = self.copied(-7.0, 1, |to, room, count| {
            c!(deldrift_voronoi_derivatives(t, low, high, none, 0, to, nowhere, nowhere, room, count))
        });
        let [mut cells, mut sides] = [vec![0.0; again.len()], vec![0.0; measures.len() + 1]];
        let (mut count, mut n_edges) = (0, 0);
        self.ok(|| {
            let (to, room) = (cells.as_mut_ptr(), cells.len());
            let (to_sides, of_sides) = (sides.as_mut_ptr(), sides.len());
            c!(deldrift_voronoi_cells_and_facets(
                t,
                low,
                high,
                null(),
                0,
                null(),
                0,
                to,
                nowhere,
                nowhere,
                room,
                &mut count,
                to_sides,
                nowhere,
                nowhere,
                of_sides,
                &mut n_edges
            ))
        });
        sides.truncate(n_edges);
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&again), bits(&volumes));
        assert_eq!(bits(&cells), bits(&volumes));
        assert!(
            bits(&measures) == bits(&facets) && bits(&sides) == bits(&facets),
            "{measures:?}, not {facets:?}"
        );
        if is_boxed {
            self.voronoi_halves(&again);
        }
    }

    /// What both sides of a plane have of each Voronoi cell is what there is of it.
    fn voronoi_halves(&mut self, wholes: &[f64]) {
        let (t, d) = (self.t, self.m.d);
        let (low, high) = ([-3.0; 3], [4.0; 3]);
        let mut row: Vec<f64> = (0..=d).map(|_| self.s.below(9) as f64 - 4.0).collect();
        row[0] += 0.5;
        let other: Vec<f64> = row.iter().map(|x| -0.25 * x).collect();
        // The second one is there twice, and there is one that contains the box.
        let beside: Vec<f64> = (0..=d).map(|k| if k == d { 100.0 } else { 1.0 }).collect();
        let sides = [(row, 1), ([other.clone(), beside.clone(), other].concat(), 3)];
        let [one, two] = sides.map(|(rows, n)| {
            self.copied(-7.0, 1, |to, room, count| {
                let (low, high, rows) = (low.as_ptr(), high.as_ptr(), rows.as_ptr());
                let (none, nowhere) = (null(), null_mut());
                c!(deldrift_voronoi_cells_within(
                    t, low, high, rows, n, none, 0, to, nowhere, nowhere, room, count
                ))
            })
        });
        let measures = self.copied(-7.0, 1, |to, room, count| {
            let (low, high, rows) = (low.as_ptr(), high.as_ptr(), beside.as_ptr());
            let (none, nowhere) = (null(), null_mut());
            c!(deldrift_voronoi_derivatives_within(
                t, low, high, rows, 1, none, 0, to, nowhere, nowhere, room, count
            ))
        });
        assert!(measures.iter().all(|&measure| measure >= 0.0), "{measures:?}");
        let most = 1e-5 * 7f64.powi(d as i32);
        for (v, whole) in wholes.iter().enumerate() {
            let sum = one[v] + two[v];
            let is_right = whole.is_nan() && sum.is_nan() || (sum - whole).abs() < most;
            assert!(is_right, "halves of the cell of {v} are {} and {}, not {whole}", one[v], two[v]);
        }
    }

    fn interpolate(&mut self) {
        let (t, d, n_ids) = (self.t, self.m.d, self.m.positions.len());
        let (method, n_values) = (self.s.below(2) as u32, 1 + self.s.below(2));
        let values: Vec<f64> = (0..n_ids * n_values).map(|k| k as f64).collect();
        let count = self.s.below(4);
        let places: Vec<Place> = (0..count).map(|_| self.place()).collect();
        let numbers = flattened(&places, d);
        let outside = vec![-3.0; n_values];
        let mut found = vec![f64::NAN; count * n_values];
        self.ok(|| {
            let (values, positions) = (values.as_ptr(), numbers.as_ptr());
            let results = found.as_mut_ptr();
            let (near, beyond) = (null(), outside.as_ptr());
            c!(deldrift_interpolate(
                t, method, values, n_ids, n_values, positions, count, near, beyond, results
            ))
        });
        for (q, found) in places.iter().zip(found.chunks(n_values)) {
            if let Some(v) = self.m.first_at(q) {
                assert_eq!(found, &values[v as usize * n_values..][..n_values], "the value at vertex {v}");
            } else if self.cells().0.is_empty() {
                assert_eq!(found, outside, "outside");
            } else if self.is_moderate() && method == 0 {
                let [low, high] = [-3.0, (n_ids * n_values) as f64];
                assert!(found.iter().all(|x| (low - 1e-6..=high).contains(x)), "{found:?} at {q:?}");
            }
        }
    }
}
