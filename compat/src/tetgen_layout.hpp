// The layouts of tetgenio. TetGen's versions have different ones under the same function name, and a call does not say
// which it uses.
#pragma once

#include <deldrift_tetgen.h>

#include <cstddef>

namespace compat {

// TetGen 1.5.0: 392 bytes.
using TetgenIo150 = tetgenio;

static_assert(sizeof(TetgenIo150) == 392 && offsetof(TetgenIo150, numberofcorners) == 108, "the layout of 1.5.0");
static_assert(offsetof(TetgenIo150, pointlist) == 16 && offsetof(TetgenIo150, numberofpoints) == 56);
static_assert(offsetof(TetgenIo150, tetrahedronlist) == 72 && offsetof(TetgenIo150, facetlist) == 120);
static_assert(offsetof(TetgenIo150, trifacelist) == 208 && offsetof(TetgenIo150, edgelist) == 248);
static_assert(offsetof(TetgenIo150, vpointlist) == 288 && offsetof(TetgenIo150, geomhandle) == 336);

// TetGen 1.5.1: 424 bytes. More lists say which tetrahedra, faces and edges belong together (switch nn).
struct TetgenIo151 {
    int firstnumber = 0, mesh_dim = 3, useindex = 1;
    double *pointlist = nullptr, *pointattributelist = nullptr, *pointmtrlist = nullptr;
    int *pointmarkerlist = nullptr, *point2tetlist = nullptr;
    tetgenio::pointparam *pointparamlist = nullptr;
    int numberofpoints = 0, numberofpointattributes = 0, numberofpointmtrs = 0;
    int *tetrahedronlist = nullptr;
    double *tetrahedronattributelist = nullptr, *tetrahedronvolumelist = nullptr;
    int *neighborlist = nullptr, *tet2facelist = nullptr, *tet2edgelist = nullptr;
    int numberoftetrahedra = 0, numberofcorners = 4, numberoftetrahedronattributes = 0;
    tetgenio::facet *facetlist = nullptr;
    int *facetmarkerlist = nullptr, numberoffacets = 0;
    double *holelist = nullptr;
    int numberofholes = 0;
    double *regionlist = nullptr;
    int numberofregions = 0;
    double *facetconstraintlist = nullptr;
    int numberoffacetconstraints = 0;
    double *segmentconstraintlist = nullptr;
    int numberofsegmentconstraints = 0;
    int *trifacelist = nullptr, *trifacemarkerlist = nullptr, *o2facelist = nullptr;
    int *face2tetlist = nullptr, *face2edgelist = nullptr, numberoftrifaces = 0;
    int *edgelist = nullptr, *edgemarkerlist = nullptr, *o2edgelist = nullptr, *edge2tetlist = nullptr;
    int numberofedges = 0;
    double *vpointlist = nullptr;
    tetgenio::voroedge *vedgelist = nullptr;
    tetgenio::vorofacet *vfacetlist = nullptr;
    int **vcelllist = nullptr;
    int numberofvpoints = 0, numberofvedges = 0, numberofvfacets = 0, numberofvcells = 0;
    void *geomhandle = nullptr;
    void (*callbacks[6])() = {};

    TetgenIo151() = default;
    TetgenIo151(const TetgenIo151 &) = delete;
    TetgenIo151 &operator=(const TetgenIo151 &) = delete;
    ~TetgenIo151();
};

static_assert(sizeof(TetgenIo151) == 424 && offsetof(TetgenIo151, numberofcorners) == 132, "the layout of 1.5.1");
static_assert(offsetof(TetgenIo151, pointlist) == 16 && offsetof(TetgenIo151, numberofpoints) == 64);
static_assert(offsetof(TetgenIo151, tetrahedronlist) == 80 && offsetof(TetgenIo151, facetlist) == 144);
static_assert(offsetof(TetgenIo151, trifacelist) == 232 && offsetof(TetgenIo151, edgelist) == 280);
static_assert(offsetof(TetgenIo151, vpointlist) == 320 && offsetof(TetgenIo151, geomhandle) == 368);

// TetGen 1.6: 448 bytes. Up to the regions it is that of 1.5.1; a list of tetrahedra to be refined comes next.
struct TetgenIo16 {
    int firstnumber = 0, mesh_dim = 3, useindex = 1;
    double *pointlist = nullptr, *pointattributelist = nullptr, *pointmtrlist = nullptr;
    int *pointmarkerlist = nullptr, *point2tetlist = nullptr;
    tetgenio::pointparam *pointparamlist = nullptr;
    int numberofpoints = 0, numberofpointattributes = 0, numberofpointmtrs = 0;
    int *tetrahedronlist = nullptr;
    double *tetrahedronattributelist = nullptr, *tetrahedronvolumelist = nullptr;
    int *neighborlist = nullptr, *tet2facelist = nullptr, *tet2edgelist = nullptr;
    int numberoftetrahedra = 0, numberofcorners = 4, numberoftetrahedronattributes = 0;
    tetgenio::facet *facetlist = nullptr;
    int *facetmarkerlist = nullptr, numberoffacets = 0;
    double *holelist = nullptr;
    int numberofholes = 0;
    double *regionlist = nullptr;
    int numberofregions = 0;
    int *refine_elem_list = nullptr;
    double *refine_elem_vol_list = nullptr;
    int numberofrefineelems = 0;
    double *facetconstraintlist = nullptr;
    int numberoffacetconstraints = 0;
    double *segmentconstraintlist = nullptr;
    int numberofsegmentconstraints = 0;
    int *trifacelist = nullptr, *trifacemarkerlist = nullptr, *o2facelist = nullptr;
    int *face2tetlist = nullptr, *face2edgelist = nullptr, numberoftrifaces = 0;
    int *edgelist = nullptr, *edgemarkerlist = nullptr, *o2edgelist = nullptr, *edge2tetlist = nullptr;
    int numberofedges = 0;
    double *vpointlist = nullptr;
    tetgenio::voroedge *vedgelist = nullptr;
    tetgenio::vorofacet *vfacetlist = nullptr;
    int **vcelllist = nullptr;
    int numberofvpoints = 0, numberofvedges = 0, numberofvfacets = 0, numberofvcells = 0;
    void *geomhandle = nullptr;
    void (*callbacks[6])() = {};

    TetgenIo16() = default;
    TetgenIo16(const TetgenIo16 &) = delete;
    TetgenIo16 &operator=(const TetgenIo16 &) = delete;
    ~TetgenIo16();
};

static_assert(sizeof(TetgenIo16) == 448 && offsetof(TetgenIo16, numberofcorners) == 132, "the layout of 1.6");
static_assert(offsetof(TetgenIo16, numberofregions) == offsetof(TetgenIo151, numberofregions));
static_assert(offsetof(TetgenIo16, trifacelist) == 256 && offsetof(TetgenIo16, edgelist) == 304);
static_assert(offsetof(TetgenIo16, vpointlist) == 344 && offsetof(TetgenIo16, geomhandle) == 392);

enum class Layout {
    unknown,
    v1_5_0,
    v1_5_1,
    v1_6,
    v1_5_1_or_1_6, // nothing that is in the structure tells them apart
};

// The layout of io, which its constructor has initialised, and nothing else: its number of corners, 4, tells. Of the two
// that nothing in the structure tells apart it is the one that DELDRIFT_COMPAT_TETGEN (1.5.1 or 1.6) says, if it does.
Layout layout_of(const void *io);

// Which of these two it is by the functions beside the original (null: there is none); if they do not say, it is still
// one of the two.
Layout told_apart(const void *original);

} // namespace compat
