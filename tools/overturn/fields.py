"""Fields of a spectrum or a boundary, as every reader gets them. A point whose tile has no mark is
not computed, whatever value is stored: it reads as the field's fill value."""

import numpy as np

from overturn.result_file import PlotError, text_attribute


def dimensions_of(file):
    """Their names, slowest first: those of every field."""
    words = text_attribute(file["checksum"], "dimensions").split()
    rows = "crossing" if "crossing" in file else "amplitude"
    return words or ["slenderness", "restitution", rows, "frequency"]  # of the first format


def fields_of(file):
    """The names of all variables over all dimensions."""
    rank = len(dimensions_of(file))
    return [name for name, data in file.items() if getattr(data, "ndim", 0) == rank]


def tile_shape(file):
    """Rows and columns of a tile, smaller at the far edges."""
    attributes = file["checksum"].attrs
    if "tile_shape" in attributes:
        return tuple(int(extent) for extent in attributes["tile_shape"][-2:])
    return int(attributes["amplitude_extent"]), int(attributes["frequency_extent"])


def count_tiles(file):
    """How many are computed, and how many there are."""
    checksums = file["checksum"][:]
    return np.count_nonzero(checksums), len(checksums)


def computed(file, field, outer, rows):
    """Which points of some rows, at one place of the outer dimensions, lie in computed tiles. Tiles
    are numbered in the order of the dimensions, the last of which counts fastest."""
    *outer_shape, height, width = field.shape
    high, wide = tile_shape(file)
    up, across = -(-height // high), -(-width // wide)
    if len(file["checksum"]) != int(np.prod(outer_shape)) * up * across:
        raise PlotError(f"\"{file.filename}\" is damaged: it has {len(file['checksum'])} "
                        "checksums, but not as many tiles.")
    start, stop, _ = rows.indices(height)
    first, last = start // high, -(-stop // high)
    plane = int(np.ravel_multi_index(outer, outer_shape))
    marks = file["checksum"][(plane * up + first) * across:(plane * up + last) * across] != 0
    points = marks.reshape(-1, across).repeat(high, axis=0).repeat(wide, axis=1)
    return points[start - first * high:stop - first * high, :width]


def read_field(file, name, outer, rows=slice(None)):
    """Some rows of a field, at one place of the outer dimensions."""
    field = file[name]
    values = field[(*outer, rows)]
    values[~computed(file, field, outer, rows)] = fill_value(field)
    return values


def fill_value(field):
    if not field.id.get_create_plist().fill_value_defined():
        raise PlotError(f"\"{field.file.filename}\" is damaged: {field.name} does not say which "
                        "value is not computed.")
    return field.fillvalue


def has_values_without_mark(file, name, outer, rows):
    """Whether anything but the fill value is stored where nothing is computed."""
    field = file[name]
    without = ~computed(file, field, outer, rows)
    if not without.any():
        return False
    values = field[(*outer, rows)][without]
    return not np.array_equal(values, np.full_like(values, fill_value(field)),
                              equal_nan=values.dtype.kind == "f")
