#include "qhull_library.hpp"

#include <dlfcn.h>

#include <cstring>
#include <map>
#include <mutex>

namespace compat {

// False if it is of another version, or a function is missing.
static bool look_up(void *handle, QhullLibrary &library) {
    const auto *version = static_cast<const char *>(dlsym(handle, "qh_version2"));
    bool is_complete = version != nullptr && std::strcmp(version, DELDRIFT_QHULL_VERSION) == 0;
#define COMPAT_FIND(name)                                                                 \
    library.name = reinterpret_cast<decltype(library.name)>(dlsym(handle, #name));        \
    is_complete = is_complete && library.name != nullptr;
    COMPAT_QHULL_FUNCTIONS(COMPAT_FIND)
#undef COMPAT_FIND
    return is_complete;
}

const QhullLibrary *find_qhull_library(const void *original) {
    // Those that were found stay loaded, so that an address never is that of another library later.
    static std::mutex mutex;
    static std::map<const void *, QhullLibrary> &found = *new std::map<const void *, QhullLibrary>;
    const std::lock_guard lock(mutex);
    if (const auto known = found.find(original); known != found.end()) return &known->second;
    Dl_info module;
    if (dladdr(original, &module) == 0 || module.dli_fname == nullptr) return nullptr;
    void *handle = dlopen(module.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) return nullptr;
    QhullLibrary library;
    if (look_up(handle, library)) return &found.emplace(original, library).first->second;
    dlclose(handle);
    return nullptr;
}

} // namespace compat
