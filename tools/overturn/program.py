"""The program overturn, called from Python."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Union

import overturn
from overturn.arguments import count
from overturn.installation import IS_CHECKOUT, is_program, overturn_path

if TYPE_CHECKING:
    import xarray

_WARNING = "overturn: warning: "  # begins a line of the program

# Keys that name files: what to give, and which function takes arrays.
FILES = {"scene.record": "a path or a list of paths. overturn.evaluate(record=..., time_step=...) takes accelerations, "
                         "and FloorMotion.to_text() writes those of a floor",
         "scene.vertical": "a component of the record, a path or a pattern, or a list of them. "
                           "overturn.evaluate(vertical=...) takes accelerations",
         "scene.second_component": "a component of the record, a path or a pattern, or a list of them. "
                                   "overturn.evaluate(second_component=...) takes accelerations",
         "shape": "the path of a table. overturn.evaluate(shape=...), and scene.shape of a job, take arrays",
         "blocks.table": "the path of a CSV file. overturn.evaluate(width=..., height=...) takes arrays of blocks"}

Job = Union[str, "os.PathLike[str]", Mapping[str, Any]]


class ProgramError(RuntimeError):
    """The program failed. The text is its message."""

    def __init__(self, message: str, exit_code: int):
        super().__init__(message)
        self.exit_code = exit_code  #: of the program; negative: the signal that ended it


def check(job: Job, *, overrides: Mapping[str, Any] | None = None) -> str:
    """Returns what `overturn check` prints: points, bytes and time of a job.

    job: the path of a job file; or a job as a TOML text of several lines, or as a dictionary of the
        same structure. Paths of records in a text or a dictionary are relative to the working folder.
    overrides: keys of the job and their new values, such as {"scene.pulse": "half_sine"}.

    Warns of values that are probably in another unit. Raises ProgramError if the job is not valid.
    """
    with _job_file(job) as path:
        return _output_of([overturn_path(), "check", path, *_set_arguments(overrides)], path, job)


def run(job: Job, ranks: int = 1, *, output: str | os.PathLike[str] | None = None,
        overrides: Mapping[str, Any] | None = None) -> xarray.Dataset:
    """Runs a job and returns its result, see open().

    job, overrides: as in check().
    ranks: number of processes; above 1 they are started by mpirun, or by $MPIEXEC.
    output: path of the result file, from which the data set is read when it is used. Running the same
        job again resumes a run that was stopped. Without `output`, the data set is in memory and no file remains.

    Warns of values that are probably in another unit. Raises ProgramError if the program fails.
    """
    ranks, open_result = count("ranks", ranks), overturn.open  # without xarray, this fails before the run
    launcher = [os.environ.get("MPIEXEC", "mpirun"), "-n", str(ranks)] if ranks != 1 else []
    with contextlib.ExitStack() as stack:
        path = stack.enter_context(_job_file(job))
        if output is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="overturn-"))
            result = pathlib.Path(folder) / "result.h5"
        else:
            result = pathlib.Path(output)
        _output_of([*launcher, overturn_path(), "run", path, "-o", result, *_set_arguments(overrides)], path, job)
        dataset = open_result(result)
        if output is not None:
            return dataset
        with dataset:
            return dataset.load()


def topple(*, direction: float | None = None, pulse: str | None = None, period: float | None = None,
           shape: str | os.PathLike[str] | None = None, record: str | os.PathLike[str] | None = None,
           component: str | int | None = None, pga: float | None = None,
           scale: float | None = None, restitution: float | None = None, velocity_restitution: float | None = None,
           restitution_of_maximum: float | None = None, pga_max: float | None = None, search: bool = True,
           vary: tuple[str, float, float] | None = None, history: str | os.PathLike[str] | None = None,
           overrides: Mapping[str, Any] | None = None, **block: float) -> dict[str, Any]:
    """Returns the answer of `overturn topple`: whether one block topples, and at which peak accelerations.

    block: width and height [m], incline [rad] and so on; with all other arguments, the options of the command.
    record: the path of a recorded motion. evaluate() takes accelerations.
    shape: the path of the table of pulse = "table". evaluate() takes an array.
    search: if false, only the verdict at `pga` or `scale`, in a fraction of the time; what needs the search is None.
    vary: a quantity of the block, such as "width", or "restitution_of_maximum", and its first and last value. The answer
        is then at which values between these the block topples at `pga` or `scale`.
    history: path of a file, to which the motion at `pga` or `scale` is written.
    overrides: keys of [scene] and their new values, such as {"scene.gravity": 1.62}.

    The members of the answer are those of `overturn topple --json`. Of a block with two different sides, both
    directions are computed unless one is given: `by_direction` has the answers for both, and the other members are
    those of the worse one; with `vary`, the worse of both at each value.

    Warns of values that are probably in another unit. Raises ProgramError if the program fails.
    """
    given = {**block, "direction": direction, "pulse": pulse, "period": period, "shape": shape, "record": record,
             "component": component, "pga": pga, "scale": scale, "restitution": restitution,
             "velocity_restitution": velocity_restitution, "restitution_of_maximum": restitution_of_maximum,
             "pga_max": pga_max, "history": history}
    _expect_file_names("" if record is None else record, "scene.record")
    _expect_file_names("" if shape is None else shape, "shape")
    options = [f"--{name.replace('_', '-')}={_option_text(value)}" for name, value in given.items()
               if value is not None] + ["--no-search"] * (not search)
    if vary is not None:
        name, first, last = vary
        options += ["--vary", name, _option_text(first), _option_text(last)]
    answer = json.loads(_output_of([overturn_path(), "topple", "--json", *options, *_set_arguments(overrides)]))
    for text in answer["warnings"]:
        warnings.warn(f"{text}.", stacklevel=2)
    return answer


def assess(objects: str | os.PathLike[str] | Mapping[str, Any], *, period: Any = None, pulse: str | None = None,
           shape: str | os.PathLike[str] | None = None, record: str | os.PathLike[str] | list[str] | None = None,
           component: str | int | None = None, pga: float | None = None, scale: float | None = None,
           direction: Any = None, pga_max: float | None = None, fine: bool = False, overrides: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Returns the answer of `overturn assess --json`: for each of many objects, whether it topples under one of several
    motions, and the lowest peak acceleration that topples it.

    objects: the path of a table, or its columns as a dictionary of arrays or lists of one length.
    period: of the pulse [s]; direction [degree]: numbers, or arrays of them.
    shape: the path of the table of pulse = "table".
    record: the path of a recorded motion, a pattern of several, or a list of them.
    fine: whether the strengths are searched as by topple(), instead of in steps of 0.5 %.
    overrides: keys of [scene] and their new values, such as {"scene.gravity": 1.62}.

    The rows are in answer["objects"], the most vulnerable object first.

    Warns of values that are probably in another unit. Raises ProgramError if the program fails.
    """
    lists = {"period": period, "direction": direction}
    given = {"pulse": pulse, "shape": shape, "component": component, "pga": pga, "scale": scale, "pga_max": pga_max,
             **{name: ",".join(map(repr, _listed(value))) for name, value in lists.items() if value is not None}}
    records = [] if record is None else _listed(record)
    for name in records:
        _expect_file_names(name, "scene.record")
    _expect_file_names("" if shape is None else shape, "shape")
    options = [f"--{name.replace('_', '-')}={_option_text(value)}" for name, value in given.items()
               if value is not None]
    options += [f"--record={os.fspath(name)}" for name in records] + ["--fine"] * fine
    with contextlib.ExitStack() as stack:
        if isinstance(objects, Mapping):
            text = stack.enter_context(tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="overturn-",
                                                                   suffix=".csv", newline=""))
            csv.writer(text).writerows([list(objects), *zip(*map(_listed, objects.values()), strict=True)])
            text.flush()
        path = text.name if isinstance(objects, Mapping) else os.fspath(objects)
        answer = json.loads(_output_of([overturn_path(), "assess", path, "--json", *options,
                                        *_set_arguments(overrides)], path, objects))
    for text in answer["warnings"]:
        warnings.warn(f"{text}.", stacklevel=2)
    return answer


def _listed(values):
    values = values.tolist() if hasattr(values, "tolist") else values
    return list(values) if isinstance(values, (list, tuple)) else [values]


def _option_text(value):
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    return os.fspath(value) if isinstance(value, (str, os.PathLike)) else repr(value)


def _output_of(command, path="", job=""):
    program = overturn_path()
    if not is_program(program):
        is_named = IS_CHECKOUT or os.environ.get("OVERTURN")
        looked_for = f"program \"{program}\"" if is_named else "program overturn on the PATH"
        raise ProgramError(f"there is no {looked_for}. Build it (tools/quickstart does), or set OVERTURN to the path of "
                           "another one.", 2)
    try:
        done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, errors="replace")
    except FileNotFoundError:
        raise ProgramError(f"there is no launcher \"{command[0]}\". Install an MPI, or set MPIEXEC.", 2) from None
    lines = done.stderr.splitlines(keepends=True)
    for line in lines:
        if line.startswith(_WARNING):
            warnings.warn(line.removeprefix(_WARNING).rstrip("\n"), stacklevel=3)
    if done.returncode == 0:
        return done.stdout
    errors = "".join(line for line in lines if not line.startswith(_WARNING))
    message = errors.split("overturn: ", 1)[-1].split("\n----", 1)[0].strip("-\n ") or done.stdout.strip()
    if not _is_path(job):
        message = message.replace(str(path), "job")
    raise ProgramError(message, done.returncode)


def _is_path(job):
    return not isinstance(job, Mapping) and "\n" not in os.fspath(job)


@contextlib.contextmanager
def _job_file(job):
    """Yields the path of a job file. A text or a dictionary is written to a file in the working folder,
    because paths of records are relative to the file."""
    if _is_path(job):
        yield os.fspath(job)
        return
    text = "".join(f"{json.dumps(key)} = {_toml(value, key)}\n" for key, value in job.items()) if isinstance(
        job, Mapping) else job
    with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=os.curdir, prefix="overturn-",
                                     suffix=".toml") as file:
        file.write(text)
        file.flush()
        yield os.path.basename(file.name)


def _set_arguments(overrides):
    return [word for key, value in (overrides or {}).items() for word in ("--set", f"{key}={_toml(value, key)}")]


def _expect_file_names(value, key):
    """Raises an error if a key that names files has something else as its value, such as samples or a table."""
    if key not in FILES:
        return
    names = value.tolist() if hasattr(value, "tolist") else value
    kinds = (str, os.PathLike, int) if key in ("scene.second_component", "scene.vertical") else (str, os.PathLike)
    for name in names if isinstance(names, (list, tuple)) else [names]:
        if not isinstance(name, kinds):
            raise TypeError(f"{key} is {_described(value)}, but a job names files: give {FILES[key]}.")


def _described(value):
    shape = getattr(value, "shape", None)
    if isinstance(value, (list, tuple)):
        return f"a {type(value).__name__} of {len(value)} values"
    return type(value).__name__ + (f" of the shape {tuple(shape)}" if shape is not None else "")


def _toml(value, key):
    """Returns a value of a job in TOML, in one line."""
    _expect_file_names(value, key)
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(name)} = {_toml(part, f'{key}.{name}')}"
                               for name, part in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(part, key) for part in value) + "]"
    raise TypeError(f"{key} = {value!r} cannot be part of a job. Give strings, numbers, booleans, lists and "
                    "dictionaries.")
