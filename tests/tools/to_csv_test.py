"""Tables of tools/to_csv: all that a result file stores along the points is in them, whatever kind of file it is.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import itertools
import os
import subprocess
import unittest

import h5py
import numpy as np
from plot_spectrum_test import NOT_COMPUTED, add_coordinate, write_result
from tool import JOBS, InAFolder, InOneFolder  # adds the package to the path
import overturn
from overturn import csv_table
from overturn.datasets import opened

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
        with opened(self.folder / name)[0] as dataset:
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


    def slip(self, name, *options):
        """Writes the history of a block that slips."""
        subprocess.run([os.environ["OVERTURN"], "topple", "--width=0.6", "--height=1.8", "--friction=0.45", "--period=0.5",
                        "--pga=1.9", *options, "--history", name], cwd=self.folder, check=True, capture_output=True)


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

    def test_of_numbers_in_single_precision_has_their_digits(self):
        subprocess.run([os.environ["OVERTURN"], "run", JOBS / "smoke.toml", "-o", "single.h5", "--set",
                        'output.precision="single"'], cwd=self.folder, check=True, capture_output=True)
        rows = self.rows("single.h5")
        with h5py.File(self.folder / "single.h5") as file:
            stored = file["margin"][:].ravel()
        self.assertEqual(stored.dtype, np.float32)
        np.testing.assert_array_equal(np.array([row["margin"] for row in rows], np.float32), stored)
        self.assertLess(max(len(row["margin"]) for row in rows), 16)  # -1.2345678e-10

    def test_chooses_a_restitution_in_every_spelling(self):
        for name in ("restitution", "restitution_of_maximum", "velocity_restitution"):
            self.overturn("run", f"{name}.h5", "plane.pga.count=2", "plane.pulse_period.count=2",
                          f"plane.{name}={{ values = [0.7, 0.8] }}", job=JOBS / "statue.toml")
            rows = self.rows(f"{name}.h5", "--restitution", "1")
            self.assertEqual([row[name] for row in rows], ["0.8"] * 4)

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

    def test_of_a_boundary_along_another_quantity_has_its_values(self):
        self.overturn("boundary", "along.h5", "boundary.along=restitution_of_maximum", "plane.frequency=3",
                      "plane.restitution_of_maximum={values=[0.1,1]}", "plane.amplitude={values=[1.3,1.4,1.42]}",
                      job=JOBS / "smoke.toml")
        rows = self.rows("along.h5")
        with h5py.File(self.folder / "along.h5") as file:
            flips = file["flip_value"][:]
        self.assertEqual(flips.shape, (64, 3))
        self.assertEqual(len(rows), 1 + np.isfinite(flips).sum())
        for row in rows:
            np.testing.assert_equal(float(row["flip_value"]),
                                    flips[int(row["crossing"]), [1.3, 1.4, 1.42].index(float(row["amplitude"]))])

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

    def test_of_a_history_of_a_block_that_slips_is_replaced_by_another(self):
        self.slip("events.h5")
        for _ in range(2):
            self.rows("events.h5", "--events")

    def test_has_events_only_of_a_history(self):
        self.overturn("run", "spectrum.h5", "plane.frequency.count=2", "plane.amplitude.count=2", job=JOBS / "smoke.toml")
        self.refuses(2, "--events: \"spectrum.h5\" is no history", "spectrum.h5", "--events")


class TestATableWithUnits(Table, InOneFolder):
    """Values are compared with SI quantities that are computed here from width, height and g."""

    PHYSICAL = ("--units", "physical")
    SLIPPING = """
        scene.pulse = "one_sine"
        block = { width = 0.6, height = 1.8, friction = 0.45 }
        output.fields = ["region", "angle", "velocity", "fall_time", "slide", "slide_peak", "peak", "margin"]
        [plane]
        pulse_period = { values = [0.5, 1] }
        pga = { values = [0.5, 1.9] }
        restitution_of_maximum = 1
        """
    R = np.hypot(0.3, 0.9)
    P = np.sqrt(3 * 9.81 / (4 * R))

    def columns(self, name, *arguments):
        """Returns the columns, by name, and the units, by name."""
        rows = self.rows(name, *arguments)
        columns, units = {}, {}
        for head in rows[0]:
            name, _, unit = head.removesuffix("]").partition(" [")
            columns[name], units[name] = [row[head] for row in rows], unit
        return columns, units

    def expect(self, found, stored, factor, name):
        np.testing.assert_allclose(np.array(found, float), np.ravel(stored) * factor, rtol=1e-14, err_msg=name)

    def test_of_a_history_is_in_seconds_degrees_metres_and_weights(self):
        degree, p, r = 180 / np.pi, self.P, self.R
        expected = {"time": (1 / p, "s"), "angle": (degree, "degree"), "velocity": (degree * p, "degree s-1"),
                    "acceleration": (degree * p**2, "degree s-2"), "q": ((degree * p)**2, "degree2 s-2"),
                    "ground": (1, "g"), "friction_demand": (1, ""), "slide": (r, "m"), "slide_velocity": (r * p, "m s-1"),
                    "force_along": (1, "weight"), "force_normal": (1, "weight"), "mode": (1, "")}
        self.slip("slip.h5")
        samples, units = self.columns("slip.h5", *self.PHYSICAL)
        events, units_of_events = self.columns("slip.h5", "--events", *self.PHYSICAL)
        with h5py.File(self.folder / "slip.h5") as file:
            self.assertEqual(samples.keys(), expected.keys())
            for name, (factor, unit) in expected.items():
                self.assertEqual(units[name], unit)
                self.expect(samples[name], file[name][:], factor, name)
                for column in {name, f"{name}_before", f"{name}_after"} & events.keys():
                    self.assertEqual(units_of_events[column], unit)
                    self.expect(events[column], file[f"events/{column}"][:], factor, column)
            self.assertEqual(len(events), 2 + 2 * 10)  # time and kind; mode is not one of an event
            self.assertEqual({*samples["mode"]}, {"0", "2", "3"})
        values = {name: np.array(column, float) for name, column in samples.items()}
        self.assertAlmostEqual(values["ground"].max(), 1.9, places=4)
        self.assertAlmostEqual(values["angle"].max(), 90)
        # The trapezoidal rule over these steps of 1 ms is off by 3e-6 m; without p, it would be by 0.08 m.
        moved = np.sum(np.diff(values["time"]) * (values["slide_velocity"][1:] + values["slide_velocity"][:-1]) / 2)
        self.assertAlmostEqual(moved, values["slide"][-1], delta=1e-4)

    def test_in_units_of_the_job_has_the_values_of_the_file(self):
        self.slip("job.h5")
        columns, units = self.columns("job.h5", "--units", "job")
        with h5py.File(self.folder / "job.h5") as file:
            for name, values in columns.items():
                np.testing.assert_array_equal(np.array(values, float), file[name][:])
                declared = file[name].attrs.get("units", b"1").decode().replace("1", "", 1)
                self.assertEqual(units[name], {"ground": "g", "force_along": "weight",
                                               "force_normal": "weight"}.get(name, declared))

    def test_of_a_block_with_two_sides_has_slides_over_that_of_the_side_plus(self):
        self.slip("sides.h5", "--center-offset=0.05", "--direction=0")
        columns, _ = self.columns("sides.h5", *self.PHYSICAL)
        with h5py.File(self.folder / "sides.h5") as file:
            self.assertGreater(np.abs(file["slide"][:]).max(), 0.01)
            self.expect(columns["slide"], file["slide"][:], np.hypot(0.25, 0.9), "slide")

    def test_of_a_spectrum_converts_what_p_and_the_size_scale_and_keeps_codes(self):
        self.overturn("run", "fields.h5", job=self.SLIPPING)
        codes = [254, 255, 0, 7]
        with h5py.File(self.folder / "fields.h5", "r+") as file:
            file["region"][...] = np.reshape(codes, (2, 2))
            file["velocity"][0, 0] = np.nan
            stored = {name: file[name][:] for name in ("angle", "velocity", "fall_time", "slide", "slide_peak", "peak")}
        self.assertTrue(np.isinf(stored["fall_time"]).any() and np.isfinite(stored["fall_time"]).any())
        columns, units = self.columns("fields.h5", *self.PHYSICAL)
        degree = 180 / np.pi
        for name, factor, unit in (("angle", degree, "degree"), ("velocity", degree * self.P, "degree s-1"),
                                   ("fall_time", 1 / self.P, "s"), ("slide", self.R, "m"), ("slide_peak", self.R, "m"),
                                   ("peak", 1, "")):
            self.expect(columns[name], stored[name], factor, name)
            self.assertEqual(units[name], unit)
        self.assertEqual(columns["region"], [str(code) for code in codes])
        self.assertEqual(columns["velocity"][0], "nan")
        self.assertAlmostEqual(float(columns["slenderness"][0]), np.degrees(np.arctan(1 / 3)), places=12)
        self.assertEqual([units[name] for name in ("pga", "pulse_period", "size", "slenderness", "region", "margin")],
                         ["g", "s", "m", "degree", "", ""])

    def test_converts_each_point_by_its_own_size(self):
        self.overturn("run", "sizes.h5", "plane.size={values=[0.5,2]}", "plane.scale={values=[1.9,2.5]}",
                      'output.fields=["region","velocity"]', job=JOBS / "synthetic.toml")
        columns, _ = self.columns("sizes.h5", *self.PHYSICAL)
        size = np.array(columns["size"], float)
        with h5py.File(self.folder / "sizes.h5") as file:
            self.assertTrue(file["velocity"][:].all())
            self.expect(columns["velocity"], file["velocity"][:], np.degrees(np.sqrt(3 * 9.81 / (4 * size))), "velocity")

    def test_does_not_convert_a_column_of_blocks_that_has_the_name_of_a_quantity(self):
        (self.folder / "list.csv").write_text("time,width,height,restitution_of_maximum,pga,pulse_period\n"
                                              "4,0.5,1.5,0.9,0.5,0.4\n1990,0.5,1.6,0.9,0.5,0.4\n")
        self.overturn("run", "list.h5", job='scene.pulse="one_sine"\nblocks.table="list.csv"\n')
        columns, units = self.columns("list.h5", *self.PHYSICAL)
        self.assertEqual((columns["time"], units["time"]), (["4", "1990"], ""))

    def test_of_a_boundary_or_study_has_units(self):
        smoke = ("plane.frequency.count=2", "plane.amplitude.count=4")
        self.overturn("boundary", "boundary.h5", *smoke, job=JOBS / "smoke.toml")
        columns, units = self.columns("boundary.h5", *self.PHYSICAL)
        self.assertEqual([units[name] for name in ("flip_pga", "flip_amplitude", "slenderness")], ["g", "", "degree"])
        self.assertAlmostEqual(float(columns["slenderness"][0]), np.degrees(np.arctan(1 / 5.67)), places=12)
        self.overturn("accuracy", "study.h5", *smoke, job=JOBS / "smoke.toml")
        _, units = self.columns("study.h5", "--units", "job")
        self.assertEqual([units[name] for name in ("seconds_per_point", "angle_error_0.99", "steps")], ["s", "rad", ""])
        self.refuses(2, "--units physical: \"study.h5\" is of blocks of all sizes", "study.h5", *self.PHYSICAL)

    def test_needs_the_size_of_the_block_for_physical_ones(self):
        self.overturn("run", "sizeless.h5", "plane.frequency.count=2", "plane.amplitude.count=2", "block={}",
                      "plane.slenderness=0.3", job=JOBS / "smoke.toml")
        self.refuses(74, "does not give the size of the block", "sizeless.h5", *self.PHYSICAL)


if __name__ == "__main__":
    unittest.main()
