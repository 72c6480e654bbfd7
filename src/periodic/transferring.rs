//! Conservative transfer of means in cells of a set that repeats: cells that are gone are met in all the periods in
//! which they meet those that have come.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{
    CellAt, Extent, Gone, Multiples, NO_CELL, NamedFacet, Now, TransferOrder, TransferReport, Transferred,
    in_place, transfer,
};
use crate::periodic::cells::PeriodicCells;
use crate::periodic::changes::ChangeLists;
use crate::periodic::lattice::plus;
use crate::periodic::locating::PeriodicLocation;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::predicates::PlaceInSpace;

/// Much more than what a few sums and products are off, as a share of what is summed up.
const ROUNDING: f64 = 1.0 / (1u64 << 40) as f64;

/// Through how many periods a cell that is gone may reach at the new positions.
const MOST_PERIODS: i64 = 64;

impl<G: Moving> PeriodicTriangulation<G> {
    /// As of [`MovingTriangulation`](crate::motion::MovingTriangulation::transfer_cells). Positions are where vertices
    /// have gone from where they were when changes were taken before, whatever periods they have come to: where the
    /// program has taken some to other periods since, those before it did. Volumes and what is in common are those
    /// with the vectors of now.
    ///
    /// # Errors
    /// The errors of the open triangulation, [`Error::Prepared`], and [`Error::InvalidValue`] for positions that take a
    /// cell through more than 64 periods of a reduced vector.
    pub fn transfer_cells(
        &self,
        positions: Option<&[G::Point]>,
        order: TransferOrder,
        n_values: usize,
        values: &mut Vec<f64>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<TransferReport> {
        let counts = [self.count_before()?, self.cell_count()?];
        in_place(values, n_values, counts, |value| {
            self.transferred(positions, order, n_values, &value, monitor)
        })
    }

    /// How many cells there were when changes were taken before.
    pub(crate) fn count_before(&self) -> Result<usize> {
        let lists = self.fresh_lists()?;
        Ok(self.cell_count()? + lists.removed.len() - lists.created.len())
    }

    fn fresh_lists(&self) -> Result<&ChangeLists<G>> {
        self.reject_prepared()?;
        let taking = self.taking.as_ref().filter(|taking| taking.timestamp == Some(self.timestamp()));
        Ok(&taking.ok_or(Error::ChangesNotTaken)?.lists)
    }

    /// What becomes of means; `value` tells a component of that of a cell that was.
    pub(crate) fn transferred(
        &self,
        positions: Option<&[G::Point]>,
        order: TransferOrder,
        n_values: usize,
        value: &impl Fn(u32, usize) -> f64,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Transferred> {
        let now = self.now()?;
        let (gone, arrived) = now.gone_and_arrived(positions)?;
        let renumbered = [&now.lists.renumbered_from[..], &now.lists.renumbered_to];
        transfer(&now, gone, arrived, renumbered, (order, n_values), value, monitor)
    }

    pub(super) fn now(&self) -> Result<Repeating<'_, G>> {
        Ok(Repeating { t: self, lists: self.fresh_lists()?, cells: self.read_cells()? })
    }

    /// Where a vertex of a cell that was is, or was at last: its place in the unit cell, and in which period it is.
    fn place_before(&self, positions: Option<&[G::Point]>, v: VertexId) -> Result<(G::Point, [i64; 3])> {
        let (argument, index, vertex) = ("positions", v.index(), v);
        let position = match positions {
            _ if v == VertexId::NONE => return Err(Error::ChangesNotTaken),
            Some(positions) => match positions.get(index) {
                Some(position) => *position,
                None => return Err(Error::NoSuchVertex { argument, index, vertex, ids: positions.len() }),
            },
            None if !self.is_present(v) => return Err(Error::RemovedVertex { argument, index, vertex }),
            None => self.position(v)?,
        };
        self.lattice.at_home(argument, index, &position, None)
    }

    /// A place, translated by multiples of the reduced vectors.
    fn translated(&self, place: &G::Point, shift: &[i64; 3]) -> PlaceInSpace {
        let mut sum = [0.0; 3];
        sum[..G::D].copy_from_slice(place.as_ref());
        for (&n, vector) in shift.iter().zip(self.lattice.reduced()) {
            (0..G::D).for_each(|axis| sum[axis] += n as f64 * vector[axis]);
        }
        sum
    }
}

/// The cells of now.
pub(super) struct Repeating<'t, G: Moving> {
    t: &'t PeriodicTriangulation<G>,
    cells: &'t PeriodicCells<G>,
    lists: &'t ChangeLists<G>,
}

impl<G: Moving> Repeating<'_, G> {
    /// The cells that are gone and those that have come, those that were turned over are both.
    pub(super) fn gone_and_arrived(
        &self,
        positions: Option<&[G::Point]>,
    ) -> Result<(Vec<Gone>, Vec<CellId>)> {
        let mut of_caller = [[0; 3]; 3];
        for (row, vector) in of_caller.iter_mut().zip(self.t.lattice.given()) {
            *row = self.t.lattice.multiples(vector).map(|x| x.round_ties_even() as i64);
        }
        let (mut gone, mut arrived) = (Vec::new(), Vec::new());
        let turned = self.lists.turned.iter().map(|(cell, name)| (self.before(*cell), name));
        for (before, name) in self.lists.removed.iter().copied().zip(&self.lists.removed_names).chain(turned)
        {
            let mut places = [(VertexId::NONE, G::Point::default(), [0; 3]); 4];
            for (entry, &(v, shift)) in places.iter_mut().zip(&name[..=G::D]) {
                let (place, wrap) = self.t.place_before(positions, v)?;
                let total = |j: usize| wrap[j] + (0..3).map(|i| shift[i] * of_caller[i][j]).sum::<i64>();
                *entry = (v, place, [0, 1, 2].map(total));
            }
            let first = places[0].2;
            for (_, _, shift) in &mut places[..=G::D] {
                *shift = [0, 1, 2].map(|j| shift[j] - first[j]);
            }
            let corners = places.map(|(_, place, shift)| self.t.translated(&place, &shift));
            let facets = facets_of(&places.map(|(v, _, shift)| (v, shift))[..=G::D]);
            memory::push(&mut gone, Gone { corners, facets, before: before.get() })?;
        }
        memory::append(&mut arrived, &self.lists.created)?;
        self.lists.turned.iter().try_for_each(|&(cell, _)| memory::push(&mut arrived, cell))?;
        Ok((gone, arrived))
    }

    /// Where a vertex is at home.
    fn home(&self, v: VertexId) -> G::Point {
        let inside = &self.t.inside;
        inside.t.position(inside.images.home(v)).expect("a vertex of a cell is there")
    }
}

impl<G: Moving> Now for Repeating<'_, G> {
    const D: usize = G::D;

    fn len(&self) -> usize {
        self.cells.corners.len()
    }

    fn before(&self, cell: CellId) -> CellId {
        let found = self.lists.renumbered_to.binary_search(&cell);
        found.map_or(cell, |k| self.lists.renumbered_from[k])
    }

    fn corners(&self, cell: CellId) -> [PlaceInSpace; 4] {
        let mut corners = [[0.0; 3]; 4];
        let shifts = self.cells.shifts.of(cell.index());
        for ((corner, &v), shift) in corners.iter_mut().zip(self.cells.corners[cell].as_ref()).zip(shifts) {
            *corner = self.t.translated(&self.home(v), &shift.map(i64::from));
        }
        corners
    }

    fn facets(&self, cell: CellId) -> [NamedFacet; 4] {
        let mut row = [(VertexId::NONE, [0; 3]); 4];
        let shifts = self.cells.shifts.of(cell.index());
        for ((entry, &v), shift) in row.iter_mut().zip(self.cells.corners[cell].as_ref()).zip(shifts) {
            // From the unit cell, as those that are gone have it.
            let wrap = self.t.lattice.at_home("positions", v.index(), &self.home(v), None);
            let wrap = wrap.map_or([0; 3], |(_, wrap)| wrap);
            *entry = (v, [0, 1, 2].map(|j| i64::from(shift[j]) + wrap[j]));
        }
        facets_of(&row[..=G::D])
    }

    fn across(&self, cell: CellId, corner: usize) -> Option<CellAt> {
        let other = self.cells.neighbours[cell].as_ref()[corner];
        let shift = self.cells.neighbour_shifts.of(cell.index())[corner].map(i64::from);
        (other != NO_CELL).then_some((other, shift))
    }

    fn offset(&self, shift: &Multiples) -> PlaceInSpace {
        self.t.translated(&G::Point::default(), shift)
    }

    fn at(&self, place: &PlaceInSpace) -> Result<Option<CellAt>> {
        let (t, mut position) = (self.t, G::Point::default());
        (0..G::D).for_each(|axis| position[axis] = place[axis]);
        let Ok((home, wrap)) = t.lattice.wrapped("positions", 0, &position) else { return Ok(None) };
        let (cell, shift) = match t.periodic_location(self.cells, &home, t.inside.t.locate(&home)?)? {
            PeriodicLocation::Vertex(image) => {
                let Some(cell) = t.inside.t.a_cell_at(t.inside.images.home(image.vertex))? else {
                    return Ok(None);
                };
                let (class, by) = t.placed(self.cells, cell)?;
                (class, plus(by, image.shift))
            }
            PeriodicLocation::Cell(placed) => placed,
            PeriodicLocation::Outside(_) | PeriodicLocation::NoCells => return Ok(None),
        };
        Ok(Some((cell, [0, 1, 2].map(|j| i64::from(shift[j]) + wrap[j]))))
    }

    fn rounding(&self, extent: &Extent) -> PlaceInSpace {
        let mut rounding = [0.0; 3];
        for axis in 0..G::D {
            let of_vectors: f64 = self.t.lattice.reduced().iter().map(|vector| vector[axis].abs()).sum();
            let greatest = extent.low[axis].abs().max(extent.high[axis].abs());
            rounding[axis] = ROUNDING * (greatest + MOST_PERIODS as f64 * of_vectors);
        }
        rounding
    }

    fn copies(&self, gone: &[Gone], cells: impl Iterator<Item = CellId>) -> Result<Vec<(u32, PlaceInSpace)>> {
        let (mut copies, within) = (Vec::new(), &self.extent_of(cells));
        let multiples = |extent: &Extent| {
            let [low, high] = [extent.low, extent.high];
            [0, 1, 2].map(|j| {
                let form = self.t.lattice.form(j);
                let of = |from: &PlaceInSpace, to: &PlaceInSpace| -> f64 {
                    (0..G::D).map(|axis| (form[axis] * from[axis]).min(form[axis] * to[axis])).sum()
                };
                let negative = |p: &PlaceInSpace| p.map(|x| -x);
                (of(&low, &high), -of(&negative(&low), &negative(&high)))
            })
        };
        let all = multiples(within);
        for (k, cell) in (0..).zip(gone) {
            let extent = Extent::of(&cell.corners[..=G::D]);
            let mut ranges = [(0, 0); 3];
            for (j, (own, other)) in
                multiples(&extent).into_iter().zip(all).enumerate().take(self.t.lattice.rank())
            {
                // One period more at both ends, as multiples are rounded.
                ranges[j] = ((other.0 - own.1).floor() as i64, (other.1 - own.0).ceil() as i64);
                let value = own.1 - own.0;
                if value > MOST_PERIODS as f64 {
                    let wanted = "such that no cell reaches through more than 64 periods";
                    return Err(Error::InvalidValue { argument: "positions", index: 0, value, wanted });
                }
            }
            for a in ranges[0].0..=ranges[0].1 {
                for b in ranges[1].0..=ranges[1].1 {
                    for c in ranges[2].0..=ranges[2].1 {
                        let offset = self.t.translated(&G::Point::default(), &[a, b, c]);
                        let corners = cell.corners.map(|p| [0, 1, 2].map(|axis| p[axis] + offset[axis]));
                        if Extent::of(&corners[..=G::D]).meets(within) {
                            memory::push(&mut copies, (k, offset))?;
                        }
                    }
                }
            }
        }
        Ok(copies)
    }
}

/// The facets of a cell, by the vertices of each in the order of their ids, with their shifts from the first one.
fn facets_of(row: &[(VertexId, [i64; 3])]) -> [NamedFacet; 4] {
    let mut facets = [NamedFacet::default(); 4];
    for (k, facet) in facets.iter_mut().enumerate().take(row.len()) {
        let mut others = [((VertexId::NONE, [0; 3]), 0); 3];
        let on_facet = row.iter().zip(0..).filter(|&(_, i)| usize::from(i) != k);
        others.iter_mut().zip(on_facet).for_each(|(entry, (&corner, i))| *entry = (corner, i));
        let others = &mut others[..row.len() - 1];
        others.sort_unstable();
        let ((_, first), anchor) = others[0];
        // Two facets that are given the same name are two more neighbours for a fit.
        let mut name = 0u128;
        for ((v, shift), _) in &*others {
            let numbers = [i64::from(v.get()), shift[0] - first[0], shift[1] - first[1], shift[2] - first[2]];
            for number in numbers {
                name = (name.rotate_left(41) ^ number as u128)
                    .wrapping_mul(0x9e37_79b9_7f4a_7c15_f39c_c060_5ced_c835);
            }
        }
        *facet = NamedFacet { name, anchor };
    }
    facets
}
