"""Which host serves the kernels' entries.

`BENCHDRAGON_ENGINE` chooses it. `native` is the library that was built ahead of time (native.py),
`wasm` is engine.wasm run by Wasmtime (wasm.py); what is no entry stays plain Python under both. `plain`
leaves all as Python: for coverage, and for stepping through it. Unset, the library serves if one was
built from these kernels for this processor, else the module.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

from benchdragon.hosts import native, wasm
from benchdragon.hosts.trouble import EngineError, Trouble

VARIABLE = "BENCHDRAGON_ENGINE"
NATIVE, WASM, PLAIN = "native", "wasm", "plain"


@dataclass(frozen=True)
class Serving:
    """Who serves: the name of the engine, and what makes the function to call of an entry's own."""

    name: str
    bound: Callable[[Any], Any]


def chosen() -> Serving:
    """Who is to serve.

    Raises:
        EngineError: for a name that is none, a library that is wanted and not there, or a module that
            is of other kernels.
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
    return Serving(WASM, wasm.Host(wasm.code_of_these_kernels()).bound)


serving = cache(chosen)
