"""engine.wasm, compiled once for this machine, and cached in a folder that only this user can write to.

The cached code is run as it is, and Wasmtime does not check whether it is whole: its hash stands before
it. It is named by the module, Wasmtime's version and the machine, and appears whole or not at all, so
that processes may race.
"""

import hashlib
import os
import secrets
import sys
import tempfile
from contextlib import suppress
from importlib import metadata
from pathlib import Path
from typing import Any

from benchdragon.hosts import built
from benchdragon.hosts.trouble import EngineError, Trouble
from benchdragon.own_folder import made_own, shared_folder

ENDING = ".compiled"
# So many are kept, the newest: of other versions, and of other checkouts.
MOST = 8


def module(code: bytes) -> tuple[Any, Any]:
    """Wasmtime's engine, and the module compiled for it, from its folder if it is kept there.

    Raises:
        EngineError: if Wasmtime is not here, or does not take the module.
    """
    try:
        import wasmtime

        version = metadata.version("wasmtime")
        engine = wasmtime.Engine(settings(wasmtime.Config()))
    except (ImportError, OSError, RuntimeError) as error:
        raise EngineError(Trouble.NO_WASMTIME, str(error)) from None
    folder = kept_folder()
    path = None if folder is None else folder / name_of(code, version)
    if path is not None and (kept := whole(path)) is not None:
        with suppress(wasmtime.WasmtimeError):  # of a processor that can do what this one cannot
            return engine, wasmtime.Module.deserialize(engine, kept)
    try:
        made = wasmtime.Module(engine, code)
    except wasmtime.WasmtimeError as error:
        raise EngineError(Trouble.NO_WASMTIME, str(error)) from None
    if path is not None:
        keep(path, bytes(made.serialize()))
    return engine, made


def settings(config: Any) -> Any:
    """What the module needs, and what was measured (design/hosts.py)."""
    # All that 32-bit addresses reach is set aside, so that arrays in it never move.
    config.memory_reservation, config.memory_may_move = 1 << 32, False
    config.cranelift_opt_level = "speed"
    # On one thread: more would gain a tenth of a second once, and be lost in processes that fork.
    config.parallel_compilation = False
    return config


def kept_folder() -> Path | None:
    """Where compiled code is kept; None where no folder is this user's alone."""
    roots = built.user_folder(), shared_folder("benchdragon", Path(tempfile.gettempdir()))
    return next((folder for folder in map(made_own, roots) if folder is not None), None)


def name_of(code: bytes, version: str) -> str:
    """The file name of a module compiled by a version of Wasmtime on this machine."""
    what = f"{version} {sys.platform} {built.processor()} ".encode() + code
    return f"engine-{hashlib.sha256(what).hexdigest()[:16]}{ENDING}"


def whole(path: Path) -> bytes | None:
    """What is kept in a file, without its hash; None if there is none, or it is torn."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    size = hashlib.sha256().digest_size
    return data[size:] if hashlib.sha256(data[size:]).digest() == data[:size] else None


def keep(path: Path, data: bytes) -> None:
    """Keep what was compiled; where that cannot be done, it is compiled again at the next start."""
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    with suppress(OSError):
        try:
            temporary.write_bytes(hashlib.sha256(data).digest() + data)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
        for old in sorted(path.parent.glob(f"*{ENDING}"), key=os.path.getmtime)[:-MOST]:
            old.unlink()
