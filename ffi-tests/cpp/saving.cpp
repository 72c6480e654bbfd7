// Saving, loading and cloning by the wrapper.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deldrift.hpp>
#include <iostream>

#define CHECK(condition)                                                                   \
    do {                                                                                   \
        if (!(condition)) {                                                                \
            std::cerr << __FILE__ << ":" << __LINE__ << ": not so: " << #condition << "\n"; \
            std::exit(1);                                                                  \
        }                                                                                  \
    } while (false)

using deldrift::Triangulation;

static bool are_same(const Triangulation &a, const Triangulation &b) {
    return a.save() == b.save() && a.positions() == b.positions() && a.cell_count() == b.cell_count();
}

template <class Call>
static deldrift_status status_of(Call call) {
    try {
        call();
    } catch (const deldrift::Error &error) {
        return error.status();
    }
    return DELDRIFT_OK;
}

int main() {
    const std::vector<double> square{0, 0, 4, 0, 5, 5, 0, 4, 1, 2};
    Triangulation t(2, square);
    t.move_vertex(4, {2.0, 3.0});
    Triangulation clone = t.clone();
    const Triangulation loaded = Triangulation::load(t.save());
    CHECK(loaded.dimension() == 2 && loaded.staged_count() == 1 && are_same(t, loaded) && are_same(t, clone));
    clone.commit_timestamp();
    CHECK(t.timestamp() == 0 && clone.timestamp() == 1 && !are_same(t, clone));

    deldrift_options options = deldrift::default_options();
    options.algorithm = DELDRIFT_REPAIR;
    std::vector<unsigned char> bytes = clone.save();
    CHECK(Triangulation::load(bytes, options).algorithm() == DELDRIFT_REPAIR);
    bytes.pop_back();
    CHECK(status_of([&] { Triangulation::load(bytes); }) == DELDRIFT_INVALID_DATA);
    CHECK(status_of([&] { Triangulation::load({}); }) == DELDRIFT_INVALID_DATA);

    const char *temporary = std::getenv("TMPDIR");
    std::string path = (temporary == nullptr ? std::string("/tmp") : temporary) + "/deldrift-XXXXXX";
    CHECK(mkdtemp(path.data()) != nullptr);
    const std::string file = path + "/saved", vtu = path + "/cells.vtu", mesh = path + "/cells.mesh";
    clone.save_file(file);
    CHECK(are_same(Triangulation::load_file(file), clone));
    CHECK(Triangulation::load_file(file, options).algorithm() == DELDRIFT_REPAIR);
    const std::vector<double> height{1, 2, 3, 4, 5}, area(2 * clone.cell_count());
    clone.write_vtu(vtu);
    clone.write_vtu(vtu, {{"height", height, 1}}, {{"area", area, 2}});
    CHECK(status_of([&] { clone.write_vtu(vtu, {{"height", height, 2}}); }) == DELDRIFT_WRONG_COUNT);
    CHECK(status_of([&] { clone.write_vtu(vtu, {}, {{"area", height, 2}}); }) == DELDRIFT_WRONG_COUNT);
    clone.write_medit(mesh);
    clone.write_medit(mesh, std::vector<std::int32_t>(clone.cell_count(), -3));
    CHECK(status_of([&] { clone.write_medit(mesh, std::vector<std::int32_t>(1)); }) == DELDRIFT_WRONG_COUNT);
    CHECK(status_of([&] { clone.save_file(file + "/none"); }) == DELDRIFT_IO_ERROR);
    CHECK(status_of([&] { Triangulation::load_file(path); }) == DELDRIFT_IO_ERROR);
    for (const std::string &made : {file, vtu, mesh, path}) CHECK(std::remove(made.c_str()) == 0);
}
