"""The one decorator of all kernels: compiled by numba, or left as plain Python.

`BENCHDRAGON_COMPILE=never` leaves the kernels plain: for coverage, for stepping through them, and
for jobs so small that importing numba would cost more than it saves (design/cold_start.py).
"""

import hashlib
import os
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

COMPILED = os.environ.get("BENCHDRAGON_COMPILE", "always") != "never"
if COMPILED:
    import numba  # pragma: no cover - coverage is taken uncompiled

Function = TypeVar("Function", bound=Callable[..., object])


def cache_folder() -> Path | None:
    """The folder of compiled code, named by the kernels' own text; None where none can be written.

    numba does not notice a change in a function that a cached one calls, so the name changes with
    any line of any kernel.
    """
    sources = sorted(Path(__file__).parent.glob("*.py"))
    name = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    for root in (home / "benchdragon", Path(tempfile.gettempdir()) / f"benchdragon-{os.getuid()}"):
        folder = root / f"kernels-{name}"
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return folder
    return None


CACHE_FOLDER = cache_folder() if COMPILED else None


def kernel(function: Function) -> Function:
    """`function` compiled on first use; contraction is the only licence taken with its arithmetic.

    The numpy error model keeps divisions free of branches, without which no loop becomes SIMD.
    """
    if not COMPILED:
        return function
    settings: Any = numba.config
    before = settings.CACHE_DIR
    settings.CACHE_DIR = str(CACHE_FOLDER or "")
    try:
        compiled: Any = numba.njit(
            cache=CACHE_FOLDER is not None,
            nogil=True,
            error_model="numpy",
            fastmath={"contract"},
        )(function)
    finally:
        settings.CACHE_DIR = before
    return cast("Function", compiled)


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
