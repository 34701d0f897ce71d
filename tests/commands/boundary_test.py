"""overturn boundary: on one rank and on several, resumed, and in the way of other files."""

import pathlib
import subprocess
import sys
import unittest

import h5py
import numpy as np
import xarray

from program import Scratch, checksum

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
FEW = ("--set", "plane.frequency.count=30", "--set", "plane.amplitude.count=60")
CODE_OF_NO_FLIP = 253


class ABoundary(Scratch):
    def boundary(self, output="boundary.h5", ranks=None):
        return self.overturn("boundary", "small.toml", "-o", output, *FEW, ranks=ranks)

    def test_has_the_flips_of_every_line_in_order(self):
        self.assert_exit(self.boundary(), 0, "60 lines in 60 tiles", "computed 60 lines")
        for engine in ("netcdf4", "h5netcdf"):
            with xarray.open_dataset(self.folder / "boundary.h5", engine=engine) as found:
                self.assertEqual(found.flip_amplitude.dims,
                                 ("slenderness", "restitution", "crossing", "frequency"))
                flips = found.flip_amplitude.values
                below, above = found.region_below.values, found.region_above.values
        there = np.isfinite(flips)
        self.assertGreater(there.sum(), 60)
        steps = np.diff(flips, axis=2)
        self.assertTrue((steps[np.isfinite(steps)] > 0).all())
        self.assertTrue((there == (below != CODE_OF_NO_FLIP)).all())
        self.assertTrue(((below <= 2) != (above <= 2))[there].all())  # safe on one side alone
        self.assertTrue((below[:, :, 0][there[:, :, 0]] <= 2).all())  # nothing overturns unlifted

    def test_is_where_the_spectrum_changes(self):
        self.boundary()
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW,
                      "--set", "numerics.method=taylor", "--set", "numerics.resolve=true")
        with h5py.File(self.folder / "boundary.h5") as boundary, \
                h5py.File(self.folder / "spectrum.h5") as spectrum:
            amplitude = spectrum["amplitude"][:]
            safe = spectrum["region"][:] <= 2
            for index in np.ndindex(2, 30):
                column = (0, index[0], slice(None), index[1])
                flips = boundary["flip_amplitude"][column]
                # A point of the spectrum is safe if an even number of flips is below it.
                count = np.searchsorted(flips[np.isfinite(flips)], amplitude)
                self.assertTrue((safe[column] == (count % 2 == 0)).all(), index)

    def test_is_the_same_on_any_number_of_ranks_and_if_resumed(self):
        self.assert_exit(self.boundary("alone.h5"), 0)
        self.assert_exit(self.boundary("both.h5", ranks=2), 0)
        whole = checksum(self.folder / "alone.h5")
        self.assertEqual(checksum(self.folder / "both.h5"), whole)
        with h5py.File(self.folder / "both.h5", "r+") as file:
            file["flip_amplitude"][0, 1, :, 4:12] = np.nan
            file["checksum"][34:42] = 0
        self.assert_exit(self.boundary("both.h5"), 0, "going on, 52 of 60 tiles are there")
        self.assertEqual(checksum(self.folder / "both.h5"), whole)
        self.assert_exit(self.boundary("both.h5"), 0, "is complete already")

    def test_goes_on_whatever_the_job_says_of_spectra_alone(self):
        self.assert_exit(self.boundary(), 0)
        result = self.overturn("boundary", "small.toml", "-o", "boundary.h5", *FEW,
                               "--set", "numerics.tolerance=1e-5",
                               "--set", "output.fields=[\"region\", \"peak\"]")
        self.assert_exit(result, 0, "is complete already")

    def test_is_refused_if_no_file_could_hold_it(self):
        # 1e18 lines: a spectrum of two amplitudes would be told that its disk is too small.
        result = self.overturn("boundary", "small.toml", "--set", "plane.amplitude.count=2",
                               "--set", "plane.frequency.count=1000000000000000",
                               *(f"--set=plane.restitution.{key}={value}"
                                 for key, value in (("first", 0.5), ("last", 1), ("count", 1000))),
                               "--set", "output.fields=[\"region\"]")
        self.assert_exit(result, 65, "whose boundaries would take 6.4e+20 bytes")

    def test_does_not_touch_a_spectrum_nor_a_spectrum_a_boundary(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        self.assert_exit(self.boundary("spectrum.h5"), 74,
                         "is an overturning spectrum, and an overturning boundary is to be computed")
        self.boundary()
        result = self.overturn("run", "small.toml", "-o", "boundary.h5", *FEW)
        self.assert_exit(result, 74, "is an overturning boundary")

    def test_is_told_by_info(self):
        self.boundary()
        self.assert_exit(self.overturn("info", "boundary.h5"), 0, "crossing 64 values",
                         "60 of 60 done, 64 x 1 flips each")

    def plot(self, *arguments, tool="plot_boundary"):
        return subprocess.run([sys.executable, TOOLS / tool, *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=60)

    def test_is_drawn_with_what_overturns(self):
        self.boundary()
        result = self.plot("boundary.h5", "--restitution", "1", "-o", "boundary.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        picture = (self.folder / "boundary.svg").read_text()
        for words in ("minimum overturning amplitude", "other flips", "overturns", "safe"):
            self.assertIn(f">{words}<", picture)
        result = self.plot("boundary.h5")
        self.assertEqual(result.returncode, 2)
        self.assertIn("choose with --restitution", result.stderr)

    def test_is_laid_over_its_spectrum_and_over_no_other(self):
        self.boundary()
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        result = self.plot("spectrum.h5", "--boundary", "boundary.h5", "-o", "both.svg",
                           tool="plot_spectrum")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(">the verdict flips<", (self.folder / "both.svg").read_text())
        for setting, words in (("plane.slenderness.values=[0.2]", "its slenderness differs"),
                               ("scene.theory=linear", "has theory nonlinear")):
            self.overturn("run", "small.toml", "-o", "other.h5", *FEW, "--set", setting)
            result = self.plot("other.h5", "--boundary", "boundary.h5", tool="plot_spectrum")
            self.assertEqual(result.returncode, 74)
            self.assertIn(words, result.stderr)
            (self.folder / "other.h5").unlink()

    def test_a_spectrum_is_not_drawn_as_one(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        result = self.plot("spectrum.h5")
        self.assertEqual(result.returncode, 74)
        self.assertIn("is not a boundary written by overturn boundary", result.stderr)


if __name__ == "__main__":
    unittest.main()
