// The texts that --help prints below the options of overturn and of each subcommand, and further
// sections of the manual page.
#pragma once

namespace overturn::help {

inline constexpr const char* overview = R"(Examples:
  overturn topple --width 0.6 --height 1.8 --period 0.5 --pga 0.4
  overturn keys numerics
  overturn check jobs/smoke.toml
  overturn run jobs/smoke.toml
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5
  overturn info smoke.h5
  overturn verify smoke.h5
  overturn history jobs/smoke.toml --at frequency=3,amplitude=1.5 -o history.h5
  overturn boundary jobs/smoke.toml
  overturn run jobs/smoke.toml --part 1/2
  overturn run jobs/smoke.toml --part 2/2
  overturn merge smoke.part-1-of-2.h5 smoke.part-2-of-2.h5 -o merged.h5

Exit codes: 0 success (of run: the file is complete); 2 error in the command line, or an
unsupported processor or launcher; 65 error in the job; 70 internal error of overturn; 74 a result
file cannot be read or written, is damaged or belongs to another job; 85 stopped by a signal or a
silent rank, resumable.)";

inline constexpr const char* run = R"(Examples:
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5 --set numerics.tolerance=1e-10
  overturn run jobs/smoke.toml --part 3/16

The same command resumes an unfinished run, on any number of ranks. SIGUSR1, SIGTERM, SIGINT and
SIGHUP stop a run cleanly within about two seconds, with exit code 85. Under mpirun, send SIGUSR1:
mpirun itself acts on the other signals and may kill the ranks before they have stopped.

With --part I/N, the run computes one of N parts of about equal duration. The parts are independent:
any number of them run at the same time, on any hosts, each with or without mpirun, and each is
stopped, resumed and verified like a whole run. overturn merge joins their files.)";

inline constexpr const char* merge = R"(Examples:
  for i in 1 2 3; do overturn run jobs/smoke.toml --part $i/3; done
  overturn merge smoke.part-*-of-3.h5 -o smoke.h5

Writes the file that one run would have written, byte for byte; the parts are kept. Before anything
is written, all parts are read, and those that are missing, unfinished, damaged, given twice, or of
another job, version or number of parts are named. The file appears when it is complete: if the
command was stopped or killed, run it again.)";

inline constexpr const char* boundary = R"(Example:
  mpirun -n 8 overturn boundary jobs/figure_07a.toml --set plane.amplitude.count=200
  tools/plot_boundary figure_07a_boundary.h5

Finds, for every combination of the other coordinates, the amplitudes between the first and the last
of the job at which the verdict flips from safe to unsafe or back, with the regions on both sides.
The amplitudes of the job are computed first; where they indicate more flips between them, the steps
are halved. Very narrow safe or unsafe strips may be missed. Each flip lies between two settled
verdicts whose amplitudes differ by at most 1e-12 of their size (under a record, 1e-4), regardless of
[numerics]. If a block already overturns at the first amplitude, overturn info reports it. The same
command resumes an unfinished run. With boundary.along = "width", the values of this quantity at
which the verdict flips are found instead of the amplitudes.

Under a record there is no complete list: the steps are divided evenly until each is at most 0.1 %
of the amplitude, and narrower strips exist. The share of the scanned interval in which the block
overturns is stored as well.)";

inline constexpr const char* topple = R"(Examples:
  overturn topple --width 0.6 --height 1.8 --period 0.5 --pga 0.4
  overturn topple --width 0.6 --height 1.8 --record jobs/synthetic.AT2 --scale 1.5 --history tilt.h5
  overturn topple --height 1.8 --period 0.5 --pga 0.95 --vary width 0.3 1.2

Prints whether a rigid block topples and the nearest strengths that topple it, its peak tilt, the
peak ground acceleration (PGA) that lifts it, and the ranges of the PGA in which it topples or the
verdict is undecided: for the given restitution, and for 0.8 to 1 times r_max, because restitutions
are rarely known. Of a block with two different sides, both directions of the motion are computed
unless --direction is given; the worse one comes first, and --history writes it. Accelerations
within the search and in none of the ranges are safe, except for very narrow ranges that may be
missed. "34 % of 0.6 to 0.7 g" stands for several ranges. The search ends at --pga-max, or where the
vertical motion cancels gravity. g is 9.81 m/s2, unless --set scene.gravity=... changes it. Values
that are probably in another unit cause a warning. If a record is the motion of a floor
(--set scene.motion_of=floor, unless its file states this), all accelerations are peak floor
accelerations (PFA). The exit code is 0 whatever the verdict. For several objects or records see
overturn assess; spectra need a job file, see overturn run.

--vary QUANTITY FIRST LAST searches, instead of the accelerations, the values of a quantity of the
block, or of its restitution, at the strength given by --pga or --scale: it prints the values at
which the block topples or the verdict is undecided, and from which value on, or up to which one,
nothing in the range topples. Of two directions, the worse one counts at each value.)";

inline constexpr const char* assess = R"(Examples:
  overturn assess objects.csv --period 0.5 --pga 0.4
  overturn assess objects.csv --record 'records/*.AT2' --scale 1 --csv answers.csv

Prints a row for each object, the most vulnerable first: the peak ground acceleration (PGA) that
lifts it, that from which on it slides, if it has a friction coefficient, and the lowest one that
topples it; and with --pga or --scale what becomes of it: topples, undecided, rocks, slides or
stands. All are those of the worst motion and direction. "of motions" is the share of motions,
periods and directions under which it topples; "median" and "16 %" are the strengths from which on
half and 16 % of them topple it, in the order of their lowest toppling strengths.

A row of the table is an object; columns are quantities of a block, such as width, height [m],
incline [rad] and friction (see overturn keys block), and any others, such as name. Without a
column of restitutions, r is r_max.

The search for the strengths that topple an object ends at --pga-max. Its steps are at most 0.5 %,
so that narrower ranges may be missed, and ends of ranges are refined to 1e-4; with --fine it is that
of overturn topple, which gives all ranges of an object. The note of an object that does not topple
has the nearest toppling strengths, if one is less or up to 10 % more.)";

inline constexpr const char* check = R"(Examples:
  overturn check jobs/smoke.toml --set 'plane.slenderness={ values = [0.2, 0.3] }'
  overturn check jobs/figure_07a.toml --ranks 256 -o /scratch/figure_07a.h5

Prints the motion, the axes, alpha, R, p and r_max of the block, the friction coefficients that
lifting and impacts need; the size of the file and of its fields, the free space and the quota in
its folder; and the core-hours, time and memory of overturn run on this number of ranks, estimated
from tiles that are computed for some seconds. The speed of the disk is measured on a file without a
name, which vanishes.)";

inline constexpr const char* keys = R"(Examples:
  overturn keys
  overturn keys numerics
  overturn keys pga

Prints the type, range, default and meaning of the keys of job files: of all, of those of a table,
or of one. Keys that describe the block may be in [block] as well as in [plane].)";

inline constexpr const char* doctor = R"(Examples:
  overturn doctor
  overturn doctor /scratch/results > report.txt)";

inline constexpr const char* accuracy = R"(Example:
  overturn accuracy jobs/figure_07a.toml -o accuracy.h5
  tools/plot_accuracy accuracy.h5

Runs both methods (under a record, taylor) at tolerances from 1e-2 to 1e-14, and with resolved
verdicts at those down to 1e-8 (rk45: from 1e-4), on a sample of the job's plane, on one core.
[numerics] and the fields of the job are ignored. OUT.h5 contains these columns and more:
  evaluations      evaluations per point, of the acceleration (rk45) or of its series (taylor)
  error            error of the margin, against 50 digits; inf if the block falls in only one of
                   the two computations
  slide            with friction: error of the final slide over R; blocks that slip after the ground
                   motion have no margin
  wrong verdicts   as a share of the points whose true verdict is known; OUT.h5 contains the
                   number
  undecided        number of points without a verdict
  error > bound    share of the points whose error exceeds the field "error"
  bound / error    median of this ratio)";

inline constexpr const char* history = R"(Example:
  overturn history jobs/figure_07a.toml --at frequency=3,amplitude=1.5 -o history.h5
  tools/plot_history history.h5

Prints region, margin, peak tilt, the times of fall and rest, and the first 24 events; for each
event, the velocity before and after it, and q (Eq. 12) after it. The peak tilt is in degrees. Other
angles and the times are in degrees and seconds if the job gives the size of the block, otherwise in
rad and 1/p; q is in rad2. OUT.h5 contains angle, velocity and acceleration [rad], q [rad2] and the
ground acceleration over g as functions of tau = p t. The motion is integrated as accurately as
doubles allow, regardless of [numerics].)";

inline constexpr const char* info = R"(Examples:
  overturn info smoke.h5
  overturn info smoke.h5 --json

Prints what a result file contains, how many tiles are done, and whether a run writes it, with its
rate and the time left. A run reports these every 10 s in OUT.h5.json. If the last report is older
than 30 s, the run may be dead, and its state is unknown.)";

inline constexpr const char* verify = R"(Example:
  overturn verify smoke.h5

Checks the values of the coordinates and of each finished tile.
Exit code 0: the file is intact, even if tiles are missing; 74: it is damaged. A run of the same job
recomputes damaged tiles.)";

} // namespace overturn::help

namespace overturn::manual {

inline constexpr const char* description =
    R"(A rigid block that stands free on the ground rocks when the ground shakes, and may overturn.
An overturning spectrum shows what becomes of the block for every frequency and amplitude of a
pulse. overturn computes such spectra, with or without mpirun, and stores each in one HDF5 file,
which h5py and xarray read without conversion. A job file in TOML specifies the computation.)";

inline constexpr const char* files = R"(Relative to the folder of the program:

  ../share/overturn/jobs        example jobs
  ../share/overturn/jobs/slurm  batch scripts that requeue themselves until a file is complete
  ../share/overturn/tools       the Python tools
  ../share/doc/overturn         documentation: job files, result files, accuracy
  ../include/overturn           the physics for C++ programs: find_package(overturn)

OUT.h5.json, next to a result file OUT.h5, contains the hosts, times and libraries of the run, and
while it lasts its progress.)";

inline constexpr const char* tools =
    R"(The examples use the names in the source folder: tools/plot_history is overturn-plot-history,
and so on. All tools have --help.

  overturn-plot-spectrum   draws the regions over frequency and amplitude
  overturn-plot-boundary   draws the minimum overturning amplitude and all other flips
  overturn-plot-history    draws the motion of one block over time
  overturn-plot-fragility  draws the fraction of the blocks that overturn under a suite of records
  overturn-plot-risk       draws the rate at which blocks overturn at a site with a hazard curve
  overturn-plot-accuracy   draws error and wrong verdicts against time
  overturn-plot-landing    draws the end state of each point of a spectrum in phase space
  overturn-plot-phase      draws the regions in phase space
  overturn-floor-motion    writes the motions of a floor of a building from those of the ground
  overturn-report          makes a page from the answers of overturn assess
  overturn-rock            makes a table of blocks from a mesh and its points of contact
  overturn-to-csv          writes a result as a table
  overturn-synthetic-record
                           writes a synthetic recorded motion)";

inline constexpr const char* environment =
    R"(As root, Open MPI requires OMPI_ALLOW_RUN_AS_ROOT=1 and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1. The
batch scripts find the program and each other in the folder OVERTURN_CHECKOUT; for an installed
overturn this is ../share/overturn.)";

} // namespace overturn::manual
