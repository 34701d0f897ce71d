"""Runs that are stopped or killed: no tile is lost, and the same command resumes them."""

import os
import pathlib
import signal
import time
import unittest

from program import LONG_TILES, PATIENCE, Scratch, checksum, is_mpich, ranks_of, words


class ScratchWithRuns(Scratch):
    whole = None  # checksum of the uninterrupted file

    def setUp(self):
        super().setUp()
        if ScratchWithRuns.whole is None:
            self.assert_exit(self.overturn("run", "long.toml", "-o", "whole.h5", ranks=2), 0)
            ScratchWithRuns.whole = checksum(self.folder / "whole.h5")

    def tiles_done(self):
        text = words(self.overturn("info", "long.h5").stdout)
        return int(text.split(" tiles ")[1].split(" of ")[0])

    def start_long_run(self, ranks=None):
        """Starts the long job, and returns when some of its tiles are done."""
        before = self.tiles_done() if "long.h5" in self.files() else 0
        # Fewer tiles remain after each interruption, and a busy machine interrupts late.
        slow = self.with_slow("long.h5", milliseconds=16 if before else 4)
        process = self.start("run", "long.toml", ranks=ranks, variables=slow)
        deadline = time.monotonic() + PATIENCE
        while "long.h5" not in self.files() or self.tiles_done() < before + 3:
            time.sleep(0.02)
            self.assertLess(time.monotonic(), deadline, "no tiles were computed")
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted")
        return process

    def wait_for_end(self, pids):
        deadline = time.monotonic() + PATIENCE
        while any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids):
            self.assertLess(time.monotonic(), deadline, "ranks outlived their launcher")
            time.sleep(0.05)

    def assert_can_be_resumed(self):
        """Returns the number of tiles that are done: some, but not all."""
        done = self.tiles_done()
        self.assertGreaterEqual(done, 3)
        self.assertLess(done, LONG_TILES, "the run was interrupted too late")
        info = self.overturn("info", "long.h5")
        self.assert_exit(info, 0, f"{done} of {LONG_TILES} done", "overturn run JOB.toml -o long.h5")
        return done

    def assert_resumes(self, ranks):
        """Resumes with this number of ranks; the file must equal that of an uninterrupted run."""
        done = self.assert_can_be_resumed()
        result = self.overturn("run", "long.toml", ranks=ranks)
        self.assert_exit(result, 0, f"resuming: {done} of {LONG_TILES} tiles done")
        self.assertEqual(checksum(self.folder / "long.h5"), self.whole)


class AnInterruptedRun(ScratchWithRuns):
    def test_is_not_affected_by_a_second_run_of_the_same_job(self):
        process = self.start_long_run()
        (self.folder / "link.h5").symlink_to("long.h5")
        for name in ("long.h5", "link.h5"):
            result = self.overturn("run", "long.toml", "-o", name)
            self.assert_exit(result, 74, "being written by another run")
        self.go_on()
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(checksum(self.folder / "long.h5"), self.whole)
        self.assertNotIn("long.h5.lock", self.files())

    def test_resumes_after_one_interruption_after_the_other(self):
        for interrupt in (self.send_sigusr1_to_mpirun, self.send_sigusr1_to_one_rank, self.kill_mpirun,
                          self.kill_a_rank, self.fail_to_write):
            with self.subTest(interrupt.__name__):
                interrupt()
                self.assert_can_be_resumed()
        self.assert_resumes(ranks=2)

    def send_sigusr1_to_mpirun(self):
        process = self.start_long_run(ranks=3)
        process.send_signal(signal.SIGUSR1)
        output, _ = process.communicate(timeout=PATIENCE)
        self.assert_stopped(process.returncode, output, ranks=3)
        self.assertIn("stopped by a signal", output)
        self.assertIn("Run the same command again to resume", output)

    def send_sigusr1_to_one_rank(self):
        process = self.start_long_run(ranks=5)
        os.kill(ranks_of(process.pid)[-1], signal.SIGUSR1)
        output, _ = process.communicate(timeout=PATIENCE)
        self.assert_stopped(process.returncode, output, ranks=5)
        self.assertIn("resuming: ", output)

    def kill_mpirun(self):
        process = self.start_long_run(ranks=2)
        ranks = ranks_of(process.pid)
        process.kill()
        process.communicate(timeout=PATIENCE)
        self.wait_for_end(ranks)

    def kill_a_rank(self):
        process = self.start_long_run(ranks=3)
        ranks = ranks_of(process.pid)
        os.kill(ranks[1], signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.wait_for_end(ranks)

    def fail_to_write(self):
        # In blocks of 512 bytes: less than the size of the file, so that its end cannot be written.
        for ranks in (None, 3):
            result = self.overturn("run", "long.toml", ranks=ranks, shell_setup="ulimit -f 12000")
            if ranks is not None and is_mpich() and result.returncode == 9:
                result.returncode = 74  # its launcher killed the rank that had not failed
            self.assert_exit(result, 74, "cannot write tile", "Run the same command again")
            if ranks is not None:
                self.assertRegex(result.stderr, r"rank [0-2]: cannot write tile")

    def test_stops_without_mpirun_on_each_handled_signal(self):
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the tests may have been started by nohup
        for polite in (signal.SIGUSR1, signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            process = self.start_long_run()
            process.send_signal(polite)
            output, _ = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 85, output)
        self.assert_resumes(ranks=None)

    @unittest.skipIf(is_mpich(), "its UCX handles SIGHUP before main() begins")
    def test_continues_without_a_terminal_if_sighup_is_ignored(self):
        slow = " ".join(f"{name}={value}" for name, value in self.with_slow("long.h5").items())
        ignored = f"trap '' HUP; (sleep 1; kill -HUP $$; rm {self.slow}) & export {slow}"
        self.assert_exit(self.overturn("run", "long.toml", shell_setup=ignored), 0)

    def test_continues_when_its_output_is_closed(self):
        for ranks in (None,) if is_mpich() else (None, 2):  # its launcher is terminated by SIGPIPE
            with self.start("run", "small.toml", ranks=ranks) as process:
                process.stdout.close()
                self.assertEqual(process.wait(timeout=PATIENCE), 0)
            (self.folder / "small.h5.json").unlink()
            self.assert_exit(self.overturn("verify", "small.h5"), 0)
            (self.folder / "small.h5").unlink()


class AStopInTime(ScratchWithRuns):
    def test_stops_at_once_while_its_file_is_created(self):
        command = ["run", "long.toml", "-o", "large.h5", "--set=output.fields=['region']",
                   "--set=plane.restitution_of_maximum=0.7", "--set=plane.frequency.count=32000",
                   "--set=plane.amplitude.count=32000"]
        for ranks in (None, 2):
            before = self.files()
            with self.start(*command, ranks=ranks) as process:
                self.assertIn("creating a file of 1", process.stdout.readline())
                time.sleep(0.5)  # creation takes one to two seconds
                process.send_signal(signal.SIGUSR1)
                sent = time.monotonic()
                said = process.stdout.readline()
                while said and "before the file was created" not in said:
                    said = process.stdout.readline()
                # MPI takes another second or two to finalize.
                self.assertLess(time.monotonic() - sent, 2, said)
                output, _ = process.communicate(timeout=PATIENCE / 2)
            self.assert_stopped(process.returncode, said + output, ranks)
            self.assertIn("before the file was created", said)
            self.assertEqual(self.files(), before)


class ASlowTile(ScratchWithRuns):
    def test_is_abandoned_by_a_stop_although_it_would_take_minutes(self):
        # Without loss, these blocks bounce until the limit of steps. One point of the scan of a
        # boundary takes a second or two because it is resolved.
        slow = ("--set", "plane.restitution=1.0",
                *(f"--set=plane.{axis}.{end}={value}"
                  for axis, first, last in (("frequency", 0.003, 0.0031),
                                            ("amplitude", 1.000001, 1.000002))
                  for end, value in (("first", first), ("last", last), ("count", 64))))
        for product in ("run", "boundary"):
            for ranks in (None, 2):
                with self.start(product, "long.toml", "-o", f"slow_{product}.h5", *slow,
                                ranks=ranks) as process:
                    self.assertIn("r = 1 is above r_max", process.stdout.readline())
                    self.assertRegex(process.stdout.readline(), "in (1 tile|[0-9]+ tiles);")
                    process.send_signal(signal.SIGUSR1)
                    output, _ = process.communicate(timeout=PATIENCE / 2)
                    self.assert_stopped(process.returncode, output, ranks)
                    self.assertRegex(output, "stopped by a signal; tiles missing: ([0-9]+) of \\1")


if __name__ == "__main__":
    unittest.main(verbosity=2)
