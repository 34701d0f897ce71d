"""Writes one spectrum of a result file as CSV, one row per point, for use without HDF5."""

import argparse
import csv
import pathlib

from overturn.choice import add_choice_arguments, chosen_one
from overturn.fields import dimensions_of, fields_of, read_field
from overturn.output_file import new_file
from overturn.result_file import damage_reported
from overturn.spectrum_file import open_spectrum, rows_of_tiles
from overturn.units import LABELS

EXAMPLE = """\
example:
  overturn run jobs/smoke.toml                   # writes smoke.h5
  tools/to_csv smoke.h5                          # writes smoke.csv

Columns: the axes of the plane, with their names in the file (such as frequency and amplitude), and
every field of the file, with the codes of docs/results.md. Rows: the first column varies fastest.
Numbers have enough digits to be read back exactly.
For a file of several spectra (records, slendernesses, restitutions) choose one:
  tools/to_csv four_axes.h5 --slenderness 0 --restitution 2 -o third.csv"""


def rows_of(file, outer):
    names = fields_of(file)
    *_, up, across = dimensions_of(file)
    yield [across, up, *names]
    for rows in rows_of_tiles(file[names[0]]):
        with damage_reported(file.filename):
            tiles = [read_field(file, name, outer, rows) for name in names]
        for i, row in enumerate(file[up][rows].tolist()):
            columns = (tile[i].tolist() for tile in tiles)
            for values in zip(file[across][:].tolist(), *columns):
                yield [values[0], row, *values[1:]]


def is_own(beginning):
    """Whether a file begins with the names of two axes, as its tables do."""
    across, up, *_ = [*beginning.split(b"\n")[0].split(b","), b"", b""]
    return {across, up} <= {name.encode() for name in LABELS}


def write(file, outer, path):
    with new_file(path, "a table of tools/to_csv", is_own) as part, \
            open(part, "w", newline="", encoding="ascii") as text:
        csv.writer(text, lineterminator="\n").writerows(rows_of(file, outer))
    print(path)


def read_arguments(argv):
    parser = argparse.ArgumentParser(prog="to_csv", description=__doc__, epilog=EXAMPLE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.h5", help="written by overturn run")
    parser.add_argument("-o", "--output", metavar="OUT.csv",
                        help="the table (default: FILE.csv in the working directory)")
    add_choice_arguments(parser)
    arguments = parser.parse_args(argv)
    if arguments.output is None:
        arguments.output = pathlib.Path(arguments.file).stem + ".csv"
    return arguments


def main(argv=None):
    arguments = read_arguments(argv)
    with open_spectrum(arguments.file) as file:
        with damage_reported(arguments.file):
            outer = chosen_one(file, arguments)
        write(file, outer, arguments.output)
