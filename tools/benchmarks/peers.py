"""The peer benchmark: compares overturn's kernels with alternative solvers on the same points, at
the same error relative to the same reference, in turns on one core."""

import importlib
import importlib.metadata
import importlib.util
import json
import math
import pathlib
import platform
import statistics
import typing

from building import SOURCE, add_build_argument, add_output_argument, build, fail, run_or_fail, write_results
from matching import PER_DECADE, matched_tolerance

PULSE = "pulse"
RECORD = SOURCE / "jobs" / "synthetic.AT2"
TIGHTEST = {"overturn": PER_DECADE * 14, "other": PER_DECADE * 17}
REFERENCE_TOLERANCE, CHECK_TOLERANCE = 1e-18, 1e-17
LARGEST_CHECK = 1e-2  # difference of the two references over the smallest target
VERDICT_TOLERANCE = 1e-13
SAMPLE_SECONDS = 0.05
NAME_WIDTH = 36  # the longest name and a gap

EXPLANATION = """\
Compares the kernels of overturn with Boost.odeint, GSL, SUNDIALS and SciPy, and with heyoka.py
(from PyPI) if the Python that runs this has it: the paper's block under a one-sine pulse, frequency
0.5 to 8 by amplitude 1.2 to 12. For each solver and target error, it finds the loosest tolerance
whose error is within the target (99th percentile, over the points that do not overturn, of the
larger of the errors of angle and velocity at the end of the pulse), then times all solvers in turns
and prints medians of processor time. Errors are differences in rad from a reference in long double
by a third-party method, which is checked by a second reference.

--record: blocks of slenderness 0.245, size 0.2 to 3 m, under a record with a scale of 0.5 to 2.5.
Errors are divided by the slenderness and taken at the points whose `error` at a tolerance of 1e-12
is below 1e-6. All solvers stop at every sample, continue with the step size from before it, and
skip the time at rest. Also prints the time per point and sample.

Installs missing dependencies, builds in build-bench, and takes a few minutes, with --record a
quarter of an hour. Do not run other programs at the same time."""

EXPLANATION_OF_ROWS = """\
-: the target cannot be reached, or there is no value.
odeint_dopri5 finds events on its dense output of order 4, _restepping by repeated steps to the
event. The peers use sine and cosine of the C library, _our_sines uses overturn's polynomials.
scipy_rk45: error and time on up to {side} x {side} points spread over the plane; all others on
every point. heyoka_taylor: the batch mode of heyoka.py, called from Python."""


def add_arguments(parser):
    parser.add_argument("--record", nargs="?", const=RECORD, type=pathlib.Path, metavar="FILE",
                        help="blocks under a record in g instead of a pulse (default of FILE: "
                        "jobs/synthetic.AT2)")
    parser.add_argument("--points", type=int,
                        help="points of each axis of the plane (default: 64; with --record 32)")
    parser.add_argument("--rounds", type=int, default=5,
                        help="samples for each solver and target (default: 5)")
    add_output_argument(parser, "bench_peers.json")
    add_build_argument(parser)


class Ground(typing.NamedTuple):
    """What depends on the ground motion."""

    name: str  # as in the commands of the measuring program
    targets: tuple  # of the 99th percentile of the error [rad; under a record, slenderness]
    points: int  # of each axis
    scipy_side: int  # SciPy runs on this number of points of each axis, spread over the plane


def ground_of(options):
    if options.record:
        # Round-off under the record exceeds 1e-10.
        return Ground(str(options.record.resolve()), (1e-6, 1e-8, 1e-9), options.points or 32, 3)
    return Ground(PULSE, (1e-6, 1e-9, 1e-12), options.points or 64, 8)


class Program:
    """The measuring program with the plane and the reference that it uses."""

    def __init__(self, path, ground):
        self.path = path
        self.ground = ground
        self.plane = ground.name, ground.points
        kind = PULSE if ground.name == PULSE else "record"
        self.reference_file = path.parent / f"reference_{kind}_{ground.points}.txt"

    def ask(self, *words):
        return json.loads(run_or_fail([self.path, *words], "the measuring program",
                                      capture_output=True).stdout)

    def make_reference(self):
        return self.ask("reference", *self.plane, REFERENCE_TOLERANCE, CHECK_TOLERANCE,
                        self.reference_file)

    def measure(self, solver, tolerance, seconds=0.0):
        return self.ask("measure", *self.plane, self.reference_file, solver, f"{tolerance:.6e}",
                        seconds)


class ProgramSolver:
    """One of the solvers of the measuring program."""

    def __init__(self, program, name):
        self.program, self.name = program, name
        self.tightest = TIGHTEST["overturn" if name.startswith("overturn") else "other"]

    def error(self, tolerance):
        found = self.program.measure(self.name, tolerance)["p99"]
        return math.inf if found is None else found

    def microseconds(self, tolerance):
        return self.program.measure(self.name, tolerance, SAMPLE_SECONDS)["us_per_point"]


class PythonSolver:
    """A module on a subset of the points, for both time and error."""

    tightest = TIGHTEST["other"]

    def __init__(self, name, program, samples, error_unit, side):
        self.name = name
        self.measure = importlib.import_module(name).measure
        self.samples, self.error_unit = samples, error_unit
        lines = program.reference_file.read_text().splitlines()[1:]
        rows = [[float(word) for word in line.split()] for line in lines]
        points = program.ground.points
        side = min(side, points)
        spread = [(2 * i + 1) * points // (2 * side) for i in range(side)]
        chosen = [rows[i * points + j] for i in spread for j in spread]
        self.points = [row[:4] for row in chosen]
        self.reference = [row[4:] for row in chosen]

    def run(self, tolerance):
        return self.measure(self.points, self.reference, self.samples, self.error_unit, tolerance)

    def error(self, tolerance):
        return self.run(tolerance)[0]

    def microseconds(self, tolerance):
        return self.run(tolerance)[1]


def check_reference(program):
    """Computes the reference; ends the benchmark if it is not accurate enough."""
    found = program.make_reference()
    print(f"reference: {found['points']} points, {found['compared_points']} compared, "
          f"{found['safe_points']} of them safe; difference from a second reference: p99 "
          f"{found['p99_difference']:.1e}, largest {found['largest_difference']:.1e}", flush=True)
    allowed = LARGEST_CHECK * min(program.ground.targets)
    if not found["p99_difference"] < allowed or found["verdicts_that_differ"]:
        fail(f"the two references differ by more than {allowed:g} or in "
             f"{found['verdicts_that_differ']} verdicts; neither can be used")
    return found


def check_verdicts(program, solvers):
    for name in solvers:
        if name.startswith("overturn"):
            differ = program.measure(name, VERDICT_TOLERANCE)["verdicts_that_differ"]
            print(f"verdicts of {name} that differ from the reference: {differ}", flush=True)
            if differ:
                fail(f"{name} must agree with the reference in all verdicts at the tolerance "
                     f"{VERDICT_TOLERANCE:g}")


def machine(about):
    import numpy
    import scipy
    heyoka = {"heyoka": importlib.metadata.version("heyoka")} if importlib.util.find_spec("heyoka") else {}
    model = next((line.split(":", 1)[1].strip()
                  for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), platform.processor())
    return {"cpu": model, "kernel": about["kernel"], "compiler": about["compiler"],
            "libraries": {"boost": about["boost"], "gsl": about["gsl"],
                          "sundials": about["sundials"], "scipy": scipy.__version__,
                          "numpy": numpy.__version__, "python": platform.python_version(), **heyoka}}


def find_tolerances(solvers, targets):
    """(solver, target) -> (tolerance, achieved error)."""
    matched = {}
    for solver in solvers:
        errors = {}
        for target in targets:
            tolerance, achieved = matched_tolerance(solver, target, errors)
            matched[solver.name, target] = tolerance, achieved
            print(f"  {solver.name:{NAME_WIDTH}} {target:.0e}: "
                  + (f"tolerance {tolerance:.2e}, error {achieved:.2e}" if tolerance
                     else "target cannot be reached"), flush=True)
    return matched


def time_in_turns(program, solvers, matched, rounds):
    """(solver, target) -> median of microseconds per point, None if the target cannot be reached."""
    samples = {key: [] for key, (tolerance, _) in matched.items() if tolerance}
    for number in range(rounds):
        print(f"  round {number + 1} of {rounds}", flush=True)
        for target in program.ground.targets:
            for solver in solvers:
                if (solver.name, target) in samples:
                    tolerance = matched[solver.name, target][0]
                    samples[solver.name, target].append(solver.microseconds(tolerance))
    return {key: statistics.median(samples[key]) if key in samples else None for key in matched}


def records(matched, medians, samples):
    def per_sample(key):
        return 1e3 * medians[key] / samples if samples and medians[key] else None

    def ratio(name, other, target):
        mine, theirs = medians[name, target], medians.get((other, target))
        return mine / theirs if mine and theirs else None

    return [{"solver": name, "target_error": target, "achieved_p99": matched[name, target][1],
             "us_per_point": medians[name, target],
             "ns_per_point_and_sample": per_sample((name, target)),
             "ratio_to_overturn_rk45": ratio(name, "overturn_rk45", target),
             "ratio_to_overturn_taylor": ratio(name, "overturn_taylor", target)}
            for name, target in matched]


def print_table(rows, ground):
    def cell(value, form):
        return format(value, form) if value is not None else "-"

    names = dict.fromkeys(row["solver"] for row in rows)
    methods = [name.removeprefix("overturn_") for name in names if name.startswith("overturn_")]
    width = 12 + 9 * len(methods)
    print("\n" + " " * NAME_WIDTH
          + "".join(f"{f'error {target:.0e}':>{width}}" for target in ground.targets))
    print(f"{'solver':{NAME_WIDTH}}"
          + (f"{'us/point':>12}" + "".join(f"{'/' + method:>9}" for method in methods))
          * len(ground.targets))
    for name in names:
        mine = [row for row in rows if row["solver"] == name]
        print(f"{name:{NAME_WIDTH}}" + "".join(
            f"{cell(row['us_per_point'], '.3f'):>12}"
            + "".join(f"{cell(row[f'ratio_to_overturn_{method}'], '.2f'):>9}" for method in methods)
            for row in mine))
    print(EXPLANATION_OF_ROWS.format(side=ground.scipy_side))


def print_variants(rows):
    times = {(row["solver"], row["target_error"]): row["us_per_point"] for row in rows}
    for suffix in ("_our_sines", "_restepping"):
        for name in dict.fromkeys(name for name, _ in times if name.endswith(suffix)):
            of = name.removesuffix(suffix)
            gains = [f"{times[of, target] / time:.2f}" for (solver, target), time in times.items()
                     if solver == name and time and times.get((of, target))]
            print(f"{name} is {', '.join(gains) or '-'} times as fast as {of}")


def print_times_per_sample(rows, samples, reference):
    steps = reference["steps_of_overturn"] / samples
    print(f"\n{samples} samples; overturn takes {steps:.2f} steps per point and sample, and skips the "
          "time at rest. Time per point and sample:")
    for row in rows:
        if row["solver"].startswith("overturn_") and row["ns_per_point_and_sample"]:
            print(f"  {row['solver']}: {row['ns_per_point_and_sample']:.1f} ns, 99th percentile of "
                  f"the error {row['achieved_p99']:.1e} of the slenderness")


def run(options):
    ground = ground_of(options)
    if ground.points < 2 or options.rounds < 1:
        fail("--points must be at least 2 and --rounds at least 1")
    if not options.output.resolve().parent.is_dir():
        fail(f"{options.output}: there is no folder {options.output.resolve().parent}")
    import scipy_rk45  # noqa: F401: if SciPy is missing, fail before anything is built
    program = Program(build(options.build, "bench_peers"), ground)
    about = program.ask("about", ground.name)
    samples = about["samples"]
    reference = check_reference(program)
    check_verdicts(program, about["solvers"])
    solvers = [ProgramSolver(program, name) for name in about["solvers"]]
    solvers.append(PythonSolver("scipy_rk45", program, samples, reference["error_unit"], ground.scipy_side))
    if not samples and importlib.util.find_spec("heyoka"):
        solvers.append(PythonSolver("heyoka_taylor", program, samples, reference["error_unit"], ground.points))
    print("tolerances for the target errors:", flush=True)
    matched = find_tolerances(solvers, ground.targets)
    print("times:", flush=True)
    medians = time_in_turns(program, solvers, matched, options.rounds)
    rows = records(matched, medians, len(samples))
    print_table(rows, ground)
    print_variants(rows)
    if samples:
        print_times_per_sample(rows, len(samples), reference)
    write_results(options.output, {"benchmark": "peers", "ground": ground.name, "samples": len(samples),
                                   "machine": machine(about), "reference": reference, "rounds": options.rounds,
                                   "records": rows})
