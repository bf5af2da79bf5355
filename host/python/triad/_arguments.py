"""From what Python's users write to what the module takes."""
from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _triad

Options = Mapping[str, Any]

# How the command line joins numbers, where not by commas.
_JOINED_BY = {"bins": "x", "size": "x", "samples": ":"}


def count(name: str, value: Any, least: int = 1) -> int:
    """A whole number; 0 for None."""
    if value is None:
        return 0
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: expected a whole number, not {value!r}") from None
    if not least <= number < 2**32:
        raise ValueError(f"{name}: expected a whole number from {least} to {2**32 - 1}, not {number}")
    return number


def _text(name: str, value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, Iterable):
        return _JOINED_BY.get(name, ",").join(_text(name, each) for each in value)
    raise TypeError(f"{name}: expected a text, a number, True or False, or several of them, not {value!r}")


def words(options: Options) -> list[tuple[str, str]]:
    """Options as texts; one that is a list of texts is there several times."""
    result = []
    for name, value in options.items():
        if value is None:
            continue
        several = isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(v, str) for v in value)
        result += [(name, _text(name, each)) for each in (value if several else [value])]
    return result


def numbers(what: str, values: Any, shape: tuple[int | None, ...], dtype: Any, kinds: str = "fiu") -> NDArray[Any]:
    """An array of this shape (None: any length), of numbers of the kinds."""
    array = np.asarray(values)
    if array.dtype.kind not in kinds:
        expected = "numbers" if "f" in kinds else "whole numbers"
        raise TypeError(f"{what}: expected {expected}, not an array of {array.dtype}")
    fits = array.ndim == len(shape) and all(n in (None, m) for n, m in zip(shape, array.shape))
    if not fits:
        expected, found = (
            "an array of " + " x ".join("N" if n is None else str(n) for n in sizes) if sizes else "one value"
            for sizes in (shape, array.shape))
        raise ValueError(f"{what}: expected {expected}, not {found}")
    if np.dtype(dtype).kind == "u" and array.size and (array.min() < 0 or array.max() > np.iinfo(dtype).max):
        raise ValueError(f"{what}: expected numbers from 0 to {np.iinfo(dtype).max}, not {array.min()} to {array.max()}")
    return np.asarray(array, dtype, order="C")


def number(what: str, value: Any) -> float:
    return float(numbers(what, value, (), np.float64).item())


def vector(what: str, values: Any) -> list[float]:
    """Three numbers."""
    return [float(v) for v in numbers(what, values, (3,), np.float64)]


def image(what: str, picture: Any) -> tuple[NDArray[np.float32], bool]:
    """A picture, and whether it holds sRGB values."""
    if isinstance(picture, (str, os.PathLike)):
        return _triad.read_image(os.fspath(picture))
    array = np.asarray(picture)
    channels = 4 if array.ndim == 3 and array.shape[2] == 4 else 3
    encoded = array.dtype in (np.uint8, np.uint16)
    if encoded:
        array = array / np.float32(np.iinfo(array.dtype).max)
    return numbers(what, array, (None, None, channels), np.float32, "f"), encoded
