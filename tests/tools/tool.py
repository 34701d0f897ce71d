"""The tools as the tests start them: with the interpreter of the tests, in a given folder.
Importing this module makes their package `overturn` importable."""

import pathlib
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PATIENCE = 100  # [s] for one run of a tool; the longest takes some seconds

sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))


def run_tool(name, *arguments, **how):
    """`name` is a path below tools/."""
    return subprocess.run([sys.executable, TOOLS / name, *arguments], text=True,
                          capture_output=True, **{"timeout": PATIENCE, **how})
