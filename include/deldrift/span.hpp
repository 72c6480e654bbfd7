// deldrift::Error and deldrift::span: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_SPAN_HPP
#define DELDRIFT_SPAN_HPP

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#if __has_include(<version>)
#include <version>
#endif
#ifdef __cpp_lib_ranges
#include <ranges>
#endif

#include "../deldrift.h"

namespace deldrift {

#ifdef __clang__
#pragma clang diagnostic push
// A class of a header alone has no file for its table of virtual functions.
#pragma clang diagnostic ignored "-Wweak-vtables"
#endif
// A call failed: what() names the argument, the index and the value.
class Error : public std::runtime_error {
public:
    explicit Error(deldrift_status status, const std::string &message = deldrift_last_error())
        : std::runtime_error(message), status_(status) {}
    deldrift_status status() const noexcept { return status_; }

private:
    deldrift_status status_;
};
#ifdef __clang__
#pragma clang diagnostic pop
#endif

// Contiguous values that belong to someone else: a pointer and a count. Converts from and to std::span.
template <class T>
class span {
public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using pointer = T *;
    using reference = T &;
    using iterator = T *;
    using const_iterator = const T *;
    using reverse_iterator = std::reverse_iterator<iterator>;

    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    // Of anything with data() and size(): vectors, arrays, std::span.
    template <class C, class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<C &>().data()), T *>>>
    constexpr span(C &&values) noexcept : data_(values.data()), size_(values.size()) {}
    template <std::size_t N>
    constexpr span(T (&values)[N]) noexcept : data_(values), size_(N) {}
    // Of values in braces, for the duration of the call that they are written in.
    template <class U = T, class = std::enable_if_t<std::is_const_v<U>>>
    constexpr span(std::initializer_list<std::remove_const_t<U>> values) noexcept : size_(values.size()) {
        data_ = values.begin();
    }

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T &front() const noexcept { return data_[0]; }
    constexpr T &back() const noexcept { return data_[size_ - 1]; }
    constexpr span subspan(std::size_t first, std::size_t count) const noexcept { return {data_ + first, count}; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr reverse_iterator rbegin() const noexcept { return reverse_iterator(end()); }
    constexpr reverse_iterator rend() const noexcept { return reverse_iterator(begin()); }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace deldrift

#ifdef __cpp_lib_ranges
template <class T>
inline constexpr bool std::ranges::enable_borrowed_range<deldrift::span<T>> = true;
template <class T>
inline constexpr bool std::ranges::enable_view<deldrift::span<T>> = true;
#endif

#endif  // DELDRIFT_SPAN_HPP
