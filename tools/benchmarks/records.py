"""The records benchmark: what resolved verdicts under a record cost, and a large list of blocks under many records."""

import math
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time
import warnings

from building import SOURCE
from launching import RECORD_AXES, RECORD_JOB, add_program_argument, launcher, measured_run, program

EXPLANATION = """\
Runs the plane of jobs/synthetic.toml with 32 x 32 points under each record, with and without
resolving verdicts, in turns, and prints the times in the kernel. With --uncertain, blocks of four sizes at 256
scales: the shares of those whose error has no bound, and of those that stay undecided. With --museum, one job of
100,000 blocks under 50 synthetic records of 8001 samples on several ranks, from start to exit; it takes a few
minutes. Do not run other programs at the same time."""

SIDE = 32  # points of each axis
BLOCKS, RECORDS, DURATION = 100_000, 50, 80.0  # duration [s], of 0.01 s steps


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--record", nargs="+", type=pathlib.Path, metavar="FILE", default=[],
                        help="records to use instead of the synthetic one")
    parser.add_argument("--components", nargs="+", type=int, metavar="N", default=[],
                        help="components of the records, of files that have several")
    parser.add_argument("--repeat", type=int, default=5, help="runs of each case (default: 5)")
    parser.add_argument("--uncertain", action="store_true", help="uncertain verdicts")
    parser.add_argument("--museum", action="store_true", help="100,000 blocks under 50 records")
    parser.add_argument("--ranks", type=int, default=2, help="ranks for --museum (default: 2)")


def kernel_seconds(overturn, settings):
    _, sidecar = measured_run(overturn, SIDE, ['output.fields=["region"]', *settings], (), RECORD_JOB, RECORD_AXES)
    return sum(rank["compute_seconds"] for rank in sidecar["ranks"])


def motions(options):
    """The name of each motion, and its keys of [scene]."""
    for path in options.record or [RECORD_JOB.with_suffix(".AT2")]:
        for number in options.components or [None]:
            yield (f"{path.name}{f', component {number}' if number else ''}",
                   {"record": str(path.resolve())} | ({"component": number} if number else {}))


def compare_resolved(overturn, options):
    for name, scene in motions(options):
        settings = [f"scene.{key}={value!r}" for key, value in scene.items()]
        plain, resolved = [], []
        for _ in range(options.repeat):
            plain.append(kernel_seconds(overturn, [*settings, "numerics.resolve=false"]))
            resolved.append(kernel_seconds(overturn, [*settings, "numerics.resolve=true"]))
        one, other = statistics.median(plain), statistics.median(resolved)
        print(f"{name}: {1e3 * one:.1f} ms, resolved {1e3 * other:.1f} ms, "
              f"{other / one:.1f} times; {1e6 * one / SIDE**2:.1f} us per point", flush=True)


def print_uncertain(options):
    import h5netcdf  # noqa: F401: before anything is timed
    import overturn
    import xarray  # noqa: F401
    warnings.simplefilter("ignore")  # of r = 1, above r_max
    for name, scene in motions(options):
        for restitution, value in (("restitution_of_maximum", 0.8), ("restitution_of_maximum", 0.9),
                                   ("restitution_of_maximum", 1), ("restitution", 1)):
            job = {"scene": scene, "output": {"fields": ["region", "error"]},
                   "plane": {"aspect_ratio": 4, "size": {"values": [0.5, 1, 2, 4]}, restitution: value,
                             "scale": {"first": 0.2, "last": 2, "count": 256}}}
            begin = time.perf_counter()
            unbounded = overturn.run(job).error == math.inf
            middle = time.perf_counter()
            undecided = overturn.run(job, overrides={"numerics.resolve": True}).region == 254
            end = time.perf_counter()
            shares = [", ".join(f"{100 * share:.1f}" for share in each.mean("scale").values.flat)
                      for each in (unbounded, undecided)]
            print(f"{name}, {restitution} {value}: no bound {shares[0]} %, undecided {shares[1]} %; "
                  f"{middle - begin:.1f} s, resolved {end - middle:.1f} s", flush=True)


def write_museum(folder):
    """A job of statues and vases whose height is log-normal, one to eight times their width."""
    for seed in range(1, RECORDS + 1):
        subprocess.run([sys.executable, SOURCE / "tools" / "synthetic_record", "--seed", str(seed), "--duration",
                        str(DURATION), "-o", folder / f"{seed:02}.AT2"], check=True, stdout=subprocess.DEVNULL)
    choose = random.Random(1)
    with (folder / "museum.csv").open("w") as table:
        print("width,height,restitution_of_maximum", file=table)
        for _ in range(BLOCKS):
            height = choose.lognormvariate(0, 0.5)  # [m]
            print(f"{height / choose.uniform(1, 8):.4f},{height:.4f},{choose.uniform(0.8, 1):.3f}", file=table)
    job = folder / "museum.toml"
    job.write_text('scene.record = "*.AT2"\nplane.scale = 1\nblocks.table = "museum.csv"\noutput.fields = ["region"]\n')
    return job


def run(options):
    overturn = program(options)
    if options.uncertain:
        print_uncertain(options)
        return
    if not options.museum:
        compare_resolved(overturn, options)
        return
    with tempfile.TemporaryDirectory() as folder:
        job = write_museum(pathlib.Path(folder))
        wall, sidecar = measured_run(overturn, 0, [], launcher(options.ranks), job, ())
    points, samples = BLOCKS * RECORDS, round(DURATION / 0.01) + 1
    busy = sum(rank["compute_seconds"] for rank in sidecar["ranks"])
    print(f"{BLOCKS} blocks under {RECORDS} records of {samples} samples on {options.ranks} ranks: {wall:.0f} s, "
          f"{1e9 * busy / points / samples:.1f} ns of one core per point and sample")
