"""The ranks benchmark: the speedup by several ranks."""

import statistics

from building import fail
from launching import (AXES, JOB, RECORD_AXES, RECORD_JOB, add_program_argument, launcher,
                       measured_run, program)

EXPLANATION = """\
Runs jobs/figure_07a.toml at a tolerance of 1e-12 on one rank and on several, in turns; with
--record, jobs/synthetic.toml without resolving verdicts. A run takes half a minute. Do not run other
programs at the same time."""


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--ranks", type=int, default=2,
                        help="number of ranks to compare with one (default: 2)")
    parser.add_argument("--record", action="store_true", help="blocks under a record")
    parser.add_argument("--points", type=int,
                        help="points of each axis of the plane (default: 4096; with --record 1024)")
    parser.add_argument("--repeat", type=int, default=3,
                        help="runs for each number of ranks (default: 3)")


def run(options):
    if options.ranks < 2:
        fail("--ranks must be at least 2")
    overturn = program(options)
    if options.record:
        job, axes, points, setting = RECORD_JOB, RECORD_AXES, 1024, "numerics.resolve=false"
    else:
        job, axes, points, setting = JOB, AXES, 4096, "numerics.tolerance=1e-12"
    points = options.points or points
    print(f"{job.stem} at {points} x {points} points, {setting}, {options.repeat} times in turns:",
          flush=True)
    times = {1: [], options.ranks: []}
    for _ in range(options.repeat):
        for ranks in times:
            wall, _ = measured_run(overturn, points, [setting], launcher(ranks), job, axes)
            times[ranks].append(wall)
            print(f"  {ranks} rank{'s' if ranks > 1 else ''}: {wall:.2f} s", flush=True)
    one, many = (statistics.median(times[ranks]) for ranks in times)
    print(f"median: {one:.2f} s on one rank, {many:.2f} s on {options.ranks}; "
          f"ratio {many / one:.3f}, ideal {1 / options.ranks:.3f}")
