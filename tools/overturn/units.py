"""The quantities on the axes of a plane: their names, values and labels, in the units of the job or
in seconds and g. An index `outer` is that of one spectrum."""

import numpy as np
from overturn.captions import JOB, PHYSICAL, is_linear, is_recorded, scales_records
from overturn.fields import dimensions_of, slenderness_and_restitution
from overturn.result_file import PlotError, run_data
from overturn.spectrum_file import Axis

LABELS = {"frequency": r"pulse frequency  $\omega_p\,/\,p$",
          "amplitude": r"pulse amplitude  $a_p\,/\,(g\,{threshold})$",
          "pulse_period": "pulse period [s]",
          "pulse_frequency": "pulse frequency [Hz]",
          "scale": "scale of the record",
          "pga": "PGA [g]",
          "size": r"size  $R$ [m]",
          "frequency_parameter": r"$p$ [1/s]"}
EQUIVALENTS = {"frequency": "pulse_period", "amplitude": "pga", "scale": "pga"}
NEEDING_A_SIZE = {"pulse_period", "pulse_frequency", "pga"}  # under a pulse
RECIPROCALS = {"pulse_period": "pulse_frequency", "pulse_frequency": "pulse_period"}


PLANE_IN_PHYSICAL_UNITS = ("pulse period in s, on a logarithmic axis if the job gives dimensionless "
                           "frequencies; PGA in g, slenderness in degrees")


def add_units_argument(parser, physical=PLANE_IN_PHYSICAL_UNITS):
    """`physical` describes the physical units."""
    parser.add_argument("--units", choices=(JOB, PHYSICAL), default=JOB,
                        help=f"physical: {physical}; the job must give the size of the block. Axes "
                             "that are already physical are kept (default: job)")


def expect_size(file, units):
    """Raises an error if physical units need a size of the block that the job does not give."""
    if units == PHYSICAL and not is_recorded(file) and "half_diagonal" not in file.attrs:
        raise PlotError(f"\"{file.filename}\" cannot be drawn in physical units, because its job does "
                        "not give the size of the block. Add [block] with width and height to the "
                        "job, or the half diagonal plane.size, in metres, and compute it again.")


def scanned_quantity(file):
    """Returns the name of the axis of the job along which a boundary was scanned."""
    return next(name for name in ("amplitude", "scale", "pga") if f"scan_{name}" in run_data(file))


def quantities(file, units=JOB):
    """Returns the quantities on the horizontal and the vertical axis; vertical ones of a boundary are
    those of its flips."""
    up, across = dimensions_of(file)[-2:]
    if up == "crossing":
        up = scanned_quantity(file)
    shown = EQUIVALENTS if units == PHYSICAL else {}
    return tuple(shown.get(name, name) for name in (across, up))


def name_axes(file, units=JOB):
    """Returns the labels of the horizontal and the vertical axis."""
    threshold = r"\alpha" if is_linear(file) else r"\tan\,\alpha"
    return tuple(LABELS[name].replace("{threshold}", threshold)
                 for name in quantities(file, units))


def values_of(file, quantity, outer):
    """Returns the values of a quantity along its axis."""
    if quantity == "pga" and scales_records(file):
        quantity = "scaled_pga"
    if quantity not in file and RECIPROCALS.get(quantity, quantity) in file:
        return 1 / file[RECIPROCALS[quantity]][:]
    values = file[quantity][:]
    if values.ndim == 1:
        return values
    by = "motion" if is_recorded(file) else "slenderness"
    return values[outer[dimensions_of(file).index(by)]]


def axis_of(file, quantity, outer):
    """Returns the cells of an axis. Periods of evenly spaced frequencies are neither evenly spaced nor
    geometric; a logarithmic axis leaves room for the short and the long ones."""
    is_converted = quantity == "pulse_period" and quantity not in dimensions_of(file)
    return Axis(values_of(file, quantity, outer), "log" if is_converted else None)


def axes_of_plane(file, outer, units=JOB):
    """Returns the horizontal and the vertical axis."""
    return tuple(axis_of(file, quantity, outer) for quantity in quantities(file, units))


def uplift_threshold(file, slenderness):
    """Returns the ground acceleration over g that lifts a block of this slenderness [rad]."""
    return slenderness if is_linear(file) else np.tan(slenderness)


def scan_of(file, quantity, outer):
    """Returns the values of a quantity at which a boundary was scanned."""
    scanned = scanned_quantity(file)
    scan = run_data(file)[f"scan_{scanned}"][:]
    if quantity == scanned:
        return scan
    if is_recorded(file):
        return scan * file["pga"][outer[dimensions_of(file).index("motion")]]
    return scan * uplift_threshold(file, slenderness_and_restitution(file, outer)[0])


def name_of_flips(quantity):
    """Returns the field with the flips of a boundary in this quantity."""
    return "flip_pga" if quantity == "pga" else "flip_amplitude"
