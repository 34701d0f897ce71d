"""The run benchmark: a breakdown of the time of a whole run, from the start of the command to its
exit."""

import resource
import statistics

from building import add_output_argument, write_results
from launching import add_program_argument, launcher, measured_run, program

METHODS = ("rk45", "taylor")
SIDES = (16, 32, 64, 128, 256, 512, 1024, 2048, 4096)  # of square planes

EXPLANATION = """\
Runs jobs/figure_07a.toml, regions only, from the command line, and reports the time spent outside
the kernel: start-up, writing, messages, waiting. First 100 x 100 points on one rank; then planes of
16 x 16 to 4096 x 4096 points on one rank; then 4096 x 4096 points on one rank and on two. Do not
run other programs at the same time."""


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--rounds", type=int, default=3, help="runs of each case (default: 3)")
    parser.add_argument("--ranks", type=int, default=2,
                        help="ranks for the largest plane (default: 2)")
    add_output_argument(parser, "bench_run.json")


def settings(method):
    return ['output.fields=["region"]', f'numerics.method="{method}"']


def record(overturn, method, side, ranks, rounds):
    """The run with the median wall time, and its parts as shares of the time of all ranks."""
    start = launcher(ranks) if ranks > 1 else []
    runs = [measured_run(overturn, side, settings(method), start) for _ in range(rounds)]
    wall, sidecar = sorted(runs, key=lambda run: run[0])[len(runs) // 2]
    all_time = wall * ranks
    compute = sum(rank["compute_seconds"] for rank in sidecar["ranks"])
    write = sum(rank["write_seconds"] for rank in sidecar["ranks"])
    # Ranks wait only at the end, for the slowest rank.
    busy = [rank["compute_seconds"] + rank["write_seconds"] for rank in sidecar["ranks"]]
    return {"method": method, "side": side, "ranks": ranks, "wall_seconds": wall,
            "us_per_point": 1e6 * wall / side**2, "kernel_share": compute / all_time,
            "writing_share": write / all_time,
            "idle_share": sum(max(busy) - part for part in busy) / all_time,
            "tiles": sum(rank["tiles"] for rank in sidecar["ranks"]),
            "compute_seconds": compute}


def print_shares(found):
    rest = 1 - found["kernel_share"] - found["writing_share"] - found["idle_share"]
    print(f"{found['method']:8}{found['ranks']:2} rank{'s' if found['ranks'] > 1 else ' '} "
          f"{found['wall_seconds']:8.2f} s: kernel {100 * found['kernel_share']:5.1f} %, "
          f"writing {100 * found['writing_share']:.1f} %, "
          f"waiting for the last tile {100 * found['idle_share']:.1f} %, "
          f"start, end and messages {100 * rest:.1f} %", flush=True)


def run(options):
    overturn = program(options)
    small = statistics.median(measured_run(overturn, 100, settings("rk45"))[0]
                              for _ in range(max(options.rounds, 5)))
    print(f"100 x 100 points, rk45, from start to exit: {small:.3f} s", flush=True)
    curve = [record(overturn, method, side, 1, options.rounds)
             for method in METHODS for side in SIDES]
    print("\nmicroseconds per point of the whole run, one rank")
    print(f"{'points':>14}" + "".join(f"{method:>10}" for method in METHODS))
    for side in SIDES:
        row = [found["us_per_point"] for found in curve if found["side"] == side]
        print(f"{f'{side} x {side}':>14}" + "".join(f"{value:10.3f}" for value in row))
    print(f"\n{SIDES[-1]} x {SIDES[-1]} points, regions only", flush=True)
    many = [record(overturn, method, SIDES[-1], options.ranks, options.rounds)
            for method in METHODS]
    for found in [found for found in curve if found["side"] == SIDES[-1]] + many:
        print_shares(found)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"largest memory use of a rank: {memory:.0f} MiB", flush=True)
    write_results(options.output, {"benchmark": "run", "seconds_of_100_x_100": small, "most_memory_mib": memory,
                                   "one_rank": curve, "many_ranks": many})
