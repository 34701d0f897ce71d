#include "overturn/problem/axis.hpp"

#include <fmt/format.h>

#include <cmath>

namespace overturn {

namespace {

double value_at(const AxisRange& range, std::int64_t i)
{
    if (i == 0) {
        return range.first;
    }
    if (i == range.count - 1) {
        return range.last;
    }
    const double share = double(i) / double(range.count - 1);
    if (range.spacing == Spacing::log) {
        return range.first * std::pow(range.last / range.first, share);
    }
    return range.first + (range.last - range.first) * double(i) / double(range.count - 1);
}

} // namespace

std::int64_t Axis::size() const
{
    if (const auto* range = std::get_if<AxisRange>(&definition_)) {
        return range->count;
    }
    return std::int64_t(std::get<AxisList>(definition_).size());
}

double Axis::operator[](std::int64_t i) const
{
    if (const auto* range = std::get_if<AxisRange>(&definition_)) {
        return value_at(*range, i);
    }
    return std::get<AxisList>(definition_)[std::size_t(i)];
}

std::vector<double> Axis::values(std::int64_t begin, std::int64_t end) const
{
    std::vector<double> result;
    result.reserve(std::size_t(end - begin));
    for (std::int64_t i = begin; i < end; ++i) {
        result.push_back((*this)[i]);
    }
    return result;
}

Axis Axis::thinned(std::int64_t count) const
{
    if (size() <= count) {
        return *this;
    }
    AxisList chosen;
    for (std::int64_t i = 0; i < count; ++i) {
        chosen.push_back((*this)[count == 1 ? size() / 2 : i * (size() - 1) / (count - 1)]);
    }
    return Axis(chosen);
}

std::string Extent::text(std::string_view unit) const
{
    return first == last ? fmt::format("{:.4g}{}", first, unit)
                         : fmt::format("{:.4g} to {:.4g}{}", first, last, unit);
}

Extent extent_of(const std::vector<double>& values)
{
    const auto [first, last] = std::minmax_element(values.begin(), values.end());
    return {*first, *last};
}

} // namespace overturn
