"""Points whose verdict needs more friction than there is, hatched and counted by plot_spectrum, and pictures of blocks
that slip.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import h5py
import numpy as np
from plot_spectrum_test import F_MINUS, NOT_COMPUTED, S, UNDECIDED, Picture, shares
from recorded_spectra_test import Recorded  # first: adds the package to the path
from overturn.marked_points import slips


class TestSlippingBlocks(Recorded):
    def report(self, *arguments):
        return self.printed("--friction-demand", *arguments)

    def veiled(self, coefficient):
        """Returns the share of the pixels in each quarter of the map that differs from one without friction."""
        plain, hatched = self.picture(), self.picture("--friction-demand", coefficient)
        differs = (plain != hatched).any(axis=2)
        height, width = differs.shape
        panel = differs[int(0.15 * height):int(0.9 * height), int(0.081 * width):int(0.697 * width)]
        return [quarter[:, 20:-20].mean() for quarter in np.array_split(panel, 4, axis=1)]

    def test_are_hatched_and_counted(self):
        self.recorded([np.repeat([S, F_MINUS, S, S], 16)])
        self.add("friction_demand", np.repeat([0.499, 0.501, np.inf, np.nan], 16))
        self.assertIn("may slip with a friction coefficient of 0.5: 48 of 64 points with a verdict (75 %)",
                      self.report("0.5"))
        self.assertIn("coefficient of 0.5", self.words("--friction-demand", "0.5"))
        shares = self.veiled("0.5")
        self.assertLess(shares[0], 0.02)
        self.assertGreater(min(shares[1:]), 0.98)

    def test_are_not_counted_without_a_verdict(self):
        self.recorded([[S, UNDECIDED, S, NOT_COMPUTED]], computed=[[1, 1, 0, 0]])
        self.add("friction_demand", [0.3, np.nan, 5.0, np.nan])
        self.assertIn("0 of 1 points with a verdict (0 %)\nunfinished: 2 of 4 tiles computed\n", self.report("0.5"))
        self.assertLess(max(self.veiled("0.5")), 0.02)

    def test_show_in_a_pixel_of_many_points(self):
        self.recorded([np.full(40_000, S)])
        needed = np.full(40_000, 0.2)
        needed[15_000] = 0.9
        self.add("friction_demand", needed)
        self.assertIn("1 of 40000 points", self.report("0.5"))
        self.assertGreater(self.veiled("0.5")[1], 0)

    def test_require_the_field_and_a_coefficient(self):
        self.recorded([[S]])
        self.refuses(74, "no field friction_demand; add it to output.fields", "--friction-demand", "0.5")
        for word in ("0", "-1", "nan", "inf", "35", "much"):
            self.refuses(2, "argument --friction-demand: ", "--friction-demand", word)
        self.refuses(2, "the tangent of the friction angle", "--friction-demand", "35")

    def test_are_those_with_a_verdict_and_without_enough_friction(self):
        random = np.random.default_rng(1)
        region = random.choice([S, F_MINUS, UNDECIDED, NOT_COMPUTED], 1000)
        friction = random.choice([0.1, 0.4, 0.6, np.inf, np.nan], 1000)
        expected = [code in (S, F_MINUS) and not needed <= 0.5 for code, needed in zip(region, friction)]
        np.testing.assert_array_equal(slips(region, friction, 0.5), expected)


class TestBlocksWithFriction(Picture):
    JOB = """
        scene.pulse = "one_sine"
        [plane]
        pulse_period = { first = 0.2, last = 2.0, count = 4 }
        pga = { first = 0.3, last = 2.5, count = 5 }
        restitution_of_maximum = 1
        """
    BOX = "block={width=0.6, height=1.8}"

    def test_name_it_as_an_axis_and_above_panels(self):
        self.overturn("run", "spectrum.h5", self.BOX, "block.friction={first=0.2, last=0.8, count=4}")
        titles = [word for word in self.words() if word.startswith("friction = ")]
        self.assertEqual(titles, ["friction = 0.2", "friction = 0.4", "friction = 0.6", "friction = 0.8"])
        words = self.words("--index", "pulse_period=1")
        self.assertIn("friction coefficient of block and base", words)
        self.assertNotIn("friction = ", " ".join(words))

    def test_name_a_single_one_below_the_title(self):
        self.overturn("run", "spectrum.h5", self.BOX, "block.friction=0.45")
        self.assertIn("one-sine pulse,  friction = 0.45,  α = 0.3218 rad,  r = r_max = 0.7225", self.words())

    def test_name_that_of_each_block_of_a_list(self):
        (self.folder / "t.csv").write_text("name,width,height,friction\nurn,0.6,1.8,0.2\nbust,0.6,1.8,0.4\n")
        self.overturn("run", "spectrum.h5", 'blocks.table="t.csv"', "plane.restitution_of_maximum=1")
        words = self.words()
        self.assertEqual([words[words.index(name) + 1] for name in ("urn", "bust")], ["friction = 0.2", "friction = 0.4"])
        self.assertNotIn("friction = ", " ".join(self.words("--index", "pulse_period=0")))  # over the blocks

    def test_are_undecided_where_they_leave_the_ground_or_jam(self):
        self.overturn("run", "spectrum.h5", "scene.pulse=rectangular", "plane.slenderness=0.6", "plane.size=1",
                      "block.friction=1.5", "plane.pga={first=3, last=9, count=2}")
        with h5py.File(self.folder / "spectrum.h5") as file:
            region = file["region"][()]
        share = np.mean(region == UNDECIDED)
        self.assertTrue(0.2 < share < 0.95)
        found = shares(self.picture(), np.unique(region))
        self.assertAlmostEqual(found[list(np.unique(region)).index(UNDECIDED)], share, delta=0.02)
        self.assertIn("undecided: see field status", self.words())


if __name__ == "__main__":
    unittest.main()
