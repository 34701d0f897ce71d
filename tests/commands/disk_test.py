"""Behaviour of overturn on disks that are full or fail, and with files that change during a run.
Also requires the library FAULTY_DISK of tests/faults in the environment."""

import errno
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import (ENVIRONMENT, LONG_TILES, OVERTURN, PATIENCE, Scratch, checksum, under_mpi,
                     words)

FAULTY_DISK = os.environ["FAULTY_DISK"]
AGAIN = "run the same command again to resume"


class OnFaultyDisk(Scratch):
    def settings_of(self, faults):
        return {"LD_PRELOAD": FAULTY_DISK, "FAULTY_FILE": self.folder / "out.h5", **faults}

    def overturn_on_faulty_disk(self, *arguments, ranks=None, **faults):
        """Runs the program with these faults in the file out.h5."""
        settings = self.settings_of(faults)
        preload = "export " + " ".join(f"{name}={value}" for name, value in settings.items())
        if ranks is None:
            return self.overturn(*arguments, shell_setup=preload)
        return subprocess.run(
            [*under_mpi(ranks), OVERTURN, *arguments], cwd=self.folder, timeout=PATIENCE,
            capture_output=True, text=True,
            env=ENVIRONMENT | {name: str(value) for name, value in settings.items()})


class ADiskThatFails(OnFaultyDisk):
    """All writes fail from some write on: as on a disk that is full or over its quota, that became
    read-only after an error, or that is broken."""

    REASONS = {errno.ENOSPC: "no space left on device", errno.EDQUOT: "disk quota exceeded",
               errno.EROFS: "read-only file system", errno.EIO: "input/output error"}  # fmt: skip

    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0)
        self.whole = checksum(self.folder / "whole.h5")

    def writes_of_a_run(self):
        """Returns the number of writes that create the file and of all writes of a run."""
        result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5",
                                              COUNT_WRITES_IN=self.folder / "count")
        self.assert_exit(result, 0)
        every = int((self.folder / "count").read_text().split()[0])
        (self.folder / "count").unlink()
        tiles = 24
        return every - tiles * 7, every  # six fields and the checksum; a few at the end

    def test_ends_the_run_with_the_reason_and_loses_no_tile(self):
        making, every = self.writes_of_a_run()
        for (number, reason), ranks in zip(self.REASONS.items(), (None, 2, 2, None)):
            (self.folder / "out.h5").unlink(missing_ok=True)
            # Rank 1 does not create the file. While rank 0 waits for the disk, rank 1 has tiles.
            at = ({"FAIL_AT_WRITE": (making + every) // 2} if ranks is None
                  else {"FAIL_AT_WRITE": 1, "FAULTY_RANK": 1, "WRITE_TAKES": 5, "SLOW_WHILE": self.folder})
            result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5", ranks=ranks,
                                                  ERROR=number, **at)
            self.assert_exit(result, 74, "cannot write tile", reason)
            self.assertIn(AGAIN, result.stderr.lower())
            self.assert_exit(self.overturn("verify", "out.h5"), 0)
            resumed = self.overturn("run", "small.toml", "-o", "out.h5")
            self.assert_exit(resumed, 0, "resuming: ")
            self.assertEqual(checksum(self.folder / "out.h5"), self.whole)

    def test_leaves_no_file_if_creation_fails(self):
        before = self.files()
        for write in (1, 10):
            for number, reason in self.REASONS.items():
                result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5",
                                                      ERROR=number, FAIL_AT_WRITE=write)
                self.assert_exit(result, 74, "cannot create", reason)
                self.assertEqual(self.files(), before)

    def test_is_reported_if_data_cannot_be_synced(self):
        for ranks in (None, 2):
            (self.folder / "out.h5").unlink(missing_ok=True)
            self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)
            self.forget("out.h5", ...)
            result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5", "--durable",
                                                  ranks=ranks, ERROR=errno.EIO, FAIL_AT_SYNC=1)
            self.assert_exit(result, 74, "cannot write tile", "input/output error")
            self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)
            self.assertEqual(checksum(self.folder / "out.h5"), self.whole)


class AKillAtTheLastWrite(OnFaultyDisk):
    def test_leaves_a_file_that_the_next_run_makes_equal_to_that_of_an_undisturbed_run(self):
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)
        whole = checksum(self.folder / "out.h5")
        (self.folder / "out.h5").unlink()
        count = self.folder / "count"
        self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5", COUNT_WRITES_IN=count)
        writes = int(count.read_text().split()[0])
        (self.folder / "out.h5").unlink()
        result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5",
                                              KILL_AT_WRITE=writes)
        self.assertEqual(result.returncode, -signal.SIGKILL)
        self.assertNotEqual(checksum(self.folder / "out.h5"), whole)
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0, "already complete")
        self.assertEqual(checksum(self.folder / "out.h5"), whole)


class AStopDuringAWrite(OnFaultyDisk):
    def test_before_a_damaged_tile_is_cleared_leaves_the_file_incomplete(self):
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)
        whole = checksum(self.folder / "out.h5")
        for ranks in (None, 2):
            with h5py.File(self.folder / "out.h5", "r+") as file:
                file["velocity"][0, 0, 1, 2] += 1e-9
            # The first write precedes the comparison of the files by the ranks.
            result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5", ranks=ranks,
                                                  KILL_AT_WRITE=1, KILL_BY=int(signal.SIGUSR1))
            self.assert_stopped(result.returncode, result.stderr, ranks)
            self.assertIn("stopped by a signal; tiles missing: 1 of 24", words(result.stderr))
            self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0, "23 of 24 tiles done")
            self.assertEqual(checksum(self.folder / "out.h5"), whole)


class OnSmallDisk(Scratch):
    """A private file system, which any user may mount in a mount namespace."""

    def on_small_disk(self, commands):
        """Runs shell commands with $DISK, which has half of the space of whole.h5."""
        if subprocess.run(["unshare", "--map-root-user", "--mount", "true"], capture_output=True).returncode:
            self.skipTest("mount namespaces are not available")
        disk = self.folder / "disk"
        disk.mkdir()
        bytes_of_disk = (self.folder / "whole.h5").stat().st_size // 2
        script = f"mount -t tmpfs -o size={bytes_of_disk} tmpfs $DISK; " + commands
        return subprocess.run(
            ["unshare", "--map-root-user", "--mount", "bash", "-c", script], cwd=self.folder,
            env=ENVIRONMENT | {"DISK": str(disk), "OVERTURN": OVERTURN}, timeout=PATIENCE,
            capture_output=True, text=True)


class AFullDisk(OnSmallDisk):
    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0)
        self.whole = self.folder / "whole.h5"

    def test_is_detected_before_computing(self):
        result = self.on_small_disk("$OVERTURN run small.toml -o $DISK/out.h5; code=$?;"
                                    "[[ -z $(ls $DISK) ]] || exit 1; exit $code")
        size = self.whole.stat().st_size
        self.assert_exit(result, 74, "it takes 2", "bytes, but", "are available. Free some space")
        needed = int(result.stderr.split("it takes ")[1].split()[0])
        self.assertLess(abs(needed - size), 0.03 * size + 32768)

    def test_does_not_prevent_resuming_once_there_is_space(self):
        result = self.on_small_disk(
            "$OVERTURN run small.toml -o $DISK/out.h5; [[ $? == 74 ]] || exit 1;"
            "mount -o remount,size=64m $DISK; $OVERTURN run small.toml -o $DISK/out.h5 &&"
            "cmp $DISK/out.h5 whole.h5")
        self.assert_exit(result, 0)

    def test_is_warned_of_if_only_the_sidecar_does_not_fit(self):
        self.forget_a_tile("unfinished.h5")
        result = self.on_small_disk(
            "mount -o remount,size=64m $DISK; cp unfinished.h5 $DISK/out.h5;"
            "(cat /dev/zero >$DISK/filler) 2>/dev/null;"
            "$OVERTURN run small.toml -o $DISK/out.h5; code=$?; $OVERTURN verify $DISK/out.h5;"
            "[[ ! -e $DISK/out.h5.json ]] || exit 1; exit $code")
        self.assert_exit(result, 0, "overturn: warning: cannot write", "out.h5.json", "no space left on device",
                         "24 of 24 tiles are done; coordinates and checksums match")

    def test_is_stated_by_a_plan(self):
        result = self.on_small_disk(
            "$OVERTURN check small.toml -o $DISK/out.h5; $OVERTURN check small.toml --json -o $DISK/out.h5 >plan.json;"
            "(cat /dev/zero >$DISK/filler) 2>/dev/null;"
            "$OVERTURN check small.toml --json -o $DISK/out.h5 >full.json; ls $DISK")
        self.assert_exit(result, 0, "overturn: warning: the file takes", "are available in")
        self.assertEqual(result.stdout.splitlines()[-1], "filler")
        plan = json.loads((self.folder / "plan.json").read_text())
        self.assertFalse(plan["fits"])
        self.assertLess(plan["free_bytes"], plan["file_bytes"])
        self.assertIn("the file takes", plan["warnings"][0])
        full = json.loads((self.folder / "full.json").read_text())
        self.assertEqual([full["free_bytes"], full["fits"], full["creation_seconds"]], [0, False, None])

    def forget_a_tile(self, name):
        shutil.copy(self.whole, self.folder / name)
        self.forget(name, 3)

    def test_that_is_read_only_is_reported_when_resuming(self):
        self.forget_a_tile("unfinished.h5")
        result = self.on_small_disk(
            "mount -o remount,size=64m $DISK; cp unfinished.h5 $DISK/out.h5;"
            "mount -o remount,ro $DISK; $OVERTURN run small.toml -o $DISK/out.h5")
        self.assert_exit(result, 74, "not writable: read-only file system")


def handles(pid, number):
    """Whether a process that runs has a handler for a signal."""
    caught = re.search(r"^SigCgt:\s*(\w+)$", pathlib.Path(f"/proc/{pid}/status").read_text(), re.MULTILINE)
    return bool(int(caught[1], 16) >> number - 1 & 1)


class ASlowDisk(OnFaultyDisk):
    """A disk from which a complete file is read for seconds before a run knows that no tile is
    missing: its metadata, then the values of all tiles."""

    DELAYS = (0, 0.4, 1)  # of the signal, after the program handles it [s]

    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)

    def end_by(self, number, delay):
        settings = {name: str(value) for name, value in self.settings_of({"READ_TAKES": 12}).items()}
        with self.start("run", "small.toml", "-o", "out.h5", variables=settings) as run:
            while not handles(run.pid, signal.SIGUSR1):  # the start may take long
                time.sleep(0.001)
            time.sleep(delay)
            run.send_signal(number)
            sent = time.monotonic()
            code = run.wait(timeout=PATIENCE)
            return code, time.monotonic() - sent

    def test_does_not_prevent_resuming_a_killed_run(self):
        for delay in self.DELAYS:
            code, _ = self.end_by(signal.SIGKILL, delay)
            self.assertEqual(code, -signal.SIGKILL)
            self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0, "already complete")
            self.assertEqual(self.files(), ["long.toml", "out.h5", "out.h5.json", "small.toml"])

    def test_does_not_prevent_stopping_a_run(self):
        for delay in self.DELAYS:
            code, seconds = self.end_by(signal.SIGUSR1, delay)
            self.assertEqual(code, 85)
            self.assertLess(seconds, 2)


class AFileThatChanges(Scratch):
    def tiles_done(self, name):
        told = words(self.overturn("info", name).stdout)
        return int(told.split(" tiles ")[1].split(" of ")[0]) if " tiles " in told else 0

    def end_of_run_after(self, change, ranks, stays_slow=False):
        """Returns the output of a run after the change, which is made when some tiles are done."""
        output = self.folder / "long.h5"
        output.unlink(missing_ok=True)
        with self.start("run", "long.toml", ranks=ranks, variables=self.with_slow("long.h5")) as process:
            self.assertIn("tiles", process.stdout.readline())
            while self.tiles_done(output.name) < 3:
                self.assertIsNone(process.poll(), "the run ended too early")
            change(output)
            if not stays_slow:
                self.go_on()
            said, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 74, said)
        return words(said)

    def test_is_reported_if_it_is_removed(self):
        for ranks in (None, 2):
            said = self.end_of_run_after(lambda path: path.unlink(), ranks)
            self.assertIn("was removed, moved or replaced during the run", said)

    def test_is_reported_if_moved_and_resumes_once_moved_back(self):
        elsewhere = self.folder / "long.h5.part"  # writes to a file of this name are slow, too
        said = self.end_of_run_after(lambda path: path.rename(elsewhere), 2, stays_slow=True)
        self.assertIn("move it back and run the same command again to resume", said)
        elsewhere.rename(self.folder / "long.h5")
        self.assert_exit(self.overturn("run", "long.toml", ranks=2), 0, "resuming: ")
        self.assert_exit(self.overturn("verify", "long.h5"), 0, f"{LONG_TILES} of {LONG_TILES} tiles are done")

    def test_is_reported_if_it_is_replaced(self):
        def replace(path):
            path.unlink()
            path.write_text("somebody else's")

        self.end_of_run_after(replace, None)
        self.assertEqual((self.folder / "long.h5").read_text(), "somebody else's")

    def test_is_reported_if_it_is_truncated(self):
        said = self.end_of_run_after(lambda path: os.truncate(path, 100_000), 2)
        self.assertIn("was truncated from", said)
        self.assert_exit(self.overturn("run", "long.toml"), 74, "long.h5")

    def test_is_refused_if_a_coordinate_has_changed(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0)
        for name in ("frequency", "slenderness", "restitution"):
            with h5py.File(self.folder / "small.h5", "r+") as file:
                kept = file[name][...]
                file[name][...] = np.nextafter(kept, np.inf)
            for command in (["verify", "small.h5"], ["run", "small.toml"]):
                self.assert_exit(self.overturn(*command), 74,
                                 f"damaged: the values of its coordinates have changed: {name}.")
            with h5py.File(self.folder / "small.h5", "r+") as file:
                file[name][...] = kept
        self.assert_exit(self.overturn("verify", "small.h5"), 0)


class AnUnreadableFile(OnFaultyDisk):
    """A file at which the HDF5 library crashes."""

    def test_is_reported_as_damaged_by_every_command(self):
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5"), 0)
        before = checksum(self.folder / "out.h5")
        for command in (["info", "out.h5"], ["verify", "out.h5"], ["run", "small.toml", "-o", "out.h5"],
                        ["history", "small.toml", "--at", "frequency=3,amplitude=1.5,restitution_of_maximum=0.7",
                         "-o", "out.h5"]):  # fmt: skip
            result = self.overturn_on_faulty_disk(*command, CRASH_AT_READ=1)
            self.assert_exit(result, 74, '"out.h5" is damaged: the HDF5 library crashes')
        # In either phase: when the values of all tiles are verified, and when a run reads the
        # metadata.
        for read in (32, 64, 128, 192):
            result = self.overturn_on_faulty_disk("verify", "out.h5", CRASH_AT_READ=read)
            self.assert_exit(result, 74, '"out.h5" is damaged: the HDF5 library crashes')
        for read, ranks in ((1, 2), (8, None), (16, None), (32, 2), (64, None)):
            result = self.overturn_on_faulty_disk("run", "small.toml", "-o", "out.h5", ranks=ranks,
                                                  CRASH_AT_READ=read)
            self.assert_exit(result, 74, '"out.h5" is damaged: the HDF5 library crashes')
        self.assertEqual(checksum(self.folder / "out.h5"), before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
