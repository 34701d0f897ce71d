"""Writes the motions of a floor of a building, as text records, from those of the ground and the modes of the building."""

import pathlib
import sys
import warnings

from overturn.core import RecordError
from overturn.floors import TITLE, floor_motion
from overturn.output_file import OutputError, make_folder
from overturn.records import read_record
from overturn.tool import USAGE, ToolError, parse_with_output, parser_of

EXAMPLE = """\
example:
  tools/floor_motion suite/*.AT2 --period 0.6 0.24 --shape 1.0 0.16   # writes floor/01.txt and so on
  overturn assess objects.csv --record 'floor/*.txt' --scale 1

Ask the structural engineer for the periods of the lowest modes of the building in one horizontal direction, their
damping and, for the floor, their participation factor times mode shape. Without an engineer, for a first look, one
mode with a straight shape:

  tools/floor_motion suite/*.AT2 --storeys 3 --floor 2 --period 0.35 --period-factors 0.7 1 1.4

The period of a building of the height H [m] is about 0.05 H^(3/4) s, of concrete frames 0.075 H^(3/4) s, of steel
frames 0.085 H^(3/4) s (EN 1998-1, 4.3.3.2.2). The shape of one straight mode is 3 I / (2 N + 1) at floor I of N
storeys; floor 0 is the ground. docs/floors.md explains more."""


def read_arguments(argv):
    parser = parser_of("floor_motion", __doc__, EXAMPLE)
    parser.add_argument("records", metavar="RECORD", nargs="+", help="motions of the ground, in a format of docs/records.md")
    parser.add_argument("--period", metavar="T", type=float, nargs="+", required=True, help="of each mode [s]")
    parser.add_argument("--damping", metavar="D", type=float, nargs="+", default=[0.05],
                        help="ratio to the critical damping, one for all modes or one for each (default: 0.05)")
    parser.add_argument("--shape", metavar="S", type=float, nargs="+",
                        help="participation factor times mode shape at the floor, of each mode")
    parser.add_argument("--storeys", metavar="N", type=int, help="of a building with one straight mode, in place of --shape")
    parser.add_argument("--floor", metavar="I", type=int, help="the floor, from 1 to N")
    parser.add_argument("--period-factors", metavar="F", type=float, nargs="+", default=[1.0],
                        help="a motion for each of these factors on the periods, which are uncertain (default: 1)")
    parser.add_argument("--component", metavar="NAME", default="1", help="number or name (default: the first)")
    parser.add_argument("--time-step", metavar="SECONDS", type=float, help="of records of text without times")
    parser.add_argument("--units", metavar="UNIT", help="of records that do not state it: g, m/s2, cm/s2, mm/s2 or gal")
    arguments = parse_with_output(parser, argv, "floor", "folder of the motions")
    if (arguments.storeys is None) != (arguments.floor is None):
        parser.error("--storeys and --floor belong together")
    if (arguments.shape is None) == (arguments.storeys is None):
        parser.error("give either --shape, or --storeys and --floor")
    if arguments.storeys is not None:
        if len(arguments.period) > 1:
            parser.error("--storeys describes one mode: give one --period, or the --shape of each mode")
        if not 1 <= arguments.floor <= arguments.storeys:
            parser.error(f"--floor {arguments.floor} is outside 1 to {arguments.storeys}, the number of --storeys")
        arguments.shape = [3 * arguments.floor / (2 * arguments.storeys + 1)]
    return arguments


def names_of(records, factors):
    """Returns the name of the file of each record and factor."""
    stems = [pathlib.Path(path).stem for path in records]
    if repeated := next((stem for stem in stems if stems.count(stem) > 1), None):
        raise ToolError(f"two records are called {repeated}, as would be their motions of the floor. Rename one, or write "
                        "them to different folders.", USAGE)
    words = [f"{factor:g}" for factor in factors]
    if repeated := next((word for word in words if words.count(word) > 1), None):
        raise ToolError(f"--period-factors has {repeated} twice.", USAGE)
    return [[stem + (f"_{word}" if len(words) > 1 else "") + ".txt" for word in words] for stem in stems]


def motions_of(path, arguments):
    """Yields the motion of the floor for each factor on the periods."""
    component = int(arguments.component) if arguments.component.isdecimal() else arguments.component
    record = read_record(path, component, time_step=arguments.time_step, units=arguments.units)
    for factor in arguments.period_factors:
        yield floor_motion(record, periods=[factor * period for period in arguments.period], damping=arguments.damping,
                           shape=arguments.shape)


def main(argv=None):
    arguments = read_arguments(argv)
    names = names_of(arguments.records, arguments.period_factors)
    folder = pathlib.Path(arguments.output)
    written = {name for each in names for name in each}
    if others := sorted({each.name for each in folder.glob("*.txt")} - written):
        raise OutputError(folder, f"it holds other texts, such as {others[0]}, which the pattern *.txt would add to the "
                                  "motions. Remove them, or choose another folder")
    print("motion of the floor      PGA of the ground   PFA [g]")
    for path, own in zip(arguments.records, names):
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                motions = list(motions_of(path, arguments))
        except RecordError as error:
            raise ToolError(str(error)) from error
        except ValueError as error:
            raise ToolError(str(error), USAGE) from error
        for text in dict.fromkeys(str(each.message) for each in caught):
            print(f"floor_motion: {path}: {text}", file=sys.stderr)
        make_folder(folder)
        for name, motion in zip(own, motions):
            motion.to_text(folder / name)
            print(f"{str(folder / name):24} {motion.ground_pga:17.4f} {abs(motion.acceleration).max():9.4f}")
    print(f"\noverturn assess TABLE.csv --record '{folder}/*.txt' --scale 1")
