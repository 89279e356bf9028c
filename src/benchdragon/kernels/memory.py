"""Memory of the engine's own, which outlives a call: blocks that hold groups of arrays, and handles.

A block is a row of 8-byte slots: a header, then what a NamedTuple takes, as in hosts/signature.py.
`group_at` gives the group; after an array was laid out again, call it again. Hosts know a question
under way by a handle, a number that stands for its block and for no other: stale ones are recognized.

Functions above `slot_count` are for plain Python: compiled code calls engine/runtime.c instead, as
engine/memory.py says.
"""

import ctypes
import itertools
import math
from typing import Any, TypeVar, cast

import numpy as np
import numpy.typing as npt

from benchdragon.hosts.signature import Parameter, parameter
from benchdragon.kernels.curve import FloatArray
from benchdragon.kernels.entries import entry, kernel
from benchdragon.kernels.numbered import Numbered
from benchdragon.kernels.route import IntArray

Group = TypeVar("Group", bound=tuple[Any, ...])
# Rows and columns of arrays; of a row its length, and ROW.
Shapes = tuple[tuple[int, int], ...]
ROW = -1

# Slots of a block's header.
HEADER = 10


class Header(Numbered):
    """The header of a block.

    It has the slot and the address at which the next array is laid out, the number of slots, and from
    OWNED on the addresses of the memory that is released with the block.
    """

    SLOT, ADDRESS, SLOTS, OWNED = range(4)


_taken: dict[int, IntArray] = {}
_handles: dict[int, int] = {}
_numbers = itertools.count(1)


def allocate(size: int) -> int:
    """The address of so many bytes, not initialized; 0 if there are not so many."""
    try:
        block = np.empty(max(-(-size // 8), 1), dtype=np.int64)
    except (MemoryError, ValueError):
        return 0
    address = int(block.ctypes.data)
    _taken[address] = block
    return address


def release(address: int) -> None:
    """Give back what `allocate` gave; 0 is nothing."""
    if address:
        del _taken[address]


def taken() -> int:
    """Bytes that were allocated and not released yet."""
    return sum(block.nbytes for block in _taken.values())


def floats_at(address: int, count: int) -> FloatArray:
    """So many floats from an address on."""
    kind = ctypes.c_double * count
    return np.ctypeslib.as_array(kind.from_address(int(address)) if count else kind())


def integers_at(address: int, count: int) -> IntArray:
    """So many whole numbers from an address on."""
    kind = ctypes.c_int64 * count
    return np.ctypeslib.as_array(kind.from_address(int(address)) if count else kind())


def group_at(group: type[Group], address: int) -> Group:
    """The group whose slots begin at an address."""
    viewed, _end = _viewed(parameter(group.__name__, group), address)
    return cast("Group", viewed)


def _viewed(wanted: Parameter, address: int) -> tuple[Any, int]:
    """What a parameter's slots hold from an address on; where they end."""
    if wanted.leaf is None:
        fields = []
        for field in wanted.fields:
            viewed, address = _viewed(field, address)
            fields.append(viewed)
        return cast("Any", wanted.group)(*fields), address
    code, dimensions = wanted.leaf.layout
    numbers_at = floats_at if code == "d" else integers_at
    if dimensions == 0:
        return numbers_at(address, 1)[0].item(), address + 8
    place, *shape = integers_at(address, 1 + dimensions).tolist()
    return numbers_at(place, math.prod(shape)).reshape(shape), address + 8 * (1 + dimensions)


def remember(address: int) -> int:
    """A handle of an address; 0 if too many are remembered."""
    handle = next(_numbers)
    _handles[handle] = address
    return handle


def recall(handle: int) -> int:
    """The address that a handle stands for; 0 if it stands for none, or not any more."""
    return _handles.get(handle, 0)


def forget(handle: int) -> int:
    """The address that a handle stood for until now; 0 if for none."""
    return _handles.pop(handle, 0)


def slot_count(group: type[tuple[Any, ...]]) -> int:
    """The number of slots that a group takes."""
    leaves = parameter(group.__name__, group).leaves()
    return sum(1 + leaf.layout.dimensions for leaf in leaves)


def slot_of(group: type[tuple[Any, ...]], name: str) -> int:
    """The slot at which a field begins in a block that holds a group."""
    slot, fields = HEADER, parameter("", group).fields
    for field in fields:
        if field.name == f".{name}":
            return slot
        slot += sum(1 + leaf.layout.dimensions for leaf in field.leaves())
    raise AttributeError(f"{group} has no field {name}")


@entry
def held() -> int:
    """Bytes that the engine holds for questions under way."""
    return taken()


@kernel
def new_block(slots: int) -> int:
    """The address of a block whose group takes so many slots; 0 if there is no memory."""
    block = allocate(8 * (HEADER + slots))
    if block:
        whole = integers_at(block, HEADER + slots)
        for n in range(HEADER + slots):
            whole[n] = 0
        whole[Header.SLOTS] = HEADER + slots
    return block


@kernel
def release_block(block: int) -> None:
    """Give a block back, and all that it owns."""
    header = integers_at(block, HEADER)
    for n in range(Header.OWNED, HEADER):
        release(header[n])
    release(block)


@kernel
def take(slots: IntArray, which: int, size: int) -> bool:
    """Let so many bytes be memory number `which` of a block, which has none; False without memory."""
    slots[Header.OWNED + which] = allocate(size)
    return slots[Header.OWNED + which] != 0


@kernel
def drop(slots: IntArray, which: int) -> None:
    """Give back the memory number `which` of a block."""
    release(slots[Header.OWNED + which])
    slots[Header.OWNED + which] = 0


@kernel
def lay(slots: IntArray, slot: int, address: int, shapes: Shapes) -> int:
    """Lay out arrays from a slot and an address on; returns the bytes that they take."""
    lay_from(slots, slot, address)
    for rows, columns in shapes:
        if columns == ROW:
            lay_row(slots, rows)
        else:
            lay_table(slots, rows, columns)
    return slots[Header.ADDRESS] - address


@kernel
def lay_from(slots: IntArray, slot: int, address: int) -> None:
    """Lay what follows from a slot and an address on."""
    slots[Header.SLOT], slots[Header.ADDRESS] = slot, address


@kernel
def lay_row(slots: IntArray, count: int) -> None:
    """Lay an array of so many numbers."""
    slot, address = slots[Header.SLOT], slots[Header.ADDRESS]
    slots[slot], slots[slot + 1] = address, count
    slots[Header.SLOT], slots[Header.ADDRESS] = slot + 2, address + 8 * count


@kernel
def lay_table(slots: IntArray, rows: int, columns: int) -> None:
    """Lay an array of so many rows and columns."""
    slot, address = slots[Header.SLOT], slots[Header.ADDRESS]
    slots[slot], slots[slot + 1], slots[slot + 2] = address, rows, columns
    slots[Header.SLOT], slots[Header.ADDRESS] = slot + 3, address + 8 * rows * columns


@kernel
def copy_row(target: npt.NDArray[Any], source: npt.NDArray[Any]) -> None:
    """Copy an array over one of its length."""
    for n in range(source.shape[0]):
        target[n] = source[n]


@kernel
def copy_table(target: npt.NDArray[Any], source: npt.NDArray[Any]) -> None:
    """Copy a table over one of its size."""
    for i in range(source.shape[0]):
        for n in range(source.shape[1]):
            target[i, n] = source[i, n]


@kernel
def clear(numbers: FloatArray) -> None:
    """Let all of a row be 0."""
    for n in range(numbers.shape[0]):
        numbers[n] = 0.0
