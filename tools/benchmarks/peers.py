"""The peer benchmark: compares overturn's kernels with alternative solvers on the same points, at
the same error relative to the same reference, in turns on one core."""

import json
import math
import pathlib
import platform
import statistics

from building import add_build_argument, build, fail, run_or_fail
from matching import PER_DECADE, matched_tolerance

TARGETS = (1e-6, 1e-9, 1e-12)  # of the 99th percentile of the error [rad]
TIGHTEST = {"overturn": PER_DECADE * 14, "other": PER_DECADE * 15}
REFERENCE_TOLERANCE, CHECK_TOLERANCE = 1e-18, 1e-16
LARGEST_CHECK = 1e-14  # difference of the two references: negligible for the smallest target
VERDICT_TOLERANCE = 1e-13
SAMPLE_SECONDS = 0.05
NAME_WIDTH = 36  # the longest name and a gap
SCIPY_SIDE = 8  # SciPy runs on 8 x 8 points spread over the plane

EXPLANATION = """\
Compares the kernels of overturn with Boost.odeint, GSL, SUNDIALS and SciPy: the paper's block under
a one-sine pulse, frequency 0.5 to 8 by amplitude 1.2 to 12. For each solver and target error, it
finds the loosest tolerance whose error is within the target (99th percentile, over the points that
do not overturn, of the larger of the errors of angle and velocity at the end of the pulse), then
times all solvers in turns and prints medians of processor time. Errors are relative to a reference
in long double by a third-party method, which is checked by a second reference. For overturn's
methods, it prints the share of the core's peak of fused multiply-adds.
Installs missing dependencies, builds in build-bench, and takes a few minutes. Do not run other
programs at the same time."""

EXPLANATION_OF_ROWS = f"""\
-: the target cannot be reached, or there is no value.
odeint_dopri5 finds events on its dense output of order 4, _restepping by repeated steps to the
event. The peers use sine and cosine of the C library, _our_sines uses overturn's polynomials.
scipy_rk45: error and time on up to {SCIPY_SIDE} x {SCIPY_SIDE} points spread over the plane; all others on every point."""


def add_arguments(parser):
    parser.add_argument("--points", type=int, default=64,
                        help="points of the frequency and of the amplitude axis (default: 64)")
    parser.add_argument("--rounds", type=int, default=5,
                        help="samples for each solver and target (default: 5)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("bench_peers.json"),
                        help="JSON file for the results (default: bench_peers.json)")
    add_build_argument(parser)


class Program:
    """The measuring program with the plane and the reference that it uses."""

    def __init__(self, path, points):
        self.path = path
        self.points = points
        self.reference_file = path.parent / f"reference_{points}.txt"

    def ask(self, *words):
        return json.loads(run_or_fail([self.path, *words], "the measuring program",
                                      capture_output=True).stdout)

    def make_reference(self):
        return self.ask("reference", self.points, REFERENCE_TOLERANCE, CHECK_TOLERANCE,
                        self.reference_file)

    def measure(self, solver, tolerance, seconds=0.0):
        return self.ask("measure", self.points, self.reference_file, solver, f"{tolerance:.6e}",
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


class ScipySolver:
    """SciPy on a subset of the points, for both time and error."""

    name = "scipy_rk45"
    tightest = TIGHTEST["other"]

    def __init__(self, reference_file, points):
        import scipy_rk45
        self.run = scipy_rk45.measure
        lines = reference_file.read_text().splitlines()[1:]
        rows = [[float(word) for word in line.split()] for line in lines]
        side = min(SCIPY_SIDE, points)
        spread = [(2 * i + 1) * points // (2 * side) for i in range(side)]
        chosen = [rows[i * points + j] for i in spread for j in spread]
        self.points = [row[:4] for row in chosen]
        self.reference = [row[4:] for row in chosen]

    def error(self, tolerance):
        return self.run(self.points, self.reference, tolerance)[0]

    def microseconds(self, tolerance):
        return self.run(self.points, self.reference, tolerance)[1]


def check_reference(program):
    """Computes the reference; ends the benchmark if it is not accurate enough."""
    found = program.make_reference()
    print(f"reference: {found['points']} points, {found['safe_points']} of them safe; difference "
          f"from a second reference: p99 {found['p99_difference']:.1e}, "
          f"largest {found['largest_difference']:.1e}", flush=True)
    if not found["p99_difference"] < LARGEST_CHECK or found["verdicts_that_differ"]:
        fail(f"the two references differ by more than {LARGEST_CHECK:g} or in "
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
    model = next((line.split(":", 1)[1].strip()
                  for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), platform.processor())
    return {"cpu": model, "kernel": about["kernel"], "lanes": about["lanes"],
            "compiler": about["compiler"],
            "libraries": {"boost": about["boost"], "gsl": about["gsl"],
                          "sundials": about["sundials"], "scipy": scipy.__version__,
                          "numpy": numpy.__version__, "python": platform.python_version()}}


def find_tolerances(solvers):
    """(solver, target) -> (tolerance, achieved error)."""
    matched = {}
    for solver in solvers:
        errors = {}
        for target in TARGETS:
            tolerance, achieved = matched_tolerance(solver, target, errors)
            matched[solver.name, target] = tolerance, achieved
            print(f"  {solver.name:{NAME_WIDTH}} {target:.0e}: "
                  + (f"tolerance {tolerance:.2e}, error {achieved:.2e}" if tolerance
                     else "target cannot be reached"), flush=True)
    return matched


def time_in_turns(program, solvers, matched, rounds):
    """(solver, target) -> median of microseconds per point, None if the target cannot be reached;
    and the best rate of fused multiply-adds of the core during the measurement."""
    samples = {key: [] for key, (tolerance, _) in matched.items() if tolerance}
    peak = 0.0
    for number in range(rounds):
        print(f"  round {number + 1} of {rounds}", flush=True)
        peak = max(peak, program.ask("fma-peak")["fma_peak_per_second"])
        for target in TARGETS:
            for solver in solvers:
                if (solver.name, target) in samples:
                    tolerance = matched[solver.name, target][0]
                    samples[solver.name, target].append(solver.microseconds(tolerance))
    return {key: statistics.median(samples[key]) if key in samples else None
            for key in matched}, peak


def count_operations(program, matched):
    """(solver, target) -> operations per point, for overturn's methods."""
    counts = {}
    for (name, target), (tolerance, _) in matched.items():
        if name.startswith("overturn_") and tolerance:
            method = name.removeprefix("overturn_")
            found = program.ask("operations", program.points, method, f"{tolerance:.6e}")
            if found.pop("ends_that_differ"):
                fail(f"with counted operations, {method} does not give the ends of the kernel")
            counts[name, target] = found
    return counts


def shares_of_peak(count, microseconds, peak):
    """The shares of the peak of the core in the same time: of its floating-point operations, and of
    its slots for fused multiply-adds, which single additions and multiplications also use."""
    slots = count["fused"] + count["plain"]
    operations = 2 * count["fused"] + count["plain"] + count["divided"]
    possible = peak * microseconds / 1e6
    return operations / (2 * possible), slots / possible


def records(matched, medians, counts, peak):
    def ratio(name, other, target):
        mine, theirs = medians[name, target], medians.get((other, target))
        return mine / theirs if mine and theirs else None

    def shares(key):
        return shares_of_peak(counts[key], medians[key], peak) if key in counts else (None, None)

    return [{"solver": name, "target_error": target, "achieved_p99": matched[name, target][1],
             "us_per_point": medians[name, target],
             "ratio_to_overturn_rk45": ratio(name, "overturn_rk45", target),
             "ratio_to_overturn_taylor": ratio(name, "overturn_taylor", target),
             "share_of_fma_peak": shares((name, target))[0],
             "fma_units_share": shares((name, target))[1]}
            for name, target in matched]


def print_table(rows):
    def cell(value, form):
        return format(value, form) if value is not None else "-"

    print("\n" + " " * NAME_WIDTH + "".join(f"{f'error {target:.0e}':>30}" for target in TARGETS))
    print(f"{'solver':{NAME_WIDTH}}" + f"{'us/point':>12}{'/rk45':>9}{'/taylor':>9}" * len(TARGETS))
    for name in dict.fromkeys(row["solver"] for row in rows):
        mine = [row for row in rows if row["solver"] == name]
        print(f"{name:{NAME_WIDTH}}" + "".join(f"{cell(row['us_per_point'], '.3f'):>12}"
                                               f"{cell(row['ratio_to_overturn_rk45'], '.2f'):>9}"
                                               f"{cell(row['ratio_to_overturn_taylor'], '.2f'):>9}"
                                               for row in mine))
    print(EXPLANATION_OF_ROWS)


def print_shares(rows, peak, about):
    print(f"\nThe core's peak: {peak / 1e9:.1f}e9 fused multiply-adds per second "
          f"({about['lanes']} lanes, kernel {about['kernel']}).\nShare of its floating-point "
          "operations (two per multiply-add) and of its multiply-add slots used by the kernels:")
    for name in dict.fromkeys(row["solver"] for row in rows if row["share_of_fma_peak"]):
        print(f"  {name}: " + ", ".join(
            f"{row['share_of_fma_peak']:.0%} and {row['fma_units_share']:.0%} at "
            f"{row['target_error']:.0e}" for row in rows
            if row["solver"] == name and row["share_of_fma_peak"]))
    print("Only the operations of the points are counted, not those of lanes that wait for others.")


def run(options):
    if options.points < 2 or options.rounds < 1:
        fail("--points must be at least 2 and --rounds at least 1")
    if not options.output.resolve().parent.is_dir():
        fail(f"{options.output}: there is no folder {options.output.resolve().parent}")
    import scipy_rk45  # noqa: F401: if SciPy is missing, fail before anything is built
    program = Program(build(options.build, "bench_peers"), options.points)
    about = program.ask("about")
    reference = check_reference(program)
    check_verdicts(program, about["solvers"])
    solvers = [ProgramSolver(program, name) for name in about["solvers"]]
    solvers.append(ScipySolver(program.reference_file, options.points))
    print("tolerances for the target errors:", flush=True)
    matched = find_tolerances(solvers)
    print("times:", flush=True)
    medians, peak = time_in_turns(program, solvers, matched, options.rounds)
    counts = count_operations(program, matched)
    rows = records(matched, medians, counts, peak)
    print_table(rows)
    print_shares(rows, peak, about)
    options.output.write_text(json.dumps(
        {"benchmark": "peers", "machine": machine(about), "fma_peak_per_second": peak,
         "operations_per_point": [{"solver": name, "target_error": target, **count}
                                  for (name, target), count in counts.items()],
         "reference": reference, "rounds": options.rounds, "records": rows}, indent=2) + "\n")
    print(f"written: {options.output}")
