"""Which Python runs a tool: the first on the PATH, unless it lacks a module that the system's has.

Nothing but the standard library is imported here, so that this works in any Python 3."""

import os
import subprocess
import sys

SYSTEM = "/usr/bin/python3"  # for which distributions package h5py, NumPy and Matplotlib


def system_has(module):
    probe = [SYSTEM, "-c", "import " + module]
    try:
        return subprocess.run(probe, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def run_elsewhere(error, packages="plot"):
    """Replaces this process, in which an import has failed, by the same tool in the system's
    Python; if that would fail as well, ends with a message. `packages` are what
    install_dependencies is to install."""
    tool = os.path.basename(os.path.realpath(sys.argv[0]))
    module = (error.name or "").split(".")[0]
    if module and sys.executable != SYSTEM and system_has(module):
        print("{}: {} cannot import {}; running in {} instead.".format(
            tool, sys.executable, module, SYSTEM), file=sys.stderr, flush=True)
        os.execv(SYSTEM, [SYSTEM] + sys.argv)
    sys.exit("{}: {} (Python: {}); to install it: tools/install_dependencies {}".format(
        tool, error, sys.executable, packages))
