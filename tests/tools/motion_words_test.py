"""The words of tools, commands and result files for the motion of a floor: PFA, PFV, and no ground.

Requires OVERTURN (the binary) in the environment.
"""

import contextlib
import json
import os
import re
import subprocess
import unittest
from unittest import mock

import h5py
import numpy as np
from matplotlib import pyplot
from matplotlib.text import Text
from tool import InOneFolder, run_overturn  # first: adds the package to the path
import overturn
from overturn.captions import subtitle
from overturn import motion_words
from overturn.motion_words import worded
from overturn.plot import risks
from overturn.result_file import Result
from overturn.spectrum_planes import Plane
from overturn.units import name_axes

FLOOR = {"motion_of": "floor"}
FLOOR_MEASURES = {measure: variable for measure, variable in motion_words.FLOOR_MEASURES.items()
                  if "_rotd" not in measure}  # those of a record of one component
OF_GROUND = re.compile("ground|PGA|PGV|u_g")
JOB = """
    [scene]
    record = "motion.txt"
    units = "g"
    {motion_of}
    [plane]
    {strength} = {{ first = 0.2, last = 2, count = 4 }}
    size = {{ first = 0.5, last = 1, count = 3 }}
    slenderness = 0.25
    restitution_of_maximum = 0.9
    [output]
    fields = ["region", "angle", "velocity", "peak", "friction_demand"]
    """
RUN = {"spectrum": "run", "boundary": "boundary", "history": "history"}  # command by product
TOOLS = {"spectra": "plot_spectrum", "boundaries": "plot_boundary", "histories": "plot_history",
         "fragility_curves": "plot_fragility", "risks": "plot_risk"}
PHYSICAL = ("--units", "physical")
QUICK = ("--samples", "2")
# Module, arguments, and what the picture says.
PICTURES = [("spectra", ("pga_spectrum.h5",), "PFA [g]", "motion of a floor"),
            ("boundaries", ("pga_boundary.h5",), "PFA [g]", "0.1 % of the PFA", "motion of a floor"),
            ("histories", ("pga_history.h5",), r"floor  $\ddot u_f/g$", "PFA = 0.6 g"),
            ("histories", ("scale_history.h5", *PHYSICAL), "floor [g]"),
            ("fragility_curves", ("pga_spectrum.h5", *QUICK), "PFV [m/s]", "against pfv ["),  # by default
            ("fragility_curves", ("scale_spectrum.h5", *QUICK, "--im", *FLOOR_MEASURES.values()),
             "PFA [g]", "PFV [m/s]", "Arias intensity of the floor [m/s]", "significant duration of the floor [s]",
             *(f"against {measure} [" for measure in FLOOR_MEASURES)),
            ("risks", ("pga_spectrum.h5", "pfa.csv", *QUICK), "PFA [g]", "pfa = 1 g")]
# File, units, and the words around the picture.
PLANES = [(f"{strength}_{product}.h5", units,
           "PFA [g]" if (strength, units) != ("scale", "job") else "scale of the record",
           *["PFA 0.5 g"] * ((strength, units) == ("scale", "job")), "motion of a floor")
          for strength in ("pga", "scale") for product in ("spectrum", "boundary") for units in ("job", "physical")]
# Arguments, and what the program says. Commands of a block: with its dimensions.
BLOCK = ("--width", "0.25", "--height", "1", "--pga-max", "0.6")
RECORD = ("--record", "motion.txt", "--set=scene.units=g", "--set=scene.motion_of=floor")
SENTENCES = [(("check", "pga.toml"), "that of a floor", "floor        peak 0.2 to 2 g"),
             (("check", "scale.toml"), "that of a floor", "floor        peak 0.1 to 1 g"),
             (("info", "pga_spectrum.h5"), "that of a floor", 'motion_of = "floor"'),
             (("info", "scale_boundary.h5"), "that of a floor", 'motion_of = "floor"'),
             (("info", "pga_history.h5"), "that of a floor", 'motion_of = "floor"'),
             (("topple", *BLOCK, *RECORD, "--pga", "0.3"), "at a peak floor acceleration of"),
             (("topple", *BLOCK, *RECORD, "--scale", "12"), "that of a floor",
              "the peak floor acceleration = 6 g is above 5 g"),
             (("topple", *BLOCK, "--period", "0.5", "--pga", "0.3", "--set=scene.motion_of=floor"), "that of a floor",
              "at a peak floor acceleration of")]


class TestAFloor(InOneFolder):
    """A result of each product and strength under the motion of a floor."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        time = np.arange(60) / 30
        text = "".join(f"{t:.6f} {a:.6f}\n" for t, a in zip(time, 0.5 * np.sin(6 * time)))
        (cls.folder / "motion.txt").write_text(f"# ground_pga = 0.2\n{text}")
        for strength in ("pga", "scale"):
            for product, command in RUN.items():
                single = {"history": [f"plane.{strength}=0.6", "plane.size=0.5"]}.get(product, [])
                run_overturn(cls.folder, command, JOB.format(strength=strength, motion_of='motion_of = "floor"'),
                             f"{strength}_{product}.h5", *single)
            (cls.folder / f"{strength}.toml").write_text((cls.folder / "job.toml").read_text())
        (cls.folder / "pga.csv").write_text("# pga [g]\n0.1 0.1\n1 0.001\n")
        (cls.folder / "pfa.csv").write_text("# pfa [g]\n0.1 0.1\n1 0.001\n")

    def drawn(self, module, *arguments):
        """Returns the texts of the picture of a tool, and what it prints."""
        texts = []

        def keep(figure, *_, **__):
            texts.extend(filter(None, (text.get_text() for text in figure.findobj(Text))))
            pyplot.close(figure)
        with mock.patch(f"overturn.plot.{module}.save", keep):
            printed = self.output_of(*arguments, "-o", "picture.svg", tool=TOOLS[module])
        return "\n".join([*texts, printed])

    def says(self, *arguments):
        done = subprocess.run([os.environ["OVERTURN"], *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def assert_of_floor(self, text, *phrases):
        self.assertIsNone(OF_GROUND.search(text.replace("ground_pga", "")), text)
        for phrase in phrases:
            self.assertIn(phrase, text)

    def test_is_named_in_every_picture(self):
        for module, arguments, *phrases in PICTURES:
            with self.subTest(module, arguments=arguments):
                self.assert_of_floor(self.drawn(module, *arguments), *phrases)

    def test_is_named_around_every_plane(self):
        for path, units, *phrases in PLANES:
            with self.subTest(path, units=units), h5py.File(self.folder / path) as file:
                result = Result(file)
                plane = Plane(result, {}, *result.dimensions[:-3:-1])
                words = [*name_axes(plane, units), subtitle([plane], units)]
                self.assert_of_floor("\n".join(words), *phrases)

    def test_is_named_by_every_command(self):
        for arguments, *phrases in SENTENCES:
            with self.subTest(arguments):
                self.assert_of_floor(self.says(*arguments), *phrases)

    def test_is_named_in_the_attributes_of_every_variable(self):
        for path in sorted(self.folder.glob("*_*.h5")):
            with h5py.File(path) as file:
                self.assertEqual(file.attrs["motion_of"].decode(), "floor")
                texts = []
                file.visititems(lambda name, data: texts.extend(
                    (name, data.attrs[key].decode()) for key in ("long_name", "comment") if key in data.attrs
                    and name != "ground_pga"))
            for name, text in texts:
                with self.subTest(path.name, variable=name):
                    self.assert_of_floor(text)

    def test_is_named_in_the_columns_of_a_table(self):
        for _ in "ab":  # which replaces its own tables
            self.output_of("pga_spectrum.h5", "-o", "table.csv", tool="to_csv")
        self.assertTrue((self.folder / "table.csv").read_text().startswith("size,pfa,"))

    def test_is_named_in_json(self):
        answer = json.loads(self.says("topple", *BLOCK, *RECORD, "--pga", "0.3", "--json"))
        self.assertEqual(answer["motion_of"], "floor")

    def test_of_a_known_ground_has_its_pga(self):
        with overturn.open(self.folder / "scale_spectrum.h5") as result:
            curve = overturn.fragility(result, "ground_pga", samples=1)
        self.assertEqual((curve.im, curve.units), ("pga", "g"))
        # The PGA of the ground is 0.2 g; the scales are from 0.2 to 2.
        np.testing.assert_allclose(curve.edges[[0, -1]], [0.04, 0.4])

    def test_is_not_drawn_on_the_spectrum_of_the_ground(self):
        run_overturn(self.folder, "run", JOB.format(strength="pga", motion_of=""), "ground.h5")
        run = self.run_tool("ground.h5", "--boundary", "pga_boundary.h5", "-o", "picture.svg", tool="plot_spectrum")
        self.assertIn("has motion_of floor, but the spectrum has none", run.stderr)

    def test_has_the_hazard_of_its_ground_if_this_is_known(self):
        with contextlib.chdir(self.folder):
            site = risks.compute(risks.read_arguments(["pga_spectrum.h5", "pga.csv", *QUICK]))
        hazard, = site.hazards
        self.assertEqual((hazard.im, site.curve.im), ("pga", "pga"))
        self.assertGreater(overturn.risk.annual_rate(hazard, site.curve).rate[0], 0)

    def test_has_no_measure_that_is_combined_with_a_hazard_of_the_ground(self):
        hazards = {name: overturn.risk.Hazard([0.1, 1], [0.1, 0.001], name, units) for name, units in (
            ("pga", "g"), ("pgv", "m/s"), ("arias_intensity", "m/s"), ("significant_duration", "s"))}
        with overturn.open(self.folder / "pga_spectrum.h5") as result:
            for measure, variable in FLOOR_MEASURES.items():
                curve = overturn.fragility(result, variable, samples=1)
                for combine in (overturn.risk.annual_rate,
                                lambda hazard, curve: overturn.risk.largest_factor(hazard, curve, 1, 0.5)):
                    with self.assertRaisesRegex(ValueError, f"the hazard is of {variable} .*, the fragility of "
                                                f"{measure} .*against ground_{variable}, the measure of the ground"):
                        combine(hazards[variable], curve)

    def test_is_refused_with_a_hazard_of_a_measure_that_is_not_known(self):
        (self.folder / "pgv.csv").write_text("# pgv [m/s]\n0.1 0.1\n1 0.001\n")
        self.refuses(2, "im = 'ground_pgv' is not an intensity measure of the motions. This result has pfa, pfv, "
                     "floor_arias_intensity, floor_significant_duration, ground_pga;", "pga_spectrum.h5", "pgv.csv",
                     tool="plot_risk")


class TestTheWords(unittest.TestCase):
    def test_for_the_ground_are_the_text(self):
        self.assertEqual(worded({}, "ground, PGA, PGV"), "ground, PGA, PGV")

    def test_for_a_floor_replace_every_word(self):
        self.assertEqual(worded(FLOOR, "ground, PGA, PGV"), "floor, PFA, PFV")


if __name__ == "__main__":
    unittest.main()
