"""Behaviour of the tools for tiles that are not marked as computed but contain values: zeros, which
would be safe blocks.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import unittest

import h5py
import numpy as np
from matplotlib import colors
from plot_spectrum_test import Picture
from tool import InAFolder  # first: adds the package to the path
import overturn
from overturn.regions import HATCH, NOT_COMPUTED, REGIONS
from overturn.result_file import BOUNDARY, SPECTRUM, open_result

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


class TestATileWithoutAMark(InAFolder):
    TOOL, FILE, JOB = "plot_spectrum", "spectrum.h5", JOB

    def compute(self):
        self.overturn("run", "spectrum.h5")
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            self.assertNotIn(SAFE, file["region"][...])
            file["run/checksum"][4] = 0
            for data in file.values():
                if getattr(data, "ndim", 0) == 2:
                    data[UNMARKED] = 0

    def count(self, colour, picture):
        return np.count_nonzero((picture == np.round(255 * np.array(colors.to_rgb(colour)))).all(axis=2))

    def test_reads_as_not_computed_in_every_field(self):
        self.compute()
        unmarked = np.zeros((ROWS, COLUMNS), bool)
        unmarked[UNMARKED] = True
        fills = {"region": 255, "status": 255, "impacts": 65534, "steps": 4294967295}
        with open_result(self.folder / "spectrum.h5", SPECTRUM) as file:
            for name in ("region", "angle", "velocity", "margin", "impacts", "steps", "status"):
                values = file[name][:]
                np.testing.assert_array_equal(values[unmarked], fills.get(name, np.nan), name)
                np.testing.assert_array_equal(values[~unmarked], file.file[name][:][~unmarked], name)
                # Ranges of rows that begin and end within tiles, and single points.
                np.testing.assert_array_equal(file[name][10:70], values[10:70], name)
                np.testing.assert_array_equal(file[name][63:66, 64], values[63:66, 64], name)
                np.testing.assert_array_equal(file[name][70, 70], values[70, 70], name)

    def test_is_hatched_in_the_map(self):
        self.compute()
        self.assertEqual(self.count(REGIONS[SAFE][2], self.picture()), 0)
        words = self.words()
        self.assertIn("not computed yet", words)
        self.assertFalse([word for word in words if "safe" in word])
        self.assertIn("unfinished: 5 of 6 tiles computed", " ".join(words))

    def test_of_another_part_is_hatched_too(self):
        self.overturn("run", "spectrum.h5", "--part=2/3")
        words = self.words()
        self.assertIn("not computed yet", words)
        self.assertFalse([word for word in words if "safe" in word])
        self.assertIn("part 2 of 3, unfinished: 2 of 6 tiles computed", " ".join(words))
        with self.assertWarnsRegex(UserWarning, "part 2 of 3, unfinished"), \
                overturn.open(self.folder / "spectrum.h5") as part:
            self.assertEqual((part.attrs["part"], part.attrs["parts"]), (2, 3))
            self.assertTrue(((part.region == NOT_COMPUTED) == np.isnan(part.margin)).all())

    def test_has_no_end_states(self):
        self.compute()
        with_zeros = self.picture(tool="plot_landing")
        self.assertGreater(self.count(HATCH["facecolor"], with_zeros), 1000)  # hatched; letters have about a hundred such pixels
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            file["region"][UNMARKED] = NOT_COMPUTED
        np.testing.assert_array_equal(self.picture(tool="plot_landing"), with_zeros)

    def test_is_a_row_of_fill_values_in_a_table(self):
        self.compute()
        done = self.run_tool("spectrum.h5", "-o", "table.csv", tool="to_csv")
        self.assertRegex(done.stderr, r"^to_csv: spectrum.h5: unfinished: \d of \d tiles computed; the other rows have fill values\n$")
        with open(self.folder / "table.csv", newline="", encoding="ascii") as text:
            rows = list(csv.DictReader(text))
        for i, row in enumerate(rows):
            within = (UNMARKED[0].start <= i // COLUMNS < UNMARKED[0].stop
                      and UNMARKED[1].start <= i % COLUMNS < UNMARKED[1].stop)
            self.assertEqual((row["region"] == "255", row["margin"] == "nan",
                              row["steps"] == "4294967295"), (within,) * 3, i)

    def test_has_no_flips(self):
        self.overturn("boundary", "boundary.h5", "plane.frequency={first=3, last=8, count=20}",
                      "plane.amplitude.first=1")
        how = {"tool": "plot_boundary", "file": "boundary.h5"}
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            self.assertEqual(len(file["run/checksum"]), 20)
            file["run/checksum"][7] = 0
            file["region_below"][..., 7] = file["region_above"][..., 7] = 0
            file["flip_amplitude"][..., 7] = 5.0
        with open_result(self.folder / "boundary.h5", BOUNDARY) as file:
            self.assertTrue(np.isnan(file["flip_amplitude"][:, 7]).all())
            self.assertEqual(set(file["region_above"][:, 7]), {NOT_COMPUTED})
        with_zeros = self.picture(**how)
        with h5py.File(self.folder / "boundary.h5", "a") as file:
            for name in ("region_below", "region_above", "flip_amplitude"):
                file[name][..., 7] = file[name].fillvalue
        np.testing.assert_array_equal(self.picture(**how), with_zeros)
        self.assertIn("not computed yet", self.words(**how))


class TestAFileWhoseTilesDoNotMatch(Picture):
    def test_is_damaged(self):
        self.spectrum(np.zeros((2, 2)))
        self.change(lambda file: file["run/checksum"].attrs.update({"tile_shape": [1, 1, 2, 1]}))
        self.refuses(74, "is damaged: it has 4 checksums", "spectrum.h5")

    def test_is_damaged_without_usable_marks(self):
        def replace(marks):
            def change(file):
                file.attrs["program_version"] = "2"
                del file["run/checksum"]
                if marks is not None:
                    file["run/checksum"] = marks
            return change
        for marks in (None, np.zeros((2, 2), np.uint64), np.zeros(4), "1111"):
            self.spectrum(np.zeros((2, 2)))
            self.change(replace(marks))
            self.refuses(74, "lacks run/checksum", "spectrum.h5")
            with self.assertRaisesRegex(OSError, "lacks run/checksum"):
                overturn.open(self.folder / "spectrum.h5")


if __name__ == "__main__":
    unittest.main()
