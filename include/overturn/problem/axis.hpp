// The values of one quantity: an axis, a single number, or a column of a table; their extent.
#pragma once

#include "overturn/text/names.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn {

enum class Spacing { linear, log };

/// In job files.
template <>
inline constexpr std::array<std::string_view, 2> names_of<Spacing>{"linear", "log"};

/// first + (last - first) i / (count - 1), or the same for the logarithms; the last value is exact.
struct AxisRange {
    double first = 0;
    double last = 0;
    std::int64_t count = 1;
    Spacing spacing = Spacing::linear;
};

using AxisList = std::vector<double>;

/// Values given as a range or as a list: also a single number, and a column of a table. They ascend
/// strictly, except those of a column.
class Axis {
public:
    Axis() : Axis(AxisList{0}) {}
    explicit Axis(AxisRange range) : definition_(range) {}
    explicit Axis(AxisList values) : definition_(std::move(values)) {}

    std::int64_t size() const;
    double operator[](std::int64_t i) const;
    double first() const { return (*this)[0]; }
    double last() const { return (*this)[size() - 1]; }

    /// The values of [begin, end).
    std::vector<double> values(std::int64_t begin, std::int64_t end) const;
    std::vector<double> values() const { return values(0, size()); }

    /// At most `count` of the values, evenly chosen, with both ends unless `count` is 1.
    Axis thinned(std::int64_t count) const;

    const std::variant<AxisRange, AxisList>& definition() const { return definition_; }
    bool is_range() const { return std::holds_alternative<AxisRange>(definition_); }

private:
    std::variant<AxisRange, AxisList> definition_;
};

/// The smallest and the largest of some values. Those that are included one by one are not
/// negative; without any, they are infinity and 0.
struct Extent {
    double first = std::numeric_limits<double>::infinity();
    double last = 0;

    void include(double value)
    {
        first = std::min(first, value);
        last = std::max(last, value);
    }

    /// "2 m", or "1 to 2 m" if both differ. unit: begins with a blank unless it is empty.
    std::string text(std::string_view unit) const;
};
Extent extent_of(const std::vector<double>& values);

} // namespace overturn
