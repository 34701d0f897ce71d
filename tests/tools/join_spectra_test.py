"""The output of tools/join_spectra compared with one run over all slendernesses, byte for byte.

Requires OVERTURN (the binary) in the environment.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
import xarray
from tool import TOOLS, run_tool

OVERTURN = os.environ["OVERTURN"]

# 2 x 2 x 3 tiles for each slenderness, some of them cut off at the upper edges; every type of
# field.
JOB = """
title = "A slender \\"plane\\""
[scene]
pulse = "one_sine"
[plane]
frequency = { first = 0.5, last = 8.0, count = 150 }
amplitude = { first = 0.5, last = 12.0, count = 100 }
restitution = { values = [0.7, 1.0], of = "maximum" }
[block]
half_width = 1.0
half_height = 5.67
[numerics]
tolerance = 1e-5
[output]
fields = ["status", "region", "angle", "impacts", "steps"]
"""


class Spectra(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "job.toml").write_text(JOB)

    def run_here(self, *command):
        return subprocess.run(command, cwd=self.folder, timeout=100, capture_output=True, text=True)

    def compute(self, name, slendernesses, *settings, job="job.toml"):
        """Computes a spectrum; without slendernesses, that of the job's own block."""
        if slendernesses is not None:
            settings = (*settings, f"plane.slenderness.values={slendernesses}")
        run = self.run_here(OVERTURN, "run", job, "-o", name,
                            *(f"--set={setting}" for setting in settings))
        self.assertEqual(run.returncode, 0, run.stderr)

    def join(self, *arguments):
        return run_tool("join_spectra", *arguments, cwd=self.folder)

    def assert_joins(self, *names):
        before = sorted(os.listdir(self.folder))
        run = self.join(*names, "-o", "joined.h5")
        self.assertEqual((run.returncode, run.stdout), (0, "joined.h5\n"), run.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted([*before, "joined.h5"]))

    def assert_equal_files(self, one, other):
        self.assertTrue((self.folder / one).read_bytes() == (self.folder / other).read_bytes())


class TestTheWhole(Spectra):
    def test_equals_the_file_of_one_run_for_any_order_of_files(self):
        for value in (0.1, 0.15, 0.2):
            self.compute(f"{value}.h5", [value])
        self.compute("at_once.h5", [0.1, 0.15, 0.2])
        self.assert_joins("0.2.h5", "0.1.h5", "0.15.h5")
        self.assert_equal_files("joined.h5", "at_once.h5")

    def test_joins_files_of_interleaved_slendernesses(self):
        self.compute("outer.h5", [0.1, 0.3])
        self.compute("inner.h5", [0.2])
        self.compute("at_once.h5", [0.1, 0.2, 0.3])
        self.assert_joins("outer.h5", "inner.h5")
        self.assert_equal_files("joined.h5", "at_once.h5")

    def test_keeps_the_order_of_other_settings(self):
        for value in (0.1, 0.2):
            self.compute(f"{value}.h5", None, "scene.theory=linear",
                         f"plane.slenderness.values=[{value}]", "title=With settings")
        self.compute("at_once.h5", None, "scene.theory=linear",
                     "plane.slenderness.values=[0.1, 0.2]", "title=With settings")
        self.assert_joins("0.1.h5", "0.2.h5")
        self.assert_equal_files("joined.h5", "at_once.h5")

    def test_joins_jobs_that_define_their_blocks_in_different_ways(self):
        (self.folder / "other.toml").write_text(JOB.replace("5.67", "3.0"))
        self.compute("block.h5", None)
        self.compute("stout.h5", None, job="other.toml")
        self.compute("set.h5", None, "block.half_width=2.0")
        self.assert_joins("block.h5", "stout.h5", "set.h5")
        with h5py.File(self.folder / "joined.h5") as joined:
            alphas = joined["slenderness"][:]
            # NumPy's arctangent and that of the C library, used by the program, are each within 2
            # ulp of the exact value. A wrong block is off by at least a tenth.
            np.testing.assert_allclose(alphas, np.sort(np.arctan([1 / 5.67, 1 / 3, 2 / 5.67])),
                                       rtol=4 * np.finfo(float).eps)
            self.assertNotIn("pulse_period", joined)
            for place, name in enumerate(("block.h5", "stout.h5", "set.h5")):
                with h5py.File(self.folder / name) as file:
                    self.assertEqual(alphas[place], file["slenderness"][0])
                    for field in ("status", "region", "angle", "impacts", "steps"):
                        np.testing.assert_array_equal(joined[field][place], file[field][0], field)
                    np.testing.assert_array_equal(joined["run/checksum"][12 * place:12 * place + 12],
                                                  file["run/checksum"][:])
        self.compute("at_once.h5", list(map(float, alphas)))
        self.assert_equal_files("joined.h5", "at_once.h5")

    def test_is_readable_by_the_program_and_other_readers(self):
        for value in (0.1, 0.2):
            self.compute(f"{value}.h5", [value])
        self.assert_joins("0.1.h5", "0.2.h5")
        run = self.run_here(OVERTURN, "run", "job.toml", "-o", "joined.h5",
                            "--set=plane.slenderness={ values = [0.1, 0.2] }")
        self.assertIn("is already complete", run.stdout)
        run = self.run_here(OVERTURN, "info", "joined.h5")
        self.assertIn("24 of 24 done", run.stdout)
        run = run_tool("to_csv", "joined.h5", "--slenderness=1", "--restitution=0",
                       cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        with xarray.open_dataset(self.folder / "joined.h5") as spectrum:
            self.assertEqual(spectrum.region.sel(slenderness=0.2, restitution=0.7).shape,
                             (100, 150))


class TestRecords(Spectra):
    """Two records and two restitutions; the records are in a folder below that of the job."""

    PLANE = """
        [plane]
        pga = { first = 0.2, last = 1.5, count = 30 }
        size = { first = 0.3, last = 3.0, count = 20 }
        restitution = { values = [0.7, 1.0], of = "maximum" }
        """
    BLOCK = """
        [plane]
        pga = { values = [0.4, 0.6] }
        restitution = 0.9
        [block]
        half_width = 0.2
        half_height = 1.0
        """

    def setUp(self):
        super().setUp()
        (self.folder / "suite").mkdir()
        for name in ("synthetic.AT2", "synthetic_vertical.AT2"):
            shutil.copy(TOOLS.parent / "jobs" / name, self.folder / "suite")
        self.write_job(self.PLANE)

    def write_job(self, plane):
        (self.folder / "job.toml").write_text("[scene]\nrecord = \"suite/*.AT2\"\n" + plane)

    def test_join_to_the_file_of_one_run(self):
        self.compute("outer.h5", [0.15, 0.25])
        self.compute("inner.h5", [0.2])
        self.compute("at_once.h5", [0.15, 0.2, 0.25])
        self.assert_joins("outer.h5", "inner.h5")
        self.assert_equal_files("joined.h5", "at_once.h5")

    def test_are_found_from_the_folder_of_the_job(self):
        self.compute("one.h5", [0.15])
        (self.folder / "elsewhere").mkdir()
        here = {"cwd": self.folder / "elsewhere"}
        run = run_tool("join_spectra", "../one.h5", "-o", "joined.h5", **here)
        self.assertEqual(run.returncode, 74)
        self.assertIn("Name the folder of the job file with --job-folder", run.stderr)
        run = run_tool("join_spectra", "../one.h5", "-o", "joined.h5", "--job-folder=no", **here)
        self.assertEqual(run.returncode, 2)
        self.assertIn("there is no folder \"no\"", run.stderr)
        run = run_tool("join_spectra", "../one.h5", "-o", "joined.h5", "--job-folder=..", **here)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(os.listdir(self.folder / "elsewhere"), ["joined.h5"])
        self.assert_equal_files("elsewhere/joined.h5", "one.h5")

    def test_that_have_changed_are_refused(self):
        self.compute("one.h5", [0.15])
        path = self.folder / "suite" / "synthetic.AT2"
        path.write_text(path.read_text().replace("0.0000021", "0.0000022"))
        run = self.join("one.h5", "-o", "joined.h5")
        self.assertEqual(run.returncode, 74)
        self.assertIn("differ in more than slenderness: scene.record", run.stderr)

    def test_of_blocks_in_metres_are_refused(self):
        self.write_job(self.BLOCK)
        self.compute("block.h5", None)
        run = self.join("block.h5", "-o", "joined.h5")
        self.assertEqual(run.returncode, 74)
        self.assertIn("\"block.h5\" has a [block], which also gives its size", run.stderr)


class TestAJoinRefused(Spectra):
    def refuses(self, code, phrases, *arguments):
        before = sorted(os.listdir(self.folder))
        run = self.join(*arguments)
        self.assertEqual(run.returncode, code, run.stderr)
        for phrase in phrases:
            self.assertIn(phrase, run.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def refuses_beside(self, *phrases, settings=(), slendernesses=(0.2,)):
        """Refuses to join a file with these settings to an ordinary one."""
        self.compute("one.h5", [0.1])
        self.compute("other.h5", slendernesses and list(slendernesses), *settings)
        self.refuses(74, ("\"other.h5\"", *phrases), "one.h5", "other.h5", "-o", "joined.h5")

    def test_of_another_tolerance(self):
        self.refuses_beside("numerics.tolerance is 1e-06", "1e-05",
                            settings=["numerics.tolerance=1e-6"])

    def test_of_another_axis(self):
        self.refuses_beside("plane.amplitude.count is 90", "100",
                            settings=["plane.amplitude.count=90"])

    def test_of_another_window(self):
        self.refuses_beside("scene.pulse is symmetric_ricker",
                            settings=["scene.pulse=symmetric_ricker"])

    def test_of_an_axis_in_g(self):
        self.refuses_beside("axis pga depends", "plane.size", slendernesses=None,
                            settings=["plane.pga={first=0.1, last=1.0, count=100}"])

    def test_of_other_fields(self):
        self.refuses_beside("output.fields is ['region']", settings=["output.fields=[\"region\"]"])

    def test_of_the_same_slenderness_twice(self):
        self.refuses_beside("\"one.h5\"", "both contain the slenderness 0.1",
                            slendernesses=(0.1, 0.2))

    def change(self, name, change):
        self.compute(name, [0.2])
        with h5py.File(self.folder / name, "r+") as file:
            change(file)

    def test_of_an_unfinished_file(self):
        def forget(file):
            file["run/checksum"][3:5] = 0
        self.change("part.h5", forget)
        self.refuses(74, ("\"part.h5\" is unfinished: 2 of 12 tiles",),
                     "part.h5", "-o", "joined.h5")

    def test_of_altered_values(self):
        def damage(file):
            file["angle"][0, 0, 5, 5] += 1e-9
        self.change("altered.h5", damage)
        self.refuses(74, ("\"altered.h5\" is damaged: the checksums of 1 of 12 finished tiles",),
                     "altered.h5", "-o", "joined.h5")

    def test_of_another_build(self):
        def age(file):
            file.attrs["program_commit"] = np.bytes_("0123456789")
        self.change("old.h5", age)
        self.compute("new.h5", [0.1])
        self.refuses(74, ("\"old.h5\"", "commit is 0123456789"),
                     "new.h5", "old.h5", "-o", "joined.h5")
        self.refuses(74, ("\"old.h5\" was computed by overturn", "(commit 0123456789)",
                          "--overturn"),
                     "old.h5", "-o", "joined.h5")

    def test_of_a_damaged_file_or_another_kind_of_file(self):
        def damage(file):
            del file["run/job_resolved"]
        self.change("damaged.h5", damage)
        self.refuses(74, ("\"damaged.h5\"", "is damaged"), "damaged.h5", "-o", "joined.h5")
        self.refuses(74, ("\"job.toml\" is not an HDF5 file",), "job.toml", "-o", "joined.h5")
        run = self.run_here(OVERTURN, "boundary", "job.toml", "-o", "boundary.h5",
                            "--set=plane.frequency.count=2", "--set=plane.amplitude.count=20")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.refuses(74, ("\"boundary.h5\" is not a spectrum",), "boundary.h5", "-o", "joined.h5")

    def test_of_settings_that_override_the_slendernesses(self):
        plane = ("plane={ frequency = { values = [1] }, amplitude = { values = [2] }, "
                 "restitution = { values = [0.8] }, slenderness = { values = [0.1] } }")
        self.compute("one.h5", None, "plane.slenderness.values=[0.3]", plane)
        self.compute("two.h5", None, plane, "plane.slenderness.values=[0.2]")
        self.refuses(74, ("\"one.h5\" do not allow other", "different file as the first argument"),
                     "one.h5", "two.h5", "-o", "joined.h5")
        self.assert_joins("two.h5", "one.h5")

    def test_does_not_overwrite_a_file(self):
        self.compute("one.h5", [0.1])
        before = (self.folder / "one.h5").read_bytes()
        self.refuses(74, ("\"one.h5\" exists",), "one.h5", "-o", "one.h5")
        self.assertEqual((self.folder / "one.h5").read_bytes(), before)
        self.refuses(74, ("cannot write",), "one.h5", "-o", "nowhere/joined.h5")

    def test_of_invalid_arguments(self):
        self.compute("one.h5", [0.1])
        self.refuses(2, ("required",), "one.h5")
        self.refuses(2, ("given twice",), "one.h5", "one.h5", "-o", "joined.h5")
        self.refuses(2, ("there is no program",), "one.h5", "-o", "joined.h5", "--overturn=nothing")


if __name__ == "__main__":
    unittest.main()
