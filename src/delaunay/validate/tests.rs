//! Every violation that can be planted is found, at its level, and named.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::ids::{SiteId, VertexId};
use crate::machine::threads::Threads;
use crate::random::Rng;

fn built<G: Geometry>(points: &[G::Point]) -> Delaunay<G> {
    let mut t = Delaunay::<G>::on(Threads::ONE).expect("room");
    t.add_sites(points).expect("room");
    t.rebuild(&mut |_| true).expect("room");
    t.validate(Level::Delaunay).expect("valid at first");
    t
}

fn cloud<G: Geometry>() -> Delaunay<G> {
    let rng = &mut Rng::new(5);
    let mut points = vec![G::Point::default(); 60];
    points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] = rng.unit()));
    built(&points)
}

/// Plants a fault in a cloud; it is found at this level, not below, and the message contains this.
#[track_caller]
fn finds<G: Geometry>(level: Level, message: &str, plant: impl FnOnce(&mut Delaunay<G>)) {
    let mut t = cloud::<G>();
    plant(&mut t);
    is_found(&t, level, message);
}

#[track_caller]
fn is_found<G: Geometry>(t: &Delaunay<G>, level: Level, message: &str) {
    for below in [Level::Structure, Level::Embedding].into_iter().filter(|&below| below < level) {
        t.validate(below).expect("valid below the level of the fault");
    }
    let violation = t.validate(Level::Delaunay).expect_err(message);
    assert_eq!(violation.level, level, "{violation}");
    assert!(violation.to_string().contains(message), "{violation}");
}

/// Puts a vertex elsewhere, and changes nothing else.
fn place<G: Geometry>(t: &mut Delaunay<G>, id: u32, point: G::Point) {
    let s = t.live_sites().find(|&s| t.site(s).id == VertexId::new(id)).expect("a vertex");
    t.sites[s].point = point;
}

/// A finite cell, and its corners.
fn finite<G: Geometry>(t: &Delaunay<G>) -> (Slot, G::Corners) {
    let c = t.complex.finite().next().expect("a cell");
    (c, t.complex.cell(c).corners)
}

fn faults_of_structure<G: Geometry>() {
    let finds = |message, plant: fn(&mut Delaunay<G>)| finds::<G>(Level::Structure, message, plant);
    finds("is outside the box for which the filters hold", |t| t.sites[5].point[0] = 1e9);
    finds("has no such site 999", |t| {
        let (c, corners) = finite(t);
        t.complex.put(c, corners.with(0, SiteId::new(999)));
    });
    finds("has a removed corner", |t| t.sites[7].id = VertexId::NONE);
    finds("the ghost corner of (infinite, ", |t| {
        let (c, corners) = finite(t);
        t.complex.put(c, corners.with(0, INFINITE));
    });
    finds("has a corner twice", |t| {
        let (c, corners) = finite(t);
        t.complex.put(c, corners.with(0, corners[1]));
    });
    finds("has no neighbour opposite corner", |t| {
        let (c, _) = finite(t);
        let across = t.complex.cell(c).neighbour(0).cell();
        t.complex.release(across);
    });
    finds("do not meet in a facet", |t| {
        let (c, _) = finite(t);
        let other = t.complex.cell(t.complex.cell(c).neighbour(0).cell()).neighbour(0);
        t.complex.glue(Facet::new(c, 1), other);
    });
    finds("is listed as free, and is not", |t| {
        let (c, corners) = finite(t);
        t.complex.release(c);
        t.complex.put(c, corners);
    });
    finds(" cells are free, and ", |t| {
        t.complex.reserve(1).expect("room");
        let c = t.complex.create_blank(Slot::new(0));
        t.complex.release(c);
        t.complex.release(c);
    });
    finds(" cells are free, and ", |t| {
        t.complex.reserve(1).expect("room");
        t.complex.create_blank(Slot::new(0));
    });
    finds("does not have it", |t| {
        let (c, corners) = finite(t);
        let other = t.live_sites().find(|&s| (0..G::Corners::N).all(|i| corners[i] != s)).expect("a site");
        t.sites[other].cell = c;
    });
    finds("of the ghost vertex is no ghost", |t| t.sites[INFINITE].cell = finite(t).0);
    finds("where walks begin, is gone", |t| t.recent = Slot::at(t.complex.n_slots()));
}

/// Vertices that leave their stars, a hull that is dented, and one that has more facets than are counted.
fn faults_of_embedding<G: Geometry>() {
    finds::<G>(Level::Embedding, "is not positively oriented", |t| {
        let far = t.sites[9].point;
        t.sites[5].point = far;
    });
    finds::<G>(Level::Embedding, "counted", |t| t.complex.retire_ghosts(1));
}

#[test]
fn faults_of_structure_are_found() {
    faults_of_structure::<Plane>();
    faults_of_structure::<Space>();
}

#[test]
fn faults_of_embedding_are_found() {
    faults_of_embedding::<Plane>();
    faults_of_embedding::<Space>();
    let mut t = built::<Plane>(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 5.0], [0.0, 4.0], [2.0, 2.0]]);
    place(&mut t, 3, [2.0, 3.0]);
    is_found(&t, Level::Embedding, "the hull is not convex between ");
}

/// Two cells with a facet in common, whose other two vertices come so near that each is in the sphere of the other
/// cell.
#[test]
fn vertices_inside_spheres_are_found() {
    let mut t = built::<Plane>(&[[0.0, 0.0], [8.0, 0.0], [4.0, 9.0], [4.0, -9.0]]);
    place(&mut t, 2, [4.0, 1.0]);
    place(&mut t, 3, [4.0, -1.0]);
    is_found(&t, Level::Delaunay, "is inside the sphere of cell (");
    let mut t = built::<Space>(&[
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 0.0],
        [4.0, 6.0, 0.0],
        [4.0, 2.0, 9.0],
        [4.0, 2.0, -9.0],
    ]);
    assert_eq!(t.complex.n_finite(), 2);
    place(&mut t, 3, [4.0, 2.0, 1.0]);
    place(&mut t, 4, [4.0, 2.0, -1.0]);
    is_found(&t, Level::Delaunay, "is inside the sphere of cell (");
}

#[test]
fn flat_sets_with_sites_elsewhere_are_found() {
    let mut t = built::<Plane>(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]);
    place(&mut t, 1, [1.5, 0.0]);
    is_found(&t, Level::Structure, "is not at its place");
}
