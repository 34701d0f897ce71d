"""Choice of spectra in a file: an option per outer dimension gives an index."""

import itertools
import math

from overturn.captions import value_text
from overturn.fields import dimensions_of
from overturn.result_file import USAGE, PlotError

OPTIONS = ("motion", "slenderness", "restitution")


def add_choice_arguments(parser):
    for name in OPTIONS:
        only = " (files of records only)" if name == "motion" else ""
        parser.add_argument(f"--{name}", type=int, metavar="INDEX",
                            help=f"use only the {name} with this index, counted from 0{only}")


def indices(file, name, index):
    """Returns the indices to use along one dimension: the requested one, or all."""
    count = len(file[name])
    if index is None:
        return list(range(count))
    if not 0 <= index < count:
        first, last = value_text(file, name, 0), value_text(file, name, count - 1)
        raise PlotError(f"--{name} {index} is out of range; this file has 0 to {count - 1} "
                        f"({name} {first} to {last}).", USAGE)
    return [index]


def chosen(file, arguments, most=1):
    """Returns the indices to use along each outer dimension. Raises an error if these are more
    than `most` spectra."""
    names = dimensions_of(file)[:-2]
    for name in OPTIONS:
        if getattr(arguments, name) is not None and name not in names:
            raise PlotError(f"--{name}: \"{file.filename}\" has no dimension {name}, only "
                            f"{', '.join(names)}.", USAGE)
    choices = {name: indices(file, name, getattr(arguments, name, None)) for name in names}
    count = math.prod(map(len, choices.values()))
    if count > most:
        several = [f"--{name} (0 to {places[-1]})" for name, places in choices.items()
                   if len(places) > 1]
        raise PlotError(f"there are {count} spectra, but the output is limited to {most}; choose "
                        f"with {' or '.join(several)}.", USAGE)
    return list(choices.values())


def chosen_one(file, arguments):
    """Returns the index of the only chosen spectrum."""
    return next(itertools.product(*chosen(file, arguments)))
