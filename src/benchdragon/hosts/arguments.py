"""How arguments of an entry fill its block, and which are refused: the same for library and module."""

import ctypes
import struct
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from benchdragon.hosts.signature import Leaf, Parameter, Signature

DTYPES = {"d": np.dtype(np.float64), "q": np.dtype(np.int64)}
CODES = {dtype: code for code, dtype in DTYPES.items()}

# Gives where an array's numbers lie.
Address = Callable[[npt.NDArray[Any]], int]


class Block:
    """The slots of an entry: filled by arguments, read for results.

    Args:
        shape: what the entry takes and returns.
        address: where the numbers of an array lie, as the slots hold it.

    Attributes:
        symbol: the entry's name where it was built.
        size: bytes.
        arrays: of each array among the arguments the slot of its address, and its dimensions.
    """

    def __init__(self, shape: Signature, address: Address) -> None:
        self._shape, self.symbol = shape, shape.symbol
        self._slots = struct.Struct("=" + shape.slots())
        self._results = struct.Struct("=" + "".join(shape.results))
        self.size, self._nothing = self._slots.size, (0,) * len(shape.results)
        self._start = self.size - self._results.size
        self._readers = [reader(parameter, address) for parameter in shape.parameters]
        self.arrays, slot = list[tuple[int, int]](), 0
        for leaf in shape.leaves():
            if leaf.layout.dimensions:
                self.arrays.append((slot, leaf.layout.dimensions))
            slot += 1 + leaf.layout.dimensions

    def read(self, arguments: Sequence[Any]) -> list[Any]:
        """What the slots of the arguments hold.

        Raises:
            TypeError: if there are too many or too few, or one is not what the entry takes.
        """
        if len(arguments) != len(self._readers):
            raise TypeError(f"{self.symbol} takes {len(self._readers)} arguments, not {len(arguments)}")
        slots: list[Any] = []
        for read, argument in zip(self._readers, arguments, strict=True):
            slots += read(argument)
        return slots

    def fill(self, buffer: bytearray | memoryview, slots: Sequence[Any]) -> None:
        """Put the slots of the arguments into a buffer, and nothing into those of the results."""
        self._slots.pack_into(buffer, 0, *slots, *self._nothing)

    def result(self, buffer: bytearray | memoryview, code: int) -> Any:
        """What the entry returned, from a buffer that it filled, if its code is 0.

        Raises:
            MemoryError: if it is not.
        """
        if code:
            raise MemoryError(f"{self.symbol} ended with code {code}: no memory for its scratch")
        numbers = self._results.unpack_from(buffer, self._start)
        converters = self._shape.converters
        return self._shape.gather(
            tuple(convert(number) for convert, number in zip(converters, numbers, strict=True))
        )


def reader(parameter: Parameter, address: Address) -> Callable[[Any], Sequence[Any]]:
    """A function that gives what the slots of an argument hold.

    It raises a TypeError for what entries cannot read.
    """
    if parameter.group is not None:
        return GroupReader(parameter, address)
    leaf = parameter.leaves()[0]
    return array_reader(leaf, address) if leaf.layout.dimensions else number_reader


def number_reader(value: Any) -> Sequence[Any]:
    """The slot of a number; `struct` refuses what is none."""
    return (value,)


def array_reader(leaf: Leaf, address: Address) -> Callable[[Any], Sequence[Any]]:
    """A function that gives an array's address and lengths."""
    dtype, dimensions = DTYPES[leaf.layout.code], leaf.layout.dimensions

    def read(value: Any) -> Sequence[Any]:
        if (
            type(value) is not np.ndarray
            or value.dtype != dtype
            or value.ndim != dimensions
            or not value.flags.c_contiguous
        ):
            raise TypeError(refusal(leaf, value))
        return (address(value), *value.shape)

    return read


class GroupReader:
    """Gives the slots of a NamedTuple; those of the last one are kept, as searches use one for long."""

    def __init__(self, parameter: Parameter, address: Address) -> None:
        self.name, self.group = parameter.name, parameter.group
        self.readers = [reader(field, address) for field in parameter.fields]
        self.last: tuple[Any, list[Any]] = None, []

    def __call__(self, value: Any) -> Sequence[Any]:
        """The slots, checked."""
        known, slots = self.last  # read and written in one step each: threads do not mix
        if value is known:
            return slots
        if type(value) is not self.group:
            raise TypeError(f"{self.name} must be a {self.group}, not {type(value)}")
        fields = cast("tuple[Any, ...]", value)
        slots = [slot for read, field in zip(self.readers, fields, strict=True) for slot in read(field)]
        self.last = value, slots
        return slots


def address(array: npt.NDArray[Any]) -> int:
    """Where an array's numbers lie; the first way takes a quarter of the other's time."""
    if array.flags.writeable and array.size:
        return ctypes.addressof(ctypes.c_char.from_buffer(cast("Any", array)))
    return int(array.ctypes.data)


def refusal(leaf: Leaf, value: Any) -> str:
    """The error of a wrong array: what was required, and what was given."""
    wanted = f"contiguous {leaf.layout.dimensions}-dimensional array of {DTYPES[leaf.layout.code]}"
    if type(value) is not np.ndarray:
        return f"{leaf.name} must be a {wanted}, not {type(value)}"
    order = "" if value.flags.c_contiguous else ", not contiguous"
    came = f"{value.ndim}-dimensional array of {value.dtype}{order}"
    return f"{leaf.name} must be a {wanted}, not a {came}"
