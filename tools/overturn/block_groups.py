"""Groups of the blocks of a result, by the values of a column of its table or of an axis."""

import numpy as np

MOST_GROUPS = 12  # curves that can be told apart
MOST_NUMBERS = 6  # different numbers with a group of their own
RANGES = 4  # of a column with more
NOT_GIVEN = "not given"  # an empty number


def groups_of(dataset, column):
    """Returns the parts of a data set of overturn.open(), by a text such as "kind = urn" or "size = 0.5 m". There is a
    group for each value; if there are more than MOST_NUMBERS numbers, a group for each quarter of the blocks.

    Raises ValueError if the column does not distinguish the blocks, or has too many different texts."""
    from overturn.captions import UNITS  # needs h5py
    values, dimension = _property(dataset, column)
    labels = _labels(column, values)
    units = dataset[column].attrs.get("units", "1")
    unit = UNITS.get(units, units)
    name = column.replace("_", " ")
    return {f"{name} = {label} {unit * (label != NOT_GIVEN)}".rstrip():
            dataset.isel({dimension: np.flatnonzero(labels == label)})
            for label in dict.fromkeys(labels[np.argsort(values, kind="stable")] if values.dtype.kind in "fiu"
                                       else sorted(labels))}


def blocks_at_one_site(dataset, column):
    """Returns the parts of a data set of overturn.open() with equal values of a column: one for each block of a site.

    Raises ValueError if the column does not distinguish the blocks, has an empty value, or if the blocks have motions
    of their own."""
    values, dimension = _property(dataset, column)
    if dimension in dataset["motion"].dims:
        raise ValueError("each block has a motion of its own. The blocks of one site need a result in which every "
                         "block is under every motion.")
    kinds = np.unique(values)
    if kinds.dtype.kind == "f" and np.isnan(kinds).any():
        raise ValueError(f"{column} has empty values. Give every block a value, or choose another column.")
    return [dataset.isel({dimension: np.flatnonzero(values == kind)}) for kind in kinds]


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


def _labels(column, values):
    """Returns the group of each value."""
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
    ends = np.quantile(numbers, np.arange(1, RANGES) / RANGES)
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
