//! What undoes the rounds of a timestamp that is being prepared, beside what the triangulation inside keeps of its
//! own rounds.
//!
//! A round leaves here what it has put something else in the place of: arrays where all entries have changed,
//! otherwise the entries that have. So nothing is copied for it, and to go back needs no memory.

use std::sync::OnceLock;

use crate::delaunay::Moving;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::CommitReport;
use crate::periodic::cells::PeriodicCells;
use crate::periodic::edges::PeriodicEdges;
use crate::periodic::images::Image;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{Lattice, Occupied};

/// What a triangulation was at its timestamp, while another one is prepared.
#[derive(Debug)]
pub(super) struct BeforeRounds<G: Moving> {
    pub(super) statistics: CommitReport,
    pub(super) cells: OnceLock<PeriodicCells<G>>,
    pub(super) edges: OnceLock<PeriodicEdges>,
    pub(super) rounds: Vec<RoundBefore<G>>,
}

/// What there was before a round.
#[derive(Debug)]
pub(super) enum RoundBefore<G: Moving> {
    /// Of one that has built another triangulation.
    Built { inside: Box<Inside<G>>, wraps: Wraps, lattice: Option<Box<Lattice<G>>> },
    /// Of one that has not.
    Moved(MovedBefore<G>),
}

/// By vertex, the translation by which it went from where it was given to home.
pub(super) type Wraps = Vec<[i64; 3]>;

/// What there was before a round of moves and few edits.
#[derive(Debug)]
pub(super) struct MovedBefore<G: Moving> {
    /// How many ids there were inside.
    pub(super) n_images: usize,
    pub(super) n_places: usize,
    pub(super) occupied: Occupied,
    /// The places of all, or of some.
    pub(super) places: PlacesBefore<G>,
    /// Vertices that have come home by another translation, and by which one they had.
    pub(super) wraps: Vec<(VertexId, [i64; 3])>,
    /// The ids inside of vertices that have been removed and their images, those of a vertex one after the other.
    pub(super) removed: Vec<VertexId>,
    /// The lattice and the images in it, if it is another one now.
    pub(super) other: Option<(Box<Lattice<G>>, Vec<Image>)>,
}

/// Where vertices were that are at home.
#[derive(Debug)]
pub(super) enum PlacesBefore<G: Moving> {
    All(Vec<G::Point>),
    /// By ids inside; those of images say nothing.
    Some(Vec<VertexId>, Vec<G::Point>),
}

impl<G: Moving> BeforeRounds<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.cells.get().map_or(0, PeriodicCells::memory_bytes)
            + self.edges.get().map_or(0, |edges| memory::bytes_of(&edges.list))
            + memory::bytes_of(&self.rounds)
            + self.rounds.iter().map(RoundBefore::memory_bytes).sum::<usize>()
    }
}

impl<G: Moving> RoundBefore<G> {
    fn memory_bytes(&self) -> usize {
        match self {
            Self::Built { inside, wraps, .. } => inside.memory_bytes() + memory::bytes_of(wraps),
            Self::Moved(moved) => {
                let places = match &moved.places {
                    PlacesBefore::All(places) => memory::bytes_of(places),
                    PlacesBefore::Some(ids, places) => memory::bytes_of(ids) + memory::bytes_of(places),
                };
                places
                    + memory::bytes_of(&moved.wraps)
                    + memory::bytes_of(&moved.removed)
                    + moved.other.as_ref().map_or(0, |(_, images)| memory::bytes_of(images))
            }
        }
    }
}

impl<G: Moving> MovedBefore<G> {
    /// The vertices that have come home by other translations get these, for those that they have.
    pub(super) fn exchange_wraps(&mut self, wraps: &mut [[i64; 3]]) {
        self.wraps.iter_mut().for_each(|(vertex, wrap)| std::mem::swap(wrap, &mut wraps[*vertex]));
    }
}

impl<G: Moving> Inside<G> {
    /// Puts images and places back.
    pub(super) fn put_back(&mut self, before: &mut MovedBefore<G>) {
        self.occupied = before.occupied;
        self.images.truncate(before.n_images);
        if let Some((_, images)) = &mut before.other {
            self.images.exchange(images);
        }
        before.removed.iter().rev().for_each(|&inner| self.images.put_back(inner));
        self.exchange_places(&mut before.places);
        self.places.truncate(before.n_places);
    }

    /// What there is before a round, of which places and translations are to be entered.
    pub(super) fn before_round(&self) -> MovedBefore<G> {
        MovedBefore {
            n_images: self.images.len(),
            n_places: self.places.len(),
            occupied: self.occupied,
            places: PlacesBefore::Some(Vec::new(), Vec::new()),
            wraps: Vec::new(),
            removed: Vec::new(),
            other: None,
        }
    }

    /// Vertices at home get these places, for those that they have.
    pub(super) fn exchange_places(&mut self, places: &mut PlacesBefore<G>) {
        match places {
            PlacesBefore::All(places) => std::mem::swap(&mut self.places, places),
            PlacesBefore::Some(ids, places) => {
                for (&inner, place) in
                    ids.iter().zip(places).filter(|(inner, _)| self.images.is_home(**inner))
                {
                    std::mem::swap(&mut self.places[inner], place);
                }
            }
        }
    }
}
