// The ground motion of a scene: a pulse, a pulse that is given by a table, or records. What depends
// on which of them it is stands here as its traits and functions.
#pragma once

#include "overturn/mechanics/accelerogram.hpp"
#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/problem/numerics.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace overturn {

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

/// A pulse as job files name it, and the numbers that complete it.
struct NamedPulse {
    std::string_view name;
    std::vector<std::pair<std::string_view, double>> numbers;
};

struct MotionTraits {
    std::string_view name; ///< in sentences
    Under under;           ///< of what applies to this motion only
    Under under_others;    ///< of what applies to other motions only

    // The coordinates from which the numbers of a point follow.
    std::string_view amplitude;
    std::string_view frequency;
    std::string_view frequency_with_two_sides;
    std::string_view choice;                   ///< of one motion of several; empty: there is one
    std::string_view fastest_dimension;        ///< the name of its quantity; empty: by their order
    std::array<std::string_view, 9> variables; ///< further names that its result file needs

    std::string_view examples;        ///< of the keys of [plane], beside those of the block
    std::string_view answer_strength; ///< the quantity whose values `topple` computes

    Method method; ///< the default
    bool has_other_methods;
    std::optional<Integrator> in_31_digits; ///< if lanes compute in so many digits

    std::int64_t tile_side;  ///< a tile of this number of points squared takes a few milliseconds
    std::int64_t most_flips; ///< of a line of a boundary that are stored

    // The search for flips, see FlipSearch.
    double finest_step;
    double flip_width;

    /// Whether the block may be lifted again after a bounce series.
    bool lifts_again;

    /// Whether small differences of the motion may grow until the verdict changes: points of
    /// different verdicts lie close together, whatever their margins, and another integration may
    /// have another peak.
    bool is_sensitive;

    std::string_view reason_not_to_fill; ///< empty if spectra may be filled
};

/// A pulse; each point has its own frequency and amplitude.
struct Pulse {
    static constexpr MotionTraits traits{.name = "pulse",
                                         .under = Under::pulse,
                                         .under_others = Under::record,
                                         .amplitude = "amplitude",
                                         .frequency = "frequency",
                                         .frequency_with_two_sides = "angular_frequency",
                                         .choice = "",
                                         .fastest_dimension = "",
                                         .variables = {},
                                         .examples = "frequency, amplitude",
                                         .answer_strength = "pga",
                                         .method = Method::rk45,
                                         .has_other_methods = true,
                                         .in_31_digits = {},
                                         .tile_side = 64,
                                         .most_flips = 64,
                                         .finest_step = 1e-6,
                                         .flip_width = 1e-12,
                                         .lifts_again = false,
                                         .is_sensitive = false,
                                         .reason_not_to_fill = ""};

    PulseKind kind = PulseKind::one_sine;
    PulseShape shape{};

    std::optional<NamedPulse> named() const;

    Integrator integrator(const Numerics& numerics) const
    {
        return numerics.method == Method::rk45                      ? Integrator::runge_kutta
               : numerics.tolerance > loosest_tolerance_of_order_20 ? Integrator::taylor_14
                                                                    : Integrator::taylor_20;
    }
};

using Record = std::shared_ptr<const Accelerogram>;

/// A pulse whose shape is given by a table. It has the coordinates of a pulse, and is integrated as
/// a record.
struct TabulatedPulse {
    static constexpr MotionTraits traits = [] {
        MotionTraits of_table = Pulse::traits;
        of_table.method = Method::taylor;
        of_table.has_other_methods = false;
        of_table.in_31_digits = Integrator::recorded_31;
        of_table.lifts_again = true;
        of_table.reason_not_to_fill = "filling was verified for the other pulses only";
        return of_table;
    }();
    static constexpr std::string_view name = "table";

    Record shape; ///< its phases [rad], its accelerations over the peak

    static std::optional<NamedPulse> named() { return NamedPulse{name, {}}; }

    Integrator integrator(const Numerics&) const { return Integrator::recorded; }
};

/// All values of scene.pulse, those of PulseKind first.
inline constexpr auto pulse_names = [] {
    std::array<std::string_view, pulses.size() + 1> names;
    std::copy(names_of<PulseKind>.begin(), names_of<PulseKind>.end(), names.begin());
    names.back() = TabulatedPulse::name;
    return names;
}();

/// Recorded ground motions, which each point scales. Either all or none have a vertical motion, and
/// a second horizontal component.
struct Suite {
    static constexpr MotionTraits traits{
        .name = "record",
        .under = Under::record,
        .under_others = Under::pulse,
        .amplitude = "scale",
        .frequency = "samples_per_unit",
        .frequency_with_two_sides = "samples_per_second",
        .choice = "motion",
        .fastest_dimension = "size",
        .variables = {"motion_name_length", "record_pga", "pgv", "arias_intensity",
                      "significant_duration", "pga_rotd50", "pga_rotd100", "pgv_rotd50",
                      "pgv_rotd100"},
        .examples = "scale, size",
        .answer_strength = "scale",
        .method = Method::taylor,
        .has_other_methods = false,
        .in_31_digits = Integrator::recorded_31,
        .tile_side = 16,
        .most_flips = 256,
        .finest_step = 1e-3,
        .flip_width = 1e-4,
        .lifts_again = true,
        .is_sensitive = true,
        .reason_not_to_fill = "under a record regions have no simple boundaries"};

    std::vector<Record> records;

    static std::optional<NamedPulse> named() { return std::nullopt; }

    Integrator integrator(const Numerics&) const { return Integrator::recorded; }
};

using Motion = std::variant<Pulse, Suite, TabulatedPulse>;

/// The text, after the name of a key, that refuses it for a pulse: it belongs to others.
std::string refusal_of_key(std::string_view pulse, std::string_view others);

/// The reason why this value of a number of its shape is refused for a pulse, as a text that
/// follows the name of the number: it has no meaning for the pulse, is missing, or is not allowed.
/// Empty if the value is allowed.
std::string refusal_of(PulseKind pulse, ShapeNumber number, std::optional<double> value);

/// |f| over its peak at the ends of a Ricker wavelet's window, where it is truncated [1]; 0 for
/// other pulses.
double cut_by_window(const Pulse& pulse);

} // namespace overturn
