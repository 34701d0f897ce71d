// The points of a spectrum: the product of up to four axes, of which a list may replace some.
#pragma once

#include "overturn/sweep/scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn {

enum class Spacing { linear, log };

/// Names in job files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> spacing_names{"linear", "log"};

constexpr std::string_view name_of(Spacing spacing)
{
    return spacing_names[std::size_t(spacing)];
}

/// first + (last - first) i / (count - 1), or the same for the logarithms; the last value is exact.
struct AxisRange {
    double first = 0;
    double last = 0;
    std::int64_t count = 1;
    Spacing spacing = Spacing::linear;
};

using AxisList = std::vector<double>;

/// Strictly ascending values, given as a range or as a list.
class Axis {
public:
    Axis() : Axis(AxisList{0}) {}
    explicit Axis(AxisRange range) : definition_(range) {}
    explicit Axis(AxisList values) : definition_(std::move(values)) {}

    std::int64_t size() const;
    double operator[](std::int64_t i) const;
    double first() const { return (*this)[0]; }
    double last() const { return (*this)[size() - 1]; }

    /// The values of [begin, end).
    std::vector<double> values(std::int64_t begin, std::int64_t end) const;
    std::vector<double> values() const { return values(0, size()); }

    const std::variant<AxisRange, AxisList>& definition() const { return definition_; }

private:
    std::variant<AxisRange, AxisList> definition_;
};

/// Half width b and half height h [m] of a block, which a job can give instead of a slenderness.
struct BlockSize {
    double half_width = 0;
    double half_height = 0;
};

/// The half diagonal R [m].
double half_diagonal(const BlockSize& block);

/// p = sqrt(3g / 4R) [1/s] of a block of half diagonal R [m]; gravity: g [m/s2].
double frequency_parameter(double half_diagonal, double gravity);

/// The ground acceleration over g that lifts a block of this slenderness [rad] at rest [1].
double uplift_threshold(Theory theory, double slenderness);

/// What the axes `amplitude` and `frequency` of a plane contain. Under a pulse: a or the peak
/// ground acceleration over g; Omega, the period or the frequency of the pulse. Under a record: a
/// factor on it or its peak ground acceleration over g; the size of the block or its p.
enum class AmplitudeQuantity { amplitude, scale, pga };
enum class FrequencyQuantity {
    frequency,
    pulse_period,
    pulse_frequency,
    size,
    frequency_parameter
};

/// Names in job files and result files, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> amplitude_names{"amplitude", "scale", "pga"};
inline constexpr std::array<std::string_view, 5> frequency_names{
    "frequency", "pulse_period", "pulse_frequency", "size", "frequency_parameter"};

constexpr std::string_view name_of(AmplitudeQuantity quantity)
{
    return amplitude_names[std::size_t(quantity)];
}
constexpr std::string_view name_of(FrequencyQuantity quantity)
{
    return frequency_names[std::size_t(quantity)];
}

/// A point of a spectrum; its coordinates are assumed to be exact.
struct PlanePoint {
    double slenderness; ///< [rad]
    double restitution; ///< r [1]
    double amplitude;   ///< a, or the factor on a record [1]
    double frequency;   ///< Omega, or the samples of a record per time unit 1/p [1]
};

/// The blocks of a list, which replace the axes slenderness, restitution and, under a record,
/// frequency. With motions of their own, they replace all axes. Arrays of one value per block, all
/// of which are empty in a job read from a result file.
struct BlockList {
    std::int64_t size = 0;
    bool has_own_motions = false;

    std::vector<double> slenderness;         ///< alpha [rad]
    std::vector<double> restitution;         ///< r [1]
    std::vector<double> frequency_parameter; ///< p [1/s]; empty: unknown
    std::vector<double> amplitude;           ///< PlanePoint::amplitude of own motions
    std::vector<double> frequency;           ///< PlanePoint::frequency of own motions
    std::vector<std::int64_t> motion;        ///< number of the record of own motions
};

struct Plane {
    Axis frequency;   ///< Omega = omega_p / p [1], or see frequency_is: period [s], frequency [Hz],
                      ///< R [m] or p [1/s]
    Axis amplitude;   ///< a = a_p / (g tan alpha), linear theory a_p / (g alpha) [1], or see
                      ///< amplitude_is: factor [1] or peak ground acceleration over g [1]
    Axis restitution; ///< r, or r / r_max(alpha), see restitution_of [1]
    Axis slenderness; ///< alpha [rad]
    AmplitudeQuantity amplitude_is = AmplitudeQuantity::amplitude;
    FrequencyQuantity frequency_is = FrequencyQuantity::frequency;
    RestitutionOf restitution_of = RestitutionOf::absolute;
    std::int64_t motions =
        0; ///< number of records, the slowest dimension; 0: a pulse, no dimension
    std::optional<BlockSize> block; ///< set if the slenderness was computed from it
    std::optional<double> size;     ///< R [m] of all blocks under a pulse, if the job gives it
    std::shared_ptr<const BlockList> list; ///< replaces axes; null: a plane

    /// Number of points; checked for overflow when the job is read.
    std::int64_t points() const;

    /// The energy ratio r at an impact, for the given indices of the two axes [1].
    double restitution_ratio(std::int64_t slenderness_index, std::int64_t restitution_index) const;
};

/// The peak ground acceleration over g at PlanePoint::amplitude = 1: that of the record, or the
/// least one under a pulse that lifts a block of this slenderness [rad]. motion: the number of the
/// record.
double pga_of_unit_amplitude(const Scene& scene, std::int64_t motion, double slenderness);

/// The peak ground acceleration over g above which the motion lifts a block of this slenderness
/// [rad] at rest; infinite if it never does.
double lifting_pga(const Scene& scene, std::int64_t motion, double slenderness);

/// The value of the amplitude axis at PlanePoint::amplitude = 1.
double amplitude_unit(const Scene& scene, const Plane& plane, std::int64_t motion,
                      double slenderness);

/// PlanePoint::frequency of a value of this quantity. motion: the number of the record; parameter:
/// p [1/s] of the block, for the period or the frequency of a pulse in Hz.
double frequency_of_point(const Scene& scene, FrequencyQuantity quantity, std::int64_t motion,
                          double value, double parameter);

/// The same for a value of the frequency axis.
double frequency_of_point(const Scene& scene, const Plane& plane, std::int64_t motion,
                          double value);

} // namespace overturn
