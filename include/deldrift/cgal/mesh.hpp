// The triangulation behind cgal.hpp, with the points and infos of its vertices: see there.
#ifndef DELDRIFT_CGAL_MESH_HPP
#define DELDRIFT_CGAL_MESH_HPP

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../deldrift.hpp"
#include "kernel.hpp"
#include "marks.hpp"

namespace deldrift::cgal::detail {

struct No_info {};
template <class Info>
using Info_or_none = std::conditional_t<std::is_void_v<Info>, No_info, Info>;

// What a vertex handle points to. It stays where it is until the vertex is removed.
template <std::uint32_t D, class K, class Info>
class Mesh;
template <std::uint32_t D, class K, class Info>
struct Record {
    typename Coordinates<D, K>::Point point;
    Info_or_none<typename Parts_of<Info>::Vertices> info;
    // Null for one that is not in use, and for the infinite vertex its mesh.
    const Mesh<D, K, Info> *mesh;
    std::uint32_t id;
};

// Points at the same place are one vertex, as in CGAL. Calls that fail have no effect.
template <std::uint32_t D, class K, class Info>
class Mesh {
public:
    using Point = typename Coordinates<D, K>::Point;
    using Numbers = std::array<double, D>;
    using Record = detail::Record<D, K, Info>;
    using Given_info = decltype(Record::info);
    using Face_info = Info_or_none<typename Parts_of<Info>::Faces>;
    using Vertices = std::vector<std::pair<Point, Given_info>>;

    Mesh() : t_(D, Positions(), options()), infinite_{Coordinates<D, K>::point({}), {}, this, DELDRIFT_NONE} {}
    // All is copied, nothing triangulated: vertices have the same ids, cells the same indices, and what is staged is.
    Mesh(const Mesh &other) : t_(other.t_.clone()), infinite_{Coordinates<D, K>::point({}), {}, this, DELDRIFT_NONE} {
        by_id_.reserve(other.by_id_.size());
        for (const Record *record : other.by_id_) {
            if (record != nullptr) records_.push_back(Record{record->point, record->info, this, record->id});
            by_id_.push_back(record == nullptr ? nullptr : &records_.back());
        }
        unused_.reserve(2 * records_.size() + 16);
        staged_.reserve(other.staged_.size());
        for (const auto &[record, p] : other.staged_) staged_.emplace_back(by_id_[record->id], p);
        if (other.has_marks()) {
            marks_ = other.marks_;
            has_marks_ = true;
        }
    }
    Mesh &operator=(const Mesh &) = delete;

    static Numbers numbers_of(const Point &p) { return Coordinates<D, K>::of(p); }

    const Triangulation &triangulation() const noexcept { return t_; }
    Triangulation &triangulation() noexcept { return t_; }
    Record *infinite() const noexcept { return &infinite_; }
    const std::vector<Record *> &by_id() const noexcept { return by_id_; }

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
        Star(const Mesh &mesh, std::uint32_t vertex) {
            if (const Lists *all = mesh.all_stars()) {
                const auto cells = all->of_vertex(vertex);
                first_ = cells.data();
                n_ = cells.size();
                return;
            }
            deldrift_status status = deldrift_star(mesh.t_.native(), vertex, few_, room, &n_);
            if (status == DELDRIFT_BUFFER_TOO_SMALL) {
                many_.resize(n_);
                first_ = many_.data();
                status = deldrift_star(mesh.t_.native(), vertex, many_.data(), n_, &n_);
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

    // The vertex at a place; null where there is none.
    Record *nearest(const Point &p) const {
        const std::uint32_t id = t_.nearest_vertex(numbers_of(p));
        return id == DELDRIFT_NONE ? nullptr : by_id_[id];
    }

    Record *insert(const Point &p, Given_info info) {
        Record *record = add(p, std::move(info));
        std::uint32_t id = 0;
        const deldrift_status status = deldrift_insert_vertex(t_.native(), numbers_of(p).data(), &id);
        if (status != DELDRIFT_OK) drop_last();
        if (status == DELDRIFT_COINCIDENT) return nearest(p);
        require_ok(status);
        changed();
        return record;
    }

    // All at once; one vertex for each place. Where there are moves to be committed, one after the other.
    void insert(Vertices vertices) {
        if (t_.staged_count() > 0) {
            for (auto &[p, info] : vertices) insert(p, std::move(info));
        } else if (!insert_at_once(vertices, {})) {
            const std::vector<std::size_t> different = different_places(vertices);
            if (!different.empty()) insert_at_once(vertices, different);
        }
    }

    void remove(Record *record) {
        t_.remove_vertex(record->id);
        changed();
        forget(record);
        // Ids of removed vertices take memory; where there is none to compact them, the next removal tries again.
        try {
            if (by_id_.size() > 2 * t_.vertex_count() + 1024) compact();
        } catch (const Error &) {
        } catch (const std::bad_alloc &) {
        }
    }

    // The vertex at the place: this one, or one that is there already; then nothing has changed.
    Record *move_if_free(Record *record, const Point &p) {
        const deldrift_status status = deldrift_relocate_vertex(t_.native(), record->id, numbers_of(p).data());
        if (status == DELDRIFT_COINCIDENT) return nearest(p);
        require_ok(status);
        changed();
        record->point = p;
        return record;
    }

    void stage_move(Record *record, const Point &p) {
        staged_.emplace_back(record, p);
        const deldrift_status status = deldrift_move_vertex(t_.native(), record->id, numbers_of(p).data());
        if (status != DELDRIFT_OK) staged_.pop_back();
        require_ok(status);
    }
    void discard_moves() {
        t_.discard_moves();
        staged_.clear();
    }

    // New segments between vertices, and the removal of others. What else is staged waits. first: receives the id that
    // the first new one has, or would have if there were no conflicts.
    void exchange_segments(const std::vector<std::array<Record *, 2>> &ends,
                           const std::vector<std::uint32_t> &removals, std::uint32_t &first) {
        commit_alone([&] {
            first = stage_segments(ends);
            t_.stage_segment_removals(removals);
        });
    }
    // New segments, of which pieces come, as of those that they cross: with new vertices there, rounded. first: receives the
    // id from which on all have theirs.
    void insert_split_segments(const std::vector<std::array<Record *, 2>> &ends, std::uint32_t &first) {
        deldrift_split_report split{};
        const std::size_t n_before = by_id_.size();
        try {
            commit_alone([&] {
                first = stage_segments(ends);
                split = t_.stage_splits();
                for (std::uint64_t k = 0; k < split.inserted; k++) add(Coordinates<D, K>::point({}), {});
            });
        } catch (...) {
            while (by_id_.size() > n_before) drop_last();
            throw;
        }
        for (std::size_t id = n_before; id < by_id_.size(); id++) {
            by_id_[id]->point = Coordinates<D, K>::point(t_.position<D>(static_cast<std::uint32_t>(id)));
        }
    }
    // New vertices, new segments, of which these may be ends, by ids, and the removal of other segments. The id of the first
    // segment.
    std::uint32_t divide(const std::vector<Point> &points, const std::vector<Ends> &ends,
                         const std::vector<std::uint32_t> &removals) {
        const std::size_t n_before = by_id_.size();
        std::uint32_t first = 0;
        try {
            std::vector<Numbers> places;
            for (const Point &p : points) {
                add(p, {});
                places.push_back(numbers_of(p));
            }
            commit_alone([&] {
                t_.stage_insertions(places);
                first = t_.stage_segments(ends);
                t_.stage_segment_removals(removals);
            });
        } catch (...) {
            while (by_id_.size() > n_before) drop_last();
            throw;
        }
        return first;
    }
    // A vertex on a segment, of which two come to be; and the id of the first.
    std::pair<Record *, std::uint32_t> split_segment(const Point &p, const std::array<Record *, 2> &ends,
                                                     std::uint32_t segment) {
        const auto id = static_cast<std::uint32_t>(by_id_.size());
        const std::uint32_t first = divide({p}, {{ends[0]->id, id}, {id, ends[1]->id}}, {segment});
        return {by_id_[id], first};
    }
    // Refines the cells that are marked, in a copy that takes the place of the triangulation when nothing can fail any more.
    // keep: called before that with the copy, when by_id() has the new vertices already.
    template <class Keep>
    void refine(const Quality &quality, Keep keep) {
        Triangulation refined = t_.clone();
        refined.discard_moves();
        const std::vector<std::uint8_t> &before = marks();
        const auto report = refined.refine(quality, span<const std::uint8_t>(before.data(), cells().count));
        if (report.inserted == 0) return;
        std::vector<std::uint8_t> after = marks_after(t_, before, refined);
        after.resize(refined.cell_count() * (D + 2));
        stage_moves_of(refined);
        const std::size_t n_before = by_id_.size();
        try {
            for (std::size_t id = n_before; id < refined.id_count(); id++) {
                add(Coordinates<D, K>::point(refined.position<D>(static_cast<std::uint32_t>(id))), {});
            }
            keep(refined);
        } catch (...) {
            while (by_id_.size() > n_before) drop_last();
            throw;
        }
        t_ = std::move(refined);
        changed();
        marks_.swap(after);
        has_marks_ = true;
    }
    // Why the last change was refused.
    std::vector<deldrift_conflict> conflicts_of_segments() const {
        std::size_t n = 0;
        require_ok(deldrift_segment_conflicts(t_.native(), nullptr, 0, &n));
        std::vector<deldrift_conflict> conflicts(n);
        require_ok(deldrift_segment_conflicts(t_.native(), conflicts.data(), n, &n));
        return conflicts;
    }
    deldrift_commit_report commit_timestamp() {
        const deldrift_commit_report report = t_.commit_timestamp();
        changed();
        for (auto &[record, p] : staged_) record->point = p;
        staged_.clear();
        return report;
    }

private:
    void changed() noexcept {
        is_fresh_ = false;
        has_segments_ = false;
        has_face_infos_ = false;
        has_marks_ = false;
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
        if (n_stars_asked_.fetch_add(1, std::memory_order_relaxed) < by_id_.size() / 8) return nullptr;
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

    std::uint32_t stage_segments(const std::vector<std::array<Record *, 2>> &ends) {
        std::vector<Ends> ids;
        for (const auto &[a, b] : ends) ids.push_back({a->id, b->id});
        return t_.stage_segments(ids);
    }
    // Commits what `stage` stages. Moves that wait are taken back before, and staged again.
    template <class Stage>
    void commit_alone(Stage stage) {
        t_.discard_moves();
        try {
            stage();
            t_.commit_timestamp();
        } catch (...) {
            t_.discard_moves();
            stage_again();
            throw;
        }
        changed();
        stage_again();
    }
    void stage_again() { stage_moves_of(t_); }
    void stage_moves_of(Triangulation &t) const {
        for (const auto &[record, p] : staged_) {
            require_ok(deldrift_move_vertex(t.native(), record->id, numbers_of(p).data()));
        }
    }

    static deldrift_options options() noexcept {
        deldrift_options options = default_options();
        options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
        return options;
    }
    static void require_ok(deldrift_status status) {
        if (status != DELDRIFT_OK) throw Error(status);
    }

    // A record for the next id. Points and infos whose assignment throws leave nothing behind.
    Record *add(const Point &p, Given_info info) {
        const auto id = static_cast<std::uint32_t>(by_id_.size());
        if (unused_.empty()) {
            // Room for all, so that none is lost when it is forgotten.
            if (unused_.capacity() <= records_.size()) unused_.reserve(2 * records_.size() + 16);
            records_.push_back(Record{p, {}, nullptr, id});
            unused_.push_back(&records_.back());
        }
        Record *record = unused_.back();
        if (by_id_.size() == by_id_.capacity()) by_id_.reserve(2 * by_id_.size() + 16);
        record->point = p;
        record->info = std::move(info);
        record->mesh = this;
        record->id = id;
        by_id_.push_back(record);
        unused_.pop_back();
        return record;
    }
    void forget(Record *record) noexcept {
        by_id_[record->id] = nullptr;
        record->mesh = nullptr;
        staged_.erase(std::remove_if(staged_.begin(), staged_.end(), [&](const auto &s) { return s.first == record; }),
                      staged_.end());
        unused_.push_back(record);
    }
    void drop_last() noexcept {
        Record *record = by_id_.back();
        by_id_.pop_back();
        record->mesh = nullptr;
        unused_.push_back(record);
    }

    // Infos are moved to their vertices when nothing can fail any more; those whose assignment may throw are copied
    // before.
    static constexpr bool moves_infos =
        std::is_nothrow_move_assignable_v<Given_info> || !std::is_copy_constructible_v<Given_info>;

    // Whether that could be done: not if two are at the same place; then the vertices have their infos still. Those of
    // the given indices; none for all.
    bool insert_at_once(Vertices &vertices, const std::vector<std::size_t> &which) {
        const auto index = [&which](std::size_t i) { return which.empty() ? i : which[i]; };
        const std::size_t n = which.empty() ? vertices.size() : which.size(), n_before = by_id_.size();
        std::vector<std::array<double, D>> places;
        places.reserve(n);
        try {
            for (std::size_t i = 0; i < n; i++) {
                const auto &[p, info] = vertices[index(i)];
                if constexpr (moves_infos) {
                    add(p, {});
                } else {
                    add(p, info);
                }
                places.push_back(numbers_of(p));
            }
            if (t_.id_count() == 0) {
                t_ = Triangulation(D, places, options());
            } else {
                t_.stage_insertions(places);
                t_.commit_timestamp();
            }
        } catch (const Error &error) {
            undo_insertions(n_before);
            if (error.status() == DELDRIFT_COINCIDENT) return false;
            throw;
        } catch (...) {
            undo_insertions(n_before);
            throw;
        }
        changed();
        if constexpr (moves_infos) {
            for (std::size_t i = 0; i < n; i++) by_id_[n_before + i]->info = std::move(vertices[index(i)].second);
        }
        return true;
    }
    void undo_insertions(std::size_t n_before) {
        t_.discard_moves();
        while (by_id_.size() > n_before) drop_last();
    }

    // One index for each place at which there is no vertex yet.
    std::vector<std::size_t> different_places(const Vertices &vertices) const {
        const auto place = [&](std::size_t i) { return numbers_of(vertices[i].first); };
        std::vector<std::size_t> order(vertices.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
            const auto p = place(i), q = place(j);
            return p == q ? i < j : p < q;
        });
        order.erase(std::unique(order.begin(), order.end(), [&](auto i, auto j) { return place(i) == place(j); }),
                    order.end());
        const auto is_taken = [&](std::size_t i) {
            const Record *record = nearest(vertices[i].first);
            return record != nullptr && numbers_of(record->point) == place(i);
        };
        order.erase(std::remove_if(order.begin(), order.end(), is_taken), order.end());
        std::sort(order.begin(), order.end());
        return order;
    }

    void compact() {
        std::vector<Record *> by_id(t_.vertex_count());
        const std::vector<std::uint32_t> ids = t_.compact();
        for (std::size_t old = 0; old < ids.size(); old++) {
            if (ids[old] == DELDRIFT_NONE) continue;
            by_id[ids[old]] = by_id_[old];
            by_id_[old]->id = ids[old];
        }
        by_id_ = std::move(by_id);
        changed();
    }

    Triangulation t_;
    std::deque<Record> records_{};
    // Null for removed vertices.
    std::vector<Record *> by_id_{}, unused_{};
    std::vector<std::pair<Record *, Point>> staged_{};
    mutable Record infinite_;
    mutable std::mutex mutex_{};
    mutable std::atomic<bool> is_fresh_{false};
    mutable deldrift_cells_view cells_{};
    mutable std::atomic<bool> has_segments_{false};
    mutable std::vector<std::uint32_t> segments_{};
    mutable std::atomic<bool> has_face_infos_{false};
    mutable std::vector<Face_info> face_infos_{};
    mutable std::atomic<bool> has_marks_{false};
    mutable std::vector<std::uint8_t> marks_{};
    mutable std::atomic<bool> has_stars_{false};
    mutable std::atomic<std::size_t> n_stars_asked_{0};
    mutable Lists stars_{};
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_MESH_HPP
