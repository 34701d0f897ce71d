"""Reading of result files by the tools."""

import contextlib
import os

import h5py
from overturn.file_variables import Result, text_of
from overturn.tool import ToolError

HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
FORMAT = 4
SPECTRUM = "overturning spectrum"  # a kind of file
MOST_LETTERS = 240  # of a title: two to four lines of a picture


def job_text(file, name):
    """Returns a text about the job; empty if there is none."""
    return file.run[name][:].tobytes().decode(errors="replace") if name in file.run else ""


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
    title, of the output, which no picture depends on, and of the tables in `shown`, whose values the picture shows
    elsewhere."""
    title = file.text("title")
    if title:
        overrides = job_text(file, "job_overrides").splitlines()
        others = [shortened(words, 48) for words in overrides
                  if words.split("=")[0].split(".")[0].strip() not in ("title", "output", *shown)]
        title += (", with " + ", ".join(others)) * bool(others)
    return title


def escaped(text):
    """Returns the text with dollar signs escaped for Matplotlib."""
    return text.replace("$", r"\$")


def plain(title, width=MOST_LETTERS):
    """Returns a title in one line of at most `width` characters, escaped for Matplotlib."""
    return escaped(shortened(title, width))


def open_result(path, kinds, wanted):
    """Opens a result file of one of the given kinds; `wanted` describes them in error messages. In place of the path of
    a spectrum, a data set may be given, see overturn.open()."""
    if hasattr(path, "data_vars") and "kind" not in path.attrs:
        raise ValueError("the data set has no attribute kind. Give one of overturn.open(), or keep the attributes of it: "
                         "xarray.set_options(keep_attrs=True).")
    if hasattr(path, "data_vars") and path.attrs["kind"] == SPECTRUM == kinds:
        from overturn.dataset_result import DatasetResult
        return DatasetResult(path)
    path = path_of(path)
    try:
        with open(path, "rb") as file:
            signature = file.read(len(HDF5_SIGNATURE))
        if signature != HDF5_SIGNATURE:
            raise ToolError(f"\"{path}\" is not an HDF5 file.")
        file = h5py.File(path, "r")
    except OSError as error:
        raise ToolError(f"cannot read \"{path}\": {error.strerror or error}.") from error
    if text_of(file, "kind") not in ((kinds,) if isinstance(kinds, str) else kinds):
        raise ToolError(f"\"{path}\" is not {wanted}.")
    if (version := file.attrs.get("format_version", 1)) != FORMAT:
        raise ToolError(other_format(path, version))
    with damage_reported(path):
        return Result(file)


def other_format(path, version):
    """Returns the message about a file of another format."""
    advice = ("Use a newer overturn" if version > FORMAT else
              f"Read it with {'overturn 2.0' if version == 3 else 'the overturn that wrote it'}, or compute it again "
              "with this version")
    return f"\"{path}\" has format version {version}, but this version of overturn reads version {FORMAT}. {advice}."


def path_of(result):
    """Returns the path of a result file, given by its path or by the data set that overturn.open() returned for
    it. Raises ValueError for a part of a data set, or a changed one: its picture would be that of the file."""
    if not hasattr(result, "encoding"):
        return os.fspath(result)
    path = result.encoding.get("source")
    if path is None or not hasattr(result, "data_vars"):
        raise ValueError("this is no data set of overturn.open(). Pass one, or the path of the file.")
    from overturn.datasets import open as open_dataset
    with open_dataset(path) as whole:
        if not whole.identical(result):
            raise ValueError(f"the data set differs from \"{path}\", and only whole boundaries and histories are drawn. "
                             "Pass the path, and choose a part by the arguments of the function.")
    return path


@contextlib.contextmanager
def damage_reported(path, *also):
    """Reports missing or malformed parts of a file, and errors of the given types, as damage to the file."""
    try:
        yield
    except (OSError, KeyError, *also) as error:
        raise ToolError(f"\"{path}\" is damaged: {error}.") from error
