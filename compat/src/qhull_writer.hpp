// A triangulation in qhull's structures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "qhull_facets.hpp"
#include "qhull_library.hpp"

namespace compat {

// A call of qh_new_qhull.
struct QhullCall {
    qhT *qh;
    int dimension;
    int n_points;
    coordT *points;
    boolT ismalloc;
    char *command;
    FILE *outfile;
    FILE *errfile;
};

// A point that is no vertex, and a facet that has the vertex at its place.
struct CoplanarPoint {
    std::uint32_t point, facet;
};

struct QhullOutput {
    QhullFacets facets;
    std::vector<CoplanarPoint> coplanar;
    // Room for each point, the one at infinity included, and for each facet.
    std::vector<vertexT *> vertices;
    std::vector<facetT *> made;
};

// Does what qh_new_qhull would have done, by qhull's own functions but for the facets; 0, or qhull's exit code. Where
// it fails qhull has said why, and what there is can be freed.
int write_qhull(const QhullLibrary &library, const QhullCall &call, QhullOutput &output);

// For points that qhull has no message for: writes this one to where qhull would, and gives qhull's exit code for input
// that is wrong. What there is can be freed.
int refuse_call(const QhullLibrary &library, const QhullCall &call, const char *message);

} // namespace compat
