"""overturn accuracy, its picture, and jobs with errors or resolved verdicts."""

import re
import shutil
import unittest

import h5py
import numpy as np
import xarray

from program import JOBS, Scratch, checksum

FEW = ("--points", "1024", "--digits", "16")


FEWER = ("--points", "64", "--digits", "4")


class AnAccuracyStudy(Scratch):
    def study(self, points=FEW, name="study.h5"):
        return self.overturn("accuracy", "small.toml", "-o", name, *points)

    def have_study(self):
        self.have("study.h5", self.study)

    def test_prints_a_row_per_setting_and_writes_them(self):
        result = self.study(FEWER, "printed.h5")
        self.assert_exit(result, 0, "4 in 50 digits", "printed.h5: written")
        rows = re.findall(r"^(?:rk45|taylor)( resolved)?\s+1e-\d\d", result.stdout, re.MULTILINE)
        with h5py.File(self.folder / "printed.h5") as file:
            self.assertEqual(len(rows), len(file["tolerance"]))
            self.assertEqual(sum(map(bool, rows)), file["resolve"][:].sum())
            self.assertEqual(file.attrs["points_in_50_digits"], 4)
            self.assertTrue((file["seconds_per_point"][:] > 0).all())

    def test_leaves_out_points_at_which_gravity_vanishes(self):
        result = self.overturn("accuracy", JOBS / "synthetic.toml", "-o", "study.h5", "--points", "32",
                               "--digits", "32", "--set", f'scene.vertical="{JOBS}/synthetic_vertical.AT2"',
                               "--set", "plane.scale={ first = 1, last = 20, count = 8 }",
                               "--set", "plane.size.count=4")
        self.assert_exit(result, 0)
        with h5py.File(self.folder / "study.h5") as file:
            self.assertLess(0, file.attrs["points_in_50_digits"])
            self.assertLess(file.attrs["points_in_50_digits"], 32)
            self.assertTrue(np.isfinite(file["margin_error"][:]).all())

    def test_has_the_error_of_the_slide_with_friction(self):
        result = self.overturn("accuracy", JOBS / "sliding.toml", "-o", "slip.h5", "--points", "16", "--digits", "16",
                               "--set", "block.friction=0.4", "--set", "plane.pga.last=0.8")
        self.assert_exit(result, 0, "16 points, 16 with a settled verdict, 16 in 50 digits", " slide ")
        with h5py.File(self.folder / "slip.h5") as file:
            plain = (file["method"][:] == 1) & (file["resolve"][:] == 0) & (file["tolerance"][:] < 2e-8)
            largest = file["slide_error"][:, -1][plain]  # at 1e-8, 1e-9, ...
            self.assertLess(largest[4], 1e-3 * largest[0])
            self.assertGreater(largest[4], 0)
        result = self.tool("plot_accuracy", "slip.h5", "-o", "slip.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        picture = (self.folder / "slip.svg").read_text()
        for words in ("error of the slide over R", "error of the margin"):
            self.assertIn(f">{words}, 99th percentile<", picture)

    def test_is_described_by_info(self):
        self.have_study()
        self.assert_exit(self.overturn("info", "study.h5"), 0, "A small plane",
                         "contains an accuracy study", "pulse = \"one_sine\"")

    def test_has_no_wrong_resolved_verdicts_but_wrong_ones_at_the_loosest_tolerance(self):
        self.have_study()
        with h5py.File(self.folder / "study.h5") as file:
            resolved = file["resolve"][:] == 1
            self.assertEqual(file["wrong_verdicts"][:][resolved].sum(), 0)
            self.assertGreater(file["wrong_verdicts"][:][file["tolerance"][:] == 1e-2].max(), 0)

    def test_opens_in_xarray_with_its_coordinates(self):
        self.have_study()
        for engine in ("netcdf4", "h5netcdf"):
            with xarray.open_dataset(self.folder / "study.h5", engine=engine) as found:
                self.assertEqual(found.margin_error.dims, ("setting", "quantile"))
                self.assertEqual(found.wrong_verdicts_by_region.dims, ("setting", "region"))
                self.assertEqual(list(found["quantile"].values), [0.5, 0.9, 0.99, 0.999, 1])

    def test_replaces_an_older_study_and_nothing_else(self):
        for points in (FEWER, ("--points", "32", "--digits", "2")):
            self.assert_exit(self.study(points, "replaced.h5"), 0, "replaced.h5: written")
        with h5py.File(self.folder / "replaced.h5") as file:
            self.assertEqual(file.attrs["points_in_50_digits"], 2)
        self.overturn("run", "small.toml", "-o", "spectrum.h5")
        before = checksum(self.folder / "spectrum.h5")
        result = self.study(FEWER, "spectrum.h5")
        self.assert_exit(result, 74, 'its kind is not "accuracy study"')
        self.assertEqual(checksum(self.folder / "spectrum.h5"), before)

    def test_reports_a_missing_folder_before_computing(self):
        result = self.overturn("accuracy", "small.toml", "-o", "nowhere/study.h5", *FEW)
        self.assert_exit(result, 74, "there is no folder \"nowhere\"")
        self.assertEqual(result.stdout, "")

    def test_is_plotted_with_the_names_of_all_methods(self):
        self.have_study()
        result = self.tool("plot_accuracy", "study.h5", "-o", "study.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        picture = (self.folder / "study.svg").read_text()
        for words in ("rk45", "taylor", "rk45, resolved", "taylor, resolved", "slope of order 5",
                      "share of wrong verdicts", "A small plane"):
            self.assertIn(f">{words}<", picture)

    def test_plot_refuses_a_spectrum(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5")
        result = self.tool("plot_accuracy", "spectrum.h5")
        self.assertEqual(result.returncode, 74)
        self.assertIn("is not a study written by overturn accuracy", result.stderr)

    def test_plot_refuses_a_study_without_known_points(self):
        self.have_study()
        for known in ("points_settled", "points_in_50_digits"):
            shutil.copy(self.folder / "study.h5", self.folder / "nothing_known.h5")
            with h5py.File(self.folder / "nothing_known.h5", "r+") as file:
                file.attrs[known] = 0
            result = self.tool("plot_accuracy", "nothing_known.h5", "-o", "nothing_known.png")
            self.assertEqual(result.returncode, 74)
            self.assertIn("no reference to compare with", result.stderr)
            self.assertFalse((self.folder / "nothing_known.png").exists())


class ResolvedJobs(Scratch):
    RESOLVE = ("--set", "numerics={ method = \"taylor\", resolve = true }")

    def test_agree_with_the_tightest_run_on_every_verdict(self):
        self.overturn("run", "small.toml", "-o", "resolved.h5", *self.RESOLVE)
        self.overturn("run", "small.toml", "-o", "tight.h5", "--set",
                      "numerics={ method = \"taylor\", tolerance = 1e-13 }")
        with h5py.File(self.folder / "resolved.h5") as resolved, \
                h5py.File(self.folder / "tight.h5") as tight:
            self.assertTrue((resolved["region"][:] <= 8).all())
            np.testing.assert_array_equal(resolved["region"][:] <= 2, tight["region"][:] <= 2)

    def test_give_equal_bytes_on_any_number_of_ranks(self):
        self.overturn("run", "small.toml", "-o", "one.h5", *self.RESOLVE)
        self.overturn("run", "small.toml", "-o", "two.h5", *self.RESOLVE, ranks=2)
        self.assertEqual(checksum(self.folder / "one.h5"), checksum(self.folder / "two.h5"))

    def test_have_their_own_default_tolerance(self):
        self.assert_exit(self.overturn("check", "small.toml", *self.RESOLVE), 0,
                         "taylor, tolerance 0.0001, verdicts resolved")

    def test_and_jobs_with_errors_are_refused_at_loose_tolerances(self):
        self.assert_refused(65, ["numerics.tolerance = 0.001 is too loose for resolve", "taylor"],
                            "run", "small.toml", "--set", "numerics.resolve=true", "--set",
                            "numerics.tolerance=1e-3")
        self.assert_refused(65, ["is too loose for the field \"error\""], "run", "small.toml",
                            "--set", "output.fields=[\"error\"]", "--set",
                            "numerics.tolerance=1e-3")

    def test_require_true_or_false(self):
        self.assert_refused(65, ["numerics.resolve", "true or false"], "run", "small.toml", "--set",
                            "numerics.resolve=1")

    def test_errors_and_steps_are_stored(self):
        self.assert_exit(self.overturn("run", "small.toml", "--set",
                                       "output.fields=[\"margin\", \"error\", \"steps\"]"), 0)
        with h5py.File(self.folder / "small.h5") as file:
            self.assertEqual(file["steps"].dtype, np.uint32)
            error, margin = file["error"][:], file["margin"][:]
            # At 1e-6 nearly all verdicts are certain; a block at rest has only round-off errors.
            self.assertLess((error > abs(margin)).mean(), 1e-3)
            self.assertGreater((error > 0).mean(), 0.9)


if __name__ == "__main__":
    unittest.main()
