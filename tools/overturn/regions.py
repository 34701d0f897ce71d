"""Regions of a spectrum in plots: names, meanings, colours."""

import matplotlib
import numpy as np
from matplotlib.patches import Patch

# Danger is where the eye goes, with any colour vision and in grey: what stands recedes (CIE L* above 84), what is unknown
# is grey (62), what topples is dark and red (up to 46). The kinds differ in lightness: S (97), S+- (88, 84); F (46, 39), the
# main structure under records, whose two differ in hue, too; U0 (30, 25), U1 (17, 11). The minus of a pair is the darker
# one. U2, of blocks with two different sides, differs by its hue.
UNDECIDED, NOT_COMPUTED = 254, 255
# In pictures alone: between computed values that are far from each other, and between bands.
BETWEEN, APART = 253, 252
LEFT_OUT = 251  # of a data set, by its user
NOTHING = {NOT_COMPUTED: "not computed yet", LEFT_OUT: "left out", BETWEEN: "between computed values"}  # hatched
REGIONS = {
    0: ("S", "safe, no more impacts needed", "#f3f8ef"),
    1: ("S+", "safe after one more impact", "#c2e6cd"),
    2: ("S−", "safe after one more impact", "#b3dcc0"),
    3: ("U0+", "overturns, no more impacts", "#8c1043"),
    4: ("U0−", "overturns, no more impacts", "#730d40"),
    5: ("U1+", "overturns, one more impact", "#3f1a4d"),
    6: ("U1−", "overturns, one more impact", "#3d0d0d"),
    7: ("F+", "falls during the pulse", "#c43f00"),
    8: ("F−", "falls during the pulse", "#b41a1c"),
    9: ("U2+", "overturns, two more impacts", "#7d3ab0"),
    10: ("U2−", "overturns, two more impacts", "#6a2c9c"),
    UNDECIDED: ("", "undecided: see field status", "#969696"),
}
HATCH = {"facecolor": REGIONS[UNDECIDED][2], "edgecolor": "white", "hatch": "////"}  # of what is not computed
CODES = {name.replace("−", "-"): code for code, (name, _, _) in REGIONS.items() if name}
SAFE = [code for name, code in CODES.items() if name.startswith("S")]
FALLEN = [code for name, code in CODES.items() if name.startswith("F")]
UNSAFE = [code for code in CODES.values() if code not in SAFE]
# The verdict on each code, as the code of the region whose colour it has.
STANDS, TOPPLES = CODES["S"], CODES["F-"]
VERDICT_OF = np.full(256, UNDECIDED, np.uint8)
VERDICT_OF[SAFE], VERDICT_OF[UNSAFE], VERDICT_OF[APART] = STANDS, TOPPLES, APART
VERDICTS = {STANDS: "stands", TOPPLES: "topples", UNDECIDED: "unknown"}
LEFT_STANDING = [code for code in CODES.values() if code not in FALLEN]
# What a pixel must not hide: the kinds of codes, the last one first.
_KINDS = np.full(256, 2)
_KINDS[SAFE], _KINDS[UNSAFE], _KINDS[[NOT_COMPUTED, LEFT_OUT]] = 0, 1, 3


def ranks(codes):
    """Returns numbers that order codes by what a pixel must not hide: not computed, undecided, overturning, safe."""
    return (_KINDS[codes] << 8 | codes).astype(np.uint16)


def worst(middle, rank):
    """Returns the code in the middle of each pixel, or that of the highest rank under it if it is of another kind."""
    return np.where(rank >> 8 > _KINDS[middle], rank & 255, middle).astype(np.uint8)


def coloured(codes):
    """Returns codes as RGBA; what is not computed is transparent and shows the hatch below."""
    table = np.zeros((256, 4), np.uint8)
    for code, (_, _, colour) in REGIONS.items():
        table[code] = [round(255 * part) for part in matplotlib.colors.to_rgba(colour)]
    table[APART] = 255
    return table[codes]


def meaning_of(code, ground="pulse"):
    """`ground` is a word for the ground motion. At the end of a record, a safe block is at rest or nearly so: there are
    no more impacts to count."""
    if code == CODES["S"] and ground == "record":
        return "safe"
    return REGIONS[code][1].replace("the pulse", f"the {ground}")


def patch(code, label):
    return Patch(facecolor=REGIONS[code][2], edgecolor="black", linewidth=0.5, label=label)


def legend_entries(codes, ground="pulse"):
    """One entry per region in the picture, and one per kind of point without a region; `ground` is
    a word for the ground motion."""
    return [patch(code, f"{name}  {meaning_of(code, ground)}".lstrip()) for code, (name, _, _) in REGIONS.items()
            if code in codes] + hatched_entries(codes)


def hatched_entries(codes):
    """The entry of what is not computed, if there is any."""
    words = [word for code, word in NOTHING.items() if code in codes]
    return [Patch(**HATCH, linewidth=0.5, label=",\nor ".join(words))] * bool(words)
