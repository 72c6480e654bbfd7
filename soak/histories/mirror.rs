//! What a program keeps for each cell, carried along by the change lists alone: as in tests/common/carried.rs, but in
//! arrays, for tens of thousands of cells, and through compactions.

use deldrift::motion::MovingTriangulation;
use deldrift::{CellId, Dimension, VertexId};
use std::collections::HashSet;

/// A row for each cell, and a mark for each hidden vertex, of when the changes were last taken.
#[derive(Debug)]
pub struct Mirror<G: Dimension> {
    rows: Vec<G::Vertices>,
    is_hidden: Vec<bool>,
}

impl<G: Dimension> Default for Mirror<G> {
    fn default() -> Self {
        Mirror { rows: Vec::new(), is_hidden: Vec::new() }
    }
}

fn sorted<C: Copy + AsMut<[VertexId]>>(mut row: C) -> C {
    row.as_mut().sort_unstable();
    row
}

impl<G: Dimension> Mirror<G> {
    /// Takes the changes, carries the rows along, and compares them with the cells.
    ///
    /// # Errors
    /// What is wrong.
    pub fn follow(&mut self, t: &mut MovingTriangulation<G>) -> Result<(), String> {
        let changes = t.take_changes().map_err(|error| error.to_string())?;
        let mut carried: Vec<Option<G::Vertices>> = self.rows.iter().copied().map(Some).collect();
        let mut is_in_star = vec![false; self.is_hidden.len()];
        let mut note_star = |row: &G::Vertices| {
            for v in row.as_ref() {
                let n = is_in_star.len().max(v.index() + 1);
                is_in_star.resize(n, false);
                is_in_star[v.index()] = true;
            }
        };
        for (&index, corners) in changes.removed.iter().zip(changes.removed_corners) {
            let there = carried.get_mut(index.index()).and_then(Option::take);
            if there != Some(*corners) {
                return Err(format!("cell {index} was {there:?}, and is listed as removed {corners:?}"));
            }
            note_star(corners);
        }
        let renumbered = changes.renumbered_from.iter().zip(changes.renumbered_to);
        let renumbered: Vec<(CellId, CellId)> = renumbered.map(|(&from, &to)| (from, to)).collect();
        let taken: Vec<Option<G::Vertices>> =
            renumbered.iter().map(|(from, _)| carried.get_mut(from.index()).and_then(Option::take)).collect();
        let removed: HashSet<G::Vertices> = changes.removed_corners.iter().map(|&row| sorted(row)).collect();
        let created = changes.created.to_vec();
        let stars = changes.stars.to_vec();
        let visibilities = [changes.hidden.to_vec(), changes.shown.to_vec()];

        let rows = t.cells().map_err(|error| error.to_string())?.corners;
        carried.resize(carried.len().max(rows.len()), None);
        let fresh = created.iter().map(|&index| (rows.get(index.index()).copied(), index));
        let moved = taken.into_iter().zip(&renumbered).map(|(row, &(_, to))| (row, to));
        for (row, index) in moved.chain(fresh) {
            match carried.get_mut(index.index()) {
                Some(place @ None) if row.is_some() => *place = row,
                place => return Err(format!("{row:?} comes to {index}, where there is {place:?}")),
            }
        }
        for &index in &created {
            note_star(&rows[index]);
            if removed.contains(&sorted(rows[index])) {
                return Err(format!("cell {index}, {:?}, is listed as removed and created", rows[index]));
            }
        }
        if carried.len() > rows.len() && carried[rows.len()..].iter().any(Option::is_some) {
            return Err(format!("cells are carried beyond the last of {}", rows.len()));
        }
        for (index, (row, carried)) in rows.iter().zip(&carried).enumerate() {
            if carried.map(sorted) != Some(sorted(*row)) {
                return Err(format!("cell {index} is {row:?}, and {carried:?} was carried there"));
            }
        }
        let marked = (0..is_in_star.len()).filter(|&v| is_in_star[v]);
        if !marked.eq(stars.iter().map(|v| v.index())) {
            return Err("the list of changed stars is not that of created and removed cells".to_string());
        }
        self.rows = rows.to_vec();
        self.follow_visibilities(t, visibilities)
    }

    fn follow_visibilities(
        &mut self,
        t: &MovingTriangulation<G>,
        [hidden, shown]: [Vec<VertexId>; 2],
    ) -> Result<(), String> {
        let ids = VertexId::range(0..t.id_count());
        let now: Vec<bool> =
            ids.clone().map(|v| t.coincident_representative(v).is_ok_and(|r| r != v)).collect();
        let was = |v: VertexId| self.is_hidden.get(v.index()) == Some(&true);
        let expected_hidden = ids.clone().filter(|&v| now[v.index()] && !was(v));
        let expected_shown = ids.clone().filter(|&v| was(v) && !now[v.index()] && t.is_present(v));
        if !expected_hidden.eq(hidden) || !expected_shown.eq(shown) {
            return Err("the lists of hidden and shown vertices are not what has changed".to_string());
        }
        self.is_hidden = now;
        Ok(())
    }

    /// The vertices have new ids; those that are gone are in no cell.
    pub fn rename(&mut self, new: &[VertexId], n: usize) {
        for v in self.rows.iter_mut().flat_map(|row| row.as_mut()) {
            *v = new[*v];
        }
        let mut is_hidden = vec![false; n];
        for (&v, &was) in new.iter().zip(&self.is_hidden) {
            if v != VertexId::NONE {
                is_hidden[v.index()] = was;
            }
        }
        self.is_hidden = is_hidden;
    }
}
