"""The kernel benchmark: time per point of overturn's methods on each kernel, for development."""

import collections
import json
import pathlib
import statistics
import tempfile

from building import add_build_argument, build, fail, run_or_fail

WIDTHS = ("double", "avx2", "avx512")  # the narrowest first

EXPLANATION = """\
Times one tile of 64 x 64 points (the paper's block under a one-sine pulse) with Google Benchmark,
for every method, every kernel that this processor supports and three tolerances, in random order,
and prints the speedup of the widest kernel over one lane. The names are METHOD/TOLERANCE/KERNEL.
Further arguments are passed to Google Benchmark after those of this command:

    tools/bench kernel --benchmark_filter=taylor --benchmark_repetitions=20"""

ARGUMENTS = ["--benchmark_repetitions=5", "--benchmark_enable_random_interleaving=true",
             "--benchmark_min_time=0.1", "--benchmark_display_aggregates_only=true",
             "--benchmark_counters_tabular=true"]


def add_arguments(parser):
    add_build_argument(parser)
    parser.add_argument("--output", type=pathlib.Path,
                        help="file for the JSON of Google Benchmark (default: none)")


def medians(path):
    """(method, tolerance) -> kernel -> median of seconds per point."""
    samples = collections.defaultdict(lambda: collections.defaultdict(list))
    written = path.read_text() if path.exists() else ""
    for run in json.loads(written)["benchmarks"] if written else ():
        if run["run_type"] == "iteration":
            method, tolerance, kernel = run["run_name"].split("/")[:3]
            samples[method, tolerance][kernel].append(run["seconds_per_point"])
    return {case: {kernel: statistics.median(times) for kernel, times in kernels.items()}
            for case, kernels in samples.items()}


def loosest_first(item):
    (method, tolerance), _ = item
    return method, -float(tolerance)


def print_gains(found):
    print(f"\n{'method':10}{'tolerance':>10}{'one lane':>14}{'widest kernel':>24}{'gain':>10}")
    for (method, tolerance), times in sorted(found.items(), key=loosest_first):
        widest = [kernel for kernel in WIDTHS if kernel in times][-1]
        one, many = times["double"], times[widest]
        print(f"{method:10}{tolerance:>10}{1e6 * one:>11.3f} us"
              f"{widest:>12}{1e6 * many:>9.3f} us{one / many:>10.2f}")
    print("Medians per point. The gain is the time of one lane over that of the widest kernel.\n")
    for (method, tolerance), times in sorted(found.items(), key=loosest_first):
        if method == "rk45" and ("taylor", tolerance) in found:
            widest = [kernel for kernel in WIDTHS if kernel in times][-1]
            print(f"rk45 at {tolerance} takes {times[widest] / found['taylor', tolerance][widest]:.2f} times the time "
                  "of taylor")


def run(options):
    program = build(options.build, "bench_kernel")
    with tempfile.TemporaryDirectory() as folder:
        path = (options.output or pathlib.Path(folder) / "kernel.json").resolve()
        if not path.parent.is_dir():
            fail(f"{options.output}: there is no folder {path.parent}")
        run_or_fail([program, *ARGUMENTS, *options.further, f"--benchmark_out={path}",
                     "--benchmark_out_format=json"], "bench_kernel")
        found = medians(path)
    # The further arguments may exclude kernels, or only list the benchmarks.
    comparable = {case: times for case, times in found.items()
                  if "double" in times and len(times) > 1}
    if comparable:
        print_gains(comparable)
