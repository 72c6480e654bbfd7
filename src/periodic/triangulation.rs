//! The triangulation, and how one is built.

use std::sync::OnceLock;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{CoincidencePolicy, CommitReport, MAX_VERTICES, MovingTriangulation, Options};
use crate::periodic::cells::PeriodicCells;
use crate::periodic::changes::Taking;
use crate::periodic::edges::PeriodicEdges;
use crate::periodic::grid::ROOM;
use crate::periodic::images::{Image, Images};
use crate::periodic::inside::{Inside, InsideBefore};
use crate::periodic::lattice::{HOME, Lattice, Occupied};
use crate::periodic::needed::{Needed, for_images, keys_of};
use crate::periodic::rounds::{BeforeRounds, Wraps};
use crate::periodic::staged::Staged;

/// Vertices may drift so many mean distances out of the unit cell before they are taken back.
const DRIFT: f64 = 1.0;

/// A Delaunay triangulation of a set of vertices that repeats, and that move.
///
/// ```
/// use deldrift::{Plane, motion::Options, periodic::PeriodicTriangulation};
///
/// // One vertex in a square: a lattice, of which each square has two cells.
/// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
/// assert_eq!(t.cell_count()?, 2);
/// # Ok::<(), deldrift::Error>(())
/// ```
#[derive(Debug)]
pub struct PeriodicTriangulation<G: Moving> {
    pub(super) lattice: Box<Lattice<G>>,
    pub(super) inside: Inside<G>,
    /// By vertex, the translation by which it went from where it was given to home: it is where it was given less that.
    pub(super) wraps: Wraps,
    pub(super) staged: Staged<G>,
    /// The lattice that is staged.
    pub(super) coming: Option<Box<Lattice<G>>>,
    /// Of all commits.
    pub(super) statistics: CommitReport,
    pub(super) cells: OnceLock<PeriodicCells<G>>,
    /// The changes that have been taken last, if they ever were.
    pub(super) taking: Option<Taking<G>>,
    pub(super) edges: OnceLock<PeriodicEdges>,
    /// What was at the timestamp, while another one is prepared.
    pub(super) former: Option<BeforeRounds<G>>,
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// Triangulates `positions` and all places to which sums of multiples of `vectors` take them.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::new`]; [`Error::DependentVectors`] for vectors that depend on each other,
    /// [`Error::InvalidValue`] for options that reject coincident vertices.
    pub fn new(positions: &[G::Point], vectors: &[G::Point], options: Options) -> Result<Self> {
        check_options(&options)?;
        let lattice = memory::boxed(Lattice::<G>::new(vectors)?)?;
        let n = positions.len();
        if n > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: n, limit: MAX_VERTICES });
        }
        let (mut home, mut wraps) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut home, n)?;
        memory::reserve_exact(&mut wraps, n)?;
        for (index, position) in positions.iter().enumerate() {
            let (place, wrap) = lattice.wrapped("positions", index, position)?;
            home.push((VertexId::at(index), place));
            wraps.push(wrap);
        }
        let mut inside = Inside::unbuilt(&lattice, &home, n, options)?;
        inside.build(&lattice)?;
        let mut statistics = CommitReport::default();
        inside.hidden_homes(&lattice)?.count_in(&mut statistics);
        Ok(PeriodicTriangulation {
            lattice,
            inside,
            wraps,
            staged: Staged::default(),
            coming: None,
            statistics,
            cells: OnceLock::new(),
            edges: OnceLock::new(),
            taking: None,
            former: None,
        })
    }

    /// An error while a timestamp is prepared.
    pub(crate) fn reject_prepared(&self) -> Result<()> {
        match &self.former {
            None => Ok(()),
            Some(former) => {
                Err(Error::Prepared { timestamp: self.statistics.timestamp + 1, rounds: former.rounds.len() })
            }
        }
    }

    /// Bytes of memory, without what belongs to this itself.
    pub fn memory_bytes(&self) -> usize {
        self.inside.memory_bytes()
            + memory::bytes_of(&self.wraps)
            + self.staged.memory_bytes()
            + self.cells.get().map_or(0, PeriodicCells::memory_bytes)
            + self
                .taking
                .as_ref()
                .map_or(0, |taking| taking.base.memory_bytes() + taking.lists.memory_bytes())
            + self.edges.get().map_or(0, |edges| memory::bytes_of(&edges.list))
            + self.former.as_ref().map_or(0, BeforeRounds::memory_bytes)
    }
}

/// Vertices that share a place are no mistake, as images may do.
pub(super) fn check_options(options: &Options) -> Result<()> {
    if options.coincidence == CoincidencePolicy::Reject {
        let (value, wanted) = (1.0, "0, to merge");
        return Err(Error::InvalidValue { argument: "options.coincidence", index: 0, value, wanted });
    }
    Ok(())
}

impl<G: Moving> Inside<G> {
    /// Vertices, which are in the unit cell, and images near it, that are to be [built](Self::build); others of the ids up to
    /// `n_ids` are of removed vertices.
    pub(super) fn unbuilt(
        lattice: &Lattice<G>,
        home: &[(VertexId, G::Point)],
        n_ids: usize,
        options: Options,
    ) -> Result<Self> {
        let mut occupied = Occupied::NOTHING;
        home.iter().for_each(|(_, place)| lattice.enter(&mut occupied, place));
        let spacing = spacing(lattice, home);
        let mut images = Images::default();
        images.reserve(n_ids, home.len())?;
        let mut places = Vec::new();
        memory::reserve(&mut places, home.len())?;
        for &(vertex, place) in home {
            images.skip_to(vertex);
            images.push(Image { vertex, shift: HOME });
            places.push(place);
        }
        images.skip_to(VertexId::at(n_ids));
        for &(vertex, place) in home {
            for_images(lattice, &place, spacing, &occupied, &mut |shift| {
                images.reserve(0, 1)?;
                images.push(Image { vertex, shift });
                memory::push(&mut places, lattice.translated(&place, shift))
            })?;
        }
        let t = MovingTriangulation::unbuilt(options);
        let (goals, since) = (Vec::new(), InsideBefore::default());
        Ok(Inside { t, images, n_built: home.len(), places, goals, occupied, spacing, since })
    }

    /// Triangulates the vertices and images at these places, and inserts images that are missing. After an error it can only
    /// be dropped.
    pub(super) fn build(&mut self, lattice: &Lattice<G>) -> Result<()> {
        self.t.build_first_with_keys(&self.places, &keys_of(self.images.as_slice())?)?;
        // From now on what changes is known.
        self.t.begin_changes()?;
        let needed = Needed::of_all(self, lattice)?;
        self.complete(lattice, needed, Needed::of_new, |t| t.commit_timestamp().map(drop))?;
        self.t.begin_changes()
    }

    /// Whether no vertex at home is too far from the unit cell of a lattice.
    pub(super) fn is_near(&self, lattice: &Lattice<G>, occupied: &Occupied) -> bool {
        occupied.is_within(&lattice.thickness().map(|thickness| ROOM.min(DRIFT * self.spacing * thickness)))
    }
}

/// The mean distance of vertices.
pub(super) fn spacing<G: Moving>(lattice: &Lattice<G>, home: &[(VertexId, G::Point)]) -> f64 {
    let mut measure = lattice.measure();
    // Along axes that are open, the box of the vertices.
    for axis in (0..G::D).filter(|&axis| !lattice.is_spanned(axis)) {
        let coordinates = || home.iter().map(|(_, place)| place[axis]);
        let extent = coordinates().fold(f64::MIN, f64::max) - coordinates().fold(f64::MAX, f64::min);
        if extent > 0.0 {
            measure *= extent;
        }
    }
    (measure / home.len().max(1) as f64).powf(1.0 / G::D as f64)
}
