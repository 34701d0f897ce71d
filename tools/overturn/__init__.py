"""overturn from Python: the outcome of single blocks (evaluate), the program (run, check, topple, assess), result files
(open), fragility curves (fragility), rates of overturning at a site (risk), blocks from meshes of rocks (rock), pictures
(plot), recorded motions (read_record) and those of floors (floor_motion). The other modules are shared by the tools.

Modules are imported when they are used, because every tool imports this package."""

import importlib
from typing import TYPE_CHECKING

from overturn.installation import PACKAGES, explained, overturn_path

if TYPE_CHECKING:
    __version__: str
    from overturn import plot as plot
    from overturn import risk as risk
    from overturn import rock as rock
    from overturn.datasets import open as open
    from overturn.evaluation import Outcome as Outcome
    from overturn.evaluation import Verdict as Verdict
    from overturn.evaluation import evaluate as evaluate
    from overturn.floors import FloorMotion as FloorMotion
    from overturn.floors import floor_motion as floor_motion
    from overturn.fragility_curve import Fragility as Fragility
    from overturn.fragility_curve import fragility as fragility
    from overturn.friction import supported_share as supported_share
    from overturn.plane_of_measures import FragilityPlane as FragilityPlane
    from overturn.plane_of_measures import fragility_plane as fragility_plane
    from overturn.program import ProgramError as ProgramError
    from overturn.program import assess as assess
    from overturn.program import check as check
    from overturn.program import run as run
    from overturn.program import topple as topple
    from overturn.records import Record as Record
    from overturn.records import RecordError as RecordError
    from overturn.records import read_record as read_record
    from overturn.tool import ToolError as ToolError

_NAMES = {"evaluation": ("evaluate", "Outcome", "Verdict"), "datasets": ("open",),
          "program": ("run", "check", "topple", "assess", "ProgramError"), "fragility_curve": ("fragility", "Fragility"),
          "plane_of_measures": ("fragility_plane", "FragilityPlane"), "friction": ("supported_share",),
          "floors": ("floor_motion", "FloorMotion"), "records": ("read_record", "Record", "RecordError"),
          "tool": ("ToolError",)}
_MODULE_OF = {name: module for module, names in _NAMES.items() for name in names}
_MODULES = ("plot", "risk", "rock")
__all__ = [*_MODULE_OF, *_MODULES]

# An installed package contains the compiled module; that of a build is in a folder next to the program.
__path__.append(str(overturn_path().parent / "python"))


def _module(name):
    try:
        return importlib.import_module(f"{__name__}.{name}")
    except ModuleNotFoundError as error:
        if error.name not in PACKAGES:
            raise
        raise ImportError(explained(error), name=error.name) from error


def __getattr__(name):
    if name in _MODULES:
        return _module(name)
    if name == "__version__":
        return _module("_core").__version__
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(_module(_MODULE_OF[name]), name)


def __dir__():
    return sorted({*globals(), *__all__})
