// What every solver of the benchmark gets and gives: the points of a plane, and how each block is
// at the end of the pulse. Quantities are dimensionless: velocities are d theta / d(p t).
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/plane.hpp"

#include <functional>
#include <string>
#include <vector>

namespace overturn::benchmarks {

struct PeerPoint {
    double slenderness; ///< alpha [rad]
    double restitution; ///< r [1]
    double amplitude;   ///< a [1]
    double frequency;   ///< Omega [1]
};

/// How the forced stage of one point ended.
template <class S>
struct PeerEnd {
    S angle;       ///< theta [rad]; not a number where the solver gave up
    S velocity;    ///< d theta / d tau [rad]
    Region region; ///< undecided where the solver gave up
};

/// The plane, and its points one by one, frequency fastest.
struct Problem {
    Plane plane;
    std::vector<PeerPoint> points;
};

/// The paper's block under a one-sine pulse, nonlinear theory, r = r_max: count x count points.
Problem paper_block_problem(int count);

/// The ends of all points; tolerance: local error per step over the slenderness [1].
using Solve = std::function<std::vector<PeerEnd<double>>(const Problem& problem, double tolerance)>;

struct Solver {
    std::string name;
    Solve solve;
};

/// Overturn's methods first, then the peers.
std::vector<Solver> all_solvers();

std::vector<Solver> overturn_solvers();
std::vector<PeerEnd<double>> solve_by_overturn(const Problem& problem, const Numerics& numerics);

/// Whose sine and cosine a peer takes in the equation of motion: the C library's, or overturn's
/// polynomials.
enum class Sines { library, overturn };

std::vector<PeerEnd<double>> solve_by_odeint_dopri5(const Problem& problem, double tolerance);
template <Sines sines>
std::vector<PeerEnd<double>> solve_by_odeint_dopri5_restepping(const Problem& problem,
                                                               double tolerance);
template <Sines sines>
std::vector<PeerEnd<double>> solve_by_gsl_rk8pd(const Problem& problem, double tolerance);
std::vector<PeerEnd<double>> solve_by_arkode(const Problem& problem, double tolerance);
std::vector<PeerEnd<double>> solve_by_cvode_adams(const Problem& problem, double tolerance);

/// The truth to measure errors by: in long double, by a method and code of others.
std::vector<PeerEnd<long double>> solve_reference(const Problem& problem, double tolerance);

/// Fused multiply-adds per second of this core at full width, vectors times lanes: the best of
/// several samples [1/s].
double fma_peak_per_second();

} // namespace overturn::benchmarks
