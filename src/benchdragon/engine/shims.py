"""Entries as functions of one block each, compiled by numba to LLVM's language.

The block is that of hosts/signature.py. What a shim does is written as Python and compiled with the
kernel, so that numba alone needs to know how it passes arrays.
"""

import importlib
from collections.abc import Callable, Iterator
from typing import Any

import numba
from numba.core import types
from numba.core.errors import NumbaError
from numba.extending import intrinsic

from benchdragon.engine.blocks import BYTES, block_of, viewer
from benchdragon.engine.optimise import BuildError
from benchdragon.engine.pieces import Piece, keep_pieces
from benchdragon.hosts import built
from benchdragon.hosts.signature import Parameter, Signature, signature
from benchdragon.kernels import entries

compiler: Any = numba  # its annotations are partial
kinds: Any = types

READERS = {"d": "numbers[{}]", "q": "whole[{}]"}
POINTERS = {"d": "floats", "q": "integers"}


def pointer_maker(number: Any) -> Any:
    """A function for compiled code: the address, an int64, as a pointer to such numbers."""

    @intrinsic
    def pointer(_context: Any, address: Any) -> Any:
        def code(_target: Any, builder: Any, whole: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], _target.get_value_type(whole.return_type))

        return kinds.CPointer(number)(address), code

    return pointer


# Contraction is the only licence taken with arithmetic. The numpy error model keeps divisions free of
# branches, without which no loop becomes SIMD. Nothing is made that Python would call.
SETTINGS: dict[str, Any] = {
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract"},
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}

NAMES = {
    "carray": compiler.carray,
    "floats": pointer_maker(kinds.float64),
    "integers": pointer_maker(kinds.int64),
}


def compiled(function: Any) -> Any:
    """A kernel, for numba to compile."""
    return compiler.njit(_nrt=getattr(function, "allocates", False), **SETTINGS)(function)


def compiled_entries() -> dict[str, Callable[..., object]]:
    """All entries, for numba to compile, by module and name; the kernels must not be imported yet."""
    keep_pieces()
    entries.compiler = compiled
    for path in sorted(built.KERNELS.glob("*.py")):
        importlib.import_module(f"benchdragon.kernels.{path.stem}")
    for told in ("memory", "numbered"):  # declared to numba
        importlib.import_module(f"benchdragon.engine.{told}")
    modules = {name: importlib.import_module(name.rpartition(".")[0]) for name in entries.ENTRIES}
    return {name: getattr(module, name.rpartition(".")[2]) for name, module in modules.items()}


def expressions(
    parameters: tuple[Parameter, ...], slots: Iterator[int], names: dict[str, Any]
) -> Iterator[str]:
    """For each parameter the expression that reads it from the block; classes go into `names`."""
    for parameter in parameters:
        kind = None if parameter.group is None else block_of(parameter.group)
        if kind is not None:
            first, *_rest = [next(slots) for _slot in range(kind.slots)]
            names[f"view{first}"] = viewer(kind)
            yield f"view{first}(block + {BYTES * first})"
            continue
        if parameter.group is not None:
            names[parameter.group.__name__] = parameter.group
            inner = ", ".join(expressions(parameter.fields, slots, names))
            yield f"{parameter.group.__name__}({inner})"
            continue
        for leaf in parameter.leaves():
            slot, (code, dimensions) = next(slots), leaf.layout
            if dimensions == 0:
                yield READERS[code].format(slot)
                continue
            shape = "".join(f"whole[{next(slots)}], " for _dimension in range(dimensions))
            yield f"carray({POINTERS[code]}(whole[{slot}]), ({shape}))"


def shim_source(shape: Signature, names: dict[str, Any]) -> str:
    """A Python function, as text, of a block's address: it calls `entry` and stores the results."""
    slots = iter(range(len(shape.slots())))
    call = f"entry({', '.join(expressions(shape.parameters, slots, names))})"
    size = len(shape.slots())
    lines = [
        "def shim(block):",
        f"    whole, numbers = carray(integers(block), ({size},)), carray(floats(block), ({size},))",
        f"    found = {call}",
    ]
    for n, code in enumerate(shape.results):
        value = f"found[{n}]" if shape.several() else "found"
        lines.append(f"    {READERS[code].format(next(slots))} = {value}")
    return "\n".join(lines)


def compiled_shim(function: Any) -> tuple[Signature, Piece, str]:
    """The signature of an entry, its shim's code, and the shim's name there.

    Raises:
        BuildError: if it cannot be compiled, with what numba says.
    """
    shape, names = signature(function.py_func), {**NAMES, "entry": function}
    exec(compile(shim_source(shape, names), shape.symbol, "exec"), names)
    shim = names["shim"]
    shim.__qualname__ = shim.__name__ = f"{shape.symbol}_shim"
    try:
        made: Any = compiler.njit(kinds.void(kinds.int64), **SETTINGS)(shim)
    except (BuildError, NumbaError) as error:
        raise BuildError(f"{shape.symbol}, or what it calls: {error}") from error
    (result,) = made.overloads.values()
    return shape, result.library, result.fndesc.mangled_name
