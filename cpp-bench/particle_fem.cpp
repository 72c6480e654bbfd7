// SPDX-License-Identifier: GPL-3.0-or-later
// The dam break of examples/particle_fem.hpp with two meshes at once: deldrift, and CGAL rebuilding, where a hash table
// tells which cells are still there. After each step the free surfaces must be the same, then CGAL's run goes on from
// deldrift's positions, velocities and pressures.
//
//   particle_fem_cgal [time [spacing]]
#include "particle_fem_cells.hpp"

#include "../examples/particle_fem_mesh.hpp"
#include "src/cgal_reading.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

/// Cells by the ids of their vertices: open addressing, at most half full.
class CellTable {
public:
    using Key = std::array<std::uint32_t, 3>;

    void fill(const CellArrays &cells) {
        std::size_t room = 16;
        while (room < 2 * cells.count) room *= 2;
        entries_.assign(room, {{}, DELDRIFT_NONE});
        for (std::uint32_t c = 0; c < cells.count; c++) {
            const Key key = key_of(cells.vertices + 3 * c);
            entries_[find(key)] = {key, c};
        }
    }

    std::uint32_t operator[](const std::uint32_t *vertices) const { return entries_[find(key_of(vertices))].cell; }

private:
    struct Entry {
        Key key;
        std::uint32_t cell;
    };

    static Key key_of(const std::uint32_t *v) {
        const std::uint32_t low = std::min({v[0], v[1], v[2]}), high = std::max({v[0], v[1], v[2]});
        return {low, v[0] ^ v[1] ^ v[2] ^ low ^ high, high};
    }

    /// Where the key is, or the free place where it belongs.
    std::size_t find(const Key &key) const {
        std::uint64_t hash = (key[0] * 0x9E3779B97F4A7C15u ^ key[1]) * 0x9E3779B97F4A7C15u ^ key[2];
        hash *= 0x9E3779B97F4A7C15u;
        std::size_t at = (hash >> 20) & (entries_.size() - 1);
        while (entries_[at].cell != DELDRIFT_NONE && entries_[at].key != key) at = (at + 1) & (entries_.size() - 1);
        return at;
    }

    std::vector<Entry> entries_;
};

class CgalMesh {
    using Space = bench::CgalSpace<2>;

public:
    explicit CgalMesh(const Eigen::Matrix2Xd &x) : is_present_(static_cast<std::size_t>(x.cols()), 1) {
        rebuild(x);
        table_.fill(cells_);
    }

    CellArrays cells() const { return cells_; }

    void advance(const Eigen::Matrix2Xd &x, const Ids &leaving) {
        is_present_.resize(static_cast<std::size_t>(x.cols()), 1);
        for (const std::uint32_t v : leaving) is_present_[v] = 0;
        rows_before_.assign(cells_.vertices, cells_.vertices + 3 * cells_.count);
        rebuild(x);
    }

    void carry(std::vector<double> &data) {
        std::vector<double> now(cells_.count);
        is_kept_.assign(data.size(), 0), created_.clear();
        sums_.assign(is_present_.size(), 0), counts_.assign(is_present_.size(), 0);
        for (std::uint32_t c = 0; c < cells_.count; c++) {
            const std::uint32_t before = table_[cells_.vertices + 3 * c];
            if (before == DELDRIFT_NONE) {
                created_.push_back(c);
            } else {
                now[c] = data[before], is_kept_[before] = 1;
            }
        }
        for (std::size_t c = 0; c < data.size(); c++) {
            for (std::size_t i = 0; !is_kept_[c] && i < 3; i++)
                sums_[rows_before_[3 * c + i]] += data[c], counts_[rows_before_[3 * c + i]]++;
        }
        for (const std::uint32_t c : created_) {
            const std::uint32_t *v = cells_.vertices + 3 * c;
            const int count = counts_[v[0]] + counts_[v[1]] + counts_[v[2]];
            now[c] = count > 0 ? (sums_[v[0]] + sums_[v[1]] + sums_[v[2]]) / count : 0;
        }
        data.swap(now);
        table_.fill(cells_);
    }

    void mask(double radius, std::vector<std::uint8_t> &mask) const { mask_of(positions_, cells_, radius, mask); }
    void boundary(const std::vector<std::uint8_t> &mask, Ids &facets) const { boundary_of(cells_, mask, facets); }

private:
    void rebuild(const Eigen::Matrix2Xd &x) {
        input_.clear();
        for (std::uint32_t v = 0; v < x.cols(); v++)
            if (is_present_[v]) input_.emplace_back(Space::point(x.col(v).data()), bench::VertexInfo{v, 0});
        triangulation_.clear();
        bench::insert_range<2>(triangulation_, input_);
        const bench::Reading reading = reading_.write(triangulation_);
        cells_ = {reading.n_cells, reading.vertices, reading.neighbours};
        positions_ = x.data();
    }

    std::vector<char> is_present_, is_kept_;
    std::vector<Space::InputPoint> input_;
    Space::Triangulation triangulation_;
    bench::CgalReading<2> reading_;
    CellArrays cells_{};
    CellTable table_;
    Ids rows_before_, created_;
    std::vector<double> sums_;
    std::vector<int> counts_;
    const double *positions_ = nullptr;
};

using Facets = std::vector<std::array<std::uint32_t, 2>>;

Facets sorted(const Ids &surface) {
    Facets facets;
    for (std::size_t k = 0; k < surface.size(); k += 2) facets.push_back({surface[k], surface[k + 1]});
    std::sort(facets.begin(), facets.end());
    return facets;
}

/// Of the strain, over the fluid.
template <class Mesh>
double integral(const DamBreak<Mesh> &dam) {
    double sum = 0;
    for (std::size_t c = 0; c < dam.f.strain.size(); c++)
        if (dam.f.is_fluid[c]) sum += dam.f.strain[c] * Element(dam.f.x, dam.mesh.cells().vertices + 3 * c).area;
    return sum;
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const double end = n_arguments > 1 ? std::atof(arguments[1]) : 1.5;
    const double spacing = n_arguments > 2 ? std::atof(arguments[2]) : 1.0 / 70;
    DamBreak<DeldriftMesh> ours(spacing);
    DamBreak<CgalMesh> theirs(spacing);
    int n_steps = 0;
    for (; ours.time < end; n_steps++) {
        ours.step();
        theirs.step();
        if (sorted(ours.surface) != sorted(theirs.surface) || ours.f.is_present != theirs.f.is_present) {
            std::fprintf(stderr, "step %d: another free surface\n", n_steps);
            return 1;
        }
        theirs.f.x = ours.f.x, theirs.f.u = ours.f.u, theirs.f.p = ours.f.p;
    }
    const double strain = integral(ours), strain_there = integral(theirs);
    if (std::fabs(strain - strain_there) > 1e-6 * strain) {
        std::fprintf(stderr, "strain %.17g, with CGAL %.17g\n", strain, strain_there);
        return 1;
    }
    const double n_visits = static_cast<double>(ours.n_visits) / 1e9;
    std::printf("%td vertices, %d steps, %zu came, %zu left; same free surface after each step\n",
                ours.f.x.cols() - static_cast<std::ptrdiff_t>(ours.n_left), n_steps, ours.n_came, ours.n_left);
    std::printf("ns per vertex and step        CGAL  deldrift\n");
    std::printf("mesh                       %7.0f   %7.0f   %.2f times as fast\n", theirs.mesh_seconds / n_visits,
                ours.mesh_seconds / n_visits, theirs.mesh_seconds / ours.mesh_seconds);
    std::printf("whole loop                 %7.0f   %7.0f   %.2f times as fast\n", theirs.seconds / n_visits,
                ours.seconds / n_visits, theirs.seconds / ours.seconds);
    return 0;
}
