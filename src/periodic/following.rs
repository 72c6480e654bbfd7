//! Whether a change has left cells at home that are those of the repeating set, by a look at what has changed alone.
//!
//! The cells at home are *consistent* if each cell with a vertex at home that has an image, too, is there in as many places as it
//! has different shifts: translated so that any of its vertices is at home. Where a set repeats along all axes and no two of
//! its vertices share a place, cells at home that are consistent, and *connected* by common vertices, are those of the
//! repeating set. Connected means: with all their translations, as places, not as classes of these, or else the cells could
//! be those of a lattice of longer vectors, and their translations others, which cover space once more. With all
//! translations they are cells without a boundary, as the star of each vertex at home is whole, and
//! they do not overlap around a vertex. So they cover space, each connected part of them equally often, and one that is
//! without a boundary in a space without holes covers it once. Each facet is between two cells whose balls have no other vertex of
//! both in them, with ties broken alike in all periods: they are the Delaunay cells.
//!
//! Where they were so before, only cells that have changed can be otherwise: of a cell that is there in one place and not in
//! another some places have come or gone, and not all, and vertices that are not connected any more were in one that has gone,
//! or in several at a vertex that has been removed. Vertices that have been inserted have to be connected to others.

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::{CellsView, cells_at};
use crate::periodic::images::Image;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{HOME, Lattice, Shift, minus, plus};
use crate::periodic::needed::Needed;

/// The vertices of a cell in their order, each with its shift from the first; the last is none in the plane.
type Class = [Image; 4];

/// A cell that has come, or one that has gone, by its place in a list.
#[derive(Clone, Copy)]
enum CellChange {
    Come(CellId),
    Gone(usize),
}

/// One of the places of a class that has changed.
struct ChangedPlace {
    class: Class,
    n_places: usize,
    change: CellChange,
}

/// Finds cells among those at a vertex.
struct Stars<'t, G: Moving> {
    inside: &'t Inside<G>,
    cells: CellsView<'t, G>,
    slots: IndexSet<Slot>,
}

impl<G: Moving> Stars<'_, G> {
    /// The cell at a vertex that has these corners, in any order.
    fn find(&mut self, vertex: VertexId, row: &G::Vertices) -> Result<Option<CellId>> {
        self.slots.clear();
        let (index_of, _) = self.inside.t.list_star(vertex, &mut self.slots)?;
        let corners = self.cells.corners;
        let has_all = |cell: &CellId| row.as_ref().iter().all(|v| corners[*cell].as_ref().contains(v));
        Ok(cells_at(&self.slots, index_of).find(has_all))
    }
}

/// Vertices in sets that are joined, each in all periods: where one of a set is in a period, the first of the set is in that
/// and `offset` more, and both are joined there.
struct Joined {
    parents: Vec<VertexId>,
    /// From each to its parent.
    offsets: Vec<Shift>,
    /// Sets that are joined to themselves in other periods, by the first of one at that time.
    around: Vec<(VertexId, Sublattice)>,
}

/// Of so many sets it is known that they are joined to themselves elsewhere; others count as if they were not.
const MOST_AROUND: usize = 16;

/// The shifts that are sums of multiples of some, by a basis in echelon form: before its place each has zeros. Some may be missing,
/// where numbers are too large.
#[derive(Clone, Copy, Debug)]
struct Sublattice([[i64; 3]; 3]);

/// One shift less a multiple of another one.
fn less(one: [i64; 3], n: i64, other: [i64; 3]) -> Option<[i64; 3]> {
    let mut difference = one;
    for (entry, x) in difference.iter_mut().zip(other) {
        *entry = entry.checked_sub(n.checked_mul(x)?)?;
    }
    Some(difference)
}

impl Sublattice {
    const NONE: Self = Sublattice([[0; 3]; 3]);

    fn enter(&mut self, mut shift: [i64; 3]) {
        for (j, row) in self.0.iter_mut().enumerate() {
            // Euclid's algorithm: in the end the entry of the row divides both, and that of the shift is 0.
            while shift[j] != 0 {
                let Some(rest) = row[j].checked_div(shift[j]).and_then(|n| less(*row, n, shift)) else {
                    return;
                };
                *row = std::mem::replace(&mut shift, rest);
            }
        }
    }

    fn has(&self, mut shift: [i64; 3]) -> bool {
        for (j, &row) in self.0.iter().enumerate().filter(|(j, row)| row[*j] != 0) {
            let Some(rest) = shift[j].checked_div(row[j]).and_then(|n| less(shift, n, row)) else {
                return false;
            };
            shift = rest;
        }
        shift == [0; 3]
    }
}

impl Joined {
    /// None of `n` vertices is joined to another one yet. No value where sums of so many shifts may be too large for numbers.
    fn none(n: usize, greatest: Shift) -> Result<Option<Self>> {
        // An offset is a sum of a difference of shifts for each vertex at most, and ways are differences of two.
        let most = greatest.iter().fold(1, |most, &x| i64::from(x).max(most));
        if 4 * most * (n as i64 + 1) > i32::MAX.into() {
            return Ok(None);
        }
        let (mut parents, mut offsets) = (Vec::new(), Vec::new());
        memory::collect(&mut parents, VertexId::range(0..n))?;
        memory::lengthen(&mut offsets, n, HOME)?;
        let mut around = Vec::new();
        memory::reserve_exact(&mut around, MOST_AROUND)?;
        Ok(Some(Joined { parents, offsets, around }))
    }

    /// What an image is joined to: one of the first of its set.
    fn first(&mut self, Image { vertex: mut v, mut shift }: Image) -> Image {
        while self.parents[v] != v {
            let parent = self.parents[v];
            // The first of a set is no way from itself.
            self.offsets[v] = plus(self.offsets[v], self.offsets[parent]);
            self.parents[v] = self.parents[parent];
            shift = plus(shift, self.offsets[v]);
            v = self.parents[v];
        }
        Image { vertex: v, shift }
    }

    /// Joins two images, and all of their translations.
    fn join(&mut self, one: Image, other: Image) {
        let (one, other) = (self.first(one), self.first(other));
        let (from, to) = if one.vertex < other.vertex { (other, one) } else { (one, other) };
        let way = minus(to.shift, from.shift);
        if from.vertex != to.vertex {
            self.parents[from.vertex] = to.vertex;
            self.offsets[from.vertex] = way;
        } else if way != HOME {
            let is_full = self.around.len() == MOST_AROUND;
            match self.around.iter_mut().find(|(first, _)| *first == to.vertex) {
                Some((_, sublattice)) => sublattice.enter(way.map(i64::from)),
                None if !is_full => {
                    let mut sublattice = Sublattice::NONE;
                    sublattice.enter(way.map(i64::from));
                    self.around.push((to.vertex, sublattice));
                }
                None => {}
            }
        }
    }

    /// Whether some images are all joined.
    fn are_joined(&mut self, mut images: impl Iterator<Item = Image>) -> bool {
        let Some(first) = images.next().map(|image| self.first(image)) else { return true };
        images.all(|image| {
            let other = self.first(image);
            let way = minus(other.shift, first.shift);
            other.vertex == first.vertex && (way == HOME || self.goes_around(first.vertex, way))
        })
    }

    /// Whether a set is known to be joined to itself where it is translated by this.
    fn goes_around(&mut self, first: VertexId, way: Shift) -> bool {
        let mut all = Sublattice::NONE;
        for k in 0..self.around.len() {
            let (vertex, sublattice) = self.around[k];
            if self.first(Image { vertex, shift: HOME }).vertex == first {
                sublattice.0.iter().for_each(|&row| all.enter(row));
            }
        }
        all.has(way.map(i64::from))
    }
}

impl<G: Moving> Inside<G> {
    /// Whether the set repeats along all axes, and all of its vertices are corners: no two share a place, and weights hide none.
    pub(super) fn is_plain(&self, lattice: &Lattice<G>) -> bool {
        lattice.rank() == G::D && self.t.cell_count() > 0 && self.t.count_in_no_cell() == 0
    }

    /// The images that are missing after rounds, where before them all was as in the repeating set.
    pub(super) fn missing(&self, lattice: &Lattice<G>) -> Result<Needed> {
        if self.since.is_plain
            && self.is_plain(lattice)
            && let Some(needed) = self.missing_at_changes(lattice, self.since.n_vertices)?
        {
            return Ok(needed);
        }
        Needed::of_all(self, lattice)
    }

    /// The images that are missing by the balls of inconsistent cells; none if these do not decide it.
    fn missing_at_changes(&self, lattice: &Lattice<G>, n_before: usize) -> Result<Option<Needed>> {
        let cells = self.t.cells()?;
        let Some(rows) = self.t.rows_since_taken()? else { return Ok(None) };
        let (mut removed, mut found) = (Vec::new(), Vec::new());
        for (row, created) in rows {
            let corners = row.as_ref();
            if corners.iter().any(|&v| self.images.of(v) == Image::GONE) {
                // A cell of an earlier commit, which could not be taken.
                return Ok(None);
            }
            let n_home = corners.iter().filter(|&&v| self.images.is_home(v)).count();
            if n_home == 0 {
                continue;
            }
            if created.is_none() {
                memory::push(&mut removed, *row)?;
            }
            if n_home < corners.len() {
                let (class, n_places) = self.class_of(row);
                let change = created.map_or_else(|| CellChange::Gone(removed.len() - 1), CellChange::Come);
                memory::push(&mut found, ChangedPlace { class, n_places, change })?;
            }
        }
        found.sort_unstable_by_key(|one| one.class);
        let (mut needed, mut is_consistent) = (Needed::default(), true);
        let mut stars = Stars { inside: self, cells, slots: IndexSet::new() };
        for of_class in found.chunk_by(|one, other| one.class == other.class) {
            // Before, the class was there in all places or in none.
            let n_come = of_class.iter().filter(|one| matches!(one.change, CellChange::Come(_))).count();
            let n_more = n_come.abs_diff(of_class.len() - n_come);
            if n_more == 0 || n_more == of_class[0].n_places {
                continue;
            }
            is_consistent = false;
            for one in of_class {
                match one.change {
                    CellChange::Come(cell) => needed.enter_cell(self, lattice, cell)?,
                    CellChange::Gone(index) => {
                        self.enter_others(&mut stars, lattice, &removed[index], &mut needed)?
                    }
                }
            }
        }
        if !is_consistent {
            let needed = needed.each_once();
            return Ok(Some(needed).filter(|needed| !needed.images.is_empty()));
        }
        Ok(self.are_still_joined(lattice, &removed, n_before)?.then_some(needed))
    }

    /// Whether vertices of cells that have gone are joined by cells that have come, and those that have come, the ones from
    /// `n_before` on, to some that were there.
    fn are_still_joined(
        &self,
        lattice: &Lattice<G>,
        removed: &[G::Vertices],
        n_before: usize,
    ) -> Result<bool> {
        if removed.is_empty() && n_before == self.images.n_vertices() {
            return Ok(true);
        }
        let Some(rows) = self.t.rows_since_taken()? else { return Ok(false) };
        let Some(mut joined) = Joined::none(self.images.n_vertices(), lattice.greatest())? else {
            return Ok(false);
        };
        for corners in rows.filter(|(_, created)| created.is_some()).map(|(row, _)| row.as_ref()) {
            if corners.iter().any(|v| self.images.is_home(*v)) {
                let first = self.images.of(corners[0]);
                corners[1..].iter().for_each(|&v| joined.join(first, self.images.of(v)));
            }
        }
        // The first of a set has the lowest id.
        let mut coming = VertexId::range(n_before..self.images.n_vertices())
            .filter(|&vertex| self.images.home(vertex) != VertexId::NONE);
        if !coming.all(|vertex| joined.first(Image { vertex, shift: HOME }).vertex.index() < n_before) {
            return Ok(false);
        }
        self.join_gone(&mut joined, removed)?;
        Ok(removed.iter().all(|row| joined.are_joined(row.as_ref().iter().map(|&v| self.images.of(v)))))
    }

    /// Joins each vertex that has been removed to one that stays and had a cell with it. So all that had cells with it, and so were
    /// joined by it, are joined if each is joined to it; and if a removed one is joined to none, that is as well as not joined.
    fn join_gone(&self, joined: &mut Joined, removed: &[G::Vertices]) -> Result<()> {
        let mut seen = IndexSet::new();
        let is_gone = |v: VertexId| !self.t.is_present(v);
        for corners in removed.iter().map(|row| row.as_ref()) {
            let Some(&stays) = corners.iter().find(|&&v| !is_gone(v)) else { continue };
            for &v in corners.iter().filter(|&&v| is_gone(v)) {
                let image = self.images.of(v);
                if seen.insert(image.vertex)? {
                    joined.join(image, self.images.of(stays));
                }
            }
        }
        Ok(())
    }

    /// Enters what the balls of translations of a cell that has gone ask for, as far as they are there.
    fn enter_others(
        &self,
        stars: &mut Stars<'_, G>,
        lattice: &Lattice<G>,
        row: &G::Vertices,
        needed: &mut Needed,
    ) -> Result<()> {
        for &v in row.as_ref().iter().filter(|v| !self.images.is_home(**v)) {
            let Some(row) = self.translated_home(row, v).filter(|row| self.are_present(row)) else {
                continue;
            };
            if let Some(cell) = stars.find(self.images.home(self.images.of(v).vertex), &row)? {
                needed.enter_cell(self, lattice, cell)?;
            }
        }
        Ok(())
    }

    /// The cell inside at a vertex that has these corners, in any order.
    pub(super) fn cell_at(&self, vertex: VertexId, row: &G::Vertices) -> Result<Option<CellId>> {
        Stars { inside: self, cells: self.t.cells()?, slots: IndexSet::new() }.find(vertex, row)
    }

    /// Whether none of the corners of a cell that has gone has been removed.
    fn are_present(&self, row: &G::Vertices) -> bool {
        row.as_ref().iter().all(|&v| self.t.is_present(v))
    }

    /// What all translations of a cell have in common, and in how many places it has a vertex at home.
    fn class_of(&self, row: &G::Vertices) -> (Class, usize) {
        let mut class = [Image { vertex: VertexId::NONE, shift: HOME }; 4];
        let corners = row.as_ref();
        class.iter_mut().zip(corners).for_each(|(image, &v)| *image = self.images.of(v));
        let images = &mut class[..corners.len()];
        images.sort_unstable();
        let is_first = |i: usize| images[..i].iter().all(|other| other.shift != images[i].shift);
        let n_places = (0..images.len()).filter(|&i| is_first(i)).count();
        let first = images[0].shift;
        images.iter_mut().for_each(|image| image.shift = minus(image.shift, first));
        (class, n_places)
    }

    /// The corners of a cell after the translation that takes one of them home, if all are there.
    pub(super) fn translated_home(&self, row: &G::Vertices, corner: VertexId) -> Option<G::Vertices> {
        let shift = self.images.of(corner).shift;
        debug_assert!(shift != HOME);
        let mut translated = *row;
        for (i, &v) in row.as_ref().iter().enumerate() {
            let image = self.images.of(v);
            let there = self.images.find(image.vertex, minus(image.shift, shift));
            if there == VertexId::NONE {
                return None;
            }
            translated[i] = there;
        }
        Some(translated)
    }
}
