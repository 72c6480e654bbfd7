//! What a program keeps for each cell, carried along by the change lists alone.

use super::{Rng, sorted};
use deldrift::motion::{Changes, MovingTriangulation};
use deldrift::{CellId, Moving, VertexId};
use std::collections::{BTreeMap, BTreeSet};

/// A copy of a change list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct List {
    pub created: Vec<CellId>,
    pub removed: Vec<CellId>,
    pub removed_corners: Vec<Vec<VertexId>>,
    pub renumbered: Vec<(CellId, CellId)>,
    pub stars: Vec<VertexId>,
    pub hidden: Vec<VertexId>,
    pub shown: Vec<VertexId>,
}

impl List {
    pub fn of<C: AsRef<[VertexId]>>(changes: &Changes<'_, C>) -> Self {
        assert_eq!(changes.removed.len(), changes.removed_corners.len());
        assert_eq!(changes.renumbered_from.len(), changes.renumbered_to.len());
        let renumbered = changes.renumbered_from.iter().zip(changes.renumbered_to);
        List {
            created: changes.created.to_vec(),
            removed: changes.removed.to_vec(),
            removed_corners: changes.removed_corners.iter().map(|row| row.as_ref().to_vec()).collect(),
            renumbered: renumbered.map(|(&from, &to)| (from, to)).collect(),
            stars: changes.stars.to_vec(),
            hidden: changes.hidden.to_vec(),
            shown: changes.shown.to_vec(),
        }
    }

    pub fn is_empty(&self) -> bool {
        *self == List::default()
    }
}

/// Takes the changes.
pub fn take<G: Moving>(t: &mut MovingTriangulation<G>) -> deldrift::Result<List> {
    t.take_changes().map(|changes| List::of(&changes))
}

/// Something for each cell of when the changes were last taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carried {
    /// By index, the sorted corners.
    pub cells: Vec<Vec<VertexId>>,
    /// The corners of each of them in the order in which they were listed then.
    orders: BTreeMap<Vec<VertexId>, Vec<VertexId>>,
    pub hidden: BTreeSet<VertexId>,
}

/// The vertices that are hidden.
pub fn hidden_of<G: Moving>(t: &MovingTriangulation<G>) -> BTreeSet<VertexId> {
    let is_hidden = |v: &VertexId| t.coincident_representative(*v).is_ok_and(|r| r != *v);
    VertexId::range(0..t.id_count()).filter(is_hidden).collect()
}

impl Carried {
    /// Takes the changes, carries all along, and compares it with what there is.
    pub fn take<G: Moving>(&mut self, t: &mut MovingTriangulation<G>, context: &dyn Fn() -> String) -> List {
        let list = take(t).expect("room");
        self.follow(t, &list, context);
        let again = take(t).expect("room");
        assert!(again.is_empty(), "{}: taken twice: {again:?}", context());
        list
    }

    /// Carries all along by a list that has just been taken.
    pub fn follow<G: Moving>(
        &mut self,
        t: &MovingTriangulation<G>,
        list: &List,
        context: &dyn Fn() -> String,
    ) {
        let context = || format!("{}; {list:?}", context());
        let rows = t.cells().expect("room").corners;
        let mut cells: Vec<Option<Vec<VertexId>>> =
            std::mem::take(&mut self.cells).into_iter().map(Some).collect();
        let before = cells.clone();
        let mut stars = BTreeSet::new();
        let mut removed = BTreeSet::new();
        for (&index, corners) in list.removed.iter().zip(&list.removed_corners) {
            let there = cells[index].take();
            assert_eq!(there, Some(sorted(corners)), "{}: removed {index}", context());
            let order = self.orders.get(&sorted(corners));
            assert_eq!(order, Some(corners), "{}: removed {index}", context());
            removed.insert(sorted(corners));
            stars.extend(corners);
        }
        let mut moving = Vec::new();
        for &(from, to) in &list.renumbered {
            assert_ne!(from, to, "{}", context());
            let there = cells[from].take();
            assert!(there.is_some(), "{}: {from} is listed twice", context());
            moving.push((there, to));
        }
        let created = list.created.iter().map(|&index| (Some(sorted(rows[index].as_ref())), index));
        let most = cells.len().max(rows.len());
        cells.resize(most, None);
        for (cell, index) in moving.into_iter().chain(created) {
            let place = &mut cells[index];
            assert!(place.is_none(), "{}: {index} is taken", context());
            *place = cell;
        }
        assert!(list.created.is_sorted_by(|a, b| a < b), "{}", context());
        for &index in &list.created {
            let corners = sorted(rows[index].as_ref());
            assert!(!removed.contains(&corners), "{}: {corners:?} was there", context());
            stars.extend(corners);
        }
        assert!(cells[rows.len()..].iter().all(Option::is_none), "{}: cells beyond the end", context());
        cells.truncate(rows.len());
        for (index, (cell, row)) in cells.iter().zip(rows).enumerate() {
            assert_eq!(
                cell.as_ref(),
                Some(&sorted(row.as_ref())),
                "{}: cell {index}, before {:?}",
                context(),
                before.get(index)
            );
        }
        self.cells = cells.into_iter().flatten().collect();
        self.orders = rows.iter().map(|row| (sorted(row.as_ref()), row.as_ref().to_vec())).collect();

        assert!(stars.iter().eq(&list.stars), "{}: stars {stars:?}", context());
        let now = hidden_of(t);
        assert!(now.difference(&self.hidden).eq(&list.hidden), "{}: hidden {now:?}", context());
        let shown = self.hidden.difference(&now).filter(|&&v| t.is_present(v));
        assert!(shown.eq(&list.shown), "{}: hidden {now:?}, were {:?}", context(), self.hidden);
        self.hidden = now;
    }
}

/// Some vertex that is present.
pub fn some_present<P>(positions: &[Option<P>], rng: &mut Rng) -> Option<VertexId> {
    let present: Vec<VertexId> =
        VertexId::range(0..positions.len()).filter(|&v| positions[v].is_some()).collect();
    (!present.is_empty()).then(|| *rng.pick(&present))
}
