"""The pictures and numbers of tools/plot_risk.

Requires OVERTURN (the binary) in the environment.
"""

import contextlib
import re
import shutil
import unittest

import h5py
from plot_fragility_test import Curve, run_overturn  # first: adds the package to the path
import overturn
from overturn import risk
from overturn.plot import risks
from risk_test import OPENQUAKE

HAZARD = "# pga [g]\n0.02 0.3\n0.1 0.05\n0.4 2e-3\n1 1e-4\n3 1e-6\n8 1e-9\n"


class Picture(Curve):
    TOOL = "plot_risk"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "hazard.txt").write_text(HAZARD)


class TestAPicture(Picture):
    def test_has_the_hazard_the_fragility_and_the_rate(self):
        text, words = self.words("result.h5", "hazard.txt", "--years", "500", "--survival", "0.3", "--samples", "50")
        for line in (r"overturning against pga \[g\]", r"rate \d.* a year \(95 % confidence",
                     r"survival of 500 years 0\.\d",
                     r"largest factor on the rates of the hazard, survival of 500 years with the probability 0.3: \d",
                     "largest factor on the levels of the hazard"):
            self.assertRegex(text, line)
        for line in ("Risk: result.h5", "PGA [g]", "hazard: hazard.txt", "fragility: a block overturns",
                     "95 % confidence", "contribution of each range", *re.findall("(?:rate|survival) .*", text)[:2]):
            self.assertIn(line, words)

    def test_is_drawn_against_the_measure_of_the_hazard(self):
        text, words = self.words("result.h5", OPENQUAKE, "--site", "1", "--together", "size", "--of", "peak",
                                 "--above", "0.5", "--samples", "50")
        self.assertIn("peak above 0.5 against pgv [m s-1]", text)
        self.assertIn("4 blocks together", text)
        self.assertIn("PGV [m/s]", words)
        self.assertIn("fragility: one of the blocks has peak > 0.5", words)

    def test_of_an_unfinished_file_shows_both_bounds(self):
        shutil.copy(self.folder / "result.h5", self.folder / "part.h5")
        with h5py.File(self.folder / "part.h5", "a") as file:
            file["run/checksum"][-1] = 0  # of the tile of the last motion
        text, words = self.words("part.h5", "hazard.txt", "--samples", "20")
        low, high = map(float, re.search(r"^rate (\S+) to (\S+) a year", text, re.MULTILINE).groups())
        self.assertLess(low, high)
        for line in ("points without a verdict safe", "up to: if they overturn", "points without a verdict, or bins"):
            self.assertIn(line, words)

    def test_of_blocks_that_slip_is_that_of_their_friction(self):
        # With 0.1, no block lifts; with 0.25, the two more slender ones of three do.
        self.overturn("run", "slips.h5", "plane.scale.count=3", "plane.size=1", "block.friction={values=[0.1, 0.25, 3]}")
        self.overturn("run", "sticks.h5", "plane.scale.count=3", "plane.size=1")
        with overturn.open(self.folder / "slips.h5") as slips, overturn.open(self.folder / "sticks.h5") as sticks:
            counts = [overturn.fragility(slips.sel(friction=each), "pga", samples=1).exceeding.sum() for each in (0.1, 0.25, 3)]
            self.assertEqual(counts[0], 0)
            self.assertTrue(0 < counts[1] < counts[2])
            self.assertEqual(counts[2], overturn.fragility(sticks, "pga", samples=1).exceeding.sum())
        text, _ = self.words("slips.h5", "hazard.txt", "--samples", "2")
        self.assertIn(f"{sum(counts)} of 270 points with a verdict, 10 motions, 9 blocks pooled", text)
        text = self.output_of("slips.h5", "--by", "friction", "--samples", "2", "-o", "by.svg", tool="plot_fragility")
        for friction, count in zip(("0.1", "0.25", "3"), counts):
            self.assertRegex(text, rf"{count} of 90 points .*\nfriction = {friction}\n")

    def test_replaces_no_picture_of_another_program(self):
        (self.folder / "other.png").write_text("notes")
        self.refuses(74, "it exists and is not a PNG picture of overturn", "result.h5", "hazard.txt", "-o", "other.png")
        self.assertEqual((self.folder / "other.png").read_text(), "notes")

    def test_is_that_of_an_uncertain_age(self):
        (self.folder / "ages.txt").write_text("# years, weight\n400 1\n600 3\n")
        for options, text in ((("--years", "500", "--years-sigma", "80"), "500 years (normal, standard deviation 80)"),
                              (("--years-interval", "400", "900"), "600 years (lognormal, 95 % from 400 to 900)"),
                              (("--years-samples", "ages.txt"), "600 years (2 samples, 95 % from 400 to 600)")):
            with contextlib.chdir(self.folder):
                self.assertEqual(risks.age_of(risks.read_arguments(["result.h5", "hazard.txt", *options])).text, text)
        output, words = self.words("result.h5", "hazard.txt", *options, "--survival", "0.3", "--samples", "20")
        self.assertRegex(output, rf"(?m)^survival of {re.escape(text)} 0\.\d")
        self.assertIn(f"factor on the levels of the hazard, survival of {text} with the probability 0.3: ", output)
        self.assertIn(f"survival of {text}", words)

    def test_has_a_table_of_the_blocks_together_and_alone(self):
        text, _ = self.words("result.h5", "hazard.txt", "--together", "size", "--survival", "0.3", "--samples", "20")
        rows = re.findall(r"(?m)^(size|all together|\d\S*)  +(.*)$", text)
        self.assertEqual([name for name, _ in rows], ["size", "all together", "0.5", "1", "1.5", "2"])
        self.assertRegex(rows[0][1], r"rate \[1/year\] +survival +factor on rates +factor on levels")
        rates = [float(row.split()[0]) for _, row in rows[1:]]
        self.assertIn(f"rate {rates[0]:.4g} a year", text)
        with overturn.open(self.folder / "result.h5") as dataset:
            first = overturn.fragility(dataset.isel(size=[0]), "pga", bins=20, samples=20)
        hazard = risk.read_hazard(self.folder / "hazard.txt")
        self.assertAlmostEqual(rates[1], risk.annual_rate(hazard, first).rate[0], delta=5e-4 * rates[1])  # four digits

    def test_is_that_of_any_fragility_in_python(self):
        from overturn import plot
        hazard = risk.read_hazard(self.folder / "hazard.txt")
        panels = plot.risk(hazard, risk.binned([0.1, 0.5, 2], [0.2, 0.9], im="pga", units="g"), 100)
        self.assertEqual([panel.get_ylabel() for panel in panels],
                         ["rate of exceedance [1/year]", "probability", "rate of overturning [1/year]"])


class TestBranches(Picture):
    def setUp(self):
        for name, factor in (("low", 0.2), ("high", 2)):
            rows = [line.split() for line in HAZARD.splitlines()[1:]]
            (self.folder / f"{name}.txt").write_text("# pga [g]\n" + "".join(
                f"{level} {factor * float(rate):g}\n" for level, rate in rows))
        (self.folder / "branches.csv").write_text("weight,file\n0.25,low.txt\n0.75,high.txt\n")

    def test_have_their_weights_before_and_after(self):
        text, words = self.words("result.h5", "branches.csv", "--years", "500", "--together", "size", "--csv",
                                 "weights.csv", "--samples", "50")
        self.assertRegex(text, r"(?m)^branch +prior  posterior \(95 % confidence\)")
        low, high = (float(re.search(rf"(?m)^{name} +0\.\d+ +(\S+) ", text)[1]) for name in ("low", "high"))
        self.assertGreater(low, 0.25)
        self.assertAlmostEqual(low + high, 1, delta=1e-4)  # four digits each
        self.assertRegex(text, r"(?m)^branch +low +high$")  # fewer than blocks, of which each has a row
        self.assertEqual(re.findall(r"(?m)^(all together|[\d.]+)  +0", text), ["all together", "0.5", "1", "1.5", "2"])
        rows = (self.folder / "weights.csv").read_text().splitlines()
        self.assertEqual([row.split(",")[:2] for row in rows[1:]], [["low", "0.25"], ["high", "0.75"]])
        self.assertAlmostEqual(float(rows[1].split(",")[2]), low, delta=5e-4 * low)
        for line in ("Risk: result.h5", "weights after the survival of 500 years", "weights of the branches", "before",
                     "after", "95 % confidence", "hazard curves of the branches", "mean before", "mean after", "low",
                     "high", "PGA [g]"):
            self.assertIn(line, words)

    def test_of_an_unfinished_file_have_both_bounds(self):
        shutil.copy(self.folder / "result.h5", self.folder / "part.h5")
        with h5py.File(self.folder / "part.h5", "a") as file:
            file["run/checksum"][-1] = 0  # of the tile of the last motion
        text, words = self.words("part.h5", "branches.csv", "--years", "500", "--samples", "20")
        self.assertRegex(text, r"(?m)^low +0\.25 +0\.\d+ to 0\.\d+ ")
        for line in ("after, up to: bounds", "two numbers are bounds"):
            self.assertIn(line, words)

    def test_are_refused_with_options_of_one_hazard_and_without_their_files(self):
        self.refuses(2, "--survival: \"branches.csv\" is a list of branches. Omit it.", "result.h5", "branches.csv",
                     "--survival", "0.1")
        self.refuses(2, "--csv: \"low.txt\" is no list of branches. Omit it.", "result.h5", "low.txt", "--csv", "o.csv")
        (self.folder / "low.txt").unlink()
        self.refuses(74, 'low.txt": No such file or directory (named in branches.csv:2)', "result.h5", "branches.csv")


class TestARiskRefused(Picture):
    def refuses(self, code, sentence, *arguments):
        run = super().refuses(code, sentence, *arguments, "-o", "refused.png")
        self.assertEqual(run.stdout, "")
        self.assertFalse((self.folder / "refused.png").exists())

    def test_without_files_that_can_be_read(self):
        self.refuses(74, 'cannot read "missing.txt"', "result.h5", "missing.txt")
        self.refuses(74, 'cannot read "missing.h5"', "missing.h5", "hazard.txt")
        self.refuses(2, 'hazard.txt:1: "notes" is not two numbers', "result.h5", self.write("notes\n"))

    def write(self, text):
        (self.folder / "hazard.txt").write_text(text)
        self.addCleanup((self.folder / "hazard.txt").write_text, HAZARD)
        return "hazard.txt"

    def test_of_two_measures_or_several_sites(self):
        self.refuses(2, "states the measure pga, not pgv", "result.h5", "hazard.txt", "--im", "pgv")
        self.refuses(2, "the hazard is of pga [m/s2], the fragility of pga [g]", "result.h5",
                     self.write(HAZARD.replace("[g]", "[m/s2]")))
        self.refuses(2, "'sa' is not an intensity measure", "result.h5", self.write(HAZARD.replace("pga", "sa")))
        self.refuses(2, "Choose one with site = 0 to 1", "result.h5", OPENQUAKE)

    def test_of_pooled_samples_of_a_rock(self):
        (self.folder / "samples.csv").write_text("azimuth_of,sample,slenderness,size\nrock,0,0.2,1\nrock,1,0.15,1\n")
        run_overturn(self.folder, "run", 'scene.record = "*.AT2"\nblocks.table = "samples.csv"\n'
                     "plane.restitution_of_maximum = 0.9\nplane.scale.values = [1, 2, 4]\n", "samples.h5")
        self.refuses(2, "Use a table without --jitter", "samples.h5", "hazard.txt", "--samples", "1")

    def test_without_a_time_or_a_probability(self):
        self.refuses(2, "--years: -1 is not a positive number", "result.h5", "hazard.txt", "--years", "-1")
        self.refuses(2, "--years-sigma is the standard deviation of --years. Give both", "result.h5", "hazard.txt",
                     "--years-sigma", "100")
        self.refuses(2, "--years and a distribution without it", "result.h5", "hazard.txt", "--years", "100",
                     "--years-interval", "50", "200")
        self.refuses(2, "low = 200 is not below high = 50", "result.h5", "hazard.txt", "--years-interval", "200", "50")
        self.refuses(74, 'cannot read "ages.txt"', "result.h5", "hazard.txt", "--years-samples", "ages.txt")
        self.refuses(2, "--survival: 2 is not between 0 and 1", "result.h5", "hazard.txt", "--survival", "2")
        self.refuses(2, "'mass' is not a property of the blocks", "result.h5", "hazard.txt", "--together", "mass")


if __name__ == "__main__":
    unittest.main()
