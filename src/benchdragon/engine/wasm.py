"""The kernels as one WebAssembly module, engine.wasm: `python -m benchdragon.engine --wasm`.

The module imports nothing. It exports its memory, `malloc`, `free` and the entries, each as
`int32 name(int64 *block)` (hosts/signature.py), and carries, as JSON in the custom section
"benchdragon", what they take and return, and the stamp: what it was built from, and by what. The same
sources and tools give the same bytes. NOTICE.txt lists other code that is linked in.
"""

import importlib.util
import json
import platform
import sys
import tempfile
from collections.abc import Iterable, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm

from benchdragon.engine import build, optimise, shims
from benchdragon.hosts import built
from benchdragon.hosts.signature import Parameter, Signature, signature

TRIPLE, FEATURES = "wasm32-unknown-unknown", "+simd128"
# What decides about the bytes, beside the sources. Zig's clang, linker and libraries of C come as one.
TOOLS = ("llvmlite", "numba", "ziglang")
# Bytes of the stack, of which kernels use little: their arrays lie elsewhere.
STACK = 1 << 20
OPTIONS = ("-O2", "-lm", "-mexec-model=reactor", f"-Wl,-z,stack-size={STACK}", "-Wl,--strip-all")


def target_machine(features: str = FEATURES) -> Any:
    """Code for WebAssembly; vectors of two numbers are in all browsers since 2023."""
    target = llvm.Target.from_triple(TRIPLE)
    return target.create_target_machine(cpu="generic", features=features, opt=3)


def described(parameter: Parameter) -> dict[str, Any]:
    """A parameter as JSON: a number or an array by its layout, a NamedTuple by its fields."""
    name = parameter.name.rpartition(".")[2]
    if parameter.leaf is None:
        return {"name": name, "fields": [described(field) for field in parameter.fields]}
    return {"name": name, **parameter.leaf.layout._asdict()}


def table(shapes: Iterable[Signature]) -> dict[str, Any]:
    """What entries take and return, by their exported names."""
    return {
        shape.symbol: {
            "parameters": [described(parameter) for parameter in shape.parameters],
            "results": list(shape.results),
        }
        for shape in shapes
    }


def stamp() -> dict[str, Any]:
    """The hash of the sources, and the versions of the tools that are here."""
    python = ".".join(platform.python_version_tuple()[:2])
    return {
        "sources": built.source_hash(),
        "tools": {"python": python, **{name: version(name) for name in TOOLS}},
    }


def leb128(number: int) -> bytes:
    """A whole number >= 0 as WebAssembly writes it: seven bits a byte, the lowest first."""
    first, rest = number & 0x7F, number >> 7
    return bytes([first | 0x80]) + leb128(rest) if rest else bytes([first])


def custom_section(name: str, content: bytes) -> bytes:
    """A section that engines pass over, to be put at the end of a module."""
    title = name.encode()
    body = leb128(len(title)) + title + content
    return b"\0" + leb128(len(body)) + body


def link(code: bytes, symbols: Iterable[str]) -> bytes:
    """The module of an object file that exports `symbols`: with numba's runtime, and C's as needed.

    Raises:
        BuildError: if the linker fails.
    """
    exports = [f"-Wl,--export={name}" for name in ("malloc", "free", *symbols)]
    with tempfile.TemporaryDirectory() as folder:
        source, made = Path(folder, "kernels.o"), Path(folder, built.MODULE)
        source.write_bytes(code)
        command = [sys.executable, "-m", "ziglang", "cc", "-target", "wasm32-wasi", *OPTIONS, *exports]
        build.run([*command, "-o", str(made), str(source), str(optimise.RUNTIME)])
        return made.read_bytes()


def module(functions: Sequence[Any], machine: Any) -> bytes:
    """Entries, as numba has them, as one module that says what it is.

    Raises:
        BuildError: if it cannot be built.
    """
    entries = table(signature(function.py_func) for function in functions)
    linked = link(build.machine_code(functions, machine), entries)
    told = json.dumps({"stamp": stamp(), "entries": entries}, separators=(",", ":"))
    return linked + custom_section(built.SECTION, told.encode())


def build_module(folder: Path) -> Path:
    """Build engine.wasm into a folder; its path.

    Raises:
        BuildError: if it cannot be built.
    """
    if importlib.util.find_spec("ziglang") is None:
        raise optimise.BuildError("the Python package ziglang is not here: `make wasm` installs it")
    optimise.prepare()
    made = module(list(shims.compiled_entries().values()), target_machine())
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / built.MODULE
    path.write_bytes(made)
    return path
