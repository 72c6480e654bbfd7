//! The cells around some vertices, and arrays that are kept for all cells, where only the entries of some are computed.

use super::*;
use crate::common::inputs::quantized;

/// Arrays that a program keeps for all cells.
struct Kept<G: Dimension> {
    spheres: Vec<(G::Point, f64)>,
    volumes: Vec<f64>,
    mask: Vec<bool>,
    squared_radius: f64,
}

/// How much the change lists have had.
#[derive(Debug, Default)]
struct Counts {
    created: usize,
    renumbered: usize,
    /// Cells that are not new, around vertices that have moved.
    kept: usize,
}

/// Entries follow renumbered cells; those of new cells are `filler` until they are computed.
fn carry<T: Copy>(array: &mut Vec<T>, n: usize, from: &[CellId], to: &[CellId], filler: T) {
    let set_aside: Vec<T> = from.iter().map(|&cell| array[cell]).collect();
    array.resize(n, filler);
    to.iter().zip(set_aside).for_each(|(&cell, entry)| array[cell] = entry);
}

impl<G: Dimension> Kept<G> {
    fn of(t: &MovingTriangulation<G>, squared_radius: f64) -> Self {
        Kept {
            spheres: t.circumspheres().expect("room").collect(),
            volumes: t.volumes().expect("room").collect(),
            mask: t.mask_by_circumradius(squared_radius).expect("room").collect(),
            squared_radius,
        }
    }

    /// Brings them up to date where these vertices have moved since.
    fn update(&mut self, t: &mut MovingTriangulation<G>, moved: &[VertexId], counts: &mut Counts) {
        let n = t.cell_count();
        let changes = t.take_changes().expect("room");
        let (from, to) = (changes.renumbered_from, changes.renumbered_to);
        carry(&mut self.spheres, n, from, to, (G::Point::default(), f64::NAN));
        carry(&mut self.volumes, n, from, to, f64::NAN);
        carry(&mut self.mask, n, from, to, false);
        let created = changes.created.to_vec();
        counts.renumbered += from.len();
        counts.created += created.len();
        let around = t.cells_around(moved).expect("present");
        counts.kept += around.iter().filter(|&cell| created.binary_search(cell).is_err()).count();
        for list in [created, around] {
            let spheres = t.circumspheres_of(&list).expect("cells");
            list.iter().zip(spheres).for_each(|(&cell, sphere)| self.spheres[cell] = sphere);
            let volumes = t.volumes_of(&list).expect("cells");
            list.iter().zip(volumes).for_each(|(&cell, volume)| self.volumes[cell] = volume);
            let mask = t.mask_by_circumradius_of(&list, self.squared_radius).expect("cells");
            list.iter().zip(mask).for_each(|(&cell, is_in)| self.mask[cell] = is_in);
        }
    }

    /// Each value is within the error that is documented, so two are within twice that.
    fn check(&self, t: &MovingTriangulation<G>) {
        let all = Kept::of(t, self.squared_radius);
        assert_eq!(self.mask, all.mask);
        assert_eq!((self.spheres.len(), self.volumes.len()), (all.spheres.len(), all.volumes.len()));
        let rows = t.cells().expect("room").corners;
        for ((centre, squared), ((wanted_centre, wanted), row)) in
            self.spheres.iter().zip(all.spheres.iter().zip(rows))
        {
            assert!((squared - wanted).abs() <= 8e-9 * wanted, "{squared}, not {wanted}");
            let corner = t.position(row[0]).expect("present");
            for axis in 0..G::D {
                let error = (centre[axis] - wanted_centre[axis]).abs();
                let rounding = 1e-15 * (corner[axis].abs() + wanted_centre[axis].abs());
                assert!(error <= 2e-9 * wanted.sqrt() + rounding, "{centre:?}, not {wanted_centre:?}");
            }
        }
        for (volume, wanted) in self.volumes.iter().zip(&all.volumes) {
            assert!((volume - wanted).abs() <= 2e-9 * wanted, "{volume}, not {wanted}");
        }
    }
}

/// Far from where it is, or near.
fn other_place<G: Dimension>(p: &G::Point, kind: Kind, n: usize, rng: &mut Rng) -> G::Point {
    if rng.one_in(4) {
        return draw_one::<G>(kind, n, rng);
    }
    quantized::<G>(point::<G>(|axis| p[axis] + rng.within(-9, 9) as f64 * QUANTUM))
}

/// Vertices move, come and go, few or many at a time, in commits and at once.
fn check_kept_arrays<G: Dimension>() {
    let mut counts = Counts::default();
    for seed in seeds(3) {
        for kind in KINDS {
            let rng = &mut Rng::new(seed);
            let n = [12, 60, 300][(seed as usize + kind as usize) % 3];
            let mut t = with_a_past::<G>(kind, n, rng);
            t.take_changes().expect("room");
            let mut squares: Vec<f64> = t.circumspheres().expect("room").map(|(_, square)| square).collect();
            squares.sort_unstable_by(f64::total_cmp);
            let mut kept = Kept::of(&t, squares.get(squares.len() / 2).copied().unwrap_or(1.0));
            for _ in 0..10 {
                let mut moved = BTreeSet::new();
                for _ in 0..=rng.below(2) {
                    let share = [1, 3, 10, 100][rng.below(4)];
                    for v in VertexId::range(0..t.id_count()) {
                        if rng.one_in(share) && t.is_present(v) {
                            let p = t.position(v).expect("present");
                            let to = other_place::<G>(&p, kind, n, rng);
                            t.move_vertices(&[v], &[to]).expect("a good place");
                            moved.insert(v);
                        }
                    }
                    let coming: Vec<G::Point> =
                        (0..rng.below(4)).map(|_| draw_one::<G>(kind, n, rng)).collect();
                    t.stage_insertions(&coming).expect("good places");
                    t.commit_timestamp().expect("room");
                }
                for _ in 0..rng.below(5) {
                    let v = VertexId::at(rng.below(t.id_count()));
                    if t.is_present(v) {
                        t.remove_vertex(v).expect("present");
                        moved.remove(&v);
                    }
                }
                let v = VertexId::at(rng.below(t.id_count()));
                if t.is_present(v) {
                    t.relocate_vertex(v, &draw_one::<G>(kind, n, rng)).expect("a good place");
                    moved.insert(v);
                }
                kept.update(&mut t, &moved.into_iter().collect::<Vec<_>>(), &mut counts);
                kept.check(&t);
            }
        }
    }
    let Counts { created, renumbered, kept } = counts;
    assert!(created > 1000 && renumbered > 100 && kept > 1000, "{counts:?}");
}

#[test]
fn kept_arrays_are_those_of_all_cells_in_the_plane() {
    check_kept_arrays::<Plane>();
}

#[test]
fn kept_arrays_are_those_of_all_cells_in_space() {
    check_kept_arrays::<Space>();
}

fn check_around<G: Dimension>(t: &MovingTriangulation<G>, rng: &mut Rng) {
    let rows = t.cells().expect("room").corners;
    let present: Vec<VertexId> = VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect();
    let n = present.len();
    assert!(t.cells_around(&[]).expect("none").is_empty());
    for length in [1, 2, 3, n / 50, n / 41, n / 39, n / 4, 2 * n] {
        let n_vertices = if n == 0 { 0 } else { length };
        let vertices: Vec<VertexId> = (0..n_vertices).map(|_| *rng.pick(&present)).collect();
        let listed: BTreeSet<VertexId> = vertices.iter().copied().collect();
        let is_around = |row: &G::Vertices| row.as_ref().iter().any(|v| listed.contains(v));
        let cells = CellId::range(0..rows.len()).zip(rows);
        let wanted: Vec<CellId> = cells.filter(|(_, row)| is_around(row)).map(|(cell, _)| cell).collect();
        assert_eq!(t.cells_around(&vertices).expect("present"), wanted, "{n_vertices} of {n} vertices");
    }
}

#[test]
fn cells_around_vertices_have_them_as_corners() {
    on_all_kinds::<Plane>(check_around);
    on_all_kinds::<Space>(check_around);
    for kind in [Kind::Random, Kind::Duplicates] {
        let rng = &mut Rng::new(5);
        check_around(&with_a_past::<Plane>(kind, 1000, rng), rng);
        check_around(&with_a_past::<Space>(kind, 1000, rng), rng);
    }
}

#[test]
fn hidden_vertices_have_no_cells() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
    let [first, second] = [1, 3].map(VertexId::new);
    let only = [CellId::new(0)];
    assert_eq!(t.cells_around(&[first, second, first]).expect("present"), only);
    assert!(t.cells_around(&[second]).expect("present").is_empty());
    t.remove_vertex(first).expect("present");
    assert_eq!(t.cells_around(&[second]).expect("present"), only);
}

#[test]
fn lists_with_a_wrong_entry_are_refused() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 3.0]];
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
    t.remove_vertex(VertexId::new(3)).expect("present");
    let [good, removed, none] = [0, 3, 4].map(VertexId::new);
    let (argument, index) = ("vertices", 1);
    assert_eq!(
        t.cells_around(&[good, none]),
        Err(Error::NoSuchVertex { argument, index, vertex: none, ids: 4 })
    );
    let refused = Error::RemovedVertex { argument, index, vertex: removed };
    assert_eq!(t.cells_around(&[good, removed]), Err(refused));
    for cell in [1, u32::MAX].map(CellId::new) {
        let list = [CellId::new(0), CellId::new(0), cell];
        let refused = Error::NoSuchCell { argument: "cells", index: 2, cell, cells: 1 };
        assert_eq!(t.circumspheres_of(&list).map(drop), Err(refused.clone()));
        assert_eq!(t.volumes_of(&list).map(drop), Err(refused.clone()));
        assert_eq!(t.mask_by_circumradius_of(&list, 1.0).map(drop), Err(refused));
    }
    let is_refused =
        |squared| matches!(t.mask_by_circumradius_of(&[], squared), Err(Error::InvalidValue { .. }));
    assert!(is_refused(-1.0) && is_refused(f64::NAN) && !is_refused(0.0));
}
