#include "overturn/problem/coordinates.hpp"

#include "overturn/mechanics/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace overturn {

double frequency_parameter(double half_diagonal, double gravity)
{
    return std::sqrt(3 * gravity / (4 * half_diagonal));
}

double uplift_threshold(Theory theory, double slenderness)
{
    return with_theory(theory,
                       [&]<Theory known>() { return uplift_acceleration<known>(slenderness); });
}

double lifting_pga(const Scene& scene, std::int64_t motion, double slenderness)
{
    const double threshold = uplift_threshold(scene.theory, slenderness);
    if (!scene.is_recorded()) {
        return threshold;
    }
    const Accelerogram& record = *scene.records[std::size_t(motion)];
    return record.peak() * record.lifting_scale(threshold);
}

namespace {

constexpr double pi = std::numbers::pi;

enum class Under { any_motion, pulse, record };

/// A coordinate that follows from one or two others, x and y.
struct Derivation {
    std::string_view name;
    Under motion;
    std::array<std::string_view, 2> from;
    double (*value)(const Scene& scene, double x, double y);
};

const Accelerogram& record_of(const Scene& scene, double motion)
{
    return *scene.records[std::size_t(motion) - 1];
}

constexpr std::array derivations{
    Derivation{"half_width",
               Under::any_motion,
               {"width"},
               [](const Scene&, double width, double) { return width / 2; }},
    Derivation{"half_height",
               Under::any_motion,
               {"height"},
               [](const Scene&, double height, double) { return height / 2; }},
    Derivation{"slenderness",
               Under::any_motion,
               {"half_width", "half_height"},
               [](const Scene&, double b, double h) { return std::atan(b / h); }},
    Derivation{"size",
               Under::any_motion,
               {"half_width", "half_height"},
               [](const Scene&, double b, double h) { return std::hypot(b, h); }},
    Derivation{
        "size",
        Under::any_motion,
        {"frequency_parameter"},
        [](const Scene& scene, double p, double) { return 3 * scene.gravity / (4 * p * p); }},
    Derivation{"frequency_parameter",
               Under::any_motion,
               {"size"},
               [](const Scene& scene, double size, double) {
                   return frequency_parameter(size, scene.gravity);
               }},
    Derivation{"restitution",
               Under::any_motion,
               {"restitution_of_maximum", "slenderness"},
               [](const Scene&, double share, double alpha) {
                   return share * largest_restitution(alpha);
               }},
    Derivation{"amplitude",
               Under::pulse,
               {"pga", "slenderness"},
               [](const Scene& scene, double pga, double alpha) {
                   return pga / uplift_threshold(scene.theory, alpha);
               }},
    Derivation{"pga",
               Under::pulse,
               {"amplitude", "slenderness"},
               [](const Scene& scene, double amplitude, double alpha) {
                   return amplitude * uplift_threshold(scene.theory, alpha);
               }},
    Derivation{"scale",
               Under::record,
               {"pga", "record_pga"},
               [](const Scene&, double pga, double peak) { return pga / peak; }},
    Derivation{"pga",
               Under::record,
               {"scale", "record_pga"},
               [](const Scene&, double scale, double peak) { return scale * peak; }},
    Derivation{
        "record_pga",
        Under::record,
        {"motion"},
        [](const Scene& scene, double motion, double) { return record_of(scene, motion).peak(); }},
    Derivation{"frequency",
               Under::pulse,
               {"pulse_period", "frequency_parameter"},
               [](const Scene&, double period, double p) { return 2 * pi / (period * p); }},
    Derivation{"frequency",
               Under::pulse,
               {"pulse_frequency", "frequency_parameter"},
               [](const Scene&, double hertz, double p) { return 2 * pi * hertz / p; }},
    Derivation{"pulse_period",
               Under::pulse,
               {"frequency", "frequency_parameter"},
               [](const Scene&, double frequency, double p) { return 2 * pi / (frequency * p); }},
    Derivation{"samples_per_unit",
               Under::record,
               {"motion", "frequency_parameter"},
               [](const Scene& scene, double motion, double p) {
                   return 1 / (p * record_of(scene, motion).time_step());
               }},
};

/// The coordinates on the way from a coordinate to those that it may follow from.
using Path = std::vector<std::string_view>;

/// The derivation of a coordinate that the grid does not contain; nullptr if there is none.
const Derivation* derivation_of(std::string_view name, const Scene& scene, const Grid& grid,
                                Path path = {})
{
    path.push_back(name);
    const auto is_known = [&](std::string_view other) {
        return other.empty() || grid.find(other) != nullptr ||
               (std::find(path.begin(), path.end(), other) == path.end() &&
                derivation_of(other, scene, grid, path) != nullptr);
    };
    const auto is_possible = [&](const Derivation& each) {
        return each.name == name &&
               (each.motion == Under::any_motion ||
                (each.motion == Under::record) == scene.is_recorded()) &&
               std::all_of(each.from.begin(), each.from.end(), is_known);
    };
    const auto* found = std::find_if(derivations.begin(), derivations.end(), is_possible);
    return found == derivations.end() ? nullptr : found;
}

/// Calls visit(offset) for every point of a box, row by row. offset: into values that vary along
/// the given dimensions.
template <class Visitor>
void for_each_offset(const Shape& count, const std::vector<std::size_t>& dimensions,
                     const Visitor& visit)
{
    Shape stride(count.size());
    std::int64_t next = 1;
    for (auto i = dimensions.rbegin(); i != dimensions.rend(); ++i) {
        stride[*i] = next;
        next *= count[*i];
    }
    const std::int64_t columns = count.empty() ? 1 : count.back();
    const std::int64_t step = count.empty() ? 0 : stride.back();
    const std::int64_t rows = count_points(count) / columns;
    Shape index(count.size());
    std::int64_t first = 0; // of the row
    for (std::int64_t row = 0; row < rows; ++row) {
        for (std::int64_t column = 0; column < columns; ++column) {
            visit(std::size_t(first + column * step));
        }
        for (std::size_t i = count.size() - std::min<std::size_t>(1, count.size()); i-- > 0;) {
            first += stride[i];
            if (++index[i] < count[i]) {
                break;
            }
            first -= stride[i] * count[i];
            index[i] = 0;
        }
    }
}

} // namespace

std::span<const std::string_view> derived_coordinates(bool is_recorded)
{
    static constexpr std::array<std::string_view, 8> under_pulses{
        "slenderness", "size", "frequency_parameter", "restitution",
        "amplitude",   "pga",  "frequency",           "pulse_period"};
    static constexpr std::array<std::string_view, 6> under_records{
        "slenderness", "size", "frequency_parameter", "restitution", "scale", "pga"};
    return is_recorded ? std::span<const std::string_view>(under_records) : under_pulses;
}

Coordinates::Coordinates(const Scene& scene, const Grid& grid)
    : scene_(scene), grid_(grid), begin_(grid.dimensions.size()), count_(grid.shape())
{}

Coordinates::Coordinates(const Scene& scene, const Grid& grid, const Tile& tile)
    : scene_(scene), grid_(grid), begin_(tile.begin), count_(tile.count)
{}

bool Coordinates::has(std::string_view name) const
{
    return grid_.find(name) != nullptr || derivation_of(name, scene_, grid_) != nullptr;
}

std::vector<std::size_t> Coordinates::dimensions_of(std::string_view name) const
{
    if (grid_.find(name) != nullptr) {
        const auto dimension = grid_.dimension_of(name);
        return dimension ? std::vector{*dimension} : std::vector<std::size_t>();
    }
    std::vector<std::size_t> all;
    for (const std::string_view other : derivation_of(name, scene_, grid_)->from) {
        if (!other.empty()) {
            std::vector<std::size_t> both;
            std::ranges::set_union(all, dimensions_of(other), std::back_inserter(both));
            all = std::move(both);
        }
    }
    return all;
}

CoordinateValues Coordinates::given(const Column& column, std::string_view name) const
{
    const auto dimension = grid_.dimension_of(name);
    if (!dimension) {
        return {{}, {column.values.first()}};
    }
    const std::int64_t begin = begin_[*dimension];
    return {{*dimension}, column.values.values(begin, begin + count_[*dimension])};
}

std::vector<double> Coordinates::spread(const CoordinateValues& coordinate,
                                        const std::vector<std::size_t>& dimensions) const
{
    Shape count;
    for (const std::size_t dimension : dimensions) {
        count.push_back(count_[dimension]);
    }
    std::vector<std::size_t> places; // of its dimensions among these
    for (const std::size_t dimension : coordinate.dimensions) {
        places.push_back(
            std::size_t(std::ranges::find(dimensions, dimension) - dimensions.begin()));
    }
    std::vector<double> values;
    values.reserve(std::size_t(count_points(count)));
    for_each_offset(count, places,
                    [&](std::size_t offset) { values.push_back(coordinate.values[offset]); });
    return values;
}

template <class Function>
CoordinateValues Coordinates::combined(std::span<const CoordinateValues* const> from,
                                       std::vector<std::size_t> dimensions,
                                       const Function& of) const
{
    CoordinateValues result{std::move(dimensions), {}};
    std::array<std::vector<double>, 2> arguments; // at every point of the result
    for (std::size_t i = 0; i < from.size(); ++i) {
        arguments[i] = spread(*from[i], result.dimensions);
    }
    arguments[1].resize(arguments[0].size());
    result.values.resize(arguments[0].size());
    std::transform(arguments[0].begin(), arguments[0].end(), arguments[1].begin(),
                   result.values.begin(), of);
    return result;
}

const CoordinateValues& Coordinates::of(std::string_view name) const
{
    if (const auto found = known_.find(name); found != known_.end()) {
        return found->second;
    }
    if (const Column* column = grid_.find(name)) {
        return known_.emplace(name, given(*column, name)).first->second;
    }
    const Derivation* derivation = derivation_of(name, scene_, grid_);
    assert(derivation != nullptr);
    std::vector<const CoordinateValues*> from;
    for (const std::string_view other : derivation->from) {
        if (!other.empty()) {
            from.push_back(&of(other));
        }
    }
    CoordinateValues values = combined(from, dimensions_of(name), [&](double x, double y) {
        return derivation->value(scene_, x, y);
    });
    return known_.emplace(name, std::move(values)).first->second;
}

std::vector<double> Coordinates::along(const std::vector<std::size_t>& dimensions,
                                       std::string_view name) const
{
    return spread(of(name), dimensions);
}

std::vector<Point> Coordinates::points() const
{
    std::vector<Point> points(std::size_t(count_points(count_)));
    const auto fill = [&](std::string_view name, double Point::*member) {
        const CoordinateValues& coordinate = of(name);
        Point* point = points.data();
        for_each_offset(count_, coordinate.dimensions, [&](std::size_t offset) {
            (point++)->*member = coordinate.values[offset];
        });
    };
    fill("slenderness", &Point::slenderness);
    fill("restitution", &Point::restitution);
    fill(scene_.is_recorded() ? "scale" : "amplitude", &Point::amplitude);
    fill(scene_.is_recorded() ? "samples_per_unit" : "frequency", &Point::frequency);
    return points;
}

std::vector<std::int64_t> Coordinates::motions() const
{
    std::vector<std::int64_t> motions;
    if (scene_.records.size() > 1) {
        std::vector<std::size_t> all(count_.size());
        std::iota(all.begin(), all.end(), std::size_t(0));
        for (const double number : along(all, "motion")) {
            motions.push_back(std::int64_t(number) - 1);
        }
    }
    return motions;
}

std::string Extent::text(std::string_view unit) const
{
    return first == last ? fmt::format("{:.4g}{}", first, unit)
                         : fmt::format("{:.4g} to {:.4g}{}", first, last, unit);
}

Extent extent_of(const CoordinateValues& coordinate)
{
    const auto [first, last] =
        std::minmax_element(coordinate.values.begin(), coordinate.values.end());
    return {*first, *last};
}

} // namespace overturn
