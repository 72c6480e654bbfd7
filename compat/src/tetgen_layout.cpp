#include "tetgen_layout.hpp"

#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

#include "settings.hpp"

namespace compat {

namespace {

// The lists that TetGen makes for the switches in TetgenSwitches::for_cells.
template <class Io>
void delete_lists(Io &io) {
    for (double *list : {io.pointlist, io.pointattributelist, io.vpointlist}) delete[] list;
    for (int *list : {io.pointmarkerlist, io.tetrahedronlist, io.neighborlist, io.trifacelist, io.trifacemarkerlist,
                      io.edgelist, io.edgemarkerlist})
        delete[] list;
    delete[] io.vedgelist;
    for (int i = 0; io.vfacetlist != nullptr && i < io.numberofvfacets; i++) delete[] io.vfacetlist[i].elist;
    delete[] io.vfacetlist;
    for (int i = 0; io.vcelllist != nullptr && i < io.numberofvcells; i++) delete[] io.vcelllist[i];
    delete[] io.vcelllist;
}

int number_at(const void *io, std::size_t offset) {
    int number = 0;
    std::memcpy(&number, static_cast<const char *>(io) + offset, sizeof number);
    return number;
}

// Whether the module that a function is in exports another one.
bool has_beside(const void *function, const char *name) {
    Dl_info module;
    if (dladdr(function, &module) == 0 || module.dli_fname == nullptr) return false;
    void *handle = dlopen(module.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) return false;
    // What is found may be of a library that the module needs.
    void *found = dlsym(handle, name);
    dlclose(handle);
    Dl_info other;
    return found != nullptr && dladdr(found, &other) != 0 && other.dli_fbase == module.dli_fbase;
}

Layout read_environment() {
    const char *value = std::getenv("DELDRIFT_COMPAT_TETGEN");
    if (value == nullptr || *value == '\0') return Layout::v1_5_1_or_1_6;
    if (std::strcmp(value, "1.5.1") == 0) return Layout::v1_5_1;
    if (std::strcmp(value, "1.6") == 0) return Layout::v1_6;
    complain("tetrahedralize", "DELDRIFT_COMPAT_TETGEN is \"%s\": 1.5.1 or 1.6 was expected; taken for not set", value);
    return Layout::v1_5_1_or_1_6;
}

} // namespace

TetgenIo151::~TetgenIo151() { delete_lists(*this); }
TetgenIo16::~TetgenIo16() { delete_lists(*this); }

// The places of the number of corners in the other layouts are in the upper halves of null pointers, but for padding,
// which may be anything: in that of 1.4 the places in 1.5.0 and in 1.6 are. So the places are looked at in this order.
Layout layout_of(const void *io) {
    constexpr std::size_t corners_in_1_4 = 100;
    if (number_at(io, corners_in_1_4) == 4) return Layout::unknown;
    if (number_at(io, offsetof(TetgenIo150, numberofcorners)) == 4) return Layout::v1_5_0;
    if (number_at(io, offsetof(TetgenIo16, numberofcorners)) != 4) return Layout::unknown;
    static const Layout of_environment = read_environment();
    return of_environment;
}

Layout told_apart(const void *original) {
    if (original != nullptr && has_beside(original, "_ZN8tetgenio9load_elemEPc")) return Layout::v1_6;
    if (original != nullptr && has_beside(original, "_ZN8tetgenio9load_nodeEPc")) return Layout::v1_5_1;
    return Layout::v1_5_1_or_1_6;
}

} // namespace compat
