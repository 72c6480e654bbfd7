// The triangulation behind cgal.hpp, with the points and infos of its vertices: see there.
#ifndef DELDRIFT_CGAL_MESH_HPP
#define DELDRIFT_CGAL_MESH_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../deldrift.hpp"
#include "marks.hpp"
#include "points.hpp"
#include "reading.hpp"
#include "record.hpp"

namespace deldrift::cgal::detail {

// Points at the same place are one vertex, as in CGAL; with weights, those of the same weight, where that is not
// hidden. Calls that fail have no effect.
template <std::uint32_t D, class Policy, class Info>
class Mesh : public Reading<D, Info_or_none<typename Parts_of<Info>::Faces>>, public Records<D, Policy, Info> {
    using Base = Reading<D, Info_or_none<typename Parts_of<Info>::Faces>>;
    using Kept = Records<D, Policy, Info>;

public:
    using Point = typename Policy::Point;
    using Bare_point = typename Policy::Bare_point;
    using Numbers = std::array<double, D>;
    using Record = detail::Record<D, Policy, Info>;
    using Given_info = decltype(Record::info);
    using Face_info = Info_or_none<typename Parts_of<Info>::Faces>;
    using typename Base::Star;
    using Vertices = std::vector<std::pair<Point, Given_info>>;

    Mesh() : Base(made({}, {})), infinite_{Policy::point({}), {}, this, DELDRIFT_NONE} {}
    // All is copied, nothing triangulated: vertices have the same ids, cells the same indices, and what is staged is.
    Mesh(const Mesh &other) : Base(other.t_.clone()), infinite_{Policy::point({}), {}, this, DELDRIFT_NONE} {
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

    static constexpr bool is_weighted = Policy::are_weighted;
    static Numbers numbers_of(const Point &p) { return Policy::of(p); }
    static double weight_of(const Point &p) { return Policy::weight_of(p); }

    Record *infinite() const noexcept { return &infinite_; }
    using Kept::by_id;

    // Whether the vertex is a corner of cells, or is in the lower hull where there are none.
    bool is_hidden(std::uint32_t id) const {
        if constexpr (is_weighted) {
            return id != DELDRIFT_NONE && this->hidden().are_hidden[id] != 0;
        } else {
            return false;
        }
    }
    bool shows(std::uint32_t id) const { return by_id_[id] != nullptr && !is_hidden(id); }
    std::size_t shown_count() const {
        const std::size_t n = t_.vertex_count();
        if constexpr (is_weighted) return n - this->hidden().in_order.size();
        return n;
    }
    // That of one vertex, from its star alone, where there are cells.
    bool is_hidden_now(std::uint32_t id) const {
        if constexpr (!is_weighted) return false;
        const std::vector<std::uint32_t> star = t_.star(id);
        if (star.empty()) return t_.cell_count() > 0 || is_hidden(id);
        const std::uint32_t *row = this->cells().vertices + std::size_t{star[0]} * (D + 1);
        return std::find(row, row + D + 1, id) == row + D + 1;
    }

    // The vertex at the least distance, or power distance, from a place; null where there is none.
    Record *nearest(const Numbers &place) const {
        const std::uint32_t id = t_.nearest_vertex(place);
        return id == DELDRIFT_NONE ? nullptr : by_id_[id];
    }
    // The vertex at a place that is not hidden; null where there is none.
    Record *at(const Point &p) const {
        const Numbers place = numbers_of(p);
        if constexpr (is_weighted) {
            const deldrift_location found = t_.locate_points(place)[0];
            if (found.kind == DELDRIFT_LOCATION_VERTEX) return by_id_[found.index];
            if (found.kind != DELDRIFT_LOCATION_NO_CELLS) return nullptr;
            for (std::uint32_t id : t_.vertices_in_ball(place, 0)) {
                if (!is_hidden(id)) return by_id_[id];
            }
            return nullptr;
        } else {
            Record *record = nearest(place);
            return record != nullptr && numbers_of(record->point) == place ? record : nullptr;
        }
    }

    Record *insert(const Point &p, Given_info info) {
        if constexpr (is_weighted) {
            if (Record *same = same_as(p)) return same;
        }
        Record *record = add(p, std::move(info));
        // Those that the library refuses are refused before there is an id.
        if (is_weighted && !(weight_of(p) >= 0 && weight_of(p) <= 1e114)) {
            insert_alone(*record);
            return record;
        }
        std::uint32_t id = 0;
        const deldrift_status status = deldrift_insert_vertex(t_.native(), numbers_of(p).data(), &id);
        if (status != DELDRIFT_OK) drop_last();
        if (!is_weighted && status == DELDRIFT_COINCIDENT) return nearest(numbers_of(p));
        this->require_ok(status);
        changed();
        if (weight_of(p) > 0) give_weight(record);
        return record;
    }

    // All at once; one vertex for each place, and weight. Where there are moves to be committed, one after the other.
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
        if constexpr (is_weighted) return move_weighted(record, p);
        const deldrift_status status = deldrift_relocate_vertex(t_.native(), record->id, numbers_of(p).data());
        if (status == DELDRIFT_COINCIDENT) return nearest(numbers_of(p));
        this->require_ok(status);
        changed();
        record->point = p;
        return record;
    }

    void stage_move(Record *record, const Point &p) {
        staged_.emplace_back(record, p);
        const deldrift_status status = deldrift_move_vertex(t_.native(), record->id, numbers_of(p).data());
        if (status != DELDRIFT_OK) staged_.pop_back();
        this->require_ok(status);
        if constexpr (is_weighted) {
            try {
                stage_weight(t_, record->id, p);
            } catch (...) {
                staged_.pop_back();
                t_.discard_moves();
                stage_again();
                throw;
            }
        }
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
                for (std::uint64_t k = 0; k < split.inserted; k++) add(Policy::point({}), {});
            });
        } catch (...) {
            while (by_id_.size() > n_before) drop_last();
            throw;
        }
        for (std::size_t id = n_before; id < by_id_.size(); id++) {
            by_id_[id]->point = Policy::point(t_.template position<D>(static_cast<std::uint32_t>(id)));
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
        const std::vector<std::uint8_t> &before = this->marks();
        const auto report = refined.refine(quality, span<const std::uint8_t>(before.data(), this->cells().count));
        if (report.inserted == 0) return;
        std::vector<std::uint8_t> after = marks_after(t_, before, refined);
        after.resize(refined.cell_count() * (D + 2));
        stage_moves_of(refined);
        const std::size_t n_before = by_id_.size();
        try {
            for (std::size_t id = n_before; id < refined.id_count(); id++) {
                add(Policy::point(refined.position<D>(static_cast<std::uint32_t>(id))), {});
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
    deldrift_commit_report commit_timestamp() {
        const deldrift_commit_report report = t_.commit_timestamp();
        changed();
        for (auto &[record, p] : staged_) record->point = p;
        staged_.clear();
        return report;
    }

private:
    using Base::changed, Base::has_marks_, Base::marks_, Base::t_;
    using Kept::add, Kept::by_id_, Kept::drop_last, Kept::forget, Kept::records_, Kept::staged_, Kept::unused_;

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
            this->require_ok(deldrift_move_vertex(t.native(), record->id, numbers_of(p).data()));
            if constexpr (is_weighted) stage_weight(t, record->id, p);
        }
    }
    static void stage_weight(Triangulation &t, std::uint32_t id, const Point &p) {
        const std::uint32_t ids[] = {id};
        const double weights[] = {weight_of(p)};
        t.stage_weights(ids, weights);
    }

    // Points at one place are one vertex: with weights those of the same weight, which is looked at here.
    static deldrift_options options() noexcept {
        deldrift_options options = default_options();
        if (!is_weighted) options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
        return options;
    }
    static Triangulation made(const std::vector<Numbers> &places, const std::vector<double> &weights) {
        if constexpr (is_weighted) return Triangulation(D, places, Weights(weights), options());
        return Triangulation(D, places, options());
    }

    static bool differ(double a, double b) noexcept { return a < b || b < a; }
    // The vertex at the same place with the same weight, if that is not hidden; null where there is none.
    Record *same_as(const Point &p) const {
        Record *record = at(p);
        if (record == nullptr || differ(weight_of(record->point), weight_of(p))) return nullptr;
        return record;
    }
    // The last vertex, which has a record, by a commit of its own: so it comes with its weight. With 0 meanwhile, one
    // that is lighter could hide all others.
    void insert_alone(const Record &record) {
        try {
            commit_alone([&] {
                t_.stage_insertions(numbers_of(record.point));
                stage_weight(t_, record.id, record.point);
            });
        } catch (...) {
            drop_last();
            throw;
        }
    }
    // Gives a new vertex its weight, or takes the vertex back. Where there is no memory for that, it stays without the
    // weight.
    void give_weight(Record *record) {
        const deldrift_status status = deldrift_set_weight(t_.native(), record->id, weight_of(record->point));
        if (status == DELDRIFT_OK) return;
        const Error error(status);
        if (deldrift_remove_vertex(t_.native(), record->id) == DELDRIFT_OK) {
            forget(record);
        } else {
            record->point = Policy::point(numbers_of(record->point));
        }
        throw error;
    }
    // To another place, with another weight, or both. Where another vertex is at the place, and not hidden, that one is
    // the answer, and nothing has changed.
    Record *move_weighted(Record *record, const Point &p) {
        const Numbers place = numbers_of(p);
        Record *there = at(p);
        if (there != nullptr && there != record) return there;
        const double before = weight_of(record->point);
        const bool is_reweighted = differ(weight_of(p), before);
        if (is_reweighted) this->require_ok(deldrift_set_weight(t_.native(), record->id, weight_of(p)));
        changed();
        const deldrift_status status = deldrift_relocate_vertex(t_.native(), record->id, place.data());
        if (status == DELDRIFT_OK) {
            record->point = p;
            return record;
        }
        const Error error(status);
        // Where there is no memory for that, it keeps the new weight.
        if (is_reweighted && deldrift_set_weight(t_.native(), record->id, before) != DELDRIFT_OK) {
            record->point = Policy::point(numbers_of(record->point), weight_of(p));
        }
        throw error;
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
        std::vector<Numbers> places;
        std::vector<double> weights;
        places.reserve(n);
        weights.reserve(n);
        bool is_done = false;
        try {
            for (std::size_t i = 0; i < n; i++) {
                const auto &[p, info] = vertices[index(i)];
                if constexpr (moves_infos) {
                    add(p, {});
                } else {
                    add(p, info);
                }
                places.push_back(numbers_of(p));
                weights.push_back(weight_of(p));
            }
            const bool may_be_same = which.empty();
            is_done = t_.id_count() == 0 ? build(places, weights, may_be_same) : add_all(places, weights, may_be_same);
        } catch (const Error &error) {
            undo_insertions(n_before);
            if (error.status() == DELDRIFT_COINCIDENT) return false;
            throw;
        } catch (...) {
            undo_insertions(n_before);
            throw;
        }
        if (!is_done) {
            undo_insertions(n_before);
            return false;
        }
        changed();
        if constexpr (moves_infos) {
            for (std::size_t i = 0; i < n; i++) by_id_[n_before + i]->info = std::move(vertices[index(i)].second);
        }
        return true;
    }
    // With weights, these may not share their place while it is not known whether they have the same weight there.
    bool build(const std::vector<Numbers> &places, const std::vector<double> &weights, bool may_be_same) {
        Triangulation t = made(places, weights);
        if (is_weighted && may_be_same && t.statistics().coincident > 0) return false;
        t_ = std::move(t);
        return true;
    }
    bool add_all(const std::vector<Numbers> &places, const std::vector<double> &weights, bool may_be_same) {
        const std::uint32_t first = t_.stage_insertions(places);
        if constexpr (is_weighted) {
            std::vector<std::uint32_t> ids(weights.size());
            std::iota(ids.begin(), ids.end(), first);
            t_.stage_weights(ids, weights);
            if (may_be_same) {
                const auto before = t_.statistics().coincident;
                if (t_.prepare_timestamp().coincident > before) {
                    t_.withdraw_timestamp();
                    return false;
                }
                t_.publish_timestamp();
                return true;
            }
        }
        t_.commit_timestamp();
        return true;
    }
    void undo_insertions(std::size_t n_before) {
        t_.discard_moves();
        while (by_id_.size() > n_before) drop_last();
    }

    // One index for each place, and weight, with which there is no vertex yet.
    std::vector<std::size_t> different_places(const Vertices &vertices) const {
        const auto place = [&](std::size_t i) {
            return std::make_pair(numbers_of(vertices[i].first), weight_of(vertices[i].first));
        };
        std::vector<std::size_t> order(vertices.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
            const auto p = place(i), q = place(j);
            return p == q ? i < j : p < q;
        });
        order.erase(std::unique(order.begin(), order.end(), [&](auto i, auto j) { return place(i) == place(j); }),
                    order.end());
        const auto is_taken = [&](std::size_t i) {
            const Point &p = vertices[i].first;
            return same_as(p) != nullptr;
        };
        order.erase(std::remove_if(order.begin(), order.end(), is_taken), order.end());
        std::sort(order.begin(), order.end());
        return order;
    }

    void compact() {
        std::vector<Record *> kept(t_.vertex_count());
        const std::vector<std::uint32_t> ids = t_.compact();
        for (std::size_t old = 0; old < ids.size(); old++) {
            if (ids[old] == DELDRIFT_NONE) continue;
            kept[ids[old]] = by_id_[old];
            by_id_[old]->id = ids[old];
        }
        by_id_ = std::move(kept);
        changed();
    }

    mutable Record infinite_;
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_MESH_HPP
