// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded positions: what every engine is given, in the order in which it is given.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bench {

/// A part of a series that starts from a build: engines are built at frame `begin` - 1, and timestamps `begin` to
/// `last` follow. What they do before `first` is not on the clock. Frames between segments are where the next one
/// begins.
struct Segment {
    std::size_t begin;
    std::size_t first;
    std::size_t last;
    double displacement;  // length of every point's displacement at a timestamp
};

/// A sequence of frames of the same points. Frame 0 is where the points start; frame t is where they are at
/// timestamp t. One frame alone is a point set whose triangulation is built once.
struct Series {
    std::string name;
    unsigned dimension = 2;
    std::size_t n_points = 0;
    std::vector<double> positions;  // frames x points x dimension
    bool is_sequential = false;     // points move one after another, in the order of their ids
    std::vector<Segment> segments;  // empty: one, of all timestamps
    std::string remark;             // what a reader of the results must know of it

    std::size_t frame_length() const { return n_points * dimension; }
    std::size_t n_frames() const { return frame_length() == 0 ? 0 : positions.size() / frame_length(); }
    std::size_t n_timestamps() const { return n_frames() == 0 ? 0 : n_frames() - 1; }
    const double *frame(std::size_t timestamp) const { return positions.data() + timestamp * frame_length(); }
};

}  // namespace bench
