"""The effects benchmark: the cost of each field, theory and pulse of a scene, in instructions."""

import json
import pathlib
import re
import shutil
import subprocess
import tempfile

from building import add_build_argument, add_output_argument, build, fail, run_or_fail, write_results

METHODS = ("rk45", "taylor")
FIELDS = ("angle", "velocity", "margin", "error", "peak", "fall_time", "impacts", "steps",
          "friction_demand", "normal", "status")  # in addition to the region
CONTACT = "fields of contact and error"
KERNEL = "avx2"

EXPLANATION = """\
Counts the instructions for one tile of a spectrum with Valgrind: for the minimal scene, which only
requests the region, and the difference for each field, for the linear theory and for each other
pulse. Counts do not depend on the load of the machine: two runs give the same numbers. All counts
are for the kernel avx2, four points at a time, because Valgrind does not support AVX-512.
The points are those of the paper's block under a one-sine pulse, frequency 0.5 to 8 by amplitude
1.2 to 12. Installs missing dependencies and builds in build-bench."""


def add_arguments(parser):
    parser.add_argument("--points", type=int, default=64,
                        help="points of the frequency and of the amplitude axis (default: 64)")
    parser.add_argument("--tolerance", type=float, default=1e-9,
                        help="tolerance of the integration (default: 1e-9)")
    add_output_argument(parser, "bench_effects.json")
    add_build_argument(parser)


class Counter:
    """Counts the instructions of bench_effects under Valgrind, which starts once: the program forks for each call."""

    def __init__(self, program):
        valgrind = shutil.which("valgrind") or fail("valgrind not found; install it by "
                                                    "tools/install_dependencies bench")
        self.folder = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen(
            [valgrind, "--quiet", "--tool=callgrind", f"--callgrind-out-file={self.folder.name}/%p",
             "--toggle-collect=overturn::benchmarks::measured(*", program, "each"],
            text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.process.stdout.readline() or fail("bench_effects did not start; see its output above")

    def close(self):
        self.process.communicate()
        self.folder.cleanup()

    def measure(self, *words):
        """The output of bench_effects for one call, and the number of instructions of the sweep."""
        print(*words, file=self.process.stdin, flush=True)
        line, ended = self.process.stdout.readline(), self.process.stdout.readline()
        if not ended:
            fail(f"bench_effects {' '.join(map(str, words))} failed; see its output above")
        found = json.loads(line)
        counts = (pathlib.Path(self.folder.name) / str(found["process"])).read_text()
        instructions = re.search(r"^(?:summary|totals): (\d+)", counts, re.MULTILINE)
        if not instructions or not int(instructions.group(1)):
            fail("Valgrind counted no instructions of the sweep. Does the program have symbols?")
        return found | {"instructions": int(instructions.group(1))}


def other_pulses(program):
    names = run_or_fail([program, "pulses"], "listing the pulses", capture_output=True)
    return [name for name in names.stdout.split() if name != "one_sine"]


def scenes(program):
    """(difference from the minimal scene, pulse, theory, fields), the minimal scene first."""
    yield "", "one_sine", "nonlinear", ("region",)
    for field in FIELDS:
        yield f"field {field}", "one_sine", "nonlinear", ("region", field)
    yield CONTACT, "one_sine", "nonlinear", ("region", "error", "peak", "friction_demand", "normal")
    yield "all fields", "one_sine", "nonlinear", ("region", *FIELDS)
    yield "theory linear", "one_sine", "linear", ("region",)
    for pulse in other_pulses(program):
        yield f"pulse {pulse}", pulse, "nonlinear", ("region",)


def records(program, options):
    counter = Counter(program)
    rows = []
    for method in METHODS:
        minimal = None
        for adds, pulse, theory, fields in scenes(program):
            found = counter.measure("sweep", method, pulse, theory, KERNEL, options.points,
                                    f"{options.tolerance:.6e}", *fields)
            instructions = found["instructions"] / found["points"]
            minimal = instructions if minimal is None else minimal
            rows.append({"method": method, "pulse": pulse, "theory": theory,
                         "fields": list(fields), "adds": adds,
                         "instructions_per_point": instructions,
                         "price_per_point": instructions - minimal,
                         "bytes_per_point": found["bytes"] / found["points"]})
    counter.close()
    return rows, found["compiler"]


def print_table(rows, options):
    print(f"\ninstructions per point, {options.points} x {options.points} points, tolerance "
          f"{options.tolerance:g}, kernel {KERNEL}\n")
    print(f"{'':28}" + "".join(f"{method:>12}{'':>9}" for method in METHODS) + f"{'bytes':>9}")
    for adds in dict.fromkeys(row["adds"] for row in rows):
        mine = [row for row in rows if row["adds"] == adds]
        minimal = [row["instructions_per_point"] - row["price_per_point"] for row in mine]
        cells = "".join(
            f"{row['price_per_point']:>+12.1f}{100 * row['price_per_point'] / least:>+8.2f}%"
            if adds else f"{least:>12.1f}{'':>9}" for row, least in zip(mine, minimal))
        print(f"{adds or 'minimal scene: region':28}{cells}{mine[0]['bytes_per_point']:>9.1f}")
    for method in METHODS:
        counts = {row["adds"]: row["instructions_per_point"] for row in rows if row["method"] == method}
        print(f"{CONTACT}: {counts[CONTACT] / counts['field error']:.2f} times the instructions of region and error "
              f"with {method}")
    print("\nBytes: heap memory that the sweep allocates per point, including its end states. The "
          "other theory\nand the other pulses have different motions and numbers of steps.")


def run(options):
    if options.points < 2 or not 0 < options.tolerance < 1:
        fail("--points must be at least 2 and --tolerance between 0 and 1")
    rows, compiler = records(build(options.build, "bench_effects"), options)
    print_table(rows, options)
    write_results(options.output, {"benchmark": "effects", "kernel": KERNEL, "compiler": compiler,
                                   "points": options.points ** 2, "tolerance": options.tolerance, "records": rows})
