// The vertices that are present: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_VERTICES_HPP
#define DELDRIFT_VERTICES_HPP

#include <cstddef>
#include <cstdint>

#include "iterators.hpp"

namespace deldrift {

// The ids of vertices that are present, in ascending order, until one is inserted or removed.
class Vertices {
public:
    struct Ids {
        // Null if all are present.
        const deldrift_triangulation *t = nullptr;
        std::uint32_t operator()(std::size_t id) const noexcept { return static_cast<std::uint32_t>(id); }
        bool selects(std::size_t id) const {
            if (t == nullptr) return true;
            bool is_present = false;
            const deldrift_status status = deldrift_is_present(t, (*this)(id), &is_present);
            if (status != DELDRIFT_OK) throw Error(status);
            return is_present;
        }
    };
    using iterator = selecting_iterator<Ids>;
    using const_iterator = iterator;
    using value_type = std::uint32_t;

    Vertices(const deldrift_triangulation *t, std::size_t id_count, std::size_t vertex_count) noexcept
        : ids_{id_count == vertex_count ? nullptr : t}, id_count_(id_count), size_(vertex_count) {}
    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    iterator begin() const { return {ids_, 0, id_count_}; }
    iterator end() const { return {ids_, id_count_, id_count_}; }

private:
    Ids ids_;
    std::size_t id_count_, size_;
};

}  // namespace deldrift

#ifdef __cpp_lib_ranges
template <>
inline constexpr bool std::ranges::enable_borrowed_range<deldrift::Vertices> = true;
template <>
inline constexpr bool std::ranges::enable_view<deldrift::Vertices> = true;
#endif

#endif  // DELDRIFT_VERTICES_HPP
