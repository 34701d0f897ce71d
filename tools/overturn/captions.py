"""Words in pictures: ground motion, block, title."""

import functools
import math
import pathlib

import numpy as np
from overturn.motion_words import is_of_floor, worded
from overturn.result_file import unfinished_words
from overturn.spectrum_planes import EQUIVALENTS, JOB, PHYSICAL
from overturn.tables import RATES, SIZES, STRENGTHS

PULSES = {"symmetric_ricker": "symmetric Ricker wavelet",
          "antisymmetric_ricker": "antisymmetric Ricker wavelet",
          "mavroeidis_papageorgiou": "Mavroeidis\u2013Papageorgiou pulse",
          "table": "pulse of a table"}
PULSE_NUMBERS = ("window", "cycles", "gamma", "nu")
# Quantity, symbol and unit of a value.
SYMBOLS = {"frequency": "ω_p/p", "pulse_period": "period", "pulse_frequency": "frequency", "pga": "PGA", "size": "R",
           "frequency_parameter": "p"}
UNITS = {"pga": "g", "s-1": "1/s", "degree": "degrees", "1": ""}  # of a quantity, or instead of those of the file
MOST_LETTERS = 32  # of the name of a record beside other words
MOST_OF_TITLE = 240  # letters: two to four lines of a picture


def shortened(text, width):
    """Returns the text in one line of at most `width` characters; may cut within a word."""
    line = " ".join(text.split())
    return line if len(line) <= width else line[:width - 1].rstrip() + "…"


def told_apart(texts, width):
    """Returns texts shortened at their ends, or at their beginnings if they differ in the ends only; in full if neither
    tells them apart."""
    beginnings = [shortened(text, width) for text in texts]
    ends = [text if len(text) <= width else "…" + text[1 - width:] for text in texts]
    return next((short for short in (beginnings, ends) if len({*short}) == len({*texts})), texts)


def title_of(file, shown=()):
    """Returns the job's title and its overrides, which may contradict it, except overrides of the
    title, of the output, which no picture depends on, and of the tables or quantities (table.name) in `shown`, whose
    values the picture shows elsewhere."""
    title = file.text("title")
    if title:
        overrides = file.job_text("job_overrides").splitlines()
        keys = [words.split("=")[0].strip().split(".") for words in overrides]
        others = [shortened(words, 48) for words, key in zip(overrides, keys)
                  if not {key[0], ".".join(key[:2])} & {"title", "output", *shown}]
        title += (", with " + ", ".join(others)) * bool(others)
    return title


def escaped(text):
    """Returns the text with dollar signs escaped for Matplotlib."""
    return text.replace("$", r"\$")


def plain(title, width=MOST_OF_TITLE):
    """Returns a title in one line of at most `width` characters, escaped for Matplotlib."""
    return escaped(shortened(title, width))


def is_linear(file):
    return file.text("theory") == "linear"


def is_recorded(file):
    return "record" in file.attrs


def ground_word(file):
    return "record" if is_recorded(file) else "pulse"


def file_name(path):
    return pathlib.PurePosixPath(path).name


def ground_text(file):
    """Returns the pulse, or the file of the record."""
    if is_recorded(file):
        return file_name(file.text("record"))
    return file.text("pulse").replace("_", "-")


@functools.cache
def motion_names(file):
    """Returns the name of each record by its number, without its folder; with it if several would be equal."""
    numbers, paths = (np.atleast_1d(file[name][:]) for name in ("motion", "motion_name"))
    names = {int(number): path for number, path in zip(numbers, paths)}
    short = {number: file_name(path) for number, path in names.items()}
    return short if len(set(short.values())) == len(names) else names


@functools.cache
def block_names(file):
    """Returns the name of each block by its number: the first text in its table that no two blocks share. None if there
    is no such column."""
    for name in file.coordinates if "block" in file else ():
        if file[name].dtype == object and name != "motion_name" and file[name].dimensions == file["block"].dimensions:
            texts = told_apart(np.atleast_1d(file[name][:]).tolist(), MOST_LETTERS)
            if len({*texts}) == len(texts) and all(texts):
                return dict(zip(np.atleast_1d(file["block"][:]).tolist(), texts))
    return None


def names_of(file, name):
    """Returns the names of the values of a dimension by their numbers, or None."""
    return {"motion": motion_names, "block": block_names}.get(name, lambda _: None)(file)


def value_text(file, name, place):
    """Returns the value of a dimension at an index."""
    return motion_names(file)[file[name][place].item()] if name == "motion" else f"{file[name][place]:g}"


def slenderness_text(alpha, units):
    """`alpha` is in rad."""
    return f"α = {math.degrees(alpha):.4g}°" if units == PHYSICAL else f"α = {alpha:.4g} rad"


def quantity_text(file, name, value):
    """Returns a quantity and its value; of a block, its name, if it has one."""
    if name == "block" and block_names(file):
        return block_names(file)[value]
    units = file[name].attrs.get("units", "1")
    units = UNITS.get(name, UNITS.get(units, units))
    return f"{worded(file.attrs, SYMBOLS.get(name, name))} = {value:.4g} {units}".rstrip()


def share_text(share):
    return "r = r_max" if share == 1 else f"r = {share:g} r_max"


def curve_text(line, units):
    """Returns the value that tells a line from the others of its picture, which is that of the last of its indices."""
    name = [*line.index][-1]
    names, value = names_of(line.file, name), line.value(name)
    if names:
        return names[value]
    if name == "slenderness":
        return slenderness_text(value, units)
    if name == "restitution_of_maximum":
        return share_text(value)
    other = EQUIVALENTS.get(name, name)
    shown = other if units == PHYSICAL and line.value(other) is not None else name
    return quantity_text(line.file, shown, line.value(shown))


def block_text(plane, units):
    """Returns the slenderness and the restitution, unless they vary in the plane."""
    alpha, r, share = map(plane.value, ("slenderness", "restitution", "restitution_of_maximum"))
    words = [] if alpha is None else [slenderness_text(alpha, units)]
    if share is not None:
        words.append(share_text(share) + (f" = {r:.4g}" if r is not None else ""))
    elif r is not None:
        words.append(f"r = {r:.4g}")
    return ",  ".join(words)


def motion_text(plane, units):
    """Returns the record and, if the picture shows its scale, its peak acceleration."""
    number = plane.value("motion")
    if number is None:
        return ""
    name = motion_names(plane.file)[number]
    if len(name) > MOST_LETTERS:
        name = "…" + name[1 - MOST_LETTERS:]  # names of one database differ in their ends
    peak = plane.value("record_pga")
    if "scale" not in plane.quantities(units) or peak is None:
        return name
    words = (f"{worded(plane.file.attrs, 'PGA')} {peak:.3g} g",
             plane.file["record_pga"].attrs.get("comment", ""))
    return f"{name}, {' '.join(filter(None, words))}"


def other_words(plane, units):
    """Returns the values of other dimensions, and of a friction, strength, rate and size that no axis shows."""
    file, shown = plane.file, {plane.across, plane.quantities()[1]}
    elsewhere = ("motion", "slenderness", "restitution", "restitution_of_maximum", "velocity_restitution")
    names = [name for name in plane.index if name not in elsewhere]
    if "block" in file and not file["block"].dimensions:  # selected in a data set
        names.append("block")
    if "friction" in file.coordinates and plane.value("friction") is not None and "friction" not in {*shown, *names}:
        names.append("friction")
    for kind in (STRENGTHS, SIZES if is_recorded(file) else RATES):
        if not {*shown, *names} & {*kind}:
            known = [name for name in file.coordinates if name in kind and plane.value(name) is not None]
            physical = [name for name in known if name in ("pga", "pulse_period")] if units == PHYSICAL else []
            names += (physical or known)[:1]
    return [quantity_text(file, name, plane.value(name)) for name in names]


def spectrum_words(plane, units=JOB):
    """Returns what distinguishes a spectrum from others: its record, if any, and its block."""
    motion = [motion_text(plane, units)] if is_recorded(plane.file) else []
    return [word for word in (*motion, *other_words(plane, units), block_text(plane, units)) if word]


def panel_titles(planes, units=JOB):
    """Returns what differs among the spectra, for each of them."""
    words = [spectrum_words(plane, units) for plane in planes]
    differs = [len(set(column)) > 1 for column in zip(*words)]
    return [escaped("\n".join(word for word, shown in zip(each, differs) if shown)) for each in words]


def subtitle(planes, units=JOB):
    """Returns pulse, theory, what all spectra have in common, and a note on missing tiles."""
    file, words = planes[0].file, []
    if not is_recorded(file):
        words.append(PULSES.get(file.text("pulse"), ground_text(file) + " pulse"))
    words += [f"{name} {float(file.attrs[name]):g}" for name in PULSE_NUMBERS if name in file.attrs]
    words += ["motion of a floor"] * is_of_floor(file.attrs)
    if is_linear(file):
        words.append("linear theory")
    for column in zip(*(spectrum_words(plane, units) for plane in planes)):
        if len(set(column)) == 1:
            words.append(escaped(column[0]))
    return ",  ".join(words + unfinished_words(file))


def heading(planes):
    """Returns the job's title; under records without a title, the name of the record."""
    file = planes[0].file
    quantities = [*file.dimensions, *(["along"] if "flip_value" in file else []), *planes[0].quantities()]
    title = title_of(file, [f"{table}.{name}" for table in ("plane", "block", "boundary") for name in quantities])
    if title or not is_recorded(file):
        return title
    shown = {plane.value("motion") for plane in planes}
    if len(shown) == 1 and None not in shown:
        return motion_names(file)[shown.pop()]
    return f"{len(motion_names(file)) if None in shown else len(shown)} records"
