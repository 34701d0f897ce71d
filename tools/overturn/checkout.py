"""Paths of the checkout and of the overturn program."""

import os
import pathlib

from overturn.result_file import USAGE, PlotError

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]


def find_overturn(given):
    """Returns the program given by an argument or $OVERTURN, or the one built here."""
    path = pathlib.Path(given or os.environ.get("OVERTURN") or CHECKOUT / "build" / "overturn")
    if not os.access(path, os.X_OK) or path.is_dir():
        raise PlotError(f"there is no program \"{path}\". Build it (tools/quickstart does), or "
                        "pass another one with --overturn PATH.", USAGE)
    return path.resolve()
