#include "coordinates.hpp"

#include "layout.hpp"

#include "overturn/sweep/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace overturn {

namespace {

constexpr double exact = 0;
constexpr double of_one_function = 4; // the error of each library is at most two
constexpr double of_several = 100;    // largest_restitution amplifies those of its sine

constexpr const char* long_name_of_frequency = "frequency of the pulse, omega_p / p";
constexpr const char* long_name_of_period = "period of the pulse";
constexpr const char* long_name_of_size = "half diagonal of the block, R";
constexpr const char* long_name_of_parameter = "frequency parameter, p = sqrt(3g / 4R)";
constexpr const char* long_name_of_pga = "peak ground acceleration, over g";

/// Under a pulse.
const char* long_name_of_amplitude(const Job& job)
{
    return job.scene.theory == Theory::linear ? "peak acceleration, over g alpha"
                                              : "peak acceleration, over g tan(alpha)";
}

Coordinate coordinate_of(const Dimension& dimension)
{
    const auto& [name, axis, long_name, units] = dimension;
    const auto* range = std::get_if<AxisRange>(&axis.definition());
    const bool is_log = range != nullptr && range->spacing == Spacing::log;
    const double roundings = is_log ? of_one_function : exact;
    return {{name, {name}, {hsize_t(axis.size())}, axis.values(), long_name, units}, roundings};
}

Coordinate restitution_ratio(const Plane& plane)
{
    std::vector<double> values;
    for (std::int64_t i = 0; i < plane.slenderness.size(); ++i) {
        for (std::int64_t j = 0; j < plane.restitution.size(); ++j) {
            values.push_back(plane.restitution_ratio(i, j));
        }
    }
    return {{"restitution_ratio",
             {"slenderness", "restitution"},
             {hsize_t(plane.slenderness.size()), hsize_t(plane.restitution.size())},
             std::move(values),
             "energy ratio at an impact, r",
             "1"},
            plane.restitution_of == RestitutionOf::absolute ? exact : of_several};
}

std::string with_gravity(double gravity)
{
    return fmt::format("with g = {} m/s2", gravity);
}

/// A coordinate of the values of an axis and of g, each computed by of_value(value).
template <class OfValue>
Coordinate along(const char* dimension, const Axis& axis, const char* name, const char* long_name,
                 const char* units, double gravity, const OfValue& of_value)
{
    std::vector<double> values = axis.values();
    std::transform(values.begin(), values.end(), values.begin(), of_value);
    return {{name, {dimension}, {values.size()}, values, long_name, units, with_gravity(gravity)},
            of_several};
}

/// Under a pulse, for blocks of known size: the period of every Omega, or the other way round.
Coordinate other_frequency(const Job& job)
{
    const Plane& plane = job.plane;
    const double gravity = job.scene.gravity;
    if (plane.frequency_is == FrequencyQuantity::frequency) {
        const double p = frequency_parameter(*plane.size, gravity);
        return along("frequency", plane.frequency, "pulse_period", long_name_of_period, "s",
                     gravity,
                     [&](double frequency) { return 2 * std::numbers::pi / (frequency * p); });
    }
    return along(name_of(plane.frequency_is).data(), plane.frequency, "frequency",
                 long_name_of_frequency, "1", gravity,
                 [&](double value) { return frequency_of_point(job.scene, plane, 0, value); });
}

/// Under a pulse, for blocks of known size: the peak ground acceleration of every amplitude, or the
/// amplitude of every peak ground acceleration; for each slenderness if there are several.
Coordinate other_amplitude(const Job& job)
{
    const Plane& plane = job.plane;
    const bool is_pga = plane.amplitude_is == AmplitudeQuantity::pga;
    std::vector<double> values;
    for (const double slenderness : plane.slenderness.values()) {
        const double threshold = uplift_threshold(job.scene.theory, slenderness);
        for (const double value : plane.amplitude.values()) {
            values.push_back(is_pga ? value / threshold : value * threshold);
        }
    }
    std::vector<std::string> dimensions{std::string(name_of(plane.amplitude_is))};
    netcdf::DatasetShape shape{hsize_t(plane.amplitude.size())};
    if (plane.slenderness.size() > 1) {
        dimensions.insert(dimensions.begin(), "slenderness");
        shape.insert(shape.begin(), hsize_t(plane.slenderness.size()));
    }
    return {{is_pga ? "amplitude" : "pga", dimensions, shape, std::move(values),
             is_pga ? long_name_of_amplitude(job) : long_name_of_pga, "1"},
            of_several};
}

/// Under a record: R of every p, or p of every R.
Coordinate other_size(const Job& job)
{
    const Plane& plane = job.plane;
    const double gravity = job.scene.gravity;
    if (plane.frequency_is == FrequencyQuantity::size) {
        return along("size", plane.frequency, "frequency_parameter", long_name_of_parameter, "s-1",
                     gravity, [&](double size) { return frequency_parameter(size, gravity); });
    }
    return along("frequency_parameter", plane.frequency, "size", long_name_of_size, "m", gravity,
                 [&](double p) { return 3 * gravity / (4 * p * p); });
}

/// Under a record: the peak ground acceleration of every motion and scale, or the scale of every
/// motion and peak ground acceleration.
Coordinate other_strength(const Job& job)
{
    const bool is_scale = job.plane.amplitude_is == AmplitudeQuantity::scale;
    std::vector<double> values;
    for (const Motion& motion : job.motions) {
        for (const double value : job.plane.amplitude.values()) {
            const double peak = motion.measures.pga;
            values.push_back(is_scale ? value * peak : value / peak);
        }
    }
    return {{is_scale ? "scaled_pga" : "scale",
             {"motion", std::string(name_of(job.plane.amplitude_is))},
             {hsize_t(job.motions.size()), hsize_t(job.plane.amplitude.size())},
             std::move(values),
             is_scale ? long_name_of_pga : "factor on the record",
             "1"},
            exact};
}

/// The intensity measures of the records, not scaled.
void add_measures(const Job& job, std::vector<Coordinate>& all)
{
    const auto add = [&](const char* name, const char* long_name, const char* units,
                         double IntensityMeasures::*measure, const char* comment = "") {
        std::vector<double> values;
        for (const Motion& motion : job.motions) {
            values.push_back(motion.measures.*measure);
        }
        all.push_back(
            {{name, {"motion"}, {values.size()}, values, long_name, units, comment}, exact});
    };
    const bool is_pga = job.plane.amplitude_is == AmplitudeQuantity::pga ||
                        (job.blocks && std::ranges::count(job.blocks->columns, "pga") > 0);
    add(is_pga ? "record_pga" : "pga", "peak acceleration of the record, over g", "1",
        &IntensityMeasures::pga);
    add("pgv", "peak ground velocity of the record", "m s-1", &IntensityMeasures::pgv);
    add("arias_intensity", "Arias intensity of the record", "m s-1",
        &IntensityMeasures::arias_intensity);
    add("significant_duration", "significant duration of the record", "s",
        &IntensityMeasures::significant_duration, "from 5 to 95 % of the Arias intensity");
}

/// 1 to count.
Axis numbers_to(std::int64_t count)
{
    return Axis(AxisRange{1, double(count), count});
}

Dimension motion_dimension(const Plane& plane)
{
    return {"motion", numbers_to(plane.motions), "number of the ground motion in the job", "1"};
}

Dimension amplitude_dimension(const Job& job)
{
    const AmplitudeQuantity quantity = job.plane.amplitude_is;
    return {std::string(name_of(quantity)), job.plane.amplitude,
            quantity == AmplitudeQuantity::scale ? "factor on the record"
            : quantity == AmplitudeQuantity::pga ? long_name_of_pga
                                                 : long_name_of_amplitude(job),
            "1"};
}

Dimension frequency_dimension(const Plane& plane)
{
    const auto dimension = [&](const char* long_name, const char* units) {
        return Dimension{std::string(name_of(plane.frequency_is)), plane.frequency, long_name,
                         units};
    };
    switch (plane.frequency_is) {
    case FrequencyQuantity::pulse_period: return dimension(long_name_of_period, "s");
    case FrequencyQuantity::pulse_frequency: return dimension("frequency of the pulse", "s-1");
    case FrequencyQuantity::size: return dimension(long_name_of_size, "m");
    case FrequencyQuantity::frequency_parameter: return dimension(long_name_of_parameter, "s-1");
    case FrequencyQuantity::frequency: break;
    }
    return dimension(long_name_of_frequency, "1");
}

std::vector<Dimension> dimensions_of_list(const Job& job)
{
    const Plane& plane = job.plane;
    const bool has_own_motions = plane.list->has_own_motions;
    std::vector<Dimension> dimensions;
    if (plane.motions > 0 && !has_own_motions) {
        dimensions.push_back(motion_dimension(plane));
    }
    dimensions.push_back(
        {"block", numbers_to(plane.list->size), "number of the block in the table", "1"});
    if (!has_own_motions) {
        dimensions.push_back(amplitude_dimension(job));
        if (plane.motions == 0) {
            dimensions.push_back(frequency_dimension(plane));
        }
    }
    return dimensions;
}

/// What the table and its rows say of every block; nothing for a job in a result file.
void add_blocks(const Job& job, std::vector<Coordinate>& all)
{
    const auto add = [&](const std::string& name, const std::vector<double>& values,
                         const char* long_name, std::string_view units, double roundings,
                         const std::string& comment = "") {
        all.push_back(
            {{name, {"block"}, {values.size()}, values, long_name, std::string(units), comment},
             roundings});
    };
    if (!job.blocks->table) {
        return;
    }
    const bool is_recorded = job.scene.is_recorded();
    for (const TableColumn& column : job.blocks->table->columns) {
        if (!column.numbers.empty()) {
            const Quantity* quantity = find_quantity(column.name);
            add(column.name, column.numbers, "column of the table",
                quantity == nullptr ? "1" : quantity->units, exact);
        }
    }
    const auto add_derived = [&](const char* name, const std::vector<double>& values,
                                 const char* long_name, const std::string& comment = "") {
        if (!values.empty() && job.blocks->table->find(name) == nullptr) {
            const Quantity* quantity = find_quantity(name);
            add(name, values, long_name, quantity == nullptr ? "1" : quantity->units, of_several,
                comment);
        }
    };
    const BlockList& list = *job.plane.list;
    add_derived("slenderness", list.slenderness, "slenderness of the block, arctan(b/h)");
    add_derived("restitution_ratio", list.restitution, "energy ratio at an impact, r");
    add_derived("frequency_parameter", list.frequency_parameter, long_name_of_parameter,
                with_gravity(job.scene.gravity));
    if (is_recorded && job.motions.front().record) { // not in a job of a result file
        add_derived("scale", list.amplitude, "factor on the record");
    }
    if (!is_recorded) {
        add_derived("amplitude", list.amplitude, long_name_of_amplitude(job));
        add_derived("frequency", list.frequency, long_name_of_frequency);
    }
}

} // namespace

std::vector<Dimension> dimensions_of(const Job& job)
{
    const Plane& plane = job.plane;
    if (plane.list) {
        return dimensions_of_list(job);
    }
    std::vector<Dimension> dimensions{
        {"slenderness", plane.slenderness, "slenderness of the block, arctan(b/h)", "rad"},
        {"restitution", plane.restitution,
         plane.restitution_of == RestitutionOf::maximum ? "energy ratio at an impact, r / r_max"
                                                        : "energy ratio at an impact, r",
         "1"}};
    if (plane.motions > 0) {
        dimensions.insert(dimensions.begin(), motion_dimension(plane));
    }
    if (job.product == Product::boundary) {
        dimensions.push_back(
            {"crossing", plane.amplitude, "number of the flip, counted from 0", "1"});
    } else {
        dimensions.push_back(amplitude_dimension(job));
    }
    dimensions.push_back(frequency_dimension(plane));
    return dimensions;
}

std::string name_of_scan(const Job& job)
{
    return layout::in_run_group(layout::scan_prefix + std::string(name_of(job.plane.amplitude_is)));
}

std::vector<Coordinate> coordinates_of(const Job& job)
{
    const Plane& plane = job.plane;
    const bool is_boundary = job.product == Product::boundary;
    std::vector<Coordinate> all;
    for (const Dimension& dimension : dimensions_of(job)) {
        all.push_back(coordinate_of(dimension));
    }
    if (plane.block) { // the slenderness is an arctangent, and the size a square root
        all[all.size() - 4].roundings = of_one_function;
        if (plane.motions > 0) {
            all.back().roundings = of_one_function;
        }
    }
    if (is_boundary) {
        all.push_back(coordinate_of(
            {name_of_scan(job), job.scan,
             fmt::format("values of {} computed first", name_of(plane.amplitude_is)), "1"}));
    }
    if (plane.list) {
        add_blocks(job, all);
        if (plane.motions > 0) {
            if (plane.list->has_own_motions) {
                all.push_back(coordinate_of(motion_dimension(plane)));
            } else {
                all.push_back(other_strength(job));
            }
            add_measures(job, all);
        }
        return all;
    }
    all.push_back(restitution_ratio(plane));
    if (plane.motions > 0) {
        all.push_back(other_size(job));
        if (!is_boundary) {
            all.push_back(other_strength(job));
        }
        add_measures(job, all);
    } else if (plane.size) {
        all.push_back(other_frequency(job));
        if (!is_boundary) { // a boundary has flips instead of amplitudes
            all.push_back(other_amplitude(job));
        }
    }
    return all;
}

} // namespace overturn
