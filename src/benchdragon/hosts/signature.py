"""The C signature of an entry, from its annotations: `int32 name(int64 *block)`.

A block is a row of 8-byte slots. A number takes one, floats by their bits; an array one for its
address and one for the length along each dimension; a NamedTuple what its fields take, in turn. The
slots of the results follow those of the arguments.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, cast, get_args, get_origin


class Layout(NamedTuple):
    """Of an array: "d" for float64 or "q" for int64, as in `struct`, and its dimensions."""

    code: str
    dimensions: int


class Leaf(NamedTuple):
    """A number (no dimensions) or an array, by the name that errors call it."""

    name: str
    layout: Layout


class Parameter(NamedTuple):
    """An argument of an entry: a leaf, or a NamedTuple of the class `group` with these fields."""

    name: str
    group: type | None
    fields: tuple["Parameter", ...]
    leaf: Leaf | None

    def leaves(self) -> list[Leaf]:
        """All numbers and arrays in it, in order."""
        if self.leaf is not None:
            return [self.leaf]
        return [leaf for field in self.fields for leaf in field.leaves()]


class Signature(NamedTuple):
    """What an entry takes, and what it returns: the codes of the results, and what makes it of them."""

    symbol: str
    parameters: tuple[Parameter, ...]
    results: tuple[str, ...]
    converters: tuple[Callable[[Any], Any], ...]
    gather: Callable[[tuple[Any, ...]], Any]

    def leaves(self) -> list[Leaf]:
        """All numbers and arrays among the arguments, in order."""
        return [leaf for parameter in self.parameters for leaf in parameter.leaves()]

    def several(self) -> bool:
        """Whether the results come as a tuple."""
        return isinstance(self.gather(tuple(0 for _code in self.results)), tuple)

    def slots(self) -> str:
        """The code of each slot of the block, as in `struct`."""
        arguments = "".join(
            leaf.layout.code if leaf.layout.dimensions == 0 else "q" * (1 + leaf.layout.dimensions)
            for leaf in self.leaves()
        )
        return arguments + "".join(self.results)


def signature(function: Callable[..., object]) -> Signature:
    """The signature of an entry.

    Raises:
        TypeError: if an annotation says too little, or what no block holds.
    """
    annotations = dict(function.__annotations__)
    returned = annotations.pop("return")
    results, gather = result_kinds(returned)
    module = function.__module__.rpartition(".")[2]
    return Signature(
        f"bd_{module}_{function.__name__}",
        tuple(parameter(name, annotation) for name, annotation in annotations.items()),
        tuple(number_code("the result", result) for result in results),
        results,
        gather,
    )


def result_kinds(returned: Any) -> tuple[tuple[Any, ...], Callable[[tuple[Any, ...]], Any]]:
    """The kinds of the numbers that an entry returns, and a function that makes its result of them."""
    if returned is None:
        return (), lambda _numbers: None
    if get_origin(returned) is tuple:
        return get_args(returned), lambda numbers: numbers
    if isinstance(returned, type) and issubclass(returned, tuple):
        group: Any = returned
        return tuple(group.__annotations__.values()), lambda numbers: group(*numbers)
    return (returned,), lambda numbers: numbers[0]


def parameter(name: str, annotation: Any) -> Parameter:
    """The parameter of that name and annotation.

    Raises:
        TypeError: if it is no number, no array of kernels/arrays.py, and no NamedTuple of such.
    """
    layout = next(iter(getattr(annotation, "__metadata__", ())), None)
    if isinstance(layout, Layout):
        return Parameter(name, None, (), Leaf(name, layout))
    if isinstance(annotation, type) and issubclass(annotation, tuple):
        group = cast("type[NamedTuple]", annotation)
        fields = ((f"{name}.{field}", kind) for field, kind in group.__annotations__.items())
        return Parameter(name, group, tuple(parameter(field, kind) for field, kind in fields), None)
    return Parameter(name, None, (), Leaf(name, Layout(number_code(name, annotation), 0)))


def number_code(name: str, annotation: Any) -> str:
    """The code of a number's slot.

    Raises:
        TypeError: if the annotation is not that of a number.
    """
    if annotation is float:
        return "d"
    if isinstance(annotation, type) and issubclass(annotation, int):
        return "q"
    raise TypeError(f"{name} of an entry must be a number or a known array, not {annotation}")
