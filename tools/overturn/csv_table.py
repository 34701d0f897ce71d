"""Writes a spectrum as CSV, one row per point, for use without HDF5."""

import csv
import itertools
import re

import numpy as np

from overturn.choice import add_choice_arguments, chosen
from overturn.fields import read_field
from overturn.motion_words import VARIABLES, column_named
from overturn.output_file import new_file
from overturn.result_file import damage_reported
from overturn.spectrum_file import open_spectrum
from overturn.tool import parse_with_output, parser_of
from overturn.units import LABELS

EXAMPLE = """\
example:
  overturn run jobs/smoke.toml                   # writes smoke.h5
  tools/to_csv smoke.h5                          # writes smoke.csv

Columns: the dimensions, with their names in the file (such as frequency and amplitude), and every
field of the file, with the codes of docs/results.md. Under the motion of a floor, pga is called pfa.
Rows: the first column varies fastest.
Numbers have enough digits to be read back exactly.
To write a part of the points only, choose an index along some dimensions:
  tools/to_csv four_axes.h5 --slenderness 0 --restitution 2 -o third.csv"""

REGION = "region"  # a column of every table
# The names of all columns that a table may have; see docs/results.md.
FIELDS = {REGION, "angle", "velocity", "margin", "error", "peak", "fall_time", "friction",
          "normal", "impacts", "steps", "status", "evaluated"}
ROW = re.compile("[-+.0-9einfa,]*")  # of numbers, inf and nan
COLUMNS = {*LABELS, *FIELDS, "width", "height", "half_width", "half_height", "motion", "block",
           "direction", "center_offset", "center_height", "radius_of_gyration", "incline", "slenderness_plus",
           "slenderness_minus", "size_plus", "size_minus"}


def parts_of(file, choices):
    """Yields indices of all points, part by part, because they may not fit in memory."""
    steps = [1 for _ in file.dimensions]
    if steps:
        steps[-1] = file.sizes[file.dimensions[-1]]
    if len(steps) > 1:
        steps[-2] = file[REGION].rows_of_chunk(file.dimensions[-2])
    yield from itertools.product(*(
        [slice(choices[name], choices[name] + 1)] if name in choices
        else [slice(first, first + step) for first in range(0, file.sizes[name], step)]
        for name, step in zip(file.dimensions, steps)))


def rows_of(file, choices):
    names = file.fields()
    yield [column_named(file.attrs, name) for name in (*reversed(file.dimensions), *names)]
    for part in parts_of(file, choices):
        with damage_reported(file.filename):
            axes = np.meshgrid(*(file[name][each] for name, each in zip(file.dimensions, part)), indexing="ij")
            columns = [*reversed(axes), *(read_field(file, name, part) for name in names)]
        yield from zip(*(column.ravel().tolist() for column in columns))


def is_own(beginning):
    """Whether a file begins with the names of such columns, dimensions first, and rows of numbers."""
    header, *rows = beginning.decode(errors="replace").split("\n")
    names = [VARIABLES.get(name, name) for name in header.split(",")]
    fields = len(FIELDS.intersection(names))
    return (REGION in names and COLUMNS.issuperset(names) and FIELDS.issuperset(names[-fields:])
            and all(row.count(",") == header.count(",") and ROW.fullmatch(row) for row in rows[:-1]))


def write(file, choices, path):
    with new_file(path, "a table of tools/to_csv", is_own) as part, \
            open(part, "w", newline="", encoding="ascii") as text:
        csv.writer(text, lineterminator="\n").writerows(rows_of(file, choices))
    print(path)


def read_arguments(argv):
    parser = parser_of("to_csv", __doc__, EXAMPLE, "overturn run")
    add_choice_arguments(parser)
    return parse_with_output(parser, argv, "FILE.csv", "the table")


def main(argv=None):
    arguments = read_arguments(argv)
    with open_spectrum(arguments.file) as file:
        with damage_reported(arguments.file):
            choices = chosen(file, arguments)
        write(file, choices, arguments.output)
