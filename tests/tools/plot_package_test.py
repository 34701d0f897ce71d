"""Pictures from Python: overturn.plot.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import h5py
import numpy as np
from tool import JOBS, InOneFolder, run_overturn  # first: adds the package to the path
import overturn
from matplotlib import image, pyplot
from overturn.regions import CODES

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
            overturn.plot.spectrum(self.path("spectrum"), ax=panels[0])

    def test_take_a_data_set_as_it_was_opened(self):
        with overturn.open(self.path("spectrum")) as dataset:
            self.assertEqual(len(overturn.plot.spectrum(dataset)), 2)
            with self.assertRaisesRegex(ValueError, "is not all of"):
                overturn.plot.spectrum(dataset.isel(amplitude=slice(3)))
            with self.assertRaisesRegex(ValueError, "is not all of"):
                overturn.plot.spectrum(dataset.isel(restitution_of_maximum=0))

    def test_name_regions_as_the_file_does(self):
        with h5py.File(self.path("spectrum")) as file:
            attributes = file["region"].attrs
            names = dict(zip(attributes["flag_values"].tolist(), attributes["flag_meanings"].decode().split()))
        self.assertEqual({**names, **{code: name for name, code in CODES.items()}}, names)
        self.assertEqual(sorted(CODES.values()), list(range(11)))

    def test_of_another_kind_of_file_are_refused(self):
        with self.assertRaisesRegex(overturn.ToolError, "is not a spectrum"):
            overturn.plot.spectrum(self.path("boundary"))


if __name__ == "__main__":
    unittest.main()
