"""The values that a result file stores, and how those of two files differ."""

import collections
import shutil

import h5py
import numpy as np

# Values of the free motion, which functions of the C library determine whose last digits depend on the
# processor: asinh, atan, cosh, log, sinh and tan. They may differ by this number of units of the last place,
# where `compare` is told so; the motion in a history after that of the ground, of the last place of the
# largest value.
BY_C_LIBRARY = {"fall_time"}
LAST_PLACES = 4

# Not compared: layout, texts of the job, and times.
NOT_COMPARED = {
    "format_version", "seconds_per_point", "run/checksum", "run/tile", "run/run_token",
    "run/job_given", "run/job_overrides", "run/job_resolved",
}
ATTRIBUTES_NOT_REPORTED = {
    "long_name", "comment", "coordinates", "program_commit", "CLASS", "NAME", "DIMENSION_LIST",
    "REFERENCE_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates",
}

Stored = collections.namedtuple("Stored", "values dimensions")


def stored(file):
    """What the file stores, by name: the datasets of all groups, and the numbers among its
    attributes, which are results of a history."""
    found = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset) and not is_bare_dimension(item):
            found[name] = Stored(item[()], [scales[0].name.lstrip("/") if len(scales) else name
                                            for scales in item.dims])

    file.visititems(add)
    for name, value in file.attrs.items():
        if is_number(value):
            found.setdefault(name, Stored(value, []))
    return {name: values for name, values in found.items() if name not in NOT_COMPARED}


def is_bare_dimension(dataset):
    return as_text(dataset.attrs.get("NAME", "")).startswith("This is a netCDF dimension but not")


def is_number(value):
    return np.asarray(value).dtype.kind in "iuf"


def as_text(value):
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def coordinates(file):
    """Names of the dimensions, and of the coordinates that the fields name."""
    names = set()
    for item in (item for item in file.values() if isinstance(item, h5py.Dataset)):
        names.update(as_text(item.attrs.get("coordinates", "")).split())
        if as_text(item.attrs.get("CLASS", "")) == "DIMENSION_SCALE":
            names.add(item.name.lstrip("/"))
    return names


def allowed_difference(old, name, c_library_differs, nearly):
    """How far the values of this name may differ: where another processor computed them, and if the name is in
    `nearly`."""
    values = old[name].values
    if name in nearly:
        return 1e-9 * np.abs(values)
    if not c_library_differs:
        return 0
    if name in BY_C_LIBRARY:
        return LAST_PLACES * np.spacing(np.abs(values))
    if "end_of_pulse" in old and name != "time" and old[name].dimensions == ["time"]:
        largest = np.max(np.abs(values), where=np.isfinite(values), initial=0)
        return LAST_PLACES * np.spacing(largest) * (old["time"].values > old["end_of_pulse"].values)
    return 0


def difference(old, new, allowed=0):
    """How the values differ, apart from dimensions of length 1; empty if the types are the same and
    the bits are, apart from allowed differences, or if both are NaN."""
    old, new, allowed = np.squeeze(old), np.squeeze(new), np.squeeze(allowed)
    if old.dtype != new.dtype or old.shape != new.shape:
        return f"{old.dtype}{old.shape} has become {new.dtype}{new.shape}"
    same = np.asarray(bits(old) == bits(new))
    if old.dtype.kind == "f":
        same |= np.isnan(old) & np.isnan(new)
        with np.errstate(invalid="ignore"):  # of infinite values
            same |= (allowed > 0) & (np.abs(old - new) <= allowed)
    if same.all():
        return ""
    at = tuple(int(index) for index in np.argwhere(~same)[0])
    return (f"{np.count_nonzero(~same)} of {same.size} values differ; at {at}, {old[at]!r} has become "
            f"{new[at]!r}")


def bits(values):
    """Numbers as integers of the same bits; texts as they are."""
    if values.dtype.kind not in "iuf":
        return values
    return np.frombuffer(values.tobytes(), f"u{values.dtype.itemsize}").reshape(values.shape)


def compare(old_path, new_path, notes, c_library_differs=False, nearly=()):
    """The differences of the stored values, as texts. Adds what is only reported to the counter
    `notes`: differing attributes and new coordinates."""
    with h5py.File(old_path) as old_file, h5py.File(new_path) as new_file:
        old, new = stored(old_file), stored(new_file)
        found = []
        for name, before in old.items():
            if name in new:
                allowed = allowed_difference(old, name, c_library_differs, nearly)
                text = difference(before.values, new[name].values, allowed)
                found += [f"{name}: {text}"] if text else []
            else:
                found.append(f"{name}: missing")
        for name in new.keys() - old.keys():
            if name in coordinates(new_file):
                notes[f"coordinate {name} added"] += 1
            else:
                found.append(f"{name}: not in the old file")
        note_attributes("the file", old_file, new_file, notes)
        for name in old.keys() & new.keys():
            if name in old_file and name in new_file:
                note_attributes(name, old_file[name], new_file[name], notes)
    return found


def note_attributes(name, old, new, notes):
    for key in (old.attrs.keys() | new.attrs.keys()) - ATTRIBUTES_NOT_REPORTED:
        before, after = old.attrs.get(key), new.attrs.get(key)
        is_compared = isinstance(old, h5py.File) and is_number(before)
        before, after = as_text(before), as_text(after)
        if not is_compared and before != after:
            notes[f"attribute {key} of {name}: {before:.60} has become {after:.60}"] += 1


def unnoticed_flips(path):
    """Names of what the file stores that may change by a bit without being reported, alone, by
    `compare`: for each, the last bit of one value is flipped in a copy."""
    copy = path.with_suffix(".flipped")
    unnoticed = []
    with h5py.File(path) as file:
        names = {name: np.array(item.values) for name, item in stored(file).items()}
    for name, values in names.items():
        flat = values.reshape(-1)
        places = np.flatnonzero(flat == flat)  # not NaN
        if len(places) == 0:
            continue
        flat.view("u1")[places[-1] * values.dtype.itemsize] ^= 1  # little-endian
        shutil.copy(path, copy)
        with h5py.File(copy, "r+") as file:
            if name in file:
                file[name][...] = values
            else:
                file.attrs.modify(name, values)
        found = compare(path, copy, collections.Counter())
        if [text.split(":")[0] for text in found] != [name]:
            unnoticed.append(name)
    copy.unlink(missing_ok=True)
    return unnoticed
