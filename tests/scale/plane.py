"""A plane, the program that computes it, and its checks. For scale.py."""

import contextlib
import hashlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "commands"))
from program import ENVIRONMENT, OVERTURN, ranks_of, under_mpi  # noqa: E402

BEGAN = time.monotonic()
CORES = len(os.sched_getaffinity(0))
SIDE = 64  # of a tile
BETWEEN_LOOKS = 0.05  # [s]
SILENCE = 1800  # [s] without output after which a command hangs; a run prints its progress
STOPPED = 85
MIB = 2**20

# Memory grows with the number of tiles. Rank 0 keeps two lists of missing tiles, one of them with
# up to twice the capacity, and temporarily the checksums: 32 bytes. With a million tiles 35 were
# measured; twice as many are allowed. The rest is libraries, mostly MPI: 33 MiB with 64 ranks;
# three times as many are allowed, for other MPIs.
MOST_MEMORY_PER_TILE = 64  # [bytes]
MOST_MEMORY = 96 * MIB

JOB = """
[scene]
pulse = "one_sine"
theory = "nonlinear"
[plane]
frequency = {frequency}
amplitude = {amplitude}
restitution_of_maximum = 1.0
slenderness = {{ values = [0.1745716] }}
[numerics]
method = "{method}"
tolerance = {tolerance}
[output]
fields = [{fields}]
precision = "{precision}"
"""
# The least work: at 1e-4 taylor takes a tenth less time than rk45 for these points. One verdict in
# ten thousand is wrong, which does not matter here because all runs give the same.
CHEAP = {"method": "taylor", "tolerance": "1e-4", "fields": '"region"', "precision": "double"}
# Tiles that take long enough for a signal to arrive during them.
COSTLY = {"method": "rk45", "tolerance": "1e-12",
          "fields": '"region", "angle", "velocity", "margin", "impacts", "status"', "precision": "double"}
# Both types of numbers, at the price of CHEAP.
SINGLE = {**CHEAP, "fields": '"region", "margin"', "precision": "single"}


class Failure(Exception):
    """A failed check."""


def demand(condition, what_is_wrong):
    if not condition:
        raise Failure(what_is_wrong)


def say(text):
    print(f"[{time.monotonic() - BEGAN:4.0f} s] {text}", flush=True)


class Plane:
    """A plane of the paper's block under a one-sine pulse: its job, its file, and its tiles."""

    def __init__(self, folder, name, rows, columns, numerics):
        self.folder, self.rows, self.columns, self.numerics = folder, rows, columns, numerics
        self.job, self.file = folder / f"{name}.toml", folder / f"{name}.h5"
        self.job.write_text(JOB.format(frequency=f"{{ first = 0.1, last = 12.0, count = {columns} }}",
                                       amplitude=f"{{ first = 0.1, last = 16.0, count = {rows} }}",
                                       **numerics))
        self.tile_rows, self.tile_columns = -(-rows // SIDE), -(-columns // SIDE)
        self.tiles = self.tile_rows * self.tile_columns
        self.points = rows * columns
        self.most_memory = MOST_MEMORY + MOST_MEMORY_PER_TILE * self.tiles
        self.place_of_marks = None

    def __str__(self):
        return f"{self.rows} x {self.columns} points"

    def slices(self, tile):
        """Returns the rows and columns of a tile; tiles at the upper edges may be smaller."""
        row, column = (SIDE * index for index in divmod(int(tile), self.tile_columns))
        return (slice(row, min(row + SIDE, self.rows)),
                slice(column, min(column + SIDE, self.columns)))

    def tile_of(self, point):
        row, column = divmod(point, self.columns)
        return row // SIDE * self.tile_columns + column // SIDE

    def marks(self):
        """Returns the checksums, 0 for missing tiles; bypasses HDF5, so that ranks may be
        writing."""
        if not self.file.exists():
            return np.zeros(self.tiles, np.uint64)
        if self.place_of_marks is None:
            with h5py.File(self.file) as file:
                self.place_of_marks = file["run/checksum"].id.get_offset()
        return np.fromfile(self.file, "<u8", self.tiles, offset=self.place_of_marks)

    def done(self):
        return np.count_nonzero(self.marks())

    def run(self, ranks, output=None):
        """Starts to compute the plane, without mpirun if ranks is None."""
        return Command(self.folder, ["run", self.job, "-o", output or self.file], ranks)

    def values(self, name, rows, columns):
        with h5py.File(self.file) as file:
            return file[name][0, rows, columns]

    def computed_apart(self, rows, columns):
        """Computes the regions at some rows and columns (indices) with a separate job."""
        with h5py.File(self.file) as file:
            axes = {name: "{ values = %s }" % file[name][:][indices].tolist()
                    for name, indices in (("amplitude", rows), ("frequency", columns))}
        job, output = self.folder / "apart.toml", self.folder / "apart.h5"
        job.write_text(JOB.format(**axes, **self.numerics))
        Command(self.folder, ["run", job, "-o", output]).must_end_with(0)
        with h5py.File(output) as file:
            regions = file["region"][0]
        output.unlink()
        return regions

    def demand_right_tiles(self, tiles):
        for tile in tiles:
            rows, columns = self.slices(tile)
            demand(np.array_equal(self.values("region", rows, columns), self.computed_apart(rows, columns)),
                   f"{self}: tile {tile} differs from the result of a small job")

    def demand_right_lines(self, chance, count):
        """Checks whole rows and columns: random ones and the last ones."""
        rows = sorted({*chance.sample(range(self.rows), count), self.rows - 1})
        columns = sorted({*chance.sample(range(self.columns), count), self.columns - 1})
        everything = slice(None)
        stored = np.array([self.values("region", row, everything) for row in rows])
        demand(np.array_equal(stored, self.computed_apart(rows, everything)),
               f"{self}: rows differ from the result of a small job")
        stored = np.array([self.values("region", everything, column) for column in columns]).T
        demand(np.array_equal(stored, self.computed_apart(everything, columns)),
               f"{self}: columns differ from the result of a small job")
        return len(rows) * self.columns + len(columns) * self.rows


class Command:
    """The running program, with or without mpirun; its output, and the largest memory of its ranks.

    This is VmHWM of each rank, read repeatedly. (The value that wait4 reports for a child is at
    least the memory of this script when it started the child.)"""

    running = []

    def __init__(self, folder, arguments, ranks=None, variables=None):
        self.ranks, self.memory, self.pids = ranks or 1, {}, []
        command = [*(under_mpi(ranks) if ranks else []), OVERTURN, *map(str, arguments)]
        self.output = tempfile.TemporaryFile(dir=folder)
        self.began = self.last_word = time.monotonic()
        self.length = 0
        self.process = subprocess.Popen(command, cwd=folder, env=ENVIRONMENT | (variables or {}),
                                        stdout=self.output, stderr=subprocess.STDOUT, start_new_session=True)
        self.under_mpi = ranks is not None
        Command.running.append(self)

    def words(self):
        return os.pread(self.output.fileno(), MIB, 0).decode()

    def is_running(self):
        self.look_at_memory()
        length = os.fstat(self.output.fileno()).st_size
        if length > self.length:
            self.length, self.last_word = length, time.monotonic()
        demand(time.monotonic() - self.last_word < SILENCE, f"silent for {SILENCE} s:\n{self.words()}")
        return self.process.poll() is None

    def look_at_memory(self):
        with contextlib.suppress(OSError):  # already ended
            if not self.under_mpi:
                self.pids = [self.process.pid]
            elif len(self.pids) < self.ranks:
                self.pids = ranks_of(self.process.pid)
        for pid in self.pids:
            with contextlib.suppress(OSError):
                status = pathlib.Path(f"/proc/{pid}/status").read_text()
                peak = re.search(r"VmHWM:\s*(\d+) kB", status)
                self.memory[pid] = max(int(peak[1]) * 1024 if peak else 0, self.memory.get(pid, 0))

    def most_memory(self):
        demand(len(self.memory) >= self.ranks and all(self.memory.values()),
               f"only {len(self.memory)} of {self.ranks} ranks were found")
        return max(self.memory.values())

    def wait_for_tiles(self, plane, share):
        """Waits until a share of all tiles of the plane is done."""
        while plane.done() < share * plane.tiles:
            demand(self.is_running(), f"the run ended too early:\n{self.words()}")
            time.sleep(BETWEEN_LOOKS)

    def wait_for_words(self, phrase):
        while phrase not in self.words():
            demand(self.is_running(), f"the run ended early:\n{self.words()}")
            time.sleep(BETWEEN_LOOKS)

    def wait_for_end(self):
        while self.is_running():
            time.sleep(BETWEEN_LOOKS / 10)
        self.seconds = time.monotonic() - self.began
        Command.running.remove(self)
        return self.process.returncode

    def must_end_with(self, code):
        found = self.wait_for_end()
        demand(found == code, f"exit code {found} instead of {code}:\n{self.words()}")
        return self

    def must_say(self, *phrases):
        for phrase in phrases:
            demand(phrase in self.words(), f'"{phrase}" is not in\n{self.words()}')
        return self

    def stop(self):
        """Sends SIGUSR1 to mpirun, as described in docs/robustness.md."""
        self.process.send_signal(signal.SIGUSR1)
        return self.must_end_with(STOPPED).must_say("stopped by a signal")

    def kill_a_rank(self, chance):
        return self.kill_rank(chance.randrange(len(self.pids)))

    def kill_rank(self, rank):
        os.kill(self.pids[rank], signal.SIGKILL)
        demand(self.wait_for_end() != 0, "a killed rank was not detected")
        return self

    @classmethod
    def end_all(cls):
        """Ends processes left by a failure. mpirun ends its ranks if given the time."""
        for command in cls.running:
            command.process.terminate()
            try:
                command.process.wait(timeout=30)
            except subprocess.TimeoutExpired:
                for pid in [*command.pids, command.process.pid]:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(pid, signal.SIGKILL)


def verify(plane):
    return Command(plane.folder, ["verify", plane.file]).must_end_with(0).must_say(
        f"{plane.tiles} of {plane.tiles} tiles are done; coordinates and checksums match")


def resume(plane, ranks):
    """Resumes the run, which must find all existing tiles undamaged."""
    there = plane.done()
    command = plane.run(ranks)
    command.wait_for_words("kernel")
    return command.must_say(f"resuming: {there} of {plane.tiles} tiles done; ")


def demand_little_memory(plane, *commands):
    most = max(command.most_memory() for command in commands)
    demand(most <= plane.most_memory, f"{plane}: a process took {most / MIB:.0f} MiB; at most "
           f"{plane.most_memory / MIB:.0f} MiB are allowed")
    return f"{most / MIB:.0f} MiB (bound {plane.most_memory / MIB:.0f})"


def human(count):
    """Formats a number from 1000 on like the program."""
    for prefix in "kMGT":
        count /= 1000
        if count < 999.5:
            break
    return f"{count:.{2 if count < 9.995 else 1 if count < 99.95 else 0}f} {prefix}"


def digest(path, left_out=()):
    """Returns the sha256 of a file without some (offset, size)."""
    result = hashlib.sha256()
    with open(path, "rb") as file:
        for offset, size in [*sorted(left_out), (path.stat().st_size, 0)]:
            while (left := offset - file.tell()) > 0:
                result.update(file.read(min(left, 16 * MIB)))
            file.seek(offset + size)
    return result.hexdigest()
