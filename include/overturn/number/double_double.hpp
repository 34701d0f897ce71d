// DoubleDouble: an unevaluated sum of two doubles, with 31 decimal digits.
// Algorithms: Hida, Li & Bailey, "Algorithms for quad-double precision floating point arithmetic",
// 15th IEEE Symposium on Computer Arithmetic (2001); Joldes, Muller & Popescu, ACM Transactions on
// Mathematical Software 44 (2017) 15.
#pragma once

#include "overturn/number/number.hpp"
#include "overturn/number/unrolled.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace overturn {

/// high + low, |low| at most half an ulp of high. A sum or product with an infinity is NaN.
class DoubleDouble {
public:
    DoubleDouble() = default;
    template <class Value>
        requires std::is_arithmetic_v<Value>
    DoubleDouble(Value value) : high_(double(value)), low_(0)
    {}
    DoubleDouble(double high, double low) : high_(high), low_(low) {}

    double high() const { return high_; }
    double low() const { return low_; }

    template <class Value>
        requires std::is_arithmetic_v<Value>
    explicit operator Value() const
    {
        return Value(high_) + Value(low_);
    }

    [[gnu::always_inline]] friend DoubleDouble operator-(const DoubleDouble& a)
    {
        return {-a.high_, -a.low_};
    }
    [[gnu::always_inline]] friend DoubleDouble operator+(const DoubleDouble& a,
                                                         const DoubleDouble& b)
    {
        const DoubleDouble high = exact_sum(a.high_, b.high_);
        const DoubleDouble low = exact_sum(a.low_, b.low_);
        const DoubleDouble sum = exact_sum_of_ordered(high.high_, high.low_ + low.high_);
        return exact_sum_of_ordered(sum.high_, sum.low_ + low.low_);
    }
    [[gnu::always_inline]] friend DoubleDouble operator-(const DoubleDouble& a,
                                                         const DoubleDouble& b)
    {
        return a + -b;
    }
    [[gnu::always_inline]] friend DoubleDouble operator*(const DoubleDouble& a,
                                                         const DoubleDouble& b)
    {
        const DoubleDouble high = exact_product(a.high_, b.high_);
        const double low = arithmetic::fma(a.high_, b.low_, a.low_ * b.high_);
        return exact_sum_of_ordered(high.high_, high.low_ + low);
    }
    [[gnu::always_inline]] friend DoubleDouble operator/(const DoubleDouble& a,
                                                         const DoubleDouble& b)
    {
        const double first = a.high_ / b.high_;
        const DoubleDouble rest = a - b * DoubleDouble(first);
        const double second = rest.high_ / b.high_;
        const double third = (rest - b * DoubleDouble(second)).high_ / b.high_;
        return exact_sum_of_ordered(first, second) + DoubleDouble(third);
    }

    friend bool operator==(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ == b.high_ && (a.low_ == b.low_ || std::isinf(a.high_));
    }
    friend bool operator<(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
    }
    friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ < b.high_ || (a.high_ == b.high_ && !(a.low_ > b.low_));
    }
    friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

    friend DoubleDouble abs(const DoubleDouble& x) { return x.high_ < 0 ? -x : x; }
    friend DoubleDouble floor(const DoubleDouble& x)
    {
        const double high = std::floor(x.high_);
        return high == x.high_ ? exact_sum_of_ordered(high, std::floor(x.low_)) : high;
    }
    friend DoubleDouble ceil(const DoubleDouble& x) { return -floor(-x); }
    friend DoubleDouble ldexp(const DoubleDouble& x, int exponent)
    {
        return x.times_power_of_two(std::ldexp(1.0, exponent));
    }
    friend DoubleDouble sqrt(const DoubleDouble& x)
    {
        if (!(x.high_ > 0)) {
            return std::sqrt(x.high_);
        }
        const double root = std::sqrt(x.high_);
        return exact_sum_of_ordered(root, (x - exact_product(root, root)).high_ / (2 * root));
    }

    // To the accuracy of a double: for step sizes and first approximations.
    friend int ilogb(const DoubleDouble& x) { return std::ilogb(x.high_); }
    friend DoubleDouble log2(const DoubleDouble& x) { return std::log2(x.high_); }
    friend DoubleDouble cbrt(const DoubleDouble& x) { return std::cbrt(x.high_); }
    friend DoubleDouble pow(const DoubleDouble& x, const DoubleDouble& y)
    {
        return std::pow(x.high_, y.high_);
    }

    /// sin x and cos x for |x| < 2^20 [rad]; the errors are below 1e-31.
    static std::array<DoubleDouble, 2> of_angle(const DoubleDouble& x)
    {
        // Reduced by multiples of pi/2 in three parts, of which the first two have so few bits that
        // their products are exact; then by a quarter of the rest, whose angle is doubled twice.
        constexpr std::array half_pi{0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
        const double turns = std::nearbyint(x.high_ * 0x1.45f306dc9c883p-1);
        const DoubleDouble rest =
            ((x - DoubleDouble(turns * half_pi[0])) - DoubleDouble(turns * half_pi[1])) -
            exact_product(turns, half_pi[2]);
        const auto [sine, cosine_less_one] =
            doubled(doubled(series_of_sine(rest.times_power_of_two(0.25))));
        const DoubleDouble cosine = cosine_less_one + DoubleDouble(1);
        switch (std::int64_t(turns) & 3) {
        case 0: return {sine, cosine};
        case 1: return {cosine, -sine};
        case 2: return {-sine, -cosine};
        default: return {-cosine, sine};
        }
    }

    static DoubleDouble pi() { return {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53}; }

private:
    DoubleDouble times_power_of_two(double factor) const { return {high_ * factor, low_ * factor}; }

    [[gnu::always_inline]] static DoubleDouble exact_sum_of_ordered(double larger, double smaller)
    {
        const double sum = larger + smaller;
        return {sum, smaller - (sum - larger)};
    }
    [[gnu::always_inline]] static DoubleDouble exact_sum(double a, double b)
    {
        const double sum = a + b;
        const double of_b = sum - a;
        return {sum, (a - (sum - of_b)) + (b - of_b)};
    }
    [[gnu::always_inline]] static DoubleDouble exact_product(double a, double b)
    {
        const double product = a * b;
        return {product, arithmetic::fma(a, b, -product)};
    }

    /// sin x and cos x - 1 for |x| <= 0.2.
    static std::array<DoubleDouble, 2> series_of_sine(const DoubleDouble& x)
    {
        const DoubleDouble square = x * x;
        DoubleDouble sine(0);
        DoubleDouble cosine_less_one(0);
        unrolled<10>([&]<int i>() {
            constexpr int n = 20 - 2 * i;
            // 1 - x^2 / (n (n + 1)) (...), and likewise for the cosine.
            sine = -square * inverse(n * (n + 1)) * (sine + DoubleDouble(1));
            cosine_less_one = -square * inverse(n * (n - 1)) * (cosine_less_one + DoubleDouble(1));
        });
        return {x + x * sine, cosine_less_one};
    }

    [[gnu::always_inline]] static DoubleDouble inverse(int n)
    {
        return DoubleDouble(1) / DoubleDouble(n);
    }

    /// The sine, and the cosine less 1, of the double angle.
    static std::array<DoubleDouble, 2> doubled(const std::array<DoubleDouble, 2>& of_half)
    {
        const auto& [sine, cosine_less_one] = of_half;
        const DoubleDouble product = sine * cosine_less_one;
        return {(sine + product).times_power_of_two(2), (sine * sine).times_power_of_two(-2)};
    }

    double high_;
    double low_;
};

} // namespace overturn

namespace std {

/// epsilon() covers the errors of all operations.
template <>
class numeric_limits<overturn::DoubleDouble> {
    using T = overturn::DoubleDouble;

public:
    static constexpr bool is_specialized = true;
    static constexpr int digits = 102;
    static T epsilon() { return 0x1p-101; }
    static T infinity() { return {std::numeric_limits<double>::infinity(), 0}; }
    static T quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
};

} // namespace std

namespace overturn {

[[gnu::always_inline]] inline DoubleDouble fma(const DoubleDouble& a, const DoubleDouble& b,
                                               const DoubleDouble& c)
{
    return a * b + c;
}

template <>
struct number_traits<DoubleDouble> : scalar_number_traits<DoubleDouble> {
    static DoubleDouble pi() { return DoubleDouble::pi(); }
};

/// Both at once; preferred to the template of elementary.hpp.
inline SineAndCosine<DoubleDouble> sine_and_cosine(const DoubleDouble& x)
{
    const auto [sine, cosine] = DoubleDouble::of_angle(x);
    return {sine, cosine};
}
inline DoubleDouble sin(const DoubleDouble& x)
{
    return sine_and_cosine(x).sine;
}
inline DoubleDouble cos(const DoubleDouble& x)
{
    return sine_and_cosine(x).cosine;
}
inline DoubleDouble tan(const DoubleDouble& x)
{
    const auto [sine, cosine] = sine_and_cosine(x);
    return sine / cosine;
}

} // namespace overturn
