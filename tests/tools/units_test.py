"""Pictures in seconds, degrees and g, and the tools for files whose axes have these units.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import os
import re
import shutil
import subprocess
import unittest

import h5py
import numpy as np
import xarray
from matplotlib import colors, pyplot
from plot_spectrum_test import F_MINUS, S, U0_MINUS, add_coordinate, shares, where
from recorded_spectra_test import Recorded
from tool import JOBS, InOneFolder  # first: adds the package to the path
import overturn
from overturn.overlay import draw_boundary, open_boundary
from overturn.plot import boundaries, histories
from overturn.choice import axes_of
from overturn.plot import spectra
from overturn.result_file import BOUNDARY, HISTORY, SPECTRUM, open_result
from overturn.regions import REGIONS, STANDS, TOPPLES
from overturn.spectrum_planes import Axis, Plane

P = np.sqrt(3 * 9.81 / (4 * np.hypot(0.3, 0.9)))  # [1/s]
PHYSICAL = ("--units", "physical")
JOB = """
    title = "A statue"
    scene.pulse = "one_sine"
    block = { width = 0.6, height = 1.8 }
    [plane]
    pulse_period = { first = 0.3, last = 2.0, count = 7 }
    pga = { first = 0.2, last = 3.0, count = 9 }
    restitution_of_maximum = 1.0
    """
RECORDED = """
    scene.record = "synthetic.AT2"
    [plane]
    size = { first = 0.5, last = 2.0, count = 3 }
    scale = { first = 1.0, last = 2.0, count = 5 }
    restitution = { values = [0.8] }
    slenderness = 0.25
    """
DIMENSIONLESS = ("plane.frequency={first=1.2, last=7.5, count=7}",
                 "plane.amplitude={first=0.6, last=9, count=9}")
SIZELESS = ("block={}", "plane.slenderness=0.3217505543966422", *DIMENSIONLESS)


def plane_of(file):
    """Returns the first plane of a file."""
    axes = axes_of(file, {})
    return Plane(file, {name: 0 for name in file.dimensions if name not in axes}, *axes)


def open_history(path):
    return open_result(path, HISTORY)


class Sized(Recorded):
    JOB = JOB

    def sized(self, codes, pulse_period, pga, **axes):
        """Writes a spectrum over frequency and amplitude for blocks of known size."""
        self.spectrum(codes, size=0.95, **axes)
        self.change(lambda file: add_coordinate(file, "pulse_period", pulse_period, "frequency"))
        self.change(lambda file: add_coordinate(file, "pga", pga, *["slenderness"] * (np.ndim(pga) - 1), "amplitude"))


class TestAPlaneInPhysicalUnits(Sized):
    def test_has_periods_that_ascend_while_frequencies_descend(self):
        # From the longest period on; midpoints are those on a logarithmic axis.
        frequency = np.arange(1.0, 31.0)
        regions = np.repeat([S, F_MINUS, U0_MINUS], [10, 10, 10])
        self.sized([regions], 10 / frequency, [0.4], frequency=frequency)
        picture = self.picture(*PHYSICAL)
        edges = np.log([1, 10, 11, 20, 21, 30])
        # The ends extend as far as the first and the last midpoint, but at most a sixteenth of the axis.
        first, last = edges[0] - np.log(30) / 16, edges[-1] + np.log(30 / 29) / 2
        between = [(edges[1] + edges[2]) / 2, (edges[3] + edges[4]) / 2]
        gap = np.log(2) - np.log(30) / 8  # between the frequencies 1 and 2
        widths = np.diff([first, *between, last]) - [gap, 0, 0]
        np.testing.assert_allclose(shares(picture, [S, F_MINUS, U0_MINUS]), widths / widths.sum(), atol=0.015)
        left, right = (np.median(np.argwhere(where(picture, code))[:, 1]) for code in (U0_MINUS, S))
        self.assertLess(left, right - 100)

    def test_has_cells_around_descending_values(self):
        axis = Axis(np.array([9.0, 5.0, 4.0]), are_counted=True, is_to_scale=True)
        np.testing.assert_array_equal(axis.edges, [3.5, 4.5, 7, 11])
        np.testing.assert_array_equal(axis.cells(15), [2, 2] + 5 * [1] + 8 * [0])

    def test_is_named_with_its_units(self):
        self.sized([[S]], [2.5], [0.4])
        words = self.words(*PHYSICAL)
        for label in ("pulse period [s]", "PGA [g]",
                      "one-sine pulse,  α = 5.73°,  r = 0.7 r_max = 0.625"):
            self.assertIn(label, words)
        self.assertNotIn("pulse period [s]", self.words())

    def test_has_a_vertical_axis_for_each_slenderness(self):
        self.sized(np.zeros((2, 1, 2, 2)), [2.5, 2.0], [[0.1, 0.3], [0.2, 0.6]])
        panels = spectra.spectrum(self.folder / "spectrum.h5", units="physical")
        np.testing.assert_allclose([panel.get_ylim() for panel in panels], [[0.01, 0.39], [0.02, 0.78]],
                                   atol=1e-15)

    def test_has_a_horizontal_axis_for_each_size(self):
        self.spectrum(np.zeros((2, 1, 2, 9)), size=0.95)
        periods = np.outer([1, 2], np.geomspace(0.1, 1, 9))
        for name, values, *dimensions in (("pulse_period", periods, "slenderness", "frequency"),
                                          ("pga", [0.4, 0.8], "amplitude")):
            self.change(lambda file: add_coordinate(file, name, values, *dimensions))
        panels = spectra.spectrum(self.folder / "spectrum.h5", units="physical")
        half = 10 ** (1 / 16)  # a step, in the logarithm
        np.testing.assert_allclose([panel.get_xlim() for panel in panels], [[0.1 / half, half], [0.2 / half, 2 * half]])

    def test_under_a_record_is_over_the_peak_acceleration(self):
        self.recorded([[S], [F_MINUS], [F_MINUS]])
        words = self.words(*PHYSICAL)
        self.assertIn("PGA [g]", words)
        self.assertIn("a.AT2,  α = 5.73°,  r = 0.7 r_max = 0.625", words)  # not PGA 0.4 g
        self.assertIn("1.2", words)

    def test_with_physical_axes_is_the_same_in_both_units(self):
        self.overturn("run", "spectrum.h5")
        words = self.words()
        self.assertIn("pulse period [s]", words)
        pictures = [self.picture(*units) for units in ((), PHYSICAL)]
        for code in (S, F_MINUS, U0_MINUS):
            np.testing.assert_array_equal(*(where(picture, code) for picture in pictures))

    def test_needs_the_size_of_the_block(self):
        point = ("plane.frequency=3", "plane.amplitude=1.3")
        for command, name, settings in (("run", "spectrum", ()), ("boundary", "boundary", ()),
                                        ("history", "history", point)):
            self.overturn(command, "spectrum.h5", *SIZELESS, *settings)
            self.refuses(74, "Add [block] with width and height to the job, or the half diagonal plane.size", *PHYSICAL,
                         tool=f"plot_{name}")
            (self.folder / "spectrum.h5").unlink()


class TestAPhysicalBoundary(Sized):
    def lines(self, *settings):
        self.overturn("boundary", "boundary.h5", *settings)
        with h5py.File(self.folder / "boundary.h5") as file:
            for name in ("flip_amplitude", "flip_pga"):
                self.assertGreater(np.isfinite(file[name][:]).sum(), 9)
            flips = file["flip_amplitude"][:]
        with open_result(self.folder / "boundary.h5", BOUNDARY) as file:
            return boundaries.Lines(plane_of(file), "physical"), flips

    def test_has_its_flips_and_its_scan_in_g(self):
        for theory, threshold in (("nonlinear", 1 / 3), ("linear", np.arctan(1 / 3))):
            lines, flips = self.lines(*DIMENSIONLESS, f"scene.theory={theory}")
            np.testing.assert_allclose(lines.flips, flips * threshold, rtol=1e-14)
            scan = np.linspace(0.6, 9, 9) * threshold
            np.testing.assert_allclose(lines.up.edges[:2], scan[:2] - (scan[1] - scan[0]) / 2,
                                       rtol=1e-13)
            np.testing.assert_allclose(lines.frequency,
                                       2 * np.pi / (P * np.linspace(1.2, 7.5, 7)), rtol=1e-14)
            (self.folder / "boundary.h5").unlink()

    def test_is_shaded_over_its_periods(self):
        # A pulse of 0.3 s overturns the block at no scanned amplitude, one of 1.9 s at most. The axis ends above the
        # flips of the latter.
        self.overturn("boundary", "boundary.h5", *DIMENSIONLESS, "plane.frequency.values=[1.2,7.5]",
                      "plane.amplitude.last=6")
        how = {"tool": "plot_boundary", "file": "boundary.h5"}
        picture = self.picture(*PHYSICAL, **how) / 255
        panel = picture[-640:-100, 120:-50]
        ends = panel[:, :80], panel[:, -80:]  # what is between was not computed
        safe, unsafe = ([np.isclose(end, colors.to_rgb(shade), atol=1 / 255).all(axis=2).mean()
                         for end in ends] for shade in (REGIONS[STANDS][2], REGIONS[TOPPLES][2]))
        self.assertGreater(safe[0], 0.95)
        self.assertGreater(unsafe[1], 0.5)
        picture = self.svg(*PHYSICAL, **how)
        for words in ("pulse period [s]", "PGA [g]", "one-sine pulse,  α = 18.43°"):
            self.assertIn(f">{words}", picture)

    def test_of_a_single_frequency_is_a_column_named_with_what_is_scanned(self):
        frequency = np.random.default_rng(1).uniform(2, 6)
        self.overturn("boundary", "boundary.h5", *DIMENSIONLESS, f"plane.frequency={frequency}")
        for units, word in (("job", "amplitude"), ("physical", "PGA")):
            panel = overturn.plot.boundary(self.folder / "boundary.h5", units=units)
            panel.figure.canvas.draw()
            size = panel.get_window_extent()
            self.assertLess(size.width, size.height / 3)
            self.assertEqual(panel.figure.legends[0].get_texts()[0].get_text(), f"minimum overturning {word}")
            pyplot.close("all")


class TestABoundaryAlongAnotherQuantity(Sized):
    ALONG = ("boundary.along=width", "block.width={values=[0.3, 0.6, 1.2]}", "plane.pga=1")

    def test_has_its_flips_and_its_scan_in_the_unit_of_the_quantity(self):
        self.overturn("boundary", "boundary.h5", *self.ALONG)
        with h5py.File(self.folder / "boundary.h5") as file:
            flips = file["flip_value"][:]
        with open_result(self.folder / "boundary.h5", BOUNDARY) as file:
            lines = boundaries.Lines(plane_of(file), "job")
        np.testing.assert_array_equal(lines.flips, flips)
        self.assertEqual(lines.scan, (0.3, 1.2))
        self.assertGreater(np.isfinite(flips).sum(), 3)
        words = "\n".join(["", *self.words(tool="plot_boundary", file="boundary.h5")])
        for text in ("width [m]", "pulse period [s]", "PGA = 1 g", "overturns at the first width of the job"):
            self.assertIn(f"\n{text}" if text != "PGA = 1 g" else text, words)

    def test_is_refused_in_physical_units_if_the_size_varies(self):
        self.overturn("boundary", "spectrum.h5", *self.ALONG)
        self.refuses(74, "the size of the block varies along width", *PHYSICAL, tool="plot_boundary")


class TestAnOverlaidBoundary(Sized):
    def dots(self, units="job"):
        """Returns the drawn points, in ascending order."""
        figure, panel = pyplot.subplots()
        with open_result(self.folder / "spectrum.h5", SPECTRUM) as spectrum, \
                open_boundary(self.folder / "boundary.h5", plane_of(spectrum), units) as boundary:
            draw_boundary(panel, boundary, plane_of(spectrum), units)
        points = np.transpose(panel.lines[-1].get_data())
        pyplot.close(figure)
        points = points[np.isfinite(points[:, 1])]
        self.assertGreater(len(points), 5)
        return points[np.lexsort(points.T)]

    def assert_dots(self, spectrum, boundary, across, flips, units="job"):
        """Asserts that the flips of the file are drawn at these values of each column."""
        for name in ("spectrum", "boundary"):
            (self.folder / f"{name}.h5").unlink(missing_ok=True)
        self.overturn("run", "spectrum.h5", *spectrum)
        self.overturn("boundary", "boundary.h5", *boundary)
        with h5py.File(self.folder / "boundary.h5") as file:
            settled = (file["region_below"][:] <= 8) & (file["region_above"][:] <= 8)
            points = np.transpose([np.broadcast_to(across, settled.shape)[settled],
                                   file[flips][:][settled]])
        np.testing.assert_allclose(self.dots(units), points[np.lexsort(points.T)], rtol=1e-13)

    def test_is_converted_to_the_axes_of_the_spectrum(self):
        periods, frequencies = np.linspace(0.3, 2.0, 7), np.linspace(1.2, 7.5, 7)
        hertz = ("plane.pulse_frequency={first=0.5, last=3, count=4}",)
        self.assert_dots((), (), periods, "flip_pga")
        self.assert_dots((), DIMENSIONLESS, 2 * np.pi / (P * frequencies), "flip_pga")
        self.assert_dots(DIMENSIONLESS, (), 2 * np.pi / (P * periods), "flip_amplitude")
        self.assert_dots(DIMENSIONLESS, (), periods, "flip_pga", "physical")
        self.assert_dots(hertz, (), 1 / periods, "flip_pga")
        self.assert_dots((), hertz, 1 / np.linspace(0.5, 3, 4), "flip_pga")
        self.assert_dots(SIZELESS, DIMENSIONLESS, frequencies, "flip_amplitude")

    def test_needs_the_size_of_its_block_if_the_axes_do(self):
        self.overturn("run", "spectrum.h5")
        self.overturn("boundary", "boundary.h5", *SIZELESS)
        self.refuses(74, "does not give the size of the block", "--boundary", "boundary.h5")

    def test_must_have_blocks_of_the_same_size_only_if_the_axes_depend_on_it(self):
        sized = (*SIZELESS, "plane.size=2")
        self.overturn("boundary", "boundary.h5", *sized)
        self.overturn("run", "spectrum.h5", *DIMENSIONLESS)
        self.assertGreater(len(self.dots()), 5)
        self.refuses(74, "has different blocks from the spectrum: size differs", "--boundary",
                     "boundary.h5", *PHYSICAL)

    def test_is_along_the_strength(self):
        self.overturn("run", "spectrum.h5")
        self.overturn("boundary", "boundary.h5", "boundary.along=width", "block.width={values=[0.3, 0.9]}", "plane.pga=1")
        self.refuses(74, "has flips along width", "--boundary", "boundary.h5")

    def test_covers_some_of_the_spectrum(self):
        self.overturn("run", "spectrum.h5")
        self.overturn("boundary", "boundary.h5", "plane.pulse_period={values=[2.5, 3]}")
        self.refuses(74, "covers pulse_period from 2.5 to 3, the spectrum only from 0.19375",
                     "--boundary", "boundary.h5")

    def test_under_a_record_must_have_the_same_record(self):
        for name in ("synthetic.AT2", "synthetic_vertical.AT2"):
            shutil.copy(JOBS / name, self.folder)
        over_pga = "plane.pga={first=0.3, last=1, count=5}"
        self.overturn("run", "spectrum.h5", over_pga, job=RECORDED)
        self.overturn("boundary", "boundary.h5", job=RECORDED)
        with h5py.File(self.folder / "boundary.h5") as file:
            highest = 0.4 * np.nanmax(file["flip_amplitude"])  # the record has a peak of 0.4 g
        self.assertAlmostEqual(self.dots()[:, 1].max(), highest, places=12)
        (self.folder / "spectrum.h5").unlink()
        self.overturn("run", "spectrum.h5", over_pga, "scene.record='synthetic_vertical.AT2'",
                      job=RECORDED)
        self.refuses(74, "was computed under different records from the spectrum", "--boundary", "boundary.h5")


class TestAPhysicalHistory(Sized):
    AT = ("plane.pulse_period=0.5", "plane.pga=0.9")

    def test_is_in_seconds_and_degrees(self):
        self.overturn("history", "history.h5", *self.AT)
        with open_history(self.folder / "history.h5") as file:
            history = histories.History(file, 0, np.inf, "physical")
            np.testing.assert_allclose(history.time, file["time"][:] / P)
            for name, power in (("angle", 0), ("velocity", 1), ("acceleration", 2)):
                np.testing.assert_allclose(history.values[name],
                                           np.degrees(file[name][:]) * P**power)
            self.assertAlmostEqual(history.limits("angle")[1], np.degrees(np.arctan(1 / 3)))
            # The velocity that just topples an upright block, and its square.
            fastest = np.degrees(P * 2 * np.sin(np.arctan(1 / 3) / 2))
            self.assertAlmostEqual(history.limits("velocity")[1], fastest)
            self.assertAlmostEqual(history.limits("q")[1], fastest**2)
        self.assertAlmostEqual(history.end_of_ground_motion, 0.5)
        picture = self.svg(*PHYSICAL, tool="plot_history", file="history.h5")
        for words in ("time since the start of the pulse  [s]", "tilt [degrees]",
                      "velocity [degrees/s]", "ground [g]", "limits for an upright block that does not overturn"):
            self.assertIn(f">{words}<", picture)

    def test_states_the_point_in_physical_units(self):
        dimensionless = (f"plane.frequency.values=[{2 * np.pi / (0.5 * P)!r}]",
                         "plane.amplitude.values=[2.7]")
        for settings in (self.AT, dimensionless):
            self.overturn("history", "history.h5", *settings)
            with open_history(self.folder / "history.h5") as file:
                self.assertTrue(histories.describe(file, "physical").startswith(
                    "period = 0.5 s, PGA = 0.9 g, $p$ = 2.785 1/s, α = 18.43°, $r$ = 0.7225: "))
                words = histories.describe(file)
                self.assertEqual("period" in words, settings == self.AT)
                self.assertEqual("omega_p" in words, settings != self.AT)


class TestAPhysicalHistoryOfABlockThatSlips(InOneFolder):
    TOOL = "plot_history"

    def history(self, *options, record=None):
        motion = ("--record", record, "--pga=2.5") if record else ("--period=0.5", "--pga=1.9")
        subprocess.run([os.environ["OVERTURN"], "topple", "--no-search", "--width=0.6", "--height=1.8", "--friction=0.45", *motion, *options,
                        "--history", "slip.h5"], cwd=self.folder, check=True, capture_output=True)
        with open_history(self.folder / "slip.h5") as file:
            return histories.History(file, 0, np.inf, "physical"), file["slide"][:]

    def test_has_a_unit_in_every_panel_but_that_of_a_ratio(self):
        for record, count in ((None, 7), (JOBS / "synthetic.AT2", 4)):
            self.history(record=record)
            panels = overturn.plot.history(self.folder / "slip.h5", units="physical")
            labels = [panel.get_ylabel() for panel in panels]
            self.assertEqual(len(labels), count)
            self.assertEqual([label for label in labels if not re.search(r"\[(g|mm|degrees.*)\]$", label)],
                             ["friction  $|H|/N$"])
            self.assertTrue(panels[-1].get_xlabel().endswith("[s]"))
            pyplot.close("all")

    def test_has_its_slide_in_mm_also_if_its_sides_differ(self):
        for options, size in (((), np.hypot(0.3, 0.9)), (("--center-offset=0.05", "--direction=0"), np.hypot(0.25, 0.9))):
            history, slide = self.history(*options)
            self.assertGreater(np.abs(slide).max(), 0.01)
            np.testing.assert_allclose(history.values["slide"], 1000 * size * slide, rtol=1e-14)


class TestPhysicalAxesInOtherTools(Sized):
    def test_are_columns_of_a_table_and_dimensions(self):
        self.overturn("run", "spectrum.h5")
        self.output_of("spectrum.h5", tool="to_csv")
        with open(self.folder / "spectrum.csv", newline="", encoding="ascii") as text:
            header, *rows = csv.reader(text)
        self.assertEqual(header[:2], ["pulse_period", "pga"])
        self.assertEqual(len(rows), 63)
        column = header.index("region")
        with xarray.open_dataset(self.folder / "spectrum.h5") as data:
            for row in rows:
                point = data.region.sel(pulse_period=float(row[0]), pga=float(row[1]))
                self.assertEqual(point.item(), int(row[column]))
            self.assertGreater(len(np.unique(data.region)), 2)


if __name__ == "__main__":
    unittest.main()
