// SPDX-License-Identifier: GPL-3.0-or-later
#include "environment.hpp"

#include <CGAL/version.h>
#include <deldrift.h>
#include <fmt/chrono.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>

namespace bench {
namespace {

std::string processor() {
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);)
        if (line.compare(0, 10, "model name") == 0) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string operating_system() {
    utsname name;
    if (uname(&name) != 0) return "unknown";
    return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

std::string memory() {
    const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return fmt::format("{:.3g} GiB", bytes / (1 << 30));
}

std::string compiler() {
#if defined(__clang__)
    return "Clang " __VERSION__;
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#else
    return "unknown";
#endif
}

/// The wrapper script looks these up, because the program does not know where its sources are.
std::string from_wrapper(const char *variable) {
    const char *value = std::getenv(variable);
    return value && *value ? value : "unknown";
}

}  // namespace

void write_environment(const std::string &path, const std::string &command) {
    std::ofstream file(path);
    file << "date: " << fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))) << '\n'
         << "command: " << command << '\n'
         << "processor: " << processor() << ", " << sysconf(_SC_NPROCESSORS_ONLN) << " online\n"
         << "memory: " << memory() << '\n'
         << "system: " << operating_system() << '\n'
         << "compiler: " << compiler() << ", " << DELDRIFT_BENCH_FLAGS << '\n'
         << "rust compiler: " << from_wrapper("DELDRIFT_BENCH_RUSTC") << '\n'
         << "CGAL: " << CGAL_VERSION_STR << '\n'
         << "deldrift: " << deldrift_version() << '\n'
         << "commit: " << from_wrapper("DELDRIFT_BENCH_COMMIT") << '\n';
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

}  // namespace bench
