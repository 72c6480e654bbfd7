//! Conservative transfer of means in cells.

use super::handle::{Reading, deldrift_triangulation, in_any};
use super::interpolation::check_product;
use super::listed::check_arrays;
use super::pointers::{Buffer, Output, Points, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::error::Error;
use crate::motion::{TransferOrder, TransferReport};

/// How much of a function means in cells are transferred with.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_transfer_order {
    /// As if it were constant in each cell.
    DELDRIFT_TRANSFER_FIRST_ORDER = 0,
    /// With a gradient in each cell, which is limited so that no new extreme comes of it.
    DELDRIFT_TRANSFER_SECOND_ORDER = 1,
}

/// An order as it arrives from C, where any number may be passed.
pub type TransferOrderCode = u32;

/// What deldrift_transfer_cells has met. A cell that is gone is at the new positions here.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct deldrift_transfer_report {
    /// Cells that are gone, those that count as such included.
    pub gone: u64,
    /// Cells that have come, those that count as such included.
    pub arrived: u64,
    /// Pairs of these that have something in common.
    pub overlaps: u64,
    /// Cells that are gone and turned over: what they have is counted as negative.
    pub turned_over: u64,
    /// Cells that have come where nothing was: their means are those of a neighbour.
    pub uncovered: u64,
    /// Zero; later versions may count more.
    pub reserved: [u64; 3],
    /// The area or volume, of the cells that are gone, where no cell has come, with its sign.
    pub lost_volume: f64,
    /// The area or volume, of the cells that have come, where no cell that is gone was, with its sign.
    pub gained_volume: f64,
    /// By how much at most both are off. What is no more than that may be 0.
    pub volume_error: f64,
    /// Zero; later versions may tell more.
    pub reserved_numbers: [f64; 3],
}

impl From<&TransferReport> for deldrift_transfer_report {
    fn from(report: &TransferReport) -> Self {
        Self {
            gone: report.gone as u64,
            arrived: report.arrived as u64,
            overlaps: report.overlaps as u64,
            turned_over: report.turned_over as u64,
            uncovered: report.uncovered as u64,
            reserved: [0; 3],
            lost_volume: report.lost_volume,
            gained_volume: report.gained_volume,
            volume_error: report.volume_error,
            reserved_numbers: [0.0; 3],
        }
    }
}

/// Brings means in cells over to the cells of now. It is conservative transfer, by the latest deldrift_take_changes, of
/// what a program keeps for each cell.
///
/// A mean rides with its cell while vertices move, and a cell that lives keeps it. At the positions of now, the cells
/// that are gone and those that have come cover the same region: each new cell gets the mean of what is in it. So the
/// sum of mean times area or volume stays where the hull does. A constant stays to the last bit. No mean is beyond
/// those of the cells around. The sum is that with the volumes at the positions of now. A program that keeps the
/// content of a cell while its volume changes first divides it by the volume of now, whatever the sign of that.
///
/// positions: by id, where the vertices of the former cells are now, or where they were when they were removed. That is
/// what a program has given to its last commit, before it reads the positions of what has been inserted since. There
/// are position_count rows of 2 or 3 numbers, of which those of vertices of cells that are gone are used. NULL stands
/// for where they are now, if none of them has been removed. In a periodic triangulation they are where vertices have
/// gone, through whatever periods: those before the program took any to another period. order: see
/// deldrift_transfer_order. values: a row of n_values numbers, up to 1e300 in magnitude, for each cell that there was
/// at the deldrift_take_changes before the last one, in the order of that time. It receives rows for the cells that
/// there are, in the order of deldrift_cells. value_count: how many cells there were. capacity: for how many rows there
/// is room, at least for the cells that were and for those that are. report: receives what was met. lost, gained:
/// receive n_values numbers each, see below. Each of the last three may be NULL.
///
/// Where the hull has changed, regions differ. lost is the content, mean times volume, that was where no new cell is.
/// gained is the content of new cells where nothing was. Such a cell has the mean of what covers the rest of it, or, if
/// nothing does, that of the nearest cell through facets, or 0 if there is none. With these the sums always agree but
/// for rounding: what there is, is what was, less lost and with gained. Where regions agree both are 0 but for
/// rounding: no more than volume_error times twice the greatest magnitude.
///
/// A cell that is gone, and is turned over at the new positions, has a negative volume there. What it has in common
/// with others counts as negative. Cells that live beneath it count as both gone and come, and get other means, too. So
/// the sum stays exact, and so does a constant, but means there may be beyond those of all others. turned_over counts
/// such cells, and shorter steps avoid them. A cell of now that was turned over since is gone as it was, and has come.
///
/// With the second order, what gradients add is limited for each cell. Its new mean is no less and no more than those
/// of the cells that it comes from, of their neighbours, and of the neighbours of these. Gradients are fitted to the
/// means of neighbours. Linear functions are kept but for rounding where that does not limit them, as it may at the
/// hull.
///
/// Cost: n log n for n cells in the list of changes and what they have in common, times n_values. A cell that is turned
/// over adds log m, and the cells of now that it meets, or would if it were half as large again. All such cells add m
/// if no corner of one is in the convex hull, or if they meet an eighth of all cells. In a periodic triangulation also
/// n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for an order that there is not, for a value that is used and
/// is no number or a greater one, and for positions that take a cell through more than 64 periods,
/// DELDRIFT_CHANGES_NOT_TAKEN if cells have changed since the latest deldrift_take_changes, if there was none, or if
/// ids have been given anew since the one before, DELDRIFT_WRONG_COUNT, DELDRIFT_NO_SUCH_VERTEX for a vertex beyond
/// position_count, DELDRIFT_REMOVED_VERTEX for one where positions are NULL, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_PREPARED, DELDRIFT_CANCELLED, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_transfer_cells(
    t: *const deldrift_triangulation,
    positions: *const f64,
    position_count: usize,
    order: TransferOrderCode,
    values: *mut f64,
    value_count: usize,
    n_values: usize,
    capacity: usize,
    report: *mut deldrift_transfer_report,
    lost: *mut f64,
    gained: *mut f64,
) -> deldrift_status {
    let n_places = capacity.saturating_mul(n_values);
    given!(t: Reading, positions[position_count]: Points, values[n_places]: Buffer, report: Output);
    given!(lost[n_values]: Buffer, gained[n_values]: Buffer);
    t.read_any_watched(|t, monitor| {
        let order = order_of(order)?;
        in_any!(t => {
            let positions = positions.if_any(t)?;
            let (before, now) = (t.count_before()?, t.cells()?.corners.len());
            if value_count != before {
                let (argument, given, wanted) = ("value_count", value_count, before);
                return Err(Error::WrongCount { argument, given, wanted, coming: 0 }.into());
            }
            let needed = before.max(now);
            check_arrays([values.offer()], capacity, needed)?;
            check_product::<f64>("values", needed, n_values)?;
            let places = values.places(needed * n_values)?;
            let report = report.if_any()?;
            let [lost, gained] = [lost.places_if_any(n_values)?, gained.places_if_any(n_values)?];
            // SAFETY: the header has the caller promise that the rows of cells that were are numbers, and no others
            // are asked for before they are written.
            let known = |before: u32, c: usize| unsafe { places[before as usize * n_values + c].assume_init() };
            let made = t.transferred(positions.as_deref(), order, n_values, &known, monitor)?;
            made.tell(n_values, |entry, mean| _ = places[entry].write(mean));
            if let Some(report) = report {
                report.write((&made.report).into());
            }
            write_all(lost, made.report.lost);
            write_all(gained, made.report.gained);
            Ok(())
        })
    })
}

/// The order of a number.
fn order_of(code: TransferOrderCode) -> Result<TransferOrder, Failure> {
    use deldrift_transfer_order::*;
    [
        (DELDRIFT_TRANSFER_FIRST_ORDER, TransferOrder::First),
        (DELDRIFT_TRANSFER_SECOND_ORDER, TransferOrder::Second),
    ]
    .into_iter()
    .find(|&(known, _)| known as u32 == code)
    .map(|(_, order)| order)
    .ok_or_else(|| {
        let (argument, wanted) = ("order", "0 or 1");
        Error::InvalidValue { argument, index: 0, value: f64::from(code), wanted }.into()
    })
}
