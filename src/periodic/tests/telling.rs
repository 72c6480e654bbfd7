//! What meets what, and files, beside copies and readers of the tests' own; checks find what is wrong.

use super::*;
use crate::ids::CellId;
use crate::motion::{Field, Level, NO_CORNER};

/// By vertex, the cells and the ends of edges at it among copies from -n to n, in an open triangulation.
fn around_in_copies<G: Moving>(
    points: &[G::Point],
    basis: &[G::Point],
    n: i64,
) -> (Vec<usize>, Vec<Vec<u32>>) {
    let (mut all, mut places) = (Vec::new(), Vec::new());
    let range = |j: usize| if j < basis.len() { -n..=n } else { 0..=0 };
    for x in range(0) {
        for y in range(1) {
            for z in range(2) {
                for v in 0..points.len() as u32 {
                    all.push((v, [x, y, z] == [0; 3]));
                    places.push(place::<G>(points, basis, v, [x, y, z]));
                }
            }
        }
    }
    let keys: Vec<u64> = all.iter().map(|&(v, _)| v.into()).collect();
    let t = MovingTriangulation::<G>::with_keys(&places, &keys, Options::default()).unwrap();
    let (cells, neighbours) = (t.vertex_cells().unwrap(), t.vertex_neighbours().unwrap());
    let mut found = (vec![0; points.len()], vec![Vec::new(); points.len()]);
    for (k, &(v, is_middle)) in all.iter().enumerate() {
        if is_middle {
            let middle = VertexId::at(k);
            found.0[v as usize] = cells.row(middle).len();
            let ends = neighbours.row(middle).iter().map(|w| all[w.index()].0);
            found.1[v as usize] = ends.collect();
            found.1[v as usize].sort_unstable();
        }
    }
    found
}

fn check_incidence<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let mut points = random_points::<G>(rng, n, basis);
    if n > 3 {
        // A vertex that is hidden, by one in another period.
        points[3] = place::<G>(&points, basis, 1, [1, 0, 0]);
    }
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let view = t.cells().unwrap();
    let (n_cells, neighbours) = around_in_copies::<G>(&points, basis, 3);
    let (met, ends) = (t.vertex_cells().unwrap(), t.vertex_neighbours().unwrap());
    let (first, hidden) = (t.cell_of_each_vertex().unwrap(), t.hidden_vertices().unwrap());
    assert_eq!(hidden, if n > 3 { vec![(VertexId::new(3), VertexId::new(1))] } else { vec![] });
    for v in VertexId::range(0..n) {
        let row = met.row(v);
        assert_eq!(row.len(), n_cells[v.index()], "seed {seed}, {n} in {}D", G::D);
        assert!(row.is_sorted() && row.iter().all(|&c| view.corners[c].as_ref().contains(&v)));
        assert_eq!(VertexId::numbers_of(ends.row(v)), neighbours[v.index()], "seed {seed}, {n} in {}D", G::D);
        assert_eq!(first[v], row.first().copied().unwrap_or(NO_CELL));
        let shown = t.coincident_representative(v).unwrap();
        assert_eq!(t.star(v).unwrap(), met.row(shown));
        let mut each_once = row.to_vec();
        each_once.dedup();
        assert_eq!(t.cells_around(&[v, v]).unwrap(), each_once);
    }
    let all: Vec<VertexId> = VertexId::range(0..n).collect();
    assert_eq!(t.cells_around(&all).unwrap().len(), view.corners.len());
    let mirrors: Vec<[u8; 4]> = t.mirror_indices().unwrap().collect();
    for (c, row) in view.neighbours.iter().enumerate() {
        for (i, &across) in row.as_ref().iter().enumerate() {
            let mirror = mirrors[c][i];
            let alone = t.mirror_index(CellId::at(c), i).unwrap();
            assert_eq!(alone.map_or(NO_CORNER, |corner| corner as u8), mirror);
            if across == NO_CELL {
                assert_eq!(mirror, NO_CORNER);
                continue;
            }
            let mirror = usize::from(mirror);
            assert_eq!(view.neighbours[across].as_ref()[mirror], CellId::at(c));
            assert_eq!(usize::from(mirrors[across.index()][mirror]), i);
            let facet = |cell: usize, but: usize| {
                let mut facet = view.corners[cell].as_ref().to_vec();
                facet.remove(but);
                facet.sort_unstable();
                facet
            };
            assert_eq!(facet(c, i), facet(across.index(), mirror));
        }
    }
    for level in [Level::Structure, Level::Embedding, Level::Delaunay] {
        assert_eq!(t.violation(level), Ok(None));
    }
}

#[test]
fn what_meets_is_as_among_copies() {
    for seed in 0..24 {
        let n = [1, 2, 5, 30][seed as usize % 4];
        check_incidence::<Plane>(seed, n, &[[1.0, 0.0], [0.375, 1.0]]);
        check_incidence::<Plane>(seed, n, &[[1.0, 0.25]]);
    }
    for seed in 0..6 {
        let n = [1, 5, 12][seed as usize % 3];
        check_incidence::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.0, 1.0]]);
    }
}

#[test]
fn what_is_wrong_is_found() {
    let basis = [[1.0, 0.0], [0.0, 1.0]];
    let points = random_points::<Plane>(&mut Rng::new(1), 20, &basis);
    let made = || PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
    let message = |t: PeriodicTriangulation<Plane>, level| {
        t.violation(level).unwrap().map(|violation| violation.message).unwrap_or_default()
    };
    // An image that has been moved on its own.
    let mut t = made();
    let image = VertexId::at(t.inside.images.len() - 1);
    let position = t.inside.t.position(image).unwrap();
    t.inside.t.move_vertices(&[image], &[[position[0] + 0.0625, position[1]]]).unwrap();
    t.inside.t.commit_timestamp().unwrap();
    assert!(message(t, Level::Structure).contains("is not where the vectors take it"));
    // One that has gone: nothing inside is wrong.
    let mut t = made();
    let n = t.vertex_count();
    let home: Vec<[f64; 2]> = t.inside.places[..n].to_vec();
    let keys: Vec<u64> =
        t.inside.images.as_slice()[..n].iter().map(|image| image.vertex.get().into()).collect();
    t.inside.t = MovingTriangulation::with_keys(&home, &keys, Options::default()).unwrap();
    t.inside.images.truncate(n);
    assert_eq!(message(t.try_clone(None).unwrap(), Level::Embedding), "");
    assert_eq!(message(t, Level::Delaunay), "images are missing");
}

/// Texts and bytes that are handed on in chunks.
fn written(write: impl FnOnce(&mut dyn FnMut(&[u8]) -> Result<(), Error>) -> Result<(), Error>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut |more| {
        bytes.extend_from_slice(more);
        Ok(())
    })
    .unwrap();
    bytes
}

fn check_files<G: Moving>(n: usize, basis: &[G::Point]) {
    let n_corners = G::D + 1;
    let mut points = random_points::<G>(&mut Rng::new(2), n, basis);
    points[n - 1] = points[0];
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    t.stage_removals(&[VertexId::new(1)]).unwrap();
    t.commit_timestamp().unwrap();
    let cells = t.cells().unwrap();
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let place_of = |c: usize, i: usize| {
        place::<G>(&points, basis, cells.corners[c].as_ref()[i].get(), shifts[c * n_corners + i])
    };
    let mut places: BTreeSet<(u32, [i64; 3])> = BTreeSet::new();
    for (c, row) in cells.corners.iter().enumerate() {
        places.extend(row.as_ref().iter().enumerate().map(|(i, v)| (v.get(), shifts[c * n_corners + i])));
    }
    let in_none = VertexId::range(0..n)
        .filter(|&v| t.is_present(v) && !cells.corners.iter().any(|row| row.as_ref().contains(&v)));
    places.extend(in_none.map(|v| (v.get(), [0; 3])));
    let expected: Vec<(u32, G::Point)> =
        places.iter().map(|&(v, shift)| (v, place::<G>(&points, basis, v, shift))).collect();
    // The text, word by word.
    let references: Vec<i32> = (0..cells.corners.len() as i32).map(|c| 7 - c).collect();
    let text = String::from_utf8(written(|put| t.write_medit(Some(&references), put))).unwrap();
    let mut words = text.split_whitespace();
    let mut next = || words.next().unwrap();
    for word in ["MeshVersionFormatted", "2", "Dimension", &G::D.to_string(), "Vertices"] {
        assert_eq!(next(), word);
    }
    assert_eq!(next(), expected.len().to_string());
    for (v, point) in &expected {
        (0..G::D).for_each(|axis| assert_eq!(next().parse::<f64>().unwrap(), point[axis]));
        assert_eq!(next(), v.to_string());
    }
    assert_eq!(next(), if G::D == 2 { "Triangles" } else { "Tetrahedra" });
    assert_eq!(next(), cells.corners.len().to_string());
    for (c, reference) in references.iter().enumerate() {
        for i in 0..n_corners {
            let (v, point) = &expected[next().parse::<usize>().unwrap() - 1];
            assert_eq!((*v, point.as_ref()), (cells.corners[c].as_ref()[i].get(), place_of(c, i).as_ref()));
        }
        assert_eq!(next(), reference.to_string());
    }
    assert_eq!((next(), words.next()), ("End", None));
    let more = [&references[..], &[0]].concat();
    let long = t.write_medit::<Error>(Some(&more), |_| Ok(()));
    assert!(matches!(long, Err(Error::WrongCount { argument: "reference_count", .. })));
    // The arrays, one after the other.
    let heat: Vec<f64> = (0..n).map(|v| v as f64).collect();
    let volumes: Vec<f64> = (0..cells.corners.len()).map(|c| c as f64 / 8.0).collect();
    let (of_vertices, of_cells) = (
        [Field { name: "heat", components: 1, values: &heat }],
        [Field { name: "volume", components: 1, values: &volumes }],
    );
    let bytes = written(|put| t.write_vtu(&of_vertices, &of_cells, put));
    let start = bytes.windows(2).position(|pair| pair == b"\n_").unwrap() + 2;
    let mut rest = &bytes[start..];
    let mut array = || {
        let (size, more) = rest.split_at(8);
        let (array, more) = more.split_at(u64::from_le_bytes(size.try_into().unwrap()) as usize);
        rest = more;
        array
    };
    let numbers = |bytes: &[u8]| {
        bytes.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().unwrap())).collect::<Vec<_>>()
    };
    let coordinates = numbers(array());
    for (row, (_, point)) in coordinates.chunks_exact(3).zip(&expected) {
        assert_eq!((&row[..G::D], &row[G::D..]), (point.as_ref(), &[0.0, 0.0][..3 - G::D]));
    }
    let connected = array().chunks_exact(8).map(|x| u64::from_le_bytes(x.try_into().unwrap()) as usize);
    for (k, number) in connected.enumerate() {
        let (v, point) = &expected[number];
        let (c, i) = (k / n_corners, k % n_corners);
        assert_eq!((*v, point.as_ref()), (cells.corners[c].as_ref()[i].get(), place_of(c, i).as_ref()));
    }
    let (offsets, types) = (array().len(), array().len());
    assert_eq!((offsets, types), (8 * cells.corners.len(), cells.corners.len()));
    let ids = array().chunks_exact(4).map(|x| u32::from_le_bytes(x.try_into().unwrap()));
    assert!(ids.eq(expected.iter().map(|&(v, _)| v)));
    assert!(numbers(array()).iter().zip(&expected).all(|(x, &(v, _))| *x == f64::from(v)));
    assert_eq!(numbers(array()), volumes);
    assert!(rest.starts_with(b"\n</AppendedData>"));
}

#[test]
fn files_hold_cells_together() {
    check_files::<Plane>(9, &[[1.0, 0.0], [0.25, 1.0]]);
    check_files::<Plane>(3, &[[1.0, 0.0]]);
    check_files::<Plane>(6, &[[1.0, 0.0]]);
    check_files::<Space>(8, &[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}
