"""Reading of result files: their variables by name, as arrays. The points of a tile without a checksum are not computed,
whatever values are stored: they are read as the fill values of their fields."""

import contextlib
import math
import os
from collections.abc import Mapping

import h5py
import numpy as np
from overturn.output_file import OutputError
from overturn.tool import ToolError

HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
FORMAT, FORMER_FORMAT = 5, 4  # in the former, the field friction_demand is called friction
SPECTRUM, BOUNDARY, HISTORY, STUDY = "overturning spectrum", "overturning boundary", "rocking history", "accuracy study"
KINDS = {SPECTRUM: "a spectrum written by overturn run", BOUNDARY: "a boundary written by overturn boundary",
         HISTORY: "a history written by overturn history", STUDY: "a study written by overturn accuracy"}
TOOLS = {SPECTRUM: "plot_spectrum", BOUNDARY: "plot_boundary", HISTORY: "plot_history", STUDY: "plot_accuracy"}
ROWS = 64  # to be read at a time, or more, because a plane may not fit in memory
NOT_A_VARIABLE = "This is a netCDF dimension but not a netCDF variable"
ATTRIBUTES_OF_NETCDF = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "_Encoding", "_FillValue", "coordinates")


class Variable:
    """Values along named dimensions; of a field of a file, with its tiles."""

    def __init__(self, dimensions, data, attrs):
        self.dimensions, self.data, self.attrs, self.tiles = tuple(dimensions), data, attrs, None
        self.shape, self.dtype = data.shape, data.dtype

    def __getitem__(self, index):
        """Returns an array; `index` has up to one integer or slice per dimension."""
        index = (index if isinstance(index, tuple) else (index,))[:len(self.shape)]
        values = np.asarray(self.data[index])
        if self.tiles is not None:
            if not self.data.id.get_create_plist().fill_value_defined():
                raise KeyError(f"{self.data.name} does not define the value of points that are not computed")
            values[self.tiles.are_missing(self, index).reshape(values.shape)] = self.data.fillvalue
        return values

    def at(self, places):
        """Returns an array; `places` has an integer or a slice for some of the dimensions, by name."""
        return self[tuple(places.get(name, slice(None)) for name in self.dimensions)]


class Tiles:
    """Boxes of points, which are computed if they have a checksum."""

    def __init__(self, checksums, sizes):
        """`checksums` is a data set of the file; `sizes` are those of the dimensions, by name."""
        if getattr(checksums, "dtype", None) != "uint64" or checksums.ndim != 1:
            raise OSError("it lacks run/checksum, which marks the computed tiles")
        #: lengths of a tile along the dimensions of the fields, by name
        self.sides = dict(zip(text_of(checksums, "dimensions").split(), map(int, checksums.attrs.get("tile_shape", ()))))
        numbers = [-(-sizes[name] // side) for name, side in self.sides.items()]
        if len(checksums) != math.prod(numbers):
            raise OSError(f"it has {len(checksums)} checksums, which is not its number of tiles")
        self.are_computed = checksums[:].reshape(numbers) != 0

    def are_missing(self, variable, index):
        """Returns of some points of a variable whether they are not computed."""
        given = dict(zip(variable.dimensions, index))
        sizes = dict(zip(variable.dimensions, variable.shape))
        places = [np.atleast_1d(np.arange(sizes[name])[given.get(name, slice(None))]) // side if name in sizes else [0]
                  for name, side in self.sides.items()]
        return ~self.are_computed[np.ix_(*places)]


class Result(Mapping):
    """The variables of a result file by name, and its attributes. Owns the file."""

    PARTS = "tiles"  # that are computed one by one

    def __init__(self, file):
        self.file, self.filename = file, file.filename
        self.attrs = attributes_of(file)
        self.variables = {name: variable_of(data) for name, data in file.items() if is_variable(data)}
        if self.attrs.get("format_version") == FORMER_FORMAT and "friction" in self.variables:
            self.variables["friction_demand"] = self.variables.pop("friction")
        named = dict.fromkeys(word for data in file.values() for word in text_of(data, "coordinates").split())
        self.coordinates = [*named, *(name for name, each in self.items() if each.dimensions == (name,))]
        self.tiles = Tiles(self.run.get("checksum"), self.sizes) if self.text("kind") in (SPECTRUM, BOUNDARY) else None
        self.dimensions = tuple(self.tiles.sides) if self.tiles else ()  # of the fields
        for name in self.keys() - self.coordinates:
            self[name].tiles = self.tiles

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
        if self.file is not None:
            self.file.close()

    def text(self, attribute):
        return str(self.attrs.get(attribute, ""))

    @property
    def run(self):
        """The group of what is neither a coordinate nor a field."""
        return {} if self.file is None else self.file.get("run", {})

    def job_text(self, name):
        """Returns a text about the job; empty if there is none."""
        return self.run[name][:].tobytes().decode(errors="replace") if name in self.run else ""

    def events(self):
        """Returns the values of every variable of the events of a history, by name; kinds are words."""
        variables = {name: data for name, data in self.file["events"].items() if is_variable(data)}
        kinds = np.array(text_of(variables["kind"], "flag_meanings").split(), object)
        return {name: kinds[data[:]] if name == "kind" else data[:] for name, data in variables.items()}

    @property
    def sizes(self):
        """The length of every dimension, by name."""
        return {name: size for each in self.values() for name, size in zip(each.dimensions, each.shape)}

    def expect_fields(self, names):
        for name in names:
            if name not in self:
                raise ToolError(f"\"{self.filename}\": this file has no field {name}; add it to output.fields.")

    def rows(self, dimension):
        """Returns how many rows along a dimension to read at a time."""
        side = self.tiles.sides.get(dimension, ROWS) if self.tiles else ROWS
        return side * -(-ROWS // side)

    @property
    def are_computed(self):
        """Whether each of its parts is computed."""
        return self.tiles.are_computed


def unfinished_words(file):
    """Returns the note on missing tiles, if there are any; of a part of a job, with its number."""
    done, number = int(np.count_nonzero(file.are_computed)), file.are_computed.size
    part = f"part {file.attrs['part']} of {file.attrs['parts']}, " if "part" in file.attrs else ""
    return [f"{part}unfinished: {done} of {number} {file.PARTS} computed"] * (done < number)


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


def open_file(path, kind=None):
    """Opens a file of one kind, or of any. Raises OSError if it cannot be read, ValueError if it is of another kind or
    format."""
    try:
        with open(path, "rb") as file:
            if file.read(len(HDF5_SIGNATURE)) != HDF5_SIGNATURE:
                raise OSError("it is not an HDF5 file")
        file = h5py.File(path)
    except OSError as error:
        raise type(error)(f"cannot read \"{path}\": {error.strerror or error}.") from error
    with contextlib.ExitStack() as stack:
        stack.enter_context(file)
        found = text_of(file, "kind")
        if found not in ([kind] if kind else KINDS):
            advice = f", but {KINDS[found]}. Draw it with {TOOLS[found]}" if found in KINDS else ""
            raise ValueError(f"\"{path}\" is not {KINDS.get(kind, 'a result of overturn')}{advice}.")
        if (version := file.attrs.get("format_version", 1)) not in (FORMAT, FORMER_FORMAT):
            writer = "overturn 2.0" if version == 3 else "the overturn that wrote it"
            advice = "Use a newer overturn" if version > FORMAT else (
                f"Read it with {writer}, or compute it again with this version")
            raise ValueError(f"\"{path}\" has format version {version}, but this version of overturn reads versions "
                             f"{FORMER_FORMAT} and {FORMAT}. {advice}.")
        try:
            result = Result(file)
        except (OSError, KeyError) as error:
            raise OSError(f"\"{path}\" is damaged: {error}.") from error
        stack.pop_all()
        return result


@contextlib.contextmanager
def open_result(path, kind=None, fields=()):
    """Opens a file that has these fields for a tool, with open_file(), and reports parts of it that are missing or
    malformed. In place of the path of a spectrum, a data set may be given, see overturn.open()."""
    if hasattr(path, "data_vars") and "kind" not in path.attrs:
        raise ValueError("the data set has no attribute kind. Give one of overturn.open(), or keep the attributes of it: "
                         "xarray.set_options(keep_attrs=True).")
    if hasattr(path, "data_vars") and path.attrs["kind"] == SPECTRUM == kind:
        from overturn.dataset_result import DatasetResult
        result = DatasetResult(path)
    else:
        path = path_of(path)
        try:
            result = open_file(path, kind)
        except (OSError, ValueError) as error:
            raise ToolError(str(error)) from error
    with result, damage_reported(result.filename):
        result.expect_fields(fields)
        yield result


def path_of(result):
    """Returns the path of a result file, given by its path or by the data set that overturn.open() returned for
    it. Raises ValueError for a part of a data set, or a changed one: its picture would be that of the file."""
    if not hasattr(result, "encoding"):
        return os.fspath(result)
    path = result.encoding.get("source")
    if path is None or not hasattr(result, "data_vars"):
        raise ValueError("this is no data set of overturn.open(). Pass one, or the path of the file.")
    from overturn.datasets import opened
    with opened(path)[0] as whole:
        if not whole.identical(result):
            raise ValueError(f"the data set differs from \"{path}\", and only whole boundaries and histories are drawn. "
                             "Pass the path, and choose a part by the arguments of the function.")
    return path


@contextlib.contextmanager
def damage_reported(path, *also):
    """Reports missing or malformed parts of a file, and errors of the given types, as damage to the file."""
    try:
        yield
    except OutputError:
        raise
    except (OSError, KeyError, *also) as error:
        raise ToolError(f"\"{path}\" is damaged: {error}.") from error
