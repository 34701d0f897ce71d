#include "overturn/problem/plausibility.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

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

constexpr PlausibleRange slenderness{"alpha", " degrees", 0, 180 / std::numbers::pi,
                                     "a block wider than 1.5 times its height; angles are in "
                                     "radians"};
constexpr PlausibleRange size{"R", " m", 0.02, 20, "lengths are in metres"};
constexpr PlausibleRange period{"the period of the pulse", " s", 0.02, 20,
                                "periods are in seconds, and lengths in metres"};
constexpr PlausibleRange acceleration{"the peak ground acceleration", " g", 0, 5,
                                      "accelerations are in g"};
constexpr PlausibleRange peak{"the peak of a record", " g", 0.001, 5,
                              "state its unit if the file does not"};
constexpr PlausibleRange time_step{"the time step of a record", " s", 1e-4, 0.5,
                                   "times are in seconds"};
constexpr PlausibleRange gravity{"gravity", " m/s2", 1, 30, "it is g in m/s2"};

/// Which values must be plausible.
enum class Needed { all, one };

/// What looks like a mistake, as one text.
class Findings {
public:
    void judge(const PlausibleRange& range, const Extent& values, Needed needed)
    {
        const bool has_one = values.last >= range.least && values.first <= range.most;
        const bool has_all = values.first >= range.least && values.last <= range.most;
        if (!(needed == Needed::all ? has_all : has_one)) {
            const std::string limits =
                range.least > 0
                    ? fmt::format("outside {} to {:.4g}{}", range.least, range.most, range.unit)
                    : fmt::format("above {:.4g}{}", range.most, range.unit);
            add(fmt::format("{} = {} is {} ({})", range.name, values.text(range.unit), limits,
                            range.advice));
        }
    }

    void add(const std::string& finding) { text_ += (text_.empty() ? "" : "; ") + finding; }

    const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// Adds a finding if r is above r_max (Eq. 17) for a block of this slenderness [rad], and returns
/// whether it did. Above arcsin sqrt(2/3), r_max does not exist.
bool add_restitution(double restitution, double alpha, Findings& findings)
{
    const double largest = largest_restitution(alpha);
    const double rounding = 1e-9; // of numbers that users copy from a printed r_max
    if (!(restitution > largest * (1 + rounding)) || alpha > std::asin(std::sqrt(2.0 / 3))) {
        return false;
    }
    findings.add(fmt::format("r = {:.4g} is above r_max = {:.4g} for alpha = {:.4g} degrees "
                             "(Eq. 17)",
                             restitution, largest, alpha * 180 / std::numbers::pi));
    return true;
}

/// Every row of a table is judged; of a plane, the largest r at the smallest slenderness.
void judge_restitutions(const Coordinates& coordinates, bool has_table, Findings& findings)
{
    const CoordinateValues& restitution = coordinates.of("restitution");
    const CoordinateValues& alphas = coordinates.of("slenderness");
    if (!has_table) {
        add_restitution(extent_of(restitution).last, extent_of(alphas).first, findings);
        return;
    }
    std::vector<std::size_t> both;
    std::set_union(restitution.dimensions.begin(), restitution.dimensions.end(),
                   alphas.dimensions.begin(), alphas.dimensions.end(), std::back_inserter(both));
    const std::vector<double> r = coordinates.along(both, "restitution");
    const std::vector<double> alpha = coordinates.along(both, "slenderness");
    for (std::size_t i = 0; i < r.size() && !add_restitution(r[i], alpha[i], findings); ++i) {
    }
}

} // namespace

std::string implausible_values(const Scene& scene, const Grid& grid)
{
    constexpr double degree = std::numbers::pi / 180;
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    const bool has_table = grid.table() != nullptr;
    Findings findings;
    // Values that follow from a dimensionless axis may be implausible in part.
    const auto judge = [&](const PlausibleRange& range, std::string_view name,
                           std::string_view dimensionless = "", double unit = 1) {
        if (coordinates.has(name)) {
            const Column* axis = grid.find(dimensionless);
            const bool is_in_table =
                axis != nullptr && grid.dimension_of(dimensionless) &&
                grid.dimensions[*grid.dimension_of(dimensionless)].name == table_dimension;
            const Extent extent = extent_of(coordinates.of(name));
            findings.judge(range, {extent.first / unit, extent.last / unit},
                           axis != nullptr && !is_in_table ? Needed::one : Needed::all);
        }
    };
    findings.judge(gravity, {scene.gravity, scene.gravity}, Needed::all);
    judge(slenderness, "slenderness", "", degree);
    judge(size, "size");
    judge(period, "pulse_period", "frequency");
    judge(acceleration, "pga", scene.is_recorded() ? "scale" : "amplitude");
    if (scene.is_recorded()) {
        const auto of_records = [&](const auto& value) {
            CoordinateValues values;
            for (const auto& record : scene.records) {
                values.values.push_back(value(*record));
            }
            return extent_of(values);
        };
        findings.judge(peak, of_records([](const Accelerogram& record) { return record.peak(); }),
                       Needed::all);
        findings.judge(time_step,
                       of_records([](const Accelerogram& record) { return record.time_step(); }),
                       Needed::all);
    }
    judge_restitutions(coordinates, has_table, findings);
    return findings.text();
}

} // namespace overturn
