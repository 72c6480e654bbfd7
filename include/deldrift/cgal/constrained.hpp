// Constrained_Delaunay_triangulation_2: see cgal.hpp.
#ifndef DELDRIFT_CGAL_CONSTRAINED_HPP
#define DELDRIFT_CGAL_CONSTRAINED_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plane.hpp"

namespace deldrift::cgal {

template <class Tr, class Crit>
class Delaunay_mesher_2;
template <class Tr>
class Triangulation_conformer_2;

// What becomes of constraints that cross: an exception, or a vertex at the place, rounded.
struct No_constraint_intersection_tag {};
struct No_constraint_intersection_requiring_constructions_tag {};
struct Exact_predicates_tag {};

namespace detail {

template <class Tag>
struct Rounds_intersections : std::false_type {};
template <>
struct Rounds_intersections<Exact_predicates_tag> : std::true_type {};
template <>
struct Rounds_intersections<CGAL::Exact_predicates_tag> : std::true_type {};
template <>
struct Rounds_intersections<CGAL::Exact_intersections_tag> : std::false_type {};

// Edges of finite faces that are constraints, each one once.
template <class Mesh, std::uint32_t D>
struct Constrained_edges {
    const Mesh *mesh = nullptr;
    std::pair<Cell_handle<Mesh, D>, int> operator()(std::size_t k) const { return Finite_facets<Mesh, D>{mesh}(k); }
    bool selects(std::size_t k) const {
        return mesh->segments_of_cells()[k] != DELDRIFT_NONE && Finite_facets<Mesh, D>{mesh}.selects(k);
    }
};

// The infos of vertices and faces that a data structure of CGAL's has.
template <class Data>
struct Infos_of {
    using type = Infos<typename Info_of<Data>::type, typename Info_of_faces<Data>::type>;
};
template <class Vertices, class Faces>
struct Infos_of<Infos<Vertices, Faces>> {
    using type = Infos<Vertices, Faces>;
};

}  // namespace detail

// Data: the info of vertices; Infos<V, F>, those of vertices and of faces; or one of CGAL's data structures, which may have
// both. A constraint with vertices on it is as many edges as they make pieces of it.
template <class K, class Data = void, class Itag = No_constraint_intersection_requiring_constructions_tag>
class Constrained_Delaunay_triangulation_2 : public Delaunay_triangulation_2<K, typename detail::Infos_of<Data>::type> {
    using Base = Delaunay_triangulation_2<K, typename detail::Infos_of<Data>::type>;
    using Mesh = detail::Mesh<2, detail::Plain_points<2, K>, typename detail::Infos_of<Data>::type>;

public:
    using typename Base::Edge;
    using typename Base::Edge_circulator;
    using typename Base::Face_handle;
    using typename Base::Point;
    using typename Base::size_type;
    using typename Base::Vertex_handle;
    using Intersection_tag = Itag;
    using Constraint = std::pair<Point, Point>;
    using Vertex_pair = std::pair<Vertex_handle, Vertex_handle>;
    using Constrained_edges_iterator = detail::handle_iterator<detail::Constrained_edges<Mesh, 2>>;
    using Constrained_edges = range<Constrained_edges_iterator>;

    // Two constraints cross at a place that is no vertex. Nothing has changed.
    class Intersection_of_constraints_exception : public Error {
        using Error::Error;
    };

    Constrained_Delaunay_triangulation_2() = default;
    explicit Constrained_Delaunay_triangulation_2(const K &traits) : Base(traits) {}
    // Of constraints, as insert_constraints takes them.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    Constrained_Delaunay_triangulation_2(Iterator first, End last, const K &traits = K()) : Base(traits) {
        insert_constraints(first, last);
    }
    Constrained_Delaunay_triangulation_2(const Constrained_Delaunay_triangulation_2 &other) : Base(other) {
        for (const auto &[segment, ends] : other.ends_of_) keep(segment, {same(ends[0]), same(ends[1])});
    }
    Constrained_Delaunay_triangulation_2(Constrained_Delaunay_triangulation_2 &&) noexcept = default;
    Constrained_Delaunay_triangulation_2 &operator=(Constrained_Delaunay_triangulation_2 other) noexcept {
        swap(other);
        return *this;
    }
    void swap(Constrained_Delaunay_triangulation_2 &other) noexcept {
        Base::swap(other);
        segment_at_.swap(other.segment_at_);
        ends_of_.swap(other.ends_of_);
    }
    void clear() {
        Base::clear();
        segment_at_.clear();
        ends_of_.clear();
    }

    // One vertex; on a constraint, it divides it.
    template <class... Hint>
    Vertex_handle insert(const Point &p, Hint...) {
        try {
            return Base::insert(p);
        } catch (const Error &error) {
            if (error.status() != DELDRIFT_ON_SEGMENT) throw;
        }
        const std::uint32_t segment = this->mesh()->conflicts_of_segments().front().segment;
        const Ends ends = ends_of_.at(segment);
        const auto [record, first] = this->mesh_to_change().split_segment(p, records_of(ends), segment);
        const Vertex_handle v(record);
        drop(segment);
        keep(first, {ends[0], v});
        keep(first + 1, {v, ends[1]});
        return v;
    }
    Vertex_handle push_back(const Point &p) { return insert(p); }
    // Points, or pairs of point and info; at once, unless one of them is on a constraint.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    std::ptrdiff_t insert(Iterator first, End last) {
        using Info = typename Mesh::Given_info;
        std::vector<std::pair<Point, Info>> given;
        for (; first != last; ++first) given.push_back(detail::point_and_info<Point, Info>(*first));
        const auto before = static_cast<std::ptrdiff_t>(this->number_of_vertices());
        try {
            Base::insert(given.begin(), given.end());
        } catch (const Error &error) {
            if (error.status() != DELDRIFT_ON_SEGMENT) throw;
            for (auto &[p, info] : given) {
                const size_type n = this->number_of_vertices();
                const Vertex_handle v = insert(p);
                if (this->number_of_vertices() > n) v.info() = std::move(info);
            }
        }
        return static_cast<std::ptrdiff_t>(this->number_of_vertices()) - before;
    }

    // Vertices on a constraint divide it. One that crosses another is an exception, or, with Exact_predicates_tag, gets a
    // vertex there.
    void insert_constraint(Vertex_handle a, Vertex_handle b) { insert_edges({ordered(a, b)}); }
    void insert_constraint(const Point &a, const Point &b) {
        const Vertex_handle v = insert(a);
        insert_constraint(v, insert(b));
    }
    void push_back(const Constraint &c) { insert_constraint(c.first, c.second); }
    // A chain through points, all at once.
    template <class Iterator, class = std::enable_if_t<detail::Is_sequence<Iterator, Iterator>::value>>
    void insert_constraint(Iterator first, Iterator last, bool close = false) {
        std::vector<Vertex_handle> chain = vertices_at(std::vector<Point>(first, last));
        if (chain.empty()) return;
        if (close) chain.push_back(chain.front());
        std::vector<Ends> edges;
        for (std::size_t i = 0; i + 1 < chain.size(); i++) edges.push_back(ordered(chain[i], chain[i + 1]));
        insert_edges(std::move(edges));
    }
    // Pairs of points or of vertices, or segments, all at once; returns how many vertices there are more.
    template <class Iterator, class End>
    size_type insert_constraints(Iterator first, End last) {
        const size_type before = this->number_of_vertices();
        std::vector<Ends> edges;
        std::vector<Point> points;
        for (; first != last; ++first) {
            const auto &constraint = *first;
            const auto &[a, b] = ends_given(constraint);
            if constexpr (std::is_convertible_v<decltype(a), const Vertex_handle &>) {
                edges.push_back(ordered(a, b));
            } else {
                points.push_back(a);
                points.push_back(b);
            }
        }
        const std::vector<Vertex_handle> vertices = vertices_at(points);
        for (std::size_t i = 0; i + 1 < vertices.size(); i += 2) edges.push_back(ordered(vertices[i], vertices[i + 1]));
        insert_edges(std::move(edges));
        return this->number_of_vertices() - before;
    }
    // Points, and pairs of indices into them.
    template <class Points, class Indices>
    size_type insert_constraints(Points first, Points last, Indices first_pair, Indices last_pair) {
        const size_type before = this->number_of_vertices();
        const std::vector<Vertex_handle> vertices = vertices_at(std::vector<Point>(first, last));
        std::vector<Ends> edges;
        for (; first_pair != last_pair; ++first_pair) {
            const auto &[i, j] = *first_pair;
            edges.push_back(ordered(vertices[static_cast<std::size_t>(i)], vertices[static_cast<std::size_t>(j)]));
        }
        insert_edges(std::move(edges));
        return this->number_of_vertices() - before;
    }

    void remove_constrained_edge(Face_handle f, int i) {
        const auto at = segment_at_.find(ordered(f.vertex(Base::ccw(i)), f.vertex(Base::cw(i))));
        if (at == segment_at_.end()) return;
        remove_segments({at->second});
    }
    void remove_constraint(Face_handle f, int i) { remove_constrained_edge(f, i); }
    void remove_incident_constraints(Vertex_handle v) {
        std::vector<std::uint32_t> segments;
        for (const auto &[segment, ends] : ends_of_) {
            if (ends[0] == v || ends[1] == v) segments.push_back(segment);
        }
        if (!segments.empty()) remove_segments(segments);
    }

    bool is_constrained(const Edge &e) const { return e.first.is_constrained(e.second); }
    bool are_there_incident_constraints(Vertex_handle v) const {
        if (this->is_infinite(v)) return false;
        // Vertices on a line have no edges to go around.
        if (this->number_of_faces() == 0) {
            return std::any_of(ends_of_.begin(), ends_of_.end(), [v](const auto &entry) {
                return entry.second[0] == v || entry.second[1] == v;
            });
        }
        bool is_there = false;
        visit_constraints(v, [&](const Edge &) { is_there = true; });
        return is_there;
    }
    template <class Output>
    bool are_there_incident_constraints(Vertex_handle v, Output out) const {
        bool is_there = false;
        visit_constraints(v, [&](const Edge &e) {
            is_there = true;
            *out++ = e;
        });
        return is_there;
    }
    template <class Output>
    Output incident_constraints(Vertex_handle v, Output out) const {
        visit_constraints(v, [&](const Edge &e) { *out++ = e; });
        return out;
    }
    Constrained_edges_iterator constrained_edges_begin() const { return constrained_edges().begin(); }
    Constrained_edges_iterator constrained_edges_end() const { return constrained_edges().end(); }
    Constrained_edges constrained_edges() const {
        return this->template all<detail::Constrained_edges>(this->n_facets_of_cells());
    }

    // For each face, by its id(), how many constraints at least a way crosses from it to the outside: those of the domain
    // have an odd number.
    std::vector<std::uint32_t> nesting_levels() const {
        std::size_t n = this->number_of_faces();
        std::vector<std::uint32_t> levels(n);
        const deldrift_status status = deldrift_nesting_levels(this->triangulation().native(), levels.data(), n, &n);
        if (status != DELDRIFT_OK) throw Error(status);
        return levels;
    }

private:
    template <class Tr, class Crit>
    friend class Delaunay_mesher_2;
    template <class Tr>
    friend class Triangulation_conformer_2;
    using Ends = std::array<Vertex_handle, 2>;
    using Segment_at = std::map<Ends, std::uint32_t>;
    using Ends_of = std::unordered_map<std::uint32_t, Ends>;

    static Ends ordered(Vertex_handle a, Vertex_handle b) noexcept { return a < b ? Ends{a, b} : Ends{b, a}; }
    static std::array<typename Mesh::Record *, 2> records_of(const Ends &ends) noexcept {
        return {Base::record_of(ends[0]), Base::record_of(ends[1])};
    }
    template <class Given>
    static auto ends_given(const Given &given) {
        if constexpr (detail::Has_members<Given>::value) {
            return std::make_pair(given.first, given.second);
        } else {
            return std::make_pair(given.source(), given.target());
        }
    }
    template <class Visit>
    void visit_constraints(Vertex_handle v, Visit visit) const {
        const Edge_circulator first = this->incident_edges(v);
        if (first.is_empty()) return;
        Edge_circulator e = first;
        do {
            if (is_constrained(*e)) visit(*e);
        } while (++e != first);
    }
    Vertex_handle vertex_of(std::uint32_t id) const { return Vertex_handle(this->mesh()->by_id()[id]); }
    Vertex_handle same(Vertex_handle v) const { return vertex_of(v.id()); }
    void keep(std::uint32_t segment, const Ends &ends) {
        ends_of_.emplace(segment, ends);
        segment_at_.emplace(ordered(ends[0], ends[1]), segment);
    }
    void drop(std::uint32_t segment) {
        const auto at = ends_of_.find(segment);
        segment_at_.erase(ordered(at->second[0], at->second[1]));
        ends_of_.erase(at);
    }

    std::vector<Vertex_handle> vertices_at(const std::vector<Point> &points) {
        insert(points.begin(), points.end());
        std::vector<Vertex_handle> vertices;
        for (const Point &p : points) vertices.push_back(this->nearest_vertex(p));
        return vertices;
    }

    // The faces that are in the domain, to which those that take their place belong.
    void refine_domain(const Quality &quality) {
        Segment_at segment_at;
        Ends_of ends_of;
        bool is_refined = false;
        this->mesh_to_change().refine(quality, [&](const Triangulation &refined) {
            const Segments segments = refined.segments();
            for (std::size_t k = 0; k < segments.size(); k++) {
                const Ends ends{vertex_of(segments.ends[k][0]), vertex_of(segments.ends[k][1])};
                ends_of.emplace(segments.ids[k], ends);
                segment_at.emplace(ordered(ends[0], ends[1]), segments.ids[k]);
            }
            is_refined = true;
        });
        if (!is_refined) return;
        segment_at_.swap(segment_at);
        ends_of_.swap(ends_of);
    }

    // New vertices at these places, and pieces between them, by ids, in the place of segments.
    void divide(const std::vector<std::array<double, 2>> &places, const std::vector<deldrift::Ends> &pieces,
                const std::vector<std::uint32_t> &removals) {
        std::vector<Point> points;
        for (const auto &p : places) points.push_back(detail::Coordinates<2, K>::point(p));
        const std::uint32_t first = this->mesh_to_change().divide(points, pieces, removals);
        for (std::uint32_t segment : removals) drop(segment);
        for (std::size_t k = 0; k < pieces.size(); k++) {
            keep(first + static_cast<std::uint32_t>(k), {vertex_of(pieces[k][0]), vertex_of(pieces[k][1])});
        }
    }

    // Split where vertices are on them, or where they cross others.
    void insert_edges(std::vector<Ends> edges) {
        clean(edges);
        if (edges.empty()) return;
        std::vector<std::array<typename Mesh::Record *, 2>> ends;
        for (const Ends &e : edges) ends.push_back(records_of(e));
        std::uint32_t first = 0;
        try {
            this->mesh_to_change().exchange_segments(ends, {}, first);
            for (std::size_t i = 0; i < edges.size(); i++) keep(first + static_cast<std::uint32_t>(i), edges[i]);
            return;
        } catch (const Error &error) {
            if (error.status() != DELDRIFT_CROSSING && error.status() != DELDRIFT_ON_SEGMENT) throw;
            // Conflicts are in ascending order of kind, in which crossings come first.
            const bool has_crossings = this->mesh()->conflicts_of_segments().front().kind == DELDRIFT_CONFLICT_CROSSING;
            if (has_crossings && !detail::Rounds_intersections<Itag>::value) {
                throw Intersection_of_constraints_exception(error.status(), error.what());
            }
        }
        this->mesh_to_change().insert_split_segments(ends, first);
        keep_pieces(first);
    }
    // Of segments that were split, and of those of ids from `first` on. An edge has one segment, also where some overlap.
    void keep_pieces(std::uint32_t first) {
        const Segments segments = this->triangulation().segments();
        std::vector<std::uint32_t> replaced, doubled;
        for (const auto &[segment, ends] : ends_of_) {
            if (!std::binary_search(segments.ids.begin(), segments.ids.end(), segment)) replaced.push_back(segment);
        }
        for (std::uint32_t segment : replaced) drop(segment);
        const auto begin = std::lower_bound(segments.ids.begin(), segments.ids.end(), first);
        for (auto k = static_cast<std::size_t>(begin - segments.ids.begin()); k < segments.size(); k++) {
            const Ends ends{vertex_of(segments.ends[k][0]), vertex_of(segments.ends[k][1])};
            if (segment_at_.count(ordered(ends[0], ends[1])) > 0) {
                doubled.push_back(segments.ids[k]);
            } else {
                keep(segments.ids[k], ends);
            }
        }
        if (!doubled.empty()) this->mesh_to_change().exchange_segments({}, doubled, first);
    }
    // Without those that are there already, or that have no length.
    void clean(std::vector<Ends> &edges) const {
        const auto is_idle = [&](const Ends &e) { return e[0] == e[1] || segment_at_.count(e) > 0; };
        edges.erase(std::remove_if(edges.begin(), edges.end(), is_idle), edges.end());
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    }
    void remove_segments(const std::vector<std::uint32_t> &segments) {
        std::uint32_t first = 0;
        this->mesh_to_change().exchange_segments({}, segments, first);
        for (std::uint32_t segment : segments) drop(segment);
    }

    Segment_at segment_at_{};
    Ends_of ends_of_{};
};

// With any data structure: the constrained triangulation that is Delaunay where constraints allow it.
template <class K, class Data = void, class Itag = No_constraint_intersection_requiring_constructions_tag>
using Constrained_triangulation_2 = Constrained_Delaunay_triangulation_2<K, Data, Itag>;

// Puts to the map, for each face, whether it is in the domain that constraints bound: whether its nesting level is odd.
template <class K, class Data, class Itag, class Map>
void mark_domain_in_triangulation(const Constrained_Delaunay_triangulation_2<K, Data, Itag> &t, Map in_domain) {
    const std::vector<std::uint32_t> levels = t.nesting_levels();
    for (const auto f : t.all_face_handles()) put(in_domain, f, !f.is_infinite() && levels[f.id()] % 2 == 1);
}

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_CONSTRAINED_HPP
