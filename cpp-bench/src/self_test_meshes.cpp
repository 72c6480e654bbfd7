// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes are measured right, outlines have the areas that they are drawn with, and both sides reach the quality.
#include "meshes.hpp"
#include "tests.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace bench {
namespace {

TEST_CASE("areas of outlines") {
    const auto polygon = [](double radius, int n) { return n / 2.0 * radius * radius * std::sin(2 * std::acos(-1) / n); };
    const std::map<std::string, double> areas = {
        {"square", 1}, {"hole", 0.96}, {"slit", 1}, {"L", 0.75}, {"ring", polygon(1, 64) - polygon(0.4, 32)}};
    std::size_t n_known = 0;
    for (const Outline &outline : outlines()) {
        const auto area = areas.find(outline.name);
        if (area == areas.end()) continue;
        CHECK(area_of(outline) == doctest::Approx(area->second).epsilon(1e-14));
        n_known++;
    }
    CHECK(n_known == areas.size());
    Outline outline = stirrer();
    const double area = 4 - 20 * 0.5 * 0.15 * std::sin(2 * std::acos(-1) / 40);
    CHECK(area_of(outline) == doctest::Approx(area).epsilon(1e-14));
    stir(0.7, outline.points);
    CHECK_MESSAGE(area_of(outline) == doctest::Approx(area).epsilon(1e-13), "the hole turns as a whole");
}

TEST_CASE("a mesh is measured") {
    const double p[] = {0, 0}, q[] = {2, 0}, r[] = {0, 2}, s[] = {2, 3};
    Mesh mesh;
    mesh.add({p, q, r});
    CHECK(mesh.least_angle == doctest::Approx(45));
    CHECK(mesh.greatest_length == doctest::Approx(std::sqrt(8)));
    mesh.add({q, s, r});
    CHECK(mesh.n_cells == 2);
    CHECK(mesh.area == doctest::Approx(5));
    CHECK(mesh.greatest_length == doctest::Approx(3));
}

TEST_CASE("meshes of both sides have the quality") {
    Progress progress(Progress::Output::silent);
    const std::vector<MeshLine> lines = measure_meshes({1, 3, 2, {0.2}}, progress);
    CHECK(lines.size() == 2 * outlines().size() + 2);
    for (const MeshLine &line : lines) {
        CHECK(line.reference_seconds > 0);
        CHECK(line.contender_seconds > 0);
        // The letter has angles of its own that are smaller.
        if (line.domain == "letter") continue;
        CHECK_MESSAGE(line.reference.least_angle > line.quality.least_angle - 1e-9, line.domain);
        CHECK_MESSAGE(line.contender.least_angle > line.quality.least_angle - 1e-9, line.domain);
    }
}

}  // namespace
}  // namespace bench
