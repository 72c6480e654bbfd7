//! Options: a structure that can grow, read as far as the caller's header knows it.

use std::ffi::c_void;
use std::mem::{MaybeUninit, offset_of};
use std::ptr;

use super::pointers;
use super::status::Failure;
use crate::complex::memory;
use crate::motion::{Algorithm, CoincidencePolicy, Monitor, Options, SwitchingRule};

/// How deldrift_commit_timestamp brings the triangulation to the staged positions. Every algorithm
/// gives exactly the same cells; they differ in what they cost.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_algorithm {
    /// The library chooses at each commit by what the last ones found: watching while few vertices leave
    /// their tolerance, in 3D slack while few bi-cells use theirs up, otherwise repair, or rebuilding where too
    /// much would fail. Where fewer than one vertex in twenty is staged: tolerance if that is up to date, else
    /// placement with flips.
    DELDRIFT_AUTO = 0,
    /// Builds the triangulation anew from all positions.
    DELDRIFT_REBUILDING = 1,
    /// Takes the moved vertices one by one: finds the new place by a walk from the old one, removes and
    /// inserts. Where no certificate of the star fails, only the coordinates change.
    DELDRIFT_PLACEMENT = 2,
    /// As placement, but a star whose cells stay positively oriented is repaired by flips; in 3D
    /// they are taken back where they lead nowhere.
    DELDRIFT_PLACEMENT_FLIPS = 3,
    /// Keeps for each vertex a distance within which it is certain to change nothing but coordinates, see
    /// deldrift_tolerance. A vertex that stays within costs one distance, any other a placement and the
    /// tolerances around it. For displacements so small that nearly all vertices stay within, and for
    /// schemes that converge. All tolerances are computed by the first commit, and by the first one after
    /// another algorithm's.
    DELDRIFT_TOLERANCE = 4,
    /// As tolerance, with a larger region for each vertex: inside the delimiters of the facets it is on,
    /// outside those of the facets opposite it (see deldrift_standard_delimiter); in 3D also not so far that
    /// delimiters prove too little. More vertices stay within, at the cost of a distance for every facet of
    /// the star of each, and of the memory of a delimiter for every facet of every cell. For displacements
    /// that are often just above the tolerances.
    DELDRIFT_SAFE_REGION = 5,
    /// The safe region is tested only where the tolerance test fails: as many vertices stay within as with
    /// either, and most cost one distance. Memory as for the safe region. For displacements that are small
    /// for most vertices and not for all.
    DELDRIFT_SAFE_REGION_TOLERANCE = 6,
    /// Rebuilds until a sample of the vertices stays within tolerance, then tolerance for good; the rule is
    /// that of switch_share and the options behind it. A sample costs the tolerances of a few vertices. For
    /// schemes that begin with large displacements and converge. To choose another algorithm and this one
    /// again starts over.
    DELDRIFT_REBUILDING_TOLERANCE = 7,
    /// All vertices move at once, every certificate is checked, and what fails is mended by flips and
    /// placements. Rebuilds where too much fails.
    DELDRIFT_REPAIR = 8,
    /// As repair, but only the certificates of vertices that leave their tolerance are checked, and those
    /// that would make it too small. For displacements of up to about a thousandth of the spacing in 2D, and a
    /// ten-thousandth in 3D. Commits that do not move all vertices at once, or while vertices share a place,
    /// are those of repair.
    DELDRIFT_WATCHING = 9,
    /// As repair, but only the certificates of those bi-cells are checked whose own tolerance is used up by
    /// the ways that their vertices have gone. For displacements of up to a few ten-thousandths of the spacing
    /// in 3D. Keeps 16 bytes for each cell in 3D, 12 in 2D. Commits that do not move all vertices at once, or
    /// while vertices share a place, are those of repair.
    DELDRIFT_SLACK = 10,
}

/// What happens when vertices come to lie at the same place.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_coincidence {
    /// The lowest id represents the place in the cells; the others are hidden until they move apart.
    DELDRIFT_COINCIDENCE_MERGE = 0,
    /// The call fails with DELDRIFT_COINCIDENT and has no effect.
    DELDRIFT_COINCIDENCE_REJECT = 1,
}

/// An algorithm as it arrives from C, where any number may be passed.
pub type AlgorithmCode = u32;
/// A coincidence policy as it arrives from C, where any number may be passed.
pub type CoincidenceCode = u32;

/// Options of a triangulation. Initialise them with deldrift_options_init, then set what should differ
/// from the defaults, all of which are zero.
///
/// The structure may grow in later versions. struct_size says how much of it the program knows: fields
/// beyond it have their defaults. A size greater than the library's own is accepted as long as all
/// bytes that the library does not know are zero. A size that is 0, ends inside a field or is beyond
/// 4096 is DELDRIFT_INVALID_OPTIONS, as is any value not listed here.
///
/// The callbacks are called from inside deldrift_create and deldrift_commit_timestamp, on the thread
/// that called these, one at a time, and not after deldrift_destroy. They must return normally (no
/// exception, no longjmp) and must not use the triangulation that is being created or committed: such
/// calls are turned away with DELDRIFT_BUSY. Other triangulations may be used. What user_data points to
/// must live as long as the triangulation.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct deldrift_options {
    /// sizeof(deldrift_options) as the program sees it.
    pub struct_size: usize,
    /// Algorithm of later commits; may be changed by deldrift_set_algorithm. Default DELDRIFT_AUTO.
    pub algorithm: AlgorithmCode,
    /// Greatest number of threads a call may use, the calling one included; 0, the default, lets the library
    /// choose: as many as the system runs at the same time, but one for each 16,000 vertices in 2D or 5,000
    /// in 3D. They are used to build and rebuild, and to move all, check all certificates and flip in repair, where
    /// there is enough work for each; they end with the call. The cells do not depend on the number, their
    /// order and the counts in reports may. Callbacks come from the calling thread only.
    pub threads: u32,
    /// Default DELDRIFT_COINCIDENCE_MERGE.
    pub coincidence: CoincidenceCode,
    /// 1 keeps what deldrift_changed_cells needs, at some cost for each commit; 0, the default, does not.
    pub track_changes: u32,
    /// Called now and then during long calls; when it returns true, the call ends in DELDRIFT_CANCELLED
    /// and has had no effect. NULL, the default, never cancels.
    pub cancel: Option<unsafe extern "C" fn(user_data: *mut c_void) -> bool>,
    /// Called now and then during long calls with the part of the work that is done, from 0 to 1. NULL
    /// is the default.
    pub progress: Option<unsafe extern "C" fn(user_data: *mut c_void, fraction: f64)>,
    /// Handed to the callbacks as it is.
    pub user_data: *mut c_void,
    /// DELDRIFT_REBUILDING_TOLERANCE stops rebuilding at the first sample of which at least this share stays
    /// within tolerance: above 0 and at most 1. 0, the default, stands for 0.75 in 2D and 0.55 in 3D.
    pub switch_share: f64,
    /// Seed of its random samples: with the same seed, the same calls do the same. Default 0.
    pub switch_seed: u64,
    /// How many vertices it samples each time. 0, the default, stands for 40.
    pub switch_sample: u32,
    /// It takes a sample at the first of every so many commits. 0, the default, stands for 4.
    pub switch_period: u32,
}

/// Greatest `struct_size` that is taken for a size: anything above it is more likely to be garbage, and
/// would have its tail looked at far beyond any structure.
const GREATEST_SIZE: usize = 4096;

impl deldrift_options {
    const DEFAULT: deldrift_options = deldrift_options {
        struct_size: size_of::<deldrift_options>(),
        algorithm: 0,
        threads: 0,
        coincidence: 0,
        track_changes: 0,
        cancel: None,
        progress: None,
        user_data: ptr::null_mut(),
        switch_share: 0.0,
        switch_seed: 0,
        switch_sample: 0,
        switch_period: 0,
    };

    /// Where a `struct_size` may end: behind any field.
    const ENDS: [usize; 12] = [
        size_of::<usize>(),
        offset_of!(deldrift_options, threads),
        offset_of!(deldrift_options, coincidence),
        offset_of!(deldrift_options, track_changes),
        offset_of!(deldrift_options, cancel),
        offset_of!(deldrift_options, progress),
        offset_of!(deldrift_options, user_data),
        offset_of!(deldrift_options, switch_share),
        offset_of!(deldrift_options, switch_seed),
        offset_of!(deldrift_options, switch_sample),
        offset_of!(deldrift_options, switch_period),
        size_of::<deldrift_options>(),
    ];

    /// Reads the part that the caller knows and checks the part that only the caller knows.
    ///
    /// # Safety
    /// `options` is NULL, misaligned, or points to as many bytes as its first field says.
    pub(super) unsafe fn read(options: *const deldrift_options) -> Result<deldrift_options, Failure> {
        if options.is_null() {
            return Ok(Self::DEFAULT);
        }
        // SAFETY: the size comes first, with the alignment of the whole.
        let size = *unsafe { pointers::reference("options", options.cast::<usize>()) }?;
        let misfit = |wanted| Failure::Option { field: "options.struct_size", value: size as u64, wanted };
        if size > GREATEST_SIZE || (size < Self::DEFAULT.struct_size && !Self::ENDS.contains(&size)) {
            return Err(misfit("sizeof(deldrift_options)"));
        }
        // SAFETY: the caller vouches for that many bytes.
        let given = unsafe { pointers::array("options", options.cast::<u8>(), size) }?;
        let (known, beyond) = given.split_at(size.min(Self::DEFAULT.struct_size));
        if beyond.iter().any(|&byte| byte != 0) {
            return Err(misfit("no more than this version's sizeof, or all zero beyond it"));
        }
        let mut read = MaybeUninit::new(Self::DEFAULT);
        // SAFETY: `known` is no longer than the structure and ends behind a field, so that what is
        // assembled has whole fields from either side; numbers and nullable pointers allow any bits.
        unsafe {
            ptr::copy_nonoverlapping(known.as_ptr(), read.as_mut_ptr().cast::<u8>(), known.len());
            Ok(read.assume_init())
        }
    }

    /// The same in the library's own terms.
    pub(super) fn convert(self) -> Result<Options, Failure> {
        let coincidence = match self.coincidence {
            0 => CoincidencePolicy::Merge,
            1 => CoincidencePolicy::Reject,
            other => return Err(invalid("options.coincidence", other, "a deldrift_coincidence")),
        };
        let track_changes = match self.track_changes {
            0 => false,
            1 => true,
            other => return Err(invalid("options.track_changes", other, "0 or 1")),
        };
        let algorithm = algorithm("options.algorithm", self.algorithm)?;
        Ok(Options {
            algorithm,
            threads: self.threads,
            coincidence,
            track_changes,
            switching: self.switching()?,
            monitor: self.monitor()?,
        })
    }

    fn switching(&self) -> Result<SwitchingRule, Failure> {
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

    fn monitor(&self) -> Result<Option<Monitor>, Failure> {
        if self.cancel.is_none() && self.progress.is_none() {
            return Ok(None);
        }
        let callbacks = Callbacks { cancel: self.cancel, progress: self.progress, user_data: self.user_data };
        let monitor = memory::boxed(move |fraction| callbacks.go_on(fraction))?;
        Ok(Some(monitor))
    }
}

/// The callbacks of one triangulation.
struct Callbacks {
    cancel: Option<unsafe extern "C" fn(*mut c_void) -> bool>,
    progress: Option<unsafe extern "C" fn(*mut c_void, f64)>,
    user_data: *mut c_void,
}

// SAFETY: only the caller knows what user_data is. It is used by nothing but the caller's own callbacks,
// one at a time, on the thread that makes the call; the header says so.
unsafe impl Send for Callbacks {}
// SAFETY: as above.
unsafe impl Sync for Callbacks {}

impl Callbacks {
    /// Reports progress and asks whether to go on.
    fn go_on(&self, fraction: f64) -> bool {
        if let Some(progress) = self.progress {
            // SAFETY: the caller set both, the one for the other.
            unsafe { progress(self.user_data, fraction) };
        }
        // SAFETY: as above.
        !self.cancel.is_some_and(|cancel| unsafe { cancel(self.user_data) })
    }
}

/// The algorithm of a number.
pub(super) fn algorithm(field: &'static str, code: AlgorithmCode) -> Result<Algorithm, Failure> {
    match code {
        0 => Ok(Algorithm::Auto),
        1 => Ok(Algorithm::Rebuilding),
        2 => Ok(Algorithm::Placement),
        3 => Ok(Algorithm::PlacementFlips),
        4 => Ok(Algorithm::Tolerance),
        5 => Ok(Algorithm::SafeRegion),
        6 => Ok(Algorithm::SafeRegionTolerance),
        7 => Ok(Algorithm::RebuildingTolerance),
        8 => Ok(Algorithm::Repair),
        9 => Ok(Algorithm::Watching),
        10 => Ok(Algorithm::Slack),
        other => Err(invalid(field, other, "a deldrift_algorithm")),
    }
}

/// The number of an algorithm.
pub(super) fn algorithm_code(algorithm: Algorithm) -> AlgorithmCode {
    let code = match algorithm {
        Algorithm::Auto => deldrift_algorithm::DELDRIFT_AUTO,
        Algorithm::Rebuilding => deldrift_algorithm::DELDRIFT_REBUILDING,
        Algorithm::Placement => deldrift_algorithm::DELDRIFT_PLACEMENT,
        Algorithm::PlacementFlips => deldrift_algorithm::DELDRIFT_PLACEMENT_FLIPS,
        Algorithm::Tolerance => deldrift_algorithm::DELDRIFT_TOLERANCE,
        Algorithm::SafeRegion => deldrift_algorithm::DELDRIFT_SAFE_REGION,
        Algorithm::SafeRegionTolerance => deldrift_algorithm::DELDRIFT_SAFE_REGION_TOLERANCE,
        Algorithm::RebuildingTolerance => deldrift_algorithm::DELDRIFT_REBUILDING_TOLERANCE,
        Algorithm::Repair => deldrift_algorithm::DELDRIFT_REPAIR,
        Algorithm::Watching => deldrift_algorithm::DELDRIFT_WATCHING,
        Algorithm::Slack => deldrift_algorithm::DELDRIFT_SLACK,
    };
    code as AlgorithmCode
}

fn invalid(field: &'static str, value: u32, wanted: &'static str) -> Failure {
    Failure::Option { field, value: value.into(), wanted }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn algorithms_and_their_numbers_agree() {
        for code in 0..11 {
            assert_eq!(algorithm("", code).map(algorithm_code).ok(), Some(code));
        }
        assert!(algorithm("", 11).is_err());
    }

    #[test]
    fn switching_rule_is_taken_over() {
        let rule = |options: deldrift_options| options.convert().map(|options| options.switching).ok();
        assert_eq!(rule(deldrift_options::DEFAULT), Some(SwitchingRule::default()));
        let options = deldrift_options {
            switch_share: 0.25,
            switch_seed: u64::MAX,
            switch_sample: 7,
            switch_period: 9,
            ..deldrift_options::DEFAULT
        };
        let wanted = SwitchingRule { sample: 7, period: 9, share: Some(0.25), seed: u64::MAX };
        assert_eq!(rule(options), Some(wanted));
        for switch_share in [f64::MIN_POSITIVE, 1.0, -0.0] {
            assert!(rule(deldrift_options { switch_share, ..options }).is_some(), "{switch_share}");
        }
        for switch_share in [f64::NAN, f64::INFINITY, -f64::MIN_POSITIVE, 1.0 + f64::EPSILON] {
            assert!(rule(deldrift_options { switch_share, ..options }).is_none(), "{switch_share}");
        }
    }

    #[test]
    fn sizes_end_behind_a_field() {
        for size in 0..=deldrift_options::DEFAULT.struct_size {
            let options = deldrift_options { struct_size: size, ..deldrift_options::DEFAULT };
            // SAFETY: `size` bytes are there.
            let read = unsafe { deldrift_options::read(&options) };
            assert_eq!(read.is_ok(), deldrift_options::ENDS.contains(&size), "{size}");
        }
    }
}
