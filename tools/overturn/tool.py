"""What the commands in tools/ have in common: their arguments and their errors. Only the standard library is
imported here, because synthetic_record needs nothing else but NumPy."""

import argparse
import contextlib
import os
import pathlib
import re
import signal
import sys
import warnings

from overturn.output_file import FILE, PICTURES, OutputError

USAGE = 2  # exit code, equal to that of overturn


class ToolError(Exception):
    """An error with a message for the user and an exit code."""

    def __init__(self, message, code=FILE):
        super().__init__(message)
        self.code = code


class Renamed(argparse.Action):
    """An option that has another name now, `const`."""

    def __call__(self, parser, namespace, values, option_string=None):
        parser.error(f"{option_string} is called {self.const} now")


def parser_of(name, description, example, written_by=None):
    """Returns the parser of a tool; with the argument FILE.h5 if it reads a file that a command writes."""
    parser = argparse.ArgumentParser(prog=name, description=description, epilog=example,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    if written_by:
        parser.add_argument("file", metavar="FILE.h5", help=f"written by {written_by}")
    return parser


def parse_with_output(parser, argv, default, what):
    """Parses the arguments, with -o for the output. In its default name, FILE stands for the name of the file and
    PORTRAIT for that argument."""
    parser.add_argument("-o", "--output", metavar="OUT", help=f"{what} (default: {default} in the working directory)")
    arguments = parser.parse_args(argv)
    if arguments.output is None:
        arguments.output = default.replace("FILE", pathlib.Path(getattr(arguments, "file", "")).stem).replace(
            "PORTRAIT", getattr(arguments, "portrait", ""))
    return arguments


def parse_with_picture(parser, argv, default="FILE.png"):
    arguments = parse_with_output(parser, argv, default, "picture: .png, .pdf or .svg")
    if pathlib.Path(arguments.output).suffix not in PICTURES:
        parser.error(f"\"{arguments.output}\" must end in .png, .pdf or .svg")
    return arguments


@contextlib.contextmanager
def missing_glyphs_reported(name):
    """Says once which characters the font of Matplotlib lacks, in place of its warning for each."""
    missing = {}
    with warnings.catch_warnings():
        warnings.filterwarnings("always", r"Glyph \d+ .*missing")
        show = warnings.showwarning

        def note(message, *how, **more):
            if found := re.match(r"Glyph (\d+)", str(message)):
                missing[chr(int(found[1]))] = None
            else:
                show(message, *how, **more)
        warnings.showwarning = note
        yield
    if missing:
        print(f"{name}: the font of Matplotlib lacks {' '.join(missing)}: PNG and PDF pictures have boxes in their place, "
              "SVG pictures have the text.", file=sys.stderr)


def run_tool(name, main):
    """Runs the function of a tool; an error ends the process with a message and an exit code. If the reader of the
    output stops early, like head, the tool ends as other programs do, without a message."""
    try:
        with missing_glyphs_reported(name):
            main()
        sys.stdout.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the flush at the end of Python
        sys.exit(128 + signal.SIGPIPE)
    except (ToolError, OutputError) as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(error.code)
