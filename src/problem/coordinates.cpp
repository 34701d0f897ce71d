#include "overturn/problem/coordinates.hpp"

#include "derivations.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/pulse_motion.hpp"

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

namespace {

double least_uplift_threshold(const Scene& scene, const Point& point)
{
    return uplift_threshold(scene.theory,
                            std::min(point.block.slenderness, point.block.other.slenderness));
}

} // namespace

std::shared_ptr<const Accelerogram> directed_record(const Scene& scene, const Point& point)
{
    const auto& record = scene.records[std::size_t(point.record)];
    return scene.has_two_components()
               ? std::make_shared<const Accelerogram>(record->in_direction(point.direction))
               : record;
}

double pga_of_unit(const Scene& scene, const Point& point)
{
    return scene.is_recorded() ? directed_record(scene, point)->peak()
                               : least_uplift_threshold(scene, point);
}

double lifting_pga(const Scene& scene, const Point& point)
{
    if (!scene.is_recorded() && point.block.is_symmetric()) {
        return uplift_threshold(scene.theory, point.block.slenderness);
    }
    const bool is_mirrored = std::signbit(point.amplitude);
    const Block<double> block = is_mirrored ? point.block.turned() : point.block;
    const UpliftThresholds thresholds(uplift_threshold(scene.theory, block.slenderness),
                                      uplift_threshold(scene.theory, block.other.slenderness));
    if (scene.is_recorded()) {
        const auto record = directed_record(scene, point);
        return record->peak() * record->lifting_scale(thresholds);
    }
    // A positive ground acceleration pushes the block towards its side minus.
    const LobeAmplitudes<double> lobes =
        largest_lobes(pulse_motion<double>(scene.pulse, scene.shape));
    return std::min(thresholds.minus / lobes.positive, thresholds.plus / lobes.negative);
}

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

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
        std::array<std::vector<double>, std::tuple_size_v<Derivation::Values>> from;
        for (std::size_t k = 0; k < from.size() && !derivation.from[k].empty(); ++k) {
            from[k] = along(result.dimensions, derivation.from[k]);
        }
        result.values.resize(std::max<std::size_t>(1, from[0].size()));
        for (std::size_t i = 0; i < result.values.size(); ++i) {
            Derivation::Values of{};
            for (std::size_t k = 0; k < from.size() && !from[k].empty(); ++k) {
                of[k] = from[k][i];
            }
            result.values[i] = derivation.value(scene_, of);
        }
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

namespace {

/// The points of a box, coordinate by coordinate.
class Points {
public:
    Points(const Coordinates& coordinates, const Shape& count)
        : coordinates_(coordinates), count_(count)
    {}

    /// Calls assign(point, value) for every point with its value of a coordinate.
    template <class Assign>
    void fill(std::string_view name, const Assign& assign)
    {
        const CoordinateValues& coordinate = coordinates_.of(name);
        if (coordinate.dimensions.empty()) {
            for (Point& point : points_) {
                assign(point, coordinate.first());
            }
            return;
        }
        expand();
        Point* point = points_.data();
        for_each_offset(count_, coordinate.dimensions,
                        [&](std::size_t offset) { assign(*point++, coordinate.values[offset]); });
    }

    void fill_symmetric_blocks()
    {
        fill("slenderness", [](Point& point, double value) {
            point.block.slenderness = value;
            point.block.other.slenderness = value;
        });
    }

    void fill_blocks_with_two_sides()
    {
        using B = Block<double>;
        using Side = BlockSide<double>;
        const auto fill_both = [&](double B::*of_plus, std::string_view plus,
                                   double Side::*of_minus, std::string_view minus) {
            fill(plus, [&](Point& point, double value) { point.block.*of_plus = value; });
            fill(minus, [&](Point& point, double value) { point.block.other.*of_minus = value; });
        };
        fill_both(&B::slenderness, "slenderness_plus", &Side::slenderness, "slenderness_minus");
        fill_both(&B::size, "size_plus", &Side::size, "size_minus");
        fill_both(&B::pace, "frequency_parameter", &Side::pace, "frequency_parameter_minus");
    }

    std::vector<Point> all()
    {
        expand();
        return std::move(points_);
    }

private:
    void expand()
    {
        const auto size = std::size_t(count_points(count_));
        if (points_.size() < size) {
            points_.resize(size, Point(points_.front()));
        }
    }

    const Coordinates& coordinates_;
    const Shape& count_;
    std::vector<Point> points_{1}; // as long as all coordinates are equal
};

/// Converts blocks with equal sides to symmetric ones.
void make_symmetric(std::vector<Point>& points)
{
    for (Point& point : points) {
        Block<double>& block = point.block;
        if (block.is_symmetric()) {
            point.frequency /= block.pace;
            block = {block.slenderness, block.restitution};
        }
    }
}

} // namespace

std::vector<Point> Coordinates::points() const
{
    Points points(*this, count_);
    const bool is_recorded = scene_.is_recorded();
    const bool has_two_sides = grid_.has_two_sides();
    if (has_two_sides) {
        points.fill_blocks_with_two_sides();
    } else {
        points.fill_symmetric_blocks();
    }
    points.fill("restitution", [](Point& point, double r) { point.block.restitution = r; });
    points.fill(is_recorded ? "scale" : "amplitude",
                [](Point& point, double value) { point.amplitude = value; });
    if (grid_.find("direction") != nullptr) {
        points.fill("direction", [&](Point& point, double value) {
            if (scene_.has_two_components()) {
                point.direction = value;
            } else if (value == 180) {
                point.amplitude = -point.amplitude;
            }
        });
    }
    if (is_recorded) {
        points.fill("motion", [](Point& point, double motion) {
            point.record = int(Scene::record_index(motion));
        });
    }
    if (!has_two_sides) {
        points.fill(is_recorded ? "samples_per_unit" : "frequency",
                    [](Point& point, double value) { point.frequency = value; });
        return points.all();
    }
    if (is_recorded) {
        points.fill("motion", [&](Point& point, double motion) {
            point.frequency = 1 / scene_.records[Scene::record_index(motion)]->time_step();
        });
    } else {
        points.fill("pulse_period",
                    [](Point& point, double period) { point.frequency = two_pi / period; });
    }
    points.fill("gyration_over_size", [](Point& point, double value) { point.gyration = value; });
    std::vector<Point> all = points.all();
    make_symmetric(all);
    return all;
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
