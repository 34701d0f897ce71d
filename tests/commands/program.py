"""The program as users see it: started from outside, checked by exit code, messages and bytes.

The tests that use this module require OVERTURN (the binary) and MPIEXEC in the environment; their
arguments are names of test classes."""

import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py


def from_environment(name):
    """Returns a variable set by ctest and tools/check."""
    return os.environ.get(name) or sys.exit(
        f"{name} is not set: run this script with ctest or tools/check, or set the variables named "
        "in its docstring.")


OVERTURN = from_environment("OVERTURN")
MPIEXEC = from_environment("MPIEXEC")
JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
TOOLS = JOBS.parent / "tools"
sys.path.append(str(JOBS.parent / "tests" / "tools"))
PATIENCE = 60  # [s] for one run of the program; the longest takes a few seconds

ENVIRONMENT = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
}

JOB = """
title = "A small plane"
[scene]
pulse = "one_sine"
theory = "nonlinear"
[plane]
frequency = {{ first = 0.5, last = 8.0, count = {columns} }}
amplitude = {{ first = 0.5, last = 12.0, count = {rows} }}
restitution_of_maximum = {{ values = {restitutions} }}
slenderness = {{ values = [0.1745716] }}
[numerics]
method = "rk45"
tolerance = {tolerance}
[output]
fields = ["region", "angle", "velocity", "margin", "impacts", "status"]
"""

# 2 x 3 x 4 tiles, some of them cut off at the upper edges: computed at once.
SMALL = JOB.format(columns=200, rows=150, restitutions="[0.7, 1.0]", tolerance="1e-6")
# 2 x 7 x 7 tiles: on a slow disk it takes seconds.
LONG = JOB.format(columns=448, rows=448, restitutions="[0.7, 1.0]",
                  tolerance="1e-6").replace('"status"]', '"status", "error"]')
LONG_TILES = 98


def checksum(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def under_mpi(ranks):
    return [MPIEXEC, "-n", str(ranks)]


def is_mpich():
    """Whether MPIEXEC is MPICH's launcher."""
    return "HYDRA" in subprocess.run([MPIEXEC, "--version"], capture_output=True, text=True).stdout


def children_of(pid):
    """Returns the children of all threads of a process."""
    return [int(child) for thread in pathlib.Path(f"/proc/{pid}/task").iterdir()
            for child in (thread / "children").read_text().split()]


def ranks_of(pid):
    """Returns the processes of the launcher's ranks, in order of rank."""

    def numbered(parent):
        for child in children_of(parent):
            variables = pathlib.Path(f"/proc/{child}/environ").read_text().split("\0")
            found = [int(value) for name, _, value in (each.partition("=") for each in variables)
                     if name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK")]
            yield from ((found[0], child),) if found else numbered(child)

    return [child for _, child in sorted(numbered(pid))]


def words(text):
    """Joins the lines of a message, because tests do not check line breaks."""
    return " ".join(text.split())


class Scratch(unittest.TestCase):
    """A separate folder for each test, with the two jobs in it."""

    computed = {}  # the bytes of files, see have()

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.slow = pathlib.Path(folder.name + ".slow")
        self.addCleanup(self.slow.unlink, missing_ok=True)
        (self.folder / "small.toml").write_text(SMALL)
        (self.folder / "long.toml").write_text(LONG)

    def overturn(self, *arguments, ranks=None, shell_setup=None):
        """Runs the program to its end; without mpirun if `ranks` is None."""
        command = [OVERTURN, *map(str, arguments)]
        if shell_setup is not None:
            command = ["sh", "-c", shell_setup + '; exec "$@"', "sh", *command]
        if ranks is not None:
            command = under_mpi(ranks) + command
        return subprocess.run(
            command, cwd=self.folder, env=ENVIRONMENT, timeout=PATIENCE, capture_output=True,
            text=True,
        )

    def start(self, *arguments, ranks=None, variables=None):
        """Starts the program. Its output and its messages are read from stdout. variables: of the
        environment of the program, but not of its launcher."""
        process = subprocess.Popen(
            [*(under_mpi(ranks) if ranks else []), "env",
             *(f"{name}={value}" for name, value in (variables or {}).items()),
             OVERTURN, *map(str, arguments)], cwd=self.folder,
            env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.kill)
        return process

    def tool(self, name, *arguments):
        """Runs a Python tool to its end."""
        from tool import run_tool
        return run_tool(name, *arguments, cwd=self.folder)

    def have(self, name, compute):
        """Writes the file `name` as compute() does, which runs only for the first test of the class."""
        path = self.folder / name
        key = (type(self), name)
        if key not in self.computed:
            self.assert_exit(compute(), 0)
            self.computed[key] = path.read_bytes()
        path.write_bytes(self.computed[key])

    def opened(self, name):
        """Returns the content of a result file."""
        import xarray  # takes half a second
        with xarray.open_dataset(self.folder / name) as data:
            return data.load()

    def forget(self, name, tiles):
        """Marks tiles of a file as not computed."""
        with h5py.File(self.folder / name, "r+") as file:
            file["run/checksum"][tiles] = 0

    def with_slow(self, name, milliseconds=4):
        """Returns the variables with which each write to this file takes so long, until self.go_on(): a
        run lasts as long as the test needs it. Requires the library FAULTY_DISK of tests/faults."""
        self.slow.touch()
        return {"LD_PRELOAD": os.environ["FAULTY_DISK"], "WRITE_TAKES": str(milliseconds),
                "SLOW_WHILE": str(self.slow), "FAULTY_FILE": str(self.folder / name)}

    def go_on(self):
        self.slow.unlink()

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_exit(self, result, code, *phrases):
        """Checks the exit code and that the messages contain the phrases."""
        everything = words(result.stdout + result.stderr)
        self.assertEqual(result.returncode, code, everything)
        for phrase in phrases:
            self.assertIn(phrase, everything)

    def assert_stopped(self, code, output, ranks=None):
        """Checks for a stop by a signal. MPICH's launcher may return 0, or 9 if it killed a
        rank."""
        codes = (85, 0, 9) if ranks is not None and is_mpich() else (85,)
        self.assertIn(code, codes, output)

    def assert_refused(self, code, phrases, *arguments, ranks=None):
        """Checks the exit code, that one message contains the phrases, and that no file is
        written."""
        before = self.files()
        result = self.overturn(*arguments, ranks=ranks)
        self.assert_exit(result, code, *phrases)
        self.assertEqual(result.stderr.count("overturn: "), 1, result.stderr)
        self.assertEqual(self.files(), before)
