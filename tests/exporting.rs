//! Files for other programs hold the positions and cells that are read, number for number: by readers of the tests'
//! own, and by meshio, VTK and Gmsh where they can be had.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::common::inputs::{KINDS, Kind, draw};
use crate::common::{Rng, skipped, vertex};
use deldrift::motion::{Field, MovingTriangulation, Options, Segment};
use deldrift::{Dimension, Error, Plane, Space, VertexId};

/// A triangulation with removed vertices, and hidden ones where the kind has them.
fn make<G: Dimension>(kind: Kind, n: usize, removes: bool) -> MovingTriangulation<G> {
    let mut positions = draw::<G>(kind, n, &mut Rng::new(3));
    if let Some(first) = positions.first_mut() {
        // As short as can be, and as long.
        (first[0], first[1]) = (-1e57, 0.1 + 0.2);
    }
    let mut t = MovingTriangulation::<G>::new(&positions, Options::default()).expect("a build");
    if removes {
        t.remove_vertex(vertex(1)).expect("a removal");
        t.remove_vertex(vertex(n as u32 - 1)).expect("a removal");
    }
    t
}

fn present<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<VertexId> {
    VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect()
}

fn vtu<G: Dimension>(
    t: &MovingTriangulation<G>,
    vertices: &[Field],
    cells: &[Field],
) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    t.write_vtu::<Error>(vertices, cells, |more| {
        bytes.extend_from_slice(more);
        Ok(())
    })?;
    Ok(bytes)
}

fn medit<G: Dimension>(t: &MovingTriangulation<G>, references: Option<&[i32]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written = t.write_medit::<Error>(references, |more| {
        bytes.extend_from_slice(more);
        Ok(())
    });
    written.expect("room");
    bytes
}

/// The value of an attribute.
fn attribute<'t>(tag: &'t str, name: &str) -> &'t str {
    let (_, value) = tag.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name} in {tag}"));
    value.split_once('"').expect("it ends").0
}

/// What a file holds: the number of points and cells, and by section and name the components and bytes of each array.
struct Grid {
    n_points: usize,
    n_cells: usize,
    arrays: BTreeMap<(String, String), (String, usize, Vec<u8>)>,
}

impl Grid {
    fn read(bytes: &[u8]) -> Self {
        let marker = b"<AppendedData encoding=\"raw\">\n_";
        let at = bytes.windows(marker.len()).position(|window| window == marker).expect("there are arrays");
        let text = std::str::from_utf8(&bytes[..at]).expect("text comes first");
        let data = &bytes[at + marker.len()..];
        let (mut grid, mut section) = (Grid { n_points: 0, n_cells: 0, arrays: BTreeMap::new() }, "");
        let mut end = 0;
        for tag in text.split('<').skip(1) {
            match tag.split([' ', '>']).next().expect("a tag has a name") {
                "VTKFile" => {
                    assert_eq!(attribute(tag, "type"), "UnstructuredGrid");
                    assert_eq!(attribute(tag, "byte_order"), "LittleEndian");
                    assert_eq!(attribute(tag, "header_type"), "UInt64");
                }
                "Piece" => {
                    grid.n_points = attribute(tag, "NumberOfPoints").parse().expect("a number");
                    grid.n_cells = attribute(tag, "NumberOfCells").parse().expect("a number");
                }
                "DataArray" => {
                    assert_eq!(attribute(tag, "format"), "appended");
                    let offset: usize = attribute(tag, "offset").parse().expect("a number");
                    assert_eq!(offset, end, "arrays follow each other");
                    let size =
                        u64::from_le_bytes(data[offset..offset + 8].try_into().expect("a size")) as usize;
                    end = offset + 8 + size;
                    let kind = attribute(tag, "type").to_string();
                    let components = attribute(tag, "NumberOfComponents").parse().expect("a number");
                    let name = (section.to_string(), attribute(tag, "Name").to_string());
                    grid.arrays.insert(name, (kind, components, data[offset + 8..end].to_vec()));
                }
                name => section = name.trim_end_matches(['>', '\n']),
            }
        }
        assert_eq!(&data[end..], b"\n</AppendedData>\n</VTKFile>\n");
        grid
    }

    fn array<const N: usize>(
        &self,
        section: &str,
        name: &str,
        kind: &str,
        components: usize,
    ) -> Vec<[u8; N]> {
        let (found, n, bytes) = &self.arrays[&(section.to_string(), name.to_string())];
        assert_eq!((found.as_str(), *n), (kind, components), "{name}");
        bytes.chunks(N).map(|bytes| bytes.try_into().expect("whole numbers")).collect()
    }

    fn doubles(&self, section: &str, name: &str, components: usize) -> Vec<f64> {
        self.array(section, name, "Float64", components).into_iter().map(f64::from_le_bytes).collect()
    }
}

fn grids_hold_what_is_read<G: Dimension>() {
    for (kind, n, removes) in KINDS.iter().map(|&kind| (kind, 60, true)).chain([(Kind::Random, 0, false)]) {
        let t = make::<G>(kind, n, removes);
        let (ids, cells) = (present(&t), t.cells().expect("room").corners);
        let heights: Vec<f64> = (0..t.id_count()).map(|v| v as f64 + 0.5).collect();
        let sizes: Vec<f64> = (0..2 * cells.len()).map(|c| -(c as f64)).collect();
        let height = Field { name: "height <m> & \"more\"", components: 1, values: &heights };
        let size = Field { name: "size", components: 2, values: &sizes };
        let grid = Grid::read(&vtu(&t, &[height], &[size]).expect("room"));
        assert_eq!((grid.n_points, grid.n_cells), (t.vertex_count(), cells.len()), "{kind:?}");
        let points = grid.doubles("Points", "Points", 3);
        let expected: Vec<f64> = ids
            .iter()
            .flat_map(|&v| {
                let p = t.position(v).expect("present");
                [p[0], p[1], if G::D == 3 { p[G::D - 1] } else { 0.0 }]
            })
            .collect();
        assert_eq!(points, expected, "{kind:?}");
        let names = grid.array("PointData", "vertex", "UInt32", 1).into_iter().map(u32::from_le_bytes);
        assert_eq!(VertexId::of_numbers(&names.collect::<Vec<_>>()), ids, "{kind:?}");
        // Old versions of VTK want one type for both.
        let longs = |name| grid.array("Cells", name, "Int64", 1).into_iter().map(i64::from_le_bytes);
        let corners: Vec<VertexId> = longs("connectivity").map(|k| ids[k as usize]).collect();
        assert_eq!(
            corners,
            cells.iter().flat_map(|row| row.as_ref().to_vec()).collect::<Vec<_>>(),
            "{kind:?}"
        );
        assert!(longs("offsets").eq((1..=cells.len() as i64).map(|k| k * (G::D as i64 + 1))), "{kind:?}");
        let types = grid.array("Cells", "types", "UInt8", 1);
        assert_eq!(types, vec![[if G::D == 2 { 5 } else { 10 }]; cells.len()], "{kind:?}");
        let own: Vec<f64> = ids.iter().map(|&v| heights[v.index()]).collect();
        assert_eq!(grid.doubles("PointData", "height &lt;m&gt; &amp; &quot;more&quot;", 1), own, "{kind:?}");
        assert_eq!(grid.doubles("CellData", "size", 2), sizes, "{kind:?}");
        for wrong in [Field { components: 2, ..height }, Field { components: 0, ..height }] {
            assert!(
                matches!(vtu(&t, &[wrong], &[]), Err(Error::WrongCount { argument: "values", .. })) || n == 0
            );
        }
    }
}

#[test]
fn grids_hold_what_is_read_in_the_plane() {
    grids_hold_what_is_read::<Plane>();
}

#[test]
fn grids_hold_what_is_read_in_space() {
    grids_hold_what_is_read::<Space>();
}

fn meshes_hold_what_is_read<G: Dimension>() {
    for (kind, n, removes) in KINDS.iter().map(|&kind| (kind, 60, true)).chain([(Kind::Random, 0, false)]) {
        let t = make::<G>(kind, n, removes);
        let (ids, cells) = (present(&t), t.cells().expect("room").corners);
        let own: Vec<i32> = (0..cells.len() as i32).map(|c| 7 - 3 * c).collect();
        let references = removes.then_some(own.as_slice());
        let text = String::from_utf8(medit(&t, references)).expect("text");
        let mut lines = text.lines();
        let mut expect = |line: &str| assert_eq!(lines.next(), Some(line), "{kind:?}");
        expect("MeshVersionFormatted 2");
        expect(&format!("Dimension {}", G::D));
        expect("Vertices");
        expect(&ids.len().to_string());
        for &v in &ids {
            let line: Vec<&str> = lines.next().expect("a vertex").split(' ').collect();
            let p: Vec<f64> = line[..G::D].iter().map(|x| x.parse().expect("a number")).collect();
            assert_eq!(
                (p.as_slice(), line[G::D]),
                (t.position(v).expect("present").as_ref(), &*v.to_string())
            );
            assert_eq!(line.len(), G::D + 1);
        }
        assert_eq!(lines.next(), Some(if G::D == 2 { "Triangles" } else { "Tetrahedra" }));
        assert_eq!(lines.next(), Some(&*cells.len().to_string()));
        for (c, row) in cells.iter().enumerate() {
            let numbers =
                lines.next().expect("a cell").split(' ').map(|k| k.parse::<i64>().expect("a number"));
            let corners = row.as_ref().iter().map(|v| ids.binary_search(v).expect("present") as i64 + 1);
            let reference = references.map_or(1, |references| i64::from(references[c]));
            assert!(numbers.eq(corners.chain([reference])), "{kind:?}");
        }
        assert_eq!((lines.next(), lines.next()), (Some("End"), None));
    }
}

#[test]
fn meshes_hold_what_is_read_in_the_plane() {
    meshes_hold_what_is_read::<Plane>();
}

#[test]
fn meshes_hold_what_is_read_in_space() {
    meshes_hold_what_is_read::<Space>();
}

/// What a package of Python reads of a file of a kind: points of three coordinates, cells, ids, and a field of the cells
/// where the kind has them, one number after the other.
const READERS: [(&str, &str, &str); 4] = [
    (
        "meshio",
        "vtu",
        "import meshio
m = meshio.read(path)
numbers = [m.points, m.cells[0].data, m.point_data['vertex'], m.cell_data['size'][0]]
numbers = [list(rows.reshape(-1)) for rows in numbers]",
    ),
    (
        "vtk",
        "vtu",
        "import vtk
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
m = reader.GetOutput()
assert all(m.GetCellType(c) == (5 if m.GetCell(c).GetNumberOfPoints() == 3 else 10) for c in range(m.GetNumberOfCells()))
arrays = [m.GetPoints().GetData(), m.GetCells().GetConnectivityArray(), m.GetPointData().GetArray('vertex'),
          m.GetCellData().GetArray('size')]
numbers = [[a.GetValue(k) for k in range(a.GetNumberOfValues())] for a in arrays]
assert m.GetNumberOfCells() == len(numbers[3])",
    ),
    (
        "meshio",
        "mesh",
        "import meshio
m = meshio.read(path)
points = [list(p) + [0.0] * (3 - len(p)) for p in m.points]
numbers = [sum(points, []), list(m.cells[0].data.reshape(-1)), list(m.point_data['medit:ref'])]",
    ),
    (
        "gmsh",
        "mesh",
        "import gmsh
gmsh.initialize()
gmsh.option.setNumber('General.Terminal', 0)
gmsh.open(path)
tags, x, _ = gmsh.model.mesh.getNodes()
assert sorted(tags) == list(range(1, len(tags) + 1))
x = [x[3 * k:3 * k + 3] for k in range(len(tags))]
points = [p for _, p in sorted(zip(tags, x), key=lambda pair: pair[0])]
_, _, nodes = gmsh.model.mesh.getElements()
numbers = [[c for p in points for c in p], [k - 1 for k in nodes[0]]]",
    ),
];

/// What a package reads of the lines of a file: their ends and markers, and that cells are as many as they were.
const READERS_OF_LINES: [(&str, &str, &str); 3] = [
    (
        "meshio",
        "vtu",
        "import meshio
m = meshio.read(path)
assert [block.type for block in m.cells] == ['triangle', 'line']
assert not m.cell_data['marker'][0].any() and (m.cell_data['size'][1] != m.cell_data['size'][1]).all()
numbers = [m.cells[1].data.reshape(-1), m.cell_data['marker'][1].reshape(-1), m.cell_data['size'][0].reshape(-1)]",
    ),
    (
        "vtk",
        "vtu",
        "import vtk
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
m = reader.GetOutput()
lines = [c for c in range(m.GetNumberOfCells()) if m.GetCellType(c) == 3]
marker, size = m.GetCellData().GetArray('marker'), m.GetCellData().GetArray('size')
numbers = [[m.GetCell(c).GetPointId(k) for c in lines for k in range(2)], [marker.GetValue(c) for c in lines],
           [size.GetValue(c) for c in range(lines[0])]]",
    ),
    (
        "meshio",
        "mesh",
        "import meshio
m = meshio.read(path)
assert [block.type for block in m.cells] == ['triangle', 'line']
numbers = [m.cells[1].data.reshape(-1), m.cell_data['medit:ref'][1], m.cell_data['medit:ref'][0]]",
    ),
];

/// A square with a slit and a vertex outside of it, of which one is removed and two are hidden; ends of the segments, as
/// numbers of the vertices that are written.
fn with_segments() -> (MovingTriangulation<Plane>, Vec<(i32, [usize; 2])>) {
    let points = [
        [9.0, 9.0],
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.3, 0.5],
        [0.6, 0.5],
        [1.0, 0.0],
        [0.3, 0.5],
        [2.0, 0.4],
    ];
    let mut t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("a build");
    t.remove_vertex(vertex(0)).expect("a removal");
    let given: [(u32, u32, i32); 6] =
        [(1, 7, -5), (2, 3, i32::MAX), (3, 4, 0), (4, 1, i32::MIN), (8, 6, 4), (5, 6, 12)];
    let segments =
        given.map(|(a, b, marker)| Segment { ends: [vertex(a), vertex(b)], marker, ..Segment::default() });
    t.stage_segments(segments.into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    // What is staged is in no file.
    t.stage_segments(
        [Segment { ends: [vertex(1), vertex(3)], marker: 99, ..Segment::default() }].into_iter(),
    )
    .expect("present");
    let leaving = t.segments().nth(1).expect("six").0;
    t.stage_segment_removals(&[leaving]).expect("in force");
    // Vertex 7 is at the place of 2, 8 at that of 5, and the first number is that of vertex 1.
    let shown = |v: u32| {
        if v == 7 {
            1
        } else if v == 8 {
            4
        } else {
            v as usize - 1
        }
    };
    (t, given.iter().map(|&(a, b, marker)| (marker, [shown(a), shown(b)])).collect())
}

#[test]
fn segments_are_lines_behind_cells() {
    let (t, lines) = with_segments();
    let (cells, n_lines) = (t.cells().expect("room").corners, lines.len());
    let sizes: Vec<f64> = (0..2 * cells.len()).map(|c| 0.5 + c as f64).collect();
    let size = Field { name: "size", components: 2, values: &sizes };
    let grid = Grid::read(&vtu(&t, &[], &[size]).expect("room"));
    assert_eq!((grid.n_points, grid.n_cells), (9, cells.len() + n_lines));
    let longs = |name| -> Vec<i64> {
        grid.array("Cells", name, "Int64", 1).into_iter().map(i64::from_le_bytes).collect()
    };
    let ends = lines.iter().flat_map(|(_, ends)| ends.map(|v| v as i64));
    let corners = cells.iter().flatten().map(|v| i64::from(v.get()) - 1);
    assert!(longs("connectivity").into_iter().eq(corners.chain(ends)));
    let triangles = (1..=cells.len()).map(|k| 3 * k as i64);
    let offsets = triangles.chain((1..=n_lines).map(|k| (3 * cells.len() + 2 * k) as i64));
    assert!(longs("offsets").into_iter().eq(offsets));
    let types = grid.array::<1>("Cells", "types", "UInt8", 1).into_iter().flatten();
    assert!(types.eq(vec![5; cells.len()].into_iter().chain(vec![3; n_lines])));
    let markers = grid.array("CellData", "marker", "Int32", 1).into_iter().map(i32::from_le_bytes);
    assert!(markers.eq(vec![0; cells.len()].into_iter().chain(lines.iter().map(|&(marker, _)| marker))));
    let written = grid.doubles("CellData", "size", 2);
    assert_eq!(written[..sizes.len()], sizes);
    assert_eq!(written.len(), sizes.len() + 2 * n_lines);
    assert!(written[sizes.len()..].iter().all(|value| value.is_nan()));
    let marker = Field { name: "marker", components: 2, values: &sizes };
    assert!(matches!(vtu(&t, &[], &[marker]), Err(Error::InvalidName { argument: "cell_fields", .. })));
    let heights = vec![0.0; t.id_count()];
    assert!(vtu(&t, &[Field { name: "marker", components: 1, values: &heights }], &[]).is_ok());

    let text = String::from_utf8(medit(&t, None)).expect("text");
    let (_, text) = text.split_once(&format!("Edges\n{n_lines}\n")).expect("there are edges");
    let rows = lines.iter().map(|(marker, [a, b])| format!("{} {} {marker}\n", a + 1, b + 1));
    assert_eq!(text, rows.collect::<String>() + "End\n");
}

/// Where no segment is in force, files have nothing of segments.
#[test]
fn files_without_segments_have_no_lines() {
    let (mut t, _) = with_segments();
    let all: Vec<_> = t.segments().map(|(segment, _)| segment).collect();
    t.discard_moves();
    t.stage_segment_removals(&all).expect("in force");
    t.commit_timestamp().expect("no conflict");
    let grid = Grid::read(&vtu(&t, &[], &[]).expect("room"));
    assert!(!grid.arrays.contains_key(&("CellData".to_string(), "marker".to_string())));
    assert_eq!(grid.n_cells, t.cell_count());
    let own = vec![0.0; t.cell_count()];
    assert!(vtu(&t, &[], &[Field { name: "marker", components: 1, values: &own }]).is_ok());
    assert!(!String::from_utf8(medit(&t, None)).expect("text").contains("Edges"));
}

#[test]
fn references_are_as_many_as_cells() {
    let (t, _) = with_segments();
    let n = t.cell_count();
    for given in [0, n - 1, n + 1] {
        let error = t.write_medit::<Error>(Some(&vec![1; given]), |_| panic!("nothing is written"));
        let wrong = Error::WrongCount { argument: "reference_count", given, wanted: n, coming: 0 };
        assert_eq!(error.expect_err("a wrong count").to_string(), wrong.to_string());
    }
}

/// Reads the lines of a file with a package.
fn lines_are_read_by(python: &str, (package, kind, _): (&str, &str, &str), folder: &Path) {
    let (t, lines) = with_segments();
    let n = t.cell_count();
    let reader = READERS_OF_LINES.iter().find(|(one, of, _)| (*one, *of) == (package, kind));
    let (_, _, reader) = reader.expect("there is one for each");
    let numbers: Vec<f64> = (0..n).map(|c| 3.0 - c as f64).collect();
    let references: Vec<i32> = numbers.iter().map(|&x| x as i32).collect();
    let size = Field { name: "size", components: 1, values: &numbers };
    let path = folder.join(format!("{package}-lines.{kind}"));
    let bytes =
        if kind == "vtu" { vtu(&t, &[], &[size]).expect("room") } else { medit(&t, Some(&references)) };
    fs::write(&path, bytes).expect("a file");
    let ends = lines.iter().flat_map(|(_, ends)| ends.map(|v| v as f64));
    let markers = lines.iter().map(|&(marker, _)| f64::from(marker));
    let expected: Vec<f64> = ends.chain(markers).chain(numbers).collect();
    assert_eq!(numbers_read(python, reader, &path, folder), expected, "{package}, {kind}");
}

/// What a reader finds in a file.
fn numbers_read(python: &str, reader: &str, path: &Path, folder: &Path) -> Vec<f64> {
    let script = format!(
        "import sys\npath = sys.argv[1]\n{reader}\nfor row in numbers:\n    for x in row:\n        print(repr(float(x)))"
    );
    let output = Command::new(python).arg("-c").arg(script).arg(path).env("PYTHONPATH", folder).output();
    let output = output.expect("python");
    assert!(output.status.success(), "{}: {}", path.display(), String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("text");
    text.lines().map(|line| line.parse::<f64>().expect("a number")).collect()
}

fn files_are_read_by<G: Dimension>(python: &str, (package, kind, reader): (&str, &str, &str), folder: &Path) {
    let t = make::<G>(Kind::Random, 60, true);
    let (ids, cells) = (present(&t), t.cells().expect("room").corners);
    let sizes: Vec<f64> = (0..cells.len()).map(|c| 0.1 * c as f64).collect();
    let size = Field { name: "size", components: 1, values: &sizes };
    let path = folder.join(format!("{package}{}.{kind}", G::D));
    let bytes = if kind == "vtu" { vtu(&t, &[], &[size]).expect("room") } else { medit(&t, None) };
    fs::write(&path, bytes).expect("a file");
    let mut numbers = numbers_read(python, reader, &path, folder).into_iter();
    for &v in &ids {
        let p = t.position(v).expect("present");
        for x in [p[0], p[1], if G::D == 3 { p[G::D - 1] } else { 0.0 }] {
            assert_eq!(numbers.next(), Some(x), "{package}");
        }
    }
    let rank = |v: &VertexId| ids.binary_search(v).expect("present") as f64;
    let corners = cells.iter().flat_map(|row| row.as_ref().iter().map(rank).collect::<Vec<_>>());
    let expected = corners.chain(ids.iter().map(|v| f64::from(v.get()))).chain(sizes.iter().copied());
    let numbers: Vec<f64> = numbers.collect();
    let expected: Vec<f64> = expected.take(numbers.len()).collect();
    assert!(numbers == expected && numbers.len() >= cells.len() * (G::D + 1), "{package}, {kind}");
}

/// Reads files with packages of Python that are there, or that pip can fetch quickly; says which are neither. More
/// interpreters, with older versions of VTK, can be named in the environment, with colons between them.
#[test]
fn files_are_read_by_meshio_vtk_and_gmsh() {
    let more = std::env::var("DELDRIFT_PYTHONS").unwrap_or_default();
    let pythons: Vec<&str> =
        ["python3"].into_iter().chain(more.split(':').filter(|p| !p.is_empty())).collect();
    for reader in READERS {
        let (package, ..) = reader;
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("python-{package}"));
        fs::create_dir_all(&folder).expect("a folder");
        let imports = |python: &str| {
            let mut python = Command::new(python);
            python.arg("-c").arg(format!("import {package}")).env("PYTHONPATH", &folder);
            python.output().is_ok_and(|output| output.status.success())
        };
        // The others are large.
        if !imports("python3") && package == "meshio" {
            let mut pip = Command::new("python3");
            pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "0"]);
            // What fails shows in the next import.
            let _ = pip.args(["--timeout", "10", "--target"]).arg(&folder).arg(package).output();
        }
        let having: Vec<&str> = pythons.iter().copied().filter(|python| imports(python)).collect();
        if having.is_empty() {
            skipped("exporting", &format!("the package {package} of Python is not there"));
        }
        for python in having {
            if package != "gmsh" {
                lines_are_read_by(python, reader, &folder);
            }
            files_are_read_by::<Plane>(python, reader, &folder);
            files_are_read_by::<Space>(python, reader, &folder);
        }
    }
}

/// Names that XML does not have, and names that are there already.
#[test]
fn names_of_fields_are_different_and_of_xml() {
    let t = make::<Plane>(Kind::Random, 10, false);
    let (at_vertices, in_cells) = (vec![0.0; t.id_count()], vec![0.0; t.cell_count()]);
    let wrong = |names: &[&str], index: usize| {
        let of = |values| -> Vec<Field> {
            names.iter().map(|name| Field { name, components: 1, values }).collect()
        };
        let results = [vtu(&t, &of(&at_vertices), &[]), vtu(&t, &[], &of(&in_cells))];
        for (result, argument) in results.into_iter().zip(["vertex_fields", "cell_fields"]) {
            let error = result.expect_err("a wrong name");
            let Error::InvalidName { argument: given, index: at, .. } = error else { panic!("{error}") };
            assert_eq!((given, at), (argument, index), "{names:?}");
        }
    };
    let odd = (0..0x20).chain(0x7f..0xa0).chain([0xfffe, 0xffff]).filter_map(char::from_u32);
    odd.for_each(|c| wrong(&["a", &format!("b{c}"), "c"], 1));
    wrong(&["a", "b", "a", "b"], 2);
    wrong(&["", "b", ""], 2);
    let names = ["a", "A", "a ", "\u{a0}", "\u{d7ff}\u{e000}\u{fffd}\u{10000}\u{10ffff}", "Vertex", ""];
    let of =
        |values| -> Vec<Field> { names.iter().map(|name| Field { name, components: 1, values }).collect() };
    let grid = Grid::read(&vtu(&t, &of(&at_vertices), &of(&in_cells)).expect("room"));
    for name in names {
        assert_eq!(grid.doubles("PointData", name, 1), at_vertices);
        assert_eq!(grid.doubles("CellData", name, 1), in_cells);
    }
    let vertex = Field { name: "vertex", components: 1, values: &at_vertices };
    assert!(matches!(vtu(&t, &[vertex], &[]), Err(Error::InvalidName { index: 0, .. })));
    assert!(vtu(&t, &[], &[Field { values: &in_cells, ..vertex }]).is_ok());
}
