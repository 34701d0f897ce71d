"""Legends and colour bars of the pictures of every kind: none leaves its picture.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import numpy as np
from plot_spectrum_test import add_field
from recorded_spectra_test import Recorded
from tool import JOBS  # adds the package to the path
from overturn.regions import NOT_COMPUTED, REGIONS

ALL = [*REGIONS, NOT_COMPUTED]
RECORD = f"""
    scene.record = "{JOBS / 'synthetic.AT2'}"
    plane.pga = {{ first = 0.2, last = 2, count = 6 }}
    plane.size = {{ first = 0.3, last = 3, count = 6 }}
    plane.slenderness = 0.25
    plane.restitution_of_maximum = 0.9
    output.fields = ["region", "peak"]
    """


class TestALegend(Recorded):
    def assert_within(self, file, *arguments, tool="plot_spectrum"):
        """Draws a picture, which must have a legend or a colour bar, each of them within it."""
        def outside(figure):
            figure.draw_without_rendering()
            legends = [*figure.legends, *filter(None, (axes.get_legend() for axes in figure.axes))]
            bars = [axes for axes in figure.axes if axes.get_label() == "<colorbar>"]
            self.assertTrue(legends + bars, arguments)
            width, height = figure.bbox.size
            boxes = [each.get_tightbbox() for each in legends + bars]
            return [(box, (width, height)) for box in boxes
                    if min(box.x0, box.y0, width - box.x1, height - box.y1) < 0]
        self.assertEqual(self.drawing(outside, *arguments, tool=tool, file=file)[1], [], arguments)

    def add_fields(self, shape):
        values = np.resize([0.5, 1.2, np.inf, 0.1], shape)
        for name in ("peak", "friction_demand", "velocity"):
            self.add(name, values)

        def explain(file):
            for name in ("peak", "friction_demand", "velocity"):
                file[name].attrs.update({"units": "rad", "long_name": "velocity of the block at the end of the ground motion"})
        self.change(explain)

    def test_of_a_spectrum_with_every_region_is_within_it(self):
        codes = np.tile(np.repeat(ALL, 3), (2, 1))
        frequency = np.append(np.arange(1.0, codes.shape[1]), 99)  # far from the others
        self.spectrum(codes, frequency=frequency)
        self.add_fields(codes.shape)
        for how in ((), ("--verdict",), ("--field", "velocity"), ("--practice", "--friction-demand", "0.5"),
                    ("--field", "peak", "--index", "amplitude=0")):
            self.assert_within("spectrum.h5", *how)

    def test_of_a_sheet_that_is_shorter_than_it_is_within_it(self):
        for sheet, how in (((1, 4), ()), ((2, 10), ("--field", "velocity"))):
            codes = np.tile(ALL, (*sheet, 2, 1))
            self.spectrum(codes)
            self.add_fields(codes.shape)
            self.assert_within("spectrum.h5", *how)

    def test_of_spectra_under_records_is_within_it(self):
        codes = np.tile(ALL, (2, 1, 1, 2, 2))
        self.recorded(codes, motions=("a.AT2", "b.AT2"))
        self.add_fields(codes.shape)
        self.assert_within("spectrum.h5", "--field", "friction_demand")

    def test_of_boundaries_is_within_it(self):
        few, restitution = "plane.frequency.count=9", "plane.restitution_of_maximum="
        for name, settings in (("one", [few]), ("column", ["plane.frequency=3"]),
                               ("ten", ["plane.frequency.count=3", restitution + "{first=0.7, last=1, count=10}"])):
            self.overturn("boundary", f"{name}.h5", "plane.amplitude.count=20", *settings, job=JOBS / "figure_07a.toml")
            self.assert_within(f"{name}.h5", tool="plot_boundary")

    def test_of_what_happens_under_a_record_is_within_it(self):
        self.overturn("run", "spectrum.h5", job=RECORD)
        self.overturn("boundary", "boundary.h5", 'output.fields=["region"]', job=RECORD)
        (self.folder / "hazard.csv").write_text("# pga [g]\n0.1 0.01\n0.5 1e-3\n2 1e-4\n")
        self.assert_within("spectrum.h5")
        self.assert_within("boundary.h5", tool="plot_boundary")
        self.assert_within("spectrum.h5", "--by", "size", "--samples", "2", tool="plot_fragility")
        self.assert_within("spectrum.h5", "hazard.csv", "--samples", "2", tool="plot_risk")
        (self.folder / "branches.csv").write_text("weight,file,name\n" + "".join(
            f"{weight},hazard.csv,model {weight} of a source with a name of many words\n" for weight in (0.9, 0.1)))
        self.assert_within("spectrum.h5", "branches.csv", "--samples", "2", tool="plot_risk")

    def test_of_an_accuracy_study_is_within_it(self):
        self.overturn("accuracy", "study.h5", "plane.frequency.count=4", "plane.amplitude.count=6",
                      job=JOBS / "figure_07a.toml")
        self.assert_within("study.h5", tool="plot_accuracy")


if __name__ == "__main__":
    unittest.main()
