// The forced stages of a set of points, repeated with more digits if verdicts require it.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/tile.hpp"

#include <limits>
#include <type_traits>
#include <vector>

namespace overturn {

/// The arrays that OutcomePointers points to; those that are not requested are empty.
struct Outcomes {
    Outcomes(std::size_t points, const Outputs& wanted);

    OutcomePointers pointers();
    int size() const { return int(tilt.size()); }

    /// The value of the field `impacts`. recorded: whether the ground motion is a record, under
    /// which a block may be lifted again after a bounce series.
    std::uint16_t stored_impacts(std::size_t point, bool recorded) const;

    /// The outcome of a point that cannot be integrated because gravity vanishes.
    void set_free_fall(int point);

    Outputs outputs;
    int in_50_digits = 0; ///< the number of points that were computed in 50 digits
    std::vector<double> tilt, rate, side;
    std::vector<std::uint8_t> flags, region;
    std::vector<double> margin, impacts, error, steps, phase, peak, lowest_turn, softest_impact,
        last_impact, friction, normal;
};

/// Sets the value of a point in an array of outcomes, unless it is no output.
template <class Value>
void put(std::vector<Value>& values, int point, std::type_identity_t<Value> value)
{
    if (!values.empty()) {
        values[std::size_t(point)] = value;
    }
}

/// The scaled pulses of points, in their order; successive points with the same one share it.
struct ScaledPulses {
    ScaledPulses() = default;
    ScaledPulses(const PulseMotion<double>& motion, Theory theory,
                 const std::vector<Point>& points);

    const ScaledPulse<double>& operator[](int point) const
    {
        return pulses[std::size_t(of_point[std::size_t(point)])];
    }

    std::vector<ScaledPulse<double>> pulses;
    std::vector<int> of_point;
};

/// Points of one scene, prepared for integration. Long computations throw TileDropped on request.
class PointRun {
public:
    /// are_symmetric: whether all blocks are known to be; then a kernel reads less of each.
    PointRun(const Scene& scene, std::vector<Point> points, Kernel kernel,
             DropRequested drop_requested = nullptr, bool are_symmetric = false);

    /// The same scene and kernel with other points; only under a pulse.
    PointRun with_points(std::vector<Point> points) const;

    const Scene& scene() const { return scene_; }
    bool are_symmetric() const { return are_symmetric_; }
    int size() const { return int(points_.size()); }
    const Point& point(int i) const { return points_[std::size_t(i)]; }

    /// The indices of all points.
    std::vector<int> all() const;

    /// The phase at the end of the pulse, if there are no records [rad].
    double end_of_pulse() const { return pulse_.end; }

    /// The record of a point; nullptr under a pulse.
    const Accelerogram* record_of(int point) const
    {
        return records_.empty() ? nullptr : records_[std::size_t(point)].get();
    }

    /// The block of a point as seen from the side on which it ended.
    Block<double> block_at_end(std::size_t point, const Outcomes& outcomes) const
    {
        return seen_from(outcomes.side[point], points_[point].block);
    }

    /// The scaled pulse of a point.
    const ScaledPulse<double>& pulse_of(int point) const { return pulses_[point]; }

    /// Integrates the chosen points, which must be in ascending order. Points where the ground
    /// falls as fast as the block are not integrated and get outcome_flag::free_fall.
    void run(const Numerics& numerics, Outcomes& outcomes, const std::vector<int>& chosen,
             UncertainImpact uncertain_impact = UncertainImpact::go_on) const;

    /// The same in 31 digits. Region, margin and error are computed before the end is rounded to
    /// double.
    void run_in_31_digits(Outcomes& outcomes, const std::vector<int>& chosen) const;

    /// Integrates one point in more digits, T: Digits31, only under a pulse, or Digits50.
    /// Region, margin and error are computed before the end is rounded to double.
    template <class T>
    void run_in_more_digits(int point, Outcomes& outcomes) const;

    /// Settles a point whose bounces are provably low, by bound_of_low_bounces(): it is safe, and
    /// the bound is the error of its margin. If the point is capped, its end is set to rest.
    bool settle_low_bounces(int point, Outcomes& outcomes) const;

    /// The largest |theta| / alpha (infinite if the block overturns), and the time from the first
    /// uplift to |theta| = pi/2 [1/p] (infinite if it does not), both during the pulse and after
    /// it. Require outcomes with regions, and with peaks or phases.
    std::vector<double> peaks(const Outcomes& outcomes) const;
    std::vector<double> fall_times(const Outcomes& outcomes) const;

    /// What the contact must bear during the ground motion and after it, by a run of its own; the
    /// normal force over that at rest. NaN for points without a verdict, and where this run has
    /// another region than these. Only in the nonlinear theory.
    std::vector<ContactDemand<double>>
    contact_demands(const Numerics& numerics, const std::vector<std::uint8_t>& regions) const;

private:
    void throw_if_dropped() const;

    struct Accuracy {
        Integrator integrator;
        double tolerance;
        UncertainImpact uncertain_impact;
    };
    void run_to(const Accuracy& accuracy, Outcomes& outcomes, const std::vector<int>& chosen) const;

    /// Whether gravity vanishes or is reversed at some time of the record.
    bool falls_freely(int point) const;

    /// Calls visit(excitation) for one point, in numbers of type T.
    template <class T, Theory theory, class Visitor>
    auto with_excitation(int point, const Visitor& visit) const;

    /// The values of of_point.operator()<theory>(point, end, block), end: its state at the end of
    /// the forced stage, for the points with a verdict; NaN for the others.
    template <class OfPoint>
    std::vector<double> after_the_pulse(const Outcomes& outcomes, const OfPoint& of_point) const;

    Scene scene_;
    PulseMotion<double> pulse_; // not used under records
    Kernel kernel_;
    DropRequested drop_requested_;
    std::vector<Point> points_;
    ScaledPulses pulses_;                                      // only under a pulse
    std::vector<std::shared_ptr<const Accelerogram>> records_; // of the points; empty under a pulse
    bool are_symmetric_;
};

/// Integrates again, with more and more digits, the points whose verdict is in doubt; those that
/// remain in doubt get outcome_flag::unresolved. most_in_50_digits: the largest number of points
/// computed in 50 digits. Defined in resolve.cpp.
void resolve(const PointRun& run, int most_in_50_digits, Outcomes& outcomes);

/// The outcomes of all points of any job, resolved if its numerics ask for it. most_in_50_digits:
/// see resolve(); by default, no point depends on the others.
Outcomes outcomes_of(const PointRun& points, const Numerics& numerics, const Outputs& outputs,
                     int most_in_50_digits = std::numeric_limits<int>::max());

} // namespace overturn
