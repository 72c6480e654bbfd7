// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL, rebuilt at each timestamp: a spatial sort and one insertion after another.
#include "cgal_reading.hpp"
#include "cgal_space.hpp"
#include "engine.hpp"

namespace bench {
namespace {

template <unsigned dimension>
class CgalRebuilding final : public Engine {
    using Space = CgalSpace<dimension>;

public:
    void prepare(const double *positions, std::size_t n_points) override {
        input_ = input_points<dimension>(positions, n_points);
    }

    void build(const double *, std::size_t) override { rebuild(); }

    void advance(const double *) override { rebuild(); }

    Reading read() override { return reading_.write(triangulation_); }

    std::vector<std::uint32_t> cells() override { return cell_ids<dimension>(triangulation_); }

private:
    void rebuild() {
        triangulation_.clear();
        insert_range<dimension>(triangulation_, input_);
    }

    std::vector<typename Space::InputPoint> input_;
    typename Space::Triangulation triangulation_;
    CgalReading<dimension> reading_;
};

}  // namespace

std::unique_ptr<Engine> make_cgal_rebuilding(unsigned dimension, unsigned) {
    if (dimension == 2) return std::make_unique<CgalRebuilding<2>>();
    return std::make_unique<CgalRebuilding<3>>();
}

}  // namespace bench
