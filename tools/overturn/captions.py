"""Words in pictures: ground motion, block, title. An index `outer` is that of one spectrum."""

import functools
import math
import pathlib

from overturn.fields import count_tiles, dimensions_of, slenderness_and_restitution
from overturn.result_file import escaped, text_attribute, title_of

PULSES = {"symmetric_ricker": "symmetric Ricker wavelet",
          "antisymmetric_ricker": "antisymmetric Ricker wavelet",
          "mavroeidis_papageorgiou": "Mavroeidis\u2013Papageorgiou pulse"}
PULSE_NUMBERS = ("window", "cycles", "gamma", "nu")
JOB, PHYSICAL = "job", "physical"  # units: those of the job, or seconds, g and degrees
MOST_LETTERS = 32  # of the name of a record beside other words


def is_linear(file):
    return text_attribute(file, "theory") == "linear"


def is_recorded(file):
    return "record" in file.attrs


def ground_word(file):
    return "record" if is_recorded(file) else "pulse"


def scales_records(file):
    """Returns whether an axis is the scale of records, not their peak acceleration."""
    return is_recorded(file) and "record_pga" not in file


def file_name(path):
    return pathlib.PurePosixPath(path).name


def ground_text(file):
    """Returns the pulse, or the file of the record."""
    if is_recorded(file):
        return file_name(text_attribute(file, "record"))
    return text_attribute(file, "pulse").replace("_", "-")


@functools.cache
def motion_names(file):
    """Returns the name of each record without its folder; with it if several would be equal. The index
    is added only in files of version 1.0.0 whose motions have equal names."""
    paths = [row.tobytes().decode(errors="replace").rstrip("\0") for row in file["motion_name"][:]]
    names = [file_name(path) for path in paths]
    if len(set(names)) == len(names):
        return names
    return paths if len(set(paths)) == len(paths) else [f"{path} (motion {i})" for i, path in enumerate(paths)]


def value_text(file, name, place):
    """Returns the value of an outer dimension at an index."""
    return motion_names(file)[place] if name == "motion" else f"{file[name][place]:g}"


def slenderness_text(alpha, units):
    """`alpha` is in rad."""
    return f"α = {math.degrees(alpha):.4g}°" if units == PHYSICAL else f"α = {alpha:.4g} rad"


def block_text(file, outer, units):
    alpha, r = slenderness_and_restitution(file, outer)
    share = ""
    if text_attribute(file["restitution"], "of") == "maximum":
        value = file["restitution"][outer[dimensions_of(file).index("restitution")]]
        share = " = r_max" if value == 1 else f" = {value:g} r_max"
    return f"{slenderness_text(alpha, units)},  r{share} = {r:.4g}"


def motion_text(file, outer, units):
    """Returns the record and, if the picture shows its scale, its peak acceleration."""
    names = dimensions_of(file)
    motion = outer[names.index("motion")]
    name = motion_names(file)[motion]
    if len(name) > MOST_LETTERS:
        name = "…" + name[1 - MOST_LETTERS:]  # names of one database differ in their ends
    shows_scale = scales_records(file) and units == JOB
    return name + (f", PGA {file['pga'][motion]:.3g} g" if shows_scale else "")


def spectrum_words(file, outer, units=JOB):
    """Returns what distinguishes a spectrum from others: its record, if any, and its block."""
    motion = [motion_text(file, outer, units)] if is_recorded(file) else []
    return [*motion, block_text(file, outer, units)]


def panel_titles(file, spectra, units=JOB):
    """Returns what differs among the spectra, for each of them."""
    words = [spectrum_words(file, outer, units) for outer in spectra]
    differs = [len(set(column)) > 1 for column in zip(*words)]
    return [escaped("\n".join(word for word, shown in zip(each, differs) if shown))
            for each in words]


def subtitle(file, spectra, units=JOB):
    """Returns pulse, theory, what all spectra have in common, and a note on missing tiles."""
    words = []
    if not is_recorded(file):
        words.append(PULSES.get(text_attribute(file, "pulse"), ground_text(file) + " pulse"))
    words += [f"{name} {float(file.attrs[name]):g}" for name in PULSE_NUMBERS if name in file.attrs]
    if is_linear(file):
        words.append("linear theory")
    for column in zip(*(spectrum_words(file, outer, units) for outer in spectra)):
        if len(set(column)) == 1:
            words.append(escaped(column[0]))
    done, tiles = count_tiles(file)
    if done < tiles:
        words.append(f"unfinished: {done} of {tiles} tiles computed")
    return ",  ".join(words)


def heading(file, spectra):
    """Returns the job's title; under records without a title, the name of the record."""
    title = title_of(file)
    if title or not is_recorded(file):
        return title
    motion = dimensions_of(file).index("motion")
    shown = {outer[motion] for outer in spectra}
    return motion_names(file)[shown.pop()] if len(shown) == 1 else f"{len(shown)} records"
