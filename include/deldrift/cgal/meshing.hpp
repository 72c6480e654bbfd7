// Delaunay_mesher_2, its criteria, and refine_Delaunay_mesh_2: see cgal.hpp.
#ifndef DELDRIFT_CGAL_MESHING_HPP
#define DELDRIFT_CGAL_MESHING_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <list>
#include <locale>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "constrained.hpp"

namespace deldrift::cgal {

// The least angle of faces, by the square of its sine: up to that of 34 degrees. 0.125 is that of 20.7 degrees.
template <class Tr>
class Delaunay_mesh_criteria_2 {
public:
    explicit Delaunay_mesh_criteria_2(double aspect_bound = 0.125,
                                      const typename Tr::Geom_traits & = typename Tr::Geom_traits())
        : bound_(aspect_bound) {}
    double bound() const noexcept { return bound_; }
    void set_bound(double aspect_bound) noexcept { bound_ = aspect_bound; }

private:
    double bound_;
};

// The greatest length of edges besides; 0 for any.
template <class Tr>
class Delaunay_mesh_size_criteria_2 : public Delaunay_mesh_criteria_2<Tr> {
public:
    explicit Delaunay_mesh_size_criteria_2(double aspect_bound = 0.125, double size_bound = 0,
                                           const typename Tr::Geom_traits &traits = typename Tr::Geom_traits())
        : Delaunay_mesh_criteria_2<Tr>(aspect_bound, traits), size_bound_(size_bound) {}
    double size_bound() const noexcept { return size_bound_; }
    void set_size_bound(double size_bound) noexcept { size_bound_ = size_bound; }

private:
    double size_bound_;
};

namespace detail {

template <class Tr>
double size_bound_of(const Delaunay_mesh_criteria_2<Tr> &) noexcept {
    return 0;
}
template <class Tr>
double size_bound_of(const Delaunay_mesh_size_criteria_2<Tr> &criteria) noexcept {
    return criteria.size_bound();
}

inline Error no_bound(const char *name, double bound, const std::string &range) {
    std::ostringstream what;
    what.imbue(std::locale::classic());
    what << "the " << name << " bound is " << bound << ", and must be " << range;
    return Error(DELDRIFT_INVALID_VALUE, what.str());
}
// For a triangulation with so many ids.
template <class Criteria>
Quality quality_of(const Criteria &criteria, std::size_t n_ids) {
    const double degree = std::acos(-1.0) / 180, greatest_angle = 34;
    const double greatest_sine = std::sin(greatest_angle * degree);
    const double bound = criteria.bound(), size_bound = size_bound_of(criteria);
    if (!(bound >= 0 && bound <= greatest_sine * greatest_sine)) {
        throw no_bound("aspect", bound, "from 0 to 0.3127, the squared sine of 34 degrees");
    }
    if (!(size_bound >= 0)) throw no_bound("size", size_bound, "0 or more");
    Quality quality;
    quality.least_angle = (std::min)(std::asin(std::sqrt(bound)) / degree, greatest_angle);
    if (size_bound > 0) quality.sizes.assign(n_ids, size_bound);
    return quality;
}

}  // namespace detail

// Refines the faces of a constrained Delaunay triangulation that are in its domain, until they fulfil the criteria: that is
// deldrift_refine. Vertices and constraints stay, constraints in pieces; handles of vertices stay valid.
//     deldrift::cgal::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(0.125, 0.5));
//     mesher.refine_mesh();
//     for (Cdt::Face_handle f : cdt.finite_face_handles()) if (f->is_in_domain()) draw(f);
// Crit is Delaunay_mesh_size_criteria_2<Tr> or Delaunay_mesh_criteria_2<Tr>. A call that throws has no effect on faces and
// vertices; it throws Error.
template <class Tr, class Crit = Delaunay_mesh_size_criteria_2<Tr>>
class Delaunay_mesher_2 {
    static_assert(std::is_same_v<Crit, Delaunay_mesh_size_criteria_2<Tr>> ||
                      std::is_same_v<Crit, Delaunay_mesh_criteria_2<Tr>>,
                  "criteria are deldrift::cgal::Delaunay_mesh_size_criteria_2 or Delaunay_mesh_criteria_2");

public:
    using Triangulation = Tr;
    using Criteria = Crit;
    using Seeds = std::list<typename Tr::Point>;
    using Seeds_iterator = typename Seeds::const_iterator;
    using Seeds_const_iterator = Seeds_iterator;

    explicit Delaunay_mesher_2(Tr &t, const Criteria &criteria = Criteria()) : t_(t), criteria_(criteria) {}

    // With seeds: the regions that they are in are inside, if mark is true, or else those in which there is none. Without:
    // all regions are. What is connected with the outside is outside in either case. A seed that is exactly on the
    // boundary of regions is an exception when faces are marked.
    template <class Iterator>
    void set_seeds(Iterator first, Iterator last, bool mark = false, bool do_it_now = false) {
        seeds_.assign(first, last);
        mark_ = mark;
        if (do_it_now) mark_facets();
    }
    void clear_seeds() noexcept {
        seeds_.clear();
        mark_ = false;
    }
    Seeds_const_iterator seeds_begin() const noexcept { return seeds_.begin(); }
    Seeds_const_iterator seeds_end() const noexcept { return seeds_.end(); }

    // Marks faces by the seeds; with domain_specified as the program has marked them, but for those that are connected with
    // the outside. Where marks differ there have to be constraints.
    void mark_facets(bool domain_specified = false) {
        if (!domain_specified) return mark_facets(t_, seeds_.begin(), seeds_.end(), mark_);
        const std::vector<std::uint32_t> levels = t_.nesting_levels();
        for (const auto f : t_.all_face_handles()) {
            if (f.is_infinite() || levels[f.id()] == 0) f.set_in_domain(false);
        }
    }
    template <class Iterator>
    static void mark_facets(Tr &t, Iterator first, Iterator last, bool mark = false) {
        std::vector<std::array<double, 2>> places;
        for (; first != last; ++first) places.push_back(detail::Coordinates<2, typename Tr::Geom_traits>::of(*first));
        const std::vector<std::uint32_t> levels = t.nesting_levels();
        const std::vector<std::int32_t> marks_of_seeds(places.size(), mark ? 1 : 0);
        const std::int32_t others = places.empty() || !mark ? 1 : 0;
        const std::vector<std::int32_t> marks = t.triangulation().label_cells(places, marks_of_seeds, others);
        for (const auto f : t.all_face_handles()) {
            f.set_in_domain(!f.is_infinite() && levels[f.id()] > 0 && marks[f.id()] == 1);
        }
    }

    void init(bool domain_specified = false) {
        mark_facets(domain_specified);
        is_domain_specified_ = domain_specified;
        is_marked_ = true;
    }
    // Marks faces first, unless init() or an earlier call has, and the program has not changed the triangulation since.
    void refine_mesh() {
        if (!is_marked_ || !t_.mesh()->has_marks()) init(is_domain_specified_);
        t_.refine_domain(detail::quality_of(criteria_, t_.triangulation().id_count()));
    }

    // Faces are always looked at anew.
    void set_criteria(const Criteria &criteria, bool = true) { criteria_ = criteria; }
    const Criteria &get_criteria() const noexcept { return criteria_; }
    const Triangulation &triangulation() const noexcept { return t_; }

private:
    Tr &t_;
    Criteria criteria_;
    Seeds seeds_{};
    bool mark_ = false, is_domain_specified_ = false, is_marked_ = false;
};

// The parameters by name, as since CGAL 5.6:
//     refine_Delaunay_mesh_2(cdt, parameters::criteria(Criteria(0.125, 0.5)).seeds(list_of_seeds));
namespace parameters {

struct By_default {};

template <class Criteria, class Seeds>
class Of_meshing {
public:
    explicit Of_meshing(const Criteria &criteria, const Seeds &seeds, bool are_inside = false, bool is_marked = false)
        : criteria_(criteria), seeds_(seeds), are_inside_(are_inside), is_marked_(is_marked) {}
    template <class C>
    Of_meshing<C, Seeds> criteria(const C &criteria) const {
        return Of_meshing<C, Seeds>(criteria, seeds_, are_inside_, is_marked_);
    }
    template <class S>
    Of_meshing<Criteria, S> seeds(const S &seeds) const {
        return Of_meshing<Criteria, S>(criteria_, seeds, are_inside_, is_marked_);
    }
    Of_meshing seeds_are_in_domain(bool are_inside) const {
        return Of_meshing(criteria_, seeds_, are_inside, is_marked_);
    }
    Of_meshing domain_is_initialized(bool is_marked) const {
        return Of_meshing(criteria_, seeds_, are_inside_, is_marked);
    }

    template <class Tr>
    void refine(Tr &t) const {
        if constexpr (std::is_same_v<Criteria, By_default>) {
            refine_by(Delaunay_mesher_2<Tr>(t));
        } else {
            refine_by(Delaunay_mesher_2<Tr, Criteria>(t, criteria_));
        }
    }

private:
    template <class Mesher>
    void refine_by(Mesher mesher) const {
        if constexpr (!std::is_same_v<Seeds, By_default>) mesher.set_seeds(seeds_.begin(), seeds_.end(), are_inside_);
        mesher.init(is_marked_);
        mesher.refine_mesh();
    }

    Criteria criteria_;
    Seeds seeds_;
    bool are_inside_, is_marked_;
};

template <class Criteria>
auto criteria(const Criteria &criteria) {
    return Of_meshing<Criteria, By_default>(criteria, {});
}
template <class Seeds>
auto seeds(const Seeds &seeds) {
    return Of_meshing<By_default, Seeds>({}, seeds);
}
inline auto seeds_are_in_domain(bool are_inside) {
    return Of_meshing<By_default, By_default>({}, {}, are_inside);
}
inline auto domain_is_initialized(bool is_marked) {
    return Of_meshing<By_default, By_default>({}, {}, false, is_marked);
}

}  // namespace parameters

// The domain is what is not connected with the outside, or, with domain_specified, what the program has marked.
template <class Tr, class Criteria = Delaunay_mesh_size_criteria_2<Tr>>
void refine_Delaunay_mesh_2(Tr &t, const Criteria &criteria = Criteria(), bool domain_specified = false) {
    Delaunay_mesher_2<Tr, Criteria> mesher(t, criteria);
    mesher.init(domain_specified);
    mesher.refine_mesh();
}
// With seeds: see Delaunay_mesher_2::set_seeds.
template <class Tr, class Iterator, class Criteria = Delaunay_mesh_size_criteria_2<Tr>>
void refine_Delaunay_mesh_2(Tr &t, Iterator first, Iterator last, const Criteria &criteria = Criteria(),
                            bool mark = false) {
    Delaunay_mesher_2<Tr, Criteria> mesher(t, criteria);
    mesher.set_seeds(first, last, mark);
    mesher.refine_mesh();
}
template <class Tr, class Criteria, class Seeds>
void refine_Delaunay_mesh_2(Tr &t, const parameters::Of_meshing<Criteria, Seeds> &parameters) {
    parameters.refine(t);
}

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_MESHING_HPP
