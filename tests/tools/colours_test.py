"""The colours of verdicts and regions, as seen with normal sight, with each kind of colour blindness, and in grey."""

import itertools
import unittest

import numpy as np
from matplotlib import colors
from tool import InAFolder  # noqa: F401  first: adds the package to the path
from overturn.plot.curves import COLOURS
from overturn.regions import CODES, REGIONS, SAFE, UNDECIDED, UNSAFE

# Machado, Oliveira, Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009) 1291, severity 1.0; for linear RGB.
SIGHTS = {
    "normal": np.eye(3),
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    "grey": np.tile([0.2126, 0.7152, 0.0722], (3, 1))}
XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])
PAPER = "#ffffff"


def seen(colour, sight):
    """Returns L*, a*, b* of a colour (CIE 1976, D65)."""
    rgb = np.array(colors.to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = XYZ @ np.clip(SIGHTS[sight] @ linear, 0, 1) / XYZ.sum(axis=1)
    x, y, z = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def difference(first, second):
    """Returns CIEDE2000 of two L*, a*, b* with unit weights: Sharma, Wu, Dalal, Color Res. Appl. 30 (2005) 21."""
    (l1, a1, b1), (l2, a2, b2) = first, second
    c7 = ((np.hypot(a1, b1) + np.hypot(a2, b2)) / 2) ** 7
    stretch = 1.5 - 0.5 * np.sqrt(c7 / (c7 + 25.0**7))
    c1, c2 = np.hypot(stretch * a1, b1), np.hypot(stretch * a2, b2)
    h1, h2 = (np.degrees(np.arctan2(b, stretch * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    h = h1 + h2 if c1 * c2 == 0 else (h1 + turn / 2) % 360
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    t = sum(weight * np.cos(np.radians(n * h - shift))
            for weight, n, shift in ((1, 0, 0), (-0.17, 1, 30), (0.24, 2, 0), (0.32, 3, -6), (-0.20, 4, 63)))
    dl = (l2 - l1) / (1 + 0.015 * (l - 50) ** 2 / np.sqrt(20 + (l - 50) ** 2))
    dc = (c2 - c1) / (1 + 0.045 * c)
    dh = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * c * t)
    rotation = 60 * np.exp(-((h - 275) / 25) ** 2)
    r = -2 * np.sqrt(c**7 / (c**7 + 25.0**7)) * np.sin(np.radians(rotation))
    return np.sqrt(dl**2 + dc**2 + dh**2 + r * dc * dh)


def of(codes):
    return [REGIONS[code][2] for code in codes]


def least(first, second, sight):
    return min(difference(seen(a, sight), seen(b, sight)) for a in first for b in second)


class TestTheMeasure(unittest.TestCase):
    def test_of_the_difference_agrees_with_published_pairs(self):
        for first, second, expected in (  # pairs 1, 7, 9, 11, 17, 20, 25 and 34 of table 1 of Sharma et al.
                ((50.0000, 2.6772, -79.7751), (50.0000, 0.0000, -82.7485), 2.0425),
                ((50.0000, 0.0000, 0.0000), (50.0000, -1.0000, 2.0000), 2.3669),
                ((50.0000, 2.4900, -0.0010), (50.0000, -2.4900, 0.0009), 7.1792),
                ((50.0000, 2.4900, -0.0010), (50.0000, -2.4900, 0.0011), 7.2195),
                ((50.0000, 2.5000, 0.0000), (73.0000, 25.0000, -18.0000), 27.1492),
                ((50.0000, 2.5000, 0.0000), (58.0000, 24.0000, 15.0000), 19.4535),
                ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
                ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082)):
            self.assertAlmostEqual(difference(first, second), expected, delta=5e-5)
            self.assertAlmostEqual(difference(second, first), expected, delta=5e-5)


class TestTheColours(unittest.TestCase):
    CLASSES = {"stands": of(SAFE), "topples": of(UNSAFE), "unknown": of([UNDECIDED])}

    def test_of_what_stands_topples_and_is_unknown_are_told_apart_by_every_sight(self):
        # 1 is just visible side by side.
        for (one, first), (other, second) in itertools.combinations(self.CLASSES.items(), 2):
            for sight in SIGHTS:
                self.assertGreaterEqual(least(first, second, sight), 15, (one, other, sight))

    def test_of_danger_stand_out_from_paper_and_those_of_safety_recede(self):
        for sight in SIGHTS:
            stands, unknown, topples = ([difference(seen(colour, sight), seen(PAPER, sight)) for colour in self.CLASSES[name]]
                                        for name in ("stands", "unknown", "topples"))
            self.assertLess(max(stands) + 5, min(unknown), sight)
            self.assertLess(max(unknown) + 5, min(topples), sight)

    def test_of_the_regions_of_a_class_are_told_apart(self):
        u2 = {REGIONS[CODES[name]][2] for name in ("U2+", "U2-")}  # by its hue, hence not in grey
        for shades, sight in itertools.product(self.CLASSES.values(), SIGHTS):
            for pair in itertools.combinations(shades, 2):
                if sight != "grey" or not u2 & {*pair}:
                    self.assertGreater(difference(*(seen(colour, sight) for colour in pair)), 2.5, (pair, sight))

    def test_of_curves_are_told_apart_from_each_other_and_from_paper(self):
        for sight in SIGHTS:
            self.assertGreater(least(COLOURS, [PAPER], sight), 15)
            for pair in itertools.combinations(COLOURS, 2):
                self.assertGreater(difference(*(seen(colour, sight) for colour in pair)), 9, (pair, sight))


if __name__ == "__main__":
    unittest.main()
