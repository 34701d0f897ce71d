"""Refusals of overturn, with messages and exit codes, and its help."""

import os
import re
import socket
import subprocess
import unittest

from program import (ENVIRONMENT, LONG_TILES, MPIEXEC, OVERTURN, PATIENCE, SMALL, Scratch, checksum,
                     is_mpich)

A_HISTORY = ["history", "small.toml", "--at", "frequency=3,amplitude=1.5,restitution_of_maximum=0.7"]


class TheCommandLine(Scratch):
    def test_help_shows_an_example_of_each_subcommand(self):
        for subcommand in ("run", "check", "info", "keys"):
            self.assert_exit(self.overturn("--help"), 0, f"overturn {subcommand} ")
            self.assert_exit(self.overturn(subcommand, "--help"), 0, f"overturn {subcommand} ")

    def test_version_lists_what_results_depend_on(self):
        result = self.overturn("--version")
        self.assert_exit(result, 0, "overturn ", "commit", "kernel", "MPI", "HDF5 1.")

    def test_doctor_prints_what_a_bug_report_should_contain(self):
        self.assert_exit(self.overturn("doctor", str(self.folder)), 0, "overturn ", "commit", "kernels double: yes",
                         "MPI", "HDF5 1.", "processor", f"folder {self.folder}", "file system", "free space")
        self.assert_refused(2, ["nowhere is not a folder"], "doctor", "nowhere")

    def test_doctor_tells_what_each_python_can_import(self):
        def doctor(lines):
            return self.overturn("doctor", shell_setup="mkdir -p bin; printf '#!/bin/sh\\n%s\\n' "
                                 f"'{lines}' > bin/python3; chmod +x bin/python3; PATH=$PWD/bin:$PATH")
        self.assert_exit(doctor('echo /another/python3; echo "version 3.9.1; lacks numpy"'), 0,
                         "Python ", "overturn._core", "python3 /another/python3: version 3.9.1; lacks numpy")
        self.assert_exit(doctor("exit 1"), 0, "python3 cannot be started")

    def test_keys_prints_those_of_a_table_or_of_a_name(self):
        every = self.overturn("keys")
        self.assert_exit(every, 0, "scene.pulse", "numerics.tolerance", "plane.pga", "output.fields")
        tolerance = self.overturn("keys", "tolerance")
        self.assert_exit(tolerance, 0, "numerics.tolerance ",
                         "number: [1e-14, 0.01]; default: 1e-09; 0.0001 with resolve")
        self.assertEqual(tolerance.stdout, self.overturn("keys", "numerics.tolerance").stdout)
        self.assertIn(tolerance.stdout, every.stdout)
        self.assertEqual(len(self.overturn("keys", "numerics", "--markdown").stdout.splitlines()), 5)
        self.assert_refused(2, ['unknown key "numerics.tolerence". Did you mean "numerics.tolerance"?'], "keys",
                            "numerics.tolerence")

    def test_help_is_a_subcommand_too(self):
        for words in ((), ("run",)):
            asked = self.overturn("help", *words)
            self.assert_exit(asked, 0)
            self.assertEqual(asked.stdout, self.overturn(*words, "--help").stdout)

    def test_an_unknown_option_is_reported_with_the_one_that_is_probably_meant(self):
        self.assert_refused(2, ["--widht", "Did you mean \"--width\"?"], "topple", "--widht", "0.4", "--height", "1")
        self.assert_refused(2, ["--pga_max=2", "Did you mean \"--pga-max\"?"], "assess", "t.csv", "--pga_max=2")

    def test_a_decimal_comma_is_reported_with_the_number_to_write(self):
        advice = "Numbers have a decimal point: write 0.42 instead of 0,42."
        for subcommand, at_least in (("topple", 19), ("assess", 3)):
            options = re.findall(r"^  (--[a-z-]+) (?:M|RAD|NUMBER|DEGREES|S|G|X|R|E)\b(?!,)",
                                 self.overturn(subcommand, "--help").stdout, re.MULTILINE)
            self.assertGreaterEqual(len(options), at_least)
            for option in options:
                for given in ((option, "0,42"), (f"{option}=0,42",)):
                    self.assert_refused(2, [option, advice], subcommand, *["t.csv"] * (subcommand == "assess"), *given)
        self.assert_refused(2, ["--period: 0 is", advice], "assess", "t.csv", "--period", "0,42")
        self.assert_refused(2, ["--until", advice], *A_HISTORY, "-o", "h.h5", "--until", "0,42")
        self.assert_refused(2, ["--at 42", advice], "history", "small.toml", "-o", "h.h5", "--at", "frequency=0,42")
        self.assert_refused(2, ["--points", "write 10.000 or 10000 instead"], "accuracy", "small.toml", "-o", "a.h5",
                            "--points", "10,000")
        self.assert_refused(65, ["--set plane.amplitude=0,42", advice], "check", "small.toml", "--set",
                            "plane.amplitude=0,42")

    def test_an_unknown_value_is_reported_with_a_suggestion(self):
        self.assert_refused(2, ["--kernel: avx is unknown. Did you mean \"avx2\"? Allowed: auto, double,"], "run", "small.toml",
                            "--kernel", "avx")
        self.assert_refused(65, ['--set scene.pulse=ricker: scene.pulse = "ricker" is unknown. Did you mean "symmetric_ricker"?'],
                            "check", "small.toml", "--set", "scene.pulse=ricker")
        self.assert_refused(65, ['Did you mean "symmetric_ricker"?'], "topple", "--width", "1", "--height", "2", "--period",
                            "1", "--pulse", "ricker")

    def test_an_unknown_subcommand_is_reported_with_a_suggestion(self):
        self.assert_refused(2, ["rum", "Did you mean \"run\"?", "--help"], "rum", "small.toml")
        self.assert_refused(2, ["Did you mean \"boundary\"?"], "help", "boundry")

    def test_an_unknown_subcommand_unlike_any_other_is_a_usage_error(self):
        result = self.overturn("compute", "small.toml")
        self.assert_exit(result, 2, "compute", "--help")
        self.assertNotIn("Did you mean", result.stderr)

    def test_that_is_incomplete_or_not_known_is_a_usage_error(self):
        for words, arguments in ((["subcommand", "--help"], []),
                                 (["JOB", "--help"], ["run"]),
                                 (["--fast", "--help"], ["run", "small.toml", "--fast"]),
                                 (["sse2", "avx512"], ["run", "small.toml", "--kernel", "sse2"])):
            self.assert_refused(2, words, *arguments)

    def test_a_launcher_unknown_to_mpi_is_a_usage_error(self):
        # srun --mpi=none would start four ranks that each compute everything.
        result = self.overturn("run", "small.toml", shell_setup="export SLURM_STEP_NUM_TASKS=4")
        self.assert_exit(result, 2, "4 processes", "MPI found 1", "srun --mpi=pmix")
        self.assertNotIn("small.h5", self.files())


class ABadJob(Scratch):
    def test_a_result_file_is_recognized(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0)
        self.assert_refused(65, ["small.h5: this is a result file, not a job file", "-o small.h5"], "run", "small.h5")

    def test_is_refused_before_computing_by_run_and_check(self):
        (self.folder / "broken.toml").write_text("[scene\n")
        (self.folder / "misspelt.toml").write_text(SMALL.replace("slenderness", "slendernes"))
        for words, arguments in (
                (["nowhere.toml"], ["nowhere.toml"]),
                (["broken.toml:1"], ["broken.toml"]),
                (["slendernes", "slenderness"], ["misspelt.toml"]),
                (["1.2"], ["small.toml", "--set", "plane.restitution=1.2"])):
            for command in ("run", "check"):
                self.assert_refused(65, words, command, *arguments)


class ABadOutput(Scratch):
    def test_without_a_folder_that_can_be_written_is_refused(self):
        (self.folder / "out.h5").mkdir()
        for words, output in (("nowhere", "nowhere/out.h5"), ("/proc", "/proc/out.h5"),
                              ("small.toml/", "small.toml/out.h5"), ("out.h5", "out.h5")):
            self.assert_refused(74, [words], "run", "small.toml", "-o", output)

    def test_a_foreign_file_is_never_overwritten(self):
        (self.folder / "notes.txt").write_text("not to be lost")
        self.assert_refused(74, ["notes.txt"], "run", "small.toml", "-o", "notes.txt")
        self.assertEqual((self.folder / "notes.txt").read_text(), "not to be lost")

    def test_a_file_with_the_name_of_its_sidecar_or_lock_is_kept(self):
        for name in ("out.h5.json", "out.h5.lock"):
            (self.folder / name).write_text("not to be lost")
            self.assert_refused(74, [name, "Move it away"], "run", "small.toml", "-o", "out.h5")
            self.assertEqual((self.folder / name).read_text(), "not to be lost")
            (self.folder / name).unlink()
            (self.folder / name).mkdir()
            self.assert_refused(74, [name, "Move it away"], "run", "small.toml", "-o", "out.h5")
            (self.folder / name).rmdir()
        (self.folder / "small.toml").rename(self.folder / "job.json")
        self.assert_refused(74, ["job.json", "Move it away"], "run", "job.json", "-o", "job")

    def test_a_file_with_the_name_of_a_temporary_file_is_kept(self):
        for name in ("out.h5.part", "out.h5.json.part", "out.h5.lock"):
            for content in ("not to be lost", ""):
                (self.folder / name).write_text(content)
                self.assert_refused(74, [name, "Move it away"], "run", "small.toml", "-o", "out.h5")
                self.assertEqual((self.folder / name).read_text(), content)
            if "json" not in name:
                self.assert_refused(74, [name, "Move it away"], *A_HISTORY, "-o", "out.h5")
            (self.folder / name).unlink()

    def test_foreign_files_with_names_used_by_mpi_are_kept(self):
        names = [f"out.h5.{name}" for name in ("data.0", "data.1", "metadata.0", "metadata.1",
                                               "locktest.0", "locktest.1", "lockedfile")]  # fmt: skip
        for name in names:
            (self.folder / name).write_text("not to be lost")
        for ranks in (None, 1, 2):
            self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5", ranks=ranks), 0)
            for name in names:
                self.assertEqual((self.folder / name).read_text(), "not to be lost", name)
            (self.folder / "out.h5").unlink()

    def test_a_dangling_link_is_refused(self):
        for name in ("out.h5", "out.h5.json", "out.h5.lock"):
            (self.folder / name).symlink_to("nowhere")
            self.assert_refused(74, [name], "run", "small.toml", "-o", "out.h5")
            if name == "out.h5":
                self.assert_refused(74, [name], *A_HISTORY, "-o", "out.h5")
            self.assertTrue((self.folder / name).is_symlink())
            (self.folder / name).unlink()

    def test_a_foreign_sidecar_that_appears_during_the_run_is_kept(self):
        with self.start("run", "long.toml", "-o", "out.h5", variables=self.with_slow("out.h5")) as run:
            run.stdout.readline()
            (self.folder / "out.h5.json").write_text("not to be lost")
            self.go_on()
            output, _ = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, 0, output)
        self.assertIn("overturn: warning: \"out.h5.json\" exists but is not the sidecar file of this run", output)
        self.assertEqual((self.folder / "out.h5.json").read_text(), "not to be lost")
        self.assert_exit(self.overturn("verify", "out.h5"), 0, f"{LONG_TILES} of {LONG_TILES} tiles are done")

    def test_a_link_to_a_history_is_kept(self):
        (self.folder / "results").mkdir()
        self.assert_exit(self.overturn(*A_HISTORY, "-o", "results/out.h5"), 0)
        before = checksum(self.folder / "results" / "out.h5")
        (self.folder / "link.h5").symlink_to("results/out.h5")
        self.assert_exit(self.overturn(*A_HISTORY, "-o", "link.h5", "--samples", "100"), 0)
        self.assertTrue((self.folder / "link.h5").is_symlink())
        self.assertNotEqual(checksum(self.folder / "results" / "out.h5"), before)
        self.assertEqual(sorted(path.name for path in (self.folder / "results").iterdir()), ["out.h5"])

    def test_a_lock_that_cannot_be_opened_is_refused(self):
        lock = self.folder / "out.h5.lock"
        with self.start("run", "long.toml", "-o", "out.h5", variables=self.with_slow("out.h5")) as run:
            run.stdout.readline()
            run.kill()
        lock.chmod(lock.stat().st_mode & ~0o777)  # as for the lock of another user
        if os.geteuid() == 0:  # root may open all files
            without = ["setpriv", "--bounding-set=-dac_override,-dac_read_search",
                       "--inh-caps=-dac_override,-dac_read_search"]  # fmt: skip
            if subprocess.run([*without, "true"], capture_output=True).returncode:
                self.skipTest("privileges cannot be dropped")
        else:
            without = []
        result = subprocess.run([*without, OVERTURN, "run", "long.toml", "-o", "out.h5"],
                                cwd=self.folder, env=ENVIRONMENT, timeout=PATIENCE,
                                capture_output=True, text=True)
        self.assert_exit(result, 74, "cannot open the lock", "out.h5.lock\": permission denied")
        self.assertTrue(lock.exists())

    def test_a_path_of_any_length_works_under_mpirun(self):
        for length in (243, 244, 245, 246, 250, 600, 2000):
            folder = self.folder
            while len(str(folder)) < length - 120:
                folder = folder / ("x" * 100)
            folder.mkdir(parents=True, exist_ok=True)
            output = folder / ("y" * (length - len(str(folder)) - 1))
            self.assertEqual(len(str(output)), length)
            self.assert_exit(self.overturn("run", "small.toml", "-o", output, ranks=2), 0)

    def test_a_name_too_long_for_its_companion_files_is_refused_at_once(self):
        refused = 0
        for length in range(243, 257):
            result = self.overturn("run", "small.toml", "-o", "x" * length)
            if result.returncode != 0:
                self.assert_exit(result, 74, "file name too long")
                self.assertNotIn("computed", result.stdout)
                refused += 1
        self.assertGreater(refused, 10)

    def test_the_file_of_another_job_is_unchanged(self):
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

    @unittest.skipIf(is_mpich(), "its UCX needs files of megabytes in /dev/shm")
    def test_a_file_size_limit_causes_a_message_not_a_crash(self):
        result = self.overturn("run", "small.toml", shell_setup="ulimit -f 100")
        self.assert_exit(result, 74, "overturn: ", "small.h5")
        self.assertNotIn("small.h5", self.files())

    def test_info_refuses_missing_and_foreign_files(self):
        self.assert_refused(74, ["nowhere.h5"], "info", "nowhere.h5")
        self.assert_refused(74, ["small.toml"], "info", "small.toml")


class UnderMpirun(Scratch):
    """Errors found by rank 0 are printed once, and mpirun returns its exit code."""

    def test_help_is_printed_once(self):
        result = self.overturn("--help", ranks=3)
        self.assert_exit(result, 0)
        self.assertEqual(result.stdout.count("Usage:"), 1)

    def test_an_error_ends_all_ranks(self):
        for code, words, arguments in ((2, "--fast", ["small.toml", "--fast"]), (65, "nowhere.toml", ["nowhere.toml"]),
                                       (74, "nowhere", ["small.toml", "-o", "nowhere/o.h5"])):
            self.assert_refused(code, [words], "run", *arguments, ranks=3)

    def test_a_colon_in_the_name_selects_no_file_system(self):
        for ranks in (None, 2):
            if "MPICH" in self.overturn("--version").stdout:
                self.assert_refused(74, ['ufs:small.h5" has a colon'], "run", "small.toml", "-o",
                                    "ufs:small.h5", ranks=ranks)
            else:
                self.assert_exit(self.overturn("run", "small.toml", "-o", "ufs:small.h5", ranks=ranks), 0)
                self.assert_exit(self.overturn("verify", "ufs:small.h5"), 0, "24 of 24 tiles are done")

    def test_all_ranks_compute_the_job_that_rank_0_has_read(self):
        # As with a folder not shared between two hosts: one copy of the job is older.
        setup = 'if [ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 1 ]; then set -- "$1" run long.toml -o out.h5; fi'
        result = self.overturn("run", "small.toml", "-o", "out.h5", ranks=2, shell_setup=setup)
        self.assert_exit(result, 0)
        self.assert_exit(self.overturn("run", "small.toml", "-o", "alone.h5"), 0)
        self.assertEqual(checksum(self.folder / "out.h5"), checksum(self.folder / "alone.h5"))


class RanksInDifferentFolders(Scratch):
    """One rank in each of the folders X and Y. The result of another job in Y must be kept."""

    def setUp(self):
        super().setUp()
        for name in "XY":
            (self.folder / name).mkdir()
            (self.folder / name / "small.toml").write_text(SMALL)
        self.assert_exit(self.overturn("run", "small.toml", "-o", "Y/out.h5"), 0)
        self.theirs = checksum(self.folder / "Y" / "out.h5")

    def run_in_both(self, output):
        command = []
        for name in "XY":
            command += [*(":" for _ in command[:1]), "-n", "1", "-wdir", self.folder / name, OVERTURN,
                        "run", "small.toml", "-o", output, "--set", "numerics.tolerance=1e-7"]
        return subprocess.run([MPIEXEC, *command], env=ENVIRONMENT, timeout=PATIENCE,
                              capture_output=True, text=True)

    def test_write_to_the_folder_of_rank_0(self):
        self.assert_exit(self.run_in_both("out.h5"), 0)
        self.assert_exit(self.overturn("verify", "X/out.h5"), 0, "24 of 24 tiles are done")
        self.assertEqual(checksum(self.folder / "Y" / "out.h5"), self.theirs)

    def test_are_refused_if_a_path_names_different_files(self):
        # An absolute path that depends on the process represents a folder local to a host.
        output = "/proc/self/cwd/out.h5"
        host = socket.gethostname()
        message = (f'"{output}" is not the same file on rank 1 (host {host}) as on rank 0 (host {host}). '
                   "Choose a folder with -o that all hosts share.")
        self.assert_exit(self.run_in_both(output), 74, message)
        self.assert_exit(self.overturn("verify", "X/out.h5"), 0, "0 of 24 tiles are done")
        self.assertEqual(checksum(self.folder / "Y" / "out.h5"), self.theirs)
        (self.folder / "Y" / "out.h5").unlink()
        self.assert_exit(self.run_in_both(output), 74, message)

    def test_leave_a_file_that_can_be_resumed(self):
        self.assert_exit(self.run_in_both("/proc/self/cwd/out.h5"), 74)
        whole = self.run_in_both("whole.h5")
        self.assert_exit(whole, 0)
        self.assert_exit(self.run_in_both("out.h5"), 0)
        self.assertEqual(checksum(self.folder / "X" / "out.h5"), checksum(self.folder / "X" / "whole.h5"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
