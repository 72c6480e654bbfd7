#include "triangle_original.hpp"

#include <cstdlib>
#include <string>
#include <vector>

#include "settings.hpp"

namespace compat {

// Of an output, but for lists that are those of the input.
static void free_lists(const triangulateio &io, const double *holes, const double *regions) {
    for (double *array : {io.pointlist, io.pointattributelist, io.triangleattributelist, io.normlist})
        std::free(array);
    for (int *array : {io.pointmarkerlist, io.trianglelist, io.neighborlist, io.edgelist, io.edgemarkerlist,
                       io.segmentlist, io.segmentmarkerlist})
        std::free(array);
    if (io.holelist != holes) std::free(io.holelist);
    if (io.regionlist != regions) std::free(io.regionlist);
}

bool copies_lists(TriangleFunction function) {
    double points[] = {0, 0, 1, 0, 1, 1, 0, 1}, hole[] = {2, 2}, region[] = {0.5, 0.5, 1, 1};
    int segments[] = {0, 1, 1, 2, 2, 3, 3, 0};
    char switches[] = "Qzp";
    triangulateio in{}, out{}, vorout{};
    in.pointlist = points;
    in.segmentlist = segments;
    in.numberofpoints = in.numberofsegments = 4;
    in.holelist = hole;
    in.regionlist = region;
    in.numberofholes = in.numberofregions = 1;
    function(switches, &in, &out, &vorout);
    const bool are_copies = out.holelist != nullptr && out.holelist != hole;
    free_lists(out, hole, region);
    free_lists(vorout, nullptr, nullptr);
    return are_copies;
}

TriangleOriginal::TriangleOriginal(TriangleFunction function, const TriangleSwitches &switches, const triangulateio &in)
    : switches_(switches), holes_(in.holelist), regions_(in.regionlist) {
    triangulateio given{};
    given.pointlist = in.pointlist;
    given.numberofpoints = in.numberofpoints;
    std::vector<int> ends;
    if (switches.has_segments()) {
        given.pointattributelist = in.pointattributelist;
        given.numberofpointattributes = in.numberofpointattributes;
        given.pointmarkerlist = in.pointmarkerlist;
    }
    if (switches.planar_graph) {
        ends.assign(in.segmentlist, in.segmentlist + std::ptrdiff_t{2} * in.numberofsegments);
        for (int &end : ends) end -= switches.zero_based ? 0 : 1;
        given.segmentlist = ends.data();
        given.segmentmarkerlist = in.segmentmarkerlist;
        given.numberofsegments = in.numberofsegments;
        given.holelist = in.holelist;
        given.numberofholes = in.numberofholes;
        given.regionlist = in.regionlist;
        given.numberofregions = in.numberofregions;
    }
    std::string plain = switches.for_cells();
    const double start = processor_time();
    returned_ = function(plain.data(), &given, &out_, &vorout_);
    seconds_ = processor_time() - start;
}

TriangleOriginal::~TriangleOriginal() {
    free_lists(out_, holes_, regions_);
    free_lists(vorout_, nullptr, nullptr);
}

// int and uint32_t may be used for the same object, and -1 is no_cell.
Cells TriangleOriginal::cells() const {
    return {3, static_cast<std::size_t>(out_.numberoftriangles),
            reinterpret_cast<const std::uint32_t *>(out_.trianglelist),
            reinterpret_cast<const std::uint32_t *>(out_.neighborlist)};
}

Mesh TriangleOriginal::mesh() const {
    Mesh mesh;
    mesh.cells = cells();
    mesh.has_segments = switches_.has_segments();
    if (!mesh.has_segments) return mesh;
    mesh.n_points = static_cast<std::size_t>(out_.numberofpoints);
    mesh.points = out_.pointlist;
    mesh.n_attributes = static_cast<std::size_t>(out_.numberofpointattributes);
    mesh.attributes = out_.pointattributelist;
    mesh.point_markers.assign(out_.pointmarkerlist, out_.pointmarkerlist + out_.numberofpoints);
    for (int i = 0; i < out_.numberofsegments; i++) {
        const int *ends = out_.segmentlist + std::ptrdiff_t{2} * i;
        mesh.segments.add(static_cast<std::uint32_t>(ends[0]), static_cast<std::uint32_t>(ends[1]),
                          out_.segmentmarkerlist[i]);
    }
    find_sides(mesh.cells, mesh.segments);
    mesh.n_holes = static_cast<std::size_t>(out_.numberofholes);
    mesh.n_regions = static_cast<std::size_t>(out_.numberofregions);
    mesh.has_cell_attributes = out_.numberoftriangleattributes > 0;
    if (mesh.has_cell_attributes && out_.numberoftriangles > 0)
        mesh.cell_attributes.assign(out_.triangleattributelist, out_.triangleattributelist + out_.numberoftriangles);
    return mesh;
}

} // namespace compat
