"""The boundary drawn on a spectrum: the flips of the same blocks under the same ground motion."""

import contextlib
import re

import numpy as np
from overturn.captions import PULSE_NUMBERS, ground_word, is_recorded
from overturn.choice import axes_of
from overturn.regions import SAFE, UNSAFE
from overturn.result_file import BOUNDARY, open_result
from overturn.spectrum_planes import PHYSICAL, RECIPROCALS, Plane, scanned_quantity
from overturn.tool import ToolError
from overturn.units import NEEDING_A_SIZE, axis_of, expect_size, name_of_flips


def checksums_of_records(file):
    return re.findall(r'\bchecksum = "(\w+)"', file.job_text("job_resolved"))


def expect_same_motion(file, spectrum):
    if is_recorded(file) != is_recorded(spectrum):
        raise ToolError(f"\"{file.filename}\" is a boundary under a {ground_word(file)}, but the "
                        f"spectrum is one under a {ground_word(spectrum)}. Omit --boundary.")
    if is_recorded(spectrum) and not spectrum.run:
        raise ToolError("the data set does not tell which records it is of. Draw the boundary on the spectrum of the file.")
    if is_recorded(file) and checksums_of_records(file) != checksums_of_records(spectrum):
        raise ToolError(f"\"{file.filename}\" was computed under different records from the spectrum.")


def expect_equal(file, spectrum, name, here, there):
    if here != there:
        raise ToolError(f"\"{file.filename}\" has {name} {here or 'none'}, but the spectrum has {there or 'none'}.")


def expect_overlap(boundary, plane, across):
    values = boundary.values(across, boundary.across)
    first, last = axis_of(plane, across, plane.across, is_to_scale=True).limits()
    if not ((values >= first) & (values <= last)).any():
        raise ToolError(f"\"{boundary.file.filename}\" covers {across} from {values.min():g} to "
                        f"{values.max():g}, the spectrum only from {first:g} to {last:g}.")


@contextlib.contextmanager
def open_boundary(path, plane, units):
    """Opens the boundary file, if any is given, if it has the same ground motion as the spectrum. Its axes may differ: its
    flips are converted to the quantities on the axes of the spectrum."""
    if not path:
        yield None
        return
    spectrum = plane.file
    if plane.across is None:
        raise ToolError(f"\"{spectrum.filename}\" has one axis, but a boundary is drawn over two. Omit --boundary.")
    with open_result(path, BOUNDARY) as file:
        if "flip_value" in file:
            raise ToolError(f"\"{file.filename}\" has flips along {scanned_quantity(file)}, but those along the strength are "
                            "drawn on a spectrum. Draw it with plot_boundary.")
        expect_same_motion(file, spectrum)
        if NEEDING_A_SIZE.intersection(plane.quantities(units)):
            expect_size(file, PHYSICAL)
        for name in ("pulse", "theory", "motion_of", *PULSE_NUMBERS):
            expect_equal(file, spectrum, name, file.text(name), spectrum.text(name))
        if is_recorded(file) or plane.quantities(units)[0] in RECIPROCALS:
            expect_equal(file, spectrum, "gravity", file.text("gravity"), spectrum.text("gravity"))
        yield file


def boundary_on(file, plane, units):
    """Returns the plane of the boundary of the same block as a plane of a spectrum."""
    across = axes_of(file, plane.index)[0]
    missing = {name for name, size in file.sizes.items() if name in file.dimensions and size > 1} - {
        across, "crossing", *plane.index}
    if missing or across is None:
        raise ToolError(f"\"{file.filename}\" is not along the axes of the spectrum.")
    boundary = Plane(file, {name: plane.index.get(name, 0) for name in file.dimensions
                            if name not in (across, "crossing")}, across, "crossing")
    # Over the frequency, boundaries of small and large blocks are the same; in s and Hz they are not.
    shown = plane.quantities(units)[0]
    sides = ("slenderness_plus", "slenderness_minus", "size_plus", "size_minus", "frequency_parameter_minus")
    for name in ("slenderness", "restitution", *["size"] * (shown in RECIPROCALS), *sides, "direction"):
        default = 0 if name == "direction" else None
        if (boundary.value(name) or default) != (plane.value(name) or default):
            raise ToolError(f"\"{file.filename}\" has different blocks from the spectrum: {name} differs.")
    expect_overlap(boundary, plane, shown)
    return boundary


def draw_boundary(panel, file, plane, units):
    """Draws a dot per flip with a halo, visible on light and dark. Changes next to an undecided region are not
    drawn."""
    boundary = boundary_on(file, plane, units)
    across, up = plane.quantities(units)
    sides = [boundary.read(name) for name in ("region_below", "region_above")]
    settled = np.isin(sides, SAFE + UNSAFE).all(axis=0)
    flips = np.where(settled, boundary.read(name_of_flips(up)), np.nan)
    columns = np.broadcast_to(boundary.values(across, boundary.across), flips.shape)
    for size, colour in ((2.6, "white"), (1.2, "black")):
        panel.plot(columns.ravel(), flips.ravel(), linestyle="none", marker="o",
                   markeredgewidth=0, markersize=size, color=colour)
