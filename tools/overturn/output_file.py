"""Writing of files by the tools and the package: each is complete or absent, and replaces only a file of its
own kind.

Only the standard library is imported here, because synthetic_record needs nothing else but NumPy."""

import contextlib
import os
import pathlib
import secrets
import shutil
import stat

FILE = 74  # exit code, equal to that of overturn
# Suffix, what such a file contains, and the key of its metadata that names the program that made it.
PICTURES = {".png": (b"\x89PNG", "Software"), ".pdf": (b"%PDF", "Creator"), ".svg": (b"<svg", "Creator")}
MAKER = "overturn pictures"
BEGINNING = 4096  # bytes of an existing file that show its kind


class OutputError(OSError):
    """A file cannot be written. The text names it and says why."""

    def __init__(self, path, reason):
        super().__init__(f"cannot write \"{os.fspath(path)}\": {reason}.")
        self.code = FILE


@contextlib.contextmanager
def new_file(path, kind, is_own):
    """Yields the path of a file to write beside `path`. At the end it is synced to the disk and renamed; after an
    exception it is removed, and an existing file remains as it was. Devices and pipes are written directly.

    kind: of the file, in a message, such as "a table of tools/to_csv"; is_own: whether the first bytes of a file are
    those of this kind. An existing file of another kind is refused, unless it is empty.

    Raises OutputError, also for an OSError of the block: what is read there must report its errors otherwise."""
    try:
        if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
            yield path
            return
        target = os.path.realpath(path)  # a link is kept
        _expect_own(path, kind, is_own)
        part = f"{target}.{secrets.token_hex(4)}.part"
        try:
            os.close(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))  # with the mode of a new file
            if os.path.exists(target):
                shutil.copymode(target, part)
            yield part
            _sync(part)
            os.replace(part, target)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(part)
            raise
    except OutputError:
        raise
    except OSError as error:
        raise OutputError(path, error.strerror or str(error).rstrip(".")) from error


def write_text(path, text, kind, is_own):
    """Writes a text in UTF-8, see new_file()."""
    with new_file(path, kind, is_own) as part, open(part, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def make_folder(path):
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise OutputError(path, error.strerror) from error


def write_picture(figure, path, **how):
    """Writes a figure of Matplotlib in the format that the suffix of the path names."""
    import matplotlib
    suffix = pathlib.Path(path).suffix
    signature, key = PICTURES.get(suffix, (None, "Software"))

    def is_own(beginning):
        return suffix in PICTURES and signature in beginning and MAKER.encode() in beginning + _end_of(path)
    with new_file(path, f"a {suffix[1:].upper()} picture of overturn", is_own) as part, \
            matplotlib.rc_context({"svg.fonttype": "none"}):  # text remains text, to search and edit
        figure.savefig(part, format=suffix[1:] or "png", metadata={key: MAKER}, **how)


def save(figure, path, **how):
    """Saves and closes a figure."""
    from matplotlib import pyplot
    write_picture(figure, path, **how)
    pyplot.close(figure)
    print(path)


def _expect_own(path, kind, is_own):
    if not os.path.lexists(path):
        return
    if os.path.islink(path) and not os.path.exists(path):
        raise OutputError(path, "it is a link to a file that does not exist. Remove the link, or choose another name")
    with open(path, "rb") as file:
        beginning = file.read(BEGINNING)
    if beginning and not is_own(beginning):
        raise OutputError(path, f"it exists and is not {kind}. Remove it, or choose another name")
    if not os.stat(path).st_mode & stat.S_IWUSR:
        raise OutputError(path, "it is write-protected. Remove it, or choose another name")


def _end_of(path):
    with open(path, "rb") as file:
        file.seek(max(os.path.getsize(path) - BEGINNING, 0))
        return file.read()


def _sync(path):
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
