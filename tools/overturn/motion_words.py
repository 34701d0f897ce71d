"""Words for what shakes the blocks: the ground, or a floor of a building. Both motions have the same quantities, but
different names for them. Texts are written for the ground.

`attributes` are those of a result, of which motion_of is "floor" or absent."""

import re

FLOOR = "floor"
OF_FLOOR = {"ground": "floor", "PGA": "PFA", "PGV": "PFV", "u_g": "u_f"}
# Measures of the motion of a floor, and the variables of a result that contain them.
FLOOR_MEASURES = {"pfa": "pga", "pfv": "pgv", "floor_arias_intensity": "arias_intensity",
                  "floor_significant_duration": "significant_duration",
                  "pfa_rotd50": "pga_rotd50", "pfa_rotd100": "pga_rotd100", "pfv_rotd50": "pgv_rotd50",
                  "pfv_rotd100": "pgv_rotd100"}
# Names of variables in texts that have no attributes, such as tables of comma-separated values.
COLUMNS = {"pga": "pfa", "record_pga": "record_pfa", "pgv": "pfv", "flip_pga": "flip_pfa", "ground": "floor",
           "ground_before": "floor_before", "ground_after": "floor_after",
           **{variable: measure for measure, variable in FLOOR_MEASURES.items() if "_rotd" in measure}}
VARIABLES = {column: variable for variable, column in COLUMNS.items()}
_OF_GROUND = "ground_"  # begins the variables of the ground in a result under motions of a floor


def is_of_floor(attributes):
    return attributes.get("motion_of") == FLOOR


def worded(attributes, about_the_ground):
    """Returns a text of this package about the motion of the ground in the words for the motion of a result."""
    if not is_of_floor(attributes):
        return about_the_ground
    return re.sub("|".join(OF_FLOOR), lambda found: OF_FLOOR[found[0]], about_the_ground)


def column_named(attributes, variable):
    """Returns the name of the column of a variable."""
    return COLUMNS.get(variable, variable) if is_of_floor(attributes) else variable


def measure_named(attributes, variable):
    """Returns the name of the intensity measure in a variable. Under motions of a floor, pga is the PFA, and ground_pga
    the PGA."""
    if not is_of_floor(attributes):
        return variable
    names = {variable: measure for measure, variable in FLOOR_MEASURES.items()}
    return names.get(variable, variable.removeprefix(_OF_GROUND))


def variable_of(attributes, measure):
    """Returns the variable of an intensity measure, which may also be given by the name of the variable."""
    return FLOOR_MEASURES.get(measure, measure) if is_of_floor(attributes) else measure


def variable_of_ground(attributes, measure):
    """The same for a measure of the ground, such as that of a hazard curve."""
    is_of_ground = is_of_floor(attributes) and measure not in FLOOR_MEASURES
    return _OF_GROUND + measure if is_of_ground else measure
