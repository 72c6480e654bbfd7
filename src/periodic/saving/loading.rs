//! Making a triangulation of bytes that may be anything.

use std::sync::OnceLock;

use crate::damage::{Damage, LoadError};
use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{
    MAX_VERTICES, MovingTriangulation, N_SUMS_OF_WEIGHTS, Options, PointPart, Reader, Saved, check_position,
    copy_part, enter_sums_of_weights, numbers_of, staged_part,
};
use crate::periodic::images::{Image, Images};
use crate::periodic::inside::{Inside, InsideBefore};
use crate::periodic::lattice::{HOME, Lattice, Occupied};
use crate::periodic::saving::SavedPeriodic;
use crate::periodic::saving::header::{PeriodicHeader, SIZE};
use crate::periodic::staged::Staged;
use crate::periodic::triangulation::{PeriodicTriangulation, check_options, spacing};

/// What is staged, as it is read.
struct StagedLists<G: Moving> {
    vectors: Vec<G::Point>,
    goals: Vec<G::Point>,
    insertions: Vec<G::Point>,
    moves: Vec<VertexId>,
    removals: Vec<VertexId>,
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// The triangulation that has been saved, under other options. The cells have the indices that they had.
    ///
    /// After the same calls the loaded triangulation has the same cells as the saved one: cells created by these calls may
    /// have other indices.
    ///
    /// Cost: that of [`MovingTriangulation::load`] for all vertices that are inside, images included, and a pass over the cells.
    /// Where that does not show that all images are there, as after some commits, those that are missing are inserted in a copy:
    /// with data of any kind that costs as much as [`new`](Self::new) at most, beside the copy. The monitor of the options is called.
    ///
    /// ```
    /// use deldrift::{LoadError, Plane, motion::Options, periodic::{PeriodicTriangulation, SavedPeriodic}};
    ///
    /// let vectors = [[1.0, 0.0], [0.0, 1.0]];
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &vectors, Options::default()).map_err(LoadError::Call)?;
    /// let bytes = t.saved().map_err(LoadError::Call)?;
    /// let saved = SavedPeriodic::of(&bytes).map_err(LoadError::Data)?;
    /// let loaded = PeriodicTriangulation::<Plane>::load(&saved, Options::default())?;
    /// assert_eq!(loaded.saved().map_err(LoadError::Call)?, bytes);
    /// # Ok::<(), LoadError>(())
    /// ```
    ///
    /// # Errors
    /// [`LoadError::Data`] if it is not one of this dimension, or the bytes are none at all; [`Error::OutOfMemory`],
    /// [`Error::TooManyVertices`], [`Error::TooManyCells`], [`Error::Cancelled`], and [`Error::InvalidValue`] for options that
    /// reject coincident vertices.
    pub fn load(saved: &SavedPeriodic<'_>, options: Options) -> Result<Self, LoadError> {
        let SavedPeriodic { header, data } = saved;
        check_options(&options)?;
        if header.dimension != G::D as u32 {
            return Err(Damage::Dimension { given: header.dimension }.into());
        }
        if header.has_weights != G::HAS_WEIGHTS {
            return Err(Damage::Weighted { is_weighted: header.has_weights }.into());
        }
        let given = header.ids.saturating_add(header.insertions);
        if given > MAX_VERTICES {
            return Err(Error::TooManyVertices { given, limit: MAX_VERTICES }.into());
        }
        let mut reader = Reader(&data[SIZE..]);
        let lattice = lattice_of(&reader.vectors::<G>(header.vectors)?)?;
        let mut waiting = StagedLists::<G> {
            vectors: reader.vectors::<G>(header.staged_vectors)?,
            goals: reader.points::<G>(header.moves)?,
            insertions: reader.points::<G>(header.insertions)?,
            moves: Vec::new(),
            removals: Vec::new(),
        };
        let mut wraps = Vec::new();
        memory::reserve_exact(&mut wraps, header.ids)?;
        for row in reader.entries::<8>(header.ids * header.vectors).chunks_exact(header.vectors) {
            let mut wrap = [0; 3];
            wrap.iter_mut().zip(row).for_each(|(n, bytes)| *n = i64::from_le_bytes(*bytes));
            wraps.push(wrap);
        }
        waiting.moves = reader.numbers(header.moves)?;
        waiting.removals = reader.numbers(header.removals)?;
        let mut images = Vec::new();
        memory::reserve_exact(&mut images, header.images)?;
        for row in reader.entries::<4>(header.images * (1 + header.vectors)).chunks_exact(1 + header.vectors)
        {
            let mut shift = HOME;
            shift.iter_mut().zip(&row[1..]).for_each(|(n, bytes)| *n = i32::from_le_bytes(*bytes));
            images.push(Image { vertex: VertexId::new(u32::from_le_bytes(row[0])), shift });
        }
        let images = images_of(&lattice, &images, header.ids)?;
        let mut statistics = header.statistics;
        if G::HAS_WEIGHTS {
            let offset = data.len() - reader.0.len();
            enter_sums_of_weights(&mut statistics, reader.entries::<8>(N_SUMS_OF_WEIGHTS), offset)?;
        }
        let t = inside_of(&reader.0[..header.inside_bytes], &images, options)?;
        let inside = placed(&lattice, t, images)?;
        check_wraps(&lattice, &inside, &wraps)?;
        if !inside.is_complete(&lattice)? {
            return Err(Damage::NoImages.into());
        }
        inside.hidden_homes(&lattice)?.count_in(&mut statistics);
        let (staged, cells) = (Staged::default(), OnceLock::new());
        let (edges, taking) = (OnceLock::new(), None);
        let mut t = PeriodicTriangulation {
            lattice,
            inside,
            wraps,
            staged,
            coming: None,
            statistics,
            cells,
            edges,
            taking,
            former: None,
        };
        t.stage_saved(header, &waiting)?;
        Ok(t)
    }

    /// Stages what was staged.
    #[inline(never)]
    fn stage_saved(&mut self, header: &PeriodicHeader, waiting: &StagedLists<G>) -> Result<(), LoadError> {
        if !waiting.vectors.is_empty() {
            self.stage_vectors(&waiting.vectors).map_err(of_vectors)?;
        }
        let position = |vertex: VertexId, position: &G::Point| {
            check_position::<G>("positions", 0, position).map_err(|error| match error {
                Error::NotFinite { axis, value, .. } | Error::OutOfRange { axis, value, .. } => {
                    LoadError::Data(Damage::Position { vertex, axis, value })
                }
                error => error.into(),
            })
        };
        // What vectors of the program's will allow is checked by the commit.
        for (&vertex, goal) in waiting.moves.iter().zip(&waiting.goals) {
            let part = staged_part::<G>(goal);
            let mut checked = *goal;
            if let Some(part) = part {
                copy_part::<G>(&mut checked, part.other(), &G::Point::default());
            }
            position(vertex, &checked)?;
        }
        for (index, coming) in waiting.insertions.iter().enumerate() {
            position(VertexId::at(header.ids + index), coming)?;
        }
        let images = &self.inside.images;
        let check = |index, vertex| images.check(index, vertex, 0).map(|_| vertex);
        if G::HAS_WEIGHTS {
            for (&vertex, goal) in waiting.moves.iter().zip(&waiting.goals) {
                images.check(0, vertex, 0).map_err(of_staged)?;
                if self.staged.is_moving(vertex) {
                    return Err(Damage::Staged { vertex }.into());
                }
                let present =
                    |v: VertexId| self.lattice.unwrapped(&self.inside.places[images.home(v)], &self.wraps[v]);
                let parts = match staged_part::<G>(goal) {
                    Some(part) => &[part][..],
                    None => &PointPart::BOTH,
                };
                for &part in parts {
                    self.staged
                        .move_parts(
                            part,
                            header.ids,
                            &[(0, vertex)],
                            |_| numbers_of::<G>(goal, part),
                            present,
                        )
                        .map_err(of_staged)?;
                }
            }
        } else {
            let moves = waiting.moves.iter().zip(&waiting.goals).enumerate();
            let moves = moves.map(|(index, (&v, goal))| (index, check(index, v).map(|v| (v, *goal))));
            self.staged.move_vertices(header.ids, moves).map_err(of_staged)?;
        }
        self.staged.insert(&waiting.insertions)?;
        let removals = waiting.removals.iter().enumerate();
        self.staged.remove(header.ids, removals.map(|(index, &v)| check(index, v))).map_err(of_staged)
    }
}

fn lattice_of<G: Moving>(vectors: &[G::Point]) -> Result<Box<Lattice<G>>, LoadError> {
    Ok(memory::boxed(Lattice::new(vectors).map_err(of_vectors)?)?)
}

/// Why vectors are none of a lattice: the data are wrong, or there is no memory.
fn of_vectors(error: Error) -> LoadError {
    match error {
        Error::OutOfMemory { .. } => error.into(),
        _ => Damage::Vectors.into(),
    }
}

/// Why something cannot be staged that has been: the data are wrong, or there is no memory.
fn of_staged(error: Error) -> LoadError {
    match error {
        Error::NoSuchVertex { vertex, .. }
        | Error::RemovedVertex { vertex, .. }
        | Error::StagedVertex { vertex, .. }
        | Error::DuplicateMove { vertex, .. } => Damage::Staged { vertex }.into(),
        error => error.into(),
    }
}

/// What each vertex inside is. Those at home are in the order of vertices, and each comes before its images.
fn images_of<G: Moving>(lattice: &Lattice<G>, listed: &[Image], n_ids: usize) -> Result<Images, LoadError> {
    let mut images = Images::default();
    images.reserve(n_ids, listed.len())?;
    for (index, &image) in listed.iter().enumerate() {
        let Image { vertex, shift } = image;
        if vertex == VertexId::NONE && shift == HOME {
            images.push_gone();
            continue;
        }
        let is_right = if shift == HOME {
            vertex.index() < n_ids && vertex.index() >= images.n_vertices()
        } else {
            vertex.index() < images.n_vertices()
                && lattice.may_need(shift)
                && images.home(vertex) != VertexId::NONE
                && images.find(vertex, shift) == VertexId::NONE
        };
        if !is_right {
            return Err(Damage::Image { inside: VertexId::at(index), vertex }.into());
        }
        if shift == HOME {
            images.skip_to(vertex);
        }
        images.push(image);
    }
    images.skip_to(VertexId::at(n_ids));
    Ok(images)
}

/// What is inside, of its own bytes: the images with the keys of their vertices, ids of vertices that have been removed, and
/// nothing else.
fn inside_of<G: Moving>(
    data: &[u8],
    images: &Images,
    options: Options,
) -> Result<MovingTriangulation<G>, LoadError> {
    let saved = Saved::of(data)?;
    if saved.plain_ids() != Some(images.len()) {
        return Err(Damage::Counts.into());
    }
    let loaded = MovingTriangulation::<G>::load(&saved, options);
    let Ok(t) = &loaded else { return loaded };
    for (inside, image) in VertexId::range(0..images.len()).zip(images.as_slice()) {
        let is_right = if *image == Image::GONE {
            !t.is_present(inside)
        } else {
            t.is_present(inside) && t.key_of_id(inside) == u64::from(image.vertex.get())
        };
        if !is_right {
            return Err(Damage::Image { inside, vertex: image.vertex }.into());
        }
    }
    loaded
}

/// What is inside, if all are where the lattice has them.
fn placed<G: Moving>(
    lattice: &Lattice<G>,
    mut t: MovingTriangulation<G>,
    images: Images,
) -> Result<Inside<G>, LoadError> {
    let (mut places, mut home, mut occupied) = (Vec::new(), Vec::new(), Occupied::NOTHING);
    memory::reserve_exact(&mut places, images.len())?;
    memory::reserve_exact(&mut home, images.n_present())?;
    for (inside, image) in VertexId::range(0..images.len()).zip(images.as_slice()) {
        if *image == Image::GONE {
            places.push(G::Point::default());
            continue;
        }
        let place = t.position(inside)?;
        let is_right = if image.shift == HOME {
            home.push((image.vertex, place));
            lattice.enter(&mut occupied, &place);
            lattice.has_at_home(&place)
        } else {
            let first: &G::Point = &places[images.home(image.vertex).index()];
            lattice.translated(first, image.shift) == place
        };
        if !is_right {
            return Err(Damage::Image { inside, vertex: image.vertex }.into());
        }
        places.push(place);
    }
    let spacing = spacing(lattice, &home);
    t.begin_changes()?;
    let (goals, since) = (Vec::new(), InsideBefore::default());
    Ok(Inside { t, n_built: images.n_present(), images, places, goals, occupied, spacing, since })
}

/// Checks by which translations vertices have come home.
fn check_wraps<G: Moving>(
    lattice: &Lattice<G>,
    inside: &Inside<G>,
    wraps: &[[i64; 3]],
) -> Result<(), Damage> {
    for (vertex, wrap) in VertexId::range(0..wraps.len()).zip(wraps) {
        let home = inside.images.home(vertex);
        let is_right = match home {
            VertexId::NONE => *wrap == [0; 3],
            home => lattice.may_come_by(&inside.places[home], wrap),
        };
        if !is_right {
            return Err(Damage::Period { vertex });
        }
    }
    Ok(())
}
