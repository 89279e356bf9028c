"""Which host serves the kernels' entries.

`BENCHDRAGON_ENGINE` chooses it. `native` is the library that was built ahead of time (native.py),
`wasm` is engine.wasm run by Wasmtime (wasm.py); what is no entry stays plain Python under both. `plain`
leaves all as Python: for coverage, and for stepping through it. Unset, the library serves if one was
built from these kernels for this processor, else the module.
"""

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from benchdragon.hosts import native, wasm
from benchdragon.hosts.arguments import CODES, DTYPES
from benchdragon.hosts.trouble import EngineError, Trouble

VARIABLE = "BENCHDRAGON_ENGINE"
NATIVE, WASM, PLAIN = "native", "wasm", "plain"

Group = TypeVar("Group", bound=tuple[Any, ...])


def usual(shape: Sequence[int], code: str) -> npt.NDArray[Any]:
    """An uninitialised array where NumPy puts it, of a code of DTYPES."""
    return np.empty(shape, DTYPES[code])


@dataclass(frozen=True)
class Serving:
    """Who serves.

    Attributes:
        name: of the engine.
        bound: makes the function to call of an entry's own.
        array: makes arrays of a shape and a code of DTYPES that the engine need not copy.
        shares: whether threads may let it write different parts of one array.
    """

    name: str
    bound: Callable[[Any], Any]
    array: Callable[[Sequence[int], str], npt.NDArray[Any]] = usual
    shares: bool = True


def chosen() -> Serving:
    """Who is to serve.

    Raises:
        EngineError: for an unknown name, a library that is required and missing, or a module of other
            kernels.
    """
    wanted = os.environ.get(VARIABLE, "")
    if wanted not in ("", NATIVE, WASM, PLAIN):
        raise EngineError(Trouble.UNKNOWN, wanted)
    if wanted == PLAIN:
        return Serving(PLAIN, lambda function: function)
    library = native.load_library() if wanted != WASM else None
    if library is not None:
        return Serving(NATIVE, partial(native.bound, library=library))
    if wanted == NATIVE:
        raise EngineError(Trouble.NO_LIBRARY)
    host = wasm.Host(wasm.code_of_these_kernels())
    return Serving(
        WASM, host.bound, lambda shape, code: host.instance().array(shape, code), shares=False
    )


serving = cache(chosen)


def empty(*shape: int) -> npt.NDArray[np.float64]:
    """An uninitialised array that calls of this thread need not copy."""
    return serving().array(shape, "d")


def empty_whole(*shape: int) -> npt.NDArray[np.int64]:
    """The same of whole numbers."""
    return serving().array(shape, "q")


def placed(group: Group) -> Group:
    """A NamedTuple of arrays, also within others, where calls of this thread need not copy them."""
    return group if serving().array is usual else _placed(group)


def _placed(value: Any) -> Any:
    if isinstance(value, tuple):
        kind: Any = type(value)
        return kind(*map(_placed, value))
    array = serving().array(value.shape, CODES[value.dtype])
    array[...] = value
    return array
