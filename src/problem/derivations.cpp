#include "derivations.hpp"

#include "overturn/mechanics/block.hpp"
#include "overturn/problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace overturn {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

using Values = Derivation::Values;

const Accelerogram& record_of(const Scene& scene, double motion)
{
    return *scene.records[Scene::record_index(motion)];
}

/// p of a side: R and the radius of gyration k.
double frequency_parameter_of(const Scene& scene, const Values& of)
{
    const double size = of[0];
    const double gyration = of[1];
    return std::sqrt(scene.gravity * size / (gyration * gyration + size * size));
}

constexpr Derivation of_any_block[]{
    {"half_width", {"width"}, [](const Scene&, const Values& of) { return of[0] / 2; }},
    {"half_height", {"height"}, [](const Scene&, const Values& of) { return of[0] / 2; }},
    {"slenderness",
     {"aspect_ratio"},
     [](const Scene&, const Values& of) { return std::atan(1 / of[0]); }},
    {"scale",
     {"pga", "record_pga"},
     [](const Scene&, const Values& of) { return of[0] / of[1]; },
     Under::record},
    {"pga",
     {"scale", "record_pga"},
     [](const Scene&, const Values& of) { return of[0] * of[1]; },
     Under::record},
    {"record_pga",
     {"motion", "direction"},
     [](const Scene& scene, const Values& of) {
         return record_of(scene, of[0]).in_direction(of[1]).peak();
     },
     Under::two_components},
    {"record_pga",
     {"motion"},
     [](const Scene& scene, const Values& of) { return record_of(scene, of[0]).peak(); },
     Under::record},
    {"samples_per_unit",
     {"motion", "frequency_parameter"},
     [](const Scene& scene, const Values& of) {
         return 1 / (of[1] * record_of(scene, of[0]).time_step());
     },
     Under::record},
};

/// b and h; alpha, R and p.
constexpr Derivation of_symmetric_block[]{
    {"slenderness",
     {"half_width", "half_height"},
     [](const Scene&, const Values& of) { return std::atan(of[0] / of[1]); }},
    {"size",
     {"half_width", "half_height"},
     [](const Scene&, const Values& of) { return std::hypot(of[0], of[1]); }},
    {"size",
     {"frequency_parameter"},
     [](const Scene& scene, const Values& of) { return 3 * scene.gravity / (4 * of[0] * of[0]); }},
    {"frequency_parameter",
     {"size"},
     [](const Scene& scene, const Values& of) {
         return frequency_parameter(of[0], scene.gravity);
     }},
    {"restitution",
     {"restitution_of_maximum", "slenderness"},
     [](const Scene&, const Values& of) { return of[0] * largest_restitution(of[1]); }},
    {"amplitude",
     {"pga", "slenderness"},
     [](const Scene& scene, const Values& of) {
         return of[0] / uplift_threshold(scene.theory, of[1]);
     },
     Under::pulse},
    {"pga",
     {"amplitude", "slenderness"},
     [](const Scene& scene, const Values& of) {
         return of[0] * uplift_threshold(scene.theory, of[1]);
     },
     Under::pulse},
    {"frequency",
     {"pulse_period", "frequency_parameter"},
     [](const Scene&, const Values& of) { return two_pi / (of[0] * of[1]); },
     Under::pulse},
    {"frequency",
     {"pulse_frequency", "frequency_parameter"},
     [](const Scene&, const Values& of) { return two_pi * of[0] / of[1]; },
     Under::pulse},
    {"pulse_period",
     {"frequency", "frequency_parameter"},
     [](const Scene&, const Values& of) { return two_pi / (of[0] * of[1]); },
     Under::pulse},
};

/// k, the height of the centre of mass, and the distances of its foot on the base from the corners;
/// alpha, R, p and r_max.
constexpr Derivation of_block_with_two_sides[]{
    {"center_offset", {}, [](const Scene&, const Values&) { return 0.0; }},
    {"center_height", {"half_height"}, [](const Scene&, const Values& of) { return of[0]; }},
    {"radius_of_gyration",
     {"half_width", "half_height"},
     [](const Scene&, const Values& of) {
         return std::sqrt((of[0] * of[0] + of[1] * of[1]) / 3); // of a uniform box
     }},
    {"incline", {}, [](const Scene&, const Values&) { return 0.0; }},
    {"base_plus",
     {"half_width", "center_offset"},
     [](const Scene&, const Values& of) { return of[0] - of[1]; }},
    {"base_minus",
     {"half_width", "center_offset"},
     [](const Scene&, const Values& of) { return of[0] + of[1]; }},
    {"slenderness_plus",
     {"base_plus", "center_height", "incline"},
     [](const Scene&, const Values& of) { return std::atan(of[0] / of[1]) - of[2]; }},
    {"slenderness_minus",
     {"base_minus", "center_height", "incline"},
     [](const Scene&, const Values& of) { return std::atan(of[0] / of[1]) + of[2]; }},
    {"size_plus",
     {"base_plus", "center_height"},
     [](const Scene&, const Values& of) { return std::hypot(of[0], of[1]); }},
    {"size_minus",
     {"base_minus", "center_height"},
     [](const Scene&, const Values& of) { return std::hypot(of[0], of[1]); }},
    {"frequency_parameter", {"size_plus", "radius_of_gyration"}, frequency_parameter_of},
    {"frequency_parameter_minus", {"size_minus", "radius_of_gyration"}, frequency_parameter_of},
    {"moment_kept", // J / m: the angular momentum that an impact keeps, over m omega
     {"radius_of_gyration", "size_plus", "size_minus", "slenderness_plus", "slenderness_minus"},
     [](const Scene&, const Values& of) {
         const auto [k, plus, minus, alpha_plus, alpha_minus] = of;
         return k * k + plus * minus * std::cos(alpha_plus + alpha_minus);
     }},
    {"gyration_over_size",
     {"radius_of_gyration", "size_plus"},
     [](const Scene&, const Values& of) { return of[0] / of[1]; }},
    {"largest_restitution",
     {"moment_kept", "radius_of_gyration", "size_plus", "size_minus"},
     [](const Scene&, const Values& of) {
         const auto [kept, k, plus, minus, _] = of;
         return kept * kept / ((k * k + plus * plus) * (k * k + minus * minus));
     }},
    {"restitution",
     {"restitution_of_maximum", "largest_restitution"},
     [](const Scene&, const Values& of) { return of[0] * of[1]; }},
    {"amplitude",
     {"pga", "slenderness_plus", "slenderness_minus"},
     [](const Scene& scene, const Values& of) {
         return of[0] / uplift_threshold(scene.theory, std::min(of[1], of[2]));
     },
     Under::pulse},
    {"pulse_period",
     {"pulse_frequency"},
     [](const Scene&, const Values& of) { return 1 / of[0]; },
     Under::pulse},
};

/// The coordinates on the way from a coordinate to those that it may follow from.
using Path = std::vector<std::string_view>;

/// path: to this coordinate, without it.
const Derivation* derivation_on(Path path, std::string_view name, const Scene& scene,
                                const Grid& grid)
{
    path.push_back(name);
    const auto is_known = [&](std::string_view other) {
        return other.empty() || grid.find(other) != nullptr ||
               (std::find(path.begin(), path.end(), other) == path.end() &&
                derivation_on(path, other, scene, grid) != nullptr);
    };
    const auto is_possible = [&](const Derivation& each) {
        return each.name == name && scene.is_under(each.motion) &&
               std::all_of(each.from.begin(), each.from.end(), is_known);
    };
    const std::span<const Derivation> of_its_sides =
        grid.has_two_sides() ? std::span<const Derivation>(of_block_with_two_sides)
                             : of_symmetric_block;
    for (const std::span<const Derivation> table :
         {std::span<const Derivation>(of_any_block), of_its_sides}) {
        const auto found = std::ranges::find_if(table, is_possible);
        if (found != table.end()) {
            return &*found;
        }
    }
    return nullptr;
}

} // namespace

const Derivation* derivation_of(std::string_view name, const Scene& scene, const Grid& grid)
{
    return derivation_on({}, name, scene, grid);
}

} // namespace overturn
