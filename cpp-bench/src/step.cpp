// SPDX-License-Identifier: GPL-3.0-or-later
#include "step.hpp"

#include <stdexcept>
#include <utility>

namespace bench {
namespace {

class Stepping final : public Engine {
public:
    Stepping(unsigned dimension, std::unique_ptr<Engine> real) : dimension_(dimension), real_(std::move(real)) {
        real_->expect_readings();
    }

    void prepare(const double *positions, std::size_t n_points) override { real_->prepare(positions, n_points); }

    void build(const double *positions, std::size_t n_points) override {
        real_->build(positions, n_points);
        reading_ = real_->read();
        complaint_.clear();
        if (is_examined_) carried_.begin(dimension_, reading_);
    }

    void advance(const double *positions) override {
        reading_ = real_->step(positions);
        if (is_examined_) examine();
    }

    /// Vertices move one after another, and are read together.
    void advance_sequentially(const double *positions) override {
        real_->advance_sequentially(positions);
        reading_ = real_->read();
        if (is_examined_) examine();
    }

    void be_examined() override { is_examined_ = true; }

    void validate() override {
        real_->validate();
        if (!complaint_.empty()) throw std::runtime_error(complaint_);
        require_consistent(dimension_, reading_);
    }

    std::vector<std::uint32_t> cells() override {
        return {reading_.vertices, reading_.vertices + reading_.n_cells * (dimension_ + 1)};
    }

    std::size_t reported_bytes() const override { return real_->reported_bytes(); }

    Counts counts() const override { return real_->counts(); }

private:
    void examine() {
        if (reading_.changes == nullptr || !complaint_.empty()) return;
        try {
            carried_.follow(reading_);
        } catch (const std::runtime_error &error) {
            complaint_ = error.what();
        }
    }

    unsigned dimension_;
    std::unique_ptr<Engine> real_;
    Reading reading_;
    bool is_examined_ = false;
    CarriedData carried_;
    std::string complaint_;
};

}  // namespace

EngineKind step_of(const EngineKind &kind) {
    EngineKind step = kind;
    step.is_step = true;
    step.make = [make = kind.make](unsigned dimension, unsigned n_threads) {
        return std::make_unique<Stepping>(dimension, make(dimension, n_threads));
    };
    return step;
}

const std::vector<EngineKind> &step_kinds() {
    static const std::vector<EngineKind> kinds = [] {
        std::vector<EngineKind> steps;
        for (const char *name :
             {"cgal/rebuilding", "deldrift/rebuilding", "deldrift/repair", "deldrift/auto"})
            steps.push_back(step_of(engine_kind(name)));
        return steps;
    }();
    return kinds;
}

const EngineKind &step_kind(const std::string &name) {
    for (const EngineKind &kind : step_kinds())
        if (kind.base_name() == name) return kind;
    throw std::runtime_error("no step is that of " + name);
}

}  // namespace bench
