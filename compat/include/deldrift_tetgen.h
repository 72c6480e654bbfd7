// TetGen's calling convention, as far as deldrift serves it: for programs that call TetGen as a library and have no
// tetgen.h of their own. compat/README.md says which switches are served, and by whom.
//
// The layout is that of TetGen 1.5.0, of 392 bytes. Fields are named as there. Programs with the header of TetGen 1.5.1
// or 1.6 keep that one: their layouts are served as well. Arrays that the function makes come from new[]; a tetgenio
// deletes its own.
#ifndef DELDRIFT_TETGEN_H
#define DELDRIFT_TETGEN_H

class tetgenio {
public:
    struct polygon {
        int *vertexlist;
        int numberofvertices;
    };
    struct facet {
        polygon *polygonlist;
        int numberofpolygons;
        double *holelist;
        int numberofholes;
    };
    // An edge of the Voronoi diagram, dual to a face: from Voronoi vertex v1 to v2, or, if that is -1, to infinity in
    // the direction of the unit vector vnormal.
    struct voroedge {
        int v1, v2;
        double vnormal[3];
    };
    // A facet of the Voronoi diagram, dual to an edge: between the Voronoi cells c1 and c2. elist has the number of
    // its Voronoi edges, then these.
    struct vorofacet {
        int c1, c2;
        int *elist;
    };
    struct pointparam {
        double uv[2];
        int tag;
        int type;
    };

    int firstnumber = 0; // of points and everything else: 0 or 1
    int mesh_dim = 3;
    int useindex = 1;

    double *pointlist = nullptr; // x, y and z of each point
    double *pointattributelist = nullptr;
    double *pointmtrlist = nullptr;
    int *pointmarkerlist = nullptr;
    pointparam *pointparamlist = nullptr;
    int numberofpoints = 0;
    int numberofpointattributes = 0;
    int numberofpointmtrs = 0;

    int *tetrahedronlist = nullptr; // four corners each
    double *tetrahedronattributelist = nullptr;
    double *tetrahedronvolumelist = nullptr;
    int *neighborlist = nullptr; // entry i: the tetrahedron opposite corner i, -1 on the hull
    int numberoftetrahedra = 0;
    int numberofcorners = 4;
    int numberoftetrahedronattributes = 0;

    facet *facetlist = nullptr;
    int *facetmarkerlist = nullptr;
    int numberoffacets = 0;

    double *holelist = nullptr;
    int numberofholes = 0;

    double *regionlist = nullptr;
    int numberofregions = 0;

    double *facetconstraintlist = nullptr;
    int numberoffacetconstraints = 0;

    double *segmentconstraintlist = nullptr;
    int numberofsegmentconstraints = 0;

    int *trifacelist = nullptr; // three corners each
    int *trifacemarkerlist = nullptr;
    int *o2facelist = nullptr;
    int *adjtetlist = nullptr;
    int numberoftrifaces = 0;

    int *edgelist = nullptr; // two ends each
    int *edgemarkerlist = nullptr;
    int *o2edgelist = nullptr;
    int *edgeadjtetlist = nullptr;
    int numberofedges = 0;

    double *vpointlist = nullptr; // Voronoi vertices: the circumcentre of each tetrahedron
    voroedge *vedgelist = nullptr;
    vorofacet *vfacetlist = nullptr;
    int **vcelllist = nullptr; // for each point the number of its Voronoi facets, then these
    int numberofvpoints = 0;
    int numberofvedges = 0;
    int numberofvfacets = 0;
    int numberofvcells = 0;

    void *geomhandle = nullptr;
    double (*getvertexparamonedge)(void *, int, int) = nullptr;
    void (*getsteineronedge)(void *, int, double, double *) = nullptr;
    void (*getvertexparamonface)(void *, int, int, double *) = nullptr;
    void (*getedgesteinerparamonface)(void *, int, double, int, double *) = nullptr;
    void (*getsteineronface)(void *, int, double *, double *) = nullptr;

    bool (*tetunsuitable)(double *, double *, double *, double *, double *, double) = nullptr;

    tetgenio() = default;
    tetgenio(const tetgenio &) = delete;
    tetgenio &operator=(const tetgenio &) = delete;
    ~tetgenio() { deinitialize(); }

    // Deletes every array. A program whose arrays are not from new[] sets these to NULL before.
    void deinitialize() {
        delete[] pointlist;
        delete[] pointattributelist;
        delete[] pointmtrlist;
        delete[] pointmarkerlist;
        delete[] pointparamlist;
        delete[] tetrahedronlist;
        delete[] tetrahedronattributelist;
        delete[] tetrahedronvolumelist;
        delete[] neighborlist;
        delete_facets();
        delete[] holelist;
        delete[] regionlist;
        delete[] facetconstraintlist;
        delete[] segmentconstraintlist;
        delete[] trifacelist;
        delete[] trifacemarkerlist;
        delete[] o2facelist;
        delete[] adjtetlist;
        delete[] edgelist;
        delete[] edgemarkerlist;
        delete[] o2edgelist;
        delete[] edgeadjtetlist;
        delete_voronoi();
    }

private:
    void delete_facets() {
        for (int i = 0; facetlist != nullptr && i < numberoffacets; i++) {
            for (int j = 0; j < facetlist[i].numberofpolygons; j++) delete[] facetlist[i].polygonlist[j].vertexlist;
            delete[] facetlist[i].polygonlist;
            delete[] facetlist[i].holelist;
        }
        delete[] facetlist;
        delete[] facetmarkerlist;
    }
    void delete_voronoi() {
        delete[] vpointlist;
        delete[] vedgelist;
        for (int i = 0; vfacetlist != nullptr && i < numberofvfacets; i++) delete[] vfacetlist[i].elist;
        delete[] vfacetlist;
        for (int i = 0; vcelllist != nullptr && i < numberofvcells; i++) delete[] vcelllist[i];
        delete[] vcelllist;
    }
};

// Throws an int if it fails, as TetGen does: 1 without memory, 2 for a defect, 10 for input or switches that cannot be
// served.
void tetrahedralize(char *switches, tetgenio *in, tetgenio *out, tetgenio *addin = nullptr, tetgenio *bgmin = nullptr);

#endif
