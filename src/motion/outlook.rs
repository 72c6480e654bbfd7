//! What is known of the moves of a commit before an algorithm is chosen for it.
//!
//! Cost: a look at the first few vertices where these show that the moves differ; 2 ns a vertex where nothing moves.

use super::MovingTriangulation;
use super::constants::constants;
use super::staging::Given;
use crate::delaunay::{Dimension, Site};
use crate::ids::VertexId;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::predicates::Array;

/// What vertices are going to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outlook {
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
struct Moves<G: Dimension> {
    /// By which vector all of them go, if by one.
    common: Option<G::Point>,
    n_moving: usize,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// What the vertices are going to do, none of which has moved yet. Whether few move is found out only if that is
    /// asked for: it may take a look at all.
    pub(super) fn outlook(&self, given: &Given<'_, G>, asks_for_few: bool) -> Outlook {
        let staged = given.positions().unwrap_or(self.staging.positions());
        if self.staging.is_whole() {
            let all = VertexId::range(0..self.site_of.len());
            return self.outlook_of(all, staged, asks_for_few);
        }
        debug_assert!(self.staging.applied() == 0);
        self.outlook_of(self.staging.vertices().iter().copied(), staged, asks_for_few)
    }

    /// As [`outlook`](Self::outlook), of these vertices, the only ones that are staged.
    #[inline(always)]
    fn outlook_of(
        &self,
        vertices: impl ExactSizeIterator<Item = VertexId> + Clone,
        staged: &[G::Point],
        asks_for_few: bool,
    ) -> Outlook {
        let (n, are_all) = (self.n_present, vertices.len() == self.n_present);
        let sites = self.kernel.sites();
        let is_far = self.kernel.is_far();
        let mut ahead = vertices.clone().skip(AHEAD);
        let mut moves = Moves::<G> { common: None, n_moving: 0 };
        for (k, v) in vertices.enumerate() {
            if is_far && let Some(next) = ahead.next() {
                prefetch(sites, self.site_of[next].index());
            }
            let is_known = moves.enter(k == 0, &sites[self.site_of[v]], &staged[v]);
            let is_alike = moves.common.is_some();
            if is_known && !is_alike && !(asks_for_few && constants::<G>().are_few(moves.n_moving, n)) {
                return Outlook::Unknown;
            }
        }
        match moves {
            Moves { n_moving: 0, .. } => Outlook::AtRest,
            Moves { common: Some(_), .. } if are_all => Outlook::Together,
            Moves { n_moving, .. } if constants::<G>().are_few(n_moving, n) => Outlook::FewMove,
            _ => Outlook::Unknown,
        }
    }
}

impl<G: Dimension> Moves<G> {
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
