// A ground motion that is given by samples: accelerations at evenly spaced times, as recorded, or
// the shape of a pulse at phases of its own; linear in between. The first sample is at t = 0; the
// ground is at rest before and after.
#pragma once

#include <cstdint>
#include <vector>

namespace overturn {

/// The accelerations over g that lift a block at rest on either side without vertical motion [1].
struct UpliftThresholds {
    double plus;
    double minus;
};

/// A direction psi in the plane of two horizontal components.
struct HorizontalDirection {
    double cosine;
    double sine;

    /// [degree] from 0 to below 360. That of psi + 180 is the opposite, bit by bit.
    static HorizontalDirection of(double degrees);

    /// The component of a motion in this direction: a1 cos psi + a2 sin psi.
    double component(double first, double second) const { return cosine * first + sine * second; }
};

class Accelerogram {
public:
    /// Accelerations over g [1], at least two; upwards, second: of the same number, or empty if
    /// there is no vertical motion, or no second horizontal component. time_step > 0 [s].
    Accelerogram(std::vector<double> horizontal, std::vector<double> upwards, double time_step,
                 std::vector<double> second = {});

    /// The shape of a pulse, with the peak 1, at ascending phases that begin with 0 [rad]; at least
    /// two. It has no time step.
    static Accelerogram of_pulse(std::vector<double> phases, std::vector<double> shape);

    /// The motion in a direction [degree] of the plane of the horizontal component and the second
    /// one, without a second component. That of psi + 180 is its mirror image, bit by bit.
    Accelerogram in_direction(double degrees) const;

    const std::vector<double>& horizontal() const { return horizontal_; }
    const std::vector<double>& second() const { return second_; }
    const std::vector<double>& upwards() const { return upwards_; }
    double time_step() const { return time_step_; }
    const std::vector<double>& phases() const { return phases_; } ///< empty: evenly spaced in time
    std::int64_t samples() const { return std::int64_t(horizontal_.size()); }

    /// The largest |horizontal| and |upwards| acceleration [1].
    double peak() const { return later_peak_.front(); }
    double upwards_peak() const { return upwards_peak_; }

    /// The mean upwards acceleration; 0 without vertical motion [1].
    double upwards_mean() const;

    /// The smallest factor on the record at which gravity vanishes at some time: 1 / -min of the
    /// upwards acceleration; infinite if that is not negative [1].
    double free_fall_scale() const;

    /// The factor on the record above which it lifts a block; infinite if no factor does [1].
    double lifting_scale(const UpliftThresholds& thresholds) const;

    /// The first sample, starting at `first`, that lifts the block if the record is multiplied by
    /// `scale` (negative: its mirror image); samples() if there is none:
    ///
    ///     |scale a| > (1 + |scale| v) threshold
    ///
    /// with the threshold of the side to which the ground pushes the block: minus if scale a > 0.
    std::int64_t first_lifting(std::int64_t first, double scale,
                               const UpliftThresholds& thresholds) const;

    /// Among the phases of its own, which must exist: the number of the last sample at or before a
    /// phase, except that it is never the last sample nor below 0; of the first sample at or after
    /// it, which is samples() behind the end.
    std::int64_t sample_before(double phase) const;
    std::int64_t sample_after(double phase) const;

private:
    std::vector<double> phases_, horizontal_, upwards_, second_;
    double time_step_;
    double upwards_peak_;
    // Suffix maxima of |horizontal| and of -upwards.
    std::vector<double> later_peak_, later_fall_;
};

} // namespace overturn
