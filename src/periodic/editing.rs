//! What comes and goes in a commit beside moves: insertions and removals, as they are inside.
//!
//! A vertex comes with the images that it will most likely need; others are found missing like those of vertices that have
//! moved. One that goes takes all of its images along. Their ids inside are not given again, so after many edits the
//! triangulation is built anew, and as well when there are far more or fewer vertices than at the last build, whose mean
//! distance is what the margin of images is told by.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::periodic::images::Image;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{HOME, Lattice, Occupied};
use crate::periodic::needed::{for_images, keys_of};
use crate::periodic::rounds::MovedBefore;
use crate::periodic::staged::Staged;

/// To build anew costs less than more than one edit and so many, as a share of the vertices.
const EDITS_AT_MOST: f64 = 0.1;

/// The vertices are at most so many times as many as when all was built, or as few.
const GROWTH: usize = 2;

/// Insertions and removals.
#[derive(Debug)]
pub(super) struct ImageEdits<G: Moving> {
    /// Vertices that come, and then images of them, in the order of the ids that they get inside.
    images: Vec<Image>,
    places: Vec<G::Point>,
    /// By vertex that comes, by which translation it comes home.
    wraps: Vec<[i64; 3]>,
    /// Vertices that go, ascending.
    going: Vec<VertexId>,
    /// Their ids inside, images included: those of a vertex one after the other, as it lists them.
    going_inside: Vec<VertexId>,
}

impl<G: Moving> ImageEdits<G> {
    /// What is staged, if that costs less than to build anew; vertices that come are at the places that `position_of` tells by
    /// their number.
    pub(super) fn of(
        inside: &Inside<G>,
        lattice: &Lattice<G>,
        staged: &Staged<G>,
        position_of: impl Fn(usize) -> G::Point,
    ) -> Result<Option<Self>> {
        let (n_coming, n_going) = (staged.insertions().len(), staged.removals().len());
        if !inside.can_edit(n_coming, n_going) {
            return Ok(None);
        }
        let (images, places, wraps) = (Vec::new(), Vec::new(), Vec::new());
        let (mut going, going_inside) = (memory::copy_of(staged.removals())?, Vec::new());
        going.sort_unstable();
        let mut edits = ImageEdits { images, places, wraps, going, going_inside };
        for &vertex in &edits.going {
            for inner in inside.images.all_of(vertex) {
                memory::push(&mut edits.going_inside, inner)?;
            }
        }
        let n = inside.images.n_vertices();
        for index in 0..n_coming {
            let (place, wrap) = lattice.wrapped("positions", n + index, &position_of(index))?;
            memory::push(&mut edits.images, Image { vertex: VertexId::at(n + index), shift: HOME })?;
            memory::push(&mut edits.places, place)?;
            memory::push(&mut edits.wraps, wrap)?;
        }
        let mut occupied = inside.occupied;
        edits.enter(lattice, &mut occupied);
        for index in 0..n_coming {
            let (vertex, place) = (edits.images[index].vertex, edits.places[index]);
            let mut enter = |shift| {
                memory::push(&mut edits.images, Image { vertex, shift })?;
                memory::push(&mut edits.places, lattice.translated(&place, shift))
            };
            for_images(lattice, &place, inside.spacing, &occupied, &mut enter)?;
        }
        Ok(Some(edits))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.images.is_empty() && self.going.is_empty()
    }

    /// Vertices that come occupy their places.
    pub(super) fn enter(&self, lattice: &Lattice<G>, occupied: &mut Occupied) {
        self.places[..self.wraps.len()].iter().for_each(|place| lattice.enter(occupied, place));
    }

    /// Vertices that go are translated by nothing.
    pub(super) fn forget_wraps(&self, wraps: &mut Vec<(VertexId, [i64; 3])>) -> Result<()> {
        memory::collect(wraps, self.going.iter().map(|&vertex| (vertex, [0; 3])))
    }

    /// By vertex that comes, by which translation it comes home.
    pub(super) fn wraps(&self) -> &[[i64; 3]] {
        &self.wraps
    }

    /// Vertices that go, ascending.
    pub(super) fn going(&self) -> &[VertexId] {
        &self.going
    }

    /// The ids inside of vertices that go and their images, those of a vertex one after the other.
    pub(super) fn into_going_inside(self) -> Vec<VertexId> {
        self.going_inside
    }

    /// The number of vertices and images that come.
    pub(super) fn len(&self) -> usize {
        self.images.len()
    }
}

impl<G: Moving> Inside<G> {
    /// Whether so many vertices may come and go without a build.
    fn can_edit(&self, n_coming: usize, n_going: usize) -> bool {
        let n = self.images.n_present();
        let n_after = n + n_coming - n_going;
        n_coming + n_going == 0
            || (n_coming + n_going) as f64 <= (EDITS_AT_MOST * n as f64).max(1.0)
                && n_after <= GROWTH * self.n_built
                && GROWTH * n_after >= self.n_built
                && self.images.n_gone() <= self.images.len() / 2
    }

    /// Stages the edits, and makes room for them among the images.
    pub(super) fn stage(&mut self, edits: &ImageEdits<G>) -> Result<()> {
        if edits.is_empty() {
            return Ok(());
        }
        self.images.reserve(edits.wraps.len(), edits.images.len())?;
        self.t.stage_removals(&edits.going_inside)?;
        self.t.stage_insertions_with_keys(&edits.places, &keys_of(&edits.images)?)?;
        Ok(())
    }

    /// What has come is known; there is room.
    pub(super) fn enter_coming(&mut self, edits: &ImageEdits<G>) {
        edits.images.iter().for_each(|&image| self.images.push(image));
    }

    /// What a round of moves and edits has changed is known: vertices at home have the places in `before`, for those
    /// that they had; what has come has places, and what has gone is known no more. There is room among the places.
    pub(super) fn settle(&mut self, edits: &ImageEdits<G>, before: &mut MovedBefore<G>) {
        self.exchange_places(&mut before.places);
        if !edits.images.is_empty() {
            self.places.resize(before.n_images, G::Point::default());
            self.places.extend_from_slice(&edits.places);
        }
        edits.going.iter().for_each(|&vertex| self.images.remove(vertex));
    }
}
