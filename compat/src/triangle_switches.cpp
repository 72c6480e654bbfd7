#include "triangle_switches.hpp"

#include <cctype>
#include <cstring>

namespace compat {

// What neither adds to nor takes from the results here: messages (Q, V), what is only about segments and files (P, I),
// the choice of the algorithm (i, F, l), and exact arithmetic (X).
static constexpr char without_effect[] = "QVPIiFlX";

// Dashes, braces and spaces are passed over by the original as well.
static bool is_without_effect(char which) {
    return std::strchr(without_effect, which) != nullptr || std::isalnum(static_cast<unsigned char>(which)) == 0;
}

TriangleSwitches::TriangleSwitches(const char *switches) {
    for (const char *each = switches; *each != '\0'; each++) {
        switch (*each) {
        case 'z': zero_based = true; break;
        case 'n': neighbours = true; break;
        case 'e': edges = true; break;
        case 'v': voronoi = true; break;
        case 'B': markers = false; break;
        case 'N': points = false; break;
        case 'E': triangles = false; break;
        default:
            if (!is_without_effect(*each) && unserved == '\0') unserved = *each;
        }
    }
}

std::string TriangleSwitches::for_cells() const {
    return std::string("Qzn") + (edges ? "e" : "") + (voronoi ? "v" : "");
}

} // namespace compat
