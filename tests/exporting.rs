//! Files for other programs hold the positions and cells that are read, number for number: by readers of the tests'
//! own, and by meshio and VTK where they can be had.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;

use crate::common::inputs::{KINDS, Kind, draw};
use crate::common::{Rng, vertex};
use deldrift::motion::{Field, MovingTriangulation, Options};
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
        let numbers = |name, section| {
            grid.array(section, name, "UInt32", 1).into_iter().map(u32::from_le_bytes).collect::<Vec<_>>()
        };
        let names = numbers("vertex", "PointData");
        assert_eq!(VertexId::of_numbers(&names), ids, "{kind:?}");
        let corners: Vec<VertexId> =
            numbers("connectivity", "Cells").iter().map(|&k| ids[k as usize]).collect();
        assert_eq!(
            corners,
            cells.iter().flat_map(|row| row.as_ref().to_vec()).collect::<Vec<_>>(),
            "{kind:?}"
        );
        let offsets = grid.array("Cells", "offsets", "Int64", 1).into_iter().map(i64::from_le_bytes);
        assert!(offsets.eq((1..=cells.len() as i64).map(|k| k * (G::D as i64 + 1))), "{kind:?}");
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
        let mut bytes = Vec::new();
        let written = t.write_medit::<Error>(|more| {
            bytes.extend_from_slice(more);
            Ok(())
        });
        written.expect("room");
        let text = String::from_utf8(bytes).expect("text");
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
        for row in cells {
            let numbers =
                lines.next().expect("a cell").split(' ').map(|k| k.parse::<usize>().expect("a number"));
            let expected = row.as_ref().iter().map(|v| ids.binary_search(v).expect("present") + 1).chain([1]);
            assert!(numbers.eq(expected), "{kind:?}");
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

/// What a package of Python reads of a file: points, cells, ids and a field, one number after the other.
const READERS: [(&str, &str); 2] = [
    (
        "meshio",
        "import meshio, sys
m = meshio.read(sys.argv[1])
numbers = [m.points, m.cells[0].data, m.point_data['vertex'], m.cell_data['size'][0]]",
    ),
    (
        "vtk",
        "import sys, vtk
from vtk.util.numpy_support import vtk_to_numpy as numpy
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
m = reader.GetOutput()
numbers = [numpy(m.GetPoints().GetData()), numpy(m.GetCells().GetConnectivityArray()),
           numpy(m.GetPointData().GetArray('vertex')), numpy(m.GetCellData().GetArray('size'))]
assert all(m.GetCellType(c) == (5 if m.GetCell(c).GetNumberOfPoints() == 3 else 10) for c in range(m.GetNumberOfCells()))
assert m.GetNumberOfCells() == len(numbers[3])",
    ),
];

fn files_are_read_by<G: Dimension>(package: &str, reader: &str, folder: &Path) {
    let t = make::<G>(Kind::Random, 60, true);
    let (ids, cells) = (present(&t), t.cells().expect("room").corners);
    let sizes: Vec<f64> = (0..cells.len()).map(|c| 0.1 * c as f64).collect();
    let size = Field { name: "size", components: 1, values: &sizes };
    let path = folder.join(format!("{package}{}.vtu", G::D));
    fs::write(&path, vtu(&t, &[], &[size]).expect("room")).expect("a file");
    let script = format!(
        "{reader}\nfor rows in numbers:\n    for x in rows.reshape(-1):\n        print(repr(float(x)))"
    );
    let output = Command::new("python3").arg("-c").arg(script).arg(&path).env("PYTHONPATH", folder).output();
    let output = output.expect("python");
    assert!(output.status.success(), "{package}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("text");
    let mut numbers = text.lines().map(|line| line.parse::<f64>().expect("a number"));
    for &v in &ids {
        let p = t.position(v).expect("present");
        for x in [p[0], p[1], if G::D == 3 { p[G::D - 1] } else { 0.0 }] {
            assert_eq!(numbers.next(), Some(x), "{package}");
        }
    }
    let rank = |v: &VertexId| ids.binary_search(v).expect("present") as f64;
    let corners = cells.iter().flat_map(|row| row.as_ref().iter().map(rank).collect::<Vec<_>>());
    let rest = corners.chain(ids.iter().map(|v| f64::from(v.get()))).chain(sizes.iter().copied());
    assert!(numbers.eq(rest), "{package}");
}

/// Reads files with packages of Python that are there, or that pip can fetch quickly; says which are neither.
#[test]
fn grids_are_read_by_meshio_and_vtk() {
    for (package, reader) in READERS {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("python-{package}"));
        fs::create_dir_all(&folder).expect("a folder");
        let imports = || {
            let mut python = Command::new("python3");
            python.arg("-c").arg(format!("import {package}")).env("PYTHONPATH", &folder);
            python.output().is_ok_and(|output| output.status.success())
        };
        // VTK is large.
        if !imports() && package == "meshio" {
            let mut pip = Command::new("python3");
            pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "0"]);
            // What fails shows in the next import.
            let _ = pip.args(["--timeout", "10", "--target"]).arg(&folder).arg(package).output();
        }
        if !imports() {
            // Not by a macro, whose text is not shown where the test passes.
            let text = format!("skipped: the package {package} of Python is not there\n");
            std::io::stderr().write_all(text.as_bytes()).expect("it can be told");
            continue;
        }
        files_are_read_by::<Plane>(package, reader, &folder);
        files_are_read_by::<Space>(package, reader, &folder);
    }
}
