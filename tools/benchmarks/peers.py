"""The peer benchmark: overturn's kernels against what one would use instead, on the same points, at
the same error against the same reference, in turns on one core."""

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
LARGEST_CHECK = 1e-14  # between the two references: nothing beside the smallest target
VERDICT_TOLERANCE = 1e-13
SAMPLE_SECONDS = 0.05
NAME_WIDTH = 36  # of the longest name, and a gap
SCIPY_SIDE = 8  # SciPy runs on 8 x 8 points spread over the plane

EXPLANATION = """\
Compares the kernels of overturn with Boost.odeint, GSL, SUNDIALS and SciPy: a block of the paper
under a one-sine pulse, frequency 0.5 to 8 times amplitude 1.2 to 12. For each solver and target
error it finds the loosest tolerance whose error is within the target (99th percentile, over the
points that do not overturn, of the largest error of angle and velocity at the end of the pulse),
then times all solvers in turns and gives medians of processor time. Errors are against a reference
in long double, by a method of others, which a second reference checks. Of overturn's methods it
tells what share of the core's fused multiply-adds they reach.
Installs what is missing, builds in build-bench, and takes some minutes; let nothing else run."""

EXPLANATION_OF_ROWS = f"""\
-: out of reach, or there is no such method.
odeint_dopri5 finds events on its dense output, of order 4; _restepping by steps again to where the
event should be. The peers take sine and cosine of the C library, _our_sines overturn's polynomials.
scipy_rk45: error and time on up to {SCIPY_SIDE} x {SCIPY_SIDE} points spread over the plane; all others on every point."""


def add_arguments(parser):
    parser.add_argument("--points", type=int, default=64,
                        help="of the frequency and of the amplitude axis (default: 64)")
    parser.add_argument("--rounds", type=int, default=5,
                        help="samples of each solver and target (default: 5)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("bench_peers.json"),
                        help="where the numbers go (default: bench_peers.json)")
    add_build_argument(parser)


class Program:
    """The measuring program, and the plane and the reference that it works on."""

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
    """One of the solvers inside the measuring program."""

    def __init__(self, program, name):
        self.program, self.name = program, name
        self.tightest = TIGHTEST["overturn" if name.startswith("overturn") else "other"]

    def error(self, tolerance):
        found = self.program.measure(self.name, tolerance)["p99"]
        return math.inf if found is None else found

    def microseconds(self, tolerance):
        return self.program.measure(self.name, tolerance, SAMPLE_SECONDS)["us_per_point"]


class ScipySolver:
    """SciPy on a part of the points, on which its error is measured, too."""

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
    """Makes the reference and ends the benchmark if it is none."""
    found = program.make_reference()
    print(f"reference: {found['points']} points, {found['safe_points']} of them safe; against a "
          f"second one p99 of the difference {found['p99_difference']:.1e}, "
          f"largest {found['largest_difference']:.1e}", flush=True)
    if not found["p99_difference"] < LARGEST_CHECK or found["verdicts_that_differ"]:
        fail(f"the two references differ by more than {LARGEST_CHECK:g} or in "
             f"{found['verdicts_that_differ']} verdicts; neither is one")
    return found


def check_verdicts(program, solvers):
    for name in solvers:
        if name.startswith("overturn"):
            differ = program.measure(name, VERDICT_TOLERANCE)["verdicts_that_differ"]
            print(f"verdicts of {name} that differ from the reference's: {differ}", flush=True)
            if differ:
                fail(f"{name} at tolerance {VERDICT_TOLERANCE:g} must agree in all verdicts")


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
                     else "out of reach"), flush=True)
    return matched


def time_in_turns(program, solvers, matched, rounds):
    """(solver, target) -> median of microseconds per point; None where the target is out of
    reach. And the core's best rate of fused multiply-adds meanwhile."""
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
                fail(f"counting the operations of {method} gave other ends than the kernel's")
            counts[name, target] = found
    return counts


def shares_of_peak(count, microseconds, peak):
    """Of what the core could do meanwhile: of its floating-point operations, and of its slots for
    fused multiply-adds, which a lone addition or multiplication takes as well."""
    slots = count["fused"] + count["plain"]
    operations = 2 * count["fused"] + count["plain"] + count["divided"]
    could = peak * microseconds / 1e6
    return operations / (2 * could), slots / could


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
          f"({about['lanes']} lanes, kernel {about['kernel']}).\nOf its floating-point operations, "
          "two to each, and of its slots for them, the kernels use:")
    for name in dict.fromkeys(row["solver"] for row in rows if row["share_of_fma_peak"]):
        print(f"  {name}: " + ", ".join(
            f"{row['share_of_fma_peak']:.0%} and {row['fma_units_share']:.0%} at "
            f"{row['target_error']:.0e}" for row in rows
            if row["solver"] == name and row["share_of_fma_peak"]))
    print("Counted are the points' own operations; lanes that wait for their neighbours do none.")


def run(options):
    if options.points < 2 or options.rounds < 1:
        fail("--points must be at least 2 and --rounds at least 1")
    if not options.output.resolve().parent.is_dir():
        fail(f"{options.output}: there is no folder {options.output.resolve().parent}")
    import scipy_rk45  # noqa: F401: if SciPy is missing, that is said before anything is built
    program = Program(build(options.build, "bench_peers"), options.points)
    about = program.ask("about")
    reference = check_reference(program)
    check_verdicts(program, about["solvers"])
    solvers = [ProgramSolver(program, name) for name in about["solvers"]]
    solvers.append(ScipySolver(program.reference_file, options.points))
    print("tolerances that match the errors:", flush=True)
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
