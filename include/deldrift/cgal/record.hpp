// What a handle of a vertex points to: see cgal.hpp.
#ifndef DELDRIFT_CGAL_RECORD_HPP
#define DELDRIFT_CGAL_RECORD_HPP

#include <algorithm>
#include <cstdint>
#include <deque>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernel.hpp"

namespace deldrift::cgal::detail {

struct No_info {};
template <class Info>
using Info_or_none = std::conditional_t<std::is_void_v<Info>, No_info, Info>;

// What a vertex handle points to. It stays where it is until the vertex is removed.
template <std::uint32_t D, class Policy, class Info>
class Mesh;
template <std::uint32_t D, class Policy, class Info>
struct Record {
    typename Policy::Point point;
    Info_or_none<typename Parts_of<Info>::Vertices> info;
    // Null for one that is not in use, and for the infinite vertex its mesh.
    const Mesh<D, Policy, Info> *mesh;
    std::uint32_t id;
};

// Those of all vertices, and the moves that wait for a commit.
template <std::uint32_t D, class Policy, class Info>
class Records {
protected:
    using Record = detail::Record<D, Policy, Info>;
    using Point = typename Policy::Point;
    using Given_info = decltype(Record::info);

    const std::vector<Record *> &by_id() const noexcept { return by_id_; }

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
        record->mesh = static_cast<const Mesh<D, Policy, Info> *>(this);
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

    std::deque<Record> records_{};
    // Null for removed vertices.
    std::vector<Record *> by_id_{}, unused_{};
    std::vector<std::pair<Record *, Point>> staged_{};
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_RECORD_HPP
