"""Result files as data sets of xarray, whose variables are read when they are used."""

from __future__ import annotations

import os
import warnings

import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from overturn.result_file import open_file, unfinished_words


class _Values(BackendArray):
    def __init__(self, variable):
        self.variable, self.shape, self.dtype = variable, variable.shape, variable.dtype

    def __getitem__(self, key):
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC,
                                                  self.variable.__getitem__)

    def __deepcopy__(self, _):
        return self  # of an open file


def open(path: str | os.PathLike[str]) -> xarray.Dataset:
    """Opens a result file: its coordinates, its fields and its attributes (docs/results.md). Fields are
    read when they are used. In an unfinished file, points that are not computed have the values that mean
    "not computed" (region: 255; double: NaN), and there is a warning.

    Raises ValueError if the file was not written by overturn or has another format, OSError if it cannot be read.
    """
    dataset, unfinished = opened(path)
    if unfinished:
        warnings.warn(f"\"{os.fspath(path)}\" is {unfinished[0]}. The other points have the region 255, NaN or another "
                      "fill value: leave them out of shares and means.", stacklevel=2)
    return dataset


def opened(path):
    """Returns the data set of open(), and the note on an unfinished file, if it is one."""
    file = open_file(path)
    variables = {name: xarray.Variable(each.dimensions, indexing.MemoryCachedArray(indexing.CopyOnWriteArray(
        indexing.LazilyIndexedArray(_Values(each)))), each.attrs) for name, each in file.items()}
    coordinates = {name: variables.pop(name) for name in file.coordinates}
    dataset = xarray.Dataset(variables, coordinates, file.attrs)
    dataset.encoding["source"] = os.path.abspath(path)
    dataset.set_close(file.file.close)
    return dataset, unfinished_words(file) if file.tiles else []
