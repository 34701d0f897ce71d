"""How the benchmarks run overturn from the outside, alone or under mpirun."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

from building import SOURCE, fail

JOB = SOURCE / "jobs" / "figure_07a.toml"


def launcher(ranks):
    """The words before the program that start it on this many ranks."""
    mpirun = shutil.which("mpirun") or fail("there is no mpirun; tools/install_dependencies build")
    return [mpirun, "-n", str(ranks)]


def environment():
    extra = {}
    if os.geteuid() == 0:  # Open MPI wants to be told twice
        extra = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**os.environ, **extra}


def measured_run(overturn, side, settings, start=()):
    """Runs the job at side x side points with further settings, started by the words of `start`.
    Returns the wall time from typing the command to its exit, and the sidecar."""
    settings = [f"plane.frequency.count={side}", f"plane.amplitude.count={side}", *settings]
    command = [*start, str(overturn), "run", str(JOB), "-o", "bench.h5",
               *(word for setting in settings for word in ("--set", setting))]
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        finished = subprocess.run(command, cwd=folder, env=environment(), text=True,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        wall = time.perf_counter() - begin
        if finished.returncode != 0:
            fail(f"{' '.join(command)}\nended with {finished.returncode}: "
                 f"{finished.stderr.strip()}")
        return wall, json.loads((pathlib.Path(folder) / "bench.h5.json").read_text())


def add_program_argument(parser):
    parser.add_argument("--overturn", type=pathlib.Path, default=SOURCE / "build" / "overturn",
                        help="the program to measure (default: build/overturn)")


def program(options):
    path = options.overturn.resolve()
    if not path.exists():
        fail(f"{path} is not there; build it (tools/quickstart) or name it by --overturn")
    return path
