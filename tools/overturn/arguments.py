"""Checks of the arguments of functions."""

import functools

import numpy as np

OLD_FRICTION = {"friction": "it is called friction_demand now"}
OLD_LIMIT = {"limit": "write of=\"peak\", above=0.4 in place of limit=0.4"}


class ArgumentError(TypeError, ValueError):
    """Arguments are missing or contradict each other."""


def given(**arguments):
    """Returns the arguments that are not None."""
    return {name: value for name, value in arguments.items() if value is not None}


def refuse(arguments, reason):
    """Raises ArgumentError if there is an argument."""
    if arguments:
        raise ArgumentError(f"{next(iter(arguments))} {reason}. Remove it.")


def refuses_old(advice):
    """Decorates a function that had the arguments whose names are the keys of `advice`."""
    def decorated(function):
        @functools.wraps(function)
        def checked(*arguments, **named):
            for name in sorted(named.keys() & advice.keys()):
                raise TypeError(f"{function.__name__}() has no argument {name}: {advice[name]}.")
            return function(*arguments, **named)
        return checked
    return decorated


def expect_dataset(dataset):
    """Raises ValueError unless this is a data set of xarray."""
    if not hasattr(dataset, "data_vars"):
        raise ValueError(f"{dataset!r:.60} is no data set. Give what overturn.open() returns for the path of a result.")


def number(name, value):
    """Returns a number as float. Raises ValueError if it is none, or several."""
    array = numbers(name, value)
    if array.ndim:
        raise ValueError(f"{name} has the shape {array.shape}. Give one number.")
    return float(array)


def count(name, value, least=1):
    """Returns an integer as int. Raises ValueError if it is none, or below the least."""
    found = number(name, value)
    if not (np.isfinite(found) and found == np.floor(found) and found >= least):
        raise ValueError(f"{name} = {value} is not an integer of {least} or more.")
    return int(found)


def numbers(name, value):
    """Returns numbers as an array of doubles. Raises ValueError if they are none, or masked."""
    if _has_masked_values(value):
        raise ValueError(f"{name} has masked values. Remove these points.")
    try:
        array = np.asarray(value)
        kinds = {np.asarray(each).dtype.kind for each in array.flat} if array.dtype.kind == "O" else {array.dtype.kind}
        if kinds & set("cMmVUSb"):  # complex numbers, dates and times, records, text, truth values
            raise TypeError
        return np.asarray(array, float)
    except OverflowError:
        raise ValueError(f"{name} has an integer beyond the range of double precision.") from None
    except (TypeError, ValueError):
        raise ValueError(f"{name} is not a number or an array of numbers.") from None


def positive(name, value):
    """Returns positive finite numbers as an array of doubles. Raises ValueError if one is not."""
    found = numbers(name, value)
    if not ((0 < found) & (found < np.inf)).all():
        raise ValueError(f"{name} = {value} is not a positive number.")
    return found


def expect_word(name, value):
    """Raises ValueError if the value is not text."""
    if not isinstance(value, str):
        raise ValueError(f"{name} = {value!r} is not a word. It is the same for all blocks.")


def _has_masked_values(value):
    if isinstance(value, (list, tuple)):
        return any(map(_has_masked_values, value))
    return isinstance(value, np.ma.MaskedArray) and bool(np.ma.getmaskarray(value).any())
