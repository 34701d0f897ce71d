"""Regions of a spectrum in plots: names, meanings, colours."""

import matplotlib
import numpy as np
from matplotlib.patches import Patch

# The paper's colours. Each kind has its own lightness, CIE L* from U0 (96, 90) through S (75), U1
# (65, 58) and F (49, 40) to S+- (31, 21), so that the map is readable in greyscale and for colour-blind
# readers. The minus of a pair is the darker one. Of F, the main structure under records, the minus is the paper's grey,
# and the plus differs in hue, too. U2, of blocks with two different sides, differs by its hue.
UNDECIDED, NOT_COMPUTED = 254, 255
# In pictures alone: between computed values that are far from each other, and between bands.
BETWEEN, APART = 253, 252
LEFT_OUT = 251  # of a data set, by its user
NOTHING = {NOT_COMPUTED: "not computed yet", LEFT_OUT: "left out", BETWEEN: "between computed values"}  # hatched
REGIONS = {
    0: ("S", "safe, no more impacts needed", "#8bc77f"),
    1: ("S+", "safe after one more impact", "#0b5530"),
    2: ("S−", "safe after one more impact", "#073a2c"),
    3: ("U0+", "overturns, no more impacts", "#fff6bd"),
    4: ("U0−", "overturns, no more impacts", "#ffe27a"),
    5: ("U1+", "overturns, one more impact", "#c9961a"),
    6: ("U1−", "overturns, one more impact", "#b6801e"),
    7: ("F+", "falls during the pulse", "#7d6fa5"),
    8: ("F−", "falls during the pulse", "#5e5e66"),
    9: ("U2+", "overturns, two more impacts", "#d0603f"),
    10: ("U2−", "overturns, two more impacts", "#b8472a"),
    UNDECIDED: ("", "undecided: see field status", "#e6007e"),
}
CODES = {name.replace("−", "-"): code for code, (name, _, _) in REGIONS.items() if name}
SAFE = [code for name, code in CODES.items() if name.startswith("S")]
FALLEN = [code for name, code in CODES.items() if name.startswith("F")]
UNSAFE = [code for code in CODES.values() if code not in SAFE]
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


def legend_entries(codes, ground="pulse"):
    """One entry per region in the picture, and one per kind of point without a region; `ground` is
    a word for the ground motion."""
    entries = []
    for code, (name, _, colour) in REGIONS.items():
        if code in codes:
            meaning = meaning_of(code, ground)
            label = f"{name}  {meaning}" if name else meaning
            entries.append(Patch(facecolor=colour, edgecolor="black", linewidth=0.5, label=label))
    words = [word for code, word in NOTHING.items() if code in codes]
    if words:
        entries.append(Patch(facecolor="white", edgecolor="0.6", hatch="////", linewidth=0.5, label=",\nor ".join(words)))
    return entries
