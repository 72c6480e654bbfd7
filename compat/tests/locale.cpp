// Triangle's switches and deldrift's messages have a point in their numbers, in any locale. Arguments: the locale, whose
// numbers have a comma. What is said goes to the standard error stream: first in the locale "C", then in the other one,
// each after a line with its name.
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <clocale>
#include <locale>
#include <string>

#include "check.hpp"

namespace {

// All that a call gives, as numbers.
std::vector<double> result_of(const char *switches) {
    // A square in a square.
    Points points{0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 3, 3, 1, 3};
    std::vector<int> segments{0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
    std::vector<double> hole{2, 2}, region{0.5, 0.5, 7.5, 0.25};
    triangulateio in{}, out{};
    in.pointlist = points.data();
    in.numberofpoints = in.numberofsegments = 8;
    in.segmentlist = segments.data();
    in.holelist = hole.data();
    in.regionlist = region.data();
    in.numberofholes = in.numberofregions = 1;
    std::string text(switches);
    std::vector<double> all{static_cast<double>(triangulate(text.data(), &in, &out, nullptr))};
    all.insert(all.end(), out.pointlist, out.pointlist + 2 * out.numberofpoints);
    all.insert(all.end(), out.trianglelist, out.trianglelist + 3 * out.numberoftriangles);
    for (double *list : {out.pointlist, out.triangleattributelist}) std::free(list);
    for (int *list : {out.trianglelist, out.segmentlist, out.segmentmarkerlist, out.pointmarkerlist}) std::free(list);
    return all;
}

constexpr const char *served[] = {"zQpa1.9", "zQpa0.5", "zQpq20.5", "zQpq33.75a.125", "zQpa.5S100", "zQpAa", "zQpD"};
// The last one has letters that are some in Latin 1 alone, and are passed over.
constexpr const char *refused[] = {"zQpq34.5", "zQpa0.0", "zQpq30.5u", "zQp\xe4\xdf"};

std::vector<std::vector<double>> results() {
    std::vector<std::vector<double>> results;
    for (const char *switches : served) results.push_back(result_of(switches));
    for (const char *switches : refused) results.push_back(result_of(switches));
    // A message with a number that is no integer.
    Points points{0, 0, 1, 0, 0, 1};
    double hole[] = {1.5e58, 2};
    triangulateio in{}, out{};
    in.pointlist = points.data();
    in.numberofpoints = 3;
    in.holelist = hole;
    in.numberofholes = 1;
    char switches[] = "Qzp";
    CHECK(triangulate(switches, &in, &out, nullptr) == 1);
    return results;
}

} // namespace

int main(int count, char **arguments) {
    CHECK(count == 2);
    std::fprintf(stderr, "C\n");
    const std::vector<std::vector<double>> before = results();
    for (std::size_t i = 0; i < std::size(served); i++) CHECK(before[i][0] == 0 && before[i].size() > 16);
    CHECK(before[0] != before[1]);
    CHECK(std::setlocale(LC_ALL, arguments[1]) != nullptr);
    std::locale::global(std::locale(arguments[1]));
    char half[8];
    std::snprintf(half, sizeof half, "%.1f", 0.5);
    CHECK(std::string(half) == "0,5");
    std::fprintf(stderr, "%s\n", arguments[1]);
    CHECK(results() == before);
}
