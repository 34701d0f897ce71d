"""Regions of a spectrum in plots: names, meanings, colours."""

import matplotlib
import numpy as np
from matplotlib.patches import Patch

# The paper's colours. Each kind has its own lightness, CIE L* from U0 (96, 90) through S (75), U1
# (65, 58) and F (49, 40) to S+- (31, 21), so that the map is readable in greyscale and for colour-blind
# readers. The minus of a pair is the darker one. Of F, the main structure under records, the minus is the paper's grey,
# and the plus differs in hue, too.
UNDECIDED, NOT_COMPUTED = 254, 255
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
    UNDECIDED: ("", "undecided: see field status", "#e6007e"),
}
CODES = {name.replace("−", "-"): code for code, (name, _, _) in REGIONS.items() if name}
LAST_SAFE = 2  # the largest code of a safe block
LEFT_STANDING = 6  # the largest code of a block that does not fall during the ground motion


def coloured(codes):
    """Returns codes as RGBA; points not computed are transparent and show the hatch below."""
    table = np.zeros((256, 4), np.uint8)
    for code, (_, _, colour) in REGIONS.items():
        table[code] = [round(255 * part) for part in matplotlib.colors.to_rgba(colour)]
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
    if NOT_COMPUTED in codes:
        entries.append(Patch(facecolor="white", edgecolor="0.6", hatch="////", linewidth=0.5,
                             label="not computed yet"))
    return entries
