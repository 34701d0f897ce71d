"""The variables of a result file by name."""

from collections.abc import Mapping

import h5py
import numpy as np

NOT_A_VARIABLE = "This is a netCDF dimension but not a netCDF variable"
ATTRIBUTES_OF_NETCDF = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Encoding", "_FillValue", "coordinates")


class Variable:
    """Values along named dimensions."""

    def __init__(self, dimensions, data, attrs):
        self.data, self.attrs = data, attrs
        self.dimensions, self.shape = tuple(dimensions), data.shape

    @property
    def dtype(self):
        return self.data.dtype

    def __getitem__(self, index):
        """Returns an array; `index` has up to one integer or slice per dimension."""
        return np.asarray(self.data[(index if isinstance(index, tuple) else (index,))[:len(self.shape)]])

    def rows_of_chunk(self, dimension):
        """Returns the extent of a chunk along one dimension."""
        return self.data.chunks[self.dimensions.index(dimension)] if self.data.chunks else 64

    @property
    def fill(self):
        """The value of points that are not computed."""
        if not self.data.id.get_create_plist().fill_value_defined():
            raise KeyError(f"{self.data.name} does not define the value of points that are not computed")
        return self.data.fillvalue


WITH_TILES = ("overturning spectrum", "overturning boundary")  # kinds of files


class Result(Mapping):
    """The variables of the root group, by name, and the attributes. Owns the file."""

    def __init__(self, file):
        self.file, self.filename = file, file.filename
        self.attrs = attributes_of(file)
        self.variables = {name: variable_of(data) for name, data in file.items() if is_variable(data)}
        named = dict.fromkeys(word for data in file.values() for word in text_of(data, "coordinates").split())
        self.coordinates = [*named, *(name for name, each in self.items() if each.dimensions == (name,))]
        self.dimensions, self.tile = (), ()  # of the fields of a spectrum or a boundary
        self.has_tiles = text_of(file, "kind") in WITH_TILES
        if self.has_tiles:
            checksums = self.run.get("checksum")
            if getattr(checksums, "dtype", None) != "uint64" or checksums.ndim != 1:
                raise OSError(f"\"{file.filename}\" lacks run/checksum, which marks the computed tiles")
            self.dimensions = tuple(text_of(checksums, "dimensions").split())
            self.tile = tuple(int(side) for side in checksums.attrs.get("tile_shape", ()))

    def __getitem__(self, name):
        return self.variables[name]

    def __iter__(self):
        return iter(self.variables)

    def __len__(self):
        return len(self.variables)

    def __hash__(self):
        return id(self)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.file.close()

    def text(self, attribute):
        return str(self.attrs.get(attribute, ""))

    @property
    def run(self):
        """The group of what is neither a coordinate nor a field."""
        return self.file.get("run", {})

    @property
    def sizes(self):
        """The length of every dimension, by name."""
        return {name: size for each in self.values() for name, size in zip(each.dimensions, each.shape)}

    def fields(self):
        """Returns the names of all fields of a spectrum."""
        return [name for name, each in self.items() if name not in self.coordinates
                and each.dimensions == self.dimensions]


def text_of(holder, attribute):
    value = holder.attrs.get(attribute, "")
    return value.decode() if isinstance(value, bytes) else str(value)


def attributes_of(holder):
    return {name: value.decode() if isinstance(value, bytes) else value for name, value in holder.attrs.items()
            if name not in ATTRIBUTES_OF_NETCDF and not name.startswith("_Netcdf4")}


def is_variable(data):
    return isinstance(data, h5py.Dataset) and not text_of(data, "NAME").startswith(NOT_A_VARIABLE)


def variable_of(data):
    if text_of(data, "CLASS") == "DIMENSION_SCALE":
        return Variable([data.name.lstrip("/")], data, attributes_of(data))
    names = []
    for axis in data.dims:
        if not len(axis) or not axis[0].name:
            raise KeyError(f"a dimension of {data.name} is missing")
        names.append(axis[0].name.lstrip("/"))
    if data.dtype == "S1":
        texts = [row.tobytes().rstrip(b"\0").decode(errors="replace") for row in data[...].reshape(-1, data.shape[-1])]
        return Variable(names[:-1], np.array(texts, object).reshape(data.shape[:-1]), attributes_of(data))
    return Variable(names, data, attributes_of(data))
