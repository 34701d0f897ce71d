"""A spectrum in a data set of overturn.open(), of which parts may have been selected and values changed, as tools read
files."""

import h5py
import numpy as np

from overturn.regions import LEFT_OUT, NOT_COMPUTED, REGIONS
from overturn.result_file import Result, Variable


class DatasetResult(Result):
    """The variables of a data set by name. The file that it was read from, if any, gives what the job says only."""

    PARTS = "points"

    def __init__(self, dataset):
        source = dataset.encoding.get("source", "")
        self.file = h5py.File(source) if h5py.is_hdf5(source) else None
        self.filename = source or "the data set"
        self.tiles = None
        self.attrs = dict(dataset.attrs)
        self.dimensions = dataset["region"].dims if "region" in dataset else ()
        dataset = in_ascending_order(dataset, self.dimensions)
        self.variables = {name: Variable(each.dims, Codes(each) if name == "region" else each, each.attrs)
                          for name, each in dataset.variables.items()}
        self.coordinates = [*dataset.coords]

    @property
    def are_computed(self):
        return self["region"][()] != NOT_COMPUTED


class Codes:
    """Region codes; NaN, as after where(), is LEFT_OUT."""

    dtype = np.dtype(np.uint8)
    KNOWN = [*REGIONS, NOT_COMPUTED, LEFT_OUT]

    def __init__(self, variable):
        self.variable, self.shape = variable, variable.shape

    def __getitem__(self, index):
        given = np.asarray(self.variable[index])
        codes = np.where(np.isnan(given), LEFT_OUT, given) if given.dtype.kind == "f" else given
        if not np.isin(codes, self.KNOWN).all():
            raise ValueError("region has values that are no region codes, as after interp(). Choose points by sel(), "
                             "isel() or where().")
        return codes.astype(np.uint8)


def in_ascending_order(dataset, dimensions):
    for name in dimensions:
        if name not in dataset.coords or dataset[name].dtype.kind not in "fiu":
            raise ValueError(f"the dimension {name} of region has no coordinate of numbers, which its axis needs.")
        values = np.sort(dataset[name].values)
        if np.isnan(values).any() or (np.diff(values) == 0).any():
            raise ValueError(f"{name} has a value twice, or none, along its dimension: its points have no place on an "
                             "axis.")
        dataset = dataset if (values == dataset[name].values).all() else dataset.sortby(name)
    return dataset
