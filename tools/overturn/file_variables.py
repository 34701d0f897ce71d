"""The variables of a result file by name, in the names and shapes of format 4, whether it has this format or
format 3."""

from collections.abc import Mapping

import h5py
import numpy as np

NOT_A_VARIABLE = "This is a netCDF dimension but not a netCDF variable"
ATTRIBUTES_OF_NETCDF = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Encoding", "_FillValue", "coordinates")


class Variable:
    """Values along named dimensions. `hidden` are further dimensions of `data`, of length 1."""

    def __init__(self, dimensions, data, attrs, hidden=()):
        self.data, self.attrs, self.hidden = data, attrs, hidden
        self.dimensions = tuple(dimensions)
        self.shape = tuple(size for axis, size in enumerate(data.shape) if axis not in hidden)

    @property
    def dtype(self):
        return self.data.dtype

    def __getitem__(self, index):
        """Returns an array; `index` has up to one integer or slice per dimension."""
        given = list(index if isinstance(index, tuple) else (index,))[:len(self.shape)]
        given += [slice(None)] * (len(self.shape) - len(given))
        return np.asarray(self.data[tuple(0 if axis in self.hidden else given.pop(0)
                                          for axis in range(len(self.data.shape)))])

    def rows_of_chunk(self, dimension):
        """Returns the extent of a chunk along one dimension."""
        axis = [i for i in range(len(self.data.shape)) if i not in self.hidden][self.dimensions.index(dimension)]
        return self.data.chunks[axis] if self.data.chunks else 64

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
        if self.attrs.get("format_version") == 3:
            present_as_format_4(self)

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


def present_as_format_4(result):
    """Renames variables, and hides dimensions of length 1 other than the last two: format 3 had them for single
    values."""
    variables = result.variables
    names = {}
    if "restitution" in variables and variables["restitution"].attrs.pop("of", "") == "maximum":
        names["restitution"] = "restitution_of_maximum"
    if "restitution" in variables and not names:
        variables.pop("restitution_ratio", None)  # the same
    names["restitution_ratio"] = "restitution"
    if "pga" in variables and variables["pga"].dimensions == ("motion",):
        names |= {"pga": "record_pga", "scaled_pga": "pga"}
    single = {name for name in result.dimensions[:-2] if result.sizes[name] == 1}

    def renamed(all_names):
        return [names.get(name, name) for name in all_names]

    def presented(variable):
        hidden = [axis for axis, name in enumerate(variable.dimensions) if name in single]
        return Variable(renamed(name for name in variable.dimensions if name not in single), variable.data,
                        variable.attrs, hidden)
    result.variables = {names.get(name, name): presented(each) for name, each in variables.items()}
    result.coordinates = [name for name in dict.fromkeys(renamed(result.coordinates)) if name in result.variables]
    kept = [axis for axis, name in enumerate(result.dimensions) if name not in single]
    result.dimensions = tuple(renamed(result.dimensions[axis] for axis in kept))
    result.tile = tuple(result.tile[axis] for axis in kept)
    if "motion_number" in result.variables:  # of blocks with motions of their own
        numbers = result.variables.pop("motion_number")
        result.coordinates.remove("motion_number")
        for name, each in result.variables.items():
            if each.dimensions == ("motion",):
                result.variables[name] = Variable(numbers.dimensions, each[:][numbers[:].astype(int) - 1], each.attrs)
    for name, new in (("half_width", "half_width"), ("half_height", "half_height"), ("half_diagonal", "size")):
        if name in result.attrs:
            value = result.attrs.pop(name)
            if result.tile:
                result.variables[new] = Variable((), np.array(value), {"units": "m"})
                result.coordinates.append(new)
            else:  # of a history
                result.attrs[new] = value
    if result.text("kind") == "rocking history":
        add_derived(result.attrs)


def add_derived(attrs):
    """Adds what format 4 says of the point of a history in addition."""
    if "size" in attrs:
        attrs.setdefault("frequency_parameter", np.sqrt(3 * attrs["gravity"] / (4 * attrs["size"])))
    if {"frequency", "frequency_parameter"} <= attrs.keys():
        attrs.setdefault("pulse_period", 2 * np.pi / (attrs["frequency"] * attrs["frequency_parameter"]))
    if "amplitude" in attrs:
        alpha = attrs["slenderness"]
        attrs.setdefault("pga", attrs["amplitude"] * (alpha if attrs["theory"] == "linear" else np.tan(alpha)))
