"""Runs overturn as a separate process for the benchmarks, with or without mpirun."""

import json
import pathlib
import shutil
import subprocess
import tempfile
import time

from building import SOURCE, fail

from overturn.installation import find_overturn, mpi_environment

JOB, AXES = SOURCE / "jobs" / "figure_07a.toml", ("frequency", "amplitude")
RECORD_JOB, RECORD_AXES = SOURCE / "jobs" / "synthetic.toml", ("size", "scale")


def launcher(ranks):
    """The command prefix that starts a program on this many ranks."""
    mpirun = shutil.which("mpirun") or fail("mpirun not found; install it by "
                                            "tools/install_dependencies build")
    return [mpirun, "-n", str(ranks)]


def measured_run(overturn, side, settings, start=(), job=JOB, axes=AXES, options=()):
    """Runs a job at side x side points with further settings and options; `start` is the command prefix.
    Returns the wall time from the start of the command to its exit, and the sidecar."""
    settings = [*(f"plane.{axis}.count={side}" for axis in axes), *settings]
    command = [*start, str(overturn), "run", str(job), "-o", "bench.h5", *options,
               *(word for setting in settings for word in ("--set", setting))]
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        finished = subprocess.run(command, cwd=folder, env=mpi_environment(), text=True,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        wall = time.perf_counter() - begin
        if finished.returncode != 0:
            fail(f"{' '.join(command)}\nfailed with exit code {finished.returncode}: "
                 f"{finished.stderr.strip()}")
        return wall, json.loads((pathlib.Path(folder) / "bench.h5.json").read_text())


def add_program_argument(parser):
    parser.add_argument("--overturn", help="path of the program to measure (default: build/overturn)")


def program(options):
    return find_overturn(options.overturn)
