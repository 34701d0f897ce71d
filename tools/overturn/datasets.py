"""Result files as data sets of xarray."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def open(path: str | os.PathLike[str]) -> xarray.Dataset:
    """Opens a result file: its coordinates, its fields and its attributes (docs/results.md). Fields are
    read when they are used. In an unfinished file, points that are not computed have the values that mean
    "not computed" (region: 255; double: NaN).

    Raises ValueError if the file was not written by overturn, OSError if it cannot be read.
    """
    try:
        import xarray
    except ImportError as error:
        raise ImportError(f"{error} (Python: {sys.executable}). Install xarray and h5netcdf (Debian: "
                          "python3-xarray and python3-h5netcdf, for /usr/bin/python3).") from error
    os.stat(path)  # xarray reports a missing file as an unknown format
    file = xarray.open_dataset(path)
    if "program_version" not in file.attrs:
        file.close()
        raise ValueError(f"\"{path}\" was not written by overturn.")
    # Before format 3, texts, checksums and the scan of a boundary were in the root group.
    # Attributes are read through attrs, because file.kind is a column if a table of blocks has one of that name.
    has_tiles = file.attrs["kind"] in ("overturning spectrum", "overturning boundary")
    dataset = _without_unmarked_tiles(file, path) if has_tiles else file
    strangers = [name for name, variable in dataset.variables.items()
                 if not variable.dims or name in ("checksum", "tile") or name.startswith("scan_")]
    dataset = dataset.drop_vars(strangers)
    dataset = dataset.set_coords([name for name in ("motion_name",) if name in dataset])
    dataset.encoding["source"] = os.path.abspath(path)
    dataset.set_close(file.close)
    return dataset


def _without_unmarked_tiles(dataset, path):
    """Replaces the values of tiles that have no checksum: they are not computed, whatever is stored."""
    import h5py
    import numpy as np
    import xarray

    from overturn.fields import checksums_of, dimensions_of, fill_value, tile_shape
    with h5py.File(path) as file:
        marks = checksums_of(file)[:] != 0
        if marks.all():
            return dataset
        dimensions = dimensions_of(file)
        shape = [dataset.sizes[dimension] for dimension in dimensions]
        # Of the first format: tiles of the last two dimensions.
        tile = checksums_of(file).attrs.get("tile_shape", [1, 1, *tile_shape(file)])
        fills = {name: fill_value(file[name]) for name, field in dataset.data_vars.items()
                 if dimensions[-1] in field.dims and set(field.dims) <= set(dimensions)}
    marks = marks.reshape([-(-extent // side) for extent, side in zip(shape, tile)])
    for axis, (extent, side) in enumerate(zip(shape, tile)):
        marks = np.take(np.repeat(marks, side, axis), range(extent), axis)
    computed = xarray.DataArray(marks, dims=dimensions)
    masked = {}
    for name, fill in fills.items():
        field = dataset[name]
        lacking = {dimension: 0 for dimension in dimensions if dimension not in field.dims}
        masked[name] = field.where(computed.isel(lacking), fill)
    return dataset.assign(masked)
