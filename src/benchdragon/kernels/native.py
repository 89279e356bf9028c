"""The kernels as one shared library, built ahead of time (benchdragon/engine) and loaded without numba.

A library is named by the text it was built from and by the processor it was built for, so that none is
ever loaded that belongs to other kernels or to another machine.
"""

import ctypes
import functools
import hashlib
import os
import platform
import struct
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
import numpy.typing as npt

from benchdragon.kernels.signature import Leaf, Parameter, Signature, signature
from benchdragon.own_folder import is_own

Function = TypeVar("Function", bound=Callable[..., object])

KERNELS = Path(__file__).parent
# What builds the library, and where that then lies.
ENGINE = KERNELS.with_name("engine")
# What a processor of level x86-64-v3 has, as Linux names it: nearly all since 2015. Wider vectors would
# gain an eighth at most, and one level gives the same bits on all machines (design/engine.py).
V3 = frozenset(["abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"])
PROCESSORS = Path("/proc/cpuinfo")
DTYPES = {"d": np.dtype(np.float64), "q": np.dtype(np.int64)}


def source_hash() -> str:
    """A hash of the text of all kernels and of what builds them."""
    files = (path for folder in (KERNELS, ENGINE) for path in folder.iterdir())
    sources = sorted(path for path in files if path.suffix in (".py", ".c"))
    text = b"".join(path.name.encode() + b"\0" + path.read_bytes() for path in sources)
    return hashlib.sha256(text).hexdigest()[:16]


def processor() -> str:
    """The level of this machine's processor: x86-64-v3 where it is known to be that."""
    machine = platform.machine().lower().replace("amd64", "x86_64")
    if machine != "x86_64":
        return machine
    try:
        with PROCESSORS.open(encoding="utf-8") as lines:
            flags = next((line for line in lines if line.startswith("flags")), "")
    except OSError:
        flags = ""
    return "x86-64-v3" if set(flags.split()) >= V3 else "x86-64"


def library_name() -> str:
    """The file name of the library for these kernels on this machine."""
    return f"kernels-{source_hash()}-{sys.platform}-{processor()}.so"


def user_folder() -> Path:
    """The user's own folder of libraries, for packages that stand where nobody may write."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return home / "benchdragon"


def find_library() -> Path | None:
    """The library for these kernels and this machine: its builder's, or the user's; or None.

    The user's is taken from a folder that nobody else can write to.
    """
    name = library_name()
    folders = [ENGINE, *([user_folder()] if is_own(user_folder()) else [])]
    return next((path for folder in folders if (path := folder / name).is_file()), None)


def load_library() -> ctypes.CDLL | None:
    """The library, if there is one that this system can load."""
    path = find_library()
    try:
        return None if path is None else ctypes.CDLL(str(path))
    except OSError:  # from a system with newer libraries of C
        return None


def bound(function: Function, library: ctypes.CDLL) -> Function:
    """The entry of the library that was built from `function`.

    Raises:
        AttributeError: if there is none.
    """
    shape = signature(function)
    call: Any = getattr(library, shape.symbol)
    call.argtypes, call.restype = [ctypes.c_void_p], ctypes.c_int32
    block, results = struct.Struct("=" + shape.slots()), struct.Struct("=" + "".join(shape.results))
    memory, start = ctypes.c_char * block.size, block.size - results.size
    readers = [reader(parameter) for parameter in shape.parameters]
    nothing = (0,) * len(shape.results)

    @functools.wraps(function)
    def native(*arguments: Any) -> Any:
        if len(arguments) != len(readers):
            raise TypeError(f"{shape.symbol} takes {len(readers)} arguments, not {len(arguments)}")
        slots: list[Any] = []
        for read, argument in zip(readers, arguments, strict=True):
            slots += read(argument)
        buffer = bytearray(block.pack(*slots, *nothing))
        code = call(memory.from_buffer(buffer))
        if code:
            raise MemoryError(f"{shape.symbol} ended with code {code}: no memory for its scratch")
        return returned(shape, results.unpack_from(buffer, start))

    return cast("Function", native)


def reader(parameter: Parameter) -> Callable[[Any], Sequence[Any]]:
    """A function that gives what the slots of an argument hold.

    It raises a TypeError for what the library cannot read.
    """
    if parameter.group is not None:
        return GroupReader(parameter)
    leaf = parameter.leaves()[0]
    return array_reader(leaf) if leaf.layout.dimensions else number_reader


def number_reader(value: Any) -> Sequence[Any]:
    """The slot of a number; `struct` refuses what is none."""
    return (value,)


def array_reader(leaf: Leaf) -> Callable[[Any], Sequence[Any]]:
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

    def __init__(self, parameter: Parameter) -> None:
        self.name, self.group = parameter.name, parameter.group
        self.readers = [reader(field) for field in parameter.fields]
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


def returned(shape: Signature, numbers: tuple[Any, ...]) -> Any:
    """What an entry with these results gives back."""
    return shape.gather(
        tuple(convert(number) for convert, number in zip(shape.converters, numbers, strict=True))
    )


def refusal(leaf: Leaf, value: Any) -> str:
    """What array was wanted, and what came."""
    wanted = f"contiguous {leaf.layout.dimensions}-dimensional array of {DTYPES[leaf.layout.code]}"
    if type(value) is not np.ndarray:
        return f"{leaf.name} must be a {wanted}, not {type(value)}"
    order = "" if value.flags.c_contiguous else ", not contiguous"
    came = f"{value.ndim}-dimensional array of {value.dtype}{order}"
    return f"{leaf.name} must be a {wanted}, not a {came}"
