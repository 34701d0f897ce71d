"""Reading of overturning spectra by the tools: the planes of a file, cell by cell."""

import numpy as np

from overturn.fields import count_tiles, read_field
from overturn.result_file import USAGE, PlotError, open_result, text_attribute

PULSES = {"symmetric_ricker": "symmetric Ricker wavelet",
          "antisymmetric_ricker": "antisymmetric Ricker wavelet"}


def open_spectrum(path, fields=("region",)):
    """Opens a spectrum that has the given fields."""
    file = open_result(path, "overturning spectrum", "a spectrum written by overturn run")
    for field in fields:
        if field not in file:
            raise PlotError(f"\"{path}\": this file has no field {field}; add it to output.fields.")
    return file


def add_choice_arguments(parser):
    for name in ("slenderness", "restitution"):
        parser.add_argument(f"--{name}", type=int, metavar="I",
                            help=f"use only the {name} with index I, counted from 0")


def chosen(file, name, index):
    """Returns the indices to use along one axis: the requested one, or all."""
    count = len(file[name])
    if index is None:
        return list(range(count))
    if not 0 <= index < count:
        first, last = file[name][0], file[name][-1]
        raise PlotError(f"--{name} {index} is out of range; this file has 0 to {count - 1} "
                        f"({name} {first:g} to {last:g}).", USAGE)
    return [index]


def refuse_more_than(most, slendernesses, restitutions):
    """Raises an error if there are more than `most` spectra."""
    count = len(slendernesses) * len(restitutions)
    if count <= most:
        return
    choices = [f"--{name} (0 to {indices[-1]})" for name, indices in
               (("slenderness", slendernesses), ("restitution", restitutions)) if len(indices) > 1]
    raise PlotError(f"there are {count} spectra, but the output is limited to {most}; choose with "
                    f"{' or '.join(choices)}.", USAGE)


def are_geometric(values):
    """Whether steps are equal in the logarithm, not in the values; rounding is far below 1e-6."""
    def unevenness(steps):
        return np.ptp(steps) / np.mean(steps)
    return (len(values) > 2 and values[0] > 0
            and unevenness(np.diff(np.log(values))) < 1e-6 < unevenness(np.diff(values)))


class Axis:
    """The cells of one axis; each extends to the midpoints between its value and its neighbours.

    Midpoints are computed on the scale of the axis, which is logarithmic for geometric values.
    """

    def __init__(self, values):
        self.scale = "log" if are_geometric(values) else "linear"
        shown = self.shown(values)
        inner = (shown[1:] + shown[:-1]) / 2
        if len(values) == 1:
            first, last = shown[0] - 0.5, shown[0] + 0.5
        else:
            first, last = 2 * shown[0] - inner[0], 2 * shown[-1] - inner[-1]
        self.edges = np.concatenate([[first], inner, [last]])

    def shown(self, values):
        return np.log(values) if self.scale == "log" else values

    def limits(self):
        ends = self.edges[[0, -1]]
        return np.exp(ends) if self.scale == "log" else ends

    def share(self, values):
        """Returns the positions of values along the axis, from 0 to 1."""
        return (self.shown(values) - self.edges[0]) / (self.edges[-1] - self.edges[0])

    def cells(self, pixels):
        """Returns the cell under the centre of each pixel."""
        width = (self.edges[-1] - self.edges[0]) / pixels
        middles = self.edges[0] + width * (np.arange(pixels) + 0.5)
        return np.searchsorted(self.edges[1:-1], middles)


def axes_of_plane(file):
    """Returns the horizontal and the vertical axis."""
    return Axis(file["frequency"][:]), Axis(file["amplitude"][:])


def rows_of_tiles(field):
    """Returns slices of rows to be read one at a time, because a plane may not fit in memory."""
    height = field.chunks[-2] if field.chunks else 64
    return [slice(first, first + height) for first in range(0, field.shape[-2], height)]


def read_cells(file, name, pair, rows, columns):
    """Reads a field at given rows and columns."""
    values = np.empty((len(rows), len(columns)), file[name].dtype)
    for tiles in rows_of_tiles(file[name]):
        wanted = (rows >= tiles.start) & (rows < tiles.stop)
        if wanted.any():
            block = read_field(file, name, pair, tiles)
            values[wanted] = block[np.ix_(rows[wanted] - tiles.start, columns)]
    return values


def name_axes(file):
    """Returns the labels of frequency and amplitude."""
    tangent = r"\alpha" if is_linear(file) else r"\tan\,\alpha"
    return r"pulse frequency  $\omega_p\,/\,p$", rf"pulse amplitude  $a_p\,/\,(g\,{tangent})$"


def is_linear(file):
    return text_attribute(file, "theory") == "linear"


def block_text(file, slenderness, restitution):
    r = file["restitution_ratio"][slenderness, restitution]
    share = ""
    if text_attribute(file["restitution"], "of") == "maximum":
        value = file["restitution"][restitution]
        share = " = r_max" if value == 1 else f" = {value:g} r_max"
    return f"α = {file['slenderness'][slenderness]:.4g} rad,  r{share} = {r:.4g}"


def subtitle(file, pairs):
    """Returns pulse, theory, the block if there is only one, and a note on missing tiles."""
    pulse = text_attribute(file, "pulse")
    words = [PULSES.get(pulse, pulse.replace("_", "-") + " pulse")]
    if "window" in file.attrs:
        words.append(f"window {float(file.attrs['window']):g}")
    if is_linear(file):
        words.append("linear theory")
    if len(pairs) == 1:
        words.append(block_text(file, *pairs[0]))
    done, tiles = count_tiles(file)
    if done < tiles:
        words.append(f"unfinished: {done} of {tiles} tiles computed")
    return ",  ".join(words)
