"""The stub of evaluate(), which names every quantity of a point and every field of a spectrum. `--write` writes it from
the tables of the compiled module. Requires OVERTURN (the binary) in the environment and the package on PYTHONPATH."""

import inspect
import pathlib
import sys
import textwrap
import unittest

import overturn
from overturn import core

TABLES = pathlib.Path(overturn.__file__).with_name("tables.py")
STUB = pathlib.Path(overturn.__file__).with_name("evaluation.pyi")
COMPONENT = "ArrayLike | Motion | Trace | Stream | None"
TYPES = {"fields": "Iterable[str]", "record": COMPONENT, "second_component": COMPONENT, "vertical": COMPONENT,
         "resolve": "bool", **dict.fromkeys(("pulse", "units", "motion_of"), "str | None"),
         **dict.fromkeys(("theory", "method"), "str"), "gravity": "float",
         **dict.fromkeys(("window", "cycles", "gamma", "nu", "time_step", "tolerance"), "float | None")}
HEAD = '''"""What becomes of single blocks. Written by tests/python/stub_test.py --write."""

import enum
from collections.abc import Iterable
from typing import TypedDict

from numpy import float64, uint8, uint16, uint32
from numpy.typing import ArrayLike, NDArray

from overturn.accelerations import Motion, Stream, Trace

class Verdict(enum.IntEnum):
'''


def stub():
    lines = [f"    {verdict.name} = {verdict.value}" for verdict in overturn.Verdict]
    lines += ["", "class Outcome(TypedDict, total=False):", "    verdict: NDArray[uint8]"]
    lines += [f"    {name}: NDArray[{row['type']}]  #: {row['long_name']}" for name, row in core.fields.items()]
    lines += ["", "def evaluate(*,"]
    lines += [f"             {name}: {TYPES.get(name, 'ArrayLike | None')} = ...,"
              for name in inspect.signature(overturn.evaluate).parameters]
    return HEAD + "\n".join(lines) + "\n             ) -> Outcome: ...\n"


TABLES_HEAD = '''"""Fields of a spectrum, quantities of its points. Written by tests/python/stub_test.py --write."""

'''
TABLES_FOOT = '''

def _of_role(role):
    return tuple(name for name, (_, each, _) in QUANTITIES.items() if each == role)


STRENGTHS, RATES = _of_role("strength"), _of_role("rate")
SIZES = tuple(name for name, (_, _, same_as) in QUANTITIES.items() if "size" in (name, same_as))
'''


def tables():
    rows = [f"    {name!r}: {(row['units'], row['role'], row['same_as'])!r},".replace("'", '"')
            for name, row in core.coordinates.items()]
    fields = ", ".join(f'"{name}"' for name in core.fields)
    return "\n".join([TABLES_HEAD + textwrap.fill(f"FIELDS = ({fields})", 120, subsequent_indent=" " * 10),
                      "# Units in sentences, role, and the quantity of which this is another spelling.",
                      "QUANTITIES = {", *rows, "}", TABLES_FOOT])


class TheStub(unittest.TestCase):
    def test_is_that_of_the_module(self):
        self.assertEqual(STUB.read_text(), stub(), "run this test with --write")
        self.assertEqual(TABLES.read_text(), tables(), "run this test with --write")

    def test_is_that_of_the_function(self):
        parameters = inspect.signature(overturn.evaluate).parameters
        self.assertTrue({"width", "pga", "pulse_period", "scale", "fields"} <= parameters.keys())
        self.assertNotIn("motion", parameters)
        for name in (*parameters.keys() & core.coordinates.keys(), *core.fields):
            self.assertRegex(overturn.evaluate.__doc__, rf"\n +{name}\*?: ")


if __name__ == "__main__":
    if "--write" in sys.argv:
        STUB.write_text(stub())
        TABLES.write_text(tables())
    else:
        unittest.main()
