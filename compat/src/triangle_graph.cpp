#include "triangle_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "plain_locale.hpp"
#include "representatives.hpp"
#include "settings.hpp"
#include "triangle_crossing.hpp"

namespace compat {

namespace {

constexpr char name[] = "triangulate";
// Rounded crossings can lie so that pieces cross anew. Pieces get shorter each time, and a few rounds are enough unless
// segments are nearly as short as the spacing of numbers.
constexpr int most_rounds = 64;

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return std::uint64_t{low} << 32 | high;
}

// The bits of a place; zeros of either sign are one.
struct Place {
    double x, y;
    bool operator==(const Place &other) const { return x == other.x && y == other.y; }
};

struct HashPlace {
    std::size_t operator()(const Place &place) const {
        const double numbers[2] = {place.x + 0.0, place.y + 0.0};
        std::uint64_t bits[2];
        std::memcpy(bits, numbers, sizeof bits);
        return static_cast<std::size_t>((bits[0] * 0x9E3779B97F4A7C15u ^ bits[1]) * 0xD1B54A32D192ED03u >> 16);
    }
};

std::string what_is_wrong_with_list(const char *list, const char *count_name, int count, bool is_null) {
    char text[160];
    if (count < 0) std::snprintf(text, sizeof text, "in->%s is %d", count_name, count);
    else if (count > 0 && is_null)
        std::snprintf(text, sizeof text, "in->%s is NULL, and in->%s %d", list, count_name, count);
    else return "";
    return text;
}

std::string what_is_wrong_with_places(const char *list, const double *places, int count, int width) {
    for (int i = 0; i < count; i++) {
        for (int axis = 0; axis < 2; axis++) {
            const int index = i * width + axis;
            if (std::abs(places[index]) <= 1e57) continue;
            char text[160];
            const PlainLocale plain;
            std::snprintf(text, sizeof text, "in->%s[%d] is %g: a finite number was expected, at most 1e57 in size",
                          list, index, places[index]);
            return text;
        }
    }
    return "";
}

} // namespace

std::string what_is_wrong_with_graph(const triangulateio &in) {
    for (const std::string &text :
         {what_is_wrong_with_list("segmentlist", "numberofsegments", in.numberofsegments, in.segmentlist == nullptr),
          what_is_wrong_with_list("holelist", "numberofholes", in.numberofholes, in.holelist == nullptr),
          what_is_wrong_with_list("regionlist", "numberofregions", in.numberofregions, in.regionlist == nullptr)})
        if (!text.empty()) return text;
    const std::string of_holes = what_is_wrong_with_places("holelist", in.holelist, in.numberofholes, 2);
    return of_holes.empty() ? what_is_wrong_with_places("regionlist", in.regionlist, in.numberofregions, 4) : of_holes;
}

Graph::Graph(const triangulateio &in, bool is_zero_based)
    : in_(in), n_points_(static_cast<std::size_t>(in.numberofpoints)),
      n_attributes_(static_cast<std::size_t>(in.numberofpointattributes)) {
    const int first = is_zero_based ? 0 : 1;
    for (int i = 0; i < in.numberofsegments; i++) {
        const int *given = in.segmentlist + std::ptrdiff_t{2} * i;
        bool has_ends = true;
        for (int end = 0; end < 2; end++) {
            if (given[end] >= first && given[end] - first < in.numberofpoints) continue;
            complain(name, "in->segmentlist[%d] is %d, and points have the numbers %d to %d: the segment is left out",
                     2 * i + end, given[end], first, first + in.numberofpoints - 1);
            has_ends = false;
        }
        if (!has_ends) continue;
        const std::uint32_t start = static_cast<std::uint32_t>(given[0] - first);
        const std::uint32_t end = static_cast<std::uint32_t>(given[1] - first);
        if (at(start)[0] == at(end)[0] && at(start)[1] == at(end)[1]) continue;
        chains_.insert(chains_.end(), {start, end});
        offsets_.push_back(chains_.size());
        chain_markers_.push_back(in.segmentmarkerlist != nullptr ? in.segmentmarkerlist[i] : 0);
    }
    find_pieces();
}

void Graph::clear() {
    is_plain_ = false;
    chains_.clear();
    offsets_.assign(1, 0);
    chain_markers_.clear();
    find_pieces();
}

void Graph::find_pieces() {
    std::unordered_map<std::uint64_t, std::uint32_t> index;
    index.reserve(chains_.size());
    ends_.clear();
    markers_.clear();
    piece_of_.assign(chains_.size(), no_piece);
    for (std::size_t k = 0; k < chain_markers_.size(); k++) {
        for (std::size_t i = offsets_[k]; i + 1 < offsets_[k + 1]; i++) {
            const std::uint32_t start = chains_[i], end = chains_[i + 1];
            const auto [entry, is_new] = index.emplace(key_of(start, end), static_cast<std::uint32_t>(count()));
            piece_of_[i] = entry->second;
            if (is_new) {
                ends_.insert(ends_.end(), {start, end});
                markers_.push_back(chain_markers_[k]);
            } else if (markers_[entry->second] == 0) {
                markers_[entry->second] = chain_markers_[k];
            }
        }
    }
}

void Graph::cut_at_representatives(const deldrift_triangulation *t) {
    const std::vector<std::uint32_t> representative = representatives(t, n_points_);
    if (representative.empty()) return;
    is_plain_ = false;
    for (std::uint32_t &point : chains_) point = representative[point];
    find_pieces();
}

deldrift_status Graph::stage(deldrift_triangulation *t) const {
    std::uint32_t first = 0;
    deldrift_status status = DELDRIFT_OK;
    if (n_added_ > 0) status = deldrift_stage_insertions(t, points_.data() + 2 * n_points_, n_added_, &first);
    if (status == DELDRIFT_OK) status = deldrift_stage_segments(t, ends_.data(), nullptr, count(), &first);
    return status;
}

std::string Graph::settle(deldrift_triangulation *t) {
    cut_at_representatives(t);
    if (count() == 0) return "";
    for (int round = 0;; round++) {
        if (stage(t) == DELDRIFT_OK && deldrift_commit_timestamp(t, nullptr) == DELDRIFT_OK) return "";
        const std::string message = deldrift_last_error();
        std::size_t n_conflicts = 0;
        deldrift_segment_conflicts(t, nullptr, 0, &n_conflicts);
        if (n_conflicts == 0) return message;
        if (round == most_rounds) return "segments cross, however often they are cut: " + message;
        std::vector<deldrift_conflict> conflicts(n_conflicts);
        deldrift_segment_conflicts(t, conflicts.data(), n_conflicts, &n_conflicts);
        deldrift_discard_moves(t);
        resolve(conflicts);
    }
}

// Two pieces that cross, and how far along the later one that is.
struct Graph::Crossing {
    std::uint32_t earlier, later;
    double along_later;
};

void Graph::resolve(const std::vector<deldrift_conflict> &conflicts) {
    is_plain_ = false;
    std::vector<std::vector<std::uint32_t>> on_pieces(count());
    std::vector<Crossing> crossings;
    bool has_points = false;
    for (const deldrift_conflict &each : conflicts) {
        if (each.kind != DELDRIFT_CONFLICT_ON_SEGMENT) continue;
        on_pieces[each.segment].push_back(each.other);
        has_points = true;
    }
    // Crossings wait for the next round where there are points on segments: what overlaps is one piece then, which is
    // crossed once.
    for (const deldrift_conflict &each : conflicts) {
        if (has_points || each.kind != DELDRIFT_CONFLICT_CROSSING) continue;
        const std::uint32_t earlier = std::min(each.segment, each.other), later = std::max(each.segment, each.other);
        crossings.push_back({earlier, later, crossing_along(at(ends_[std::size_t{2} * later]),
                                                            at(ends_[std::size_t{2} * later + 1]),
                                                            at(ends_[std::size_t{2} * earlier]),
                                                            at(ends_[std::size_t{2} * earlier + 1]))});
    }
    for (std::size_t i = 0; i < count(); i++) sort_along(ends_[2 * i], ends_[2 * i + 1], on_pieces[i]);
    // In the order in which the later pieces come upon them, as Triangle numbers them.
    const auto before = [](const Crossing &a, const Crossing &b) {
        return std::tie(a.later, a.along_later, a.earlier) < std::tie(b.later, b.along_later, b.earlier);
    };
    std::sort(crossings.begin(), crossings.end(), before);
    add_points(crossings, on_pieces);
    cut_chains(on_pieces);
    find_pieces();
}

int Graph::side(std::uint32_t start, std::uint32_t end, std::uint32_t point) const {
    const double *corners[3] = {at(start), at(end), at(point)};
    double three[6];
    for (int i = 0; i < 3; i++) std::copy_n(corners[i], 2, three + 2 * i);
    std::int32_t sign = 0;
    deldrift_orientation(2, three, &sign);
    return sign;
}

// The part of a piece that another one crosses, between neighbouring points on it.
struct Graph::Part {
    std::size_t index; // of its end among the points on the piece
    std::uint32_t start, end;
    bool is_crossed; // and not met at its end
};

Graph::Part Graph::part_across(std::uint32_t piece, const std::vector<std::uint32_t> &on_piece,
                               std::uint32_t across) const {
    const std::uint32_t *ends = &ends_[std::size_t{2} * piece], *line = &ends_[std::size_t{2} * across];
    const int of_start = side(line[0], line[1], ends[0]);
    const auto stays = [&](std::uint32_t point) { return side(line[0], line[1], point) == of_start; };
    const auto found = std::partition_point(on_piece.begin(), on_piece.end(), stays);
    const std::uint32_t start = found == on_piece.begin() ? ends[0] : found[-1];
    const std::uint32_t end = found == on_piece.end() ? ends[1] : *found;
    return {static_cast<std::size_t>(found - on_piece.begin()), start, end, side(line[0], line[1], end) != 0};
}

// Adds the crossings to the points on both pieces: as points of their own, unless there is one at the place already.
// Where a piece is met at a point on it, this is on the other piece too.
void Graph::add_points(const std::vector<Crossing> &crossings, std::vector<std::vector<std::uint32_t>> &on_pieces) {
    if (crossings.empty()) return;
    if (n_added_ == 0) {
        points_.assign(in_.pointlist, in_.pointlist + 2 * n_points_);
        if (n_attributes_ > 0)
            attributes_.assign(in_.pointattributelist, in_.pointattributelist + n_attributes_ * n_points_);
    }
    std::unordered_map<Place, std::uint32_t, HashPlace> taken;
    taken.reserve(n_points() + crossings.size());
    for (std::size_t i = 0; i < n_points_ + n_added_; i++)
        taken.emplace(Place{points_[2 * i], points_[2 * i + 1]}, static_cast<std::uint32_t>(i));
    for (const Crossing &each : crossings) {
        const Part earlier = part_across(each.earlier, on_pieces[each.earlier], each.later);
        const Part later = part_across(each.later, on_pieces[each.later], each.earlier);
        if (!earlier.is_crossed || !later.is_crossed) continue;
        const std::size_t start = earlier.start, end = earlier.end;
        const double *from = &points_[2 * start], *to = &points_[2 * end];
        const double along = crossing_along(from, to, &points_[std::size_t{2} * later.start],
                                            &points_[std::size_t{2} * later.end]);
        const auto between = [along](double first, double last) { return first + along * (last - first); };
        const Place place{between(from[0], to[0]), between(from[1], to[1])};
        const auto [entry, is_new] = taken.emplace(place, static_cast<std::uint32_t>(n_points_ + n_added_));
        if (is_new) {
            points_.insert(points_.end(), {place.x, place.y});
            for (std::size_t k = 0; k < n_attributes_; k++)
                attributes_.push_back(
                    between(attributes_[start * n_attributes_ + k], attributes_[end * n_attributes_ + k]));
            n_added_++;
        }
        const std::uint32_t point = entry->second;
        for (const auto &[piece, part] : {std::pair{each.earlier, earlier}, {each.later, later}}) {
            std::vector<std::uint32_t> &on_piece = on_pieces[piece];
            if (point == ends_[std::size_t{2} * piece] || point == ends_[std::size_t{2} * piece + 1]) continue;
            if (std::find(on_piece.begin(), on_piece.end(), point) != on_piece.end()) continue;
            on_piece.insert(on_piece.begin() + static_cast<std::ptrdiff_t>(part.index), point);
        }
    }
}

// In the order from start to end, which is exact for points that are exactly on the segment. Each once, and the ends
// not at all.
void Graph::sort_along(std::uint32_t start, std::uint32_t end, std::vector<std::uint32_t> &points) const {
    const double *from = at(start), *to = at(end);
    const double x = to[0] - from[0], y = to[1] - from[1], scale = 1 / std::max(std::abs(x), std::abs(y));
    // The first number does not descend along the segment, rounding included; where it stays, coordinates decide.
    using Key = std::array<double, 3>;
    const auto key = [&](std::uint32_t point) {
        const double *p = at(point);
        return Key{(p[0] - from[0]) * (x * scale) + (p[1] - from[1]) * (y * scale), x < 0 ? -p[0] : p[0],
                   y < 0 ? -p[1] : p[1]};
    };
    std::vector<std::pair<Key, std::uint32_t>> rows;
    for (std::uint32_t point : points)
        if (point != start && point != end) rows.emplace_back(key(point), point);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    points.clear();
    for (const auto &row : rows) points.push_back(row.second);
}

void Graph::cut_chains(const std::vector<std::vector<std::uint32_t>> &on_pieces) {
    std::vector<std::uint32_t> chains;
    std::vector<std::size_t> offsets{0};
    for (std::size_t k = 0; k < chain_markers_.size(); k++) {
        for (std::size_t i = offsets_[k]; i < offsets_[k + 1]; i++) {
            chains.push_back(chains_[i]);
            if (piece_of_[i] == no_piece) continue;
            const std::vector<std::uint32_t> &between = on_pieces[piece_of_[i]];
            const bool is_forwards = ends_[std::size_t{2} * piece_of_[i]] == chains_[i];
            if (is_forwards) chains.insert(chains.end(), between.begin(), between.end());
            else chains.insert(chains.end(), between.rbegin(), between.rend());
        }
        offsets.push_back(chains.size());
    }
    chains_ = std::move(chains);
    offsets_ = std::move(offsets);
}

std::vector<int> Graph::point_markers() const {
    std::vector<int> markers(n_points(), 0);
    if (in_.pointmarkerlist != nullptr) std::copy_n(in_.pointmarkerlist, n_points_, markers.begin());
    for (std::size_t k = 0; k < chain_markers_.size(); k++)
        for (std::size_t i = offsets_[k]; i < offsets_[k + 1]; i++)
            if (markers[chains_[i]] == 0) markers[chains_[i]] = chain_markers_[k];
    return markers;
}

} // namespace compat
