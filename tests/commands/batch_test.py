"""Decisions of jobs/slurm/run_until_done after a run, with a script in place of Slurm's
scontrol."""

import os
import pathlib
import shutil
import subprocess
import unittest

from program import ENVIRONMENT, JOBS, MPIEXEC, OVERTURN, PATIENCE, Scratch, checksum

SCRIPT = JOBS / "slurm" / "run_until_done"


# The scripts that need arguments or the environment of another program.
SCRIPTS = ["jobs/slurm/array.sbatch", "jobs/slurm/many_nodes.sbatch", "jobs/slurm/one_node.sbatch", "jobs/slurm/run_until_done",
           "tests/arm/check_arm", "tests/faults/cut_link", "tests/fuzz/run_targets", "tests/install/check_wheel",
           "tests/layout/sources_are_formatted", "tests/support/under_other_libraries",
           "tests/support/under_valgrind", "tools/check values", "tools/check fill x"]


class AScript(unittest.TestCase):
    def test_without_what_it_needs_prints_how_to_use_it(self):
        environment = {name: value for name, value in os.environ.items()
                       if name != "OVERTURN" and not name.startswith("SLURM_")}
        for script in SCRIPTS:
            for arguments in ([], ["--help"], [""]):
                if arguments and script.startswith("tools/") or arguments == [""] and script.startswith("tests/"):
                    continue  # means something, or names the checkout
                with self.subTest(script=script, arguments=arguments):
                    command = [*script.split(), *arguments]
                    result = subprocess.run(["bash", *command], cwd=JOBS.parent, env=environment, timeout=PATIENCE,
                                            stdin=subprocess.DEVNULL, capture_output=True, text=True)
                    output = result.stdout + result.stderr
                    self.assertEqual(result.returncode, 2, output)
                    self.assertIn(pathlib.Path(command[0]).name, output)
                    self.assertNotRegex(output, r"line \d+:|unbound variable")


class ABatchJob(Scratch):
    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0)
        scontrol = self.folder / "scontrol"
        scontrol.write_text('#!/bin/sh\necho "$@" >requeued\nkill $PPID\n')  # like Slurm
        scontrol.chmod(0o755)

    def run_until_done(self, *command, **variables):
        environment = ENVIRONMENT | {"PATH": f"{self.folder}:{os.environ['PATH']}", "SLURM_JOB_ID": "7"} | variables
        return subprocess.run([SCRIPT, OVERTURN, "out.h5", *command], cwd=self.folder, env=environment,
                              timeout=PATIENCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_is_done_if_its_file_is_complete(self):
        result = self.run_until_done("cp", "whole.h5", "out.h5")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("done", result.stdout)
        self.assertNotIn("requeued", self.files())

    def test_is_done_if_its_file_has_a_single_tile(self):
        few = ("--set", "plane.frequency.count=9", "--set", "plane.amplitude.count=9",
               "--set", "plane.restitution=0.9")
        self.assert_exit(self.overturn("run", "small.toml", "-o", "out.h5", *few), 0)
        self.assertEqual(self.run_until_done("true").returncode, 0)
        self.forget("out.h5", 0)
        self.assert_not_done(self.run_until_done("true"))

    def test_is_not_done_if_the_launcher_returns_0_and_there_is_no_file(self):
        self.assert_not_done(self.run_until_done("true"))

    def test_is_not_done_if_the_launcher_returns_0_and_the_file_is_truncated(self):
        path = self.folder / "out.h5"
        shutil.copy(self.folder / "whole.h5", path)
        os.truncate(path, path.stat().st_size - 5000)
        self.assert_not_done(self.run_until_done("true"))

    def assert_not_done(self, result):
        self.assertEqual(result.returncode, 85, result.stdout)
        self.assertIn("not requeued: no tile was added", result.stdout)

    def test_is_requeued_if_the_launcher_returns_0_after_a_stop(self):
        shutil.copy(self.folder / "whole.h5", self.folder / "unfinished.h5")
        self.forget("unfinished.h5", 3)
        result = self.run_until_done("cp", "unfinished.h5", "out.h5")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("23 tiles were added: requeueing", result.stdout)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7\n")

    def test_is_requeued_if_a_rank_was_killed_after_some_tiles(self):
        shutil.copy(self.folder / "whole.h5", self.folder / "unfinished.h5")
        self.forget("unfinished.h5", 3)
        result = self.run_until_done("sh", "-c", "cp unfinished.h5 out.h5; exit 137")
        self.assertIn("23 tiles were added: requeueing", result.stdout)
        result = self.run_until_done("sh", "-c", "exit 137")
        self.assertIn("not requeued: no tile was added", result.stdout)

    def test_is_requeued_alone_if_it_is_a_task_of_an_array(self):
        shutil.copy(self.folder / "whole.h5", self.folder / "unfinished.h5")
        self.forget("unfinished.h5", 3)
        # The number 7 of the array would requeue all of its tasks.
        self.run_until_done("cp", "unfinished.h5", "out.h5", SLURM_ARRAY_JOB_ID="7", SLURM_ARRAY_TASK_ID="3")
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7_3\n")

    def test_of_an_array_computes_a_part_and_one_without_array_merges_them(self):
        def array_job(**variables):
            return subprocess.run(["bash", JOBS / "slurm" / "array.sbatch", "small.toml", "out.h5", "3", "--kernel", "double"],
                                  cwd=self.folder, timeout=PATIENCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  env=ENVIRONMENT | {"SLURM_JOB_ID": "7", "SLURM_SUBMIT_DIR": str(self.folder),
                                                     "OVERTURN_CHECKOUT": str(JOBS.parent)} | variables)

        for task in "13":
            self.assertEqual(array_job(SLURM_ARRAY_JOB_ID="7", SLURM_ARRAY_TASK_ID=task).returncode, 0)
        result = array_job()
        self.assertEqual(result.returncode, 74)
        self.assertIn("of 3 parts, 1 is missing: 2.", result.stdout)
        part = array_job(SLURM_ARRAY_JOB_ID="7", SLURM_ARRAY_TASK_ID="2", SLURM_NTASKS="2", OVERTURN_LAUNCHER=f"{MPIEXEC} -n 2")
        self.assertIn("out.part-2-of-3.h5: part 2 of 3: 20.0 k points in 8 tiles; 2 ranks, kernel double", part.stdout)
        self.assertIn("job 7_2: done", part.stdout)
        self.assertEqual(array_job().returncode, 0)
        self.assertEqual(checksum(self.folder / "out.h5"), checksum(self.folder / "whole.h5"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
