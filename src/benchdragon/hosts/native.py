"""The kernels as one shared library, built ahead of time (benchdragon/engine).

A library is named by the text it was built from and by the processor it was built for, so that none is
ever loaded that belongs to other kernels or to another machine.
"""

import ctypes
import functools
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from benchdragon.hosts import built
from benchdragon.hosts.arguments import Block, address
from benchdragon.hosts.signature import signature
from benchdragon.own_folder import is_own

Function = TypeVar("Function", bound=Callable[..., object])


def library_name() -> str:
    """The file name of the library for these kernels on this machine."""
    return f"kernels-{built.source_hash()}-{sys.platform}-{built.processor()}.so"


def find_library() -> Path | None:
    """The library for these kernels and this machine: its builder's, or the user's; or None.

    The user's is taken from a folder that only this user can write to.
    """
    name, mine = library_name(), built.user_folder()
    folders = [built.ENGINE, *([mine] if mine is not None and is_own(mine) else [])]
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
    block = Block(signature(function), address)
    call: Any = getattr(library, block.symbol)
    call.argtypes, call.restype = [ctypes.c_void_p], ctypes.c_int32
    memory = ctypes.c_char * block.size

    @functools.wraps(function)
    def native(*arguments: Any) -> Any:
        buffer = bytearray(block.size)
        block.fill(buffer, block.read(arguments))
        return block.result(buffer, call(memory.from_buffer(buffer)))

    return cast("Function", native)
