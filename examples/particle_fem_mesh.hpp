// The mesh of particle_fem.hpp, from deldrift: one commit moves, inserts and removes particles, and the change list
// says which data of cells to pass on.
#pragma once

#include "particle_fem.hpp"

#include <deldrift.hpp>

class DeldriftMesh {
public:
    explicit DeldriftMesh(const Eigen::Matrix2Xd &x) : t_(2, x, one_thread()), changes_(t_.take_changes()) {}

    CellArrays cells() const {
        const deldrift::Cells cells = t_.cells();
        return {cells.size(), cells.vertices().data(), cells.neighbours().data()};
    }

    // New columns are inserted: ids count up, as columns do.
    void advance(const Eigen::Matrix2Xd &x, const Ids &leaving) {
        const std::size_t n = t_.id_count();
        t_.stage_removals(leaving);
        const deldrift::span<const double> coming(x.data() + 2 * n, static_cast<std::size_t>(x.size()) - 2 * n);
        t_.stage_insertions(coming);
        t_.commit_positions(x);
        changes_ = t_.take_changes();
    }

    // Data of cells that are gone go to their vertices, and new cells take the average of what is at theirs.
    void carry(std::vector<double> &data) {
        const CellArrays now = cells();
        std::vector<double> kept(changes_.renumbered_count);
        sums_.resize(t_.id_count(), 0), counts_.resize(t_.id_count(), 0);
        for (std::size_t k = 0; k < changes_.removed_count; k++)
            for (std::size_t i = 0; i < 3; i++) {
                sums_[changes_.removed_vertices[3 * k + i]] += data[changes_.removed[k]];
                counts_[changes_.removed_vertices[3 * k + i]]++;
            }
        // All old indices are read before a new one is written.
        for (std::size_t k = 0; k < kept.size(); k++) kept[k] = data[changes_.renumbered_from[k]];
        data.resize(now.count);
        for (std::size_t k = 0; k < kept.size(); k++) data[changes_.renumbered_to[k]] = kept[k];
        for (std::size_t k = 0; k < changes_.created_count; k++) {
            const std::uint32_t *v = now.vertices + 3 * changes_.created[k];
            const double sum = sums_[v[0]] + sums_[v[1]] + sums_[v[2]];
            const int count = counts_[v[0]] + counts_[v[1]] + counts_[v[2]];
            data[changes_.created[k]] = count > 0 ? sum / count : 0;
        }
        for (std::size_t k = 0; k < changes_.star_count; k++) sums_[changes_.stars[k]] = counts_[changes_.stars[k]] = 0;
    }

    void mask(double radius, std::vector<std::uint8_t> &mask) const {
        mask = t_.mask_by_circumradius(radius * radius);
    }

    // Pairs of vertices.
    void boundary(const std::vector<std::uint8_t> &mask, Ids &facets) const {
        facets = t_.mask_boundary(mask).vertices;
    }

private:
    static deldrift_options one_thread() {
        deldrift_options options = deldrift::default_options();
        options.threads = 1;
        return options;
    }

    deldrift::Triangulation t_;
    deldrift_changes changes_;
    std::vector<double> sums_;  // by vertex, zero between steps
    std::vector<int> counts_;
};
