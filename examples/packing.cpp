// A packing: discs of three sizes in a square grow, all by one factor, and push each other away, until they touch and
// have no room to grow by a little more.
//
// The weights are the squares of the radii, and grow with them. Who may touch whom is known from the regular
// triangulation: the place where two discs touch has power 0 in respect of both, and more in respect of all discs that it
// is outside of. So while no discs overlap those that touch are neighbours, however their sizes differ; without weights
// they need not be. Where they overlap, a disc that others cover can be hidden: it has no neighbours, and is pushed out of
// the cell that it is above.
//
//   packing [discs [picture.svg]]
#include "svg.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

using Place = std::array<double, 2>;

constexpr double pi = 3.14159265358979323846;
// What discs may overlap by, as a part of the smaller radius, and within which they touch.
constexpr double tolerance = 1e-4, touching = 1e-3;
// The part of its last way that a disc goes on by, so that pushes are soon felt far off.
constexpr double inertia = 0.9;
// Pushes after which a factor is found to be too great.
constexpr int patience = 400;

struct Packing {
    std::vector<Place> places;
    std::vector<double> sizes;
    double factor;
    std::vector<Place> last;  // where each disc went at the last push
    deldrift::Triangulation t;
    std::vector<std::uint32_t> edges;
    deldrift_commit_report report;
    int commits = 0;

    Packing(std::vector<Place> places, std::vector<double> sizes, double factor)
        : places(std::move(places)), sizes(std::move(sizes)), factor(factor),
          last(this->places.size()), t(2, this->places, deldrift::Weights{weights()}), edges(t.edges()),
          report(t.statistics()) {}

    double radius(std::uint32_t v) const { return factor * sizes[v]; }

    std::vector<double> weights() const {
        std::vector<double> weights;
        for (const double size : sizes) weights.push_back(factor * size * factor * size);
        return weights;
    }

    void commit() {
        report = t.commit_weighted(places, weights());
        edges = t.edges();
        commits++;
    }

    double apart(std::uint32_t v, std::uint32_t w) const {
        return std::hypot(places[v][0] - places[w][0], places[v][1] - places[w][1]);
    }

    double overlap(std::uint32_t v, std::uint32_t w) const { return radius(v) + radius(w) - apart(v, w); }

    double covered() const {
        double area = 0;
        for (const double weight : weights()) area += pi * weight;
        return area;
    }
};

// Pushes v away from w, by a share of what they overlap by.
void push(const Packing &p, std::vector<Place> &pushes, std::uint32_t v, std::uint32_t w, double share) {
    const double apart = p.apart(v, w), by = share * p.overlap(v, w);
    for (int k = 0; k < 2; k++) pushes[v][k] += apart > 0 ? by * (p.places[v][k] - p.places[w][k]) / apart : by * k;
}

// One push of all that overlap; by how much they did, beside the smaller radius.
double spread(Packing &p) {
    double worst = 0;
    std::vector<Place> pushes(p.places.size());
    for (std::size_t i = 0; i < p.edges.size(); i += 2) {
        const std::uint32_t v = p.edges[i], w = p.edges[i + 1];
        if (p.overlap(v, w) <= 0) continue;
        worst = std::max(worst, p.overlap(v, w) / std::min(p.radius(v), p.radius(w)));
        push(p, pushes, v, w, 0.5);
        push(p, pushes, w, v, 0.5);
    }
    // The report of the commit has told whether any are hidden.
    if (p.report.hidden_by_weight > 0) {
        const deldrift::Cells cells = p.t.cells();
        const deldrift::HiddenByWeight hidden = p.t.hidden_by_weight();
        for (std::size_t k = 0; k < hidden.size(); k++) {
            const std::uint32_t v = hidden.vertices[k];
            const deldrift::Row corners = cells[hidden.cells[k]];
            const auto deeper = [&](std::uint32_t a, std::uint32_t b) { return p.overlap(v, a) < p.overlap(v, b); };
            push(p, pushes, v, *std::max_element(corners.begin(), corners.end(), deeper), 0.5);
            worst = std::max(worst, 1.0);
        }
    }
    for (std::uint32_t v = 0; v < p.places.size(); v++) {
        for (int k = 0; k < 2; k++) {
            const double from = p.places[v][k], pushed = from + pushes[v][k] + inertia * p.last[v][k];
            p.places[v][k] = std::clamp(pushed, p.radius(v), 1 - p.radius(v));
            p.last[v][k] = p.places[v][k] - from;
        }
    }
    p.commit();
    return worst;
}

bool come_apart(Packing &p) {
    for (int k = 0; k < patience; k++) {
        if (spread(p) < tolerance) return true;
    }
    return false;
}

// The greatest factor for which no neighbours overlap, and no disc leaves the square.
double greatest_factor(const Packing &p) {
    double factor = 1;
    for (std::size_t i = 0; i < p.edges.size(); i += 2) {
        const std::uint32_t v = p.edges[i], w = p.edges[i + 1];
        factor = std::min(factor, p.apart(v, w) / (p.sizes[v] + p.sizes[w]));
    }
    for (std::uint32_t v = 0; v < p.places.size(); v++) {
        for (const double x : p.places[v]) factor = std::min(factor, std::min(x, 1 - x) / p.sizes[v]);
    }
    return factor;
}

void draw(Picture &picture, const Packing &p, const std::vector<int> &contacts, const std::string &caption) {
    picture.panel(caption);
    for (std::uint32_t v = 0; v < p.places.size(); v++) {
        std::array<Place, 24> rim;
        std::vector<const double *> corners;
        for (std::size_t k = 0; k < rim.size(); k++) {
            const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(rim.size());
            rim[k] = {p.places[v][0] + p.radius(v) * std::cos(angle), p.places[v][1] + p.radius(v) * std::sin(angle)};
            corners.push_back(rim[k].data());
        }
        picture.polygon(contacts[v] / 8.0 + 0.01, corners);
    }
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int count = n_arguments > 1 ? std::atoi(arguments[1]) : 300;
    std::mt19937 random(1);
    const auto next = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<double> sizes;
    double area = 0;
    for (int k = 0; k < count; k++) {
        sizes.push_back(k % 6 == 0 ? 1 : k % 6 < 3 ? 0.5 : 0.3);
        area += pi * sizes.back() * sizes.back();
    }
    // At first discs of half of the square in all, wherever they are.
    const double factor = std::sqrt(0.5 / area);
    std::vector<Place> places;
    for (const double size : sizes) {
        const double radius = factor * size, room = 1 - 2 * radius, x = next();
        places.push_back({radius + room * x, radius + room * next()});
    }
    Packing p(places, sizes, factor);
    Picture picture({0, 0}, {1, 1}, 380, 2, "touches none", "seven or more");
    std::printf("%d discs at random: %d are hidden\n", count, static_cast<int>(p.report.hidden_by_weight));
    std::vector<int> contacts(p.places.size());
    for (const std::uint32_t v : p.t.hidden_by_weight().vertices) contacts[v] = 7;
    draw(picture, p, contacts, "at random: dark discs are hidden");
    while (p.report.hidden_by_weight > 0) spread(p);
    std::printf("%d commits later none is\n", p.commits);
    if (!come_apart(p)) return 1;

    for (double growth = 0.02; growth > 1e-5;) {
        const std::vector<Place> before = p.places;
        const double factor = p.factor;
        p.factor *= 1 + growth;
        if (come_apart(p)) continue;
        growth /= 2;
        p.places = before;
        p.factor = factor;
        p.commit();
    }
    p.factor = greatest_factor(p);
    p.commit();

    // All pairs, neighbours or not: none overlap, and those that touch are neighbours.
    int n_touching = 0, n_overlapping = 0, n_others = 0;
    for (std::uint32_t v = 0; v < p.places.size(); v++) {
        contacts[v] = 0;
        for (const double x : p.places[v]) contacts[v] += std::min(x, 1 - x) < (1 + touching) * p.radius(v);
    }
    std::vector<std::array<std::uint32_t, 2>> neighbours;
    for (std::size_t i = 0; i < p.edges.size(); i += 2) neighbours.push_back({p.edges[i], p.edges[i + 1]});
    for (std::uint32_t v = 0; v < p.places.size(); v++) {
        for (std::uint32_t w = v + 1; w < p.places.size(); w++) {
            n_overlapping += p.overlap(v, w) > 1e-12;
            if (p.overlap(v, w) < -touching * std::min(p.radius(v), p.radius(w))) continue;
            n_touching++;
            contacts[v]++;
            contacts[w]++;
            n_others += !std::binary_search(neighbours.begin(), neighbours.end(), std::array<std::uint32_t, 2>{v, w});
        }
    }
    const auto n_loose = std::count_if(contacts.begin(), contacts.end(), [](int n) { return n < 2; });
    draw(picture, p, contacts, "grown until they touch");
    std::printf("%d commits: discs cover %.4f of the square; %d pairs touch, %d discs have less than two contacts\n",
                p.commits, p.covered(), n_touching, static_cast<int>(n_loose));
    std::printf("of all pairs %d overlap, and %d touch that are no neighbours\n", n_overlapping, n_others);
    if (n_arguments > 2 && !picture.save(arguments[2])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[2]);
        return 1;
    }
    return n_overlapping == 0 && n_others == 0 && p.report.hidden_by_weight == 0 ? 0 : 1;
}
