"""The program as its users meet it: driven from outside, judged by exit code, words and bytes.

Wants OVERTURN (the binary) and MPIEXEC in the environment; arguments are names of test classes.
"""

import hashlib
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

OVERTURN = os.environ["OVERTURN"]
MPIEXEC = os.environ["MPIEXEC"]
PATIENCE = 60  # [s] for one run of the program; the longest takes some seconds

ENVIRONMENT = {
    **os.environ,
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
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
# 3 x 9 x 9 tiles: some seconds, so that a signal comes in the midst of them.
LONG = JOB.format(columns=576, rows=576, restitutions="[0.7, 0.85, 1.0]", tolerance="1e-12")


def checksum(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def under_mpi(ranks):
    return [MPIEXEC, "--oversubscribe", "-n", str(ranks)]


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

    def assert_refused(self, code, phrases, *arguments, ranks=None):
        """The exit code, one message with the phrases in it, and nothing written."""
        before = self.files()
        result = self.overturn(*arguments, ranks=ranks)
        self.assert_exit(result, code, *phrases)
        self.assertEqual(result.stderr.count("overturn: "), 1, result.stderr)
        self.assertEqual(self.files(), before)


class TheCommandLine(Scratch):
    def test_help_teaches_each_subcommand_by_an_example(self):
        for subcommand in ("run", "check", "info"):
            self.assert_exit(self.overturn("--help"), 0, f"overturn {subcommand} ")
            self.assert_exit(self.overturn(subcommand, "--help"), 0, f"overturn {subcommand} ")

    def test_version_names_what_results_depend_on(self):
        result = self.overturn("--version")
        self.assert_exit(result, 0, "overturn ", "commit", "kernel", "MPI", "HDF5 1.")

    def test_an_unknown_subcommand_is_a_usage_error(self):
        self.assert_refused(2, ["rum", "--help"], "rum", "small.toml")

    def test_no_subcommand_is_a_usage_error(self):
        self.assert_refused(2, ["subcommand", "--help"])

    def test_a_missing_job_argument_is_a_usage_error(self):
        self.assert_refused(2, ["JOB", "--help"], "run")

    def test_an_unknown_option_is_a_usage_error(self):
        self.assert_refused(2, ["--fast", "--help"], "run", "small.toml", "--fast")

    def test_an_unknown_kernel_is_a_usage_error(self):
        self.assert_refused(2, ["sse2", "avx512"], "run", "small.toml", "--kernel", "sse2")

    def test_a_launcher_that_mpi_does_not_know_is_a_usage_error(self):
        # As srun --mpi=none would start four ranks that each compute everything.
        result = self.overturn("run", "small.toml", shell_setup="export SLURM_STEP_NUM_TASKS=4")
        self.assert_exit(result, 2, "4 processes", "MPI found 1", "srun --mpi=pmix")
        self.assertNotIn("small.h5", self.files())


class ABadJob(Scratch):
    def test_a_missing_job_file_is_named(self):
        self.assert_refused(65, ["nowhere.toml"], "run", "nowhere.toml")

    def test_toml_that_does_not_parse_is_located(self):
        (self.folder / "broken.toml").write_text("[scene\n")
        self.assert_refused(65, ["broken.toml:1"], "run", "broken.toml")

    def test_an_unknown_key_is_told_with_what_was_meant(self):
        misspelt = SMALL.replace("slenderness", "slendernes")
        (self.folder / "misspelt.toml").write_text(misspelt)
        self.assert_refused(65, ["slendernes", "slenderness"], "run", "misspelt.toml")

    def test_a_value_out_of_range_is_refused_before_anything_is_computed(self):
        override = "plane.restitution={ values = [1.2], of = 'absolute' }"
        self.assert_refused(65, ["1.2"], "run", "small.toml", "--set", override)

    def test_check_refuses_what_run_refuses(self):
        self.assert_refused(65, ["3"], "check", "small.toml", "--set", "numerics.tolerance=3")


class ABadOutput(Scratch):
    def test_a_missing_folder_is_refused(self):
        self.assert_refused(74, ["nowhere"], "run", "small.toml", "-o", "nowhere/out.h5")

    def test_a_folder_that_cannot_be_written_is_refused(self):
        self.assert_refused(74, ["/proc"], "run", "small.toml", "-o", "/proc/out.h5")

    def test_a_file_in_place_of_a_folder_is_refused(self):
        self.assert_refused(74, ["small.toml/"], "run", "small.toml", "-o", "small.toml/out.h5")

    def test_a_folder_in_place_of_a_file_is_refused(self):
        (self.folder / "out.h5").mkdir()
        self.assert_refused(74, ["out.h5"], "run", "small.toml", "-o", "out.h5")

    def test_a_file_that_is_not_ours_is_never_overwritten(self):
        (self.folder / "notes.txt").write_text("not to be lost")
        self.assert_refused(74, ["notes.txt"], "run", "small.toml", "-o", "notes.txt")
        self.assertEqual((self.folder / "notes.txt").read_text(), "not to be lost")

    def test_the_file_of_another_job_stays_as_it_is(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0)
        before = checksum(self.folder / "small.h5")
        self.assert_refused(
            74, ["small.h5", "job"], "run", "small.toml", "--set", "numerics.tolerance=1e-5"
        )
        self.assertEqual(checksum(self.folder / "small.h5"), before)

    def test_a_plane_too_large_for_the_disk_is_refused_at_once(self):
        self.assert_refused(
            74, ["small.h5"], "run", "small.toml",
            "--set", "plane.frequency={ first = 0.5, last = 8.0, count = 10_000_000 }",
            "--set", "plane.amplitude={ first = 0.5, last = 12.0, count = 1_000_000 }",
        )  # fmt: skip

    def test_a_limit_of_file_sizes_is_a_message_not_a_crash(self):
        result = self.overturn("run", "small.toml", shell_setup="ulimit -f 100")
        self.assert_exit(result, 74, "overturn: ", "small.h5")
        self.assertNotIn("small.h5", self.files())

    def test_info_refuses_what_is_not_there_or_not_ours(self):
        self.assert_refused(74, ["nowhere.h5"], "info", "nowhere.h5")
        self.assert_refused(74, ["small.toml"], "info", "small.toml")


class UnderMpirun(Scratch):
    """What rank 0 finds wrong is said once, and mpirun returns its exit code."""

    def test_help_is_printed_once(self):
        result = self.overturn("--help", ranks=3)
        self.assert_exit(result, 0)
        self.assertEqual(result.stdout.count("Usage:"), 1)

    def test_a_usage_error_ends_all_ranks(self):
        self.assert_refused(2, ["--fast"], "run", "small.toml", "--fast", ranks=3)

    def test_a_bad_job_ends_all_ranks(self):
        self.assert_refused(65, ["nowhere.toml"], "run", "nowhere.toml", ranks=3)

    def test_a_bad_output_ends_all_ranks(self):
        self.assert_refused(74, ["nowhere"], "run", "small.toml", "-o", "nowhere/o.h5", ranks=3)

    def test_ranks_that_read_different_jobs_do_not_mix_them(self):
        # As when a folder is not shared between two hosts: one copy of the job is older.
        setup = 'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then set -- "$1" run long.toml -o out.h5; fi'
        result = self.overturn("run", "small.toml", "-o", "out.h5", ranks=2, shell_setup=setup)
        self.assert_exit(result, 65, "rank 1: long.toml is another job here than on rank 0")


class AFinishedFile(Scratch):
    def test_the_output_is_named_after_the_job_in_the_working_directory(self):
        (self.folder / "jobs").mkdir()
        (self.folder / "small.toml").rename(self.folder / "jobs" / "small.toml")
        self.assert_exit(self.overturn("run", "jobs/small.toml"), 0, "small.h5")
        self.assertIn("small.h5", self.files())

    def test_running_again_says_so_and_changes_nothing(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0, "24 tiles", "60.0 k points")
        before = checksum(self.folder / "small.h5")
        for ranks in (None, 3):
            result = self.overturn("run", "small.toml", ranks=ranks)
            self.assert_exit(result, 0, "small.h5 is complete already")
            self.assertEqual(checksum(self.folder / "small.h5"), before)

    def test_info_tells_what_it_holds(self):
        self.overturn("run", "small.toml")
        result = self.overturn("info", "small.h5")
        self.assert_exit(
            result, 0, "A small plane", "24 of 24 done", "200 values from 0.5 to 8", "region, uint8"
        )
        self.assertNotIn("unfinished", result.stdout)

    def test_the_sidecar_tells_each_ranks_share(self):
        self.assert_exit(self.overturn("run", "small.toml", ranks=3), 0, "3 ranks")
        sidecar = json.loads((self.folder / "small.h5.json").read_text())
        self.assertEqual(len(sidecar["ranks"]), 3)
        self.assertEqual(sum(rank["tiles"] for rank in sidecar["ranks"]), 24)


class Check(Scratch):
    def test_it_tells_the_plane_its_size_and_its_time_and_writes_nothing(self):
        before = self.files()
        result = self.overturn("check", "small.toml")
        self.assert_exit(
            result, 0, "A small plane", "one_sine", "60.0 k in 24 tiles", "on one rank",
            "region, 60.0 kB", "angle, 480 kB",
        )  # fmt: skip
        self.assertNotIn("window", result.stdout)
        self.assertEqual(self.files(), before)

    def test_it_tells_what_the_window_cuts_off_a_ricker_wavelet(self):
        # |f| at 2 pi, over the peak: 19 exp(-pi^2) and z (z^2 - 3) exp(-z^2/2) / 1.38, z = 2 pi/sqrt 3.
        for pulse, cut in (("symmetric_ricker", "0.097 %"), ("antisymmetric_ricker", "3.7 %")):
            result = self.overturn("check", "small.toml", "--set", f"scene.pulse={pulse}")
            self.assert_exit(result, 0, pulse, cut)

    def test_its_time_is_of_the_right_size(self):
        text = words(self.overturn("check", "long.toml").stdout)
        number, unit = text.split("about ")[1].split(" on one rank")[0].split(" ")
        estimate = float(number) * {"ms": 0.001, "s": 1}[unit]
        start = time.monotonic()
        self.assert_exit(self.overturn("run", "long.toml"), 0)
        taken = time.monotonic() - start
        # A busy machine is easily wrong by 2; minutes for seconds, or one rank for many, by more.
        self.assertLess(taken, 4 * estimate)
        self.assertGreater(taken, estimate / 4)


class EqualJobs(Scratch):
    def test_give_equal_bytes_on_any_number_of_ranks(self):
        for ranks in (1, 2, 3, 5):
            output = f"{ranks}.h5"
            self.assert_exit(self.overturn("run", "small.toml", "-o", output, ranks=ranks), 0)
            self.assertEqual(checksum(self.folder / output), checksum(self.folder / "1.h5"))

    def test_give_equal_bytes_with_any_kernel(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0)
        for kernel in ("double", "avx2", "avx512"):
            output = f"{kernel}.h5"
            result = self.overturn("run", "small.toml", "-o", output, "--kernel", kernel)
            if result.returncode == 2:  # this machine lacks it
                self.assert_exit(result, 2, "does not run on this processor")
                self.assertNotEqual(kernel, "double")
                continue
            self.assert_exit(result, 0, f"kernel {kernel}")
            self.assertEqual(checksum(self.folder / output), checksum(self.folder / "small.h5"))


class AnInterruptedRun(Scratch):
    whole = None  # checksum of the uninterrupted file

    def setUp(self):
        super().setUp()
        if AnInterruptedRun.whole is None:
            self.assert_exit(self.overturn("run", "long.toml", "-o", "whole.h5", ranks=2), 0)
            AnInterruptedRun.whole = checksum(self.folder / "whole.h5")

    def tiles_done(self):
        text = words(self.overturn("info", "long.h5").stdout)
        return int(text.split(" tiles ")[1].split(" of ")[0])

    def start(self, ranks=None):
        """Starts the long job, and returns when some of its tiles are done."""
        command = [OVERTURN, "run", "long.toml"]
        before = self.tiles_done() if "long.h5" in self.files() else 0
        process = subprocess.Popen(
            (under_mpi(ranks) if ranks else []) + command, cwd=self.folder, env=ENVIRONMENT,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + PATIENCE
        while "long.h5" not in self.files() or self.tiles_done() < before + 3:
            self.assertLess(time.monotonic(), deadline, "no tiles came")
            self.assertIsNone(process.poll(), "ended before it could be interrupted")
        return process

    def rank_processes(self, launcher):
        children = pathlib.Path(f"/proc/{launcher.pid}/task/{launcher.pid}/children")
        return [int(pid) for pid in children.read_text().split()]

    def wait_for_end(self, pids):
        deadline = time.monotonic() + PATIENCE
        while any(pathlib.Path(f"/proc/{pid}").exists() for pid in pids):
            self.assertLess(time.monotonic(), deadline, "ranks outlive their launcher")
            time.sleep(0.05)

    def assert_resumes(self, ranks):
        """With this number of ranks: goes on, ends, and nobody can tell from the bytes."""
        done = self.tiles_done()
        self.assertGreaterEqual(done, 3)
        self.assertLess(done, 243, "was interrupted too late to show anything")
        info = self.overturn("info", "long.h5")
        self.assert_exit(info, 0, f"{done} of 243 done", "overturn run JOB.toml -o long.h5")
        result = self.overturn("run", "long.toml", ranks=ranks)
        self.assert_exit(result, 0, f"going on, {done} of 243 tiles are there")
        self.assertEqual(checksum(self.folder / "long.h5"), self.whole)

    def test_resumes_after_sigusr1_to_mpirun(self):
        process = self.start(ranks=3)
        process.send_signal(signal.SIGUSR1)
        output, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 85, output)
        self.assertIn("stopped by a signal", output)
        self.assertIn("Run the same command again to resume", output)
        self.assert_resumes(ranks=2)

    def test_resumes_after_a_signal_to_one_rank_only(self):
        process = self.start(ranks=3)
        os.kill(self.rank_processes(process)[-1], signal.SIGUSR1)
        output, _ = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 85, output)
        self.assert_resumes(ranks=5)

    def test_stops_alone_on_each_polite_signal(self):
        for polite in (signal.SIGUSR1, signal.SIGTERM, signal.SIGINT):
            process = self.start()
            process.send_signal(polite)
            output, _ = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 85, output)
        self.assert_resumes(ranks=None)

    def test_resumes_after_the_death_of_mpirun(self):
        process = self.start(ranks=2)
        ranks = self.rank_processes(process)
        process.kill()
        process.communicate(timeout=PATIENCE)
        self.wait_for_end(ranks)
        self.assert_resumes(ranks=3)

    def test_resumes_after_the_death_of_a_rank(self):
        process = self.start(ranks=3)
        ranks = self.rank_processes(process)
        os.kill(ranks[1], signal.SIGKILL)
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(process.returncode, 0)
        self.wait_for_end(ranks)
        self.assert_resumes(ranks=None)

    def test_resumes_after_a_rank_could_not_write(self):
        process = self.start(ranks=2)
        process.send_signal(signal.SIGUSR1)
        process.communicate(timeout=PATIENCE)
        # In blocks of 512 bytes: less than the file has already, so that its far end is out of reach.
        for ranks in (None, 3):
            result = self.overturn("run", "long.toml", ranks=ranks, shell_setup="ulimit -f 12000")
            self.assert_exit(result, 74, "cannot write tile", "Run the same command again")
            if ranks is not None:
                self.assertRegex(result.stderr, r"rank [0-2]: cannot write tile")
        self.assert_resumes(ranks=2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
