#include "tetgen_layout.hpp"

#include <cstring>

namespace compat {

static int number_at(const void *io, std::size_t offset) {
    int number = 0;
    std::memcpy(&number, static_cast<const char *>(io) + offset, sizeof number);
    return number;
}

bool has_layout_of_1_5(const void *io) {
    constexpr std::size_t corners_in_1_4 = 100;
    return number_at(io, corners_in_1_4) != 4 && number_at(io, offsetof(tetgenio, numberofcorners)) == 4;
}

} // namespace compat
