// The neighbours of a vertex in space: see cgal.hpp.
#ifndef DELDRIFT_CGAL_LINKS_HPP
#define DELDRIFT_CGAL_LINKS_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "../../deldrift.h"

namespace deldrift::cgal::detail {

// Asks for what is about to be read; cells around a vertex may lie anywhere.
inline void prefetch(const void *place) noexcept {
#ifdef __GNUC__
    __builtin_prefetch(place);
#else
    (void)place;
#endif
}

// The different ids of the corners of a star of few cells, without that of its vertex.
class Few_ids {
public:
    // There are two more corners than cells at most.
    static constexpr std::size_t max_cells = 96;

    explicit Few_ids(std::uint32_t vertex) noexcept {
        std::fill_n(table_, size, DELDRIFT_NONE);
        enter(vertex);
    }
    // Whether an id is new is random, so nothing branches on it.
    void enter(std::uint32_t id) noexcept {
        std::size_t at = id * 2654435769u >> 24;
        while (table_[at] != id && table_[at] != DELDRIFT_NONE) at = (at + 1) % size;
        ids_[n_] = id;
        n_ += table_[at] != id;
        table_[at] = id;
    }
    const std::uint32_t *begin() const noexcept { return ids_ + 1; }
    const std::uint32_t *end() const noexcept { return ids_ + n_; }

private:
    static constexpr std::size_t size = 256;
    std::uint32_t table_[size], ids_[max_cells + 4];
    std::size_t n_ = 0;
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_LINKS_HPP
