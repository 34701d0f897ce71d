"""Spectra under recorded ground motions in plot_spectrum, plot_landing and to_csv.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import shutil
import unittest

import h5py
import numpy as np
from plot_spectrum_test import (F_MINUS, NOT_COMPUTED, S, UNDECIDED, Picture, add_coordinate, add_field, shares,
                                where, write_result)
from tool import JOBS  # adds the package to the path
from overturn.result_file import SPECTRUM, open_result
from overturn.spectrum_planes import Plane
from overturn.units import name_axes

FREE_FALL = 16


class Recorded(Picture):
    def recorded(self, codes, motions=("a.AT2",), up="scale", across="size", computed=None,
                 **axes):
        """Writes a spectrum under records with the given codes; outer dimensions may be omitted.
        Each point is a tile, computed unless its code or `computed` states otherwise."""
        codes = np.array(codes, np.uint8)
        codes = codes.reshape((1,) * (5 - codes.ndim) + codes.shape)
        count, slendernesses, restitutions, rows, columns = codes.shape
        computed = codes != NOT_COMPUTED if computed is None else computed
        values = {"motion": np.arange(1.0, count + 1), "slenderness": np.linspace(0.1, 0.2, slendernesses),
                  "restitution_of_maximum": np.linspace(0.7, 1, restitutions),
                  up: axes.get(up, np.arange(1.0, rows + 1)), across: axes.get(across, np.arange(1.0, columns + 1))}
        with h5py.File(self.folder / "spectrum.h5", "w") as file:
            file.attrs.update({"title": "", "record": "a.AT2", "gravity": 9.81, "theory": "nonlinear"})
            write_result(file, values, codes, computed)
            longest = max(len(name.encode()) for name in motions)
            file["motion_name_length"] = np.zeros(longest, ">f4")
            file["motion_name_length"].make_scale("This is a netCDF dimension but not a netCDF variable.")
            add_coordinate(file, "motion_name", np.array([list(name.encode().ljust(longest, b"\0"))
                                                          for name in motions], np.uint8).view("S1"),
                           "motion", "motion_name_length")
            add_coordinate(file, "record_pga", 0.4 + 0.1 * np.arange(count), "motion")
            if up == "scale":
                add_coordinate(file, "pga", np.outer(0.4 + 0.1 * np.arange(count), values[up]), "motion", "scale")

    def add(self, name, values, fill=np.nan):
        self.change(lambda file: add_field(file, name, np.reshape(values, file["region"].shape), fill))

    def compute(self):
        """Two records, two slendernesses, two restitutions."""
        for name in ("synthetic.AT2", "synthetic_vertical.AT2"):
            shutil.copy(JOBS / name, self.folder)
        self.overturn("run", "spectrum.h5", job="""
            title = "A suite"
            [scene]
            record = ["synthetic.AT2", "synthetic_vertical.AT2"]
            [plane]
            pga = { first = 0.2, last = 1.5, count = 30 }
            size = { first = 0.3, last = 9.0, count = 20, spacing = "log" }
            restitution_of_maximum = { values = [0.9, 1.0] }
            slenderness = { values = [0.15, 0.25] }
            [output]
            fields = ["region", "angle", "velocity", "margin", "peak", "impacts", "status"]
            """)

    def refuses(self, code, sentence, *arguments, **how):
        return super().refuses(code, sentence, "spectrum.h5", *arguments, **how)


class TestThePlane(Recorded):
    def test_has_the_axes_of_the_file_with_their_units(self):
        for up, across, labels in (
                ("scale", "size", (r"size  $R$ [m]", "scale of the record")),
                ("pga", "frequency_parameter", (r"$p$ [1/s]", "PGA [g]"))):
            self.recorded([[S, F_MINUS], [S, S]], up=up, across=across)
            with open_result(self.folder / "spectrum.h5", SPECTRUM) as file:
                self.assertEqual(name_axes(Plane(file, {}, across, up)), labels)
            self.assertIn(labels[1], self.words())

    def test_is_titled_by_the_file_of_the_record_unless_the_job_has_a_title(self):
        self.recorded([[S]], ["records/a_$1$.AT2"])
        self.assertEqual(self.words().count("a_$1$.AT2"), 1)
        self.change(lambda file: file.attrs.update({"title": "Mine"}))
        words = self.words()
        self.assertIn("Mine", words)
        self.assertNotIn("a_$1$.AT2", words)
        self.assertIn("a_$1$.AT2, PGA 0.4 g,  α = 0.1 rad,  r = 0.7 r_max = 0.625", words)

    def test_has_a_legend_that_names_the_end_of_the_record(self):
        self.recorded([[S, F_MINUS]])
        words = self.words()
        self.assertIn("At the end of the record", words)
        self.assertIn("F−  falls during the record", words)
        self.assertIn("S  safe", words)
        self.assertNotIn("impacts", " ".join(words))
        self.assertNotIn("pulse", " ".join(words))

    def test_shows_undecided_points_and_those_without_gravity_as_undecided(self):
        self.recorded([[F_MINUS, UNDECIDED], [F_MINUS, UNDECIDED]])
        self.add("status", [[0, 2], [0, FREE_FALL]], 255)
        np.testing.assert_allclose(shares(self.picture(), [F_MINUS, UNDECIDED, S]), [0.5, 0.5, 0],
                                   atol=0.01)
        self.assertIn("undecided: see field status", self.words())

    def test_of_one_size_is_drawn_in_bands_over_that_size(self):
        self.recorded([[S], [F_MINUS], [S]], scale=[0.1, 0.2, 0.4], size=[1.0307764])
        # The scales are geometric: three equal bands.
        np.testing.assert_allclose(shares(self.picture(), [S, F_MINUS]), [2 / 3, 1 / 3], atol=0.01)
        numbers = [word for word in self.words() if word.replace(".", "").isdigit()]
        self.assertEqual([number for number in numbers if float(number) > 0.5], ["1.031"])

    def test_of_one_point_has_one_value_on_each_axis(self):
        self.recorded([[F_MINUS]], scale=[0.37], size=[1.5])
        self.assertGreater(np.count_nonzero(where(self.picture(), F_MINUS)), 980_000)
        numbers = [word for word in self.words() if word.replace(".", "").isdigit()]
        self.assertEqual(sorted(numbers), ["0.37", "1.5"])

    def test_without_the_names_of_the_records_is_damaged(self):
        self.recorded([[S]])
        self.change(lambda file: file.pop("motion_name"))
        self.refuses(74, "is damaged")

    def test_refuses_a_boundary_under_a_pulse(self):
        self.recorded([[S]])
        with h5py.File(self.folder / "boundary.h5", "w") as file:
            file.attrs.update({"kind": "overturning boundary", "format_version": 5})
            file["run/checksum"] = np.zeros(1, np.uint64)
        self.refuses(74, "Omit --boundary", "--boundary", "boundary.h5")


class TestASuite(Recorded):
    def test_has_a_panel_for_each_record(self):
        self.recorded([[[[[S]]]], [[[[F_MINUS]]]]], ["a.AT2", "b.AT2"])
        words = self.words()
        for title in ("2 records", "a.AT2, PGA 0.4 g", "b.AT2, PGA 0.5 g",
                      "α = 0.1 rad,  r = 0.7 r_max = 0.625"):
            self.assertIn(title, words)
        np.testing.assert_allclose(shares(self.picture(), [S, F_MINUS]), 0.5, atol=0.01)

    def test_names_record_and_block_where_both_differ(self):
        self.recorded(np.zeros((2, 1, 2, 2, 2)), ["a.AT2", "b.AT2"], up="pga")
        words = self.words()
        self.assertEqual((words.count("a.AT2"), words.count("b.AT2")), (2, 2))
        self.assertEqual(len([word for word in words if word.startswith("α = 0.1 rad")]), 4)

    def test_shows_only_the_record_that_is_chosen(self):
        self.recorded([[[[[S]]]], [[[[F_MINUS]]]]], ["a.AT2", "b.AT2"])
        self.assertGreater(np.count_nonzero(where(self.picture("--motion", "1"), F_MINUS)), 900_000)
        words = " ".join(self.words("--motion", "1"))
        self.assertIn("b.AT2", words)
        self.assertNotIn("a.AT2", words)

    def test_distinguishes_files_of_the_same_name(self):
        self.recorded(np.zeros((2, 1, 1, 1, 1)), ["x/a.AT2", "y/a.AT2"], up="pga")
        for name in ("x/a.AT2", "y/a.AT2"):
            self.assertIn(name, self.words())

    def test_shortens_long_names_to_their_ends(self):
        self.recorded(np.zeros((2, 1, 1, 1, 1)), ["a" * 60 + "_H1.AT2", "a" * 60 + "_H2.AT2"],
                      up="pga")
        self.assertIn("…" + "a" * 24 + "_H1.AT2", self.words())

    def test_states_the_peak_of_a_direction_unless_directions_are_an_axis(self):
        for name in ("synthetic.AT2", "synthetic_vertical.AT2"):
            shutil.copy(JOBS / name, self.folder)
        for direction, words in (("90", "synthetic.AT2, PGA 0.2 g in the direction of the point"),
                                 ("{ values = [0, 90] }", "synthetic.AT2,  ")):
            self.overturn("run", "spectrum.h5", job=f"""
                [scene]
                record = "synthetic.AT2"
                second_component = "synthetic_vertical.AT2"
                [plane]
                scale = {{ first = 1, last = 2, count = 3 }}
                size = {1 if "values" in direction else "{ values = [1, 2] }"}
                direction = {direction}
                slenderness = 0.2
                restitution_of_maximum = 1
                """)
            self.assertIn(words, "\n".join(self.words()))
            (self.folder / "spectrum.h5").unlink()

    def test_refuses_records_that_do_not_exist(self):
        self.recorded(np.zeros((13, 1, 1, 1, 1)), [f"{i}.AT2" for i in range(13)])
        self.refuses(2, "0 to 12 (motion 0.AT2 to 12.AT2)", "--motion", "13")
        self.spectrum([[S]])
        self.refuses(2, "has no dimension motion", "--motion", "0")


class TestOtherTools(Recorded):
    CHOICE = ("--motion=1", "--slenderness=0", "--restitution=1")

    def test_plot_landing_shows_the_states_at_the_end_of_the_record(self):
        self.compute()
        self.refuses(2, "choose with --motion (0 to 1) or --slenderness (0 to 1)",
                     tool="plot_landing")
        picture = "\n".join(self.words(*self.CHOICE, tool="plot_landing"))
        for words in ("A suite", "synthetic_vertical.AT2,  α = 0.15 rad", "PGA [g]",
                      "State at the end of the record, near upright"):
            self.assertIn(words, picture)
        self.assertNotIn("pulse", picture)

    def test_plot_landing_names_undecided_points(self):
        self.recorded(np.full((20, 20), UNDECIDED))
        for name in ("angle", "velocity"):
            self.add(name, np.zeros((20, 20)))
        self.assertIn("undecided", self.words(tool="plot_landing"))

    def test_to_csv_has_columns_named_as_the_axes(self):
        self.compute()
        self.output_of("spectrum.h5", *self.CHOICE, tool="to_csv")
        with open(self.folder / "spectrum.csv", newline="", encoding="ascii") as text:
            header, *rows = csv.reader(text)
        fields = ["angle", "impacts", "margin", "peak", "region", "status", "velocity"]
        self.assertEqual(header, ["size", "pga", "restitution_of_maximum", "slenderness", "motion",
                                  "frequency_parameter", "restitution", "scale", "record_pga", "pgv", "arias_intensity",
                                  "significant_duration", "motion_name", *fields])
        self.assertEqual({(row[4], row[12]) for row in rows}, {("2", "synthetic_vertical.AT2")})
        with h5py.File(self.folder / "spectrum.h5") as file:
            np.testing.assert_array_equal([float(row[0]) for row in rows],
                                          np.tile(file["size"][:], 30))
            np.testing.assert_array_equal([float(row[1]) for row in rows],
                                          np.repeat(file["pga"][:], 20))
            for column, name in enumerate(fields, 13):
                np.testing.assert_array_equal([float(row[column]) for row in rows],
                                              file[name][1, 0, 1].ravel(), name)


if __name__ == "__main__":
    unittest.main()
