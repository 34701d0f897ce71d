"""What the colours of a spectrum show: the regions, the verdicts, or the values of a field."""

import numpy as np
from matplotlib import colormaps, colors
from matplotlib.patches import Patch
from overturn.regions import (APART, NOTHING, STANDS, TOPPLES, UNDECIDED, VERDICT_OF, VERDICTS, coloured, hatched_entries,
                              legend_entries, patch)
from overturn.spectrum_planes import LINEAR, LOG, Axis
from overturn.tool import USAGE, ToolError
from overturn.units import label_of

WIDE = 1e3  # ratio of positive values above which their scale is logarithmic, but for LEVELS
MOST_LINES = 6  # curves in a panel
VALUE, INFINITE = 250, 249  # codes of pixels with a value, and with an infinite one
INFINITE_COLOUR = "black"
# The code whose colour infinite values of a field have, if these state a verdict, or that something is unknown.
MEANINGS = {"peak": TOPPLES, "fall_time": STANDS, "error": UNDECIDED}
# Values are lighter than what topples; of values with a sign, the negative ones are red, as negative margins.
LEVELS = {"peak": (1, "|θ| = α: balance on an edge")}  # values that mean something
UNSIGNED = colors.LinearSegmentedColormap.from_list("values", colormaps["YlGnBu"](np.linspace(0, 0.62, 256)))
SIGNED = colormaps["RdBu"]


def share_text(count, total):
    """Returns a share in per cent, with as many digits as needed so that it is 0 or 100 only of none or all."""
    share = 100 * count / total
    return next(f"{share:.{digits}f} %" for digits in range(18)
                if count in (0, total) or 0 < float(f"{share:.{digits}f}") < 100)


class Regions:
    FIELDS = ()  # that it needs beside the region

    def add(self, planes):
        """Reads what is common to the pictures of some planes."""

    def lines(self, plane):
        """Returns the planes of one dimension that are drawn as curves in place of an image."""
        return []

    def picture(self, plane, codes, up, across):
        """Returns the codes that a picture of a plane with these region codes shows, and its RGBA."""
        return codes, coloured(codes)

    def legend(self, codes, ground):
        """Returns the entries and the title; `ground` is a word for the ground motion."""
        return legend_entries(codes, ground), f"At the end of the {ground}\n(+ and − are the side it moves to)"


class Verdicts(Regions):
    def picture(self, plane, codes, up, across):
        return super().picture(plane, VERDICT_OF[codes], up, across)

    def add(self, planes):
        """Counts the points of each verdict."""
        counts = sum(np.bincount(VERDICT_OF[plane.read("region", rows)].ravel(), minlength=256)
                     for plane in planes for rows in plane.tiles())
        self.shares = {code: share_text(int(counts[code]), int(counts.sum())) for code in VERDICTS}

    def legend(self, codes, ground):
        return [patch(code, f"{name}  {self.shares[code]}") for code, name in VERDICTS.items()], "Share of the points"


class Field(Regions):
    """The values of a field at the points in the middle of the pixels. A pixel without a value there, or which hides a point
    with a worse verdict, has the colour of the verdict."""

    def __init__(self, name):
        self.name, self.FIELDS, self.infinite = name, (name,), MEANINGS.get(name, INFINITE)

    def add(self, planes):
        file = planes[0].file
        if {*file[self.name].dimensions} != {*file.dimensions} or file[self.name].attrs.get("units", "") == "":
            raise ToolError(f"{self.name} is no field with values, such as peak. Choose one that overturn keys output.fields "
                            "lists, other than region and status.", USAGE)
        self.label = label_of(file, self.name)
        extremes = []
        for plane in planes:
            for rows in plane.tiles():
                known = self._known(plane.read(self.name, rows), plane.read("region", rows), file)
                finite = known[np.isfinite(known)]
                extremes += [finite.min(), finite.max()] if finite.size else []
        low, high = min(extremes, default=0.0), max(extremes, default=1.0)
        if low == high:
            low, high = low - 0.5, high + 0.5
        scale = LOG if low > 0 and high / low > WIDE and self.name not in LEVELS else LINEAR
        #: vertical, of lines
        self.axis = Axis(np.array([0, max(high, LEVELS[self.name][0])] if self.name in LEVELS else [low, high]), scale,
                         is_to_scale=True)
        # Of a field with a sign, 0 is in the middle, and the values beyond the smaller extreme have one colour.
        reach = min(-low, high) if high > 0 else -low
        self.norm = (colors.LogNorm(low, high) if scale == LOG else
                     colors.Normalize(-reach, reach) if low < 0 else colors.Normalize(low, high))
        self.colours = SIGNED if low < 0 else UNSIGNED
        self.extend = {(True, False): "min", (False, True): "max"}.get((low < self.norm.vmin, high > self.norm.vmax), "neither")

    def _known(self, values, region, file):
        """Returns values, NaN where the verdict is unknown; flags of counts state more than can be counted."""
        flags = file[self.name].attrs.get("flag_values", ())
        return np.where(VERDICT_OF[region] == UNDECIDED, np.nan, np.where(np.isin(values, flags), np.inf, values))

    def lines(self, plane):
        return plane.lines(MOST_LINES)

    def line(self, plane, up):
        """Returns the values of the only axis in ascending order, and those of the field, NaN where none is finite."""
        known = self._known(plane.read(self.name), plane.read("region"), plane.file)[:, 0]
        return up.values, np.where(np.isfinite(known), known, np.nan)[::-1 if up.descends else 1]

    def picture(self, plane, codes, up, across):
        cells = up.cells(len(codes)), across.cells(len(codes))
        region = plane.read_cells("region", *cells)
        values = self._known(plane.read_cells(self.name, *cells), region, plane.file)
        shown = np.where(np.isin(codes, [*NOTHING, APART]), codes, VERDICT_OF[codes])
        has_value = (shown == VERDICT_OF[region]) & (shown != UNDECIDED)
        shown[has_value] = np.select([np.isnan(values), np.isinf(values)], [UNDECIDED, self.infinite], VALUE)[has_value]
        picture = coloured(shown)
        picture[shown == INFINITE] = colors.to_rgba_array(INFINITE_COLOUR) * 255
        is_value = shown == VALUE
        picture[is_value] = self.colours(self.norm(values[is_value]), bytes=True)
        return shown, picture

    def verdicts(self, plane, codes, up, across):
        """Returns codes and RGBA of the same picture with the verdict on each value."""
        shown, picture = self.picture(plane, codes, up, across)
        is_value = shown == VALUE
        shown[is_value] = VERDICT_OF[codes[is_value]]
        picture[is_value] = coloured(shown[is_value])
        return shown, picture

    def legend(self, codes, ground):
        entries = [patch(code, name) for code, name in VERDICTS.items() if code in codes]
        entries += [Patch(facecolor=INFINITE_COLOUR, label="infinite")] * (INFINITE in codes)
        return entries + hatched_entries(codes), None
