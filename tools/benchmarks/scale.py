"""The scale benchmark: simulates runs on up to 100,000 ranks."""

import json
import subprocess

from building import add_build_argument, build, run_or_fail
from launching import add_program_argument, launcher, measured_run, program
from whole_run import METHODS, settings

EXPLANATION = """\
Measures the time that rank 0 takes to answer a request and the time for a tile of
jobs/figure_07a.toml, regions only, on two ranks, each a node of its own, and the time to take a tile
from a pool that the cores of this host share. With these, and with answers that take 1 and 6 us, it
simulates runs of 100 and of 1000 tiles per rank on up to 100,000 ranks, on nodes of 1, 64 and 128
ranks: the share of the time of all ranks that is spent on tiles, and the share of rank 0 on
answers."""

ANSWERS = (1e-6, 6e-6)  # [s]


def add_arguments(parser):
    add_program_argument(parser)
    add_build_argument(parser)
    parser.add_argument("--most", type=int, default=100000,
                        help="largest number of ranks (default: 100000)")


def measured_costs(overturn, method):
    """The seconds per answer and per tile, on two nodes of one rank."""
    _, sidecar = measured_run(overturn, 2048, settings(method),
                              ["env", "OVERTURN_RANKS_PER_NODE=1", *launcher(2)])
    tiles = sum(rank["tiles"] for rank in sidecar["ranks"])
    busy = sum(rank["compute_seconds"] + rank["write_seconds"] for rank in sidecar["ranks"])
    return sidecar["dealing_seconds"] / sidecar["requests"], busy / tiles


def run(options):
    overturn = program(options)
    simulate = build(options.build, "bench_scale")
    for method in METHODS:
        measured, tile = measured_costs(overturn, method)
        for answer in (measured, *ANSWERS):
            found = json.loads(run_or_fail([simulate, repr(answer), repr(tile), options.most],
                                           "simulating", stdout=subprocess.PIPE).stdout)
            print(f"\n{method}: an answer takes {1e6 * answer:.2f} us"
                  f"{' (measured)' if answer == measured else ''}, a tile {1e3 * tile:.2f} ms, "
                  f"taking it {1e9 * found['take']:.0f} ns")
            print("   ranks  per node  tiles each  seconds  in tiles  rank 0 answering")
            for row in found["runs"]:
                print(f"{row['ranks']:8}{row['ranks_per_node']:10}{row['tiles_per_rank']:12}"
                      f"{row['seconds']:9.2f}{100 * row['efficiency']:8.1f} %"
                      f"{100 * row['answering']:16.1f} %", flush=True)
