// Triangulations that are kept from call to call. The calling conventions served here have no handle: each call gives
// the points again. A program that moves its points between calls gives almost the same ones, and a triangulation of
// those takes a fraction of the time to bring to the new positions.
//
// Which kept triangulation is taken never changes the cells. They are always those of a new triangulation of the
// points in the order given, because ties are broken by id, and a triangulation is only taken if its ids are in the
// order of the points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <deldrift.h>

#include "settings.hpp"

namespace compat {

struct Destroy {
    void operator()(deldrift_triangulation *t) const { deldrift_destroy(t); }
};
using Triangulation = std::unique_ptr<deldrift_triangulation, Destroy>;

// The triangulation of n points, vertex i being point i, for the caller alone as long as this lives. Afterwards it is
// kept for other calls, unless it has too few points for that.
class Borrowed {
public:
    // With segments, two points each, for the plane: where how() is How::moved it has them, with the numbers of their
    // rows, and no two points share a place. Otherwise it is one of the points alone, and not kept unless the caller
    // brings the segments in, and says so.
    Borrowed(unsigned dimension, const double *points, std::size_t n_points, std::vector<std::uint32_t> segments = {});
    // Of points in space with weights; it is built, and not kept.
    Borrowed(const double *points, const std::vector<double> &weights);
    Borrowed(const Borrowed &) = delete;
    Borrowed &operator=(const Borrowed &) = delete;
    ~Borrowed();

    // DELDRIFT_OK, or why there is none; then deldrift_last_error has the message.
    deldrift_status status() const { return status_; }
    const deldrift_triangulation *get() const { return triangulation_.get(); }
    How how() const { return how_; }
    deldrift_triangulation *change() { return triangulation_.get(); }
    void has_segments() { is_to_be_kept_ = true; }

private:
    void build(const double *points);
    bool move_kept(const double *points);
    bool edit_kept(const double *points);

    Triangulation triangulation_;
    unsigned dimension_;
    std::size_t n_points_;
    std::vector<std::uint32_t> segments_{};
    bool is_to_be_kept_ = true;
    How how_ = How::built;
    deldrift_status status_ = DELDRIFT_OK;
};

} // namespace compat
