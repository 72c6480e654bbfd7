#include "triangle_switches.hpp"

#include <cctype>
#include <cstring>
#include <utility>

namespace compat {

// What neither adds to nor takes from the results here: messages (Q, V, C, h, H), files (I, g), the choice of the
// algorithm (i, F, l), exact arithmetic (X), and limits to the points that refinement adds (Y, S).
static constexpr char without_effect[] = "QVChHIgiFlXYS";

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
        case 'A': regions = true; break;
        case 'O': holes = false; break;
        case 's': conforming = true; break;
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
    return planar_graph && conforming && in.numberofsegments > 0 ? "switch s with segments" : nullptr;
}

std::string TriangleSwitches::for_cells() const {
    std::string result = "Qzn";
    for (const auto &[is_given, which] : {std::pair{planar_graph, 'p'}, {convex, 'c'}, {regions, 'A'}, {!holes, 'O'},
                                          {edges, 'e'}, {voronoi, 'v'}})
        if (is_given) result += which;
    return result;
}

} // namespace compat
