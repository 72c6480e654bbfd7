// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL, one vertex after another: by placement (insert at the new place, remove the old vertex) or by CGAL's
// own `move_if_no_collision`.
//
// CGAL holds one vertex per place. Points at the same place therefore share a vertex that counts them,
// and every point knows its vertex. A point that leaves a shared vertex is inserted again and the
// vertex stays; a point that lands on an occupied place joins the vertex there, and its own vertex
// goes when it was the last one at it. This also covers a place that is occupied only until its
// occupant has been moved at the same timestamp.
#include "cgal_reading.hpp"
#include "cgal_space.hpp"
#include "engine.hpp"

namespace bench {
namespace {

template <unsigned dimension>
class CgalRelocating : public Engine {
protected:
    using Space = CgalSpace<dimension>;
    using Point = typename Space::Point;
    using Vertex = typename Space::Vertex;
    using InputPoint = typename Space::InputPoint;

public:
    void build(const double *positions, std::size_t n_points) final {
        std::vector<InputPoint> input = input_points<dimension>(positions, n_points);
        triangulation_.clear();
        insert_range<dimension>(triangulation_, input);
        find_vertices(input);
    }

    void advance(const double *positions) final {
        for (std::size_t id = 0; id < vertices_.size(); ++id) {
            const Point place = Space::point(positions + id * dimension);
            if (vertices_[id]->point() != place) vertices_[id] = relocate(vertices_[id], place);
        }
    }

    Reading read() final {
        name_vertices();
        return reading_.write(triangulation_);
    }

    double visit(std::uint32_t id, const double *place) final {
        double sum = 0;
        Space::for_each_cell_at(triangulation_, vertices_[id], cells_at_, [&](const auto &cell) {
            for (unsigned corner = 0; corner <= dimension; ++corner)
                for (unsigned axis = 0; axis < dimension; ++axis)
                    sum += cell->vertex(static_cast<int>(corner))->point()[static_cast<int>(axis)];
        });
        vertices_[id] = relocate(vertices_[id], Space::point(place));
        return sum;
    }

    std::vector<std::uint32_t> cells() final {
        name_vertices();
        return cell_ids<dimension>(triangulation_);
    }

protected:
    /// One point goes from its vertex to another place; the vertex it then belongs to.
    virtual Vertex relocate(Vertex old, const Point &place) = 0;

    Vertex join(Vertex vertex) {
        ++vertex->info().n_sharers;
        return vertex;
    }

    void leave(Vertex vertex) {
        if (--vertex->info().n_sharers == 0) triangulation_.remove(vertex);
    }

    typename Space::Triangulation triangulation_;

private:
    /// A vertex that was inserted has no id yet, and one that is shared may have that of a point that has left.
    void name_vertices() {
        for (std::size_t id = 0; id < vertices_.size(); ++id)
            vertices_[id]->info().id = static_cast<std::uint32_t>(id);
    }

    /// The vertex of every point: its own where it has one, that of its place where points coincide.
    void find_vertices(const std::vector<InputPoint> &input) {
        vertices_.assign(input.size(), Vertex());
        for (auto vertex = triangulation_.finite_vertices_begin(); vertex != triangulation_.finite_vertices_end();
             ++vertex)
            vertices_[vertex->info().id] = vertex;
        for (const auto &[point, info] : input) {
            Vertex &vertex = vertices_[info.id];
            if (vertex == Vertex()) vertex = triangulation_.insert(point);
            join(vertex);
        }
    }

    std::vector<Vertex> vertices_;
    std::vector<typename Space::Cell> cells_at_;
    CgalReading<dimension> reading_;
};

template <unsigned dimension>
class CgalPlacement final : public CgalRelocating<dimension> {
    using typename CgalRelocating<dimension>::Space;
    using typename CgalRelocating<dimension>::Point;
    using typename CgalRelocating<dimension>::Vertex;

    Vertex relocate(Vertex old, const Point &place) override {
        const Vertex vertex = this->join(this->triangulation_.insert(place, Space::hint(old)));
        this->leave(old);
        return vertex;
    }
};

template <unsigned dimension>
class CgalMove final : public CgalRelocating<dimension> {
    using typename CgalRelocating<dimension>::Space;
    using typename CgalRelocating<dimension>::Point;
    using typename CgalRelocating<dimension>::Vertex;

    Vertex relocate(Vertex old, const Point &place) override {
        const bool is_shared = old->info().n_sharers > 1;
        const Vertex vertex = is_shared ? this->triangulation_.insert(place, Space::hint(old))
                                        : this->triangulation_.move_if_no_collision(old, place);
        if (vertex != old) {
            this->join(vertex);
            this->leave(old);
        }
        return vertex;
    }
};

template <template <unsigned> class Kind>
std::unique_ptr<Engine> make(unsigned dimension) {
    if (dimension == 2) return std::make_unique<Kind<2>>();
    return std::make_unique<Kind<3>>();
}

}  // namespace

std::unique_ptr<Engine> make_cgal_placement(unsigned dimension, unsigned) { return make<CgalPlacement>(dimension); }

std::unique_ptr<Engine> make_cgal_move(unsigned dimension, unsigned) { return make<CgalMove>(dimension); }

}  // namespace bench
