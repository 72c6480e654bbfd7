// SPDX-License-Identifier: GPL-3.0-or-later
// deldrift through its C interface: commit all positions.
#include "engine.hpp"
#include "library.hpp"

#include <algorithm>

namespace bench {
namespace {

/// Everything: indices, adjacency, orientation and hull, empty spheres.
constexpr std::uint32_t full_validation = 3;

class Deldrift : public Engine {
public:
    Deldrift(unsigned dimension, const Algorithm &algorithm, unsigned n_threads)
        : dimension_(dimension), algorithm_(algorithm), n_threads_(n_threads) {}
    Deldrift(const Deldrift &) = delete;
    Deldrift &operator=(const Deldrift &) = delete;
    ~Deldrift() override { deldrift_destroy(triangulation_); }

    void build(const double *positions, std::size_t n_points) override {
        deldrift_destroy(triangulation_);
        triangulation_ = nullptr;
        n_points_ = n_points;
        positions_.clear();
        rebuilds_ =
            algorithm_.code == DELDRIFT_REBUILDING || algorithm_.code == DELDRIFT_RESEARCH_REBUILDING_TOLERANCE;
        triangulation_ = create_by(algorithm_, dimension_, positions, n_points, n_threads_);
        pre_compute();
    }

    void advance(const double *positions) override {
        advance_all(positions, nullptr);
    }

    void advance_sequentially(const double *positions) override {
        if (rebuilds_) {
            deldrift_commit_report report;
            advance_all(positions, &report);
            // Rebuilding and tolerance relocates one by one as soon as it has turned to tolerances.
            rebuilds_ = algorithm_.code == DELDRIFT_REBUILDING || report.rebuilds > 0;
            return;
        }
        for (std::size_t id = 0; id < n_points_; ++id)
            require(deldrift_relocate_vertex(triangulation_, static_cast<std::uint32_t>(id),
                                             positions + id * dimension_),
                    "deldrift_relocate_vertex");
    }

    void expect_readings() override { is_read_ = true; }

    /// The changes first: to take them ends all views.
    Reading read() override {
        if (is_read_) require(deldrift_take_changes(triangulation_, &changes_), "deldrift_take_changes");
        deldrift_cells_view view;
        require(deldrift_cells(triangulation_, &view), "deldrift_cells");
        return {view.count, view.vertices, view.neighbours, is_read_ ? &changes_ : nullptr};
    }

    double visit(std::uint32_t vertex, const double *place) override {
        if (positions_.empty()) copy_positions();
        const double sum = sum_of_star(vertex);
        std::copy(place, place + dimension_, &positions_[std::size_t{vertex} * dimension_]);
        require(deldrift_relocate_vertex(triangulation_, vertex, place), "deldrift_relocate_vertex");
        return sum;
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
    void advance_all(const double *positions, deldrift_commit_report *report) {
        require(deldrift_commit_positions(triangulation_, positions, n_points_, report), "deldrift_commit_positions");
    }

    /// The places that a program has of its own.
    void copy_positions() {
        std::size_t count = 0;
        positions_.resize(n_points_ * dimension_);
        require(deldrift_copy_positions(triangulation_, positions_.data(), n_points_, &count),
                "deldrift_copy_positions");
    }

    double sum_of_star(std::uint32_t vertex) {
        std::size_t n_cells = 0;
        deldrift_status status = deldrift_star(triangulation_, vertex, star_.data(), star_.size(), &n_cells);
        if (status == DELDRIFT_BUFFER_TOO_SMALL) {
            star_.resize(2 * n_cells);
            status = deldrift_star(triangulation_, vertex, star_.data(), star_.size(), &n_cells);
        }
        require(status, "deldrift_star");
        deldrift_cells_view view;
        require(deldrift_cells(triangulation_, &view), "deldrift_cells");
        double sum = 0;
        for (std::size_t i = 0; i < n_cells; ++i) {
            const std::uint32_t *row = view.vertices + std::size_t{star_[i]} * (dimension_ + 1);
            for (unsigned corner = 0; corner <= dimension_; ++corner)
                for (unsigned axis = 0; axis < dimension_; ++axis)
                    sum += positions_[std::size_t{row[corner]} * dimension_ + axis];
        }
        return sum;
    }

    /// What the report calls pre-computations, of tolerances and delimiters, is done by the first commit.
    void pre_compute() {
        if (algorithm_.is_one_by_one && algorithm_.keeps_data) commit();
    }

    unsigned dimension_;
    Algorithm algorithm_;
    unsigned n_threads_;
    deldrift_triangulation *triangulation_ = nullptr;
    std::size_t n_points_ = 0;
    bool rebuilds_ = false;
    bool is_read_ = false;
    deldrift_changes changes_{};
    std::vector<double> positions_;
    std::vector<std::uint32_t> star_ = std::vector<std::uint32_t>(64);
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

EngineMaker deldrift_staged_by(const Algorithm &algorithm) {
    return [algorithm](unsigned dimension, unsigned n_threads) {
        return std::make_unique<StagedDeldrift>(dimension, algorithm, n_threads);
    };
}

EngineMaker deldrift_by(const Algorithm &algorithm) {
    return [algorithm](unsigned dimension, unsigned n_threads) {
        return std::make_unique<Deldrift>(dimension, algorithm, n_threads);
    };
}

}  // namespace bench
