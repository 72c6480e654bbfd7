//! Keys of vertices: what breaks ties between signs, and which of several vertices at a place represents it.
//!
//! Programs give them. Without any, the key of a vertex is its id, and nothing is kept. Keys need not be different:
//! vertices of equal keys at different places are ranked by position, one coordinate after the other, and those at the
//! same place by id. So the order of keys and positions decides the cells, and ids do not.
//!
//! Positions change, and with them the order of vertices that have a key in common. Nothing has to follow that: ranks are
//! asked for where the exact sign is zero, and are those of the places at which it was evaluated.
//!
//! Kernels that are built beside another one, or of parts of its sites, have the keys in common with it. They are
//! changed between changes of the cells alone, when there is one kernel. One that is kept to be put back later has given its
//! share [away](Keys::give_away).

use std::cmp::Ordering;

use super::Shape;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::counted::Counted;
use crate::machine::memory;

/// Keys by vertex id; nothing where all are ids.
#[derive(Debug, Default)]
pub(crate) struct Keys(Option<Counted<Vec<u64>>>);

impl Keys {
    /// The key of vertices that the library makes where vertices have keys.
    pub(crate) const OF_MADE: u64 = u64::MAX;

    /// Whether the key of every vertex is its id.
    #[inline(always)]
    pub(crate) fn are_ids(&self) -> bool {
        self.0.is_none()
    }

    /// The key of a vertex.
    pub(crate) fn of(&self, vertex: VertexId) -> u64 {
        let given = self.0.as_ref().and_then(|keys| keys.get(vertex.index()));
        given.copied().unwrap_or(u64::from(vertex.get()))
    }

    /// The order of vertices at the same place: by key, then by id; [`VertexId::NONE`] is above all.
    #[inline(always)]
    pub(crate) fn order_of(&self, v: VertexId, w: VertexId) -> Ordering {
        if self.are_ids() { v.cmp(&w) } else { self.order_by_key(v, w) }
    }

    #[cold]
    fn order_by_key(&self, v: VertexId, w: VertexId) -> Ordering {
        let rank = |v: VertexId| (v == VertexId::NONE, self.of(v), v);
        rank(v).cmp(&rank(w))
    }

    /// The order of vertices at any places: by key, by place, and then by id.
    pub(crate) fn compare_at(&self, (v, p): (VertexId, &[f64]), (w, q): (VertexId, &[f64])) -> Ordering {
        if self.are_ids() {
            return v.cmp(&w);
        }
        self.of(v).cmp(&self.of(w)).then_with(|| compare_places(p, q)).then(v.cmp(&w))
    }

    /// Whether the first of two vertices at the same place is the one that represents it.
    #[inline(always)]
    pub(crate) fn is_lower(&self, v: VertexId, w: VertexId) -> bool {
        self.order_of(v, w) == Ordering::Less
    }

    /// The one of two vertices at the same place that represents it.
    #[inline(always)]
    pub(crate) fn lower(&self, v: VertexId, w: VertexId) -> VertexId {
        if self.is_lower(w, v) { w } else { v }
    }

    /// The one of two vertices at the same place that the other one hides.
    #[inline(always)]
    pub(crate) fn higher(&self, v: VertexId, w: VertexId) -> VertexId {
        if self.is_lower(w, v) { v } else { w }
    }

    /// Numbers in the order in which ties rank vertices at different places, the last of which may be of no vertex,
    /// [`VertexId::NONE`], which is above all.
    #[inline(always)]
    pub(super) fn ranks<G: Shape, const N: usize>(
        &self,
        vertices: [VertexId; N],
        places: impl FnOnce() -> [G::Point; N],
    ) -> [u32; N] {
        if self.are_ids() {
            vertices.map(VertexId::get)
        } else {
            self.ranks_by_key::<G, N>(vertices, places())
        }
    }

    /// As [`ranks`](Self::ranks), where vertices from this one on are not there yet, and have the
    /// [key](Self::OF_MADE) of those that the library makes.
    #[inline(always)]
    pub(crate) fn ranks_with_made<G: Shape, const N: usize>(
        &self,
        first_made: VertexId,
        vertices: [VertexId; N],
        places: impl FnOnce() -> [G::Point; N],
    ) -> [u32; N] {
        if self.are_ids() {
            return vertices.map(VertexId::get);
        }
        let key = |v| if v < first_made { self.of(v) } else { Self::OF_MADE };
        ranks_of_keys::<G, N>(vertices.map(|v| (false, key(v))), &places(), vertices)
    }

    #[cold]
    #[inline(never)]
    fn ranks_by_key<G: Shape, const N: usize>(
        &self,
        vertices: [VertexId; N],
        places: [G::Point; N],
    ) -> [u32; N] {
        ranks_of_keys::<G, N>(vertices.map(|v| (v == VertexId::NONE, self.of(v))), &places, vertices)
    }

    /// The keys for another kernel of the same vertices.
    pub(super) fn another(&self) -> Self {
        Keys(self.0.as_ref().map(Counted::another))
    }

    /// Keys of their own, equal to these.
    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Keys(match &self.0 {
            Some(keys) => Some(Counted::new(memory::copy_of(keys)?)?),
            None => None,
        }))
    }

    /// The keys of the vertices that have other ids: those listed by the old ones, [`VertexId::NONE`] for those that
    /// have gone; `n` in all.
    pub(super) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        if self.are_ids() {
            return Ok(Keys::default());
        }
        let mut keys = Vec::new();
        memory::lengthen(&mut keys, n, 0)?;
        for (v, &id) in VertexId::range(0..ids.len()).zip(ids).filter(|(_, id)| **id != VertexId::NONE) {
            keys[id.index()] = self.of(v);
        }
        Ok(Keys(Some(Counted::new(keys)?)))
    }

    /// These keys, by vertex id.
    pub(crate) fn of_list(keys: Vec<u64>) -> Result<Self> {
        Ok(Keys(Some(Counted::new(keys)?)))
    }

    /// Makes room to [set](Self::set) keys of the first `n` vertices.
    pub(crate) fn reserve(&mut self, n: usize) -> Result<()> {
        if self.0.is_none() {
            // Made when there is all memory, as there are keys from then on.
            let mut keys = Vec::new();
            memory::reserve_exact(&mut keys, n)?;
            self.0 = Some(Counted::new(keys)?);
            return Ok(());
        }
        let keys = self.list();
        memory::reserve_sparingly(keys, n.saturating_sub(keys.len()))
    }

    /// Gives a vertex a key, for which there is [room](Self::reserve).
    pub(crate) fn set(&mut self, vertex: VertexId, key: u64) {
        let keys = self.list();
        while keys.len() <= vertex.index() {
            keys.push(keys.len() as u64);
        }
        keys[vertex.index()] = key;
    }

    /// Forgets the key of a vertex, which gets its id for one.
    pub(crate) fn unset(&mut self, vertex: VertexId) {
        if self.0.is_none() {
            return;
        }
        let keys = self.list();
        if vertex.index() < keys.len() {
            keys[vertex.index()] = u64::from(vertex.get());
        }
    }

    /// Forgets the keys of all but the first `n` vertices.
    pub(crate) fn truncate(&mut self, n: usize) {
        if self.0.is_some() {
            self.list().truncate(n);
        }
    }

    /// Leaves these, of a kernel that is kept while another one is in use, to that one, which has them in common.
    pub(crate) fn give_away(&mut self) {
        self.0 = None;
    }

    fn list(&mut self) -> &mut Vec<u64> {
        let keys = self.0.as_mut().expect("there are keys");
        keys.get_mut().expect("there is one kernel between changes")
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.0.as_ref().map_or(0, |keys| size_of::<Vec<u64>>() + size_of::<usize>() + memory::bytes_of(keys))
    }
}

/// The order of places, one coordinate after the other. They are finite, without negative zeros.
fn compare_places(p: &[f64], q: &[f64]) -> Ordering {
    p.iter().zip(q).map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

/// The number of vertices below each, by keys that may be above all, by places, and by ids: with weights, several sites may be
/// at a place.
fn ranks_of_keys<G: Shape, const N: usize>(
    keys: [(bool, u64); N],
    places: &[G::Point; N],
    vertices: [VertexId; N],
) -> [u32; N] {
    let mut n_below = [0; N];
    for i in 1..N {
        for k in 0..i {
            let by_key = keys[k].cmp(&keys[i]);
            let order = by_key
                .then_with(|| compare_places(places[k].as_ref(), places[i].as_ref()))
                .then_with(|| vertices[k].cmp(&vertices[i]));
            n_below[if order == Ordering::Less { i } else { k }] += 1;
        }
    }
    n_below
}
