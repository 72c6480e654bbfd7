// The command that programs give to qhull.
#pragma once

namespace compat {

// What a command for a Delaunay triangulation asks for.
struct QhullOptions {
    bool has_infinity = false; // Qz: a point at infinity, to which all facets of the hull are joined
    bool keeps_coplanar = false; // Qc: points that are not vertices are listed with a facet
};

// Whether the command can be served; then options are filled in. It can if it is for the triangulation of points
// ("qhull d", with Qt for simplices) and every other option is without influence on the cells.
bool read_qhull_command(const char *command, QhullOptions &options);

} // namespace compat
