"""Result files as data sets of xarray."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def open(path: str | os.PathLike[str]) -> xarray.Dataset:
    """Opens a result file: its coordinates, its fields and its attributes (docs/results.md). Fields are
    read when they are used. In an unfinished file, points that are not computed have the values that mean
    "not computed" (region: 255; double: NaN).

    Raises ValueError if the file was not written by overturn, OSError if it cannot be read.
    """
    try:
        import h5py
        import xarray
    except ImportError as error:
        raise ImportError(f"{error} (Python: {sys.executable}). Install xarray and h5py (Debian: "
                          "python3-xarray and python3-h5py, for /usr/bin/python3).", name=error.name) from error
    from overturn.lazy_variables import variable
    from overturn.result_file import FORMAT, Result, other_format
    file = h5py.File(path)
    try:
        if "program_version" not in file.attrs:
            raise ValueError(f"\"{path}\" was not written by overturn.")
        if (version := file.attrs.get("format_version", 1)) != FORMAT:
            raise ValueError(other_format(path, version))
        result = Result(file)
        variables = {name: variable(result, name) for name in result}
    except Exception:
        file.close()
        raise
    coordinates = {name: variables.pop(name) for name in result.coordinates}
    dataset = xarray.Dataset(variables, coordinates, result.attrs)
    dataset.encoding["source"] = os.path.abspath(path)
    dataset.set_close(result.close)
    return dataset
