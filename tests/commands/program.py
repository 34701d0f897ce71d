"""The program as its users meet it: driven from outside, judged by exit code, words and bytes.

The tests that use this want OVERTURN (the binary) and MPIEXEC in the environment; their arguments
are names of test classes."""

import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest


def from_environment(name):
    """What ctest and tools/check set."""
    return os.environ.get(name) or sys.exit(
        f"{name} is not in the environment: run this by ctest or tools/check, or set what the text "
        "at the head of this script names.")


OVERTURN = from_environment("OVERTURN")
MPIEXEC = from_environment("MPIEXEC")
PATIENCE = 60  # [s] for one run of the program; the longest takes some seconds

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
restitution = {{ values = {restitutions}, of = "maximum" }}
slenderness = {{ values = [0.1745716] }}
[numerics]
method = "rk45"
tolerance = {tolerance}
[output]
fields = ["region", "angle", "velocity", "margin", "impacts", "status"]
"""

# 2 x 3 x 4 tiles, some of them cut off at the far edges: a moment's work.
SMALL = JOB.format(columns=200, rows=150, restitutions="[0.7, 1.0]", tolerance="1e-6")
# 3 x 7 x 7 tiles: two seconds or more on two ranks with AVX-512, so that a signal comes in the midst.
LONG = JOB.format(columns=448, rows=448, restitutions="[0.7, 0.85, 1.0]",
                  tolerance="1e-14").replace('"status"]', '"status", "error"]')


def checksum(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def under_mpi(ranks):
    return [MPIEXEC, "-n", str(ranks)]


def is_mpich():
    """Whether MPIEXEC is MPICH's launcher."""
    return "HYDRA" in subprocess.run([MPIEXEC, "--version"], capture_output=True, text=True).stdout


def children_of(pid):
    """Also those that another thread than the first has started."""
    return [int(child) for thread in pathlib.Path(f"/proc/{pid}/task").iterdir()
            for child in (thread / "children").read_text().split()]


def ranks_of(pid):
    """The processes of the launcher's ranks, in order of rank."""

    def numbered(parent):
        for child in children_of(parent):
            variables = pathlib.Path(f"/proc/{child}/environ").read_text().split("\0")
            found = [int(value) for name, _, value in (each.partition("=") for each in variables)
                     if name in ("OMPI_COMM_WORLD_RANK", "PMI_RANK")]
            yield from ((found[0], child),) if found else numbered(child)

    return [child for _, child in sorted(numbered(pid))]


def words(text):
    """Messages break their lines where it looks well; tests do not care."""
    return " ".join(text.split())


class Scratch(unittest.TestCase):
    """A folder of its own for each test, with the two jobs in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "small.toml").write_text(SMALL)
        (self.folder / "long.toml").write_text(LONG)

    def overturn(self, *arguments, ranks=None, shell_setup=None):
        """Runs the program to its end; without ranks, alone and without mpirun."""
        command = [OVERTURN, *map(str, arguments)]
        if shell_setup is not None:
            command = ["sh", "-c", shell_setup + '; exec "$@"', "sh", *command]
        if ranks is not None:
            command = under_mpi(ranks) + command
        return subprocess.run(
            command, cwd=self.folder, env=ENVIRONMENT, timeout=PATIENCE, capture_output=True,
            text=True,
        )

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_exit(self, result, code, *phrases):
        """The exit code, and that the messages hold the phrases."""
        everything = words(result.stdout + result.stderr)
        self.assertEqual(result.returncode, code, everything)
        for phrase in phrases:
            self.assertIn(phrase, everything)

    def assert_stopped(self, code, output, ranks=None):
        """By a signal. MPICH's launcher sometimes returns 0 instead, and 9 if it has killed a rank."""
        codes = (85, 0, 9) if ranks is not None and is_mpich() else (85,)
        self.assertIn(code, codes, output)

    def assert_refused(self, code, phrases, *arguments, ranks=None):
        """The exit code, one message with the phrases in it, and nothing written."""
        before = self.files()
        result = self.overturn(*arguments, ranks=ranks)
        self.assert_exit(result, code, *phrases)
        self.assertEqual(result.stderr.count("overturn: "), 1, result.stderr)
        self.assertEqual(self.files(), before)
