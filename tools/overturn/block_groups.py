"""Groups of the blocks of a result, by the values of a column of its table or of an axis; and the rows of a table that
are one object."""

import dataclasses

import numpy as np

MOST_GROUPS = 12  # curves that can be told apart
MOST_NUMBERS = 6  # different numbers with a group of their own
RANGES = 4  # of a column with more
NOT_GIVEN = "not given"  # an empty number


@dataclasses.dataclass(frozen=True, eq=False)
class Objects:
    """The rows of a table that are one thing, such as a rock in several azimuths: they have the same value of the
    column `azimuth_of` (and of `sample`, which distinguishes equally likely variants of an object), and, if each row has a
    motion of its own, the same motion."""

    dimension: str
    names: np.ndarray  # number of the object of each row
    samples: int  # of all objects together
    of_row: np.ndarray  # number of the thing of each row

    def largest(self, array):
        """Returns the largest values of the rows of each thing, without coordinates along them."""
        if self.dimension not in array.dims:
            return array
        import xarray
        order = np.argsort(self.of_row, kind="stable")
        first = np.flatnonzero(np.diff(self.of_row[order], prepend=-1))
        axis = array.get_axis_num(self.dimension)
        values = np.maximum.reduceat(array.values.take(order, axis), first, axis)
        return xarray.DataArray(values, dims=array.dims, attrs=array.attrs)

    def counted(self):
        """Returns the number of objects, and of what."""
        number, rows = len(np.unique(self.names)), len(self.names)
        return number, f"objects in {counted(rows, 'rows')}" + f" of {self.samples} samples" * (self.samples > number)


def objects_of(dataset):
    """Returns the Objects of a data set of overturn.open(), or None if its table has no column `azimuth_of`. Raises
    ValueError if a row has an empty azimuth_of or sample."""
    if "azimuth_of" not in dataset or not _is_of_blocks(dataset, "azimuth_of"):
        return None
    dimension, = dataset["azimuth_of"].dims
    numbers = {}
    for name in ("azimuth_of", "sample", "motion", "motion_name", "scale"):
        if name in dataset and dataset[name].dims == (dimension,):
            values = dataset[name].values
            empty = [not str(each).strip() or each != each for each in values.tolist()]
            if any(empty) and name in ("azimuth_of", "sample"):
                raise ValueError(f"row {empty.index(True) + 1} of the table has an empty {name}. Give every row the name "
                                 "of its object or the number of its sample.")
            numbers[name] = np.unique(values, return_inverse=True)[1]

    def combined(*names):
        chosen = np.stack([numbers[name] for name in names if name in numbers])
        return np.unique(chosen, axis=1, return_inverse=True)[1].ravel()
    return Objects(dimension, numbers["azimuth_of"], len(np.unique(combined("azimuth_of", "sample"))), combined(*numbers))


def groups_of(dataset, column):
    """Returns the parts of a data set of overturn.open(), by a text such as "kind = urn", "size = 0.5 m" or the
    name of an object. There is a group for each value; if there are more than MOST_NUMBERS numbers, a group for each
    quarter of the blocks or objects.

    Raises ValueError if the column does not distinguish the blocks, or has too many different texts."""
    from overturn.captions import UNITS  # needs h5py
    values, dimension = _property(dataset, column)
    objects = objects_of(dataset)
    is_of_rows = objects and objects.dimension == dimension
    labels = _labels(column, values, objects.names if is_of_rows else np.arange(len(values)))
    units = dataset[column].attrs.get("units", "1")
    unit = UNITS.get(units, units)
    name = "" if column == "azimuth_of" else column.replace("_", " ") + " = "  # an object has a name of its own
    return {f"{name}{label} {unit * (label != NOT_GIVEN)}".rstrip():
            dataset.isel({dimension: np.flatnonzero(labels == label)})
            for label in dict.fromkeys(labels[np.argsort(values, kind="stable")] if values.dtype.kind in "fiu"
                                       else sorted(labels))}


def blocks_at_one_site(dataset, column):
    """Returns the number of blocks at one site, which are those with different values of a column; the parts of a data
    set of overturn.open() that stand or overturn together; and the dimension along which they are. There is a part for
    each block or, if the table has a column `direction` but no `azimuth_of`, for each of its directions: such rows are
    sides of one block.

    Raises ValueError if the column does not distinguish the blocks, differs within an object, has an empty value, or if
    the blocks have motions of their own."""
    if column == "direction" and column in dataset.dims:
        raise ValueError("direction is an axis of this result: the unknown direction of the motion, which all blocks "
                         "of a site share, and over which the probability is a mean. Choose what distinguishes the "
                         "blocks, or give their directions as a column of the table.")
    values, dimension = _property(dataset, column)
    if dimension in dataset["motion"].dims:
        raise ValueError("each block has a motion of its own. The blocks of one site need a result in which every "
                         "block is under every motion.")
    kinds = np.unique(values)
    if kinds.dtype.kind == "f" and np.isnan(kinds).any():
        raise ValueError(f"{column} has empty values. Give every block a value, or choose another column.")
    parts = [np.flatnonzero(values == kind) for kind in kinds]
    objects = objects_of(dataset)
    if objects and objects.dimension == dimension:
        if sum(len(np.unique(objects.names[part])) for part in parts) > len(np.unique(objects.names)):
            raise ValueError(f"{column} differs within an object, whose rows fall together anyway. Choose \"azimuth_of\", "
                             "or another column that is the same in all rows of an object.")
    elif "direction" in dataset and dataset["direction"].dims == (dimension,):
        directions = dataset["direction"].values
        parts = [part[directions[part] == each] for part in parts for each in np.unique(directions[part])]
    return len(kinds), [dataset.isel({dimension: part}) for part in parts], dimension


def each_block(dataset, column):
    """Returns the parts of a data set of overturn.open() with one value of a column each, by its text: each block of
    blocks_at_one_site() alone."""
    values, dimension = _property(dataset, column)
    kinds = np.unique(values)
    texts = texts_of(kinds, 4) if kinds.dtype.kind in "fiu" else [str(kind) for kind in kinds]
    return {text: dataset.isel({dimension: np.flatnonzero(values == kind)}) for text, kind in zip(texts, kinds)}


def azimuths_of(dataset, column):
    """Returns the parts of a data set of overturn.open() at each azimuth, by a text such as "direction = 30 degree";
    and the azimuths. Raises ValueError if the column has texts or empty values."""
    values, dimension = _property(dataset, column)
    if values.dtype.kind not in "fiu" or not np.isfinite(values).all():
        raise ValueError(f"{column} has values that are no azimuths in degrees. Choose another column, such as "
                         "direction.")
    azimuths = np.unique(values)
    return azimuths, {f"{column} = {text} degree": dataset.isel({dimension: np.flatnonzero(values == azimuth)})
                      for azimuth, text in zip(azimuths, texts_of(azimuths, 6))}


def counted(number, kind):
    """Returns a number of things, such as "1 block" or "3 blocks"."""
    things, _, rest = kind.partition(" ")
    return f"{number} {things if number != 1 else things.removesuffix('s')}{' ' * bool(rest)}{rest}"


def _property(dataset, column):
    """Returns the values of a property of the blocks, and its dimension."""
    known = sorted(name for name in dataset.variables if _is_of_blocks(dataset, name))
    if column not in known:
        raise ValueError(f"{column!r} is not a property of the blocks. This result has {', '.join(known)}.")
    return dataset[column].values, *dataset[column].dims


def _is_of_blocks(dataset, name):
    dimensions = dataset[name].dims
    return (len(dimensions) == 1 and dimensions[0] in dataset["region"].dims
            and dimensions[0] not in ("motion", "scale", "pga"))


def _labels(column, values, blocks):
    """Returns the group of each value, of the blocks of these numbers."""
    if values.dtype.kind not in "fiu":
        labels = np.array([str(value).strip() or "(empty)" for value in values], object)
        count = len(set(labels))
        if count > MOST_GROUPS:
            raise ValueError(f"{column} has {count} different texts; a picture has at most {MOST_GROUPS} curves. "
                             "Choose another column.")
        return labels
    labels = np.full(len(values), NOT_GIVEN, object)
    known = np.isfinite(values)
    numbers = values[known]
    if len(np.unique(numbers)) <= MOST_NUMBERS:
        labels[known] = texts_of(numbers, 6)
        return labels
    of_blocks = np.unique(np.stack([blocks[known], numbers]), axis=1)[1]  # once, if it is the same in several rows
    ends = np.quantile(of_blocks, np.arange(1, RANGES) / RANGES)
    place = np.searchsorted(ends, numbers)
    of_range = [np.flatnonzero(place == each) for each in sorted(set(place))]
    texts = texts_of(np.array([end(numbers[some]) for some in of_range for end in (np.min, np.max)]), 4)
    for i, some in enumerate(of_range):
        labels[np.flatnonzero(known)[some]] = f"{texts[2 * i]} to {texts[2 * i + 1]}"
    return labels


def texts_of(numbers, digits):
    """Returns the numbers as texts of at least so many digits, by which different numbers differ."""
    different = len(np.unique(numbers))
    for enough in range(digits, 18):
        texts = [f"{number:.{enough}g}" for number in numbers]
        if len(set(texts)) == different:
            break
    return texts
