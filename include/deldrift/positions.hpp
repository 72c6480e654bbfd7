// Positions in the arrangement that a program has them in: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_POSITIONS_HPP
#define DELDRIFT_POSITIONS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include "span.hpp"

namespace deldrift {

// Which numbers an element of a container has at its beginning: `scalar`, and `count` of them, or 0 for a number on its
// own. To be specialised for a program's own points:
//     template <>
//     struct deldrift::point_layout<Vec3> {
//         using scalar = float;
//         static constexpr std::uint32_t count = 3;
//     };
template <class P>
struct point_layout {};
template <>
struct point_layout<double> {
    using scalar = double;
    static constexpr std::uint32_t count = 0;
};
template <>
struct point_layout<float> {
    using scalar = float;
    static constexpr std::uint32_t count = 0;
};
template <class S, std::size_t N>
struct point_layout<std::array<S, N>> {
    using scalar = S;
    static constexpr std::uint32_t count = N;
};
template <class S, std::size_t N>
struct point_layout<S[N]> {
    using scalar = S;
    static constexpr std::uint32_t count = N;
};

// What a contiguous container has.
template <class C>
using element_of = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const C &>()))>>;

// Positions to read during the call that they are passed to: numbers one after the other or points, in any contiguous
// container, or what strided() and separate() give. Numbers may be double or float, each of which is a double exactly.
// Only doubles that lie one after the other are read without a copy. What does not lie in memory in a row (lists,
// streams, views that make their elements) is refused when it is compiled: it goes to a vector first.
class Positions {
public:
    Positions() = default;
    // Of numbers in braces, for the duration of the call that they are written in.
    Positions(std::initializer_list<double> numbers) noexcept
        : Positions(numbers.begin(), numbers.size(), sizeof(double), Kind::numbers) {}
    // Of vectors, arrays and spans, of numbers or of points.
    template <class C, class P = element_of<C>, class = typename point_layout<P>::scalar>
    Positions(const C &values) noexcept
        : Positions(numbers_of(std::data(values)), std::size(values), sizeof(P),
                    point_layout<P>::count == 0 ? Kind::numbers : Kind::points) {
        coordinates_ = point_layout<P>::count;
    }

    // count points, the coordinates of each one after the other, n_bytes from one point to the next.
    template <class S>
    static Positions strided(const S *first, std::size_t count, std::ptrdiff_t n_bytes) noexcept {
        return {first, count, n_bytes, Kind::points};
    }
    // Of a member of structures in a container: strided(particles, &Particle::position).
    template <class C, class Struct, class P>
    static Positions strided(const C &values, P Struct::*member) noexcept {
        const Struct *first = std::data(values);
        if (std::size(values) == 0) return {};
        Positions positions(numbers_of(&(first->*member)), std::size(values), sizeof(Struct), Kind::points);
        positions.coordinates_ = point_layout<P>::count;
        return positions;
    }
    // Coordinates that have arrays of their own.
    static Positions separate(span<const double> x, span<const double> y) { return of_axes<double>({x, y}); }
    static Positions separate(span<const float> x, span<const float> y) { return of_axes<float>({x, y}); }
    static Positions separate(span<const double> x, span<const double> y, span<const double> z) {
        return of_axes<double>({x, y, z});
    }
    static Positions separate(span<const float> x, span<const float> y, span<const float> z) {
        return of_axes<float>({x, y, z});
    }

    // All of them one after the other, as deldrift.h wants them: where they are, or copied to room.
    span<const double> numbers(const char *argument, std::uint32_t dimension, std::vector<double> &room) const {
        if (kind_ == Kind::points && dimension != 2 && dimension != 3) {
            throw Error(DELDRIFT_INVALID_DIMENSION,
                        "dimension is " + std::to_string(dimension) + ", but must be 2 or 3");
        }
        return rows(argument, dimension, room);
    }
    // What has `width` numbers in a row, 4 at most, as half-spaces do.
    span<const double> rows(const char *argument, std::uint32_t width, std::vector<double> &room) const {
        if (coordinates_ > 0 && coordinates_ != width) {
            throw Error(DELDRIFT_WRONG_COUNT, argument + (" have " + std::to_string(coordinates_)) +
                                                  " coordinates each, but must have " + std::to_string(width));
        }
        const std::size_t n_axes = kind_ == Kind::numbers ? 1 : width;
        if (is_in_place(n_axes)) return {reinterpret_cast<const double *>(axes_[0]), count_ * n_axes};
        if (axes_[0] == nullptr && count_ > 0) throw Error(DELDRIFT_NULL_ARGUMENT, argument + std::string(" is NULL"));
        room.resize(count_ * n_axes);
        is_float_ ? copy<float>(n_axes, room.data()) : copy<double>(n_axes, room.data());
        return room;
    }

private:
    enum class Kind : std::uint8_t { numbers, points };

    template <class S>
    Positions(const S *first, std::size_t count, std::ptrdiff_t n_bytes, Kind kind) noexcept
        : stride_(n_bytes), count_(count), kind_(kind), is_float_(std::is_same_v<S, float>) {
        static_assert(std::is_same_v<S, double> || std::is_same_v<S, float>, "coordinates are double or float");
        for (std::size_t k = 0; first != nullptr && k < 4; k++) {
            axes_[k] = reinterpret_cast<const unsigned char *>(first) + k * sizeof(S);
        }
    }
    template <class P>
    static const typename point_layout<P>::scalar *numbers_of(const P *points) noexcept {
        static_assert(sizeof(P) >= point_layout<P>::count * sizeof(typename point_layout<P>::scalar));
        return reinterpret_cast<const typename point_layout<P>::scalar *>(points);
    }
    template <class S>
    static Positions of_axes(std::initializer_list<span<const S>> axes) {
        static constexpr const char *names[] = {"x", "y", "z"};
        Positions positions(axes.begin()->data(), axes.begin()->size(), sizeof(S), Kind::points);
        positions.coordinates_ = static_cast<std::uint32_t>(axes.size());
        for (std::size_t k = 0; k < axes.size(); k++) {
            const span<const S> axis = axes.begin()[k];
            if (axis.size() != positions.count_) {
                throw Error(DELDRIFT_WRONG_COUNT, names[k] + (" has " + std::to_string(axis.size())) +
                                                      " numbers, but must have " + std::to_string(positions.count_));
            }
            positions.axes_[k] = reinterpret_cast<const unsigned char *>(axis.data());
        }
        return positions;
    }

    bool is_in_place(std::size_t n_axes) const noexcept {
        bool is_so = !is_float_ && stride_ == static_cast<std::ptrdiff_t>(n_axes * sizeof(double)) &&
                     reinterpret_cast<std::uintptr_t>(axes_[0]) % alignof(double) == 0;
        for (std::size_t k = 1; is_so && axes_[0] != nullptr && k < n_axes; k++) {
            is_so = axes_[k] == axes_[0] + k * sizeof(double);
        }
        return is_so;
    }
    template <class S>
    void copy(std::size_t n_axes, double *to) const noexcept {
        for (std::size_t k = 0; k < n_axes; k++) {
            for (std::size_t i = 0; i < count_; i++) {
                S number;
                std::memcpy(&number, axes_[k] + static_cast<std::ptrdiff_t>(i) * stride_, sizeof number);
                to[i * n_axes + k] = static_cast<double>(number);
            }
        }
    }

    // Where each coordinate of the first point is, and how many bytes further that of the next one.
    const unsigned char *axes_[4] = {nullptr, nullptr, nullptr, nullptr};
    std::ptrdiff_t stride_ = sizeof(double);
    // Of points, or of numbers one after the other.
    std::size_t count_ = 0;
    // Of each point, 0 if that is not known.
    std::uint32_t coordinates_ = 0;
    Kind kind_ = Kind::numbers;
    bool is_float_ = false;
};

}  // namespace deldrift

#endif  // DELDRIFT_POSITIONS_HPP
