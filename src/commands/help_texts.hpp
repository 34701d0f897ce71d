// What --help shows below the options of each subcommand, and of overturn itself, and what the
// manual page says besides.
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

namespace overturn::manual {

/// Of these words. The day of the build would make equal sources give other bytes.
inline constexpr const char* date_of_words = "2026-11-21";

inline constexpr const char* description =
    R"(A rigid block standing free on the ground rocks when the ground shakes, and may overturn. An
overturning spectrum shows, for every pulse frequency and amplitude, what becomes of the block.
overturn computes such spectra, alone or under mpirun, into one HDF5 file that h5py and xarray open as
it is. What to compute is said by a job file, in TOML.)";

inline constexpr const char* files = R"(Beside the folder of the program:

  ../share/overturn/jobs        jobs to begin with
  ../share/overturn/jobs/slurm  batch scripts that go on until a file is complete
  ../share/overturn/tools       the Python tools
  ../share/doc/overturn         documentation: job files, result files, accuracy
  ../include/overturn           the physics for C++ programs: find_package(overturn)

OUT.h5.json beside a result file OUT.h5 tells of hosts, times and libraries.)";

inline constexpr const char* tools =
    R"(In the examples tools/plot_history stands for overturn-plot-history, and so on. Each has --help.

  overturn-plot-spectrum   draws a spectrum: which region each block ends in
  overturn-plot-boundary   draws where verdicts flip
  overturn-plot-history    draws one block over time
  overturn-plot-accuracy   draws what accuracy costs in time
  overturn-plot-landing    draws where each pulse lands its block in phase space
  overturn-plot-phase      draws the regions in phase space
  overturn-join-spectra    joins spectra that differ in slenderness
  overturn-to-csv          writes a spectrum as a table
  overturn-to-xdmf         writes what ParaView needs to open a result file)";

inline constexpr const char* environment =
    R"(Open MPI starts ranks as root only if OMPI_ALLOW_RUN_AS_ROOT and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM
are 1. The batch scripts look for the program and for each other in the folder that OVERTURN_CHECKOUT names;
of an installed overturn that is ../share/overturn.)";

} // namespace overturn::manual
