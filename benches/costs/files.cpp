// Calls that save, load, copy and write.
#include "measure.hpp"

namespace costs {
namespace {

std::vector<char> saved(Context &c) {
    std::size_t size;
    must(deldrift_save(c.t, nullptr, 0, &size));
    std::vector<char> data(size);
    must(deldrift_save(c.t, data.data(), size, &size));
    return data;
}

template <typename One>
void whole(Context &c, One one) {
    c.meter.time([&] { must(one()); });
    c.meter.count(double(c.n + c.cells()));
}

/// Bytes at every so many places are changed, the checksum is not: most are refused at once, none may take long.
void load_damaged(Context &c) {
    std::vector<char> data = saved(c);
    const deldrift_options options = c.options();
    for (std::size_t i = 1; i < 8; ++i) {
        deldrift_triangulation *other;
        data[data.size() / 8 * i] = char(data[data.size() / 8 * i] ^ 1);
        c.meter.time([&] { deldrift_load(data.data(), data.size(), &options, &other); });
        data[data.size() / 8 * i] = char(data[data.size() / 8 * i] ^ 1);
    }
    c.meter.count(7 * double(c.n + c.cells()));
}

}  // namespace

std::vector<Call> file_calls() {
    return {
        {"deldrift_clone", "", [](Context &c) {
             deldrift_triangulation *other;
             whole(c, [&] { return deldrift_clone(c.t, &other); });
         }},
        {"deldrift_save", "", [](Context &c) {
             std::vector<char> data = saved(c);
             std::size_t size;
             whole(c, [&] { return deldrift_save(c.t, data.data(), data.size(), &size); });
         }},
        {"deldrift_load", "", [](Context &c) {
             const std::vector<char> data = saved(c);
             const deldrift_options options = c.options();
             deldrift_triangulation *other;
             whole(c, [&] { return deldrift_load(data.data(), data.size(), &options, &other); });
         }},
        {"deldrift_load", "damaged, seven times", load_damaged},
        {"deldrift_save_file", "", [](Context &c) {
             const std::string path = c.folder + "/saved.deldrift";
             whole(c, [&] { return deldrift_save_file(c.t, path.c_str()); });
         }},
        {"deldrift_load_file", "", [](Context &c) {
             const std::string path = c.folder + "/loaded.deldrift";
             must(deldrift_save_file(c.t, path.c_str()));
             const deldrift_options options = c.options();
             deldrift_triangulation *other;
             whole(c, [&] { return deldrift_load_file(path.c_str(), &options, &other); });
         }},
        {"deldrift_write_vtu", "", [](Context &c) {
             const std::string path = c.folder + "/written.vtu";
             whole(c, [&] { return deldrift_write_vtu(c.t, path.c_str(), nullptr, 0, nullptr, 0); });
         }},
        {"deldrift_write_medit", "", [](Context &c) {
             const std::string path = c.folder + "/written.mesh";
             whole(c, [&] { return deldrift_write_medit(c.t, path.c_str(), nullptr, 0); });
         }},
    };
}

}  // namespace costs
