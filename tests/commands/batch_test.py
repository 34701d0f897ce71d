"""How jobs/slurm/run_until_done judges a run, with a scontrol that stands in for Slurm's."""

import os
import pathlib
import shutil
import subprocess
import unittest

import h5py

from program import ENVIRONMENT, OVERTURN, PATIENCE, Scratch

SCRIPT = pathlib.Path(__file__).parents[2] / "jobs" / "slurm" / "run_until_done"


class ABatchJob(Scratch):
    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0)
        scontrol = self.folder / "scontrol"
        scontrol.write_text('#!/bin/sh\necho "$@" >requeued\nkill $PPID\n')  # ends the script, as Slurm does
        scontrol.chmod(0o755)

    def run_until_done(self, *command):
        environment = ENVIRONMENT | {"PATH": f"{self.folder}:{os.environ['PATH']}", "SLURM_JOB_ID": "7"}
        return subprocess.run([SCRIPT, OVERTURN, "out.h5", *command], cwd=self.folder, env=environment,
                              timeout=PATIENCE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_is_done_if_its_file_is_complete(self):
        result = self.run_until_done("cp", "whole.h5", "out.h5")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("done", result.stdout)
        self.assertNotIn("requeued", self.files())

    def test_is_requeued_if_the_launcher_returns_0_after_a_stop(self):
        shutil.copy(self.folder / "whole.h5", self.folder / "unfinished.h5")
        with h5py.File(self.folder / "unfinished.h5", "r+") as file:
            file["checksum"][3] = 0
        result = self.run_until_done("cp", "unfinished.h5", "out.h5")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("23 tiles were added: back into the queue", result.stdout)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
