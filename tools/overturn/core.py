"""The compiled module of the package."""

import pathlib
import sys

import overturn

try:
    from overturn import _core
except ImportError as error:
    folders = [pathlib.Path(folder) for folder in overturn.__path__]
    others = [str(path) for folder in folders for path in folder.glob("_core.*.so")]
    if others:
        raise ImportError(f"{sys.executable} cannot import {', '.join(others)}: {error}. Use the Python that it "
                          "was built for, or configure overturn with -DPython3_EXECUTABLE="
                          f"{sys.executable} and build it again.") from error
    raise ImportError(
        f"the compiled module of overturn is not in {' or '.join(map(str, folders))}. Install pybind11 and "
        "the headers of Python and build overturn (tools/quickstart does), or set OVERTURN to the path of "
        "another build's program.") from error

sys.modules[__name__] = _core
