"""The two decorators of all kernels, and the engine that serves them.

`BENCHDRAGON_ENGINE` chooses it. `native` is the library that was built ahead of time (native.py),
without numba; what is no entry of it stays plain Python. `jit` compiles each kernel by numba when it is
first called. `plain` leaves all as Python: for coverage, and for stepping through them. Unset, the
library serves if one was built from these kernels for this processor, else numba.
"""

import ctypes
import hashlib
import os
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

from benchdragon.kernels import native
from benchdragon.kernels.status import EngineError
from benchdragon.own_folder import made_own, shared_folder

VARIABLE = "BENCHDRAGON_ENGINE"
NATIVE, JIT, PLAIN = "native", "jit", "plain"

Function = TypeVar("Function", bound=Callable[..., object])


def chosen_engine() -> tuple[str, ctypes.CDLL | None]:
    """The engine that serves, and the library if that does.

    Raises:
        EngineError: if another name was given, or a library is wanted and there is none.
    """
    wanted = os.environ.get(VARIABLE, "")
    if wanted not in ("", NATIVE, JIT, PLAIN):
        raise EngineError(wanted)
    library = native.load_library() if wanted in ("", NATIVE) else None
    if wanted == NATIVE and library is None:
        raise EngineError(wanted)
    return wanted or (JIT if library is None else NATIVE), library


ENGINE, LIBRARY = chosen_engine()
COMPILED = ENGINE == JIT
if COMPILED:
    import numba  # pragma: no cover - coverage is taken uncompiled

# Contraction is the only licence taken with arithmetic. The numpy error model keeps divisions free of
# branches, without which no loop becomes SIMD.
SETTINGS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": {"contract"}}
# All entries, by the module and name of each.
ENTRIES: dict[str, Callable[..., object]] = {}


def cache_folder() -> Path | None:
    """The folder of compiled code, named by the kernels' own text; None where none can be written.

    What lies there is run, so that it must be this user's alone. numba does not notice a change in a
    function that a cached one calls, so the name changes with any line of any kernel.
    """
    sources = sorted(Path(__file__).parent.glob("*.py"))
    name = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    roots = native.user_folder(), shared_folder("benchdragon", Path(tempfile.gettempdir()))
    folders = (made_own(root, f"kernels-{name}") for root in roots if root is not None)
    return next((folder for folder in folders if folder is not None), None)


CACHE_FOLDER = cache_folder() if COMPILED else None


def allocates(function: Function) -> Function:
    """`function`, which makes arrays of its own or is given some by one that does.

    All others count no references to arrays, which would take an eighth of the time of searches.
    """
    marked: Any = function
    marked.allocates = True
    return function


def kernel(function: Function) -> Function:
    """`function`, called by kernels alone: compiled on first use if numba serves."""
    if not COMPILED:
        return function
    settings: Any = numba.config
    before = settings.CACHE_DIR
    settings.CACHE_DIR = str(CACHE_FOLDER or "")
    try:
        counting = getattr(function, "allocates", False)
        settings_of: dict[str, Any] = {"cache": CACHE_FOLDER is not None, "_nrt": counting, **SETTINGS}
        compiled: Any = numba.njit(**settings_of)(function)
    finally:
        settings.CACHE_DIR = before
    return cast("Function", compiled)


def entry(function: Function) -> Function:
    """`function`, called by Python as well: the library's own if that serves, else as `kernel`.

    Its annotations must say the layout of every array (arrays.py).
    """
    ENTRIES[f"{function.__module__}.{function.__name__}"] = function
    return kernel(function) if LIBRARY is None else native.bound(function, LIBRARY)


_watching: list[Any] = []


def watch_compiling(slow: Callable[[], None], after: float) -> None:
    """Call `slow` once the kernels have been compiling for `after` seconds (on another thread).

    Whoever watched before does so no longer.
    """
    if not COMPILED:
        return
    from numba.core import event  # only doors want to be told

    class Watch(event.Listener):
        depth = 0
        timer = threading.Timer(after, slow)

        def on_start(self, _event: object) -> None:
            if self.depth == 0:
                self.timer = threading.Timer(after, slow)
                self.timer.daemon = True
                self.timer.start()
            self.depth += 1

        def on_end(self, _event: object) -> None:
            self.depth -= 1
            if self.depth == 0:
                self.timer.cancel()

    register: Any = event.register
    unregister: Any = event.unregister
    while _watching:
        unregister("numba:compile", _watching.pop())
    _watching.append(Watch())
    register("numba:compile", _watching[-1])
