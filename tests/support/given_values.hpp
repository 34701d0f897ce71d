// The quantities of a grid by name, as arguments of grid_of().
#pragma once

#include "overturn/problem/given.hpp"
#include "overturn/problem/point.hpp"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace overturn {

using Quantities = std::vector<Given>;

inline Quantities operator+(Quantities one, const Quantities& other)
{
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

inline Given number(const std::string& name, double value)
{
    return {&quantity(name), name, Axis(AxisList{value}), GivenAs::number};
}

inline Given axis(const std::string& name, const AxisRange& range)
{
    return {&quantity(name), name, Axis(range), GivenAs::axis};
}

inline Given axis(const std::string& name, AxisList values)
{
    return {&quantity(name), name, Axis(std::move(values)), GivenAs::axis};
}

inline Given axis(const std::string& name, std::initializer_list<double> values)
{
    return axis(name, AxisList(values));
}

inline Given column(const std::string& name, AxisList values)
{
    return {&quantity(name), name, Axis(std::move(values)), GivenAs::column};
}

/// The grid of a single point under a pulse. Described: PulsePoint<double> or HardCase.
template <class Described>
Grid grid_of_point(const Described& point)
{
    return grid_of(
        {}, {number("slenderness", point.slenderness), number("restitution", point.restitution),
             number("amplitude", point.amplitude), number("frequency", point.frequency)});
}
inline Grid grid_of_point(const Point& point)
{
    return grid_of({},
                   {number("slenderness", point.block.slenderness),
                    number("restitution", point.block.restitution),
                    number("amplitude", point.amplitude), number("frequency", point.frequency)});
}

} // namespace overturn
