#include "qhull_options.hpp"

#include <cstring>
#include <string>

namespace compat {

// Options that change how qhull builds, scales and rounds, or what it warns of.
static bool has_no_influence(const std::string &option) {
    for (const char *each : {"Qbb", "Q12", "Qx", "Pp"})
        if (option == each) return true;
    return false;
}

bool read_qhull_command(const char *command, QhullOptions &options) {
    if (command == nullptr) return false;
    if (std::strncmp(command, "qhull ", 6) != 0) return false;
    static constexpr char spaces[] = " \t\n\v\f\r";
    QhullOptions read;
    bool is_delaunay = false, is_triangulated = false;
    for (const char *next = command + 6; *(next += std::strspn(next, spaces)) != '\0';) {
        const std::string word(next, std::strcspn(next, spaces));
        next += word.size();
        if (word == "d") is_delaunay = true;
        else if (word == "Qt") is_triangulated = true;
        else if (word == "Qz") read.has_infinity = true;
        else if (word == "Qc") read.keeps_coplanar = true;
        else if (!has_no_influence(word)) return false;
    }
    options = read;
    return is_delaunay && is_triangulated;
}

} // namespace compat
