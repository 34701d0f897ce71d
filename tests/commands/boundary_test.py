"""overturn boundary: on one rank and on several, when resumed, and in conflict with other files."""

import textwrap
import unittest

import h5py
import numpy as np
import xarray
from matplotlib import pyplot
from matplotlib.colors import to_rgb

from program import Scratch, checksum

FEW = ("--set", "plane.frequency.count=30", "--set", "plane.amplitude.count=60")
CODE_OF_NO_FLIP, CODE_OF_UNDECIDED = 253, 254
UNSAFE, SAFE, UNDECIDED = "#b41a1c", "#f3f8ef", "#969696"  # shades of plot_boundary


class ABoundary(Scratch):
    def boundary(self, output="boundary.h5", ranks=None):
        return self.overturn("boundary", "small.toml", "-o", output, *FEW, ranks=ranks)

    def have_boundary(self):
        self.have("boundary.h5", self.boundary)

    def test_has_the_flips_of_every_line_in_order(self):
        self.assert_exit(self.boundary(), 0, "60 lines in 60 tiles", "computed 60 lines")
        for engine in ("netcdf4", "h5netcdf"):
            with xarray.open_dataset(self.folder / "boundary.h5", engine=engine) as found:
                self.assertEqual(found.flip_amplitude.dims,
                                 ("slenderness", "restitution_of_maximum", "crossing", "frequency"))
                flips = found.flip_amplitude.values
                below, above = found.region_below.values, found.region_above.values
        there = np.isfinite(flips)
        self.assertGreater(there.sum(), 60)
        steps = np.diff(flips, axis=2)
        self.assertTrue((steps[np.isfinite(steps)] > 0).all())
        self.assertTrue((there == (above != CODE_OF_NO_FLIP)).all())
        self.assertTrue((below[:, :, 0] <= 2).all())  # safe at the lowest amplitude
        self.assertTrue((below[:, :, 1:] == CODE_OF_NO_FLIP)[~there[:, :, 1:]].all())
        self.assertTrue(((below <= 2) != (above <= 2))[there].all())  # safe on one side only

    def test_is_where_the_spectrum_changes(self):
        self.have_boundary()
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

    def test_gives_equal_bytes_on_any_number_of_ranks_and_when_resumed(self):
        self.have_boundary()
        self.assert_exit(self.boundary("both.h5", ranks=2), 0)
        whole = checksum(self.folder / "boundary.h5")
        self.assertEqual(checksum(self.folder / "both.h5"), whole)
        with h5py.File(self.folder / "both.h5", "r+") as file:
            file["flip_amplitude"][0, 1, :, 4:12] = np.nan
            file["run/checksum"][34:42] = 0
        self.assert_exit(self.boundary("both.h5"), 0, "resuming: 52 of 60 tiles done")
        self.assertEqual(checksum(self.folder / "both.h5"), whole)
        self.assert_exit(self.boundary("both.h5"), 0, "is already complete")

    def test_resumes_when_only_settings_of_spectra_change(self):
        self.have_boundary()
        result = self.overturn("boundary", "small.toml", "-o", "boundary.h5", *FEW,
                               "--set", "numerics.tolerance=1e-5",
                               "--set", "output.fields=[\"region\", \"peak\"]")
        self.assert_exit(result, 0, "is already complete")

    def test_is_refused_if_too_large_for_any_file(self):
        # 1e18 lines: a spectrum of two amplitudes would be refused for lack of disk space.
        result = self.overturn("boundary", "small.toml", "--set", "plane.amplitude.count=2",
                               "--set", "plane.frequency.count=10000000",
                               *(f"--set=plane.{axis}.{key}={value}"
                                 for axis, count in (("restitution_of_maximum", 10000000), ("slenderness", 10000))
                                 for key, value in (("first", 0.5), ("last", 0.9), ("count", count))),
                               "--set", "output.fields=[\"region\"]")
        self.assert_exit(result, 65, "lines and would take 6.4e+20 bytes")

    def test_and_spectra_do_not_overwrite_each_other(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        self.assert_exit(self.boundary("spectrum.h5"), 74,
                         "is an overturning spectrum, but the job computes an overturning boundary")
        self.have_boundary()
        result = self.overturn("run", "small.toml", "-o", "boundary.h5", *FEW)
        self.assert_exit(result, 74, "is an overturning boundary")

    def test_reports_lines_that_overturn_at_the_first_amplitude(self):
        strong = [*FEW, "--set", "plane.frequency.last=2", "--set", "plane.amplitude.first=6"]
        words = "overturning at the first amplitude of the job: 60 of 60 lines"
        self.assert_exit(self.overturn("boundary", "small.toml", "-o", "strong.h5", *strong), 0,
                         f"strong.h5: {words}")
        self.assert_exit(self.overturn("info", "strong.h5"), 0, f"lines {words}")
        with h5py.File(self.folder / "strong.h5") as file:
            self.assertFalse(np.isfinite(file["flip_amplitude"][:]).any())
            first = file["region_below"][:, :, 0]
            self.assertTrue(((first >= 3) & (first <= 8)).all())
            self.assertIn(b"overturns at the first amplitude of the job",
                          file["region_below"].attrs["comment"])
        picture = self.drawn("strong.h5", "--restitution", "0")
        self.assertIn(">overturns at the first amplitude of the job<", picture)
        self.assertNotIn("minimum overturning amplitude", picture)
        self.assertEqual(self.shades("strong.h5", "--restitution", "0"), {UNSAFE})

    def test_reports_undecided_verdicts(self):
        # Without loss the block bounces half a million times under a slow pulse.
        slow = [f"--set=plane.{axis}.values={values}" for axis, values in
                (("frequency", [0.02]), ("restitution", [1]), ("amplitude", [1.000001, 1.2, 2]))]
        result = self.overturn("boundary", "small.toml", "-o", "slow.h5", *slow,
                               "--set", "plane.slenderness.values=[0.17]")
        words = "with undecided amplitudes or more flips than are stored: 1 of 1 lines"
        self.assert_exit(result, 0, f"slow.h5: {words}")
        self.assert_exit(self.overturn("info", "slow.h5"), 0, f"lines {words}")
        with h5py.File(self.folder / "slow.h5") as file:
            column = (0, 0, slice(None), 0)
            # Halfway between 1.000001 and 1.2: steps wider than an eighth of the amplitude are divided.
            self.assertAlmostEqual(file["flip_amplitude"][column][0], 1.1000005, places=12)
            self.assertEqual(file["region_below"][column][0], CODE_OF_UNDECIDED)
            self.assertIn(file["region_above"][column][0], range(3, 9))
        self.assertIn(">undecided, or more flips<", self.drawn("slow.h5"))
        self.assertEqual(self.shades("slow.h5"), {UNDECIDED, UNSAFE})

    def test_of_a_single_amplitude_is_refused(self):
        result = self.overturn("boundary", "small.toml", "--set", "plane.amplitude.values=[3]")
        self.assert_exit(result, 65, "plane.amplitude has one value, 3")
        self.assertFalse((self.folder / "small_boundary.h5").exists())

    def test_is_described_by_info(self):
        self.have_boundary()
        self.assert_exit(self.overturn("info", "boundary.h5"), 0, "crossing 64 values",
                         "60 of 60 done, 64 x 1 flips each")

    def drawn(self, *arguments):
        """Returns the picture as SVG."""
        result = self.tool("plot_boundary", *arguments, "-o", "picture.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.folder / "picture.svg").read_text()

    def inside(self, name):
        """Returns the pixels of a picture that are well within the axes."""
        pixels = pyplot.imread(self.folder / name)[:, :, :3]
        height, width = pixels.shape[:2]
        return pixels[height // 4:-height // 8, width // 8:-width // 16]

    def shades(self, *arguments):
        """Returns those of the three shades that occur in the picture."""
        result = self.tool("plot_boundary", *arguments, "-o", "picture.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        inside = self.inside("picture.png")
        return {shade for shade in (UNSAFE, SAFE, UNDECIDED)
                if np.isclose(inside, to_rgb(shade), atol=1 / 255).all(axis=2).mean() > 0.01}

    def test_of_an_older_file_without_regions_is_plotted_as_undecided(self):
        self.have_boundary()
        with h5py.File(self.folder / "boundary.h5", "r+") as file:
            file["region_below"][:, :, 0] = np.where(np.isnan(file["flip_amplitude"][:, :, 0]),
                                                     CODE_OF_NO_FLIP, file["region_below"][:, :, 0])
        self.assertEqual(self.shades("boundary.h5", "--restitution", "0"),
                         {UNSAFE, SAFE, UNDECIDED})

    def test_is_plotted_with_overturning_amplitudes_shaded(self):
        self.have_boundary()
        picture = self.drawn("boundary.h5", "--restitution", "1")
        for words in ("minimum overturning amplitude", "other flips", "overturns", "safe"):
            self.assertIn(f">{words}<", picture)

    def test_is_not_shaded_beyond_the_scanned_amplitudes(self):
        # Two amplitudes, safe or not: 1/18 of the axis is below the first, 1/16 of 9/8, and only that is white. The
        # other end is above the flips and below the second amplitude.
        # The axis takes 0.725 to 0.755 of the height, by the lines of the legend; 0.71 of it are looked at.
        for last in ("1.1", "2"):
            self.assert_exit(self.overturn("boundary", "small.toml", "-o", f"few_{last}.h5",
                                           "--set", f"plane.amplitude={{ values = [1.0, {last}] }}",
                                           "--set", "plane.frequency.count=5", "--set", "plane.slenderness=0.2"), 0)
            self.assertGreater(len(self.shades(f"few_{last}.h5", "--restitution", "0")), 0)
            pixels = pyplot.imread(self.folder / "picture.png")[:, :, :3]
            height, width = pixels.shape[:2]
            middle = pixels[round(0.2 * height):round(0.91 * height), round(0.54 * width)]  # of the third frequency
            white = (middle == 1).all(axis=1).mean()
            self.assertGreater(white, 0.03)
            self.assertLess(white, 0.07)

    def test_finds_wide_ranges_between_two_amplitudes(self):
        # Blocks and pulses under which ranges of up to 1.4 g were missed.
        job = """
            scene.pulse = "symmetric_ricker"
            block = { width = 0.6, height = 2.4 }
            [plane]
            pga = { values = [0.2, 2.0] }
            pulse_period = { first = 1.2, last = 1.4, count = 6 }
            restitution_of_maximum = 0.85
            """
        (self.folder / "two.toml").write_text(textwrap.dedent(job))
        self.assert_exit(self.overturn("boundary", "two.toml", "-o", "two.h5"), 0)
        self.assert_exit(self.overturn("boundary", "two.toml", "-o", "many.h5", "--set",
                                       "plane.pga={ first = 0.2, last = 2.0, count = 400 }"), 0)
        with xarray.open_dataset(self.folder / "two.h5") as two, xarray.open_dataset(self.folder / "many.h5") as many:
            self.assertTrue((np.isfinite(two.flip_pga.values[0])).all())  # each of these blocks overturns
            np.testing.assert_allclose(two.flip_pga, many.flip_pga, rtol=1e-11)

    def test_of_several_blocks_is_a_sheet(self):
        self.have_boundary()
        self.assertEqual(self.tool("plot_boundary", "boundary.h5", "-o", "both.svg").returncode, 0)
        sheet = (self.folder / "both.svg").read_text()
        for title in ("r = 0.7 r_max = 0.6381", "r = r_max = 0.9115"):
            self.assertIn(title, sheet)
        self.assertEqual(sheet.count("minimum overturning amplitude</text>"), 1)

    def test_overlays_its_own_spectrum_only(self):
        self.have_boundary()
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        result = self.tool("plot_spectrum", "spectrum.h5", "--boundary", "boundary.h5", "-o", "both.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(">flip of the verdict<", (self.folder / "both.svg").read_text())
        for setting, words in (("plane.slenderness.values=[0.2]", "slenderness differs"),
                               ("scene.theory=linear", "has theory nonlinear")):
            self.overturn("run", "small.toml", "-o", "other.h5", *FEW, "--set", setting)
            result = self.tool("plot_spectrum", "other.h5", "--boundary", "boundary.h5")
            self.assertEqual(result.returncode, 74)
            self.assertIn(words, result.stderr)
            (self.folder / "other.h5").unlink()

    def test_plot_refuses_a_spectrum(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5", *FEW)
        result = self.tool("plot_boundary", "spectrum.h5")
        self.assertEqual(result.returncode, 74)
        self.assertIn("is not a boundary written by overturn boundary", result.stderr)


if __name__ == "__main__":
    unittest.main()
