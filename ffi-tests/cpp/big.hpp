// Signs in exact arithmetic, for checks of what cgal.hpp gives.
#ifndef BIG_HPP
#define BIG_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "check.hpp"

// Whole numbers of any size.
class Big {
public:
    Big() = default;
    // x times 2^(-exponent), where that is whole.
    Big(double x, int exponent) : is_negative_(x < 0) {
        int own = 0;
        auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(x), &own), 53));
        if (mantissa == 0) return;
        const int shift = own - 53 - exponent;
        CHECK(shift >= 0);
        digits_.assign(static_cast<std::size_t>(shift / 32), 0);
        for (unsigned carry = static_cast<unsigned>(shift % 32), k = 0; k < 4; k++) {
            digits_.push_back(static_cast<std::uint32_t>(mantissa << carry));
            mantissa >>= 32 - carry;
            carry = 0;
        }
        trim();
    }
    int sign() const { return digits_.empty() ? 0 : is_negative_ ? -1 : 1; }
    friend Big operator*(const Big &a, const Big &b) {
        Big c;
        c.is_negative_ = a.is_negative_ != b.is_negative_;
        c.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
        for (std::size_t i = 0; i < a.digits_.size(); i++) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; j < b.digits_.size(); j++) {
                carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + c.digits_[i + j];
                c.digits_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32;
            }
            c.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
        }
        c.trim();
        return c;
    }
    friend Big operator-(const Big &a) {
        Big b = a;
        b.is_negative_ = !a.is_negative_;
        return b;
    }
    friend Big operator+(const Big &a, const Big &b) {
        if (a.is_negative_ != b.is_negative_) return is_less(a, b) ? without(b, a) : without(a, b);
        Big c = a;
        c.digits_.resize(std::max(a.digits_.size(), b.digits_.size()) + 1);
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < c.digits_.size(); i++) {
            carry += std::uint64_t{c.digits_[i]} + (i < b.digits_.size() ? b.digits_[i] : 0);
            c.digits_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        c.trim();
        return c;
    }
    friend Big operator-(const Big &a, const Big &b) { return a + (-b); }

private:
    // By magnitude.
    static bool is_less(const Big &a, const Big &b) {
        if (a.digits_.size() != b.digits_.size()) return a.digits_.size() < b.digits_.size();
        return std::lexicographical_compare(a.digits_.rbegin(), a.digits_.rend(), b.digits_.rbegin(), b.digits_.rend());
    }
    // The difference of the magnitudes, of which the first is the larger, with the sign of the first.
    static Big without(const Big &a, const Big &b) {
        Big c = a;
        std::int64_t carry = 0;
        for (std::size_t i = 0; i < c.digits_.size(); i++) {
            carry += std::int64_t{c.digits_[i]} - (i < b.digits_.size() ? std::int64_t{b.digits_[i]} : 0);
            c.digits_[i] = static_cast<std::uint32_t>(carry);
            carry = carry < 0 ? -1 : 0;
        }
        c.trim();
        return c;
    }
    void trim() {
        while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
    }

    bool is_negative_ = false;
    // The least first.
    std::vector<std::uint32_t> digits_{};
};

struct Place {
    Big x, y;
};

inline Big cross(const Place &a, const Place &b, const Place &p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Rows of 2 coordinates, all times one power of two by which they are whole.
inline std::vector<Place> places_of(const std::vector<double> &numbers) {
    int least = 0;
    for (double x : numbers) {
        int exponent = 0;
        std::frexp(x, &exponent);
        if (x < 0 || x > 0) least = std::min(least, exponent - 53);
    }
    std::vector<Place> places;
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
        places.push_back({Big(numbers[i], least), Big(numbers[i + 1], least)});
    }
    return places;
}

#endif  // BIG_HPP
