// Triangle's planar straight-line graphs: segments that may cross, overlap and have points on them, as a triangulation
// with segments that do not.
#pragma once

#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <deldrift.h>

namespace compat {

// What is wrong with the segments, holes and regions of an input with points, or an empty string. Places are to be
// finite.
std::string what_is_wrong_with_graph(const triangulateio &in);

// The segments of an input, cut into pieces between neighbouring points on them. Where two cross, the rounded place of
// the crossing is a point of its own. A piece that is part of several segments has the first of their markers that is
// not 0.
class Graph {
public:
    // Segments without two ends are left out: with ends at the same place, as in Triangle, or numbers that no point
    // has, about which there is a line on stderr for each.
    Graph(const triangulateio &in, bool is_zero_based);

    // The pieces, two ends each; before settle, the segments.
    const std::vector<std::uint32_t> &ends() const { return ends_; }
    const std::vector<int> &markers() const { return markers_; }
    std::size_t count() const { return markers_.size(); }

    // Whether no segment has been cut, and points share no place, so that the pieces of other positions are the same.
    bool is_plain() const { return is_plain_; }

    // Leaves all segments out, as Triangle does where points are on a line.
    void clear();

    // Brings the pieces into a triangulation of the points: as its segments, which have their numbers. Empty, or a
    // message that says why that cannot be done.
    std::string settle(deldrift_triangulation *t);

    // All points, those of the input first.
    std::size_t n_points() const { return n_points_ + n_added(); }
    const double *points() const { return n_added() > 0 ? points_.data() : in_.pointlist; }
    const double *attributes() const { return n_added() > 0 ? attributes_.data() : in_.pointattributelist; }
    // Their markers: those that they came with, or else that of the first segment at the point that has one.
    std::vector<int> point_markers() const;

private:
    struct Crossing;
    struct Part;
    static constexpr std::uint32_t no_piece = UINT32_MAX;

    std::size_t n_added() const { return n_added_; }
    void cut_at_representatives(const deldrift_triangulation *t);
    void find_pieces();
    deldrift_status stage(deldrift_triangulation *t) const;
    void resolve(const std::vector<deldrift_conflict> &conflicts);
    void add_points(const std::vector<Crossing> &crossings, std::vector<std::vector<std::uint32_t>> &on_pieces);
    void cut_chains(const std::vector<std::vector<std::uint32_t>> &on_pieces);
    void sort_along(std::uint32_t start, std::uint32_t end, std::vector<std::uint32_t> &points) const;
    int side(std::uint32_t start, std::uint32_t end, std::uint32_t point) const;
    Part part_across(std::uint32_t piece, const std::vector<std::uint32_t> &on_piece, std::uint32_t across) const;
    const double *at(std::uint32_t point) const { return points() + std::size_t{2} * point; }

    triangulateio in_;
    std::size_t n_points_, n_attributes_, n_added_ = 0;
    bool is_plain_ = true;
    // Each segment as the points that it leads through, from its first end on.
    std::vector<std::uint32_t> chains_;
    std::vector<std::size_t> offsets_{0};
    std::vector<int> chain_markers_;
    std::vector<std::uint32_t> ends_;
    std::vector<int> markers_;
    std::vector<std::uint32_t> piece_of_; // of each point of chains_ that is not the last of its chain
    // With points that were added; empty before.
    std::vector<double> points_, attributes_;
};

} // namespace compat
