// What a program gives as points, with infos or without: see cgal.hpp.
#ifndef DELDRIFT_CGAL_GIVEN_HPP
#define DELDRIFT_CGAL_GIVEN_HPP

#include <tuple>
#include <type_traits>
#include <utility>

namespace deldrift::cgal::detail {

// Whether values can be read one after the other, from an iterator to an end, which may be of another type. Iterators
// may read once only, make their values, and be impossible to copy.
template <class Iterator, class End, class = void>
struct Is_sequence : std::false_type {};
template <class Iterator, class End>
struct Is_sequence<Iterator, End,
                   std::void_t<decltype(*std::declval<Iterator &>()), decltype(++std::declval<Iterator &>()),
                               decltype(std::declval<Iterator &>() != std::declval<const End &>())>>
    : std::true_type {};

template <class Element, class = void>
struct Has_members : std::false_type {};
template <class Element>
struct Has_members<Element, std::void_t<decltype(std::declval<Element>().first, std::declval<Element>().second)>>
    : std::true_type {};

// A point with its info, from one of: a point; a pair; a tuple, also of references; what converts to a point or a pair.
template <class Point, class Info, class Element>
std::pair<Point, Info> point_and_info(Element &&element) {
    if constexpr (std::is_convertible_v<Element, Point>) {
        Point p = std::forward<Element>(element);
        return {std::move(p), Info{}};
    } else if constexpr (std::is_convertible_v<Element, std::pair<Point, Info>>) {
        return std::forward<Element>(element);
    } else if constexpr (Has_members<Element>::value) {
        return std::pair<Point, Info>(std::forward<Element>(element).first, std::forward<Element>(element).second);
    } else {
        using std::get;
        return std::pair<Point, Info>(get<0>(std::forward<Element>(element)), get<1>(std::forward<Element>(element)));
    }
}

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_GIVEN_HPP
