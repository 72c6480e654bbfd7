// Meshes under CGAL's names. Afterwards, in big integers, the faces of the domain are what the criteria ask for, the domain is
// the region that a flood from face to face finds, and constraints are where they were.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deldrift/cgal.hpp>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "big.hpp"
#include "check.hpp"

namespace cgal = deldrift::cgal;

using K = cgal::Kernel;
using Point = K::Point_2;
using Cdt = cgal::Constrained_Delaunay_triangulation_2<K, int>;
using Face = Cdt::Face_handle;
using Vertex = Cdt::Vertex_handle;
using Criteria = cgal::Delaunay_mesh_size_criteria_2<Cdt>;
using Mesher = cgal::Delaunay_mesher_2<Cdt, Criteria>;
using Points = std::vector<Point>;
// All that is no template compiles for any kernel.
template class deldrift::cgal::Delaunay_mesher_2<Cdt>;
template class deldrift::cgal::Delaunay_mesher_2<Cdt, cgal::Delaunay_mesh_criteria_2<Cdt>>;

static Points ring(double radius, std::size_t n) {
    Points points;
    for (std::size_t i = 0; i < n; i++) {
        const double turn = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(n);
        points.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    }
    return points;
}

// A square with a round hole, a wall from the square to nearly the hole, and a vertex outside.
static Cdt domain() {
    Cdt cdt;
    const Points square{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, hole = ring(1.5, 20);
    cdt.insert_constraint(square.begin(), square.end(), true);
    cdt.insert_constraint(hole.begin(), hole.end(), true);
    cdt.insert_constraint(Point(-4, 0), Point(-2, 0.25));
    cdt.insert(Point(9, 1))->info() = 7;
    return cdt;
}

// The region of a face, by a flood that stops at constraints; the outside is reached from the infinite face.
static std::vector<Face> region_from(const Cdt &cdt, Face start) {
    std::vector<Face> region{start};
    std::map<Face, bool> is_seen{{start, true}};
    for (std::size_t k = 0; k < region.size(); k++) {
        for (int i = 0; i < 3; i++) {
            const Face g = region[k]->neighbor(i);
            if (!cdt.is_constrained(Cdt::Edge(region[k], i)) && !is_seen[g]) {
                is_seen[g] = true;
                region.push_back(g);
            }
        }
    }
    return region;
}

// Whether the domain is as CGAL defines it.
static void check_domain(const Cdt &cdt, const Points &seeds, bool mark) {
    std::map<Face, bool> is_inside;
    for (Face f : cdt.all_face_handles()) is_inside[f] = seeds.empty() || !mark;
    for (const Point &seed : seeds) {
        for (Face f : region_from(cdt, cdt.locate(seed))) is_inside[f] = mark;
    }
    for (Face f : region_from(cdt, cdt.infinite_face())) is_inside[f] = false;
    for (Face f : cdt.all_face_handles()) CHECK(f->is_in_domain() == is_inside[f]);
}

// 64 (2 area)^2 >= 64 bound b c, of which 64 times the bound is whole; no edge longer than `size`, if it is not 0.
static std::size_t check_quality(const Cdt &cdt, double bound, double size) {
    std::vector<double> numbers = cdt.triangulation().positions();
    // The last place is at the distance that edges may have from the origin.
    numbers.insert(numbers.end(), {size, 64 * bound});
    const std::vector<Place> places = places_of(numbers);
    const Big most = places.back().x * places.back().x, one = places_of({64, numbers.back()})[0].x;
    const Big least = places_of({64, numbers.back()})[0].y;
    std::size_t n = 0;
    for (Face f : cdt.finite_face_handles()) {
        if (!f->is_in_domain()) continue;
        n++;
        const auto at = [&](int i) -> const Place & { return places[f->vertex(i)->id()]; };
        const Big area = cross(at(0), at(1), at(2));
        for (int i = 0; i < 3; i++) {
            const auto squared = [&](int j) {
                const Big x = at(j).x - at(i).x, y = at(j).y - at(i).y;
                return x * x + y * y;
            };
            const Big b = squared((i + 1) % 3), c = squared((i + 2) % 3);
            CHECK((one * area * area - least * b * c).sign() >= 0);
            CHECK(size <= 0 || (most - b).sign() >= 0);
        }
    }
    CHECK(n > 0);
    return n;
}

// A constraint that was there is a chain of constrained edges, each of which goes on towards its end.
static void check_chain(const Cdt &cdt, Vertex a, Vertex b) {
    const double x = b->point().x() - a->point().x(), y = b->point().y() - a->point().y();
    const auto along = [&](Vertex v) {
        return (v->point().x() - a->point().x()) * x + (v->point().y() - a->point().y()) * y;
    };
    const auto beside = [&](Vertex v) {
        return (v->point().x() - a->point().x()) * y - (v->point().y() - a->point().y()) * x;
    };
    for (Vertex at = a; at != b;) {
        std::vector<Cdt::Edge> around;
        cdt.incident_constraints(at, std::back_inserter(around));
        Vertex next = nullptr;
        for (const auto &[f, i] : around) {
            const Vertex v = f->vertex(cdt.ccw(i)), w = f->vertex(cdt.cw(i)), other = v == at ? w : v;
            // Places are rounded to 53 bits.
            if (std::fabs(beside(other)) <= 1e-14 * (x * x + y * y) && along(other) > along(at)) next = other;
        }
        CHECK(next != nullptr);
        at = next;
    }
}

static std::vector<std::array<Vertex, 2>> constraints_of(const Cdt &cdt) {
    std::vector<std::array<Vertex, 2>> ends;
    for (const auto &[f, i] : cdt.constrained_edges()) ends.push_back({f->vertex(cdt.ccw(i)), f->vertex(cdt.cw(i))});
    return ends;
}

static void check_mesh(const Cdt &cdt, const Points &seeds, bool mark, double bound, double size) {
    CHECK(cdt.is_valid());
    check_domain(cdt, seeds, mark);
    check_quality(cdt, bound, size);
}

// ---------------------------------------------------------------------------------------------------- the function

static void overloads() {
    const Points centre{{0, 0}}, others{{3, 3}, {20, 0}};
    const std::list<Point> in_list(centre.begin(), centre.end());
    Cdt cdt = domain();
    const auto before = constraints_of(cdt);
    const std::size_t n = cdt.number_of_vertices();
    cgal::refine_Delaunay_mesh_2(cdt, in_list.begin(), in_list.end(), Criteria());
    check_mesh(cdt, centre, false, 0.125, 0);
    for (const auto &[a, b] : before) check_chain(cdt, a, b);
    const std::size_t n_coarse = cdt.number_of_vertices();
    CHECK(n_coarse > n);
    // What is fine already stays.
    cgal::refine_Delaunay_mesh_2(cdt, in_list.begin(), in_list.end(), Criteria());
    CHECK(cdt.number_of_vertices() == n_coarse);
    check_mesh(cdt, centre, false, 0.125, 0);

    // The hole belongs to the domain, as nothing says that it does not.
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.125, 0.5));
    check_mesh(cdt, {}, false, 0.125, 0.5);
    // Of two seeds one is outside.
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt, others.begin(), others.end(), Criteria(0.25, 1), true);
    check_mesh(cdt, others, true, 0.25, 1);
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt, others.begin(), others.end());
    check_domain(cdt, others, false);
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt);
    check_mesh(cdt, {}, false, 0.125, 0);
    // Without a domain nothing is done.
    Cdt line;
    line.insert_constraint(Point(0, 0), Point(1, 0));
    cgal::refine_Delaunay_mesh_2(line, Criteria(0.125, 0.1));
    line.insert(Point(0, 1));
    cgal::refine_Delaunay_mesh_2(line, Criteria(0.125, 0.1));
    CHECK(line.number_of_vertices() == 3 && !line.finite_faces_begin()->is_in_domain());
}

static void parameters_by_name() {
    namespace parameters = cgal::parameters;
    const Points centre{{0, 0}};
    const auto n_of = [](const Cdt &cdt) { return cdt.number_of_vertices(); };
    Cdt cdt = domain(), same = domain();
    cgal::refine_Delaunay_mesh_2(cdt, parameters::criteria(Criteria(0.125, 0.5)).seeds(centre));
    cgal::refine_Delaunay_mesh_2(same, centre.begin(), centre.end(), Criteria(0.125, 0.5));
    check_mesh(cdt, centre, false, 0.125, 0.5);
    CHECK(n_of(cdt) == n_of(same));
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt, parameters::seeds(centre).seeds_are_in_domain(true).criteria(Criteria(0.2)));
    check_mesh(cdt, centre, true, 0.2, 0);
    cdt = domain();
    cgal::refine_Delaunay_mesh_2(cdt, parameters::seeds_are_in_domain(true).seeds(centre).domain_is_initialized(false));
    check_mesh(cdt, centre, true, 0.125, 0);
    cdt = domain();
    Mesher::mark_facets(cdt, centre.begin(), centre.end(), true);
    cgal::refine_Delaunay_mesh_2(cdt, parameters::domain_is_initialized(true).criteria(Criteria(0.125, 0.2)));
    check_mesh(cdt, centre, true, 0.125, 0.2);
}

static void a_domain_that_the_program_marks() {
    Cdt cdt = domain();
    for (Face f : cdt.all_face_handles()) {
        CHECK(!f->is_in_domain());
        f->set_in_domain(false);
    }
    for (Face f : region_from(cdt, cdt.locate(Point(0, 0)))) f->set_in_domain(true);
    // What is connected with the outside is not refined, whatever its marks are.
    for (Face f : region_from(cdt, cdt.infinite_face())) f->set_in_domain(true);
    cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.125, 0.3), true);
    check_mesh(cdt, {Point(0, 0)}, true, 0.125, 0.3);

    // A constraint that begins at a vertex on a constraint divides a region, of which the program marks a part. So a piece
    // of one constraint has the domain on its left, and another one has not.
    cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.125, 1));
    Vertex middle = nullptr;
    for (Vertex v : cdt.finite_vertex_handles()) {
        const Point &p = v->point();
        if (p.y() <= -4 && std::fabs(p.x()) < 2) middle = v;
    }
    CHECK(middle != nullptr);
    const Vertex rim = cdt.nearest_vertex(Point(0.9, -1.2));
    cdt.insert_constraint(middle, rim);
    cdt.insert_constraint(cdt.nearest_vertex(Point(0, 4)), cdt.nearest_vertex(Point(0, 1.5)));
    const Points right{{3.9, -3.9}};
    for (bool is_right : {true, false}) {
        Cdt half = cdt;
        for (Face f : half.finite_face_handles()) f->set_in_domain(!is_right);
        for (Face f : region_from(half, half.locate(right[0]))) f->set_in_domain(is_right);
        cgal::refine_Delaunay_mesh_2(half, Criteria(0.1, 0.25), true);
        check_domain(half, right, is_right);
        // Where constraints that were inserted meet others at small angles, faces keep these.
        CHECK(half.number_of_faces() > cdt.number_of_faces());
    }

    // Marks have to change at constraints.
    Cdt wrong = domain();
    wrong.locate(Point(3, 3))->set_in_domain(true);
    const std::size_t n = wrong.number_of_vertices();
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(wrong, Criteria(), true), DELDRIFT_INVALID_VALUE, "mask");
    CHECK(wrong.number_of_vertices() == n && wrong.locate(Point(3, 3))->is_in_domain());
}

// ------------------------------------------------------------------------------------------------------- the class

static void the_mesher() {
    Cdt cdt = domain();
    const std::list<Point> seeds{Point(0, 0)};
    Mesher mesher(cdt);
    CHECK(&mesher.triangulation() == &cdt && mesher.get_criteria().bound() == 0.125);
    CHECK(mesher.get_criteria().size_bound() == 0 && mesher.seeds_begin() == mesher.seeds_end());
    mesher.set_seeds(seeds.begin(), seeds.end(), false, true);
    CHECK(*mesher.seeds_begin() == Point(0, 0));
    check_domain(cdt, {Point(0, 0)}, false);
    mesher.refine_mesh();
    check_mesh(cdt, {Point(0, 0)}, false, 0.125, 0);
    Criteria finer;
    finer.set_bound(0.2);
    finer.set_size_bound(0.5);
    mesher.set_criteria(finer);
    mesher.refine_mesh();
    check_mesh(cdt, {Point(0, 0)}, false, 0.2, 0.5);
    mesher.clear_seeds();
    mesher.init();
    mesher.refine_mesh();
    check_mesh(cdt, {}, false, 0.2, 0.5);

    // After a change by the program faces are marked anew.
    mesher.set_seeds(seeds.begin(), seeds.end());
    cdt.insert(Point(3.125, 3.25));
    CHECK(!cdt.locate(Point(3, 3))->is_in_domain());
    mesher.refine_mesh();
    check_mesh(cdt, {Point(0, 0)}, false, 0.2, 0.5);
    // A copy has the marks.
    const Cdt copy = cdt;
    check_domain(copy, {Point(0, 0)}, false);

    cgal::Delaunay_mesher_2<Cdt, cgal::Delaunay_mesh_criteria_2<Cdt>> plain(cdt);
    plain.mark_facets();
    plain.mark_facets(true);
    check_domain(cdt, {}, false);
    plain.refine_mesh();
    check_mesh(cdt, {}, false, 0.125, 0);
}

// Vertices that were there are, with their infos, and moves that are staged wait.
static void handles_and_moves() {
    Cdt cdt = domain();
    std::vector<Vertex> vertices;
    for (Vertex v : cdt.finite_vertex_handles()) {
        v->info() = 100 + static_cast<int>(vertices.size());
        vertices.push_back(v);
    }
    const Vertex outside = cdt.nearest_vertex(Point(9, 1));
    cdt.stage_move(outside, Point(9, 2));
    cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.125, 0.5));
    CHECK(outside->point() == Point(9, 1) && cdt.triangulation().staged_count() == 1);
    for (std::size_t i = 0; i < vertices.size(); i++) CHECK(vertices[i]->info() == 100 + static_cast<int>(i));
    std::size_t n_new = 0;
    for (Vertex v : cdt.finite_vertex_handles()) {
        const auto x = cdt.triangulation().position<2>(v->id());
        CHECK(v->point() == Point(x[0], x[1]) && cdt.is_vertex(v));
        if (v->info() == 0) n_new++;
    }
    CHECK(n_new + vertices.size() == cdt.number_of_vertices());
    cdt.commit_timestamp();
    CHECK(outside->point() == Point(9, 2) && cdt.is_valid());
    // Constraints are known by their edges still.
    const auto [f, i] = *cdt.constrained_edges_begin();
    const Vertex a = f->vertex(cdt.ccw(i)), b = f->vertex(cdt.cw(i));
    const std::size_t n = constraints_of(cdt).size();
    cdt.remove_constrained_edge(f, i);
    CHECK(constraints_of(cdt).size() == n - 1);
    cdt.insert_constraint(a, b);
    CHECK(constraints_of(cdt).size() == n);
}

// -------------------------------------------------------------------------------------------------------- failures

static void what_is_refused() {
    Cdt cdt = domain();
    const std::size_t n = cdt.number_of_vertices();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.32)), DELDRIFT_INVALID_VALUE, "aspect bound is 0.32");
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, Criteria(-0.1)), DELDRIFT_INVALID_VALUE, "aspect bound is -0.1");
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, Criteria(nan)), DELDRIFT_INVALID_VALUE, "aspect bound");
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.1, -1)), DELDRIFT_INVALID_VALUE, "size bound is -1");
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, Criteria(0.1, nan)), DELDRIFT_INVALID_VALUE, "size bound");
    const Points on_boundary{{4, 1}};
    CHECK_THROWS(cgal::refine_Delaunay_mesh_2(cdt, on_boundary.begin(), on_boundary.end()), DELDRIFT_AMBIGUOUS_SEED,
                 "seed");
    CHECK(cdt.number_of_vertices() == n);
    const double degree = std::acos(-1.0) / 180;
    cgal::refine_Delaunay_mesh_2(cdt, Criteria(std::pow(std::sin(34 * degree), 2), 1));
    CHECK(cdt.number_of_vertices() > n);
}

// An info that can be made so often.
struct Counted {
    static inline int n_left = std::numeric_limits<int>::max();
    Counted() {
        if (n_left-- <= 0) throw std::runtime_error("no more");
    }
};

static void an_info_that_throws() {
    using Counting = cgal::Constrained_Delaunay_triangulation_2<K, Counted>;
    Counting cdt;
    const Points square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    cdt.insert_constraint(square.begin(), square.end(), true);
    const auto ids = [&cdt] {
        std::vector<std::uint32_t> rows;
        for (Counting::Face_handle f : cdt.finite_face_handles()) {
            for (int i = 0; i < 3; i++) rows.push_back(f->vertex(i)->id());
            rows.push_back(f->is_in_domain() ? 1 : 0);
        }
        return rows;
    };
    cgal::refine_Delaunay_mesh_2(cdt);
    const std::vector<std::uint32_t> before = ids();
    int n_failures = 0;
    for (int limit : {0, 1, 7, 30}) {
        Counted::n_left = limit;
        try {
            cgal::refine_Delaunay_mesh_2(cdt, cgal::Delaunay_mesh_size_criteria_2<Counting>(0.125, 0.5));
        } catch (const std::runtime_error &) {
            n_failures++;
        }
        Counted::n_left = std::numeric_limits<int>::max();
        CHECK(ids() == before && cdt.is_valid());
        CHECK(cdt.triangulation().id_count() == 4 && cdt.number_of_vertices() == 4);
    }
    CHECK(n_failures == 4);
    cgal::refine_Delaunay_mesh_2(cdt, cgal::Delaunay_mesh_size_criteria_2<Counting>(0.125, 0.5));
    CHECK(cdt.number_of_vertices() > 60);
}

int main() {
    overloads();
    parameters_by_name();
    a_domain_that_the_program_marks();
    the_mesher();
    handles_and_moves();
    what_is_refused();
    an_info_that_throws();
}
