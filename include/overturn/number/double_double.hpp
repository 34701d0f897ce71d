// DoubleDouble: an unevaluated sum of two doubles, or of two packs, with 31 decimal digits.
// Algorithms: Hida, Li & Bailey, "Algorithms for quad-double precision floating point arithmetic",
// 15th IEEE Symposium on Computer Arithmetic (2001); Joldes, Muller & Popescu, ACM Transactions on
// Mathematical Software 44 (2017) 15.
#pragma once

#include "overturn/number/elementary.hpp"
#include "overturn/number/number.hpp"
#include "overturn/number/unrolled.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace overturn {

/// 1 / n! for n = 2, 3, ..., 21: the high and the low part.
inline constexpr double inverse_factorials_in_two_parts[][2] = {
    {0x1p-1, 0x0p+0},
    {0x1.5555555555555p-3, 0x1.5555555555555p-57},
    {0x1.5555555555555p-5, 0x1.5555555555555p-59},
    {0x1.1111111111111p-7, 0x1.1111111111111p-63},
    {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
    {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
    {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
    {0x1.71de3a556c734p-19, -0x1.c154f8ddc6cp-73},
    {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
    {0x1.ae64567f544e4p-26, -0x1.c062e06d1f209p-80},
    {0x1.1eed8eff8d898p-29, -0x1.2aec959e14c06p-83},
    {0x1.6124613a86d09p-33, 0x1.f28e0cc748ebep-87},
    {0x1.93974a8c07c9dp-37, 0x1.05d6f8a2efd1fp-92},
    {0x1.ae7f3e733b81fp-41, 0x1.1d8656b0ee8cbp-97},
    {0x1.ae7f3e733b81fp-45, 0x1.1d8656b0ee8cbp-101},
    {0x1.952c77030ad4ap-49, 0x1.ac981465ddc6cp-103},
    {0x1.6827863b97d97p-53, 0x1.eec01221a8b0bp-107},
    {0x1.2f49b46814157p-57, 0x1.2650f61dbdcb4p-112},
    {0x1.e542ba4020225p-62, 0x1.ea72b4afe3c2fp-120},
    {0x1.71b8ef6dcf572p-66, -0x1.d043ae40c4647p-120},
};

/// high + low, |low| at most half an ulp of high. A sum or product with an infinity is NaN. D:
/// double or Pack; all operations have the same bits in a double and in every lane of a pack.
template <class D>
class DoubleDouble {
    using Mask = mask_t<D>;

public:
    DoubleDouble() = default;
    template <class Value>
        requires std::is_arithmetic_v<Value>
    DoubleDouble(Value value) : high_(double(value)), low_(0.0)
    {}
    DoubleDouble(const D& high, const D& low) : high_(high), low_(low) {}
    /// The same in every lane.
    template <class Lane>
        requires(std::same_as<Lane, double> && !std::same_as<D, double>)
    DoubleDouble(const DoubleDouble<Lane>& value) : high_(value.high()), low_(value.low())
    {}

    explicit DoubleDouble(const D& high)
        requires(!std::same_as<D, double>)
        : high_(high), low_(0.0)
    {}

    const D& high() const { return high_; }
    const D& low() const { return low_; }

    template <class Value>
        requires(std::is_arithmetic_v<Value> && std::same_as<D, double>)
    [[gnu::always_inline]] explicit operator Value() const
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
        const D low = fma(a.high_, b.low_, a.low_ * b.high_);
        return exact_sum_of_ordered(high.high_, high.low_ + low);
    }
    [[gnu::always_inline]] friend DoubleDouble operator/(const DoubleDouble& a,
                                                         const DoubleDouble& b)
    {
        const D first = a.high_ / b.high_;
        const DoubleDouble rest = a - b * DoubleDouble(first);
        const D second = rest.high_ / b.high_;
        const D third = (rest - b * DoubleDouble(second)).high_ / b.high_;
        return exact_sum_of_ordered(first, second) + DoubleDouble(third);
    }
    /// The error is below epsilon (|a b| + |c|); half the time of a product and a sum.
    [[gnu::always_inline]] friend DoubleDouble fma(const DoubleDouble& a, const DoubleDouble& b,
                                                   const DoubleDouble& c)
    {
        const DoubleDouble product = exact_product(a.high_, b.high_);
        const DoubleDouble sum = exact_sum(product.high_, c.high_);
        const D low = fma(a.high_, b.low_, fma(a.low_, b.high_, product.low_));
        return exact_sum_of_ordered(sum.high_, sum.low_ + (low + c.low_));
    }

    friend Mask operator==(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ == b.high_ &&
               (a.low_ == b.low_ || abs(a.high_) == D(std::numeric_limits<double>::infinity()));
    }
    friend Mask operator!=(const DoubleDouble& a, const DoubleDouble& b) { return !(a == b); }
    friend Mask operator<(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
    }
    friend Mask operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend Mask operator<=(const DoubleDouble& a, const DoubleDouble& b)
    {
        return a.high_ < b.high_ || (a.high_ == b.high_ && !(a.low_ > b.low_));
    }
    friend Mask operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }

    friend DoubleDouble abs(const DoubleDouble& x)
    {
        return select<DoubleDouble>(x.high_ < D(0.0), -x, x);
    }
    friend DoubleDouble floor(const DoubleDouble& x)
    {
        const D high = floor(x.high_);
        return select<DoubleDouble>(high == x.high_, exact_sum_of_ordered(high, floor(x.low_)),
                                    DoubleDouble(high));
    }
    friend DoubleDouble ceil(const DoubleDouble& x) { return -floor(-x); }
    friend DoubleDouble sqrt(const DoubleDouble& x)
    {
        const D root = sqrt(x.high_);
        const D rest = (x - exact_product(root, root)).high_;
        const Mask is_positive = x.high_ > D(0.0);
        const D twice = select<D>(is_positive, root + root, D(1.0));
        return select<DoubleDouble>(is_positive, exact_sum_of_ordered(root, rest / twice),
                                    DoubleDouble(root));
    }

    /// To the accuracy of a double.
    friend DoubleDouble cbrt(const DoubleDouble& x) { return std::cbrt(x.high_); }

    /// sin x and cos x for |x| < 2^20 [rad]; the errors are below 1e-31.
    friend SineAndCosine<DoubleDouble> sine_and_cosine(const DoubleDouble& x)
    {
        // Reduced by multiples of pi/2 in three parts, of which the first two have so few bits that
        // their products are exact; then by a quarter of the rest, whose angle is doubled twice.
        constexpr std::array half_pi{0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
        const D turns = nearbyint(x.high_ * D(0x1.45f306dc9c883p-1));
        const DoubleDouble rest =
            ((x - DoubleDouble(turns * D(half_pi[0]))) - DoubleDouble(turns * D(half_pi[1]))) -
            exact_product(turns, D(half_pi[2]));
        const auto [sine, cosine_less_one] =
            doubled(doubled(series_of_sine(rest.times_power_of_two(0.25))));
        const DoubleDouble cosine = cosine_less_one + DoubleDouble(1);
        const D quadrant = turns - D(4.0) * floor(turns * D(0.25));
        const Mask is_odd = quadrant == D(1.0) || quadrant == D(3.0);
        const DoubleDouble of_sine = select<DoubleDouble>(is_odd, cosine, sine);
        const DoubleDouble of_cosine = select<DoubleDouble>(is_odd, sine, cosine);
        return {
            select<DoubleDouble>(quadrant >= D(2.0), -of_sine, of_sine),
            select<DoubleDouble>(quadrant == D(1.0) || quadrant == D(2.0), -of_cosine, of_cosine)};
    }

    /// exp(-x) for 0 <= x <= 700; the relative error is below 1e-30 up to x = 600, where the low
    /// part is not yet subnormal.
    friend DoubleDouble exponential_decay(const DoubleDouble& x)
    {
        // exp(-x) = 2^-k exp(rest). ln 2 has three parts, as pi/2 above; a 32nd of the rest, at
        // most 0.011, is doubled five times.
        constexpr std::array ln_two{0x1.62e42fefa2p-1, 0x1.9ef35793c6p-41, 0x1.673007e5ed5e8p-81};
        const D k = nearbyint(x.high_ * D(0x1.71547652b82fep+0));
        const DoubleDouble rest =
            ((DoubleDouble(k * D(ln_two[0])) - x) + DoubleDouble(k * D(ln_two[1]))) +
            exact_product(k, D(ln_two[2]));
        const DoubleDouble t = rest.times_power_of_two(0x1p-5);
        DoubleDouble sum = inverse_factorial(14);
        unrolled<12>([&]<int i>() { sum = fma(sum, t, inverse_factorial(13 - i)); });
        DoubleDouble less_one = fma(t * t, sum, t);
        unrolled<5>([&]<int>() { less_one = less_one * (less_one + DoubleDouble(2)); });
        const DoubleDouble of_rest = less_one + DoubleDouble(1);
        const D scale = number_traits<D>::power_of_two(-k);
        return {of_rest.high_ * scale, of_rest.low_ * scale};
    }

private:
    DoubleDouble times_power_of_two(double factor) const
    {
        return {high_ * D(factor), low_ * D(factor)};
    }

    [[gnu::always_inline]] static DoubleDouble exact_sum_of_ordered(const D& larger,
                                                                    const D& smaller)
    {
        const D sum = larger + smaller;
        return {sum, smaller - (sum - larger)};
    }
    [[gnu::always_inline]] static DoubleDouble exact_sum(const D& a, const D& b)
    {
        const D sum = a + b;
        const D of_b = sum - a;
        return {sum, (a - (sum - of_b)) + (b - of_b)};
    }
    [[gnu::always_inline]] static DoubleDouble exact_product(const D& a, const D& b)
    {
        const D product = a * b;
        if constexpr (has_fused_multiply_add) {
            return {product, fma(a, b, -product)};
        } else { // Dekker 1971: the products of halves are exact
            const auto [a_high, a_low] = halves_of(a);
            const auto [b_high, b_low] = halves_of(b);
            return {product, a_low * b_low -
                                 (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
        }
    }
    /// The upper and the lower 26 bits (Veltkamp 1968); for |x| < 2^996.
    static std::array<D, 2> halves_of(const D& x)
    {
        const D shifted = x * D(0x1p+27 + 1);
        const D high = shifted - (shifted - x);
        return {high, x - high};
    }

    /// sin x and cos x - 1 for |x| <= 0.2.
    static SineAndCosine<DoubleDouble> series_of_sine(const DoubleDouble& x)
    {
        const DoubleDouble minus_square = -(x * x);
        DoubleDouble sine = inverse_factorial(21);
        DoubleDouble cosine = inverse_factorial(20);
        unrolled<9>([&]<int i>() {
            constexpr int n = 18 - 2 * i;
            sine = fma(sine, minus_square, inverse_factorial(n + 1));
            cosine = fma(cosine, minus_square, inverse_factorial(n));
        });
        return {fma(x * minus_square, sine, x), minus_square * cosine};
    }

    /// 1 / n! for 2 <= n <= 21.
    [[gnu::always_inline]] static DoubleDouble inverse_factorial(int n)
    {
        const auto& [high, low] = inverse_factorials_in_two_parts[std::size_t(n - 2)];
        return {D(high), D(low)};
    }

    /// The sine, and the cosine less 1, of the double angle.
    static SineAndCosine<DoubleDouble> doubled(const SineAndCosine<DoubleDouble>& of_half)
    {
        const auto& [sine, cosine_less_one] = of_half;
        const DoubleDouble product = sine * cosine_less_one;
        return {(sine + product).times_power_of_two(2), (sine * sine).times_power_of_two(-2)};
    }

    D high_;
    D low_;
};

/// 31 digits in one lane.
using Digits31 = DoubleDouble<double>;

template <class D>
struct number_traits<DoubleDouble<D>> {
    using number = DoubleDouble<D>;
    using scalar = Digits31;
    using estimate = D;
    using mask = mask_t<D>;
    static constexpr int lanes = lanes_v<D>;
    static number select(const mask& condition, const number& yes, const number& no)
    {
        return {overturn::select<D>(condition, yes.high(), no.high()),
                overturn::select<D>(condition, yes.low(), no.low())};
    }
    static number lesser(const number& a, const number& b) { return select(a < b, a, b); }
    static number greater(const number& a, const number& b) { return select(a > b, a, b); }
    static number pi() { return {D(0x1.921fb54442d18p+1), D(0x1.1a62633145c07p-53)}; }
    static bool any(const mask& condition) { return overturn::any<D>(condition); }
    static number load(const scalar* from)
    {
        double high[std::size_t(lanes)];
        double low[std::size_t(lanes)];
        for (int i = 0; i < lanes; ++i) {
            high[i] = from[i].high();
            low[i] = from[i].low();
        }
        return {overturn::load<D>(high), overturn::load<D>(low)};
    }
    static void store(scalar* to, const number& value)
    {
        const auto high = lanes_of(value.high());
        const auto low = lanes_of(value.low());
        for (std::size_t i = 0; i < high.size(); ++i) {
            to[i] = {high[i], low[i]};
        }
    }
    static number gathered(const double* from, const number& index)
    {
        return number(overturn::gathered<D>(from, index.high()));
    }
    static std::array<number, 2> gathered_pair(const double* from, const number& index)
    {
        const auto [here, next] = overturn::gathered_pair<D>(from, index.high());
        return {number(here), number(next)};
    }
};

template <class D>
const D& estimate_of(const DoubleDouble<D>& x)
{
    return x.high();
}
template <class D, std::size_t count>
std::array<D, count> estimate_of(const std::array<DoubleDouble<D>, count>& x)
{
    std::array<D, count> high;
    std::ranges::transform(x, high.begin(), [](const auto& each) { return each.high(); });
    return high;
}

} // namespace overturn

namespace std {

/// epsilon() covers the errors of all operations.
template <>
class numeric_limits<overturn::Digits31> {
    using T = overturn::Digits31;

public:
    static constexpr bool is_specialized = true;
    static constexpr int digits = 102;
    static T epsilon() { return 0x1p-101; }
    static T infinity() { return {std::numeric_limits<double>::infinity(), 0}; }
    static T quiet_NaN() { return std::numeric_limits<double>::quiet_NaN(); }
};

} // namespace std
