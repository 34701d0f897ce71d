#!/usr/bin/env python3
"""Kills overturn repeatedly and checks whether data are lost.

    kills.py [--kills N] [--seed S]

A fifth of the kills hit runs under a pulse, a fifth runs of a filled spectrum, a fifth runs under
records, a fifth runs of a part of a job, and a fifth merges of three parts. Each hits a run of 1, 2,
3 or 5 ranks, or a merge, that creates or resumes a file: at a random write to the file (including
writes that create it and those between a tile's values and its checksum; in half of the cases after
half of the bytes), or a rank, mpirun, or all processes at a random time. After each kill, tiles
marked as done must be correct, byte for byte, and each completed file must equal that of an
undisturbed run; that of a merge appears when it is complete. Requires OVERTURN, MPIEXEC and FAULTY_DISK (the library) in the
environment."""

import argparse
import collections
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "commands"))
from program import (ENVIRONMENT, OVERTURN, PATIENCE, from_environment,  # noqa: E402
                     under_mpi)

LIBRARY = from_environment("FAULTY_DISK")
JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
COMMON = """
[output]
fields = ["region", "velocity", "margin"]
"""
PULSE = COMMON + """
[scene]
pulse = "one_sine"
theory = "nonlinear"
[plane]
frequency = { first = 0.5, last = 8.0, count = 320 }
amplitude = { first = 0.5, last = 12.0, count = 250 }
restitution_of_maximum = { values = [0.7, 0.85, 1.0] }
slenderness = { values = [0.1745716] }
[numerics]
tolerance = 1e-8
"""
FILLED = """
[output]
fields = ["region", "impacts"]
[scene]
pulse = "one_sine"
[plane]
frequency = { first = 0.5, last = 8.0, count = 600 }
amplitude = { first = 0.5, last = 12.0, count = 500 }
restitution_of_maximum = { values = [0.7, 0.85, 1.0] }
slenderness = { values = [0.1745716] }
[numerics]
fill = true
tolerance = 1e-8
"""
RECORDS = COMMON + f"""
[scene]
record = ["{JOBS}/synthetic.AT2", "{JOBS}/synthetic_vertical.AT2"]
[plane]
scale = {{ first = 0.5, last = 4.0, count = 150 }}
size = {{ first = 0.2, last = 3.0, count = 120 }}
restitution_of_maximum = {{ values = [0.9, 1.0] }}
slenderness = {{ values = [0.2] }}
"""


class Loss(Exception):
    """Lost data or hanging processes."""


class Runs:
    """Runs of a job in a folder, disturbed and undisturbed."""

    RANKS = (1, 2, 3, 5)
    PART = ()  # arguments
    MARKS_TILES = True  # one by one

    def __init__(self, folder, job, chance):
        self.folder, self.chance = pathlib.Path(folder), chance
        (self.folder / "job.toml").write_text(job)
        self.prepare()
        self.file = self.folder / "killed.h5"
        self.counts = collections.Counter()
        self.torn_checksums = set()
        began = time.monotonic()
        self.run_undisturbed("whole.h5", 1)
        self.seconds = time.monotonic() - began
        self.whole = (self.folder / "whole.h5").read_bytes()
        with h5py.File(self.folder / "whole.h5") as file:
            self.values = values_of(file)
            self.tiles = np.count_nonzero(file["run/checksum"])
            self.side = int(file["run/checksum"].attrs["tile_shape"][-1])
            per_tile = len({"checksum", "audit_checked", "audit_wrong"} & set(file["run"])) * self.MARKS_TILES
        # A tile consists of whole rows of its chunk and takes a write per field and one for each of
        # its values in the group `run`, the checksum among them; the other writes create the file.
        self.writes_of_tiles = self.tiles * (len(self.values) + per_tile)
        self.writes = self.count_writes()

    def prepare(self):
        """Computes what the command needs."""

    def command(self, ranks, output):
        return [*([] if ranks == 1 else under_mpi(ranks)), OVERTURN, "run", "job.toml", *self.PART, "-o", output]

    def run_undisturbed(self, output, ranks, **more):
        done = subprocess.run(self.command(ranks, output), cwd=self.folder, timeout=PATIENCE,
                              env=ENVIRONMENT | more, capture_output=True, text=True)
        if done.returncode:
            raise Loss(f"a run could not be resumed, exit code {done.returncode}: {done.stderr}")

    def count_writes(self):
        count = self.folder / "count"
        self.run_undisturbed("counted.h5", 1, LD_PRELOAD=LIBRARY, COUNT_WRITES_IN=str(count),
                             FAULTY_FILE=str(self.folder / "counted.h5"))
        return int(count.read_text().split()[0])

    def start(self, ranks, **more):
        nodes = {"OVERTURN_RANKS_PER_NODE": self.chance.choice("125")}
        return subprocess.Popen(self.command(ranks, self.file.name), cwd=self.folder,
                                env=ENVIRONMENT | nodes | more, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, start_new_session=True)

    def kill_at_a_write(self, ranks):
        """Kills one rank; three times in ten while the file is created, which takes 0.02 s."""
        rank = self.chance.randrange(ranks)
        making = self.writes - self.writes_of_tiles
        most = making if self.chance.random() < 0.3 else making + self.writes_of_tiles // ranks
        torn = self.torn = self.chance.random() < 0.5
        process = self.start(ranks, LD_PRELOAD=LIBRARY, FAULTY_FILE=str(self.file),
                             FAULTY_RANK=str(rank), KILL_TORN=str(int(torn)),
                             KILL_AT_WRITE=str(self.chance.randint(1, most)))
        self.wait_for_end(process)
        return "during a write" if torn else "just before a write"

    def kill_at_a_time(self, ranks):
        self.torn = False
        process = self.start(ranks)
        time.sleep(self.chance.uniform(0, 1.2 * self.seconds / min(ranks, os.cpu_count())))
        victims = [process.pid, *children(process.pid)]
        what = self.chance.choice(("a rank", "mpirun", "all at once")) if ranks > 1 else "a rank"
        if what == "a rank":
            victims = [self.chance.choice(victims[1:] or victims)]
        elif what == "mpirun":
            victims = victims[:1]
        for victim in victims:
            try:
                os.kill(victim, signal.SIGKILL)
            except ProcessLookupError:
                pass  # already ended
        self.wait_for_end(process)
        return f"{what} at a random time"

    def wait_for_end(self, process):
        """Waits for all processes of the run: ranks may outlive a killed mpirun for a moment.
        mpirun may hang without any rank if a rank dies during start-up: this is a fault of
        mpirun."""
        deadline = time.monotonic() + PATIENCE
        while process.poll() is None:
            half_time = time.monotonic() > deadline - PATIENCE / 2
            if half_time and not any(map(is_alive, children(process.pid))):
                self.counts["  mpirun hung without ranks"] += 1
                process.kill()
            if time.monotonic() > deadline:
                os.killpg(process.pid, signal.SIGKILL)
                raise Loss("ranks hang")
            time.sleep(0.01)
        while session_is_alive(process.pid):
            if time.monotonic() > deadline:
                os.killpg(process.pid, signal.SIGKILL)
                raise Loss("ranks outlived mpirun")
            time.sleep(0.01)
        self.last = process.returncode

    def look(self):
        """Checks the file after a kill; returns its state."""
        if not self.file.exists():
            return "before the file existed"
        verdict = subprocess.run([OVERTURN, "verify", self.file], capture_output=True, text=True,
                                 timeout=PATIENCE)
        self.note_torn_checksums(verdict)
        with h5py.File(self.file) as file:
            done = np.flatnonzero(file["run/checksum"][:])
            stored = values_of(file)
        for tile in set(done) - self.torn_checksums:
            for name, values in self.values.items():
                place = self.place(tile)
                if stored[name][place].tobytes() != values[place].tobytes():
                    raise Loss(f"tile {tile} is marked as done, but its {name} is wrong")
        return "with all tiles done" if len(done) == self.tiles else "between the tiles"

    def note_torn_checksums(self, verdict):
        """A partly written checksum must be reported by verify. It remains until a run has
        verified the tile."""
        found = re.search(r"tile numbers: ([\d, ]+)\)", verdict.stderr)
        damaged = set(map(int, found[1].split(","))) if found else set()
        new = damaged - self.torn_checksums
        if verdict.returncode and (not damaged or len(new) > self.torn):
            raise Loss(f"verify: {verdict.stderr}")
        self.counts["  torn checksums, found by verify"] += len(new)
        self.torn_checksums = damaged

    def place(self, tile):
        rows, columns = (-(-extent // self.side) for extent in self.values["region"].shape[1:])
        row, column = divmod(tile % (rows * columns), columns)
        side = self.side
        return (tile // (rows * columns), slice(row * side, (row + 1) * side),
                slice(column * side, (column + 1) * side))

    def finish(self):
        self.run_undisturbed(self.file.name, self.chance.choice(self.RANKS[:3]))
        if self.file.read_bytes() != self.whole:
            raise Loss("the resumed file differs from that of an undisturbed run")
        left = {path.name for path in self.folder.iterdir()} & {"killed.h5.part", "killed.h5.lock"}
        if left:
            raise Loss(f"left behind: {left}")
        self.file.unlink()
        self.torn_checksums = set()
        self.counts["files finished"] += 1

    def kill_once(self):
        ranks = self.chance.choice(self.RANKS)
        way = self.chance.choice((self.kill_at_a_write, self.kill_at_a_time))(ranks)
        where = self.look()
        if self.last == 0:
            self.counts["runs that ended before the kill"] += 1
        else:
            self.counts["kills"] += 1
            self.counts[f"  {way}"] += 1
            self.counts[f"  {where}"] += 1
        if self.last == 0 or self.chance.random() < 0.3:
            self.finish()


class PartRuns(Runs):
    PART = ("--part", "2/3")


class Merges(Runs):
    """The file of all parts in place of that of a run. All checksums are written at the end."""

    RANKS = (1,)
    MARKS_TILES = False

    def prepare(self):
        for number in "123":
            subprocess.run([OVERTURN, "run", "job.toml", "--part", f"{number}/3"], cwd=self.folder, env=ENVIRONMENT,
                           check=True, timeout=PATIENCE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def command(self, ranks, output):
        return [OVERTURN, "merge", *(f"job.part-{number}-of-3.h5" for number in "123"), "-o", output]

    def look(self):
        where = super().look()
        if where == "between the tiles":
            raise Loss("the file of a merge lacks tiles")
        return where


def values_of(file):
    """Returns the fields, with one plane per index of all outer dimensions."""
    return {name: values[:].reshape(-1, *values.shape[-2:])
            for name, values in file.items() if isinstance(values, h5py.Dataset) and values.ndim > 2}


def children(pid):
    try:
        return [int(child) for child in
                pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def state_and_session(pid):
    try:
        after_name = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return "Z", 0  # already ended
    return after_name[0], int(after_name[3])


def is_alive(pid):
    return state_and_session(pid)[0] != "Z"


def session_is_alive(session):
    pids = (path.name for path in pathlib.Path("/proc").glob("[0-9]*"))
    return any(state != "Z" and owner == session for state, owner in map(state_and_session, pids))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    chance = random.Random(arguments.seed)
    counts = collections.Counter()
    kinds = (("runs under a pulse", Runs, PULSE), ("filled runs", Runs, FILLED), ("runs under records", Runs, RECORDS),
             ("runs of a part", PartRuns, PULSE), ("merges of parts", Merges, FILLED))
    for name, kind, job in kinds:
        with tempfile.TemporaryDirectory() as folder:
            runs = kind(folder, job, chance)
            wanted = -(-arguments.kills // len(kinds))
            try:
                while runs.counts["kills"] < wanted:
                    before = runs.counts["kills"]
                    runs.kill_once()
                    if runs.counts["kills"] % 20 == 0 and runs.counts["kills"] > before:
                        print(f"{runs.counts['kills']} of {wanted} kills: {name}", flush=True)
                runs.finish()
            except Loss as loss:
                sys.exit(f"LOST after {runs.counts['kills']} kills: {name} (seed "
                         f"{arguments.seed}): {loss}")
            counts += runs.counts
    for what in sorted(counts, key=lambda name: (name[0] == " ", name)):
        print(f"{counts[what]:5d} {what}")
    print("    0 tiles or runs lost, 0 bytes differ from an undisturbed run")


if __name__ == "__main__":
    main()
