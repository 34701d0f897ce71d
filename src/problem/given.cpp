#include "overturn/problem/given.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

[[noreturn]] void refuse(std::string_view quantity, const std::string& message)
{
    throw GivenError(GivenError::no_row, quantity, message);
}

void expect_no_alternatives(const std::vector<Given>& given)
{
    for (std::size_t i = 1; i < given.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Given& one = given[i];
            const Given& other = given[j];
            if (!exclude_each_other(one.quantity->name, other.quantity->name)) {
                continue;
            }
            const bool is_column = other.as == GivenAs::column && one.as != GivenAs::column;
            refuse(one.quantity->name,
                   fmt::format(" cannot be combined with {}{}, which {}. Remove one of them.",
                               is_column ? "the column " : "", other.label,
                               are_equivalent(one.quantity->name, other.quantity->name)
                                   ? "gives the same quantity"
                                   : "describes the block in another way"));
        }
    }
}

/// What a block needs, in the order in which it is asked for.
void expect_complete(const Scene& scene, const Grid& grid)
{
    const Coordinates coordinates(scene, grid);
    const auto has = [&](std::string_view name) { return coordinates.has(name); };
    const auto expect = [&](std::string_view coordinate, std::string_view name,
                            std::string_view advice) {
        if (!has(coordinate)) {
            refuse(name, fmt::format(" is missing. {}", advice));
        }
    };
    const bool has_side = has("half_width") || has("half_height");
    if (has_side) {
        constexpr std::string_view advice = "Give width and height, or their halves, in metres.";
        expect("half_width", "width", advice);
        expect("half_height", "height", advice);
    }
    expect("slenderness", "slenderness",
           "Give the slenderness [rad]; or width and height [m], or their halves.");
    expect("restitution", "restitution",
           "Give restitution, the energy ratio r, or restitution_of_maximum, its share of r_max.");
    if (scene.is_recorded()) {
        expect("scale", "scale", "Give scale, a factor on the record, or pga [g].");
        expect("frequency_parameter", "size",
               "Give size [m] or frequency_parameter [1/s], or width and height [m].");
        return;
    }
    expect("amplitude", "amplitude", "Give amplitude, or pga [g].");
    for (const std::string_view rate : {"pulse_period", "pulse_frequency"}) {
        if (grid.find(rate) != nullptr && !has("frequency_parameter")) {
            refuse(rate, " needs the dimensions of the block. Give width and height, or the half "
                         "diagonal size, in metres.");
        }
    }
    expect("frequency", "frequency",
           "Give frequency, or pulse_period [s] or pulse_frequency [Hz] and the dimensions of the "
           "block.");
}

/// Checks the values of a derived coordinate at the corners of a grid.
class ValueCheck {
public:
    ValueCheck(const Scene& scene, const Grid& corners, std::string_view derived)
        : grid_(corners), coordinates_(scene, corners), values_(coordinates_.of(derived))
    {}

    /// The derived values, and those of another coordinate at the same points.
    const std::vector<double>& derived() const { return values_.values; }
    std::vector<double> at(std::string_view name) const
    {
        return coordinates_.along(values_.dimensions, name);
    }

    /// Refuses the first value i for which is_wrong(i) is true, with message(i). quantity: given,
    /// from which it follows.
    template <class IsWrong, class Message>
    void refuse_if(std::string_view quantity, const IsWrong& is_wrong, const Message& message) const
    {
        for (std::size_t i = 0; i < values_.values.size(); ++i) {
            if (is_wrong(i)) {
                throw GivenError(row_of(quantity, std::int64_t(i)), quantity, message(i));
            }
        }
    }

private:
    /// The row of value i if the quantity is a column of a table; no_row if not.
    std::int64_t row_of(std::string_view quantity, std::int64_t i) const
    {
        const auto dimension = grid_.dimension_of(quantity);
        if (!dimension || grid_.dimensions[*dimension].name != table_dimension) {
            return GivenError::no_row;
        }
        for (auto each = values_.dimensions.rbegin(); *each != *dimension; ++each) {
            i /= grid_.dimensions[*each].size();
        }
        return i % grid_.dimensions[*dimension].size();
    }

    const Grid& grid_;
    Coordinates coordinates_;
    const CoordinateValues& values_;
};

void expect_slenderness(const Scene& scene, const Grid& corners)
{
    if (corners.find("slenderness") != nullptr) {
        return;
    }
    const ValueCheck check(scene, corners, "slenderness");
    const std::vector<double>& alpha = check.derived();
    const std::vector<double> b = check.at("half_width");
    const std::vector<double> h = check.at("half_height");
    const Quantity& rule = quantity("slenderness");
    check.refuse_if(
        corners.find("width") != nullptr ? "width" : "half_width",
        [&](std::size_t i) { return !rule.allows(alpha[i]); },
        [&](std::size_t i) {
            return fmt::format(" makes the block {} m wide and {} m high: its slenderness {} is "
                               "outside {}. Choose a ratio closer to 1.",
                               2 * b[i], 2 * h[i], alpha[i], rule.interval);
        });
}

/// r_max (Eq. 17) must exist, and r must be in (0, 1]. A share above 1 is allowed: r_max is the
/// maximum for a block on a flat base, not a physical limit.
void expect_restitution(const Scene& scene, const Grid& corners)
{
    constexpr std::string_view name = "restitution_of_maximum";
    if (corners.find(name) == nullptr) {
        return;
    }
    const ValueCheck check(scene, corners, "restitution");
    const double limit = std::asin(std::sqrt(2.0 / 3.0));
    const std::vector<double>& r = check.derived();
    const std::vector<double> share = check.at(name);
    const std::vector<double> alpha = check.at("slenderness");
    check.refuse_if(
        name, [&](std::size_t i) { return !(alpha[i] < limit); },
        [&](std::size_t i) {
            return fmt::format(
                " = {}: r_max is defined only for a slenderness below arcsin sqrt(2/3) "
                "= {} rad (Eq. 17), but that of the block is {} rad. Choose a more "
                "slender block, or give restitution, r itself.",
                share[i], limit, alpha[i]);
        });
    const Quantity& rule = quantity("restitution");
    check.refuse_if(
        name, [&](std::size_t i) { return !rule.allows(r[i]); },
        [&](std::size_t i) {
            return fmt::format(
                " = {} gives r = {}, which is outside {}, at the slenderness {} rad. {}", share[i],
                r[i], rule.interval, alpha[i], rule.reason);
        });
}

/// The factor on a record, and the scaled vertical motion, must not overflow.
void expect_finite_scales(const Scene& scene, const Grid& corners)
{
    const std::string_view name = corners.find("pga") != nullptr ? "pga" : "scale";
    // Both vary along the dimensions of the strength and of the motion.
    const ValueCheck scales(scene, corners, name == "pga" ? "scale" : "pga");
    const std::vector<double> scale = name == "pga" ? scales.derived() : scales.at("scale");
    const std::vector<double> strength = scales.at(name);
    const std::vector<double> motion = scales.at("motion");
    const auto record = [&](std::size_t i) -> const Accelerogram& {
        return *scene.records[std::size_t(motion[i]) - 1];
    };
    scales.refuse_if(
        name,
        [&](std::size_t i) {
            return !std::isfinite(scale[i]) || !std::isfinite(scale[i] * record(i).upwards_peak());
        },
        [&](std::size_t i) {
            return fmt::format(" = {} exceeds the range of double precision as a factor on the "
                               "record, whose peak is {} g. Correct the unit of the record, or "
                               "lower {}.",
                               strength[i], record(i).peak(), name);
        });
}

/// Refuses strengths at all of which the vertical motion of every record cancels gravity.
void expect_gravity(const Scene& scene, const Grid& grid)
{
    const std::vector<ScaleRange> scales = scales_of(scene, grid);
    const Accelerogram* weakest = nullptr; // of those with points
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const Accelerogram& record = *scene.records[i];
        if (scales[i].smallest < record.free_fall_scale()) {
            return;
        }
        if (std::isfinite(scales[i].smallest) && weakest == nullptr) {
            weakest = &record;
        }
    }
    const std::string_view name = grid.find("pga") != nullptr ? "pga" : "scale";
    const Coordinates coordinates(scene, grid);
    refuse(name,
           fmt::format(" = {:.6g}{}: the vertical motion cancels gravity{}. Choose a value "
                       "below the scale {:.6g}, which is a PGA of {:.6g} g.",
                       extent_of(coordinates.of(name)).first,
                       coordinates.of(name).values.size() > 1 ? " and more" : "",
                       scene.records.size() > 1 ? " under every record" : "",
                       weakest->free_fall_scale(), weakest->free_fall_scale() * weakest->peak()));
}

} // namespace

bool applies_to(const Quantity& quantity, bool is_recorded)
{
    switch (quantity.role) {
    case Role::motion: return is_recorded;
    case Role::block:
    case Role::loss: return true;
    case Role::strength: return quantity.name == "pga" || (quantity.name == "scale") == is_recorded;
    case Role::rate: return !is_recorded;
    case Role::setting: break;
    }
    return false;
}

Grid grid_of(const Scene& scene, std::vector<Given> given)
{
    std::stable_sort(given.begin(), given.end(), [](const Given& one, const Given& other) {
        return one.quantity < other.quantity;
    });
    expect_no_alternatives(given);
    Grid grid;
    Dimension table{std::string(table_dimension), {}};
    for (Given& each : given) {
        Column column{each.quantity, std::move(each.values)};
        if (each.as == GivenAs::column) {
            table.columns.push_back(std::move(column));
        } else if (each.as == GivenAs::number) {
            grid.numbers.push_back(std::move(column));
        } else {
            grid.dimensions.push_back({std::string(each.quantity->name), {std::move(column)}});
        }
    }
    if (!table.columns.empty()) {
        grid.dimensions.push_back(std::move(table));
    }
    const bool is_recorded = scene.is_recorded();
    std::stable_sort(grid.dimensions.begin(), grid.dimensions.end(),
                     [&](const Dimension& one, const Dimension& other) {
                         return order_of(one.name, is_recorded) < order_of(other.name, is_recorded);
                     });
    expect_complete(scene, grid);
    const Grid corners = corners_of(grid);
    expect_slenderness(scene, corners);
    expect_restitution(scene, corners);
    if (is_recorded) {
        expect_finite_scales(scene, corners);
        expect_gravity(scene, corners);
    }
    return grid;
}

Grid corners_of(const Grid& grid)
{
    Grid corners = grid;
    for (Dimension& dimension : corners.dimensions) {
        Column& column = dimension.columns.front();
        if (dimension.name != table_dimension && dimension.name != "motion" &&
            column.values.size() > 2) {
            column.values = Axis(AxisList{column.values.first(), column.values.last()});
        }
    }
    return corners;
}

std::vector<ScaleRange> scales_of(const Scene& scene, const Grid& grid)
{
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    // One of both is given, and the other varies along the dimensions of the strength and the
    // motion.
    const std::string_view derived = corners.find("pga") != nullptr ? "scale" : "pga";
    const std::vector<std::size_t>& dimensions = coordinates.of(derived).dimensions;
    const std::vector<double> scale = coordinates.along(dimensions, "scale");
    const std::vector<double> motion = coordinates.along(dimensions, "motion");
    std::vector<ScaleRange> ranges(scene.records.size(),
                                   {std::numeric_limits<double>::infinity(), 0});
    for (std::size_t i = 0; i < scale.size(); ++i) {
        ScaleRange& range = ranges[std::size_t(motion[i]) - 1];
        range = {std::min(range.smallest, scale[i]), std::max(range.largest, scale[i])};
    }
    return ranges;
}

} // namespace overturn
