"""The boundary drawn on a spectrum: the flips of the same blocks under the same ground motion."""

import re

import numpy as np
from overturn.captions import PULSE_NUMBERS, ground_word, is_recorded
from overturn.fields import read_field
from overturn.result_file import PlotError, job_text, open_result, text_attribute
from overturn.units import (NEEDING_A_SIZE, PHYSICAL, RECIPROCALS, axis_of, expect_size,
                            name_of_flips, quantities, values_of)


def checksums_of_records(file):
    return re.findall(r'\bchecksum = "(\w+)"', job_text(file, "job_resolved"))


def expect_same_motion(file, spectrum):
    if is_recorded(file) != is_recorded(spectrum):
        raise PlotError(f"\"{file.filename}\" is a boundary under a {ground_word(file)}, but the "
                        f"spectrum is one under a {ground_word(spectrum)}. Omit --boundary.")
    if is_recorded(file) and checksums_of_records(file) != checksums_of_records(spectrum):
        raise PlotError(f"\"{file.filename}\" was computed under different records from the spectrum.")


def expect_same_settings(file, spectrum, names):
    for name in names:
        here, there = (text_attribute(each, name) or "none" for each in (file, spectrum))
        if here != there:
            raise PlotError(f"\"{file.filename}\" has {name} {here}, but the spectrum has {there}.")


def expect_overlap(file, spectrum, across):
    values = values_of(file, across, ())
    first, last = axis_of(spectrum, across, ()).limits()
    if not ((values >= first) & (values <= last)).any():
        raise PlotError(f"\"{file.filename}\" covers {across} from {values.min():g} to "
                        f"{values.max():g}, the spectrum only from {first:g} to {last:g}.")


def open_boundary(path, spectrum, units):
    """Opens the boundary file if it has the same blocks and ground motion as the spectrum. Its axes may differ:
    its flips are converted to the quantities on the axes of the spectrum."""
    file = open_result(path, "overturning boundary", "a boundary written by overturn boundary")
    expect_same_motion(file, spectrum)
    shown = quantities(spectrum, units)
    if NEEDING_A_SIZE.intersection(shown):
        expect_size(file, PHYSICAL)
    # Over the frequency, boundaries of small and large blocks are the same; in s and Hz they are not.
    sizes = ("half_diagonal", "gravity") if shown[0] in RECIPROCALS else ()
    gravity = ("gravity",) if is_recorded(file) else ()
    expect_same_settings(file, spectrum, ("pulse", "theory", *PULSE_NUMBERS, *sizes, *gravity))
    for name in ("slenderness", "restitution_ratio"):
        if not np.array_equal(file[name][:], spectrum[name][:]):
            raise PlotError(f"\"{path}\" has different blocks from the spectrum: {name} differs.")
    expect_overlap(file, spectrum, shown[0])
    return file


def draw_boundary(panel, boundary, outer, shown):
    """Draws a dot per flip with a halo, visible on light and dark; `shown` are the quantities on the
    axes. Changes next to an undecided region are not drawn."""
    across, up = shown
    sides = [read_field(boundary, name, outer) for name in ("region_below", "region_above")]
    settled = (np.maximum(*sides) <= 8)  # F-
    flips = np.where(settled, read_field(boundary, name_of_flips(up), outer), np.nan)
    columns = np.broadcast_to(values_of(boundary, across, outer), flips.shape)
    for size, colour in ((2.6, "white"), (1.2, "black")):
        panel.plot(columns.ravel(), flips.ravel(), linestyle="none", marker="o",
                   markeredgewidth=0, markersize=size, color=colour)
