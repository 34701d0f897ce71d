"""The ranks benchmark: the speedup by several ranks."""

import statistics

from building import fail
from launching import add_program_argument, launcher, measured_run, program

EXPLANATION = """\
Runs jobs/figure_07a.toml at a tolerance of 1e-12 on one rank and on several, in turns. A run takes
half a minute. Do not run other programs at the same time."""


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--ranks", type=int, default=2,
                        help="number of ranks to compare with one (default: 2)")
    parser.add_argument("--points", type=int, default=4096,
                        help="points of the frequency and of the amplitude axis (default: 4096)")
    parser.add_argument("--repeat", type=int, default=3,
                        help="runs for each number of ranks (default: 3)")


def run(options):
    if options.ranks < 2:
        fail("--ranks must be at least 2")
    overturn = program(options)
    print(f"figure_07a at {options.points} x {options.points} points, tolerance 1e-12, "
          f"{options.repeat} times in turns:", flush=True)
    times = {1: [], options.ranks: []}
    for _ in range(options.repeat):
        for ranks in times:
            wall, _ = measured_run(overturn, options.points, ["numerics.tolerance=1e-12"],
                                   launcher(ranks))
            times[ranks].append(wall)
            print(f"  {ranks} rank{'s' if ranks > 1 else ''}: {wall:.2f} s", flush=True)
    one, many = (statistics.median(times[ranks]) for ranks in times)
    print(f"median: {one:.2f} s on one rank, {many:.2f} s on {options.ranks}; "
          f"ratio {many / one:.3f}, ideal {1 / options.ranks:.3f}")
