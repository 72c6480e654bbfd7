// Meshes of domains by CGAL's mesher and, with the same criteria and the same names, by deldrift's. It writes how many faces
// each has, and fails unless deldrift's are, in exact fractions, what the criteria ask for, the area of the domain is the
// same but for rounding, and all have at most 5 % more faces than CGAL's.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deldrift/cgal.hpp>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vb = CGAL::Triangulation_vertex_base_2<K>;
using Data = CGAL::Triangulation_data_structure_2<Vb, CGAL::Delaunay_mesh_face_base_2<K>>;
using With_cgal = CGAL::Constrained_Delaunay_triangulation_2<K, Data>;
using With_deldrift = deldrift::cgal::Constrained_Delaunay_triangulation_2<K, Data>;
using Point = K::Point_2;
using Loop = std::vector<Point>;
using Exact = CGAL::Gmpq;

struct Domain {
    const char *name;
    std::vector<Loop> loops;
    std::vector<Point> seeds;
    // Vertices inside.
    Loop points;
};

struct Mesh {
    std::size_t n_faces;
    Exact area;
};

static void fail(const std::string &why) {
    std::fprintf(stderr, "%s\n", why.c_str());
    std::exit(1);
}

static Loop ring(double radius, int n, double x = 0, double y = 0, double waves = 0) {
    Loop loop;
    for (int i = 0; i < n; i++) {
        const double turn = 2 * std::acos(-1.0) * i / n, r = radius * (1 + 0.3 * std::cos(waves * turn));
        loop.emplace_back(x + r * std::cos(turn), y + r * std::sin(turn));
    }
    return loop;
}

static std::vector<Domain> domains() {
    const Loop square{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, corner{{-4, -4}, {4, -4}, {4, 0}, {0, 0}, {0, 4}, {-4, 4}};
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> anywhere(-3.9, 3.9);
    Loop points;
    for (int i = 0; i < 300; i++) points.emplace_back(anywhere(engine), anywhere(engine));
    return {{"square", {square}, {}, {}},
            {"corner", {corner}, {}, {}},
            {"hole", {square, ring(1.5, 40)}, {Point(0, 0)}, {}},
            {"two holes", {square, ring(1, 30, -2, -2), ring(0.5, 12, 2.5, 1)}, {Point(-2, -2), Point(2.5, 1)}, {}},
            {"star", {ring(3, 60, 0, 0, 5)}, {}, {}},
            {"points", {square}, {}, points},
            {"island", {square, ring(2, 32), ring(1, 16)}, {}, {}}};
}

// Twice the area of a face.
template <class Face>
static Exact area_of(Face f) {
    const auto x = [f](int i) { return Exact(f->vertex(i)->point().x()); };
    const auto y = [f](int i) { return Exact(f->vertex(i)->point().y()); };
    return (x(1) - x(0)) * (y(2) - y(0)) - (y(1) - y(0)) * (x(2) - x(0));
}

template <class Face>
static void check_face(Face f, double bound, double size) {
    const Exact area = area_of(f);
    const auto squared = [f](int i, int j) {
        const Exact x = Exact(f->vertex(i)->point().x()) - Exact(f->vertex(j)->point().x());
        const Exact y = Exact(f->vertex(i)->point().y()) - Exact(f->vertex(j)->point().y());
        return Exact(x * x + y * y);
    };
    for (int i = 0; i < 3; i++) {
        const Exact b = squared(i, (i + 1) % 3), c = squared(i, (i + 2) % 3);
        if (area * area < Exact(bound) * b * c) fail("an angle is too small");
        if (size > 0 && b > Exact(size) * Exact(size)) fail("an edge is too long");
    }
}

template <class Cdt, class Refine>
static Mesh mesh_of(const Domain &domain, Refine refine) {
    Cdt cdt;
    for (const Loop &loop : domain.loops) cdt.insert_constraint(loop.begin(), loop.end(), true);
    cdt.insert(domain.points.begin(), domain.points.end());
    refine(cdt);
    Mesh mesh{0, 0};
    for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
        if (!f->is_in_domain()) continue;
        mesh.n_faces++;
        mesh.area += area_of(typename Cdt::Face_handle(f));
    }
    return mesh;
}

int main() {
    std::size_t n_cgal = 0, n_deldrift = 0;
    for (const Domain &domain : domains()) {
        for (const double bound : {0.0625, 0.125}) {
            for (const double size : {0.0, 1.0, 0.25, 0.1}) {
                const auto &seeds = domain.seeds;
                const Mesh theirs = mesh_of<With_cgal>(domain, [&](With_cgal &cdt) {
                    CGAL::refine_Delaunay_mesh_2(cdt, seeds.begin(), seeds.end(),
                                                 CGAL::Delaunay_mesh_size_criteria_2<With_cgal>(bound, size));
                });
                const Mesh ours = mesh_of<With_deldrift>(domain, [&](With_deldrift &cdt) {
                    deldrift::cgal::refine_Delaunay_mesh_2(
                        cdt, seeds.begin(), seeds.end(),
                        deldrift::cgal::Delaunay_mesh_size_criteria_2<With_deldrift>(bound, size));
                    for (const auto f : cdt.finite_face_handles()) {
                        if (f->is_in_domain()) check_face(f, bound, size);
                    }
                });
                std::printf("%s, bound %g, size %g: %zu faces, CGAL %zu\n", domain.name, bound, size, ours.n_faces,
                            theirs.n_faces);
                // Places of vertices on segments are rounded.
                const double off = CGAL::to_double(Exact(ours.area - theirs.area)) / CGAL::to_double(theirs.area);
                if (std::fabs(off) > 1e-14) fail("the area is another one");
                n_cgal += theirs.n_faces;
                n_deldrift += ours.n_faces;
            }
        }
    }
    std::printf("all: %zu faces, CGAL %zu\n", n_deldrift, n_cgal);
    if (100 * n_deldrift > 105 * n_cgal) fail("there are many more faces than with CGAL");
}
