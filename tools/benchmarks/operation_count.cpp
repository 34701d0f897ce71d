// Compiled without contraction, like the kernels, so that the counted operations are exact.
#include "operation_count.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/problem/scene.hpp"

#include <bit>

namespace overturn::benchmarks {

namespace {

thread_local Operations counted;

/// A double that counts its arithmetic operations.
struct Counted {
    Counted() = default;
    explicit Counted(double number) : value(number) {}

    double value;

    friend Counted operator-(const Counted& x) { return Counted(-x.value); }
    friend Counted operator+(const Counted& x, const Counted& y)
    {
        ++counted.plain;
        return Counted(x.value + y.value);
    }
    friend Counted operator-(const Counted& x, const Counted& y)
    {
        ++counted.plain;
        return Counted(x.value - y.value);
    }
    friend Counted operator*(const Counted& x, const Counted& y)
    {
        ++counted.plain;
        return Counted(x.value * y.value);
    }
    friend Counted operator/(const Counted& x, const Counted& y)
    {
        ++counted.divided;
        return Counted(x.value / y.value);
    }
    friend Counted fma(const Counted& x, const Counted& y, const Counted& z)
    {
        ++counted.fused;
        return Counted(std::fma(x.value, y.value, z.value));
    }
    friend Counted sqrt(const Counted& x)
    {
        ++counted.divided;
        return Counted(std::sqrt(x.value));
    }
    friend Counted abs(const Counted& x) { return Counted(std::abs(x.value)); }

    friend bool operator==(const Counted& x, const Counted& y) { return x.value == y.value; }
    friend bool operator!=(const Counted& x, const Counted& y) { return x.value != y.value; }
    friend bool operator<(const Counted& x, const Counted& y) { return x.value < y.value; }
    friend bool operator>(const Counted& x, const Counted& y) { return x.value > y.value; }
    friend bool operator<=(const Counted& x, const Counted& y) { return x.value <= y.value; }
    friend bool operator>=(const Counted& x, const Counted& y) { return x.value >= y.value; }
};

} // namespace

} // namespace overturn::benchmarks

namespace overturn {

template <>
struct number_traits<benchmarks::Counted> : scalar_number_traits<benchmarks::Counted> {
    using Counted = benchmarks::Counted;
    using Lane = number_traits<double>;
    using scalar = double;
    static Counted load(const double* from) { return Counted(*from); }
    static void store(double* to, const Counted& number) { *to = number.value; }
    static Counted power_of_two(const Counted& k)
    {
        ++benchmarks::counted.plain; // k + exponent_shifter
        return Counted(Lane::power_of_two(k.value));
    }
    static SplitNumber<Counted> split(const Counted& x)
    {
        ++benchmarks::counted.plain; // - exponent_shifter
        const SplitNumber<double> parts = Lane::split(x.value);
        return {Counted(parts.mantissa), Counted(parts.exponent)};
    }
};

} // namespace overturn

namespace overturn::benchmarks {

namespace {

/// The same excitation as in the kernel.
PulseExcitation<Counted> excitation_of(const Point& point)
{
    const PulseExcitation<double> in_doubles =
        pulse_excitation<Theory::nonlinear>(ground_motion<double>(PulseKind::one_sine),
                                            point.slenderness, point.amplitude, point.frequency);
    PulseExcitation<Counted> counting{.motion = in_doubles.motion,
                                      .acceleration = Counted(in_doubles.acceleration),
                                      .frequency = Counted(in_doubles.frequency),
                                      .uplifts = {}};
    for (const double phase : in_doubles.uplifts) {
        counting.uplifts.push_back(Counted(phase));
    }
    return counting;
}

template <class Method>
PeerEnd<double> end_of_point(const Point& point, double tolerance)
{
    const Block<Counted> block{Counted(point.slenderness), Counted(point.restitution)};
    const ForcedEnd<Counted> end = run_forced_stage<Method, Theory::nonlinear, Outputs{}>(
        block, excitation_of(point), tolerance);
    const double code = region_code_after_pulse<Theory::nonlinear>(end.state, block)
                            .value; // counted for all points
    const double side = end.state.side.value;
    if (end.capped || end.not_finite) {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return {none, none, Region::undecided};
    }
    const Region fallen = side > 0 ? Region::F_plus : Region::F_minus;
    const auto with_sign = [&](const Counted& x) { return side > 0 ? x.value : 0.0 - x.value; };
    return {with_sign(end.state.tilt), with_sign(end.state.rate),
            end.fell ? fallen : Region(int(code))};
}

PeerEnd<double> end_of_point(const Point& point, const Numerics& numerics)
{
    switch (integrator_of({}, numerics)) {
    case Integrator::taylor_14: return end_of_point<Taylor<14>>(point, numerics.tolerance);
    case Integrator::taylor_20: return end_of_point<Taylor<20>>(point, numerics.tolerance);
    case Integrator::runge_kutta:
    case Integrator::recorded: break;
    }
    return end_of_point<RungeKutta>(point, numerics.tolerance);
}

bool differ(double x, double y)
{
    return std::bit_cast<std::uint64_t>(x) != std::bit_cast<std::uint64_t>(y);
}

} // namespace

OperationCount count_operations(const PeerProblem& problem, const Numerics& numerics)
{
    const std::vector<PeerEnd<double>> products = solve_by_overturn(problem, numerics);
    counted = {};
    int ends_that_differ = 0;
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
        const PeerEnd<double> end = end_of_point(problem.points[i], numerics);
        ends_that_differ += differ(end.angle, products[i].angle) ||
                            differ(end.velocity, products[i].velocity) ||
                            end.region != products[i].region;
    }
    return {counted, ends_that_differ};
}

} // namespace overturn::benchmarks
