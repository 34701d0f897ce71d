"""Fields of a spectrum or a boundary. A point whose tile has no checksum is not computed, whatever
value is stored: it is read as the fill value of the field."""

import functools

import numpy as np

from overturn.tool import ToolError


@functools.cache
def computed_tiles(file):
    """Returns which tiles are computed, in an array with the dimensions of the fields."""
    checksums = file.run["checksum"][:]
    sizes = file.sizes
    tiles = [-(-sizes[name] // side) for name, side in zip(file.dimensions, file.tile)]
    if len(checksums) != np.prod(tiles, dtype=int):
        raise ToolError(f"\"{file.filename}\" is damaged: it has {len(checksums)} checksums, which is not its number "
                        "of tiles.")
    return checksums.reshape(tiles) != 0


def count_computed(file):
    """Returns the numbers of computed tiles and of all tiles, and what these are; of a data set, they are points."""
    is_computed = computed_tiles(file) if file.has_tiles else file.computed_points()
    return int(np.count_nonzero(is_computed)), is_computed.size, "tiles" if file.has_tiles else "points"


def read_field(file, name, index=()):
    """Reads part of a field; `index` has up to one integer or slice per dimension."""
    field = file[name]
    given = dict(zip(field.dimensions, index))
    sizes = file.sizes
    values = np.array(field[index])
    if not file.has_tiles:
        return values
    tiles = [np.atleast_1d(np.arange(sizes[dimension])[given.get(dimension, slice(None))]) // side
             if dimension in field.dimensions else [0] for dimension, side in zip(file.dimensions, file.tile)]
    values[~computed_tiles(file)[np.ix_(*tiles)].reshape(values.shape)] = field.fill
    return values
