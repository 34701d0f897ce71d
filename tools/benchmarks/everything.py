"""Every command whose numbers are in the documentation, one after another, and the page of their reports."""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

import reports
from building import SOURCE, fail, run_or_fail

EXPLANATION = """\
Runs every benchmark of README.md and docs, as the documentation states it, one after another: about an hour, and the
first time a few minutes more to build. With --checks, also the checks whose results the documentation states: about
three hours more, as root, on Debian. Each writes its output, its JSON and its picture to a folder. Their reports are
the sections of a page, beside the commit and the machine of each.

A second call at the same commit replaces or adds sections, so that all can be measured in several calls; otherwise a
new page begins. Commits that change the documentation alone do not count. Records that are not part of the sources are
found in $OVERTURN_RECORDS; $OPENSEES_PYTHON is a Python interpreter that has OpenSeesPy. Do not run other programs
meanwhile."""

DOCUMENTATION = (":!docs", ":!*.md", ":!*.png")
BENCHMARKS = tuple(f"tools/bench {command}" for command in (
    "peers", "peers --record", "kernel", "effects", "run", "ranks", "ranks --record --points 512", "records",
    "records --record $OVERTURN_RECORDS/WTMC.V2A --components 1 2 3", "records --uncertain",
    "records --uncertain --record $OVERTURN_RECORDS/WTMC.V2A --components 1 2 3",
    "records --uncertain --record $OVERTURN_RECORDS/APEEL2_43.smc", "records --museum", "sliding", "estimates", "scale",
    "fill", "fill --audit 0 --sides 4096 16384", "picture")) + tuple(
    f"build/overturn accuracy jobs/{job}.toml --points {points} -o {job}.h5" for job, points in (
        ("figure_07a", "1000000"), ("figure_11a", "1000000"), ("sliding", "16384 --digits 1000"),
        ("synthetic", "16384 --digits 100")))
CHECKS = (
    *(f"tools/check {command}" for command in ("verdicts", "record_verdicts", "sliding", "fill", "scale", "faults 1000",
                                               "fuzz 60", "slurm", "sanitize", "web")),
    "tools/bench web",  # of the module that tools/check web builds
    *(f"tools/examples/shake_table.py fit $OVERTURN_RECORDS/shake_table/calibration_half.h5 {options}-o model.json"
      for options in ("", "--friction 0.4 0.6 0.8 fit ")),
    "$OPENSEES_PYTHON tools/examples/compare_opensees.py")


def add_arguments(parser):
    parser.add_argument("--checks", action="store_true", help="also the checks")
    parser.add_argument("--only", nargs="+", metavar="COMMAND",
                        help="some of: " + ", ".join(f"'{command}'" for command in BENCHMARKS + CHECKS))
    parser.add_argument("--page", type=pathlib.Path, default=SOURCE / "docs" / "measured.md",
                        help="the page (default: docs/measured.md)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("bench"),
                        help="the folder (default: bench)")


def git(*words):
    command = ["git", "-C", SOURCE, *words, "--", ".", *DOCUMENTATION]
    return run_or_fail(command, "git", capture_output=True).stdout.strip()


def commit_and_machine():
    """The last commit that changes more than the documentation, and lines that describe the machine."""
    if changed := git("status", "--porcelain", "--untracked-files=no"):
        fail(f"files have changed since the last commit, which the reports would name; commit them first:\n{changed}")
    overturn = SOURCE / "build" / "overturn"
    if not overturn.exists():
        fail(f"{overturn} does not exist; build it by tools/quickstart")
    run_or_fail(["cmake", "--build", SOURCE / "build", "--target", "overturn", "overturn_python"], "building",
                stdout=subprocess.PIPE)
    doctor = run_or_fail([overturn, "doctor"], "overturn doctor", capture_output=True).stdout
    about = re.findall(r"^(?:compiler|kernels|MPI|HDF5|processor|memory|system) .*$", doctor, re.MULTILINE)
    cpu = pathlib.Path("/proc/cpuinfo")
    model = re.search(r"^cpu family\s*: (\d+)\nmodel\s*: (\d+)", cpu.read_text() if cpu.exists() else "", re.MULTILINE)
    about += [f"{'family':13}{model[1]}, model {model[2]}"] if model else []
    return git("log", "-1", "--format=%h", "--abbrev=8"), "\n".join(about)


def output_of(command, folder):
    """Runs a command of the checkout; its output is shown, and written to the folder. Commands with options get a
    folder of their own, because their files have the same names."""
    words = shlex.split(os.path.expandvars(command))
    name = re.sub(r"\W+", "_", command)
    place = folder / name if words[2:] else folder
    place.mkdir(exist_ok=True)
    words = [str(SOURCE / word) if "/" in word and (SOURCE / word).exists() else word for word in words]
    start = [sys.executable] if words[0].endswith("/bench") else []
    with (folder / f"{name}.txt").open("w") as file, subprocess.Popen(
            start + words, cwd=place, text=True, errors="replace", stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            file.write(line)
    return process.returncode, (folder / f"{name}.txt").read_text()


def run(options):
    folder = options.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    commit, machine = commit_and_machine()
    before, found = reports.read(options.page.read_text()) if options.page.exists() else ("", {})
    if before != commit:
        print(f"{options.page}: a new page", flush=True)
        found = {}
    order = BENCHMARKS + CHECKS
    failed = []
    for command in options.only or order[:None if options.checks else len(BENCHMARKS)]:
        print(f"\n{command}", flush=True)
        if missing := re.search(r"\$\w+", os.path.expandvars(command)):
            print(f"skipped: {missing[0]} is not set", flush=True)
            continue
        began = time.monotonic()
        code, output = output_of(command, folder)
        if code:
            failed.append(command)
        elif text := reports.results_of(output):
            found[command] = reports.Report(machine, time.strftime("%Y-%m-%d"), round(time.monotonic() - began), text)
            found = {name: found[name] for name in (*order, *found) if name in found}
            options.page.write_text(reports.written(commit, found))
    if failed:
        fail(f"failed: {', '.join(failed)}")
    print(f"written: {options.page} and {folder}")
