//! Insertions within a range of the cells.

use super::{Part, Shared, State};
use crate::complex::{CellRange, Corners, Facet, Obstacle};
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::squared_distance;

/// Most facets of a rim.
const MOST_OF_RIM: usize = 128;
/// Places where to look for a ridge: a power of two, more than twice as many as there are ridges then.
const PLACES: usize = 512;

/// The rim of a conflict zone.
#[derive(Debug)]
pub(super) struct Rim<G: Dimension> {
    /// For each of its facets the corners of the new cell, the index of the new site, and the facet seen from the cell
    /// that stays.
    facets: Vec<(G::Corners, usize, Facet)>,
    /// Gluings of the new cells; a slot is the position of one of these among them.
    glued: Vec<<G::Corners as Corners>::Of<Facet>>,
    /// Ridges of which one facet has been found, each at its hash or behind it: their sites, and that facet. A key of 0
    /// is none, and all are none between insertions.
    ridges: Vec<(u64, Facet)>,
    /// The places of those there.
    used: Vec<u16>,
}

impl<G: Dimension> Default for Rim<G> {
    fn default() -> Self {
        Rim { facets: Vec::new(), glued: Vec::new(), ridges: Vec::new(), used: Vec::new() }
    }
}

impl<G: Dimension> Rim<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.facets)
            + memory::bytes_of(&self.glued)
            + memory::bytes_of(&self.ridges)
            + memory::bytes_of(&self.used)
    }

    fn begin(&mut self) -> Result<()> {
        self.facets.clear();
        self.glued.clear();
        memory::reserve(&mut self.facets, MOST_OF_RIM)?;
        memory::reserve(&mut self.glued, MOST_OF_RIM)?;
        memory::reserve(&mut self.used, PLACES)?;
        if self.ridges.is_empty() {
            memory::lengthen(&mut self.ridges, PLACES, (0, Facet::NONE))
        } else {
            Ok(())
        }
    }

    /// Glues the new cells to each other.
    fn glue(&mut self) {
        let Rim { facets, glued, ridges, used } = self;
        glued.extend(facets.iter().map(|_| <G::Corners as Corners>::Of::<Facet>::filled(Facet::NONE)));
        for (k, &(corners, at, out)) in facets.iter().enumerate() {
            glued[k][at] = out;
            for i in (0..G::Corners::N).filter(|&i| i != at) {
                let (key, facet) = (ridge::<G>(&corners, at, i), Facet::new(Slot::at(k), i));
                let mut place = (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize % PLACES;
                while ridges[place].0 != key && ridges[place].0 != 0 {
                    place = (place + 1) % PLACES;
                }
                if ridges[place].0 == 0 {
                    ridges[place] = (key, facet);
                    used.push(place as u16);
                } else {
                    let other = ridges[place].1;
                    glued[k][i] = other;
                    glued[other.cell().index()][other.index()] = facet;
                }
            }
        }
        for place in used.drain(..) {
            ridges[usize::from(place)].0 = 0;
        }
    }
}

/// A number for the sites of a cell other than two of its corners.
#[inline(always)]
fn ridge<G: Dimension>(corners: &G::Corners, i: usize, j: usize) -> u64 {
    let mut key = [0; 2];
    let others = (0..G::Corners::N).filter(|&k| k != i && k != j);
    others.zip(&mut key).for_each(|(k, part)| *part = corners[k].get());
    u64::from(key[0].min(key[1])) << 32 | u64::from(key[0].max(key[1]))
}

impl<G: Dimension> Shared<'_, G> {
    /// Inserts the sites of all tasks, as far as that can be done here.
    pub(super) fn insert_all(self, range: &mut CellRange<G::Corners>, part: &mut Part<G>) {
        let mut recent = Slot::NONE;
        part.tasks.sort_unstable_by_key(|&(_, near)| near);
        for k in 0..part.tasks.len() {
            self.prefetch(range, &part.tasks, k);
            let (goal, near) = part.tasks[k];
            let s = self.goals[goal as usize].site;
            match self.insert(range, part, s, [near, recent]) {
                Ok(cell) => {
                    recent = cell;
                    part.done.push((goal, State::Inserted));
                }
                Err(Obstacle::Memory) => {
                    part.has_failed = true;
                    return;
                }
                Err(_) => {}
            }
        }
    }

    /// Inserts a site that is in no cell, by a walk from the nearer one of two cells, which may have gone; returns one
    /// of the new cells. After an obstacle nothing has changed.
    fn insert(
        &self,
        range: &mut CellRange<G::Corners>,
        part: &mut Part<G>,
        s: SiteId,
        near: [Slot; 2],
    ) -> Result<Slot, Obstacle> {
        let start = self.walk(range, s, self.nearer(range, s, near)?)?;
        let q = self.sites.point(s);
        if range.cell(start)?.corners.as_ref().iter().any(|&other| self.sites.point(other) == q) {
            return Err(Obstacle::Shape);
        }
        self.dig(range, part, s, start)?;
        let Part { journal, made, cells, slots, rim, .. } = part;
        let n = rim.facets.len();
        memory::reserve(made, n)?;
        range.take_slots(cells.as_slice(), n, slots, journal)?;
        rim.glue();
        for (k, (&(corners, at, out), &glued)) in rim.facets.iter().zip(&rim.glued).enumerate() {
            let mut neighbours = glued;
            for i in (0..G::Corners::N).filter(|&i| i != at) {
                neighbours[i] = Facet::new(slots[glued[i].cell().index()], glued[i].index());
            }
            range.set_neighbour(out, Facet::new(slots[k], at));
            range.put(slots[k], corners, neighbours);
        }
        made.extend_from_slice(slots);
        Ok(slots[0])
    }

    /// The one of two cells that is nearer to a site and still there.
    fn nearer(&self, range: &CellRange<G::Corners>, s: SiteId, near: [Slot; 2]) -> Result<Slot, Obstacle> {
        let q = self.sites.point(s);
        let mut nearer = (f64::INFINITY, Err(Obstacle::OtherRange));
        for slot in near {
            if let Ok(cell) = range.cell(slot)
                && !cell.is_free()
            {
                let distance = squared_distance(self.sites.point(cell.corners[0]), q);
                if distance < nearer.0 {
                    nearer = (distance, Ok(slot));
                }
            }
        }
        nearer.1
    }

    /// The finite cell in which a site lies.
    fn walk(&self, range: &CellRange<G::Corners>, s: SiteId, start: Slot) -> Result<Slot, Obstacle> {
        let q = self.sites.point(s);
        let (mut slot, mut entered, mut steps) = (start, G::Corners::N, 0);
        'cells: loop {
            let cell = range.cell(slot)?;
            if cell.is_ghost() {
                return Err(Obstacle::Shape);
            }
            for i in (0..G::Corners::N).filter(|&i| i != entered) {
                if G::orientation_with(self.filter, self.sites, &cell.corners, i, q) < 0.0 {
                    (slot, entered) = (cell.neighbour(i).cell(), cell.neighbour(i).index());
                    steps += 1;
                    continue 'cells;
                }
            }
            self.landmarks.follow_beside_others::<G>(self.sites, q, &cell.corners, steps);
            return Ok(slot);
        }
    }

    /// Finds the conflict zone of a site from one cell of it, and its rim. All cells at it have to be of the range, and
    /// those of the zone finite.
    fn dig(
        &self,
        range: &CellRange<G::Corners>,
        part: &mut Part<G>,
        s: SiteId,
        start: Slot,
    ) -> Result<(), Obstacle> {
        let (q, id) = (self.sites.point(s), self.sites.id(s));
        let Part { cells: zone, rim, .. } = part;
        zone.clear();
        rim.begin()?;
        zone.insert(start)?;
        let mut k = 0;
        while let Some(&c) = zone.as_slice().get(k) {
            k += 1;
            let cell = range.cell(c)?;
            for i in 0..G::Corners::N {
                let out = cell.neighbour(i);
                if zone.contains(out.cell()) {
                    continue;
                }
                let beyond = range.cell(out.cell())?;
                if beyond.is_ghost() {
                    let sign = G::orientation_with(self.filter, self.sites, &beyond.corners, G::D, q);
                    if sign >= 0.0 {
                        return Err(Obstacle::Shape);
                    }
                }
                if !beyond.is_ghost() && G::is_in_sphere(self.filter, self.sites, &beyond.corners, q, id) {
                    zone.insert(out.cell())?;
                    (0..G::Corners::N).for_each(|j| range.prefetch(beyond.neighbour(j).cell()));
                } else if rim.facets.len() < MOST_OF_RIM {
                    rim.facets.push((cell.corners.with(i, s), i, out));
                } else {
                    return Err(Obstacle::Shape);
                }
            }
        }
        Ok(())
    }
}
