"""Fields of a spectrum or a boundary. A point whose tile has no checksum is not computed, whatever
value is stored: it is read as the fill value of the field."""

import numpy as np

from overturn.result_file import PlotError, run_data, text_attribute


def checksums_of(file):
    """Returns the dataset of the checksums of tiles; 0: not computed."""
    return run_data(file)["checksum"]


def dimensions_of(file):
    """Returns the names of the dimensions of every field, slowest first."""
    words = text_attribute(checksums_of(file), "dimensions").split()
    rows = "crossing" if "crossing" in file else "amplitude"
    return words or ["slenderness", "restitution", rows, "frequency"]  # of the first format


def slenderness_and_restitution(file, outer):
    """Returns slenderness [rad] and restitution of the block at one index of the outer
    dimensions."""
    place = dict(zip(dimensions_of(file), outer))
    i, j = place["slenderness"], place["restitution"]
    return float(file["slenderness"][i]), float(file["restitution_ratio"][i, j])


def fields_of(file):
    """Returns the names of all variables over all dimensions."""
    rank = len(dimensions_of(file))
    return [name for name, data in file.items() if getattr(data, "ndim", 0) == rank]


def tile_shape(file):
    """Returns the rows and columns of a tile; tiles at the upper edges may be smaller."""
    attributes = checksums_of(file).attrs
    if "tile_shape" in attributes:
        return tuple(int(extent) for extent in attributes["tile_shape"][-2:])
    return int(attributes["amplitude_extent"]), int(attributes["frequency_extent"])


def count_tiles(file):
    """Returns the number of computed tiles and of all tiles."""
    checksums = checksums_of(file)[:]
    return np.count_nonzero(checksums), len(checksums)


def computed(file, field, outer, rows):
    """Returns a mask of the points in computed tiles, for some rows at one index of the outer
    dimensions. Tiles are numbered in the order of the dimensions, the last varying fastest."""
    *outer_shape, height, width = field.shape
    high, wide = tile_shape(file)
    up, across = -(-height // high), -(-width // wide)
    checksums = checksums_of(file)
    if len(checksums) != int(np.prod(outer_shape)) * up * across:
        raise PlotError(f"\"{file.filename}\" is damaged: it has {len(checksums)} checksums, which is "
                        "not its number of tiles.")
    start, stop, _ = rows.indices(height)
    first, last = start // high, -(-stop // high)
    plane = int(np.ravel_multi_index(outer, outer_shape))
    marks = checksums[(plane * up + first) * across:(plane * up + last) * across] != 0
    points = marks.reshape(-1, across).repeat(high, axis=0).repeat(wide, axis=1)
    return points[start - first * high:stop - first * high, :width]


def read_field(file, name, outer, rows=slice(None)):
    """Reads some rows of a field, at one index of the outer dimensions."""
    field = file[name]
    values = field[(*outer, rows)]
    values[~computed(file, field, outer, rows)] = fill_value(field)
    return values


def fill_value(field):
    if not field.id.get_create_plist().fill_value_defined():
        raise PlotError(f"\"{field.file.filename}\" is damaged: {field.name} does not define the "
                        "value of points that are not computed.")
    return field.fillvalue


def has_values_without_mark(file, name, outer, rows):
    """Whether a point that is not computed has a value other than the fill value."""
    field = file[name]
    without = ~computed(file, field, outer, rows)
    if not without.any():
        return False
    values = field[(*outer, rows)][without]
    return not np.array_equal(values, np.full_like(values, fill_value(field)),
                              equal_nan=values.dtype.kind == "f")
