// Numbers have a point in files and messages, and are read with one, in the locale that DELDRIFT_TEST_LOCALE names, which
// has a comma in its place. Without it the program only sees that texts are alike from one time to the next.
#include <stdlib.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <deldrift/cgal.hpp>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <string>
#include <vector>

#include "check.hpp"

using deldrift::Triangulation;
namespace cgal = deldrift::cgal;

static std::string text_of(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    CHECK(file.good());
    return {std::istreambuf_iterator<char>(file), {}};
}

template <class Call>
static std::string message_of(Call call) {
    try {
        call();
    } catch (const deldrift::Error &error) {
        return error.what() + std::string("\n");
    }
    CHECK(false);
    return {};
}

static std::string messages(Triangulation &t) {
    using Cdt = cgal::Constrained_Delaunay_triangulation_2<cgal::Kernel>;
    using Criteria = cgal::Delaunay_mesh_size_criteria_2<Cdt>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Cdt cdt;
    deldrift::Quality quality;
    quality.least_angle = 34.5;
    std::string said = message_of([&] { cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.375)); });
    CHECK(said.find("0.375") != std::string::npos);
    said += message_of([&] { cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.125, -1234567.5)); });
    said += message_of([&] { t.refine(quality); });
    CHECK(said.find("34.5") != std::string::npos);
    said += message_of([&] { t.move_vertex(0, {1.5e58, 0.5}); });
    said += message_of([&] { t.move_vertex(0, {nan, 0.5}); });
    said += message_of([&] { t.mask_without_flat_cells(-0.5); });
    said += message_of([&] { t.voronoi_volumes({0.5, 0.5}, {0.25, 0.75}); });
    CHECK(said.find(',') == std::string::npos || said.find(", ") != std::string::npos);
    return said;
}

// All that is written with numbers, and what is read again.
static std::string all_texts(const std::string &folder) {
    const std::vector<double> points{0.5, 0.25, 1234567.5, 0.125, 2.75, 1e-9, 0.0625, 1234.5, 1e21, 3.5};
    const std::vector<double> numbers{0.5, 1.25, -1e-7, 1e9, 2.5};
    Triangulation t(2, points);
    const std::string vtu = folder + "/t.vtu", mesh = folder + "/t.mesh", saved = folder + "/t.deldrift";
    t.write_vtu(vtu, {deldrift::Field{"numbers", numbers, 1}});
    t.write_medit(mesh);
    t.save_file(saved);
    CHECK(Triangulation::load_file(saved).save() == t.save());
    const std::string text = text_of(mesh);
    CHECK(text.find("1234567.5") != std::string::npos);
    const std::string all = text_of(vtu) + text + messages(t);
    for (const std::string &path : {vtu, mesh, saved}) CHECK(std::remove(path.c_str()) == 0);
    return all;
}

int main() {
    const char *temporary = std::getenv("TMPDIR"), *name = std::getenv("DELDRIFT_TEST_LOCALE");
    std::string folder = (temporary == nullptr ? std::string("/tmp") : temporary) + "/deldrift-XXXXXX";
    CHECK(mkdtemp(folder.data()) != nullptr);
    const std::string before = all_texts(folder);
    if (name != nullptr) {
        CHECK(std::setlocale(LC_ALL, name) != nullptr);
        std::locale::global(std::locale(name));
        char half[8];
        std::snprintf(half, sizeof half, "%.1f", 0.5);
        CHECK(std::string(half) == "0,5");
    }
    CHECK(all_texts(folder) == before);
    CHECK(std::remove(folder.c_str()) == 0);
}
