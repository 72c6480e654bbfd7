//! What is known of the moves of a commit before an algorithm is chosen for it.
//!
//! Cost: a look at the first few vertices where these show that the moves differ; 2 ns a vertex where nothing moves.

use crate::delaunay::{Moving, Site};
use crate::ids::VertexId;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::goals::{Movers, Moves};
use crate::motion::state::mesh::Mesh;
use crate::predicates::PointArray;

/// What vertices are going to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Outlook {
    /// None moves.
    AtRest,
    /// All vertices that there are move by the same vector, without any rounding.
    Together,
    /// Few move.
    FewMove,
    /// Something else, as far as is known.
    Unknown,
}

/// What the vertices looked at so far do.
struct Seen<G: Moving> {
    /// By which vector all of them go, if by one.
    common: Option<G::Point>,
    n_moving: usize,
}

impl<G: Moving> Mesh<G> {
    /// What the vertices are going to do, none of which has moved yet. Whether few move is found out only if that is
    /// asked for: it may take a look at all.
    pub(in crate::motion) fn outlook(&self, moves: &Moves<'_, G>, asks_for_few: bool) -> Outlook {
        let goals = moves.unchecked();
        match moves.movers() {
            Movers::All => self.outlook_of(VertexId::range(0..goals.len()), goals, asks_for_few),
            Movers::Listed(vertices) => self.outlook_of(vertices.iter().copied(), goals, asks_for_few),
        }
    }

    /// What these vertices are going to do, the only ones that may move.
    #[inline(always)]
    fn outlook_of(
        &self,
        vertices: impl ExactSizeIterator<Item = VertexId> + Clone,
        goals: &[G::Point],
        asks_for_few: bool,
    ) -> Outlook {
        let (n, are_all) = (self.n_present, vertices.len() == self.n_present);
        let sites = self.kernel.sites();
        let is_far = self.kernel.is_far();
        let n_at_rest = self.leading_at_rest(vertices.clone(), goals);
        let mut seen = Seen::<G> { common: (n_at_rest > 0).then(G::Point::default), n_moving: 0 };
        let mut ahead = vertices.clone().skip(n_at_rest + AHEAD);
        for (k, v) in vertices.enumerate().skip(n_at_rest) {
            if is_far && let Some(next) = ahead.next() {
                prefetch(sites, self.site_of[next].index());
            }
            let is_known = seen.enter(k == 0, &sites[self.site_of[v]], &goals[v]);
            let is_alike = seen.common.is_some();
            if is_known && !is_alike && !(asks_for_few && self.constants.are_few(seen.n_moving, n)) {
                return Outlook::Unknown;
            }
        }
        match seen {
            Seen { n_moving: 0, .. } => Outlook::AtRest,
            Seen { common: Some(_), .. } if are_all => Outlook::Together,
            Seen { n_moving, .. } if self.constants.are_few(n_moving, n) => Outlook::FewMove,
            _ => Outlook::Unknown,
        }
    }
}

impl<G: Moving> Mesh<G> {
    /// How many of these vertices, from the first on, are where they are to go.
    #[inline(always)]
    fn leading_at_rest(&self, vertices: impl Iterator<Item = VertexId> + Clone, goals: &[G::Point]) -> usize {
        let (sites, site_of) = (self.kernel.sites(), &*self.site_of);
        let is_there = |v: VertexId| sites[site_of[v]].point == goals[v];
        if !self.kernel.is_far() {
            return vertices.take_while(|&v| is_there(v)).count();
        }
        let mut ahead = vertices.clone().skip(AHEAD);
        let announced = vertices.inspect(|_| {
            if let Some(next) = ahead.next() {
                prefetch(sites, site_of[next].index());
            }
        });
        announced.take_while(|&v| is_there(v)).count()
    }
}

impl<G: Moving> Seen<G> {
    /// Enters a vertex; whether anything else is known now than before.
    #[inline(always)]
    fn enter(&mut self, is_first: bool, site: &Site<G>, place: &G::Point) -> bool {
        let is_at_rest = site.point == *place;
        self.n_moving += usize::from(!is_at_rest);
        if is_first {
            self.common = place.exact_difference(&site.point);
            return true;
        }
        if is_at_rest && self.n_moving == 0 {
            return false;
        }
        if let Some(common) = &self.common
            && place.exact_difference(&site.point).as_ref() != Some(common)
        {
            self.common = None;
        }
        true
    }
}
