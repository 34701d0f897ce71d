// What --help shows below the options of each subcommand, and of overturn itself.
#pragma once

namespace overturn::help {

inline constexpr const char* overview = R"(Examples:
  overturn check jobs/smoke.toml
  overturn run jobs/smoke.toml
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5
  overturn info smoke.h5
  overturn verify smoke.h5
  overturn history jobs/smoke.toml --at frequency=3,amplitude=1.5 -o history.h5
  overturn boundary jobs/smoke.toml

Exit codes: 0 complete, 2 usage, 65 the job's content is wrong, 70 a fault of overturn,
74 anything about the output, 85 stopped and resumable.)";

inline constexpr const char* run = R"(Example:
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5 --set numerics.tolerance=1e-10

The same command resumes an unfinished run, with any number of ranks. SIGUSR1, SIGTERM, SIGINT and
SIGHUP stop it after the tiles in hand, with exit code 85.)";

inline constexpr const char* boundary = R"(Example:
  mpirun -n 8 overturn boundary jobs/figure_07a.toml --set plane.amplitude.count=200
  tools/plot_boundary figure_07a_boundary.h5

For every slenderness, restitution and frequency, all amplitudes between the job's first and last at which
safe turns to unsafe or back, in order, with the regions on both sides. The job's amplitudes are looked
at first; where they tell of more between them, more closely. Each flip is between two settled verdicts
1e-12 apart, whatever [numerics] says. Where the first amplitude overturns the block already, there is no
minimum overturning amplitude, and info says so. Resumes an unfinished run, as overturn run does.)";

inline constexpr const char* check = R"(Example:
  overturn check jobs/smoke.toml --set 'plane.slenderness={ values = [0.2, 0.3] }')";

inline constexpr const char* accuracy = R"(Example:
  overturn accuracy jobs/figure_07a.toml -o accuracy.h5
  tools/plot_accuracy accuracy.h5

Runs both methods at tolerances from 1e-2 to 1e-14, and resolved, on a sample of the job's plane, on one
core; the job's own [numerics] and fields do not matter. Its columns, which OUT.h5 has in more detail:
  evaluations      of the acceleration (rk45), or of its series (taylor), per point
  error            of the margin, against 50 digits; inf where a block fell that should not have, or
                   the other way round
  wrong verdicts   share of the points whose true verdict is known
  undecided        points without a verdict
  error > bound    share of the points whose error exceeds what the field "error" says
  bound / error    its median)";

inline constexpr const char* history = R"(Example:
  overturn history jobs/figure_07a.toml --at frequency=3,amplitude=1.5 -o history.h5
  tools/plot_history history.h5

Prints the region, and the events with the velocity before and after each and q after it (Eq. 12);
angles in rad, time tau = p t. OUT.h5 has angle, velocity, acceleration, q and the ground's acceleration
over time. The pulse is integrated as finely as doubles allow, whatever [numerics] says.)";

inline constexpr const char* info = R"(Example:
  overturn info smoke.h5)";

inline constexpr const char* verify = R"(Example:
  overturn verify smoke.h5

Holds the coordinates against the job in the file, and each tile against the checksum that marks it as
done. Exit code 0: all that is done is as it was written; 74: something is not. A run with the same job
computes damaged tiles again.)";

} // namespace overturn::help
