/*
 * deldrift, for research: algorithms and certificates of the research report RR-6750, there to compare with.
 *
 * Made by `make header` from src/capi/research.rs and, for the algorithms, src/motion/algorithms.rs: change it there.
 *
 * No program needs this to triangulate: deldrift.h has the algorithms for use, and in the recorded report each of these
 * is slower than one of those in most or all rows. What is here is for comparisons with the report, as cpp-bench makes
 * them. It is in the same library, and works on the triangulations of deldrift.h, whose first page holds here as well.
 * It may change with every version: compile a program with the header of the library that it runs with.
 *
 *     #include <deldrift/research.h>
 *
 *     deldrift_status by_safe_regions(deldrift_triangulation *t) {
 *         return deldrift_research_set_algorithm(t, DELDRIFT_RESEARCH_SAFE_REGION, NULL);
 *     }
 */

#ifndef DELDRIFT_RESEARCH_H
#define DELDRIFT_RESEARCH_H

#include "../deldrift.h"

/// Algorithms of RR-6750 to compare with, not for use: for deldrift_research_set_algorithm. Each gives exactly the
/// cells that the algorithms of deldrift.h give.
///
/// In the recorded report each is slower than another algorithm in most or all rows. The recorded report is
/// cpp-bench/results/report.csv, in which the experiments of RR-6750 are repeated: 74 rows, each an input or a part of
/// one.
///
/// Numbers from 1000 on are means of DELDRIFT_AUTO by themselves, for the library's own tests and its benchmark.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_research_algorithm : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// For comparison: as DELDRIFT_PLACEMENT_FLIPS, without flips (RR-6750, section 3.1). In the recorded report
    /// slower than that in 59 of 74 rows.
    DELDRIFT_RESEARCH_PLACEMENT = 16,
    /// For comparison: as DELDRIFT_TOLERANCE, with a larger region for each vertex: inside the delimiters of the
    /// facets it is on, outside those of the facets opposite it (see deldrift_research_standard_delimiter); in 3D
    /// also not so far that delimiters prove too little (RR-6750, Algorithm 2). More vertices stay within, at the
    /// cost of a distance for every facet of the star of each, and of the memory of a delimiter for every facet of
    /// every cell. In the recorded report slower than DELDRIFT_TOLERANCE in 74 of 74 rows.
    DELDRIFT_RESEARCH_SAFE_REGION = 17,
    /// For comparison: the safe region is tested only where the tolerance test fails. As many vertices stay within
    /// as with either, and most cost one distance: one that leaves its tolerance slowly gets another ball in its
    /// safe region. Memory as for the safe region. In the recorded report slower than DELDRIFT_TOLERANCE in 68 of
    /// 74 rows.
    DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE = 18,
    /// For comparison: rebuilds until a sample of the vertices stays within tolerance, then tolerance for good, by
    /// the rule of deldrift_research_options (RR-6750, section 5.2). A sample costs the tolerances of a few
    /// vertices. To choose another algorithm and this one again starts over. In the recorded report slower than
    /// DELDRIFT_AUTO in 71 of 74 rows.
    DELDRIFT_RESEARCH_REBUILDING_TOLERANCE = 19,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_research_algorithm deldrift_research_algorithm;
#else
typedef uint32_t deldrift_research_algorithm;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// The rule by which DELDRIFT_RESEARCH_REBUILDING_TOLERANCE goes over from rebuilding to tolerance. Zeros, but for
/// struct_size, are the defaults.
typedef struct deldrift_research_options {
    /// sizeof(deldrift_research_options). As this header may change with every version, a structure of another size is
    /// refused.
    size_t struct_size;
    /// Rebuilding ends at the first sample of which at least this share stays within tolerance: above 0 and at most 1.
    /// 0, the default, stands for 0.75 in 2D and 0.55 in 3D.
    double switch_share;
    /// Seed of the random samples: with the same seed, the same calls do the same. Default 0.
    uint64_t switch_seed;
    /// How many vertices are sampled each time, at most as many as there are. 0, the default, stands for 40.
    uint32_t switch_sample;
    /// A sample is taken at the first of every switch_period commits. 0, the default, stands for 4.
    uint32_t switch_period;
} deldrift_research_options;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// What `include/deldrift/research.h` declares: the algorithms of the research report RR-6750 that are there to compare
// ---------------------------------------------------------------------------------------------------------------------

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
deldrift_status deldrift_research_set_algorithm(deldrift_triangulation *t,
                                                deldrift_research_algorithm algorithm,
                                                const deldrift_research_options *options);

/// How many vertices all commits together have found to be certainly within their safe region, of those that were not
/// within their tolerance or whose tolerance was not tested, to *count. Of one commit it is the difference before and
/// after.
///
/// Cost: constant.
deldrift_status deldrift_research_within_safe_region(const deldrift_triangulation *t,
                                                     uint64_t *count);

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
deldrift_status deldrift_research_annulus_widths(const deldrift_triangulation *t,
                                                 double *widths,
                                                 size_t capacity,
                                                 size_t *count);

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
deldrift_status deldrift_research_standard_delimiter(const deldrift_triangulation *t,
                                                     uint32_t cell,
                                                     uint32_t corner,
                                                     double *centre,
                                                     double *radius,
                                                     double *tolerance);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_RESEARCH_H
