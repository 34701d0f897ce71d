"""Choice of the planes of a file to show: an option per dimension gives an index."""

import argparse
import math

import numpy as np
from overturn.captions import value_text
from overturn.spectrum_planes import Plane
from overturn.tables import STRENGTHS
from overturn.tool import USAGE, ToolError

MOST_COLUMNS = 10  # of a sheet
OPTIONS = ("motion", "slenderness", "restitution")


def dimension_and_index(words):
    name, _, number = words.partition("=")
    if not name or not number.removeprefix("-").isdigit():
        raise argparse.ArgumentTypeError(f"\"{words}\" is not of the form height=0")
    return name, int(number)


def add_choice_arguments(parser):
    for name in OPTIONS:
        only = " (files of records only)" if name == "motion" else ""
        parser.add_argument(f"--{name}", type=int, metavar="INDEX",
                            help=f"use only the {name} with this index, counted from 0{only}")
    parser.add_argument("--index", type=dimension_and_index, action="append", default=[], metavar="DIMENSION=INDEX",
                        help="the same for any dimension of the file, such as height=0; repeatable")


def add_title_argument(parser):
    parser.add_argument("--title", help="title of the picture (default: the job's title, or the "
                                        "names of its records)")


def option_of(dimension):
    name = dimension.removesuffix("_of_maximum").removeprefix("velocity_")
    return f"--{name}" if name in OPTIONS else f"--index {dimension}=INDEX"


def chosen(file, arguments):
    """Returns the chosen index of each dimension that has one."""
    options = [(f"--{name}", name, getattr(arguments, name)) for name in OPTIONS
               if getattr(arguments, name, None) is not None]
    options += [(f"--index {name}", name, index) for name, index in arguments.index]
    choices = {}
    for option, name, index in options:
        if name == "restitution" and name not in file.dimensions:
            name = "velocity_restitution" if "velocity_restitution" in file.dimensions else "restitution_of_maximum"
        if name not in file.dimensions or name == "crossing":
            raise ToolError(f"{option}: \"{file.filename}\" has no dimension {name}, only "
                            f"{', '.join(file.dimensions) or 'a single point'}.", USAGE)
        count = file.sizes[name]
        if not 0 <= index < count:
            first, last = value_text(file, name, 0), value_text(file, name, count - 1)
            raise ToolError(f"{option} {index} is out of range; this file has 0 to {count - 1} "
                            f"({name} {first} to {last}).", USAGE)
        if choices.setdefault(name, index) != index:
            raise ToolError(f"{option} {index}: {name} is given twice, before as {choices[name]}.", USAGE)
    return choices


def axes_of(file, choices):
    """Returns the dimensions along the horizontal and the vertical axis: the last two of several values without a
    chosen index. If there are too few, they are of one value, or numbers of motions; an only one is vertical."""
    free = [name for name in file.dimensions if name not in choices and name != "crossing"]
    axes = sorted(free, key=lambda name: (file.sizes[name] > 1 and name != "motion", free.index(name)))
    if "crossing" in file.dimensions:
        return axes[-1] if axes else None, "crossing"
    if not axes:
        raise ToolError(f"this choice of \"{file.filename}\" is a single point. Give axes in the job, or use tools/to_csv "
                        "or overturn.open() in Python.", USAGE)
    if len(axes) == 1:
        return None, axes[0]
    up, across = sorted(axes[-2:], key=free.index)
    return (up, across) if across in STRENGTHS else (across, up)


def plane_of(file, arguments):
    """Returns the only chosen plane. Raises an error if there are several, or if it has one axis only."""
    planes, _, _ = sheet_of(file, arguments, 1)
    if planes[0].across is None:
        raise ToolError(f"a map needs two dimensions, but this choice of \"{file.filename}\" has {planes[0].up} only. Give "
                        "more axes in the job.", USAGE)
    return planes[0]


def sheet_of(file, arguments, most):
    """Returns the chosen planes in the order of their panels, the number of columns, and a note on what is left out.

    Columns are the last dimension of several values if there are two or more, otherwise the sheet is nearly a square.
    Of more than `most` planes, so many are chosen in even steps; if most is 1, they are refused."""
    choices = chosen(file, arguments)
    axes = axes_of(file, choices)
    others = {name: [choices[name]] if name in choices else range(file.sizes[name])
              for name in file.dimensions if name not in axes}
    several = {name: len(places) for name, places in others.items() if len(places) > 1}
    count = math.prod(several.values())
    options = " or ".join(f"{option_of(name)} (0 to {size - 1})" for name, size in several.items())
    if count > most == 1:
        raise ToolError(f"there are {count} spectra, but the output is limited to 1; choose with {options}.", USAGE)
    places = [np.unravel_index(number, [len(each) for each in others.values()])
              for number in np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))]
    planes = [Plane(file, {name: int(each[place]) for (name, each), place in zip(others.items(), plane)}, *axes)
              for plane in places]
    columns, lengths = math.ceil(math.sqrt(len(planes))), list(several.values())
    if len(lengths) > 1 and count <= most and max(lengths[-1], count // lengths[-1]) <= MOST_COLUMNS:
        columns = lengths[-1]
    return planes, columns, f"{most} of {count} spectra, in even steps; choose others with {options}" * (count > most)
