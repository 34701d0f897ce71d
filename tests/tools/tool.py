"""Running the tools with the interpreter of the tests, in a given folder. Importing this module
makes the package `overturn` of the tools importable."""

import pathlib
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PATIENCE = 100  # [s] for one run of a tool; the longest takes a few seconds

sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))


def run_tool(name, *arguments, **how):
    """Runs a tool; `name` is a path below tools/."""
    return subprocess.run([sys.executable, TOOLS / name, *arguments], text=True,
                          capture_output=True, **{"timeout": PATIENCE, **how})
