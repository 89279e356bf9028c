"""Lists of numbers, checked once on input."""

from collections.abc import Sequence

import numpy as np

from benchdragon.errors import InputError, brief
from benchdragon.i18n import _
from benchdragon.kernels.curve import FloatArray


def as_numbers(name: str, values: object) -> FloatArray:
    """`values`, a number or lists of numbers, as an array.

    Raises:
        InputError: if they are not all numbers, or lists of unequal lengths.
    """
    try:
        array = np.asarray(values)
    except ValueError:
        array = np.asarray("ragged")
    if array.size and array.dtype.kind not in "fiu":
        text = _("{name} must be numbers, not {value}")
        raise InputError(text.format(name=name, value=brief(values)))
    return array.astype(np.float64)


def as_list(name: str, values: object) -> tuple[float, ...]:
    """The same as plain numbers, one after another."""
    return tuple(as_numbers(name, values).ravel().tolist())


def as_table(rows: Sequence[Sequence[float]]) -> FloatArray:
    """Rows of numbers as an array, one row a row."""
    return np.array(rows, np.float64)
