"""The library of all kernels, built by numba, LLVM and the system's C compiler."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from benchdragon.engine import optimise, pieces, shims
from benchdragon.hosts import built, native

COMPILERS = ("cc", "gcc", "clang")


def c_compiler() -> str:
    """The system's C compiler: what CC says, else the first that is there.

    Raises:
        BuildError: if there is none.
    """
    for name in (os.environ.get("CC", ""), *COMPILERS):
        path = shutil.which(name) if name else None
        if path:
            return path
    raise optimise.BuildError(f"no C compiler is here: wanted {', '.join(COMPILERS)}, or CC")


def machine_code(functions: Iterable[Any], machine: Any) -> bytes:
    """Entries, as numba has them, as an object file for a machine, one of LLVM's.

    Raises:
        BuildError: if the code would work in this process alone.
    """
    shapes, found, symbols = [], [], set()
    for function in functions:
        shape, piece, inner = shims.compiled_shim(function)
        shapes.append(optimise.SHIM.format(symbol=shape.symbol, inner=inner))
        found.append(piece)
        symbols.add(shape.symbol)
    whole = optimise.joined([*pieces.texts(found), *shapes], machine, symbols)
    optimise.optimise(whole, machine)
    optimise.check(whole)
    return bytes(machine.emit_object(whole))


def link(code: bytes, path: Path) -> None:
    """Write the shared library at `path`, whole or not at all.

    Raises:
        BuildError: if the C compiler fails.
    """
    compiler = c_compiler()
    with tempfile.TemporaryDirectory(dir=path.parent) as folder:
        source, made = Path(folder, "kernels.o"), Path(folder, path.name)
        source.write_bytes(code)
        files = map(str, (made, source, optimise.RUNTIME))
        command = [compiler, "-O2", "-shared", "-fPIC", "-o", *files]
        command += ["-lm", "-s", "-Wl,--no-undefined"] if sys.platform == "linux" else ["-lm"]
        run(command)
        made.replace(path)


def run(command: list[str]) -> None:
    """Run a compiler.

    Raises:
        BuildError: if it fails.
    """
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise optimise.BuildError(f"{' '.join(command[:4])} failed: {done.stderr.strip()}")


def build(folder: Path) -> Path:
    """Build the library into a folder, in place of those of other kernels there; its path.

    Raises:
        BuildError: if it cannot be built.
    """
    c_compiler()  # reported before a minute is spent
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / native.library_name()
    optimise.prepare()
    machine = optimise.target_machine(built.processor())
    link(machine_code(shims.compiled_entries().values(), machine), path)
    for other in folder.glob(f"kernels-*-{sys.platform}-{built.processor()}.so"):
        if other != path:
            other.unlink()
    return path
