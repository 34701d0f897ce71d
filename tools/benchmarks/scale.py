"""The scale benchmark: simulates runs on up to 100,000 ranks."""

import json
import subprocess

from building import add_build_argument, build, run_or_fail
from launching import add_program_argument, launcher, measured_run, program
from whole_run import METHODS, settings

EXPLANATION = """\
Measures on two ranks the time that rank 0 takes to answer a request and the time for a tile of
jobs/figure_07a.toml, regions only. With these, it simulates runs of 100 and of 1000 tiles per rank,
with the dealer of the program, on up to 100,000 ranks: the share of the time of all ranks that is
spent on tiles, and the share of rank 0 on answers. In brackets: at most 16 tiles per range."""


def add_arguments(parser):
    add_program_argument(parser)
    add_build_argument(parser)
    parser.add_argument("--most", type=int, default=100000,
                        help="largest number of ranks (default: 100000)")


def measured_costs(overturn, method):
    """The seconds per answer and per tile, on two ranks."""
    _, sidecar = measured_run(overturn, 2048, settings(method), launcher(2))
    tiles = sum(rank["tiles"] for rank in sidecar["ranks"])
    busy = sum(rank["compute_seconds"] + rank["write_seconds"] for rank in sidecar["ranks"])
    return sidecar["dealing_seconds"] / sidecar["requests"], busy / tiles


def run(options):
    overturn = program(options)
    simulate = build(options.build, "bench_scale")
    for method in METHODS:
        answer, tile = measured_costs(overturn, method)
        print(f"\n{method}: an answer takes {1e6 * answer:.2f} us, a tile {1e3 * tile:.2f} ms")
        print("   ranks  tiles each  seconds         in tiles   rank 0 answering")
        found = run_or_fail([simulate, repr(answer), repr(tile), options.most], "simulating",
                            stdout=subprocess.PIPE)
        for row in json.loads(found.stdout):
            print(f"{row['ranks']:8} {row['tiles_per_rank']:11} {row['seconds']:8.3g}"
                  f"{100 * row['efficiency']:8.1f} % ({100 * row['fixed_efficiency']:5.1f})"
                  f"{100 * row['answering']:9.1f} % ({100 * row['fixed_answering']:5.1f})",
                  flush=True)
