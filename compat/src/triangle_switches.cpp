#include "triangle_switches.hpp"

#include <cctype>
#include <cstring>

namespace compat {

// What neither adds to nor takes from the results here: messages (Q, V, C, h, H), files (I, g), the choice of the
// algorithm (i, F, l), exact arithmetic (X), how segments are inserted (s), limits to the points that refinement adds
// (Y, S), and what is done with holes and regions (O, A), of which there are none.
static constexpr char without_effect[] = "QVChHIgiFlXsYSOA";

// Digits, dashes, braces and spaces are passed over by the original as well.
static bool is_without_effect(char which) {
    return std::strchr(without_effect, which) != nullptr || std::isalpha(static_cast<unsigned char>(which)) == 0;
}

TriangleSwitches::TriangleSwitches(const char *switches) {
    for (const char *each = switches; *each != '\0'; each++) {
        switch (*each) {
        case 'z': zero_based = true; break;
        case 'n': neighbours = true; break;
        case 'e': edges = true; break;
        case 'v': voronoi = true; break;
        case 'p': planar_graph = true; break;
        case 'c': convex = true; break;
        case 'j': jettison = true; break;
        case 'B': markers = false; break;
        case 'N': points = false; break;
        case 'E': triangles = false; break;
        case 'P': segments = false; break;
        default:
            if (!is_without_effect(*each) && unserved == '\0') unserved = *each;
        }
    }
}

const char *TriangleSwitches::unserved_input(const triangulateio &in) const {
    if (!planar_graph) return nullptr;
    if (in.numberofsegments > 0) return "switch p with segments";
    if (in.numberofholes > 0) return "switch p with holes";
    if (in.numberofregions > 0) return "switch p with regions";
    return nullptr;
}

std::string TriangleSwitches::for_cells() const {
    const char *graph = !planar_graph ? "" : convex ? "pc" : "p";
    return std::string("Qzn") + graph + (edges ? "e" : "") + (voronoi ? "v" : "");
}

} // namespace compat
