"""Fragility curves of a result file, by the arguments of a tool."""

import argparse
import contextlib
import dataclasses
import pathlib

import overturn
from overturn.block_groups import azimuths_of, groups_of
from overturn.datasets import opened
from overturn.exceedance import OVERTURNING
from overturn.tool import USAGE, Renamed, ToolError


def add_group_argument(parser):
    parser.add_argument("--by", metavar="COLUMN",
                        help="a curve for each value of a column of the table of blocks, or of an axis such as "
                             "size; of more than 6 numbers, for each quarter of the blocks")


def add_curve_arguments(parser, bins, further=""):
    """Adds the arguments of a curve, see compute_curve(). further: what else --together does."""
    parser.add_argument("--of", metavar="FIELD", default=OVERTURNING,
                        help="with --above, count the points whose field, such as peak or slide_peak, is above X; "
                             "otherwise those that overturn")
    parser.add_argument("--above", type=float, metavar="X", help="in the unit of the field; of peak, at most 1")
    parser.add_argument("--limit", action=Renamed, const="--of peak --above", help=argparse.SUPPRESS)
    parser.add_argument("--friction", action=Renamed, const="--friction-demand", help=argparse.SUPPRESS)
    parser.add_argument("--together", metavar="COLUMN",
                        help="the blocks stand at one site and differ in this column of their table, or along this "
                             "axis, such as block: a point exceeds if one of them does" + further)
    parser.add_argument("--friction-demand", type=float, metavar="MU",
                        help="friction coefficient between block and ground: points whose field friction_demand is above MU "
                             "have no verdict")
    parser.add_argument("--bins", type=int, metavar="N", default=bins,
                        help="number of bins, which do not change the fit (default: %(default)s)")
    parser.add_argument("--equal-counts", action="store_true",
                        help="bins with equal numbers of points, not of equal width in the logarithm")
    parser.add_argument("--samples", type=int, metavar="N", default=1000,
                        help="samples of the bootstrap (default: %(default)s)")
    parser.add_argument("--seed", type=int, metavar="N", default=1, help="of the bootstrap (default: %(default)s)")


def compute_curve(dataset, im, arguments):
    return overturn.fragility(dataset, im, bins=arguments.bins, **_how(arguments))


def compute_plane(dataset, arguments):
    return overturn.fragility_plane(dataset, *arguments.im, bins=(arguments.bins, arguments.bins), **_how(arguments))


def _how(arguments):
    names = ("of", "above", "friction_demand", "together", "equal_counts", "samples", "seed")
    return {name: getattr(arguments, name) for name in names}


@contextlib.contextmanager
def open_dataset(path):
    """Opens a result for a tool, with overturn.open(), and reports that a curve cannot be computed from it."""
    try:
        dataset, _ = opened(path)  # what is unfinished is among the notes of a curve
    except (OSError, ValueError) as error:
        raise ToolError(str(error)) from error
    with dataset:
        try:
            yield dataset
        except ValueError as error:
            raise ToolError(f"\"{path}\": {error}", USAGE) from error


def curves_of(dataset, arguments, compute, parts=None):
    """Returns the curves that a function computes of the blocks or, with --by, of each group of them; or of each of the
    parts, by their names."""
    if parts is None and arguments.by is None:
        return [compute(dataset)]
    from overturn.fragility_curve import expect_records  # needs SciPy
    expect_records(dataset)
    return [dataclasses.replace(compute(blocks), group=group)
            for group, blocks in (parts or groups_of(dataset, arguments.by)).items()]


def write_csv(curve, number, path, is_of_several_measures):
    """Writes the table of a curve. The measure, and the number of the group of blocks, are added to the name of the file
    if there are several."""
    path = pathlib.Path(path)
    words = ([curve.im] if is_of_several_measures else []) + [str(number)] * bool(curve.group)
    path = path.with_name("_".join([path.stem, *words]) + path.suffix)
    curve.to_csv(path)
    print(path)
