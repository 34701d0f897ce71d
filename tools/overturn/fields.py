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


def count_tiles(file):
    """Returns the number of computed tiles and of all tiles."""
    tiles = computed_tiles(file)
    return int(np.count_nonzero(tiles)), tiles.size


def read_field(file, name, index=()):
    """Reads part of a field; `index` has up to one integer or slice per dimension."""
    field = file[name]
    given = dict(zip(field.dimensions, index))
    sizes = file.sizes
    values = np.array(field[index])
    tiles = [np.atleast_1d(np.arange(sizes[dimension])[given.get(dimension, slice(None))]) // side
             if dimension in field.dimensions else [0] for dimension, side in zip(file.dimensions, file.tile)]
    values[~computed_tiles(file)[np.ix_(*tiles)].reshape(values.shape)] = field.fill
    return values
