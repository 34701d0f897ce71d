"""Writes a result file as CSV, for use without HDF5: one row per point of a spectrum, flip of a boundary, sample of a
history or setting of an accuracy study."""

import csv
import itertools
import re

import numpy as np

from overturn import tables
from overturn.choice import add_choice_arguments, chosen
from overturn.motion_words import VARIABLES, column_named
from overturn.output_file import BEGINNING, new_file
from overturn.result_file import HISTORY, SPECTRUM, STUDY, damage_reported, open_result
from overturn.spectrum_planes import COUNTED
from overturn.tool import USAGE, ToolError, parse_with_output, parser_of

EXAMPLE = """\
example:
  overturn run jobs/smoke.toml                   # writes smoke.h5
  tools/to_csv smoke.h5                          # writes smoke.csv

Columns: the dimensions, with their names in the file (such as frequency and amplitude); all other
coordinates, such as names of blocks and records; every field of the file, with the codes of
docs/results.md. Under the motion of a floor, pga is called pfa. Rows: the first column varies
fastest. Numbers have enough digits to be read back exactly.
To write a part of the points only, choose an index along some dimensions:
  tools/to_csv four_axes.h5 --slenderness 0 --restitution 2 -o third.csv

A boundary has a row for each flip; a line without a flip has one row, whose region_below is that at
the first amplitude. A history has a row for each sample or, with --events, for each event. An
accuracy study has a row for each setting; what it gives for several quantiles, distances or regions
has a column for each:
  tools/to_csv history.h5 --events -o events.csv"""

REGION = "region"  # a column of every table of a spectrum
# The names of all columns of fields that a table of a spectrum may have; see docs/results.md.
FIELDS = {*tables.FIELDS, "evaluated"}
# The last columns of every kind of table, and one that it always has.
LAST = ((FIELDS, REGION), ({"flip_amplitude", "flip_pga", "region_below", "region_above"}, "flip_amplitude"),
        ({"acceleration", "angle", "friction_demand", "ground", "q", "velocity"}, "angle"),
        ({f"{name}_{side}" for side in ("before", "after")
          for name in ("acceleration", "angle", "friction_demand", "ground", "q", "velocity")}, "angle_after"))
FIRST = {*tables.QUANTITIES, *COUNTED, "crossing", "time", "setting", "frequency_parameter_minus"}
NUMBER = re.compile("[-+.0-9einfa]*")  # inf and nan, too


def dimensions_of(file):
    """Returns the dimensions along which there is a row for each place."""
    return {HISTORY: ("time",), STUDY: ("setting",)}.get(file.text("kind"), file.dimensions)


def fields_of(file):
    dimensions = dimensions_of(file)
    return [name for name, each in file.items() if name not in file.coordinates and each.dimensions == dimensions]


def parts_of(file, dimensions, choices):
    """Yields indices of all points, part by part, because they may not fit in memory."""
    sizes = file.sizes
    steps = [1 for _ in dimensions]
    if steps:
        steps[-1] = sizes[dimensions[-1]]
    if len(steps) > 1:
        steps[-2] = file.rows(dimensions[-2])
    yield from itertools.product(*(
        [slice(choices[name], choices[name] + 1)] if name in choices
        else [slice(first, min(first + step, sizes[name])) for first in range(0, sizes[name], step)]
        for name, step in zip(dimensions, steps)))


def values_at(file, name, dimensions, part):
    """Returns the values of a variable at some points."""
    variable = file[name]
    values = variable.at(dict(zip(dimensions, part)))
    order = sorted(range(values.ndim), key=lambda axis: dimensions.index(variable.dimensions[axis]))
    lengths = [each.stop - each.start for each in part]
    shape = [length if each in variable.dimensions else 1 for each, length in zip(dimensions, lengths)]
    return np.broadcast_to(values.transpose(order).reshape(shape), lengths)


def are_integers(file, name):
    """Whether a column of numbers of type double is written as integers: numbers of blocks, records and flips, and
    columns of a table of blocks that are no quantities of overturn."""
    variable = file[name]
    if name in (*COUNTED, "crossing"):
        return True
    return (variable.attrs.get("long_name") == "column of the table" and name not in FIRST
            and variable.dtype.kind == "f" and bool((variable[:] % 1 == 0).all()))


def rows_of(file, choices):
    dimensions = dimensions_of(file)
    others = [name for name in file.coordinates if name not in dimensions and {*file[name].dimensions} <= {*dimensions}]
    names = [*reversed(dimensions), *others, *fields_of(file)]
    yield [column_named(file.attrs, name) for name in names]
    integers = {name for name in [*dimensions, *others] if are_integers(file, name)}
    for part in parts_of(file, dimensions, choices):
        with damage_reported(file.filename):
            columns = [values_at(file, name, dimensions, part) for name in names]
        kept = np.ones(columns[0].shape, bool)
        if "crossing" in dimensions:  # beyond the last flip there is nothing, but each line has a row
            columns_of = dict(zip(names, columns))
            kept = np.isfinite(columns_of["flip_amplitude"]) | (columns_of["crossing"] == 0)
        yield from zip(*((column[kept].astype(int) if name in integers else column[kept]).tolist()
                         for name, column in zip(names, columns)))


def rows_of_study(file):
    """A row for each setting; what varies along a further dimension has a column for each of its values."""
    columns = {"setting": np.arange(file.sizes["setting"])}

    def add(name, values):
        columns[name] = values.astype(int) if (values % 1 == 0).all() else values
    for name, variable in file.items():
        further = [each for each in variable.dimensions if each != "setting"]
        if name in file.coordinates or not {"setting"} & {*variable.dimensions}:
            continue
        if not further:
            add(name, variable[:])
        for place, label in enumerate(labels_of(file, further[0]) if further else ()):
            add(f"{name}_{label}", variable[:][:, place])
    yield columns.keys()
    yield from zip(*(column.tolist() for column in columns.values()))


def labels_of(file, name):
    if name == REGION:
        meanings = dict(zip(file[name].attrs["flag_values"], file[name].attrs["flag_meanings"].split()))
        return [meanings[code] for code in file[name][:]]
    return [f"{value:g}" for value in file[name][:]]


def rows_of_events(file):
    events = file.events()
    columns = {"time": events["time"], "kind": events["kind"], **events}
    yield [column_named(file.attrs, name) for name in columns]
    yield from zip(*(column.tolist() for column in columns.values()))


def is_own(beginning):
    """Whether a file begins with the names of such columns, a dimension first and fields last, and with rows that have
    numbers in both."""
    try:
        rows = list(csv.reader(beginning.decode(errors="replace").split("\n")))
    except csv.Error:
        return False
    rows = [row for row in (rows[:-1] if len(beginning) >= BEGINNING else rows) if row]
    header = [VARIABLES.get(name, name) for name in rows[0]] if rows else [""]
    if header[0] not in FIRST:
        return False
    if header[0] == "setting":
        last = len(header)
    else:
        last = next((len([*itertools.takewhile(names.__contains__, reversed(header))]) for names, always in LAST
                     if always in header and header[-1] in names), 0)
    numbers = [0, *range(len(header) - last, len(header))]
    return last > 0 and all(len(row) == len(header) and all(NUMBER.fullmatch(row[place]) for place in numbers)
                            for row in rows[1:])


def write(rows, path):
    with new_file(path, "a table of tools/to_csv", is_own) as part, \
            open(part, "w", newline="", encoding="utf-8") as text:
        csv.writer(text, lineterminator="\n").writerows(rows)
    print(path)


def read_arguments(argv):
    parser = parser_of("to_csv", __doc__, EXAMPLE, "overturn run, boundary, history or accuracy")
    add_choice_arguments(parser)
    parser.add_argument("--events", action="store_true", help="of a history: write its events, not its samples")
    return parse_with_output(parser, argv, "FILE.csv", "the table")


def table_of(file, arguments):
    """Returns the rows of the table, the names of its columns first."""
    kind = file.text("kind")
    if arguments.events:
        if kind != HISTORY:
            raise ToolError(f"--events: \"{file.filename}\" is no history. Omit it.", USAGE)
        return rows_of_events(file)
    return rows_of_study(file) if kind == STUDY else rows_of(file, chosen(file, arguments))


def main(argv=None):
    arguments = read_arguments(argv)
    with open_result(arguments.file) as file:
        file.expect_fields([REGION] * (file.text("kind") == SPECTRUM))
        write(table_of(file, arguments), arguments.output)
