#include "representatives.hpp"

#include <new>
#include <numeric>

namespace compat {

// Whether a question has an answer; with weights it may lack memory.
static bool is_answered(deldrift_status status) {
    if (status == DELDRIFT_OUT_OF_MEMORY) throw std::bad_alloc();
    return status == DELDRIFT_OK;
}

std::vector<std::uint32_t> representatives(const deldrift_triangulation *t, std::size_t n_points) {
    std::size_t n = 0;
    if (!is_answered(deldrift_hidden_vertices(t, nullptr, nullptr, 0, &n)) || n == 0) return {};
    std::vector<std::uint32_t> vertices(n), shown(n), result(n_points), hidden;
    is_answered(deldrift_hidden_vertices(t, vertices.data(), shown.data(), n, &n));
    std::iota(result.begin(), result.end(), 0);
    for (std::size_t k = 0; k < n; k++) result[vertices[k]] = shown[k];
    // Those of which the place is hidden: without weights there are none.
    if (!is_answered(deldrift_hidden_by_weight(t, nullptr, nullptr, 0, &n))) return result;
    hidden.resize(n);
    is_answered(deldrift_hidden_by_weight(t, hidden.data(), nullptr, n, &n));
    std::vector<bool> is_hidden(n_points);
    for (const std::uint32_t v : hidden) is_hidden[v] = true;
    for (std::size_t i = 0; i < n_points; i++)
        if (is_hidden[result[i]]) result[i] = static_cast<std::uint32_t>(i);
    return result;
}

} // namespace compat
