//! Numbers of cells beside those of their corners alone, and boundaries by their definition.

use crate::delaunay::{Moving, Plane, Space};
use crate::error::Error;
use crate::ids::CellId;
use crate::motion::{MovingTriangulation, NO_CELL, Options};
use crate::periodic::PeriodicTriangulation;
use crate::random::Rng;

/// A cell of corners that are where the shifts have them is triangulated alone.
fn check<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let points: Vec<G::Point> = (0..n)
        .map(|_| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = rng.below(3 << 20) as f64 / f64::from(1 << 20) - 1.0);
            p
        })
        .collect();
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let (cells, shifts): (_, Vec<_>) = (t.cells().unwrap(), t.cell_shifts().unwrap().collect());
    let (mut spheres, mut volumes, mut is_small) = (Vec::new(), Vec::new(), Vec::new());
    let bound = 0.25 / (n as f64).powf(2.0 / G::D as f64);
    t.for_circumspheres(None, |_, sphere| spheres.push(sphere)).unwrap();
    t.for_volumes(None, |_, volume| volumes.push(volume)).unwrap();
    t.for_mask_by_circumradius(bound, None, |_, is_in| is_small.push(is_in)).unwrap();
    for (c, row) in cells.corners.iter().enumerate() {
        let mut corners = Vec::new();
        for (v, shift) in row.as_ref().iter().zip(&shifts[c * (G::D + 1)..]) {
            let mut place = points[*v];
            for (vector, &n) in basis.iter().zip(shift) {
                (0..G::D).for_each(|axis| place[axis] += n as f64 * vector[axis]);
            }
            corners.push(place);
        }
        let alone = MovingTriangulation::<G>::new(&corners, Options::default()).unwrap();
        let (centre, squared) = alone.circumspheres().unwrap().next().unwrap();
        let radius = squared.sqrt();
        for axis in 0..G::D {
            assert!((spheres[c].0[axis] - centre[axis]).abs() < 2e-9 * radius + 1e-14, "{seed}: {spheres:?}");
        }
        assert!((spheres[c].1 - squared).abs() < 8e-9 * squared);
        let volume = alone.volumes().unwrap().next().unwrap();
        assert!((volumes[c] - volume).abs() < 2e-9 * volume);
        assert_eq!(is_small[c], alone.mask_by_circumradius(bound).unwrap().next().unwrap(), "{seed}: {c}");
    }
    // Some of them again, with the bits of all.
    let some: Vec<CellId> = (0..8).map(|_| CellId::at(rng.below(volumes.len()))).collect();
    let mut listed = Vec::new();
    t.for_volumes(Some(&some), |cell, volume| listed.push((cell, volume))).unwrap();
    assert!(
        listed.iter().zip(&some).all(|((cell, volume), wanted)| cell == wanted && *volume == volumes[*cell])
    );
    t.for_circumspheres(Some(&some), |cell, sphere| assert_eq!(sphere, spheres[cell])).unwrap();
    t.for_mask_by_circumradius(bound, Some(&some), |cell, is_in| assert_eq!(is_in, is_small[cell])).unwrap();
    let mask: Vec<u8> = is_small.iter().map(|&is_in| is_in.into()).collect();
    check_boundaries(&t, &mask);
    let beyond = [CellId::at(0), CellId::at(volumes.len())];
    assert!(matches!(t.for_volumes(Some(&beyond), |_, _| ()), Err(Error::NoSuchCell { index: 1, .. })));
    let negative = t.for_mask_by_circumradius(-1.0, None, |_, _| ());
    assert!(matches!(negative, Err(Error::InvalidValue { argument: "squared_radius", .. })));
    assert!(matches!(
        t.mask_boundary(&mask[1..], |_| ()),
        Err(Error::WrongCount { argument: "mask_count", .. })
    ));
}

fn check_boundaries<G: Moving>(t: &PeriodicTriangulation<G>, mask: &[u8]) {
    let cells = t.cells().unwrap();
    let (mut expected, mut hull) = (Vec::new(), Vec::new());
    for (c, row) in cells.neighbours.iter().enumerate() {
        for (corner, &across) in row.as_ref().iter().enumerate() {
            if across == NO_CELL {
                hull.push((c, corner));
            }
            if mask[c] != 0 && (across == NO_CELL || mask[across.index()] == 0) {
                expected.push((c, corner));
            }
        }
    }
    let mut found = Vec::new();
    t.mask_boundary(mask, |facet| {
        let others = cells.corners[facet.cell].as_ref();
        let opposite = others[facet.corner];
        let [mut here, mut all] = [facet.vertices().to_vec(), others.to_vec()];
        here.push(opposite);
        here.sort();
        all.sort();
        assert_eq!(here, all);
        found.push((facet.cell.index(), facet.corner));
    })
    .unwrap();
    assert!(found == expected);
    found.clear();
    t.hull_facets(|facet| found.push((facet.cell.index(), facet.corner))).unwrap();
    assert!(found == hull && (t.vector_count() < G::D || hull.is_empty()));
}

#[test]
fn cells_have_the_numbers_of_their_corners() {
    for seed in 0..10 {
        let n = [1, 2, 3, 7, 40][seed as usize % 5];
        check::<Plane>(seed, n, &[[1.0, 0.0], [0.375, 1.0]]);
        check::<Plane>(seed, n + 4, &[[1.0, 0.0]]);
        check::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.5]]);
        check::<Space>(seed, n + 5, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0]]);
    }
}
