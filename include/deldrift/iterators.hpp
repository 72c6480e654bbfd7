// Iterators over what the triangulation does not store as objects: see deldrift.hpp, which includes this.
//
// A source knows the value of each index. Values are made when they are asked for, so operator* returns them by value
// (a row of a cell is itself only a view), and operator-> a pointer that lives as long as the expression it is in.
// An iterator carries its source along: it stays valid when the range that it comes from is gone, as long as the
// triangulation does not change.
#ifndef DELDRIFT_ITERATORS_HPP
#define DELDRIFT_ITERATORS_HPP

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

#include "span.hpp"

namespace deldrift {

// What operator-> returns where there is no object to point to.
template <class T>
class arrow {
public:
    explicit arrow(T value) : value_(std::move(value)) {}
    const T *operator->() const noexcept { return &value_; }

private:
    T value_;
};

// Over all indices, with random access. A source has `value operator()(std::size_t) const`.
template <class Source>
class indexed_iterator {
public:
    using value_type = std::decay_t<decltype(std::declval<const Source &>()(std::size_t{}))>;
    using reference = value_type;
    using pointer = arrow<value_type>;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::random_access_iterator_tag;

    indexed_iterator() = default;
    indexed_iterator(Source source, std::size_t index) : source_(source), index_(index) {}

    reference operator*() const { return source_(index_); }
    pointer operator->() const { return pointer(**this); }
    reference operator[](difference_type n) const { return *(*this + n); }

    indexed_iterator &operator++() noexcept { return *this += 1; }
    indexed_iterator &operator--() noexcept { return *this -= 1; }
    indexed_iterator operator++(int) noexcept { return std::exchange(*this, *this + 1); }
    indexed_iterator operator--(int) noexcept { return std::exchange(*this, *this - 1); }
    indexed_iterator &operator+=(difference_type n) noexcept {
        index_ += static_cast<std::size_t>(n);
        return *this;
    }
    indexed_iterator &operator-=(difference_type n) noexcept { return *this += -n; }
    friend indexed_iterator operator+(indexed_iterator i, difference_type n) noexcept { return i += n; }
    friend indexed_iterator operator+(difference_type n, indexed_iterator i) noexcept { return i += n; }
    friend indexed_iterator operator-(indexed_iterator i, difference_type n) noexcept { return i -= n; }
    friend difference_type operator-(const indexed_iterator &a, const indexed_iterator &b) noexcept {
        return static_cast<difference_type>(a.index_ - b.index_);
    }

    friend bool operator==(const indexed_iterator &a, const indexed_iterator &b) noexcept {
        return a.index_ == b.index_;
    }
    friend bool operator!=(const indexed_iterator &a, const indexed_iterator &b) noexcept { return !(a == b); }
    friend bool operator<(const indexed_iterator &a, const indexed_iterator &b) noexcept { return a.index_ < b.index_; }
    friend bool operator>(const indexed_iterator &a, const indexed_iterator &b) noexcept { return b < a; }
    friend bool operator<=(const indexed_iterator &a, const indexed_iterator &b) noexcept { return !(b < a); }
    friend bool operator>=(const indexed_iterator &a, const indexed_iterator &b) noexcept { return !(a < b); }

private:
    Source source_{};
    std::size_t index_ = 0;
};

// Over those indices that a source selects, in ascending order. A source has `bool selects(std::size_t) const`, too.
template <class Source>
class selecting_iterator {
public:
    using value_type = std::decay_t<decltype(std::declval<const Source &>()(std::size_t{}))>;
    using reference = value_type;
    using pointer = arrow<value_type>;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::bidirectional_iterator_tag;

    selecting_iterator() = default;
    selecting_iterator(Source source, std::size_t index, std::size_t end) : source_(source), index_(index), end_(end) {
        skip();
    }

    reference operator*() const { return source_(index_); }
    pointer operator->() const { return pointer(**this); }
    selecting_iterator &operator++() {
        index_++;
        skip();
        return *this;
    }
    selecting_iterator operator++(int) {
        selecting_iterator before = *this;
        ++*this;
        return before;
    }
    selecting_iterator &operator--() {
        do index_--;
        while (!source_.selects(index_));
        return *this;
    }
    selecting_iterator operator--(int) {
        selecting_iterator before = *this;
        --*this;
        return before;
    }

    friend bool operator==(const selecting_iterator &a, const selecting_iterator &b) noexcept {
        return a.index_ == b.index_;
    }
    friend bool operator!=(const selecting_iterator &a, const selecting_iterator &b) noexcept { return !(a == b); }

private:
    void skip() {
        while (index_ < end_ && !source_.selects(index_)) index_++;
    }

    Source source_{};
    std::size_t index_ = 0, end_ = 0;
};

// Two iterators.
template <class Iterator>
class range {
public:
    using iterator = Iterator;
    using const_iterator = Iterator;
    using value_type = typename Iterator::value_type;

    range() = default;
    range(Iterator begin, Iterator end) : begin_(std::move(begin)), end_(std::move(end)) {}
    Iterator begin() const { return begin_; }
    Iterator end() const { return end_; }
    bool empty() const { return begin_ == end_; }
    // In constant time where iterators have random access; else it walks.
    std::size_t size() const { return static_cast<std::size_t>(std::distance(begin_, end_)); }

private:
    Iterator begin_{}, end_{};
};

}  // namespace deldrift

#ifdef __cpp_lib_ranges
template <class Iterator>
inline constexpr bool std::ranges::enable_borrowed_range<deldrift::range<Iterator>> = true;
template <class Iterator>
inline constexpr bool std::ranges::enable_view<deldrift::range<Iterator>> = true;
#endif

#endif  // DELDRIFT_ITERATORS_HPP
