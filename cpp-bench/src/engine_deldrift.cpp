// SPDX-License-Identifier: GPL-3.0-or-later
// deldrift through its C interface: stage all positions, commit the timestamp.
#include "engine.hpp"

#include <stdexcept>

namespace bench {
namespace {

/// Everything: indices, adjacency, orientation and hull, empty spheres.
constexpr std::uint32_t full_validation = 3;

void require(deldrift_status status, const char *call) {
    if (status == DELDRIFT_OK) return;
    throw std::runtime_error(std::string(call) + ": " + deldrift_last_error());
}

class Deldrift : public Engine {
public:
    Deldrift(unsigned dimension, deldrift_algorithm algorithm, unsigned n_threads) : dimension_(dimension) {
        deldrift_options_init(&options_);
        options_.algorithm = algorithm;
        options_.threads = n_threads;
    }
    Deldrift(const Deldrift &) = delete;
    Deldrift &operator=(const Deldrift &) = delete;
    ~Deldrift() override { deldrift_destroy(triangulation_); }

    void build(const double *positions, std::size_t n_points) override {
        deldrift_destroy(triangulation_);
        triangulation_ = nullptr;
        n_points_ = n_points;
        rebuilds_ =
            options_.algorithm == DELDRIFT_REBUILDING || options_.algorithm == DELDRIFT_REBUILDING_TOLERANCE;
        require(deldrift_create(dimension_, positions, n_points, &options_, &triangulation_), "deldrift_create");
        pre_compute();
    }

    void advance(const double *positions) override {
        stage(positions);
        commit();
    }

    void advance_sequentially(const double *positions) override {
        if (rebuilds_) {
            deldrift_commit_report report;
            require(deldrift_move_vertices(triangulation_, nullptr, positions, n_points_), "deldrift_move_vertices");
            require(deldrift_commit_timestamp(triangulation_, &report), "deldrift_commit_timestamp");
            // Rebuilding and tolerance relocates one by one as soon as it has turned to tolerances.
            rebuilds_ = options_.algorithm == DELDRIFT_REBUILDING || report.rebuilds > 0;
            return;
        }
        for (std::size_t id = 0; id < n_points_; ++id)
            require(deldrift_relocate_vertex(triangulation_, static_cast<std::uint32_t>(id),
                                             positions + id * dimension_),
                    "deldrift_relocate_vertex");
    }

    std::vector<std::uint32_t> cells() override {
        deldrift_cells_view view;
        require(deldrift_cells(triangulation_, &view), "deldrift_cells");
        if (view.count == 0) return {};
        return {view.vertices, view.vertices + view.count * view.corners_per_cell};
    }

    void validate() override { require(deldrift_validate(triangulation_, full_validation), "deldrift_validate"); }

    std::size_t reported_bytes() const override {
        std::size_t bytes = 0;
        require(deldrift_memory_bytes(triangulation_, &bytes), "deldrift_memory_bytes");
        return bytes;
    }

    Counts counts() const override {
        deldrift_commit_report sums;
        require(deldrift_statistics(triangulation_, &sums), "deldrift_statistics");
        return {sums.flips + sums.placements + sums.rebuilds, sums.within_tolerance};
    }

protected:
    bool is_built() const { return triangulation_ != nullptr; }

    void stage(const double *positions) {
        require(deldrift_move_vertices(triangulation_, nullptr, positions, n_points_), "deldrift_move_vertices");
    }

    void commit() { require(deldrift_commit_timestamp(triangulation_, nullptr), "deldrift_commit_timestamp"); }

private:
    /// What the report calls pre-computations, of tolerances and delimiters, is done by the first commit.
    void pre_compute() {
        if (options_.algorithm == DELDRIFT_TOLERANCE || options_.algorithm == DELDRIFT_SAFE_REGION ||
            options_.algorithm == DELDRIFT_SAFE_REGION_TOLERANCE)
            commit();
    }

    unsigned dimension_;
    deldrift_options options_;
    deldrift_triangulation *triangulation_ = nullptr;
    std::size_t n_points_ = 0;
    bool rebuilds_ = false;
};

/// Stages before the clock starts. A build forgets what is staged.
class StagedDeldrift final : public Deldrift {
public:
    using Deldrift::Deldrift;

    void prepare(const double *positions, std::size_t) override {
        if (is_built()) stage(positions);
    }

    void advance(const double *) override { commit(); }
};

}  // namespace

EngineMaker deldrift_staged_by(deldrift_algorithm algorithm) {
    return [algorithm](unsigned dimension, unsigned n_threads) {
        return std::make_unique<StagedDeldrift>(dimension, algorithm, n_threads);
    };
}

EngineMaker deldrift_by(deldrift_algorithm algorithm) {
    return [algorithm](unsigned dimension, unsigned n_threads) {
        return std::make_unique<Deldrift>(dimension, algorithm, n_threads);
    };
}

}  // namespace bench
