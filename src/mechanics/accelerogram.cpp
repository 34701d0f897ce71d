#include "overturn/mechanics/accelerogram.hpp"

#include "overturn/mechanics/intensity_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace overturn {

namespace {

/// For every i, the largest of value(values[j]) over j >= i.
template <class Value>
std::vector<double> suffix_maxima(const std::vector<double>& values, const Value& value)
{
    std::vector<double> maxima(values.size());
    std::ranges::transform(values, maxima.begin(), value);
    std::partial_sum(maxima.rbegin(), maxima.rend(), maxima.rbegin(),
                     [](double later, double here) { return std::max(later, here); });
    return maxima;
}

} // namespace

Accelerogram::Accelerogram(std::vector<double> horizontal, std::vector<double> upwards,
                           double time_step, std::vector<double> second)
    : horizontal_(std::move(horizontal)), upwards_(std::move(upwards)), second_(std::move(second)),
      time_step_(time_step), upwards_peak_(peak_of(upwards_)),
      later_peak_(suffix_maxima(horizontal_, [](double a) { return std::abs(a); })),
      later_fall_(suffix_maxima(upwards_, [](double v) { return -v; }))
{}

Accelerogram Accelerogram::of_pulse(std::vector<double> phases, std::vector<double> shape)
{
    Accelerogram pulse(std::move(shape), {}, 0);
    pulse.phases_ = std::move(phases);
    return pulse;
}

std::int64_t Accelerogram::sample_before(double phase) const
{
    const auto inner = std::upper_bound(phases_.begin() + 1, phases_.end() - 1, phase);
    return inner - phases_.begin() - 1;
}

std::int64_t Accelerogram::sample_after(double phase) const
{
    return std::lower_bound(phases_.begin(), phases_.end(), phase) - phases_.begin();
}

HorizontalDirection HorizontalDirection::of(double degrees)
{
    const double sign = degrees < 180 ? 1 : -1;
    const double half_turn = degrees < 180 ? degrees : degrees - 180;
    const double angle = half_turn * std::numbers::pi / 180;
    return {sign * (half_turn == 90 ? 0 : std::cos(angle)), sign * std::sin(angle)};
}

Accelerogram Accelerogram::in_direction(double degrees) const
{
    const auto direction = HorizontalDirection::of(degrees);
    std::vector<double> motion = horizontal_;
    for (std::size_t i = 0; i < motion.size(); ++i) {
        motion[i] = direction.component(horizontal_[i], second_.empty() ? 0 : second_[i]);
    }
    return {std::move(motion), upwards_, time_step_};
}

double Accelerogram::upwards_mean() const
{
    return std::accumulate(upwards_.begin(), upwards_.end(), 0.0) /
           std::max(1.0, double(upwards_.size()));
}

double Accelerogram::free_fall_scale() const
{
    const double deepest = upwards_.empty() ? 0 : later_fall_.front();
    return deepest > 0 ? 1 / deepest : std::numeric_limits<double>::infinity();
}

double Accelerogram::lifting_scale(const UpliftThresholds& thresholds) const
{
    // scale |a| > (1 + scale v) threshold. Both sides are linear between samples and the left one
    // is convex, so that the least scale is that of a sample.
    const auto scale_on_side = [&](double threshold, double side) {
        if (std::isinf(threshold)) {
            return threshold;
        }
        double strongest = 0;
        for (std::size_t i = 0; i < horizontal_.size(); ++i) {
            const double upwards = upwards_.empty() ? 0 : upwards_[i];
            const double towards = std::max(0.0, -side * horizontal_[i]);
            strongest = std::max(strongest, towards - upwards * threshold);
        }
        return strongest > 0 ? threshold / strongest : std::numeric_limits<double>::infinity();
    };
    return std::min(scale_on_side(thresholds.plus, 1), scale_on_side(thresholds.minus, -1));
}

std::int64_t Accelerogram::first_lifting(std::int64_t first, double scale,
                                         const UpliftThresholds& thresholds) const
{
    const double factor = std::abs(scale);
    const double least = std::min(thresholds.plus, thresholds.minus);
    for (std::int64_t i = first; i < samples(); ++i) {
        const double fall = upwards_.empty() ? 0 : later_fall_[std::size_t(i)];
        if (!(factor * later_peak_[std::size_t(i)] > (1 - factor * fall) * least)) {
            break; // no later sample does
        }
        const double upwards = upwards_.empty() ? 0 : upwards_[std::size_t(i)];
        const double push = scale * horizontal_[std::size_t(i)];
        const double threshold = push < 0 ? thresholds.plus : thresholds.minus;
        if (std::abs(push) > (1 + factor * upwards) * threshold) {
            return i;
        }
    }
    return samples();
}

} // namespace overturn
