#include "qhull_library.hpp"

#include <dlfcn.h>

#include <cstring>

namespace compat {

bool find_qhull_library(const void *original, QhullLibrary &library) {
    Dl_info module;
    if (dladdr(original, &module) == 0 || module.dli_fname == nullptr) return false;
    void *handle = dlopen(module.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) return false;
    const auto *version = static_cast<const char *>(dlsym(handle, "qh_version2"));
    bool is_complete = version != nullptr && std::strcmp(version, DELDRIFT_QHULL_VERSION) == 0;
#define COMPAT_FIND(name)                                                                 \
    library.name = reinterpret_cast<decltype(library.name)>(dlsym(handle, #name));        \
    is_complete = is_complete && library.name != nullptr;
    COMPAT_QHULL_FUNCTIONS(COMPAT_FIND)
#undef COMPAT_FIND
    dlclose(handle);
    return is_complete;
}

} // namespace compat
