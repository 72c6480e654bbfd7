// Whatever points are read from: iterators that read once, that make or count what they give, that cannot be copied;
// proxies, tuples of references, infos that can only be moved. Each element is read once, in order.
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <deldrift/cgal.hpp>
#include <deque>
#include <iterator>
#include <list>
#include <memory>
#include <sstream>
#include <tuple>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::Positions;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using Dt2 = deldrift::cgal::Delaunay_triangulation_2<K, int>;
using Dt3 = deldrift::cgal::Delaunay_triangulation_3<K, int>;
using Owners = deldrift::cgal::Delaunay_triangulation_2<K, std::unique_ptr<int>>;

// Positions are read where they lie, so that what does not lie in a row is refused when it is compiled.
static_assert(std::is_convertible_v<std::vector<std::array<double, 2>>, Positions>);
static_assert(!std::is_convertible_v<std::list<std::array<double, 2>>, Positions>);
static_assert(!std::is_convertible_v<std::deque<double>, Positions>);
static_assert(!std::is_convertible_v<std::vector<bool>, Positions>);
static_assert(!std::is_convertible_v<std::vector<bool>, deldrift::span<const bool>>);
static_assert(!std::is_convertible_v<std::istream_iterator<double>, Positions>);

static constexpr int n_points = 40;

// On a spiral, no four of them on a circle but for rounding.
static double x_of(int i) { return std::cos(2.4 * i) * (1 + 0.37 * i); }
static double y_of(int i) { return std::sin(2.4 * i) * (1 + 0.37 * i); }

template <class Point>
static Point point(int i) {
    if constexpr (std::is_same_v<Point, Point_2>) {
        return Point(x_of(i), y_of(i));
    } else {
        return Point(x_of(i), y_of(i), std::cos(1.7 * i));
    }
}

template <class Point>
static std::vector<std::pair<Point, int>> all_points() {
    std::vector<std::pair<Point, int>> points;
    for (int i = 0; i < n_points; i++) points.emplace_back(point<Point>(i), i);
    return points;
}

template <class Dt>
static std::vector<int> infos_of(const Dt &t) {
    std::vector<int> infos;
    for (typename Dt::Vertex_handle v : t.finite_vertex_handles()) infos.push_back(v->info());
    return infos;
}

template <class Dt>
static std::vector<std::uint32_t> corners_of(const Dt &t) {
    const auto rows = t.triangulation().cells().vertices();
    return {rows.begin(), rows.end()};
}

// As many vertices as points, info i at point i, and the cells of points in a vector.
template <class Dt>
static bool is_whole(const Dt &t) {
    const auto points = all_points<typename Dt::Point>();
    const Dt expected(points.begin(), points.end());
    bool is_so = t.number_of_vertices() == n_points && t.is_valid() && corners_of(t) == corners_of(expected);
    for (typename Dt::Vertex_handle v : t.finite_vertex_handles()) {
        is_so = is_so && v->point() == point<typename Dt::Point>(v->info());
    }
    return is_so && infos_of(t) == infos_of(expected);
}

// Gives what a function makes of the number of times that it has been read. It can be moved only, and ends where
// another type says.
template <class Make>
class Generator {
public:
    struct End {
        int count;
    };
    explicit Generator(Make make) : make_(make) {}
    Generator(Generator &&) = default;
    Generator &operator=(Generator &&) = default;
    auto operator*() { return make_(n_read_++); }
    Generator &operator++() {
        n_steps_++;
        return *this;
    }
    bool operator!=(const End &end) const { return n_steps_ != end.count; }

private:
    Make make_;
    int n_read_ = 0, n_steps_ = 0;
};

template <class Dt>
static void generated() {
    using Point = typename Dt::Point;
    const auto pair = [](int i) { return std::make_pair(point<Point>(i), i); };
    using Pairs = Generator<decltype(pair)>;
    CHECK(is_whole(Dt(Pairs(pair), typename Pairs::End{n_points})));
    Dt t;
    CHECK(t.insert(Pairs(pair), typename Pairs::End{n_points}) == n_points && is_whole(t));
    CHECK(t.insert(Pairs(pair), typename Pairs::End{n_points}) == 0 && is_whole(t));

    const auto only_point = [](int i) { return point<Point>(i); };
    using Points = Generator<decltype(only_point)>;
    const Dt without_infos(Points(only_point), typename Points::End{n_points});
    CHECK(corners_of(without_infos) == corners_of(t));
}

// Counts how often each element is read, by any copy.
template <class Iterator>
class Counting {
public:
    using value_type = typename std::iterator_traits<Iterator>::value_type;
    using reference = typename std::iterator_traits<Iterator>::reference;
    using pointer = typename std::iterator_traits<Iterator>::pointer;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    Counting(Iterator first, std::vector<int> *reads) : at_(first), reads_(reads) {}
    reference operator*() const {
        (*reads_)[index_]++;
        return *at_;
    }
    pointer operator->() const { return &**this; }
    Counting &operator++() {
        ++at_;
        index_++;
        return *this;
    }
    bool operator!=(const Counting &other) const { return at_ != other.at_; }

private:
    Iterator at_;
    std::size_t index_ = 0;
    std::vector<int> *reads_;
};

template <class Dt>
static void read_once_each() {
    const auto points = all_points<typename Dt::Point>();
    std::vector<int> reads(n_points);
    using It = Counting<typename std::vector<std::pair<typename Dt::Point, int>>::const_iterator>;
    CHECK(is_whole(Dt(It(points.begin(), &reads), It(points.end(), &reads))));
    CHECK(reads == std::vector<int>(n_points, 1));
    // Points at places that are taken are sorted out without reading again, and so are those beside staged moves.
    Dt t;
    t.insert(points[3].first)->info() = 3;
    t.insert(It(points.begin(), &reads), It(points.end(), &reads));
    CHECK(reads == std::vector<int>(n_points, 2) && t.number_of_vertices() == n_points);
    t.stage_move(*t.finite_vertices_begin(), points[3].first);
    t.insert(It(points.begin(), &reads), It(points.end(), &reads));
    CHECK(reads == std::vector<int>(n_points, 3) && t.number_of_vertices() == n_points);
}

// Read from text: as a type with the members of a pair, and as one that converts to a point.
struct Sample {
    Point_2 first;
    int second = 0;
    friend std::istream &operator>>(std::istream &in, Sample &sample) {
        double x = 0, y = 0;
        in >> x >> y >> sample.second;
        sample.first = Point_2(x, y);
        return in;
    }
};
struct Place {
    double x = 0, y = 0;
    operator Point_2() const { return {x, y}; }
    friend std::istream &operator>>(std::istream &in, Place &place) { return in >> place.x >> place.y; }
};

static void from_streams() {
    std::ostringstream samples, places;
    samples.precision(17), places.precision(17);
    for (int i = 0; i < n_points; i++) samples << x_of(i) << ' ' << y_of(i) << ' ' << i << '\n';
    for (int i = 0; i < n_points; i++) places << x_of(i) << ' ' << y_of(i) << '\n';
    std::istringstream text(samples.str()), other_text(places.str());
    const Dt2 t{std::istream_iterator<Sample>(text), std::istream_iterator<Sample>()};
    CHECK(is_whole(t));
    const Dt2 other{std::istream_iterator<Place>(other_text), std::istream_iterator<Place>()};
    CHECK(corners_of(other) == corners_of(t));
}

// What stands for a pair that is not stored as one, as the elements of std::vector<bool> do.
struct Proxy {
    int i;
    operator std::pair<Point_2, int>() const { return {point<Point_2>(i), i}; }
};

// A tuple of somebody else's, whose get is found by its arguments.
namespace elsewhere {
struct Both {
    const Point_2 *p;
    const int *i;
};
template <int n>
decltype(auto) get(const Both &both) {
    if constexpr (n == 0) {
        return (*both.p);
    } else {
        return (*both.i);
    }
}
}  // namespace elsewhere

template <class Make>
static bool gives_all(Make make) {
    using It = Generator<Make>;
    return is_whole(Dt2(It(make), typename It::End{n_points}));
}

static void proxies_and_tuples() {
    std::vector<Point_2> points;
    std::vector<int> infos;
    for (int i = 0; i < n_points; i++) points.push_back(point<Point_2>(i)), infos.push_back(i);
    const auto at = [](auto &values, int i) -> auto & { return values[static_cast<std::size_t>(i)]; };
    CHECK(gives_all([](int i) { return Proxy{i}; }));
    CHECK(gives_all([&](int i) { return std::tuple<const Point_2 &, int &>(at(points, i), at(infos, i)); }));
    CHECK(gives_all([&](int i) { return std::pair<const Point_2 &, int &>(at(points, i), at(infos, i)); }));
    CHECK(gives_all([&](int i) { return std::make_tuple(at(points, i), short(i)); }));
    CHECK(gives_all([&](int i) { return elsewhere::Both{&at(points, i), &at(infos, i)}; }));
}

// Some of them twice, and some again where others are there already.
static void infos_that_can_only_be_moved() {
    const auto made = [](int first, int count) {
        std::vector<std::pair<Point_2, std::unique_ptr<int>>> points;
        for (int i = first; i < first + count; i++) {
            points.emplace_back(point<Point_2>(i), std::make_unique<int>(i));
        }
        return points;
    };
    const auto add_to = [](Owners &t, std::vector<std::pair<Point_2, std::unique_ptr<int>>> points) {
        return t.insert(std::make_move_iterator(points.begin()), std::make_move_iterator(points.end()));
    };
    const auto has_all = [](const Owners &t, std::size_t count) {
        for (Owners::Vertex_handle v : t.finite_vertex_handles()) {
            if (v->info() == nullptr || v->point() != point<Point_2>(*v->info())) return false;
        }
        return t.number_of_vertices() == count && t.is_valid();
    };
    Owners t;
    CHECK(add_to(t, made(0, 10)) == 10 && has_all(t, 10));
    auto twice = made(10, 10);
    for (auto &each : made(10, 10)) twice.push_back(std::move(each));
    CHECK(add_to(t, std::move(twice)) == 10 && has_all(t, 20));
    CHECK(add_to(t, made(15, 10)) == 5 && has_all(t, 25));
    t.stage_move(*t.finite_vertices_begin(), point<Point_2>(0));
    CHECK(add_to(t, made(20, 10)) == 5 && has_all(t, 30));
    const Owners other = std::move(t);
    CHECK(has_all(other, 30));
}

// An info whose copies fail when it is told to.
struct Fragile {
    int value = 0;
    static inline int left = 1 << 30;
    Fragile() = default;
    explicit Fragile(int given) : value(given) {}
    Fragile(const Fragile &other) : value(other.value) { spend(); }
    Fragile &operator=(const Fragile &other) {
        spend();
        value = other.value;
        return *this;
    }
    static void spend() {
        if (left-- == 0) throw 17;
    }
};

// Wherever a copy fails, the triangulation is as it was, and takes the points afterwards.
static void infos_that_cannot_be_copied_now() {
    using Dt = deldrift::cgal::Delaunay_triangulation_2<K, Fragile>;
    std::vector<std::pair<Point_2, Fragile>> points;
    for (int i = 0; i < 12; i++) points.emplace_back(point<Point_2>(i % 9), Fragile(i % 9));
    int n_failed = 0;
    for (bool fails = true; fails;) {
        Dt t(points.begin(), points.begin() + 4);
        fails = false;
        Fragile::left = n_failed;
        try {
            t.insert(points.begin() + 3, points.end());
        } catch (int) {
            fails = true;
        }
        Fragile::left = 1 << 30;
        n_failed += fails;
        if (fails) CHECK(t.number_of_vertices() == 4 && t.triangulation().id_count() == 4 && t.is_valid());
        t.insert(points.begin(), points.end());
        CHECK(t.number_of_vertices() == 9 && t.is_valid());
        for (Dt::Vertex_handle v : t.finite_vertex_handles()) CHECK(v->point() == point<Point_2>(v->info().value));
    }
    CHECK(n_failed > 20);
}

#ifdef __cpp_lib_ranges
#include <ranges>

// Iterators of views, which have no category of C++17, or an end of another type, or both.
static void views() {
    const auto pair = [](int i) { return std::make_pair(point<Point_2>(i), i); };
    auto transformed = std::views::iota(0, n_points) | std::views::transform(pair);
    CHECK(is_whole(Dt2(transformed.begin(), transformed.end())));
    auto endless = std::views::iota(0) | std::views::transform(pair) |
                   std::views::take_while([](const auto &each) { return each.second < n_points; });
    Dt2 t;
    CHECK(t.insert(endless.begin(), endless.end()) == n_points && is_whole(t));

    std::ostringstream samples;
    samples.precision(17);
    for (int i = 0; i < n_points; i++) samples << x_of(i) << ' ' << y_of(i) << ' ' << i << '\n';
    std::istringstream text(samples.str());
    auto read = std::ranges::istream_view<Sample>(text);
    CHECK(is_whole(Dt2(read.begin(), read.end())));
    static_assert(!std::is_convertible_v<decltype(transformed), Positions>);
    static_assert(std::is_convertible_v<std::ranges::subrange<const double *>, Positions>);
}
#else
static void views() {}
#endif

int main() {
    generated<Dt2>();
    generated<Dt3>();
    read_once_each<Dt2>();
    read_once_each<Dt3>();
    from_streams();
    proxies_and_tuples();
    infos_that_can_only_be_moved();
    infos_that_cannot_be_copied_now();
    views();
}
