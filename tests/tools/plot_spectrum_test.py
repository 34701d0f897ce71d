"""The pictures of tools/plot_spectrum: their colours are counted, their texts read from SVG.

Requires OVERTURN (the binary) in the environment.
"""

import argparse
import re
import unittest
import unittest.mock

import h5py
import numpy as np
from matplotlib import colors
from tool import JOBS, InAFolder, words_of  # first: adds the package to the path
import overturn
from overturn.captions import panel_titles
from overturn.choice import sheet_of
from overturn.plot import spectra
from overturn.regions import REGIONS
from overturn.result_file import SPECTRUM, open_result
from overturn.spectrum_planes import Axis, Plane
from overturn.ticks import log_ticks
from overturn.units import axes_of_plane

S, S_PLUS, U0_PLUS, U0_MINUS, F_MINUS, UNDECIDED, NOT_COMPUTED = 0, 1, 3, 4, 8, 254, 255


class Picture(InAFolder):
    TOOL, FILE = "plot_spectrum", "spectrum.h5"

    def spectrum(self, codes, frequency=None, amplitude=None, size=None, **attributes):
        """Writes a result file with the given codes; slenderness and restitution may be omitted.
        Each point is a tile, which has no checksum where it is not computed."""
        codes = np.array(codes, np.uint8)
        codes = codes.reshape((1,) * (4 - codes.ndim) + codes.shape)
        slendernesses, restitutions, rows, columns = codes.shape
        axes = {"slenderness": np.linspace(0.1, 0.2, slendernesses),
                "restitution_of_maximum": np.linspace(0.7, 1, restitutions),
                "amplitude": np.arange(1.0, rows + 1) if amplitude is None else amplitude,
                "frequency": np.arange(1.0, columns + 1) if frequency is None else frequency}
        with h5py.File(self.folder / "spectrum.h5", "w") as file:
            file.attrs.update({"title": "A title", "pulse": "one_sine", "theory": "nonlinear", **attributes})
            write_result(file, axes, codes, codes != NOT_COMPUTED)
            if size is not None:
                add_coordinate(file, "size", size)

    def change(self, change):
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            change(file)


def write_result(file, axes, codes, computed, has_restitution=True):
    """Writes a spectrum over these axes, in which each point is a tile."""
    file.attrs.update({"kind": "overturning spectrum", "format_version": 5})
    for name, values in axes.items():
        file[name] = values
        file[name].make_scale()
    file["run/checksum"] = np.broadcast_to(computed, codes.shape).astype(np.uint64).ravel()
    file["run/checksum"].attrs.update({"tile_shape": [1] * codes.ndim, "dimensions": " ".join(axes)})
    add_field(file, "region", codes, NOT_COMPUTED)
    if has_restitution:
        add_coordinate(file, "restitution", np.full(codes.shape[-4:-2], 0.625), "slenderness", "restitution_of_maximum")


def attach(data, *dimensions):
    for axis, name in enumerate(dimensions):
        data.dims[axis].attach_scale(data.file[name])


def add_coordinate(file, name, values, *dimensions):
    file[name] = values
    attach(file[name], *dimensions)
    file["region"].attrs["coordinates"] = file["region"].attrs.get("coordinates", "") + " " + name


def add_field(file, name, values, fill):
    file.create_dataset(name, data=values, fillvalue=fill)
    attach(file[name], *file["run/checksum"].attrs["dimensions"].split())


def where(picture, code):
    """Returns the pixels in the colour of a region."""
    colour = [round(255 * part) for part in colors.to_rgb(REGIONS[code][2])]
    return (picture == colour).all(axis=2)


def shares(picture, codes):
    """Returns the share of pixels of each region. Legend boxes are a thousandth of the map."""
    counts = np.array([np.count_nonzero(where(picture, code)) for code in codes])
    return counts / counts.sum()


class TestTheMap(Picture):
    # Spines, ticks and legend boxes take about a hundredth of the pixels. Cells drawn between their
    # values instead of around them, or all equally wide, would be off by at least a tenth.
    TOLERANCE = 0.01

    def test_cells_extend_to_the_midpoints_between_values(self):
        # The steps to the next value are 1, 2 and 1.
        frequency = 1 + np.cumsum(np.tile([1.0, 1.0, 2.0], 6))
        self.spectrum([np.tile([S, F_MINUS, U0_MINUS], 6)], frequency=frequency)
        np.testing.assert_allclose(shares(self.picture(), [S, F_MINUS, U0_MINUS]), np.array([6, 9, 9]) / 24,
                                   atol=2 * self.TOLERANCE)

    def test_nothing_is_coloured_far_from_computed_values(self):
        frequency = np.append(np.arange(1.0, 14), 17)
        self.spectrum([[S] * 13 + [F_MINUS]], frequency=frequency)
        # At most 1 from a value: from 0.5 to 14, and from 16 to 18.
        picture = self.picture()
        widths = np.array([np.count_nonzero(where(picture, code)) for code in (S, F_MINUS)]) / 1e6
        np.testing.assert_allclose(widths, np.array([13.5, 2]) / 17.5, atol=self.TOLERANCE)
        self.assertIn("between computed values", self.words())
        for values in ([1.0, 2.0, 10.0], [10.0, 2.0, 1.0], [0.1, 1.0, 10.0], [-1.0, 0.0, 5.0], [0.0, 3.0], frequency):
            axis = Axis(np.array(values), is_to_scale=True)
            shown = axis.shown(np.sort(values))
            places = axis.middles(1000)
            distance = np.abs(places[:, None] - shown).min(axis=1)
            reach = np.minimum(1 / 16 * np.ptp(shown), np.inf)
            outside = (places < shown[0]) | (places > shown[-1])
            self.assertTrue((distance[~axis.is_between(1000)] <= reach * (1 + 1e-12)).all(), values)
            self.assertTrue((distance[axis.is_between(1000)] >= reach * (1 - 1e-12)).all(), values)
            self.assertFalse(axis.is_between(1000)[outside].any(), values)
            self.assertGreaterEqual(axis.limits()[0], 0 if min(values) >= 0 else -2)
        self.assertFalse(Axis(np.linspace(1, 3, 9)).is_between(1000).any())
        self.assertFalse(Axis(np.append(np.arange(1.0, 30), 99), are_counted=True).is_between(1000).any())

    def test_geometric_values_are_equally_wide_on_a_logarithmic_axis(self):
        self.spectrum([[S], [F_MINUS], [U0_MINUS]], amplitude=[0.1, 1.0, 10.0])
        np.testing.assert_allclose(shares(self.picture(), [S, F_MINUS, U0_MINUS]), 1 / 3,
                                   atol=self.TOLERANCE)

    def test_a_short_axis_of_equal_steps_is_not_geometric(self):
        self.assertEqual(Axis(np.array([1000.0, 1000.5, 1001.0]), is_to_scale=True).scale, "linear")
        self.assertEqual(Axis(np.array([10.0, 100.0, 1000.0]), is_to_scale=True).scale, "log")

    def test_few_values_have_a_band_of_equal_width_and_a_tick_each(self):
        generator = np.random.default_rng(63)
        lists = [[7.0], [0.0, 180.0], [1.0, 3.0], [1.0, 1.5, 10.0], [1.0, 2, 5, 10, 20, 50, 100, 200, 500, 1000],
                 [1000.0, 1000.5, 1001.0], [0.1, 1.0, 10.0], [-1.0, 0.0, 5.0]]
        lists += [first + np.cumsum(generator.uniform(0.01, 3, generator.integers(2, 9)))
                  for first in generator.uniform(-1, 5, 20)]
        for values in [*lists, *(each[::-1] for each in lists)]:
            axis = Axis(np.array(values))
            places = axis.cells(2000)[~axis.is_between(2000)]
            widths = np.bincount(places, minlength=len(values)) / 2000
            # Blanks take up to a tenth of the axis; it ends with a band on both sides, and a pixel is half per mille.
            np.testing.assert_allclose(widths, np.full(len(values), widths[0]), atol=1e-3, err_msg=str(values))
            self.assertGreater(widths.sum(), 0.9 - 1e-3, values)
            np.testing.assert_array_equal(axis.ticks()[0], np.sort(values))
            np.testing.assert_allclose(np.array(axis.ticks()[1], float), np.sort(values), rtol=1e-3)
            np.testing.assert_allclose(axis.value_at(axis.shown(axis.limits())), axis.limits(), atol=1e-9)

    def test_two_values_on_both_axes_are_drawn_as_four_cells(self):
        self.spectrum([[S, F_MINUS], [U0_PLUS, U0_MINUS]], frequency=[1.0, 100.0], amplitude=[0.3, 2.0])
        picture = self.picture()
        areas = [np.count_nonzero(where(picture, code)) / 1e6 for code in (S, F_MINUS, U0_PLUS, U0_MINUS)]
        np.testing.assert_allclose(areas, (0.9 / 1.9)**2, atol=0.01)

    def test_amplitude_grows_upward_and_frequency_to_the_right(self):
        self.spectrum([[S, F_MINUS], [U0_PLUS, U0_MINUS]])
        picture = self.picture()
        middle = {code: np.median(np.argwhere(where(picture, code)), axis=0)
                  for code in (S, F_MINUS, U0_PLUS)}
        self.assertGreater(middle[S][0], middle[U0_PLUS][0] + 100)  # rows are counted downward
        self.assertLess(middle[S][1], middle[F_MINUS][1] - 100)

    def test_more_cells_than_pixels_keep_pure_colours(self):
        codes = np.full((3000, 2500), S)
        codes[:, ::7] = F_MINUS
        self.spectrum(codes)
        picture = self.picture()
        # A pixel is 2.5 cells wide and shows F- if one of them overturns. Mixed colours would change both.
        np.testing.assert_allclose(shares(picture, [S, F_MINUS]), [4.5 / 7, 2.5 / 7],
                                   atol=self.TOLERANCE)
        pure = np.count_nonzero(where(picture, S) | where(picture, F_MINUS))
        self.assertGreater(pure, 0.98 * 1000 * 1000)

    def test_no_point_that_is_not_safe_is_hidden_by_others_in_its_pixel(self):
        generator = np.random.default_rng(36)
        codes = np.full((2800, 2300), S)
        others = (F_MINUS, U0_PLUS, UNDECIDED)
        for code in 5 * others:
            codes[generator.integers(2800), generator.integers(2300)] = code
        self.spectrum(codes)
        picture = self.picture()
        for code in others:
            self.assertGreaterEqual(np.count_nonzero(where(picture, code)), 5, code)

    def test_a_pixel_shows_what_is_unknown_before_what_overturns_before_what_is_safe(self):
        generator = np.random.default_rng(37)
        for _ in range(70):
            sizes = generator.choice([1, *range(9, 60)], 2)  # fewer values have gaps
            pixels = int(generator.integers(1, 40))
            codes = generator.choice([S, S_PLUS, F_MINUS, UNDECIDED, NOT_COMPUTED], sizes, p=(.5, .3, .1, .05, .05))
            self.spectrum(codes)
            with open_result(self.folder / "spectrum.h5", SPECTRUM) as file:
                plane = Plane(file, {"slenderness": 0, "restitution_of_maximum": 0}, "frequency", "amplitude")
                across, up = axes_of_plane(plane)
                shown = plane.read_regions(up, across, pixels)
                middle = plane.read_cells("region", up.cells(pixels), across.cells(pixels))
            kinds = np.array([{S: 0, S_PLUS: 0, F_MINUS: 1, UNDECIDED: 2, NOT_COMPUTED: 3}.get(code, 9)
                              for code in range(256)])
            self.assertTrue((shown == middle)[kinds[shown] == kinds[middle]].all())
            if max(sizes) <= pixels:
                continue
            # Axes are linear: the middle of cell i is at (i + 1/2) / size. A pixel shows the cell under its middle,
            # and all whose middle is under it.
            under = [[{cell} | {other for other in range(axis.size) if axis.size > pixels
                                and (other + 0.5) / axis.size * pixels // 1 == i}
                      for i, cell in enumerate(axis.cells(pixels))] for axis in (up, across)]
            for i, j in np.ndindex(pixels, pixels):
                cells = np.ix_(list(under[0][i]), list(under[1][j]))
                self.assertEqual(kinds[shown[i, j]], kinds[codes[cells]].max())

    def test_the_kinds_of_region_differ_in_lightness(self):
        def lightness(code):  # CIE L*
            rgb = np.array(colors.to_rgb(REGIONS[code][2]))
            linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
            return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
        kinds = [[0], [1, 2], [7, 8], [3, 4], [5, 6]]  # S, S+-, F, U0, U1
        for lighter, darker in zip(kinds, kinds[1:]):
            gap = min(map(lightness, lighter)) - max(map(lightness, darker))
            # About 2 is the least visible difference side by side; apart in a map more is needed.
            self.assertGreater(gap, 7, (lighter, darker))

    def test_the_two_regions_of_falls_differ_in_hue(self):
        def opponents(code):  # red against green, and yellow against blue [1]
            red, green, blue = colors.to_rgb(REGIONS[code][2])
            return np.array([red - green, (red + green) / 2 - blue])
        # Greys differ by 0.02; yellow U0- and U0+ by 0.26.
        self.assertGreater(np.linalg.norm(opponents(7) - opponents(8)), 0.15)


class TestTheTicks(Picture):
    def test_of_a_logarithmic_axis_are_at_least_four(self):
        self.spectrum(np.zeros((100, 1)), amplitude=np.geomspace(1.13, 11.3, 100))
        for number in ("1.5", "2", "3", "5", "7", "10"):
            self.assertIn(number, self.words())

    def test_are_round_numbers_within_any_limits_and_not_too_many(self):
        limits = ((1.13, 11.3), (0.5, 8), (1, 2), (9, 11), (0.1, 10), (0.03, 0.3), (1000, 1001),
                  (1e-16, 1e-2), (1e-5, 1e5))
        for low, high in limits:
            ticks = log_ticks(low, high)
            self.assertTrue((low * (1 - 1e-9) <= ticks).all())
            self.assertTrue((ticks <= high * (1 + 1e-9)).all())
            self.assertIn(len(ticks), range(4, 10), (low, high))
            for tick in ticks:
                # One digit more than needed to distinguish the limits.
                digits = max(2, int(np.ceil(-np.log10(np.log10(high / low)))) + 2)
                self.assertAlmostEqual(float(f"{tick:.{digits - 1}e}") / tick, 1, places=12)


class TestTheWords(Picture):
    def test_the_legend_lists_exactly_the_regions_in_the_picture(self):
        self.spectrum([[S, S_PLUS, UNDECIDED]])
        words = self.words()
        legend = [word for word in words if "safe" in word or "overturns" in word
                  or "undecided" in word or "not computed" in word]
        self.assertEqual(legend, ["S  safe, no more impacts needed", "S+  safe after one more impact",
                                  "undecided: see field status"])

    def test_an_unfinished_file_is_plotted_and_labelled(self):
        self.spectrum([np.repeat([S, NOT_COMPUTED], 5)])
        words = self.words()
        self.assertIn("not computed yet", words)
        self.assertIn("unfinished: 5 of 10 tiles computed", " ".join(words))
        # Half of the map is coloured, the other half has no region's colour.
        self.assertAlmostEqual(np.count_nonzero(where(self.picture(), S)) / 1e6, 0.5, delta=0.01)

    def test_a_finished_file_is_not_labelled_unfinished(self):
        self.spectrum([[S, F_MINUS]])
        self.assertNotIn("unfinished", " ".join(self.words()))

    def test_title_pulse_and_block_are_above_the_map(self):
        self.spectrum([[S]], pulse="symmetric_ricker", theory="linear")
        words = self.words()
        self.assertIn("A title", words)
        self.assertIn("symmetric Ricker wavelet,  linear theory,  α = 0.1 rad,  "
                      "r = 0.7 r_max = 0.625", words)

    def test_a_title_may_contain_any_character(self):
        self.spectrum([[S]], title="from $1 to $2_x\nin Ω")
        self.assertIn("from $1 to $2_x in Ω", self.words())

    def test_settings_follow_the_title_and_are_shortened(self):
        self.spectrum([[S]])
        settings = "title=\"A title\"\nscene.theory=\"linear\"\nnumerics.tolerance={" + 60 * "a" + "}"
        settings += "\nplane.amplitude={first=1,last=2}\noutput.fields=[\"region\"]\noutput = {}"
        self.change(lambda file: file.update({"run/job_overrides": np.frombuffer(settings.encode(), np.uint8)}))
        self.assertIn("A title, with scene.theory=\"linear\", numerics.tolerance={" + 27 * "a" + "…",
                      [word.replace("&quot;", '"') for word in self.words()])

    def test_another_title_replaces_that_of_the_job(self):
        self.spectrum([[S]])
        words = self.words("--title", "Mine")
        self.assertIn("Mine", words)
        self.assertNotIn("A title", words)


    def test_that_the_font_lacks_are_named_once(self):
        self.spectrum([[S]])
        run = self.run_tool("spectrum.h5", "--title", "石像石")
        self.assertEqual(run.returncode, 0)
        self.assertEqual(run.stderr, "plot_spectrum: the font of Matplotlib lacks 石 像: PNG and PDF pictures have boxes in "
                                     "their place, SVG pictures have the text.\n")


class TestSeveralSpectra(Picture):
    def test_each_has_its_own_panel(self):
        codes = np.array([[S, F_MINUS, U0_PLUS], [S, U0_PLUS, U0_PLUS]])
        self.spectrum(np.tile(codes[..., None, None], (2, 2)))
        self.assertEqual(len([word for word in self.words() if word.startswith("α = ")]), 6)
        np.testing.assert_allclose(shares(self.picture(), [S, F_MINUS, U0_PLUS]),
                                   np.array([2, 1, 3]) / 6, atol=0.01)

    def test_an_index_selects_one(self):
        self.spectrum([[[[S]], [[F_MINUS]]], [[[U0_PLUS]], [[U0_MINUS]]]])
        for index in (("--slenderness", "1", "--restitution", "0"),
                      ("--index", "slenderness=1", "--index", "restitution_of_maximum=0")):
            self.assert_only(U0_PLUS, self.picture(*index))

    def test_an_index_given_twice_is_refused(self):
        self.spectrum([[[[S]], [[F_MINUS]]], [[[U0_PLUS]], [[U0_MINUS]]]])
        for again in (("--index", "slenderness=1"), ("--slenderness", "1")):
            self.refuses(2, "slenderness is given twice", "spectrum.h5", "--index", "slenderness=0", *again)

    def assert_only(self, code, picture):
        self.assertGreater(np.count_nonzero(where(picture, code)), 900_000)
        for other in {S, F_MINUS, U0_PLUS, U0_MINUS} - {code}:
            self.assertEqual(np.count_nonzero(where(picture, other)), 0)

    def test_any_two_dimensions_are_axes(self):
        # Slenderness and amplitude; the strength of the motion is vertical.
        codes = np.array([[[[S], [F_MINUS]]], [[[F_MINUS], [F_MINUS]]]])
        self.spectrum(codes.repeat(5, axis=0).repeat(5, axis=2))
        picture, words = self.picture("--index", "frequency=0"), self.words("--index", "frequency=0")
        np.testing.assert_allclose(shares(picture, [S, F_MINUS]), [0.25, 0.75], atol=0.01)
        middle = np.median(np.argwhere(where(picture, S)), axis=0)
        self.assertGreater(middle[0], picture.shape[0] / 2)  # rows are counted downward
        self.assertLess(middle[1], 600)
        self.assertIn("one-sine pulse,  ω_p/p = 1,  r = 0.7 r_max", words)

    def test_a_single_dimension_is_a_column(self):
        self.spectrum([[S], [F_MINUS], [S]], amplitude=[1.0, 2.0, 4.0])
        one = [f"--index={name}=0" for name in ("slenderness", "restitution_of_maximum", "frequency")]
        np.testing.assert_allclose(shares(self.picture(*one), [S, F_MINUS]), [2 / 3, 1 / 3], atol=0.01)
        for name in ("angle", "velocity"):
            self.change(lambda file: add_field(file, name, np.zeros(file["region"].shape), np.nan))
        self.refuses(2, "a map needs two dimensions", "spectrum.h5", *one, tool="plot_landing")
        self.refuses(2, "is a single point", "spectrum.h5", *one, "--index=amplitude=0")

    def test_of_a_list_of_blocks_has_a_named_row_for_each(self):
        (self.folder / "list.csv").write_text("name,width,height,restitution_of_maximum,pga,pulse_period\n"
                                              "urn,0.5,1.5,0.9,0.1,0.4\nbust,0.5,1.6,0.9,0.1,0.4\n")
        self.overturn("run", "spectrum.h5", job='scene.pulse="one_sine"\nblocks.table="list.csv"\n')
        words = self.words()
        for word in ("block", "urn", "bust"):
            self.assertIn(word, words)

    def test_too_many_for_a_sheet_are_chosen_in_even_steps_which_it_states(self):
        self.spectrum(np.zeros((2, 5, 2, 2)))
        statement = "4 of 10 spectra, in even steps; choose others with --slenderness (0 to 1) or --restitution (0 to 4)"
        with unittest.mock.patch.object(spectra, "MOST_PANELS", 4):
            text, words = self.drawing(words_of)
        self.assertIn(statement, text)
        self.assertIn(statement, " ".join(words))
        self.assertEqual([word for word in words if word.startswith("α = ")], [
            f"α = {alpha} rad,  r = {share}r_max = 0.625"
            for alpha, share in ((0.1, "0.7 "), (0.1, "0.925 "), (0.2, "0.775 "), (0.2, ""))])

    def test_of_a_table_of_twenty_blocks_are_all_drawn_and_named(self):
        self.overturn("run", "spectrum.h5", "plane.pulse_period.count=3", "plane.pga.count=3",
                      job=JOBS / "statues.toml")
        with open_result(self.folder / "spectrum.h5", SPECTRUM) as file:
            planes, columns, left_out = sheet_of(file, argparse.Namespace(index=[]), spectra.MOST_PANELS)
            self.assertEqual((columns, left_out), (5, ""))
            names = [title.split("\n")[0] for title in panel_titles(planes)]
        self.assertEqual(names, [f"A-{i:02}" for i in range(1, 21)])

    def test_are_in_as_many_columns_as_the_last_axis_has_values(self):
        for outer, inner, columns in ((2, 6, 6), (3, 4, 4), (10, 10, 10), (1, 20, 5), (20, 1, 5), (2, 11, 5), (11, 2, 5)):
            self.spectrum(np.zeros((outer, inner, 2, 2)))
            with open_result(self.folder / "spectrum.h5", SPECTRUM) as file:
                planes, found, left_out = sheet_of(file, argparse.Namespace(index=[]), 100)
                self.assertEqual((len(planes), found, left_out), (outer * inner, columns, ""))


class TestAComputedFile(Picture):
    JOB = """
        title = "Computed"
        [scene]
        pulse = "one_sine"
        [plane]
        frequency = { first = 1.0, last = 10.0, count = 40 }
        amplitude = { first = 1.0, last = 12.0, count = 40 }
        restitution_of_maximum = 1.0
        slenderness = { values = [0.1745716] }
        """

    def test_has_each_region_of_the_one_sine_spectrum(self):
        self.overturn("run", "spectrum.h5")
        words = " ".join(self.words())
        for region in ("S ", "S+ ", "U0+ ", "U0− ", "U1+ ", "F− "):
            self.assertIn(region, words)
        with h5py.File(self.folder / "spectrum.h5") as file:
            codes = file["region"][...]
        present = [S, S_PLUS, U0_PLUS, U0_MINUS, F_MINUS]
        counts = np.array([np.count_nonzero(codes == code) for code in present])
        np.testing.assert_allclose(shares(self.picture(), present), counts / counts.sum(),
                                   atol=0.01)

    def test_without_the_region_names_the_missing_field(self):
        self.overturn("run", "spectrum.h5", 'output.fields=["margin"]')
        self.refuses(74, "no field region; add it to output.fields", "spectrum.h5")


class TestARefusal(Picture):
    def test_of_a_missing_file(self):
        self.refuses(74, "No such file", "nowhere.h5")

    def test_of_a_text_file(self):
        (self.folder / "text.h5").write_text("not a spectrum")
        self.refuses(74, "not an HDF5 file", "text.h5")

    def test_of_a_foreign_hdf5_file(self):
        with h5py.File(self.folder / "other.h5", "w") as file:
            file["region"] = [1]
        for tool, kind in (("plot_spectrum", "a spectrum written by overturn run"),
                           ("plot_boundary", "a boundary written by overturn boundary"),
                           ("plot_history", "a history written by overturn history"),
                           ("plot_accuracy", "a study written by overturn accuracy")):
            self.refuses(74, f"is not {kind}", "other.h5", tool=tool)

    def test_of_another_format(self):
        self.spectrum([[S]])
        for version, advice in ((2, "Read it with the overturn that wrote it, or compute it again"),
                                (3, "Read it with overturn 2.0, or compute it again with this version."),
                                (6, "Use a newer overturn.")):
            words = f"has format version {version}, but this version of overturn reads versions 4 and 5. {advice}"
            self.change(lambda file: file.attrs.update({"format_version": version, "program_version": "1.0.0"}))
            self.refuses(74, words, "spectrum.h5")
            with self.assertRaisesRegex(ValueError, re.escape(words)):
                overturn.open(self.folder / "spectrum.h5")

    def test_of_a_truncated_file(self):
        self.spectrum(np.zeros((50, 50)))
        whole = (self.folder / "spectrum.h5").read_bytes()
        (self.folder / "cut.h5").write_bytes(whole[:len(whole) // 2])
        self.refuses(74, "cannot read \"cut.h5\"", "cut.h5")

    def test_of_a_file_that_lacks_an_axis(self):
        self.spectrum([[S]])
        self.change(lambda file: file.pop("frequency"))
        self.refuses(74, "is damaged", "spectrum.h5")

    def test_of_an_index_out_of_range_shows_the_range(self):
        self.spectrum(np.zeros((1, 3, 2, 2)))
        self.refuses(2, "has 0 to 2", "spectrum.h5", "--restitution", "3")
        self.refuses(2, "has 0 to 0", "spectrum.h5", "--slenderness", "-1")

    def test_of_a_picture_in_an_unknown_format(self):
        self.spectrum([[S]])
        self.refuses(2, ".png, .pdf or .svg", "spectrum.h5", "-o", "picture.jpg")

    def test_of_a_picture_in_a_missing_folder(self):
        self.spectrum([[S]])
        self.refuses(74, "cannot write", "spectrum.h5", "-o", "nowhere/picture.png")


if __name__ == "__main__":
    unittest.main()
