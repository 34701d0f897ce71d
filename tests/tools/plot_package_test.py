"""Pictures from Python: overturn.plot.

Requires OVERTURN (the binary) in the environment.
"""

import subprocess
import sys
import unittest
import unittest.mock

import h5py
import numpy as np
from tool import JOBS, TOOLS, InOneFolder, run_overturn  # first: adds the package to the path
import overturn
from matplotlib import image, pyplot
from overturn.plot import histories, spectra
from overturn.regions import CODES, LEFT_OUT

FEW = [f"plane.{axis}.count=20" for axis in ("frequency", "amplitude")]


class TestPicturesFromPython(InOneFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for command, name, *settings in (("run", "spectrum", *FEW, "plane.restitution_of_maximum.values=[0.8,1]"),
                                         ("boundary", "boundary", *FEW),
                                         ("history", "history", "plane.frequency=3", "plane.amplitude=1.5")):
            run_overturn(cls.folder, command, JOBS / "smoke.toml", f"{name}.h5", *settings)

    def tearDown(self):
        pyplot.close("all")

    def path(self, name):
        return self.folder / f"{name}.h5"

    def test_are_those_of_the_tools(self):
        for name, draw, options, how in (("spectrum", overturn.plot.spectrum, {"restitution": 1}, {}),
                                         ("boundary", overturn.plot.boundary, {"units": "physical"}, {"dpi": 120}),
                                         ("history", overturn.plot.history, {}, {"dpi": 120})):
            with self.subTest(name):
                arguments = [word for option, value in options.items() for word in (f"--{option}", str(value))]
                self.output_of(f"{name}.h5", *arguments, tool=f"plot_{name}")
                axes = draw(self.path(name), **options)
                (axes[0] if isinstance(axes, list) else axes).figure.savefig(self.folder / "own.png", **how)
                np.testing.assert_array_equal(image.imread(self.folder / "own.png"),
                                              image.imread(self.folder / f"{name}.png"))

    def test_are_imported_without_scipy(self):  # which only those of fragility and risk need
        script = "import sys; sys.path.insert(0, sys.argv[1]); import overturn.plot; assert 'scipy' not in sys.modules"
        subprocess.run([sys.executable, "-c", script, TOOLS], check=True)

    def test_of_several_spectra_are_a_list_of_axes(self):
        axes = overturn.plot.spectrum(self.path("spectrum"))
        self.assertEqual(len(axes), 2)
        self.assertIs(axes[0].figure, axes[1].figure)

    def test_fit_into_axes_of_the_caller(self):
        figure, panels = pyplot.subplots(1, 3, figsize=(12, 4), dpi=50, layout="constrained")
        self.assertIs(overturn.plot.spectrum(self.path("spectrum"), restitution=0, ax=panels[0]), panels[0])
        self.assertIs(overturn.plot.boundary(self.path("boundary"), ax=panels[1]), panels[1])
        self.assertIs(overturn.plot.history(self.path("history"), ax=panels[2]), panels[2])
        self.assertEqual(len(figure.axes), 3)
        figure.canvas.draw()
        widths = [panel.get_position().width for panel in panels]
        self.assertAlmostEqual(widths[0], 0.28, delta=0.04)  # a third, less the numbers beside it
        self.assertAlmostEqual(min(widths), max(widths), delta=1e-3)
        self.assertEqual(panels[0].get_xlabel(), panels[1].get_xlabel())
        self.assertIn("time since the start of the pulse", panels[2].get_xlabel())
        with self.assertRaisesRegex(overturn.ToolError, "limited to 1"):
            overturn.plot.spectrum(self.path("spectrum"), ax=pyplot.figure().add_subplot())

    def test_of_several_tilts_in_the_same_axes_keep_the_larger_limits_and_differ(self):
        run_overturn(self.folder, "history", JOBS / "smoke.toml", "other.h5", "plane.frequency=3",
                     "plane.amplitude=1.1")
        for names in (("history", "other"), ("other", "history")):
            ax = pyplot.figure().add_subplot()
            alone = [overturn.plot.history(self.path(name), ax=pyplot.figure().add_subplot()) for name in names]
            for name in names:
                overturn.plot.history(self.path(name), ax=ax)
            for limits in ("get_xlim", "get_ylim"):
                each = [getattr(axes, limits)() for axes in alone]
                self.assertEqual(getattr(ax, limits)(), (min(each)[0], max(high for _, high in each)))
            curves = histories.curves_in(ax)
            self.assertEqual(len({curve.get_color() for curve in curves}), 2)
            entries = [text.get_text() for text in ax.get_legend().get_texts()]
            self.assertEqual(len(entries), len({*entries}))
            self.assertLessEqual({curve.get_label() for curve in curves}, {*entries})
            entries = [text.get_text() for text in alone[0].get_legend().get_texts()]
            self.assertNotIn(alone[0].lines[0].get_label(), entries)

    def test_of_a_boundary_end_above_its_highest_flip_and_state_the_end_of_the_search(self):
        def drawn(last):
            run_overturn(self.folder, "boundary", JOBS / "smoke.toml", f"to_{last}.h5",
                         f"plane.amplitude={{first=0.5, last={last}, count=20}}",
                         "plane.frequency={first=5, last=6, count=5}")
            axes = overturn.plot.boundary(self.path(f"to_{last}"))
            with overturn.open(self.path(f"to_{last}")) as result:
                highest = float(result.flip_amplitude.max())
            return highest, axes.get_ylim()[1], " ".join(text.get_text() for text in axes.figure.texts)
        highest, top, words = drawn(40)
        self.assertTrue(1.05 * highest < top < 1.5 * highest, (highest, top))
        self.assertIn("no flips found above the axis, up to 40", words)
        highest, top, words = drawn(1.1 * highest)
        self.assertGreater(top, 1.1 * highest)
        self.assertNotIn("no flips", words)
        self.assertNotIn("plane.", words)  # the axes show these settings
        axes = overturn.plot.boundary(self.path("to_40"), title="Mine")
        self.assertEqual(axes.figure.texts[0].get_text(), "Mine")

    def codes_of(self, result):
        """Returns the region codes of the panels of a picture."""
        shown = []

        def draw_sheet(planes, *_):
            shown.extend(plane.read("region") for plane in planes)
            return unittest.mock.MagicMock()
        with unittest.mock.patch.object(spectra, "draw_sheet", draw_sheet):
            overturn.plot.spectrum(result)
        return np.array(shown)

    def changes(self):
        """Yields data sets that a user may make of one, and a function that makes the same of its file's codes."""
        draw = np.random.default_rng(20)
        for _ in range(7):
            first, count, low = (int(number) for number in draw.integers((0, 9, 1), (5, 15, 9)))
            part = slice(first, first + count)
            yield (lambda data, part=part: data.isel(amplitude=part)), (lambda codes, part=part: codes[:, part])
            yield (lambda data, part=part: data.isel(frequency=part, restitution_of_maximum=[1])), (
                lambda codes, part=part: codes[1:, :, part])
            yield (lambda data, low=low: data.where(data.frequency > low)), (
                lambda codes, low=low: np.where(self.frequency > low, codes, LEFT_OUT))
            yield (lambda data, low=low: data.assign(region=data.region.where(data.amplitude > low, 255))), (
                lambda codes, low=low: np.where(self.amplitude[:, None] > low, codes, 255))
        yield (lambda data: data.isel(restitution_of_maximum=0)), (lambda codes: codes[:1])
        yield (lambda data: data.isel(restitution_of_maximum=[1, 0])), (lambda codes: codes)
        yield (lambda data: data.sortby("frequency", ascending=False).transpose()), (
            lambda codes: codes.transpose())
        yield (lambda data: data.copy(data={name: np.full_like(data[name], 3) for name in data})), (
            lambda codes: np.full_like(codes, 3))

    def test_show_the_data_set_that_is_given_and_not_its_file(self):
        with overturn.open(self.path("spectrum")) as dataset:
            self.frequency, self.amplitude = dataset.frequency.values, dataset.amplitude.values
            for number, (change, of_codes) in enumerate(self.changes()):
                with self.subTest(number):
                    wanted = of_codes(dataset.region.values)
                    np.testing.assert_array_equal(self.codes_of(change(dataset)), wanted)

    def test_of_a_data_set_as_it_was_opened_are_those_of_its_file(self):
        with overturn.open(self.path("spectrum")) as dataset:
            np.testing.assert_array_equal(self.codes_of(dataset), self.codes_of(self.path("spectrum")))

    def test_hatch_and_explain_what_a_user_left_out(self):
        with overturn.open(self.path("spectrum")) as dataset:
            panels = overturn.plot.spectrum(dataset.where(dataset.amplitude < 5))
        texts = [text.get_text() for text in panels[0].figure.legends[0].get_texts()]
        self.assertIn("left out", texts)
        self.assertNotIn("not computed yet", texts)

    def test_of_a_data_set_that_cannot_be_drawn_are_refused(self):
        with overturn.open(self.path("spectrum")) as dataset:
            bare = dataset.copy()
            bare.attrs = {}
            for change, words in (
                    (dataset.drop_vars("amplitude"), "amplitude of region has no coordinate of numbers"),
                    (dataset.isel(amplitude=[0, 0, 1]), "has a value twice"),
                    (dataset.interp(amplitude=[1.5, 2.5]), "no region codes"),
                    (dataset.assign(region=dataset.region + 100), "no region codes"),
                    (bare, "no attribute kind"), (dataset.region, "no data set of overturn.open")):
                with self.assertRaisesRegex(ValueError, words):
                    overturn.plot.spectrum(change)

    def test_of_a_part_of_a_boundary_or_a_history_are_refused(self):
        for name, draw, part in (("boundary", overturn.plot.boundary, {"crossing": [0]}),
                                 ("history", overturn.plot.history, {"time": slice(9)})):
            with overturn.open(self.path(name)) as dataset:
                draw(dataset)
                changed = dataset.copy(data={field: np.zeros_like(dataset[field]) for field in dataset})
                for given in (dataset.isel(part), changed):
                    with self.assertRaisesRegex(ValueError, "only whole boundaries and histories are drawn"):
                        draw(given)

    def test_and_curves_of_what_is_no_data_set_are_refused(self):
        with overturn.open(self.path("spectrum")) as dataset:
            for given in (self.path("spectrum"), str(self.path("spectrum")), dataset.region, None):
                for function in (overturn.fragility, lambda data: overturn.supported_share(data, 0.5),
                                 overturn.plot.fragility):
                    with self.assertRaisesRegex(ValueError, "is no data set|is no fragility curve"):
                        function(given)

    def test_name_regions_as_the_file_does(self):
        with h5py.File(self.path("spectrum")) as file:
            attributes = file["region"].attrs
            names = dict(zip(attributes["flag_values"].tolist(), attributes["flag_meanings"].decode().split()))
        self.assertEqual({**names, **{code: name for name, code in CODES.items()}}, names)
        self.assertEqual(sorted(CODES.values()), list(range(11)))

    def test_of_another_kind_of_file_are_refused(self):
        for draw, kind, name, tool in (
                (overturn.plot.spectrum, "spectrum", "boundary", "boundary written by overturn boundary"),
                (overturn.plot.boundary, "boundary", "spectrum", "spectrum written by overturn run"),
                (overturn.plot.boundary, "boundary", "history", "history written by overturn history")):
            words = f"is not a {kind} .* but a {tool}. Draw it with plot_{name}.$"
            with self.assertRaisesRegex(overturn.ToolError, words):
                draw(self.path(name))


if __name__ == "__main__":
    unittest.main()
