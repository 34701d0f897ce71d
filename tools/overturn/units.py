"""Quantities in the units of the job, or in seconds, degrees, metres and g: the axes of a plane, and what a file stores
of a motion."""

import numpy as np
from overturn.captions import escaped, is_linear, is_recorded, names_of
from overturn.motion_words import worded
from overturn.spectrum_planes import COUNTED, JOB, LOG, PHYSICAL, Axis, scanned_quantity
from overturn.tables import QUANTITIES, STRENGTHS
from overturn.tool import USAGE, ToolError

LABELS = {"frequency": r"pulse frequency  $\omega_p\,/\,p$",
          "amplitude": r"pulse amplitude  $a_p\,/\,(g\,{threshold})$",
          "pulse_period": "pulse period [s]",
          "pulse_frequency": "pulse frequency [Hz]",
          "scale": "scale of the record",
          "pga": "PGA [g]",
          "size": r"size  $R$ [m]",
          "frequency_parameter": r"$p$ [1/s]",
          "slenderness": r"slenderness  $\alpha$ [rad]",
          "restitution": "restitution  $r$",
          "velocity_restitution": "velocity restitution  $e$",
          "restitution_of_maximum": r"restitution  $r\,/\,r_{max}$"}
# What files give as multiples of powers of an angle [rad], of p and of R.
POWERS = {"time": (0, -1, 0), "fall_time": (0, -1, 0), "angle": (1, 0, 0), "velocity": (1, 1, 0),
          "acceleration": (1, 2, 0), "q": (2, 2, 0), "slide": (0, 0, 1), "slide_peak": (0, 0, 1),
          "slide_velocity": (0, 1, 1)}
# Units of what files give as multiples of them.
MULTIPLES = {"pga": "g", "record_pga": "g", "pga_rotd50": "g", "pga_rotd100": "g", "ground_pga": "g", "flip_pga": "g",
             "ground": "g", "force_along": "weight", "force_normal": "weight"}
NEEDING_A_SIZE = {"pulse_period", "pulse_frequency", "pga"}  # under a pulse


PLANE_IN_PHYSICAL_UNITS = ("pulse period in s, on a logarithmic axis if the job gives dimensionless "
                           "frequencies; PGA in g, slenderness in degrees")


def add_units_argument(parser, physical=PLANE_IN_PHYSICAL_UNITS):
    """`physical` describes the physical units."""
    parser.add_argument("--units", choices=(JOB, PHYSICAL), default=JOB,
                        help=f"physical: {physical}; the job must give the size of the block. Axes "
                             "that are already physical are kept (default: job)")


def expect_size(file, units):
    """Raises an error if the units are unknown, or need a size of the block that the job does not give."""
    if units not in (JOB, PHYSICAL):
        raise ToolError(f"units = {units!r} is neither {JOB!r} nor {PHYSICAL!r}.")
    if units == PHYSICAL and not is_recorded(file) and not {"size", "frequency_parameter"} & {*file, *file.attrs}:
        if "flip_value" in file:
            raise ToolError(f"\"{file.filename}\" cannot be given in physical units, because the size of the block varies "
                            f"along {scanned_quantity(file)}. Use the units of the job.")
        raise ToolError(f"\"{file.filename}\" cannot be given in physical units, because its job does "
                        "not give the size of the block. Add [block] with width and height to the "
                        "job, or the half diagonal plane.size, in metres, and compute it again.")


def size_of(file):
    """Returns the name of the size R by which lengths are divided: of a block with two sides, that of the side plus."""
    return "size" if "size" in {*file, *file.attrs} else "size_plus"


def factor_of(powers, angle, frequency, length):
    """Returns the factor of a quantity with these POWERS, of which each is a value of the unit in the file."""
    return angle**powers[0] * frequency**powers[1] * length**powers[2]


def is_own_column(file, name):
    """Whether a variable is a column of a table of blocks that is no quantity of overturn."""
    return file[name].attrs.get("long_name") == "column of the table" and name not in QUANTITIES


def powers_of(file, name):
    """Returns the POWERS of a variable; angles of any name are in rad."""
    if is_own_column(file, name):
        return 0, 0, 0
    return POWERS.get(name, (int(file[name].attrs.get("units") == "rad"), 0, 0))


def unit_of(file, name, units):
    """Returns the unit of a variable; "1" if it has none, or is unknown."""
    powers = powers_of(file, name)
    if units == JOB or not any(powers):
        unit = file[name].attrs.get("units", "1")
        return unit if is_own_column(file, name) else MULTIPLES.get(name, unit)
    each = zip(("degree", "m", "s"), (powers[0], powers[2], -powers[1]))
    return " ".join(unit + str(power) * (power != 1) for unit, power in each if power)


def physical(file, name, values, property_of):
    """Returns values of a variable in physical units; property_of(name) returns those of a property of the block at the
    same points."""
    powers = powers_of(file, name)
    if not any(powers):
        return values
    return values * factor_of(powers, np.degrees(1), property_of("frequency_parameter") if powers[1] else 1,
                              property_of(size_of(file)) if powers[2] else 1)


def label_of(file, quantity):
    """Returns the label of an axis."""
    if quantity not in file and quantity in QUANTITIES and quantity not in LABELS:  # of flips
        units = QUANTITIES[quantity][0]
        return escaped(quantity.replace("_", " ")) + f" [{units}]" * (units != "")
    if quantity not in LABELS:
        attributes = file[quantity].attrs
        units = attributes.get("units", "1")
        return escaped(attributes.get("long_name", quantity)) + f" [{units}]" * (units != "1")
    label = LABELS[quantity].replace("{threshold}", r"\alpha" if is_linear(file) else r"\tan\,\alpha")
    return worded(file.attrs, label)


def name_axes(plane, units=JOB):
    """Returns the labels of the horizontal and the vertical axis. Names of blocks or records need no further words."""
    named = {"block": "block", "motion": "record"}
    return tuple("" if name is None else named[name] if name in named and axis_of(plane, name, name).names
                 else label_of(plane.file, name) for name in plane.quantities(units))


def axis_of(plane, quantity, dimension, is_to_scale=False):
    """Returns the cells of an axis. Periods of evenly spaced frequencies are neither evenly spaced nor
    geometric; a logarithmic axis leaves room for the short and the long ones. A plane of one dimension has nothing
    along its horizontal axis."""
    if quantity is None:
        return Axis(np.zeros(1), names=[""])
    is_converted = quantity == "pulse_period" and quantity != dimension
    names = names_of(plane.file, quantity)
    values = plane.values(quantity, dimension)
    return Axis(values, LOG if is_converted else None, are_counted=quantity in COUNTED, is_to_scale=is_to_scale,
                names=names and [names[number] for number in values])


def axes_of_plane(plane, units=JOB, is_to_scale=False):
    """Returns the horizontal and the vertical axis."""
    return tuple(axis_of(plane, quantity, dimension, is_to_scale)
                 for quantity, dimension in zip(plane.quantities(units), (plane.across, plane.up)))


def uplift_threshold(file, slenderness):
    """Returns the ground acceleration over g that lifts a block of this slenderness [rad]."""
    return slenderness if is_linear(file) else np.tan(slenderness)


def scan_of(plane, quantity):
    """Returns the values of a quantity at which a boundary was scanned."""
    file = plane.file
    scanned = scanned_quantity(file)
    scan = file.run[f"scan_{scanned}"][:]
    if quantity == scanned:
        return scan
    name = "record_pga" if is_recorded(file) else "slenderness"
    value = plane.value(name)
    if value is None:
        raise ToolError(f"\"{file.filename}\" cannot be drawn over {quantity}, because {name} varies along "
                        f"{plane.across}. Draw it in the units of the job.", USAGE)
    return scan * (value if is_recorded(file) else uplift_threshold(file, value))


def name_of_flips(quantity):
    """Returns the field with the flips of a boundary in this quantity."""
    if quantity not in STRENGTHS:
        return "flip_value"
    return "flip_pga" if quantity == "pga" else "flip_amplitude"
