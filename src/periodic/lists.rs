//! For each vertex the images that are near it.
//!
//! What looks for them is that of open triangulations ([`Search`]): places are those of vertices at home, and translations all by
//! which some vertex at home comes near another one. Sums of places and translations have to be numbers on the grid, so that
//! distances are those of the set: a radius for which they are not is refused.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{BoxTree, Entry, Lists, ListsOf, NeighbourLists, PlacedVertex, Search};
use crate::periodic::inside::all;
use crate::periodic::lattice::{HOME, Lattice, Occupied, Range, Shift};
use crate::periodic::reduction::SLACK;
use crate::periodic::triangulation::PeriodicTriangulation;

/// Sums on the grid are exact up to so many units.
const MOST_UNITS: f64 = (1u64 << 53) as f64;

/// The translations by which vertices come near each other, in the order in which they are told.
struct Translations<P> {
    ways: Vec<P>,
    shifts: Vec<Shift>,
    nowhere: usize,
}

/// The lists of all vertices, with the translations of their entries.
pub(crate) struct PeriodicLists {
    pub(crate) lists: Lists<u64>,
    shifts: Vec<Shift>,
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// For each vertex the images of vertices whose squared distance from it is at most that of its list, exactly: ascending by id
    /// and by shift, itself in other periods and hidden vertices included, which have lists as well.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{ListsOf, Options}, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.125, 0.5], [0.875, 0.5]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let wanted = ListsOf { squared_radii: &[0.0625], mask: None, is_half: false };
    /// let lists = t.neighbour_lists(&wanted)?;
    /// assert_eq!(lists.offsets, [0, 1, 2]);
    /// assert_eq!((lists.neighbours[0], lists.shifts[0]), (VertexId::new(1), [-1, 0, 0]));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`](crate::Error::WrongCount) unless there is one radius, or one for each id, and an entry of the
    /// mask for each id; [`Error::InvalidValue`](crate::Error::InvalidValue) for the square of the radius of a list that is
    /// negative or NaN, or so large that places of images are rounded; [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn neighbour_lists(&self, wanted: &ListsOf<'_>) -> Result<NeighbourLists> {
        let found = self.lists_of(wanted, true, &mut |_| true)?;
        let (mut neighbours, mut shifts) = (Vec::new(), Vec::new());
        memory::lengthen(&mut neighbours, found.lists.n_entries(), VertexId::NONE)?;
        memory::lengthen(&mut shifts, found.lists.n_entries(), [0; 3])?;
        found.lists.for_each(|vertex, begin, list| {
            for (at, &entry) in (begin..).zip(list) {
                (neighbours[at], shifts[at]) = self.told(&found, vertex, entry);
            }
        });
        Ok(NeighbourLists { offsets: found.lists.offsets, neighbours, shifts })
    }

    /// Finds the [`neighbour_lists`](Self::neighbour_lists), or only how long they are; a monitor is told the fraction done.
    pub(crate) fn lists_of(
        &self,
        wanted: &ListsOf<'_>,
        is_kept: bool,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<PeriodicLists> {
        wanted.check(self.id_count())?;
        let homes = self.inside.images.homes().map(|(vertex, inside)| (vertex, self.inside.places[inside]));
        let placed = wanted.placed(homes, self.vertex_count())?;
        let translations = self.translations(wanted, &placed)?;
        let search = Search::<G> {
            tree: BoxTree::new(placed)?,
            translations: &translations.ways,
            nowhere: translations.nowhere,
            is_half: wanted.is_half,
            is_kept,
        };
        let lists = Lists::find(&search, self.id_count(), self.inside.t.threads(), monitor)?;
        Ok(PeriodicLists { lists, shifts: translations.shifts })
    }

    /// The vertex of an entry in the list of another one, and by which multiples of the given vectors it is translated from its
    /// position, where the other one is at its own.
    pub(crate) fn told(&self, found: &PeriodicLists, vertex: VertexId, entry: u64) -> (VertexId, [i64; 3]) {
        let (other, translation) = entry.parts();
        (other, self.given(vertex, other, found.shifts[translation]))
    }

    /// All translations by which one of these vertices comes as near to another one as the greatest radius.
    fn translations(
        &self,
        wanted: &ListsOf<'_>,
        placed: &[PlacedVertex<G::Point>],
    ) -> Result<Translations<G::Point>> {
        let lattice = &self.lattice;
        let mut found = Translations { ways: Vec::new(), shifts: Vec::new(), nowhere: 0 };
        let Some(greatest) = placed.iter().max_by(|p, q| p.squared_radius.total_cmp(&q.squared_radius))
        else {
            return Ok(found);
        };
        let refused = wanted.refused(greatest.vertex, "small enough for places of images to be exact");
        let [mut low, mut high] = [placed[0].place; 2];
        let mut occupied = Occupied::NOTHING;
        for p in placed {
            lattice.enter(&mut occupied, &p.place);
            for axis in 0..G::D {
                low[axis] = low[axis].min(p.place[axis]);
                high[axis] = high[axis].max(p.place[axis]);
            }
        }
        let radius = greatest.squared_radius.max(0.0).sqrt();
        let Some([a, b, c]) = lattice.shifts_within(radius, &occupied) else { return Err(refused) };
        for (x, y, z) in all(a, b, c) {
            let way = lattice.translated(&G::Point::default(), [x, y, z]);
            let beyond = |axis: usize| (way[axis].abs() - (high[axis] - low[axis])).max(0.0);
            let square: f64 = (0..G::D).map(|axis| beyond(axis) * beyond(axis)).sum();
            if square * (1.0 - SLACK) > greatest.squared_radius && [x, y, z] != HOME {
                continue;
            }
            if !lattice.is_exact([x, y, z], &low, &high) {
                return Err(refused);
            }
            memory::push(&mut found.shifts, [x, y, z])?;
        }
        found.shifts.sort_unstable_by_key(|shift| lattice.of_caller(shift.map(i64::from)));
        found.nowhere = found.shifts.iter().position(|&shift| shift == HOME).unwrap_or_default();
        let ways = found.shifts.iter().map(|&shift| lattice.translated(&G::Point::default(), shift));
        memory::collect(&mut found.ways, ways)?;
        Ok(found)
    }
}

impl<G: Moving> Lattice<G> {
    /// By vector, the range of multiples by which what is occupied can be translated to come as near to itself as a radius; `None`
    /// if they are no numbers for shifts.
    fn shifts_within(&self, radius: f64, occupied: &Occupied) -> Option<[Range; 3]> {
        let mut ranges = [0..=0, 0..=0, 0..=0];
        for (j, range) in ranges.iter_mut().enumerate().take(self.rank) {
            let most = ((occupied.width(j) + radius * self.thickness()[j]) * (1.0 + SLACK) + SLACK).floor();
            if most > f64::from(i32::MAX / 2) {
                return None;
            }
            *range = -(most as i32)..=most as i32;
        }
        Some(ranges)
    }

    /// Whether places within a box, and what comes of them by a translation, are sums without rounding.
    fn is_exact(&self, shift: Shift, low: &G::Point, high: &G::Point) -> bool {
        (0..G::D).filter(|&axis| self.unit[axis] != 0.0).all(|axis| {
            let ways = shift.iter().zip(&self.vectors).map(|(&n, v)| f64::from(n).abs() * v[axis].abs());
            let greatest = low[axis].abs().max(high[axis].abs()) + ways.sum::<f64>();
            greatest <= MOST_UNITS * self.unit[axis]
        })
    }
}
