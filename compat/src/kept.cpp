#include "kept.hpp"

#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include "matching.hpp"
#include "representatives.hpp"

namespace compat {

namespace {

// Building fewer points than this takes as long as finding them among those kept.
constexpr std::size_t worth_keeping = 64;
// The greatest number of those kept, and of their bytes in all; the one used last is always kept. Those not used for
// longest go first.
constexpr std::size_t most_kept = 8;
constexpr std::size_t most_bytes = std::size_t{1} << 30;

struct Entry {
    Triangulation triangulation;
    unsigned dimension;
    std::size_t n_points;
    std::vector<std::uint32_t> segments; // two points each
    std::size_t bytes;
};

// The one used last is at the end.
struct Store {
    std::mutex mutex;
    std::vector<Entry> entries;
};

// Never destroyed: calls may come from the destructors of other libraries.
Store &store() {
    static Store &kept = *new Store;
    return kept;
}

Entry take(Store &kept, std::size_t i) {
    Entry taken = std::move(kept.entries[i]);
    kept.entries.erase(kept.entries.begin() + static_cast<std::ptrdiff_t>(i));
    return taken;
}

// Takes the kept triangulation of as many points, with these segments, that is nearest to these, if any is near.
Entry take_nearest(unsigned dimension, const double *points, std::size_t n_points,
                   const std::vector<std::uint32_t> &segments) {
    Store &kept = store();
    const std::lock_guard lock(kept.mutex);
    std::size_t best = kept.entries.size();
    double least = nearness_limit;
    for (std::size_t i = 0; i < kept.entries.size(); i++) {
        const Entry &entry = kept.entries[i];
        if (entry.dimension != dimension || entry.n_points != n_points || entry.segments != segments) continue;
        const double distance = relative_distance(entry.triangulation.get(), dimension, points, n_points);
        if (distance >= least) continue;
        least = distance;
        best = i;
    }
    return best < kept.entries.size() ? take(kept, best) : Entry{};
}

// Takes the one used last of about as many points, without segments.
Entry take_similar(unsigned dimension, std::size_t n_points) {
    Store &kept = store();
    const std::lock_guard lock(kept.mutex);
    for (std::size_t i = kept.entries.size(); i-- > 0;) {
        const Entry &entry = kept.entries[i];
        const bool is_cloud = entry.dimension == dimension && entry.segments.empty();
        if (is_cloud && similar_counts(entry.n_points, n_points)) return take(kept, i);
    }
    return {};
}

void keep(Entry entry) {
    // Destroyed after the lock is released.
    std::vector<Entry> dropped;
    Store &kept = store();
    const std::lock_guard lock(kept.mutex);
    kept.entries.reserve(most_kept + 1);
    kept.entries.push_back(std::move(entry));
    std::size_t bytes = 0;
    for (const Entry &each : kept.entries) bytes += each.bytes;
    while (kept.entries.size() > most_kept || (bytes > most_bytes && kept.entries.size() > 1)) {
        bytes -= kept.entries.front().bytes;
        dropped.push_back(std::move(kept.entries.front()));
        kept.entries.erase(kept.entries.begin());
    }
}

} // namespace

Borrowed::Borrowed(unsigned dimension, const double *points, std::size_t n_points, std::vector<std::uint32_t> segments)
    : dimension_(dimension), n_points_(n_points), segments_(std::move(segments)) {
    const bool is_cloud = segments_.empty();
    const bool is_found = n_points >= worth_keeping && (move_kept(points) || (is_cloud && edit_kept(points)));
    is_to_be_kept_ = is_cloud || is_found;
    if (!is_found) build(points);
}

Borrowed::Borrowed(const double *points, const std::vector<double> &weights)
    : dimension_(3), n_points_(weights.size()), is_to_be_kept_(false) {
    deldrift_triangulation *built = nullptr;
    status_ = deldrift_create_weighted(3, points, weights.data(), nullptr, n_points_, nullptr, &built);
    triangulation_.reset(built);
}

void Borrowed::build(const double *points) {
    deldrift_triangulation *built = nullptr;
    status_ = deldrift_create(dimension_, points, n_points_, nullptr, &built);
    triangulation_.reset(built);
}

bool Borrowed::move_kept(const double *points) {
    Entry entry = take_nearest(dimension_, points, n_points_, segments_);
    if (entry.triangulation == nullptr) return false;
    if (move_to(entry.triangulation.get(), points, n_points_) != Outcome::brought) return false;
    if (!segments_.empty() && !representatives(entry.triangulation.get(), n_points_).empty()) return false;
    how_ = How::moved;
    triangulation_ = std::move(entry.triangulation);
    return true;
}

bool Borrowed::edit_kept(const double *points) {
    // Those of other points go back in the order in which they were.
    std::vector<Entry> unlike;
    unlike.reserve(most_kept);
    Outcome outcome = Outcome::unlike;
    while (outcome == Outcome::unlike && unlike.size() < most_kept) {
        Entry entry = take_similar(dimension_, n_points_);
        if (entry.triangulation == nullptr) break;
        outcome = edit_to(entry.triangulation.get(), dimension_, points, n_points_);
        if (outcome == Outcome::brought) triangulation_ = std::move(entry.triangulation);
        if (outcome == Outcome::unlike) unlike.push_back(std::move(entry));
    }
    for (; !unlike.empty(); unlike.pop_back()) keep(std::move(unlike.back()));
    if (outcome == Outcome::brought) how_ = How::edited;
    return outcome == Outcome::brought;
}

Borrowed::~Borrowed() {
    if (triangulation_ == nullptr || n_points_ < worth_keeping || !is_to_be_kept_) return;
    try {
        std::size_t bytes = 0;
        deldrift_memory_bytes(triangulation_.get(), &bytes);
        keep({std::move(triangulation_), dimension_, n_points_, std::move(segments_), bytes});
    } catch (const std::bad_alloc &) {
        // Without memory to keep it, it is destroyed.
    }
}

} // namespace compat
