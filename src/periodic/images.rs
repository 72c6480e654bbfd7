//! Which vertex, and which image of it, each vertex inside is.

use crate::error::{Error, Result, StagedEdit};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::periodic::lattice::{HOME, Shift};

/// A vertex, translated by a shift from home.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Image {
    pub(super) vertex: VertexId,
    pub(super) shift: Shift,
}

impl Image {
    /// What an id inside is whose vertex has been removed at an earlier timestamp.
    pub(super) const GONE: Self = Image { vertex: VertexId::NONE, shift: [i32::MIN; 3] };
}

/// The images by the ids that they have inside, and those ids by image.
#[derive(Debug, Default)]
pub(super) struct Images {
    images: Vec<Image>,
    /// By id inside, the next image of the same vertex.
    next: Vec<VertexId>,
    /// By vertex, the id inside of the one at home, where the list of its images begins; none for a removed vertex.
    home: Vec<VertexId>,
    /// The ids inside that are lower than this are of vertices at home, or of none.
    n_first: usize,
    /// The ids inside that are lower than this are those of the vertices themselves, or of none.
    n_same: usize,
    /// The number of vertices that are there.
    n_present: usize,
    /// The number of ids inside that are of none.
    n_gone: usize,
}

impl Images {
    /// The number of ids that vertices have been given.
    pub(super) fn n_vertices(&self) -> usize {
        self.home.len()
    }

    /// The number of vertices that are there.
    pub(super) fn n_present(&self) -> usize {
        self.n_present
    }

    /// The number of ids inside whose vertices have been removed.
    pub(super) fn n_gone(&self) -> usize {
        self.n_gone
    }

    /// The number of ids inside.
    pub(super) fn len(&self) -> usize {
        self.images.len()
    }

    /// All, by the ids inside; some may be of vertices that are [not there](Self::is_there).
    pub(super) fn as_slice(&self) -> &[Image] {
        &self.images
    }

    /// Whether the vertex of an image has not been removed.
    pub(super) fn is_there(&self, image: &Image) -> bool {
        *image != Image::GONE && self.home[image.vertex] != VertexId::NONE
    }

    /// The vertices that are there, in the order of ids, each with its id inside at home. These ids ascend as well.
    pub(super) fn homes(&self) -> impl Iterator<Item = (VertexId, VertexId)> + Clone + '_ {
        let homes = VertexId::range(0..self.home.len()).zip(&self.home);
        homes.filter(|&(_, &inside)| inside != VertexId::NONE).map(|(vertex, &inside)| (vertex, inside))
    }

    /// Whether a corner of a cell inside is at home.
    #[inline(always)]
    pub(super) fn is_home(&self, inside: VertexId) -> bool {
        // Of those that were there when all was built it is known without a look.
        inside.index() < self.n_first || self.images[inside].shift == HOME
    }

    /// Which one this is inside.
    #[inline(always)]
    pub(super) fn of(&self, inside: VertexId) -> Image {
        self.images[inside]
    }

    /// Of which vertex a corner of a cell inside is an image.
    #[inline(always)]
    pub(super) fn vertex(&self, inside: VertexId) -> VertexId {
        if inside.index() < self.n_same { inside } else { self.images[inside].vertex }
    }

    /// A vertex at home, as it is known inside; none for a removed vertex.
    pub(super) fn home(&self, vertex: VertexId) -> VertexId {
        self.home[vertex]
    }

    /// An image as it is known inside; none if it is not there.
    pub(super) fn find(&self, vertex: VertexId, shift: Shift) -> VertexId {
        let mut inside = self.home[vertex];
        while inside != VertexId::NONE && self.images[inside].shift != shift {
            inside = self.next[inside];
        }
        inside
    }

    /// All images of a vertex, as they are known inside; the one at home first.
    pub(super) fn all_of(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        let first = Some(self.home[vertex]).filter(|&inside| inside != VertexId::NONE);
        std::iter::successors(first, |&inside| Some(self.next[inside]).filter(|&next| next != VertexId::NONE))
    }

    /// The id inside of a vertex that must be there; `n_coming` more are staged.
    pub(super) fn check(&self, index: usize, vertex: VertexId, n_coming: usize) -> Result<VertexId> {
        let (argument, n, staged) = ("vertices", self.home.len(), StagedEdit::Insertion);
        match self.home.get(vertex.index()) {
            Some(&VertexId::NONE) => Err(Error::RemovedVertex { argument, index, vertex }),
            Some(&inside) => Ok(inside),
            None if vertex.index() < n + n_coming => {
                Err(Error::StagedVertex { argument, index, vertex, staged })
            }
            None => Err(Error::NoSuchVertex { argument, index, vertex, ids: n + n_coming }),
        }
    }

    /// The ids up to this one are those of removed vertices; there is room.
    pub(super) fn skip_to(&mut self, vertex: VertexId) {
        self.home.resize(vertex.index(), VertexId::NONE);
    }

    /// Makes room for more.
    pub(super) fn reserve(&mut self, n_vertices: usize, n_inside: usize) -> Result<()> {
        memory::reserve(&mut self.home, n_vertices)?;
        memory::reserve(&mut self.images, n_inside)?;
        memory::reserve(&mut self.next, n_inside)
    }

    /// Enters the next vertex, at home, or an image of one that is there, under the next id inside; there is room.
    pub(super) fn push(&mut self, image: Image) {
        let inside = VertexId::at(self.images.len());
        let next = if image.shift == HOME {
            debug_assert_eq!(image.vertex.index(), self.home.len());
            self.home.push(inside);
            self.n_present += 1;
            let n = self.images.len();
            self.n_first += usize::from(self.n_first == n);
            self.n_same += usize::from(self.n_same == n && image.vertex.index() == n);
            VertexId::NONE
        } else {
            let home = self.home[image.vertex];
            std::mem::replace(&mut self.next[home], inside)
        };
        self.images.push(image);
        self.next.push(next);
    }

    /// Enters an id inside whose vertex has been removed; there is room.
    pub(super) fn push_gone(&mut self) {
        self.n_first += usize::from(self.n_first == self.images.len());
        self.images.push(Image::GONE);
        self.next.push(VertexId::NONE);
        self.n_gone += 1;
    }

    /// A vertex that is there is removed, with all of its images. What their ids inside were is known until it is
    /// [forgotten](Self::forget).
    pub(super) fn remove(&mut self, vertex: VertexId) {
        let mut inside = std::mem::replace(&mut self.home[vertex], VertexId::NONE);
        self.n_present -= 1;
        while inside != VertexId::NONE {
            self.n_gone += 1;
            inside = std::mem::replace(&mut self.next[inside], VertexId::NONE);
        }
    }

    /// An id inside is of a removed vertex for good.
    pub(super) fn forget(&mut self, inside: VertexId) {
        self.images[inside] = Image::GONE;
    }

    /// An image of a vertex that has been removed is there again; those that its list had behind it are there already.
    pub(super) fn put_back(&mut self, inside: VertexId) {
        let image = self.images[inside];
        self.next[inside] = std::mem::replace(&mut self.home[image.vertex], inside);
        self.n_gone -= 1;
        self.n_present += usize::from(image.shift == HOME);
    }

    /// Has all images with the shifts that another list of them has, which becomes what this has had.
    pub(super) fn exchange(&mut self, images: &mut Vec<Image>) {
        std::mem::swap(&mut self.images, images);
    }

    /// Forgets all images but those with the lowest ids inside; none of the others has been removed.
    pub(super) fn truncate(&mut self, n_inside: usize) {
        while self.images.len() > n_inside {
            let inside = VertexId::at(self.images.len() - 1);
            let image = self.images[inside];
            let mut before = self.home[image.vertex];
            if before == inside {
                self.home.pop();
                self.n_present -= 1;
            } else {
                // Images are entered behind the first one, so the last to come is found soon.
                while self.next[before] != inside {
                    before = self.next[before];
                }
                self.next[before] = self.next[inside];
            }
            self.images.pop();
            self.next.pop();
        }
        self.n_first = self.n_first.min(n_inside);
        self.n_same = self.n_same.min(n_inside);
    }

    pub(super) fn copied(&self) -> Result<Self> {
        let (images, next) = (memory::copy_of(&self.images)?, memory::copy_of(&self.next)?);
        Ok(Images { images, next, home: memory::copy_of(&self.home)?, ..*self })
    }

    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.images) + memory::bytes_of(&self.next) + memory::bytes_of(&self.home)
    }
}
