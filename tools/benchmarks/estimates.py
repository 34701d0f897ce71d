"""The estimates benchmark: what overturn check and a run say of time and memory, against what they take."""

import json
import os
import pathlib
import pty
import re
import select
import statistics
import subprocess
import tempfile
import time

from building import SOURCE, add_output_argument, fail, write_results
from launching import add_program_argument, launcher, program

from overturn.installation import mpi_environment

EXPLANATION = """\
Estimates the time and the memory of jobs of every kind by overturn check, then runs them, on one rank and on two.
Prints the estimated and the measured time, from the start of the command to its exit, and the processor time of a
rank, which is shorter if other programs run; by which factor the time left was wrong at worst that a run printed
while 5 % to 90 % of its points were done; then the estimated and the measured memory of the largest rank. Takes
about five minutes. Do not run other programs meanwhile."""

PULSE, RECORD, SLIDING, LIST = (SOURCE / "jobs" / f"{name}.toml" for name in
                                ("figure_07a", "synthetic", "sliding", "statues"))


def counts(*axes):
    return [f"plane.{axis}.count={count}" for axis, count in axes]


def plane(side):
    return counts(("frequency", side), ("amplitude", side))


def record(sizes, scales):
    return ["numerics.resolve=false", *counts(("size", sizes), ("scale", scales))]


TAYLOR, RESOLVED, FILLED = 'numerics.method="taylor"', "numerics.resolve=true", "numerics.fill=true"
REGION = 'output.fields=["region"]'
CASES = {  # the command, the job, and settings
    "pulse, rk45": ("run", PULSE, plane(3072)),
    "pulse, taylor": ("run", PULSE, [TAYLOR, *plane(4096)]),
    "pulse, six fields": ("run", PULSE, ['output.fields=["region", "margin", "error", "peak", "fall_time", "normal"]',
                                         *plane(1024)]),
    "list under pulses": ("run", LIST, counts(("pulse_period", 640), ("pga", 840))),
    "filled": ("run", PULSE, [REGION, FILLED, *plane(16384)]),
    "resolved": ("run", PULSE, [REGION, RESOLVED, *plane(2048)]),
    "boundary": ("boundary", PULSE, [*counts(("frequency", 480), ("amplitude", 200))]),
    "record": ("run", RECORD, record(640, 640)),
    "record, resolved": ("run", RECORD, [RESOLVED, *counts(("size", 320), ("scale", 320))]),
    "boundary under a record": ("boundary", RECORD, counts(("size", 80))),
    "sliding": ("run", SLIDING, counts(("pulse_period", 400), ("pga", 400))),
    "sliding under a record": ("run", RECORD, ["plane.friction=0.4", *record(112, 112)]),
}


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--only", nargs="+", metavar="CASE", choices=CASES, default=CASES,
                        help="some of: " + "; ".join(CASES))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2], help="numbers of ranks (default: 1 2)")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each case (default: 3)")
    add_output_argument(parser, "bench_estimates.json")


def estimate(overturn, case, ranks, folder):
    command, job, settings = case
    answer = subprocess.run([overturn, "check", job, "--ranks", str(ranks), "--json", "-o", folder / "bench.h5",
                             *["--boundary"] * (command == "boundary"),
                             *(word for setting in settings for word in ("--set", setting))],
                            stdout=subprocess.PIPE, text=True)
    return json.loads(answer.stdout) if answer.returncode == 0 else fail(f"overturn check {job} failed")


SECONDS = {"ms": 0.001, "s": 1, "min": 60, "h": 3600, "d": 86400}
PROGRESS = re.compile(r"(\d+) %(?:, [^,]*/s)?, ((?:[\d.]+ (?:ms|s|min|h|d) )+)left")


def seconds_in(text):
    words = text.split()
    return sum(float(number) * SECONDS[unit] for number, unit in zip(words[::2], words[1::2]))


def worst_factor(seconds, printed):
    """By which factor the time left was wrong at worst, from 5 % to 90 %; None if nothing was printed."""
    factors = [left / (seconds - at) for at, percent, left in printed if 5 <= percent < 90 and seconds > at]
    return max((max(factor, 1 / factor) for factor in factors if factor > 0), default=None)


def measured(overturn, case, ranks, folder):
    """Returns the seconds of a run, those of processors, the memory of the largest process [bytes], and what it
    printed of its progress: the times, the percentages and the seconds left."""
    command, job, settings = case
    (folder / "bench.h5").unlink(missing_ok=True)
    words = [*(launcher(ranks) if ranks > 1 else []), overturn, command, job, "-o", "bench.h5",
             *(word for setting in settings for word in ("--set", setting))]
    terminal, end = pty.openpty()
    begin = time.perf_counter()
    run = subprocess.Popen(words, cwd=folder, env=mpi_environment(), stdout=subprocess.DEVNULL, stderr=end)
    os.close(end)
    printed, text = [], ""
    while True:
        select.select([terminal], [], [])
        try:
            text += os.read(terminal, 4096).decode(errors="replace")
        except OSError:  # the other end is closed
            break
        for match in PROGRESS.finditer(text):
            printed.append((time.perf_counter() - begin, int(match[1]), seconds_in(match[2])))
            text = text[match.end():]
    os.close(terminal)
    _, status, usage = os.wait4(run.pid, 0)  # of the launcher: with all ranks
    seconds = time.perf_counter() - begin
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        fail(f"{' '.join(map(str, words))} failed with exit code {run.returncode}")
    return {"seconds": seconds, "processor": usage.ru_utime + usage.ru_stime, "memory": 1024 * usage.ru_maxrss,
            "time_left_factor": worst_factor(seconds, printed)}


def compared(overturn, case, options, ranks, folder):
    """Medians of alternating estimates and runs; the worst factor of all."""
    estimates, runs = [], []
    for _ in range(options.repeat):
        estimates.append(estimate(overturn, CASES[case], ranks, folder))
        runs.append(measured(overturn, CASES[case], ranks, folder))

    def median(found, name):
        return statistics.median(each[name] for each in found)

    factors = [each["time_left_factor"] for each in runs if each["time_left_factor"]]
    return {"case": case, "ranks": ranks, "estimated_seconds": median(estimates, "seconds"),
            "seconds": median(runs, "seconds"), "processor_seconds": median(runs, "processor"),
            "estimated_memory": median(estimates, "memory_bytes_of_rank_0"), "memory": median(runs, "memory"),
            "time_left_factor": max(factors, default=None)}


def run(options):
    overturn = program(options)
    print(f"{'':26}ranks  estimated   measured  ratio  processor  ratio  time left  memory: estimated, measured",
          flush=True)
    results = []
    with tempfile.TemporaryDirectory() as name:
        for case in options.only:
            for ranks in options.ranks:
                found = compared(overturn, case, options, ranks, pathlib.Path(name))
                results.append(found)
                estimated, seconds, factor = (found[name] for name in ("estimated_seconds", "seconds",
                                                                       "time_left_factor"))
                processor = found["processor_seconds"] / ranks
                print(f"{case:26}{ranks:5}{estimated:10.2f} s{seconds:9.2f} s{estimated / seconds:7.2f}"
                      f"{processor:9.2f} s{estimated / processor:7.2f}{f'{factor:.2f}' if factor else '-':>11}"
                      f"{found['estimated_memory'] / 1e6:17.0f} MB{found['memory'] / 1e6:9.0f} MB", flush=True)
    ratios = [each["estimated_seconds"] / each["seconds"] for each in results]
    print(f"estimated times are {min(ratios):.2f} to {max(ratios):.2f} times the measured ones")
    write_results(options.output, {"benchmark": "estimates", "cases": results})
