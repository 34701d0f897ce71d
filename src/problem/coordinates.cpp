#include "overturn/problem/coordinates.hpp"

#include "overturn/mechanics/block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace overturn {

double frequency_parameter(double half_diagonal, double gravity)
{
    return std::sqrt(3 * gravity / (4 * half_diagonal));
}

std::optional<double> r_max_of(double slenderness)
{
    return slenderness < limit_of_r_max ? std::optional(largest_restitution(slenderness))
                                        : std::nullopt;
}

double uplift_threshold(Theory theory, double slenderness)
{
    return with_theory(theory,
                       [&]<Theory known>() { return uplift_acceleration<known>(slenderness); });
}

double pga_of_unit(const Scene& scene, const Point& point)
{
    return scene.is_recorded() ? scene.records[std::size_t(point.record)]->peak()
                               : uplift_threshold(scene.theory, point.slenderness);
}

double lifting_pga(const Scene& scene, const Point& point)
{
    const double threshold = uplift_threshold(scene.theory, point.slenderness);
    if (!scene.is_recorded()) {
        return threshold;
    }
    const Accelerogram& record = *scene.records[std::size_t(point.record)];
    return record.peak() * record.lifting_scale(threshold);
}

namespace {

constexpr double pi = std::numbers::pi;

/// A coordinate that follows from one or two others, x and y.
struct Derivation {
    std::string_view name;
    std::array<std::string_view, 2> from;
    double (*value)(const Scene& scene, double x, double y);
    Under motion = Under::any_motion;
};

const Accelerogram& record_of(const Scene& scene, double motion)
{
    return *scene.records[Scene::record_index(motion)];
}

constexpr Derivation derivations[]{
    {"half_width", {"width"}, [](const Scene&, double width, double) { return width / 2; }},
    {"half_height", {"height"}, [](const Scene&, double height, double) { return height / 2; }},
    {"slenderness",
     {"half_width", "half_height"},
     [](const Scene&, double b, double h) { return std::atan(b / h); }},
    {"slenderness",
     {"aspect_ratio"},
     [](const Scene&, double ratio, double) { return std::atan(1 / ratio); }},
    {"size",
     {"half_width", "half_height"},
     [](const Scene&, double b, double h) { return std::hypot(b, h); }},
    {"size",
     {"frequency_parameter"},
     [](const Scene& scene, double p, double) { return 3 * scene.gravity / (4 * p * p); }},
    {"frequency_parameter",
     {"size"},
     [](const Scene& scene, double size, double) {
         return frequency_parameter(size, scene.gravity);
     }},
    {"restitution",
     {"restitution_of_maximum", "slenderness"},
     [](const Scene&, double share, double alpha) { return share * largest_restitution(alpha); }},
    {"amplitude",
     {"pga", "slenderness"},
     [](const Scene& scene, double pga, double alpha) {
         return pga / uplift_threshold(scene.theory, alpha);
     },
     Under::pulse},
    {"pga",
     {"amplitude", "slenderness"},
     [](const Scene& scene, double amplitude, double alpha) {
         return amplitude * uplift_threshold(scene.theory, alpha);
     },
     Under::pulse},
    {"scale",
     {"pga", "record_pga"},
     [](const Scene&, double pga, double peak) { return pga / peak; },
     Under::record},
    {"pga",
     {"scale", "record_pga"},
     [](const Scene&, double scale, double peak) { return scale * peak; },
     Under::record},
    {"record_pga",
     {"motion"},
     [](const Scene& scene, double motion, double) { return record_of(scene, motion).peak(); },
     Under::record},
    {"frequency",
     {"pulse_period", "frequency_parameter"},
     [](const Scene&, double period, double p) { return 2 * pi / (period * p); },
     Under::pulse},
    {"frequency",
     {"pulse_frequency", "frequency_parameter"},
     [](const Scene&, double hertz, double p) { return 2 * pi * hertz / p; },
     Under::pulse},
    {"pulse_period",
     {"frequency", "frequency_parameter"},
     [](const Scene&, double frequency, double p) { return 2 * pi / (frequency * p); },
     Under::pulse},
    {"samples_per_unit",
     {"motion", "frequency_parameter"},
     [](const Scene& scene, double motion, double p) {
         return 1 / (p * record_of(scene, motion).time_step());
     },
     Under::record},
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
    const auto* found = std::ranges::find_if(derivations, is_possible);
    return found == std::end(derivations) ? nullptr : found;
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

const CoordinateValues& Coordinates::of(std::string_view name) const
{
    if (const auto found = known_.find(name); found != known_.end()) {
        return found->second;
    }
    CoordinateValues result{dimensions_of(name), {}};
    if (const Column* column = grid_.find(name)) {
        const bool is_number = result.dimensions.empty();
        const std::int64_t begin = is_number ? 0 : begin_[result.dimensions[0]];
        const std::int64_t count = is_number ? 1 : count_[result.dimensions[0]];
        result.values = column->values.values(begin, begin + count);
    } else {
        const Derivation& derivation = *derivation_of(name, scene_, grid_);
        const auto& [one, other] = derivation.from;
        result.values = along(result.dimensions, one);
        const std::vector<double> others =
            other.empty() ? result.values : along(result.dimensions, other);
        std::ranges::transform(result.values, others, result.values.begin(),
                               [&](double x, double y) { return derivation.value(scene_, x, y); });
    }
    return known_.emplace(name, std::move(result)).first->second;
}

std::vector<double> Coordinates::along(const std::vector<std::size_t>& dimensions,
                                       std::string_view name) const
{
    const CoordinateValues& coordinate = of(name);
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

std::vector<Point> Coordinates::points() const
{
    std::vector<Point> points(std::size_t(count_points(count_)));
    const auto fill = [&](std::string_view name, const auto& assign) {
        const CoordinateValues& coordinate = of(name);
        Point* point = points.data();
        for_each_offset(count_, coordinate.dimensions,
                        [&](std::size_t offset) { assign(*point++, coordinate.values[offset]); });
    };
    const bool is_recorded = scene_.is_recorded();
    fill("slenderness", [](Point& point, double value) { point.slenderness = value; });
    fill("restitution", [](Point& point, double value) { point.restitution = value; });
    fill(is_recorded ? "scale" : "amplitude",
         [](Point& point, double value) { point.amplitude = value; });
    fill(is_recorded ? "samples_per_unit" : "frequency",
         [](Point& point, double value) { point.frequency = value; });
    if (is_recorded) {
        fill("motion",
             [](Point& point, double value) { point.record = int(Scene::record_index(value)); });
    }
    return points;
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
