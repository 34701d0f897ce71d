"""Where the tools are, and the program that some of them run."""

import os
import pathlib

from overturn.result_file import USAGE, PlotError

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]


def find_overturn(told):
    """The program that an argument or $OVERTURN names, or the one built here."""
    path = pathlib.Path(told or os.environ.get("OVERTURN") or CHECKOUT / "build" / "overturn")
    if not os.access(path, os.X_OK) or path.is_dir():
        raise PlotError(f"there is no program \"{path}\". Build it (tools/quickstart does), or "
                        "name another one with --overturn PATH.", USAGE)
    return path.resolve()
