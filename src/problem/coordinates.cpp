#include "overturn/problem/coordinates.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <set>
#include <span>

namespace overturn {

std::optional<double> r_max_of(double slenderness)
{
    return slenderness < limit_of_r_max ? std::optional(largest_restitution(slenderness))
                                        : std::nullopt;
}

namespace {

/// The coordinates on the way from a coordinate to those that it may follow from.
using Path = std::vector<std::string_view>;

/// The first derivation of a coordinate from those that are known, or nullptr. path: to this
/// coordinate, without it.
const Derivation* derivation_of(std::string_view name, const Scene& scene, const Grid& grid,
                                Path path = {})
{
    path.push_back(name);
    const auto is_known = [&](std::string_view other) {
        return other.empty() || grid.find(other) != nullptr ||
               (!is_one_of(other, path) && derivation_of(other, scene, grid, path) != nullptr);
    };
    const Sides other_sides = grid.has_two_sides() ? Sides::equal : Sides::two;
    for (const Derivation& each : derivations_of(name)) {
        if (each.sides != other_sides && scene.is_under(each.motion) &&
            std::ranges::all_of(each.from, is_known)) {
            return &each;
        }
    }
    return nullptr;
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
    const auto& from = derivation_of(name, scene_, grid_)->from;
    return dimensions_of_any({from.begin(), std::ranges::find(from, "")});
}

std::vector<std::size_t>
Coordinates::dimensions_of_any(const std::vector<std::string_view>& names) const
{
    std::set<std::size_t> all;
    for (const std::string_view name : names) {
        const std::vector<std::size_t> own = dimensions_of(name);
        all.insert(own.begin(), own.end());
    }
    return {all.begin(), all.end()};
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
        std::vector<Derivation::Values> points(1);
        for (std::size_t k = 0; k < derivation.from.size() && !derivation.from[k].empty(); ++k) {
            const std::vector<double> values = along(result.dimensions, derivation.from[k]);
            points.resize(values.size());
            for (std::size_t i = 0; i < values.size(); ++i) {
                points[i][k] = values[i];
            }
        }
        result.values =
            mapped(points, [&](const auto& of) { return derivation.value(scene_, of); });
    }
    return known_.emplace(name, std::move(result)).first->second;
}

std::vector<double> Coordinates::along(const std::vector<std::size_t>& dimensions,
                                       std::string_view name) const
{
    const CoordinateValues& coordinate = of(name);
    const Shape count = mapped(dimensions, [&](std::size_t each) { return count_[each]; });
    const auto place_of = [&](std::size_t dimension) {
        return std::size_t(std::ranges::find(dimensions, dimension) - dimensions.begin());
    };
    const std::vector<std::size_t> places = mapped(coordinate.dimensions, place_of);
    std::vector<double> values;
    values.reserve(std::size_t(count_points(count)));
    for_each_offset(count, places,
                    [&](std::size_t offset) { values.push_back(coordinate.values[offset]); });
    return values;
}

namespace {

/// A number of a point that is a coordinate.
struct PointNumber {
    std::string_view coordinate;
    double& (*of)(Point& point);
};

constexpr PointNumber of_symmetric_point[]{
    {"slenderness", [](Point& point) -> double& { return point.block.slenderness; }},
    {"slenderness", [](Point& point) -> double& { return point.block.other.slenderness; }}};

constexpr PointNumber of_two_sided_point[]{
    {"slenderness_plus", [](Point& point) -> double& { return point.block.slenderness; }},
    {"slenderness_minus", [](Point& point) -> double& { return point.block.other.slenderness; }},
    {"size_plus", [](Point& point) -> double& { return point.block.size; }},
    {"size_minus", [](Point& point) -> double& { return point.block.other.size; }},
    {"frequency_parameter",
     [](Point& point) -> double& { return point.block.frequency_parameter; }},
    {"frequency_parameter_minus",
     [](Point& point) -> double& { return point.block.other.frequency_parameter; }},
    {"gyration_over_size", [](Point& point) -> double& { return point.gyration; }}};

/// Converts blocks with equal sides to symmetric ones.
void make_symmetric(std::vector<Point>& points)
{
    for (Point& point : points) {
        Block<double>& block = point.block;
        if (block.is_symmetric()) {
            point.frequency /= block.frequency_parameter;
            block = {block.slenderness, block.restitution};
        }
    }
}

} // namespace

std::vector<Point> Coordinates::points() const
{
    const auto size = std::size_t(count_points(count_));
    std::vector<Point> points(1); // as long as all coordinates are equal
    const auto fill = [&](std::string_view name, const auto& assign) {
        const CoordinateValues& coordinate = of(name);
        if (coordinate.dimensions.empty()) {
            for (Point& point : points) {
                assign(point, coordinate.first());
            }
            return;
        }
        points.resize(size, Point(points.front()));
        Point* point = points.data();
        for_each_offset(count_, coordinate.dimensions,
                        [&](std::size_t offset) { assign(*point++, coordinate.values[offset]); });
    };
    const MotionTraits& motion = scene_.motion_traits();
    const bool has_two_sides = grid_.has_two_sides();
    using Numbers = std::span<const PointNumber>;
    for (const PointNumber& number :
         has_two_sides ? Numbers(of_two_sided_point) : Numbers(of_symmetric_point)) {
        fill(number.coordinate, [&](Point& point, double value) { number.of(point) = value; });
    }
    if (grid_.may_slip()) {
        fill("friction", [](Point& point, double value) { point.friction = value; });
    }
    fill("restitution", [](Point& point, double r) { point.block.restitution = r; });
    fill(motion.amplitude, [](Point& point, double value) { point.amplitude = value; });
    if (grid_.find("direction") != nullptr) {
        fill("direction", [&](Point& point, double value) {
            if (scene_.has_two_components()) {
                point.direction = value;
            } else if (value == 180) {
                point.amplitude = -point.amplitude;
            }
        });
    }
    if (!motion.choice.empty()) {
        fill(motion.choice,
             [](Point& point, double number) { point.record = int(Scene::record_index(number)); });
    }
    fill(has_two_sides ? motion.frequency_with_two_sides : motion.frequency,
         [](Point& point, double value) { point.frequency = value; });
    points.resize(size, Point(points.front()));
    if (has_two_sides) {
        make_symmetric(points);
    }
    return points;
}

std::vector<Extent> scales_of(const Scene& scene, const Grid& grid)
{
    if (!scene.is_under(Under::record)) {
        return {};
    }
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    // One of scale and pga is given, and the other varies along the dimensions of the strength and
    // the motion.
    const std::string_view derived = corners.find("pga") != nullptr ? "scale" : "pga";
    const std::vector<std::size_t>& dimensions = coordinates.of(derived).dimensions;
    const std::vector<double> scale = coordinates.along(dimensions, "scale");
    const std::vector<double> motion = coordinates.along(dimensions, "motion");
    std::vector<Extent> scales(scene.records().size());
    for (std::size_t i = 0; i < scale.size(); ++i) {
        scales[Scene::record_index(motion[i])].include(scale[i]);
    }
    return scales;
}

} // namespace overturn
