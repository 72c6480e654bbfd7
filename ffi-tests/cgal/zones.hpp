// A part of both.cpp: which cells a point is in conflict with, which vertices have a common cell, what is infinite, and
// the objects that cells stand for.
#ifndef ZONES_HPP
#define ZONES_HPP

template <class T>
static unsigned long count(T n) {
    return static_cast<unsigned long>(n);
}

template <class First, class Last>
static unsigned long length(First first, Last last) {
    unsigned long n = 0;
    for (; first != last; ++first) n++;
    return n;
}

// ------------------------------------------------------------------------------------------------ the plane

static Rows<2> pairs_of(const std::vector<Dt2::Edge> &edges) {
    Rows<2> rows;
    for (const auto &[f, i] : edges) rows.push_back({f->vertex(f->cw(i))->info(), f->vertex(f->ccw(i))->info()});
    return rows;
}

// Each edge begins where the one before it ends.
static bool is_ring(const Rows<2> &rows) {
    for (std::size_t k = 0; k < rows.size(); k++) {
        if (rows[k][1] != rows[(k + 1) % rows.size()][0]) return false;
    }
    return true;
}

static void show_zone(const Dt2 &t, const Point_2 &p) {
    std::vector<Dt2::Face_handle> faces, again;
    std::vector<Dt2::Edge> edges, ring;
    const Dt2::Face_handle hint = t.locate(p);
    t.get_conflicts_and_boundary(p, std::back_inserter(faces), std::back_inserter(edges), hint);
    t.get_conflicts(p, std::back_inserter(again));
    t.get_boundary_of_conflicts(p, std::back_inserter(ring), hint);
    Rows<3> rows;
    for (Dt2::Face_handle f : faces) rows.push_back(corners_of(f));
    show("faces that go", rows);
    show("edges around", pairs_of(edges));
    std::printf("%d, %d, %lu %lu\n", is_ring(pairs_of(edges)), is_ring(pairs_of(ring)), count(again.size()),
                count(ring.size()));
    for (Dt2::Face_handle f : faces) {
        if (t.side_of_oriented_circle(f, p) <= 0) std::printf("not in the circle\n");
    }
    int n_sides[3] = {0, 0, 0};
    for (Dt2::Face_handle f : t.all_face_handles()) n_sides[t.side_of_oriented_circle(f, p) + 1]++;
    std::printf("%d %d %d\n", n_sides[0], n_sides[1], n_sides[2]);
    // Each vertex that is new to the ring is a corner of faces on both sides.
    for (const auto &[f, i] : edges) {
        if (std::find(faces.begin(), faces.end(), f) != faces.end()) std::printf("goes, too\n");
        if (std::find(faces.begin(), faces.end(), f->neighbor(i)) == faces.end()) std::printf("not beside\n");
    }
}

static void show_objects(const Dt2 &t) {
    double area = 0, length_of_all = 0;
    for (Dt2::Finite_faces_iterator f = t.faces_begin(); f != t.faces_end(); ++f) {
        const auto triangle = t.triangle(f);
        const Point_2 a = triangle.vertex(0), b = triangle.vertex(1), c = triangle.vertex(2);
        area += (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
        const Point_2 m((a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3);
        if (t.oriented_side(f, m) != 1 || t.oriented_side(f, Point_2(9, 9)) != -1) std::printf("not the side\n");
    }
    for (Dt2::Edge_iterator e = t.edges_begin(); e != t.edges_end(); ++e) {
        const auto segment = t.segment(*e);
        const double x = segment.target().x() - segment.source().x(), y = segment.target().y() - segment.source().y();
        length_of_all += x * x + y * y;
    }
    std::printf("%.6f %.6f\n", area, length_of_all);
    std::printf("%lu %lu %lu\n", length(t.all_vertices_begin(), t.all_vertices_end()),
                length(t.all_edges_begin(), t.all_edges_end()), length(t.vertices_begin(), t.vertices_end()));
    Rows<2> infinite;
    for (Dt2::All_edges_iterator e = t.all_edges_begin(); e != t.all_edges_end(); ++e) {
        if (t.is_infinite(e)) {
            const unsigned a = e->first->vertex(t.cw(e->second))->info(),
                           b = e->first->vertex(t.ccw(e->second))->info();
            infinite.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    show("infinite edges", infinite);
}

static void zones_in_plane() {
    std::vector<std::pair<Point_2, unsigned>> points;
    for (unsigned i = 0; i < 60; i++) points.emplace_back(Point_2(anywhere(), anywhere()), i);
    Dt2 t(points.begin(), points.end());
    t.infinite_vertex()->info() = 9999;
    show_objects(t);
    for (int i = 0; i < 12; i++) show_zone(t, Point_2(2 * anywhere() - 0.5, 2 * anywhere() - 0.5));
    std::map<unsigned, Dt2::Vertex_handle> by_info = by_info_of(t);
    by_info[9999] = t.infinite_vertex();
    for (const auto &[a, v] : by_info) {
        std::printf("%u:", a);
        for (const auto &[b, w] : by_info) {
            Dt2::Face_handle f;
            int i = 0;
            if (a == b || !t.is_edge(v, w, f, i)) continue;
            std::printf(" %u", b);
            if (!t.is_edge(v, w) || f->has_vertex(v) + f->has_vertex(w) != 2) std::printf(", which it is not");
            if (f->index(v) == i || f->index(w) == i) std::printf(", which is another edge");
            const Dt2::Vertex_handle third = f->vertex(i);
            Dt2::Face_handle g;
            if (!t.is_face(third, v, w) || !t.is_face(v, w, third, g) || g != f) std::printf(", which is no face");
        }
        std::printf("\n");
    }
    // By the faces and edges themselves.
    for (unsigned i = 0; i < 30; i++) {
        const Point_2 p(1.5 * anywhere() - 0.25, 1.5 * anywhere() - 0.25);
        std::vector<Dt2::Face_handle> faces;
        std::vector<Dt2::Edge> edges;
        t.get_conflicts_and_boundary(p, std::back_inserter(faces), std::back_inserter(edges));
        t.star_hole(p, edges.begin(), edges.end(), faces.begin(), faces.end())->info() = 60 + i;
    }
    t.push_back(Point_2(0.5, 0.25))->info() = 90;
    show_plane(t);
}

// ------------------------------------------------------------------------------------------------------ space

static void show_zone(const Dt3 &t, const Point_3 &p) {
    std::vector<Dt3::Cell_handle> cells, again;
    std::vector<Dt3::Facet> facets, boundary, interior;
    const Dt3::Cell_handle hint = t.locate(p);
    t.find_conflicts(p, hint, std::back_inserter(facets), std::back_inserter(cells));
    t.find_conflicts(p, hint, std::back_inserter(boundary), std::back_inserter(again), std::back_inserter(interior));
    Rows<4> rows;
    for (Dt3::Cell_handle c : cells) rows.push_back(corners_of(c));
    show("cells that go", rows);
    Rows<3> around;
    for (const auto &[c, i] : facets) {
        std::array<unsigned, 3> row;
        for (int k = 0; k < 3; k++) {
            row[static_cast<std::size_t>(k)] = c->vertex(Dt3::vertex_triple_index(i, k))->info();
        }
        std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
        around.push_back(row);
        const bool is_in = std::find(cells.begin(), cells.end(), c) != cells.end();
        const bool is_beside = std::find(cells.begin(), cells.end(), c->neighbor(i)) == cells.end();
        if (!is_in || !is_beside) std::printf("not the boundary\n");
    }
    show("facets around", around);
    std::printf("%lu %lu %lu\n", count(boundary.size()), count(again.size()), count(interior.size()));
    std::vector<Dt3::Vertex_handle> vertices;
    t.vertices_on_conflict_zone_boundary(p, hint, std::back_inserter(vertices));
    std::set<unsigned> infos;
    for (Dt3::Vertex_handle v : vertices) infos.insert(v->info());
    for (unsigned info : infos) std::printf("%u ", info);
    int n_sides[3] = {0, 0, 0};
    for (Dt3::Cell_handle c : t.all_cell_handles()) n_sides[t.side_of_sphere(c, p) + 1]++;
    std::printf("\n%lu of %lu; %d %d %d\n", count(infos.size()), count(vertices.size()), n_sides[0], n_sides[1],
                n_sides[2]);
}

static void show_objects(const Dt3 &t) {
    double volume = 0, area = 0, length_of_all = 0;
    for (Dt3::Finite_cells_iterator c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) {
        const auto tetrahedron = t.tetrahedron(c);
        double u[3][3];
        for (int i = 0; i < 3; i++) {
            const Point_3 p = tetrahedron.vertex(i + 1), q = tetrahedron.vertex(0);
            u[i][0] = p.x() - q.x(), u[i][1] = p.y() - q.y(), u[i][2] = p.z() - q.z();
        }
        volume += u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
                  u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
    }
    for (const Dt3::Facet &f : t.finite_facets()) {
        const auto triangle = t.triangle(f);
        const Point_3 a = triangle.vertex(0), b = triangle.vertex(1), c = triangle.vertex(2);
        const double x = (b.y() - a.y()) * (c.z() - a.z()) - (b.z() - a.z()) * (c.y() - a.y());
        area += x * x;
    }
    for (Dt3::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        const auto segment = t.segment(*e);
        const double z = segment.target().z() - segment.source().z();
        length_of_all += z * z;
    }
    std::printf("%.6f %.6f %.6f\n", volume, area, length_of_all);
    std::printf("%lu %lu, %lu %lu %lu %lu\n", count(t.number_of_facets()), count(t.number_of_edges()),
                length(t.all_vertices_begin(), t.all_vertices_end()), length(t.all_edges_begin(), t.all_edges_end()),
                length(t.all_facets_begin(), t.all_facets_end()), length(t.all_cells_begin(), t.all_cells_end()));
    std::printf("%lu %lu %lu %lu\n", length(t.vertices_begin(), t.vertices_end()),
                length(t.edges_begin(), t.edges_end()), length(t.facets_begin(), t.facets_end()),
                length(t.cells_begin(), t.cells_end()));
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) std::printf("%d ", Dt3::vertex_triple_index(i, k));
        for (int j = 0; j < 4; j++) {
            if (i != j) std::printf("%d ", Dt3::next_around_edge(i, j));
        }
    }
    std::printf("\n");
}

static void show_around_edges(const Dt3 &t) {
    Rows<2> infinite;
    for (Dt3::All_edges_iterator e = t.all_edges_begin(); e != t.all_edges_end(); ++e) {
        if (!t.is_infinite(*e)) continue;
        const unsigned a = e->first->vertex(e->second)->info(), b = e->first->vertex(e->third)->info();
        infinite.push_back({std::min(a, b), std::max(a, b)});
    }
    show("infinite edges", infinite);
    Rows<3> facets;
    for (const Dt3::Facet &f : t.all_facets()) {
        if (!t.is_infinite(f)) continue;
        std::array<unsigned, 3> row;
        for (int k = 0; k < 3; k++) row[static_cast<std::size_t>(k)] = f.first->vertex((f.second + k + 1) % 4)->info();
        std::sort(row.begin(), row.end());
        facets.push_back(row);
    }
    show("infinite facets", facets);
    for (const Dt3::Edge &e : t.finite_edges()) {
        const Dt3::Edge by_corners(e.first, e.second, e.third);
        Dt3::Cell_circulator c = t.incident_cells(e), second = t.incident_cells(by_corners, std::next(c, 1));
        if (Dt3::Cell_handle(++c) != Dt3::Cell_handle(second)) std::printf("not the next cell\n");
        Dt3::Facet_circulator f = t.incident_facets(e);
        for (int k = 0; k < 3; k++) {
            Dt3::Facet_circulator g = t.incident_facets(e, *f), h = t.incident_facets(e, t.mirror_facet(*f));
            const Dt3::Facet here = *f, same = *g, mirrored = t.mirror_facet(*h);
            if (here != same || (mirrored != here && t.mirror_facet(mirrored) != here)) std::printf("not the facet\n");
            ++f;
        }
    }
}

static void zones_in_space() {
    std::vector<std::pair<Point_3, unsigned>> points;
    for (unsigned i = 0; i < 40; i++) points.emplace_back(Point_3(anywhere(), anywhere(), anywhere()), i);
    Dt3 t(points.begin(), points.end());
    t.infinite_vertex()->info() = 9999;
    show_objects(t);
    show_around_edges(t);
    for (int i = 0; i < 12; i++) {
        show_zone(t, Point_3(2 * anywhere() - 0.5, 2 * anywhere() - 0.5, 2 * anywhere() - 0.5));
    }
    std::map<unsigned, Dt3::Vertex_handle> by_info = by_info_of(t);
    by_info[9999] = t.infinite_vertex();
    for (const auto &[a, v] : by_info) {
        std::printf("%u:", a);
        for (const auto &[b, w] : by_info) {
            Dt3::Cell_handle c, d;
            int i = 0, j = 0, k = 0, l = 0, m = 0;
            if (a == b || !t.is_edge(v, w, c, i, j)) continue;
            std::printf(" %u", b);
            if (c->vertex(i) != v || c->vertex(j) != w) std::printf(", which it is not");
            const int other = Dt3::next_around_edge(i, j);
            const Dt3::Vertex_handle third = c->vertex(other), fourth = c->vertex(6 - i - j - other);
            if (!t.is_facet(v, third, w, d, i, j, k) || d->vertex(j) != third) std::printf(", which is no facet");
            if (!t.is_cell(v, third, fourth, w, d, i, k, l, m) || d != c || d->vertex(l) != fourth ||
                d->vertex(m) != w) {
                std::printf(", which is no cell");
            }
        }
        std::vector<Dt3::Vertex_handle> vertices;
        std::vector<Dt3::Edge> edges, finite;
        std::vector<Dt3::Cell_handle> cells;
        t.incident_edges(v, std::back_inserter(edges));
        t.incident_cells(v, std::back_inserter(cells));
        t.adjacent_vertices(v, std::back_inserter(vertices));
        if (a != 9999) t.finite_incident_edges(v, std::back_inserter(finite));
        std::printf("; %lu %lu %lu %lu %lu\n", count(vertices.size()), count(edges.size()), count(finite.size()),
                    count(cells.size()), count(t.degree(v)));
    }
    // By the cells themselves.
    for (unsigned i = 0; i < 30; i++) {
        const Point_3 p(1.5 * anywhere() - 0.25, 1.5 * anywhere() - 0.25, 1.5 * anywhere() - 0.25);
        std::vector<Dt3::Cell_handle> cells;
        std::vector<Dt3::Facet> facets;
        t.find_conflicts(p, t.locate(p), std::back_inserter(facets), std::back_inserter(cells));
        t.insert_in_hole(p, cells.begin(), cells.end(), facets[0].first, facets[0].second)->info() = 40 + i;
    }
    show_space(t);
}

#endif  // ZONES_HPP
