"""The compiled module of the package."""

import pathlib
import sys

import numpy as np
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

if np.lib.NumpyVersion(np.__version__) >= "2.0.0" and not _core.supports_numpy_2:
    raise ImportError(f"{sys.executable} has NumPy {np.__version__}, but the compiled module of overturn was built "
                      "with a pybind11 before 2.12, which supports NumPy 1 only. Use the Python that it was built for, "
                      "install \"numpy<2\", or build overturn with a newer pybind11.")
sys.modules[__name__] = _core
