"""Behaviour of the tools for tiles that are not marked as computed but contain values: zeros, which
would be safe blocks.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import h5py
import numpy as np
from matplotlib import colors, image
from plot_spectrum_test import Picture
from tool import run_tool  # first: adds the package to the path
from overturn.fields import read_field
from overturn.regions import NOT_COMPUTED, REGIONS
from overturn.result_file import open_result
from overturn.spectrum_file import open_spectrum

OVERTURN = os.environ["OVERTURN"]
SAFE = 0
ROWS, COLUMNS = 100, 150
# Every block overturns during the pulse; 2 x 3 tiles.
JOB = f"""
[scene]
pulse = "one_sine"
[plane]
frequency = {{ first = 0.5, last = 1.5, count = {COLUMNS} }}
amplitude = {{ first = 8.0, last = 12.0, count = {ROWS} }}
restitution = 0.9
slenderness = 0.1745716
[output]
fields = ["region", "angle", "velocity", "margin", "impacts", "steps", "status"]
"""
UNMARKED = slice(64, 100), slice(64, 128)  # tile 4


class TestATileWithoutAMark(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "job.toml").write_text(JOB)

    def overturn(self, *arguments):
        subprocess.run([OVERTURN, *arguments], cwd=self.folder, check=True, capture_output=True,
                       timeout=100)

    def compute(self):
        self.overturn("run", "job.toml", "-o", "spectrum.h5")
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            self.assertNotIn(SAFE, file["region"][...])
            file["run/checksum"][4] = 0
            for data in file.values():
                if getattr(data, "ndim", 0) == 2:
                    data[UNMARKED] = 0

    def run_tool(self, *arguments):
        run = run_tool(*arguments, cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def count(self, colour):
        picture = np.round(255 * image.imread(self.folder / "picture.png")[..., :3])
        there = picture == np.round(255 * np.array(colors.to_rgb(colour)))
        return np.count_nonzero(there.all(axis=2))

    def test_reads_as_not_computed_in_every_field(self):
        self.compute()
        unmarked = np.zeros((ROWS, COLUMNS), bool)
        unmarked[UNMARKED] = True
        fills = {"region": 255, "status": 255, "impacts": 65534, "steps": 4294967295}
        with open_spectrum(self.folder / "spectrum.h5") as file:
            for name in ("region", "angle", "velocity", "margin", "impacts", "steps", "status"):
                values = read_field(file, name)
                np.testing.assert_array_equal(values[unmarked], fills.get(name, np.nan), name)
                np.testing.assert_array_equal(values[~unmarked], file[name][:][~unmarked], name)
                # Ranges of rows that begin and end within tiles.
                np.testing.assert_array_equal(read_field(file, name, (slice(10, 70),)),
                                              values[10:70], name)

    def test_is_hatched_in_the_map(self):
        self.compute()
        self.run_tool("plot_spectrum", "spectrum.h5", "-o", "picture.png")
        self.assertEqual(self.count(REGIONS[SAFE][2]), 0)
        self.run_tool("plot_spectrum", "spectrum.h5", "-o", "picture.svg")
        words = re.findall(r"<text[^>]*>([^<]+)", (self.folder / "picture.svg").read_text("utf-8"))
        self.assertIn("not computed yet", words)
        self.assertFalse([word for word in words if "safe" in word])
        self.assertIn("unfinished: 5 of 6 tiles computed", " ".join(words))

    def test_has_no_end_states(self):
        self.compute()
        self.run_tool("plot_landing", "spectrum.h5", "-o", "picture.png")
        self.assertGreater(self.count("0.8"), 1000)  # the colour of points not computed
        with_zeros = image.imread(self.folder / "picture.png")
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            file["region"][UNMARKED] = NOT_COMPUTED
        self.run_tool("plot_landing", "spectrum.h5", "-o", "picture.png")
        np.testing.assert_array_equal(image.imread(self.folder / "picture.png"), with_zeros)

    def test_is_a_row_of_fill_values_in_a_table(self):
        self.compute()
        self.run_tool("to_csv", "spectrum.h5", "-o", "table.csv")
        with open(self.folder / "table.csv", newline="", encoding="ascii") as text:
            rows = list(csv.DictReader(text))
        for i, row in enumerate(rows):
            within = (UNMARKED[0].start <= i // COLUMNS < UNMARKED[0].stop
                      and UNMARKED[1].start <= i % COLUMNS < UNMARKED[1].stop)
            self.assertEqual((row["region"] == "255", row["margin"] == "nan",
                              row["steps"] == "4294967295"), (within,) * 3, i)

    def test_has_no_flips(self):
        self.overturn("boundary", "job.toml", "-o", "boundary.h5", "--set=plane.frequency.count=20",
                      "--set=plane.frequency.first=3", "--set=plane.frequency.last=8",
                      "--set=plane.amplitude.first=1")
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            self.assertEqual(len(file["run/checksum"]), 20)
            file["run/checksum"][7] = 0
            file["region_below"][..., 7] = file["region_above"][..., 7] = 0
            file["flip_amplitude"][..., 7] = 5.0
        with open_result(self.folder / "boundary.h5", "overturning boundary", "a boundary") as file:
            self.assertTrue(np.isnan(read_field(file, "flip_amplitude")[:, 7]).all())
            self.assertEqual(set(read_field(file, "region_above")[:, 7]), {NOT_COMPUTED})
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.png")
        with_zeros = image.imread(self.folder / "picture.png")
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            for name in ("region_below", "region_above", "flip_amplitude"):
                file[name][..., 7] = file[name].fillvalue
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.png")
        np.testing.assert_array_equal(image.imread(self.folder / "picture.png"), with_zeros)
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.svg")
        self.assertIn(">not computed yet<", (self.folder / "picture.svg").read_text("utf-8"))


class TestAFileWhoseTilesDoNotMatch(Picture):
    def test_is_damaged(self):
        self.spectrum(np.zeros((2, 2)))
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            del file["run/checksum"].attrs["tile_shape"]
            file["run/checksum"].attrs["tile_shape"] = [1, 1, 2, 1]
        run = self.plot("spectrum.h5")
        self.assertEqual(run.returncode, 74)
        self.assertIn("is damaged: it has 4 checksums", run.stderr)


if __name__ == "__main__":
    unittest.main()
