// The forced stages of a set of points, repeated with more digits if verdicts require it.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/integrate/run_sliding.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/tile.hpp"

#include <limits>
#include <memory>
#include <vector>

namespace overturn {

/// The outcomes of points, in their order.
struct Outcomes {
    Outcomes(int points, const Outputs& wanted)
        : outputs(wanted), count(points),
          of_points(std::make_unique_for_overwrite<Outcome[]>(std::size_t(points)))
    {}

    int size() const { return count; }
    Outcome& operator[](std::size_t point) { return of_points[point]; }
    const Outcome& operator[](std::size_t point) const { return of_points[point]; }

    Outputs outputs; ///< the values of an outcome that are set
    int count;
    std::unique_ptr<Outcome[]> of_points; ///< not initialised, which would take 3 % of a run
    int in_50_digits = 0;                 ///< the number of points that were computed in 50 digits
};

/// The outcome of a block that is not lifted, but slides.
inline constexpr Outcome at_rest = [] {
    Outcome outcome{};
    outcome.side = 1;
    outcome.region = Region::S;
    outcome.margin = 1;
    outcome.to_stick = infinity;
    return outcome;
}();

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
class PointRun final : public PointsOfScene {
public:
    /// are_symmetric: whether all blocks are known to be; then a kernel reads less of each.
    PointRun(const Scene& scene, std::vector<Point> points, Kernel kernel,
             DropRequested drop_requested = nullptr, bool are_symmetric = false);

    /// The indices of all points.
    std::vector<int> all() const;

    /// The phase at the end of the pulse, if there are no records [rad].
    double end_of_pulse() const { return pulse_.end; }

    /// The record of a point; nullptr under a pulse.
    const Accelerogram* record_of(int point) const
    {
        return records_.empty() ? nullptr : records_[std::size_t(point)].get();
    }

    /// The scaled pulse of a point.
    const ScaledPulse<double>& pulse_of(int point) const { return pulses_[point]; }

    /// Integrates the chosen points, which must be in ascending order. Points where the ground
    /// falls as fast as the block are not integrated and get status::free_fall.
    void run(const Numerics& numerics, Outcomes& outcomes, const std::vector<int>& chosen,
             UncertainImpact uncertain_impact = UncertainImpact::go_on) const;

    /// The same in 31 digits. Region, margin and error are computed before the end is rounded to
    /// double.
    void run_in_31_digits(Outcomes& outcomes, const std::vector<int>& chosen) const;

    /// Whether blocks have a friction coefficient, and may slip.
    bool has_friction() const;

    /// The motion of one point with friction, whether it slips or not, in 50 digits. Values are
    /// rounded to double in the end; the margin has no error.
    void let_slip_in_50_digits(int point, Outcomes& outcomes) const;

    /// Replaces the outcomes of the blocks that slip; those of the others, with the friction that
    /// they need to stick, are known.
    void let_slip(const Numerics& numerics, const Outputs& outputs, Outcomes& outcomes) const;

    /// Integrates one point in more digits, T: Digits31, only under a pulse, or Digits50.
    /// Region, margin and error are computed before the end is rounded to double.
    template <class T>
    void run_in_more_digits(int point, Outcomes& outcomes) const;

    /// Settles a point whose bounces are provably low, by bound_of_low_bounces(): it is safe, and
    /// the bound is the error of its margin. If the point is capped, its end is set to rest.
    bool settle_low_bounces(int point, Outcome& outcome) const;

    double first_uplift(int point) const override;

private:
    void throw_if_dropped() const;

    /// How the motion of a point that slips ended.
    struct Slip {
        SlidingEnd<double> end;
        double error = 0;       ///< of the margin, if it is asked for
        bool is_settled = true; ///< if verdicts are resolved: all runs have the region
    };
    /// The motion of a point with friction in numbers of type T. frequency: instead of its own.
    template <class T>
    SlidingEnd<T> run_with_friction(int point, double frequency, T tolerance, Follow follow) const;

    Slip slip_of(int point, double frequency, const Numerics& numerics,
                 const Outputs& outputs) const;

    /// Whether two points have all but the frequency and the restitution in common.
    bool differ_in_frequency_alone(int one, int other) const;

    void run_by(Integrator integrator, double tolerance, Outcomes& outcomes,
                const std::vector<int>& chosen, UncertainImpact uncertain_impact) const;

    /// Whether gravity vanishes or is reversed at some time of the record.
    bool falls_freely(int point) const;

    /// Calls visit(excitation) for one point, in numbers of type T.
    template <class T, Theory theory, class Visitor>
    auto with_excitation(int point, const Visitor& visit) const;

    PulseMotion<double> pulse_{}; // only under a pulse
    Kernel kernel_;
    DropRequested drop_requested_;
    ScaledPulses pulses_;         // the same
    std::vector<Record> records_; // of the points; empty under a pulse
    bool are_symmetric_;
};

/// The verdict cannot be settled.
inline void give_up(Outcome& outcome)
{
    outcome.flags |= status::unresolved;
    outcome.region = Region::undecided;
}

/// Integrates again, with more and more digits, the points whose verdict is in doubt; those that
/// remain in doubt get status::unresolved. most_in_50_digits: the largest number of points
/// computed in 50 digits. Defined in resolve.cpp.
void resolve(const PointRun& run, int most_in_50_digits, Outcomes& outcomes);

/// The outcomes of all points of any job, resolved if its numerics ask for it. most_in_50_digits:
/// see resolve(); by default, no point depends on the others. Defined in outcomes_of.cpp.
Outcomes outcomes_of(const PointRun& points, const Numerics& numerics, const Outputs& outputs,
                     int most_in_50_digits = std::numeric_limits<int>::max());

} // namespace overturn
