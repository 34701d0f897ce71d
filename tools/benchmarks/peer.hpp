// Input and output of every solver in the benchmark: the points of a plane, and the state of each
// block at the end of the ground motion. Dimensionless: velocities are d theta / d(p t).
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/problem/grid.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace overturn::benchmarks {

/// The end of the forced stage of one point.
template <class S>
struct PeerEnd {
    S angle;       ///< theta [rad]; NaN if the solver failed
    S velocity;    ///< d theta / d tau [rad]
    Region region; ///< undecided if the solver failed
};

/// The points of a grid under a ground motion, frequency or size fastest.
struct PeerProblem {
    Scene scene;
    Grid grid;         ///< two axes
    double error_unit; ///< of the errors of angle and velocity [rad]
    std::vector<Point> points;
};

/// The paper's block under a one-sine pulse, nonlinear theory, r = r_max: count x count points.
/// Errors are in radians.
PeerProblem paper_block_problem(int count);

/// Blocks of different sizes under a record in g, multiplied by a scale, nonlinear theory, r =
/// r_max: count x count points. Errors are over the slenderness. Throws Error.
PeerProblem record_problem(const std::string& path, int count);

/// Computes the ends of all points; tolerance: local error per step over the slenderness [1].
using Solve =
    std::function<std::vector<PeerEnd<double>>(const PeerProblem& problem, double tolerance)>;

struct Solver {
    std::string name;
    Solve solve;
};

/// Overturn's methods for pulses or for records.
std::vector<Solver> overturn_solvers(bool recorded);

/// What overturn knows about its solution of a point.
struct PointEffort {
    double error; ///< bound on the error of the margin [1]
    double steps;
};
std::vector<PointEffort> efforts_of_overturn(const PeerProblem& problem, const Numerics& numerics);

/// The sine and cosine that a peer uses in the equation of motion: those of the C library, or
/// overturn's polynomials.
enum class Sines { library, overturn };

std::vector<PeerEnd<double>> solve_by_odeint_dopri5(const PeerProblem& problem, double tolerance);
template <Sines sines>
std::vector<PeerEnd<double>> solve_by_odeint_dopri5_restepping(const PeerProblem& problem,
                                                               double tolerance);
template <Sines sines>
std::vector<PeerEnd<double>> solve_by_gsl_rk8pd(const PeerProblem& problem, double tolerance);
std::vector<PeerEnd<double>> solve_by_arkode(const PeerProblem& problem, double tolerance);
std::vector<PeerEnd<double>> solve_by_cvode_adams(const PeerProblem& problem, double tolerance);

/// The reference solution: in long double, by a third-party method and implementation.
std::vector<PeerEnd<long double>> solve_reference(const PeerProblem& problem, double tolerance);

} // namespace overturn::benchmarks
