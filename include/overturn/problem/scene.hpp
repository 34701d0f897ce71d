// The simulated scene (ground motion and theory of the block) and the numerics of its integration.
#pragma once

#include "overturn/mechanics/accelerogram.hpp"
#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/mechanics/theory/theory.hpp"
#include "overturn/text/motion_words.hpp"
#include "overturn/text/names.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

enum class Method { rk45, taylor };

/// The ground motions under which something applies.
enum class Under { any_motion, pulse, record, two_components };

/// In job files and result files.
template <>
inline constexpr auto names_of<PulseKind> = [] {
    std::array<std::string_view, pulses.size()> names;
    std::transform(pulses.begin(), pulses.end(), names.begin(),
                   [](const PulseTraits& pulse) { return pulse.name; });
    return names;
}();
template <>
inline constexpr std::array<std::string_view, 2> names_of<Method>{"rk45", "taylor"};
template <>
inline constexpr std::array<std::string_view, 2> names_of<Theory>{"nonlinear", "linear"};

struct Scene {
    PulseKind pulse = PulseKind::one_sine;
    Theory theory = Theory::nonlinear;
    PulseShape shape{};

    /// Recorded ground motions, which replace the pulse; either all or none have a vertical motion,
    /// and a second horizontal component.
    std::vector<std::shared_ptr<const Accelerogram>> records{};
    double gravity = 9.81; ///< g [m/s2]
    MotionOf motion_of = MotionOf::ground;

    bool is_recorded() const { return !records.empty(); }
    bool has_two_components() const { return is_recorded() && !records[0]->second().empty(); }

    bool is_under(Under motion) const
    {
        return motion == Under::any_motion || (motion == Under::pulse && !is_recorded()) ||
               (motion == Under::record && is_recorded()) ||
               (motion == Under::two_components && has_two_components());
    }

    /// A text about the motion of the ground in the words for this motion, see motion_words.hpp.
    std::string worded(std::string_view about_the_ground) const
    {
        return overturn::worded(motion_of, about_the_ground);
    }

    /// The index into `records` of a value of the coordinate "motion", which counts from 1.
    static std::size_t record_index(double motion) { return std::size_t(motion) - 1; }
};

/// The reason why this value of a number of its shape is refused for a pulse, as a text that
/// follows the name of the number: it has no meaning for the pulse, is missing, or is not allowed.
/// Empty if the value is allowed.
std::string refusal_of(PulseKind pulse, ShapeNumber number, std::optional<double> value);

/// |f| over its peak at the ends of a Ricker wavelet's window, where it is truncated [1]; 0 for
/// other pulses.
double cut_by_window(const Scene& scene);

struct Numerics {
    Method method = Method::rk45;
    /// Local error per step, relative to the size of the motion or, if smaller, to alpha [1].
    double tolerance = 1e-9;
    bool resolve = false; ///< settle verdicts in doubt with more digits
};

/// For answers about single points and for references.
inline constexpr Numerics most_accurate{
    .method = Method::taylor, .tolerance = 1e-13, .resolve = true};

/// The default tolerance if verdicts are resolved: about one in a thousand needs more digits; at
/// looser tolerances errors are not known well.
inline constexpr double tolerance_to_resolve_from = 1e-4;

/// The error estimate of longer Runge-Kutta steps is not reliable.
inline constexpr double largest_rk45_tolerance_with_error = 1e-4;

/// Whether the error of a point is bounded reliably.
constexpr bool knows_errors(const Numerics& numerics)
{
    return numerics.method == Method::taylor ||
           numerics.tolerance <= largest_rk45_tolerance_with_error;
}

/// The methods for which kernels are compiled: Taylor series with their order, and those for
/// recorded ground motions in double and in 31 digits.
enum class Integrator { runge_kutta, taylor_14, taylor_20, recorded, recorded_31 };

/// Order 14 takes less time than 20 for errors above 1e-8 under the one-sine pulse, and above 1e-10
/// to 1e-12 under the others. For an error of 1e-9 under the one-sine pulse, order 20 needs a
/// tolerance of 2e-7. Orders 12 and 18 save up to 5 %, but every third term is large after an
/// uplift by a linear pulse: if the last one is not of order 3 n - 1, the error may exceed its
/// bound.
inline constexpr double loosest_tolerance_of_order_20 = 2e-7;

inline Integrator integrator_of(const Scene& scene, const Numerics& numerics)
{
    return scene.is_recorded()                                  ? Integrator::recorded
           : numerics.method == Method::rk45                    ? Integrator::runge_kutta
           : numerics.tolerance > loosest_tolerance_of_order_20 ? Integrator::taylor_14
                                                                : Integrator::taylor_20;
}

} // namespace overturn
