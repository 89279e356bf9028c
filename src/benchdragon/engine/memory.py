"""What compiled code makes of kernels/memory.py: calls of engine/runtime.c, and arrays at addresses."""

from typing import Any

from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.np import arrayobj

from benchdragon.engine.blocks import block_of
from benchdragon.kernels import memory

numba: Any = extending  # its annotations are partial
kinds: Any = types
arrays: Any = arrayobj
code: Any = cgutils
INT64 = ir.IntType(64)

# The functions whose place those of engine/runtime.c take whose names begin with bd_, and how many
# numbers they take.
CALLED = {"allocate": 1, "release": 1, "taken": 0, "remember": 1, "recall": 1, "forget": 1}


def calls(name: str, count: int) -> None:
    """Let compiled code call a function of engine/runtime.c for one of kernels/memory.py."""
    function = getattr(memory, name)

    def made(_target: Any, builder: Any, _types: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(INT64, [INT64] * count)
        return builder.call(code.get_or_insert_function(builder.module, kind, f"bd_{name}"), arguments)

    typed = (lambda _number: kinds.int64) if count else (lambda: kinds.int64)
    numba.type_callable(function)(lambda _context: typed)
    numba.lower_builtin(function, *[kinds.Integer] * count)(made)


def makes_arrays(function: Any, number: Any) -> None:
    """Let compiled code make an array of numbers at an address where it calls a function."""
    array = kinds.Array(number, 1, "C")

    def made(target: Any, builder: Any, _types: Any, arguments: Any) -> Any:
        found, each = arrays.make_array(array)(target, builder), target.get_constant(kinds.intp, 8)
        data = builder.inttoptr(arguments[0], target.get_data_type(number).as_pointer())
        shape = {"shape": [arguments[1]], "strides": [each], "itemsize": each}
        arrays.populate_array(found, data=data, meminfo=None, **shape)
        return found._getvalue()

    numba.type_callable(function)(lambda _context: lambda _address, _count: array)
    numba.lower_builtin(function, kinds.Integer, kinds.Integer)(made)


def makes_groups() -> None:
    """Let the group whose slots begin at an address be that address, in compiled code."""

    def typed(_context: Any) -> Any:
        return lambda group, _address: block_of(group.instance_class)

    def made(_target: Any, builder: Any, _types: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[1], INT64.as_pointer())

    numba.type_callable(memory.group_at)(typed)
    numba.lower_builtin(memory.group_at, kinds.NamedTupleClass, kinds.Integer)(made)


for each in CALLED.items():
    calls(*each)
makes_arrays(memory.floats_at, kinds.float64)
makes_arrays(memory.integers_at, kinds.int64)
makes_groups()
