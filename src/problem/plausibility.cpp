#include "overturn/problem/plausibility.hpp"

#include "overturn/mechanics/intensity_measures.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/is_one_of.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace overturn {

namespace {

/// The values of a quantity that a block on Earth under an earthquake or an explosion may have.
struct PlausibleRange {
    std::string_view name;
    std::string_view unit; ///< begins with a blank
    double least;
    double most;
    std::string_view advice;
};

namespace plausible {
constexpr PlausibleRange slenderness{"alpha", " degrees", 0, 180 / std::numbers::pi,
                                     "a block wider than 1.5 times its height; angles are in "
                                     "radians"};
// Larger blocks exist, but most lengths that would make one are in centimetres.
constexpr PlausibleRange size{"R", " m", 0.02, 10, "lengths are in metres"};
constexpr PlausibleRange incline{"the incline", " degrees", -10, 10, "angles are in radians"};
constexpr PlausibleRange implied_incline{"the incline that the angles and distances imply",
                                         " degrees", -10, 10,
                                         "compare it with the base; angles are in radians"};
constexpr PlausibleRange gyration{"the radius of gyration", " R", 0.1, 1.5,
                                  "lengths are in metres"};
constexpr PlausibleRange friction{"the friction coefficient", "", 0.03, 1.5,
                                  "it is the tangent of the friction angle"};
constexpr PlausibleRange period{"the period of the pulse", " s", 0.02, 20,
                                "periods are in seconds, and lengths in metres"};
constexpr PlausibleRange acceleration{"the peak ground acceleration", " g", 0, 5,
                                      "accelerations are in g"};
constexpr PlausibleRange peak{"the peak of a component of a record", " g", 0.001, 5,
                              "state its unit if the file does not"};
constexpr PlausibleRange time_step{"the time step of a record", " s", 1e-4, 0.5,
                                   "times are in seconds"};
constexpr PlausibleRange vertical_mean{
    "the mean of a vertical record", " g", -infinity, 0.3,
    "remove gravity from the record of a sensor that measures it"};
constexpr PlausibleRange gravity{"gravity", " m/s2", 1.5, 30, "it is g in m/s2"};
} // namespace plausible

/// What is implausible about these values, as one text; empty if nothing is. one_is_enough: whether
/// some of the values may be implausible.
std::string finding_about(const PlausibleRange& range, const Extent& values,
                          bool one_is_enough = false)
{
    const bool has_one = values.last >= range.least && values.first <= range.most;
    const bool has_all = values.first >= range.least && values.last <= range.most;
    if (one_is_enough ? has_one : has_all) {
        return "";
    }
    const bool has_least = range.least != 0 && std::isfinite(range.least);
    const std::string limits =
        has_least ? fmt::format("outside {} to {:.4g}{}", range.least, range.most, range.unit)
                  : fmt::format("above {:.4g}{}", range.most, range.unit);
    return fmt::format("{} = {} is {} ({})", range.name, values.text(range.unit), limits,
                       range.advice);
}

/// A component of a record with a value that no other one comes near: measured motions have none.
std::string finding_about_spikes(const std::vector<double>& samples, double step)
{
    constexpr std::size_t least_samples = 100; // shorter ones may be made by hand
    if (samples.size() < least_samples) {
        return "";
    }
    const auto by_size = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto largest = std::ranges::max_element(samples, by_size);
    double next = 0; // a marker of missing values may occur several times
    for (const double sample : samples) {
        if (sample != *largest) {
            next = std::max(next, std::abs(sample));
        }
    }
    const double ratio = std::abs(*largest) / next;
    return next > 0 && ratio > 2
               ? fmt::format("the largest value of a record, {:.4g} g at {:.6g} s after its "
                             "beginning, is {:.3g} times as large as any other (a spike, or a "
                             "marker of missing values?)",
                             *largest, step * double(largest - samples.begin()), ratio)
               : "";
}

/// Whether r is above r_max. Every row of a table is judged; of a plane, the largest r at the
/// largest r_max.
std::string finding_about_restitution(const Coordinates& coordinates, bool has_table)
{
    const bool has_two_sides = !coordinates.has("slenderness");
    const std::string_view shape = has_two_sides ? "largest_restitution" : "slenderness";
    const auto finding = [&](double r, double value) -> std::string {
        constexpr double rounding = 1e-9; // of numbers that users copy from a printed r_max
        const auto largest = has_two_sides ? std::optional(value) : r_max_of(value); // (Eq. 17)
        return largest && r > *largest * (1 + rounding)
                   ? fmt::format("r = {:.4g} is above r_max = {:.4g}", r, *largest)
                   : "";
    };
    if (!has_table) {
        const Extent extent = extent_of(coordinates.of(shape).values);
        return finding(extent_of(coordinates.of("restitution").values).last,
                       has_two_sides ? extent.last : extent.first);
    }
    const std::vector<std::size_t> both = coordinates.dimensions_of_any({"restitution", shape});
    const std::vector<double> r = coordinates.along(both, "restitution");
    const std::vector<double> values = coordinates.along(both, shape);
    std::string found;
    for (std::size_t i = 0; i < r.size() && found.empty(); ++i) {
        found = finding(r[i], values[i]);
    }
    return found;
}

bool have_different_sides(const Coordinates& coordinates)
{
    const auto differ = [&](std::string_view plus, std::string_view minus) {
        return coordinates.of(plus).values != coordinates.of(minus).values;
    };
    return differ("slenderness_plus", "slenderness_minus") || differ("size_plus", "size_minus");
}

using Findings = std::vector<std::string>;

/// Different findings, in their order. R of both sides may be the same.
std::string text_of(const Findings& findings)
{
    Findings different;
    for (const std::string& finding : findings) {
        if (!finding.empty() && !is_one_of(finding, different)) {
            different.push_back(finding);
        }
    }
    return fmt::format("{}", fmt::join(different, "; "));
}

void judge_records(const Scene& scene, Findings& findings)
{
    if (!scene.is_under(Under::record)) {
        return;
    }
    std::vector<double> peaks, time_steps, means;
    for (const auto& record : scene.records()) {
        for (const auto* component :
             {&record->horizontal(), &record->second(), &record->upwards()}) {
            if (!component->empty()) {
                peaks.push_back(peak_of(*component));
                findings.push_back(finding_about_spikes(*component, record->time_step()));
            }
        }
        means.push_back(record->upwards_mean());
        time_steps.push_back(record->time_step());
    }
    findings.push_back(finding_about(plausible::vertical_mean, extent_of(means)));
    findings.push_back(finding_about(plausible::peak, extent_of(peaks)));
    findings.push_back(finding_about(plausible::time_step, extent_of(time_steps)));
}

void judge_directions(const Grid& grid, const Coordinates& coordinates, Findings& findings)
{
    const bool differ = grid.has_two_sides() && have_different_sides(coordinates);
    if (!coordinates.has("direction")) {
        findings.emplace_back(
            differ ? "the mirror image of the motion, direction 180, is not computed; it "
                     "may be worse for blocks with two different sides (give the "
                     "direction, 0 or 180)"
                   : "");
        return;
    }
    const Extent direction = extent_of(coordinates.of("direction").values);
    const std::string text = direction.text(" degrees");
    const double largest = std::max(std::abs(direction.first), std::abs(direction.last));
    if (0 < largest && largest < 2 * std::numbers::pi + 0.01) {
        findings.push_back(fmt::format("direction = {} (directions are in degrees)", text));
    }
    const double range = direction.last - direction.first;
    if (differ && 0 < range && range < 180 * (1 - 1e-9)) {
        findings.push_back(
            fmt::format("direction = {} leaves out the mirror images of these motions, "
                        "which may be worse for blocks with two different sides (give a "
                        "full circle)",
                        text));
    }
}

} // namespace

std::string implausible_values(const Scene& scene, const Grid& grid)
{
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    Findings findings;
    findings.push_back(finding_about(plausible::gravity, {scene.gravity, scene.gravity}));
    // Values that follow from a dimensionless axis may be implausible in part.
    const auto judge = [&](const PlausibleRange& range, std::string_view name,
                           std::string_view dimensionless = "", double unit = 1) {
        if (coordinates.has(name)) {
            const Extent extent = extent_of(coordinates.of(name).values);
            findings.push_back(finding_about(range, {extent.first / unit, extent.last / unit},
                                             grid.find(dimensionless) != nullptr &&
                                                 !grid.has_table_column(dimensionless)));
        }
    };
    for (const std::string_view name : {"slenderness", "slenderness_plus", "slenderness_minus"}) {
        judge(plausible::slenderness, name, "", std::numbers::pi / 180);
    }
    for (const std::string_view name : {"size", "size_plus", "size_minus"}) {
        judge(plausible::size, name);
    }
    judge(plausible::gyration, "gyration_over_size");
    judge(plausible::friction, "friction");
    if (grid.may_slip() && scene.has_two_components()) {
        findings.emplace_back(
            "the slip is computed in the plane of the direction only, without the "
            "motion across it");
    }
    judge(grid.find("size_plus") != nullptr ? plausible::implied_incline : plausible::incline,
          "incline", "", std::numbers::pi / 180);
    if (coordinates.has("center_height") && coordinates.has("half_height")) {
        const double highest = extent_of(coordinates.of("center_height").values).last;
        const double height = 2 * extent_of(coordinates.of("half_height").values).last;
        findings.push_back(highest <= height ? ""
                                             : fmt::format("center_height = {:.4g} m is above the "
                                                           "top of the block, which is {:.4g} m "
                                                           "high (lengths are in metres)",
                                                           highest, height));
    }
    judge(plausible::period, "pulse_period", "frequency");
    const bool has_metres = coordinates.has("size") || coordinates.has("size_plus");
    if (has_metres && grid.find("amplitude") != nullptr) {
        const Extent amplitude = extent_of(coordinates.of("amplitude").values);
        findings.push_back(
            amplitude.last > 1
                ? ""
                : fmt::format("amplitude = {} lifts no block (amplitudes are multiples "
                              "of the acceleration that lifts the block; accelerations "
                              "in g are given as pga)",
                              amplitude.text("")));
    }
    judge(plausible::acceleration, "pga", scene.motion_traits().amplitude);
    judge_records(scene, findings);
    findings.push_back(finding_about_restitution(coordinates, grid.table() != nullptr));
    judge_directions(grid, coordinates, findings);
    return scene.worded(text_of(findings));
}

} // namespace overturn
