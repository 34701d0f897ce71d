"""Safe blocks that published practice calls overturned, marked and counted by plot_spectrum.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import h5py
import numpy as np
from matplotlib import colors
from plot_spectrum_test import F_MINUS, NOT_COMPUTED, S, S_PLUS, UNDECIDED
from recorded_spectra_test import Recorded  # first: adds the package to the path
from overturn.marked_points import COLOUR


class TestPublishedPractice(Recorded):
    def practice(self, *arguments):
        return self.printed("--practice", *arguments)

    def test_misjudges_safe_blocks_that_pass_alpha(self):
        self.recorded([np.repeat([S, S, S_PLUS, F_MINUS], 3)])
        self.add("peak", np.repeat([0.999, 1.0, 1.3, np.inf], 3))
        self.assertIn("safe, although |theta| reaches alpha: 6 of 9 safe points (66.7 %)",
                      self.practice())
        colour = [round(255 * part) for part in colors.to_rgb(COLOUR)]
        marked = np.count_nonzero((self.picture("--practice") == colour).all(axis=2))
        self.assertAlmostEqual(marked / 1e6, 0.5, delta=0.01)
        words = self.words("--practice")
        self.assertIn("6 of 9", words)
        self.assertIn("safe points (66.7 %)", words)

    def test_is_not_judged_where_the_outcome_is_unknown(self):
        self.recorded([[S, UNDECIDED, S, NOT_COMPUTED]], computed=[[1, 1, 0, 0]])
        self.add("peak", [0.5, np.nan, 5.0, np.nan])
        self.assertIn("0 of 1 safe points (0 %)\nunfinished: 2 of 4 tiles computed\n", self.practice())

    def test_has_no_share_without_safe_points(self):
        self.recorded([[F_MINUS]])
        self.add("peak", [np.inf])
        self.assertIn("0 of 0 safe points\n", self.practice())

    def test_is_judged_for_each_spectrum_and_in_total(self):
        self.compute()
        lines = self.practice().splitlines()
        with h5py.File(self.folder / "spectrum.h5") as file:
            safe = file["region"][...] <= 2
            wrong = safe & (file["peak"][...] >= 1)
        self.assertGreater(np.count_nonzero(wrong), 0)
        counts = [(np.count_nonzero(wrong), np.count_nonzero(safe))]
        counts += [(np.count_nonzero(wrong[outer]), np.count_nonzero(safe[outer]))
                   for outer in np.ndindex(2, 2, 2)]
        for line, (few, all_safe) in zip(lines[1:], counts, strict=True):
            self.assertIn(f" {few} of {all_safe} safe points", line)
        self.assertIn("synthetic_vertical.AT2,  α = 0.25 rad,  r = r_max", lines[-1])

    def test_requires_the_peak(self):
        self.recorded([[S]])
        self.refuses(74, "no field peak; add it to output.fields", "--practice")

    def test_may_be_compared_under_pulses_too(self):
        self.spectrum([[S, S, F_MINUS]])
        self.add("peak", [0.5, 1.5, np.inf])
        self.assertIn("1 of 2 safe points (50 %)", self.practice())


if __name__ == "__main__":
    unittest.main()
