"""The sliding benchmark: what the key `friction` costs, and a peer at equal error."""

import json
import pathlib
import statistics
import subprocess
import tempfile

from building import add_build_argument, add_output_argument, build, fail, run_or_fail, write_results
from launching import add_program_argument, program
from matching import PER_DECADE, matched_tolerance

EXPLANATION = """\
Times planes of 128 x 128 points of a box of 0.6 m x 1.8 m with rk45 at 1e-9, and of 16 x 128 points
under a synthetic record, in turns: without the key friction, with the field friction_demand, and with
coefficients at which nothing slips, all that moves slides flat, or most of what rocks slips. Medians of
the time in the kernel, on one rank, over that of the field region alone. Weak pulses topple no block.

Then compares with an event-driven program that uses Boost.odeint: 221 boxes under a one-sine pulse of
0.5 s, PGA 0.3 to 2.5 g, fields region and slide, default numerics. For each coefficient, the peer has the
loosest tolerance whose error is within that of overturn, or within 1e-9 m: the 90th percentile over the
boxes that slip and stand, from a reference in long double. Installs missing dependencies, and builds in
build-bench."""

PULSE_PLANE = ("frequency = {{{{ first = 1.5, last = 11, count = {{count}} }}}}\n"
               "amplitude = {{{{ first = 1.2, last = {}, count = {{count}} }}}}")
PLANES = {
    "pulse": ('pulse = "one_sine"', PULSE_PLANE.format(9)),
    "weak pulse": ('pulse = "one_sine"', PULSE_PLANE.format(2)),  # which topples no block
    "record": ('record = "{jobs}/synthetic.AT2"', "size = {{ first = 0.5, last = 2, count = 16 }}\n"
               "scale = {{ first = 1, last = 3, count = {count} }}"),
}
CASES = {  # the coefficient, if any, and the fields
    "region": (None, ["region"]),
    "friction_demand": (None, ["region", "friction_demand"]),
    "nothing slips": (10, ["region"]),
    "slides flat": (0.2, ["region", "slide"]),
    "slides and rocks": (0.36, ["region", "slide"]),
}

FRICTIONS = (0.2, 0.4, 0.5)  # slides flat; slides and rocks
BOXES, TOLERANCE, SAMPLE_SECONDS = 221, 1e-9, 0.3
LARGE_ERROR = 1e-9  # [m]


def add_arguments(parser):
    parser.add_argument("--points", type=int, default=128, help="points of an axis (default: 128)")
    parser.add_argument("--rounds", type=int, default=7, help="runs of each case (default: 7)")
    add_output_argument(parser, "bench_sliding.json")
    add_program_argument(parser)
    add_build_argument(parser)


def job_of(scene, plane, friction, fields):
    lines = ["[scene]", scene, "[plane]", plane, "restitution_of_maximum = 1", "slenderness = 0.3217505543966422",
             *[f"friction = {friction}"] * (friction is not None), "[output]", f"fields = {json.dumps(fields)}"]
    return "\n".join(lines)


def seconds_of(overturn, job, folder):
    (folder / "job.toml").write_text(job)
    (folder / "r.h5").unlink(missing_ok=True)
    run_or_fail([overturn, "run", folder / "job.toml", "-o", folder / "r.h5"], "overturn run",
                stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return sum(rank["compute_seconds"] for rank in json.loads((folder / "r.h5.json").read_text())["ranks"])


class Solver:
    """overturn or the peer, at one coefficient of friction."""

    tightest = PER_DECADE * 15

    def __init__(self, path, name, friction):
        self.command = [path, name, friction, BOXES]

    def measure(self, tolerance, seconds=0):
        return json.loads(run_or_fail([*self.command, tolerance, seconds], "bench_sliding",
                                      stdout=subprocess.PIPE).stdout)

    def error(self, tolerance):
        return self.measure(tolerance)["p90"]


def timed_in_turns(ours, peer, tolerances, rounds):
    """The measurements of overturn, and of the peer at each tolerance, with the medians of the times."""
    runs = [(ours, TOLERANCE), *((peer, tolerance) for tolerance in tolerances)]
    samples = [[solver.measure(tolerance, SAMPLE_SECONDS) for solver, tolerance in runs] for _ in range(rounds)]
    return [{**of[0], "us_per_point": statistics.median(each["us_per_point"] for each in of)}
            for of in zip(*samples)]


def compare_with_peer(path, rounds):
    print(f"\n{'friction':>8}{'compared':>10}{'solver':>10}{'tolerance':>11}{'error [m]':>11}{'wrong':>7}"
          f"{'us/point':>10}{'ratio':>8}")
    results = []
    for friction in FRICTIONS:
        ours, peer = (Solver(path, name, friction) for name in ("overturn", "odeint"))
        errors = {}
        found = [matched_tolerance(peer, target, errors)[0] for target in (ours.error(TOLERANCE), LARGE_ERROR)]
        tolerances = [tolerance for tolerance in found if tolerance]
        timed = timed_in_turns(ours, peer, tolerances, rounds)
        for name, tolerance, row in zip(("overturn", "odeint", "odeint"), (TOLERANCE, *tolerances), timed):
            row |= {"friction": friction, "solver": name, "tolerance": tolerance,
                    "ratio_to_overturn": row["us_per_point"] / timed[0]["us_per_point"]}
            print(f"{friction:8}{row['compared']:10}{name:>10}{tolerance:11.1e}{row['p90']:11.1e}"
                  f"{row['wrong_verdicts']:7}{row['us_per_point']:10.2f}{row['ratio_to_overturn']:8.2f}")
        if None in found:
            print(f"{friction:8}: the peer does not reach the error of overturn")
        results += timed
    if any(row["wrong_verdicts"] for row in results if row["solver"] == "overturn"):
        fail("overturn must agree with the reference in all verdicts")
    return results


def run(options):
    overturn = program(options)
    jobs = pathlib.Path(__file__).resolve().parents[2] / "jobs"
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for motion, (scene, plane) in PLANES.items():
            times = {case: [] for case in CASES}
            for _ in range(options.rounds):
                for case, of in CASES.items():
                    job = job_of(scene.format(jobs=jobs), plane.format(count=options.points), *of)
                    times[case].append(seconds_of(overturn, job, pathlib.Path(folder)))
            medians = {case: statistics.median(values) for case, values in times.items()}
            results[motion] = {case: {"seconds": value, "over_region": value / medians["region"]}
                               for case, value in medians.items()}
            for case, of in results[motion].items():
                print(f"{motion:12}{case:18}{of['seconds'] * 1e3:10.1f} ms{of['over_region']:8.2f} x region")
    results["peer"] = compare_with_peer(build(options.build, "bench_sliding"), options.rounds)
    write_results(options.output, results)
