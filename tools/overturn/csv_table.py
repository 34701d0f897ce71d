"""Writes a result file as CSV, for use without HDF5: one row per point of a spectrum, flip of a boundary, sample of a
history or setting of an accuracy study; or per bin of a fragility curve."""

import csv
import itertools
import re
import sys

import numpy as np

from overturn import tables
from overturn.choice import OPTIONS, add_choice_arguments, chosen
from overturn.motion_words import VARIABLES, column_named
from overturn.output_file import BEGINNING, new_file
from overturn.result_file import HISTORY, SPECTRUM, STUDY, damage_reported, open_result, unfinished_words
from overturn.result_curves import (add_curve_arguments, add_group_argument, compute_curve, curves_of, open_dataset,
                                    write_csv)
from overturn.spectrum_planes import COUNTED, JOB, PHYSICAL
from overturn.tool import USAGE, ToolError, parse_with_output, parser_of
from overturn.units import expect_size, is_own_column, physical, unit_of

EXAMPLE = """\
example:
  overturn run jobs/smoke.toml                   # writes smoke.h5
  tools/to_csv smoke.h5                          # writes smoke.csv

Columns: the dimensions, with their names in the file (such as frequency and amplitude); all other
coordinates, such as names of blocks and records; every field of the file, with the codes of
docs/results.md. Under the motion of a floor, pga is called pfa. Rows: the first column varies
fastest. Numbers have enough digits to be read back exactly. What is not known is nan, undecided
points have region 254, and points that are not computed region 255. --units adds the unit of each
column to its name.
To write a part of the points only, choose an index along some dimensions:
  tools/to_csv four_axes.h5 --slenderness 0 --restitution 2 -o third.csv

A boundary has a row for each flip; a line without a flip has one row, whose region_below is that at
the first amplitude. A history has a row for each sample or, with --events, for each event. An
accuracy study has a row for each setting; what it gives for several quantiles, distances or regions
has a column for each:
  tools/to_csv history.h5 --units physical         # times in s, angles in degrees, slides in m
  tools/to_csv history.h5 --events -o events.csv

The table of a fragility curve is that of plot_fragility --csv: below its summary, in lines that begin
with #, a row for each bin.
  tools/to_csv fragility.h5 --fragility pga --by size    # writes fragility_1.csv, ...; see plot_fragility"""

REGION = "region"  # a column of every table of a spectrum
# The names of all columns of fields that a table of a spectrum may have; see docs/results.md.
FIELDS = {*tables.FIELDS, "evaluated"}
OF_MOTION = {"acceleration", "angle", "force_along", "force_normal", "friction_demand", "ground", "mode", "q", "slide",
             "slide_velocity", "velocity"}
# The last columns of every kind of table, and one that it always has.
LAST = ((FIELDS, REGION), ({"flip_amplitude", "flip_pga", "region_below", "region_above"}, "flip_amplitude"),
        ({"flip_value", "region_below", "region_above"}, "flip_value"),
        (OF_MOTION, "q"), ({f"{name}_{side}" for side in ("before", "after") for name in OF_MOTION}, "q_after"))
FIRST = {*tables.QUANTITIES, *COUNTED, "crossing", "time", "setting", "frequency_parameter_minus"}
NUMBER = re.compile("[-+.0-9einfa]*")  # inf and nan, too
OF_CURVES = {"by", "of", "above", "together", "friction_demand", "bins", "equal_counts", "samples", "seed"}
UNIT = re.compile(r" \[[^]]*\]$")


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
    if name in (*COUNTED, "crossing"):
        return True
    return is_own_column(file, name) and file[name].dtype.kind == "f" and bool((file[name][:] % 1 == 0).all())


def head_of(file, variable, units, column=None):
    """Returns the name of the column of a variable, with its unit if units are given."""
    unit = unit_of(file, variable, units) if units and variable in file else "1"
    return column_named(file.attrs, column or variable) + f" [{unit}]" * (unit != "1")


def rows_of(file, choices, units):
    dimensions = dimensions_of(file)
    others = [name for name in file.coordinates if name not in dimensions and {*file[name].dimensions} <= {*dimensions}]
    names = [*reversed(dimensions), *others, *fields_of(file)]
    yield [head_of(file, name, units) for name in names]
    integers = {name for name in [*dimensions, *others] if are_integers(file, name)}
    for part in parts_of(file, dimensions, choices):
        with damage_reported(file.filename):
            def property_of(name):
                return values_at(file, name, dimensions, part) if name in file else file.attrs[name]
            columns = [values_at(file, name, dimensions, part) for name in names]
            if units == PHYSICAL:
                columns = [physical(file, name, column, property_of) for name, column in zip(names, columns)]
        kept = np.ones(columns[0].shape, bool)
        if "crossing" in dimensions:  # beyond the last flip there is nothing, but each line has a row
            columns_of = dict(zip(names, columns))
            flips = next(columns_of[name] for name in ("flip_amplitude", "flip_value") if name in columns_of)
            kept = np.isfinite(flips) | (columns_of["crossing"] == 0)
        yield from zip(*(in_digits(column[kept].astype(int) if name in integers else column[kept])
                         for name, column in zip(names, columns)))


def in_digits(values):
    """Returns a list of values, each written with the digits of its precision."""
    return list(values) if values.dtype == np.float32 else values.tolist()


def rows_of_study(file, units):
    """A row for each setting; what varies along a further dimension has a column for each of its values."""
    columns = {"setting": np.arange(file.sizes["setting"])}

    def add(variable, values, label=""):
        head = head_of(file, variable, units, variable + label)
        columns[head] = values.astype(int) if (values % 1 == 0).all() else values
    for name, variable in file.items():
        further = [each for each in variable.dimensions if each != "setting"]
        if name in file.coordinates or not {"setting"} & {*variable.dimensions}:
            continue
        if not further:
            add(name, variable[:])
        for place, label in enumerate(labels_of(file, further[0]) if further else ()):
            add(name, variable[:][:, place], f"_{label}")
    yield columns.keys()
    yield from zip(*(column.tolist() for column in columns.values()))


def labels_of(file, name):
    if name == REGION:
        meanings = dict(zip(file[name].attrs["flag_values"], file[name].attrs["flag_meanings"].split()))
        return [meanings[code] for code in file[name][:]]
    return [f"{value:g}" for value in file[name][:]]


def rows_of_events(file, units):
    events = file.events()
    variables = {name: name.removesuffix("_before").removesuffix("_after") for name in ("time", "kind", *events)}
    yield [head_of(file, variable, units, name) for name, variable in variables.items()]
    if units == PHYSICAL:
        events |= {name: physical(file, variable, events[name], file.attrs.__getitem__)
                   for name, variable in variables.items() if variable in file}
    yield from zip(*(events[name].tolist() for name in variables))


def is_own(beginning):
    """Whether a file begins with the names of such columns, a dimension first and fields last, and with rows that have
    numbers in both."""
    try:
        rows = list(csv.reader(beginning.decode(errors="replace").split("\n")))
    except csv.Error:
        return False
    rows = [row for row in (rows[:-1] if len(beginning) >= BEGINNING else rows) if row]
    header = [VARIABLES.get(name, name) for name in (UNIT.sub("", name) for name in rows[0])] if rows else [""]
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
    parser.add_argument("--units", choices=(JOB, PHYSICAL),
                        help="add the unit of each column to its name, as in \"time [s]\". job: the values are those of "
                             "the file; physical: times are in s, angles in degrees, slides in m, and the job must give "
                             "the size of the block")
    curve = parser.add_argument_group("fragility curves of a result under records")
    curve.add_argument("--fragility", metavar="MEASURE", nargs="+",
                       help="write the curves against these measures, not the points: as --im of plot_fragility")
    add_group_argument(curve)
    add_curve_arguments(curve, bins=10)
    arguments = parse_with_output(parser, argv, "FILE.csv", "the table; OUT_MEASURE.csv and OUT_1.csv, OUT_2.csv, ... of "
                                                            "several measures and groups")
    given = {name for name, value in vars(arguments).items() if value != parser.get_default(name)}
    if arguments.fragility and (others := given & {"events", "units", "index", *OPTIONS}):
        parser.error(f"--{min(others)} is not for fragility curves, which are of all points. overturn.fragility() in Python "
                     "takes a part of a result")
    if not arguments.fragility and (others := given & OF_CURVES):
        parser.error(f"--{min(others).replace('_', '-')} is for --fragility MEASURE only")
    return arguments


def write_curves(arguments):
    import scipy  # noqa: F401 (for overturn.fragility: if it is missing, fail before anything is read)
    with open_dataset(arguments.file) as dataset:
        by_measure = [curves_of(dataset, arguments, lambda blocks: compute_curve(blocks, im, arguments))
                      for im in arguments.fragility]
    for curves in by_measure:
        for number, curve in enumerate(curves, 1):
            write_csv(curve, number, arguments.output, len(by_measure) > 1)


def table_of(file, arguments):
    """Returns the rows of the table, the names of its columns first."""
    kind = file.text("kind")
    if arguments.events and kind != HISTORY:
        raise ToolError(f"--events: \"{file.filename}\" is no history. Omit it.", USAGE)
    if kind == STUDY and arguments.units == PHYSICAL:
        raise ToolError(f"--units physical: \"{file.filename}\" is of blocks of all sizes. Omit it.", USAGE)
    expect_size(file, arguments.units or JOB)
    if arguments.events:
        return rows_of_events(file, arguments.units)
    if kind == STUDY:
        return rows_of_study(file, arguments.units)
    return rows_of(file, chosen(file, arguments), arguments.units)


def main(argv=None):
    arguments = read_arguments(argv)
    if arguments.fragility:
        write_curves(arguments)
        return
    with open_result(arguments.file) as file:
        file.expect_fields([REGION] * (file.text("kind") == SPECTRUM))
        write(table_of(file, arguments), arguments.output)
        for note in unfinished_words(file) if file.tiles else ():
            print(f"to_csv: {file.filename}: {note}; the other rows have fill values", file=sys.stderr)
