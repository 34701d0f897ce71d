"""Variables of a result file as variables of xarray, which are read when they are used."""

import xarray
from overturn.fields import read_field
from xarray.backends import BackendArray
from xarray.core import indexing


class Values(BackendArray):
    def __init__(self, shape, dtype, read):
        self.shape, self.dtype, self.read = shape, dtype, read

    def __getitem__(self, key):
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self.read)


def variable(file, name):
    each = file[name]
    is_field = file.has_tiles and name not in file.coordinates
    values = Values(each.shape, each.dtype, lambda index: read_field(file, name, index) if is_field else each[index])
    lazy = indexing.MemoryCachedArray(indexing.CopyOnWriteArray(indexing.LazilyIndexedArray(values)))
    return xarray.Variable(each.dimensions, lazy, each.attrs)
