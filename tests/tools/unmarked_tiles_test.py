"""Behaviour of the tools for tiles that are not marked as computed but contain values: zeros, which
would be safe blocks.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from matplotlib import colors, image
from tool import TOOLS, run_tool  # first: adds the package to the path
from overturn.fields import read_field
from overturn.regions import NOT_COMPUTED, REGIONS

sys.path.insert(0, str(TOOLS / "paper"))
from packed_spectrum import FIELDS, PackedSpectrum  # noqa: E402

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
restitution = {{ values = [0.9] }}
slenderness = {{ values = [0.1745716] }}
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
                if getattr(data, "ndim", 0) == 4:
                    data[0, 0, UNMARKED[0], UNMARKED[1]] = 0

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
        with h5py.File(self.folder / "spectrum.h5") as file:
            for name in ("region", "angle", "velocity", "margin", "impacts", "steps", "status"):
                values = read_field(file, name, (0, 0))
                np.testing.assert_array_equal(values[unmarked], fills.get(name, np.nan), name)
                np.testing.assert_array_equal(values[~unmarked], file[name][0, 0][~unmarked], name)
                # Ranges of rows that begin and end within tiles.
                np.testing.assert_array_equal(read_field(file, name, (0, 0), slice(10, 70)),
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
            file["region"][0, 0, UNMARKED[0], UNMARKED[1]] = NOT_COMPUTED
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

    def test_has_no_points_on_the_page(self):
        self.compute()
        with_zeros = PackedSpectrum(self.folder / "spectrum.h5").text
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            for name in ("region", *FIELDS):
                file[name][0, 0, UNMARKED[0], UNMARKED[1]] = file[name].fillvalue
        self.assertEqual(PackedSpectrum(self.folder / "spectrum.h5").text, with_zeros)

    def test_stops_a_description_for_paraview(self):
        self.compute()
        run = run_tool("to_xdmf", "spectrum.h5", cwd=self.folder)
        self.assertEqual(run.returncode, 74)
        self.assertIn("has values of region in tiles that are not marked as computed", run.stderr)
        self.assertFalse((self.folder / "spectrum.xdmf2").exists())

    def test_stops_a_join(self):
        self.compute()
        run = run_tool("join_spectra", "spectrum.h5", "-o", "joined.h5", "--overturn", OVERTURN,
                       cwd=self.folder)
        self.assertEqual(run.returncode, 74)
        self.assertIn("unfinished: 1 of 6 tiles", run.stderr)

    def test_has_no_flips(self):
        self.overturn("boundary", "job.toml", "-o", "boundary.h5", "--set=plane.frequency.count=20",
                      "--set=plane.frequency.first=3", "--set=plane.frequency.last=8",
                      "--set=plane.amplitude.first=1")
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            self.assertEqual(len(file["run/checksum"]), 20)
            file["run/checksum"][7] = 0
            file["region_below"][..., 7] = file["region_above"][..., 7] = 0
            file["flip_amplitude"][..., 7] = 5.0
            self.assertTrue(np.isnan(read_field(file, "flip_amplitude", (0, 0))[:, 7]).all())
            self.assertEqual(set(read_field(file, "region_above", (0, 0))[:, 7]), {NOT_COMPUTED})
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.png")
        with_zeros = image.imread(self.folder / "picture.png")
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            for name in ("region_below", "region_above", "flip_amplitude"):
                file[name][..., 7] = file[name].fillvalue
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.png")
        np.testing.assert_array_equal(image.imread(self.folder / "picture.png"), with_zeros)
        self.run_tool("plot_boundary", "boundary.h5", "-o", "picture.svg")
        self.assertIn(">not computed yet<", (self.folder / "picture.svg").read_text("utf-8"))


class TestAFileWhoseTilesDoNotMatch(unittest.TestCase):
    def test_is_damaged(self):
        with h5py.File("damaged", "w", driver="core", backing_store=False) as file:
            file.create_dataset("region", data=np.zeros((1, 1, 2, 2), np.uint8), fillvalue=255)
            file["checksum"] = np.ones(3, np.uint64)
            file["checksum"].attrs["tile_shape"] = [1, 1]
            with self.assertRaisesRegex(Exception, "3 checksums"):
                read_field(file, "region", (0, 0))


if __name__ == "__main__":
    unittest.main()
