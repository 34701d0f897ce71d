"""The verdicts and the fields that tools/plot_spectrum draws, as colours and as lines.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import numpy as np
from matplotlib import pyplot
from matplotlib.lines import Line2D
from plot_spectrum_test import F_MINUS, NOT_COMPUTED, S, S_PLUS, U0_MINUS, UNDECIDED, where
from recorded_spectra_test import Recorded
import overturn
from overturn.colourings import share_text
from overturn.plot.curves import places_of_markers
from overturn.regions import STANDS, TOPPLES

KINDS = (STANDS, TOPPLES, UNDECIDED)


class Field(Recorded):
    def spectrum_with(self, codes, name, values, units="1", fill=np.nan, **attributes):
        """Writes a row ten times, because a single one is a line and few have gaps, or a column once."""
        codes, values = (np.tile(row, (1 if np.ndim(codes) > 1 else 10, 1)) for row in (codes, values))
        self.spectrum(codes)
        self.add(name, values, fill)
        self.change(lambda file: file[name].attrs.update({"units": units, "long_name": f"the {name}", **attributes}))

    def map(self, *arguments):
        """Returns the pixels of the map, without spines; rows upward."""
        picture = self.picture(*arguments)
        left, right, bottom, top = 0.85, 3.25, 0.7, 1.0  # margins [inches]
        box = [round(150 * side) for side in (left, right, bottom, top)]
        return picture[box[3] + 4:-box[2] - 4, box[0] + 4:-box[1] - 4][::-1]

    def shares(self, *arguments):
        picture = self.map(*arguments)
        return [np.count_nonzero(where(picture, code)) / picture[..., 0].size for code in KINDS]


class TestTheVerdict(Field):
    def test_has_three_colours(self):
        self.spectrum([np.repeat([S, S_PLUS, F_MINUS, U0_MINUS, UNDECIDED, NOT_COMPUTED], 4)])
        np.testing.assert_allclose(self.shares("--verdict"), 1 / 3, atol=0.01)
        words = self.words("--verdict")
        for word in ("stands  33 %", "topples  33 %", "unknown  33 %"):
            self.assertIn(word, words)
        self.assertNotIn("At the end of the pulse", words)

    def test_has_a_share_that_is_0_or_100_per_cent_only_of_none_or_all(self):
        for count, total, words in ((0, 9, "0 %"), (9, 9, "100 %"), (1, 3, "33 %"), (1, 1000, "0.1 %"),
                                    (999, 1000, "99.9 %"), (3, 10**6, "0.0003 %"), (10**6 - 3, 10**6, "99.9997 %"),
                                    (1, 10**12, "0.0000000001 %"), (10**12 - 1, 10**12, "99.9999999999 %")):
            self.assertEqual(share_text(count, total), words)

    def test_lists_what_is_unknown_also_if_there_is_none(self):
        self.spectrum(np.resize([S, F_MINUS], (1, 1, 10, 10)))
        self.assertIn("unknown  0 %", self.words("--verdict"))

    def test_is_unknown_outside_what_was_computed(self):
        self.spectrum([[S] * 14], frequency=np.append(np.arange(1.0, 14), 17))
        stands, topples, unknown = self.shares("--verdict")
        self.assertAlmostEqual(stands, 15.5 / 17.5, delta=0.01)
        self.assertAlmostEqual(unknown, 2 / 17.5, delta=0.01)
        self.assertEqual(topples, 0)


class TestAField(Field):
    def test_is_coloured_by_its_values(self):
        generator = np.random.default_rng(5)
        values = generator.permutation(np.linspace(0, 2, 40))
        self.spectrum_with(np.full(40, S), "peak", values)
        picture = self.map("--field", "peak")[250]
        shown = picture[((np.arange(40) + 0.5) / 40 * len(picture)).astype(int)]
        lightness = shown @ [0.2126, 0.7152, 0.0722]
        np.testing.assert_array_equal(np.argsort(-lightness, kind="stable"), np.argsort(values))
        self.assertIn("the peak", self.words("--field", "peak"))

    def test_has_no_value_where_the_verdict_is_unknown_or_overturning_makes_it_infinite(self):
        codes = np.repeat([S, F_MINUS, UNDECIDED, S, NOT_COMPUTED], 4)
        # A point without a verdict has a margin; a point with one may have none.
        self.spectrum_with(codes, "peak", np.repeat([0.5, np.inf, 0.5, np.nan, np.nan], 4))
        stands, topples, unknown = self.shares("--field", "peak")
        self.assertEqual(stands, 0)
        self.assertAlmostEqual(topples, 1 / 5, delta=0.01)
        self.assertGreater(unknown, 2 / 5)
        words = self.words("--field", "peak")
        for word in ("topples", "unknown", "not computed yet"):
            self.assertIn(word, words)

    def test_stands_where_it_is_infinite_because_no_block_falls(self):
        self.spectrum_with(np.repeat([S, F_MINUS], 6), "fall_time", np.repeat([np.inf, 3.0], 6))
        stands, topples, unknown = self.shares("--field", "fall_time")
        self.assertAlmostEqual(stands, 1 / 2, delta=0.01)
        self.assertEqual((topples, unknown), (0, 0))

    def test_hides_no_point_with_a_worse_verdict(self):
        codes = np.full(3000, S)
        codes[9::300] = F_MINUS
        codes[110::300] = UNDECIDED
        self.spectrum_with(codes, "margin", np.ones(3000))
        _, topples, unknown = self.shares("--field", "margin")
        for share in (topples, unknown):
            self.assertAlmostEqual(share, 10 / 1000, delta=0.002)  # ten columns of pixels, which have another point in the middle

    def test_with_a_sign_has_no_colour_at_0_and_an_even_scale(self):
        self.spectrum_with(np.repeat([F_MINUS, F_MINUS, F_MINUS, S, S], 4), "margin", np.repeat([-99, -2, 0, 1, 2], 4))
        row = self.map("--field", "margin")[300]
        colour = [row[int((i + 0.5) / 5 * len(row))] for i in range(5)]
        np.testing.assert_array_equal(colour[0], colour[1])  # beyond -2
        self.assertLess(np.ptp(colour[2]), 3)
        self.assertGreater(colour[1][0], colour[1][2])  # red
        self.assertLess(colour[4][0], colour[4][2])

    def test_of_counts_has_no_value_at_their_flags(self):
        flags = np.array([65533, 65534, 65535], np.uint16)
        self.spectrum_with(np.full(15, S), "impacts", np.repeat(np.array([1, 3, 65535], np.uint16), 5), fill=65534,
                           flag_values=flags)
        self.assertIn("infinite", self.words("--field", "impacts"))
        self.assertIn("3.00", self.words("--field", "impacts"))  # a tick of the colour bar
        black = (self.map("--field", "impacts") == 0).all(axis=2).mean()
        self.assertAlmostEqual(black, 1 / 3, delta=0.01)

    def test_states_its_unit(self):
        self.spectrum_with([S, S], "velocity", [0.1, 0.3], units="rad")
        self.assertIn("the velocity [rad]", self.words("--field", "velocity"))

    def test_along_one_axis_is_a_line(self):
        values = np.array([0.5, 0.7, np.inf, 0.9, 1.1, 0.2])
        self.spectrum_with(np.reshape([S, S, F_MINUS, S, UNDECIDED, S], (6, 1)), "peak", values[:, None])
        _, ax = pyplot.subplots()
        overturn.plot.spectrum(self.folder / "spectrum.h5", field="peak", ax=ax)
        x, y = ax.lines[0].get_data()
        np.testing.assert_array_equal(x, np.arange(1.0, 7))
        np.testing.assert_array_equal(y, [0.5, 0.7, np.nan, 0.9, np.nan, 0.2])
        self.assertEqual(ax.get_ylabel(), "the peak")
        self.assertIn("pulse amplitude", ax.get_xlabel())
        pyplot.close(ax.figure)
        for code in KINDS[1:]:
            self.assertAlmostEqual(self.shares_of_strip(ax, 0)[code], 0.9 / 5.9, delta=0.01)  # six bands with gaps

    def draw(self, codes, name, values, **how):
        """Returns the axes of a picture of a new spectrum."""
        self.spectrum_with(codes, name, values)
        axes = overturn.plot.spectrum(self.folder / "spectrum.h5", field=name, **how)
        self.addCleanup(pyplot.close, "all")
        return axes

    def shares_of_strip(self, ax, number):
        """Returns the shares of a strip above the curves in the colours of STANDS, TOPPLES and UNDECIDED."""
        pixels = ax.child_axes[0].images[number].get_array()[:1, :, :3]
        return {code: where(pixels, code).mean() for code in KINDS}

    def test_along_an_axis_of_few_values_is_a_curve_for_each(self):
        values = np.arange(36.0).reshape(3, 12) + 1
        ax = self.draw(np.full((3, 12), S), "peak", values)
        curves = ax.lines[:3]
        for curve, row in zip(curves, values):
            np.testing.assert_array_equal(curve.get_data(), [np.arange(1.0, 13), row])
        for property_of in (Line2D.get_color, Line2D.get_marker, Line2D.get_label):
            self.assertEqual(len({*map(property_of, curves)}), 3)
        labels = [text.get_text() for text in ax.figure.legends[0].get_texts()]
        self.assertEqual(labels[:3], ["amplitude = 1", "amplitude = 2", "amplitude = 3"])
        self.assertEqual(labels[-1], "stands")

    def test_in_curves_ends_where_a_block_topples_or_nothing_is_known(self):
        codes = np.tile(np.repeat([S, F_MINUS, S, UNDECIDED, NOT_COMPUTED], 4), (2, 1))
        codes[1] = S
        values = np.where(codes == F_MINUS, np.inf, 0.5)
        ax = self.draw(codes, "peak", values)
        np.testing.assert_array_equal(ax.lines[0].get_ydata(), np.where(codes[0] == S, 0.5, np.nan))
        strip = self.shares_of_strip(ax, 0)
        for code, share in ((STANDS, 2 / 5), (TOPPLES, 1 / 5), (UNDECIDED, 1 / 5)):  # a fifth is hatched
            self.assertAlmostEqual(strip[code], share, delta=0.03)  # half a cell less at the ends
        self.assertEqual(self.shares_of_strip(ax, 1)[STANDS], 1)
        labels = [text.get_text() for text in ax.figure.legends[0].get_texts()]
        self.assertEqual(labels[-4:], ["stands", "topples", "unknown", "not computed yet"])

    def test_marks_points_between_others_that_topple(self):
        generator = np.random.default_rng(3)
        for count in (2, 9, 400):
            values = np.where(generator.random(count) < 0.5, 0.5, np.nan)
            known = [0 <= i < count and np.isfinite(values[i]) for i in range(-1, count + 1)]
            alone = [i for i in range(count) if known[i + 1] and not known[i] and not known[i + 2]]
            self.assertLessEqual({*alone}, {*places_of_markers(values)})

    def test_of_peaks_begins_at_0_and_has_a_line_at_1_whatever_the_values(self):
        for values in (np.geomspace(1e-5, 0.3, 12), np.linspace(0.5, 2, 12)):
            ax = self.draw(np.full((2, 12), S), "peak", np.tile(values, (2, 1)))
            low, high = ax.get_ylim()
            self.assertEqual((ax.get_yscale(), low), ("linear", 0))
            self.assertTrue(max(1, values.max()) < high < 1.1 * max(1, values.max()))
            self.assertEqual({*ax.lines[2].get_ydata()}, {1})
        ax = self.draw(np.full((2, 12), S), "margin", np.tile(np.geomspace(1e-5, 1, 12), (2, 1)))
        self.assertEqual(ax.get_yscale(), "log")

    def test_along_axes_of_more_values_is_a_map(self):
        self.assertEqual(len(self.draw(np.full((7, 12), S), "peak", np.ones((7, 12))).lines), 0)

    def test_is_not_drawn_over_another_picture(self):
        for shape in ((2, 12), (9, 12)):
            ax = self.draw(np.full(shape, S), "peak", np.ones(shape), ax=pyplot.figure().add_subplot())
            for draw in (overturn.plot.spectrum, overturn.plot.boundary):
                with self.assertRaisesRegex(overturn.ToolError, "already have a picture"):
                    draw(self.folder / "spectrum.h5", ax=ax)
            ax.clear()
            overturn.plot.spectrum(self.folder / "spectrum.h5", ax=ax)

    def test_is_that_of_the_program(self):
        self.compute()
        panels = overturn.plot.spectrum(self.folder / "spectrum.h5", field="peak")
        self.assertEqual(len(panels), 8)
        bars = [axes for axes in panels[0].figure.axes if axes not in panels]
        self.assertEqual([bar.get_ylabel() for bar in bars], ["largest |theta| / alpha"])
        with overturn.open(self.folder / "spectrum.h5") as dataset:
            peak = dataset["peak"].values[np.isin(dataset["region"].values, [0, 1, 2])]
        np.testing.assert_allclose(bars[0].get_ylim(), [peak.min(), peak.max()])
        for field in ("margin", "impacts", "angle", "velocity"):
            overturn.plot.spectrum(self.folder / "spectrum.h5", field=field, motion=0, slenderness=0)
        pyplot.close("all")


class TestARefusal(Field):
    def test_of_what_is_no_field_with_values(self):
        self.spectrum_with([S, S], "status", [0, 1], units="", fill=255)
        for name in ("region", "status", "frequency"):
            self.refuses(2, f"{name} is no field with values", "--field", name)
        self.refuses(74, "no field peak; add it to output.fields", "--field", "peak")

    def test_of_a_label_beside_curves(self):
        self.spectrum_with(np.full((2, 12), S), "peak", np.ones((2, 12)))
        self.refuses(2, "drawn as curves. Omit --label", "--field", "peak", "--label", "I=S@1,1")

    def test_of_a_field_and_the_verdict(self):
        self.spectrum_with([S, S], "peak", [0, 1])
        self.refuses(2, "not allowed with argument", "--field", "peak", "--verdict")
        with self.assertRaisesRegex(overturn.ToolError, "not both"):
            overturn.plot.spectrum(self.folder / "spectrum.h5", field="peak", verdict=True)


if __name__ == "__main__":
    unittest.main()
