// What is read of the triangulation behind cgal.hpp, and kept until it changes: see there.
#ifndef DELDRIFT_CGAL_READING_HPP
#define DELDRIFT_CGAL_READING_HPP

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "../../deldrift.hpp"
#include "hidden.hpp"

namespace deldrift::cgal::detail {

// Each list is made when it is first asked for, by any thread.
template <std::uint32_t D, class Face_info>
class Reading {
public:
    const Triangulation &triangulation() const noexcept { return t_; }
    Triangulation &triangulation() noexcept { return t_; }

    // The arrays of the cells, from any number of threads.
    const deldrift_cells_view &cells() const {
        if (!is_fresh_.load(std::memory_order_acquire)) {
            const std::lock_guard<std::mutex> lock(mutex_);
            // Unless another thread has been here; then it may be reading them.
            if (!is_fresh_.load(std::memory_order_relaxed)) require_ok(deldrift_cells(t_.native(), &cells_));
            is_fresh_.store(true, std::memory_order_release);
        }
        return cells_;
    }
    // Cells around a vertex; those of most have room in place.
    class Star {
    public:
        Star(const Reading &of, std::uint32_t vertex) {
            if (const Lists *all = of.all_stars()) {
                const auto cells = all->of_vertex(vertex);
                first_ = cells.data();
                n_ = cells.size();
                return;
            }
            deldrift_status status = deldrift_star(of.t_.native(), vertex, few_, room, &n_);
            if (status == DELDRIFT_BUFFER_TOO_SMALL) {
                many_.resize(n_);
                first_ = many_.data();
                status = deldrift_star(of.t_.native(), vertex, many_.data(), n_, &n_);
            }
            require_ok(status);
        }
        Star(const Star &) = delete;
        Star &operator=(const Star &) = delete;
        const std::uint32_t *begin() const noexcept { return first_; }
        const std::uint32_t *end() const noexcept { return first_ + n_; }
        std::size_t size() const noexcept { return n_; }

    private:
        static constexpr std::size_t room = 64;
        std::uint32_t few_[room];
        std::vector<std::uint32_t> many_{};
        const std::uint32_t *first_ = few_;
        std::size_t n_ = 0;
    };

    // The segment at the edge opposite each corner of each cell, DELDRIFT_NONE where there is none.
    const std::vector<std::uint32_t> &segments_of_cells() const {
        return fresh(has_segments_, segments_, [&] {
            std::size_t n = cells().count;
            segments_.resize(3 * n);
            require_ok(deldrift_segments_of_cells(t_.native(), segments_.data(), n, &n));
        });
    }
    // Why the last change was refused.
    std::vector<deldrift_conflict> conflicts_of_segments() const {
        std::size_t n = 0;
        require_ok(deldrift_segment_conflicts(t_.native(), nullptr, 0, &n));
        std::vector<deldrift_conflict> conflicts(n);
        require_ok(deldrift_segment_conflicts(t_.native(), conflicts.data(), n, &n));
        return conflicts;
    }
    // Of a finite cell, or, with a corner, of the ghost cell opposite it: until the next change.
    Face_info &face_info(std::uint32_t cell, std::uint32_t hull_corner) const {
        auto &infos = fresh(has_face_infos_, face_infos_, [&] {
            face_infos_.clear();
            face_infos_.resize(cells().count * (D + 2));
        });
        return infos[index_of(cell, hull_corner)];
    }
    // Whether it is in the domain of a mesh: until the next change, or as a refinement leaves it.
    bool is_marked(std::uint32_t cell, std::uint32_t hull_corner) const {
        return has_marks() && marks_[index_of(cell, hull_corner)] != 0;
    }
    void mark(std::uint32_t cell, std::uint32_t hull_corner, bool is_inside) const {
        marks()[index_of(cell, hull_corner)] = is_inside ? 1 : 0;
    }
    // Of finite cells first, in their order, then of ghost cells.
    std::vector<std::uint8_t> &marks() const {
        return fresh(has_marks_, marks_, [&] { marks_.assign(cells().count * (D + 2), 0); });
    }
    bool has_marks() const noexcept { return has_marks_.load(std::memory_order_acquire); }
    // Of a regular triangulation: who is hidden.
    const Hidden_ids &hidden() const {
        return fresh(has_hidden_, hidden_, [&] { hidden_ = hidden_ids_of(t_); });
    }

protected:
    explicit Reading(Triangulation t) noexcept : t_(std::move(t)) {}
    Reading(const Reading &) = delete;
    Reading &operator=(const Reading &) = delete;
    ~Reading() = default;

    void changed() noexcept {
        is_fresh_ = false;
        has_segments_ = false;
        has_face_infos_ = false;
        has_marks_ = false;
        has_hidden_ = false;
        has_stars_ = false;
        n_stars_asked_ = 0;
    }
    std::size_t index_of(std::uint32_t cell, std::uint32_t hull_corner) const {
        const bool is_ghost = hull_corner <= D;
        return is_ghost ? cells().count + std::size_t{cell} * (D + 1) + hull_corner : cell;
    }
    // The stars of all vertices, in one pass over the cells, once so many have been asked for since the last change
    // that the program seems to want them all; null before.
    const Lists *all_stars() const {
        if (has_stars_.load(std::memory_order_acquire)) return &stars_;
        if (n_stars_asked_.fetch_add(1, std::memory_order_relaxed) < t_.id_count() / 8) return nullptr;
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!has_stars_.load(std::memory_order_relaxed)) {
            stars_ = t_.vertex_cells();
            has_stars_.store(true, std::memory_order_release);
        }
        return &stars_;
    }

    // What is made once after a change, by any thread.
    template <class List, class Make>
    List &fresh(std::atomic<bool> &is_made, List &list, Make make) const {
        if (!is_made.load(std::memory_order_acquire)) {
            cells();
            const std::lock_guard<std::mutex> lock(mutex_);
            if (!is_made.load(std::memory_order_relaxed)) make();
            is_made.store(true, std::memory_order_release);
        }
        return list;
    }
    static void require_ok(deldrift_status status) {
        if (status != DELDRIFT_OK) throw Error(status);
    }

    Triangulation t_;
    mutable std::mutex mutex_{};
    mutable std::atomic<bool> is_fresh_{false};
    mutable deldrift_cells_view cells_{};
    mutable std::atomic<bool> has_segments_{false};
    mutable std::vector<std::uint32_t> segments_{};
    mutable std::atomic<bool> has_face_infos_{false};
    mutable std::vector<Face_info> face_infos_{};
    mutable std::atomic<bool> has_marks_{false};
    mutable std::vector<std::uint8_t> marks_{};
    mutable std::atomic<bool> has_hidden_{false};
    mutable Hidden_ids hidden_{};
    mutable std::atomic<bool> has_stars_{false};
    mutable std::atomic<std::size_t> n_stars_asked_{0};
    mutable Lists stars_{};
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_READING_HPP
