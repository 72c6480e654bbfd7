#include "original.hpp"

#include <dlfcn.h>
#include <link.h>

#include <string>
#include <vector>

namespace compat {

static const void *module_of(const void *address) {
    Dl_info module;
    return dladdr(address, &module) != 0 ? module.dli_fbase : nullptr;
}

// A module that was loaded for itself alone (RTLD_LOCAL), as interpreters load their extensions, is not in the
// loader's global order, so it is asked by its file.
static void *in_module(const char *name, const char *file) {
    void *handle = dlopen(file, RTLD_LAZY | RTLD_NOLOAD);
    if (handle == nullptr) return nullptr;
    void *found = dlsym(handle, name);
    dlclose(handle);
    return found;
}

static std::vector<std::string> modules() {
    std::vector<std::string> files;
    const auto note = [](dl_phdr_info *info, std::size_t, void *to) {
        if (info->dlpi_name != nullptr && *info->dlpi_name != '\0')
            static_cast<std::vector<std::string> *>(to)->emplace_back(info->dlpi_name);
        return 0;
    };
    dl_iterate_phdr(note, &files);
    return files;
}

void *original_of(const char *name, const void *caller) {
    // Of a hidden function, as that of an exported one may be another library's.
    const void *here = module_of(reinterpret_cast<const void *>(&original_of));
    const auto is_other = [here](void *found) { return found != nullptr && module_of(found) != here; };
    Dl_info origin;
    if (dladdr(caller, &origin) != 0 && origin.dli_fname != nullptr)
        if (void *found = in_module(name, origin.dli_fname); is_other(found)) return found;
    if (void *found = dlsym(RTLD_NEXT, name); is_other(found)) return found;
    for (const std::string &file : modules())
        if (void *found = in_module(name, file.c_str()); is_other(found)) return found;
    return nullptr;
}

} // namespace compat
