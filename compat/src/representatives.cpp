#include "representatives.hpp"

namespace compat {

std::vector<std::uint32_t> representatives(const deldrift_triangulation *t, std::size_t n_points) {
    deldrift_commit_report sums{};
    if (deldrift_statistics(t, &sums) != DELDRIFT_OK || sums.coincident == 0) return {};
    std::vector<std::uint32_t> result(n_points);
    for (std::size_t i = 0; i < n_points; i++) {
        result[i] = static_cast<std::uint32_t>(i);
        deldrift_coincident_representative(t, result[i], &result[i]);
    }
    return result;
}

} // namespace compat
