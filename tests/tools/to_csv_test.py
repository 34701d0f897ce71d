"""Tables of tools/to_csv: all that a result file stores along the points is in them, whatever kind of file it is.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import itertools
import unittest

import h5py
import numpy as np
from plot_spectrum_test import NOT_COMPUTED, add_coordinate, write_result
from tool import JOBS, InAFolder, InOneFolder  # adds the package to the path
import overturn
from overturn import csv_table

WORDS = ("urn", "Säule, alt", 'the "lion"', "two\nlines", "", "7")


class Table(InAFolder):
    TOOL = "to_csv"

    def rows(self, name, *arguments):
        self.output_of(name, "-o", "table.csv", *arguments)
        content = (self.folder / "table.csv").read_bytes()
        self.assertTrue(csv_table.is_own(content[:4096]))
        with open(self.folder / "table.csv", newline="", encoding="utf-8") as text:
            return list(csv.DictReader(text))

    def expect_all_of(self, name):
        """Compares each row with the data set; returns the data set and the rows."""
        rows = self.rows(name)
        with overturn.open(self.folder / name) as dataset:
            dataset.load()
        dimensions = dataset.region.dims
        self.assertEqual(rows[0].keys(), {*dataset.variables})
        self.assertEqual([*rows[0]][:len(dimensions)], [*reversed(dimensions)])
        self.assertEqual(len(rows), dataset.region.size)
        for name, variable in dataset.variables.items():
            values = variable.set_dims({each: dataset.sizes[each] for each in dimensions}).transpose(*dimensions).values
            column = [row[name] for row in rows]
            if values.dtype == object:
                self.assertEqual(column, values.ravel().tolist(), name)
            else:
                np.testing.assert_array_equal(np.array(column, float), values.ravel(), name)
        return dataset, rows


class TestATableOfASpectrum(Table):
    def write(self, sizes, draw):
        """Writes a spectrum of these sizes with coordinates of numbers and of texts along some of its dimensions."""
        axes = {name: np.sort(draw.uniform(0, 9, size)) for name, size in sizes.items()}
        for name in {"motion", "block"} & axes.keys():
            axes[name] = np.arange(1.0, sizes[name] + 1)
        codes = draw.choice([0, 3, NOT_COMPUTED], [*sizes.values()]).astype(np.uint8)
        with h5py.File(self.folder / "result.h5", "w") as file:
            file.attrs.update({"pulse": "one_sine", "program_version": "2"})
            write_result(file, axes, codes, codes != NOT_COMPUTED, False)
            for name, count in (("pga", 2), ("height", 1), ("size", 0)):
                along = [each for each in axes if draw.integers(2)][:count]
                if name not in axes:
                    add_coordinate(file, name, draw.uniform(0, 1, [sizes[each] for each in along]), *along)
            texts = np.array([list(word.encode().ljust(11, b"\0")) for word in draw.choice(WORDS, [*sizes.values()][0])],
                             np.uint8).view("S1")
            file["letters"] = np.zeros(11)
            file["letters"].make_scale("This is a netCDF dimension but not a netCDF variable.")
            add_coordinate(file, "name", texts, next(iter(axes)), "letters")

    def test_has_every_coordinate_beside_every_field_of_any_dimensions(self):
        draw = np.random.default_rng(19)
        names = ("motion", "block", "scale", "amplitude", "frequency", "direction")
        for count, number in itertools.product(range(1, 5), range(5)):
            chosen = sorted(draw.choice(len(names), count, replace=False))
            sizes = {names[each]: int(draw.integers(1, 4)) for each in chosen}
            with self.subTest(sizes=sizes, number=number):
                self.write(sizes, draw)
                self.expect_all_of("result.h5")
                (self.folder / "result.h5").unlink()

    def test_numbers_the_blocks_and_names_them_as_the_job_does(self):
        self.overturn("run", "result.h5", "plane.pulse_period.count=2", "plane.pga.count=2", job=JOBS / "statues.toml")
        _, rows = self.expect_all_of("result.h5")
        self.assertEqual([(row["block"], row["inventory"], row["width"], row["kind"]) for row in rows[::4]][:2],
                         [("1", "A-01", "0.42", "bust on a plinth"), ("2", "A-02", "0.38", "bust on a plinth")])

    def test_of_a_list_of_blocks_has_a_row_for_each(self):
        (self.folder / "list.csv").write_text(
            "floor,mass,width,height,restitution_of_maximum,pga,pulse_period,note\n"
            '3,1.5,0.5,1.5,0.9,0.5,0.4,"x, ""y"""\n4,2,0.5,1.6,0.9,0.5,0.4,\n')
        self.overturn("run", "result.h5", job='scene.pulse="one_sine"\nblocks.table="list.csv"\n')
        _, rows = self.expect_all_of("result.h5")
        self.assertEqual([[row[name] for name in ("block", "floor", "mass", "note")] for row in rows],
                         [["1", "3", "1.5", 'x, "y"'], ["2", "4", "2.0", ""]])

    def test_of_blocks_that_slip_has_their_friction_and_slide(self):
        job = """
            scene.pulse = "one_sine"
            {block}
            output.fields = ["region", "slide", "slide_peak", "status"]
            [plane]
            pulse_period = 0.5
            pga = {{ first = 0.3, last = 2.5, count = 4 }}
            restitution_of_maximum = 1
            """
        self.overturn("run", "axis.h5", job=job.format(
            block="block = { width = 0.6, height = 1.8, friction = { values = [0.2, 0.4] } }"))
        dataset, rows = self.expect_all_of("axis.h5")
        self.assertEqual(dataset.region.dims, ("friction", "pga"))
        self.assertEqual({row["friction"] for row in rows}, {"0.2", "0.4"})
        self.assertIn("64", [row["status"] for row in rows])
        (self.folder / "t.csv").write_text("width,height,friction\n0.6,1.8,0.2\n0.6,1.8,0.4\n")
        self.overturn("run", "list.h5", job=job.format(block='blocks.table = "t.csv"'))
        _, listed = self.expect_all_of("list.h5")
        for name in ("friction", "pga", "region", "slide", "slide_peak", "status"):
            self.assertEqual([row[name] for row in listed], [row[name] for row in rows])

    def test_of_a_single_point_has_one_row(self):
        self.overturn("run", "result.h5", "plane.frequency=3", "plane.amplitude=1.5", job=JOBS / "smoke.toml")
        _, rows = self.expect_all_of("result.h5")
        self.assertEqual((len(rows), rows[0]["frequency"]), (1, "3.0"))


class TestATableOfAnotherResult(Table, InOneFolder):
    def test_of_a_boundary_has_a_row_for_each_flip_and_one_for_a_line_without_flips(self):
        self.overturn("boundary", "boundary.h5", "plane.frequency={values=[1,3,12]}", "plane.slenderness={values=[0.1,0.2]}",
                      "plane.amplitude.count=20", job=JOBS / "smoke.toml")
        rows = self.rows("boundary.h5")
        with overturn.open(self.folder / "boundary.h5") as dataset:
            self.assertEqual(rows[0].keys(), {*dataset.variables})
            self.assertEqual(sum(row["flip_amplitude"] != "nan" for row in rows), dataset.flip_amplitude.count())
            self.assertEqual(sum(row["crossing"] == "0" for row in rows), 6)
            for row in rows:
                line = dataset.sel(frequency=float(row["frequency"]), slenderness=float(row["slenderness"]),
                                   crossing=int(row["crossing"]))
                for name in (*dataset.data_vars, "restitution"):
                    np.testing.assert_equal(float(row[name]), float(line[name]), name)

    def test_of_a_history_has_its_samples_or_its_events(self):
        for name, job, settings in (("pulse", "smoke", ("plane.frequency=3", "plane.amplitude=1.5")),
                                    ("record", "synthetic", ("plane.scale=1", "plane.size=1"))):
            self.overturn("history", f"{name}.h5", *settings, job=JOBS / f"{job}.toml")
            samples, events = self.rows(f"{name}.h5"), self.rows(f"{name}.h5", "--events")
            with h5py.File(self.folder / f"{name}.h5") as file:
                for column in samples[0]:
                    np.testing.assert_array_equal([float(row[column]) for row in samples], file[column][:])
                self.assertEqual(len(samples), len(file["time"]))
                kinds = file["events/kind"].attrs["flag_meanings"].decode().split()
                self.assertEqual([row["kind"] for row in events], [kinds[kind] for kind in file["events/kind"][:]])
                for column in events[0].keys() - {"kind"}:
                    np.testing.assert_array_equal([float(row[column]) for row in events], file[f"events/{column}"][:])

    def test_of_an_accuracy_study_has_a_row_for_each_setting(self):
        self.overturn("accuracy", "study.h5", "plane.frequency.count=2", "plane.amplitude.count=2", job=JOBS / "smoke.toml")
        rows = self.rows("study.h5")
        with h5py.File(self.folder / "study.h5") as file:
            for column, values in (("tolerance", file["tolerance"][:]), ("margin_error_0.99", file["margin_error"][:, 2]),
                                   ("wrong_verdicts_by_region_U0+", file["wrong_verdicts_by_region"][:, 3])):
                np.testing.assert_array_equal([float(row[column]) for row in rows], values)

    def test_has_events_only_of_a_history(self):
        self.overturn("run", "spectrum.h5", "plane.frequency.count=2", "plane.amplitude.count=2", job=JOBS / "smoke.toml")
        self.refuses(2, "--events: \"spectrum.h5\" is no history", "spectrum.h5", "--events")


if __name__ == "__main__":
    unittest.main()
