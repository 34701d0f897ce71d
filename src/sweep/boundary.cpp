#include "overturn/sweep/boundary.hpp"

#include "flip_search.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace overturn {

namespace {

/// Steps of the scan under a pulse, over the upper amplitude. With two amplitudes far apart, the
/// criteria for halving, which compare three neighbours, missed ranges in one line of seven; with
/// five, in none of 1104.
constexpr double widest_step = 0.125;

/// These values, and others that divide the steps between them evenly, until each is at most
/// widest(its lower value, the upper value of the step). Steps that are as wide as allowed, but for
/// rounding, are not divided.
template <class Widest>
std::vector<double> divided(const std::vector<double>& values, const Widest& widest)
{
    std::vector<double> all;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double below = i > 0 ? values[i - 1] : values[i];
        const double step = values[i] - below;
        if (step > 0) {
            const double parts = std::ceil(step / widest(below, values[i]) - 1e-9);
            for (double part = 1; part < parts; ++part) {
                all.push_back(below + step * (part / parts));
            }
        }
        all.push_back(values[i]);
    }
    return all;
}

/// These strengths, with steps that are wider than `widest`, over their upper strength, divided:
/// first at halves of the upper strength, then evenly. Below `lifting`, nothing moves.
std::vector<double> divided_strengths(const std::vector<double>& strengths, double widest,
                                      double lifting)
{
    std::vector<double> halved;
    for (const double strength : strengths) {
        const double below = halved.empty() ? strength : halved.back();
        std::vector<double> between;
        for (double half = strength / 2; half > std::max(below, lifting); half /= 2) {
            between.push_back(half);
        }
        halved.insert(halved.end(), between.rbegin(), between.rend());
        halved.push_back(strength);
    }
    return divided(halved, [&](double below, double above) {
        // Of even steps, the lowest is the widest over its upper strength.
        return above > lifting ? widest / (1 - widest) * std::max(below, lifting) : infinity;
    });
}

/// The strength from which on the vertical motion cancels gravity; infinite if there is none.
double free_fall_strength(const Scene& scene, const BoundaryLine& line)
{
    return free_fall_amplitude(scene, line.point) * std::abs(line.unit);
}

/// The strengths below that at which the vertical motion cancels gravity; all others are undecided.
FlipScan without_free_fall(const Scene& scene, const BoundaryLine& where,
                           std::vector<double> strengths)
{
    std::vector<double> undecided;
    const double free_fall = free_fall_strength(scene, where);
    const auto first = std::lower_bound(strengths.begin(), strengths.end(), free_fall);
    if (first != strengths.end()) {
        undecided = {*first, strengths.back()};
        strengths.erase(first, strengths.end());
        const double last = last_before_free_fall(scene, where);
        if (!strengths.empty() && strengths.back() < last) {
            strengths.push_back(last);
        }
    }
    return {std::move(strengths), std::move(undecided)};
}

} // namespace

std::vector<Point> BoundaryLine::points(std::span<const double> strengths) const
{
    return mapped(strengths, [&](double strength) {
        Point each = point;
        each.amplitude = strength / unit;
        return each;
    });
}

std::vector<Point> QuantityLine::points(const Scene& scene, const std::vector<double>& values) const
{
    Grid grid = others;
    grid.dimensions = {{std::string(quantity->name), {{quantity, Axis(AxisList(values))}}}};
    return Coordinates(scene, grid).points();
}

QuantityLine line_along(const Quantity& quantity, const Grid& grid, const Shape& place)
{
    QuantityLine line{&quantity, {.numbers = grid.numbers, .dimensions = {}}};
    for (std::size_t i = 0; i < place.size(); ++i) {
        for (const Column& column : grid.dimensions[i].columns) {
            line.others.numbers.push_back(
                {column.quantity, Axis(AxisList{column.values[place[i]]})});
        }
    }
    std::erase_if(line.others.numbers, [&](const Column& number) {
        return are_equivalent(number.quantity->name, quantity.name);
    });
    return line;
}

double last_before_free_fall(const Scene& scene, const BoundaryLine& line)
{
    return free_fall_strength(scene, line) * (1 - 4 * std::numeric_limits<double>::epsilon());
}

Boundary boundary_on(const Scene& scene, const BoundaryLine& where,
                     const std::vector<double>& strengths, Kernel kernel,
                     const std::optional<FlipSearch>& search)
{
    Point unit = where.point;
    unit.amplitude = std::copysign(1.0, where.unit);
    const double lifting =
        lifting_pga(scene, unit) / pga_of_unit(scene, unit) * std::abs(where.unit);
    const auto points = [&](const std::vector<double>& values) { return where.points(values); };
    const FlipSearch used = search.value_or(flip_search(scene, may_slip(where.point)));
    const bool is_sensitive = scene.motion_traits().is_sensitive;
    FlipScan scan =
        is_sensitive ? without_free_fall(scene, where, strengths) : FlipScan{strengths, {}};
    scan.values =
        divided_strengths(scan.values, is_sensitive ? used.finest_step : widest_step, lifting);
    return flips_along({.at = points, .scale = [](double strength) { return strength; }}, scene,
                       scan, used, kernel);
}

Boundary boundary_on(const Scene& scene, const QuantityLine& where,
                     const std::vector<double>& values, Kernel kernel,
                     const std::optional<FlipSearch>& search)
{
    const double range = values.back() - values.front();
    const auto points = [&](const std::vector<double>& at) { return where.points(scene, at); };
    const FlipSearch used =
        search.value_or(flip_search(scene, may_slip(points({values.front()}).front())));
    const double widest =
        range * (scene.motion_traits().is_sensitive ? used.finest_step : widest_step_of_range);
    return flips_along({.at = points, .scale = [range](double) { return range; }}, scene,
                       {divided(values, [&](double, double) { return widest; }), {}}, used, kernel);
}

} // namespace overturn
