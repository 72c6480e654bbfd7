//! Removals within a range of the cells: in lanes only, of sites that have no ghost around them.

use super::{Part, Shared, State};
use crate::complex::{CellRange, Corners, Facet, Obstacle};
use crate::delaunay::Dimension;
use crate::delaunay::remove::{Gap, LabelsOf, new_of};
use crate::delaunay::wrapping::{MOST_CELLS, MOST_SITES};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::AHEAD;
use crate::predicates::squared_distance;
use crate::simd::Avx2;

/// Goals looked for together.
const TOGETHER: usize = 8;

/// Most cells of a star whose link has [`MOST_SITES`].
const MOST_OF_STAR: usize = 2 * MOST_SITES;

impl<G: Dimension> Shared<'_, G> {
    /// Removes the sites of all tasks, as far as that can be done here, and looks for their goals.
    pub(super) fn remove_all(self, range: &mut CellRange<G::Corners>, part: &mut Part<G>) {
        let n = part.tasks.len();
        part.left_behind.clear();
        part.landmarks.clear();
        part.has_failed = memory::reserve(&mut part.left_behind, n)
            .and_then(|()| memory::reserve(&mut part.landmarks, n))
            .is_err();
        if part.has_failed {
            return;
        }
        // In the order of the cells.
        part.tasks.sort_unstable_by_key(|&(_, cell)| cell);
        for k in 0..n {
            self.prefetch(range, &part.tasks, k);
            let (goal, cell) = part.tasks[k];
            match self.remove(range, part, self.goals[goal as usize].site, cell) {
                Ok(()) => {
                    part.left_behind.push(part.hole.sites[0]);
                    part.done.push((goal, State::Removed(Slot::NONE)));
                }
                Err(Obstacle::Memory) => {
                    part.has_failed = true;
                    return;
                }
                Err(_) => {}
            }
        }
        self.look_for_goals(part);
    }

    /// Finds cells near the goals of the sites that have been removed.
    fn look_for_goals(&self, Part { done, left_behind, landmarks, .. }: &mut Part<G>) {
        let (groups, rest) = done.as_chunks::<TOGETHER>();
        let (left_by_groups, left_by_rest) = left_behind.as_chunks::<TOGETHER>();
        for (group, left) in groups.iter().zip(left_by_groups) {
            self.look_for_some(group, left, landmarks);
        }
        for (one, left) in rest.iter().zip(left_by_rest) {
            self.look_for_some(&[*one], &[*left], landmarks);
        }
        for (k, (goal, state)) in done.iter_mut().enumerate() {
            for &s in landmarks.get(k + AHEAD).into_iter().flatten() {
                self.sites.prefetch(s);
            }
            *state = State::Removed(self.cell_of_nearer(&self.goals[*goal as usize].place, landmarks[k]));
        }
    }

    /// Finds landmarks near some of the goals; where a site that has been removed was one, it is replaced by one that
    /// it has left behind.
    #[inline(always)]
    fn look_for_some<const N: usize>(
        &self,
        removed: &[(u32, State); N],
        left_behind: &[SiteId; N],
        landmarks: &mut Vec<[SiteId; 2]>,
    ) {
        let goals = removed.map(|(goal, _)| &self.goals[goal as usize]);
        let sites = goals.map(|goal| goal.site);
        self.landmarks.leave::<G, N>(sites.map(|s| self.sites.point(s)), sites, *left_behind);
        landmarks.extend(self.landmarks.near_each::<G, N>(goals.map(|goal| &goal.place)));
    }

    /// A cell that the nearer one of two sites had; [`Slot::NONE`] if there is none.
    #[inline(always)]
    fn cell_of_nearer(&self, q: &G::Point, sites: [SiteId; 2]) -> Slot {
        let mut nearer = (f64::INFINITY, Slot::NONE);
        for s in sites {
            if let Some(site) = self.cells_of.get(s.index()).filter(|site| site.is_live()) {
                let distance = squared_distance(&site.point, q);
                if distance < nearer.0 {
                    nearer = (distance, site.cell);
                }
            }
        }
        nearer.1
    }

    /// Removes a site that had this cell. After an obstacle nothing has changed.
    fn remove(
        &self,
        range: &mut CellRange<G::Corners>,
        part: &mut Part<G>,
        s: SiteId,
        cell: Slot,
    ) -> Result<(), Obstacle> {
        // By now there may be another one in its place.
        if !range.cell(cell)?.corners.as_ref().contains(&s) {
            return Err(Obstacle::Shape);
        }
        self.gather(range, part, s, cell)?;
        label(part)?;
        if !self.fill(range, part, s)? {
            return Err(Obstacle::Shape);
        }
        let Part { journal, made, cells, slots, hole, .. } = part;
        let n = hole.made.len();
        memory::reserve(made, n)?;
        range.take_slots(cells.as_slice(), n, slots, journal)?;
        for (&slot, &(corners, mut neighbours)) in slots.iter().zip(&hole.made) {
            for (i, facet) in neighbours.as_mut().iter_mut().enumerate() {
                match new_of(*facet) {
                    Some(new) => *facet = Facet::new(slots[new], facet.index()),
                    None => range.set_neighbour(*facet, Facet::new(slot, i)),
                }
            }
            range.put(slot, corners, neighbours);
        }
        made.extend_from_slice(slots);
        Ok(())
    }

    /// Collects the star of a site, and its link. All cells there have to be of the range.
    fn gather(
        &self,
        range: &CellRange<G::Corners>,
        part: &mut Part<G>,
        s: SiteId,
        first: Slot,
    ) -> Result<(), Obstacle> {
        let Part { cells, hole, .. } = part;
        cells.clear();
        hole.link.clear();
        memory::reserve(&mut hole.link, MOST_OF_STAR)?;
        cells.insert(first)?;
        let mut k = 0;
        while let Some(&c) = cells.as_slice().get(k) {
            k += 1;
            let cell = range.cell(c)?;
            if cell.is_ghost() || k > MOST_OF_STAR {
                return Err(Obstacle::Shape);
            }
            let at = cell.index_of(s);
            let out = cell.neighbour(at);
            if !range.has(out.cell()) {
                return Err(Obstacle::OtherRange);
            }
            range.prefetch(out.cell());
            hole.link.push(Gap { corners: cell.corners, at, out });
            for i in (0..G::Corners::N).filter(|&i| i != at) {
                self.sites.prefetch(cell.corners[i]);
                range.prefetch(cell.neighbour(i).cell());
                cells.insert(cell.neighbour(i).cell())?;
            }
        }
        Ok(())
    }

    /// Finds the cells that fill the hole; whether it has.
    fn fill(&self, range: &CellRange<G::Corners>, part: &mut Part<G>, s: SiteId) -> Result<bool, Obstacle> {
        let Some(avx2) = Avx2::new() else { return Ok(false) };
        let Part { hole, wrapping, .. } = part;
        memory::reserve(&mut hole.made, MOST_CELLS)?;
        let wrapping = memory::made(wrapping)?;
        Ok(avx2.run_with(
            (avx2, self, range),
            (hole, wrapping),
            s,
            #[inline(always)]
            |(avx2, shared, range), (hole, wrapping), s| {
                let apex = |facet| range.apex(facet).expect("cells beyond the link are of the range");
                wrapping.find(avx2, (shared.filter, shared.sites), apex, hole, s)
            },
        ))
    }
}

/// Lists the link's sites, and labels those of each gap.
fn label<G: Dimension>(part: &mut Part<G>) -> Result<(), Obstacle> {
    let hole = &mut part.hole;
    hole.sites.clear();
    hole.labels.clear();
    memory::reserve(&mut hole.sites, MOST_SITES)?;
    memory::reserve(&mut hole.labels, hole.link.len())?;
    for gap in &hole.link {
        let mut labels = LabelsOf::<G>::filled(0);
        for i in (0..G::Corners::N).filter(|&i| i != gap.at) {
            let site = gap.corners[i];
            let label = hole.sites.iter().position(|&other| other == site).unwrap_or(hole.sites.len());
            if label == MOST_SITES {
                return Err(Obstacle::Shape);
            }
            if label == hole.sites.len() {
                hole.sites.push(site);
            }
            labels[i] = label as u8;
        }
        hole.labels.push(labels);
    }
    Ok(())
}
