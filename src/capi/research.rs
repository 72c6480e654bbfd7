//! What `include/deldrift/research.h` declares: the algorithms of the research report RR-6750 that are there to compare
//! with, and the certificates that they and the report are about.

use super::handle::{Changing, Reading, deldrift_triangulation, in_open};
use super::options::invalid;
use super::pointers::{Buffer, Input, Output, given};
use super::query::{check_facet, dimension_of};
use super::status::{Failure, deldrift_status};
use crate::delaunay::Dimension;
use crate::ids::CellId;
use crate::in_its_dimension;
use crate::motion::{Algorithm, MovingTriangulation, Purpose, SwitchingRule};

/// Algorithms of RR-6750 to compare with, not for use: for deldrift_research_set_algorithm. Each gives exactly the
/// cells that the algorithms of deldrift.h give.
///
/// In the recorded report each is slower than another algorithm in most or all rows. The recorded report is
/// cpp-bench/results/report.csv, in which the experiments of RR-6750 are repeated: 74 rows, each an input or a part of
/// one.
///
/// Numbers from 1000 on are means of DELDRIFT_AUTO by themselves, for the library's own tests and its benchmark.
// An algorithm as it arrives from C, where any number may be passed. The header's enumeration has the rows of
// motion/algorithms.rs.
pub type ResearchAlgorithmCode = u32;

/// The rule by which DELDRIFT_RESEARCH_REBUILDING_TOLERANCE goes over from rebuilding to tolerance. Zeros, but for
/// struct_size, are the defaults.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_research_options {
    /// sizeof(deldrift_research_options). As this header may change with every version, a structure of another size is
    /// refused.
    pub struct_size: usize,
    /// Rebuilding ends at the first sample of which at least this share stays within tolerance: above 0 and at most 1.
    /// 0, the default, stands for 0.75 in 2D and 0.55 in 3D.
    pub switch_share: f64,
    /// Seed of the random samples: with the same seed, the same calls do the same. Default 0.
    pub switch_seed: u64,
    /// How many vertices are sampled each time, at most as many as there are. 0, the default, stands for 40.
    pub switch_sample: u32,
    /// A sample is taken at the first of every switch_period commits. 0, the default, stands for 4.
    pub switch_period: u32,
}

/// Options of research as a call is given them.
#[derive(Clone, Copy)]
struct GivenRule<'a> {
    options: Input<'a, deldrift_research_options>,
    struct_size: Input<'a, usize>,
}

impl<'a> GivenRule<'a> {
    /// # Safety
    /// `options` is NULL, misaligned, or points to as many bytes as its first field says.
    unsafe fn new(argument: &'static str, options: *const deldrift_research_options) -> Self {
        // SAFETY: the caller's promise; the size comes first, with the alignment of the whole.
        let struct_size = unsafe { Input::new(argument, options.cast()) };
        // SAFETY: the caller's promise. It is read only where the size is that of the structure.
        let options = unsafe { Input::new(argument, options) };
        GivenRule { options, struct_size }
    }

    /// The rule, if the program has the structure of this version; the default one if it has none.
    fn read(self) -> Result<SwitchingRule, Failure> {
        let Some(&size) = self.struct_size.if_any()? else { return Ok(SwitchingRule::default()) };
        if size != size_of::<deldrift_research_options>() {
            let (field, wanted) = ("options.struct_size", "sizeof(deldrift_research_options)");
            return Err(Failure::Option { field, value: size as u64, wanted });
        }
        self.options.get()?.rule()
    }
}

impl deldrift_research_options {
    /// The rule in the library's own terms.
    fn rule(&self) -> Result<SwitchingRule, Failure> {
        let share = match self.switch_share {
            0.0 => None,
            share if share > 0.0 && share <= 1.0 => Some(share),
            value => return Err(Failure::Share { field: "options.switch_share", value }),
        };
        let default = SwitchingRule::default();
        let given_or = |given, default| if given == 0 { default } else { given };
        Ok(SwitchingRule {
            sample: given_or(self.switch_sample, default.sample),
            period: given_or(self.switch_period, default.period),
            share,
            seed: self.switch_seed,
        })
    }
}

/// The algorithm of a number: one that is not for use.
fn research_algorithm(code: ResearchAlgorithmCode) -> Result<Algorithm, Failure> {
    let found = Algorithm::from_code(code).filter(|algorithm| algorithm.row().purpose != Purpose::Use);
    found.ok_or_else(|| invalid("algorithm", code, "a deldrift_research_algorithm"))
}

/// Changes the algorithm of later commits to one of research, until deldrift_set_algorithm chooses another. Staged
/// moves stay. What the new algorithm needs and the old one did not keep is computed by the next commit.
///
/// options: NULL for the defaults. DELDRIFT_RESEARCH_REBUILDING_TOLERANCE goes by them from the next commit on; it
/// starts over with rebuilding if another algorithm was in force. deldrift_get_algorithm gives the number of the
/// algorithm.
///
/// Cost: n + m at most, to free what the old one keeps.
///
/// Errors: DELDRIFT_INVALID_OPTIONS.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_research_set_algorithm(
    t: *mut deldrift_triangulation,
    algorithm: ResearchAlgorithmCode,
    options: *const deldrift_research_options,
) -> deldrift_status {
    given!(t: Changing, options: GivenRule);
    t.change_any(|t| {
        let algorithm = research_algorithm(algorithm)?;
        let rule = options.read()?;
        in_open!(t => {
            t.set_algorithm(algorithm);
            t.set_switching_rule(rule);
        });
        Ok(())
    })
}

/// How many vertices all commits together have found to be certainly within their safe region, of those that were not
/// within their tolerance or whose tolerance was not tested, to *count. Of one commit it is the difference before and
/// after.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_research_within_safe_region(
    t: *const deldrift_triangulation,
    count: *mut u64,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.tell_any(count, |t| Ok(in_open!(t => t.statistics().within_safe_region)))
}

/// The annulus widths of all bi-cells: entry i of the row of a cell, in the order of deldrift_cells, is
/// that of the bi-cell at the facet opposite corner i. Each bi-cell is there twice, from either side;
/// facets of the hull have none, and their entries are NaN.
///
/// A bi-cell is a facet with the two cells that share it. Its annulus is between two circles or spheres
/// with the same centre: the inner one through the vertices of the facet, the outer one through the two
/// vertices opposite it. The widths are certified lower bounds, 0 where nothing is certain.
///
/// widths: a buffer with room for capacity numbers. count: receives the number of entries, 3 (2D) or 4 (3D) times that
/// of the cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_research_annulus_widths(
    t: *const deldrift_triangulation,
    widths: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, widths[capacity]: Buffer, count: Output);
    t.read(|t| {
        in_its_dimension!(t => {
            let needed = t.cell_count() * (dimension_of(t) + 1);
            widths.fill(count, needed, || Ok(t.annulus_widths()?))
        })
    })
}

/// The standard delimiter of a bi-cell: the circle or sphere in the middle of its annulus, see
/// deldrift_research_annulus_widths, which has the vertices of the facet inside and the two opposite it outside.
///
/// cell, corner: the facet opposite this corner (0, 1, ...) of this cell, an index into deldrift_cells.
/// centre: receives 2 or 3 numbers, which are not finite where none could be computed. tolerance: receives
/// the certified tolerance of the bi-cell, which those of its vertices do not exceed; half the annulus
/// width in 2D, and at most that in 3D, where other changes may come sooner. A facet of the hull has no delimiter: all
/// of these numbers are NaN then.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_FACET, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_research_standard_delimiter(
    t: *const deldrift_triangulation,
    cell: u32,
    corner: u32,
    centre: *mut f64,
    radius: *mut f64,
    tolerance: *mut f64,
) -> deldrift_status {
    given!(t: Reading, radius: Output, tolerance: Output);
    t.read(|t| {
        in_its_dimension!(t => {
            let centre = centre.cast();
            given!(centre: Output);
            let (centre, radius, tolerance) = (centre.place()?, radius.place()?, tolerance.place()?);
            check_facet(t.cells()?.corners, cell, corner)?;
            let delimiter = t.standard_delimiter(CellId::new(cell), corner)?;
            centre.write(delimiter.as_ref().map_or_else(|| nowhere(t), |delimiter| delimiter.centre));
            radius.write(delimiter.as_ref().map_or(f64::NAN, |delimiter| delimiter.radius));
            tolerance.write(delimiter.as_ref().map_or(f64::NAN, |delimiter| delimiter.tolerance));
        });
        Ok(())
    })
}

/// A point without numbers, in the dimension of `t`.
fn nowhere<G: Dimension>(_t: &MovingTriangulation<G>) -> G::Point {
    let mut nowhere = G::Point::default();
    (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
    nowhere
}

#[cfg(test)]
mod tests {
    use super::*;

    const ZEROS: deldrift_research_options = deldrift_research_options {
        struct_size: size_of::<deldrift_research_options>(),
        switch_share: 0.0,
        switch_seed: 0,
        switch_sample: 0,
        switch_period: 0,
    };

    #[test]
    fn switching_rule_is_taken_over() {
        assert_eq!(ZEROS.rule().ok(), Some(SwitchingRule::default()));
        let options = deldrift_research_options {
            switch_share: 0.25,
            switch_seed: u64::MAX,
            switch_sample: 7,
            switch_period: 9,
            ..ZEROS
        };
        let wanted = SwitchingRule { sample: 7, period: 9, share: Some(0.25), seed: u64::MAX };
        assert_eq!(options.rule().ok(), Some(wanted));
        for switch_share in [f64::MIN_POSITIVE, 1.0, -0.0] {
            assert!(deldrift_research_options { switch_share, ..options }.rule().is_ok(), "{switch_share}");
        }
        for switch_share in [f64::NAN, f64::INFINITY, -f64::MIN_POSITIVE, 1.0 + f64::EPSILON] {
            assert!(deldrift_research_options { switch_share, ..options }.rule().is_err(), "{switch_share}");
        }
    }

    #[test]
    fn algorithms_for_use_are_none_of_research() {
        for algorithm in Algorithm::ALL {
            let is_for_use = algorithm.row().purpose == Purpose::Use;
            assert_eq!(research_algorithm(algorithm.code()).is_err(), is_for_use, "{algorithm:?}");
        }
    }
}
