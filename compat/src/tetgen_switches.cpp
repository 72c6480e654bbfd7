#include "tetgen_switches.hpp"

#include <cstring>

namespace compat {

// Messages (Q, V), and exact arithmetic (X).
static constexpr char without_effect[] = "QVX";

// Dashes, braces and spaces are passed over by the original as well. Letters are those of ASCII in any locale.
static bool is_without_effect(char which) {
    const bool is_letter = ('A' <= which && which <= 'Z') || ('a' <= which && which <= 'z');
    const bool is_digit = '0' <= which && which <= '9';
    return std::strchr(without_effect, which) != nullptr || !(is_letter || is_digit);
}

TetgenSwitches::TetgenSwitches(const char *switches) {
    const auto leave = [this](char which) {
        if (unserved == '\0') unserved = which;
    };
    for (const char *each = switches; *each != '\0'; each++) {
        switch (*each) {
        case 'z': zero_based = true; break;
        case 'n':
            // Twice, it asks for the tetrahedra at each face as well.
            if (neighbours) leave('n');
            neighbours = true;
            break;
        case 'f': faces = true; break;
        case 'e': edges = true; break;
        case 'v': voronoi = true; break;
        case 'w':
            weighted = true;
            // With another number the attribute is no weight, but the height of the lifted point.
            if (each[1] == '0') each++;
            else if ('1' <= each[1] && each[1] <= '9') leave('w');
            break;
        case 'J': jettison = false; break;
        case 'B': markers = false; break;
        case 'N':
        case 'I': points = false; break;
        case 'E': tetrahedra = false; break;
        case 'F': any_faces = false; break;
        default:
            if (!is_without_effect(*each)) leave(*each);
        }
    }
}

std::string TetgenSwitches::for_cells() const {
    return std::string("QznJ") + (any_faces ? "" : "F") + (faces ? "f" : "") + (edges ? "e" : "") +
           (voronoi && !weighted ? "v" : "") + (weighted ? "w" : "");
}

} // namespace compat
