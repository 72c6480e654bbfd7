// Edges in space, and what is around them: see cgal.hpp.
#ifndef DELDRIFT_CGAL_EDGES_HPP
#define DELDRIFT_CGAL_EDGES_HPP

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <type_traits>
#include <utility>

#include "handles.hpp"

namespace deldrift::cgal::detail {

// Three values, as CGAL names them.
template <class First, class Second, class Third>
struct Triple {
    First first{};
    Second second{};
    Third third{};
    Triple() = default;
    Triple(First a, Second b, Third c) : first(a), second(b), third(c) {}
    friend bool operator==(const Triple &a, const Triple &b) noexcept {
        return a.first == b.first && a.second == b.second && a.third == b.third;
    }
    friend bool operator!=(const Triple &a, const Triple &b) noexcept { return !(a == b); }
    friend bool operator<(const Triple &a, const Triple &b) noexcept {
        return std::tie(a.first, a.second, a.third) < std::tie(b.first, b.second, b.third);
    }
};

// For corners i and j, the corner k by which i, j, k and the fourth one, l, are an even permutation: from a cell one
// turns around the edge from i to j, counter-clockwise, through the facet opposite k.
inline int next_around_edge(int i, int j) noexcept {
    static constexpr signed char next[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};
    return next[i][j];
}

// The facet opposite corner i of a cell has three corners, counter-clockwise as seen from corner i: which one is the
// k-th of them, if the lowest is the first?
inline int corner_of_facet(int i, int k) noexcept {
    const int lowest = i == 0 ? 1 : 0;
    // With corner i behind them they are an even permutation.
    const int second = next_around_edge(lowest, i);
    return k == 0 ? lowest : k == 1 ? second : 6 - i - lowest - second;
}

// The cells around the edge from s to t, without an end. At gives what it stands for, from a cell and the corners of s
// and t in it.
template <class Cell_handle, class At>
class Edge_circulator_3 {
    using Vertex_handle = typename Cell_handle::Vertex;

public:
    using value_type = std::decay_t<decltype(std::declval<At>()(std::declval<Cell_handle>(), 0, 0))>;
    using reference = value_type;
    using pointer = arrow<value_type>;
    using difference_type = std::ptrdiff_t;
    using size_type = std::size_t;
    using iterator_category = std::bidirectional_iterator_tag;

    Edge_circulator_3() = default;
    Edge_circulator_3(Vertex_handle s, Vertex_handle t, Cell_handle c) : s_(s), t_(t), c_(c) {}
    value_type operator*() const { return At()(c_, c_.index(s_), c_.index(t_)); }
    pointer operator->() const { return pointer(**this); }
    operator value_type() const { return **this; }
    Edge_circulator_3 &operator++() {
        c_ = c_.neighbor(next_around_edge(c_.index(s_), c_.index(t_)));
        return *this;
    }
    Edge_circulator_3 &operator--() {
        c_ = c_.neighbor(next_around_edge(c_.index(t_), c_.index(s_)));
        return *this;
    }
    Edge_circulator_3 operator++(int) {
        Edge_circulator_3 before = *this;
        ++*this;
        return before;
    }
    Edge_circulator_3 operator--(int) {
        Edge_circulator_3 before = *this;
        --*this;
        return before;
    }
    friend bool operator==(const Edge_circulator_3 &a, const Edge_circulator_3 &b) noexcept { return a.c_ == b.c_; }
    friend bool operator!=(const Edge_circulator_3 &a, const Edge_circulator_3 &b) noexcept { return !(a == b); }
    friend bool operator==(const Edge_circulator_3 &a, std::nullptr_t) noexcept { return a.c_ == nullptr; }
    friend bool operator!=(const Edge_circulator_3 &a, std::nullptr_t) noexcept { return a.c_ != nullptr; }

private:
    Vertex_handle s_, t_;
    Cell_handle c_;
};

struct At_cell {
    template <class Cell_handle>
    Cell_handle operator()(Cell_handle c, int, int) const {
        return c;
    }
};
struct At_facet {
    template <class Cell_handle>
    std::pair<Cell_handle, int> operator()(Cell_handle c, int i, int j) const {
        return {c, next_around_edge(i, j)};
    }
};

// Corners of the six edges of a cell.
inline constexpr int edge_corners[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// Edges of finite cells, each one once: from the cell of the lowest index around it.
template <class Mesh, std::uint32_t D>
struct Finite_edges_3 {
    const Mesh *mesh = nullptr;
    Triple<Cell_handle<Mesh, D>, int, int> operator()(std::size_t k) const {
        return {{mesh, static_cast<std::uint32_t>(k / 6)}, edge_corners[k % 6][0], edge_corners[k % 6][1]};
    }
    bool selects(std::size_t k) const {
        const auto [first, i, j] = (*this)(k);
        Edge_circulator_3<Cell_handle<Mesh, D>, At_cell> around(first.vertex(i), first.vertex(j), first);
        while (*++around != first) {
            const Cell_handle<Mesh, D> c = *around;
            if (!c.is_infinite() && c < first) return false;
        }
        return true;
    }
};

// Edges of finite cells, then those to the infinite vertex: from the lowest ghost cell around.
template <class Mesh, std::uint32_t D>
struct All_edges_3 {
    const Mesh *mesh = nullptr;
    Triple<Cell_handle<Mesh, D>, int, int> operator()(std::size_t k) const {
        const std::size_t n = 6 * mesh->cells().count;
        if (k < n) return Finite_edges_3<Mesh, D>{mesh}(k);
        const auto facet = static_cast<std::uint32_t>((k - n) / 4);
        return {{mesh, facet / 4, facet % 4}, static_cast<int>((k - n) % 4), static_cast<int>(facet % 4)};
    }
    bool selects(std::size_t k) const {
        const std::size_t n = 6 * mesh->cells().count;
        if (k < n) return Finite_edges_3<Mesh, D>{mesh}.selects(k);
        const auto [first, i, infinite] = (*this)(k);
        if (mesh->cells().neighbours[(k - n) / 4] != DELDRIFT_NONE || i == infinite) return false;
        Edge_circulator_3<Cell_handle<Mesh, D>, At_cell> around(first.vertex(i), first.vertex(infinite), first);
        while (*++around != first) {
            if (*around < first) return false;
        }
        return true;
    }
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_EDGES_HPP
