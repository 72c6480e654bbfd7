//! The change list: what a program has to know that keeps something for each cell.

use super::handle::{Changing, deldrift_triangulation, in_any};
use super::pointers::{Output, given, start_of};
use super::status::deldrift_status;
use crate::ids::{CellId, VertexId};
use crate::motion::Changes;

/// What has changed since the program last took the changes. The lists belong to the triangulation, and are valid until
/// the next call that changes it. A pointer is NULL if its list is empty.
///
/// A cell is its set of vertices. One that existed before and exists now is neither created nor removed, whatever has
/// happened in between. It keeps its index unless it is listed as renumbered. Its row keeps the order of the vertices,
/// except if the cell was turned over by a motion through a flat cell, or was removed and created again in between. A
/// program with data per cell updates them in three steps. Set aside those of removed cells, and of renumbered ones by
/// old index. Write the latter to their new indices. Make those of created cells. Neighbours change only at cells that
/// are listed, and at the neighbours of those.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_changes {
    /// Number of cells that exist and did not.
    pub created_count: usize,
    /// Their indices into deldrift_cells, ascending.
    pub created: *const u32,
    /// Number of cells that existed and do not.
    pub removed_count: usize,
    /// The index that each had.
    pub removed: *const u32,
    /// removed_count rows of 3 (2D) or 4 (3D) vertex ids: their vertices, in the order that their rows had when the
    /// program last took the changes. Vertices may have been removed since. After a compaction those are DELDRIFT_NONE.
    pub removed_vertices: *const u32,
    /// Number of cells that existed under another index.
    pub renumbered_count: usize,
    /// The index that each had.
    pub renumbered_from: *const u32,
    /// The index that each has.
    pub renumbered_to: *const u32,
    /// Number of vertices whose star has changed: all those of created and removed cells.
    pub star_count: usize,
    /// These vertices, ascending. Some may have been removed.
    pub stars: *const u32,
    /// Number of vertices that are hidden and were not: a vertex of lower id, or key, is at the same place now, or
    /// weights of others hide it. One that has been inserted and is hidden is among them.
    pub hidden_count: usize,
    /// These vertices, ascending.
    pub hidden: *const u32,
    /// Number of vertices that were hidden, and are there and not hidden.
    pub shown_count: usize,
    /// These vertices, ascending.
    pub shown: *const u32,
    /// Zero; later versions may tell more.
    pub reserved: [usize; 4],
}

impl<C> From<Changes<'_, C>> for deldrift_changes {
    fn from(changes: Changes<'_, C>) -> Self {
        Self {
            created_count: changes.created.len(),
            created: start_of(CellId::numbers_of(changes.created)),
            removed_count: changes.removed.len(),
            removed: start_of(CellId::numbers_of(changes.removed)),
            removed_vertices: start_of(changes.removed_corners).cast(),
            renumbered_count: changes.renumbered_from.len(),
            renumbered_from: start_of(CellId::numbers_of(changes.renumbered_from)),
            renumbered_to: start_of(CellId::numbers_of(changes.renumbered_to)),
            star_count: changes.stars.len(),
            stars: start_of(VertexId::numbers_of(changes.stars)),
            hidden_count: changes.hidden.len(),
            hidden: start_of(VertexId::numbers_of(changes.hidden)),
            shown_count: changes.shown.len(),
            shown: start_of(VertexId::numbers_of(changes.shown)),
            reserved: [0; 4],
        }
    }
}

/// Takes what has changed since the last call of this function, to *changes. It may have changed by commits or
/// immediate calls. The first call lists all cells as created.
///
/// Between two calls may be any number of commits and immediate calls. With a call before it and one after it, this is
/// what one insertion, removal or new weight at once has hidden and shown.
///
/// A program that never calls this pays nothing for it. One that does pays in proportion to what has changed, and may
/// call it as often or as rarely as it likes. It ends the lists of the call before. A view of the cells stays valid
/// unless it is older than the last change. deldrift_cells takes constant time after it.
///
/// Where the triangulation is periodic, a cell is its vertices with their shifts from each other
/// (deldrift_cell_shifts). It is new if the program takes a vertex of it to another period, or gives other vectors of
/// the lattice. From the first call on cells that stay keep their indices. A commit that builds anew may list their
/// corners in another order.
///
/// Cost: what has changed, and with weights a bit for each id; of the first call n + m. Where the triangulation is
/// periodic, always n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY; then nothing has been taken.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_take_changes(
    t: *mut deldrift_triangulation,
    changes: *mut deldrift_changes,
) -> deldrift_status {
    given!(t: Changing, changes: Output);
    t.change_any(|t| {
        let changes = changes.place()?;
        changes.write(in_any!(t => t.take_changes()?.into()));
        Ok(())
    })
}
