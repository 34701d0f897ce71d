"""Paths of the checkout and of the overturn program.

Every tool imports this module: it must remain light."""

import os
import pathlib
import shutil

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
IS_CHECKOUT = pathlib.Path(__file__).resolve().parents[1] == CHECKOUT / "tools"


def overturn_path(given=None):
    """Returns the path of the program given by an argument or $OVERTURN, or of the one built here; of a package that
    was installed by pip, of the one on the PATH."""
    found = given or os.environ.get("OVERTURN") or (None if IS_CHECKOUT else shutil.which("overturn"))
    return pathlib.Path(found or CHECKOUT / "build" / "overturn").absolute()


def is_program(path):
    return os.access(path, os.X_OK) and not path.is_dir()


def mpi_environment():
    """Returns the environment; Open MPI runs as root only if both variables are set."""
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return os.environ | (allowed if os.geteuid() == 0 else {})


def find_overturn(given):
    """Returns the program; `given` is the argument of a tool."""
    from overturn.tool import USAGE, ToolError
    path = overturn_path(given)
    if not is_program(path):
        raise ToolError(f"there is no program \"{path}\". Build it (tools/quickstart does), or "
                        "pass another one with --overturn PATH.", USAGE)
    return path.resolve()
