"""Choice of the Python that runs a tool: the first on the PATH, or the system's if the first lacks
a module that the system's has.

Only the standard library is imported here, so that this module works in any Python 3."""

import importlib
import os
import subprocess
import sys

SYSTEM = "/usr/bin/python3"  # distributions package h5py, NumPy and Matplotlib for it


def system_has(module):
    probe = [SYSTEM, "-c", "import " + module]
    try:
        return subprocess.run(probe, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def run_elsewhere(error, packages="plot"):
    """Replaces this process, in which an import has failed, by the same tool in the system's
    Python; exits with a message if that would fail, too. `packages` are the arguments of
    install_dependencies that install the module."""
    tool = os.path.basename(os.path.realpath(sys.argv[0]))
    module = (error.name or "").split(".")[0]
    if module and sys.executable != SYSTEM and system_has(module):
        os.execv(SYSTEM, [SYSTEM] + sys.argv)
    sys.exit("{}: {} (Python: {}); to install it: tools/install_dependencies {}".format(
        tool, error, sys.executable, packages))


def run_command(name, module):
    """Runs main() of a module as the tool of this name; in the system's Python if this one lacks a
    module that it needs."""
    os.environ["MPLBACKEND"] = "Agg"  # writes files; needs no display
    try:
        from overturn.tool import run_tool
        run_tool(name, importlib.import_module(module).main)
    except ImportError as error:
        run_elsewhere(error)
