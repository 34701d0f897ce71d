"""Where this package is: in a checkout, in the same folders of an installation by CMake, or installed by pip. Which
program it calls, and which Python runs its tools: the first on the PATH, or the system's if the first lacks a package
that the system's has; of an installation by pip, its own.

Every tool imports this module first, in any Python 3: only the standard library is imported here."""

import importlib
import os
import pathlib
import shutil
import subprocess
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
IS_CHECKOUT = pathlib.Path(__file__).resolve().parents[1] == CHECKOUT / "tools"  # or an installation by CMake
SYSTEM = "/usr/bin/python3"  # distributions package the modules for it
PACKAGES = ("numpy", "h5py", "matplotlib", "scipy", "xarray", "h5netcdf", "jinja2", "meshio")  # that the package needs
TOOLS = {"floor_motion": "floor_motions", "plot_accuracy": "plot.accuracy_study", "plot_boundary": "plot.boundaries",
         "plot_fragility": "plot.fragility_curves", "plot_history": "plot.histories", "plot_landing": "plot.landings",
         "plot_phase": "plot.portraits", "plot_risk": "plot.risks", "plot_spectrum": "plot.spectra",
         "report": "report", "rock": "rock", "synthetic_record": "synthetic_record",
         "to_csv": "csv_table"}  # and the modules with their main()


def overturn_path(given=None):
    """Returns the path of the program given by an argument or $OVERTURN, or of the one built here; of a package that
    was installed by pip, of the one on the PATH."""
    found = given or os.environ.get("OVERTURN") or (None if IS_CHECKOUT else shutil.which("overturn"))
    return pathlib.Path(found or CHECKOUT / "build" / "overturn").absolute()


def is_program(path):
    return os.access(path, os.X_OK) and not path.is_dir()


def find_overturn(given):
    """Returns the program; `given` is the argument of a tool."""
    from overturn.tool import USAGE, ToolError
    path = overturn_path(given)
    if not is_program(path):
        raise ToolError(f"there is no program \"{path}\". Build it (tools/quickstart does), or "
                        "pass another one with --overturn PATH.", USAGE)
    return path.resolve()


def mpi_environment():
    """Returns the environment; Open MPI runs as root only if both variables are set."""
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return {**os.environ, **(allowed if os.geteuid() == 0 else {})}


def package_of(error):
    """Returns the package that an import has not found, or an empty text."""
    return (error.name or "").split(".")[0]


def explained(error, packages="plot"):
    """Returns the text of a failed import, with what to do if a package is missing. `packages` are the arguments of
    install_dependencies that install it."""
    package = package_of(error)
    if not package or error.__cause__:  # of the latter, this is the text already
        return str(error)
    command = (f"Debian's python3-{package} for {SYSTEM} (in a checkout: tools/install_dependencies {packages})"
               if IS_CHECKOUT else "all packages by pip install \"overturn[all]\"")
    return f"{error} (Python: {sys.executable}). Install it for this Python, or {command}."


def system_has(package):
    try:
        return subprocess.run([SYSTEM, "-c", "import " + package], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    except OSError:
        return False


def run_elsewhere(error, packages="plot"):
    """Replaces this process, in which an import has failed, by the same tool in the system's Python; exits with a
    message if that would fail, too. `packages`: as in explained()."""
    package = package_of(error)
    if IS_CHECKOUT and package and sys.executable != SYSTEM and system_has(package):
        os.execv(SYSTEM, [SYSTEM] + sys.argv)
    sys.exit(f"{os.path.basename(os.path.realpath(sys.argv[0]))}: {explained(error, packages)}")


def run_command():
    """Runs the tool whose name this process has, such as tools/plot_spectrum or overturn-plot-spectrum."""
    os.environ["MPLBACKEND"] = "Agg"  # writes files; needs no display
    name = os.path.basename(os.path.realpath(sys.argv[0])).replace("overturn-", "").replace("-", "_")
    try:
        from overturn.tool import run_tool
        run_tool(name, importlib.import_module("overturn." + TOOLS[name]).main)
    except ImportError as error:
        run_elsewhere(error)
