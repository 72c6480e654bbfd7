// Lloyd's iteration and ODT smoothing, in a disk and in a ball, from random points: how good the cells become.
//
//   smoothing [iterations [picture.svg]]
#include "smoothing.hpp"
#include "svg.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

// Mean quality, and the one that a hundredth of the cells are below.
struct Quality {
    double mean, low;
};

template <int d>
Quality quality_of(const Smoothing<d> &smoothing) {
    std::vector<double> qualities = smoothing.qualities();
    std::sort(qualities.begin(), qualities.end());
    double sum = 0;
    for (const double quality : qualities) sum += quality;
    return {sum / static_cast<double>(qualities.size()), qualities[qualities.size() / 100]};
}

void draw(Picture &picture, const Smoothing<2> &smoothing, const std::string &caption) {
    picture.panel(caption);
    const std::vector<double> qualities = smoothing.qualities();
    const auto place = [&](std::uint32_t v) { return smoothing.positions().col(v).data(); };
    std::size_t c = 0;
    for (const auto cell : smoothing.cells())
        picture.triangle(1 - qualities[c++], place(cell[0]), place(cell[1]), place(cell[2]));
}

// Whether both schemes have made the cells better.
template <int d>
bool smooth(int n_inside, int n_iterations, Picture *picture) {
    const Smoothing<d> random(n_inside);
    if constexpr (d == 2) draw(*picture, random, "random points");
    const Quality before = quality_of(random);
    std::printf("%dD, %td vertices    mean quality %.3f, a hundredth below %.3f\n", d, random.positions().cols(),
                before.mean, before.low);
    bool are_better = true;
    for (const Scheme scheme : {Scheme::lloyd, Scheme::odt}) {
        const char *name = scheme == Scheme::lloyd ? "Lloyd" : "ODT";
        Smoothing<d> smoothing(n_inside);
        for (int i = 0; i < n_iterations; i++) smoothing.step(scheme);
        const Quality after = quality_of(smoothing);
        std::printf("  %3d times %-5s      mean quality %.3f, a hundredth below %.3f\n", n_iterations, name, after.mean,
                    after.low);
        are_better &= after.mean > before.mean && after.low > before.low;
        if constexpr (d == 2) draw(*picture, smoothing, std::to_string(n_iterations) + " times " + name);
    }
    return are_better;
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int n_iterations = n_arguments > 1 ? std::atoi(arguments[1]) : 60;
    Picture picture({-1, -1}, {1, 1}, 320, 3, "quality 1: equilateral", "0: flat");
    const bool are_better = smooth<2>(800, n_iterations, &picture) & smooth<3>(1000, n_iterations, nullptr);
    const bool is_drawn = n_arguments <= 2 || picture.save(arguments[2]);
    return are_better && is_drawn ? 0 : 1;
}
