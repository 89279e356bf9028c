"""Groups of arrays as typed pointers: a NamedTuple that holds arrays is one number in compiled code.

It points to the group's slots (hosts/signature.py): in the entry's own block, or on the stack of the
kernel that makes the group. What is read of it is loaded when it is read. numba's own way, all numbers
of all arrays as arguments of each function, made most of the code (design/typed_pointers.py).

Nothing writes into a group's slots once it is made, which is declared to LLVM. A kernel returns no
group, as its stack ends with it, and makes none where arrays are counted (`allocates`): slots count
nothing.
"""

import inspect
from functools import cache
from typing import Any, ClassVar

from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.core.typing import templates
from numba.cpython import tupleobj
from numba.np import arrayobj

from benchdragon.engine.optimise import BuildError
from benchdragon.hosts.signature import Parameter, parameter

# Their annotations are partial.
code: Any = ir
numba: Any = extending
kinds: Any = types
tools: Any = cgutils
typing: Any = templates
tuples: Any = tupleobj
arrays: Any = arrayobj

SLOT, BYTES = code.IntType(64), 8
NUMBERS = {"d": kinds.float64, "q": kinds.int64}


def holds_arrays(group: Parameter) -> bool:
    """Whether a parameter is a NamedTuple with arrays in it."""
    return group.group is not None and any(leaf.layout.dimensions for leaf in group.leaves())


class Block(kinds.Type):  # type: ignore[misc]
    """A pointer to the slots of a NamedTuple; `members` has each field's type and first slot."""

    def __init__(self, group: Parameter) -> None:
        self.members: dict[str, tuple[Any, int]] = {}
        self.slots = 0
        for field in group.fields:
            kind, slots = member(field)
            self.members[field.name.rpartition(".")[2]] = kind, self.slots
            self.slots += slots
        assert group.group is not None
        # A type is known by its name; two modules have a class `Kinds`.
        super().__init__(name=f"Block[{group.group.__module__}.{group.group.__name__}]")


def member(field: Parameter) -> tuple[Any, int]:
    """The type of a field of a group, and how many slots it takes.

    Raises:
        BuildError: if it is a NamedTuple of numbers alone.
    """
    if field.leaf is None:
        if not holds_arrays(field):
            raise BuildError(f"{field.name} is a group without arrays in a group with some")
        kind = Block(field)
        return kind, kind.slots
    number, dimensions = NUMBERS[field.leaf.layout.code], field.leaf.layout.dimensions
    return (kinds.Array(number, dimensions, "C") if dimensions else number), 1 + dimensions


@cache
def block_of(group: type) -> Block | None:
    """The type of a NamedTuple's slots; None if it holds no arrays, and is passed by value."""
    try:
        found = parameter(group.__name__, group)
    except TypeError:  # what entries cannot take
        return None
    return Block(found) if holds_arrays(found) else None


@numba.register_model(Block)
class BlockModel(numba.models.PrimitiveModel):  # type: ignore[misc]
    """An address."""

    def __init__(self, manager: Any, kind: Block) -> None:
        super().__init__(manager, kind, SLOT.as_pointer())

    def from_argument(self, _builder: Any, value: Any) -> Any:
        """Tell LLVM that nothing writes there while the function runs."""
        if isinstance(value, code.Argument):
            value.add_attribute("noalias")
        return value

    def as_return(self, _builder: Any, _value: Any) -> Any:
        """Refuse it: it may point to the stack of the function that ends."""
        raise BuildError(f"a kernel returns a {self._fe_type}")


@numba.infer_getattr
class BlockAttributes(typing.AttributeTemplate):  # type: ignore[misc]
    """The types of fields."""

    key = Block

    def generic_resolve(self, kind: Block, name: str) -> Any:
        """The type of the field of that name; None if there is none."""
        return kind.members.get(name, (None, 0))[0]


@numba.lower_getattr_generic(Block)  # type: ignore[untyped-decorator]
def read(context: Any, builder: Any, kind: Block, block: Any, name: str) -> Any:
    """Load the field of that name."""
    found, slot = kind.members[name]
    if isinstance(found, Block):
        return at(builder, block, slot)
    if not isinstance(found, kinds.Array):
        return load(builder, block, slot, context.get_value_type(found))
    array, size = arrays.make_array(found)(context, builder), SLOT(BYTES)
    shape = [load(builder, block, slot + 1 + n, SLOT) for n in range(found.ndim)]
    strides: list[Any] = []
    step = size
    for length in reversed(shape):
        strides.insert(0, step)
        step = builder.mul(step, length, flags=["nsw"])
    data = load(builder, block, slot, array.data.type)
    arrays.populate_array(array, data=data, shape=shape, strides=strides, itemsize=size, meminfo=None)
    return array._getvalue()


def at(builder: Any, block: Any, slot: int) -> Any:
    """The address of a slot."""
    return builder.gep(block, [SLOT(slot)], inbounds=True)


def load(builder: Any, block: Any, slot: int, kind: Any) -> Any:
    """What a slot holds, as LLVM's type `kind`: a pointer may have less bits than the slot."""
    return builder.load(builder.bitcast(at(builder, block, slot), kind.as_pointer()))


def fill(context: Any, builder: Any, block: Any, slot: int, kind: Any, value: Any) -> None:
    """Store a field of that type from a slot on."""
    if isinstance(kind, Block):
        tools.raw_memcpy(builder, at(builder, block, slot), value, SLOT(kind.slots), BYTES)
        return
    parts = [value]
    if isinstance(kind, kinds.Array):
        array = arrays.make_array(kind)(context, builder, value)
        parts = [array.data, *tools.unpack_tuple(builder, array.shape)]
    for n, part in enumerate(parts):
        builder.store(part, builder.bitcast(at(builder, block, slot + n), part.type.as_pointer()))


@cache
def viewer(kind: Block) -> Any:
    """A function for compiled code: the address, an int64, as a pointer to a group there."""

    @numba.intrinsic  # type: ignore[untyped-decorator]
    def view(_typing: Any, address: Any) -> Any:
        def build(_context: Any, builder: Any, _whole: Any, values: Any) -> Any:
            return builder.inttoptr(values[0], SLOT.as_pointer())

        return kind(address), build

    return view


@numba.infer_getattr
class Classes(typing.AttributeTemplate):  # type: ignore[misc]
    """Calls of classes of NamedTuples; for the CPU they come before numba's own, which make values."""

    key = kinds.NamedTupleClass
    metadata: ClassVar = {"target": "cpu"}

    def resolve___call__(self, classes: Any) -> Any:
        """What makes a group; None if that is passed by value."""
        kind = block_of(classes.instance_class)
        if kind is None:
            return None

        def typer(*_fields: Any) -> Block:
            return kind

        typer.pysig = inspect.signature(classes.instance_class)  # type: ignore[attr-defined]
        return kinds.Function(typing.make_callable_template(Block, typer))


# The later of two that fit is taken: numba's is imported above.
@numba.lower_builtin(kinds.NamedTupleClass, kinds.VarArg(kinds.Any))  # type: ignore[untyped-decorator]
def make(context: Any, builder: Any, whole: Any, values: Any) -> Any:
    """A group of its fields, on the stack of who makes it."""
    kind = whole.return_type
    if not isinstance(kind, Block):
        return tuples.namedtuple_constructor(context, builder, whole, values)
    if context.enable_nrt:
        raise BuildError(f"a {kind} is made where arrays are counted")
    block = tools.alloca_once(builder, SLOT, SLOT(kind.slots))
    for (found, slot), came, value in zip(kind.members.values(), whole.args, values, strict=True):
        fill(context, builder, block, slot, found, context.cast(builder, value, came, found))
    return block
