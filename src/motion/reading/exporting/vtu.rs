//! VTK's XML format for unstructured grids, as read by ParaView and VTK: a text that says where each array is, and the
//! arrays behind it, appended raw, little-endian, each after the number of its bytes.

use std::fmt::{self, Write};

use crate::complex::Corners;
use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::reading::chunks::Chunks;
use crate::motion::reading::exporting::Drawn;

/// Numbers for each vertex, or for each cell, that are written along.
#[derive(Clone, Copy, Debug)]
pub struct Field<'f> {
    /// What it is called.
    pub name: &'f str,
    /// How many numbers each has.
    pub components: usize,
    /// The numbers, by vertex id (those of removed vertices are not written), or by index of the cells.
    pub values: &'f [f64],
}

/// What the array of vertex ids is called.
const VERTEX: &str = "vertex";

/// What the array of the markers of lines is called.
const MARKER: &str = "marker";

/// VTK's number for a line.
const LINE: u8 = 3;

impl Field<'_> {
    /// Checks that fields of vertices, or those of cells, have different names of characters that XML has, and not that
    /// of an array of the file.
    pub(crate) fn check_names(argument: &'static str, fields: &[Field<'_>], has_lines: bool) -> Result<()> {
        let refuse = |index, wanted| Err(Error::InvalidName { argument, index, wanted });
        let is_odd = |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
        if let Some(index) = fields.iter().position(|field| field.name.contains(is_odd)) {
            return refuse(index, "without control characters, U+FFFE and U+FFFF, which XML does not have");
        }
        let is_called = |name| fields.iter().position(|field| field.name == name);
        if argument == "vertex_fields"
            && let Some(index) = is_called(VERTEX)
        {
            return refuse(index, "another than \"vertex\", which is that of the ids");
        }
        if has_lines
            && argument == "cell_fields"
            && let Some(index) = is_called(MARKER)
        {
            return refuse(index, "another than \"marker\", which is that of the markers of segments");
        }
        let mut order = Vec::new();
        memory::reserve_exact(&mut order, fields.len())?;
        order.extend(0..fields.len());
        order.sort_unstable_by_key(|&index| (fields[index].name, index));
        let again = order.windows(2).find(|pair| fields[pair[0]].name == fields[pair[1]].name);
        again.map_or(Ok(()), |pair| refuse(pair[1], "another than those of the fields before"))
    }
}

/// A text in the value of an attribute: of characters that XML has.
struct Attribute<'t>(&'t str);

impl fmt::Display for Attribute<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.chars().try_for_each(|c| match c {
            '&' => f.write_str("&amp;"),
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '"' => f.write_str("&quot;"),
            c => f.write_char(c),
        })
    }
}

/// Says where arrays are.
struct Directory<'c, P> {
    chunks: &'c mut Chunks<P>,
    offset: usize,
}

impl<E, P: FnMut(&[u8]) -> Result<(), E>> Directory<'_, P> {
    /// An array of `n` rows of `components` entries of `bytes` bytes.
    fn array(&mut self, kind: &str, name: &str, components: usize, bytes: usize) -> Result<(), E> {
        let (name, offset) = (Attribute(name), self.offset);
        self.offset += size_of::<u64>() + bytes;
        self.chunks.text(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        ))
    }

    /// Fields of `n` rows.
    fn fields(&mut self, fields: &[Field<'_>], n: usize) -> Result<(), E> {
        fields.iter().try_for_each(|f| self.array("Float64", f.name, f.components, 8 * f.components * n))
    }
}

/// Writes all.
pub(super) fn write<G: Moving, E: From<Error>>(
    drawn: &impl Drawn<G>,
    vertex_fields: &[Field<'_>],
    cell_fields: &[Field<'_>],
    put: impl FnMut(&[u8]) -> Result<(), E>,
) -> Result<(), E> {
    let n_lines = drawn.lines().count();
    Field::check_names("vertex_fields", vertex_fields, n_lines != 0)?;
    Field::check_names("cell_fields", cell_fields, n_lines != 0)?;
    let ([n_ids, n_coming], n, n_cells) = (drawn.id_counts(), drawn.point_count(), drawn.cell_count());
    for (fields, n, coming) in [(vertex_fields, n_ids, n_coming), (cell_fields, n_cells, 0)] {
        for field in fields {
            let wanted = n.saturating_mul(field.components);
            if field.components == 0 || field.values.len() != wanted {
                let given = field.values.len();
                let coming = coming.saturating_mul(field.components);
                return Err(Error::WrongCount { argument: "values", given, wanted, coming }.into());
            }
        }
    }
    let mut chunks = Chunks::new(put);
    let written = Written { n, n_cells, n_lines, corners: G::Corners::N };
    written.directory(vertex_fields, cell_fields, &mut chunks)?;
    let size = |chunks: &mut Chunks<_>, bytes: usize| chunks.write((bytes as u64).to_le_bytes());
    size(&mut chunks, 24 * n)?;
    for (_, point) in drawn.points() {
        chunks.point::<G>(&point)?;
        (G::D..3).try_for_each(|_| chunks.write(0_f64.to_le_bytes()))?;
    }
    size(&mut chunks, 8 * written.n_connected())?;
    for row in drawn.cells() {
        row[..=G::D].iter().try_for_each(|&n| chunks.write(u64::from(n).to_le_bytes()))?;
    }
    for (ends, _) in drawn.lines() {
        ends.iter().try_for_each(|&n| chunks.write(u64::from(n).to_le_bytes()))?;
    }
    size(&mut chunks, 8 * (n_cells + n_lines))?;
    let corners = G::Corners::N as u64;
    (1..=n_cells as u64).try_for_each(|k| chunks.write((k * corners).to_le_bytes()))?;
    let end = n_cells as u64 * corners;
    (1..=n_lines as u64).try_for_each(|k| chunks.write((end + 2 * k).to_le_bytes()))?;
    size(&mut chunks, n_cells + n_lines)?;
    (0..n_cells).try_for_each(|_| chunks.write([if G::D == 2 { 5 } else { 10 }]))?;
    (0..n_lines).try_for_each(|_| chunks.write([LINE]))?;
    size(&mut chunks, 4 * n)?;
    drawn.points().try_for_each(|(v, _)| chunks.numbers(&[v.get()]))?;
    for field in vertex_fields {
        size(&mut chunks, 8 * field.components * n)?;
        for (v, _) in drawn.points() {
            let row = &field.values[v.index() * field.components..][..field.components];
            row.iter().try_for_each(|value| chunks.write(value.to_le_bytes()))?;
        }
    }
    if n_lines != 0 {
        size(&mut chunks, 4 * (n_cells + n_lines))?;
        (0..n_cells).try_for_each(|_| chunks.write(0_i32.to_le_bytes()))?;
        drawn.lines().try_for_each(|(_, marker)| chunks.write(marker.to_le_bytes()))?;
    }
    for field in cell_fields {
        size(&mut chunks, 8 * field.components * (n_cells + n_lines))?;
        field.values.iter().try_for_each(|value| chunks.write(value.to_le_bytes()))?;
        (0..field.components * n_lines).try_for_each(|_| chunks.write(f64::NAN.to_le_bytes()))?;
    }
    chunks.text(format_args!("\n</AppendedData>\n</VTKFile>\n"))?;
    chunks.end()
}

/// How many there are of what is written.
#[derive(Clone, Copy)]
struct Written {
    n: usize,
    n_cells: usize,
    n_lines: usize,
    /// Of each cell.
    corners: usize,
}

impl Written {
    /// How many numbers of points say where cells and lines are.
    fn n_connected(self) -> usize {
        self.corners * self.n_cells + 2 * self.n_lines
    }

    /// Writes what is before the arrays, in the order in which these follow.
    fn directory<E>(
        self,
        vertex_fields: &[Field<'_>],
        cell_fields: &[Field<'_>],
        chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>,
    ) -> Result<(), E> {
        let (n, all) = (self.n, self.n_cells + self.n_lines);
        let mut directory = Directory { chunks, offset: 0 };
        directory.chunks.text(format_args!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
             <UnstructuredGrid>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{all}\">\n<Points>\n"
        ))?;
        directory.array("Float64", "Points", 3, 24 * n)?;
        directory.chunks.text(format_args!("</Points>\n<Cells>\n"))?;
        // VTK 9.0 wants one type for both, of those that it has for itself.
        directory.array("Int64", "connectivity", 1, 8 * self.n_connected())?;
        directory.array("Int64", "offsets", 1, 8 * all)?;
        directory.array("UInt8", "types", 1, all)?;
        directory.chunks.text(format_args!("</Cells>\n<PointData>\n"))?;
        directory.array("UInt32", VERTEX, 1, 4 * n)?;
        directory.fields(vertex_fields, n)?;
        directory.chunks.text(format_args!("</PointData>\n<CellData>\n"))?;
        if self.n_lines != 0 {
            directory.array("Int32", MARKER, 1, 4 * all)?;
        }
        directory.fields(cell_fields, all)?;
        directory.chunks.text(format_args!(
            "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_"
        ))
    }
}
