//! The algorithms: one row for each.
//!
//! The C enumeration, the tests that run over all algorithms, the benchmark's engines and its report follow from the
//! rows; the tables of docs/WHICH_ALGORITHM.md and docs/ARCHITECTURE.md and the list of CHANGELOG.md are checked against them
//! (ffi-tests/algorithms.rs). So an algorithm needs a file with its commit, a row here, and its documentation.

use crate::motion::region_kind::RegionKind;

/// What an algorithm is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// For programs: `DELDRIFT_<NAME>` in C.
    Use,
    /// To compare with: `DELDRIFT_RESEARCH_<NAME>` in C. Another algorithm is faster.
    Comparison,
    /// A means of [`Algorithm::Auto`], by itself for tests and the benchmark only: no name in C.
    Internal,
}

/// How a commit brings the triangulation to its new positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commits {
    /// The triangulation is built again.
    Rebuild,
    /// Vertices are relocated one after the other.
    OneByOne,
    /// All vertices move at once; then what fails is repaired.
    Together,
    /// One of the other algorithms makes the commit.
    ByOthers,
}

/// What is known of an algorithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AlgorithmRow {
    /// Its name in files of the benchmark, and, in capitals, in C.
    pub name: &'static str,
    /// What it is there for.
    pub purpose: Purpose,
    /// How it commits.
    pub commits: Commits,
    /// What it keeps between commits; empty if nothing.
    pub keeps: &'static str,
    /// What the C header says of it.
    pub documentation: &'static str,
}

/// By which regions immediate relocations are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Immediate {
    /// By no regions: the algorithm keeps none, or none that serve one vertex at a time.
    None,
    /// By regions of this kind, which are computed if they are not kept.
    By(RegionKind),
    /// By regions of this kind, which are computed if they are not kept, once *rebuilding + tolerance* has
    /// switched.
    OnceSwitched(RegionKind),
    /// By regions of this kind, while they are kept.
    WhileKept(RegionKind),
}

/// Hands the table on to a macro. A row: documentation, variant and C code, what [`AlgorithmRow`] has, what filters
/// immediate relocations, and the method that commits.
macro_rules! for_algorithms {
    ($macro:ident) => {
        $macro! {
        default Auto;

        /// Chooses at each commit by what the last ones found. Where all vertices are staged: repair, of only those
        /// certificates that can fail while displacements are small compared with the spacing, or rebuilding where too
        /// much would fail. Where fewer than one vertex in ten is staged: tolerance if that is up to date, else
        /// placement with flips.
        Auto = 0 {
            name: "auto",
            purpose: Use,
            commits: ByOthers,
            keeps: "what the last commits have cost, and what those algorithms keep",
            immediate: WhileKept(Tolerance),
            by: commit_by_auto(),
        }

        /// Builds the triangulation again from all positions (RR-6750, section 1).
        Rebuilding = 1 {
            name: "rebuilding",
            purpose: Use,
            commits: Rebuild,
            keeps: "",
            immediate: None,
            by: rebuild(),
        }

        /// Takes the moved vertices one by one. Where no certificate of the star fails, only the coordinates change;
        /// where the cells of the star stay positively oriented, flips repair it (in 3D these can get stuck, and are
        /// then undone); else a walk from the old place, a removal and an insertion (RR-6750, section 3.2). For a few
        /// vertices that move far.
        PlacementFlips = 2 {
            name: "placement_flips",
            purpose: Use,
            commits: OneByOne,
            keeps: "",
            immediate: None,
            by: commit_by_placement(Shortcut::Flips),
        }

        /// Keeps for each vertex a distance within which it is certain to change nothing but coordinates, see
        /// deldrift_tolerance. A vertex that stays within costs one distance, any other a placement and the
        /// tolerances around it (RR-6750, Algorithm 1). For displacements so small that nearly all vertices stay
        /// within, and for schemes that converge. All tolerances are computed by the first commit, and by the first
        /// one after another algorithm's.
        Tolerance = 3 {
            name: "tolerance",
            purpose: Use,
            commits: OneByOne,
            keeps: "tolerances per vertex",
            immediate: By(Tolerance),
            by: commit_by_tolerance(),
        }

        /// All vertices move at once, every certificate is checked, and what fails is repaired by flips and
        /// placements. Rebuilds where too much fails.
        Repair = 4 {
            name: "repair",
            purpose: Use,
            commits: Together,
            keeps: "",
            immediate: None,
            by: commit_by_repair(Start::AtOrigins),
        }

        /// For comparison: as DELDRIFT_PLACEMENT_FLIPS, without flips (RR-6750, section 3.1). In the recorded report
        /// slower than that in 59 of 74 rows.
        Placement = 16 {
            name: "placement",
            purpose: Comparison,
            commits: OneByOne,
            keeps: "",
            immediate: None,
            by: commit_by_placement(Shortcut::Certificates),
        }

        /// For comparison: as DELDRIFT_TOLERANCE, with a larger region for each vertex: inside the delimiters of the
        /// facets it is on, outside those of the facets opposite it (see deldrift_research_standard_delimiter); in 3D
        /// also not so far that delimiters prove too little (RR-6750, Algorithm 2). More vertices stay within, at the
        /// cost of a distance for every facet of the star of each, and of the memory of a delimiter for every facet of
        /// every cell. In the recorded report slower than DELDRIFT_TOLERANCE in 74 of 74 rows.
        SafeRegion = 17 {
            name: "safe_region",
            purpose: Comparison,
            commits: OneByOne,
            keeps: "delimiters per facet",
            immediate: By(SafeRegion),
            by: commit_by_safe_region(RegionKind::SafeRegion),
        }

        /// For comparison: the safe region is tested only where the tolerance test fails. As many vertices stay within
        /// as with either, and most cost one distance: one that leaves its tolerance slowly gets another ball in its
        /// safe region. Memory as for the safe region. In the recorded report slower than DELDRIFT_TOLERANCE in 68 of
        /// 74 rows.
        SafeRegionTolerance = 18 {
            name: "safe_region_tolerance",
            purpose: Comparison,
            commits: OneByOne,
            keeps: "tolerances per vertex, delimiters per facet",
            immediate: By(Both),
            by: commit_by_safe_region(RegionKind::Both),
        }

        /// For comparison: rebuilds until a sample of the vertices stays within tolerance, then tolerance for good, by
        /// the rule of deldrift_research_options (RR-6750, section 5.2). A sample costs the tolerances of a few
        /// vertices. To choose another algorithm and this one again starts over. In the recorded report slower than
        /// DELDRIFT_AUTO in 71 of 74 rows.
        RebuildingTolerance = 19 {
            name: "rebuilding_tolerance",
            purpose: Comparison,
            commits: ByOthers,
            keeps: "tolerances per vertex",
            immediate: OnceSwitched(Tolerance),
            by: commit_by_switching(),
        }

        /// All vertices move at once; of the certificates, those of vertices that leave their tolerance are checked,
        /// and those that would make it too small; what fails is repaired by flips and placements. For displacements of
        /// up to about a thousandth of the spacing in 2D, and a ten-thousandth in 3D. Commits that do not move all
        /// vertices at once, or while vertices share a place, are those of repair.
        Watching = 1000 {
            name: "watching",
            purpose: Internal,
            commits: Together,
            keeps: "tolerances per vertex, watched bi-cells",
            immediate: None,
            by: watch_or_repair(),
        }

        /// All vertices move at once; the certificates of those bi-cells are checked whose own tolerance is used up by
        /// the ways that their vertices have gone; what fails is repaired by flips and placements. For displacements of
        /// up to a few ten-thousandths of the spacing in 3D. Keeps 16 bytes for each cell in 3D, 12 in 2D. Commits that
        /// do not move all vertices at once, or while vertices share a place, are those of repair.
        Slack = 1001 {
            name: "slack",
            purpose: Internal,
            commits: Together,
            keeps: "tolerances per bi-cell, distances travelled per vertex",
            immediate: None,
            by: slack_or_repair(),
        }
        }
    };
}
pub(super) use for_algorithms;

macro_rules! algorithm_enum {
    (default $default:ident; $(
        $(#[doc = $line:literal])+
        $variant:ident = $code:literal {
            name: $name:literal,
            purpose: $purpose:ident,
            commits: $commits:ident,
            keeps: $keeps:literal,
            immediate: $immediate:ident$(($filter:ident))?,
            by: $method:ident($($argument:expr),*),
        }
    )+) => {
        /// How [`commit_timestamp`](super::MovingTriangulation::commit_timestamp) brings the triangulation to the
        /// staged positions. Every algorithm gives exactly the same cells; they differ in cost.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        pub enum Algorithm {
            $(
                $(#[doc = $line])+
                $variant = $code,
            )+
        }

        impl Default for Algorithm {
            fn default() -> Algorithm {
                Algorithm::$default
            }
        }

        impl Algorithm {
            /// Every algorithm, those for use first.
            pub const ALL: [Algorithm; [$($code),+].len()] = [$(Algorithm::$variant),+];

            /// What is known of it.
            pub const fn row(self) -> &'static AlgorithmRow {
                match self {
                    $(Algorithm::$variant => &AlgorithmRow {
                        name: $name,
                        purpose: Purpose::$purpose,
                        commits: Commits::$commits,
                        keeps: $keeps,
                        documentation: concat!($($line, "\n"),+),
                    },)+
                }
            }

            #[inline(always)]
            pub(super) const fn immediate(self) -> Immediate {
                match self {
                    $(Algorithm::$variant => Immediate::$immediate$((RegionKind::$filter))?,)+
                }
            }
        }
    };
}

for_algorithms!(algorithm_enum);

impl Algorithm {
    /// Its number in C.
    pub const fn code(self) -> u32 {
        self as u32
    }

    /// The algorithm of a number.
    pub fn from_code(code: u32) -> Option<Algorithm> {
        Algorithm::ALL.into_iter().find(|algorithm| algorithm.code() == code)
    }

    /// Its name, as in files of the benchmark.
    pub const fn name(self) -> &'static str {
        self.row().name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_tell_the_purpose() {
        for algorithm in Algorithm::ALL {
            let expected = match algorithm.code() {
                0..16 => Purpose::Use,
                16..1000 => Purpose::Comparison,
                _ => Purpose::Internal,
            };
            assert_eq!(algorithm.row().purpose, expected, "{algorithm:?}");
            assert_eq!(Algorithm::from_code(algorithm.code()), Some(algorithm));
        }
        assert_eq!(Algorithm::from_code(999), None);
        assert!(Algorithm::ALL.is_sorted_by_key(|algorithm| algorithm.code()));
    }

    #[test]
    fn names_are_those_of_the_variants() {
        for algorithm in Algorithm::ALL {
            let variant = format!("{algorithm:?}");
            assert_eq!(algorithm.name().replace('_', ""), variant.to_lowercase());
        }
    }
}
