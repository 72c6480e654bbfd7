#include "tetgen_behavior.hpp"

#include <cstddef>
#include <cstring>

namespace compat {

// The switch of each number at the beginning of TetGen 1.5.0's structure, all of which are 0 by default but for the order
// of sorting, b, which makes no difference. Behind them are the parameters of switches: of w, and of o.
static constexpr char letters[] = "psrqYRwblLmaaADidcMMXXzfenvgkBNEFIJRCQV";
static constexpr std::size_t n_letters = sizeof letters - 1, place_of_heights = 45, place_of_order = 53;
static_assert(n_letters == 39);

std::string switches_of_behavior(const void *behavior) {
    int numbers[place_of_order + 1];
    std::memcpy(numbers, behavior, sizeof numbers);
    std::string switches;
    for (std::size_t i = 0; i < n_letters; i++) {
        if (letters[i] == 'b') continue;
        // Some switches ask for more if they are given twice.
        if (numbers[i] != 0) switches += letters[i];
        if (numbers[i] > 1) switches += letters[i];
        if (letters[i] == 'w' && numbers[i] != 0 && numbers[place_of_heights] != 0) switches += '1';
    }
    if (numbers[place_of_order] != 1) switches += 'o';
    return switches;
}

} // namespace compat
