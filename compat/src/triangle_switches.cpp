#include "triangle_switches.hpp"

#include <cstdlib>
#include <cstring>
#include <utility>

#include "plain_locale.hpp"

namespace compat {

// What neither adds to nor takes from the results here: messages (Q, V, C, h, H), files (I, g), the choice of the
// algorithm (i, F, l), and exact arithmetic (X).
static constexpr char without_effect[] = "QVChHIgiFlX";
static constexpr double default_angle = 20, greatest_angle = 34;

// Digits, dashes, braces and spaces are passed over by the original as well. Letters are those of ASCII in any locale.
static bool is_without_effect(char which) {
    const bool is_letter = ('A' <= which && which <= 'Z') || ('a' <= which && which <= 'z');
    return std::strchr(without_effect, which) != nullptr || !is_letter;
}

// The number behind a switch, which each is at; empty if there is none.
static std::string number_behind(const char *each) {
    const std::size_t length = std::strspn(each + 1, "0123456789.");
    return std::string(each + 1, length);
}

static double value_of(const std::string &number) {
    const PlainLocale plain;
    return std::strtod(number.c_str(), nullptr);
}

void TriangleSwitches::read_angle(const std::string &number) {
    refines = true;
    least_angle = number.empty() ? default_angle : value_of(number);
    if (!(least_angle <= greatest_angle) && unserved.empty())
        unserved = "switch q" + number + " (angles above 34 degrees)";
}

void TriangleSwitches::read_area(const std::string &number) {
    refines = true;
    if (number.empty()) has_region_areas = true;
    else greatest_area = value_of(number);
    if (!number.empty() && !(greatest_area > 0)) wrong = "switch a" + number + ": an area above 0 was expected";
}

void TriangleSwitches::read_order(const std::string &number) {
    has_middles = number == "2";
    if (!has_middles && !number.empty() && number != "1" && unserved.empty()) unserved = "switch o" + number;
}

TriangleSwitches::TriangleSwitches(const char *switches) {
    for (const char *each = switches; *each != '\0'; each++) {
        switch (*each) {
        case 'q': read_angle(number_behind(each)); break;
        case 'a': read_area(number_behind(each)); break;
        case 'r': reconstructs = true; break;
        case 'o': read_order(number_behind(each)); break;
        case 'D':
        case 'L': refines = conforms = true; break;
        case 'u': refines = asks = true; break;
        case 'Y': n_kept++; break;
        case 'S': limit = std::strtoull(("0" + number_behind(each)).c_str(), nullptr, 10); break;
        case 'z': zero_based = true; break;
        case 'n': neighbours = true; break;
        case 'e': edges = true; break;
        case 'v': voronoi = true; break;
        case 'p': planar_graph = true; break;
        case 'c': convex = true; break;
        case 'A': regions = true; break;
        case 'O': holes = false; break;
        case 's': splits = true; break;
        case 'j': jettison = true; break;
        case 'B': markers = false; break;
        case 'N': points = false; break;
        case 'E': triangles = false; break;
        case 'P': segments = false; break;
        default:
            if (is_without_effect(*each) || !unserved.empty()) break;
            unserved = std::string("switch ") + *each;
            if (*each == 'w' || *each == 'W') unserved += " (weights: regular triangulations are to come)";
        }
    }
}

const char *TriangleSwitches::unserved_input(const triangulateio &in) const {
    if (reconstructs && !refines) return "switch r without q, a, u or D";
    if (reconstructs && in.numberofcorners == 6) return "switch r with triangles of six corners";
    return planar_graph && splits && in.numberofsegments > 0 ? "switch s with segments" : nullptr;
}

std::string TriangleSwitches::for_cells() const {
    std::string result = "Qzn";
    for (const auto &[is_given, which] : {std::pair{planar_graph, 'p'}, {convex, 'c'}, {regions, 'A'}, {!holes, 'O'},
                                          {edges, 'e'}, {voronoi, 'v'}})
        if (is_given) result += which;
    return result;
}

} // namespace compat
