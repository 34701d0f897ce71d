"""The portraits of tools/plot_phase: their colours compared with Eq. 20, their texts read from
SVG."""

import itertools
import os
import re
import subprocess
import unittest

import h5py
import numpy as np
from matplotlib import colors, pyplot
from tool import InAFolder  # first: adds the package to the path
from overturn.phase_space import (FreeBlock, fill_libration, fill_regions, largest_restitution,
                                  regions_of_states)
from overturn.plot.portraits import block_of_file
from overturn.regions import LEFT_STANDING, REGIONS

ALPHA, R = 0.4, 0.6
HIGHEST = 1.5


def painted(paint):
    """Returns the picture of a panel from -pi/2 to pi/2 and from -HIGHEST to HIGHEST, filled by
    `paint`; rows are counted upward."""
    figure = pyplot.figure(figsize=(4, 4), dpi=100)
    panel = figure.add_axes([0, 0, 1, 1], xlim=(-np.pi / 2, np.pi / 2), ylim=(-HIGHEST, HIGHEST))
    panel.axis("off")
    paint(panel)
    figure.canvas.draw()
    picture = np.asarray(figure.canvas.buffer_rgba())[::-1, :, :3]
    pyplot.close(figure)
    return picture


def region_by_the_criterion(angle, rate):
    """Region by Eqs. 12, 16, 18 and 20, with the names of Fig. 4; None near a boundary, where a
    pixel mixes two regions: it is 0.0075 high, and q0 changes by at most 2.4 times that."""
    q0 = 4 * np.sin((ALPHA - abs(angle)) / 2)**2 - rate**2
    q_max = 4 * np.sin(ALPHA / 2)**2
    q_min = q_max * (1 - 1 / R)
    if min(abs(q0), abs(q0 - q_min), abs(angle), abs(rate), abs(abs(angle) - ALPHA)) < 0.03:
        return None
    if abs(angle) <= ALPHA and 0 <= q0 <= q_max:
        return "S"
    towards = angle * rate < 0
    if towards and q_min <= q0 <= 0:
        return "S+" if rate > 0 else "S−"
    if towards and q0 < q_min:
        return "U1+" if rate > 0 else "U1−"
    return "U0+" if angle > 0 else "U0−"


class TestTheRegions(unittest.TestCase):
    def test_every_place_has_the_colour_of_its_region(self):
        picture = painted(lambda panel: fill_regions(panel, FreeBlock(ALPHA, R), np.pi / 2, HIGHEST))
        colour_of = {name: [round(255 * part) for part in colors.to_rgb(colour)]
                     for name, _, colour in REGIONS.values()}
        seen = set()
        for row, column in np.ndindex(100, 100):
            angle = ((4 * column + 2) / 400 - 0.5) * np.pi
            rate = ((4 * row + 2) / 400 - 0.5) * 2 * HIGHEST
            name = region_by_the_criterion(angle, rate)
            if name:
                seen.add(name)
                found = picture[4 * row + 2, 4 * column + 2]
                self.assertEqual(list(found), colour_of[name], (angle, rate, name))
        self.assertEqual(seen, {"S", "S+", "S−", "U0+", "U0−", "U1+", "U1−"})

    def test_the_libration_region_consists_of_the_safe_regions(self):
        picture = painted(lambda panel: fill_libration(panel, FreeBlock(ALPHA, R), "black", np.pi / 2, HIGHEST))
        for row, column in np.ndindex(100, 100):
            name = region_by_the_criterion(((4 * column + 2) / 400 - 0.5) * np.pi,
                                           ((4 * row + 2) / 400 - 0.5) * 2 * HIGHEST)
            if name:
                self.assertEqual(picture[4 * row + 2, 4 * column + 2, 0] == 0, name[0] == "S")


class TestTheFormulas(unittest.TestCase):
    def test_give_the_papers_restitution(self):
        self.assertAlmostEqual(largest_restitution(np.arctan(1 / 5.67)), 0.912, delta=0.0005)

    def test_give_the_points_of_the_blades(self):
        block = FreeBlock(ALPHA, R)
        largest = 2 * np.sin(ALPHA / 2)  # Eq. 8
        self.assertAlmostEqual(block.largest_rate, largest, delta=1e-15)
        self.assertAlmostEqual(block.inward_rate(0.0), largest / np.sqrt(R), delta=1e-15)
        self.assertAlmostEqual(block.inward_rate(ALPHA), largest * np.sqrt(1 / R - 1), delta=1e-15)

    def test_turn_an_orbit_back_where_its_speed_is_zero(self):
        for linear in (False, True):
            block = FreeBlock(ALPHA, R, linear)
            q = 0.3 * block.largest_rate**2
            self.assertAlmostEqual(block.rate(block.outermost_angle(q), q), 0, delta=1e-7)

    def test_are_straight_in_the_linear_theory(self):
        np.testing.assert_allclose(FreeBlock(ALPHA, R, linear=True).separatrix_rate(
            np.array([-0.5, 0, 0.1])), [-0.1, 0.4, 0.3], atol=1e-15)


class TestAPortrait(InAFolder):
    TOOL = "plot_phase"

    def text(self, portrait, *arguments):
        """Returns all words in one line; a bar or a prime is a separate word."""
        return " ".join(re.findall(r"<(?:text|tspan)[^>]*>\s*([^<\s][^<]*)", self.svg(portrait, *arguments)))

    def test_of_the_regions_names_all_seven(self):
        words = self.text("regions").split()
        for name in ("S", "S+", "S−", "U0+", "U0−", "U1+", "U1−"):
            self.assertEqual(words.count(name), 1, name)

    def test_names_the_papers_points(self):
        for portrait, names in (("pendulum", "ABD"), ("libration", "ABC")):
            words = self.text(portrait)
            for name in names:
                self.assertRegex(words, rf"\b{name}\b", portrait)

    def test_names_the_block(self):
        words = self.text("libration", "--slenderness", "0.3", "--restitution", "0.75")
        self.assertIn("0.3 rad", words)
        self.assertIn("0.75", words)

    def test_has_the_regions_of_the_end_states_of_a_computed_file(self):
        seen = set()
        for number, (block, theory) in enumerate(itertools.product(
                ("width = 0.5\nheight = 2\nincline = 0.07", "width = 0.6\nheight = 1.5\ncenter_offset = -0.1",
                 "width = 0.5\nheight = 2"), ("nonlinear", "linear"))):
            (self.folder / "job.toml").write_text(f"""
                scene = {{ pulse = "one_sine", theory = "{theory}" }}
                [block]\n{block}
                [plane]
                pulse_period = {{ first = 0.2, last = 1.5, count = 60 }}
                pga = {{ first = 0.1, last = 1.5, count = 60 }}
                direction = {{ values = [0, 180] }}
                restitution_of_maximum = 0.95
                [output]
                fields = ["region", "angle", "velocity", "margin"]""")
            path = self.folder / f"{number}.h5"
            subprocess.run([os.environ["OVERTURN"], "run", self.folder / "job.toml", "-o", path], check=True,
                           capture_output=True)
            with h5py.File(path) as file:
                region, angle, velocity, margin = (file[name][:] for name in ("region", "angle", "velocity", "margin"))
            clear = np.isin(region, LEFT_STANDING) & (np.abs(margin) > 1e-9) & (angle != 0)
            found = regions_of_states(block_of_file(path), angle, velocity)
            np.testing.assert_array_equal(found[clear], region[clear])
            seen |= set(region[clear])
            run = self.run_tool("regions", "--block", path, "-o", "picture.png")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertGreaterEqual(len(seen), 8)
        self.assertTrue(seen & {9, 10})

    def test_can_be_drawn_for_any_block(self):
        for alpha, r in (("0.02", "0.999"), ("1.4", "0.05"), ("1.5", "1")):
            for portrait in ("libration", "regions"):
                run = self.run_tool(portrait, "--slenderness", alpha, "--restitution", r)
                self.assertEqual((run.returncode, run.stderr), (0, ""), (portrait, alpha, r))
        run = self.run_tool("pendulum", "--slenderness", "1.5")
        self.assertEqual((run.returncode, run.stderr), (0, ""))

    def test_is_refused_for_invalid_blocks_and_formats(self):
        for arguments, sentence in ((("regions", "--slenderness", "1.6"), "outside (0, pi/2)"),
                                    (("regions", "--restitution", "1.2"), "outside (0, 1]"),
                                    (("pendulum", "--restitution", "1"), "no loss at impacts"),
                                    (("regions", "-o", "picture.jpg"), ".png, .pdf or .svg"),
                                    (("libration", "--block", "a.h5"), "for the portrait regions"),
                                    (("others",), "invalid choice")):
            self.refuses(2, sentence, *arguments)


if __name__ == "__main__":
    unittest.main()
